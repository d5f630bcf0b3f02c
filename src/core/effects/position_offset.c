/* A position sensor whose zero is not the zero of the machine's angle. */
#include "core/effects/type.h"

enum { ANGLE };

static const hci_effect_parameter PARAMETER[] = {
    HCI_PLAIN("angle", "rad", "electrical angle that is read too much", 0.0, -DBL_MAX, 0),
};

static void sense(const hci_effect *effect, int pole_pairs, hci_sample *x)
{
    x->theta_m_rad += hci_effect_value(effect, ANGLE) / pole_pairs;
}

static void undo(const hci_effect *effect, int pole_pairs, hci_sample *x)
{
    x->theta_m_rad -= hci_effect_value(effect, ANGLE) / pole_pairs;
}

static void undo_adjoint(const hci_effect *effect, int pole_pairs, const hci_sample *before,
                         const hci_sample *after, hci_effect_torque *by, double *by_value)
{
    (void)after;
    (void)before;
    for (size_t k = 0; k < effect->count; ++k)
        by_value[k] = -by->by_angle / pole_pairs;
}

static void simulate(const hci_effect *effect, int pole_pairs, hci_sensor *sensors,
                     hci_effect_channel *channels)
{
    (void)channels;
    sensors[HCI_SENSE_ANGLE].offset += hci_effect_value(effect, ANGLE) / pole_pairs;
}

#define EXPECTED_RAD 0.1

static void propose(const hci_effect_survey *survey, const hci_effect_proposals *to)
{
    (void)survey;
    hci_effect_propose(to, ANGLE, 1, 0.0, 1.0, EXPECTED_RAD);
}

static void propose_alike(const hci_machine *machine, double slots, const hci_effect_proposals *to)
{
    (void)machine;
    (void)slots;
    hci_effect_propose(to, ANGLE, 1, 0.0, 1.0, EXPECTED_RAD);
}

static const hci_effect_correction CORRECTION[] = {HCI_CORRECT_ANGLE_ZERO};

const hci_effect_type hci_effect_position_offset = {
    .name = "position_offset",
    .title = "the zero of the angle",
    .equation = "θ_read = θ + δ",
    .signature = "∂T/∂θ times a constant, at every order",
    HCI_EFFECT_PARAMETERS(PARAMETER),
    .correction = CORRECTION,
    .is_angle_zero = true,
    .turns_angle = true,
    .propose = propose,
    .propose_alike = propose_alike,
    .sense = sense,
    .undo = undo,
    .keeps_currents = true,
    .undo_adjoint = undo_adjoint,
    .simulate = simulate,
};
