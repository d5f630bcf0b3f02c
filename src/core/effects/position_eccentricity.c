/* An encoder that is not centred: the reading runs ahead and behind within a mechanical turn. Orders are
 * those of the mechanical turn, and so is the angle. */
#include "core/effects/angle_error.h"

enum { SINE };

static const hci_effect_parameter PARAMETER[] = {
    HCI_WHOLE("mech_sine", "rad", "mechanical angle, of sin kθ_m", 1.0, 0),
    HCI_WHOLE("mech_cosine", "rad", "mechanical angle, of cos kθ_m", 1.0, 0),
};

static void sense(const hci_effect *effect, int pole_pairs, hci_sample *x)
{
    (void)pole_pairs;
    x->theta_m_rad += hci_angle_error_at(effect, 1, x->theta_m_rad).value;
}

static void undo(const hci_effect *effect, int pole_pairs, hci_sample *x)
{
    (void)pole_pairs;
    hci_angle_error_undo(effect, 1, x);
}

static void undo_adjoint(const hci_effect *effect, int pole_pairs, const hci_sample *before,
                         const hci_sample *after, hci_effect_torque *by, double *by_value)
{
    (void)before;
    (void)pole_pairs;
    hci_angle_error_undo_adjoint(effect, 1, after, by, by_value);
}

static double modify(const hci_effect *effect, const hci_plant_state *plant, double step_s, double *memory,
                     double value, double theta_m_rad)
{
    (void)plant;
    (void)step_s;
    (void)memory;
    return value + hci_angle_error_at(effect, 1, theta_m_rad).value;
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

/* Out of centre, as a mounted encoder is. */
static void propose_alike(const hci_machine *machine, double slots, const hci_effect_proposals *to)
{
    (void)machine;
    (void)slots;
    hci_effect_propose(to, SINE, 2, 1.0, 1.0, EXPECTED_RAD);
}

static const hci_effect_correction CORRECTION[] = {HCI_CORRECT_TURN_SINE, HCI_CORRECT_TURN_COSINE};

const hci_effect_type hci_effect_position_eccentricity = {
    .name = "position_eccentricity",
    .title = "an eccentric encoder",
    .equation = "θ_m,read = θ_m + Σ S sin kθ_m + C cos kθ_m",
    .signature = "mechanical orders 1 and 2 around every order, as ∂T/∂θ modulated",
    HCI_EFFECT_PARAMETERS(PARAMETER),
    .correction = CORRECTION,
    .is_small = true,
    .propose = propose,
    .propose_alike = propose_alike,
    .sense = sense,
    .undo = undo,
    .keeps_currents = true,
    .undo_adjoint = undo_adjoint,
    .simulate = simulate,
};
