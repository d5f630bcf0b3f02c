#include "host/recording/speed_variation.h"

#include <math.h>
#include <string.h>

#include "hci/math/harmonic.h"
#include "host/base/memory.h"
#include "host/numeric/derivative.h"
#include "host/recording/clock.h"

#define SAME_PACE 2.0  /* mean speeds of neighbouring windows within this factor */
#define PAUSE     0.2  /* of the mean speed of the run */
#define GOES      0.5  /* of it, with which a shaft that stood goes on */
#define ENOUGH    0.2  /* of the samples */
#define OTHER     0.01 /* of the rows, whose speed has the other sign */

enum { LEAST = 16 };

/* The mean over the window around a sample. */
static double mean_speed(const hci_run *run, size_t k, size_t half)
{
    return (run->theta_m_rad[k + half] - run->theta_m_rad[k - half]) /
           (run->time_s[k + half] - run->time_s[k - half]);
}

/* Whether the window beside this one, where there is one, has its direction and its pace. */
static bool goes_on(const hci_run *run, size_t beside, size_t half, double speed)
{
    if (beside < half || beside >= run->count - half) return true; /* one before 0 is beyond the end */
    const double ratio = mean_speed(run, beside, half) / speed;
    return ratio > 1.0 / SAME_PACE && ratio < SAME_PACE;
}

static double mean_pace(const double *rate, size_t count)
{
    double sum = 0.0;
    for (size_t k = 0; k < count; ++k)
        sum += fabs(rate[k]);
    return sum / (double)count;
}

/* Half of the samples of half an electrical turn; at most an eighth of the run. */
static size_t half_window(const hci_run *run, int pole_pairs, double pace)
{
    const double step_s = (run->time_s[run->count - 1] - run->time_s[0]) / (double)(run->count - 1);
    const double samples = 0.5 * HCI_PI / (pole_pairs * pace * step_s);
    return samples < (double)(run->count / 8) ? (size_t)samples + 1 : run->count / 8;
}

static double share_of(const hci_run *run, const double *rate, int pole_pairs)
{
    const double pace = mean_pace(rate, run->count);
    if (!(pace > 0.0)) return 0.0;
    const size_t half = half_window(run, pole_pairs, pace);
    double sum = 0.0, used = 0.0;
    for (size_t k = half; k + half < run->count; ++k) {
        const double mean = mean_speed(run, k, half);
        if (!(fabs(mean) > PAUSE * pace) || !goes_on(run, k - 2 * half, half, mean) ||
            !goes_on(run, k + 2 * half, half, mean))
            continue;
        sum += (rate[k] / mean - 1.0) * (rate[k] / mean - 1.0);
        used += 1.0;
    }
    return used > ENOUGH * (double)run->count ? sqrt(sum / used) : 0.0;
}

/* The same run over stamps that are smoothed. work: twice its samples, which it then uses. */
static void make_even(hci_run *run, double *work)
{
    hci_note unused = {{0}};
    memcpy(work, run->time_s, run->count * sizeof *work);
    run->time_s = work;
    hci_clock_smooth((hci_stamps){work, run->row, run->count}, work + run->count, &unused);
}

bool hci_speed_variation(const hci_run *run, int pole_pairs, double *share)
{
    *share = 0.0;
    if (run->time_s == NULL || run->theta_m_rad == NULL || run->count < LEAST) return true;
    if (run->rough_clock && run->speed_rad_per_s != NULL && run->speed_window == 0) {
        *share = share_of(run, run->speed_rad_per_s, pole_pairs);
        return true;
    }
    double *rate = hci_memory_new(run->count, 3 * sizeof *rate);
    if (rate == NULL) return false;
    hci_run even = *run;
    if (run->rough_clock) make_even(&even, rate + run->count);
    hci_derivative(even.time_s, run->theta_m_rad, run->count, rate);
    *share = share_of(&even, rate, pole_pairs);
    hci_memory_free(rate);
    return true;
}

/* ---- stops on the way ---- */

#define STOP_TURNS 0.05 /* electrical, over which the speed is looked at at its mean pace */

static int sign_of(double x)
{
    return (x > 0.0) - (x < 0.0);
}

size_t hci_speed_stops(const hci_run *run, int pole_pairs, double *path_turns)
{
    const double *x = run->theta_m_rad;
    size_t stops = 0;
    int before = 0;
    bool stands = false;
    *path_turns = 0.0;
    if (run->time_s == NULL || x == NULL || run->count < LEAST) return 0;
    for (size_t k = 0; k + 1 < run->count; ++k)
        *path_turns += fabs(x[k + 1] - x[k]) * pole_pairs / (2.0 * HCI_PI);
    const double samples = 0.5 * STOP_TURNS * (double)run->count / *path_turns;
    if (!(samples < (double)(run->count / 8))) return 0;
    const size_t half = (size_t)samples + 1;
    const double pace_rad = STOP_TURNS * 2.0 * HCI_PI / pole_pairs;
    for (size_t k = half; k + half < run->count; ++k) {
        const double way_rad = x[k + half] - x[k - half];
        if (fabs(way_rad) < PAUSE * pace_rad) stands = true;
        if (fabs(way_rad) < GOES * pace_rad) continue;
        stops += stands && sign_of(way_rad) == before;
        stands = false;
        before = sign_of(way_rad);
    }
    return stops;
}

size_t hci_speed_sign_changes(const double *x, size_t count)
{
    size_t changes = 0;
    int before = 0;
    for (size_t k = 0; k < count; ++k) {
        const int sign = sign_of(x[k]);
        if (sign * before < 0) ++changes;
        before = sign ? sign : before;
    }
    return changes;
}

/* Rows in which a speed has the other sign than the slope of the angle; 0 where it does not go with the
 * angle. */
static size_t turned_about(const hci_run *run, const double *slope)
{
    const double *speed = run->speed_rad_per_s;
    size_t other = 0;
    double along = 0.0;
    for (size_t k = 0; k < run->count; ++k) {
        other += sign_of(speed[k]) * sign_of(slope[k]) < 0;
        along += speed[k] * sign_of(slope[k]);
    }
    return along > 0.0 ? other : 0;
}

bool hci_speed_sign_is_noise(const hci_run *run, const double *slope)
{
    const size_t other = turned_about(run, slope);
    return other > 0 && (double)other >= OTHER * (double)run->count &&
           hci_speed_sign_changes(run->speed_rad_per_s, run->count) >=
               HCI_SPEED_SIGN_CHANGES * (hci_speed_sign_changes(slope, run->count) + 1);
}

size_t hci_speed_sign_mend(hci_run *run, const double *slope)
{
    const size_t other = turned_about(run, slope);
    const bool is_few = (double)other < OTHER * (double)run->count;
    if (!is_few ||
        hci_speed_sign_changes(run->speed_rad_per_s, run->count) <= hci_speed_sign_changes(slope, run->count))
        return 0;
    for (size_t k = 0; k < run->count; ++k)
        if (sign_of(run->speed_rad_per_s[k]) * sign_of(slope[k]) < 0) run->speed_rad_per_s[k] = slope[k];
    return other;
}

/* ---- of a shaft whose torque was measured ---- */

void hci_run_acceleration(const hci_run *run, double *rate_rad_per_s2)
{
    const double *t = run->time_s, *speed = run->speed_rad_per_s;
    const size_t window = run->speed_window > 0 && run->theta_m_rad
                              ? hci_derivative_window_of_slope(t, run->theta_m_rad, speed, run->count)
                              : hci_derivative_window(t, speed, run->count);
    hci_derivative_over(t, speed, run->count, window, rate_rad_per_s2);
}
