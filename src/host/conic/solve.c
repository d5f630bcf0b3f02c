/* Primal–dual interior point with the scaling of Nesterov and Todd and Mehrotra's predictor and corrector
 * (theory.md, section 15): where it begins, its steps, and when it ends. state.c has eliminated the
 * equations; direction.c solves for each step. */
#include "host/conic/solve.h"

#include <math.h>
#include <string.h>

#include "core/math/vector.h"
#include "host/base/memory.h"
#include "host/conic/direction.h"

enum {
    MOST_STEPS = 150,
    MOST_IDLE = 60, /* steps in which the error is not halved */
    FEW_IDLE = 3,   /* the same where rounding is all that is left */
    MOST_SHORTER = 20,
    REFINEMENTS = 2 /* of a direction that is taken */
};

#define EXACT       1e-10 /* relative residuals and gap at which it ends at the latest */
#define GOOD        1e-7  /* and below which the best point is called solved */
#define ROUNDED     1e-8  /* and below which rounding may be all that is left */
#define CERTAIN     1e-8  /* relative residual of a proof that there is no solution */
#define TO_BOUNDARY 0.99  /* share of the way to the boundary */
#define CENTRED     1e-3  /* share of the mean product of s and z below which none may fall */
#define SHORTER     0.9   /* by which a step is shortened for that */

/* The largest step, at most 1/TO_BOUNDARY, that keeps both s and z inside. */
static double longest_step(const hci_cone_state *v)
{
    return hci_cone_step(&v->cone, v->z, v->dz, hci_cone_step(&v->cone, v->s, v->ds, 1.0 / TO_BOUNDARY));
}

static double gap_at(const hci_cone_state *v, double step)
{
    double sum = 0.0;
    for (size_t k = 0; k < v->entries; ++k)
        sum += (v->s[k] + step * v->ds[k]) * (v->z[k] + step * v->dz[k]);
    return sum;
}

/* d = −λ∘λ */
static void predict(hci_cone_state *v)
{
    hci_cone_product(&v->cone, v->scaling.point, v->scaling.point, v->ds);
    for (size_t k = 0; k < v->entries; ++k)
        v->ds[k] = -v->ds[k];
    hci_cone_direction(v, 1.0, 0);
}

/* d = −λ∘λ − (W⁻¹ds)∘(W dz) + σμ e, of the direction predicted. */
static void correct(hci_cone_state *v, double sigma, double mu)
{
    hci_cone_apply(&v->scaling, 1, v->ds, v->affine_s);
    hci_cone_apply(&v->scaling, 0, v->dz, v->affine_z);
    hci_cone_product(&v->cone, v->affine_s, v->affine_z, v->ds);
    hci_cone_product(&v->cone, v->scaling.point, v->scaling.point, v->dz);
    for (size_t k = 0; k < v->entries; ++k)
        v->ds[k] = -v->ds[k] - v->dz[k];
    hci_cone_add_unit(&v->cone, sigma * mu, v->ds);
    hci_cone_direction(v, 1.0 - sigma, REFINEMENTS);
}

/* The longest step after which no product s·z is far below the mean of all, for from there the next steps
 * would be short. */
static double centred_step(const hci_cone_state *v)
{
    const double *const s[2] = {v->s, v->ds}, *const z[2] = {v->z, v->dz};
    double step = fmin(1.0, TO_BOUNDARY * longest_step(v));
    for (int k = 0; k < MOST_SHORTER; ++k, step *= SHORTER)
        if (hci_cone_least_product(&v->cone, s, z, step) >= CENTRED * gap_at(v, step) / (double)v->degree)
            break;
    return step;
}

static double move(hci_cone_state *v)
{
    const double step = centred_step(v);
    hci_vector_add(v->n, step, v->dx, v->x);
    hci_vector_add(v->entries, step, v->ds, v->s);
    hci_vector_add(v->entries, step, v->dz, v->z);
    return step;
}

static bool step(hci_cone_state *v)
{
    const double mu = gap_at(v, 0.0) / (double)v->degree;
    double share, length;
    hci_cone_scale(&v->scaling, v->s, v->z);
    if (!hci_vector_finite(v->entries, v->scaling.w) || !hci_cone_normal_factor(v)) return false;
    predict(v);
    length = fmin(1.0, longest_step(v));
    share = fmax(0.0, gap_at(v, length) / (mu * (double)v->degree));
    correct(v, fmin(1.0, share * share * share), mu);
    return hci_vector_finite(v->n, v->dx) && move(v) > 1e-10;
}

/* ---- where it begins and ends ---- */

/* W = 1 */
static void scale_by_one(const hci_cone_state *v)
{
    for (size_t k = 0; k < v->entries; ++k)
        v->scaling.w[k] = 1.0;
    for (size_t k = 0, at = v->cone.linear; k < v->cone.cones; at += v->cone.size[k++]) {
        v->scaling.eta[k] = 1.0;
        memset(v->scaling.w + at + 1, 0, (v->cone.size[k] - 1) * sizeof *v->scaling.w);
    }
}

