#include "host/diagnose/fit/linearise.h"

#include <math.h>
#include <string.h>

#include "host/base/memory.h"
#include "host/diagnose/fit/current_sums.h"
#include "host/diagnose/fit/known_columns.h"
#include "host/diagnose/fit/known_equations.h"
#include "host/diagnose/reading/predicted_reading.h"

#define SCALES   1e-4  /* torque by a value at the reference current that is not rounding */
#define ROUNDING 1e-12 /* square of a column beside the largest of its effect that is rounding */

enum { PHASES = 3 };

enum { BLOCK = 120 }; /* rows, longer than anything in the noise is correlated */

/* What goes into the normal equations, and rows on their way. */
typedef struct {
    const hci_regression *regression;
    const hci_model *model;
    hci_column_plan plan; /* what of the model is predicted, and what is known */
    hci_normal_equations *normal;
    hci_scatter *scatter; /* or NULL */
    double *x, *y;        /* rows of a segment: [samples][columns] and [samples] */
    double *constant;     /* [samples], of the same rows: what a constant torque leaves in them */
    bool all;             /* candidates that are not in, too */
    bool scales;          /* a column changes the unit of torques that stand for currents */
    double reference_current_A;
    size_t *summed, summed_count; /* columns that show in sums of the currents, ascending */
    hci_normal_equations sums;    /* of these, from rows of such sums */
    double sum_scale;             /* hci_current_sum_scale */
} filling;

/* ---- what a run can show ---- */

/* Whether accelerations are those of a speed that the drive has filtered: they have a delay of their own, and
 * do not tell that of a channel. */
static bool filters_speed(const hci_run *run)
{
    return run->torque_source == HCI_TORQUE_INERTIA && run->speed_window == 0;
}

/* Whether a holding test can show a term: of what acts with the current only a ripple under a steady load. */
static bool holding_shows(const hci_run_statistics *x, unsigned traits, double order)
{
    if (traits & HCI_PARAMETER_WITH_SPEED) return false;
    if (!(traits & HCI_PARAMETER_WITH_CURRENT)) return true;
    return (traits & HCI_PARAMETER_WITH_LOAD) && x->is_loaded && fabs(order - 1.0) > HCI_ORDER_TOLERANCE;
}

/* Whether an effect brakes a shaft that is turned slowly against a load that nobody knows. */
static bool is_of_unknown_load(const hci_run *run, const hci_effect_type *type)
{
    return run->torque_source == HCI_TORQUE_HOLDING && run->mean_is_unknown &&
           (type->coulomb_Nm || type->drag_Nm);
}

/* Whether a run can show a term of an effect at all. */
static bool can_show(const hci_run *run, const hci_run_statistics *x, const hci_candidate *s, size_t term)
{
    const unsigned traits = s->type->parameter[s->term[term].parameter].traits;
    if ((x->no_current || x->zeros_read) && (traits & HCI_PARAMETER_WITH_CURRENT)) return false;
    if (x->no_current && hci_candidate_is_gain(s->type)) return false;
    if (run->torque_source == HCI_TORQUE_MEASURED) return true;
    if (traits & HCI_PARAMETER_OF_TRANSDUCER) return false;
    if (is_of_unknown_load(run, s->type)) return false;
    if (filters_speed(run) && (s->type->needs & HCI_EFFECT_NEEDS_RATE)) return false;
    return run->torque_source != HCI_TORQUE_HOLDING || holding_shows(x, traits, s->term[term].order);
}

static void columns_clear(const filling *f, const hci_segment *s)
{
    const hci_model *m = f->model;
    const hci_run_statistics *x = &f->regression->samples->statistics[s->run];
    for (size_t c = 0; c < m->columns; ++c) {
        if (can_show(&f->regression->runs[s->run], x, m->column[c].candidate, m->column[c].term)) continue;
        for (size_t j = 0; j < s->count; ++j)
            f->x[j * m->columns + c] = 0.0;
    }
}

/* ---- rows ---- */

