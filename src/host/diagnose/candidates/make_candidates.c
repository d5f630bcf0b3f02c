#include "host/diagnose/candidates/make_candidates.h"

#include <assert.h>
#include <math.h>
#include <string.h>

#include "host/base/memory.h"
#include "host/diagnose/candidates/angle_orders.h"
#include "host/diagnose/candidates/candidate_orders.h"
#include "host/diagnose/candidates/empirical_term.h"
#include "host/diagnose/candidates/flux_orders.h"
#include "host/diagnose/candidates/residual_by_speed.h"
#include "host/diagnose/prepare/lag_told.h"

enum {
    MOST_SLOT_ORDERS = 12, /* orders of slots and poles that are looked into at a time */
    MOST_TURN_ORDERS = 6,  /* and of those that repeat with the mechanical turn only */
    UNKNOWN_LINES = 3,
    MOST_SPEEDS = 3
};

#define SIMILAR    0.15 /* speeds that differ by less, as a share, are the same */
#define LEAST_LOAD 0.1  /* of the largest current, in a run with a load; and of its own, along q */
#define EVEN_LOAD  0.7  /* of the current, that its mean is in a run with one load all along */
#define AROUND     1.2  /* standard deviations above a mean speed: at 0.85 of a ramp from 0 */

#define LEAST_PERIOD 0.02 /* electrical, that a shaft turns by which is not held */
#define WHOLE_TURN   0.95 /* mechanical: the last sample stands before the first one */

#define LITTLE 0.1 /* current beside the largest, that is next to none */

#define LEAST_WARMING_K 2.0 /* a sensor of a temperature that stays wanders less */

/* ---- a list that grows ---- */

typedef struct {
    hci_candidates *list;
    const hci_effect_type *type; /* of what is added */
    const hci_effects *declared;
    size_t capacity;
    double resolved;         /* highest order that the samples tell */
    bool no_current, failed; /* no_current: of no run */
    bool lag_told;           /* of a torque sensor */
} builder;

static bool reserve(builder *b)
{
    if (b->list->count < b->capacity) return true;
    const size_t wanted = 2 * b->capacity + 64;
    hci_candidate *grown = hci_memory_resize(b->list->candidate, wanted, sizeof *grown);
    if (!grown) return false;
    b->list->candidate = grown;
    b->capacity = wanted;
    return true;
}

static double price_of(double alternatives)
{
    return 2.0 * log(fmax(1.0, alternatives));
}

/* The value that the machine has declared of a term; 0 where it has none. */
static double declared_value(const builder *b, size_t parameter, double order)
{
    for (size_t k = 0; k < b->declared->count; ++k) {
        const hci_effect *e = &b->declared->effect[k];
        for (size_t j = 0; e->type == b->type && j < e->count; ++j)
            if (e->term[j].parameter == parameter && fabs(e->term[j].order - order) < HCI_ORDER_TOLERANCE)
                return e->term[j].value;
    }
    return 0.0;
}

/* Whether a term cannot be seen without current. */
static bool needs_current(const hci_effect_type *type, size_t parameter)
{
    return type->sum_by_value || (parameter < type->parameter_count &&
                                  (type->parameter[parameter].traits & HCI_PARAMETER_WITH_CURRENT));
}

/* Whether the recordings may say anything of a term. */
static bool is_told(const builder *b, size_t parameter)
{
    const bool is_lag = parameter < b->type->parameter_count &&
                        (b->type->parameter[parameter].traits & HCI_PARAMETER_LAG) != 0;
    return !(b->no_current && needs_current(b->type, parameter)) && (b->lag_told || !is_lag);
}

/* For hci_effect_proposals: context is a builder. */
static void add(void *context, const hci_effect_candidate *x)
{
    builder *b = context;
    if (x->order > b->resolved || !is_told(b, x->parameter)) return;
    b->failed = b->failed || !reserve(b);
    if (b->failed) return;
    hci_candidate *s = &b->list->candidate[b->list->count++];
    assert(x->count <= HCI_CANDIDATE_TERMS);
    memset(s, 0, sizeof *s);
    s->type = b->type;
    s->count = x->count;
    s->price = price_of(x->alternatives);
    s->deviation = x->expected;
    for (size_t k = 0; k < x->count; ++k) {
        s->declared[k] = declared_value(b, x->parameter + k, x->order);
        const double start = x->start && s->declared[k] == 0.0 ? x->start[k] : s->declared[k];
        s->term[k] = (hci_effect_term){x->parameter + k, x->order, start, NAN};
    }
}

