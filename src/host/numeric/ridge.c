#include "host/numeric/ridge.h"

#include <math.h>
#include <string.h>

#include "hci/math/dense.h"
#include "host/base/memory.h"
#include "host/numeric/wide.h"

#define REGULAR 1e-12 /* added to a diagonal of 1, so that rounding makes no pivot negative */
#define ALONE   1e-11 /* the same of I − K, where a group alone tells of an unknown */

static void matrix_fill(const hci_condensed *rows, const hci_expectation *expected, hci_ridge *p)
{
    const size_t n = p->n;
    for (size_t k = 0; k < n; ++k) {
        const double d = rows->gram[k * n + k] + expected->precision[k];
        p->scale[k] = isfinite(d) && d > 0.0 ? 1.0 / sqrt(d) : 0.0;
    }
    for (size_t j = 0; j < n; ++j)
        for (size_t i = j; i < n; ++i)
            p->factor[i + j * n] = i == j ? 1.0 + REGULAR : rows->gram[i * n + j] * p->scale[i] * p->scale[j];
}

static void mean_fill(const hci_condensed *rows, const hci_expectation *expected, hci_ridge *p)
{
    for (size_t k = 0; k < p->n; ++k)
        p->mean[k] = (rows->moment[k] + expected->precision[k] * expected->centre[k]) * p->scale[k];
    hci_cholesky_solve(p->n, p->factor, p->mean);
    for (size_t k = 0; k < p->n; ++k)
        p->mean[k] *= p->scale[k];
}

bool hci_ridge_make(const hci_condensed *rows, const hci_expectation *expected, hci_ridge *p)
{
    const size_t n = rows->n;
    memset(p, 0, sizeof *p);
    p->factor = hci_memory_new(n * n + 2 * n + 1, sizeof *p->factor);
    if (!p->factor) return false;
    p->n = n;
    p->scale = p->factor + n * n;
    p->mean = p->scale + n;
    matrix_fill(rows, expected, p);
    if (hci_cholesky_factor(n, p->factor)) {
        hci_ridge_release(p);
        return false;
    }
    mean_fill(rows, expected, p);
    return true;
}

void hci_ridge_release(hci_ridge *p)
{
    hci_memory_free(p->factor);
    memset(p, 0, sizeof *p);
}

/* ---- leaving out ---- */

/* One group on its way: v[n][rank] = L⁻¹ D F; then K = vᵀv, I − K factored, u and e. */
typedef struct {
    const hci_ridge *ridge;
    const hci_condensed_group *group;
    const double *share; /* NULL: nothing of e is without a say */
    double *v, *k, *m, *u, *e;
} leaving;

/* v ← L⁻¹ D F, all columns at once. */
HCI_WIDE static void whiten(const leaving *w)
{
    const size_t n = w->ridge->n, rank = w->group->rank;
    for (size_t i = 0; i < n * rank; ++i)
        w->v[i] = w->group->factor[i] * w->ridge->scale[i / rank];
    for (size_t j = 0; j < n; ++j) {
        const double *l = w->ridge->factor + j * n, *restrict row = w->v + j * rank;
        for (size_t c = 0; c < rank; ++c)
            w->v[j * rank + c] /= l[j];
        for (size_t i = j + 1; i < n; ++i) {
            double *restrict x = w->v + i * rank;
            for (size_t c = 0; c < rank; ++c)
                x[c] -= l[i] * row[c];
        }
    }
}

HCI_WIDE static void products_fill(const leaving *w)
{
    const size_t n = w->ridge->n, rank = w->group->rank;
    memcpy(w->u, w->group->moment, rank * sizeof *w->u);
    for (size_t i = 0; i < n; ++i) {
        const double *v = w->v + i * rank, *f = w->group->factor + i * rank;
        for (size_t a = 0; a < rank; ++a) {
            w->u[a] -= f[a] * w->ridge->mean[i];
            for (size_t b = 0; b <= a; ++b)
                w->k[a + b * rank] += v[a] * v[b];
        }
    }
    for (size_t a = 0; a < rank; ++a)
        for (size_t b = 0; b < a; ++b)
            w->k[b + a * rank] = w->k[a + b * rank];
}

