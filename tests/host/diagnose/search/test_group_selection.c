/* Which terms come in together: normal equations with a known answer, chance, and all subsets of small cases.
 */
#include "host/diagnose/search/group_selection.h"

#include <math.h>
#include <string.h>

#include "host/diagnose/fit/fit.h"
#include "support/recording.h"
#include "unity.h"

enum { MOST = 84 };

static const double ROWS = 200.0;

static uint64_t seed;
static hci_candidate item[MOST];
static hci_candidates list;
static size_t column[MOST];
static hci_normal_equations normal;
static hci_sweep base, sweep;
static bool in[MOST], spare[MOST];

void setUp(void)
{
    seed = 4711;
    memset(item, 0, sizeof item);
    list = (hci_candidates){item, 0, 1.0};
}

static void problem_release(void)
{
    hci_normal_equations_release(&normal);
    hci_sweep_release(&base);
    hci_sweep_release(&sweep);
}

void tearDown(void)
{
    problem_release();
}

/* ---- problems ---- */

static void offer(const char *effect, size_t terms, double order, double price)
{
    hci_candidate *x = &item[list.count++];
    *x = (hci_candidate){.type = hci_effect_type_find(effect), .count = terms, .price = price};
    for (size_t k = 0; k < terms; ++k)
        x->term[k] = (hci_effect_term){k, order, 0.0, NAN};
}

/* G = rows·I and moments of 0, to be filled in. */
static void problem_start(void)
{
    size_t columns = 0;
    problem_release();
    for (size_t k = 0; k < list.count; ++k) {
        column[k] = columns;
        columns += list.candidate[k].count;
    }
    TEST_ASSERT_TRUE(hci_normal_equations_start(&normal, columns));
    normal.rows = normal.square = ROWS;
    for (size_t c = 0; c < columns; ++c)
        normal.gram[c * columns + c] = ROWS;
}

static void couple(size_t i, size_t j, double correlation)
{
    normal.gram[i * normal.n + j] = normal.gram[j * normal.n + i] = ROWS * correlation;
}

/* Chooses among two effects; the model is what is `in`. */
static double choose_of(const char *a, const char *b)
{
    const hci_selection problem = {&list, column, &base, normal.rows};
    hci_sweep_release(&base);
    hci_sweep_release(&sweep);
    TEST_ASSERT_TRUE(hci_sweep_start(&base, &normal) && hci_sweep_start(&sweep, &normal));
    for (size_t k = 0; k < list.count; ++k)
        if (item[k].in) hci_selection_enter(&problem, &base, k);
    return hci_group_select(&problem, hci_effect_type_find(a), hci_effect_type_find(b), in, &sweep, spare);
}

static size_t chosen(void)
{
    size_t count = 0;
    for (size_t k = 0; k < list.count; ++k)
        count += in[k];
    return count;
}

/* ---- a known answer ---- */

/* Columns at right angles: χ² falls by b²/G for each, and each costs its price and ln(rows) a term. */
static void test_the_true_terms_come_in(void)
{
    for (int n = 1; n <= 5; ++n)
        offer("cogging", 2, 6.0 * n, 3.0);
    problem_start();
    normal.moment[2] = 90.0;
    normal.moment[3] = -40.0;
    normal.moment[9] = 100.0;
    const double gain = choose_of("cogging", "cogging");
    TEST_ASSERT_TRUE(in[1] && in[4]);
    TEST_ASSERT_EQUAL_UINT64(2, chosen());
    const double fall = (90.0 * 90.0 + 40.0 * 40.0 + 100.0 * 100.0) / ROWS;
    TEST_ASSERT_DOUBLE_WITHIN(1e-9, fall - 2.0 * (3.0 + 2.0 * log(ROWS)), gain);
}

