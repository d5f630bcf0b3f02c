/* Unknowns: the coordinates over scale_A; then, of all stages but COPPER, what is minimised over scale_Nm (a
 * share for FIT); of a peak-to-peak also the highest and the lowest torque. Rows are divided by their limits,
 * so that all are near 1. */
#include "host/solution/limit_program.h"

#include <math.h>
#include <string.h>

#include "host/base/memory.h"
#include "host/numeric/cone.h"

#define LEAST_PRICE 1e-9 /* of current where nothing else prices it, lest it be without bounds */
#define WORST_ERROR 1e-5 /* of a program, relative, that is taken as solved */

/* A program under construction: rows of n + 1 numbers, the last one the right side. */
typedef struct {
    const hci_limit_program *of;
    hci_limit_stage stage;
    size_t n, coordinates;
    size_t rows, room, width;
    double *row;
    double *low; /* of two-sided rows; room */
    size_t two_sided, linear, equalities;
    size_t *cone, cones;
    double *equal; /* rows of n + 1 */
    double *p, *c;
    bool is_full; /* memory is out */
    /* where limits stand, to read their multipliers: */
    size_t *limit_of; /* for each row, 1 + kind·4 + phase, 0: none; room */
} build;

static bool is_linear_ripple(const build *b)
{
    return b->of->minimise == HCI_MINIMISE_PEAK_TO_PEAK;
}

/* Position of what is minimised; of the highest and the lowest torque after it. */
static size_t objective_of(const build *b)
{
    return b->coordinates;
}

static size_t unknowns_of(const build *b)
{
    if (b->stage == HCI_STAGE_FIT || b->stage == HCI_STAGE_MEAN) return b->coordinates + 1;
    return b->coordinates + (is_linear_ripple(b) ? 3 : b->stage == HCI_STAGE_RIPPLE ? 1 : 0);
}

/* ---- rows ---- */

static bool grow(build *b)
{
    const size_t room = 2 * b->room + 64;
    double *row = hci_memory_resize(b->row, room * b->width, sizeof *row);
    if (row) b->row = row;
    double *low = hci_memory_resize(b->low, room, sizeof *low);
    if (low) b->low = low;
    size_t *limit_of = hci_memory_resize(b->limit_of, room, sizeof *limit_of);
    if (limit_of) b->limit_of = limit_of;
    b->is_full = b->is_full || !row || !low || !limit_of;
    if (!b->is_full) b->room = room;
    return !b->is_full;
}

/* A new row of zeros; NULL when memory is out, and then the program is not used. */
static double *new_row(build *b)
{
    double *row;
    if (b->is_full || (b->rows == b->room && !grow(b))) return NULL;
    row = b->row + b->rows * b->width;
    memset(row, 0, b->width * sizeof *row);
    b->low[b->rows] = 0.0;
    b->limit_of[b->rows++] = 0;
    return row;
}

static size_t tag(hci_limit_kind kind, int phase)
{
    return 1 + 4 * (size_t)kind + (size_t)phase;
}

/* ---- limits over the angle ---- */

double hci_limit_of_grid(const hci_limit_program *p, const hci_limit_grid *g)
{
    const double limit = g->kind == HCI_POINT_VOLTAGE ? p->bounds->line_V : p->bounds->current_A[g->phase];
    return limit * (1.0 + p->widened);
}

static double point_limit(const hci_limit_program *p, const hci_limit_point *at)
{
    const hci_limit_grid g = {.kind = at->kind, .phase = at->phase};
    return hci_limit_of_grid(p, &g) * (1.0 - 2.0 * HCI_LIMIT_MARGIN);
}

