#include "host/conic/direction.h"

#include <math.h>
#include <string.h>

#include "core/math/vector.h"
#include "hci/math/dense.h"

/* ---- the normal equations ---- */

/* Weights of the linear rows; a two-sided one has that of both its sides. */
static void weigh_linear(const hci_cone_state *v)
{
    const double *w = v->scaling.w;
    for (size_t k = 0; k < v->cone.linear; ++k) {
        const double below = k < v->cone.after ? 1.0 / w[v->rows + k] : 0.0;
        v->weighed[k] = sqrt(1.0 / (w[k] * w[k]) + below * below);
    }
}

/* v->scaled = W⁻¹ G */
static void scale_rows(hci_cone_state *v)
{
    const hci_cone *c = &v->cone;
    weigh_linear(v);
    for (size_t j = 0; j < v->n; ++j) {
        double *column = v->scaled + j * v->rows;
        const double *g = v->g + j * v->rows;
        size_t at = c->linear;
        for (size_t k = 0; k < c->linear; ++k)
            column[k] = v->weighed[k] * g[k];
        memcpy(column + at, g + at, (v->rows - at) * sizeof *g);
        for (size_t k = 0; k < c->cones; at += c->size[k++])
            if (!v->ball[k]) hci_cone_apply_block(&v->scaling, k, at, 1, column + at);
    }
}

/* Adds the products of up to four rows of v->scaled, which begin at `row`, to the lower triangle: four at
 * once so that the triangle is fetched less often. */
static void add_four_rows(hci_cone_state *v, size_t row, size_t end)
{
    const size_t n = v->n, left = end - row < 4 ? end - row : 4;
    double *const few = v->few, *const r0 = few, *const r1 = few + n, *const r2 = r1 + n, *const r3 = r2 + n;
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

static void add_rows(hci_cone_state *v, size_t row, size_t end)
{
    for (; row < end; row += 4)
        add_four_rows(v, row, end);
}

/* A ball brings (2qqᵀ + GᵀG)/η², q = Gᵀw̄ without its head: nothing in it is subtracted. */
static void add_ball(hci_cone_state *v, size_t k, size_t at)
{
    const size_t n = v->n, rows = v->scaling.cone->size[k];
    const double share = 1.0 / (v->scaling.eta[k] * v->scaling.eta[k]), *w = v->scaling.w + at;
    double *q = v->few;
    for (size_t j = 0; j < n; ++j)
        q[j] = hci_vector_dot(rows - 1, w + 1, v->g + at + 1 + j * v->rows);
    for (size_t j = 0; j < n; ++j) {
        double *column = v->normal + j * n;
        hci_vector_add(n - j, share, v->ball[k] + j * n + j, column + j);
        hci_vector_add(n - j, 2.0 * share * q[j], q + j, column + j);
    }
}

/* P + GᵀW⁻²G in the lower triangle. */
static void make_normal(hci_cone_state *v)
{
    const size_t n = v->n;
    const hci_cone *c = &v->cone;
    size_t begin = 0, at = c->linear;
    scale_rows(v);
    memset(v->normal, 0, n * n * sizeof *v->normal);
    if (v->p) memcpy(v->normal, v->p, n * n * sizeof *v->normal);
    for (size_t k = 0; k < c->cones; at += c->size[k++]) {
        if (!v->ball[k]) continue;
        add_rows(v, begin, at);
        add_ball(v, k, at);
        begin = at + c->size[k];
    }
    add_rows(v, begin, v->rows);
}

bool hci_cone_normal_factor(hci_cone_state *v)
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

void hci_cone_normal_solve(const hci_cone_state *v)
{
    memcpy(v->dx, v->right, v->n * sizeof *v->dx);
    hci_cholesky_solve(v->n, v->factor, v->dx);
}

/* ---- one direction ---- */

/* u = W⁻² u */
static void divide_twice(const hci_cone_state *v, double *u)
{
    hci_cone_apply(&v->scaling, 1, u, u);
    hci_cone_apply(&v->scaling, 1, u, u);
}

/* What P dx + Gᵀdz = −share·rx lacks, which rounding in W⁻² makes large near the end, is solved for again. */
static void refine(hci_cone_state *v, double share)
{
    hci_cone_multiply_p(v, v->dx, v->right);
    hci_cone_multiply_transposed(v, v->dz, v->right);
    for (size_t j = 0; j < v->n; ++j)
        v->right[j] = -v->right[j] - share * v->rx[j];
    hci_cholesky_solve(v->n, v->factor, v->right);
    hci_vector_add(v->n, 1.0, v->right, v->dx);
    hci_cone_multiply(v, v->right, v->weighed);
    hci_vector_add(v->entries, -1.0, v->weighed, v->ds);
    divide_twice(v, v->weighed);
    hci_vector_add(v->entries, 1.0, v->weighed, v->dz);
}

/* right = −share·rx − Gᵀ(W⁻²(share·rs + ds)) */
static void fill_right(hci_cone_state *v, double share)
{
    for (size_t k = 0; k < v->entries; ++k)
        v->dz[k] = share * v->rs[k] + v->ds[k];
    divide_twice(v, v->dz);
    for (size_t j = 0; j < v->n; ++j)
        v->right[j] = share * v->rx[j];
    hci_cone_multiply_transposed(v, v->dz, v->right);
    for (size_t j = 0; j < v->n; ++j)
        v->right[j] = -v->right[j];
}

void hci_cone_direction(hci_cone_state *v, double share, int refinements)
{
    hci_cone_divide(&v->cone, v->scaling.point, v->ds, v->ds);
    hci_cone_apply(&v->scaling, 0, v->ds, v->ds); /* W(λ \ d) */
    fill_right(v, share);
    hci_cone_normal_solve(v);
    hci_cone_multiply(v, v->dx, v->weighed);
    for (size_t k = 0; k < v->entries; ++k) { /* dz = W⁻²(G dx + share·rs + W(λ \ d)) */
        v->dz[k] = v->weighed[k] + share * v->rs[k] + v->ds[k];
        v->ds[k] = -share * v->rs[k] - v->weighed[k];
    }
    divide_twice(v, v->dz);
    for (int k = 0; k < refinements; ++k)
        refine(v, share);
}
