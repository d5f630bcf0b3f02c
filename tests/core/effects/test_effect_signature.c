/* How each effect shows in the residual r = T_measured − T_model: the power of the current and of the speed
 * that it grows with, and the orders where it is found, as the table of theory section 7 has them. */
#include <stdio.h>

#include "support/effect_list.h"
#include "unity.h"

static const int P = 2;

void setUp(void)
{
}

void tearDown(void)
{
}

/* A sinusoidal back-EMF; the same with a fifth harmonic; with cogging of order 12. */
typedef enum { SINE, FIFTH, COGGING } machine_kind;

/* Any: not looked at, since it is no power or the effect has none. */
#define ANY 99

enum { ORDERS = 6 };

typedef struct {
    const char *effect, *parameter;
    double order, value;
    machine_kind machine;
    double by_current, by_speed; /* exponents */
    size_t count;                /* of orders; 0: they are not looked at */
    double orders[ORDERS];       /* electrical; all that there are */
} signature;

static const signature TABLE[] = {
    {"cogging", "sine", 18.0, 0.01, SINE, 0, 0, 1, {18}},
    {"back_emf", "sine", 5.0, 0.01, SINE, 1, 0, 1, {6}},
    {"back_emf", "cosine", 7.0, 0.01, SINE, 1, 0, 1, {6}},
    {"back_emf", "sine", 11.0, 0.01, SINE, 1, 0, 1, {12}},
    {"back_emf", "neg_sine", 1.0, 0.01, SINE, 1, 0, 1, {2}},
    {"phase_imbalance", "a", 0.0, 0.01, SINE, 1, 0, 2, {0, 2}},
    {"reluctance", "dd_cosine", 0.0, 1e-3, SINE, 2, 0, 1, {0}},
    {"reluctance", "qq_cosine", 6.0, 1e-3, SINE, 2, 0, 1, {6}},
    {"saturation", "d1q2_cosine", 0.0, -1e-4, SINE, 3, 0, 1, {0}},
    {"saturation", "d0q3_sine", 6.0, 1e-4, SINE, 3, 0, 1, {6}},
    {"saturation", "d1q3_cosine", 0.0, 1e-4, SINE, 4, 0, 1, {0}},
    {"magnet_temperature", "emf_per_kelvin", 0.0, -1e-3, SINE, 1, 0, 1, {0}},
    {"magnet_temperature", "emf_per_kelvin", 0.0, -1e-3, FIFTH, 1, 0, 2, {0, 6}},
    {"current_offset", "a", 0.0, 1e-2, SINE, 0, 0, 1, {1}},
    {"current_offset", "b", 0.0, 1e-2, FIFTH, 0, 0, 2, {1, 5}},
    {"current_gain", "a", 0.0, 1e-3, SINE, 1, 0, 2, {0, 2}},
    {"current_gain", "c", 0.0, 1e-3, FIFTH, 1, 0, 4, {0, 2, 4, 6}},
    {"position_offset", "angle", 0.0, 1e-4, SINE, 1, 0, 1, {0}},
    {"position_offset", "angle", 0.0, 1e-4, FIFTH, 1, 0, 2, {0, 6}},
    {"position_offset", "angle", 0.0, 1e-5, COGGING, ANY, 0, 2, {0, 12}},
    {"position_eccentricity", "mech_sine", 1.0, 1e-4, SINE, 1, 0, 1, {0.5}},
    {"position_eccentricity", "mech_sine", 1.0, 1e-5, FIFTH, 1, 0, 3, {0.5, 5.5, 6.5}},
    {"position_eccentricity", "mech_cosine", 2.0, 1e-5, FIFTH, 1, 0, 3, {1, 5, 7}},
    {"position_eccentricity", "mech_cosine", 1.0, 1e-6, COGGING, ANY, 0, 3, {0.5, 11.5, 12.5}},
    {"channel_delay", "angle", 0.0, 1e-7, FIFTH, 1, 1, 2, {0, 6}},
    {"channel_delay", "torque", 0.0, 1e-8, COGGING, ANY, 1, 1, {12}},
    {"friction", "coulomb", 0.0, 0.01, SINE, 0, 0, 1, {0}},
    {"friction", "viscous", 0.0, 0.01, SINE, 0, 1, 1, {0}},
    {"friction", "quadratic", 0.0, 0.01, SINE, 0, 2, 1, {0}},
    {"torque_sensor", "time_constant", 0.0, 1e-6, FIFTH, 1, 1, 1, {6}},
    {"torque_sensor", "time_constant", 0.0, 1e-6, COGGING, 0, 1, 1, {12}},
    {"mechanical_order", "sine", 0.5, 0.01, SINE, 0, 0, 1, {0.5}},
    {"mechanical_order", "iq_sine", 1.5, 0.01, SINE, 1, 0, 1, {1.5}},
    {"mechanical_order", "id_sine", 1.5, 0.01, SINE, 1, 0, 1, {1.5}},
    {"unequal_magnets", "sine", 0.5, 0.01, SINE, 1, 0, 1, {0.5}},
    {"unequal_magnets", "cosine", 0.5, 0.01, COGGING, ANY, 0, 3, {0.5, 11.5, 12.5}},
    {"stribeck_friction", "excess", 0.0, 0.01, SINE, 0, 0, 1, {0}}, /* with a Stribeck speed far above */
    {"iron_drag", "hysteresis", 0.0, 1e-3, SINE, 2, 0, 1, {0}},
    {"iron_drag", "eddy", 0.0, 1e-5, SINE, 2, 1, 1, {0}},
    {"rotor_inertia", "inertia", 0.0, 1e-6, SINE, 0, 2, 1, {1.5}},
    {"current_filter", "time_constant", 0.0, 1e-7, FIFTH, 1, 1, 2, {0, 6}},
    {"position_harmonics", "sine", 1.0, 1e-4, SINE, 1, 0, 1, {1}},
    {"position_harmonics", "cosine", 2.0, 1e-5, FIFTH, 1, 0, 3, {2, 4, 8}},
    {"position_harmonics", "sine", 4.0, 1e-6, COGGING, ANY, 0, 3, {4, 8, 16}},
    {"position_load", "per_ampere", 0.0, 1e-5, SINE, 2, 0, 1, {0}},
    {"position_load", "per_ampere", 0.0, 1e-6, FIFTH, 2, 0, 2, {0, 6}},
    {"position_load", "per_ampere", 0.0, 1e-6, COGGING, ANY, 0, 2, {0, 12}},
    {"torque_gain", "gain", 0.0, 0.01, SINE, 1, 0, 1, {0}},
    {"torque_gain", "gain", 0.0, 0.01, COGGING, ANY, 0, 2, {0, 12}},
    {"torque_drift", "rate", 0.0, 0.1, SINE, 0, -1, 0, {0}}, /* a ramp: the time of a turn falls with speed */
};