/* |g·x + constant| <= limit: one two-sided row, or two rows with the share by which limits are widened. */
static void add_point(build *b, const hci_limit_point *at, const double *g, double constant)
{
    const double limit = point_limit(b->of, at), scale = b->of->scale_A / limit;
    const int sides = b->stage == HCI_STAGE_FIT ? 2 : 1;
    for (int side = 0; side < sides; ++side) {
        double *row = new_row(b);
        const double sign = side == 0 ? 1.0 : -1.0;
        if (!row) return;
        for (size_t j = 0; j < b->coordinates; ++j)
            row[j] = sign * scale * g[j];
        row[b->n] = 1.0 - sign * constant / limit;
        b->low[b->rows - 1] = -1.0 - constant / limit;
        if (sides == 2) row[objective_of(b)] = -1.0;
        b->limit_of[b->rows - 1] =
            tag(at->kind == HCI_POINT_VOLTAGE ? HCI_LIMIT_VOLTAGE : HCI_LIMIT_CURRENT, at->phase);
    }
}

/* Torque less wanted torque is at most the highest and at least the lowest. */
static void add_torque_point(build *b, const double *g, double constant_Nm)
{
    for (int side = 0; side < 2; ++side) {
        double *row = new_row(b);
        const double sign = (side == 0 ? 1.0 : -1.0) / b->of->scale_Nm;
        if (!row) return;
        for (size_t j = 0; j < b->coordinates; ++j)
            row[j] = sign * b->of->scale_A * g[j];
        row[b->n] = -sign * constant_Nm;
        row[objective_of(b) + 1 + (size_t)side] = side == 0 ? -1.0 : 1.0;
    }
}

static void add_any_point(build *b, const hci_limit_point *at, const double *g, double constant)
{
    if (at->kind == HCI_POINT_TORQUE)
        add_torque_point(b, g, constant);
    else
        add_point(b, at, g, constant);
}

static bool is_of_stage(const build *b, hci_point_kind kind, bool is_torque)
{
    if ((kind == HCI_POINT_TORQUE) != is_torque) return false;
    return !is_torque || (is_linear_ripple(b) && b->stage >= HCI_STAGE_RIPPLE);
}

/* Rows of the grids and of the points beside them: of the torque, or of all that is limited. */
static void add_points(build *b, bool is_torque)
{
    const hci_limit_program *p = b->of;
    const size_t torque_rows = p->field.system ? p->field.system->rows + p->field.system->unknowns : 0;
    double *g = hci_memory_new(b->coordinates + torque_rows, sizeof *g);
    b->is_full = b->is_full || !g;
    for (size_t q = 0; g && q < p->grids; ++q)
        for (size_t k = 0; is_of_stage(b, p->grid[q].kind, is_torque) && k < p->grid[q].samples; ++k) {
            if (!p->grid[q].is_row[k]) continue;
            const hci_limit_point at = {p->grid[q].kind, p->grid[q].phase, 0.0};
            add_any_point(b, &at, p->grid[q].g + k * p->grid[q].unknowns, p->grid[q].constant[k]);
        }
    for (size_t k = 0; g && k < p->points.count; ++k) {
        const hci_limit_point *at = &p->points.point[k];
        if (!is_of_stage(b, at->kind, is_torque)) continue;
        const double constant = hci_limit_row(&p->field, at, g);
        add_any_point(b, at, g, constant);
    }
    hci_memory_free(g);
}

/* ---- the torque's orders ---- */

/* Row k of U, times a factor and scaled, into a row of the program; returns h there. */
static double system_row(const build *b, size_t k, double factor, double *row)
{
    const hci_harmonic_system *s = b->of->field.system;
    const double scale = factor * b->of->scale_A / b->of->scale_Nm;
    for (size_t j = 0; j < s->unknowns; ++j)
        for (int64_t e = s->u.column_start[j]; e < s->u.column_start[j + 1]; ++e)
            if ((size_t)s->u.row[e] == k) row[j] = scale * s->u.value[e];
    return factor * (b->of->field.mean_Nm * s->h[k] + s->h[s->rows + k]) / b->of->scale_Nm;
}

static bool has_mean_row(const hci_harmonic_system *s)
{
    return s->order_count > 0 && s->order[0] < HCI_ORDER_TOLERANCE;
}

