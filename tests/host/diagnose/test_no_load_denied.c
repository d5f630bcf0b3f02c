/* What runs without a current show of a torque over the angle, beside runs under load that are not
 * understood. */
#define _XOPEN_SOURCE 700
#include "host/diagnose/no_load_denied.h"

#include "support/searching.h"

static double order; /* of the cogging torque that is recorded */

static void declare(const char *cogging)
{
    files_write(files_path("cogging.csv"), cogging);
    hci_machine_release(&machine);
    TEST_ASSERT_EQUAL_INT(HCI_OK, hci_machine_read(files_root, &machine, &(hci_note){{0}}));
}

void setUp(void)
{
    order = 6.0;
    dataset_start();
    declare("order,amplitude_Nm,phase_rad\n6,0.1,0\n");
}

void tearDown(void)
{
    dataset_end();
}

/* A cogging torque of so much; under load beside a torque that is another one each time. */
static void record_cogging(const point *x, double cogging_Nm, double lag_rad)
{
    const size_t r = runs.count;
    record(600, x);
    for (size_t k = 0; k < 600; ++k)
        run[r].torque_Nm[k] += cogging_Nm * sin(order * (P * run[r].theta_m_rad[k] - lag_rad));
}

static void record_loads(double cogging_Nm, double lag_rad)
{
    for (int k = 0; k < 4; ++k)
        record_cogging(&(point){k < 2 ? 40.0 : -90.0, k % 2 ? 9.0 : 4.0, 0.0, 0.0, 0.04}, cogging_Nm,
                       lag_rad);
}

static bool words_say(const char *text)
{
    char words[2048];
    hci_diagnosis_words(&diagnosis, words, sizeof words);
    return strstr(words, text) != NULL;
}

/* Without load a sensor with play shows hardly any of the declared cogging torque, and under load all of it.
 */
static void test_denied_under_load(void)
{
    record_cogging(&(point){60.0, 0.0, 0.0, 0.0, 0.0}, 0.02, 0.0);
    record_cogging(&(point){-100.0, 0.0, 0.0, 0.0, 0.0}, 0.02, 0.0);
    record_loads(0.1, 0.0);
    TEST_ASSERT_EQUAL_INT(HCI_NOT_REACHED, diagnose(NULL));
    TEST_ASSERT_EQUAL_INT(HCI_DIAGNOSIS_UNKNOWN, diagnosis.verdict);
    TEST_ASSERT_EQUAL_UINT64(0, diagnosis.effects.list.count);
    TEST_ASSERT_TRUE(words_say("The runs under load deny"));
}

static bool
    is_beside; /* a back-EMF, which runs without load do not show, and another cogging torque that is out */

static void others_add(void)
{
    model_add("back_emf", "sine", "cosine", 5.0);
    model_add("cogging", "sine", "cosine", 12.0);
    for (size_t k = 0; k < model.candidates.count; ++k) {
        hci_candidate *x = &model.candidates.candidate[k];
        x->in = x->term[0].order < 12.0;
        if (x->term[0].order != 6.0) x->term[0].value = x->term[1].value = 0.5;
    }
}

/* What is said of a change of the declared cogging torque of 0.1 sin 6θ, beside runs without load at these
 * speeds, whose ripple it lowers from 0.05 N·m, and one under load. */
static const char *said_with(double sine, double cosine, double speed, double idle_Nm, double loaded_Nm)
{
    static hci_run_errors errors[3];
    const char *why;
    record_cogging(&(point){60.0, 0.0, 0.0, 0.0, 0.0}, 0.1, 0.0);
    record_cogging(&(point){speed, 0.0, 0.0, 0.0, 0.0}, 0.1, 0.0);
    record_cogging(&(point){60.0, 5.0, 0.0, 0.0, 0.0}, 0.1, 0.0);
    search_start();
    model_add("cogging", "sine", "cosine", 6.0);
    model.candidates.candidate[0].term[0].value = sine;
    model.candidates.candidate[0].term[1].value = cosine;
    if (is_beside) others_add();
    for (size_t r = 0; r < 3; ++r)
        errors[r] = (hci_run_errors){.file = run[r].name,
                                     .ripple_before_Nm = 0.05,
                                     .ripple_after_Nm = r < 2 ? idle_Nm : loaded_Nm,
                                     .noise_floor_Nm = 0.01};
    why = hci_no_load_denied(&dataset, &runs, &model.candidates, &(hci_diagnosis){.run = errors, .runs = 3});
    search_end();
    tearDown();
    setUp();
    return why;
}

static const char *said_of(double sine, double cosine, double speed)
{
    return said_with(sine, cosine, speed, 0.05, 0.05);
}

/* A rise by 1 % is little, unless it is much of what falls without load: 0.05² − 0.045² N²·m² to
 * 0.0505² − 0.05². */
static void test_a_small_rise_denies_a_small_torque(void)
{
    TEST_ASSERT_NULL(said_with(0.02, -0.03, 110.0, 0.045, 0.0505));
    TEST_ASSERT_NOT_NULL(said_with(0.02, -0.03, 110.0, 0.0495, 0.0505));
    TEST_ASSERT_NULL(said_with(0.02, -0.03, 110.0, 0.0495, 0.05));
}

