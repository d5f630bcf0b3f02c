#include "host/diagnose/search/rounds.h"

#include <math.h>

#include "host/diagnose/candidates/empirical_term.h"
#include "host/diagnose/candidates/make_candidates.h"
#include "host/diagnose/fit/model.h"
#include "host/diagnose/fit/unlike_iron.h"
#include "host/diagnose/search/backward.h"
#include "host/diagnose/search/few_values.h"
#include "host/diagnose/search/forward.h"
#include "host/diagnose/search/noise_left.h"
#include "host/diagnose/search/rivals.h"
#include "host/diagnose/search/sensor_zeros.h"
#include "host/diagnose/search/stability.h"

enum { MOST_EFFECTS = 9, MOST_ROUNDS = 14 };

/* Another effect; of as many as there may be, more of those that are in, or what no effect explains. */
static hci_status effect_add(hci_search *s, hci_fitted_model *model, bool *added, hci_note *note)
{
    const bool *before = s->denied;
    bool denied[HCI_MOST_TYPES];
    if (hci_candidates_types_in(&model->candidates) < MOST_EFFECTS)
        return hci_search_forward(s, model, added, note);
    for (size_t r = 0; r < hci_candidate_types(); ++r)
        denied[r] = (before && before[r]) || !hci_candidates_have(&model->candidates, hci_candidate_type(r));
    s->denied = denied;
    const hci_status status = hci_search_forward(s, model, added, note);
    s->denied = before;
    return status;
}

/* One more effect, then without those that it makes superfluous; where none comes in, another in place of one
 * that is, or a few in place of a series. again: out, whether anything changed. */
static hci_status round_run(hci_search *s, hci_fitted_model *model, bool *again, hci_note *note)
{
    hci_status status = effect_add(s, model, again, note);
    if (!status && *again) status = hci_search_prune(s, model, note);
    hci_search_see(s, &model->candidates);
    for (bool dropped = true; dropped && !status && !hci_search_is_over(s);)
        status = hci_search_drop(s, model, &dropped, note);
    hci_search_see(s, &model->candidates);
    if (!status && !*again && !hci_search_is_over(s)) {
        status = hci_search_swap(s, model, again, note);
        if (!status && *again) status = hci_search_prune(s, model, note);
    }
    if (!status && !*again && !hci_search_is_over(s)) status = hci_search_few_values(s, model, again, note);
    if (!status && !*again && !hci_search_is_over(s)) status = hci_search_sensor_zeros(s, model, again, note);
    if (!status && !*again && !hci_search_is_over(s)) status = hci_search_beside_zeros(s, model, again, note);
    if (!status && !*again) status = hci_search_late_channel(s, model, again, note);
    return status;
}

/* Of the whole work that is done before a round. How many rounds follow is not known; the later ones take
 * longer.
 */
static double share_before(int round)
{
    return HCI_ROUNDS_SHARE * pow(1.0 - pow(0.85, round), 1.5);
}

/* Shows what has been found so far. */
static hci_status model_show(hci_search *s, const hci_candidates *candidates, hci_note *note)
{
    hci_model model;
    if (!s->options->look) return HCI_OK;
    hci_status status = hci_model_make(s->regression->declared, candidates, false, &model, note);
    if (status) return status;
    status = s->options->look(s->options->look_context, candidates, &model.list, note);
    hci_model_release(&model);
    return status;
}

#define SHORT 0.6 /* of the limit of work */

/* Where work is short, and nothing but noise is left, no further effect is looked for: judging what was found
 * takes what remains. again: in and out. */
static hci_status short_work_end(hci_search *s, hci_fitted_model *model, bool *again, hci_note *note)
{
    const double *work = s->regression->work;
    bool is_all = false;
    if (!*again || !work || *work < SHORT * HCI_MOST_WORK) return HCI_OK;
    const hci_status status = hci_search_is_noise(s, &model->candidates, &is_all, note);
    *again = !is_all;
    return status ? status : hci_search_renew(s, model, note);
}

static hci_status rounds_run(hci_search *s, hci_fitted_model *model, hci_note *note)
{
    hci_status status = HCI_OK;
    bool again = true;
    s->seen_count = 0;
    for (int round = 0; again && !status && round < MOST_ROUNDS && !hci_search_is_over(s); ++round) {
        hci_search_begin(s, "looking for effects", share_before(round), share_before(round + 1));
        status = round_run(s, model, &again, note);
        if (!status && again) status = model_show(s, &model->candidates, note);
        if (!status) status = short_work_end(s, model, &again, note);
    }
    return status;
}

