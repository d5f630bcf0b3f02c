/* A stage as a convex program: its rows (rows.h) and its objective to the solver, and its answer back.
 */
#include "host/limit/stage.h"

#include <math.h>
#include <string.h>

#include "core/math/vector.h"
#include "host/base/memory.h"
#include "host/conic/solve.h"
#include "host/limit/rows.h"

#define LEAST_PRICE 1e-9 /* of current where nothing else prices it, lest it be without bounds */
#define LOW_PRICE   1e-7 /* the same beside the ripple, so that it is the same currents that are looked for */
#define WORST_ERROR 1e-5 /* of a program, relative, that is taken as solved */

static double price_of_copper(hci_limit_stage stage)
{
    if (stage == HCI_STAGE_COPPER) return 1.0;
    return stage == HCI_STAGE_RIPPLE ? LOW_PRICE : LEAST_PRICE;
}

/* What a square counts beside the copper. */
static double size_of(const hci_limit_build *b, size_t j)
{
    const double size = b->stage == HCI_STAGE_COPPER
                            ? hci_task_size_of(b->of->task, b->of->field.set->component[j / 2])
                            : 1.0;
    return size * size;
}

static void fill_objective(hci_limit_build *b)
{
    for (size_t j = 0; j < b->coordinates; ++j)
        b->p[j * (b->n + 1)] = price_of_copper(b->stage) * size_of(b, j) *
                               hci_limit_copper_of(b->of->field.set->component[j / 2], (int)(j % 2));
    if (b->stage != HCI_STAGE_COPPER) b->c[hci_limit_objective(b)] = 1.0;
    for (size_t j = b->coordinates; b->stage == HCI_STAGE_COPPER && j < b->n; ++j)
        b->p[j * (b->n + 1)] = LEAST_PRICE;
}

void hci_limit_stage_fill(hci_limit_build *b)
{
    hci_limit_add_angles(b);
    b->two_sided = b->stage == HCI_STAGE_FIT ? 0 : b->rows;
    hci_limit_add_mean(b);
    hci_limit_add_torque_angles(b);
    hci_limit_add_swing(b);
    b->linear = b->rows;
    hci_limit_add_vectors(b);
    hci_limit_add_torque_cones(b);
    hci_limit_add_rms(b);
    hci_limit_add_copper(b);
    hci_limit_add_trust(b);
    hci_limit_add_open(b);
    hci_limit_add_orders(b);
    fill_objective(b);
}

/* Rows of n + 1 numbers to a matrix by columns, the right side as its last one. NULL when memory is out. */
static double *by_columns(const double *row, size_t rows, size_t width)
{
    double *out = hci_memory_new(rows * width, sizeof *out);
    for (size_t k = 0; out && k < rows; ++k)
        for (size_t j = 0; j < width; ++j)
            out[k + j * rows] = row[k * width + j];
    return out;
}

/* ---- its answer ---- */

/* What the objective gains for 1 more of each limit: the multiplier over the limit, by which its rows were
 * divided. */
static void read_gain(const hci_bounds *l, size_t tag, double gain, hci_limit_optimum *o)
{
    hci_limit_kind kind;
    int phase;
    if (tag == 0) return;
    hci_limit_of_tag(tag, &kind, &phase);
    if (kind == HCI_LIMIT_CURRENT) o->current_gain[phase] += gain / l->current_A[phase];
    if (kind == HCI_LIMIT_RMS) o->rms_gain[phase] += gain / l->rms_A[phase];
    if (kind == HCI_LIMIT_VOLTAGE) o->voltage_gain += gain / l->line_V * l->line_V_per_V;
    if (kind == HCI_LIMIT_COPPER) o->copper_gain += 0.5 * gain / l->mean_square_A2;
}

/* Of the stage's objective: share, N·m, or A² of 1 of the program's. */
static double unit_of(const hci_limit_build *b)
{
    const double scale_A = b->of->scale_A;
    if (b->stage == HCI_STAGE_FIT) return 1.0;
    return b->stage == HCI_STAGE_COPPER ? 3.0 * scale_A * scale_A : b->of->scale_Nm;
}

void hci_limit_stage_add_gain(const hci_limit_build *b, size_t tag, double z, hci_limit_optimum *o)
{
    read_gain(b->of->bounds, tag, unit_of(b) * fabs(z) / (1.0 + b->of->widened), o);
}

static double copper_A2(const hci_limit_build *b, const double *x)
{
    double sum = 0.0;
    for (size_t j = 0; j < b->coordinates; ++j)
        sum += hci_limit_copper_of(b->of->field.set->component[j / 2], (int)(j % 2)) * x[j] * x[j];
    return 1.5 * sum;
}

