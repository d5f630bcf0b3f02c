#include "hci/host/diagnose/diagnose.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "hci/host/waveform/turning_load.h"
#include "host/base/memory.h"
#include "host/diagnose/candidates/empirical_term.h"
#include "host/diagnose/findings.h"
#include "host/diagnose/fit/dataset.h"
#include "host/diagnose/fit/model.h"
#include "host/diagnose/fit/standard_errors.h"
#include "host/diagnose/free_friction.h"
#include "host/diagnose/held_out.h"
#include "host/diagnose/next_points.h"
#include "host/diagnose/no_load_denied.h"
#include "host/diagnose/odd_run.h"
#include "host/diagnose/open_voltage.h"
#include "host/diagnose/prepare/drift.h"
#include "host/diagnose/prepare/swing_groups.h"
#include "host/diagnose/run_errors.h"
#include "host/diagnose/search/attribute.h"
#include "host/diagnose/search/backward.h"
#include "host/diagnose/standing_torque.h"
#include "host/diagnose/uncertainty.h"
#include "host/machine/torque_constant.h"
#include "host/numeric/statistics.h"
#include "host/waveform/sensor_zero.h"

#define RESOLUTION 5e-4 /* of the largest rms torque */
#define REPEATED   0.1  /* of the square of what is left beside noise, that may differ from turn to turn */
#define DROWNED    0.25 /* of the torque of interest: noise beside which nothing is complete */
#define FURTHER    4.0  /* times its limit, that a search takes next */
#define SUSPICION  0.35 /* of the limit of work, that a search without a run may take that is suspected */
#define AGAINST    0.05 /* of the torque per ampere, that voltages which agree to 2 % exclude */

const char *hci_finding_verdict_name(hci_finding_verdict verdict)
{
    static const char *const NAMES[] = {"added", "ambiguous", "rejected"};
    return NAMES[verdict];
}

const char *hci_diagnosis_verdict_name(hci_diagnosis_verdict verdict)
{
    static const char *const NAMES[] = {"complete", "explained", "ambiguous", "partly explained", "unknown"};
    return NAMES[verdict];
}

const char *hci_diagnosis_search_name(hci_work_end end)
{
    static const char *const NAMES[] = {"complete", "interrupted", "limited"};
    return NAMES[end];
}

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

/* ---- the whole ---- */

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
static bool any_turns(const hci_dataset *b, const hci_runs *runs)
{
    for (size_t k = 0; k < runs->count; ++k)
        if (b->fit[k] && (runs->run[k].only_mean ||
                          b->samples.statistics[k].turns * b->regression.machine->pole_pairs > HELD))
            return true;
    return false;
}

/* The machine that each ambiguous effect would make of the recordings, where it is not the one that is
 * written down. */
static hci_alternatives alternatives_of(const hci_attribution *a)
{
    hci_alternatives x = {.count = 0};
    for (size_t r = 0; r < a->types && x.count < HCI_MOST_ALTERNATIVES; ++r) {
        const hci_verdict *v = &a->verdict[r];
        if (v->ambiguous && v->alternative.candidates.candidate)
            x.machine[x.count++] = &v->alternative.candidates;
    }
    return x;
}

/* Of the largest mean torque of a run, that is left of the mean of one. residual_Nm: of each sample. */
static double means_left(const hci_dataset *b, const double *residual_Nm)
{
    double left_Nm = 0.0, most_Nm = 0.0;
    for (size_t r = 0; r < b->samples.run_count; ++r) {
        double sum = 0.0, count = 0.0;
        if (!b->fit[r]) continue;
        for (const hci_segment *s = NULL; (s = hci_segment_next(&b->samples, r, s)) != NULL;)
            for (size_t k = s->first; k < s->first + s->count; ++k) {
                sum += b->samples.sample[k].count * residual_Nm[k];
                count += b->samples.sample[k].count;
            }
        if (count > 0.0) left_Nm = fmax(left_Nm, fabs(sum / count));
        most_Nm = fmax(most_Nm, fabs(b->samples.statistics[r].mean_torque_Nm));
    }
    return most_Nm > 0.0 ? left_Nm / most_Nm : 0.0;
}

/* Where nothing but the means of the runs is unknown, what the ripple tells, and a torque per ampere as open
 * as these means leave it. */
static hci_status open_beside_means(hci_dataset *b, const hci_attribution *a, hci_alternatives *others,
                                    hci_diagnosis *d, hci_note *note)
{
    double *residual_Nm = hci_memory_new(b->samples.count + 1, sizeof *residual_Nm);
    if (!residual_Nm) return hci_note_memory(note, NULL, "the errors of the recordings");
    hci_status status = hci_regression_residual(&b->regression, &d->effects.list, residual_Nm, note);
    if (!status) others->constant_share = means_left(b, residual_Nm);
    hci_memory_free(residual_Nm);
    if (status) return status;
    b->regression.free_means = true;
    status = hci_uncertainty_find(&b->regression, &a->model.candidates, others, &d->uncertainty, note);
    b->regression.free_means = false;
    return status;
}

