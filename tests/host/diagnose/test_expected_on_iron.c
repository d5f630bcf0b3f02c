/* labels: slow */
/* Slow, since each figure takes several diagnoses.
 *
 * The bound on the ripple against a machine that is known (support/saturated_iron.h), whose iron is none of
 * the series that the bound comes from: at currents between those recorded, beyond them, and with more noise,
 * where diagnose finds single terms only. */
#include "host/machine/expected_ripple.h"
#include "support/expecting.h"
#include "support/saturated_iron.h"

enum { SEEDS = 2 };

void setUp(void)
{
    dataset_start();
}

void tearDown(void)
{
    iron_noise_Nm = QUIET_NM;
    dataset_end();
}

/* ---- one current ---- */

static const current BETWEEN[] = {{-3.0, 6.0, 0.0}, {-2.0, 7.0, 1.0}, {-4.0, 4.0, 0.5}, {2.0, 4.0, 0.0},
                                  {0.0, 4.5, 2.0},  {-5.0, 8.0, 0.5}, {0.0, 8.0, 0.0},  {1.0, -3.0, 0.5}};
static const current BEYOND[] = {{0.0, 12.0, 0.0}, {-8.0, 10.0, 0.0}, {6.0, 9.0, 0.5}, {-3.0, 12.0, 1.0}};

enum { MANY = sizeof BETWEEN / sizeof *BETWEEN, FEW = sizeof BEYOND / sizeof *BEYOND };

static double torque_of(double theta, double d, double q)
{
    return 1.5 * K_NM_PER_A * q + torque_of_iron(theta, d, q);
}

static double error_at(const current *i)
{
    return expected_error_Nm(i, torque_of);
}

/* ---- many currents ---- */

typedef struct {
    int currents, errors_within, ripples_within;
    double bounds_Nm, errors_Nm; /* roots of the sums of squares */
} tally;

static void tally_add(const current *i, size_t count, tally *t)
{
    for (size_t k = 0; k < count; ++k) {
        const double error_Nm = error_at(&i[k]);
        TEST_ASSERT_EQUAL_INT(HCI_RIPPLE_KNOWN, expected.state);
        ++t->currents;
        t->errors_within += error_Nm <= expected.error_peak_to_peak_Nm;
        t->ripples_within += peak_to_peak(real_Nm) <= expected.peak_to_peak_Nm;
        t->errors_Nm = hypot(t->errors_Nm, error_Nm);
        t->bounds_Nm = hypot(t->bounds_Nm, expected.error_peak_to_peak_Nm);
    }
}

static void tally_both(double noise_Nm, tally *between, tally *beyond)
{
    *between = *beyond = (tally){0, 0, 0, 0.0, 0.0};
    iron_noise_Nm = noise_Nm;
    for (uint64_t s = 1; s <= SEEDS; ++s) {
        dataset_end();
        dataset_start();
        seed = 100 * s;
        measure_map();
        TEST_ASSERT_EQUAL_INT(HCI_OK, diagnose(NULL));
        tally_add(BETWEEN, MANY, between);
        tally_add(BEYOND, FEW, beyond);
    }
}

/* Of so many, one in twenty out: how many are out by chance in no more than one case of twenty. */
static int out_by_chance(int count)
{
    double probability = pow(0.95, count), sum = probability;
    int out = 0;
    while (sum < 0.95) {
        probability *= (count - out) / (out + 1.0) * 0.05 / 0.95;
        sum += probability;
        ++out;
    }
    return out;
}

static void check_within(const tally *a, const tally *b)
{
    const int count = a->currents + b->currents, least = count - out_by_chance(count);
    TEST_ASSERT_TRUE(a->errors_within + b->errors_within >= least);
    TEST_ASSERT_TRUE(a->ripples_within + b->ripples_within >= least);
}

/* The law has the orders 0 and 6 alone, and the bound allows for all others: it is wider than it had to be.
 */
#define WIDE 7.0

static void check_noise(double noise_Nm)
{
    tally between, beyond;
    tally_both(noise_Nm, &between, &beyond);
    check_within(&between, &beyond);
    TEST_ASSERT_TRUE(between.bounds_Nm < WIDE * between.errors_Nm);
    TEST_ASSERT_TRUE(beyond.bounds_Nm / sqrt(FEW) > 3.0 * between.bounds_Nm / sqrt(MANY));
}

/* ---- tests ---- */

static void test_recordings_that_tell_all_terms(void)
{
    check_noise(QUIET_NM);
}

static void test_recordings_that_tell_single_terms(void)
{
    check_noise(20.0 * QUIET_NM);
}

/* Less than three recordings cannot be left out in turn. */
static void test_two_recordings_tell_nothing(void)
{
    measure(0.0, 3.0, 0.0, HCI_ROLE_FIT);
    measure(0.0, 6.0, 0.0, HCI_ROLE_FIT);
    TEST_ASSERT_TRUE(diagnose(NULL) <= HCI_NOT_REACHED);
    TEST_ASSERT_EQUAL_UINT(0, diagnosis.uncertainty.machines);
}

