/* Recordings whose angles do not begin at the same place of the turn: an index that was found anew after a
 * reboot, or a magnet that slipped. */
#ifndef HCI_SRC_HOST_DIAGNOSE_PREPARE_INDEX_ALIGNMENT_H
#define HCI_SRC_HOST_DIAGNOSE_PREPARE_INDEX_ALIGNMENT_H

#include "host/diagnose/prepare/binned_samples.h"

/* By how much each run's angle is ahead of that of most others, in mechanical radians; 0 where it is not, or
 * where the residual does not tell. Looks at runs of whole turns with the same current (holding tests, or no
 * current): their residuals over the angle resemble each other best when one is turned. residual_Nm: of each
 * cell; slip_rad: out, one for each run. HCI_ERROR_MEMORY. O(runs²·orders·angles). */
hci_status hci_slip_find(const hci_cells *cells, const hci_run *runs, const double *residual_Nm,
                         double *slip_rad, hci_note *note);

/* Turns the angles of a run's cells back, and their currents with them: those were read as i_d and i_q of the
 * slipped angle. */
void hci_slip_undo(hci_cells *cells, size_t run, int pole_pairs, double slip_rad);

#endif
