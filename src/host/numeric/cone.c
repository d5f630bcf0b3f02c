/* Primal–dual interior point with the scaling of Nesterov and Todd and Mehrotra's predictor and corrector
 * (theory.md, section 15). Equations are eliminated first; then each step solves
 *
 *     (P + GᵀW⁻²G) dx = right side            Cholesky, with refinement
 *
 * A two-sided row stands once in G, and twice in s and z: its lower side comes after all rows. */
#include "host/numeric/cone.h"

#include <math.h>
#include <string.h>

#include "core/math/vector.h"
#include "hci/math/dense.h"
#include "host/base/memory.h"
#include "host/numeric/cone_scaling.h"
#include "host/numeric/null_space.h"

enum { MOST_STEPS = 150, MOST_IDLE = 30, MOST_SHORTER = 20, REFINEMENTS = 2 };

#define EXACT       1e-10 /* relative residuals and gap at which it ends */
#define GOOD        1e-7  /* and below which the best point is called solved */
#define CERTAIN     1e-8  /* relative residual of a proof that there is no solution */
#define TO_BOUNDARY 0.99  /* share of the way to the boundary */
#define CENTRED     1e-3  /* share of the mean product of s and z below which none may fall */
#define SHORTER     0.9   /* by which a step is shortened for that */

/* The problem without equations, and where the iteration stands. */
typedef struct {
    const hci_cone_problem *problem;
    hci_null_space space;
    hci_cone cone;
    hci_cone_scaling scaling;
    size_t n, rows, entries, degree;
    double *p, *c, *g, *h; /* reduced to the null space; h has `entries`, with −low behind; p may be NULL */
    double *x, *s, *z, *rx, *rs;
    double *dx, *ds, *dz, *affine_s, *affine_z, *right, *weighed, *product, *gradient;
    double *normal, *factor, *scaled, *few; /* n×n, n×n, rows×n, 4·n */
    double *best_x, *best_z, best;
    size_t idle;
    double *block;
} solver;

/* ---- products with the two-sided G ---- */

/* y = G x, entries long. */
static void multiply(const solver *v, const double *x, double *y)
{
    memset(y, 0, v->entries * sizeof *y);
    for (size_t j = 0; j < v->n; ++j)
        hci_vector_add(v->rows, x[j], v->g + j * v->rows, y);
    for (size_t k = 0; k < v->problem->two_sided; ++k)
        y[v->rows + k] = -y[k];
}

/* y += Gᵀ u; u: entries. */
static void multiply_transposed(const solver *v, const double *u, double *y)
{
    double *folded = v->product;
    memcpy(folded, u, v->rows * sizeof *u);
    for (size_t k = 0; k < v->problem->two_sided; ++k)
        folded[k] -= u[v->rows + k];
    for (size_t j = 0; j < v->n; ++j)
        y[j] += hci_vector_dot(v->rows, v->g + j * v->rows, folded);
}

/* y = P x */
static void multiply_p(const solver *v, const double *x, double *y)
{
    memset(y, 0, v->n * sizeof *y);
    for (size_t j = 0; v->p && j < v->n; ++j)
        hci_vector_add(v->n, x[j], v->p + j * v->n, y);
}

/* ---- room ---- */

/* One block for all. */
static bool reserve(solver *v)
{
    const size_t n = v->n, m = v->entries, cones = v->problem->cones;
    double **const vector[] = {
        &v->h,        &v->s,       &v->z,       &v->rs,     &v->ds,        &v->dz,           &v->affine_s,
        &v->affine_z, &v->weighed, &v->product, &v->best_z, &v->scaling.w, &v->scaling.point};
    double **const unknown[] = {&v->c, &v->x, &v->rx, &v->dx, &v->right, &v->gradient, &v->best_x};
    const size_t vectors = sizeof vector / sizeof *vector, unknowns = sizeof unknown / sizeof *unknown;
    double *at = hci_memory_new(vectors * m + unknowns * n + cones + 3 * n * n + 2 * v->rows * n + 4 * n + 1,
                                sizeof *at);
    v->block = at;
    if (!at) return false;
    for (size_t k = 0; k < vectors; ++k, at += m)
        *vector[k] = at;
    for (size_t k = 0; k < unknowns; ++k, at += n)
        *unknown[k] = at;
    v->scaling.eta = at;
    v->normal = at + cones;
    v->factor = v->normal + n * n;
    v->p = v->factor + n * n;
    v->g = v->p + n * n;
    v->scaled = v->g + v->rows * n;
    v->few = v->scaled + v->rows * n;
    return true;
}

