/* What it costs to make and to solve U x = h, dense and sparse, by the number of components.
 *
 * The machine is machine A of data/machine_a with a random phase on each back-EMF harmonic
 * (21.93, 5.02, 4.80, 8.10 and 1.61 V at orders 1, 5, 7, 11, 13). One component for each compared order m = 1
 * … N, at random `pos` of order m + 1 or `neg` of order |m − 1|, which the fundamental of the back-EMF turns
 * into torque of order m. U is then square, and regular for every N: the fundamental outweighs the other four
 * together, so the columns are dominated by their diagonal blocks.
 *
 * usage: bench_solve [LARGEST_NUMBER_OF_COMPONENTS]      one thread; every time is a median */
#define _POSIX_C_SOURCE 200809L

#include <dlfcn.h>
#include <math.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>

#ifdef HCI_BENCH_LAPACKE
#include <lapacke.h>
#endif

#include "hci/machine/system.h"
#include "hci/math/dense.h"
#include "host/numeric/sparse.h"
#include "support/draws.h"
#include "timing.h"

enum { EMF_COUNT = 5, DENSE_COMPONENTS_MAX = 1536 };

typedef struct {
    size_t components, unknowns;
    hci_wave emf[EMF_COUNT];
    hci_component *component;
    double *orders;
    hci_sparse sparse;
    double *dense, *factor; /* NULL above DENSE_COMPONENTS_MAX */
    size_t *pivot;
    double *h, *x, *wanted;
#ifdef HCI_BENCH_LAPACKE
    lapack_int *lapack_pivot;
#endif
    int failed;
} problem;

typedef struct {
    double sparse_s, dense_s;         /* making U */
    double lu_s, lapack_s, umfpack_s; /* solving */
    double worst_error;               /* of any solver, relative to the largest unknown */
} result;

static uint64_t seed = 1;

static void *allocate(size_t count, size_t size)
{
    void *p = malloc(count * size);
    if (p) return p;
    fprintf(stderr, "bench_solve: out of memory\n");
    exit(4);
}

static double *allocate_doubles(size_t count)
{
    return (double *)allocate(count, sizeof(double));
}

/* ---- the problem ---- */

static void make_machine(problem *p)
{
    static const double order[EMF_COUNT] = {1, 5, 7, 11, 13};
    static const double amplitude_V[EMF_COUNT] = {21.93, -5.02, 4.80, -8.10, -1.61};
    const double omega_m = 2.0 * HCI_PI * 50.0 / 2.0;
    for (size_t k = 0; k < EMF_COUNT; k++)
        p->emf[k] = hci_wave_polar(order[k], hci_sequence_of_order(order[k]), amplitude_V[k] / omega_m,
                                   2.0 * HCI_PI * ref_uniform(&seed, 0.0, 1.0));
}

static void make_components(problem *p)
{
    p->component = (hci_component *)allocate(p->components, sizeof *p->component);
    p->orders = allocate_doubles(p->components);
    for (size_t k = 0; k < p->components; k++) {
        const double m = (double)(k + 1);
        const hci_component pos = {m + 1.0, 1}, neg = {m - 1.0, -1};
        p->orders[k] = m;
        p->component[k] = k > 0 && ref_uniform(&seed, 0.0, 1.0) < 0.5
                              ? neg
                              : pos; /* order 0 would be one unknown, not two */
    }
}

static void make_sparse(void *context)
{
    problem *p = (problem *)context;
    hci_system_sparse(&(hci_mutual_torque){p->emf, EMF_COUNT, p->orders, p->components}, p->component,
                      p->components, p->sparse.column_start, p->sparse.row, p->sparse.value);
}

static void make_dense(void *context)
{
    problem *p = (problem *)context;
    hci_system_dense(&(hci_mutual_torque){p->emf, EMF_COUNT, p->orders, p->components}, p->component,
                     p->components, p->dense);
}

/* h = U x of a drawn x, so that every solver can be checked. */
static void make_right_side(problem *p)
{
    const hci_sparse *u = &p->sparse;
    for (size_t i = 0; i < p->unknowns; i++)
        p->h[i] = 0.0;
    for (size_t j = 0; j < p->unknowns; j++) {
        p->wanted[j] = 2.0 * ref_uniform(&seed, 0.0, 1.0) - 1.0;
        for (int64_t k = u->column_start[j]; k < u->column_start[j + 1]; k++)
            p->h[u->row[k]] += u->value[k] * p->wanted[j];
    }
}

