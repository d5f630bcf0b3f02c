/* Phases with more or fewer turns: each declared back-EMF by its own factor. */
#include "core/effects/type.h"

static const hci_effect_parameter PARAMETER[] = {
    HCI_PLAIN("a", "1", "back-EMF of phase a, relative change", 0.0, -DBL_MAX,
              HCI_PARAMETER_LINEAR | HCI_PARAMETER_WITH_CURRENT),
    HCI_PLAIN("b", "1", "back-EMF of phase b, relative change", 0.0, -DBL_MAX,
              HCI_PARAMETER_LINEAR | HCI_PARAMETER_WITH_CURRENT),
    HCI_PLAIN("c", "1", "back-EMF of phase c, relative change", 0.0, -DBL_MAX,
              HCI_PARAMETER_LINEAR | HCI_PARAMETER_WITH_CURRENT),
};

static void torque_of_all(const hci_effect *effect, const hci_machine *machine, const hci_sample *truth,
                          hci_effect_torque *sum, double *by_value)
{
    double e[3], slope[3];
    hci_torque_back_emf_at(machine, machine->pole_pairs * truth->theta_m_rad, e, slope);
    for (size_t k = 0; k < effect->count; ++k) {
        const size_t s = effect->term[k].parameter;
        const double value = effect->term[k].value, by = e[s] * truth->i_abc[s];
        sum->torque_Nm += value * by;
        sum->by_current[s] += value * e[s];
        sum->by_angle += value * slope[s] * truth->i_abc[s];
        if (by_value) by_value[k] = by;
    }
}

#define EXPECTED 0.2 /* of the back-EMF */

static void propose(const hci_effect_survey *survey, const hci_effect_proposals *to)
{
    (void)survey;
    hci_effect_propose_phases(to, EXPECTED);
}

static void propose_alike(const hci_machine *machine, double slots, const hci_effect_proposals *to)
{
    (void)machine;
    (void)slots;
    hci_effect_propose_phases(to, EXPECTED);
}

const hci_effect_type hci_effect_phase_imbalance = {
    .name = "phase_imbalance",
    .title = "phases that differ",
    .equation = "T = Σ_s g_s e_s(θ) i_s",
    .signature = "grows with the current; mean and order 2 for sinusoidal currents",
    HCI_EFFECT_PARAMETERS(PARAMETER),
    .is_small = true,
    .when_equal = &hci_effect_back_emf,
    .propose = propose,
    .propose_alike = propose_alike,
    .in_machine = true,
    .torque_of_all = torque_of_all,
};
