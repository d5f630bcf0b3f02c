#include "host/diagnose/fit/run_parts.h"

#include <math.h>

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

#define ALIKE      0.1 /* of the largest current, by which those of two runs of one kind differ at most */
#define ABOUT_FAST 1.5 /* times another speed, that shows of friction what that does */

/* Whether two runs turn the same way and about as fast. */
static bool is_as_fast(double a, double b)
{
    const double slow = fmin(fabs(a), fabs(b)), fast = fmax(fabs(a), fabs(b));
    return a * b >= 0.0 && fast <= ABOUT_FAST * slow;
}

static bool is_repeated(const hci_run_statistics *a, const hci_run_statistics *b, double most_A)
{
    return is_as_fast(a->mean_speed_rad_per_s, b->mean_speed_rad_per_s) &&
           hypot(a->mean_id_A - b->mean_id_A, a->mean_iq_A - b->mean_iq_A) <= ALIKE * most_A &&
           fabs(a->current_A - b->current_A) <= ALIKE * most_A;
}

bool hci_run_is_alone(const hci_regression *e, size_t run)
{
    const hci_run_statistics *x = e->samples->statistics;
    double most_A = 0.0;
    for (size_t r = 0; r < e->samples->run_count; ++r) {
        if (e->use[r] && e->runs[r].torque_source != HCI_TORQUE_MEASURED) return false;
        if (e->use[r]) most_A = fmax(most_A, x[r].current_A);
    }
    for (size_t r = 0; r < e->samples->run_count; ++r)
        if (e->use[r] && r != run && is_repeated(&x[r], &x[run], most_A)) return false;
    return true;
}

size_t hci_run_parts(const hci_regression *e, size_t few)
{
    const size_t runs = hci_regression_runs_in_use(e);
    if (runs >= HCI_LEAST_GROUPS && one_is_alone(e)) return HCI_LEAST_GROUPS;
    if (runs == 0 || runs > few) return 1;
    return runs < HCI_LEAST_GROUPS ? (HCI_LEAST_GROUPS + runs) / runs : 2;
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

hci_status hci_run_parts_each(const hci_regression *e, size_t parts, bool only_alone,
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
    for (size_t r = 0; r < e->samples->run_count; ++r) {
        const size_t cut = e->use[r] && only_alone && !hci_run_is_alone(e, r) ? 1 : parts;
        for (size_t part = 0; e->use[r] && part < cut && !status; ++part) {
            segments_cut(e->samples, r, part, cut, samples.segment);
            status = visit(context, &regression, r, note);
        }
    }
    hci_memory_free(samples.segment);
    return status;
}
