/* Learning cogging on the device: slow turns forward and backward, and Fourier sums of the current that holds
 * the shaft against it.
 *
 * While a speed or position control turns the shaft slowly, its current i_q makes up for cogging torque and
 * friction. Friction changes its sign with the direction and cogging does not, so that of the sums over turns
 * forward and backward the mean is cogging and half of the difference friction, at every order of the
 * mechanical angle. A delay of the current or of the angle turns the two against each other, and cancels in
 * the mean but for its square. What is left out is what accelerates: of order n about (nΩ/ω)² of the
 * amplitude at a speed Ω and a bandwidth ω of the speed control, both in rad/s. docs/controller.md says how
 * slow that is.
 *
 *     sums   ∫ i(θ) cos nθ dθ over whole turns, in steps of the angle, whatever the speed does
 *     table  the orders that stand out of their standard error
 *     blob   the sums in a few bytes, which `diagnose` and `harmonics` read as a recording
 *
 * Single precision, no heap, no libm; RAM of sizeof(hci_learn_sums) for each order. hci_learn_sample is meant
 * for interrupts; the rest for the background. Rounding does not add up: samples are summed within a step of
 * the angle, steps within a turn, and turns are averaged. C99 and C++. */
#ifndef HCI_LEARN_H
#define HCI_LEARN_H

#include "hci/blob.h"
#include "hci/guard.h"

/* The version of the blob that is written, and the newest that is read. */
#define HCI_LEARN_VERSION 1

/* Bytes of a blob: its head, for each order, and its CRC-32. */
#define HCI_LEARN_HEAD  44u
#define HCI_LEARN_ORDER 24u /* for each order */

/* "HCIL", low byte first. */
#define HCI_LEARN_MAGIC 0x4C494348u

/* A cast to a byte that neither C nor C++ warns of. */
#ifdef __cplusplus
#define HCI_LEARN_BYTE(value) static_cast<unsigned char>(value)
#else
#define HCI_LEARN_BYTE(value) ((unsigned char)(value)) /* to unsigned char */
#endif

/* The most orders there may be. */
#define HCI_LEARN_MOST_ORDERS 1024u

/* One order's sums. Cosine first, then sine. */
typedef struct {
    float turn[2];     /* of the turn that is under way */
    float forward[2];  /* mean of the whole turns forward */
    float backward[2]; /* and backward */
    float square;      /* of the turns' departures from the mean of their direction, both coordinates */
} hci_learn_sums;

/* A step of the angle with the mean of its samples: what the interrupt hands to the background. */
typedef struct {
    uint32_t begin;         /* mechanical angle at which it begins */
    uint32_t width;         /* in the direction of rotation; 0: the shaft went astray, the turn is lost */
    float value;            /* mean of the samples */
    float samples;          /* how many */
    volatile uint32_t full; /* written last by the interrupt, cleared by the background */
} hci_learn_step;

/* Learning under way. */
typedef struct {
    const uint16_t *orders;                 /* mechanical, ascending, not 0 */
    hci_learn_sums *sums;                   /* [order_count + 1]: the mean, then the orders */
    uint32_t order_count;                   /* 1 … HCI_LEARN_MOST_ORDERS */
    uint32_t step;                          /* of the angle: 2^32 by steps_per_turn */
    volatile int32_t direction;             /* 1, −1; 0: samples are not taken */
    uint32_t turns_forward, turns_backward; /* whole ones */

    uint32_t begin;                   /* the interrupt: where its step began */
    float part, whole;                /* sums of a few samples, and of those sums */
    uint32_t part_count, whole_count; /* samples in them */
    float last;                       /* the sample before */
    uint32_t has_begun;               /* whether there was one */
    hci_learn_step done;              /* a step that is complete */

    uint32_t way; /* the background: how far the turn has come */
} hci_learn;

/* What was learnt of an order. In the unit of the samples; cosine first, then sine, of the mechanical
 * angle. */
