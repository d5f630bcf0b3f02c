/* The best subset of candidates by least squares: f(S) = ‖U_S x − h‖² + ρ‖x‖² with G = UᵀU, b = Uᵀh. In: a
 * harmonic system of all candidates and a price of copper ρ; out: the members of a subset of a given size.
 * Backward elimination by exact costs, then exchanges; both update the inverse P of G_S + ρI rather than
 * solve anew. Each component is a 2×2 block of G. */
#include "host/solve/subset.h"

#include <math.h>
#include <string.h>

#include "hci/math/dense.h"
#include "host/base/memory.h"

enum { MOST_ROUNDS = 20 }; /* exchanges for each member */

#define ROUNDING 1e-10 /* share of the cost; an exchange that brings less is rounding */

typedef struct {
    double xx, xy, yy; /* symmetric [xx xy; xy yy] */
} block;

static block block_inverse(block m)
{
    const double determinant = m.xx * m.yy - m.xy * m.xy;
    const block inverse = {m.yy / determinant, -m.xy / determinant, m.xx / determinant};
    return inverse;
}

/* vᵀ M v */
static double block_form(block m, double x, double y)
{
    return m.xx * x * x + 2.0 * m.xy * x * y + m.yy * y * y;
}

/* Inverse of a symmetric positive definite n×n matrix by Cholesky. a: in the matrix (lower triangle),
 * destroyed. */
static hci_status spd_inverse(size_t n, double *a, double *inverse)
{
    const hci_status status = hci_cholesky_factor(n, a);
    if (status) return status;
    for (size_t j = 0; j < n; ++j) {
        double *column = inverse + j * n;
        for (size_t i = 0; i < n; ++i)
            column[i] = i == j ? 1.0 : 0.0;
        hci_cholesky_solve(n, a, column);
    }
    return HCI_OK;
}

/* The inverse P of G_S + ρI and x = P b_S for the members S. */
static hci_status subset_inverse(hci_subset_search *s)
{
    const size_t m = 2 * s->count;
    for (size_t j = 0; j < m; ++j)
        for (size_t i = 0; i < m; ++i)
            s->work[i + j * m] =
                s->gram[2 * s->member[i / 2] + i % 2 + (2 * s->member[j / 2] + j % 2) * s->n] +
                (i == j ? s->ridge : 0.0);
    if (spd_inverse(m, s->work, s->p)) return HCI_ERROR_NUMERIC;
    for (size_t i = 0; i < m; ++i) {
        s->x[i] = 0.0;
        for (size_t j = 0; j < m; ++j)
            s->x[i] += s->p[i + j * m] * s->b[2 * s->member[j / 2] + j % 2];
    }
    return HCI_OK;
}

/* The block of P that belongs to component k of the subset. */
static block block_of(const double *p, size_t m, size_t k)
{
    const block b = {p[2 * k + 2 * k * m], p[2 * k + 1 + 2 * k * m], p[2 * k + 1 + (2 * k + 1) * m]};
    return b;
}

/* Leaving out component k raises f by x_kᵀ (P_kk)⁻¹ x_k. */
static double removal_cost(const double *p, size_t m, const double *x, size_t k)
{
    return block_form(block_inverse(block_of(p, m, k)), x[2 * k], x[2 * k + 1]);
}

/* P ← P − P_:k (P_kk)⁻¹ P_k:,  x ← x − P_:k (P_kk)⁻¹ x_k: row and column k become zero. v: workspace of
 * 2m. */
static void remove_component(double *p, size_t m, double *x, size_t k, double *v)
{
    const block inverse = block_inverse(block_of(p, m, k));
    const double x0 = x[2 * k], x1 = x[2 * k + 1];
    memcpy(v, p + 2 * k * m, 2 * m * sizeof *v);
    for (size_t j = 0; j < m; ++j) {
        const double w0 = inverse.xx * v[j] + inverse.xy * v[m + j],
                     w1 = inverse.xy * v[j] + inverse.yy * v[m + j];
        for (size_t i = 0; i < m; ++i)
            p[i + j * m] -= v[i] * w0 + v[m + i] * w1;
        x[j] -= w0 * x0 + w1 * x1;
    }
}

