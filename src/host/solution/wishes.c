/* In: a task that is linear, bounds, a set; out: the currents of the nearest mean torque, with it of the
 * smallest ripple, with that of the least copper, each by wish.c. */
#include "host/solution/wishes.h"

#include <math.h>
#include <string.h>

#include "host/base/memory.h"
#include "host/limit/newton.h"
#include "host/solution/wish.h"

enum { MOST_SLACKS = 4 }; /* of tenfold room for the least copper */

#define REACHED 0.1  /* share of the tolerance within which a wish is called met */
#define MET     0.5  /* share of the tolerance that orders may be off where they are no equations */
#define ROUGHLY 1e-4 /* share of the torque within which a mean is met where the solver is not precise */
#define COSTS   1e-5 /* what a limit costs of the whole, below which it costs nothing */

static hci_status out_of_memory(hci_note *note)
{
    return hci_note_memory(note, NULL, "solving within limits");
}

/* ---- the wishes in turn ---- */

/* Share of the whole that all limits cost: what the objective would gain if each were wider by its own size.
 */
static double share_of(const hci_wishes *l, const hci_limit_optimum *o, double whole)
{
    const hci_bounds *b = l->of->bounds;
    double sum = 0.0;
    for (int s = 0; s < 3; ++s) {
        if (b->current_A[s] < HUGE_VAL) sum += o->current_gain[s] * b->current_A[s];
        if (b->rms_A[s] < HUGE_VAL) sum += o->rms_gain[s] * b->rms_A[s];
    }
    if (b->line_V < HUGE_VAL) sum += o->voltage_gain * b->line_V;
    if (b->mean_square_A2 < HUGE_VAL) sum += o->copper_gain * b->mean_square_A2;
    return whole > 0.0 ? sum / whole : 0.0;
}

/* The first wish that limits cost something of. */
static void note_cost(hci_wishes *l, hci_limit_cost cost, const hci_limit_optimum *o, double whole)
{
    hci_solution *s = l->of->solution;
    if (s->limit_cost != HCI_COST_NONE || share_of(l, o, whole) < COSTS) return;
    s->limit_cost = cost;
    l->cost = *o;
    l->cost.x = NULL;
}

static double tolerance_Nm(const hci_wishes *l)
{
    return REACHED * l->of->solution->tolerance_Nm;
}

/* A program that is solved roughly misses a mean that can be had by more than the tolerance. */
static bool is_mean_met(const hci_wishes *l, double missed_Nm)
{
    return missed_Nm <= fmax(tolerance_Nm(l), l->is_far ? ROUGHLY * l->program.scale_Nm : 0.0);
}

/* A limit that is wider by 1 is wider by 1 + w where all are wider by the share w: so much more does it save.
 */
static void scale_gains(hci_limit_optimum *o, double factor)
{
    for (int s = 0; s < 3; ++s) {
        o->current_gain[s] *= factor;
        o->rms_gain[s] *= factor;
    }
    o->voltage_gain *= factor;
    o->copper_gain *= factor;
}

/* Widens the limits until there is a current. */
static hci_status fit(hci_wishes *l, hci_note *note)
{
    hci_limit_optimum o;
    hci_status status = hci_wish_solve(l, HCI_STAGE_FIT, &o, note);
    if (!status && o.is_infeasible)
        status = hci_note_set(note, HCI_ERROR_NUMERIC, "no limits are wide enough for a current");
    if (!status) {
        l->program.widened = o.smallest + 1e-6;
        l->of->solution->exceeded_share = o.smallest;
        scale_gains(&o, 1.0 + o.smallest);
        note_cost(l, HCI_COST_LIMITS, &o, 1.0);
        hci_wish_take(l, &o);
    }
    hci_memory_free(o.x);
    return status;
}

/* The nearest mean within the limits, which are widened where no current keeps them. */
static hci_status solve_mean(hci_wishes *l, hci_limit_optimum *o, hci_note *note)
{
    hci_status status = hci_wish_solve(l, HCI_STAGE_MEAN, o, note);
    if (status || !o->is_infeasible) return status;
    hci_memory_free(o->x);
    o->x = NULL;
    status = fit(l, note);
    if (!status) status = hci_wish_solve(l, HCI_STAGE_MEAN, o, note);
    if (status || !o->is_infeasible) return status;
    return hci_note_set(note, HCI_ERROR_NUMERIC, "no current keeps the limits that were widened");
}

static hci_status find_mean(hci_wishes *l, hci_note *note)
{
    hci_limit_program *p = &l->program;
    hci_limit_optimum o;
    const hci_status status = solve_mean(l, &o, note);
    if (!status) {
        p->has_mean = is_mean_met(l, o.smallest);
        p->mean_Nm = p->field.mean_Nm - o.smallest;
        if (!p->has_mean) note_cost(l, HCI_COST_TORQUE, &o, p->scale_Nm);
        hci_wish_take(l, &o);
    }
    hci_memory_free(o.x);
    return status;
}

