/* Which effects the recordings show: one at a time while the evidence is decisive. */
#ifndef HCI_SRC_HOST_ATTRIBUTE_H
#define HCI_SRC_HOST_ATTRIBUTE_H

#include "evidence.h"
#include "hci/host/solve.h"

/* What came of one effect. */
typedef struct {
    const hci_effect_room *room;
    bool in;                         /* in the model */
    bool ambiguous;                  /* in, but others fit as well; or one of those others */
    const hci_effect_room *rival_of; /* the one that it could stand for */
    double gain;                     /* fall of the score by having it: positive speaks for it */
    double explained_Nm;             /* rms of what the model loses without it */
    hci_suspects alternative;        /* of a rival: the model with it instead */
} hci_verdict;

enum { HCI_MOST_ROOMS = 16 };

/* Start with {0}. */
typedef struct {
    hci_suspects suspects; /* the model: those that are in, with values and standard errors */
    hci_fit fit, before;   /* with the noise that was found in the end */
    double excess; /* variance of the residual that is left over that of the noise under its lines, less 1 */
    double
        clumps; /* how much the size of the errors varies along a run, over what noise does; 1: like noise */
    bool unknown;          /* something is left that no effect explains, and it is not small */
    double unexplained_Nm; /* its rms */
    hci_verdict verdict[HCI_MOST_ROOMS];
    size_t rooms;
} hci_attribution;

typedef struct {
    const hci_run *runs;
    double resolution_Nm;       /* what the model is not asked to be better than */
    double reference_current_A; /* of saturation; NAN: the largest of the runs */
    hci_progress *progress;
    void *context;
} hci_attribute_options;

/* evidence->noise: in/out. HCI_ERROR_MEMORY. */
hci_status hci_attribute(hci_evidence *evidence, const hci_attribute_options *options,
                         hci_attribution *attribution, hci_note *note);
void hci_attribution_release(hci_attribution *attribution);

/* Noise of each stretch in use from the residual of a model with so many parameters. */
hci_status hci_attribute_noise(hci_evidence *evidence, const double *residual_Nm, size_t parameters,
                               double floor_Nm, hci_note *note);

#endif
