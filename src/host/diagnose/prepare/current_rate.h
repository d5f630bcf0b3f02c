/* How fast the currents of a segment change in the rotor frame: the slope of a line through the neighbouring
 * samples within 1/80 of an electrical period on each side. */
#ifndef HCI_SRC_HOST_DIAGNOSE_PREPARE_CURRENT_RATE_H
#define HCI_SRC_HOST_DIAGNOSE_PREPARE_CURRENT_RATE_H

#include "host/diagnose/prepare/segment.h"

/* Sets reading.change_A_per_s of n samples that follow each other in time; left at 0 where there are too few.
 * O(n). */
void hci_current_rates_set(hci_binned_sample *sample, size_t n, int pole_pairs);

#endif
