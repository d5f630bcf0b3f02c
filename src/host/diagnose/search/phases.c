#include "host/diagnose/search/phases.h"

#include <math.h>

#define ALIKE 0.2 /* of their mean, by which the gains of two sensors differ and are alike */
#define SURE  5.0 /* standard errors of a common part that is there */

/* A type of three values, one a phase, of the machine or of its sensors; NULL: none is known. */
static const hci_effect_type *type_of_phases(bool in_machine)
{
    size_t k = 0;
    const hci_effect_type *type;
    while ((type = hci_effect_type_at(k)) != NULL && !(type->when_equal && type->in_machine == in_machine))
        ++k;
    return type;
}

static hci_verdict *verdict_of(hci_attribution *a, const hci_effect_type *type)
{
    size_t k = 0;
    while (a->verdict[k].type != type)
        ++k;
    return &a->verdict[k];
}

static bool is_of_order_one(const hci_candidate *x)
{
    return x->count > 0 && fabs(x->term[0].order - 1.0) < HCI_ORDER_TOLERANCE;
}

/* Starts the alternative of a verdict with the model itself. */
static hci_status alternative_start(const hci_attribution *a, hci_verdict *v, hci_note *note)
{
    hci_fitted_model_release(&v->alternative);
    return hci_fitted_model_copy(&a->model, &v->alternative, note);
}

/* ---- sensors and phases at once ---- */

/* Without what the phases have: their gains, and a back-EMF of order 1 that is another one. */
static void phases_leave(hci_candidates *model, const hci_effect_type *phases)
{
    hci_candidates_remove_type(model, phases);
    for (size_t k = 0; k < model->count; ++k)
        if (model->candidate[k].type == phases->when_equal && is_of_order_one(&model->candidate[k]))
            model->candidate[k].in = false;
}

/* Whether a back-EMF of order 1 is in the model; unlike: one of phases that differ. */
static bool has_order_one(const hci_candidates *model, const hci_effect_type *type, bool unlike)
{
    for (size_t k = 0; k < model->count; ++k) {
        const hci_candidate *x = &model->candidate[k];
        if (!x->in || x->type != type || !is_of_order_one(x)) continue;
        if (!unlike || hci_candidate_is_unbalanced(type, x->term[0].parameter, 1.0)) return true;
    }
    return false;
}

static hci_status both_mark(hci_attribution *a, const hci_effect_type *sensors, const hci_effect_type *phases,
                            hci_note *note)
{
    hci_verdict *v = verdict_of(a, phases), *sensor = verdict_of(a, sensors);
    const hci_status status = alternative_start(a, sensor, note);
    if (status) return status;
    phases_leave(&sensor->alternative.candidates, phases);
    sensor->ambiguous = a->sensors_as_well = true;
    v->ambiguous = v->in;
    if (has_order_one(&a->model.candidates, phases->when_equal, false))
        verdict_of(a, phases->when_equal)->ambiguous = true;
    return HCI_OK;
}

/* ---- a common part of the sensors ---- */

/* Gains of the three sensors, 0 of those that are not in, and the largest standard error. */
static double gains_of(const hci_candidates *model, const hci_effect_type *sensors, double gain[3])
{
    double error = 0.0;
    for (size_t s = 0; s < 3; ++s)
        gain[s] = 0.0;
    for (size_t k = 0; k < model->count; ++k) {
        const hci_candidate *x = &model->candidate[k];
        for (size_t j = 0; x->in && x->type == sensors && j < x->count; ++j) {
            gain[x->term[j].parameter] = x->term[j].value;
            error = fmax(error, x->term[j].std_error);
        }
    }
    return error;
}

/* What the two that are most alike have in common; 0: nothing. */
static double common_of(const double gain[3], double error)
{
    size_t odd = 0;
    double least = INFINITY;
    for (size_t s = 0; s < 3; ++s) {
        const double apart = fabs(gain[(s + 1) % 3] - gain[(s + 2) % 3]);
        if (!(apart < least)) continue;
        least = apart;
        odd = s;
    }
    const double mean = 0.5 * (gain[(odd + 1) % 3] + gain[(odd + 2) % 3]);
    return least < ALIKE * fabs(mean) && fabs(mean) > SURE * error ? mean : 0.0;
}

static double declared_of(const hci_candidates *model, const hci_effect_type *type, size_t parameter)
{
    for (size_t k = 0; k < model->count; ++k)
        for (size_t j = 0; model->candidate[k].type == type && j < model->candidate[k].count; ++j)
            if (model->candidate[k].term[j].parameter == parameter) return model->candidate[k].declared[j];
    return 0.0;
}

/* The machine whose sensors do not have it: all phases are by so much less. */
static hci_status common_move(hci_candidates *model, const hci_effect_type *sensors,
                              const hci_effect_type *phases, double common, hci_note *note)
{
    hci_candidate alike = {.type = phases, .count = 3, .in = true};
    for (size_t s = 0; s < 3; ++s) {
        alike.declared[s] = declared_of(model, phases, s);
        alike.term[s] = (hci_effect_term){s, 0.0, (1.0 + alike.declared[s]) / (1.0 + common) - 1.0, NAN};
    }
    for (size_t k = 0; k < model->count; ++k)
        for (size_t j = 0; model->candidate[k].type == sensors && j < model->candidate[k].count; ++j) {
            hci_effect_term *term = &model->candidate[k].term[j];
            term->value = (1.0 + term->value) / (1.0 + common) - 1.0;
        }
    hci_candidates_remove_type(model, phases);
    return hci_candidates_add(model, &alike, note);
}

static hci_status common_mark(hci_attribution *a, const hci_effect_type *sensors,
                              const hci_effect_type *phases, hci_note *note)
{
    double gain[3];
    const double error = gains_of(&a->model.candidates, sensors, gain), common = common_of(gain, error);
    hci_verdict *v = verdict_of(a, sensors), *magnets = verdict_of(a, sensors->when_equal);
    if (!(fabs(common) > 0.0)) return HCI_OK;
    hci_status status = alternative_start(a, v, note);
    if (!status) status = common_move(&v->alternative.candidates, sensors, phases, common, note);
    if (status) return status;
    if (!magnets->in && !magnets->rival_of) {
        magnets->rival_of = sensors;
        magnets->gain = v->gain;
    }
    v->ambiguous = magnets->ambiguous = true;
    return HCI_OK;
}

hci_status hci_search_phases_mark(hci_attribution *a, hci_note *note)
{
    const hci_effect_type *sensors = type_of_phases(false), *phases = type_of_phases(true);
    if (!sensors || !phases || !hci_candidates_have(&a->model.candidates, sensors)) return HCI_OK;
    if (hci_candidates_have(&a->model.candidates, phases) ||
        has_order_one(&a->model.candidates, phases->when_equal, true))
        return both_mark(a, sensors, phases, note);
    if (verdict_of(a, sensors)->ambiguous) return HCI_OK; /* all three are alike, or something else */
    return common_mark(a, sensors, phases, note);
}
