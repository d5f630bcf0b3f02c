/* Current tables on a microcontroller: what the files that `hci-solve emit` writes need, and nothing else.
 *
 * A table holds currents over the rotor angle in equal steps, read by linear interpolation. The angle is a
 * uint32_t that wraps by itself: 2^32 is one period of the table, that is one electrical turn unless
 * period_turns says more.
 *
 *     i(θ)                        one part
 *     i(θ, T) = T·A(θ) + B(θ)     two parts: A in A/(N·m), B in A, both from one call
 *
 * Needs <stdint.h> alone: no libm, no heap, no double arithmetic, nothing writable. Every function is
 * reentrant and, but for hci_table_f32_crc32 and hci_table_f32_check, meant for interrupts. C99 and C++. */
#ifndef HCI_TABLE_H
#define HCI_TABLE_H

#include <stdint.h>

/* Version of the layout below; emitted files refuse to compile with another one. */
#define HCI_TABLE_VERSION 1

/* A cast that neither C nor C++ warns of. */
#ifdef __cplusplus
#define HCI_TABLE_CAST(type, value) static_cast<type>(value)
#else
#define HCI_TABLE_CAST(type, value) ((type)(value))
#endif

/* Phase currents, positive into the machine. */
typedef struct {
    float ia_A, ib_A, ic_A; /* of phases a, b and c */
} hci_currents_abc;

/* Rotor-frame currents, amplitude-invariant: i_a = i_q sin θ − i_d cos θ. */
typedef struct {
    float id_A, iq_A; /* on the magnet axis, and a quarter of an electrical turn ahead */
} hci_currents_dq;

/* What the columns of a table are. */
typedef enum {
    HCI_TABLE_ABC, /* phase currents */
    HCI_TABLE_DQ   /* rotor-frame currents */
} hci_table_frame;

/* A point between the rows with the currents that are due there. */
typedef struct {
    uint32_t angle;    /* 2^32 is one period of the table */
    float torque_Nm;   /* not used by a table of one part */
    float expected[3]; /* A: ia, ib, ic or id, iq, 0 */
} hci_table_f32_probe;

/* A table of currents over the angle, as `hci-solve emit` writes it: constant, in flash. */
typedef struct {
    const float
        *rows; /* points + 1 rows of parts·columns values, A(θ) before B(θ); the last row repeats the first */
    const hci_table_f32_probe *probes; /* points to check at start-up */
    uint32_t probe_count;              /* entries of probes */
    uint32_t points;                   /* >= 1, not only powers of two */
    uint32_t columns;          /* abc: 2 for a star (ic = −ia − ib), 3 with a neutral conductor; dq: 2 */
    uint32_t parts;            /* 1 or 2 */
    hci_table_frame frame;     /* of the columns */
    uint32_t period_turns;     /* electrical turns in 2^32 of angle */
    uint32_t crc32;            /* of the rows */
    float max_error_A;         /* largest error of any current at any angle, for |T| <= reference_torque_Nm */
    float peak_A;              /* largest |phase current|, for |T| <= reference_torque_Nm */
    float reference_torque_Nm; /* largest |T| for which error and peak hold; 0 with one part */
} hci_table_f32;

/* ---- angles ---- */

/* Radians of any size and sign to an angle of period 2π; for a table of Q turns give θ/Q. The error is that
 * of a float: 1e-7 of a turn within one turn, and growing with |θ|. Infinity and NaN give 0. */
static inline uint32_t hci_angle_from_rad(float theta_rad)
{
    const float turns = theta_rad * 0.159154943f;
    int32_t whole;
    /* From 2^23 on a float has no fraction; this also keeps the conversion inside int32_t. */
    if (!(turns > -8388608.0f && turns < 8388608.0f)) return 0u;
    whole = HCI_TABLE_CAST(int32_t, turns);
    return 2u * HCI_TABLE_CAST(uint32_t, HCI_TABLE_CAST(int32_t, (turns - HCI_TABLE_CAST(float, whole)) *
                                                                     2147483648.0f));
}

/* 2^64 / counts_per_turn, once at start-up (it divides); counts_per_turn >= 1. */
static inline uint64_t hci_angle_scale(uint32_t counts_per_turn)
{
    return UINT64_MAX / counts_per_turn + 1u;
}

/* Encoder counts, which may be negative or run over many turns, to the mechanical angle. Without drift for
 * every counts_per_turn: the product modulo 2^64 is the fraction of a turn. */
