/* What one evaluation of a current table costs on this computer, beside the two things it stands between:
 * calling sinf for the same harmonics, and the barest linear interpolation of two columns that C can express.
 *
 * The table holds phase currents of a star connection (ia and ib; ic follows): 512 points, and the
 * fundamental with twelve harmonics, the size of the papers' scenario 2. The angle advances by an odd step,
 * so every row is visited. */
#define _POSIX_C_SOURCE 200809L

#include <math.h>
#include <stdint.h>
#include <stdio.h>

#include "hci/table.h"
#include "timing.h"

enum { POINTS = 512, POINTS_LOG2 = 9, HARMONICS = 13, EVALUATIONS = 20000 };

static const float two_pi = 6.28318531f;
static const float third_rad = 2.09439510f;
static const float order[HARMONICS] = {1, 5, 5, 7, 11, 13, 19, 25, 29, 29, 31, 35, 37};
static float amplitude_A[HARMONICS], phase_rad[HARMONICS];

static float one_part[(POINTS + 1) * 2], two_parts[(POINTS + 1) * 4];
static hci_table_f32 abc, dq, abc_torque;
static volatile float sink; /* keeps the sums from being optimised away */

/* ia, ib of Σ A sin(nθ − 2πs/3 + γ): what a program without a table would do. */
static hci_currents_abc by_sines(float theta_rad)
{
    hci_currents_abc i = {0.0f, 0.0f, 0.0f};
    for (int k = 0; k < HARMONICS; k++) {
        const float angle_rad = order[k] * theta_rad + phase_rad[k];
        i.ia_A += amplitude_A[k] * sinf(angle_rad);
        i.ib_A += amplitude_A[k] * sinf(angle_rad - third_rad);
    }
    i.ic_A = -i.ia_A - i.ib_A;
    return i;
}

static void make_tables(void)
{
    for (int k = 0; k < HARMONICS; k++) {
        amplitude_A[k] = 12.0f / order[k];
        phase_rad[k] = 0.7f * (float)k;
    }
    for (int j = 0; j <= POINTS; j++) {
        const hci_currents_abc i = by_sines(two_pi * (float)(j % POINTS) / (float)POINTS);
        one_part[2 * j] = two_parts[4 * j] = i.ia_A;
        one_part[2 * j + 1] = two_parts[4 * j + 1] = i.ib_A;
        two_parts[4 * j + 2] = 0.1f * i.ib_A;
        two_parts[4 * j + 3] = 0.1f * i.ia_A;
    }
    abc.rows = one_part;
    abc.points = POINTS;
    abc.columns = 2u;
    abc.parts = 1u;
    abc.frame = HCI_TABLE_ABC;
    abc.period_turns = 1u;
    dq = abc_torque = abc;
    dq.frame = HCI_TABLE_DQ;
    abc_torque.parts = 2u;
    abc_torque.rows = two_parts;
}

/* ---- the contestants: EVALUATIONS angles each ---- */

static uint32_t angle_of(uint32_t k)
{
    return k * 8675309u;
}

static void run_abc(void *context)
{
    const hci_table_f32 *table = (const hci_table_f32 *)context;
    float sum = 0.0f;
    for (uint32_t k = 0; k < EVALUATIONS; k++) {
        const hci_currents_abc i = hci_table_f32_abc(table, angle_of(k));
        sum += i.ia_A + i.ib_A * i.ic_A;
    }
    sink = sum;
}

static void run_dq(void *context)
{
    const hci_table_f32 *table = (const hci_table_f32 *)context;
    float sum = 0.0f;
    for (uint32_t k = 0; k < EVALUATIONS; k++) {
        const hci_currents_dq i = hci_table_f32_dq(table, angle_of(k));
        sum += i.id_A + i.iq_A;
    }
    sink = sum;
}

static void run_abc_torque(void *context)
{
    const hci_table_f32 *table = (const hci_table_f32 *)context;
    float sum = 0.0f;
    for (uint32_t k = 0; k < EVALUATIONS; k++) {
        const hci_currents_abc i = hci_table_f32_abc_torque(table, angle_of(k), (float)k);
        sum += i.ia_A + i.ib_A * i.ic_A;
    }
    sink = sum;
}

/* A fixed table of 2^POINTS_LOG2 points: no struct, no multiplication for the row. */
static void run_bare(void *context)
{
    const float *rows = (const float *)context;
    float sum = 0.0f;
    for (uint32_t k = 0; k < EVALUATIONS; k++) {
        const uint32_t angle = angle_of(k);
        const float *row = rows + 2u * (angle >> (32 - POINTS_LOG2));
        const float f = (float)(angle << POINTS_LOG2) * 2.32830644e-10f; /* 2^−32 */
        const float ia_A = row[0] + f * (row[2] - row[0]), ib_A = row[1] + f * (row[3] - row[1]);
        sum += ia_A + ib_A * (-ia_A - ib_A);
    }
    sink = sum;
}

static void run_sines(void *context)
{
    float sum = 0.0f;
    (void)context;
    for (uint32_t k = 0; k < EVALUATIONS; k++) {
        const hci_currents_abc i = by_sines((float)angle_of(k) * (two_pi * 2.32830644e-10f));
        sum += i.ia_A + i.ib_A * i.ic_A;
    }
    sink = sum;
}

/* ---- the table ---- */

/* The table and the sines must tell the same currents, or the comparison means nothing: 37 periods on 512
 * points are followed to (π·37/512)²/2 of 12/37 A, and the other orders likewise, in all below 0.5 A. */
static int same_currents(void)
{
    for (uint32_t k = 0; k < 1000; k++) {
        const hci_currents_abc i = hci_table_f32_abc(&abc, angle_of(k));
        const hci_currents_abc s = by_sines((float)angle_of(k) * (two_pi * 2.32830644e-10f));
        if (fabsf(i.ia_A - s.ia_A) > 0.5f || fabsf(i.ib_A - s.ib_A) > 0.5f) return 0;
    }
    return 1;
}

static void report(const char *what, double each_ns, double sines_ns, double bare_ns)
{
    printf("%-42s %9.2f %9.4f %9.2f\n", what, each_ns, each_ns / sines_ns, each_ns / bare_ns);
}

int main(void)
{
    make_tables();
    if (!same_currents()) {
        fprintf(stderr, "bench_table: the table and the sines disagree\n");
        return 4;
    }
    const double each = 1e9 / EVALUATIONS;
    const double sines_ns = each * bench_median_s(run_sines, NULL);
    const double bare_ns = each * bench_median_s(run_bare, one_part);
    printf("%d points, %d harmonics, medians; ns and ratios for one angle\n", POINTS, HARMONICS);
    printf("%-42s %9s %9s %9s\n", "", "ns", "/sinf", "/bare");
    report("sinf of every harmonic, two phases", sines_ns, sines_ns, bare_ns);
    report("bare linear interpolation, two columns", bare_ns, sines_ns, bare_ns);
    report("hci_table_f32_abc", each * bench_median_s(run_abc, &abc), sines_ns, bare_ns);
    report("hci_table_f32_dq", each * bench_median_s(run_dq, &dq), sines_ns, bare_ns);
    report("hci_table_f32_abc_torque", each * bench_median_s(run_abc_torque, &abc_torque), sines_ns, bare_ns);
    return 0;
}
