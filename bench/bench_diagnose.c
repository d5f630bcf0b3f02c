/* What recordings cost in processor time: reading them, and diagnosing them once they are read, as a share of
 * reading the same files in the same process.
 *
 * Temporary files with lines of time, angle, speed, three currents and torque, noise in currents and torque:
 * a machine with back-EMF orders 1, 5 and 7 and cogging order 12 at five current levels in both directions,
 * one of each in a file, with cogging of order 18 and friction that the declared model does not have. Twelve
 * runs of 5000 rows, and ten of 100000. Where libcsv was found when this was configured, it reads the same
 * files in the same run, its fields turned into numbers by strtod.
 *
 * usage: bench_diagnose [RUNS ROWS]      one thread; each case is a process of its own, and the median of
 * three */
#define _POSIX_C_SOURCE 200809L

#include <math.h>
#include <stdbool.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>

#ifdef HCI_BENCH_LIBCSV
#include <csv.h>
#endif

#include "hci/host/diagnose/diagnose.h"
#include "hci/machine/frames.h"
#include "support/draws.h"

enum { POLE_PAIRS = 2, EMF_COUNT = 3, COLUMNS = 7, REPEATS = 3, LEVELS = 5, MOST_RUNS = 64, MANY = 20000 };

static const double SAMPLE_s = 50e-6, SPEED_rad_per_s = 40.0, FRICTION_Nm = 0.02;
static const double FEWER_s = 1e-3; /* between rows where they are few, so that a run has some turns */
static const hci_harmonic COGGING[2] = {
    {12.0, 0.03, 0.01}, {18.0, 0.02, -0.01} /* not declared */
};

/* Files of so many rows each. */
typedef struct {
    char path[MOST_RUNS][40];
    size_t runs, rows;
} recordings;

/* What a case takes. */
typedef struct {
    double read_s, diagnose_s, read_MB, diagnose_MB;
    size_t rows;
    int failed, found;
} cost;

/* ---- the recording ---- */

static uint64_t seed = 1;

static void back_emf(hci_wave emf[EMF_COUNT])
{
    static const double order[EMF_COUNT] = {1, 5, 7}, amplitude_Nm_per_A[EMF_COUNT] = {0.14, -0.007, 0.004};
    for (int k = 0; k < EMF_COUNT; ++k)
        emf[k] = hci_wave_polar(order[k], hci_sequence_of_order(order[k]), amplitude_Nm_per_A[k], 0.0);
}

static double cogging_at(const hci_harmonic *h, double theta_rad)
{
    return h->sine * sin(h->order * theta_rad) + h->cosine * cos(h->order * theta_rad);
}

/* Rows of file `number`. */
static void write_recording(FILE *file, size_t rows, size_t number, double step_s)
{
    hci_wave emf[EMF_COUNT];
    back_emf(emf);
    const hci_machine machine = {.pole_pairs = POLE_PAIRS, .back_emf = emf, .back_emf_count = EMF_COUNT};
    const double direction = number % 2 == 0 ? 1.0 : -1.0;
    const hci_dq i = {.d = 0.0, .q = 3.0 * (double)(number / 2 % LEVELS)};
    fputs("time_s,theta_m_rad,speed_rad_per_s,ia_A,ib_A,ic_A,torque_Nm\n", file);
    for (size_t k = 0; k < rows; ++k) {
        const double time_s = step_s * (double)k, speed_rad_per_s = direction * SPEED_rad_per_s;
        const double theta_m_rad = speed_rad_per_s * time_s, theta_rad = POLE_PAIRS * theta_m_rad;
        double i_A[3];
        hci_clarke_inverse(hci_park_inverse(i, theta_rad), i_A);
        const double torque_Nm = hci_torque_at(&machine, theta_rad, i_A) +
                                 cogging_at(&COGGING[0], theta_rad) + cogging_at(&COGGING[1], theta_rad) -
                                 direction * FRICTION_Nm;
        fprintf(file, "%.9g,%.9g,%.9g,%.6g,%.6g,%.6g,%.6g\n", time_s, theta_m_rad, speed_rad_per_s,
                i_A[0] + 0.01 * ref_uniform(&seed, -1.0, 1.0), i_A[1] + 0.01 * ref_uniform(&seed, -1.0, 1.0),
                i_A[2] + 0.01 * ref_uniform(&seed, -1.0, 1.0),
                torque_Nm + 0.005 * ref_uniform(&seed, -1.0, 1.0));
    }
}

/* ---- reading and diagnosing ---- */

static double processor_s(void)
{
    return (double)clock() / CLOCKS_PER_SEC;
}

static double peak_MB(void)
{
    struct rusage usage;
    getrusage(RUSAGE_SELF, &usage);
    return (double)usage.ru_maxrss / 1024.0; /* Linux counts in KiB */
}

