/* Widths and powers that are tried on recordings left out in turn: which ones, how well each describes them
 * and what it weighs, beside ridges whose precisions are made here. */
#include "host/diagnose/uncertainty/width_trials.h"

#include <math.h>
#include <string.h>

#include "host/base/memory.h"
#include "support/draws.h"
#include "unity.h"

/* Unknowns: one of the mean torque, one of a square and one of a higher power of the currents. */
enum { N = 3, GROUPS = 7, ROWS = 9 };

static double unit[N] = {1.0, 1.5, 0.7}, fixed[N] = {NAN, NAN, NAN}, centre[N] = {0.1, 0.0, -0.2},
              twin[N] = {0.0, 0.8, 0.9}, known[N] = {0.0, 0.0, 0.0}, iron[N] = {0.0, 0.0, 0.0};
static bool of_mean[N] = {true, false, false};
static int power[N] = {1, 2, 3};
static const hci_allowed_terms TERMS = {.count = N,
                                        .unit = unit,
                                        .fixed = fixed,
                                        .centre = centre,
                                        .twin = twin,
                                        .iron = iron,
                                        .known = known,
                                        .of_mean = of_mean,
                                        .power = power};

static hci_condensed runs;
static hci_width_trials trials;
static hci_left_out_group left[GROUPS];
static double precision[N];
static hci_note note;

/* y = X β and noise of 1; the errors of a group that no β describes are `apart`. */
static void draw(uint64_t seed, double size, double apart)
{
    TEST_ASSERT_TRUE(hci_condensed_start(&runs, N, GROUPS));
    for (size_t g = 0; g < GROUPS; ++g) {
        hci_normal_equations normal = {0};
        TEST_ASSERT_TRUE(hci_normal_equations_start(&normal, N));
        const double off = apart * ref_normal(&seed);
        for (size_t k = 0; k < ROWS; ++k) {
            double x[N], y = ref_normal(&seed);
            for (size_t c = 0; c < N; ++c) {
                x[c] = ref_uniform(&seed, -1.0, 1.0) + 0.3 * (double)g;
                y += x[c] * (size * (1.0 - 0.4 * (double)c) + off);
            }
            hci_normal_equations_add(&normal, x, &y, 1);
        }
        hci_normal_equations_finish(&normal);
        TEST_ASSERT_TRUE(hci_condensed_add(&runs, &normal, unit));
        hci_normal_equations_release(&normal);
    }
}

void setUp(void)
{
    memset(&trials, 0, sizeof trials);
    memset(&runs, 0, sizeof runs);
}

void tearDown(void)
{
    hci_memory_fail_after(-1);
    hci_width_trials_release(&trials);
    hci_condensed_release(&runs);
}

/* ---- by hand ---- */

static void precision_set(double orders, double times, double twins, double beyond)
{
    const double deviation[N] = {orders * times * 1.0, fmax(orders * 1.5, twins * 0.8),
                                 fmax(orders * 0.7, twins * beyond * 0.9)};
    for (size_t k = 0; k < N; ++k)
        precision[k] = 1.0 / (deviation[k] * deviation[k]);
}

static hci_ridge ridge_made(void)
{
    const hci_expectation expected = {precision, centre};
    hci_ridge ridge;
    TEST_ASSERT_TRUE(hci_ridge_make(&runs, &expected, &ridge));
    return ridge;
}

static void leave_out(double *const *share)
{
    hci_ridge ridge = ridge_made();
    TEST_ASSERT_TRUE(hci_ridge_leave_out(&ridge, &runs, share, left));
    hci_ridge_release(&ridge);
}

/* One over the rms of the errors in the groups that tell one. */
static double twins_of(const hci_width_trial *x)
{
    double sum = 0.0;
    for (size_t g = 0; g < GROUPS; ++g)
        sum += x->left[g].misfit;
    return sqrt(GROUPS / sum);
}

/* ---- widths ---- */

static const double WIDTHS[] = {300.0, 100.0, 30.0, 10.0, 3.0,  1.0,  0.3, 0.1,
                                0.03,  0.01,  3e-3, 1e-3, 3e-4, 1e-4, 3e-5};

