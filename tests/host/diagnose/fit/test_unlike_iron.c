/* What iron cannot make: of a rotor that looks alike both ways round a mean torque that keeps its sign when
 * i_q turns its own, and of any a torque along q that grows faster than the current. */
#include "host/diagnose/fit/unlike_iron.h"

#include "support/searching.h"

enum { SAMPLES = 150 };

void setUp(void)
{
    dataset_start();
    for (int k = 0; k < 4; ++k) {
        record(SAMPLES, &(point){60.0, k % 2 ? -9.0 : 6.0, 0.0, 0.0, 0.0});
        for (size_t j = 0; j < SAMPLES; ++j)
            rec_phases(k < 2 ? -4.0 : 0.0, k % 2 ? -9.0 : 6.0, P * run[k].theta_m_rad[j], run[k].i_A + 3 * j);
    }
    search_start();
    model.candidates.reference_current_A = 9.0;
}

void tearDown(void)
{
    search_end();
    dataset_end();
}

static void add(const char *effect, const char *parameter, double order, double value)
{
    model_add(effect, parameter, NULL, order);
    size_t k = model.candidates.count;
    while (k-- > 0)
        if (strcmp(model.candidates.candidate[k]
                       .type->parameter[model.candidates.candidate[k].term[0].parameter]
                       .name,
                   parameter) == 0)
            model.candidates.candidate[k].term[0].value = value;
}

static bool is_broken(size_t k)
{
    return hci_mirror_is_broken(search.regression, &model.candidates, k);
}

/* T = 3/2 p (L_dq (i_d² − i_q²) …): the same way round with either sign of i_q. */
static void test_cross_inductance_alone_is_none(void)
{
    add("reluctance", "dq_cosine", 0.0, 1e-4);
    TEST_ASSERT_TRUE(is_broken(0));
    model.candidates.candidate[0].in = false;
    TEST_ASSERT_FALSE(is_broken(0));
}

/* Poles that are a little skew. */
static void test_beside_a_larger_saliency_it_is_believed(void)
{
    add("reluctance", "dd_cosine", 0.0, -1e-3);
    add("reluctance", "dq_cosine", 0.0, 1e-4);
    TEST_ASSERT_FALSE(is_broken(0));
    TEST_ASSERT_FALSE(is_broken(1));
}

/* The saliency is none of it, however small it is. */
static void test_only_what_keeps_its_sign_leaves(void)
{
    add("reluctance", "dd_cosine", 0.0, -1e-5);
    add("reluctance", "dq_cosine", 0.0, 1e-4);
    TEST_ASSERT_FALSE(is_broken(0));
    TEST_ASSERT_TRUE(is_broken(1));
}

/* i_d i_q³ and i_d i_q², in units of the reference current. */
static void test_powers_of_the_currents(void)
{
    add("saturation", "d1q2_cosine", 0.0, 0.01);
    TEST_ASSERT_FALSE(is_broken(0));
    add("saturation", "d1q3_cosine", 0.0, 0.05);
    TEST_ASSERT_FALSE(is_broken(0));
    TEST_ASSERT_TRUE(is_broken(1));
}

/* Orders above the mean have sine and cosine where phases are turned, and are asked nothing. */
static void test_of_the_mean_alone(void)
{
    add("reluctance", "dq_cosine", 6.0, 1e-4);
    TEST_ASSERT_FALSE(is_broken(0));
}

/* Only runs in use are asked. */
static void test_of_runs_in_use(void)
{
    static const bool NONE[MOST_RUNS] = {false};
    add("reluctance", "dq_cosine", 0.0, 1e-4);
    const bool *use = search.regression->use;
    search.regression->use = NONE;
    TEST_ASSERT_FALSE(is_broken(0));
    search.regression->use = use;
}

/* Together they are a torque for one sign of i_q alone, as of a force along the shaft. */
static void test_a_torque_of_one_sign_leaves(void)
{
    add("saturation", "d1q2_cosine", 0.0, 0.05);
    add("saturation", "d1q3_cosine", 0.0, 0.035);
    TEST_ASSERT_FALSE(is_broken(0));
    TEST_ASSERT_TRUE(is_broken(1));
}

/* ---- how much of it ---- */

/* Means of the currents of all runs, as they are along another one. */
static void stand_at(double d_A, double q_A)
{
    for (size_t r = 0; r < 4; ++r) {
        dataset.samples.statistics[r].mean_id_A = d_A;
        dataset.samples.statistics[r].mean_iq_A = q_A;
    }
}

/* What keeps its sign, L_dq (i_d² − i_q²) = 20 L_dq, over what turns it, L_dd i_d i_q = 24 L_dd. */
static void parts_as(double share)
{
    stand_at(-4.0, 6.0);
    hci_candidates_release(&model.candidates);
    model.candidates.reference_current_A = 9.0;
    add("reluctance", "dd_cosine", 0.0, 1e-3);
    add("reluctance", "dq_cosine", 0.0, share * 24.0 / 20.0 * 1e-3);
}

