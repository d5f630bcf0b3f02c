#include "host/diagnose/search/candidate_models.h"

#include <string.h>

#include "host/base/memory.h"
#include "host/diagnose/search/group_selection.h"

#define SAME       1e-4  /* share of a column that the model leaves of terms that look the same … */
#define OWN        1e-2  /* … and of those that do not */
#define NOT_IN_USE 1e300 /* variance of cells that say nothing */

static hci_status no_memory(hci_note *note)
{
    return hci_note_set(note, HCI_ERROR_MEMORY, "out of memory for the search of effects");
}

/* ---- suspects ---- */

static void variance_set(hci_search *s)
{
    const hci_cells *cells = s->evidence->cells;
    for (size_t j = 0; j < cells->count; ++j)
        s->variance[j] = NOT_IN_USE;
    for (const hci_stretch *x = NULL; (x = hci_evidence_next(s->evidence, x)) != NULL;) {
        const double rms = hci_evidence_noise(s->evidence, x)->rms;
        for (size_t j = x->first; j < x->first + x->count && rms > 0.0; ++j)
            s->variance[j] = rms * rms;
    }
}

/* A fresh list of suspects for what the model leaves, the model in it. */
static hci_status suspects_renew(hci_search *s, const hci_suspects *model, hci_suspects *list, hci_note *note)
{
    const bool saturates = hci_suspects_have(model, hci_effect_type_find("saturation"));
    const hci_suspects_source source = {s->evidence->machine,
                                        s->evidence->cells,
                                        s->options->runs,
                                        s->evidence->use,
                                        s->residual_Nm,
                                        s->variance,
                                        s->options->reference_current_A,
                                        saturates ? s->richness : 0};
    const hci_status status = hci_search_residual(s, model, note);
    if (status) return status;
    variance_set(s);
    return hci_suspects_make(&source, model, list, note);
}

/* ---- trials ---- */

/* What the linearised problem is solved with. */
typedef struct {
    hci_choice choice;
    hci_sweep base, sweep;
    size_t *column;
    bool *spare;
} bench;

static bool bench_make(const hci_suspects *list, const hci_normal *normal, bench *b)
{
    memset(b, 0, sizeof *b);
    b->column = hci_memory_new(list->count + 1, sizeof *b->column);
    b->spare = hci_memory_new(list->count + 1, sizeof *b->spare);
    if (!b->column || !b->spare || !hci_sweep_start(&b->base, normal) || !hci_sweep_start(&b->sweep, normal))
        return false;
    b->choice = (hci_choice){list, b->column, &b->base, normal->rows};
    for (size_t k = 0, at = 0; k < list->count; ++k) {
        b->column[k] = at;
        at += list->suspect[k].count;
        if (list->suspect[k].in) hci_choice_enter(&b->choice, &b->base, k);
    }
    return true;
}

static void bench_release(bench *b)
{
    hci_sweep_release(&b->base);
    hci_sweep_release(&b->sweep);
    hci_memory_free(b->column);
    hci_memory_free(b->spare);
}

static void trial_add(hci_trials *t, bench *b, size_t type_a, size_t type_b)
{
    hci_trial *x = &t->trial[t->count];
    *x = (hci_trial){type_a, type_b, 0.0, t->flags + t->count * (t->list.count + 1)};
    x->gain = hci_choice_grow(&b->choice, hci_suspect_type(type_a), hci_suspect_type(type_b), x->in,
                              &b->sweep, b->spare);
    ++t->count;
}

static hci_status trials_fill(hci_search *s, hci_trials *t, const hci_normal *normal, bool pairs,
                              hci_note *note)
{
    const size_t types = hci_suspect_types();
    bench b;
    t->flags = hci_memory_new((t->list.count + 1) * HCI_MOST_TRIALS, sizeof *t->flags);
    const bool made = bench_make(&t->list, normal, &b) && t->flags;
    for (size_t type_a = 0; made && type_a < types; ++type_a) {
        hci_search_tell(s);
        for (size_t type_b = type_a; type_b < (pairs ? types : type_a + 1); ++type_b)
            trial_add(t, &b, type_a, type_b);
    }
    bench_release(&b);
    return made ? HCI_OK : no_memory(note);
}

