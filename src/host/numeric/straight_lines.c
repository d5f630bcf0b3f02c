#include "host/numeric/straight_lines.h"

#include <math.h>
#include <string.h>

#include "host/base/memory.h"

const double hci_line_nodes_most_left = 0.25;

enum {
    OFFSETS = 10,     /* of nodes of one step that are tried */
    LOOKS = 10,       /* by which they are brought to their places, each nearer */
    MANY_ROWS = 2000, /* of more, LOOKS_AT_MANY do: they are in their places but for little */
    LOOKS_AT_MANY = 3,
    LEAST_ROWS = 200,
    MOST_LAG = 64
};

enum { STRETCH = 64 /* rows in which nodes are looked for; they are followed from there to both ends */ };

#define LEAST_STEP    1.4 /* rows: nearer nodes explain smooth values as well */
#define MOST_STEP     25.0
#define RATE_STEP     0.002 /* nodes per row: over half a stretch a fifteenth of a node */
#define SHARP         0.4   /* of what nodes half a step beside leave */
#define MOST_AT_FIRST 0.5   /* that is left, while nodes are not yet where they belong */

/* Rows whose values are looked at, and memory for the normal equations, which are tridiagonal. */
typedef struct {
    const double *row, *value;
    size_t n;
    double *diagonal, *beside, *at_node; /* [nodes] */
    double noise;                        /* of the values, from row to row */
} rows;

/* rms of the fourth differences, as a share of which white noise is 1. Smooth values have hardly any: lines
 * are near them between any nodes. */
static double bend_of(const double *value, size_t n)
{
    double sum = 0.0;
    for (size_t k = 2; k + 2 < n; ++k) {
        const double bend =
            value[k + 2] - 4.0 * value[k + 1] + 6.0 * value[k] - 4.0 * value[k - 1] + value[k - 2];
        sum += bend * bend;
    }
    return n > 4 ? sqrt(sum / (70.0 * (double)(n - 4))) : 0.0;
}

/* By how much values differ from those some rows before, so many that it is least, as a share of which white
 * noise is 1. Values that repeat hardly do: between few rows of a period lines go through all of them. */
static double change_of(const double *value, size_t n)
{
    double least = INFINITY;
    for (size_t lag = 2; lag <= MOST_LAG && 4 * lag <= n; ++lag) {
        double sum = 0.0;
        for (size_t k = lag; k < n; ++k)
            sum += (value[k] - value[k - lag]) * (value[k] - value[k - lag]);
        least = fmin(least, sqrt(sum / (2.0 * (double)(n - lag))));
    }
    return least;
}

/* The node before a row, and how far towards the next it is. */
static size_t before(const hci_line_nodes *nodes, double row, double *share)
{
    const double at = (row - nodes->first) / nodes->step;
    double whole = floor(at);
    if (whole < 0.0) whole = 0.0;
    if (whole > (double)nodes->count - 2.0) whole = (double)nodes->count - 2.0;
    *share = at - whole;
    return (size_t)whole;
}

static void equations_fill(rows *x, const hci_line_nodes *nodes)
{
    memset(x->diagonal, 0, nodes->count * sizeof *x->diagonal);
    memset(x->beside, 0, nodes->count * sizeof *x->beside);
    memset(x->at_node, 0, nodes->count * sizeof *x->at_node);
    for (size_t k = 0; k < x->n; ++k) {
        double share;
        const size_t node = before(nodes, x->row[k], &share);
        x->diagonal[node] += (1.0 - share) * (1.0 - share);
        x->diagonal[node + 1] += share * share;
        x->beside[node] += share * (1.0 - share);
        x->at_node[node] += (1.0 - share) * x->value[k];
        x->at_node[node + 1] += share * x->value[k];
    }
}

#define HOLDS 1e-9 /* of the weight of one row: a node without rows is 0 */

