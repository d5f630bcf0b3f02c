#include "host/diagnose/next_points.h"
#include "hci/math/harmonic.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "host/base/memory.h"
#include "host/base/words.h"
#include "host/diagnose/fit/fit.h"
#include "host/diagnose/next/open_points.h"
#include "host/diagnose/next/tell_apart.h"
#include "host/diagnose/next/unknown_points.h"
#include "host/diagnose/reading/predicted_reading.h"

enum {
    MOST_PAIRS = 16,
    EACH_TWICE = 2,   /* points for a pair, so that no answer hangs on one run */
    MOST_UNKNOWN = 4, /* points for what is not known */
    LONGEST_ADVICE = 240
};

#define ENOUGH (5.0 * HCI_TELLS) /* more is no better: less effort is */

const char *hci_next_test_name(hci_torque_source source)
{
    return source == HCI_TORQUE_HOLDING ? "holding" : source == HCI_TORQUE_INERTIA ? "free" : "dyno";
}

/* ---- words ---- */

/* Begins a sentence of the advice; false where there is no more room for one. */
static bool advice_begin(hci_diagnosis *d)
{
    if (strlen(d->advice) + LONGEST_ADVICE > sizeof d->advice) return false;
    if (d->advice[0]) hci_words_say(&(hci_words){d->advice, sizeof d->advice}, "; ");
    return true;
}

/* Under position control a drive makes the i_q that the shaft takes, and few take an i_d beside it. */
static void advice_of_slow_turn(hci_diagnosis *d, const hci_next_point *p)
{
    const hci_words w = {d->advice, sizeof d->advice};
    hci_words_say(&w, "%.4g turns under slow control, i_q as it comes, at %.4g rad/s (mechanical)", p->turns,
                  p->speed_rad_per_s);
    if (fabs(p->id_A) > 0.0)
        hci_words_say(&w, " with i_d %.3g A, where the drive takes one beside its position control", p->id_A);
}

static void advice_of_point(hci_diagnosis *d, const hci_next_point *p)
{
    if (p->source == HCI_TORQUE_HOLDING) {
        advice_of_slow_turn(d, p);
        return;
    }
    hci_words_say(&(hci_words){d->advice, sizeof d->advice}, "%.4g turns at i_d %.3g A, ", p->turns, p->id_A);
    if (isfinite(p->iq_A))
        hci_words_say(&(hci_words){d->advice, sizeof d->advice}, "i_q %.3g A, ", p->iq_A);
    else
        hci_words_say(&(hci_words){d->advice, sizeof d->advice}, "i_q as it comes, ");
    hci_words_say(&(hci_words){d->advice, sizeof d->advice}, "%.4g rpm (%.4g rad/s)",
                  p->speed_rad_per_s * 30.0 / HCI_PI, p->speed_rad_per_s);
}

/* ---- points ---- */

static bool is_at(const hci_next_point *p, const hci_operating_point *x)
{
    const bool same_q = p->iq_A == x->iq_A || (isnan(p->iq_A) && isnan(x->iq_A));
    return p->id_A == x->id_A && same_q && p->speed_rad_per_s == x->speed_rad_per_s;
}

/* The row of an operating point; a new one where there is none. NULL: no room. */
static hci_next_point *row_of(hci_diagnosis *d, const hci_playable *playable, const hci_operating_point *x)
{
    for (size_t k = 0; k < d->next_points; ++k)
        if (is_at(&d->next[k], x)) return &d->next[k];
    if (d->next_points == HCI_MOST_NEXT_POINTS) return NULL;
    hci_next_point *p = &d->next[d->next_points++];
    *p = (hci_next_point){x->id_A, x->iq_A, x->speed_rad_per_s, HCI_LEAST_TURNS, playable->source, 0.0, ""};
    return p;
}

/* ---- two explanations ---- */

typedef struct {
    const hci_verdict *verdict;
    hci_fitted_model without;   /* of an effect that hangs on one run: the model without it; else empty */
    double *chi_square, *turns; /* [points] */
    size_t wanted;              /* points that are still to be found */
} pair;

