/* Effects on a simulated drive: what its sensors read, by formulas over time. */
#include <complex.h>

#include "hci/effects/attach.h"
#include "support/effect_list.h"

enum { P = 3, STEPS = 400, RING = 64 };

static const double STEP_s = 1e-4, OMEGA = 900.0;

static el_machine m;
static el_list l;
static hci_drive drive;
static hci_sensor sensors[HCI_SENSE_COUNT];
static hci_sensor_state states[HCI_SENSE_COUNT];
static double rings[HCI_SENSE_COUNT][RING];
static hci_plant_state plant;
static hci_effects_attachment attachment;
static hci_effects_refusal refusal;

void setUp(void)
{
    el_machine_make(&m);
    memset(&l, 0, sizeof l);
    memset(&drive, 0, sizeof drive);
    memset(sensors, 0, sizeof sensors);
    plant = (hci_plant_state){{0.0, 0.0}, OMEGA, 0.0, 0.0};
    drive.control.step_s = STEP_s;
}

void tearDown(void)
{
}

static hci_status put(const hci_plant_state *state)
{
    const hci_effects_plant effects = {&m.machine, &l.list, 75.0};
    return hci_effects_put(&effects, state, &drive, sensors, &attachment, &refusal);
}

static void attach(const double first[HCI_SENSE_COUNT])
{
    TEST_ASSERT_EQUAL_INT(HCI_OK, put(&plant));
    TEST_ASSERT_EQUAL_INT(HCI_EFFECTS_FIT, refusal.reason);
    TEST_ASSERT_EQUAL_PTR(sensors, drive.sensors);
    for (int s = 0; s < HCI_SENSE_COUNT; ++s) {
        TEST_ASSERT_TRUE(hci_sensor_workspace(&sensors[s]) <= RING);
        hci_sensor_start(&sensors[s], &states[s], rings[s], 1, first[s]);
    }
}

static double read(int sense, double value, double theta_m_rad)
{
    return hci_sensor_read(&sensors[sense], &states[sense], value, theta_m_rad);
}

static const double NOTHING[HCI_SENSE_COUNT] = {0.0};

/* ---- what is read at once ---- */

static double halved(const void *context, double value, double theta_m_rad)
{
    (void)context;
    return 0.5 * value + theta_m_rad;
}

/* All errors without a memory together; a modification that was there before comes first. */
static void test_readings_are_the_equations(void)
{
    el_add(&l, "current_offset", "a", 0.0, 0.2);
    el_add(&l, "current_offset", "c", 0.0, -0.1);
    el_add(&l, "current_gain", "b", 0.0, 0.03);
    el_add(&l, "current_gain", "c", 0.0, -0.02);
    el_add(&l, "position_offset", "angle", 0.0, 0.06);
    el_add(&l, "position_eccentricity", "mech_sine", 1.0, 0.02);
    el_add(&l, "position_eccentricity", "mech_cosine", 2.0, 0.01);
    el_add(&l, "position_harmonics", "sine", 2.0, 0.04);
    el_add(&l, "torque_gain", "gain", 0.0, 0.1);
    el_add(&l, "torque_drift", "rate", 0.0, 7.0);
    el_add(&l, "torque_sensor", "offset", 0.0, 0.25);
    sensors[HCI_SENSE_TORQUE].modify = halved;
    attach(NOTHING);
    for (int k = 0; k < STEPS; ++k) {
        const double theta = 0.017 * k, value = 3.0 * sin(0.1 * k);
        TEST_ASSERT_DOUBLE_WITHIN(1e-13, value + 0.2, read(HCI_SENSE_IA, value, theta));
        TEST_ASSERT_DOUBLE_WITHIN(1e-13, 1.03 * value, read(HCI_SENSE_IB, value, theta));
        TEST_ASSERT_DOUBLE_WITHIN(1e-13, 0.98 * value - 0.1, read(HCI_SENSE_IC, value, theta));
        TEST_ASSERT_DOUBLE_WITHIN(1e-13, value, read(HCI_SENSE_SPEED, value, theta));
        TEST_ASSERT_DOUBLE_WITHIN(1e-12,
                                  theta + 0.02 * sin(theta) + 0.01 * cos(2.0 * theta) +
                                      0.04 / P * sin(2.0 * P * theta) + 0.06 / P,
                                  read(HCI_SENSE_ANGLE, theta, theta));
        TEST_ASSERT_DOUBLE_WITHIN(1e-12, 1.1 * (0.5 * value + theta) + 7.0 * STEP_s * k + 0.25,
                                  read(HCI_SENSE_TORQUE, value, theta));
    }
}

