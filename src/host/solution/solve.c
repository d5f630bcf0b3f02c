/* From a wanted torque to currents. In: a machine, its effects, and what is asked for; out: a solution, with
 * what the currents do and cost. This file sets the task, lets one of linear.c, newton.c and pointwise.c
 * answer it (hold.c), and puts the answer into the solution. */
#include "hci/host/solve/solve.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "host/base/memory.h"
#include "host/currents/plain_sine.h"
#include "host/machine/torque_constant.h"
#include "host/solution/expect.h"
#include "host/solution/hold.h"
#include "host/solution/limited.h"
#include "host/solution/limits.h"
#include "host/solution/loop_reach.h"
#include "host/solve/evaluate_solution.h"
#include "host/solve/pointwise.h"
#include "host/solve/torque_spectrum.h"

#define DEFAULT_TOLERANCE 1e-6

/* ---- the task ---- */

static hci_status check_machine(const hci_machine_data *m, const hci_solve_options *o, hci_note *note)
{
    if (m->has_effects && !o->effects)
        return hci_note_set(note, HCI_ERROR_INPUT,
                            "effects.csv holds effects that were not given; read it with "
                            "hci_effects_read_machine, or remove it to leave them out");
    if (o->method == HCI_METHOD_POINTWISE && o->held)
        return hci_note_set(note, HCI_ERROR_ARGUMENT,
                            "method pointwise finds the whole current; it cannot hold the fundamental fixed");
    if (o->set && (o->choose_at_most > 0 || o->method == HCI_METHOD_POINTWISE))
        return hci_note_set(
            note, HCI_ERROR_ARGUMENT, "a set of harmonics is given, and %s; leave out one of them",
            o->choose_at_most > 0 ? "so many are to be chosen" : "method pointwise has no set");
    return HCI_OK;
}

/* The neutral conductor carries a zero sequence, which the methods for torque that is not linear leave out.
 */
static hci_status check_star(const hci_machine_data *m, const hci_task *t, hci_note *note)
{
    if (hci_task_is_linear(t) || !m->has_neutral) return HCI_OK;
    return hci_note_set(
        note, HCI_ERROR_INPUT,
        m->model.slope_count > 0
            ? "an interior-magnet machine is solved in star connection only; machine.csv says star-neutral"
            : "reluctance and saturation are solved in star connection only; machine.csv says star-neutral");
}

static hci_status check_held(const hci_solve_options *o, hci_note *note)
{
    if (o->held && !(isfinite(o->held->sine) && isfinite(o->held->cosine)))
        return hci_note_set(note, HCI_ERROR_ARGUMENT,
                            "the fundamental that is held has an amplitude or a phase that is not finite; "
                            "give two finite numbers");
    for (size_t k = 0; o->held && o->set && k < o->set->count; ++k)
        if (o->set->component[k].sequence == o->held->sequence &&
            fabs(o->set->component[k].order - o->held->order) < HCI_ORDER_TOLERANCE)
            return hci_note_set(
                note, HCI_ERROR_INPUT,
                "the set of harmonics names %s %g, which is held fixed; leave it out of the set or do "
                "not hold the fundamental",
                hci_set_name(o->set->set[k]), o->held->order);
    return HCI_OK;
}

static hci_status make_task(const hci_machine_data *m, const hci_quadratic_model *model,
                            const hci_solve_options *o, hci_task *t, hci_note *note)
{
    hci_status status;
    hci_task_begin(model, o->target, t);
    t->has_neutral = m->has_neutral;
    t->held = o->held;
    t->strategy = o->strategy;
    t->current_angle_rad = o->method == HCI_METHOD_POINTWISE ? o->current_angle_rad : NULL;
    t->highest_rotor_order = o->highest_rotor_order;
    t->progress = o->progress;
    t->progress_context = o->progress_context;
    t->stop = o->stop;
    t->stop_context = o->stop_context;
    status = check_star(m, t, note);
    if (!status) status = check_held(o, note);
    return status ? status : hci_task_find_period(t, o->set, o->held, o->held ? 1 : 0, note);
}

/* ---- what flows ---- */

/* Components below this share of the largest are rounding, not current. */
#define NEGLIGIBLE 1e-12

