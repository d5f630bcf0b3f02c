/* Current sensors whose zero is off. */
#include "core/effects/type.h"

static const hci_effect_parameter PARAMETER[] = {
    HCI_PLAIN("a", "A", "read too much in phase a", 0.0, -DBL_MAX),
    HCI_PLAIN("b", "A", "read too much in phase b", 0.0, -DBL_MAX),
    HCI_PLAIN("c", "A", "read too much in phase c", 0.0, -DBL_MAX),
};

static void sense(const hci_effect *effect, int pole_pairs, hci_sample *x)
{
    (void)pole_pairs;
    for (size_t s = 0; s < 3; ++s)
        x->i_abc[s] += hci_effect_value(effect, s);
}

static void undo(const hci_effect *effect, int pole_pairs, hci_sample *x)
{
    (void)pole_pairs;
    for (size_t s = 0; s < 3; ++s)
        x->i_abc[s] -= hci_effect_value(effect, s);
}

static void undo_adjoint(const hci_effect *effect, int pole_pairs, const hci_sample *before,
                         hci_effect_torque *by, double *by_value)
{
    (void)pole_pairs;
    (void)before;
    for (size_t k = 0; k < effect->count; ++k)
        by_value[k] = -by->by_current[effect->term[k].parameter];
}

static void simulate(const hci_effect *effect, int pole_pairs, hci_sensor *sensors,
                     hci_effect_channel *channels)
{
    (void)pole_pairs;
    (void)channels;
    for (size_t s = 0; s < 3; ++s)
        sensors[HCI_SENSE_IA + s].offset += hci_effect_value(effect, s);
}

const hci_effect_type hci_effect_current_offset = {
    .name = "current_offset",
    .equation = "i_s,read = i_s + o_s",
    .signature = "independent of the load; order 1 and its sidebands with the back-EMF",
    HCI_EFFECT_PARAMETERS(PARAMETER),
    .sense = sense,
    .undo = undo,
    .undo_adjoint = undo_adjoint,
    .simulate = simulate,
};
