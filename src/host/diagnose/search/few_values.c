#include "host/diagnose/search/few_values.h"

#include <math.h>

#include "host/diagnose/candidates/modelled_gain.h"
#include "host/diagnose/fit/load_range.h"
#include "host/diagnose/search/belief.h"
#include "host/diagnose/search/forward.h"
#include "host/diagnose/search/stability.h"

#define NEARER 0.7  /* share of what it is behind that a step may leave */
#define ALIKE  3.0  /* standard errors by which delays differ that are one … */
#define SAME   0.01 /* … or a share of their sum */

enum { MOST_STEPS = 3 };

/* The model with all series in the currents taken out, or with nothing at all. */
static hci_status start(hci_search *s, const hci_fitted_model *model, bool empty, hci_fitted_model *few,
                        hci_note *note)
{
    hci_status status = hci_fitted_model_copy(model, few, note);
    for (size_t k = 0; k < few->candidates.count; ++k)
        if (empty || few->candidates.candidate[k].type->is_series) few->candidates.candidate[k].in = false;
    if (!status) status = hci_search_fit(s, few, note);
    return status;
}

/* Takes effects of few values in until it is better than the model, or no further one comes in, or one that
 * brings it hardly nearer. */
static hci_status steps_run(hci_search *s, const hci_fitted_model *model, hci_fitted_model *few, bool *better,
                            hci_note *note)
{
    hci_status status = HCI_OK;
    bool added = true;
    *better = false;
    for (int step = 0; step < MOST_STEPS && added && !*better && !status && !hci_search_is_over(s); ++step) {
        const double behind = few->fit.score - model->fit.score;
        status = hci_search_forward_few(s, few, model->fit.score + NEARER * behind, &added, note);
        *better = !status && few->fit.score < model->fit.score - HCI_AS_GOOD;
    }
    return status;
}

hci_status hci_search_few_values(hci_search *s, hci_fitted_model *model, bool *changed, hci_note *note)
{
    hci_status status = HCI_OK;
    *changed = false;
    const bool series = hci_candidates_have_series(&model->candidates);
    if (!series && !s->from_no_load) return HCI_OK;
    for (int empty = !series; empty < 2 && !*changed && !status && !hci_search_is_over(s); ++empty) {
        hci_fitted_model few = {0};
        status = start(s, model, empty, &few, note);
        if (!status) status = steps_run(s, model, &few, changed, note);
        if (!status && *changed) {
            hci_fitted_model_replace(model, &few);
            status = hci_search_renew(s, model, note);
        }
        hci_fitted_model_release(&few);
    }
    return status;
}

/* ---- a zero of the angle in place of turned waves ---- */

/* Of the waves that the magnets make: back-EMF and cogging torque. */
static bool is_of_magnets(const hci_effect_type *type)
{
    return type->propose_coenergy && (type->any_phase || type->is_small);
}

static const hci_effect_type *angle_zero(void)
{
    size_t k = 0;
    const hci_effect_type *type;
    while ((type = hci_effect_type_at(k)) != NULL && !type->is_angle_zero)
        ++k;
    return type;
}

/* Sine and cosine of the fundamental of the declared back-EMF, N·m/A. */
static void declared_fundamental(const hci_machine *machine, double wave[2])
{
    wave[0] = wave[1] = 0.0;
    for (size_t k = 0; k < machine->back_emf_count; ++k) {
        if (fabs(machine->back_emf[k].order - 1.0) >= HCI_ORDER_TOLERANCE) continue;
        wave[0] += machine->back_emf[k].sine;
        wave[1] += machine->back_emf[k].cosine;
    }
}

/* The angle by which a model turns the fundamental of the declared back-EMF; 0 where it leaves its phase. */
static double turned_by_rad(const hci_search *s, const hci_candidates *model)
{
    double declared[2];
    declared_fundamental(s->regression->machine, declared);
    double wave[2] = {declared[0], declared[1]};
    for (size_t k = 0; k < model->count; ++k) {
        const hci_candidate *x = &model->candidate[k];
        for (size_t j = 0; x->in && is_of_magnets(x->type) && !x->type->any_phase && j < x->count; ++j)
            if (fabs(x->term[j].order - 1.0) < HCI_ORDER_TOLERANCE && x->term[j].parameter < 2)
                wave[x->term[j].parameter] += x->term[j].value;
    }
    return atan2(wave[0] * declared[1] - wave[1] * declared[0],
                 wave[0] * declared[0] + wave[1] * declared[1]);
}

#define ALONG_Q (5.0 * HCI_PI / 180.0)

/* Whether a saliency would turn the torque as well: all loads lie along one direction, which is not q, and
 * would not be with another zero, as where the drive keeps its i_d at 0. */
