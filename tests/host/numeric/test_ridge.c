/* What rows and an expectation say of unknowns: against one unknown by hand, against the errors of
 * left_out.h, and against draws of unknowns and noise as they are expected. */
#include "host/numeric/ridge.h"

#include <math.h>
#include <string.h>

#include "host/base/memory.h"
#include "host/numeric/left_out.h"
#include "support/reference.h"
#include "unity.h"

enum { MOST_GROUPS = 12, MOST_ROWS = 20, MOST_COLUMNS = 8 };

static uint64_t seed;
static size_t groups, rows, columns;
static double x[MOST_GROUPS * MOST_ROWS * MOST_COLUMNS], y[MOST_GROUPS * MOST_ROWS], unit[MOST_COLUMNS];
static double precision[MOST_COLUMNS], centre[MOST_COLUMNS];
static hci_normal_equations group[MOST_GROUPS];
static hci_condensed condensed;
static hci_ridge ridge;
static hci_left_out_group left[MOST_GROUPS];

static void release(void)
{
    for (size_t g = 0; g < MOST_GROUPS; ++g)
        hci_normal_equations_release(&group[g]);
    hci_condensed_release(&condensed);
    hci_ridge_release(&ridge);
}

void setUp(void)
{
    seed = 5;
    for (size_t k = 0; k < MOST_COLUMNS; ++k) {
        unit[k] = 1.0;
        precision[k] = 0.5 + 0.25 * (double)k;
        centre[k] = 0.0;
    }
}

void tearDown(void)
{
    hci_memory_fail_after(-1);
    release();
}

static void size(size_t of_groups, size_t of_rows, size_t of_columns)
{
    groups = of_groups;
    rows = of_rows;
    columns = of_columns;
}

static void draw_rows(void)
{
    for (size_t k = 0; k < groups * rows * columns; ++k)
        x[k] = ref_uniform(&seed, -1.0, 1.0);
    for (size_t k = 0; k < groups * rows; ++k)
        y[k] = ref_uniform(&seed, -1.0, 1.0);
}

static void condense(void)
{
    TEST_ASSERT_TRUE(hci_condensed_start(&condensed, columns, groups));
    for (size_t g = 0; g < groups; ++g) {
        TEST_ASSERT_TRUE(hci_normal_equations_start(&group[g], columns));
        hci_normal_equations_add(&group[g], x + g * rows * columns, y + g * rows, rows);
        hci_normal_equations_finish(&group[g]);
        TEST_ASSERT_TRUE(hci_condensed_add(&condensed, &group[g], unit));
    }
}

static void solve(void)
{
    const hci_expectation expected = {precision, centre};
    condense();
    TEST_ASSERT_TRUE(hci_ridge_make(&condensed, &expected, &ridge));
    TEST_ASSERT_TRUE(hci_ridge_leave_out(&ridge, &condensed, NULL, left));
}

/* ---- condensed groups ---- */

static void check_products(const hci_condensed_group *c, const hci_normal_equations *of)
{
    for (size_t i = 0; i < columns; ++i) {
        double moment = 0.0;
        for (size_t r = 0; r < c->rank; ++r)
            moment += c->factor[i * c->rank + r] * c->moment[r];
        TEST_ASSERT_DOUBLE_WITHIN(1e-12, of->moment[i], moment);
        for (size_t j = 0; j < columns; ++j) {
            double gram = 0.0;
            for (size_t r = 0; r < c->rank; ++r)
                gram += c->factor[i * c->rank + r] * c->factor[j * c->rank + r];
            TEST_ASSERT_DOUBLE_WITHIN(1e-12, of->gram[i * columns + j], gram);
        }
    }
}

/* Three rows tell of three directions only, whatever the number of unknowns. */
static void test_a_group_is_as_small_as_its_rows(void)
{
    size(2, 3, 8);
    draw_rows();
    condense();
    for (size_t g = 0; g < groups; ++g) {
        TEST_ASSERT_EQUAL_UINT(3, condensed.group[g].rank);
        TEST_ASSERT_DOUBLE_WITHIN(1e-12, 0.0, condensed.group[g].rest);
        check_products(&condensed.group[g], &group[g]);
    }
}

