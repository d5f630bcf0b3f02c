#include "host/diagnose/prepare/lag_told.h"

#include <math.h>

#define ONE_SPEED 1.2 /* ratio of speeds that tell of a lag what one of them does */
#define AROUND    1.2 /* standard deviations about a mean speed: 0.15 … 0.85 of a ramp */
#define VARIES    0.1 /* of the largest current, rms about its mean in i_d and i_q */
#define FIRST     1.5 /* order from which on a back-EMF makes ripple, of three phases that are alike */

/* Orders alone, of amplitude 0, declare nothing. */
static bool declares_ripple(const hci_machine *machine)
{
    for (size_t k = 0; k < machine->back_emf_count; ++k) {
        const hci_wave *w = &machine->back_emf[k];
        if (w->order > FIRST && hypot(w->sine, w->cosine) > 0.0) return true;
    }
    for (size_t k = 0; k < machine->cogging_count; ++k)
        if (hypot(machine->cogging[k].sine, machine->cogging[k].cosine) > 0.0) return true;
    return false;
}

/* rms of i_d and i_q about their means, their noise as well; 0 of what sensors read where no current flows.
 */
static double variation_A(const hci_run_statistics *x)
{
    if (x->no_current || x->zeros_read) return 0.0;
    const double square = x->current_A * x->current_A;
    return sqrt(fmax(0.0, square - x->mean_id_A * x->mean_id_A - x->mean_iq_A * x->mean_iq_A));
}

bool hci_lag_is_told(const hci_machine *machine, const hci_run *runs, const hci_run_statistics *statistics,
                     const bool *use, size_t count)
{
    double least = INFINITY, most = -INFINITY, current_A = 0.0, varies_A = 0.0;
    for (size_t r = 0; r < count; ++r) {
        const hci_run_statistics *x = &statistics[r];
        current_A = fmax(current_A, x->current_A); /* of all: what those in use vary by may be noise */
        if (!use[r] || runs[r].torque_source != HCI_TORQUE_MEASURED || !runs[r].time_s) continue;
        least = fmin(least, x->mean_speed_rad_per_s - AROUND * x->speed_deviation);
        most = fmax(most, x->mean_speed_rad_per_s + AROUND * x->speed_deviation);
        varies_A = fmax(varies_A, variation_A(x));
    }
    if (least > most) return false;
    return least * most <= 0.0 || fmax(-least, most) > ONE_SPEED * fmin(fabs(least), fabs(most)) ||
           varies_A > VARIES * current_A || declares_ripple(machine);
}
