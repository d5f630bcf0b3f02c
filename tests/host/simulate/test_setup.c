/* What a scenario and a machine make of a drive, number by number: each row that a scenario may have, and
 * what holds without it; limits from both sides. */
#include <stddef.h>

#include "hci/host/simulate/simulate.h"
#include "host/simulate/simulation.h"
#include "support/simulating.h"
#include "support/texts.h"

static hci_machine_data machine;
static hci_setup setup;
static hci_note note;

/* p = 3, K_e 0.2, R = 0.5 ohm, L_d = 3 mH, L_q = 5 mH. */
static void make_machine(const char *more)
{
    char text[800];
    snprintf(text, sizeof text,
             "name,value,unit,source\npole_pairs,3,1,t\nresistance,0.5,ohm,t\ninductance_d,3,mH,t\n"
             "inductance_q,5,mH,t\ndc_link_voltage,48,V,t\nrated_current,7,A,t\nrated_torque,1.5,Nm,t\n%s",
             more);
    files_write(files_path("machine.csv"), text);
    files_write(files_path("back_emf.csv"), "order,amplitude_Nm_per_A,phase_rad\n1,0.2,0\n");
    hci_machine_release(&machine);
    TEST_ASSERT_EQUAL_MESSAGE(HCI_OK, hci_machine_read(files_root, &machine, &note), note.text);
}

#define SHAFT "inertia,2e-4,kgm2,t\nviscous_friction,3e-3,Nms_per_rad,t\ncoulomb_friction,0.04,Nm,t\n"

void setUp(void)
{
    drives_start();
    memset(&note, 0, sizeof note);
    make_machine(SHAFT);
}

void tearDown(void)
{
    hci_memory_fail_after(-1);
    hci_setup_release(&setup);
    memset(&setup, 0, sizeof setup);
    hci_machine_release(&machine);
    memset(&machine, 0, sizeof machine);
    drives_end();
}

static hci_status set(const char *rows)
{
    const hci_scenario s = scenario_of(rows);
    const hci_simulate_options options = {0};
    hci_setup_release(&setup);
    memset(&note, 0, sizeof note);
    return hci_setup_make(&machine, &options, &s, &setup, &note);
}

/* One of the three ways to control currents. */
#define IDEAL  "duration,100,ms\ncurrent_control,ideal,\ntorque_reference,1,Nm\n"
#define PI     "duration,100,ms\ncurrent_control,pi,\ntorque_reference,1,Nm\n"
#define HYST   "duration,100,ms\ncurrent_control,hysteresis,\ntorque_reference,1,Nm\n"
#define SPEED  "duration,100,ms\ncurrent_control,pi,\nspeed_reference,20,rad_per_s\n"
#define STEADY "prescribed_speed,-25,rad_per_s\n"

#define TURN 6.28318530717958647693

#define OF(field) offsetof(hci_setup, field)
#define C         drive.control.

