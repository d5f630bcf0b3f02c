#include "host/check/relations/interpretation.h"

#include <math.h>

#include "hci/host/machine/init.h"

#define SQRT2 1.4142135623730951
#define SQRT3 1.7320508075688772

/* Amplitudes below this share of the largest say nothing of where a table has its orders. */
#define SIGNIFICANT 0.05

check_interpretation hci_check_as_declared(void)
{
    return (check_interpretation){.pole_pairs = 1.0,
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

/* Kinds of back-EMF that are a figure of a data sheet, and whether the number is that, or was divided by it
 * already. */
static const struct {
    int kind;
    hci_sheet_reading sheet;
    bool is_taken;
} SHEET[] = {
    {CHECK_EMF_VOLT_PER_KRPM, HCI_SHEET_VOLT_PHASE_PEAK, false},
    {CHECK_EMF_VOLT_PER_KRPM_LINE, HCI_SHEET_VOLT_LINE_PEAK, false},
    {CHECK_EMF_VOLT_PER_KRPM_LINE_RMS, HCI_SHEET_VOLT_LINE_RMS, false},
    {CHECK_EMF_KV, HCI_SHEET_KV_LINE_PEAK, false},
    {CHECK_EMF_TAKEN_PER_KRPM, HCI_SHEET_VOLT_PHASE_PEAK, true},
    {CHECK_EMF_TAKEN_PER_KRPM_LINE, HCI_SHEET_VOLT_LINE_PEAK, true},
    {CHECK_EMF_TAKEN_PER_KRPM_LINE_RMS, HCI_SHEET_VOLT_LINE_RMS, true},
};

/* Peak of a phase by a value of another kind, or by one that was converted as if it were of another kind. */
static double of_peak(int kind)
{
    switch (kind) {
    case CHECK_EMF_RMS:
        return SQRT2;
    case CHECK_EMF_LINE:
        return 1.0 / SQRT3;
    case CHECK_EMF_LINE_RMS:
        return SQRT2 / SQRT3;
    case CHECK_EMF_TAKEN_FOR_RMS:
        return 1.0 / SQRT2;
    case CHECK_EMF_TAKEN_FOR_LINE:
        return SQRT3;
    case CHECK_EMF_TAKEN_FOR_LINE_RMS:
        return SQRT3 / SQRT2;
    default:
        return 1.0;
    }
}

/* k_e in V·s/rad, peak of a phase, of the number in the table. */
static double emf_of(const check_data *data, const check_interpretation *as, double pole_pairs)
{
    const int kind = (int)as->emf_kind;
    const double a = fabs(data->emf.amplitude[data->emf.largest]);
    const double declared =
        data->emf_in_volts ? a * pole_pairs / (2.0 * HCI_PI * data->value[CHECK_emf_frequency_Hz]) : a;
    for (size_t k = 0; k < sizeof SHEET / sizeof *SHEET; ++k)
        if (SHEET[k].kind == kind)
            return SHEET[k].is_taken ? declared / hci_sheet_emf(SHEET[k].sheet, 1.0, 1)
                                     : hci_sheet_emf(SHEET[k].sheet, a, 1);
    if (kind == CHECK_EMF_VOLT_PER_HZ) return a * pole_pairs / (2.0 * HCI_PI); /* ω_m = 2πf/p */
    if (kind == CHECK_EMF_FLUX_LINKAGE) return a * pole_pairs;
    return declared * of_peak(kind);
}

/* A sin(nθ' + γ) with θ' = θ − zero is A sin(nθ + γ − n zero); the largest row is order 1. */
static double emf_phase_of(const check_data *data, const check_interpretation *as)
{
    const size_t k = data->emf.largest;
    const double phase = data->emf.phase_rad[k] * as->phase_unit * as->emf_phase_unit;
    const bool negative = data->emf.amplitude[k] * as->emf_sign < 0.0;
    return remainder(phase - as->zero_rad + (negative ? HCI_PI : 0.0), 2.0 * HCI_PI);
}

/* Turning d and q by δ turns what L_d − L_q makes by 2δ; interpretations have quarter turns only. */
static double turned_difference(const check_interpretation *as)
{
    return cos(2.0 * as->zero_rad) < 0.0 ? -1.0 : 1.0;
}

static void inductances_of(const check_data *data, const check_interpretation *as, check_model *m)
{
    const check_inductance *l = &data->inductance;
    const bool turned = turned_difference(as) < 0.0;
    m->inductance_d_H = data->value[CHECK_inductance_d_H];
    m->inductance_q_H = data->value[CHECK_inductance_q_H];
    if (isnan(m->inductance_d_H) || isnan(m->inductance_q_H)) {
        m->inductance_d_H = turned ? l->inductance_q_H : l->inductance_d_H;
        m->inductance_q_H = turned ? l->inductance_d_H : l->inductance_q_H;
        if (!l->given) m->inductance_d_H = m->inductance_q_H = NAN;
    }
    m->reluctance_Nm_per_A2 = 1.5 * m->pole_pairs * (m->inductance_d_H - m->inductance_q_H);
    if (!l->given) return;
    m->reluctance_Nm_per_A2 = l->reluctance_Nm_per_A2 * turned_difference(as);
    if (!l->are_slopes)
        m->reluctance_Nm_per_A2 *= m->pole_pairs / data->value[CHECK_pole_pairs];
    else if (as->slope_electrical > 0.0)
        m->reluctance_Nm_per_A2 *= m->pole_pairs;
}

check_model hci_check_model_of(const check_data *data, const check_interpretation *as)
{
    check_model m = {.pole_pairs = data->value[CHECK_pole_pairs] * as->pole_pairs};
    if (as->pole_pairs_counted > 0.0 && data->counted_pole_pairs > 0.0)
        m.pole_pairs = data->counted_pole_pairs;
    m.emf_Nm_per_A = emf_of(data, as, m.pole_pairs);
    m.emf_phase_rad = emf_phase_of(data, as);
    m.resistance_ohm = data->value[CHECK_resistance_ohm] * as->resistance;
    m.rated_current_A = data->value[CHECK_rated_current_A] * as->rated_current;
    inductances_of(data, as, &m);
    return m;
}

/* Ê = jω_m k_e e^{jγ} */
check_vector hci_check_emf_expected(double speed, const check_model *m)
{
    return hci_check_turned((check_vector){0.0, speed * m->emf_Nm_per_A}, m->emf_phase_rad);
}

double hci_check_cogging_order(const check_data *data, const check_interpretation *as, const check_model *m,
                               size_t k)
{
    return as->cogging_mechanical > 0.0 ? data->cogging.order[k] / m->pole_pairs : data->cogging.order[k];
}

bool hci_check_is_significant(const check_table *t, size_t k)
{
    return fabs(t->amplitude[k]) > SIGNIFICANT * fabs(t->amplitude[t->largest]);
}
