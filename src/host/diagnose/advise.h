/* The smallest further measurement that would tell two explanations apart.
 *
 * In: two models that describe the recordings equally well. Out: of steady runs within reach, the first for
 * which the one model, fitted again, contradicts the prediction of the other by more than 20 in χ². */
#ifndef HCI_SRC_HOST_DIAGNOSE_ADVISE_H
#define HCI_SRC_HOST_DIAGNOSE_ADVISE_H

#include "host/diagnose/candidates/candidates.h"
#include "host/diagnose/fit/regression.h"

/* Two models of the same recordings, and what they are called. */
typedef struct {
    const hci_candidates *right, *wrong;
    const char *right_name, *wrong_name;
} hci_advice_request;

/* Looks through steady runs of one mechanical turn over currents, current angles, speeds and directions
 * within the range of the recordings, and four times the speed where they have one only. For each, χ² by
 * which the explanation `right` would contradict `wrong` after `wrong` has been fitted again, with what the
 * recordings tell of its parameters. text[size]: out, in words: the run with the least current and speed that
 * is decisive, or the best one. HCI_ERROR_MEMORY. O(points·samples·parameters²). */
hci_status hci_advise(const hci_regression *regression, const hci_advice_request *request, char *text,
                      size_t size, hci_note *note);

#endif
