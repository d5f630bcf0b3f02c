#include "hci/host/machine/machine.h"

#include <math.h>
#include <string.h>

#include "hci/host/csv/csv.h"
#include "host/base/memory.h"
#include "host/csv/table.h"
#include "host/machine/folder.h"
#include "host/machine/inductance.h"
#include "host/machine/machine_values.h"
#include "host/machine/saliency.h"
#include "host/machine/spectrum_table.h"

#define PATH_SIZE 4096

static hci_status read_values(const char *path, hci_machine_data *m, hci_note *note)
{
    hci_machine_values v;
    const hci_status status = hci_machine_values_read(path, &v, note);
    const double *value = v.value;
#define TAKE_ONE(field, name, unit) m->field = *value++;
    HCI_MACHINE_VALUES(TAKE_ONE)
#undef TAKE_ONE
    m->has_neutral = v.has_neutral;
    m->remark = v.remark;
    m->model.pole_pairs = status ? 0 : (int)m->pole_pairs;
    hci_machine_values_release(&v);
    return status;
}

/* Volts at the electrical frequency f become V·s/rad by ω_m = 2πf/p. */
static hci_status emf_scale(const hci_csv *csv, const hci_machine_data *m, double *scale, hci_note *note)
{
    *scale = 1.0;
    if (hci_csv_has(csv, "amplitude_Nm_per_A")) return HCI_OK;
    if (isnan(m->emf_frequency_Hz) || m->emf_frequency_Hz <= 0.0)
        return hci_note_set(
            note, HCI_ERROR_INPUT,
            "%s: the back-EMF is in volts, but machine.csv has no positive `emf_frequency`; add the "
            "electrical frequency in Hz at which it was measured, or give amplitude_Nm_per_A",
            hci_csv_path(csv));
    *scale = m->pole_pairs / (2.0 * HCI_PI * m->emf_frequency_Hz);
    return HCI_OK;
}

static hci_status check_emf_order(const hci_csv *csv, const hci_harmonic *h, const size_t *row_of, size_t k,
                                  hci_note *note)
{
    if (h[k].order >= 1.0 - HCI_ORDER_TOLERANCE &&
        fabs(h[k].order - floor(h[k].order + 0.5)) < HCI_ORDER_TOLERANCE)
        return HCI_OK;
    if (csv->orders_mechanical)
        return hci_csv_error(csv, "order", row_of[k], note, "an order that the pole pairs divide",
                             "--order-base mechanical says that orders count periods of a mechanical turn: "
                             "name this column electrical_order, if its orders do not");
    return hci_csv_error(csv, "order", row_of[k], note, "a whole electrical order from 1",
                         "orders count periods in one electrical turn: for those of a mechanical turn name "
                         "the column mechanical_order");
}

/* In N·m/A, or V·s/rad. */
#define LEAST_EMF 1e-12

static double largest_amplitude(const hci_harmonic *h, size_t count)
{
    double largest = 0.0;
    for (size_t k = 0; k < count; ++k)
        largest = fmax(largest, hci_amplitude(h[k].sine, h[k].cosine));
    return largest;
}

/* What has been read: whole orders, one at least, and not all zero. */
static hci_status check_emf(const hci_csv *csv, const hci_harmonic *h, const size_t *row_of, size_t count,
                            double scale, hci_note *note)
{
    hci_status status = HCI_OK;
    for (size_t k = 0; k < count && !status; ++k)
        status = check_emf_order(csv, h, row_of, k, note);
    if (!status && count == 0)
        status =
            hci_note_set(note, HCI_ERROR_INPUT, "%s: no rows, expected at least order 1", hci_csv_path(csv));
    if (!status && largest_amplitude(h, count) * scale < LEAST_EMF)
        status =
            hci_note_set(note, HCI_ERROR_INPUT,
                         "%s: every amplitude is zero or below 1e-12 N·m/A; check the values and their unit",
                         hci_csv_path(csv));
    return status;
}

static hci_status take_emf(const hci_csv *csv, hci_machine_data *m, hci_note *note)
{
    const char *amplitude = hci_csv_has(csv, "amplitude_Nm_per_A") ? "amplitude_Nm_per_A" : "amplitude_V";
    hci_harmonic *h = NULL;
    size_t count = 0, *row_of = NULL;
    double scale;
    hci_status status = emf_scale(csv, m, &scale, note);
    if (!status) status = hci_spectrum_rows(csv, amplitude, &h, &row_of, &count, note);
    if (!status) status = check_emf(csv, h, row_of, count, scale, note);
    if (!status && !(m->back_emf = hci_memory_new(count, sizeof *m->back_emf)))
        status = hci_note_memory(note, NULL, "%zu back-EMF orders", count);
    for (size_t k = 0; k < count && !status; ++k)
        m->back_emf[k] =
            (hci_wave){h[k].order, hci_sequence_of_order(h[k].order), scale * h[k].sine, scale * h[k].cosine};
    hci_memory_free(h);
    hci_memory_free(row_of);
    m->model.back_emf = m->back_emf;
    m->model.back_emf_count = status ? 0 : count;
    return status;
}

