#include "host/diagnose/search/no_load.h"

#include <math.h>

#include "host/diagnose/candidates/empirical_term.h"
#include "host/diagnose/candidates/slip.h"
#include "host/diagnose/search/backward.h"
#include "host/diagnose/search/belief.h"
#include "host/diagnose/search/noise_left.h"
#include "host/diagnose/search/rivals.h"
#include "host/diagnose/search/rounds.h"
#include "host/diagnose/search/stability.h"

#define LITTLE 0.01 /* of the largest current, that is none */
#define ALONE  0.95 /* correlation of a torque that hardly depends on anything else */
#define NEARLY 0.5  /* about -1, by which effects may change a torque that has the opposite sign */

/* ---- which runs ---- */

static double largest_A(const hci_regression *e)
{
    double most = 0.0;
    for (size_t r = 0; r < e->samples->run_count; ++r)
        if (e->use[r] && e->samples->statistics[r].current_A > most)
            most = e->samples->statistics[r].current_A;
    return most;
}

/* Runs in use, of a sensor of torque, whose current is none. Returns how many. */
static size_t runs_find(const hci_regression *e, bool *use)
{
    const double least_A = LITTLE * largest_A(e);
    size_t count = 0;
    for (size_t r = 0; r < e->samples->run_count; ++r) {
        use[r] = e->use[r] && e->runs[r].torque_source == HCI_TORQUE_MEASURED &&
                 e->samples->statistics[r].current_A < least_A;
        count += use[r];
    }
    return count;
}

/* ---- the torque of the others ---- */

/* Sums over samples of the measured torque and of that of the machine. */
typedef struct {
    double count, x, y, xx, xy, yy;
} moments;

static void moments_add(const hci_search *s, const hci_segment *x, moments *m)
{
    for (size_t j = x->first; j < x->first + x->count; ++j) {
        const double measured = s->regression->samples->sample[j].torque_Nm;
        const double machine = measured - s->residual_Nm[j];
        m->count += 1.0;
        m->x += machine;
        m->y += measured;
        m->xx += machine * machine;
        m->xy += machine * measured;
        m->yy += measured * measured;
    }
}

/* The measured torque against that of the machine: by how much it rises with it, where it hardly depends on
 * anything else; else 1. */
static double slope_of(const moments *m)
{
    const double xx = m->xx - m->x * m->x / m->count, yy = m->yy - m->y * m->y / m->count;
    const double xy = m->xy - m->x * m->y / m->count;
    return xx > 0.0 && xy * xy > ALONE * ALONE * xx * yy ? xy / xx : 1.0;
}

hci_status hci_search_opposite(hci_search *s, bool *opposite, hci_note *note)
{
    const hci_candidates none = {0};
    const double least_A = LITTLE * largest_A(s->regression);
    moments m = {0.0, 0.0, 0.0, 0.0, 0.0, 0.0};
    const hci_status status = hci_search_residual(s, &none, note);
    for (const hci_segment *x = NULL; !status && (x = hci_regression_next(s->regression, x)) != NULL;)
        if (s->regression->samples->statistics[x->run].current_A > least_A) moments_add(s, x, &m);
    *opposite = !status && m.count > 0.0 && fabs(slope_of(&m) + 1.0) < NEARLY;
    return status;
}

/* ---- their effects ---- */

/* Known effects that leave nothing but noise, and that each of the runs tells by itself. found: out. */
static hci_status effects_find(hci_search *s, hci_fitted_model *model, bool *found, hci_note *note)
{
    hci_status status = hci_search_rounds(s, model, note);
    *found = false;
    if (!status) status = hci_search_without_denied(s, model, note);
    if (!status) status = hci_search_keep_predictive(s, model, note);
    if (!status) status = hci_search_drop_unsure(s, model, note);
    if (!status) status = hci_search_keep_brakes(s, model, note);
    if (!status) status = hci_search_is_noise(s, &model->candidates, found, note);
    *found = *found && !hci_candidates_have(&model->candidates, &hci_empirical_type);
    return status;
}

