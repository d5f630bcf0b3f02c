/* Magnets weaken when they are hot: all of the declared back-EMF in proportion. */
#include "core/effects/type.h"

enum { PER_KELVIN, REFERENCE };

#define EXPECTED_PER_KELVIN 0.003 /* ferrite 0.002, neodymium 0.001, samarium-cobalt 0.0004 */

static const hci_effect_parameter PARAMETER[] = {
    HCI_PLAIN("emf_per_kelvin", "1/K", "relative change of the back-EMF, below 0 for magnets", 0.0, -DBL_MAX,
              HCI_PARAMETER_LINEAR | HCI_PARAMETER_WITH_CURRENT),
    HCI_PLAIN("reference", "C", "temperature of the declared back-EMF", 20.0, -DBL_MAX,
              HCI_PARAMETER_WITH_CURRENT),
};

static double torque(const hci_effect *effect, const hci_effect_term *term, const hci_machine *machine,
                     const hci_sample *truth, hci_effect_torque *sum)
{
    const double reference = hci_effect_value(effect, REFERENCE);
    const double rise = isnan(truth->temperature_C) ? 0.0 : truth->temperature_C - reference;
    hci_effect_torque unused = {0};
    double e[3], slope[3];
    hci_torque_back_emf_at(machine, machine->pole_pairs * truth->theta_m_rad, e, slope);
    if (term->parameter == PER_KELVIN)
        return rise * hci_effect_add_emf(sum, rise * term->value, e, slope, truth->i_abc);
    if (isnan(truth->temperature_C)) return 0.0;
    return -hci_effect_value(effect, PER_KELVIN) * hci_effect_add_emf(&unused, 1.0, e, slope, truth->i_abc);
}

static void propose(const hci_effect_survey *survey, const hci_effect_proposals *to)
{
    if (survey->has_temperature) hci_effect_propose(to, PER_KELVIN, 1, 0.0, 1.0, EXPECTED_PER_KELVIN);
}

const hci_effect_type hci_effect_magnet_temperature = {
    .name = "magnet_temperature",
    .title = "warm magnets",
    .equation = "T = α (ϑ − ϑ_0) e(θ)·i",
    .signature = "grows with the current; mean and all orders together, follows the temperature",
    HCI_EFFECT_PARAMETERS(PARAMETER),
    .needs = HCI_EFFECT_NEEDS_TEMPERATURE,
    .without = "without a temperature the magnets are at the reference",
    .propose = propose,
    .is_small = true,
    .in_machine = true,
    .torque = torque,
};
