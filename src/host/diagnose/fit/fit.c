#include "host/diagnose/fit/fit.h"

#include <math.h>
#include <string.h>

#include "hci/math/dense.h"
#include "host/base/memory.h"
#include "host/diagnose/fit/linearise.h"

#define CONVERGED   0.02  /* fall of χ² that a step promises, when it is the last */
#define REGULAR     1e-10 /* added to a diagonal of 1, so that rounding makes no pivot negative */
#define WHERE_STUCK 1e-6  /* damping to begin with where the matrix is singular */
#define WHERE_WORSE 1e-3  /* and where χ² rose */
#define HOPELESS    20.0  /* times what a step promises, that the score is above what it has to be below */
#define HARDER      10.0  /* factors of the damping */
#define EASIER      0.1

enum { MOST_STEPS = 25, STEPS_IN_HASTE = 2 };

double hci_candidate_cost(const hci_candidate *candidate, double rows)
{
    return candidate->price + (double)candidate->count * log(fmax(2.0, rows));
}

double hci_fit_effective_score(const hci_fit *fit, const hci_candidates *candidates)
{
    double score = fit->square;
    for (size_t k = 0; k < candidates->count; ++k) {
        const hci_candidate *s = &candidates->candidate[k];
        if (s->in) score += s->price;
        for (size_t j = 0; s->in && j < s->count; ++j) {
            const double share = s->deviation > 0.0 ? s->term[j].std_error / s->deviation : 0.0;
            score += fmax(0.0, 1.0 - share * share) * log(fmax(2.0, fit->rows));
        }
    }
    return score;
}

/* ---- values ---- */

/* A term that is in, and the smallest value that it may have. */
typedef struct {
    hci_effect_term *term;
    double least;
} unknown;

/* Those that are in, in the order of the columns. unknowns: out, may be NULL. Returns how many. */
static size_t unknowns_of(hci_candidates *candidates, unknown *unknowns)
{
    size_t count = 0;
    for (size_t k = 0; k < candidates->count; ++k) {
        hci_candidate *s = &candidates->candidate[k];
        for (size_t j = 0; s->in && j < s->count; ++j, ++count)
            if (unknowns)
                unknowns[count] = (unknown){&s->term[j], s->type->parameter[s->term[j].parameter].least};
    }
    return count;
}

static double score_of(const hci_candidates *candidates, const hci_normal_equations *normal)
{
    double score = normal->square;
    for (size_t k = 0; k < candidates->count; ++k)
        if (candidates->candidate[k].in) score += hci_candidate_cost(&candidates->candidate[k], normal->rows);
    return score;
}

/* ---- steps ---- */

typedef struct {
    const hci_regression *regression;
    hci_candidates *candidates;
    unknown *unknowns;                  /* [n] */
    hci_normal_equations normal;        /* at the present values */
    double *matrix;                     /* [n][n] */
    double *scale, *unit, *step, *from; /* [n] */
    double damping;
    double bar; /* no need to go on where the score stays above it */
} fitting;

/* G + damping·diag G in units where the diagonal is 1; a column without effect is left alone. */
static bool matrix_factor(fitting *f, double damping)
{
    const size_t n = f->normal.n;
    const double *gram = f->normal.gram;
    for (size_t k = 0; k < n; ++k)
        f->scale[k] = gram[k * n + k] > 0.0 ? 1.0 / sqrt(gram[k * n + k]) : 0.0;
    for (size_t j = 0; j < n; ++j)
        for (size_t i = 0; i < n; ++i)
            f->matrix[i + j * n] = gram[i + j * n] * f->scale[i] * f->scale[j] +
                                   (i == j ? (f->scale[i] > 0.0 ? damping + REGULAR : 1.0) : 0.0);
    return hci_cholesky_factor(n, f->matrix) == 0;
}

/* (G + damping·diag G) step = moment */
static bool step_find(fitting *f, double damping)
{
    const size_t n = f->normal.n;
    if (!matrix_factor(f, damping)) return false;
    for (size_t k = 0; k < n; ++k)
        f->step[k] = f->normal.moment[k] * f->scale[k];
    hci_cholesky_solve(n, f->matrix, f->step);
    for (size_t k = 0; k < n; ++k)
        f->step[k] *= f->scale[k];
    return true;
}

/* The diagonal of G⁻¹; not known where the matrix is singular. */
static void errors_set(fitting *f)
{
    const size_t n = f->normal.n;
    if (!matrix_factor(f, 0.0)) return;
    for (size_t k = 0; k < n; ++k) {
        memset(f->unit, 0, n * sizeof *f->unit);
        f->unit[k] = 1.0;
        hci_cholesky_solve(n, f->matrix, f->unit);
        f->unknowns[k].term->std_error = sqrt(fmax(0.0, f->unit[k] * f->scale[k] * f->scale[k]));
    }
}

