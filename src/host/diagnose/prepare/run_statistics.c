#include "host/diagnose/prepare/run_statistics.h"

#include <math.h>
#include <string.h>

#include "hci/math/harmonic.h"
#include "host/numeric/angle_bins.h"
#include "host/numeric/statistics.h"
#include "host/recording/rotor_frame.h"

#define STANDS       6.0  /* standard errors of a mean, beside which noise is none */
#define ROUNDING_RAD 1e-7 /* a step of angle up to this is none */
#define FREEDOM      100.0
#define LEAST_ARC    0.1  /* electrical turns that a rotor has to be turned by to be at other angles */
#define STEADY       0.05 /* of a direct current, as a share, by which readings of it may vary */
#define ZEROS        0.05 /* of the largest current, that nobody would have left unnoticed as zeros of sensors */
#define COMMON       0.02 /* share of the mean square that neighbours have in common, of a current that flows … */
#define FLOWS        0.5 /* share that so many samples have in common only where one flows */
#define EVEN                                                                                                 \
    0.5 /* of the mean step of angle, by which those of a rotor that was read along its turn differ */
#define CHANCE 3.0 /* … beyond what they have by chance, in standard deviations */

enum {
    LEAST_SAMPLES = 64,
    LEAST_TURNS = 3,
    LEAST_PER_RANGE = 4,
    LEAST_PERIODS = 10,
    MOST_STEPS = 20000,
    ENOUGH = 4096,
    PARTS = 16, /* of an electrical turn */
    FORGOTTEN = 3
};

/* The smallest step between neighbours that is not rounding. */
static double angle_step(const hci_run *r)
{
    const size_t n = r->count < MOST_STEPS ? r->count : MOST_STEPS;
    double least = INFINITY;
    for (size_t k = 1; k < n; ++k) {
        const double step = fabs(r->theta_m_rad[k] - r->theta_m_rad[k - 1]);
        if (step > ROUNDING_RAD) least = fmin(least, step);
    }
    return isfinite(least) ? least : 0.0;
}

/* How much a range's mean torque rises from end to end, from those beside it. */
static double rise_at(const hci_angle_bins *mean, size_t range)
{
    const size_t next = (range + 1) % mean->bins, before = (range + mean->bins - 1) % mean->bins;
    return 0.5 * (hci_angle_bins_mean(mean, next) - hci_angle_bins_mean(mean, before));
}

/* How far a sample is from the mean of those at the same angle in other turns. */
static double repeatability(const hci_run *r, double turns)
{
    hci_angle_bins mean = {.bins = HCI_ANGLE_BINS_MOST}, level = {.bins = HCI_ANGLE_BINS_MOST};
    if (!(turns >= LEAST_TURNS) || r->count < LEAST_PER_RANGE * HCI_ANGLE_BINS_MOST) return NAN;
    for (size_t k = 0; k < r->count; ++k)
        hci_angle_bins_add(&mean, r->theta_m_rad[k] / (2.0 * HCI_PI), r->torque_Nm[k]);
    for (size_t k = 0; k < r->count; ++k) {
        const double x = r->theta_m_rad[k] / (2.0 * HCI_PI), place = HCI_ANGLE_BINS_MOST * (x - floor(x));
        const double rise = rise_at(&mean, hci_angle_bins_at(&mean, x));
        hci_angle_bins_add(&level, x, r->torque_Nm[k] - rise * (place - floor(place) - 0.5));
    }
    return hci_angle_bins_rms(&level, FREEDOM);
}

/* From the least angle to the largest: a map that goes there and back is one turn. */
static double turns_of(const hci_run *r)
{
    double least = r->theta_m_rad[0], most = least;
    for (size_t k = 1; k < r->count; ++k) {
        least = fmin(least, r->theta_m_rad[k]);
        most = fmax(most, r->theta_m_rad[k]);
    }
    return (most - least) / (2.0 * HCI_PI);
}

static void sample_add(const hci_run *r, int pole_pairs, size_t k, hci_run_statistics *f)
{
    const double n = (double)r->count;
    const hci_dq i = hci_run_dq(r, pole_pairs, k);
    const double torque = r->torque_Nm ? r->torque_Nm[k] : 0.0;
    f->mean_torque_Nm += torque / n;
    f->rms_torque_Nm += torque * torque / n;
    f->current_A += (i.d * i.d + i.q * i.q) / n;
    f->mean_id_A += i.d / n;
    f->rms_id_A += i.d * i.d / n;
    f->mean_iq_A += i.q / n;
    const double speed = r->speed_rad_per_s ? r->speed_rad_per_s[k] : 0.0;
    f->mean_speed_rad_per_s += speed / n;
    f->speed_deviation += speed * speed / n;
    if (!r->temperature_C) return;
    f->temperature_C += r->temperature_C[k] / n;
    f->coldest_C = fmin(f->coldest_C, r->temperature_C[k]);
    f->hottest_C = fmax(f->hottest_C, r->temperature_C[k]);
}

