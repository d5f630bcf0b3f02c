/* One bar of characters. Uses terminal. */
#ifndef HCI_CLI_BAR_H
#define HCI_CLI_BAR_H

/* A bar in so many cells, of blocks or of ASCII. share: how much of it is filled, mark: where a line goes
 * across it, both from 0 to 1, NAN for none. text: out, 4 bytes for each cell and one. */
void cli_bar_text(double share, double mark, int cells, char *text);

#endif
