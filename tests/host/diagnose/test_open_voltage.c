/* Voltages of a shaft that something drives, recorded without a current: they are compared with the declared
 * back-EMF, and what contradicts them is not kept. */
#define _XOPEN_SOURCE 700
#include "host/diagnose/open_voltage.h"

#include "support/diagnosing.h"

enum { N = 600 };

static double voltage[MOST_RUNS][3 * N];

void setUp(void)
{
    dataset_start();
}

void tearDown(void)
{
    for (size_t k = 0; k < MOST_RUNS; ++k)
        run[k].v_V = NULL;
    dataset_end();
}

/* At 100 rad/s, 300 samples a turn; scale: of the back-EMF of 0.2 V·s/rad; a fifth harmonic of it too. */
static void record_open(double scale, double fifth, double noise_V)
{
    const size_t r = runs.count;
    record(N, &(point){100.0, 0.0, 0.0, 0.0, 0.0});
    run[r].v_V = voltage[r];
    for (size_t k = 0; k < N; ++k)
        for (int s = 0; s < 3; ++s) {
            const double x = P * run[r].theta_m_rad[k] - 2.0 * REF_PI * s / 3.0;
            voltage[r][3 * k + (size_t)s] = 100.0 * K_NM_PER_A * (scale * sin(x) + fifth * sin(5.0 * x)) +
                                            noise_V * ref_normal(&seed) + 3.0;
        }
}

/* A common voltage of the phases and noise are no difference. */
static void test_difference(void)
{
    record_open(1.0, 0.0, 0.5);
    TEST_ASSERT_DOUBLE_WITHIN(0.01, 0.0, hci_open_voltage_off(&machine.model, &runs));
    TEST_ASSERT_TRUE(hci_open_voltage_agrees(&machine.model, &runs));
    record_open(0.9, 0.0, 0.5);
    TEST_ASSERT_DOUBLE_WITHIN(0.005, 0.1 / sqrt(2.0), hci_open_voltage_off(&machine.model, &runs));
    TEST_ASSERT_FALSE(hci_open_voltage_agrees(&machine.model, &runs));
}

static void test_none(void)
{
    record_open(0.8, 0.0, 0.0);
    rec_phases(0.0, 1.0, 0.3, run[0].i_A + 30); /* a current flows */
    TEST_ASSERT_EQUAL_DOUBLE(0.0, hci_open_voltage_off(&machine.model, &runs));
    TEST_ASSERT_FALSE(hci_open_voltage_agrees(&machine.model, &runs));
}

/* The size alone, beside other harmonics, and where noise is read as a current. */
static void test_scale(void)
{
    TEST_ASSERT_TRUE(isnan(hci_open_voltage_scale(&machine.model, &runs)));
    record_open(1.03, 0.05, 0.1);
    TEST_ASSERT_DOUBLE_WITHIN(1e-3, 1.03, hci_open_voltage_scale(&machine.model, &runs));
    for (size_t k = 0; k < 3 * N; ++k)
        run[0].i_A[k] = 0.01 * ref_normal(&seed);
    TEST_ASSERT_DOUBLE_WITHIN(1e-3, 1.03, hci_open_voltage_scale(&machine.model, &runs));
    for (size_t k = 0; k < N; ++k)
        rec_phases(0.0, 1.0, P * run[0].theta_m_rad[k], run[0].i_A + 3 * k);
    TEST_ASSERT_TRUE(isnan(hci_open_voltage_scale(&machine.model, &runs)));
}

/* A fifth harmonic of share f leaves f²/2 of each of n phase samples: by white noise the scale has the error
 * f √(0.5/n), without a third for the mean of the phases; and it is well known where f²/3n is below 2e-3². */
static void test_error_of_the_scale(void)
{
    double error;
    record_open(1.03, 0.02, 0.0);
    TEST_ASSERT_DOUBLE_WITHIN(1e-9, 1.03, hci_open_voltage_scale_fitted(&machine.model, &runs, &error));
    TEST_ASSERT_DOUBLE_WITHIN(1e-9, 0.02 * sqrt(0.5 / N), error);
    record_open(1.05, 0.02, 0.0); /* two as long are 1.04, and 0.01 off it each */
    TEST_ASSERT_DOUBLE_WITHIN(1e-9, 1.04, hci_open_voltage_scale_fitted(&machine.model, &runs, &error));
    TEST_ASSERT_DOUBLE_WITHIN(1e-9, sqrt((0.02 * 0.02 + 0.01 * 0.01) * 0.25 / N), error);
    role[1] = HCI_ROLE_HOLDOUT;
    TEST_ASSERT_DOUBLE_WITHIN(1e-9, 1.03, hci_open_voltage_scale_fitted(&machine.model, &runs, &error));
    TEST_ASSERT_DOUBLE_WITHIN(1e-9, 1.04, hci_open_voltage_scale(&machine.model, &runs));
    role[0] = HCI_ROLE_HOLDOUT;
    TEST_ASSERT_TRUE(isnan(hci_open_voltage_scale_fitted(&machine.model, &runs, &error)) && isnan(error));
}

