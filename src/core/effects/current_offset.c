/* Current sensors whose zero is off. */
#include "core/effects/phase_rates.h"
#include "core/effects/type.h"

#include <math.h>

static const hci_effect_parameter PARAMETER[] = {
    HCI_PLAIN("a", "A", "read too much in phase a", 0.0, -DBL_MAX, 0),
    HCI_PLAIN("b", "A", "read too much in phase b", 0.0, -DBL_MAX, 0),
    HCI_PLAIN("c", "A", "read too much in phase c", 0.0, -DBL_MAX, 0),
};

/* What stands still in the phases turns against the rotor. */
static void add(const hci_effect *effect, double sign, int pole_pairs, hci_sample *x)
{
    if (x->switched_off) return;
    const hci_phase_rates rates = hci_phase_rates_of(pole_pairs, x);
    for (size_t s = 0; s < 3; ++s)
        x->i_abc[s] += sign * hci_effect_value(effect, s);
    hci_effect_compute_phase(x->computed_phase, x->i_abc);
    hci_phase_rates_set(pole_pairs, &rates, x);
}

static void sense(const hci_effect *effect, int pole_pairs, hci_sample *x)
{
    add(effect, 1.0, pole_pairs, x);
}

static void undo(const hci_effect *effect, int pole_pairs, hci_sample *x)
{
    add(effect, -1.0, pole_pairs, x);
}

static void undo_adjoint(const hci_effect *effect, int pole_pairs, const hci_sample *before,
                         const hci_sample *after, hci_effect_torque *by, double *by_value)
{
    (void)after;
    if (before->switched_off) {
        for (size_t k = 0; k < effect->count; ++k)
            by_value[k] = 0.0;
        return;
    }
    hci_phase_rates_adjoint_set(pole_pairs, before, by);
    hci_effect_compute_phase_adjoint(before->computed_phase, by->by_current);
    hci_effect_compute_phase_adjoint(before->computed_phase, by->by_change);
    hci_effect_compute_phase_adjoint(before->computed_phase, by->by_curvature);
    for (size_t k = 0; k < effect->count; ++k)
        by_value[k] = -by->by_current[effect->term[k].parameter];
    hci_phase_rates_adjoint_of(pole_pairs, before, by);
}

static void simulate(const hci_effect *effect, int pole_pairs, hci_sensor *sensors,
                     hci_effect_channel *channels)
{
    (void)pole_pairs;
    (void)channels;
    for (size_t s = 0; s < 3; ++s)
        sensors[HCI_SENSE_IA + s].offset += hci_effect_value(effect, s);
}

static double sum_by_value(const hci_effect_term *term, const hci_sample *truth)
{
    (void)term;
    return truth->switched_off ? 0.0 : 1.0;
}

#define EXPECTED                                                                                             \
    0.05 /* of the largest current; what stands still while the rotor turns may all be theirs                \
          */

static void propose(const hci_effect_survey *survey, const hci_effect_proposals *to)
{
    hci_effect_propose_phases(to, fmax(EXPECTED * survey->current_A, survey->standing_current_A));
}

static void propose_alike(const hci_machine *machine, double slots, const hci_effect_proposals *to)
{
    (void)machine;
    (void)slots;
    hci_effect_propose(to, 0, 2, 0.0, 1.0, 0.0);
}

static const hci_effect_correction CORRECTION[] = {HCI_CORRECT_CURRENT_ZERO, HCI_CORRECT_CURRENT_ZERO,
                                                   HCI_CORRECT_CURRENT_ZERO};

const hci_effect_type hci_effect_current_offset = {
    .name = "current_offset",
    .title = "zeros of the current sensors",
    .equation = "i_s,read = i_s + o_s",
    .signature = "independent of the load; order 1 and its sidebands with the back-EMF",
    HCI_EFFECT_PARAMETERS(PARAMETER),
    .correction = CORRECTION,
    .is_small = true,
    .told_by = "a torque transducer and currents of their own",
    .sum_by_value = sum_by_value,
    .propose = propose,
    .propose_alike = propose_alike,
    .sense = sense,
    .undo = undo,
    .undo_adjoint = undo_adjoint,
    .simulate = simulate,
};
