/* Rows of what is limited: currents, voltages and torque at the angles of the grids and the points beside
 * them; how large the currents are as a whole, which is heat of each phase and of all and the distance from
 * the last answer; and phases that carry none. */
#include "host/limit/rows.h"

#include <math.h>

#include "core/math/vector.h"
#include "host/solve/harmonic_system.h"

#define LEAST_COPPER 1e-6 /* of a unit that makes none */

/* ---- at angles ---- */

/* What a quantity is limited to, but for the share that is kept free. */
static double limit_of(const hci_limit_program *p, const hci_limit_point *at)
{
    return hci_limit_of_point(p->bounds, at->kind, at->phase) * (1.0 + p->widened) *
           (1.0 - 2.0 * HCI_LIMIT_MARGIN);
}

/* A new row of an angle; NULL when memory is out. */
static double *angle_row(hci_limit_build *b, const hci_limit_point *at)
{
    double *row = hci_limit_row_add(b);
    if (!row) return NULL;
    b->at[b->rows - 1] = *at;
    if (at->kind != HCI_POINT_TORQUE) b->limit_of[b->rows - 1] = hci_limit_tag_of(at);
    return row;
}

/* |g·x + constant| <= limit: one two-sided row, or two rows with the share by which limits are widened. */
static void add_two_sided(hci_limit_build *b, const hci_limit_point *at, const double *g)
{
    const double limit = limit_of(b->of, at), scale = b->of->scale_A / limit, constant = g[b->coordinates];
    const int sides = b->stage == HCI_STAGE_FIT ? 2 : 1;
    for (int side = 0; side < sides; ++side) {
        double *row = angle_row(b, at);
        const double sign = side == 0 ? 1.0 : -1.0;
        if (!row) return;
        for (size_t j = 0; j < b->coordinates; ++j)
            row[j] = sign * scale * g[j];
        row[b->n] = 1.0 - sign * constant / limit;
        b->low[b->rows - 1] = -1.0 - constant / limit;
        if (sides == 2) row[hci_limit_objective(b)] = -1.0;
    }
}

/* Torque less wanted torque is at most the highest (phase 0) and at least the lowest. */
static void add_torque(hci_limit_build *b, const hci_limit_point *at, const double *g)
{
    for (int side = 0; side < 2; ++side) {
        const hci_limit_point end = {at->kind, side, at->theta_rad, 0.0};
        const double sign = (side == 0 ? 1.0 : -1.0) / b->of->scale_Nm;
        double *row = angle_row(b, &end);
        if (!row) return;
        for (size_t j = 0; j < b->coordinates; ++j)
            row[j] = sign * b->of->scale_A * g[j];
        row[b->n] = -sign * g[b->coordinates];
        row[hci_limit_objective(b) + 1 + (size_t)side] = side == 0 ? -1.0 : 1.0;
    }
}

/* |(g·x + constant of both axes)| <= limit: a cone. */
static void add_vector(hci_limit_build *b, const hci_limit_point *at, const double *g)
{
    const double limit = limit_of(b->of, at), scale = b->of->scale_A / limit;
    hci_limit_cone_begin(b);
    double *head = angle_row(b, at);
    if (!head) return;
    head[b->n] = 1.0;
    if (b->stage == HCI_STAGE_FIT) head[hci_limit_objective(b)] = -1.0;
    for (int axis = 0; axis < 2; ++axis, g += b->coordinates + 1) {
        double *row = angle_row(b, at);
        if (!row) return;
        b->limit_of[b->rows - 1] = 0;
        for (size_t j = 0; j < b->coordinates; ++j)
            row[j] = scale * g[j];
        row[b->n] = -g[b->coordinates] / limit;
    }
    hci_limit_cone_end(b);
}

