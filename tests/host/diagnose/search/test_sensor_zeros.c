/* Zeros of current sensors in a current loop that runs, and a cogging torque once an electrical turn that
 * looks like them. */
#include "host/diagnose/search/sensor_zeros.h"

#include "support/searching.h"

#define FIFTH 0.2 /* of the fundamental of the back-EMF */

enum { SAMPLES = 900, RUNS = 5 }; /* three mechanical turns */

static const double IQ_A[RUNS] = {0.0, 0.0, 4.0, 9.0, -6.0};
static const double ZERO_A[3] = {0.3, -0.1, -0.2};

void setUp(void)
{
    dataset_start();
    hci_machine_release(&machine);
    files_write(files_path("back_emf.csv"), "order,amplitude_Nm_per_A,phase_rad\n1,0.2,0\n5,0.04,0\n");
    TEST_ASSERT_EQUAL_INT_MESSAGE(HCI_OK, hci_machine_read(files_root, &machine, &note), note.text);
}

void tearDown(void)
{
    search_end();
    dataset_end();
}

static double back_emf(double angle)
{
    return K_NM_PER_A * (sin(angle) + FIFTH * sin(5.0 * angle));
}

/* What is read is what is wanted, with noise; what flows is less by the zeros, of which the torque is, beside
 * a cogging torque of order 1. */
static void record_loop(double zeros, double cogging_Nm)
{
    for (int r = 0; r < RUNS; ++r) {
        record(SAMPLES, &(point){r % 2 ? -40.0 : 40.0, 0.0, 0.0, 0.0, 0.0});
        for (size_t k = 0; k < SAMPLES; ++k) {
            const double angle = P * run[r].theta_m_rad[k];
            rec_phases(0.0, IQ_A[r], angle, run[r].i_A + 3 * k);
            for (size_t s = 0; s < 3; ++s) {
                const double flows_A = run[r].i_A[3 * k + s] - zeros * ZERO_A[s];
                run[r].torque_Nm[k] += back_emf(angle - 2.0 * REF_PI * (double)s / 3.0) * flows_A;
                run[r].i_A[3 * k + s] += 0.02 * ref_normal(&seed);
            }
            run[r].torque_Nm[k] += cogging_Nm * sin(angle + 0.4);
        }
    }
    search_start();
}

/* Whether zeros take the place of cogging torque of an order. */
static bool is_replaced(double order)
{
    bool changed = false;
    model_add("cogging", "sine", "cosine", order);
    model_fit();
    TEST_ASSERT_EQUAL_INT_MESSAGE(HCI_OK, hci_search_sensor_zeros(&search, &model, &changed, &note),
                                  note.text);
    if (changed) model_is_renewed();
    return changed;
}

/* Two runs without a current show a torque all the same, and the others as much. */
static void test_currents_flow_where_none_are_read(void)
{
    record_loop(1.0, 0.0);
    TEST_ASSERT_TRUE(dataset.samples.statistics[0].no_current && !dataset.samples.statistics[2].no_current);
    TEST_ASSERT_TRUE(is_replaced(1.0));
    TEST_ASSERT_FALSE(model_has("cogging"));
    const hci_effect_term *a = term_in(&model.candidates, "current_offset", "a", 0.0);
    const hci_effect_term *b = term_in(&model.candidates, "current_offset", "b", 0.0);
    const hci_effect_term *c = term_in(&model.candidates, "current_offset", "c", 0.0);
    TEST_ASSERT_DOUBLE_WITHIN(4.0 * hypot(a->std_error, b->std_error), ZERO_A[0] - ZERO_A[1],
                              a->value - b->value);
    TEST_ASSERT_DOUBLE_WITHIN(4.0 * hypot(b->std_error, c->std_error), ZERO_A[1] - ZERO_A[2],
                              b->value - c->value);
    TEST_ASSERT_DOUBLE_WITHIN(0.005, 0.0, a->value + b->value + c->value); /* a star: their sum is read */
}

/* Zeros would make the orders of the fifth harmonic as well. */
static void test_cogging_torque_stays(void)
{
    record_loop(0.0, 0.09);
    TEST_ASSERT_FALSE(is_replaced(1.0));
    TEST_ASSERT_TRUE(model_has("cogging"));
    TEST_ASSERT_FALSE(model_has("current_offset"));
}

static void test_of_order_one_alone(void)
{
    record_loop(1.0, 0.0);
    TEST_ASSERT_FALSE(is_replaced(2.0));
    TEST_ASSERT_TRUE(model_has("cogging"));
}

/* Of the runs without a current alone nothing is said that needs one. */
static void test_not_where_nothing_needs_a_current(void)
{
    record_loop(1.0, 0.0);
    search.no_current = true;
    TEST_ASSERT_FALSE(is_replaced(1.0));
}

