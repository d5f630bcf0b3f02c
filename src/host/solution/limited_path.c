#include "host/solution/limited_path.h"

#include <math.h>
#include <string.h>

#include "core/math/vector.h"
#include "host/base/memory.h"
#include "host/numeric/anderson.h"
#include "host/solution/wish.h"
#include "host/solve/linearise.h"

enum {
    MOST_STEPS = 60,
    PATIENCE = 4, /* steps in which neither the change is halved nor the torque much better, after which
                   * the distance is bounded */
    POLISHES = 2, /* steps after the last, each within less of it */
    HALVES = 5    /* of the currents that the first step begins at, where rounding spoils it */
};

#define FAR           3e-2 /* change of the current above which programs are solved roughly */
#define COARSE        1e-6 /* change of the current above which steps are coarse */
#define LOOSE         1e-4 /* the same once they are not */
#define CONVERGED     1e-8 /* change of the current as a share of it */
#define CLOSE         3e-3 /* distance as a share of the current at which nothing better is near */
#define CLOSEST       1e-5 /* the same where the mean is as wanted, so that the ripple is judged alone */
#define LEFT          1e-6 /* share of the torque; less ripple than that is not looked for */
#define FREE          5e-7 /* share of the torque that a mean may be off at no charge, see weighed_Nm */
#define SAME          1e-6 /* share of the torque that does not count */
#define HELD          0.25 /* share of the promised gain that a step must make for a longer one */
#define SETTLING      1e-2 /* the same for the last step, which brings peaks within their limits */
#define POLISH        0.1  /* of that distance, for each further step */
#define POLISHED      5e-8 /* share of the torque; an error of the mean below that leaves nothing to it */
#define IDLE          0.5  /* of the worst order: another that stays below that acts on no step */
#define LEAST_SHARE   0.1  /* of the way to an answer */
#define NOTABLE       0.1 /* share of the errors by which a step without a bound makes the torque much better */
#define SHRINK        0.3
#define AFTER_FAILURE 0.1 /* the same after a step that rounding spoils */
#define GROW          2.0
#define CORRECTED     0.1 /* of a step that was not better, for the one that corrects it */

#define MEAN_TO_RIPPLE 2.0 /* ripple that an error of the mean stands for, per its size */

static hci_status out_of_memory(hci_note *note)
{
    return hci_note_memory(note, NULL, "solving within limits");
}

/* Where the iteration stands. */
typedef struct {
    hci_wishes *wishes;
    size_t n;
    double *from,
        *best; /* n: where the torque is made linear, and the best answer; no best before the first */
    hci_limit_merit merit; /* of the best */
    hci_anderson mixing;
    double change, radius_A; /* change of the last step as a share; 0: not bounded */
    double share, least_change;
    double promised_Nm; /* less ripple, by what is linear, of the last step within a bound */
    int patience;       /* steps without better torque or half of the change after which it is bounded */
    int idle;           /* steps since the least change was halved or the torque became much better */
    int halved;         /* how often the currents of the first step were */
    int slow;           /* steps within a bound since one made more of the torque than LEFT */
    double tried_A;     /* bound of the step that is being corrected, see correct; 0: none is */
    bool is_ended;      /* for want of further steps */
} path;

static double length(const path *p, const double *x)
{
    return sqrt(hci_vector_dot(p->n, x, x));
}

static double distance(const path *p, const double *x, const double *y)
{
    double sum = 0.0;
    for (size_t j = 0; j < p->n; ++j)
        sum += (x[j] - y[j]) * (x[j] - y[j]);
    return sqrt(sum);
}

/* Waves of coordinates with what is held, each once. */
static hci_status waves_of(const hci_wishes *w, const double *x, hci_wave_list *i, hci_note *note)
{
    hci_wave *wave = hci_memory_new(w->set.count + 1, sizeof *wave);
    size_t n = 0;
    if (!wave) return out_of_memory(note);
    if (w->of->task->held) wave[n++] = *w->of->task->held;
    for (size_t k = 0; k < w->set.count; ++k)
        wave[n++] =
            (hci_wave){w->set.component[k].order, w->set.component[k].sequence, x[2 * k], x[2 * k + 1]};
    hci_memory_free(i->wave);
    i->wave = wave;
    i->count = hci_waves_join(wave, n, 1e-12);
    return HCI_OK;
}

