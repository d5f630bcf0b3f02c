/* The errors of recordings from samples that are written down here: a mean over turns, a short recording
 * sample by sample, one without samples, and one that is held out. The model is a constant of the torque
 * sensor. */
#include "host/diagnose/run_errors.h"

#include <math.h>
#include <string.h>

#include "host/base/memory.h"
#include "support/effect_list.h"

enum { P = 2, RUNS = 4, TURN = 64, SHORT = 120, HELD = 40, COUNT = TURN + SHORT + HELD };

static const double OFFSET_NM = 0.3;

static const hci_machine MACHINE = {.pole_pairs = P};
static const hci_effects NONE = {NULL, 0};

static char name[RUNS][8] = {"a.csv", "b.csv", "c.csv", "d.csv"};
static el_list effects;
static hci_binned_sample sample[COUNT];
static hci_segment segment[3];
static hci_run_statistics statistics[RUNS];
static hci_noise noise[3];
static hci_run run[RUNS];
static hci_role role[RUNS] = {HCI_ROLE_FIT, HCI_ROLE_FIT, HCI_ROLE_FIT, HCI_ROLE_HOLDOUT};
static const hci_runs runs = {.run = run, .role = role, .count = RUNS};
static bool fit[RUNS], any[RUNS];
static double offset_rad[RUNS] = {0.0, 0.01, 0.0, -0.02};
static hci_dataset dataset;
static hci_diagnosis d;

/* Segments of runs a, b and d; b turns three times. */
void setUp(void)
{
    static const size_t RUN[3] = {0, 1, 3}, FIRST[3] = {0, TURN, TURN + SHORT},
                        SAMPLES[3] = {TURN, SHORT, HELD};
    uint64_t seed = 8;
    memset(&effects, 0, sizeof effects);
    memset(sample, 0, sizeof sample);
    memset(statistics, 0, sizeof statistics);
    memset(run, 0, sizeof run);
    for (size_t r = 0; r < RUNS; ++r) {
        run[r].name = name[r];
        run[r].torque_source = HCI_TORQUE_MEASURED;
        run[r].turn_known = true;
        statistics[r].mean_torque_Nm = 0.1 * (double)(r + 1);
        fit[r] = r < 3;
        any[r] = true;
    }
    statistics[1].turns = 3.0;
    statistics[3].turns = 2.9;
    for (int n = 0; n < 3; ++n) {
        segment[n] =
            (hci_segment){.run = RUN[n], .first = FIRST[n], .count = SAMPLES[n], .turns = n == 0 ? 50 : 0};
        for (size_t k = 0; k < SAMPLES[n]; ++k) {
            hci_binned_sample *x = &sample[FIRST[n] + k];
            x->count = 1.0;
            x->reading.theta_m_rad = 2.0 * REF_PI * ((double)k + 0.5) / (n == 0 ? TURN : 40.0);
            x->torque_Nm = OFFSET_NM + 0.02 * ref_normal(&seed) + 0.05 * sin(x->reading.theta_m_rad);
            x->raw = x->reading;
        }
    }
    for (size_t k = 0; k < TURN; ++k) { /* a line along the angle */
        sample[k].count = (double)(20 + k % 3);
        sample[k].torque_Nm = 0.4 + 0.07 * sample[k].raw.theta_m_rad;
        sample[k].scatter_N2m2 = 0.003 * (double)(1 + k % 4);
        sample[k].spread_rad2 = 0.001 * (double)(1 + k % 5);
    }
    el_add(&effects, "torque_sensor", "offset", 0.0, OFFSET_NM);
    dataset = (hci_dataset){.samples = {sample, COUNT, segment, 3, statistics, RUNS},
                            .fit = fit,
                            .any = any,
                            .index_offset_rad = offset_rad};
    dataset.regression = (hci_regression){.machine = &MACHINE,
                                          .declared = &NONE,
                                          .samples = &dataset.samples,
                                          .runs = run,
                                          .use = fit,
                                          .noise = noise};
}

void tearDown(void)
{
    hci_memory_free(d.run);
    memset(&d, 0, sizeof d);
}

static void find(void)
{
    hci_note note = {{0}};
    TEST_ASSERT_EQUAL_INT(HCI_OK, hci_run_errors_of(&dataset, &runs, &effects.list, &d, &note));
}

