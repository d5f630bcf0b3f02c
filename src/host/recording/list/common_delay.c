#include "host/recording/list/common_delay.h"

#include <math.h>

#include "hci/math/harmonic.h"

#define STEP_RAD   0.3  /* by which a step turns the highest wave at the highest speed */
#define APART_RAD  3.0  /* the same, of two delays that are not next to each other */
#define STANDS_OUT 25.0 /* square over its variance, of a wave in the mean of the recordings */
#define ALIKE      0.05 /* of the largest load, by which loads are the same */

enum { MOST_STEPS = 20000, REFINEMENTS = 12 }; /* each way */

typedef struct {
    const hci_delay_record *record;
    size_t count;
    bool has_loads;                         /* that differ */
    double mean_load, load_2;               /* of all, and squares about it */
    size_t order[HCI_DELAY_ORDERS], orders; /* that stand out */
    double fastest_rad_per_s;
} comparison;

static double square_of(const hci_delay_record *r, size_t n)
{
    const hci_delay_wave *w = &r->wave[n];
    return (w->sine * w->sine + w->cosine * w->cosine) / (r->std_error * r->std_error);
}

static void find_orders(comparison *c)
{
    for (size_t n = 1; n <= HCI_DELAY_ORDERS; ++n) {
        double sum = 0.0;
        for (size_t r = 0; r < c->count; ++r)
            sum += square_of(&c->record[r], n);
        if (sum > 2.0 * STANDS_OUT * (double)c->count) c->order[c->orders++] = n;
    }
}

static void find_loads(comparison *c)
{
    double most = 0.0;
    for (size_t r = 0; r < c->count; ++r) {
        c->mean_load += c->record[r].load / (double)c->count;
        most = fmax(most, fabs(c->record[r].load));
    }
    for (size_t r = 0; r < c->count; ++r) {
        const double apart = c->record[r].load - c->mean_load;
        c->load_2 += apart * apart;
        c->has_loads = c->has_loads || fabs(apart) > ALIKE * most;
    }
}

static bool has_speeds(comparison *c)
{
    double least = INFINITY, most = -INFINITY;
    for (size_t r = 0; r < c->count; ++r) {
        least = fmin(least, c->record[r].speed_rad_per_s);
        most = fmax(most, c->record[r].speed_rad_per_s);
    }
    c->fastest_rad_per_s = fmax(fabs(least), fabs(most));
    return most - least > 0.3 * c->fastest_rad_per_s;
}

/* χ² of an order that is turned back: what is left of it beside a constant and a part in proportion to the
 * load, both by least squares. All recordings have the weight of their mean variance. */
static double order_left(const comparison *c, size_t n, double delay_s)
{
    double re[2] = {0.0, 0.0}, im[2] = {0.0, 0.0}, all = 0.0, variance = 0.0;
    const double count = (double)c->count;
    for (size_t r = 0; r < c->count; ++r) {
        const hci_delay_record *x = &c->record[r];
        const double turn = (double)n * x->speed_rad_per_s * delay_s, co = cos(turn), si = sin(turn);
        const hci_delay_wave *w = &x->wave[n];
        const double a = co * w->cosine + si * w->sine, b = co * w->sine - si * w->cosine;
        const double load = x->load - c->mean_load;
        re[0] += a, im[0] += b, re[1] += load * a, im[1] += load * b;
        all += a * a + b * b;
        variance += x->std_error * x->std_error / count;
    }
    all -= (re[0] * re[0] + im[0] * im[0]) / count;
    if (c->has_loads) all -= (re[1] * re[1] + im[1] * im[1]) / c->load_2;
    return fmax(all, 0.0) / variance;
}

static double left_of(const comparison *c, double delay_s)
{
    double sum = 0.0;
    for (size_t k = 0; k < c->orders; ++k)
        sum += order_left(c, c->order[k], delay_s);
    return sum;
}

static void take_better(const comparison *c, double delay_s, hci_common_delay *best)
{
    const double left = left_of(c, delay_s);
    if (!(left < best->left)) return;
    best->left = left;
    best->delay_s = delay_s;
}

/* The best delay of some steps each way, but for those near one (NAN: of all), and as near to it as halved
 * steps come. */
static hci_common_delay search(const comparison *c, double step_s, long steps, double near_s)
{
    hci_common_delay best = {.left = INFINITY};
    for (long k = -steps; k <= steps; ++k)
        if (!(fabs((double)k * step_s - near_s) <= APART_RAD / STEP_RAD * step_s))
            take_better(c, (double)k * step_s, &best);
    for (int j = 0; j < REFINEMENTS; ++j) {
        const double middle_s = best.delay_s;
        step_s *= 0.5;
        take_better(c, middle_s - step_s, &best);
        take_better(c, middle_s + step_s, &best);
    }
    return best;
}

static double turned_rad(const comparison *c, double delay_s)
{
    double sum = 0.0, weight = 0.0;
    for (size_t k = 0; k < c->orders; ++k)
        for (size_t r = 0; r < c->count; ++r) {
            const double square = square_of(&c->record[r], c->order[k]);
            sum += square * pow((double)c->order[k] * c->fastest_rad_per_s * delay_s, 2.0);
            weight += square;
        }
    return sqrt(sum / weight);
}

bool hci_common_delay_find(const hci_delay_record *record, size_t count, double most_s,
                           hci_common_delay *delay)
{
    comparison c = {.record = record, .count = count};
    *delay = (hci_common_delay){.left = INFINITY};
    find_loads(&c);
    find_orders(&c);
    const size_t unknowns = c.has_loads ? 2 : 1;
    if (!has_speeds(&c) || count <= unknowns || c.orders == 0) return false;
    const double step_s = STEP_RAD / ((double)c.order[c.orders - 1] * c.fastest_rad_per_s);
    const long steps = (long)fmin(most_s / step_s, MOST_STEPS);
    *delay = search(&c, step_s, steps, (double)NAN);
    delay->other = search(&c, step_s, steps, delay->delay_s).left;
    delay->before = left_of(&c, 0.0);
    delay->freedom = 2.0 * (double)(c.orders * (count - unknowns));
    delay->turned_rad = turned_rad(&c, delay->delay_s);
    return true;
}
