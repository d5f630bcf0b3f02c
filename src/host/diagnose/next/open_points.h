/* Where a recording to come would narrow what the recordings leave open about a machine that they explain.
 *
 * In: machines that the recordings allow as well. Out: the operating point at which their ripple differs by
 * much more than at those that were recorded, such as one with i_d where all had none, and the terms that it
 * would tell apart. */
#ifndef HCI_SRC_HOST_DIAGNOSE_NEXT_OPEN_POINTS_H
#define HCI_SRC_HOST_DIAGNOSE_NEXT_OPEN_POINTS_H

#include "hci/host/machine/uncertainty.h"
#include "host/diagnose/next/operating_points.h"

/* Room for the name of a term. */
enum { HCI_TERM_NAME_SIZE = 64 };

typedef struct {
    size_t point;      /* of the list */
    double spread_Nm;  /* of the ripple there, root mean square over machines and angle */
    double chi_square; /* of HCI_LEAST_TURNS turns */
    char found[HCI_TERM_NAME_SIZE], twin[HCI_TERM_NAME_SIZE]; /* what was found, and what it may be instead */
} hci_open_point;

/* Whether there is such a point. *out is filled where there is. HCI_ERROR_MEMORY. O(points·machines·terms).
 */
hci_status hci_open_points_find(const hci_machine *machine, const hci_uncertainty *uncertainty,
                                const hci_playable *playable, hci_open_point *out, bool *found,
                                hci_note *note);

#endif
