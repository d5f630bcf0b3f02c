/* Sets of current components. In: harmonics.csv (order, set); out: each component once. */
#include "hci/host/currents/component_set.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "hci/host/base/text.h"
#include "host/base/memory.h"
#include "host/csv/table.h"
#include "host/currents/component_row.h"
#include "host/machine/spectrum_table.h"

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

static hci_status name_read(const hci_csv *csv, size_t row, hci_set *name, hci_note *note)
{
    const char *text;
    int k = 0;
    const hci_status status = hci_csv_text(csv, "set", row, &text, note);
    if (status) return status;
    while (k < SETS && !hci_text_is(text, SET_NAME[k]))
        ++k;
    if (k == SETS)
        return hci_csv_error(csv, "set", row, note, "`pos`, `neg`, `sym` or `asym`, or `zero` with a neutral",
                             "`pos` and `neg` are the positive and negative sequence");
    *name = (hci_set)k;
    return HCI_OK;
}

/* The sequence that a name stands for at an order. */
static int sequence_of(hci_set name, double order)
{
    if (name == HCI_SET_NEG) return -1;
    if (name == HCI_SET_ZERO) return 0;
    return name == HCI_SET_SYM ? hci_sequence_of_order(order) : 1;
}

hci_status hci_component_row_read(const hci_csv *csv, size_t row, double order, bool has_neutral,
                                  hci_component_row *c, hci_note *note)
{
    hci_status status;
    if (order < 0.0)
        return hci_csv_error(csv, "order", row, note, "an order of 0 or more",
                             "a negative order is the positive one with the other sequence");
    if (order > HCI_MOST_ORDER) return hci_spectrum_order_error(csv, row, note);
    status = name_read(csv, row, &c->name, note);
    if (status) return status;
    if (c->name == HCI_SET_SYM && !is_whole(order))
        return hci_csv_error(csv, "order", row, note, "a whole order with `sym`",
                             "use `pos` or `neg` instead");
    c->component = (hci_component){order, sequence_of(c->name, order)};
    if (c->component.sequence == 0 && !has_neutral)
        return hci_csv_error(
            csv, "set", row, note, "a component that a star connection carries",
            "`zero`, and `sym` at orders divisible by three, need a neutral; use `asym`, `pos` or `neg`");
    return HCI_OK;
}

static size_t find_component(const hci_component *list, size_t count, hci_component c)
{
    size_t k = 0;
    while (k < count &&
           !(list[k].sequence == c.sequence && fabs(list[k].order - c.order) < HCI_ORDER_TOLERANCE))
        ++k;
    return k;
}

static void remark_repeat(hci_component_set *set, hci_component c, hci_set first, hci_set second)
{
    hci_note_add(&set->remark, "%s %g and %s %g are the same component and count once", hci_set_name(first),
                 c.order, hci_set_name(second), c.order);
}

/* Adds the component of a row, unless it is there already. (0, −1) spans the same plane as (0, +1) and is
 * kept as the latter. */
static hci_status add_row(const hci_csv *csv, size_t row, double order, bool has_neutral,
                          hci_component_set *set, hci_note *note)
{
    hci_component_row c;
    size_t at;
    const hci_status status = hci_component_row_read(csv, row, order, has_neutral, &c, note);
    if (status) return status;
    if (order < HCI_ORDER_TOLERANCE && c.component.sequence == -1) c.component.sequence = 1;
    at = find_component(set->component, set->count, c.component);
    if (at < set->count) {
        remark_repeat(set, c.component, set->set[at], c.name);
        return HCI_OK;
    }
    set->component[set->count] = c.component;
    set->set[set->count++] = c.name;
    return HCI_OK;
}

static hci_status set_from_csv(const hci_csv *csv, bool has_neutral, hci_component_set *set, hci_note *note)
{
    const size_t rows = hci_csv_rows(csv);
    double *order = hci_memory_new(rows, sizeof *order);
    hci_status status = HCI_OK;
    set->component = hci_memory_new(rows, sizeof *set->component);
    set->set = hci_memory_new(rows, sizeof *set->set);
    if (!order || !set->component || !set->set) status = hci_note_memory(note, hci_csv_path(csv), "its rows");
    if (!status)
        status = hci_csv_check_rows(csv, HCI_MOST_ORDERS_LISTED, "keep the orders that matter", note);
    if (!status) status = hci_csv_numbers(csv, "order", order, note);
    if (!status && !hci_csv_has(csv, "set"))
        status = hci_note_set(note, HCI_ERROR_INPUT, "%s:1: no column `set`; expected the columns order,set",
                              hci_csv_path(csv));
    for (size_t k = 0; k < rows && !status; ++k)
        status = add_row(csv, k, order[k], has_neutral, set, note);
    hci_memory_free(order);
    return status;
}

hci_status hci_component_set_read(const char *path, bool has_neutral, hci_component_set *set, hci_note *note)
{
    const hci_set_tables of = {.has_neutral = has_neutral};
    return hci_component_set_read_orders(path, &of, set, note);
}

hci_status hci_component_set_read_orders(const char *path, const hci_set_tables *of, hci_component_set *set,
                                         hci_note *note)
{
    hci_csv *csv;
    hci_status status = hci_csv_read(path, &csv, note);
    memset(set, 0, sizeof *set);
    if (status) return status;
    hci_csv_orders_of(csv, of->pole_pairs, of->order_base);
    status = set_from_csv(csv, of->has_neutral, set, note);
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
