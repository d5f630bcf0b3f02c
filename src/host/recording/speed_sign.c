#include "host/recording/speed_sign.h"

#define OTHER 0.01 /* of the rows, whose speed has the other sign */

static int sign_of(double x)
{
    return (x > 0.0) - (x < 0.0);
}

size_t hci_speed_sign_changes(const double *x, size_t count)
{
    size_t changes = 0;
    int before = 0;
    for (size_t k = 0; k < count; ++k) {
        const int sign = sign_of(x[k]);
        if (sign * before < 0) ++changes;
        before = sign ? sign : before;
    }
    return changes;
}

bool hci_speed_sign_is_noise(const hci_run *run, const double *slope)
{
    const double *speed = run->speed_rad_per_s;
    double other = 0.0, along = 0.0;
    for (size_t k = 0; k < run->count; ++k) {
        other += sign_of(speed[k]) * sign_of(slope[k]) < 0 ? 1.0 : 0.0;
        along += speed[k] * sign_of(slope[k]);
    }
    return other >= OTHER * (double)run->count && along > 0.0 &&
           hci_speed_sign_changes(speed, run->count) >=
               HCI_SPEED_SIGN_CHANGES * (hci_speed_sign_changes(slope, run->count) + 1);
}
