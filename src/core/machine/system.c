#include "hci/machine/system.h"

#include <math.h>
#include <stdbool.h>

#include "core/math/sort.h"

/* What one back-EMF wave makes of one component, at one torque order:
 *     S_torque = sine_from_sine·S + sine_from_cosine·C,     C_torque likewise. */
typedef struct {
    double order;
    double sine_from_sine, sine_from_cosine;
    double cosine_from_sine, cosine_from_cosine;
} torque_block;

/* +(3/2)IE cos((n−μ)θ + γ − φ); with P = E cos φ, Q = E sin φ: I E cos(γ−φ) = P S + Q C and I E sin(γ−φ) = P
 * C − Q S, so S_m = Q S − P C and C_m = P S + Q C; m < 0 negates S_m. */
static torque_block difference_block(hci_wave e, double order)
{
    const double m = order - e.order, fold = m < 0.0 ? -1.5 : 1.5;
    const torque_block b = {fabs(m), fold * e.cosine, -fold * e.sine, 1.5 * e.sine, 1.5 * e.cosine};
    return b;
}

/* −(3/2)IE cos((n+μ)θ + γ + φ): I E cos(γ+φ) = P S − Q C and I E sin(γ+φ) = Q S + P C. */
static torque_block sum_block(hci_wave e, double order)
{
    const torque_block b = {order + e.order, 1.5 * e.cosine, 1.5 * e.sine, -1.5 * e.sine, 1.5 * e.cosine};
    return b;
}

/* Up to two blocks for a pair; returns how many. Σ_s keeps the difference when the sequences agree and the
 * sum when they are opposite. */
static size_t pair_blocks(hci_wave e, hci_component c, torque_block blocks[2])
{
    size_t n = 0;
    if (e.sequence == c.sequence) blocks[n++] = difference_block(e, c.order);
    if (e.sequence == -c.sequence) blocks[n++] = sum_block(e, c.order);
    return n;
}

static bool order_comes_after(const void *items, size_t a, size_t b)
{
    const double *orders = items;
    return orders[a] > orders[b];
}

static void swap_orders(void *items, size_t a, size_t b)
{
    double *orders = items;
    const double kept = orders[a];
    orders[a] = orders[b];
    orders[b] = kept;
}

size_t hci_orders_sort(double *orders, size_t count)
{
    static const hci_sorting ASCENDING = {order_comes_after, swap_orders};
    size_t kept = 0;
    hci_sort(orders, count, &ASCENDING);
    for (size_t k = 0; k < count; ++k)
        if (kept == 0 || orders[k] - orders[kept - 1] > HCI_ORDER_TOLERANCE) orders[kept++] = orders[k];
    return kept;
}

size_t hci_orders_find(const double *orders, size_t count, double order)
{
    size_t low = 0, high = count;
    while (low < high) {
        const size_t middle = low + (high - low) / 2;
        if (orders[middle] < order - HCI_ORDER_TOLERANCE)
            low = middle + 1;
        else
            high = middle;
    }
    return low < count && orders[low] - order <= HCI_ORDER_TOLERANCE ? low : count;
}

static bool starts_with_mean(const double *orders, size_t count)
{
    return count > 0 && orders[0] < HCI_ORDER_TOLERANCE;
}

size_t hci_orders_rows(const double *orders, size_t count)
{
    return 2 * count - (starts_with_mean(orders, count) ? 1 : 0);
}

size_t hci_orders_row(const double *orders, size_t count, size_t k)
{
    return k == 0 ? 0 : 2 * k - (starts_with_mean(orders, count) ? 1 : 0);
}

size_t hci_component_orders(const hci_wave *back_emf, size_t emf_count, hci_component component,
                            double *orders)
{
    size_t n = 0;
    for (size_t k = 0; k < emf_count; ++k) {
        torque_block blocks[2];
        const size_t found = pair_blocks(back_emf[k], component, blocks);
        for (size_t j = 0; j < found; ++j)
            orders[n++] = blocks[j].order;
    }
    return n;
}

size_t hci_system_capacity(size_t emf_count, size_t component_count)
{
    return 8 * emf_count * component_count;
}

/* Where one block goes: its position among the compared orders and its first row. */
typedef struct {
    const torque_block *block;
    size_t order_index, row;
    bool mean; /* order 0: the only row is C_0 */
} placed_block;

typedef void block_user(void *context, placed_block at);

/* Calls `use` for every block that a component makes at a compared order. */
static void place_blocks(const hci_mutual_torque *torque, hci_component component, block_user *use,
                         void *context)
{
    for (size_t k = 0; k < torque->back_emf_count; ++k) {
        torque_block blocks[2];
        const size_t found = pair_blocks(torque->back_emf[k], component, blocks);
        for (size_t j = 0; j < found; ++j) {
            const size_t at = hci_orders_find(torque->order, torque->order_count, blocks[j].order);
            if (at == torque->order_count) continue;
            use(context,
                (placed_block){&blocks[j], at, hci_orders_row(torque->order, torque->order_count, at),
                               blocks[j].order < HCI_ORDER_TOLERANCE});
        }
    }
}

