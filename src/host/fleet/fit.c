/* In: a machine and recordings of one motor. Out: the values of the terms that all motors have in common. */
#include "hci/host/fleet/fit.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "hci/host/base/number.h"
#include "hci/host/recording/predict.h"
#include "host/base/memory.h"
#include "host/diagnose/open_voltage.h"
#include "host/fleet/beside_torque.h"
#include "host/numeric/normal_equations.h"

enum { MOST_TERMS = HCI_FLEET_MOST_PARAMETERS - 11, MOST_EFFECTS = 64, STEPS = 10, HALVINGS = 12 };

/* Shares of the sum of squares: a step that lowers it by less is not made; the fit is found where none lowers
 * it by more. */
#define CONVERGED 1e-9
#define FOUND     1e-4

/* ---- the model: what is declared, and behind it the terms in common ---- */

typedef struct {
    hci_effect effect[MOST_EFFECTS];
    hci_effects list;
    hci_effect_term term[MOST_TERMS]; /* those in common */
    double expected[MOST_TERMS];      /* standard deviation of values that there are; 0: any */
    bool is_left_out[MOST_TERMS];     /* the recordings do not tell it */
    double brakes[MOST_TERMS];        /* declared of that friction; NAN: no friction */
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
        t->m->expected[t->m->terms] = candidate->expected;
        t->m->term[t->m->terms++] = (hci_effect_term){parameter, order, 0.0, NAN};
    }
}

static void add_type(const hci_machine_data *machine, const hci_effect_type *type, model *m)
{
    taking t = {m, type};
    const hci_effect_proposals to = {take, &t};
    const size_t first = m->terms;
    if (!type->propose_alike) return;
    type->propose_alike(&machine->model, machine->slots, &to);
    if (m->terms > first && m->list.count < MOST_EFFECTS)
        m->effect[m->list.count++] = (hci_effect){type, m->term + first, m->terms - first};
}

/* What is declared of a kind of friction, by which a smaller one still brakes. */
static double declared_of(const hci_effects *declared, const hci_effect_type *type, size_t parameter)
{
    double sum = 0.0;
    for (size_t k = 0; k < declared->count; ++k)
        for (size_t j = 0; declared->effect[k].type == type && j < declared->effect[k].count; ++j)
            if (declared->effect[k].term[j].parameter == parameter) sum += declared->effect[k].term[j].value;
    return sum;
}

static void find_brakes(const hci_effects *declared, model *m)
{
    for (size_t k = 0; k < m->terms; ++k)
        m->brakes[k] = NAN;
    for (size_t k = 0; k < m->list.count; ++k) {
        const hci_effect *e = &m->effect[k];
        if (!e->type->coulomb_Nm || e->term < m->term || e->term >= m->term + m->terms) continue;
        for (size_t j = 0; j < e->count; ++j)
            m->brakes[(size_t)(e->term - m->term) + j] = declared_of(declared, e->type, e->term[j].parameter);
    }
}

static void make_model(const hci_machine_data *machine, const hci_effects *declared, model *m)
{
    memset(m, 0, sizeof *m);
    m->declared_terms = hci_effects_terms(declared);
    for (size_t k = 0; k < declared->count && k < MOST_EFFECTS; ++k)
        m->effect[m->list.count++] = declared->effect[k];
    for (size_t k = 0; hci_effect_type_at(k); ++k)
        add_type(machine, hci_effect_type_at(k), m);
    find_brakes(declared, m);
    m->list.effect = m->effect;
}

/* ---- one linearisation ---- */

typedef struct {
    const hci_machine *machine;
    const hci_runs *runs;
    bool *is_used; /* of each run */
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
        const hci_sample reading = hci_predict_reading(r, k); /* made anew: 128 bytes a row to keep it */
        const double residual =
            r->torque_Nm[k] - hci_effects_predict(d->machine, &m->list, &reading, by_value);
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
        if (d->is_used[k]) add_run(d, k, m, by_value, s);
    hci_normal_equations_finish(&s->normal);
    hci_memory_free(by_value);
    return HCI_OK;
}

/* ---- steps ---- */

/* Where the fit is. */
typedef struct {
    sums s;
    hci_sweep sweep; /* of the linearisation there */
} place;

