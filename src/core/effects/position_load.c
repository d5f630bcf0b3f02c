/* An angle that turns with the load: an encoder behind a soft shaft, or an observer whose error grows with
 * the current. */
#include "core/effects/type.h"
#include "core/math/sine_cosine.h"
#include "hci/machine/frames.h"

enum { PER_AMPERE };

static const hci_effect_parameter PARAMETER[] = {
    HCI_PLAIN("per_ampere", "rad_per_A", "electrical angle that is read too much for each ampere of i_q", 0.0,
              -DBL_MAX, HCI_PARAMETER_WITH_CURRENT),
};

/* The currents at an angle, and how i_q grows with each phase. */
typedef struct {
    double d, q, by_current[3];
} currents;

/* ∂i_q/∂i_s = ⅔ sin(θ − 2πs/3) */
static currents currents_at(int pole_pairs, double theta_m_rad, const double i[3])
{
    const hci_alpha_beta x = hci_clarke(i);
    double s, c;
    hci_sine_cosine(pole_pairs * theta_m_rad, &s, &c);
    currents y = {-x.alpha * c - x.beta * s, x.alpha * s - x.beta * c, {0.0}};
    hci_phases_add(2.0 / 3.0 * s, 2.0 / 3.0 * c, 1, y.by_current);
    return y;
}

static void sense(const hci_effect *effect, int pole_pairs, hci_sample *x)
{
    const double q = currents_at(pole_pairs, x->theta_m_rad, x->i_abc).q;
    x->theta_m_rad += hci_effect_value(effect, PER_AMPERE) * q / pole_pairs;
}

/* A step below this leaves its square times κ i_q/2, which is rounding. */
#define LAST_STEP_RAD 1e-7

enum { STEPS_MOST = 12 };

/* θ_m + κ i_q(p θ_m)/p = reading by Newton's method, ∂i_q/∂θ = −i_d. */
static void undo(const hci_effect *effect, int pole_pairs, hci_sample *x)
{
    const double per_ampere = hci_effect_value(effect, PER_AMPERE), reading = x->theta_m_rad;
    double change = per_ampere == 0.0 ? 0.0 : 1.0, theta = reading;
    for (int k = 0; k < STEPS_MOST && fabs(change) > LAST_STEP_RAD; ++k) {
        const currents i = currents_at(pole_pairs, theta, x->i_abc);
        change = (reading - theta - per_ampere * i.q / pole_pairs) / (1.0 - per_ampere * i.d);
        theta += change;
    }
    x->theta_m_rad = theta;
}

/* dθ_m (1 − κ i_d) = d reading − i_q dκ/p − κ/p Σ ∂i_q/∂i_s di_s */
static void undo_adjoint(const hci_effect *effect, int pole_pairs, const hci_sample *before,
                         const hci_sample *after, hci_effect_torque *by, double *by_value)
{
    (void)before;
    const double per_ampere = hci_effect_value(effect, PER_AMPERE);
    const currents i = currents_at(pole_pairs, after->theta_m_rad, after->i_abc);
    by->by_angle /= 1.0 - per_ampere * i.d;
    for (size_t s = 0; s < 3; ++s)
        by->by_current[s] -= by->by_angle * per_ampere / pole_pairs * i.by_current[s];
    for (size_t k = 0; k < effect->count; ++k)
        by_value[k] = -by->by_angle * i.q / pole_pairs;
}

/* memory: the pole pairs, which a channel is not told. */
static double modify(const hci_effect *effect, const hci_plant_state *plant, double step_s, double *memory,
                     double value, double theta_m_rad)
{
    const int pole_pairs = (int)memory[0];
    double i[3];
    (void)step_s;
    hci_plane_to_abc(plant->i, i);
    return value +
           hci_effect_value(effect, PER_AMPERE) * currents_at(pole_pairs, theta_m_rad, i).q / pole_pairs;
}

static void simulate(const hci_effect *effect, int pole_pairs, hci_sensor *sensors,
                     hci_effect_channel *channels)
{
    const hci_effect_link link = {modify, effect, {(double)pole_pairs}};
    (void)sensors;
    hci_effect_link_add(&channels[HCI_SENSE_ANGLE], &link);
}

#define EXPECTED_RAD 0.1 /* at the largest current */

static void propose(const hci_effect_survey *survey, const hci_effect_proposals *to)
{
    if (survey->current_A > 0.0)
        hci_effect_propose(to, PER_AMPERE, 1, 0.0, 2.0, EXPECTED_RAD / survey->current_A);
}

static const hci_effect_correction CORRECTION[] = {HCI_CORRECT_ANGLE_LOAD};

const hci_effect_type hci_effect_position_load = {
    .name = "position_load",
    .title = "an angle that turns with the load",
    .equation = "θ_read = θ + κ i_q",
    .signature = "∂T/∂θ times i_q, at every order: grows with the square of the current, as reluctance does",
    HCI_EFFECT_PARAMETERS(PARAMETER),
    .correction = CORRECTION,
    .is_small = true,
    .turns_angle = true,
    .in_series = true, /* in iron that saturates the flux turns with the load */
    .seen_as = &hci_effect_reluctance,
    .told_by = "another current i_d",
    .propose = propose,
    .sense = sense,
    .undo = undo,
    .keeps_currents = true,
    .undo_adjoint = undo_adjoint,
    .simulate = simulate,
};
