/* Scenarios: units, paths, wrong rows, contradictions, and what of the machine must be known for them. */
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

static void test_units_and_relative_paths(void)
{
    const hci_scenario s =
        scenario_of("duration,250,ms\nspeed_reference,60,rpm\nspeed_ki,200,Nm/rad\ninitial_angle,90,deg\n"
                    "hysteresis_band,100,mA\ncurrents,folder/x.csv,\nseed,3,-\n");
    TEST_ASSERT_EQUAL_DOUBLE(0.25, s.duration_s);
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, 2.0 * REF_PI, s.speed_reference_rad_per_s);
    TEST_ASSERT_EQUAL_DOUBLE(200.0, s.speed_ki_Nm_per_rad);
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, 0.5 * REF_PI, s.initial_angle_rad);
    TEST_ASSERT_DOUBLE_WITHIN(1e-15, 0.1, s.hysteresis_band_A);
    TEST_ASSERT_EQUAL_DOUBLE(3.0, s.seed);
    TEST_ASSERT_EQUAL_STRING(files_path("folder/x.csv"), s.currents);
    TEST_ASSERT_TRUE(isnan(s.step_s));
}

/* Beside the file, also where that is named without a folder; unless the path begins at the root. */
static void test_paths_beside_the_file(void)
{
    static const char *const GIVEN[] = {"folder/x.csv", "/tmp/x.csv"};
    char folder[1024];
    hci_note note = {{0}};
    hci_scenario s;
    TEST_ASSERT_NOT_NULL(getcwd(folder, sizeof folder));
    TEST_ASSERT_EQUAL_INT(0, chdir(files_root));
    for (int k = 0; k < 2; ++k) {
        char text[100];
        snprintf(text, sizeof text, "name,value,unit\ncurrents,%s,\n", GIVEN[k]);
        files_write("scenario.csv", text);
        TEST_ASSERT_EQUAL_MESSAGE(HCI_OK, hci_scenario_read("scenario.csv", &s, &note), note.text);
        TEST_ASSERT_EQUAL_STRING(GIVEN[k], s.currents);
        TEST_ASSERT_EQUAL_STRING(
            k ? "/tmp/x.csv" : files_path("folder/x.csv"),
            scenario_of(k ? "currents,/tmp/x.csv,\n" : "currents,folder/x.csv,\n").currents);
    }
    TEST_ASSERT_EQUAL_INT(0, chdir(folder));
}

static void test_wrong_rows_are_refused(void)
{
    refused(&machine_c, "duratoin,1,s\n",
            "scenario.csv:2: column 1 `name`: found `duratoin`, expected a name that is known here; did "
            "you mean `duration`?");
    refused(&machine_c, "trajectory_evry,1,\n", "did you mean `trajectory_every`?"); /* the last */
    refused(&machine_c, "duration,1,s\nduration,1,s\n", "each name once");
    refused(&machine_c, "strategy,id0,\nstrategy,id0,\n", "each name once");
    refused(&machine_c, "duration,1,A\n", "a unit that converts to s");
    refused(&machine_c, "duration,-1,s\n", "a number from 1e-09 to 1e+06 s");
    refused(&machine_c, "duration,nan,s\n", "found");
    refused(&machine_c, "seed,1.5,\n", "a whole number");
    refused(&machine_c, "strategy,foc,\n", "one of: mtpa, id0, cancel");
    refused(&machine_c, "current_control,pid,\n", "one of: ideal, hysteresis, pi");
    refused(&machine_c, "strategy_2,id0,\n", "`strategy_2_from` go together");
    refused(&machine_c, "strategy_2_from,1,s\n", "go together");
    refused(&machine_c, "currents,x.csv,\nstrategy,id0,\n", "both say what flows");
    refused(&machine_c, "currents,,\n", "delete the row");
}

#define RUNS "duration,0.1,s\nprescribed_speed,80,rpm\n"

static void test_contradictions_are_refused(void)
{
    refused(&machine_c, "prescribed_speed,80,rpm\n", "no `duration`");
    refused(&machine_c, RUNS, "no set point");
    refused(&machine_c, RUNS "speed_reference,80,rpm\n", "`prescribed_speed`");
    refused(&machine_c, RUNS "torque_reference,8,Nm\ninitial_speed,80,rpm\n", "`initial_speed`");
    refused(&machine_c, "duration,1,s\nspeed_reference,80,rpm\ntorque_reference,8,Nm\n", "two set points");
    refused(&machine_c, RUNS "torque_reference,8,Nm\nload_torque_2,1,Nm\n", "`load_torque_2_from`");
    refused(&machine_c, RUNS "torque_reference,8,Nm\nstep,0.2,s\n", "shorter than two steps");
    refused(&machine_c, "duration,1e6,s\nspeed_reference,80,rpm\n", "larger `step`");
    refused(&machine_c, RUNS "torque_reference,8,Nm\nsettle,0.1,s\n", "leaves nothing");
    refused(&machine_c, RUNS "torque_reference,8,Nm\nstep,10,us\ncurrent_sample_time,15,us\n",
            "`current_sample_time`: found 1.5e-05 s");
    refused(&machine_c, RUNS "torque_reference,8,Nm\nstep,10,us\nangle_delay,5,us\n", "`angle_delay`");
    refused(&machine_c, RUNS "currents,none.csv,\n", "none.csv");
    files_write(files_path("waves.csv"), "order,set,amplitude_A,phase_rad\n1,pos,6,0\n");
    refused(&machine_c, RUNS "currents,waves.csv,\ntorque_reference,8,Nm\n",
            "give the folder that `solve` wrote");
    files_write(files_path("waves.csv"), "order,set,amplitude_A,phase_rad\n1.25,pos,6,0\n");
    refused(&machine_c, RUNS "currents,waves.csv,\n", "no multiple of 1/2");
    files_write(files_path("waves.csv"), "order,set,amplitude_A,phase_rad\n3,sym,6,0\n");
    refused(&machine_c, RUNS "currents,waves.csv,\n", "zero-sequence");
}

