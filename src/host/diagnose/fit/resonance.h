/* A resonance or a lag of the torque sensor, looked for on a grid of frequencies and dampings.
 *
 * In: a residual without one. Out: the grid point where χ² falls most. A Gauss–Newton fit that starts without
 * a resonance cannot find it: its derivative by the frequency is 0 there. */
#ifndef HCI_SRC_HOST_DIAGNOSE_FIT_RESONANCE_H
#define HCI_SRC_HOST_DIAGNOSE_FIT_RESONANCE_H

#include "host/diagnose/reading/regression.h"

typedef struct {
    double natural_frequency_Hz, damping;
    double gain; /* fall of χ² */
} hci_resonance;

/* The point of a grid of frequencies and dampings where χ² falls most; all 0 where no point helps.
 * type: has a resonance; residual_Nm: of the model without one. HCI_ERROR_MEMORY. O(samples) for each of some
 * hundred points. */
hci_status hci_resonance_find(const hci_regression *regression, const hci_effect_type *type,
                              const double *residual_Nm, hci_resonance *resonance, hci_note *note);

/* The same of a lag: the time constant where χ² falls most, and by how much; 0 where none helps.
 * type: has a lag. */
hci_status hci_lag_find(const hci_regression *regression, const hci_effect_type *type,
                        const double *residual_Nm, double *time_constant_s, double *gain, hci_note *note);

#endif
