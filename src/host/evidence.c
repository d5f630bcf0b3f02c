#include "evidence.h"

#include <math.h>
#include <string.h>

#include "hci/dense.h"
#include "memory.h"
#include "unknown.h"

enum { LAPS = 4, MOST_STEPS = 25 };

#define CONVERGED 0.02 /* fall of χ² that a step promises, when it is the last */

static hci_status no_memory(hci_note *note)
{
    return hci_note_set(note, HCI_ERROR_MEMORY, "out of memory for comparing model and recordings");
}

/* ---- the model of a list of suspects ---- */

static bool same_term(const hci_effect_term *a, const hci_effect_term *b)
{
    return a->parameter == b->parameter && fabs(a->order - b->order) < HCI_ORDER_TOLERANCE;
}

static const hci_effect *declared_of(const hci_effects *declared, const hci_effect_room *room)
{
    for (size_t k = 0; k < declared->count; ++k)
        if (declared->effect[k].room == room) return &declared->effect[k];
    return NULL;
}

/* Adds a term unless the effect has it; then its value is replaced. Returns its place. */
static size_t term_put(hci_model *m, size_t first, size_t *count, const hci_effect_term *term)
{
    size_t at = first;
    while (at < *count && !same_term(&m->term[at], term))
        ++at;
    m->term[at] = *term;
    if (at == *count) ++*count;
    return at;
}

static size_t room_terms(hci_model *m, const hci_effect_room *room, const hci_effects *declared,
                         const hci_suspects *suspects, bool all, size_t first)
{
    const hci_effect *before = declared_of(declared, room);
    size_t count = first;
    bool any = false;
    for (size_t k = 0; before && k < before->count; ++k)
        m->term[count++] = before->term[k];
    for (size_t k = 0, column = 0; k < suspects->count; ++k) {
        const hci_suspect *s = &suspects->suspect[k];
        if (!all && !s->in) continue;
        for (size_t j = 0; j < s->count; ++j, ++column) {
            if (s->room != room) continue;
            any = true;
            /* the pairs of one order may share an index only within a room that is all suspects */
            m->column[column] = before ? term_put(m, first, &count, &s->term[j]) : count;
            if (!before) m->term[count++] = s->term[j];
        }
    }
    if (any && strcmp(room->name, "saturation") == 0) {
        size_t k = 0;
        while (strcmp(room->parameter[k].name, "reference_current") != 0)
            ++k;
        const hci_effect_term reference = {k, 0.0, suspects->reference_current_A, NAN};
        if (!before) m->term[count++] = reference;
    }
    return count - first;
}

hci_status hci_model_make(const hci_effects *declared, const hci_suspects *suspects, bool all,
                          hci_model *model, hci_note *note)
{
    const hci_effect_room *room;
    size_t rooms = 0, used = 0;
    memset(model, 0, sizeof *model);
    while (hci_suspect_room(rooms))
        ++rooms;
    for (size_t k = 0; k < suspects->count; ++k)
        if (all || suspects->suspect[k].in) model->columns += suspects->suspect[k].count;
    model->effect = hci_memory_new(rooms, sizeof *model->effect);
    model->term = hci_memory_new(model->columns + hci_effects_terms(declared) + 1, sizeof *model->term);
    model->column = hci_memory_new(model->columns + 1, sizeof *model->column);
    if (!model->effect || !model->term || !model->column) {
        hci_model_release(model);
        return no_memory(note);
    }
    for (size_t r = 0; (room = hci_suspect_room(r)) != NULL; ++r) {
        const size_t count = room_terms(model, room, declared, suspects, all, used);
        if (count == 0) continue;
        model->effect[model->list.count++] = (hci_effect){room, model->term + used, count};
        used += count;
    }
    model->list.effect = model->effect;
    return HCI_OK;
}

void hci_model_release(hci_model *model)
{
    hci_memory_free(model->effect);
    hci_memory_free(model->term);
    hci_memory_free(model->column);
    memset(model, 0, sizeof *model);
}

/* ---- a stretch ---- */

/* A lag or a resonance; a time constant of 0 is none. */
static bool has_dynamics(const hci_effects *effects)
{
    for (size_t k = 0; k < effects->count; ++k) {
        const hci_effect *e = &effects->effect[k];
        for (size_t j = 0; e->room->filter && j < e->count; ++j)
            if (strcmp(e->room->parameter[e->term[j].parameter].name, "offset") != 0 &&
                e->term[j].value > 0.0)
                return true;
    }
    return false;
}

