/* References for a current loop on a microcontroller: what the files that `hci-solve emit --drive` write
 * need, beside hci/table.h.
 *
 * A loop does not follow a current that changes quickly. What it should be asked for depends on the speed,
 * and each order of the table by itself. So the orders stand in flash, and tables over the angle are made of
 * them in RAM: at start-up, and again when the speed has changed. Four remedies:
 *
 *     HCI_LOOP_TABLE         i*(θ) as it is
 *     HCI_LOOP_LEAD          i*(θ + ω·lead)
 *     HCI_LOOP_COMPENSATION  each order divided by what the loop makes of it, disturbances included
 *     HCI_LOOP_FEEDFORWARD   i*(θ), and the voltage that it needs, at the angle at which the PWM acts
 *
 * ω is electrical, in rad/s. Angles are uint32_t: 2^32 is period_turns electrical turns. Quadratic splines
 * over the angle; between levels of the torque parabolas through three of them. Each order has a speed at
 * which it ends, where the voltage or the sampling does not do for it any more, and fades out on the way
 * there.
 *
 * Needs <stdint.h> alone: no libm, no heap, no double arithmetic. hci_loop_at is meant for interrupts; the
 * functions that make tables for the background. C99 and C++. */
#ifndef HCI_LOOP_H
#define HCI_LOOP_H

#include "hci/table.h"

/* Version of the layout below; emitted files refuse to compile with another one. */
#define HCI_LOOP_VERSION 2

/* The most points of a table in RAM: sizes and angles then fit 32 bits. */
#define HCI_LOOP_TABLE_MOST_POINTS 65536u

/* Coordinates of one order: c cos(kφ) + s sin(kφ), φ the angle in the table's own period. */
typedef struct {
    float c, s; /* of the cosine and of the sine */
} hci_loop_pair;

/* One order at one level of torque: d and q of each quantity, rotor frame, amplitude-invariant. */
typedef struct {
    hci_loop_pair current_A[2];  /* i* */
    hci_loop_pair voltage_Vs[2]; /* terminal voltage by ω, but for R i*: d(L i*)/dθ + e */
    hci_loop_pair own_Vs[2];     /* what the drive's own decoupling adds at i*, by ω */
} hci_loop_wave;

/* Measured answers of a loop at one frequency: 1/(C H) = (1/G − F)/(R + jνL) up to the ripple between
 * samples, F the filter of the measured current: what is to be asked for on top of F i* for each volt that it
 * lacks. */
typedef struct {
    float frequency_rad_per_s; /* ascending, > 0 */
    float re[2], im[2];        /* d and q, A/V */
} hci_loop_response;

/* The speeds |ω| at which an order is used: whole up to one, less and less up to the other. */
typedef struct {
    float whole_rad_per_s; /* up to which it is whole */
    float none_rad_per_s;  /* from which on nothing is left */
} hci_loop_range;

/* Currents, voltages and the loop that has to make them, as `hci-solve emit --drive` writes it: constant, in
 * flash. */
typedef struct {
    const hci_loop_wave *waves;         /* order_count·levels, the levels of an order together */
    const uint16_t *orders;             /* whole multiples of base_order, ascending; the first is 0 */
    const hci_loop_range *ranges;       /* of the speed, one for each order */
    const hci_loop_response *responses; /* not used without entries: k_p and k_i say what the loop does */
    uint32_t order_count;               /* >= 1 */
    uint32_t response_count;            /* entries of responses: 0, or at least 2 */
    uint32_t levels;                    /* of torque, equally far apart: 1, 2, or an odd number */
    uint32_t points;                    /* of a table in RAM, in its own period */
    uint32_t repeats;                   /* periods of the table in 2^32 of angle */
    uint32_t period_turns;              /* electrical turns in 2^32 of angle */
    float base_order;                   /* electrical order of the multiple 1: repeats/period_turns */
    float torque_low_Nm;                /* of the first level */
    float torque_high_Nm;        /* of the last level; what is outside is clamped, so one level is what it
                                  * is whatever is asked for */
    float resistance_ohm;        /* of a phase */
    float inductance_H[2];       /* L_d, L_q */
    float proportional_ohm[2];   /* k_p of d and q */
    float integral_ohm_per_s[2]; /* k_i of both */
    float filter;                /* share of a new reading in what the PI sees; 0: no filter */
    float sample_s;              /* from one sample to the next */
    float delay_s;               /* from a sample to the middle of its voltage's use */
    float whole_rad_per_s;       /* |ω| below which nothing fades */
    float lead_s;                /* delay of the loop at low frequency */
    uint32_t crc32;              /* of the waves */
} hci_loop_f32;

