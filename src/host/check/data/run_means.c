#include <math.h>

#include "host/check/data/run_parts.h"
#include "host/numeric/statistics.h"

/* A speed that varies by more than this share of its mean is not steady, and at one above this, in rad/s, the
 * load varies as well as the cogging torque. */
#define STEADY 0.2
#define SLOW   3.0

/* A mean below this share of the rms is that of noise. */
#define MOVING 0.3

/* Whether sample k was taken next to the one before it: there is no other part of the file between them, and
 * no gap of the clock, over which an angle goes on as it likes. */
static bool follows(const check_samples *s, size_t k)
{
    const bool is_gap = s->time && s->gap_s > 0.0 && s->time[k] - s->time[k - 1] > s->gap_s;
    return !is_gap && (!s->follows || s->follows[k]);
}

/* Between samples that are further apart than half a turn whole turns are lost. */
#define COARSE   0.4 /* of a turn, that the speed goes between some samples, and varies by */
#define FOLLOWED 0.1 /* of a turn, rms, by which angle and speed then differ, but for whole turns */

/* The steps of an angle within one turn whose whole turns the speed tells, as it is declared; false: it does
 * not, or does not have to. path: out, their sum. */
static bool follow_speed(const check_samples *s, const check_run *run, double *path)
{
    const double turn = 2.0 * HCI_PI,
                 by = run->is_electrical && !run->speed_is_electrical ? run->declared_pole_pairs : 1.0;
    double least = HUGE_VAL, most = -HUGE_VAL, square = 0.0, count = 0.0;
    *path = 0.0;
    if (!s->speed || !(by > 0.0) || run->angle_range > 1.001 * turn || run->angle_range < 0.9 * turn)
        return false;
    for (size_t k = 1; k < s->count; ++k) {
        if (!follows(s, k)) continue;
        const double told = 0.5 * by * (s->speed[k] + s->speed[k - 1]) * (s->time[k] - s->time[k - 1]);
        const double off = remainder(s->theta[k] - s->theta[k - 1] - told, turn);
        *path += told + off;
        square += off * off;
        count += 1.0;
        least = fmin(least, told), most = fmax(most, told);
    }
    return fmax(fabs(least), fabs(most)) > COARSE * turn && most - least > COARSE * turn &&
           square < FOLLOWED * FOLLOWED * turn * turn * count;
}

/* How far an angle goes over time, in the units of the columns, and the mean of the speed over the same
 * steps. Steps of more than half the range are where the angle was wrapped, whatever a turn is in its unit;
 * they are left out. */
static void rates_take(const check_samples *s, check_run *run)
{
    const size_t n = s->count;
    double path = 0.0, along = 0.0, speed = 0.0, followed = 0.0;
    run->angle_rate = run->speed_over_time = NAN;
    if (!s->theta || !s->time || n < 3) return;
    const bool is_coarse = follow_speed(s, run, &followed);
    if (!is_coarse && hci_check_angle_is_torn(s->theta, n)) return;
    const double most = is_coarse ? HUGE_VAL : 0.5 * run->angle_range;
    for (size_t k = 1; k < n; ++k) {
        const double step_s = s->time[k] - s->time[k - 1];
        if (!follows(s, k) || fabs(s->theta[k] - s->theta[k - 1]) > most) continue;
        path += s->theta[k] - s->theta[k - 1];
        along += step_s;
        if (s->speed) speed += 0.5 * step_s * (s->speed[k] + s->speed[k - 1]);
    }
    if (!(along > 0.0)) return;
    run->angle_rate = (is_coarse ? followed : path) / along;
    if (s->speed) run->speed_over_time = speed / along;
}

/* theta_e over theta_m, by the steps at which neither is wrapped. */
static double ratio_of(const check_samples *s)
{
    const double *e = s->theta, *m = s->other;
    const size_t n = s->count;
    const double most_e = 0.5 * hci_peak_to_peak(e, n), most_m = 0.5 * hci_peak_to_peak(m, n);
    double top = 0.0, bottom = 0.0;
    if (hci_check_angle_is_torn(e, n) || hci_check_angle_is_torn(m, n)) return NAN;
    for (size_t k = 1; k < n; ++k) {
        const double x = m[k] - m[k - 1], y = e[k] - e[k - 1];
        if (!follows(s, k) || fabs(y) > most_e || fabs(x) > most_m) continue;
        top += x * y;
        bottom += x * x;
    }
    return bottom > 0.0 ? top / bottom : (double)NAN;
}

