/* What repeats with the mechanical turn: an eccentric rotor, uneven magnets, gear mesh. */
#include "core/effects/type.h"

enum { SINE, IQ_SINE = 2, ID_SINE = 4 }; /* sine and cosine in turn */

static const hci_effect_parameter PARAMETER[] = {
    HCI_ORDERED("sine", "Nm", "of sin nθ", 1e-6, HCI_PARAMETER_LINEAR),
    HCI_ORDERED("cosine", "Nm", "of cos nθ", 1e-6, HCI_PARAMETER_LINEAR),
    HCI_ORDERED("iq_sine", "Nm_per_A", "of i_q sin nθ", 1e-6,
                HCI_PARAMETER_LINEAR | HCI_PARAMETER_WITH_CURRENT),
    HCI_ORDERED("iq_cosine", "Nm_per_A", "of i_q cos nθ", 1e-6,
                HCI_PARAMETER_LINEAR | HCI_PARAMETER_WITH_CURRENT),
    HCI_ORDERED("id_sine", "Nm_per_A", "of i_d sin nθ", 1e-6,
                HCI_PARAMETER_LINEAR | HCI_PARAMETER_WITH_CURRENT),
    HCI_ORDERED("id_cosine", "Nm_per_A", "of i_d cos nθ", 1e-6,
                HCI_PARAMETER_LINEAR | HCI_PARAMETER_WITH_CURRENT),
};

/* A component of the currents as a back-EMF x, and its derivative by θ_m; y: a quarter of a period ahead. */
typedef struct {
    double by_current[3], slope[3];
} component;

/* ∂i_q/∂i_s = ⅔ sin(θ − 2πs/3), ∂i_d/∂i_s = −⅔ cos(θ − 2πs/3). */
static component component_of(int pole_pairs, double x, double y)
{
    component to = {{0.0}, {0.0}};
    hci_phases_add(x, y, 1, to.by_current);
    hci_phases_add(pole_pairs * y, -pole_pairs * x, 1, to.slope);
    return to;
}

static double of_current(double value, const hci_effect_oscillation *f, const component *with,
                         const double i[3], hci_effect_torque *sum)
{
    double e[3], slope[3];
    for (int s = 0; s < 3; ++s) {
        e[s] = f->value * with->by_current[s];
        slope[s] = f->slope * with->by_current[s] + f->value * with->slope[s];
    }
    return hci_effect_add_emf(sum, value, e, slope, i);
}

static void torque_of_all(const hci_effect *effect, const hci_machine *machine, const hci_sample *truth,
                          hci_effect_torque *sum, double *by_value)
{
    hci_turning turn = HCI_TURNING;
    double s, c;
    hci_sine_cosine(machine->pole_pairs * truth->theta_m_rad, &s, &c);
    const component q = component_of(machine->pole_pairs, 2.0 / 3.0 * s, 2.0 / 3.0 * c);
    const component d = component_of(machine->pole_pairs, -2.0 / 3.0 * c, 2.0 / 3.0 * s);
    for (size_t k = 0; k < effect->count; ++k) {
        const hci_effect_term *term = &effect->term[k];
        hci_effect_turn_to(&turn, term->order, machine->pole_pairs, truth->theta_m_rad);
        const hci_effect_oscillation f = hci_effect_oscillate(&turn, term->parameter % 2 == 1);
        double by = f.value;
        if (term->parameter >= IQ_SINE) {
            by = of_current(term->value, &f, term->parameter >= ID_SINE ? &d : &q, truth->i_abc, sum);
        } else {
            sum->torque_Nm += term->value * f.value;
            sum->by_angle += term->value * f.slope;
        }
        if (by_value) by_value[k] = by;
    }
}

static void propose_with_current(const hci_effect_survey *survey, double order,
                                 const hci_effect_proposals *to)
{
    hci_effect_propose(to, IQ_SINE, 2, order, survey->orders, 0.0);
    hci_effect_propose(to, ID_SINE, 2, order, survey->orders, 0.0);
}

/* What slots and poles make without a current is cogging. */
static void propose(const hci_effect_survey *survey, const hci_effect_proposals *to)
{
    for (size_t k = 0; k < survey->turn_orders; ++k) {
        hci_effect_propose(to, SINE, 2, survey->turn_order[k], survey->orders, 0.0);
        propose_with_current(survey, survey->turn_order[k], to);
    }
    for (size_t k = 0; k < survey->load_orders; ++k)
        propose_with_current(survey, survey->load_order[k], to);
}

const hci_effect_type hci_effect_mechanical_order = {
    .name = "mechanical_order",
    .title = "orders of the mechanical turn",
    .equation = "T = Σ (S + S_q i_q + S_d i_d) sin nθ + (C + C_q i_q + C_d i_d) cos nθ, n = k/p",
    .signature = "fractional electrical orders, independent of the current or in proportion to i_q and i_d",
    HCI_EFFECT_PARAMETERS(PARAMETER),
    .any_phase = true,
    .needs = HCI_EFFECT_NEEDS_TURN,
    .without =
        "the angle does not tell where in the mechanical turn the rotor was: orders k/p have any phase",
    .propose = propose,
    .in_machine = true,
    .torque_of_all = torque_of_all,
};