/* The candidate that is in and costs least to leave out; P and x are those of all candidates. */
static size_t cheapest(const hci_subset_search *s)
{
    double least = INFINITY;
    size_t found = 0;
    for (size_t k = 0; k < s->n / 2; ++k) {
        const double cost = s->is_in[k] ? removal_cost(s->p, s->n, s->x, k) : HUGE_VAL;
        if (cost < least) {
            least = cost;
            found = k;
        }
    }
    return found;
}

hci_status hci_subset_eliminate(hci_subset_search *s, size_t most)
{
    const size_t candidates = s->n / 2;
    s->count = candidates;
    for (size_t k = 0; k < candidates; ++k) {
        s->member[k] = k;
        s->is_in[k] = true;
    }
    if (subset_inverse(s)) return HCI_ERROR_NUMERIC;
    for (size_t left = candidates; left > most; --left) {
        const size_t out = cheapest(s);
        remove_component(s->p, s->n, s->x, out, s->v);
        s->is_in[out] = false;
    }
    s->count = 0;
    for (size_t k = 0; k < candidates; ++k)
        if (s->is_in[k]) s->member[s->count++] = k;
    return HCI_OK;
}

/* Bringing candidate j into S: v = P G_Sj, s = (G_jj + ρI − G_jS v)⁻¹, y = s (b_j − G_jS x); f falls by yᵀ
 * s⁻¹ y. */
typedef struct {
    block s;
    double y0, y1;
    double fall; /* of f */
} entry;

/* v = P G_Sj, two columns of 2·count. Most of G_Sj is zero. */
static void entry_direction(const hci_subset_search *s, const double *g0, const double *g1)
{
    const size_t m = 2 * s->count;
    double *v = s->v;
    for (size_t i = 0; i < 2 * m; ++i)
        v[i] = 0.0;
    for (size_t k = 0; k < m; ++k) {
        const size_t row = 2 * s->member[k / 2] + k % 2;
        if (g0[row] == 0.0 && g1[row] == 0.0) continue;
        for (size_t i = 0; i < m; ++i)
            v[i] += s->p[i + k * m] * g0[row];
        for (size_t i = 0; i < m; ++i)
            v[m + i] += s->p[i + k * m] * g1[row];
    }
}

static entry enter(const hci_subset_search *s, size_t j)
{
    const size_t m = 2 * s->count;
    const double *g0 = s->gram + 2 * j * s->n, *g1 = g0 + s->n, *v = s->v;
    block schur = {g0[2 * j] + s->ridge, g0[2 * j + 1], g1[2 * j + 1] + s->ridge};
    double r0 = s->b[2 * j], r1 = s->b[2 * j + 1];
    entry e;
    entry_direction(s, g0, g1);
    for (size_t k = 0; k < m; ++k) {
        const size_t row = 2 * s->member[k / 2] + k % 2;
        schur.xx -= g0[row] * v[k];
        schur.xy -= g0[row] * v[m + k];
        schur.yy -= g1[row] * v[m + k];
        r0 -= g0[row] * s->x[k];
        r1 -= g1[row] * s->x[k];
    }
    e.s = block_inverse(schur);
    e.y0 = e.s.xx * r0 + e.s.xy * r1;
    e.y1 = e.s.xy * r0 + e.s.yy * r1;
    e.fall = r0 * e.y0 + r1 * e.y1;
    return e;
}

/* What leaving out member i costs once j is in: P and x with j are P_ii + v_i s v_iᵀ and x_i − v_i y. */
static double removal_cost_after(const hci_subset_search *search, const entry *e, size_t i)
{
    const size_t m = 2 * search->count;
    const double *v = search->v, *x = search->x;
    const double a0 = v[2 * i], a1 = v[2 * i + 1], b0 = v[m + 2 * i], b1 = v[m + 2 * i + 1];
    block p = block_of(search->p, m, i);
    p.xx += e->s.xx * a0 * a0 + 2.0 * e->s.xy * a0 * b0 + e->s.yy * b0 * b0;
    p.xy += e->s.xx * a0 * a1 + e->s.xy * (a0 * b1 + a1 * b0) + e->s.yy * b0 * b1;
    p.yy += e->s.xx * a1 * a1 + 2.0 * e->s.xy * a1 * b1 + e->s.yy * b1 * b1;
    return block_form(block_inverse(p), x[2 * i] - a0 * e->y0 - b0 * e->y1,
                      x[2 * i + 1] - a1 * e->y0 - b1 * e->y1);
}