/* |mean − wanted| <= t, or what the mean may fall back by from the nearest. */
static void add_mean(build *b)
{
    const hci_limit_program *p = b->of;
    if (!has_mean_row(p->field.system)) return;
    for (int side = 0; side < 2; ++side) {
        const double sign = side == 0 ? 1.0 : -1.0;
        double *row =
            b->stage == HCI_STAGE_MEAN || (b->stage > HCI_STAGE_MEAN && !p->has_mean) ? new_row(b) : NULL;
        if (!row) return;
        row[b->n] = system_row(b, 0, sign / p->field.system->row_weight[0], row);
        if (b->stage == HCI_STAGE_MEAN)
            row[objective_of(b)] = -1.0;
        else
            row[b->n] += fabs(p->mean_Nm - p->field.mean_Nm) / p->scale_Nm +
                         HCI_LIMIT_SLACK * fmax(1.0, fabs(p->mean_Nm) / p->scale_Nm);
    }
}

static void begin_cone(build *b, size_t rows)
{
    b->cone[b->cones++] = rows;
}

/* The head of a cone of torque: t, or the ripple that is to be kept. */
static void add_torque_head(build *b)
{
    const hci_limit_program *p = b->of;
    double *row = new_row(b);
    if (!row) return;
    if (b->stage == HCI_STAGE_RIPPLE)
        row[objective_of(b)] = -1.0;
    else
        row[b->n] = p->ripple_Nm * (1.0 + p->slack) / p->scale_Nm + 0.1 * p->slack;
}

static void add_torque_row(build *b, size_t k)
{
    double *row = new_row(b);
    if (row) row[b->n] = system_row(b, k, 1.0, row);
}

/* One cone for each order (its largest error), or one for all of them (their root of the sum of squares). */
static void add_torque_cones(build *b)
{
    const hci_harmonic_system *s = b->of->field.system;
    const size_t first = has_mean_row(s) ? 1 : 0;
    const bool is_rms = b->of->minimise == HCI_MINIMISE_RMS;
    if (b->stage < HCI_STAGE_RIPPLE || is_linear_ripple(b) || s->rows == first) return;
    if (b->stage == HCI_STAGE_COPPER && b->of->has_ripple) return;
    for (size_t k = first; k < s->rows; ++k) {
        if (k == first || (!is_rms && (k - first) % 2 == 0)) {
            begin_cone(b, is_rms ? 1 + s->rows - first : 3);
            add_torque_head(b);
        }
        add_torque_row(b, k);
    }
}

/* highest − lowest <= t, or the swing that is to be kept. */
static void add_swing(build *b)
{
    const hci_limit_program *p = b->of;
    double *row = is_linear_ripple(b) && b->stage >= HCI_STAGE_RIPPLE ? new_row(b) : NULL;
    if (!row) return;
    row[objective_of(b) + 1] = 1.0;
    row[objective_of(b) + 2] = -1.0;
    if (b->stage == HCI_STAGE_RIPPLE)
        row[objective_of(b)] = -1.0;
    else
        row[b->n] = p->ripple_Nm * (1.0 + p->slack) / p->scale_Nm + 0.1 * p->slack;
}

/* ---- heat ---- */

static bool is_order(const build *b, size_t k, double order)
{
    return fabs(b->of->field.set->component[k].order - order) < HCI_ORDER_TOLERANCE;
}

/* Whether component k is the first of its order. */
static bool begins_order(const build *b, size_t k)
{
    for (size_t j = 0; j < k; ++j)
        if (is_order(b, j, b->of->field.set->component[k].order)) return false;
    return true;
}

/* Coordinate S' (part 0) or C' (part 1) of one order as one phase sees it, times a factor. */
typedef struct {
    double order;
    int phase, part;
    double factor;
} phase_part;

/* The same of one component: what its S and its C bring. */
static void part_of(const phase_part *x, hci_component c, double pair[2])
{
    double turn[2];
    hci_limit_turn(c, x->phase, turn);
    pair[0] = x->factor * (x->part ? -turn[1] : turn[0]);
    pair[1] = x->factor * (x->part ? turn[0] : turn[1]);
}

