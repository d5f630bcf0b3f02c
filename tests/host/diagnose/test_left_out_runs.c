/* How well each recording, of which there are so few that they are left out in halves, is described by what
 * remains does not depend on which is listed first. */
#define _XOPEN_SOURCE 700
#include "support/diagnosing.h"

enum { SAMPLES = 600, RUNS = 2 };

void setUp(void)
{
    dataset_start();
}

void tearDown(void)
{
    dataset_end();
}

/* Half with a small current and half with a large one, where the torque per ampere is 5 % more and there is
 * friction. */
static void record_halves(double speed, double small_A, double large_A)
{
    record(SAMPLES, &(point){speed, small_A, 0.0, speed > 0.0 ? 0.05 : -0.05, 0.0});
    hci_run *r = &run[runs.count - 1];
    for (size_t k = 0; k < SAMPLES; ++k) {
        const double iq_A = k < SAMPLES / 2 ? small_A : large_A;
        rec_phases(0.0, iq_A, P * r->theta_m_rad[k], r->i_A + 3 * k);
        r->torque_Nm[k] += 1.5 * K_NM_PER_A * (1.05 * iq_A - small_A);
    }
}

static void record_all(void)
{
    record_halves(60.0, 1.0, 9.0);
    record_halves(-100.0, 6.0, 2.0);
}

static void misfits_find(double misfit[RUNS])
{
    diagnose(NULL);
    TEST_ASSERT_EQUAL_UINT64(RUNS, diagnosis.uncertainty.runs);
    for (int k = 0; k < RUNS; ++k)
        misfit[k] = diagnosis.uncertainty.run[k].misfit;
}

static void test_the_first_is_as_the_last(void)
{
    double before[RUNS], after[RUNS], square = 0.0;
    record_all();
    misfits_find(before);
    for (int k = 0; k < RUNS; ++k)
        square += before[k] * before[k] / RUNS;
    TEST_ASSERT_DOUBLE_WITHIN(1e-9, 1.0, square);
    for (int k = 0; k < RUNS / 2; ++k) {
        const hci_run other = run[k];
        run[k] = run[RUNS - 1 - k];
        run[RUNS - 1 - k] = other;
    }
    hci_diagnosis_release(&diagnosis);
    misfits_find(after);
    for (int k = 0; k < RUNS; ++k)
        TEST_ASSERT_DOUBLE_WITHIN(1e-3, before[k], after[RUNS - 1 - k]);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_the_first_is_as_the_last);
    return UNITY_END();
}
