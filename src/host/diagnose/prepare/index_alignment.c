#include "host/diagnose/prepare/index_alignment.h"

#include <math.h>
#include <string.h>

#include "hci/machine/frames.h"
#include "host/base/memory.h"

enum { ORDERS = 48, ANGLES = 720 }; /* of a map; that are tried before the best one is refined */

#define LITTLE_CURRENT 0.05 /* share of the largest that counts as none */
#define ALIKE          0.9  /* correlation of turned residuals that are the same map */
#define REPEATED       0.7  /* correlation of two halves of a run that show a map */
#define SPREAD         1.6  /* orders that share the power of a map: one alone fits itself at many angles */
#define BETTER         0.25 /* by so much more than unturned ones */
#define MOST_OF_A_TURN 0.95 /* that a run must have gone through */
#define EXACT_RAD      1e-6 /* of the angle that is found */

/* Fourier sums of a run's residual over the mechanical angle, orders 1 … ORDERS. */
typedef struct {
    double cosine[ORDERS], sine[ORDERS], power;
    bool usable;
} map;

static bool is_usable(const hci_binned_samples *samples, const hci_run *runs, size_t run, double most_A)
{
    const hci_run_statistics *f = &samples->statistics[run];
    return runs[run].turn_known && runs[run].torque_source != HCI_TORQUE_NONE && f->turns > MOST_OF_A_TURN &&
           (runs[run].torque_source == HCI_TORQUE_HOLDING || f->current_A <= LITTLE_CURRENT * most_A);
}

static void map_add(map *m, double theta_m_rad, double residual)
{
    for (int n = 0; n < ORDERS; ++n) {
        const double angle = (n + 1) * theta_m_rad;
        m->cosine[n] += residual * cos(angle);
        m->sine[n] += residual * sin(angle);
    }
}

/* Samples of a run from one share of it to another. */
typedef struct {
    size_t run;
    double from, until;
} part;

static size_t samples_of(const hci_binned_samples *samples, size_t run)
{
    size_t count = 0;
    for (const hci_segment *s = NULL; (s = hci_segment_next(samples, run, s)) != NULL;)
        count += s->count;
    return count;
}

/* Mean residuals of the samples that turn one way and the other, or stand. */
typedef struct {
    double mean[3], count[3];
} way_means;

static size_t way_of(const hci_binned_sample *x)
{
    return x->reading.speed_rad_per_s > 0.0 ? 2 : x->reading.speed_rad_per_s < 0.0 ? 0 : 1;
}

static bool is_in_part(const part *p, double at, double all)
{
    return at >= p->from * all && at < p->until * all;
}

static way_means way_means_of(const hci_binned_samples *samples, const part *p, const double *residual)
{
    const double all = (double)samples_of(samples, p->run);
    way_means m = {{0.0}, {0.0}};
    double at = 0.0;
    for (const hci_segment *s = NULL; (s = hci_segment_next(samples, p->run, s)) != NULL;)
        for (size_t j = s->first; j < s->first + s->count; ++j, at += 1.0) {
            const size_t way = way_of(&samples->sample[j]);
            if (is_in_part(p, at, all)) m.mean[way] += (residual[j] - m.mean[way]) / (m.count[way] += 1.0);
        }
    return m;
}

/* Friction makes a mean that depends on the direction: it leaves, since over other than whole turns it has a
 * part in all orders. */
static void map_make(const hci_binned_samples *samples, const part *p, const double *residual, map *m)
{
    const double all = (double)samples_of(samples, p->run);
    const way_means means = way_means_of(samples, p, residual);
    double count = 0.0, at = 0.0;
    memset(m, 0, sizeof *m);
    for (const hci_segment *s = NULL; (s = hci_segment_next(samples, p->run, s)) != NULL;)
        for (size_t j = s->first; j < s->first + s->count; ++j, at += 1.0) {
            const hci_binned_sample *x = &samples->sample[j];
            if (!is_in_part(p, at, all)) continue;
            map_add(m, x->reading.theta_m_rad, residual[j] - means.mean[way_of(x)]);
            count += 1.0;
        }
    for (int n = 0; n < ORDERS && count > 0.0; ++n) {
        m->cosine[n] /= count;
        m->sine[n] /= count;
        m->power += m->cosine[n] * m->cosine[n] + m->sine[n] * m->sine[n];
    }
}

/* How many orders share the power, weighted: 1 for a single one. */
static double spread_of(const map *m)
{
    double fourth = 0.0;
    for (int n = 0; n < ORDERS; ++n) {
        const double power = m->cosine[n] * m->cosine[n] + m->sine[n] * m->sine[n];
        fourth += power * power;
    }
    return fourth > 0.0 ? m->power * m->power / fourth : 0.0;
}

