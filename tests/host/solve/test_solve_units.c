/* With currents, torques and times in other units, which are powers of two and change no digit, `solve` finds
 * the same currents for the same reasons: nothing compares a current, a torque or a voltage with a number of
 * its own. */
#include "hci/host/solve/solve.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "support/other_units.h"
#include "support/solving.h"

#define SAME 1e-7 /* of the largest: searches end by what is left, which rounds otherwise */
#define CLOSE                                                                                                \
    1e-4 /* the same of an interior machine within limits, whose currents are found step by step             \
          */

static const units *unit;
static hci_wave held;
static hci_component component[4] = {{1.0, 1}, {5.0, -1}, {7.0, 1}, {11.0, -1}};
static hci_set name[4] = {HCI_SET_POS, HCI_SET_NEG, HCI_SET_POS, HCI_SET_NEG};
static hci_component_set set = {.component = component, .set = name, .count = 4};

void setUp(void)
{
}

void tearDown(void)
{
}

static double ampere(double value)
{
    return value * unit->current;
}

static double newton_metre(double value)
{
    return value * unit->torque;
}

static double volt(double value)
{
    return value * units_V(unit);
}

static void machine_start(const char *folder, double mean_Nm)
{
    solving_start(folder, newton_metre(mean_Nm));
    machine.inductance_d_H = machine.inductance_q_H = 2e-3;
    machine.resistance_ohm = 0.5;
    machine.rated_current_A = machine.max_current_A = machine.dc_link_voltage_V = NAN;
    units_machine(&machine, unit);
}

/* ---- what is asked for ---- */

static void take_set(void)
{
    options.set = &set;
}

static void take_held(void)
{
    static hci_component_set beside = {.component = component + 1, .set = name + 1, .count = 3};
    held = (hci_wave){1.0, 1, ampere(2.0), ampere(0.1)};
    options.held = &held;
    options.set = &beside;
}

static void take_square(void)
{
    take_held();
    options.compare = HCI_COMPARE_SQUARE;
    options.method = HCI_METHOD_LU;
}

static void take_sparse(void)
{
    take_square();
    options.method = HCI_METHOD_UMFPACK;
}

static void take_tolerance(void)
{
    options.set = &set;
    options.tolerance = 0.02;
}

static void choose(void)
{
}

static void choose_few(void)
{
    options.choose_at_most = 4;
}

static void choose_low(void)
{
    options.highest_rotor_order = 6.5;
}

static void point_by_point(void)
{
    options.method = HCI_METHOD_POINTWISE;
}

static void point_id0(void)
{
    options.method = HCI_METHOD_POINTWISE;
    options.strategy = HCI_STRATEGY_ID0;
}

static void point_cancel(void)
{
    options.method = HCI_METHOD_POINTWISE;
    options.strategy = HCI_STRATEGY_CANCEL;
}

static void point_angle(void)
{
    static const double angle_rad = 0.2;
    options.method = HCI_METHOD_POINTWISE;
    options.current_angle_rad = &angle_rad;
}

static void limit_current(void)
{
    options.limit_current_A = ampere(2.9);
}

static void limit_phase(void)
{
    options.limits.current_A[1] = ampere(2.7);
    options.minimise = HCI_MINIMISE_RMS;
}

static void limit_rms(void)
{
    options.limits.rms_A[0] = ampere(1.8);
    options.minimise = HCI_MINIMISE_PEAK_TO_PEAK;
}

static void limit_copper(void)
{
    options.limits.copper_W = 6.0 * newton_metre(1.0) * unit->speed;
    options.limit_current_A = ampere(2.9);
}

static void limit_voltage(void)
{
    options.speed_rad_per_s = 100.0 * unit->speed;
    options.limit_voltage_V = volt(150.0);
}

static void limit_vector(void)
{
    limit_voltage();
    options.limits.voltage_reserve = 0.1;
    options.limits.dead_time_s = 2e-6 / unit->speed;
    options.limits.pwm_frequency_Hz = 1e4 * unit->speed;
    options.limits.modulation = HCI_MODULATION_SINUSOIDAL;
}

static void limit_all(void)
{
    options.limit_current_A = ampere(0.5);
    options.limits.copper_ratio = 1.05;
}

static void open_phase(void)
{
    options.limits.is_open[2] = true;
}

static void sample(void)
{
    options.speed_rad_per_s = 100.0 * unit->speed;
    options.sample_rad = 0.06;
}

