/* A torque that a drive computed is never taken as measured: by its name, or since it is k_t·i_q in every
 * row. */
#include "host/recording/computed_torque.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "hci/host/recording/run.h"
#include "support/draws.h"
#include "support/run_file.h"
#include "support/texts.h"
#include "unity.h"

enum { N = 400 };

static double iq[N], torque[N], constant;
static uint64_t seed;

void setUp(void)
{
    seed = 5;
    run_file_begin();
    for (size_t k = 0; k < N; ++k)
        iq[k] = 3.0 + sin(0.3 * (double)k);
}

void tearDown(void)
{
    run_file_end();
}

/* ---- in every row the same constant */

static void test_rounding_is_let_pass(void)
{
    for (size_t k = 0; k < N; ++k) {
        iq[k] = 0.01 * floor(iq[k] / 0.01 + 0.5);
        torque[k] = 1e-3 * floor(0.0512 * iq[k] / 1e-3 + 0.5);
    }
    TEST_ASSERT_TRUE(hci_torque_is_of_current(torque, iq, N, &constant));
    TEST_ASSERT_DOUBLE_WITHIN(2e-5, 0.0512, constant);
}

/* A measured torque: with noise or cogging of a thousandth, with a zero of its own, or in another sample. */
static void test_a_measured_torque_is_none(void)
{
    for (size_t k = 0; k < N; ++k)
        torque[k] = 0.05 * iq[k] * (1.0 + 1e-3 * ref_normal(&seed));
    TEST_ASSERT_FALSE(hci_torque_is_of_current(torque, iq, N, &constant));
    for (size_t k = 0; k < N; ++k)
        torque[k] = 0.05 * iq[k] + 2e-4 * sin(1.1 * (double)k);
    TEST_ASSERT_FALSE(hci_torque_is_of_current(torque, iq, N, &constant));
    for (size_t k = 0; k < N; ++k)
        torque[k] = 0.05 * iq[k] + 1e-3;
    TEST_ASSERT_FALSE(hci_torque_is_of_current(torque, iq, N, &constant));
    for (size_t k = 0; k < N; ++k)
        torque[k] = 0.05 * iq[k > 0 ? k - 1 : 0];
    TEST_ASSERT_FALSE(hci_torque_is_of_current(torque, iq, N, &constant));
}

/* A table of one current says nothing, and neither do few rows. */
static void test_it_takes_currents_that_vary(void)
{
    for (size_t k = 0; k < N; ++k)
        torque[k] = 0.05 * (iq[k] = 3.0);
    TEST_ASSERT_FALSE(hci_torque_is_of_current(torque, iq, N, &constant));
    for (size_t k = 0; k < N; ++k)
        torque[k] = 0.05 * (iq[k] = (double)k);
    TEST_ASSERT_FALSE(hci_torque_is_of_current(torque, iq, 15, &constant));
    TEST_ASSERT_TRUE(hci_torque_is_of_current(torque, iq, 16, &constant));
    memset(torque, 0, sizeof torque);
    TEST_ASSERT_FALSE(hci_torque_is_of_current(torque, iq, N, &constant));
}

/* ---- in a run */

static void read_log(const char *header, double inertia_kgm2, double torque_constant)
{
    const hci_run_options options = {
        .pole_pairs = 7, .inertia_kgm2 = inertia_kgm2, .torque_constant_Nm_per_A = torque_constant};
    FILE *file = fopen(path, "w");
    TEST_ASSERT_NOT_NULL(file);
    fprintf(file, "time_s,theta_m_rad,%s\n", header);
    for (size_t k = 0; k < N; ++k)
        fprintf(file, "%.4f,%.6f,%.6f,%.6f\n", 1e-3 * (double)k, 0.02 * (double)k, 0.05 * iq[k], iq[k]);
    fclose(file);
    hci_run_release(&run);
    TEST_ASSERT_EQUAL_MESSAGE(HCI_OK, hci_run_read(path, &options, &run, &note), note.text);
}

static void test_by_its_name(void)
{
    static const char *const NAMES[] = {"torque_estimate", "axis0.motor.torque_estimate", "Torque est (N*m)",
                                        "torque_calc", "torque_computed_Nm"};
    for (size_t k = 0; k < sizeof NAMES / sizeof *NAMES; ++k) {
        char header[64];
        snprintf(header, sizeof header, "%s,lamp", NAMES[k]);
        read_log(header, NAN, 0.0);
        TEST_ASSERT_EQUAL_MESSAGE(HCI_TORQUE_NONE, run.torque_source, NAMES[k]);
        TEST_ASSERT_NULL(run.torque_Nm);
        text_has("is a torque that the drive has computed from its current: it is not used", run.remark.text);
    }
    read_log("torque,q_current", NAN, 0.0);
    TEST_ASSERT_NULL(run.torque_Nm);
}

