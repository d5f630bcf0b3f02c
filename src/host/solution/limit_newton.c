/* In: a program and its answer by interior points; out: its optimum with the limits at every angle. The peak
 * of each limit that acts moves with the currents, so that a few steps of Newton's method do what many
 * programs with more and more angles would. */
#include "host/solution/limit_newton.h"

#include <math.h>
#include <string.h>

#include "core/math/vector.h"
#include "hci/math/dense.h"
#include "host/base/memory.h"
#include "host/solution/limit_stage.h"

enum {
    MOST_SEARCHES = 12, /* of peaks that were not known */
    MOST_STEPS = 20,    /* between two searches */
    MOST_CLIMBS = 16,   /* samples by which a peak is followed in one step */
    REFINEMENTS = 2,
    MOST_SETS = 30 /* of constraints that act, in one step */
};

#define CLOSE   1e-3 /* share below a limit within which a peak is looked at */
#define BESIDE  0.1  /* of the spacing of samples: where slopes over the angle are taken */
#define APART   16.0 /* samples within which a row of the program is that of a peak */
#define ARRIVED 1e-9 /* step as a share of the currents with which it is there */
#define RESTING 1e-7 /* the same after all steps, which peaks that merge make slow: limits miss its square   \
                      */
#define MISSED  1e-7 /* share of the torque by which it may be beyond its range between the angles */
#define PULL    1e-5 /* to the last currents where the copper is not what is minimised */
#define LONGEST 0.3  /* the same, with which it was not near enough */

/* The top of a quantity next to its limit. */
typedef struct {
    hci_limit_point at;
    const hci_limit_grid *grid;
    double weight; /* multiplier, not negative */
} peak;

/* Constraints that act as columns: gradient, what the constraint is beyond 0, multiplier. */
typedef struct {
    double *gradient, *solved; /* n each: ∇c, H⁻¹∇c */
    double *beyond, *weight;
    bool *is_equation;
    size_t *row; /* of a peak its number; behind the peaks in the build; of an equation behind its rows */
    size_t count;
} columns;

typedef struct {
    const hci_limit_build *near;
    hci_limit_program program; /* without grids and points */
    hci_limit_build build;     /* its rows, which are those of no angle */
    size_t n, coordinates;
    peak *peak;
    size_t peaks;
    double *block, *x, *rest_weight, *hessian, *factor, *slope, *around, *row;
    columns act;
    double *gram, *few; /* few: 3·most */
    size_t *kept, keeps;
    double moved;
    bool has_failed;
} newton;

/* ---- peaks ---- */

static bool is_torque(const peak *p)
{
    return p->at.kind == HCI_POINT_TORQUE;
}

static double limit_of(const newton *w, const hci_limit_grid *g)
{
    const hci_limit_program *p = w->near->of;
    if (g->kind == HCI_POINT_TORQUE) return p->scale_Nm;
    return hci_limit_of_point(p->bounds, g->kind, g->phase) * (1.0 + p->widened);
}

/* The unknown that a torque has to stay below, or above. */
static size_t end_of(const newton *w, const peak *p)
{
    return hci_limit_objective(w->near) + 1 + (size_t)p->at.phase;
}

/* The rows of a peak's quantity, as shares of the limit, with the currents as they are: in w->row and v. */
static void rows_at(const newton *w, const peak *p, double theta_rad, double v[2])
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

/* out = one[0]·row of the first part + one[1]·row of the second. out: n. */
static void combine(const newton *w, const double one[2], double *out)
{
    const double *second = w->row + w->coordinates + 1;
    memset(out, 0, w->n * sizeof *out);
    hci_vector_add(w->coordinates, one[0], w->row, out);
    if (one[1] != 0.0) hci_vector_add(w->coordinates, one[1], second, out);
}

/* The size of a quantity as a share of its limit, of a torque what it is beyond its end of the range; g: out,
 * its gradient. The rows are left in w->row. */