static const struct {
    const char *rows;
    size_t at;
    double value;
} NUMBER[] = {
    {IDEAL, OF(C torque_limit_Nm), HUGE_VAL},
    {IDEAL, OF(set_point), 1.0},
    {IDEAL, OF(load_Nm), 0.0},
    {IDEAL "load_torque,0.3,Nm\n", OF(load_Nm), 0.3},
    {IDEAL "load_torque_2,0.7,Nm\nload_torque_2_from,20,ms\n", OF(load_2_Nm), 0.7},
    {IDEAL "load_torque_2,0.7,Nm\nload_torque_2_from,20,ms\n", OF(load_2_from_s), 0.02},
    {IDEAL, OF(load_2_from_s), HUGE_VAL},
    {IDEAL, OF(load_2_Nm), 0.0},
    {SPEED, OF(set_point), 20.0},
    {IDEAL, OF(C step_s), 1e-5},
    {IDEAL STEADY, OF(C step_s), TURN / (3.0 * 25.0 * 2048.0)},
    {HYST, OF(C step_s), 1e-6},
    {HYST STEADY, OF(C step_s), 1e-6},
    {PI, OF(C step_s), 1e-5},
    {PI "current_sample_time,50,us\n", OF(C step_s), 5e-6},
    {PI "step,30,us\n", OF(C step_s), 25e-6},
    {PI "step,50,us\n", OF(C step_s), 50e-6},
    {IDEAL "step,30,us\n", OF(C step_s), 30e-6},
    {IDEAL, OF(settle_s), 0.05},
    {IDEAL STEADY, OF(settle_s), 0.0},
    {PI STEADY, OF(settle_s), 0.05},
    {IDEAL "strategy_2,cancel,\nstrategy_2_from,40,ms\n", OF(settle_s), 0.07},
    {IDEAL STEADY "strategy_2,cancel,\nstrategy_2_from,40,ms\n", OF(settle_s), 0.04},
    {IDEAL "load_torque_2,0.7,Nm\nload_torque_2_from,20,ms\n", OF(settle_s), 0.06},
    {IDEAL "settle,33,ms\n", OF(settle_s), 0.033},
    {IDEAL "strategy_2,cancel,\nstrategy_2_from,40,ms\n", OF(source[1].from_s), 0.04},
    /* control */
    {IDEAL, OF(C id_limit), HUGE_VAL},
    {IDEAL, OF(C iq_limit), HUGE_VAL},
    {IDEAL, OF(C peak_limit_A), HUGE_VAL},
    {IDEAL "id_limit,2,A\niq_limit,3,A\ncurrent_limit,4,A\n", OF(C id_limit), 2.0},
    {IDEAL "id_limit,2,A\niq_limit,3,A\ncurrent_limit,4,A\n", OF(C iq_limit), 3.0},
    {IDEAL "id_limit,2,A\niq_limit,3,A\ncurrent_limit,4,A\n", OF(C peak_limit_A), 4.0},
    {SPEED, OF(C torque_limit_Nm), 3.0},
    {SPEED "torque_limit,1.2,Nm\n", OF(C torque_limit_Nm), 1.2},
    {IDEAL "torque_limit,1.2,Nm\n", OF(C torque_limit_Nm), 1.2},
    {SPEED, OF(C speed.proportional), 30.0 * 2e-4},
    {SPEED, OF(C speed.integral_per_s), 7.5 * 30.0 * 2e-4},
    {SPEED "speed_kp,0.02,Nms_per_rad\n", OF(C speed.proportional), 0.02},
    {SPEED "speed_kp,0.02,Nms_per_rad\n", OF(C speed.integral_per_s), 0.15},
    {SPEED "speed_ki,0.4,Nm/rad\n", OF(C speed.integral_per_s), 0.4},
    {IDEAL, OF(C speed.proportional), 0.0},
    {PI, OF(C dc_link_V), 48.0},
    {PI "dc_link_voltage,60,V\n", OF(C dc_link_V), 60.0},
    {IDEAL, OF(C dc_link_V), 0.0},
    {PI, OF(C current.pi[0].proportional), 0.2 / 1e-4 * 4e-3},
    {PI, OF(C current.pi[1].proportional), 0.2 / 1e-4 * 4e-3},
    {PI, OF(C current.pi[0].integral_per_s), 0.2 / 1e-4 * 0.5},
    {PI, OF(C current.pi[1].integral_per_s), 0.2 / 1e-4 * 0.5},
    {PI "current_sample_time,50,us\n", OF(C current.pi[0].proportional), 0.2 / 5e-5 * 4e-3},
    {PI "current_kp,3,ohm\ncurrent_ki,70,V/(A*s)\n", OF(C current.pi[1].proportional), 3.0},
    {PI "current_kp,3,ohm\ncurrent_ki,70,V/(A*s)\n", OF(C current.pi[1].integral_per_s), 70.0},
    {PI "current_kp,3,ohm\ncurrent_kp_q,4,ohm\n", OF(C current.pi[0].proportional), 3.0},
    {PI "current_kp,3,ohm\ncurrent_kp_q,4,ohm\n", OF(C current.pi[1].proportional), 4.0},
    {PI "current_ki,70,V/(A*s)\ncurrent_ki_q,90,V/(A*s)\n", OF(C current.pi[0].integral_per_s), 70.0},
    {PI "current_ki,70,V/(A*s)\ncurrent_ki_q,90,V/(A*s)\n", OF(C current.pi[1].integral_per_s), 90.0},
    {PI, OF(C current.filter), 0.0},
    {PI "current_filter_time,200,us\n", OF(C current.filter), 0.39346934028736658},
    {PI "dead_time,2,us\n", OF(drive.dead_time.voltage_V), 48.0 * 2e-6 / 1e-4},
    {PI "dead_time,2,us\ndead_time_crossing,0.3,A\n", OF(drive.dead_time.crossing_A), 0.3},
    {PI "dead_time,2,us\n", OF(C current.dead_time.voltage_V), 0.0},
    {PI "dead_time,2,us\ndead_time_compensation,1,\n", OF(C current.dead_time.voltage_V), 48.0 * 2e-6 / 1e-4},
    {HYST, OF(C hysteresis.band_A), 0.14},
    {HYST "hysteresis_band,0.2,A\n", OF(C hysteresis.band_A), 0.2},
    /* shaft */
    {IDEAL, OF(drive.plant.inertia_kgm2), 2e-4},
    {IDEAL "inertia,5e-4,kgm2\n", OF(drive.plant.inertia_kgm2), 5e-4},
    {IDEAL STEADY, OF(drive.plant.inertia_kgm2), HUGE_VAL},
    {IDEAL, OF(drive.plant.viscous_Nms), 3e-3},
    {IDEAL "viscous_friction,4e-3,Nms_per_rad\n", OF(drive.plant.viscous_Nms), 4e-3},
    {IDEAL STEADY, OF(drive.plant.viscous_Nms), 0.0},
    {IDEAL, OF(drive.plant.coulomb_Nm), 0.04},
    {IDEAL "coulomb_friction,0.06,Nm\n", OF(drive.plant.coulomb_Nm), 0.06},
    {IDEAL STEADY, OF(drive.plant.coulomb_Nm), 0.0},
    {IDEAL, OF(drive.plant.resistance_ohm), 0.5},
    {IDEAL, OF(state.plant.speed_rad_per_s), 0.0},
    {IDEAL "initial_speed,12,rad_per_s\n", OF(state.plant.speed_rad_per_s), 12.0},
    {IDEAL STEADY, OF(state.plant.speed_rad_per_s), -25.0},
    {IDEAL "initial_angle,0.6,rad\n", OF(state.plant.theta_m_rad), 0.2},
    {IDEAL "initial_angle,-0.6,rad\n", OF(state.plant.theta_m_rad), TURN - 0.2},
    {IDEAL "initial_angle,21,rad\n", OF(state.plant.theta_m_rad), 7.0 - TURN},
    /* sensors */
    {IDEAL "current_offset_a,0.1,A\ncurrent_offset_b,0.2,A\ncurrent_offset_c,0.3,A\n", OF(sensor[1].offset),
     0.2},
    {IDEAL "current_offset_a,0.1,A\ncurrent_offset_b,0.2,A\ncurrent_offset_c,0.3,A\n", OF(sensor[2].offset),
     0.3},
    {IDEAL "current_offset_a,0.1,A\n", OF(sensor[0].offset), 0.1},
    {IDEAL "current_gain_a,0.01,\ncurrent_gain_b,0.02,\n", OF(sensor[0].gain_error), 0.01},
    {IDEAL "current_gain_a,0.01,\ncurrent_gain_b,0.02,\n", OF(sensor[1].gain_error), 0.02},
    {IDEAL "current_gain_c,0.03,\n", OF(sensor[2].gain_error), 0.03},
    {IDEAL "current_noise,0.05,A\n", OF(sensor[0].noise), 0.05},
    {IDEAL "current_noise,0.05,A\n", OF(sensor[2].noise), 0.05},
    {IDEAL "current_noise,0.05,A\n", OF(sensor[HCI_SENSE_ANGLE].noise), 0.0},
    {IDEAL "current_quantum,0.02,A\n", OF(sensor[2].quantum), 0.02},
    {IDEAL "angle_offset,0.06,rad\n", OF(sensor[HCI_SENSE_ANGLE].offset), 0.02},
    {IDEAL "angle_noise,0.03,rad\n", OF(sensor[HCI_SENSE_ANGLE].noise), 0.01},
    {IDEAL "encoder_counts,600,\n", OF(sensor[HCI_SENSE_ANGLE].quantum), TURN / 600.0},
    {IDEAL, OF(sensor[HCI_SENSE_ANGLE].quantum), 0.0},
    {IDEAL "speed_noise,0.5,rad_per_s\n", OF(sensor[HCI_SENSE_SPEED].noise), 0.5},
    {IDEAL "torque_noise,0.07,Nm\n", OF(sensor[HCI_SENSE_TORQUE].noise), 0.07},
    {IDEAL, OF(inductance.d_H), 4e-3 - 1e-3},
    {IDEAL, OF(inductance.q_H), 5e-3},
};

