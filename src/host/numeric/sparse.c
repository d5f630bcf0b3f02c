#include "host/numeric/sparse.h"

#include <SuiteSparseQR_C.h>
#include <float.h>
#include <math.h>
#include <stdbool.h>
#include <string.h>
#include <umfpack.h>

#include "host/base/memory.h"

enum { POWER_STEPS = 20 };

/* ---- memory of the libraries ---- */

/* After an allocation that fails SPQR may go on, with a heap that it corrupts or to other numbers. So all
 * that follow fail as well, with which it does end, and what it has computed by then is not used. */
static bool short_of_memory;

static void *kept(void *block)
{
    short_of_memory = short_of_memory || block == NULL;
    return block;
}

static void *library_malloc(size_t size)
{
    return kept(short_of_memory ? NULL : hci_memory_malloc(size));
}

static void *library_calloc(size_t count, size_t size)
{
    return kept(short_of_memory ? NULL : hci_memory_new(count, size));
}

static void *library_realloc(void *block, size_t size)
{
    return kept(short_of_memory ? NULL : hci_memory_realloc(block, size));
}

static void begin_library(void)
{
    short_of_memory = false;
#if SUITESPARSE_MAIN_VERSION < 7
    SuiteSparse_config.malloc_func = library_malloc;
    SuiteSparse_config.calloc_func = library_calloc;
    SuiteSparse_config.realloc_func = library_realloc;
    SuiteSparse_config.free_func = hci_memory_free;
#else
    SuiteSparse_config_malloc_func_set(library_malloc);
    SuiteSparse_config_calloc_func_set(library_calloc);
    SuiteSparse_config_realloc_func_set(library_realloc);
    SuiteSparse_config_free_func_set(hci_memory_free);
#endif
}

static hci_status end_library(hci_status status, const char *which, hci_note *note)
{
    return short_of_memory ? hci_note_memory(note, NULL, "%s", which) : status;
}

static double normalise(double *x, size_t n)
{
    double sum = 0.0;
    for (size_t k = 0; k < n; ++k)
        sum += x[k] * x[k];
    sum = sqrt(sum);
    for (size_t k = 0; k < n && sum > 0.0; ++k)
        x[k] /= sum;
    return sum;
}

/* An estimate is good when a step changes its square by less than a per cent. */
static bool is_settled(double before, double now)
{
    return before > 0.0 && fabs(now - before) <= 0.01 * now;
}

/* A unit vector that no likely singular vector is at right angles to. */
static void start_values(double *x, size_t n)
{
    for (size_t k = 0; k < n; ++k)
        x[k] = 1.0 + 0.37 * (double)(k * 7 % 11);
    normalise(x, n);
}

/* ---- UMFPACK ---- */

static hci_status umfpack_status(SuiteSparse_long code, hci_note *note)
{
    if (code == UMFPACK_OK) return HCI_OK;
    if (code == UMFPACK_WARNING_singular_matrix) return HCI_ERROR_SINGULAR;
    if (code == UMFPACK_ERROR_out_of_memory) return hci_note_memory(note, NULL, "the sparse LU");
    return hci_note_set(note, HCI_ERROR_NUMERIC, "UMFPACK failed with status %ld", (long)code);
}

static hci_status umfpack_substitute(const hci_sparse *a, void *numeric, const double *b, size_t right_sides,
                                     double *x, hci_note *note)
{
    for (size_t k = 0; k < right_sides; ++k) {
        double *column = x + k * a->columns;
        const SuiteSparse_long code = umfpack_dl_solve(UMFPACK_A, a->column_start, a->row, a->value, column,
                                                       b + k * a->rows, numeric, NULL, NULL);
        const hci_status status = umfpack_status(code, note);
        if (status) return status;
        for (size_t j = 0; j < a->columns; ++j)
            if (!isfinite(column[j])) return HCI_ERROR_SINGULAR;
    }
    return HCI_OK;
}