/* Whether the quantity stays below its limit, whatever the currents within the distance from the centre. */
static bool is_out_of_reach(const hci_limit_build *b, const hci_limit_point *at, const double *g)
{
    const hci_limit_program *p = b->of;
    const size_t n = b->coordinates;
    double steepest = 0.0;
    if (!(p->radius_A > 0.0) || b->stage == HCI_STAGE_FIT || at->kind == HCI_POINT_TORQUE) return false;
    for (size_t k = 0; k < hci_limit_parts(at->kind); ++k)
        steepest += hci_vector_dot(n, g + k * (n + 1), g + k * (n + 1));
    return fabs(hci_limit_value(at->kind, n, g, p->centre)) + sqrt(steepest) * p->radius_A < limit_of(p, at);
}

static void add_point(hci_limit_build *b, const hci_limit_point *at, const double *g)
{
    if (is_out_of_reach(b, at, g)) return;
    if (at->kind == HCI_POINT_TORQUE)
        add_torque(b, at, g);
    else if (at->kind == HCI_POINT_VECTOR)
        add_vector(b, at, g);
    else
        add_two_sided(b, at, g);
}

static void add_grid(hci_limit_build *b, const hci_limit_grid *grid)
{
    for (size_t k = 0; k < grid->samples; ++k) {
        const hci_limit_point at = {grid->kind, grid->phase, grid->step_rad * (double)k, 0.0};
        if (grid->is_row[k]) add_point(b, &at, hci_limit_grid_rows(grid, k));
    }
}

static void add_angles(hci_limit_build *b, hci_point_kind kind)
{
    const hci_limit_program *p = b->of;
    for (size_t q = 0; q < p->grids; ++q)
        if (p->grid[q].kind == kind) add_grid(b, &p->grid[q]);
    for (size_t k = 0; k < p->points.rows; ++k)
        if (p->points.point[k].kind == kind)
            add_point(b, &p->points.point[k], hci_limit_points_row(&p->points, k));
}

void hci_limit_add_angles(hci_limit_build *b)
{
    add_angles(b, HCI_POINT_CURRENT);
    add_angles(b, HCI_POINT_VOLTAGE);
}

void hci_limit_add_vectors(hci_limit_build *b)
{
    add_angles(b, HCI_POINT_VECTOR);
}

void hci_limit_add_torque_angles(hci_limit_build *b)
{
    if (hci_limit_is_swing(b) && b->stage >= HCI_STAGE_RIPPLE) add_angles(b, HCI_POINT_TORQUE);
}

/* ---- one order as a phase sees it ---- */

static bool is_order(const hci_limit_build *b, size_t k, double order)
{
    return fabs(b->of->field.set->component[k].order - order) < HCI_ORDER_TOLERANCE;
}

/* Whether any of the first `count` components has an order. */
static bool has_order(const hci_limit_build *b, size_t count, double order)
{
    for (size_t k = 0; k < count; ++k)
        if (is_order(b, k, order)) return true;
    return false;
}