/* ---- without equations ---- */

/* out = M Z; m: rows × unknowns. */
static void times_basis(const hci_null_space *z, const double *m, size_t rows, double *out)
{
    memset(out, 0, rows * z->free * sizeof *out);
    for (size_t j = 0; j < z->free; ++j)
        for (size_t i = 0; i < z->unknowns; ++i)
            hci_vector_add(rows, z->basis[i + j * z->unknowns], m + i * rows, out + j * rows);
}

/* c of the reduced problem is Zᵀ(c + P x_0), P is ZᵀPZ. pz: workspace, unknowns × free. */
static void reduce_objective(solver *v, double *pz)
{
    const hci_cone_problem *q = v->problem;
    const hci_null_space *z = &v->space;
    const size_t n = q->unknowns;
    if (q->p) times_basis(z, q->p, n, pz);
    for (size_t j = 0; j < v->n; ++j) {
        v->c[j] = hci_vector_dot(n, q->c, z->basis + j * n);
        if (!q->p) continue;
        v->c[j] += hci_vector_dot(n, z->point, pz + j * n);
        for (size_t i = 0; i < v->n; ++i)
            v->p[i + j * v->n] = hci_vector_dot(n, z->basis + i * n, pz + j * n);
    }
    if (!q->p) v->p = NULL;
}

static void reduce_rows(solver *v)
{
    const hci_cone_problem *q = v->problem;
    if (q->equalities > 0)
        times_basis(&v->space, q->g, q->rows, v->g);
    else
        memcpy(v->g, q->g, q->rows * v->n * sizeof *v->g);
    memset(v->weighed, 0, v->entries * sizeof *v->weighed);
    for (size_t j = 0; j < q->unknowns; ++j)
        hci_vector_add(q->rows, v->space.point[j], q->g + j * q->rows, v->weighed);
    for (size_t k = 0; k < q->rows; ++k)
        v->h[k] = q->h[k] - v->weighed[k];
    for (size_t k = 0; k < q->two_sided; ++k)
        v->h[q->rows + k] = v->weighed[k] - q->low[k];
}

static hci_status make(const hci_cone_problem *q, solver *v)
{
    double *pz;
    memset(v, 0, sizeof *v);
    v->problem = q;
    if (hci_null_space_make(q->equalities, q->unknowns, q->a, q->b, &v->space)) return HCI_ERROR_MEMORY;
    v->cone = (hci_cone){q->linear, q->cones, q->two_sided, q->cone, 0};
    v->scaling.cone = &v->cone;
    v->degree = hci_cone_degree(&v->cone);
    v->n = v->space.free;
    v->rows = q->rows;
    v->entries = v->cone.entries;
    pz = hci_memory_new(q->unknowns * v->n, sizeof *pz);
    if (!pz || !reserve(v)) {
        hci_memory_free(pz);
        return HCI_ERROR_MEMORY;
    }
    reduce_objective(v, pz);
    reduce_rows(v);
    hci_memory_free(pz);
    return HCI_OK;
}

static void release(solver *v)
{
    hci_null_space_release(&v->space);
    hci_memory_free(v->block);
}

/* ---- the normal equations ---- */

/* v->scaled = W⁻¹ G. A two-sided row has the weight of both its sides. */
static void scale_rows(solver *v)
{
    const hci_cone *c = &v->cone;
    const double *w = v->scaling.w;
    for (size_t k = 0; k < c->linear; ++k) {
        const double below = k < c->after ? 1.0 / w[v->rows + k] : 0.0;
        v->weighed[k] = sqrt(1.0 / (w[k] * w[k]) + below * below);
    }
    for (size_t j = 0; j < v->n; ++j) {
        double *column = v->scaled + j * v->rows;
        const double *g = v->g + j * v->rows;
        size_t at = c->linear;
        for (size_t k = 0; k < c->linear; ++k)
            column[k] = v->weighed[k] * g[k];
        memcpy(column + at, g + at, (v->rows - at) * sizeof *g);
        for (size_t k = 0; k < c->cones; at += c->size[k++])
            hci_cone_apply_block(&v->scaling, k, at, 1, column + at);
    }
}

/* Adds the products of four rows of v->scaled, which begin at `row`, to the lower triangle: four at once so
 * that the triangle is fetched less often. few: workspace, 4·n. */
