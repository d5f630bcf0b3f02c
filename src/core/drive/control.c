#include "hci/drive/control.h"

#include <math.h>
#include <stdbool.h>

#include "core/drive/control_loops.h"
#include "core/drive/plant_table.h"

/* Counts down to the next sample of a loop that runs every n-th step. */
static bool is_due(unsigned *wait, unsigned every)
{
    if (*wait > 0) {
        --*wait;
        return false;
    }
    *wait = every > 0 ? every - 1 : 0;
    return true;
}

static void sample_speed(const hci_control *control, hci_control_state *state, double speed_rad_per_s,
                         double set_point)
{
    const double sample_s = control->step_s * (control->speed_every > 0 ? control->speed_every : 1u);
    if (control->speed_controlled)
        state->torque_Nm = hci_pi_step(&control->speed, &state->speed_integral_Nm,
                                       set_point - speed_rad_per_s, control->torque_limit_Nm, sample_s);
    else
        state->torque_Nm = fmax(-control->torque_limit_Nm, fmin(control->torque_limit_Nm, set_point));
}

/* The last source whose time has come, to half a step. */
static const hci_current_source *source_now(const hci_control *control, hci_control_state *state)
{
    const double now_s = ((double)state->step + 0.5) * control->step_s;
    while (state->source + 1 < control->source_count && control->sources[state->source + 1].from_s <= now_s)
        ++state->source;
    return &control->sources[state->source];
}

/* ---- reference currents ---- */

static double clamp(double x, double limit, bool *limited)
{
    *limited = *limited || fabs(x) > limit;
    return fmax(-limit, fmin(limit, x));
}

/* i_dqx = |e|/sqrt(3/2) times the components of x along the axes (e_β, −e_α)/|e| and e/|e|. */
static bool limit_dqx(const hci_control *control, const double e[2], double x[2])
{
    const double scale = sqrt(1.5), square = e[0] * e[0] + e[1] * e[1];
    bool limited = false;
    if (!(square > 0.0)) return false;
    const double d = clamp((e[1] * x[0] - e[0] * x[1]) / scale, control->id_limit, &limited);
    const double q = clamp((e[0] * x[0] + e[1] * x[1]) / scale, control->iq_limit, &limited);
    if (limited) {
        x[0] = scale / square * (d * e[1] + q * e[0]);
        x[1] = scale / square * (q * e[1] - d * e[0]);
    }
    return limited;
}

static bool limit_length(double peak_A, double x[2])
{
    const double square = x[0] * x[0] + x[1] * x[1], most = 1.5 * peak_A * peak_A;
    if (!(square > most)) return false;
    const double factor = sqrt(most / square);
    x[0] *= factor;
    x[1] *= factor;
    return true;
}

static bool ask_strategy(const hci_control *control, hci_control_state *state, hci_strategy strategy,
                         double theta_m_rad)
{
    hci_plant_point p;
    const double previous[2] = {state->answer[0], state->answer[1]};
    hci_plant_table_point(control->table, theta_m_rad, &p);
    if (hci_strategy_current(&p.magnetic, strategy, state->torque_Nm, state->has_answer ? previous : NULL,
                             state->answer, NULL) != HCI_OK)
        ++state->unreached;
    state->has_answer = true;
    state->reference[0] = state->answer[0];
    state->reference[1] = state->answer[1];
    return limit_dqx(control, p.magnetic.e, state->reference);
}

static void add_waves(const hci_current_source *source, double torque_Nm, double theta_rad, double x[2])
{
    double per_Nm[3], abc[3];
    hci_waves_at(source->per_Nm, source->per_Nm_count, theta_rad, per_Nm);
    hci_waves_at(source->fixed, source->fixed_count, theta_rad, abc);
    for (int s = 0; s < 3; ++s)
        abc[s] += torque_Nm * per_Nm[s];
    hci_plane_from_abc(abc, x);
}

/* Rotor frame, amplitude-invariant, to the plane. */
static void from_dq(const double dq[2], double theta_rad, double x[2])
{
    const double scale = sqrt(1.5), s = sin(theta_rad), c = cos(theta_rad);
    x[0] = scale * (s * dq[1] - c * dq[0]);
    x[1] = scale * (-s * dq[0] - c * dq[1]);
}

static void ask_code(const hci_control *control, const hci_reference_code *code, hci_control_state *state,
                     const hci_measurement *measured)
{
    const double theta_rad = control->table->pole_pairs * measured->theta_m_rad;
    hci_reference_dq reference = {{0.0, 0.0}, {0.0, 0.0}};
    code->at(code->context, measured, state->torque_Nm, &reference);
    from_dq(reference.i_A, theta_rad, state->reference);
    from_dq(reference.v_V, theta_rad, state->feed);
}

static void sample_reference(const hci_control *control, hci_control_state *state,
                             const hci_measurement *measured)
{
    const hci_current_source *source = source_now(control, state);
    const double theta_m_rad = measured->theta_m_rad;
    bool limited = false;
    state->feed[0] = state->feed[1] = 0.0;
    if (source->code)
        ask_code(control, source->code, state, measured);
    else if (source->per_Nm_count + source->fixed_count > 0)
        add_waves(source, state->torque_Nm, control->table->pole_pairs * theta_m_rad, state->reference);
    else
        limited = ask_strategy(control, state, source->strategy, theta_m_rad);
    limited = limit_length(control->peak_limit_A, state->reference) || limited;
    state->limited += limited;
}

/* ---- the step ---- */

static void switch_legs(const hci_control *control, hci_control_state *state, const double measured_A[3])
{
    double reference_A[3];
    hci_plane_to_abc(state->reference, reference_A);
    hci_inverter_switched(
        control->dc_link_V,
        hci_hysteresis_step(&control->hysteresis, &state->hysteresis, reference_A, measured_A), state->v);
}

static void sample_voltage(const hci_control *control, hci_control_state *state,
                           const hci_measurement *measured)
{
    double current[2];
    hci_plane_from_abc(measured->i_abc, current);
    hci_current_pi_sample(control, state, current, measured);
}

/* The voltage of a sample is used some steps later. */
static void load_voltage(hci_control_state *state)
{
    hci_current_pi_state *pi = &state->current;
    if (pi->wait > 0 && --pi->wait > 0) return;
    for (int k = 0; k < 2; ++k)
        state->v[k] = pi->v[k] = pi->pending[k];
}

void hci_control_step(const hci_control *control, hci_control_state *state, const hci_measurement *measured,
                      double set_point)
{
    if (is_due(&state->speed_wait, control->speed_every))
        sample_speed(control, state, measured->speed_rad_per_s, set_point);
    const bool due = is_due(&state->current_wait, control->current_every);
    if (due) sample_reference(control, state, measured);
    if (control->loop == HCI_CURRENT_HYSTERESIS) switch_legs(control, state, measured->i_abc);
    if (control->loop == HCI_CURRENT_PI) {
        load_voltage(state);
        if (due) sample_voltage(control, state, measured);
    }
    ++state->step;
}