/* ---- residual ---- */

enum { N = 512, MOST = 40 }; /* samples and orders of a mechanical turn */

typedef struct {
    hci_wave emf[2];
    hci_harmonic cogging[1];
    hci_machine machine;
} declared;

static void declare(declared *d, machine_kind kind)
{
    d->emf[0] = hci_wave_polar(1.0, 1, 0.8, 0.0);
    d->emf[1] = hci_wave_polar(5.0, -1, 0.1, 0.7);
    d->cogging[0] = hci_harmonic_polar(12.0, 0.2, 0.3);
    d->machine = (hci_machine){P, d->emf, kind == FIFTH ? 2 : 1, d->cogging, kind == COGGING, NULL, 0};
}

/* A sine with i_d and i_q, at constant speed but for a small swing, three times a turn, of the acceleration.
 */
static hci_sample truth_at(double current, double speed, int k)
{
    hci_sample x = {0};
    x.theta_m_rad = 2.0 * REF_PI * k / N;
    x.speed_rad_per_s = speed;
    x.elapsed_s = x.theta_m_rad / speed;
    x.acceleration_rad_per_s2 = 0.01 * speed * speed * sin(3.0 * x.theta_m_rad);
    x.temperature_C = 70.0;
    for (int s = 0; s < 3; ++s)
        x.i_abc[s] = current * sin(P * x.theta_m_rad - 2.0 * REF_PI * s / 3.0 + 0.5);
    return x;
}

/* The sensors read what the effect makes of the truth; the model has the readings and the declared machine.
 */
static void residual(const signature *g, double current, double speed, double r[N])
{
    declared d;
    el_list l = {0};
    static double time[3 * N], measured[3 * N];
    const hci_effects none = {NULL, 0};
    declare(&d, g->machine);
    el_add(&l, g->effect, g->parameter, g->order, g->value);
    if (strcmp(g->effect, "stribeck_friction") == 0) el_add(&l, g->effect, "speed", 0.0, 1e6);
    for (int k = 0; k < 3 * N; ++k) { /* three turns: a filter has settled in the last */
        const hci_sample truth = truth_at(current, speed, k), reading = hci_effects_sense(&l.list, P, &truth);
        time[k] = 2.0 * REF_PI * k / (N * speed);
        measured[k] = hci_effects_predict(&d.machine, &l.list, &reading, NULL);
    }
    hci_effects_filter(&l.list, time, 3 * N, measured, NULL);
    for (int k = 0; k < N; ++k) {
        const hci_sample truth = truth_at(current, speed, k), reading = hci_effects_sense(&l.list, P, &truth);
        r[k] = measured[2 * N + k] - hci_effects_predict(&d.machine, &none, &reading, NULL);
    }
}