/* The exchange of a member for a candidate that lowers f most; returns the change, 0 when none does. */
static double best_exchange(const hci_subset_search *s, size_t *out, size_t *in)
{
    double best = 0.0;
    for (size_t j = 0; j < s->n / 2; ++j) {
        if (s->is_in[j]) continue;
        const entry e = enter(s, j);
        for (size_t i = 0; i < s->count; ++i) {
            const double change = removal_cost_after(s, &e, i) - e.fall;
            if (change >= best) continue;
            best = change;
            *out = i;
            *in = j;
        }
    }
    return best;
}

/* bᵀx: by how much f is less than with no component at all. */
static double explained(const hci_subset_search *s)
{
    double sum = 0.0;
    for (size_t k = 0; k < 2 * s->count; ++k)
        sum += s->b[2 * s->member[k / 2] + k % 2] * s->x[k];
    return sum;
}

hci_status hci_subset_exchange(hci_subset_search *s)
{
    for (size_t round = 0; round < MOST_ROUNDS * s->count; ++round) {
        size_t out = 0, in = 0;
        if (subset_inverse(s)) return HCI_ERROR_NUMERIC;
        if (best_exchange(s, &out, &in) >= -ROUNDING * explained(s)) break;
        s->is_in[s->member[out]] = false;
        s->is_in[in] = true;
        s->member[out] = in;
    }
    return HCI_OK;
}

/* ---- G and b ---- */

/* Column j of G and entry j of b from sparse columns. column: rows zeros, the same after. */
static void fill_column(const hci_harmonic_system *system, double mean_Nm, size_t j, hci_subset_search *s,
                        double *column)
{
    const hci_sparse *u = &system->u;
    s->b[j] = 0.0;
    for (int64_t k = u->column_start[j]; k < u->column_start[j + 1]; ++k) {
        const size_t row = (size_t)u->row[k];
        column[row] = u->value[k];
        s->b[j] += u->value[k] * (mean_Nm * system->h[row] + system->h[system->rows + row]);
    }
    for (size_t i = 0; i < s->n; ++i) {
        double sum = 0.0;
        for (int64_t k = u->column_start[i]; k < u->column_start[i + 1]; ++k)
            sum += u->value[k] * column[u->row[k]];
        s->gram[i + j * s->n] = sum;
    }
    s->scale = fmax(s->scale, s->gram[j + j * s->n]);
    for (int64_t k = u->column_start[j]; k < u->column_start[j + 1]; ++k)
        column[u->row[k]] = 0.0;
}

static bool reserve(size_t n, hci_subset_search *s)
{
    memset(s, 0, sizeof *s);
    s->n = n;
    s->gram = hci_memory_new(n * n, sizeof *s->gram);
    s->b = hci_memory_new(n, sizeof *s->b);
    s->p = hci_memory_new(n * n, sizeof *s->p);
    s->work = hci_memory_new(n * n, sizeof *s->work);
    s->x = hci_memory_new(n, sizeof *s->x);
    s->v = hci_memory_new(2 * n, sizeof *s->v);
    s->member = hci_memory_new(n, sizeof *s->member);
    s->is_in = hci_memory_new(n, sizeof *s->is_in);
    return s->gram && s->b && s->p && s->work && s->x && s->v && s->member && s->is_in;
}

hci_status hci_subset_search_make(const hci_harmonic_system *system, double mean_Nm,
                                  hci_subset_search *search, hci_note *note)
{
    double *column = hci_memory_new(system->rows, sizeof *column);
    const bool has_memory = reserve(system->unknowns, search) && column;
    for (size_t j = 0; j < search->n && has_memory; ++j)
        fill_column(system, mean_Nm, j, search, column);
    hci_memory_free(column);
    return has_memory ? HCI_OK : hci_note_memory(note, NULL, "choosing harmonics");
}

void hci_subset_search_release(hci_subset_search *s)
{
    hci_memory_free(s->gram);
    hci_memory_free(s->b);
    hci_memory_free(s->p);
    hci_memory_free(s->work);
    hci_memory_free(s->x);
    hci_memory_free(s->v);
    hci_memory_free(s->member);
    hci_memory_free(s->is_in);
    memset(s, 0, sizeof *s);
}
