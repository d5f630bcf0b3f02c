/* The three stages of a simulation: set up, run, evaluated. */
#ifndef HCI_SRC_HOST_SIMULATE_SIMULATION_H
#define HCI_SRC_HOST_SIMULATE_SIMULATION_H

#include <stdbool.h>

#include "hci/host/simulate/simulate.h"

/* ---- setup.c: the scenario with all its defaults, on the machine ---- */

/* Points into itself: not to be copied. */
typedef struct {
    hci_drive drive;
    hci_drive_state state;           /* at the start, and then */
    double *rows;                    /* of the table */
    hci_plant_inductance inductance; /* what the table was made of */
    hci_inductance *terms;           /* integrated from slopes, or NULL */
    hci_currents fixed, per_Nm;
    hci_current_source source[2];
    hci_sensor sensor[HCI_SENSE_COUNT];
    double *ring[HCI_SENSE_COUNT];
    hci_effects_attachment *attachment; /* NULL without effects */
    uint64_t seed;
    double set_point, load_Nm, load_2_Nm, load_2_from_s;
    double settle_s;
    size_t steps, every; /* steps to a row of the trajectory */
    size_t period_turns, highest_order;
    const hci_machine *machine; /* as declared */
    double temperature_C;       /* of the magnets, NAN where it is not given */
    bool has_inductance;        /* else the table holds a placeholder, which ideal currents do not need
                                 */
    bool prescribed;            /* speed */
    bool has_command;           /* a torque is asked for */
    hci_note remark;
} hci_setup;

hci_status hci_setup_make(const hci_machine_data *machine, const hci_simulate_options *options,
                          const hci_scenario *scenario, hci_setup *setup, hci_note *note);
void hci_setup_release(hci_setup *setup);

/* ---- integrals.c, figures.c: statistics, spectrum and energies of the steady part ---- */

typedef struct hci_evaluation hci_evaluation;

hci_evaluation *hci_evaluation_new(const hci_setup *setup); /* NULL when memory is out */
void hci_evaluation_free(hci_evaluation *evaluation);
void hci_evaluation_add(hci_evaluation *evaluation, const hci_simulation_step *step);

/* HCI_ERROR_MEMORY. */
hci_status hci_evaluation_finish(hci_evaluation *evaluation, hci_simulation *simulation, hci_note *note);

#endif