static void test_numbers(void)
{
    for (size_t k = 0; k < sizeof NUMBER / sizeof NUMBER[0]; ++k) {
        double found;
        TEST_ASSERT_EQUAL_MESSAGE(HCI_OK, set(NUMBER[k].rows), note.text);
        memcpy(&found, (const char *)&setup + NUMBER[k].at, sizeof found);
        const double value = NUMBER[k].value;
        TEST_ASSERT_EQUAL_MESSAGE(isinf(value), isinf(found), NUMBER[k].rows);
        if (isfinite(value))
            TEST_ASSERT_DOUBLE_WITHIN_MESSAGE(1e-9 * fabs(value) + 1e-15, value, found, NUMBER[k].rows);
    }
}

/* ---- steps ---- */

typedef struct {
    const char *rows;
    size_t steps, every, current_every, speed_every, delay_steps;
} counts;

static void test_counts_of_steps(void)
{
    static const counts CASE[] = {
        {IDEAL, 10000, 1, 1, 10, 0},
        {IDEAL "step,1,us\n", 100000, 5, 1, 100, 0},
        {IDEAL "step,1,us\ntrajectory_every,7,\n", 100000, 7, 1, 100, 0},
        {IDEAL "step,4.99,us\n", 20041, 2, 1, 20, 0},
        {IDEAL "step,5,us\n", 20000, 1, 1, 20, 0},
        {IDEAL "step,7,us\n", 14286, 1, 1, 14, 0},
        {IDEAL "step,1,ms\n", 100, 1, 1, 1, 0},
        {IDEAL "current_sample_time,80,us\n", 10000, 1, 8, 10, 0},
        {IDEAL "speed_sample_time,250,us\n", 10000, 1, 1, 25, 0},
        {PI, 10000, 1, 10, 10, 10},
        {PI "pwm_delay,0,\n", 10000, 1, 10, 10, 0},
        {PI "computing_delay,30,us\n", 10000, 1, 10, 10, 3},
        {PI "computing_delay,100,us\n", 10000, 1, 10, 10, 10},
        {PI "computing_delay,0,us\n", 10000, 1, 10, 10, 0},
        {PI "current_sample_time,200,us\n", 5000, 1, 10, 5, 10},
    };
    for (size_t k = 0; k < sizeof CASE / sizeof CASE[0]; ++k) {
        TEST_ASSERT_EQUAL_MESSAGE(HCI_OK, set(CASE[k].rows), note.text);
        TEST_ASSERT_EQUAL_MESSAGE(CASE[k].steps, setup.steps, CASE[k].rows);
        TEST_ASSERT_EQUAL_MESSAGE(CASE[k].every, setup.every, CASE[k].rows);
        TEST_ASSERT_EQUAL_MESSAGE(CASE[k].current_every, setup.drive.control.current_every, CASE[k].rows);
        TEST_ASSERT_EQUAL_MESSAGE(CASE[k].speed_every, setup.drive.control.speed_every, CASE[k].rows);
        TEST_ASSERT_EQUAL_MESSAGE(CASE[k].delay_steps, setup.drive.control.current.delay_steps, CASE[k].rows);
    }
}

