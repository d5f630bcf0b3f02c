/* Cogging torque that is not declared. */
#include "core/effects/type.h"

enum { SINE, COSINE, MOST_ALIKE = 3 };

static const hci_effect_parameter PARAMETER[] = {
    HCI_ORDERED("sine", "Nm", "of sin nθ", 1e-6, HCI_PARAMETER_LINEAR),
    HCI_ORDERED("cosine", "Nm", "of cos nθ", 1e-6, HCI_PARAMETER_LINEAR),
};

static void torque_of_all(const hci_effect *effect, const hci_machine *machine, const hci_sample *truth,
                          hci_effect_torque *sum, double *by_value)
{
    hci_turning turn = HCI_TURNING;
    for (size_t k = 0; k < effect->count; ++k) {
        const hci_effect_term *term = &effect->term[k];
        hci_effect_turn_to(&turn, term->order, machine->pole_pairs, truth->theta_m_rad);
        const hci_effect_oscillation f = hci_effect_oscillate(&turn, term->parameter == COSINE);
        sum->torque_Nm += term->value * f.value;
        sum->by_angle += term->value * f.slope;
        if (by_value) by_value[k] = f.value;
    }
}

#define EXPECTED 0.3 /* of the largest torque */

/* Slots in multiples of three and pairs of poles make orders 6k: there are fewer of them to choose from. */
static double alternatives(const hci_effect_survey *survey, double order)
{
    return fmod(order, 6.0) == 0.0 ? survey->orders / 6.0 : survey->orders;
}

static void propose(const hci_effect_survey *survey, const hci_effect_proposals *to)
{
    for (size_t k = 0; k < survey->slot_orders; ++k) {
        const double order = survey->slot_order[k];
        hci_effect_propose(to, SINE, 2, order, alternatives(survey, order), EXPECTED * survey->torque_Nm);
    }
}

/* T = p n c sin nθ of W' = −c cos nθ */
static void propose_coenergy(const hci_effect_coenergy_series *series, const hci_effect_proposals *to)
{
    for (int n = 6; n <= series->order; n += 6)
        hci_effect_propose_coenergy(to, series->unlike ? COSINE : SINE, 0, n, series->pole_pairs * n);
}

/* How many declared orders are larger. */
static int rank_of(const hci_machine *machine, size_t order)
{
    int larger = 0;
    for (size_t k = 0; k < machine->cogging_count; ++k) {
        const hci_harmonic *a = &machine->cogging[k], *b = &machine->cogging[order];
        const double by = hypot(a->sine, a->cosine) - hypot(b->sine, b->cosine);
        larger += by > 0.0 || (by == 0.0 && k < order);
    }
    return larger;
}

static void propose_alike(const hci_machine *machine, double slots, const hci_effect_proposals *to)
{
    (void)slots;
    for (size_t k = 0; k < machine->cogging_count; ++k)
        if (machine->cogging[k].order > 0.0 && rank_of(machine, k) < MOST_ALIKE)
            hci_effect_propose(to, SINE, 2, machine->cogging[k].order, 1.0, 0.0);
}

const hci_effect_type hci_effect_cogging = {
    .name = "cogging",
    .title = "cogging torque",
    .equation = "T = Σ S sin nθ + C cos nθ",
    .signature = "independent of current and speed, at any order",
    HCI_EFFECT_PARAMETERS(PARAMETER),
    .any_phase = true,
    .propose = propose,
    .propose_alike = propose_alike,
    .propose_coenergy = propose_coenergy,
    .in_machine = true,
    .torque_of_all = torque_of_all,
};
