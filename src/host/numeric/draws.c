#include "host/numeric/draws.h"

#include <math.h>

#include "hci/math/harmonic.h"

double hci_draws_uniform(hci_draws *draws)
{
    uint64_t x = draws->state += UINT64_C(0x9e3779b97f4a7c15);
    x = (x ^ (x >> 30)) * UINT64_C(0xbf58476d1ce4e5b9);
    x = (x ^ (x >> 27)) * UINT64_C(0x94d049bb133111eb);
    x ^= x >> 31;
    return ((double)(x >> 12) + 0.5) * 0x1p-52;
}

double hci_draws_normal(hci_draws *draws)
{
    const double radius = sqrt(-2.0 * log(hci_draws_uniform(draws)));
    return radius * cos(2.0 * HCI_PI * hci_draws_uniform(draws));
}

double hci_draws_student_scale(hci_draws *draws, unsigned freedom)
{
    double sum = 0.0;
    for (unsigned k = 0; k < freedom; ++k) {
        const double x = hci_draws_normal(draws);
        sum += x * x;
    }
    return sqrt((double)freedom / sum);
}
