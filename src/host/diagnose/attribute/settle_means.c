#include "host/diagnose/attribute/settle_means.h"

#include <math.h>

#include "host/diagnose/candidates/empirical_term.h"
#include "host/diagnose/fit/unlike_iron.h"
#include "host/diagnose/search/backward.h"
#include "host/diagnose/search/belief.h"
#include "host/diagnose/search/brakes.h"
#include "host/diagnose/search/coenergy.h"
#include "host/diagnose/search/forward.h"
#include "host/diagnose/search/noise_left.h"
#include "host/diagnose/search/scaled.h"
#include "host/diagnose/search/stability.h"

#define BESIDE_MEANS 0.1  /* of the square of what is left, that may be ripple beside means alone */
#define UNPREDICTED  0.04 /* of what effects explain, that they leave in runs left out: a fifth of it */
#define PART_OF_IT   0.02 /* the same, of iron beside something unknown: a seventh of the error */
#define MOSTLY       0.25 /* the same, of effects that are there and not all */
#define AS_BADLY     0.5  /* of that, by the ripple alone: then it is not the means */

/* ---- what stands in the ripple alone ---- */

/* Takes a type out that explains nothing once the means count: what little ripple it describes makes values
 * of it that the means forbid. */
static hci_status forbidden_leaves(hci_search *s, hci_candidates *model, const hci_effect_type *type,
                                   hci_note *note)
{
    hci_candidates without = {0};
    double explained_Nm = 0.0;
    if (!hci_candidates_have(model, type)) return HCI_OK;
    hci_status status = hci_candidates_copy(model, &without, note);
    if (!status) hci_candidates_remove_type(&without, type);
    if (!status) status = hci_search_explained(s, model, &without, &explained_Nm, note);
    hci_candidates_release(&without);
    if (!status && !(explained_Nm > 0.0)) hci_candidates_remove_type(model, type);
    return status;
}

/* Takes all out where the ripple of runs left out is not described either. */
static hci_status unpredicted_leave(hci_search *s, hci_candidates *model, hci_note *note)
{
    double share = 0.0;
    const hci_status status = hci_search_unpredicted(s, model, &share, note);
    for (size_t r = 0; !status && share > UNPREDICTED && r < hci_candidate_types(); ++r)
        hci_candidates_remove_type(model, hci_candidate_type(r));
    return status;
}

/* Whether a candidate makes mean torque alone at currents and speeds that do not vary: order 1 of the
 * back-EMF, order 0 of an inductance, friction, the zero of a torque sensor. */
static bool makes_mean(const hci_candidate *x)
{
    size_t zero;
    bool all = x->type->propose_coenergy != NULL;
    if (x->type->coulomb_Nm || x->type->drag_Nm) return true;
    if (x->type == hci_sensor_zero(&zero) && x->term[0].parameter == zero) return true;
    for (size_t j = 0; j < x->count; ++j)
        all = all && x->term[j].order <= 1.0 + HCI_ORDER_TOLERANCE;
    return all;
}

/* What the ripple does not tell takes any value that suits. */
static void mean_terms_leave(hci_candidates *model)
{
    for (size_t k = 0; k < model->count; ++k)
        if (model->candidate[k].in && makes_mean(&model->candidate[k])) model->candidate[k].in = false;
}

/* Keeps what stands in the ripple alone. What is left of the means then, more than noise, is not known. */
static hci_status means_leave(hci_search *s, hci_attribution *a, hci_note *note)
{
    hci_candidates *model = &a->model.candidates;
    s->regression->free_means = true;
    hci_candidates_remove_type(model, &hci_empirical_type);
    mean_terms_leave(model);
    hci_status status = hci_search_renew(s, &a->model, note);
    if (!status) status = hci_search_keep_predictive(s, &a->model, note);
    if (!status) status = unpredicted_leave(s, model, note);
    if (!status) status = hci_search_keep_believed(s, &a->model, note);
    if (!status) status = hci_search_keep_brakes(s, &a->model, note);
    const double noise_Nm = hci_search_noise_rms(s);
    s->regression->free_means = false;
    for (size_t r = 0; r < a->types && !status; ++r)
        status = forbidden_leaves(s, model, hci_candidate_type(r), note);
    if (!status) status = hci_search_residual(s, model, note);
    const double left_Nm = hci_search_residual_rms(s);
    if (status || !(left_Nm > noise_Nm)) return status; /* noise alone: there is nothing to describe */
    s->regression->free_means = true;
    if (!status) status = hci_search_residual(s, model, note);
    const double ripple_Nm = hci_search_residual_rms(s);
    a->means_open = a->unknown = true;
    a->means_alone = ripple_Nm * ripple_Nm - noise_Nm * noise_Nm <
                     BESIDE_MEANS * (left_Nm * left_Nm - noise_Nm * noise_Nm);
    a->unexplained_Nm = sqrt(fmax(0.0, left_Nm * left_Nm - noise_Nm * noise_Nm));
    return status;
}

