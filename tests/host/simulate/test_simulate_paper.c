/* The second paper's experiment, and currents of every strategy imposed on its machine. */
/* labels: slow */
/* The speed loop needs most of a second to settle, in hysteresis steps of 2 us. */
#include "hci/host/simulate/simulate.h"
#include "support/simulating.h"

void setUp(void)
{
    drives_start();
}

void tearDown(void)
{
    drives_end();
}

/* ---- the experiment ---- */

/* The shipped scenario with shorter times and twice the step, for a quick test. */
static hci_simulation run_experiment(int strategy)
{
    char path[64];
    hci_scenario s;
    hci_note note = {{0}};
    snprintf(path, sizeof path, "data/drive/filho_strategy_%d.csv", strategy);
    TEST_ASSERT_EQUAL_MESSAGE(HCI_OK, hci_scenario_read(path, &s, &note), note.text);
    s.step_s = 2e-6;
    s.load_torque_2_from_s = 0.2;
    if (strategy > 1) s.strategy_2_from_s = 0.25;
    s.settle_s = strategy > 1 ? 0.55 : 0.75;
    s.duration_s = s.settle_s + 0.38;
    return simulate_into(&machine_c, &s, NULL);
}

/* Tables 2 and 3: mean, maximum, minimum, F_ripple, T_ripple of the torque; mean, rms, maximum, minimum of
 * i_s. */
static const double PAPER[2][9] = {{8.00, 9.32, 6.54, 5.96, 34.79, 6.55, 6.56, 7.29, 5.74},
                                   {8.00, 8.70, 7.36, 2.52, 16.64, 6.70, 6.70, 7.78, 6.13}};

static void print_row(int strategy, const hci_simulation *s)
{
    const double row[9] = {s->torque_Nm.mean,    s->torque_Nm.most,     s->torque_Nm.least,
                           s->F_ripple_percent,  s->T_ripple_percent,   s->current_dqx_A.mean,
                           s->current_dqx_A.rms, s->current_dqx_A.most, s->current_dqx_A.least};
    if (strategy == 1)
        printf("strategy            mean    max    min  F_rip  T_rip | i_s mean    rms    max    min\n");
    for (int paper = 0; paper < (strategy < 3 ? 2 : 1); ++paper) {
        printf("%d %s ", strategy, paper ? "paper    " : "simulated");
        for (int k = 0; k < 9; ++k)
            printf(" %6.2f", paper ? PAPER[strategy - 1][k] : row[k]);
        printf("\n");
    }
}

static hci_simulation experiment(int strategy)
{
    hci_simulation s = run_experiment(strategy);
    print_row(strategy, &s);
    TEST_ASSERT_TRUE(s.periods >= 1);
    TEST_ASSERT_DOUBLE_WITHIN(0.01, 8.0, s.torque_Nm.mean); /* the load, in the steady state */
    TEST_ASSERT_DOUBLE_WITHIN(0.05, 80.0, s.speed_rad_per_s.mean * 30.0 / REF_PI);
    TEST_ASSERT_EQUAL_UINT64(0, s.without_current);
    TEST_ASSERT_TRUE(s.switching_frequency_Hz > 1000.0 && s.switching_frequency_Hz <= 20000.0);
    return s;
}

/* Strategy 1 leaves the machine's own ripple, of which the speed loop takes some, so that the current moves
 * as well. The inertia, which the paper does not give, sets how much and is fitted to T_ripple and i_s: that
 * these are near the paper's (37.0 %, 6.58 A) guards the scenario and confirms nothing. F_ripple, 8.2 %, is
 * not near: this machine's ripple has less of a crest. */
static void test_strategy_1_of_the_paper(void)
{
    hci_simulation s = experiment(1);
    TEST_ASSERT_DOUBLE_WITHIN(2.0, 37.0, s.T_ripple_percent);
    TEST_ASSERT_DOUBLE_WITHIN(0.4, 8.2, s.F_ripple_percent);
    TEST_ASSERT_DOUBLE_WITHIN(0.01 * PAPER[0][5], PAPER[0][5], s.current_dqx_A.mean);
    TEST_ASSERT_DOUBLE_WITHIN(0.01 * PAPER[0][6], PAPER[0][6], s.current_dqx_A.rms);
    TEST_ASSERT_TRUE(s.current_dqx_A.most > 7.3 && s.current_dqx_A.most < 7.8);
    hci_simulation_release(&s);
}

/* Strategies 2 and 3 leave what the band of the current control lets through: e times its error, twice half
 * the band at most in a phase, so that 1.25 N·m/A · 0.1 A · 2 = 0.25 N·m or 3 % peak to peak, somewhat more
 * with L'i in the gain. The paper reports 16.64 % for strategy 2, and does not say what is left there;
 * nothing in this plant makes so much. */
