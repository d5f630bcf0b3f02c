/* The limits of one solve, from what is asked for and what the machine declares. */
#ifndef HCI_SRC_HOST_LIMIT_BOUNDS_H
#define HCI_SRC_HOST_LIMIT_BOUNDS_H

#include "hci/host/solve/solve.h"

/* HUGE_VAL: no such limit. */
typedef struct {
    double current_A[3]; /* largest |current| of each phase; 0: open */
    double rms_A[3];
    double line_V;             /* largest |line voltage|, twice that of a phase or √3 times an amplitude: */
    hci_modulation modulation; /* which of them */
    double line_V_per_V;       /* of it for 1 V of dc link */
    double mean_square_A2;     /* of all phases together: copper */
    double resistance_ohm;     /* by which that is a loss; NAN where not known */
    bool current_is_declared[3]; /* by the machine: phases without one of their own */
    bool voltage_is_declared;
} hci_bounds;

/* plain_A: amplitude of the sine that a ratio of copper is of; 0: none. HCI_ERROR_ARGUMENT for limits that
 * contradict each other, HCI_ERROR_INPUT for a value that machine.csv lacks. */
hci_status hci_bounds_make(const hci_machine_data *machine, const hci_solve_options *options, double plain_A,
                           hci_bounds *bounds, hci_note *note);

/* Whether line voltage `pair` (0, 1, 2: ab, bc, ca), or with sinusoidal modulation that of a phase (a, b, c),
 * is one that the inverter makes: its phases are driven, or no two phases are. That of an open phase is what
 * its terminal shows. */
bool hci_bounds_drive_pair(const hci_bounds *bounds, int pair);

/* Whether the three phases have the same ones. */
bool hci_bounds_are_alike(const hci_bounds *bounds);

#endif