/* What the recordings leave open. Of a model that had no rival, and beside something unknown, nothing is
 * stated. */
static hci_status left_open(hci_dataset *b, const hci_attribution *a, hci_diagnosis *d, hci_note *note)
{
    hci_alternatives others = alternatives_of(a);
    if (a->ended != HCI_WORK_COMPLETE) return HCI_OK;
    if (!a->unknown)
        return hci_uncertainty_find(&b->regression, &a->model.candidates, &others, &d->uncertainty, note);
    return a->means_alone && !d->contradicted ? open_beside_means(b, a, &others, d, note) : HCI_OK;
}

/* What no effect explains is described, and then leaves: it never gets into a machine. */
static hci_status fill(hci_dataset *b, const hci_runs *runs, hci_attribution *a, hci_diagnosis *d,
                       hci_note *note)
{
    if (hci_watch_stops(b->regression.watch)) a->ended = HCI_WORK_INTERRUPTED; /* perhaps in a fit */
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
    if (!status) status = left_open(b, a, d, note);
    if (status == HCI_ERROR_STOPPED) { /* all else is known */
        d->search = a->ended = HCI_WORK_INTERRUPTED;
        status = HCI_OK;
    }
    if (!status) status = hci_run_errors_fill(b, runs, a->model.fit.parameters, d, note);
    if (!status) hci_findings_fill(a, d);
    d->wanders = d->wanders && is_unrepeated(d) && any_turns(b, runs);
    return status;
}

/* ---- the test ---- */

static bool is_in(const hci_verdict *v)
{
    return v->in && v->type != &hci_empirical_type;
}

/* Whether all that is in was shown by the runs without a current alone. */
static bool is_established(const hci_attribution *a)
{
    bool any = false, all = true;
    for (size_t r = 0; r < a->types; ++r) {
        any = any || is_in(&a->verdict[r]);
        all = all && (!is_in(&a->verdict[r]) || a->verdict[r].established);
    }
    return any && all;
}

/* The model that is left, fitted anew; where only what the runs without a current show is left, as these do.
 */
static hci_status refit(hci_dataset *b, hci_attribution *a, hci_note *note)
{
    hci_candidates *model = &a->model.candidates;
    hci_candidates shown = {0};
    if (!is_established(a)) return hci_regression_fit(&b->regression, model, &a->model.fit, note);
    const hci_status status = hci_candidates_copy(&a->no_load.candidates, &shown, note);
    if (status) return status;
    hci_candidates_release(model);
    *model = shown;
    for (size_t r = 0; r < a->types; ++r)
        if (!a->verdict[r].in) hci_candidates_remove_type(model, a->verdict[r].type);
    a->no_load_alone = true;
    return HCI_OK;
}

/* What is left of the model describes the recordings anew, and the rest is unknown. */
static hci_status refill(hci_dataset *b, const hci_runs *runs, hci_attribution *a, hci_diagnosis *d,
                         hci_note *note)
{
    hci_status status = refit(b, a, note);
    a->unknown = true;
    for (int pass = 0; pass < 2 && !status; ++pass) { /* how much is unknown is known after the first */
        a->unexplained_Nm = sqrt(fmax(0.0, d->rms_after_Nm * d->rms_after_Nm - d->noise_Nm * d->noise_Nm));
        hci_diagnosis_release(d);
        d->contradicted = true;
        status = fill(b, runs, a, d, note);
    }
    return status;
}

/* Takes out the effects that the runs held out contradict, or all of them where they are contradicted by
 * those that are left too; not those that the runs without a current show by themselves. */
static hci_status withdraw(hci_dataset *b, const hci_runs *runs, hci_attribution *a, hci_diagnosis *d,
                           bool all, hci_note *note)
{
    hci_candidates *model = &a->model.candidates, kept = {0};
    hci_status status = hci_candidates_copy(model, &kept, note);
    if (!status && !all) status = hci_held_out_keep(b, runs, &kept, note);
    for (size_t r = 0; r < a->types && !status; ++r) {
        hci_verdict *v = &a->verdict[r];
        v->in = v->in && (v->established || (!all && hci_candidates_have(&kept, v->type)));
        if (!v->in) hci_candidates_remove_type(model, v->type);
        v->ambiguous = v->ambiguous && v->in;
    }
    hci_candidates_release(&kept);
    return status ? status : refill(b, runs, a, d, note);
}

/* Whether an effect is in that other runs than those without a current have to show. */
static bool has_more(const hci_attribution *a)
{
    for (size_t r = 0; r < a->types; ++r)
        if (is_in(&a->verdict[r]) && !a->verdict[r].established) return true;
    return false;
}

/* What the runs without a current show by themselves, too, where those held out are worse for it; not a
 * torque over the angle that nothing else makes without a current. */
static hci_status established_leave(hci_dataset *b, const hci_runs *runs, hci_attribution *a,
                                    hci_diagnosis *d, hci_note *note)
{
    const bool shown = hci_no_load_is_shown(b, runs, &a->model.candidates, d);
    for (size_t r = 0; r < a->types; ++r)
        a->verdict[r].established =
            a->verdict[r].established && shown && hci_no_load_is_asked(a->verdict[r].type);
    a->no_load_alone = false;
    return withdraw(b, runs, a, d, true, note);
}

