#include "core/effects/sensor_stage.h"

#include <math.h>

enum { LEAST_PARTS = 4, MOST_PARTS = 12 }; /* of a step between samples */

#define LONGEST_STEP 0.04 /* of a part, in radians of the resonance: the frequency is 0.013 % off */
#define UNEVEN       0.1  /* of a step, that the next one may be longer or shorter */
#define SAME_STEP    1e-6 /* of a step, by which another one differs and is the same */

hci_stage_part hci_stage_part_of(const hci_sensor_stage *s, double step_s)
{
    const double g = 0.5 * step_s, square = s->omega * s->omega;
    if (!(s->omega > 0.0)) return (hci_stage_part){g, g, s->tau_s - g, s->tau_s + g, false};
    const double loss = 2.0 * s->damping * s->omega * g + square * g * g;
    return (hci_stage_part){g, g * square, 1.0 - loss, 1.0 + loss, true};
}

void hci_stage_go_on(const hci_stage_part *p, hci_stage_state *m, double input)
{
    const double both = m->input + input;
    if (p->swings) {
        const double v = (m->v * p->kept + p->of_input * (both - 2.0 * m->y)) / p->divisor;
        m->y += p->g * (m->v + v);
        m->v = v;
    } else {
        m->y = (m->y * p->kept + p->of_input * both) / p->divisor;
    }
    m->input = input;
}

double hci_stage_step(const hci_sensor_stage *s, hci_stage_state *m, double step_s, double input)
{
    const hci_stage_part p = hci_stage_part_of(s, step_s);
    hci_stage_go_on(&p, m, input);
    return m->y;
}

static double rate_of(const hci_sensor_stage *s)
{
    return s->omega > 0.0 ? s->omega : 1.0 / s->tau_s;
}

size_t hci_stage_parts(const hci_sensor_stage *s, double step_s)
{
    const double parts = ceil(rate_of(s) * step_s / LONGEST_STEP);
    return parts < LEAST_PARTS ? LEAST_PARTS : parts > MOST_PARTS ? MOST_PARTS : (size_t)parts;
}

bool hci_stage_is_even(const double *time_s, size_t n, size_t k)
{
    if (k < 2 || k + 1 >= n) return false;
    const double step_s = time_s[k] - time_s[k - 1];
    return fabs(time_s[k - 1] - time_s[k - 2] - step_s) < UNEVEN * step_s &&
           fabs(time_s[k + 1] - time_s[k] - step_s) < UNEVEN * step_s;
}

double hci_stage_input_at(bool even, const hci_stage_inputs *x, double u)
{
    if (!even) return x->from + u * (x->to - x->from);
    const double first = x->to - x->before / 3.0 - x->from / 2.0 - x->after / 6.0;
    const double second = 0.5 * (x->before + x->to) - x->from;
    return x->from +
           u * (first + u * (second + u * ((x->after - x->before) / 6.0 + 0.5 * (x->from - x->to))));
}

/* ---- many columns at once ---- */

enum { LINEAR = 6, WIDTH = 32 }; /* y, v and the four inputs; columns */

/* One part of a step: y and v after it, by y and v before it and by the sum of its inputs before and after.
 */
typedef struct {
    double y_by_y, y_by_v, y_by_sum, v_by_y, v_by_v, v_by_sum;
} part_map;

static part_map part_map_of(const hci_sensor_stage *s, double step_s)
{
    const double g = 0.5 * step_s, square = s->omega * s->omega;
    if (!(s->omega > 0.0))
        return (part_map){(s->tau_s - g) / (s->tau_s + g), 0.0, g / (s->tau_s + g), 0.0, 0.0, 0.0};
    const double loss = 2.0 * s->damping * s->omega * g + square * g * g, share = 1.0 / (1.0 + loss);
    const double v_by_v = (1.0 - loss) * share, v_by_sum = g * square * share;
    return (part_map){
        1.0 - 2.0 * g * v_by_sum, g * (1.0 + v_by_v), g * v_by_sum, -2.0 * v_by_sum, v_by_v, v_by_sum};
}

/* From one sample to the next: y and v after it are linear in both before it and in the inputs, which is the
 * same for all columns. sum: of each part, its inputs before and after by the six. */
typedef struct {
    double step_s, y[LINEAR], v[LINEAR], sum[MOST_PARTS][LINEAR];
    size_t parts;
    bool even;
} passage;

