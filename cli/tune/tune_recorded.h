/* The ripple that recordings show by themselves, whatever a model says of it. Uses tune_steps. */
#ifndef HCI_CLI_TUNE_RECORDED_H
#define HCI_CLI_TUNE_RECORDED_H

#include "cli/tune/tune_steps.h"

typedef struct {
    size_t run;             /* the recording that shows most; the number of recordings: none shows any */
    double peak_to_peak_Nm; /* of its torque, or of what its i_q makes, in medians over narrow parts of the
                             * turn, in the direction that shows more */
    double current_A;       /* mean length of its phase currents, 0 of none */
} cli_tune_ripple;

/* Of the recordings with a torque sensor or a slow turn. O(samples). */
cli_tune_ripple cli_tune_recorded_ripple(const cli_tuning *tune);

#endif
