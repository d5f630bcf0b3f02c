/* A map out of somebody else's drive as a recording: what `harmonics`, `predict`, `check` and `diagnose`
 * read.
 *
 * A current that cancels the cogging torque is what holds the shaft still against it, so that a map of
 * currents is a holding map: an angle, i_d and i_q, and a torque of 0. A map of torques is its own torque,
 * with the sign turned. */
#ifndef HCI_SRC_HOST_FOREIGN_AS_RECORDING_H
#define HCI_SRC_HOST_FOREIGN_AS_RECORDING_H

#include "host/foreign/map.h"

/* Texts of so many bytes and more are not looked at. */
enum { HCI_FOREIGN_MOST_BYTES = 1 << 20 };

/* The type of the map that a text is, or NULL. */
const hci_foreign_type *hci_foreign_recognise(const char *text);

/* Reads a text that has been recognised. path: for messages. On failure *map is empty. HCI_ERROR_INPUT,
 * _MEMORY. */
hci_status hci_foreign_read(const hci_foreign_type *type, const char *path, const char *text,
                            hci_foreign_map *map, hci_note *note);

/* The map as the text of a CSV file, to be freed by hci_memory_free. HCI_ERROR_MEMORY. */
hci_status hci_foreign_as_csv(const hci_foreign_map *map, char **csv, hci_note *note);

#endif
