#include "host/diagnose/fit/resonance.h"

#include <math.h>

#include "hci/math/harmonic.h"
#include "host/base/memory.h"
#include "host/diagnose/fit/predicted_reading.h"

enum { FREQUENCIES = 48, LAGS = 20 };

static const double DAMPING[] = {0.03, 0.1, 0.3};

#define TOP 0.33 /* highest frequency, as a share of the sampling rate */

/* Torque without and with the resonance, in turns of a steady turn. */
typedef struct {
    const hci_regression *regression;
    const hci_effect_type *type; /* whose resonance it is */
    const double *residual_Nm;
    double *torque_Nm, *time_s, *y;
} scan;

/* Everything in one block, which begins at torque_Nm. False when memory is out. */
static bool scan_make(scan *l)
{
    const size_t most = hci_segment_longest(l->regression->samples);
    l->torque_Nm = hci_memory_new((2 * HCI_SETTLING_TURNS + 1) * most, sizeof *l->torque_Nm);
    if (!l->torque_Nm) return false;
    l->time_s = l->torque_Nm + HCI_SETTLING_TURNS * most;
    l->y = l->time_s + HCI_SETTLING_TURNS * most;
    return true;
}

/* The torque in the air gap: what was measured, less what the model leaves. */
static void turns_fill(const scan *l, const hci_segment *s, size_t turns)
{
    const hci_binned_sample *sample = l->regression->samples->sample + s->first;
    for (size_t turn = 0; turn < turns; ++turn)
        for (size_t k = 0; k < s->count; ++k) {
            l->torque_Nm[turn * s->count + k] = sample[k].torque_Nm - l->residual_Nm[s->first + k];
            l->time_s[turn * s->count + k] = sample[k].time_s + (double)turn * s->period_s;
        }
}

static double segment_square(const scan *l, const hci_effects *sensor, const hci_segment *s)
{
    const hci_binned_sample *sample = l->regression->samples->sample + s->first;
    const size_t n = s->count, turns = s->turns > 0 ? HCI_SETTLING_TURNS : 1;
    double sum = 0.0;
    turns_fill(l, s, turns);
    if (sensor) hci_effects_filter(sensor, l->time_s, turns * n, l->torque_Nm, NULL);
    for (size_t k = 0; k < n; ++k)
        l->y[k] = sample[k].torque_Nm - l->torque_Nm[(turns - 1) * n + k];
    hci_noise_whiten(hci_regression_noise(l->regression, s), l->y, n, 1);
    for (size_t k = 0; k < n; ++k)
        sum += l->y[k] * l->y[k];
    return sum;
}

/* χ² of all that a sensor's dynamics could show in. sensor: NULL for one without. */
static double sensor_square(const scan *l, const hci_effects *sensor)
{
    double sum = 0.0;
    for (const hci_segment *s = NULL; (s = hci_regression_next(l->regression, s)) != NULL;)
        if (hci_predicted_reading_is_dynamic(l->regression, s)) sum += segment_square(l, sensor, s);
    return sum;
}

static double square_with_lag(const scan *l, double time_constant_s)
{
    const hci_effect_term term[] = {{l->type->lag[0], 0.0, time_constant_s, NAN}};
    const hci_effect effect = {l->type, term, 1};
    const hci_effects sensor = {&effect, 1};
    return sensor_square(l, &sensor);
}

static double square_with(const scan *l, double frequency_Hz, double damping)
{
    const size_t *parameter = l->type->resonance;
    const hci_effect_term term[] = {{parameter[0], 0.0, frequency_Hz, NAN},
                                    {parameter[1], 0.0, damping, NAN}};
    const hci_effect effect = {l->type, term, 2};
    const hci_effects sensor = {&effect, 1};
    return sensor_square(l, &sensor);
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

static void grid_search(const scan *l, hci_resonance *best)
{
    double low_Hz, high_Hz;
    frequency_range(l->regression, &low_Hz, &high_Hz);
    const double before = sensor_square(l, NULL);
    for (int k = 0; k < FREQUENCIES && low_Hz < high_Hz; ++k) {
        const double frequency_Hz = low_Hz * pow(high_Hz / low_Hz, (double)k / (FREQUENCIES - 1));
        for (size_t j = 0; j < sizeof DAMPING / sizeof *DAMPING; ++j) {
            const double fall = before - square_with(l, frequency_Hz, DAMPING[j]);
            if (fall > best->gain) *best = (hci_resonance){frequency_Hz, DAMPING[j], fall};
        }
    }
}

static void lag_search(const scan *l, double *time_constant_s, double *gain)
{
    double low_Hz, high_Hz;
    frequency_range(l->regression, &low_Hz, &high_Hz);
    const double before = sensor_square(l, NULL);
    for (int k = 0; k < LAGS && low_Hz < high_Hz; ++k) {
        const double corner_Hz = low_Hz * pow(high_Hz / low_Hz, (double)k / (LAGS - 1));
        const double tau_s = 1.0 / (2.0 * HCI_PI * corner_Hz), fall = before - square_with_lag(l, tau_s);
        if (!(fall > *gain)) continue;
        *gain = fall;
        *time_constant_s = tau_s;
    }
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