typedef struct {
    uint32_t order;    /* mechanical */
    float cogging[2];  /* the same in both directions: what holds the shaft against cogging */
    float friction[2]; /* what changes its sign with the direction */
    float error;       /* standard error of either coordinate of cogging; below 0: not known */
} hci_learn_result;

/* ---- in both ---- */

/* Begins anew. orders: order_count of them, mechanical, ascending, kept by the caller, as are
 * sums[order_count + 1]. steps_per_turn: at least 16 times the highest order; 4096 does up to 256. */
static inline void hci_learn_start(hci_learn *learn, const uint16_t *orders, uint32_t order_count,
                                   hci_learn_sums *sums, uint32_t steps_per_turn)
{
    uint32_t k;
    int a;
    learn->direction = 0;
    learn->orders = orders;
    learn->sums = sums;
    learn->order_count = order_count;
    learn->step = 0xFFFFFFFFu / steps_per_turn;
    learn->turns_forward = 0u;
    learn->turns_backward = 0u;
    learn->has_begun = 0u;
    learn->done.full = 0u;
    learn->way = 0u;
    for (k = 0u; k <= order_count; ++k) {
        for (a = 0; a < 2; ++a) {
            sums[k].turn[a] = 0.0f;
            sums[k].forward[a] = 0.0f;
            sums[k].backward[a] = 0.0f;
        }
        sums[k].square = 0.0f;
    }
}

/* Forgets the turn that is under way. */
static inline void hci_learn_drop_turn(hci_learn *learn)
{
    uint32_t k;
    learn->way = 0u;
    for (k = 0u; k <= learn->order_count; ++k) {
        learn->sums[k].turn[0] = 0.0f;
        learn->sums[k].turn[1] = 0.0f;
    }
}

/* From now on the shaft turns steadily: 1 forward, −1 backward; 0: samples are not taken, as while it is
 * speeded up. In the background. A turn that is not complete is forgotten. */
static inline void hci_learn_turn(hci_learn *learn, int32_t direction)
{
    learn->direction = 0;
    HCI_GUARD_BARRIER();
    hci_learn_drop_turn(learn);
    learn->has_begun = 0u;
    learn->done.full = 0u;
    HCI_GUARD_BARRIER();
    learn->direction = direction;
}

/* ---- in the interrupt ---- */

/* Adds to the sums of a step: a few samples at a time, so that many are not rounded away, and 65536 at
 * most. */
static inline void hci_learn_add(hci_learn *learn, float value)
{
    if (learn->whole_count >= 65536u) return;
    learn->part += value;
    learn->part_count += 1u;
    if (learn->part_count < 256u) return;
    learn->whole += learn->part;
    learn->whole_count += learn->part_count;
    learn->part = 0.0f;
    learn->part_count = 0u;
}

/* A step begins at an angle, with half of the sample there; the other half was that of the step before. */
static inline void hci_learn_begin(hci_learn *learn, uint32_t angle, float value)
{
    learn->begin = angle;
    learn->part = 0.5f * value;
    learn->whole = 0.0f;
    learn->part_count = 0u;
    learn->whole_count = 0u;
    learn->has_begun = 1u;
}

/* One sample, of any rate: the mechanical angle, and the current i_q in A or a torque in N·m at it. What is
 * no number is left out. Standing still adds to the step, and so does going back by up to four steps; more
 * than that, or eight steps at once, begins the turn anew. About 30 instructions on a Cortex-M4F, at the end
 * of a step 70. */
static inline void hci_learn_sample(hci_learn *learn, uint32_t mechanical_angle, float value)
{
    const int32_t direction = learn->direction;
    uint32_t moved, count;
    if ((direction == 0) || (hci_guard_is_number(value) == 0)) return;
    if (learn->has_begun == 0u) {
        hci_learn_begin(learn, mechanical_angle, value);
        return;
    }
    moved = direction > 0 ? mechanical_angle - learn->begin : learn->begin - mechanical_angle;
    if (moved > (0u - 4u * learn->step)) moved = 0u;
    if ((moved < learn->step) || (learn->done.full != 0u)) {
        hci_learn_add(learn, value);
        return;
    }
    learn->done.begin = learn->begin;
    learn->done.width = moved > 8u * learn->step ? 0u : moved;
    count = learn->whole_count + learn->part_count + 1u;
    learn->done.samples = HCI_TABLE_F32(count);
    learn->done.value = (learn->whole + learn->part + 0.5f * value) / learn->done.samples;
    HCI_GUARD_BARRIER();
    learn->done.full = 1u;
    hci_learn_begin(learn, mechanical_angle, value);
}

