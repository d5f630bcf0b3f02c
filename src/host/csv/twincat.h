/* The text export of TwinCAT 3 Scope: below the names of the channels stand some fifteen lines of their
 * attributes, one of them the units, and each column of times is called Name. */
#ifndef HCI_SRC_HOST_CSV_TWINCAT_H
#define HCI_SRC_HOST_CSV_TWINCAT_H

#include "hci/host/csv/csv.h"

/* Makes an ordinary table of such a text, in place: the first column of times gets the name t_ms, attributes
 * become comments, the units a row of units. Another text stays as it is. HCI_ERROR_INPUT for channels of
 * several sample times, whose rows do not belong together, and for full time stamps. */
hci_status hci_csv_of_twincat(const char *path, char *text, hci_note *note);

#endif
