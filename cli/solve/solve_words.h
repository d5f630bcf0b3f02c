/* The report of `solve` on the terminal. Uses the folder terminal. */
#ifndef HCI_CLI_SOLVE_WORDS_H
#define HCI_CLI_SOLVE_WORDS_H

#include "hci/host/solve/solve.h"

/* The verdict, the currents and the torque spectrum, on standard output. machine, target: their paths. */
void cli_show_solution(const hci_solution *solution, const char *machine, const char *target);

#endif