/* By more than 2 % it is denied whatever falls without load. */
static void test_a_larger_rise_denies(void)
{
    TEST_ASSERT_NULL(said_with(0.02, -0.03, 110.0, 0.05, 0.0509));
    TEST_ASSERT_NOT_NULL(said_with(0.02, -0.03, 110.0, 0.05, 0.0511));
    TEST_ASSERT_NOT_NULL(said_with(0.02, -0.03, 110.0, 0.052, 0.0511));
}

/* At one speed a sensor that lags shows the declared torque smaller and later; a larger one is none. */
static void test_one_speed_does_not_tell_a_lag(void)
{
    TEST_ASSERT_NOT_NULL(said_of(-0.02, -0.03, -60.0));
    TEST_ASSERT_NULL(said_of(-0.02, -0.03, 110.0));
    TEST_ASSERT_NULL(said_of(0.02, -0.03, -60.0));
    is_beside = true;
    TEST_ASSERT_NOT_NULL(said_of(-0.02, -0.03, -60.0));
    TEST_ASSERT_NULL(said_of(0.02, -0.03, -60.0));
    is_beside = false;
}

/* Of two speeds that show the same, it is cogging. */
static void test_two_speeds_tell_it(void)
{
    record_cogging(&(point){60.0, 0.0, 0.0, 0.0, 0.0}, 0.07, 0.0);
    record_cogging(&(point){-110.0, 0.0, 0.0, 0.0, 0.0}, 0.07, 0.0);
    record_loads(0.07, 0.0);
    TEST_ASSERT_EQUAL_INT(HCI_NOT_REACHED, diagnose(NULL));
    TEST_ASSERT_EQUAL_INT(HCI_FINDING_ADDED, found("cogging")->verdict);
    TEST_ASSERT_FALSE(words_say("deny") || words_say("lags or averages"));
}

/* An order that the machine does not declare is nothing that a sensor makes of another one: it stays,
 * although something else works against it under load. */
static void test_an_order_that_is_not_declared_stays(void)
{
    order = 12.0;
    declare("order,amplitude_Nm,phase_rad\n12,0,0\n");
    record_cogging(&(point){60.0, 0.0, 0.0, 0.0, 0.0}, 0.05, 0.0);
    record_cogging(&(point){-110.0, 0.0, 0.0, 0.0, 0.0}, 0.05, 0.0);
    record_loads(-0.05, 0.0);
    TEST_ASSERT_EQUAL_INT(HCI_NOT_REACHED, diagnose(NULL));
    TEST_ASSERT_EQUAL_INT(HCI_DIAGNOSIS_PARTLY, diagnosis.verdict);
    TEST_ASSERT_EQUAL_INT(HCI_FINDING_ADDED, found("cogging")->verdict);
    TEST_ASSERT_TRUE(words_say("Under load the ripple is larger with it"));
}

/* The same where runs that are held out are worse for it, by mean and ripple. */
static void test_an_order_that_is_not_declared_stays_beside_runs_held_out(void)
{
    order = 12.0;
    declare("order,amplitude_Nm,phase_rad\n12,0,0\n");
    record_cogging(&(point){60.0, 0.0, 0.0, 0.0, 0.0}, 0.05, 0.0);
    record_cogging(&(point){-110.0, 0.0, 0.0, 0.0, 0.0}, 0.05, 0.0);
    record_loads(-0.05, 0.0);
    runs.role[4] = runs.role[5] = HCI_ROLE_HOLDOUT;
    TEST_ASSERT_EQUAL_INT(HCI_NOT_REACHED, diagnose(NULL));
    TEST_ASSERT_EQUAL_INT(HCI_FINDING_ADDED, found("cogging")->verdict);
}

/* At one speed a hum of the mains is an order, of another phase in each run: as much of it under load, and
 * not as without, is none of the angle. */
static void test_a_hum_at_one_speed_leaves(void)
{
    order = 12.0;
    declare("order,amplitude_Nm,phase_rad\n12,0,0\n");
    record_cogging(&(point){60.0, 0.0, 0.0, 0.0, 0.0}, 0.05, 0.0);
    record_cogging(&(point){-60.0, 0.0, 0.0, 0.0, 0.0}, 0.05, 0.0);
    record_loads(-0.05, 0.0);
    TEST_ASSERT_EQUAL_INT(HCI_NOT_REACHED, diagnose(NULL));
    TEST_ASSERT_EQUAL_UINT64(0, diagnosis.effects.list.count);
    TEST_ASSERT_TRUE(words_say("The runs under load deny"));
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_a_hum_at_one_speed_leaves);
    RUN_TEST(test_denied_under_load);
    RUN_TEST(test_a_small_rise_denies_a_small_torque);
    RUN_TEST(test_a_larger_rise_denies);
    RUN_TEST(test_one_speed_does_not_tell_a_lag);
    RUN_TEST(test_two_speeds_tell_it);
    RUN_TEST(test_an_order_that_is_not_declared_stays);
    RUN_TEST(test_an_order_that_is_not_declared_stays_beside_runs_held_out);
    return UNITY_END();
}
