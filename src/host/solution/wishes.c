/* In: a task that is linear, bounds, a set; out: the currents of the nearest mean torque, with it of the
 * smallest ripple, with that of the least copper. Each wish is a convex program (limit_program.c); where
 * peaks between its angles are beyond a limit they become rows and it is solved again. */
#include "host/solution/wishes.h"

#include <math.h>
#include <string.h>

#include "host/base/memory.h"

enum {
    COARSE_ROUNDS = 2,
    MOST_ROUNDS = 40, /* of adding peaks, each of which squares the error */
    MOST_SLACKS = 4,  /* of tenfold room for the least copper */
    PER_PERIOD = 64,  /* samples in the period of the highest order: no peak hides between two of them */
    STRIDE = 16       /* every so many of them is a row from the start: 4 times the highest order */
};

#define REACHED 0.1  /* share of the tolerance within which a wish is called met */
#define COSTS   1e-5 /* what a limit costs of the whole, below which it costs nothing */
#define IDLE    0.7  /* share of a limit below which an angle is left out until a peak is there */
#define ALIKE   1e-9 /* share of a row within which two are the same */

static hci_status out_of_memory(hci_note *note)
{
    return hci_note_memory(note, NULL, "solving within limits");
}

double hci_wishes_top(const hci_component_set *set)
{
    double top = 1.0;
    for (size_t k = 0; k < set->count; ++k)
        top = fmax(top, set->component[k].order);
    return top;
}

/* ---- the program ---- */

/* How many angles a symmetry is tried at, none of them an even share of a turn. */
enum { TRIALS = 7 };

/* Whether a quantity of one phase at an angle is `sign` times that of another phase `shift_rad` further on,
 * whatever the currents. row: workspace of both rows. */
static bool is_same(const hci_wishes *l, hci_limit_point one, double shift_rad, int phase, double sign,
                    double *row)
{
    const size_t n = 2 * l->set.count;
    double size = 0.0, apart = 0.0;
    for (int k = 0; k < TRIALS; ++k) {
        const hci_limit_point here = {one.kind, one.phase, 0.1 + 0.83 * k},
                              there = {one.kind, phase, here.theta_rad + shift_rad};
        const double constant = hci_limit_row(&l->program.field, &here, row),
                     other = hci_limit_row(&l->program.field, &there, row + n);
        size = fmax(size, fabs(constant));
        apart = fmax(apart, fabs(constant - sign * other));
        for (size_t j = 0; j < n; ++j) {
            size = fmax(size, fabs(row[j]));
            apart = fmax(apart, fabs(row[j] - sign * row[n + j]));
        }
    }
    return apart <= ALIKE * size;
}

/* Symmetries of a limited quantity: how many phases and which share of the period tell of all. */
static hci_status find_symmetry(const hci_wishes *l, hci_point_kind kind, int *phases, double *share,
                                hci_note *note)
{
    const hci_limit_point first = {kind, 0, 0.0};
    const double third_rad = 2.0 * HCI_PI / 3.0;
    double *row = hci_memory_new(4 * l->set.count, sizeof *row);
    bool thirds = hci_bounds_are_alike(l->of->bounds), halves = l->program.field.turns == 1;
    if (!row) return out_of_memory(note);
    for (int phase = 0; phase < 3; ++phase) {
        const hci_limit_point one = {kind, phase, 0.0};
        thirds = thirds && is_same(l, first, phase * third_rad, phase, 1.0, row);
        halves = halves && is_same(l, one, HCI_PI, phase, -1.0, row);
    }
    hci_memory_free(row);
    *phases = thirds ? 1 : 3;
    *share = halves ? 0.5 : 1.0;
    return HCI_OK;
}

static hci_status add_grid(hci_wishes *l, hci_point_kind kind, int phase, double top, double share,
                           hci_note *note)
{
    hci_limit_grid *g = &l->program.grid[l->program.grids++];
    const double periods = share * (double)l->program.field.turns;
    const size_t samples = STRIDE * (size_t)ceil(periods * PER_PERIOD * fmax(top, 4.0) / STRIDE);
    *g = (hci_limit_grid){
        .kind = kind, .phase = phase, .samples = samples, .period_rad = 2.0 * HCI_PI * periods};
    if (hci_limit_grid_make(&l->program.field, g)) return out_of_memory(note);
    for (size_t k = 0; k < samples; k += STRIDE)
        g->is_row[k] = true;
    return HCI_OK;
}

