#include "host/recording/turn_ways.h"

#include <math.h>
#include <string.h>

#include "hci/math/harmonic.h"
#include "host/base/memory.h"
#include "host/numeric/statistics.h"
#include "host/numeric/synchronous_average.h"
#include "host/recording/rotor_frame.h"

/* Electrical orders that are looked at; turns are put together until they bear them, since a multiple of an
 * order stands in the time too. */
#define ORDER_MOST 60.0

/* Speeds of one direction differ by less. */
#define STEADY_SHARE 0.1

/* As orders of a waveform are kept: of all orders noise makes one in so many recordings, of three errors. */
#define FALSE_SHARE 0.01
#define TIMES_ERROR 3.0

/* Of the steps of an encoder, what is seen of a movement that comes back in each turn: the pattern in which
 * samples fall on steps comes back too. */
#define OF_STEP   0.1
#define LEAST_RAD 1e-9

#define LEAST_SLOPE 0.1 /* of the mean: ten times the mean speed is no turn that control holds */

enum { TIME, CURRENT, CHANNELS, MOST_PARTS = 64, HIGHEST_MOST = 2000, POINTS_PER_ORDER = 4 };

/* Samples first … end − 1 go one way. */
typedef struct {
    size_t first, end;
    int direction;
    double pace_s; /* per radian, signed */
} part;

typedef struct {
    const hci_run *run;
    int pole_pairs;
    part list[MOST_PARTS];
    size_t parts, count; /* count: samples in them */
    double *angle_rad, *value;
} path;

/* ---- parts of the way ---- */

/* Without what is near its ends; what does not go round is left out. */
static void push(path *p, size_t first, size_t end, int direction)
{
    const double *theta = p->run->theta_m_rad, half = HCI_PI / p->pole_pairs;
    const double from = theta[first], to = theta[end - 1];
    while (first < end && fabs(theta[first] - from) < half)
        ++first;
    while (end > first && fabs(theta[end - 1] - to) < half)
        --end;
    if (end - first < 3 || fabs(theta[end - 1] - theta[first]) < 2.0 * half) return;
    if (p->parts < MOST_PARTS) p->list[p->parts] = (part){first, end, direction, 0.0};
    ++p->parts;
    p->count += end - first;
}

/* Whether there are any, and no more than can be kept. */
static bool find_parts(path *p)
{
    const double *theta = p->run->theta_m_rad, half = HCI_PI / p->pole_pairs;
    size_t start = 0, extreme = 0;
    int direction = 0;
    for (size_t k = 1; k < p->run->count; ++k) {
        const double way = theta[k] - theta[extreme];
        if (direction * way > 0.0) {
            extreme = k;
        } else if (fabs(way) > half) {
            if (direction != 0) push(p, start, extreme + 1, direction);
            start = extreme;
            direction = way > 0.0 ? 1 : -1;
            extreme = k;
        }
    }
    if (direction != 0) push(p, start, p->run->count, direction);
    return p->parts > 0 && p->parts <= MOST_PARTS;
}

/* Slope of the time over the angle by least squares. */
static double pace_of(const hci_run *run, const part *a)
{
    const double count = (double)(a->end - a->first);
    double t = 0.0, x = 0.0, xx = 0.0, tx = 0.0;
    for (size_t k = a->first; k < a->end; ++k) {
        t += (run->time_s[k] - run->time_s[a->first]) / count;
        x += (run->theta_m_rad[k] - run->theta_m_rad[a->first]) / count;
    }
    for (size_t k = a->first; k < a->end; ++k) {
        const double dx = run->theta_m_rad[k] - run->theta_m_rad[a->first] - x;
        xx += dx * dx;
        tx += dx * (run->time_s[k] - run->time_s[a->first] - t);
    }
    return tx / xx;
}

/* The speed of a direction by all its parts, 0 without one; false where they differ. */
static bool speed_of(path *p, int direction, double *speed_rad_per_s)
{
    double least = INFINITY, most = 0.0, way = 0.0, time_s = 0.0;
    *speed_rad_per_s = 0.0;
    for (size_t j = 0; j < p->parts; ++j) {
        part *a = &p->list[j];
        if (a->direction != direction) continue;
        a->pace_s = pace_of(p->run, a);
        least = fmin(least, fabs(a->pace_s));
        most = fmax(most, fabs(a->pace_s));
        way += p->run->theta_m_rad[a->end - 1] - p->run->theta_m_rad[a->first];
        time_s += p->run->time_s[a->end - 1] - p->run->time_s[a->first];
    }
    if (most > 0.0) *speed_rad_per_s = way / time_s;
    return !(most > (1.0 + STEADY_SHARE) * least);
}

