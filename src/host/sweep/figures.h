/* One solve of a sweep, and its figures. */
#ifndef HCI_SRC_HOST_SWEEP_FIGURES_H
#define HCI_SRC_HOST_SWEEP_FIGURES_H

#include "hci/host/sweep/sweep.h"

/* All NAN, nothing binds. */
hci_grid_figures hci_grid_no_figures(void);

/* A row without figures. */
void hci_grid_row_begin(const hci_grid_point *point, hci_grid_row *row);

/* The options of one point, for this target. */
hci_solve_options hci_grid_options_of(const hci_grid_request *request, const hci_grid_point *point,
                                      const hci_target *target);

/* One solve: where ripple remains and the options name another one than the worst order, the solve for that.
 * figures, plain (or NULL), verdict: out; the note has the reason of HCI_GRID_FAILED. */
typedef struct {
    hci_grid_verdict verdict;
    hci_grid_figures figures, plain;
    hci_note reason;
} hci_grid_answer;

void hci_grid_solve_once(const hci_machine_data *machine, const hci_solve_options *options,
                         hci_grid_answer *answer);

/* The largest torque at a point: best, most and sine of its row. */
void hci_grid_envelope(const hci_grid_request *request, const hci_grid_point *point, hci_grid_row *row);

#endif
