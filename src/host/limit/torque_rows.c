/* Rows of the torque's orders: U x − h of theory.md, section 4. */
#include "host/limit/rows.h"

#include <math.h>

/* The first entry of column j of U that is in row k or behind it; rows ascend within a column. */
static int64_t entry_from(const hci_harmonic_system *s, size_t j, size_t k)
{
    int64_t low = s->u.column_start[j], high = s->u.column_start[j + 1];
    while (low < high) {
        const int64_t middle = low + (high - low) / 2;
        if ((size_t)s->u.row[middle] < k)
            low = middle + 1;
        else
            high = middle;
    }
    return low;
}

/* Row k of U, times a factor and scaled, into a row of the program; returns h there. */
static double system_row(const hci_limit_build *b, size_t k, double factor, double *row)
{
    const hci_harmonic_system *s = b->of->field.system;
    const double scale = factor * b->of->scale_A / b->of->scale_Nm;
    for (size_t j = 0; j < s->unknowns; ++j) {
        const int64_t e = entry_from(s, j, k);
        if (e < s->u.column_start[j + 1] && (size_t)s->u.row[e] == k) row[j] = scale * s->u.value[e];
    }
    return factor * (b->of->field.mean_Nm * s->h[k] + s->h[s->rows + k]) / b->of->scale_Nm;
}

static bool has_mean_row(const hci_harmonic_system *s)
{
    return s->order_count > 0 && s->order[0] < HCI_ORDER_TOLERANCE;
}

/* Whether any component reaches rows k … k + rows − 1. The error of an order that none does is the same for
 * all currents, and must not hide the others behind it. */
static bool is_reached(const hci_harmonic_system *s, size_t k, size_t rows)
{
    for (size_t j = 0; j < s->unknowns; ++j) {
        const int64_t e = entry_from(s, j, k);
        if (e < s->u.column_start[j + 1] && (size_t)s->u.row[e] < k + rows) return true;
    }
    return false;
}

/* |mean − wanted| <= t; 0 <= t where the mean is not compared. */
static void add_nearest_mean(hci_limit_build *b)
{
    const hci_harmonic_system *s = b->of->field.system;
    const bool is_compared = has_mean_row(s);
    for (int side = 0; side < (is_compared ? 2 : 1); ++side) {
        double *row = hci_limit_row_add(b);
        if (!row) return;
        if (is_compared) row[b->n] = system_row(b, 0, (side == 0 ? 1.0 : -1.0) / s->row_weight[0], row);
        row[hci_limit_objective(b)] = -1.0;
    }
}

/* The nearest mean, or a little less. */
static void add_reached_mean(hci_limit_build *b)
{
    const hci_limit_program *p = b->of;
    const double missed_Nm = fabs(p->mean_Nm - p->field.mean_Nm),
                 room_Nm = HCI_LIMIT_SLACK * fmax(p->scale_Nm, fabs(p->mean_Nm));
    for (int side = 0; side < 2; ++side) {
        double *row = hci_limit_row_add(b);
        if (!row) return;
        row[b->n] = system_row(b, 0, (side == 0 ? 1.0 : -1.0) / p->field.system->row_weight[0], row);
        row[b->n] += (missed_Nm + room_Nm) / p->scale_Nm;
    }
}

void hci_limit_add_mean(hci_limit_build *b)
{
    if (b->stage == HCI_STAGE_MEAN)
        add_nearest_mean(b);
    else if (b->stage > HCI_STAGE_MEAN && !b->of->has_mean && has_mean_row(b->of->field.system))
        add_reached_mean(b);
}

/* The head of a cone of torque: t, or the ripple that is to be kept. */
static void add_torque_head(hci_limit_build *b)
{
    const hci_limit_program *p = b->of;
    double *row = hci_limit_row_add(b);
    if (!row) return;
    if (b->stage == HCI_STAGE_RIPPLE)
        row[hci_limit_objective(b)] = -1.0;
    else
        row[b->n] = p->ripple_Nm / p->scale_Nm + p->slack;
}

static void add_torque_row(hci_limit_build *b, size_t k)
{
    double *row = hci_limit_row_add(b);
    if (row) row[b->n] = system_row(b, k, 1.0, row);
}

/* Whether the torque of the cone added last, whatever the currents within the distance from the centre, stays
 * below what an order is to exceed that counts. */
