#include "host/diagnose/fit/regression.h"

const hci_segment *hci_regression_next(const hci_regression *e, const hci_segment *after)
{
    const hci_segment *end = e->samples->segment + e->samples->segment_count;
    const hci_segment *s = after ? after + 1 : e->samples->segment;
    while (s < end && !e->use[s->run])
        ++s;
    return s < end ? s : NULL;
}

hci_noise *hci_regression_noise(const hci_regression *e, const hci_segment *segment)
{
    return &e->noise[segment - e->samples->segment];
}

/* A prediction takes that many for each term and derivative, and for all that is common to the terms. */
#define OF_TERM   60.0
#define OF_SAMPLE 1000.0

void hci_regression_count(const hci_regression *e, size_t samples, size_t terms, size_t columns)
{
    const double n = (double)columns;
    if (e->work) *e->work += (double)samples * (OF_SAMPLE + OF_TERM * (double)terms + 0.5 * n * n);
}