static double size_at(newton *w, const peak *p, double theta_rad, double *g)
{
    const double sign = p->at.phase == 0 ? 1.0 : -1.0;
    double v[2], one[2] = {sign, 0.0};
    rows_at(w, p, theta_rad, v);
    const double size = hypot(v[0], v[1]);
    for (int k = 0; k < 2 && !is_torque(p); ++k)
        one[k] = size > 0.0 ? v[k] / size : 0.0;
    combine(w, one, g);
    if (!is_torque(p)) return size;
    g[end_of(w, p)] = -sign;
    return sign * (v[0] - w->x[end_of(w, p)]);
}

/* How far a size is beyond what is kept. */
static double beyond(const peak *p, double size)
{
    return is_torque(p) ? size : size - (1.0 - 2.0 * HCI_LIMIT_MARGIN);
}

/* Samples between two angles of a grid's quantity, which repeats. */
static double samples_apart(const hci_limit_grid *g, double a_rad, double b_rad)
{
    return fabs(remainder(a_rad - b_rad, g->period_rad)) / g->step_rad;
}

/* The peak that is nearest to a point of the program, or NULL. */
static peak *peak_of(newton *w, const hci_limit_point *at)
{
    peak *nearest = NULL;
    double least = APART;
    for (size_t k = 0; k < w->peaks; ++k) {
        peak *p = &w->peak[k];
        if (p->at.kind != at->kind || p->at.phase != at->phase) continue;
        const double apart = samples_apart(p->grid, p->at.theta_rad, at->theta_rad);
        if (apart >= least) continue;
        least = apart;
        nearest = p;
    }
    return nearest;
}

/* Between what a quantity has to stay, but for a share: of the limit, of the torque's range. */
static void range_of(const newton *w, const hci_limit_grid *g, double share, double range[2])
{
    const double limit = limit_of(w, g), *end = w->x + hci_limit_objective(w->near) + 1;
    range[1] = limit * (1.0 - share);
    range[0] = -range[1];
    if (g->kind != HCI_POINT_TORQUE) return;
    range[1] = limit * (end[0] - share * (end[0] - end[1]));
    range[0] = limit * (end[1] + share * (end[0] - end[1]));
}

/* Whether this stage asks for a grid's quantity. */
static bool is_asked(const newton *w, const hci_limit_grid *g)
{
    const hci_limit_build *b = w->near;
    return g->kind != HCI_POINT_TORQUE || b->stage == HCI_STAGE_RIPPLE ||
           (b->stage == HCI_STAGE_COPPER && !b->of->has_ripple);
}

/* The peaks of a grid that are beyond a range; to be released. */
static hci_status peaks_beyond(newton *w, const hci_limit_grid *g, const double range[2],
                               hci_limit_points *found)
{
    double *x = w->around, worst;
    for (size_t j = 0; j < w->coordinates; ++j)
        x[j] = w->near->of->scale_A * w->x[j];
    return hci_limit_peaks(&w->program.field, g, x, range, found, &worst);
}

/* A peak that was found, of the torque at the end that it is next to. */
static peak make_peak(const newton *w, const hci_limit_grid *g, const hci_limit_point *at,
                      const double range[2])
{
    peak p = {*at, g, 0.0};
    double v[2];
    if (!is_torque(&p)) return p;
    rows_at(w, &p, at->theta_rad, v);
    p.at.phase = limit_of(w, g) * v[0] < 0.5 * (range[0] + range[1]) ? 1 : 0;
    return p;
}

/* Adds the peaks of one grid that are beyond its limit but for a share and not known yet; *added: how many.
 */
static hci_status search_grid(newton *w, const hci_limit_grid *g, double share, size_t *added)
{
    hci_limit_points found = {NULL};
    double range[2];
    range_of(w, g, share, range);
    hci_status status = peaks_beyond(w, g, range, &found);
    peak *more = status ? NULL : hci_memory_resize(w->peak, w->peaks + found.count, sizeof *more);
    if (more) w->peak = more;
    if (!more) status = HCI_ERROR_MEMORY;
    for (size_t k = 0; k < found.count && !status; ++k) {
        const peak p = make_peak(w, g, &found.point[k], range), *known = peak_of(w, &p.at);
        if (known && samples_apart(g, known->at.theta_rad, p.at.theta_rad) < 1.0) continue;
        w->peak[w->peaks++] = p;
        ++*added;
    }
    hci_limit_points_release(&found);
    return status;
}

