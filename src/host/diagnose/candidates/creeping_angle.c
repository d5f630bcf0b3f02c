#include "host/diagnose/candidates/creeping_angle.h"

#include <math.h>

#include "host/diagnose/prepare/swing_groups.h"

#define MOST_SHARE 0.03 /* of a turn, in a turn: beyond it the angle is of another kind */
#define ERRORS     5.0  /* standard errors by which a frequency is beside the order */
#define AS_LARGE   2.0  /* times, or so much less, than the declared amplitude: smoothed, or with its sides */

enum { LEAST_RUNS = 2 };

static bool is_of_order(const hci_swing_group *g, const hci_harmonic *declared, int pole_pairs)
{
    const double periods = declared->order * pole_pairs;
    const double off = fabs(g->frequency - periods);
    const double amplitude_Nm = hypot(declared->sine, declared->cosine);
    return off < MOST_SHARE * periods && off > ERRORS * g->error &&
           g->amplitude_Nm < AS_LARGE * amplitude_Nm && g->amplitude_Nm * AS_LARGE > amplitude_Nm;
}

const char *hci_creeping_angle(const hci_machine *machine, const hci_run_statistics *statistics, size_t runs)
{
    const hci_swing_groups found = hci_swing_groups_find(statistics, runs);
    for (size_t k = 0; k < found.count; ++k) {
        const hci_swing_group *g = &found.group[k];
        for (size_t n = 0; n < machine->cogging_count && g->of_turn && g->runs >= LEAST_RUNS; ++n)
            if (is_of_order(g, &machine->cogging[n], machine->pole_pairs))
                return "the angle creeps against the motor (an encoder that loses counts, a coupling or a "
                       "belt "
                       "that slips, counts per turn that are not those of the encoder): the declared cogging "
                       "torque is there, and comes no whole number of times in a turn of the angle";
    }
    return NULL;
}