static bool is_negligible(const hci_answer *a, double mean_Nm, size_t k, double largest)
{
    const double *x = a->x, *rest = x + 2 * a->set.count;
    const double scale = fabs(mean_Nm) > 0.0 ? fabs(mean_Nm) : 1.0;
    const double size = fmax(scale * hypot(x[2 * k], x[2 * k + 1]), hypot(rest[2 * k], rest[2 * k + 1]));
    return size <= NEGLIGIBLE * largest;
}

static double largest_current(const hci_answer *a, double mean_Nm)
{
    double largest = 0.0;
    for (size_t k = 0; k < 2 * a->set.count; ++k)
        largest = fmax(largest, fmax(fabs(mean_Nm * a->x[k]), fabs(a->x[2 * a->set.count + k])));
    return largest;
}

static void release_currents(hci_solution *s)
{
    hci_currents_release(&s->current);
    hci_memory_free(s->per_Nm);
    hci_memory_free(s->constant);
    s->per_Nm = s->constant = NULL;
}

static hci_status reserve_currents(size_t most, bool has_parts, hci_solution *s, hci_note *note)
{
    bool has_memory;
    s->current.wave = hci_memory_new(most, sizeof *s->current.wave);
    s->current.set = hci_memory_new(most, sizeof *s->current.set);
    s->per_Nm = has_parts ? hci_memory_new(most, sizeof *s->per_Nm) : NULL;
    s->constant = has_parts ? hci_memory_new(most, sizeof *s->constant) : NULL;
    has_memory = s->current.wave && s->current.set && (!has_parts || (s->per_Nm && s->constant));
    return has_memory ? HCI_OK : hci_note_memory(note, NULL, "solving");
}

/* Component k of the answer: the total, and where there are such the parts. */
static void add_component(const hci_answer *a, size_t k, double mean_Nm, hci_solution *s)
{
    const hci_component c = a->set.component[k];
    const double *x = a->x + 2 * k, *rest = x + 2 * a->set.count;
    const size_t out = s->current.count++;
    s->current.set[out] = a->set.set[k];
    s->current.wave[out] =
        (hci_wave){c.order, c.sequence, mean_Nm * x[0] + rest[0], mean_Nm * x[1] + rest[1]};
    if (!s->per_Nm) return;
    s->per_Nm[out] = (hci_wave){c.order, c.sequence, x[0], x[1]};
    s->constant[out] = (hci_wave){c.order, c.sequence, rest[0], rest[1]};
}

/* Waves of the total, of the part per N·m and of the constant part. A given set keeps all its components, a
 * chosen or pointwise one only those that carry current. */
static hci_status fill_currents(const hci_answer *a, const hci_solve_options *o, bool has_parts,
                                hci_solution *s, hci_note *note)
{
    const double mean_Nm = hci_target_mean_Nm(o->target), largest = largest_current(a, mean_Nm);
    const hci_status status = reserve_currents(a->set.count + 1, has_parts, s, note);
    if (status) return status;
    if (o->held) {
        s->current.set[0] = HCI_SET_POS;
        s->current.wave[0] = *o->held;
        s->current.count = 1;
    }
    for (size_t k = 0; k < a->set.count; ++k)
        if (o->set || !is_negligible(a, mean_Nm, k, largest)) add_component(a, k, mean_Nm, s);
    return HCI_OK;
}

/* Takes the set from the answer. */
static hci_status fill_system(const hci_task *t, hci_answer *a, hci_solution *s, hci_note *note)
{
    const size_t entries = hci_system_capacity(t->gradient_count, a->set.count);
    hci_solved_system *u = &s->system;
    double *order = hci_memory_new(s->order_count, sizeof *order);
    bool has_memory;
    u->column_start = hci_memory_new(2 * a->set.count + 1, sizeof *u->column_start);
    u->row = hci_memory_new(entries, sizeof *u->row);
    u->value = hci_memory_new(entries, sizeof *u->value);
    has_memory = order && u->column_start && u->row && u->value;
    if (has_memory) {
        for (size_t k = 0; k < s->order_count; ++k)
            order[k] = s->order[k].torque_Nm.order;
        hci_system_sparse(&(hci_mutual_torque){t->gradient, t->gradient_count, order, s->order_count},
                          a->set.component, a->set.count, u->column_start, u->row, u->value);
        u->set = a->set;
        a->set = (hci_component_set){0};
    }
    hci_memory_free(order);
    return has_memory ? HCI_OK : hci_note_memory(note, NULL, "solving");
}

/* ---- all of it ---- */

/* An error is measured against the mean torque, or where that is next to nothing against the largest wanted
 * or cogging torque; where there is none against the torque of 1 A. */