/* Takes out of the values v[k·stride] a share of what is along the constant c[k], over the square of that. */
static void take_constant_out(const double *c, double share, double *v, size_t rows, size_t stride)
{
    double along = 0.0;
    for (size_t k = 0; k < rows; ++k)
        along += c[k] * v[k * stride];
    for (size_t k = 0; k < rows; ++k)
        v[k * stride] -= c[k] * along * share;
}

/* A load that is not known is a constant of each segment, at its best value whatever the model; one that is
 * known within so much stays as far as the noise of the mean is no more than that. */
static void constants_free(const filling *f, const hci_segment *s, const hci_noise *noise, double unknown_Nm)
{
    double square = 0.0;
    for (size_t k = 0; k < s->count; ++k)
        f->constant[k] = f->regression->samples->sample[s->first + k].count > 0.0 ? 1.0 : 0.0;
    hci_noise_whiten(noise, f->constant, s->count, 1);
    for (size_t k = 0; k < s->count; ++k)
        square += f->constant[k] * f->constant[k];
    if (!(square > 0.0)) return;
    const double share = (1.0 - 1.0 / sqrt(1.0 + unknown_Nm * unknown_Nm * square)) / square;
    take_constant_out(f->constant, share, f->y, s->count, 1);
    for (size_t c = 0; c < f->model->columns; ++c)
        take_constant_out(f->constant, share, f->x + c, s->count, f->model->columns);
}

/* Of a sample that tells nothing. */
static void row_clear(const filling *f, size_t k)
{
    f->y[k] = 0.0;
    memset(f->x + k * f->model->columns, 0, f->model->columns * sizeof *f->x);
}

/* Rows of a segment, weighted and whitened. */
static void torque_rows(const filling *f, const hci_segment *s, const hci_predicted_reading *predicted)
{
    const hci_model *m = f->model;
    const hci_binned_sample *sample = f->regression->samples->sample + s->first;
    const hci_noise *noise = hci_regression_noise(f->regression, s);
    hci_column_plan_fill(&f->plan, f->regression, s, predicted, f->x);
    for (size_t k = 0; k < s->count; ++k) {
        f->y[k] = sample[k].torque_Nm - predicted->torque_Nm[k];
        if (!(sample[k].count > 0.0)) row_clear(f, k);
    }
    hci_noise_whiten(noise, f->y, s->count, 1);
    hci_noise_whiten(noise, f->x, s->count, m->columns);
    columns_clear(f, s);
    const double unknown_Nm = hci_regression_mean_unknown_Nm(f->regression, s);
    if (unknown_Nm > 0.0) constants_free(f, s, noise, unknown_Nm);
}

/* What the sum of the readings leaves falls by, with a value: of gains g_s the currents are f Σ i_s,read/(1 +
 * g_s) in it, with f = 1 + Σ g_s/3, which a factor that all phases have in common leaves as it is. */
static double sum_by_value(const filling *f, const hci_model_column *c, const hci_sample *truth)
{
    const hci_effect_type *type = c->candidate->type;
    const hci_effect_term *term = &c->candidate->term[c->term];
    const double sum_A = truth->i_abc[0] + truth->i_abc[1] + truth->i_abc[2];
    const double by_value = f->sum_scale * type->sum_by_value(term, truth);
    return hci_candidate_is_gain(type) ? by_value / (1.0 + term->value) - sum_A / PHASES : by_value;
}

/* The row of one sample: what the sum of the readings leaves, in units of its noise. */
static void sum_row(const filling *f, const hci_binned_sample *sample, double deviation_A, double *x,
                    double *y)
{
    const hci_sample truth =
        hci_effects_undo_currents(&f->model->list, f->regression->machine->pole_pairs, &sample->reading);
    const double weight = sqrt(sample->count) / deviation_A;
    *y = weight * hci_current_sum_of(sample, &truth, f->sum_scale);
    for (size_t k = 0; k < f->summed_count; ++k)
        x[k] = weight * sum_by_value(f, &f->model->column[f->summed[k]], &truth);
}

