#include "host/diagnose/candidates/angle_orders.h"

#include <math.h>

#include "host/base/memory.h"

#define STANDS_OUT 20.0 /* fall of χ² */

enum { MOST_PERIODS = 300 /* in a mechanical turn */ };

/* Sums over all samples, with orders 1 … count of the stride. */
typedef struct {
    size_t stride, count;
    double *cosine, *sine; /* Σ w r g × cos and sin */
    double square;         /* Σ w g² */
} sums;

static bool shows(const hci_candidates_source *s, size_t run)
{
    const hci_run *r = &s->runs[run];
    return s->use[run] && !r->only_mean && r->torque_source == HCI_TORQUE_MEASURED;
}

/* weighted: w r g. */
static void waves_add(sums *sum, double theta_m_rad, double weighted)
{
    const double angle = theta_m_rad * (double)sum->stride, c = cos(angle), s = sin(angle);
    double x = 1.0, y = 0.0;
    for (size_t k = 0; k < sum->count; ++k) {
        const double next = c * x - s * y;
        y = s * x + c * y;
        x = next;
        sum->cosine[k] += weighted * x;
        sum->sine[k] += weighted * y;
    }
}

static double mean_of(const hci_candidates_source *s, const hci_segment *segment)
{
    double sum = 0.0, weight = 0.0;
    for (size_t j = segment->first; j < segment->first + segment->count; ++j) {
        sum += s->residual_Nm[j] / s->variance[j];
        weight += 1.0 / s->variance[j];
    }
    return weight > 0.0 ? sum / weight : 0.0;
}

static void segment_add(const hci_candidates_source *s, const hci_segment *segment, sums *sum)
{
    const double mean = mean_of(s, segment);
    for (size_t j = segment->first; j < segment->first + segment->count; ++j) {
        const hci_sample *x = &s->samples->sample[j].reading;
        const double theta_rad = s->machine->pole_pairs * x->theta_m_rad, w = 1.0 / s->variance[j];
        const double slope = hci_torque_slopes_at(s->machine, theta_rad, x->i_abc).by_angle;
        waves_add(sum, x->theta_m_rad, w * slope * (s->residual_Nm[j] - mean));
        sum->square += w * slope * slope;
    }
}

static double strength(const sums *sum, size_t k)
{
    const double square = sum->cosine[k] * sum->cosine[k] + sum->sine[k] * sum->sine[k];
    return sum->square > 0.0 ? 2.0 * square / sum->square : 0.0;
}

/* The strongest first. */
static void strongest(const sums *sum, int pole_pairs, hci_angle_orders *x)
{
    double under = INFINITY;
    for (x->count = 0; x->count < HCI_ANGLE_ORDERS; ++x->count) {
        size_t best = sum->count;
        double above = STANDS_OUT;
        for (size_t k = 0; k < sum->count; ++k) {
            const double gain = strength(sum, k);
            if (gain >= under || gain <= above) continue;
            above = gain;
            best = k;
        }
        if (best == sum->count) return;
        under = above;
        x->order[x->count] = (double)((best + 1) * sum->stride) / pole_pairs;
    }
}

bool hci_angle_orders_find(const hci_candidates_source *s, size_t stride, double resolved,
                           hci_angle_orders *x)
{
    const double most = fmin(MOST_PERIODS, resolved * s->machine->pole_pairs);
    sums sum = {.stride = stride, .count = isfinite(resolved) ? (size_t)(most / (double)stride) : 0};
    sum.cosine = hci_memory_new(2 * sum.count + 1, sizeof *sum.cosine);
    if (!sum.cosine) return false;
    sum.sine = sum.cosine + sum.count;
    for (size_t k = 0; k < s->samples->segment_count; ++k)
        if (shows(s, s->samples->segment[k].run)) segment_add(s, &s->samples->segment[k], &sum);
    strongest(&sum, s->machine->pole_pairs, x);
    hci_memory_free(sum.cosine);
    return true;
}