static void equations_solve(rows *x, size_t count)
{
    for (size_t k = 0; k < count; ++k) {
        x->diagonal[k] += HOLDS;
        if (k == 0) continue;
        const double factor = x->beside[k - 1] / x->diagonal[k - 1];
        x->diagonal[k] -= factor * x->beside[k - 1];
        x->at_node[k] -= factor * x->at_node[k - 1];
    }
    for (size_t k = count; k-- > 0;) {
        if (k + 1 < count) x->at_node[k] -= x->beside[k] * x->at_node[k + 1];
        x->at_node[k] /= x->diagonal[k];
    }
}

/* What the best lines between these nodes leave, per degree of freedom, as a share of the noise. */
static double left_by(rows *x, const hci_line_nodes *nodes)
{
    double sum = 0.0;
    if (x->n <= nodes->count || !(x->noise > 0.0)) return INFINITY;
    equations_fill(x, nodes);
    equations_solve(x, nodes->count);
    for (size_t k = 0; k < x->n; ++k) {
        double share;
        const size_t node = before(nodes, x->row[k], &share);
        const double off = x->value[k] - (1.0 - share) * x->at_node[node] - share * x->at_node[node + 1];
        sum += off * off;
    }
    return sqrt(sum / (double)(x->n - nodes->count)) / x->noise;
}

/* Nodes of a step, one of which is at a row, from before the first of the rows to behind the last. */
static hci_line_nodes nodes_through(const rows *x, double step, double at)
{
    hci_line_nodes nodes = {.step = step};
    nodes.first = at - step * ceil((at - x->row[0]) / step);
    nodes.count = 1 + (size_t)ceil((x->row[x->n - 1] - nodes.first) / step);
    if (nodes.count < 2) nodes.count = 2;
    return nodes;
}

/* ---- to their places ---- */

/* Moves step and offset by less and less, as long as less is left. */
static double improve(rows *x, hci_line_nodes *nodes)
{
    const double length = x->row[x->n - 1] - x->row[0], middle = 0.5 * (x->row[x->n - 1] + x->row[0]);
    double at = nodes->first + nodes->step * round((middle - nodes->first) / nodes->step);
    double by_step = 0.12 * nodes->step * nodes->step / length, by = 0.12 * nodes->step;
    *nodes = nodes_through(x, nodes->step, at);
    double left = left_by(x, nodes);
    for (int look = x->n > MANY_ROWS ? LOOKS - LOOKS_AT_MANY : 0; look < LOOKS; ++look) {
        const double from = at, step = nodes->step;
        bool moved = false;
        for (int k = 0; k < 9; ++k) {
            const double to = from + by * (k / 3 - 1);
            const hci_line_nodes other = nodes_through(x, step + by_step * (k % 3 - 1), to);
            const double leaves = left_by(x, &other);
            if (leaves < left) left = leaves, *nodes = other, at = to, moved = true;
        }
        if (!moved) by /= 2.0, by_step /= 2.0;
    }
    return left;
}

/* ---- looking for them in one stretch ---- */

/* left: out, the least that nodes of this step leave. */
static hci_line_nodes best_offset(rows *x, double step, double *left)
{
    hci_line_nodes best = {0};
    *left = INFINITY;
    for (int k = 0; k < OFFSETS; ++k) {
        const hci_line_nodes nodes = nodes_through(x, step, x->row[0] + step * k / OFFSETS);
        const double leaves = left_by(x, &nodes);
        if (leaves < *left) *left = leaves, best = nodes;
    }
    return best;
}

/* Nodes of any step, in their places: of those that do the nearest, as a rule. Returns what they leave. */
static double look_in_stretch(rows *x, hci_line_nodes *found)
{
    double least = INFINITY, left;
    for (double rate = 1.0 / MOST_STEP; rate <= 1.0 / LEAST_STEP; rate += RATE_STEP) {
        const hci_line_nodes nodes = best_offset(x, 1.0 / rate, &left);
        if (left < least) least = left, *found = nodes;
    }
    return least <= MOST_AT_FIRST ? improve(x, found) : (double)INFINITY;
}