/* A turned back-EMF is taken for what it is before the rest is judged; from there the rounds go on. */
static hci_status turned_settle(hci_search *s, hci_fitted_model *model, hci_note *note)
{
    bool changed = false;
    const hci_status status = hci_search_angle_zero(s, model, &changed, note);
    return status || !changed ? status : rounds_run(s, model, note);
}

/* The same of a scale of all that the machine makes, which a gain of the torque sensor is. */
static hci_status scaled_settle(hci_search *s, hci_fitted_model *model, hci_note *note)
{
    bool changed = false;
    const hci_status status = hci_search_torque_gain(s, model, &changed, note);
    return status || !changed ? status : rounds_run(s, model, note);
}

/* ---- known effects alone ---- */

#define AS_MUCH 0.01 /* of what is left, that orders of any growth may take more */

/* Both are fitted with the noise that one of them leaves. behind: out, by how much the score of the known
 * effects is higher, about. */
static hci_status behind_by(hci_search *s, const hci_fitted_model *of, hci_fitted_model *known,
                            hci_fitted_model *model, double *behind, hci_note *note)
{
    hci_status status = hci_search_noise(s, &of->candidates, note);
    if (!status) status = hci_regression_fit(s->regression, &known->candidates, &known->fit, note);
    if (!status) status = hci_regression_fit(s->regression, &model->candidates, &model->fit, note);
    *behind = status ? (double)INFINITY : known->fit.score - model->fit.score;
    return status;
}

/* Whether the known effects alone describe the recordings down to the noise, and nearly as well; or better,
 * whichever of both the noise is taken from. */
