/* In: a task and the angle between two samples; out: currents, with high orders priced where the sampling
 * leaves much of them. */
#include "host/solution/hold.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "hci/host/base/number.h"
#include "host/base/memory.h"
#include "host/solution/hold_least.h"
#include "host/solve/linear.h"
#include "host/solve/newton.h"
#include "host/solve/pointwise.h"
#include "host/solve/torque_spectrum.h"

enum { ANGLES = 2048, BISECTIONS = 16, MOST_NAMED = 4 };

static const double ENOUGH = 0.01, /* ripple as a share of the mean torque that needs no price */
    DEFAULT_LOSS = 1.5,            /* most copper over that without a price */
    LEAST_PRICE = 1e-18, MOST_PRICE = 1e-2;
static const double WORTH = 0.9;     /* share of the ripple without a price above which there is none */
static const double REDUCED = 0.7;   /* share of its current below which a component is named */
static const double NO_WORSE = 1e-3; /* share by which the error of the torque may grow */
static const double SAME = 1e-6;     /* share of the ripple within which it is that of the same currents */

/* ---- what the hold leaves ---- */

double hci_hold_ripple_Nm(const hci_task *t, const hci_wave *current, size_t count, double sample_rad)
{
    const size_t angles = ANGLES * t->period_turns;
    hci_wave *missed = hci_memory_new(count + 1, sizeof *missed);
    double high = 0.0, low = 0.0;
    for (size_t k = 0; missed && k < count; ++k) {
        const double step_rad = (current[k].order - current[k].sequence) * sample_rad,
                     share = 0.125 * step_rad * step_rad;
        missed[k] = current[k];
        missed[k].sine *= share;
        missed[k].cosine *= share;
    }
    for (size_t k = 0; missed && k < angles; ++k) {
        const double theta_rad = 2.0 * HCI_PI * (double)k / ANGLES;
        double by[3], i[3];
        hci_waves_at(t->gradient, t->gradient_count, theta_rad, by);
        hci_waves_at(missed, count, theta_rad, i);
        const double torque_Nm = by[0] * i[0] + by[1] * i[1] + by[2] * i[2];
        high = fmax(high, torque_Nm);
        low = fmin(low, torque_Nm);
    }
    hci_memory_free(missed);
    return high - low;
}

/* ---- an answer at a price ---- */

typedef struct {
    hci_task *task;
    const hci_solve_options *options;
    hci_linear_torque *at;
    hci_solution *solution;
    double mean_Nm;
    const hci_limited *of;
    bool is_given; /* whether the answer has currents and no parts of them */
} question;

static question question_of(const hci_limited *of)
{
    return (question){.task = of->task,
                      .options = of->options,
                      .at = of->at,
                      .solution = of->solution,
                      .mean_Nm = hci_target_mean_Nm(of->options->target),
                      .of = of};
}

static hci_status ask(const question *q, hci_answer *a, hci_note *note)
{
    hci_answer_release(a);
    if (q->options->method == HCI_METHOD_POINTWISE)
        return hci_pointwise_answer(q->task, a, q->solution, note);
    if (!hci_task_is_linear(q->task))
        return hci_newton_answer(q->task, q->options, q->at, a, q->solution, note);
    return hci_linear_answer(q->task, q->options, NULL, a, q->solution, note);
}

static hci_wave wave_of(const question *q, const hci_answer *a, size_t k)
{
    const size_t n = 2 * a->set.count;
    return (hci_wave){a->set.component[k].order, a->set.component[k].sequence,
                      hci_coordinate(a->x, n, q->mean_Nm, 2 * k),
                      hci_coordinate(a->x, n, q->mean_Nm, 2 * k + 1)};
}

/* The error of the torque. wave: room for one more, that of a fundamental that is held. */
static hci_status weigh_torque(const question *q, hci_wave *wave, size_t count, hci_held_worth *w,
                               hci_note *note)
{
    hci_torque_error error = {0.0, 0.0};
    if (q->task->held) wave[count++] = *q->task->held;
    const hci_status status = hci_torque_error_evaluate(q->task, wave, count, &error, note);
    w->error_Nm = error.worst_Nm;
    return status;
}

static hci_status weigh(const question *q, const hci_answer *a, hci_held_worth *w, hci_note *note)
{
    hci_wave *wave = hci_memory_new(a->set.count + 1, sizeof *wave);
    if (!wave) return hci_note_memory(note, NULL, "solving");
    for (size_t k = 0; k < a->set.count; ++k)
        wave[k] = wave_of(q, a, k);
    w->ripple_Nm = hci_hold_ripple_Nm(q->task, wave, a->set.count, q->options->sample_rad);
    w->copper_A2 = hci_waves_mean_square(wave, a->set.count);
    const hci_status status = weigh_torque(q, wave, a->set.count, w, note);
    hci_memory_free(wave);
    return status;
}