/* ---- what no effect explains ---- */

static void add_unknown(builder *b, const hci_candidates_source *s, const hci_candidate_orders *lines)
{
    size_t taken[UNKNOWN_LINES], growth = 0;
    b->type = &hci_empirical_type;
    for (size_t n = 0; n < UNKNOWN_LINES; ++n) {
        taken[n] = hci_candidate_orders_empirical(lines, s->samples, taken, n, &growth);
        if (taken[n] == 0) return;
        const double order = (double)(taken[n] * lines->stride) / s->machine->pole_pairs;
        add(b, &(hci_effect_candidate){.parameter = 2 * growth,
                                       .count = 2,
                                       .order = order,
                                       .alternatives = (double)lines->count * HCI_GROWTH_LAWS});
    }
}

/* ---- what the recordings are like as a whole ---- */

typedef struct {
    double known[MOST_SPEEDS];
    size_t count;
} speeds;

static void speed_add(speeds *x, double speed)
{
    bool is_new = x->count < MOST_SPEEDS && (speed > 0.0 || x->count == 0);
    for (size_t k = 0; k < x->count; ++k)
        is_new = is_new && fabs(speed - x->known[k]) > SIMILAR * fmax(speed, x->known[k]);
    if (is_new) x->known[x->count++] = speed;
}

/* How many different speeds the runs have, at most three. A run that accelerates has a higher one too; how a
 * friction is curved over a single ramp is hard to tell from what it begins with. */
static size_t speeds_of(const hci_candidates_source *s)
{
    speeds x = {.count = 0};
    for (size_t r = 0; r < s->samples->run_count; ++r) {
        const hci_run_statistics *f = &s->samples->statistics[r];
        if (!s->use[r]) continue;
        speed_add(&x, f->pace_rad_per_s);
        speed_add(&x, f->pace_rad_per_s + AROUND * f->pace_deviation);
    }
    return x.count;
}

/* Whether the temperature is another one at times: of one that stays a share of the torque is left open. */
static bool warms(const hci_candidates_source *s)
{
    double coldest_C = INFINITY, hottest_C = -INFINITY;
    for (size_t r = 0; r < s->samples->run_count; ++r) {
        const hci_run_statistics *f = &s->samples->statistics[r];
        if (!s->use[r] || !isfinite(f->temperature_C)) continue;
        coldest_C = fmin(coldest_C, f->coldest_C);
        hottest_C = fmax(hottest_C, f->hottest_C);
    }
    return hottest_C - coldest_C > LEAST_WARMING_K;
}

/* Whether a run over time turns the shaft by less than once: orders closer than one over that are not told
 * apart, so only whole electrical ones are looked for. One that hardly moves has no order. */
static bool is_part_of_turn(const hci_candidates_source *s, size_t run)
{
    const double turns = s->samples->statistics[run].turns;
    return s->runs[run].time_s && turns * s->machine->pole_pairs > LEAST_PERIOD && turns < WHOLE_TURN;
}

/* Whether a run has a current along q of that sign: all along, or at times. */
static bool may_have(const hci_run_statistics *f, double sign)
{
    const bool varies = hypot(f->mean_id_A, f->mean_iq_A) < EVEN_LOAD * f->current_A;
    return varies || sign * f->mean_iq_A > LEAST_LOAD * f->current_A;
}

static double largest_current_A(const hci_binned_samples *samples, const bool *use)
{
    double most_A = 0.0;
    for (size_t r = 0; r < samples->run_count; ++r)
        most_A = fmax(most_A, use[r] ? samples->statistics[r].current_A : 0.0);
    return most_A;
}

/* Whether all loads have an i_q of one sign: what of the mean torque keeps its sign with the load is not told
 * from what turns it. */