static hci_status type_leaves(hci_dataset *b, hci_attribution *a, const hci_effect_type *type, hci_note *note)
{
    hci_candidates *model = &a->model.candidates;
    hci_candidates_remove_type(model, type);
    for (size_t r = 0; r < a->types; ++r)
        if (a->verdict[r].type == type) a->verdict[r].in = false;
    const hci_status status = hci_regression_fit(&b->regression, model, &a->model.fit, note);
    return status ? status : hci_regression_standard_errors(&b->regression, model, note);
}

/* Beside something unknown a series in the currents, which describes anything a little, is certain only where
 * it describes the runs held out. */
static hci_status series_leave(hci_dataset *b, const hci_runs *runs, hci_attribution *a, hci_diagnosis *d,
                               hci_note *note)
{
    const hci_effect_type *type = NULL;
    hci_status status = hci_held_out_idle_series(b, runs, a, &type, note);
    while (!status && type) {
        status = type_leaves(b, a, type, note);
        if (!status) status = refill(b, runs, a, d, note);
        if (!status) status = hci_held_out_idle_series(b, runs, a, &type, note);
    }
    return status;
}

/* Beside something unknown effects are certain only where the runs held out are no worse for them. */
static hci_status rising_leave(hci_dataset *b, const hci_runs *runs, hci_attribution *a, hci_diagnosis *d,
                               double resolution_Nm, hci_note *note)
{
    hci_status status = HCI_OK;
    for (int all = 0; all < 2 && !status && has_more(a); ++all)
        if (hci_held_out_rises(b, runs, d, resolution_Nm) || hci_held_out_rises_both(b, runs, d))
            status = withdraw(b, runs, a, d, all, note);
    if (!status && is_established(a) && hci_held_out_rises_both(b, runs, d))
        status = established_leave(b, runs, a, d, note);
    return status;
}

/* Where nothing else is understood, a torque over the angle that the runs without a current show leaves if
 * those under load deny it, or a sensor may make it; and with it an angle that is read wrong, which shows
 * there by that torque alone. */
static hci_status denied_leave(hci_dataset *b, const hci_runs *runs, hci_attribution *a, hci_diagnosis *d,
                               hci_note *note)
{
    bool asked = false;
    for (size_t r = 0; r < a->types; ++r)
        asked = asked || (is_in(&a->verdict[r]) && hci_no_load_is_asked(a->verdict[r].type));
    if (!asked || !d->no_load_alone) return HCI_OK;
    const char *why = hci_no_load_denied(b, runs, &a->model.candidates, d);
    d->no_load_against = !why && hci_no_load_rises(b, runs, d);
    if (!why) return HCI_OK;
    for (size_t r = 0; r < a->types; ++r) {
        hci_verdict *v = &a->verdict[r];
        if (!v->in || !(hci_no_load_is_asked(v->type) || v->type->keeps_currents)) continue;
        v->in = v->established = v->ambiguous = false;
        hci_candidates_remove_type(&a->model.candidates, v->type);
    }
    a->no_load_alone = is_established(a);
    const hci_status status = refill(b, runs, a, d, note);
    d->contradicted = false;
    d->no_load_denied = why;
    return status;
}

/* What the runs held out say of the effects. */
static hci_status test(hci_dataset *b, const hci_runs *runs, hci_attribution *a, hci_diagnosis *d,
                       double resolution_Nm, hci_note *note)
{
    hci_status status = HCI_OK;
    hci_held_out_result result = hci_held_out_judge(b, runs, d, resolution_Nm);
    for (int all = 0; all < 2 && result == HCI_HELD_OUT_CONTRADICTED && !status; ++all) {
        status = withdraw(b, runs, a, d, all, note);
        if (!status) result = hci_held_out_judge(b, runs, d, resolution_Nm);
    }
    if (status || d->contradicted || result == HCI_HELD_OUT_DESCRIBED) return status;
    d->verdict = HCI_DIAGNOSIS_PARTLY;
    hci_uncertainty_release(&d->uncertainty);
    return HCI_OK;
}

/* One that is not certain any more, now that others have left; NULL: none. */
static const hci_effect_type *unsure_of(const hci_attribution *a)
{
    for (size_t r = 0; r < a->types; ++r) {
        const hci_verdict *v = &a->verdict[r];
        if (!v->in || v->ambiguous || v->type->is_series) continue;
        if (hci_search_sureness(&a->model.candidates, v->type, a->model.fit.rows) < 0.0) return v->type;
    }
    return NULL;
}

/* Small effects that make the runs held out worse are terms that were found by chance, or describe what the
 * others get wrong. */
static hci_status misleading_leave(hci_dataset *b, const hci_runs *runs, hci_attribution *a, hci_note *note)
{
    const hci_effect_type *type = NULL;
    hci_status status = HCI_OK;
    for (bool any = false; !status; any = true) {
        status = hci_held_out_misleading(b, runs, a, &type, note);
        if (!status && !type && any) type = unsure_of(a);
        if (status || !type) break;
        status = type_leaves(b, a, type, note);
    }
    return status;
}

