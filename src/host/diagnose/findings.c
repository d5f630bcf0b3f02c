#include "host/diagnose/findings.h"

#include <assert.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "host/diagnose/candidates/empirical_term.h"
#include "host/diagnose/search/search.h"

enum { LONGEST_TERM = 80 }; /* bytes of one term in words */

/* ---- in words ---- */

#define ROUNDING 1e-9 /* of its standard error, below which a value is 0 */

/* "sine_18 = 0.021 ± 0.0008 Nm" */
static size_t describe_term(const hci_effect_type *type, const hci_effect_term *term, char *text, size_t size)
{
    const hci_effect_parameter *p = &type->parameter[term->parameter];
    const char *unit = strcmp(p->unit, "1") == 0 ? "" : p->unit;
    char order[32] = "";
    if (p->ordered) snprintf(order, sizeof order, "_%.6g", term->order);
    const double value = fabs(term->value) > ROUNDING * term->std_error ? term->value : 0.0;
    const int length =
        term->std_error > 0.0
            ? snprintf(text, size, "%s%s = %.4g ± %.2g %s", p->name, order, value, term->std_error, unit)
            : snprintf(text, size, "%s%s = %.4g %s, not told by itself", p->name, order, term->value, unit);
    return (size_t)length < size ? (size_t)length : size - 1;
}

/* 0 without an error is what nothing was fitted to. */
static bool is_not_looked_at(const hci_effect_term *term)
{
    return !(fabs(term->value) > 0.0) && !(term->std_error > 0.0);
}

/* All terms of a type that are in, as many as fit. */
static void describe(const hci_candidates *candidates, const hci_effect_type *type, char *text, size_t size)
{
    size_t used = 0;
    text[0] = '\0';
    for (size_t k = 0; k < candidates->count; ++k) {
        const hci_candidate *x = &candidates->candidate[k];
        for (size_t j = 0; x->in && x->type == type && j < x->count; ++j) {
            const char *between = used == 0 ? "" : "; ";
            if (is_not_looked_at(&x->term[j])) continue;
            if (used + LONGEST_TERM > size) {
                snprintf(text + used, size - used, "; …");
                return;
            }
            used += (size_t)snprintf(text + used, size - used, "%s", between);
            used += describe_term(type, &x->term[j], text + used, size - used);
        }
    }
}

#define SURELY 2.0 /* standard errors by which a value is below 0 */

/* A law of friction of as many terms as there are speeds fits any means: a term below 0 is what a sum that is
 * right at these speeds takes, and no friction. */
static void say_sum_of_friction(const hci_candidates *candidates, const hci_effect_type *type, char *text,
                                size_t size)
{
    const size_t used = strlen(text);
    bool is_below = false;
    for (size_t k = 0; k < candidates->count; ++k) {
        const hci_candidate *x = &candidates->candidate[k];
        for (size_t j = 0; x->in && x->type == type && j < x->count; ++j)
            is_below = is_below || x->term[j].value < -SURELY * x->term[j].std_error;
    }
    if (is_below && type->coulomb_Nm)
        snprintf(text + used, size - used,
                 "; only their sum at the recorded speeds is told: a term below 0 is no friction by itself");
}

/* ---- findings ---- */

static hci_finding finding_of(const hci_attribution *a, const hci_verdict *v, double whole_Nm2)
{
    hci_finding f = {v->type->name, HCI_FINDING_REJECTED, v->gain, v->stays, v->left_out, NAN, ""};
    if (v->ambiguous)
        f.verdict = HCI_FINDING_AMBIGUOUS;
    else if (v->in)
        f.verdict = HCI_FINDING_ADDED;
    if (v->in && whole_Nm2 > 0.0) f.residual_share = fmin(1.0, v->explained_Nm * v->explained_Nm / whole_Nm2);
    if (v->in) {
        describe(&a->model.candidates, v->type, f.detail, sizeof f.detail);
        say_sum_of_friction(&a->model.candidates, v->type, f.detail, sizeof f.detail);
    }
    if (!v->in && v->ambiguous) {
        const int n = snprintf(f.detail, sizeof f.detail, "in place of %s: ", v->rival_of->name);
        describe(&v->alternative.candidates, v->type, f.detail + n, sizeof f.detail - (size_t)n);
        if (!v->alternative.candidates.candidate)
            snprintf(f.detail, sizeof f.detail, "looks the same as a part of %s in all these runs",
                     v->rival_of->name);
    }
    return f;
}

static bool stands_alone(const hci_finding *f)
{
    return !(f->delta_bic < HCI_DECISIVE) || 3 * f->stays >= 2 * f->left_out;
}

bool hci_finding_is_part(const hci_diagnosis *d, const hci_finding *f)
{
    bool beside = false;
    for (size_t k = 0; k < d->findings; ++k) {
        const hci_finding *x = &d->finding[k];
        beside = beside || (x->verdict == HCI_FINDING_ADDED && stands_alone(x) &&
                            strcmp(x->effect, hci_empirical_type.name) != 0);
    }
    return beside && f->verdict == HCI_FINDING_ADDED && !stands_alone(f);
}