static hci_machine_data declared_machine(hci_wave emf[EMF_COUNT])
{
    hci_machine_data m;
    memset(&m, 0, sizeof m);
#define UNKNOWN(field, name, unit) m.field = NAN;
    HCI_MACHINE_VALUES(UNKNOWN)
#undef UNKNOWN
    back_emf(emf);
    m.pole_pairs = POLE_PAIRS;
    m.model = (hci_machine){.pole_pairs = POLE_PAIRS,
                            .back_emf = emf,
                            .back_emf_count = EMF_COUNT,
                            .cogging = COGGING,
                            .cogging_count = 1};
    return m;
}

/* Both hidden effects and nothing else. */
static int is_found(const hci_diagnosis *d)
{
    int cogging = 0, friction = 0, other = 0;
    for (size_t k = 0; k < d->findings; ++k) {
        if (d->finding[k].verdict != HCI_FINDING_ADDED) continue;
        if (strcmp(d->finding[k].effect, "cogging") == 0)
            cogging = 1;
        else if (strcmp(d->finding[k].effect, "friction") == 0)
            friction = 1;
        else
            other = 1;
    }
    return cogging && friction && !other;
}

static hci_status read_all(const recordings *x, hci_run *run, hci_role *role, hci_note *note)
{
    hci_status status = HCI_OK;
    for (size_t r = 0; r < x->runs && !status; ++r) {
        role[r] = HCI_ROLE_FIT;
        status = hci_run_read(x->path[r], &(hci_run_options){.pole_pairs = POLE_PAIRS, .inertia_kgm2 = NAN},
                              &run[r], note);
    }
    return status;
}

static cost use_hci(const recordings *x)
{
    static hci_run run[MOST_RUNS];
    static hci_role role[MOST_RUNS];
    hci_wave emf[EMF_COUNT];
    const hci_machine_data machine = declared_machine(emf);
    const hci_effects none = {0};
    hci_note note = {{0}};
    hci_diagnosis diagnosis;
    cost c = {0};

    double start_s = processor_s();
    c.failed = read_all(x, run, role, &note) != HCI_OK;
    c.read_s = processor_s() - start_s;
    c.read_MB = peak_MB();
    for (size_t r = 0; r < x->runs; ++r)
        c.rows += run[r].count;
    if (c.failed) return c;

    const hci_runs runs = {.run = run, .role = role, .count = x->runs};
    const hci_diagnose_options options = {0};
    start_s = processor_s();
    const hci_status status = hci_diagnose(&machine, &none, &runs, &options, &diagnosis, &note);
    c.diagnose_s = processor_s() - start_s;
    c.diagnose_MB = peak_MB();
    c.failed = status > HCI_NOT_REACHED;
    c.found = !c.failed && is_found(&diagnosis);
    if (!c.failed) hci_diagnosis_release(&diagnosis);
    for (size_t r = 0; r < x->runs; ++r)
        hci_run_release(&run[r]);
    return c;
}

/* ---- the yardstick ---- */

#ifdef HCI_BENCH_LIBCSV
typedef struct {
    double *column[COLUMNS];
    size_t rows, capacity;
    int field, failed;
} table;

static void take_field(void *text, size_t length, void *context)
{
    table *t = (table *)context;
    char *end;
    if (t->field >= COLUMNS) t->failed = 1;
    if (t->rows > 0 && !t->failed) {
        const double value = strtod((const char *)text, &end);
        if (length == 0 || *end != '\0') t->failed = 1;
        t->column[t->field][t->rows - 1] = value;
    }
    ++t->field;
}

/* The row that begins next; row 0 is the header. */
static void take_row(int character, void *context)
{
    table *t = (table *)context;
    (void)character;
    if (t->field != COLUMNS) t->failed = 1;
    t->field = 0;
    ++t->rows;
    if (t->rows <= t->capacity) return;
    t->capacity = t->capacity ? 2 * t->capacity : 1024;
    for (int k = 0; k < COLUMNS; ++k) {
        double *larger = (double *)realloc(t->column[k], t->capacity * sizeof(double));
        if (!larger) exit(4);
        t->column[k] = larger;
    }
}

static void read_table(const char *path, cost *c)
{
    static char buffer[1 << 16];
    struct csv_parser parser;
    table t = {{0}, 0, 0, 0, 0};
    size_t length;
    FILE *file = fopen(path, "r");
    if (!file || csv_init(&parser, CSV_APPEND_NULL)) {
        c->failed = 1;
        return;
    }
    while ((length = fread(buffer, 1, sizeof buffer, file)) > 0)
        if (csv_parse(&parser, buffer, length, take_field, take_row, &t) != length) t.failed = 1;
    csv_fini(&parser, take_field, take_row, &t);
    csv_free(&parser);
    fclose(file);
    c->rows += t.rows - 1; /* the header */
    c->failed |= t.failed;
    c->read_MB = peak_MB();
    for (int k = 0; k < COLUMNS; ++k)
        free(t.column[k]);
}