static bool are_one_sided(const hci_binned_samples *samples, const bool *use)
{
    const double most_A = largest_current_A(samples, use);
    bool drives = false, brakes = false;
    for (size_t r = 0; r < samples->run_count; ++r) {
        const hci_run_statistics *f = &samples->statistics[r];
        const bool is_load = use[r] && f->current_A > LEAST_LOAD * most_A;
        drives = drives || (is_load && may_have(f, 1.0));
        brakes = brakes || (is_load && may_have(f, -1.0));
    }
    return !(drives && brakes);
}

enum { MOST_LOADS = 16 };

/* Loads of one direction that differ. */
typedef struct {
    double current_A[MOST_LOADS];
    size_t count;
} loads;

static bool is_alike(double one_A, double other_A)
{
    return fabs(one_A - other_A) <= SIMILAR * fmax(fabs(one_A), fabs(other_A));
}

static bool has_alike(const loads *x, double current_A)
{
    bool any = false;
    for (size_t k = 0; k < x->count; ++k)
        any = any || is_alike(x->current_A[k], current_A);
    return any;
}

static void load_add(loads *x, double current_A)
{
    if (x->count < MOST_LOADS && !has_alike(x, current_A)) x->current_A[x->count++] = current_A;
}

/* Whether the shaft turned forward and back under load, so that what the direction turns is told from what is
 * curved over the current: at the same current, or at two in each direction. */
static bool are_loaded_both_ways(const hci_binned_samples *samples, const bool *use)
{
    const double most_A = largest_current_A(samples, use);
    loads ahead = {.count = 0}, back = {.count = 0};
    for (size_t r = 0; r < samples->run_count; ++r) {
        const hci_run_statistics *f = &samples->statistics[r];
        if (!use[r] || !(f->current_A > LEAST_LOAD * most_A)) continue;
        if (f->both_ways || f->mean_speed_rad_per_s > 0.0) load_add(&ahead, f->current_A);
        if (f->both_ways || f->mean_speed_rad_per_s < 0.0) load_add(&back, f->current_A);
    }
    bool paired = ahead.count >= 2 && back.count >= 2;
    for (size_t k = 0; k < ahead.count; ++k)
        paired = paired || has_alike(&back, ahead.current_A[k]);
    return paired;
}

static hci_effect_survey survey_of(const hci_candidates_source *s)
{
    hci_effect_survey x = {.machine = s->machine,
                           .richness = s->richness,
                           .speeds = speeds_of(s),
                           .has_neutral = s->has_neutral};
    for (size_t r = 0; r < s->samples->run_count; ++r) {
        const hci_run_statistics *f = &s->samples->statistics[r];
        x.timed = x.timed || (s->runs[r].time_s && s->runs[r].speed_rad_per_s);
        x.moving = x.moving || f->mean_speed_rad_per_s != 0.0;
        x.has_turn = x.has_turn || (s->runs[r].turn_known && !is_part_of_turn(s, r));
        x.creeps = x.creeps || (s->use[r] && f->creeps && s->runs[r].torque_source == HCI_TORQUE_MEASURED);
        if (s->runs[r].time_s && s->runs[r].count > 0)
            x.duration_s = fmax(x.duration_s, s->runs[r].time_s[s->runs[r].count - 1] - s->runs[r].time_s[0]);
        x.torque_Nm = fmax(x.torque_Nm, f->rms_torque_Nm);
        if (s->use[r]) x.acceleration_rad_per_s2 = fmax(x.acceleration_rad_per_s2, f->rms_acceleration);
        x.current_A = fmax(x.current_A, f->current_A);
        x.along_d_A = fmax(x.along_d_A, fabs(f->mean_id_A));
        x.flows_d_A = fmax(x.flows_d_A, f->rms_id_A);
        for (size_t phase = 0; phase < 3; ++phase)
            x.standing_current_A = fmax(x.standing_current_A, fabs(f->standing_A[phase]));
    }
    x.has_temperature = warms(s);
    x.one_sided = are_one_sided(s->samples, s->use);
    x.loaded_both_ways = are_loaded_both_ways(s->samples, s->use);
    x.reference_current_A = s->reference_current_A > 0.0 ? s->reference_current_A : x.current_A;
    return x;
}