/* Place of a time constant of 0 among all terms, or their number. */
static size_t dormant_lag(const hci_effects *effects)
{
    size_t place = 0;
    for (size_t k = 0; k < effects->count; ++k)
        for (size_t j = 0; j < effects->effect[k].count; ++j, ++place) {
            const hci_effect_term *t = &effects->effect[k].term[j];
            const char *name = effects->effect[k].room->parameter[t->parameter].name;
            if (effects->effect[k].room->filter && strcmp(name, "time_constant") == 0 && !(t->value > 0.0))
                return place;
        }
    return place;
}

/* A lag of no duration answers with −dT/dt to a longer one. */
static void lag_derivative(const double *torque, const double *time_s, size_t n, double *column,
                           size_t stride)
{
    for (size_t k = 0; k < n; ++k) {
        const size_t a = k > 0 ? k - 1 : k, b = k + 1 < n ? k + 1 : k;
        const double step_s = time_s[b] - time_s[a];
        column[k * stride] = step_s > 0.0 ? -(torque[b] - torque[a]) / step_s : 0.0;
    }
}

static bool has_sensor(const hci_evidence *e, const hci_stretch *s)
{
    return s->timed && e->runs[s->run].torque_source == HCI_TORQUE_MEASURED;
}

/* Torque of the cells of one stretch, and its derivatives [cells][terms], by_value may be NULL. The mean of a
 * steady turn is run through a few times so that a slow sensor settles. */
typedef struct {
    double *torque, *by_value, *time_s;
    size_t terms;
} stretch_room;

static void stretch_observe(const hci_evidence *e, const hci_effects *effects, const hci_stretch *s,
                            stretch_room *room)
{
    const hci_cell *cell = e->cells->cell + s->first;
    const bool dynamic = has_sensor(e, s) && has_dynamics(effects);
    const size_t laps = dynamic && s->turns > 0 ? LAPS : 1, n = s->count, terms = room->terms;
    for (size_t k = 0; k < n; ++k) {
        room->torque[k] = hci_effects_predict(e->machine, effects, e->raw ? &cell[k].raw : &cell[k].reading,
                                              room->by_value ? room->by_value + k * terms : NULL);
        room->time_s[k] = cell[k].time_s;
    }
    const size_t lag = dormant_lag(effects);
    if (room->by_value && has_sensor(e, s) && lag < terms)
        lag_derivative(room->torque, room->time_s, n, room->by_value + lag, terms);
    if (!dynamic) return;
    for (size_t lap = 1; lap < laps; ++lap) {
        memcpy(room->torque + lap * n, room->torque, n * sizeof *room->torque);
        if (room->by_value)
            memcpy(room->by_value + lap * n * terms, room->by_value, n * terms * sizeof *room->by_value);
        for (size_t k = 0; k < n; ++k)
            room->time_s[lap * n + k] = room->time_s[k] + (double)lap * s->period_s;
    }
    hci_effects_filter(effects, room->time_s, laps * n, room->torque, room->by_value);
    if (laps == 1) return;
    memmove(room->torque, room->torque + (laps - 1) * n, n * sizeof *room->torque);
    if (room->by_value)
        memmove(room->by_value, room->by_value + (laps - 1) * n * terms, n * terms * sizeof *room->by_value);
}

static bool stretch_room_make(const hci_evidence *e, const hci_effects *effects, bool derivatives,
                              stretch_room *room)
{
    size_t most = 1;
    const bool dynamic = has_dynamics(effects);
    memset(room, 0, sizeof *room);
    room->terms = hci_effects_terms(effects);
    for (size_t k = 0; k < e->cells->stretch_count; ++k) {
        const hci_stretch *s = &e->cells->stretch[k];
        const size_t n = s->count * (dynamic && s->turns > 0 ? LAPS : 1);
        most = n > most ? n : most;
    }
    room->torque = hci_memory_new(2 * most, sizeof *room->torque);
    room->time_s = room->torque + most;
    if (derivatives) room->by_value = hci_memory_new(most * (room->terms + 1), sizeof *room->by_value);
    return room->torque && (room->by_value || !derivatives);
}

static void stretch_room_release(stretch_room *room)
{
    hci_memory_free(room->torque);
    hci_memory_free(room->by_value);
}

