#include "host/solution/wishes_program.h"

#include <math.h>

#include "host/base/memory.h"

enum {
    PER_PERIOD = 64, /* samples in the period of the highest order: no peak hides between two of them */
    COARSE_PER_PERIOD = 16, /* while the currents are still on their way */
    ROWS_PER_PERIOD = 4     /* samples that are rows from the start */
};

#define ALIKE     1e-9 /* share of a row within which two are the same */
#define NOTHING_A 1e-6 /* a peak below which the currents without limits give no scale */

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

/* ---- symmetry ---- */

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
        const hci_limit_point here = {one.kind, one.phase, 0.1 + 0.83 * k, 0.0},
                              there = {one.kind, phase, here.theta_rad + shift_rad, 0.0};
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
    const hci_limit_point first = {kind, 0, 0.0, 0.0};
    const double third_rad = 2.0 * HCI_PI / 3.0;
    double *row = hci_memory_new(4 * l->set.count, sizeof *row);
    bool thirds = hci_bounds_are_alike(l->of->bounds), halves = l->program.field.turns == 1;
    if (!row) return out_of_memory(note);
    for (int phase = 0; phase < 3; ++phase) {
        const hci_limit_point one = {kind, phase, 0.0, 0.0};
        thirds = thirds && is_same(l, first, phase * third_rad, phase, 1.0, row);
        halves = halves && is_same(l, one, HCI_PI, phase, -1.0, row);
    }
    hci_memory_free(row);
    *phases = thirds ? 1 : 3;
    *share = halves ? 0.5 : 1.0;
    return HCI_OK;
}

/* ---- grids ---- */

static hci_status add_grid(hci_wishes *l, hci_point_kind kind, int phase, double top, double share,
                           hci_note *note)
{
    hci_limit_grid *g = &l->program.grid[l->program.grids++];
    const double periods = share * (double)l->program.field.turns;
    const size_t stride = (size_t)(l->is_coarse ? COARSE_PER_PERIOD : PER_PERIOD) / ROWS_PER_PERIOD;
    const size_t samples = stride * (size_t)ceil(periods * ROWS_PER_PERIOD * fmax(top, 4.0));
    *g = (hci_limit_grid){
        .kind = kind, .phase = phase, .samples = samples, .period_rad = 2.0 * HCI_PI * periods};
    if (hci_limit_grid_make(&l->program.field, g)) return out_of_memory(note);
    for (size_t k = 0; k < samples; k += stride)
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

/* Whether it is the size of the voltage vector that is limited, which of an open phase there is not. */
static bool limits_vector(const hci_wishes *l)
{
    const hci_bounds *b = l->of->bounds;
    return b->modulation == HCI_MODULATION_CIRCLE && hci_bounds_drive_pair(b, 0) &&
           hci_bounds_drive_pair(b, 1) && hci_bounds_drive_pair(b, 2);
}

static hci_status add_voltages(hci_wishes *l, hci_note *note)
{
    int pairs;
    double share;
    hci_status status = HCI_OK;
    if (!(l->of->bounds->line_V < HUGE_VAL)) return HCI_OK;
    status = find_symmetry(l, HCI_POINT_VOLTAGE, &pairs, &share, note);
    if (!status && limits_vector(l)) /* phases that are alike turn it by a third of a turn */
        return add_grid(l, HCI_POINT_VECTOR, 0, top_of_voltage(l), pairs == 1 ? share / 3.0 : share, note);
    for (int pair = 0; pair < pairs && !status; ++pair)
        if (hci_bounds_drive_pair(l->of->bounds, pair))
            status = add_grid(l, HCI_POINT_VOLTAGE, pair, top_of_voltage(l), share, note);
    return status;
}

/* The share of a period after which the torque repeats: all orders are multiples of one. */
static double share_of_torque(const hci_wishes *l)
{
    const hci_harmonic_system *s = &l->system;
    size_t common = 0;
    for (size_t k = 0; k < s->order_count; ++k) {
        size_t order = (size_t)(s->order[k] * (double)l->program.field.turns + 0.5);
        while (order > 0) {
            const size_t left = common % order;
            common = order;
            order = left;
        }
    }
    return common > 0 ? 1.0 / (double)common : 1.0;
}

static hci_status add_torque(hci_wishes *l, hci_note *note)
{
    const hci_harmonic_system *s = &l->system;
    const double top = s->order_count ? s->order[s->order_count - 1] : 1.0;
    return add_grid(l, HCI_POINT_TORQUE, 0, top, share_of_torque(l), note);
}

static hci_status make_grids(hci_wishes *l, hci_note *note)
{
    hci_status status = add_currents(l, note);
    if (!status) status = add_voltages(l, note);
    if (!status && l->program.minimise == HCI_MINIMISE_PEAK_TO_PEAK) status = add_torque(l, note);
    return status;
}

void hci_wishes_program_release(hci_wishes *l)
{
    hci_harmonic_system_release(&l->system);
    for (size_t q = 0; q < l->program.grids; ++q)
        hci_limit_grid_release(&l->program.grid[q]);
    l->program.grids = 0;
}

/* System and grids at the currents of the last step. */
hci_status hci_wishes_program_make(hci_wishes *l, hci_note *note)
{
    const hci_limited *of = l->of;
    hci_status status;
    hci_wishes_program_release(l);
    hci_limit_points_change(&l->program.points);
    status =
        hci_harmonic_system_make(of->task, l->set.component, l->set.count,
                                 of->options->set ? of->options->compare : HCI_COMPARE_ALL, &l->system, note);
    return status ? status : make_grids(l, note);
}

void hci_wishes_program_begin(hci_wishes *l)
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
    p->task = of->task;
    p->bounds = of->bounds;
    p->minimise = o->minimise == HCI_MINIMISE_AUTO ? HCI_MINIMISE_WORST : o->minimise;
    p->scale_Nm = of->solution->tolerance_Nm / (o->tolerance > 0.0 ? o->tolerance : 1e-6);
    p->scale_A = of->solution->peak_phase_current_A > NOTHING_A ? of->solution->peak_phase_current_A : 1.0;
    for (int s = 0; s < 3; ++s)
        if (of->bounds->current_A[s] > 0.0) p->scale_A = fmin(p->scale_A, of->bounds->current_A[s]);
    if (!(p->scale_Nm > 0.0)) p->scale_Nm = 1.0;
    p->slack = HCI_LIMIT_SLACK;
}
