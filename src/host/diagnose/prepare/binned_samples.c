#include "host/diagnose/prepare/binned_samples.h"

#include <math.h>
#include <string.h>

#include "hci/machine/frames.h"
#include "hci/math/harmonic.h"
#include "host/base/memory.h"
#include "host/diagnose/prepare/current_rate.h"
#include "host/diagnose/prepare/drift.h"
#include "host/diagnose/prepare/repeats.h"
#include "host/diagnose/prepare/rest.h"
#include "host/diagnose/prepare/run_statistics.h"
#include "host/diagnose/prepare/smooth.h"
#include "host/diagnose/prepare/swing.h"
#include "host/diagnose/prepare/turns.h"
#include "host/machine/torque_constant.h"
#include "host/recording/rotor_frame.h"
#include "host/recording/speed_variation.h"

enum {
    BINS_PER_TURN = 4096, /* of a mean over turns */
    OF_PERIOD = 180,      /* of them, for each electrical period in it, that are left where they are joined */
    MOST_JOINED = 4,
    OF_FASTEST = 64,    /* samples in which the speed is one */
    MOST_ALONG = 8,     /* samples along time that are joined, of runs that have more than so fine bins */
    MOST_OF_MANY = 5,   /* where all runs together have many samples */
    LEAST_TURNS = 3,    /* for such a mean */
    LEAST_SPARSE = 8,   /* turns that show between the samples of one what those of the others do */
    LEAST_OF_SLOPE = 2, /* samples */
    LEAST_OF_WAY = 16,
    MOST_OPEN = 8,      /* segments of samples as they are, for each run */
    MANY = 16384,       /* samples of all runs, which then have steady ones as means however short */
    MOST_SLOW = 16384,  /* samples of a run that stay as they are where noise is slow, and … */
    ALL_SLOW = 49152,   /* … of all of them */
    WORTH_MEANS = 2,    /* samples for each of a mean, there */
    FINER = 4,          /* times as fine as the samples of a turn, that a mean may be there */
    CREEPING_PIECES = 4 /* means of one steady run whose torque creeps */
};

#define PER_PERIOD 4.0 /* samples of the finest order, with which a sensor can be followed */

/* One run on its way into the samples. */
typedef struct {
    const hci_run *run;
    size_t index; /* in the list of runs */
    int pole_pairs;
    double finest_order;     /* of the declared cogging torque, in periods of a mechanical turn */
    double Nm_per_A;         /* of i_q, of the machine as declared */
    double follows_Nm_per_A; /* the same where the torque follows what of i_q does not repeat; else 0 */
    double holding_Nm_per_A; /* in a holding test, where the current of the q axis is what was measured; else
                                0 */
    const hci_run_statistics *statistics;
    const double *acceleration; /* of each sample, rad/s²; 0 where a rotor's inertia is not in the torque */
    const bool *at_rest;        /* of each sample of the run: it tells no torque */
    bool many;                  /* all runs together have many samples */
    hci_binned_samples *samples;
    size_t *capacity; /* samples that there is memory for */
} reduction;

/* ---- samples ---- */

static void sample_of(const reduction *x, size_t k, hci_binned_sample *c)
{
    const hci_run *r = x->run;
    memset(c, 0, sizeof *c);
    c->reading.theta_m_rad = r->theta_m_rad ? r->theta_m_rad[k] : 0.0;
    c->reading.acceleration_rad_per_s2 = x->acceleration[k];
    c->reading.speed_rad_per_s = r->speed_rad_per_s ? r->speed_rad_per_s[k] : 0.0;
    memcpy(c->reading.i_abc, r->i_A + 3 * k, sizeof c->reading.i_abc);
    c->reading.computed_phase = r->computed_phase;
    c->reading.switched_off = r->switched_off;
    c->reading.temperature_C = r->temperature_C ? r->temperature_C[k] : (double)NAN;
    c->torque_Nm = r->torque_Nm[k];
    c->sum_A = r->has_sum ? r->i_A[3 * k] + r->i_A[3 * k + 1] + r->i_A[3 * k + 2] : (double)NAN;
    c->time_s = r->time_s ? r->time_s[k] : 0.0;
    if (x->statistics->swings > 0) c->torque_Nm -= hci_swings_at_Nm(x->statistics, c->time_s);
    if (x->statistics->drift.degree > 0) c->torque_Nm -= hci_drift_at_Nm(&x->statistics->drift, c->time_s);
    c->reading.elapsed_s = r->time_s ? r->time_s[k] - r->time_s[0] : 0.0;
    c->count = x->at_rest[k] ? 0.0 : 1.0;
}

