#include "host/diagnose/fit/resonance.h"

#include <math.h>
#include <string.h>

#include "hci/math/harmonic.h"
#include "host/base/memory.h"
#include "host/diagnose/reading/predicted_reading.h"

enum { FREQUENCIES = 48, LAGS = 20 };

static const double DAMPING[] = {0.03, 0.1, 0.3};

#define TOP 0.33 /* highest frequency, as a share of the sampling rate */

#define ROUGHLY 0.375 /* of the time in which a sensor has settled to 1e-7 */

#define OF_SAMPLE 1700.0 /* multiplications that a sample takes on its way through the sensors, about */

/* Torque without and with the resonance, in turns of a steady turn. */
typedef struct {
    const hci_regression *regression;
    const hci_effect_type *type; /* whose resonance it is */
    const double *residual_Nm;
    double *torque_Nm, *time_s, *reading_Nm;
} scan;

enum { SENSORS = HCI_EFFECT_SENSORS };

/* Everything in one block, which begins at torque_Nm. False when memory is out. */
static bool scan_make(scan *l)
{
    const size_t most = HCI_SETTLING_TURNS * hci_segment_longest(l->regression->samples);
    l->torque_Nm = hci_memory_new((2 + SENSORS) * most, sizeof *l->torque_Nm);
    if (!l->torque_Nm) return false;
    l->time_s = l->torque_Nm + most;
    l->reading_Nm = l->time_s + most;
    return true;
}

/* The torque in the air gap: what was measured, less what the model leaves. lead: so many samples of the
 * turns before. */
static void torque_fill(const scan *l, const hci_segment *s, size_t lead)
{
    const hci_binned_sample *sample = l->regression->samples->sample + s->first;
    for (size_t k = 0; k < s->count; ++k) {
        l->torque_Nm[lead + k] = sample[k].torque_Nm - l->residual_Nm[s->first + k];
        l->time_s[lead + k] = sample[k].time_s;
    }
    for (size_t k = lead; k-- > 0;) {
        l->torque_Nm[k] = l->torque_Nm[k + s->count];
        l->time_s[k] = l->time_s[k + s->count] - s->period_s;
    }
}

/* How long the slowest of some sensors takes to settle to a few thousandths. */
static double settling_s(const hci_effect *sensors, size_t count)
{
    double most_s = 0.0;
    for (size_t k = 0; k < count; ++k)
        most_s = fmax(most_s, ROUGHLY * hci_settling_s(&(hci_effects){&sensors[k], 1}));
    return most_s;
}

/* Adds χ² of a turn behind each sensor. */
static void segment_squares(const scan *l, const hci_effect *sensors, size_t count, const hci_segment *s,
                            double square[SENSORS])
{
    const hci_binned_sample *sample = l->regression->samples->sample + s->first;
    const size_t n = s->count;
    const size_t lead = s->turns > 0 ? hci_settling_samples(sample, s, settling_s(sensors, count)) : 0;
    const hci_effect_run run = {l->time_s, lead + n, l->torque_Nm, NULL, 0, 0};
    double *y = l->reading_Nm + lead * SENSORS;
    torque_fill(l, s, lead);
    hci_regression_count_products(l->regression, OF_SAMPLE * (double)(lead + n));
    l->type->filter_many(sensors, count, &run, l->reading_Nm);
    for (size_t k = 0; k < n; ++k)
        for (size_t j = 0; j < SENSORS; ++j)
            y[k * SENSORS + j] = sample[k].torque_Nm - y[k * SENSORS + j];
    hci_noise_whiten(hci_regression_noise(l->regression, s), y, n, SENSORS);
    for (size_t k = 0; k < n; ++k)
        for (size_t j = 0; j < SENSORS; ++j)
            square[j] += y[k * SENSORS + j] * y[k * SENSORS + j];
}

/* χ² of all that a sensor's dynamics could show in, behind each sensor. */
static void sensor_squares(const scan *l, const hci_effect *sensors, size_t count, double square[SENSORS])
{
    memset(square, 0, SENSORS * sizeof *square);
    for (const hci_segment *s = NULL; (s = hci_regression_next(l->regression, s)) != NULL;)
        if (hci_predicted_reading_is_dynamic(l->regression, s)) segment_squares(l, sensors, count, s, square);
}

/* The same without a sensor. */
static double plain_square(const scan *l)
{
    double sum = 0.0;
    for (const hci_segment *s = NULL; (s = hci_regression_next(l->regression, s)) != NULL;) {
        if (!hci_predicted_reading_is_dynamic(l->regression, s)) continue;
        memcpy(l->reading_Nm, l->residual_Nm + s->first, s->count * sizeof *l->reading_Nm);
        hci_noise_whiten(hci_regression_noise(l->regression, s), l->reading_Nm, s->count, 1);
        for (size_t k = 0; k < s->count; ++k)
            sum += l->reading_Nm[k] * l->reading_Nm[k];
    }
    return sum;
}

