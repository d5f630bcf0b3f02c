/* A load that varies, such as a road, beside a torque that is inertia × acceleration.
 *
 * In parts of the runs of some turns each, the torque that the current makes is inertia × acceleration and
 * what brakes: friction, an inertia that is wrong, reluctance that is not declared and iron that saturates,
 * the same in all of them
 *
 *     T_e = a J ω' + c sign ω + B ω + R i_d i_q + S i_q³
 *
 * Out: what that leaves, which is a load that nobody has recorded. */
#ifndef HCI_SRC_HOST_DIAGNOSE_PREPARE_VARYING_LOAD_H
#define HCI_SRC_HOST_DIAGNOSE_PREPARE_VARYING_LOAD_H

#include "hci/host/recording/predict.h"

/* load_Nm: out, rms over the parts of all runs with use, which have an angle and a torque_Nm that is inertia
 * × acceleration; 0 where they have too few turns to tell. HCI_ERROR_MEMORY, and what hci_predict returns. */
hci_status hci_varying_load_find(const hci_machine_data *machine, const hci_effects *effects,
                                 const hci_runs *runs, const bool *use, double *load_Nm, hci_note *note);

#endif
