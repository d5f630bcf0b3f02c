/* The rotor between the air gap and the torque sensor: where the speed varies, a part of the torque turns the
 * rotor and does not reach the sensor.
 *
 *     T_read = T − J dω/dt
 */
#include "core/effects/type.h"

enum { INERTIA };

static const hci_effect_parameter PARAMETER[] = {
    HCI_PLAIN("inertia", "kgm2", "of all that turns between the air gap and the sensor", 0.0, 0.0,
              HCI_PARAMETER_LINEAR | HCI_PARAMETER_WITH_SPEED | HCI_PARAMETER_OF_TRANSDUCER),
};

static double torque(const hci_effect *effect, const hci_effect_term *term, const hci_machine *machine,
                     const hci_sample *truth, hci_effect_torque *sum)
{
    (void)effect;
    (void)machine;
    sum->torque_Nm -= term->value * truth->acceleration_rad_per_s2;
    return -truth->acceleration_rad_per_s2;
}

/* memory: the speed a step ago, and 1 where there is one. */
static double modify(const hci_effect *effect, const hci_plant_state *plant, double step_s, double *memory,
                     double value, double theta_m_rad)
{
    (void)theta_m_rad;
    if (!plant) return value;
    const double change = memory[1] * (plant->speed_rad_per_s - memory[0]);
    memory[0] = plant->speed_rad_per_s;
    memory[1] = 1.0;
    return value - hci_effect_value(effect, INERTIA) * change / step_s;
}

/* Where the shaft speeds up alike all along, an inertia is what a friction is, which every machine has and
 * which takes up to two values more: it has to be better, and not shorter alone. */
#define BESIDE_FRICTION 1e5

static void propose(const hci_effect_survey *survey, const hci_effect_proposals *to)
{
    if (survey->acceleration_rad_per_s2 > 0.0) hci_effect_propose(to, INERTIA, 1, 0.0, BESIDE_FRICTION, 0.0);
}

const hci_effect_type hci_effect_rotor_inertia = {
    .name = "rotor_inertia",
    .title = "the inertia of the rotor",
    .equation = "T_read = T − J dω/dt",
    .signature =
        "follows the acceleration; grows with the square of the speed where that varies with the angle",
    HCI_EFFECT_PARAMETERS(PARAMETER),
    .needs = HCI_EFFECT_NEEDS_TIME | HCI_EFFECT_NEEDS_SPEED | HCI_EFFECT_NEEDS_ACCELERATION,
    .without = "without time and speed the inertia before the torque sensor is left out",
    .told_by = "a run that speeds up and slows down without current",
    .propose = propose,
    .torque = torque,
    .modify_torque = modify,
};