static hci_status ask_at(const question *q, double price, hci_answer *a, hci_held_worth *w, hci_note *note)
{
    q->task->rotor_price = price;
    hci_status status = ask(q, a, note);
    return status ? status : weigh(q, a, w, note);
}

/* Whether the last currents that were asked for are those of least size. */
static bool is_at_rest(const question *q)
{
    return hci_task_is_linear(q->task) || q->options->method == HCI_METHOD_POINTWISE ||
           q->solution->newton_converged;
}

/* Whether they make the torque as well as those without a price, within what is called reached. */
static bool is_same_torque(const question *q, const hci_held_worth *first, const hci_held_worth *w)
{
    return is_at_rest(q) &&
           w->error_Nm <= fmax(q->solution->tolerance_Nm, (1.0 + NO_WORSE) * first->error_Nm);
}

/* The least price that does, or the highest that the copper allows; the answer at it. */
static hci_status search(const question *q, const hci_held_worth *first, hci_answer *a, hci_held_worth *w,
                         hci_note *note)
{
    const double enough_Nm = ENOUGH * fabs(q->mean_Nm), allowance = q->options->loss_allowance,
                 most_A2 = (allowance > 0.0 ? allowance : DEFAULT_LOSS) * first->copper_A2;
    double low = LEAST_PRICE, high = MOST_PRICE;
    hci_status status = HCI_OK;
    bool is_dear = false;
    for (int k = 0; k < BISECTIONS && !status; ++k) {
        const double price = sqrt(low * high);
        status = ask_at(q, price, a, w, note);
        is_dear = w->copper_A2 > most_A2 || !is_same_torque(q, first, w);
        if (w->ripple_Nm > enough_Nm && !is_dear)
            low = price;
        else
            high = price;
    }
    if (!status) status = ask_at(q, high, a, w, note);
    is_dear = w->copper_A2 > most_A2 || !is_same_torque(q, first, w);
    if (!status && is_dear) status = ask_at(q, low, a, w, note);
    return status;
}

/* ---- words ---- */

static double amplitude_of(const question *q, const hci_answer *a, hci_component c)
{
    for (size_t k = 0; k < a->set.count; ++k)
        if (a->set.component[k].sequence == c.sequence &&
            fabs(a->set.component[k].order - c.order) < HCI_ORDER_TOLERANCE) {
            const hci_wave w = wave_of(q, a, k);
            return hci_amplitude(w.sine, w.cosine);
        }
    return 0.0;
}

/* The components of which most is gone. before: the orders as they come; a: what is left of them. */
static void name_reduced(const question *q, const hci_answer *before, const hci_answer *a, hci_note *remark)
{
    bool is_named[MOST_NAMED + 1] = {false};
    size_t named[MOST_NAMED] = {0};
    for (int n = 0; n < MOST_NAMED; ++n) {
        double most_A = 0.0;
        for (size_t k = 0; k < before->set.count; ++k) {
            const double was_A = amplitude_of(q, before, before->set.component[k]),
                         is_A = amplitude_of(q, a, before->set.component[k]);
            bool is_new = true;
            for (int j = 0; j < n; ++j)
                is_new = is_new && named[j] != k;
            if (!is_new || is_A > REDUCED * was_A || was_A - is_A <= most_A) continue;
            most_A = was_A - is_A;
            named[n] = k;
            is_named[n] = true;
        }
        if (!is_named[n]) return;
        const hci_component c = before->set.component[named[n]];
        hci_note_add(remark, "reduced: %s %g from %.3g to %.3g A", hci_set_name(before->set.set[named[n]]),
                     c.order, amplitude_of(q, before, c), amplitude_of(q, a, c));
    }
}

/* ---- all of it ---- */

/* The currents of the least ripple, where they can be asked for and it is worth it; *is_found. */
static hci_status find_least(question *q, hci_answer *a, hci_held_worth *first, hci_held_worth *w,
                             bool *is_found, hci_note *note)
{
    const size_t n = 2 * a->set.count;
    const double allowance = q->options->loss_allowance;
    double *x = hci_memory_new(2 * n, sizeof *x);
    hci_hold_question least = {q->of, &a->set, x,
                               (allowance > 0.0 ? allowance : DEFAULT_LOSS) * first->copper_A2,
                               ENOUGH * fabs(q->mean_Nm)};
    if (!x) return hci_note_memory(note, NULL, "solving");
    for (size_t j = 0; j < n; ++j)
        x[j] = hci_coordinate(a->x, n, q->mean_Nm, j);
    first->ripple_Nm = hci_hold_missed_Nm(&least, x);
    hci_status status = hci_hold_least(&least, x + n, note);
    w->ripple_Nm = hci_hold_missed_Nm(&least, x + n);
    *is_found = !status && w->ripple_Nm < WORTH * first->ripple_Nm;
    if (*is_found) {
        memset(a->x, 0, n * sizeof *a->x);
        memcpy(a->x + n, x + n, n * sizeof *a->x);
        const double ripple_Nm = w->ripple_Nm;
        status = weigh(q, a, w, note);
        w->ripple_Nm = ripple_Nm;
        q->is_given = true;
    }
    hci_memory_free(x);
    return status == HCI_ERROR_NUMERIC ? HCI_OK : status;
}

