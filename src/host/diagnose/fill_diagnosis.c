#include "host/diagnose/fill_diagnosis.h"

#include <math.h>

#include "host/base/memory.h"
#include "host/diagnose/candidates/empirical_term.h"
#include "host/diagnose/findings.h"
#include "host/diagnose/fit/model.h"
#include "host/diagnose/left_open.h"
#include "host/diagnose/prepare/drift.h"
#include "host/diagnose/prepare/swing_groups.h"
#include "host/diagnose/run_errors.h"
#include "host/diagnose/standing_torque.h"

#define REPEATED 0.1 /* of the square of what is left beside noise, that may differ from turn to turn */

/* ---- the corrected machine ---- */

static hci_status effects_fill(const hci_regression *e, const hci_candidates *candidates, hci_diagnosis *d,
                               hci_note *note)
{
    hci_model model;
    const hci_status status = hci_model_make(e->declared, candidates, false, &model, note);
    if (status) return status;
    d->effects = (hci_effects_data){model.list, model.effect, model.term};
    hci_memory_free(model.column);
    return HCI_OK;
}

/* ---- what was taken out of the recordings ---- */

static void swings_fill(const hci_binned_samples *samples, hci_diagnosis *d)
{
    const hci_swing_groups found = hci_swing_groups_find(samples->statistics, samples->run_count);
    d->swings = 0;
    for (size_t k = 0; k < found.count && d->swings < HCI_MOST_FREE_SWINGS; ++k) {
        const hci_swing_group *g = &found.group[k];
        d->swing[d->swings++] =
            (hci_free_swing){g->of_turn, g->frequency, g->error, g->amplitude_Nm, g->runs};
    }
}

static void drifts_fill(const hci_binned_samples *samples, hci_diagnosis *d)
{
    d->drifts = 0;
    d->drift_Nm = 0.0;
    for (size_t r = 0; r < samples->run_count; ++r) {
        const double drift_Nm = hci_drift_peak_to_peak_Nm(&samples->statistics[r].drift);
        d->drifts += drift_Nm > 0.0;
        d->drift_Nm = fmax(d->drift_Nm, drift_Nm);
    }
}

static void zeros_fill(const hci_binned_samples *samples, hci_diagnosis *d)
{
    d->zeros_read = 0;
    d->zeros_read_A = 0.0;
    d->only_noise = 0;
    for (size_t r = 0; r < samples->run_count; ++r) {
        const hci_run_statistics *x = &samples->statistics[r];
        d->only_noise += x->no_current && !x->zeros_read;
        if (!x->zeros_read) continue;
        ++d->zeros_read;
        for (size_t s = 0; s < 3; ++s)
            d->zeros_read_A = fmax(d->zeros_read_A, fabs(x->standing_A[s]));
    }
}

/* Whether a part of what is left, beside the noise between the orders, differs from turn to turn. Of too few
 * turns to tell nothing is denied. */
static bool is_unrepeated(const hci_diagnosis *d)
{
    double left = 0.0, apart = 0.0;
    bool known = false;
    for (size_t k = 0; k < d->runs; ++k) {
        const hci_run_errors *e = &d->run[k];
        if (e->role != HCI_ROLE_FIT || !isfinite(e->unrepeated_Nm)) continue;
        known = true;
        left += e->rms_after_Nm * e->rms_after_Nm - e->noise_floor_Nm * e->noise_floor_Nm;
        apart += e->unrepeated_Nm * e->unrepeated_Nm;
    }
    return !known || apart > REPEATED * (left + apart);
}

#define HELD 0.02 /* electrical turns that a shaft moves by which is held */

/* Whether a run turns, or is of means over turns. */
bool hci_any_turns(const hci_dataset *b, const hci_runs *runs)
{
    for (size_t k = 0; k < runs->count; ++k)
        if (b->fit[k] && (runs->run[k].only_mean ||
                          b->samples.statistics[k].turns * b->regression.machine->pole_pairs > HELD))
            return true;
    return false;
}

/* ---- means that are not understood ---- */

#define MUCH_OF_TORQUE 0.15 /* of the largest torque, that nothing explains */
#define OF_CURRENT     0.1  /* of the current, along d */

/* Where a current along d flowed, much that is left of the means is a saliency or iron that saturates, and
 * the ripple at other currents is not known with them. */
static bool means_are_of_iron(const hci_dataset *b, const hci_attribution *a)
{
    bool direct = false;
    for (size_t r = 0; r < b->samples.run_count; ++r) {
        const hci_run_statistics *x = &b->samples.statistics[r];
        direct = direct || (b->fit[r] && x->rms_id_A > OF_CURRENT * x->current_A);
    }
    return direct && a->means_alone && a->unexplained_Nm > MUCH_OF_TORQUE * hci_dataset_range_of(b).torque_Nm;
}

/* ---- the whole ---- */

/* What no effect explains is described, and then leaves: it never gets into a machine. */
hci_status hci_diagnosis_fill(hci_dataset *b, const hci_runs *runs, hci_attribution *a, hci_diagnosis *d,
                              hci_note *note)
{
    if (hci_watch_stops(b->regression.watch)) a->ended = HCI_WORK_INTERRUPTED; /* perhaps in a fit */
    if (means_are_of_iron(b, a)) a->means_alone = false;
    d->search = a->ended;
    d->no_load_alone = a->no_load_alone;
    d->slip = a->unknown ? a->slip : NULL;
    d->not_searched = a->not_searched;
    d->disbelieved = a->disbelieved && a->unknown ? a->disbelieved->name : NULL;
    d->disbelieved_share = a->disbelieved_share;
    swings_fill(&b->samples, d);
    drifts_fill(&b->samples, d);
    zeros_fill(&b->samples, d);
    hci_unexplained_fill(b, a, d);
    hci_candidates_remove_type(&a->model.candidates, &hci_empirical_type);
    hci_status status = hci_standing_torque_judge(&b->regression, a, note);
    if (status) return status;
    status = effects_fill(&b->regression, &a->model.candidates, d, note);
    if (!status) status = hci_left_open_find(b, a, d, note);
    if (status == HCI_ERROR_STOPPED) { /* all else is known */
        d->search = a->ended = HCI_WORK_INTERRUPTED;
        status = HCI_OK;
    }
    if (!status) status = hci_run_errors_fill(b, runs, a->model.fit.parameters, d, note);
    if (!status) hci_findings_fill(a, d);
    d->wanders = d->wanders && is_unrepeated(d) && hci_any_turns(b, runs);
    return status;
}
