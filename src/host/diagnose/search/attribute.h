/* Which effects the recordings show: one at a time while the regression is decisive. */
#ifndef HCI_SRC_HOST_DIAGNOSE_SEARCH_ATTRIBUTE_H
#define HCI_SRC_HOST_DIAGNOSE_SEARCH_ATTRIBUTE_H

#include "hci/host/solve/solve.h"
#include "host/diagnose/fit/evidence.h"
#include "host/diagnose/fit/fit.h"

/* An fitted of the recordings: effects with values, and how well they describe them. Start with {0}. */
typedef struct {
    hci_candidates candidates; /* those that are in have values and standard errors */
    hci_fit fit;
} hci_fitted_model;

/* What came of one effect. */
typedef struct {
    const hci_effect_type *type;
    bool in;                         /* in the model */
    bool ambiguous;                  /* in, but others fit as well; or one of those others */
    const hci_effect_type *rival_of; /* the one that it could stand for */
    double gain;                     /* fall of the score by having it: positive speaks for it */
    double explained_Nm;             /* rms of what the model loses without it */
    hci_fitted_model alternative;    /* of a rival: the fitted with it instead */
} hci_verdict;

enum { HCI_MOST_TYPES = 16 };

/* Start with {0}. */
typedef struct {
    hci_fitted_model fitted; /* with the noise that was found in the end */
    hci_fit before;          /* without any effect, with the same noise */
    bool unknown;            /* something is left that no effect explains, and it is not small */
    bool wanders;            /* what is left does not repeat with the turn */
    double unexplained_Nm;   /* rms of what no effect explains */
    hci_verdict verdict[HCI_MOST_TYPES];
    size_t types;
    bool plausible[HCI_MOST_TYPES]
                  [HCI_MOST_TYPES]; /* without the first, the second would explain a part of it */
} hci_attribution;

typedef struct {
    const hci_run *runs;
    double resolution_Nm;       /* what the model is not asked to be better than */
    double reference_current_A; /* of saturation; NAN: the largest of the runs */
    hci_progress *progress;     /* may be NULL */
    void *context;
} hci_attribute_options;

/* regression->noise: in/out. On failure *attribution is empty. HCI_ERROR_MEMORY. Seconds: some hundred fits.
 */
hci_status hci_attribute(hci_regression *regression, const hci_attribute_options *options,
                         hci_attribution *attribution, hci_note *note);
void hci_attribution_release(hci_attribution *attribution);

#endif
