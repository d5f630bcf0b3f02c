/* What is asked of the search for effects, and what comes of it. */
#ifndef HCI_SRC_HOST_DIAGNOSE_SEARCH_ATTRIBUTION_H
#define HCI_SRC_HOST_DIAGNOSE_SEARCH_ATTRIBUTION_H

#include "hci/host/base/progress.h"
#include "host/diagnose/search/fitted_model.h"

/* What came of one effect. */
typedef struct {
    const hci_effect_type *type;
    bool in;                         /* in the model */
    bool ambiguous;                  /* in, but others fit as well; or one of those others */
    bool established;                /* in, and shown by the runs without a current alone */
    bool compared;                   /* with all that could stand in its place */
    const hci_effect_type *rival_of; /* the one that it could stand for */
    double gain;                     /* fall of the score by having it: positive speaks for it */
    double explained_Nm;             /* rms of what the model loses without it */
    size_t stays,
        left_out; /* with how many of the runs that were left out in turn it is found all the same */
    hci_fitted_model alternative; /* of a rival: the model with it instead; of one that is in: the same
                                   * recordings by another machine, that has less of it */
} hci_verdict;

enum { HCI_MOST_TYPES = 32 };

#define HCI_CONSTANT_OFF 0.05 /* of the torque per ampere, that voltages which agree to 2 % exclude */

/* Start with {0}. */
typedef struct {
    hci_fitted_model model;        /* with the noise that was found in the end */
    hci_fit before;                /* without any effect, with the same noise */
    hci_fitted_model no_load;      /* of the runs without a current alone; empty: they do not tell */
    bool by_angle[HCI_MOST_TYPES]; /* an angle that is read wrong makes most of what that type explains there
                                    */
    bool no_load_alone; /* model and before are of those runs, since the others are not understood */
    const char *slip;   /* what looks like a slip and no effect, in words; NULL: nothing. Static */
    bool not_searched;  /* because of it no effect was looked for */
    hci_work_end ended; /* how */
    bool unsettled; /* another effect in place of one that is in is better: the search would go on there */
    bool unknown;   /* something is left that no effect explains, and it is not small */
    const hci_effect_type *disbelieved; /* describes the recordings best, with values that nobody would
                                         * believe; NULL: none */
    double disbelieved_share;           /* of the declared torque per ampere, that it leaves */
    bool magnetic_only;                 /* direct current alone: beside iron nothing else was looked for */
    bool inertia_as_well;               /* a wrong inertia looks the same as an effect that is in */
    const char *standing_taken, *standing_instead; /* what is in and what may stand for it in the means, in
                                                    * words; NULL: told, or neither is there. Static */
    double standing_share; /* by which the torque per ampere is larger with the other one */
    bool sensors_as_well; /* current sensors that read each other's current make what sensors and phases do */
    bool means_open;  /* what was found of the means of the runs says nothing of those left out, and is out */
    bool means_alone; /* and nothing but those means is left */
    bool wanders;     /* what is left does not repeat with the turn */
    double unexplained_Nm; /* rms of what no effect explains */
    hci_verdict verdict[HCI_MOST_TYPES];
    size_t types;
    bool plausible[HCI_MOST_TYPES]
                  [HCI_MOST_TYPES]; /* without the first, the second would explain a part of it */
} hci_attribution;

typedef struct {
    const hci_run *runs;
    double resolution_Nm;       /* what the model is not asked to be better than */
    double reference_current_A; /* of a series in the currents; NAN: the largest of the runs */
    size_t slots;               /* of the machine; 0: not known */
    bool has_neutral;           /* of the machine */
    bool constant_is_known;     /* the declared torque per ampere, to HCI_CONSTANT_OFF */
    hci_progress *progress;     /* may be NULL */
    void *context;
    const char *(*slip)(void *context); /* as in hci_diagnose_options; may be NULL */
    void *slip_context;
    /* At the model of each round, and the effects that it is: any error ends the search with it; may be
     * NULL. */
    hci_status (*look)(void *context, const hci_candidates *model, const hci_effects *effects,
                       hci_note *note);
    void *look_context;
    bool only_complete;          /* a search that ends early is not judged: HCI_ERROR_STOPPED */
    const hci_candidates *start; /* what the search goes on from, in place of what the runs without a current
                                  * show; NULL, or none of them in: nothing */
} hci_attribute_options;

#endif
