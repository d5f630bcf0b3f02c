#include <math.h>
#include <stdlib.h>

#include "host/check/data/run_samples.h"

/* What does not turn so far cannot be told from what stands still. The range of the recorded angle counts:
 * where it was wrapped, other scales than those with a whole number of turns in it are torn. */
#define LEAST_TURN (1.5 * HCI_PI)

static void frame_take(const check_samples *s, check_frame *f)
{
    const double share = 1.0 / (double)s->count;
    for (size_t k = 0; k < s->count; ++k) {
        const double angle = f->scale * s->theta[k];
        for (int way = CHECK_FORWARD; way <= CHECK_BACKWARD; ++way) {
            const check_vector back =
                hci_check_turned((check_vector){share, 0.0}, way == CHECK_FORWARD ? -angle : angle);
            if (s->current)
                f->current[way] = hci_check_sum(f->current[way], hci_check_product(s->current[k], back));
            if (s->voltage)
                f->voltage[way] = hci_check_sum(f->voltage[way], hci_check_product(s->voltage[k], back));
        }
    }
}

/* Scale and sequence at which a vector turns with the recorded angle; NAN where it is coherent with none of
 * those at which it would have turned at all. */
static double order_of(const check_run *run, size_t scales, bool of_current, double square)
{
    double best = CHECK_COHERENT * square, order = NAN;
    for (size_t k = 0; k < scales; ++k)
        for (int way = CHECK_FORWARD; way <= CHECK_BACKWARD; ++way) {
            const check_frame *f = &run->frame[k];
            if (f->scale * run->angle_range < LEAST_TURN) continue;
            const double length = hci_check_length(of_current ? f->current[way] : f->voltage[way]);
            if (!(length * length > best)) continue;
            best = length * length;
            order = way == CHECK_FORWARD ? f->scale : -f->scale;
        }
    return order;
}

/* ---- orders that no interpretation asks for */

/* Share of the square of a vector that turns with the mechanical angle n times as fast, or against it:
 * whatever its sign, as its square turns twice as fast. */
static double coherence(const check_samples *s, const check_vector *x, double scale)
{
    check_vector sum = {0.0, 0.0};
    double square = 0.0;
    for (size_t k = 0; k < s->count; ++k) {
        const check_vector y = hci_check_product(x[k], x[k]);
        sum = hci_check_sum(sum, hci_check_turned(y, -2.0 * scale * s->theta[k]));
        square += x[k].re * x[k].re + x[k].im * x[k].im;
    }
    return square > 0.0 ? hci_check_length(sum) / square : 0.0;
}

/* The order, negative against the angle; NAN: none. */
static double scan(const check_samples *s, const check_run *run, const check_vector *x)
{
    double best = CHECK_COHERENT, order = NAN;
    for (int n = -CHECK_MOST_PAIRS; x && n <= CHECK_MOST_PAIRS; ++n) {
        if (n == 0 || abs(n) * run->angle_range < LEAST_TURN) continue;
        const double share = coherence(s, x, n);
        if (share > best) order = n;
        best = fmax(best, share);
    }
    return order;
}

/* How far a vector turns by its steps over the angle, which a gear makes no whole number; NAN: not at all. */
static double slope(const check_samples *s, const check_run *run, const check_vector *x)
{
    double turned = 0.0, gone = 0.0;
    for (size_t k = 1; x && k < s->count; ++k) {
        const double step = s->theta[k] - s->theta[k - 1];
        const check_vector turn = hci_check_product(x[k], hci_check_conjugate(x[k - 1]));
        if ((s->follows && !s->follows[k]) || fabs(step) > 0.5 * run->angle_range) continue;
        turned += atan2(turn.im, turn.re);
        gone += step;
    }
    const double order = turned / gone;
    if (!x || !isfinite(order) || fabs(turned) < LEAST_TURN) return NAN;
    return coherence(s, x, order) > CHECK_COHERENT ? order : (double)NAN;
}

static double scan_or_slope(const check_samples *s, const check_run *run, const check_vector *x)
{
    const double order = scan(s, run, x);
    return isfinite(order) ? order : slope(s, run, x);
}

/* A mechanical angle counts the electrical turns in it. */
static void count_turns(const check_samples *s, check_run *run)
{
    check_frame *own = &run->frame[CHECK_SCALES];
    run->current_is_steady = isfinite(run->current_order);
    if (run->is_electrical || isfinite(run->voltage_order)) return;
    if (!run->current_is_steady) run->current_order = scan_or_slope(s, run, s->current);
    run->voltage_order = scan_or_slope(s, run, s->voltage);
    const double order = isfinite(run->current_order) ? run->current_order : run->voltage_order;
    if (!isfinite(order)) return;
    own->scale = fabs(order);
    frame_take(s, own);
    const double length = hci_check_length(own->current[order < 0.0 ? CHECK_BACKWARD : CHECK_FORWARD]);
    if (!run->current_is_steady)
        run->current_is_steady = length * length > CHECK_COHERENT * run->current_square;
}

void hci_check_run_frames(const check_data *data, const check_samples *s, check_run *run)
{
    for (size_t k = 0; k < data->scales; ++k) {
        run->frame[k].scale = data->scale[k];
        frame_take(s, &run->frame[k]);
    }
    run->current_order = s->current ? order_of(run, data->scales, true, run->current_square) : (double)NAN;
    run->voltage_order = s->voltage ? order_of(run, data->scales, false, run->voltage_square) : (double)NAN;
    count_turns(s, run);
}

const check_frame *hci_check_frame_of(const check_run *run, double scale)
{
    for (size_t k = 0; run->theta && k <= CHECK_SCALES; ++k)
        if (fabs(run->frame[k].scale / fabs(scale) - 1.0) < 1e-9) return &run->frame[k];
    return NULL;
}

static check_vector torque_order(const check_run *run, double order)
{
    check_vector sum = {0.0, 0.0};
    const double share = 2.0 / (double)run->count;
    for (size_t k = 0; k < run->count; ++k) {
        const double x = share * (run->torque[k] - run->torque_mean);
        sum.re += x * sin(order * run->theta[k]);
        sum.im += x * cos(order * run->theta[k]);
    }
    return sum;
}

check_vector hci_check_torque_order(check_run *run, double order)
{
    const size_t kept = run->cached_count < CHECK_CACHED_ORDERS ? run->cached_count : CHECK_CACHED_ORDERS;
    for (size_t k = 0; k < kept; ++k)
        if (fabs(run->cached[k].order - order) <= 1e-12 * fabs(order)) return run->cached[k].wave;
    check_cached_order *next = &run->cached[run->cached_count++ % CHECK_CACHED_ORDERS];
    *next = (check_cached_order){order, torque_order(run, order)};
    return next->wave;
}
