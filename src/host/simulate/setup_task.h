/* Setting a simulation up, part by part: each part reads machine and scenario and fills its own of the
 * set-up. All answer HCI_OK, or an error with a note: HCI_ERROR_INPUT, _MEMORY. */
#ifndef HCI_SRC_HOST_SIMULATE_SETUP_TASK_H
#define HCI_SRC_HOST_SIMULATE_SETUP_TASK_H

#include "host/simulate/simulation.h"

typedef struct {
    const hci_machine_data *machine;
    const hci_effects *effects;    /* or NULL */
    const hci_simulate_loop *loop; /* or NULL */
    const hci_scenario *scenario;
    hci_setup *setup; /* is filled */
    hci_note *note;
} hci_setup_task;

/* ---- setup_task.c ---- */

/* The fallback where the value is NAN. */
double hci_value_or(double value, double fallback);

/* HCI_ERROR_INPUT of the scenario as a whole. */
hci_status hci_setup_wrong(const hci_setup_task *task, const char *format, ...) HCI_PRINTF(2, 3);

/* HCI_ERROR_INPUT where a value of machine.csv is NAN that is needed; why: "a rotor that turns freely needs".
 */
hci_status hci_setup_need(const hci_setup_task *task, double value, const char *name, const char *unit,
                          const char *why);

/* A sample time or a delay as a whole number of steps, which must be known. */
hci_status hci_setup_count_steps(const hci_setup_task *task, const char *name, double value_s, unsigned least,
                                 unsigned *steps);

/* ---- the parts, in this order ---- */

/* The machine over the angle, resistance and shaft. */
hci_status hci_setup_plant(const hci_setup_task *task);

/* Speed and current control with their sample times; the steps must be known. */
hci_status hci_setup_control(const hci_setup_task *task);

/* What the reference currents are: a strategy, or waves of files. */
hci_status hci_setup_sources(const hci_setup_task *task);

/* Errors, noise and delays of the sensors; those that have none stay ideal. */
hci_status hci_setup_sensors(const hci_setup_task *task);

/* Memory for the delays, when the effects have added theirs. */
hci_status hci_setup_delay_lines(const hci_setup_task *task);

#endif
