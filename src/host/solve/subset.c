/* The best subset of candidates by least squares: f(S) = ‖U_S x − h‖² + ρ‖x‖² with G = UᵀU, b = Uᵀh. Backward
 * elimination by exact costs, then exchanges. Each component is a 2×2 block of G. */
#include <math.h>
#include <string.h>

#include "hci/math/dense.h"
#include "host/solve/choose.h"

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

/* The inverse P of G_S + ρI and x = P b_S for the subset S = active[0 … count). p: 2count × 2count; work as
 * large. */
static hci_status subset_inverse(const hci_subset_cost *c, const size_t *active, size_t count, double *p,
                                 double *x, double *work)
{
    const size_t m = 2 * count;
    for (size_t j = 0; j < m; ++j)
        for (size_t i = 0; i < m; ++i)
            work[i + j * m] = c->gram[2 * active[i / 2] + i % 2 + (2 * active[j / 2] + j % 2) * c->n] +
                              (i == j ? c->ridge : 0.0);
    if (spd_inverse(m, work, p) != HCI_OK) return HCI_ERROR_SINGULAR;
    for (size_t i = 0; i < m; ++i) {
        x[i] = 0.0;
        for (size_t j = 0; j < m; ++j)
            x[i] += p[i + j * m] * c->b[2 * active[j / 2] + j % 2];
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

/* From all candidates down to `most`, each time leaving out the component that costs least. */
hci_status hci_subset_eliminate(const hci_subset_cost *c, size_t most, hci_subset_workspace *room)
{
    const size_t candidates_left = c->n / 2;
    size_t kept = 0;
    for (size_t k = 0; k < candidates_left; ++k) {
        room->active[k] = k;
        room->in[k] = true;
    }
    if (subset_inverse(c, room->active, candidates_left, room->p, room->x, room->work))
        return HCI_ERROR_NUMERIC;
    for (size_t left = candidates_left; left > most; --left) {
        double least = INFINITY;
        size_t victim = 0;
        for (size_t k = 0; k < candidates_left; ++k) {
            const double cost = room->in[k] ? removal_cost(room->p, c->n, room->x, k) : HUGE_VAL;
            if (cost < least) {
                least = cost;
                victim = k;
            }
        }
        remove_component(room->p, c->n, room->x, victim, room->v);
        room->in[victim] = false;
    }
    for (size_t k = 0; k < candidates_left; ++k)
        if (room->in[k]) room->active[kept++] = k;
    return HCI_OK;
}

/* Bringing candidate j into S: v = P G_Sj, s = (G_jj + ρI − G_jS v)⁻¹, y = s (b_j − G_jS x); f falls by yᵀ
 * s⁻¹ y. */
typedef struct {
    block s;
    double y0, y1, gain;
} entry;

static entry enter(const hci_subset_cost *c, const hci_subset_workspace *room, size_t count, size_t j)
{
    const size_t m = 2 * count, n = c->n;
    const double *g0 = c->gram + 2 * j * n, *g1 = g0 + n;
    double *v = room->v;
    block schur = {g0[2 * j] + c->ridge, g0[2 * j + 1], g1[2 * j + 1] + c->ridge};
    double r0 = c->b[2 * j], r1 = c->b[2 * j + 1];
    entry e;
    for (size_t i = 0; i < 2 * m; ++i)
        v[i] = 0.0;
    for (size_t k = 0; k < m; ++k) {
        const size_t row = 2 * room->active[k / 2] + k % 2;
        if (g0[row] == 0.0 && g1[row] == 0.0) continue;
        for (size_t i = 0; i < m; ++i)
            v[i] += room->p[i + k * m] * g0[row];
        for (size_t i = 0; i < m; ++i)
            v[m + i] += room->p[i + k * m] * g1[row];
    }
    for (size_t k = 0; k < m; ++k) {
        const size_t row = 2 * room->active[k / 2] + k % 2;
        schur.xx -= g0[row] * v[k];
        schur.xy -= g0[row] * v[m + k];
        schur.yy -= g1[row] * v[m + k];
        r0 -= g0[row] * room->x[k];
        r1 -= g1[row] * room->x[k];
    }
    e.s = block_inverse(schur);
    e.y0 = e.s.xx * r0 + e.s.xy * r1;
    e.y1 = e.s.xy * r0 + e.s.yy * r1;
    e.gain = r0 * e.y0 + r1 * e.y1;
    return e;
}

/* What leaving out member i costs once j is in: P and x with j are P_ii + v_i s v_iᵀ and x_i − v_i y. */
static double removal_cost_after(const hci_subset_workspace *room, size_t m, const entry *e, size_t i)
{
    const double *v = room->v;
    const double a0 = v[2 * i], a1 = v[2 * i + 1], b0 = v[m + 2 * i], b1 = v[m + 2 * i + 1];
    block p = block_of(room->p, m, i);
    p.xx += e->s.xx * a0 * a0 + 2.0 * e->s.xy * a0 * b0 + e->s.yy * b0 * b0;
    p.xy += e->s.xx * a0 * a1 + e->s.xy * (a0 * b1 + a1 * b0) + e->s.yy * b0 * b1;
    p.yy += e->s.xx * a1 * a1 + 2.0 * e->s.xy * a1 * b1 + e->s.yy * b1 * b1;
    return block_form(block_inverse(p), room->x[2 * i] - a0 * e->y0 - b0 * e->y1,
                      room->x[2 * i + 1] - a1 * e->y0 - b1 * e->y1);
}

/* The exchange of a member for a candidate that lowers f most; 0 when none does. */
static double best_exchange(const hci_subset_cost *c, const hci_subset_workspace *room, size_t count,
                            size_t *out, size_t *in)
{
    double best = 0.0;
    for (size_t j = 0; j < c->n / 2; ++j) {
        if (room->in[j]) continue;
        const entry e = enter(c, room, count, j);
        for (size_t i = 0; i < count; ++i) {
            const double change = removal_cost_after(room, 2 * count, &e, i) - e.gain;
            if (change >= best) continue;
            best = change;
            *out = i;
            *in = j;
        }
    }
    return best;
}

static double subset_value(const hci_subset_cost *c, const hci_subset_workspace *room, size_t count)
{
    double gained = 0.0;
    for (size_t k = 0; k < 2 * count; ++k)
        gained += c->b[2 * room->active[k / 2] + k % 2] * room->x[k];
    return gained;
}

/* Exchanges until none lowers f by more than rounding; at most 20 per member. */
hci_status hci_subset_exchange(const hci_subset_cost *c, hci_subset_workspace *room, size_t count)
{
    for (size_t round = 0; round < 20 * count; ++round) {
        size_t out = 0, in = 0;
        if (subset_inverse(c, room->active, count, room->p, room->x, room->work)) return HCI_ERROR_NUMERIC;
        if (best_exchange(c, room, count, &out, &in) >= -1e-10 * subset_value(c, room, count)) break;
        room->in[room->active[out]] = false;
        room->in[in] = true;
        room->active[out] = in;
    }
    return HCI_OK;
}