/* Memory for so many more samples: where they begin, NULL when memory is out. */
static hci_binned_sample *reserve(const reduction *x, size_t more)
{
    hci_binned_samples *samples = x->samples;
    if (samples->count + more > *x->capacity) {
        const size_t wanted = 2 * (samples->count + more);
        hci_binned_sample *grown = hci_memory_resize(samples->sample, wanted, sizeof *grown);
        if (!grown) return NULL;
        samples->sample = grown;
        *x->capacity = wanted;
    }
    return samples->sample + samples->count;
}

static bool segment_add(hci_binned_samples *samples, const hci_segment *s)
{
    hci_segment *grown = hci_memory_resize(samples->segment, samples->segment_count + 1, sizeof *grown);
    if (!grown) return false;
    samples->segment = grown;
    grown[samples->segment_count++] = *s;
    return true;
}

/* Where besides what stands still only noise was read, no other current flowed. */
static void currents_stand(hci_binned_sample *sample, size_t count, const double standing_A[3])
{
    for (size_t k = 0; k < count; ++k)
        memcpy(sample[k].reading.i_abc, standing_A, sizeof sample[k].reading.i_abc);
}

/* Keeps the readings, smooths them, and finds how fast the currents change. */
static bool segment_finish(const reduction *x, hci_segment *s)
{
    hci_binned_sample *sample = x->samples->sample + s->first;
    bool series = false;
    const bool flows = x->follows_Nm_per_A != 0.0; /* what of the current is not one of the turn */
    const bool stands = !flows && (x->statistics->no_current || x->statistics->stands);
    if (stands) currents_stand(sample, s->count, x->statistics->standing_A);
    for (size_t k = 0; k < s->count; ++k)
        sample[k].raw = sample[k].reading;
    /* in a holding test the current is what is measured, noise and all */
    if (x->run->torque_source != HCI_TORQUE_HOLDING &&
        !hci_segment_smooth(sample, s, x->pole_pairs, x->run->turn_known, !flows, &series))
        return false;
    if (s->timed && !series) hci_current_rates_set(sample, s->count, x->pole_pairs);
    for (size_t k = 0; k < s->count; ++k) {
        const hci_sample *from = &sample[k].reading;
        memcpy(sample[k].raw.change_A_per_s, from->change_A_per_s, sizeof from->change_A_per_s);
        memcpy(sample[k].raw.curvature_A_per_s2, from->curvature_A_per_s2, sizeof from->curvature_A_per_s2);
        sample[k].raw.swing_rad_per_s = from->swing_rad_per_s;
    }
    s->smooth = series || stands;
    return segment_add(x->samples, s);
}

/* ---- means over turns ---- */

/* What was measured: the torque, less that of a current that swings, which the means have alike; or in a
 * holding test the current that held against it. */
static double measured_Nm(const reduction *r, const hci_binned_sample *x)
{
    if (r->holding_Nm_per_A != 0.0) return -r->holding_Nm_per_A * hci_sample_dq(&x->reading, r->pole_pairs).q;
    if (r->follows_Nm_per_A == 0.0) return x->torque_Nm;
    return x->torque_Nm - r->follows_Nm_per_A * hci_sample_dq(&x->reading, r->pole_pairs).q;
}

static void mean_add(const reduction *r, hci_binned_sample *c, const hci_binned_sample *x)
{
    const double w = 1.0 / (c->count += 1.0);
    hci_sample *m = &c->reading;
    const double departure = measured_Nm(r, x) - measured_Nm(r, c);
    const double step_rad = c->count > 1.0 ? x->reading.theta_m_rad - m->theta_m_rad : 0.0;
    m->computed_phase = x->reading.computed_phase;
    m->switched_off = x->reading.switched_off;
    c->spread_rad2 = (1.0 - w) * (c->spread_rad2 + w * step_rad * step_rad);
    m->theta_m_rad += w * (x->reading.theta_m_rad - m->theta_m_rad);
    m->speed_rad_per_s += w * (x->reading.speed_rad_per_s - m->speed_rad_per_s);
    m->acceleration_rad_per_s2 += w * (x->reading.acceleration_rad_per_s2 - m->acceleration_rad_per_s2);
    for (int s = 0; s < 3; ++s)
        m->i_abc[s] += w * (x->reading.i_abc[s] - m->i_abc[s]);
    m->temperature_C += w * (x->reading.temperature_C - m->temperature_C);
    m->elapsed_s += w * (x->reading.elapsed_s - m->elapsed_s);
    c->torque_Nm += w * (x->torque_Nm - c->torque_Nm);
    c->scatter_N2m2 += (1.0 - w) * departure * departure;
    c->moment_Nmrad += (1.0 - w) * departure * step_rad;
    c->sum_A += w * (x->sum_A - c->sum_A);
}

