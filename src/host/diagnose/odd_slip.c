#include "host/diagnose/odd_slip.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "hci/math/harmonic.h"
#include "host/base/memory.h"
#include "host/diagnose/fit/dataset.h"
#include "host/diagnose/reading/predicted_reading.h"
#include "host/diagnose/run_errors.h"

#define AT_NOISE 1.5 /* times its noise: an error that is none */
#define MENDED   0.3 /* share of its error that a slip leaves, where it is one */

enum { STEPS = 72, HALVINGS = 24 };

/* ---- slips of one file ---- */

typedef struct {
    const char *words;
    int swap[3];            /* phase that stands in place of a, b, c */
    double current, torque; /* factors that mend them */
} slip;

static const slip SLIPS[] = {
    {"phases b and c are swapped in its file", {0, 2, 1}, 1.0, 1.0},
    {"phases a and b are swapped in its file", {1, 0, 2}, 1.0, 1.0},
    {"phases a and c are swapped in its file", {2, 1, 0}, 1.0, 1.0},
    {"the phases of its file are shifted: a, b, c stand for b, c, a", {2, 0, 1}, 1.0, 1.0},
    {"the phases of its file are shifted: a, b, c stand for c, a, b", {1, 2, 0}, 1.0, 1.0},
    {"the torque of its file has the other sign", {0, 1, 2}, 1.0, -1.0},
    {"the currents of its file have the other sign", {0, 1, 2}, -1.0, 1.0},
    {"the torque of its file is 100 times too large (N·cm for N·m)", {0, 1, 2}, 1.0, 0.01},
    {"the torque of its file is 100 times too small", {0, 1, 2}, 1.0, 100.0},
    {"the torque of its file is 1000 times too large (mN·m for N·m)", {0, 1, 2}, 1.0, 0.001},
    {"the torque of its file is 1000 times too small (kN·m for N·m)", {0, 1, 2}, 1.0, 1000.0},
    {"the currents of its file are rms values", {0, 1, 2}, 1.4142135623730951, 1.0},
    {"the currents of its file are √2 too large", {0, 1, 2}, 0.70710678118654752, 1.0},
    {"the currents of its file are 1000 times too large (mA for A)", {0, 1, 2}, 0.001, 1.0}};

/* ---- errors ---- */

/* Ready to be mended in its samples. */
typedef struct {
    const hci_lone_run *lone;
    hci_run run;
    hci_role role;
    double rms_Nm;              /* its error as it stands */
    hci_dataset dataset;        /* of it alone */
    hci_binned_sample *as_read; /* its samples, [dataset.samples.count] */
    double best;                /* the least error so far, in units of rms_Nm */
} trial;

bool hci_error_is_noise(const hci_run_errors *e, double least_Nm)
{
    return e->rms_before_Nm <= fmax(AT_NOISE * e->noise_floor_Nm, least_Nm);
}

static hci_status errors_of(trial *t, hci_run_errors *e, hci_note *note)
{
    const hci_runs one = {.run = &t->run, .role = &t->role, .count = 1};
    hci_diagnosis d;
    const hci_status status = hci_run_errors_of(&t->dataset, &one, t->lone->effects, &d, note);
    *e = (hci_run_errors){.rms_before_Nm = NAN, .noise_floor_Nm = NAN};
    if (!status && d.runs == 1) *e = d.run[0];
    hci_memory_free(d.run);
    return status;
}

/* Keeps a slip that leaves less than the best one so far. Whether it does. */
static bool keep_better(trial *t, const hci_run_errors *e, double unit, hci_odd_run *odd)
{
    const double share = e->rms_before_Nm / unit / t->rms_Nm;
    if (!(share < t->best)) return false;
    t->best = share;
    odd->mended = hci_error_is_noise(e, t->lone->least_Nm);
    odd->mended_Nm = e->rms_before_Nm;
    return true;
}

/* ---- which slip it is ---- */

static void reading_mend(const slip *s, const hci_sample *from, hci_sample *to)
{
    for (size_t p = 0; p < 3; ++p) {
        const size_t at = (size_t)s->swap[p];
        to->i_abc[p] = s->current * from->i_abc[at];
        to->change_A_per_s[p] = s->current * from->change_A_per_s[at];
        to->curvature_A_per_s2[p] = s->current * from->curvature_A_per_s2[at];
    }
}

static void sample_mend(const slip *s, const hci_binned_sample *from, hci_binned_sample *to)
{
    *to = *from;
    reading_mend(s, &from->reading, &to->reading);
    reading_mend(s, &from->raw, &to->raw);
    to->sum_A *= s->current;
    to->torque_Nm *= s->torque;
    to->moment_Nmrad *= s->torque;
    to->scatter_N2m2 *= s->torque * s->torque;
}

static hci_status slips_try(trial *t, hci_odd_run *odd, hci_note *note)
{
    hci_binned_samples *x = &t->dataset.samples;
    hci_status status = HCI_OK;
    for (size_t k = 0; k < sizeof SLIPS / sizeof *SLIPS && !status; ++k) {
        hci_run_errors e;
        for (size_t j = 0; j < x->count; ++j)
            sample_mend(&SLIPS[k], &t->as_read[j], &x->sample[j]);
        status = errors_of(t, &e, note);
        if (!status && keep_better(t, &e, fmax(1.0, fabs(SLIPS[k].torque)), odd))
            snprintf(odd->slip, sizeof odd->slip, "%s", SLIPS[k].words);
    }
    memcpy(x->sample, t->as_read, x->count * sizeof *x->sample);
    return status;
}

