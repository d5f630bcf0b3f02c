/* Recordings sample by sample for the tests, from equations that stand there; it takes nothing from the
 * library but the struct. */
#ifndef RECORDING_H
#define RECORDING_H

#include <stdlib.h>
#include <string.h>

#include "hci/host/recording/run.h"
#include "support/reference.h"

/* An empty run with time, angle, speed, currents and torque, and a known turn. */
static inline hci_run rec_make(size_t count)
{
    hci_run r;
    memset(&r, 0, sizeof r);
    r.name = calloc(16, 1);
    r.count = count;
    r.time_s = calloc(count + 1, sizeof *r.time_s);
    r.theta_m_rad = calloc(count + 1, sizeof *r.theta_m_rad);
    r.speed_rad_per_s = calloc(count + 1, sizeof *r.speed_rad_per_s);
    r.i_A = calloc(3 * count + 1, sizeof *r.i_A);
    r.torque_Nm = calloc(count + 1, sizeof *r.torque_Nm);
    r.torque_source = HCI_TORQUE_MEASURED;
    r.turn_known = true;
    return r;
}

static inline void rec_release(hci_run *r)
{
    free(r->name);
    free(r->time_s);
    free(r->theta_m_rad);
    free(r->speed_rad_per_s);
    free(r->i_A);
    free(r->torque_Nm);
    free(r->temperature_C);
    memset(r, 0, sizeof *r);
}

/* i_s = i_q sin(θ − 2πs/3) − i_d cos(θ − 2πs/3) */
static inline void rec_phases(double d, double q, double theta, double *i_abc)
{
    for (int s = 0; s < 3; ++s)
        i_abc[s] = q * sin(theta - 2.0 * REF_PI * s / 3.0) - d * cos(theta - 2.0 * REF_PI * s / 3.0);
}

static inline void rec_rotor(const double *i_abc, double theta, double *d, double *q)
{
    *d = *q = 0.0;
    for (int s = 0; s < 3; ++s) {
        *q += 2.0 / 3.0 * i_abc[s] * sin(theta - 2.0 * REF_PI * s / 3.0);
        *d -= 2.0 / 3.0 * i_abc[s] * cos(theta - 2.0 * REF_PI * s / 3.0);
    }
}

#endif
