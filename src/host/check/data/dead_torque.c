#include "host/check/data/dead_torque.h"

#include <math.h>

#define SURE 5.0 /* standard errors of a mean */

/* Largest over smallest rms of the noise of recordings, and the correlation of a row with the next: noise of
 * a channel has neither more with the current nor waves. */
#define AS_LOUD 1.5
#define ALIKE   0.3

enum { LEAST_ROWS = 30 };

static double error_of(const check_run *r)
{
    return sqrt(r->torque_variance / (double)r->count);
}

bool hci_check_torque_stands_out(const check_run *run)
{
    return fabs(run->torque_mean) > SURE * error_of(run);
}

bool hci_check_torque_is_measured(const check_run *run)
{
    return run->has_torque && run->torque && !run->is_held && !run->turns_steadily &&
           run->count >= LEAST_ROWS;
}

/* Of a row with the next, about the mean. */
static double correlation_of(const check_run *r)
{
    double product = 0.0, square = 0.0, mean = 0.0;
    for (size_t k = 0; k < r->count; ++k)
        mean += r->torque[k] / (double)r->count;
    for (size_t k = 1; k < r->count; ++k) {
        product += (r->torque[k] - mean) * (r->torque[k - 1] - mean);
        square += (r->torque[k] - mean) * (r->torque[k] - mean);
    }
    return square > 0.0 ? product / square : 1.0;
}

/* By their errors; NAN: none was measured. */
static double common_mean(const check_data *data)
{
    double sum = 0.0, weight = 0.0;
    for (size_t k = 0; k < data->runs; ++k) {
        const check_run *r = &data->run[k];
        if (!hci_check_torque_is_measured(r) || !(r->torque_variance > 0.0)) continue;
        const double own = 1.0 / (error_of(r) * error_of(r));
        sum += own * r->torque_mean;
        weight += own;
    }
    return sum / weight;
}

bool hci_check_torques_are_noise(const check_data *data, double *noise_Nm)
{
    const double mean = common_mean(data);
    double quietest_Nm = INFINITY;
    *noise_Nm = 0.0;
    if (isnan(mean)) return false;
    for (size_t k = 0; k < data->runs; ++k) {
        const check_run *r = &data->run[k];
        if (!hci_check_torque_is_measured(r)) continue;
        if (!(r->torque_variance > 0.0) || fabs(r->torque_mean - mean) > SURE * error_of(r) ||
            fabs(correlation_of(r)) > ALIKE)
            return false;
        *noise_Nm = fmax(*noise_Nm, sqrt(r->torque_variance));
        quietest_Nm = fmin(quietest_Nm, sqrt(r->torque_variance));
    }
    return *noise_Nm < AS_LOUD * quietest_Nm;
}