/* ---- what is taken over as it is ---- */

static void test_runs_with_samples(void)
{
    static const size_t RUN[3] = {0, 1, 3};
    run[1].torque_source = HCI_TORQUE_INERTIA;
    find();
    TEST_ASSERT_EQUAL_UINT64(3, d.runs);
    for (size_t k = 0; k < 3; ++k) {
        TEST_ASSERT_EQUAL_STRING(name[RUN[k]], d.run[k].file);
        TEST_ASSERT_EQUAL_INT(role[RUN[k]], d.run[k].role);
        TEST_ASSERT_EQUAL_INT(run[RUN[k]].torque_source, d.run[k].source);
        TEST_ASSERT_EQUAL_DOUBLE(0.1 * (double)(RUN[k] + 1), d.run[k].mean_torque_Nm);
        TEST_ASSERT_EQUAL_DOUBLE(offset_rad[RUN[k]], d.run[k].slip_rad);
    }
    TEST_ASSERT_TRUE(dataset.regression.use == fit);
    TEST_ASSERT_FALSE(dataset.regression.raw);
}

/* ---- a mean over turns ---- */

/* Mean squares over samples: of the mean and what the line does along the angles in it, and their scatter. */
static void test_errors_of_a_mean_over_turns(void)
{
    find();
    for (int after = 0; after < 2; ++after) {
        double count = 0.0, sum = 0.0, square = 0.0;
        for (size_t k = 0; k < TURN; ++k) {
            const double error = sample[k].torque_Nm - (after ? OFFSET_NM : 0.0);
            count += sample[k].count;
            sum += sample[k].count * error;
            square += sample[k].count * (error * error + 0.07 * 0.07 * sample[k].spread_rad2) +
                      sample[k].scatter_N2m2;
        }
        const double mean = sum / count, rms = sqrt(square / count), ripple = sqrt(rms * rms - mean * mean);
        TEST_ASSERT_DOUBLE_WITHIN(1e-9, rms, after ? d.run[0].rms_after_Nm : d.run[0].rms_before_Nm);
        TEST_ASSERT_DOUBLE_WITHIN(1e-9, mean,
                                  after ? d.run[0].error_mean_after_Nm : d.run[0].error_mean_before_Nm);
        TEST_ASSERT_DOUBLE_WITHIN(1e-9, ripple, after ? d.run[0].ripple_after_Nm : d.run[0].ripple_before_Nm);
        if (!after) continue;
        const double spread = 1.96 / sqrt(2.0 * count);
        TEST_ASSERT_DOUBLE_WITHIN(1e-9, rms * (1.0 - spread), d.run[0].after_low_Nm);
        TEST_ASSERT_DOUBLE_WITHIN(1e-9, rms * (1.0 + spread), d.run[0].after_high_Nm);
    }
}

/* Its noise is that scatter, by as many as there are less the means, where those are more than fifty. */
static void test_noise_of_a_mean_over_turns(void)
{
    double scatter = 0.0, freedom = 0.0;
    for (size_t k = 0; k < TURN; ++k) {
        scatter += sample[k].scatter_N2m2;
        freedom += sample[k].count - 1.0;
    }
    find();
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, sqrt(scatter / freedom), d.run[0].noise_floor_Nm);
    for (int few = 0; few < 2; ++few) {
        for (size_t k = 0; k < TURN; ++k)
            sample[k].count = k < (few ? 50u : 51u) ? 2.0 : 1.0;
        hci_memory_free(d.run);
        find();
        TEST_ASSERT_EQUAL(few, isnan(d.run[0].unrepeated_Nm));
    }
}

/* ---- sample by sample ---- */

/* White noise of the residual that all short ones share, with one parameter less, or that of neighbours where
 * it is less. */
static double noise_of_neighbours(size_t first, size_t count)
{
    double sum = 0.0;
    for (size_t k = first + 1; k + 1 < first + count; ++k) {
        const double off = sample[k].torque_Nm - 0.5 * (sample[k - 1].torque_Nm + sample[k + 1].torque_Nm);
        sum += off * off;
    }
    return sqrt(sum / (1.5 * (double)(count - 2)));
}

