#include "hci/host/diagnose/diagnose.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "host/base/memory.h"
#include "host/diagnose/candidates/empirical_term.h"
#include "host/diagnose/findings.h"
#include "host/diagnose/fit/dataset.h"
#include "host/diagnose/fit/model.h"
#include "host/diagnose/next_points.h"
#include "host/diagnose/run_errors.h"
#include "host/diagnose/search/attribute.h"
#include "host/diagnose/uncertainty.h"
#include "host/recording/free_shaft.h"

#define RESOLUTION 5e-4 /* of the largest rms torque */

#define BEYOND        1.05 /* of the largest current and speed fitted: beyond it a run is no test */
#define NOISY         1.5  /* error of a run held out, over its noise … */
#define COARSE        4.0  /* … or over the resolution, that speaks against the effects … */
#define HARDLY_BETTER 0.5  /* … unless it is less than this share of the error without them */
#define NEARLY_ALL    0.1  /* share of an error that is next to nothing beside what it was */
#define STAYS         0.95 /* share of an error that has not fallen */

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

/* What no effect explains is described, and then leaves: it never gets into a machine. */
static hci_status fill(hci_dataset *b, const hci_runs *runs, hci_attribution *a, hci_diagnosis *d,
                       hci_note *note)
{
    d->search = a->ended;
    d->disbelieved = a->disbelieved && a->unknown ? a->disbelieved->name : NULL;
    d->disbelieved_share = a->disbelieved_share;
    hci_unexplained_fill(b, a, d);
    hci_candidates_remove_type(&a->model.candidates, &hci_empirical_type);
    hci_status status = effects_fill(&b->regression, &a->model.candidates, d, note);
    if (!status && !a->unknown)
        status = hci_uncertainty_find(&b->regression, &a->model.candidates, &d->uncertainty, note);
    if (!status) status = hci_run_errors_fill(b, runs, a->model.fit.parameters, d, note);
    if (!status) hci_findings_fill(a, d);
    return status;
}

/* ---- the test ---- */

/* Whether a run is within the currents and speeds of those that were fitted. */
static bool is_within(const hci_run_statistics *f, const hci_dataset *b)
{
    double most_A = 0.0, most_speed = 0.0;
    for (size_t r = 0; r < b->samples.run_count; ++r) {
        if (!b->fit[r]) continue;
        most_A = fmax(most_A, b->samples.statistics[r].current_A);
        most_speed = fmax(most_speed, fabs(b->samples.statistics[r].mean_speed_rad_per_s));
    }
    return f->current_A <= BEYOND * most_A && fabs(f->mean_speed_rad_per_s) <= BEYOND * most_speed;
}

/* Errors of the runs held out that a fit could describe, as mean squares over runs. */
typedef struct {
    double before, after;
    double allowed; /* what noise and resolution may leave */
} test_errors;

static test_errors test_errors_of(const hci_dataset *b, const hci_runs *runs, const hci_diagnosis *d,
                                  double resolution_Nm)
{
    test_errors x = {0};
    for (size_t k = 0, run = 0; k < runs->count && run < d->runs; ++k) {
        const hci_run_errors *e = &d->run[run];
        if (e->file != runs->run[k].name) continue;
        ++run;
        if (e->role == HCI_ROLE_FIT || !is_within(&b->samples.statistics[k], b)) continue;
        x.before += e->rms_before_Nm * e->rms_before_Nm;
        x.after += e->rms_after_Nm * e->rms_after_Nm;
        x.allowed += fmax(pow(NOISY * e->noise_floor_Nm, 2.0), pow(COARSE * resolution_Nm, 2.0));
    }
    return x;
}

/* Down to the noise, or nearly. */
static bool is_described(const test_errors *x)
{
    return !(x->after > x->allowed) || x->after < NEARLY_ALL * NEARLY_ALL * x->before;
}

/* Whether the runs held out speak against the effects: they are not described down to their noise, and hardly
 * better than without. */
static bool is_contradicted(const test_errors *x)
{
    return !is_described(x) && x->after > HARDLY_BETTER * HARDLY_BETTER * x->before;
}

/* Whether something is left that the effects do not explain: the error held out is above the noise, or that
 * of currents and speeds beyond those that were fitted does not fall. */