/* Fills a row with a coordinate; what is held goes to the right side. */
static void phase_row(const build *b, const phase_part *x, double *row)
{
    const hci_component_set *set = b->of->field.set;
    const hci_wave *held = b->of->field.held;
    double pair[2];
    for (size_t k = 0; k < set->count; ++k) {
        if (!is_order(b, k, x->order)) continue;
        part_of(x, set->component[k], pair);
        row[2 * k] = b->of->scale_A * pair[0];
        row[2 * k + 1] = b->of->scale_A * pair[1];
    }
    if (!held || fabs(held->order - x->order) >= HCI_ORDER_TOLERANCE) return;
    part_of(x, (hci_component){held->order, held->sequence}, pair);
    row[b->n] = -(pair[0] * held->sine + pair[1] * held->cosine);
}

/* The head of a cone of heat: 1, and the share by which limits are widened. */
static void add_heat_head(build *b, size_t rows, size_t limit_of)
{
    double *row;
    begin_cone(b, rows);
    row = new_row(b);
    if (!row) return;
    row[b->n] = 1.0;
    if (b->stage == HCI_STAGE_FIT) row[objective_of(b)] = -1.0;
    b->limit_of[b->rows - 1] = limit_of;
}

/* The rms current of a phase: √(Σ ½(S'² + C'²)) <= limit, a direct current in full. */
static void add_rms(build *b, int phase)
{
    const double limit_A = b->of->bounds->rms_A[phase] * (1.0 + b->of->widened);
    const size_t head = b->rows;
    if (!(limit_A < HUGE_VAL)) return;
    add_heat_head(b, 0, tag(HCI_LIMIT_RMS, phase));
    for (size_t k = 0; k < b->of->field.set->count; ++k) {
        const double order = b->of->field.set->component[k].order;
        const bool is_mean = order < HCI_ORDER_TOLERANCE;
        for (int part = is_mean ? 1 : 0; begins_order(b, k) && part < 2; ++part) {
            const phase_part x = {order, phase, part, (is_mean ? 1.0 : sqrt(0.5)) / limit_A};
            double *row = new_row(b);
            if (row) phase_row(b, &x, row);
        }
    }
    b->cone[b->cones - 1] = b->rows - head;
}

/* Mean of i_a² + i_b² + i_c² over 3/2 of a unit of x_k²: 1, of a zero sequence at order 0 2 for C, 0 for S.
 */
static double copper_of(hci_component c, int part)
{
    if (c.sequence != 0 || c.order >= HCI_ORDER_TOLERANCE) return 1.0;
    return part ? 2.0 : 1e-6;
}

/* √(3/2 Σ x²) <= limit, what is held included. */
static void add_copper(build *b)
{
    const hci_wave *held = b->of->field.held;
    const double limit_A = sqrt(b->of->bounds->mean_square_A2) * (1.0 + b->of->widened);
    if (!(limit_A < HUGE_VAL)) return;
    add_heat_head(b, 1 + b->coordinates + (held ? 1 : 0), tag(HCI_LIMIT_COPPER, 0));
    for (size_t j = 0; j < b->coordinates; ++j) {
        double *row = new_row(b);
        if (row)
            row[j] = b->of->scale_A / limit_A *
                     sqrt(1.5 * copper_of(b->of->field.set->component[j / 2], (int)(j % 2)));
    }
    double *row = held ? new_row(b) : NULL;
    if (row) row[b->n] = sqrt(1.5) * hci_amplitude(held->sine, held->cosine) / limit_A;
}

/* |x − centre| <= radius, of all but FIT, which has to have room. */
static void add_trust(build *b)
{
    const hci_limit_program *p = b->of;
    if (!(p->radius_A > 0.0) || b->stage == HCI_STAGE_FIT) return;
    begin_cone(b, 1 + b->coordinates);
    double *head = new_row(b);
    if (head) head[b->n] = 1.0;
    for (size_t j = 0; j < b->coordinates; ++j) {
        double *row = new_row(b);
        if (!row) return;
        row[j] = p->scale_A / p->radius_A;
        row[b->n] = p->centre[j] / p->radius_A;
    }
}

/* ---- equations ---- */

static double *new_equation(build *b)
{
    return b->equal + b->equalities++ * b->width;
}

