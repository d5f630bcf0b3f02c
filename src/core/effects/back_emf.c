/* A back-EMF that differs from the declared one: harmonics that are wrong or missing, and unequal phases. */
#include "core/effects/type.h"

/* Sine and cosine in turn. */
enum { SINE, COSINE, POSITIVE = 2, NEGATIVE = 4, ZERO = 6 };

#define TRAITS (HCI_PARAMETER_LINEAR | HCI_PARAMETER_WITH_CURRENT | HCI_PARAMETER_WITH_LOAD)

static const hci_effect_parameter PARAMETER[] = {
    HCI_WHOLE("sine", "Nm_per_A", "the same in each phase, of sin nθ", 1.0, TRAITS),
    HCI_WHOLE("cosine", "Nm_per_A", "the same in each phase, of cos nθ", 1.0, TRAITS),
    HCI_ORDERED("pos_sine", "Nm_per_A", "positive sequence, of sin nθ", 1e-6, TRAITS),
    HCI_ORDERED("pos_cosine", "Nm_per_A", "positive sequence, of cos nθ", 1e-6, TRAITS),
    HCI_ORDERED("neg_sine", "Nm_per_A", "negative sequence, of sin nθ", 1e-6, TRAITS),
    HCI_ORDERED("neg_cosine", "Nm_per_A", "negative sequence, of cos nθ", 1e-6, TRAITS),
    HCI_ORDERED("zero_sine", "Nm_per_A", "zero sequence, of sin nθ", 1e-6, TRAITS),
    HCI_ORDERED("zero_cosine", "Nm_per_A", "zero sequence, of cos nθ", 1e-6, TRAITS),
};

static int sequence_of(const hci_effect_term *term)
{
    if (term->parameter < POSITIVE) return hci_sequence_of_order(term->order);
    return term->parameter < NEGATIVE ? 1 : term->parameter < ZERO ? -1 : 0;
}

static void torque_of_all(const hci_effect *effect, const hci_machine *machine, const hci_sample *truth,
                          hci_effect_torque *sum, double *by_value)
{
    hci_turning turn = HCI_TURNING;
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

enum { MOST_ORDER = 25, MOST_UNBALANCED = 7 /* of sequences that a balanced machine does not have */ };

/* From how many harmonics one is chosen: those of order 6k ± 1 are usual. */
#define USUAL   8.0
#define UNUSUAL 40.0

/* Even harmonics take poles that are not alike, which the declared back-EMF shows already, unless one of the
 * magnets was weakened since. */
static bool has_even(const hci_machine *machine)
{
    for (size_t k = 0; k < machine->back_emf_count; ++k)
        if (fabs(fmod(machine->back_emf[k].order, 2.0)) < HCI_ORDER_TOLERANCE) return true;
    return false;
}

/* Of the largest wave that is declared. */
#define EXPECTED 0.3
#define UNBALANCED                                                                                           \
    0.05 /* of waves that take phases that differ: a short of some turns, a magnet that is weak */

static double largest_of(const hci_machine *machine)
{
    double most = 0.0;
    for (size_t k = 0; k < machine->back_emf_count; ++k)
        most = fmax(most, hypot(machine->back_emf[k].sine, machine->back_emf[k].cosine));
    return most;
}

/* What is the same in all three phases makes no torque where their currents add up to nothing. */
static bool can_act(const hci_effect_survey *survey, int order)
{
    return survey->has_neutral || hci_sequence_of_order(order) != 0;
}

static void propose(const hci_effect_survey *survey, const hci_effect_proposals *to)
{
    const int step = survey->poles_differ || has_even(survey->machine) ? 1 : 2;
    const double largest = largest_of(survey->machine), expected = EXPECTED * largest;
    hci_effect_propose(to, SINE, 1, 1.0, 2.0, expected);
    hci_effect_propose(to, COSINE, 1, 1.0, 2.0, expected);
    for (int n = 1 + step; n <= MOST_ORDER; n += step)
        if (can_act(survey, n))
            hci_effect_propose(to, SINE, 2, n, n % 6 == 1 || n % 6 == 5 ? USUAL : UNUSUAL, expected);
    for (int n = 1; n <= MOST_UNBALANCED; n += step) {
        const int sequence = hci_sequence_of_order(n);
        if (sequence != 1) hci_effect_propose(to, POSITIVE, 2, n, UNUSUAL, UNBALANCED * largest);
        if (sequence != -1) hci_effect_propose(to, NEGATIVE, 2, n, UNUSUAL, UNBALANCED * largest);
    }
}

/* W' = 3/2 E i/(p n) of a back-EMF E of order n; a balanced machine has 6k ± 1. */
static void propose_coenergy(const hci_effect_coenergy_series *series, const hci_effect_proposals *to)
{
    const double unit = series->pole_pairs / (1.5 * series->reference_current_A);
    for (int n = 1; n <= series->order; n += n % 6 == 1 ? 4 : 2)
        hci_effect_propose_coenergy(to, series->unlike ? COSINE : SINE, 1, n, n * unit);
}

const hci_effect_type hci_effect_back_emf = {
    .name = "back_emf",
    .title = "back-EMF",
    .equation = "T = Σ_s i_s Σ [S sin(nθ − σ2πs/3) + C cos(nθ − σ2πs/3)], σ = n mod 3 where none is named",
    .signature =
        "grows with the current; at n ± the orders of the currents, n of another sequence at DC and order 2",
    HCI_EFFECT_PARAMETERS(PARAMETER),
    .is_small = true,
    .propose = propose,
    .propose_coenergy = propose_coenergy,
    .in_machine = true,
    .torque_of_all = torque_of_all,
};
