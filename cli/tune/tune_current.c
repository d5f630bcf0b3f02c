#include "cli/tune/tune_current.h"

#include <math.h>

#include "hci/math/harmonic.h"

/* Of the phase currents, beside those that another recording has or the machine is rated for. */
#define NO_CURRENT 0.01

/* Times what noise alone makes of a mean. */
#define NOISE_OF_MEAN 5.0

double cli_tune_rms_A(const hci_run *r)
{
    double sum = 0.0;
    for (size_t k = 0; k < 3 * r->count; ++k)
        sum += r->i_A[k] * r->i_A[k];
    return sqrt(sum / (3.0 * (double)r->count));
}

/* Of phase currents in the plane that turns with the angle: what a drive makes stands still there, and noise
 * and the offsets of sensors go to 0. */
static double mean_vector(const hci_run *r)
{
    double along = 0.0, across = 0.0;
    for (size_t k = 0; k < r->count && r->theta_m_rad; ++k)
        for (int s = 0; s < 3; ++s) {
            const double x = r->pole_pairs * r->theta_m_rad[k] - 2.0 * HCI_PI * s / 3.0;
            along += r->i_A[3 * k + (size_t)s] * cos(x);
            across += r->i_A[3 * k + (size_t)s] * sin(x);
        }
    return 2.0 / 3.0 * hypot(along, across) / (double)r->count;
}

bool cli_tune_has_no_current(const cli_tuning *t, const hci_run *r)
{
    const double rms_A = cli_tune_rms_A(r);
    double most_A = t->declared.rated_current_A > 0.0 ? t->declared.rated_current_A : 0.0;
    for (size_t k = 0; k < t->runs.count; ++k)
        most_A = fmax(most_A, cli_tune_rms_A(&t->runs.run[k]));
    if (rms_A <= NO_CURRENT * most_A) return true;
    return r->theta_m_rad && mean_vector(r) < NOISE_OF_MEAN * rms_A / sqrt((double)r->count);
}
