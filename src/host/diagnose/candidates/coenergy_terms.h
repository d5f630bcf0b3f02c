/* Every term of the co-energy as candidates, in place of a choice among them: with an expectation of each
 * that is small where the power of the currents or the order is high, all of them can be fitted at once to a
 * few recordings. */
#ifndef HCI_SRC_HOST_DIAGNOSE_CANDIDATES_COENERGY_TERMS_H
#define HCI_SRC_HOST_DIAGNOSE_CANDIDATES_COENERGY_TERMS_H

#include "host/diagnose/candidates/candidates.h"

/* Adds them to the ones that `known` has in: all are in then, and those of the series have coenergy_unit and
 * power. On failure *all is empty. HCI_ERROR_MEMORY. */
hci_status hci_coenergy_terms(const hci_candidates *known, const hci_effect_coenergy_series *series,
                              hci_candidates *all, hci_note *note);

enum { HCI_COENERGY_ORDERS = 32 }; /* multiples of six, from 0 */

/* What was found at each order n of the co-energy beside cogging torque, n/6 its place. A cogging torque says
 * nothing of what grows with the current: all that it could be taken for would be seen beside it. */
typedef struct {
    double usual[HCI_COENERGY_ORDERS];  /* of a rotor that looks alike both ways round: the largest departure
                                         * from the declared machine, as the coefficient of power 2 and order
                                         * 0 that makes it as likely, N·m */
    double unlike[HCI_COENERGY_ORDERS]; /* and of any other */
    double usual_squares[HCI_COENERGY_ORDERS], unlike_squares[HCI_COENERGY_ORDERS]; /* of power 2 and more */
    double along_q; /* expected of the coefficient of i_d i_q² of order 0, N·m; 0 where nobody says */
    double mean;    /* expected of order 0 whatever was found, as `usual`; 0 where nobody says */
} hci_coenergy_sizes;

/* The place of a term's order; a back-EMF of order 6k ± 1 belongs to 6k. */
size_t hci_coenergy_place(double order);

void hci_coenergy_sizes_of(const hci_candidates *known, const hci_effect_coenergy_series *series,
                           hci_coenergy_sizes *sizes);

/* Adds to all, as hci_coenergy_terms does, what only a rotor has that does not look alike both ways round, at
 * the orders where such a thing was found. On failure *all is empty. HCI_ERROR_MEMORY. */
hci_status hci_coenergy_terms_unlike(const hci_coenergy_sizes *sizes,
                                     const hci_effect_coenergy_series *series, hci_candidates *all,
                                     hci_note *note);

#endif
