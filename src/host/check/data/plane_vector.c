/* Vectors of the plane. */
#include "host/check/data/plane_vector.h"

#include <math.h>

check_vector hci_check_product(check_vector a, check_vector b)
{
    return (check_vector){a.re * b.re - a.im * b.im, a.re * b.im + a.im * b.re};
}

check_vector hci_check_conjugate(check_vector a)
{
    return (check_vector){a.re, -a.im};
}

check_vector hci_check_scaled(check_vector a, double factor)
{
    return (check_vector){factor * a.re, factor * a.im};
}

check_vector hci_check_turned(check_vector a, double angle_rad)
{
    return hci_check_product(a, (check_vector){cos(angle_rad), sin(angle_rad)});
}

check_vector hci_check_sum(check_vector a, check_vector b)
{
    return (check_vector){a.re + b.re, a.im + b.im};
}

double hci_check_length(check_vector a)
{
    return hypot(a.re, a.im);
}
