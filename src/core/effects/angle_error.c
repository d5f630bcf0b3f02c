#include "core/effects/angle_error.h"

hci_effect_oscillation hci_angle_error_at(const hci_effect *effect, int periods, double theta_m_rad)
{
    hci_effect_oscillation sum = {0.0, 0.0};
    hci_turning turn = HCI_TURNING;
    for (size_t j = 0; j < effect->count; ++j) {
        const hci_effect_term *t = &effect->term[j];
        if (t->value == 0.0) continue;
        hci_effect_turn_to(&turn, t->order, periods, theta_m_rad);
        const hci_effect_oscillation f = hci_effect_oscillate(&turn, t->parameter % 2 == 1);
        sum.value += t->value * f.value / periods;
        sum.slope += t->value * f.slope / periods;
    }
    return sum;
}

/* A step below this leaves its square times E''/2, which is rounding. */
#define LAST_STEP_RAD 1e-7

enum { STEPS_MOST = 12 };

/* θ + E(θ) = reading by Newton's method; there is one solution while |E'| < 1, and where there are more the
 * steps need not end. */
void hci_angle_error_undo(const hci_effect *effect, int periods, hci_sample *x)
{
    const double reading = x->theta_m_rad;
    double change = 1.0, theta = reading;
    for (int k = 0; k < STEPS_MOST && fabs(change) > LAST_STEP_RAD; ++k) {
        const hci_effect_oscillation error = hci_angle_error_at(effect, periods, theta);
        change = (reading - theta - error.value) / (1.0 + error.slope);
        theta += change;
    }
    x->theta_m_rad = theta;
}

/* θ + E(θ) = reading: ∂θ/∂reading = 1/(1 + E'), ∂θ/∂S = −sin(n m θ)/m/(1 + E'). */
void hci_angle_error_undo_adjoint(const hci_effect *effect, int periods, const hci_sample *after,
                                  hci_effect_torque *by, double *by_value)
{
    by->by_angle /= 1.0 + hci_angle_error_at(effect, periods, after->theta_m_rad).slope;
    hci_turning turn = HCI_TURNING;
    for (size_t j = 0; j < effect->count; ++j) {
        const hci_effect_term *t = &effect->term[j];
        hci_effect_turn_to(&turn, t->order, periods, after->theta_m_rad);
        by_value[j] = -by->by_angle * hci_effect_oscillate(&turn, t->parameter % 2 == 1).value / periods;
    }
}