static void test_other_effects_and_the_model_stay(void)
{
    offer("cogging", 1, 6.0, 0.0);
    offer("friction", 1, 0.0, 0.0);
    offer("position_offset", 1, 0.0, 0.0);
    offer("cogging", 1, 12.0, 0.0);
    item[3].in = true;
    problem_start();
    for (size_t c = 0; c < 4; ++c)
        normal.moment[c] = 100.0;
    choose_of("cogging", "friction");
    TEST_ASSERT_TRUE(in[0] && in[1] && !in[2] && !in[3]);
    choose_of("position_offset", "position_offset");
    TEST_ASSERT_TRUE(!in[0] && !in[1] && in[2] && !in[3]);
}

/* y = a + b, and a third column that is nearly a + b: it is the best alone, and superfluous in the end. */
static void test_what_becomes_superfluous_leaves(void)
{
    for (int n = 1; n <= 3; ++n)
        offer("cogging", 1, 6.0 * n, 0.0);
    problem_start();
    normal.square = 1000.0 * ROWS;
    couple(0, 2, 0.66);
    couple(1, 2, 0.66);
    normal.moment[0] = normal.moment[1] = 10.0 * ROWS;
    normal.moment[2] = 13.2 * ROWS;
    choose_of("cogging", "cogging");
    TEST_ASSERT_TRUE(in[0] && in[1] && !in[2]);
}

/* A column that is another one once more brings nothing, and is refused. */
static void test_a_column_twice(void)
{
    offer("cogging", 1, 6.0, 0.0);
    offer("cogging", 1, 12.0, 0.0);
    problem_start();
    couple(0, 1, 1.0);
    normal.moment[0] = normal.moment[1] = 100.0;
    choose_of("cogging", "cogging");
    TEST_ASSERT_EQUAL_UINT64(1, chosen());
    const hci_selection problem = {&list, column, &base, normal.rows};
    TEST_ASSERT_TRUE(hci_selection_enter(&problem, &base, 0));
    TEST_ASSERT_FALSE(hci_selection_enter(&problem, &base, 1));
}

/* Powers at order 0 whose difference explains much and each of which next to nothing: all at once, and only
 * saturation does that. */
static void test_powers_that_help_together_only(void)
{
    for (int what = 0; what < 2; ++what) {
        const char *const effect = what == 0 ? "saturation" : "reluctance";
        const double correlation = 0.999, moment = 4.0;
        list.count = 0;
        offer(effect, 1, 0.0, 0.0);
        offer(effect, 1, 0.0, 0.0);
        item[1].term[0].parameter = 1;
        problem_start();
        couple(0, 1, correlation);
        normal.moment[0] = moment;
        normal.moment[1] = -moment;
        const double gain = choose_of(effect, effect);
        TEST_ASSERT_EQUAL_UINT64(what == 0 ? 2 : 0, chosen());
        const double fall = 2.0 * moment * moment / ROWS / (1.0 - correlation);
        TEST_ASSERT_DOUBLE_WITHIN(1e-6, what == 0 ? fall - 2.0 * log(ROWS) : 0.0, gain);
    }
}

/* ---- thresholds ---- */

/* Moment of a column at right angles to all others by which the score falls by so much. */
static double moment_of(double gain, double rows)
{
    return sqrt(ROWS * (gain + log(rows)));
}

/* The first comes in for anything, one more order for 2 or a thousandth of the rows, a term without an order
 * for 2. */
