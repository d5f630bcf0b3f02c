#include "host/diagnose/uncertainty.h"

#include <math.h>
#include <string.h>

#include "host/base/memory.h"
#include "host/diagnose/allowed_terms.h"
#include "host/diagnose/fit/linearise.h"
#include "host/diagnose/fit/model.h"
#include "host/numeric/ridge.h"
#include "host/recording/rotor_frame.h"

enum { LEAST_RUNS = 3, MACHINES = 200, SEED = 1 };

/* Widths of the expectation that are tried, in units of the noise, the widest first. */
static const double WIDTHS[] = {300.0, 100.0, 30.0, 10.0, 3.0, 1.0, 0.3, 0.1, 0.03, 0.01, 0.003};

enum { WIDTH_COUNT = sizeof WIDTHS / sizeof *WIDTHS, MOST_WORSE = 2 };

/* A width is refused where it describes runs left out worse than the best one by more than this in χ²: what
 * one parameter does by chance once in twenty times. */
#define AS_GOOD 4.0

typedef struct {
    hci_regression *regression;
    hci_allowed_terms terms;
    hci_condensed runs;
    size_t *run;              /* of each group: its place in the list of runs */
    double *precision;        /* [terms] */
    hci_ridge ridge;          /* of the width that is chosen */
    hci_left_out_group *left; /* of each group, and as many behind them of work */
} finding;

/* ---- recordings, one by one ---- */

static hci_status run_add(void *context, size_t run, hci_note *note)
{
    finding *f = context;
    hci_normal_equations normal;
    const hci_status status = hci_regression_normal(f->regression, &f->terms.candidates, true, &normal, note);
    if (status) return status;
    const bool told = normal.rows > 0.0;
    const bool made = !told || hci_condensed_add(&f->runs, &normal, f->terms.unit);
    hci_normal_equations_release(&normal);
    if (!made) return hci_note_memory(note, NULL, "what recordings leave open");
    if (told) f->run[f->runs.count - 1] = run;
    return HCI_OK;
}

/* ---- how wide ---- */

/* −2 log of the likelihood of runs left out, each with a noise of its own. */
static double misfit_of(const finding *f, const hci_left_out_group *left)
{
    double sum = 0.0;
    for (size_t g = 0; g < f->runs.count; ++g)
        sum += f->runs.group[g].rows * log(left[g].square);
    return isnan(sum) ? (double)INFINITY : sum;
}

/* ridge: out; *misfit: INFINITY where there is none. */
static hci_status width_try(const finding *f, double width, hci_ridge *ridge, hci_left_out_group *left,
                            double *misfit, hci_note *note)
{
    const hci_expectation expected = {f->precision, f->terms.centre};
    *misfit = INFINITY;
    hci_allowed_terms_precision(&f->terms, width, f->precision);
    if (!hci_ridge_make(&f->runs, &expected, ridge)) return HCI_OK;
    if (!hci_ridge_leave_out(ridge, &f->runs, left)) return hci_note_memory(note, NULL, "leaving runs out");
    *misfit = misfit_of(f, left);
    return HCI_OK;
}

/* Keeps a ridge with what leaving out told of it. */
static void width_keep(finding *f, hci_ridge *next)
{
    hci_ridge_release(&f->ridge);
    f->ridge = *next;
    memset(next, 0, sizeof *next);
    memcpy(f->left, f->left + f->runs.count, f->runs.count * sizeof *f->left);
}

/* The widest expectation that describes runs left out as well as any narrower one; none narrower is looked at
 * behind two that describe them worse. */
static hci_status width_choose(finding *f, hci_note *note)
{
    double kept = INFINITY;
    int worse = 0;
    hci_status status = HCI_OK;
    for (size_t w = 0; w < WIDTH_COUNT && worse < MOST_WORSE && !status; ++w) {
        hci_ridge next = {0};
        double misfit;
        status = width_try(f, WIDTHS[w], &next, f->left + f->runs.count, &misfit, note);
        worse = isfinite(misfit) && misfit > kept + AS_GOOD ? worse + 1 : 0;
        if (!status && misfit + AS_GOOD < kept) {
            width_keep(f, &next);
            kept = misfit;
        }
        hci_ridge_release(&next);
    }
    return status;
}

/* ---- what was measured ---- */

static void range_add(hci_measured_range *range, double value)
{
    range->least = fmin(range->least, value);
    range->most = fmax(range->most, value);
}

