/* A torque sensor that is calibrated wrong: all of the torque that reaches it by one factor, before its lag
 * and its zero. */
#include "core/effects/type.h"

enum { GAIN };

static const hci_effect_parameter PARAMETER[] = {
    HCI_PLAIN("gain", "1", "relative error of the torque that is read", 0.0, -DBL_MAX,
              HCI_PARAMETER_LINEAR | HCI_PARAMETER_OF_TRANSDUCER),
};

static void read_torque(const hci_effect *effect, double *torque_Nm, double *by_value, size_t columns,
                        size_t own_column)
{
    const double factor = 1.0 + hci_effect_value(effect, GAIN);
    for (size_t k = 0; by_value && k < columns; ++k)
        by_value[k] *= factor;
    for (size_t k = 0; by_value && k < effect->count; ++k)
        by_value[own_column + k] = *torque_Nm;
    *torque_Nm *= factor;
}

static double modify(const hci_effect *effect, const hci_plant_state *plant, double step_s, double *memory,
                     double value, double theta_m_rad)
{
    (void)plant;
    (void)step_s;
    (void)memory;
    (void)theta_m_rad;
    return value * (1.0 + hci_effect_value(effect, GAIN));
}

#define EXPECTED 0.1

/* Where cogging and the torque with the currents are not off alike, it is the magnets. */
static void propose(const hci_effect_survey *survey, const hci_effect_proposals *to)
{
    if (survey->one_gain) hci_effect_propose(to, GAIN, 1, 0.0, 1.0, EXPECTED);
}

const hci_effect_type hci_effect_torque_gain = {
    .name = "torque_gain",
    .title = "the gain of the torque sensor",
    .equation = "T_read = (1 + g) T",
    .signature = "all torque by one factor: that of the currents and cogging",
    HCI_EFFECT_PARAMETERS(PARAMETER),
    .told_by = "no current: then only cogging and friction are left, which a wrong back-EMF leaves alone",
    .is_small = true,
    .seen_as = &hci_effect_back_emf,
    .propose = propose,
    .read_torque = read_torque,
    .modify_torque = modify,
};