/* ---- orders ---- */

/* Time less that of a steady speed, and i_q, over the angle. */
static void fill(path *p, double scale)
{
    size_t n = 0;
    for (size_t j = 0; j < p->parts; ++j) {
        const part *a = &p->list[j];
        for (size_t k = a->first; k < a->end; ++k, ++n) {
            const double way = p->run->theta_m_rad[k] - p->run->theta_m_rad[a->first];
            p->angle_rad[n] = scale * p->run->theta_m_rad[k];
            p->value[CHANNELS * n + TIME] = p->run->time_s[k] - p->run->time_s[a->first] - a->pace_s * way;
            p->value[CHANNELS * n + CURRENT] = hci_run_dq(p->run, p->pole_pairs, k).q;
        }
    }
}

static size_t turn_order(const path *p, double scale, double electrical)
{
    const double order = electrical * p->pole_pairs / scale + 0.5;
    return order < HIGHEST_MOST ? (size_t)order : HIGHEST_MOST;
}

static hci_status fit(path *p, double scale, hci_average *average)
{
    const hci_average_orders orders = {turn_order(p, scale, ORDER_MOST), turn_order(p, scale, ORDER_MOST),
                                       turn_order(p, scale, 1.0)};
    fill(p, scale);
    const hci_average_samples samples = {p->angle_rad, p->value, p->count, CHANNELS};
    return hci_average_fit(&samples, &orders, average);
}

static hci_way_wave wave_of(const hci_average *average, size_t channel, size_t k)
{
    const hci_order_estimate e = hci_average_estimate(average, channel, k);
    const double chance = hci_average_chance(average, channel, k) * (double)average->highest;
    const bool stands_out =
        chance < FALSE_SHARE && hypot(e.mean.sine, e.mean.cosine) > TIMES_ERROR * e.std_error;
    return (hci_way_wave){e.mean.sine, e.mean.cosine, e.std_error, k > 0 && stands_out};
}

/* t′ by the angle of the turn, and t″. */
static double slope_at(const hci_turn_ways *ways, const hci_way *way, double phi, double *bend_out)
{
    double slope = 1.0 / (ways->scale * way->speed_rad_per_s), bend = 0.0;
    for (size_t j = 0; j < way->count; ++j) {
        const hci_way_wave *w = &way->order[way->seen[j]].time_s;
        if (!w->stands_out) continue;
        const double n = (double)way->seen[j], sine = sin(n * phi), cosine = cos(n * phi);
        slope += n * (w->sine * cosine - w->cosine * sine);
        bend -= n * n * (w->sine * sine + w->cosine * cosine);
    }
    *bend_out = bend;
    return slope;
}

double hci_way_acceleration(const hci_turn_ways *ways, const hci_way *way, double theta_m_rad)
{
    double bend;
    const double slope = slope_at(ways, way, ways->scale * theta_m_rad, &bend);
    return -bend / (slope * slope * slope) / ways->scale;
}

/* Whether the time is one at each angle: a shaft that sticks goes back a little, or stands and jumps. */
static bool goes_on(const hci_turn_ways *ways, const hci_way *way)
{
    const size_t points = way->any ? POINTS_PER_ORDER * ways->highest : 0;
    for (size_t j = 0; j < points; ++j) {
        double bend;
        const double slope = slope_at(ways, way, 2.0 * HCI_PI * (double)j / (double)points, &bend);
        if (slope * ways->scale * way->speed_rad_per_s < LEAST_SLOPE) return false;
    }
    return true;
}

