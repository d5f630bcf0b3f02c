#include "cli/tune/tune_folded.h"

#include <math.h>

#include "hci/math/harmonic.h"

enum { MOST_MULTIPLES = 3 }; /* of the order of slots and poles: those above are small */

#define ALIKE 0.5 /* correlation of two orders over the samples, from which on one shows as the other */

/* |Σ exp(j n θ)| over the samples of all recordings, by their number: 1 where a whole turn of n lies between
 * any two of them. */
static double coherence(const cli_tuning *t, double mechanical_order)
{
    double cosine = 0.0, sine = 0.0, count = 0.0;
    for (size_t k = 0; k < t->runs.count; ++k) {
        const hci_run *r = &t->runs.run[k];
        for (size_t j = 0; j < r->count && r->theta_m_rad && r->torque_source != HCI_TORQUE_NONE; ++j) {
            cosine += cos(mechanical_order * r->theta_m_rad[j]);
            sine += sin(mechanical_order * r->theta_m_rad[j]);
            count += 1.0;
        }
    }
    return count > 0.0 ? hypot(cosine, sine) / count : 0.0;
}

double cli_tune_folded_from(const cli_tuning *t, double order)
{
    const double slots = cli_tune_order_of_slots(t), p = t->declared.model.pole_pairs;
    if (!(slots > 0.0) || !(t->highest_order > 0.0)) return 0.0;
    if (fabs(remainder(order, slots)) < HCI_ORDER_TOLERANCE) return 0.0;
    for (int k = 1; k <= MOST_MULTIPLES; ++k) {
        const double high = k * slots;
        if (high <= t->highest_order) continue;
        if (coherence(t, (high - order) * p) > ALIKE || coherence(t, (high + order) * p) > ALIKE) return high;
    }
    return 0.0;
}