/* The angle follows the current of the plant. */
static void test_the_angle_turns_with_the_load(void)
{
    double i[3];
    el_add(&l, "position_load", "per_ampere", 0.0, 0.03);
    attach(NOTHING);
    plant.i[0] = 1.5;
    plant.i[1] = -2.0;
    hci_plane_to_abc(plant.i, i);
    for (int k = 0; k < STEPS; ++k) {
        const double theta = 0.017 * k, q = hci_park(hci_clarke(i), P * theta).q;
        TEST_ASSERT_DOUBLE_WITHIN(1e-13, theta + 0.03 * q / P, read(HCI_SENSE_ANGLE, theta, theta));
    }
}

/* Friction is between the air gap and the torque sensor, each law with the sign of the speed; the plant has
 * the Coulomb part for itself. */
static void test_friction_is_before_the_torque_sensor(void)
{
    el_add(&l, "friction", "coulomb", 0.0, 0.05);
    el_add(&l, "friction", "viscous", 0.0, 1e-3);
    el_add(&l, "friction", "quadratic", 0.0, 2e-6);
    el_add(&l, "stribeck_friction", "excess", 0.0, 0.04);
    el_add(&l, "stribeck_friction", "speed", 0.0, 30.0);
    el_add(&l, "iron_drag", "hysteresis", 0.0, 3e-3);
    el_add(&l, "iron_drag", "eddy", 0.0, 5e-5);
    drive.plant.coulomb_Nm = 0.01;
    attach(NOTHING);
    TEST_ASSERT_DOUBLE_WITHIN(1e-15, 0.01 + 0.05 + 0.04, drive.plant.coulomb_Nm);
    plant.i[0] = 1.5;
    plant.i[1] = -2.0;
    for (int k = -50; k <= 50; ++k) {
        const double w = plant.speed_rad_per_s = 2.0 * k, sign = (w > 0.0) - (w < 0.0);
        const double squares = 2.0 / 3.0 * (1.5 * 1.5 + 2.0 * 2.0);
        const double braked = sign * (0.05 + 0.04 * exp(-w * w / 900.0)) + 1e-3 * w + 2e-6 * w * fabs(w) +
                              squares * (sign * 3e-3 + 5e-5 * w);
        TEST_ASSERT_DOUBLE_WITHIN(1e-14, 2.0 - braked, read(HCI_SENSE_TORQUE, 2.0, 0.3));
    }
}

static void test_without_a_state_the_sensor_sees_no_friction(void)
{
    el_add(&l, "friction", "coulomb", 0.0, 0.05);
    el_add(&l, "stribeck_friction", "excess", 0.0, 0.04);
    el_add(&l, "iron_drag", "eddy", 0.0, 5e-5);
    el_add(&l, "rotor_inertia", "inertia", 0.0, 0.02);
    TEST_ASSERT_EQUAL_INT(HCI_OK, put(NULL));
    TEST_ASSERT_EQUAL_DOUBLE(2.0, read(HCI_SENSE_TORQUE, 2.0, 0.3));
}

/* ---- what remembers ---- */

/* A speed that rises straight in time; the first reading has none before it. */
static void test_what_turns_the_rotor_is_not_read(void)
{
    el_add(&l, "rotor_inertia", "inertia", 0.0, 0.02);
    attach(NOTHING);
    for (int k = 0; k < 5; ++k) {
        plant.speed_rad_per_s = OMEGA + 300.0 * STEP_s * k;
        TEST_ASSERT_DOUBLE_WITHIN(1e-9, k > 0 ? 2.0 - 0.02 * 300.0 : 2.0, read(HCI_SENSE_TORQUE, 2.0, 0.3));
    }
}

/* Of what goes straight in time a delay by parts of a step is exact; an angle that wraps goes straight too.
 */
