#include "host/diagnose/fit/late_torque.h"

#include <math.h>

#include "host/base/memory.h"

#define LONGEST_S 5e-3 /* delay of a bus, either way */
#define STEP      0.5  /* of the shortest time between two samples */

#define OF_SAMPLE 250.0 /* multiplications: a line between two samples, and the noise's memory */

enum { MOST_STEPS = 200, REFINEMENTS = 4 }; /* each way; halvings of the step about the best delay */

/* The torque in the air gap, as it was measured less what the model leaves, and shifted in time. */
typedef struct {
    const hci_regression *regression;
    const double *residual_Nm;
    double *shifted;
} scan;

static bool is_telling(const scan *l, const hci_segment *s)
{
    return s->timed && s->count > 1 && l->regression->runs[s->run].torque_source == HCI_TORQUE_MEASURED;
}

static double air_gap_Nm(const scan *l, size_t k)
{
    return l->regression->samples->sample[k].torque_Nm - l->residual_Nm[k];
}

/* The torque at a time, on a line between two samples. at: where it was looked for last. */
static double torque_at(const scan *l, const hci_segment *s, double time_s, size_t *at)
{
    const hci_binned_sample *sample = l->regression->samples->sample;
    if (time_s < sample[*at].time_s) *at = s->first;
    while (*at + 2 < s->first + s->count && sample[*at + 1].time_s < time_s)
        ++*at;
    const double step_s = sample[*at + 1].time_s - sample[*at].time_s;
    const double x = step_s > 0.0 ? (time_s - sample[*at].time_s) / step_s : 0.0;
    return air_gap_Nm(l, *at) + x * (air_gap_Nm(l, *at + 1) - air_gap_Nm(l, *at));
}

/* What the sensor should have read of a segment. Where that was before or behind it, all stays as it is; a
 * steady turn repeats. */
static void shift(scan *l, const hci_segment *s, double delay_s)
{
    const hci_binned_sample *sample = l->regression->samples->sample + s->first;
    const double begin_s = sample[0].time_s, end_s = sample[s->count - 1].time_s;
    size_t at = s->first;
    for (size_t k = 0; k < s->count; ++k) {
        double time_s = sample[k].time_s - delay_s;
        if (s->turns > 0 && s->period_s > 0.0)
            time_s -= s->period_s * floor((time_s - begin_s) / s->period_s);
        const bool inside = time_s >= begin_s && time_s <= end_s;
        l->shifted[k] = inside ? torque_at(l, s, time_s, &at) : air_gap_Nm(l, s->first + k);
    }
}

static double segment_square(scan *l, const hci_segment *s, double delay_s)
{
    const hci_binned_sample *sample = l->regression->samples->sample + s->first;
    double sum = 0.0;
    shift(l, s, delay_s);
    for (size_t k = 0; k < s->count; ++k)
        l->shifted[k] = sample[k].count > 0.0 ? sample[k].torque_Nm - l->shifted[k] : 0.0;
    hci_noise_whiten(hci_regression_noise(l->regression, s), l->shifted, s->count, 1);
    for (size_t k = 0; k < s->count; ++k)
        sum += l->shifted[k] * l->shifted[k];
    return sum;
}

static double square_with(scan *l, double delay_s)
{
    double sum = 0.0;
    for (const hci_segment *s = NULL; (s = hci_regression_next(l->regression, s)) != NULL;) {
        if (!is_telling(l, s)) continue;
        sum += segment_square(l, s, delay_s);
        hci_regression_count_products(l->regression, OF_SAMPLE * (double)s->count);
    }
    return sum;
}

/* The time between two samples as they were taken, on the average; 0: not known. The bins of a mean over turns
 * lie closer together, and say nothing faster. */
static double step_s(const hci_run *run)
{
    return run->count > 1 ? (run->time_s[run->count - 1] - run->time_s[0]) / (double)(run->count - 1) : 0.0;
}

/* The shortest of them; infinite where none tells. */
static double shortest_step_s(const scan *l)
{
    double least = INFINITY;
    for (const hci_segment *s = NULL; (s = hci_regression_next(l->regression, s)) != NULL;) {
        const double step = is_telling(l, s) ? step_s(&l->regression->runs[s->run]) : 0.0;
        if (step > 0.0) least = fmin(least, step);
    }
    return least;
}

static void take_better(scan *l, double before, double delay_s, hci_late_torque *best)
{
    const double fall = before - square_with(l, delay_s);
    if (fall > best->gain) *best = (hci_late_torque){delay_s, fall};
}

static void grid_search(scan *l, hci_late_torque *best)
{
    const double step_s = STEP * shortest_step_s(l), before = square_with(l, 0.0);
    for (int k = 1; k <= MOST_STEPS && (double)k * step_s <= LONGEST_S; ++k) {
        take_better(l, before, (double)k * step_s, best);
        take_better(l, before, -(double)k * step_s, best);
    }
    double around_s = 0.5 * step_s;
    for (int k = 0; k < REFINEMENTS && best->gain > 0.0; ++k, around_s *= 0.5) {
        const double middle_s = best->delay_s;
        take_better(l, before, middle_s + around_s, best);
        take_better(l, before, middle_s - around_s, best);
    }
}

hci_status hci_late_torque_find(const hci_regression *regression, const double *residual_Nm,
                                hci_late_torque *late, hci_note *note)
{
    scan l = {regression, residual_Nm, NULL};
    *late = (hci_late_torque){0.0, 0.0};
    l.shifted = hci_memory_new(hci_segment_longest(regression->samples), sizeof *l.shifted);
    if (!l.shifted) return hci_note_memory(note, NULL, "delays of the torque");
    grid_search(&l, late);
    hci_memory_free(l.shifted);
    return HCI_OK;
}
