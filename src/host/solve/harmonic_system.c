/* The harmonic system U x = h. In: a task and components; out: which torque orders are compared, U and h with
 * the weights of the target. The entries of U are those of theory.md, section 4. */
#include "host/solve/harmonic_system.h"

#include <math.h>
#include <string.h>

#include "host/base/memory.h"

/* ---- which orders are compared ---- */

static size_t most_orders(const hci_task *t, size_t count)
{
    return 1 + t->target->count + t->machine->cogging_count + t->offset_count +
           2 * t->gradient_count * (count + 1);
}

/* Orders that matter whatever the components: mean, target, cogging, torque of what is held. */
static size_t given_orders(const hci_task *t, double *order)
{
    const hci_machine *m = t->machine;
    size_t n = 0;
    order[n++] = 0.0;
    for (size_t k = 0; k < t->target->count; ++k)
        order[n++] = t->target->order[k].torque_Nm.order;
    for (size_t k = 0; k < m->cogging_count; ++k)
        order[n++] = m->cogging[k].order;
    for (size_t k = 0; k < t->offset_count; ++k)
        order[n++] = t->offset[k].order;
    if (t->held)
        n += hci_component_orders(t->gradient, t->gradient_count,
                                  (hci_component){t->held->order, t->held->sequence}, order + n);
    return hci_orders_sort(order, n);
}

/* Orders of weight 0, and above the highest that is to be compared, are not. */
static size_t drop_free_orders(const hci_task *t, double *order, size_t n)
{
    const double top = t->compared_up_to > 0.0 ? t->compared_up_to + HCI_ORDER_TOLERANCE : HUGE_VAL;
    size_t kept = 0;
    for (size_t k = 0; k < n; ++k)
        if (order[k] <= top && hci_target_at(t->target, order[k]).weight > 0.0) order[kept++] = order[k];
    return kept;
}

/* Of n sorted orders and `more` behind them, sorted, each once: most of those behind are among the others. */
static size_t merge_orders(double *order, size_t n, size_t more)
{
    size_t kept = n;
    for (size_t k = n; k < n + more; ++k)
        if (hci_orders_find(order, n, order[k]) == n) order[kept++] = order[k];
    return hci_orders_sort(order, kept);
}

static size_t all_orders(const hci_task *t, const hci_component *component, size_t count, double *order)
{
    size_t n = given_orders(t, order);
    for (size_t k = 0; k < count; ++k)
        n = merge_orders(order, n,
                         hci_component_orders(t->gradient, t->gradient_count, component[k], order + n));
    return drop_free_orders(t, order, n);
}

/* The paper's square system: as many orders as components. The given ones come first, then the lowest others.
 * With a held fundamental the mean is left out and U is square; without one the mean is compared, which
 * leaves one unknown free. spare: workspace for as many orders again. */
static size_t square_orders(const hci_task *t, double *order, size_t n, size_t count, double *spare)
{
    const size_t given = drop_free_orders(t, spare, given_orders(t, spare));
    size_t taken = 0;
    for (size_t k = 0; k < given; ++k)
        if (!t->held || spare[k] >= HCI_ORDER_TOLERANCE) spare[taken++] = spare[k];
    for (size_t k = 0, named = taken; k < n; ++k)
        if (order[k] >= HCI_ORDER_TOLERANCE && hci_orders_find(spare, named, order[k]) == named)
            spare[taken++] = order[k];
    if (taken > count) taken = count;
    memcpy(order, spare, taken * sizeof *order);
    return hci_orders_sort(order, taken);
}

/* ---- right-hand sides ---- */

static void add_at(const hci_harmonic_system *b, double factor, hci_harmonic term, hci_harmonic *rest)
{
    const size_t at = hci_orders_find(b->order, b->order_count, term.order);
    if (at == b->order_count) return;
    rest[at].sine += factor * term.sine;
    rest[at].cosine += factor * term.cosine;
}

static void fill_right_sides(const hci_task *t, hci_harmonic_system *b, hci_harmonic *rest)
{
    const hci_machine *m = t->machine;
    for (size_t k = 0; k < b->order_count; ++k) {
        const hci_target_order wanted = hci_target_at(t->target, b->order[k]);
        const bool mean = b->order[k] < HCI_ORDER_TOLERANCE;
        rest[k] = (hci_harmonic){b->order[k], wanted.torque_Nm.sine, mean ? 0.0 : wanted.torque_Nm.cosine};
    }
    for (size_t k = 0; k < m->cogging_count; ++k)
        add_at(b, -1.0, m->cogging[k], rest);
    for (size_t k = 0; k < t->offset_count; ++k)
        add_at(b, 1.0, t->offset[k], rest);
    if (t->held) {
        const hci_wave against = {t->held->order, t->held->sequence, -t->held->sine, -t->held->cosine};
        hci_system_add_torque(&(hci_mutual_torque){t->gradient, t->gradient_count, b->order, b->order_count},
                              &against, 1, rest);
    }
    if (b->order_count > 0 && b->order[0] < HCI_ORDER_TOLERANCE) b->h[0] = 1.0;
    hci_spectrum_to_rows(rest, b->order_count, b->h + b->rows);
}

/* ---- all of it ---- */

/* Multiplies each row of h and U by the weight of its order. */
static void apply_weights(const hci_task *t, hci_harmonic_system *b)
{
    size_t i = 0;
    for (size_t k = 0; k < b->order_count; ++k) {
        b->row_weight[i++] = hci_target_at(t->target, b->order[k]).weight;
        if (b->order[k] < HCI_ORDER_TOLERANCE) continue;
        b->row_weight[i] = b->row_weight[i - 1];
        ++i;
    }
    for (i = 0; i < b->rows; ++i) {
        b->h[i] *= b->row_weight[i];
        b->h[b->rows + i] *= b->row_weight[i];
    }
    for (int64_t k = 0; k < b->u.column_start[b->unknowns]; ++k)
        b->u.value[k] *= b->row_weight[b->u.row[k]];
}

