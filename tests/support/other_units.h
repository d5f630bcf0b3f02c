/* A machine in other units of current, torque and time, which are powers of two and change no digit: what a
 * library says of it is the same in these units. Include once in a test. */
#ifndef OTHER_UNITS_H
#define OTHER_UNITS_H

#include <math.h>
#include <stdio.h>

#include "hci/host/machine/machine.h"
#include "unity.h"

typedef struct {
    double current, torque, speed; /* powers of two; speed: of 1/time */
} units;

static const units PLAIN = {1.0, 1.0, 1.0}, SMALL = {0x1p-6, 0x1p-14, 0x1p-4},
                   LARGE = {0x1p10, 0x1p12, 0x1p4}, COILS = {0x1p-6, 0x1p8, 0x1p-2}; /* hundreds of henries */

static double units_share;   /* of the larger one, within which two numbers are the same */
static char units_place[80]; /* which case it is, for messages */

/* Whether a number is the same in other units, `by` of which are one of the plain ones; sizes below `largest`
 * count as that. */
static inline void units_same(double plain, double other, double by, double largest, const char *what)
{
    char text[160];
    snprintf(text, sizeof text, "%s of %s", what, units_place);
    if (!isfinite(plain)) {
        TEST_ASSERT_TRUE_MESSAGE(isnan(plain) ? isnan(other) : plain == other, text);
        return;
    }
    TEST_ASSERT_DOUBLE_WITHIN_MESSAGE(units_share * fmax(fabs(plain), largest), plain, other / by, text);
}

static inline double units_V(const units *u)
{
    return u->speed * u->torque / u->current;
}

static inline double units_H(const units *u)
{
    return u->torque / u->current / u->current;
}

static inline void units_slopes(hci_inductance_slope *slope, size_t count, double by)
{
    for (size_t k = 0; k < count; ++k)
        for (int j = 0; j < HCI_PHASE_MATRIX; ++j) {
            slope[k].sine[j] *= by;
            slope[k].cosine[j] *= by;
        }
}

static inline void units_tables(hci_machine_data *m, const units *u)
{
    for (size_t k = 0; k < m->model.back_emf_count; ++k) {
        m->back_emf[k].sine *= u->torque / u->current;
        m->back_emf[k].cosine *= u->torque / u->current;
    }
    for (size_t k = 0; k < m->model.cogging_count; ++k) {
        m->cogging[k].sine *= u->torque;
        m->cogging[k].cosine *= u->torque;
    }
    units_slopes(m->slope, m->model.slope_count, units_H(u));
    units_slopes(m->inductance, m->inductance_count, units_H(u));
}

/* In place: tables and numbers. */
static inline void units_machine(hci_machine_data *m, const units *u)
{
    units_tables(m, u);
    m->emf_frequency_Hz *= u->speed;
    m->resistance_ohm *= units_V(u) / u->current;
    m->inductance_d_H *= units_H(u);
    m->inductance_q_H *= units_H(u);
    m->inertia_kgm2 *= u->torque / u->speed / u->speed;
    m->viscous_friction_Nms_per_rad *= u->torque / u->speed;
    m->coulomb_friction_Nm *= u->torque;
    m->dc_link_voltage_V *= units_V(u);
    m->max_current_A *= u->current;
    m->rated_current_A *= u->current;
    m->rated_torque_Nm *= u->torque;
    m->rated_speed_rad_per_s *= u->speed;
}

#endif