static bool is_saliency_as_well(const hci_search *s, const hci_candidates *model)
{
    const double lead_rad = hci_load_lead_rad(s->regression);
    return fabs(remainder(lead_rad, HCI_PI)) > ALONG_Q &&
           fabs(remainder(lead_rad + turned_by_rad(s, model), HCI_PI)) > ALONG_Q;
}

/* The model with a zero of the angle in place of a back-EMF that differs, and of a cogging torque unless it
 * stays. */
static hci_status turned_make(hci_search *s, const hci_fitted_model *model, bool cogging_stays,
                              hci_fitted_model *turned, hci_note *note)
{
    hci_candidate x = {.type = angle_zero(), .count = 1, .in = true};
    x.term[0] = (hci_effect_term){0, 0.0, turned_by_rad(s, &model->candidates), NAN};
    hci_status status = hci_fitted_model_copy(model, turned, note);
    for (size_t k = 0; !status && k < turned->candidates.count; ++k) {
        hci_candidate *c = &turned->candidates.candidate[k];
        c->in = c->in && (!is_of_magnets(c->type) || (cogging_stays && c->type->any_phase));
    }
    if (!status) status = hci_candidates_add(&turned->candidates, &x, note);
    return status ? status : hci_search_fit(s, turned, note);
}

/* Where the score hardly tells them apart, runs left out have to be described no worse. */
static hci_status is_kept(hci_search *s, const hci_fitted_model *model, const hci_fitted_model *turned,
                          bool *kept, hci_note *note)
{
    double misfit = 0.0, turned_misfit = 0.0;
    *kept = true;
    if (turned->fit.score < model->fit.score - HCI_DECISIVE) return HCI_OK;
    hci_status status = hci_search_left_out(s, &model->candidates, &misfit, note);
    if (!status) status = hci_search_left_out(s, &turned->candidates, &turned_misfit, note);
    *kept = turned_misfit < misfit + HCI_AS_GOOD;
    return status;
}

/* Puts that in place of the model where it is better, at once or after a few more effects. */
static hci_status turned_try(hci_search *s, hci_fitted_model *model, bool cogging_stays, bool *better,
                             hci_note *note)
{
    hci_fitted_model turned = {0};
    hci_status status = turned_make(s, model, cogging_stays, &turned, note);
    *better = !status && turned.fit.score < model->fit.score - HCI_AS_GOOD;
    if (!status && !*better) status = steps_run(s, model, &turned, better, note);
    if (!status && *better) status = is_kept(s, model, &turned, better, note);
    if (!status && *better) {
        hci_fitted_model_replace(model, &turned);
        status = hci_search_renew(s, model, note);
    }
    hci_fitted_model_release(&turned);
    return status;
}

hci_status hci_search_angle_zero(hci_search *s, hci_fitted_model *model, bool *changed, hci_note *note)
{
    hci_status status = HCI_OK;
    const hci_regression *e = s->regression;
    *changed = false;
    if (turned_by_rad(s, &model->candidates) == 0.0 || s->no_current ||
        hci_candidates_lack_angle(e->runs, e->use, e->samples->run_count) ||
        hci_candidates_have(&model->candidates, angle_zero()) || is_saliency_as_well(s, &model->candidates))
        return HCI_OK;
    for (int stays = 0; stays < 2 && !*changed && !status; ++stays)
        status = turned_try(s, model, stays, changed, note);
    return status;
}

/* ---- one late channel in place of two early ones ---- */

/* How much later than all other channels that of the torque is read, where these are early by the same time.
 * 0: they are not, or are not all in. */
static double later_s(const hci_candidates *model, const hci_effect_type *type)
{
    double sum = 0.0, least = INFINITY, most = -INFINITY, error = 0.0, count = 0.0;
    for (size_t k = 0; k < model->count; ++k)
        for (size_t j = 0; model->candidate[k].in && j < model->candidate[k].count; ++j) {
            const hci_effect_term *term = &model->candidate[k].term[j];
            if (model->candidate[k].type != type) continue;
            if (term->parameter == type->late[0]) return 0.0;
            sum += term->value;
            least = fmin(least, term->value);
            most = fmax(most, term->value);
            error = fmax(error, term->std_error);
            count += 1.0;
        }
    if (count + 1.0 < (double)type->parameter_count) return 0.0;
    return most - least < fmax(ALIKE * error, SAME * fabs(sum)) ? -sum / count : 0.0;
}

static double price_of(const hci_candidates *model, const hci_effect_type *type)
{
    double price = 0.0;
    for (size_t k = 0; k < model->count; ++k)
        if (model->candidate[k].in && model->candidate[k].type == type) price += model->candidate[k].price;
    return price;
}

