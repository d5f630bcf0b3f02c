#include "host/diagnose/fit/noise_estimate.h"

#include <math.h>

#include "hci/math/harmonic.h"
#include "host/base/memory.h"

#define EVEN      0.02 /* departure of a step of angle from the mean one, as a share */
#define WHOLE     0.1  /* departure from whole periods, in samples */
#define FREEDOM   0.25 /* least share of the rows that counts as not used up by parameters */
#define NO_BETTER 1e-9 /* N·m: the least noise, so that a residual of 0 can be weighted */

/* Whether the angles of a segment of two samples or more are whole electrical periods, evenly spaced. */
static bool is_closed(const hci_regression *e, const hci_segment *s)
{
    const hci_binned_sample *sample = e->samples->sample + s->first;
    const double n = (double)s->count, p = e->machine->pole_pairs;
    if (s->turns > 0) return true;
    const double span = fabs(sample[s->count - 1].reading.theta_m_rad - sample[0].reading.theta_m_rad);
    const double periods = span * n / (n - 1.0) * p / (2.0 * HCI_PI);
    const double step = span / (n - 1.0);
    for (size_t k = 1; k < s->count; ++k)
        if (fabs(fabs(sample[k].reading.theta_m_rad - sample[k - 1].reading.theta_m_rad) - step) >
            EVEN * step)
            return false;
    return fabs(periods - floor(periods + 0.5)) < WHOLE / n && periods > 0.5;
}

static size_t longest_in_use(const hci_regression *e)
{
    size_t most = HCI_NOISE_LEAST;
    for (const hci_segment *s = NULL; (s = hci_regression_next(e, s)) != NULL;)
        most = s->count > most ? s->count : most;
    return most;
}

/* Noise of a colour of its own. Samples that tell nothing are 0 in a residual, and no noise. work:
 * hci_noise_workspace(s->count). */
static void long_segment(const hci_regression *e, const hci_segment *s, const double *residual,
                         double floor_Nm, double *work)
{
    hci_noise *noise = hci_regression_noise(e, s);
    const double telling = fmax(1.0, (double)hci_segment_telling(e->samples, s));
    const double scale = sqrt((double)s->count / telling);
    hci_noise_find(residual + s->first, s->count, is_closed(e, s), floor_Nm / scale, noise, work);
    noise->innovation = fmax(scale * noise->innovation, NO_BETTER);
    noise->rms = fmax(scale * noise->rms, NO_BETTER);
}

/* Noise that all short segments share. */
static void short_segments(const hci_regression *e, const double *residual, size_t parameters,
                           double floor_Nm)
{
    double square = 0.0, rows = 0.0;
    for (const hci_segment *s = NULL; (s = hci_regression_next(e, s)) != NULL;) {
        if (s->count >= HCI_NOISE_LEAST) continue;
        for (size_t j = s->first; j < s->first + s->count; ++j)
            square += residual[j] * residual[j];
        rows += (double)hci_segment_telling(e->samples, s);
    }
    const double freedom = fmax(1.0, fmax(rows - (double)parameters, FREEDOM * rows));
    for (const hci_segment *s = NULL; (s = hci_regression_next(e, s)) != NULL;)
        if (s->count < HCI_NOISE_LEAST)
            *hci_regression_noise(e, s) =
                hci_noise_white(fmax(NO_BETTER, hypot(sqrt(square / freedom), floor_Nm)));
}

hci_status hci_regression_noise_estimate(const hci_regression *e, const double *residual_Nm,
                                         size_t parameters, double floor_Nm, hci_note *note)
{
    double *work = hci_memory_new(hci_noise_workspace(longest_in_use(e)), sizeof *work);
    if (!work) return hci_note_memory(note, NULL, "the noise of the recordings");
    for (const hci_segment *s = NULL; (s = hci_regression_next(e, s)) != NULL;)
        if (s->count >= HCI_NOISE_LEAST) long_segment(e, s, residual_Nm, floor_Nm, work);
    short_segments(e, residual_Nm, parameters, floor_Nm);
    hci_memory_free(work);
    return HCI_OK;
}
