/* A machine whose iron saturates by a law that is no polynomial,
 *
 *     W' = A (1 + b cos 6θ) [√(1 + ((i_d + I_m)² + i_q²)/I_s²) − what of it is linear at i = 0]
 *
 * so that every series is an approximation: a current along q takes flux from the magnets. And recordings of
 * it. Include once in a test. */
#ifndef SATURATED_IRON_H
#define SATURATED_IRON_H

#include <math.h>

#include "support/diagnosing.h"

#define SIZE_NM   8.0  /* A */
#define RIPPLE    0.05 /* b */
#define MAGNETS_A 10.0 /* I_m */
#define KNEE_A    20.0 /* I_s */
#define QUIET_NM  1e-3 /* noise */

enum { SAMPLES = 90 };

static double iron_noise_Nm = QUIET_NM;

/* ---- the machine ---- */

static inline double root_of(double d, double q)
{
    return sqrt(1.0 + ((d + MAGNETS_A) * (d + MAGNETS_A) + q * q) / (KNEE_A * KNEE_A));
}

/* p (∂W'/∂θ + i_q ∂W'/∂i_d − i_d ∂W'/∂i_q) */
static inline double torque_of_iron(double theta, double d, double q)
{
    const double root = root_of(d, q), root_0 = root_of(0.0, 0.0), knee = KNEE_A * KNEE_A;
    const double w = root - root_0 - d * MAGNETS_A / (root_0 * knee);
    const double by_d = (d + MAGNETS_A) / (root * knee) - MAGNETS_A / (root_0 * knee),
                 by_q = q / (root * knee);
    const double shape = 1.0 + RIPPLE * cos(6.0 * theta), slope = -6.0 * RIPPLE * sin(6.0 * theta);
    return P * SIZE_NM * (slope * w + shape * (q * by_d - d * by_q));
}

/* One electrical turn, mechanically standing for slow, with a ripple in i_q. */
static inline void measure(double d, double q, double ripple_A, hci_role of)
{
    hci_run *r = add_run(SAMPLES);
    role[runs.count - 1] = of;
    for (size_t k = 0; k < SAMPLES; ++k) {
        const double theta = 2.0 * REF_PI * (double)k / SAMPLES;
        const double i_d = d + ripple_A * sin(6.0 * theta), i_q = q + ripple_A * cos(6.0 * theta);
        r->theta_m_rad[k] = theta / P;
        r->time_s[k] = 1e-3 * (double)k;
        r->speed_rad_per_s[k] = 2.0 * REF_PI / P / SAMPLES / 1e-3;
        rec_phases(i_d, i_q, theta, r->i_A + 3 * k);
        r->torque_Nm[k] =
            1.5 * K_NM_PER_A * i_q + torque_of_iron(theta, i_d, i_q) + iron_noise_Nm * ref_normal(&seed);
    }
}

/* A map as somebody would take it, without the points that are held out: between the others, and beyond them.
 */
static inline void measure_map(void)
{
    static const double FIT[][3] = {{0.0, 0.0, 0.0},  {0.0, 3.0, 0.0},  {0.0, 6.0, 0.0},
                                    {0.0, 9.0, 0.0},  {-3.0, 3.0, 0.0}, {-6.0, 6.0, 1.0},
                                    {-6.0, 9.0, 0.0}, {4.0, -6.0, 0.0}, {4.0, 5.0, 1.0}};
    for (size_t k = 0; k < sizeof FIT / sizeof *FIT; ++k)
        measure(FIT[k][0], FIT[k][1], FIT[k][2], HCI_ROLE_FIT);
    measure(-3.0, 6.0, 0.0, HCI_ROLE_HOLDOUT);
}

#endif