/* y = A x, or Aᵀ x. */
static void multiply(const hci_sparse *a, bool transposed, const double *x, double *y)
{
    for (size_t i = 0; i < a->rows; ++i)
        y[i] = 0.0;
    for (size_t j = 0; j < a->columns; ++j)
        for (int64_t k = a->column_start[j]; k < a->column_start[j + 1]; ++k)
            if (transposed)
                y[j] += a->value[k] * x[a->row[k]];
            else
                y[a->row[k]] += a->value[k] * x[j];
}

/* Largest singular value of A, squared, by power iteration on AᵀA. x, y: workspace of n. */
static double umfpack_largest(const hci_sparse *a, double *x, double *y)
{
    double largest = 0.0, before = -1.0;
    start_values(x, a->columns);
    for (int step = 0; step < POWER_STEPS && !is_settled(before, largest); ++step) {
        before = largest;
        multiply(a, false, x, y);
        multiply(a, true, y, x);
        largest = normalise(x, a->columns);
    }
    return largest;
}

/* That of A⁻¹, by the factors. growth: out. */
static hci_status umfpack_growth(const hci_sparse *a, void *numeric, double *work, double *growth,
                                 hci_note *note)
{
    double control[UMFPACK_CONTROL], before = -1.0, *x = work, *y = work + a->columns;
    hci_status status = HCI_OK;
    *growth = 0.0;
    umfpack_dl_defaults(control);
    control[UMFPACK_IRSTEP] = 0.0;
    start_values(x, a->columns);
    for (int step = 0; step < POWER_STEPS && !status && !is_settled(before, *growth); ++step) {
        before = *growth;
        status = umfpack_status(
            umfpack_dl_solve(UMFPACK_At, a->column_start, a->row, a->value, y, x, numeric, control, NULL),
            note);
        if (!status)
            status = umfpack_status(
                umfpack_dl_solve(UMFPACK_A, a->column_start, a->row, a->value, x, y, numeric, control, NULL),
                note);
        *growth = normalise(x, a->columns);
    }
    return status;
}

/* Ratio of the largest to the smallest singular value of a square A by power iterations on AᵀA and (AᵀA)⁻¹,
 * since the pivots alone can be wrong by orders of magnitude. work: of 2n. */
static hci_status umfpack_condition(const hci_sparse *a, void *numeric, double *work, double *condition,
                                    hci_note *note)
{
    const double largest = umfpack_largest(a, work, work + a->columns);
    double growth;
    const hci_status status = umfpack_growth(a, numeric, work, &growth, note);
    *condition = sqrt(largest) * sqrt(growth);
    return status || *condition * (double)a->columns * DBL_EPSILON < 1.0 ? status : HCI_ERROR_SINGULAR;
}

static hci_status umfpack_examine(const hci_sparse *a, void *numeric, double *condition, hci_note *note)
{
    double *work = hci_memory_new(2 * a->columns, sizeof *work);
    const hci_status status = work ? umfpack_condition(a, numeric, work, condition, note)
                                   : hci_note_memory(note, NULL, "the sparse LU");
    hci_memory_free(work);
    return status;
}

hci_status hci_sparse_lu_solve(const hci_sparse *a, const double *b, size_t right_sides, double *x,
                               double *condition, hci_note *note)
{
    const SuiteSparse_long n = (SuiteSparse_long)a->columns;
    void *symbolic = NULL, *numeric = NULL;
    hci_status status;
    begin_library();
    status = umfpack_status(
        umfpack_dl_symbolic(n, n, a->column_start, a->row, a->value, &symbolic, NULL, NULL), note);
    if (!status)
        status = umfpack_status(
            umfpack_dl_numeric(a->column_start, a->row, a->value, symbolic, &numeric, NULL, NULL), note);
    umfpack_dl_free_symbolic(&symbolic);
    if (!status) status = umfpack_examine(a, numeric, condition, note);
    if (!status) status = umfpack_substitute(a, numeric, b, right_sides, x, note);
    umfpack_dl_free_numeric(&numeric);
    return end_library(status, "the sparse LU", note);
}

