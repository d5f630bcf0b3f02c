#include "host/check/relations/interpreted_run.h"

#include <math.h>

#define SQRT3 1.7320508075688772

/* Phases whose alternating rms differ by more have a channel of another gain. */
#define UNBALANCED 1.3

static double power_of_scale(const check_run *r, const check_interpretation *as)
{
    return r->is_electrical ? as->theta_e_is_mechanical : 1.0 - as->theta_m_is_electrical;
}

double hci_check_scale_of(const check_run *r, const check_interpretation *as, const check_model *m)
{
    const double gear = as->theta_geared > 0.0 && r->gear > 0.0 ? r->gear : 1.0;
    return as->theta_unit * as->direction * gear * pow(m->pole_pairs, power_of_scale(r, as));
}

double hci_check_angle_speed_of(const check_run *r, const check_interpretation *as, const check_model *m)
{
    return r->angle_rate * hci_check_scale_of(r, as, m) / m->pole_pairs / as->time;
}

/* Mechanical speed per what stands in the column. */
static double column_speed(const check_run *r, const check_interpretation *as, const check_model *m)
{
    const bool is_electrical =
        r->speed_is_electrical ? !(as->speed_mechanical > 0.0) : as->speed_electrical > 0.0;
    const double sign = as->speed_unsigned > 0.0 && r->angle_rate * as->direction < 0.0 ? -1.0 : 1.0;
    return sign * as->speed / (is_electrical ? m->pole_pairs : 1.0);
}

double hci_check_column_speed_of(const check_run *r, const check_interpretation *as, const check_model *m)
{
    return r->speed * column_speed(r, as, m);
}

double hci_check_speed_over_time_of(const check_run *r, const check_interpretation *as, const check_model *m)
{
    return r->speed_over_time * column_speed(r, as, m);
}

double hci_check_speed_of(const check_run *r, const check_interpretation *as, const check_model *m)
{
    return r->has_speed ? hci_check_column_speed_of(r, as, m) : hci_check_angle_speed_of(r, as, m);
}

/* v_ab is √3 times v_a and 30 degrees ahead, for positive sequence. */
static check_vector phase_of_line(check_vector x, const check_interpretation *as)
{
    return as->voltage_is_line > 0.0 ? hci_check_turned(hci_check_scaled(x, 1.0 / SQRT3), -HCI_PI / 6.0) : x;
}

bool hci_check_currents_swapped(const check_interpretation *as)
{
    return (as->swapped > 0.0) != (as->currents_swapped > 0.0);
}

bool hci_check_voltages_swapped(const check_interpretation *as)
{
    return (as->swapped > 0.0) != (as->voltages_swapped > 0.0);
}

/* By how much swapped phases turn beyond what b and c do: with α = e^{j2π/3}, i_b + α i_a + α² i_c is α times
 * the conjugate of i_a + α i_b + α² i_c, and i_c + α i_b + α² i_a is α² times it. */
static double turn_of_swap(double all, double alone)
{
    const double which = fmax(all, alone);
    return which > 0.0 ? (which - CHECK_SWAPPED_BC) * 2.0 * HCI_PI / 3.0 : 0.0;
}

/* d + jq of means over the frames: x = −(d + jq) e^{jθ}. An angle counted backward exchanges the frames;
 * swapped phases conjugate αβ, and conj(x) e^{−jθ} = conj(x e^{jθ}). */
static check_vector dq_of(const check_vector way[2], const check_interpretation *as, bool swapped,
                          double turn_rad)
{
    const bool backward = as->direction < 0.0;
    const check_vector x = way[swapped == backward ? CHECK_FORWARD : CHECK_BACKWARD];
    return hci_check_turned(hci_check_scaled(swapped ? hci_check_conjugate(x) : x, -1.0),
                            turn_rad - as->run_zero_rad);
}

check_vector hci_check_current_of(const check_run *r, const check_interpretation *as, const check_model *m)
{
    const check_frame *frame = hci_check_frame_of(r, hci_check_scale_of(r, as, m));
    const check_vector none = {0.0, 0.0};
    if (r->has_dq) return hci_check_scaled(r->dq, as->current * as->dq);
    return r->has_abc && frame ? hci_check_scaled(dq_of(frame->current, as, hci_check_currents_swapped(as),
                                                        turn_of_swap(as->swapped, as->currents_swapped)),
                                                  as->current)
                               : none;
}