static void add_four_rows(solver *v, size_t row, double *few)
{
    const size_t n = v->n, left = v->rows - row < 4 ? v->rows - row : 4;
    double *const r0 = few, *const r1 = few + n, *const r2 = r1 + n, *const r3 = r2 + n;
    memset(few, 0, 4 * n * sizeof *few);
    for (size_t j = 0; j < n; ++j)
        for (size_t q = 0; q < left; ++q)
            few[q * n + j] = v->scaled[row + q + j * v->rows];
    for (size_t j = 0; j < n; ++j) {
        const double a = r0[j], b = r1[j], c = r2[j], d = r3[j];
        double *restrict column = v->normal + j * n;
        for (size_t i = j; i < n; ++i)
            column[i] += a * r0[i] + b * r1[i] + c * r2[i] + d * r3[i];
    }
}

/* P + GᵀW⁻²G in the lower triangle. */
static void make_normal(solver *v)
{
    const size_t n = v->n;
    scale_rows(v);
    memset(v->normal, 0, n * n * sizeof *v->normal);
    if (v->p) memcpy(v->normal, v->p, n * n * sizeof *v->normal);
    for (size_t row = 0; row < v->rows; row += 4)
        add_four_rows(v, row, v->few);
}

/* With as little added to the diagonal as it takes. */
static bool factor_normal(solver *v)
{
    const size_t n = v->n;
    make_normal(v);
    for (double share = 1e-15; share < 1e-2; share *= 100.0) {
        memcpy(v->factor, v->normal, n * n * sizeof *v->factor);
        for (size_t i = 0; i < n; ++i)
            v->factor[i * (n + 1)] += share * (v->normal[i * (n + 1)] + 1e-3);
        if (!hci_cholesky_factor(n, v->factor)) return true;
    }
    return false;
}

/* normal · dx = right */
static void solve_normal(const solver *v)
{
    memcpy(v->dx, v->right, v->n * sizeof *v->dx);
    hci_cholesky_solve(v->n, v->factor, v->dx);
}

/* ---- one direction ---- */

/* u = W⁻² u */
static void divide_twice(const solver *v, double *u)
{
    hci_cone_apply(&v->scaling, 1, u, u);
    hci_cone_apply(&v->scaling, 1, u, u);
}

/* What P dx + Gᵀdz = −share·rx lacks, which rounding in W⁻² makes large near the end, is solved for again. */
static void refine(solver *v, double share)
{
    multiply_p(v, v->dx, v->right);
    multiply_transposed(v, v->dz, v->right);
    for (size_t j = 0; j < v->n; ++j)
        v->right[j] = -v->right[j] - share * v->rx[j];
    hci_cholesky_solve(v->n, v->factor, v->right);
    hci_vector_add(v->n, 1.0, v->right, v->dx);
    multiply(v, v->right, v->weighed);
    hci_vector_add(v->entries, -1.0, v->weighed, v->ds);
    divide_twice(v, v->weighed);
    hci_vector_add(v->entries, 1.0, v->weighed, v->dz);
}

/* P dx + Gᵀdz = −share·rx, G dx + ds = −share·rs, λ∘(W dz + W⁻¹ds) = d. d: in v->ds, which becomes ds. */
static void direction(solver *v, double share)
{
    hci_cone_divide(&v->cone, v->scaling.point, v->ds, v->ds);
    hci_cone_apply(&v->scaling, 0, v->ds, v->ds); /* W(λ \ d) */
    for (size_t k = 0; k < v->entries; ++k)
        v->dz[k] = share * v->rs[k] + v->ds[k];
    divide_twice(v, v->dz);
    for (size_t j = 0; j < v->n; ++j)
        v->right[j] = share * v->rx[j];
    multiply_transposed(v, v->dz, v->right);
    for (size_t j = 0; j < v->n; ++j)
        v->right[j] = -v->right[j];
    solve_normal(v);
    multiply(v, v->dx, v->weighed);
    for (size_t k = 0; k < v->entries; ++k) { /* dz = W⁻²(G dx + share·rs + W(λ \ d)) */
        v->dz[k] = v->weighed[k] + share * v->rs[k] + v->ds[k];
        v->ds[k] = -share * v->rs[k] - v->weighed[k];
    }
    divide_twice(v, v->dz);
    for (int k = 0; k < REFINEMENTS; ++k)
        refine(v, share);
}

/* The largest step, at most 1/TO_BOUNDARY, that keeps both s and z inside. */
static double longest_step(const solver *v)
{
    return hci_cone_step(&v->cone, v->z, v->dz, hci_cone_step(&v->cone, v->s, v->ds, 1.0 / TO_BOUNDARY));
}

