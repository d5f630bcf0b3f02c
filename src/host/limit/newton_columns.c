/* In: where the method stands; out: the gradients of the constraints that act as columns, and the Hessian.
 * Peaks follow the currents, so that a limit bends over them. */
#include "host/limit/newton_columns.h"

#include <math.h>
#include <string.h>

#include "core/math/vector.h"
#include "hci/math/dense.h"
#include "host/base/memory.h"
#include "host/limit/newton_peaks.h"

enum {
    MOST_CLIMBS = 16, /* samples by which a peak is followed in one step */
};

#define BESIDE 0.1  /* of the spacing of samples: where slopes over the angle are taken */
#define PULL   1e-5 /* to the last currents where the copper is not what is minimised */

/* ---- rows of no angle ---- */

static const double *row_at(const hci_newton *w, size_t k)
{
    return w->build.row + k * w->build.width;
}

/* h − g·x */
static double room_of(const hci_newton *w, size_t k)
{
    const double *row = row_at(w, k);
    return row[w->n] - hci_vector_dot(w->n, row, w->x);
}

/* |u_1 …| − u_0 of a cone and its gradient g (n, out). u: h − G x. Returns the length |u_1 …| in *length. */
static double cone_at(const hci_newton *w, size_t head, size_t rows, double *length, double *g)
{
    double square = 0.0;
    memset(g, 0, w->n * sizeof *g);
    for (size_t k = 1; k < rows; ++k) {
        const double u = room_of(w, head + k);
        square += u * u;
        hci_vector_add(w->n, -u, row_at(w, head + k), g);
    }
    *length = sqrt(square);
    for (size_t j = 0; j < w->n && square > 0.0; ++j)
        g[j] /= *length;
    hci_vector_add(w->n, 1.0, row_at(w, head), g);
    return *length - room_of(w, head);
}

/* ---- what acts at first ---- */

/* Of a constraint and its multiplier, whose product the interior point has made small, the larger one stays,
 * as if its gradient g were of size 1. */
static double weight_of(const hci_newton *w, double weight, double beyond_by, const double *g)
{
    return weight * hci_vector_dot(w->n, g, g) < -beyond_by ? 0.0 : weight;
}

void hci_newton_drop_slack(hci_newton *w)
{
    const hci_limit_build *b = &w->build;
    double *g = w->around, length;
    for (size_t k = 0; k < w->peaks; ++k) {
        hci_newton_peak *p = &w->peak[k];
        const double size = hci_newton_size_at(w, p, p->at.theta_rad, g);
        p->weight = weight_of(w, p->weight, hci_newton_beyond(p, size), g);
    }
    for (size_t k = 0; k < b->linear; ++k)
        w->rest_weight[k] = weight_of(w, w->rest_weight[k], -room_of(w, k), row_at(w, k));
    for (size_t k = 0, at = b->linear; k < b->cones; at += b->cone[k++]) {
        const double beyond_by = cone_at(w, at, b->cone[k], &length, g);
        w->rest_weight[at] = weight_of(w, w->rest_weight[at], beyond_by, g);
    }
}

/* ---- peaks and how they bend ---- */

/* hessian += t·v vᵀ, lower triangle */
static void add_square(hci_newton *w, double t, const double *v)
{
    for (size_t j = 0; j < w->n; ++j)
        hci_vector_add(w->n - j, t * v[j], v + j, w->hessian + j * w->n + j);
}

/* The quantity of a peak beside its angle: rows at it and at h on both sides, and what they are of the limit.
 */
typedef struct {
    double h, *before, *middle, *after; /* n each */
    double slope, bend;                 /* of the size over the angle */
} flank;

static flank flank_of(hci_newton *w, const hci_newton_peak *p)
{
    flank f = {.h = BESIDE * p->grid->step_rad, .before = w->around};
    f.middle = f.before + w->n;
    f.after = f.middle + w->n;
    const double low = hci_newton_size_at(w, p, p->at.theta_rad - f.h, f.before),
                 high = hci_newton_size_at(w, p, p->at.theta_rad + f.h, f.after),
                 here = hci_newton_size_at(w, p, p->at.theta_rad, f.middle);
    f.slope = (high - low) / (2.0 * f.h);
    f.bend = (high - 2.0 * here + low) / (f.h * f.h);
    return f;
}

/* The peak to where it is at these currents, uphill in steps of a sample until its top is near. */
static flank climb(hci_newton *w, hci_newton_peak *p)
{
    const double most = p->grid->step_rad;
    flank f = flank_of(w, p);
    for (int k = 0; k < MOST_CLIMBS; ++k) {
        const double shift = f.bend < 0.0 ? -f.slope / f.bend : copysign(most, f.slope);
        if (f.bend < 0.0 && fabs(shift) <= most) break;
        p->at.theta_rad += copysign(most, f.slope);
        f = flank_of(w, p);
    }
    return f;
}

/* The peak to where it is at these currents; and how it bends over them, since its angle follows. */
static void follow_peak(hci_newton *w, hci_newton_peak *p)
{
    const flank f = climb(w, p);
    if (!(f.bend < 0.0)) {
        w->has_failed = w->has_failed || p->weight > 0.0;
        return;
    }
    const double most = p->grid->step_rad;
    p->at.theta_rad += fmax(-most, fmin(most, -f.slope / f.bend));
    if (!(p->weight > 0.0)) return;
    for (size_t j = 0; j < w->n; ++j)
        f.middle[j] = (f.after[j] - f.before[j]) / (2.0 * f.h);
    add_square(w, p->weight / -f.bend, f.middle);
}

