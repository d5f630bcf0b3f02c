/* Current and voltage over the angle, and as orders, against the equations of a machine in the rotor frame.
 */
#include "host/drive/turn_samples.h"

#include <math.h>
#include <string.h>

#include "support/draws.h"
#include "support/effect_list.h"
#include "unity.h"

static const double R_ohm = 0.7, L_d = 2e-3, L_q = 3.5e-3, E = 0.12;
static const hci_wave EMF = {1.0, 1, 0.12, 0.0};

static hci_machine_model model, own;
static hci_turn_samples x;
static hci_note note;

/* i_q = 4 A, i_d = −3 A: i_a = i_q sin θ − i_d cos θ; and harmonics. */
static const hci_wave WAVES[] = {
    {1.0, 1, 4.0, 3.0}, {5.0, -1, 0.4, -0.2}, {7.0, 1, -0.3, 0.1}, {2.5, 1, 0.05, 0.02}};

void setUp(void)
{
    hci_machine_data m;
    memset(&m, 0, sizeof m);
    m.model.pole_pairs = 2;
    m.model.back_emf = &EMF;
    m.model.back_emf_count = 1;
    m.resistance_ohm = R_ohm;
    m.inductance_d_H = L_d;
    m.inductance_q_H = L_q;
    memset(&note, 0, sizeof note);
    TEST_ASSERT_EQUAL_INT_MESSAGE(HCI_OK, hci_machine_model_make(&m, &model, &note), note.text);
    TEST_ASSERT_EQUAL_INT(HCI_OK, hci_machine_model_make_constant(&m, &own, &note));
}

void tearDown(void)
{
    hci_turn_samples_release(&x);
    hci_machine_model_release(&model);
    hci_machine_model_release(&own);
}

static void make(size_t waves)
{
    const hci_loop_level level = {0.5, WAVES, waves};
    TEST_ASSERT_EQUAL_INT_MESSAGE(HCI_OK, hci_turn_samples_make(&model, &own, &level, &x, &note), note.text);
}

/* The derivative by the electrical angle of value v, from its orders. */
static double slope(int v, double theta)
{
    double sum = 0.0;
    for (size_t k = 0; k < 40; ++k) {
        const hci_harmonic *h = &x.order[v][k];
        sum += h->order * (h->sine * cos(h->order * theta) - h->cosine * sin(h->order * theta));
    }
    return sum;
}

/* v_d = L_d di_d/dθ − L_q i_q, v_q = L_q di_q/dθ + L_d i_d + E/p; the decoupling adds what is no derivative.
 */
static void test_voltages_of_the_rotor_frame(void)
{
    for (size_t waves = 3; waves <= 4; ++waves) {
        make(waves);
        TEST_ASSERT_EQUAL_UINT64(waves == 4 ? 2 : 1, x.turns); /* order 5/2 repeats with the second */
        TEST_ASSERT_EQUAL_UINT64(2048 * x.turns, x.samples);
        for (size_t k = 0; k < x.samples; k += 7) {
            const double theta = 2.0 * REF_PI * (double)(x.turns * k) / (double)x.samples;
            const double id = x.value[HCI_TURN_CURRENT][k], iq = x.value[HCI_TURN_CURRENT + 1][k];
            double a = 0.0;
            for (size_t w = 0; w < waves; ++w)
                a += WAVES[w].sine * sin(WAVES[w].order * theta) +
                     WAVES[w].cosine * cos(WAVES[w].order * theta);
            TEST_ASSERT_DOUBLE_WITHIN(1e-11, a, iq * sin(theta) - id * cos(theta));
            TEST_ASSERT_DOUBLE_WITHIN(1e-9, L_d * slope(HCI_TURN_CURRENT, theta) - L_q * iq,
                                      x.value[HCI_TURN_VOLTAGE][k]);
            TEST_ASSERT_DOUBLE_WITHIN(1e-9, L_q * slope(HCI_TURN_CURRENT + 1, theta) + L_d * id + E / 2.0,
                                      x.value[HCI_TURN_VOLTAGE + 1][k]);
            TEST_ASSERT_DOUBLE_WITHIN(1e-9, -L_q * iq, x.value[HCI_TURN_OWN][k]);
            TEST_ASSERT_DOUBLE_WITHIN(1e-9, L_d * id + E / 2.0, x.value[HCI_TURN_OWN + 1][k]);
        }
        TEST_ASSERT_DOUBLE_WITHIN(1e-12, -3.0, x.order[HCI_TURN_CURRENT][0].cosine);
        TEST_ASSERT_DOUBLE_WITHIN(1e-12, 4.0, x.order[HCI_TURN_CURRENT + 1][0].cosine);
        if (waves == 3) hci_turn_samples_release(&x);
    }
}

