#include "host/numeric/normal_equations.h"

#include <assert.h>
#include <math.h>
#include <string.h>

#include "host/base/memory.h"
#include "host/numeric/wide.h"

#define DEPENDENT 1e-9 /* what remains of a column's square when it depends on the others */

enum { MOST_GROUP = 8 };

bool hci_normal_equations_start(hci_normal_equations *normal, size_t n)
{
    memset(normal, 0, sizeof *normal);
    normal->n = n;
    normal->gram = hci_memory_new(n * n + 1, sizeof *normal->gram);
    normal->moment = hci_memory_new(n + 1, sizeof *normal->moment);
    if (normal->gram && normal->moment) return true;
    hci_normal_equations_release(normal);
    return false;
}

void hci_normal_equations_release(hci_normal_equations *normal)
{
    hci_memory_free(normal->gram);
    hci_memory_free(normal->moment);
    memset(normal, 0, sizeof *normal);
}

/* Four rows at a time, and two rows of the Gram matrix at a time where there are two: what is loaded is used
 * as often as registers allow. The inner loop runs over columns, which lets the compiler do several at once.
 */
HCI_WIDE static void add_four(hci_normal_equations *normal, const double *x, const double *y)
{
    const size_t n = normal->n;
    const double *x1 = x + n, *x2 = x1 + n, *x3 = x2 + n;
    for (size_t i = n % 2; i < n; i += 2) {
        double *restrict row = normal->gram + i * n, *restrict next = row + n;
        const double a = x[i], b = x1[i], c = x2[i], d = x3[i];
        const double e = x[i + 1], f = x1[i + 1], g = x2[i + 1], h = x3[i + 1];
        for (size_t j = 0; j <= i; ++j) {
            row[j] += (a * x[j] + b * x1[j]) + (c * x2[j] + d * x3[j]);
            next[j] += (e * x[j] + f * x1[j]) + (g * x2[j] + h * x3[j]);
        }
        next[i + 1] += (e * e + f * f) + (g * g + h * h);
    }
    if (n % 2 == 1) normal->gram[0] += (x[0] * x[0] + x1[0] * x1[0]) + (x2[0] * x2[0] + x3[0] * x3[0]);
    for (size_t i = 0; i < n; ++i)
        normal->moment[i] += (x[i] * y[0] + x1[i] * y[1]) + (x2[i] * y[2] + x3[i] * y[3]);
    for (int k = 0; k < 4; ++k)
        normal->square += y[k] * y[k];
}

static void add_one(hci_normal_equations *normal, const double *x, double y)
{
    const size_t n = normal->n;
    for (size_t i = 0; i < n; ++i) {
        for (size_t j = 0; j <= i; ++j)
            normal->gram[i * n + j] += x[i] * x[j];
        normal->moment[i] += x[i] * y;
    }
    normal->square += y * y;
}

void hci_normal_equations_add(hci_normal_equations *normal, const double *x, const double *y, size_t rows)
{
    size_t k = 0;
    for (; k + 4 <= rows; k += 4)
        add_four(normal, x + k * normal->n, y + k);
    for (; k < rows; ++k)
        add_one(normal, x + k * normal->n, y[k]);
    normal->rows += (double)rows;
}

void hci_normal_equations_finish(hci_normal_equations *normal)
{
    const size_t n = normal->n;
    for (size_t i = 0; i < n; ++i)
        for (size_t j = i + 1; j < n; ++j)
            normal->gram[i * n + j] = normal->gram[j * n + i];
}

/* ---- sweeping ---- */