/* Amplitudes at the mechanical orders 0 … MOST. */
static void spectrum(const double r[N], double amplitude[MOST + 1])
{
    for (int n = 0; n <= MOST; ++n) {
        double s = 0.0, c = 0.0;
        for (int k = 0; k < N; ++k) {
            s += r[k] * sin(2.0 * REF_PI * n * k / N);
            c += r[k] * cos(2.0 * REF_PI * n * k / N);
        }
        amplitude[n] = hypot(s, c) * (n > 0 ? 2.0 : 1.0) / N;
    }
}

static double size_of(const signature *g, double current, double speed)
{
    double r[N], sum = 0.0;
    residual(g, current, speed, r);
    for (int k = 0; k < N; ++k)
        sum += r[k] * r[k];
    return sqrt(sum / N);
}

static void name_of(const signature *g, char text[96])
{
    snprintf(text, 96, "%s %s (machine %d)", g->effect, g->parameter, (int)g->machine);
}

/* ---- tests ---- */

/* The effects are small, so that what is of second order in them is below a thousandth of the largest. */
static void test_orders(void)
{
    for (size_t j = 0; j < sizeof TABLE / sizeof *TABLE; ++j) {
        double r[N], amplitude[MOST + 1], largest = 0.0;
        char name[96];
        bool expected[MOST + 1] = {false};
        name_of(&TABLE[j], name);
        residual(&TABLE[j], 3.0, 50.0, r);
        spectrum(r, amplitude);
        for (size_t k = 0; k < TABLE[j].count; ++k)
            expected[(int)(P * TABLE[j].orders[k])] = true;
        for (int n = 0; n <= MOST; ++n)
            largest = fmax(largest, amplitude[n]);
        TEST_ASSERT_TRUE_MESSAGE(largest > 1e-9, name);
        for (int n = 0; n <= MOST && TABLE[j].count > 0; ++n)
            TEST_ASSERT_TRUE_MESSAGE(expected[n] == (amplitude[n] > 2e-3 * largest), name);
    }
}

/* Exponent: slope of log r over log x; a hundredth of the exponent is what second-order parts of the effect
 * change. */
static void test_growth_with_current(void)
{
    for (size_t j = 0; j < sizeof TABLE / sizeof *TABLE; ++j) {
        char name[96];
        name_of(&TABLE[j], name);
        if (TABLE[j].by_current == ANY) continue;
        const double slope = log2(size_of(&TABLE[j], 4.0, 50.0) / size_of(&TABLE[j], 2.0, 50.0));
        TEST_ASSERT_DOUBLE_WITHIN_MESSAGE(0.01, TABLE[j].by_current, slope, name);
    }
}

static void test_growth_with_speed(void)
{
    for (size_t j = 0; j < sizeof TABLE / sizeof *TABLE; ++j) {
        char name[96];
        name_of(&TABLE[j], name);
        const double slope = log2(size_of(&TABLE[j], 3.0, 60.0) / size_of(&TABLE[j], 3.0, 30.0));
        TEST_ASSERT_DOUBLE_WITHIN_MESSAGE(0.01, TABLE[j].by_speed, slope, name);
    }
}

/* Coulomb friction has the sign of the speed, which is what tells it from a mean torque. */
static void test_sign_of_friction(void)
{
    static const char *const LAW[] = {"coulomb", "viscous", "quadratic"};
    for (int k = 0; k < 3; ++k) {
        const signature g = {"friction", LAW[k], 0.0, 0.01, SINE, 0, 0, 1, {0}};
        double ahead[N], back[N];
        residual(&g, 3.0, 50.0, ahead);
        residual(&g, 3.0, -50.0, back);
        TEST_ASSERT_TRUE(ahead[0] < 0.0);
        TEST_ASSERT_DOUBLE_WITHIN(1e-12, -ahead[0], back[0]);
    }
}

/* Every type is in the table. */
static void test_every_effect_has_a_signature(void)
{
    const hci_effect_type *type;
    for (size_t k = 0; (type = hci_effect_type_at(k)) != NULL; ++k) {
        bool found = false;
        for (size_t j = 0; j < sizeof TABLE / sizeof *TABLE; ++j)
            found = found || strcmp(TABLE[j].effect, type->name) == 0;
        TEST_ASSERT_TRUE_MESSAGE(found, type->name);
    }
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_orders);
    RUN_TEST(test_growth_with_current);
    RUN_TEST(test_growth_with_speed);
    RUN_TEST(test_sign_of_friction);
    RUN_TEST(test_every_effect_has_a_signature);
    return UNITY_END();
}
