#include "host/numeric/left_out.h"

#include <math.h>
#include <string.h>

#include "hci/math/dense.h"
#include "host/base/memory.h"

#define REGULAR 1e-12 /* added to a diagonal of 1, so that rounding makes no pivot negative */

/* Normal equations of all groups, and what is solved: the unknowns that are not held at 0. */
typedef struct {
    size_t n;
    double *gram, *moment;      /* of all groups */
    size_t *open, count;        /* unknowns that are not held */
    double *matrix, *scale, *x; /* [count] of one solution */
    double *before;             /* [count], the x of another one */
} workspace;

static bool workspace_make(workspace *w, const hci_groups *groups, const double *precision)
{
    const size_t n = groups->count > 0 ? groups->group[0].n : 0;
    double *all = hci_memory_new(2 * n * n + 4 * n + 1, sizeof *all);
    *w = (workspace){.n = n, .gram = all, .open = hci_memory_new(n + 1, sizeof *w->open)};
    if (!all || !w->open) return false;
    w->matrix = w->gram + n * n;
    w->moment = w->matrix + n * n;
    w->scale = w->moment + n;
    w->x = w->scale + n;
    w->before = w->x + n;
    for (size_t g = 0; g < groups->count; ++g) {
        for (size_t k = 0; k < n * n; ++k)
            w->gram[k] += groups->group[g].gram[k];
        for (size_t k = 0; k < n; ++k)
            w->moment[k] += groups->group[g].moment[k];
    }
    for (size_t k = 0; k < n; ++k)
        if (isfinite(precision[k])) w->open[w->count++] = k;
    return true;
}

static void workspace_release(workspace *w)
{
    hci_memory_free(w->gram);
    hci_memory_free(w->open);
}

/* An element of what the groups have together but for the one that is left out; NULL: none is. */
static double gram_at(const workspace *w, const hci_normal_equations *out, size_t k, size_t j)
{
    const size_t at = w->open[k] * w->n + w->open[j];
    return w->gram[at] - (out ? out->gram[at] : 0.0);
}

/* Σ over all groups but one plus the precision, scaled to a diagonal of 1. */
static void matrix_set(const workspace *w, const hci_normal_equations *out, const double *precision)
{
    const size_t n = w->count;
    for (size_t k = 0; k < n; ++k) {
        const double d = gram_at(w, out, k, k) + precision[w->open[k]];
        w->scale[k] = d > 0.0 ? 1.0 / sqrt(d) : 0.0;
    }
    for (size_t j = 0; j < n; ++j)
        for (size_t i = j; i < n; ++i)
            w->matrix[i + j * n] = i == j ? 1.0 + REGULAR : gram_at(w, out, j, i) * w->scale[i] * w->scale[j];
}

static bool solve_without(const workspace *w, const hci_normal_equations *out, const double *precision)
{
    matrix_set(w, out, precision);
    if (hci_cholesky_factor(w->count, w->matrix)) return false;
    for (size_t k = 0; k < w->count; ++k) {
        const size_t at = w->open[k];
        w->x[k] = (w->moment[at] - (out ? out->moment[at] : 0.0)) * w->scale[k];
    }
    hci_cholesky_solve(w->count, w->matrix, w->x);
    for (size_t k = 0; k < w->count; ++k)
        w->x[k] *= w->scale[k];
    return true;
}

/* Σ (y − Xx)² = yᵀy − 2 xᵀXᵀy + xᵀXᵀX x; less than the rounding of it is 0. */
static double square_of(const workspace *w, const hci_normal_equations *group)
{
    double sum = group->square;
    for (size_t i = 0; i < w->count; ++i) {
        const double *gram = group->gram + w->open[i] * w->n;
        double row = 0.0;
        for (size_t j = 0; j < w->count; ++j)
            row += gram[w->open[j]] * w->x[j];
        sum += w->x[i] * (row - 2.0 * group->moment[w->open[i]]);
    }
    return fmax(0.0, sum);
}

bool hci_left_out_squares(const hci_groups *groups, const double *precision, double *square)
{
    workspace w;
    if (!workspace_make(&w, groups, precision)) {
        workspace_release(&w);
        return false;
    }
    for (size_t g = 0; g < groups->count; ++g)
        square[g] = solve_without(&w, &groups->group[g], precision) ? square_of(&w, &groups->group[g])
                                                                    : (double)INFINITY;
    workspace_release(&w);
    return true;
}

bool hci_all_in_squares(const hci_groups *groups, const double *precision, double *square)
{
    workspace w;
    if (!workspace_make(&w, groups, precision)) {
        workspace_release(&w);
        return false;
    }
    const bool solved = solve_without(&w, NULL, precision);
    for (size_t g = 0; g < groups->count; ++g)
        square[g] = solved ? square_of(&w, &groups->group[g]) : (double)INFINITY;
    workspace_release(&w);
    return true;
}

/* By how much the sum of the squares of all groups but one, and of what is expected, is larger with the x
 * before than with its own, where it is least: dᵀ(Σ XᵀX + precision)d, d what these differ by. */
static double above_least(const workspace *w, const hci_normal_equations *out, const double *precision)
{
    double sum = 0.0;
    for (size_t k = 0; k < w->count; ++k) {
        const double d = w->before[k] - w->x[k];
        double row = precision[w->open[k]] * d;
        for (size_t j = 0; j < w->count; ++j)
            row += gram_at(w, out, k, j) * (w->before[j] - w->x[j]);
        sum += d * row;
    }
    return fmax(0.0, sum);
}

bool hci_left_out_falls(const hci_groups *groups, const double *precision, double *fall)
{
    workspace w;
    if (!workspace_make(&w, groups, precision)) {
        workspace_release(&w);
        return false;
    }
    const bool solved = solve_without(&w, NULL, precision);
    memcpy(w.before, w.x, w.count * sizeof *w.x);
    for (size_t g = 0; g < groups->count; ++g)
        fall[g] = solved ? square_of(&w, &groups->group[g]) : (double)INFINITY;
    for (size_t g = 0; g < groups->count && solved; ++g)
        fall[g] += solve_without(&w, &groups->group[g], precision)
                       ? above_least(&w, &groups->group[g], precision)
                       : (double)INFINITY;
    workspace_release(&w);
    return true;
}

bool hci_all_in_square(const hci_groups *groups, const double *precision, double *sum)
{
    double *square = hci_memory_new(groups->count + 1, sizeof *square);
    const bool made = square && hci_all_in_squares(groups, precision, square);
    *sum = 0.0;
    for (size_t g = 0; g < groups->count && made; ++g)
        *sum += square[g];
    hci_memory_free(square);
    return made;
}
