#include "host/solution/wish.h"

#include <math.h>
#include <string.h>

#include "core/math/vector.h"
#include "host/base/memory.h"
#include "host/limit/newton.h"
#include "host/limit/stage.h"

enum {
    FEW = 12, /* peaks that are left when it becomes precise */
    COARSE_ROUNDS = 2,
    MANY = 20,       /* rounds of all wishes, as a rule */
    MOST_ROUNDS = 40 /* of adding peaks, each of which squares the error */
};

#define ROUGH  1e-6 /* of the solver while peaks are still looked for */
#define STILL  1e-5 /* change of what is minimised below which it becomes precise too */
#define NEAR   0.99 /* share of a limit from which a peak of the last answer is kept as a row */
#define BESIDE 0.25 /* of the spacing of samples: of points nearer than that the last is kept */
#define FLAT   1e-4 /* share of the torque below which its swing tells nothing */
#define IDLE   0.7  /* share of a limit below which an angle is left out until a peak is there */

static hci_status out_of_memory(hci_note *note)
{
    return hci_note_memory(note, NULL, "solving within limits");
}

/* What a grid's quantity has to stay within; false where this stage does not ask for it, as of the torque
 * where every order is an equation: highest and lowest are then of no meaning. */
static bool range_of(const hci_wishes *l, const hci_limit_grid *g, hci_limit_stage stage,
                     const hci_limit_optimum *o, double range[2])
{
    const hci_limit_program *p = &l->program;
    const bool is_torque = g->kind == HCI_POINT_TORQUE;
    const double margin_Nm = 1e-7 * p->scale_Nm,
                 limit =
                     is_torque ? 0.0 : hci_limit_of_point(p->bounds, g->kind, g->phase) * (1.0 + p->widened);
    range[1] = is_torque ? o->highest_Nm + margin_Nm : limit * (1.0 - HCI_LIMIT_MARGIN);
    range[0] = is_torque ? o->lowest_Nm - margin_Nm : -range[1];
    return !is_torque || stage == HCI_STAGE_RIPPLE || (stage == HCI_STAGE_COPPER && !p->has_ripple);
}

/* Whether an answer tells which angles do not matter: not of a torque that is as good as flat, where the few
 * that are left would bound nothing. */
static bool tells_angles(const hci_wishes *l, const hci_limit_grid *g, const double range[2])
{
    return g->kind != HCI_POINT_TORQUE || range[1] - range[0] > FLAT * l->program.scale_Nm;
}

/* Adds the peaks of an optimum beyond a limit; *added: how many. */
static hci_status add_peaks(hci_wishes *l, hci_limit_stage stage, const hci_limit_optimum *o, size_t *added,
                            hci_note *note)
{
    hci_limit_program *p = &l->program;
    const size_t before = p->points.count;
    hci_status status = HCI_OK;
    if (stage == HCI_STAGE_FIT) p->widened = o->smallest;
    for (size_t q = 0; q < p->grids && !status; ++q) {
        double range[2], worst;
        if (!range_of(l, &p->grid[q], stage, o, range)) continue;
        status = hci_limit_peaks(&p->field, &p->grid[q], o->x, range, &p->points, &worst);
        if (!status && stage >= HCI_STAGE_RIPPLE && tells_angles(l, &p->grid[q], range))
            hci_limit_grid_thin(&p->grid[q], o->x, range, IDLE);
    }
    if (stage == HCI_STAGE_FIT) p->widened = 0.0;
    *added = p->points.count - before;
    return status ? out_of_memory(note) : HCI_OK;
}

bool hci_wish_is_end(hci_status status)
{
    return status == HCI_ERROR_MEMORY || status == HCI_ERROR_STOPPED;
}

/* How often peaks are added: until there are none, or while the torque is still being made linear a few
 * times, since they are kept for the next step. */
static int rounds_of(const hci_wishes *l)
{
    if (l->is_coarse && l->program.radius_A > 0.0) return 1;
    return l->is_coarse ? COARSE_ROUNDS : MOST_ROUNDS;
}

/* While the currents come to rest by themselves, which they do not where each answer is a little off. */
static bool needs_precision(const hci_wishes *l)
{
    return l->is_coarse && !l->is_far && !(l->program.radius_A > 0.0);
}

