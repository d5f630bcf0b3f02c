/* Inductances that change with the angle, given in the rotor frame, where a balanced machine has orders 6k
 * only:
 *
 *     W' = 3/2 (½ L_dd i_d² + L_dq i_d i_q + ½ L_qq i_q²)      L = Σ S sin nθ + C cos nθ
 *
 * An inductance rather than a torque, so that any values conserve energy: a torque ½ L'_qq i_q² of order 0,
 * say, would turn a rotor for ever. Order 0 is the saliency, T = 3/2 p (L_d − L_q) i_d i_q; there only the
 * difference of dd and qq makes torque. */
#include "core/effects/coenergy.h"

/* Sine and cosine in turn. */
enum { DD = 0, DQ = 2, QQ = 4 };

static const hci_effect_parameter PARAMETER[] = {
    HCI_ORDERED("dd_sine", "H", "of L_dd, sin nθ", 1e-6, HCI_PARAMETER_LINEAR | HCI_PARAMETER_WITH_CURRENT),
    HCI_ORDERED("dd_cosine", "H", "of L_dd, cos nθ", 0.0, HCI_PARAMETER_LINEAR | HCI_PARAMETER_WITH_CURRENT),
    HCI_ORDERED("dq_sine", "H", "of L_dq, sin nθ", 1e-6, HCI_PARAMETER_LINEAR | HCI_PARAMETER_WITH_CURRENT),
    HCI_ORDERED("dq_cosine", "H", "of L_dq, cos nθ", 0.0, HCI_PARAMETER_LINEAR | HCI_PARAMETER_WITH_CURRENT),
    HCI_ORDERED("qq_sine", "H", "of L_qq, sin nθ", 1e-6, HCI_PARAMETER_LINEAR | HCI_PARAMETER_WITH_CURRENT),
    HCI_ORDERED("qq_cosine", "H", "of L_qq, cos nθ", 0.0, HCI_PARAMETER_LINEAR | HCI_PARAMETER_WITH_CURRENT),
};

static void torque_of_all(const hci_effect *effect, const hci_machine *machine, const hci_sample *truth,
                          hci_effect_torque *sum, double *by_value)
{
    hci_coenergy w;
    hci_coenergy_begin(&w, machine->pole_pairs, truth, 1.0);
    for (size_t k = 0, count; k < effect->count; k += count) {
        const int parameter = (int)effect->term[k].parameter, q = parameter / 2;
        const hci_coenergy_kind kind = {2 - q, q, parameter % 2 == 1, q == 1 ? 1.5 : 0.75};
        count = hci_coenergy_run(effect, k);
        hci_coenergy_add(&w, &kind, &effect->term[k], count, by_value ? &by_value[k] : NULL);
    }
    hci_coenergy_end(&w, sum);
}

enum { MOST_ORDER = 60, MOST_LOW_ORDER = 24 };

/* From how many terms one is chosen. */
#define USUAL       12.0
#define UNSYMMETRIC 60.0 /* of a rotor that does not look alike both ways round, or of unequal phases */

/* Where hardly any current flowed along d, noise and errors of the angle are all that there is of it, and
 * take any saliency that suits: no other one than is declared is looked for then, and of one that is not no
 * more than a rotor with magnets has, where I_0 makes a few times their flux at most. */
#define HARDLY        0.05 /* of the current */
#define EXPECTED_FLUX 3.0

/* 0: any. */
static double expected_H(const hci_effect_survey *survey)
{
    const hci_machine *m = survey->machine;
    double square = 0.0;
    for (size_t k = 0; k < m->back_emf_count; ++k)
        if (m->back_emf[k].order == 1.0)
            square +=
                m->back_emf[k].sine * m->back_emf[k].sine + m->back_emf[k].cosine * m->back_emf[k].cosine;
    return survey->along_d_A < HARDLY * survey->current_A && survey->reference_current_A > 0.0
               ? EXPECTED_FLUX * sqrt(square) / (m->pole_pairs * survey->reference_current_A)
               : 0.0;
}

/* Saliency and cross-coupling of the mean, of which the latter makes a torque that keeps its sign with the
 * load, and is told by loads of both signs alone; a rotor that looks alike both ways round has cos for dd and
 * qq and sin for dq. Where no i_d was given, L_qq' and L_dq make the same wave of i_q², and only the one is
 * looked for. */
static void propose(const hci_effect_survey *survey, const hci_effect_proposals *to)
{
    static const size_t EVEN[] = {DD + 1, QQ + 1, DQ}, ODD[] = {DD, QQ, DQ + 1};
    const int most = survey->richness > 0 ? MOST_ORDER : MOST_LOW_ORDER;
    const bool no_direct = survey->flows_d_A < HARDLY * survey->current_A;
    if (!no_direct || survey->machine->slope_count == 0)
        hci_effect_propose(to, DD + 1, 1, 0.0, 1.0, expected_H(survey));
    if (!survey->one_sided) hci_effect_propose(to, DQ + 1, 1, 0.0, 4.0, expected_H(survey));
    for (int n = 2; n <= most; n += n == 2 ? 4 : 6)
        for (int k = 0; k < 3; ++k) {
            if (k != 1 && no_direct) continue;
            hci_effect_propose(to, EVEN[k], 1, n, n == 2 ? UNSYMMETRIC : USUAL, 0.0);
            hci_effect_propose(to, ODD[k], 1, n, UNSYMMETRIC, 0.0);
        }
}

/* W' = 3/4 L i², and 3/2 for the product. The mean tells only the difference of L_dd and L_qq. */
static void propose_coenergy(const hci_effect_coenergy_series *series, const hci_effect_proposals *to)
{
    const double unit = 1.0 / (0.75 * series->reference_current_A * series->reference_current_A);
    const size_t sine = series->unlike ? 1 : 0, cosine = 1 - sine;
    for (int n = 0; n <= series->order; n += 6) {
        if (n > 0 || cosine == 1) hci_effect_propose_coenergy(to, DD + cosine, 2, n, unit);
        if (n > 0 || sine == 1) hci_effect_propose_coenergy(to, DQ + sine, 2, n, 0.5 * unit);
        if (n > 0) hci_effect_propose_coenergy(to, QQ + cosine, 2, n, unit);
    }
}

const hci_effect_type hci_effect_reluctance = {
    .name = "reluctance",
    .title = "reluctance torque",
    .equation = "T = ∂W'/∂θ_m, W' = 3/2 (½ L_dd i_d² + L_dq i_d i_q + ½ L_qq i_q²)",
    .signature = "grows with the square of the current; mean and orders 6k, order 2 with unequal phases",
    HCI_EFFECT_PARAMETERS(PARAMETER),
    .propose = propose,
    .propose_coenergy = propose_coenergy,
    .in_machine = true,
    .torque_of_all = torque_of_all,
};
