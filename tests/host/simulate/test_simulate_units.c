/* A simulated drive in other units of current, torque and time is the same drive: nothing in it compares a
 * current, a voltage, a speed or a time with a number of its own. */
#include "hci/host/simulate/simulate.h"

#include "support/other_units.h"
#include "support/simulating.h"

#define SAME 1e-9

void setUp(void)
{
    drives_start();
}

void tearDown(void)
{
    drives_end();
}

/* ---- scenarios in other units ---- */

static double factor_of(const char *of, const units *u)
{
    const struct {
        const char *name;
        double factor;
    } list[] = {{"s", 1.0 / u->speed},
                {"rad_per_s", u->speed},
                {"Nm", u->torque},
                {"kgm2", u->torque / u->speed / u->speed},
                {"Nms_per_rad", u->torque / u->speed},
                {"Nm/rad", u->torque},
                {"A", u->current},
                {"Hz", u->speed},
                {"V", units_V(u)},
                {"ohm", units_V(u) / u->current},
                {"V/(A*s)", units_V(u) / u->current * u->speed}};
    for (size_t k = 0; k < sizeof list / sizeof *list; ++k)
        if (strcmp(list[k].name, of) == 0) return list[k].factor;
    return 1.0;
}

static void scenario_scale(hci_scenario *s, const units *u)
{
#define SCALE(field, name, unit, low, high, fallback, what) s->field *= factor_of(unit, u);
    HCI_SCENARIO_VALUES(SCALE)
#undef SCALE
    s->id_limit_A *= u->torque / u->current; /* in the frame dq_x */
    s->iq_limit_A *= u->torque / u->current;
}

#define TIMES                                                                                                \
    "step,10,us\ncurrent_sample_time,100,us\nspeed_sample_time,200,us\nswitching_frequency_max,20,kHz\n"
#define AT_SPEED TIMES "duration,0.04,s\nprescribed_speed,500,rpm\n"
#define SHAFT                                                                                                \
    TIMES "duration,0.05,s\ninertia,1e-3,kgm2\ncoulomb_friction,0.02,Nm\nviscous_friction,1e-3,Nms_per_"     \
          "rad\n"
#define SENSORS                                                                                              \
    "current_noise,0.02,A\ncurrent_offset_a,0.05,A\ncurrent_gain_b,0.02,1\ncurrent_quantum,0.01,A\n"         \
    "encoder_counts,4096,count\nangle_noise,1e-3,rad\nspeed_noise,0.1,rad_per_s\ntorque_noise,0.01,Nm\n"

static const struct {
    bool is_c;
    const char *rows;
    bool slopes_alone; /* no table of the inductances themselves */
} QUESTION[] = {
    {false, AT_SPEED "torque_reference,2.46,Nm\n", false},
    {false, AT_SPEED "torque_reference,2.46,Nm\ncurrent_control,pi,\nstrategy,id0,\n" SENSORS, false},
    {false,
     AT_SPEED "torque_reference,2,Nm\ncurrent_control,pi,\ndead_time,2,us\ndead_time_crossing,0.1,A\n"
              "dead_time_compensation,1,count\ncurrent_filter_time,50,us\ncurrent_delay,20,us\n"
              "angle_delay,10,us\ndecoupling,0,count\n",
     false},
    {false,
     SHAFT "speed_reference,30,rad_per_s\nspeed_kp,0.03,Nms_per_rad\nspeed_ki,0.2,Nm/"
           "rad\nload_torque,0.5,Nm\nload_torque_2,1,Nm\n"
           "load_torque_2_from,0.03,s\ncurrent_control,hysteresis,\nhysteresis_band,0.2,A\n"
           "torque_limit,3,Nm\nspeed_delay,100,us\n",
     false},
    {false, SHAFT "torque_reference,0.01,Nm\nload_torque,0.005,Nm\n", false},
    {true, AT_SPEED "torque_reference,4,Nm\nstrategy,cancel,\nid_limit,3,A\niq_limit,4,A\n", false},
    {true, AT_SPEED "torque_reference,4,Nm\n", true},
    {true,
     SHAFT "torque_reference,4,Nm\ncurrent_control,pi,\ncurrent_limit,3,A\nstrategy_2,id0,\n"
           "strategy_2_from,0.02,s\n",
     false}};

/* ---- the same figures ---- */

static void same_statistics(const hci_statistics *a, const hci_statistics *b, double by, const char *what)
{
    units_same(a->mean, b->mean, by, a->most, what);
    units_same(a->rms, b->rms, by, 0.0, what);
    units_same(a->most, b->most, by, 0.0, what);
    units_same(a->least, b->least, by, a->most, what);
}