/* Which sensor a delay is of, and its memory; sensors that are ideal are none. */
static void test_delays_of_sensors(void)
{
    static const struct {
        const char *row;
        int first, last;
    } CASE[] = {{"current_delay", HCI_SENSE_IA, HCI_SENSE_IA + 2},
                {"angle_delay", HCI_SENSE_ANGLE, HCI_SENSE_ANGLE},
                {"speed_delay", HCI_SENSE_SPEED, HCI_SENSE_SPEED},
                {"torque_delay", HCI_SENSE_TORQUE, HCI_SENSE_TORQUE}};
    for (size_t k = 0; k < sizeof CASE / sizeof CASE[0]; ++k) {
        char rows[200];
        snprintf(rows, sizeof rows, IDEAL "%s,40,us\n", CASE[k].row);
        TEST_ASSERT_EQUAL_MESSAGE(HCI_OK, set(rows), note.text);
        TEST_ASSERT_EQUAL_PTR(setup.sensor, setup.drive.sensors);
        for (int j = 0; j < HCI_SENSE_COUNT; ++j) {
            const bool is_late = j >= CASE[k].first && j <= CASE[k].last;
            TEST_ASSERT_EQUAL(is_late ? 4 : 0, setup.sensor[j].delay_steps);
            TEST_ASSERT_EQUAL(is_late, setup.ring[j] != NULL);
        }
        snprintf(rows, sizeof rows, IDEAL "%s,44,us\n", CASE[k].row);
        TEST_ASSERT_EQUAL(HCI_ERROR_INPUT, set(rows));
        text_has(CASE[k].row, note.text);
    }
    TEST_ASSERT_EQUAL(HCI_OK, set(IDEAL));
    TEST_ASSERT_NULL(setup.drive.sensors);
    static const char *const NOT_IDEAL[] = {"current_offset_b,0.1,A\n", "current_gain_a,0.1,\n",
                                            "speed_noise,0.1,rad_per_s\n", "current_quantum,0.1,A\n"};
    for (size_t k = 0; k < sizeof NOT_IDEAL / sizeof NOT_IDEAL[0]; ++k) {
        char rows[200];
        snprintf(rows, sizeof rows, IDEAL "%s", NOT_IDEAL[k]);
        TEST_ASSERT_EQUAL_MESSAGE(HCI_OK, set(rows), note.text);
        TEST_ASSERT_EQUAL_PTR(setup.sensor, setup.drive.sensors);
    }
}

