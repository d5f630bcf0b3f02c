#include "host/diagnose/fit/cancelling.h"

#include <math.h>

#include "hci/host/waveform/load_curve.h"
#include "host/base/memory.h"
#include "host/diagnose/fit/linearise.h"
#include "host/diagnose/fit/model.h"

#define LEFT 0.0625 /* of the squares of what terms make, that is left of their sum where they cancel */

static bool is_asked(const hci_candidates *candidates, const hci_effect_type *type)
{
    return type->in_machine && !type->is_series && hci_candidates_have(candidates, type) &&
           !hci_candidates_are_of_whole(candidates, type);
}

/* By how much a linear term is away from its declared value; 0 of another one, and of one of another type. */
static double departure_of(const hci_model_column *c, const hci_effect_type *type)
{
    const hci_candidate *x = c->candidate;
    const unsigned traits = x->type->parameter[x->term[c->term].parameter].traits;
    return x->type == type && (traits & HCI_PARAMETER_LINEAR) ? hci_candidate_departure(x, c->term) : 0.0;
}

static bool cancels(const hci_model *m, const hci_normal_equations *normal, const hci_effect_type *type)
{
    double together = 0.0, apart = 0.0;
    for (size_t i = 0; i < m->columns; ++i) {
        const double a = departure_of(&m->column[i], type);
        if (a == 0.0) continue;
        apart += a * a * normal->gram[i * normal->n + i];
        for (size_t j = 0; j < m->columns; ++j)
            together += a * departure_of(&m->column[j], type) * normal->gram[i * normal->n + j];
    }
    return together < LEFT * apart;
}

#define LITTLE  0.05 /* of the largest current, that a run without a load has at most */
#define EVEN    0.9  /* of the current, that its mean is in a run with one load */
#define ALONG_D 0.15 /* of the current along q, that one along d is beside it */

/* The loads of the runs in use. Returns how many; 0 where one has no sensor of its torque, or no one current.
 * most_id: out, of i_q. */
static size_t loads_of(const hci_regression *e, hci_load *load, double *most_id)
{
    double most_A = 0.0;
    size_t count = 0;
    *most_id = 0.0;
    for (size_t r = 0; r < e->samples->run_count; ++r)
        if (e->use[r]) most_A = fmax(most_A, e->samples->statistics[r].current_A);
    for (size_t r = 0; r < e->samples->run_count; ++r) {
        const hci_run_statistics *x = &e->samples->statistics[r];
        if (!e->use[r] || x->current_A < LITTLE * most_A) continue;
        if (e->runs[r].torque_source != HCI_TORQUE_MEASURED || x->is_direct ||
            hypot(x->mean_id_A, x->mean_iq_A) < EVEN * x->current_A)
            return 0;
        *most_id = fmax(*most_id, fabs(x->mean_id_A) / fabs(x->mean_iq_A));
        load[count++] = (hci_load){x->mean_id_A, x->mean_iq_A, 0.0};
    }
    return count;
}

/* Along one curve with currents along d and q the six inductances of an order make two waves, and their
 * values are not told: that they cancel says nothing of these two. */
static hci_status are_told(const hci_regression *e, bool *told, hci_note *note)
{
    double most_id = 0.0;
    hci_load *load = hci_memory_new(e->samples->run_count + 1, sizeof *load);
    if (!load) return hci_note_memory(note, NULL, "the loads of the recordings");
    const size_t count = loads_of(e, load, &most_id);
    *told = !(most_id > ALONG_D && hci_loads_are_on_curve(load, count));
    hci_memory_free(load);
    return HCI_OK;
}

hci_status hci_cancelling_find(const hci_regression *e, const hci_candidates *candidates,
                               const hci_effect_type **type, hci_note *note)
{
    hci_model model;
    hci_normal_equations normal;
    bool told = false;
    *type = NULL;
    hci_status status = are_told(e, &told, note);
    if (status || !told) return status;
    status = hci_regression_normal(e, candidates, false, &normal, note);
    if (status) return status;
    status = hci_model_make(e->declared, candidates, false, &model, note);
    for (size_t r = 0; r < hci_candidate_types() && !status && !*type; ++r)
        if (is_asked(candidates, hci_candidate_type(r)) && cancels(&model, &normal, hci_candidate_type(r)))
            *type = hci_candidate_type(r);
    if (!status) hci_model_release(&model);
    hci_normal_equations_release(&normal);
    return status;
}