static void release_place(place *p)
{
    hci_normal_equations_release(&p->s.normal);
    hci_sweep_release(&p->sweep);
}

static hci_status look(const data *d, const model *m, place *p, hci_note *note)
{
    hci_status status = sum_up(d, m, &p->s, note);
    if (status) return status;
    if (!hci_sweep_start(&p->sweep, &p->s.normal)) return hci_note_memory(note, NULL, "a fit");
    for (size_t k = 0; k < m->terms; ++k)
        if (!m->is_left_out[k])
            (void)hci_sweep_in(&p->sweep, k); /* one that depends on those before stays out */
    return HCI_OK;
}

static void move(model *m, const hci_sweep *by, double share)
{
    for (size_t k = 0; k < m->terms; ++k)
        if (by->in[k]) m->term[k].value += share * by->b[k];
}

/* A step, halved until the error falls. *is_lower: whether it did; else nothing is changed. */
static hci_status step(const data *d, model *m, place *p, bool *is_lower, hci_note *note)
{
    double share = 1.0;
    *is_lower = false;
    for (int k = 0; k < HALVINGS; ++k, share *= 0.5) {
        place next = {0};
        move(m, &p->sweep, share);
        const hci_status status = look(d, m, &next, note);
        *is_lower = !status && next.s.square <= p->s.square;
        if (*is_lower) {
            release_place(p);
            *p = next;
            return HCI_OK;
        }
        release_place(&next);
        move(m, &p->sweep, -share);
        if (status) return status;
    }
    return HCI_OK;
}

/* The linearised torque has no sum of squares that is lower by more than a share. */
static bool is_least(const place *p, double share)
{
    return !(p->s.square - p->sweep.square > share * p->s.square);
}