static void test_what_no_unknown_describes_is_the_rest(void)
{
    size(1, 20, 4);
    draw_rows();
    condense();
    double least;
    const double nothing[MOST_COLUMNS] = {0.0};
    TEST_ASSERT_TRUE(hci_all_in_square(&(hci_groups){group, 1}, nothing, &least));
    TEST_ASSERT_EQUAL_UINT(4, condensed.group[0].rank);
    TEST_ASSERT_DOUBLE_WITHIN(1e-9, least, condensed.group[0].rest);
}

/* ---- mean, and groups left out ---- */

/* One row y_g = x in each of R groups and precision P: mean Σy/(R + P); without group g Σ'y/(R − 1 + P), by
 * which y_g is foreseen with the variance 1 + 1/(R − 1 + P). */
static void test_one_unknown(void)
{
    enum { R = 4 };
    static const double VALUE[R] = {1.0, 2.0, -0.5, 4.0};
    const double sum = 6.5, p = 2.0;
    size(R, 1, 1);
    precision[0] = p;
    for (size_t g = 0; g < R; ++g) {
        x[g] = 1.0;
        y[g] = VALUE[g];
    }
    solve();
    TEST_ASSERT_DOUBLE_WITHIN(1e-10, sum / (R + p), ridge.mean[0]);
    for (size_t g = 0; g < R; ++g) {
        const double error = VALUE[g] - (sum - VALUE[g]) / (R - 1.0 + p), k = 1.0 / (R + p);
        TEST_ASSERT_DOUBLE_WITHIN(1e-6, error * error, left[g].square);
        TEST_ASSERT_DOUBLE_WITHIN(1e-6, error * error * (1.0 - k), left[g].misfit);
        TEST_ASSERT_DOUBLE_WITHIN(1e-6, log(1.0 + 1.0 / (R - 1.0 + p)), left[g].spread);
        TEST_ASSERT_DOUBLE_WITHIN(1e-6, error * error / (1.0 + 1.0 / (R - 1.0 + p)), left[g].surprise);
    }
}

static void test_centre_is_expected(void)
{
    size(1, 1, 2);
    x[0] = 1.0;
    x[1] = 0.0;
    y[0] = 3.0;
    precision[0] = precision[1] = 1.0;
    centre[0] = 1.0;
    centre[1] = -7.0;
    solve();
    TEST_ASSERT_DOUBLE_WITHIN(1e-10, 2.0, ridge.mean[0]);
    TEST_ASSERT_DOUBLE_WITHIN(1e-10, -7.0, ridge.mean[1]);
}

/* Against solutions without each group, one by one. */
static void test_errors_left_out(void)
{
    double square[MOST_GROUPS];
    size(5, 7, 6);
    draw_rows();
    solve();
    TEST_ASSERT_TRUE(hci_left_out_squares(&(hci_groups){group, groups}, precision, square));
    for (size_t g = 0; g < groups; ++g)
        TEST_ASSERT_DOUBLE_WITHIN(1e-6 * square[g], square[g], left[g].square);
}

/* ---- as expected ---- */

static const double S = 0.3; /* size of noise and unknowns over what the weights say */

/* Unknowns and noise as they are expected, S times as large. truth[columns + 1]: out; its last unknown is not
 * in the rows. */
static void draw_world(double *truth)
{
    draw_rows();
    for (size_t c = 0; c < columns; ++c)
        truth[c] = S * ref_normal(&seed) / sqrt(precision[c]);
    for (size_t k = 0; k < groups * rows; ++k) {
        y[k] = S * ref_normal(&seed);
        for (size_t c = 0; c < columns; ++c)
            y[k] += x[k * columns + c] * truth[c];
    }
}

