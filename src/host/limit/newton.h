/* The optimum of a stage by Newton's method, from an answer that is near it (theory.md, section 15). */
#ifndef HCI_SRC_HOST_LIMIT_NEWTON_H
#define HCI_SRC_HOST_LIMIT_NEWTON_H

#include "host/conic/problem.h"
#include "host/limit/build.h"

/* From the program of a stage and its answer, or without one (NULL) from where it came to rest last, to where
 * the conditions of Karush, Kuhn and Tucker hold with the limits at every angle: fills *optimum, sets its
 * is_settled, and *last. Where it does not come there, *optimum stays, and *last is emptied if it began
 * there. HCI_ERROR_MEMORY, without a note. */
hci_status hci_limit_newton(const hci_limit_build *build, const hci_cone_answer *answer, hci_limit_rest *last,
                            hci_limit_optimum *optimum);

void hci_limit_rest_release(hci_limit_rest *rest);

#endif