static double top_of_voltage(const hci_wishes *l)
{
    double top = hci_wishes_top(&l->set);
    for (size_t k = 0; k < l->of->machine->model.back_emf_count; ++k)
        top = fmax(top, l->of->machine->model.back_emf[k].order);
    for (size_t k = 0; k < l->of->machine->model.slope_count; ++k)
        top = fmax(top, hci_wishes_top(&l->set) + l->of->machine->model.slope[k].order);
    return top;
}

static hci_status add_currents(hci_wishes *l, hci_note *note)
{
    const hci_bounds *b = l->of->bounds;
    int phases;
    double share;
    hci_status status = find_symmetry(l, HCI_POINT_CURRENT, &phases, &share, note);
    for (int phase = 0; phase < phases && !status; ++phase)
        if (b->current_A[phase] > 0.0 && b->current_A[phase] < HUGE_VAL)
            status = add_grid(l, HCI_POINT_CURRENT, phase, hci_wishes_top(&l->set), share, note);
    return status;
}

static hci_status add_voltages(hci_wishes *l, hci_note *note)
{
    int pairs;
    double share;
    hci_status status = HCI_OK;
    if (!(l->of->bounds->line_V < HUGE_VAL)) return HCI_OK;
    status = find_symmetry(l, HCI_POINT_VOLTAGE, &pairs, &share, note);
    for (int pair = 0; pair < pairs && !status; ++pair)
        status = add_grid(l, HCI_POINT_VOLTAGE, pair, top_of_voltage(l), share, note);
    return status;
}

static hci_status make_grids(hci_wishes *l, hci_note *note)
{
    const hci_harmonic_system *s = &l->system;
    hci_status status = add_currents(l, note);
    if (!status) status = add_voltages(l, note);
    if (!status && l->program.minimise == HCI_MINIMISE_PEAK_TO_PEAK)
        status =
            add_grid(l, HCI_POINT_TORQUE, 0, s->order_count ? s->order[s->order_count - 1] : 1.0, 1.0, note);
    return status;
}

static void release_program(hci_wishes *l)
{
    hci_harmonic_system_release(&l->system);
    for (size_t q = 0; q < l->program.grids; ++q)
        hci_limit_grid_release(&l->program.grid[q]);
    l->program.grids = 0;
}

/* System and grids at the currents of the last step. */
static hci_status make_program(hci_wishes *l, hci_note *note)
{
    const hci_limited *of = l->of;
    hci_status status;
    release_program(l);
    status =
        hci_harmonic_system_make(of->task, l->set.component, l->set.count,
                                 of->options->set ? of->options->compare : HCI_COMPARE_ALL, &l->system, note);
    return status ? status : make_grids(l, note);
}

static void begin_program(hci_wishes *l)
{
    const hci_limited *of = l->of;
    const hci_solve_options *o = of->options;
    hci_limit_program *p = &l->program;
    p->field = (hci_limit_field){&l->set,
                                 of->task->held,
                                 of->bounds->line_V < HUGE_VAL ? &l->voltage : NULL,
                                 &l->current,
                                 &l->system,
                                 hci_target_mean_Nm(o->target),
                                 of->task->period_turns};
    p->bounds = of->bounds;
    p->minimise = o->minimise == HCI_MINIMISE_AUTO ? HCI_MINIMISE_WORST : o->minimise;
    p->scale_Nm = of->solution->tolerance_Nm / (o->tolerance > 0.0 ? o->tolerance : 1e-6);
    p->scale_A = fmax(of->solution->peak_phase_current_A, 1e-9);
    for (int s = 0; s < 3; ++s)
        if (of->bounds->current_A[s] > 0.0) p->scale_A = fmin(p->scale_A, of->bounds->current_A[s]);
    if (!(p->scale_Nm > 0.0)) p->scale_Nm = 1.0;
    p->slack = HCI_LIMIT_SLACK;
}

/* ---- one wish, with peaks between the angles ---- */

/* What a grid's quantity has to stay within; false where this stage does not ask for it. */
static bool range_of(const hci_wishes *l, const hci_limit_grid *g, hci_limit_stage stage,
                     const hci_limit_optimum *o, double range[2])
{
    const double margin_Nm = 1e-7 * l->program.scale_Nm;
    range[1] = g->kind == HCI_POINT_TORQUE ? o->highest_Nm + margin_Nm
                                           : hci_limit_of_grid(&l->program, g) * (1.0 - HCI_LIMIT_MARGIN);
    range[0] = g->kind == HCI_POINT_TORQUE ? o->lowest_Nm - margin_Nm : -range[1];
    return g->kind != HCI_POINT_TORQUE || stage >= HCI_STAGE_RIPPLE;
}