static hci_status search(newton *w, double share, size_t *added)
{
    const hci_limit_program *p = w->near->of;
    hci_status status = HCI_OK;
    *added = 0;
    for (size_t q = 0; q < p->grids && !status; ++q)
        if (is_asked(w, &p->grid[q])) status = search_grid(w, &p->grid[q], share, added);
    return status;
}

/* ---- what acts at first ---- */

static const double *row_at(const newton *w, size_t k)
{
    return w->build.row + k * w->build.width;
}

/* h − g·x */
static double room_of(const newton *w, size_t k)
{
    const double *row = row_at(w, k);
    return row[w->n] - hci_vector_dot(w->n, row, w->x);
}

/* |u_1 …| − u_0 of a cone and its gradient g (n, out). u: h − G x. Returns the length |u_1 …| in *length. */
static double cone_at(const newton *w, size_t head, size_t rows, double *length, double *g)
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

/* Of a constraint and its multiplier, whose product the interior point has made small, the larger one stays,
 * as if its gradient g were of size 1. */
static double weight_of(const newton *w, double weight, double beyond_by, const double *g)
{
    return weight * hci_vector_dot(w->n, g, g) < -beyond_by ? 0.0 : weight;
}

static void drop_slack(newton *w)
{
    const hci_limit_build *b = &w->build;
    double *g = w->around, length;
    for (size_t k = 0; k < w->peaks; ++k) {
        peak *p = &w->peak[k];
        const double size = size_at(w, p, p->at.theta_rad, g);
        p->weight = weight_of(w, p->weight, beyond(p, size), g);
    }
    for (size_t k = 0; k < b->linear; ++k)
        w->rest_weight[k] = weight_of(w, w->rest_weight[k], -room_of(w, k), row_at(w, k));
    for (size_t k = 0, at = b->linear; k < b->cones; at += b->cone[k++]) {
        const double beyond_by = cone_at(w, at, b->cone[k], &length, g);
        w->rest_weight[at] = weight_of(w, w->rest_weight[at], beyond_by, g);
    }
}

/* Whether a row has the multiplier of an angle's quantity: of a vector the head of its cone has. */
static bool is_of_angle(const hci_limit_build *b, size_t k)
{
    return b->at[k].kind != HCI_POINT_NONE && (b->at[k].kind != HCI_POINT_VECTOR || b->limit_of[k] != 0);
}

/* Multipliers of the interior point to the peaks that are next to their rows, and to the rows of no angle. */
static void begin_weights(newton *w, const double *z)
{
    const hci_limit_build *b = w->near;
    size_t rest = 0;
    for (size_t k = 0; k < b->rows; ++k) {
        peak *p = is_of_angle(b, k) ? peak_of(w, &b->at[k]) : NULL;
        if (p) p->weight += fabs(z[k]);
        if (b->at[k].kind == HCI_POINT_NONE) w->rest_weight[rest++] = z[k];
    }
}

/* ---- one step ---- */

/* hessian += t·v vᵀ, lower triangle */
static void add_square(newton *w, double t, const double *v)
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

static flank flank_of(newton *w, const peak *p)
{
    flank f = {.h = BESIDE * p->grid->step_rad, .before = w->around};
    f.middle = f.before + w->n;
    f.after = f.middle + w->n;
    const double low = size_at(w, p, p->at.theta_rad - f.h, f.before),
                 high = size_at(w, p, p->at.theta_rad + f.h, f.after),
                 here = size_at(w, p, p->at.theta_rad, f.middle);
    f.slope = (high - low) / (2.0 * f.h);
    f.bend = (high - 2.0 * here + low) / (f.h * f.h);
    return f;
}

/* The peak to where it is at these currents, uphill in steps of a sample until its top is near. */
static flank climb(newton *w, peak *p)
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
static void follow_peak(newton *w, peak *p)
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