static cost use_libcsv(const recordings *x)
{
    cost c = {0};
    const double start_s = processor_s();
    for (size_t r = 0; r < x->runs; ++r)
        read_table(x->path[r], &c);
    c.read_s = processor_s() - start_s;
    return c;
}
#endif

/* ---- cases ---- */

/* In a process of its own, so that the peak of memory is that of the case. */
static cost measure(cost (*use)(const recordings *x), const recordings *x)
{
    cost c = {0};
    int ends[2];
    c.failed = 1;
    if (pipe(ends)) return c;
    const pid_t child = fork();
    if (child == 0) {
        const cost mine = use(x);
        _exit(write(ends[1], &mine, sizeof mine) == (ssize_t)sizeof mine ? 0 : 1);
    }
    close(ends[1]);
    if (child > 0 && read(ends[0], &c, sizeof c) != (ssize_t)sizeof c) c.failed = 1;
    close(ends[0]);
    if (child > 0) waitpid(child, NULL, 0);
    return c;
}

static double median3(double a, double b, double c)
{
    return fmax(fmin(a, b), fmin(fmax(a, b), c));
}

static cost median(cost (*use)(const recordings *x), const recordings *x)
{
    cost c[REPEATS];
    for (int k = 0; k < REPEATS; ++k)
        c[k] = measure(use, x);
    c[0].failed |= c[1].failed | c[2].failed;
    c[0].read_s = median3(c[0].read_s, c[1].read_s, c[2].read_s);
    c[0].diagnose_s = median3(c[0].diagnose_s, c[1].diagnose_s, c[2].diagnose_s);
    return c[0];
}

static int report(const recordings *x, double size_MB)
{
    const size_t rows = x->runs * x->rows;
    printf("%zu x %zu rows of %d columns, %.0f MB\n", x->runs, x->rows, COLUMNS, size_MB);
    const cost own = median(use_hci, x);
    if (own.failed || own.rows != rows) return 1;
    printf("  hci_run_read   %8.3f s  %7.1f MB/s  peak %6.0f MB\n", own.read_s, size_MB / own.read_s,
           own.read_MB);
#ifdef HCI_BENCH_LIBCSV
    const cost peer = median(use_libcsv, x);
    if (peer.failed || peer.rows != rows) return 1;
    printf("  libcsv, strtod %8.3f s  %7.1f MB/s  peak %6.0f MB\n", peer.read_s, size_MB / peer.read_s,
           peer.read_MB);
#else
    printf("  libcsv was not found when this was configured\n");
#endif
    printf("  hci_diagnose   %8.3f s  %7.2f times reading  %.2g rows/s  peak %6.0f MB\n", own.diagnose_s,
           own.diagnose_s / own.read_s, (double)rows / (own.read_s + own.diagnose_s), own.diagnose_MB);
    printf("  hidden effects %s\n", own.found ? "found" : "NOT found");
    return !own.found;
}

/* Writes the files; their bytes, -1 where one cannot be written. */
static long files_write(recordings *x)
{
    long bytes = 0;
    for (size_t r = 0; r < x->runs; ++r) {
        strcpy(x->path[r], "/tmp/hci-bench-XXXXXX");
        const int descriptor = mkstemp(x->path[r]);
        FILE *file = descriptor < 0 ? NULL : fdopen(descriptor, "w");
        if (!file) return -1;
        write_recording(file, x->rows, r, x->rows < MANY ? FEWER_s : SAMPLE_s);
        bytes += ftell(file);
        fclose(file);
    }
    return bytes;
}

static int bench(size_t runs, size_t rows)
{
    static recordings x;
    x.runs = runs;
    x.rows = rows;
    const long bytes = files_write(&x);
    int failed = 1;
    if (bytes < 0)
        fprintf(stderr, "bench_diagnose: cannot write in /tmp\n");
    else
        failed = report(&x, 1e-6 * (double)bytes);
    for (size_t r = 0; r < runs; ++r)
        unlink(x.path[r]);
    if (failed) fprintf(stderr, "bench_diagnose: failed\n");
    return failed;
}

int main(int argc, char **argv)
{
    const size_t runs = argc > 2 ? (size_t)strtoul(argv[1], NULL, 10) : 0;
    const size_t rows = argc > 2 ? (size_t)strtoul(argv[2], NULL, 10) : 0;
    if (argc > 2 && (runs == 0 || runs > MOST_RUNS || rows == 0)) {
        fprintf(stderr, "usage: bench_diagnose [RUNS ROWS], 1 to %d runs\n", MOST_RUNS);
        return 2;
    }
    if (argc > 2) return bench(runs, rows);
    const int list = bench(12, 5000), tens = bench(10, 100000);
    return list || tens;
}
