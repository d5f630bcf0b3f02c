/* Currents that a drive's current loop can be made to follow. */
#ifndef HCI_HOST_SOLUTION_FOR_DRIVE_H
#define HCI_HOST_SOLUTION_FOR_DRIVE_H

#include "hci/host/drive/drive.h"
#include "hci/host/solve/solve.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Sets the options of a solve for a drive at options->speed_rad_per_s, which is not 0: orders in the rotor
 * frame above those that its sampling does for are not chosen, and left out of a given set (NULL: none is
 * given); currents are looked for of which the loop misses little (sample_rad), within the dc link of the
 * drive where options have no limit_voltage_V and ratings are not ignored. machine: resistance and
 * inductances that it does not have are those of the drive. remark: out, what is left out, and which dc link
 * is kept. HCI_ERROR_INPUT where fewer than six orders are left, or the loop is not stable. */
hci_status hci_solve_for_drive(const hci_drive_data *drive, hci_machine_data *machine,
                               hci_solve_options *options, hci_component_set *set, hci_note *remark,
                               hci_note *note);

#ifdef __cplusplus
}
#endif

#endif
