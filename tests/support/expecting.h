/* What is expected of the ripple that currents make, beside what a machine that is known makes of them.
 * Include once in a test, after diagnosing.h. */
#ifndef EXPECTING_H
#define EXPECTING_H

#include "host/machine/expected_ripple.h"
#include "support/diagnosing.h"

enum { PATH = 240 };

/* i_d, i_q and a ripple in both of order 6. */
typedef struct {
    double d, q, ripple_A;
} current;

/* Torque of the machine that is known, N·m, at an electrical angle. */
typedef double (*known_torque)(double theta, double d, double q);

static hci_expected_ripple expected;
static double torque_Nm[PATH], real_Nm[PATH];

static inline double peak_to_peak(const double *x)
{
    double low = x[0], high = x[0];
    for (size_t k = 1; k < PATH; ++k) {
        low = fmin(low, x[k]);
        high = fmax(high, x[k]);
    }
    return high - low;
}

/* A sample of the current with the torque of both machines. */
static inline hci_sample sample_at(const current *i, known_torque known, size_t k)
{
    const double theta = 2.0 * REF_PI * (double)k / PATH;
    const double d = i->d + i->ripple_A * sin(6.0 * theta), q = i->q + i->ripple_A * cos(6.0 * theta);
    hci_sample x = {.theta_m_rad = theta / P};
    rec_phases(d, q, theta, x.i_abc);
    real_Nm[k] = known(theta, d, q);
    torque_Nm[k] = hci_torque_at(&machine.model, theta, x.i_abc) +
                   hci_effects_torque(&machine.model, &diagnosis.effects.list, &x, NULL).torque_Nm;
    return x;
}

/* Fills `expected`; returns the error of the corrected machine from peak to peak. */
static inline double expected_error_Nm(const current *i, known_torque known)
{
    static hci_sample sample[PATH];
    hci_note note = {{0}};
    double error_Nm[PATH];
    for (size_t k = 0; k < PATH; ++k) {
        sample[k] = sample_at(i, known, k);
        error_Nm[k] = real_Nm[k] - torque_Nm[k];
    }
    const hci_ripple_path path = {.machine = &machine.model,
                                  .effects = &diagnosis.effects.list,
                                  .sample = sample,
                                  .torque_Nm = torque_Nm,
                                  .count = PATH,
                                  .speed_rad_per_s = NAN};
    TEST_ASSERT_EQUAL_INT(HCI_OK, hci_expected_ripple_find(&path, &diagnosis.uncertainty, &expected, &note));
    return peak_to_peak(error_Nm);
}

#endif