/* What is done about the loop. */
typedef enum {
    HCI_LOOP_TABLE,        /* nothing */
    HCI_LOOP_LEAD,         /* the table is read ahead */
    HCI_LOOP_COMPENSATION, /* the reference is corrected order by order */
    HCI_LOOP_FEEDFORWARD   /* the voltage is given too */
} hci_loop_remedy;

/* Tables in RAM, and how they were made. Two of them let one be made while the other is in use. */
typedef struct {
    const hci_loop_f32 *loop; /* in flash */
    hci_loop_remedy remedy;   /* that they are for */
    float made_rad_per_s;     /* ω that they are for */
    float *factors;           /* of the orders at that speed: workspace */
    float *current;           /* rows of levels·2 values */
    float *voltage;           /* rows of levels·4 values, with HCI_LOOP_FEEDFORWARD; else not used */
} hci_loop_tables;

/* What the loop is asked for. */
typedef struct {
    float id_A, iq_A; /* reference currents at the angle of the sample */
    float vd_V, vq_V; /* to be added to the output of the controller, in the same axes */
} hci_loop_reference;

/* ---- arithmetic ---- */

/* sin(x)/x for |x| <= π/2, to 3e-7. */
static inline float hci_loop_sinc(float x)
{
    const float y = x * x;
    return 1.0f - y * (0.166666667f - y * (8.33333333e-3f -
                                           y * (1.98412698e-4f - y * (2.75573192e-6f - y * 2.50521084e-8f))));
}

/* |x|. */
static inline float hci_loop_size(float x)
{
    return x < 0.0f ? -x : x;
}

/* A pair is the complex number c − js, so that its order is Re((c − js) e^(jkφ)). The product with re +
 * j·im. */
static inline hci_loop_pair hci_loop_times(hci_loop_pair x, float re, float im)
{
    hci_loop_pair y;
    y.c = x.c * re + x.s * im;
    y.s = x.s * re - x.c * im;
    return y;
}

/* x + factor·y. */
static inline hci_loop_pair hci_loop_plus(hci_loop_pair x, float factor, hci_loop_pair y)
{
    x.c += factor * y.c;
    x.s += factor * y.s;
    return x;
}

/* ---- one order at one speed ---- */

/* What all levels of an order share. */
typedef struct {
    float nu_rad_per_s;         /* frequency in the rotor frame, signed like the speed */
    float half;                 /* ν T/2 */
    float share;                /* what fading leaves of it */
    float ahead_re, ahead_im;   /* e^(jν·delay) */
    float straight, crossed;    /* 1/sinc of the held voltage, mean and half difference of both sequences */
    float image;                /* 1/sinc² − 1 */
    float filter_re, filter_im; /* what the filter of the measured current makes of it */
} hci_loop_order;

/* What is left of an order at a speed. */
static inline float hci_loop_share(hci_loop_range range, float speed_rad_per_s)
{
    const float speed = hci_loop_size(speed_rad_per_s);
    if (!(speed > range.whole_rad_per_s)) return 1.0f;
    if (!(speed < range.none_rad_per_s)) return 0.0f;
    return (range.none_rad_per_s - speed) / (range.none_rad_per_s - range.whole_rad_per_s);
}