/* A phase that is open: every order of its current is 0. */
static void add_open(build *b, int phase)
{
    if (b->of->bounds->current_A[phase] > 0.0) return;
    for (size_t k = 0; k < b->of->field.set->count; ++k)
        for (int part = 0; begins_order(b, k) && part < 2; ++part) {
            const phase_part x = {b->of->field.set->component[k].order, phase, part, 1.0 / b->of->scale_A};
            if (x.order >= HCI_ORDER_TOLERANCE || part == 1) phase_row(b, &x, new_equation(b));
        }
}

/* The mean where the wanted one is reached, and every order where no ripple is left. */
static void add_orders(build *b)
{
    const hci_limit_program *p = b->of;
    const hci_harmonic_system *s = p->field.system;
    const bool all = b->stage == HCI_STAGE_COPPER && p->has_ripple;
    if (b->stage < HCI_STAGE_RIPPLE) return;
    for (size_t k = 0; k < s->rows; ++k) {
        const bool is_mean = k == 0 && has_mean_row(s);
        if (is_mean ? !p->has_mean : !all) continue;
        double *row = new_equation(b);
        row[b->n] = system_row(b, k, 1.0 / s->row_weight[k], row);
    }
}

/* ---- the program ---- */

static void fill_objective(build *b)
{
    for (size_t j = 0; j < b->coordinates; ++j) {
        const double copper = copper_of(b->of->field.set->component[j / 2], (int)(j % 2));
        b->p[j * (b->n + 1)] = b->stage == HCI_STAGE_COPPER ? copper : LEAST_PRICE * copper;
    }
    if (b->stage != HCI_STAGE_COPPER) b->c[objective_of(b)] = 1.0;
    for (size_t j = b->coordinates; b->stage == HCI_STAGE_COPPER && j < b->n; ++j)
        b->p[j * (b->n + 1)] = LEAST_PRICE;
}

static void fill(build *b)
{
    add_points(b, false);
    b->two_sided = b->stage == HCI_STAGE_FIT ? 0 : b->rows;
    add_mean(b);
    add_points(b, true);
    add_swing(b);
    b->linear = b->rows;
    add_torque_cones(b);
    for (int phase = 0; phase < 3; ++phase)
        add_rms(b, phase);
    add_copper(b);
    add_trust(b);
    for (int phase = 0; phase < 3; ++phase)
        add_open(b, phase);
    add_orders(b);
    fill_objective(b);
}

static void release(build *b)
{
    hci_memory_free(b->row);
    hci_memory_free(b->low);
    hci_memory_free(b->limit_of);
    hci_memory_free(b->cone);
    hci_memory_free(b->equal);
    hci_memory_free(b->p);
    hci_memory_free(b->c);
}

static bool begin(const hci_limit_program *of, hci_limit_stage stage, build *b)
{
    const size_t system_rows = of->field.system ? of->field.system->rows : 0;
    memset(b, 0, sizeof *b);
    b->of = of;
    b->stage = stage;
    b->coordinates = 2 * of->field.set->count;
    b->n = unknowns_of(b);
    b->width = b->n + 1;
    b->cone = hci_memory_new(system_rows + 5, sizeof *b->cone);
    b->equal = hci_memory_new((system_rows + 3 * b->coordinates) * b->width, sizeof *b->equal);
    b->p = hci_memory_new(b->n * b->n, sizeof *b->p);
    b->c = hci_memory_new(b->n, sizeof *b->c);
    if (!b->cone || !b->equal || !b->p || !b->c) return false;
    fill(b);
    return !b->is_full;
}

/* Rows of n + 1 numbers to a matrix by columns, the right side as its last one. */
static void transpose(const double *row, size_t rows, size_t width, double *out)
{
    for (size_t k = 0; k < rows; ++k)
        for (size_t j = 0; j < width; ++j)
            out[k + j * rows] = row[k * width + j];
}

/* ---- its answer ---- */

/* What the objective gains for 1 more of each limit: the multiplier over the limit, by which its rows were
 * divided. */
