/* What `sweep` reads: values in lists, the grid, the machine, and which of them results depend on. */
#ifndef HCI_CLI_SWEEP_INPUTS_H
#define HCI_CLI_SWEEP_INPUTS_H

#include "cli/command/option.h"
#include "cli/command/shard.h"
#include "hci/host/machine/effects.h"
#include "hci/host/sweep/progress_file.h"

/* Places of the options. */
typedef enum {
    SWEEP_TRADE_OFF,
    SWEEP_ENVELOPE,
    SWEEP_MAP,
    SWEEP_TORQUE,
    SWEEP_TORQUES,
    SWEEP_SPEED,
    SWEEP_SPEEDS,
    SWEEP_LINKS,
    SWEEP_RIPPLE,
    SWEEP_CURRENTS,
    SWEEP_COPPERS,
    SWEEP_HARMONICS,
    SWEEP_AUTO,
    SWEEP_MINIMISE,
    SWEEP_TEMPERATURE,
    SWEEP_JOBS,
    SWEEP_SHARD,
    SWEEP_JOIN,
    SWEEP_ORDER_BASE,
    SWEEP_OUT,
    SWEEP_REPORT,
    SWEEP_LIMITS /* those of cli/solve/solve_limits.h begin here */
} cli_sweep_key;

/* Values of one list. */
typedef struct {
    double *value;
    size_t count, room;
} cli_list;

/* Everything that is read, in one place so that it is released in one place. Start with {0}. */
typedef struct {
    hci_machine_data machine;
    hci_effects_data effects;
    hci_component_set set;
    hci_solve_options options;
    cli_list torque_Nm, speed_rad_per_s, link_V, current_A, copper;
    hci_grid_point *point; /* of the grid in a file, or NULL */
    hci_grid_request request;
    hci_grid_inputs inputs;
    cli_shard shard;
} cli_sweep_inputs;

/* Reads it all. *inputs is to be released even after a failure, and not to be moved. table: the options of
 * the command. HCI_ERROR_ARGUMENT, _INPUT, _MEMORY. */
hci_status cli_sweep_read(const cli_option *table, const cli_arguments *arguments, cli_sweep_inputs *inputs,
                          hci_note *note);
void cli_sweep_inputs_release(cli_sweep_inputs *inputs);

#endif