/* The sum of the true currents is 0 where no neutral is connected: rows that gains and offsets must explain.
 * False where there are none. */
static bool sum_rows(const filling *f, const hci_segment *s)
{
    const double deviation_A = f->regression->sum_deviation_A[s->run];
    if (!(deviation_A > 0.0)) return false;
    for (size_t k = 0; k < s->count; ++k)
        sum_row(f, &f->regression->samples->sample[s->first + k], deviation_A, f->x + k * f->summed_count,
                f->y + k);
    return true;
}

/* Where no current flowed a row for each sensor of a run, which offsets must explain. Returns how many. */
static size_t zero_rows(const filling *f, const hci_segment *s)
{
    const hci_model *m = f->model;
    const hci_current_zeros left = hci_current_zeros_left(f->regression, &m->list, s);
    for (size_t k = 0; k < left.count; ++k) {
        for (size_t c = 0; c < m->columns; ++c) {
            const hci_candidate *a = m->column[c].candidate;
            const hci_effect_term *t = &a->term[m->column[c].term];
            const bool acts = a->type->sum_by_value && t->parameter == left.phase[k];
            f->x[k * m->columns + c] = acts ? a->type->sum_by_value(t, &left.truth) / left.deviation_A : 0.0;
        }
        f->y[k] = left.truth.i_abc[left.phase[k]] / left.deviation_A;
    }
    return left.count;
}

/* column: of the normal equations, for each of so many that the rows have; NULL: all of them. */
static void scatter_add(const filling *f, const size_t *column, size_t columns, size_t rows, size_t block)
{
    const size_t n = f->normal->n;
    double *square = f->scatter->square, *sum = square + n * n;
    for (size_t from = 0; from + block / 2 < rows; from += block, ++f->scatter->blocks) {
        memset(sum, 0, n * sizeof *sum);
        for (size_t k = from; k < rows && k < from + block; ++k)
            for (size_t c = 0; c < columns; ++c)
                sum[column ? column[c] : c] += f->x[k * columns + c] * f->y[k];
        for (size_t i = 0; i < n; ++i)
            for (size_t j = 0; j < n; ++j)
                square[i * n + j] += sum[i] * sum[j];
    }
}

static size_t block_of(const hci_segment *s)
{
    return (size_t)(BLOCK / hci_segment_joined(s));
}

static void rows_add(const filling *f, const hci_segment *s)
{
    hci_normal_equations_add(f->normal, f->x, f->y, s->count);
    if (f->scatter) scatter_add(f, NULL, f->normal->n, s->count, block_of(s));
}

/* Only few columns show in sums of currents. */
static void sums_add(filling *f, const hci_segment *s)
{
    hci_normal_equations_add(&f->sums, f->x, f->y, s->count);
    if (f->scatter) scatter_add(f, f->summed, f->summed_count, s->count, block_of(s));
}

/* All of them, to the rest. They do not count as rows. */
static void sums_join(const filling *f)
{
    const size_t n = f->normal->n, few = f->summed_count;
    f->normal->square += f->sums.square;
    for (size_t i = 0; i < few; ++i) {
        f->normal->moment[f->summed[i]] += f->sums.moment[i];
        for (size_t j = 0; j <= i; ++j)
            f->normal->gram[f->summed[i] * n + f->summed[j]] += f->sums.gram[i * few + j];
    }
}

/* Bins that were joined have left out what they differed by, which is noise whatever the model. */
static void joined_add(const filling *f, const hci_segment *s)
{
    const double rows = (hci_segment_joined(s) - 1.0) * (double)s->count;
    f->normal->rows += rows;
    f->normal->square += rows;
}

/* Sums and zeros of currents inform, but the price of a parameter is that of torques: they do not count as
 * rows. */