/* One recording in which the current rises from turn to turn: i_q of 2, 4, 6, 8 A, twice. */
static void measure_long(size_t turns)
{
    hci_run *r = add_run(turns * SAMPLES);
    for (size_t k = 0; k < r->count; ++k) {
        const double theta = 2.0 * REF_PI * (double)k / SAMPLES, q = 2.0 + 2.0 * (double)(k / SAMPLES % 4);
        r->theta_m_rad[k] = theta / P;
        r->time_s[k] = 1e-3 * (double)k;
        r->speed_rad_per_s[k] = 2.0 * REF_PI / P / SAMPLES / 1e-3;
        rec_phases(0.0, q, theta, r->i_A + 3 * k);
        r->torque_Nm[k] =
            1.5 * K_NM_PER_A * q + torque_of_iron(theta, 0.0, q) + iron_noise_Nm * ref_normal(&seed);
    }
}

static void test_a_long_recording_is_cut(void)
{
    const current within = {0.0, 5.0, 0.0}, far = {0.0, 14.0, 0.0};
    char words[1024];
    measure_long(8);
    TEST_ASSERT_TRUE(diagnose(NULL) <= HCI_NOT_REACHED);
    TEST_ASSERT_EQUAL_UINT(200, diagnosis.uncertainty.machines);
    TEST_ASSERT_EQUAL_UINT(1, diagnosis.uncertainty.runs);
    TEST_ASSERT_TRUE(error_at(&within) <= expected.error_peak_to_peak_Nm);
    TEST_ASSERT_EQUAL_INT(HCI_RIPPLE_KNOWN, expected.state);
    TEST_ASSERT_EQUAL_UINT(1, expected.recordings);
    hci_expected_ripple_words(&expected, words, sizeof words);
    TEST_ASSERT_NOT_NULL_MESSAGE(strstr(words, "told by parts of 1 recording:"), words);
    error_at(&far);
    TEST_ASSERT_EQUAL_INT(HCI_RIPPLE_TOO_FAR, expected.state);
    TEST_ASSERT_TRUE(isnan(expected.peak_to_peak_Nm));
}

/* Each recording twice, without much noise: a copy tells what noise is, not what the machine does elsewhere.
 * (Left out one by one they made the bound an eighth of that.) */
static void test_copies_promise_no_more(void)
{
    double once_Nm = 0.0;
    iron_noise_Nm = 0.01 * QUIET_NM;
    for (int copies = 1; copies <= 2; ++copies) {
        dataset_end();
        dataset_start();
        for (size_t k = 0; k < 5; ++k)
            for (int c = 0; c < copies; ++c)
                measure(0.0, 2.0 * (double)k, 0.0, HCI_ROLE_FIT);
        TEST_ASSERT_TRUE(diagnose(NULL) <= HCI_NOT_REACHED);
        TEST_ASSERT_EQUAL_UINT(5 * (size_t)copies, diagnosis.uncertainty.runs);
        error_at(&BEYOND[0]);
        if (copies == 1) once_Nm = expected.error_peak_to_peak_Nm;
    }
    TEST_ASSERT_TRUE(expected.error_peak_to_peak_Nm > 0.5 * once_Nm);
}

static void test_what_was_measured(void)
{
    measure_map();
    TEST_ASSERT_EQUAL_INT(HCI_OK, diagnose(NULL));
    const hci_measured_run all = hci_uncertainty_measured(&diagnosis.uncertainty);
    double square = 0.0;
    TEST_ASSERT_EQUAL_UINT(9, diagnosis.uncertainty.runs); /* the tenth is held out */
    TEST_ASSERT_DOUBLE_WITHIN(0.01, -7.0, all.id_A.least);
    TEST_ASSERT_DOUBLE_WITHIN(0.01, 5.0, all.id_A.most);
    TEST_ASSERT_DOUBLE_WITHIN(1e-6, -6.0, all.iq_A.least);
    TEST_ASSERT_DOUBLE_WITHIN(1e-6, 9.0, all.iq_A.most);
    for (size_t k = 0; k < 9; ++k)
        square += diagnosis.uncertainty.run[k].misfit * diagnosis.uncertainty.run[k].misfit / 9.0;
    TEST_ASSERT_DOUBLE_WITHIN(1e-9, 1.0, square);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_recordings_that_tell_all_terms);
    RUN_TEST(test_recordings_that_tell_single_terms);
    RUN_TEST(test_two_recordings_tell_nothing);
    RUN_TEST(test_a_long_recording_is_cut);
    RUN_TEST(test_copies_promise_no_more);
    RUN_TEST(test_what_was_measured);
    return UNITY_END();
}
