#include "host/solve/limits.h"

#include <math.h>

#include "hci/machine/strategy.h"
#include "host/solve/task.h"

/* Angles at which peaks are looked for: 16 in the shortest period. */
static size_t angles(const hci_solution *s, double top)
{
    for (size_t k = 0; k < s->current.count; ++k)
        top = fmax(top, s->current.wave[k].order);
    return s->period_turns * (size_t)ceil(16.0 * top);
}

/* Largest phase current of mean × per_Nm + constant, or of the whole current when there are no parts. */
static double peak_current_A(const hci_solution *s, double mean_Nm)
{
    const size_t count = angles(s, 1.0);
    double peak = 0.0;
    for (size_t k = 0; k < count; ++k) {
        const double theta_rad = 2.0 * HCI_PI * (double)(s->period_turns * k) / (double)count;
        double a[3], b[3];
        if (s->per_Nm) {
            hci_waves_at(s->per_Nm, s->current.count, theta_rad, a);
            hci_waves_at(s->constant, s->current.count, theta_rad, b);
            for (int phase = 0; phase < 3; ++phase)
                peak = fmax(peak, fabs(mean_Nm * a[phase] + b[phase]));
        } else {
            hci_waves_at(s->current.wave, s->current.count, theta_rad, a);
            for (int phase = 0; phase < 3; ++phase)
                peak = fmax(peak, fabs(a[phase]));
        }
    }
    return peak;
}

/* The peak is a convex function of the mean torque, so the means that keep the limit are an interval. */
static double torque_at_limit_Nm(const hci_solution *s, double wanted_Nm, double limit_A)
{
    double good = 0.0, bad = wanted_Nm;
    if (!s->per_Nm || peak_current_A(s, 0.0) > limit_A) return NAN;
    for (int step = 0; step < 40; ++step) {
        const double middle = 0.5 * (good + bad);
        *(peak_current_A(s, middle) <= limit_A ? &good : &bad) = middle;
    }
    return good;
}

/* Synchronous inductance: the mean of both axes, or of the table's mean self less mean mutual inductance.
 * NAN: not known. */
static double inductance_H(const hci_machine_data *m)
{
    const hci_inductance *l = m->inductance;
    if (m->inductance_count > 0 && l->order < HCI_ORDER_TOLERANCE)
        return (l->cosine[HCI_AA] + l->cosine[HCI_BB] + l->cosine[HCI_CC] - l->cosine[HCI_AB] -
                l->cosine[HCI_BC] - l->cosine[HCI_CA]) /
               3.0;
    return 0.5 * (m->inductance_d_H + m->inductance_q_H);
}

/* What the effects add to the voltage: ω_m ∂T_x/∂i + ω L_x di/dθ. */
static void add_effects(const hci_machine_data *m, const hci_solve_options *o, double theta_rad,
                        const double i[3], const double i_slope[3], double v[3])
{
    hci_sample truth = {0};
    double slope[2], flux[2], induced[3];
    truth.theta_m_rad = theta_rad / m->pole_pairs;
    truth.temperature_C = hci_magnet_temperature_C(o);
    for (int phase = 0; phase < 3; ++phase)
        truth.i_abc[phase] = i[phase];
    const hci_effect_torque x = hci_effects_torque(&m->model, o->effects, &truth, NULL);
    hci_plane_from_abc(i_slope, slope);
    flux[0] = x.inductance_H[0] * slope[0] + x.inductance_H[1] * slope[1];
    flux[1] = x.inductance_H[1] * slope[0] + x.inductance_H[2] * slope[1];
    hci_plane_to_abc(flux, induced);
    for (int phase = 0; phase < 3; ++phase)
        v[phase] += o->speed_rad_per_s * (x.by_current[phase] + m->pole_pairs * induced[phase]);
}

/* v = R i + ω L di/dθ + ω_m e at one angle, L the mean of both axes, and what effects add; largest difference
 * of two phases. */
static double line_voltage_V(const hci_machine_data *m, const hci_solve_options *o, const hci_solution *s,
                             double theta_rad)
{
    const double speed_rad_per_s = o->speed_rad_per_s;
    const double l_H = inductance_H(m);
    const double omega_rad_per_s = m->pole_pairs * speed_rad_per_s;
    double e[3], v[3] = {0.0, 0.0, 0.0}, current[3] = {0.0, 0.0, 0.0}, change[3] = {0.0, 0.0, 0.0};
    hci_waves_at(m->model.back_emf, m->model.back_emf_count, theta_rad, e);
    for (size_t k = 0; k < s->current.count; ++k) {
        const hci_wave w = s->current.wave[k];
        const hci_wave slope = {w.order, w.sequence, -w.order * w.cosine, w.order * w.sine};
        double i[3], i_slope[3];
        hci_waves_at(&w, 1, theta_rad, i);
        hci_waves_at(&slope, 1, theta_rad, i_slope);
        for (int phase = 0; phase < 3; ++phase) {
            v[phase] += m->resistance_ohm * i[phase] + omega_rad_per_s * l_H * i_slope[phase];
            current[phase] += i[phase];
            change[phase] += i_slope[phase];
        }
    }
    for (int phase = 0; phase < 3; ++phase)
        v[phase] += speed_rad_per_s * e[phase];
    if (o->effects) add_effects(m, o, theta_rad, current, change, v);
    return fmax(fabs(v[0] - v[1]), fmax(fabs(v[1] - v[2]), fabs(v[2] - v[0])));
}

static hci_status peak_voltage(const hci_machine_data *m, const hci_solve_options *o, hci_solution *s,
                               hci_note *note)
{
    double top = 1.0;
    size_t count;
    if (isnan(m->resistance_ohm) || isnan(inductance_H(m)))
        return hci_note_set(
            note, HCI_ERROR_INPUT,
            "machine.csv: the voltage needs `resistance`, `inductance_d` and `inductance_q`; add these rows "
            "or leave out --limit-voltage");
    for (size_t k = 0; k < m->model.back_emf_count; ++k)
        top = fmax(top, m->model.back_emf[k].order);
    if (o->effects) top = fmax(top, hci_effects_top_order(o->effects));
    count = angles(s, top);
    s->peak_line_voltage_V = 0.0;
    for (size_t k = 0; k < count; ++k) {
        const double theta_rad = 2.0 * HCI_PI * (double)(s->period_turns * k) / (double)count;
        s->peak_line_voltage_V = fmax(s->peak_line_voltage_V, line_voltage_V(m, o, s, theta_rad));
    }
    return HCI_OK;
}

hci_status hci_limits_check(const hci_machine_data *machine, const hci_solve_options *options,
                            hci_solution *solution, hci_note *note)
{
    const double wanted_Nm = solution->order_count > 0 ? solution->order[0].target_Nm.cosine : 0.0;
    hci_status status = HCI_OK;
    solution->within_limits = true;
    solution->peak_line_voltage_V = solution->torque_at_limit_Nm = NAN;
    solution->peak_phase_current_A = peak_current_A(solution, wanted_Nm);
    if (options->limit_current_A > 0.0 && solution->peak_phase_current_A > options->limit_current_A) {
        solution->within_limits = false;
        solution->torque_at_limit_Nm = torque_at_limit_Nm(solution, wanted_Nm, options->limit_current_A);
    }
    if (options->limit_voltage_V > 0.0) status = peak_voltage(machine, options, solution, note);
    if (solution->peak_line_voltage_V > options->limit_voltage_V) solution->within_limits = false;
    return status;
}