static hci_status is_better(hci_search *s, hci_fitted_model *known, hci_fitted_model *model, bool *better,
                            hci_note *note)
{
    double behind = INFINITY, by_other = INFINITY;
    bool noise = false;
    hci_status status = hci_search_is_noise(s, &known->candidates, &noise, note);
    if (!status) status = behind_by(s, known, known, model, &behind, note);
    *better = noise && behind < AS_MUCH * fabs(model->fit.score);
    if (status || *better || !(behind < 0.0)) return status;
    status = behind_by(s, model, known, model, &by_other, note);
    *better = by_other < 0.0;
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

/* ---- direct current ---- */

#define AS_GOOD 0.1 /* of what a model explains, that another one in its place may leave besides */

/* Whether all runs in use are of direct current: one length of the current vector each, and to each angle of
 * the rotor one direction. */
static bool is_direct(const hci_regression *e)
{
    bool any = false;
    for (size_t r = 0; r < e->samples->run_count; ++r) {
        if (!e->use[r]) continue;
        if (!e->samples->statistics[r].is_direct || e->runs[r].torque_source != HCI_TORQUE_MEASURED)
            return false;
        any = true;
    }
    return any;
}

/* Whether a type is of the iron: it grows with a power of the currents. */
static bool is_of_iron(const hci_effect_type *type)
{
    return type->propose_coenergy && !type->any_phase && !type->is_small;
}

/* Takes out what direct currents do not tell from iron, and what they tell as well, which is found anew.
 * iron, others: out, whether such were in. */
static void magnetic_only_keep(hci_candidates *model, bool *iron, bool *others)
{
    *iron = *others = false;
    for (size_t r = 0; r < hci_candidate_types(); ++r) {
        const hci_effect_type *type = hci_candidate_type(r);
        if (!hci_candidates_have(model, type)) continue;
        *iron = *iron || is_of_iron(type);
        *others = *others || !type->propose_coenergy || type->any_phase;
        hci_candidates_remove_type(model, type);
    }
}

static hci_status square_of(hci_search *s, const hci_candidates *model, double *square, hci_note *note)
{
    const hci_status status = hci_search_residual(s, model, note);
    *square = pow(hci_search_residual_rms(s), 2.0);
    return status;
}

/* The share that one model leaves of what another explains; NAN where that explains nothing. */
static hci_status share_left(hci_search *s, const hci_candidates *one, const hci_candidates *other,
                             double *share, hci_note *note)
{
    static const hci_candidates none = {0};
    double before = 0.0, after = 0.0, left = 0.0;
    hci_status status = square_of(s, &none, &before, note);
    if (!status) status = square_of(s, other, &after, note);
    if (!status) status = square_of(s, one, &left, note);
    *share = before > after ? (left - after) / (before - after) : (double)NAN;
    return status;
}

/* With direct current each run says how the torque varies over the angle at one current. That iron which
 * saturates makes of the currents is then also a torque that is there without them, and what sensors that
 * are wrong make of the torque of the others. */
static hci_status try_magnetic(hci_search *s, hci_fitted_model *model, hci_note *note)
{
    hci_fitted_model magnetic = {0};
    bool iron = false, others = false;
    double share = NAN;
    if (!is_direct(s->regression)) return HCI_OK;
    hci_status status = hci_fitted_model_copy(model, &magnetic, note);
    if (status) return status;
    magnetic_only_keep(&magnetic.candidates, &iron, &others);
    s->magnetic_only = s->known_only = iron && others;
    if (s->magnetic_only) status = hci_search_renew(s, &magnetic, note);
    if (!status && s->magnetic_only) status = rounds_run(s, &magnetic, note);
    if (!status && s->magnetic_only)
        status = share_left(s, &magnetic.candidates, &model->candidates, &share, note);
    const bool nearly = !status && share < AS_GOOD;
    s->magnetic_only = s->known_only = nearly;
    if (!status && nearly) hci_fitted_model_replace(model, &magnetic);
    if (!status) status = hci_search_renew(s, model, note);
    hci_fitted_model_release(&magnetic);
    return status;
}

hci_status hci_search_rounds(hci_search *s, hci_fitted_model *model, hci_note *note)
{
    hci_search_begin(s, "looking for effects", 0.0, 0.0);
    hci_status status = hci_search_renew(s, model, note);
    if (!status) status = rounds_run(s, model, note);
    if (!status) status = turned_settle(s, model, note);
    if (!status) status = scaled_settle(s, model, note);
    if (!status && hci_candidates_have(&model->candidates, &hci_empirical_type) && !hci_search_is_over(s))
        status = try_known(s, model, note);
    return status ? status : try_magnetic(s, model, note);
}

/* ---- in place of what is denied ---- */

#define MOST 0.5 /* of the square that a model explains */

static hci_status lasting_keep(hci_search *s, hci_fitted_model *model, hci_note *note)
{
    const hci_status status = hci_search_keep_predictive(s, model, note);
    return status ? status : hci_search_drop_unsure(s, model, note);
}

/* Those that act on all that is read along time; single terms of the iron, the other ones that stand for each
 * other, have their whole. Returns whether any has left. */
static bool denied_find(const hci_candidates *before, const hci_candidates *after,
                        bool denied[HCI_MOST_TYPES])
{
    bool any = false;
    for (size_t r = 0; r < hci_candidate_types(); ++r) {
        const hci_effect_type *type = hci_candidate_type(r);
        denied[r] = (type->lag || type->late) && hci_candidates_have(before, type) &&
                    !hci_candidates_have(after, type);
        any = any || denied[r];
    }
    return any;
}

/* others: in, what has stayed; out, what was found besides. */
static hci_status others_find(hci_search *s, const bool *denied, hci_fitted_model *others, hci_note *note)
{
    s->denied = denied;
    hci_status status = hci_search_rounds(s, others, note);
    s->denied = NULL;
    return status ? status : lasting_keep(s, others, note);
}

static hci_status try_others(hci_search *s, hci_fitted_model *model, hci_fitted_model *others, hci_note *note)
{
    bool denied[HCI_MOST_TYPES];
    double share = 0.0;
    hci_status status = lasting_keep(s, others, note);
    if (status || !denied_find(&model->candidates, &others->candidates, denied)) return status;
    status = share_left(s, &others->candidates, &model->candidates, &share, note);
    if (status || !(share > MOST)) return status;
    status = others_find(s, denied, others, note);
    if (!status) status = share_left(s, &others->candidates, &model->candidates, &share, note);
    if (!status && share < AS_GOOD) hci_fitted_model_replace(model, others);
    return status;
}

hci_status hci_search_without_denied(hci_search *s, hci_fitted_model *model, hci_note *note)
{
    hci_fitted_model others = {0};
    if (hci_search_is_over(s)) return HCI_OK;
    hci_status status = hci_fitted_model_copy(model, &others, note);
    if (!status) status = try_others(s, model, &others, note);
    hci_fitted_model_release(&others);
    return status ? status : hci_search_renew(s, model, note);
}