static double mean_square(const check_vector *x, size_t n)
{
    double sum = 0.0;
    for (size_t k = 0; k < n; ++k)
        sum += x[k].re * x[k].re + x[k].im * x[k].im;
    return sum / (double)n;
}

/* How fast a vector turns, by its steps. */
static double frequency_of(const check_samples *s, const check_vector *x)
{
    double sum = 0.0, along = 0.0;
    if (!x || !s->time || s->count < 3) return NAN;
    for (size_t k = 1; k < s->count; ++k) {
        const check_vector step = hci_check_product(x[k], hci_check_conjugate(x[k - 1]));
        if (!follows(s, k)) continue;
        sum += atan2(step.im, step.re);
        along += s->time[k] - s->time[k - 1];
    }
    return along > 0.0 ? sum / along : (double)NAN;
}

/* Alternating rms of the largest over that of the smallest phase. */
static double balance_of(const double *const *column, size_t n)
{
    double least = HUGE_VAL, most = 0.0;
    for (int s = 0; s < 3; ++s) {
        if (!column[s]) return NAN;
        const double square = hci_mean_square_about(column[s], n, hci_mean(column[s], n));
        least = fmin(least, square);
        most = fmax(most, square);
    }
    return least > 0.0 ? sqrt(most / least) : (double)NAN;
}

static double sum_of_phases(const double *const *column, size_t n)
{
    double sum = 0.0, square = 0.0;
    if (!column[0] || !column[1] || !column[2]) return NAN;
    for (size_t k = 0; k < n; ++k) {
        const double a = column[0][k], b = column[1][k], c = column[2][k];
        sum += (a + b + c) * (a + b + c);
        square += a * a + b * b + c * c;
    }
    return square > 0.0 ? sqrt(sum / square) : (double)NAN;
}

/* ---- speed */

static void speed_take(const check_samples *s, check_run *run)
{
    const size_t n = s->count, fifth = n / 5 + 1;
    run->has_speed = s->speed != NULL;
    run->speed = s->speed ? hci_mean(s->speed, n) : (double)NAN;
    run->speed_change = 0.0;
    if (!s->speed) return;
    if (fabs(run->speed) < MOVING * sqrt(hci_mean_square_about(s->speed, n, 0.0))) run->speed = 0.0;
    if (fabs(run->speed) > 0.0)
        run->speed_change = (hci_mean(s->speed + n - fifth, fifth) - hci_mean(s->speed, fifth)) / run->speed;
}

/* Times what i_q varies by, of the mean: it works against a load, and makes a ripple by the back-EMF that a
 * shaft without one has not. */
#define LOAD 4.0

static bool is_loaded(const check_samples *s)
{
    const double mean = hci_mean(s->q, s->count);
    return mean * mean > LOAD * LOAD * hci_mean_square_about(s->q, s->count, mean);
}

static bool turns_steadily(const check_samples *s, const check_run *run)
{
    return !s->torque && s->q && s->theta && s->speed && fabs(run->speed) > 0.0 && fabs(run->speed) < SLOW &&
           !is_loaded(s) &&
           hci_mean_square_about(s->speed, s->count, run->speed) < STEADY * STEADY * run->speed * run->speed;
}

/* ---- torque */

static double torque_at_speed(const check_samples *s, const check_run *run)
{
    double sum = 0.0;
    if (!s->speed || !(fabs(run->speed) > 0.0)) return hci_mean(s->torque, s->count);
    for (size_t k = 0; k < s->count; ++k)
        sum += s->torque[k] * s->speed[k];
    return sum / (double)s->count / run->speed;
}

/* 0 throughout: the shaft was held, and the torque is not a reading. */
static void torque_take(const check_samples *s, check_run *run)
{
    run->has_torque = s->torque && hci_mean_square_about(s->torque, s->count, 0.0) > 0.0;
    run->is_held = s->torque && !run->has_torque && s->q;
    run->turns_steadily = turns_steadily(s, run);
    if (s->torque) run->torque_at_speed = torque_at_speed(s, run);
}