/* ---- in the background ---- */

/* An angle, so far on in the direction of rotation. */
static inline uint32_t hci_learn_on(const hci_learn *learn, uint32_t angle, uint32_t way)
{
    uint32_t on = angle + way;
    if (learn->direction < 0) on = angle - way;
    return on;
}

/* Adds a step to the sums of the turn. What averaging over it and its ends took from order n is put back:
 * with k samples (n w)²/24 (1 + 2/k²). */
static inline void hci_learn_add_step(hci_learn *learn, const hci_learn_step *step)
{
    const uint32_t middle = hci_learn_on(learn, step->begin, step->width / 2u);
    const float share = HCI_TABLE_F32(step->width) * 2.32830644e-10f; /* 2^-32 */
    const float lost =
        share * share * 1.64493407f * (1.0f + 2.0f / (step->samples * step->samples)); /* π²/6 */
    uint32_t k;
    learn->sums[0].turn[0] += share * step->value;
    for (k = 0u; k < learn->order_count; ++k) {
        const uint32_t order = learn->orders[k];
        const float n = HCI_TABLE_F32(order);
        const float weight = 2.0f * share * step->value * (1.0f + n * n * lost);
        float *turn = learn->sums[k + 1u].turn;
        float sine, cosine;
        hci_angle_sine_cosine(order * middle, &sine, &cosine);
        turn[0] += weight * cosine;
        turn[1] += weight * sine;
    }
}

/* The turn is whole: it goes into the means of its direction. */
static inline void hci_learn_end_turn(hci_learn *learn)
{
    const int32_t direction = learn->direction;
    uint32_t k;
    float share;
    int a;
    if (direction > 0) {
        learn->turns_forward += 1u;
        share = 1.0f / HCI_TABLE_F32(learn->turns_forward);
    } else {
        learn->turns_backward += 1u;
        share = 1.0f / HCI_TABLE_F32(learn->turns_backward);
    }
    for (k = 0u; k <= learn->order_count; ++k) {
        hci_learn_sums *sums = &learn->sums[k];
        float *mean = direction > 0 ? sums->forward : sums->backward;
        for (a = 0; a < 2; ++a) {
            const float off = sums->turn[a] - mean[a];
            mean[a] += off * share;
            sums->square += off * (sums->turn[a] - mean[a]);
            sums->turn[a] = 0.0f;
        }
    }
}

/* Takes the step that the interrupt has left, if there is one: call it as often as samples come, or less;
 * steps then grow. Returns 1 where there was one. About 60 instructions an order on a Cortex-M4F. */
static inline int hci_learn_work(hci_learn *learn)
{
    hci_learn_step step;
    uint32_t before, beyond;
    if (learn->done.full == 0u) return 0;
    HCI_GUARD_BARRIER();
    step = learn->done;
    HCI_GUARD_BARRIER();
    learn->done.full = 0u;
    if (step.width == 0u) {
        hci_learn_drop_turn(learn);
        return 1;
    }
    before = learn->way;
    learn->way = before + step.width; /* modulo a turn */
    beyond = learn->way;
    if (beyond < before) {
        step.width -= beyond;
        hci_learn_add_step(learn, &step);
        hci_learn_end_turn(learn);
        step.begin = hci_learn_on(learn, step.begin, step.width);
        step.width = beyond;
    }
    hci_learn_add_step(learn, &step);
    return 1;
}

/* ---- what was learnt ---- */

/* Standard error of either coordinate of an order's cogging, from how turns differ; -1 with less than three
 * turns. index: 0 for the mean. */