/* Whether a term stands in the means of runs, as friction and the zero of a sensor do. */
static bool is_of_means(const hci_candidate *x)
{
    const hci_effect_parameter *p = &x->type->parameter[x->term[0].parameter];
    return !p->ordered && !(p->traits & HCI_PARAMETER_ALONG_TIME) && !x->type->sum_by_value;
}

/* As many values as runs describe their means whatever they are: those prove nothing. */
static void unproven_leave(const hci_regression *e, hci_candidates *shown)
{
    size_t values = 0;
    for (size_t k = 0; k < shown->count; ++k)
        if (shown->candidate[k].in && is_of_means(&shown->candidate[k])) values += shown->candidate[k].count;
    if (values < hci_regression_runs_in_use(e)) return;
    for (size_t k = 0; k < shown->count; ++k)
        if (shown->candidate[k].in && is_of_means(&shown->candidate[k]))
            hci_candidates_remove_type(shown, shown->candidate[k].type);
}

/* What they do not tell from another effect, such as friction on ramps from the torque that accelerates the
 * rotor, is left to all runs. */
static hci_status untold_leave(hci_search *s, hci_fitted_model *model, hci_note *note)
{
    bool told[HCI_MOST_TYPES] = {false};
    hci_status status = hci_search_renew(s, model, note); /* judging has found the noise anew */
    for (size_t r = 0; r < hci_candidate_types() && !status; ++r)
        if (hci_candidates_have(&model->candidates, hci_candidate_type(r)))
            status = hci_search_is_told(s, model, hci_candidate_type(r), &told[r], note);
    for (size_t r = 0; r < hci_candidate_types() && !status; ++r)
        if (!told[r]) hci_candidates_remove_type(&model->candidates, hci_candidate_type(r));
    return status;
}

/* What an angle that is read wrong makes for the most part, of a torque that is declared, is certain only as
 * long as all runs are understood. */
static hci_status by_angle_find(hci_search *s, hci_attribution *a, hci_note *note)
{
    hci_status status = HCI_OK;
    for (size_t r = 0; r < hci_candidate_types() && !status; ++r)
        if (hci_candidate_type(r)->in_machine &&
            hci_candidates_have(&a->model.candidates, hci_candidate_type(r)))
            status = hci_search_is_of_angle(s, &a->model, hci_candidate_type(r), &a->by_angle[r], note);
    return status;
}

static void by_angle_leave(hci_attribution *a)
{
    for (size_t r = 0; r < hci_candidate_types(); ++r)
        if (a->by_angle[r]) hci_candidates_remove_type(&a->no_load.candidates, hci_candidate_type(r));
}

static hci_status of_runs(hci_search *s, hci_attribution *a, hci_note *note)
{
    bool found = false;
    s->no_current = true;
    hci_status status = effects_find(s, &a->model, &found, note);
    if (!status && found) status = untold_leave(s, &a->model, note);
    if (!status && found) status = by_angle_find(s, a, note);
    s->no_current = false;
    if (!status && found) {
        unproven_leave(s->regression, &a->model.candidates);
        a->slip = hci_slip_of_cogging(s->regression->machine, &a->model.candidates, false);
        return hci_fitted_model_copy(&a->model, &a->no_load, note);
    }
    hci_fitted_model_release(&a->model);
    return status;
}

#define KEPT 0.5 /* of what the search may still take, for all runs */

/* What was not looked at to the end proves nothing, and all runs are looked at yet. */
static void unfinished_leave(hci_search *s, hci_attribution *a)
{
    s->kept_work = 0.0;
    if (s->ended != HCI_WORK_LIMITED) return;
    s->ended = HCI_WORK_COMPLETE;
    hci_fitted_model_release(&a->model);
    hci_fitted_model_release(&a->no_load);
    a->slip = NULL;
}

