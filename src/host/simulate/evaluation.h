/* What is summed up over the steps of the evaluated time: integrals.c adds, figures.c reads. */
#ifndef HCI_SRC_HOST_SIMULATE_EVALUATION_H
#define HCI_SRC_HOST_SIMULATE_EVALUATION_H

#include "host/simulate/simulation.h"

/* What is integrated, before the spectrum's pairs. Torque is taken from its first value, so that a small
 * ripple keeps its digits. */
enum {
    HCI_INTEGRAL_TORQUE,
    HCI_INTEGRAL_TORQUE_2,
    HCI_INTEGRAL_LENGTH,
    HCI_INTEGRAL_LENGTH_2,
    HCI_INTEGRAL_DQX,
    HCI_INTEGRAL_DQX_2,
    HCI_INTEGRAL_SPEED,
    HCI_INTEGRAL_SPEED_2,
    HCI_INTEGRAL_SHAFT,
    HCI_INTEGRAL_COGGING,
    HCI_INTEGRAL_LOAD,
    HCI_INTEGRAL_FRICTION,
    HCI_INTEGRAL_SPECTRUM
};

/* What has an extreme. */
enum {
    HCI_EXTREME_TORQUE,
    HCI_EXTREME_LENGTH,
    HCI_EXTREME_DQX,
    HCI_EXTREME_SPEED,
    HCI_EXTREME_PHASE,
    HCI_EXTREMES
};

typedef struct {
    double time_s, angle_rad, speed_rad_per_s;
    double i[2], v[2];
    double magnetic_J, speed_squared;
    hci_simulation_counts counts;
} hci_instant;

/* Integrals and extremes up to one instant. */
typedef struct {
    hci_instant at;
    double electrical_J;
    double most[HCI_EXTREMES], least[HCI_EXTREMES];
    double *integral;
} hci_integrals;

struct hci_evaluation {
    const hci_setup *setup;
    bool started;
    double reference_Nm; /* the first torque */
    size_t values, orders, periods;
    hci_instant first;
    double *before, *now;         /* integrands */
    hci_integrals running, whole; /* until now; until the last whole period */
    double *workspace;            /* of all of the above */
};

#endif