static inline float hci_learn_error(const hci_learn *learn, uint32_t index)
{
    const float f = HCI_TABLE_F32(learn->turns_forward), b = HCI_TABLE_F32(learn->turns_backward);
    const float freedom = (index == 0u ? 1.0f : 2.0f) * (f + b - 2.0f);
    float square;
    if ((learn->turns_forward == 0u) || (learn->turns_backward == 0u) || !(freedom > 0.0f)) return -1.0f;
    square = 0.25f * learn->sums[index].square / freedom * (1.0f / f + 1.0f / b);
    return square > 1e-30f ? square * hci_guard_inverse_root(square) : 0.0f;
}

/* An order, index 1 … order_count, or the mean, index 0: the load, and Coulomb friction. result: out. Returns
 * 0, and leaves it, while there is no whole turn in each direction. */
static inline int hci_learn_result_of(const hci_learn *learn, uint32_t index, hci_learn_result *result)
{
    const hci_learn_sums *sums = &learn->sums[index];
    int a;
    if ((learn->turns_forward == 0u) || (learn->turns_backward == 0u)) return 0;
    result->order = 0u;
    if (index > 0u) result->order = learn->orders[index - 1u];
    for (a = 0; a < 2; ++a) {
        result->cogging[a] = 0.5f * (sums->forward[a] + sums->backward[a]);
        result->friction[a] = 0.5f * (sums->forward[a] - sums->backward[a]);
    }
    result->error = hci_learn_error(learn, index);
    return 1;
}

/* Which orders go into a table, and how it is made. */
typedef struct {
    uint32_t points;     /* of the table: 32 in a period of the highest order leave 0.5 % of that */
    uint32_t pole_pairs; /* of the machine */
    uint32_t repeats; /* periods of the table in a mechanical turn, 1 … 65535: of orders 12, 24, 36 … it may
                       * be 12, and the table has a twelfth of the points; other orders are left out */
    float least_errors; /* orders whose amplitude is less than so many standard errors are left out; 6. With
                         * three turns each way 3 lets one of twenty in that are not there, 6 one of a
                         * thousand */
    int with_mean; /* not 0: with the mean, where nothing but cogging loads the shaft; where the back-EMF has
                    * harmonics the current against cogging has a mean */
} hci_learn_table_options;

/* Whether an order stands out of its error. */
static inline int hci_learn_stands_out(const hci_learn_result *x, float least_errors)
{
    const float square = x->cogging[0] * x->cogging[0] + x->cogging[1] * x->cogging[1];
    if (x->error < 0.0f) return 1;
    return square >= least_errors * least_errors * x->error * x->error ? 1 : 0;
}

/* Adds an order to all rows of a table of frame dq. The last row repeats the first. */
static inline void hci_learn_add_rows(const hci_learn_result *x, const hci_learn_table_options *options,
                                      float *rows)
{
    const uint32_t periods = x->order / options->repeats;
    uint32_t k;
    for (k = 0u; k <= options->points; ++k) {
        uint64_t angle = k;
        float sine, cosine;
        angle = (angle << 32) / options->points;
        hci_angle_sine_cosine(periods * HCI_TABLE_U32(angle), &sine, &cosine);
        rows[2u * k + 1u] += x->cogging[0] * cosine + x->cogging[1] * sine;
    }
}

/* What an order adds to the figures of a table: its amplitude to the peak, and (2πn/points)²/8 of that to the
 * error of interpolation, n its periods in the table. */
static inline void hci_learn_add_figures(const hci_learn_result *x, const hci_learn_table_options *options,
                                         hci_table_f32 *table)
{
    const uint32_t periods = x->order / options->repeats;
    const float square = x->cogging[0] * x->cogging[0] + x->cogging[1] * x->cogging[1];
    const float amplitude = square > 1e-30f ? square * hci_guard_inverse_root(square) : 0.0f;
    const float way = HCI_TABLE_F32(periods) * 6.28318531f / HCI_TABLE_F32(table->points);
    table->peak_A += amplitude;
    table->max_error_A += 0.125f * way * way * amplitude;
}