static void test_what_one_more_must_bring(void)
{
    static const struct {
        const char *effect;
        double rows, least;
    } CASE[] = {{"cogging", 200.0, 2.0},
                {"cogging", 1900.0, 2.0},
                {"cogging", 5000.0, 5.0}, //
                {"friction", 200.0, 2.0},
                {"friction", 5000.0, 2.0}};
    for (size_t k = 0; k < 5; ++k)
        for (int more = 0; more < 2; ++more) {
            const double rows = CASE[k].rows, second = CASE[k].least + (more ? 0.05 : -0.05);
            list.count = 0;
            offer(CASE[k].effect, 1, k < 3 ? 6.0 : 0.0, 0.0);
            offer(CASE[k].effect, 1, k < 3 ? 12.0 : 0.0, 0.0);
            item[1].term[0].parameter = k < 3 ? 0 : 1;
            problem_start();
            normal.rows = rows;
            normal.moment[0] = moment_of(0.1, rows);
            TEST_ASSERT_DOUBLE_WITHIN(1e-9, 0.1, choose_of(CASE[k].effect, CASE[k].effect));
            TEST_ASSERT_TRUE(in[0] && !in[1]);
            normal.moment[0] = -moment_of(9.0, rows);
            normal.moment[1] = moment_of(second, rows);
            TEST_ASSERT_DOUBLE_WITHIN(1e-9, more ? 9.0 + second : 9.0,
                                      choose_of(CASE[k].effect, CASE[k].effect));
            TEST_ASSERT_TRUE(in[0] && in[1] == more);
        }
}

/* Of orders of one effect twelve come in, the strongest of them, of two twice as many, of a series eighty. */
static void test_how_many_come_in(void)
{
    static const struct {
        const char *a, *b;
        size_t most;
    } CASE[] = {{"cogging", "cogging", 12}, {"cogging", "back_emf", 24}, {"saturation", "saturation", 80}};
    for (size_t k = 0; k < 3; ++k) {
        list.count = 0;
        for (size_t n = 0; n < CASE[k].most + 2; ++n)
            offer(n % 2 ? CASE[k].a : CASE[k].b, 1, 6.0 * (double)(n + 1), 0.0);
        problem_start();
        normal.square = 1e6;
        for (size_t n = 0; n < list.count; ++n)
            normal.moment[n] = moment_of(10.0 + (double)((5 * n + 3) % list.count), ROWS);
        choose_of(CASE[k].a, CASE[k].b);
        TEST_ASSERT_EQUAL_UINT64(CASE[k].most, chosen());
        for (size_t n = 0; n < list.count; ++n)
            TEST_ASSERT_EQUAL((5 * n + 3) % list.count >= 2, in[n]);
    }
}

/* The same as one that becomes superfluous, of two terms, behind and before others. */
static void test_what_becomes_superfluous_leaves_with_all_its_terms(void)
{
    for (int first = 0; first < 2; ++first) {
        list.count = 0;
        for (int n = 0; n < 3; ++n)
            offer("cogging", n == (first ? 0 : 2) ? 2 : 1, 6.0 * (n + 1), 0.0);
        problem_start();
        const size_t pair = first ? 0 : 2, a = first ? 2 : 0, b = a + 1;
        normal.square = 1000.0 * ROWS;
        couple(a, pair, 0.66);
        couple(b, pair, 0.66);
        normal.moment[a] = normal.moment[b] = 10.0 * ROWS;
        normal.moment[pair] = 13.2 * ROWS;
        const double gain = choose_of("cogging", "cogging");
        TEST_ASSERT_EQUAL_UINT64(2, chosen());
        TEST_ASSERT_FALSE(in[first ? 0 : 2]);
        TEST_ASSERT_DOUBLE_WITHIN(1e-6, 200.0 * ROWS - 2.0 * log(ROWS), gain);
    }
}

/* Two powers of which the difference alone tells, by so much, beside one of an order that brings 400. */
static size_t powers_chosen(double together, double order, bool beside)
{
    const double correlation = 0.999;
    list.count = 0;
    for (size_t k = 0; k < 4; ++k) {
        offer("saturation", 1, k < 3 ? order : 18.0, 0.0);
        item[k].term[0].parameter = k;
    }
    problem_start();
    normal.square = 1e4;
    couple(0, 1, correlation);
    normal.moment[0] = sqrt(0.5 * (together + 2.0 * log(ROWS)) * ROWS * (1.0 - correlation));
    normal.moment[1] = -normal.moment[0];
    normal.moment[3] = beside ? moment_of(400.0, ROWS) : 0.0;
    choose_of("saturation", "saturation");
    TEST_ASSERT_EQUAL(beside, in[3]);
    TEST_ASSERT_FALSE(in[2]); /* a third that brings nothing leaves again */
    TEST_ASSERT_EQUAL(in[0], in[1]);
    return chosen();
}