static bool is_partial(const test_errors *x, const hci_diagnosis *d, double resolution_Nm)
{
    const double allowed_Nm = fmax(NOISY * d->holdout_noise_Nm, COARSE * resolution_Nm);
    const bool rises = d->holdout_after_Nm > allowed_Nm && !(d->holdout_after_Nm < d->holdout_before_Nm);
    const bool ripples = d->holdout_ripple_after_Nm > allowed_Nm &&
                         !(d->holdout_ripple_after_Nm < STAYS * d->holdout_ripple_before_Nm);
    return !is_described(x) || rises || ripples;
}

/* Takes the effects out again where the runs held out contradict them. */
static hci_status withdraw(hci_dataset *b, const hci_runs *runs, hci_attribution *a, hci_diagnosis *d,
                           hci_note *note)
{
    const double unexplained_Nm2 = d->rms_before_Nm * d->rms_before_Nm - d->noise_Nm * d->noise_Nm;
    for (size_t r = 0; r < a->types; ++r) {
        hci_candidates_remove_type(&a->model.candidates, a->verdict[r].type);
        a->verdict[r].in = a->verdict[r].ambiguous = false;
    }
    a->unknown = true;
    a->unexplained_Nm = sqrt(fmax(0.0, unexplained_Nm2));
    hci_diagnosis_release(d);
    d->contradicted = true;
    return fill(b, runs, a, d, note);
}

/* What the runs held out say of the effects. */
static hci_status test(hci_dataset *b, const hci_runs *runs, hci_attribution *a, hci_diagnosis *d,
                       double resolution_Nm, hci_note *note)
{
    const test_errors x = test_errors_of(b, runs, d, resolution_Nm);
    if (is_contradicted(&x)) return withdraw(b, runs, a, d, note);
    if (!is_partial(&x, d, resolution_Nm)) return HCI_OK;
    d->verdict = HCI_DIAGNOSIS_PARTLY;
    hci_uncertainty_release(&d->uncertainty);
    return HCI_OK;
}

static hci_status diagnose(hci_dataset *b, const hci_machine_data *machine, const hci_runs *runs,
                           const hci_diagnose_options *options, hci_diagnosis *d, hci_note *note)
{
    const double resolution = options->resolution > 0.0 ? options->resolution : RESOLUTION;
    const hci_attribute_options how = {runs->run,
                                       resolution * hci_dataset_range_of(b).torque_Nm,
                                       machine->rated_current_A,
                                       options->progress,
                                       options->progress_context,
                                       options->stop,
                                       options->stop_context};
    hci_attribution a;
    hci_status status = hci_attribute(&b->regression, &how, &a, note);
    if (status) return status;
    status = hci_next_points_tell_apart(&b->regression, machine, &a, d, note);
    if (!status) status = fill(b, runs, &a, d, note);
    if (!status && !a.unknown && d->verdict != HCI_DIAGNOSIS_COMPLETE)
        status = test(b, runs, &a, d, how.resolution_Nm, note);
    if (!status) status = hci_next_points_unknown(&b->regression, machine, d, note);
    hci_attribution_release(&a);
    return status;
}

static bool is_usable(const hci_runs *runs, size_t k)
{
    const hci_run *r = &runs->run[k];
    return runs->role[k] == HCI_ROLE_FIT && r->torque_Nm && r->theta_m_rad && r->count > 0;
}

hci_status hci_diagnose(const hci_machine_data *machine, const hci_effects *declared, const hci_runs *runs,
                        const hci_diagnose_options *options, hci_diagnosis *diagnosis, hci_note *note)
{
    hci_dataset b;
    size_t usable = 0;
    memset(diagnosis, 0, sizeof *diagnosis);
    for (size_t k = 0; k < runs->count; ++k)
        usable += is_usable(runs, k);
    if (usable == 0)
        return hci_note_set(note, HCI_ERROR_INPUT,
                            "no run with the role `fit` has an angle and a torque; add torque_Nm (0 for a "
                            "holding test), or `inertia` to machine.csv for a free shaft");
    hci_status status = hci_free_shafts_find(machine, declared, runs->run, runs->count, note);
    if (!status) status = hci_dataset_make(machine, declared, runs, &b, note);
    if (status) return status;
    status = diagnose(&b, machine, runs, options, diagnosis, note);
    hci_dataset_release(&b);
    if (status) {
        hci_diagnosis_release(diagnosis);
        return status;
    }
    return diagnosis->verdict >= HCI_DIAGNOSIS_AMBIGUOUS || diagnosis->search != HCI_WORK_COMPLETE
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