/* Whether the corrected machine has another torque per ampere, while open-circuit voltages, which are the
 * same figure, say that the declared one is right. */
static bool is_against_voltages(const hci_dataset *b, const hci_machine_data *machine, const hci_runs *runs,
                                const hci_diagnosis *d)
{
    const double declared = hci_torque_constant(&machine->model, b->regression.declared);
    const double corrected = hci_torque_constant(&machine->model, &d->effects.list);
    return fabs(corrected - declared) > AGAINST * fabs(declared) &&
           hci_open_voltage_agrees(&machine->model, runs);
}

/* The share by which the corrected torque per ampere is above what voltages without a current show. */
static double beyond_voltages(const hci_dataset *b, const hci_machine_data *machine, const hci_runs *runs,
                              const hci_diagnosis *d)
{
    const double declared = hci_torque_constant(&machine->model, b->regression.declared);
    const double corrected = hci_torque_constant(&machine->model, &d->effects.list);
    const double shown = declared * hci_open_voltage_scale(&machine->model, runs);
    return fabs(shown) > 0.0 ? corrected / shown - 1.0 : 0.0;
}

/* What is well above the noise is not complete, whatever the search said of it. */
static hci_status much_is_unknown(hci_dataset *b, const hci_runs *runs, double resolution_Nm,
                                  hci_attribution *a, hci_diagnosis *d, hci_note *note)
{
    if (d->verdict != HCI_DIAGNOSIS_COMPLETE || !hci_held_out_leaves_much(d, resolution_Nm)) return HCI_OK;
    const hci_status status = refill(b, runs, a, d, note);
    d->contradicted = false;
    return status;
}

/* Beside a noise as large as the torque that matters nothing is complete: what is small does not show. */
static void drowned_judge(const hci_dataset *b, const hci_machine_data *machine, hci_diagnosis *d)
{
    const double constant = fabs(b->regression.declared_constant);
    const double made_Nm = constant * hci_dataset_range_of(b).current_A;
    const double wanted_Nm = machine->rated_torque_Nm > 0.0 ? machine->rated_torque_Nm : made_Nm;
    if (d->verdict != HCI_DIAGNOSIS_COMPLETE || !(d->noise_Nm > DROWNED * wanted_Nm) || !(wanted_Nm > 0.0))
        return;
    d->verdict = HCI_DIAGNOSIS_UNKNOWN;
    d->drowned_Nm = wanted_Nm;
    hci_uncertainty_release(&d->uncertainty);
}

/* Takes out what a search that ended early has not confirmed, all at once: beside what each of them leaves
 * nothing else would be. */
static hci_status unconfirmed_leave(hci_dataset *b, const hci_runs *runs, hci_attribution *a,
                                    hci_diagnosis *d, hci_note *note)
{
    bool left = false;
    for (size_t r = 0; r < a->types; ++r) {
        hci_verdict *v = &a->verdict[r];
        if (!hci_is_unconfirmed(a, d, v)) continue;
        hci_candidates_remove_type(&a->model.candidates, v->type);
        v->in = v->ambiguous = false;
        left = true;
    }
    if (!left) return HCI_OK;
    const hci_status status = refill(b, runs, a, d, note);
    d->contradicted = false;
    return status;
}

/* What stays and what goes once the search has answered: d is what is said of it. */
static hci_status conclude(hci_dataset *b, const hci_machine_data *machine, const hci_runs *runs,
                           double resolution_Nm, hci_attribution *a, hci_diagnosis *d, hci_note *note)
{
    hci_status status = HCI_OK;
    if (!a->unknown && d->verdict != HCI_DIAGNOSIS_COMPLETE)
        status = test(b, runs, a, d, resolution_Nm, note);
    if (!status && a->unknown) status = series_leave(b, runs, a, d, note);
    if (!status && a->unknown) status = rising_leave(b, runs, a, d, resolution_Nm, note);
    if (!status && a->unknown) status = denied_leave(b, runs, a, d, note);
    if (!status) status = unconfirmed_leave(b, runs, a, d, note);
    if (!status && is_against_voltages(b, machine, runs, d)) {
        status = withdraw(b, runs, a, d, true, note);
        d->contradicted = false;
        d->against_voltages = true;
    }
    if (!status) d->beyond_voltages = beyond_voltages(b, machine, runs, d);
    return status;
}

/* What goes with the rotor and not in step with it, as a bearing does, may be of the motor: no effect
 * explains it. */
static void loose_swings_judge(hci_diagnosis *d)
{
    bool any = false;
    for (size_t k = 0; k < d->swings; ++k)
        any = any || (d->swing[k].of_turn && d->swing[k].runs > 1);
    if (!any || d->verdict > HCI_DIAGNOSIS_EXPLAINED) return;
    d->verdict = d->verdict == HCI_DIAGNOSIS_COMPLETE ? HCI_DIAGNOSIS_UNKNOWN : HCI_DIAGNOSIS_PARTLY;
    hci_uncertainty_release(&d->uncertainty);
}