/* The hold turns with the stator: one order in the rotor frame is held at ν + ω and at ν − ω. */
static inline void hci_loop_hold(const hci_loop_f32 *loop, float speed_rad_per_s, hci_loop_order *order)
{
    const float turn = 0.5f * speed_rad_per_s * loop->sample_s;
    const float ahead = 1.0f / hci_loop_sinc(order->half + turn);
    const float behind = 1.0f / hci_loop_sinc(order->half - turn);
    const float sinc = hci_loop_sinc(order->half);
    order->straight = 0.5f * (ahead + behind);
    order->crossed = 0.5f * (ahead - behind);
    order->image = 1.0f / (sinc * sinc) - 1.0f;
}

/* F = f/(1 − (1 − f) e^(−jνT)). */
static inline void hci_loop_filter(const hci_loop_f32 *loop, hci_loop_order *order)
{
    const float left = 1.0f - loop->filter;
    float s, c, re, im, scale;
    order->filter_re = 1.0f;
    order->filter_im = 0.0f;
    if (!(loop->filter > 0.0f) || !(left > 0.0f)) return;
    hci_angle_sine_cosine(hci_angle_from_rad(order->nu_rad_per_s * loop->sample_s), &s, &c);
    re = 1.0f - left * c;
    im = left * s;
    scale = loop->filter / (re * re + im * im);
    order->filter_re = scale * re;
    order->filter_im = -scale * im;
}

/* The order number k at a speed. */
static inline hci_loop_order hci_loop_order_at(const hci_loop_f32 *loop, uint32_t k, float speed_rad_per_s)
{
    hci_loop_order order;
    order.nu_rad_per_s = HCI_TABLE_F32(loop->orders[k]) * loop->base_order * speed_rad_per_s;
    order.half = 0.5f * order.nu_rad_per_s * loop->sample_s;
    order.share = hci_loop_share(loop->ranges[k], speed_rad_per_s);
    if (!(order.share > 0.0f)) order.half = 0.0f;
    hci_angle_sine_cosine(hci_angle_from_rad(order.nu_rad_per_s * loop->delay_s), &order.ahead_im,
                          &order.ahead_re);
    hci_loop_hold(loop, speed_rad_per_s, &order);
    hci_loop_filter(loop, &order);
    return order;
}

/* The voltage that is to be commanded so that x is held on average, but for the delay. x, y: d and q. */
static inline void hci_loop_held(const hci_loop_order *order, const hci_loop_pair x[2], hci_loop_pair y[2])
{
    const hci_loop_pair d = x[0], q = x[1]; /* D' = a D + jb Q, Q' = a Q − jb D */
    y[0] = hci_loop_plus(hci_loop_times(q, 0.0f, order->crossed), order->straight, d);
    y[1] = hci_loop_plus(hci_loop_times(d, 0.0f, -order->crossed), order->straight, q);
}

/* What samples read where i* is meant: a held voltage makes ripple between the samples, which they see as
 * this much more of the order, image·v/(jνL); and of that what the filter lets through. */
static inline hci_loop_pair hci_loop_sampled(const hci_loop_f32 *loop, const hci_loop_order *order, int axis,
                                             hci_loop_pair current, hci_loop_pair voltage)
{
    if (order->image > 0.0f)
        current = hci_loop_plus(
            current, 1.0f,
            hci_loop_times(voltage, 0.0f, -order->image / (order->nu_rad_per_s * loop->inductance_H[axis])));
    return hci_loop_times(current, order->filter_re, order->filter_im);
}