static void test_what_is_so_or_not(void)
{
    TEST_ASSERT_EQUAL(HCI_OK, set(IDEAL "seed,5,\nhighest_order,37,\nmagnet_temperature,60,C\n"));
    TEST_ASSERT_EQUAL(5, setup.seed);
    TEST_ASSERT_EQUAL(37, setup.highest_order);
    TEST_ASSERT_FALSE(setup.prescribed || setup.drive.control.speed_controlled);
    TEST_ASSERT_TRUE(setup.has_command && setup.has_inductance);
    TEST_ASSERT_EQUAL(1, setup.drive.control.source_count);
    TEST_ASSERT_EQUAL(1, setup.period_turns);
    TEST_ASSERT_EQUAL(HCI_OK, set(SPEED "strategy,mtpa,\nstrategy_2,id0,\nstrategy_2_from,30,ms\n"));
    TEST_ASSERT_EQUAL(1, setup.seed);
    TEST_ASSERT_EQUAL(60, setup.highest_order);
    TEST_ASSERT_TRUE(setup.drive.control.speed_controlled && setup.has_command);
    TEST_ASSERT_EQUAL(2, setup.drive.control.source_count);
    TEST_ASSERT_EQUAL(HCI_STRATEGY_ID0, setup.source[1].strategy);
    TEST_ASSERT_TRUE(setup.source[0].strategy != HCI_STRATEGY_ID0);
    TEST_ASSERT_TRUE(setup.drive.control.current.decoupled);
    TEST_ASSERT_EQUAL(HCI_MODULATION_SPACE_VECTOR, setup.drive.control.current.modulation);
    TEST_ASSERT_EQUAL(HCI_OK, set(PI STEADY "decoupling,0,\n"));
    TEST_ASSERT_TRUE(setup.prescribed);
    TEST_ASSERT_FALSE(setup.drive.control.current.decoupled);
    TEST_ASSERT_EQUAL(HCI_OK, set(IDEAL "encoder_counts,600,\n"));
    TEST_ASSERT_EQUAL(1, setup.period_turns);
    TEST_ASSERT_EQUAL(HCI_OK, set(IDEAL "encoder_counts,1000,\n")); /* no whole number in a third of a turn */
    TEST_ASSERT_EQUAL(3, setup.period_turns);
    TEST_ASSERT_EQUAL(HCI_OK, set(HYST "switching_frequency_max,10,kHz\n"));
    TEST_ASSERT_EQUAL(50, setup.drive.control.hysteresis.hold_steps);
}

