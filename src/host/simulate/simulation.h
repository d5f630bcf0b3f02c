/* A scenario on its way through simulate*.c: set up, run, evaluated, written. */
#ifndef HCI_SRC_HOST_SIMULATE_SIMULATION_H
#define HCI_SRC_HOST_SIMULATE_SIMULATION_H

#include <stdbool.h>

#include "hci/host/base/output.h"
#include "hci/host/simulate/simulate.h"
#include "host/draw/plot_traces.h"

/* ---- simulate_setup.c: the scenario with all its defaults, on the machine ---- */

/* Points into itself: not to be copied. */
typedef struct {
    hci_drive drive;
    hci_drive_state state; /* at the start, and then */
    double *rows;          /* of the table */
    hci_inductance *terms; /* integrated from slopes, or NULL */
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
    double fundamental_Nm_per_A; /* of the back-EMF */
    double temperature_C;        /* of the magnets, NAN where it is not given */
    bool has_inductance; /* else the table holds a placeholder, which an ideal current source does not feel */
    bool prescribed;     /* speed */
    bool has_command;    /* a torque is asked for */
    hci_note remark;
} hci_setup;

hci_status hci_setup_make(const hci_machine_data *machine, const hci_effects *effects,
                          const hci_scenario *scenario, hci_setup *setup, hci_note *note);
void hci_setup_release(hci_setup *setup);

/* ---- what is known at the start of a step ---- */

/* Events since the start of the run. */
typedef struct {
    uint64_t switchings, without_current, limited;
} hci_counts;

typedef struct {
    double time_s;
    double angle_rad; /* electrical, unwrapped */
    double speed_rad_per_s;
    double i[2], v[2]; /* αβ, orthonormal; v holds until the next record */
    double torque_Nm, load_Nm;
    hci_plant_point point;
    hci_counts counts;
    const hci_drive_state *state; /* after the step, for what was measured and commanded in it */
} hci_record;

/* ---- simulate_evaluate.c: statistics, spectrum and energies of the steady part ---- */

typedef struct hci_evaluation hci_evaluation;

hci_evaluation *hci_evaluation_new(const hci_setup *setup); /* NULL when memory is out */
void hci_evaluation_free(hci_evaluation *evaluation);
void hci_evaluation_add(hci_evaluation *evaluation, const hci_record *record);

/* HCI_ERROR_MEMORY. */
hci_status hci_evaluation_finish(hci_evaluation *evaluation, hci_simulation *simulation, hci_note *note);

/* ---- simulate_write.c ---- */

/* A row waits for the next one, so that its voltages can be means over the time between. */
typedef struct {
    hci_output *out;
    const hci_setup *setup;
    double row[32];
    size_t columns, waited;
    double v_sum[2];
    hci_traces *traces; /* for the report, or NULL */
} hci_trajectory;

hci_status hci_trajectory_begin(hci_trajectory *trajectory, hci_output *out, const hci_setup *setup,
                                hci_note *note);
void hci_trajectory_add(hci_trajectory *trajectory, const hci_record *record);
void hci_trajectory_end(hci_trajectory *trajectory);

/* spectrum.csv, summary.json and, with sources, report.html. */
hci_status hci_simulation_write(hci_output *out, const hci_simulation *simulation, const hci_traces *traces,
                                const hci_report_sources *sources, hci_note *note);

#endif