/* The orders that stand out of the residual, of one kind. Returns how many. */
static size_t orders_of(const hci_candidate_orders *lines, int pole_pairs, hci_order_kind kind, size_t most,
                        double *order)
{
    double under = INFINITY;
    for (size_t n = 0; n < most; ++n) {
        const size_t periods = hci_candidate_orders_next(lines, (size_t)pole_pairs, kind, &under);
        if (periods == 0) return n;
        order[n] = (double)periods / (double)pole_pairs;
    }
    return most;
}

/* Whether an effect of the magnetic circuit is told apart by the currents: a torque that no current makes is,
 * where little current flows. */
static bool is_magnetic(const hci_candidates_source *s, const hci_effect_type *type, double most_A)
{
    double least_A = INFINITY;
    if (!type->propose_coenergy) return false;
    for (size_t r = 0; r < s->samples->run_count; ++r)
        if (s->use[r]) least_A = fmin(least_A, s->samples->statistics[r].current_A);
    return !type->any_phase || least_A < LITTLE * most_A;
}

/* Whether a run is of direct current: it turns against the rotor, and what grows with it is of other orders.
 */
static bool has_direct(const hci_candidates_source *s)
{
    bool any = false;
    for (size_t r = 0; r < s->samples->run_count; ++r)
        any = any || (s->use[r] && s->samples->statistics[r].is_direct);
    return any;
}

/* What a survey points into. */
typedef struct {
    double slot[MOST_SLOT_ORDERS], turn[MOST_TURN_ORDERS], load[MOST_TURN_ORDERS];
    hci_flux_orders flux;
    hci_angle_orders angle;
    hci_effect_speed_mean of_speed[HCI_SPEED_MEANS];
} surveyed;

static void survey_lines(const hci_candidates_source *s, const hci_candidate_orders *lines, surveyed *f,
                         hci_effect_survey *x)
{
    const int p = s->machine->pole_pairs;
    x->has_turn = lines->stride == 1;
    x->orders = (double)lines->count;
    x->slot_order = f->slot;
    x->slot_orders = orders_of(lines, p, HCI_ORDERS_OF_SLOTS, MOST_SLOT_ORDERS, f->slot);
    x->turn_order = f->turn;
    x->turn_orders = orders_of(lines, p, HCI_ORDERS_OF_TURN, MOST_TURN_ORDERS, f->turn);
    x->load_order = f->load;
    x->load_orders = orders_of(lines, p, HCI_ORDERS_OF_LOAD, MOST_TURN_ORDERS, f->load);
    x->poles_differ = !has_direct(s) && hci_candidate_orders_poles_differ(lines, (size_t)p);
}

/* False when memory is out. */
static bool survey_residual(const hci_candidates_source *s, const hci_candidate_orders *lines, surveyed *f,
                            hci_effect_survey *x)
{
    if (!hci_flux_orders_find(s, x->has_turn, &f->flux)) return false;
    if (!hci_angle_orders_find(s, lines->stride, lines->resolved, &f->angle)) return false;
    x->flux_order = f->flux.order;
    x->flux_orders = f->flux.count;
    x->one_gain = s->one_gain || f->flux.one_gain;
    x->angle_order = f->angle.order;
    x->angle_orders = f->angle.count;
    x->of_speed = f->of_speed;
    x->of_speeds = hci_residual_by_speed(s, f->of_speed);
    return true;
}

bool hci_candidates_lack_angle(const hci_run *runs, const bool *use, size_t count)
{
    for (size_t k = 0; k < count; ++k)
        if (use[k] && !runs[k].only_mean) return false;
    return true;
}

static bool is_looked_for(const hci_candidates_source *s, size_t r, double current_A)
{
    const hci_effect_type *type = hci_effect_type_at(r);
    return type->propose && !(s->denied && s->denied[r]) && !(type->in_series && s->richness > 0) &&
           !(type->turns_angle && hci_candidates_lack_angle(s->runs, s->use, s->samples->run_count)) &&
           (!s->magnetic_only || is_magnetic(s, type, current_A));
}