/* Whether any order above 0 is compared. */
static bool has_orders(const hci_harmonic_system *s)
{
    return s->order_count > 0 && s->order[s->order_count - 1] >= HCI_ORDER_TOLERANCE;
}

/* Whether all orders can be equations: not of torque that is made linear where they are more than the
 * coordinates, since the last ones, next to nothing, then have no solution to the last digit. */
static bool has_equations(const hci_wishes *l)
{
    return hci_task_is_linear(l->of->task) || l->system.rows <= l->system.unknowns;
}

/* Whether the mean need not be looked for: next to currents that have it. */
static bool is_near_mean(const hci_wishes *l)
{
    return l->is_coarse && l->program.radius_A > 0.0 && l->program.has_mean;
}

/* A mean that is just reached within rounding is not reached. */
static hci_status solve_ripple(hci_wishes *l, hci_limit_optimum *o, hci_note *note)
{
    hci_status status = hci_wish_solve(l, HCI_STAGE_RIPPLE, o, note);
    if (!status && o->is_infeasible && l->program.has_mean) {
        hci_memory_free(o->x);
        o->x = NULL;
        if (is_near_mean(l))
            status = find_mean(l, note);
        else
            l->program.has_mean = false;
        if (!status) status = hci_wish_solve(l, HCI_STAGE_RIPPLE, o, note);
    }
    if (status || o->is_infeasible || l->is_coarse || o->is_settled) return status;
    return hci_note_set(
        note, HCI_ERROR_NUMERIC,
        "the smallest ripple within them was not found to working precision; try wider or fewer "
        "ones");
}

/* The ripple to which the copper may add its slack: where that was added before, it is not a second time. */
static double to_keep_Nm(const hci_wishes *l, double smallest_Nm)
{
    const double before_Nm = smallest_Nm - HCI_LIMIT_SLACK * l->program.scale_Nm;
    return l->is_kept ? fmin(smallest_Nm, fmax(l->kept_Nm, before_Nm)) : smallest_Nm;
}

static hci_status find_ripple(hci_wishes *l, hci_note *note)
{
    hci_limit_program *p = &l->program;
    hci_limit_optimum o;
    hci_status status;
    bool is_met;
    p->ripple_Nm = 0.0;
    p->has_ripple = !has_orders(&l->system);
    if (p->has_ripple) return HCI_OK;
    status = solve_ripple(l, &o, note);
    if (!status && !o.is_infeasible) {
        p->ripple_Nm = to_keep_Nm(l, fmax(o.smallest, 0.0));
        is_met = p->ripple_Nm <= tolerance_Nm(l);
        p->has_ripple = is_met && has_equations(l);
        if (p->has_mean && !is_met) note_cost(l, HCI_COST_RIPPLE, &o, p->scale_Nm);
        hci_wish_take(l, &o);
    }
    hci_memory_free(o.x);
    return status;
}

/* Whether a stage has an answer that keeps every limit between its angles too. */
static bool is_settled(hci_status status, const hci_limit_optimum *o)
{
    return !status && !o->is_infeasible && o->is_settled;
}

/* Of a wish that may stay unmet: its end alone. */
static hci_status end_of(const hci_wishes *l, hci_status status, hci_note *note)
{
    if (status == HCI_ERROR_STOPPED) return hci_task_goes_on(l->of->task, note);
    return status == HCI_ERROR_MEMORY ? out_of_memory(note) : HCI_OK;
}

/* Takes no ripple at all first, then a little more than the smallest until that leaves room for an answer. */
static hci_status solve_copper(hci_wishes *l, hci_limit_optimum *o)
{
    hci_limit_program *p = &l->program;
    hci_note ignored = {{0}};
    hci_status status = hci_wish_solve(l, HCI_STAGE_COPPER, o, &ignored);
    for (int k = 0; k < MOST_SLACKS && !l->is_coarse && !is_settled(status, o) && !hci_wish_is_end(status);
         ++k) {
        hci_memory_free(o->x);
        if (!p->has_ripple) p->slack *= 10.0;
        p->has_ripple = false;
        status = hci_wish_solve(l, HCI_STAGE_COPPER, o, &ignored);
    }
    p->slack = HCI_LIMIT_SLACK;
    return status;
}

/* Where none is found, the currents of the smallest ripple stay. */
static hci_status find_copper(hci_wishes *l, hci_note *note)
{
    const hci_limit_program *p = &l->program;
    hci_limit_optimum o;
    hci_status status = l->is_coarse ? HCI_OK : hci_wish_forget(l, note);
    if (status) return status;
    status = solve_copper(l, &o);
    if (is_settled(status, &o) || (l->is_coarse && !status && !o.is_infeasible)) {
        if (p->has_mean) note_cost(l, HCI_COST_COPPER, &o, o.smallest);
        hci_wish_take(l, &o);
    }
    hci_memory_free(o.x);
    return end_of(l, status, note);
}

