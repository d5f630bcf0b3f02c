/* Wall time of a repeated run: one run to warm up, then the median of many. Needs _POSIX_C_SOURCE >= 199309L.
 */
#ifndef HCI_BENCH_TIMING_H
#define HCI_BENCH_TIMING_H

#include <stdlib.h>
#include <time.h>

typedef void bench_run(void *context);

static inline double bench_now_s(void)
{
    struct timespec t;
    clock_gettime(CLOCK_MONOTONIC, &t);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

static inline int bench_compare(const void *a, const void *b)
{
    const double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

/* At least 5 runs (3 when one takes longer than a second), at most 501, and about 0.3 s in all. */
static inline double bench_median_s(bench_run *run, void *context)
{
    enum { RUNS_MAX = 501 };
    double taken_s[RUNS_MAX], total_s = 0.0;
    size_t count = 0;
    run(context);
    while (count < RUNS_MAX && (total_s < 0.3 || count < (total_s > 5.0 ? 3u : 5u))) {
        const double start_s = bench_now_s();
        run(context);
        taken_s[count] = bench_now_s() - start_s;
        total_s += taken_s[count++];
    }
    qsort(taken_s, count, sizeof *taken_s, bench_compare);
    return taken_s[count / 2];
}

#endif
