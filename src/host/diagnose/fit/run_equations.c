#include "host/diagnose/fit/run_equations.h"

#include <string.h>

#include "host/base/memory.h"
#include "host/diagnose/fit/linearise.h"
#include "host/diagnose/fit/load_range.h"

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

/* What is linearised, one group at a time. */
typedef struct {
    const hci_candidates *list;
    hci_run_equations *x;
} grouping;

static hci_status group_add(void *context, const hci_regression *part, size_t run, hci_note *note)
{
    const grouping *g = context;
    hci_normal_equations *normal = &g->x->run[g->x->groups.count];
    const hci_status status = hci_regression_normal(part, g->list, false, normal, note);
    if (status) return status;
    count_from_zero(g->list, normal);
    g->x->beyond[g->x->groups.count++] = hci_run_is_beyond(part, run);
    return HCI_OK;
}

hci_status hci_run_equations_make(const hci_regression *e, const hci_candidates *candidates, size_t few,
                                  hci_run_equations *x, hci_note *note)
{
    const size_t runs = hci_regression_runs_in_use(e), parts = hci_run_parts(e, few);
    hci_candidates list = {0};
    memset(x, 0, sizeof *x);
    hci_status status = hci_candidates_copy(candidates, &list, note);
    if (status) return status;
    x->run = hci_memory_new(runs * parts + 1, sizeof *x->run);
    x->beyond = hci_memory_new(runs * parts + 1, sizeof *x->beyond);
    x->precision = hci_memory_new(hci_candidates_terms_in(&list) + 1, sizeof *x->precision);
    if (!x->run || !x->beyond || !x->precision) status = hci_note_memory(note, NULL, "leaving runs out");
    x->groups.group = x->run;
    if (!status) precision_take(&list, x->precision);
    if (!status)
        status = hci_run_parts_each(e, parts, few > HCI_LEAST_GROUPS, group_add, &(grouping){&list, x}, note);
    hci_candidates_release(&list);
    if (status) hci_run_equations_release(x);
    return status;
}

void hci_run_equations_release(hci_run_equations *x)
{
    for (size_t r = 0; r < x->groups.count; ++r)
        hci_normal_equations_release(&x->run[r]);
    hci_memory_free(x->run);
    hci_memory_free(x->beyond);
    hci_memory_free(x->precision);
    memset(x, 0, sizeof *x);
}