static void test_not_of_a_shaft_that_is_held(void)
{
    record_loop(1.0, 0.0);
    run[3].torque_source = HCI_TORQUE_HOLDING;
    TEST_ASSERT_FALSE(is_replaced(1.0));
    TEST_ASSERT_TRUE(model_has("cogging"));
}

/* ---- zeros that were read without a current ---- */

enum { READ_SAMPLES = 1200 }; /* four turns, twelve of them electrical */

/* In the first two runs the drive is off, and the zeros alone are read; in the others they come on top of
 * what flows. The torque is that of what flows, beside cogging torque of order 1. */
static void record_read_zeros(double zeros, double cogging_Nm)
{
    for (int r = 0; r < RUNS; ++r) {
        record(READ_SAMPLES, &(point){r % 2 ? -40.0 : 40.0, 0.0, 0.0, 0.0, 0.0});
        for (size_t k = 0; k < READ_SAMPLES; ++k) {
            const double angle = P * run[r].theta_m_rad[k];
            rec_phases(0.0, IQ_A[r], angle, run[r].i_A + 3 * k);
            for (size_t s = 0; s < 3; ++s) {
                run[r].torque_Nm[k] +=
                    K_NM_PER_A * sin(angle - 2.0 * REF_PI * (double)s / 3.0) * run[r].i_A[3 * k + s];
                run[r].i_A[3 * k + s] += zeros * ZERO_A[s] + 0.02 * ref_normal(&seed);
            }
            run[r].torque_Nm[k] += cogging_Nm * sin(angle + 0.4);
        }
    }
    search_start();
}

/* Whether anything comes in beside the offsets of all phases. */
static bool comes_beside(void)
{
    static const char *const PHASE[3] = {"a", "b", "c"};
    bool changed = false;
    for (int s = 0; s < 3; ++s)
        model_add("current_offset", PHASE[s], NULL, 0.0);
    model_add("back_emf", "sine", "cosine", 5.0);
    model_fit();
    model_fit();
    TEST_ASSERT_EQUAL_INT_MESSAGE(HCI_OK, hci_search_beside_zeros(&search, &model, &changed, &note),
                                  note.text);
    if (changed) model_is_renewed();
    return changed;
}

static double offset_of(const char *phase)
{
    return term_in(&model.candidates, "current_offset", phase, 0.0)->value;
}

/* K sin(angle) times -0.3 A in phase a alone is as much torque as cogging of 0.06 N·m: where the torque says
 * otherwise than the idle runs, it is a torque of its own, and the zeros are those that were read. */
static void test_zeros_stay_as_they_were_read(void)
{
    record_read_zeros(1.0, 0.06);
    TEST_ASSERT_TRUE(dataset.samples.statistics[0].zeros_read && dataset.samples.statistics[1].zeros_read);
    TEST_ASSERT_TRUE(comes_beside());
    TEST_ASSERT_DOUBLE_WITHIN(0.02, ZERO_A[0], offset_of("a"));
    TEST_ASSERT_DOUBLE_WITHIN(0.02, ZERO_A[1], offset_of("b"));
    TEST_ASSERT_DOUBLE_WITHIN(0.02, ZERO_A[2], offset_of("c"));
    const char *effect = model_has("cogging") ? "cogging" : "mechanical_order";
    const hci_effect_term *sine = term_in(&model.candidates, effect, "sine", 1.0);
    const hci_effect_term *cosine = term_in(&model.candidates, effect, "cosine", 1.0);
    TEST_ASSERT_DOUBLE_WITHIN(0.005, 0.06 * cos(0.4), sine->value);
    TEST_ASSERT_DOUBLE_WITHIN(0.005, 0.06 * sin(0.4), cosine->value);
}

static void test_zeros_that_agree_are_all(void)
{
    record_read_zeros(1.0, 0.0);
    TEST_ASSERT_TRUE(dataset.samples.statistics[0].zeros_read);
    TEST_ASSERT_FALSE(comes_beside());
    TEST_ASSERT_FALSE(model_has("cogging") || model_has("mechanical_order"));
}

/* In a loop that runs nothing stands still, and the torque alone tells the zeros. */
static void test_a_loop_that_runs_says_nothing_of_zeros(void)
{
    record_loop(1.0, 0.0);
    TEST_ASSERT_FALSE(dataset.samples.statistics[0].zeros_read);
    TEST_ASSERT_FALSE(comes_beside());
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_currents_flow_where_none_are_read);
    RUN_TEST(test_cogging_torque_stays);
    RUN_TEST(test_of_order_one_alone);
    RUN_TEST(test_not_where_nothing_needs_a_current);
    RUN_TEST(test_not_of_a_shaft_that_is_held);
    RUN_TEST(test_zeros_stay_as_they_were_read);
    RUN_TEST(test_zeros_that_agree_are_all);
    RUN_TEST(test_a_loop_that_runs_says_nothing_of_zeros);
    return UNITY_END();
}
