/* The machine that a reading makes of the tables. */
#include <math.h>

#include "hci/host/machine/init.h"
#include "host/check/interpretation.h"

#define SQRT2 1.4142135623730951
#define SQRT3 1.7320508075688772

/* Amplitudes below this share of the largest say nothing of where a table has its orders. */
#define SIGNIFICANT 0.05

check_view hci_check_view_declared(void)
{
    return (check_view){.pole_pairs = 1.0,
                        .emf_sign = 1.0,
                        .phase_unit = 1.0,
                        .emf_phase_unit = 1.0,
                        .cogging_phase_unit = 1.0,
                        .rated_current = 1.0,
                        .resistance = 1.0,
                        .theta_unit = 1.0,
                        .direction = 1.0,
                        .current = 1.0,
                        .voltage = 1.0,
                        .dq = 1.0,
                        .torque = 1.0,
                        .speed = 1.0,
                        .time = 1.0};
}

/* k_e in V·s/rad, peak of a phase, of the number in the table. */
static double emf_of(const check_figures *f, const check_view *view, double pole_pairs)
{
    const double a = fabs(f->emf.amplitude[f->emf.largest]);
    const double declared =
        f->emf_in_volts ? a * pole_pairs / (2.0 * HCI_PI * f->value[CHECK_emf_frequency_Hz]) : a;
    switch ((int)view->emf_kind) {
    case EMF_RMS:
        return declared * SQRT2;
    case EMF_LINE:
        return declared / SQRT3;
    case EMF_LINE_RMS:
        return declared * SQRT2 / SQRT3;
    case EMF_VOLT_PER_KRPM:
        return hci_sheet_emf(HCI_SHEET_VOLT_PHASE_PEAK, a, 1);
    case EMF_VOLT_PER_KRPM_LINE:
        return hci_sheet_emf(HCI_SHEET_VOLT_LINE_PEAK, a, 1);
    case EMF_VOLT_PER_KRPM_LINE_RMS:
        return hci_sheet_emf(HCI_SHEET_VOLT_LINE_RMS, a, 1);
    case EMF_KV:
        return hci_sheet_emf(HCI_SHEET_KV_LINE_PEAK, a, 1);
    case EMF_VOLT_PER_HZ: /* ω_m = 2πf/p */
        return a * pole_pairs / (2.0 * HCI_PI);
    case EMF_FLUX_LINKAGE:
        return a * pole_pairs;
    default:
        return declared;
    }
}

/* A sin(nθ' + γ) with θ' = θ − zero is A sin(nθ + γ − n zero); the largest row is order 1. */
static double emf_phase_of(const check_figures *f, const check_view *view)
{
    const size_t k = f->emf.largest;
    const double phase = f->emf.phase_rad[k] * view->phase_unit * view->emf_phase_unit;
    const bool negative = f->emf.amplitude[k] * view->emf_sign < 0.0;
    return remainder(phase - view->zero_rad + (negative ? HCI_PI : 0.0), 2.0 * HCI_PI);
}

/* Turning d and q by δ turns what L_d − L_q makes by 2δ; readings know quarter turns only. */
static double turned_difference(const check_view *view)
{
    return cos(2.0 * view->zero_rad) < 0.0 ? -1.0 : 1.0;
}

static void inductances_of(const check_figures *f, const check_view *view, check_model *m)
{
    const check_inductance *l = &f->inductance;
    const bool turned = turned_difference(view) < 0.0;
    m->inductance_d_H = f->value[CHECK_inductance_d_H];
    m->inductance_q_H = f->value[CHECK_inductance_q_H];
    if (isnan(m->inductance_d_H) || isnan(m->inductance_q_H)) {
        m->inductance_d_H = turned ? l->inductance_q_H : l->inductance_d_H;
        m->inductance_q_H = turned ? l->inductance_d_H : l->inductance_q_H;
        if (!l->given) m->inductance_d_H = m->inductance_q_H = NAN;
    }
    m->reluctance_Nm_per_A2 = 1.5 * m->pole_pairs * (m->inductance_d_H - m->inductance_q_H);
    if (!l->given) return;
    m->reluctance_Nm_per_A2 = l->reluctance_Nm_per_A2 * turned_difference(view);
    if (!l->are_slopes)
        m->reluctance_Nm_per_A2 *= view->pole_pairs;
    else if (view->slope_electrical > 0.0)
        m->reluctance_Nm_per_A2 *= m->pole_pairs;
}

check_model hci_check_model_of(const check_figures *f, const check_view *view)
{
    check_model m = {.pole_pairs = f->value[CHECK_pole_pairs] * view->pole_pairs};
    m.emf = emf_of(f, view, m.pole_pairs);
    m.emf_phase_rad = emf_phase_of(f, view);
    m.resistance_ohm = f->value[CHECK_resistance_ohm] * view->resistance;
    m.rated_current_A = f->value[CHECK_rated_current_A] * view->rated_current;
    inductances_of(f, view, &m);
    return m;
}

/* Ê = jω_m k_e e^{jγ} */
check_vector hci_check_emf_expected(double speed, const check_model *m)
{
    return hci_check_turned((check_vector){0.0, speed * m->emf}, m->emf_phase_rad);
}

double hci_check_cogging_order(const check_figures *f, const check_view *v, const check_model *m, size_t k)
{
    return v->cogging_mechanical > 0.0 ? f->cogging.order[k] / m->pole_pairs : f->cogging.order[k];
}

bool hci_check_is_significant(const check_table *t, size_t k)
{
    return fabs(t->amplitude[k]) > SIGNIFICANT * fabs(t->amplitude[t->largest]);
}