static void same_energies(const hci_energies *a, const hci_energies *b, double by)
{
    units_same(a->electrical, b->electrical, by, 0.0, "electrical");
    units_same(a->copper, b->copper, by, 0.0, "copper");
    units_same(a->stored, b->stored, by, fabs(a->mechanical), "stored");
    units_same(a->mechanical, b->mechanical, by, 0.0, "mechanical");
    units_same(a->friction, b->friction, by, fabs(a->mechanical), "friction");
    units_same(a->kinetic, b->kinetic, by, fabs(a->mechanical), "kinetic");
}

static void same_counts(const hci_simulation *a, const hci_simulation *b)
{
    TEST_ASSERT_EQUAL_UINT64(a->periods, b->periods);
    TEST_ASSERT_EQUAL_UINT64(a->samples, b->samples);
    TEST_ASSERT_EQUAL_UINT64(a->without_current, b->without_current);
    TEST_ASSERT_EQUAL_UINT64(a->limited_from_start, b->limited_from_start);
    TEST_ASSERT_EQUAL_UINT64(a->voltage_limited, b->voltage_limited);
    TEST_ASSERT_EQUAL_UINT64(a->spectrum_count, b->spectrum_count);
    TEST_ASSERT_EQUAL_INT(a->energy_balances, b->energy_balances);
}

static void same_simulation(const hci_simulation *a, const hci_simulation *b, const units *u)
{
    same_counts(a, b);
    units_same(a->step_s, b->step_s, 1.0 / u->speed, 0.0, "step");
    units_same(a->from_s, b->from_s, 1.0 / u->speed, 0.0, "from");
    same_statistics(&a->torque_Nm, &b->torque_Nm, u->torque, "torque");
    same_statistics(&a->speed_rad_per_s, &b->speed_rad_per_s, u->speed, "speed");
    same_statistics(&a->current_A, &b->current_A, u->current, "current");
    same_statistics(&a->current_dqx_A, &b->current_dqx_A, u->torque, "current dqx");
    units_same(a->peak_phase_A, b->peak_phase_A, u->current, 0.0, "peak");
    units_same(a->copper_W, b->copper_W, u->torque * u->speed, 0.0, "copper loss");
    units_same(a->plain_amplitude_A, b->plain_amplitude_A, u->current, 0.0, "plain");
    units_same(a->switching_frequency_Hz, b->switching_frequency_Hz, u->speed, 0.0, "switching");
    units_same(a->loss_to_plain, b->loss_to_plain, 1.0, 0.0, "loss to plain");
    units_same(a->plain.peak_to_peak_Nm, b->plain.peak_to_peak_Nm, u->torque, 0.0,
               "ripple of the plain sine");
    units_same(a->plain.T_ripple_percent, b->plain.T_ripple_percent, 1.0, 0.0, "the same in percent");
    units_same(a->T_ripple_percent, b->T_ripple_percent, 1.0, 0.0, "ripple");
    same_energies(&a->energy_J, &b->energy_J, u->torque);
    for (size_t k = 0; k < a->spectrum_count; ++k) {
        units_same(a->spectrum_Nm[k].sine, b->spectrum_Nm[k].sine, u->torque, a->torque_Nm.most, "order");
        units_same(a->spectrum_Nm[k].cosine, b->spectrum_Nm[k].cosine, u->torque, a->torque_Nm.most, "order");
    }
}

static hci_simulation play(size_t n, const units *u)
{
    hci_scenario scenario = scenario_of(QUESTION[n].rows);
    hci_machine_data *machine = QUESTION[n].is_c ? &machine_c : &machine_a;
    machine->inductance_d_H = machine->inductance_q_H = 2e-3;
    machine->resistance_ohm = 0.5;
    machine->dc_link_voltage_V = 200.0;
    machine->rated_current_A = 4.0;
    if (QUESTION[n].slopes_alone) machine->inductance_count = 0;
    units_machine(machine, u);
    scenario_scale(&scenario, u);
    const hci_simulation s = simulate_into(machine, &scenario, NULL);
    drives_end();
    drives_start();
    return s;
}

static void test_a_drive_has_no_units(void)
{
    static const units tiny = {1.0, 0x1p-12, 1.0}; /* inductances far below a millihenry */
    const units *const others[] = {&SMALL, &LARGE, &COILS, &tiny};
    units_share = SAME;
    for (size_t n = 0; n < sizeof QUESTION / sizeof *QUESTION; ++n) {
        hci_simulation plain = play(n, &PLAIN);
        for (size_t k = 0; k < sizeof others / sizeof *others; ++k) {
            snprintf(units_place, sizeof units_place, "question %zu, units %zu", n, k);
            hci_simulation other = play(n, others[k]);
            same_simulation(&plain, &other, others[k]);
            hci_simulation_release(&other);
        }
        hci_simulation_release(&plain);
    }
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_a_drive_has_no_units);
    return UNITY_END();
}
