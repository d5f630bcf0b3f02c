#include "host/recording/slow_turn.h"

#include <math.h>

#include "host/numeric/statistics.h"
#include "host/recording/rotor_frame.h"

#define NEGLIGIBLE 0.2 /* inertia × acceleration beside the torque of the current */

enum { LEAST = 16 };

/* rms about the mean of torque_constant·i_q. */
static double rms_of_current(const hci_run *run, int pole_pairs, double constant)
{
    double sum = 0.0, square = 0.0;
    for (size_t k = 0; k < run->count; ++k) {
        const double made = constant * hci_run_dq(run, pole_pairs, k).q;
        sum += made;
        square += made * made;
    }
    const double share = 1.0 / (double)run->count;
    return sqrt(fmax(0.0, share * square - share * sum * share * sum));
}

bool hci_is_slow_turn(const hci_run *run, int pole_pairs, double inertia_kgm2,
                      double torque_constant_Nm_per_A)
{
    if (!(torque_constant_Nm_per_A > 0.0) || run->count < LEAST || run->theta_m_rad == NULL) return false;
    const double rms_Nm = rms_of_current(run, pole_pairs, torque_constant_Nm_per_A);
    const double mean_Nm = hci_mean(run->torque_Nm, run->count);
    const double accelerating_Nm = sqrt(hci_mean_square_about(run->torque_Nm, run->count, mean_Nm));
    const double energy_J = 0.5 * inertia_kgm2 * hci_mean_square_about(run->speed_rad_per_s, run->count, 0.0);
    return accelerating_Nm < NEGLIGIBLE * rms_Nm && energy_J < rms_Nm / pole_pairs;
}
