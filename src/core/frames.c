#include "hci/frames.h"

#include <math.h>

static const double sqrt_3 = 1.73205080756887729353;

hci_alpha_beta hci_clarke(const double abc[3])
{
    const hci_alpha_beta x = {(2.0 * abc[0] - abc[1] - abc[2]) / 3.0, (abc[1] - abc[2]) / sqrt_3,
                              (abc[0] + abc[1] + abc[2]) / 3.0};
    return x;
}

/* b, c = −α/2 ± (√3/2)β + zero */
void hci_clarke_inverse(hci_alpha_beta x, double abc[3])
{
    const double half_beta = 0.5 * sqrt_3 * x.beta;
    abc[0] = x.zero + x.alpha;
    abc[1] = x.zero - 0.5 * x.alpha + half_beta;
    abc[2] = x.zero - 0.5 * x.alpha - half_beta;
}

hci_dq hci_park(hci_alpha_beta x, double theta_rad)
{
    const double s = sin(theta_rad), c = cos(theta_rad);
    const hci_dq y = {-x.alpha * c - x.beta * s, x.alpha * s - x.beta * c, x.zero};
    return y;
}

/* The matrix of hci_park is its own transposed inverse: α = −d cos θ + q sin θ, β = −d sin θ − q cos θ. */
hci_alpha_beta hci_park_inverse(hci_dq x, double theta_rad)
{
    const double s = sin(theta_rad), c = cos(theta_rad);
    const hci_alpha_beta y = {-x.d * c + x.q * s, -x.d * s - x.q * c, x.zero};
    return y;
}