/* Whether orders that are far below the worst of the best answer can be left out of a step. */
static bool has_idle_orders(const path *p)
{
    return p->best && p->radius_A > 0.0 && p->wishes->is_coarse &&
           p->wishes->program.minimise == HCI_MINIMISE_WORST;
}

/* The wishes with torque and voltage made linear at p->from. */
static hci_status step(const path *p, hci_note *note)
{
    hci_wishes *w = p->wishes;
    hci_task *t = w->of->task;
    hci_status status = waves_of(w, p->from, &w->current, note);
    w->best = p->best;
    w->program.centre = p->from;
    w->program.radius_A = p->radius_A;
    w->program.idle_Nm = has_idle_orders(p) ? IDLE * p->merit.ripple_Nm : 0.0;
    if (!status && !hci_task_is_linear(t))
        status = hci_task_linearise(t, w->current.wave, w->current.count, w->of->at, note);
    return status ? status : hci_wishes_meet(w, note);
}

/* Share of the limit by which the true voltage is beyond it, which was made linear at other currents. */
static double overshoot(const hci_wishes *w, const hci_wave_list *i)
{
    const hci_limit_program *p = &w->program;
    double most = 0.0;
    for (size_t q = 0; q < p->grids && hci_limit_is_bent(&p->field); ++q) {
        const hci_limit_grid *grid = &p->grid[q];
        const double limit_V = hci_limit_of_point(p->bounds, grid->kind, grid->phase) * (1.0 + p->widened);
        const bool is_voltage = grid->kind == HCI_POINT_VOLTAGE || grid->kind == HCI_POINT_VECTOR;
        for (size_t k = 0; is_voltage && k < grid->samples; ++k) {
            const hci_limit_point at = {grid->kind, grid->phase, grid->step_rad * (double)k, 0.0};
            most = fmax(most, fabs(hci_limit_link_V(&p->field, &at, i)) / limit_V - 1.0);
        }
    }
    return most;
}

hci_status hci_limited_path_merit(const hci_wishes *w, const double *x, hci_limit_merit *merit,
                                  hci_note *note)
{
    hci_wave_list i = {NULL, 0};
    hci_status status = waves_of(w, x, &i, note);
    if (!status) status = hci_limit_merit_evaluate(w->of->task, w->program.minimise, &i, merit, note);
    if (!status) merit->overshoot_Nm = w->program.scale_Nm * overshoot(w, &i);
    hci_memory_free(i.wave);
    return status;
}

/* The ripple with the errors of mean and voltage, which a step within a bound leaves of the order of its
 * square and the next one takes away. What the last steps take away anyhow is free: charged, it would keep
 * the steps short (Maratos). */
static double weighed_Nm(const path *p, const hci_limit_merit *m)
{
    const double off_Nm = m->mean_error_Nm + m->overshoot_Nm - FREE * p->wishes->program.scale_Nm;
    return m->ripple_Nm + MEAN_TO_RIPPLE * fmax(off_Nm, 0.0);
}

/* Whether steps within a bound are judged by that: as long as the mean can be had at all. */
static bool is_weighed(const path *p)
{
    return p->radius_A > 0.0 && p->wishes->is_coarse && p->wishes->program.has_mean;
}

/* Whether a precise step takes errors away of a torque and a voltage that were made linear elsewhere, between
 * the angles too, for no more than copper. */
static bool tightens(const path *p, const hci_limit_merit *merit)
{
    const double same_Nm = SAME * p->wishes->program.scale_Nm;
    return p->radius_A > 0.0 && merit->overshoot_Nm <= p->merit.overshoot_Nm &&
           merit->mean_error_Nm <= p->merit.mean_error_Nm + same_Nm &&
           merit->ripple_Nm <= p->merit.ripple_Nm + same_Nm;
}