static inline uint32_t hci_angle_from_counts(int32_t counts, uint64_t scale)
{
    return HCI_TABLE_CAST(uint32_t,
                          (HCI_TABLE_CAST(uint64_t, HCI_TABLE_CAST(int64_t, counts)) * scale) >> 32);
}

/* Mechanical angle to the angle of a table with `periods` periods in a mechanical turn: the pole pairs,
 * divided by period_turns. */
static inline uint32_t hci_angle_from_mechanical(uint32_t mechanical_angle, uint32_t periods)
{
    return mechanical_angle * periods;
}

/* ---- currents ---- */

/* The row before `angle` and the way to the next one, 0 … 1, from the two halves of angle·points. */
static inline const float *hci_table_f32_row(const hci_table_f32 *table, uint32_t row_values, uint32_t angle,
                                             float *fraction)
{
    const uint64_t position = HCI_TABLE_CAST(uint64_t, angle) * table->points;
    *fraction = HCI_TABLE_CAST(float, HCI_TABLE_CAST(uint32_t, position)) * 2.32830644e-10f; /* 2^-32 */
    return table->rows + HCI_TABLE_CAST(uint32_t, position >> 32) * row_values;
}

/* The value between one row and the next, by linear interpolation; fraction: 0 … 1. */
static inline float hci_table_f32_between(const float *value, uint32_t row_values, float fraction)
{
    return value[0] + fraction * (value[row_values] - value[0]);
}

/* Phase currents of a table with frame abc and one part. */
static inline hci_currents_abc hci_table_f32_abc(const hci_table_f32 *table, uint32_t angle)
{
    const uint32_t n = table->columns;
    float fraction;
    const float *row = hci_table_f32_row(table, n, angle, &fraction);
    hci_currents_abc i;
    i.ia_A = hci_table_f32_between(row, n, fraction);
    i.ib_A = hci_table_f32_between(row + 1, n, fraction);
    i.ic_A = n == 3u ? hci_table_f32_between(row + 2, n, fraction) : -i.ia_A - i.ib_A;
    return i;
}

/* Rotor-frame currents of a table with frame dq and one part. */
static inline hci_currents_dq hci_table_f32_dq(const hci_table_f32 *table, uint32_t angle)
{
    float fraction;
    const float *row = hci_table_f32_row(table, 2u, angle, &fraction);
    hci_currents_dq i;
    i.id_A = hci_table_f32_between(row, 2u, fraction);
    i.iq_A = hci_table_f32_between(row + 1, 2u, fraction);
    return i;
}

/* Phase currents T·A(θ) + B(θ) of a table with frame abc and two parts. */
static inline hci_currents_abc hci_table_f32_abc_torque(const hci_table_f32 *table, uint32_t angle,
                                                        float torque_Nm)
{
    const uint32_t n = table->columns;
    float fraction;
    const float *a = hci_table_f32_row(table, 2u * n, angle, &fraction);
    const float *b = a + n;
    hci_currents_abc i;
    i.ia_A =
        torque_Nm * hci_table_f32_between(a, 2u * n, fraction) + hci_table_f32_between(b, 2u * n, fraction);
    i.ib_A = torque_Nm * hci_table_f32_between(a + 1, 2u * n, fraction) +
             hci_table_f32_between(b + 1, 2u * n, fraction);
    i.ic_A = n == 3u ? torque_Nm * hci_table_f32_between(a + 2, 2u * n, fraction) +
                           hci_table_f32_between(b + 2, 2u * n, fraction)
                     : -i.ia_A - i.ib_A;
    return i;
}

/* Rotor-frame currents T·A(θ) + B(θ) of a table with frame dq and two parts. */
static inline hci_currents_dq hci_table_f32_dq_torque(const hci_table_f32 *table, uint32_t angle,
                                                      float torque_Nm)
{
    float fraction;
    const float *row = hci_table_f32_row(table, 4u, angle, &fraction);
    hci_currents_dq i;
    i.id_A =
        torque_Nm * hci_table_f32_between(row, 4u, fraction) + hci_table_f32_between(row + 2, 4u, fraction);
    i.iq_A = torque_Nm * hci_table_f32_between(row + 1, 4u, fraction) +
             hci_table_f32_between(row + 3, 4u, fraction);
    return i;
}

