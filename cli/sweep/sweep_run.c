#define _POSIX_C_SOURCE 200809L

#include "cli/sweep/sweep_run.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#include "cli/command/jobs.h"
#include "cli/terminal/progress.h"
#include "cli/terminal/say.h"
#include "cli/terminal/signals.h"

#define KEEP_S 1.0 /* between two writings of the points */

/* ---- what a trade-off ranges over: in a process of its own too, so that this one never solves ---- */

typedef struct {
    hci_status status;
    hci_note note;
    hci_grid_span span;
} span_answer;

typedef struct {
    const hci_grid_request *request;
    span_answer answer;
} span_work;

static void find_span(void *context, size_t item, void *answer)
{
    span_work *w = context;
    (void)item;
    memset(&w->answer, 0, sizeof w->answer);
    w->answer.status = hci_grid_span_find(w->request, &w->answer.span, &w->answer.note);
    memcpy(answer, &w->answer, sizeof w->answer);
}

static void take_span(void *context, size_t item, const void *answer, int number)
{
    span_work *w = context;
    (void)item;
    if (answer)
        memcpy(&w->answer, answer, sizeof w->answer);
    else
        w->answer.status =
            hci_note_set(&w->answer.note, HCI_ERROR_NUMERIC, "the solver ended by signal %d", number);
}

static bool is_wanted(void *context)
{
    (void)context;
    return !cli_signals_deferred(NULL);
}

static hci_status span_of(const hci_grid_request *request, hci_grid_span *span, hci_note *note)
{
    static const size_t ONE = 0;
    span_work w = {.request = request, .answer = {.status = HCI_ERROR_NUMERIC}};
    const cli_jobs jobs = {.jobs = 1,
                           .item = &ONE,
                           .items = 1,
                           .answer_size = sizeof(span_answer),
                           .work = find_span,
                           .take = take_span,
                           .goes_on = is_wanted,
                           .context = &w};
    const hci_status status = cli_jobs_run(&jobs, note);
    if (status) return status;
    *span = w.answer.span;
    return w.answer.status ? hci_note_set(note, w.answer.status, "%s", w.answer.note.text) : HCI_OK;
}

/* ---- points ---- */

typedef struct {
    const cli_sweep_inputs *inputs;
    const char *out;
    hci_grid *sweep;
    size_t *item;
    size_t items, taken;
    void *lock;      /* of the folder, once there is one */
    double kept_s;   /* when the points were written last */
    bool is_changed; /* since then */
    bool is_any;     /* a point that did not fail: until then nothing is written */
    hci_status status;
    hci_note note;
} points_work;

