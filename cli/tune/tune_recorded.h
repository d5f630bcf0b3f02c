/* What recordings show by themselves, whatever a model says of it: whether a current flows, and the ripple.
 * Uses tune_steps. */
#ifndef HCI_CLI_TUNE_RECORDED_H
#define HCI_CLI_TUNE_RECORDED_H

#include "cli/tune/tune_steps.h"

/* rms of a phase, over the three. */
double cli_tune_rms_A(const hci_run *run);

/* The largest current that turns with the rotor in a recording, as noise and zeros of sensors do not: the
 * length of its mean in the rotor frame, where that is most of it; 0: none does. O(samples). */
double cli_tune_turning_A(const cli_tuning *tune);

/* Whether the rated current is a hundred times as large and more, as one in mA that was read in A. */
bool cli_tune_is_overrated(const cli_tuning *tune);

/* None, or what a sensor of current makes of none. */
bool cli_tune_has_no_current(const cli_tuning *tune, const hci_run *run);

typedef struct {
    size_t run;             /* the recording that shows most; the number of recordings: none shows any */
    double peak_to_peak_Nm; /* of its torque, or of what its i_q makes, each whole turn less its mean, in
                             * medians over narrow parts of the turn, in the direction that shows more */
    double current_A;       /* mean length of its phase currents, 0 of none */
} cli_tune_ripple;

/* Of the recordings with a torque sensor or a slow turn. O(samples). */
cli_tune_ripple cli_tune_recorded_ripple(const cli_tuning *tune);

/* Two recordings, and how often in a turn of the shaft the largest order of the ripple of each comes. */
typedef struct {
    size_t first, second;
    int first_order, second_order;
} cli_tune_two_ripples;

/* Whether the ripples of two recordings have nothing of each other's largest order, which cogging torque of
 * one motor has in both, whatever the load: they are of two motors, or of two angles. O(recordings² x orders
 * + samples). */
bool cli_tune_two_motors(const cli_tuning *tune, cli_tune_two_ripples *two);

#endif
