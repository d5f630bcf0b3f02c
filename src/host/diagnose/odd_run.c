#include "host/diagnose/odd_run.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "hci/math/harmonic.h"
#include "host/base/memory.h"
#include "host/diagnose/fit/dataset.h"
#include "host/diagnose/fit/predicted_reading.h"
#include "host/diagnose/run_errors.h"

#define AT_NOISE   1.5  /* times its noise: an error that is none */
#define RESOLUTION 2e-3 /* of the largest rms torque: the same where there is no noise */
#define FAR        4.0  /* times its noise, and the largest error of the others: a run that is far off */
#define STANDS_OUT 3.0  /* times the largest error of the others, where these are not at their noise */
#define MENDED     0.3  /* share of its error that a slip leaves, where it is one */
#define WITHIN     1.1  /* of the others: speed and current that they tell */
#define LOADED     0.25 /* of a run's current: a run that tells that current makes the declared torque */
#define COLD_C     5.0  /* beyond the temperatures of the others, that changes no magnet */
#define STEADY     0.1  /* of the speed, that it deviates by where it is one */
#define DIRECT     0.1  /* of the current: i_d that is not there */

enum { LEAST_OTHERS = 4, LEAST_LOADED = 2, STEPS = 72, HALVINGS = 24 };

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

/* The errors of all runs of a list before and after effects, in d->run; to be freed. */
static hci_status errors_find(hci_dataset *b, const hci_runs *runs, const hci_effects *effects,
                              hci_diagnosis *d, hci_note *note)
{
    memset(d, 0, sizeof *d);
    d->effects.list = *effects;
    const hci_status status = hci_run_errors_fill(b, runs, 0, d, note);
    hci_memory_free(d->line);
    d->line = NULL;
    return status;
}

/* Of one run by itself. */
typedef struct {
    const hci_machine_data *machine;
    const hci_effects *effects;
    hci_run run;
    hci_role role;
    double least_Nm; /* error that is none whatever the noise */
} lone_run;

static hci_status lone_errors(const lone_run *l, hci_dataset *b, hci_run_errors *e, hci_note *note)
{
    hci_run run = l->run;
    hci_role role = l->role;
    const hci_runs one = {.run = &run, .role = &role, .count = 1};
    hci_diagnosis d;
    const hci_status status = errors_find(b, &one, b->regression.declared, &d, note);
    *e = (hci_run_errors){.rms_before_Nm = NAN, .noise_floor_Nm = NAN};
    if (!status && d.runs == 1) *e = d.run[0];
    hci_memory_free(d.run);
    return status;
}

static bool is_noise(const hci_run_errors *e, double least_Nm)
{
    return e->rms_before_Nm <= fmax(AT_NOISE * e->noise_floor_Nm, least_Nm);
}

/* ---- which slip it is ---- */

static void slip_apply(const slip *s, const hci_run *from, double *i_A, double *torque_Nm)
{
    for (size_t j = 0; j < from->count; ++j) {
        for (size_t p = 0; p < 3; ++p)
            i_A[3 * j + p] = s->current * from->i_A[3 * j + (size_t)s->swap[p]];
        torque_Nm[j] = s->torque * from->torque_Nm[j];
    }
}

/* The error of a run whose slip has been mended. work: [4 samples]. */
static hci_status slip_errors(const lone_run *l, const slip *s, double *work, hci_run_errors *e,
                              hci_note *note)
{
    lone_run mended = *l;
    const hci_runs one = {.run = &mended.run, .role = &mended.role, .count = 1};
    hci_dataset b;
    mended.run.i_A = work;
    mended.run.torque_Nm = work + 3 * l->run.count;
    slip_apply(s, &l->run, mended.run.i_A, mended.run.torque_Nm);
    hci_status status = hci_dataset_make(l->machine, l->effects, &one, &b, note);
    if (status) return status;
    status = lone_errors(&mended, &b, e, note);
    hci_dataset_release(&b);
    return status;
}