/* Correlation of a with b turned back by an angle. */
static double likeness(const map *a, const map *b, double angle_rad)
{
    double sum = 0.0;
    for (int n = 0; n < ORDERS; ++n) {
        const double c = cos((n + 1) * angle_rad), s = sin((n + 1) * angle_rad);
        const double cosine = c * b->cosine[n] + s * b->sine[n], sine = c * b->sine[n] - s * b->cosine[n];
        sum += a->cosine[n] * cosine + a->sine[n] * sine;
    }
    return a->power > 0.0 && b->power > 0.0 ? sum / sqrt(a->power * b->power) : 0.0;
}

/* The angle at which b resembles a best: of a grid, then by halving steps. */
static double best_turn(const map *a, const map *b)
{
    double best = 0.0, most = -1.0;
    for (int k = 0; k < ANGLES; ++k) {
        const double angle = 2.0 * HCI_PI * k / ANGLES, x = likeness(a, b, angle);
        if (x > most) {
            most = x;
            best = angle;
        }
    }
    for (double step = HCI_PI / ANGLES; step > EXACT_RAD; step *= 0.5) {
        if (likeness(a, b, best + step) > most) best += step;
        if (likeness(a, b, best - step) > likeness(a, b, best)) best -= step;
        most = likeness(a, b, best);
    }
    return best;
}

/* Whether both halves of a run show the same map, where each has a turn: what does not repeat is none. */
static bool repeats(const hci_binned_samples *samples, size_t run, const double *residual)
{
    const part half[] = {{run, 0.0, 0.5}, {run, 0.5, 1.0}};
    map first, second;
    if (samples->statistics[run].turns < 2.0 * MOST_OF_A_TURN) return true;
    map_make(samples, &half[0], residual, &first);
    map_make(samples, &half[1], residual, &second);
    return likeness(&first, &second, 0.0) > REPEATED;
}

/* That angle within ± half a turn; 0 unless b resembles a much better there than as it is. */
static double turn_between(const map *a, const map *b)
{
    const double best = best_turn(a, b), most = likeness(a, b, best);
    if (most < ALIKE || most < likeness(a, b, 0.0) + BETTER) return 0.0;
    return best > HCI_PI ? best - 2.0 * HCI_PI : best;
}

/* The run that resembles most others as they are. */
static size_t reference_of(const map *maps, size_t count)
{
    size_t best = count;
    double most = -1e300;
    for (size_t k = 0; k < count; ++k) {
        double sum = 0.0;
        for (size_t j = 0; j < count && maps[k].usable; ++j)
            if (j != k && maps[j].usable) sum += likeness(&maps[k], &maps[j], 0.0);
        if (maps[k].usable && sum > most) {
            most = sum;
            best = k;
        }
    }
    return best;
}

static void maps_make(const hci_binned_samples *samples, const hci_run *runs, const double *residual,
                      map *maps)
{
    double most_A = 0.0;
    for (size_t k = 0; k < samples->run_count; ++k)
        most_A = fmax(most_A, samples->statistics[k].current_A);
    for (size_t k = 0; k < samples->run_count; ++k) {
        if (!is_usable(samples, runs, k, most_A)) continue;
        map_make(samples, &(part){k, 0.0, 1.0}, residual, &maps[k]);
        maps[k].usable = spread_of(&maps[k]) > SPREAD && repeats(samples, k, residual);
    }
}

hci_status hci_index_alignment_find(const hci_binned_samples *samples, const hci_run *runs,
                                    const double *residual_Nm, double *index_offset_rad, hci_note *note)
{
    const size_t count = samples->run_count;
    map *maps = hci_memory_new(count + 1, sizeof *maps);
    if (!maps) return hci_note_memory(note, NULL, "comparing recordings");
    maps_make(samples, runs, residual_Nm, maps);
    const size_t reference = reference_of(maps, count);
    for (size_t k = 0; k < count; ++k) {
        const bool compared = reference < count && k != reference && maps[k].usable;
        index_offset_rad[k] = compared ? turn_between(&maps[reference], &maps[k]) : 0.0;
    }
    hci_memory_free(maps);
    return HCI_OK;
}

static void sample_turn(hci_sample *x, int pole_pairs, double index_offset_rad)
{
    const hci_dq i = hci_park(hci_clarke(x->i_abc), pole_pairs * index_offset_rad);
    x->theta_m_rad -= index_offset_rad;
    hci_clarke_inverse(hci_park_inverse(i, 0.0), x->i_abc);
}

void hci_index_alignment_apply(hci_binned_samples *samples, size_t run, int pole_pairs,
                               double index_offset_rad)
{
    for (const hci_segment *s = NULL; (s = hci_segment_next(samples, run, s)) != NULL;)
        for (size_t j = s->first; j < s->first + s->count; ++j) {
            sample_turn(&samples->sample[j].reading, pole_pairs, index_offset_rad);
            sample_turn(&samples->sample[j].raw, pole_pairs, index_offset_rad);
        }
}