static void loop(void)
{
    options.set = &set;
    options.speed_rad_per_s = 100.0 * unit->speed;
    options.loop_bandwidth_Hz = 400.0 * unit->speed;
}

typedef struct {
    const char *folder;
    double mean_Nm, share; /* within which two answers are the same */
    void (*ask)(void);
} question;

#define A        "data/machine_a", 2.46, SAME
#define C        "data/machine_c", 4.0, SAME
#define C_WITHIN "data/machine_c", 4.0, CLOSE

static const question QUESTION[] = {
    {A, take_set},       {A, take_square}, {A, take_sparse},          {A, take_held},
    {A, take_tolerance}, {A, choose},      {A, choose_few},           {A, choose_low},
    {A, point_by_point}, {A, point_id0},   {A, point_angle},          {A, limit_current},
    {A, limit_phase},    {A, limit_rms},   {A, limit_copper},         {A, limit_voltage},
    {A, limit_vector},   {A, limit_all},   {A, open_phase},           {A, sample},
    {A, loop},           {C, take_set},    {C, point_by_point},       {C, point_cancel},
    {C, point_angle},    {C, loop},        {C_WITHIN, limit_current}, {C_WITHIN, limit_copper},
};

/* ---- the same answer ---- */

static void same_currents(const hci_solution *a, const hci_solution *b, const units *u)
{
    TEST_ASSERT_EQUAL_UINT64(a->current.count, b->current.count);
    TEST_ASSERT_EQUAL_INT(a->per_Nm != NULL, b->per_Nm != NULL);
    for (size_t k = 0; k < a->current.count; ++k) {
        const hci_wave *x = &a->current.wave[k], *y = &b->current.wave[k];
        const double most = a->peak_phase_current_A;
        TEST_ASSERT_EQUAL_DOUBLE(x->order, y->order);
        TEST_ASSERT_EQUAL_INT(x->sequence, y->sequence);
        units_same(x->sine, y->sine, u->current, most, "sine");
        units_same(x->cosine, y->cosine, u->current, most, "cosine");
        if (a->per_Nm)
            units_same(a->per_Nm[k].sine, b->per_Nm[k].sine, u->current / u->torque, 1.0, "per_Nm");
        if (a->constant)
            units_same(a->constant[k].cosine, b->constant[k].cosine, u->current, most, "constant");
    }
    units_same(a->mean_square_A2, b->mean_square_A2, u->current * u->current, 0.0, "mean square");
    units_same(a->limit_mean_square_A2, b->limit_mean_square_A2, u->current * u->current, 0.0, "its limit");
    units_same(a->peak_phase_current_A, b->peak_phase_current_A, u->current, 0.0, "peak");
    units_same(a->rms_phase_current_A, b->rms_phase_current_A, u->current, 0.0, "rms");
    units_same(a->plain_amplitude_A, b->plain_amplitude_A, u->current, 0.0, "plain sine");
    units_same(a->least_iq_A, b->least_iq_A, u->current, 0.0, "least i_q");
}

static void same_torque(const hci_solution *a, const hci_solution *b, const units *u)
{
    TEST_ASSERT_EQUAL_UINT64(a->order_count, b->order_count);
    for (size_t k = 0; k < a->order_count; ++k) {
        const hci_solved_order *x = &a->order[k], *y = &b->order[k];
        TEST_ASSERT_EQUAL_DOUBLE(x->torque_Nm.order, y->torque_Nm.order);
        units_same(x->torque_Nm.sine, y->torque_Nm.sine, u->torque, a->wanted_mean_Nm, "torque");
        units_same(x->torque_Nm.cosine, y->torque_Nm.cosine, u->torque, a->wanted_mean_Nm, "torque");
        units_same(x->before_Nm.sine, y->before_Nm.sine, u->torque, a->wanted_mean_Nm, "before");
        TEST_ASSERT_EQUAL_INT(x->verdict, y->verdict);
        TEST_ASSERT_EQUAL_DOUBLE(x->remedy.order, y->remedy.order);
    }
    units_same(a->tolerance_Nm, b->tolerance_Nm, u->torque, 0.0, "tolerance");
    units_same(a->worst_error_Nm, b->worst_error_Nm, u->torque, a->wanted_mean_Nm, "worst");
    units_same(a->T_ripple_percent, b->T_ripple_percent, 1.0, 100.0, "ripple");
    units_same(a->T_ripple_before_percent, b->T_ripple_before_percent, 1.0, 100.0, "ripple before");
    units_same(a->torque_at_limit_Nm, b->torque_at_limit_Nm, u->torque, 0.0, "torque at the limit");
    units_same(a->minimised_Nm, b->minimised_Nm, u->torque, a->wanted_mean_Nm, "minimised");
}