/* 1/C(ν) of the sampled controller, C = k_p − k_i T/2 − j (k_i T/2) cot(ν T/2). */
static inline hci_loop_pair hci_loop_through_control(const hci_loop_f32 *loop, const hci_loop_order *order,
                                                     int axis, hci_loop_pair x)
{
    const float held = 0.5f * loop->integral_ohm_per_s[axis] * loop->sample_s;
    const float sinc = hci_loop_sinc(order->half), y = order->half * order->half;
    const float cosine = 1.0f - y * (0.5f - y * (4.16666667e-2f - y * (1.38888889e-3f - y * 2.48015873e-5f)));
    /* times x = ν T/2, so that nothing is infinite at a standstill: 1/C = x/(x re − j im) */
    const float re = (loop->proportional_ohm[axis] - held) * order->half, im = held * cosine / sinc;
    const float square = re * re + im * im;
    const float scale = square > 0.0f ? order->half / square : 0.0f;
    if (!(held > 0.0f) && loop->proportional_ohm[axis] > 0.0f) /* nothing sees to the mean */
        return hci_loop_times(x, 1.0f / loop->proportional_ohm[axis], 0.0f);
    return hci_loop_times(x, re * scale, im * scale);
}

/* 1/(C H) as it was measured, at a frequency: straight between its points, from 0 at a standstill, where the
 * integral of the drive sees to it, to the first one, and as at the last one above. */
static inline hci_loop_pair hci_loop_measured(const hci_loop_f32 *loop, float nu_rad_per_s, int axis,
                                              hci_loop_pair x)
{
    const hci_loop_response *r = loop->responses;
    const float nu = hci_loop_size(nu_rad_per_s), sign = nu_rad_per_s < 0.0f ? -1.0f : 1.0f;
    uint32_t k = 0u;
    float way;
    if (nu < r[0].frequency_rad_per_s) {
        way = nu / r[0].frequency_rad_per_s;
        return hci_loop_times(x, way * r[0].re[axis], sign * way * r[0].im[axis]);
    }
    while (k + 2u < loop->response_count && r[k + 1u].frequency_rad_per_s < nu)
        ++k;
    way = (nu - r[k].frequency_rad_per_s) / (r[k + 1u].frequency_rad_per_s - r[k].frequency_rad_per_s);
    way = way > 1.0f ? 1.0f : way;
    return hci_loop_times(x, r[k].re[axis] + way * (r[k + 1u].re[axis] - r[k].re[axis]),
                          sign * (r[k].im[axis] + way * (r[k + 1u].im[axis] - r[k].im[axis])));
}

/* 1/C of a measured loop: its hold, which the voltage x has been through backwards, taken out again. */
static inline hci_loop_pair hci_loop_through_response(const hci_loop_f32 *loop, const hci_loop_order *order,
                                                      int axis, hci_loop_pair x)
{
    const float sinc = hci_loop_sinc(order->half);
    x = hci_loop_times(x, sinc * order->ahead_re, -sinc * order->ahead_im);
    return hci_loop_measured(loop, order->nu_rad_per_s, axis, x);
}

/* Reference current of one order and level with HCI_LOOP_COMPENSATION. */
static inline void hci_loop_compensated(const hci_loop_f32 *loop, const hci_loop_order *order,
                                        const hci_loop_wave *wave, float speed_rad_per_s,
                                        hci_loop_pair out[2])
{
    hci_loop_pair needed[2], held[2];
    int a;
    for (a = 0; a < 2; ++a)
        needed[a] = hci_loop_plus(hci_loop_times(wave->current_A[a], loop->resistance_ohm, 0.0f),
                                  speed_rad_per_s, wave->voltage_Vs[a]);
    hci_loop_held(order, needed, held);
    for (a = 0; a < 2; ++a) {
        out[a] = hci_loop_plus(hci_loop_times(held[a], order->ahead_re, order->ahead_im), -speed_rad_per_s,
                               wave->own_Vs[a]);
        out[a] = loop->response_count > 0u ? hci_loop_through_response(loop, order, a, out[a])
                                           : hci_loop_through_control(loop, order, a, out[a]);
        out[a] = hci_loop_plus(out[a], 1.0f, hci_loop_sampled(loop, order, a, wave->current_A[a], needed[a]));
    }
}

/* Reference current and voltage of one order and level with HCI_LOOP_FEEDFORWARD. The voltage is read at the
 * angle at which it acts; the drive's own decoupling belongs to that of the sample. out: i_d, i_q, then d and
 * q of the part that does not grow with ω, and of that which does. */
