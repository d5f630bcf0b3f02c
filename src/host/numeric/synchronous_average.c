#include "host/numeric/synchronous_average.h"

#include <math.h>
#include <string.h>

#include "hci/math/harmonic.h"
#include "host/base/memory.h"

#define TURN (2.0 * HCI_PI)

/* The way back that makes a new direction, against the flicker of an encoder. */
#define REVERSAL_RAD (TURN / 50.0)

/* M·gap is kept below this: at π the orders could no longer be told apart. */
#define GAP_LIMIT (0.8 * HCI_PI)

/* Samples so near to each other are taken together: order M changes by 2π/64 in a cell, and its mean by 4e-4.
 */
enum { CELLS_PER_ORDER = 64, MOST_STEPS = 400 };

#define CONVERGED        1e-13
#define CONVERGED_ENOUGH 1e-8

/* ---- passes ---- */

typedef struct {
    hci_average_pass *pass;
    size_t count, capacity;
} pass_list;

static hci_status push(pass_list *list, size_t first, size_t end, int direction)
{
    if (list->count == list->capacity) {
        const size_t capacity = 2 * list->capacity + 16;
        hci_average_pass *larger = hci_memory_resize(list->pass, capacity, sizeof *larger);
        if (larger == NULL) return HCI_ERROR_MEMORY;
        list->pass = larger;
        list->capacity = capacity;
    }
    list->pass[list->count++] = (hci_average_pass){first, end - first, direction};
    return HCI_OK;
}

/* Cuts samples first … end − 1, which go one way, after every `turns` turns. */
static hci_status push_turns(pass_list *list, const double *angle, size_t first, size_t end, int direction,
                             size_t turns)
{
    const double length = TURN * (double)turns;
    hci_status status = HCI_OK;
    size_t start = first;
    for (size_t k = first; k < end && !status; ++k) {
        if (direction * (angle[k] - angle[start]) < length) continue;
        status = push(list, start, k, direction);
        start = k;
    }
    return !status && start < end ? push(list, start, end, direction) : status;
}

/* Cuts the path where its direction changes, from one extreme to the next, and those parts into passes. */
static hci_status find_passes(const hci_average_samples *x, size_t turns, pass_list *list)
{
    const double *angle = x->angle_rad;
    hci_status status = HCI_OK;
    size_t start = 0, extreme = 0;
    int direction = 0;
    list->count = 0;
    for (size_t k = 1; k < x->count && !status; ++k) {
        const double way = angle[k] - angle[extreme];
        if (direction * way > 0.0) {
            extreme = k;
        } else if (fabs(way) > REVERSAL_RAD) {
            if (direction != 0) status = push_turns(list, angle, start, extreme, direction, turns);
            start = direction != 0 ? extreme : start;
            direction = way > 0.0 ? 1 : -1;
            extreme = k;
        }
    }
    if (!status && direction != 0) status = push_turns(list, angle, start, x->count, direction, turns);
    return status;
}

/* ---- cells: samples of a pass by their angle within the turn ---- */

typedef struct {
    size_t size, used;              /* cells; those that are not empty come first after `gather` */
    double *angle, *weight, *value; /* value: [size][channels] */
    double *count;
} cell_table;

static hci_status cells_new(cell_table *c, size_t size, size_t channels)
{
    c->size = size;
    c->angle = hci_memory_new(size, sizeof(double));
    c->weight = hci_memory_new(size, sizeof(double));
    c->count = hci_memory_new(size, sizeof(double));
    c->value = hci_memory_new(size * channels, sizeof(double));
    return c->angle != NULL && c->weight != NULL && c->count != NULL && c->value != NULL ? HCI_OK
                                                                                         : HCI_ERROR_MEMORY;
}

static void cells_release(cell_table *c)
{
    hci_memory_free(c->angle);
    hci_memory_free(c->weight);
    hci_memory_free(c->count);
    hci_memory_free(c->value);
}

