/* How much a recording to come would tell two explanations of the recordings apart.
 *
 * In: two models that describe the recordings about equally well. Out: for each operating point χ² by which
 * the one, fitted again, contradicts what the other predicts there. */
#ifndef HCI_SRC_HOST_DIAGNOSE_NEXT_TELL_APART_H
#define HCI_SRC_HOST_DIAGNOSE_NEXT_TELL_APART_H

#include "host/diagnose/candidates/candidates.h"
#include "host/diagnose/next/operating_points.h"

/* In units of χ². */
#define HCI_TELLS   20.0 /* decisive */
#define HCI_NOTHING 4.0  /* less would be chance */

/* A recording has at least ten turns, so that noise can be told from what repeats; and at most fifty. */
enum { HCI_LEAST_TURNS = 10, HCI_MOST_TURNS = 50 };

/* Two explanations; `wrong` at the values that describe the recordings best. */
typedef struct {
    const hci_candidates *right, *wrong;
} hci_explanations;

/* Operating points and what they tell. */
typedef struct {
    const hci_operating_point *point;
    size_t count;       /* entries of each */
    double *chi_square; /* out: of so many turns */
    double *turns;      /* out: 10, 20 or 50, the least with which χ² is decisive, or 50 */
} hci_point_scores;

/* HCI_ERROR_MEMORY. O(points·samples·parameters²). */
hci_status hci_tell_apart(const hci_regression *regression, const hci_playable *playable,
                          const hci_explanations *explanations, const hci_point_scores *scores,
                          hci_note *note);

#endif
