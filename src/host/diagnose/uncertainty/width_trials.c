#include "host/diagnose/uncertainty/width_trials.h"

#include <math.h>
#include <string.h>

#include "host/base/memory.h"

/* Widths that are tried, in units of the noise, the widest first. The last ones make less of a difference
 * than noise in a hundred thousand samples. */
static const double WIDTHS[] = {300.0, 100.0, 30.0, 10.0, 3.0,  1.0,  0.3, 0.1,
                                0.03,  0.01,  3e-3, 1e-3, 3e-4, 1e-4, 3e-5};

/* How much wider terms of the mean are expected, tried about the best width. */
static const double MEAN_TIMES[] = {4.0, 16.0};

enum {
    WIDTH_COUNT = sizeof WIDTHS / sizeof *WIDTHS,
    TIMES = sizeof MEAN_TIMES / sizeof *MEAN_TIMES,
    MOST_WORSE = 2
};

#define TOLD      0.3  /* of what is left open, that has been done before */
#define NONE_LEFT 15.0 /* of the misfit above the least: of 200 machines not one */

static const double *precision_of(const hci_width_trials *t, const hci_allowed_terms *terms,
                                  hci_allowed_width width)
{
    hci_allowed_terms_precision(terms, width, t->precision);
    return t->precision;
}

/* Each run with a noise of its own. */
static double misfit_of(const hci_condensed *runs, const hci_left_out_group *left)
{
    double sum = 0.0;
    for (size_t g = 0; g < runs->count; ++g)
        sum += runs->group[g].rows * log(left[g].square);
    return isnan(sum) ? (double)INFINITY : sum;
}

/* Adds a trial. */
static hci_status try(const hci_allowed_terms *terms, const hci_condensed *runs, hci_allowed_width width,
                      hci_width_trials *t, hci_note *note)
{
    const hci_expectation expected = {precision_of(t, terms, width), terms->centre};
    hci_width_trial *x = &t->trial[t->count];
    hci_watch_tell(runs->watch, "looking at what is left open",
                   TOLD + (1.0 - TOLD) * (double)t->count / HCI_MOST_WIDTHS);
    hci_ridge ridge;
    *x = (hci_width_trial){width, INFINITY, 0.0, hci_memory_new(runs->count + 1, sizeof *x->left)};
    if (!x->left) return hci_note_memory(note, NULL, "what recordings leave open");
    ++t->count;
    if (!hci_ridge_make(runs, &expected, &ridge)) return HCI_OK;
    const bool left_out = hci_ridge_leave_out(&ridge, runs, t->share, x->left);
    hci_ridge_release(&ridge);
    if (!left_out && hci_watch_stops(runs->watch)) return HCI_ERROR_STOPPED;
    if (!left_out) return hci_note_memory(note, NULL, "leaving runs out");
    x->misfit = misfit_of(runs, x->left);
    if (x->misfit < t->trial[t->best].misfit) t->best = t->count - 1;
    return HCI_OK;
}

/* All terms alike; none narrower is tried behind two that describe the runs too badly to count. */
static hci_status try_all_alike(const hci_allowed_terms *terms, const hci_condensed *runs,
                                hci_width_trials *t, hci_note *note)
{
    int worse = 0;
    hci_status status = HCI_OK;
    for (size_t w = 0; w < WIDTH_COUNT && worse < MOST_WORSE && !status; ++w) {
        status = try(terms, runs, (hci_allowed_width){WIDTHS[w], 1.0, 0.0, 1.0}, t, note);
        if (status) return status;
        const double misfit = t->trial[w].misfit, least = t->trial[t->best].misfit;
        worse = isfinite(misfit) && misfit > least + NONE_LEFT ? worse + 1 : 0;
    }
    return status;
}

/* The best width and its neighbours, with a wider mean. */
static hci_status try_wider_means(const hci_allowed_terms *terms, const hci_condensed *runs,
                                  hci_width_trials *t, hci_note *note)
{
    const size_t tried = t->count, best = t->best;
    hci_status status = HCI_OK;
    for (size_t w = best > 0 ? best - 1 : 0; w < tried && w <= best + 1; ++w)
        for (size_t k = 0; k < TIMES && !status; ++k)
            status = try(terms, runs, (hci_allowed_width){WIDTHS[w], MEAN_TIMES[k], 0.0, 1.0}, t, note);
    return status;
}

