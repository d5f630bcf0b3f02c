#include "host/diagnose/search/search.h"

/* ---- single orders ---- */

/* What a suspect whose columns begin at c is worth over its cost. At the solution steps are near 0, so that
 * what leaving costs is that of its value. */
static double stay_gain(const hci_sweep *sweep, const hci_suspect *x, size_t c, double rows)
{
    double saved[HCI_SUSPECT_TERMS];
    for (size_t j = 0; j < x->count; ++j) {
        saved[j] = sweep->b[c + j];
        sweep->b[c + j] += x->term[j].value;
    }
    const double gain = hci_sweep_worth(sweep, c, x->count) - hci_suspect_cost(x, rows);
    for (size_t j = 0; j < x->count; ++j)
        sweep->b[c + j] = saved[j];
    return gain;
}

/* The one that is worth least, where that is less than its cost; else the number of suspects. */
static size_t worthless(const hci_suspects *model, const hci_sweep *sweep, double rows)
{
    size_t worst = model->count;
    double least = 0.0;
    for (size_t k = 0, c = 0; k < model->count; ++k) {
        const hci_suspect *x = &model->suspect[k];
        if (!x->in) continue;
        const double gain = stay_gain(sweep, x, c, rows);
        c += x->count;
        if (gain < least) {
            least = gain;
            worst = k;
        }
    }
    return worst;
}

static hci_status worthless_find(hci_search *s, const hci_suspects *model, size_t *worst, hci_note *note)
{
    hci_normal normal;
    hci_sweep sweep = {0};
    hci_status status = hci_evidence_normal(s->evidence, model, false, &normal, note);
    if (status) return status;
    if (!hci_sweep_start(&sweep, &normal))
        status = hci_note_set(note, HCI_ERROR_MEMORY, "out of memory for the search of effects");
    for (size_t c = 0; c < normal.n && !status; ++c)
        hci_sweep_in(&sweep, c);
    if (!status) *worst = worthless(model, &sweep, normal.rows);
    hci_sweep_release(&sweep);
    hci_normal_release(&normal);
    return status;
}

/* Leaves one suspect out where a fit is as good without. */
static hci_status leave_one(hci_search *s, hci_account *account, size_t k, bool *left, hci_note *note)
{
    hci_account without = {0};
    hci_status status = hci_account_copy(account, &without, note);
    if (status) return status;
    without.suspects.suspect[k].in = false;
    status = hci_evidence_fit(s->evidence, &without.suspects, &without.fit, note);
    *left = !status && without.fit.score <= account->fit.score + HCI_AS_GOOD;
    if (*left) hci_account_replace(account, &without);
    hci_account_release(&without);
    return status;
}

hci_status hci_search_prune(hci_search *s, hci_account *account, hci_note *note)
{
    hci_status status = HCI_OK;
    for (bool again = true; again && !status;) {
        size_t worst = account->suspects.count;
        again = false;
        status = worthless_find(s, &account->suspects, &worst, note);
        if (!status && worst < account->suspects.count) status = leave_one(s, account, worst, &again, note);
    }
    return status;
}

/* ---- effects ---- */

static hci_status drop_type(hci_search *s, hci_account *account, const hci_effect_type *type, bool *dropped,
                            hci_note *note)
{
    hci_account without = {0};
    bool noticeable = true;
    hci_status status = hci_search_without(s, account, type, &without, note);
    if (!status) status = hci_search_noticeable(s, &account->suspects, &without.suspects, &noticeable, note);
    *dropped = !status && (without.fit.score < account->fit.score + HCI_DECISIVE || !noticeable);
    if (*dropped) {
        hci_account_replace(account, &without);
        status = hci_search_renew(s, account, note);
    }
    hci_account_release(&without);
    return status;
}

hci_status hci_search_drop(hci_search *s, hci_account *account, bool *dropped, hci_note *note)
{
    hci_status status = HCI_OK;
    *dropped = false;
    for (size_t r = 0; r < hci_suspect_types() && !status && !*dropped; ++r)
        if (hci_suspects_have(&account->suspects, hci_suspect_type(r)))
            status = drop_type(s, account, hci_suspect_type(r), dropped, note);
    return status;
}