static void segment_add(filling *f, const hci_segment *s, hci_predicted_reading *predicted)
{
    hci_predicted_reading_fill(f->regression, &f->plan.list, s, predicted);
    const double n = (double)f->model->columns;
    hci_regression_count(f->regression, predicted->asked, hci_effects_terms(&f->model->list));
    hci_regression_count_filtered(f->regression, predicted->filtered, predicted->terms);
    hci_regression_count_products(f->regression, 0.5 * n * n * (double)s->count);
    torque_rows(f, s, predicted);
    rows_add(f, s);
    joined_add(f, s);
    if (sum_rows(f, s)) sums_add(f, s);
    const double rows = f->normal->rows;
    hci_normal_equations_add(f->normal, f->x, f->y, zero_rows(f, s));
    f->normal->rows = rows;
}

/* ---- columns ---- */

/* The largest square among the columns of one effect. */
static double largest_of(const hci_model *m, const hci_normal_equations *normal, const hci_effect_type *type)
{
    double most = 0.0;
    for (size_t c = 0; c < m->columns; ++c)
        if (m->column[c].candidate->type == type) most = fmax(most, normal->gram[c * normal->n + c]);
    return most;
}

/* Columns that are nothing but rounding beside the others of their effect, such as back-EMF harmonics that
 * these currents make no torque with, are emptied. */
static void rounding_drop(const hci_model *m, hci_normal_equations *normal)
{
    const size_t n = normal->n;
    for (size_t c = 0; c < n; ++c) {
        if (normal->gram[c * n + c] > ROUNDING * largest_of(m, normal, m->column[c].candidate->type))
            continue;
        for (size_t i = 0; i < n; ++i)
            normal->gram[c * n + i] = normal->gram[i * n + c] = 0.0;
        normal->moment[c] = 0.0;
    }
}

/* Values are expected around 0 with the candidate's deviation: one more row for each term. */
static void expectations_add(const hci_model *m, hci_normal_equations *normal)
{
    for (size_t c = 0; c < m->columns; ++c) {
        const hci_candidate *s = m->column[c].candidate;
        const double value = hci_candidate_departure(s, m->column[c].term);
        const double weight = s->deviation > 0.0 ? 1.0 / (s->deviation * s->deviation) : 0.0;
        normal->gram[c * normal->n + c] += weight;
        normal->moment[c] -= weight * value;
        normal->square += weight * value * value;
    }
}

/* ---- all of it ---- */

static bool rows_reserve(filling *f)
{
    const size_t longest = hci_segment_longest(f->regression->samples), n = f->model->columns;
    const size_t most = longest > PHASES ? longest : PHASES;
    f->x = hci_memory_new(most * (n + 2), sizeof *f->x);
    f->summed = hci_memory_new(n + 1, sizeof *f->summed);
    if (!f->x || !f->summed) return false;
    f->y = f->x + most * n;
    f->constant = f->y + most;
    for (size_t c = 0; c < n; ++c)
        if (f->model->column[c].candidate->type->sum_by_value) f->summed[f->summed_count++] = c;
    return hci_normal_equations_start(&f->sums, f->summed_count);
}

static void rows_release(filling *f)
{
    hci_memory_free(f->x);
    hci_memory_free(f->summed);
    hci_normal_equations_release(&f->sums);
}

/* Whether any column changes the torque per ampere of small currents, of a torque of about 1 at the reference
 * current. */
static bool any_scales(const filling *f)
{
    double most = 0.0;
    for (size_t c = 0; c < f->model->columns; ++c)
        most = fmax(most, fabs(f->plan.constant_by_value[c]));
    return most * f->reference_current_A > SCALES;
}

/* Sums over all samples. False when memory is out. */
static bool rows_add_all(filling *f)
{
    const hci_regression *e = f->regression;
    hci_predicted_reading predicted;
    const bool made = rows_reserve(f) && hci_predicted_reading_make(e, &f->plan.list, true, &predicted);
    f->sum_scale = hci_current_sum_scale(&f->model->list);
    if (made) {
        predicted.apart = true;
        hci_column_plan_constants(&f->plan, e, &predicted);
        f->scales = predicted.current_Nm && any_scales(f);
    }
    for (const hci_segment *s = NULL; made && (s = hci_regression_next(e, s)) != NULL;)
        segment_add(f, s, &predicted);
    if (made) {
        hci_column_plan_keep(&f->plan);
        sums_join(f);
        hci_normal_equations_finish(f->normal);
        hci_predicted_reading_release(&predicted);
    }
    rows_release(f);
    return made;
}