static double now_s(void)
{
    struct timespec now;
    clock_gettime(CLOCK_MONOTONIC, &now);
    return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

static void solve_point(void *context, size_t item, void *answer)
{
    const points_work *w = context;
    hci_grid_row row;
    hci_grid_solve(&w->sweep->request, &w->sweep->plan.point[item], &row);
    memcpy(answer, &row, sizeof row);
}

static void take_point(void *context, size_t item, const void *answer, int number)
{
    points_work *w = context;
    char reason[64];
    if (answer) {
        memcpy(&w->sweep->row[item], answer, sizeof w->sweep->row[item]);
    } else {
        snprintf(reason, sizeof reason, "the solver ended by signal %d", number);
        hci_grid_fail(&w->sweep->plan.point[item], reason, &w->sweep->row[item]);
    }
    if (w->sweep->row[item].out_of_memory) {
        if (!w->status) w->status = hci_note_memory(&w->note, NULL, "point %zu of the grid", item + 1);
        return;
    }
    w->sweep->done[item] = true;
    w->is_any = w->is_any || w->sweep->row[item].verdict != HCI_GRID_FAILED;
    w->is_changed = true;
    ++w->taken;
}

/* A folder that was not there at the start may hold the points of another process by now. */
static hci_status lock_late(points_work *w)
{
    if (w->lock) return HCI_OK;
    const hci_status status = hci_grid_lock(w->out, &w->lock, &w->note);
    if (status || !w->lock) return status;
    return hci_grid_take_points(w->sweep, &w->inputs->inputs, w->out, false, &w->note);
}

static void keep(points_work *w)
{
    if (w->out && w->is_any && w->is_changed && !w->status) {
        w->status = lock_late(w);
        if (!w->status) w->status = hci_grid_keep_points(w->sweep, &w->inputs->inputs, w->out, &w->note);
        if (!w->status) w->status = hci_grid_lock(w->out, &w->lock, &w->note);
    }
    w->is_changed = false;
    w->kept_s = now_s();
}

static bool goes_on(void *context)
{
    points_work *w = context;
    cli_work unit = {(double)w->items, "points"};
    cli_progress(&unit, "sweeping", (double)w->taken / (double)w->items);
    if (now_s() - w->kept_s > KEEP_S) keep(w);
    return !w->status && !cli_signals_deferred(NULL);
}

static hci_status list_items(points_work *w, hci_note *note)
{
    const hci_grid *s = w->sweep;
    w->item = malloc((s->plan.count + 1) * sizeof *w->item);
    if (!w->item) return hci_note_memory(note, NULL, "the points of a grid");
    w->is_any = w->inputs->shard.shares > 1; /* one share does not tell for all */
    for (size_t k = 0; k < s->plan.count; ++k) {
        w->is_any = w->is_any || (s->done[k] && s->row[k].verdict != HCI_GRID_FAILED);
        if (!s->done[k] && cli_shard_has(&w->inputs->shard, k)) w->item[w->items++] = k;
    }
    return HCI_OK;
}

static hci_status solve_points(points_work *w, size_t jobs, hci_note *note)
{
    const cli_jobs all = {.jobs = jobs,
                          .item = w->item,
                          .items = w->items,
                          .answer_size = sizeof(hci_grid_row),
                          .work = solve_point,
                          .take = take_point,
                          .goes_on = goes_on,
                          .context = w};
    hci_status status;
    w->kept_s = now_s();
    status = cli_jobs_run(&all, note);
    w->is_changed = true;
    keep(w);
    cli_progress_end();
    if (!status && w->status) return hci_note_set(note, w->status, "%s", w->note.text);
    return status;
}

/* Where each point of this run fails, what was given is wrong, and the reason of the first says it. */
static hci_status judge(const points_work *w, hci_note *note)
{
    if (w->is_any || w->items == 0 || w->taken < w->items) return HCI_OK;
    return hci_note_set(note, HCI_ERROR_INPUT, "%s", w->sweep->row[w->item[0]].reason);
}

/* ---- all of it ---- */

static hci_status take_known(const cli_sweep_inputs *in, const cli_sweep_work *work, hci_grid *sweep,
                             hci_note *note)
{
    hci_status status = HCI_OK;
    if (work->out) status = hci_grid_take_points(sweep, &in->inputs, work->out, false, note);
    for (size_t k = 0; k < work->joins && !status; ++k)
        status = hci_grid_take_points(sweep, &in->inputs, work->join[k], true, note);
    return status;
}

/* Shares that are put together may not be all of them. */
static void remark_missing(const points_work *w)
{
    hci_note remark = {{0}};
    if (w->items > 0)
        hci_note_add(&remark,
                     "%zu of %zu points are in none of the folders that are joined, and are solved here",
                     w->items, w->sweep->plan.count);
    cli_remark(&remark);
}

hci_status cli_sweep_run(const cli_sweep_inputs *in, const cli_sweep_work *work, hci_grid *sweep,
                         hci_note *note)
{
    const bool is_trade_off = in->request.kind == HCI_GRID_TRADE_OFF;
    points_work w = {.inputs = in, .out = work->out, .sweep = sweep};
    hci_grid_span span;
    hci_grid_plan plan = {0};
    hci_status status = HCI_OK;
    cli_signals_defer();
    if (is_trade_off) status = span_of(&in->request, &span, note);
    if (!status) status = hci_grid_plan_make(&in->request, is_trade_off ? &span : NULL, &plan, note);
    if (!status) status = hci_grid_begin(&in->request, &plan, sweep, note);
    hci_grid_plan_release(&plan);
    if (!status && work->out) status = hci_grid_lock(work->out, &w.lock, note);
    if (!status) status = take_known(in, work, sweep, note);
    if (!status) status = list_items(&w, note);
    if (!status && work->joins > 0) remark_missing(&w);
    if (!status) status = solve_points(&w, work->jobs, note);
    if (!status) status = judge(&w, note);
    hci_grid_unlock(w.lock);
    free(w.item);
    return status;
}
