/* What a device has learnt of its cogging, as a recording. */
#ifndef HCI_SRC_HOST_CSV_LEARNED_H
#define HCI_SRC_HOST_CSV_LEARNED_H

#include "host/csv/table.h"

/* Whether a file of so many bytes is a blob of hci/learn.h. */
bool hci_csv_is_learned(const hci_csv *csv, size_t size);

/* Turns csv->text, such a blob, into the text of a recording: a turn forward and a turn backward, angle,
 * speed, and the current i_q with a torque of 0 (a holding test), or the torque of an unpowered shaft.
 * HCI_ERROR_INPUT where it is damaged or newer than this program, _MEMORY; the text is then as it was. */
hci_status hci_csv_read_learned(hci_csv *csv, size_t size, hci_note *note);

#endif