/* The model with that channel alone late. It was chosen as those in whose place it comes. */
static hci_status late_make(hci_search *s, const hci_fitted_model *model, const hci_effect_type *type,
                            double delay_s, hci_fitted_model *late, hci_note *note)
{
    hci_candidate x = {.type = type, .count = 1, .in = true};
    x.term[0] = (hci_effect_term){type->late[0], 0.0, delay_s, NAN};
    x.price = price_of(&model->candidates, type);
    hci_status status = hci_fitted_model_copy(model, late, note);
    hci_candidates_remove_type(&late->candidates, type);
    if (!status) status = hci_candidates_add(&late->candidates, &x, note);
    return status ? status : hci_search_fit(s, late, note);
}

hci_status hci_search_late_channel(hci_search *s, hci_fitted_model *model, bool *changed, hci_note *note)
{
    hci_status status = HCI_OK;
    *changed = false;
    for (size_t r = 0; r < hci_candidate_types() && !*changed && !status; ++r) {
        const hci_effect_type *type = hci_candidate_type(r);
        hci_fitted_model late = {0};
        const double delay_s = type->late ? later_s(&model->candidates, type) : 0.0;
        if (delay_s == 0.0) continue;
        status = late_make(s, model, type, delay_s, &late, note);
        *changed = !status && late.fit.score < model->fit.score;
        if (*changed) hci_fitted_model_replace(model, &late);
        hci_fitted_model_release(&late);
    }
    return status || !*changed ? status : hci_search_renew(s, model, note);
}

/* ---- a gain of the torque sensor in place of a scale of all that the machine makes ---- */

static const hci_effect_type *torque_gain(void)
{
    size_t k = 0;
    const hci_effect_type *type;
    while ((type = hci_effect_type_at(k)) != NULL && !(type->read_torque && type->seen_as))
        ++k;
    return type;
}

/* The type that changes the torque per ampere by most, and by how much; NULL: none does. */
static hci_status scale_find(const hci_search *s, const hci_candidates *model, const hci_effect_type **type,
                             double *gain, hci_note *note)
{
    double share = 1.0;
    hci_status status = hci_search_constant_share(s, model, &share, note);
    *type = NULL;
    *gain = 0.0;
    for (size_t r = 0; r < hci_candidate_types() && !status; ++r) {
        hci_candidates without = {0};
        double rest = share;
        if (!hci_candidates_have(model, hci_candidate_type(r))) continue;
        status = hci_candidates_copy(model, &without, note);
        if (!status) hci_candidates_remove_type(&without, hci_candidate_type(r));
        if (!status) status = hci_search_constant_share(s, &without, &rest, note);
        hci_candidates_release(&without);
        if (status || rest == 0.0 || fabs(share / rest - 1.0) <= fabs(*gain)) continue;
        *type = hci_candidate_type(r);
        *gain = share / rest - 1.0;
    }
    return status;
}

/* The model with a gain in place of the orders of the cogging torque that show it, and of that scale; of a
 * scale that is kept, the gain is a part. */
static hci_status read_make(hci_search *s, const hci_fitted_model *model, const hci_effect_type *scale,
                            double gain, hci_fitted_model *read, hci_note *note)
{
    hci_candidate x = {.type = torque_gain(), .count = 1, .in = true};
    x.term[0] = (hci_effect_term){0, 0.0, gain, NAN};
    hci_status status = hci_fitted_model_copy(model, read, note);
    for (size_t k = 0; !status && k < read->candidates.count; ++k)
        if (hci_modelled_gain_has(s->regression->machine, &model->candidates, gain, k))
            read->candidates.candidate[k].in = false;
    if (!status && scale) hci_candidates_remove_type(&read->candidates, scale);
    if (!status) status = hci_candidates_add(&read->candidates, &x, note);
    return status ? status : hci_search_fit(s, read, note);
}

/* scale: what the gain stands in place of; NULL: of orders of the cogging torque alone. */
static hci_status read_try(hci_search *s, hci_fitted_model *model, const hci_effect_type *scale, double gain,
                           bool *changed, hci_note *note)
{
    hci_fitted_model read = {0};
    hci_status status = read_make(s, model, scale, gain, &read, note);
    *changed = !status && read.fit.score < model->fit.score - HCI_DECISIVE;
    if (*changed) {
        hci_fitted_model_replace(model, &read);
        s->one_gain = true;
        status = hci_search_renew(s, model, note);
    }
    hci_fitted_model_release(&read);
    return status;
}

hci_status hci_search_torque_gain(hci_search *s, hci_fitted_model *model, bool *changed, hci_note *note)
{
    const hci_effect_type *scale;
    double gain;
    *changed = false;
    if (hci_candidates_have(&model->candidates, torque_gain())) return HCI_OK;
    hci_status status = scale_find(s, &model->candidates, &scale, &gain, note);
    if (status || !scale || !hci_modelled_gain(s->regression->machine, &model->candidates, gain))
        return status;
    status = read_try(s, model, scale, gain, changed, note);
    return status || *changed ? status : read_try(s, model, NULL, gain, changed, note);
}