check_vector hci_check_mutual_of(const check_run *r, const check_interpretation *as, const check_model *m)
{
    const check_vector i = hci_check_current_of(r, as, m), e = hci_check_emf_expected(1.0, m);
    return hci_check_scaled(hci_check_product(i, hci_check_conjugate(e)), 1.5);
}

static check_vector voltage_of(const check_run *r, const check_interpretation *as, const check_model *m)
{
    const check_frame *frame = hci_check_frame_of(r, hci_check_scale_of(r, as, m));
    check_vector way[2] = {{0.0, 0.0}, {0.0, 0.0}};
    for (int k = CHECK_FORWARD; frame && k <= CHECK_BACKWARD; ++k)
        way[k] = phase_of_line(frame->voltage[k], as);
    return hci_check_scaled(
        dq_of(way, as, hci_check_voltages_swapped(as), turn_of_swap(as->swapped, as->voltages_swapped)),
        as->voltage);
}

/* The drive has turned v_d, v_q with an angle of its own: no convention error of the recorded one is in them.
 */
check_voltage_terms hci_check_voltage_terms_of(const check_run *r, const check_interpretation *as,
                                               const check_model *m)
{
    check_voltage_terms x = r->terms;
    if (!r->has_dq_voltage) {
        x.voltage = voltage_of(r, as, m);
        x.current = hci_check_current_of(r, as, m);
        x.speed = hci_check_speed_of(r, as, m);
        x.speed_current = hci_check_scaled(x.current, x.speed);
        return x;
    }
    const double speed = r->has_speed ? column_speed(r, as, m) : hci_check_angle_speed_of(r, as, m);
    x.voltage = hci_check_scaled(x.voltage, as->voltage * as->dq);
    x.current = hci_check_scaled(x.current, as->current * as->dq);
    x.speed_current = hci_check_scaled(x.speed_current, as->current * as->dq * speed);
    x.speed *= speed;
    return x;
}

/* 3/2 Re(v i*). Of phase currents it needs no frame, so that a wrong angle does not spoil it, unless the
 * phases of one of both are taken otherwise. */
double hci_check_power_of(const check_run *r, const check_interpretation *as, const check_model *m)
{
    if (r->has_dq_voltage) return 1.5 * r->power.re * as->voltage * as->current * as->dq * as->dq;
    const bool by_frame = r->has_dq || hci_check_currents_swapped(as) != hci_check_voltages_swapped(as);
    const check_vector p =
        by_frame
            ? hci_check_product(voltage_of(r, as, m), hci_check_conjugate(hci_check_current_of(r, as, m)))
            : hci_check_scaled(phase_of_line(r->power, as), as->voltage * as->current);
    return 1.5 * p.re;
}

/* ---- which recordings can say something, in every interpretation */

bool hci_check_has_vector_current(const check_data *data, const check_run *r)
{
    return hci_check_has_current(data, r) &&
           ((r->has_dq && r->dq_is_steady) ||
            (r->has_abc && isfinite(r->current_order) && r->current_is_steady));
}

bool hci_check_tells_torque(const check_data *data, const check_run *r)
{
    return r->has_abc && r->has_torque && r->theta && hci_check_has_vector_current(data, r);
}

bool hci_check_is_unbalanced(double balance)
{
    return balance > UNBALANCED;
}

bool hci_check_has_speed(const check_run *r)
{
    return (r->has_speed && fabs(r->speed) > 0.0) ||
           (!r->has_speed && isfinite(r->angle_rate) && fabs(r->angle_rate) > 0.0);
}

bool hci_check_has_turning_voltage(const check_run *r)
{
    if (r->has_dq_voltage) return r->dq_voltage_is_coherent && !r->lacks_d_voltage && hci_check_has_speed(r);
    return r->has_voltage && isfinite(r->voltage_order) && hci_check_has_speed(r) &&
           !hci_check_is_unbalanced(r->voltage_balance);
}

/* What flows in the phases but does not turn with the rotor is an offset or noise, and not in the voltage's
 * fundamental. */
bool hci_check_has_drop(const check_data *data, const check_run *r)
{
    return r->has_dq_voltage ? hci_check_has_current(data, r) : hci_check_has_vector_current(data, r);
}

bool hci_check_has_emf(const check_data *data, const check_run *r, const check_model *m)
{
    return hci_check_has_turning_voltage(r) &&
           (!hci_check_has_drop(data, r) ||
            isfinite(m->resistance_ohm + m->inductance_d_H + m->inductance_q_H));
}