/* Adds the peaks of an optimum beyond a limit; *added: how many. */
static hci_status add_peaks(hci_wishes *l, hci_limit_stage stage, const hci_limit_optimum *o, size_t *added,
                            hci_note *note)
{
    hci_limit_program *p = &l->program;
    const size_t before = p->points.count;
    hci_status status = HCI_OK;
    if (stage == HCI_STAGE_FIT) p->widened = o->smallest;
    for (size_t q = 0; q < p->grids && !status; ++q) {
        double range[2], worst;
        if (!range_of(l, &p->grid[q], stage, o, range)) continue;
        status = hci_limit_peaks(&p->field, &p->grid[q], o->x, range, &p->points, &worst);
        if (!status && stage >= HCI_STAGE_RIPPLE) hci_limit_grid_thin(&p->grid[q], o->x, range, IDLE);
    }
    if (stage == HCI_STAGE_FIT) p->widened = 0.0;
    *added = p->points.count - before;
    return status ? out_of_memory(note) : HCI_OK;
}

/* How often peaks are added: until there are none, or while the torque is still being made linear a few
 * times, since they are kept for the next step. */
static int rounds_of(const hci_wishes *l)
{
    return l->is_coarse ? COARSE_ROUNDS : MOST_ROUNDS;
}

/* *o: out, its x to be freed. A round that rounding spoils leaves the one before. */
static hci_status settle(hci_wishes *l, hci_limit_stage stage, hci_limit_optimum *o, hci_note *note)
{
    size_t added = 1;
    hci_status status = HCI_OK;
    memset(o, 0, sizeof *o);
    for (int round = 0; round < rounds_of(l) && added > 0 && !status; ++round) {
        hci_limit_optimum next;
        hci_note ignored = {{0}};
        status = hci_limit_program_solve(&l->program, stage, &next, round > 0 ? &ignored : note);
        if (round > 0 && (status == HCI_ERROR_NUMERIC || next.is_infeasible)) {
            hci_memory_free(next.x);
            o->is_settled = false;
            return HCI_OK;
        }
        hci_memory_free(o->x);
        *o = next;
        if (status || o->is_infeasible) return status;
        status = add_peaks(l, stage, o, &added, note);
    }
    o->is_settled = added == 0;
    return status;
}