/* Whether an order goes into a table. index: 0 for the mean. */
static inline int hci_learn_is_wanted(const hci_learn_result *x, uint32_t index,
                                      const hci_learn_table_options *options)
{
    if ((index == 0u) && (options->with_mean == 0)) return 0;
    if ((x->order % options->repeats) != 0u) return 0;
    return hci_learn_stands_out(x, options->least_errors);
}

/* A table without orders. */
static inline void hci_learn_empty_table(const hci_learn_table_options *options, float *rows,
                                         hci_table_f32 *table)
{
    uint32_t k;
    for (k = 0u; k < (2u * (options->points + 1u)); ++k)
        rows[k] = 0.0f;
    table->rows = rows;
    table->probes = NULL;
    table->probe_count = 0u;
    table->points = options->points;
    table->columns = 2u;
    table->parts = 1u;
    table->frame = HCI_TABLE_DQ;
    table->period_turns =
        (options->pole_pairs % options->repeats) == 0u ? options->pole_pairs / options->repeats : 0u;
    table->reference_torque_Nm = 0.0f;
    table->peak_A = 0.0f;
    table->max_error_A = 0.0f;
}

/* A table of i_q, i_d = 0, out of what was learnt in A, to be added to the reference of the control: frame
 * dq, its angle the mechanical one times options->repeats (period_turns is 0 where that is a part of an
 * electrical turn). rows: [2·(points + 1)], kept by the caller. Returns how many orders are in it; 0, and no
 * table, while there is no whole turn in each direction. In the background: 60 instructions for each order
 * and point. */
static inline uint32_t hci_learn_table(const hci_learn *learn, const hci_learn_table_options *options,
                                       float *rows, hci_table_f32 *table)
{
    hci_learn_result x;
    uint32_t k, taken = 0u;
    if (hci_learn_result_of(learn, 0u, &x) == 0) return 0u;
    hci_learn_empty_table(options, rows, table);
    for (k = 0u; k <= learn->order_count; ++k) {
        (void)hci_learn_result_of(learn, k, &x);
        if (hci_learn_is_wanted(&x, k, options) == 0) continue;
        hci_learn_add_rows(&x, options, rows);
        hci_learn_add_figures(&x, options, table);
        taken += 1u;
    }
    table->sum32 = hci_table_f32_sum32(table);
    return taken;
}

/* ---- the blob ----
 *
 *     0  "HCIL"                      18  unit of the samples, 16 bits: hci_learn_unit
 *     4  version, 16 bits            20  turns forward
 *     6  orders, 16 bits             24  and backward
 *     8  bytes of the whole          28  speed, rad/s (float)
 *    12  sequence                    32  mean forward, backward, error (floats)
 *    16  pole pairs, 16 bits
 *    44  for each order: 16 bits, 16 bits of 0, then floats: cosine and sine forward, backward, error
 *        CRC-32 of all that stands before
 *
 * Low bytes first. Numbers are read byte by byte: it may lie anywhere. */

/* What the samples are. */
typedef enum {
    HCI_LEARN_AMPERE = 0,      /* the current i_q that holds the shaft */
    HCI_LEARN_NEWTON_METRE = 1 /* the torque that does */
} hci_learn_unit;

/* What a blob tells beside its orders. */
typedef struct {
    uint32_t sequence;     /* the higher of two is the newer one */
    uint32_t pole_pairs;   /* of the machine */
    uint32_t unit;         /* an hci_learn_unit */
    float speed_rad_per_s; /* at which the shaft was turned, either way; above 0 */
} hci_learn_facts;

/* 16 bits at a place. */
static inline void hci_learn_put_u16(unsigned char *bytes, uint32_t at, uint32_t value)
{
    bytes[at] = HCI_LEARN_BYTE(value & 255u);
    bytes[at + 1u] = HCI_LEARN_BYTE((value >> 8) & 255u);
}

/* 32 bits. */
static inline void hci_learn_put_u32(unsigned char *bytes, uint32_t at, uint32_t value)
{
    hci_learn_put_u16(bytes, at, value & 0xFFFFu);
    hci_learn_put_u16(bytes, at + 2u, value >> 16);
}