static problem make_problem(size_t components)
{
    problem p = {0};
    p.components = components;
    p.unknowns = 2 * components;
    make_machine(&p);
    make_components(&p);

    const size_t n = p.unknowns, capacity = hci_system_capacity(EMF_COUNT, components);
    p.sparse.rows = p.sparse.columns = n;
    p.sparse.column_start = (int64_t *)allocate(n + 1, sizeof(int64_t));
    p.sparse.row = (int64_t *)allocate(capacity, sizeof(int64_t));
    p.sparse.value = allocate_doubles(capacity);
    p.h = allocate_doubles(n);
    p.x = allocate_doubles(n);
    p.wanted = allocate_doubles(n);
    make_sparse(&p);
    make_right_side(&p);
    if (components <= DENSE_COMPONENTS_MAX) {
        p.dense = allocate_doubles(n * n);
        p.factor = allocate_doubles(n * n);
        p.pivot = (size_t *)allocate(n, sizeof(size_t));
        make_dense(&p);
#ifdef HCI_BENCH_LAPACKE
        p.lapack_pivot = (lapack_int *)allocate(n, sizeof(lapack_int));
#endif
    }
    return p;
}

static void free_problem(problem *p)
{
    free(p->component);
    free(p->orders);
    free(p->sparse.column_start);
    free(p->sparse.row);
    free(p->sparse.value);
    free(p->dense);
    free(p->factor);
    free(p->pivot);
    free(p->h);
    free(p->x);
    free(p->wanted);
#ifdef HCI_BENCH_LAPACKE
    free(p->lapack_pivot);
#endif
}

/* ---- the solvers; each copies what it destroys, and that copy is in its time ---- */

static void copy_in(problem *p)
{
    memcpy(p->factor, p->dense, p->unknowns * p->unknowns * sizeof(double));
    memcpy(p->x, p->h, p->unknowns * sizeof(double));
}

static void solve_lu(void *context)
{
    problem *p = (problem *)context;
    copy_in(p);
    if (hci_lu_factor(p->unknowns, p->factor, p->pivot) != HCI_OK) p->failed = 1;
    hci_lu_solve(p->unknowns, p->factor, p->pivot, p->x);
}

#ifdef HCI_BENCH_LAPACKE
static void solve_lapack(void *context)
{
    problem *p = (problem *)context;
    const lapack_int n = (lapack_int)p->unknowns;
    copy_in(p);
    if (LAPACKE_dgesv_work(LAPACK_COL_MAJOR, n, 1, p->factor, n, p->lapack_pivot, p->x, n) != 0)
        p->failed = 1;
}
#endif

static void solve_umfpack(void *context)
{
    problem *p = (problem *)context;
    hci_note note = {0};
    double condition;
    if (hci_sparse_lu_solve(&p->sparse, p->h, 1, p->x, &condition, &note) != HCI_OK) p->failed = 1;
}

static double error_of(const problem *p)
{
    double worst = 0.0;
    for (size_t j = 0; j < p->unknowns; j++)
        worst = fmax(worst, fabs(p->x[j] - p->wanted[j]));
    return p->failed ? HUGE_VAL : worst;
}

static double timed_solve_s(bench_run *solve, problem *p, double *worst_error)
{
    for (size_t j = 0; j < p->unknowns; j++)
        p->x[j] = HUGE_VAL;
    const double seconds = bench_median_s(solve, p);
    *worst_error = fmax(*worst_error, error_of(p));
    return seconds;
}

static result measure(size_t components)
{
    problem p = make_problem(components);
    result r = {(double)NAN, (double)NAN, (double)NAN, (double)NAN, (double)NAN, 0.0};
    r.sparse_s = bench_median_s(make_sparse, &p);
    r.umfpack_s = timed_solve_s(solve_umfpack, &p, &r.worst_error);
    if (p.dense) {
        r.dense_s = bench_median_s(make_dense, &p);
        r.lu_s = timed_solve_s(solve_lu, &p, &r.worst_error);
#ifdef HCI_BENCH_LAPACKE
        r.lapack_s = timed_solve_s(solve_lapack, &p, &r.worst_error);
#endif
    }
    free_problem(&p);
    return r;
}

