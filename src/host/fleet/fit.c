/* In: a machine and recordings of one motor. Out: the values of the terms that all motors have in common. */
#include "hci/host/fleet/fit.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "hci/host/base/number.h"
#include "hci/host/recording/predict.h"
#include "host/base/memory.h"
#include "host/numeric/normal_equations.h"

enum { MOST_TERMS = HCI_FLEET_MOST_PARAMETERS - 2, MOST_EFFECTS = 64, STEPS = 3 };

/* ---- the model: what is declared, and behind it the terms in common ---- */

typedef struct {
    hci_effect effect[MOST_EFFECTS];
    hci_effects list;
    hci_effect_term term[MOST_TERMS]; /* those in common */
    size_t terms, declared_terms;
} model;

/* Takes what an effect names. */
typedef struct {
    model *m;
    const hci_effect_type *type;
} taking;

static void take(void *context, const hci_effect_candidate *candidate)
{
    const taking *t = context;
    for (size_t k = 0; k < candidate->count && t->m->terms < MOST_TERMS; ++k) {
        const size_t parameter = candidate->parameter + k;
        const double order = t->type->parameter[parameter].ordered ? candidate->order : 0.0;
        t->m->term[t->m->terms++] = (hci_effect_term){parameter, order, 0.0, NAN};
    }
}

static void add_type(const hci_machine *machine, const hci_effect_type *type, model *m)
{
    taking t = {m, type};
    const hci_effect_proposals to = {take, &t};
    const size_t first = m->terms;
    if (!type->propose_alike) return;
    type->propose_alike(machine, &to);
    if (m->terms > first && m->list.count < MOST_EFFECTS)
        m->effect[m->list.count++] = (hci_effect){type, m->term + first, m->terms - first};
}

static void make_model(const hci_machine *machine, const hci_effects *declared, model *m)
{
    memset(m, 0, sizeof *m);
    m->declared_terms = hci_effects_terms(declared);
    for (size_t k = 0; k < declared->count && k < MOST_EFFECTS; ++k)
        m->effect[m->list.count++] = declared->effect[k];
    for (size_t k = 0; hci_effect_type_at(k); ++k)
        add_type(machine, hci_effect_type_at(k), m);
    m->list.effect = m->effect;
}

/* ---- one linearisation ---- */

typedef struct {
    const hci_machine *machine;
    const hci_runs *runs;
    hci_sample **reading; /* of each run; NULL: not used */
    size_t samples;
} data;

/* Sums over the samples. */
typedef struct {
    hci_normal_equations normal;
    double square, beside; /* of residuals; of neighbours' products */
} sums;

static void add_run(const data *d, size_t run, const model *m, double *by_value, sums *s)
{
    const hci_run *r = &d->runs->run[run];
    double last = 0.0;
    for (size_t k = 0; k < r->count; ++k) {
        const double residual =
            r->torque_Nm[k] - hci_effects_predict(d->machine, &m->list, &d->reading[run][k], by_value);
        hci_normal_equations_add(&s->normal, by_value + m->declared_terms, &residual, 1);
        s->square += residual * residual;
        s->beside += residual * last;
        last = residual;
    }
}

static hci_status sum_up(const data *d, const model *m, sums *s, hci_note *note)
{
    double *by_value = hci_memory_new(m->declared_terms + m->terms, sizeof *by_value);
    s->square = s->beside = 0.0;
    if (!by_value || !hci_normal_equations_start(&s->normal, m->terms)) {
        hci_memory_free(by_value);
        return hci_note_memory(note, NULL, "a fit");
    }
    for (size_t k = 0; k < d->runs->count; ++k)
        if (d->reading[k]) add_run(d, k, m, by_value, s);
    hci_normal_equations_finish(&s->normal);
    hci_memory_free(by_value);
    return HCI_OK;
}

static hci_status step(const data *d, model *m, hci_sweep *sweep, sums *s, hci_note *note)
{
    hci_status status = sum_up(d, m, s, note);
    if (status) return status;
    const bool is_begun = hci_sweep_start(sweep, &s->normal);
    hci_normal_equations_release(&s->normal);
    if (!is_begun) return hci_note_memory(note, NULL, "a fit");
    for (size_t k = 0; k < m->terms; ++k)
        (void)hci_sweep_in(sweep, k); /* one that depends on those before stays out */
    for (size_t k = 0; k < m->terms; ++k)
        if (sweep->in[k]) m->term[k].value += sweep->b[k];
    return HCI_OK;
}

/* ---- values ---- */

/* A parameter as a weighted sum of terms. */
typedef struct {
    size_t term[3];
    double weight[3];
    size_t count;
} combination;

static void name_term(const hci_effect_type *type, const hci_effect_term *term, hci_fleet_parameter *p)
{
    const hci_effect_parameter *parameter = &type->parameter[term->parameter];
    char order[32] = "";
    if (parameter->ordered) hci_number_text(term->order, order);
    snprintf(p->effect, sizeof p->effect, "%s", type->name);
    snprintf(p->parameter, sizeof p->parameter, "%.20s%s%.17s", parameter->name, order[0] ? "_" : "", order);
    snprintf(p->unit, sizeof p->unit, "%s", parameter->unit);
}