/* ---- what is refused, and just not ---- */

static void test_limits_of_what_may_be_asked(void)
{
    static const struct {
        const char *good, *bad, *words;
    } CASE[] = {
        {IDEAL, "current_control,ideal,\ntorque_reference,1,Nm\n", "no `duration`"},
        {IDEAL STEADY, SPEED STEADY, "`prescribed_speed` leaves a speed loop nothing to do"},
        {IDEAL STEADY, IDEAL STEADY "initial_speed,1,rad_per_s\n", "delete `initial_speed`"},
        {SPEED, SPEED "torque_reference,1,Nm\n", "two set points"},
        {IDEAL, "duration,1,s\ncurrent_control,ideal,\n", "no set point"},
        {IDEAL "load_torque_2,0.7,Nm\nload_torque_2_from,20,ms\n", IDEAL "load_torque_2,0.7,Nm\n",
         "go together"},
        {IDEAL, IDEAL "load_torque_2_from,20,ms\n", "go together"},
        {IDEAL "step,50,ms\nsettle,0,s\n", IDEAL "step,101,ms\nsettle,0,s\n",
         "shorter than two steps of 0.101 s"},
        {IDEAL "step,10,ms\nsettle,80,ms\n", IDEAL "step,10,ms\nsettle,80.1,ms\n",
         "leaves nothing of `duration`"},
        {"duration,3.99,s\ntorque_reference,1,Nm\nstep,1e-9,s\n",
         "duration,4.01,s\ntorque_reference,1,Nm\nstep,1e-9,s\n",
         "has 4.01e+09 steps of 1e-09 s; give a larger `step`"},
        {PI "dead_time,49.9,us\n", PI "dead_time,50,us\n",
         "expected less than half of `current_sample_time`, which is 0.0001"},
        {PI "computing_delay,100,us\n", PI "computing_delay,110,us\n",
         "expected at most `current_sample_time`"},
        {PI, PI "computing_delay,15,us\n", "expected a whole number of steps of 1e-05 s"},
        {IDEAL "speed_sample_time,20,us\n", IDEAL "speed_sample_time,25,us\n",
         "`speed_sample_time`: found 2.5e-05 s"},
        {IDEAL "speed_sample_time,10,us\n", IDEAL "speed_sample_time,1,us\n", "`speed_sample_time`"},
    };
    for (size_t k = 0; k < sizeof CASE / sizeof CASE[0]; ++k) {
        TEST_ASSERT_EQUAL_MESSAGE(HCI_OK, set(CASE[k].good), note.text);
        TEST_ASSERT_EQUAL_MESSAGE(HCI_ERROR_INPUT, set(CASE[k].bad), CASE[k].bad);
        text_has(CASE[k].words, note.text);
        text_has("scenario.csv: ", note.text);
    }
}

