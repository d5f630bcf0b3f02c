/* Drag of the iron that grows with the load. The loss in iron is k_h f B² + k_e f² B² (C. P. Steinmetz, On
 * the law of hysteresis, 1892, here with his exponent at 2; G. Bertotti, General properties of power losses
 * in soft ferromagnetic materials, IEEE Trans. Magnetics 24(1), 1988, p. 621). Divided by the speed it is a
 * torque: that of hysteresis does not depend on the speed, that of eddy currents is in proportion to it. The
 * flux of the currents adds to that of the magnets, on the average over a turn as squares:
 *
 *     T = −(H sign ω + E ω) |i|²        |i|² = i_d² + i_q²
 *
 * What the magnets alone make is part of friction. It is drag between the air gap and the torque sensor, and
 * no torque of a co-energy. */
#include "core/effects/type.h"

#include "hci/machine/frames.h"

enum { HYSTERESIS, EDDY };

static const hci_effect_parameter PARAMETER[] = {
    HCI_PLAIN("hysteresis", "Nm_per_A2", "with the sign of the speed", 0.0, -DBL_MAX,
              HCI_PARAMETER_LINEAR | HCI_PARAMETER_WITH_CURRENT),
    HCI_PLAIN("eddy", "Nms_per_rad_A2", "in proportion to the speed", 0.0, -DBL_MAX,
              HCI_PARAMETER_LINEAR | HCI_PARAMETER_WITH_CURRENT),
};

static double law(size_t parameter, double speed)
{
    return parameter == HYSTERESIS ? (speed > 0.0) - (speed < 0.0) : speed;
}

/* ∂|i|²/∂i_s = 4/3 i_s without the zero sequence. */
static double torque(const hci_effect *effect, const hci_effect_term *term, const hci_machine *machine,
                     const hci_sample *truth, hci_effect_torque *sum)
{
    const hci_alpha_beta i = hci_clarke(truth->i_abc);
    const double braking = law(term->parameter, truth->speed_rad_per_s);
    const double square = i.alpha * i.alpha + i.beta * i.beta;
    (void)effect;
    (void)machine;
    sum->torque_Nm -= term->value * braking * square;
    for (int s = 0; s < 3; ++s)
        sum->by_current[s] -= term->value * braking * 4.0 / 3.0 * (truth->i_abc[s] - i.zero);
    return -braking * square;
}

/* x·x is 3/2 |i|² in the orthonormal plane. */
static double drag_Nm(const hci_effect *effect, const hci_plant_state *state)
{
    const double speed = state->speed_rad_per_s, *x = state->i;
    const double by_speed = hci_effect_value(effect, HYSTERESIS) * law(HYSTERESIS, speed) +
                            hci_effect_value(effect, EDDY) * speed;
    return by_speed * 2.0 / 3.0 * (x[0] * x[0] + x[1] * x[1]);
}

static double modify(const hci_effect *effect, const hci_plant_state *plant, double step_s, double *memory,
                     double value, double theta_m_rad)
{
    (void)step_s;
    (void)memory;
    (void)theta_m_rad;
    return plant ? value - drag_Nm(effect, plant) : value;
}

#define EXPECTED 0.05 /* of the largest torque, at the largest current */

/* In one direction it is an even power of the current like those of reluctance and saturation: both
 * directions under load tell them apart, since those keep their sign. */
static void propose(const hci_effect_survey *survey, const hci_effect_proposals *to)
{
    const double square = survey->current_A * survey->current_A;
    if (!survey->loaded_both_ways || !(square > 0.0)) return;
    hci_effect_propose(to, HYSTERESIS, 1, 0.0, 2.0, EXPECTED * survey->torque_Nm / square);
    if (survey->speeds > 1) hci_effect_propose(to, EDDY, 1, 0.0, 2.0, 0.0);
}

const hci_effect_type hci_effect_iron_drag = {
    .name = "iron_drag",
    .title = "drag of the iron",
    .equation = "T = −(H sign ω + E ω) (i_d² + i_q²)",
    .signature = "mean only; grows with the square of the current and has the sign of the speed",
    HCI_EFFECT_PARAMETERS(PARAMETER),
    .needs = HCI_EFFECT_NEEDS_SPEED,
    .without = "without a speed the drag of the iron is left out",
    .told_by = "the other direction of rotation at the same current",
    .propose = propose,
    .torque = torque,
    .drag_Nm = drag_Nm,
    .modify_torque = modify,
};
