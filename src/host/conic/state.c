#include "host/conic/state.h"

#include <string.h>

#include "core/math/vector.h"
#include "host/base/memory.h"

enum {
    VECTORS = 13,
    UNKNOWNS = 7,
    LEAST_BALL = 16 /* rows of a cone for which a product once does less than one in each step */
};

/* ---- products with the two-sided G ---- */

void hci_cone_multiply(const hci_cone_state *v, const double *x, double *y)
{
    memset(y, 0, v->entries * sizeof *y);
    for (size_t j = 0; j < v->n; ++j)
        hci_vector_add(v->rows, x[j], v->g + j * v->rows, y);
    for (size_t k = 0; k < v->problem->two_sided; ++k)
        y[v->rows + k] = -y[k];
}

void hci_cone_multiply_transposed(const hci_cone_state *v, const double *u, double *y)
{
    double *folded = v->product;
    memcpy(folded, u, v->rows * sizeof *u);
    for (size_t k = 0; k < v->problem->two_sided; ++k)
        folded[k] -= u[v->rows + k];
    for (size_t j = 0; j < v->n; ++j)
        y[j] += hci_vector_dot(v->rows, v->g + j * v->rows, folded);
}

void hci_cone_multiply_p(const hci_cone_state *v, const double *x, double *y)
{
    memset(y, 0, v->n * sizeof *y);
    for (size_t j = 0; v->p && j < v->n; ++j)
        hci_vector_add(v->n, x[j], v->p + j * v->n, y);
}

/* ---- room ---- */

/* Where vectors of `entries` numbers go in the block; behind them. */
static double *place_vectors(hci_cone_state *v, double *at)
{
    double **const vector[VECTORS] = {
        &v->h,        &v->s,       &v->z,       &v->rs,     &v->ds,        &v->dz,           &v->affine_s,
        &v->affine_z, &v->weighed, &v->product, &v->best_z, &v->scaling.w, &v->scaling.point};
    for (size_t k = 0; k < VECTORS; ++k)
        *vector[k] = at + k * v->entries;
    return at + VECTORS * v->entries;
}

/* The same of one number for each unknown. */
static double *place_unknowns(hci_cone_state *v, double *at)
{
    double **const unknown[UNKNOWNS] = {&v->c, &v->x, &v->rx, &v->dx, &v->right, &v->gradient, &v->best_x};
    for (size_t k = 0; k < UNKNOWNS; ++k)
        *unknown[k] = at + k * v->n;
    return at + UNKNOWNS * v->n;
}

static bool reserve(hci_cone_state *v)
{
    const size_t n = v->n, cones = v->problem->cones, gn = v->rows * n;
    v->block = hci_memory_new(VECTORS * v->entries + UNKNOWNS * n + cones + 3 * n * n + 2 * gn + 4 * n + 1,
                              sizeof *v->block);
    if (!v->block) return false;
    v->scaling.eta = place_unknowns(v, place_vectors(v, v->block));
    v->normal = v->scaling.eta + cones;
    v->factor = v->normal + n * n;
    v->p = v->factor + n * n;
    v->g = v->p + n * n;
    v->scaled = v->g + gn;
    v->few = v->scaled + gn;
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
static void reduce_objective(hci_cone_state *v, double *pz)
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

static void reduce_rows(hci_cone_state *v)
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

/* ---- balls ---- */

static bool is_ball(const hci_cone_state *v, size_t head, size_t rows)
{
    for (size_t j = 0; rows >= LEAST_BALL && j < v->n; ++j)
        if (v->g[head + j * v->rows] != 0.0) return false;
    return rows >= LEAST_BALL;
}

/* The lower triangle of GᵀG; NULL when memory is out. */
static double *gram_of(const hci_cone_state *v, size_t head, size_t rows)
{
    double *gram = hci_memory_new(v->n * v->n, sizeof *gram);
    for (size_t j = 0; gram && j < v->n; ++j)
        for (size_t i = j; i < v->n; ++i)
            gram[i + j * v->n] = hci_vector_dot(rows, v->g + head + i * v->rows, v->g + head + j * v->rows);
    return gram;
}

static bool make_balls(hci_cone_state *v)
{
    const hci_cone *c = &v->cone;
    size_t at = c->linear;
    v->ball = hci_memory_new(c->cones + 1, sizeof *v->ball);
    if (!v->ball) return false;
    for (size_t k = 0; k < c->cones; at += c->size[k++]) {
        if (!is_ball(v, at, c->size[k])) continue;
        v->ball[k] = gram_of(v, at, c->size[k]);
        if (!v->ball[k]) return false;
    }
    return true;
}

/* ---- all of it ---- */

static void take_sizes(const hci_cone_problem *q, hci_cone_state *v)
{
    v->cone = (hci_cone){q->linear, q->cones, q->two_sided, q->cone, 0};
    v->scaling.cone = &v->cone;
    v->degree = hci_cone_degree(&v->cone);
    v->n = v->space.free;
    v->rows = q->rows;
    v->entries = v->cone.entries;
}

hci_status hci_cone_state_make(const hci_cone_problem *q, hci_cone_state *v)
{
    double *pz;
    bool has_memory;
    memset(v, 0, sizeof *v);
    v->problem = q;
    if (hci_null_space_make(q->equalities, q->unknowns, q->a, q->b, &v->space)) return HCI_ERROR_MEMORY;
    take_sizes(q, v);
    pz = hci_memory_new(q->unknowns * v->n, sizeof *pz);
    has_memory = pz && reserve(v);
    if (has_memory) {
        reduce_objective(v, pz);
        reduce_rows(v);
        has_memory = make_balls(v);
    }
    hci_memory_free(pz);
    return has_memory ? HCI_OK : HCI_ERROR_MEMORY;
}

void hci_cone_state_release(hci_cone_state *v)
{
    for (size_t k = 0; v->ball && k < v->cone.cones; ++k)
        hci_memory_free(v->ball[k]);
    hci_memory_free(v->ball);
    hci_null_space_release(&v->space);
    hci_memory_free(v->block);
}
