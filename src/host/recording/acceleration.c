#include "host/recording/acceleration.h"

#include <string.h>

#include "host/numeric/derivative.h"

enum { LEAST_SAMPLES = 3 };

void hci_run_accelerations(const hci_run *run, double *rad_per_s2)
{
    if (run->time_s && run->speed_rad_per_s && run->count >= LEAST_SAMPLES)
        hci_derivative(run->time_s, run->speed_rad_per_s, run->count, rad_per_s2);
    else
        memset(rad_per_s2, 0, run->count * sizeof *rad_per_s2);
}