static void test_a_scale_that_is_not_well_known(void)
{
    for (int more = 0; more < 2; ++more) {
        runs.count = 0;
        rec_release(&run[0]);
        record_open(1.0, (more ? 1.01 : 0.99) * 2e-3 * sqrt(3.0 * N), 0.0);
        TEST_ASSERT_EQUAL(more, isnan(hci_open_voltage_scale(&machine.model, &runs)));
    }
}

static hci_status find(void)
{
    hci_note note = {{0}};
    return hci_diagnose(&machine, &(hci_effects){NULL, 0}, &runs, &options, &diagnosis, &note);
}

/* Torques without a current leave noise alone, but a fifth harmonic of the voltages is declared nowhere. */
static void test_nothing_in_the_torque(void)
{
    char words[2048];
    record_open(1.0, 0.05, 0.1);
    TEST_ASSERT_EQUAL_INT(HCI_NOT_REACHED, find());
    TEST_ASSERT_EQUAL_INT(HCI_DIAGNOSIS_UNKNOWN, diagnosis.verdict);
    hci_diagnosis_words(&diagnosis, words, sizeof words);
    TEST_ASSERT_NOT_NULL(strstr(words, "does not show in these torques"));
    TEST_ASSERT_NOT_NULL(strstr(words, "differ from speed x back_emf.csv by 4.9 %"));
}

/* Free shafts whose inertia is a fifth larger than declared ask for a weaker back-EMF, which the voltages
 * exclude. Without these it is the back-EMF. */
static void test_voltages_exclude_a_weaker_back_emf(void)
{
    for (int open = 0; open < 2; ++open) {
        for (int k = 0; k < 4; ++k) {
            record(450, &(point){k < 2 ? 60.0 : -150.0, k % 2 ? 9.0 : -4.0, 0.0, 0.0, 0.0});
            run[runs.count - 1].torque_source = HCI_TORQUE_INERTIA;
            for (size_t j = 0; j < 450; ++j)
                run[runs.count - 1].torque_Nm[j] *= 0.8;
        }
        if (open) record_open(1.0, 0.0, 0.1);
        hci_diagnosis_release(&diagnosis);
        find();
        TEST_ASSERT_EQUAL(open, diagnosis.against_voltages);
        TEST_ASSERT_EQUAL(open == 0, found("back_emf")->verdict != HCI_FINDING_REJECTED);
    }
    TEST_ASSERT_EQUAL_INT(HCI_DIAGNOSIS_UNKNOWN, diagnosis.verdict);
}

/* A load with 5 A against the magnets, read so much off, at which a saliency adds a tenth to the torque. */
static void record_salient(const point *x, double off_A)
{
    record(450, x);
    hci_run *r = &run[runs.count - 1];
    for (size_t k = 0; k < 450; ++k) {
        rec_phases(off_A - 5.0, x->iq, P * r->theta_m_rad[k], r->i_A + 3 * k);
        r->torque_Nm[k] += 0.1 * 1.5 * K_NM_PER_A * x->iq;
    }
}

/* At one current along d a saliency is no different from stronger magnets, and for 0.02 A it is even less
 * like itself. With the torque per ampere that the voltages show it is found all the same. */
