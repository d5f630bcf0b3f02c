#include "host/check/data/exchanged_currents.h"

#include <math.h>

#include "host/numeric/statistics.h"

/* Of the samples, in each direction at least. */
#define SEEN_WAY 0.1

/* Of the rms of a current that friction asks for: what turns round with the motion, at least. */
#define TURNS_ROUND 0.1

/* Of that of the other current, at most: what turns round with the motion, and the rms with its noise. */
#define LITTLE 0.2
#define NOISE  0.5

/* Samples and sums of two currents in one direction. */
typedef struct {
    double count, d, q;
} way_sums;

/* The way the shaft turns at a sample, by its speed, else by the step of the angle; 0: neither tells. */
static int way_at(const check_samples *s, double half_range, size_t k)
{
    if (s->speed) return (s->speed[k] > 0.0) - (s->speed[k] < 0.0);
    if (!s->theta || k + 1 == s->count) return 0;
    const double step = s->theta[k + 1] - s->theta[k];
    return fabs(step) > half_range ? 0 : (step > 0.0) - (step < 0.0);
}

static void add_ways(const check_samples *s, way_sums way[2])
{
    const double half_range = s->theta ? 0.5 * hci_peak_to_peak(s->theta, s->count) : 0.0;
    for (size_t k = 0; k < s->count; ++k) {
        const int forward = way_at(s, half_range, k);
        if (forward == 0) continue;
        way_sums *x = &way[forward < 0];
        x->count += 1.0;
        x->d += s->d[k];
        x->q += s->q[k];
    }
}

/* Of a turn, over which an angle goes that goes round; of the rms of all, that a current varies by which
 * stands. */
#define ROUND_rad 5.0
#define STANDS    0.1

int hci_check_standing_phase(const check_samples *s, double *mean_A)
{
    double square = 0.0, varies = 0.0, most = 0.0;
    int largest = -1;
    if (!s->phase || !s->theta || !(hci_peak_to_peak(s->theta, s->count) > ROUND_rad)) return -1;
    for (int phase = 0; phase < 3; ++phase) {
        if (!s->phase[phase]) continue;
        const double mean = hci_mean(s->phase[phase], s->count);
        varies += hci_mean_square_about(s->phase[phase], s->count, mean);
        square += hci_mean_square_about(s->phase[phase], s->count, 0.0);
        if (fabs(mean) > most) largest = phase;
        most = fmax(most, fabs(mean));
    }
    *mean_A = most;
    return varies < STANDS * STANDS * square ? largest : -1;
}

bool hci_check_currents_are_exchanged(const check_samples *s)
{
    way_sums way[2] = {{0.0, 0.0, 0.0}, {0.0, 0.0, 0.0}};
    if (!s->d || !s->q) return false;
    add_ways(s, way);
    if (!(fmin(way[0].count, way[1].count) > SEEN_WAY * (double)s->count)) return false;
    const double d = 0.5 * (way[0].d / way[0].count - way[1].d / way[1].count),
                 q = 0.5 * (way[0].q / way[0].count - way[1].q / way[1].count),
                 rms_d = sqrt(hci_mean_square_about(s->d, s->count, 0.0)),
                 rms_q = sqrt(hci_mean_square_about(s->q, s->count, 0.0));
    return fabs(d) > TURNS_ROUND * rms_d && rms_q < NOISE * rms_d && fabs(q) < LITTLE * fabs(d);
}
