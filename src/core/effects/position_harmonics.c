/* The errors of a sensor that makes the angle of a sine and a cosine: a resolver, or magnetic and optical
 * encoders between their lines. Within each period of its own, offsets of sine and cosine make an error of
 * order 1, unequal amplitudes and an angle between them that is no right one an error of order 2, a third
 * harmonic of the two one of order 4 (D. C. Hanselman, Resolver signal requirements for high accuracy
 * resolver-to-digital conversion, IEEE Trans. Industrial Electronics 37(6), 1990, p. 556): with s = (1 + a)
 * sin θ + o, c = cos θ,
 *
 *     θ_read = atan2(s, c) = θ + o cos θ + a/2 sin 2θ + …
 *
 * Orders and angles are electrical here, as of a resolver with as many pole pairs as the machine; a sensor
 * with m periods in a mechanical turn has the orders k m/p. */
#include "core/effects/angle_error.h"

enum { SINE };

static const hci_effect_parameter PARAMETER[] = {
    HCI_ORDERED("sine", "rad", "electrical angle, of sin nθ", 1e-6, 0),
    HCI_ORDERED("cosine", "rad", "electrical angle, of cos nθ", 1e-6, 0),
};

static void sense(const hci_effect *effect, int pole_pairs, hci_sample *x)
{
    x->theta_m_rad += hci_angle_error_at(effect, pole_pairs, x->theta_m_rad).value;
}

static void undo(const hci_effect *effect, int pole_pairs, hci_sample *x)
{
    hci_angle_error_undo(effect, pole_pairs, x);
}

static void undo_adjoint(const hci_effect *effect, int pole_pairs, const hci_sample *before,
                         const hci_sample *after, hci_effect_torque *by, double *by_value)
{
    (void)before;
    hci_angle_error_undo_adjoint(effect, pole_pairs, after, by, by_value);
}

/* memory: the pole pairs, which a channel is not told. */
static double modify(const hci_effect *effect, const hci_plant_state *plant, double step_s, double *memory,
                     double value, double theta_m_rad)
{
    (void)plant;
    (void)step_s;
    return value + hci_angle_error_at(effect, (int)memory[0], theta_m_rad).value;
}

static void simulate(const hci_effect *effect, int pole_pairs, hci_sensor *sensors,
                     hci_effect_channel *channels)
{
    const hci_effect_link link = {modify, effect, {(double)pole_pairs}};
    (void)sensors;
    hci_effect_link_add(&channels[HCI_SENSE_ANGLE], &link);
}

#define EXPECTED_RAD 0.05

static const double OF_RESOLVER[] = {1.0, 2.0, 4.0};
enum { RESOLVER_ORDERS = sizeof OF_RESOLVER / sizeof *OF_RESOLVER, ECCENTRIC_MOST = 2 };

/* Whether an order is one of a resolver's, or once or twice a turn, which position_eccentricity is. */
static bool is_named(double order, int pole_pairs)
{
    bool named = order * pole_pairs < ECCENTRIC_MOST + 0.5;
    for (size_t k = 0; k < RESOLVER_ORDERS; ++k)
        named = named || order == OF_RESOLVER[k];
    return named;
}

/* Of a sensor with as many periods as the machine; with one pole pair orders 1 and 2 are those of
 * position_eccentricity. Of one with other periods, orders that stand out. */
static void propose(const hci_effect_survey *survey, const hci_effect_proposals *to)
{
    const int p = survey->machine->pole_pairs;
    for (size_t k = p == 1 ? 2 : 0; k < RESOLVER_ORDERS; ++k)
        hci_effect_propose(to, SINE, 2, OF_RESOLVER[k], RESOLVER_ORDERS, EXPECTED_RAD);
    for (size_t k = 0; k < survey->angle_orders; ++k)
        if (!is_named(survey->angle_order[k], p))
            hci_effect_propose(to, SINE, 2, survey->angle_order[k], survey->orders, EXPECTED_RAD);
}

static const hci_effect_correction CORRECTION[] = {HCI_CORRECT_ANGLE_SINE, HCI_CORRECT_ANGLE_COSINE};

const hci_effect_type hci_effect_position_harmonics = {
    .name = "position_harmonics",
    .title = "errors of the angle within a turn",
    .equation = "θ_read = θ + Σ S sin nθ + C cos nθ",
    .signature = "the orders of the sensor around every order, as ∂T/∂θ modulated",
    HCI_EFFECT_PARAMETERS(PARAMETER),
    .correction = CORRECTION,
    .is_small = true,
    .propose = propose,
    .sense = sense,
    .undo = undo,
    .keeps_currents = true,
    .undo_adjoint = undo_adjoint,
    .simulate = simulate,
};