/* Whether component k is the first of its order. */
static bool begins_order(const hci_limit_build *b, size_t k)
{
    return !has_order(b, k, b->of->field.set->component[k].order);
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
static void phase_row(const hci_limit_build *b, const phase_part *x, double *row)
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

/* ---- rms ---- */

/* The head of a cone of heat: 1, and the share by which limits are widened. */
static void add_heat_head(hci_limit_build *b, size_t limit_of)
{
    double *row;
    hci_limit_cone_begin(b);
    row = hci_limit_row_add(b);
    if (!row) return;
    row[b->n] = 1.0;
    if (b->stage == HCI_STAGE_FIT) row[hci_limit_objective(b)] = -1.0;
    b->limit_of[b->rows - 1] = limit_of;
}

/* What one order brings to the rms current of a phase over its limit: √½ S' and √½ C', a direct current in
 * full. */
static void add_rms_order(hci_limit_build *b, int phase, double order, double limit_A)
{
    const bool is_mean = order < HCI_ORDER_TOLERANCE;
    for (int part = is_mean ? 1 : 0; part < 2; ++part) {
        const phase_part x = {order, phase, part, (is_mean ? 1.0 : sqrt(0.5)) / limit_A};
        double *row = hci_limit_row_add(b);
        if (row) phase_row(b, &x, row);
    }
}

/* √(Σ ½(S'² + C'²)) <= limit, what is held included. */
static void add_rms(hci_limit_build *b, int phase)
{
    const hci_component_set *set = b->of->field.set;
    const hci_wave *held = b->of->field.held;
    const double limit_A = b->of->bounds->rms_A[phase] * (1.0 + b->of->widened);
    if (!(limit_A < HUGE_VAL)) return;
    add_heat_head(b, hci_limit_tag(HCI_LIMIT_RMS, phase));
    for (size_t k = 0; k < set->count; ++k)
        if (begins_order(b, k)) add_rms_order(b, phase, set->component[k].order, limit_A);
    if (held && !has_order(b, set->count, held->order)) add_rms_order(b, phase, held->order, limit_A);
    hci_limit_cone_end(b);
}

void hci_limit_add_rms(hci_limit_build *b)
{
    for (int phase = 0; phase < 3; ++phase)
        add_rms(b, phase);
}

/* ---- copper ---- */

double hci_limit_copper_of(hci_component c, int part)
{
    return fmax(hci_component_copper(c, part), LEAST_COPPER);
}

/* √(3/2 Σ x²) <= limit, what is held included. */
void hci_limit_add_copper(hci_limit_build *b)
{
    const hci_wave *held = b->of->field.held;
    const double limit_A = sqrt(b->of->bounds->mean_square_A2) * (1.0 + b->of->widened);
    if (!(limit_A < HUGE_VAL)) return;
    add_heat_head(b, hci_limit_tag(HCI_LIMIT_COPPER, 0));
    for (size_t j = 0; j < b->coordinates; ++j) {
        double *row = hci_limit_row_add(b);
        if (row)
            row[j] = b->of->scale_A / limit_A *
                     sqrt(1.5 * hci_limit_copper_of(b->of->field.set->component[j / 2], (int)(j % 2)));
    }
    double *row = held ? hci_limit_row_add(b) : NULL;
    if (row) row[b->n] = sqrt(1.5) * hci_amplitude(held->sine, held->cosine) / limit_A;
    hci_limit_cone_end(b);
}

/* ---- distance ---- */

/* |x − centre| <= radius, of all but FIT, which has to have room. */
void hci_limit_add_trust(hci_limit_build *b)
{
    const hci_limit_program *p = b->of;
    if (!(p->radius_A > 0.0) || b->stage == HCI_STAGE_FIT) return;
    hci_limit_cone_begin(b);
    double *head = hci_limit_row_add(b);
    if (head) head[b->n] = 1.0;
    b->distance = b->rows;
    for (size_t j = 0; j < b->coordinates; ++j) {
        double *row = hci_limit_row_add(b);
        if (!row) return;
        row[j] = p->scale_A / p->radius_A;
        row[b->n] = p->centre[j] / p->radius_A;
    }
    hci_limit_cone_end(b);
}

/* ---- open phases ---- */

/* A phase that is open: every order of its current is 0. */
static void add_open(hci_limit_build *b, int phase)
{
    if (b->of->bounds->current_A[phase] > 0.0) return;
    for (size_t k = 0; k < b->of->field.set->count; ++k)
        for (int part = 0; begins_order(b, k) && part < 2; ++part) {
            const phase_part x = {b->of->field.set->component[k].order, phase, part, 1.0 / b->of->scale_A};
            if (x.order >= HCI_ORDER_TOLERANCE || part == 1) phase_row(b, &x, hci_limit_equation_add(b));
        }
}

void hci_limit_add_open(hci_limit_build *b)
{
    for (int phase = 0; phase < 3; ++phase)
        add_open(b, phase);
}
