/* A recording in a view: speed, currents and voltages as a reading has them. */
#include <math.h>

#include "host/check/interpreted_run.h"

#define SQRT3 1.7320508075688772

/* Phases whose alternating rms differ by more have a channel of another gain. */
#define UNBALANCED 1.3

static double power_of_scale(const check_run *r, const check_view *v)
{
    return r->is_electrical ? v->theta_e_is_mechanical : 1.0 - v->theta_m_is_electrical;
}

/* Electrical angle per recorded angle; negative where the angle is counted backward. */
double hci_check_scale_of(const check_run *r, const check_view *v, const check_model *m)
{
    return v->theta_unit * v->direction * pow(m->pole_pairs, power_of_scale(r, v));
}

/* Mechanical speed by the column, else by angle and time; NAN: neither. */
double hci_check_angle_speed_of(const check_run *r, const check_view *v, const check_model *m)
{
    return r->slope * hci_check_scale_of(r, v, m) / m->pole_pairs / v->time;
}

/* Mechanical speed per what stands in the column. */
static double column_speed(const check_run *r, const check_view *v, const check_model *m)
{
    return v->speed / (r->speed_is_electrical || v->speed_electrical > 0.0 ? m->pole_pairs : 1.0);
}

double hci_check_column_speed_of(const check_run *r, const check_view *v, const check_model *m)
{
    return r->speed * column_speed(r, v, m);
}

double hci_check_speed_of(const check_run *r, const check_view *v, const check_model *m)
{
    return r->has_speed ? hci_check_column_speed_of(r, v, m) : hci_check_angle_speed_of(r, v, m);
}

/* v_ab is √3 times v_a and 30 degrees ahead, for positive sequence. */
check_vector hci_check_phase_of_line(check_vector x, const check_view *v)
{
    return v->voltage_is_line > 0.0 ? hci_check_turned(hci_check_scaled(x, 1.0 / SQRT3), -HCI_PI / 6.0) : x;
}

/* d + jq of means over the frames: x = −(d + jq) e^{jθ}. An angle counted backward exchanges the frames;
 * swapped phases conjugate αβ, and conj(x) e^{−jθ} = conj(x e^{jθ}). */
static check_vector dq_of(const check_vector way[2], const check_view *v)
{
    const bool swapped = v->swapped > 0.0, backward = v->direction < 0.0;
    const check_vector x = way[swapped == backward ? FORWARD : BACKWARD];
    return hci_check_turned(hci_check_scaled(swapped ? hci_check_conjugate(x) : x, -1.0), -v->run_zero_rad);
}

check_vector hci_check_current_of(const check_run *r, const check_view *v, const check_model *m)
{
    const check_frame *frame = hci_check_frame_of(r, hci_check_scale_of(r, v, m));
    const check_vector none = {0.0, 0.0};
    if (r->has_dq) return hci_check_scaled(r->dq, v->current * v->dq);
    return r->has_abc && frame ? hci_check_scaled(dq_of(frame->current, v), v->current) : none;
}

static check_vector voltage_of(const check_run *r, const check_view *v, const check_model *m)
{
    const check_frame *frame = hci_check_frame_of(r, hci_check_scale_of(r, v, m));
    check_vector way[2] = {{0.0, 0.0}, {0.0, 0.0}};
    for (int k = FORWARD; frame && k <= BACKWARD; ++k)
        way[k] = hci_check_phase_of_line(frame->voltage[k], v);
    return hci_check_scaled(dq_of(way, v), v->voltage);
}

/* The drive has turned v_d, v_q with an angle of its own: no slip of the recorded one is in them. */
check_loop hci_check_loop_of(const check_run *r, const check_view *v, const check_model *m)
{
    check_loop x = r->loop;
    if (!r->has_dq_voltage) {
        x.voltage = voltage_of(r, v, m);
        x.current = hci_check_current_of(r, v, m);
        x.speed = hci_check_speed_of(r, v, m);
        x.turning = hci_check_scaled(x.current, x.speed);
        return x;
    }
    const double speed = r->has_speed ? column_speed(r, v, m) : hci_check_angle_speed_of(r, v, m);
    x.voltage = hci_check_scaled(x.voltage, v->voltage * v->dq);
    x.current = hci_check_scaled(x.current, v->current * v->dq);
    x.turning = hci_check_scaled(x.turning, v->current * v->dq * speed);
    x.speed *= speed;
    return x;
}

/* 3/2 Re(v i*). Of phase currents it needs no frame, so that a wrong angle does not spoil it. */
double hci_check_power_of(const check_run *r, const check_view *v, const check_model *m)
{
    if (r->has_dq_voltage) return 1.5 * r->power.re * v->voltage * v->current * v->dq * v->dq;
    const check_vector p =
        r->has_dq ? hci_check_product(voltage_of(r, v, m), hci_check_conjugate(hci_check_current_of(r, v, m)))
                  : hci_check_scaled(hci_check_phase_of_line(r->power, v), v->voltage * v->current);
    return 1.5 * p.re;
}

/* ---- which recordings can say something, whatever the reading */

bool hci_check_turns(double order)
{
    return isfinite(order);
}

bool hci_check_has_vector_current(const check_figures *f, const check_run *r)
{
    return hci_check_has_current(f, r) &&
           ((r->has_dq && r->dq_is_steady) || (r->has_abc && hci_check_turns(r->current_order)));
}

bool hci_check_is_unbalanced(double balance)
{
    return balance > UNBALANCED;
}

bool hci_check_has_speed(const check_run *r)
{
    return (r->has_speed && fabs(r->speed) > 0.0) ||
           (!r->has_speed && isfinite(r->slope) && fabs(r->slope) > 0.0);
}

bool hci_check_has_turning_voltage(const check_run *r)
{
    if (r->has_dq_voltage) return r->dq_voltage_is_coherent && !r->lacks_d_voltage && hci_check_has_speed(r);
    return r->has_voltage && hci_check_turns(r->voltage_order) && hci_check_has_speed(r) &&
           !hci_check_is_unbalanced(r->voltage_balance);
}

/* What flows in the phases but does not turn with the rotor is an offset or noise, and not in the voltage's
 * fundamental. */
bool hci_check_has_drop(const check_figures *f, const check_run *r)
{
    return r->has_dq_voltage ? hci_check_has_current(f, r) : hci_check_has_vector_current(f, r);
}

bool hci_check_has_emf(const check_figures *f, const check_run *r, const check_model *m)
{
    return hci_check_has_turning_voltage(r) &&
           (!hci_check_has_drop(f, r) || isfinite(m->resistance_ohm + m->inductance_d_H + m->inductance_q_H));
}
