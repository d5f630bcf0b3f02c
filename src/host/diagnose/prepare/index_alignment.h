/* Runs whose angle does not begin at the same place of the turn: an index that was found anew after a reboot,
 * or a magnet of the encoder that has moved.
 *
 * In: the residual over the angle of each run. Out: the angle by which each run is ahead of the others, where
 * the correlation of the turned residuals is largest, and the samples turned back by it. */
#ifndef HCI_SRC_HOST_DIAGNOSE_PREPARE_INDEX_ALIGNMENT_H
#define HCI_SRC_HOST_DIAGNOSE_PREPARE_INDEX_ALIGNMENT_H

#include "host/diagnose/prepare/binned_samples.h"

/* By how much each run's angle is ahead of that of most others, in mechanical radians; 0 where it is not, or
 * where the residual does not tell. Looks at runs of whole turns with the same current (holding tests, or no
 * current): their residuals over the angle resemble each other best when one is turned. residual_Nm: of each
 * sample; index_offset_rad: out, one for each run. HCI_ERROR_MEMORY. O(runs²·orders·angles). */
hci_status hci_index_alignment_find(const hci_binned_samples *samples, const hci_run *runs,
                                    const double *residual_Nm, double *index_offset_rad, hci_note *note);

/* Turns the angles of a run's samples back, and their currents with them: those were read as i_d and i_q of
 * the misaligned angle. */
void hci_index_alignment_apply(hci_binned_samples *samples, size_t run, int pole_pairs,
                               double index_offset_rad);

#endif
