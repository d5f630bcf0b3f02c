/* An encoder that is not centred: the reading runs ahead and behind within a mechanical turn. Orders are
 * those of the mechanical turn, and so is the angle. */
#include "core/effects/type.h"

enum { SINE, COSINE };

static const hci_effect_parameter PARAMETER[] = {
    HCI_WHOLE("mech_sine", "rad", "mechanical angle, of sin kθ_m", 1.0, 0),
    HCI_WHOLE("mech_cosine", "rad", "mechanical angle, of cos kθ_m", 1.0, 0),
};

/* E(θ_m) = Σ S sin kθ_m + C cos kθ_m */
static hci_effect_oscillation error_at(const hci_effect *effect, double theta_m_rad)
{
    hci_effect_oscillation sum = {0.0, 0.0};
    hci_effect_turn turn = {HCI_EFFECT_NO_TURN, 0.0, 0.0};
    for (size_t j = 0; j < effect->count; ++j) {
        const hci_effect_term *t = &effect->term[j];
        hci_effect_turn_to(&turn, t->order, 1, theta_m_rad);
        const hci_effect_oscillation f = hci_effect_oscillate(&turn, t->parameter == COSINE);
        sum.value += t->value * f.value;
        sum.slope += t->value * f.slope;
    }
    return sum;
}

static void sense(const hci_effect *effect, int pole_pairs, hci_sample *x)
{
    (void)pole_pairs;
    x->theta_m_rad += error_at(effect, x->theta_m_rad).value;
}

enum { STEPS_MOST = 50 };

/* θ + E(θ) = reading by Newton's method; there is one solution while |E'| < 1. */
static void undo(const hci_effect *effect, int pole_pairs, hci_sample *x)
{
    (void)pole_pairs;
    const double reading = x->theta_m_rad;
    double change = 1.0, theta = reading;
    for (int k = 0; k < STEPS_MOST && fabs(change) > 1e-15 * (1.0 + fabs(reading)); ++k) {
        const hci_effect_oscillation error = error_at(effect, theta);
        change = (reading - theta - error.value) / (1.0 + error.slope);
        theta += change;
    }
    x->theta_m_rad = theta;
}

/* θ + E(θ) = reading: ∂θ/∂reading = 1/(1 + E'), ∂θ/∂S = −sin kθ/(1 + E'). */
static void undo_adjoint(const hci_effect *effect, int pole_pairs, const hci_sample *before,
                         hci_effect_torque *by, double *by_value)
{
    hci_sample after = *before;
    undo(effect, pole_pairs, &after);
    by->by_angle /= 1.0 + error_at(effect, after.theta_m_rad).slope;
    hci_effect_turn turn = {HCI_EFFECT_NO_TURN, 0.0, 0.0};
    for (size_t j = 0; j < effect->count; ++j) {
        const hci_effect_term *t = &effect->term[j];
        hci_effect_turn_to(&turn, t->order, 1, after.theta_m_rad);
        by_value[j] = -by->by_angle * hci_effect_oscillate(&turn, t->parameter == COSINE).value;
    }
}

static double modify(const hci_effect *effect, const hci_plant_state *plant, double step_s, double *memory,
                     double value, double theta_m_rad)
{
    (void)plant;
    (void)step_s;
    (void)memory;
    return value + error_at(effect, theta_m_rad).value;
}

static void simulate(const hci_effect *effect, int pole_pairs, hci_sensor *sensors,
                     hci_effect_channel *channels)
{
    const hci_effect_link link = {modify, effect, {0.0}};
    (void)pole_pairs;
    (void)sensors;
    hci_effect_link_add(&channels[HCI_SENSE_ANGLE], &link);
}

enum { ORDERS = 2 }; /* out of centre, and a ring that is no circle */

#define EXPECTED_RAD 0.03

static void propose(const hci_effect_survey *survey, const hci_effect_proposals *to)
{
    for (int n = 1; n <= ORDERS && survey->has_turn; ++n)
        hci_effect_propose(to, SINE, 2, n, ORDERS, EXPECTED_RAD);
}

const hci_effect_type hci_effect_position_eccentricity = {
    .name = "position_eccentricity",
    .equation = "θ_m,read = θ_m + Σ S sin kθ_m + C cos kθ_m",
    .signature = "mechanical orders 1 and 2 around every order, as ∂T/∂θ modulated",
    HCI_EFFECT_PARAMETERS(PARAMETER),
    .propose = propose,
    .sense = sense,
    .undo = undo,
    .undo_adjoint = undo_adjoint,
    .simulate = simulate,
};
