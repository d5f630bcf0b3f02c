/* Iron that saturates: e and L' depend on the current, to the third and fourth degree of the co-energy:
 *
 *     W' = Σ (S sin nθ + C cos nθ) (i_d/I_0)^a (i_q/I_0)^b      a + b = 3 or 4
 *
 * A polynomial is smooth through zero current, adds to the declared machine from the third degree on (the
 * first is the back-EMF, the second the inductance), and is linear in its coefficients. As a co-energy it is
 * integrable whatever the coefficients. The loss of mean torque with load is d1q2_cosine_0: T = p C (i_q³ − 2
 * i_d² i_q)/I_0³, the d flux weakened by i_q. Coefficients are in N·m (that is J) at the reference current
 * I_0. */
#include "effect_coenergy.h"

#define PAIR(name, meaning)                                                                                  \
    HCI_ORDERED(name "_sine", "Nm", meaning ", of sin nθ", 1e-6),                                            \
        HCI_ORDERED(name "_cosine", "Nm", meaning ", of cos nθ", 0.0)

enum { REFERENCE_CURRENT = 18 };

static const hci_effect_parameter PARAMETER[] = {
    PAIR("d3q0", "co-energy with i_d³"),
    PAIR("d2q1", "co-energy with i_d² i_q"),
    PAIR("d1q2", "co-energy with i_d i_q²"),
    PAIR("d0q3", "co-energy with i_q³"),
    PAIR("d4q0", "co-energy with i_d⁴"),
    PAIR("d3q1", "co-energy with i_d³ i_q"),
    PAIR("d2q2", "co-energy with i_d² i_q²"),
    PAIR("d1q3", "co-energy with i_d i_q³"),
    PAIR("d0q4", "co-energy with i_q⁴"),
    HCI_PLAIN("reference_current", "A", "current I_0 at which the coefficients are meant", 1.0, 1e-6),
};

static hci_coenergy_term coenergy_of(const hci_effect_term *term)
{
    const int pair = (int)(term->parameter / 2), q = pair < 4 ? pair : pair - 4;
    const hci_coenergy_term w = {term->order, term->parameter % 2 == 1, (pair < 4 ? 3 : 4) - q, q};
    return w;
}

/* ∂T/∂I_0 = −Σ (a + b) T_k / I_0 */
static double by_reference(const hci_effect *effect, double reference, int pole_pairs,
                           const hci_sample *truth)
{
    double sum = 0.0;
    for (size_t k = 0; k < effect->count; ++k) {
        hci_effect_torque unused = {0};
        if (effect->term[k].parameter == REFERENCE_CURRENT) continue;
        const hci_coenergy_term w = coenergy_of(&effect->term[k]);
        sum -= (w.d + w.q) * pow(reference, -(w.d + w.q) - 1) * effect->term[k].value *
               hci_coenergy_add(&unused, 0.0, &w, pole_pairs, truth);
    }
    return sum;
}

static double torque(const hci_effect *effect, const hci_effect_term *term, const hci_machine *machine,
                     const hci_sample *truth, hci_effect_torque *sum)
{
    const double reference = hci_effect_value(effect, REFERENCE_CURRENT);
    if (term->parameter == REFERENCE_CURRENT)
        return by_reference(effect, reference, machine->pole_pairs, truth);
    const hci_coenergy_term w = coenergy_of(term);
    const double scale = pow(reference, -(w.d + w.q));
    return scale * hci_coenergy_add(sum, scale * term->value, &w, machine->pole_pairs, truth);
}

const hci_effect_room hci_effect_saturation = {
    .name = "saturation",
    .equation = "T = ∂W'/∂θ_m, W' = Σ (S sin nθ + C cos nθ) (i_d/I_0)^a (i_q/I_0)^b",
    .signature = "grows with the third or fourth power of the current; mean torque lost with load, orders 6k",
    HCI_EFFECT_PARAMETERS(PARAMETER),
    .in_machine = true,
    .torque = torque,
};