/* A torque that drifts where the model lacks nothing else: whether the sensor does, or what brakes, no
 * recording says. */
static void drifts_judge(hci_diagnosis *d)
{
    if (d->drifts == 0 || d->verdict != HCI_DIAGNOSIS_COMPLETE) return;
    d->verdict = HCI_DIAGNOSIS_UNKNOWN;
    hci_finding_unknown_put(d, d->drift_Nm / sqrt(12.0), "that drifts, which was taken out");
    hci_uncertainty_release(&d->uncertainty);
}

/* What is to be diagnosed. */
typedef struct {
    const hci_machine_data *machine;
    const hci_effects *declared;
    const hci_runs *runs;
    const hci_diagnose_options *options;
    hci_dataset *dataset;        /* of these machine, effects and runs; NULL: to be made */
    hci_suspect *suspect;        /* that is not among the runs, and is tried on what they show; NULL: none */
    const hci_candidates *start; /* that the search goes on from; NULL: nothing */
    double work;                 /* of what the search may take, that counts as done before it begins */
} task;

/* With as much work as is wanted. */
static hci_status dataset_of(const task *t, const hci_effects *declared, hci_dataset *b, hci_note *note)
{
    const hci_status status = hci_dataset_make(t->machine, declared, t->runs, b, note);
    if (!status && t->options->work > 0.0) b->regression.work_times *= t->options->work;
    return status;
}

/* What is shown is kept: the search of all runs goes on from there. */
static hci_status look_at(void *context, const hci_candidates *model, const hci_effects *effects,
                          hci_note *note)
{
    hci_suspect *s = context;
    hci_candidates shown;
    const hci_status status = hci_candidates_copy(model, &shown, note);
    if (status) return status;
    hci_candidates_release(&s->shown);
    s->shown = shown;
    return hci_suspect_ask(s, effects, note);
}

/* What changes the torque by less than a share of its range is nothing. */
static double resolution_of(const hci_dataset *b, const task *t)
{
    const double share = t->options->resolution > 0.0 ? t->options->resolution : RESOLUTION;
    return share * hci_dataset_range_of(b).torque_Nm;
}

static hci_attribute_options how_to(const hci_dataset *b, const task *t)
{
    return (hci_attribute_options){t->runs->run,
                                   resolution_of(b, t),
                                   t->machine->rated_current_A,
                                   t->machine->slots > 0.0 ? (size_t)t->machine->slots : 0,
                                   t->machine->has_neutral,
                                   t->options->progress,
                                   t->options->progress_context,
                                   t->options->slip,
                                   t->options->slip_context,
                                   t->suspect ? look_at : NULL,
                                   t->suspect,
                                   t->suspect != NULL,
                                   t->start};
}

/* From what the search found to the verdict. */
static hci_status judge(hci_dataset *b, const task *t, hci_attribution *a, hci_diagnosis *d, hci_note *note)
{
    const double resolution_Nm = resolution_of(b, t);
    d->resolution_Nm = resolution_Nm;
    hci_status status = a->unknown ? HCI_OK : misleading_leave(b, t->runs, a, note);
    if (!status) status = hci_next_points_tell_apart(&b->regression, t->machine, a, d, note);
    if (!status) status = fill(b, t->runs, a, d, note);
    if (!status) status = conclude(b, t->machine, t->runs, resolution_Nm, a, d, note);
    if (!status) status = much_is_unknown(b, t->runs, resolution_Nm, a, d, note);
    if (status) return status;
    drowned_judge(b, t->machine, d);
    loose_swings_judge(d);
    drifts_judge(d);
    return HCI_OK;
}

/* How to load a shaft that is held is not known. */
static hci_status propose_points(hci_dataset *b, const task *t, hci_diagnosis *d, hci_note *note)
{
    if (!any_turns(b, t->runs)) return HCI_OK;
    const hci_status status = hci_next_points_unknown(&b->regression, t->machine, d, note);
    return status ? status : hci_next_points_left_open(&b->regression, t->machine, d, note);
}

/* Whether nothing is left to be confirmed of a run that is only suspected: the others are not understood, or
 * what they show in the end makes it agree. */
static hci_status suspicion_ends(const hci_dataset *b, hci_suspect *suspect, const hci_attribution *a,
                                 hci_note *note)
{
    hci_model model;
    if (a->unknown || a->ended != HCI_WORK_COMPLETE) return HCI_ERROR_STOPPED;
    hci_status status = hci_model_make(b->regression.declared, &a->model.candidates, false, &model, note);
    if (status) return status;
    status = hci_suspect_ask(suspect, &model.list, note);
    hci_model_release(&model);
    return status;
}

static hci_status diagnose(hci_dataset *b, const task *t, hci_diagnosis *d, hci_note *note)
{
    const hci_attribute_options how = how_to(b, t);
    hci_watch watch = {t->options->stop, t->options->stop_context, how.progress, how.context, false};
    hci_attribution a;
    b->regression.watch = &watch;
    hci_status status = hci_attribute(&b->regression, &how, &a, note);
    if (t->suspect) t->suspect->work = b->work - t->work;
    if (status) return status;
    if (t->suspect) status = suspicion_ends(b, t->suspect, &a, note);
    if (!status) status = judge(b, t, &a, d, note);
    if (!status && !a.not_searched) status = propose_points(b, t, d, note);
    hci_attribution_release(&a);
    return status;
}