#define LEAST_SHARE 1e-3

static double torque_scale_Nm(const hci_task *t)
{
    const double mean_Nm = fabs(hci_target_mean_Nm(t->target));
    const hci_effects none = {NULL, 0};
    double scale = 0.0;
    for (size_t k = 0; k < t->target->count; ++k)
        scale = fmax(scale,
                     hci_amplitude(t->target->order[k].torque_Nm.sine, t->target->order[k].torque_Nm.cosine));
    for (size_t k = 0; k < t->machine->cogging_count; ++k)
        scale = fmax(scale, hci_amplitude(t->machine->cogging[k].sine, t->machine->cogging[k].cosine));
    if (mean_Nm > 0.0) return fmax(mean_Nm, LEAST_SHARE * scale);
    return scale > 0.0 ? scale : fabs(hci_torque_constant(t->machine, &none));
}

static hci_status verdict_of(const hci_solution *s)
{
    for (size_t k = 0; k < s->order_count; ++k)
        if (s->order[k].verdict > HCI_ORDER_FREE) return HCI_NOT_REACHED;
    return s->within_limits ? HCI_OK : HCI_NOT_REACHED;
}

static void join_lines(const char *text, char *joined, size_t size)
{
    for (const char *line = text; *line != '\0'; line += strspn(line, "\n")) {
        const size_t used = strlen(joined), length = strcspn(line, "\n");
        snprintf(joined + used, size - used, "%s%.*s", used > 0 ? ", " : "", (int)length, line);
        line += length;
    }
}

/* Names of the effects that do not act in the machine, and what that means. */
static void remark_left_out(const hci_effects *effects, const char *corrections, hci_note *remark)
{
    char names[256] = "", lines[HCI_CORRECTIONS_SIZE] = "";
    join_lines(corrections, lines, sizeof lines);
    for (size_t k = 0; k < effects->count; ++k) {
        const size_t used = strlen(names);
        if (effects->effect[k].type->in_machine) continue;
        snprintf(names + used, sizeof names - used, "%s%s", used > 0 ? ", " : "",
                 effects->effect[k].type->name);
    }
    hci_note_add(
        remark,
        "effects.csv: not compensated, since it acts on the shaft or in a sensor and not in the machine: "
        "%s%s%s",
        names,
        *corrections
            ? "; the currents are for the true angle and the true current, so the drive that plays them has "
              "to correct what its sensors read, where they are those of the recordings: "
            : "",
        lines);
}

/* Everything that is freed when a solution is made. */
typedef struct {
    hci_quadratic_model model;
    hci_task task;
    hci_bounds bounds;
    hci_linear_torque at; /* where the task was made linear last */
    hci_answer answer;
    hci_held held;
} work;

/* What the plain sine of the wanted mean torque takes, by which a ratio of copper is meant. */
static double plain_A(const hci_task *t)
{
    const hci_wave plain = t->held ? *t->held : hci_plain_sine(t->machine, hci_target_mean_Nm(t->target));
    return hci_amplitude(plain.sine, plain.cosine);
}

/* Waves of an answer, and how they stand to the limits. */
static hci_status take_answer(const hci_machine_data *m, const hci_solve_options *o, work *w, bool has_parts,
                              hci_solution *s, hci_note *note)
{
    hci_status status;
    release_currents(s);
    status = fill_currents(&w->answer, o, has_parts, s, note);
    return status ? status : hci_limits_check(m, o, &w->bounds, s, note);
}

/* Whether the torque of the currents is within the tolerance at every order that is cared for. */
static hci_status find_whether_met(const hci_task *t, const hci_solution *s, bool *is_met, hci_note *note)
{
    hci_harmonic_list torque;
    const hci_status status =
        hci_torque_spectrum_evaluate(t, s->current.wave, s->current.count, &torque, note);
    *is_met = true;
    for (size_t k = 0; k < torque.count; ++k) {
        const hci_target_order wanted = hci_target_at(t->target, torque.harmonic[k].order);
        if (wanted.weight > 0.0 &&
            hci_torque_distance_Nm(torque.harmonic[k], wanted.torque_Nm) > s->tolerance_Nm)
            *is_met = false;
    }
    hci_memory_free(torque.harmonic);
    return status;
}

/* Whether the currents without limits are the answer: they keep the limits, and no ripple is left that is to
 * be made smallest. */
