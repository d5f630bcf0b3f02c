#include "host/recording/computed_torque.h"

#include <math.h>

#include "host/numeric/statistics.h"
#include "host/recording/rotor_frame.h"

#define DIGITS 1e-6 /* of the largest torque: numbers in files have seven digits or more */
#define VARIES 1e-2 /* of the largest current */

enum { LEAST = 16 };

static double largest_of(const double *x, size_t n)
{
    double most = 0.0;
    for (size_t k = 0; k < n; ++k)
        most = fmax(most, fabs(x[k]));
    return most;
}

#define STILL 1e-3 /* of the currents: less is rounding */

bool hci_torque_is_typed(const hci_run *run)
{
    double mean = 0.0, square = 0.0;
    const double share = 1.0 / (double)run->count;
    if (run->count < LEAST || run->theta_m_rad == NULL || !(fabs(run->torque_Nm[0]) > 0.0)) return false;
    for (size_t k = 1; k < run->count; ++k)
        if (run->torque_Nm[k] < run->torque_Nm[0] || run->torque_Nm[k] > run->torque_Nm[0]) return false;
    for (size_t k = 0; k < run->count; ++k) {
        const double iq_A = hci_run_dq(run, run->pole_pairs, k).q;
        mean += share * iq_A;
        square += share * iq_A * iq_A;
    }
    return square - mean * mean > STILL * STILL * square;
}

bool hci_torque_is_of_current(const double *torque_Nm, const double *iq_A, size_t n, double *constant)
{
    if (n < LEAST) return false;
    const double most_Nm = largest_of(torque_Nm, n), most_A = largest_of(iq_A, n);
    double square = 0.0, product = 0.0;
    for (size_t k = 0; k < n; ++k) {
        square += iq_A[k] * iq_A[k];
        product += iq_A[k] * torque_Nm[k];
    }
    if (!(square > 0.0) || !(most_Nm > 0.0)) return false;
    *constant = product / square;
    const double step_A = hci_quantum(iq_A, n, DIGITS * most_A);
    const double rounding_Nm = 2.0 * (hci_quantum(torque_Nm, n, DIGITS * most_Nm) + fabs(*constant) * step_A);
    const double range_Nm = fabs(*constant) * hci_peak_to_peak(iq_A, n);
    if (range_Nm < VARIES * most_Nm || range_Nm < 4.0 * rounding_Nm) return false;
    for (size_t k = 0; k < n; ++k)
        if (fabs(torque_Nm[k] - *constant * iq_A[k]) > rounding_Nm) return false;
    return true;
}