static hci_status read_emf(const char *path, hci_machine_data *m, hci_note *note)
{
    hci_csv *csv;
    hci_status status = hci_csv_read(path, &csv, note);
    if (status) return status;
    hci_csv_orders_of(csv, m->model.pole_pairs, m->order_base);
    status = take_emf(csv, m, note);
    if (!status) hci_spectrum_tell_degrees(csv, &m->remark);
    hci_csv_free(csv);
    return status;
}

static hci_status read_cogging(const char *path, hci_machine_data *m, hci_note *note)
{
    hci_csv *csv;
    size_t *row_of = NULL;
    hci_status status = hci_csv_read(path, &csv, note);
    if (status) return status;
    hci_csv_orders_of(csv, m->model.pole_pairs, m->order_base);
    status = hci_spectrum_rows(csv, "amplitude_Nm", &m->cogging, &row_of, &m->model.cogging_count, note);
    if (!status) hci_spectrum_tell_degrees(csv, &m->remark);
    m->model.cogging = m->cogging;
    hci_memory_free(row_of);
    hci_csv_free(csv);
    return status;
}

/* Cogging torque that was not measured looks like none. A machine with effects was diagnosed: it has them
 * there. */
static void tell_no_cogging(const char *folder, hci_machine_data *m)
{
    if (m->has_effects || m->model.cogging_count == 0 ||
        largest_amplitude(m->cogging, m->model.cogging_count) > 0.0)
        return;
    hci_note_add(
        &m->remark,
        "%s/cogging.csv: every amplitude is 0, so that no cogging torque is counteracted: if it was not "
        "measured, the real machine keeps all that it has",
        folder);
}

static hci_status read_inductance(const char *path, hci_machine_data *m, hci_note *note)
{
    hci_inductance_table table;
    const hci_status status = hci_inductance_read(path, m->model.pole_pairs, &table, note);
    m->inductance = table.inductance;
    m->inductance_count = table.inductance_count;
    m->slope = table.slope;
    m->model.slope = table.slope;
    m->model.slope_count = table.slope_count;
    return status;
}

static hci_status read_folder(const char *folder, hci_machine_data *m, hci_note *note)
{
    char path[PATH_SIZE];
    hci_status status = hci_machine_path(path, PATH_SIZE, folder, "machine.csv", note);
    if (!status) status = read_values(path, m, note);
    if (!status) status = hci_machine_path(path, PATH_SIZE, folder, "back_emf.csv", note);
    if (!status) status = read_emf(path, m, note);
    if (!status) status = hci_machine_path(path, PATH_SIZE, folder, "cogging.csv", note);
    if (!status && hci_machine_has(path)) status = read_cogging(path, m, note);
    if (!status) status = hci_machine_path(path, PATH_SIZE, folder, "inductance.csv", note);
    if (!status && hci_machine_has(path)) status = read_inductance(path, m, note);
    if (!status) status = hci_machine_path(path, PATH_SIZE, folder, "effects.csv", note);
    m->has_effects = !status && hci_machine_has(path);
    if (!status) tell_no_cogging(folder, m);
    if (!status && m->model.slope_count == 0 && m->inductance_count == 0)
        hci_saliency_remark(folder, folder, m->inductance_d_H, m->inductance_q_H, &m->remark);
    return status;
}

hci_status hci_machine_read(const char *path, hci_machine_data *machine, hci_note *note)
{
    return hci_machine_read_orders(path, HCI_ORDER_ELECTRICAL, machine, note);
}

hci_status hci_machine_read_orders(const char *path, hci_order_base base, hci_machine_data *machine,
                                   hci_note *note)
{
    memset(machine, 0, sizeof *machine);
    machine->order_base = base;
    hci_status status = hci_machine_check_folder(path, note);
    if (!status) status = read_folder(path, machine, note);
    if (!status) hci_machine_identify(path, machine);
    if (status) hci_machine_release(machine);
    return status;
}

void hci_machine_release(hci_machine_data *machine)
{
    hci_memory_free(machine->back_emf);
    hci_memory_free(machine->cogging);
    hci_memory_free(machine->slope);
    hci_memory_free(machine->inductance);
    memset(machine, 0, sizeof *machine);
}
