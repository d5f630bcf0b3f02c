/* A second implementation for the tests: singular values and the least-squares solution of least norm of a
 * dense matrix by one-sided Jacobi rotations. */
#ifndef JACOBI_H
#define JACOBI_H

#include <math.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>

/* Turns columns p and q of w (m rows) and of v (n rows) until they are at right angles; the cosine between
 * them before. */
static inline double jacobi_rotate(size_t m, size_t n, double *w, double *v, size_t p, size_t q)
{
    double pp = 0.0, qq = 0.0, pq = 0.0, zeta, t, c;
    for (size_t i = 0; i < m; ++i) {
        pp += w[i + p * m] * w[i + p * m];
        qq += w[i + q * m] * w[i + q * m];
        pq += w[i + p * m] * w[i + q * m];
    }
    if (pq == 0.0 || pp == 0.0 || qq == 0.0) return 0.0;
    zeta = (qq - pp) / (2.0 * pq);
    t = (zeta < 0.0 ? -1.0 : 1.0) / (fabs(zeta) + hypot(1.0, zeta));
    c = 1.0 / hypot(1.0, t);
    for (size_t i = 0; i < m; ++i) {
        const double a = w[i + p * m], b = w[i + q * m];
        w[i + p * m] = c * (a - t * b);
        w[i + q * m] = c * (b + t * a);
    }
    for (size_t i = 0; i < n; ++i) {
        const double a = v[i + p * n], b = v[i + q * n];
        v[i + p * n] = c * (a - t * b);
        v[i + q * n] = c * (b + t * a);
    }
    return fabs(pq) / (sqrt(pp) * sqrt(qq));
}

/* W = A V with the columns of W at right angles. w: in A (m×n), out W; v: out, n×n. Columns that are rounding
 * beside the largest are left alone. */
static inline void jacobi_turn(size_t m, size_t n, double *w, double *v)
{
    double worst = 1.0;
    for (size_t k = 0; k < n * n; ++k)
        v[k] = k % (n + 1) == 0 ? 1.0 : 0.0;
    for (int sweep = 0; sweep < 60 && worst > 1e-15; ++sweep) {
        worst = 0.0;
        for (size_t p = 0; p + 1 < n; ++p)
            for (size_t q = p + 1; q < n; ++q)
                worst = fmax(worst, jacobi_rotate(m, n, w, v, p, q));
    }
}

static inline double jacobi_norm(size_t m, const double *column)
{
    double sum = 0.0;
    for (size_t i = 0; i < m; ++i)
        sum += column[i] * column[i];
    return sqrt(sum);
}

/* x = Σ v_j (w_j·b)/‖w_j‖² over the singular values above the cut; `transposed` when w and v are those of Aᵀ:
 * then x = Σ w_j (v_j·b)/‖w_j‖². rows, columns: of w. */
static inline void jacobi_apply(size_t rows, size_t columns, const double *w, const double *v, double cut,
                                int transposed, const double *b, double *x)
{
    const size_t from_length = transposed ? columns : rows, to_length = transposed ? rows : columns;
    const double *from = transposed ? v : w, *to = transposed ? w : v;
    for (size_t i = 0; i < to_length; ++i)
        x[i] = 0.0;
    for (size_t j = 0; j < columns; ++j) {
        const double norm = jacobi_norm(rows, w + j * rows);
        double dot = 0.0;
        if (norm <= cut) continue;
        for (size_t i = 0; i < from_length; ++i)
            dot += from[i + j * from_length] * b[i];
        for (size_t i = 0; i < to_length; ++i)
            x[i] += to[i + j * to_length] * (dot / norm) / norm;
    }
}

/* What the singular values say. */
typedef struct {
    size_t rank;
    double largest, smallest; /* smallest of those that count; 0 at rank 0 */
    double dropped;           /* largest of those that do not */
} jacobi_values;

/* x: out, n × sides: least norm among the minimisers of ‖A x − b‖; singular values below `relative_cut` times
 * the largest count as zero. a: m×n column-major; x and b may be NULL for the singular values alone. */
static inline jacobi_values jacobi_solve(size_t m, size_t n, const double *a, double relative_cut,
                                         size_t sides, const double *b, double *x)
{
    const int transposed = m < n;
    const size_t rows = transposed ? n : m, columns = transposed ? m : n;
    jacobi_values found = {0, 0.0, 0.0, 0.0};
    double *w = calloc(rows * columns + 1, sizeof *w), *v = calloc(columns * columns + 1, sizeof *v);
    if (w == NULL || v == NULL) abort();
    for (size_t j = 0; j < n; ++j)
        for (size_t i = 0; i < m; ++i)
            w[transposed ? j + i * n : i + j * m] = a[i + j * m];
    if (columns > 0) jacobi_turn(rows, columns, w, v);
    for (size_t j = 0; j < columns; ++j)
        found.largest = fmax(found.largest, jacobi_norm(rows, w + j * rows));
    for (size_t j = 0; j < columns; ++j) {
        const double norm = jacobi_norm(rows, w + j * rows);
        if (norm <= relative_cut * found.largest) {
            found.dropped = fmax(found.dropped, norm);
        } else {
            found.smallest = found.rank == 0 ? norm : fmin(found.smallest, norm);
            ++found.rank;
        }
    }
    for (size_t k = 0; k < sides && x != NULL; ++k)
        jacobi_apply(rows, columns, w, v, relative_cut * found.largest, transposed, b + k * m, x + k * n);
    free(w);
    free(v);
    return found;
}

#endif