/* Means of the samples in each cell; cells without any are passed over. */
static void gather(const hci_average_samples *x, const hci_average_pass *pass, cell_table *c)
{
    const size_t channels = x->channels;
    memset(c->angle, 0, c->size * sizeof(double));
    memset(c->count, 0, c->size * sizeof(double));
    memset(c->value, 0, c->size * channels * sizeof(double));
    for (size_t k = pass->first; k < pass->first + pass->count; ++k) {
        const double within = x->angle_rad[k] - TURN * floor(x->angle_rad[k] / TURN);
        const size_t at = (size_t)(within / TURN * (double)c->size), cell = at < c->size ? at : c->size - 1;
        c->angle[cell] += within;
        c->count[cell] += 1.0;
        for (size_t s = 0; s < channels; ++s)
            c->value[cell * channels + s] += x->value[k * channels + s];
    }
    c->used = 0;
    for (size_t cell = 0; cell < c->size; ++cell) {
        if (!(c->count[cell] > 0.0)) continue;
        c->angle[c->used] = c->angle[cell] / c->count[cell];
        for (size_t s = 0; s < channels; ++s)
            c->value[c->used * channels + s] = c->value[cell * channels + s] / c->count[cell];
        c->used++;
    }
}

/* Each cell weighs as much as the way to its neighbours. Returns the largest gap. */
static double weigh(cell_table *c)
{
    const size_t n = c->used;
    double largest = n < 3 ? TURN : 0.0;
    for (size_t k = 0; k < n; ++k) {
        const double before = k > 0 ? c->angle[k - 1] : c->angle[n - 1] - TURN;
        const double after = k + 1 < n ? c->angle[k + 1] : c->angle[0] + TURN;
        c->weight[k] = 0.5 * (after - before) / TURN;
        largest = fmax(largest, after - c->angle[k]);
    }
    return largest;
}

/* ---- the polynomial of one pass ---- */

typedef struct {
    double re, im;
} complex_number;

/* Σ_j m_{k−j} c_j over j = −M … M, with c_{−j} = conj c_j and m likewise; k = 0 … M. */
static void multiply(size_t highest, const complex_number *moment, const complex_number *c,
                     complex_number *out)
{
    for (size_t k = 0; k <= highest; ++k) {
        complex_number sum = {moment[k].re * c[0].re, moment[k].im * c[0].re};
        for (size_t j = 1; j <= highest; ++j) {
            const complex_number p = moment[k + j];
            const complex_number q =
                j <= k ? moment[k - j] : (complex_number){moment[j - k].re, -moment[j - k].im};
            sum.re += q.re * c[j].re - q.im * c[j].im + p.re * c[j].re + p.im * c[j].im;
            sum.im += q.re * c[j].im + q.im * c[j].re + p.im * c[j].re - p.re * c[j].im;
        }
        out[k] = sum;
    }
}

static double inner(size_t highest, const complex_number *a, const complex_number *b)
{
    double sum = a[0].re * b[0].re;
    for (size_t k = 1; k <= highest; ++k)
        sum += 2.0 * (a[k].re * b[k].re + a[k].im * b[k].im);
    return sum;
}

/* a ← a·scale + b·by */
static void combine(size_t highest, complex_number *a, double scale, const complex_number *b, double by)
{
    for (size_t k = 0; k <= highest; ++k) {
        a[k].re = scale * a[k].re + by * b[k].re;
        a[k].im = scale * a[k].im + by * b[k].im;
    }
}

/* Conjugate gradients; c: in the right-hand side, out the solution. work: 3(M + 1). */
static bool solve(size_t highest, const complex_number *moment, complex_number *c, complex_number *work)
{
    complex_number *r = work, *p = work + highest + 1, *q = work + 2 * (highest + 1);
    memcpy(r, c, (highest + 1) * sizeof *r);
    memcpy(p, c, (highest + 1) * sizeof *p);
    memset(c, 0, (highest + 1) * sizeof *c);
    const double start = inner(highest, r, r);
    double now = start;
    for (int step = 0; step < MOST_STEPS && now > start * CONVERGED * CONVERGED; ++step) {
        multiply(highest, moment, p, q);
        const double curvature = inner(highest, p, q);
        if (!(curvature > 0.0)) break;
        combine(highest, c, 1.0, p, now / curvature);
        combine(highest, r, 1.0, q, -now / curvature);
        const double next = inner(highest, r, r);
        combine(highest, p, next / now, r, 1.0);
        now = next;
    }
    return now <= start * CONVERGED_ENOUGH * CONVERGED_ENOUGH;
}