hci_status hci_evidence_residual(const hci_evidence *e, const hci_effects *effects, double *residual_Nm,
                                 hci_note *note)
{
    stretch_room room;
    const bool made = stretch_room_make(e, effects, false, &room);
    memset(residual_Nm, 0, e->cells->count * sizeof *residual_Nm);
    for (size_t k = 0; made && k < e->cells->stretch_count; ++k) {
        const hci_stretch *s = &e->cells->stretch[k];
        if (!e->use[s->run]) continue;
        stretch_observe(e, effects, s, &room);
        for (size_t j = 0; j < s->count; ++j)
            residual_Nm[s->first + j] = e->cells->cell[s->first + j].torque_Nm - room.torque[j];
    }
    stretch_room_release(&room);
    return made ? HCI_OK : no_memory(note);
}

/* ---- normal equations ---- */

static bool is_of(const hci_suspect *s, const char *name)
{
    return strcmp(s->room->name, name) == 0;
}

/* In a holding test the current answers to the torque: no effect that grows with it can be found there. At
 * rest friction has a sign and no more. */
static bool needs_free_current(const hci_suspect *s, size_t term)
{
    static const char *const ROOMS[] = {"back_emf",      "phase_imbalance",      "reluctance",
                                        "channel_delay", "saturation",           "magnet_temperature",
                                        "current_gain",  "position_eccentricity"};
    for (size_t k = 0; k < sizeof ROOMS / sizeof *ROOMS; ++k)
        if (is_of(s, ROOMS[k])) return true;
    if (is_of(s, "friction")) return s->term[term].parameter > 0;
    return (is_of(s, "mechanical_order") && s->term[term].parameter >= 2) || s->room == &hci_unknown_room;
}

/* Whether a run can show a term of an effect at all. */
static bool can_show(const hci_run *run, const hci_suspect *s, size_t term)
{
    if (run->torque_source == HCI_TORQUE_MEASURED) return true;
    if (is_of(s, "torque_sensor")) return false;
    return run->torque_source != HCI_TORQUE_HOLDING || !needs_free_current(s, term);
}

static void columns_clear(const hci_run *run, const hci_suspects *suspects, bool all, double *x, size_t rows,
                          size_t columns)
{
    for (size_t k = 0, c = 0; k < suspects->count; ++k) {
        const hci_suspect *s = &suspects->suspect[k];
        if (!all && !s->in) continue;
        for (size_t t = 0; t < s->count; ++t, ++c)
            for (size_t j = 0; !can_show(run, s, t) && j < rows; ++j)
                x[j * columns + c] = 0.0;
    }
}

/* Rows of a stretch: columns in the order of the suspects, weighted and whitened. x: [cells][columns]. */
static void rows_make(const hci_evidence *e, const hci_model *m, const hci_stretch *s,
                      const stretch_room *room, size_t stretch, double *x, double *y)
{
    const size_t n = s->count;
    for (size_t k = 0; k < n; ++k) {
        const double *from = room->by_value + k * room->terms;
        double *to = x + k * m->columns;
        y[k] = e->cells->cell[s->first + k].torque_Nm - room->torque[k];
        for (size_t c = 0; c < m->columns; ++c)
            to[c] = from[m->column[c]];
    }
    hci_noise_whiten(&e->noise[stretch], y, n, 1);
    hci_noise_whiten(&e->noise[stretch], x, n, m->columns);
}

enum { BLOCK = 120 }; /* rows, longer than anything in the noise is correlated */

/* Adds rows to the normal equations and, where wanted, what the sums of x·y over blocks scatter: meat[n²]. */
static void rows_add(hci_normal *normal, double *meat, size_t *blocks, const double *x, const double *y,
                     size_t rows)
{
    const size_t n = normal->n;
    hci_normal_add(normal, x, y, rows);
    for (size_t from = 0; meat && from + BLOCK / 2 < rows; from += BLOCK, ++*blocks) {
        double *sum = meat + n * n;
        memset(sum, 0, n * sizeof *sum);
        for (size_t k = from; k < rows && k < from + BLOCK; ++k)
            for (size_t c = 0; c < n; ++c)
                sum[c] += x[k * n + c] * y[k];
        for (size_t i = 0; i < n; ++i)
            for (size_t j = 0; j < n; ++j)
                meat[i * n + j] += sum[i] * sum[j];
    }
}

/* The sum of the true currents is 0 where no neutral is connected: rows that gains and offsets must explain.
 */
