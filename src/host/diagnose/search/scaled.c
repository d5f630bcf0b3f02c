#include "host/diagnose/search/scaled.h"

#include <math.h>

#define UNTOUCHED 1.5 /* an effect this much larger than what may be something else stands beside it */

/* Sums over a segment: of its samples, of a torque and of its square. */
typedef struct {
    double count, sum, square;
} moments;

static void moments_add(moments *m, double torque_Nm)
{
    m->count += 1.0;
    m->sum += torque_Nm;
    m->square += torque_Nm * torque_Nm;
}

static double mean_square(const moments *m)
{
    return m->count > 0.0 ? m->sum * m->sum / m->count : 0.0;
}

static double share_of_means(const hci_search *s)
{
    double left = 0.0, all = 0.0;
    for (const hci_segment *x = NULL; (x = hci_regression_next(s->regression, x)) != NULL;) {
        moments residual = {0.0, 0.0, 0.0}, torque = {0.0, 0.0, 0.0};
        for (size_t j = x->first; j < x->first + x->count; ++j) {
            const hci_binned_sample *b = &s->regression->samples->sample[j];
            if (!(b->count > 0.0)) continue;
            moments_add(&residual, s->residual_Nm[j]);
            moments_add(&torque, b->torque_Nm);
        }
        left += mean_square(&residual);
        all += mean_square(&torque);
    }
    return all > 0.0 ? sqrt(left / all) : 0.0;
}

hci_status hci_search_mean_share(hci_search *s, const hci_candidates *model, double *share, hci_note *note)
{
    const bool free_means = s->regression->free_means;
    s->regression->free_means = false;
    const hci_status status = hci_search_residual(s, model, note);
    s->regression->free_means = free_means;
    *share = status ? 0.0 : share_of_means(s);
    return status;
}

/* The modelled torque of the runs in use, rms, from the residual of the search; about the means where these
 * are free. */
static double torque_rms(const hci_search *s)
{
    double square = 0.0, count = 0.0;
    for (const hci_segment *x = NULL; (x = hci_regression_next(s->regression, x)) != NULL;) {
        moments m = {0.0, 0.0, 0.0};
        for (size_t j = x->first; j < x->first + x->count; ++j) {
            const hci_binned_sample *b = &s->regression->samples->sample[j];
            if (b->count > 0.0) moments_add(&m, b->torque_Nm - s->residual_Nm[j]);
        }
        square += m.square - (s->regression->free_means ? mean_square(&m) : 0.0);
        count += m.count;
    }
    return count > 0.0 ? sqrt(fmax(0.0, square / count)) : 0.0;
}

static hci_status leave_below(hci_search *s, hci_fitted_model *model, const hci_effect_type *type,
                              double most_Nm, hci_note *note)
{
    double explained_Nm;
    if (!hci_candidates_have(&model->candidates, type)) return HCI_OK;
    const hci_status status = hci_search_explained_by(s, model, type, &explained_Nm, note);
    if (status || explained_Nm > most_Nm) return status;
    hci_candidates_remove_type(&model->candidates, type);
    return hci_search_renew(s, model, note);
}

hci_status hci_search_scaled_leave(hci_search *s, hci_fitted_model *model, double share, hci_note *note)
{
    hci_status status = hci_search_residual(s, &model->candidates, note);
    const double most_Nm = UNTOUCHED * share * torque_rms(s);
    for (size_t r = 0; hci_effect_type_at(r) && !status; ++r)
        status = leave_below(s, model, hci_effect_type_at(r), most_Nm, note);
    return status;
}