static double mean_misfit(void)
{
    double sum = 0.0;
    for (size_t g = 0; g < groups; ++g)
        sum += left[g].misfit / (double)groups;
    return sum;
}

/* The mean of s² over many worlds is S², whether rows tell much of the unknowns or next to nothing. */
static void test_groups_left_out_tell_the_size_of_errors(void)
{
    enum { WORLDS = 400 };
    for (size_t of_rows = 2; of_rows <= 8; of_rows += 6) {
        double truth[MOST_COLUMNS], sum = 0.0;
        for (int w = 0; w < WORLDS; ++w) {
            size(8, of_rows, 6);
            draw_world(truth);
            solve();
            sum += mean_misfit() / WORLDS;
            release();
        }
        TEST_ASSERT_DOUBLE_WITHIN(0.05 * S * S, S * S, sum);
    }
}

/* Draws scatter about the mean as A⁻¹ has it; of one unknown s²/(rows + precision). */
static void test_draws(void)
{
    enum { DRAWS = 20000 };
    hci_draws draws = {3};
    double sum = 0.0, square = 0.0, drawn;
    size(1, 4, 1);
    precision[0] = 5.0;
    for (size_t k = 0; k < rows; ++k)
        x[k] = y[k] = 1.0;
    solve();
    for (int k = 0; k < DRAWS; ++k) {
        hci_ridge_draw(&ridge, S, &draws, &drawn);
        sum += drawn / DRAWS;
        square += (drawn - 4.0 / 9.0) * (drawn - 4.0 / 9.0) / DRAWS;
    }
    TEST_ASSERT_DOUBLE_WITHIN(4.0 * S / 3.0 / sqrt(DRAWS), 4.0 / 9.0, sum);
    TEST_ASSERT_DOUBLE_WITHIN(0.04 * S * S / 9.0, S * S / 9.0, square);
}

/* One of which nothing is said is 0 in the mean and in each draw. */
static void test_an_unknown_that_nothing_is_said_of(void)
{
    hci_draws draws = {3};
    double drawn[2];
    size(1, 4, 2);
    precision[0] = 5.0;
    precision[1] = 0.0;
    for (size_t k = 0; k < rows; ++k) {
        x[2 * k] = y[k] = 1.0;
        x[2 * k + 1] = 0.0;
    }
    solve();
    TEST_ASSERT_DOUBLE_WITHIN(1e-10, 4.0 / 9.0, ridge.mean[0]);
    TEST_ASSERT_EQUAL_DOUBLE(0.0, ridge.mean[1]);
    for (int k = 0; k < 5; ++k) {
        hci_ridge_draw(&ridge, S, &draws, drawn);
        TEST_ASSERT_TRUE(drawn[0] != 0.0);
        TEST_ASSERT_EQUAL_DOUBLE(0.0, drawn[1]);
    }
}

/* How large errors are, when draws are made: known, or as the groups tell it. */
typedef struct {
    bool known;
    double size[MOST_GROUPS], freedom;
} errors;

static double size_of(const errors *e, int k, hci_draws *draws)
{
    if (e->known) return S;
    return e->size[(size_t)k % groups] * hci_draws_student_scale(draws, (unsigned)e->freedom);
}

/* How many of 199 draws of a value that was never measured are below it. */
static int draws_below(const double *truth, const errors *e, hci_draws *draws)
{
    enum { DRAWS = 199 };
    double drawn[MOST_COLUMNS], at[MOST_COLUMNS], value = 0.0;
    int below = 0;
    for (size_t c = 0; c < columns; ++c) {
        at[c] = ref_uniform(&seed, -2.0, 2.0);
        value += at[c] * truth[c];
    }
    for (int k = 0; k < DRAWS; ++k) {
        double of_draw = 0.0;
        hci_ridge_draw(&ridge, size_of(e, k, draws), draws, drawn);
        for (size_t c = 0; c < columns; ++c)
            of_draw += at[c] * drawn[c];
        below += of_draw < value;
    }
    return below;
}