/* One column of U under construction: entries in ascending row order, equal rows summed by insertion. */
typedef struct {
    int64_t *row;
    double *value;
    size_t count;
    bool of_cosine; /* the column of C rather than that of S */
} column;

static void column_add(column *c, size_t row, double value)
{
    size_t k = c->count;
    while (k > 0 && c->row[k - 1] >= (int64_t)row)
        --k;
    if (k < c->count && c->row[k] == (int64_t)row) {
        c->value[k] += value;
        return;
    }
    for (size_t j = c->count++; j > k; --j) {
        c->row[j] = c->row[j - 1];
        c->value[j] = c->value[j - 1];
    }
    c->row[k] = (int64_t)row;
    c->value[k] = value;
}

static void add_to_column(void *context, placed_block at)
{
    column *c = context;
    const torque_block *b = at.block;
    if (!at.mean) column_add(c, at.row, c->of_cosine ? b->sine_from_cosine : b->sine_from_sine);
    column_add(c, at.row + !at.mean, c->of_cosine ? b->cosine_from_cosine : b->cosine_from_sine);
}

void hci_system_sparse(const hci_mutual_torque *torque, const hci_component *components,
                       size_t component_count, int64_t *column_start, int64_t *row, double *value)
{
    size_t nonzeros = 0;
    column_start[0] = 0;
    for (size_t j = 0; j < 2 * component_count; ++j) {
        column c = {row + nonzeros, value + nonzeros, 0, j % 2 == 1};
        place_blocks(torque, components[j / 2], add_to_column, &c);
        nonzeros += c.count;
        column_start[j + 1] = (int64_t)nonzeros;
    }
}

/* The two dense columns of one component. */
typedef struct {
    double *of_sine, *of_cosine;
} column_pair;

static void add_to_pair(void *context, placed_block at)
{
    column_pair *c = context;
    const torque_block *b = at.block;
    if (!at.mean) {
        c->of_sine[at.row] += b->sine_from_sine;
        c->of_cosine[at.row] += b->sine_from_cosine;
    }
    c->of_sine[at.row + !at.mean] += b->cosine_from_sine;
    c->of_cosine[at.row + !at.mean] += b->cosine_from_cosine;
}

void hci_system_dense(const hci_mutual_torque *torque, const hci_component *components,
                      size_t component_count, double *u)
{
    const size_t rows = hci_orders_rows(torque->order, torque->order_count);
    for (size_t k = 0; k < rows * 2 * component_count; ++k)
        u[k] = 0.0;
    for (size_t c = 0; c < component_count; ++c) {
        column_pair pair = {u + 2 * c * rows, u + (2 * c + 1) * rows};
        place_blocks(torque, components[c], add_to_pair, &pair);
    }
}

/* A current wave and the spectrum that its torque is added to. */
typedef struct {
    hci_wave current;
    hci_harmonic *spectrum;
} torque_sum;

static void add_to_spectrum(void *context, placed_block at)
{
    torque_sum *t = context;
    const torque_block *b = at.block;
    const double s = t->current.sine, c = t->current.cosine;
    if (!at.mean) t->spectrum[at.order_index].sine += b->sine_from_sine * s + b->sine_from_cosine * c;
    t->spectrum[at.order_index].cosine += b->cosine_from_sine * s + b->cosine_from_cosine * c;
}

void hci_system_add_torque(const hci_mutual_torque *torque, const hci_wave *currents, size_t current_count,
                           hci_harmonic *spectrum)
{
    for (size_t k = 0; k < current_count; ++k) {
        const hci_component component = {currents[k].order, currents[k].sequence};
        torque_sum sum = {currents[k], spectrum};
        place_blocks(torque, component, add_to_spectrum, &sum);
    }
}

void hci_spectrum_to_rows(const hci_harmonic *spectrum, size_t count, double *rows)
{
    for (size_t k = 0; k < count; ++k) {
        if (spectrum[k].order >= HCI_ORDER_TOLERANCE) *rows++ = spectrum[k].sine;
        *rows++ = spectrum[k].cosine;
    }
}

void hci_spectrum_from_rows(const double *orders, size_t count, const double *rows, hci_harmonic *spectrum)
{
    for (size_t k = 0; k < count; ++k) {
        spectrum[k].order = orders[k];
        spectrum[k].sine = orders[k] >= HCI_ORDER_TOLERANCE ? *rows++ : 0.0;
        spectrum[k].cosine = *rows++;
    }
}