typedef struct {
    hci_playable playable;
    hci_operating_point point[HCI_OPERATING_POINTS];
    size_t points, pairs;
    pair pair[MOST_PAIRS];
} comparison;

/* With fewer than all runs it is not found. */
static bool is_unstable(const hci_verdict *v)
{
    return v->in && !v->ambiguous && v->stays < v->left_out;
}

static bool acts_with_current_alone(const hci_effect_type *type)
{
    for (size_t k = 0; k < type->parameter_count; ++k)
        if (!(type->parameter[k].traits & HCI_PARAMETER_WITH_CURRENT)) return false;
    return true;
}

/* Without a current nothing is seen of an effect of the current: there the models differ by what the one
 * without it has put into other terms, which such runs tell whether or not the effect is there. */
static void leave_currentless_out(const comparison *c, const pair *p)
{
    const hci_verdict *v = p->verdict;
    if (!acts_with_current_alone(v->type) || (!v->in && !acts_with_current_alone(v->rival_of))) return;
    for (size_t k = 0; k < c->points; ++k)
        if (isfinite(c->point[k].iq_A) && !(hypot(c->point[k].id_A, c->point[k].iq_A) > 0.0))
            p->chi_square[k] = 0.0;
}

static hci_status pair_add(const hci_regression *e, const hci_attribution *a, const hci_verdict *v,
                           comparison *c, hci_note *note)
{
    pair *p = &c->pair[c->pairs++];
    hci_explanations x = {&a->model.candidates, &v->alternative.candidates};
    hci_status status = HCI_OK;
    *p = (pair){.verdict = v, .wanted = EACH_TWICE};
    p->chi_square = hci_memory_new(2 * HCI_OPERATING_POINTS, sizeof *p->chi_square);
    if (!p->chi_square) return hci_note_memory(note, NULL, "what to measure next");
    p->turns = p->chi_square + HCI_OPERATING_POINTS;
    if (v->in) {
        x.wrong = &p->without.candidates;
        status = hci_fitted_model_copy(&a->model, &p->without, note);
        if (status) return status;
        hci_candidates_remove_type(&p->without.candidates, v->type);
        status = hci_regression_fit(e, &p->without.candidates, &p->without.fit, note);
    }
    if (status) return status;
    const hci_point_scores scores = {c->point, c->points, p->chi_square, p->turns};
    status = hci_tell_apart(e, &c->playable, &x, &scores, note);
    if (!status) leave_currentless_out(c, p);
    return status;
}

static hci_status pairs_add(const hci_regression *e, const hci_attribution *a, comparison *c, hci_note *note)
{
    hci_status status = HCI_OK;
    for (size_t r = 0; r < a->types && !status && c->pairs < MOST_PAIRS; ++r) {
        const hci_verdict *v = &a->verdict[r];
        const bool rival = !v->in && v->ambiguous && v->alternative.candidates.candidate;
        if (rival || is_unstable(v)) status = pair_add(e, a, v, c, note);
    }
    return status;
}

static void comparison_release(comparison *c)
{
    for (size_t k = 0; k < c->pairs; ++k) {
        hci_memory_free(c->pair[k].chi_square);
        hci_fitted_model_release(&c->pair[k].without);
    }
}

/* ---- the choice ---- */

/* What a point tells of the pairs that want one, in least turns. */
static double told_at(const comparison *c, size_t k)
{
    double sum = 0.0;
    for (size_t j = 0; j < c->pairs; ++j) {
        const pair *p = &c->pair[j];
        if (p->wanted > 0 && p->chi_square[k] > HCI_NOTHING)
            sum += fmin(ENOUGH, p->chi_square[k]) * HCI_LEAST_TURNS / p->turns[k];
    }
    return sum;
}

static void pair_words(const pair *p, size_t k, hci_next_point *to)
{
    const hci_verdict *v = p->verdict;
    if (to->why[0]) hci_words_say(&(hci_words){to->why, sizeof to->why}, "; ");
    if (v->in)
        hci_words_say(&(hci_words){to->why, sizeof to->why}, "shows whether there is %s (χ² %.3g)",
                      v->type->name, p->chi_square[k]);
    else
        hci_words_say(&(hci_words){to->why, sizeof to->why}, "tells %s from %s (χ² %.3g)", v->rival_of->name,
                      v->type->name, p->chi_square[k]);
}

