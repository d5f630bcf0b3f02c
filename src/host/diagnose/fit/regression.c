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
