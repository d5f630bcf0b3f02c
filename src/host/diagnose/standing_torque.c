#include "host/diagnose/standing_torque.h"

#include <math.h>

#include "hci/math/harmonic.h"
#include "host/diagnose/fit/fit.h"
#include "host/diagnose/fit/model.h"
#include "host/diagnose/search/search.h"
#include "host/machine/torque_constant.h"

/* ---- what stands in a mean */

enum { ZERO, FRICTION, SALIENCY, TORQUE_PER_AMPERE, KINDS };

static const char *const NAME[KINDS] = {"the zero of the torque sensor", "the friction",
                                        "a reluctance torque that is not declared",
                                        "another torque per ampere"};

static const double ORDER[KINDS] = {[TORQUE_PER_AMPERE] = 1.0};

/* One term of an effect. */
typedef struct {
    const hci_effect_type *type; /* NULL: there is no such effect */
    size_t parameter;
} standing;

static bool is_zero(const hci_effect_type *type, size_t k)
{
    size_t parameter;
    return type == hci_sensor_zero(&parameter) && k == parameter;
}

static bool is_coulomb(const hci_effect_type *type, size_t k)
{
    return k == 0 && type->coulomb_Nm && type->propose_alike;
}

/* Of an inductance the first value that has an order 0: beside that of L_d the one of L_q makes no other
 * torque. */
static bool is_saliency(const hci_effect_type *type, size_t k)
{
    const unsigned traits = type->parameter[k].traits;
    return type->propose_coenergy && !type->beyond_quadratic && (traits & HCI_PARAMETER_WITH_CURRENT) &&
           !(traits & HCI_PARAMETER_WITH_LOAD) && !(type->parameter[k].least_order > 0.0);
}

static bool is_of_magnets(const hci_effect_type *type, size_t k)
{
    size_t parameter;
    return type == hci_torque_per_ampere(&parameter) && k == parameter;
}

static standing standing_of(int kind)
{
    static bool (*const IS[KINDS])(const hci_effect_type *, size_t) = {is_zero, is_coulomb, is_saliency,
                                                                       is_of_magnets};
    for (size_t t = 0; t < hci_candidate_types(); ++t)
        for (size_t k = 0; k < hci_candidate_type(t)->parameter_count; ++k)
            if (IS[kind](hci_candidate_type(t), k)) return (standing){hci_candidate_type(t), k};
    return (standing){NULL, 0};
}

/* The candidate of the model that is this term alone; NULL: none. */
static hci_candidate *find(const hci_candidates *model, int kind)
{
    const standing x = standing_of(kind);
    for (size_t k = 0; k < model->count; ++k) {
        hci_candidate *c = &model->candidate[k];
        if (c->in && c->type == x.type && c->count == 1 && c->term[0].parameter == x.parameter &&
            fabs(c->term[0].order - ORDER[kind]) <= HCI_ORDER_TOLERANCE)
            return c;
    }
    return NULL;
}

/* Whether the model, or the machine as it is declared, has it, or more of the kind. */
static bool has(const hci_regression *e, const hci_candidates *model, int kind)
{
    if (kind == ZERO || kind == TORQUE_PER_AMPERE) return find(model, kind) != NULL;
    if (kind == SALIENCY && e->machine->slope_count > 0) return true;
    return hci_candidates_have(model, standing_of(kind).type);
}

/* ---- one in the place of another */

static hci_status add(hci_candidates *model, int kind, hci_note *note)
{
    const standing x = standing_of(kind);
    const hci_candidate more = {
        .type = x.type, .term = {{.parameter = x.parameter, .order = ORDER[kind]}}, .count = 1, .in = true};
    return find(model, kind) ? HCI_OK : hci_candidates_add(model, &more, note);
}

typedef struct {
    const hci_regression *regression;
    hci_attribution *a;
    int out, in; /* kinds */
    hci_fitted_model other;
} exchange;

