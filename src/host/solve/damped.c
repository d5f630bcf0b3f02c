/* Levenberg's and Marquardt's method for components that cannot make the wanted torque (theory.md, section
 * 7). In: a task, a set, and currents of it; out: currents with a squared error of the torque that no step
 * lowers. Each step is that of the linear problem, shortened by (UᵀU + μ)δ = Uᵀ(h − U x); μ follows how well
 * the linear problem foretold the error (Nielsen 1999). */
#include "host/solve/damped.h"

#include <math.h>
#include <string.h>

#include "hci/math/dense.h"
#include "host/base/memory.h"
#include "host/solve/answer.h"
#include "host/solve/harmonic_system.h"
#include "host/solve/linearise.h"
#include "host/solve/torque_spectrum.h"

enum { MOST_STEPS = 100, MOST_TRIALS = 40 };

static const double FIRST_DAMPING = 1e-3, /* share of the largest element of UᵀU */
    AT_REST = 1e-6,                       /* share of the error that a step is foretold to take */
    NO_CHANGE = 1e-9;                     /* share of the current */

typedef struct {
    hci_damped *d;
    size_t n;
    hci_wave_list wave; /* of the last currents tried */
    double *square;     /* n×n: UᵀU */
    double *factor;     /* n×n: of UᵀU + μ */
    double *slope;      /* Uᵀ(h − U x) */
    double *step, *trial;
    double damping, growth;
} descent;

hci_status hci_set_waves(const hci_component_set *set, const double *x, const hci_wave *held,
                         hci_wave_list *waves, hci_note *note)
{
    hci_wave *wave = hci_memory_new(set->count + 1, sizeof *wave);
    if (!wave) return hci_note_memory(note, NULL, "Newton's method");
    hci_memory_free(waves->wave);
    waves->wave = wave;
    waves->count = 0;
    if (held) wave[waves->count++] = *held;
    for (size_t k = 0; k < set->count; ++k)
        wave[waves->count++] =
            (hci_wave){set->component[k].order, set->component[k].sequence, x[2 * k], x[2 * k + 1]};
    return HCI_OK;
}

/* Error of the true torque at coordinates x. */
static hci_status error_at(descent *e, const double *x, hci_torque_error *error, hci_note *note)
{
    const hci_task *t = e->d->task;
    hci_status status = hci_set_waves(e->d->set, x, t->held, &e->wave, note);
    *error = (hci_torque_error){HUGE_VAL, HUGE_VAL};
    return status ? status : hci_torque_error_evaluate(t, e->wave.wave, e->wave.count, error, note);
}

/* ---- the linear problem at x ---- */

static double dot_column(const hci_sparse *u, size_t j, const double *row)
{
    double sum = 0.0;
    for (int64_t k = u->column_start[j]; k < u->column_start[j + 1]; ++k)
        sum += u->value[k] * row[u->row[k]];
    return sum;
}

/* row += share × column j. */
static void add_column(const hci_sparse *u, size_t j, double share, double *row)
{
    for (int64_t k = u->column_start[j]; k < u->column_start[j + 1]; ++k)
        row[u->row[k]] += share * u->value[k];
}

/* UᵀU and Uᵀ(h − U x). row: rows of the system, zeros. */
static void fill_squares(const hci_harmonic_system *s, double mean_Nm, double *row, descent *e)
{
    for (size_t j = 0; j < e->n; ++j) {
        add_column(&s->u, j, 1.0, row);
        for (size_t k = 0; k <= j; ++k)
            e->square[j * e->n + k] = e->square[k * e->n + j] = dot_column(&s->u, k, row);
        memset(row, 0, s->rows * sizeof *row);
    }
    for (size_t k = 0; k < s->rows; ++k)
        row[k] = hci_coordinate(s->h, s->rows, mean_Nm, k);
    for (size_t j = 0; j < e->n; ++j)
        add_column(&s->u, j, -e->d->x[j], row);
    for (size_t j = 0; j < e->n; ++j)
        e->slope[j] = dot_column(&s->u, j, row);
}

static hci_status linearise(descent *e, hci_note *note)
{
    hci_task *t = e->d->task;
    hci_harmonic_system s;
    hci_status status = hci_set_waves(e->d->set, e->d->x, t->held, &e->wave, note);
    if (!status) status = hci_task_linearise(t, e->wave.wave, e->wave.count, e->d->at, note);
    if (!status)
        status =
            hci_harmonic_system_make(t, e->d->set->component, e->d->set->count, HCI_COMPARE_ALL, &s, note);
    if (status) return status;
    double *row = hci_memory_new(s.rows, sizeof *row);
    if (row)
        fill_squares(&s, hci_target_mean_Nm(t->target), row, e);
    else
        status = hci_note_memory(note, NULL, "Newton's method");
    hci_memory_free(row);
    hci_harmonic_system_release(&s);
    ++e->d->steps;
    return status;
}

