#include "host/numeric/condensed.h"

#include <math.h>
#include <string.h>

#include "host/base/memory.h"

#define LEAST 1e-12 /* of the largest square of a regressor at its expected size */

bool hci_condensed_start(hci_condensed *all, size_t n, size_t groups)
{
    memset(all, 0, sizeof *all);
    all->n = n;
    all->group = hci_memory_new(groups + 1, sizeof *all->group);
    all->gram = hci_memory_new(n * n + n + 1, sizeof *all->gram);
    if (!all->group || !all->gram) {
        hci_condensed_release(all);
        return false;
    }
    all->moment = all->gram + n * n;
    return true;
}

void hci_condensed_release(hci_condensed *all)
{
    for (size_t g = 0; g < all->count; ++g)
        hci_memory_free(all->group[g].factor);
    hci_memory_free(all->group);
    hci_memory_free(all->gram);
    memset(all, 0, sizeof *all);
}

/* The Cholesky factor with the largest pivots first, column by column: factor[n][n], of which `rank` columns
 * are filled. left[n]: what is left of the diagonal; pivot[n]. */
typedef struct {
    const hci_normal_equations *group;
    const double *unit;
    double *factor, *left;
    size_t *pivot, rank;
} pivoting;

/* The column with the largest regressor at its expected size; n: none is above `least`. */
static size_t largest_of(const pivoting *p, double least)
{
    size_t at = p->group->n;
    for (size_t k = 0; k < p->group->n; ++k) {
        const double size = p->left[k] * p->unit[k] * p->unit[k];
        if (!(size > least)) continue;
        least = size;
        at = k;
    }
    return at;
}

static void column_add(pivoting *p, size_t at)
{
    const size_t n = p->group->n, r = p->rank++;
    const double root = sqrt(p->left[at]), *row = p->factor + at * n;
    for (size_t i = 0; i < n; ++i) {
        double *x = p->factor + i * n, sum = p->group->gram[at * n + i];
        for (size_t j = 0; j < r; ++j)
            sum -= x[j] * row[j];
        x[r] = sum / root;
    }
    for (size_t i = 0; i < n; ++i)
        p->left[i] = fmax(0.0, p->left[i] - p->factor[i * n + r] * p->factor[i * n + r]);
    p->factor[at * n + r] = root;
    p->left[at] = 0.0;
    p->pivot[r] = at;
}

static void factor_find(pivoting *p)
{
    const size_t n = p->group->n;
    for (size_t k = 0; k < n; ++k)
        p->left[k] = p->group->gram[k * n + k];
    const size_t first = largest_of(p, 0.0);
    if (first == n) return;
    const double least = LEAST * p->left[first] * p->unit[first] * p->unit[first];
    for (size_t at = first; at < n && p->rank < n; at = largest_of(p, least))
        column_add(p, at);
}

/* F and g of the group, F g = Xᵀy at the pivots, where F is triangular. */
static bool group_fill(const pivoting *p, hci_condensed_group *out)
{
    const size_t n = p->group->n, rank = p->rank;
    *out = (hci_condensed_group){rank, NULL, NULL, p->group->square, p->group->rows};
    out->factor = hci_memory_new((n + 1) * rank + 1, sizeof *out->factor);
    if (!out->factor) return false;
    out->moment = out->factor + n * rank;
    for (size_t i = 0; i < n; ++i)
        memcpy(out->factor + i * rank, p->factor + i * n, rank * sizeof *out->factor);
    for (size_t r = 0; r < rank; ++r) {
        const double *row = p->factor + p->pivot[r] * n;
        double sum = p->group->moment[p->pivot[r]];
        for (size_t j = 0; j < r; ++j)
            sum -= row[j] * out->moment[j];
        out->moment[r] = sum / row[r];
        out->rest -= out->moment[r] * out->moment[r];
    }
    out->rest = fmax(0.0, out->rest);
    return true;
}

bool hci_condensed_add(hci_condensed *all, const hci_normal_equations *group, const double *unit)
{
    const size_t n = all->n;
    pivoting p = {.group = group, .unit = unit};
    p.factor = hci_memory_new(n * n + n + 1, sizeof *p.factor);
    p.pivot = hci_memory_new(n + 1, sizeof *p.pivot);
    p.left = p.factor ? p.factor + n * n : NULL;
    bool made = p.factor && p.pivot;
    if (made) factor_find(&p);
    made = made && group_fill(&p, &all->group[all->count]);
    hci_memory_free(p.factor);
    hci_memory_free(p.pivot);
    if (!made) return false;
    ++all->count;
    for (size_t k = 0; k < n * n; ++k)
        all->gram[k] += group->gram[k];
    for (size_t k = 0; k < n; ++k)
        all->moment[k] += group->moment[k];
    return true;
}

/* ---- groups that tell the same ---- */