/* A float. */
static inline void hci_learn_put_float(unsigned char *bytes, uint32_t at, float value)
{
    union {
        float value;
        uint32_t bits;
    } pun;
    pun.value = value;
    hci_learn_put_u32(bytes, at, pun.bits);
}

/* Bytes of a blob of so many orders. */
static inline uint32_t hci_learn_bytes(uint32_t order_count)
{
    return HCI_LEARN_HEAD + order_count * HCI_LEARN_ORDER + 4u;
}

/* The sums of an order. */
static inline void hci_learn_put_order(const hci_learn *learn, uint32_t k, unsigned char *bytes)
{
    const hci_learn_sums *sums = &learn->sums[k + 1u];
    const uint32_t at = HCI_LEARN_HEAD + k * HCI_LEARN_ORDER;
    hci_learn_put_u32(bytes, at, learn->orders[k]);
    hci_learn_put_float(bytes, at + 4u, sums->forward[0]);
    hci_learn_put_float(bytes, at + 8u, sums->forward[1]);
    hci_learn_put_float(bytes, at + 12u, sums->backward[0]);
    hci_learn_put_float(bytes, at + 16u, sums->backward[1]);
    hci_learn_put_float(bytes, at + 20u, hci_learn_error(learn, k + 1u));
}

/* Writes what was learnt into bytes[room]. Returns how many there are, or 0 where they do not fit. */
static inline uint32_t hci_learn_write(const hci_learn *learn, const hci_learn_facts *facts,
                                       unsigned char *bytes, uint32_t room)
{
    const uint32_t all = hci_learn_bytes(learn->order_count);
    uint32_t k;
    if ((all > room) || (learn->order_count > HCI_LEARN_MOST_ORDERS)) return 0u;
    hci_learn_put_u32(bytes, 0u, HCI_LEARN_MAGIC);
    hci_learn_put_u16(bytes, 4u, HCI_TABLE_U32(HCI_LEARN_VERSION));
    hci_learn_put_u16(bytes, 6u, learn->order_count);
    hci_learn_put_u32(bytes, 8u, all);
    hci_learn_put_u32(bytes, 12u, facts->sequence);
    hci_learn_put_u16(bytes, 16u, facts->pole_pairs);
    hci_learn_put_u16(bytes, 18u, facts->unit);
    hci_learn_put_u32(bytes, 20u, learn->turns_forward);
    hci_learn_put_u32(bytes, 24u, learn->turns_backward);
    hci_learn_put_float(bytes, 28u, facts->speed_rad_per_s);
    hci_learn_put_float(bytes, 32u, learn->sums[0].forward[0]);
    hci_learn_put_float(bytes, 36u, learn->sums[0].backward[0]);
    hci_learn_put_float(bytes, 40u, hci_learn_error(learn, 0u));
    for (k = 0u; k < learn->order_count; ++k)
        hci_learn_put_order(learn, k, bytes);
    hci_learn_put_u32(bytes, all - 4u, hci_blob_crc32(bytes, all - 4u));
    return all;
}

/* Whether a blob is whole: cut off, damaged in a bit, or of a newer version it is refused. size: of the
 * memory that it lies in. facts: out, with HCI_BLOB_GOOD alone; may be NULL. */
static inline hci_blob_verdict hci_learn_check(const void *blob, uint32_t size, hci_learn_facts *facts)
{
    uint32_t bytes;
    if (size < 12u) return HCI_BLOB_CUT_OFF;
    if ((hci_blob_u32(blob, 0u) != HCI_LEARN_MAGIC) || (hci_blob_u16(blob, 4u) == 0u)) return HCI_BLOB_NONE;
    if (hci_blob_u16(blob, 4u) > HCI_TABLE_U32(HCI_LEARN_VERSION)) return HCI_BLOB_NEWER;
    bytes = hci_blob_u32(blob, 8u);
    if (bytes > size) return HCI_BLOB_CUT_OFF;
    if ((bytes < hci_learn_bytes(1u)) || (bytes != hci_learn_bytes(hci_blob_u16(blob, 6u))))
        return HCI_BLOB_DAMAGED;
    if (hci_blob_crc32(blob, bytes - 4u) != hci_blob_u32(blob, bytes - 4u)) return HCI_BLOB_DAMAGED;
    if (facts != NULL) {
        facts->sequence = hci_blob_u32(blob, 12u);
        facts->pole_pairs = hci_blob_u16(blob, 16u);
        facts->unit = hci_blob_u16(blob, 18u);
        facts->speed_rad_per_s = hci_blob_float(blob, 28u);
    }
    return HCI_BLOB_GOOD;
}

