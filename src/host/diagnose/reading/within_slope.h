/* How much of a free shaft's torque lies within the windows that its acceleration is a slope over.
 *
 * In: a machine and recordings. Out: how large its torque less the mean that a slope shows of it usually is:
 * the deviation by the median, for which a few steps of the current do not count. What the drive did between
 * samples is not recorded, so a share of it is an error of the reading and no noise: it repeats with the
 * angle. */
#ifndef HCI_SRC_HOST_DIAGNOSE_READING_WITHIN_SLOPE_H
#define HCI_SRC_HOST_DIAGNOSE_READING_WITHIN_SLOPE_H

#include "host/diagnose/reading/regression.h"

/* Over the runs in use; 0 without a free shaft. HCI_ERROR_MEMORY. O(samples·terms). */
hci_status hci_within_slope_find(const hci_regression *regression, const hci_effects *effects,
                                 double *usual_Nm, hci_note *note);

#endif