/* Whether runs left out are described for the most part, and their means no worse than their ripple, by iron
 * that saturates, of which a series in the currents is never all. share: of all. */
static hci_status is_of_ripple(hci_search *s, const hci_candidates *model, double share, bool *of_ripple,
                               hci_note *note)
{
    double ripple = 0.0;
    *of_ripple = false;
    if (!hci_search_saturates(model)) return HCI_OK;
    s->regression->free_means = true;
    const hci_status status = hci_search_unpredicted(s, model, &ripple, note);
    s->regression->free_means = false;
    *of_ripple = !status && share < MOSTLY && ripple < MOSTLY && ripple > AS_BADLY * share;
    return status;
}

/* A whole co-energy was chosen by runs left out, and may leave more of them, of runs at the ends of what was
 * measured. */
static bool is_unpredicted(const hci_search *s, double share)
{
    return share > (s->whole_coenergy ? MOSTLY : UNPREDICTED);
}

/* Goes back to single terms where these say of runs left out what the whole co-energy does not. unpredicted:
 * in and out. */
static hci_status single_try(hci_search *s, hci_fitted_model *model, bool *unpredicted, hci_note *note)
{
    double share = 0.0;
    if (!s->whole_coenergy || hci_candidates_types_in(&s->single.candidates) == 0) return HCI_OK;
    s->whole_coenergy = false;
    hci_status status = hci_search_renew(s, &s->single, note);
    if (!status) status = hci_search_unpredicted(s, &s->single.candidates, &share, note);
    if (!status && !is_unpredicted(s, share)) {
        hci_fitted_model_replace(model, &s->single);
        *unpredicted = false;
        return hci_search_drop_unsure(s, model, note);
    }
    return status ? status : hci_search_renew(s, model, note);
}

static bool breaks_mirror(const hci_search *s, const hci_candidates *model)
{
    for (size_t k = 0; k < model->count; ++k)
        if (hci_mirror_is_broken(s->regression, model, k)) return true;
    return false;
}

/* And where the means of the whole keep their sign with the load, as no iron's do, and those of the single
 * terms turn it. */
hci_status hci_settle_mirror(hci_search *s, hci_fitted_model *model, hci_note *note)
{
    if (!s->whole_coenergy || hci_candidates_types_in(&s->single.candidates) == 0) return HCI_OK;
    if (!breaks_mirror(s, &model->candidates) || breaks_mirror(s, &s->single.candidates)) return HCI_OK;
    s->whole_coenergy = false;
    hci_fitted_model_replace(model, &s->single);
    const hci_status status = hci_search_renew(s, model, note);
    return status ? status : hci_search_drop_unsure(s, model, note);
}

/* ---- what runs left out say ---- */

/* A few numbers for as many runs describe the mean of each whatever it is, such as a zero that is
 * another one each time: effects that explain the runs but not those left out are none. unpredicted: out,
 * they are some, and something else is missing. */
hci_status hci_settle_means(hci_search *s, hci_attribution *a, bool *unpredicted, hci_note *note)
{
    double share = 0.0;
    hci_status status = hci_search_unpredicted(s, &a->model.candidates, &share, note);
    bool missed = !status && is_unpredicted(s, share);
    if (missed) status = single_try(s, &a->model, &missed, note);
    if (status || !missed) return status;
    s->whole_coenergy = false;
    status = is_of_ripple(s, &a->model.candidates, share, unpredicted, note);
    return status || *unpredicted ? status : means_leave(s, a, note);
}