/* Whether an answer is better than the best. */
static bool is_less(const path *p, const hci_limit_merit *merit)
{
    if (is_weighed(p)) return weighed_Nm(p, merit) < weighed_Nm(p, &p->merit);
    return tightens(p, merit) || hci_limit_merit_less(merit, &p->merit, p->wishes->program.scale_Nm);
}

/* Keeps the answer where its true torque is better than that of the best. */
static hci_status judge(path *p, bool *is_better, hci_note *note)
{
    const hci_wishes *w = p->wishes;
    hci_limit_merit merit;
    const hci_status status = hci_limited_path_merit(w, w->x, &merit, note);
    if (status) return status;
    *is_better = !p->best || is_less(p, &merit);
    if (!*is_better) return HCI_OK;
    if (!p->best) p->best = hci_memory_new(p->n, sizeof *p->best);
    if (!p->best) return out_of_memory(note);
    memcpy(p->best, w->x, p->n * sizeof *p->best);
    p->merit = merit;
    return HCI_OK;
}

/* By Anderson's acceleration; by a share of the way where the change grows. */
static void move_freely(path *p, double before)
{
    const double *x = p->wishes->x;
    if (p->change < before) {
        p->share = 1.0;
        hci_anderson_step(&p->mixing, p->from, x);
        return;
    }
    p->share = fmax(0.5 * p->share, LEAST_SHARE);
    for (size_t j = 0; j < p->n; ++j)
        p->from[j] += p->share * (x[j] - p->from[j]);
}

/* Where the current does not come to rest: from the best answer on, no further than half of the last step. */
static void bound(path *p)
{
    p->promised_Nm = HUGE_VAL;
    p->radius_A = 0.5 * distance(p, p->wishes->x, p->from);
    memcpy(p->from, p->best, p->n * sizeof *p->from);
}

/* Whether for a while the change has not been halved and the torque not been much better. was_Nm: see
 * move_bounded. */
static bool is_restless(path *p, double was_Nm)
{
    ++p->idle;
    if (was_Nm - weighed_Nm(p, &p->merit) > NOTABLE * was_Nm) p->idle = 0;
    if (p->change < 0.5 * p->least_change) {
        p->least_change = p->change;
        p->idle = 0;
    }
    return p->idle > p->patience;
}

/* A step that was not better may have gone the right way, with an error of the square of its length: one
 * short step beside its end, which takes that away, before a shorter one is tried. */
static void correct(path *p)
{
    p->tried_A = p->radius_A;
    p->radius_A *= CORRECTED;
    memcpy(p->from, p->wishes->x, p->n * sizeof *p->from);
}

/* The bound of the next step from the best answer on. A step that made much less than what was linear
 * promised is no reason for a longer one, and with its correction for one as long. */
static void bound_next(path *p, bool is_better, double gained_Nm)
{
    const double moved_A = distance(p, p->wishes->x, p->from);
    const bool is_held = gained_Nm > HELD * p->promised_Nm;
    if (p->tried_A > 0.0)
        p->radius_A = p->tried_A * (is_better && is_held ? 1.0 : SHRINK);
    else if (!is_better)
        p->radius_A = SHRINK * fmin(p->radius_A, moved_A);
    else if (moved_A > 0.9 * p->radius_A && (!is_weighed(p) || is_held))
        p->radius_A *= GROW;
    p->tried_A = 0.0;
    memcpy(p->from, p->best, p->n * sizeof *p->from);
}

/* was_Nm: the weighed ripple of the best answer before. */
static void move_bounded(path *p, bool is_better, double was_Nm)
{
    const double gained_Nm = was_Nm - weighed_Nm(p, &p->merit);
    const bool is_new = !(p->tried_A > 0.0);
    if (is_new) p->promised_Nm = was_Nm - p->wishes->program.ripple_Nm;
    if (is_new && !is_better && is_weighed(p)) {
        correct(p);
        return;
    }
    p->slow = gained_Nm > LEFT * p->wishes->program.scale_Nm ? 0 : p->slow + 1;
    bound_next(p, is_better, gained_Nm);
}

/* Where rounding spoils a step: from the best answer on, within less; before there is one, from half of the
 * currents, whose torque is nearer to linear. */
