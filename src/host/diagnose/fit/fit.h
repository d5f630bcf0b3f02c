/* The values of candidates that describe recordings best, and how well that is.
 *
 * In: the dataset and the candidates that are in, with values to start from. Out: their values where
 *
 *     χ² = Σ (measured − predicted)²/σ² + Σ (value/expected deviation)²
 *
 * is smallest, by Gauss–Newton steps damped after Levenberg and Marquardt, and standard errors from the
 * diagonal of G⁻¹, G = XᵀX. */
#ifndef HCI_SRC_HOST_DIAGNOSE_FIT_FIT_H
#define HCI_SRC_HOST_DIAGNOSE_FIT_FIT_H

#include "host/diagnose/candidates/candidates.h"
#include "host/diagnose/reading/regression.h"

typedef struct {
    double square;     /* χ² at the solution */
    size_t parameters; /* terms that are in */
    double score;      /* χ² + parameters·ln(samples) + prices: the smaller the better */
    double rows;
} hci_fit;

/* Values of the candidates that are in, by Gauss–Newton steps that are shortened where they would not do.
 * Sets their standard errors too. Where the regression has taken all the work that it may, or the user ends
 * it, two steps must do. On failure *fit is as it was. HCI_ERROR_MEMORY. O(steps·samples·parameters²). */
hci_status hci_regression_fit(const hci_regression *regression, hci_candidates *candidates, hci_fit *fit,
                              hci_note *note);

/* The score of a fit in which a term counts as a parameter only as far as the recordings and not its
 * expectation determine it: 1 − (standard error/deviation)². For many terms with expectations. */
double hci_fit_effective_score(const hci_fit *fit, const hci_candidates *candidates);

/* The price of a candidate's coming in, in units of χ²: of its parameters and of the choice. */
double hci_candidate_cost(const hci_candidate *candidate, double rows);

/* The same, but not to the end where the score will not fall below a bar. */
hci_status hci_regression_fit_below(const hci_regression *regression, hci_candidates *candidates, double bar,
                                    hci_fit *fit, hci_note *note);

#endif