/* Beside it the torque per ampere is another one, too, unless that is what goes. */
static hci_status fit_other(exchange *x, hci_note *note)
{
    hci_candidates *other = &x->other.candidates;
    hci_status status = hci_fitted_model_copy(&x->a->model, &x->other, note);
    if (status) return status;
    find(other, x->out)->in = false;
    status = add(other, x->in, note);
    if (!status && x->out != TORQUE_PER_AMPERE) status = add(other, TORQUE_PER_AMPERE, note);
    return status ? status : hci_regression_fit(x->regression, other, &x->other.fit, note);
}

/* Of what the model leaves beside the noise, that is by other causes: a difference that is less does not
 * tell. */
#define OTHER_CAUSES 0.05

/* Standard errors, from which on a value is one: nothing in its place is no other explanation. */
#define SURELY 5.0

/* A friction that drives is none. */
static bool is_as_good(const exchange *x)
{
    const hci_candidate *in = find(&x->other.candidates, x->in);
    const hci_fit *fit = &x->a->model.fit;
    const double untold = fmax(HCI_DECISIVE, OTHER_CAUSES * (fit->square - fit->rows));
    return x->other.fit.square < fit->square + untold &&
           fabs(in->term[0].value) > SURELY * in->term[0].std_error &&
           (x->in != FRICTION || in->term[0].value > 0.0);
}

static hci_status constant_of(const hci_regression *e, const hci_candidates *candidates,
                              double *constant_Nm_per_A, hci_note *note)
{
    hci_model model;
    const hci_status status = hci_model_make(e->declared, candidates, false, &model, note);
    if (status) return status;
    *constant_Nm_per_A = hci_torque_constant(e->machine, &model.list);
    hci_model_release(&model);
    return HCI_OK;
}

static hci_verdict *verdict_of(hci_attribution *a, int kind)
{
    size_t k = 0;
    while (a->verdict[k].type != standing_of(kind).type)
        ++k;
    return &a->verdict[k];
}

/* Of the torque per ampere, that matters: in one direction the zero and the friction are one for it. */
#define MATTERS 0.01

static hci_status share_of(const exchange *x, double *share, hci_note *note)
{
    double before, after;
    hci_status status = constant_of(x->regression, &x->a->model.candidates, &before, note);
    if (!status) status = constant_of(x->regression, &x->other.candidates, &after, note);
    *share = !status && fabs(before) > 0.0 ? after / before - 1.0 : 0.0;
    return status;
}

/* Of several the one with which the torque per ampere differs most is told. */
static void tell(exchange *x, double share)
{
    if (x->a->standing_taken && fabs(share) <= fabs(x->a->standing_share)) return;
    x->a->standing_taken = NAME[x->out];
    x->a->standing_instead = NAME[x->in];
    x->a->standing_share = share;
}

/* What else a type has in the model stays certain. */
static void mark(exchange *x)
{
    hci_verdict *v = verdict_of(x->a, x->in), *of = verdict_of(x->a, x->out);
    v->ambiguous = true;
    v->rival_of = of->type;
    of->ambiguous = of->ambiguous || !hci_candidates_have(&x->other.candidates, of->type);
    hci_fitted_model_replace(&v->alternative, &x->other);
}

static hci_status try_one(exchange *x, hci_note *note)
{
    double share = 0.0;
    hci_status status = fit_other(x, note);
    if (!status && is_as_good(x)) status = share_of(x, &share, note);
    if (!status && fabs(share) > MATTERS) {
        tell(x, share);
        mark(x);
    }
    hci_fitted_model_release(&x->other);
    return status;
}

hci_status hci_standing_torque_judge(const hci_regression *e, hci_attribution *a, hci_note *note)
{
    hci_status status = HCI_OK;
    if (a->unknown || a->ended != HCI_WORK_COMPLETE) return HCI_OK;
    for (int out = 0; out < KINDS && !status; ++out)
        for (int in = 0; in < KINDS && !status; ++in) {
            exchange x = {.regression = e, .a = a, .out = out, .in = in};
            if (in == TORQUE_PER_AMPERE || !find(&a->model.candidates, out) ||
                has(e, &a->model.candidates, in))
                continue;
            if (!verdict_of(a, in)->ambiguous) status = try_one(&x, note);
        }
    return status;
}