/* Σ w x e^{−ikφ} for k = 0 … count − 1; x NULL: 1. */
static void fourier_sums(const cell_table *c, const double *x, size_t stride, size_t count,
                         complex_number *out)
{
    memset(out, 0, count * sizeof *out);
    for (size_t cell = 0; cell < c->used; ++cell) {
        const double cosine = cos(c->angle[cell]), sine = sin(c->angle[cell]);
        double re = c->weight[cell] * (x != NULL ? x[cell * stride] : 1.0), im = 0.0;
        for (size_t k = 0; k < count; ++k) {
            out[k].re += re;
            out[k].im += im;
            const double turned = re * cosine + im * sine;
            im = im * cosine - re * sine;
            re = turned;
        }
    }
}

/* Fits one pass; false when its angles cannot tell the orders apart. */
static bool fit_pass(const cell_table *c, const hci_average *average, size_t pass, complex_number *work)
{
    const size_t highest = average->highest;
    complex_number *moment = work, *z = work + 2 * highest + 1, *rest = z + highest + 1;
    fourier_sums(c, NULL, 0, 2 * highest + 1, moment);
    for (size_t s = 0; s < average->channels; ++s) {
        fourier_sums(c, c->value + s, average->channels, highest + 1, z);
        if (!solve(highest, moment, z, rest)) return false;
        hci_average_harmonic *wave = hci_average_at(average, pass, s, 0);
        wave[0] = (hci_average_harmonic){0.0, z[0].re};
        for (size_t k = 1; k <= highest; ++k)
            wave[k] = (hci_average_harmonic){-2.0 * z[k].im, 2.0 * z[k].re};
    }
    return true;
}

/* ---- all passes ---- */

static void sort_down(double *x, size_t n)
{
    for (size_t gap = n / 2; gap > 0; gap /= 2)
        for (size_t k = gap; k < n; ++k)
            for (size_t j = k; j >= gap && x[j - gap] < x[j]; j -= gap) {
                const double swap = x[j];
                x[j] = x[j - gap];
                x[j - gap] = swap;
            }
}

/* Highest order that half of the passes bear. gaps: work, one a pass. */
static size_t highest_of(const hci_average_samples *x, const pass_list *list, cell_table *c, double *gaps)
{
    for (size_t k = 0; k < list->count; ++k) {
        gaps[k] = TURN;
        if (list->pass[k].count < 3) continue;
        gather(x, &list->pass[k], c);
        gaps[k] = weigh(c);
    }
    sort_down(gaps, list->count);
    /* The last pass before a change of direction may be a part of a turn only. */
    size_t whole = 0;
    while (whole < list->count && gaps[whole] >= HCI_PI)
        whole++;
    if (whole == list->count) return 0;
    return (size_t)(GAP_LIMIT / gaps[whole + (list->count - whole) / 2]);
}

/* The fewest turns a pass that bear enough orders, or those that bear most. */
static hci_status choose_passes(const hci_average_samples *x, const hci_average_orders *o, cell_table *c,
                                pass_list *list, hci_average *average)
{
    size_t best = 0;
    average->highest = 0;
    for (size_t each = 1;; each *= 2) {
        hci_status status = find_passes(x, each, list);
        double *gaps = status ? NULL : hci_memory_new(list->count, sizeof *gaps);
        if (gaps == NULL) return HCI_ERROR_MEMORY;
        const size_t highest = highest_of(x, list, c, gaps), passes = list->count;
        hci_memory_free(gaps);
        if (highest > average->highest) {
            average->highest = highest < o->wanted ? highest : o->wanted;
            best = each;
        }
        if (average->highest >= o->enough || passes <= 2 || each > x->count) break;
    }
    average->turns_each = best;
    return best > 0 ? find_passes(x, best, list) : HCI_OK;
}

