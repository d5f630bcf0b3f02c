#include "host/diagnose/fit/run_equations.h"

#include <string.h>

#include "host/base/memory.h"
#include "host/diagnose/fit/linearise.h"

/* Precisions of the columns; nothing is expected of the candidates themselves after that. */
static void precision_take(hci_candidates *list, double *precision)
{
    size_t column = 0;
    for (size_t k = 0; k < list->count; ++k) {
        hci_candidate *x = &list->candidate[k];
        const double expected = x->deviation > 0.0 ? 1.0 / (x->deviation * x->deviation) : 0.0;
        for (size_t j = 0; x->in && j < x->count; ++j)
            precision[column++] = expected;
        x->deviation = 0.0;
    }
}

/* From steps to what values are away from those declared: y + X·values in place of y. */
static void count_from_zero(const hci_candidates *list, hci_normal_equations *x)
{
    size_t column = 0;
    for (size_t k = 0; k < list->count; ++k)
        for (size_t j = 0; list->candidate[k].in && j < list->candidate[k].count; ++j, ++column) {
            const double value = hci_candidate_departure(&list->candidate[k], j);
            x->square += value * (2.0 * x->moment[column] + value * x->gram[column * x->n + column]);
            for (size_t i = 0; i < x->n; ++i)
                x->moment[i] += value * x->gram[column * x->n + i];
        }
}

/* ---- groups of samples ---- */

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

/* What is linearised, one group at a time. */
typedef struct {
    hci_binned_samples samples; /* with segments of its own */
    hci_regression regression;
    const hci_candidates *list;
} grouping;

static hci_status group_add(const grouping *g, hci_run_equations *x, hci_note *note)
{
    hci_normal_equations *normal = &x->run[x->groups.count];
    const hci_status status = hci_regression_normal(&g->regression, g->list, false, normal, note);
    if (status) return status;
    count_from_zero(g->list, normal);
    ++x->groups.count;
    return HCI_OK;
}

static hci_status groups_fill(const hci_regression *e, grouping *g, hci_run_equations *x, hci_note *note)
{
    hci_status status = HCI_OK;
    for (size_t r = 0; r < e->samples->run_count; ++r)
        for (size_t part = 0; e->use[r] && part < x->parts && !status; ++part) {
            segments_cut(e->samples, r, part, x->parts, g->samples.segment);
            status = group_add(g, x, note);
        }
    return status;
}

static hci_status groups_make(const hci_regression *e, const hci_candidates *list, hci_run_equations *x,
                              hci_note *note)
{
    grouping g = {*e->samples, *e, list};
    g.samples.segment = hci_memory_new(e->samples->segment_count + 1, sizeof *g.samples.segment);
    if (!g.samples.segment) return hci_note_memory(note, NULL, "leaving runs out");
    g.regression.samples = &g.samples;
    g.regression.known = NULL; /* those are of whole runs */
    const hci_status status = groups_fill(e, &g, x, note);
    hci_memory_free(g.samples.segment);
    return status;
}

hci_status hci_run_equations_make(const hci_regression *e, const hci_candidates *candidates,
                                  hci_run_equations *x, hci_note *note)
{
    const size_t runs = hci_regression_runs_in_use(e);
    hci_candidates list = {0};
    memset(x, 0, sizeof *x);
    x->parts = runs > 0 && runs < HCI_LEAST_GROUPS ? (HCI_LEAST_GROUPS + runs) / runs : 1;
    hci_status status = hci_candidates_copy(candidates, &list, note);
    if (status) return status;
    x->run = hci_memory_new(runs * x->parts + 1, sizeof *x->run);
    x->precision = hci_memory_new(hci_candidates_terms_in(&list) + 1, sizeof *x->precision);
    if (!x->run || !x->precision) status = hci_note_memory(note, NULL, "leaving runs out");
    x->groups.group = x->run;
    if (!status) precision_take(&list, x->precision);
    if (!status) status = groups_make(e, &list, x, note);
    hci_candidates_release(&list);
    if (status) hci_run_equations_release(x);
    return status;
}

void hci_run_equations_release(hci_run_equations *x)
{
    for (size_t r = 0; r < x->groups.count; ++r)
        hci_normal_equations_release(&x->run[r]);
    hci_memory_free(x->run);
    hci_memory_free(x->precision);
    memset(x, 0, sizeof *x);
}