/* ---- another index of the angle ---- */

typedef struct {
    hci_dataset *dataset;
    double *residual_Nm; /* [samples] */
    double turned_rad;   /* so far, mechanical */
} turning;

/* Turns the angle back, beside phase currents that stay as they were read. */
static void angle_turn(hci_binned_samples *samples, double angle_rad)
{
    for (size_t j = 0; j < samples->count; ++j) {
        samples->sample[j].reading.theta_m_rad -= angle_rad;
        samples->sample[j].raw.theta_m_rad -= angle_rad;
    }
}

/* Sum of squares of the run with its angle turned back so far. */
static hci_status turned_square(turning *t, double angle_rad, double *square, hci_note *note)
{
    hci_dataset *b = t->dataset;
    angle_turn(&b->samples, angle_rad - t->turned_rad);
    t->turned_rad = angle_rad;
    const hci_status status =
        hci_regression_residual(&b->regression, b->regression.declared, t->residual_Nm, note);
    *square = 0.0;
    for (size_t j = 0; j < b->samples.count; ++j)
        *square += t->residual_Nm[j] * t->residual_Nm[j];
    return status;
}

/* The best of the steps of an electrical turn, and then between its neighbours. */
static hci_status angle_find(turning *t, double *angle_rad, hci_note *note)
{
    const double turn_rad = 2.0 * HCI_PI / t->dataset->regression.machine->pole_pairs;
    double least = INFINITY, square = 0.0, step_rad = turn_rad / STEPS;
    hci_status status = HCI_OK;
    for (int k = 0; k < STEPS && !status; ++k) {
        status = turned_square(t, (k - STEPS / 2) * step_rad, &square, note);
        if (!(square < least)) continue;
        least = square;
        *angle_rad = t->turned_rad;
    }
    for (int k = 0; k < HALVINGS && !status; ++k) {
        const double middle_rad = *angle_rad, side_rad = k % 2 ? -step_rad : step_rad;
        status = turned_square(t, middle_rad + side_rad, &square, note);
        if (square < least) *angle_rad = middle_rad + side_rad;
        least = fmin(least, square);
        if (k % 2) step_rad *= 0.5;
    }
    return status ? status : turned_square(t, *angle_rad, &square, note);
}

static hci_status angle_try_with(trial *t, turning *turn, hci_odd_run *odd, hci_note *note)
{
    double angle_rad = 0.0;
    hci_run_errors e;
    t->dataset.regression.use = t->dataset.any;
    hci_status status = angle_find(turn, &angle_rad, note);
    if (!status) status = errors_of(t, &e, note);
    if (status || !keep_better(t, &e, 1.0, odd)) return status;
    odd->angle_rad = angle_rad;
    snprintf(odd->slip, sizeof odd->slip, "its angle is ahead by %.3g° mechanical (%.3g° electrical)",
             angle_rad * 180.0 / HCI_PI, angle_rad * t->lone->machine->model.pole_pairs * 180.0 / HCI_PI);
    return HCI_OK;
}

static hci_status angle_try(trial *t, hci_odd_run *odd, hci_note *note)
{
    const size_t samples = t->dataset.samples.count;
    turning turn = {&t->dataset, hci_memory_new(samples + 1, sizeof *turn.residual_Nm), 0.0};
    const hci_status status = turn.residual_Nm ? angle_try_with(t, &turn, odd, note)
                                               : hci_note_memory(note, NULL, "comparing recordings");
    hci_memory_free(turn.residual_Nm);
    return status;
}

/* ---- the whole ---- */

static hci_status trial_make(trial *t, hci_note *note)
{
    const hci_runs one = {.run = &t->run, .role = &t->role, .count = 1};
    const hci_status status = hci_dataset_make(t->lone->machine, t->lone->effects, &one, &t->dataset, note);
    if (status) return status;
    const hci_binned_samples *x = &t->dataset.samples;
    t->as_read = hci_memory_new(x->count + 1, sizeof *t->as_read);
    if (t->as_read) memcpy(t->as_read, x->sample, x->count * sizeof *x->sample);
    return t->as_read ? HCI_OK : hci_note_memory(note, NULL, "comparing recordings");
}

/* Another zero of the torque where nothing else would do. */
hci_status hci_odd_slip_find(const hci_lone_run *l, const hci_run_errors *e, hci_odd_run *odd, hci_note *note)
{
    trial t = {.lone = l, .run = l->run, .role = l->role, .rms_Nm = e->rms_before_Nm, .best = MENDED};
    hci_status status = trial_make(&t, note);
    if (!status) status = slips_try(&t, odd, note);
    if (!status && !odd->mended) status = angle_try(&t, odd, note);
    hci_memory_free(t.as_read);
    hci_dataset_release(&t.dataset);
    if (status || odd->mended) return status;
    if (e->ripple_before_Nm <= fmax(AT_NOISE * e->noise_floor_Nm, l->least_Nm))
        snprintf(odd->slip, sizeof odd->slip, "its torque has a zero of its own, %.3g N·m",
                 e->error_mean_before_Nm);
    return HCI_OK;
}
