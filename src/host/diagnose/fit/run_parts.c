#include "host/diagnose/fit/run_parts.h"

#include "host/base/memory.h"

static bool are_alike(const hci_run *a, const hci_run *b)
{
    return a->torque_source == b->torque_source && a->hardly_accelerates == b->hardly_accelerates;
}

/* Whether one of the recordings without a torque sensor is the only one of its kind, so that the others
 * cannot say what is in it: a holding test beside free shafts, a coast beside constant speeds. */
static bool one_is_alone(const hci_regression *e)
{
    bool alone = false;
    for (size_t r = 0; r < e->samples->run_count; ++r) {
        size_t alike = 0;
        if (!e->use[r]) continue;
        if (e->runs[r].torque_source == HCI_TORQUE_MEASURED) return false;
        for (size_t k = 0; k < e->samples->run_count; ++k)
            alike += e->use[k] && are_alike(&e->runs[r], &e->runs[k]) ? 1 : 0;
        alone = alone || alike == 1;
    }
    return alone;
}

size_t hci_run_parts(const hci_regression *e, size_t few)
{
    const size_t runs = hci_regression_runs_in_use(e);
    if (runs >= HCI_LEAST_GROUPS && one_is_alone(e)) return HCI_LEAST_GROUPS;
    return runs > 0 && runs <= few ? (HCI_LEAST_GROUPS + runs) / runs : 1;
}

/* Where the samples of one run are: each of its segments cut to one of so many parts, all others empty. */
static void segments_cut(const hci_binned_samples *samples, size_t run, size_t part, size_t parts,
                         hci_segment *segment)
{
    for (size_t k = 0; k < samples->segment_count; ++k) {
        const hci_segment *s = &samples->segment[k];
        const size_t from = s->count * part / parts, until = s->count * (part + 1) / parts;
        segment[k] = *s;
        segment[k].first += from;
        segment[k].count = s->run == run ? until - from : 0;
        if (parts > 1) segment[k].turns = 0;
    }
}

hci_status hci_run_parts_each(const hci_regression *e, size_t parts,
                              hci_status (*visit)(void *context, const hci_regression *part, size_t run,
                                                  hci_note *note),
                              void *context, hci_note *note)
{
    hci_binned_samples samples = *e->samples;
    hci_regression regression = *e;
    samples.segment = hci_memory_new(e->samples->segment_count + 1, sizeof *samples.segment);
    hci_status status = samples.segment ? HCI_OK : hci_note_memory(note, NULL, "one run at a time");
    regression.samples = &samples;
    regression.known = NULL; /* those are of whole runs */
    regression.columns = NULL;
    for (size_t r = 0; r < e->samples->run_count; ++r)
        for (size_t part = 0; e->use[r] && part < parts && !status; ++part) {
            segments_cut(e->samples, r, part, parts, samples.segment);
            status = visit(context, &regression, r, note);
        }
    hci_memory_free(samples.segment);
    return status;
}
