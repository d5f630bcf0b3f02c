#include "hci/host/solve/tables.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "hci/host/base/text.h"
#include "hci/host/csv/csv.h"
#include "host/base/memory.h"
#include "host/machine/spectrum_table.h"

#define MOST_WEIGHT 1e6

/* ---- target ---- */

static hci_status weights_read(const hci_csv *csv, const size_t *row_of, hci_target *target, hci_note *note)
{
    double *weight;
    hci_status status;
    for (size_t k = 0; k < target->count; ++k)
        target->order[k].weight = 1.0;
    if (!hci_csv_has(csv, "weight")) return HCI_OK;
    weight = hci_memory_new(target->count, sizeof *weight);
    if (!weight) return hci_note_set(note, HCI_ERROR_MEMORY, "%s: out of memory", hci_csv_path(csv));
    status = hci_csv_numbers(csv, "weight", weight, note);
    for (size_t k = 0; k < target->count && !status; ++k) {
        target->order[k].weight = weight[row_of[k]];
        if (weight[row_of[k]] > MOST_WEIGHT ||
            (weight[row_of[k]] > 0.0 && weight[row_of[k]] < 1.0 / MOST_WEIGHT))
            status = hci_csv_error(csv, "weight", row_of[k], note, "0, or 1e-6 to 1e6",
                                   "weights compare orders with each other; 1 is usual");
        else if (weight[row_of[k]] < 0.0)
            status = hci_csv_error(csv, "weight", row_of[k], note, "0 or more",
                                   "0 means: this order may be anything");
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
        status = hci_note_set(note, HCI_ERROR_MEMORY, "%s: out of memory", hci_csv_path(csv));
    for (size_t k = 0; k < target->count && !status; ++k)
        target->order[k].torque_Nm = terms[k];
    if (!status) status = weights_read(csv, row_of, target, note);
    hci_memory_free(terms);
    hci_memory_free(row_of);
    return status;
}

hci_status hci_target_read(const char *path, hci_target *target, hci_note *note)
{
    hci_csv *csv;
    hci_status status = hci_csv_read(path, &csv, note);
    memset(target, 0, sizeof *target);
    if (status) return status;
    status = target_from_csv(csv, target, note);
    hci_csv_free(csv);
    if (status) hci_target_release(target);
    return status;
}

void hci_target_release(hci_target *target)
{
    hci_memory_free(target->order);
    memset(target, 0, sizeof *target);
}

/* ---- components ---- */

static const char *const SET_NAME[] = {"pos", "neg", "sym", "asym", "zero"};
enum { SETS = sizeof SET_NAME / sizeof SET_NAME[0] };

const char *hci_set_name(hci_set set)
{
    return SET_NAME[set];
}

static bool is_whole(double x)
{
    return fabs(x - floor(x + 0.5)) < HCI_ORDER_TOLERANCE;
}

/* The sequence that a set name stands for at an order. */
static hci_status sequence_read(const hci_csv *csv, size_t row, double order, bool has_neutral, hci_set *set,
                                int *sequence, hci_note *note)
{
    const char *text;
    int k = 0;
    const hci_status status = hci_csv_text(csv, "set", row, &text, note);
    if (status) return status;
    while (k < SETS && !hci_text_is(text, SET_NAME[k]))
        ++k;
    if (k == SETS)
        return hci_csv_error(csv, "set", row, note, "`pos`, `neg`, `sym` or `asym`",
                             "`pos` and `neg` are the positive and negative sequence");
    *set = (hci_set)k;
    if (*set == HCI_SET_SYM && !is_whole(order))
        return hci_csv_error(csv, "order", row, note, "a whole order with `sym`",
                             "use `pos` or `neg` instead");
    *sequence = *set == HCI_SET_NEG    ? -1
                : *set == HCI_SET_ZERO ? 0
                : *set == HCI_SET_SYM  ? hci_sequence_of_order(order)
                                       : 1;
    if (*sequence == 0 && !has_neutral)
        return hci_csv_error(
            csv, "set", row, note, "a component that a star connection carries",
            "`zero`, and `sym` at orders divisible by three, need a neutral; use `asym`, `pos` or `neg`");
    return HCI_OK;
}

/* Order and component of one row; (0, −1) spans the same plane as (0, +1) and is kept as the latter. */
static hci_status component_read(const hci_csv *csv, size_t row, double order, bool has_neutral,
                                 hci_component *c, hci_set *set, hci_note *note)
{
    if (order < 0.0)
        return hci_csv_error(csv, "order", row, note, "an order of 0 or more",
                             "a negative order is the positive one with the other sequence");
    if (order > HCI_MOST_ORDER) return hci_spectrum_order_error(csv, row, note);
    c->order = order;
    return sequence_read(csv, row, order, has_neutral, set, &c->sequence, note);
}

static size_t component_find(const hci_component *list, size_t count, hci_component c)
{
    size_t k = 0;
    while (k < count &&
           !(list[k].sequence == c.sequence && fabs(list[k].order - c.order) < HCI_ORDER_TOLERANCE))
        ++k;
    return k;
}

static void remark_repeat(hci_component_set *set, hci_component c, hci_set first, hci_set second)
{
    const size_t used = strlen(set->remark.text);
    snprintf(set->remark.text + used, sizeof set->remark.text - used,
             "%s%s %g and %s %g are the same component and count once", used ? "; " : "", hci_set_name(first),
             c.order, hci_set_name(second), c.order);
}

static hci_status set_row(const hci_csv *csv, size_t row, double order, bool has_neutral,
                          hci_component_set *set, hci_note *note)
{
    hci_component c;
    hci_set name;
    size_t at;
    const hci_status status = component_read(csv, row, order, has_neutral, &c, &name, note);
    if (status) return status;
    if (c.order < HCI_ORDER_TOLERANCE && c.sequence == -1) c.sequence = 1;
    at = component_find(set->component, set->count, c);
    if (at < set->count) {
        remark_repeat(set, c, set->set[at], name);
        return HCI_OK;
    }
    set->component[set->count] = c;
    set->set[set->count++] = name;
    return HCI_OK;
}

static hci_status set_from_csv(const hci_csv *csv, bool has_neutral, hci_component_set *set, hci_note *note)
{
    const size_t rows = hci_csv_rows(csv);
    double *order = hci_memory_new(rows, sizeof *order);
    hci_status status = HCI_OK;
    set->component = hci_memory_new(rows, sizeof *set->component);
    set->set = hci_memory_new(rows, sizeof *set->set);
    if (!order || !set->component || !set->set)
        status = hci_note_set(note, HCI_ERROR_MEMORY, "%s: out of memory", hci_csv_path(csv));
    if (!status) status = hci_csv_numbers(csv, "order", order, note);
    if (!status && !hci_csv_has(csv, "set"))
        status = hci_note_set(note, HCI_ERROR_INPUT, "%s:1: no column `set`; expected the columns order,set",
                              hci_csv_path(csv));
    for (size_t k = 0; k < rows && !status; ++k)
        status = set_row(csv, k, order[k], has_neutral, set, note);
    hci_memory_free(order);
    return status;
}

hci_status hci_component_set_read(const char *path, bool has_neutral, hci_component_set *set, hci_note *note)
{
    hci_csv *csv;
    hci_status status = hci_csv_read(path, &csv, note);
    memset(set, 0, sizeof *set);
    if (status) return status;
    status = set_from_csv(csv, has_neutral, set, note);
    hci_csv_free(csv);
    if (status) hci_component_set_release(set);
    return status;
}

void hci_component_set_release(hci_component_set *set)
{
    hci_memory_free(set->component);
    hci_memory_free(set->set);
    memset(set, 0, sizeof *set);
}

/* ---- currents ---- */

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
    double *order = column, *amplitude = column + rows, *phase = column + 2 * rows;
    hci_status status = hci_csv_numbers(csv, "order", order, note);
    if (!status)
        status = hci_csv_numbers(csv, per_Nm ? "amplitude_A_per_Nm" : "amplitude_A", amplitude, note);
    if (!status) status = hci_csv_numbers(csv, "phase_rad", phase, note);
    for (size_t k = 0; k < rows && !status; ++k) {
        hci_component c = {0.0, 0};
        status = component_read(csv, k, order[k], true, &c, &currents->set[k], note);
        currents->wave[k] = hci_wave_polar(c.order, c.sequence, amplitude[k], phase[k]);
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
    if (!column || !currents->wave || !currents->set)
        status = hci_note_set(note, HCI_ERROR_MEMORY, "%s: out of memory", path);
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
