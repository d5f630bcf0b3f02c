/* In: a task and the angle between two samples; out: currents, with high orders priced where the sampling
 * leaves much of them. */
#include "host/solution/hold.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "host/base/memory.h"
#include "host/solution/hold_least.h"
#include "host/solve/linear.h"
#include "host/solve/newton.h"
#include "host/solve/pointwise.h"

enum { ANGLES = 2048, BISECTIONS = 16, MOST_NAMED = 4 };

static const double ENOUGH = 0.01, /* ripple as a share of the mean torque that needs no price */
    DEFAULT_LOSS = 1.5,            /* most copper over that without a price */
    LEAST_PRICE = 1e-18, MOST_PRICE = 1e-2;
static const double WORTH = 0.9;   /* share of the ripple without a price above which there is none */
static const double REDUCED = 0.7; /* share of its current below which a component is named */

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

/* What counts of an answer. */
typedef struct {
    double ripple_Nm, copper_A2;
} worth;

static hci_status weigh(const question *q, const hci_answer *a, worth *w, hci_note *note)
{
    hci_wave *wave = hci_memory_new(a->set.count + 1, sizeof *wave);
    if (!wave) return hci_note_memory(note, NULL, "solving");
    for (size_t k = 0; k < a->set.count; ++k)
        wave[k] = wave_of(q, a, k);
    w->ripple_Nm = hci_hold_ripple_Nm(q->task, wave, a->set.count, q->options->sample_rad);
    w->copper_A2 = hci_waves_mean_square(wave, a->set.count);
    hci_memory_free(wave);
    return HCI_OK;
}

static hci_status ask_at(const question *q, double price, hci_answer *a, worth *w, hci_note *note)
{
    q->task->rotor_price = price;
    hci_status status = ask(q, a, note);
    return status ? status : weigh(q, a, w, note);
}

/* The least price that does, or the highest that the copper allows; the answer at it. */
static hci_status search(const question *q, const worth *first, hci_answer *a, worth *w, hci_note *note)
{
    const double enough_Nm = ENOUGH * fabs(q->mean_Nm), allowance = q->options->loss_allowance,
                 most_A2 = (allowance > 0.0 ? allowance : DEFAULT_LOSS) * first->copper_A2;
    double low = LEAST_PRICE, high = MOST_PRICE;
    hci_status status = HCI_OK;
    for (int k = 0; k < BISECTIONS && !status; ++k) {
        const double price = sqrt(low * high);
        status = ask_at(q, price, a, w, note);
        if (w->ripple_Nm > enough_Nm && w->copper_A2 <= most_A2)
            low = price;
        else
            high = price;
    }
    if (!status) status = ask_at(q, high, a, w, note);
    if (!status && w->copper_A2 > most_A2) status = ask_at(q, low, a, w, note);
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

/* The components of which most is gone. */
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

static void tell(const question *q, const worth *first, const worth *w)
{
    const double percent = 100.0 / fabs(q->mean_Nm);
    hci_note_add(
        &q->solution->remark,
        "between its samples the loop misses %.2g %% of the mean torque of these currents, peak to "
        "peak; high orders are reduced for that (%.2g %% without), which takes %.3g times the copper",
        percent * w->ripple_Nm, percent * first->ripple_Nm, w->copper_A2 / first->copper_A2);
}

/* ---- all of it ---- */

/* The currents of the least ripple, where they can be asked for and it is worth it; *is_found. */
static hci_status find_least(question *q, hci_answer *a, worth *first, worth *w, bool *is_found,
                             hci_note *note)
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

static hci_status price(question *q, hci_answer *a, hci_note *note)
{
    hci_answer before = {0};
    worth first, w;
    bool is_found = false;
    hci_status status = weigh(q, a, &first, note);
    if (status || first.ripple_Nm <= ENOUGH * fabs(q->mean_Nm)) return status;
    if (hci_answer_copy(a, &before)) return hci_note_memory(note, NULL, "solving");
    const worth rough = first;
    if (hci_hold_is_known(q->of)) status = find_least(q, a, &first, &w, &is_found, note);
    if (!status && !is_found) {
        first = rough;
        status = search(q, &first, a, &w, note);
    }
    if (!status && !is_found && w.ripple_Nm > WORTH * first.ripple_Nm) {
        status = ask_at(q, 0.0, a, &w, note);
    } else if (!status) {
        tell(q, &first, &w);
        name_reduced(q, &before, a, &q->solution->remark);
    }
    hci_answer_release(&before);
    return status;
}

hci_status hci_held_answer(const hci_limited *of, hci_answer *a, bool *has_parts, hci_note *note)
{
    const hci_solve_options *o = of->options;
    question q = {of->task, o, of->at, of->solution, hci_target_mean_Nm(o->target), of, false};
    const bool is_priced = o->sample_rad > 0.0 && o->choose_at_most == 0 && q.mean_Nm != 0.0 &&
                           o->method != HCI_METHOD_POINTWISE;
    hci_status status = ask(&q, a, note);
    if (!status && is_priced) status = price(&q, a, note);
    *has_parts = !o->held && hci_task_is_linear(of->task) && !q.is_given;
    return status;
}
