/* In: a program and its answer by interior points; out: its optimum with the limits at every angle. The peak
 * of each limit that acts moves with the currents, so that a few steps of Newton's method do what many
 * programs with more and more angles would. */
#include "host/limit/newton.h"

#include <math.h>
#include <string.h>

#include "host/base/memory.h"
#include "host/limit/newton_columns.h"
#include "host/limit/newton_peaks.h"
#include "host/limit/newton_step.h"
#include "host/limit/stage.h"

enum {
    MOST_SEARCHES = 12, /* of peaks that were not known */
    MOST_STEPS = 20,    /* between two searches */
};

#define CLOSE   1e-3 /* share below a limit within which a peak is looked at */
#define ARRIVED 1e-9 /* step as a share of the currents with which it is there */
#define RESTING                                                                                              \
    1e-7            /* the same after all steps, which peaks that merge make slow: limits miss its square    \
                     */
#define MISSED 1e-7 /* share of the torque by which it may be beyond its range between the angles */

/* ---- to rest ---- */

static hci_status come_to_rest(hci_newton *w)
{
    hci_status status = HCI_OK;
    w->moved = 1.0;
    for (int k = 0; k < MOST_STEPS && w->moved > ARRIVED && !w->has_failed && !status; ++k)
        status = hci_newton_step(w);
    w->has_failed = w->has_failed || w->moved > RESTING;
    return status;
}

/* Until no peak is beyond its limit that was not known. */
static hci_status iterate(hci_newton *w)
{
    size_t added = 1;
    hci_status status = HCI_OK;
    for (int k = 0; k < MOST_SEARCHES && added > 0 && !w->has_failed && !status; ++k) {
        status = come_to_rest(w);
        if (!status && !w->has_failed) status = hci_newton_search(w, HCI_LIMIT_MARGIN, &added);
    }
    w->has_failed = w->has_failed || added > 0;
    return status;
}

/* Whether the currents keep the limits at every angle, and the torque its range but for what its search may
 * miss. */
static hci_status check(hci_newton *w)
{
    const hci_limit_program *p = w->near->of;
    hci_status status = HCI_OK;
    for (size_t q = 0; q < p->grids && !status; ++q) {
        const bool is_of_torque = p->grid[q].kind == HCI_POINT_TORQUE;
        hci_limit_points found = {0};
        double range[2];
        if (!hci_newton_is_asked(w, &p->grid[q])) continue;
        hci_newton_range_of(w, &p->grid[q], is_of_torque ? 0.0 : HCI_LIMIT_MARGIN, range);
        range[0] -= is_of_torque ? MISSED * p->scale_Nm : 0.0;
        range[1] += is_of_torque ? MISSED * p->scale_Nm : 0.0;
        status = hci_newton_peaks_beyond(w, &p->grid[q], range, &found);
        w->has_failed = w->has_failed || found.count > 0;
        hci_limit_points_release(&found);
    }
    return status;
}

/* ---- where it begins ---- */

/* The rows of no angle, which do not change. */
static hci_status begin_build(hci_newton *w)
{
    w->program.points = (hci_limit_points){0};
    w->program.grids = 0;
    if (!hci_limit_build_begin(&w->program, w->near->stage, &w->build)) return HCI_ERROR_MEMORY;
    hci_limit_stage_fill(&w->build);
    return w->build.is_full ? HCI_ERROR_MEMORY : HCI_OK;
}

static hci_status begin(const hci_limit_build *b, hci_newton *w)
{
    const size_t n = b->n;
    *w = (hci_newton){.near = b, .program = *b->of, .n = n, .coordinates = b->coordinates};
    if (begin_build(w)) return HCI_ERROR_MEMORY;
    w->block = hci_memory_new(2 * n * n + 6 * n + w->build.rows + hci_limit_row_room(&w->program.field),
                              sizeof *w->block);
    if (!w->block) return HCI_ERROR_MEMORY;
    w->hessian = w->block;
    w->factor = w->hessian + n * n;
    w->x = w->factor + n * n;
    w->slope = w->x + n;
    w->around = w->slope + 2 * n;
    w->rest_weight = w->around + 3 * n;
    w->row = w->rest_weight + w->build.rows;
    return HCI_OK;
}

/* Whether a row has the multiplier of an angle's quantity: of a vector the head of its cone has. */
static bool is_of_angle(const hci_limit_build *b, size_t k)
{
    return b->at[k].kind != HCI_POINT_NONE && (b->at[k].kind != HCI_POINT_VECTOR || b->limit_of[k] != 0);
}

/* Multipliers of the interior point to the peaks that are next to their rows, and to the rows of no angle. */
static void begin_weights(hci_newton *w, const double *z)
{
    const hci_limit_build *b = w->near;
    size_t rest = 0;
    for (size_t k = 0; k < b->rows; ++k) {
        hci_newton_peak *p = is_of_angle(b, k) ? hci_newton_peak_of(w, &b->at[k]) : NULL;
        if (p) p->weight += fabs(z[k]);
        if (b->at[k].kind == HCI_POINT_NONE) w->rest_weight[rest++] = z[k];
    }
}

