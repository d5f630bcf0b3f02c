#include "host/recording/untold_torque.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "hci/math/harmonic.h"
#include "host/base/memory.h"
#include "host/numeric/derivative.h"
#include "host/numeric/statistics.h"
#include "host/recording/effort.h"
#include "host/recording/rotor_frame.h"
#include "host/recording/slow_turn.h"
#include "host/recording/speed_variation.h"
#include "host/recording/turn_balance.h"
#include "host/recording/turn_ways.h"

/* A share of its mean speed by which a shaft that sticks and slips varies, and one that control turns does
 * not. */
#define UNSTEADY 0.3

/* Of the rows, in which a shaft turns a way of which something is said. */
#define SEEN_WAY 0.05

typedef struct {
    hci_run *run;
    const hci_run_options *options;
    bool accelerates; /* torque_Nm is inertia × acceleration */
    bool has_ways;    /* turns are told apart */
    hci_turn_ways ways;
    hci_note *note;
} task;

static hci_status memory_error(const task *t)
{
    return hci_note_memory(t->note, t->run->name, "%zu samples", t->run->count);
}

/* ---- inertia × acceleration ---- */

static bool knows_inertia(const hci_run_options *o)
{
    return o->inertia_kgm2 > 0.0;
}

/* Without a current but with voltages something drives the shaft, whose torque is not known. */
static bool can_accelerate(const task *t, bool no_currents)
{
    const hci_run *run = t->run;
    if (no_currents && run->v_V != NULL) return false;
    return knows_inertia(t->options) && run->time_s != NULL && run->speed_rad_per_s != NULL &&
           run->count >= 3;
}