/* Steps until they change nothing. *is_found: whether that came about. */
static hci_status descend(const data *d, model *m, place *p, bool *is_found, hci_note *note)
{
    hci_status status = HCI_OK;
    bool is_lower = true;
    for (int k = 0; k < STEPS && is_lower && !is_least(p, CONVERGED) && !status; ++k)
        status = step(d, m, p, &is_lower, note);
    *is_found = !status && is_least(p, FOUND);
    return status;
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

/* The deviation by which standard errors are wider than those for residuals of a deviation of 1. Noise that
 * is correlated from sample to sample by ρ counts as (1 − ρ)/(1 + ρ) as many samples. */
static double deviation_of(const sums *s, size_t samples, size_t columns)
{
    const double correlation = s->square > 0.0 ? fmin(fmax(s->beside / s->square, 0.0), 0.99) : 0.0;
    const double freedom = samples > columns ? (double)(samples - columns) : 1.0;
    return sqrt(s->square / freedom * (1.0 + correlation) / (1.0 - correlation));
}

/* ---- what the recordings do not tell ---- */

/* What doubts are measured by. */
typedef struct {
    double rms_Nm;    /* of what stays */
    double deviation; /* by which standard errors are wider than those for residuals of a deviation of 1 */
    double samples;
} yardstick;

/* Where terms are as declared: by what the first step is expected to leave, whose correlation is not known.
 */
static yardstick before(const model *m, const place *p, size_t samples)
{
    const sums s = {.square = fmax(p->sweep.square, 0.0)};
    return (yardstick){sqrt(s.square / (double)samples), deviation_of(&s, samples, m->terms),
                       (double)samples};
}

static yardstick after(const model *m, const place *p, size_t samples)
{
    return (yardstick){sqrt(p->s.square / (double)samples), deviation_of(&p->s, samples, m->terms),
                       (double)samples};
}

/* By how much a term is beyond belief; up to 1 it is believed. Its standard error moves the torque by more
 * than the rms of what stays, or is larger than the values that there are; or it is a friction that drives.
 */
static double doubt(const model *m, const hci_sweep *sweep, const yardstick *by, size_t term)
{
    const double std_error = by->deviation * sqrt(sweep->a[term * sweep->n + term]);
    const double as_torque = std_error * sqrt(sweep->diagonal[term] / by->samples);
    double worst = by->rms_Nm > 0.0 ? as_torque / by->rms_Nm : 0.0;
    if (m->expected[term] > 0.0) worst = fmax(worst, std_error / m->expected[term]);
    if (!isnan(m->brakes[term]) && std_error > 0.0)
        worst = fmax(worst, -(m->brakes[term] + m->term[term].value) / (3.0 * std_error));
    return worst;
}

#define ALIKE                                                                                                \
    0.3 /* terms that one direction confounds have doubts alike; the one that is listed last goes            \
         */

/* Leaves out the term that is told least. False: all are told. */
static bool leave_out(model *m, const hci_sweep *sweep, const yardstick *by)
{
    double most = 1.0;
    size_t last = m->terms;
    for (size_t k = 0; k < m->terms; ++k)
        if (sweep->in[k]) most = fmax(most, doubt(m, sweep, by, k));
    for (size_t k = 0; k < m->terms; ++k)
        if (sweep->in[k] && doubt(m, sweep, by, k) > fmax(1.0, ALIKE * most)) last = k;
    if (last == m->terms) return false;
    m->is_left_out[last] = true;
    return true;
}

/* The terms that can be told where they are as declared. */
static void leave_out_first(model *m, place *p, size_t samples)
{
    for (;;) {
        const yardstick by = before(m, p, samples);
        if (!leave_out(m, &p->sweep, &by)) return;
        for (size_t k = 0; k < m->terms; ++k)
            if (m->is_left_out[k]) hci_sweep_out(&p->sweep, k);
    }
}

/* Where no least error is found: the last term in which the torque is not linear. False: none is left. */
static bool leave_out_curved(model *m, const hci_sweep *sweep)
{
    for (size_t k = m->list.count; k-- > 0;) {
        const hci_effect *e = &m->effect[k];
        if (e->term < m->term || e->term >= m->term + m->terms) continue; /* declared */
        for (size_t j = e->count; j-- > 0;) {
            const size_t term = (size_t)(e->term - m->term) + j;
            if (!sweep->in[term] || (e->type->parameter[e->term[j].parameter].traits & HCI_PARAMETER_LINEAR))
                continue;
            m->is_left_out[term] = true;
            return true;
        }
    }
    return false;
}

/* ---- all of it ---- */

/* From what is declared to the least error, by the terms that are not left out. */
static hci_status fit_once(const data *d, model *m, place *p, hci_fleet_fit *fit, hci_note *note)
{
    for (size_t k = 0; k < m->terms; ++k)
        m->term[k].value = 0.0;
    release_place(p);
    hci_status status = look(d, m, p, note);
    if (status) return status;
    if (!isfinite(p->s.square))
        return hci_note_set(note, HCI_ERROR_NUMERIC, "the terms in common cannot be fitted");
    fit->rms_before_Nm = sqrt(p->s.square / (double)d->samples);
    leave_out_first(m, p, d->samples);
    return descend(d, m, p, &fit->is_found, note);
}

#define BELIEVED 6.0 /* standard deviations of the values that there are */

/* A share, of the flux or of a phase, that no motor of the make has. NULL: none. */
static const hci_effect *beyond_belief(const model *m)
{
    for (size_t k = 0; k < m->list.count; ++k) {
        const hci_effect *e = &m->effect[k];
        if (e->term < m->term || e->term >= m->term + m->terms) continue; /* declared */
        for (size_t j = 0; j < e->count; ++j) {
            const double expected = m->expected[(size_t)(e->term - m->term) + j];
            const bool is_share = e->type->parameter[e->term[j].parameter].traits & HCI_PARAMETER_LINEAR;
            if (is_share && expected > 0.0 && fabs(e->term[j].value) > BELIEVED * expected) return e;
        }
    }
    return NULL;
}

static void keep_declared(const hci_effect *beyond, hci_fleet_fit *fit)
{
    fit->is_found = false;
    fit->rms_after_Nm = fit->rms_before_Nm;
    for (size_t k = 0; k < fit->count; ++k)
        fit->parameter[k].value = fit->parameter[k].std_error = NAN;
    if (beyond)
        hci_note_add(
            &fit->remark,
            "the least error asks for more %s than any motor has, and the declared values stay: the "
            "wiring, the columns or the pole pairs are others than of the machine folder; `check` the "
            "recordings",
            beyond->type->name);
    else
        hci_note_add(&fit->remark, "the error cannot be brought to its least value, and the declared values "
                                   "stay: `check` the recordings, or `diagnose` them");
}

static hci_status take_steps(const data *d, model *m, hci_fleet_fit *fit, hci_note *note)
{
    place p = {0};
    hci_status status;
    bool is_again;
    do {
        status = fit_once(d, m, &p, fit, note);
        const yardstick by = after(m, &p, d->samples);
        is_again = !status && (fit->is_found ? leave_out(m, &p.sweep, &by) : leave_out_curved(m, &p.sweep));
    } while (is_again);
    if (!status) list_values(m, &p.sweep, fit);
    if (!status) fit->rms_after_Nm = sqrt(p.s.square / (double)d->samples);
    for (size_t k = 0; k < fit->count && !status; ++k)
        fit->parameter[k].std_error *= deviation_of(&p.s, d->samples, m->terms);
    const hci_effect *beyond = fit->is_found ? beyond_belief(m) : NULL;
    if (!status && (beyond || !fit->is_found)) keep_declared(beyond, fit);
    release_place(&p);
    return status;
}

/* ---- which recordings are used ---- */

/* Why a run cannot be fitted; NULL: it can. */
static const char *reason_against(const hci_run *r)
{
    if (r->torque_source == HCI_TORQUE_HOLDING) return "a turn that is held, whose current is the reading";
    if (r->torque_source != HCI_TORQUE_MEASURED) return "without a measured torque";
    if (!r->theta_m_rad) return "without an angle";
    return r->mean_is_unknown ? "with an unknown constant load" : NULL;
}

/* Those that are left out: how many of how many, and the first. */
static void remark_unused(const hci_machine *machine, const hci_runs *runs, hci_fleet_fit *fit)
{
    const hci_run *first = NULL;
    for (size_t k = 0; k < runs->count; ++k) {
        if (runs->role[k] != HCI_ROLE_FIT) continue;
        ++fit->recordings;
        if (!reason_against(&runs->run[k]) || hci_open_voltage_is_in(machine, &runs->run[k])) continue;
        ++fit->recordings_unused;
        if (!first) first = &runs->run[k];
    }
    if (first)
        hci_note_add(&fit->remark, "%zu of %zu recordings are not used; the first, %.200s, is %s",
                     fit->recordings_unused, fit->recordings, first->name, reason_against(first));
}

/* Rows of the recordings in use that are not among their samples. */
static void remark_holes(const hci_runs *runs, hci_fleet_fit *fit)
{
    for (size_t k = 0; k < runs->count; ++k) {
        const hci_run *r = &runs->run[k];
        if (runs->role[k] == HCI_ROLE_FIT && !reason_against(r) && r->row && r->count > 0)
            fit->rows_unused += r->row[r->count - 1] + 1 - r->count;
    }
    if (fit->rows_unused > 0)
        hci_note_add(&fit->remark,
                     "%zu rows of the recordings have a hole or repeat the one before, and are not used",
                     fit->rows_unused);
}

static void choose_runs(data *d)
{
    for (size_t k = 0; k < d->runs->count; ++k) {
        d->is_used[k] = d->runs->role[k] == HCI_ROLE_FIT && !reason_against(&d->runs->run[k]);
        if (d->is_used[k]) d->samples += d->runs->run[k].count;
    }
}

hci_status hci_fleet_fit_runs(const hci_machine_data *machine, const hci_effects *declared,
                              const hci_runs *runs, hci_fleet_fit *fit, hci_note *note)
{
    data d = {.machine = &machine->model, .runs = runs};
    model m;
    hci_status status = HCI_OK;
    memset(fit, 0, sizeof *fit);
    d.is_used = hci_memory_new(runs->count, sizeof *d.is_used);
    if (!d.is_used) return hci_note_memory(note, NULL, "a fit");
    choose_runs(&d);
    if (d.samples == 0)
        status =
            hci_note_set(note, HCI_ERROR_INPUT,
                         "%s: found no run to be fitted with an angle and a measured torque; expected one "
                         "at least",
                         runs->list ? runs->list : "recordings");
    remark_unused(&machine->model, runs, fit);
    remark_holes(runs, fit);
    make_model(machine, declared, &m);
    if (!status) status = take_steps(&d, &m, fit, note);
    if (!status) status = hci_fleet_list_beside(machine, runs, fit, note);
    fit->samples = d.samples;
    hci_memory_free(d.is_used);
    return status;
}