/* The values, and their standard errors for residuals of a deviation of 1. */
static void combine(const model *m, const hci_sweep *sweep, const combination *c, hci_fleet_parameter *p)
{
    double value = 0.0, variance = 0.0;
    bool is_told = true;
    for (size_t i = 0; i < c->count; ++i) {
        value += c->weight[i] * m->term[c->term[i]].value;
        is_told = is_told && sweep->in[c->term[i]];
        for (size_t j = 0; j < c->count; ++j)
            variance += c->weight[i] * c->weight[j] * sweep->a[c->term[i] * sweep->n + c->term[j]];
    }
    p->value = p->std_error = NAN;
    if (!is_told) return;
    p->value = value;
    p->std_error = sqrt(variance);
}

/* Three phases: their mean, and what each has beside it. */
static void list_phases(const model *m, const hci_sweep *sweep, const hci_effect *effect, hci_fleet_fit *fit)
{
    const size_t first = (size_t)(effect->term - m->term);
    const double third = 1.0 / 3.0;
    for (int phase = -1; phase < 3; ++phase) {
        hci_fleet_parameter *p = &fit->parameter[fit->count++];
        combination c = {{first, first + 1, first + 2}, {third, third, third}, 3};
        for (int k = 0; k < 3 && phase >= 0; ++k)
            c.weight[k] = (k == phase) - third;
        name_term(effect->type, &effect->term[phase < 0 ? 0 : phase], p);
        if (phase < 0) {
            snprintf(p->effect, sizeof p->effect, "%s", effect->type->when_equal->name);
            snprintf(p->parameter, sizeof p->parameter, "common");
        }
        combine(m, sweep, &c, p);
    }
}

static void list_values(const model *m, const hci_sweep *sweep, hci_fleet_fit *fit)
{
    fit->count = 0;
    for (size_t k = 0; k < m->list.count; ++k) {
        const hci_effect *e = &m->effect[k];
        if (e->term < m->term || e->term >= m->term + m->terms) continue; /* declared */
        if (e->type->when_equal && e->count == 3) {
            list_phases(m, sweep, e, fit);
            continue;
        }
        for (size_t j = 0; j < e->count; ++j) {
            hci_fleet_parameter *p = &fit->parameter[fit->count++];
            const combination c = {{(size_t)(e->term + j - m->term)}, {1.0}, 1};
            name_term(e->type, &e->term[j], p);
            combine(m, sweep, &c, p);
        }
    }
}

/* Noise that is correlated from sample to sample by ρ counts as (1 − ρ)/(1 + ρ) as many samples. */
static void widen(const sums *s, size_t samples, size_t columns, hci_fleet_fit *fit)
{
    const double correlation = fmin(fmax(s->beside / s->square, 0.0), 0.99);
    const double freedom = samples > columns ? (double)(samples - columns) : 1.0;
    const double deviation = sqrt(s->square / freedom * (1.0 + correlation) / (1.0 - correlation));
    for (size_t k = 0; k < fit->count; ++k)
        fit->parameter[k].std_error *= deviation;
}

/* ---- all of it ---- */

static hci_status take_steps(const data *d, model *m, hci_fleet_fit *fit, hci_note *note)
{
    hci_sweep sweep = {0};
    sums s = {0};
    hci_status status = HCI_OK;
    for (int k = 0; k < STEPS && !status; ++k) {
        hci_sweep_release(&sweep);
        status = step(d, m, &sweep, &s, note);
        if (k == 0) fit->rms_before_Nm = sqrt(s.square / (double)d->samples);
    }
    if (!status) status = sum_up(d, m, &s, note);
    hci_normal_equations_release(&s.normal);
    if (!status && !isfinite(s.square))
        status = hci_note_set(note, HCI_ERROR_NUMERIC, "the terms in common cannot be fitted");
    if (!status) {
        fit->rms_after_Nm = sqrt(s.square / (double)d->samples);
        list_values(m, &sweep, fit);
        widen(&s, d->samples, m->terms, fit);
    }
    hci_sweep_release(&sweep);
    return status;
}

static hci_status read_run(const hci_machine_data *machine, const hci_runs *runs, size_t k, data *d,
                           hci_note *note)
{
    const hci_run *r = &runs->run[k];
    if (runs->role[k] != HCI_ROLE_FIT || r->torque_source != HCI_TORQUE_MEASURED || !r->theta_m_rad ||
        r->mean_is_unknown)
        return HCI_OK;
    d->reading[k] = hci_memory_new(r->count, sizeof *d->reading[k]);
    if (!d->reading[k]) return hci_note_memory(note, r->name, "its samples");
    d->samples += r->count;
    return hci_predict_readings(r, machine->model.pole_pairs, false, d->reading[k], note);
}

hci_status hci_fleet_fit_runs(const hci_machine_data *machine, const hci_effects *declared,
                              const hci_runs *runs, hci_fleet_fit *fit, hci_note *note)
{
    data d = {.machine = &machine->model, .runs = runs};
    model m;
    hci_status status = HCI_OK;
    memset(fit, 0, sizeof *fit);
    d.reading = hci_memory_new(runs->count, sizeof *d.reading);
    if (!d.reading) return hci_note_memory(note, NULL, "a fit");
    for (size_t k = 0; k < runs->count && !status; ++k)
        status = read_run(machine, runs, k, &d, note);
    if (!status && d.samples == 0)
        status = hci_note_set(note, HCI_ERROR_INPUT,
                              "%s: found no run to be fitted with an angle and a measured torque; expected one "
                              "at least",
                              runs->list ? runs->list : "recordings");
    make_model(&machine->model, declared, &m);
    if (!status) status = take_steps(&d, &m, fit, note);
    fit->samples = d.samples;
    for (size_t k = 0; k < runs->count; ++k)
        hci_memory_free(d.reading[k]);
    hci_memory_free(d.reading);
    return status;
}