static hci_status step_back(path *p, hci_status status, const hci_note *why, hci_note *note)
{
    if (status != HCI_ERROR_NUMERIC || (!p->best && p->halved == HALVES))
        return hci_note_set(note, status, "%s", why->text);
    if (!p->best) {
        ++p->halved;
        for (size_t j = 0; j < p->n; ++j)
            p->from[j] *= 0.5;
        return HCI_OK;
    }
    p->radius_A =
        p->radius_A > 0.0 ? SHRINK * fmax(p->radius_A, p->tried_A) : AFTER_FAILURE * length(p, p->best);
    p->tried_A = 0.0;
    memcpy(p->from, p->best, p->n * sizeof *p->from);
    return HCI_OK;
}

static hci_status advance(path *p, hci_note *note)
{
    const double before = p->change, was_Nm = weighed_Nm(p, &p->merit);
    bool is_better = false;
    hci_note why = {{0}};
    hci_status status;
    p->wishes->is_coarse = p->change > (p->wishes->is_coarse ? COARSE : LOOSE) || p->radius_A > 0.0;
    p->wishes->is_far = p->change > FAR;
    status = step(p, &why);
    if (!status) status = judge(p, &is_better, &why);
    if (status) return step_back(p, status, &why, note);
    p->change = distance(p, p->wishes->x, p->from) / fmax(length(p, p->wishes->x), 1e-12);
    if (p->radius_A > 0.0)
        move_bounded(p, is_better, was_Nm);
    else if (is_restless(p, was_Nm))
        bound(p);
    else
        move_freely(p, before);
    return HCI_OK;
}

static bool goes_on(const path *p)
{
    if (is_weighed(p))
        return p->radius_A > CLOSEST * length(p, p->from) && p->slow < PATIENCE &&
               p->promised_Nm > LEFT * p->wishes->program.scale_Nm;
    if (p->radius_A > 0.0) return p->radius_A > CLOSE * length(p, p->from);
    return p->wishes->is_coarse || p->change > COARSE || (p->change > CONVERGED && p->idle == 0);
}

/* ---- the last steps ---- */

static hci_status settle_at(path *p, double radius_A, bool is_coarse, hci_note *note)
{
    p->wishes->is_coarse = is_coarse;
    p->wishes->is_far = false;
    memcpy(p->from, p->best, p->n * sizeof *p->from);
    p->radius_A = radius_A;
    return step(p, note);
}

/* What a step says of the limits beside its currents. */
typedef struct {
    hci_limit_cost cost;
    hci_limit_optimum gains;
    double exceeded_share, minimised_Nm;
} account;

static account account_of(const hci_wishes *w)
{
    const hci_solution *s = w->of->solution;
    return (account){s->limit_cost, w->cost, s->exceeded_share, s->minimised_Nm};
}

/* The best answer with what the step of `said` tells. */
static void give_best(const path *p, const account *said)
{
    hci_solution *s = p->wishes->of->solution;
    memcpy(p->wishes->x, p->best, p->n * sizeof *p->best);
    s->limit_cost = said->cost;
    s->exceeded_share = said->exceeded_share;
    s->minimised_Nm = said->minimised_Nm;
    p->wishes->cost = said->gains;
}

/* One more step, kept where it needs no wider limits and its true torque is better. The bound on the distance
 * takes part in what limits cost, so that this stays as it was. */
static hci_status polish_once(path *p, double radius_A, account *said, hci_note *note)
{
    hci_note why = {{0}};
    bool is_better = false;
    hci_status status = settle_at(p, radius_A, false, &why);
    const account now = account_of(p->wishes);
    if (!status) p->change = distance(p, p->wishes->x, p->from) / fmax(length(p, p->from), 1e-12);
    if (!status && now.exceeded_share <= said->exceeded_share) status = judge(p, &is_better, &why);
    if (is_better) said->minimised_Nm = now.minimised_Nm;
    return hci_wish_is_end(status) ? hci_note_set(note, status, "%s", why.text) : HCI_OK;
}

/* A voltage that is not linear has to be within its limit more closely than that. */
static bool is_polished(const path *p)
{
    const hci_limit_program *w = &p->wishes->program;
    return !hci_limit_is_bent(&w->field) && p->merit.mean_error_Nm < POLISHED * w->scale_Nm;
}

