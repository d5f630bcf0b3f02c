/* Whether the torque of a shaft without a torque column can be inertia × acceleration. */
#ifndef HCI_SRC_HOST_RECORDING_FREE_SHAFT_H
#define HCI_SRC_HOST_RECORDING_FREE_SHAFT_H

#include "hci/host/recording/predict.h"
#include "host/recording/drag_law.h"

/* Of a free shaft what the model makes is inertia × acceleration and a drag of its own. The drag is the
 * difference of their means over the angle of whole turns, with the sign of the speed or without, where the model makes more than twice
 * what accelerates. It may be a tenth of the machine's rated torque, or 3/4 of the largest rms torque that
 * i_q makes in these runs: a torque that neither accelerates nor varies drives something. Of a run that does,
 * mean_is_unknown is set, and its remark says so, and then also of the others that hardly accelerate; runs
 * with another source of torque are not looked at. HCI_ERROR_INPUT for a run without an angle,
 * HCI_ERROR_MEMORY. O(samples·(terms + harmonics)).
 *
 * drag: [count], of each run whose current hardly accelerates it, by the declared torque per ampere, where
 * all of them are one friction: mean_is_unknown is set of these runs, since their means say nothing else, and
 * of no other. NAN in drag_Nm of the other runs, and where they are no friction. NULL: not asked. */
hci_status hci_free_shafts_find(const hci_machine_data *machine, const hci_effects *effects, hci_run *runs,
                                size_t count, hci_drag *drag, hci_note *note);

#endif