/* Takes a point: every pair that it tells apart wants one less. */
static void point_take(comparison *c, size_t k, hci_diagnosis *d)
{
    hci_next_point *to = row_of(d, &c->playable, &c->point[k]);
    for (size_t j = 0; j < c->pairs && to; ++j) {
        pair *p = &c->pair[j];
        if (p->wanted == 0 || !(p->chi_square[k] > HCI_NOTHING)) continue;
        to->turns = fmax(to->turns, p->turns[k]);
        to->chi_square += p->chi_square[k];
        pair_words(p, k, to);
        --p->wanted;
    }
}

static void points_choose(comparison *c, hci_diagnosis *d)
{
    bool taken[HCI_OPERATING_POINTS] = {false};
    while (d->next_points < HCI_MOST_NEXT_POINTS) {
        double most = 0.0;
        size_t best = 0;
        for (size_t k = 0; k < c->points; ++k) {
            const double told = taken[k] ? 0.0 : told_at(c, k);
            if (told <= most * (1.0 + 1e-9)) continue;
            most = told;
            best = k;
        }
        if (!(most > 0.0)) return;
        taken[best] = true;
        point_take(c, best, d);
    }
}

/* ---- advice of pairs ---- */

/* The row that tells most of a pair; NULL: none. */
static const hci_next_point *best_row(const comparison *c, const pair *p, const hci_diagnosis *d,
                                      double *chi_square)
{
    const hci_next_point *best = NULL;
    *chi_square = HCI_NOTHING;
    for (size_t r = 0; r < d->next_points; ++r)
        for (size_t k = 0; k < c->points; ++k)
            if (is_at(&d->next[r], &c->point[k]) && p->chi_square[k] > *chi_square) {
                best = &d->next[r];
                *chi_square = p->chi_square[k];
            }
    return best;
}

static void advice_of_pair(const comparison *c, const pair *p, hci_diagnosis *d)
{
    double chi_square;
    const hci_verdict *v = p->verdict;
    const hci_next_point *row = best_row(c, p, d, &chi_square);
    char names[128];
    snprintf(names, sizeof names, v->in ? "%s%s" : "%s or %s", v->in ? v->type->name : v->rival_of->name,
             v->in ? "" : v->type->name);
    if (!advice_begin(d)) return;
    if (!row) {
        hci_words_say(&(hci_words){d->advice, sizeof d->advice},
                      "%s: no steady run within these currents and speeds tells; it takes another kind of "
                      "measurement",
                      names);
        return;
    }
    hci_words_say(&(hci_words){d->advice, sizeof d->advice}, "%s: ", names);
    advice_of_point(d, row);
    hci_words_say(&(hci_words){d->advice, sizeof d->advice},
                  v->in ? " would show it (χ² %.3g)" : " would tell them apart (χ² %.3g)", chi_square);
}

/* For terms that are the same in all runs, where the one is a part of the other. */
static void advice_of_same(const hci_attribution *a, hci_diagnosis *d)
{
    if (a->inertia_as_well && advice_begin(d))
        hci_words_say(&(hci_words){d->advice, sizeof d->advice},
                      "torque per ampere or inertia: the voltages of the open terminals would tell while the "
                      "shaft coasts or another "
                      "motor turns it, or spins with a disc of known inertia; a torque sensor as well");
    for (size_t r = 0; r < a->types; ++r) {
        const hci_verdict *v = &a->verdict[r];
        if (v->in || !v->ambiguous || v->alternative.candidates.candidate || !advice_begin(d)) continue;
        hci_words_say(&(hci_words){d->advice, sizeof d->advice},
                      "%s or %s: a run with %s would tell them apart", v->rival_of->name, v->type->name,
                      v->type->told_by ? v->type->told_by : "another current, speed and direction");
    }
}