/* e = (I − K)⁻¹ u. False where I − K is singular beyond ALONE. */
static bool errors_find(const leaving *w)
{
    const size_t rank = w->group->rank;
    for (size_t j = 0; j < rank; ++j)
        for (size_t i = 0; i < rank; ++i)
            w->m[i + j * rank] = (i == j ? 1.0 + ALONE : 0.0) - w->k[i + j * rank];
    memcpy(w->e, w->u, rank * sizeof *w->e);
    if (hci_cholesky_factor(rank, w->m)) return false;
    hci_cholesky_solve(rank, w->m, w->e);
    return true;
}

/* eᵀ(I − share)e */
static double told_by_others(const leaving *w)
{
    const size_t rank = w->group->rank;
    double sum = 0.0;
    for (size_t i = 0; i < rank; ++i) {
        double x = w->e[i];
        for (size_t j = 0; w->share && j < rank; ++j)
            x -= w->share[i * rank + j] * w->e[j];
        sum += w->e[i] * x;
    }
    return fmax(0.0, sum);
}

static hci_left_out_group judge(const leaving *w)
{
    const size_t rank = w->group->rank;
    const double beside = w->group->rows - (double)rank,
                 noise = beside >= 1.0 ? w->group->rest / beside : 0.0;
    double square = w->group->rest + told_by_others(w), sum = 0.0, trace = 0.0, squares = 0.0;
    double spread = 0.0, surprise = 0.0;
    for (size_t i = 0; i < rank; ++i) {
        trace += w->k[i + i * rank];
        spread -= 2.0 * log(w->m[i + i * rank]);
        surprise += w->u[i] * w->e[i];
        for (size_t j = 0; j < rank; ++j) {
            sum += w->u[i] * w->k[i + j * rank] * w->e[j];
            squares += w->k[i + j * rank] * w->k[i + j * rank];
        }
    }
    if (!(trace > 0.0)) return (hci_left_out_group){square, NAN, 0.0, noise, spread, surprise};
    return (hci_left_out_group){square, sum / trace, trace * trace / squares, noise, spread, surprise};
}

/* False when memory is out. */
static bool leaving_make(const hci_ridge *p, const hci_condensed_group *group, leaving *w)
{
    const size_t rank = group->rank, n = p->n;
    *w = (leaving){.ridge = p, .group = group};
    w->v = hci_memory_new((n + 2 * rank + 2) * rank + 1, sizeof *w->v);
    if (!w->v) return false;
    w->k = w->v + n * rank;
    w->m = w->k + rank * rank;
    w->u = w->m + rank * rank;
    w->e = w->u + rank;
    whiten(w);
    products_fill(w);
    return true;
}

static bool leave_one(const hci_ridge *p, const hci_condensed_group *group, const double *share,
                      hci_left_out_group *out)
{
    leaving w;
    if (!leaving_make(p, group, &w)) return false;
    w.share = share;
    *out = errors_find(&w) ? judge(&w) : (hci_left_out_group){INFINITY, NAN, 0.0, 0.0, INFINITY, 0.0};
    hci_memory_free(w.v);
    return true;
}

bool hci_ridge_leave_out(const hci_ridge *ridge, const hci_condensed *rows, double *const *share,
                         hci_left_out_group *out)
{
    for (size_t g = 0; g < rows->count; ++g)
        if (hci_watch_stops(rows->watch) ||
            !leave_one(ridge, &rows->group[g], share ? share[g] : NULL, &out[g]))
            return false;
    return true;
}