static void sum_rows_add(const hci_evidence *e, const hci_model *m, const hci_suspects *suspects, bool all,
                         const hci_stretch *s, hci_normal *normal, double *meat, size_t *blocks, double *x,
                         double *y)
{
    const size_t n = s->count;
    const double deviation = e->sum_deviation_A[s->run];
    if (!(deviation > 0.0)) return;
    memset(x, 0, n * m->columns * sizeof *x);
    for (size_t k = 0; k < n; ++k) {
        const hci_cell *cell = &e->cells->cell[s->first + k];
        const hci_sample truth = hci_effects_undo(&m->list, e->machine->pole_pairs, &cell->reading);
        const double weight = sqrt(cell->count) / deviation;
        y[k] = cell->sum_A;
        for (int phase = 0; phase < 3; ++phase)
            y[k] -= cell->reading.i_abc[phase] - truth.i_abc[phase];
        y[k] *= weight;
        for (size_t j = 0, column = 0; j < suspects->count; ++j) {
            const hci_suspect *u = &suspects->suspect[j];
            if (!all && !u->in) continue;
            const size_t phase = u->term[0].parameter;
            if (is_of(u, "current_offset")) x[k * m->columns + column] = weight;
            if (is_of(u, "current_gain")) x[k * m->columns + column] = weight * truth.i_abc[phase];
            column += u->count;
        }
    }
    rows_add(normal, meat, blocks, x, y, n);
}

static size_t longest(const hci_cells *cells)
{
    size_t most = 1;
    for (size_t k = 0; k < cells->stretch_count; ++k)
        most = cells->stretch[k].count > most ? cells->stretch[k].count : most;
    return most;
}

/* Values are expected around 0 with the suspect's deviation: one more row for each term. */
static void expectations_add(const hci_suspects *suspects, bool all, hci_normal *normal)
{
    for (size_t k = 0, c = 0; k < suspects->count; ++k) {
        const hci_suspect *s = &suspects->suspect[k];
        for (size_t j = 0; (all || s->in) && j < s->count; ++j, ++c) {
            const double weight = s->deviation > 0.0 ? 1.0 / (s->deviation * s->deviation) : 0.0;
            normal->gram[c * normal->n + c] += weight;
            normal->moment[c] -= weight * s->term[j].value;
            normal->square += weight * s->term[j].value * s->term[j].value;
        }
    }
}

/* Columns that are nothing but rounding beside the others of their effect, such as back-EMF harmonics that
 * these currents make no torque with, are emptied. */
static void rounding_drop(const hci_suspects *suspects, bool all, hci_normal *normal)
{
    const size_t n = normal->n;
    for (size_t k = 0, c = 0; k < suspects->count; ++k) {
        const hci_suspect *s = &suspects->suspect[k];
        if (!all && !s->in) continue;
        for (size_t j = 0; j < s->count; ++j, ++c) {
            double most = 0.0;
            for (size_t i = 0, d = 0; i < suspects->count; ++i) {
                const hci_suspect *t = &suspects->suspect[i];
                if (!all && !t->in) continue;
                if (t->room == s->room) most = fmax(most, normal->gram[d * n + d]);
                d += t->count;
            }
            if (normal->gram[c * n + c] > 1e-12 * most) continue;
            for (size_t i = 0; i < n; ++i)
                normal->gram[c * n + i] = normal->gram[i * n + c] = 0.0;
            normal->moment[c] = 0.0;
        }
    }
}

static bool normal_fill(const hci_evidence *e, const hci_model *m, const hci_suspects *suspects, bool all,
                        hci_normal *normal, double *meat, size_t *blocks)
{
    const size_t most = longest(e->cells);
    double *x = hci_memory_new(most * (m->columns + 1), sizeof *x), *y = x + most * m->columns;
    stretch_room room;
    const bool made = stretch_room_make(e, &m->list, true, &room) && x;
    for (size_t k = 0; made && k < e->cells->stretch_count; ++k) {
        const hci_stretch *s = &e->cells->stretch[k];
        if (!e->use[s->run]) continue;
        stretch_observe(e, &m->list, s, &room);
        rows_make(e, m, s, &room, k, x, y);
        columns_clear(&e->runs[s->run], suspects, all, x, s->count, m->columns);
        rows_add(normal, meat, blocks, x, y, s->count);
        const double rows = normal->rows;
        sum_rows_add(e, m, suspects, all, s, normal, meat, blocks, x, y);
        normal->rows = rows;
    }
    if (made) hci_normal_finish(normal);
    if (made) rounding_drop(suspects, all, normal);
    if (made) expectations_add(suspects, all, normal);
    stretch_room_release(&room);
    hci_memory_free(x);
    return made;
}

