/* The zero of a torque sensor that creeps during a run, as strain gauges do while they warm up: straight in
 * time as far as a run is short beside the warming up.
 *
 *     T_read = T + D (t − t_0)        t_0: the start of the run
 */
#include "core/effects/type.h"

enum { RATE };

static const hci_effect_parameter PARAMETER[] = {
    HCI_PLAIN("rate", "Nm_per_s", "read more with every second of a run", 0.0, -DBL_MAX,
              HCI_PARAMETER_LINEAR | HCI_PARAMETER_OF_TRANSDUCER),
};

static double torque(const hci_effect *effect, const hci_effect_term *term, const hci_machine *machine,
                     const hci_sample *truth, hci_effect_torque *sum)
{
    (void)effect;
    (void)machine;
    sum->torque_Nm += term->value * truth->elapsed_s;
    return truth->elapsed_s;
}

/* memory: time since the start. */
static double modify(const hci_effect *effect, const hci_plant_state *plant, double step_s, double *memory,
                     double value, double theta_m_rad)
{
    const double drift_Nm = hci_effect_value(effect, RATE) * memory[0];
    (void)plant;
    (void)theta_m_rad;
    memory[0] += step_s;
    return value + drift_Nm;
}

#define EXPECTED 0.05 /* of the largest torque, in the longest run */

/* A mean over turns does not tell a drift from an offset: it takes a run whose turns differ along time. */
static void propose(const hci_effect_survey *survey, const hci_effect_proposals *to)
{
    if (!survey->creeps || !(survey->duration_s > 0.0)) return;
    hci_effect_propose(to, RATE, 1, 0.0, 1.0, EXPECTED * survey->torque_Nm / survey->duration_s);
}

const hci_effect_type hci_effect_torque_drift = {
    .name = "torque_drift",
    .title = "drift of the torque sensor",
    .equation = "T_read = T + D (t − t_0)",
    .signature = "follows the time of a run, not the angle",
    HCI_EFFECT_PARAMETERS(PARAMETER),
    .needs = HCI_EFFECT_NEEDS_TIME,
    .without = "without time the drift of the torque sensor's zero is left out",
    .told_by = "a longer run at the same point",
    .is_small = true,
    .propose = propose,
    .torque = torque,
    .modify_torque = modify,
};