static double gap_at(const solver *v, double step)
{
    double sum = 0.0;
    for (size_t k = 0; k < v->entries; ++k)
        sum += (v->s[k] + step * v->ds[k]) * (v->z[k] + step * v->dz[k]);
    return sum;
}

/* d = −λ∘λ */
static void predict(solver *v)
{
    hci_cone_product(&v->cone, v->scaling.point, v->scaling.point, v->ds);
    for (size_t k = 0; k < v->entries; ++k)
        v->ds[k] = -v->ds[k];
    direction(v, 1.0);
}

/* d = −λ∘λ − (W⁻¹ds)∘(W dz) + σμ e, of the direction predicted. */
static void correct(solver *v, double sigma, double mu)
{
    hci_cone_apply(&v->scaling, 1, v->ds, v->affine_s);
    hci_cone_apply(&v->scaling, 0, v->dz, v->affine_z);
    hci_cone_product(&v->cone, v->affine_s, v->affine_z, v->ds);
    hci_cone_product(&v->cone, v->scaling.point, v->scaling.point, v->dz);
    for (size_t k = 0; k < v->entries; ++k)
        v->ds[k] = -v->ds[k] - v->dz[k];
    hci_cone_add_unit(&v->cone, sigma * mu, v->ds);
    direction(v, 1.0 - sigma);
}

/* The longest step after which no product s·z is far below the mean of all, for from there the next steps
 * would be short. */
static double centred_step(const solver *v)
{
    const double *const s[2] = {v->s, v->ds}, *const z[2] = {v->z, v->dz};
    double step = fmin(1.0, TO_BOUNDARY * longest_step(v));
    for (int k = 0; k < MOST_SHORTER; ++k, step *= SHORTER)
        if (hci_cone_least_product(&v->cone, s, z, step) >= CENTRED * gap_at(v, step) / (double)v->degree)
            break;
    return step;
}

static double move(solver *v)
{
    const double step = centred_step(v);
    hci_vector_add(v->n, step, v->dx, v->x);
    hci_vector_add(v->entries, step, v->ds, v->s);
    hci_vector_add(v->entries, step, v->dz, v->z);
    return step;
}

static bool step(solver *v)
{
    const double mu = gap_at(v, 0.0) / (double)v->degree;
    double share, length;
    hci_cone_scale(&v->scaling, v->s, v->z);
    if (!hci_vector_finite(v->entries, v->scaling.w) || !factor_normal(v)) return false;
    predict(v);
    length = fmin(1.0, longest_step(v));
    share = fmax(0.0, gap_at(v, length) / (mu * (double)v->degree));
    correct(v, fmin(1.0, share * share * share), mu);
    return hci_vector_finite(v->n, v->dx) && move(v) > 1e-10;
}

/* ---- where it begins and ends ---- */

/* The point with the least |s|, moved into the cone. */
static bool begin(solver *v)
{
    double depth;
    for (size_t k = 0; k < v->entries; ++k)
        v->scaling.w[k] = 1.0;
    for (size_t k = 0, at = v->cone.linear; k < v->cone.cones; at += v->cone.size[k++]) {
        v->scaling.eta[k] = 1.0;
        memset(v->scaling.w + at + 1, 0, (v->cone.size[k] - 1) * sizeof *v->scaling.w);
    }
    if (!factor_normal(v)) return false;
    for (size_t j = 0; j < v->n; ++j)
        v->right[j] = -v->c[j];
    multiply_transposed(v, v->h, v->right);
    solve_normal(v);
    memcpy(v->x, v->dx, v->n * sizeof *v->x);
    multiply(v, v->x, v->z);
    for (size_t k = 0; k < v->entries; ++k) {
        v->z[k] -= v->h[k];
        v->s[k] = -v->z[k];
    }
    depth = hci_cone_depth(&v->cone, v->s);
    if (depth > -1e-3) hci_cone_add_unit(&v->cone, 1.0 + depth, v->s);
    depth = hci_cone_depth(&v->cone, v->z);
    if (depth > -1e-3) hci_cone_add_unit(&v->cone, 1.0 + depth, v->z);
    return true;
}

static double length(size_t n, const double *x)
{
    return sqrt(hci_vector_dot(n, x, x));
}

static double largest(size_t n, const double *x)
{
    return n > 0 ? fabs(x[hci_vector_largest(n, x)]) : 0.0;
}