/* The last step leaves an error of the square of its length in the true torque: further ones, each within
 * less. */
static hci_status polish(path *p, hci_note *note)
{
    account said = account_of(p->wishes);
    double radius_A = p->radius_A;
    bool ignored;
    hci_status status;
    hci_memory_free(p->best);
    p->best = NULL;
    status = judge(p, &ignored, note);
    p->wishes->is_kept = true;
    p->wishes->kept_Nm = said.minimised_Nm;
    for (int k = 0; k < POLISHES && !status && !is_polished(p); ++k)
        status = polish_once(p, radius_A *= POLISH, &said, note);
    p->wishes->is_kept = false;
    if (!status) give_best(p, &said);
    p->wishes->of->solution->newton_change = p->change;
    return status;
}

/* The last step beside the best answer, with peaks between the angles brought within their limits; where
 * rounding spoils that within more, and at last left as they are. */
static hci_status settle(path *p, hci_note *note)
{
    const double most_A = SETTLING * length(p, p->best),
                 least_A = is_weighed(p) ? fmin(most_A, fmax(2.0 * p->radius_A, POLISH * most_A)) : most_A;
    hci_note why = {{0}};
    hci_status status = settle_at(p, least_A, false, &why);
    if (status == HCI_ERROR_NUMERIC) status = settle_at(p, 3.0 * most_A, false, &why);
    if (!status) return polish(p, note);
    if (status == HCI_ERROR_NUMERIC) return settle_at(p, least_A, true, note);
    return hci_note_set(note, status, "%s", why.text);
}

/* ---- all of it ---- */

/* Whether neither torque nor voltage has to be made linear. */
static bool is_linear(const hci_wishes *w)
{
    const hci_effects *e = w->of->options->effects;
    return hci_task_is_linear(w->of->task) && !(e && e->count > 0 && w->of->bounds->line_V < HUGE_VAL);
}

static bool has_steps(const path *p, int made)
{
    return made < MOST_STEPS && p->wishes->steps < HCI_LIMITED_MOST_STEPS;
}

static hci_status iterate(path *p, hci_note *note)
{
    hci_solution *s = p->wishes->of->solution;
    hci_status status = hci_anderson_reset(&p->mixing, p->n) ? out_of_memory(note) : HCI_OK;
    int k = 0;
    p->change = p->least_change = HUGE_VAL;
    p->patience = p->wishes->is_bounded ? 0 : PATIENCE;
    p->wishes->is_coarse = true;
    p->share = 1.0;
    for (; has_steps(p, k) && goes_on(p) && !status; ++k, ++p->wishes->steps)
        status = advance(p, note);
    p->is_ended = !has_steps(p, k) && goes_on(p);
    p->wishes->is_ended = p->wishes->is_ended || p->is_ended;
    s->newton_steps += (size_t)k;
    s->newton_converged = !p->wishes->is_ended;
    s->newton_change = p->change;
    p->wishes->is_bounded = p->radius_A > 0.0;
    return status;
}

static void end(path *p)
{
    hci_anderson_release(&p->mixing);
    hci_memory_free(p->best);
    p->wishes->program.centre = NULL;
    p->wishes->best = NULL;
}

hci_status hci_limited_path_follow(hci_wishes *wishes, double *from, hci_note *note)
{
    path p = {.wishes = wishes, .n = 2 * wishes->set.count, .from = from};
    hci_status status = is_linear(wishes) ? step(&p, note) : iterate(&p, note);
    if (!status && p.best && (p.radius_A > 0.0 || p.is_ended)) status = settle(&p, note);
    end(&p);
    return status;
}

hci_status hci_limited_path_approach(hci_wishes *wishes, double *from, hci_note *note)
{
    path p = {.wishes = wishes, .n = 2 * wishes->set.count, .from = from};
    const hci_status status = iterate(&p, note);
    if (!status && p.radius_A > 0.0) memcpy(wishes->x, p.best, p.n * sizeof *p.best);
    end(&p);
    return status;
}
