/* What repeats with the mechanical turn: an eccentric rotor, uneven magnets, gear mesh. */
#include "effect_room.h"

#include "hci/frames.h"

enum { SINE, COSINE, IQ_SINE, IQ_COSINE };

static const hci_effect_parameter PARAMETER[] = {
    HCI_ORDERED("sine", "Nm", "of sin nθ", 1e-6),
    HCI_ORDERED("cosine", "Nm", "of cos nθ", 1e-6),
    HCI_ORDERED("iq_sine", "Nm_per_A", "of i_q sin nθ", 1e-6),
    HCI_ORDERED("iq_cosine", "Nm_per_A", "of i_q cos nθ", 1e-6),
};

/* i_q as a back-EMF: ∂i_q/∂i_s = ⅔ sin(θ − 2πs/3). */
static double of_current(const hci_effect_term *term, int pole_pairs, double k, const hci_sample *truth,
                         hci_effect_torque *sum)
{
    const double theta_m = truth->theta_m_rad;
    const hci_effect_oscillation f = hci_effect_oscillate(term->parameter == IQ_COSINE, k, k * theta_m);
    double e[3], slope[3];
    for (int s = 0; s < 3; ++s) {
        const hci_effect_oscillation q =
            hci_effect_oscillate(false, pole_pairs, pole_pairs * theta_m - 2.0 * HCI_PI * s / 3.0);
        e[s] = 2.0 / 3.0 * f.value * q.value;
        slope[s] = 2.0 / 3.0 * (f.slope * q.value + f.value * q.slope);
    }
    return hci_effect_add_emf(sum, term->value, e, slope, truth->i_abc);
}

static double torque(const hci_effect *effect, const hci_effect_term *term, const hci_machine *machine,
                     const hci_sample *truth, hci_effect_torque *sum)
{
    (void)effect;
    const double k = hci_effect_periods(term->order, machine->pole_pairs);
    if (term->parameter >= IQ_SINE) return of_current(term, machine->pole_pairs, k, truth, sum);
    const hci_effect_oscillation f =
        hci_effect_oscillate(term->parameter == COSINE, k, k * truth->theta_m_rad);
    sum->torque_Nm += term->value * f.value;
    sum->by_angle += term->value * f.slope;
    return f.value;
}

const hci_effect_room hci_effect_mechanical_order = {
    .name = "mechanical_order",
    .equation = "T = Σ (S + S_q i_q) sin nθ + (C + C_q i_q) cos nθ, n = k/p",
    .signature = "fractional electrical orders, independent of the current or in proportion to it",
    HCI_EFFECT_PARAMETERS(PARAMETER),
    .in_machine = true,
    .torque = torque,
};
