#include <string.h>

#include "host/diagnose/candidates/empirical_term.h"
#include "host/diagnose/search/candidate_models.h"
#include "host/diagnose/search/search.h"

#define EQUAL          6.0  /* models whose scores differ by less fit as well as each other */
#define PART           0.3  /* of what an effect is worth that makes another one plausible beside it */
#define PROMISED_SHARE 0.6  /* what a rival must promise of what the effect is worth … */
#define PROMISED_LESS  20.0 /* … less so much: promises are of a linearised problem */

/* Other effects in place of one that is in the account, one after the other. */
typedef struct {
    hci_search *search;
    const hci_account *account;
    const hci_effect_type *type; /* in whose place */
    hci_account without;
    hci_trials trials;
    size_t next;
} rivalry;

static hci_status rivalry_start(hci_search *s, const hci_account *account, const hci_effect_type *type,
                                rivalry *r, hci_note *note)
{
    memset(r, 0, sizeof *r);
    r->search = s;
    r->account = account;
    r->type = type;
    hci_status status = hci_search_without(s, account, type, &r->without, note);
    if (!status) status = hci_trials_make(s, &r->without.suspects, false, &r->trials, note);
    return status;
}

static void rivalry_end(rivalry *r)
{
    hci_trials_release(&r->trials);
    hci_account_release(&r->without);
}

static bool is_promising(const rivalry *r, const hci_trial *x)
{
    const hci_effect_type *other = hci_suspect_type(x->a);
    const double worth = r->without.fit.score - r->account->fit.score;
    return other != r->type && !hci_suspects_have(&r->account->suspects, other) &&
           !(x->gain < PROMISED_SHARE * worth - PROMISED_LESS);
}

/* The next promising rival, fitted. with: out, its type in hci_suspect_type's count, or its end. On failure
 * and at the end *rival is empty. */
static hci_status rivalry_next(rivalry *r, hci_account *rival, size_t *with, hci_note *note)
{
    memset(rival, 0, sizeof *rival);
    while (r->next < r->trials.count && !is_promising(r, &r->trials.trial[r->next]))
        ++r->next;
    *with = hci_suspect_types();
    if (r->next == r->trials.count) return HCI_OK;
    const hci_trial *x = &r->trials.trial[r->next++];
    *with = x->a;
    return hci_trial_fit(r->search, &r->trials, x, rival, note);
}

/* ---- another effect instead ---- */

/* What is not known has to be better, not as good. */
static double margin_of(size_t type)
{
    return hci_suspect_type(type) == &hci_unknown_type ? HCI_DECISIVE : HCI_AS_GOOD;
}

static hci_status swap_type(hci_search *s, hci_account *account, const hci_effect_type *type, bool *swapped,
                            hci_note *note)
{
    rivalry r;
    hci_account rival = {0};
    size_t with = 0;
    hci_status status = rivalry_start(s, account, type, &r, note);
    while (!status && !*swapped && with < hci_suspect_types()) {
        status = rivalry_next(&r, &rival, &with, note);
        if (status || with == hci_suspect_types()) break;
        if (rival.fit.score < account->fit.score - margin_of(with)) {
            hci_account_replace(account, &rival);
            *swapped = true;
            status = hci_search_renew(s, account, note);
        }
        hci_account_release(&rival);
    }
    rivalry_end(&r);
    return status;
}

hci_status hci_search_swap(hci_search *s, hci_account *account, bool *swapped, hci_note *note)
{
    hci_status status = HCI_OK;
    *swapped = false;
    for (size_t r = 0; r < hci_suspect_types() && !status && !*swapped; ++r)
        if (hci_suspects_have(&account->suspects, hci_suspect_type(r)))
            status = swap_type(s, account, hci_suspect_type(r), swapped, note);
    return status;
}

/* ---- effects that cannot be told apart ---- */

static size_t type_index(const hci_effect_type *type)
{
    size_t k = 0;
    while (k < hci_suspect_types() && hci_suspect_type(k) != type)
        ++k;
    return k;
}

static void rival_mark(const rivalry *r, size_t with, hci_account *rival, hci_attribution *a)
{
    hci_verdict *v = &a->verdict[with];
    v->ambiguous = true;
    v->rival_of = r->type;
    v->gain = r->without.fit.score - rival->fit.score;
    a->verdict[type_index(r->type)].ambiguous = true;
    hci_account_replace(&v->alternative, rival);
}

/* Rooms that would explain a part of what one in the account explains, if that were not there. */
static void plausible_mark(const rivalry *r, hci_attribution *a)
{
    const double worth = r->without.fit.score - r->account->fit.score;
    for (size_t k = 0; k < r->trials.count; ++k)
        if (r->trials.trial[k].gain > PART * worth)
            a->plausible[type_index(r->type)][r->trials.trial[k].a] = true;
}

hci_status hci_search_rivals(hci_search *s, const hci_effect_type *type, hci_attribution *a, hci_note *note)
{
    rivalry r;
    hci_account rival = {0};
    size_t with = 0;
    hci_status status = rivalry_start(s, &a->account, type, &r, note);
    if (!status) plausible_mark(&r, a);
    while (!status) {
        status = rivalry_next(&r, &rival, &with, note);
        if (status || with == hci_suspect_types()) break;
        const bool strange = hci_suspect_type(with) == &hci_unknown_type;
        if (!strange && rival.fit.score < a->account.fit.score + EQUAL) rival_mark(&r, with, &rival, a);
        hci_account_release(&rival);
    }
    rivalry_end(&r);
    return status;
}
