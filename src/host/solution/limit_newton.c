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
    MOST_STEPS = 12,    /* between two searches */
    MOST_CLIMBS = 16,   /* samples by which a peak is followed in one step */
    REFINEMENTS = 2,
    MOST_SETS = 30 /* of constraints that act, in one step */
};

#define CLOSE   1e-3 /* share below a limit within which a peak is looked at */
#define LIGHT   1e-6 /* share of the largest multiplier below which a constraint does not act at first */
#define BESIDE  0.1  /* of the spacing of samples: where slopes over the angle are taken */
#define APART   16.0 /* samples within which a row of the program is that of a peak */
#define ARRIVED 1e-9 /* step as a share of the currents with which it is there */
#define PULL    1e-5 /* to the last currents where the copper is not what is minimised */
#define LONGEST 0.3  /* the same, with which it was not near enough */

/* The top of a quantity next to its limit. */
typedef struct {
    hci_limit_point at;
    const hci_limit_grid *grid;
    double side, weight; /* 1 at the upper limit, −1 at the lower; multiplier, not negative */
} peak;

/* Constraints that act as columns: gradient, what the constraint is beyond 0, multiplier. */
typedef struct {
    double *gradient, *solved; /* n each: ∇c, H⁻¹∇c */
    double *beyond, *weight;
    bool *is_equation;
    size_t *row; /* in the build; of an equation behind its rows */
    size_t count;
} columns;

typedef struct {
    const hci_limit_build *near;
    const hci_cone_answer *answer;
    hci_limit_program program; /* its points are the peaks, and it has no grids */
    size_t n, coordinates;
    peak *peak;
    size_t peaks, rest; /* rest: rows behind those of the angles */
    double *block, *x, *rest_weight, *hessian, *factor, *slope, *around;
    columns act;
    double *gram, *few; /* few: 3·most */
    size_t *kept, keeps;
    hci_limit_build build;
    double moved;
    bool has_failed;
} newton;

/* ---- peaks ---- */

static double limit_of(const newton *w, const hci_limit_grid *g)
{
    const hci_limit_program *p = w->near->of;
    return hci_limit_of_point(p->bounds, g->kind, g->phase) * (1.0 + p->widened);
}