/* The score of a model whose iron does not saturate, nor has anything unknown, and in which the mean of each
 * run is another one. */
static hci_status score_of_means(hci_search *s, const hci_fitted_model *model, double *score, hci_note *note)
{
    hci_fitted_model plain = {0};
    hci_status status = hci_fitted_model_copy(model, &plain, note);
    for (size_t r = 0; r < hci_candidate_types() && !status; ++r)
        if (hci_candidate_type(r)->beyond_quadratic || hci_candidate_type(r) == &hci_empirical_type)
            hci_candidates_remove_type(&plain.candidates, hci_candidate_type(r));
    s->regression->free_means = true;
    if (!status) status = hci_search_fit(s, &plain, note);
    s->regression->free_means = false;
    *score =
        plain.fit.score + (double)hci_regression_runs_in_use(s->regression) * log(fmax(2.0, model->fit.rows));
    hci_fitted_model_release(&plain);
    return status;
}

/* What the means have to be better than. A whole co-energy was chosen by runs left out, and not by this
 * score: then the single terms in its place count, where they are better. */
static hci_status score_of_iron(hci_search *s, const hci_fitted_model *model, double *score, hci_note *note)
{
    *score = model->fit.score;
    if (!s->whole_coenergy || hci_candidates_types_in(&s->single.candidates) == 0) return HCI_OK;
    const hci_status status = hci_regression_fit(s->regression, &s->single.candidates, &s->single.fit, note);
    *score = fmin(*score, s->single.fit.score);
    return status;
}

/* Iron that saturates, beside what is no noise, is a part of that where it is wrong by more than a seventh in
 * runs left out, and a mean of each run that is another one, whatever makes it, describes the recordings
 * better: so do magnets whose temperature nobody wrote down. */
static hci_status are_means_better(hci_search *s, const hci_attribution *a, bool *better, hci_note *note)
{
    const hci_fitted_model *model = &a->model;
    double share = 0.0, score = INFINITY, iron = 0.0;
    bool all = false;
    *better = false;
    if (!hci_search_saturates(&model->candidates)) return HCI_OK;
    hci_status status = HCI_OK;
    if (!a->unknown) status = hci_search_is_noise(s, &model->candidates, &all, note);
    if (!status && !all) status = hci_search_unpredicted(s, &model->candidates, &share, note);
    if (!status && share > PART_OF_IT) status = score_of_means(s, model, &score, note);
    if (!status && share > PART_OF_IT) status = score_of_iron(s, model, &iron, note);
    *better = !status && score + HCI_DECISIVE < iron;
    return status;
}

hci_status hci_settle_saturation(hci_search *s, hci_attribution *a, hci_note *note)
{
    bool better = false;
    hci_status status = a->means_open ? HCI_OK : are_means_better(s, a, &better, note);
    if (status || !better) return status;
    s->whole_coenergy = false;
    status = means_leave(s, a, note);
    return status ? status : hci_search_renew(s, &a->model, note);
}

/* Of the ripple, that effects leave which describe it. */
#define OF_RIPPLE 0.3

/* The ripple of all runs that a model leaves, whatever their means are. */
static hci_status ripple_left(hci_search *s, hci_fitted_model *model, double *left_Nm, hci_note *note)
{
    hci_status status = hci_regression_fit(s->regression, &model->candidates, &model->fit, note);
    if (!status) status = hci_search_residual(s, &model->candidates, note);
    *left_Nm = status ? 0.0 : hci_search_ripple_rms(s);
    return status;
}

/* Whether a model, which has lost what was not believed, describes the ripple all the same. */
static hci_status is_ripple_known(hci_search *s, hci_fitted_model *model, bool *known, hci_note *note)
{
    hci_fitted_model none = {0};
    double before_Nm = 0.0, after_Nm = 0.0;
    s->regression->free_means = true;
    hci_status status = ripple_left(s, &none, &before_Nm, note);
    if (!status) status = ripple_left(s, model, &after_Nm, note);
    s->regression->free_means = false;
    *known = !status && after_Nm < OF_RIPPLE * before_Nm;
    return status;
}