static hci_status find_whether_done(const hci_task *t, const hci_solve_options *o, const hci_solution *s,
                                    bool *is_done, hci_note *note)
{
    *is_done = s->within_limits;
    if (!s->within_limits || o->minimise == HCI_MINIMISE_AUTO) return HCI_OK;
    return find_whether_met(t, s, is_done, note);
}

/* The currents without limits; where they do not keep them, or leave a ripple that is to be made smallest,
 * those within. */
static hci_status find_currents(const hci_limited *within, work *w, hci_note *note)
{
    const hci_machine_data *m = within->machine;
    const hci_solve_options *o = within->options;
    hci_solution *s = within->solution;
    const double mean_Nm = hci_target_mean_Nm(o->target);
    bool has_parts, is_done;
    hci_status status = hci_held_answer(within, &w->answer, &has_parts, &w->held, note);
    s->wanted_mean_Nm = mean_Nm;
    s->minimised_Nm = s->torque_at_limit_Nm = NAN;
    if (!status) status = take_answer(m, o, w, has_parts, s, note);
    if (status || o->method == HCI_METHOD_POINTWISE) return status;
    hci_limits_scale(&w->bounds, mean_Nm, s);
    status = find_whether_done(&w->task, o, s, &is_done, note);
    if (status || is_done) return status;
    status = hci_limited_answer(within, &w->answer, note);
    return status ? status : take_answer(m, o, w, false, s, note);
}

static hci_status solve_task(const hci_machine_data *machine, const hci_solve_options *o, work *w,
                             hci_solution *s, hci_note *note)
{
    hci_task *t = &w->task;
    const hci_limited within = {t, machine, o, &w->bounds, &w->at, s};
    hci_status status;
    s->with_effects = o->effects && o->effects->count > 0;
    s->period_turns = t->period_turns;
    s->tolerance_Nm = (o->tolerance > 0.0 ? o->tolerance : DEFAULT_TOLERANCE) * torque_scale_Nm(t);
    s->limit_mean_square_A2 = hci_pointwise_mean_square_A2(t);
    hci_limits_list(&w->bounds, s);
    status = find_currents(&within, w, note);
    if (!status) status = hci_held_tell(&within, &w->held, &w->answer, note);
    if (!status)
        status = hci_solution_evaluate(t, &w->answer.set, o->set ? o->compare : HCI_COMPARE_ALL, s, note);
    if (!status && o->method != HCI_METHOD_POINTWISE) status = fill_system(t, &w->answer, s, note);
    if (!status) status = hci_solution_expect(&machine->model, o, s, note);
    return status ? status : hci_loop_reach_find(t, machine, o, s, note);
}

hci_status hci_solve(const hci_machine_data *machine, const hci_solve_options *options,
                     hci_solution *solution, hci_note *note)
{
    const double temperature_C = hci_magnet_temperature_C(options);
    work w = {0};
    hci_status status = check_machine(machine, options, note);
    memset(solution, 0, sizeof *solution);
    if (!status)
        status = hci_quadratic_model_make(&machine->model, options->effects, temperature_C, &w.model, note);
    if (!status) status = make_task(machine, &w.model, options, &w.task, note);
    if (!status) status = hci_bounds_make(machine, options, plain_A(&w.task), &w.bounds, note);
    if (!status) status = solve_task(machine, options, &w, solution, note);
    if (!status) solution->machine = machine->identity;
    if (!status && !options->limits.ignore_ratings) {
        hci_limits_remark_rated(machine, solution);
        hci_limits_remark_declared(machine, &w.bounds, solution);
    }
    if (!status) hci_limits_remark_open(&w.bounds, solution);
    if (!status && options->effects)
        hci_corrections_words(options->effects, solution->corrections, sizeof solution->corrections);
    if (!status && w.model.left_out > 0)
        remark_left_out(options->effects, solution->corrections, &solution->remark);
    hci_answer_release(&w.answer);
    hci_answer_release(&w.held.as_they_come);
    hci_linear_torque_release(&w.at);
    hci_quadratic_model_release(&w.model);
    if (!status) return verdict_of(solution);
    hci_solution_release(solution);
    return status;
}

void hci_solution_release(hci_solution *solution)
{
    release_currents(solution);
    hci_memory_free(solution->order);
    hci_component_set_release(&solution->system.set);
    hci_memory_free(solution->system.column_start);
    hci_memory_free(solution->system.row);
    hci_memory_free(solution->system.value);
    memset(solution, 0, sizeof *solution);
}
