#include "host/diagnose/odd_run.h"

#include <math.h>
#include <string.h>

#include "hci/math/dense.h"
#include "hci/math/harmonic.h"
#include "host/base/memory.h"
#include "host/diagnose/fit/dataset.h"
#include "host/diagnose/odd_slip.h"
#include "host/diagnose/open_voltage.h"
#include "host/diagnose/reading/predicted_reading.h"
#include "host/diagnose/run_errors.h"

#define RESOLUTION 2e-3 /* of the largest rms torque: the same where there is no noise */
#define FAR        4.0  /* times its noise, and the largest error of the others: a run that is far off */
#define UNTOLD     1.5 /* times its error without them: what effects make of a run whose state is another one */
#define STANDS_OUT 3.0  /* times the largest error of the others, where these are not at their noise */
#define WITHIN     1.1  /* of the others: speed and current that they tell */
#define LOADED     0.25 /* of a run's current: a run that tells that current makes the declared torque */
#define COLD_C     5.0  /* beyond the temperatures of the others, that changes no magnet */
#define STEADY     0.1  /* of the speed, that it deviates by where it is one */
#define DIRECT     0.1  /* of the current: i_d that is not there */

#define BEYOND 0.1 /* of the current: beyond what the others tell of iron that saturates */

enum { LEAST_OTHERS = 4, LEAST_LOADED = 2, DIRECTIONS = 36 /* of half a turn of the rotor frame */ };

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
        o.others_are_noise = o.others_are_noise && hci_error_is_noise(&d->run[k], least_Nm);
    }
    o.others_Nm = sqrt(o.others_Nm);
    o.run = run_of(runs, &d->run[o.error]);
    return o;
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
    const hci_lone_run lone = {machine, b->regression.declared, runs->run[o.run], runs->role[o.run],
                               least_Nm};
    const reach r = reach_of(runs, b, o.run);
    const hci_run_statistics *y = &b->samples.statistics[o.run];
    if (!is_loaded_as_others(&r, y)) return HCI_OK;
    hci_odd_run found = {.file = e->file, .rms_Nm = e->rms_before_Nm, .others_Nm = o.others_Nm};
    const bool stands_out = o.others_are_noise || e->rms_before_Nm > STANDS_OUT * o.most_others_Nm;
    const bool told = stands_out && is_told(&r, y);
    const hci_status status =
        o.others_are_noise || !told ? hci_odd_slip_find(&lone, e, &found, note) : HCI_OK;
    const bool slipped = o.others_are_noise ? is_proved(&found, e) : found.slip[0] != '\0';
    if (status || !(slipped || told)) return status;
    *odd = found;
    *certain = o.others_are_noise;
    return HCI_OK;
}

/* Runs to be fitted that remain without one. */
bool hci_odd_run_is_asked(const hci_runs *runs)
{
    size_t fitted = 0;
    for (size_t k = 0; k < runs->count; ++k)
        fitted += runs->role[k] == HCI_ROLE_FIT;
    return runs->count > LEAST_OTHERS && fitted > 2;
}

/* As it was before errors were asked for. */
static void forget(hci_dataset *b, double work)
{
    memset(b->regression.noise, 0, b->samples.segment_count * sizeof *b->regression.noise);
    b->work = work;
}

hci_status hci_odd_run_find(const hci_machine_data *machine, hci_dataset *b, const hci_runs *runs,
                            hci_odd_run *odd, bool *certain, hci_note *note)
{
    const double work = b->work;
    hci_diagnosis d;
    memset(odd, 0, sizeof *odd);
    *certain = false;
    hci_status status = hci_run_errors_of(b, runs, b->regression.declared, &d, note);
    if (!status && d.runs > LEAST_OTHERS) status = judge(machine, b, runs, &d, odd, certain, note);
    hci_memory_free(d.run);
    forget(b, work);
    return status;
}

/* How far the currents of a run reach along a direction of the rotor frame. */
static double reach_along(const hci_run_statistics *x, double cosine, double sine)
{
    return x->mean_id_A * cosine + fabs(x->mean_iq_A) * sine;
}

