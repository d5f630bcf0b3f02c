/* Motors that belong together, from a list with one line for each. */
#ifndef HCI_HOST_FLEET_LIST_H
#define HCI_HOST_FLEET_LIST_H

#include "hci/host/csv/csv.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Most bytes of a motor's name, which is a folder's name too, with its NUL. */
enum { HCI_FLEET_NAME_SIZE = 128 };

/* A list that has been read. Start with {0}. */
typedef struct {
    hci_csv *csv; /* the table */
    size_t count; /* motors, one in each of its rows */
} hci_fleet_list;

/* Reads a table with a column `motor`: names that differ, and that can be names of folders. Other columns are
 * left to who uses them. *list: out, to be given to hci_fleet_list_release even after a failure.
 * HCI_ERROR_INPUT, _MEMORY. O(motors log motors). */
hci_status hci_fleet_list_read(const char *path, hci_fleet_list *list, hci_note *note);

/* A cell; "" where the list has no such column. Owned by the list. */
const char *hci_fleet_cell(const hci_fleet_list *list, size_t motor, const char *column);

/* Frees what it holds and empties it. */
void hci_fleet_list_release(hci_fleet_list *list);

#ifdef __cplusplus
}
#endif

#endif