/* The inputs of the parts by each of the four. */
static void sums_find(passage *p)
{
    for (size_t k = 0; k < LINEAR; ++k) {
        const hci_stage_inputs x = {k == 2, k == 3, k == 4, k == 5};
        double last = x.from;
        for (size_t j = 1; j <= p->parts; ++j) {
            const double share = (double)j / (double)p->parts;
            const double next = j < p->parts ? hci_stage_input_at(p->even, &x, share) : x.to;
            p->sum[j - 1][k] = last + next;
            last = next;
        }
    }
}

static void passage_find(const hci_sensor_stage *s, double step_s, bool even, passage *p)
{
    const size_t parts = hci_stage_parts(s, step_s);
    if (p->parts == parts && p->even == even && fabs(p->step_s - step_s) <= SAME_STEP * step_s) return;
    const bool known = p->parts == parts && p->even == even;
    const part_map m = part_map_of(s, step_s / (double)parts);
    p->step_s = step_s;
    p->parts = parts;
    p->even = even;
    if (!known) sums_find(p);
    for (size_t k = 0; k < LINEAR; ++k) {
        double y = k == 0, v = k == 1;
        for (size_t j = 0; j < parts; ++j) {
            const double sum = p->sum[j][k], before = y;
            y = m.y_by_y * y + m.y_by_v * v + m.y_by_sum * sum;
            v = m.v_by_y * before + m.v_by_v * v + m.v_by_sum * sum;
        }
        p->y[k] = y;
        p->v[k] = v;
    }
}

/* Columns beside each other on their way through a stage, in place. */
typedef struct {
    double y[WIDTH], v[WIDTH], from[WIDTH], before[WIDTH];
} columns;

/* Without a time before it, or after a step back, the stage is found settled. */
static void columns_settle(columns *m, const double *row, size_t width)
{
    for (size_t j = 0; j < width; ++j) {
        m->y[j] = m->from[j] = row[j];
        m->v[j] = m->before[j] = 0.0;
    }
}

static inline void columns_pass(const passage *p, columns *restrict m, double *restrict row,
                                const double *restrict next, size_t width)
{
    for (size_t j = 0; j < width; ++j) {
        const double to = row[j], after = next[j], y = m->y[j], v = m->v[j];
        m->y[j] = p->y[0] * y + p->y[1] * v + p->y[2] * m->before[j] + p->y[3] * m->from[j] + p->y[4] * to +
                  p->y[5] * after;
        m->v[j] = p->v[0] * y + p->v[1] * v + p->v[2] * m->before[j] + p->v[3] * m->from[j] + p->v[4] * to +
                  p->v[5] * after;
        m->before[j] = m->from[j];
        m->from[j] = to;
        row[j] = m->y[j];
    }
}

/* A lag has no v. */
static inline void columns_lag(const passage *p, columns *restrict m, double *restrict row,
                               const double *restrict next, size_t width)
{
    for (size_t j = 0; j < width; ++j) {
        const double to = row[j];
        m->y[j] = p->y[0] * m->y[j] + p->y[2] * m->before[j] + p->y[3] * m->from[j] + p->y[4] * to +
                  p->y[5] * next[j];
        m->before[j] = m->from[j];
        m->from[j] = to;
        row[j] = m->y[j];
    }
}

/* The width is told to the compiler where it is the usual one. */
static void columns_go_on(const hci_sensor_stage *s, const passage *p, columns *m, double *row,
                          const double *next, size_t width)
{
    if (s->omega > 0.0 && width == WIDTH)
        columns_pass(p, m, row, next, WIDTH);
    else if (s->omega > 0.0)
        columns_pass(p, m, row, next, width);
    else if (width == WIDTH)
        columns_lag(p, m, row, next, WIDTH);
    else
        columns_lag(p, m, row, next, width);
}

static void filter_columns(const hci_sensor_stage *s, const hci_effect_run *run, double *x, size_t stride,
                           size_t width)
{
    static const double NONE[WIDTH] = {0.0}; /* no next sample: it does not count */
    passage p = {.parts = 0};
    columns m = {{0.0}, {0.0}, {0.0}, {0.0}};
    for (size_t k = 0; k < run->count; ++k) {
        double *row = x + k * stride;
        const double step_s = k > 0 ? run->time_s[k] - run->time_s[k - 1] : -1.0;
        if (step_s < 0.0) {
            columns_settle(&m, row, width);
            continue;
        }
        const bool even = hci_stage_is_even(run->time_s, run->count, k);
        passage_find(s, step_s, even, &p);
        columns_go_on(s, &p, &m, row, even ? row + stride : NONE, width);
    }
}

void hci_stage_filter(const hci_sensor_stage *s, const hci_effect_run *run, double *x, size_t stride,
                      size_t count)
{
    for (size_t c = 0; c < count; c += WIDTH)
        filter_columns(s, run, x + c, stride, count - c < WIDTH ? count - c : WIDTH);
}