/* Moves the values by a step, within what they may be. */
static void values_move(fitting *f)
{
    for (size_t k = 0; k < f->normal.n; ++k) {
        f->from[k] = f->unknowns[k].term->value;
        f->unknowns[k].term->value = fmax(f->unknowns[k].least, f->from[k] + f->step[k]);
    }
}

static void values_restore(fitting *f)
{
    for (size_t k = 0; k < f->normal.n; ++k)
        f->unknowns[k].term->value = fmax(f->unknowns[k].least, f->from[k]);
}

/* The fall of χ² if the model were linear. */
static double promise(const fitting *f)
{
    double sum = 0.0;
    for (size_t k = 0; k < f->normal.n; ++k)
        sum += f->normal.moment[k] * f->step[k];
    return sum;
}

/* Takes a step, or takes it back when χ² rises and damps the next one. */
static hci_status step_take(fitting *f, bool *last, hci_note *note)
{
    hci_normal_equations next;
    values_move(f);
    const hci_status status = hci_regression_normal(f->regression, f->candidates, false, &next, note);
    if (status) return status;
    const double fall = f->normal.square - next.square;
    if (next.square <= f->normal.square) {
        hci_normal_equations_release(&f->normal);
        f->normal = next;
        f->damping *= EASIER;
        *last = fall < CONVERGED;
        return HCI_OK;
    }
    values_restore(f);
    hci_normal_equations_release(&next);
    f->damping = fmax(WHERE_WORSE, HARDER * f->damping);
    return HCI_OK;
}

/* Whether what a step promises is little beside what the score is above the bar. */
static bool is_hopeless(const fitting *f, double promised)
{
    return score_of(f->candidates, &f->normal) - HOPELESS * promised > f->bar;
}

/* Steps until one promises next to nothing. */
static hci_status steps_take(fitting *f, hci_note *note)
{
    hci_status status = HCI_OK;
    bool last = false;
    const double *work = f->regression->work;
    const int most = work && *work > HCI_MOST_WORK + HCI_WORK_OF_JUDGING ? STEPS_IN_HASTE : MOST_STEPS;
    for (int k = 0; k < most && !last && !status; ++k) {
        if (k >= STEPS_IN_HASTE && hci_watch_stops(f->regression->watch)) break;
        if (!step_find(f, f->damping)) {
            f->damping = fmax(WHERE_STUCK, HARDER * f->damping);
            continue;
        }
        const double promised = promise(f);
        if (promised < CONVERGED || is_hopeless(f, promised)) break;
        status = step_take(f, &last, note);
    }
    return status;
}

/* ---- the fit ---- */

static hci_status fitting_make(const hci_regression *e, hci_candidates *candidates, fitting *f,
                               hci_note *note)
{
    const size_t n = unknowns_of(candidates, NULL);
    memset(f, 0, sizeof *f);
    f->regression = e;
    f->candidates = candidates;
    f->unknowns = hci_memory_new(n + 1, sizeof *f->unknowns);
    f->matrix = hci_memory_new(n * n + 4 * n + 1, sizeof *f->matrix);
    if (!f->unknowns || !f->matrix) return hci_note_memory(note, NULL, "fitting effects");
    f->scale = f->matrix + n * n;
    f->unit = f->scale + n;
    f->step = f->unit + n;
    f->from = f->step + n;
    unknowns_of(candidates, f->unknowns);
    return HCI_OK;
}

static void fitting_release(fitting *f)
{
    hci_memory_free(f->unknowns);
    hci_memory_free(f->matrix);
    hci_normal_equations_release(&f->normal);
}

hci_status hci_regression_fit_below(const hci_regression *regression, hci_candidates *candidates, double bar,
                                    hci_fit *fit, hci_note *note)
{
    fitting f;
    hci_status status = fitting_make(regression, candidates, &f, note);
    f.bar = bar;
    if (!status) status = hci_regression_normal(regression, candidates, false, &f.normal, note);
    if (!status) status = steps_take(&f, note);
    if (!status) {
        errors_set(&f);
        *fit = (hci_fit){f.normal.square, f.normal.n, score_of(candidates, &f.normal), f.normal.rows};
    }
    fitting_release(&f);
    return status;
}

hci_status hci_regression_fit(const hci_regression *regression, hci_candidates *candidates, hci_fit *fit,
                              hci_note *note)
{
    return hci_regression_fit_below(regression, candidates, INFINITY, fit, note);
}