static bool reserve_rows(hci_harmonic_system *b, size_t count, size_t gradient_count)
{
    const size_t entries = hci_system_capacity(gradient_count, count);
    b->rows = hci_orders_rows(b->order, b->order_count);
    b->unknowns = 2 * count;
    b->row_weight = hci_memory_new(b->rows, sizeof *b->row_weight);
    b->h = hci_memory_new(2 * b->rows, sizeof *b->h);
    b->u.rows = b->rows;
    b->u.columns = b->unknowns;
    b->u.column_start = hci_memory_new(b->unknowns + 1, sizeof *b->u.column_start);
    b->u.row = hci_memory_new(entries, sizeof *b->u.row);
    b->u.value = hci_memory_new(entries, sizeof *b->u.value);
    return b->row_weight && b->h && b->u.column_start && b->u.row && b->u.value;
}

double hci_task_size_of(const hci_task *task, hci_component c)
{
    return sqrt(1.0 + task->rotor_price * pow(c.order - c.sequence, 8.0));
}

double hci_component_copper(hci_component c, int part)
{
    if (c.sequence != 0 || c.order >= HCI_ORDER_TOLERANCE) return 1.0;
    return part ? 2.0 : 0.0;
}

/* Whether the square of some unknown counts more or less than those of the others. */
static bool has_sizes(const hci_task *task, const hci_component *component, size_t count)
{
    bool found = task->rotor_price > 0.0;
    for (size_t k = 0; k < count; ++k)
        found = found || hci_component_copper(component[k], 1) != 1.0;
    return found;
}

/* An unknown without copper has a column of zeros, so that its size says nothing. */
static bool fill_sizes(const hci_task *task, const hci_component *component, hci_harmonic_system *s)
{
    s->size = hci_memory_new(s->unknowns, sizeof *s->size);
    for (size_t j = 0; s->size && j < s->unknowns; ++j) {
        const double copper = hci_component_copper(component[j / 2], (int)(j % 2));
        s->size[j] = hci_task_size_of(task, component[j / 2]) * (copper > 0.0 ? sqrt(copper) : 1.0);
    }
    return s->size;
}

hci_status hci_harmonic_system_make(const hci_task *task, const hci_component *component, size_t count,
                                    hci_compare compare, hci_harmonic_system *system, hci_note *note)
{
    hci_harmonic *rest = NULL;
    memset(system, 0, sizeof *system);
    const hci_status goes_on = hci_task_goes_on(task, note);
    if (goes_on) return goes_on;
    system->order = hci_memory_new(2 * most_orders(task, count), sizeof *system->order);
    if (system->order) {
        system->order_count = all_orders(task, component, count, system->order);
        if (compare == HCI_COMPARE_SQUARE)
            system->order_count = square_orders(task, system->order, system->order_count, count,
                                                system->order + most_orders(task, count));
        rest = hci_memory_new(system->order_count, sizeof *rest);
    }
    if (!rest || !reserve_rows(system, count, task->gradient_count)) {
        hci_memory_free(rest);
        hci_harmonic_system_release(system);
        return hci_note_memory(note, NULL, "a system of %zu components", count);
    }
    fill_right_sides(task, system, rest);
    hci_system_sparse(
        &(hci_mutual_torque){task->gradient, task->gradient_count, system->order, system->order_count},
        component, count, system->u.column_start, system->u.row, system->u.value);
    apply_weights(task, system);
    hci_memory_free(rest);
    if (!has_sizes(task, component, count) || fill_sizes(task, component, system)) return HCI_OK;
    hci_harmonic_system_release(system);
    return hci_note_memory(note, NULL, "a system of %zu components", count);
}

void hci_harmonic_system_release(hci_harmonic_system *system)
{
    hci_memory_free(system->order);
    hci_memory_free(system->row_weight);
    hci_memory_free(system->h);
    hci_memory_free(system->u.column_start);
    hci_memory_free(system->u.row);
    hci_memory_free(system->u.value);
    hci_memory_free(system->size);
    memset(system, 0, sizeof *system);
}

/* Columns and unknowns in the unit in which a square counts 1, and x back again. */
static void scale_columns(const hci_harmonic_system *s, double *value)
{
    for (size_t j = 0; j < s->unknowns; ++j)
        for (int64_t k = s->u.column_start[j]; k < s->u.column_start[j + 1]; ++k)
            value[k] = s->u.value[k] / s->size[j];
}

static hci_status solve_scaled(const hci_harmonic_system *s, double *x, hci_sparse_rank *found,
                               hci_note *note)
{
    hci_sparse u = s->u;
    hci_status status;
    u.value = hci_memory_new((size_t)u.column_start[s->unknowns], sizeof *u.value);
    if (!u.value) return hci_note_memory(note, NULL, "solving");
    scale_columns(s, u.value);
    status = hci_sparse_qr_solve(&u, s->h, 2, x, found, note);
    for (size_t j = 0; j < 2 * s->unknowns && !status; ++j)
        x[j] /= s->size[j % s->unknowns];
    hci_memory_free(u.value);
    return status;
}

hci_status hci_harmonic_system_solve(const hci_harmonic_system *s, double *x, hci_sparse_rank *found,
                                     hci_note *note)
{
    return s->size ? solve_scaled(s, x, found, note) : hci_sparse_qr_solve(&s->u, s->h, 2, x, found, note);
}
