/* Tables of i_d and i_q in C and C++ source: what the targets share that take code. */
#ifndef HCI_SRC_HOST_FOREIGN_CODE_H
#define HCI_SRC_HOST_FOREIGN_CODE_H

#include "host/foreign/map.h"

/* Columns that have to stand in the source: 2 where nothing depends on the drive's own i_q, else 4. */
size_t hci_foreign_code_columns(const hci_foreign_map *map);

/* The rows between braces, by the text of each value. */
void hci_foreign_write_rows(const hci_foreign_map *map,
                            void (*write_value)(const hci_foreign_map *map, size_t row, size_t column,
                                                hci_output *output),
                            hci_output *output);

/* Reads rows of 2 or 4 numbers behind the first `= {` of a text into map->value, with 0 for columns that are
 * not there; their number must be a power of two. HCI_ERROR_INPUT, _MEMORY. */
hci_status hci_foreign_read_rows(const char *path, const char *text, hci_foreign_map *map, hci_note *note);

#endif