static bool is_idle(const hci_limit_build *b, size_t head)
{
    const hci_limit_program *p = b->of;
    double square = 0.0, steepest = 0.0;
    if (!(p->idle_Nm > 0.0) || b->stage != HCI_STAGE_RIPPLE || b->is_full) return false;
    for (size_t k = head + 1; k < b->rows; ++k) {
        const double *row = b->row + k * b->width;
        double error = -row[b->n];
        for (size_t j = 0; j < b->coordinates; ++j) {
            error += row[j] * p->centre[j] / p->scale_A;
            steepest += row[j] * row[j];
        }
        square += error * error;
    }
    return sqrt(square) + sqrt(steepest) * p->radius_A / p->scale_A < p->idle_Nm / p->scale_Nm;
}

/* The cone of one order, unless it is idle. first: whether it is the first, which is kept. */
static void add_order(hci_limit_build *b, size_t k, bool first)
{
    const size_t head = b->rows;
    hci_limit_cone_begin(b);
    add_torque_head(b);
    add_torque_row(b, k);
    add_torque_row(b, k + 1);
    hci_limit_cone_end(b);
    if (first || !is_idle(b, head)) return;
    b->rows = head;
    --b->cones;
}

static bool is_order_reached(const hci_limit_build *b, size_t k)
{
    return is_reached(b->of->field.system, k, 2);
}

/* One cone of all orders. */
static void add_all_orders(hci_limit_build *b)
{
    const hci_harmonic_system *s = b->of->field.system;
    const size_t before = b->cones;
    for (size_t k = has_mean_row(s) ? 1 : 0; k < s->rows; k += 2) {
        if (!is_order_reached(b, k)) continue;
        if (b->cones == before) {
            hci_limit_cone_begin(b);
            add_torque_head(b);
        }
        add_torque_row(b, k);
        add_torque_row(b, k + 1);
    }
    if (b->cones > before) hci_limit_cone_end(b);
}

/* One cone for each order (its largest error), or one for all of them (their root of the sum of squares). */
void hci_limit_add_torque_cones(hci_limit_build *b)
{
    const hci_harmonic_system *s = b->of->field.system;
    bool first = true;
    if (b->stage < HCI_STAGE_RIPPLE || hci_limit_is_swing(b)) return;
    if (b->stage == HCI_STAGE_COPPER && b->of->has_ripple) return;
    if (b->of->minimise == HCI_MINIMISE_RMS) add_all_orders(b);
    for (size_t k = has_mean_row(s) ? 1 : 0; k < s->rows && b->of->minimise == HCI_MINIMISE_WORST; k += 2) {
        if (!is_order_reached(b, k)) continue;
        add_order(b, k, first);
        first = false;
    }
}

/* 0 <= t, where no order is reached that would bound it. */
static void add_no_ripple(hci_limit_build *b)
{
    const hci_harmonic_system *s = b->of->field.system;
    const size_t first = has_mean_row(s) ? 1 : 0;
    if (b->stage != HCI_STAGE_RIPPLE || is_reached(s, first, s->rows - first)) return;
    double *row = hci_limit_row_add(b);
    if (row) row[hci_limit_objective(b)] = -1.0;
}

/* highest − lowest <= t, or the swing that is to be kept. */
void hci_limit_add_swing(hci_limit_build *b)
{
    const hci_limit_program *p = b->of;
    double *row;
    if (!hci_limit_is_swing(b)) add_no_ripple(b);
    row = hci_limit_is_swing(b) && b->stage >= HCI_STAGE_RIPPLE ? hci_limit_row_add(b) : NULL;
    if (!row) return;
    row[hci_limit_objective(b) + 1] = 1.0;
    row[hci_limit_objective(b) + 2] = -1.0;
    if (b->stage == HCI_STAGE_RIPPLE)
        row[hci_limit_objective(b)] = -1.0;
    else
        row[b->n] = p->ripple_Nm / p->scale_Nm + p->slack;
}

static void add_equation(hci_limit_build *b, size_t k)
{
    double *row = hci_limit_equation_add(b);
    row[b->n] = system_row(b, k, 1.0 / b->of->field.system->row_weight[k], row);
}

/* The mean where the wanted one is reached, and every order where no ripple is left. */
void hci_limit_add_orders(hci_limit_build *b)
{
    const hci_limit_program *p = b->of;
    const hci_harmonic_system *s = p->field.system;
    const size_t first = has_mean_row(s) ? 1 : 0;
    if (b->stage >= HCI_STAGE_RIPPLE && first == 1 && p->has_mean) add_equation(b, 0);
    if (b->stage < HCI_STAGE_COPPER || !p->has_ripple) return;
    for (size_t k = first; k < s->rows; k += 2) {
        if (!is_order_reached(b, k)) continue;
        add_equation(b, k);
        add_equation(b, k + 1);
    }
}
