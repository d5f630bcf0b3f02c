#include "hci/machine/frames.h"

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

/* ---- the orthonormal plane ---- */

/* Orthonormal αβ: α = sqrt(2/3)(a − b/2 − c/2), β = (b − c)/√2. */
static const double ALPHA_A = 0.81649658092772603273;  /* sqrt(2/3) */
static const double ALPHA_B = -0.40824829046386301637; /* −sqrt(1/6), also of c */
static const double BETA_B = 0.70710678118654752440;   /* sqrt(1/2), −sqrt(1/2) of c */

void hci_plane_to_abc(const double x[2], double abc[3])
{
    abc[0] = ALPHA_A * x[0];
    abc[1] = ALPHA_B * x[0] + BETA_B * x[1];
    abc[2] = ALPHA_B * x[0] - BETA_B * x[1];
}

void hci_plane_from_abc(const double abc[3], double x[2])
{
    x[0] = ALPHA_A * abc[0] + ALPHA_B * (abc[1] + abc[2]);
    x[1] = BETA_B * (abc[1] - abc[2]);
}

/* ---- the extended frame ---- */

static const double sqrt_3_2 = 1.22474487139158904910;

/* The orthonormal αβ vector is sqrt(3/2) times the amplitude-invariant one. */
hci_dqx_frame hci_dqx_frame_of(const double e_abc[3])
{
    const hci_alpha_beta e = hci_clarke(e_abc);
    const double size = hypot(e.alpha, e.beta), a_x = 1.0 / size;
    const hci_dqx_frame none = {0.0, 0.0, 0.0};
    if (!(a_x > 0.0 && a_x < HUGE_VAL)) return none;
    const hci_dqx_frame frame = {a_x, e.alpha / size, e.beta / size};
    return frame;
}

hci_dqx hci_dqx_from_abc(hci_dqx_frame frame, const double abc[3])
{
    const hci_dqx none = {0.0, 0.0};
    if (frame.a_x == 0.0) return none;
    const hci_alpha_beta x = hci_clarke(abc);
    const double scale = sqrt_3_2 / frame.a_x;
    const hci_dqx y = {scale * (frame.q_beta * x.alpha - frame.q_alpha * x.beta),
                       scale * (frame.q_alpha * x.alpha + frame.q_beta * x.beta)};
    return y;
}

void hci_dqx_to_abc(hci_dqx_frame frame, hci_dqx x, double abc[3])
{
    const double scale = frame.a_x / sqrt_3_2;
    const hci_alpha_beta y = {scale * (frame.q_beta * x.d + frame.q_alpha * x.q),
                              scale * (frame.q_beta * x.q - frame.q_alpha * x.d), 0.0};
    hci_clarke_inverse(y, abc);
}

/* L' of a phase matrix between two phase vectors of the orthonormal plane. */
static double between(const double slope[6], const double u[3], const double v[3])
{
    return slope[0] * u[0] * v[0] + slope[1] * u[1] * v[1] + slope[2] * u[2] * v[2] +
           slope[3] * (u[0] * v[1] + u[1] * v[0]) + slope[4] * (u[1] * v[2] + u[2] * v[1]) +
           slope[5] * (u[2] * v[0] + u[0] * v[2]);
}

hci_dqx_slope hci_dqx_slope_of(hci_dqx_frame frame, const double slope_abc[6])
{
    const hci_dqx along_d = {1.0, 0.0}, along_q = {0.0, 1.0};
    double d[3], q[3];
    hci_dqx_to_abc(frame, along_d, d);
    hci_dqx_to_abc(frame, along_q, q);
    const hci_dqx_slope slope = {between(slope_abc, d, d), between(slope_abc, d, q),
                                 between(slope_abc, q, q)};
    return slope;
}
