/* Columns of voltages in which nothing stands but 0, as those of a drive that has the names and no
 * measurement. In: columns whose rows have been read. Out: the same without them, and a remark. */
#ifndef HCI_SRC_HOST_RECORDING_ZERO_VOLTAGES_H
#define HCI_SRC_HOST_RECORDING_ZERO_VOLTAGES_H

#include "host/recording/run_columns.h"

/* Takes each kind of voltage away (of phases, of lines, along d and q) that is 0 throughout, unless nothing
 * would be left to read the recording by. O(samples). */
void hci_zero_voltages_leave(hci_run_columns *c);

#endif