enum { WIDTH_COUNT = sizeof WIDTHS / sizeof *WIDTHS };

static void make(uint64_t seed, double size, double apart)
{
    draw(seed, size, apart);
    TEST_ASSERT_EQUAL_INT(HCI_OK, hci_width_trials_make(&TERMS, &runs, &trials, &note));
}

/* The widest first, until two in a row describe the runs worse by more than 15 than the best so far. */
static size_t widths_tried(void)
{
    double least = INFINITY;
    int worse = 0;
    size_t k = 0;
    for (; k < WIDTH_COUNT && worse < 2; ++k) {
        TEST_ASSERT_EQUAL_DOUBLE(WIDTHS[k], trials.trial[k].width.orders);
        TEST_ASSERT_EQUAL_DOUBLE(1.0, trials.trial[k].width.mean_times);
        least = fmin(least, trials.trial[k].misfit);
        worse = trials.trial[k].misfit > least + 15.0 ? worse + 1 : 0;
    }
    return k;
}

/* Then the best of them and its neighbours with a mean that is 4 and 16 times as wide. */
static void check_which(void)
{
    size_t k = widths_tried(), best = 0, at = k;
    for (size_t j = 1; j < k; ++j)
        if (trials.trial[j].misfit < trials.trial[best].misfit) best = j;
    for (size_t j = best > 0 ? best - 1 : 0; j <= best + 1 && j < k; ++j)
        for (int times = 4; times <= 16; times *= 4, ++at) {
            TEST_ASSERT_EQUAL_DOUBLE(WIDTHS[j], trials.trial[at].width.orders);
            TEST_ASSERT_EQUAL_DOUBLE(times, trials.trial[at].width.mean_times);
        }
    TEST_ASSERT_EQUAL_UINT64(at, trials.count);
}

/* Each group has a noise of its own: Σ rows ln(square), the squares without what a group alone tells at the
 * narrowest width. */
static void check_misfits(void)
{
    precision_set(3e-5, 1.0, 0.0, 1.0);
    double *share[GROUPS], sum = 0.0;
    hci_ridge narrow = ridge_made();
    TEST_ASSERT_TRUE(hci_ridge_shares(&narrow, &runs, share));
    hci_ridge_release(&narrow);
    for (size_t k = 0; k < trials.count; ++k) {
        const hci_width_trial *x = &trials.trial[k];
        double misfit = 0.0;
        precision_set(x->width.orders, x->width.mean_times, 0.0, 1.0);
        leave_out(share);
        for (size_t g = 0; g < GROUPS; ++g) {
            TEST_ASSERT_DOUBLE_WITHIN(1e-9 * left[g].square, left[g].square, x->left[g].square);
            misfit += ROWS * log(left[g].square);
        }
        TEST_ASSERT_DOUBLE_WITHIN(1e-9 * fabs(misfit), misfit, x->misfit);
        TEST_ASSERT_TRUE(x->misfit >= trials.trial[trials.best].misfit);
        sum += exp(-0.5 * (x->misfit - trials.trial[trials.best].misfit));
    }
    for (size_t k = 0; k < trials.count; ++k)
        TEST_ASSERT_DOUBLE_WITHIN(
            1e-12, exp(-0.5 * (trials.trial[k].misfit - trials.trial[trials.best].misfit)) / sum,
            trials.trial[k].weight);
    for (size_t g = 0; g < GROUPS; ++g)
        hci_memory_free(share[g]);
}

static void test_widths_of_large_unknowns(void)
{
    make(3, 20.0, 0.0);
    check_which();
    check_misfits();
    TEST_ASSERT_TRUE(trials.count < WIDTH_COUNT);
}

static void test_widths_of_small_unknowns(void)
{
    make(4, 0.01, 0.0);
    check_which();
    check_misfits();
    TEST_ASSERT_TRUE(widths_tried() == WIDTH_COUNT);
}

static void test_widths_of_groups_that_differ(void)
{
    make(5, 1.0, 0.5);
    check_which();
    check_misfits();
}

/* ---- powers ---- */