/* The currents of any table, whatever its frame and parts: ia, ib, ic or id, iq, 0. */
static inline void hci_table_f32_currents(const hci_table_f32 *table, uint32_t angle, float torque_Nm,
                                          float current[3])
{
    if (table->frame == HCI_TABLE_ABC) {
        const hci_currents_abc i = table->parts == 2u ? hci_table_f32_abc_torque(table, angle, torque_Nm)
                                                      : hci_table_f32_abc(table, angle);
        current[0] = i.ia_A;
        current[1] = i.ib_A;
        current[2] = i.ic_A;
    } else {
        const hci_currents_dq i = table->parts == 2u ? hci_table_f32_dq_torque(table, angle, torque_Nm)
                                                     : hci_table_f32_dq(table, angle);
        current[0] = i.id_A;
        current[1] = i.iq_A;
        current[2] = 0.0f;
    }
}

/* ---- check at start-up ---- */

/* What a check of a table has found. */
typedef enum {
    HCI_TABLE_GOOD,      /* nothing wrong */
    HCI_TABLE_BAD_SHAPE, /* points, columns or parts that no table has */
    HCI_TABLE_BAD_CRC,   /* its rows are not those that were written */
    HCI_TABLE_BAD_PROBE  /* this processor computes other currents from them */
} hci_table_verdict;

/* CRC-32 of so many times four bits, low ones first, after `crc`. */
static inline uint32_t hci_table_crc32_next(uint32_t crc, uint32_t bits, int nibbles)
{
    static const uint32_t remainder[16] = {0x00000000u, 0x1DB71064u, 0x3B6E20C8u, 0x26D930ACu,
                                           0x76DC4190u, 0x6B6B51F4u, 0x4DB26158u, 0x5005713Cu,
                                           0xEDB88320u, 0xF00F9344u, 0xD6D6A3E8u, 0xCB61B38Cu,
                                           0x9B64C2B0u, 0x86D3D2D4u, 0xA00AE278u, 0xBDBDF21Cu};
    int k;
    crc ^= bits;
    for (k = 0; k < nibbles; ++k)
        crc = (crc >> 4) ^ remainder[crc & 15u];
    return crc;
}

/* CRC-32 of one value's IEEE 754 bits, low byte first, after `crc`. */
static inline uint32_t hci_table_f32_crc32_next(uint32_t crc, float value)
{
    union {
        float value;
        uint32_t bits;
    } pun; /* memcpy would need <string.h>, and bytes of eight bits, which not every DSP has */
    pun.value = value;
    return hci_table_crc32_next(crc, pun.bits, 8);
}

/* CRC-32 (IEEE 802.3, as in zlib) of all rows. About 60 instructions a value, for start-up. */
static inline uint32_t hci_table_f32_crc32(const hci_table_f32 *table)
{
    const uint32_t count = (table->points + 1u) * table->columns * table->parts;
    uint32_t crc = 0xFFFFFFFFu;
    uint32_t k;
    for (k = 0u; k < count; ++k)
        crc = hci_table_f32_crc32_next(crc, table->rows[k]);
    return ~crc;
}

/* Whether the currents at a probe are the expected ones within max_error_A. */
static inline int hci_table_f32_probe_good(const hci_table_f32 *table, const hci_table_f32_probe *probe)
{
    float current[3];
    int good = 1;
    int k;
    hci_table_f32_currents(table, probe->angle, probe->torque_Nm, current);
    for (k = 0; k < 3; ++k) {
        const float error = current[k] - probe->expected[k];
        good = good && error <= table->max_error_A && -error <= table->max_error_A;
    }
    return good;
}

/* Shape, CRC and probes of a table. Call it once at start-up, and do not run the motor unless it says
 * HCI_TABLE_GOOD: it finds a damaged table, a compiler or FPU set up wrongly, and a table that another part
 * of the program has been built against. */
static inline hci_table_verdict hci_table_f32_check(const hci_table_f32 *table)
{
    const uint32_t most_columns = table->frame == HCI_TABLE_ABC ? 3u : 2u;
    uint32_t k;
    if (table->points == 0u || table->columns < 2u || table->columns > most_columns)
        return HCI_TABLE_BAD_SHAPE;
    if (table->parts < 1u || table->parts > 2u) return HCI_TABLE_BAD_SHAPE;
    if (hci_table_f32_crc32(table) != table->crc32) return HCI_TABLE_BAD_CRC;
    for (k = 0u; k < table->probe_count; ++k) {
        if (!hci_table_f32_probe_good(table, &table->probes[k])) return HCI_TABLE_BAD_PROBE;
    }
    return HCI_TABLE_GOOD;
}

#endif
