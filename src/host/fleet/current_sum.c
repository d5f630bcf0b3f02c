#include "host/fleet/current_sum.h"

#include <math.h>

#include "host/numeric/normal_equations.h"

enum { MEAN, A, B, COLUMNS };

#define TOLD 0.01
#define MADE 1e-10 /* and below this by rounding alone: one current was made of the others */

/* Σ i_read = o + (g_a − g_c) i_a + (g_b − g_c) i_b, since i_c = −i_a − i_b. */
static void add_run(const hci_run *run, hci_normal_equations *to)
{
    for (size_t k = 0; k < run->count; ++k) {
        const double *i = &run->i_A[3 * k];
        const double row[COLUMNS] = {1.0, i[0], i[1]}, sum = i[0] + i[1] + i[2];
        hci_normal_equations_add(to, row, &sum, 1);
    }
}

/* A gain less the mean of the three: weights of the two differences. */
static void take(const hci_normal_equations *normal, const hci_sweep *sweep, double gain[3],
                 double std_error[3])
{
    static const double WEIGHT[3][2] = {
        {2.0 / 3.0, -1.0 / 3.0}, {-1.0 / 3.0, 2.0 / 3.0}, {-1.0 / 3.0, -1.0 / 3.0}};
    const double variance = fmax(sweep->square, 0.0) / fmax(normal->rows - COLUMNS, 1.0);
    if (!sweep->in[A] || !sweep->in[B]) return;
    for (size_t s = 0; s < 3; ++s) {
        const double *w = WEIGHT[s], *a = sweep->a;
        const double square = w[0] * w[0] * a[A * COLUMNS + A] + w[1] * w[1] * a[B * COLUMNS + B] +
                              2.0 * w[0] * w[1] * a[A * COLUMNS + B];
        const double error = sqrt(variance * square);
        if (!(error < TOLD && error > MADE)) continue;
        gain[s] = w[0] * sweep->b[A] + w[1] * sweep->b[B];
        std_error[s] = error;
    }
}

bool hci_current_sum_gains(const hci_runs *runs, double gain[3], double std_error[3])
{
    hci_normal_equations normal = {0};
    hci_sweep sweep = {0};
    for (size_t s = 0; s < 3; ++s)
        gain[s] = std_error[s] = NAN;
    if (!hci_normal_equations_start(&normal, COLUMNS)) return false;
    for (size_t k = 0; k < runs->count; ++k)
        if (runs->role[k] == HCI_ROLE_FIT && runs->run[k].i_A && runs->run[k].has_sum)
            add_run(&runs->run[k], &normal);
    hci_normal_equations_finish(&normal);
    const bool has_memory = hci_sweep_start(&sweep, &normal);
    for (size_t k = 0; has_memory && k < COLUMNS; ++k)
        (void)hci_sweep_in(&sweep, k);
    if (has_memory) take(&normal, &sweep, gain, std_error);
    hci_sweep_release(&sweep);
    hci_normal_equations_release(&normal);
    return has_memory;
}