bool hci_odd_run_is_beyond(const hci_dataset *b, const hci_runs *runs, const char *file)
{
    size_t odd = 0;
    while (runs->run[odd].name != file)
        ++odd;
    const hci_run_statistics *of = b->samples.statistics, *y = &of[odd];
    for (int k = 0; k <= DIRECTIONS; ++k) {
        const double cosine = cos(HCI_PI * k / DIRECTIONS), sine = sin(HCI_PI * k / DIRECTIONS);
        double others_A = -INFINITY;
        for (size_t r = 0; r < runs->count; ++r)
            if (is_of_kind(runs, b, r, odd)) others_A = fmax(others_A, reach_along(&of[r], cosine, sine));
        if (reach_along(y, cosine, sine) > others_A + BEYOND * y->current_A) return true;
    }
    return false;
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
    const hci_status status = hci_run_errors_of(&s->dataset, &one, effects, &d, note);
    const hci_run_errors *e = d.run;
    const bool any = !status && d.runs == 1;
    const bool cleared = any && e->rms_after_Nm <= FAR * e->noise_floor_Nm;
    s->untold = any && e->rms_after_Nm > UNTOLD * e->rms_before_Nm;
    hci_memory_free(d.run);
    return cleared || s->untold ? HCI_ERROR_STOPPED : status;
}

void hci_suspect_release(hci_suspect *s)
{
    hci_candidates_release(&s->shown);
    hci_dataset_release(&s->dataset);
}

/* ---- whose mean alone is off ---- */

/* A zero, a friction, and a torque of the current that saturates. */
enum { MEAN_TERMS = 4, SPARE_MEANS = 5 /* of the others, beyond what takes them to be known */ };

#define RIDGE     1e-9 /* of the diagonal, for terms that the runs do not tell apart */
#define NEARER    0.3  /* of what all runs leave: a run without which it is less may be it */
#define QUIET     1.25 /* of its noise: the ripple of a run that is off by a constant alone */
#define CERTAINLY 5.0  /* standard errors of that constant */

static void mean_row(const hci_run_statistics *x, double row[MEAN_TERMS])
{
    row[0] = 1.0;
    row[1] = (x->mean_speed_rad_per_s > 0.0) - (x->mean_speed_rad_per_s < 0.0);
    row[2] = x->mean_iq_A;
    row[3] = x->mean_iq_A * x->current_A * x->current_A;
}

static bool has_mean(const hci_runs *runs, const hci_diagnosis *d, size_t k)
{
    const size_t run = run_of(runs, &d->run[k]);
    return run < runs->count && d->run[k].role == HCI_ROLE_FIT && d->run[k].source == HCI_TORQUE_MEASURED;
}

/* The normal equations of the mean errors of all runs but one, and their solution in x. */
static bool means_fit(const hci_dataset *b, const hci_runs *runs, const hci_diagnosis *d, size_t without,
                      double x[MEAN_TERMS])
{
    double a[MEAN_TERMS * MEAN_TERMS] = {0.0}, row[MEAN_TERMS];
    memset(x, 0, MEAN_TERMS * sizeof *x);
    for (size_t k = 0; k < d->runs; ++k) {
        if (k == without || !has_mean(runs, d, k)) continue;
        mean_row(&b->samples.statistics[run_of(runs, &d->run[k])], row);
        for (int i = 0; i < MEAN_TERMS; ++i) {
            x[i] += row[i] * d->run[k].error_mean_before_Nm;
            for (int j = 0; j < MEAN_TERMS; ++j)
                a[i * MEAN_TERMS + j] += row[i] * row[j];
        }
    }
    for (int i = 0; i < MEAN_TERMS; ++i)
        a[i * MEAN_TERMS + i] += RIDGE * a[i * MEAN_TERMS + i] + RIDGE;
    if (hci_cholesky_factor(MEAN_TERMS, a)) return false;
    hci_cholesky_solve(MEAN_TERMS, a, x);
    return true;
}

/* The rms that the law leaves of the means of all runs but one; INFINITY where so few tell nothing. */
static double means_left(const hci_dataset *b, const hci_runs *runs, const hci_diagnosis *d, size_t without)
{
    double x[MEAN_TERMS], row[MEAN_TERMS], sum = 0.0;
    size_t count = 0;
    if (!means_fit(b, runs, d, without, x)) return (double)INFINITY;
    for (size_t k = 0; k < d->runs; ++k) {
        if (k == without || !has_mean(runs, d, k)) continue;
        double error = d->run[k].error_mean_before_Nm;
        mean_row(&b->samples.statistics[run_of(runs, &d->run[k])], row);
        for (int i = 0; i < MEAN_TERMS; ++i)
            error -= row[i] * x[i];
        sum += error * error;
        ++count;
    }
    return count > MEAN_TERMS ? sqrt(sum / (double)(count - MEAN_TERMS)) : (double)INFINITY;
}