static double *share_of(const hci_ridge *ridge, const hci_condensed_group *group)
{
    const size_t rank = group->rank;
    leaving w;
    double *share = hci_memory_new(rank * rank + 1, sizeof *share);
    if (!share || !leaving_make(ridge, group, &w)) {
        hci_memory_free(share);
        return NULL;
    }
    memcpy(share, w.k, rank * rank * sizeof *share);
    hci_memory_free(w.v);
    return share;
}

bool hci_ridge_shares(const hci_ridge *ridge, const hci_condensed *rows, double **share)
{
    bool made = true;
    for (size_t g = 0; g < rows->count; ++g) {
        share[g] = made && !hci_watch_stops(rows->watch) ? share_of(ridge, &rows->group[g]) : NULL;
        made = made && share[g];
    }
    for (size_t g = 0; g < rows->count && !made; ++g) {
        hci_memory_free(share[g]);
        share[g] = NULL;
    }
    return made;
}

/* ---- how groups differ ---- */

/* Over the groups that tell something. */
typedef struct {
    double count, mean; /* of s² */
    double noise;       /* f */
    double by_chance;   /* mean variance of s² that noise makes */
    double beyond;      /* τ² */
} scatter;

static double chance_of(const hci_left_out_group *g, const scatter *x)
{
    return 2.0 * x->noise * x->noise * x->mean * x->mean / fmax(1.0, g->directions);
}

static void means_fill(const hci_left_out_group *left, size_t count, scatter *x)
{
    double noise = 0.0;
    for (size_t g = 0; g < count; ++g) {
        if (!isfinite(left[g].misfit)) continue;
        x->mean += left[g].misfit;
        noise += left[g].noise;
        x->count += 1.0;
    }
    x->noise = x->mean > 0.0 ? fmin(1.0, noise / x->mean) : 0.0;
    x->mean /= fmax(1.0, x->count);
}

static void scatter_fill(const hci_left_out_group *left, size_t count, scatter *x)
{
    double square = 0.0;
    for (size_t g = 0; g < count; ++g) {
        if (!isfinite(left[g].misfit)) continue;
        square += (left[g].misfit - x->mean) * (left[g].misfit - x->mean);
        x->by_chance += chance_of(&left[g], x) / x->count;
    }
    x->beyond = fmax(0.0, square / fmax(1.0, x->count - 1.0) - x->by_chance);
}

double hci_group_sizes(const hci_left_out_group *left, size_t count, double *size)
{
    scatter x = {0.0, 0.0, 0.0, 0.0, 0.0};
    means_fill(left, count, &x);
    scatter_fill(left, count, &x);
    for (size_t g = 0; g < count; ++g) {
        const double share = x.beyond > 0.0 ? x.beyond / (x.beyond + chance_of(&left[g], &x)) : 0.0;
        const double square = x.mean + share * (left[g].misfit - x.mean);
        size[g] = isfinite(left[g].misfit) ? sqrt(fmax(0.0, square)) : (double)NAN;
    }
    if (!(x.mean > 0.0)) return 0.0;
    const double lacking = 2.0 * pow((1.0 - x.noise) * x.mean, 2.0);
    return fmax(1.0, 2.0 * x.mean * x.mean * x.count / (fmax(x.beyond, lacking) + x.by_chance));
}

/* ---- draws ---- */

/* mean + s D L⁻ᵀ z */
void hci_ridge_draw(const hci_ridge *p, double s, hci_draws *draws, double *x)
{
    const size_t n = p->n;
    for (size_t k = 0; k < n; ++k)
        x[k] = hci_draws_normal(draws);
    for (size_t k = n; k-- > 0;) {
        const double *column = p->factor + k * n;
        double sum = x[k];
        for (size_t i = k + 1; i < n; ++i)
            sum -= column[i] * x[i];
        x[k] = sum / column[k];
    }
    for (size_t k = 0; k < n; ++k)
        x[k] = p->mean[k] + s * p->scale[k] * x[k];
}
