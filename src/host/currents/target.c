/* The wanted torque. In: target.csv (order, amplitude, phase, weight); out: one entry for each order. */
#include "hci/host/currents/target.h"

#include <math.h>
#include <string.h>

#include "hci/host/base/number.h"
#include "hci/host/csv/csv.h"
#include "host/base/memory.h"
#include "host/machine/spectrum_table.h"

#define MOST_WEIGHT 1e6

/* 0, or between 1/MOST_WEIGHT and MOST_WEIGHT, so that the system of equations stays well scaled. */
static hci_status weight_check(const hci_csv *csv, size_t row, double weight, hci_note *note)
{
    if (weight > MOST_WEIGHT || (weight > 0.0 && weight < 1.0 / MOST_WEIGHT))
        return hci_csv_error(csv, "weight", row, note, "0, or 1e-6 to 1e6",
                             "weights compare orders with each other; 1 is usual");
    if (weight < 0.0)
        return hci_csv_error(csv, "weight", row, note, "0 or more", "0 means: this order may be anything");
    return HCI_OK;
}

/* The weights of the orders; 1 where the file has no such column. row_of: the row each order stood in. */
static hci_status weights_read(const hci_csv *csv, const size_t *row_of, hci_target *target, hci_note *note)
{
    double *weight;
    hci_status status;
    for (size_t k = 0; k < target->count; ++k)
        target->order[k].weight = 1.0;
    if (!hci_csv_has(csv, "weight")) return HCI_OK;
    weight = hci_memory_new(target->count, sizeof *weight);
    if (!weight) return hci_note_memory(note, hci_csv_path(csv), "its rows");
    status = hci_csv_numbers(csv, "weight", weight, note);
    for (size_t k = 0; k < target->count && !status; ++k) {
        target->order[k].weight = weight[row_of[k]];
        status = weight_check(csv, row_of[k], weight[row_of[k]], note);
    }
    hci_memory_free(weight);
    return status;
}

static hci_status target_from_csv(const hci_csv *csv, hci_target *target, hci_note *note)
{
    hci_harmonic *terms = NULL;
    size_t *row_of = NULL;
    hci_status status = hci_spectrum_rows(csv, "amplitude_Nm", &terms, &row_of, &target->count, note);
    if (!status && target->count == 0)
        status = hci_note_set(note, HCI_ERROR_INPUT,
                              "%s: no rows, expected at least the mean torque (order 0)", hci_csv_path(csv));
    if (!status && !(target->order = hci_memory_new(target->count, sizeof *target->order)))
        status = hci_note_memory(note, hci_csv_path(csv), "its rows");
    for (size_t k = 0; k < target->count && !status; ++k)
        target->order[k].torque_Nm = terms[k];
    if (!status) status = weights_read(csv, row_of, target, note);
    hci_memory_free(terms);
    hci_memory_free(row_of);
    return status;
}

hci_status hci_target_read(const char *path, hci_target *target, hci_note *note)
{
    hci_note remark = {{0}};
    return hci_target_read_orders(path, HCI_ORDER_ELECTRICAL, 0, target, &remark, note);
}

hci_status hci_target_read_orders(const char *path, hci_order_base base, int pole_pairs, hci_target *target,
                                  hci_note *remark, hci_note *note)
{
    hci_csv *csv;
    double number;
    hci_note why = {{0}};
    hci_status status = hci_csv_read(path, &csv, &why);
    memset(target, 0, sizeof *target);
    if (status == HCI_ERROR_INPUT && hci_number_parse(path, &number))
        return hci_note_set(
            note, status,
            "target: found the number %s, expected a file of orders; for a constant torque one "
            "with the two lines order,amplitude_Nm,phase_rad and 0,%s,0",
            path, path);
    if (status) {
        *note = why;
        return status;
    }
    hci_csv_orders_of(csv, pole_pairs, base);
    status = target_from_csv(csv, target, note);
    if (!status) hci_spectrum_tell_degrees(csv, remark);
    hci_csv_free(csv);
    if (status) hci_target_release(target);
    return status;
}

void hci_target_release(hci_target *target)
{
    hci_memory_free(target->order);
    memset(target, 0, sizeof *target);
}

hci_target_order hci_target_at(const hci_target *target, double order)
{
    for (size_t k = 0; k < target->count; ++k)
        if (fabs(target->order[k].torque_Nm.order - order) < HCI_ORDER_TOLERANCE) return target->order[k];
    return (hci_target_order){{order, 0.0, 0.0}, 1.0};
}

double hci_target_mean_Nm(const hci_target *target)
{
    return hci_target_at(target, 0.0).torque_Nm.cosine;
}