/* Means of samples first … last over the turns, by angle. sample: [BINS_PER_TURN]. */
static void means_take(const reduction *x, size_t first, size_t last, hci_binned_sample *sample)
{
    const double turn = hci_turn_rad(x->run, x->pole_pairs);
    memset(sample, 0, BINS_PER_TURN * sizeof *sample);
    for (size_t k = first; k <= last; ++k) {
        hci_binned_sample one;
        sample_of(x, k, &one);
        if (!(one.count > 0.0)) continue;
        one.reading.theta_m_rad -= turn * floor(one.reading.theta_m_rad / turn);
        const size_t at = (size_t)(one.reading.theta_m_rad / turn * BINS_PER_TURN);
        mean_add(x, &sample[at < BINS_PER_TURN ? at : BINS_PER_TURN - 1], &one);
    }
}

/* How many neighbouring bins are joined to one: the orders that are looked for take a few samples a period.
 * None where the current swings beside the turn, since its means are no curve along the angle.
 */
static size_t joined_to_one(const reduction *x)
{
    if (x->follows_Nm_per_A != 0.0) return 1;
    const size_t periods = x->run->turn_known ? (size_t)x->pole_pairs : 1;
    const size_t most = BINS_PER_TURN / (OF_PERIOD * periods);
    const size_t joined = x->many ? MOST_OF_MANY : MOST_JOINED;
    return most < 1 ? 1 : most > joined ? joined : most;
}

/* Adds the mean of a bin to that of others at about the same angle. The currents are joined in the rotor
 * frame, in which they do not turn. */
static void mean_join(const reduction *r, hci_binned_sample *c, const hci_binned_sample *x)
{
    hci_sample *m = &c->reading;
    const hci_dq before = hci_sample_dq(m, r->pole_pairs), other = hci_sample_dq(&x->reading, r->pole_pairs);
    const double count = c->count + x->count, w = x->count / count, rest = 1.0 - w;
    const double departure = measured_Nm(r, x) - measured_Nm(r, c);
    const double step_rad = x->reading.theta_m_rad - m->theta_m_rad;
    const hci_dq i = {rest * before.d + w * other.d, rest * before.q + w * other.q,
                      rest * before.zero + w * other.zero};
    m->theta_m_rad += w * step_rad;
    m->speed_rad_per_s += w * (x->reading.speed_rad_per_s - m->speed_rad_per_s);
    m->acceleration_rad_per_s2 += w * (x->reading.acceleration_rad_per_s2 - m->acceleration_rad_per_s2);
    hci_phases_of_dq(i, r->pole_pairs * m->theta_m_rad, m->i_abc);
    m->temperature_C += w * (x->reading.temperature_C - m->temperature_C);
    m->elapsed_s += w * (x->reading.elapsed_s - m->elapsed_s);
    c->torque_Nm += w * (x->torque_Nm - c->torque_Nm);
    c->sum_A += w * (x->sum_A - c->sum_A);
    c->scatter_N2m2 += x->scatter_N2m2 + rest * w * count * departure * departure;
    c->moment_Nmrad += x->moment_Nmrad + rest * w * count * departure * step_rad;
    c->spread_rad2 = rest * c->spread_rad2 + w * x->spread_rad2 + rest * w * step_rad * step_rad;
    c->count = count;
}

/* Joins so many bins to one, wherever they hold samples. Returns how many of the narrow ones did. */
static size_t bins_join(const reduction *x, hci_binned_sample *sample, size_t most)
{
    size_t filled = 0;
    for (size_t k = 0; k < BINS_PER_TURN; ++k) {
        hci_binned_sample *to = &sample[k / most * most];
        if (!(sample[k].count > 0.0)) continue;
        ++filled;
        if (to == &sample[k]) continue;
        if (to->count > 0.0)
            mean_join(x, to, &sample[k]);
        else
            *to = sample[k];
        sample[k].count = 0.0;
    }
    return filled;
}

/* Sorts the samples along time: against the angle when it falls; then gives them the time of a steady turn.
 * Returns how many are not empty. */
