#include "host/diagnose/search/rounds.h"

#include <math.h>

#include "host/diagnose/candidates/empirical_term.h"
#include "host/diagnose/search/backward.h"
#include "host/diagnose/search/few_values.h"
#include "host/diagnose/search/forward.h"
#include "host/diagnose/search/rivals.h"
#include "host/diagnose/search/settle.h"

enum { MOST_EFFECTS = 9, MOST_ROUNDS = 14 };

/* One more effect, then without those that it makes superfluous; where none comes in, another in place of one
 * that is, or a few in place of a series. again: out, whether anything changed. */
static hci_status round_run(hci_search *s, hci_fitted_model *model, bool *again, hci_note *note)
{
    hci_status status = HCI_OK;
    *again = false;
    if (hci_candidates_types_in(&model->candidates) < MOST_EFFECTS)
        status = hci_search_forward(s, model, again, note);
    if (!status && *again) status = hci_search_prune(s, model, note);
    for (bool dropped = true; dropped && !status && !hci_search_is_over(s);)
        status = hci_search_drop(s, model, &dropped, note);
    if (!status && !*again && !hci_search_is_over(s)) {
        status = hci_search_swap(s, model, again, note);
        if (!status && *again) status = hci_search_prune(s, model, note);
    }
    if (!status && !*again && !hci_search_is_over(s)) status = hci_search_few_values(s, model, again, note);
    return status;
}

/* Of the whole work that is done before a round. How many rounds follow is not known; the later ones take
 * longer.
 */
static double share_before(int round)
{
    return HCI_ROUNDS_SHARE * pow(1.0 - pow(0.85, round), 1.5);
}

static hci_status rounds_run(hci_search *s, hci_fitted_model *model, hci_note *note)
{
    hci_status status = HCI_OK;
    bool again = true;
    for (int round = 0; again && !status && round < MOST_ROUNDS && !hci_search_is_over(s); ++round) {
        hci_search_begin(s, "looking for effects", share_before(round), share_before(round + 1));
        status = round_run(s, model, &again, note);
    }
    return status;
}

/* ---- known effects alone ---- */

#define AS_MUCH 0.01 /* of what is left, that orders of any growth may take more */

/* Whether the known effects alone describe the recordings down to the noise, and as well. Both are judged by
 * the noise that these leave. */
static hci_status is_better(hci_search *s, hci_fitted_model *known, hci_fitted_model *model, bool *better,
                            hci_note *note)
{
    hci_status status = hci_search_is_noise(s, &known->candidates, better, note);
    if (!status && *better) status = hci_regression_fit(s->regression, &known->candidates, &known->fit, note);
    if (!status && *better) status = hci_regression_fit(s->regression, &model->candidates, &model->fit, note);
    *better = *better && known->fit.score < model->fit.score + AS_MUCH * fabs(model->fit.score);
    return status;
}

/* A description by orders that grow as no effect does comes in early, where several effects together are what
 * it describes, and then stands in their place. So they are looked for without it. */
static hci_status try_known(hci_search *s, hci_fitted_model *model, hci_note *note)
{
    hci_fitted_model known = {0};
    bool better = false;
    hci_status status = hci_fitted_model_copy(model, &known, note);
    if (status) return status;
    s->known_only = true;
    hci_candidates_remove_type(&known.candidates, &hci_empirical_type);
    status = hci_search_renew(s, &known, note);
    if (!status) status = rounds_run(s, &known, note);
    s->known_only = false;
    if (!status) status = is_better(s, &known, model, &better, note);
    if (!status && better) hci_fitted_model_replace(model, &known);
    if (!status && !better) status = hci_search_renew(s, model, note);
    hci_fitted_model_release(&known);
    return status;
}

hci_status hci_search_rounds(hci_search *s, hci_fitted_model *model, hci_note *note)
{
    hci_search_begin(s, "looking for effects", 0.0, 0.0);
    hci_status status = hci_search_renew(s, model, note);
    if (!status) status = rounds_run(s, model, note);
    if (!status && hci_candidates_have(&model->candidates, &hci_empirical_type) && !hci_search_is_over(s))
        status = try_known(s, model, note);
    return status;
}
