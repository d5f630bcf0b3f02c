/* Currents within limits (theory.md, section 15). In: a task, bounds and the currents without them; out: the
 * currents of the nearest mean torque, with it of the smallest ripple, with that of the least copper. Each
 * wish is a convex program (limit_program.c); where peaks between its angles are beyond a limit they become
 * rows and it is solved again. A torque that is not linear in the current is made linear again and again. */
#include "host/solution/limited.h"

#include <math.h>
#include <string.h>

#include "core/math/vector.h"
#include "host/base/memory.h"
#include "host/numeric/anderson.h"
#include "host/solve/candidates.h"
#include "host/solution/limit_program.h"
#include "host/solution/limits.h"
#include "host/solve/linear.h"
#include "host/solve/linearise.h"

enum {
    COARSE_ROUNDS = 2,
    MOST_SLACKS = 4,  /* of tenfold room for the least copper */
    MOST_ROUNDS = 40, /* of adding peaks, each of which squares the error */
    MOST_STEPS = 40,  /* of making the torque linear */
    MOST_TOP = 61,    /* the same where the torque is not linear, and e + L'i has no last order */
    LEAST_TOP = 25,   /* order up to which currents may have components where none are named */
    PER_PERIOD = 64,  /* samples in the period of the highest order: no peak hides between two of them */
    STRIDE = 16       /* every so many of them is a row from the start: 4 times the highest order */
};

#define COARSE      1e-6 /* change of the current above which steps are coarse */
#define REACHED     0.1  /* share of the tolerance within which a wish is called met */
#define COSTS       1e-5 /* what a limit costs of the whole, below which it costs nothing */
#define IDLE        0.7  /* share of a limit below which an angle is left out until a peak is there */
#define LEAST_SHARE 0.1  /* of the way to an answer */
#define CONVERGED   1e-8 /* change of the current as a share of it */
#define ALIKE       1e-9 /* share of a row within which two are the same */
#define RESTS       1e-6 /* the same, with which it is good enough when steps are out */

typedef struct {
    const hci_limited *of;
    hci_component_set set;
    hci_harmonic_system system;
    hci_voltage_model voltage;
    hci_wave_list current; /* where voltage and torque are made linear */
    hci_limit_program program;
    double *x;
    bool is_coarse; /* the torque is still being made linear: peaks may stay for the next step */
    bool is_hard;   /* the torque of the last step could not be as wanted */
    hci_anderson mixing;
    hci_limit_optimum cost; /* of the stage that says what limits cost */
} limited;

static hci_status out_of_memory(hci_note *note)
{
    return hci_note_memory(note, NULL, "solving within limits");
}

/* ---- which components ---- */

static double top_of(const hci_component_set *set)
{
    double top = 1.0;
    for (size_t k = 0; k < set->count; ++k)
        top = fmax(top, set->component[k].order);
    return top;
}

static hci_status copy_set(const hci_component_set *from, hci_component_set *to, hci_note *note)
{
    to->component = hci_memory_new(from->count, sizeof *to->component);
    to->set = hci_memory_new(from->count, sizeof *to->set);
    if (!to->component || !to->set) return out_of_memory(note);
    memcpy(to->component, from->component, from->count * sizeof *to->component);
    memcpy(to->set, from->set, from->count * sizeof *to->set);
    to->count = from->count;
    return HCI_OK;
}

/* Phases that differ mix the sequences: every component of every order that the wanted currents could have.
 */
static hci_status every_component(const limited *l, double top, hci_component_set *set, hci_note *note)
{
    const hci_task *t = l->of->task;
    hci_harmonic mixed[3] = {{2.0, 1.0, 0.0}, {4.0, 1.0, 0.0}, {6.0, 1.0, 0.0}};
    hci_task with = *t;
    hci_target_order order[3];
    hci_target target = {order, 3};
    for (int k = 0; k < 3; ++k)
        order[k] = (hci_target_order){mixed[k], 1.0};
    with.target = &target;
    return hci_candidates(&with, top, set, note);
}