static size_t bins_close(hci_binned_sample *sample, double direction, double turn_rad, double period_s)
{
    size_t kept = 0;
    for (size_t k = 0; k < BINS_PER_TURN; ++k)
        if (sample[k].count > 0.0) sample[kept++] = sample[k];
    for (size_t k = 0; direction < 0.0 && k < kept / 2; ++k) {
        const hci_binned_sample x = sample[k];
        sample[k] = sample[kept - 1 - k];
        sample[kept - 1 - k] = x;
    }
    for (size_t k = 0; k < kept; ++k)
        sample[k].time_s =
            fabs(sample[k].reading.theta_m_rad - sample[0].reading.theta_m_rad) / turn_rad * period_s;
    return kept;
}

/* Takes out of the scatter what the torque does along the angle within a bin, as its neighbours show it. */
static void slopes_leave(const reduction *r, hci_binned_sample *sample, size_t count)
{
    for (size_t k = 1; k + 1 < count; ++k) {
        hci_binned_sample *x = &sample[k];
        const hci_binned_sample *before = x - 1, *behind = x + 1;
        const double slope = (measured_Nm(r, behind) - measured_Nm(r, before)) /
                             (behind->reading.theta_m_rad - before->reading.theta_m_rad);
        const double along = slope * (slope * x->count * x->spread_rad2 - 2.0 * x->moment_Nmrad);
        x->scatter_N2m2 = fmax(0.0, x->scatter_N2m2 + fmin(0.0, along));
    }
}

/* Time of one turn, from samples that do not span whole turns exactly; 0 without time. */
static double period_of(const reduction *x, size_t first, size_t last)
{
    const hci_run *r = x->run;
    const double span_rad = fabs(r->theta_m_rad[last] - r->theta_m_rad[first]);
    return r->time_s ? (r->time_s[last] - r->time_s[first]) * hci_turn_rad(x->run, x->pole_pairs) / span_rad
                     : 0.0;
}

/* Adds the mean over some turns as one segment. */
static bool mean_segment(const reduction *x, const hci_turn *turns, size_t count)
{
    const hci_run *r = x->run;
    const size_t first = turns[0].first, last = turns[count - 1].first + turns[count - 1].count - 1;
    const double period_s = period_of(x, first, last);
    hci_segment s = {x->index, x->samples->count, 0, count, period_s, r->time_s != NULL, false, 1.0};
    hci_binned_sample *sample = reserve(x, BINS_PER_TURN);
    if (!sample) return false;
    means_take(x, first, last, sample);
    const size_t narrow = bins_join(x, sample, joined_to_one(x));
    s.count =
        bins_close(sample, hci_turn_direction(r, first, last), hci_turn_rad(x->run, x->pole_pairs), period_s);
    slopes_leave(x, sample, s.count);
    for (size_t k = 0; k < s.count && x->follows_Nm_per_A != 0.0; ++k)
        sample[k].spread_rad2 = 0.0;
    s.joined = s.count > 0 ? (double)narrow / (double)s.count : 1.0;
    x->samples->count += s.count;
    return segment_finish(x, &s);
}

/* ---- samples as they are ---- */

/* Adds the next sample in time to the mean of those before it. One of a shaft at rest tells no torque, and
 * then the mean does not either. */
static void sample_join(const reduction *x, hci_binned_sample *c, const hci_binned_sample *next)
{
    if (!(c->count > 0.0)) return;
    if (!(next->count > 0.0)) {
        c->count = 0.0;
        return;
    }
    const double time_s = (c->count * c->time_s + next->time_s) / (c->count + 1.0);
    mean_join(x, c, next);
    c->time_s = time_s;
}

/* Samples as they are, or each the mean of so many that follow each other. */
static bool open_segment(const reduction *x, size_t first, size_t count, size_t joined)
{
    const size_t samples = count / joined;
    hci_segment s = {x->index, x->samples->count,      samples, 0,
                     0.0,      x->run->time_s != NULL, false,   (double)joined};
    hci_binned_sample *sample = reserve(x, samples);
    if (!sample) return false;
    for (size_t k = 0; k < samples * joined; ++k) {
        hci_binned_sample one;
        sample_of(x, first + k, &one);
        if (k % joined == 0)
            sample[k / joined] = one;
        else
            sample_join(x, &sample[k / joined], &one);
    }
    x->samples->count += samples;
    return segment_finish(x, &s);
}

/* The angle that the shaft goes by from a sample to the next where it is fastest, by parts of so many
 * samples. */
static double fastest_step_rad(const double *theta, size_t count)
{
    double most = 0.0;
    for (size_t k = 0; k + OF_FASTEST < count; k += OF_FASTEST)
        most = fmax(most, fabs(theta[k + OF_FASTEST] - theta[k]) / OF_FASTEST);
    return most;
}

