/* Normal equations: their moments are half the slope of −χ², whatever the effect, and what a run cannot show
 * has none. */
#include "host/diagnose/fit/linearise.h"

#include "support/searching.h"

enum { N = 1000 };

static hci_normal_equations here, side;

void setUp(void)
{
    dataset_start();
}

void tearDown(void)
{
    hci_normal_equations_release(&here);
    hci_normal_equations_release(&side);
    search_end();
    dataset_end();
}

/* Two runs with time, currents with a sum, and three turns: long enough for smooth currents. */
static void record_two(void)
{
    for (size_t r = 0; r < 2; ++r) {
        record(N, &(point){r == 0 ? 60.0 : -150.0, r == 0 ? 3.0 : 9.0, 0.2, 0.03, 0.0});
        run[r].has_sum = true;
        for (size_t k = 0; k < 3 * N; ++k)
            run[r].i_A[k] += 0.01 * ref_normal(&seed);
    }
    search_start();
    hci_search_noise(&search, &model.candidates, &note);
}

static double linearise(hci_normal_equations *normal)
{
    TEST_ASSERT_EQUAL_INT(
        HCI_OK, hci_regression_normal(&dataset.regression, &model.candidates, false, normal, &note));
    return normal->square;
}

/* Effects of all kinds at values that are not 0, where what is not linear shows: central differences of χ².
 */
static void test_moments_are_the_slope(void)
{
    static const struct {
        const char *effect, *parameter;
        double order, value, step;
    } TERM[] = {
        {"cogging", "sine", 6.0, 0.01, 1e-4},
        {"back_emf", "cosine", 5.0, 0.004, 1e-5},
        {"phase_imbalance", "b", 0.0, 0.02, 1e-4},
        {"reluctance", "dq_cosine", 0.0, 1e-4, 1e-6},
        {"friction", "viscous", 0.0, 1e-4, 1e-6},
        {"channel_delay", "angle", 0.0, 2e-4, 1e-6},
        {"channel_delay", "current", 0.0, 1e-4, 1e-6},
        {"position_offset", "angle", 0.0, 0.03, 1e-4},
        {"position_eccentricity", "mech_sine", 1.0, 0.01, 1e-5},
        {"current_gain", "a", 0.0, 1e-9, 1e-5},
        {"current_offset", "c", 0.0, 0.1, 1e-3},
        {"torque_sensor", "offset", 0.0, 0.02, 1e-4},
        {"torque_sensor", "time_constant", 0.0, 1e-3, 1e-6},
        {"mechanical_order", "iq_sine", 1.0 / 3.0, 1e-3, 1e-5},
    };
    enum { TERMS = sizeof TERM / sizeof *TERM };
    record_two();
    for (size_t k = 0; k < TERMS; ++k) {
        model_add(TERM[k].effect, TERM[k].parameter, NULL, TERM[k].order);
        for (size_t j = 0; j < model.candidates.count; ++j) {
            hci_candidate *x = &model.candidates.candidate[j];
            if (x->term[0].value == 0.0) x->term[0].value = TERM[k].value;
        }
    }
    model.candidates.candidate[0].deviation = 2e-4;
    linearise(&here);
    TEST_ASSERT_EQUAL_UINT64(TERMS, here.n);
    TEST_ASSERT_EQUAL_DOUBLE(2.0 * N, here.rows);
    for (size_t c = 0; c < TERMS; ++c) {
        hci_effect_term *t = &model.candidates.candidate[c].term[0];
        size_t k = 0;
        double square[2];
        while (strcmp(TERM[k].effect, model.candidates.candidate[c].type->name) != 0 ||
               parameter_of(model.candidates.candidate[c].type, TERM[k].parameter) != t->parameter)
            ++k;
        const double value = t->value;
        for (int s = 0; s < 2; ++s) {
            t->value = value + (s == 0 ? -TERM[k].step : TERM[k].step);
            square[s] = linearise(&side);
            hci_normal_equations_release(&side);
        }
        t->value = value;
        const double slope = 0.25 * (square[0] - square[1]) / TERM[k].step; /* −½ dχ²/dv */
        const double scale = sqrt(here.gram[c * here.n + c] * here.square);
        TEST_ASSERT_DOUBLE_WITHIN_MESSAGE(1e-4 * scale, slope, here.moment[c], TERM[k].effect);
        TEST_ASSERT_TRUE_MESSAGE(here.gram[c * here.n + c] > 0.0, TERM[k].effect);
    }
}

/* Without current nothing that grows with it can show; in a holding test the current answers to the torque,
 * and under a steady load harmonics of the back-EMF alone show. */
static void test_what_a_run_cannot_show(void)
{
    static const char *const OF_CURRENT[][2] = {
        {"back_emf", "sine"}, {"phase_imbalance", "a"}, {"reluctance", "dq_cosine"}, {"current_gain", "b"}};
    for (int holding = 0; holding < 2; ++holding) {
        record(N, &(point){60.0, holding ? 2.0 : 0.0, 0.0, 0.0, 0.0});
        if (holding) run[0].torque_source = HCI_TORQUE_HOLDING;
        search_start();
        hci_search_noise(&search, &model.candidates, &note);
        for (size_t k = 0; k < 4; ++k)
            model_add(OF_CURRENT[k][0], OF_CURRENT[k][1], NULL, k == 0 ? 5.0 : 0.0);
        model_add("cogging", "sine", NULL, 6.0);
        linearise(&here);
        for (size_t c = 0; c < 5; ++c)
            TEST_ASSERT_EQUAL(c == 4 || (c == 0 && holding), here.gram[c * 5 + c] > 0.0);
        tearDown();
        setUp();
    }
}

/* Where all three currents were recorded, their sum is that of the offsets: with no current in the machine
 * the torque does not tell them, the sum does, with the noise of one sample over √N. */
static void test_the_sum_of_the_currents_tells_offsets(void)
{
    for (int has_sum = 0; has_sum < 2; ++has_sum) {
        record(N, &(point){60.0, 0.0, 0.0, 0.0, 0.0});
        run[0].has_sum = has_sum;
        for (size_t k = 0; k < N; ++k) {
            run[0].i_A[3 * k + 2] += 0.5 + 0.02 * ref_normal(&seed);
            run[0].torque_Nm[k] = NOISE_NM * ref_normal(&seed);
        }
        machine.model.back_emf_count = 0;
        search_start();
        hci_search_noise(&search, &model.candidates, &note);
        model_add("current_offset", "c", NULL, 0.0);
        linearise(&here);
        if (has_sum) {
            TEST_ASSERT_DOUBLE_WITHIN(0.01, 0.5, here.moment[0] / here.gram[0]);
            TEST_ASSERT_DOUBLE_WITHIN(0.1 * N / 0.0004, N / 0.0004, here.gram[0]);
        } else
            TEST_ASSERT_EQUAL_DOUBLE(0.0, here.gram[0]);
        tearDown();
        setUp();
    }
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_moments_are_the_slope);
    RUN_TEST(test_what_a_run_cannot_show);
    RUN_TEST(test_the_sum_of_the_currents_tells_offsets);
    return UNITY_END();
}
