#include "host/limit/newton_peaks.h"

#include <math.h>
#include <string.h>

#include "core/math/vector.h"
#include "host/base/memory.h"

#define APART 16.0 /* samples within which a row of the program is that of a peak */

bool hci_newton_is_torque(const hci_newton_peak *p)
{
    return p->at.kind == HCI_POINT_TORQUE;
}

static double limit_of(const hci_newton *w, const hci_limit_grid *g)
{
    const hci_limit_program *p = w->near->of;
    if (g->kind == HCI_POINT_TORQUE) return p->scale_Nm;
    return hci_limit_of_point(p->bounds, g->kind, g->phase) * (1.0 + p->widened);
}

/* The unknown that a torque has to stay below, or above. */
static size_t end_of(const hci_newton *w, const hci_newton_peak *p)
{
    return hci_limit_objective(w->near) + 1 + (size_t)p->at.phase;
}

void hci_newton_rows_at(const hci_newton *w, const hci_newton_peak *p, double theta_rad, double v[2])
{
    const hci_limit_point at = {p->at.kind, p->at.phase, theta_rad, 0.0};
    const double limit = limit_of(w, p->grid), scale = w->near->of->scale_A / limit;
    double *row = w->row;
    hci_limit_rows(&w->program.field, &at, row);
    v[1] = 0.0;
    for (size_t k = 0; k < hci_limit_parts(at.kind); ++k, row += w->coordinates + 1) {
        for (size_t j = 0; j < w->coordinates; ++j)
            row[j] *= scale;
        v[k] = row[w->coordinates] / limit + hci_vector_dot(w->coordinates, row, w->x);
    }
}

void hci_newton_combine(const hci_newton *w, const double one[2], double *out)
{
    const double *second = w->row + w->coordinates + 1;
    memset(out, 0, w->n * sizeof *out);
    hci_vector_add(w->coordinates, one[0], w->row, out);
    if (one[1] != 0.0) hci_vector_add(w->coordinates, one[1], second, out);
}

double hci_newton_size_at(hci_newton *w, const hci_newton_peak *p, double theta_rad, double *g)
{
    const double sign = p->at.phase == 0 ? 1.0 : -1.0;
    double v[2], one[2] = {sign, 0.0};
    hci_newton_rows_at(w, p, theta_rad, v);
    const double size = hypot(v[0], v[1]);
    for (int k = 0; k < 2 && !hci_newton_is_torque(p); ++k)
        one[k] = size > 0.0 ? v[k] / size : 0.0;
    hci_newton_combine(w, one, g);
    if (!hci_newton_is_torque(p)) return size;
    g[end_of(w, p)] = -sign;
    return sign * (v[0] - w->x[end_of(w, p)]);
}

double hci_newton_beyond(const hci_newton_peak *p, double size)
{
    return hci_newton_is_torque(p) ? size : size - (1.0 - 2.0 * HCI_LIMIT_MARGIN);
}

/* Samples between two angles of a grid's quantity, which repeats. */
static double samples_apart(const hci_limit_grid *g, double a_rad, double b_rad)
{
    return fabs(remainder(a_rad - b_rad, g->period_rad)) / g->step_rad;
}

hci_newton_peak *hci_newton_peak_of(hci_newton *w, const hci_limit_point *at)
{
    hci_newton_peak *nearest = NULL;
    double least = APART;
    for (size_t k = 0; k < w->peaks; ++k) {
        hci_newton_peak *p = &w->peak[k];
        if (p->at.kind != at->kind || p->at.phase != at->phase) continue;
        const double apart = samples_apart(p->grid, p->at.theta_rad, at->theta_rad);
        if (apart >= least) continue;
        least = apart;
        nearest = p;
    }
    return nearest;
}

void hci_newton_range_of(const hci_newton *w, const hci_limit_grid *g, double share, double range[2])
{
    const double limit = limit_of(w, g), *end = w->x + hci_limit_objective(w->near) + 1;
    range[1] = limit * (1.0 - share);
    range[0] = -range[1];
    if (g->kind != HCI_POINT_TORQUE) return;
    range[1] = limit * (end[0] - share * (end[0] - end[1]));
    range[0] = limit * (end[1] + share * (end[0] - end[1]));
}

bool hci_newton_is_asked(const hci_newton *w, const hci_limit_grid *g)
{
    const hci_limit_build *b = w->near;
    return g->kind != HCI_POINT_TORQUE || b->stage == HCI_STAGE_RIPPLE ||
           (b->stage == HCI_STAGE_COPPER && !b->of->has_ripple);
}

hci_status hci_newton_peaks_beyond(hci_newton *w, const hci_limit_grid *g, const double range[2],
                                   hci_limit_points *found)
{
    double *x = w->around, worst;
    for (size_t j = 0; j < w->coordinates; ++j)
        x[j] = w->near->of->scale_A * w->x[j];
    return hci_limit_peaks(&w->program.field, g, x, range, found, &worst);
}

/* A peak that was found, of the torque at the end that it is next to. */
static hci_newton_peak make_peak(const hci_newton *w, const hci_limit_grid *g, const hci_limit_point *at,
                                 const double range[2])
{
    hci_newton_peak p = {*at, g, 0.0};
    double v[2];
    if (!hci_newton_is_torque(&p)) return p;
    hci_newton_rows_at(w, &p, at->theta_rad, v);
    p.at.phase = limit_of(w, g) * v[0] < 0.5 * (range[0] + range[1]) ? 1 : 0;
    return p;
}

/* Adds the peaks of one grid that are beyond its limit but for a share and not known yet; *added: how many.
 */
static hci_status search_grid(hci_newton *w, const hci_limit_grid *g, double share, size_t *added)
{
    hci_limit_points found = {0};
    double range[2];
    hci_newton_range_of(w, g, share, range);
    hci_status status = hci_newton_peaks_beyond(w, g, range, &found);
    hci_newton_peak *more = status ? NULL : hci_memory_resize(w->peak, w->peaks + found.count, sizeof *more);
    if (more) w->peak = more;
    if (!more) status = HCI_ERROR_MEMORY;
    for (size_t k = 0; k < found.count && !status; ++k) {
        const hci_newton_peak p = make_peak(w, g, &found.point[k], range),
                              *known = hci_newton_peak_of(w, &p.at);
        if (known && samples_apart(g, known->at.theta_rad, p.at.theta_rad) < 1.0) continue;
        w->peak[w->peaks++] = p;
        ++*added;
    }
    hci_limit_points_release(&found);
    return status;
}

hci_status hci_newton_search(hci_newton *w, double share, size_t *added)
{
    const hci_limit_program *p = w->near->of;
    hci_status status = HCI_OK;
    *added = 0;
    for (size_t q = 0; q < p->grids && !status; ++q)
        if (hci_newton_is_asked(w, &p->grid[q])) status = search_grid(w, &p->grid[q], share, added);
    return status;
}