/* All samples as one pass: samples in no order, or movements to and fro that cover the turn only together. */
static hci_status take_all(const hci_average_samples *x, size_t wanted, cell_table *c, pass_list *list,
                           hci_average *average)
{
    double gap;
    list->count = 0;
    const hci_status status = push(list, 0, x->count, 0);
    if (status) return status;
    const size_t bears = highest_of(x, list, c, &gap);
    average->highest = bears < wanted ? bears : wanted;
    average->turns_each = 1;
    return HCI_OK;
}

static hci_status fit_all(const hci_average_samples *x, const pass_list *list, cell_table *c,
                          hci_average *average)
{
    const size_t waves = average->channels * (average->highest + 1);
    average->pass = hci_memory_new(list->count, sizeof *average->pass);
    average->wave = hci_memory_new(list->count * waves, sizeof *average->wave);
    complex_number *work = hci_memory_new(6 * (average->highest + 1), sizeof *work);
    if (average->pass == NULL || average->wave == NULL || work == NULL) {
        hci_memory_free(work);
        return HCI_ERROR_MEMORY;
    }
    for (size_t k = 0; k < list->count; ++k) {
        if (list->pass[k].count < 3) continue;
        gather(x, &list->pass[k], c);
        if (weigh(c) * (double)average->highest > HCI_PI || !fit_pass(c, average, average->count, work))
            continue;
        average->pass[average->count++] = list->pass[k];
    }
    hci_memory_free(work);
    return average->count > 0 ? HCI_OK : HCI_ERROR_SINGULAR;
}

static hci_status fit(const hci_average_samples *x, const hci_average_orders *o, pass_list *list,
                      cell_table *c, hci_average *average)
{
    hci_status status = cells_new(c, CELLS_PER_ORDER * (o->wanted + 1), x->channels);
    if (!status) status = choose_passes(x, o, c, list, average);
    if (!status && average->highest < o->least) status = take_all(x, o->wanted, c, list, average);
    if (!status && average->highest < o->least) status = HCI_ERROR_SINGULAR;
    return status ? status : fit_all(x, list, c, average);
}

hci_status hci_average_fit(const hci_average_samples *samples, const hci_average_orders *orders,
                           hci_average *average)
{
    pass_list list = {NULL, 0, 0};
    cell_table cells = {.size = 0};
    memset(average, 0, sizeof *average);
    average->channels = samples->channels;
    const hci_status status = fit(samples, orders, &list, &cells, average);
    cells_release(&cells);
    hci_memory_free(list.pass);
    if (status) hci_average_release(average);
    return status;
}

void hci_average_release(hci_average *average)
{
    hci_memory_free(average->pass);
    hci_memory_free(average->wave);
    memset(average, 0, sizeof *average);
}

hci_status hci_average_of_direction(const hci_average *average, int direction, hci_average *part)
{
    const size_t waves = average->channels * (average->highest + 1);
    *part = (hci_average){average->highest, average->channels, 0, average->turns_each, NULL, NULL};
    part->pass = hci_memory_new(average->count + 1, sizeof *part->pass);
    part->wave = hci_memory_new((average->count + 1) * waves, sizeof *part->wave);
    if (part->pass == NULL || part->wave == NULL) {
        hci_average_release(part);
        return HCI_ERROR_MEMORY;
    }
    for (size_t k = 0; k < average->count; ++k) {
        if (average->pass[k].direction != direction) continue;
        memcpy(part->wave + part->count * waves, average->wave + k * waves, waves * sizeof *part->wave);
        part->pass[part->count++] = average->pass[k];
    }
    return HCI_OK;
}

hci_average_harmonic *hci_average_at(const hci_average *average, size_t pass, size_t channel, size_t order)
{
    return &average->wave[(pass * average->channels + channel) * (average->highest + 1) + order];
}