/* best: the least error so far, in units of that of the run as it stands. */
static hci_status slips_try(const lone_run *l, double rms_Nm, double *best, hci_odd_run *odd, hci_note *note)
{
    double *work = hci_memory_new(4 * l->run.count + 1, sizeof *work);
    hci_status status = work ? HCI_OK : hci_note_memory(note, NULL, "comparing recordings");
    for (size_t k = 0; k < sizeof SLIPS / sizeof *SLIPS && !status; ++k) {
        hci_run_errors e;
        status = slip_errors(l, &SLIPS[k], work, &e, note);
        const double share = e.rms_before_Nm / fmax(1.0, fabs(SLIPS[k].torque)) / rms_Nm;
        if (status || !(share < *best)) continue;
        *best = share;
        odd->mended = is_noise(&e, l->least_Nm);
        odd->mended_Nm = e.rms_before_Nm;
        snprintf(odd->slip, sizeof odd->slip, "%s", SLIPS[k].words);
    }
    hci_memory_free(work);
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

static hci_status angle_try_with(const lone_run *l, turning *t, double rms_Nm, double *best, hci_odd_run *odd,
                                 hci_note *note)
{
    double angle_rad = 0.0;
    hci_run_errors e;
    t->dataset->regression.use = t->dataset->any;
    hci_status status = angle_find(t, &angle_rad, note);
    if (!status) status = lone_errors(l, t->dataset, &e, note);
    if (status || !(e.rms_before_Nm < *best * rms_Nm)) return status;
    *best = e.rms_before_Nm / rms_Nm;
    odd->mended = is_noise(&e, l->least_Nm);
    odd->mended_Nm = e.rms_before_Nm;
    odd->angle_rad = angle_rad;
    snprintf(odd->slip, sizeof odd->slip, "its angle is ahead by %.3g° mechanical (%.3g° electrical)",
             angle_rad * 180.0 / HCI_PI, angle_rad * l->machine->model.pole_pairs * 180.0 / HCI_PI);
    return HCI_OK;
}

static hci_status angle_try(const lone_run *l, double rms_Nm, double *best, hci_odd_run *odd, hci_note *note)
{
    hci_run run = l->run;
    hci_role role = l->role;
    const hci_runs one = {.run = &run, .role = &role, .count = 1};
    hci_dataset b;
    hci_status status = hci_dataset_make(l->machine, l->effects, &one, &b, note);
    if (status) return status;
    turning t = {&b, hci_memory_new(b.samples.count + 1, sizeof *t.residual_Nm), 0.0};
    status = t.residual_Nm ? angle_try_with(l, &t, rms_Nm, best, odd, note)
                           : hci_note_memory(note, NULL, "comparing recordings");
    hci_memory_free(t.residual_Nm);
    hci_dataset_release(&b);
    return status;
}

/* ---- whether the others tell its state ---- */

/* What of the other runs says something of one, as the largest that they have. */
typedef struct {
    double speed, current_A, id_A, acceleration, deviation, coldest_C, hottest_C;
    size_t loaded; /* runs with a noticeable part of its current */
} reach;

static bool is_of_kind(const hci_runs *runs, const hci_dataset *b, size_t k, size_t odd)
{
    const hci_run_statistics *x = &b->samples.statistics[k], *y = &b->samples.statistics[odd];
    return k != odd && hci_segment_next(&b->samples, k, NULL) && x->is_direct == y->is_direct &&
           runs->run[k].torque_source == runs->run[odd].torque_source;
}

/* Speeds and i_d count where they have the same sign. */
static reach reach_of(const hci_runs *runs, const hci_dataset *b, size_t odd)
{
    const hci_run_statistics *y = &b->samples.statistics[odd];
    reach r = {.coldest_C = INFINITY, .hottest_C = -INFINITY};
    for (size_t k = 0; k < runs->count; ++k) {
        const hci_run_statistics *x = &b->samples.statistics[k];
        if (!is_of_kind(runs, b, k, odd)) continue;
        r.speed = fmax(r.speed, x->mean_speed_rad_per_s * copysign(1.0, y->mean_speed_rad_per_s));
        r.current_A = fmax(r.current_A, x->current_A);
        r.id_A = fmax(r.id_A, x->mean_id_A * copysign(1.0, y->mean_id_A));
        r.acceleration = fmax(r.acceleration, x->rms_acceleration);
        r.deviation = fmax(r.deviation, x->speed_deviation);
        r.coldest_C = fmin(r.coldest_C, x->coldest_C);
        r.hottest_C = fmax(r.hottest_C, x->hottest_C);
        r.loaded += x->current_A > 0.0 && x->current_A >= LOADED * y->current_A;
    }
    return r;
}

static bool is_loaded_as_others(const reach *r, const hci_run_statistics *y)
{
    return !(y->current_A > 0.0) || r->loaded >= LEAST_LOADED;
}

static bool is_told(const reach *r, const hci_run_statistics *y)
{
    const double deviation = fmax(r->deviation, STEADY * fabs(y->mean_speed_rad_per_s));
    const double direct_A = fmax(r->id_A, DIRECT * y->current_A);
    const bool moves_alike = fabs(y->mean_speed_rad_per_s) <= WITHIN * r->speed &&
                             y->speed_deviation <= WITHIN * deviation &&
                             (y->speed_deviation <= STEADY * fabs(y->mean_speed_rad_per_s) ||
                              y->rms_acceleration <= WITHIN * r->acceleration);
    const bool flows_alike = y->current_A <= WITHIN * r->current_A && fabs(y->mean_id_A) <= WITHIN * direct_A;
    const bool is_as_warm = isnan(y->hottest_C) ||
                            (y->coldest_C >= r->coldest_C - COLD_C && y->hottest_C <= r->hottest_C + COLD_C);
    return moves_alike && flows_alike && is_as_warm && is_loaded_as_others(r, y);
}

/* ---- the whole ---- */

/* The run with the largest error beside its noise; errors of the others. */
typedef struct {
    size_t error, run; /* index among the errors and among the runs */
    double others_Nm, most_others_Nm;
    bool others_are_noise;
} outlier;

static bool is_candidate(const hci_run *r)
{
    return r->torque_source == HCI_TORQUE_MEASURED && r->theta_m_rad && r->i_A && r->torque_Nm;
}

static size_t run_of(const hci_runs *runs, const hci_run_errors *e)
{
    for (size_t k = 0; k < runs->count; ++k)
        if (runs->run[k].name == e->file) return k;
    return runs->count;
}

static outlier outlier_find(const hci_runs *runs, const hci_diagnosis *d, double least_Nm)
{
    outlier o = {.others_are_noise = true};
    for (size_t k = 1; k < d->runs; ++k)
        if (d->run[k].rms_before_Nm > d->run[o.error].rms_before_Nm) o.error = k;
    for (size_t k = 0; k < d->runs; ++k) {
        if (k == o.error) continue;
        o.others_Nm += d->run[k].rms_before_Nm * d->run[k].rms_before_Nm / (double)(d->runs - 1);
        o.most_others_Nm = fmax(o.most_others_Nm, d->run[k].rms_before_Nm);
        o.others_are_noise = o.others_are_noise && is_noise(&d->run[k], least_Nm);
    }
    o.others_Nm = sqrt(o.others_Nm);
    o.run = run_of(runs, &d->run[o.error]);
    return o;
}

/* What a slip of the file, or another zero of its torque, would do. */
static hci_status mend(const lone_run *l, const hci_run_errors *e, hci_odd_run *odd, hci_note *note)
{
    double best = MENDED;
    hci_status status = slips_try(l, e->rms_before_Nm, &best, odd, note);
    if (!status && !odd->mended) status = angle_try(l, e->rms_before_Nm, &best, odd, note);
    if (status || odd->mended) return status;
    if (e->ripple_before_Nm <= fmax(AT_NOISE * e->noise_floor_Nm, l->least_Nm))
        snprintf(odd->slip, sizeof odd->slip, "its torque has a zero of its own, %.3g N·m",
                 e->error_mean_before_Nm);
    return HCI_OK;
}

/* A slip with no value to choose proves itself; an angle does where it takes a ripple away as well, since the
 * mean alone is also a torque of the iron. */
static bool is_proved(const hci_odd_run *odd, const hci_run_errors *e)
{
    return odd->mended && (!(fabs(odd->angle_rad) > 0.0) || e->ripple_before_Nm > 2.0 * odd->mended_Nm);
}

static hci_status judge(const hci_machine_data *machine, hci_dataset *b, const hci_runs *runs,
                        const hci_diagnosis *d, hci_odd_run *odd, bool *certain, hci_note *note)
{
    const double least_Nm = RESOLUTION * hci_dataset_range_of(b).torque_Nm;
    const outlier o = outlier_find(runs, d, least_Nm);
    const hci_run_errors *e = &d->run[o.error];
    if (o.run == runs->count || !is_candidate(&runs->run[o.run])) return HCI_OK;
    const bool far = e->rms_before_Nm > fmax(FAR * e->noise_floor_Nm, FAR * o.most_others_Nm);
    if (o.others_are_noise ? !far : !(e->rms_before_Nm > FAR * e->noise_floor_Nm)) return HCI_OK;
    const lone_run lone = {machine, b->regression.declared, runs->run[o.run], runs->role[o.run], least_Nm};
    const reach r = reach_of(runs, b, o.run);
    const hci_run_statistics *y = &b->samples.statistics[o.run];
    if (!is_loaded_as_others(&r, y)) return HCI_OK;
    hci_odd_run found = {.file = e->file, .rms_Nm = e->rms_before_Nm, .others_Nm = o.others_Nm};
    const bool stands_out = o.others_are_noise || e->rms_before_Nm > STANDS_OUT * o.most_others_Nm;
    const bool told = stands_out && is_told(&r, y);
    const hci_status status = o.others_are_noise || !told ? mend(&lone, e, &found, note) : HCI_OK;
    const bool slipped = o.others_are_noise ? is_proved(&found, e) : found.slip[0] != '\0';
    if (status || !(slipped || told)) return status;
    *odd = found;
    *certain = o.others_are_noise;
    return HCI_OK;
}

/* Runs to be fitted that remain without one. */
static bool is_enough(const hci_runs *runs)
{
    size_t fitted = 0;
    for (size_t k = 0; k < runs->count; ++k)
        fitted += runs->role[k] == HCI_ROLE_FIT;
    return runs->count > LEAST_OTHERS && fitted > 2;
}

hci_status hci_odd_run_find(const hci_machine_data *machine, const hci_effects *effects, const hci_runs *runs,
                            hci_odd_run *odd, bool *certain, hci_note *note)
{
    hci_dataset b;
    hci_diagnosis d;
    memset(odd, 0, sizeof *odd);
    *certain = false;
    if (!is_enough(runs)) return HCI_OK;
    hci_status status = hci_dataset_make(machine, effects, runs, &b, note);
    if (status) return status;
    status = errors_find(&b, runs, effects, &d, note);
    if (!status && d.runs > LEAST_OTHERS) status = judge(machine, &b, runs, &d, odd, certain, note);
    hci_memory_free(d.run);
    hci_dataset_release(&b);
    return status;
}

/* ---- whether a suspicion still stands ---- */

hci_status hci_suspect_make(const hci_machine_data *machine, const hci_effects *effects, const hci_runs *runs,
                            const char *file, hci_suspect *s, hci_note *note)
{
    size_t k = 0;
    memset(s, 0, sizeof *s);
    while (runs->run[k].name != file)
        ++k;
    s->run = runs->run[k];
    s->role = runs->role[k];
    const hci_runs one = {.run = &s->run, .role = &s->role, .count = 1};
    return hci_dataset_make(machine, effects, &one, &s->dataset, note);
}

hci_status hci_suspect_ask(hci_suspect *s, const hci_effects *effects, hci_note *note)
{
    const hci_runs one = {.run = &s->run, .role = &s->role, .count = 1};
    hci_diagnosis d;
    const hci_status status = errors_find(&s->dataset, &one, effects, &d, note);
    const bool cleared = !status && d.runs == 1 && d.run[0].rms_after_Nm <= FAR * d.run[0].noise_floor_Nm;
    hci_memory_free(d.run);
    return cleared ? HCI_ERROR_STOPPED : status;
}

void hci_suspect_release(hci_suspect *s)
{
    hci_dataset_release(&s->dataset);
}
