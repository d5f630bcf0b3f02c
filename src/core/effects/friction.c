/* Friction and drag between the air gap and the torque sensor. Positive values brake. */
#include "core/effects/type.h"

enum { COULOMB, VISCOUS, QUADRATIC };

static const hci_effect_parameter PARAMETER[] = {
    HCI_PLAIN("coulomb", "Nm", "with the sign of the speed", 0.0, -DBL_MAX, HCI_PARAMETER_LINEAR),
    HCI_PLAIN("viscous", "Nms_per_rad", "in proportion to the speed", 0.0, -DBL_MAX,
              HCI_PARAMETER_LINEAR | HCI_PARAMETER_WITH_SPEED),
    HCI_PLAIN("quadratic", "Nms2_per_rad2", "with the square of the speed", 0.0, -DBL_MAX,
              HCI_PARAMETER_LINEAR | HCI_PARAMETER_WITH_SPEED),
};

static double law(size_t parameter, double speed)
{
    if (parameter == COULOMB) return (speed > 0.0) - (speed < 0.0);
    return parameter == VISCOUS ? speed : speed * fabs(speed);
}

static double torque(const hci_effect *effect, const hci_effect_term *term, const hci_machine *machine,
                     const hci_sample *truth, hci_effect_torque *sum)
{
    (void)effect;
    (void)machine;
    const double braking = law(term->parameter, truth->speed_rad_per_s);
    sum->torque_Nm -= term->value * braking;
    return -braking;
}

static double coulomb_Nm(const hci_effect *effect)
{
    return hci_effect_value(effect, COULOMB);
}

static double drag_Nm(const hci_effect *effect, const hci_plant_state *state)
{
    const double speed = state->speed_rad_per_s;
    return hci_effect_value(effect, VISCOUS) * law(VISCOUS, speed) +
           hci_effect_value(effect, QUADRATIC) * law(QUADRATIC, speed);
}

static double modify(const hci_effect *effect, const hci_plant_state *plant, double step_s, double *memory,
                     double value, double theta_m_rad)
{
    (void)step_s;
    (void)memory;
    (void)theta_m_rad;
    if (!plant) return value;
    const double speed = plant->speed_rad_per_s;
    return value - coulomb_Nm(effect) * law(COULOMB, speed) - drag_Nm(effect, plant);
}

/* All of the law that the speeds can tell: a part left out would go into the others. */
static void propose(const hci_effect_survey *survey, const hci_effect_proposals *to)
{
    if (survey->moving || survey->timed) hci_effect_propose(to, COULOMB, survey->speeds, 0.0, 1.0, 0.0);
}

static void propose_alike(const hci_machine *machine, double slots, const hci_effect_proposals *to)
{
    (void)machine;
    (void)slots;
    hci_effect_propose(to, COULOMB, 2, 0.0, 1.0, 0.0);
}

const hci_effect_type hci_effect_friction = {
    .name = "friction",
    .title = "friction",
    .equation = "T = −(T_c sign ω + B ω + Q ω |ω|)",
    .signature = "mean only; with the sign, the value and the square of the speed",
    HCI_EFFECT_PARAMETERS(PARAMETER),
    .needs = HCI_EFFECT_NEEDS_SPEED,
    .without = "without a speed friction and delays are left out",
    .told_by = "the other direction of rotation, or three speeds",
    .propose = propose,
    .propose_alike = propose_alike,
    .torque = torque,
    .drag_Nm = drag_Nm,
    .coulomb_Nm = coulomb_Nm,
    .modify_torque = modify,
};