/* They must bring 10, or a tenth of what comes in one by one, and are powers of the mean. */
static void test_what_powers_must_bring_together(void)
{
    TEST_ASSERT_EQUAL_UINT64(0, powers_chosen(9.9, 0.0, false));
    TEST_ASSERT_EQUAL_UINT64(2, powers_chosen(10.1, 0.0, false));
    TEST_ASSERT_EQUAL_UINT64(1, powers_chosen(39.0, 0.0, true));
    TEST_ASSERT_EQUAL_UINT64(3, powers_chosen(41.0, 0.0, true));
    TEST_ASSERT_EQUAL_UINT64(0, powers_chosen(41.0, 6.0, false));
}

/* ---- chance ---- */

/* Noise makes moments N(0, rows). A pair of columns lowers χ² by more than 2 ln M + 2 ln(rows) once in M·rows
 * times, so that one of M pairs comes in once in `rows` times. */
static void test_noise_comes_in_at_the_rate_of_its_price(void)
{
    enum { PAIRS = 6, DRAWS = 8000 };
    const double rate = 1.0 - pow(1.0 - 1.0 / (PAIRS * ROWS), PAIRS);
    double alarms = 0.0;
    for (int n = 1; n <= PAIRS; ++n)
        offer("cogging", 2, 6.0 * n, 2.0 * log(PAIRS));
    problem_start();
    for (int k = 0; k < DRAWS; ++k) {
        for (size_t c = 0; c < normal.n; ++c)
            normal.moment[c] = sqrt(ROWS) * ref_normal(&seed);
        const double gain = choose_of("cogging", "cogging");
        TEST_ASSERT_TRUE((chosen() > 0) == (gain > 0.0));
        alarms += chosen() > 0;
    }
    const double deviation = sqrt(rate * DRAWS); /* 6.3 of 40 */
    TEST_ASSERT_DOUBLE_WITHIN(3.0 * deviation, rate * DRAWS, alarms);
}

/* ---- all subsets ---- */

/* χ² that the columns of a subset leave, by Gaussian elimination on the bordered matrix; its cost on top. */
static double score_of(unsigned subset)
{
    double a[MOST + 1][MOST + 1], cost = 0.0;
    size_t n = 0, at[MOST];
    for (size_t k = 0; k < list.count; ++k)
        if (subset >> k & 1u) {
            at[n++] = k;
            cost += hci_candidate_cost(&item[k], normal.rows);
        }
    for (size_t i = 0; i <= n; ++i)
        for (size_t j = 0; j <= n; ++j)
            a[i][j] = i < n && j < n ? normal.gram[at[i] * normal.n + at[j]]
                      : i < n        ? normal.moment[at[i]]
                      : j < n        ? normal.moment[at[j]]
                                     : normal.square;
    for (size_t k = 0; k < n; ++k)
        for (size_t i = k + 1; i <= n; ++i) {
            const double factor = a[i][k] / a[k][k];
            for (size_t j = k; j <= n; ++j)
                a[i][j] -= factor * a[k][j];
        }
    return a[n][n] + cost;
}