/* i_d and i_q of what the phase currents are besides a part that stands still. */
static hci_dq moving_dq(const hci_run *r, int pole_pairs, size_t k, const double standing_A[3])
{
    double i[3];
    for (size_t s = 0; s < 3; ++s)
        i[s] = r->i_A[3 * k + s] - standing_A[s];
    return hci_park(hci_clarke(i), pole_pairs * (r->theta_m_rad ? r->theta_m_rad[k] : 0.0));
}

/* Whether neighbouring rows are neighbours in time: by a clock, or as a rotor that turns one way was read at
 * even steps of its angle. Rows of a table of operating points need not be. */
static bool is_in_order(const hci_run *r)
{
    if (r->time_s) return true;
    if (!r->theta_m_rad || r->count < LEAST_SAMPLES) return false;
    const double steps = (double)(r->count - 1);
    const double mean = (r->theta_m_rad[r->count - 1] - r->theta_m_rad[0]) / steps;
    double square = 0.0;
    for (size_t k = 1; k < r->count; ++k)
        square += pow(r->theta_m_rad[k] - r->theta_m_rad[k - 1] - mean, 2.0);
    return square < EVEN * EVEN * mean * mean * steps;
}

/* The share that currents so many samples apart have in common, besides a standing part; that of the first
 * ones, where they have much. */
static double common_share(const hci_run *r, int pole_pairs, const double standing_A[3], size_t apart)
{
    double common = 0.0, square = 0.0;
    for (size_t k = apart; k < r->count; ++k) {
        const hci_dq i = moving_dq(r, pole_pairs, k, standing_A);
        const hci_dq before = moving_dq(r, pole_pairs, k - apart, standing_A);
        common += i.d * before.d + i.q * before.q;
        square += i.d * i.d + i.q * i.q;
        if (k % ENOUGH == 0 && common > FLOWS * square) break;
    }
    return square > 0.0 ? common / square : 1.0;
}

/* A part of an electrical turn, in samples: noise that was filtered is forgotten behind it, and a current
 * that flows is much the same. */
static size_t part_of_turn(const hci_run *r, int pole_pairs)
{
    const double way_rad = r->theta_m_rad ? pole_pairs * hci_peak_to_peak(r->theta_m_rad, r->count) : 0.0;
    return way_rad > 0.0 ? (size_t)((double)r->count * 2.0 * HCI_PI / (way_rad * PARTS)) : 0;
}

/* Whether the current besides a standing part is nothing but noise: white, so that neighbours have nothing in
 * common, while a current that flows is much the same from one sample to the next; or filtered, so that
 * samples a part of a turn apart have not. In a holding test the current is what was measured. */
static bool is_noise(const hci_run *r, int pole_pairs, const double standing_A[3])
{
    const double chance = COMMON + CHANCE / sqrt(2.0 * (double)r->count);
    if (r->count < LEAST_SAMPLES || r->torque_source == HCI_TORQUE_HOLDING || !is_in_order(r)) return false;
    if (common_share(r, pole_pairs, standing_A, 1) < chance) return true;
    const size_t part = part_of_turn(r, pole_pairs);
    for (size_t n = 1; n <= FORGOTTEN && part > 1; ++n)
        if (!(fabs(common_share(r, pole_pairs, standing_A, n * part)) < chance)) return false;
    return part > 1;
}

/* Means of the phase currents, and whether one is far above what the scatter of as many samples makes of it.
 */
static bool means_find(const hci_run *r, double mean_A[3])
{
    double square_A2[3] = {0.0};
    bool any = false;
    for (size_t k = 0; k < 3 * r->count; ++k) {
        mean_A[k % 3] += r->i_A[k] / (double)r->count;
        square_A2[k % 3] += r->i_A[k] * r->i_A[k] / (double)r->count;
    }
    for (size_t s = 0; s < 3; ++s)
        any = any || mean_A[s] * mean_A[s] * (double)r->count > STANDS * STANDS * square_A2[s];
    return any;
}

/* Means of the phase currents of a shaft that turns: of a sine they are next to nothing in so many periods.
 * What else was read may be noise: then they are what flowed, or zeros of sensors. Where all is noise, they
 * are that where they stand out of it. */
static void standing_find(const hci_run *r, int pole_pairs, hci_run_statistics *f)
{
    double mean_A[3] = {0.0};
    if (!(f->turns * pole_pairs >= LEAST_PERIODS)) return;
    const bool stands_out = means_find(r, mean_A);
    if (f->no_current && !stands_out) return;
    memcpy(f->standing_A, mean_A, sizeof mean_A);
    f->stands = f->no_current || is_noise(r, pole_pairs, mean_A);
}