void hci_check_run_ripple(check_run *run)
{
    run->torque_mean = hci_mean(run->torque, run->count);
    run->torque_variance = hci_mean_square_about(run->torque, run->count, run->torque_mean);
}

static check_vector pair_at(const double *d, const double *q, size_t k)
{
    return (check_vector){d ? d[k] : 0.0, q ? q[k] : 0.0};
}

/* A voltage that does not follow the speed, as by a speed without sign, says nothing of it. */
static void voltage_terms_take(const check_samples *s, check_run *run)
{
    double weights = 0.0, weight_square = 0.0, square = 0.0;
    check_voltage_terms sum = {0};
    for (size_t k = 0; k < s->count; ++k) {
        const double speed = s->speed ? s->speed[k] : 1.0;
        const check_vector v = pair_at(s->vd, s->vq, k), i = pair_at(s->d, s->q, k);
        sum.voltage = hci_check_sum(sum.voltage, hci_check_scaled(v, speed));
        sum.current = hci_check_sum(sum.current, hci_check_scaled(i, speed));
        sum.speed_current = hci_check_sum(sum.speed_current, hci_check_scaled(i, speed * speed));
        weights += fabs(speed);
        weight_square += speed * speed;
        square += v.re * v.re + v.im * v.im;
        run->power = hci_check_sum(run->power, hci_check_product(v, hci_check_conjugate(i)));
    }
    const double length = hci_check_length(sum.voltage), share = weights > 0.0 ? 1.0 / weights : 0.0;
    run->dq_voltage_is_coherent = length * length > CHECK_COHERENT * weight_square * square;
    run->voltage_square = square / (double)s->count;
    run->power = hci_check_scaled(run->power, 1.0 / (double)s->count);
    run->terms.voltage = hci_check_scaled(sum.voltage, share);
    run->terms.current = hci_check_scaled(sum.current, share);
    run->terms.speed_current = hci_check_scaled(sum.speed_current, share);
    run->terms.speed = weight_square * share;
}

static bool lacks_d_current(const check_samples *s, const check_run *run)
{
    return !s->d || hci_mean_square_about(s->d, s->count, 0.0) <=
                        CHECK_NO_CURRENT * CHECK_NO_CURRENT * run->current_square;
}

static void dq_take(const check_samples *s, check_run *run)
{
    const size_t n = s->count;
    run->dq = (check_vector){s->d ? hci_mean(s->d, n) : 0.0, hci_mean(s->q, n)};
    run->current_square =
        hci_mean_square_about(s->q, n, 0.0) + (s->d ? hci_mean_square_about(s->d, n, 0.0) : 0.0);
    run->product_dq = 0.0;
    for (size_t k = 0; s->d && k < n; ++k)
        run->product_dq += s->d[k] * s->q[k] / (double)n;
    run->dq_is_steady =
        hci_check_length(run->dq) * hci_check_length(run->dq) > CHECK_COHERENT * run->current_square;
}

static void phases_take(const check_samples *s, check_run *run)
{
    const size_t n = s->count;
    run->frequency = frequency_of(s, s->voltage);
    run->current_sum = sum_of_phases(s->phase, n);
    run->current_balance = balance_of(s->phase, n);
    run->voltage_balance = balance_of(s->volt, n);
    for (size_t k = 0; s->current && s->voltage && k < n; ++k)
        run->power = hci_check_sum(
            run->power, hci_check_scaled(hci_check_product(s->voltage[k], hci_check_conjugate(s->current[k])),
                                         1.0 / (double)n));
}

void hci_check_run_means(const check_samples *s, check_run *run)
{
    const size_t n = s->count;
    run->angle_range = s->theta ? hci_peak_to_peak(s->theta, n) : 0.0;
    rates_take(s, run);
    run->angle_ratio = s->other ? ratio_of(s) : (double)NAN;
    speed_take(s, run);
    torque_take(s, run);
    if (s->q) dq_take(s, run);
    if (s->current) run->current_square = mean_square(s->current, n);
    run->lacks_d_current = lacks_d_current(s, run);
    if (s->voltage) run->voltage_square = mean_square(s->voltage, n);
    if (s->vq) voltage_terms_take(s, run);
    run->current_order = run->voltage_order = NAN;
    phases_take(s, run);
}
