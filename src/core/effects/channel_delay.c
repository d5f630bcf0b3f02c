/* Channels that are read late, each by its own time: a reading at t shows what was true at t − τ. Only the
 * differences show in a residual. */
#include "core/effects/type.h"

#include "hci/machine/frames.h"

enum { CURRENT, ANGLE, TORQUE };

static const hci_effect_parameter PARAMETER[] = {
    HCI_PLAIN("current", "s", "delay of the phase currents", 0.0, -DBL_MAX, HCI_PARAMETER_WITH_SPEED),
    HCI_PLAIN("angle", "s", "delay of the position", 0.0, -DBL_MAX, HCI_PARAMETER_WITH_SPEED),
    HCI_PLAIN("torque", "s", "delay of the torque", 0.0, -DBL_MAX, HCI_PARAMETER_WITH_SPEED),
};

/* A turn of the plane of the currents. */
typedef struct {
    double s, c;
} rotation;

static rotation rotation_by(double angle_rad)
{
    rotation x;
    hci_sine_cosine(angle_rad, &x.s, &x.c);
    return x;
}

/* x_abc turned with the rotor; a zero sequence stays. */
static void turn(double abc[3], rotation by)
{
    const hci_alpha_beta x = hci_clarke(abc);
    const hci_alpha_beta y = {by.c * x.alpha - by.s * x.beta, by.s * x.alpha + by.c * x.beta, x.zero};
    hci_clarke_inverse(y, abc);
}

/* What a value, its rate and its curvature become of in a time: of an oscillation about any mean
 *
 *     x(t) = x + x' sin(wt)/w + x'' (1 − cos wt)/w²
 *
 * which stays within bounds however long the time is, and is the parabola where wt is small. */
typedef struct {
    double by_rate, by_curvature; /* of the value */
    double kept, lost;            /* x'(t) = kept x' + by_rate x''      x''(t) = kept x'' − lost x' */
} swing;

static swing swing_of(double w, double time_s)
{
    if (!(w > 0.0)) return (swing){time_s, 0.5 * time_s * time_s, 1.0, 0.0};
    const double s = sin(w * time_s), c = cos(w * time_s);
    return (swing){s / w, (1.0 - c) / (w * w), c, w * s};
}

/* Moves angle and currents on in time; the currents in the rotor frame by their rate of change and its own.
 */
static void advance(hci_sample *x, int pole_pairs, double angle_s, double current_s)
{
    x->theta_m_rad += x->speed_rad_per_s * angle_s;
    if (current_s == 0.0) return;
    const swing on = swing_of(x->swing_rad_per_s, current_s);
    const rotation by = rotation_by(pole_pairs * x->speed_rad_per_s * current_s);
    for (int k = 0; k < 3; ++k) {
        const double rate = x->change_A_per_s[k], curvature = x->curvature_A_per_s2[k];
        x->i_abc[k] += on.by_rate * rate + on.by_curvature * curvature;
        x->change_A_per_s[k] = on.kept * rate + on.by_rate * curvature;
        x->curvature_A_per_s2[k] = on.kept * curvature - on.lost * rate;
    }
    turn(x->i_abc, by);
    turn(x->change_A_per_s, by);
    turn(x->curvature_A_per_s2, by);
}

/* From the moment of the torque that is read to the moments of the others, and back. */
static void sense(const hci_effect *effect, int pole_pairs, hci_sample *x)
{
    const double torque = hci_effect_value(effect, TORQUE);
    advance(x, pole_pairs, torque - hci_effect_value(effect, ANGLE),
            torque - hci_effect_value(effect, CURRENT));
}

static void undo(const hci_effect *effect, int pole_pairs, hci_sample *x)
{
    const double torque = hci_effect_value(effect, TORQUE);
    advance(x, pole_pairs, hci_effect_value(effect, ANGLE) - torque,
            hci_effect_value(effect, CURRENT) - torque);
}