static double unit_of(const hci_limit *limit, const units *u)
{
    switch (limit->kind) {
    case HCI_LIMIT_VOLTAGE:
        return units_V(u);
    case HCI_LIMIT_COPPER:
        return u->current * u->current;
    default:
        return u->current;
    }
}

static void same_limits(const hci_solution *a, const hci_solution *b, const units *u)
{
    TEST_ASSERT_EQUAL_INT(a->within_limits, b->within_limits);
    TEST_ASSERT_EQUAL_INT(a->limit_cost, b->limit_cost);
    TEST_ASSERT_EQUAL_UINT64(a->limit_count, b->limit_count);
    for (size_t k = 0; k < a->limit_count; ++k) {
        const hci_limit *x = &a->limit[k], *y = &b->limit[k];
        TEST_ASSERT_EQUAL_INT(x->kind, y->kind);
        TEST_ASSERT_EQUAL_INT(x->binds, y->binds);
        units_same(x->limit, y->limit, unit_of(x, u), 0.0, "limit");
        units_same(x->value, y->value, unit_of(x, u), 0.0, "its value");
    }
    units_same(a->exceeded_share, b->exceeded_share, 1.0, 1.0, "exceeded by");
    units_same(a->peak_line_voltage_V, b->peak_line_voltage_V, units_V(u), 0.0, "voltage");
}

static void same_solution(const hci_solution *a, const hci_solution *b, const units *u)
{
    TEST_ASSERT_EQUAL_INT(a->method, b->method);
    TEST_ASSERT_EQUAL_UINT64(a->rows, b->rows);
    TEST_ASSERT_EQUAL_UINT64(a->unknowns, b->unknowns);
    TEST_ASSERT_EQUAL_UINT64(a->rank, b->rank);
    TEST_ASSERT_EQUAL_UINT64(a->period_turns, b->period_turns);
    TEST_ASSERT_EQUAL_UINT64(a->gap_count, b->gap_count);
    TEST_ASSERT_EQUAL_INT(a->newton_converged, b->newton_converged);
    same_currents(a, b, u);
    same_torque(a, b, u);
    same_limits(a, b, u);
    units_same(a->loop.rpm_per_Hz, b->loop.rpm_per_Hz, 1.0, 0.0, "rpm per Hz");
    units_same(a->loop.lead_rpm_per_Hz, b->loop.lead_rpm_per_Hz, 1.0, 0.0, "rpm per Hz, read ahead");
    units_same(a->loop.added_Nm, b->loop.added_Nm, u->torque, 0.0, "what the loop adds");
    TEST_ASSERT_EQUAL_INT(a->loop.leaves_out_back_emf, b->loop.leaves_out_back_emf);
}

static hci_status answer(const question *q, const units *u, hci_solution *answered)
{
    hci_note note = {{0}};
    unit = u;
    machine_start(q->folder, q->mean_Nm);
    q->ask();
    const hci_status status = hci_solve(&machine, &options, answered, &note);
    TEST_ASSERT_TRUE_MESSAGE(status == HCI_OK || status == HCI_NOT_REACHED, note.text);
    solving_end();
    return status;
}

static void test_solve_has_no_units(void)
{
    const units *const others[] = {&SMALL, &LARGE, &COILS};
    for (size_t n = 0; n < sizeof QUESTION / sizeof *QUESTION; ++n) {
        hci_solution plain = {0};
        units_share = QUESTION[n].share;
        const hci_status status = answer(&QUESTION[n], &PLAIN, &plain);
        for (size_t k = 0; k < sizeof others / sizeof *others; ++k) {
            hci_solution other = {0};
            snprintf(units_place, sizeof units_place, "question %zu, units %zu", n, k);
            TEST_ASSERT_EQUAL_INT_MESSAGE(status, answer(&QUESTION[n], others[k], &other), units_place);
            same_solution(&plain, &other, others[k]);
            hci_solution_release(&other);
        }
        hci_solution_release(&plain);
    }
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_solve_has_no_units);
    return UNITY_END();
}