/* Half of it is a quarter of its square; of direct current, whose means are no currents, all of it. */
static void test_how_much_of_it_is_believed(void)
{
    parts_as(0.49);
    TEST_ASSERT_FALSE(is_broken(1));
    parts_as(0.51);
    TEST_ASSERT_TRUE(is_broken(1));
    TEST_ASSERT_FALSE(is_broken(0));
    dataset.samples.statistics[2].is_direct = true;
    TEST_ASSERT_FALSE(is_broken(1));
    parts_as(0.99);
    TEST_ASSERT_FALSE(is_broken(1));
    parts_as(1.01);
    TEST_ASSERT_TRUE(is_broken(1));
}

/* One of direct current that is not in use changes nothing. */
static void test_direct_current_in_use(void)
{
    static const bool USE[MOST_RUNS] = {true, false, true, true};
    const bool *use = search.regression->use;
    parts_as(0.6);
    search.regression->use = USE;
    dataset.samples.statistics[1].is_direct = true;
    TEST_ASSERT_TRUE(is_broken(1));
    dataset.samples.statistics[3].is_direct = true;
    TEST_ASSERT_FALSE(is_broken(1));
    search.regression->use = use;
}

/* Each of the runs alone may be of direct current. */
static void test_any_of_direct_current(void)
{
    for (size_t r = 0; r < 4; ++r) {
        parts_as(0.6);
        TEST_ASSERT_TRUE(is_broken(1));
        dataset.samples.statistics[r].is_direct = true;
        TEST_ASSERT_FALSE(is_broken(1));
        dataset.samples.statistics[r].is_direct = false;
    }
}

/* The squares of the runs are summed up, each of the sum of its terms: 20 against 24 in three of them, and
 * in the fourth 25 against 0. */
static void test_squares_of_the_runs(void)
{
    const double limit = sqrt(3.0 * 24.0 * 24.0 / (3.0 * 20.0 * 20.0 + 25.0 * 25.0)) * 0.5;
    for (int over = 0; over < 2; ++over) {
        parts_as(0.0);
        dataset.samples.statistics[1].mean_id_A = 0.0;
        dataset.samples.statistics[1].mean_iq_A = 5.0;
        add("reluctance", "dq_cosine", 0.0, 1e-3 * limit * (over ? 1.02 : 0.98));
        model.candidates.candidate[1].in = false;
        TEST_ASSERT_EQUAL(over, is_broken(2));
    }
}

/* Of a machine with an inductance that varies along the angle the mean has other parts too. */
static void test_not_where_inductances_vary(void)
{
    static const hci_inductance_slope SLOPE = {.order = 6.0};
    hci_machine varies = *search.regression->machine;
    const hci_machine *before = search.regression->machine;
    parts_as(0.9);
    TEST_ASSERT_TRUE(is_broken(1));
    varies.slope = &SLOPE;
    varies.slope_count = 1;
    search.regression->machine = &varies;
    TEST_ASSERT_FALSE(is_broken(1));
    search.regression->machine = before;
}

/* ---- more torque per ampere ---- */

/* W' = w i_d i_q²/I³ makes p w at i_q = I, beside 3/2 K I. */
static bool rises_by(double share)
{
    add("saturation", "d1q2_cosine", 0.0, share * 1.5 * K_NM_PER_A * 9.0 / P);
    return hci_iron_would_rise(search.regression, &model.candidates, 0);
}

static void test_iron_makes_no_more_torque_per_ampere(void)
{
    TEST_ASSERT_TRUE(rises_by(0.05));
}

static void test_a_little_more_is_believed(void)
{
    TEST_ASSERT_FALSE(rises_by(0.02));
}

static void test_less_is_saturation(void)
{
    TEST_ASSERT_FALSE(rises_by(-0.2));
}

/* i_d of half of i_q: what the current along q makes was not recorded. */
static void test_not_without_a_current_along_q(void)
{
    for (int k = 2; k < 4; ++k)
        dataset.samples.statistics[k].mean_id_A = -4.5;
    TEST_ASSERT_FALSE(rises_by(0.05));
}

/* Against 0.03, where the current along q is the reference current itself, of either sign. */
static void test_how_much_more_is_believed(void)
{
    for (int sign = -1; sign <= 1; sign += 2) {
        stand_at(0.0, sign * 9.0);
        for (int over = 0; over < 2; ++over) {
            hci_candidates_release(&model.candidates);
            model.candidates.reference_current_A = 9.0;
            TEST_ASSERT_EQUAL(over, rises_by(over ? 0.0305 : 0.0295));
        }
    }
}