hci_status hci_evidence_normal(const hci_evidence *evidence, const hci_suspects *suspects, bool all,
                               hci_normal *normal, hci_note *note)
{
    hci_model model;
    hci_status status = hci_model_make(evidence->declared, suspects, all, &model, note);
    memset(normal, 0, sizeof *normal);
    if (status) return status;
    if (!hci_normal_start(normal, model.columns) ||
        !normal_fill(evidence, &model, suspects, all, normal, NULL, NULL))
        status = no_memory(note);
    hci_model_release(&model);
    if (status) hci_normal_release(normal);
    return status;
}

/* ---- the fit ---- */

double hci_suspect_cost(const hci_suspect *suspect, double rows)
{
    return suspect->price + (double)suspect->count * log(fmax(2.0, rows));
}

/* (G + damping·diag G) step = moment, in units where the diagonal is 1. inverse: out, may be NULL, the
 * diagonal of G⁻¹. work: n² + 2n. */
static bool step_find(const hci_normal *normal, double damping, double *step, double *inverse, double *work)
{
    const size_t n = normal->n;
    double *scale = work + n * n, *unit = scale + n;
    for (size_t k = 0; k < n; ++k)
        scale[k] = normal->gram[k * n + k] > 0.0 ? 1.0 / sqrt(normal->gram[k * n + k]) : 0.0;
    for (size_t j = 0; j < n; ++j)
        for (size_t i = 0; i < n; ++i)
            work[i + j * n] = normal->gram[i + j * n] * scale[i] * scale[j] +
                              (i == j ? (scale[i] > 0.0 ? damping + 1e-10 : 1.0) : 0.0);
    if (hci_cholesky_factor(n, work)) return false;
    for (size_t k = 0; k < n; ++k)
        step[k] = normal->moment[k] * scale[k];
    hci_cholesky_solve(n, work, step);
    for (size_t k = 0; k < n; ++k)
        step[k] *= scale[k];
    for (size_t k = 0; inverse && k < n; ++k) {
        memset(unit, 0, n * sizeof *unit);
        unit[k] = 1.0;
        hci_cholesky_solve(n, work, unit);
        inverse[k] = unit[k] * scale[k] * scale[k];
    }
    return true;
}

/* Moves the values by a step, within what they may be. */
static void values_move(hci_suspects *suspects, const double *from, const double *step)
{
    for (size_t k = 0, c = 0; k < suspects->count; ++k) {
        hci_suspect *s = &suspects->suspect[k];
        if (!s->in) continue;
        for (size_t j = 0; j < s->count; ++j, ++c) {
            const double least = s->room->parameter[s->term[j].parameter].least;
            s->term[j].value = fmax(least, from[c] + step[c]);
        }
    }
}

static void values_get(const hci_suspects *suspects, double *values)
{
    for (size_t k = 0, c = 0; k < suspects->count; ++k)
        for (size_t j = 0; suspects->suspect[k].in && j < suspects->suspect[k].count; ++j)
            values[c++] = suspects->suspect[k].term[j].value;
}

static void errors_set(hci_suspects *suspects, const double *variance)
{
    for (size_t k = 0, c = 0; k < suspects->count; ++k)
        for (size_t j = 0; suspects->suspect[k].in && j < suspects->suspect[k].count; ++j)
            suspects->suspect[k].term[j].std_error = sqrt(fmax(0.0, variance[c++]));
}

static double promise(const hci_normal *normal, const double *step)
{
    double sum = 0.0;
    for (size_t k = 0; k < normal->n; ++k)
        sum += normal->moment[k] * step[k];
    return sum;
}

