#include "core/drive/plant_table.h"

#include <limits.h>
#include <math.h>
#include <stdbool.h>

/* L of a phase matrix in the orthonormal plane: u_αᵀLu_α, u_αᵀLu_β, u_βᵀLu_β with u_α = sqrt(2/3)(1, −½, −½),
 * u_β = sqrt(1/2)(0, 1, −1). */
static void to_plane(const double l[HCI_PHASE_MATRIX], double plane[3])
{
    const double bb_cc = l[HCI_BB] + l[HCI_CC];
    plane[0] = (4.0 * (l[HCI_AA] - l[HCI_AB] - l[HCI_CA]) + bb_cc + 2.0 * l[HCI_BC]) / 6.0;
    plane[1] = (2.0 * (l[HCI_AB] - l[HCI_CA]) - l[HCI_BB] + l[HCI_CC]) / sqrt(12.0);
    plane[2] = 0.5 * bb_cc - l[HCI_BC];
}

/* ---- values and slopes by θ at one angle ---- */

static void emf_at(const hci_machine *m, double theta_rad, double value[2], double slope[2])
{
    double e[3] = {0.0, 0.0, 0.0}, de[3] = {0.0, 0.0, 0.0}, abc[3];
    for (size_t k = 0; k < m->back_emf_count; ++k) {
        const hci_wave *w = &m->back_emf[k];
        const hci_wave derived = {w->order, w->sequence, -w->order * w->cosine, w->order * w->sine};
        hci_waves_at(w, 1, theta_rad, abc);
        for (int s = 0; s < 3; ++s)
            e[s] += abc[s];
        hci_waves_at(&derived, 1, theta_rad, abc);
        for (int s = 0; s < 3; ++s)
            de[s] += abc[s];
    }
    hci_plane_from_abc(e, value);
    hci_plane_from_abc(de, slope);
}

static void cogging_at(const hci_machine *m, double theta_rad, double *value, double *slope)
{
    *value = *slope = 0.0;
    for (size_t k = 0; k < m->cogging_count; ++k) {
        const hci_harmonic *c = &m->cogging[k];
        const hci_harmonic derived = {c->order, -c->order * c->cosine, c->order * c->sine};
        *value += hci_harmonics_at(c, 1, theta_rad);
        *slope += hci_harmonics_at(&derived, 1, theta_rad);
    }
}

static void inductance_at(const hci_plant_inductance *inductance, double theta_rad, double value[3],
                          double slope[3])
{
    const double mean = 0.5 * (inductance->d_H + inductance->q_H),
                 half = 0.5 * (inductance->d_H - inductance->q_H);
    const double c2 = half * cos(2.0 * theta_rad), s2 = half * sin(2.0 * theta_rad);
    double in_sine[3], in_cosine[3];
    /* The d axis is (−cos θ, −sin θ), the q axis (sin θ, −cos θ). */
    value[0] = mean + c2;
    value[1] = s2;
    value[2] = mean - c2;
    slope[0] = -2.0 * s2;
    slope[1] = 2.0 * c2;
    slope[2] = 2.0 * s2;
    for (size_t t = 0; t < inductance->count; ++t) {
        const hci_inductance *l = &inductance->terms[t];
        const double s = sin(l->order * theta_rad), c = cos(l->order * theta_rad);
        to_plane(l->sine, in_sine);
        to_plane(l->cosine, in_cosine);
        for (int k = 0; k < 3; ++k) {
            value[k] += in_sine[k] * s + in_cosine[k] * c;
            slope[k] += l->order * (in_sine[k] * c - in_cosine[k] * s);
        }
    }
}

/* ---- the table ---- */

static bool whole(double x)
{
    return x >= 0.0 && fabs(x - floor(x + 0.5)) < HCI_ORDER_TOLERANCE;
}

static bool repeats(const hci_machine *m, const hci_plant_inductance *inductance, double turns)
{
    bool good = true;
    for (size_t k = 0; k < m->back_emf_count; ++k)
        good = good && whole(turns * m->back_emf[k].order);
    for (size_t k = 0; k < m->cogging_count; ++k)
        good = good && whole(turns * m->cogging[k].order);
    for (size_t k = 0; k < inductance->count; ++k)
        good = good && whole(turns * inductance->terms[k].order);
    return good;
}

int hci_plant_table_turns(const hci_machine *machine, const hci_plant_inductance *inductance)
{
    if (machine->pole_pairs < 1) return 0;
    if (repeats(machine, inductance, 1.0)) return 1;
    return repeats(machine, inductance, machine->pole_pairs) ? machine->pole_pairs : 0;
}

size_t hci_plant_table_size(size_t points)
{
    return HCI_ROW * (points + 1);
}

static hci_status fill_row(const hci_machine *m, const hci_plant_inductance *inductance, double theta_rad,
                           double step_rad, double *row)
{
    double *slope = row + HCI_ROW_VALUES;
    const double *l = row + HCI_ROW_L;
    emf_at(m, theta_rad, row + HCI_ROW_E, slope + HCI_ROW_E);
    cogging_at(m, theta_rad, row + HCI_ROW_COGGING, slope + HCI_ROW_COGGING);
    inductance_at(inductance, theta_rad, row + HCI_ROW_L, slope + HCI_ROW_L);
    for (int k = 0; k < HCI_ROW_VALUES; ++k)
        slope[k] *= step_rad;
    for (int k = 0; k < HCI_ROW; ++k)
        if (!isfinite(row[k])) return HCI_ERROR_NOT_FINITE;
    return l[0] > 0.0 && l[0] * l[2] > l[1] * l[1] ? HCI_OK : HCI_ERROR_SINGULAR;
}

static bool is_salient(const double *rows, size_t points)
{
    bool salient = false;
    for (size_t k = 0; k < points; ++k)
        for (int l = HCI_ROW_L; l < HCI_ROW_VALUES; ++l)
            salient = salient || rows[k * HCI_ROW + HCI_ROW_VALUES + (size_t)l] != 0.0;
    return salient;
}

hci_status hci_plant_table_fill(const hci_machine *machine, const hci_plant_inductance *inductance,
                                size_t points, double *rows, hci_plant_table *table)
{
    const int turns = hci_plant_table_turns(machine, inductance);
    if (turns == 0 || points < 4 || points > INT_MAX / HCI_ROW) return HCI_ERROR_ARGUMENT;
    const double step_rad = 2.0 * HCI_PI * turns / (double)points;
    for (size_t k = 0; k < points; ++k) {
        const hci_status status =
            fill_row(machine, inductance, step_rad * (double)k, step_rad, rows + k * HCI_ROW);
        if (status != HCI_OK) return status;
    }
    for (int k = 0; k < HCI_ROW; ++k)
        rows[points * HCI_ROW + (size_t)k] = rows[k];
    table->rows = rows;
    table->points = (int)points;
    table->pole_pairs = machine->pole_pairs;
    table->turns = turns;
    table->salient = is_salient(rows, points);
    table->points_per_rad = machine->pole_pairs / step_rad;
    return HCI_OK;
}

hci_plant_point hci_plant_table_at(const hci_plant_table *table, double theta_m_rad)
{
    hci_plant_point p;
    hci_plant_table_point(table, theta_m_rad, &p);
    return p;
}