/* Share of worlds in which it is below what one draw in twenty exceeds. */
static double coverage(size_t of_groups, bool known, int worlds)
{
    int within = 0;
    for (int w = 0; w < worlds; ++w) {
        double truth[MOST_COLUMNS];
        hci_draws draws = {(uint64_t)w};
        errors e = {.known = known};
        size(of_groups, 3, 6);
        draw_world(truth);
        solve();
        e.freedom = hci_group_sizes(left, groups, e.size);
        within += draws_below(truth, &e, &draws) < 190; /* 9 at the most are above the 190th */
        release();
    }
    return (double)within / worlds;
}

static void test_one_value_in_twenty_is_above_the_bound(void)
{
    enum { WORLDS = 2000 };
    TEST_ASSERT_DOUBLE_WITHIN(3.0 * sqrt(0.05 * 0.95 / WORLDS), 0.95, coverage(4, true, WORLDS));
}

/* Of a few groups, each of a few rows, it is not known whether they differ: rather too wide than too narrow.
 */
static void test_no_more_than_that_where_groups_tell_the_size(void)
{
    enum { WORLDS = 1000 };
    const double least = 0.95 - 3.0 * sqrt(0.05 * 0.95 / WORLDS);
    for (size_t of_groups = 3; of_groups <= 12; of_groups += 3) {
        const double share = coverage(of_groups, false, WORLDS);
        TEST_ASSERT_TRUE(share > least);
        TEST_ASSERT_TRUE(share < 0.99);
    }
}

/* ---- groups that tell the same ---- */

/* The third group repeats the first, but for y. */
static void test_copies_are_joined(void)
{
    hci_condensed joined = {0};
    size_t of[MOST_GROUPS];
    size(4, 5, 6);
    draw_rows();
    memcpy(x + 2 * rows * columns, x, rows * columns * sizeof *x);
    condense();
    TEST_ASSERT_TRUE(hci_condensed_join(&condensed, unit, 0.99, &joined, of));
    TEST_ASSERT_EQUAL_UINT(3, joined.count);
    TEST_ASSERT_EQUAL_UINT(of[0], of[2]);
    TEST_ASSERT_TRUE(of[0] != of[1] && of[1] != of[3] && of[0] != of[3]);
    for (size_t k = 0; k < columns * columns; ++k)
        TEST_ASSERT_DOUBLE_WITHIN(1e-12, condensed.gram[k], joined.gram[k]);
    for (size_t k = 0; k < columns; ++k)
        TEST_ASSERT_DOUBLE_WITHIN(1e-12, condensed.moment[k], joined.moment[k]);
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, 2.0 * (double)rows, joined.group[of[0]].rows);
    hci_condensed_release(&joined);
}

/* Cosine of two XᵀX, each unknown in units of what all groups tell of it, element by element. */
static double cosine_of(size_t a, size_t b)
{
    double ab = 0.0, aa = 0.0, bb = 0.0;
    for (size_t i = 0; i < columns; ++i)
        for (size_t j = 0; j < columns; ++j) {
            const double told = condensed.gram[i * columns + i] * condensed.gram[j * columns + j];
            const double p = group[a].gram[i * columns + j], q = group[b].gram[i * columns + j];
            ab += p * q / told, aa += p * p / told, bb += q * q / told;
        }
    return ab / sqrt(aa * bb);
}

/* Whatever is asked for, the first group that is as much alike is the one that a group is joined to. */
static void test_groups_are_joined_by_their_cosine(void)
{
    size_t pairs = 0;
    size(MOST_GROUPS, 6, 5);
    draw_rows();
    condense();
    for (double alike = 0.3; alike < 1.0; alike += 0.05) {
        hci_condensed joined = {0};
        size_t of[MOST_GROUPS];
        TEST_ASSERT_TRUE(hci_condensed_join(&condensed, unit, alike, &joined, of));
        for (size_t g = 0; g < groups; ++g) {
            size_t first = 0;
            while (first < g && cosine_of(first, g) < alike)
                ++first;
            TEST_ASSERT_EQUAL_UINT(of[first], of[g]);
            pairs += first < g;
        }
        hci_condensed_release(&joined);
    }
    TEST_ASSERT_TRUE(pairs > 40 && pairs < 120);
}