/* Steps until one promises next to nothing. work: n² + 6n. */
static hci_status steps_take(const hci_evidence *e, hci_suspects *suspects, hci_normal *normal, double *work,
                             hci_note *note)
{
    const size_t n = normal->n;
    double *step = work + n * n + 2 * n, *from = step + n, *inverse = from + n, damping = 0.0;
    for (int k = 0; k < MOST_STEPS; ++k) {
        hci_normal next;
        hci_status status;
        if (!step_find(normal, damping, step, NULL, work)) {
            damping = fmax(1e-6, 10.0 * damping);
            continue;
        }
        if (promise(normal, step) < CONVERGED) break;
        values_get(suspects, from);
        values_move(suspects, from, step);
        status = hci_evidence_normal(e, suspects, false, &next, note);
        if (status) return status;
        if (next.square <= normal->square) {
            const double fall = normal->square - next.square;
            hci_normal_release(normal);
            *normal = next;
            damping *= 0.1;
            if (fall < CONVERGED) break;
        } else {
            memset(step, 0, n * sizeof *step);
            values_move(suspects, from, step);
            hci_normal_release(&next);
            damping = fmax(1e-3, 10.0 * damping);
        }
    }
    if (step_find(normal, 0.0, step, inverse, work)) errors_set(suspects, inverse);
    return HCI_OK;
}

hci_status hci_evidence_fit(const hci_evidence *evidence, hci_suspects *suspects, hci_fit *fit,
                            hci_note *note)
{
    hci_normal normal;
    hci_status status = hci_evidence_normal(evidence, suspects, false, &normal, note);
    double *work;
    if (status) return status;
    work = hci_memory_new(normal.n * normal.n + 6 * normal.n + 1, sizeof *work);
    status = work ? steps_take(evidence, suspects, &normal, work, note) : no_memory(note);
    if (!status) {
        *fit = (hci_fit){normal.square, normal.n, normal.square, normal.rows};
        for (size_t k = 0; k < suspects->count; ++k)
            if (suspects->suspect[k].in) fit->score += hci_suspect_cost(&suspects->suspect[k], normal.rows);
    }
    hci_normal_release(&normal);
    hci_memory_free(work);
    return status;
}

/* ---- standard errors ---- */

/* Diagonal of G⁻¹ M G⁻¹: what the scatter of x·y over blocks does to the values. work: n² + 2n. */
static bool sandwich(const hci_normal *normal, const double *meat, double *variance, double *work)
{
    const size_t n = normal->n;
    double *unit = work + n * n;
    for (size_t j = 0; j < n; ++j)
        for (size_t i = 0; i < n; ++i)
            work[i + j * n] = normal->gram[i + j * n] * (i == j ? 1.0 + 1e-10 : 1.0);
    if (hci_cholesky_factor(n, work)) return false;
    for (size_t k = 0; k < n; ++k) {
        variance[k] = 0.0;
        memset(unit, 0, n * sizeof *unit);
        unit[k] = 1.0;
        hci_cholesky_solve(n, work, unit);
        for (size_t i = 0; i < n; ++i)
            for (size_t j = 0; j < n; ++j)
                variance[k] += unit[i] * meat[i * n + j] * unit[j];
    }
    return true;
}

/* The larger of the two, of the model of the noise and of the scatter. */
static void errors_raise(hci_suspects *suspects, const double *variance)
{
    for (size_t k = 0, c = 0; k < suspects->count; ++k)
        for (size_t j = 0; suspects->suspect[k].in && j < suspects->suspect[k].count; ++j, ++c)
            suspects->suspect[k].term[j].std_error =
                fmax(suspects->suspect[k].term[j].std_error, sqrt(fmax(0.0, variance[c])));
}

hci_status hci_evidence_errors(const hci_evidence *evidence, hci_suspects *suspects, hci_note *note)
{
    hci_model model;
    hci_normal normal = {0};
    size_t blocks = 0;
    hci_status status = hci_model_make(evidence->declared, suspects, false, &model, note);
    if (status) return status;
    const size_t n = model.columns;
    double *meat = hci_memory_new(2 * n * n + 4 * n + 1, sizeof *meat), *work = meat + n * n + n;
    if (!meat || !hci_normal_start(&normal, n) ||
        !normal_fill(evidence, &model, suspects, false, &normal, meat, &blocks))
        status = no_memory(note);
    if (!status && blocks > 5 * n && n > 0 && sandwich(&normal, meat, work + n * n + 2 * n, work))
        errors_raise(suspects, work + n * n + 2 * n);
    hci_normal_release(&normal);
    hci_memory_free(meat);
    hci_model_release(&model);
    return status;
}

/* ---- resonance ---- */

enum { GRID = 48 };

/* Torque without and with the resonance, a few laps of a steady turn. */
typedef struct {
    double *torque, *time_s, *y;
} resonance_room;

