#include "host/machine/spectrum_table.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "host/base/memory.h"
#include "host/base/quote.h"
#include "host/csv/table.h"

#define MOST_AMPLITUDE 1e9

/* One row of an order–amplitude–phase table before it is sorted. */
typedef struct {
    hci_harmonic term;
    size_t row;
} spectrum_row;

/* The columns that the rows are made of. */
typedef struct {
    const hci_csv *csv;
    const char *amplitude_column;
    double *amplitude, *phase_rad, *order;
} spectrum_columns;

static int by_order(const void *a, const void *b)
{
    const spectrum_row *x = a, *y = b;
    if (x->term.order != y->term.order) return x->term.order < y->term.order ? -1 : 1;
    return x->row < y->row ? -1 : 1;
}

hci_status hci_spectrum_order_error(const hci_csv *csv, size_t row, hci_note *note)
{
    char expected[64];
    snprintf(expected, sizeof expected, "an order of at most %g", HCI_MOST_ORDER);
    return hci_csv_error(csv, "order", row, note, expected, "orders are electrical, not frequencies in Hz");
}

static hci_status check_row(const spectrum_columns *t, size_t row, hci_note *note)
{
    const hci_csv *csv = t->csv;
    const double order = t->order[row], amplitude = t->amplitude[row], phase_rad = t->phase_rad[row];
    const bool mean = order < HCI_ORDER_TOLERANCE;
    if (order < 0.0)
        return hci_csv_error(csv, "order", row, note, "an order of 0 or more",
                             "give a negative order as the positive one with phase π − γ");
    if (order > HCI_MOST_ORDER) return hci_spectrum_order_error(csv, row, note);
    if (fabs(amplitude) > MOST_AMPLITUDE)
        return hci_csv_error(csv, t->amplitude_column, row, note, "an amplitude of at most 1e9",
                             "check the value and its unit");
    if (mean && fabs(phase_rad) > 1e-3 && fabs(phase_rad - HCI_PI / 2) > 1e-3)
        return hci_csv_error(csv, "phase_rad", row, note, "0 or 1.5708 (π/2)",
                             "order 0 is the mean: its amplitude is signed and it has no phase");
    return HCI_OK;
}

static hci_status sort_rows(const hci_csv *csv, spectrum_row *rows, size_t count, hci_note *note)
{
    if (count > 1) qsort(rows, count, sizeof *rows, by_order);
    for (size_t k = 1; k < count; ++k)
        if (rows[k].term.order - rows[k - 1].term.order <= HCI_ORDER_TOLERANCE)
            return hci_csv_error(csv, "order", rows[k].row, note, "each order once",
                                 "join the two rows into one");
    return HCI_OK;
}

/* One row after the other, then by order. */
static hci_status read_rows(const spectrum_columns *t, spectrum_row *rows, size_t count, hci_note *note)
{
    hci_status status = hci_csv_numbers(t->csv, "order", t->order, note);
    if (!status) status = hci_csv_numbers(t->csv, t->amplitude_column, t->amplitude, note);
    if (!status) status = hci_csv_numbers(t->csv, "phase_rad", t->phase_rad, note);
    for (size_t k = 0; k < count && !status; ++k) {
        status = check_row(t, k, note);
        rows[k] = (spectrum_row){hci_harmonic_polar(t->order[k], t->amplitude[k], t->phase_rad[k]), k};
    }
    return status ? status : sort_rows(t->csv, rows, count, note);
}

void hci_spectrum_tell_degrees(const hci_csv *csv, hci_note *remark)
{
    const size_t count = hci_csv_rows(csv);
    double *phase_rad = hci_memory_new(count, sizeof *phase_rad), most_rad = 0.0;
    char path[HCI_QUOTE_PATH_SIZE];
    if (phase_rad == NULL) return;
    if (!hci_csv_numbers(csv, "phase_rad", phase_rad, NULL))
        for (size_t k = 0; k < count; ++k)
            if (fabs(phase_rad[k]) > fabs(most_rad)) most_rad = phase_rad[k];
    if (fabs(most_rad) > 4.0 * HCI_PI)
        hci_note_add(remark,
                     "%s: a phase of %g rad, which looks like degrees: if it is, name the column phase_deg",
                     hci_quote_path(hci_csv_path(csv), path), most_rad);
    hci_memory_free(phase_rad);
}

hci_status hci_spectrum_rows(const hci_csv *csv, const char *amplitude_column, hci_harmonic **terms,
                             size_t **row_of, size_t *count, hci_note *note)
{
    const size_t n = hci_csv_rows(csv);
    spectrum_row *rows = hci_memory_new(n, sizeof *rows);
    double *column = hci_memory_new(3 * n, sizeof *column);
    hci_status status = HCI_OK;
    *terms = hci_memory_new(n, sizeof **terms);
    *row_of = hci_memory_new(n, sizeof **row_of);
    if (!rows || !column || !*terms || !*row_of)
        status = hci_note_memory(note, hci_csv_path(csv), "%zu rows", n);
    if (!status)
        status = hci_csv_check_rows(csv, HCI_MOST_ORDERS_LISTED, "keep the orders that matter", note);
    if (!status) {
        const spectrum_columns t = {csv, amplitude_column, column, column + n, column + 2 * n};
        status = read_rows(&t, rows, n, note);
    }
    for (size_t k = 0; k < n && !status; ++k) {
        (*terms)[k] = rows[k].term;
        (*row_of)[k] = rows[k].row;
    }
    hci_memory_free(rows);
    hci_memory_free(column);
    if (status) {
        hci_memory_free(*terms);
        hci_memory_free(*row_of);
        *terms = NULL;
        *row_of = NULL;
    }
    *count = status ? 0 : n;
    return status;
}