static void weigh(hci_width_trials *t)
{
    const double least = t->trial[t->best].misfit;
    double sum = 0.0;
    for (size_t k = 0; k < t->count; ++k) {
        t->trial[k].weight = isfinite(t->trial[k].misfit) ? exp(-0.5 * (t->trial[k].misfit - least)) : 0.0;
        sum += t->trial[k].weight;
    }
    for (size_t k = 0; k < t->count && sum > 0.0; ++k)
        t->trial[k].weight /= sum;
}

/* With the narrowest width: what a run alone tells of the model then, it tells with any. */
static hci_status shares_find(const hci_allowed_terms *terms, const hci_condensed *runs, hci_width_trials *t,
                              hci_note *note)
{
    const hci_allowed_width narrowest = {WIDTHS[WIDTH_COUNT - 1], 1.0, 0.0, 1.0};
    const hci_expectation expected = {precision_of(t, terms, narrowest), terms->centre};
    hci_ridge ridge;
    t->share = hci_memory_new(runs->count + 1, sizeof *t->share);
    if (!t->share) return hci_note_memory(note, NULL, "leaving runs out");
    t->shares = runs->count;
    if (!hci_ridge_make(runs, &expected, &ridge)) return HCI_OK;
    const bool made = hci_ridge_shares(&ridge, runs, t->share);
    hci_ridge_release(&ridge);
    if (!made && hci_watch_stops(runs->watch)) return HCI_ERROR_STOPPED;
    return made ? HCI_OK : hci_note_memory(note, NULL, "leaving runs out");
}

/* One over the size of the errors, in which expectations are counted; 0 where none is known. */
static double twins_of(const hci_left_out_group *left, size_t count)
{
    double sum = 0.0, told = 0.0;
    for (size_t g = 0; g < count; ++g) {
        if (!isfinite(left[g].misfit)) continue;
        sum += left[g].misfit;
        told += 1.0;
    }
    return sum > 0.0 ? sqrt(told / sum) : 0.0;
}

static hci_status try_powers(const hci_allowed_terms *terms, const hci_condensed *runs, hci_width_trials *t,
                             hci_note *note)
{
    const hci_width_trial *best = &t->trial[t->best];
    hci_power_trials_of of = {terms, runs, best->width, t->precision};
    of.width.twins = twins_of(best->left, runs->count);
    return hci_power_trials_make(&of, &t->powers, note);
}

hci_status hci_width_trials_make(const hci_allowed_terms *terms, const hci_condensed *runs,
                                 hci_width_trials *t, hci_note *note)
{
    memset(t, 0, sizeof *t);
    t->precision = hci_memory_new(terms->count + 1, sizeof *t->precision);
    if (!t->precision) return hci_note_memory(note, NULL, "what recordings leave open");
    hci_status status = shares_find(terms, runs, t, note);
    if (!status) status = try_all_alike(terms, runs, t, note);
    if (!status) status = try_wider_means(terms, runs, t, note);
    if (!status) weigh(t);
    if (!status) status = try_powers(terms, runs, t, note);
    return status;
}

void hci_width_trials_release(hci_width_trials *t)
{
    for (size_t k = 0; k < t->count; ++k)
        hci_memory_free(t->trial[k].left);
    for (size_t g = 0; g < t->shares; ++g)
        hci_memory_free(t->share[g]);
    hci_memory_free(t->share);
    hci_memory_free(t->precision);
    memset(t, 0, sizeof *t);
}

bool hci_width_trials_ridge(const hci_width_trials *t, hci_width_place at, const hci_allowed_terms *terms,
                            const hci_condensed *runs, hci_ridge *ridge)
{
    hci_allowed_width width = t->trial[at.width].width;
    width.twins = twins_of(t->trial[at.width].left, runs->count);
    width.beyond = t->powers.trial[at.power].beyond;
    const hci_expectation expected = {precision_of(t, terms, width), terms->centre};
    return hci_ridge_make(runs, &expected, ridge);
}