/* From the slowest turn to a third of the sampling rate. */
static void frequency_range(const hci_regression *e, double *low_Hz, double *high_Hz)
{
    *low_Hz = INFINITY;
    *high_Hz = 0.0;
    for (const hci_segment *s = NULL; (s = hci_regression_next(e, s)) != NULL;) {
        const hci_binned_sample *sample = e->samples->sample + s->first;
        const double length_s = s->turns > 0 ? s->period_s : sample[s->count - 1].time_s - sample[0].time_s;
        const double speed = fabs(sample[s->count / 2].reading.speed_rad_per_s);
        if (!hci_predicted_reading_is_dynamic(e, s) || !(length_s > 0.0)) continue;
        *high_Hz = fmax(*high_Hz, TOP * (double)s->count / length_s);
        if (speed > 0.0) *low_Hz = fmin(*low_Hz, speed / (2.0 * HCI_PI));
    }
}

/* Point k of a grid of so many, evenly spaced by ratio. */
static double on_grid(double low, double high, int k, int count)
{
    return low * pow(high / low, (double)k / (count - 1));
}

enum { DAMPINGS = sizeof DAMPING / sizeof *DAMPING, POINTS = FREQUENCIES * DAMPINGS };

/* As many points of the grid as go side by side, from one on. */
static void points_try(const scan *l, const double range_Hz[2], int from, double before, hci_resonance *best)
{
    hci_effect_term term[SENSORS][2];
    hci_effect sensor[SENSORS] = {{0}};
    double square[SENSORS];
    const int count = POINTS - from < SENSORS ? POINTS - from : SENSORS;
    for (int k = 0; k < count; ++k) {
        const double at_Hz = on_grid(range_Hz[0], range_Hz[1], (from + k) / DAMPINGS, FREQUENCIES);
        term[k][0] = (hci_effect_term){l->type->resonance[0], 0.0, at_Hz, NAN};
        term[k][1] = (hci_effect_term){l->type->resonance[1], 0.0, DAMPING[(from + k) % DAMPINGS], NAN};
        sensor[k] = (hci_effect){l->type, term[k], 2};
    }
    sensor_squares(l, sensor, (size_t)count, square);
    for (int k = 0; k < count; ++k)
        if (before - square[k] > best->gain)
            *best = (hci_resonance){term[k][0].value, term[k][1].value, before - square[k]};
}

static void grid_search(const scan *l, hci_resonance *best)
{
    double range_Hz[2];
    frequency_range(l->regression, &range_Hz[0], &range_Hz[1]);
    if (!(range_Hz[0] < range_Hz[1])) return;
    const double before = plain_square(l);
    for (int k = 0; k < POINTS; k += SENSORS)
        points_try(l, range_Hz, k, before, best);
}

/* As many lags as go side by side, from one on. */
static void lags_try(const scan *l, const double range_Hz[2], int from, double *time_constant_s,
                     double *least)
{
    hci_effect_term term[SENSORS];
    hci_effect sensor[SENSORS] = {{0}};
    double square[SENSORS];
    const int count = LAGS - from < SENSORS ? LAGS - from : SENSORS;
    for (int k = 0; k < count; ++k) {
        const double corner_Hz = on_grid(range_Hz[0], range_Hz[1], from + k, LAGS);
        term[k] = (hci_effect_term){l->type->lag[0], 0.0, 1.0 / (2.0 * HCI_PI * corner_Hz), NAN};
        sensor[k] = (hci_effect){l->type, &term[k], 1};
    }
    sensor_squares(l, sensor, (size_t)count, square);
    for (int k = 0; k < count; ++k) {
        if (!(square[k] < *least)) continue;
        *least = square[k];
        *time_constant_s = term[k].value;
    }
}

static void lag_search(const scan *l, double *time_constant_s, double *gain)
{
    double range_Hz[2];
    frequency_range(l->regression, &range_Hz[0], &range_Hz[1]);
    if (!(range_Hz[0] < range_Hz[1])) return;
    const double before = plain_square(l);
    double least = before;
    for (int k = 0; k < LAGS; k += SENSORS)
        lags_try(l, range_Hz, k, time_constant_s, &least);
    *gain = before - least;
}

hci_status hci_resonance_find(const hci_regression *regression, const hci_effect_type *type,
                              const double *residual_Nm, hci_resonance *resonance, hci_note *note)
{
    scan l = {.regression = regression, .type = type, .residual_Nm = residual_Nm};
    *resonance = (hci_resonance){0.0, 0.0, 0.0};
    if (!scan_make(&l)) return hci_note_memory(note, NULL, "resonances of the sensor");
    grid_search(&l, resonance);
    hci_memory_free(l.torque_Nm);
    return HCI_OK;
}

hci_status hci_lag_find(const hci_regression *regression, const hci_effect_type *type,
                        const double *residual_Nm, double *time_constant_s, double *gain, hci_note *note)
{
    scan l = {.regression = regression, .type = type, .residual_Nm = residual_Nm};
    *time_constant_s = *gain = 0.0;
    if (!scan_make(&l)) return hci_note_memory(note, NULL, "lags of the sensor");
    lag_search(&l, time_constant_s, gain);
    hci_memory_free(l.torque_Nm);
    return HCI_OK;
}
