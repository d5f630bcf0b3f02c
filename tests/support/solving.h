/* A machine folder, a mean torque that is wanted of it, and the solution. Include once in a test. */
#ifndef SOLVING_H
#define SOLVING_H

#include <string.h>

#include "hci/host/machine/machine.h"
#include "hci/host/solve/solve.h"
#include "unity.h"

static hci_machine_data machine;
static hci_target target;
static hci_target_order order[1];
static hci_solve_options options;
static hci_solution solution;

static inline void solving_start(const char *folder, double mean_Nm)
{
    hci_note note = {{0}};
    memset(&options, 0, sizeof options);
    memset(&solution, 0, sizeof solution);
    TEST_ASSERT_EQUAL_MESSAGE(HCI_OK, hci_machine_read(folder, &machine, &note), note.text);
    order[0] = (hci_target_order){{0.0, 0.0, mean_Nm}, 1.0};
    target = (hci_target){order, 1};
    options.target = &target;
}

static inline void solving_end(void)
{
    hci_solution_release(&solution);
    hci_machine_release(&machine);
}

#endif