/* Terms of the co-energy are one: a tenth more by the one, and 0.08 or 0.04 less by the other. */
static void test_terms_together(void)
{
    stand_at(0.0, 9.0);
    TEST_ASSERT_TRUE(rises_by(0.1));
    add("saturation", "d1q4_cosine", 0.0, -0.08 * 1.5 * K_NM_PER_A * 9.0 / P);
    TEST_ASSERT_FALSE(hci_iron_would_rise(search.regression, &model.candidates, 0));
    model.candidates.candidate[1].term[0].value *= 0.5;
    TEST_ASSERT_TRUE(hci_iron_would_rise(search.regression, &model.candidates, 0));
    model.candidates.candidate[1].term[0].value *= 2.0;
    model.candidates.candidate[1].in = false;
    TEST_ASSERT_TRUE(hci_iron_would_rise(search.regression, &model.candidates, 0));
    TEST_ASSERT_FALSE(hci_iron_would_rise(search.regression, &model.candidates, 1));
}

/* The largest current along q is asked: what comes of a power goes by i_q² beside it. A fifth of
 * it may be along d. */
static void test_which_run_is_asked(void)
{
    static const double Q_A[4] = {2.0, -9.0, 4.0, 8.0};
    for (size_t r = 0; r < 4; ++r) {
        dataset.samples.statistics[r].mean_id_A = 0.0;
        dataset.samples.statistics[r].mean_iq_A = Q_A[r];
    }
    TEST_ASSERT_TRUE(rises_by(0.034)); /* 0.027 at 8 A */
    dataset.samples.statistics[1].mean_id_A = 0.21 * 9.0;
    TEST_ASSERT_FALSE(hci_iron_would_rise(search.regression, &model.candidates, 0));
    dataset.samples.statistics[1].mean_id_A = -0.21 * 9.0;
    TEST_ASSERT_FALSE(hci_iron_would_rise(search.regression, &model.candidates, 0));
    dataset.samples.statistics[1].mean_id_A = 0.19 * 9.0;
    TEST_ASSERT_TRUE(hci_iron_would_rise(search.regression, &model.candidates, 0));
    dataset.samples.statistics[1].is_direct = true;
    TEST_ASSERT_FALSE(hci_iron_would_rise(search.regression, &model.candidates, 0));
    dataset.samples.statistics[1].is_direct = false;
    static const bool USE[MOST_RUNS] = {true, false, true, true};
    const bool *use = search.regression->use;
    search.regression->use = USE;
    TEST_ASSERT_FALSE(hci_iron_would_rise(search.regression, &model.candidates, 0));
    search.regression->use = use;
}

/* The first as well as the last, of any size: a current of 0.2 A of a motor of 0.1 N·m/A. */
static void test_the_only_run_along_q(void)
{
    search.regression->declared_constant = 0.1;
    for (size_t r = 0; r < 4; ++r) {
        stand_at(-0.3, 0.2);
        dataset.samples.statistics[r].mean_id_A = 0.0;
        for (int over = 0; over < 2; ++over) {
            hci_candidates_release(&model.candidates);
            model.candidates.reference_current_A = 9.0;
            TEST_ASSERT_EQUAL(over, rises_by((over ? 0.0305 : 0.0295) / 3.0 * 45.0 * 45.0));
        }
    }
}

/* Saliency and a declared torque per ampere of none are asked nothing. */
static void test_of_powers_beside_magnets_alone(void)
{
    TEST_ASSERT_TRUE(rises_by(0.05));
    search.regression->declared_constant = 0.0;
    TEST_ASSERT_FALSE(hci_iron_would_rise(search.regression, &model.candidates, 0));
    search.regression->declared_constant = 1.5 * K_NM_PER_A;
    stand_at(-1.0, 9.0);
    add("reluctance", "dd_cosine", 0.0, -1.0);
    TEST_ASSERT_FALSE(hci_iron_would_rise(search.regression, &model.candidates, 1));
    for (size_t r = 0; r < 4; ++r)
        dataset.samples.statistics[r].is_direct = true;
    TEST_ASSERT_FALSE(hci_iron_would_rise(search.regression, &model.candidates, 0));
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_cross_inductance_alone_is_none);
    RUN_TEST(test_beside_a_larger_saliency_it_is_believed);
    RUN_TEST(test_only_what_keeps_its_sign_leaves);
    RUN_TEST(test_powers_of_the_currents);
    RUN_TEST(test_a_torque_of_one_sign_leaves);
    RUN_TEST(test_of_the_mean_alone);
    RUN_TEST(test_of_runs_in_use);
    RUN_TEST(test_iron_makes_no_more_torque_per_ampere);
    RUN_TEST(test_a_little_more_is_believed);
    RUN_TEST(test_less_is_saturation);
    RUN_TEST(test_not_without_a_current_along_q);
    RUN_TEST(test_how_much_of_it_is_believed);
    RUN_TEST(test_direct_current_in_use);
    RUN_TEST(test_any_of_direct_current);
    RUN_TEST(test_the_only_run_along_q);
    RUN_TEST(test_squares_of_the_runs);
    RUN_TEST(test_not_where_inductances_vary);
    RUN_TEST(test_how_much_more_is_believed);
    RUN_TEST(test_terms_together);
    RUN_TEST(test_which_run_is_asked);
    RUN_TEST(test_of_powers_beside_magnets_alone);
    return UNITY_END();
}