static void add_all(builder *b, const hci_candidates_source *s, hci_effect_survey *x,
                    const hci_candidate_orders *lines)
{
    surveyed found;
    const hci_effect_proposals to = {add, b};
    survey_lines(s, lines, &found, x);
    b->failed = !survey_residual(s, lines, &found, x);
    for (size_t r = 0; !b->failed && (b->type = hci_effect_type_at(r)) != NULL; ++r)
        if (is_looked_for(s, r, x->current_A)) b->type->propose(x, &to);
    if (!b->failed && !s->known_only) add_unknown(b, s, lines);
}

/* ---- the list ---- */

/* Whether one candidate has a term of another one. */
static bool shares_a_term(const hci_candidate *a, const hci_candidate *b)
{
    for (size_t k = 0; a->type == b->type && k < a->count; ++k)
        for (size_t j = 0; j < b->count; ++j)
            if (a->term[k].parameter == b->term[j].parameter &&
                fabs(a->term[k].order - b->term[j].order) <= HCI_ORDER_TOLERANCE)
                return true;
    return false;
}

/* Those terms of a whole that are behind the last one of a candidate in the model. */
static hci_status rest_add(const hci_candidate *x, const hci_candidate *whole, hci_candidates *list,
                           hci_note *note)
{
    hci_candidate rest = *whole;
    rest.count = 0;
    for (size_t k = 0; k < whole->count; ++k) {
        if (whole->term[k].parameter <= x->term[x->count - 1].parameter) continue;
        rest.term[rest.count] = whole->term[k];
        rest.declared[rest.count++] = whole->declared[k];
    }
    return rest.count > 0 ? hci_candidates_add(list, &rest, note) : HCI_OK;
}

/* A law of more terms in place of the one in the model, with the values of that. */
static void law_grow(const hci_candidate *x, hci_candidate *whole)
{
    for (size_t k = 0; k < whole->count; ++k)
        for (size_t j = 0; j < x->count; ++j)
            if (x->term[j].parameter == whole->term[k].parameter) whole->term[k].value = x->term[j].value;
    whole->grown_from = x->count;
    whole->in = true;
}

/* A candidate that shares a term with one in the model. */
static hci_status known_take(const hci_candidate *x, hci_candidates *list, size_t at, hci_note *note)
{
    const hci_candidate whole = list->candidate[at];
    if (!x->shortened && whole.count > x->count) {
        law_grow(x, &list->candidate[at]);
        return HCI_OK;
    }
    list->candidate[at] = *x;
    list->candidate[at].grown_from = 0;
    return x->shortened ? rest_add(x, &whole, list, note) : HCI_OK;
}

/* What is in the model stays in the list, in its place. No term is there twice: a law of fewer terms, as some
 * of the runs alone tell it, gives way to the one that all runs may tell, which is then in. Where terms have
 * left it, they are a candidate of their own. */
static hci_status keep_known(const hci_candidates *known, hci_candidates *list, hci_note *note)
{
    hci_status status = HCI_OK;
    for (size_t k = 0; known && k < known->count && !status; ++k) {
        const hci_candidate *x = &known->candidate[k];
        size_t at = 0;
        if (!x->in) continue;
        while (at < list->count && !shares_a_term(x, &list->candidate[at]))
            ++at;
        status = at < list->count ? known_take(x, list, at, note) : hci_candidates_add(list, x, note);
    }
    return status;
}

hci_status hci_candidates_make(const hci_candidates_source *source, const hci_candidates *known,
                               hci_candidates *candidates, hci_note *note)
{
    hci_effect_survey x = survey_of(source);
    builder b = {.list = candidates,
                 .declared = source->declared,
                 .no_current = source->no_current || !(x.current_A > 0.0),
                 .lag_told = hci_lag_is_told(source->machine, source->runs, source->samples->statistics,
                                             source->use, source->samples->run_count)};
    hci_candidate_orders lines;
    memset(candidates, 0, sizeof *candidates);
    candidates->reference_current_A = x.reference_current_A;
    b.failed =
        !hci_candidate_orders_make(source, x.has_turn ? 1 : (size_t)source->machine->pole_pairs, &lines);
    b.resolved = lines.resolved;
    if (!b.failed) add_all(&b, source, &x, &lines);
    hci_candidate_orders_release(&lines);
    const hci_status status =
        b.failed ? hci_note_memory(note, NULL, "the list of effects") : keep_known(known, candidates, note);
    if (status) hci_candidates_release(candidates);
    return status;
}
