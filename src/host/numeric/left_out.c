#include "host/numeric/left_out.h"

#include <math.h>
#include <string.h>

#include "hci/math/dense.h"
#include "host/base/memory.h"

#define REGULAR 1e-12 /* added to a diagonal of 1, so that rounding makes no pivot negative */

/* Normal equations of all groups, and what is solved. */
typedef struct {
    size_t n;
    double *gram, *moment;      /* of all groups */
    double *matrix, *scale, *x; /* of one solution */
} workspace;

static bool workspace_make(workspace *w, const hci_groups *groups)
{
    const size_t n = groups->count > 0 ? groups->group[0].n : 0;
    double *all = hci_memory_new(2 * n * n + 3 * n + 1, sizeof *all);
    *w = (workspace){n, all, NULL, NULL, NULL, NULL};
    if (!all) return false;
    w->matrix = w->gram + n * n;
    w->moment = w->matrix + n * n;
    w->scale = w->moment + n;
    w->x = w->scale + n;
    for (size_t g = 0; g < groups->count; ++g) {
        for (size_t k = 0; k < n * n; ++k)
            w->gram[k] += groups->group[g].gram[k];
        for (size_t k = 0; k < n; ++k)
            w->moment[k] += groups->group[g].moment[k];
    }
    return true;
}

/* An element of what a group has that is left out; NULL: none is. */
static double gram_of(const hci_normal_equations *out, size_t k)
{
    return out ? out->gram[k] : 0.0;
}

/* Σ over all groups but one plus the precision, scaled to a diagonal of 1. */
static void matrix_set(const workspace *w, const hci_normal_equations *out, const double *precision)
{
    const size_t n = w->n;
    for (size_t k = 0; k < n; ++k) {
        const double d = w->gram[k * n + k] - gram_of(out, k * n + k) + precision[k];
        w->scale[k] = isfinite(d) && d > 0.0 ? 1.0 / sqrt(d) : 0.0;
    }
    for (size_t j = 0; j < n; ++j)
        for (size_t i = j; i < n; ++i)
            w->matrix[i + j * n] =
                i == j ? 1.0 + REGULAR
                       : (w->gram[i + j * n] - gram_of(out, i + j * n)) * w->scale[i] * w->scale[j];
}

static bool solve_without(const workspace *w, const hci_normal_equations *out, const double *precision)
{
    matrix_set(w, out, precision);
    if (hci_cholesky_factor(w->n, w->matrix)) return false;
    for (size_t k = 0; k < w->n; ++k)
        w->x[k] = (w->moment[k] - (out ? out->moment[k] : 0.0)) * w->scale[k];
    hci_cholesky_solve(w->n, w->matrix, w->x);
    for (size_t k = 0; k < w->n; ++k)
        w->x[k] *= w->scale[k];
    return true;
}

/* Σ (y − Xx)² = yᵀy − 2 xᵀXᵀy + xᵀXᵀX x; less than the rounding of it is 0. */
static double square_of(const workspace *w, const hci_normal_equations *group)
{
    double sum = group->square;
    for (size_t i = 0; i < w->n; ++i) {
        double row = 0.0;
        for (size_t j = 0; j < w->n; ++j)
            row += group->gram[i * w->n + j] * w->x[j];
        sum += w->x[i] * (row - 2.0 * group->moment[i]);
    }
    return fmax(0.0, sum);
}

bool hci_left_out_squares(const hci_groups *groups, const double *precision, double *square)
{
    workspace w;
    if (!workspace_make(&w, groups)) return false;
    for (size_t g = 0; g < groups->count; ++g)
        square[g] = solve_without(&w, &groups->group[g], precision) ? square_of(&w, &groups->group[g])
                                                                    : (double)INFINITY;
    hci_memory_free(w.gram);
    return true;
}

bool hci_all_in_square(const hci_groups *groups, const double *precision, double *square)
{
    workspace w;
    if (!workspace_make(&w, groups)) return false;
    const bool solved = solve_without(&w, NULL, precision);
    *square = solved ? 0.0 : (double)INFINITY;
    for (size_t g = 0; g < groups->count && solved; ++g)
        *square += square_of(&w, &groups->group[g]);
    hci_memory_free(w.gram);
    return true;
}