hci_status hci_trials_make(hci_search *s, const hci_suspects *model, bool pairs, hci_trials *t,
                           hci_note *note)
{
    hci_normal normal;
    memset(t, 0, sizeof *t);
    hci_status status = suspects_renew(s, model, &t->list, note);
    if (status) return status;
    status = hci_evidence_normal(s->evidence, &t->list, true, &normal, note);
    if (!status) status = trials_fill(s, t, &normal, pairs, note);
    hci_normal_release(&normal);
    if (status) hci_trials_release(t);
    return status;
}

/* ---- terms that look the same ---- */

/* Whether a sweep leaves less than a share of all columns of a suspect, what is expected of them aside. */
static bool is_within(const bench *b, const hci_sweep *sweep, size_t suspect, double share)
{
    for (size_t j = 0; j < b->choice.list->suspect[suspect].count; ++j) {
        const size_t c = b->column[suspect] + j;
        const double expected = b->choice.list->suspect[suspect].deviation;
        const double prior = expected > 0.0 ? 1.0 / (expected * expected) : 0.0;
        const double whole = sweep->diagonal[c] - prior, rest = sweep->a[c * sweep->n + c] - prior;
        if (!(whole > 0.0) || rest > share * whole) return false;
    }
    return true;
}

/* The type in the model without which the suspect would stand on its own; NULL: none. */
static const hci_effect_type *stands_for(bench *b, size_t suspect)
{
    const hci_suspects *list = b->choice.list;
    for (size_t r = 0; r < hci_suspect_types(); ++r) {
        const hci_effect_type *type = hci_suspect_type(r);
        if (!hci_suspects_have(list, type)) continue;
        hci_sweep_copy(&b->sweep, &b->base);
        for (size_t k = 0; k < list->count; ++k)
            for (size_t j = 0; j < list->suspect[k].count && list->suspect[k].type == type; ++j)
                hci_sweep_out(&b->sweep, b->column[k] + j);
        if (!is_within(b, &b->sweep, suspect, OWN)) return type;
    }
    return NULL;
}

static void same_find(bench *b, const hci_effect_type *same_as[HCI_MOST_TYPES])
{
    const hci_suspects *list = b->choice.list;
    for (size_t k = 0; k < list->count; ++k) {
        size_t r = 0;
        while (hci_suspect_type(r) != list->suspect[k].type)
            ++r;
        if (same_as[r] || hci_suspects_have(list, list->suspect[k].type)) continue;
        if (is_within(b, &b->base, k, SAME)) same_as[r] = stands_for(b, k);
    }
}

hci_status hci_trials_same(hci_search *s, const hci_suspects *model,
                           const hci_effect_type *same_as[HCI_MOST_TYPES], hci_note *note)
{
    hci_suspects list = {0};
    hci_normal normal = {0};
    bench b;
    hci_status status = suspects_renew(s, model, &list, note);
    memset(same_as, 0, HCI_MOST_TYPES * sizeof *same_as);
    if (!status) status = hci_evidence_normal(s->evidence, &list, true, &normal, note);
    if (!status) {
        if (bench_make(&list, &normal, &b))
            same_find(&b, same_as);
        else
            status = no_memory(note);
        bench_release(&b);
    }
    hci_normal_release(&normal);
    hci_suspects_release(&list);
    return status;
}

void hci_trials_release(hci_trials *t)
{
    hci_suspects_release(&t->list);
    hci_memory_free(t->flags);
    memset(t, 0, sizeof *t);
}

hci_status hci_trial_fit(hci_search *s, const hci_trials *t, const hci_trial *x, hci_account *account,
                         hci_note *note)
{
    memset(account, 0, sizeof *account);
    hci_status status = hci_suspects_copy(&t->list, &account->suspects, note);
    for (size_t k = 0; k < account->suspects.count && !status; ++k)
        account->suspects.suspect[k].in = account->suspects.suspect[k].in || x->in[k];
    if (!status) status = hci_evidence_fit(s->evidence, &account->suspects, &account->fit, note);
    if (status) hci_account_release(account);
    return status;
}
