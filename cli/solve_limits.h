/* Limits of `solve` on its command line. */
#ifndef HCI_CLI_SOLVE_LIMITS_H
#define HCI_CLI_SOLVE_LIMITS_H

#include "hci/host/base/note.h"
#include "hci/host/solve/solve.h"

/* --limit-current: `12`, `a=0` or `12,a=0`; 0 opens a phase. HCI_ERROR_ARGUMENT. */
hci_status cli_limit_current(const char *text, hci_solve_options *options, hci_note *note);

/* --limit-rms: the same without 0. HCI_ERROR_ARGUMENT. */
hci_status cli_limit_rms(const char *text, hci_solve_limits *limits, hci_note *note);

/* --limit-copper: `30` in W, `1.2x` of the plain sine. HCI_ERROR_ARGUMENT. */
hci_status cli_limit_copper(const char *text, hci_solve_limits *limits, hci_note *note);

#endif