/* Samples of an electrical period where it is shortest; 0: the shaft does not turn through one. */
static double per_period(const reduction *x, size_t first, size_t count)
{
    const double *theta = x->run->theta_m_rad, period_rad = 2.0 * HCI_PI / x->pole_pairs;
    if (!theta || fabs(theta[first + count - 1] - theta[first]) < period_rad) return 0.0;
    const double step_rad = fastest_step_rad(theta + first, count);
    return step_rad > 0.0 ? period_rad / step_rad : 0.0;
}

/* How many samples that follow each other are joined to one, of a segment that would be cut, and that are
 * finer than the bins of a mean over turns: as fine as these, and as the finest order needs. */
static size_t joined_along(const reduction *x, size_t first, size_t count)
{
    const double finest = PER_PERIOD * x->finest_order / x->pole_pairs;
    const bool may = count > HCI_LONGEST_SEGMENT && x->run->torque_source == HCI_TORQUE_MEASURED &&
                     x->follows_Nm_per_A == 0.0;
    const double joined = may ? per_period(x, first, count) / fmax(OF_PERIOD, finest) : 1.0;
    return joined < 2.0 ? 1 : joined > MOST_ALONG ? MOST_ALONG : (size_t)joined;
}

/* A recording that is not steady and too long for all of it: at most so many parts of it, evenly spread. */
static bool spread_segments(const reduction *x, size_t first, size_t count, size_t most)
{
    const size_t joined = joined_along(x, first, count), longest = joined * HCI_LONGEST_SEGMENT;
    const size_t pieces = (count + longest - 1) / longest;
    const size_t kept = pieces < most ? pieces : most;
    for (size_t k = 0; k < kept; ++k) {
        const size_t piece = pieces * k / kept, length = count / pieces;
        if (!open_segment(x, first + piece * length, length, joined)) return false;
    }
    return true;
}

/* Behind the samples from one on that go one way; a shaft that has gone back by so much has turned round. */
#define TURNED_BACK 0.25 /* electrical turns */

static size_t way_end(const reduction *x, size_t first, size_t end)
{
    const double *theta = x->run->theta_m_rad, back = TURNED_BACK * 2.0 * HCI_PI / x->pole_pairs;
    size_t least = first, most = first;
    for (size_t k = first; k < end; ++k) {
        least = theta[k] < theta[least] ? k : least;
        most = theta[k] > theta[most] ? k : most;
        if (least > first && theta[k] - theta[least] > back) return least + 1;
        if (most > first && theta[most] - theta[k] > back) return most + 1;
    }
    return end;
}

/* An unknown load is one constant for each way of a shaft that is turned slowly: a brake turns its sign round
 * with the motion. */
static bool open_segments(const reduction *x, size_t first, size_t count)
{
    const bool by_way = x->run->torque_source == HCI_TORQUE_HOLDING && x->run->mean_is_unknown;
    for (size_t k = first, next; k < first + count; k = next) {
        next = by_way ? way_end(x, k, first + count) : first + count;
        if (by_way && next - k < LEAST_OF_WAY) continue; /* noise about the turning point */
        if (!spread_segments(x, k, next - k, MOST_OPEN)) return false;
    }
    return true;
}

/* ---- a run ---- */

static size_t behind(const hci_turn *x)
{
    return x->first + x->count;
}

/* Behind the last turn that is like turn k and those after it. */
static size_t alike_end(const reduction *x, const hci_turn *turns, size_t count, size_t k)
{
    size_t next = k + 1;
    while (next < count && hci_turns_alike(x->run, x->statistics, &turns[k], &turns[next]))
        ++next;
    return next;
}

/* Beside a drift that was taken out. */
static bool creep(const reduction *x, const hci_turn *turns, size_t count)
{
    return x->statistics->drift.degree == 0 && hci_turns_creep(x->statistics, turns, count);
}

/* Turns that are alike: one mean, or where the torque creeps along them several, since a mean has no time. */
static bool alike_segments(const reduction *x, const hci_turn *turns, size_t count)
{
    const bool creeps = creep(x, turns, count);
    size_t pieces = creeps ? count / LEAST_TURNS : 1;
    if (pieces > CREEPING_PIECES) pieces = CREEPING_PIECES;
    for (size_t k = 0; k < pieces; ++k) {
        const size_t from = count * k / pieces, until = count * (k + 1) / pieces;
        if (!mean_segment(x, turns + from, until - from)) return false;
    }
    return true;
}