/* An unknown that only a run and its copy tell of: with both left out, it is as if nobody had measured it. */
static void test_a_copy_does_not_vouch_for_a_run(void)
{
    hci_condensed joined = {0};
    hci_ridge of_joined;
    hci_left_out_group alone[MOST_GROUPS];
    size_t of[MOST_GROUPS];
    const hci_expectation expected = {precision, centre};
    size(3, 1, 2);
    x[0] = x[2] = 1.0, x[1] = x[3] = 0.0;
    x[4] = 0.0, x[5] = 1.0;
    y[0] = y[1] = 5.0, y[2] = 1.0;
    precision[0] = precision[1] = 1e-3;
    solve();
    TEST_ASSERT_DOUBLE_WITHIN(0.01, 0.0, left[0].square); /* the copy says 5 as well */
    TEST_ASSERT_TRUE(hci_condensed_join(&condensed, unit, 0.99, &joined, of));
    TEST_ASSERT_TRUE(hci_ridge_make(&joined, &expected, &of_joined));
    TEST_ASSERT_TRUE(hci_ridge_leave_out(&of_joined, &joined, NULL, alone));
    TEST_ASSERT_DOUBLE_WITHIN(0.01, 2.0 * 5.0 * 5.0, alone[of[0]].square);
    hci_ridge_release(&of_joined);
    hci_condensed_release(&joined);
}

/* ---- sizes of groups ---- */

/* Means of so many squares. */
static void draw_sizes(size_t count, double directions, const double *true_size)
{
    for (size_t g = 0; g < count; ++g) {
        left[g] = (hci_left_out_group){0.0, 0.0, directions, true_size[g] * true_size[g], 0.0, 0.0};
        for (int k = 0; k < (int)directions; ++k)
            left[g].misfit += pow(true_size[g] * ref_normal(&seed), 2.0) / directions;
    }
}

/* What chance makes of a few squares is no difference of the groups. */
static void test_groups_that_are_alike(void)
{
    static const double SAME[MOST_GROUPS] = {1.0, 1.0, 1.0, 1.0, 1.0, 1.0, 1.0, 1.0, 1.0, 1.0, 1.0, 1.0};
    enum { WORLDS = 300 };
    double raw = 0.0, shrunk = 0.0, freedom = 0.0, s[MOST_GROUPS];
    for (int w = 0; w < WORLDS; ++w) {
        draw_sizes(MOST_GROUPS, 4.0, SAME);
        freedom += hci_group_sizes(left, MOST_GROUPS, s) / WORLDS;
        for (size_t g = 0; g < MOST_GROUPS; ++g) {
            raw += pow(left[g].misfit - 1.0, 2.0);
            shrunk += pow(s[g] * s[g] - 1.0, 2.0);
        }
    }
    TEST_ASSERT_TRUE(shrunk < 0.35 * raw);
    TEST_ASSERT_TRUE(freedom > 0.6 * 4.0 * MOST_GROUPS && freedom <= 4.0 * MOST_GROUPS);
}

static void test_groups_that_differ(void)
{
    static const double OTHER[MOST_GROUPS] = {0.2, 3.0, 0.2, 3.0, 0.2, 3.0, 0.2, 3.0, 0.2, 3.0, 0.2, 3.0};
    double s[MOST_GROUPS];
    draw_sizes(MOST_GROUPS, 40.0, OTHER);
    const double freedom = hci_group_sizes(left, MOST_GROUPS, s);
    for (size_t g = 0; g < MOST_GROUPS; ++g)
        TEST_ASSERT_DOUBLE_WITHIN(0.5, OTHER[g], s[g]);
    TEST_ASSERT_TRUE(freedom < 2.5 * MOST_GROUPS);
}

