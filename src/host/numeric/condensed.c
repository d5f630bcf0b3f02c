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