bool hci_sweep_start(hci_sweep *sweep, const hci_normal_equations *normal)
{
    const size_t n = normal->n;
    memset(sweep, 0, sizeof *sweep);
    sweep->n = n;
    sweep->a = hci_memory_new(n * n + 2 * n + 1, sizeof *sweep->a);
    sweep->in = hci_memory_new(n + 1, sizeof *sweep->in);
    if (!sweep->a || !sweep->in) {
        hci_sweep_release(sweep);
        return false;
    }
    sweep->b = sweep->a + n * n;
    sweep->diagonal = sweep->b + n;
    memcpy(sweep->a, normal->gram, n * n * sizeof *sweep->a);
    memcpy(sweep->b, normal->moment, n * sizeof *sweep->b);
    for (size_t k = 0; k < n; ++k)
        sweep->diagonal[k] = normal->gram[k * n + k];
    sweep->square = normal->square;
    return true;
}

void hci_sweep_copy(hci_sweep *to, const hci_sweep *from)
{
    const size_t n = from->n;
    memcpy(to->a, from->a, (n * n + 2 * n) * sizeof *to->a);
    memcpy(to->in, from->in, n * sizeof *to->in);
    to->square = from->square;
}

void hci_sweep_release(hci_sweep *sweep)
{
    hci_memory_free(sweep->a);
    hci_memory_free(sweep->in);
    memset(sweep, 0, sizeof *sweep);
}

/* Gauss–Jordan on one pivot d: A_ij ← A_ij − A_ik A_kj/d, A_kj ← A_kj/d, A_ik ← −A_ik/d, A_kk ← 1/d, with b
 * as one more column. The same again restores what was. */
HCI_WIDE static void pivot(hci_sweep *s, size_t k)
{
    const size_t n = s->n;
    double *row = s->a + k * n;
    const double d = row[k];
    for (size_t i = 0; i < n; ++i) {
        double *other = s->a + i * n;
        const double factor = i == k ? 0.0 : other[k] / d;
        if (factor == 0.0) continue;
        for (size_t j = 0; j < n; ++j)
            other[j] -= factor * row[j];
        s->b[i] -= factor * s->b[k];
        other[k] = -factor;
    }
    for (size_t j = 0; j < n; ++j)
        row[j] /= d;
    row[k] = 1.0 / d;
    s->b[k] /= d;
    s->in[k] = !s->in[k];
}

bool hci_sweep_in(hci_sweep *s, size_t k)
{
    const double d = s->a[k * s->n + k], b = s->b[k];
    if (s->in[k] || !(d > DEPENDENT * s->diagonal[k]) || !(d > 0.0)) return false;
    s->square -= b * b / d;
    pivot(s, k);
    return true;
}

void hci_sweep_out(hci_sweep *s, size_t k)
{
    if (!s->in[k]) return;
    s->square += s->b[k] * s->b[k] / s->a[k * s->n + k];
    pivot(s, k);
}

/* Row i of the Cholesky factor L of the block of neighbouring columns; what depends has a diagonal of 0. */
static void factor_row(const hci_sweep *s, size_t first, size_t i, double l[MOST_GROUP][MOST_GROUP])
{
    const size_t row = first + i;
    const double whole = s->in[row] ? s->a[row * s->n + row] : s->diagonal[row];
    for (size_t j = 0; j <= i; ++j) {
        double x = s->a[row * s->n + first + j];
        for (size_t k = 0; k < j; ++k)
            x -= l[i][k] * l[j][k];
        if (j < i)
            l[i][j] = l[j][j] > 0.0 ? x / l[j][j] : 0.0;
        else
            l[i][i] = x > DEPENDENT * whole && x > 0.0 ? sqrt(x) : 0.0;
    }
}

/* vᵀ M⁻¹ v = |z|² of L z = v. */
double hci_sweep_reduction(const hci_sweep *s, size_t first, size_t count)
{
    double l[MOST_GROUP][MOST_GROUP], z[MOST_GROUP], sum = 0.0;
    assert(count <= MOST_GROUP);
    for (size_t i = 0; i < count; ++i) {
        factor_row(s, first, i, l);
        z[i] = s->b[first + i];
        for (size_t k = 0; k < i; ++k)
            z[i] -= l[i][k] * z[k];
        z[i] = l[i][i] > 0.0 ? z[i] / l[i][i] : 0.0;
        sum += z[i] * z[i];
    }
    return sum;
}
