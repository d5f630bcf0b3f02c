/* What all motors of a make have in common, fitted to one of them: what its recordings tell, and what they do
 * not. */
#define _XOPEN_SOURCE 700
#include "hci/host/fleet/fit.h"

#include "support/diagnosing.h"

static hci_fleet_fit fit;

void setUp(void)
{
    dataset_start();
}

void tearDown(void)
{
    dataset_end();
}

static const hci_fleet_parameter *parameter(const char *effect, const char *name)
{
    for (size_t k = 0; k < fit.count; ++k)
        if (strcmp(fit.parameter[k].effect, effect) == 0 && strcmp(fit.parameter[k].parameter, name) == 0)
            return &fit.parameter[k];
    TEST_FAIL_MESSAGE(name);
    return NULL;
}

/* Three turns there and back; friction of 0.05 N·m and a phase a that makes more by a share. */
static void fit_share(double iq_A, double share)
{
    const hci_effects none = {NULL, 0};
    hci_note note = {{0}};
    for (int k = 0; k < 2; ++k) {
        record(900, &(point){k ? -60.0 : 60.0, iq_A, 0.0, k ? -0.05 : 0.05, 0.0});
        for (size_t j = 0; j < 900; ++j)
            run[k].torque_Nm[j] += share * K_NM_PER_A * sin(P * run[k].theta_m_rad[j]) * run[k].i_A[3 * j];
    }
    TEST_ASSERT_EQUAL_INT_MESSAGE(HCI_OK, hci_fleet_fit_runs(&machine, &none, &runs, &fit, &note), note.text);
}

static void fit_at(double iq_A)
{
    fit_share(iq_A, 0.1);
    TEST_ASSERT_TRUE(fit.is_found);
}

/* A tenth more in one phase is a third of it in all of them, and what is left of it in each. */
static void test_a_load_tells_the_phases(void)
{
    fit_at(9.0);
    TEST_ASSERT_DOUBLE_WITHIN(0.001, 0.05, parameter("friction", "coulomb")->value);
    TEST_ASSERT_DOUBLE_WITHIN(0.001, 0.1 / 3.0, parameter("back_emf", "common")->value);
    TEST_ASSERT_DOUBLE_WITHIN(0.001, 0.2 / 3.0, parameter("phase_imbalance", "a")->value);
    TEST_ASSERT_DOUBLE_WITHIN(0.001, -0.1 / 3.0, parameter("phase_imbalance", "b")->value);
    TEST_ASSERT_DOUBLE_WITHIN(0.001, -0.1 / 3.0, parameter("phase_imbalance", "c")->value);
}

/* The current makes 1 mN·m beside a noise of 10 mN·m: no share of a phase is told, of the first neither. */
static void test_hardly_a_current_tells_no_phase(void)
{
    static const char *const PHASE[] = {"a", "b", "c"};
    fit_at(0.003);
    TEST_ASSERT_DOUBLE_WITHIN(0.001, 0.05, parameter("friction", "coulomb")->value);
    TEST_ASSERT_TRUE(isnan(parameter("back_emf", "common")->value));
    for (int k = 0; k < 3; ++k)
        TEST_ASSERT_TRUE_MESSAGE(isnan(parameter("phase_imbalance", PHASE[k])->value), PHASE[k]);
}

/* Shares of 0.2 are expected, and six times that of no motor. */
static void test_a_share_that_no_motor_has(void)
{
    fit_share(9.0, 1.15);
    TEST_ASSERT_TRUE(fit.is_found);
    TEST_ASSERT_EQUAL_STRING("", fit.remark.text);
    runs.count = 0;
    for (int k = 0; k < 2; ++k)
        rec_release(&run[k]);
    fit_share(9.0, 1.25);
    TEST_ASSERT_FALSE(fit.is_found);
    TEST_ASSERT_EQUAL_STRING(
        "the least error asks for more phase_imbalance than any motor has, and the declared values stay: the "
        "wiring, the columns or the pole pairs are others than of the machine folder; `check` the recordings",
        fit.remark.text);
    TEST_ASSERT_EQUAL_DOUBLE(fit.rms_before_Nm, fit.rms_after_Nm);
    TEST_ASSERT_TRUE(isnan(parameter("friction", "coulomb")->value));
    TEST_ASSERT_TRUE(isnan(parameter("phase_imbalance", "c")->std_error));
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_a_load_tells_the_phases);
    RUN_TEST(test_hardly_a_current_tells_no_phase);
    RUN_TEST(test_a_share_that_no_motor_has);
    return UNITY_END();
}