static void test_delays_by_parts_of_a_step(void)
{
    const double first[HCI_SENSE_COUNT] = {-7.0, -7.0, -7.0, 0.0, 0.0, -7.0};
    el_add(&l, "channel_delay", "current", 0.0, 2.3 * STEP_s);
    el_add(&l, "channel_delay", "angle", 0.0, 3.75 * STEP_s);
    el_add(&l, "channel_delay", "torque", 0.0, 5.0 * STEP_s);
    sensors[HCI_SENSE_TORQUE].delay_steps = 2;
    attach(first);
    TEST_ASSERT_EQUAL_UINT(2, sensors[HCI_SENSE_IB].delay_steps);
    TEST_ASSERT_EQUAL_UINT(3, sensors[HCI_SENSE_ANGLE].delay_steps);
    TEST_ASSERT_EQUAL_UINT(7, sensors[HCI_SENSE_TORQUE].delay_steps);
    TEST_ASSERT_NULL(sensors[HCI_SENSE_TORQUE].modify);
    for (int k = 0; k < STEPS; ++k) {
        const double theta = fmod(OMEGA * STEP_s * k, 2.0 * REF_PI);
        for (int s = HCI_SENSE_IA; s <= HCI_SENSE_IC; ++s) {
            const double sign = s == HCI_SENSE_IB ? -1.0 : 1.0, i = read(s, sign * (1.0 + 0.25 * k), theta);
            if (k < 2) TEST_ASSERT_EQUAL_DOUBLE(-7.0, i);
            if (k == 2) TEST_ASSERT_EQUAL_DOUBLE(sign, i);
            if (k > 2) TEST_ASSERT_DOUBLE_WITHIN(1e-12, sign * (1.0 + 0.25 * (k - 2.3)), i);
        }
        const double angle = read(HCI_SENSE_ANGLE, theta, theta), off = angle - OMEGA * STEP_s * (k - 3.75);
        if (k > 4)
            TEST_ASSERT_DOUBLE_WITHIN(1e-10, 0.0, off - 2.0 * REF_PI * floor(off / (2.0 * REF_PI) + 0.5));
        TEST_ASSERT_DOUBLE_WITHIN(1e-12, k < 7 ? -7.0 : k - 7.0, read(HCI_SENSE_TORQUE, k, theta));
    }
}

/* G of the trapezoidal rule at ω: jω becomes j (2/h) tan(ωh/2). */
static double complex trapezoids(double w)
{
    return 2.0 / STEP_s * tan(0.5 * w * STEP_s) * (double complex)I;
}

/* Settled at the first value; then sines as the transfer functions have them. */
static void test_filters_of_sines(void)
{
    const double tau = 3e-4, lag = 2e-4, hz = 400.0, damping = 0.3, w = 1300.0;
    const double natural = 2.0 * REF_PI * hz;
    const double complex s = trapezoids(w), low_pass = 1.0 / (1.0 + tau * s);
    const double complex transducer =
        1.0 / (1.0 + lag * s) / (1.0 + 2.0 * damping * s / natural + s * s / (natural * natural));
    el_add(&l, "current_filter", "time_constant", 0.0, tau);
    el_add(&l, "torque_sensor", "time_constant", 0.0, lag);
    el_add(&l, "torque_sensor", "natural_frequency", 0.0, hz);
    el_add(&l, "torque_sensor", "damping", 0.0, damping);
    attach(NOTHING);
    for (int k = 0; k < STEPS; ++k) {
        const double complex wave = cexp((double complex)I * (w * STEP_s * k + 0.4));
        const double i = read(HCI_SENSE_IA, creal(wave), 0.0), t = read(HCI_SENSE_TORQUE, creal(wave), 0.0);
        if (k == 0) TEST_ASSERT_EQUAL_DOUBLE(creal(wave), i);
        if (k == 0) TEST_ASSERT_EQUAL_DOUBLE(creal(wave), t);
        if (k < STEPS / 2) continue; /* e^{-0.3·2513·0.02} = 3e-7 of the start is left */
        TEST_ASSERT_DOUBLE_WITHIN(1e-12, creal(low_pass * wave), i);
        TEST_ASSERT_DOUBLE_WITHIN(2e-6, creal(transducer * wave), t);
    }
    read(HCI_SENSE_IB, 5.0, 0.0);
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, 5.0 - 4.0 / 7.0, read(HCI_SENSE_IB, 1.0, 0.0)); /* h/2 by τ + h/2 */
    TEST_ASSERT_EQUAL_DOUBLE(5.0, read(HCI_SENSE_IC, 5.0, 0.0));
}