/* Over all recordings, of a ripple beside the mean of each. */
static double unexplained_ripple_Nm(const hci_diagnosis *d)
{
    double sum = 0.0, count = 0.0;
    for (size_t k = 0; k < d->runs; ++k) {
        const hci_run_errors *e = &d->run[k];
        const double square = e->ripple_after_Nm * e->ripple_after_Nm - e->noise_floor_Nm * e->noise_floor_Nm;
        if (!isfinite(square)) continue;
        sum += fmax(0.0, square);
        count += 1.0;
    }
    return count > 0.0 ? sqrt(sum / count) : (double)NAN;
}

#define STANDS_OUT 2.0 /* of what noise exceeds once in twenty times: it does once in 160 000 times */

/* Of the sum of many waves with phases by chance, peak to peak, to the root of the sum of their squares: 1.85
 * for 15 and 1.94 for 30 of them on the average. */
#define BY_CHANCE 1.9

/* The ripple, peak to peak, that repeats with the turn in a recording and is not in the model: what was
 * decisive and not taken, and what no effect describes. */
static double left_of_run_Nm(const hci_diagnosis *d, size_t run)
{
    double sum = 0.0, square = 0.0;
    for (size_t k = 0; k < d->lines; ++k) {
        const hci_residual_line *l = &d->line[k];
        if (l->run != run || l->order <= HCI_ORDER_TOLERANCE || l->after_Nm <= STANDS_OUT * l->noise_Nm)
            continue;
        sum += 2.0 * l->after_Nm;
        square += 4.0 * l->after_Nm * l->after_Nm;
    }
    return fmin(sum, BY_CHANCE * sqrt(square));
}

/* The median over the recordings: of one alone, as of the largest current, most currents have less. */
static hci_status left_orders_find(const hci_diagnosis *d, double *left_Nm, hci_note *note)
{
    const size_t runs = d->runs + (d->odd.file != NULL); /* one that disagrees keeps its number */
    double *of_run = hci_memory_new(runs + 1, sizeof *of_run);
    *left_Nm = 0.0;
    if (!of_run) return hci_note_memory(note, NULL, "what the model leaves");
    for (size_t r = 0; r < runs; ++r)
        of_run[r] = left_of_run_Nm(d, r);
    if (runs > 0) *left_Nm = hci_median(of_run, runs);
    hci_memory_free(of_run);
    return HCI_OK;
}

/* Of the runs that were fitted, rms. */
static double means_left_Nm(const hci_diagnosis *d)
{
    double sum = 0.0, count = 0.0;
    for (size_t r = 0; r < d->runs; ++r) {
        if (d->run[r].role != HCI_ROLE_FIT || !isfinite(d->run[r].error_mean_after_Nm)) continue;
        sum += pow(d->run[r].error_mean_after_Nm, 2.0);
        count += 1.0;
    }
    return count > 0.0 ? sqrt(sum / count) : 0.0;
}

/* Goes with the corrected machine, whether or not anything is stated of it. */
static hci_status origin_fill(const task *t, hci_diagnosis *d, hci_note *note)
{
    hci_machine_origin *origin = &d->uncertainty.origin;
    snprintf(origin->verdict, sizeof origin->verdict, "%s", hci_diagnosis_verdict_name(d->verdict));
    snprintf(origin->search, sizeof origin->search, "%s", hci_diagnosis_search_name(d->search));
    origin->unexplained_Nm = unexplained_ripple_Nm(d);
    if (d->means_alone && d->uncertainty.machines > 0) origin->left_means_Nm = means_left_Nm(d);
    origin->constant_is_declared = d->held_constant_Nm_per_A > 0.0;
    origin->turning_load_Nm = hci_turning_load_Nm(&t->machine->model, &d->effects.list, t->runs);
    origin->sensor_zero_Nm =
        hci_sensor_zero_Nm(&t->machine->model, &d->effects.list, t->runs, d->zeros_read_A);
    return left_orders_find(d, &origin->left_Nm, note);
}

static bool is_usable(const hci_runs *runs, size_t k)
{
    const hci_run *r = &runs->run[k];
    return runs->role[k] == HCI_ROLE_FIT && r->torque_Nm && (r->theta_m_rad || r->only_mean) && r->i_A &&
           r->count > 0;
}

/* No run tells a torque: the machine stays as it is declared, and that is said. */
static hci_status nothing_measured(const hci_effects *declared, hci_diagnosis *d, hci_note *note)
{
    const hci_candidates none = {0};
    hci_model model;
    const hci_status status = hci_model_make(declared, &none, false, &model, note);
    if (status) return status;
    d->effects = (hci_effects_data){model.list, model.effect, model.term};
    hci_memory_free(model.column);
    d->verdict = HCI_DIAGNOSIS_UNKNOWN;
    d->nothing_measured = true;
    d->rms_before_Nm = d->rms_after_Nm = d->noise_Nm = NAN;
    d->holdout_before_Nm = d->holdout_after_Nm = d->holdout_noise_Nm = NAN;
    d->holdout_mean_before_Nm = d->holdout_mean_after_Nm = NAN;
    d->holdout_ripple_before_Nm = d->holdout_ripple_after_Nm = NAN;
    return HCI_NOT_REACHED;
}