/* The torque as it is wanted, if there is such a current. */
static hci_status try_all(hci_wishes *l, bool *is_met, hci_note *note)
{
    hci_limit_optimum o;
    hci_note ignored = {{0}};
    hci_status status;
    l->program.has_mean = true;
    l->program.has_ripple = has_equations(l);
    l->program.ripple_Nm = 0.0;
    l->program.slack = fmin(HCI_LIMIT_SLACK, MET * l->of->solution->tolerance_Nm / l->program.scale_Nm);
    status = hci_wish_solve(l, HCI_STAGE_COPPER, &o, &ignored);
    l->program.slack = HCI_LIMIT_SLACK;
    *is_met = !status && !o.is_infeasible && (o.is_settled || l->is_coarse);
    if (*is_met) {
        note_cost(l, HCI_COST_COPPER, &o, o.smallest);
        hci_wish_take(l, &o);
    }
    hci_memory_free(o.x);
    return end_of(l, status, note);
}

/* Whether the answer is only to tell where the torque is to be made linear next: then the copper does not
 * matter, nor the ripple where the mean is far off. */
static bool is_sketch(const hci_wishes *l)
{
    return l->is_far || (l->is_coarse && l->program.radius_A > 0.0);
}

static hci_status after_mean(hci_wishes *l, hci_note *note)
{
    hci_status status = HCI_OK;
    if (l->is_far && !l->program.has_mean) return status;
    status = find_ripple(l, note);
    return status || (is_sketch(l) && !l->program.has_ripple) ? status : find_copper(l, note);
}

/* Limits that were widened leave next to no room. Where that is too little for a further wish, the currents
 * that were found stay. */
static hci_status in_turn(hci_wishes *l, hci_note *note)
{
    hci_note why = {{0}};
    hci_status status = is_near_mean(l) ? HCI_OK : find_mean(l, &why);
    if (!status) status = after_mean(l, &why);
    if (status == HCI_ERROR_NUMERIC && l->program.widened > 0.0) {
        l->program.ripple_Nm = NAN;
        return HCI_OK;
    }
    if (status == HCI_ERROR_MEMORY) return out_of_memory(note);
    return status ? hci_note_set(note, status, "%s", why.text) : HCI_OK;
}

/* An equation, which has no multiplier to tell what it costs. */
static bool has_open_phase(const hci_bounds *b)
{
    return b->current_A[0] == 0.0 || b->current_A[1] == 0.0 || b->current_A[2] == 0.0;
}

/* All of them at the system and the grids as they are; l->x is the answer. */
static hci_status all_wishes(hci_wishes *l, hci_note *note)
{
    hci_solution *s = l->of->solution;
    hci_status status = HCI_OK;
    bool is_met = false;
    l->program.widened = s->exceeded_share = 0.0;
    s->limit_cost = HCI_COST_NONE;
    memset(&l->cost, 0, sizeof l->cost);
    if (!l->is_hard) status = try_all(l, &is_met, note);
    if (!status && !is_met) status = in_turn(l, note);
    l->is_hard = !is_met && !(l->program.has_mean && l->program.ripple_Nm <= tolerance_Nm(l));
    if (has_open_phase(l->of->bounds) && s->limit_cost == HCI_COST_NONE)
        s->limit_cost = !l->program.has_mean     ? HCI_COST_TORQUE
                        : !l->program.has_ripple ? HCI_COST_RIPPLE
                                                 : HCI_COST_COPPER;
    s->minimised = l->program.minimise;
    s->minimised_Nm = l->program.ripple_Nm;
    return status;
}

/* ---- all of it ---- */

hci_status hci_wishes_begin(hci_wishes *wishes, hci_note *note)
{
    hci_wishes_program_begin(wishes);
    if (!wishes->program.field.voltage) return HCI_OK;
    return hci_voltage_model_make(wishes->of->machine, wishes->of->options, &wishes->voltage, note);
}

hci_status hci_wishes_meet(hci_wishes *wishes, hci_note *note)
{
    hci_status status = hci_wishes_program_make(wishes, note);
    if (!status && (wishes->is_far || wishes->program.radius_A > 0.0)) status = hci_wish_forget(wishes, note);
    return status ? status : all_wishes(wishes, note);
}

void hci_wishes_release(hci_wishes *wishes)
{
    hci_wishes_program_release(wishes);
    hci_limit_points_release(&wishes->program.points);
    for (int stage = 0; stage <= HCI_STAGE_COPPER; ++stage)
        hci_limit_rest_release(&wishes->rest[stage]);
    hci_component_set_release(&wishes->set);
    hci_memory_free(wishes->current.wave);
    hci_memory_free(wishes->x);
}