/* Fills the residuals rx = P x + Gᵀz + c and rs = G x + s − h; the largest of them and of the gap, relative:
 * rx to the multipliers too, which are large where rows leave next to no room.
 * Gᵀz is left in v->gradient. */
static double residuals(solver *v)
{
    const double gap = gap_at(v, 0.0);
    double objective;
    multiply_p(v, v->x, v->rx);
    objective = 0.5 * hci_vector_dot(v->n, v->x, v->rx) + hci_vector_dot(v->n, v->c, v->x);
    memset(v->gradient, 0, v->n * sizeof *v->gradient);
    multiply_transposed(v, v->z, v->gradient);
    for (size_t j = 0; j < v->n; ++j)
        v->rx[j] += v->gradient[j] + v->c[j];
    multiply(v, v->x, v->rs);
    for (size_t k = 0; k < v->entries; ++k)
        v->rs[k] += v->s[k] - v->h[k];
    return fmax(fmax(length(v->n, v->rx) / fmax(fmax(1.0, length(v->n, v->c)), largest(v->entries, v->z)),
                     length(v->entries, v->rs) / fmax(1.0, length(v->entries, v->h))),
                gap / fmax(1.0, fabs(objective)));
}

/* Whether z proves that no x keeps all rows, or x that the objective has no end. */
static bool is_hopeless(solver *v, hci_cone_end *end)
{
    const double against = -hci_vector_dot(v->entries, v->h, v->z), down = -hci_vector_dot(v->n, v->c, v->x);
    if (against > 0.0 && length(v->n, v->gradient) < CERTAIN * against) {
        *end = HCI_CONE_INFEASIBLE;
        return true;
    }
    if (!(down > 0.0)) return false;
    multiply_p(v, v->x, v->right);
    multiply(v, v->x, v->weighed);
    hci_vector_add(v->entries, 1.0, v->s, v->weighed);
    *end = HCI_CONE_UNBOUNDED;
    return length(v->n, v->right) < CERTAIN * down && length(v->entries, v->weighed) < CERTAIN * down;
}

static void keep_best(solver *v, double error)
{
    ++v->idle;
    if (!(error < v->best)) return;
    if (error < 0.5 * v->best) v->idle = 0;
    v->best = error;
    memcpy(v->best_x, v->x, v->n * sizeof *v->x);
    memcpy(v->best_z, v->z, v->entries * sizeof *v->z);
}

static void iterate(solver *v, hci_cone_answer *a)
{
    bool goes_on = begin(v);
    v->best = HUGE_VAL;
    a->end = HCI_CONE_STALLED;
    while (goes_on && v->best > EXACT && a->steps < MOST_STEPS && v->idle < MOST_IDLE) {
        keep_best(v, residuals(v));
        if (v->best > GOOD && is_hopeless(v, &a->end)) {
            memcpy(v->best_x, v->x, v->n * sizeof *v->x);
            memcpy(v->best_z, v->z, v->entries * sizeof *v->z);
            v->best = HUGE_VAL;
            return;
        }
        goes_on = v->best > EXACT && step(v);
        ++a->steps;
    }
    a->end = v->best <= GOOD ? HCI_CONE_SOLVED : HCI_CONE_STALLED;
}

/* ---- all of it ---- */

static void give(const solver *v, hci_cone_answer *a)
{
    hci_null_space_point(&v->space, v->best_x, a->x);
    memcpy(a->z, v->best_z, v->rows * sizeof *a->z);
    for (size_t k = 0; k < v->problem->two_sided; ++k)
        a->z[k] -= v->best_z[v->rows + k];
    a->error = v->best;
    if (v->space.error > GOOD) a->end = HCI_CONE_INFEASIBLE;
}

hci_status hci_cone_solve(const hci_cone_problem *problem, hci_cone_answer *answer, hci_note *note)
{
    solver v;
    hci_status status = make(problem, &v);
    memset(answer, 0, sizeof *answer);
    answer->x = hci_memory_new(problem->unknowns, sizeof *answer->x);
    answer->z = hci_memory_new(problem->rows, sizeof *answer->z);
    if (status || !answer->x || !answer->z)
        status = hci_note_memory(note, NULL, "a program of %zu unknowns", problem->unknowns);
    if (!status) {
        iterate(&v, answer);
        give(&v, answer);
    }
    release(&v);
    return status;
}

void hci_cone_answer_release(hci_cone_answer *answer)
{
    hci_memory_free(answer->x);
    hci_memory_free(answer->z);
    memset(answer, 0, sizeof *answer);
}