/* Whether each phase current is the same at all angles of the rotor, of which there are more than a few. */
static bool is_direct(const hci_run *r, int pole_pairs, double turns)
{
    double sum[3] = {0.0}, square[3] = {0.0}, varies = 0.0, whole = 0.0;
    if (!(turns * pole_pairs > LEAST_ARC)) return false;
    for (size_t k = 0; k < 3 * r->count; ++k) {
        sum[k % 3] += r->i_A[k];
        square[k % 3] += r->i_A[k] * r->i_A[k];
    }
    for (size_t s = 0; s < 3; ++s) {
        varies += square[s] - sum[s] * sum[s] / (double)r->count;
        whole += square[s];
    }
    return whole > 0.0 && varies < STEADY * STEADY * whole;
}

/* Of a shaft without a torque sensor both ways are one test, which is read as a whole. */
static bool goes_both_ways(const hci_run *r, int pole_pairs)
{
    const double turn_rad = 2.0 * HCI_PI / pole_pairs;
    double least = INFINITY, most = -INFINITY, ahead_rad = 0.0, back_rad = 0.0;
    if (r->torque_source != HCI_TORQUE_MEASURED || !r->speed_rad_per_s || !r->theta_m_rad) return false;
    for (size_t k = 0; k < r->count; ++k) {
        least = fmin(least, r->theta_m_rad[k]);
        most = fmax(most, r->theta_m_rad[k]);
        ahead_rad = fmax(ahead_rad, r->theta_m_rad[k] - least);
        back_rad = fmax(back_rad, most - r->theta_m_rad[k]);
    }
    return ahead_rad > turn_rad && back_rad > turn_rad;
}

static void pace_find(const hci_run *r, int pole_pairs, hci_run_statistics *f)
{
    double mean = 0.0, square = 0.0;
    f->both_ways = goes_both_ways(r, pole_pairs);
    f->pace_rad_per_s = fabs(f->mean_speed_rad_per_s);
    f->pace_deviation = f->speed_deviation;
    for (size_t k = 0; f->both_ways && k < r->count; ++k) {
        mean += fabs(r->speed_rad_per_s[k]) / (double)r->count;
        square += r->speed_rad_per_s[k] * r->speed_rad_per_s[k] / (double)r->count;
    }
    if (!f->both_ways) return;
    f->pace_rad_per_s = mean;
    f->pace_deviation = sqrt(fmax(0.0, square - mean * mean));
}

hci_run_statistics hci_run_statistics_of(const hci_run *r, int pole_pairs)
{
    hci_run_statistics f = {.repeat_Nm = NAN, .temperature_C = NAN, .coldest_C = NAN, .hottest_C = NAN};
    if (r->count == 0 || !(r->theta_m_rad || r->only_mean) || !r->i_A) return f;
    if (r->temperature_C) f.temperature_C = 0.0;
    for (size_t k = 0; k < r->count; ++k)
        sample_add(r, pole_pairs, k, &f);
    f.rms_torque_Nm = sqrt(f.rms_torque_Nm);
    f.current_A = sqrt(f.current_A);
    f.rms_id_A = sqrt(f.rms_id_A);
    f.speed_deviation = sqrt(fmax(0.0, f.speed_deviation - f.mean_speed_rad_per_s * f.mean_speed_rad_per_s));
    pace_find(r, pole_pairs, &f);
    f.no_current = is_noise(r, pole_pairs, f.standing_A);
    f.is_loaded = !f.no_current && hci_run_is_loaded(r, pole_pairs);
    if (f.no_current) f.current_A = f.mean_id_A = f.mean_iq_A = f.rms_id_A = 0.0;
    if (r->only_mean) return f;
    f.angle_step_rad = angle_step(r);
    f.turns = turns_of(r);
    standing_find(r, pole_pairs, &f);
    f.is_direct = !f.no_current && is_direct(r, pole_pairs, f.turns);
    if (r->torque_Nm) f.repeat_Nm = repeatability(r, f.turns);
    return f;
}

/* ---- beside each other ---- */

static double largest_of(const double x[3])
{
    return fmax(fabs(x[0]), fmax(fabs(x[1]), fabs(x[2])));
}

void hci_run_statistics_zeros_find(hci_run_statistics *statistics, size_t runs, double rated_current_A)
{
    double most_A = fmax(0.0, rated_current_A);
    for (size_t r = 0; r < runs; ++r)
        most_A = fmax(most_A, statistics[r].current_A);
    for (size_t r = 0; r < runs; ++r) {
        hci_run_statistics *f = &statistics[r];
        f->zeros_read = f->stands && largest_of(f->standing_A) <= ZEROS * most_A;
        f->is_loaded = f->is_loaded && !f->zeros_read;
    }
}
