#include "hci/host/diagnose/again.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "hci/host/csv/csv.h"
#include "hci/host/machine/uncertainty.h"
#include "host/base/memory.h"
#include "host/diagnose/fit/dataset.h"
#include "host/diagnose/reading/predicted_reading.h"
#include "host/diagnose/run_errors.h"

#define EXCEEDED 0.05 /* share of the machines beyond the bound, and of changes that are called one */

enum { PATH_SIZE = 4096 };

/* ---- the last diagnosis ---- */

typedef struct {
    hci_effects_data effects;    /* of its machine */
    hci_uncertainty uncertainty; /* of that; empty where nothing was stated */
    hci_csv *verdicts;           /* its effects.csv */
} last_diagnosis;

static hci_status path_make(const char *folder, const char *name, char path[PATH_SIZE], hci_note *note)
{
    if (snprintf(path, PATH_SIZE, "%s/%s", folder, name) < PATH_SIZE) return HCI_OK;
    return hci_note_set(note, HCI_ERROR_INPUT, "%.200s…: the path is too long", folder);
}

static hci_status last_read(const char *folder, last_diagnosis *last, hci_note *note)
{
    char machine[PATH_SIZE], verdicts[PATH_SIZE];
    memset(last, 0, sizeof *last);
    hci_status status = path_make(folder, "machine", machine, note);
    if (!status) status = path_make(folder, "effects.csv", verdicts, note);
    if (!status) status = hci_effects_read_machine(machine, &last->effects, note);
    if (!status) status = hci_uncertainty_read_machine(machine, &last->uncertainty, note);
    if (!status) status = hci_csv_read(verdicts, &last->verdicts, note);
    if (!status && !hci_uncertainty_is_of(&last->uncertainty, &last->effects.list))
        hci_uncertainty_release(&last->uncertainty);
    return status;
}

static void last_release(last_diagnosis *last)
{
    hci_effects_release(&last->effects);
    hci_uncertainty_release(&last->uncertainty);
    hci_csv_free(last->verdicts);
}

/* Whether the last diagnosis has called an effect ambiguous. */
static hci_status was_ambiguous(const last_diagnosis *last, const char *effect, bool *ambiguous,
                                hci_note *note)
{
    const char *name, *verdict;
    hci_status status = HCI_OK;
    *ambiguous = false;
    for (size_t row = 0; row < hci_csv_rows(last->verdicts) && !status; ++row) {
        status = hci_csv_text(last->verdicts, "effect", row, &name, note);
        if (!status) status = hci_csv_text(last->verdicts, "verdict", row, &verdict, note);
        if (!status && strcmp(name, effect) == 0)
            *ambiguous = strcmp(verdict, hci_finding_verdict_name(HCI_FINDING_AMBIGUOUS)) == 0;
    }
    return status;
}

/* ---- what was promised ---- */

/* Departures of one run's reading in each machine that was allowed. */
typedef struct {
    const hci_uncertainty *uncertainty;
    double *departure_Nm, *square; /* [machines] */
    double count;                  /* samples */
} promise;

static void sample_add(promise *p, const double *by_value, double weight)
{
    const hci_uncertainty *u = p->uncertainty;
    memset(p->departure_Nm, 0, u->machines * sizeof *p->departure_Nm);
    for (size_t t = 0; t < hci_effects_terms(&u->effects.list); ++t)
        for (size_t m = 0; m < u->machines && by_value[t] != 0.0; ++m)
            p->departure_Nm[m] += by_value[t] * u->departure[t * u->machines + m];
    for (size_t m = 0; m < u->machines; ++m)
        p->square[m] += weight * p->departure_Nm[m] * p->departure_Nm[m];
    p->count += weight;
}

