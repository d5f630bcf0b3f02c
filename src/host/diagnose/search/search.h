/* Where the search for effects stands, and what all its steps use: residual, noise, and what an effect
 * explains. Private to the search. */
#ifndef HCI_SRC_HOST_DIAGNOSE_SEARCH_SEARCH_H
#define HCI_SRC_HOST_DIAGNOSE_SEARCH_SEARCH_H

#include <stdint.h>

#include "host/diagnose/fit/known_residuals.h"
#include "host/diagnose/search/attribution.h"
#include "host/diagnose/search/fitted_model.h"

enum { HCI_MOST_SEEN = 32 };

#define HCI_DECISIVE 10.0 /* fall of the score by which an effect is accepted: odds of 150 to 1 */
#define HCI_AS_GOOD  0.5  /* scores that differ by less are the same */

/* The model that describes the recordings best of those that cannot be believed. type: NULL where there was
 * none. */
typedef struct {
    const hci_effect_type *type; /* that makes it unbelievable */
    double constant_share;       /* of the declared torque per ampere, that it leaves */
    hci_fitted_model model;
} hci_disbelieved;

typedef struct {
    hci_regression *regression;
    const hci_attribute_options *options;
    double *residual_Nm, *variance; /* of each sample, of the model looked at last */
    hci_known_residuals residuals;  /* to be released */
    double resolution_Nm;           /* what the model is not asked to be better than: as in the options, or
                                     * more where it is to describe slopes */
    int richness;                   /* of saturation */
    hci_disbelieved disbelieved;    /* to be released */
    uint32_t seen[HCI_MOST_SEEN];   /* which types the models of these rounds have, a bit each; none follows
                                     * from a swap again */
    size_t seen_count;
    double came_with[HCI_MOST_TYPES]; /* of each type, by how much the score fell when it came in alone */
    bool known_only;                  /* nothing unknown competes */
    bool magnetic_only;               /* nor what direct currents do not tell from the magnetic circuit */
    bool no_current;                  /* nor what needs a current */
    bool one_gain;                    /* a gain of the torque sensor competes, whatever the residual shows */
    const bool *denied;               /* nor these, of each type; NULL: none */
    bool from_no_load;                /* the search went on from what the runs without a current show */
    bool whole_coenergy;              /* all terms of the co-energy are in, each with an expectation */
    hci_fitted_model single;          /* the model with single terms, there; to be released */
    const char *doing;
    double share, until; /* of all work: done so far, and when the step at hand is done */
    double kept_work;    /* of HCI_MOST_WORK, that is left for what follows */
    bool judging;        /* what was found, however the search has ended: there is work set apart for that */
    hci_work_end ended;  /* HCI_WORK_COMPLETE until something makes it end early */
} hci_search;

/* Whether to end with the best model so far: the user wants it, or the work is as much as it may be. Once it
 * is over it stays so, but for judging. */
bool hci_search_is_over(hci_search *search);

/* Whether the user wants the end: then nothing is judged any more that takes long. */
bool hci_search_is_interrupted(hci_search *search);

/* Tells of a step that takes the work from one share of the whole to another. */
void hci_search_begin(hci_search *search, const char *doing, double from, double until);
/* Tells of a part of it: there is no knowing how many follow, so each takes a little of what is left. */
void hci_search_tell(hci_search *search);

/* The model without an effect, fitted again. On failure `without` is empty. HCI_ERROR_MEMORY. */
hci_status hci_search_without(hci_search *search, const hci_fitted_model *model, const hci_effect_type *type,
                              hci_fitted_model *without, hci_note *note);

/* ---- residual and noise ---- */

/* Sets residual_Nm. HCI_ERROR_MEMORY. */
hci_status hci_search_residual(hci_search *search, const hci_candidates *candidates, hci_note *note);
/* The same of the readings as they are, and the noise of every segment from it. */
hci_status hci_search_noise(hci_search *search, const hci_candidates *candidates, hci_note *note);
/* Finds the noise anew and fits again: scores from before are no longer comparable. */
hci_status hci_search_renew(hci_search *search, hci_fitted_model *model, hci_note *note);

/* Root mean square over the runs in use, N·m. */
double hci_search_residual_rms(const hci_search *search);
double hci_search_noise_rms(const hci_search *search);

/* The rms of the residual about its mean in each segment, forward and back by itself. O(samples). */
double hci_search_ripple_rms(const hci_search *search);

/* explained_Nm: out, rms of what the model with an effect describes and the one without does not.
 * HCI_ERROR_MEMORY. */
hci_status hci_search_explained(hci_search *search, const hci_candidates *with, const hci_candidates *without,
                                double *explained_Nm, hci_note *note);

/* The same of a type in a model, beside that model fitted without it; 0 where it is not in.
 * HCI_ERROR_MEMORY. */
hci_status hci_search_explained_by(hci_search *search, const hci_fitted_model *model,
                                   const hci_effect_type *type, double *explained_Nm, hci_note *note);

/* Whether that is large enough to matter; an effect that is in may always become more exact. */
hci_status hci_search_noticeable(hci_search *search, const hci_candidates *with,
                                 const hci_candidates *without, bool *noticeable, hci_note *note);

#endif