static inline void hci_loop_fed(const hci_loop_f32 *loop, const hci_loop_order *order,
                                const hci_loop_wave *wave, float speed_rad_per_s, hci_loop_pair out[6])
{
    hci_loop_pair ohmic[2];
    int a;
    for (a = 0; a < 2; ++a)
        ohmic[a] = hci_loop_times(wave->current_A[a], loop->resistance_ohm, 0.0f);
    for (a = 0; a < 2; ++a)
        out[a] = hci_loop_sampled(loop, order, a, wave->current_A[a],
                                  hci_loop_plus(ohmic[a], speed_rad_per_s, wave->voltage_Vs[a]));
    hci_loop_held(order, ohmic, out + 2);
    hci_loop_held(order, wave->voltage_Vs, out + 4);
    for (a = 0; a < 2; ++a)
        out[4 + a] = hci_loop_plus(out[4 + a], -1.0f,
                                   hci_loop_times(wave->own_Vs[a], order->ahead_re, -order->ahead_im));
}

/* ---- tables in RAM ---- */

/* Rows of a table: one before and two after its points, so that reading it does not wrap. */
static inline uint32_t hci_loop_rows(const hci_loop_f32 *loop)
{
    return loop->points + 3u;
}

/* Values of a row at one level: currents, and with HCI_LOOP_FEEDFORWARD the two parts of the voltage. */
static inline uint32_t hci_loop_values(hci_loop_remedy remedy)
{
    return remedy == HCI_LOOP_FEEDFORWARD ? 6u : 2u;
}

/* Floats of RAM that tables for a remedy need. */
static inline uint32_t hci_loop_floats(const hci_loop_f32 *loop, hci_loop_remedy remedy)
{
    return (2u * loop->order_count + hci_loop_rows(loop)) * loop->levels * hci_loop_values(remedy);
}

/* Gives tables their memory: hci_loop_floats of them, which is not checked here. For orders that were loaded
 * (hci/loop_blob.h) compare that number with the memory that there is. They are to be made before they are
 * read. */
static inline void hci_loop_start(hci_loop_tables *tables, const hci_loop_f32 *loop, hci_loop_remedy remedy,
                                  float *memory)
{
    tables->loop = loop;
    tables->remedy = remedy;
    tables->made_rad_per_s = 0.0f;
    tables->factors = memory;
    tables->current = memory + 2u * loop->order_count * loop->levels * hci_loop_values(remedy);
    tables->voltage = tables->current + 2u * hci_loop_rows(loop) * loop->levels;
}

/* What the order k is multiplied by so that the spline through its coefficients has its values:
 * 8/(6 + 2 cos(2πk/points)). */
static inline float hci_loop_prefilter(const hci_loop_f32 *loop, uint32_t k)
{
    float s, c;
    hci_angle_sine_cosine(HCI_TABLE_U32((HCI_TABLE_U64(loop->orders[k]) << 32) / loop->points), &s, &c);
    return 8.0f / (6.0f + 2.0f * c);
}

/* One order and level for a remedy. The speed is that of the tables. out: current, and voltage where it is
 * fed. */
static inline void hci_loop_make_wave(const hci_loop_tables *tables, const hci_loop_order *order,
                                      const hci_loop_wave *wave, hci_loop_pair out[6])
{
    out[0] = wave->current_A[0];
    out[1] = wave->current_A[1];
    if (tables->remedy == HCI_LOOP_COMPENSATION)
        hci_loop_compensated(tables->loop, order, wave, tables->made_rad_per_s, out);
    if (tables->remedy == HCI_LOOP_FEEDFORWARD)
        hci_loop_fed(tables->loop, order, wave, tables->made_rad_per_s, out);
}

