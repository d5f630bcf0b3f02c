/* What to record next: operating points that tell most about what these recordings leave open. */
#ifndef HCI_SRC_HOST_DIAGNOSE_NEXT_POINTS_H
#define HCI_SRC_HOST_DIAGNOSE_NEXT_POINTS_H

#include "hci/host/diagnose/diagnose.h"
#include "host/diagnose/fit/dataset.h"
#include "host/diagnose/search/attribution.h"

/* For effects that fit as well as each other, and for those that hang on one run: fills next and advice of a
 * diagnosis. Uses the noise of the search. HCI_ERROR_MEMORY. */
hci_status hci_next_points_tell_apart(const hci_regression *regression, const hci_machine_data *machine,
                                      const hci_attribution *attribution, hci_diagnosis *diagnosis,
                                      hci_note *note);

/* For what no effect explains: adds to both where the verdict is `unknown` or `partly explained`. The
 * diagnosis is whole otherwise. HCI_ERROR_MEMORY. */
hci_status hci_next_points_unknown(const hci_regression *regression, const hci_machine_data *machine,
                                   hci_diagnosis *diagnosis, hci_note *note);

/* For terms that make the same torque in all recordings as what was found: adds to both. The diagnosis is
 * whole otherwise. HCI_ERROR_MEMORY. */
hci_status hci_next_points_left_open(const hci_regression *regression, const hci_machine_data *machine,
                                     hci_diagnosis *diagnosis, hci_note *note);

#endif
