/* The terms in which a machine may differ from the one that was fitted, and what is expected of them. */
#ifndef HCI_SRC_HOST_DIAGNOSE_UNCERTAINTY_ALLOWED_TERMS_H
#define HCI_SRC_HOST_DIAGNOSE_UNCERTAINTY_ALLOWED_TERMS_H

#include <stdbool.h>

#include "host/diagnose/candidates/candidates.h"
#include "host/diagnose/reading/regression.h"

/* Start with {0}. */
typedef struct {
    hci_candidates candidates; /* all are in, at the values of the fitted machine; without expectations */
    size_t count;              /* terms: columns of the normal equations */
    double *unit;              /* [count]: deviation to be expected where the width is 1; of one of which
                                * nothing is expected its standard error */
    double largest_current_A;  /* of the runs in use */
    double *fixed; /* [count]: one over the variance that is expected whatever the width; NAN: by the width */
    double *centre;  /* [count]: expected value less the value of the fitted machine */
    double *twin;    /* [count]: deviation that what was found at its order makes likely; 0: none */
    double *iron;    /* [count]: deviation as iron is that carries the largest current along q; 0: none */
    double *known;   /* [count]: of one that was found, what is likely of it; 0: any */
    bool *of_mean;   /* [count]: whether it is one of the mean torque: order 0, and of the back-EMF order 1 */
    bool *by_direct; /* [count]: whether it makes no torque without a direct current i_d */
    int *power;      /* [count]: of the currents in the co-energy */
} hci_allowed_terms;

/* fitted: those that are in are the model. On failure *terms is empty. HCI_ERROR_MEMORY. O(terms²). */
hci_status hci_allowed_terms_make(const hci_regression *regression, const hci_candidates *fitted,
                                  hci_allowed_terms *terms, hci_note *note);
void hci_allowed_terms_release(hci_allowed_terms *terms);

/* How far terms are expected from their centre: in units of the noise, and terms of the mean torque so many
 * times that, since slots make the orders and saturation of the iron as a whole the mean. */
typedef struct {
    double orders, mean_times;
    double twins;  /* and no less than so many times `twin` and `iron`, in units of the errors' size, */
    double beyond; /* times this where the co-energy grows as a higher power than the square */
} hci_allowed_width;

/* precision[count]: one over the variance that is expected. */
void hci_allowed_terms_precision(const hci_allowed_terms *terms, hci_allowed_width width, double *precision);

#endif
