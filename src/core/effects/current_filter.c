/* A first-order low pass in the channels of the currents: τ di_read/dt + i_read = i. Solved for the true
 * current it needs no history, only how fast the reading changes. In the rotor frame, with c the rate of
 * change there and J a turn by a quarter (the zero sequence stands still),
 *
 *     i = i_read + τ (c_read + pω J i_read)        c = c_read + τ (c'_read + pω J c_read)
 *
 * and c' as it is read, since the next derivative is not known. Like a delay of τ as long as pωτ is small,
 * and smaller by 1/sqrt(1 + (pωτ)²) as well. */
#include "core/effects/phase_rates.h"
#include "core/effects/type.h"

enum { TIME_CONSTANT };

static const hci_effect_parameter PARAMETER[] = {
    HCI_PLAIN("time_constant", "s", "of the low pass, the same in each phase; 0: none", 0.0, 0.0,
              HCI_PARAMETER_WITH_SPEED),
};

/* x = r + τ (rate + w J r), in place of r. rate: NULL for 0. */
static void lead(double r[3], const double *rate, double tau_s, double w)
{
    double turned[3];
    hci_phase_quarter(r, turned);
    for (int s = 0; s < 3; ++s)
        r[s] += tau_s * ((rate ? rate[s] : 0.0) + w * turned[s]);
}

/* The inverse: (1 + τ w J) r = x − τ rate, (1 + τ w J)⁻¹ = (1 − τ w J)/(1 + (τ w)²) but for the zero
 * sequence. */
static void lag(double x[3], const double *rate, double tau_s, double w)
{
    double turned[3], zero;
    for (int s = 0; s < 3; ++s)
        x[s] -= tau_s * rate[s];
    hci_phase_quarter(x, turned);
    zero = (x[0] + x[1] + x[2]) / 3.0;
    for (int s = 0; s < 3; ++s)
        x[s] = zero + (x[s] - zero - tau_s * w * turned[s]) / (1.0 + tau_s * w * tau_s * w);
}

static void sense(const hci_effect *effect, int pole_pairs, hci_sample *x)
{
    const double tau_s = hci_effect_value(effect, TIME_CONSTANT), w = pole_pairs * x->speed_rad_per_s;
    lag(x->change_A_per_s, x->curvature_A_per_s2, tau_s, w);
    lag(x->i_abc, x->change_A_per_s, tau_s, w);
}

static void undo(const hci_effect *effect, int pole_pairs, hci_sample *x)
{
    const double tau_s = hci_effect_value(effect, TIME_CONSTANT), w = pole_pairs * x->speed_rad_per_s;
    lead(x->i_abc, x->change_A_per_s, tau_s, w);
    lead(x->change_A_per_s, x->curvature_A_per_s2, tau_s, w);
}

/* x·(rate + w J r) */
static double along(const double x[3], const double rate[3], const double r[3], double w)
{
    double turned[3], sum = 0.0;
    hci_phase_quarter(r, turned);
    for (int s = 0; s < 3; ++s)
        sum += x[s] * (rate[s] + w * turned[s]);
    return sum;
}

/* Jᵀ = −J. */
static void undo_adjoint(const hci_effect *effect, int pole_pairs, const hci_sample *before,
                         const hci_sample *after, hci_effect_torque *by, double *by_value)
{
    (void)after;
    const double tau_s = hci_effect_value(effect, TIME_CONSTANT);
    const double w = pole_pairs * before->speed_rad_per_s;
    const double by_tau = along(by->by_current, before->change_A_per_s, before->i_abc, w) +
                          along(by->by_change, before->curvature_A_per_s2, before->change_A_per_s, w);
    for (size_t k = 0; k < effect->count; ++k)
        by_value[k] = by_tau;
    for (int s = 0; s < 3; ++s)
        by->by_curvature[s] += tau_s * by->by_change[s];
    lead(by->by_change, by->by_current, tau_s, -w);
    lead(by->by_current, NULL, tau_s, -w);
}

/* By the trapezoidal rule. memory: 1 once started, the last input, the output. */
static double modify(const hci_effect *effect, const hci_plant_state *plant, double step_s, double *memory,
                     double value, double theta_m_rad)
{
    const double tau_s = hci_effect_value(effect, TIME_CONSTANT), half_s = 0.5 * step_s;
    (void)plant;
    (void)theta_m_rad;
    if (memory[0] > 0.0)
        memory[2] = (memory[2] * (tau_s - half_s) + half_s * (memory[1] + value)) / (tau_s + half_s);
    else
        memory[2] = value;
    memory[0] = 1.0;
    memory[1] = value;
    return memory[2];
}

static void simulate(const hci_effect *effect, int pole_pairs, hci_sensor *sensors,
                     hci_effect_channel *channels)
{
    const hci_effect_link link = {modify, effect, {0.0}};
    (void)pole_pairs;
    (void)sensors;
    if (!(hci_effect_value(effect, TIME_CONSTANT) > 0.0)) return;
    for (int s = HCI_SENSE_IA; s <= HCI_SENSE_IC; ++s)
        hci_effect_link_add(&channels[s], &link);
}

#define EXPECTED_S 1e-3

/* At one speed it is a position offset and gains. */
static void propose(const hci_effect_survey *survey, const hci_effect_proposals *to)
{
    if (survey->timed && survey->speeds > 1) hci_effect_propose(to, TIME_CONSTANT, 1, 0.0, 2.0, EXPECTED_S);
}

static const hci_effect_correction CORRECTION[] = {HCI_CORRECT_CURRENT_FILTER};

const hci_effect_type hci_effect_current_filter = {
    .name = "current_filter",
    .title = "a filter of the current",
    .equation = "τ di_read/dt + i_read = i",
    .signature = "a phase in proportion to order and speed like a delay, and smaller currents at high speed",
    HCI_EFFECT_PARAMETERS(PARAMETER),
    .correction = CORRECTION,
    .needs = HCI_EFFECT_NEEDS_SPEED | HCI_EFFECT_NEEDS_RATE,
    .without = "without a speed friction and delays are left out",
    .told_by = "a speed at which the delay is an eighth of an electrical period or more",
    .seen_as = &hci_effect_channel_delay,
    .propose = propose,
    .sense = sense,
    .undo = undo,
    .undo_adjoint = undo_adjoint,
    .simulate = simulate,
};
