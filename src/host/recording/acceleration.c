#include "host/recording/acceleration.h"

#include "host/numeric/derivative.h"

void hci_run_acceleration(const hci_run *run, double *rate_rad_per_s2)
{
    const double *t = run->time_s, *speed = run->speed_rad_per_s;
    const size_t window = run->speed_window > 0 && run->theta_m_rad
                              ? hci_derivative_window_of_slope(t, run->theta_m_rad, speed, run->count)
                              : hci_derivative_window(t, speed, run->count);
    hci_derivative_over(t, speed, run->count, window, rate_rad_per_s2);
}