hci_status hci_next_points_tell_apart(const hci_regression *e, const hci_machine_data *machine,
                                      const hci_attribution *a, hci_diagnosis *d, hci_note *note)
{
    comparison *c = hci_memory_new(1, sizeof *c);
    if (!c) return hci_note_memory(note, NULL, "what to measure next");
    c->playable = hci_playable_of(e, machine);
    c->points = hci_operating_points(&c->playable, c->point);
    const hci_status status = pairs_add(e, a, c, note);
    if (!status) points_choose(c, d);
    for (size_t k = 0; k < c->pairs && !status; ++k)
        advice_of_pair(c, &c->pair[k], d);
    if (!status) advice_of_same(a, d);
    comparison_release(c);
    hci_memory_free(c);
    return status;
}

/* ---- what is not known ---- */

/* Orders that no effect explains. Returns how many. */
static size_t orders_of(const hci_diagnosis *d, double order[HCI_MOST_UNEXPLAINED])
{
    for (size_t k = 0; k < d->unexplained_count; ++k)
        order[k] = d->unexplained[k].order;
    return d->unexplained_count;
}

/* What is new about a point that no recording is near. */
static void words_of_new(const hci_regression *e, const hci_operating_point *x, hci_next_point *to)
{
    bool current = false, without = false, way = false, unused = false;
    for (size_t r = 0; r < e->samples->run_count; ++r) {
        const hci_run_statistics *f = &e->samples->statistics[r];
        const bool this_way = f->both_ways || f->mean_speed_rad_per_s * x->speed_rad_per_s > 0.0;
        unused = unused || this_way;
        if (!hci_segment_next(e->samples, r, NULL)) continue;
        current = current || f->current_A > 0.0;
        without = without || !(f->current_A > 0.0);
        way = way || this_way;
    }
    const bool none = x->id_A == 0.0 && x->iq_A == 0.0;
    hci_words_say(&(hci_words){to->why, sizeof to->why}, "%s",
                  none && !without    ? "no recording without current so far"
                  : !none && !current ? "no recording with current so far"
                  : !way && unused    ? "no recording in this direction that tells a torque so far"
                  : !way              ? "no recording in this direction so far"
                                      : "furthest from all recordings so far");
}

static void points_add(const hci_regression *e, const hci_playable *playable, const hci_point_choice *choice,
                       size_t found, hci_diagnosis *d)
{
    for (size_t k = 0; k < found; ++k) {
        const hci_telling_point *t = &choice->chosen[k];
        hci_next_point *to = row_of(d, playable, &choice->point[t->point]);
        if (!to) return;
        if (to->why[0]) hci_words_say(&(hci_words){to->why, sizeof to->why}, "; ");
        if (isnan(t->order)) {
            words_of_new(e, &choice->point[t->point], to);
            continue;
        }
        to->chi_square += t->chi_square;
        hci_words_say(&(hci_words){to->why, sizeof to->why},
                      "laws of growth that describe order %.6g as well differ by %.2g N·m here (χ² %.3g)",
                      t->order, t->spread_Nm, t->chi_square);
    }
}

/* Whether the bench of the recordings can do it as it is. */
static bool is_at_hand(const hci_next_point *p)
{
    return p->source != HCI_TORQUE_HOLDING || !(fabs(p->id_A) > 0.0);
}

static void advice_of_unknown(hci_diagnosis *d, size_t before)
{
    size_t k = before;
    while (k < d->next_points && !is_at_hand(&d->next[k]))
        ++k;
    if (k == d->next_points || !advice_begin(d)) return;
    hci_words_say(&(hci_words){d->advice, sizeof d->advice}, "what is not known: ");
    advice_of_point(d, &d->next[k]);
    hci_words_say(&(hci_words){d->advice, sizeof d->advice}, " would say %s (%s)",
                  k == before ? "most" : "more", d->next[k].why);
}