/* Σ of the elementwise product of two XᵀX, |F_aᵀ D F_b|² with D over what all groups tell. */
static double product_of(const hci_condensed *all, const hci_condensed_group *a, const hci_condensed_group *b)
{
    double sum = 0.0;
    for (size_t i = 0; i < a->rank; ++i)
        for (size_t j = 0; j < b->rank; ++j) {
            double x = 0.0;
            for (size_t k = 0; k < all->n; ++k) {
                const double told = all->gram[k * all->n + k];
                if (told > 0.0) x += a->factor[k * a->rank + i] * b->factor[k * b->rank + j] / told;
            }
            sum += x * x;
        }
    return sum;
}

/* What decides whether groups tell the same, of all of them. */
typedef struct {
    double *square;   /* [group]: |XᵀX|², elementwise */
    double *diagonal; /* [group][n] */
} likeness;

static void likeness_fill(const hci_condensed *all, size_t g, likeness *of)
{
    const hci_condensed_group *group = &all->group[g];
    double *diagonal = of->diagonal + g * all->n;
    of->square[g] = product_of(all, group, group);
    for (size_t k = 0; k < all->n; ++k) {
        const double told = all->gram[k * all->n + k];
        for (size_t r = 0; r < group->rank && told > 0.0; ++r)
            diagonal[k] += group->factor[k * group->rank + r] * group->factor[k * group->rank + r] / told;
    }
}

/* What product_of is at most: the diagonals' product, and the rests as if they were parallel. O(n). */
static double most_product(const likeness *of, size_t n, size_t a, size_t b)
{
    const double *x = of->diagonal + a * n, *y = of->diagonal + b * n;
    double product = 0.0, xx = 0.0, yy = 0.0;
    for (size_t k = 0; k < n; ++k) {
        product += x[k] * y[k];
        xx += x[k] * x[k];
        yy += y[k] * y[k];
    }
    return product + sqrt(fmax(0.0, of->square[a] - xx) * fmax(0.0, of->square[b] - yy));
}

/* The first group that tells the same as a group, itself at last. */
static size_t leader_of(const hci_condensed *all, size_t g, double alike, const likeness *of)
{
    for (size_t j = 0; j < g; ++j) {
        const double least = alike * sqrt(of->square[j] * of->square[g]);
        if (most_product(of, all->n, j, g) * (1.0 + 1e-9) >= least &&
            product_of(all, &all->group[j], &all->group[g]) >= least)
            return j;
    }
    return g;
}

static void group_take(const hci_condensed_group *g, hci_normal_equations *sum)
{
    for (size_t i = 0; i < sum->n; ++i) {
        const double *row = g->factor + i * g->rank;
        for (size_t r = 0; r < g->rank; ++r)
            sum->moment[i] += row[r] * g->moment[r];
        for (size_t j = 0; j < sum->n; ++j)
            for (size_t r = 0; r < g->rank; ++r)
                sum->gram[i * sum->n + j] += row[r] * g->factor[j * g->rank + r];
    }
    for (size_t r = 0; r < g->rank; ++r)
        sum->square += g->moment[r] * g->moment[r];
    sum->square += g->rest;
    sum->rows += g->rows;
}

/* All groups with the same leader as one. */
static bool cluster_add(const hci_condensed *all, const double *unit, size_t leader, const size_t *of,
                        hci_condensed *joined)
{
    hci_normal_equations sum = {0};
    if (!hci_normal_equations_start(&sum, all->n)) return false;
    for (size_t g = leader; g < all->count; ++g)
        if (of[g] == leader) group_take(&all->group[g], &sum);
    const bool added = hci_condensed_add(joined, &sum, unit);
    hci_normal_equations_release(&sum);
    return added;
}

static bool leaders_find(const hci_condensed *all, double alike, size_t *of)
{
    likeness like = {hci_memory_new(all->count + 1, sizeof *like.square),
                     hci_memory_new(all->count * all->n + 1, sizeof *like.diagonal)};
    const bool made = like.square && like.diagonal;
    size_t g = 0;
    for (; g < all->count && made && !hci_watch_stops(all->watch); ++g) {
        likeness_fill(all, g, &like);
        of[g] = leader_of(all, g, alike, &like);
        of[g] = of[of[g]];
    }
    hci_memory_free(like.square);
    hci_memory_free(like.diagonal);
    return made && g == all->count;
}

bool hci_condensed_join(const hci_condensed *all, const double *unit, double alike, hci_condensed *joined,
                        size_t *of)
{
    size_t *place = hci_memory_new(all->count + 1, sizeof *place);
    bool made = place && hci_condensed_start(joined, all->n, all->count);
    joined->watch = all->watch;
    made = made && leaders_find(all, alike, of);
    for (size_t g = 0; g < all->count && made; ++g) {
        if (of[g] == g) {
            place[g] = joined->count;
            made = cluster_add(all, unit, g, of, joined);
        }
    }
    for (size_t g = 0; g < all->count && made; ++g)
        of[g] = place[of[g]];
    if (!made) hci_condensed_release(joined);
    hci_memory_free(place);
    return made;
}