static void test_strategies_2_and_3(void)
{
    hci_simulation two = experiment(2), three = experiment(3);
    TEST_ASSERT_DOUBLE_WITHIN(0.7, 3.5, two.T_ripple_percent);
    TEST_ASSERT_DOUBLE_WITHIN(0.07, 0.60, two.F_ripple_percent);
    TEST_ASSERT_DOUBLE_WITHIN(0.02, 6.635, two.current_dqx_A.mean); /* paper 6.70 */
    TEST_ASSERT_DOUBLE_WITHIN(0.7, 4.0, three.T_ripple_percent);
    TEST_ASSERT_DOUBLE_WITHIN(0.07, 0.70, three.F_ripple_percent);
    TEST_ASSERT_DOUBLE_WITHIN(0.02, 6.023, three.current_dqx_A.mean);
    TEST_ASSERT_TRUE(three.current_dqx_A.mean < two.current_dqx_A.mean);
    TEST_ASSERT_TRUE(three.copper_W < 0.85 * two.copper_W);
    TEST_ASSERT_TRUE(three.F_ripple_percent < 2.0);
    hci_simulation_release(&two);
    hci_simulation_release(&three);
}

/* Strategy 3 at constant speed and torque: nothing but the current control is left to make ripple, and it
 * goes with the band. */
static double rest_of_strategy_3(const char *rows)
{
    char text[512];
    hci_simulation s;
    double ripple;
    snprintf(text, sizeof text,
             "duration,0.4,s\nsettle,0.02,s\nprescribed_speed,80,rpm\ntorque_reference,8,Nm\n%s", rows);
    s = simulate(&machine_c, text);
    ripple = s.T_ripple_percent;
    printf("strategy 3: T_ripple %.4f %%, F_ripple %.4f %%, %.0f Hz\n", ripple, s.F_ripple_percent,
           isnan(s.switching_frequency_Hz) ? 0.0 : s.switching_frequency_Hz);
    TEST_ASSERT_TRUE(s.periods >= 1);
    TEST_ASSERT_DOUBLE_WITHIN(0.02, 8.0, s.torque_Nm.mean);
    hci_simulation_release(&s);
    return ripple;
}

#define FREE "current_control,hysteresis,\nswitching_frequency_max,1000,kHz\nstep,2,us\n"

static void test_the_rest_of_strategy_3_is_the_band(void)
{
    const double wide = rest_of_strategy_3("current_control,hysteresis,\nhysteresis_band,0.1,A\nstep,2,us\n");
    const double free = rest_of_strategy_3(FREE "hysteresis_band,0.1,A\n");
    const double half = rest_of_strategy_3(FREE "hysteresis_band,0.05,A\n");
    const double narrow = rest_of_strategy_3(FREE "hysteresis_band,0.02,A\n");
    const double ideal = rest_of_strategy_3("current_control,ideal,\nstep,20,us\n");
    TEST_ASSERT_TRUE(wide > 3.0 && wide < 5.0);
    TEST_ASSERT_DOUBLE_WITHIN(0.2, wide, free); /* 20 kHz is no restriction at 0.1 A */
    TEST_ASSERT_DOUBLE_WITHIN(0.1, 0.5,
                              half / free); /* in proportion to the band, but for what a step moves */
    TEST_ASSERT_TRUE(half < 2.0);
    TEST_ASSERT_DOUBLE_WITHIN(0.1, 0.25, narrow / free);
    TEST_ASSERT_TRUE(ideal < 1e-9);
}

/* ---- strategies whose currents are imposed ---- */

static void test_imposed_currents_keep_the_promise_of_every_strategy(void)
{
    static const hci_strategy STRATEGY[] = {HCI_STRATEGY_MTPA, HCI_STRATEGY_CANCEL, HCI_STRATEGY_ID0};
    files_write(files_path("target.csv"), "order,amplitude_Nm,phase_rad\n0,8,0\n");
    for (size_t k = 0; k < 3; ++k) {
        hci_solution solution =
            solve(&machine_c, files_path("target.csv"), HCI_METHOD_POINTWISE, STRATEGY[k]);
        assert_promise_is_kept(&machine_c, "duration,0.8,s\nprescribed_speed,80,rpm\nstep,71.3,us\n" TURNED,
                               &solution);
    }
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_strategy_1_of_the_paper);
    RUN_TEST(test_strategies_2_and_3);
    RUN_TEST(test_the_rest_of_strategy_3_is_the_band);
    RUN_TEST(test_imposed_currents_keep_the_promise_of_every_strategy);
    return UNITY_END();
}
