#include "host/diagnose/odd_run.h"

#include <math.h>
#include <string.h>

#include "host/base/memory.h"
#include "host/diagnose/fit/dataset.h"
#include "host/diagnose/odd_slip.h"
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

enum { LEAST_OTHERS = 4, LEAST_LOADED = 2 };

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
