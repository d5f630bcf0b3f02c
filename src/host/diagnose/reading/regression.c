#include "host/diagnose/reading/regression.h"

#include <math.h>

#include "host/base/memory.h"
#include "host/diagnose/prepare/drift.h"

const hci_segment *hci_regression_next(const hci_regression *e, const hci_segment *after)
{
    if (e->samples->segment_count == 0) return NULL;
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

size_t hci_regression_runs_in_use(const hci_regression *e)
{
    size_t count = 0;
    for (size_t r = 0; r < e->samples->run_count; ++r)
        count += e->use[r];
    return count;
}

bool hci_regression_has_slopes(const hci_regression *e)
{
    bool has = false;
    for (size_t r = 0; r < e->samples->run_count; ++r)
        has = has || (e->use[r] && e->runs[r].torque_source == HCI_TORQUE_INERTIA);
    return has;
}

hci_status hci_regression_each_run(hci_regression *e,
                                   hci_status (*visit)(void *context, size_t run, hci_note *note),
                                   void *context, hci_note *note)
{
    const bool *use = e->use;
    bool *one = hci_memory_new(e->samples->run_count + 1, sizeof *one);
    hci_status status = one ? HCI_OK : hci_note_memory(note, NULL, "one run at a time");
    e->use = one;
    for (size_t r = 0; r < e->samples->run_count && !status; ++r) {
        if (!use[r]) continue;
        one[r] = true;
        status = visit(context, r, note);
        one[r] = false;
    }
    e->use = use;
    hci_memory_free(one);
    return status;
}

/* Of a sum of products, in wide loops; a prediction takes as long as that many of them for each term and
 * derivative, and for all that is common to the terms. */
#define OF_TERM   250.0
#define OF_SAMPLE 4000.0

void hci_regression_count(const hci_regression *e, size_t samples, size_t terms)
{
    hci_regression_count_products(e, (double)samples * (OF_SAMPLE + OF_TERM * (double)terms));
}

/* The same of a stage of a sensor: of each column, and of what it answers with to its own parameters. */
#define OF_COLUMN 60.0
#define OF_STAGE  6000.0

void hci_regression_count_filtered(const hci_regression *e, size_t samples, size_t columns)
{
    const double own = columns > 0 ? OF_STAGE : 0.0;
    hci_regression_count_products(e, (double)samples * (own + OF_COLUMN * (double)(columns + 1)));
}

void hci_regression_count_products(const hci_regression *e, double products)
{
    if (e->work) *e->work += products / (e->work_times > 0.0 ? e->work_times : 1.0);
}

/* Of what a run drifts by: rms of a straight line about its mean. */
#define OF_DRIFT 0.28867513459481287

double hci_regression_mean_unknown_Nm(const hci_regression *e, const hci_segment *s)
{
    const hci_run *run = &e->runs[s->run];
    if (run->mean_is_unknown || (e->free_means && !run->only_mean)) return (double)INFINITY;
    return OF_DRIFT * hci_drift_peak_to_peak_Nm(&e->samples->statistics[s->run].drift);
}