size_t hci_odd_means_rank(const hci_dataset *b, const hci_runs *runs, const hci_diagnosis *d,
                          const char *file[HCI_ODD_MEANS])
{
    const double all_Nm = means_left(b, runs, d, d->runs);
    double left_Nm[HCI_ODD_MEANS] = {INFINITY, INFINITY};
    size_t count = 0;
    for (size_t k = 0; k < d->runs; ++k) {
        const double x_Nm = has_mean(runs, d, k) ? means_left(b, runs, d, k) : (double)INFINITY;
        if (!(x_Nm < left_Nm[HCI_ODD_MEANS - 1])) continue;
        size_t at = HCI_ODD_MEANS - 1;
        for (; at > 0 && x_Nm < left_Nm[at - 1]; --at) {
            left_Nm[at] = left_Nm[at - 1];
            file[at] = file[at - 1];
        }
        left_Nm[at] = x_Nm;
        file[at] = d->run[k].file;
        count += count < HCI_ODD_MEANS;
    }
    return count > 0 && left_Nm[0] < NEARER * all_Nm ? count : 0;
}

/* What machines that the others allow make another of its mean, as a standard deviation; 0: none is known. */
static hci_status mean_open(const hci_suspect *s, const hci_diagnosis *others, double *open_Nm,
                            hci_note *note)
{
    const hci_regression *e = &s->dataset.regression;
    const hci_uncertainty *u = &others->uncertainty;
    hci_predicted_reading reading;
    double count = 0.0, square = 0.0;
    *open_Nm = 0.0;
    if (u->machines == 0) return HCI_OK;
    double *mean_Nm = hci_memory_new(u->machines, sizeof *mean_Nm);
    if (!mean_Nm || !hci_predicted_reading_make(e, &u->effects.list, true, &reading)) {
        hci_memory_free(mean_Nm);
        return hci_note_memory(note, s->run.name, "what is left open of its mean");
    }
    for (const hci_segment *x = NULL; (x = hci_segment_next(e->samples, 0, x)) != NULL;) {
        hci_predicted_reading_fill(e, &u->effects.list, x, &reading);
        for (size_t j = 0; j < x->count; ++j) {
            const double weight = e->samples->sample[x->first + j].count;
            for (size_t t = 0; t < reading.terms; ++t)
                for (size_t m = 0; m < u->machines; ++m)
                    mean_Nm[m] +=
                        weight * reading.by_value[j * reading.terms + t] * u->departure[t * u->machines + m];
            count += weight;
        }
    }
    for (size_t m = 0; m < u->machines; ++m)
        square += pow(mean_Nm[m] / fmax(1.0, count), 2.0) / (double)u->machines;
    *open_Nm = sqrt(square);
    hci_predicted_reading_release(&reading);
    hci_memory_free(mean_Nm);
    return HCI_OK;
}

/* The means of the others are left by about as much as that of this run is uncertain. */
static double others_mean_Nm(const hci_diagnosis *others)
{
    double sum = 0.0;
    for (size_t k = 0; k < others->runs; ++k)
        sum += pow(others->run[k].error_mean_after_Nm, 2.0) / (double)others->runs;
    return sqrt(sum);
}

/* Terms that make a mean torque, of what the others show: each takes one of their means to be known. */
static size_t mean_terms(const hci_effects *list)
{
    size_t count = 0;
    for (size_t k = 0; k < list->count; ++k)
        for (size_t j = 0; j < list->effect[k].count; ++j) {
            const double order = list->effect[k].term[j].order;
            count += order < HCI_ORDER_TOLERANCE || fabs(order - 1.0) < HCI_ORDER_TOLERANCE;
        }
    return count;
}

/* Whether the others tell all of its state but the speed. */
static bool is_told_but_speed(const reach *r, hci_run_statistics y)
{
    const double scale = fabs(y.mean_speed_rad_per_s) > 0.0 ? r->speed / fabs(y.mean_speed_rad_per_s) : 0.0;
    y.mean_speed_rad_per_s *= fmin(1.0, scale);
    y.speed_deviation *= fmin(1.0, scale);
    y.rms_acceleration = fmin(y.rms_acceleration, r->acceleration);
    return r->speed > 0.0 && is_told(r, &y);
}

/* At a speed of its own whatever brakes may be in the mean, by a law that nobody knows; what drives is none.
 */
static bool is_certain(const reach *r, const hci_run_statistics *y, const hci_odd_run *odd)
{
    if (!odd->mean_is_untold)
        return fabs(odd->mean_Nm) > CERTAINLY * hypot(odd->mean_error_Nm, odd->mean_open_Nm);
    return is_told_but_speed(r, *y) && odd->mean_Nm * y->mean_speed_rad_per_s > 0.0 &&
           fabs(odd->mean_Nm) > fmax(CERTAINLY * odd->mean_error_Nm, odd->mean_open_Nm);
}