/* ---- many stages at once ---- */

enum { LANES = HCI_EFFECT_SENSORS };

/* Stages side by side: y and v after a part of a step, as part_map of each. */
typedef struct {
    double square[LANES], loss[LANES], tau_s[LANES]; /* ω², 2ζω, τ */
    double y_by_y[LANES], y_by_v[LANES], y_by_sum[LANES], v_by_y[LANES], v_by_v[LANES], v_by_sum[LANES];
    double step_s;
    size_t parts;                    /* of the step */
    const hci_sensor_stage *fastest; /* takes the most parts */
} part_maps;

static void part_maps_start(const hci_sensor_stage s[LANES], part_maps *m)
{
    *m = (part_maps){.fastest = s};
    for (size_t k = 0; k < LANES; ++k) {
        m->square[k] = s[k].omega * s[k].omega;
        m->loss[k] = 2.0 * s[k].damping * s[k].omega;
        m->tau_s[k] = s[k].tau_s;
        if (rate_of(&s[k]) > rate_of(m->fastest)) m->fastest = &s[k];
    }
}

static void resonances_find(part_maps *m, double g)
{
    for (size_t k = 0; k < LANES; ++k) {
        const double loss = m->loss[k] * g + m->square[k] * g * g, share = 1.0 / (1.0 + loss);
        m->v_by_v[k] = (1.0 - loss) * share;
        m->v_by_sum[k] = g * m->square[k] * share;
        m->v_by_y[k] = -2.0 * m->v_by_sum[k];
        m->y_by_y[k] = 1.0 - 2.0 * g * m->v_by_sum[k];
        m->y_by_v[k] = g * (1.0 + m->v_by_v[k]);
        m->y_by_sum[k] = g * m->v_by_sum[k];
    }
}

/* A lag has no v: the rest stays 0. */
static void lags_find(part_maps *m, double g)
{
    for (size_t k = 0; k < LANES; ++k) {
        m->y_by_y[k] = (m->tau_s[k] - g) / (m->tau_s[k] + g);
        m->y_by_sum[k] = g / (m->tau_s[k] + g);
    }
}

static void part_maps_find(part_maps *m, double step_s, size_t parts)
{
    if (m->parts == parts && fabs(m->step_s - step_s) <= SAME_STEP * step_s) return;
    m->step_s = step_s;
    m->parts = parts;
    if (m->fastest->omega > 0.0)
        resonances_find(m, 0.5 * (step_s / (double)parts));
    else
        lags_find(m, 0.5 * (step_s / (double)parts));
}

typedef struct {
    double y[LANES], v[LANES];
} lanes;

static void lanes_pass(const part_maps *restrict m, double sum, lanes *restrict x)
{
    for (size_t k = 0; k < LANES; ++k) {
        const double y = x->y[k], v = x->v[k];
        x->y[k] = m->y_by_y[k] * y + m->y_by_v[k] * v + m->y_by_sum[k] * sum;
        x->v[k] = m->v_by_y[k] * y + m->v_by_v[k] * v + m->v_by_sum[k] * sum;
    }
}

/* Sample k, a step after the last one. */
static void lanes_step(const hci_effect_run *run, size_t k, part_maps *m, lanes *x)
{
    const double *torque = run->torque_Nm + k, step_s = run->time_s[k] - run->time_s[k - 1];
    const bool even = hci_stage_is_even(run->time_s, run->count, k);
    const hci_stage_inputs u = {even ? torque[-2] : 0.0, torque[-1], torque[0], even ? torque[1] : 0.0};
    const size_t parts = hci_stage_parts(m->fastest, step_s);
    double last = u.from;
    part_maps_find(m, step_s, parts);
    for (size_t j = 1; j <= parts; ++j) {
        const double next = j < parts ? hci_stage_input_at(even, &u, (double)j / (double)parts) : u.to;
        lanes_pass(m, last + next, x);
        last = next;
    }
}

void hci_stage_filter_many(const hci_sensor_stage s[HCI_EFFECT_SENSORS], const hci_effect_run *run, double *y)
{
    part_maps m;
    lanes x = {{0.0}, {0.0}};
    part_maps_start(s, &m);
    for (size_t k = 0; k < run->count; ++k) {
        const bool goes_on = k > 0 && run->time_s[k] >= run->time_s[k - 1];
        if (goes_on) lanes_step(run, k, &m, &x);
        for (size_t j = 0; j < LANES; ++j) {
            if (!goes_on) x.y[j] = run->torque_Nm[k];
            if (!goes_on) x.v[j] = 0.0;
            y[k * LANES + j] = x.y[j];
        }
    }
}