static void move_inside(const hci_cone *cone, double *u)
{
    const double depth = hci_cone_depth(cone, u);
    if (depth > -1e-3) hci_cone_add_unit(cone, 1.0 + depth, u);
}

/* The point with the least |s|, moved into the cone. */
static bool begin(hci_cone_state *v)
{
    scale_by_one(v);
    if (!hci_cone_normal_factor(v)) return false;
    for (size_t j = 0; j < v->n; ++j)
        v->right[j] = -v->c[j];
    hci_cone_multiply_transposed(v, v->h, v->right);
    hci_cone_normal_solve(v);
    memcpy(v->x, v->dx, v->n * sizeof *v->x);
    hci_cone_multiply(v, v->x, v->z);
    for (size_t k = 0; k < v->entries; ++k) {
        v->z[k] -= v->h[k];
        v->s[k] = -v->z[k];
    }
    move_inside(&v->cone, v->s);
    move_inside(&v->cone, v->z);
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
static double residuals(hci_cone_state *v)
{
    const double gap = gap_at(v, 0.0);
    double objective;
    hci_cone_multiply_p(v, v->x, v->rx);
    objective = 0.5 * hci_vector_dot(v->n, v->x, v->rx) + hci_vector_dot(v->n, v->c, v->x);
    memset(v->gradient, 0, v->n * sizeof *v->gradient);
    hci_cone_multiply_transposed(v, v->z, v->gradient);
    for (size_t j = 0; j < v->n; ++j)
        v->rx[j] += v->gradient[j] + v->c[j];
    hci_cone_multiply(v, v->x, v->rs);
    for (size_t k = 0; k < v->entries; ++k)
        v->rs[k] += v->s[k] - v->h[k];
    return fmax(fmax(length(v->n, v->rx) / fmax(fmax(1.0, length(v->n, v->c)), largest(v->entries, v->z)),
                     length(v->entries, v->rs) / fmax(1.0, length(v->entries, v->h))),
                gap / fmax(1.0, fabs(objective)));
}

/* Whether z proves that no x keeps all rows, or x that the objective has no end. */
static bool is_hopeless(hci_cone_state *v, hci_cone_end *end)
{
    const double against = -hci_vector_dot(v->entries, v->h, v->z), down = -hci_vector_dot(v->n, v->c, v->x);
    if (against > 0.0 && length(v->n, v->gradient) < CERTAIN * against) {
        *end = HCI_CONE_INFEASIBLE;
        return true;
    }
    if (!(down > 0.0)) return false;
    hci_cone_multiply_p(v, v->x, v->right);
    hci_cone_multiply(v, v->x, v->weighed);
    hci_vector_add(v->entries, 1.0, v->s, v->weighed);
    *end = HCI_CONE_UNBOUNDED;
    return length(v->n, v->right) < CERTAIN * down && length(v->entries, v->weighed) < CERTAIN * down;
}

static void keep_best(hci_cone_state *v, double error)
{
    ++v->idle;
    if (!(error < v->best)) return;
    if (error < 0.5 * v->best) v->idle = 0;
    v->best = error;
    memcpy(v->best_x, v->x, v->n * sizeof *v->x);
    memcpy(v->best_z, v->z, v->entries * sizeof *v->z);
}

static bool is_idle(const hci_cone_state *v)
{
    return v->idle >= (v->best > ROUNDED ? MOST_IDLE : FEW_IDLE);
}

static void iterate(hci_cone_state *v, hci_cone_answer *a)
{
    const double enough = fmax(EXACT, v->problem->precision);
    bool goes_on = begin(v);
    v->best = HUGE_VAL;
    a->end = HCI_CONE_STALLED;
    while (goes_on && v->best > enough && a->steps < MOST_STEPS && !is_idle(v)) {
        keep_best(v, residuals(v));
        if (v->best > GOOD && is_hopeless(v, &a->end)) {
            memcpy(v->best_x, v->x, v->n * sizeof *v->x);
            memcpy(v->best_z, v->z, v->entries * sizeof *v->z);
            v->best = HUGE_VAL;
            return;
        }
        goes_on = v->best > enough && step(v);
        ++a->steps;
    }
    a->end = v->best <= fmax(GOOD, enough) ? HCI_CONE_SOLVED : HCI_CONE_STALLED;
}

/* ---- all of it ---- */

static void give(const hci_cone_state *v, hci_cone_answer *a)
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
    hci_cone_state v;
    hci_status status = hci_cone_state_make(problem, &v);
    memset(answer, 0, sizeof *answer);
    answer->x = hci_memory_new(problem->unknowns, sizeof *answer->x);
    answer->z = hci_memory_new(problem->rows, sizeof *answer->z);
    if (status || !answer->x || !answer->z)
        status = hci_note_memory(note, NULL, "a program of %zu unknowns", problem->unknowns);
    if (!status) {
        iterate(&v, answer);
        give(&v, answer);
    }
    hci_cone_state_release(&v);
    return status;
}

void hci_cone_answer_release(hci_cone_answer *answer)
{
    hci_memory_free(answer->x);
    hci_memory_free(answer->z);
    memset(answer, 0, sizeof *answer);
}