/* Whether behind the turns of a mean there is but a part of one more that is like them. */
static bool is_part_of_next(const reduction *x, const hci_turn *last, size_t rest)
{
    hci_turn part = last[1];
    part.whole = true;
    return part.count == rest && hci_turns_alike(x->run, x->statistics, last, &part);
}

/* Steady turns become a mean, what is between them stays as it is; a short rest behind them is left, and one
 * that tells nothing else. */
static bool turns_reduce(const reduction *x, const hci_turn *turns, size_t count)
{
    size_t open = 0; /* first sample that is not in a segment yet */
    for (size_t k = 0, next; k < count; k = next) {
        next = alike_end(x, turns, count, k);
        if (next - k < LEAST_TURNS) continue;
        if (turns[k].first > open && !open_segments(x, open, turns[k].first - open)) return false;
        if (!alike_segments(x, turns + k, next - k)) return false;
        open = behind(&turns[next - 1]);
    }
    const size_t rest = x->run->count - open;
    const bool is_left =
        open > 0 && (rest <= HCI_LONGEST_SEGMENT || is_part_of_next(x, &turns[count - 2], rest));
    return is_left || open_segments(x, open, rest);
}

/* Turns of a torque that was measured along time, all of them alike but for what is cut off at the ends. */
typedef struct {
    size_t count;          /* 0: they are not */
    size_t first, samples; /* of all of them */
} alike_turns;

static alike_turns alike_find(const reduction *x, const hci_turn *turns, size_t count)
{
    const hci_run *r = x->run;
    size_t first = 0, last = count;
    if (r->torque_source != HCI_TORQUE_MEASURED || !r->time_s) return (alike_turns){0};
    while (first < count && !turns[first].whole)
        ++first;
    while (last > first && !turns[last - 1].whole)
        --last;
    if (last == first || alike_end(x, turns, last, first) < last) return (alike_turns){0};
    return (alike_turns){last - first, turns[first].first, behind(&turns[last - 1]) - turns[first].first};
}

/* Whether all turns are alike, and have so few samples that what is between two of them is seen in other
 * turns only: a sensor that is slow cannot be followed from sample to sample then. */
static bool is_sparse(const reduction *x, const hci_turn *turns, size_t count)
{
    const alike_turns alike = alike_find(x, turns, count);
    return x->run->turn_known && alike.count >= LEAST_SPARSE &&
           (double)alike.samples < PER_PERIOD * x->finest_order * (double)alike.count;
}

/* Whether all turns are alike and show the same, and means over them are far fewer samples. worth: out. False
 * when memory is out. */
static bool means_weigh(const reduction *x, const hci_turn *turns, size_t count, bool *worth)
{
    const alike_turns alike = alike_find(x, turns, count);
    const size_t bins = BINS_PER_TURN / joined_to_one(x);
    *worth = false;
    if (alike.count < LEAST_TURNS || x->run->count < WORTH_MEANS * bins ||
        FINER * alike.samples < bins * alike.count)
        return true;
    return hci_repeats_find(
        &(hci_repeats_question){x->run, x->statistics, x->pole_pairs, alike.first, alike.samples, bins},
        worth);
}

/* The same of many samples, as runs of a few turns have them: there the turn that ends with the run counts as
 * a whole one, where there are means. */
static bool means_weigh_of_many(const reduction *x, hci_turn *turns, size_t count, bool *worth)
{
    bool *whole = count > 0 ? &turns[count - 1].whole : NULL;
    *worth = false;
    if (!x->many || !whole) return true;
    const bool was_whole = *whole;
    *whole = was_whole || turns[count - 1].ends_run;
    const bool done = means_weigh(x, turns, count, worth);
    *whole = *worth ? *whole : was_whole;
    return done;
}

/* Whether the noise is so slow that a mean over the turns would not show what it is; of a run that is not too
 * long to stay as it is. False when memory is out. */
static bool slow_noise_find(const reduction *x, const hci_turn *turns, size_t count, bool *slow)
{
    const alike_turns alike = alike_find(x, turns, count);
    *slow = false;
    if (alike.count < LEAST_TURNS || x->run->count > MOST_SLOW) return true;
    return hci_repeats_slow_noise(&(hci_repeats_question){x->run, x->statistics, x->pole_pairs, alike.first,
                                                          alike.samples, alike.samples / alike.count},
                                  slow);
}

/* Parts of a run whose noise is slow, as many as all runs together have room for, and at least one. */
static bool slow_segments(const reduction *x)
{
    const size_t count = x->run->count, pieces = (count + HCI_LONGEST_SEGMENT - 1) / HCI_LONGEST_SEGMENT;
    const size_t all = x->samples->run_count * (count / pieces);
    const size_t most = (ALL_SLOW + all / 2) / all;
    return spread_segments(x, 0, count, most > 0 ? most : 1);
}

