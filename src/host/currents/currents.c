/* Currents as waves. In: currents.csv (order, set, amplitude, phase); out: each row's wave in linear
 * coordinates, and a hash of them all by which an emitted table names what it was made of. */
#include "hci/host/currents/currents.h"

#include <string.h>

#include "host/base/memory.h"
#include "host/csv/table.h"
#include "host/currents/component_row.h"

/* FNV-1a, 64 bits. */
static void hash_bytes(uint64_t *hash, const void *data, size_t size)
{
    const unsigned char *byte = data;
    for (size_t k = 0; k < size; ++k)
        *hash = (*hash ^ byte[k]) * UINT64_C(1099511628211);
}

static void currents_hash(hci_currents *currents)
{
    currents->hash = UINT64_C(14695981039346656037);
    for (size_t k = 0; k < currents->count; ++k) {
        const hci_wave *w = &currents->wave[k];
        const double values[4] = {w->order, w->sequence, w->sine, w->cosine};
        hash_bytes(&currents->hash, values, sizeof values);
    }
}

static hci_status currents_parse(const hci_csv *csv, bool per_Nm, hci_currents *currents, double *column,
                                 hci_note *note)
{
    const size_t rows = hci_csv_rows(csv);
    double *order = column, *amplitude = column + rows, *phase_rad = column + 2 * rows;
    hci_status status = hci_csv_check_rows(csv, HCI_MOST_ORDERS_LISTED, "keep the orders that matter", note);
    if (!status) status = hci_csv_numbers(csv, "order", order, note);
    if (!status)
        status = hci_csv_numbers(csv, per_Nm ? "amplitude_A_per_Nm" : "amplitude_A", amplitude, note);
    if (!status) status = hci_csv_numbers(csv, "phase_rad", phase_rad, note);
    for (size_t k = 0; k < rows && !status; ++k) {
        hci_component_row c = {{0.0, 0}, HCI_SET_POS};
        status = hci_component_row_read(csv, k, order[k], true, &c, note);
        currents->set[k] = c.name;
        currents->wave[k] =
            hci_wave_polar(c.component.order, c.component.sequence, amplitude[k], phase_rad[k]);
        currents->count = k + 1;
    }
    return status;
}

hci_status hci_currents_read(const char *path, bool per_Nm, hci_currents *currents, hci_note *note)
{
    hci_csv *csv;
    double *column;
    hci_status status = hci_csv_read(path, &csv, note);
    memset(currents, 0, sizeof *currents);
    if (status) return status;
    column = hci_memory_new(3 * hci_csv_rows(csv), sizeof *column);
    currents->wave = hci_memory_new(hci_csv_rows(csv), sizeof *currents->wave);
    currents->set = hci_memory_new(hci_csv_rows(csv), sizeof *currents->set);
    if (!column || !currents->wave || !currents->set) status = hci_note_memory(note, path, "its rows");
    if (!status) status = currents_parse(csv, per_Nm, currents, column, note);
    if (!status) currents_hash(currents);
    hci_memory_free(column);
    hci_csv_free(csv);
    if (status) hci_currents_release(currents);
    return status;
}

void hci_currents_release(hci_currents *currents)
{
    hci_memory_free(currents->wave);
    hci_memory_free(currents->set);
    memset(currents, 0, sizeof *currents);
}
