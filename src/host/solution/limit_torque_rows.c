/* Rows of the torque's orders: U x − h of theory.md, section 4. */
#include "host/solution/limit_rows.h"

#include <math.h>

/* Row k of U, times a factor and scaled, into a row of the program; returns h there. */
static double system_row(const hci_limit_build *b, size_t k, double factor, double *row)
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
void hci_limit_add_mean(hci_limit_build *b)
{
    const hci_limit_program *p = b->of;
    if (!has_mean_row(p->field.system)) return;
    for (int side = 0; side < 2; ++side) {
        const double sign = side == 0 ? 1.0 : -1.0;
        double *row = b->stage == HCI_STAGE_MEAN || (b->stage > HCI_STAGE_MEAN && !p->has_mean)
                          ? hci_limit_row_add(b)
                          : NULL;
        if (!row) return;
        row[b->n] = system_row(b, 0, sign / p->field.system->row_weight[0], row);
        if (b->stage == HCI_STAGE_MEAN)
            row[hci_limit_objective(b)] = -1.0;
        else
            row[b->n] += fabs(p->mean_Nm - p->field.mean_Nm) / p->scale_Nm +
                         HCI_LIMIT_SLACK * fmax(1.0, fabs(p->mean_Nm) / p->scale_Nm);
    }
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
        row[b->n] = p->ripple_Nm * (1.0 + p->slack) / p->scale_Nm + 0.1 * p->slack;
}

static void add_torque_row(hci_limit_build *b, size_t k)
{
    double *row = hci_limit_row_add(b);
    if (row) row[b->n] = system_row(b, k, 1.0, row);
}

/* One cone for each order (its largest error), or one for all of them (their root of the sum of squares). */
void hci_limit_add_torque_cones(hci_limit_build *b)
{
    const hci_harmonic_system *s = b->of->field.system;
    const size_t first = has_mean_row(s) ? 1 : 0;
    const bool is_rms = b->of->minimise == HCI_MINIMISE_RMS;
    if (b->stage < HCI_STAGE_RIPPLE || hci_limit_is_swing(b) || s->rows == first) return;
    if (b->stage == HCI_STAGE_COPPER && b->of->has_ripple) return;
    for (size_t k = first; k < s->rows; ++k) {
        if (k == first || (!is_rms && (k - first) % 2 == 0)) {
            hci_limit_cone_add(b, is_rms ? 1 + s->rows - first : 3);
            add_torque_head(b);
        }
        add_torque_row(b, k);
    }
}

/* highest − lowest <= t, or the swing that is to be kept. */
void hci_limit_add_swing(hci_limit_build *b)
{
    const hci_limit_program *p = b->of;
    double *row = hci_limit_is_swing(b) && b->stage >= HCI_STAGE_RIPPLE ? hci_limit_row_add(b) : NULL;
    if (!row) return;
    row[hci_limit_objective(b) + 1] = 1.0;
    row[hci_limit_objective(b) + 2] = -1.0;
    if (b->stage == HCI_STAGE_RIPPLE)
        row[hci_limit_objective(b)] = -1.0;
    else
        row[b->n] = p->ripple_Nm * (1.0 + p->slack) / p->scale_Nm + 0.1 * p->slack;
}

/* The mean where the wanted one is reached, and every order where no ripple is left. */
void hci_limit_add_orders(hci_limit_build *b)
{
    const hci_limit_program *p = b->of;
    const hci_harmonic_system *s = p->field.system;
    const bool all = b->stage == HCI_STAGE_COPPER && p->has_ripple;
    if (b->stage < HCI_STAGE_RIPPLE) return;
    for (size_t k = 0; k < s->rows; ++k) {
        const bool is_mean = k == 0 && has_mean_row(s);
        if (is_mean ? !p->has_mean : !all) continue;
        double *row = hci_limit_equation_add(b);
        row[b->n] = system_row(b, k, 1.0 / s->row_weight[k], row);
    }
}