static bool any_creeps(const reduction *x, const hci_turn *turns, size_t count)
{
    for (size_t k = 0, next; k < count; k = next) {
        next = alike_end(x, turns, count, k);
        if (creep(x, turns + k, next - k)) return true;
    }
    return false;
}

/* Of a run that is too long to stay as it is, or too sparse, or worth means. */
static bool long_reduce(const reduction *x, const hci_turn *turns, size_t count)
{
    bool slow = false;
    if (!slow_noise_find(x, turns, count, &slow)) return false;
    if (slow) return slow_segments(x);
    if (hci_turns_swing(x->run, x->statistics, turns, count)) return open_segments(x, 0, x->run->count);
    return turns_reduce(x, turns, count);
}

/* Whether the torque shows that what of the current does not repeat flowed. False when memory is out. */
static bool follows_find(reduction *x, const hci_turn *turns, size_t count)
{
    const alike_turns alike = alike_find(x, turns, count);
    bool follows = false;
    if (alike.count < LEAST_TURNS) return true;
    const hci_repeats_question q = {x->run,      x->statistics, x->pole_pairs,
                                    alike.first, alike.samples, alike.samples / alike.count};
    if (!hci_repeats_follows(&q, x->Nm_per_A, &follows)) return false;
    x->follows_Nm_per_A = follows ? x->Nm_per_A : 0.0;
    return true;
}

static bool run_reduce(reduction *x)
{
    hci_turn *turns = NULL;
    size_t count = 0;
    bool worth = false;
    if (x->run->only_mean) return open_segment(x, 0, x->run->count, 1);
    bool done = hci_turns_find(x->run, x->pole_pairs, &turns, &count);
    done = done && follows_find(x, turns, count);
    if (done) x->samples->statistics[x->index].creeps = any_creeps(x, turns, count);
    if (done && x->run->count <= HCI_LONGEST_SEGMENT) done = means_weigh_of_many(x, turns, count, &worth);
    if (done && x->run->count <= HCI_LONGEST_SEGMENT && !is_sparse(x, turns, count) && !worth)
        done = open_segments(x, 0, x->run->count);
    else
        done = done && long_reduce(x, turns, count);
    hci_memory_free(turns);
    return done;
}

static bool is_usable(const hci_run *run)
{
    return run->torque_Nm && (run->theta_m_rad || run->only_mean) && run->i_A && run->count > 0;
}

static double rms_of(const double *x, size_t count)
{
    double square = 0.0;
    for (size_t k = 0; k < count; ++k)
        square += x[k] * x[k];
    return count > 0 ? sqrt(square / (double)count) : 0.0;
}

/* What the samples are made of, besides the run itself. False when memory is out. */
static bool run_fill(const hci_run *run, hci_run_statistics *statistics, bool *at_rest, double *acceleration)
{
    if (!at_rest || !acceleration) return false;
    if (!is_usable(run)) return true;
    hci_rest_find(run, at_rest);
    if (run->torque_source != HCI_TORQUE_MEASURED || !run->time_s || !run->speed_rad_per_s) return true;
    if (run->count < LEAST_OF_SLOPE) return true;
    hci_run_acceleration(run, acceleration);
    statistics->rms_acceleration = rms_of(acceleration, run->count);
    return true;
}

static double finest_order(const hci_machine *machine)
{
    double finest = 0.0;
    for (size_t k = 0; k < machine->cogging_count; ++k)
        if (hypot(machine->cogging[k].sine, machine->cogging[k].cosine) > 0.0)
            finest = fmax(finest, machine->cogging[k].order);
    return finest * machine->pole_pairs;
}

/* Whether there are many samples, of each run not more than a segment has. */
static bool are_many(const hci_run *runs, size_t count)
{
    size_t sum = 0;
    for (size_t k = 0; k < count; ++k)
        if (is_usable(&runs[k]))
            sum += runs[k].count < HCI_LONGEST_SEGMENT ? runs[k].count : HCI_LONGEST_SEGMENT;
    return sum > MANY;
}