/* What an ideal current source at a prescribed speed does not feel need not be known; else the row to add is
 * named. */
static void test_missing_values_are_named_where_needed(void)
{
    hci_simulation s = simulate(&machine_a, RUNS "torque_reference,2,Nm\n");
    TEST_ASSERT_DOUBLE_WITHIN(1e-9, 2.0, s.torque_Nm.mean);
    TEST_ASSERT_TRUE(isnan(s.copper_W) && isnan(s.energy_J.stored));
    hci_simulation_release(&s);
    refused(&machine_a, "duration,1,s\nspeed_reference,80,rpm\n", "no `inertia`");
    refused(
        &machine_a, RUNS "torque_reference,2,Nm\ncurrent_control,pi,\n",
        "add `resistance,VALUE,ohm,SOURCE`, `inductance_d,VALUE,H,SOURCE`, `inductance_q,VALUE,H,SOURCE`");
    machine_a.inductance_d_H = 2e-3;
    refused(&machine_a, RUNS "torque_reference,2,Nm\ncurrent_control,pi,\n", "`inductance_q,VALUE,H,SOURCE`");
    machine_a.inductance_q_H = 2e-3;
    refused(&machine_a, RUNS "torque_reference,2,Nm\ncurrent_control,pi,\n", "`resistance,VALUE,ohm,SOURCE`");
    machine_a.resistance_ohm = 0.1;
    refused(&machine_a, RUNS "torque_reference,2,Nm\ncurrent_control,pi,\n",
            "`dc_link_voltage,VALUE,V,SOURCE`");
    machine_a.rated_current_A = NAN;
    refused(&machine_a, RUNS "torque_reference,2,Nm\ncurrent_control,hysteresis,\ndc_link_voltage,48,V\n",
            "`hysteresis_band,VALUE,A`");
    s = simulate(&machine_a, RUNS "torque_reference,2,Nm\ncurrent_control,pi,\ndc_link_voltage,48,V\n");
    hci_simulation_release(&s);
    machine_a.inductance_d_H = 0.0;
    refused(&machine_a, RUNS "torque_reference,2,Nm\ncurrent_control,pi,\ndc_link_voltage,48,V\n",
            "not positive definite");
    machine_c.has_neutral = true;
    refused(&machine_c, RUNS "torque_reference,2,Nm\n", "star-neutral");
}

/* Slopes of the inductances are enough for ideal currents, and give the same torque as the inductances do. */
static void test_slopes_alone_do_for_ideal_currents(void)
{
    hci_simulation whole = simulate(&machine_c, RUNS "torque_reference,8,Nm\nstrategy,id0,\n"), slopes;
    hci_inductance *kept = machine_c.inductance;
    machine_c.inductance = NULL;
    machine_c.inductance_count = 0;
    slopes = simulate(&machine_c, RUNS "torque_reference,8,Nm\nstrategy,id0,\n");
    refused(&machine_c, RUNS "torque_reference,8,Nm\ncurrent_control,pi,\n", "slopes only");
    machine_c.inductance = kept;
    TEST_ASSERT_DOUBLE_WITHIN(1e-6, whole.torque_Nm.mean, slopes.torque_Nm.mean);
    TEST_ASSERT_DOUBLE_WITHIN(1e-6, whole.T_ripple_percent, slopes.T_ripple_percent);
    TEST_ASSERT_TRUE(isnan(slopes.energy_J.stored));
    hci_simulation_release(&whole);
    hci_simulation_release(&slopes);
}

/* B h/J = 100, far outside what the method can follow. */
static void test_a_step_that_is_too_large_is_said(void)
{
    const hci_scenario scenario =
        scenario_of("duration,10,s\ntorque_reference,8,Nm\nviscous_friction,1000,\nstep,1,ms\n");
    const hci_simulate_options options = {0};
    const hci_simulate_output where = {files_path("out"), NULL};
    hci_simulation s;
    hci_note note = {{0}};
    TEST_ASSERT_EQUAL_INT(HCI_ERROR_NUMERIC,
                          hci_simulate_to_folder(&machine_c, &scenario, &options, &where, &s, &note));
    TEST_ASSERT_NOT_NULL(strstr(note.text, "smaller `step`"));
    TEST_ASSERT_TRUE(files_count(files_path("out")) <= 0);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_units_and_relative_paths);
    RUN_TEST(test_paths_beside_the_file);
    RUN_TEST(test_wrong_rows_are_refused);
    RUN_TEST(test_contradictions_are_refused);
    RUN_TEST(test_missing_values_are_named_where_needed);
    RUN_TEST(test_slopes_alone_do_for_ideal_currents);
    RUN_TEST(test_a_step_that_is_too_large_is_said);
    return UNITY_END();
}