static hci_status begin_at_answer(hci_newton *w, const hci_cone_answer *answer)
{
    size_t added;
    memcpy(w->x, answer->x, w->n * sizeof *w->x);
    const hci_status status = hci_newton_search(w, CLOSE, &added);
    if (status) return status;
    begin_weights(w, answer->z);
    hci_newton_drop_slack(w);
    return HCI_OK;
}

static const hci_limit_grid *grid_of(const hci_newton *w, const hci_limit_point *at)
{
    const hci_limit_program *p = w->near->of;
    for (size_t q = 0; q < p->grids; ++q)
        if (p->grid[q].kind == at->kind && (at->kind == HCI_POINT_TORQUE || p->grid[q].phase == at->phase))
            return &p->grid[q];
    return NULL;
}

/* The peaks that act there are known already. */
static hci_status begin_at_rest(hci_newton *w, const hci_limit_rest *last)
{
    const double *weight = last->x + last->n;
    size_t added;
    w->has_failed = last->rest != w->build.rows;
    if (w->has_failed) return HCI_OK;
    memcpy(w->x, last->x, w->n * sizeof *w->x);
    memcpy(w->rest_weight, weight, last->rest * sizeof *weight);
    w->peak = hci_memory_new(last->peaks + 1, sizeof *w->peak);
    if (!w->peak) return HCI_ERROR_MEMORY;
    for (size_t k = 0; k < last->peaks; ++k) {
        w->peak[w->peaks++] =
            (hci_newton_peak){last->at[k], grid_of(w, &last->at[k]), weight[last->rest + k]};
        w->has_failed = w->has_failed || !w->peak[k].grid;
    }
    return w->has_failed ? HCI_OK : hci_newton_search(w, CLOSE, &added);
}

/* ---- what it gives ---- */

static hci_status give(const hci_newton *w, hci_limit_optimum *o)
{
    hci_limit_optimum exact = {.x = hci_memory_new(w->coordinates, sizeof *exact.x)};
    const hci_cone_answer answer = {.end = HCI_CONE_SOLVED, .x = w->x, .z = w->rest_weight};
    if (!exact.x) return HCI_ERROR_MEMORY;
    hci_limit_stage_read(&w->build, &answer, &exact);
    for (size_t k = 0; k < w->peaks; ++k)
        if (!hci_newton_is_torque(&w->peak[k]))
            hci_limit_stage_add_gain(&w->build, hci_limit_tag_of(&w->peak[k].at), w->peak[k].weight, &exact);
    exact.is_settled = true;
    hci_memory_free(o->x);
    *o = exact;
    return HCI_OK;
}

static hci_status keep_rest(const hci_newton *w, hci_limit_rest *last)
{
    hci_limit_rest_release(last);
    last->x = hci_memory_new(w->n + w->build.rows + w->peaks, sizeof *last->x);
    last->at = hci_memory_new(w->peaks + 1, sizeof *last->at);
    if (!last->x || !last->at) return HCI_ERROR_MEMORY;
    last->n = w->n;
    last->rest = w->build.rows;
    double *weight = last->x + last->n;
    memcpy(last->x, w->x, w->n * sizeof *w->x);
    memcpy(weight, w->rest_weight, last->rest * sizeof *weight);
    for (size_t k = 0; k < w->peaks; ++k) {
        if (!(w->peak[k].weight > 0.0)) continue;
        weight[last->rest + last->peaks] = w->peak[k].weight;
        last->at[last->peaks++] = w->peak[k].at;
    }
    return HCI_OK;
}

void hci_limit_rest_release(hci_limit_rest *rest)
{
    hci_memory_free(rest->x);
    hci_memory_free(rest->at);
    *rest = (hci_limit_rest){0};
}

static void end(hci_newton *w)
{
    hci_limit_build_release(&w->build);
    hci_memory_free(w->act.gradient);
    hci_memory_free(w->act.row);
    hci_memory_free(w->peak);
    hci_memory_free(w->block);
}

hci_status hci_limit_newton(const hci_limit_build *build, const hci_cone_answer *answer, hci_limit_rest *last,
                            hci_limit_optimum *optimum)
{
    hci_newton w;
    hci_status status;
    if (build->stage == HCI_STAGE_FIT) return HCI_OK; /* whose limits move */
    if (!answer && last->n != build->n) return HCI_OK;
    status = begin(build, &w);
    if (!status) status = answer ? begin_at_answer(&w, answer) : begin_at_rest(&w, last);
    if (!status && !w.has_failed) status = iterate(&w);
    if (!status && !w.has_failed) status = check(&w);
    if (w.has_failed && !answer) hci_limit_rest_release(last);
    if (!status && !w.has_failed) status = keep_rest(&w, last);
    if (!status && !w.has_failed) status = give(&w, optimum);
    end(&w);
    return status;
}
