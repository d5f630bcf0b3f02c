/* The numbers of a machine folder as they stand. Tables are read cell by cell and not by the loader, which
 * refuses some of what a convention error makes of them. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "hci/host/machine/init.h"
#include "hci/machine/frames.h"
#include "host/base/memory.h"
#include "host/check/data/data.h"
#include "host/machine/folder.h"
#include "host/machine/inductance.h"
#include "host/machine/machine_values.h"
#include "host/machine/saliency.h"
#include "host/machine/spectrum_table.h"

static void keep_text(char out[CHECK_TEXT], const char *text)
{
    snprintf(out, CHECK_TEXT, "%s", text);
}

/* The place of a cell of data row `row` in the column that the file has for `name`. */
static check_place place_of(const hci_csv *csv, const char *path, const char *name, size_t row)
{
    check_place place = {.path = path, .line = hci_csv_line(csv, row)};
    const char *text = "";
    hci_note none = {{0}};
    size_t column;
    if (hci_csv_find(csv, name, &column)) keep_text(place.column, hci_csv_name(csv, column));
    if (hci_csv_text(csv, name, row, &text, &none) == HCI_OK) keep_text(place.text, text);
    return place;
}

/* ---- machine.csv */

static hci_status slots_check(const check_data *data, hci_note *note)
{
    const double slots = data->value[CHECK_slots];
    if (isnan(slots) || (slots >= 3.0 && slots <= HCI_MOST_SLOTS && slots == floor(slots))) return HCI_OK;
    return hci_note_set(note, HCI_ERROR_INPUT,
                        "%s:%zu: `slots`: found %g, expected a whole number from 3 to %d; count the teeth of "
                        "the stator, or delete the row",
                        data->machine_path, data->cell[CHECK_slots].line, slots, (int)HCI_MOST_SLOTS);
}

static hci_status values_read(check_data *data, hci_note *remark, hci_note *note)
{
    hci_machine_values v;
    const hci_status status = hci_machine_values_read(data->machine_path, &v, note);
    for (size_t k = 0; k < CHECK_VALUE_COUNT && !status; ++k) {
        data->value[k] = v.value[k];
        if (!isnan(v.value[k])) data->cell[k] = place_of(v.csv, data->machine_path, "value", v.row[k]);
    }
    data->has_neutral = v.has_neutral;
    *remark = v.remark;
    hci_machine_values_release(&v);
    return status ? status : slots_check(data, note);
}

/* ---- order, amplitude, phase */

static void find_largest(check_table *t)
{
    for (size_t k = 0; k < t->count; ++k) {
        if (fabs(t->amplitude[k]) > fabs(t->amplitude[t->largest])) t->largest = k;
        t->most_phase_rad = fmax(t->most_phase_rad, fabs(t->phase_rad[k]));
    }
}

static hci_status columns_read(const hci_csv *csv, const char *amplitude, check_table *t, hci_note *note)
{
    const size_t n = hci_csv_rows(csv);
    hci_status status;
    t->order = hci_memory_new(3 * n, sizeof *t->order);
    if (!t->order) return hci_note_memory(note, t->path, "its rows");
    t->amplitude = t->order + n;
    t->phase_rad = t->order + 2 * n;
    status = hci_csv_numbers(csv, "order", t->order, note);
    if (!status) status = hci_csv_numbers(csv, amplitude, t->amplitude, note);
    if (!status) status = hci_csv_numbers(csv, "phase_rad", t->phase_rad, note);
    if (status || n == 0) return status;
    t->count = n;
    find_largest(t);
    t->order_cell = place_of(csv, t->path, "order", t->largest);
    t->amplitude_cell = place_of(csv, t->path, amplitude, t->largest);
    t->phase_cell = place_of(csv, t->path, "phase_rad", t->largest);
    return HCI_OK;
}

/* Ordinary mistakes (orders below 0 or twice, text) are those of the reader of tables. */
static hci_status table_check(const hci_csv *csv, const char *amplitude, hci_note *note)
{
    hci_harmonic *terms = NULL;
    size_t *row_of = NULL, count;
    const hci_status status = hci_spectrum_rows(csv, amplitude, &terms, &row_of, &count, note);
    hci_memory_free(terms);
    hci_memory_free(row_of);
    return status;
}

static hci_status emf_read(check_data *data, hci_note *note)
{
    hci_csv *csv;
    hci_status status = hci_csv_read(data->emf.path, &csv, note);
    if (status) return status;
    data->emf_in_volts = !hci_csv_has(csv, "amplitude_Nm_per_A");
    const char *amplitude = data->emf_in_volts ? "amplitude_V" : "amplitude_Nm_per_A";
    hci_csv_orders_of(csv, (int)data->value[CHECK_pole_pairs], data->order_base);
    status = table_check(csv, amplitude, note);
    if (!status) status = columns_read(csv, amplitude, &data->emf, note);
    hci_csv_free(csv);
    if (status) return status;
    if (data->emf.count == 0 || !(fabs(data->emf.amplitude[data->emf.largest]) > 0.0))
        return hci_note_set(note, HCI_ERROR_INPUT, "%s: no amplitude above 0, expected at least order 1",
                            data->emf.path);
    if (data->emf_in_volts && !(data->value[CHECK_emf_frequency_Hz] > 0.0))
        return hci_note_set(
            note, HCI_ERROR_INPUT,
            "%s: the back-EMF is in volts, but machine.csv has no positive `emf_frequency`; add the "
            "electrical frequency in Hz at which it was measured, or give amplitude_Nm_per_A",
            data->emf.path);
    return HCI_OK;
}