/* Without noise nothing is by chance, and a group is one value, of however many directions. */
static void test_groups_without_noise(void)
{
    double s[4];
    for (size_t g = 0; g < 4; ++g)
        left[g] = (hci_left_out_group){0.0, 1.0 + 0.1 * (double)g, 100.0, 0.0, 0.0, 0.0};
    TEST_ASSERT_DOUBLE_WITHIN(1e-9, 4.0, hci_group_sizes(left, 4, s));
    for (size_t g = 0; g < 4; ++g)
        TEST_ASSERT_DOUBLE_WITHIN(1e-12, sqrt(left[g].misfit), s[g]);
}

static void test_groups_that_tell_nothing(void)
{
    double s[3];
    left[0] = left[2] = (hci_left_out_group){1.0, 4.0, 2.0, 4.0, 0.0, 0.0};
    left[1] = (hci_left_out_group){1.0, NAN, 0.0, 4.0, 0.0, 0.0};
    TEST_ASSERT_DOUBLE_WITHIN(1e-9, 4.0, hci_group_sizes(left, 3, s));
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, 2.0, s[0]);
    TEST_ASSERT_TRUE(isnan(s[1]));
    left[0].misfit = left[2].misfit = 0.0;
    TEST_ASSERT_DOUBLE_WITHIN(0.0, 0.0, hci_group_sizes(left, 3, s));
}

/* ---- memory ---- */

static void test_memory(void)
{
    const hci_expectation expected = {precision, centre};
    size(3, 4, 5);
    draw_rows();
    condense();
    hci_memory_fail_after(0);
    TEST_ASSERT_FALSE(hci_condensed_add(&condensed, &group[0], unit));
    TEST_ASSERT_EQUAL_UINT(3, condensed.count);
    memset(&ridge, 1, sizeof ridge);
    TEST_ASSERT_FALSE(hci_ridge_make(&condensed, &expected, &ridge));
    TEST_ASSERT_EQUAL_UINT(0, ridge.n);
    TEST_ASSERT_TRUE(!ridge.factor && !ridge.scale && !ridge.mean);
    hci_memory_fail_after(1);
    TEST_ASSERT_TRUE(hci_ridge_make(&condensed, &expected, &ridge));
    TEST_ASSERT_FALSE(hci_ridge_leave_out(&ridge, &condensed, NULL, left));
    for (long allocations = 0; allocations < 4; ++allocations) {
        hci_condensed joined = {0};
        size_t of[MOST_GROUPS];
        hci_memory_fail_after(allocations);
        TEST_ASSERT_FALSE(hci_condensed_join(&condensed, unit, 0.99, &joined, of));
        TEST_ASSERT_NULL(joined.gram);
    }
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_a_group_is_as_small_as_its_rows);
    RUN_TEST(test_what_no_unknown_describes_is_the_rest);
    RUN_TEST(test_one_unknown);
    RUN_TEST(test_centre_is_expected);
    RUN_TEST(test_errors_left_out);
    RUN_TEST(test_groups_left_out_tell_the_size_of_errors);
    RUN_TEST(test_draws);
    RUN_TEST(test_an_unknown_that_nothing_is_said_of);
    RUN_TEST(test_one_value_in_twenty_is_above_the_bound);
    RUN_TEST(test_no_more_than_that_where_groups_tell_the_size);
    RUN_TEST(test_copies_are_joined);
    RUN_TEST(test_groups_are_joined_by_their_cosine);
    RUN_TEST(test_a_copy_does_not_vouch_for_a_run);
    RUN_TEST(test_groups_that_are_alike);
    RUN_TEST(test_groups_that_differ);
    RUN_TEST(test_groups_without_noise);
    RUN_TEST(test_groups_that_tell_nothing);
    RUN_TEST(test_memory);
    return UNITY_END();
}