/* One more round; where rounding spoils it the one before stays, unsettled, and *goes_on is false. */
static hci_status try_round(hci_wishes *l, hci_limit_stage stage, hci_limit_optimum *o, bool *goes_on,
                            hci_note *note)
{
    const bool is_first = !o->x;
    hci_limit_optimum next;
    hci_note ignored = {{0}};
    if (hci_limit_points_fill(&l->program.field, &l->program.points)) return out_of_memory(note);
    const hci_status status = hci_limit_stage_solve(
        &l->program, stage, l->is_coarse && !needs_precision(l) ? NULL : hci_limit_newton, &l->rest[stage],
        &next, is_first ? note : &ignored);
    *goes_on = is_first || (status != HCI_ERROR_NUMERIC && !next.is_infeasible);
    hci_memory_free(*goes_on ? o->x : next.x);
    if (!*goes_on) return HCI_OK;
    *o = next;
    *goes_on = !status && !next.is_infeasible;
    return status;
}

/* Spacing of the samples at which peaks of a point's quantity are looked for. */
static double step_rad(const hci_limit_program *p, const hci_limit_point *at)
{
    for (size_t q = 0; q < p->grids; ++q)
        if (p->grid[q].kind == at->kind && p->grid[q].phase == at->phase) return p->grid[q].step_rad;
    return 0.0;
}

/* Whether a later point is next to point k, which then says nothing new. */
static bool is_repeated(const hci_limit_program *p, size_t k)
{
    const hci_limit_point *at = &p->points.point[k];
    const double near_rad = BESIDE * step_rad(p, at);
    for (size_t j = k + 1; j < p->points.count; ++j) {
        const hci_limit_point *later = &p->points.point[j];
        if (later->kind == at->kind && later->phase == at->phase &&
            fabs(later->theta_rad - at->theta_rad) < near_rad)
            return true;
    }
    return false;
}

/* Whether currents are next to the limit of point k; x: NULL: none. */
static bool is_near(const hci_wishes *l, size_t k, const double *x)
{
    const hci_limit_program *p = &l->program;
    const hci_limit_point *at = &p->points.point[k];
    if (!x) return false;
    const double limit = hci_limit_of_point(p->bounds, at->kind, at->phase) * (1.0 + p->widened),
                 *row = hci_limit_points_row(&p->points, k);
    return fabs(hci_limit_value(at->kind, 2 * l->set.count, row, x)) >= NEAR * limit;
}

hci_status hci_wish_forget(hci_wishes *l, hci_note *note)
{
    hci_limit_program *p = &l->program;
    size_t kept = 0;
    if (!l->x) return HCI_OK;
    if (hci_limit_points_fill(&p->field, &p->points)) return out_of_memory(note);
    for (size_t k = 0; k < p->points.count; ++k) {
        if (is_repeated(p, k)) continue;
        if (p->points.point[k].kind == HCI_POINT_TORQUE || is_near(l, k, l->x) || is_near(l, k, l->best))
            hci_limit_points_keep(&p->points, k, kept++);
    }
    hci_limit_points_cut(&p->points, kept);
    return HCI_OK;
}

/* Whether peaks no longer change much of the mean or the ripple. */
static bool is_still(const hci_wishes *l, hci_limit_stage stage, double before, double now)
{
    const bool is_torque = stage == HCI_STAGE_MEAN || stage == HCI_STAGE_RIPPLE;
    return is_torque && fabs(now - before) < STILL * l->program.scale_Nm;
}

/* How many programs it takes is not known before, so that the share only comes nearer to 1. */
static void tell_round(hci_wishes *l)
{
    const hci_task *t = l->of->task;
    ++l->rounds;
    if (t->progress)
        t->progress(t->progress_context, "keeping limits", (double)l->rounds / (double)(l->rounds + MANY));
}

/* Roughly until no peaks are left, then precisely until there are none either, or Newton's method has found
 * the end. */
hci_status hci_wish_solve(hci_wishes *l, hci_limit_stage stage, hci_limit_optimum *o, hci_note *note)
{
    size_t added = 1;
    bool goes_on = true;
    hci_status status = HCI_OK;
    memset(o, 0, sizeof *o);
    o->smallest = HUGE_VAL;
    l->program.precision = needs_precision(l) ? 0.0 : ROUGH;
    for (int round = 0; round < rounds_of(l) && goes_on && !status; ++round) {
        const double before = o->smallest;
        status = hci_task_goes_on(l->of->task, note);
        if (!status) status = try_round(l, stage, o, &goes_on, note);
        if (status == HCI_ERROR_STOPPED) return status;
        tell_round(l);
        if (o->is_settled) return status;
        if (!status && goes_on) status = add_peaks(l, stage, o, &added, note);
        if (added == 0 && (l->is_coarse || !(l->program.precision > 0.0))) break;
        if (!l->is_coarse && (added < FEW || is_still(l, stage, before, o->smallest)))
            l->program.precision = 0.0;
    }
    o->is_settled = added == 0;
    return status;
}

void hci_wish_take(hci_wishes *l, hci_limit_optimum *o)
{
    hci_memory_free(l->x);
    l->x = o->x;
    o->x = NULL;
}
