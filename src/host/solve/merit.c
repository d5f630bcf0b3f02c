#include "host/solve/merit.h"

#include <math.h>

#include "host/base/memory.h"
#include "host/solve/torque_spectrum.h"

enum { ANGLES = 1024 }; /* at which a swing is looked at */

#define SAME        1e-6 /* share of the torque */
#define SAME_COPPER 1e-9 /* share of the copper */

static hci_harmonic error_of(const hci_task *t, const hci_harmonic *h)
{
    const hci_harmonic wanted = hci_target_at(t->target, h->order).torque_Nm;
    return (hci_harmonic){h->order, h->sine - wanted.sine, h->cosine - wanted.cosine};
}

static double swing(const hci_task *t, const hci_harmonic_list *torque)
{
    double high = -HUGE_VAL, low = HUGE_VAL;
    for (int k = 0; k < ANGLES; ++k) {
        const double theta_rad = 2.0 * HCI_PI * (double)t->period_turns * k / ANGLES;
        double sum_Nm = 0.0;
        for (size_t j = 0; j < torque->count; ++j) {
            const hci_harmonic error = error_of(t, &torque->harmonic[j]);
            const bool counts =
                error.order >= HCI_ORDER_TOLERANCE && hci_target_at(t->target, error.order).weight > 0.0;
            if (counts) sum_Nm += hci_harmonics_at(&error, 1, theta_rad);
        }
        high = fmax(high, sum_Nm);
        low = fmin(low, sum_Nm);
    }
    return high - low;
}

/* Mean error, and of the orders above it the worst or the root of the sum of squares. */
static void take_orders(const hci_task *t, bool is_rms, const hci_harmonic_list *torque, hci_limit_merit *m)
{
    double sum = 0.0;
    for (size_t k = 0; k < torque->count; ++k) {
        const hci_harmonic error = error_of(t, &torque->harmonic[k]);
        const double size_Nm =
            hci_target_at(t->target, error.order).weight * hci_amplitude(error.sine, error.cosine);
        if (error.order < HCI_ORDER_TOLERANCE) {
            m->mean_error_Nm = size_Nm > 0.0 ? fabs(error.cosine) : 0.0;
            continue;
        }
        sum += size_Nm * size_Nm;
        m->ripple_Nm = fmax(m->ripple_Nm, size_Nm);
    }
    if (is_rms) m->ripple_Nm = sqrt(sum);
}

hci_status hci_limit_merit_evaluate(const hci_task *task, hci_minimise minimise, const hci_wave_list *current,
                                    hci_limit_merit *merit, hci_note *note)
{
    hci_harmonic_list torque;
    const hci_status status =
        hci_torque_spectrum_evaluate(task, current->wave, current->count, &torque, note);
    *merit = (hci_limit_merit){0.0, 0.0, hci_waves_mean_square(current->wave, current->count), 0.0};
    if (!status) take_orders(task, minimise == HCI_MINIMISE_RMS, &torque, merit);
    if (!status && minimise == HCI_MINIMISE_PEAK_TO_PEAK) merit->ripple_Nm = swing(task, &torque);
    hci_memory_free(torque.harmonic);
    return status;
}

bool hci_limit_merit_less(const hci_limit_merit *a, const hci_limit_merit *b, double scale_Nm)
{
    const double mean_Nm = a->mean_error_Nm + a->overshoot_Nm - b->mean_error_Nm - b->overshoot_Nm,
                 ripple_Nm = a->ripple_Nm - b->ripple_Nm;
    if (fabs(mean_Nm) > SAME * scale_Nm) return mean_Nm < 0.0;
    if (fabs(ripple_Nm) > SAME * scale_Nm) return ripple_Nm < 0.0;
    return a->copper_A2 < (1.0 - SAME_COPPER) * b->copper_A2;
}
