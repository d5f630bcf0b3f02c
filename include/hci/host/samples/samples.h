/* Results as numbers in memory, for programs that draw them or go on computing: the rows that the files of a
 * folder would have, and the words that its pictures have. */
#ifndef HCI_HOST_SAMPLES_SAMPLES_H
#define HCI_HOST_SAMPLES_SAMPLES_H

#include "hci/host/simulate/simulate.h"
#include "hci/host/solve/solve.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Bytes of the names of the columns. */
enum { HCI_SAMPLES_COLUMNS = 512 };

/* A table of numbers. Start with {0}. */
typedef struct {
    char columns[HCI_SAMPLES_COLUMNS]; /* names with their units and a comma between them, as a header */
    size_t rows, width;                /* of value */
    double *value;                     /* [rows][width] */
} hci_samples;

/* Currents and torque of a solution over the angle, the rows of waveform.csv, and beside them what its
 * picture compares them with: torque_before_Nm and torque_wanted_Nm, and ia_plain_A of the plain sine.
 * *samples: out, to be given to hci_samples_release; empty on failure. HCI_ERROR_MEMORY. */
hci_status hci_solution_samples(const hci_machine_data *machine, const hci_solution *solution,
                                hci_samples *samples, hci_note *note);

/* Runs the scenario as hci_simulate does, and keeps the rows of trajectory.csv. An observer of the options is
 * told as well. Both results are to be released; they are empty on failure. Errors of hci_simulate. */
hci_status hci_simulate_samples(const hci_machine_data *machine, const hci_scenario *scenario,
                                const hci_simulate_options *options, hci_samples *trajectory,
                                hci_simulation *simulation, hci_note *note);

/* Frees what it holds and empties it. */
void hci_samples_release(hci_samples *samples);

/* What the picture of a solution says, in three lines: the verdict, its figures, and what they are compared
 * with. size: of text, 1536 will do. */
void hci_solution_words(const hci_solution *solution, char *text, size_t size);

#ifdef __cplusplus
}
#endif

#endif
