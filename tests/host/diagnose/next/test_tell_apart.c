/* Two explanations of a recording without current, and a turn to come: χ² and how many turns it takes, by a
 * fit of two terms that is solved here. */
#include "host/diagnose/next/tell_apart.h"

#include "host/diagnose/fit/linearise.h"
#include "support/searching.h"

enum { N = 377, OF_TURN = 96 * P };

static hci_candidates right;
static hci_playable playable;

void setUp(void)
{
    dataset_start();
}

void tearDown(void)
{
    hci_memory_fail_after(-1);
    hci_candidates_release(&right);
    search_end();
    dataset_end();
}

/* Right has a S sin + C cos of order 6 and a sine of order 12; wrong a sine of order 6 and one of order 12,
 * with values of their own. A part of a turn was recorded, which does not tell the two orders quite apart. */
typedef struct {
    double sine_6, cosine_6, sine_12;
} values;

static void add(hci_candidates *to, const char *parameter, double order, double value)
{
    hci_candidate x = candidate_of("cogging", parameter, NULL, order);
    x.term[0].value = value;
    TEST_ASSERT_EQUAL(HCI_OK, hci_candidates_add(to, &x, &note));
}

static void explain(values of_right, double wrong_6, double wrong_12, double noise_Nm)
{
    record(N, &(point){40.0, 0.0, 0.0, 0.0, 0.0});
    search_start();
    dataset.regression.noise[0] = hci_noise_white(0.02);
    add(&right, "sine", 6.0, of_right.sine_6);
    add(&right, "cosine", 6.0, of_right.cosine_6);
    add(&right, "sine", 12.0, of_right.sine_12);
    add(&model.candidates, "sine", 6.0, wrong_6);
    add(&model.candidates, "sine", 12.0, wrong_12);
    playable = (hci_playable){
        .source = HCI_TORQUE_MEASURED, .volts_s = K_NM_PER_A, .noise_Nm = noise_Nm, .temperature_C = NAN};
}

/* Over `turns` turns, with what the recording knows of both terms. */
static double chi_square_of(values d, double turns, double noise_Nm)
{
    hci_normal_equations known = {0};
    const double w = turns * 0.5 * OF_TURN / (noise_Nm * noise_Nm);
    TEST_ASSERT_EQUAL(HCI_OK,
                      hci_regression_normal(&dataset.regression, &model.candidates, false, &known, &note));
    TEST_ASSERT_EQUAL(2, known.n);
    const double a = known.gram[0] + w, b = known.gram[1], c = known.gram[3] + w;
    TEST_ASSERT_TRUE(fabs(b) > 1e-3 * known.gram[0]);
    const double m = w * d.sine_6, n = w * d.sine_12, det = a * c - b * b;
    hci_normal_equations_release(&known);
    return w * (d.sine_6 * d.sine_6 + d.cosine_6 * d.cosine_6 + d.sine_12 * d.sine_12) -
           (c * m * m - 2.0 * b * m * n + a * n * n) / det;
}

static void check_told(values of_right, double wrong_6, double wrong_12, double noise_Nm, double turns)
{
    const hci_operating_point at[2] = {{0.0, 0.0, 40.0}, {-1.0, 2.0, -15.0}};
    const values d = {of_right.sine_6 - wrong_6, of_right.cosine_6, of_right.sine_12 - wrong_12};
    double chi_square[2], found[2];
    explain(of_right, wrong_6, wrong_12, noise_Nm);
    const hci_explanations both = {&right, &model.candidates};
    const hci_point_scores scores = {at, 2, chi_square, found};
    TEST_ASSERT_EQUAL(HCI_OK, hci_tell_apart(&dataset.regression, &playable, &both, &scores, &note));
    const double expected = chi_square_of(d, turns, noise_Nm);
    for (int k = 0; k < 2; ++k) { /* cogging is the same at each */
        TEST_ASSERT_EQUAL_DOUBLE(turns, found[k]);
        TEST_ASSERT_DOUBLE_WITHIN(1e-6 * expected, expected, chi_square[k]);
    }
    TEST_ASSERT_TRUE(turns == HCI_MOST_TURNS || expected >= HCI_TELLS);
}

static void test_ten_turns(void)
{
    check_told((values){0.013, -0.004, 0.002}, 0.008, 0.009, 0.05, 10.0);
}

static void test_twenty_turns(void)
{
    check_told((values){0.013, -0.004, 0.002}, 0.008, 0.009, 0.09, 20.0);
}

static void test_fifty_turns(void)
{
    check_told((values){0.013, -0.004, 0.002}, 0.008, 0.009, 0.3, 50.0);
}

/* A term that neither the recording nor the turn shows, since both are without current, changes nothing. */
static void test_a_term_that_does_not_show(void)
{
    const hci_operating_point at = {0.0, 0.0, 40.0};
    double chi_square[2], turns[2];
    explain((values){0.013, -0.004, 0.002}, 0.008, 0.009, 0.05);
    const hci_explanations both = {&right, &model.candidates};
    for (int k = 0; k < 2; ++k) {
        const hci_point_scores scores = {&at, 1, &chi_square[k], &turns[k]};
        TEST_ASSERT_EQUAL(HCI_OK, hci_tell_apart(&dataset.regression, &playable, &both, &scores, &note));
        model_add("back_emf", "sine", NULL, 5.0);
    }
    TEST_ASSERT_TRUE(chi_square[0] > 0.0);
    TEST_ASSERT_DOUBLE_WITHIN(1e-9 * chi_square[0], chi_square[0], chi_square[1]);
}

/* What both predict alike tells nothing; and whatever fails, the note says so. */
static void test_nothing_to_tell(void)
{
    const hci_operating_point at = {0.0, 0.0, 40.0};
    double chi_square = 3.0, turns = 0.0;
    explain((values){0.01, 0.0, 0.004}, 0.01, 0.004, 0.01);
    const hci_explanations both = {&right, &model.candidates};
    const hci_point_scores scores = {&at, 1, &chi_square, &turns};
    TEST_ASSERT_EQUAL(HCI_OK, hci_tell_apart(&dataset.regression, &playable, &both, &scores, &note));
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, 0.0, chi_square);
    TEST_ASSERT_EQUAL_DOUBLE(50.0, turns);
    for (long k = 0; k < 60; ++k) {
        memset(&note, 0, sizeof note);
        hci_memory_fail_after(k);
        const hci_status status = hci_tell_apart(&dataset.regression, &playable, &both, &scores, &note);
        hci_memory_fail_after(-1);
        TEST_ASSERT_TRUE(status == HCI_OK || status == HCI_ERROR_MEMORY);
        TEST_ASSERT_EQUAL(status != HCI_OK, note.text[0] != '\0');
        if (status == HCI_OK) return;
    }
    TEST_FAIL_MESSAGE("it never succeeds");
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_ten_turns);
    RUN_TEST(test_twenty_turns);
    RUN_TEST(test_fifty_turns);
    RUN_TEST(test_a_term_that_does_not_show);
    RUN_TEST(test_nothing_to_tell);
    return UNITY_END();
}