static hci_status measured_fill(const finding *f, const hci_effects *effects, size_t run,
                                hci_measured_run *out, hci_note *note)
{
    const hci_regression *e = f->regression;
    const hci_measured_range none = {NAN, NAN};
    const char *name = e->runs[run].name;
    const bool moves = e->runs[run].speed_rad_per_s != NULL;
    *out = (hci_measured_run){hci_memory_new(strlen(name) + 1, 1), none, none, none, NAN};
    if (!out->file) return hci_note_memory(note, NULL, "what recordings leave open");
    memcpy(out->file, name, strlen(name) + 1);
    for (const hci_segment *s = NULL; (s = hci_segment_next(e->samples, run, s)) != NULL;)
        for (size_t k = s->first; k < s->first + s->count; ++k) {
            const hci_sample truth =
                hci_effects_undo(effects, e->machine->pole_pairs, &e->samples->sample[k].reading);
            const hci_dq i = hci_sample_dq(&truth, e->machine->pole_pairs);
            range_add(&out->id_A, i.d);
            range_add(&out->iq_A, i.q);
            if (moves) range_add(&out->speed_rad_per_s, truth.speed_rad_per_s);
        }
    return HCI_OK;
}

/* ---- machines that are allowed ---- */

/* Mean of s² over the runs that tell of it, and how many these are. */
static double scale_square(const finding *f, size_t *count)
{
    double sum = 0.0;
    *count = 0;
    for (size_t g = 0; g < f->runs.count; ++g)
        if (isfinite(f->left[g].misfit)) {
            sum += f->left[g].misfit;
            ++*count;
        }
    return *count > 0 ? sum / (double)*count : (double)NAN;
}

/* s of the group that tells of it behind place `at`, around and around. */
static double next_scale(const finding *f, size_t *at)
{
    do
        *at = (*at + 1) % f->runs.count;
    while (!isfinite(f->left[*at].misfit));
    return sqrt(fmax(0.0, f->left[*at].misfit));
}

/* Departures of all machines: errors of the size that one run after the other has shown, and more, since few
 * runs may have shown too little. */
static hci_status machines_draw(const finding *f, const hci_model *model, size_t told, hci_uncertainty *u,
                                hci_note *note)
{
    hci_draws draws = {SEED};
    size_t at = 0;
    double *x = hci_memory_new(model->columns + 1, sizeof *x);
    if (!x) return hci_note_memory(note, NULL, "what recordings leave open");
    for (size_t m = 0; m < u->machines; ++m) {
        const double s = next_scale(f, &at) * hci_draws_student_scale(&draws, (unsigned)told - 1);
        hci_ridge_draw(&f->ridge, s, &draws, x);
        for (size_t c = 0; c < model->columns; ++c)
            u->departure[model->column[c].place * u->machines + m] = x[c];
    }
    hci_memory_free(x);
    return HCI_OK;
}

static hci_status uncertainty_fill(const finding *f, double scale, size_t told, hci_uncertainty *u,
                                   hci_note *note)
{
    hci_model model;
    hci_status status = hci_model_make(f->regression->declared, &f->terms.candidates, true, &model, note);
    if (status) return status;
    u->effects = (hci_effects_data){model.list, model.effect, model.term};
    status = hci_uncertainty_reserve(u, f->runs.count, MACHINES, note);
    for (size_t g = 0; g < f->runs.count && !status; ++g) {
        status = measured_fill(f, &model.list, f->run[g], &u->run[g], note);
        u->run[g].misfit = sqrt(f->left[g].misfit / scale);
    }
    if (!status) status = machines_draw(f, &model, told, u, note);
    hci_memory_free(model.column);
    return status;
}

/* ---- all of it ---- */

static hci_status finding_make(finding *f, const hci_candidates *fitted, hci_note *note)
{
    const size_t runs = f->regression->samples->run_count;
    hci_status status = hci_allowed_terms_make(f->regression, fitted, &f->terms, note);
    if (status) return status;
    f->run = hci_memory_new(runs + 1, sizeof *f->run);
    f->left = hci_memory_new(2 * runs + 1, sizeof *f->left);
    f->precision = hci_memory_new(f->terms.count + 1, sizeof *f->precision);
    if (!f->run || !f->left || !f->precision || !hci_condensed_start(&f->runs, f->terms.count, runs))
        return hci_note_memory(note, NULL, "what recordings leave open");
    return hci_regression_each_run(f->regression, run_add, f, note);
}

static void finding_release(finding *f)
{
    hci_ridge_release(&f->ridge);
    hci_condensed_release(&f->runs);
    hci_allowed_terms_release(&f->terms);
    hci_memory_free(f->run);
    hci_memory_free(f->left);
    hci_memory_free(f->precision);
}

hci_status hci_uncertainty_find(hci_regression *regression, const hci_candidates *fitted,
                                hci_uncertainty *uncertainty, hci_note *note)
{
    finding f = {.regression = regression};
    size_t told = 0;
    memset(uncertainty, 0, sizeof *uncertainty);
    hci_status status = finding_make(&f, fitted, note);
    if (!status && f.runs.count >= LEAST_RUNS) status = width_choose(&f, note);
    const double scale = !status && f.ridge.factor ? scale_square(&f, &told) : (double)NAN;
    if (!status && scale > 0.0 && told >= LEAST_RUNS)
        status = uncertainty_fill(&f, scale, told, uncertainty, note);
    finding_release(&f);
    if (status) hci_uncertainty_release(uncertainty);
    return status;
}
