#include "host/diagnose/prepare/current_rate.h"

#include <math.h>

#include "host/recording/rotor_frame.h"

#define REACH                                                                                                \
    80.0 /* part of an electrical period on each side: smooths the noise and keeps harmonics up to the 12th  \
          */

enum { MOST_REACH = 32, LEAST_REACH = 2 }; /* samples on each side */

/* Sums for the slope of i_d and i_q over time. */
typedef struct {
    double n, t, tt, d, q, td, tq;
} slope_sums;

static void slope_add(slope_sums *s, double t, const hci_sample *x, int pole_pairs)
{
    const hci_dq i = hci_sample_dq(x, pole_pairs);
    s->n += 1.0;
    s->t += t;
    s->tt += t * t;
    s->d += i.d;
    s->q += i.q;
    s->td += t * i.d;
    s->tq += t * i.q;
}

/* Neighbours on one side that are within reach, two of them in any case. */
static void slope_gather(slope_sums *s, const hci_binned_sample *sample, size_t n, size_t at, bool upwards,
                         int pole_pairs)
{
    const double reach_rad = 2.0 * HCI_PI / pole_pairs / REACH, theta = sample[at].reading.theta_m_rad;
    const size_t most = upwards ? n - 1 - at : at;
    for (size_t step = 1; step <= most && step <= MOST_REACH; ++step) {
        const hci_binned_sample *c = upwards ? &sample[at + step] : &sample[at - step];
        if (fabs(c->reading.theta_m_rad - theta) > reach_rad && step > LEAST_REACH) return;
        slope_add(s, c->time_s - sample[at].time_s, &c->reading, pole_pairs);
    }
}

void hci_current_rates_set(hci_binned_sample *sample, size_t n, int pole_pairs)
{
    for (size_t k = 0; k < n; ++k) {
        slope_sums s = {0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0};
        slope_add(&s, 0.0, &sample[k].reading, pole_pairs);
        slope_gather(&s, sample, n, k, false, pole_pairs);
        slope_gather(&s, sample, n, k, true, pole_pairs);
        const double spread = s.n * s.tt - s.t * s.t;
        if (!(spread > 0.0)) continue;
        const hci_dq slope = {(s.n * s.td - s.t * s.d) / spread, (s.n * s.tq - s.t * s.q) / spread, 0.0};
        hci_phases_of_dq(slope, pole_pairs * sample[k].reading.theta_m_rad, sample[k].reading.change_A_per_s);
    }
}