void hci_limit_stage_read(const hci_limit_build *b, const hci_cone_answer *a, hci_limit_optimum *o)
{
    const double unit = unit_of(b), *wish = a->x + hci_limit_objective(b);
    o->is_infeasible = a->end == HCI_CONE_INFEASIBLE;
    for (size_t j = 0; j < b->coordinates; ++j)
        o->x[j] = b->of->scale_A * a->x[j];
    o->smallest = b->stage == HCI_STAGE_COPPER ? copper_A2(b, o->x) : unit * wish[0];
    if (b->n > b->coordinates + 1) {
        o->highest_Nm = b->of->scale_Nm * wish[1];
        o->lowest_Nm = b->of->scale_Nm * wish[2];
    }
    if (b->distance > 0)
        o->pull = unit * fabs(a->z[b->distance - 1]) * sqrt(hci_vector_dot(b->coordinates, o->x, o->x)) /
                  b->of->radius_A;
    for (size_t k = 0; k < b->rows; ++k)
        hci_limit_stage_add_gain(b, b->limit_of[k], a->z[k], o);
}

/* ---- all of it ---- */

static hci_cone_problem problem_of(const hci_limit_build *b, const double *g, const double *equal)
{
    return (hci_cone_problem){.unknowns = b->n,
                              .p = b->p,
                              .c = b->c,
                              .equalities = b->equalities,
                              .a = equal,
                              .b = equal + b->n * b->equalities,
                              .rows = b->rows,
                              .two_sided = b->two_sided,
                              .linear = b->linear,
                              .g = g,
                              .h = g + b->n * b->rows,
                              .low = b->low,
                              .cones = b->cones,
                              .cone = b->cone,
                              .precision = b->of->precision};
}

/* What ends a stage, and where it did last; without a function nothing does. */
typedef struct {
    hci_limit_finish *finish;
    hci_limit_rest *last;
} ending;

static hci_status finish(const ending *e, const hci_limit_build *b, const hci_cone_answer *answer,
                         hci_limit_optimum *o, hci_note *note)
{
    return e->finish && e->finish(b, answer, e->last, o)
               ? hci_note_memory(note, NULL, "solving within limits")
               : HCI_OK;
}

static hci_status solve(const hci_limit_build *b, const hci_cone_problem *problem, const ending *e,
                        hci_limit_optimum *o, hci_note *note)
{
    hci_cone_answer answer;
    hci_status status = hci_cone_solve(problem, &answer, note);
    if (!status && answer.end != HCI_CONE_INFEASIBLE && !(answer.error < WORST_ERROR))
        status = hci_note_set(note, HCI_ERROR_NUMERIC,
                              "they were not met to working precision (%.1e); try wider or fewer ones",
                              answer.error);
    if (!status) hci_limit_stage_read(b, &answer, o);
    if (!status && answer.end == HCI_CONE_SOLVED) status = finish(e, b, &answer, o, note);
    hci_cone_answer_release(&answer);
    return status;
}

static hci_status solve_built(const hci_limit_build *b, const ending *e, hci_limit_optimum *o, hci_note *note)
{
    double *g = by_columns(b->row, b->rows, b->width), *equal = by_columns(b->equal, b->equalities, b->width);
    hci_status status = g && equal ? HCI_OK : hci_note_memory(note, NULL, "solving within limits");
    if (!status) {
        const hci_cone_problem problem = problem_of(b, g, equal);
        status = solve(b, &problem, e, o, note);
    }
    hci_memory_free(g);
    hci_memory_free(equal);
    return status;
}

hci_status hci_limit_stage_solve(const hci_limit_program *program, hci_limit_stage stage,
                                 hci_limit_finish *finish_by, hci_limit_rest *last,
                                 hci_limit_optimum *optimum, hci_note *note)
{
    const ending e = {finish_by, last};
    hci_limit_build b;
    hci_status status = HCI_OK;
    bool has_memory = hci_limit_build_begin(program, stage, &b);
    memset(optimum, 0, sizeof *optimum);
    optimum->x = hci_memory_new(b.coordinates, sizeof *optimum->x);
    if (has_memory) hci_limit_stage_fill(&b);
    if (!has_memory || b.is_full || !optimum->x)
        status = hci_note_memory(note, NULL, "solving within limits");
    if (!status) status = finish(&e, &b, NULL, optimum, note);
    if (!status && !optimum->is_settled) status = solve_built(&b, &e, optimum, note);
    hci_limit_build_release(&b);
    return status;
}