/* Columns of random rows, some alike, and a random truth of two of them. */
static void draw(size_t count)
{
    double x[200][MOST], y[200];
    problem_start();
    memset(normal.gram, 0, count * count * sizeof *normal.gram);
    normal.square = 0.0;
    for (size_t k = 0; k < 200; ++k) {
        y[k] = ref_normal(&seed);
        for (size_t c = 0; c < count; ++c)
            x[k][c] = ref_normal(&seed) + (c > 0 && c % 2 == 0 ? x[k][c - 1] : 0.0);
        y[k] += 0.4 * x[k][1] - 0.3 * x[k][4];
        normal.square += y[k] * y[k];
    }
    for (size_t i = 0; i < count; ++i)
        for (size_t k = 0; k < 200; ++k) {
            normal.moment[i] += x[k][i] * y[k];
            for (size_t j = 0; j < count; ++j)
                normal.gram[i * count + j] += x[k][i] * x[k][j];
        }
}

/* The gain is that of the subset; no single term out or in (by its least gain of 2) would be better; and it
 * is nearly always the best of all subsets. */
static void test_against_all_subsets(void)
{
    enum { COUNT = 7, DRAWS = 60 };
    int best = 0;
    for (int n = 1; n <= COUNT; ++n)
        offer("cogging", 1, 6.0 * n, 1.0);
    for (int draws = 0; draws < DRAWS; ++draws) {
        unsigned subset = 0;
        double least = INFINITY;
        draw(COUNT);
        const double gain = choose_of("cogging", "cogging");
        for (unsigned k = 0; k < COUNT; ++k)
            subset |= (unsigned)in[k] << k;
        const double score = score_of(subset);
        TEST_ASSERT_DOUBLE_WITHIN(1e-9 * ROWS, score_of(0) - score, gain);
        for (unsigned k = 0; k < COUNT; ++k)
            TEST_ASSERT_TRUE(score_of(subset ^ 1u << k) > score - (in[k] ? 1e-9 : 2.0));
        for (unsigned other = 0; other < 1u << COUNT; ++other)
            least = fmin(least, score_of(other));
        TEST_ASSERT_TRUE(score > least - 1e-9);
        best += score < least + 2.0;
    }
    TEST_ASSERT_TRUE(best >= DRAWS * 9 / 10);
}

/* ---- columns that are much alike ---- */

enum { BLOCK_ROWS = 400, BLOCK_ORDERS = 11 };

static const double BLOCK_ORDER[BLOCK_ORDERS] = {1.0,  5.0,  7.0,  11.0, 13.0, 17.0,
                                                 19.0, 23.0, 25.0, 29.0, 31.0};

/* Torque of one order of the back-EMF while two phases carry a constant current, over a sixth of a turn. */
static double block_torque(size_t order, size_t row)
{
    const double theta_rad = HCI_PI / 3.0 * (((double)row + 0.5) / BLOCK_ROWS - 0.5);
    return cos(BLOCK_ORDER[order] * theta_rad);
}

/* y: orders 5, 7 and 11. */
static void blocks_record(double per_noise)
{
    problem_start();
    memset(normal.gram, 0, normal.n * normal.n * sizeof *normal.gram);
    normal.rows = BLOCK_ROWS;
    normal.square = 0.0;
    for (size_t k = 0; k < BLOCK_ROWS; ++k) {
        const double y =
            per_noise * (0.06 * block_torque(1, k) + 0.03 * block_torque(2, k) - 0.015 * block_torque(3, k));
        normal.square += y * y;
        for (size_t i = 0; i < normal.n; ++i) {
            normal.moment[i] += per_noise * block_torque(i, k) * y;
            for (size_t j = 0; j < normal.n; ++j)
                normal.gram[i * normal.n + j] +=
                    per_noise * per_noise * block_torque(i, k) * block_torque(j, k);
        }
    }
}

/* Currents in blocks make much the same of all orders: one by one 1, 5, 13 and 19 come in; the three that
 * make all are fewer. */
static void test_a_few_in_place_of_others_that_imitate_them(void)
{
    for (int n = 0; n < BLOCK_ORDERS; ++n)
        offer("back_emf", 1, BLOCK_ORDER[n], log((double)BLOCK_ROWS));
    blocks_record(1000.0);
    choose_of("back_emf", "back_emf");
    TEST_ASSERT_TRUE(in[1] && in[2] && in[3]);
    TEST_ASSERT_EQUAL_UINT64(3, chosen());
}