static void test_what_voltages_leave_is_looked_for(void)
{
    record_salient(&(point){60.0, 9.0, 0.0, 0.0, 0.0}, -0.022);
    record_salient(&(point){-150.0, -4.0, 0.0, 0.0, 0.0}, 0.022);
    record_open(1.0, 0.0, 0.1);
    find();
    TEST_ASSERT_FALSE(diagnosis.against_voltages);
    TEST_ASSERT_LESS_OR_EQUAL_INT(HCI_DIAGNOSIS_AMBIGUOUS, diagnosis.verdict);
    TEST_ASSERT_EQUAL(HCI_FINDING_REJECTED, found("back_emf")->verdict); /* nor may it be that */
    TEST_ASSERT_NOT_EQUAL(HCI_FINDING_REJECTED, found("reluctance")->verdict);
    TEST_ASSERT_EQUAL_UINT64(1, diagnosis.effects.list.count);
    TEST_ASSERT_DOUBLE_WITHIN(1e-5, 0.1 * K_NM_PER_A / P / 5.0, -term("reluctance", "dd_cosine", 0.0)->value);
    TEST_ASSERT_DOUBLE_WITHIN(0.05 * NOISE_NM, NOISE_NM, diagnosis.rms_after_Nm);
    hci_diagnosis_release(&diagnosis);
    runs.count = 2; /* without them it is the magnets */
    find();
    TEST_ASSERT_EQUAL_STRING("back_emf", diagnosis.effects.list.effect[0].type->name);
}

/* What the others show of one that stands out may be what the voltages exclude. */
static void test_what_voltages_leave_where_a_run_is_suspected(void)
{
    for (int k = 0; k < 4; ++k)
        record_salient(&(point){k % 2 ? -150.0 : 60.0, k < 2 ? 9.0 : -4.0, 0.0, 0.0, 0.0},
                       k < 2 ? -0.02 : 0.02);
    record_open(1.0, 0.0, 0.1);
    find();
    TEST_ASSERT_FALSE(diagnosis.against_voltages);
    TEST_ASSERT_LESS_OR_EQUAL_INT(HCI_DIAGNOSIS_AMBIGUOUS, diagnosis.verdict);
    TEST_ASSERT_EQUAL_UINT64(1, diagnosis.effects.list.count);
    TEST_ASSERT_EQUAL_STRING("reluctance", diagnosis.effects.list.effect[0].type->name);
}

/* A torque sensor that reads 3 % too much makes magnets of it, which the voltages do not show: that is said.
 */
static void test_a_gain_that_voltages_do_not_show(void)
{
    char words[2048];
    for (int with = 0; with < 2; ++with) {
        for (int k = 0; k < 4; ++k) {
            record(450, &(point){k < 2 ? 60.0 : -150.0, k % 2 ? 9.0 : -4.0, 0.0, 0.0, 0.0});
            for (size_t j = 0; j < 450; ++j)
                run[runs.count - 1].torque_Nm[j] *= 1.03;
        }
        if (with) record_open(1.0, 0.0, 0.1);
        hci_diagnosis_release(&diagnosis);
        find();
        hci_diagnosis_words(&diagnosis, words, sizeof words);
        TEST_ASSERT_DOUBLE_WITHIN(0.004, with ? 0.03 : 0.0, diagnosis.beyond_voltages);
        TEST_ASSERT_EQUAL(with == 1, strstr(words, "% above what the voltages") != NULL);
    }
}

/* Voltages of millivolts, of a watch motor, say the same. */
static void test_small_voltages(void)
{
    double error, small_error;
    record_open(1.03, 0.02, 0.0);
    const double off = hci_open_voltage_off(&machine.model, &runs);
    const double scale = hci_open_voltage_scale_fitted(&machine.model, &runs, &error);
    for (size_t k = 0; k < 3 * N; ++k)
        voltage[0][k] *= 0x1p-12;
    for (size_t k = 0; k < machine.model.back_emf_count; ++k) {
        machine.back_emf[k].sine *= 0x1p-12;
        machine.back_emf[k].cosine *= 0x1p-12;
    }
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, off, hci_open_voltage_off(&machine.model, &runs));
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, scale, hci_open_voltage_scale(&machine.model, &runs));
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, scale,
                              hci_open_voltage_scale_fitted(&machine.model, &runs, &small_error));
    TEST_ASSERT_DOUBLE_WITHIN(1e-9 * error, error, small_error);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_difference);
    RUN_TEST(test_none);
    RUN_TEST(test_scale);
    RUN_TEST(test_error_of_the_scale);
    RUN_TEST(test_a_scale_that_is_not_well_known);
    RUN_TEST(test_nothing_in_the_torque);
    RUN_TEST(test_voltages_exclude_a_weaker_back_emf);
    RUN_TEST(test_what_voltages_leave_is_looked_for);
    RUN_TEST(test_what_voltages_leave_where_a_run_is_suspected);
    RUN_TEST(test_a_gain_that_voltages_do_not_show);
    RUN_TEST(test_small_voltages);
    return UNITY_END();
}
