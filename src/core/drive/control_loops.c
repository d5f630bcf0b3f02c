#include "core/drive/control_loops.h"

#include <math.h>

#include "core/drive/plant_table.h"

/* The integral after a sample whose output was to be `raw` and became `limited`. */
static double integrate(const hci_pi *pi, double integral, double error, double raw, double limited,
                        double sample_s)
{
    const double gain = pi->integral_per_s * sample_s;
    if (pi->proportional > 0.0) return integral + gain * (error + (limited - raw) / pi->proportional);
    return integral + gain * error + (limited - raw);
}

double hci_pi_step(const hci_pi *pi, double *integral, double error, double limit, double sample_s)
{
    const double raw = pi->proportional * error + *integral;
    const double limited = fmax(-limit, fmin(limit, raw));
    *integral = integrate(pi, *integral, error, raw, limited, sample_s);
    return limited;
}

/* ---- hysteresis ---- */

unsigned hci_hysteresis_hold(double frequency_Hz, double step_s)
{
    const double steps = ceil(0.5 / (frequency_Hz * step_s) - 1e-9);
    return steps > 0.0 ? (unsigned)fmin(steps, 1e9) : 0u;
}

unsigned hci_hysteresis_step(const hci_hysteresis *hysteresis, hci_hysteresis_state *state,
                             const double reference_A[3], const double measured_A[3])
{
    const double half_A = 0.5 * hysteresis->band_A;
    for (unsigned s = 0; s < 3; ++s) {
        const double error_A = measured_A[s] - reference_A[s];
        const unsigned leg = 1u << s;
        const bool leaves = state->legs & leg ? error_A > half_A : error_A < -half_A;
        if (state->held[s] > 0) --state->held[s];
        if (!leaves || state->held[s] > 0) continue;
        state->legs ^= leg;
        state->held[s] = hysteresis->hold_steps;
        ++state->switchings;
    }
    return state->legs;
}

/* ---- PI in the rotor frame ---- */

/* Rotor-frame components of a plane vector, d = (−cos θ, −sin θ), q = (sin θ, −cos θ), and back. */
static void to_rotor(const double x[2], double s, double c, double dq[2])
{
    dq[0] = -c * x[0] - s * x[1];
    dq[1] = s * x[0] - c * x[1];
}

static void from_rotor(const double dq[2], double s, double c, double x[2])
{
    x[0] = s * dq[1] - c * dq[0];
    x[1] = -s * dq[0] - c * dq[1];
}

/* ω (e + L'i) + ω_e L (i turned by a quarter): all of the voltage but R i and the change of i in the rotor
 * frame. */
static void feed_forward(const hci_plant_table *table, const hci_measurement *measured, const double i[2],
                         double v[2])
{
    hci_plant_point p;
    hci_plant_table_point(table, measured->theta_m_rad, &p);
    const double *e = p.magnetic.e, *h = p.magnetic.slope, *l = p.inductance_H;
    const double w = measured->speed_rad_per_s, w_e = table->pole_pairs * w;
    v[0] = w * (e[0] + h[0] * i[0] + h[1] * i[1]) + w_e * (l[1] * i[0] - l[0] * i[1]);
    v[1] = w * (e[1] + h[1] * i[0] + h[2] * i[1]) + w_e * (l[2] * i[0] - l[1] * i[1]);
}

/* One sample of the loop, in the plane. */
typedef struct {
    double error[2], feed[2];    /* A, V */
    double current[2];           /* A, at the sample */
    double theta_rad, ahead_rad; /* of the sample, and from there to the middle of the voltage's use */
    double sample_s;
} pi_sample;

/* Turned by an angle in the direction of rotation. */
static void turned(const double x[2], double angle_rad, double y[2])
{
    const double s = sin(angle_rad), c = cos(angle_rad);
    y[0] = c * x[0] - s * x[1];
    y[1] = s * x[0] + c * x[1];
}

/* As much of the voltage as the modulation can give. Returns the factor. */
static double limit_voltage(const hci_control *control, double v[2])
{
    return hci_inverter_limit(control->current.modulation, control->dc_link_V, v);
}

/* What the PI sees in place of reference − current: reference − filtered current. */
static void filter_error(const hci_current_pi *pi, hci_current_pi_state *state, const double current_dq[2],
                         double error_dq[2])
{
    if (!(pi->filter > 0.0)) return;
    for (int k = 0; k < 2; ++k) {
        state->filtered[k] += pi->filter * (current_dq[k] - state->filtered[k]);
        error_dq[k] += current_dq[k] - state->filtered[k];
    }
}

/* state->pending: out. */
static void pi_in_rotor_frame(const hci_control *control, hci_current_pi_state *state, const pi_sample *x)
{
    const hci_pi *pi = control->current.pi;
    double s = sin(x->theta_rad), c = cos(x->theta_rad), error_dq[2], current_dq[2], raw[2], ahead[2];
    to_rotor(x->error, s, c, error_dq);
    to_rotor(x->current, s, c, current_dq);
    filter_error(&control->current, state, current_dq, error_dq);
    to_rotor(x->feed, s, c, raw);
    for (int k = 0; k < 2; ++k)
        raw[k] += pi[k].proportional * error_dq[k] + state->integral[k];
    if (x->ahead_rad != 0.0) {
        s = sin(x->theta_rad + x->ahead_rad);
        c = cos(x->theta_rad + x->ahead_rad);
    }
    from_rotor(raw, s, c, state->pending);
    turned(x->current, x->ahead_rad, ahead);
    hci_inverter_dead_time(&control->current.dead_time, ahead, 1.0, state->pending);
    const double factor = limit_voltage(control, state->pending);
    state->limited += factor < 1.0;
    for (int k = 0; k < 2; ++k)
        state->integral[k] =
            integrate(&pi[k], state->integral[k], error_dq[k], raw[k], factor * raw[k], x->sample_s);
}

void hci_current_pi_sample(const hci_control *control, hci_control_state *state, const double current[2],
                           const hci_measurement *measured)
{
    const hci_current_pi *pi = &control->current;
    const double sample_s = control->step_s * (control->current_every > 0 ? control->current_every : 1u);
    const double delay_s = control->step_s * pi->delay_steps + 0.5 * sample_s;
    const double *reference = state->reference;
    pi_sample x = {.error = {reference[0] - current[0], reference[1] - current[1]},
                   .current = {current[0], current[1]},
                   .theta_rad = control->table->pole_pairs * measured->theta_m_rad,
                   .ahead_rad = control->table->pole_pairs * measured->speed_rad_per_s * delay_s,
                   .sample_s = sample_s};
    if (pi->decoupled) feed_forward(control->table, measured, current, x.feed);
    for (int k = 0; k < 2; ++k)
        x.feed[k] += state->feed[k];
    pi_in_rotor_frame(control, &state->current, &x);
    state->current.wait = pi->delay_steps;
    if (pi->delay_steps > 0) return;
    for (int k = 0; k < 2; ++k)
        state->v[k] = state->current.v[k] = state->current.pending[k];
}