static hci_status diagnose_with(hci_dataset *b, const task *t, hci_diagnosis *diagnosis, hci_note *note)
{
    b->work += t->work;
    const hci_status status = diagnose(b, t, diagnosis, note);
    if (status) hci_diagnosis_release(diagnosis);
    return status;
}

static hci_status diagnose_from(const task *t, hci_diagnosis *diagnosis, hci_note *note)
{
    hci_dataset b;
    if (t->dataset) return diagnose_with(t->dataset, t, diagnosis, note);
    hci_status status = dataset_of(t, t->declared, &b, note);
    if (status) return status;
    status = diagnose_with(&b, t, diagnosis, note);
    hci_dataset_release(&b);
    return status;
}

static hci_status tell(const hci_free_friction *friction, const hci_runs *runs, hci_diagnosis *diagnosis,
                       hci_note *note)
{
    const hci_status status = hci_free_friction_tell(friction, runs, diagnosis, note);
    if (status) hci_diagnosis_release(diagnosis);
    return status;
}

static bool any_usable(const hci_runs *runs)
{
    for (size_t k = 0; k < runs->count; ++k)
        if (is_usable(runs, k)) return true;
    return false;
}

static bool are_measured(const hci_runs *runs)
{
    for (size_t k = 0; k < runs->count; ++k)
        if (runs->run[k].torque_source != HCI_TORQUE_MEASURED) return false;
    return true;
}

/* Of the runs that tell a torque; friction of free shafts comes first. */
static hci_status diagnose_measured(const task *t, hci_diagnosis *diagnosis, hci_note *note)
{
    hci_free_friction friction = {0};
    task rest = *t;
    hci_status status = hci_free_friction_find(t->machine, t->declared, t->runs, &friction, note);
    if (!status && !any_usable(&friction.rest)) { /* what accelerates them was a load */
        hci_free_friction_release(&friction);
        return nothing_measured(t->declared, diagnosis, note);
    }
    if (friction.law.terms > 0) rest.declared = &friction.effects.list;
    rest.runs = &friction.rest;
    if (!are_measured(t->runs)) rest.dataset = NULL; /* of runs that may be other ones now */
    if (!status) status = diagnose_from(&rest, diagnosis, note);
    if (!status) status = tell(&friction, t->runs, diagnosis, note);
    hci_free_friction_release(&friction);
    if (!status && hci_constant_is_held(t->runs))
        diagnosis->held_constant_Nm_per_A = hci_torque_constant(&t->machine->model, t->declared);
    return status;
}

static size_t unknown_loads_of(const hci_runs *runs)
{
    size_t count = 0;
    for (size_t k = 0; k < runs->count; ++k)
        count += runs->role[k] == HCI_ROLE_FIT && runs->run[k].torque_source == HCI_TORQUE_HOLDING &&
                 runs->run[k].mean_is_unknown;
    return count;
}

/* All but what a run that disagrees with the others says. */
static hci_status diagnose_all(const task *t, hci_diagnosis *diagnosis, hci_note *note)
{
    const hci_status status = any_usable(t->runs) ? diagnose_measured(t, diagnosis, note)
                                                  : nothing_measured(t->declared, diagnosis, note);
    if (status > HCI_NOT_REACHED) return status;
    diagnosis->open_voltage_off = hci_open_voltage_off(&t->machine->model, t->runs);
    if (diagnosis->open_voltage_off > HCI_OPEN_VOLTAGE_OFF && diagnosis->verdict == HCI_DIAGNOSIS_COMPLETE)
        diagnosis->verdict = HCI_DIAGNOSIS_UNKNOWN;
    diagnosis->unknown_loads = unknown_loads_of(t->runs);
    if (diagnosis->unknown_loads > 0 && diagnosis->verdict == HCI_DIAGNOSIS_COMPLETE)
        diagnosis->verdict = HCI_DIAGNOSIS_UNKNOWN; /* of the ripple alone nothing is missing */
    return HCI_OK;
}

/* ---- one run that disagrees ---- */

/* The runs without one, which stay those of `runs`. rest: arrays to be freed. Index of that one. */
static hci_status take_out(const hci_runs *runs, const char *file, hci_runs *rest, size_t *index,
                           hci_note *note)
{
    *rest = (hci_runs){.run = hci_memory_new(runs->count + 1, sizeof *rest->run),
                       .role = hci_memory_new(runs->count + 1, sizeof *rest->role),
                       .list = runs->list};
    for (size_t k = 0; rest->run && rest->role && k < runs->count; ++k) {
        if (runs->run[k].name == file) {
            *index = k;
            continue;
        }
        rest->run[rest->count] = runs->run[k];
        rest->role[rest->count++] = runs->role[k];
    }
    return rest->run && rest->role ? HCI_OK : hci_note_memory(note, NULL, "the recordings");
}

