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
            const double value = list->candidate[k].term[j].value - list->candidate[k].declared[j];
            x->square += value * (2.0 * x->moment[column] + value * x->gram[column * x->n + column]);
            for (size_t i = 0; i < x->n; ++i)
                x->moment[i] += value * x->gram[column * x->n + i];
        }
}

static hci_status runs_linearise(hci_regression *e, const hci_candidates *list, bool *one,
                                 hci_run_equations *x, hci_note *note)
{
    const bool *use = e->use;
    hci_status status = HCI_OK;
    for (size_t r = 0; r < e->samples->run_count && !status; ++r) {
        if (!use[r]) continue;
        one[r] = true;
        e->use = one;
        status = hci_regression_normal(e, list, false, &x->run[x->groups.count], note);
        if (!status) count_from_zero(list, &x->run[x->groups.count++]);
        one[r] = false;
    }
    e->use = use;
    return status;
}

hci_status hci_run_equations_make(hci_regression *e, const hci_candidates *candidates, hci_run_equations *x,
                                  hci_note *note)
{
    hci_candidates list = {0};
    memset(x, 0, sizeof *x);
    bool *one = hci_memory_new(e->samples->run_count + 1, sizeof *one);
    hci_status status = hci_candidates_copy(candidates, &list, note);
    if (!status) {
        x->run = hci_memory_new(e->samples->run_count + 1, sizeof *x->run);
        x->precision = hci_memory_new(hci_candidates_terms_in(&list) + 1, sizeof *x->precision);
        if (!x->run || !x->precision || !one) status = hci_note_memory(note, NULL, "leaving runs out");
    }
    if (!status) {
        x->groups.group = x->run;
        precision_take(&list, x->precision);
        status = runs_linearise(e, &list, one, x, note);
    }
    hci_candidates_release(&list);
    hci_memory_free(one);
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
