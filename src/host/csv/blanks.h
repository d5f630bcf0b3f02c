/* Tables whose columns stand apart by blanks, and headers that begin with #. */
#ifndef HCI_SRC_HOST_CSV_BLANKS_H
#define HCI_SRC_HOST_CSV_BLANKS_H

/* Turns a text, in place, into one that the reader of tables knows, line by line.
 * A header in a comment, as numpy.savetxt writes it, loses its # where what follows are numbers only, and as
 * many as it has names. Where neither tab, semicolon nor comma separates a header, and the rows below it are
 * as many numbers apart by blanks as it has names, each run of blanks becomes a tab; names that hold a blank
 * stand apart by two or more. */
void hci_csv_prepare(char *text);

#endif
