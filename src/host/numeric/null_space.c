/* Aᵀ Π = Q [R; 0] by Householder reflections with pivoting: the columns of Q behind the rank are the basis,
 * and Rᵀ y = Πᵀ b gives the point. */
#include "host/numeric/null_space.h"

#include <math.h>
#include <string.h>

#include "core/math/vector.h"
#include "host/base/memory.h"

#define DEPENDENT 1e-11 /* share of the largest row below which a row depends on those before */

typedef struct {
    size_t rows, columns, rank; /* of Aᵀ: unknowns × equalities */
    double *q;                  /* rows × columns: reflectors below the diagonal, R on and above */
    double *head;               /* columns: first entry of each reflector, which R takes the place of */
    size_t *column;             /* the permutation */
} factors;

static double length(size_t n, const double *x)
{
    return sqrt(hci_vector_dot(n, x, x));
}

/* Applies reflector k to a column of `rows` entries. The reflector has the norm √2. */
static void reflect(const factors *f, size_t k, double *x)
{
    const double *v = f->q + k * f->rows;
    const size_t behind = f->rows - k - 1;
    const double t = f->head[k] * x[k] + hci_vector_dot(behind, v + k + 1, x + k + 1);
    x[k] -= t * f->head[k];
    hci_vector_add(behind, -t, v + k + 1, x + k + 1);
}

/* Makes reflector k from column k; what is left of the column on the diagonal is R. */
static void make_reflector(factors *f, size_t k)
{
    double *v = f->q + k * f->rows;
    const double size = length(f->rows - k, v + k), diagonal = v[k] > 0.0 ? -size : size,
                 scale = 1.0 / sqrt(size * (size + fabs(v[k])));
    f->head[k] = (v[k] - diagonal) * scale;
    for (size_t i = k + 1; i < f->rows; ++i)
        v[i] *= scale;
    v[k] = diagonal;
}

/* The longest of the columns that are left comes to position k; its length below row k. */
static double pivot(factors *f, size_t k)
{
    size_t best = k;
    double longest = -1.0;
    for (size_t j = k; j < f->columns; ++j) {
        const double l = length(f->rows - k, f->q + j * f->rows + k);
        if (l > longest) longest = l, best = j;
    }
    for (size_t i = 0; i < f->rows && best != k; ++i)
        hci_swap(&f->q[k * f->rows + i], &f->q[best * f->rows + i]);
    const size_t t = f->column[k];
    f->column[k] = f->column[best];
    f->column[best] = t;
    return longest;
}

static void factor(factors *f)
{
    double largest = 0.0;
    for (size_t j = 0; j < f->columns; ++j)
        f->column[j] = j;
    for (f->rank = 0; f->rank < f->columns && f->rank < f->rows; ++f->rank) {
        const double l = pivot(f, f->rank);
        largest = fmax(largest, l);
        if (l <= DEPENDENT * largest) return;
        make_reflector(f, f->rank);
        for (size_t j = f->rank + 1; j < f->columns; ++j)
            reflect(f, f->rank, f->q + j * f->rows);
    }
}

/* The basis: Q times the unit vectors behind the rank. */
static void fill_basis(const factors *f, hci_null_space *s)
{
    s->free = s->unknowns - f->rank;
    for (size_t j = 0; j < s->free; ++j) {
        double *x = s->basis + j * s->unknowns;
        x[f->rank + j] = 1.0;
        for (size_t k = f->rank; k-- > 0;)
            reflect(f, k, x);
    }
}

/* Forward substitution with Rᵀ, then Q. */
static void fill_point(const factors *f, const double *b, hci_null_space *s)
{
    for (size_t i = 0; i < f->rank; ++i) {
        const double *r = f->q + i * f->rows;
        s->point[i] = (b[f->column[i]] - hci_vector_dot(i, r, s->point)) / r[i];
    }
    for (size_t k = f->rank; k-- > 0;)
        reflect(f, k, s->point);
}

static void fill_error(size_t equalities, const double *a, const double *b, hci_null_space *s)
{
    double largest = 0.0;
    for (size_t i = 0; i < equalities; ++i) {
        double error = -b[i];
        for (size_t j = 0; j < s->unknowns; ++j)
            error += a[i + j * equalities] * s->point[j];
        s->error = fmax(s->error, fabs(error));
        largest = fmax(largest, fabs(b[i]));
    }
    if (largest > 0.0) s->error /= largest;
}

hci_status hci_null_space_make(size_t equalities, size_t unknowns, const double *a, const double *b,
                               hci_null_space *space)
{
    factors f = {.rows = unknowns, .columns = equalities};
    bool has_memory;
    *space = (hci_null_space){.unknowns = unknowns};
    f.q = hci_memory_new(unknowns * equalities + equalities, sizeof *f.q);
    f.head = f.q ? f.q + unknowns * equalities : NULL;
    f.column = hci_memory_new(equalities, sizeof *f.column);
    space->point = hci_memory_new(unknowns, sizeof *space->point);
    space->basis = hci_memory_new(unknowns * unknowns, sizeof *space->basis);
    has_memory = f.q && f.column && space->point && space->basis;
    for (size_t i = 0; has_memory && i < equalities; ++i)
        for (size_t j = 0; j < unknowns; ++j)
            f.q[j + i * unknowns] = a[i + j * equalities];
    if (has_memory) {
        factor(&f);
        fill_basis(&f, space);
        fill_point(&f, b, space);
        fill_error(equalities, a, b, space);
    }
    hci_memory_free(f.q);
    hci_memory_free(f.column);
    return has_memory ? HCI_OK : HCI_ERROR_MEMORY;
}

void hci_null_space_release(hci_null_space *space)
{
    hci_memory_free(space->point);
    hci_memory_free(space->basis);
    memset(space, 0, sizeof *space);
}

void hci_null_space_point(const hci_null_space *space, const double *y, double *out)
{
    memcpy(out, space->point, space->unknowns * sizeof *out);
    for (size_t j = 0; j < space->free; ++j)
        hci_vector_add(space->unknowns, y[j], space->basis + j * space->unknowns, out);
}
