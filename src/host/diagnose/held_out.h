/* What the runs that were held out say of the effects that were found.
 *
 * In: a diagnosis with the errors of its runs. Out: whether these runs are described, and which effects
 * describe them better than they would be without. */
#ifndef HCI_SRC_HOST_DIAGNOSE_HELD_OUT_H
#define HCI_SRC_HOST_DIAGNOSE_HELD_OUT_H

#include "hci/host/diagnose/diagnose.h"
#include "host/diagnose/fit/dataset.h"
#include "host/diagnose/search/attribution.h"

typedef enum {
    HCI_HELD_OUT_DESCRIBED,   /* down to the noise, or nearly */
    HCI_HELD_OUT_PARTLY,      /* something is left in them, or in the mean of a run that was fitted */
    HCI_HELD_OUT_CONTRADICTED /* hardly better than without the effects */
} hci_held_out_result;

/* Mean square errors of runs within the currents and speeds that were fitted; beyond them an error may not
 * rise, nor that of all of them by more than chance. */
hci_held_out_result hci_held_out_judge(const hci_dataset *dataset, const hci_runs *runs,
                                       const hci_diagnosis *diagnosis, double resolution_Nm);

/* Whether the runs that were fitted, or those held out, or one of them alone, have an error well above their
 * noise. */
bool hci_held_out_leaves_much(const hci_diagnosis *diagnosis, double resolution_Nm);

/* Whether their error is above the noise and larger than that of the declared machine. */
bool hci_held_out_rises(const hci_dataset *dataset, const hci_runs *runs, const hci_diagnosis *diagnosis,
                        double resolution_Nm);

/* Whether both the means of these runs and the ripple about them are described worse than by the declared
 * machine, by more than chance, however near to their noise they are. */
bool hci_held_out_rises_both(const hci_dataset *b, const hci_runs *runs, const hci_diagnosis *d);

/* Takes the effects out of a fitted model without which these runs are described as well. HCI_ERROR_MEMORY.
 */
hci_status hci_held_out_keep(hci_dataset *dataset, const hci_runs *runs, hci_candidates *model,
                             hci_note *note);

/* A series in the currents without which, the others fitted anew, the error of these runs is less than twice
 * as large; NULL: none, or no run was held out. HCI_ERROR_MEMORY. */
hci_status hci_held_out_idle_series(hci_dataset *dataset, const hci_runs *runs,
                                    const hci_attribution *attribution, const hci_effect_type **type,
                                    hci_note *note);

/* Of effects that explain little beside others the one without which, the others fitted anew, these runs are
 * described best, and better than with it by more than chance; before all others one that the runs that were
 * fitted do not ask for any more; NULL: none. HCI_ERROR_MEMORY. */
hci_status hci_held_out_misleading(hci_dataset *dataset, const hci_runs *runs,
                                   const hci_attribution *attribution, const hci_effect_type **type,
                                   hci_note *note);

/* Whether an effect that a search took in which has ended at the limit of its work is not confirmed: such a
 * search has not been at others that may describe the same. It is where it is found with other runs left out,
 * has been compared with all that could stand in its place, and what is not understood is small beside it, in
 * the runs that were fitted and in those held out; none is, where one that could stand in the place of
 * another is better than that. What the runs without a current show by themselves needs none of this. */
bool hci_is_unconfirmed(const hci_attribution *attribution, const hci_diagnosis *diagnosis,
                        const hci_verdict *verdict);

#endif