/* Whether the others are understood, and this run is the one that disagrees with them then too. */
static hci_status confirm(const task *t, const hci_diagnosis *d, hci_odd_run *odd, bool *certain,
                          hci_note *note)
{
    hci_odd_run again;
    hci_dataset b;
    if (*certain || d->search != HCI_WORK_COMPLETE || d->verdict > HCI_DIAGNOSIS_AMBIGUOUS) return HCI_OK;
    hci_status status = dataset_of(t, &d->effects.list, &b, note);
    if (status) return status;
    status = hci_odd_run_find(t->machine, &b, t->runs, &again, certain, note);
    hci_dataset_release(&b);
    *certain = *certain && again.file == odd->file;
    if (*certain) *odd = again;
    return status;
}

/* Of the others, where one disagrees; *certain: it does. */
static hci_status diagnose_others(const task *t, hci_odd_run *odd, bool *certain, hci_diagnosis *d,
                                  hci_note *note)
{
    hci_runs rest;
    size_t index = 0;
    task others = *t;
    others.runs = &rest;
    others.dataset = NULL;
    hci_status status = take_out(t->runs, odd->file, &rest, &index, note);
    if (!status) status = diagnose_all(&others, d, note);
    if (!status) status = confirm(t, d, odd, certain, note);
    if (!status && *certain) d->odd = *odd;
    for (size_t k = 0; !status && k < d->lines; ++k)
        d->line[k].run += d->line[k].run >= index;
    if (status || !*certain) hci_diagnosis_release(d);
    hci_memory_free(rest.run);
    hci_memory_free(rest.role);
    return status;
}

/* Where a run is only suspected: as soon as what the others show makes it agree, no more is asked of them,
 * and the search of all of them goes on from there. */
static hci_status suspicion_try(const task *t, hci_odd_run *odd, hci_diagnosis *d, hci_note *note)
{
    hci_suspect suspect;
    bool certain = false;
    task others = *t, all = *t;
    hci_status status = hci_suspect_make(t->machine, t->declared, t->runs, odd->file, &suspect, note);
    if (status) return status;
    others.suspect = &suspect;
    others.work = (1.0 - SUSPICION) * HCI_MOST_WORK;
    status = diagnose_others(&others, odd, &certain, d, note);
    if (status == HCI_ERROR_STOPPED) status = HCI_OK;
    if (!suspect.untold) {
        all.start = &suspect.shown;
        all.work = suspect.work;
    }
    if (!status && !certain) status = diagnose_all(&all, d, note);
    hci_suspect_release(&suspect);
    return status;
}

static hci_status diagnose_any(const task *t, hci_diagnosis *d, hci_note *note)
{
    hci_odd_run odd;
    bool certain = false;
    hci_status status = hci_odd_run_find(t->machine, t->dataset, t->runs, &odd, &certain, note);
    if (status) return status;
    if (!odd.file) return diagnose_all(t, d, note);
    return certain ? diagnose_others(t, &odd, &certain, d, note) : suspicion_try(t, &odd, d, note);
}

/* Of all runs, or of all but one that disagrees. */
static hci_status diagnose_runs(const task *t, hci_diagnosis *d, hci_note *note)
{
    hci_dataset b;
    task all = *t;
    if (!hci_odd_run_is_asked(t->runs)) return diagnose_all(t, d, note);
    hci_status status = dataset_of(t, t->declared, &b, note);
    if (status) return status;
    all.dataset = &b;
    status = diagnose_any(&all, d, note);
    hci_dataset_release(&b);
    return status;
}

hci_status hci_diagnose(const hci_machine_data *machine, const hci_effects *declared, const hci_runs *runs,
                        const hci_diagnose_options *options, hci_diagnosis *diagnosis, hci_note *note)
{
    size_t fitted = 0;
    memset(diagnosis, 0, sizeof *diagnosis);
    for (size_t k = 0; k < runs->count; ++k)
        fitted += runs->role[k] == HCI_ROLE_FIT;
    if (fitted == 0)
        return hci_note_set(note, HCI_ERROR_INPUT, "no run has the role `fit`; give it to at least one");
    const task all = {machine, declared, runs, options, NULL, NULL, NULL, 0.0};
    hci_status status = diagnose_runs(&all, diagnosis, note);
    if (!status) status = origin_fill(&all, diagnosis, note);
    diagnosis->further_work = FURTHER * fmax(1.0, options->work);
    if (status) {
        hci_diagnosis_release(diagnosis);
        return status;
    }
    return diagnosis->verdict >= HCI_DIAGNOSIS_AMBIGUOUS || diagnosis->search != HCI_WORK_COMPLETE ||
                   diagnosis->odd.file
               ? HCI_NOT_REACHED
               : HCI_OK;
}

void hci_diagnosis_release(hci_diagnosis *d)
{
    hci_effects_release(&d->effects);
    hci_uncertainty_release(&d->uncertainty);
    hci_memory_free(d->run);
    hci_memory_free(d->line);
    memset(d, 0, sizeof *d);
}
