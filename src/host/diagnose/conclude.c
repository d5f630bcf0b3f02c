#include "host/diagnose/conclude.h"

#include <math.h>

#include "host/diagnose/candidates/empirical_term.h"
#include "host/diagnose/fill_diagnosis.h"
#include "host/diagnose/findings.h"
#include "host/diagnose/fit/standard_errors.h"
#include "host/diagnose/held_out.h"
#include "host/diagnose/next_points.h"
#include "host/diagnose/no_load_denied.h"
#include "host/diagnose/open_voltage.h"
#include "host/diagnose/search/backward.h"
#include "host/machine/torque_constant.h"

#define DROWNED 0.25 /* of the torque of interest: noise beside which nothing is complete */

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
        const double resolution_Nm = d->resolution_Nm;
        hci_diagnosis_release(d);
        d->resolution_Nm = resolution_Nm;
        d->contradicted = true;
        status = hci_diagnosis_fill(b, runs, a, d, note);
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
    return fabs(corrected - declared) > HCI_CONSTANT_OFF * fabs(declared) &&
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
static hci_status judge(hci_dataset *b, const hci_machine_data *machine, const hci_runs *runs,
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

/* From what the search found to the verdict. */
hci_status hci_conclude(hci_dataset *b, const hci_machine_data *machine, const hci_runs *runs,
                        hci_attribution *a, hci_diagnosis *d, hci_note *note)
{
    const double resolution_Nm = d->resolution_Nm;
    hci_status status = a->unknown ? HCI_OK : misleading_leave(b, runs, a, note);
    if (!status) status = hci_next_points_tell_apart(&b->regression, machine, a, d, note);
    if (!status) status = hci_diagnosis_fill(b, runs, a, d, note);
    if (!status) status = judge(b, machine, runs, resolution_Nm, a, d, note);
    if (!status) status = much_is_unknown(b, runs, resolution_Nm, a, d, note);
    if (status) return status;
    drowned_judge(b, machine, d);
    loose_swings_judge(d);
    drifts_judge(d);
    return HCI_OK;
}