/* ∂i/∂t of what undo returned: turn(change) + pω J i, J i = ∂(turned i)/∂angle. */
static double by_current_time(int pole_pairs, const hci_sample *after, const hci_effect_torque *by)
{
    const rotation by_quarter = {1.0, 0.0};
    double quarter[3] = {after->i_abc[0], after->i_abc[1], after->i_abc[2]};
    const double zero = (quarter[0] + quarter[1] + quarter[2]) / 3.0;
    double sum = 0.0;
    turn(quarter, by_quarter);
    for (int k = 0; k < 3; ++k)
        sum += by->by_current[k] *
               (after->change_A_per_s[k] + pole_pairs * after->speed_rad_per_s * (quarter[k] - zero));
    return sum;
}

static void undo_adjoint(const hci_effect *effect, int pole_pairs, const hci_sample *before,
                         const hci_sample *after, hci_effect_torque *by, double *by_value)
{
    const double angle = by->by_angle * before->speed_rad_per_s;
    const double current = by_current_time(pole_pairs, after, by);
    for (size_t k = 0; k < effect->count; ++k) {
        const size_t parameter = effect->term[k].parameter;
        by_value[k] = parameter == ANGLE ? angle : parameter == CURRENT ? current : -angle - current;
    }
    const double lead_s = hci_effect_value(effect, CURRENT) - hci_effect_value(effect, TORQUE);
    if (lead_s == 0.0) return;
    const rotation back = rotation_by(-pole_pairs * before->speed_rad_per_s * lead_s);
    turn(by->by_current, back);
    turn(by->by_change, back);
    turn(by->by_curvature, back);
    const swing on = swing_of(before->swing_rad_per_s, lead_s);
    for (int k = 0; k < 3; ++k) {
        const double first = by->by_change[k], second = by->by_curvature[k];
        by->by_change[k] = on.kept * first + on.by_rate * by->by_current[k] - on.lost * second;
        by->by_curvature[k] = on.kept * second + on.by_rate * first + on.by_curvature * by->by_current[k];
    }
}

static void delay_add(const hci_effect *effect, size_t parameter, hci_effect_channel *channel)
{
    channel->delay_s += hci_effect_value(effect, parameter);
    channel->delayed_by = effect->type;
}

static void simulate(const hci_effect *effect, int pole_pairs, hci_sensor *sensors,
                     hci_effect_channel *channels)
{
    (void)pole_pairs;
    (void)sensors;
    for (int s = HCI_SENSE_IA; s <= HCI_SENSE_IC; ++s)
        delay_add(effect, CURRENT, &channels[s]);
    delay_add(effect, ANGLE, &channels[HCI_SENSE_ANGLE]);
    delay_add(effect, TORQUE, &channels[HCI_SENSE_TORQUE]);
}

static const size_t LATE[] = {TORQUE};

#define EXPECTED_S 1e-3

/* Of the three only two differences show; that of the torque is looked for where it is long. */
static void propose(const hci_effect_survey *survey, const hci_effect_proposals *to)
{
    if (!survey->timed) return;
    hci_effect_propose(to, CURRENT, 1, 0.0, 2.0, EXPECTED_S);
    hci_effect_propose(to, ANGLE, 1, 0.0, 2.0, EXPECTED_S);
}

static const hci_effect_correction CORRECTION[] = {HCI_CORRECT_CURRENT_DELAY, HCI_CORRECT_ANGLE_DELAY,
                                                   HCI_CORRECT_NOTHING};

const hci_effect_type hci_effect_channel_delay = {
    .name = "channel_delay",
    .title = "a late channel",
    .equation = "x_read(t) = x(t − τ)",
    .signature = "a phase in proportion to order and speed, unlike an offset",
    HCI_EFFECT_PARAMETERS(PARAMETER),
    .correction = CORRECTION,
    .needs = HCI_EFFECT_NEEDS_SPEED | HCI_EFFECT_NEEDS_RATE,
    .without = "without a speed friction and delays are left out",
    .told_by = "another speed, at least four times as fast",
    .late = LATE,
    .propose = propose,
    .sense = sense,
    .undo = undo,
    .undo_adjoint = undo_adjoint,
    .simulate = simulate,
};