/* A constraint becomes a column where it acts or is not kept. gradient: n, already in its place. */
static void add_column(newton *w, size_t row, double beyond, double weight, bool is_equation)
{
    columns *a = &w->act;
    if (!is_equation && !(weight > 0.0) && !(beyond > 0.0)) return;
    a->row[a->count] = row;
    a->beyond[a->count] = beyond;
    a->weight[a->count] = weight;
    a->is_equation[a->count++] = is_equation;
}

static double *next_gradient(newton *w)
{
    return w->act.gradient + w->act.count * w->n;
}

/* |v| bends by what is across v. */
static void add_across(newton *w, const peak *p, double size)
{
    double v[2], across[2];
    rows_at(w, p, p->at.theta_rad, v);
    across[0] = -v[1] / size;
    across[1] = v[0] / size;
    combine(w, across, w->around);
    add_square(w, p->weight / size, w->around);
}

static void add_peak_column(newton *w, size_t k)
{
    const peak *p = &w->peak[k];
    const double size = size_at(w, p, p->at.theta_rad, next_gradient(w));
    if (p->at.kind == HCI_POINT_VECTOR && p->weight > 0.0) add_across(w, p, size);
    add_column(w, k, beyond(p, size), p->weight, false);
}

static void add_linear_column(newton *w, size_t k)
{
    memcpy(next_gradient(w), row_at(w, k), w->n * sizeof(double));
    add_column(w, w->peaks + k, -room_of(w, k), w->rest_weight[k], false);
}

/* A cone with its bend. */
static void add_cone_column(newton *w, size_t head, size_t rows)
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

static void add_equation_column(newton *w, size_t k)
{
    const double *row = w->build.equal + k * w->build.width;
    memcpy(next_gradient(w), row, w->n * sizeof *row);
    add_column(w, w->peaks + w->build.rows + k, hci_vector_dot(w->n, row, w->x) - row[w->n], 0.0, true);
}

static void add_columns(newton *w)
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

/* Multipliers of the columns that are kept: ∇cᵀH⁻¹∇c λ = c − ∇cᵀH⁻¹∇f. few: ∇cᵀH⁻¹∇f of every column. */
static bool solve_kept(newton *w, size_t count, double *weight)
{
    const columns *a = &w->act;
    for (size_t q = 0; q < count; ++q) {
        const double *g = a->gradient + w->kept[q] * w->n;
        weight[q] = a->beyond[w->kept[q]] - w->few[w->kept[q]];
        for (size_t p = q; p < count; ++p)
            w->gram[p + q * count] = hci_vector_dot(w->n, a->solved + w->kept[p] * w->n, g);
    }
    if (hci_cholesky_factor(count, w->gram)) return false;
    hci_cholesky_solve(count, w->gram, weight);
    return true;
}

/* Leaves out constraints that would pull, until none does; weights of the columns are then those of this
 * step. */
static bool choose_columns(newton *w)
{
    columns *a = &w->act;
    double *weight = w->few + a->count;
    size_t count = a->count, left = 0;
    for (size_t q = 0; q < count; ++q)
        w->kept[q] = q;
    for (int k = 0; k < MOST_SETS; ++k, count = left) {
        if (!solve_kept(w, count, weight)) return false;
        left = 0;
        for (size_t q = 0; q < count; ++q)
            if (a->is_equation[w->kept[q]] || weight[q] >= 0.0) w->kept[left++] = w->kept[q];
        if (left == count) break;
    }
    w->keeps = count;
    memset(a->weight, 0, a->count * sizeof *a->weight);
    for (size_t q = 0; q < count; ++q)
        a->weight[w->kept[q]] = weight[q];
    return left == count;
}

/* out = H u, of the lower triangle */
static void times_hessian(const newton *w, const double *u, double *out)
{
    const size_t n = w->n;
    memset(out, 0, n * sizeof *out);
    for (size_t j = 0; j < n; ++j) {
        const double *column = w->hessian + j * n;
        hci_vector_add(n - j, u[j], column + j, out + j);
        out[j] += hci_vector_dot(n - j - 1, column + j + 1, u + j + 1);
    }
}