static void test_what_the_machine_needs(void)
{
    make_machine("");
    TEST_ASSERT_EQUAL(HCI_ERROR_INPUT, set(IDEAL));
    text_has("machine.csv: no `inertia`, which a rotor that turns freely needs", note.text);
    TEST_ASSERT_EQUAL(HCI_OK, set(IDEAL STEADY));
    TEST_ASSERT_EQUAL(HCI_OK, set(IDEAL "inertia,1e-4,kgm2\n"));
    TEST_ASSERT_EQUAL_DOUBLE(0.0, setup.drive.plant.viscous_Nms);
    TEST_ASSERT_EQUAL_DOUBLE(0.0, setup.drive.plant.coulomb_Nm);
    machine.inertia_kgm2 = 0.0;
    TEST_ASSERT_EQUAL(HCI_ERROR_INPUT, set(IDEAL));
    text_has("expected `inertia` above zero", note.text);
    machine.inertia_kgm2 = 1e-4;
    machine.coulomb_friction_Nm = -1e-9;
    TEST_ASSERT_EQUAL(HCI_ERROR_INPUT, set(IDEAL));
    machine.coulomb_friction_Nm = 0.0;
    machine.viscous_friction_Nms_per_rad = -1e-9;
    TEST_ASSERT_EQUAL(HCI_ERROR_INPUT, set(IDEAL));
    machine.viscous_friction_Nms_per_rad = 0.0;
    machine.resistance_ohm = -0.1;
    TEST_ASSERT_EQUAL(HCI_ERROR_INPUT, set(IDEAL));
    text_has("expected `resistance` of zero or more", note.text);
    machine.resistance_ohm = NAN;
    TEST_ASSERT_EQUAL(HCI_OK, set(IDEAL));
    TEST_ASSERT_EQUAL(HCI_ERROR_INPUT, set(PI));
    text_has("add `resistance,VALUE,ohm,SOURCE`", note.text);
    text_lacks("inductance_d,VALUE", note.text);
    machine.resistance_ohm = 0.0;
    machine.rated_torque_Nm = NAN;
    TEST_ASSERT_EQUAL(HCI_OK, set(SPEED));
    TEST_ASSERT_TRUE(isinf(setup.drive.control.torque_limit_Nm));
    machine.rated_current_A = NAN;
    TEST_ASSERT_EQUAL(HCI_ERROR_INPUT, set(HYST));
    text_has("no `hysteresis_band`", note.text);
    machine.dc_link_voltage_V = NAN;
    TEST_ASSERT_EQUAL(HCI_ERROR_INPUT, set(PI));
    text_has("dc_link_voltage", note.text);
    machine.dc_link_voltage_V = 0.0;
    TEST_ASSERT_EQUAL(HCI_ERROR_INPUT, set(PI));
    text_has("expected `dc_link_voltage` above zero", note.text);
    machine.has_effects = true;
    TEST_ASSERT_EQUAL(HCI_ERROR_INPUT, set(IDEAL));
    text_has("the machine has effects", note.text);
    machine.has_effects = false;
    machine.has_neutral = true;
    TEST_ASSERT_EQUAL(HCI_ERROR_INPUT, set(IDEAL));
    text_has("star-neutral", note.text);
}