/* What has been as it is for long stays: a sensor begins settled, whatever its memory held. */
static void test_filters_of_a_constant(void)
{
    el_add(&l, "current_filter", "time_constant", 0.0, 3e-4);
    el_add(&l, "torque_sensor", "time_constant", 0.0, 2e-3);
    el_add(&l, "torque_sensor", "natural_frequency", 0.0, 40.0);
    el_add(&l, "torque_sensor", "damping", 0.0, 0.1);
    attach(NOTHING);
    for (int k = 0; k < 50; ++k) {
        TEST_ASSERT_DOUBLE_WITHIN(1e-12, 1.7, read(HCI_SENSE_IA, 1.7, 0.0));
        TEST_ASSERT_DOUBLE_WITHIN(1e-12, 1.7, read(HCI_SENSE_TORQUE, 1.7, 0.0));
    }
}

static void test_no_filter_no_link(void)
{
    el_add(&l, "current_filter", "time_constant", 0.0, 0.0);
    attach(NOTHING);
    for (int s = 0; s < HCI_SENSE_COUNT; ++s)
        TEST_ASSERT_NULL(sensors[s].modify);
    TEST_ASSERT_EQUAL_UINT(1, drive.plant.effect_count);
}

/* ---- the plant ---- */

static void test_the_plant_has_the_torque(void)
{
    const hci_effects_plant effects = {&m.machine, &l.list, 75.0};
    hci_plant_point expected = {0}, point = {0};
    el_add(&l, "cogging", "cosine", 18.0, 0.3);
    el_add(&l, "magnet_temperature", "emf_per_kelvin", 0.0, -0.002);
    attach(NOTHING);
    plant = (hci_plant_state){{2.0, -1.0}, 40.0, 0.7, 0.0};
    hci_effects_apply(&effects, &plant, &expected);
    drive.plant.effects[0].apply(drive.plant.effects[0].context, &plant, &point);
    TEST_ASSERT_TRUE(fabs(expected.magnetic.e[0]) > 0.01 && fabs(expected.magnetic.cogging_Nm) > 0.01);
    TEST_ASSERT_EQUAL_MEMORY(&expected, &point, sizeof point);
}

static void test_nothing_is_nothing(void)
{
    refusal = (hci_effects_refusal){HCI_EFFECTS_DELAY, hci_effect_type_find("cogging"), 7.0};
    attach(NOTHING);
    TEST_ASSERT_NULL(refusal.type);
    TEST_ASSERT_EQUAL_DOUBLE(0.0, refusal.value);
    TEST_ASSERT_EQUAL_UINT(0, drive.plant.effect_count);
    TEST_ASSERT_EQUAL_DOUBLE(0.0, drive.plant.coulomb_Nm);
    TEST_ASSERT_EQUAL_UINT(0, hci_effects_needs(&l.list));
    el_add(&l, "torque_drift", "rate", 0.0, 7.0);
    TEST_ASSERT_EQUAL_UINT(HCI_EFFECT_NEEDS_TIME, hci_effects_needs(&l.list));
    el_add(&l, "magnet_temperature", "emf_per_kelvin", 0.0, -0.002);
    el_add(&l, "cogging", "cosine", 18.0, 0.3);
    TEST_ASSERT_EQUAL_UINT(HCI_EFFECT_NEEDS_TIME | HCI_EFFECT_NEEDS_TEMPERATURE, hci_effects_needs(&l.list));
}

/* ---- refusals ---- */

