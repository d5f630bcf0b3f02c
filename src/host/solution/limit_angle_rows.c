/* Rows of currents, voltages and torque at angles: where a grid has a row, and of the points beside the
 * grids. */
#include "host/solution/limit_rows.h"

/* What a quantity is limited to, but for the share that is kept free. */
static double limit_of(const hci_limit_program *p, const hci_limit_point *at)
{
    return hci_limit_of_point(p->bounds, at->kind, at->phase) * (1.0 + p->widened) *
           (1.0 - 2.0 * HCI_LIMIT_MARGIN);
}

/* |g·x + constant| <= limit: one two-sided row, or two rows with the share by which limits are widened. */
static void add_point(hci_limit_build *b, const hci_limit_point *at, const double *g, double constant)
{
    const double limit = limit_of(b->of, at), scale = b->of->scale_A / limit;
    const int sides = b->stage == HCI_STAGE_FIT ? 2 : 1;
    for (int side = 0; side < sides; ++side) {
        double *row = hci_limit_row_add(b);
        const double sign = side == 0 ? 1.0 : -1.0;
        if (!row) return;
        for (size_t j = 0; j < b->coordinates; ++j)
            row[j] = sign * scale * g[j];
        row[b->n] = 1.0 - sign * constant / limit;
        b->low[b->rows - 1] = -1.0 - constant / limit;
        if (sides == 2) row[hci_limit_objective(b)] = -1.0;
        b->limit_of[b->rows - 1] =
            hci_limit_tag(at->kind == HCI_POINT_VOLTAGE ? HCI_LIMIT_VOLTAGE : HCI_LIMIT_CURRENT, at->phase);
    }
}

/* Torque less wanted torque is at most the highest and at least the lowest. */
static void add_torque_point(hci_limit_build *b, const double *g, double constant_Nm)
{
    for (int side = 0; side < 2; ++side) {
        double *row = hci_limit_row_add(b);
        const double sign = (side == 0 ? 1.0 : -1.0) / b->of->scale_Nm;
        if (!row) return;
        for (size_t j = 0; j < b->coordinates; ++j)
            row[j] = sign * b->of->scale_A * g[j];
        row[b->n] = -sign * constant_Nm;
        row[hci_limit_objective(b) + 1 + (size_t)side] = side == 0 ? -1.0 : 1.0;
    }
}

static void add_any_point(hci_limit_build *b, const hci_limit_point *at, const double *g, double constant)
{
    if (at->kind == HCI_POINT_TORQUE)
        add_torque_point(b, g, constant);
    else
        add_point(b, at, g, constant);
}

static void add_grid(hci_limit_build *b, const hci_limit_grid *grid)
{
    const hci_limit_point at = {grid->kind, grid->phase, 0.0};
    for (size_t k = 0; k < grid->samples; ++k)
        if (grid->is_row[k]) add_any_point(b, &at, grid->g + k * grid->unknowns, grid->constant[k]);
}

/* Those of the torque, or of all that is limited. */
static void add_angles(hci_limit_build *b, bool is_torque)
{
    const hci_limit_program *p = b->of;
    for (size_t q = 0; q < p->grids; ++q)
        if ((p->grid[q].kind == HCI_POINT_TORQUE) == is_torque) add_grid(b, &p->grid[q]);
    for (size_t k = 0; k < p->points.rows; ++k) {
        const hci_limit_point *at = &p->points.point[k];
        const double *g = hci_limit_points_row(&p->points, k);
        if ((at->kind == HCI_POINT_TORQUE) == is_torque) add_any_point(b, at, g, g[b->coordinates]);
    }
}

void hci_limit_add_angles(hci_limit_build *b)
{
    add_angles(b, false);
}

void hci_limit_add_torque_angles(hci_limit_build *b)
{
    if (hci_limit_is_swing(b) && b->stage >= HCI_STAGE_RIPPLE) add_angles(b, true);
}