static hci_status choose_set(limited *l, const hci_answer *a, hci_note *note)
{
    const hci_solve_options *o = l->of->options;
    const double most = hci_task_is_linear(l->of->task) ? HUGE_VAL : MOST_TOP,
                 top = fmin(most, fmax(LEAST_TOP, top_of(&a->set)));
    if (o->set || o->choose_at_most > 0) return copy_set(&a->set, &l->set, note);
    if (!hci_bounds_are_alike(l->of->bounds)) return every_component(l, top, &l->set, note);
    return hci_candidates(l->of->task, top, &l->set, note);
}

/* ---- the program ---- */

/* How many angles a symmetry is tried at, none of them an even share of a turn. */
enum { TRIALS = 7 };

/* Whether a quantity of one phase at an angle is `sign` times that of another phase `shift_rad` further on,
 * whatever the currents. row: workspace of both rows. */
static bool is_same(const limited *l, hci_limit_point one, double shift_rad, int phase, double sign,
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
static hci_status find_symmetry(const limited *l, hci_point_kind kind, int *phases, double *share,
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

static hci_status add_grid(limited *l, hci_point_kind kind, int phase, double top, double share,
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

static double top_of_voltage(const limited *l)
{
    double top = top_of(&l->set);
    for (size_t k = 0; k < l->of->machine->model.back_emf_count; ++k)
        top = fmax(top, l->of->machine->model.back_emf[k].order);
    for (size_t k = 0; k < l->of->machine->model.slope_count; ++k)
        top = fmax(top, top_of(&l->set) + l->of->machine->model.slope[k].order);
    return top;
}

static hci_status add_currents(limited *l, hci_note *note)
{
    const hci_bounds *b = l->of->bounds;
    int phases;
    double share;
    hci_status status = find_symmetry(l, HCI_POINT_CURRENT, &phases, &share, note);
    for (int phase = 0; phase < phases && !status; ++phase)
        if (b->current_A[phase] > 0.0 && b->current_A[phase] < HUGE_VAL)
            status = add_grid(l, HCI_POINT_CURRENT, phase, top_of(&l->set), share, note);
    return status;
}

static hci_status add_voltages(limited *l, hci_note *note)
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

static hci_status make_grids(limited *l, hci_note *note)
{
    const hci_harmonic_system *s = &l->system;
    hci_status status = add_currents(l, note);
    if (!status) status = add_voltages(l, note);
    if (!status && l->program.minimise == HCI_MINIMISE_PEAK_TO_PEAK)
        status =
            add_grid(l, HCI_POINT_TORQUE, 0, s->order_count ? s->order[s->order_count - 1] : 1.0, 1.0, note);
    return status;
}

static void release_program(limited *l)
{
    hci_harmonic_system_release(&l->system);
    for (size_t q = 0; q < l->program.grids; ++q)
        hci_limit_grid_release(&l->program.grid[q]);
    l->program.grids = 0;
}

/* System and grids at the currents of the last step. */
static hci_status make_program(limited *l, hci_note *note)
{
    const hci_limited *of = l->of;
    hci_status status;
    release_program(l);
    status =
        hci_harmonic_system_make(of->task, l->set.component, l->set.count,
                                 of->options->set ? of->options->compare : HCI_COMPARE_ALL, &l->system, note);
    return status ? status : make_grids(l, note);
}

static void begin_program(limited *l)
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
static bool range_of(const limited *l, const hci_limit_grid *g, hci_limit_stage stage,
                     const hci_limit_optimum *o, double range[2])
{
    const double margin_Nm = 1e-7 * l->program.scale_Nm;
    range[1] = g->kind == HCI_POINT_TORQUE ? o->highest_Nm + margin_Nm
                                           : hci_limit_of_grid(&l->program, g) * (1.0 - HCI_LIMIT_MARGIN);
    range[0] = g->kind == HCI_POINT_TORQUE ? o->lowest_Nm - margin_Nm : -range[1];
    return g->kind != HCI_POINT_TORQUE || stage >= HCI_STAGE_RIPPLE;
}

/* Adds the peaks of an optimum beyond a limit; *added: how many. */
static hci_status add_peaks(limited *l, hci_limit_stage stage, const hci_limit_optimum *o, size_t *added,
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
static int rounds_of(const limited *l)
{
    return l->is_coarse ? COARSE_ROUNDS : MOST_ROUNDS;
}

/* *o: out, its x to be freed. A round that rounding spoils leaves the one before. */
static hci_status settle(limited *l, hci_limit_stage stage, hci_limit_optimum *o, hci_note *note)
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
static void take(limited *l, hci_limit_optimum *o)
{
    hci_memory_free(l->x);
    l->x = o->x;
    o->x = NULL;
}

/* ---- the wishes in turn ---- */

/* Share of the whole that all limits cost: what the objective would gain if each were wider by its own size.
 */
static double share_of(const limited *l, const hci_limit_optimum *o, double whole)
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
static void note_cost(limited *l, hci_limit_cost cost, const hci_limit_optimum *o, double whole)
{
    hci_solution *s = l->of->solution;
    if (s->limit_cost != HCI_COST_NONE || share_of(l, o, whole) < COSTS) return;
    s->limit_cost = cost;
    l->cost = *o;
    l->cost.x = NULL;
}

static double tolerance_Nm(const limited *l)
{
    return REACHED * l->of->solution->tolerance_Nm;
}

/* Widens the limits until there is a current. */
static hci_status fit(limited *l, hci_note *note)
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

static hci_status find_mean(limited *l, hci_note *note)
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
static hci_status find_ripple(limited *l, hci_note *note)
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
static hci_status find_copper(limited *l, hci_note *note)
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
static hci_status try_all(limited *l, bool *is_met, hci_note *note)
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

static hci_status in_turn(limited *l, hci_note *note)
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
static hci_status all_wishes(limited *l, hci_note *note)
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

/* ---- torque that is not linear ---- */

static hci_status follow(limited *l, const double *x, hci_note *note)
{
    hci_wave *wave = hci_memory_new(l->set.count + 1, sizeof *wave);
    size_t n = 0;
    if (!wave) return out_of_memory(note);
    if (l->of->task->held) wave[n++] = *l->of->task->held;
    for (size_t k = 0; k < l->set.count; ++k)
        wave[n++] =
            (hci_wave){l->set.component[k].order, l->set.component[k].sequence, x[2 * k], x[2 * k + 1]};
    hci_memory_free(l->current.wave);
    l->current.wave = wave;
    l->current.count = hci_waves_join(wave, n, 1e-12);
    return HCI_OK;
}

static hci_status step(limited *l, hci_note *note)
{
    const hci_limited *of = l->of;
    hci_status status = HCI_OK;
    if (!hci_task_is_linear(of->task))
        status = hci_task_linearise(of->task, l->current.wave, l->current.count, of->at, note);
    if (!status) status = make_program(l, note);
    return status ? status : all_wishes(l, note);
}

/* Moves `from` towards the answer: by Anderson's acceleration while the change falls, by a share of the way
 * where it grows. Returns the change. */
static double move(limited *l, double *from, double *share, double before)
{
    double change = 0.0, size = 0.0;
    for (size_t j = 0; j < 2 * l->set.count; ++j) {
        change += (l->x[j] - from[j]) * (l->x[j] - from[j]);
        size += l->x[j] * l->x[j];
    }
    change = size > 0.0 ? sqrt(change / size) : 0.0;
    if (change < before) {
        *share = 1.0;
        hci_anderson_step(&l->mixing, from, l->x);
        return change;
    }
    *share = fmax(0.5 * *share, LEAST_SHARE);
    for (size_t j = 0; j < 2 * l->set.count; ++j)
        from[j] += *share * (l->x[j] - from[j]);
    return change;
}

/* Whether neither torque nor voltage has to be made linear. */
static bool is_linear(const limited *l)
{
    const hci_effects *e = l->of->options->effects;
    return hci_task_is_linear(l->of->task) && !(e && e->count > 0 && l->of->bounds->line_V < HUGE_VAL);
}

static hci_status iterate(limited *l, double *from, hci_note *note)
{
    hci_solution *s = l->of->solution;
    double share = 1.0, change = HUGE_VAL;
    hci_status status = hci_anderson_reset(&l->mixing, 2 * l->set.count) ? out_of_memory(note) : HCI_OK;
    for (int k = 0; k < MOST_STEPS && change > CONVERGED && !status; ++k) {
        l->is_coarse = !is_linear(l) && change > COARSE;
        status = follow(l, from, note);
        if (!status) status = step(l, note);
        if (status || is_linear(l)) return status;
        change = move(l, from, &share, change);
        ++s->newton_steps;
        s->newton_change = change;
    }
    s->newton_converged = change <= RESTS;
    return status;
}

/* ---- all of it ---- */

/* Coordinates of the answer without limits on the set, as far as it has them. */
static void start(const limited *l, const hci_answer *a, double *x)
{
    const double mean_Nm = hci_target_mean_Nm(l->of->options->target);
    for (size_t k = 0; k < l->set.count; ++k)
        for (size_t j = 0; j < a->set.count; ++j)
            if (a->set.component[j].sequence == l->set.component[k].sequence &&
                fabs(a->set.component[j].order - l->set.component[k].order) < HCI_ORDER_TOLERANCE)
                for (size_t part = 0; part < 2; ++part)
                    x[2 * k + part] = hci_coordinate(a->x, 2 * a->set.count, mean_Nm, 2 * j + part);
}

/* The set and the currents into the answer. */
static hci_status give(limited *l, hci_answer *a, hci_note *note)
{
    hci_answer_release(a);
    if (hci_answer_reserve(l->set.count, a)) return out_of_memory(note);
    memcpy(a->set.component, l->set.component, l->set.count * sizeof *a->set.component);
    memcpy(a->set.set, l->set.set, l->set.count * sizeof *a->set.set);
    memcpy(a->x + 2 * l->set.count, l->x, 2 * l->set.count * sizeof *a->x);
    return HCI_OK;
}

static hci_status solve(limited *l, hci_answer *a, hci_note *note)
{
    double *from = hci_memory_new(2 * l->set.count, sizeof *from);
    hci_status status = from ? HCI_OK : out_of_memory(note);
    if (!status) {
        start(l, a, from);
        status = iterate(l, from, note);
    }
    if (!status) status = give(l, a, note);
    if (!status) status = hci_linear_describe(l->of->task, a, l->of->solution, note);
    hci_memory_free(from);
    return status;
}

/* Where working precision does not do, the currents without limits stay and that is said. */
static hci_status give_up(hci_solution *s, const hci_note *why)
{
    s->limit_cost = HCI_COST_NONE;
    s->minimised_Nm = NAN;
    s->exceeded_share = 0.0;
    hci_note_add(&s->remark, "limits: %s; these are the currents without limits", why->text);
    return HCI_OK;
}

static void release(limited *l)
{
    release_program(l);
    hci_limit_points_release(&l->program.points);
    hci_component_set_release(&l->set);
    hci_anderson_release(&l->mixing);
    hci_memory_free(l->current.wave);
    hci_memory_free(l->x);
}

hci_status hci_limited_answer(const hci_limited *limited_task, hci_answer *answer, hci_note *note)
{
    limited l = {.of = limited_task};
    hci_note why = {{0}};
    hci_status status = choose_set(&l, answer, note);
    begin_program(&l);
    if (!status && l.program.field.voltage)
        status = hci_voltage_model_make(limited_task->machine, limited_task->options, &l.voltage, note);
    if (!status) {
        status = solve(&l, answer, &why);
        if (status == HCI_ERROR_NUMERIC)
            status = give_up(limited_task->solution, &why);
        else if (status)
            hci_note_set(note, status, "%s", why.text);
        else
            hci_limits_take_gains(&l.cost, limited_task->solution);
    }
    release(&l);
    return status;
}