/* Adds run k. False when memory is out. */
static bool run_add(const hci_machine *machine, const hci_run *runs, size_t k, hci_binned_samples *samples,
                    size_t *capacity)
{
    static const hci_effects none = {NULL, 0};
    const hci_run *run = &runs[k];
    hci_run_statistics *statistics = &samples->statistics[k];
    const double Nm_per_A = hci_torque_constant(machine, &none);
    bool *at_rest = hci_memory_new(run->count + 1, sizeof *at_rest);
    double *acceleration = hci_memory_new(run->count + 1, sizeof *acceleration);
    reduction x = {run,
                   k,
                   machine->pole_pairs,
                   finest_order(machine),
                   Nm_per_A,
                   0.0,
                   run->torque_source == HCI_TORQUE_HOLDING ? Nm_per_A : 0.0,
                   statistics,
                   acceleration,
                   at_rest,
                   are_many(runs, samples->run_count),
                   samples,
                   capacity};
    const bool done = run_fill(run, statistics, at_rest, acceleration) && (!is_usable(run) || run_reduce(&x));
    hci_memory_free(acceleration);
    hci_memory_free(at_rest);
    return done;
}

/* Swings of all runs; known: of others, NULL: not yet. False when memory is out. */
static bool swings_fill(const hci_machine *machine, const hci_run *runs, const hci_swing_groups *known,
                        hci_binned_samples *samples)
{
    for (size_t k = 0; k < samples->run_count; ++k) {
        hci_run_statistics *f = &samples->statistics[k];
        const hci_swing_question question = {&runs[k], f, machine};
        const size_t swings = is_usable(&runs[k]) ? hci_swings_find(&question, known, f->swing) : 0;
        if (swings > HCI_MOST_SWINGS) return false;
        f->swings = swings;
    }
    return true;
}

static void drifts_fill(const hci_machine *machine, const hci_run *runs, hci_binned_samples *samples)
{
    static const hci_effects none = {NULL, 0};
    const double Nm_per_A = hci_torque_constant(machine, &none);
    for (size_t k = 0; k < samples->run_count; ++k)
        if (is_usable(&runs[k]))
            samples->statistics[k].drift =
                hci_drift_find(&runs[k], &samples->statistics[k], machine->pole_pairs, Nm_per_A);
    hci_drifts_leave_to_effect(samples->statistics, samples->run_count);
}

/* What is known of the runs before they are reduced. False when memory is out. */
static bool statistics_fill(const hci_machine *machine, double rated_current_A, const hci_run *runs,
                            hci_binned_samples *samples)
{
    for (size_t k = 0; k < samples->run_count; ++k)
        samples->statistics[k] = hci_run_statistics_of(&runs[k], machine->pole_pairs);
    hci_run_statistics_zeros_find(samples->statistics, samples->run_count, rated_current_A);
    drifts_fill(machine, runs, samples);
    if (!swings_fill(machine, runs, NULL, samples)) return false;
    const hci_swing_groups known = hci_swing_groups_find(samples->statistics, samples->run_count);
    return known.count == 0 || swings_fill(machine, runs, &known, samples);
}

hci_status hci_binned_samples_make(const hci_machine *machine, double rated_current_A, const hci_run *runs,
                                   size_t run_count, hci_binned_samples *samples, hci_note *note)
{
    size_t capacity = 0;
    memset(samples, 0, sizeof *samples);
    samples->run_count = run_count;
    samples->statistics = hci_memory_new(run_count + 1, sizeof *samples->statistics);
    bool done = samples->statistics && statistics_fill(machine, rated_current_A, runs, samples);
    for (size_t k = 0; k < run_count && done; ++k)
        done = run_add(machine, runs, k, samples, &capacity);
    if (done) return HCI_OK;
    hci_binned_samples_release(samples);
    return hci_note_memory(note, NULL, "the recordings");
}

void hci_binned_samples_release(hci_binned_samples *samples)
{
    hci_memory_free(samples->sample);
    hci_memory_free(samples->segment);
    hci_memory_free(samples->statistics);
    memset(samples, 0, sizeof *samples);
}

size_t hci_segment_telling(const hci_binned_samples *samples, const hci_segment *s)
{
    size_t telling = 0;
    for (size_t k = s->first; k < s->first + s->count; ++k)
        telling += samples->sample[k].count > 0.0;
    return telling;
}

size_t hci_segment_longest(const hci_binned_samples *samples)
{
    size_t most = 1;
    for (size_t k = 0; k < samples->segment_count; ++k)
        most = samples->segment[k].count > most ? samples->segment[k].count : most;
    return most;
}

const hci_segment *hci_segment_next(const hci_binned_samples *samples, size_t run, const hci_segment *after)
{
    const hci_segment *end = samples->segment + samples->segment_count;
    const hci_segment *s = after ? after + 1 : samples->segment;
    while (s < end && s->run != run)
        ++s;
    return s < end ? s : NULL;
}
