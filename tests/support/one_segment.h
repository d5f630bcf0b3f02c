/* A search over one recording of one segment, whose residual is noise of deviation 1. Include once in a test.
 */
#ifndef ONE_SEGMENT_H
#define ONE_SEGMENT_H

#include <string.h>

#include "host/diagnose/search/search.h"
#include "support/reference.h"

enum { N = 400 };

static double residual[N];
static hci_binned_sample sample[N];
static hci_segment segment;
static hci_run run;
static bool use = true;
static hci_binned_samples samples;
static hci_regression regression;
static hci_search search;

/* seed: in and out, of ref_normal. */
static inline void one_segment_start(uint64_t *seed)
{
    memset(sample, 0, sizeof sample);
    for (size_t k = 0; k < N; ++k) {
        residual[k] = ref_normal(seed);
        sample[k].count = 1.0;
    }
    segment = (hci_segment){.count = N, .timed = true};
    samples = (hci_binned_samples){
        .sample = sample, .count = N, .segment = &segment, .segment_count = 1, .run_count = 1};
    run = (hci_run){.torque_source = HCI_TORQUE_MEASURED};
    regression = (hci_regression){.samples = &samples, .runs = &run, .use = &use};
    search = (hci_search){.regression = &regression, .residual_Nm = residual};
}

#endif
