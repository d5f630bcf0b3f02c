/* Which way a shaft was turned while it was held, where a map has neither time nor speed: as its angle goes
 * from row to row. */
#ifndef HCI_SRC_HOST_RECORDING_ROW_DIRECTION_H
#define HCI_SRC_HOST_RECORDING_ROW_DIRECTION_H

#include "hci/host/recording/run.h"

/* Gives a run with an angle and without time and speed a slow speed of the sign in which the angle goes, and
 * remarks it. Nothing where a speed is known, or rows that go to and fro have no order. False when memory is
 * out. O(samples). */
bool hci_row_direction_set(hci_run *run);

#endif