/* The orders of the acceleration over one turn. */
static void set_acceleration(const hci_turn_ways *ways, hci_way *way)
{
    const size_t points = POINTS_PER_ORDER * ways->highest;
    for (size_t j = 0; j < points; ++j) {
        const double phi = 2.0 * HCI_PI * (double)j / (double)points;
        const double share = 2.0 / (double)points * hci_way_acceleration(ways, way, phi / ways->scale);
        for (size_t k = 0; k < way->count; ++k) {
            hci_way_order *o = &way->order[way->seen[k]];
            o->alpha_sine += share * sin((double)way->seen[k] * phi);
            o->alpha_cosine += share * cos((double)way->seen[k] * phi);
        }
    }
}

static void take_orders(const hci_average *one, double resolution_rad, hci_way *way)
{
    const double least_s = resolution_rad / fabs(way->speed_rad_per_s);
    for (size_t k = 0; k <= one->highest; ++k) {
        hci_way_order *o = &way->order[k];
        o->time_s = wave_of(one, TIME, k);
        o->iq_A = wave_of(one, CURRENT, k);
        o->time_s.stands_out = o->time_s.stands_out && hypot(o->time_s.sine, o->time_s.cosine) > least_s;
        if (o->time_s.stands_out || o->iq_A.stands_out) way->seen[way->count++] = k;
    }
}

static hci_status take_way(const hci_average *average, int direction, hci_turn_ways *ways, hci_way *way)
{
    hci_average one;
    const hci_status status = hci_average_of_direction(average, direction, &one);
    if (status) return status;
    way->any = one.count > 0 && fabs(way->speed_rad_per_s) > 0.0;
    way->order = hci_memory_new(ways->highest + 1, sizeof *way->order);
    way->seen = hci_memory_new(ways->highest + 1, sizeof *way->seen);
    const bool has_room = way->order != NULL && way->seen != NULL;
    if (way->any && has_room) {
        take_orders(&one, ways->resolution_rad, way);
        set_acceleration(ways, way);
    }
    hci_average_release(&one);
    return has_room ? HCI_OK : HCI_ERROR_MEMORY;
}

/* By mechanical turns where the angle knows them, else by electrical ones. */
static hci_status take_turns(path *p, hci_turn_ways *ways)
{
    hci_average average;
    ways->scale = p->run->turn_known ? 1.0 : p->pole_pairs;
    hci_status status = fit(p, ways->scale, &average);
    if (status) return status;
    ways->highest = average.highest;
    const double *theta = p->run->theta_m_rad;
    ways->resolution_rad = OF_STEP * fmax(hci_quantum(theta, p->run->count, LEAST_RAD),
                                          hci_step_of_counts(theta, p->run->count));
    for (int d = 0; d < 2 && !status; ++d)
        status = take_way(&average, d == 0 ? 1 : -1, ways, &ways->way[d]);
    hci_average_release(&average);
    return status;
}

static hci_status find(path *p, hci_turn_ways *ways)
{
    p->angle_rad = hci_memory_new(p->count, sizeof *p->angle_rad);
    p->value = hci_memory_new(CHANNELS * p->count, sizeof *p->value);
    const hci_status status =
        p->angle_rad != NULL && p->value != NULL ? take_turns(p, ways) : HCI_ERROR_MEMORY;
    hci_memory_free(p->angle_rad);
    hci_memory_free(p->value);
    return status;
}

hci_status hci_turn_ways_find(const hci_run *run, int pole_pairs, hci_turn_ways *ways, bool *found)
{
    path p = {.run = run, .pole_pairs = pole_pairs};
    memset(ways, 0, sizeof *ways);
    *found = false;
    if (run->theta_m_rad == NULL || run->time_s == NULL || !find_parts(&p)) return HCI_OK;
    if (!speed_of(&p, 1, &ways->way[0].speed_rad_per_s) || !speed_of(&p, -1, &ways->way[1].speed_rad_per_s))
        return HCI_OK;
    const hci_status status = find(&p, ways);
    *found = !status && (ways->way[0].any || ways->way[1].any) && goes_on(ways, &ways->way[0]) &&
             goes_on(ways, &ways->way[1]);
    if (!*found) hci_turn_ways_release(ways);
    return status == HCI_ERROR_SINGULAR ? HCI_OK : status;
}

void hci_turn_ways_release(hci_turn_ways *ways)
{
    for (int d = 0; d < 2; ++d) {
        hci_memory_free(ways->way[d].order);
        hci_memory_free(ways->way[d].seen);
    }
    memset(ways, 0, sizeof *ways);
}
