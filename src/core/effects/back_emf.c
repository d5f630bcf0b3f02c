/* A back-EMF that differs from the declared one: harmonics that are wrong or missing, and unequal phases. */
#include "core/effects/type.h"

/* Sine and cosine in turn. */
enum { POSITIVE = 2, NEGATIVE = 4, ZERO = 6 };

static const hci_effect_parameter PARAMETER[] = {
    HCI_WHOLE("sine", "Nm_per_A", "the same in each phase, of sin nθ", 1.0),
    HCI_WHOLE("cosine", "Nm_per_A", "the same in each phase, of cos nθ", 1.0),
    HCI_ORDERED("pos_sine", "Nm_per_A", "positive sequence, of sin nθ", 1e-6),
    HCI_ORDERED("pos_cosine", "Nm_per_A", "positive sequence, of cos nθ", 1e-6),
    HCI_ORDERED("neg_sine", "Nm_per_A", "negative sequence, of sin nθ", 1e-6),
    HCI_ORDERED("neg_cosine", "Nm_per_A", "negative sequence, of cos nθ", 1e-6),
    HCI_ORDERED("zero_sine", "Nm_per_A", "zero sequence, of sin nθ", 1e-6),
    HCI_ORDERED("zero_cosine", "Nm_per_A", "zero sequence, of cos nθ", 1e-6),
};

static int sequence_of(const hci_effect_term *term)
{
    if (term->parameter < POSITIVE) return hci_sequence_of_order(term->order);
    return term->parameter < NEGATIVE ? 1 : term->parameter < ZERO ? -1 : 0;
}

static void torque_of_all(const hci_effect *effect, const hci_machine *machine, const hci_sample *truth,
                          hci_effect_torque *sum, double *by_value)
{
    hci_effect_turn turn = {HCI_EFFECT_NO_TURN, 0.0, 0.0};
    for (size_t k = 0; k < effect->count; ++k) {
        const hci_effect_term *term = &effect->term[k];
        const bool cosine = term->parameter % 2 == 1;
        double e[3] = {0.0}, slope[3] = {0.0};
        hci_effect_turn_to(&turn, term->order, machine->pole_pairs, truth->theta_m_rad);
        const double x = cosine ? turn.c : turn.s, y = cosine ? -turn.s : turn.c;
        hci_phases_add(x, y, sequence_of(term), e);
        hci_phases_add(turn.k * y, -turn.k * x, sequence_of(term), slope);
        const double by = hci_effect_add_emf(sum, term->value, e, slope, truth->i_abc);
        if (by_value) by_value[k] = by;
    }
}

const hci_effect_type hci_effect_back_emf = {
    .name = "back_emf",
    .equation = "T = Σ_s i_s Σ [S sin(nθ − σ2πs/3) + C cos(nθ − σ2πs/3)], σ = n mod 3 where none is named",
    .signature =
        "grows with the current; at n ± the orders of the currents, n of another sequence at DC and order 2",
    HCI_EFFECT_PARAMETERS(PARAMETER),
    .in_machine = true,
    .torque_of_all = torque_of_all,
};
