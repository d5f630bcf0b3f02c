/* Runs one by one, or parts of them where there are few: what can be left out in turn. */
#ifndef HCI_SRC_HOST_DIAGNOSE_FIT_RUN_PARTS_H
#define HCI_SRC_HOST_DIAGNOSE_FIT_RUN_PARTS_H

#include "host/diagnose/reading/regression.h"

/* Fewer runs than this are cut into parts, and those of which one without a torque sensor is the only one of
 * its kind; and of up to so many those that are the only one of their load, direction and speed. */
enum { HCI_LEAST_GROUPS = 3, HCI_FEW_RUNS = 5 };

/* Into how many parts each run in use is cut; 1 where there are more than `few`. Of three runs each may be
 * the only one of its current or direction, whose mean the others do not tell. */
size_t hci_run_parts(const hci_regression *regression, size_t few);

/* Whether no other run in use turns the same way, about as fast, at currents that differ by less than a tenth
 * of the largest: what it shows of its load, direction or speed, the others do not tell. False where torques
 * were not measured. O(runs). */
bool hci_run_is_alone(const hci_regression *regression, size_t run);

/* Calls `visit` for each of so many parts of each run in use, or of each that is alone where only those are
 * cut, with a regression that has nothing but its samples, until it returns a status other than HCI_OK.
 * HCI_ERROR_MEMORY, and what `visit` returns. */
hci_status hci_run_parts_each(const hci_regression *regression, size_t parts, bool only_alone,
                              hci_status (*visit)(void *context, const hci_regression *part, size_t run,
                                                  hci_note *note),
                              void *context, hci_note *note);

#endif