static int compare(const void *a, const void *b)
{
    const double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

/* rad/s, which a tenth of the samples do not exceed. */
static double slowest_of(const hci_run *run)
{
    enum { MOST = 1000 };
    double speed[MOST];
    const size_t count = run->count < MOST ? run->count : MOST;
    for (size_t k = 0; k < count; ++k)
        speed[k] = fabs(run->speed_rad_per_s[k * run->count / count]);
    qsort(speed, count, sizeof *speed, compare);
    return speed[count / 10];
}

/* The electrical order of which the slopes last a whole period where the shaft is slow: a slope over a period
 * shows 3/π² of what swings, and over more of them next to nothing. */
static double reach_of(const hci_run *run)
{
    const double span = (double)(run->torque_window + run->speed_window) / (double)(run->count - 1);
    const double slope_s = span * (run->time_s[run->count - 1] - run->time_s[0]);
    return 2.0 * HCI_PI / (slope_s * slowest_of(run) * run->pole_pairs);
}

/* torque_Nm as inertia × the slope of the speed. */
static void accelerate(hci_run *run, double inertia_kgm2)
{
    run->torque_window = hci_derivative_window(run->time_s, run->speed_rad_per_s, run->count);
    hci_derivative_over(run->time_s, run->speed_rad_per_s, run->count, run->torque_window, run->torque_Nm);
    for (size_t k = 0; k < run->count; ++k)
        run->torque_Nm[k] *= inertia_kgm2;
    run->torque_reach = reach_of(run);
}

/* torque_Nm as inertia × what the orders of the angle over time say. */
static void accelerate_by_orders(const task *t, double inertia_kgm2)
{
    hci_run *run = t->run;
    for (size_t k = 0; k < run->count; ++k) {
        const hci_way *way = &t->ways.way[run->speed_rad_per_s[k] < 0.0];
        run->torque_Nm[k] =
            way->any ? inertia_kgm2 * hci_way_acceleration(&t->ways, way, run->theta_m_rad[k]) : 0.0;
    }
}

/* ---- a shaft that is turned slowly ---- */

static hci_status find_ways(task *t)
{
    const bool can = t->options->torque_constant_Nm_per_A > 0.0 && t->run->speed_rad_per_s != NULL;
    const hci_status status =
        can ? hci_turn_ways_find(t->run, t->run->pole_pairs, &t->ways, &t->has_ways) : HCI_OK;
    return status ? memory_error(t) : HCI_OK;
}

/* Stops in an electrical turn, and at least, of a shaft that sticks and slips; one that is turned in plateaus
 * stops less. */
#define STOPS_A_TURN 0.5
enum { LEAST_STOPS = 4 };

static void judge_stops(hci_run *run)
{
    double path_turns;
    const size_t stops = hci_speed_stops(run, run->pole_pairs, &path_turns);
    if (run->is_unsteady || stops < LEAST_STOPS || !((double)stops > STOPS_A_TURN * path_turns)) return;
    run->is_unsteady = true;
    hci_note_add(
        &run->remark,
        "the shaft comes to rest %zu times on its way and goes on, in %.3g electrical turns there and "
        "back: it sticks and slips, or goes in steps, so that its current answers acceleration and "
        "breakaway, and orders found in it are not those of cogging torque",
        stops, path_turns);
}

/* Told where the current answers breakaway and acceleration, and not cogging torque alone. */
static hci_status judge_speed(const task *t)
{
    hci_run *run = t->run;
    double share;
    if (!hci_speed_variation(run, run->pole_pairs, &share)) return memory_error(t);
    run->is_unsteady = share > UNSTEADY;
    if (run->is_unsteady)
        hci_note_add(&run->remark,
                     "the speed varies by %.0f %% rms within half an electrical turn: the shaft sticks and "
                     "slips, or goes in steps, so that its current answers acceleration and breakaway, and "
                     "orders found in it are not those of cogging torque%s",
                     100.0 * share,
                     run->rough_clock && run->speed_window > 0
                         ? "; or its stamps, which come early and late by turns, are too coarse to tell, and "
                           "rows of an even period, or a column of the speed, would"
                         : "");
    judge_stops(run);
    return HCI_OK;
}

/* Of the torque that i_q makes, in each direction. */
static void say_load(const hci_run *run, double constant, hci_note *remark)
{
    double sum_Nm[2] = {0.0, 0.0}, count[2] = {0.0, 0.0};
    char text[2][48] = {"", ""};
    for (size_t k = 0; k < run->count; ++k) {
        const int back = run->speed_rad_per_s[k] < 0.0;
        sum_Nm[back] += constant * hci_run_dq(run, run->pole_pairs, k).q;
        count[back] += 1.0;
    }
    for (int back = 0; back < 2; ++back)
        if (count[back] > SEEN_WAY * (double)run->count)
            snprintf(text[back], sizeof text[back], "%.3g N·m %s", sum_Nm[back] / count[back],
                     back ? "back" : "forward");
    hci_note_add(remark,
                 "i_q makes %s%s%s on the average: a load, friction and what brakes together, which nothing "
                 "here tells apart; it is taken as an unknown constant of each direction",
                 text[0], text[0][0] && text[1][0] ? " and " : "", text[1]);
}

/* A shaft that works against a load tells the ripple beside it. */
static void judge_load(hci_run *run, double constant)
{
    run->mean_is_unknown = run->theta_m_rad != NULL && hci_run_is_loaded(run, run->pole_pairs);
    if (run->mean_is_unknown && run->speed_rad_per_s != NULL && constant > 0.0)
        say_load(run, constant, &run->remark);
}

/* Standard errors beyond which a mean is more than chance. */
#define SURE 5.0

/* What pulls the same way in both directions is a load, as a weight is, or a zero of i_q: cogging torque has
 * no mean over the turn, and friction turns round. */
static void take_weight_out(const task *t, double constant)
{
    const hci_way *way = t->ways.way;
    if (!t->has_ways || !way[0].any || !way[1].any || t->run->mean_is_unknown) return;
    const hci_way_wave *forward = &way[0].order[0].iq_A, *back = &way[1].order[0].iq_A;
    const double iq_A = 0.5 * (forward->cosine + back->cosine),
                 error_A = 0.5 * hypot(forward->std_error, back->std_error);
    if (!(fabs(iq_A) > SURE * error_A)) return;
    hci_slow_turn_take_constant(t->run, t->run->pole_pairs, iq_A);
    hci_note_add(
        &t->run->remark,
        "i_q makes %.3g N·m the same way in both directions: a weight on the shaft, or a zero of i_q, "
        "and nothing that a motor makes by itself; it is taken out",
        constant * iq_A);
}

/* The current is the reading, less what of it accelerates: torque_Nm. */
static hci_status hold(const task *t)
{
    hci_run *run = t->run;
    const double constant = t->options->torque_constant_Nm_per_A;
    run->torque_source = HCI_TORQUE_HOLDING;
    run->torque_window = 0;
    run->torque_reach = 0.0;
    if (constant > 0.0 && run->theta_m_rad != NULL &&
        hci_mean_square_about(run->torque_Nm, run->count, 0.0) > 0.0)
        hci_slow_turn_correct(run, run->pole_pairs, constant);
    for (size_t k = 0; k < run->count; ++k)
        run->torque_Nm[k] = 0.0;
    const bool has_room =
        hci_row_direction_set(run) && (run->is_unsteady || hci_settled_rows_keep(run, run->pole_pairs));
    if (has_room) judge_load(run, constant);
    if (has_room) take_weight_out(t, constant);
    return has_room ? HCI_OK : memory_error(t);
}

static void leave_untold(const task *t)
{
    hci_run *run = t->run;
    hci_memory_free(run->torque_Nm);
    run->torque_Nm = NULL;
    run->torque_source = HCI_TORQUE_NONE;
    run->needs_inertia = true;
    hci_note_add(
        &run->remark,
        "not used as one: the speed varies with the angle so fast that the inertia may answer a good "
        "part of the cogging torque, which the current then does not show (it does within a tenth "
        "where rotor and what turns with it have less than %.2g kg·m²); give the inertia, or record "
        "more slowly",
        hci_balance_limit(&t->ways, t->options->torque_constant_Nm_per_A));
}

/* An inertia by the turns themselves; kgm2 0: they do not tell it. */
typedef struct {
    double kgm2, std_error;
} inertia;

static inertia balance(const task *t, const hci_turn_ways *ways, size_t count)
{
    inertia of = {0.0, 0.0};
    of.kgm2 = hci_balance_inertia(ways, count, t->options->torque_constant_Nm_per_A, &of.std_error);
    return of;
}

static void take_inertia(const task *t, inertia of)
{
    t->run->turns_inertia_kgm2 = of.kgm2;
    t->run->turns_inertia_error_kgm2 = of.std_error;
    accelerate_by_orders(t, of.kgm2);
}

#define SLOWEST_STOP 20.0 /* rad/s², of a shaft without a load by its own friction and cogging torque */

/* About the most that the current makes. */
static double made_Nm(const task *t)
{
    double most_A = 0.0;
    for (size_t k = 0; k < 3 * t->run->count; ++k)
        most_A = fmax(most_A, fabs(t->run->i_A[k]));
    return t->options->torque_constant_Nm_per_A * most_A;
}

/* What turns do not tell: beside a load, whose ripple differs forward and back too, whatever it is; without
 * one up to what friction and cogging torque would hardly stop. */
static void set_limit(const task *t)
{
    const double limit_kgm2 = hci_balance_limit(&t->ways, t->options->torque_constant_Nm_per_A);
    if (t->run->is_unsteady || !isfinite(limit_kgm2)) return;
    if (t->run->mean_is_unknown || limit_kgm2 < made_Nm(t) / SLOWEST_STOP)
        t->run->inertia_limit_kgm2 = limit_kgm2;
}

#define FAR   1.5  /* times an inertia, by which another one is no error of the torque per ampere */
#define WIDTH 3.0  /* standard errors */
#define ROUGH 0.05 /* of an inertia by means over windows, in which a slope is not that at one time */

/* What recordings say of the declared inertia: that it is between these. */
static void judge_between(const task *t, double least_kgm2, double most_kgm2, const char *by)
{
    hci_run *run = t->run;
    const double declared_kgm2 = t->options->inertia_kgm2;
    run->least_inertia_kgm2 = least_kgm2;
    run->most_inertia_kgm2 = most_kgm2;
    run->denies_inertia = declared_kgm2 > FAR * most_kgm2 || FAR * declared_kgm2 < least_kgm2;
    if (run->denies_inertia)
        hci_note_add(&run->remark, "%s an inertia of %.2g to %.2g kg·m², and not the declared %.4g", by,
                     least_kgm2, most_kgm2, declared_kgm2);
}

/* Both directions of a slow turn are of one machine. */
static void judge_by_turns(const task *t)
{
    double least_kgm2, most_kgm2;
    if (!t->has_ways || t->run->is_unsteady || t->run->mean_is_unknown) return;
    if (hci_balance_bounds(&t->ways, t->options->torque_constant_Nm_per_A, &least_kgm2, &most_kgm2))
        judge_between(t, least_kgm2, most_kgm2, "its turns forward and back tell");
}

/* What a current accelerates over many turns. */
static void judge_by_current(const task *t)
{
    const double constant = t->options->torque_constant_Nm_per_A;
    const double kgm2 = constant * t->run->iq_per_acceleration,
                 width_kgm2 = ROUGH * kgm2 + WIDTH * constant * t->run->iq_per_acceleration_error;
    if (constant > 0.0 && kgm2 > 0.0)
        judge_between(t, kgm2 - width_kgm2, kgm2 + width_kgm2, "what its current accelerates tells");
}

/* Takes out what accelerates where that is known; of: what the turns tell. */
static hci_status settle(const task *t, inertia of)
{
    hci_note *remark = &t->run->remark;
    const hci_status status = judge_speed(t);
    if (status) return status;
    if (knows_inertia(t->options)) {
        if (t->has_ways) accelerate_by_orders(t, t->options->inertia_kgm2);
        if (t->accelerates || t->has_ways)
            hci_note_add(remark, t->has_ways ? "acceleration by the orders of the angle over time"
                                             : "acceleration by the slope of the speed");
        const hci_status held = hold(t);
        if (!held) judge_by_turns(t);
        return held;
    }
    if (!t->has_ways) return hold(t);
    if (of.kgm2 > 0.0) {
        hci_note_add(remark, "an inertia of %.3g ± %.1g kg·m² makes the torque of its turns agree", of.kgm2,
                     of.std_error);
        take_inertia(t, of);
    } else if (!t->run->is_unsteady && hci_balance_needs_inertia(&t->ways)) {
        leave_untold(t);
        return HCI_OK;
    }
    const hci_status held = hold(t);
    if (!held && !(of.kgm2 > 0.0)) set_limit(t);
    return held;
}

static const char *why_held(const task *t)
{
    const hci_run_options *o = t->options;
    if (o->holding) return "turned slowly, as --holding says";
    if (t->accelerates &&
        hci_is_slow_turn(t->run, t->run->pole_pairs, o->inertia_kgm2, o->torque_constant_Nm_per_A))
        return "the shaft turns so slowly that its current answers cogging and friction";
    if (t->has_ways && knows_inertia(o) && hci_is_slow(t->run, t->run->pole_pairs))
        return "turned slowly by control, its current and its inertia answer cogging and friction";
    if (!t->accelerates && o->torque_constant_Nm_per_A > 0.0 &&
        hci_is_slow_turn_both_ways(t->run, t->run->pole_pairs))
        return "turned slowly forward and back, its current answers cogging and friction";
    return NULL;
}

static hci_status free_or_held(task *t)
{
    hci_run *run = t->run;
    if (t->accelerates) accelerate(run, t->options->inertia_kgm2);
    const char *why = why_held(t);
    if (why != NULL) {
        hci_note_add(&run->remark, "no torque_Nm: %s, read as a holding test", why);
        return settle(t, t->has_ways ? balance(t, &t->ways, 1) : (inertia){0.0, 0.0});
    }
    if (t->accelerates) {
        run->torque_source = HCI_TORQUE_INERTIA;
        judge_by_current(t);
        hci_note_add(&run->remark, "no torque_Nm: as of a free shaft it is inertia x acceleration");
        if (run->torque_reach < HCI_USUAL_ORDER)
            hci_note_add(&run->remark,
                         "its slopes show next to nothing of a torque of an electrical order above %.3g",
                         run->torque_reach);
        if (hci_is_slow(run, run->pole_pairs)) judge_stops(run);
        return hci_rest_at_ends_leave(run) ? HCI_OK : memory_error(t);
    }
    hci_memory_free(run->torque_Nm);
    run->torque_Nm = NULL;
    return HCI_OK;
}

/* Whether orders of the turn could be of use: they cost some time. */
static bool may_be_slow(const task *t, bool no_currents)
{
    return !no_currents && t->options->torque_constant_Nm_per_A > 0.0 &&
           (t->options->holding || hci_is_slow(t->run, t->run->pole_pairs));
}

hci_status hci_untold_torque_set(hci_run *run, const hci_run_options *options, bool no_currents,
                                 hci_note *note)
{
    task t = {.run = run, .options = options, .note = note};
    t.accelerates = can_accelerate(&t, no_currents);
    /* before what accelerates is taken out of the current */
    hci_status status = no_currents ? HCI_OK : hci_run_effort_set(run, note);
    if (!status && may_be_slow(&t, no_currents)) status = find_ways(&t);
    if (!status) run->torque_Nm = hci_memory_new(run->count, sizeof(double));
    if (!status) status = run->torque_Nm != NULL ? free_or_held(&t) : memory_error(&t);
    hci_turn_ways_release(&t.ways);
    return status;
}

/* ---- turns beside each other ---- */

typedef struct {
    task *task;          /* [count], of which slow ones have ways */
    hci_turn_ways *ways; /* [used], of the slow ones */
    size_t count, used;
    bool forward, backward, told; /* ways that there are; a run was read as slow by itself */
} slow_runs;

/* A run that its own turns do not tell enough of. */
static bool is_open(const hci_run *run)
{
    return run->torque_Nm == NULL && !run->torque_is_typed &&
           (run->needs_inertia || hci_is_slow(run, run->pole_pairs));
}

static hci_status find_slow(hci_run *runs, const hci_run_options *options, slow_runs *s, hci_note *note)
{
    hci_status status = HCI_OK;
    for (size_t k = 0; k < s->count && !status; ++k) {
        task *t = &s->task[k];
        *t = (task){.run = &runs[k], .options = options, .note = note};
        if (is_open(t->run)) status = find_ways(t);
        if (!t->has_ways) continue;
        s->ways[s->used++] = t->ways;
        s->forward = s->forward || t->ways.way[0].any;
        s->backward = s->backward || t->ways.way[1].any;
        s->told = s->told || t->run->needs_inertia;
    }
    return status;
}

static hci_status settle_slow(const slow_runs *s)
{
    const bool both = s->forward && s->backward;
    hci_status status = HCI_OK;
    if (s->used < 2 || !(both || s->told)) return HCI_OK;
    const inertia of = balance(&s->task[0], s->ways, s->used);
    for (size_t k = 0; k < s->count && !status; ++k) {
        const task *t = &s->task[k];
        hci_run *run = t->run;
        if (!t->has_ways || !(both || run->needs_inertia)) continue;
        if (run->needs_inertia && !(of.kgm2 > 0.0)) continue;
        run->torque_Nm = hci_memory_new(run->count, sizeof(double));
        if (run->torque_Nm == NULL) return memory_error(t);
        hci_note_add(&run->remark, "%s",
                     run->needs_inertia ? "beside other recordings it is used"
                                        : "no torque_Nm: turned slowly, forward in one recording and back in "
                                          "another, read as a holding test");
        run->needs_inertia = false;
        run->slow_beside_others = true;
        status = settle(t, of);
    }
    return status;
}

/* ---- one inertia for all of them ---- */

/* Of the recordings whose turns tell it, the mean by their errors; of one rotor on one bench. */
static inertia told_inertia(const hci_run *runs, size_t count)
{
    double weight = 0.0, sum = 0.0;
    for (size_t k = 0; k < count; ++k) {
        const double error = runs[k].turns_inertia_error_kgm2;
        if (!(runs[k].turns_inertia_kgm2 > 0.0) || !(error > 0.0)) continue;
        weight += 1.0 / (error * error);
        sum += runs[k].turns_inertia_kgm2 / (error * error);
    }
    return weight > 0.0 ? (inertia){sum / weight, 1.0 / sqrt(weight)} : (inertia){0.0, 0.0};
}

/* A slow turn, as it is read by now, without it. */
static bool lacks_inertia(const hci_run *run)
{
    return run->torque_source == HCI_TORQUE_HOLDING && run->torque_Nm != NULL && !run->is_unsteady &&
           !(run->turns_inertia_kgm2 > 0.0) && hci_is_slow(run, run->pole_pairs);
}

/* One that was not used for want of it. */
static hci_status use_with(const task *t, inertia of)
{
    hci_run *run = t->run;
    run->torque_Nm = hci_memory_new(run->count, sizeof(double));
    if (run->torque_Nm == NULL) return memory_error(t);
    run->needs_inertia = false;
    run->slow_beside_others = true;
    hci_note_add(&run->remark, "with the inertia of another recording it is used");
    return settle(t, of);
}

/* One that was used without it, and of which rows are left out by now. */
static void correct_with(const task *t, inertia of)
{
    hci_run *run = t->run;
    hci_note_add(&run->remark,
                 "the inertia of %.3g ± %.1g kg·m² that turns of another recording tell is used here too",
                 of.kgm2, of.std_error);
    run->inertia_limit_kgm2 = 0.0;
    take_inertia(t, of);
    hci_slow_turn_correct(run, run->pole_pairs, t->options->torque_constant_Nm_per_A);
    for (size_t k = 0; k < run->count; ++k)
        run->torque_Nm[k] = 0.0;
}

static hci_status share_inertia(hci_run *runs, size_t count, const hci_run_options *options, hci_note *note)
{
    const inertia of = told_inertia(runs, count);
    hci_status status = HCI_OK;
    for (size_t k = 0; k < count && of.kgm2 > 0.0 && !status; ++k) {
        task t = {.run = &runs[k], .options = options, .note = note};
        if (lacks_inertia(t.run) || t.run->needs_inertia) status = find_ways(&t);
        if (!status && t.has_ways && t.run->needs_inertia)
            status = use_with(&t, of);
        else if (!status && t.has_ways)
            correct_with(&t, of);
        hci_turn_ways_release(&t.ways);
    }
    return status;
}

/* Where nothing told it. */
static void say_limits(hci_run *runs, size_t count)
{
    for (size_t k = 0; k < count; ++k)
        if (runs[k].inertia_limit_kgm2 > 0.0)
            hci_note_add(&runs[k].remark,
                         "the inertia is not known, and %sthe turns do not tell it: with %.2g "
                         "kg·m² of rotor and what turns with it a tenth of what varies in the current "
                         "accelerates",
                         runs[k].mean_is_unknown ? "beside a load " : "", runs[k].inertia_limit_kgm2);
}

static hci_status join(hci_run *runs, size_t count, const hci_run_options *options, hci_note *note)
{
    slow_runs s = {.count = count};
    s.task = hci_memory_new(count, sizeof *s.task);
    s.ways = hci_memory_new(count, sizeof *s.ways);
    hci_status status = s.task != NULL && s.ways != NULL
                            ? find_slow(runs, options, &s, note)
                            : hci_note_memory(note, NULL, "%zu recordings", count);
    if (!status) status = settle_slow(&s);
    if (!status) status = share_inertia(runs, count, options, note);
    for (size_t k = 0; k < count && s.task != NULL; ++k)
        hci_turn_ways_release(&s.task[k].ways);
    hci_memory_free(s.task);
    hci_memory_free(s.ways);
    return status;
}

hci_status hci_untold_torques_join(hci_run *runs, size_t count, const hci_run_options *options,
                                   hci_note *note)
{
    hci_status status = HCI_OK;
    if (!knows_inertia(options) && options->torque_constant_Nm_per_A > 0.0 && count > 1)
        status = join(runs, count, options, note);
    if (!status) say_limits(runs, count);
    return status;
}
