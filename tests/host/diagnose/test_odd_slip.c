/* Every slip that a file may have is found in a recording that has it, and nothing where no slip would do. */
#define _XOPEN_SOURCE 700
#include "host/diagnose/odd_slip.h"

#include "host/diagnose/run_errors.h"
#include "support/diagnosing.h"

enum { SAMPLES = 300 };

static const double COGGING_NM = 0.15;

static hci_effect_term ripple[1];
static hci_effect cogging;
static hci_effects effects;
static hci_run_errors errors;
static hci_odd_run odd;

/* A turn at 5 A, with a cogging torque, so that currents and torque of another sign are not the same. */
void setUp(void)
{
    dataset_start();
    ripple[0] = (hci_effect_term){0, 2.0, COGGING_NM, NAN};
    cogging = (hci_effect){hci_effect_type_find("cogging"), ripple, 1};
    effects = (hci_effects){&cogging, 1};
    record(SAMPLES, &(point){60.0, 5.0, 0.0, 0.0, 0.0});
    for (size_t k = 0; k < SAMPLES; ++k)
        run[0].torque_Nm[k] += COGGING_NM * sin(2.0 * P * run[0].theta_m_rad[k]);
    memset(&odd, 0, sizeof odd);
}

void tearDown(void)
{
    dataset_end();
}

/* Its error as it stands, and then what makes it. */
static const char *find(double least_Nm)
{
    hci_dataset dataset = {.work = 0.0};
    hci_diagnosis d;
    hci_note note = {{0}};
    memset(&odd, 0, sizeof odd);
    TEST_ASSERT_EQUAL_INT(HCI_OK, hci_dataset_make(&machine, &effects, &runs, &dataset, &note));
    TEST_ASSERT_EQUAL_INT(HCI_OK, hci_run_errors_of(&dataset, &runs, &effects, &d, &note));
    errors = d.run[0];
    hci_memory_free(d.run);
    hci_dataset_release(&dataset);
    const hci_lone_run lone = {&machine, &effects, run[0], HCI_ROLE_FIT, least_Nm};
    TEST_ASSERT_EQUAL_INT_MESSAGE(HCI_OK, hci_odd_slip_find(&lone, &errors, &odd, &note), note.text);
    return odd.slip;
}

/* ---- slips of the file ---- */

/* What was written: the phase that stands at a, b and c, and factors of currents and torque. */
static void write_file(const int phase[3], double current, double torque)
{
    for (size_t k = 0; k < SAMPLES; ++k) {
        double *i = run[0].i_A + 3 * k;
        const double read[3] = {i[0], i[1], i[2]};
        for (int s = 0; s < 3; ++s)
            i[s] = current * read[phase[s]];
        run[0].torque_Nm[k] *= torque;
    }
}

static void test_slips_of_a_file(void)
{
    static const struct {
        int phase[3];
        double current, torque;
        const char *words;
    } SLIP[] = {{{0, 2, 1}, 1.0, 1.0, "phases b and c are swapped in its file"},
                {{1, 0, 2}, 1.0, 1.0, "phases a and b are swapped in its file"},
                {{2, 1, 0}, 1.0, 1.0, "phases a and c are swapped in its file"},
                {{1, 2, 0}, 1.0, 1.0, "the phases of its file are shifted: a, b, c stand for b, c, a"},
                {{2, 0, 1}, 1.0, 1.0, "the phases of its file are shifted: a, b, c stand for c, a, b"},
                {{0, 1, 2}, 1.0, -1.0, "the torque of its file has the other sign"},
                {{0, 1, 2}, -1.0, 1.0, "the currents of its file have the other sign"},
                {{0, 1, 2}, 1.0, 100.0, "the torque of its file is 100 times too large (N·cm for N·m)"},
                {{0, 1, 2}, 1.0, 0.01, "the torque of its file is 100 times too small"},
                {{0, 1, 2}, 1.0, 1000.0, "the torque of its file is 1000 times too large (mN·m for N·m)"},
                {{0, 1, 2}, 1.0, 0.001, "the torque of its file is 1000 times too small (kN·m for N·m)"},
                {{0, 1, 2}, 0.7071067811865475, 1.0, "the currents of its file are rms values"},
                {{0, 1, 2}, 1.4142135623730951, 1.0, "the currents of its file are √2 too large"},
                {{0, 1, 2}, 1000.0, 1.0, "the currents of its file are 1000 times too large (mA for A)"}};
    for (size_t k = 0; k < sizeof SLIP / sizeof *SLIP; ++k) {
        if (k > 0) {
            tearDown();
            setUp();
        }
        write_file(SLIP[k].phase, SLIP[k].current, SLIP[k].torque);
        TEST_ASSERT_EQUAL_STRING(SLIP[k].words, find(0.0));
        TEST_ASSERT_TRUE_MESSAGE(odd.mended, SLIP[k].words);
        TEST_ASSERT_DOUBLE_WITHIN(0.1 * NOISE_NM, NOISE_NM, odd.mended_Nm);
        TEST_ASSERT_EQUAL_DOUBLE(0.0, odd.angle_rad);
    }
}