static int by_size(const void *a, const void *b)
{
    const double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

/* The rms that one machine in twenty exceeds. */
static double rms_exceeded(promise *p)
{
    const size_t n = p->uncertainty->machines;
    const double place = ceil((1.0 - EXCEEDED) * (double)(n + 1) - 1e-9);
    qsort(p->square, n, sizeof *p->square, by_size);
    return sqrt(p->square[(size_t)fmin((double)n, place) - 1] / fmax(1.0, p->count));
}

/* The rms of what the last recordings left open of one run. *open_Nm: NAN where nothing was stated. */
static hci_status open_of(const hci_dataset *b, const hci_uncertainty *u, size_t run, double *open_Nm,
                          hci_note *note)
{
    const hci_regression *e = &b->regression;
    hci_predicted_reading reading;
    promise p = {u, NULL, NULL, 0.0};
    *open_Nm = NAN;
    if (u->machines == 0) return HCI_OK;
    p.departure_Nm = hci_memory_new(2 * u->machines, sizeof *p.departure_Nm);
    if (!p.departure_Nm || !hci_predicted_reading_make(e, &u->effects.list, true, &reading)) {
        hci_memory_free(p.departure_Nm);
        return hci_note_memory(note, NULL, "what was promised");
    }
    p.square = p.departure_Nm + u->machines;
    for (const hci_segment *s = NULL; (s = hci_segment_next(e->samples, run, s)) != NULL;) {
        hci_predicted_reading_fill(e, &u->effects.list, s, &reading);
        for (size_t j = 0; j < s->count; ++j)
            sample_add(&p, reading.by_value + j * reading.terms, e->samples->sample[s->first + j].count);
    }
    *open_Nm = rms_exceeded(&p);
    hci_predicted_reading_release(&reading);
    hci_memory_free(p.departure_Nm);
    return HCI_OK;
}

/* ---- the new recordings ---- */

static const hci_run_errors *errors_of(const hci_diagnosis *d, const char *file)
{
    for (size_t k = 0; k < d->runs; ++k)
        if (d->run[k].file == file) return &d->run[k];
    return NULL;
}

static double beside_noise(double rms_Nm, double noise_Nm)
{
    return fmax(0.0, rms_Nm * rms_Nm - noise_Nm * noise_Nm);
}

/* Of the noise: more is left of no recording of a machine that explains them, but of one that disagreed. */
#define DISAGREES 4.0

/* What the machine of last time left, beside the noise, of a recording that it was fitted to: the most of
 * those whose torque is known in the same way. It leaves no less of a new one. */
static double left_before_Nm(const hci_again_question *q, const hci_diagnosis *then, hci_torque_source source)
{
    double most_Nm = 0.0;
    for (size_t k = 0; k < q->recordings_before; ++k) {
        const hci_run_errors *e = errors_of(then, q->runs->run[k].name);
        if (!e || e->source != source || e->role != HCI_ROLE_FIT ||
            e->rms_after_Nm > DISAGREES * e->noise_floor_Nm)
            continue;
        most_Nm = fmax(most_Nm, sqrt(beside_noise(e->rms_after_Nm, e->noise_floor_Nm)));
    }
    return most_Nm;
}

/* Only noise is larger by chance where samples are few; and how large it is was found from as many. open_Nm:
 * what is stated beside the noise. */
static hci_again_run run_of(const hci_run_errors *last, const hci_run_errors *now, double open_Nm)
{
    const double above = last->rms_after_Nm > 0.0 ? last->after_high_Nm / last->rms_after_Nm - 1.0 : 0.0;
    const double by_chance = 1.0 + sqrt(2.0) * above;
    const double bound_Nm = hypot(open_Nm, last->noise_floor_Nm * by_chance);
    return (hci_again_run){.file = last->file,
                           .role = last->role,
                           .declared_Nm = last->rms_before_Nm,
                           .last_Nm = last->rms_after_Nm,
                           .last_mean_Nm = last->error_mean_after_Nm,
                           .last_ripple_Nm = last->ripple_after_Nm,
                           .now_Nm = now ? now->rms_after_Nm : (double)NAN,
                           .noise_Nm = last->noise_floor_Nm,
                           .bound_Nm = bound_Nm,
                           .kept = last->rms_after_Nm <= bound_Nm};
}

static hci_status played_fill(const hci_again_question *q, size_t run, const last_diagnosis *last,
                              const hci_again *a, hci_again_run *to, hci_note *note)
{
    const hci_run *r = &q->runs->run[run];
    to->path = q->runs->origin && q->runs->origin[run].path ? q->runs->origin[run].path : r->name;
    return hci_played_judge(&a->solved, r, q->machine->model.pole_pairs, &last->effects.list, &to->played,
                            note);
}

/* A diagnosis, and the errors of the machine of last time on the same runs. */
typedef struct {
    const hci_diagnosis *then, *now;
} both_diagnoses;

static hci_status runs_fill(const hci_again_question *q, const hci_dataset *b, const last_diagnosis *last,
                            const both_diagnoses *d, hci_again *a, hci_note *note)
{
    hci_status status = HCI_OK;
    a->run = hci_memory_new(q->runs->count + 1, sizeof *a->run);
    if (!a->run) return hci_note_memory(note, NULL, "the new recordings");
    for (size_t k = q->recordings_before; k < q->runs->count && !status; ++k) {
        const hci_run_errors *e = errors_of(d->then, q->runs->run[k].name);
        double open_Nm;
        if (!e) continue;
        status = open_of(b, &last->uncertainty, k, &open_Nm, note);
        if (status) break;
        open_Nm = hypot(open_Nm, left_before_Nm(q, d->then, e->source));
        a->run[a->runs] = run_of(e, errors_of(d->now, e->file), open_Nm);
        status = played_fill(q, k, last, a, &a->run[a->runs++], note);
    }
    return status;
}

static double mean_square_root(const hci_again *a, size_t member)
{
    double sum = 0.0;
    for (size_t k = 0; k < a->runs; ++k) {
        const double x = *(const double *)(const void *)((const char *)&a->run[k] + member);
        sum += x * x;
    }
    return a->runs > 0 ? sqrt(sum / (double)a->runs) : (double)NAN;
}

static void totals_fill(hci_again *a)
{
    for (size_t k = 0; k < a->runs; ++k) {
        a->bounded += isfinite(a->run[k].bound_Nm) != 0;
        a->kept += a->run[k].kept;
    }
    a->declared_Nm = mean_square_root(a, offsetof(hci_again_run, declared_Nm));
    a->last_Nm = mean_square_root(a, offsetof(hci_again_run, last_Nm));
    a->now_Nm = mean_square_root(a, offsetof(hci_again_run, now_Nm));
    a->noise_Nm = mean_square_root(a, offsetof(hci_again_run, noise_Nm));
    a->bound_Nm = mean_square_root(a, offsetof(hci_again_run, bound_Nm));
}

/* ---- what the new recordings alone say of an effect that left ---- */

static const hci_effect *effect_in(const hci_effects *list, const char *name)
{
    for (size_t k = 0; k < list->count; ++k)
        if (strcmp(list->effect[k].type->name, name) == 0) return &list->effect[k];
    return NULL;
}

/* All effects but one; the array is to be freed. */
static hci_status without(const hci_effects *list, const hci_effect *one, hci_effect **effect,
                          hci_effects *rest, hci_note *note)
{
    *effect = hci_memory_new(list->count + 1, sizeof **effect);
    *rest = (hci_effects){*effect, 0};
    if (!*effect) return hci_note_memory(note, NULL, "the effects of the last machine");
    for (size_t k = 0; k < list->count; ++k)
        if (&list->effect[k] != one) (*effect)[rest->count++] = list->effect[k];
    return HCI_OK;
}

static double readings_of(const hci_binned_samples *samples, size_t run)
{
    double count = 0.0;
    for (const hci_segment *s = NULL; (s = hci_segment_next(samples, run, s)) != NULL;)
        for (size_t j = s->first; j < s->first + s->count; ++j)
            count += samples->sample[j].count;
    return count;
}

/* Twice a logarithm of likelihoods, as of ΔBIC; and the share of what is not noise that has to go with it, so
 * that it is no accident of a machine which does not describe them. */
#define DECISIVE 10.0
#define MATERIAL 0.1

/* Of squares that are left with an effect and without it, and of their noise. */
typedef struct {
    double evidence, excess, change;
} balance;

static void weigh(balance *x, double n, double there, double gone, double noise)
{
    if (!(there + noise > 0.0 && gone + noise > 0.0)) return;
    x->evidence += n * log((gone + noise) / (there + noise));
    x->excess += n * fmax(there, gone);
    x->change += n * (gone - there);
}

static hci_again_speaks speaks_of_balance(const balance *x)
{
    if (fabs(x->evidence) < DECISIVE || fabs(x->change) < MATERIAL * x->excess) return HCI_AGAIN_SILENT;
    return x->change > 0.0 ? HCI_AGAIN_FOR : HCI_AGAIN_AGAINST;
}

/* By ripple and mean, each beside what is left of it: what speaks for an effect in either keeps it from being
 * contradicted. with, rest: errors of the last machine on all runs, with the effect and without. */
static hci_again_speaks speaks_of(const hci_again_question *q, const hci_dataset *b,
                                  const hci_diagnosis *with, const hci_diagnosis *rest)
{
    balance ripple = {0.0, 0.0, 0.0}, mean = {0.0, 0.0, 0.0};
    for (size_t k = q->recordings_before; k < q->runs->count; ++k) {
        const hci_run_errors *x = errors_of(with, q->runs->run[k].name),
                             *y = errors_of(rest, q->runs->run[k].name);
        if (!x || !y) continue;
        const double n = readings_of(&b->samples, k), noise_Nm = fmin(x->noise_floor_Nm, y->noise_floor_Nm);
        weigh(&ripple, n, beside_noise(x->ripple_after_Nm, noise_Nm),
              beside_noise(y->ripple_after_Nm, noise_Nm), noise_Nm * noise_Nm);
        weigh(&mean, n, pow(x->error_mean_after_Nm, 2.0), pow(y->error_mean_after_Nm, 2.0),
              noise_Nm * noise_Nm);
    }
    const hci_again_speaks by_ripple = speaks_of_balance(&ripple), by_mean = speaks_of_balance(&mean);
    if (by_ripple == HCI_AGAIN_FOR || by_mean == HCI_AGAIN_FOR) return HCI_AGAIN_FOR;
    return by_ripple == HCI_AGAIN_AGAINST ? by_ripple : by_mean;
}

static hci_status ask_without(const hci_again_question *q, hci_dataset *b, const last_diagnosis *last,
                              const hci_diagnosis *then, hci_again_effect *e, hci_note *note)
{
    const hci_effects *list = &last->effects.list;
    const hci_effect *one = effect_in(list, e->effect);
    hci_effect *effect = NULL;
    hci_effects rest;
    hci_diagnosis d = {0};
    if (!one) return HCI_OK; /* it was ambiguous, and in no machine */
    hci_status status = without(list, one, &effect, &rest, note);
    if (!status) status = hci_run_errors_of(b, q->runs, &rest, &d, note);
    if (!status) e->speaks = speaks_of(q, b, then, &d);
    hci_memory_free(d.run);
    hci_memory_free(effect);
    return status;
}

static hci_status speaks_fill(const hci_again_question *q, hci_dataset *b, const last_diagnosis *last,
                              const hci_diagnosis *then, hci_again *a, hci_note *note)
{
    hci_status status = HCI_OK;
    for (size_t k = 0; k < a->effects && !status; ++k)
        if (a->effect[k].change == HCI_AGAIN_LEFT)
            status = ask_without(q, b, last, then, &a->effect[k], note);
    return status;
}

static hci_status new_runs_fill(const hci_again_question *q, const last_diagnosis *last,
                                const hci_diagnosis *d, hci_again *a, hci_note *note)
{
    hci_dataset b;
    hci_diagnosis then = {.effects = last->effects};
    hci_status status = hci_dataset_make(q->machine, q->declared, q->runs, &b, note);
    if (status) return status;
    status = hci_run_errors_fill(&b, q->runs, 0, &then, note);
    if (!status) status = runs_fill(q, &b, last, &(both_diagnoses){&then, d}, a, note);
    if (!status) status = speaks_fill(q, &b, last, &then, a, note);
    then.effects = (hci_effects_data){0};
    hci_diagnosis_release(&then);
    hci_dataset_release(&b);
    totals_fill(a);
    return status;
}

/* ---- effects ---- */

static const hci_effect_term *term_in(const hci_effect *effect, const hci_effect_term *as)
{
    for (size_t k = 0; effect && k < effect->count; ++k)
        if (effect->term[k].parameter == as->parameter &&
            fabs(effect->term[k].order - as->order) < HCI_ORDER_TOLERANCE)
            return &effect->term[k];
    return NULL;
}

/* The larger of both errors: the later fit has most of the recordings of the earlier one, so that the change
 * scatters by less than each value. NAN without. */
static double error_of(const hci_effect_term *then, const hci_effect_term *now)
{
    return fmax(then->std_error, now->std_error);
}

static void term_words(const hci_effect_type *type, const hci_effect_term *then, const hci_effect_term *now,
                       hci_again_effect *to)
{
    const hci_effect_parameter *p = &type->parameter[then->parameter];
    char order[32] = "";
    if (p->ordered) snprintf(order, sizeof order, "_%.6g", then->order);
    snprintf(to->words, sizeof to->words, "%s%s from %.4g ± %.2g to %.4g ± %.2g %s", p->name, order,
             then->value, then->std_error, now->value, now->std_error, strcmp(p->unit, "1") ? p->unit : "");
}

/* Of so many values the largest change is larger by chance than that of one. */
static void terms_compare(const hci_effect *then, const hci_effect *now, hci_again_effect *to)
{
    size_t count = 0;
    for (size_t k = 0; k < then->count; ++k) {
        const hci_effect_term *x = &then->term[k], *y = term_in(now, x);
        const double error = y ? error_of(x, y) : (double)NAN;
        if (!(error > 0.0)) continue;
        const double deviations = fabs(y->value - x->value) / error;
        ++count;
        if (deviations <= to->deviations) continue;
        to->deviations = deviations;
        term_words(then->type, x, y, to);
    }
    if (count > 0 && (double)count * erfc(to->deviations / sqrt(2.0)) < EXCEEDED)
        to->change = HCI_AGAIN_CHANGED;
}

static bool is_ambiguous(const hci_diagnosis *d, const char *effect)
{
    for (size_t k = 0; k < d->findings; ++k)
        if (strcmp(d->finding[k].effect, effect) == 0) return d->finding[k].verdict == HCI_FINDING_AMBIGUOUS;
    return false;
}

/* Whether its values stand on top of the declared cogging torque, and are others without that. */
static bool is_beside_cogging(const hci_effect_type *type)
{
    return type->any_phase;
}

static hci_status effect_compare(const last_diagnosis *last, const hci_diagnosis *d, const char *name,
                                 hci_again *a, hci_note *note)
{
    const hci_effect *then = effect_in(&last->effects.list, name), *now = effect_in(&d->effects.list, name);
    hci_again_effect x = {.effect = name, .is_ambiguous = is_ambiguous(d, name), .deviations = NAN};
    const hci_status status = was_ambiguous(last, name, &x.was_ambiguous, note);
    if (status || (!then && !now && !x.was_ambiguous && !x.is_ambiguous)) return status;
    if (a->effects == HCI_MOST_FINDINGS) return HCI_OK;
    x.change = now && !then ? HCI_AGAIN_CAME : !now ? HCI_AGAIN_LEFT : HCI_AGAIN_STAYS;
    if (then && now && !(d->without_cogging && is_beside_cogging(then->type))) {
        x.deviations = -1.0;
        terms_compare(then, now, &x);
        if (x.deviations < 0.0) x.deviations = NAN;
    }
    a->effect[a->effects++] = x;
    return HCI_OK;
}

static hci_status effects_fill(const last_diagnosis *last, const hci_diagnosis *d, hci_again *a,
                               hci_note *note)
{
    hci_status status = HCI_OK;
    for (size_t k = 0; hci_effect_type_at(k) && !status; ++k)
        status = effect_compare(last, d, hci_effect_type_at(k)->name, a, note);
    return status;
}

/* ---- all of it ---- */

hci_status hci_again_find(const hci_again_question *q, hci_diagnosis *d, hci_again *a, hci_note *note)
{
    last_diagnosis last;
    memset(a, 0, sizeof *a);
    a->recordings_before = q->recordings_before;
    a->without_cogging = d->without_cogging;
    hci_status status = last_read(q->folder, &last, note);
    if (!status) status = hci_solved_currents_find(q->folder, &a->solved, note);
    if (!status) status = effects_fill(&last, d, a, note);
    if (!status) status = new_runs_fill(q, &last, d, a, note);
    last_release(&last);
    if (status) hci_again_release(a);
    d->again = status ? NULL : a;
    return status;
}

bool hci_again_is_bad(const hci_again *a)
{
    bool is_bad = false;
    for (size_t k = 0; k < a->runs; ++k)
        is_bad = is_bad || hci_played_is_bad(&a->run[k].played);
    return is_bad;
}

void hci_again_release(hci_again *a)
{
    hci_solved_currents_release(&a->solved);
    hci_memory_free(a->run);
    memset(a, 0, sizeof *a);
}
