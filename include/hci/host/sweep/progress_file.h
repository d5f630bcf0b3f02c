/* What a sweep has solved so far, in its folder: points.csv, and sweep.csv with what it was asked for, so
 * that another run can go on or take the points of several runs together. */
#ifndef HCI_HOST_SWEEP_PROGRESS_FILE_H
#define HCI_HOST_SWEEP_PROGRESS_FILE_H

#include "hci/host/sweep/sweep.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Most inputs, and bytes of the texts of each. */
enum { HCI_GRID_MOST_INPUTS = 48, HCI_GRID_INPUT_SIZE = 256 };

/* One thing that results depend on. */
typedef struct {
    char name[64];                   /* option or file */
    char value[HCI_GRID_INPUT_SIZE]; /* as given; of a file a checksum of its bytes */
} hci_grid_input;

/* All that results depend on. Start with {0}. */
typedef struct {
    hci_grid_input input[HCI_GRID_MOST_INPUTS]; /* in the order in which they were added */
    size_t count;                               /* entries of input */
} hci_grid_inputs;

/* Appends one; what has no room goes into a checksum. */
void hci_grid_inputs_add(hci_grid_inputs *inputs, const char *name, const char *value);

/* Appends the checksum of a file, or that it is not there. */
void hci_grid_inputs_add_file(hci_grid_inputs *inputs, const char *name, const char *path);

/* Appends those of a machine folder. */
void hci_grid_inputs_add_machine(hci_grid_inputs *inputs, const char *folder);

/* Takes the points that `folder` holds into the sweep; none where it has no points.csv and must_be is
 * false. A last row whose end is missing is left out, and the remark says so. HCI_ERROR_INPUT where
 * they are of other inputs, which the note names, or cannot be read; HCI_ERROR_MEMORY. */
hci_status hci_grid_take_points(hci_grid *sweep, const hci_grid_inputs *inputs, const char *folder,
                                bool must_be, hci_note *note);

/* Keeps an existing folder for this process until hci_grid_unlock, so that no other sweep writes its points
 * over those of this one; nothing where there is no such folder yet. HCI_ERROR_OUTPUT where another process
 * has it. *lock: NULL before the first call; may be called again. */
hci_status hci_grid_lock(const char *folder, void **lock, hci_note *note);

/* lock may be NULL. */
void hci_grid_unlock(void *lock);

/* Writes points.csv and sweep.csv into the folder; both or none. HCI_ERROR_OUTPUT, _MEMORY. */
hci_status hci_grid_keep_points(const hci_grid *sweep, const hci_grid_inputs *inputs, const char *folder,
                                hci_note *note);

#ifdef __cplusplus
}
#endif

#endif