/* The orders at a speed, first half of making tables: some hundred instructions for each order and level. */
static inline void hci_loop_make_factors(hci_loop_tables *tables, float speed_rad_per_s)
{
    const hci_loop_f32 *loop = tables->loop;
    const uint32_t values = hci_loop_values(tables->remedy);
    float *factor = tables->factors;
    uint32_t k, l, v;
    tables->made_rad_per_s = speed_rad_per_s;
    for (k = 0u; k < loop->order_count; ++k) {
        const hci_loop_order order = hci_loop_order_at(loop, k, speed_rad_per_s);
        const float scale = order.share * hci_loop_prefilter(loop, k);
        for (l = 0u; l < loop->levels; ++l) {
            hci_loop_pair out[6];
            hci_loop_make_wave(tables, &order, &loop->waves[k * loop->levels + l], out);
            for (v = 0u; v < values; ++v) {
                factor[0] = scale * out[v].c;
                factor[1] = scale * out[v].s;
                factor = &factor[2];
            }
        }
    }
}

/* Adds one order, whose cosine and sine at a row are given, to the row. */
static inline void hci_loop_add_order(const hci_loop_tables *tables, const float *factor, uint32_t row,
                                      float cosine, float sine)
{
    const uint32_t levels = tables->loop->levels, values = hci_loop_values(tables->remedy);
    uint32_t l, v;
    for (l = 0u; l < levels; ++l) {
        float *current = tables->current + (row * levels + l) * 2u;
        float *voltage = tables->voltage + (row * levels + l) * 4u;
        for (v = 0u; v < values; ++v) {
            const float sum = factor[0] * cosine + factor[1] * sine;
            if (v < 2u)
                current[v] += sum;
            else
                voltage[v - 2u] += sum;
            factor = &factor[2];
        }
    }
}

/* Row `row` < hci_loop_rows, second half: so that the background can make some at a time. */
static inline void hci_loop_make_row(const hci_loop_tables *tables, uint32_t row)
{
    const hci_loop_f32 *loop = tables->loop;
    const uint32_t n = loop->levels * hci_loop_values(tables->remedy);
    const uint32_t at = (row + loop->points - 1u) % loop->points;
    const uint32_t step = 0xFFFFFFFFu / loop->points + 1u; /* from one point to the next, to 1e-6 of a turn */
    uint32_t k;
    for (k = 0u; k < loop->levels * 2u; ++k)
        tables->current[row * loop->levels * 2u + k] = 0.0f;
    for (k = 0u; tables->remedy == HCI_LOOP_FEEDFORWARD && k < loop->levels * 4u; ++k)
        tables->voltage[row * loop->levels * 4u + k] = 0.0f;
    for (k = 0u; k < loop->order_count; ++k) {
        float s, c;
        hci_angle_sine_cosine((loop->orders[k] * at) % loop->points * step, &s, &c);
        hci_loop_add_order(tables, tables->factors + 2u * k * n, row, c, s);
    }
}

/* Tables for a speed, all at once. */
static inline void hci_loop_make(hci_loop_tables *tables, float speed_rad_per_s)
{
    uint32_t row;
    hci_loop_make_factors(tables, speed_rad_per_s);
    for (row = 0u; row < hci_loop_rows(tables->loop); ++row)
        hci_loop_make_row(tables, row);
}

/* Whether the speed is so far from that of the tables that they should be made again: by 1/64 of it,
 * near a standstill of an eighth of where the first order fades. Tables that do not depend on the speed
 * never are. */
static inline int hci_loop_is_old(const hci_loop_tables *tables, float speed_rad_per_s)
{
    const float speed = hci_loop_size(speed_rad_per_s);
    const float least = 0.125f * tables->loop->whole_rad_per_s;
    const float off = hci_loop_size(speed_rad_per_s - tables->made_rad_per_s);
    if (tables->remedy < HCI_LOOP_COMPENSATION && speed < tables->loop->whole_rad_per_s &&
        hci_loop_size(tables->made_rad_per_s) < tables->loop->whole_rad_per_s)
        return 0;
    return off > 0.015625f * (speed > least ? speed : least);
}

/* ---- reading them ---- */