/* Of the mean torques, by which the declared machine may be off and is the one that was recorded. */
#define ABOUT 0.5

static hci_status are_means_about(hci_search *s, bool *about, hci_note *note)
{
    static const hci_candidates none = {0};
    double share = 0.0;
    const hci_status status = hci_search_mean_share(s, &none, &share, note);
    *about = !status && share < ABOUT;
    return status;
}

/* Of the largest current, that is a load, and by which two loads are one. */
#define LOADED    0.1
#define LIKE_LOAD 0.8

static bool is_one_load(const hci_search *s)
{
    double least_A = INFINITY, most_A = 0.0;
    for (int pass = 0; pass < 2; ++pass)
        for (size_t r = 0; r < s->regression->samples->run_count; ++r) {
            const hci_run_statistics *x = &s->regression->samples->statistics[r];
            const double i_A = hypot(x->mean_id_A, x->mean_iq_A);
            if (!s->regression->use[r]) continue;
            most_A = fmax(most_A, i_A);
            if (pass > 0 && i_A > LOADED * most_A) least_A = fmin(least_A, i_A);
        }
    return least_A > LIKE_LOAD * most_A;
}

/* Whether the ripple of a parameter grows faster than the current. */
static bool is_of_squares(const hci_effect_type *type, size_t parameter)
{
    const unsigned traits = type->parameter[parameter].traits;
    return type->beyond_quadratic || (type->propose_coenergy && (traits & HCI_PARAMETER_WITH_CURRENT) &&
                                      !(traits & HCI_PARAMETER_WITH_LOAD));
}

/* left: out, whether any does. */
static void squares_leave(hci_candidates *model, bool *left)
{
    *left = false;
    for (size_t k = 0; k < model->count; ++k) {
        hci_candidate *x = &model->candidate[k];
        if (!x->in || !is_of_squares(x->type, x->term[0].parameter)) continue;
        x->in = false;
        *left = true;
    }
}

enum { MOST_INSTEAD = 8 };

/* What makes the ripple that these made, at means that are free. */
static hci_status others_come(hci_search *s, hci_fitted_model *model, hci_note *note)
{
    bool denied[HCI_MOST_TYPES] = {false}, added = true;
    for (size_t r = 0; hci_effect_type_at(r); ++r)
        denied[r] = is_of_squares(hci_effect_type_at(r), 0);
    s->denied = denied;
    s->regression->free_means = true;
    hci_status status = hci_search_renew(s, model, note);
    for (int k = 0; k < MOST_INSTEAD && added && !status && !hci_search_is_over(s); ++k)
        status = hci_search_forward(s, model, &added, note);
    s->regression->free_means = false;
    s->denied = NULL;
    return status;
}

/* At one load a ripple is that of the magnets, or cogging torque, at any other, too, as far as is known. */
static hci_status one_load_take(hci_search *s, hci_fitted_model *model, hci_note *note)
{
    bool left = false;
    if (is_one_load(s)) squares_leave(&model->candidates, &left);
    return left ? others_come(s, model, note) : HCI_OK;
}

/* Where settling took effects out for the sake of means that nothing explains, those that describe the ripple
 * stay; not of another machine. before: the model that was settled; what is left in it is of no use. */
hci_status hci_settle_ripple(hci_search *s, hci_attribution *a, hci_fitted_model *before, hci_note *note)
{
    bool known = false, about = false;
    if (!a->unknown || a->means_open || s->ended == HCI_WORK_INTERRUPTED ||
        hci_candidates_types_in(&a->model.candidates) >= hci_candidates_types_in(&before->candidates))
        return HCI_OK;
    hci_candidates_remove_type(&before->candidates, &hci_empirical_type);
    mean_terms_leave(&before->candidates);
    hci_status status = are_means_about(s, &about, note);
    if (!status && about) status = one_load_take(s, before, note);
    mean_terms_leave(&before->candidates);
    if (!status && about) status = is_ripple_known(s, before, &known, note);
    if (status || !known) return status;
    hci_fitted_model_replace(&a->model, before);
    s->whole_coenergy = false;
    return means_leave(s, a, note);
}