/* What the drive counts on, by all of sixteen rows that have both numbers; a first row that is not of the
 * others tells that there is none. */
static void test_the_constant_of_the_drive(void)
{
    for (int what = 0; what < 4; ++what) {
        const hci_run_options options = {.pole_pairs = 7, .inertia_kgm2 = NAN};
        FILE *file = fopen(path, "w");
        TEST_ASSERT_NOT_NULL(file);
        fprintf(file, "time_s,theta_m_rad,torque_estimate,iq_A\n");
        for (size_t k = 0; k < (what == 1 ? 15 : what == 3 ? 17 : 16); ++k) {
            fprintf(file, "%.4f,%.6f,", 1e-3 * (double)k, 0.02 * (double)k);
            if (what != 3 || k != 7) fprintf(file, "%.6f", what == 2 && k == 0 ? 0.3 : 0.05 * iq[k]);
            fprintf(file, ",%.6f\n", iq[k]);
        }
        fclose(file);
        hci_run_release(&run);
        TEST_ASSERT_EQUAL_MESSAGE(HCI_OK, hci_run_read(path, &options, &run, &note), note.text);
        TEST_ASSERT_DOUBLE_WITHIN(1e-5, what == 0 || what == 3 ? 0.05 : 0.0, run.drive_constant_Nm_per_A);
    }
}

static void test_by_its_values(void)
{
    read_log("torque_Nm,iq_A", NAN, 0.0);
    TEST_ASSERT_EQUAL(HCI_TORQUE_NONE, run.torque_source);
    TEST_ASSERT_NULL(run.torque_Nm);
    text_has("the torque is 0.05 N·m/A times i_q in every row", run.remark.text);
    read_log("torque_Nm,iq_A", 1e-3, 0.0); /* what is left is a free shaft */
    TEST_ASSERT_EQUAL(HCI_TORQUE_INERTIA, run.torque_source);
}

static void test_without_a_current_it_is_one(void)
{
    read_log("torque_estimate,lamp", NAN, 0.1);
    TEST_ASSERT_NULL(run.torque_Nm);
    for (size_t k = 0; k < N; ++k) {
        const double theta = 7.0 * 0.02 * (double)k;
        TEST_ASSERT_DOUBLE_WITHIN(1e-4, 0.5 * iq[k] * sin(theta), run.i_A[3 * k]);
    }
    text_has("i_q is that torque over 0.1 N·m/A", run.remark.text);
    read_log("torque_estimate,iq_A", NAN, 0.1);
    TEST_ASSERT_DOUBLE_WITHIN(1e-4, iq[10] * sin(1.4), run.i_A[30]);
}

/* One number in every row beside a current that varies: of a brake, that somebody has typed. */
static void read_number(double torque_Nm, double step_Nm)
{
    const hci_run_options options = {.pole_pairs = 7, .inertia_kgm2 = 1e-3, .torque_constant_Nm_per_A = 0.05};
    FILE *file = fopen(path, "w");
    TEST_ASSERT_NOT_NULL(file);
    fprintf(file, "time_s,theta_m_rad,iq_A,torque_Nm\n");
    for (size_t k = 0; k < N; ++k)
        fprintf(file, "%.4f,%.6f,%.6f,%.4f\n", 1e-3 * (double)k, 0.02 * (double)k, iq[k],
                torque_Nm + (k == 7 ? step_Nm : 0.0));
    fclose(file);
    hci_run_release(&run);
    TEST_ASSERT_EQUAL_MESSAGE(HCI_OK, hci_run_read(path, &options, &run, &note), note.text);
}

static void test_one_number_is_typed(void)
{
    read_number(0.4, 0.0);
    TEST_ASSERT_EQUAL(HCI_TORQUE_NONE, run.torque_source);
    TEST_ASSERT_TRUE(run.torque_is_typed);
    text_has("the torque is 0.4 N·m in every row while the current varies", run.remark.text);
    read_number(0.4, 0.001);
    TEST_ASSERT_EQUAL(HCI_TORQUE_MEASURED, run.torque_source);
    read_number(0.0, 0.0);
    TEST_ASSERT_EQUAL(HCI_TORQUE_HOLDING, run.torque_source);
    for (size_t k = 0; k < N; ++k) /* a machine that needs no other current for it */
        iq[k] = 3.0;
    read_number(0.4, 0.0);
    TEST_ASSERT_EQUAL(HCI_TORQUE_MEASURED, run.torque_source);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_rounding_is_let_pass);
    RUN_TEST(test_a_measured_torque_is_none);
    RUN_TEST(test_it_takes_currents_that_vary);
    RUN_TEST(test_by_its_name);
    RUN_TEST(test_the_constant_of_the_drive);
    RUN_TEST(test_by_its_values);
    RUN_TEST(test_without_a_current_it_is_one);
    RUN_TEST(test_one_number_is_typed);
    return UNITY_END();
}