/* Iron that saturates: W' = C i_d i_q² makes fluxes ψ_d = 2/3 C i_q² and ψ_q = 4/3 C i_d i_q, of which the
 * voltage has dψ_d/dθ − ψ_q and dψ_q/dθ + ψ_d. */
static void test_voltage_of_saturated_iron(void)
{
    static const double C = -2e-3;
    el_list effects;
    memset(&effects, 0, sizeof effects);
    el_add(&effects, "saturation", "d1q2_cosine", 0.0, C);
    model.effects = &effects.list;
    make(3);
    for (size_t k = 0; k < x.samples; k += 7) {
        const double theta = 2.0 * REF_PI * (double)k / (double)x.samples;
        const double id = x.value[HCI_TURN_CURRENT][k], iq = x.value[HCI_TURN_CURRENT + 1][k];
        const double d = slope(HCI_TURN_CURRENT, theta), q = slope(HCI_TURN_CURRENT + 1, theta);
        TEST_ASSERT_DOUBLE_WITHIN(1e-8, L_d * d - L_q * iq + 4.0 / 3.0 * C * iq * q - 4.0 / 3.0 * C * id * iq,
                                  x.value[HCI_TURN_VOLTAGE][k]);
        TEST_ASSERT_DOUBLE_WITHIN(
            1e-8, L_q * q + L_d * id + E / 2.0 + 4.0 / 3.0 * C * (d * iq + id * q) + 2.0 / 3.0 * C * iq * iq,
            x.value[HCI_TURN_VOLTAGE + 1][k]);
    }
}

/* Sinusoidal currents: √3 of the phase amplitude between phases, twice of it without zero sequence. */
static void test_dc_link_of_a_sine(void)
{
    const double w = 800.0, d = R_ohm * -3.0 - w * L_q * 4.0, q = R_ohm * 4.0 + w * (L_d * -3.0 + E / 2.0);
    make(1);
    TEST_ASSERT_DOUBLE_WITHIN(2e-6 * hypot(d, q), sqrt(3.0) * hypot(d, q),
                              hci_turn_samples_dc_link_V(&x, R_ohm, HCI_MODULATION_SPACE_VECTOR, w));
    TEST_ASSERT_DOUBLE_WITHIN(4e-6 * hypot(d, q), 2.0 * hypot(d, q),
                              hci_turn_samples_dc_link_V(&x, R_ohm, HCI_MODULATION_SINUSOIDAL, w));
    TEST_ASSERT_DOUBLE_WITHIN(1e-9 * hypot(d, q), sqrt(3.0) * hypot(d, q),
                              hci_turn_samples_dc_link_V(&x, R_ohm, HCI_MODULATION_CIRCLE, w));
}

static void test_orders_that_do_not_repeat_are_refused(void)
{
    const hci_wave third = {1.0 / 3.0, 1, 1.0, 0.0};
    const hci_loop_level level = {0.5, &third, 1};
    TEST_ASSERT_EQUAL_INT(HCI_ERROR_INPUT, hci_turn_samples_make(&model, NULL, &level, &x, &note));
    TEST_ASSERT_NOT_NULL(strstr(note.text, "0.333333 is no multiple of 1/2"));
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_voltages_of_the_rotor_frame);
    RUN_TEST(test_voltage_of_saturated_iron);
    RUN_TEST(test_dc_link_of_a_sine);
    RUN_TEST(test_orders_that_do_not_repeat_are_refused);
    return UNITY_END();
}