/* What differs along d and q is said, to 1e-9; imposed currents do without, and one alone is none. */
static void test_inductances(void)
{
    TEST_ASSERT_EQUAL(HCI_OK, set(IDEAL));
    text_has("inductance_d and inductance_q differ, and the reluctance torque that follows is in",
             setup.remark.text);
    machine.inductance_d_H = machine.inductance_q_H * (1.0 + 0.9e-9);
    TEST_ASSERT_EQUAL(HCI_OK, set(IDEAL));
    TEST_ASSERT_EQUAL_STRING("", setup.remark.text);
    machine.inductance_d_H = machine.inductance_q_H * (1.0 + 1.2e-9);
    TEST_ASSERT_EQUAL(HCI_OK, set(IDEAL));
    text_has("differ", setup.remark.text);
    machine.inductance_d_H = NAN;
    TEST_ASSERT_EQUAL(HCI_ERROR_INPUT, set(IDEAL));
    text_has("no `inductance_d`, which the change of currents needs; add a row `inductance_d,VALUE,H,SOURCE`",
             note.text);
    TEST_ASSERT_EQUAL(HCI_ERROR_INPUT, set(PI));
    text_has("add `inductance_d,VALUE,H,SOURCE`", note.text);
    machine.inductance_d_H = machine.inductance_q_H;
    machine.inductance_q_H = NAN;
    TEST_ASSERT_EQUAL(HCI_ERROR_INPUT, set(IDEAL));
    text_has("no `inductance_q`", note.text);
    machine.inductance_d_H = NAN;
    TEST_ASSERT_EQUAL(HCI_OK, set(IDEAL));
    TEST_ASSERT_FALSE(setup.has_inductance);
    TEST_ASSERT_EQUAL_DOUBLE(1e-3, setup.inductance.d_H);
    TEST_ASSERT_EQUAL_DOUBLE(1e-3, setup.inductance.q_H);
    TEST_ASSERT_EQUAL(HCI_ERROR_INPUT, set(HYST));
    text_has("add `inductance_d,VALUE,H,SOURCE`, `inductance_q,VALUE,H,SOURCE`", note.text);
    machine.inductance_d_H = machine.inductance_q_H = -1e-3;
    TEST_ASSERT_EQUAL(HCI_ERROR_INPUT, set(IDEAL));
    text_has("not positive definite", note.text);
}

/* The loop without more said is stable; with gains that are ten times as large it is not, and that is said.
 */
static void test_a_loop_that_is_not_stable(void)
{
    machine.inductance_d_H = machine.inductance_q_H;
    TEST_ASSERT_EQUAL(HCI_OK, set(PI));
    TEST_ASSERT_EQUAL_STRING("", setup.remark.text);
    TEST_ASSERT_EQUAL(HCI_OK, set(PI "current_kp,100,ohm\ncurrent_ki,300,V/(A*s)\n"));
    text_has("the current loop is not stable with a k_p of 100 V/A and a k_i of 300 V/(A*s): largest pole",
             setup.remark.text);
    TEST_ASSERT_EQUAL(HCI_OK,
                      set(PI "current_kp,37,ohm\npwm_delay,0,\n")); /* one with less delay bears more */
    TEST_ASSERT_EQUAL_STRING("", setup.remark.text);
    TEST_ASSERT_EQUAL(HCI_OK, set(PI "current_kp,55,ohm\n"));
    text_has("not stable", setup.remark.text);
}

static void test_without_memory(void)
{
    const hci_scenario s = scenario_of(PI "angle_delay,40,us\n");
    const hci_simulate_options options = {0};
    for (long k = 0; k < 40; ++k) {
        hci_setup_release(&setup);
        memset(&note, 0, sizeof note);
        hci_memory_fail_after(k);
        const hci_status status = hci_setup_make(&machine, &options, &s, &setup, &note);
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
    RUN_TEST(test_numbers);
    RUN_TEST(test_counts_of_steps);
    RUN_TEST(test_delays_of_sensors);
    RUN_TEST(test_what_is_so_or_not);
    RUN_TEST(test_limits_of_what_may_be_asked);
    RUN_TEST(test_what_the_machine_needs);
    RUN_TEST(test_inductances);
    RUN_TEST(test_a_loop_that_is_not_stable);
    RUN_TEST(test_without_memory);
    return UNITY_END();
}