/* The same wherever they stand in the list. */
static void test_a_few_that_stand_anywhere(void)
{
    for (size_t from = 1; from < BLOCK_ORDERS; ++from) {
        list.count = 0;
        for (size_t n = 0; n < BLOCK_ORDERS; ++n)
            offer("back_emf", 1, BLOCK_ORDER[n], log((double)BLOCK_ROWS));
        blocks_record(1000.0);
        hci_normal_equations plain = normal;
        memset(&normal, 0, sizeof normal);
        problem_start();
        normal.rows = plain.rows;
        normal.square = plain.square;
        for (size_t i = 0; i < BLOCK_ORDERS; ++i) {
            const size_t row = (i + from) % BLOCK_ORDERS;
            item[i].term[0].order = BLOCK_ORDER[row];
            normal.moment[i] = plain.moment[row];
            for (size_t j = 0; j < BLOCK_ORDERS; ++j)
                normal.gram[i * normal.n + j] = plain.gram[row * plain.n + (j + from) % BLOCK_ORDERS];
        }
        hci_normal_equations_release(&plain);
        choose_of("back_emf", "back_emf");
        TEST_ASSERT_EQUAL_UINT64(3, chosen());
        for (size_t i = 0; i < BLOCK_ORDERS; ++i) {
            const size_t row = (i + from) % BLOCK_ORDERS;
            TEST_ASSERT_EQUAL(row >= 1 && row <= 3, in[i]);
        }
    }
}

/* And of two terms each, of which the second sees the same in samples of its own. */
static void test_a_few_of_two_terms(void)
{
    for (size_t n = 0; n < BLOCK_ORDERS; ++n)
        offer("back_emf", 1, BLOCK_ORDER[n], 0.0);
    blocks_record(1000.0);
    const hci_normal_equations one = normal;
    memset(&normal, 0, sizeof normal);
    list.count = 0;
    for (size_t n = 0; n < BLOCK_ORDERS; ++n)
        offer("back_emf", 2, BLOCK_ORDER[n], 2.0 * log((double)BLOCK_ROWS));
    problem_start();
    normal.rows = one.rows;
    normal.square = 2.0 * one.square;
    memset(normal.gram, 0, normal.n * normal.n * sizeof *normal.gram);
    for (size_t i = 0; i < normal.n; ++i) {
        normal.moment[i] = one.moment[i / 2];
        for (size_t j = i % 2; j < normal.n; j += 2)
            normal.gram[i * normal.n + j] = one.gram[i / 2 * one.n + j / 2];
    }
    hci_normal_equations copy = one;
    hci_normal_equations_release(&copy);
    choose_of("back_emf", "back_emf");
    TEST_ASSERT_TRUE(in[1] && in[2] && in[3]);
    TEST_ASSERT_EQUAL_UINT64(3, chosen());
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_the_true_terms_come_in);
    RUN_TEST(test_other_effects_and_the_model_stay);
    RUN_TEST(test_what_becomes_superfluous_leaves);
    RUN_TEST(test_a_column_twice);
    RUN_TEST(test_powers_that_help_together_only);
    RUN_TEST(test_noise_comes_in_at_the_rate_of_its_price);
    RUN_TEST(test_against_all_subsets);
    RUN_TEST(test_a_few_in_place_of_others_that_imitate_them);
    RUN_TEST(test_a_few_that_stand_anywhere);
    RUN_TEST(test_a_few_of_two_terms);
    RUN_TEST(test_what_one_more_must_bring);
    RUN_TEST(test_how_many_come_in);
    RUN_TEST(test_what_becomes_superfluous_leaves_with_all_its_terms);
    RUN_TEST(test_what_powers_must_bring_together);
    return UNITY_END();
}