static void refuses(hci_effects_reason reason, const char *type, double value)
{
    const hci_drive drive_before = drive;
    hci_sensor before[HCI_SENSE_COUNT];
    memcpy(before, sensors, sizeof before);
    TEST_ASSERT_EQUAL_INT(HCI_ERROR_ARGUMENT, put(&plant));
    TEST_ASSERT_EQUAL_INT(reason, refusal.reason);
    TEST_ASSERT_EQUAL_PTR(type ? hci_effect_type_find(type) : NULL, refusal.type);
    TEST_ASSERT_EQUAL_DOUBLE(value, refusal.value);
    TEST_ASSERT_EQUAL_MEMORY(&drive_before, &drive, sizeof drive);
    TEST_ASSERT_EQUAL_MEMORY(before, sensors, sizeof before);
}

static void test_what_is_no_drive(void)
{
    drive.control.step_s = 0.0;
    refuses(HCI_EFFECTS_NOT_A_DRIVE, NULL, 0.0);
    setUp();
    drive.plant.effect_count = 1;
    refuses(HCI_EFFECTS_NOT_A_DRIVE, NULL, 0.0);
}

static void test_friction_that_drives(void)
{
    el_add(&l, "cogging", "cosine", 18.0, 0.3);
    el_add(&l, "friction", "coulomb", 0.0, -0.5);
    drive.plant.coulomb_Nm = 0.25;
    refuses(HCI_EFFECTS_DRIVING, "friction", -0.25);
    drive.plant.coulomb_Nm = 0.5; /* none is left, which does not drive */
    TEST_ASSERT_EQUAL_INT(HCI_OK, put(&plant));
    setUp();
    drive.plant.coulomb_Nm = -0.125;
    refuses(HCI_EFFECTS_DRIVING, NULL, -0.125);
}

static void test_delays_that_cannot_be(void)
{
    const double most_s = STEP_s * HCI_EFFECTS_MOST_STEPS;
    el_add(&l, "channel_delay", "torque", 0.0, -STEP_s);
    refuses(HCI_EFFECTS_DELAY, "channel_delay", -STEP_s);
    l.term[0][0].value = most_s;
    refuses(HCI_EFFECTS_DELAY, "channel_delay", most_s);
    l.term[0][0].value = 0.999 * most_s;
    TEST_ASSERT_EQUAL_INT(HCI_OK, put(&plant));
    TEST_ASSERT_EQUAL_UINT(999000, sensors[HCI_SENSE_TORQUE].delay_steps);
}

/* Eight links; the ninth is one too many, be it an effect or the part of a step that a delay leaves. */
static void test_as_many_links_as_fit(void)
{
    const hci_effect_term gain = {0, 0.0, 0.5, NAN};
    hci_effect effect[HCI_EFFECT_LINKS + 1];
    const hci_effect_term delay = {2, 0.0, 0.5 * STEP_s, NAN};
    for (int k = 0; k <= HCI_EFFECT_LINKS; ++k)
        effect[k] = (hci_effect){hci_effect_type_find("torque_gain"), &gain, 1};
    l.list = (hci_effects){effect, HCI_EFFECT_LINKS + 1};
    refuses(HCI_EFFECTS_TOO_MANY_LINKS, NULL, 0.0);
    effect[HCI_EFFECT_LINKS] = (hci_effect){hci_effect_type_find("channel_delay"), &delay, 1};
    refuses(HCI_EFFECTS_TOO_MANY_LINKS, NULL, 0.0);
    l.list.count = HCI_EFFECT_LINKS;
    attach(NOTHING);
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, 2.0 * pow(1.5, 8.0), read(HCI_SENSE_TORQUE, 2.0, 0.0));
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_readings_are_the_equations);
    RUN_TEST(test_the_angle_turns_with_the_load);
    RUN_TEST(test_friction_is_before_the_torque_sensor);
    RUN_TEST(test_what_turns_the_rotor_is_not_read);
    RUN_TEST(test_without_a_state_the_sensor_sees_no_friction);
    RUN_TEST(test_delays_by_parts_of_a_step);
    RUN_TEST(test_filters_of_sines);
    RUN_TEST(test_filters_of_a_constant);
    RUN_TEST(test_no_filter_no_link);
    RUN_TEST(test_the_plant_has_the_torque);
    RUN_TEST(test_nothing_is_nothing);
    RUN_TEST(test_what_is_no_drive);
    RUN_TEST(test_friction_that_drives);
    RUN_TEST(test_delays_that_cannot_be);
    RUN_TEST(test_as_many_links_as_fit);
    return UNITY_END();
}
