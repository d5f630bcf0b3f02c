/* What friction is more at low speed, where the film of the lubricant has not formed yet, in Gauss's form of
 * Stribeck's curve (B. Armstrong-Hélouvry, P. Dupont and C. Canudas de Wit, A survey of models, analysis
 * tools and compensation methods for the control of machines with friction, Automatica 30(7), 1994, p. 1083):
 *
 *     T = −T_s e^{−(ω/ω_s)²} sign ω
 *
 * on top of the constant and the viscous part, which are those of friction. A simulated shaft has constant
 * Coulomb friction and smooth drag: T_s is the former, −T_s (1 − e^{−(ω/ω_s)²}) sign ω the latter. */
#include "core/effects/type.h"

enum { EXCESS, SPEED };

static const hci_effect_parameter PARAMETER[] = {
    HCI_PLAIN("excess", "Nm", "at rest beyond the Coulomb friction", 0.0, -DBL_MAX,
              HCI_PARAMETER_LINEAR | HCI_PARAMETER_WITH_SPEED),
    HCI_PLAIN("speed", "rad_per_s", "mechanical speed at which it has fallen to 37 %", 1.0, 1e-6,
              HCI_PARAMETER_WITH_SPEED),
};

static double sign_of(double speed)
{
    return (speed > 0.0) - (speed < 0.0);
}

static double torque(const hci_effect *effect, const hci_effect_term *term, const hci_machine *machine,
                     const hci_sample *truth, hci_effect_torque *sum)
{
    const double of = hci_effect_value(effect, SPEED), u = truth->speed_rad_per_s / of;
    const double braking = exp(-u * u) * sign_of(truth->speed_rad_per_s);
    (void)machine;
    if (term->parameter == SPEED) return -hci_effect_value(effect, EXCESS) * braking * 2.0 * u * u / of;
    sum->torque_Nm -= term->value * braking;
    return -braking;
}

static double coulomb_Nm(const hci_effect *effect)
{
    return hci_effect_value(effect, EXCESS);
}

static double drag_Nm(const hci_effect *effect, const hci_plant_state *state)
{
    const double u = state->speed_rad_per_s / hci_effect_value(effect, SPEED);
    return hci_effect_value(effect, EXCESS) * expm1(-u * u) * sign_of(u);
}

static double modify(const hci_effect *effect, const hci_plant_state *plant, double step_s, double *memory,
                     double value, double theta_m_rad)
{
    (void)step_s;
    (void)memory;
    (void)theta_m_rad;
    if (!plant) return value;
    return value - coulomb_Nm(effect) * sign_of(plant->speed_rad_per_s) - drag_Nm(effect, plant);
}

static void simulate(const hci_effect *effect, int pole_pairs, hci_sensor *sensors,
                     hci_effect_channel *channels)
{
    const hci_effect_link link = {modify, effect, {0.0}};
    (void)pole_pairs;
    (void)sensors;
    hci_effect_link_add(&channels[HCI_SENSE_TORQUE], &link);
}

const hci_effect_type hci_effect_stribeck_friction = {
    .name = "stribeck_friction",
    .equation = "T = −T_s e^{−(ω/ω_s)²} sign ω",
    .signature = "mean only; with the sign of the speed, and gone above some speed",
    HCI_EFFECT_PARAMETERS(PARAMETER),
    .needs = HCI_EFFECT_NEEDS_SPEED,
    .without = "without a speed friction and delays are left out",
    .told_by = "four speeds, two of them below that at which the friction is least",
    .torque = torque,
    .drag_Nm = drag_Nm,
    .coulomb_Nm = coulomb_Nm,
    .simulate = simulate,
};