/* The row of a quantity over the unknowns and its value, as shares of the limit. */
static double share_at(const newton *w, const peak *k, double theta_rad, double *row)
{
    const hci_limit_point at = {k->at.kind, k->at.phase, theta_rad, 0.0};
    const double limit = limit_of(w, k->grid), scale = w->near->of->scale_A / limit,
                 constant = hci_limit_row(&w->program.field, &at, row);
    for (size_t j = 0; j < w->coordinates; ++j)
        row[j] *= scale;
    for (size_t j = w->coordinates; j < w->n; ++j)
        row[j] = 0.0;
    return constant / limit + hci_vector_dot(w->n, row, w->x);
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

/* Adds the peaks of one grid that are beyond a share of the limit and not known yet; *added: how many. */
static hci_status search_grid(newton *w, const hci_limit_grid *g, double share, size_t *added)
{
    const hci_limit_program *p = w->near->of;
    const double limit = share * limit_of(w, g), range[2] = {-limit, limit};
    hci_limit_points found = {NULL};
    double *x = w->around, worst;
    for (size_t j = 0; j < w->coordinates; ++j)
        x[j] = p->scale_A * w->x[j];
    hci_status status = hci_limit_peaks(&p->field, g, x, range, &found, &worst);
    peak *more = status ? NULL : hci_memory_resize(w->peak, w->peaks + found.count, sizeof *more);
    if (more) w->peak = more;
    if (!more) status = HCI_ERROR_MEMORY;
    for (size_t k = 0; k < found.count && !status; ++k) {
        const peak *known = peak_of(w, &found.point[k]);
        if (known && samples_apart(g, known->at.theta_rad, found.point[k].theta_rad) < 1.0) continue;
        w->peak[w->peaks++] = (peak){found.point[k], g, 1.0, 0.0};
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
        if (p->grid[q].kind != HCI_POINT_TORQUE) status = search_grid(w, &p->grid[q], share, added);
    return status;
}

/* Multipliers of the interior point to the peaks that are next to their rows. */
static void begin_weights(newton *w)
{
    const hci_limit_build *b = w->near;
    const double *z = w->answer->z;
    double most = 0.0;
    for (size_t k = 0; k < b->rows; ++k)
        most = fmax(most, fabs(z[k]));
    for (size_t k = 0; k < b->two_sided; ++k) {
        peak *p = fabs(z[k]) > LIGHT * most ? peak_of(w, &b->at[k]) : NULL;
        if (p) p->weight += fabs(z[k]);
    }
    for (size_t k = 0; k < w->rest; ++k)
        w->rest_weight[k] = fabs(z[b->two_sided + k]) > LIGHT * most ? z[b->two_sided + k] : 0.0;
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

static flank flank_of(newton *w, peak *p)
{
    flank f = {.h = BESIDE * p->grid->step_rad, .before = w->around};
    f.middle = f.before + w->n;
    f.after = f.middle + w->n;
    const double low = share_at(w, p, p->at.theta_rad - f.h, f.before),
                 high = share_at(w, p, p->at.theta_rad + f.h, f.after),
                 here = share_at(w, p, p->at.theta_rad, f.middle);
    p->side = here < 0.0 ? -1.0 : 1.0;
    f.slope = p->side * (high - low) / (2.0 * f.h);
    f.bend = p->side * (high - 2.0 * here + low) / (f.h * f.h);
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

/* The program of the peaks alone, at the angles where they are. */
static hci_status rebuild(newton *w)
{
    hci_limit_points *points = &w->program.points;
    hci_limit_build_release(&w->build);
    hci_limit_points_change(points);
    points->count = 0;
    for (size_t k = 0; k < w->peaks; ++k)
        if (hci_limit_points_add(points, w->peak[k].at)) return HCI_ERROR_MEMORY;
    if (hci_limit_points_fill(&w->program.field, points)) return HCI_ERROR_MEMORY;
    if (!hci_limit_build_begin(&w->program, w->near->stage, &w->build)) return HCI_ERROR_MEMORY;
    hci_limit_stage_fill(&w->build);
    return w->build.is_full ? HCI_ERROR_MEMORY : HCI_OK;
}

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

static void add_peak_column(newton *w, size_t k)
{
    const double *row = row_at(w, k), value = hci_vector_dot(w->n, row, w->x), side = w->peak[k].side;
    double *g = next_gradient(w);
    for (size_t j = 0; j < w->n; ++j)
        g[j] = side * row[j];
    add_column(w, k, side > 0.0 ? value - row[w->n] : w->build.low[k] - value, w->peak[k].weight, false);
}

static void add_linear_column(newton *w, size_t k)
{
    memcpy(next_gradient(w), row_at(w, k), w->n * sizeof(double));
    add_column(w, k, -room_of(w, k), w->rest_weight[k - w->peaks], false);
}

/* |u_1 …| − u_0 of one cone, with its bend. u: h − G x */
static void add_cone_column(newton *w, size_t head, size_t rows)
{
    const double weight = w->rest_weight[head - w->peaks], top = room_of(w, head);
    double *g = next_gradient(w), length = 0.0;
    memset(g, 0, w->n * sizeof *g);
    for (size_t k = 1; k < rows; ++k) {
        const double u = room_of(w, head + k);
        length += u * u;
        hci_vector_add(w->n, -u, row_at(w, head + k), g);
    }
    length = sqrt(length);
    if (!(length > 0.0)) return;
    for (size_t j = 0; j < w->n; ++j)
        g[j] /= length;
    for (size_t k = 1; k < rows && weight > 0.0; ++k)
        add_square(w, weight / length, row_at(w, head + k));
    if (weight > 0.0) add_square(w, -weight / length, g);
    hci_vector_add(w->n, 1.0, row_at(w, head), g);
    add_column(w, head, length - top, weight, false);
}

static void add_equation_column(newton *w, size_t k)
{
    const double *row = w->build.equal + k * w->build.width;
    memcpy(next_gradient(w), row, w->n * sizeof *row);
    add_column(w, w->build.rows + k, hci_vector_dot(w->n, row, w->x) - row[w->n], 0.0, true);
}

static void add_columns(newton *w)
{
    const hci_limit_build *b = &w->build;
    w->act.count = 0;
    for (size_t k = 0; k < w->peaks; ++k)
        add_peak_column(w, k);
    for (size_t k = b->two_sided; k < b->linear; ++k)
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
    memset(w->rest_weight, 0, w->rest * sizeof *w->rest_weight);
    for (size_t q = 0; q < w->act.count; ++q) {
        const size_t row = w->act.row[q];
        if (row < w->peaks)
            w->peak[row].weight = w->act.weight[q];
        else if (row < w->build.rows)
            w->rest_weight[row - w->peaks] = w->act.weight[q];
    }
}

/* Room for what depends on how many constraints there are. */
static hci_status reserve_columns(newton *w)
{
    const size_t n = w->n, most = w->build.rows + w->build.equalities + 1;
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
    const bool is_copper = b->stage == HCI_STAGE_COPPER;
    memset(w->hessian, 0, w->n * w->n * sizeof *w->hessian);
    for (size_t j = 0; j < w->n; ++j) {
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
    if (rebuild(w) || reserve_columns(w)) return HCI_ERROR_MEMORY;
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
    w->has_failed = w->has_failed || w->moved > ARRIVED;
    return status;
}

/* Until no peak is beyond its limit that was not known. */
static hci_status iterate(newton *w)
{
    size_t added = 1;
    hci_status status = search(w, 1.0 - CLOSE, &added);
    if (!status) begin_weights(w);
    added = 1;
    for (int k = 0; k < MOST_SEARCHES && added > 0 && !w->has_failed && !status; ++k) {
        status = come_to_rest(w);
        if (!status && !w->has_failed) status = search(w, 1.0 - HCI_LIMIT_MARGIN, &added);
    }
    w->has_failed = w->has_failed || added > 0;
    return status;
}

/* Whether the currents keep the limits at every angle. */
static hci_status check(newton *w)
{
    const hci_limit_program *p = w->near->of;
    hci_status status = HCI_OK;
    for (size_t j = 0; j < w->coordinates; ++j)
        w->around[j] = p->scale_A * w->x[j];
    for (size_t q = 0; q < p->grids && !status; ++q) {
        const double limit = limit_of(w, &p->grid[q]) * (1.0 - HCI_LIMIT_MARGIN), range[2] = {-limit, limit};
        hci_limit_points found = {NULL};
        double worst;
        if (p->grid[q].kind == HCI_POINT_TORQUE) continue;
        status = hci_limit_peaks(&p->field, &p->grid[q], w->around, range, &found, &worst);
        w->has_failed = w->has_failed || found.count > 0;
        hci_limit_points_release(&found);
    }
    return status;
}

/* The answer of the program of the peaks. */
static hci_status give(newton *w, hci_limit_optimum *o)
{
    double *z = hci_memory_new(w->build.rows + 1, sizeof *z);
    hci_limit_optimum exact = {.x = hci_memory_new(w->coordinates, sizeof *exact.x)};
    const hci_cone_answer answer = {.end = HCI_CONE_SOLVED, .x = w->x, .z = z};
    const bool has_memory = z && exact.x;
    for (size_t k = 0; has_memory && k < w->build.rows; ++k)
        z[k] = k < w->peaks ? w->peak[k].side * w->peak[k].weight : w->rest_weight[k - w->peaks];
    if (has_memory) {
        hci_limit_stage_read(&w->build, &answer, &exact);
        exact.is_settled = true;
        hci_memory_free(o->x);
        *o = exact;
    }
    hci_memory_free(z);
    if (!has_memory) hci_memory_free(exact.x);
    return has_memory ? HCI_OK : HCI_ERROR_MEMORY;
}

static hci_status begin(const hci_limit_build *b, const hci_cone_answer *answer, newton *w)
{
    const size_t n = b->n, rest = b->rows - b->two_sided,
                 behind = b->of->field.system ? b->of->field.system->rows + n : 0;
    *w = (newton){
        .near = b, .answer = answer, .program = *b->of, .n = n, .coordinates = b->coordinates, .rest = rest};
    w->program.points = (hci_limit_points){NULL};
    w->program.grids = 0;
    w->block = hci_memory_new(2 * n * n + 6 * n + rest + behind, sizeof *w->block);
    if (!w->block) return HCI_ERROR_MEMORY;
    w->hessian = w->block;
    w->factor = w->hessian + n * n;
    w->x = w->factor + n * n;
    w->slope = w->x + n;
    w->rest_weight = w->slope + 2 * n;
    w->around = w->rest_weight + rest;
    memcpy(w->x, answer->x, n * sizeof *w->x);
    return HCI_OK;
}

static void end(newton *w)
{
    hci_limit_build_release(&w->build);
    hci_limit_points_release(&w->program.points);
    hci_memory_free(w->act.gradient);
    hci_memory_free(w->act.row);
    hci_memory_free(w->peak);
    hci_memory_free(w->block);
}

/* Rows of the torque at angles have two sides that move, and those of a circle a direction, which it does not
 * follow. */
static bool is_for(const hci_limit_build *b)
{
    if (hci_limit_is_circle(&b->of->field)) return false;
    return b->stage == HCI_STAGE_MEAN || (b->stage > HCI_STAGE_MEAN && !hci_limit_is_swing(b));
}

hci_status hci_limit_newton(const hci_limit_build *build, const hci_cone_answer *answer,
                            hci_limit_optimum *optimum)
{
    newton w;
    hci_status status;
    if (!is_for(build)) return HCI_OK;
    status = begin(build, answer, &w);
    if (!status) status = iterate(&w);
    if (!status && !w.has_failed) status = check(&w);
    if (!status && !w.has_failed) status = give(&w, optimum);
    end(&w);
    return status;
}