/* ---- the angle ---- */

/* Ahead by 25° and by 22.4° mechanical, three times that electrical, on and between the angles that are tried
 * first; the currents are those that flowed. */
static void test_another_index_of_the_angle(void)
{
    for (int n = 0; n < 4; ++n) {
        const double sign = n % 2 ? 1.0 : -1.0, ahead_deg = n < 2 ? 25.0 : 22.4;
        tearDown();
        setUp();
        const double ahead = sign * ahead_deg * REF_PI / 180.0;
        for (size_t k = 0; k < SAMPLES; ++k)
            run[0].theta_m_rad[k] += ahead;
        double mechanical = 0.0, electrical = 0.0;
        TEST_ASSERT_EQUAL_INT(2, sscanf(find(0.0), "its angle is ahead by %lf° mechanical (%lf° electrical)",
                                        &mechanical, &electrical));
        TEST_ASSERT_DOUBLE_WITHIN(0.1, sign * ahead_deg, mechanical);
        TEST_ASSERT_DOUBLE_WITHIN(0.3, sign * 3.0 * ahead_deg, electrical);
        TEST_ASSERT_TRUE(odd.mended);
        TEST_ASSERT_DOUBLE_WITHIN(1e-3, ahead, odd.angle_rad);
        TEST_ASSERT_DOUBLE_WITHIN(0.1 * NOISE_NM, NOISE_NM, odd.mended_Nm);
    }
}

/* ---- a zero of its own, and nothing simple ---- */

static void test_another_zero_of_the_torque(void)
{
    for (size_t k = 0; k < SAMPLES; ++k)
        run[0].torque_Nm[k] += 0.75;
    const char *words = find(0.0);
    TEST_ASSERT_EQUAL_STRING("its torque has a zero of its own, 0.75 N·m", words);
    TEST_ASSERT_FALSE(odd.mended);
}

/* What is left beside the mean is noise up to one and a half times that, or the least that matters. */
static void test_a_ripple_beside_the_zero(void)
{
    for (size_t k = 0; k < SAMPLES; ++k)
        run[0].torque_Nm[k] += 2.0 + 0.4 * sin(5.0 * run[0].theta_m_rad[k]);
    TEST_ASSERT_EQUAL_STRING("", find(0.0));
    TEST_ASSERT_EQUAL_STRING("", find(0.99 * errors.ripple_before_Nm));
    TEST_ASSERT_EQUAL_STRING("its torque has a zero of its own, 2 N·m", find(1.01 * errors.ripple_before_Nm));
}

/* A slip that leaves less than a third is named, and mends nothing while more than noise is left. */
static void test_a_slip_beside_something_else(void)
{
    static const int SAME[3] = {0, 1, 2};
    for (int named = 0; named < 2; ++named) {
        tearDown();
        setUp();
        write_file(SAME, 1.0, -1.0);
        for (size_t k = 0; k < SAMPLES; ++k)
            run[0].torque_Nm[k] += (named ? 0.5 : 1.9) * sin(5.0 * run[0].theta_m_rad[k]);
        TEST_ASSERT_EQUAL_STRING(named ? "the torque of its file has the other sign" : "", find(0.0));
        TEST_ASSERT_FALSE(odd.mended);
        TEST_ASSERT_EQUAL(named, odd.mended_Nm > 0.0);
    }
}

/* ---- what noise is ---- */

static void test_an_error_that_is_noise(void)
{
    hci_run_errors e = {.rms_before_Nm = 0.149, .noise_floor_Nm = 0.1};
    TEST_ASSERT_TRUE(hci_error_is_noise(&e, 0.0));
    e.rms_before_Nm = 0.151;
    TEST_ASSERT_FALSE(hci_error_is_noise(&e, 0.15));
    TEST_ASSERT_TRUE(hci_error_is_noise(&e, 0.152));
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_slips_of_a_file);
    RUN_TEST(test_another_index_of_the_angle);
    RUN_TEST(test_another_zero_of_the_torque);
    RUN_TEST(test_a_ripple_beside_the_zero);
    RUN_TEST(test_a_slip_beside_something_else);
    RUN_TEST(test_an_error_that_is_noise);
    return UNITY_END();
}
