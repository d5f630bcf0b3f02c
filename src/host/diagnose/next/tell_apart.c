#include "host/diagnose/next/tell_apart.h"

#include <math.h>
#include <string.h>

#include "hci/math/dense.h"
#include "host/base/memory.h"
#include "host/diagnose/fit/linearise.h"
#include "host/diagnose/fit/model.h"
#include "host/diagnose/next/trial_run.h"
#include "host/numeric/normal_equations.h"

#define REGULAR 1e-9 /* share of a diagonal that is added to it, so that rounding makes no pivot negative */

typedef struct {
    const hci_playable *playable;
    const hci_candidates *wrong;
    hci_model right;
    hci_normal_equations known; /* the recordings' normal equations in the parameters of `wrong` */
    hci_trial_run trial;
    double *work; /* [n² + n] */
} comparison;

/* What is left of |right − wrong|² over so many turns after a fit of wrong to it with what the recordings
 * tell of its parameters. */
static double remaining(const hci_normal_equations *turn, double turns, const hci_normal_equations *known,
                        double *work)
{
    const size_t n = known->n;
    double *step = work + n * n, fall = 0.0;
    for (size_t j = 0; j < n; ++j)
        for (size_t i = 0; i < n; ++i)
            work[i + j * n] = known->gram[i + j * n] + turns * turn->gram[i + j * n] +
                              (i == j ? REGULAR * known->gram[i + j * n] + 1e-300 : 0.0);
    if (hci_cholesky_factor(n, work)) return 0.0;
    for (size_t k = 0; k < n; ++k)
        step[k] = turns * turn->moment[k];
    hci_cholesky_solve(n, work, step);
    for (size_t k = 0; k < n; ++k)
        fall += step[k] * turns * turn->moment[k];
    return fmax(0.0, turns * turn->square - fall);
}

static hci_status point_score(comparison *c, const hci_operating_point *at, double *chi_square, double *turns,
                              hci_note *note)
{
    static const double LENGTH[] = {HCI_LEAST_TURNS, 20.0, HCI_MOST_TURNS};
    hci_normal_equations turn;
    hci_status status = hci_trial_run_play(&c->trial, c->playable, at, &c->right.list, note);
    if (!status) status = hci_regression_normal(&c->trial.regression, c->wrong, false, &turn, note);
    if (status) return status;
    *chi_square = 0.0;
    for (int k = 0; k < 3 && *chi_square < HCI_TELLS; ++k) {
        *turns = LENGTH[k];
        *chi_square = remaining(&turn, *turns, &c->known, c->work);
    }
    hci_normal_equations_release(&turn);
    return HCI_OK;
}

static hci_status comparison_make(const hci_regression *e, const hci_playable *playable,
                                  const hci_explanations *x, comparison *c, hci_note *note)
{
    *c = (comparison){.playable = playable, .wrong = x->wrong};
    hci_status status = hci_model_make(e->declared, x->right, false, &c->right, note);
    if (!status) status = hci_regression_normal(e, x->wrong, false, &c->known, note);
    if (!status) status = hci_trial_run_make(e, playable, &c->trial, note);
    if (status) return status;
    const size_t n = c->known.n;
    c->work = hci_memory_new(n * n + n + 1, sizeof *c->work);
    return c->work ? HCI_OK : hci_note_memory(note, NULL, "what to measure next");
}

static void comparison_release(comparison *c)
{
    hci_trial_run_release(&c->trial);
    hci_memory_free(c->work);
    hci_model_release(&c->right);
    hci_normal_equations_release(&c->known);
}

hci_status hci_tell_apart(const hci_regression *regression, const hci_playable *playable,
                          const hci_explanations *explanations, const hci_point_scores *scores,
                          hci_note *note)
{
    comparison c;
    hci_status status = comparison_make(regression, playable, explanations, &c, note);
    for (size_t k = 0; k < scores->count && !status; ++k)
        status = point_score(&c, &scores->point[k], &scores->chi_square[k], &scores->turns[k], note);
    comparison_release(&c);
    return status;
}