/* What a torque takes of which levels. */
typedef struct {
    uint32_t first, count; /* levels */
    float weight[3];       /* of each */
} hci_loop_mix;

/* The parabola through three levels, whose middle one is `middle`. u: from it, in steps of the levels. */
static inline hci_loop_mix hci_loop_parabola(uint32_t middle, float u)
{
    hci_loop_mix mix;
    mix.first = middle - 1u;
    mix.count = 3u;
    mix.weight[0] = 0.5f * u * (u - 1.0f);
    mix.weight[1] = 1.0f - u * u;
    mix.weight[2] = 0.5f * u * (u + 1.0f);
    return mix;
}

/* Whether a torque is a number, or none is among the levels, as which NaN counts. */
static inline int hci_loop_is_asked(const hci_loop_f32 *loop, float torque_Nm)
{
    return (torque_Nm > 0.0f) || (torque_Nm <= 0.0f) ||
           ((loop->torque_low_Nm <= 0.0f) && (loop->torque_high_Nm >= 0.0f));
}

/* A torque within that of the levels. NaN counts as none. */
static inline float hci_loop_torque(const hci_loop_f32 *loop, float torque_Nm)
{
    float t = 0.0f;
    if ((torque_Nm > 0.0f) || (torque_Nm <= 0.0f)) t = torque_Nm;
    if (t < loop->torque_low_Nm) t = loop->torque_low_Nm;
    if (t > loop->torque_high_Nm) t = loop->torque_high_Nm;
    return t;
}

/* Parabolas meet at levels, so that currents do not jump. Where NaN is asked for and none is not among the
 * levels, nothing is taken of any. */
static inline hci_loop_mix hci_loop_mix_of(const hci_loop_f32 *loop, float torque_Nm)
{
    const float range = loop->torque_high_Nm - loop->torque_low_Nm;
    const uint32_t last = loop->levels - 1u;
    hci_loop_mix mix = {0u, 1u, {1.0f, 0.0f, 0.0f}};
    float x;
    uint32_t panel, middle;
    if (!hci_loop_is_asked(loop, torque_Nm)) mix.weight[0] = 0.0f;
    if ((last == 0u) || !(mix.weight[0] > 0.0f)) return mix;
    x = (hci_loop_torque(loop, torque_Nm) - loop->torque_low_Nm) / range;
    if (last == 1u) {
        mix.count = 2u;
        mix.weight[0] = 1.0f - x;
        mix.weight[1] = x;
        return mix;
    }
    x *= HCI_TABLE_F32(last);
    panel = HCI_TABLE_U32(0.5f * x);
    if (2u * panel >= last) panel = last / 2u - 1u;
    middle = 2u * panel + 1u;
    return hci_loop_parabola(middle, x - HCI_TABLE_F32(middle));
}

/* `columns` values of a table at an angle: quadratic B-spline over three rows, then the levels. */
static inline void hci_loop_read(const hci_loop_f32 *loop, const float *rows, uint32_t columns,
                                 uint32_t angle, const hci_loop_mix *mix, float *out)
{
    const uint64_t position = HCI_TABLE_U64(angle * loop->repeats) * loop->points + 0x80000000u;
    const uint32_t stride = loop->levels * columns;
    const float t = HCI_TABLE_F32(HCI_TABLE_U32(position)) * 2.32830644e-10f - 0.5f; /* 2^-32 */
    const float before = 0.5f * (0.5f - t) * (0.5f - t), after = 0.5f * (0.5f + t) * (0.5f + t);
    const float *row = rows + HCI_TABLE_U32(position >> 32) * stride + mix->first * columns;
    uint32_t l, v;
    for (v = 0u; v < columns; ++v)
        out[v] = 0.0f;
    for (l = 0u; l < mix->count; ++l) {
        for (v = 0u; v < columns; ++v)
            out[v] += mix->weight[l] * (row[stride + v] + before * (row[v] - row[stride + v]) +
                                        after * (row[2u * stride + v] - row[stride + v]));
        row = &row[columns];
    }
}