static void read_gains(const build *b, const double *z, double per_objective, hci_limit_optimum *o)
{
    const hci_bounds *l = b->of->bounds;
    const double wide = 1.0 + b->of->widened;
    for (size_t k = 0; k < b->rows; ++k) {
        const size_t t = b->limit_of[k];
        const double gain = per_objective * fabs(z[k]) / wide;
        const size_t kind = (t - 1) / 4, phase = (t - 1) % 4;
        if (t == 0) continue;
        if (kind == HCI_LIMIT_CURRENT) o->current_gain[phase] += gain / l->current_A[phase];
        if (kind == HCI_LIMIT_RMS) o->rms_gain[phase] += gain / l->rms_A[phase];
        if (kind == HCI_LIMIT_VOLTAGE) o->voltage_gain += gain / l->line_V * l->line_V_per_V;
        if (kind == HCI_LIMIT_COPPER) o->copper_gain += 0.5 * gain / l->mean_square_A2;
    }
}

/* Of the stage's objective: share, N·m, or A² of 1 of the program's. */
static double unit_of(const build *b)
{
    const double scale_A = b->of->scale_A;
    if (b->stage == HCI_STAGE_FIT) return 1.0;
    return b->stage == HCI_STAGE_COPPER ? 3.0 * scale_A * scale_A : b->of->scale_Nm;
}

static void read_answer(const build *b, const hci_cone_answer *a, hci_limit_optimum *o)
{
    o->is_infeasible = a->end == HCI_CONE_INFEASIBLE;
    for (size_t j = 0; j < b->coordinates; ++j) {
        o->x[j] = b->of->scale_A * a->x[j];
        if (b->stage == HCI_STAGE_COPPER)
            o->smallest +=
                1.5 * copper_of(b->of->field.set->component[j / 2], (int)(j % 2)) * o->x[j] * o->x[j];
    }
    if (b->stage != HCI_STAGE_COPPER) o->smallest = unit_of(b) * a->x[objective_of(b)];
    if (b->n > b->coordinates + 1) {
        o->highest_Nm = b->of->scale_Nm * a->x[objective_of(b) + 1];
        o->lowest_Nm = b->of->scale_Nm * a->x[objective_of(b) + 2];
    }
    read_gains(b, a->z, unit_of(b), o);
}

static hci_status solve(const build *b, const double *g, const double *equal, hci_limit_optimum *o,
                        hci_note *note)
{
    const hci_cone_problem problem = {.unknowns = b->n,
                                      .p = b->p,
                                      .c = b->c,
                                      .equalities = b->equalities,
                                      .a = equal,
                                      .b = equal + b->n * b->equalities,
                                      .rows = b->rows,
                                      .two_sided = b->two_sided,
                                      .linear = b->linear,
                                      .g = g,
                                      .h = g + b->n * b->rows,
                                      .low = b->low,
                                      .cones = b->cones,
                                      .cone = b->cone};
    hci_cone_answer answer;
    hci_status status = hci_cone_solve(&problem, &answer, note);
    if (!status && answer.end != HCI_CONE_INFEASIBLE && !(answer.error < WORST_ERROR))
        status = hci_note_set(note, HCI_ERROR_NUMERIC,
                              "they were not met to working precision (%.1e); try wider or fewer ones",
                              answer.error);
    if (!status) read_answer(b, &answer, o);
    hci_cone_answer_release(&answer);
    return status;
}

hci_status hci_limit_program_solve(const hci_limit_program *program, hci_limit_stage stage,
                                   hci_limit_optimum *optimum, hci_note *note)
{
    build b;
    const bool is_built = begin(program, stage, &b);
    double *g = hci_memory_new(b.rows * b.width, sizeof *g),
           *equal = hci_memory_new(b.equalities * b.width, sizeof *equal);
    hci_status status = HCI_OK;
    memset(optimum, 0, sizeof *optimum);
    optimum->x = hci_memory_new(b.coordinates, sizeof *optimum->x);
    if (!is_built || !g || !equal || !optimum->x)
        status = hci_note_memory(note, NULL, "solving within limits");
    if (!status) {
        transpose(b.row, b.rows, b.width, g);
        transpose(b.equal, b.equalities, b.width, equal);
        status = solve(&b, g, equal, optimum, note);
    }
    hci_memory_free(g);
    hci_memory_free(equal);
    release(&b);
    return status;
}