/* The newer of two places in flash that are written in turn, each with a sequence one higher: a power cut
 * while the one is written leaves the other. NULL where neither is whole. */
static inline const void *hci_learn_newest(const void *a, const void *b, uint32_t size)
{
    hci_learn_facts of_a = {0u, 0u, 0u, 0.0f}, of_b = {0u, 0u, 0u, 0.0f};
    const hci_blob_verdict is_a = hci_learn_check(a, size, &of_a);
    const hci_blob_verdict is_b = hci_learn_check(b, size, &of_b);
    if ((is_a != HCI_BLOB_GOOD) && (is_b != HCI_BLOB_GOOD)) return NULL;
    if (is_b != HCI_BLOB_GOOD) return a;
    if (is_a != HCI_BLOB_GOOD) return b;
    return (of_b.sequence - of_a.sequence) < 0x80000000u ? b : a;
}

/* Squared departures of an order that make its error. */
static inline float hci_learn_square_of(const hci_learn *learn, uint32_t index, float error)
{
    const float f = HCI_TABLE_F32(learn->turns_forward), b = HCI_TABLE_F32(learn->turns_backward);
    if (!(error > 0.0f) || !(f > 0.0f) || !(b > 0.0f)) return 0.0f;
    return 4.0f * error * error * (index == 0u ? 1.0f : 2.0f) * (f + b - 2.0f) / (1.0f / f + 1.0f / b);
}

/* After a restart: what a blob holds, as if it had just been learnt, for a table or to go on. learn: after
 * hci_learn_start with the same orders; else HCI_BLOB_OTHER_KIND. Unchanged but with HCI_BLOB_GOOD. */
static inline hci_blob_verdict hci_learn_restore(hci_learn *learn, const void *blob, uint32_t size)
{
    const hci_blob_verdict verdict = hci_learn_check(blob, size, NULL);
    uint32_t k;
    if (verdict != HCI_BLOB_GOOD) return verdict;
    if (hci_blob_u16(blob, 6u) != learn->order_count) return HCI_BLOB_OTHER_KIND;
    for (k = 0u; k < learn->order_count; ++k)
        if (hci_blob_u32(blob, HCI_LEARN_HEAD + k * HCI_LEARN_ORDER) != learn->orders[k])
            return HCI_BLOB_OTHER_KIND;
    learn->turns_forward = hci_blob_u32(blob, 20u);
    learn->turns_backward = hci_blob_u32(blob, 24u);
    learn->sums[0].forward[0] = hci_blob_float(blob, 32u);
    learn->sums[0].backward[0] = hci_blob_float(blob, 36u);
    learn->sums[0].square = hci_learn_square_of(learn, 0u, hci_blob_float(blob, 40u));
    for (k = 0u; k < learn->order_count; ++k) {
        const uint32_t at = HCI_LEARN_HEAD + k * HCI_LEARN_ORDER;
        hci_learn_sums *sums = &learn->sums[k + 1u];
        sums->forward[0] = hci_blob_float(blob, at + 4u);
        sums->forward[1] = hci_blob_float(blob, at + 8u);
        sums->backward[0] = hci_blob_float(blob, at + 12u);
        sums->backward[1] = hci_blob_float(blob, at + 16u);
        sums->square = hci_learn_square_of(learn, k + 1u, hci_blob_float(blob, at + 20u));
    }
    return HCI_BLOB_GOOD;
}

#endif
