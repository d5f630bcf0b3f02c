/* Current sensors that read too much or too little. */
#include "core/effects/phase_rates.h"
#include "core/effects/type.h"

static const hci_effect_parameter PARAMETER[] = {
    HCI_PLAIN("a", "1", "relative error of phase a", 0.0, -0.999, HCI_PARAMETER_WITH_CURRENT),
    HCI_PLAIN("b", "1", "relative error of phase b", 0.0, -0.999, HCI_PARAMETER_WITH_CURRENT),
    HCI_PLAIN("c", "1", "relative error of phase c", 0.0, -0.999, HCI_PARAMETER_WITH_CURRENT),
};

/* Each phase with its rates times its own factor. A current without a sensor has the errors of the other two.
 */
static void scale(const double factor[3], int pole_pairs, hci_sample *x)
{
    hci_phase_rates rates = hci_phase_rates_of(pole_pairs, x);
    for (size_t s = 0; s < 3; ++s) {
        x->i_abc[s] *= factor[s];
        rates.first[s] *= factor[s];
        rates.second[s] *= factor[s];
    }
    hci_effect_compute_phase(x->computed_phase, x->i_abc);
    hci_effect_compute_phase(x->computed_phase, rates.first);
    hci_effect_compute_phase(x->computed_phase, rates.second);
    hci_phase_rates_set(pole_pairs, &rates, x);
}

static void sense(const hci_effect *effect, int pole_pairs, hci_sample *x)
{
    double factor[3];
    for (size_t s = 0; s < 3; ++s)
        factor[s] = 1.0 + hci_effect_value(effect, s);
    scale(factor, pole_pairs, x);
}

static void undo(const hci_effect *effect, int pole_pairs, hci_sample *x)
{
    double factor[3];
    for (size_t s = 0; s < 3; ++s)
        factor[s] = 1.0 / (1.0 + hci_effect_value(effect, s));
    scale(factor, pole_pairs, x);
}

/* ∂i/∂g = −i_read/(1 + g)², and so the rate of change. */
static void undo_adjoint(const hci_effect *effect, int pole_pairs, const hci_sample *before,
                         const hci_sample *after, hci_effect_torque *by, double *by_value)
{
    (void)after;
    const hci_phase_rates rates = hci_phase_rates_of(pole_pairs, before);
    hci_phase_rates_adjoint_set(pole_pairs, before, by);
    hci_effect_compute_phase_adjoint(before->computed_phase, by->by_current);
    hci_effect_compute_phase_adjoint(before->computed_phase, by->by_change);
    hci_effect_compute_phase_adjoint(before->computed_phase, by->by_curvature);
    for (size_t s = 0; s < 3; ++s) {
        by->by_current[s] /= 1.0 + hci_effect_value(effect, s);
        by->by_change[s] /= 1.0 + hci_effect_value(effect, s);
        by->by_curvature[s] /= 1.0 + hci_effect_value(effect, s);
    }
    for (size_t k = 0; k < effect->count; ++k) {
        const size_t s = effect->term[k].parameter;
        const double sum = by->by_current[s] * before->i_abc[s] + by->by_change[s] * rates.first[s] +
                           by->by_curvature[s] * rates.second[s];
        by_value[k] = -sum / (1.0 + hci_effect_value(effect, s));
    }
    hci_phase_rates_adjoint_of(pole_pairs, before, by);
}

static void simulate(const hci_effect *effect, int pole_pairs, hci_sensor *sensors,
                     hci_effect_channel *channels)
{
    (void)pole_pairs;
    (void)channels;
    for (size_t s = 0; s < 3; ++s)
        sensors[HCI_SENSE_IA + s].gain_error += hci_effect_value(effect, s);
}

static double sum_by_value(const hci_effect_term *term, const hci_sample *truth)
{
    return truth->i_abc[term->parameter];
}

#define EXPECTED 0.1

static void propose(const hci_effect_survey *survey, const hci_effect_proposals *to)
{
    (void)survey;
    hci_effect_propose_phases(to, EXPECTED);
}

static const hci_effect_correction CORRECTION[] = {HCI_CORRECT_CURRENT_GAIN, HCI_CORRECT_CURRENT_GAIN,
                                                   HCI_CORRECT_CURRENT_GAIN};

const hci_effect_type hci_effect_current_gain = {
    .name = "current_gain",
    .title = "gains of the current sensors",
    .equation = "i_s,read = (1 + g_s) i_s",
    .signature = "grows with the current; order 2 and the mean",
    HCI_EFFECT_PARAMETERS(PARAMETER),
    .correction = CORRECTION,
    .is_small = true,
    .when_equal = &hci_effect_back_emf,
    .sum_by_value = sum_by_value,
    .propose = propose,
    .sense = sense,
    .undo = undo,
    .undo_adjoint = undo_adjoint,
    .simulate = simulate,
};
