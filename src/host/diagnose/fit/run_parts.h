/* Runs one by one, or parts of them where there are few: what can be left out in turn. */
#ifndef HCI_SRC_HOST_DIAGNOSE_FIT_RUN_PARTS_H
#define HCI_SRC_HOST_DIAGNOSE_FIT_RUN_PARTS_H

#include "host/diagnose/reading/regression.h"

/* Fewer runs than this are cut into parts, and those of which one without a torque sensor is the only one of
 * its kind; and up to so many of which each is the only one of its load and direction. */
enum { HCI_LEAST_GROUPS = 3, HCI_FEW_RUNS = 5 };

/* Into how many parts each run in use is cut; 1 where there are more than `few`. Of three runs each may be
 * the only one of its current or direction, whose mean the others do not tell. */
size_t hci_run_parts(const hci_regression *regression, size_t few);

/* Whether no two runs in use turn the same way at currents that differ by less than a tenth of the largest:
 * what one shows of a load or a direction, the others do not tell. O(runs²). */
bool hci_runs_all_differ(const hci_regression *regression);

/* Calls `visit` for each of so many parts of each run in use, with a regression that has nothing but its
 * samples, until it returns a status other than HCI_OK. HCI_ERROR_MEMORY, and what `visit` returns. */
hci_status hci_run_parts_each(const hci_regression *regression, size_t parts,
                              hci_status (*visit)(void *context, const hci_regression *part, size_t run,
                                                  hci_note *note),
                              void *context, hci_note *note);

#endif