/* ---- the table ---- */

/* One thread where the BLAS is OpenBLAS, whichever the linker took; tells which it is. */
static const char *single_thread(void)
{
    void *program = dlopen(NULL, RTLD_NOW);
    void *set = program ? dlsym(program, "openblas_set_num_threads") : NULL;
    void *config = program ? dlsym(program, "openblas_get_config") : NULL;
    void (*set_threads)(int);
    char *(*get_config)(void);
    if (!set || !config) return "reference (no OpenBLAS in this process)";
    memcpy(&set_threads, &set, sizeof set); /* ISO C has no conversion from an object to a function pointer */
    memcpy(&get_config, &config, sizeof config);
    set_threads(1);
    return get_config();
}

static void print_us(double seconds)
{
    if (isnan(seconds)) {
        printf("           -");
    } else {
        printf(" %11.1f", 1e6 * seconds);
    }
}

static void print_ratio(double ratio)
{
    if (isnan(ratio)) {
        printf("        -");
    } else {
        printf(" %8.2f", ratio);
    }
}

static void print_result(size_t components, const result *r)
{
    printf("%10zu %8zu", components, 2 * components);
    print_us(r->sparse_s);
    print_us(r->dense_s);
    print_us(r->lu_s);
    print_us(r->lapack_s);
    print_us(r->umfpack_s);
    print_ratio(r->lu_s / r->lapack_s);
    print_ratio(r->lu_s / r->umfpack_s);
    printf(" %9.1e\n", r->worst_error);
    fflush(stdout);
}

/* Number of components at which `sparse` begins to win, between two rows on a double logarithmic scale. */
static double crossing(double n0, double n1, double dense0, double dense1, double sparse0, double sparse1)
{
    const double d0 = log(dense0 / sparse0), d1 = log(dense1 / sparse1);
    return d0 < 0.0 && d1 >= 0.0 ? n0 * pow(n1 / n0, d0 / (d0 - d1)) : (double)NAN;
}

static void print_crossing(const char *what, double components)
{
    if (!isnan(components))
        printf("%s: %.0f components, %.0f unknowns\n", what, components, 2.0 * components);
}

static void print_crossings(double n0, double n1, const result *a, const result *b)
{
    print_crossing("sparse wins over our LU, solving alone, from",
                   crossing(n0, n1, a->lu_s, b->lu_s, a->umfpack_s, b->umfpack_s));
    print_crossing("sparse wins over our LU, making U included, from",
                   crossing(n0, n1, a->dense_s + a->lu_s, b->dense_s + b->lu_s, a->sparse_s + a->umfpack_s,
                            b->sparse_s + b->umfpack_s));
    print_crossing("sparse wins over LAPACK, solving alone, from",
                   crossing(n0, n1, a->lapack_s, b->lapack_s, a->umfpack_s, b->umfpack_s));
}

int main(int argc, char **argv)
{
    static const size_t sizes[] = {3, 6, 12, 24, 48, 96, 192, 384, 768, 1536, 3072, 6144};
    enum { SIZES = sizeof sizes / sizeof *sizes };
    static result results[SIZES];
    const unsigned long largest = argc > 1 ? strtoul(argv[1], NULL, 10) : sizes[SIZES - 1];
    size_t count = 0;

    printf("BLAS: %s\n", single_thread());
    printf("median times in us, one thread; dense up to %d components\n", DENSE_COMPONENTS_MAX);
    printf("%10s %8s %11s %11s %11s %11s %11s %8s %8s %9s\n", "components", "unknowns", "U sparse", "U dense",
           "LU (ours)", "dgesv", "UMFPACK", "/dgesv", "/UMFPACK", "error");
    for (; count < SIZES && sizes[count] <= largest; count++) {
        results[count] = measure(sizes[count]);
        print_result(sizes[count], &results[count]);
    }
    for (size_t k = 1; k < count; k++)
        print_crossings((double)sizes[k - 1], (double)sizes[k], &results[k - 1], &results[k]);
    return 0;
}
