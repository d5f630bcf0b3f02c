#include "host/numeric/statistics.h"

#include <math.h>

double hci_mean(const double *x, size_t n)
{
    double sum = 0.0;
    for (size_t k = 0; k < n; ++k)
        sum += x[k];
    return sum / (double)n;
}

double hci_mean_square_about(const double *x, size_t n, double centre)
{
    double sum = 0.0;
    for (size_t k = 0; k < n; ++k)
        sum += (x[k] - centre) * (x[k] - centre);
    return sum / (double)n;
}

double hci_peak_to_peak(const double *x, size_t n)
{
    double low = x[0], high = x[0];
    for (size_t k = 1; k < n; ++k) {
        low = fmin(low, x[k]);
        high = fmax(high, x[k]);
    }
    return high - low;
}