/* ---- following them ---- */

/* Some rows of all, with the memory that x has. */
static void stretch_of(const rows *all, size_t from, size_t to, rows *x)
{
    x->row = all->row + from;
    x->value = all->value + from;
    x->n = to - from;
    x->noise = fmin(bend_of(x->value, x->n), change_of(x->value, x->n));
}

/* Whether lines between other nodes leave more: near smooth values they leave as little. */
static bool are_sharp(rows *x, const hci_line_nodes *nodes, double left)
{
    const hci_line_nodes other = nodes_through(x, nodes->step, nodes->first + 0.5 * nodes->step);
    return left <= hci_line_nodes_most_left && left <= SHARP * left_by(x, &other);
}

static bool follow(const rows *all, rows *x, hci_line_nodes *nodes)
{
    const size_t n = all->n;
    size_t from = n / 2 - STRETCH / 2, to = from + STRETCH;
    stretch_of(all, from, to, x);
    if (!(look_in_stretch(x, nodes) <= MOST_AT_FIRST)) return false;
    for (;;) {
        const double left = improve(x, nodes);
        if (!(left <= MOST_AT_FIRST)) return false;
        if (from == 0 && to == n) return are_sharp(x, nodes, left);
        const size_t half = (to - from) / 2;
        from = from > half ? from - half : 0;
        to = n - to > half ? to + half : n;
        stretch_of(all, from, to, x);
    }
}

/* ---- those between which others are ---- */

/* Where each n-th of the nodes would do, these, of the largest n; by rows in the middle of all. */
static void widen(const rows *all, rows *x, hci_line_nodes *nodes)
{
    const size_t n = all->n, from = n > MANY_ROWS ? n / 2 - MANY_ROWS / 2 : 0;
    stretch_of(all, from, n - from, x);
    for (int each = (int)(MOST_STEP / nodes->step); each > 1; --each)
        for (int k = 0; k < each; ++k) {
            const double step = each * nodes->step, at = nodes->first + k * nodes->step;
            const hci_line_nodes wide = nodes_through(x, step, at);
            if (!(left_by(x, &wide) <= hci_line_nodes_most_left)) continue;
            *nodes = nodes_through(all, step, at);
            return;
        }
}

/* ---- memory ---- */

/* Two nodes more than rows: one before the first and one behind the last. */
static bool rows_new(size_t nodes, rows *x)
{
    x->diagonal = hci_memory_new(3 * nodes, sizeof *x->diagonal);
    if (x->diagonal == NULL) return false;
    x->beside = x->diagonal + nodes;
    x->at_node = x->beside + nodes;
    return true;
}

/* The most nodes that are tried: rows may be left out between the first and the last. */
static size_t most_nodes(const double *row, size_t n)
{
    return (size_t)((row[n - 1] - row[0]) / 1.0) + 4;
}

bool hci_line_nodes_find(const double *row, const double *value, size_t n, hci_line_nodes *nodes)
{
    const rows all = {.row = row, .value = value, .n = n};
    rows x = {0};
    if (n < LEAST_ROWS || !rows_new(most_nodes(row, n), &x)) return false;
    const bool found = follow(&all, &x, nodes);
    if (found) widen(&all, &x, nodes);
    hci_memory_free(x.diagonal);
    return found;
}

double hci_line_nodes_fit(const double *row, const double *value, size_t n, const hci_line_nodes *nodes,
                          double *at_node)
{
    const rows all = {.row = row, .value = value, .n = n};
    rows x = {0};
    if (!rows_new(nodes->count, &x)) return INFINITY;
    stretch_of(&all, 0, n, &x);
    const double left = left_by(&x, nodes);
    memcpy(at_node, x.at_node, nodes->count * sizeof *at_node);
    hci_memory_free(x.diagonal);
    return left;
}
