/* What a model leaves of currents that are 0: of i_a + i_b + i_c where no neutral is connected, and of each
 * where none flowed. Gains and offsets of current sensors show there, however little torque they make. */
#ifndef HCI_SRC_HOST_DIAGNOSE_FIT_CURRENT_SUMS_H
#define HCI_SRC_HOST_DIAGNOSE_FIT_CURRENT_SUMS_H

#include "host/diagnose/reading/regression.h"

/* How many times the currents sensors read, on the average of the phases; 1 without such an effect. */
double hci_current_sum_scale(const hci_effects *effects);

/* The sum of the readings of one sample, without what sensors add to it, as noisy as that of the readings
 * whatever the sensors have in common. truth: hci_effects_undo_currents of its reading. scale:
 * hci_current_sum_scale. A. */
double hci_current_sum_of(const hci_binned_sample *sample, const hci_sample *truth, double scale);

/* Root mean square over the runs in use whose sums say something, in units of the noise of a sample; 0: none
 * does. O(samples·terms). */
double hci_current_sums_rms(const hci_regression *regression, const hci_effects *effects);

/* What is left of the currents of a run in which none flowed, by sensor. */
typedef struct {
    hci_sample truth;
    size_t phase[3],
        count; /* 0, 1, 2: those with a sensor; count: 0 of other runs, and but for the first segment */
    double deviation_A; /* by which zeros differ from one run to another */
} hci_current_zeros;

hci_current_zeros hci_current_zeros_left(const hci_regression *regression, const hci_effects *effects,
                                         const hci_segment *segment);

/* Root mean square over the runs in use in which no current flowed, in units of deviation_A; 0: none is.
 * O(runs·terms). */
double hci_current_zeros_rms(const hci_regression *regression, const hci_effects *effects);

#endif