/* ---- a step ---- */

/* The damped step; false where more damping is needed to find one. */
static bool find_step(descent *e)
{
    memcpy(e->factor, e->square, e->n * e->n * sizeof *e->factor);
    for (size_t j = 0; j < e->n; ++j)
        e->factor[j * e->n + j] += e->damping;
    memcpy(e->step, e->slope, e->n * sizeof *e->step);
    if (hci_cholesky_factor(e->n, e->factor)) return false;
    hci_cholesky_solve(e->n, e->factor, e->step);
    return true;
}

/* How much of the squared error the linear problem says that the step takes. */
static double foretold_Nm2(const descent *e)
{
    double sum = 0.0;
    for (size_t j = 0; j < e->n; ++j)
        sum += e->step[j] * (e->slope[j] + e->damping * e->step[j]);
    return sum;
}

static double change_of(const descent *e)
{
    double change = 0.0, size = 0.0;
    for (size_t j = 0; j < e->n; ++j) {
        change += e->step[j] * e->step[j];
        size += e->d->x[j] * e->d->x[j];
    }
    return size > 0.0 ? sqrt(change / size) : 1.0;
}

/* Goes the step where it lowers the error; more damping where it does not. */
static hci_status try_step(descent *e, bool *is_lower, hci_note *note)
{
    hci_torque_error now;
    const double foretold = foretold_Nm2(e);
    for (size_t j = 0; j < e->n; ++j)
        e->trial[j] = e->d->x[j] + e->step[j];
    const hci_status status = error_at(e, e->trial, &now, note);
    *is_lower = !status && now.square_sum < e->d->square_Nm2;
    if (!*is_lower) return status;
    const double came_true = (e->d->square_Nm2 - now.square_sum) / foretold;
    e->damping *= fmax(1.0 / 3.0, 1.0 - pow(2.0 * came_true - 1.0, 3.0));
    e->growth = 2.0;
    memcpy(e->d->x, e->trial, e->n * sizeof *e->trial);
    e->d->square_Nm2 = now.square_sum;
    e->d->is_at_rest = now.worst_Nm <= e->d->enough_Nm;
    return HCI_OK;
}

/* One step downwards from where the torque was made linear, or rest. */
static hci_status go_down(descent *e, hci_note *note)
{
    hci_status status = HCI_OK;
    bool is_lower = false;
    for (int trial = 0; trial < MOST_TRIALS && !status && !is_lower; ++trial) {
        if (find_step(e)) {
            e->d->change = change_of(e);
            e->d->is_at_rest = foretold_Nm2(e) <= AT_REST * e->d->square_Nm2 || e->d->change <= NO_CHANGE;
            if (e->d->is_at_rest) return HCI_OK;
            status = try_step(e, &is_lower, note);
        }
        if (is_lower) break;
        e->damping *= e->growth;
        e->growth *= 2.0;
    }
    e->d->is_at_rest = e->d->is_at_rest || (!status && !is_lower);
    return status;
}

/* ---- all of it ---- */

static hci_status reserve(descent *e, hci_note *note)
{
    const size_t n = e->n;
    e->square = hci_memory_new(2 * n * n + 3 * n, sizeof *e->square);
    if (!e->square) return hci_note_memory(note, NULL, "Newton's method");
    e->factor = e->square + n * n;
    e->slope = e->factor + n * n;
    e->step = e->slope + n;
    e->trial = e->step + n;
    return HCI_OK;
}

static hci_status descend(descent *e, hci_note *note)
{
    hci_torque_error first;
    hci_status status = error_at(e, e->d->x, &first, note);
    double largest = 0.0;
    if (!status) status = linearise(e, note);
    for (size_t j = 0; j < e->n && !status; ++j)
        largest = fmax(largest, e->square[j * e->n + j]);
    e->d->square_Nm2 = first.square_sum;
    e->damping = FIRST_DAMPING * largest;
    e->growth = 2.0;
    while (!status && largest > 0.0) {
        status = go_down(e, note);
        if (status || e->d->is_at_rest) break;
        status = linearise(e, note);
        if (e->d->steps >= MOST_STEPS) break;
    }
    return status;
}

hci_status hci_damped_descend(hci_damped *d, hci_note *note)
{
    descent e = {.d = d, .n = 2 * d->set->count};
    hci_status status = reserve(&e, note);
    d->steps = 0;
    d->change = 1.0;
    d->is_at_rest = false;
    if (!status) status = descend(&e, note);
    hci_memory_free(e.wave.wave);
    hci_memory_free(e.square);
    return status;
}
