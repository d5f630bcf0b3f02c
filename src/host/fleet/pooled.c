/* Random effects by restricted maximum likelihood (H. D. Patterson and R. Thompson, Recovery of inter-block
 * information when block sizes are unequal, Biometrika 58, 1971): docs/theory.md, section 17. */
#include "host/fleet/pooled.h"

#include <math.h>

enum { STEPS = 100 };

#define GOLDEN 0.6180339887498949

/* Σw, Σwv and the rest of one τ². */
typedef struct {
    double weight, mean, square, logarithm;
} sums;

static sums sums_of(const double *value, const double *std_error, size_t n, double between)
{
    sums s = {0.0, 0.0, 0.0, 0.0};
    for (size_t k = 0; k < n; ++k) {
        const double variance = between * between + std_error[k] * std_error[k];
        s.weight += 1.0 / variance;
        s.mean += value[k] / variance;
        s.logarithm += log(variance);
    }
    s.mean /= s.weight;
    for (size_t k = 0; k < n; ++k) {
        const double off = value[k] - s.mean;
        s.square += off * off / (between * between + std_error[k] * std_error[k]);
    }
    return s;
}

double hci_pooled_likelihood(const double *value, const double *std_error, size_t n, double between)
{
    const sums s = sums_of(value, std_error, n, between);
    return -0.5 * (s.logarithm + log(s.weight) + s.square);
}

static double largest_off(const double *value, size_t n)
{
    double low = value[0], high = value[0];
    for (size_t k = 1; k < n; ++k) {
        low = fmin(low, value[k]);
        high = fmax(high, value[k]);
    }
    return high - low;
}

hci_pooled hci_pooled_find(const double *value, const double *std_error, size_t n)
{
    double low = 0.0, high = largest_off(value, n);
    double a = high - GOLDEN * (high - low), b = low + GOLDEN * (high - low);
    double at_a = hci_pooled_likelihood(value, std_error, n, a),
           at_b = hci_pooled_likelihood(value, std_error, n, b);
    for (int k = 0; k < STEPS && high - low > 1e-12 * high; ++k) {
        if (at_a > at_b) {
            high = b, b = a, at_b = at_a;
            a = high - GOLDEN * (high - low);
            at_a = hci_pooled_likelihood(value, std_error, n, a);
        } else {
            low = a, a = b, at_a = at_b;
            b = low + GOLDEN * (high - low);
            at_b = hci_pooled_likelihood(value, std_error, n, b);
        }
    }
    double between = 0.5 * (low + high);
    if (hci_pooled_likelihood(value, std_error, n, 0.0) >=
        hci_pooled_likelihood(value, std_error, n, between))
        between = 0.0; /* no number, where a standard error is 0 */
    const sums s = sums_of(value, std_error, n, between);
    return (hci_pooled){s.mean, 1.0 / sqrt(s.weight), between};
}

double hci_pooled_shrunken(const hci_pooled *p, double value, double own_std_error, double *std_error)
{
    const double between = p->between * p->between, own = own_std_error * own_std_error;
    const double share = between > 0.0 ? between / (between + own) : 0.0;
    *std_error = sqrt(share * own + (1.0 - share) * (1.0 - share) * p->mean_std_error * p->mean_std_error);
    return share * (value - p->mean);
}

double hci_normal_limit(double probability)
{
    double low = 0.0, high = 9.0;
    for (int k = 0; k < STEPS; ++k) {
        const double middle = 0.5 * (low + high);
        if (erfc(middle / sqrt(2.0)) > probability)
            low = middle;
        else
            high = middle;
    }
    return 0.5 * (low + high);
}