/* Of turns that do not repeat: departures from the means of ranges of the turn, 120/8 + 1 of them. */
static void test_noise_from_turn_to_turn(void)
{
    enum { RANGES = SHORT / 8 + 1 };
    double sum[RANGES] = {0.0}, square[RANGES] = {0.0}, count[RANGES] = {0.0}, total = 0.0, freedom = 0.0;
    for (size_t k = TURN; k < TURN + SHORT; ++k) {
        const double turns = sample[k].raw.theta_m_rad / (2.0 * REF_PI), x = sample[k].torque_Nm - OFFSET_NM;
        const size_t at = (size_t)((turns - floor(turns)) * RANGES);
        sum[at] += x;
        square[at] += x * x;
        count[at] += 1.0;
    }
    for (int k = 0; k < RANGES; ++k) {
        total += square[k] - sum[k] * sum[k] / count[k];
        freedom += count[k] - 1.0;
    }
    const double repeat = sqrt(total / freedom), own = noise_of_neighbours(TURN, SHORT);
    find();
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, repeat, d.run[1].noise_floor_Nm);
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, sqrt(fmax(0.0, repeat * repeat - own * own)), d.run[1].unrepeated_Nm);
}

/* Of less than three turns that of neighbours, and nothing is said of turns. */
static void test_noise_of_few_turns(void)
{
    find();
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, noise_of_neighbours(TURN + SHORT, HELD), d.run[2].noise_floor_Nm);
    TEST_ASSERT_TRUE(isnan(d.run[2].unrepeated_Nm));
}

/* Where the turn is not known, electrical ones count, of which there are more. */
static void test_noise_of_electrical_turns(void)
{
    run[1].turn_known = false;
    statistics[1].turns = 1.49;
    find();
    TEST_ASSERT_TRUE(isnan(d.run[1].unrepeated_Nm));
    hci_memory_free(d.run);
    statistics[1].turns = 1.51;
    find();
    TEST_ASSERT_FALSE(isnan(d.run[1].unrepeated_Nm));
}

/* ---- totals ---- */

/* Root mean squares over the runs of one kind. */
static void test_totals(void)
{
    hci_run_errors errors[4];
    hci_diagnosis x = {.run = errors, .runs = 4};
    for (int k = 0; k < 4; ++k) {
        const double size = 1.0 + k;
        errors[k] = (hci_run_errors){.role = k % 2 ? HCI_ROLE_HOLDOUT : HCI_ROLE_FIT,
                                     .rms_before_Nm = 1.0 * size,
                                     .rms_after_Nm = 2.0 * size,
                                     .noise_floor_Nm = 3.0 * size,
                                     .error_mean_before_Nm = -4.0 * size,
                                     .error_mean_after_Nm = 5.0 * size,
                                     .ripple_before_Nm = 6.0 * size,
                                     .ripple_after_Nm = 7.0 * size};
    }
    hci_run_errors_total(&x);
    const double fitted = sqrt(0.5 * (1.0 + 9.0)), held = sqrt(0.5 * (4.0 + 16.0));
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, fitted, x.rms_before_Nm);
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, 2.0 * fitted, x.rms_after_Nm);
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, 3.0 * fitted, x.noise_Nm);
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, held, x.holdout_before_Nm);
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, 2.0 * held, x.holdout_after_Nm);
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, 3.0 * held, x.holdout_noise_Nm);
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, 4.0 * held, x.holdout_mean_before_Nm);
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, 5.0 * held, x.holdout_mean_after_Nm);
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, 6.0 * held, x.holdout_ripple_before_Nm);
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, 7.0 * held, x.holdout_ripple_after_Nm);
    x.runs = 1;
    hci_run_errors_total(&x);
    TEST_ASSERT_TRUE(isnan(x.holdout_before_Nm) && isnan(x.holdout_ripple_after_Nm));
    TEST_ASSERT_EQUAL_DOUBLE(1.0, x.rms_before_Nm);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_runs_with_samples);
    RUN_TEST(test_errors_of_a_mean_over_turns);
    RUN_TEST(test_noise_of_a_mean_over_turns);
    RUN_TEST(test_noise_from_turn_to_turn);
    RUN_TEST(test_noise_of_few_turns);
    RUN_TEST(test_noise_of_electrical_turns);
    RUN_TEST(test_totals);
    return UNITY_END();
}
