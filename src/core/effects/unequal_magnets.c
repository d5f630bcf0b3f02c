/* Magnets that are not equal, or of which some are demagnetised: the flux in the air gap is 1 + M(θ_m) times
 * what it should be, with M of orders k/p. Torque with the currents is in proportion to the flux and cogging
 * to its square (L. Gašparin, A. Černigoj, S. Markič and R. Fišer, Additional cogging torque components in
 * permanent- magnet motors due to manufacturing imperfections, IEEE Trans. Magnetics 45(3), 2009, p. 1210),
 * so that to first order
 *
 *     T = M (e·i + 2 T_cog)        M = Σ S sin nθ + C cos nθ,  n = k/p
 *
 * of the declared back-EMF and cogging at once. e and T_cog have no part of the orders of M, so that M e has
 * a co-energy and M T_cog does no work over a turn. */
#include "core/effects/type.h"

enum { SINE, MOST_ALIKE = 2 };

static const hci_effect_parameter PARAMETER[] = {
    HCI_ORDERED("sine", "1", "relative change of the flux, of sin nθ", 1e-6, HCI_PARAMETER_LINEAR),
    HCI_ORDERED("cosine", "1", "relative change of the flux, of cos nθ", 1e-6, HCI_PARAMETER_LINEAR),
};

/* M and its derivative by θ_m; by_value: out, ∂M/∂value of each term, or NULL. */
static hci_effect_oscillation change_at(const hci_effect *effect, int pole_pairs, double theta_m_rad,
                                        double *by_value)
{
    hci_effect_oscillation sum = {0.0, 0.0};
    hci_turning turn = HCI_TURNING;
    for (size_t k = 0; k < effect->count; ++k) {
        const hci_effect_term *term = &effect->term[k];
        hci_effect_turn_to(&turn, term->order, pole_pairs, theta_m_rad);
        const hci_effect_oscillation f = hci_effect_oscillate(&turn, term->parameter % 2 == 1);
        sum.value += term->value * f.value;
        sum.slope += term->value * f.slope;
        if (by_value) by_value[k] = f.value;
    }
    return sum;
}

static void torque_of_all(const hci_effect *effect, const hci_machine *machine, const hci_sample *truth,
                          hci_effect_torque *sum, double *by_value)
{
    const double none[3] = {0.0, 0.0, 0.0}, theta_rad = machine->pole_pairs * truth->theta_m_rad;
    const hci_torque_slopes cogging = hci_torque_slopes_at(machine, theta_rad, none);
    const hci_effect_oscillation m = change_at(effect, machine->pole_pairs, truth->theta_m_rad, by_value);
    double e[3], e_by_angle[3], torque = 2.0 * cogging.torque_Nm, by_angle = 2.0 * cogging.by_angle;
    hci_torque_back_emf_at(machine, theta_rad, e, e_by_angle);
    for (int s = 0; s < 3; ++s) {
        torque += e[s] * truth->i_abc[s];
        by_angle += e_by_angle[s] * truth->i_abc[s];
        sum->by_current[s] += m.value * e[s];
    }
    sum->torque_Nm += m.value * torque;
    sum->by_angle += m.slope * torque + m.value * by_angle;
    for (size_t k = 0; by_value && k < effect->count; ++k)
        by_value[k] *= torque;
}

#define EXPECTED 0.1

/* Where load and cogging do not tell the same it is not this. */
static void propose(const hci_effect_survey *survey, const hci_effect_proposals *to)
{
    for (size_t k = 0; k < survey->flux_orders; ++k)
        hci_effect_propose(to, SINE, 2, survey->flux_order[k], survey->machine->pole_pairs, EXPECTED);
}

/* Once and twice a turn; and as often as there are slots, each of which a weak magnet passes: coils in series
 * leave only that. Where it is a whole electrical order, any machine may have it. */
static void propose_alike(const hci_machine *machine, double slots, const hci_effect_proposals *to)
{
    const double of_slots = slots / machine->pole_pairs;
    for (int k = 1; k < machine->pole_pairs && k <= MOST_ALIKE; ++k)
        hci_effect_propose(to, SINE, 2, (double)k / machine->pole_pairs, 1.0, EXPECTED);
    if (slots > MOST_ALIKE && fmod(of_slots, 1.0) != 0.0)
        hci_effect_propose(to, SINE, 2, of_slots, 1.0, EXPECTED);
}

const hci_effect_type hci_effect_unequal_magnets = {
    .name = "unequal_magnets",
    .title = "unequal magnets",
    .equation = "T = (e(θ)·i + 2 T_cog(θ)) Σ S sin nθ + C cos nθ, n = k/p",
    .signature = "fractional electrical orders around the mean and those of cogging at once",
    HCI_EFFECT_PARAMETERS(PARAMETER),
    .needs = HCI_EFFECT_NEEDS_TURN,
    .without =
        "the angle does not tell where in the mechanical turn the rotor was: orders k/p have any phase",
    .told_by = "no current: then only the orders around those of cogging are left",
    .is_small = true,
    .propose = propose,
    .propose_alike = propose_alike,
    .in_machine = true,
    .torque_of_all = torque_of_all,
};
