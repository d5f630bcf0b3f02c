/* Laws of what brakes, of which nobody would believe that it drives.
 *
 * In: a model with friction or drag. Out: whether its law drives the shaft at the speeds that were recorded,
 * or brakes less the faster it turns. Recordings of another sign are described by a friction below 0, and a
 * friction that falls at low speeds by a power of the speed below 0, which says nothing of other speeds. */
#ifndef HCI_SRC_HOST_DIAGNOSE_SEARCH_BRAKES_H
#define HCI_SRC_HOST_DIAGNOSE_SEARCH_BRAKES_H

#include "host/diagnose/candidates/candidates.h"
#include "host/diagnose/reading/regression.h"

/* The type in the model whose law is no brake's, declared values included; NULL: none. HCI_ERROR_MEMORY. */
hci_status hci_brakes_find_driving(const hci_regression *regression, const hci_candidates *candidates,
                                   const hci_effect_type **type, hci_note *note);

/* Whether that is this type. HCI_ERROR_MEMORY. */
hci_status hci_brakes_drive(const hci_regression *regression, const hci_candidates *candidates,
                            const hci_effect_type *type, bool *drives, hci_note *note);

/* Whether the recordings turn both ways at one pace, and one way alone at another: what brakes there is not
 * told from a zero of the sensor, nor how it grows with the speed. */
bool hci_brakes_hang_on_one_way(const hci_regression *regression);

/* Whether the last term of a candidate is a further power of the speed in the law of a brake, which may go
 * alone. */
bool hci_brakes_has_further_power(const hci_candidate *candidate);

/* Whether another law of what brakes stands beside that of a type. */
bool hci_brakes_have_other(const hci_candidates *candidates, const hci_effect_type *type);

#endif
