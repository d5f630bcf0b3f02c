/* Residuals of the models looked at last: a search asks for the same ones again and again.
 *
 * In: a model. Out: what it leaves, to the last digit as hci_regression_residual gives it. */
#ifndef HCI_SRC_HOST_DIAGNOSE_FIT_KNOWN_RESIDUALS_H
#define HCI_SRC_HOST_DIAGNOSE_FIT_KNOWN_RESIDUALS_H

#include "host/diagnose/reading/regression.h"

enum { HCI_KNOWN_RESIDUALS = 8 };

typedef struct {
    hci_effect *effect;
    hci_effect_term *term;
    size_t effects;
    bool *use; /* of each run */
    bool raw, free_means;
    double *residual_Nm; /* [samples]; NULL: nothing is known */
    double work;         /* that it took */
    size_t asked;        /* when it was asked for last */
} hci_known_residual;

/* Of one regression, whose samples stay as they are. Start with {0}. */
typedef struct {
    hci_known_residual model[HCI_KNOWN_RESIDUALS];
    size_t asked;
} hci_known_residuals;

/* As hci_regression_residual, and counted as if it was computed. HCI_ERROR_MEMORY. */
hci_status hci_known_residuals_find(hci_known_residuals *known, const hci_regression *regression,
                                    const hci_effects *effects, double *residual_Nm, hci_note *note);
void hci_known_residuals_release(hci_known_residuals *known);

#endif