hci_status hci_search_no_load(hci_search *s, bool *use, hci_attribution *a, hci_note *note)
{
    hci_regression *e = s->regression;
    const bool *all = e->use;
    hci_status status = HCI_OK;
    if (runs_find(e, use) == 0) return HCI_OK;
    e->use = use;
    if (e->work) s->kept_work = KEPT * fmax(0.0, HCI_MOST_WORK - *e->work);
    status = of_runs(s, a, note);
    if (!status) unfinished_leave(s, a);
    e->use = all;
    return status;
}

/* ---- where something is not known ---- */

/* Whether a model has a known type that another one lacks. */
static bool has_more(const hci_candidates *model, const hci_candidates *than)
{
    for (size_t r = 0; hci_effect_type_at(r); ++r)
        if (hci_candidates_have(model, hci_effect_type_at(r)) &&
            !hci_candidates_have(than, hci_effect_type_at(r)))
            return true;
    return false;
}

/* Adds the types that have left, with their values. */
static hci_status lost_add(const hci_candidates *from, hci_candidates *to, hci_note *note)
{
    hci_candidates lacking = {0};
    hci_status status = hci_candidates_copy(from, &lacking, note);
    for (size_t r = 0; r < hci_candidate_types(); ++r)
        if (hci_candidates_have(to, hci_candidate_type(r)))
            hci_candidates_remove_type(&lacking, hci_candidate_type(r));
    for (size_t k = 0; k < lacking.count && !status; ++k)
        if (lacking.candidate[k].in) status = hci_candidates_add(to, &lacking.candidate[k], note);
    hci_candidates_release(&lacking);
    return status;
}

/* The model is that of the runs without a current; what it leaves of all is not known. */
static hci_status model_replace(hci_search *s, hci_attribution *a, hci_note *note)
{
    hci_fitted_model copy = {0};
    hci_status status = hci_fitted_model_copy(&a->no_load, &copy, note);
    if (status) return status;
    hci_fitted_model_replace(&a->model, &copy);
    s->regression->free_means = false;
    status = hci_search_noise(s, &a->model.candidates, note);
    if (!status) status = hci_search_residual(s, &a->model.candidates, note);
    const double left_Nm = hci_search_residual_rms(s), noise_Nm = hci_search_noise_rms(s);
    a->unexplained_Nm = sqrt(fmax(0.0, left_Nm * left_Nm - noise_Nm * noise_Nm));
    a->no_load_alone = !status && hci_candidates_types_in(&a->model.candidates) > 0;
    return status;
}

/* Where an angle or a sign is not what is meant by it, the motor another one, or the torque read through what
 * swings, the means alone tell. */
static hci_status means_stay(hci_search *s, hci_attribution *a, hci_note *note)
{
    hci_candidates *shown = &a->no_load.candidates;
    for (size_t k = 0; k < shown->count; ++k)
        shown->candidate[k].in = shown->candidate[k].in && is_of_means(&shown->candidate[k]);
    const hci_status status = model_replace(s, a, note);
    return status ? status : hci_search_renew(s, &a->model, note);
}

/* Whether a sensor that swings is in a model: all that is read goes through it, so that where something is
 * not known under load it is not certain that it is the sensor. */
static bool swings(const hci_candidates *model)
{
    for (size_t k = 0; k < model->count; ++k) {
        const hci_candidate *x = &model->candidate[k];
        for (size_t j = 0; x->in && x->type->resonance && j < x->count; ++j)
            if (x->term[j].parameter == x->type->resonance[0]) return true;
    }
    return false;
}

hci_status hci_search_no_load_stays(hci_search *s, hci_attribution *a, hci_note *note)
{
    const hci_candidates *shown = &a->no_load.candidates;
    if (a->slip || swings(shown)) return means_stay(s, a, note);
    by_angle_leave(a);
    if (hci_candidates_types_in(shown) == 0) return HCI_OK;
    if (!has_more(&a->model.candidates, shown)) return model_replace(s, a, note);
    if (!has_more(shown, &a->model.candidates)) return HCI_OK;
    const hci_status status = lost_add(shown, &a->model.candidates, note);
    return status ? status : hci_search_renew(s, &a->model, note);
}