static hci_odd_run constant_of(const hci_diagnosis *others, const hci_run_errors *e, double open_Nm,
                               const reach *r, const hci_run_statistics *y)
{
    const hci_odd_run odd = {.file = e->file,
                             .rms_Nm = e->rms_after_Nm,
                             .others_Nm = others->rms_after_Nm,
                             .mean_Nm = e->error_mean_after_Nm,
                             .mean_error_Nm = others_mean_Nm(others),
                             .mean_open_Nm = open_Nm,
                             .mean_is_untold = !is_told(r, y)};
    const bool quiet = e->ripple_after_Nm <= QUIET * e->noise_floor_Nm;
    const bool told = others->runs >= mean_terms(&others->effects.list) + SPARE_MEANS;
    return quiet && told && is_certain(r, y, &odd) ? odd : (hci_odd_run){.file = NULL};
}

hci_status hci_odd_mean_judge(const hci_machine_data *machine, const hci_dataset *b, const hci_runs *runs,
                              const char *file, const hci_diagnosis *others, hci_odd_run *odd, hci_note *note)
{
    hci_suspect s;
    hci_diagnosis d = {0};
    double open_Nm = 0.0;
    size_t run = 0;
    memset(odd, 0, sizeof *odd);
    while (runs->run[run].name != file)
        ++run;
    hci_status status = hci_suspect_make(machine, b->regression.declared, runs, file, &s, note);
    if (status) return status;
    const hci_runs one = {.run = &s.run, .role = &s.role, .count = 1};
    const reach r = reach_of(runs, b, run);
    status = hci_run_errors_of(&s.dataset, &one, &others->effects.list, &d, note);
    if (!status) status = mean_open(&s, others, &open_Nm, note);
    if (!status && d.runs == 1) *odd = constant_of(others, d.run, open_Nm, &r, &b->samples.statistics[run]);
    if (odd->file) odd->file = file;
    hci_memory_free(d.run);
    hci_suspect_release(&s);
    return status;
}

/* ---- that is set aside ---- */

/* Whether others have a load of its sign. */
static bool is_loaded_that_way(const hci_runs *runs, const hci_dataset *b, size_t run)
{
    const hci_run_statistics *of = b->samples.statistics, *y = &of[run];
    bool any = !(fabs(y->mean_iq_A) > LOADED * y->current_A);
    for (size_t k = 0; k < runs->count && !any; ++k)
        any = is_of_kind(runs, b, k, run) &&
              of[k].mean_iq_A * copysign(1.0, y->mean_iq_A) >= LOADED * fabs(y->mean_iq_A);
    return any;
}

static bool may_be_aside(const hci_machine *machine, const hci_dataset *b, const hci_runs *runs, size_t run)
{
    const reach r = reach_of(runs, b, run);
    return !hci_open_voltage_is_in(machine, &runs->run[run]) && is_told(&r, &b->samples.statistics[run]) &&
           is_loaded_that_way(runs, b, run);
}

size_t hci_odd_aside_pick(const hci_machine *machine, const hci_dataset *b, const hci_runs *runs,
                          const hci_diagnosis *d, const char *file[HCI_ODD_MEANS])
{
    const hci_run_errors *last = NULL, *worst = NULL;
    size_t count = 0;
    for (size_t k = 0; k < d->runs; ++k) {
        const hci_run_errors *e = &d->run[k];
        if (!has_mean(runs, d, k) || !may_be_aside(machine, b, runs, run_of(runs, e))) continue;
        last = e;
        if (!worst || e->rms_after_Nm * worst->noise_floor_Nm > worst->rms_after_Nm * e->noise_floor_Nm)
            worst = e;
    }
    if (last) file[count++] = last->file;
    if (worst != last) file[count++] = worst->file;
    return count;
}

hci_status hci_odd_aside_judge(const hci_machine_data *machine, const hci_dataset *b, const hci_runs *runs,
                               const char *file, const hci_diagnosis *others, hci_odd_run *odd,
                               hci_note *note)
{
    hci_suspect s;
    hci_diagnosis d = {0};
    memset(odd, 0, sizeof *odd);
    hci_status status = hci_suspect_make(machine, b->regression.declared, runs, file, &s, note);
    if (status) return status;
    const hci_runs one = {.run = &s.run, .role = &s.role, .count = 1};
    status = hci_run_errors_of(&s.dataset, &one, &others->effects.list, &d, note);
    if (!status && d.runs == 1)
        *odd = (hci_odd_run){.file = file,
                             .rms_Nm = d.run[0].rms_after_Nm,
                             .others_Nm = others->rms_after_Nm,
                             .is_aside = true,
                             .noise_Nm = d.run[0].noise_floor_Nm};
    hci_memory_free(d.run);
    hci_suspect_release(&s);
    return status;
}