static double stretch_square(const hci_evidence *e, const hci_effects *sensor, size_t stretch,
                             const double *residual_Nm, resonance_room *r)
{
    const hci_stretch *s = &e->cells->stretch[stretch];
    const hci_cell *cell = e->cells->cell + s->first;
    const size_t n = s->count, laps = s->turns > 0 ? LAPS : 1;
    double sum = 0.0;
    for (size_t lap = 0; lap < laps; ++lap)
        for (size_t k = 0; k < n; ++k) {
            r->torque[lap * n + k] = cell[k].torque_Nm - residual_Nm[s->first + k];
            r->time_s[lap * n + k] = cell[k].time_s + (double)lap * s->period_s;
        }
    if (sensor) hci_effects_filter(sensor, r->time_s, laps * n, r->torque, NULL);
    for (size_t k = 0; k < n; ++k)
        r->y[k] = cell[k].torque_Nm - r->torque[(laps - 1) * n + k];
    hci_noise_whiten(&e->noise[stretch], r->y, n, 1);
    for (size_t k = 0; k < n; ++k)
        sum += r->y[k] * r->y[k];
    return sum;
}

static double sensor_square(const hci_evidence *e, const hci_effects *sensor, const double *residual_Nm,
                            resonance_room *r)
{
    double sum = 0.0;
    for (size_t k = 0; k < e->cells->stretch_count; ++k)
        if (e->use[e->cells->stretch[k].run] && has_sensor(e, &e->cells->stretch[k]))
            sum += stretch_square(e, sensor, k, residual_Nm, r);
    return sum;
}

/* From the slowest turn to a third of the sampling rate. */
static void frequency_range(const hci_evidence *e, double *low_Hz, double *high_Hz)
{
    *low_Hz = INFINITY;
    *high_Hz = 0.0;
    for (size_t k = 0; k < e->cells->stretch_count; ++k) {
        const hci_stretch *s = &e->cells->stretch[k];
        const hci_cell *cell = e->cells->cell + s->first;
        const double length_s = s->turns > 0 ? s->period_s : cell[s->count - 1].time_s - cell[0].time_s;
        if (!e->use[s->run] || !has_sensor(e, s) || !(length_s > 0.0)) continue;
        const double speed = fabs(cell[s->count / 2].reading.speed_rad_per_s);
        *high_Hz = fmax(*high_Hz, 0.33 * (double)s->count / length_s);
        if (speed > 0.0) *low_Hz = fmin(*low_Hz, speed / (2.0 * HCI_PI));
    }
}

static void grid_search(const hci_evidence *e, const double *residual_Nm, resonance_room *r,
                        double *natural_frequency_Hz, double *damping, double *gain)
{
    static const double DAMPING[] = {0.03, 0.1, 0.3};
    const hci_effect_room *room = hci_effect_room_find("torque_sensor");
    double low_Hz, high_Hz;
    frequency_range(e, &low_Hz, &high_Hz);
    const double before = sensor_square(e, NULL, residual_Nm, r);
    for (int k = 0; k < GRID && low_Hz < high_Hz; ++k) {
        for (size_t j = 0; j < sizeof DAMPING / sizeof *DAMPING; ++j) {
            const double frequency = low_Hz * pow(high_Hz / low_Hz, (double)k / (GRID - 1));
            const hci_effect_term term[] = {
                {1, 0.0, frequency,  NAN},
                {2, 0.0, DAMPING[j], NAN}
            };
            const hci_effect effect = {room, term, 2};
            const hci_effects sensor = {&effect, 1};
            const double fall = before - sensor_square(e, &sensor, residual_Nm, r);
            if (!(fall > *gain)) continue;
            *gain = fall;
            *natural_frequency_Hz = frequency;
            *damping = DAMPING[j];
        }
    }
}

hci_status hci_evidence_resonance(const hci_evidence *evidence, const double *residual_Nm,
                                  double *natural_frequency_Hz, double *damping, double *gain, hci_note *note)
{
    const size_t most = longest(evidence->cells);
    double *work = hci_memory_new((2 * LAPS + 1) * most, sizeof *work);
    resonance_room room = {work, work + LAPS * most, work + 2 * LAPS * most};
    *natural_frequency_Hz = *damping = *gain = 0.0;
    if (!work) return no_memory(note);
    grid_search(evidence, residual_Nm, &room, natural_frequency_Hz, damping, gain);
    hci_memory_free(work);
    return HCI_OK;
}