/* Nearly all candidates of a long list are nothing yet, and will be met again. */
static bool rows_fill(filling *f)
{
    if (!hci_column_plan_make(f->regression, f->model, f->all, &f->plan)) return false;
    const bool made = rows_add_all(f);
    hci_column_plan_release(&f->plan);
    return made;
}

/* Whether a run shows a column, and all that its value does: where the unit of a torque that stands for a
 * current is a column's, the rest of that column depends on all that acts with the current. */
static bool run_tells(const filling *f, size_t run, const hci_model_column *x)
{
    const unsigned traits = x->candidate->type->parameter[x->candidate->term[x->term].parameter].traits;
    const bool mixes = f->scales && f->regression->runs[run].hardly_accelerates;
    return can_show(&f->regression->runs[run], &f->regression->samples->statistics[run], x->candidate,
                    x->term) &&
           !(mixes && (traits & HCI_PARAMETER_WITH_CURRENT));
}

/* Whether every run in use tells a column. */
static bool is_shown(const filling *f, size_t column)
{
    for (const hci_segment *s = NULL; (s = hci_regression_next(f->regression, s)) != NULL;)
        if (!run_tells(f, s->run, &f->model->column[column])) return false;
    return true;
}

static bool rows_keep(const filling *f)
{
    const size_t n = f->model->columns;
    bool *shown = hci_memory_new(n + 1, sizeof *shown);
    for (size_t c = 0; shown && c < n; ++c)
        shown[c] = is_shown(f, c);
    const bool kept =
        shown && hci_known_equations_keep(f->regression->known, f->regression, f->model, shown, f->normal);
    hci_memory_free(shown);
    return kept;
}

/* A scatter takes the rows themselves, and what is known has the means in it. */
static bool fill(filling *f)
{
    if (f->regression->free_means) return rows_fill(f);
    if (!f->scatter && hci_known_equations_find(f->regression->known, f->regression, f->model, f->normal))
        return true;
    return rows_fill(f) && rows_keep(f);
}

static hci_status normal_make(const hci_regression *e, const hci_candidates *candidates, bool all,
                              hci_normal_equations *normal, hci_scatter *scatter, hci_note *note)
{
    hci_model model;
    filling f = {.regression = e,
                 .model = &model,
                 .normal = normal,
                 .scatter = scatter,
                 .all = all,
                 .reference_current_A = candidates->reference_current_A};
    memset(normal, 0, sizeof *normal);
    if (scatter) memset(scatter, 0, sizeof *scatter);
    const hci_status status = hci_model_make(e->declared, candidates, all, &model, note);
    if (status) return status;
    const size_t n = model.columns;
    if (scatter) scatter->square = hci_memory_new(n * n + n + 1, sizeof *scatter->square);
    const bool made = (!scatter || scatter->square) && hci_normal_equations_start(normal, n) && fill(&f);
    if (made) {
        rounding_drop(&model, normal);
        expectations_add(&model, normal);
    }
    hci_model_release(&model);
    if (made) return HCI_OK;
    hci_normal_equations_release(normal);
    if (scatter) hci_memory_free(scatter->square);
    if (scatter) memset(scatter, 0, sizeof *scatter);
    return hci_note_memory(note, NULL, "comparing model and recordings");
}

hci_status hci_regression_normal(const hci_regression *regression, const hci_candidates *candidates, bool all,
                                 hci_normal_equations *normal, hci_note *note)
{
    return normal_make(regression, candidates, all, normal, NULL, note);
}

hci_status hci_regression_scatter(const hci_regression *regression, const hci_candidates *candidates,
                                  hci_normal_equations *normal, hci_scatter *scatter, hci_note *note)
{
    return normal_make(regression, candidates, false, normal, scatter, note);
}
