/* Cogging torque that is not declared. */
#include "effect_room.h"

enum { SINE, COSINE };

static const hci_effect_parameter PARAMETER[] = {
    HCI_ORDERED("sine", "Nm", "of sin nθ", 1e-6),
    HCI_ORDERED("cosine", "Nm", "of cos nθ", 1e-6),
};

static double torque(const hci_effect *effect, const hci_effect_term *term, const hci_machine *machine,
                     const hci_sample *truth, hci_effect_torque *sum)
{
    (void)effect;
    const double k = hci_effect_periods(term->order, machine->pole_pairs);
    const hci_effect_oscillation f =
        hci_effect_oscillate(term->parameter == COSINE, k, k * truth->theta_m_rad);
    sum->torque_Nm += term->value * f.value;
    sum->by_angle += term->value * f.slope;
    return f.value;
}

const hci_effect_room hci_effect_cogging = {
    .name = "cogging",
    .equation = "T = Σ S sin nθ + C cos nθ",
    .signature = "independent of current and speed, at any order",
    HCI_EFFECT_PARAMETERS(PARAMETER),
    .in_machine = true,
    .torque = torque,
};