/* −2 ln of the density of what was left out, with expectations in units of the errors' size. */
static void test_powers(void)
{
    static const double BEYOND[] = {1.0, 0.3, 0.1, 0.03};
    make(5, 1.0, 0.5);
    const hci_width_trial *best = &trials.trial[trials.best];
    const double twins = twins_of(best);
    double misfit[4], least = INFINITY, sum = 0.0;
    TEST_ASSERT_EQUAL_UINT64(4, trials.powers.count);
    for (int k = 0; k < 4; ++k) {
        misfit[k] = 0.0;
        precision_set(best->width.orders, best->width.mean_times, twins, BEYOND[k]);
        leave_out(NULL);
        for (size_t g = 0; g < GROUPS; ++g)
            misfit[k] += left[g].spread + left[g].surprise * twins * twins;
        TEST_ASSERT_EQUAL_DOUBLE(BEYOND[k], trials.powers.trial[k].beyond);
        TEST_ASSERT_DOUBLE_WITHIN(1e-9 * fabs(misfit[k]), misfit[k], trials.powers.trial[k].misfit);
        least = fmin(least, misfit[k]);
    }
    for (int k = 0; k < 4; ++k)
        sum += exp(-0.5 * (misfit[k] - least));
    for (int k = 0; k < 4; ++k)
        TEST_ASSERT_DOUBLE_WITHIN(1e-9, exp(-0.5 * (misfit[k] - least)) / sum, trials.powers.trial[k].weight);
}

/* Without errors of a known size there are none to be tried. */
static void test_no_powers_without_twins(void)
{
    hci_power_trials powers;
    draw(6, 1.0, 0.0);
    const hci_power_trials_of of = {&TERMS, &runs, {1.0, 1.0, 0.0, 1.0}, precision};
    TEST_ASSERT_EQUAL_INT(HCI_OK, hci_power_trials_make(&of, &powers, &note));
    TEST_ASSERT_EQUAL_UINT64(1, powers.count);
    TEST_ASSERT_EQUAL_DOUBLE(1.0, powers.trial[0].beyond);
    TEST_ASSERT_EQUAL_DOUBLE(1.0, powers.trial[0].weight);
}

/* ---- what they say ---- */

static void test_ridges_of_places(void)
{
    make(5, 1.0, 0.5);
    for (size_t width = 0; width < trials.count; width += 2)
        for (size_t at = 0; at < 4; at += 3) {
            const hci_width_trial *x = &trials.trial[width];
            hci_ridge ridge;
            precision_set(x->width.orders, x->width.mean_times, twins_of(x), trials.powers.trial[at].beyond);
            hci_ridge expected = ridge_made();
            TEST_ASSERT_TRUE(
                hci_width_trials_ridge(&trials, (hci_width_place){width, at}, &TERMS, &runs, &ridge));
            for (size_t k = 0; k < N; ++k)
                TEST_ASSERT_DOUBLE_WITHIN(1e-9 * (1e-3 + fabs(expected.mean[k])), expected.mean[k],
                                          ridge.mean[k]);
            hci_ridge_release(&ridge);
            hci_ridge_release(&expected);
        }
}

/* Whatever allocation fails, all is released and the note says so. */
static void test_every_failing_allocation(void)
{
    hci_status status = HCI_ERROR_MEMORY;
    draw(5, 1.0, 0.5);
    for (long k = 0; status && k < 2000; ++k) {
        note.text[0] = '\0';
        hci_memory_fail_after(k);
        status = hci_width_trials_make(&TERMS, &runs, &trials, &note);
        hci_memory_fail_after(-1);
        TEST_ASSERT_TRUE(status == HCI_OK || (status == HCI_ERROR_MEMORY && note.text[0] != '\0'));
        hci_width_trials_release(&trials);
    }
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_widths_of_large_unknowns);
    RUN_TEST(test_widths_of_small_unknowns);
    RUN_TEST(test_widths_of_groups_that_differ);
    RUN_TEST(test_powers);
    RUN_TEST(test_no_powers_without_twins);
    RUN_TEST(test_ridges_of_places);
    RUN_TEST(test_every_failing_allocation);
    return UNITY_END();
}