/* ---- columns ---- */

/* A constraint becomes a column where it acts or is not kept. gradient: n, already in its place. */
static void add_column(hci_newton *w, size_t row, double beyond, double weight, bool is_equation)
{
    hci_newton_columns *a = &w->act;
    if (!is_equation && !(weight > 0.0) && !(beyond > 0.0)) return;
    a->row[a->count] = row;
    a->beyond[a->count] = beyond;
    a->weight[a->count] = weight;
    a->is_equation[a->count++] = is_equation;
}

static double *next_gradient(hci_newton *w)
{
    return w->act.gradient + w->act.count * w->n;
}

/* |v| bends by what is across v. */
static void add_across(hci_newton *w, const hci_newton_peak *p, double size)
{
    double v[2], across[2];
    hci_newton_rows_at(w, p, p->at.theta_rad, v);
    across[0] = -v[1] / size;
    across[1] = v[0] / size;
    hci_newton_combine(w, across, w->around);
    add_square(w, p->weight / size, w->around);
}

static void add_peak_column(hci_newton *w, size_t k)
{
    const hci_newton_peak *p = &w->peak[k];
    const double size = hci_newton_size_at(w, p, p->at.theta_rad, next_gradient(w));
    if (p->at.kind == HCI_POINT_VECTOR && p->weight > 0.0) add_across(w, p, size);
    add_column(w, k, hci_newton_beyond(p, size), p->weight, false);
}

static void add_linear_column(hci_newton *w, size_t k)
{
    memcpy(next_gradient(w), row_at(w, k), w->n * sizeof(double));
    add_column(w, w->peaks + k, -room_of(w, k), w->rest_weight[k], false);
}

/* A cone with its bend. */
static void add_cone_column(hci_newton *w, size_t head, size_t rows)
{
    const double weight = w->rest_weight[head];
    double *g = next_gradient(w), length;
    const double beyond_by = cone_at(w, head, rows, &length, g);
    if (!(length > 0.0)) return;
    for (size_t k = 1; k < rows && weight > 0.0; ++k)
        add_square(w, weight / length, row_at(w, head + k));
    hci_vector_add(w->n, -1.0, row_at(w, head), g);
    if (weight > 0.0) add_square(w, -weight / length, g);
    hci_vector_add(w->n, 1.0, row_at(w, head), g);
    add_column(w, w->peaks + head, beyond_by, weight, false);
}

static void add_equation_column(hci_newton *w, size_t k)
{
    const double *row = w->build.equal + k * w->build.width;
    memcpy(next_gradient(w), row, w->n * sizeof *row);
    add_column(w, w->peaks + w->build.rows + k, hci_vector_dot(w->n, row, w->x) - row[w->n], 0.0, true);
}

static void add_columns(hci_newton *w)
{
    const hci_limit_build *b = &w->build;
    w->act.count = 0;
    for (size_t k = 0; k < w->peaks; ++k)
        add_peak_column(w, k);
    for (size_t k = 0; k < b->linear; ++k)
        add_linear_column(w, k);
    for (size_t k = 0, at = b->linear; k < b->cones; at += b->cone[k++])
        add_cone_column(w, at, b->cone[k]);
    for (size_t k = 0; k < b->equalities; ++k)
        add_equation_column(w, k);
}

/* ---- all of it ---- */

/* Room for what depends on how many constraints there are. */
static hci_status reserve_columns(hci_newton *w)
{
    const size_t n = w->n, most = w->peaks + w->build.rows + w->build.equalities + 1;
    hci_newton_columns *a = &w->act;
    hci_memory_free(a->gradient);
    hci_memory_free(a->row);
    a->gradient = hci_memory_new(2 * n * most + 5 * most + most * most, sizeof *a->gradient);
    a->row = hci_memory_new(2 * most, sizeof *a->row + sizeof *a->is_equation);
    if (!a->gradient || !a->row) return HCI_ERROR_MEMORY;
    a->solved = a->gradient + n * most;
    a->beyond = a->solved + n * most;
    a->weight = a->beyond + most;
    w->few = a->weight + most;
    w->gram = w->few + 2 * most;
    w->kept = a->row + most;
    a->is_equation = (bool *)(w->kept + most);
    return HCI_OK;
}

/* H and ∇f without the limits: of the copper as they are. The mean and the ripple are not curved, and many
 * currents may have the same: of those it is to be one that is near. */
static void begin_hessian(hci_newton *w, double *f)
{
    const hci_limit_build *b = w->near;
    memset(w->hessian, 0, w->n * w->n * sizeof *w->hessian);
    for (size_t j = 0; j < w->n; ++j) {
        const bool is_copper = b->stage == HCI_STAGE_COPPER && j < w->coordinates;
        w->hessian[j * (w->n + 1)] = is_copper ? b->p[j * (w->n + 1)] : PULL;
        f[j] = b->c[j] + (is_copper ? b->p[j * (w->n + 1)] * w->x[j] : 0.0);
    }
}

hci_status hci_newton_linearise(hci_newton *w, double *f)
{
    begin_hessian(w, f);
    for (size_t k = 0; k < w->peaks; ++k)
        follow_peak(w, &w->peak[k]);
    if (reserve_columns(w)) return HCI_ERROR_MEMORY;
    add_columns(w);
    memcpy(w->factor, w->hessian, w->n * w->n * sizeof *w->factor);
    w->has_failed = w->has_failed || w->act.count > w->n || hci_cholesky_factor(w->n, w->factor);
    return HCI_OK;
}