hci_status hci_next_points_unknown(const hci_regression *e, const hci_machine_data *machine, hci_diagnosis *d,
                                   hci_note *note)
{
    hci_operating_point point[HCI_OPERATING_POINTS];
    hci_telling_point chosen[MOST_UNKNOWN];
    double order[HCI_MOST_UNEXPLAINED];
    size_t found = 0;
    const size_t before = d->next_points, orders = orders_of(d, order);
    if (d->verdict != HCI_DIAGNOSIS_PARTLY && d->verdict != HCI_DIAGNOSIS_UNKNOWN) return HCI_OK;
    const hci_playable playable = hci_playable_of(e, machine);
    const hci_point_choice choice = {point, hci_operating_points(&playable, point), MOST_UNKNOWN, chosen};
    double *residual_Nm = hci_memory_new(e->samples->count + 1, sizeof *residual_Nm);
    if (!residual_Nm) return hci_note_memory(note, NULL, "what to measure next");
    hci_status status = hci_regression_residual(e, &d->effects.list, residual_Nm, note);
    if (!status && orders > 0)
        status = hci_points_of_growth(e, &(hci_open_orders){residual_Nm, order, orders}, &playable, &choice,
                                      &found, note);
    if (!status && found == 0) found = hci_points_not_recorded(e, &playable, &choice);
    hci_memory_free(residual_Nm);
    if (status) return status;
    points_add(e, &playable, &choice, found, d);
    advice_of_unknown(d, before);
    return HCI_OK;
}

/* ---- what makes the same torque ---- */

static void words_of_open(const hci_open_point *x, hci_next_point *to)
{
    const hci_words w = {to->why, sizeof to->why};
    if (to->why[0]) hci_words_say(&w, "; ");
    if (x->twin[0])
        hci_words_say(&w, "tells %s from %s, which make the same torque in the recordings (χ² %.3g)",
                      x->found, x->twin, x->chi_square);
    else
        hci_words_say(&w, "machines that the recordings allow differ by %.2g N·m rms here (χ² %.3g)",
                      x->spread_Nm, x->chi_square);
}

/* Whether a drive can play a point, and no recording is one of it. */
static bool is_playable(const hci_playable *playable, const hci_operating_point *at)
{
    const hci_next_point x = {.id_A = at->id_A, .iq_A = at->iq_A, .speed_rad_per_s = at->speed_rad_per_s};
    hci_operating_point point[HCI_OPERATING_POINTS];
    const size_t count = hci_operating_points(playable, point);
    for (size_t k = 0; k < count; ++k)
        if (is_at(&x, &point[k])) return true;
    return false;
}

/* The same point in the other direction: a run in one alone does not tell its friction from the zero of the
 * sensor. false: there is no such row. */
static bool way_back_add(const hci_playable *playable, const hci_next_point *there, hci_diagnosis *d)
{
    const hci_operating_point back = {there->id_A, there->iq_A, -there->speed_rad_per_s};
    const double turns = there->turns;
    hci_next_point *to = is_playable(playable, &back) ? row_of(d, playable, &back) : NULL;
    if (!to) return false;
    to->turns = fmax(to->turns, turns);
    if (!to->why[0])
        hci_words_say(&(hci_words){to->why, sizeof to->why},
                      "the same back, which tells its friction from the zero of the torque sensor");
    return true;
}

static void advice_of_open(const hci_open_point *x, const hci_next_point *p, bool both_ways, hci_diagnosis *d)
{
    const hci_words w = {d->advice, sizeof d->advice};
    if (!advice_begin(d)) return;
    if (x->twin[0])
        hci_words_say(&w, "what was found as %s may be %s in part: ", x->found, x->twin);
    else
        hci_words_say(&w, "what these currents do not show: ");
    advice_of_point(d, p);
    hci_words_say(&w, "%s would tell (χ² %.3g)", both_ways ? ", forward and back," : "", x->chi_square);
}

hci_status hci_next_points_left_open(const hci_regression *e, const hci_machine_data *machine,
                                     hci_diagnosis *d, hci_note *note)
{
    hci_operating_point point[HCI_OPERATING_POINTS];
    hci_open_point open;
    bool found = false;
    const hci_playable playable = hci_playable_of(e, machine);
    const hci_status status =
        hci_open_points_find(&machine->model, &d->uncertainty, &playable, &open, &found, note);
    if (status || !found) return status;
    hci_operating_points(&playable, point);
    hci_next_point *to = row_of(d, &playable, &point[open.point]);
    if (!to) return HCI_OK;
    to->chi_square += open.chi_square;
    words_of_open(&open, to);
    advice_of_open(&open, to, way_back_add(&playable, to, d), d);
    return HCI_OK;
}