/* Takes the currents of a stage. */
static void take(hci_wishes *l, hci_limit_optimum *o)
{
    hci_memory_free(l->x);
    l->x = o->x;
    o->x = NULL;
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

/* Widens the limits until there is a current. */
static hci_status fit(hci_wishes *l, hci_note *note)
{
    hci_limit_optimum o;
    hci_status status = settle(l, HCI_STAGE_FIT, &o, note);
    if (!status && o.is_infeasible)
        status = hci_note_set(note, HCI_ERROR_NUMERIC, "no limits are wide enough for a current");
    if (!status) {
        l->program.widened = o.smallest + 1e-6;
        l->of->solution->exceeded_share = o.smallest;
        note_cost(l, HCI_COST_LIMITS, &o, 1.0);
        take(l, &o);
    }
    hci_memory_free(o.x);
    return status;
}

static hci_status find_mean(hci_wishes *l, hci_note *note)
{
    hci_limit_program *p = &l->program;
    hci_limit_optimum o;
    hci_status status = settle(l, HCI_STAGE_MEAN, &o, note);
    if (!status && o.is_infeasible) {
        hci_memory_free(o.x);
        o.x = NULL;
        status = fit(l, note);
        if (!status) status = settle(l, HCI_STAGE_MEAN, &o, note);
    }
    if (!status && o.is_infeasible)
        status = hci_note_set(note, HCI_ERROR_NUMERIC, "no current keeps the limits that were widened");
    if (!status) {
        p->has_mean = o.smallest <= tolerance_Nm(l);
        p->mean_Nm = p->field.mean_Nm - o.smallest;
        if (!p->has_mean) note_cost(l, HCI_COST_TORQUE, &o, p->scale_Nm);
        take(l, &o);
    }
    hci_memory_free(o.x);
    return status;
}

/* Whether any order above 0 is compared. */
static bool has_orders(const hci_harmonic_system *s)
{
    return s->order_count > 0 && s->order[s->order_count - 1] >= HCI_ORDER_TOLERANCE;
}

/* Just reached within rounding is not reached. */
static hci_status find_ripple(hci_wishes *l, hci_note *note)
{
    hci_limit_program *p = &l->program;
    hci_limit_optimum o;
    hci_status status;
    p->ripple_Nm = 0.0;
    p->has_ripple = !has_orders(&l->system);
    if (p->has_ripple) return HCI_OK;
    status = settle(l, HCI_STAGE_RIPPLE, &o, note);
    if (!status && o.is_infeasible && p->has_mean) {
        hci_memory_free(o.x);
        p->has_mean = false;
        status = settle(l, HCI_STAGE_RIPPLE, &o, note);
    }
    if (!status && !o.is_infeasible && !l->is_coarse && !o.is_settled)
        status =
            hci_note_set(note, HCI_ERROR_NUMERIC,
                         "the smallest ripple within them was not found to working precision; try wider or "
                         "fewer ones");
    if (!status && !o.is_infeasible) {
        p->ripple_Nm = fmax(o.smallest, 0.0);
        p->has_ripple = p->ripple_Nm <= tolerance_Nm(l);
        if (p->has_mean && !p->has_ripple) note_cost(l, HCI_COST_RIPPLE, &o, p->scale_Nm);
        take(l, &o);
    }
    hci_memory_free(o.x);
    return status;
}

/* Whether a stage has an answer that keeps every limit between its angles too. */
static bool is_settled(hci_status status, const hci_limit_optimum *o)
{
    return !status && !o->is_infeasible && o->is_settled;
}

/* Takes no ripple at all first, then a little more than the smallest until that leaves room for an answer.
 * Where none is found, the currents of the smallest ripple stay. */
static hci_status find_copper(hci_wishes *l, hci_note *note)
{
    hci_limit_program *p = &l->program;
    hci_limit_optimum o;
    hci_note ignored = {{0}};
    hci_status status = settle(l, HCI_STAGE_COPPER, &o, &ignored);
    for (int k = 0; k < MOST_SLACKS && !l->is_coarse && !is_settled(status, &o) && status != HCI_ERROR_MEMORY;
         ++k) {
        hci_memory_free(o.x);
        if (!p->has_ripple) p->slack *= 10.0;
        p->has_ripple = false;
        status = settle(l, HCI_STAGE_COPPER, &o, &ignored);
    }
    p->slack = HCI_LIMIT_SLACK;
    if (is_settled(status, &o) || (l->is_coarse && !status && !o.is_infeasible)) {
        if (p->has_mean && p->has_ripple) note_cost(l, HCI_COST_COPPER, &o, o.smallest);
        take(l, &o);
    }
    hci_memory_free(o.x);
    return status == HCI_ERROR_MEMORY ? out_of_memory(note) : HCI_OK;
}

/* The torque as it is wanted, if there is such a current. */
static hci_status try_all(hci_wishes *l, bool *is_met, hci_note *note)
{
    hci_limit_optimum o;
    hci_note ignored = {{0}};
    hci_status status;
    l->program.has_mean = l->program.has_ripple = true;
    l->program.ripple_Nm = 0.0;
    status = settle(l, HCI_STAGE_COPPER, &o, &ignored);
    *is_met = !status && !o.is_infeasible && (o.is_settled || l->is_coarse);
    if (*is_met) {
        note_cost(l, HCI_COST_COPPER, &o, o.smallest);
        take(l, &o);
    }
    hci_memory_free(o.x);
    return status == HCI_ERROR_MEMORY ? out_of_memory(note) : HCI_OK;
}

static hci_status in_turn(hci_wishes *l, hci_note *note)
{
    hci_status status = find_mean(l, note);
    if (!status) status = find_ripple(l, note);
    return status ? status : find_copper(l, note);
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
    l->is_hard = !is_met;
    if (!status && !is_met) status = in_turn(l, note);
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
    begin_program(wishes);
    if (!wishes->program.field.voltage) return HCI_OK;
    return hci_voltage_model_make(wishes->of->machine, wishes->of->options, &wishes->voltage, note);
}

hci_status hci_wishes_meet(hci_wishes *wishes, hci_note *note)
{
    const hci_status status = make_program(wishes, note);
    return status ? status : all_wishes(wishes, note);
}

void hci_wishes_release(hci_wishes *wishes)
{
    release_program(wishes);
    hci_limit_points_release(&wishes->program.points);
    hci_component_set_release(&wishes->set);
    hci_memory_free(wishes->current.wave);
    hci_memory_free(wishes->x);
}
