/* The report of `diagnose` on the terminal. Uses the folder terminal. */
#ifndef HCI_CLI_DIAGNOSE_WORDS_H
#define HCI_CLI_DIAGNOSE_WORDS_H

#include "hci/host/check/check.h"
#include "hci/host/diagnose/diagnose.h"

/* Verdict, effects that were found, what to measure next, old and new currents, and drawings, on standard
 * error. r: or NULL; machine, runs: their paths. */
void cli_show_diagnosis(const hci_diagnosis *d, const hci_resolution *r, const char *machine,
                        const char *runs);

/* A slip of convention that `check` finds in what is not explained. */
void cli_show_convention(const hci_check_finding *finding);

#endif
