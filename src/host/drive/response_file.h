/* loop.csv: the measured response of a current loop. */
#ifndef HCI_SRC_HOST_DRIVE_RESPONSE_FILE_H
#define HCI_SRC_HOST_DRIVE_RESPONSE_FILE_H

#include "hci/host/drive/drive.h"

/* Reads frequency_Hz, gain_d, phase_d_rad, gain_q, phase_q_rad. points: out, to be freed with
 * hci_memory_free. HCI_ERROR_INPUT for fewer than HCI_RESPONSE_LEAST rows, frequencies that do not ascend
 * from above 0, gains that are not above 0; HCI_ERROR_MEMORY. */
hci_status hci_response_read(const char *path, hci_loop_point **points, size_t *count, hci_note *note);

enum { HCI_RESPONSE_LEAST = 4 };

#endif
