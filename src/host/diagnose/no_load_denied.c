#include "host/diagnose/no_load_denied.h"

#include <math.h>
#include <string.h>

#define LITTLE    0.01 /* of the largest current, that is none */
#define RISES     1.02 /* times the error before */
#define DENIED    0.25 /* of the square that a torque takes away, by which it may raise others */
#define BY_CHANCE 2.0  /* deviations */
#define ONE       0.1  /* of a speed, by which others are the same */
#define MADE      3.0  /* times a declared amplitude, that no sensor makes of it */
#define MUCH      4.0  /* times the square that a torque takes away, beside which it is not seen */
#define SHRINKS   1.05 /* times an amplitude, that a lag leaves of it at most */

bool hci_no_load_is_asked(const hci_effect_type *type)
{
    return type->any_phase && type->parameter[0].ordered;
}

/* ---- under load ---- */

static bool is_loaded(const hci_dataset *b, size_t run)
{
    return b->samples.statistics[run].current_A > LITTLE * hci_dataset_range_of(b).current_A;
}

/* The run of an entry of the diagnosis, which has those with a torque alone. */
static size_t run_of(const hci_runs *runs, const hci_run_errors *e)
{
    size_t run = 0;
    while (runs->run[run].name != e->file)
        ++run;
    return run;
}

/* Squares of ripples, summed over runs, and by how much they rise in each. */
typedef struct {
    double before, after, noise, runs;
    double rise, rise_square;
} ripples;

static void ripples_add(const hci_run_errors *e, ripples *x)
{
    const double before = e->ripple_before_Nm * e->ripple_before_Nm;
    const double after = e->ripple_after_Nm * e->ripple_after_Nm;
    x->before += before;
    x->after += after;
    x->noise += e->noise_floor_Nm * e->noise_floor_Nm;
    x->runs += 1.0;
    x->rise += after - before;
    x->rise_square += (after - before) * (after - before);
}

/* Whether ripples rise by a part of what the torque takes away in other runs, and by more than by chance lie
 * above falling as much: beside a large unknown ripple the one run rises and the other falls. */
static bool rises_by_part(const ripples *loaded, const ripples *other)
{
    const double rise = loaded->rise / loaded->runs, fall = -other->rise / other->runs;
    const double variance = fmax(0.0, loaded->rise_square / loaded->runs - rise * rise);
    return fall > 0.0 && rise > DENIED * fall && rise + fall > BY_CHANCE * sqrt(variance / loaded->runs);
}

/* Of the runs under load and of the others. */
typedef struct {
    ripples loaded, other;
} both;

static both ripples_of(const hci_dataset *b, const hci_runs *runs, const hci_diagnosis *d)
{
    both x;
    memset(&x, 0, sizeof x);
    for (size_t k = 0; k < d->runs; ++k)
        ripples_add(&d->run[k], is_loaded(b, run_of(runs, &d->run[k])) ? &x.loaded : &x.other);
    return x;
}

bool hci_no_load_rises(const hci_dataset *b, const hci_runs *runs, const hci_diagnosis *d)
{
    const both x = ripples_of(b, runs, d);
    return x.loaded.after > RISES * RISES * fmax(x.loaded.before, x.loaded.noise) ||
           rises_by_part(&x.loaded, &x.other);
}

/* ---- at one speed ---- */

static bool is_one_speed(const hci_dataset *b, const hci_runs *runs)
{
    double least = INFINITY, most = 0.0;
    for (size_t r = 0; r < runs->count; ++r) {
        const double speed = b->samples.statistics[r].pace_rad_per_s;
        if (runs->run[r].torque_source != HCI_TORQUE_MEASURED || is_loaded(b, r)) continue;
        least = fmin(least, speed);
        most = fmax(most, speed);
    }
    return most > 0.0 && most - least <= ONE * most;
}

static const hci_harmonic *declared_at(const hci_machine *machine, double order)
{
    for (size_t k = 0; k < machine->cogging_count; ++k)
        if (fabs(machine->cogging[k].order - order) < HCI_ORDER_TOLERANCE) return &machine->cogging[k];
    return NULL;
}

/* Whether it makes nothing but declared torques smaller, or turns them, as a sensor does that lags or
 * averages. */
static bool is_like_lag(const hci_machine *machine, const hci_candidates *model)
{
    for (size_t k = 0; k < model->count; ++k) {
        const hci_candidate *x = &model->candidate[k];
        if (!x->in || !hci_no_load_is_asked(x->type) || x->count != 2) continue;
        const hci_harmonic *a = declared_at(machine, x->term[0].order);
        if (!a || hypot(a->sine + x->term[0].value, a->cosine + x->term[1].value) >
                      SHRINKS * hypot(a->sine, a->cosine))
            return false;
    }
    return true;
}

/* ---- orders that are not declared ---- */

/* Whether most of it has orders that the machine does not declare, or far larger ones: a sensor that lags,
 * averages or has play changes a torque that is there, and adds no order of the turn. */
static bool is_new(const hci_machine *machine, const hci_candidates *model)
{
    double declared = 0.0, new = 0.0; /* squares of what changes */
    for (size_t k = 0; k < model->count; ++k) {
        const hci_candidate *x = &model->candidate[k];
        if (!x->in || !hci_no_load_is_asked(x->type) || x->count != 2) continue;
        const hci_harmonic *a = declared_at(machine, x->term[0].order);
        const double square = pow(x->term[0].value, 2.0) + pow(x->term[1].value, 2.0);
        const double was = a ? a->sine * a->sine + a->cosine * a->cosine : 0.0;
        *(square > MADE * MADE * was ? &new : &declared) += square;
    }
    return new > declared;
}

/* Whether what is left under load is much more than what the torque takes away without: nothing can be said
 * of that torque there. Where it is as much, it may be the same of another phase, such as a hum of the mains.
 */
static bool is_drowned(const hci_dataset *b, const hci_runs *runs, const hci_diagnosis *d)
{
    const both x = ripples_of(b, runs, d);
    const double left = (x.loaded.before - x.loaded.noise) / x.loaded.runs;
    return left > MUCH * -x.other.rise / x.other.runs;
}

bool hci_no_load_is_shown(const hci_dataset *b, const hci_runs *runs, const hci_candidates *model,
                          const hci_diagnosis *d)
{
    return is_new(b->regression.machine, model) && (!is_one_speed(b, runs) || is_drowned(b, runs, d));
}

const char *hci_no_load_denied(const hci_dataset *b, const hci_runs *runs, const hci_candidates *model,
                               const hci_diagnosis *d)
{
    if (hci_no_load_rises(b, runs, d) && !hci_no_load_is_shown(b, runs, model, d))
        return is_new(b->regression.machine, model)
                   ? "The runs under load deny a torque over the angle that those without a current show at "
                     "their one speed: their ripple is larger with it, as where it is a frequency, such as "
                     "that "
                     "of the mains; it was left out"
                   : "The runs under load deny a torque over the angle that those without a current show: "
                     "their "
                     "ripple is larger with it, as where the torque sensor lags or its coupling has play; it "
                     "was "
                     "left out";
    if (is_one_speed(b, runs) && is_like_lag(b->regression.machine, model))
        return "What the runs without a current show at their one speed may be other cogging, or a torque "
               "sensor "
               "that lags or averages; it was left out, and a run at another speed would tell";
    return NULL;
}
