/* The points of a map from a file. */
#ifndef HCI_HOST_SWEEP_GRID_FILE_H
#define HCI_HOST_SWEEP_GRID_FILE_H

#include "hci/host/sweep/sweep.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Reads columns torque_Nm, speed_rad_per_s (in any unit) and optionally dc_link_V: a point for each row.
 * point: out, count of them, to be given to hci_grid_points_free. HCI_ERROR_INPUT, _MEMORY. */
hci_status hci_grid_read(const char *path, hci_grid_point **point, size_t *count, hci_note *note);

/* Frees them; NULL is fine. */
void hci_grid_points_free(hci_grid_point *point);

#ifdef __cplusplus
}
#endif

#endif
