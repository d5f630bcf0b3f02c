/* What a run says of itself before any model. */
#ifndef HCI_SRC_HOST_DIAGNOSE_PREPARE_RUN_STATISTICS_H
#define HCI_SRC_HOST_DIAGNOSE_PREPARE_RUN_STATISTICS_H

#include "host/diagnose/prepare/binned_samples.h"

/* Of a run without an angle all is 0, but for what is not known (NAN). O(samples). */
hci_run_statistics hci_run_statistics_of(const hci_run *run, int pole_pairs);

#endif