/* Whether other currents of the same components make the same torque, and the smallest of them are known. */
static bool is_free(const question *q)
{
    return is_at_rest(q) && q->solution->rank < q->solution->unknowns;
}

static hci_status price(question *q, hci_answer *a, hci_held *held, hci_note *note)
{
    hci_held_worth rough;
    hci_status status = weigh(q, a, &rough, note);
    if (status || !is_free(q) || rough.ripple_Nm <= ENOUGH * fabs(q->mean_Nm)) return status;
    if (hci_answer_copy(a, &held->as_they_come)) return hci_note_memory(note, NULL, "solving");
    held->first = rough;
    if (hci_hold_is_known(q->of)) status = find_least(q, a, &held->first, &held->now, &held->is_exact, note);
    if (!status && !held->is_exact) {
        held->first = rough;
        status = search(q, &held->first, a, &held->now, note);
    }
    held->is_worth_it = held->is_exact || (held->now.ripple_Nm <= WORTH * held->first.ripple_Nm &&
                                           is_same_torque(q, &held->first, &held->now));
    return status || held->is_worth_it ? status : ask_at(q, 0.0, a, &held->now, note);
}

hci_status hci_held_answer(const hci_limited *of, hci_answer *a, bool *has_parts, hci_held *held,
                           hci_note *note)
{
    const hci_solve_options *o = of->options;
    question q = question_of(of);
    const bool is_priced = o->sample_rad > 0.0 && o->choose_at_most == 0 && q.mean_Nm != 0.0 &&
                           o->method != HCI_METHOD_POINTWISE;
    hci_status status = ask(&q, a, note);
    if (!status && is_priced) status = price(&q, a, held, note);
    if (!status && !is_at_rest(&q))
        status = hci_newton_come_nearer(of->task, o, of->at, a, of->solution, note);
    *has_parts = !o->held && hci_task_is_linear(of->task) && !q.is_given;
    return status;
}

/* What is missed of the answer in the end, which is another one where limits act, as `held` measured it. */
static hci_status missed_of(const question *q, const hci_held *held, const hci_answer *a, double *ripple_Nm,
                            hci_note *note)
{
    const size_t n = 2 * a->set.count;
    hci_held_worth w = {0.0, 0.0, 0.0};
    double *x = hci_memory_new(n, sizeof *x);
    const hci_hold_question exact = {q->of, &a->set, x, 0.0, 0.0};
    hci_status status = x ? HCI_OK : hci_note_memory(note, NULL, "solving");
    for (size_t j = 0; j < n && !status; ++j)
        x[j] = hci_coordinate(a->x, n, q->mean_Nm, j);
    if (!status && !held->is_exact) status = weigh(q, a, &w, note);
    if (!status) *ripple_Nm = held->is_exact ? hci_hold_missed_Nm(&exact, x) : w.ripple_Nm;
    hci_memory_free(x);
    return status || *ripple_Nm < HUGE_VAL ? status : hci_note_memory(note, NULL, "solving");
}

hci_status hci_held_tell(const hci_limited *of, const hci_held *held, const hci_answer *a, hci_note *note)
{
    const question q = question_of(of);
    const double percent = 100.0 / fabs(q.mean_Nm), copper = held->now.copper_A2 / held->first.copper_A2;
    double ripple_Nm = NAN;
    if (!held->is_worth_it) return HCI_OK;
    const hci_status status = missed_of(&q, held, a, &ripple_Nm, note);
    if (status) return status;
    if (fabs(ripple_Nm - held->now.ripple_Nm) > SAME * ripple_Nm) {
        hci_note_add(
            &of->solution->remark,
            "between its samples the loop misses %s %% of the mean torque of these currents, peak to "
            "peak; without limits high orders are reduced for that, to %s %% with %.3g times the "
            "copper, which does not keep them",
            HCI_PERCENT(percent * ripple_Nm, 2), HCI_PERCENT(percent * held->now.ripple_Nm, 2), copper);
        return HCI_OK;
    }
    hci_note_add(&of->solution->remark,
                 "between its samples the loop misses %s %% of the mean torque of these currents, peak to "
                 "peak; high orders are reduced for that (%s %% without), which takes %.3g times the copper",
                 HCI_PERCENT(percent * ripple_Nm, 2), HCI_PERCENT(percent * held->first.ripple_Nm, 2),
                 copper);
    name_reduced(&q, &held->as_they_come, a, &of->solution->remark);
    return HCI_OK;
}