/* Added, ambiguous, rejected; among those the larger gain first. */
static bool comes_after(const hci_finding *a, const hci_finding *b)
{
    return a->verdict > b->verdict || (a->verdict == b->verdict && a->delta_bic < b->delta_bic);
}

/* Puts a finding into its place. */
static void finding_put(hci_diagnosis *d, const hci_finding *f)
{
    size_t at = d->findings;
    assert(d->findings < HCI_MOST_FINDINGS);
    for (; at > 0 && comes_after(&d->finding[at - 1], f); --at)
        d->finding[at] = d->finding[at - 1];
    d->finding[at] = *f;
    ++d->findings;
}

/* What is left as far as it was looked into. */
static const char *left_words(const hci_attribution *a)
{
    if (a->not_searched) return "that was not looked into";
    if (a->ended != HCI_WORK_COMPLETE) return "that no effect explains which was compared";
    return a->means_open && a->means_alone ? "in the means of the runs, that no known effect explains"
                                           : "that no known effect explains";
}

void hci_finding_unknown_put(hci_diagnosis *d, double unexplained_Nm, const char *words)
{
    const double whole_Nm2 = d->rms_before_Nm * d->rms_before_Nm;
    hci_finding *f = &d->finding[0];
    size_t at = 0;
    while (at < d->findings && strcmp(d->finding[at].effect, hci_empirical_type.name) != 0)
        ++at;
    assert(at < d->findings);
    memmove(f + 1, f, at * sizeof *f);
    *f = (hci_finding){hci_empirical_type.name, HCI_FINDING_ADDED, NAN, f->stays, f->left_out, NAN, ""};
    if (whole_Nm2 > 0.0) f->residual_share = unexplained_Nm * unexplained_Nm / whole_Nm2;
    snprintf(f->detail, sizeof f->detail, "rms %.3g N·m %s", unexplained_Nm, words);
}

/* Whether an effect with a name is in the model. */
static bool has_known(const hci_attribution *a)
{
    for (size_t r = 0; r < a->types; ++r)
        if (a->verdict[r].in && a->verdict[r].type != &hci_empirical_type) return true;
    return false;
}

static hci_diagnosis_verdict verdict_of(const hci_attribution *a, const hci_diagnosis *d)
{
    hci_diagnosis_verdict verdict = HCI_DIAGNOSIS_COMPLETE;
    if (a->unknown) return has_known(a) ? HCI_DIAGNOSIS_PARTLY : HCI_DIAGNOSIS_UNKNOWN;
    for (size_t k = 0; k < d->findings; ++k) {
        if (d->finding[k].verdict == HCI_FINDING_AMBIGUOUS) return HCI_DIAGNOSIS_AMBIGUOUS;
        if (d->finding[k].verdict == HCI_FINDING_ADDED) verdict = HCI_DIAGNOSIS_EXPLAINED;
    }
    return verdict;
}

void hci_findings_fill(const hci_attribution *a, hci_diagnosis *d)
{
    const double whole_Nm2 = d->rms_before_Nm * d->rms_before_Nm;
    for (size_t r = 0; r < a->types; ++r) {
        const hci_effect_type *type = a->verdict[r].type;
        if (!a->verdict[r].in && !type->propose && type != &hci_empirical_type) continue; /* not looked for */
        const hci_finding f = finding_of(a, &a->verdict[r], whole_Nm2);
        finding_put(d, &f);
    }
    if (a->unknown) hci_finding_unknown_put(d, a->unexplained_Nm, left_words(a));
    d->inertia_as_well = a->inertia_as_well;
    d->standing_taken = a->standing_taken;
    d->standing_instead = a->standing_instead;
    d->standing_share = a->standing_share;
    d->sensors_as_well = a->sensors_as_well;
    d->magnetic_only = a->magnetic_only;
    d->verdict = verdict_of(a, d);
}

double hci_finding_delta_bic(const hci_finding *f)
{
    return f->verdict == HCI_FINDING_REJECTED && f->delta_bic == 0.0 ? (double)NAN : f->delta_bic;
}

/* ---- what is not explained ---- */

static hci_unexplained unexplained_of(const hci_candidate *s, const hci_dataset_range *most)
{
    const size_t g = s->term[0].parameter / 2;
    const hci_growth_law growth = hci_growth_law_of(g);
    const double sine = s->term[0].value, cosine = s->term[1].value;
    const double grown = fabs(hci_growth_law_at(g, most->current_A, most->speed_rad_per_s));
    return (hci_unexplained){
        s->term[0].order,           sine, cosine, growth.current, growth.speed, growth.turns_sign,
        hypot(sine, cosine) * grown};
}

void hci_unexplained_fill(const hci_dataset *b, const hci_attribution *a, hci_diagnosis *d)
{
    const hci_dataset_range most = hci_dataset_range_of(b);
    d->wanders = a->unknown && a->wanders;
    d->means_open = a->means_open;
    d->means_alone = a->means_alone;
    for (size_t k = 0; k < a->model.candidates.count && a->unknown; ++k) {
        const hci_candidate *s = &a->model.candidates.candidate[k];
        if (s->in && s->type == &hci_empirical_type && d->unexplained_count < HCI_MOST_UNEXPLAINED)
            d->unexplained[d->unexplained_count++] = unexplained_of(s, &most);
    }
}