/* What rounding leaves of H dx + Σ λ∇c = −∇f and ∇cᵀdx = −c is solved for again. */
static void refine(newton *w, const double *f, double *dx)
{
    const size_t n = w->n;
    columns *a = &w->act;
    double *lack = w->around, *weight = w->few + a->count;
    times_hessian(w, dx, lack);
    for (size_t j = 0; j < n; ++j)
        lack[j] = -lack[j] - f[j];
    for (size_t q = 0; q < w->keeps; ++q)
        hci_vector_add(n, -a->weight[w->kept[q]], a->gradient + w->kept[q] * n, lack);
    for (size_t q = 0; q < w->keeps; ++q) {
        const size_t k = w->kept[q];
        weight[q] = a->beyond[k] + hci_vector_dot(n, a->gradient + k * n, dx) +
                    hci_vector_dot(n, a->solved + k * n, lack);
    }
    hci_cholesky_solve(w->keeps, w->gram, weight);
    for (size_t q = 0; q < w->keeps; ++q) {
        a->weight[w->kept[q]] += weight[q];
        hci_vector_add(n, -weight[q], a->gradient + w->kept[q] * n, lack);
    }
    hci_cholesky_solve(n, w->factor, lack);
    hci_vector_add(n, 1.0, lack, dx);
}

/* x += dx = −H⁻¹(∇f + Σ λ∇c). f, solved_f: ∇f, H⁻¹∇f. */
static void move(newton *w, const double *f, const double *solved_f)
{
    double *dx = w->around + w->n, size = 0.0;
    for (size_t j = 0; j < w->n; ++j)
        dx[j] = -solved_f[j];
    for (size_t q = 0; q < w->act.count; ++q)
        hci_vector_add(w->n, -w->act.weight[q], w->act.solved + q * w->n, dx);
    for (int k = 0; k < REFINEMENTS; ++k)
        refine(w, f, dx);
    for (size_t j = 0; j < w->n; ++j)
        size = fmax(size, fabs(w->x[j]));
    w->moved = fabs(dx[hci_vector_largest(w->n, dx)]) / fmax(size, 1e-300);
    hci_vector_add(w->n, 1.0, dx, w->x);
}

static void keep_weights(newton *w)
{
    for (size_t k = 0; k < w->peaks; ++k)
        w->peak[k].weight = 0.0;
    memset(w->rest_weight, 0, w->build.rows * sizeof *w->rest_weight);
    for (size_t q = 0; q < w->act.count; ++q) {
        const size_t row = w->act.row[q];
        if (row < w->peaks)
            w->peak[row].weight = w->act.weight[q];
        else if (row < w->peaks + w->build.rows)
            w->rest_weight[row - w->peaks] = w->act.weight[q];
    }
}