static hci_status cogging_read(check_data *data, hci_note *note)
{
    hci_csv *csv;
    hci_status status = hci_csv_read(data->cogging.path, &csv, note);
    if (status) return status;
    hci_csv_orders_of(csv, (int)data->value[CHECK_pole_pairs], data->order_base);
    status = table_check(csv, "amplitude_Nm", note);
    if (!status) status = columns_read(csv, "amplitude_Nm", &data->cogging, note);
    hci_csv_free(csv);
    return status;
}

/* ---- inductance.csv */

enum { ANGLES = 720 };

/* Phase currents of i_d, i_q at an angle. */
static void phase_currents(double d, double q, double theta_rad, double i[3])
{
    hci_clarke_inverse(hci_park_inverse((hci_dq){.d = d, .q = q}, theta_rad), i);
}

static double mean_reluctance(const hci_inductance_table *t, int pole_pairs)
{
    const hci_machine m = {.pole_pairs = pole_pairs, .slope = t->slope, .slope_count = t->slope_count};
    double sum = 0.0, i[3];
    for (int k = 0; k < ANGLES; ++k) {
        const double theta_rad = 2.0 * HCI_PI * k / ANGLES;
        phase_currents(1.0, 1.0, theta_rad, i);
        sum += hci_torque_at(&m, theta_rad, i) / ANGLES;
    }
    return sum;
}

static double energy_twice(const hci_inductance_table *t, double theta_rad, const double i[3])
{
    static const int A[] = {0, 1, 2, 0, 1, 2}, B[] = {0, 1, 2, 1, 2, 0};
    double sum = 0.0;
    for (size_t m = 0; m < t->inductance_count; ++m) {
        const hci_inductance *l = &t->inductance[m];
        const double s = sin(l->order * theta_rad), c = cos(l->order * theta_rad);
        for (int q = 0; q < HCI_PHASE_MATRIX; ++q)
            sum += (q < 3 ? 1.0 : 2.0) * i[A[q]] * i[B[q]] * (l->sine[q] * s + l->cosine[q] * c);
    }
    return sum;
}

/* ½ iᵀLi = ½·3/2·L_d i_d² for i_d = 1 A, and so for q. */
static double mean_inductance(const hci_inductance_table *t, double d, double q)
{
    double sum = 0.0, i[3];
    if (t->inductance_count == 0) return NAN;
    for (int k = 0; k < ANGLES; ++k) {
        const double theta_rad = 2.0 * HCI_PI * k / ANGLES;
        phase_currents(d, q, theta_rad, i);
        sum += energy_twice(t, theta_rad, i) / ANGLES;
    }
    return sum / 1.5;
}

static hci_status slope_cell_read(check_inductance *l, hci_note *note)
{
    hci_csv *csv;
    const hci_status status = hci_csv_read(l->path, &csv, note);
    if (status) return status;
    l->cell = place_of(csv, l->path, "dLa_H_per_rad", 0);
    hci_csv_free(csv);
    return HCI_OK;
}

static hci_status inductance_read(check_data *data, hci_note *note)
{
    check_inductance *l = &data->inductance;
    const int pole_pairs = (int)data->value[CHECK_pole_pairs];
    hci_inductance_table table;
    const hci_status status = hci_inductance_read(l->path, pole_pairs, &table, note);
    if (status) return status;
    l->given = true;
    l->are_slopes = table.inductance_count == 0;
    l->reluctance_Nm_per_A2 = mean_reluctance(&table, pole_pairs);
    l->inductance_d_H = mean_inductance(&table, 1.0, 0.0);
    l->inductance_q_H = mean_inductance(&table, 0.0, 1.0);
    hci_memory_free(table.inductance);
    hci_memory_free(table.slope);
    return l->are_slopes ? slope_cell_read(l, note) : HCI_OK;
}

/* ---- the folder */

hci_status hci_check_machine_read(const char *folder, check_data *data, hci_note *remark, hci_note *note)
{
    hci_status status = hci_machine_check_folder(folder, note);
    for (size_t k = 0; k < CHECK_VALUE_COUNT; ++k)
        data->value[k] = NAN;
    if (!status) status = hci_machine_path(data->machine_path, CHECK_PATH, folder, "machine.csv", note);
    if (!status) status = values_read(data, remark, note);
    if (!status) status = hci_machine_path(data->emf.path, CHECK_PATH, folder, "back_emf.csv", note);
    if (!status) status = emf_read(data, note);
    if (!status) status = hci_machine_path(data->cogging.path, CHECK_PATH, folder, "cogging.csv", note);
    if (!status && hci_machine_has(data->cogging.path)) status = cogging_read(data, note);
    if (!status) status = hci_machine_path(data->inductance.path, CHECK_PATH, folder, "inductance.csv", note);
    if (!status && hci_machine_has(data->inductance.path)) status = inductance_read(data, note);
    if (!status && !data->inductance.given)
        hci_saliency_remark(folder, folder, data->value[CHECK_inductance_d_H],
                            data->value[CHECK_inductance_q_H], remark);
    return status;
}
