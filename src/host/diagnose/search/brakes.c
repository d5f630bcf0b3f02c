#include "host/diagnose/search/brakes.h"

#include <math.h>

#include "host/diagnose/fit/model.h"

/* Of what an effect brakes with at most, that it may drive with, or brake less, elsewhere. */
#define DRIVES 0.2

/* ---- what brakes ---- */

static bool is_brake(const hci_effect_type *type)
{
    return type->drag_Nm || type->coulomb_Nm;
}

/* Whether torques are linear in all values of a type, as in those of a power series. */
static bool is_series(const hci_effect_type *type)
{
    for (size_t k = 0; k < type->parameter_count; ++k)
        if (!(type->parameter[k].traits & HCI_PARAMETER_LINEAR)) return false;
    return true;
}

bool hci_brakes_have_other(const hci_candidates *candidates, const hci_effect_type *type)
{
    for (size_t k = 0; k < candidates->count; ++k) {
        const hci_candidate *x = &candidates->candidate[k];
        if (x->in && x->type != type && x->type->coulomb_Nm) return true;
    }
    return false;
}

bool hci_brakes_has_further_power(const hci_candidate *x)
{
    const hci_effect_term *last = &x->term[x->count - 1];
    return x->count > 1 && x->type->coulomb_Nm &&
           x->type->parameter[last->parameter].traits & HCI_PARAMETER_LINEAR;
}

/* ---- their laws ---- */

/* What an effect brakes with at the currents of a run and at a speed, N·m. */
static double brake_Nm(const hci_effect *x, const hci_run_statistics *run, double speed_rad_per_s)
{
    const double to_plane = sqrt(1.5), sign = run->mean_speed_rad_per_s < 0.0 ? -1.0 : 1.0;
    const hci_plant_state state = {.i = {to_plane * run->mean_id_A, to_plane * run->mean_iq_A},
                                   .speed_rad_per_s = sign * speed_rad_per_s};
    const double drag_Nm = x->type->drag_Nm ? sign * x->type->drag_Nm(x, &state) : 0.0;
    return drag_Nm + (x->type->coulomb_Nm ? x->type->coulomb_Nm(x) : 0.0);
}

/* How fast a run turns, whether one way or back and forth; 0: not at all, or not in use. */
static double speed_of(const hci_regression *e, size_t run)
{
    const hci_run_statistics *x = &e->samples->statistics[run];
    return e->use[run] ? fmax(fabs(x->mean_speed_rad_per_s), x->speed_deviation) : 0.0;
}

static double slowest_rad_per_s(const hci_regression *e)
{
    double slowest = INFINITY;
    for (size_t r = 0; r < e->samples->run_count; ++r)
        if (speed_of(e, r) > 0.0) slowest = fmin(slowest, speed_of(e, r));
    return slowest;
}

/* Whether a law drives the shaft of a run, by more than the error of one that hardly brakes there, or is a
 * power series that brakes less than at the slowest speed. */
static bool is_driving(const hci_regression *e, const hci_effect *x)
{
    const double slowest = slowest_rad_per_s(e);
    double least_Nm = 0.0, most_Nm = 0.0;
    for (size_t r = 0; r < e->samples->run_count; ++r) {
        const hci_run_statistics *run = &e->samples->statistics[r];
        if (!(speed_of(e, r) > 0.0)) continue;
        const double slow_Nm = brake_Nm(x, run, slowest), brakes_Nm = brake_Nm(x, run, speed_of(e, r));
        most_Nm = fmax(most_Nm, fmax(slow_Nm, brakes_Nm));
        least_Nm = fmin(least_Nm, brakes_Nm);
        if (is_series(x->type)) least_Nm = fmin(least_Nm, brakes_Nm - slow_Nm);
    }
    return -least_Nm > DRIVES * most_Nm;
}

/* Ratio of two paces that are one. */
#define ONE_PACE 1.15

/* Whether a recording in use turns in a direction at a pace. */
static bool turns_so(const hci_regression *e, double pace_rad_per_s, int way)
{
    for (size_t r = 0; r < e->samples->run_count; ++r) {
        const hci_run_statistics *x = &e->samples->statistics[r];
        if (!(speed_of(e, r) > 0.0) ||
            fmax(x->pace_rad_per_s, pace_rad_per_s) > ONE_PACE * fmin(x->pace_rad_per_s, pace_rad_per_s))
            continue;
        if (x->both_ways || way * x->mean_speed_rad_per_s > 0.0) return true;
    }
    return false;
}

bool hci_brakes_hang_on_one_way(const hci_regression *e)
{
    bool have_both = false, have_one = false;
    for (size_t r = 0; r < e->samples->run_count; ++r) {
        const double pace_rad_per_s = e->samples->statistics[r].pace_rad_per_s;
        if (!(speed_of(e, r) > 0.0) || !(pace_rad_per_s > 0.0)) continue;
        const bool is_both = turns_so(e, pace_rad_per_s, 1) && turns_so(e, pace_rad_per_s, -1);
        have_both = have_both || is_both;
        have_one = have_one || !is_both;
    }
    return have_both && have_one;
}

hci_status hci_brakes_find_driving(const hci_regression *e, const hci_candidates *candidates,
                                   const hci_effect_type **type, hci_note *note)
{
    hci_model model;
    const hci_status status = hci_model_make(e->declared, candidates, false, &model, note);
    *type = NULL;
    if (status) return status;
    for (size_t k = 0; k < model.list.count && !*type; ++k) {
        const hci_effect *x = &model.list.effect[k];
        if (is_brake(x->type) && hci_candidates_have(candidates, x->type) && is_driving(e, x))
            *type = x->type;
    }
    hci_model_release(&model);
    return HCI_OK;
}

hci_status hci_brakes_drive(const hci_regression *e, const hci_candidates *candidates,
                            const hci_effect_type *type, bool *drives, hci_note *note)
{
    const hci_effect_type *driving = NULL;
    hci_status status = HCI_OK;
    if (is_brake(type)) status = hci_brakes_find_driving(e, candidates, &driving, note);
    *drives = driving && driving == type;
    return status;
}