/* ---- SPQR ---- */

static cholmod_sparse as_cholmod(const hci_sparse *a)
{
    cholmod_sparse s;
    memset(&s, 0, sizeof s);
    s.nrow = a->rows;
    s.ncol = a->columns;
    s.nzmax = (size_t)a->column_start[a->columns];
    s.p = a->column_start;
    s.i = a->row;
    s.x = a->value;
    s.itype = CHOLMOD_LONG;
    s.xtype = CHOLMOD_REAL;
    s.dtype = CHOLMOD_DOUBLE;
    s.sorted = 1;
    s.packed = 1;
    return s;
}

static cholmod_dense as_dense(const double *x, size_t rows, size_t columns, double *copy)
{
    cholmod_dense d;
    memset(&d, 0, sizeof d);
    memcpy(copy, x, rows * columns * sizeof *x);
    d.nrow = d.d = rows;
    d.ncol = columns;
    d.nzmax = rows * columns;
    d.x = copy;
    d.xtype = CHOLMOD_REAL;
    d.dtype = CHOLMOD_DOUBLE;
    return d;
}

static cholmod_dense *start_vector(size_t n, cholmod_common *cc)
{
    cholmod_dense *x = cholmod_l_allocate_dense(n, 1, n, CHOLMOD_REAL, cc);
    if (x) start_values(x->x, n);
    return x;
}

/* Largest singular value of R by power iteration on R Rᵀ; 0 when memory is out. */
static double largest_singular(cholmod_sparse *r, cholmod_common *cc)
{
    double one[2] = {1.0, 0.0}, zero[2] = {0.0, 0.0}, square = 0.0;
    cholmod_dense *x = start_vector(r->nrow, cc);
    cholmod_dense *y = cholmod_l_allocate_dense(r->ncol, 1, r->ncol, CHOLMOD_REAL, cc);
    for (int step = 0; step < POWER_STEPS && x && y; ++step) {
        const int good =
            cholmod_l_sdmult(r, 1, one, zero, x, y, cc) && cholmod_l_sdmult(r, 0, one, zero, y, x, cc);
        square = good ? normalise(x->x, x->nrow) : 0.0;
    }
    cholmod_l_free_dense(&x, cc);
    cholmod_l_free_dense(&y, cc);
    return sqrt(square);
}

/* Smallest singular value by power iteration on (R Rᵀ)⁻¹ = R₂⁻¹ R₂⁻ᵀ, from the factors of Rᵀ; 0 when memory
 * is out. */
static double smallest_singular(SuiteSparseQR_C_factorization *qr, size_t n, cholmod_common *cc)
{
    cholmod_dense *x = start_vector(n, cc);
    double growth = HUGE_VAL;
    for (int step = 0; step < POWER_STEPS && x; ++step) {
        cholmod_dense *y = SuiteSparseQR_C_solve(SPQR_RTX_EQUALS_B, qr, x, cc);
        cholmod_l_free_dense(&x, cc);
        x = y ? SuiteSparseQR_C_solve(SPQR_RX_EQUALS_B, qr, y, cc) : NULL;
        cholmod_l_free_dense(&y, cc);
        growth = x ? normalise(x->x, n) : HUGE_VAL;
    }
    cholmod_l_free_dense(&x, cc);
    return sqrt(1.0 / growth);
}

