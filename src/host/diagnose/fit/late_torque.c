#include "host/diagnose/fit/late_torque.h"

#include <math.h>

#include "host/base/memory.h"

#define LONGEST_S 5e-3 /* delay of a bus, either way */
#define STEP      0.5  /* of the shortest time between two samples */

#define OF_SAMPLE 100.0 /* multiplications: a line between two samples, and the noise's memory */

enum { MOST_STEPS = 200, REFINEMENTS = 4 }; /* each way; halvings of the step about the best delay */

/* The torque in the air gap, as it was measured less what the model leaves, and shifted in time. Of all
 * samples, side by side. */
typedef struct {
    const hci_regression *regression;
    double *time_s, *torque_Nm, *air_gap_Nm; /* [samples] */
    double *tells;                           /* of each sample, 1 where it tells a torque, else 0 */
    double *shifted;                         /* [longest segment] */
} scan;

static bool scan_make(scan *l, const double *residual_Nm)
{
    const hci_binned_samples *samples = l->regression->samples;
    const size_t n = samples->count;
    l->time_s = hci_memory_new(4 * n + hci_segment_longest(samples), sizeof *l->time_s);
    if (!l->time_s) return false;
    l->torque_Nm = l->time_s + n;
    l->air_gap_Nm = l->torque_Nm + n;
    l->tells = l->air_gap_Nm + n;
    l->shifted = l->tells + n;
    for (size_t k = 0; k < n; ++k) {
        l->time_s[k] = samples->sample[k].time_s;
        l->torque_Nm[k] = samples->sample[k].torque_Nm;
        l->air_gap_Nm[k] = l->torque_Nm[k] - residual_Nm[k];
        l->tells[k] = samples->sample[k].count > 0.0 ? 1.0 : 0.0;
    }
    return true;
}

static bool is_telling(const scan *l, const hci_segment *s)
{
    return s->timed && s->count > 1 && l->regression->runs[s->run].torque_source == HCI_TORQUE_MEASURED;
}

/* The torque at a time, on a line between two samples. at: where it was looked for last. */
static double torque_at(const scan *l, const hci_segment *s, double time_s, size_t *at)
{
    const double *time = l->time_s, *torque = l->air_gap_Nm;
    if (time_s < time[*at]) *at = s->first;
    while (*at + 2 < s->first + s->count && time[*at + 1] < time_s)
        ++*at;
    const double step_s = time[*at + 1] - time[*at];
    const double x = step_s > 0.0 ? (time_s - time[*at]) / step_s : 0.0;
    return torque[*at] + x * (torque[*at + 1] - torque[*at]);
}

/* A time within the turn that begins at a time; a steady turn repeats. */
static double within_turn(double time_s, double begin_s, double period_s)
{
    if (!(period_s > 0.0)) return time_s;
    if (time_s < begin_s || time_s >= begin_s + period_s)
        time_s -= period_s * floor((time_s - begin_s) / period_s);
    return time_s;
}

/* What the sensor should have read of a segment. Where that was before or behind it, all stays as it is. */
static void shift(scan *l, const hci_segment *s, double delay_s)
{
    const double begin_s = l->time_s[s->first], end_s = l->time_s[s->first + s->count - 1];
    const double period_s = s->turns > 0 ? s->period_s : 0.0;
    size_t at = s->first;
    for (size_t k = 0; k < s->count; ++k) {
        const double time_s = within_turn(l->time_s[s->first + k] - delay_s, begin_s, period_s);
        const bool inside = time_s >= begin_s && time_s <= end_s;
        l->shifted[k] = inside ? torque_at(l, s, time_s, &at) : l->air_gap_Nm[s->first + k];
    }
}

static double segment_square(scan *l, const hci_segment *s, double delay_s)
{
    double sum = 0.0;
    shift(l, s, delay_s);
    for (size_t k = 0; k < s->count; ++k)
        l->shifted[k] = l->tells[s->first + k] * (l->torque_Nm[s->first + k] - l->shifted[k]);
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

/* The time between two samples as they were taken, on the average, or between two of a segment; 0: not known.
 * Of the bins of a mean over turns neither those that lie closer together nor those that lie farther apart
 * say anything faster. */
static double step_s(const scan *l, const hci_segment *s)
{
    const hci_run *run = &l->regression->runs[s->run];
    const double taken_s =
        run->count > 1 ? (run->time_s[run->count - 1] - run->time_s[0]) / (double)(run->count - 1) : 0.0;
    const double length_s = l->time_s[s->first + s->count - 1] - l->time_s[s->first];
    return taken_s > 0.0 ? fmax(taken_s, length_s / (double)(s->count - 1)) : 0.0;
}

/* The shortest of them; infinite where none tells. */
static double shortest_step_s(const scan *l)
{
    double least = INFINITY;
    for (const hci_segment *s = NULL; (s = hci_regression_next(l->regression, s)) != NULL;) {
        const double step = is_telling(l, s) ? step_s(l, s) : 0.0;
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
    scan l = {.regression = regression};
    *late = (hci_late_torque){0.0, 0.0};
    if (!scan_make(&l, residual_Nm)) return hci_note_memory(note, NULL, "delays of the torque");
    grid_search(&l, late);
    hci_memory_free(l.time_s);
    return HCI_OK;
}