/* Room for what depends on how many constraints there are. */
static hci_status reserve_columns(newton *w)
{
    const size_t n = w->n, most = w->peaks + w->build.rows + w->build.equalities + 1;
    columns *a = &w->act;
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
static void begin_hessian(newton *w, double *f)
{
    const hci_limit_build *b = w->near;
    memset(w->hessian, 0, w->n * w->n * sizeof *w->hessian);
    for (size_t j = 0; j < w->n; ++j) {
        const bool is_copper = b->stage == HCI_STAGE_COPPER && j < w->coordinates;
        w->hessian[j * (w->n + 1)] = is_copper ? b->p[j * (w->n + 1)] : PULL;
        f[j] = b->c[j] + (is_copper ? b->p[j * (w->n + 1)] * w->x[j] : 0.0);
    }
}

/* The constraints that act at these currents, and H with how they bend. */
static hci_status linearise(newton *w, double *f)
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

static hci_status step(newton *w)
{
    const size_t n = w->n;
    columns *a = &w->act;
    double *f = w->slope, *solved_f = f + n;
    const hci_status status = linearise(w, f);
    if (status || w->has_failed) return status;
    memcpy(solved_f, f, n * sizeof *f);
    hci_cholesky_solve(n, w->factor, solved_f);
    memcpy(a->solved, a->gradient, a->count * n * sizeof *a->solved);
    for (size_t q = 0; q < a->count; ++q) {
        hci_cholesky_solve(n, w->factor, a->solved + q * n);
        w->few[q] = hci_vector_dot(n, a->solved + q * n, f);
    }
    w->has_failed = !choose_columns(w);
    if (w->has_failed) return HCI_OK;
    move(w, f, solved_f);
    keep_weights(w);
    w->has_failed = !(w->moved < LONGEST);
    return HCI_OK;
}

/* ---- all of it ---- */

static hci_status come_to_rest(newton *w)
{
    hci_status status = HCI_OK;
    w->moved = 1.0;
    for (int k = 0; k < MOST_STEPS && w->moved > ARRIVED && !w->has_failed && !status; ++k)
        status = step(w);
    w->has_failed = w->has_failed || w->moved > RESTING;
    return status;
}

/* Until no peak is beyond its limit that was not known. */
static hci_status iterate(newton *w)
{
    size_t added = 1;
    hci_status status = HCI_OK;
    for (int k = 0; k < MOST_SEARCHES && added > 0 && !w->has_failed && !status; ++k) {
        status = come_to_rest(w);
        if (!status && !w->has_failed) status = search(w, HCI_LIMIT_MARGIN, &added);
    }
    w->has_failed = w->has_failed || added > 0;
    return status;
}

/* Whether the currents keep the limits at every angle, and the torque its range but for what its search may
 * miss. */
static hci_status check(newton *w)
{
    const hci_limit_program *p = w->near->of;
    hci_status status = HCI_OK;
    for (size_t q = 0; q < p->grids && !status; ++q) {
        const bool is_of_torque = p->grid[q].kind == HCI_POINT_TORQUE;
        hci_limit_points found = {NULL};
        double range[2];
        if (!is_asked(w, &p->grid[q])) continue;
        range_of(w, &p->grid[q], is_of_torque ? 0.0 : HCI_LIMIT_MARGIN, range);
        range[0] -= is_of_torque ? MISSED * p->scale_Nm : 0.0;
        range[1] += is_of_torque ? MISSED * p->scale_Nm : 0.0;
        status = peaks_beyond(w, &p->grid[q], range, &found);
        w->has_failed = w->has_failed || found.count > 0;
        hci_limit_points_release(&found);
    }
    return status;
}

static hci_status give(const newton *w, hci_limit_optimum *o)
{
    hci_limit_optimum exact = {.x = hci_memory_new(w->coordinates, sizeof *exact.x)};
    const hci_cone_answer answer = {.end = HCI_CONE_SOLVED, .x = w->x, .z = w->rest_weight};
    if (!exact.x) return HCI_ERROR_MEMORY;
    hci_limit_stage_read(&w->build, &answer, &exact);
    for (size_t k = 0; k < w->peaks; ++k)
        if (!is_torque(&w->peak[k]))
            hci_limit_stage_add_gain(&w->build, hci_limit_tag_of(&w->peak[k].at), w->peak[k].weight, &exact);
    exact.is_settled = true;
    hci_memory_free(o->x);
    *o = exact;
    return HCI_OK;
}

/* The rows of no angle, which do not change. */
static hci_status begin_build(newton *w)
{
    w->program.points = (hci_limit_points){NULL};
    w->program.grids = 0;
    if (!hci_limit_build_begin(&w->program, w->near->stage, &w->build)) return HCI_ERROR_MEMORY;
    hci_limit_stage_fill(&w->build);
    return w->build.is_full ? HCI_ERROR_MEMORY : HCI_OK;
}

static hci_status begin(const hci_limit_build *b, newton *w)
{
    const size_t n = b->n;
    *w = (newton){.near = b, .program = *b->of, .n = n, .coordinates = b->coordinates};
    if (begin_build(w)) return HCI_ERROR_MEMORY;
    w->block = hci_memory_new(2 * n * n + 6 * n + w->build.rows + hci_limit_row_room(&w->program.field),
                              sizeof *w->block);
    if (!w->block) return HCI_ERROR_MEMORY;
    w->hessian = w->block;
    w->factor = w->hessian + n * n;
    w->x = w->factor + n * n;
    w->slope = w->x + n;
    w->around = w->slope + 2 * n;
    w->rest_weight = w->around + 3 * n;
    w->row = w->rest_weight + w->build.rows;
    return HCI_OK;
}

static hci_status begin_at_answer(newton *w, const hci_cone_answer *answer)
{
    size_t added;
    memcpy(w->x, answer->x, w->n * sizeof *w->x);
    const hci_status status = search(w, CLOSE, &added);
    if (status) return status;
    begin_weights(w, answer->z);
    drop_slack(w);
    return HCI_OK;
}

static const hci_limit_grid *grid_of(const newton *w, const hci_limit_point *at)
{
    const hci_limit_program *p = w->near->of;
    for (size_t q = 0; q < p->grids; ++q)
        if (p->grid[q].kind == at->kind && (at->kind == HCI_POINT_TORQUE || p->grid[q].phase == at->phase))
            return &p->grid[q];
    return NULL;
}

/* The peaks that act there are known already. */
static hci_status begin_at_rest(newton *w, const hci_limit_rest *last)
{
    const double *weight = last->x + last->n;
    size_t added;
    w->has_failed = last->rest != w->build.rows;
    if (w->has_failed) return HCI_OK;
    memcpy(w->x, last->x, w->n * sizeof *w->x);
    memcpy(w->rest_weight, weight, last->rest * sizeof *weight);
    w->peak = hci_memory_new(last->peaks + 1, sizeof *w->peak);
    if (!w->peak) return HCI_ERROR_MEMORY;
    for (size_t k = 0; k < last->peaks; ++k) {
        w->peak[w->peaks++] = (peak){last->at[k], grid_of(w, &last->at[k]), weight[last->rest + k]};
        w->has_failed = w->has_failed || !w->peak[k].grid;
    }
    return w->has_failed ? HCI_OK : search(w, CLOSE, &added);
}

static hci_status keep_rest(const newton *w, hci_limit_rest *last)
{
    hci_limit_rest_release(last);
    last->x = hci_memory_new(w->n + w->build.rows + w->peaks, sizeof *last->x);
    last->at = hci_memory_new(w->peaks + 1, sizeof *last->at);
    if (!last->x || !last->at) return HCI_ERROR_MEMORY;
    last->n = w->n;
    last->rest = w->build.rows;
    double *weight = last->x + last->n;
    memcpy(last->x, w->x, w->n * sizeof *w->x);
    memcpy(weight, w->rest_weight, last->rest * sizeof *weight);
    for (size_t k = 0; k < w->peaks; ++k) {
        if (!(w->peak[k].weight > 0.0)) continue;
        weight[last->rest + last->peaks] = w->peak[k].weight;
        last->at[last->peaks++] = w->peak[k].at;
    }
    return HCI_OK;
}

void hci_limit_rest_release(hci_limit_rest *rest)
{
    hci_memory_free(rest->x);
    hci_memory_free(rest->at);
    *rest = (hci_limit_rest){NULL};
}

static void end(newton *w)
{
    hci_limit_build_release(&w->build);
    hci_memory_free(w->act.gradient);
    hci_memory_free(w->act.row);
    hci_memory_free(w->peak);
    hci_memory_free(w->block);
}

hci_status hci_limit_newton(const hci_limit_build *build, const hci_cone_answer *answer, hci_limit_rest *last,
                            hci_limit_optimum *optimum)
{
    newton w;
    hci_status status;
    if (build->stage == HCI_STAGE_FIT) return HCI_OK; /* whose limits move */
    if (!answer && last->n != build->n) return HCI_OK;
    status = begin(build, &w);
    if (!status) status = answer ? begin_at_answer(&w, answer) : begin_at_rest(&w, last);
    if (!status && !w.has_failed) status = iterate(&w);
    if (!status && !w.has_failed) status = check(&w);
    if (w.has_failed && !answer) hci_limit_rest_release(last);
    if (!status && !w.has_failed) status = keep_rest(&w, last);
    if (!status && !w.has_failed) status = give(&w, optimum);
    end(&w);
    return status;
}