/* min ‖y‖ with R y = c for R of full row rank: Rᵀ = Q₂ R₂, so y = Q₂ R₂⁻ᵀ c. NULL when it fails. */
static cholmod_dense *least_norm(cholmod_sparse *r, cholmod_dense *c, double *condition, cholmod_common *cc)
{
    cholmod_sparse *r_transposed = cholmod_l_transpose(r, 1, cc);
    SuiteSparseQR_C_factorization *qr =
        r_transposed ? SuiteSparseQR_C_factorize(SPQR_ORDERING_FIXED, SPQR_NO_TOL, r_transposed, cc) : NULL;
    cholmod_dense *z = qr ? SuiteSparseQR_C_solve(SPQR_RTX_EQUALS_ETB, qr, c, cc) : NULL;
    cholmod_dense *y = z ? SuiteSparseQR_C_qmult(SPQR_QX, qr, z, cc) : NULL;
    if (y) {
        const double largest = largest_singular(r, cc), smallest = smallest_singular(qr, r->nrow, cc);
        *condition = largest / smallest;
        if (!(largest > 0.0 && smallest > 0.0)) cholmod_l_free_dense(&y, cc);
    }
    cholmod_l_free_dense(&z, cc);
    SuiteSparseQR_C_free(&qr, cc);
    cholmod_l_free_sparse(&r_transposed, cc);
    return y;
}

/* x[E[k]] = y[k]; a NULL permutation is the identity. */
static void unpermute(const cholmod_dense *y, const SuiteSparse_long *permutation, size_t columns, double *x)
{
    const double *value = y->x;
    for (size_t k = 0; k < y->ncol; ++k)
        for (size_t j = 0; j < columns; ++j)
            x[k * columns + (permutation ? (size_t)permutation[j] : j)] = value[k * y->d + j];
}

static hci_status qr_status(const cholmod_common *cc, hci_note *note)
{
    if (cc->status == CHOLMOD_OUT_OF_MEMORY) return hci_note_memory(note, NULL, "the sparse QR");
    return hci_note_set(note, HCI_ERROR_NUMERIC, "SPQR failed with status %d", cc->status);
}

/* A E = Q R with C = Qᵀ B, R cut to `rank` rows; then the least-norm y of R y = C and x = E y. */
static hci_status qr_solve(const hci_sparse *a, cholmod_dense *b, double *x, hci_sparse_rank *found,
                           cholmod_common *cc, hci_note *note)
{
    cholmod_sparse matrix = as_cholmod(a), *r = NULL;
    cholmod_dense *c = NULL, *y = NULL;
    SuiteSparse_long *permutation = NULL;
    const SuiteSparse_long rank = SuiteSparseQR_C(SPQR_ORDERING_DEFAULT, SPQR_DEFAULT_TOL, 0, 0, &matrix,
                                                  NULL, b, NULL, &c, &r, &permutation, NULL, NULL, NULL, cc);
    hci_status status = HCI_OK;
    if (rank > 0) {
        found->rank = (size_t)rank;
        y = least_norm(r, c, &found->condition, cc);
    }
    if (rank < 0 || (rank > 0 && !y))
        status = qr_status(cc, note);
    else if (y)
        unpermute(y, permutation, a->columns, x);
    cholmod_l_free_dense(&y, cc);
    cholmod_l_free_dense(&c, cc);
    cholmod_l_free_sparse(&r, cc);
    if (permutation) cholmod_l_free(a->columns, sizeof *permutation, permutation, cc);
    return status;
}

hci_status hci_sparse_qr_solve(const hci_sparse *a, const double *b, size_t right_sides, double *x,
                               hci_sparse_rank *found, hci_note *note)
{
    cholmod_common cc;
    cholmod_dense right;
    double *copy;
    hci_status status;
    memset(x, 0, a->columns * right_sides * sizeof *x);
    *found = (hci_sparse_rank){0, NAN};
    if (a->rows == 0 || a->columns == 0) return HCI_OK;
    copy = hci_memory_new(a->rows * right_sides, sizeof *copy);
    if (!copy) return hci_note_memory(note, NULL, "%zu rows", a->rows);
    begin_library();
    cholmod_l_start(&cc);
    cc.print = 0;
    right = as_dense(b, a->rows, right_sides, copy);
    status = qr_solve(a, &right, x, found, &cc, note);
    cholmod_l_finish(&cc);
    hci_memory_free(copy);
    return end_library(status, "the sparse QR", note);
}