/* An angle turned on by ω·seconds. */
static inline uint32_t hci_loop_ahead(const hci_loop_f32 *loop, uint32_t angle, float way_rad)
{
    return angle + hci_angle_from_rad(way_rad / HCI_TABLE_F32(loop->period_turns));
}

/* What the loop is to be asked for at a sample. angle: of the sample; speed_rad_per_s: electrical. On a
 * Cortex-M4F 170 instructions with one level of torque, 290 with HCI_LOOP_FEEDFORWARD; may run in an
 * interrupt. */
static inline hci_loop_reference hci_loop_at(const hci_loop_tables *tables, uint32_t angle, float torque_Nm,
                                             float speed_rad_per_s)
{
    const hci_loop_f32 *loop = tables->loop;
    const hci_loop_mix mix = hci_loop_mix_of(loop, torque_Nm);
    const float speed = hci_loop_size(speed_rad_per_s) < 1e9f ? speed_rad_per_s : 0.0f; /* nor a NaN */
    hci_loop_reference out = {0.0f, 0.0f, 0.0f, 0.0f};
    float current[2], voltage[4], lead = 0.0f;
    if (tables->remedy == HCI_LOOP_LEAD) lead = speed * loop->lead_s;
    if (tables->remedy == HCI_LOOP_COMPENSATION) lead = (speed - tables->made_rad_per_s) * loop->lead_s;
    hci_loop_read(loop, tables->current, 2u, hci_loop_ahead(loop, angle, lead), &mix, current);
    out.id_A = current[0];
    out.iq_A = current[1];
    if (tables->remedy != HCI_LOOP_FEEDFORWARD) return out;
    hci_loop_read(loop, tables->voltage, 4u, hci_loop_ahead(loop, angle, speed * loop->delay_s), &mix,
                  voltage);
    out.vd_V = voltage[0] + speed * voltage[2];
    out.vq_V = voltage[1] + speed * voltage[3];
    return out;
}

/* ---- check at start-up ---- */

/* CRC-32 of all waves, as of hci_table_f32_crc32. For start-up. */
static inline uint32_t hci_loop_crc32(const hci_loop_f32 *loop)
{
    const uint32_t count = loop->order_count * loop->levels * 6u;
    uint32_t crc = 0xFFFFFFFFu;
    uint32_t k;
    for (k = 0u; k < count; ++k) {
        const hci_loop_wave *wave = &loop->waves[k / 6u];
        const uint32_t part = k % 6u;
        const hci_loop_pair *pair = part < 2u   ? &wave->current_A[part]
                                    : part < 4u ? &wave->voltage_Vs[part - 2u]
                                                : &wave->own_Vs[part - 4u];
        crc = hci_table_f32_crc32_next(crc, pair->c);
        crc = hci_table_f32_crc32_next(crc, pair->s);
    }
    return ~crc;
}

/* Shape and CRC. Call it once at start-up, and do not run the motor unless it says HCI_TABLE_GOOD. */
static inline hci_table_verdict hci_loop_check(const hci_loop_f32 *loop)
{
    if (loop->order_count == 0u || loop->levels == 0u || loop->points == 0u || loop->orders[0] != 0u)
        return HCI_TABLE_BAD_SHAPE;
    if (loop->points > HCI_LOOP_TABLE_MOST_POINTS || loop->repeats == 0u || loop->period_turns == 0u)
        return HCI_TABLE_BAD_SHAPE;
    if (loop->levels > 1u && !(loop->torque_high_Nm > loop->torque_low_Nm)) return HCI_TABLE_BAD_SHAPE;
    if (loop->levels > 2u && loop->levels % 2u == 0u) return HCI_TABLE_BAD_SHAPE;
    if (loop->response_count == 1u) return HCI_TABLE_BAD_SHAPE;
    return hci_loop_crc32(loop) == loop->crc32 ? HCI_TABLE_GOOD : HCI_TABLE_BAD_CRC;
}

#endif
