#include "host/check/data/ripple_shift.h"

#include <math.h>

/* Places of a turn into which the samples are sorted, and those that are tried. */
enum { ORDERS = CHECK_RIPPLE_ORDERS, BINS = 180, PLACES = 1920 };

/* Times the noise of an order, and of the largest order. */
#define STANDS_OUT 6.0
#define OF_LARGEST 0.03

/* Shifts whose correlation is as near to the best are as good. */
#define AS_GOOD 0.1

/* ---- one recording */

/* Means over the turn, and their noise. False: a place has no sample. */
static bool turn_of(const check_run *r, double mean[BINS], double *noise)
{
    double square[BINS] = {0.0}, hits[BINS] = {0.0};
    *noise = 0.0;
    for (int k = 0; k < BINS; ++k)
        mean[k] = 0.0;
    for (size_t k = 0; k < r->count; ++k) {
        const double turn = r->theta[k] / (2.0 * HCI_PI), x = r->torque[k] - r->torque_mean;
        const int bin = (int)((turn - floor(turn)) * BINS) % BINS;
        mean[bin] += x, square[bin] += x * x, hits[bin] += 1.0;
    }
    for (int k = 0; k < BINS; ++k) {
        if (!(hits[k] > 1.0)) return false;
        mean[k] /= hits[k];
        *noise += fmax(0.0, square[k] / hits[k] - mean[k] * mean[k]) / (hits[k] - 1.0);
    }
    *noise = sqrt(*noise / BINS);
    return true;
}

static check_vector order_of(const double mean[BINS], int order)
{
    check_vector sum = {0.0, 0.0};
    for (int k = 0; k < BINS; ++k) {
        const double angle = 2.0 * HCI_PI * order * (k + 0.5) / BINS;
        sum.re += 2.0 / BINS * mean[k] * sin(angle);
        sum.im += 2.0 / BINS * mean[k] * cos(angle);
    }
    return sum;
}

static void ripple_take(check_run *r)
{
    double mean[BINS], noise, most = 0.0;
    check_turn_ripple *x = &r->ripple;
    if (x->is_taken) return;
    *x = (check_turn_ripple){.is_taken = true, .least = HUGE_VAL};
    if (!r->theta || !r->torque || r->is_electrical || !turn_of(r, mean, &noise)) return;
    for (int n = 1; n <= ORDERS; ++n) {
        x->wave[n] = order_of(mean, n);
        most = fmax(most, hci_check_length(x->wave[n]));
    }
    x->least = fmax(STANDS_OUT * noise * 2.0 / sqrt(BINS), OF_LARGEST * most);
}

/* ---- two of them */

typedef struct {
    check_vector product[ORDERS + 1]; /* conj(a) b of each order; 0: none stands out */
    double norm;
} both_ripples;

static both_ripples both_of(const check_turn_ripple *a, const check_turn_ripple *b, int leave)
{
    both_ripples x = {{{0.0, 0.0}}, 0.0};
    double square_a = 0.0, square_b = 0.0;
    for (int n = 1; n <= ORDERS; ++n) {
        const double size_a = hci_check_length(a->wave[n]), size_b = hci_check_length(b->wave[n]);
        if ((leave > 0 && n % leave == 0) || !(size_a > a->least || size_b > b->least)) continue;
        x.product[n] = hci_check_product(hci_check_conjugate(a->wave[n]), b->wave[n]);
        square_a += size_a * size_a, square_b += size_b * size_b;
    }
    x.norm = sqrt(square_a * square_b);
    return x;
}

static double correlation(const both_ripples *x, double shift_rad)
{
    double sum = 0.0;
    for (int n = 1; n <= ORDERS; ++n)
        sum += hci_check_turned(x->product[n], -n * shift_rad).re;
    return x->norm > 0.0 ? sum / x->norm : 0.0;
}

static double place(int k)
{
    return 2.0 * HCI_PI * (k - PLACES / 2) / PLACES;
}

check_ripple_shift hci_check_ripple_shift(check_run *a, check_run *b, int leave)
{
    check_ripple_shift s = {0.0, 0.0, 0.0, false};
    double at[PLACES];
    int good = 0;
    ripple_take(a);
    ripple_take(b);
    const both_ripples x = both_of(&a->ripple, &b->ripple, leave);
    s.at_zero = correlation(&x, 0.0);
    for (int k = 0; k < PLACES; ++k)
        s.at_best = fmax(s.at_best, at[k] = correlation(&x, place(k)));
    for (int k = 0; k < PLACES; ++k) {
        const bool is_crest = at[k] > at[(k + PLACES - 1) % PLACES] && at[k] >= at[(k + 1) % PLACES];
        if (!is_crest || at[k] < s.at_best - AS_GOOD) continue;
        if (good++ == 0 || fabs(place(k)) < fabs(s.shift_rad)) s.shift_rad = place(k);
    }
    s.is_unique = good == 1;
    return s;
}
