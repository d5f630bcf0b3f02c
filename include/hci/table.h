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
 * reentrant and, but for those of the check at start-up, meant for interrupts. C99 and C++. */
#ifndef HCI_TABLE_H
#define HCI_TABLE_H

#include <stdint.h>

/* Version of the layout below; emitted files refuse to compile with another one. */
#define HCI_TABLE_VERSION 2

/* Casts that neither C nor C++ warns of. */
#ifdef __cplusplus
#define HCI_TABLE_I16(value) static_cast<int16_t>(value)
#define HCI_TABLE_I32(value) static_cast<int32_t>(value)
#define HCI_TABLE_U32(value) static_cast<uint32_t>(value)
#define HCI_TABLE_I64(value) static_cast<int64_t>(value)
#define HCI_TABLE_U64(value) static_cast<uint64_t>(value)
#define HCI_TABLE_F32(value) static_cast<float>(value)
#else
#define HCI_TABLE_I16(value) ((int16_t)(value))  /* to int16_t */
#define HCI_TABLE_I32(value) ((int32_t)(value))  /* to int32_t */
#define HCI_TABLE_U32(value) ((uint32_t)(value)) /* to uint32_t */
#define HCI_TABLE_I64(value) ((int64_t)(value))  /* to int64_t */
#define HCI_TABLE_U64(value) ((uint64_t)(value)) /* to uint64_t */
#define HCI_TABLE_F32(value) ((float)(value))    /* to float */
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
    uint32_t sum32;            /* hci_table_f32_sum32 of the rows */
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
    float half_steps;
    /* From 2^23 on a float has no fraction; this also keeps the conversion inside int32_t. */
    if (!(turns > -8388608.0f && turns < 8388608.0f)) return 0u;
    half_steps = (turns - HCI_TABLE_F32(HCI_TABLE_I32(turns))) * 2147483648.0f;
    return 2u * HCI_TABLE_U32(HCI_TABLE_I32(half_steps));
}

/* Sine and cosine of an angle whose turn is 2^32, to 2e-7. */
static inline void hci_angle_sine_cosine(uint32_t angle, float *sine, float *cosine)
{
    const uint32_t quadrant = (angle + 0x20000000u) >> 30;
    const uint32_t rest = angle - (quadrant << 30);
    const float x = HCI_TABLE_F32(HCI_TABLE_I32(rest)) * 1.46291808e-9f; /* 2π/2^32 */
    const float y = x * x;
    const float s =
        x * (1.0f - y * (0.166666667f - y * (8.33333333e-3f - y * (1.98412698e-4f - y * 2.75573192e-6f))));
    const float c = 1.0f - y * (0.5f - y * (4.16666667e-2f - y * (1.38888889e-3f - y * 2.48015873e-5f)));
    const float a = (quadrant & 1u) != 0u ? c : s;
    const float b = (quadrant & 1u) != 0u ? s : c;
    *sine = (quadrant & 2u) != 0u ? -a : a;
    *cosine = ((quadrant == 1u) || (quadrant == 2u)) ? -b : b;
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
    return HCI_TABLE_U32((HCI_TABLE_U64(HCI_TABLE_I64(counts)) * scale) >> 32);
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
    const uint64_t position = HCI_TABLE_U64(angle) * table->points;
    *fraction = HCI_TABLE_F32(HCI_TABLE_U32(position)) * 2.32830644e-10f; /* 2^-32 */
    return table->rows + HCI_TABLE_U32(position >> 32) * row_values;
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

/* A torque within ±reference_torque_Nm: beyond that the currents were not asked for. NaN gives 0. */
static inline float hci_table_f32_torque(const hci_table_f32 *table, float torque_Nm)
{
    const float most = table->reference_torque_Nm;
    if (torque_Nm >= most) return most;
    if (torque_Nm <= -most) return -most;
    return torque_Nm > -most ? torque_Nm : 0.0f;
}

/* Phase currents T·A(θ) + B(θ) of a table with frame abc and two parts at a torque, which is limited to
 * ±reference_torque_Nm. */
static inline hci_currents_abc hci_table_f32_abc_torque(const hci_table_f32 *table, uint32_t angle,
                                                        float torque_Nm)
{
    const uint32_t n = table->columns;
    const float t = hci_table_f32_torque(table, torque_Nm);
    float fraction;
    const float *a = hci_table_f32_row(table, 2u * n, angle, &fraction);
    const float *b = a + n;
    hci_currents_abc i;
    i.ia_A = t * hci_table_f32_between(a, 2u * n, fraction) + hci_table_f32_between(b, 2u * n, fraction);
    i.ib_A =
        t * hci_table_f32_between(a + 1, 2u * n, fraction) + hci_table_f32_between(b + 1, 2u * n, fraction);
    i.ic_A = n == 3u ? t * hci_table_f32_between(a + 2, 2u * n, fraction) +
                           hci_table_f32_between(b + 2, 2u * n, fraction)
                     : -i.ia_A - i.ib_A;
    return i;
}

/* Rotor-frame currents T·A(θ) + B(θ) of a table with frame dq and two parts at a torque, which is limited to
 * ±reference_torque_Nm. */
static inline hci_currents_dq hci_table_f32_dq_torque(const hci_table_f32 *table, uint32_t angle,
                                                      float torque_Nm)
{
    const float t = hci_table_f32_torque(table, torque_Nm);
    float fraction;
    const float *row = hci_table_f32_row(table, 4u, angle, &fraction);
    hci_currents_dq i;
    i.id_A = t * hci_table_f32_between(row, 4u, fraction) + hci_table_f32_between(row + 2, 4u, fraction);
    i.iq_A = t * hci_table_f32_between(row + 1, 4u, fraction) + hci_table_f32_between(row + 3, 4u, fraction);
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
    HCI_TABLE_BAD_CRC,   /* its rows are not those that were written, by their sum or CRC-32 */
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

/* The CRC-32 of one byte: 1 KiB of flash, and a quarter of the time that half bytes take. */
static inline uint32_t hci_table_crc32_remainder(uint32_t byte)
{
    static const uint32_t remainder[256] = {
        0x00000000u, 0x77073096u, 0xEE0E612Cu, 0x990951BAu, 0x076DC419u, 0x706AF48Fu, 0xE963A535u,
        0x9E6495A3u, 0x0EDB8832u, 0x79DCB8A4u, 0xE0D5E91Eu, 0x97D2D988u, 0x09B64C2Bu, 0x7EB17CBDu,
        0xE7B82D07u, 0x90BF1D91u, 0x1DB71064u, 0x6AB020F2u, 0xF3B97148u, 0x84BE41DEu, 0x1ADAD47Du,
        0x6DDDE4EBu, 0xF4D4B551u, 0x83D385C7u, 0x136C9856u, 0x646BA8C0u, 0xFD62F97Au, 0x8A65C9ECu,
        0x14015C4Fu, 0x63066CD9u, 0xFA0F3D63u, 0x8D080DF5u, 0x3B6E20C8u, 0x4C69105Eu, 0xD56041E4u,
        0xA2677172u, 0x3C03E4D1u, 0x4B04D447u, 0xD20D85FDu, 0xA50AB56Bu, 0x35B5A8FAu, 0x42B2986Cu,
        0xDBBBC9D6u, 0xACBCF940u, 0x32D86CE3u, 0x45DF5C75u, 0xDCD60DCFu, 0xABD13D59u, 0x26D930ACu,
        0x51DE003Au, 0xC8D75180u, 0xBFD06116u, 0x21B4F4B5u, 0x56B3C423u, 0xCFBA9599u, 0xB8BDA50Fu,
        0x2802B89Eu, 0x5F058808u, 0xC60CD9B2u, 0xB10BE924u, 0x2F6F7C87u, 0x58684C11u, 0xC1611DABu,
        0xB6662D3Du, 0x76DC4190u, 0x01DB7106u, 0x98D220BCu, 0xEFD5102Au, 0x71B18589u, 0x06B6B51Fu,
        0x9FBFE4A5u, 0xE8B8D433u, 0x7807C9A2u, 0x0F00F934u, 0x9609A88Eu, 0xE10E9818u, 0x7F6A0DBBu,
        0x086D3D2Du, 0x91646C97u, 0xE6635C01u, 0x6B6B51F4u, 0x1C6C6162u, 0x856530D8u, 0xF262004Eu,
        0x6C0695EDu, 0x1B01A57Bu, 0x8208F4C1u, 0xF50FC457u, 0x65B0D9C6u, 0x12B7E950u, 0x8BBEB8EAu,
        0xFCB9887Cu, 0x62DD1DDFu, 0x15DA2D49u, 0x8CD37CF3u, 0xFBD44C65u, 0x4DB26158u, 0x3AB551CEu,
        0xA3BC0074u, 0xD4BB30E2u, 0x4ADFA541u, 0x3DD895D7u, 0xA4D1C46Du, 0xD3D6F4FBu, 0x4369E96Au,
        0x346ED9FCu, 0xAD678846u, 0xDA60B8D0u, 0x44042D73u, 0x33031DE5u, 0xAA0A4C5Fu, 0xDD0D7CC9u,
        0x5005713Cu, 0x270241AAu, 0xBE0B1010u, 0xC90C2086u, 0x5768B525u, 0x206F85B3u, 0xB966D409u,
        0xCE61E49Fu, 0x5EDEF90Eu, 0x29D9C998u, 0xB0D09822u, 0xC7D7A8B4u, 0x59B33D17u, 0x2EB40D81u,
        0xB7BD5C3Bu, 0xC0BA6CADu, 0xEDB88320u, 0x9ABFB3B6u, 0x03B6E20Cu, 0x74B1D29Au, 0xEAD54739u,
        0x9DD277AFu, 0x04DB2615u, 0x73DC1683u, 0xE3630B12u, 0x94643B84u, 0x0D6D6A3Eu, 0x7A6A5AA8u,
        0xE40ECF0Bu, 0x9309FF9Du, 0x0A00AE27u, 0x7D079EB1u, 0xF00F9344u, 0x8708A3D2u, 0x1E01F268u,
        0x6906C2FEu, 0xF762575Du, 0x806567CBu, 0x196C3671u, 0x6E6B06E7u, 0xFED41B76u, 0x89D32BE0u,
        0x10DA7A5Au, 0x67DD4ACCu, 0xF9B9DF6Fu, 0x8EBEEFF9u, 0x17B7BE43u, 0x60B08ED5u, 0xD6D6A3E8u,
        0xA1D1937Eu, 0x38D8C2C4u, 0x4FDFF252u, 0xD1BB67F1u, 0xA6BC5767u, 0x3FB506DDu, 0x48B2364Bu,
        0xD80D2BDAu, 0xAF0A1B4Cu, 0x36034AF6u, 0x41047A60u, 0xDF60EFC3u, 0xA867DF55u, 0x316E8EEFu,
        0x4669BE79u, 0xCB61B38Cu, 0xBC66831Au, 0x256FD2A0u, 0x5268E236u, 0xCC0C7795u, 0xBB0B4703u,
        0x220216B9u, 0x5505262Fu, 0xC5BA3BBEu, 0xB2BD0B28u, 0x2BB45A92u, 0x5CB36A04u, 0xC2D7FFA7u,
        0xB5D0CF31u, 0x2CD99E8Bu, 0x5BDEAE1Du, 0x9B64C2B0u, 0xEC63F226u, 0x756AA39Cu, 0x026D930Au,
        0x9C0906A9u, 0xEB0E363Fu, 0x72076785u, 0x05005713u, 0x95BF4A82u, 0xE2B87A14u, 0x7BB12BAEu,
        0x0CB61B38u, 0x92D28E9Bu, 0xE5D5BE0Du, 0x7CDCEFB7u, 0x0BDBDF21u, 0x86D3D2D4u, 0xF1D4E242u,
        0x68DDB3F8u, 0x1FDA836Eu, 0x81BE16CDu, 0xF6B9265Bu, 0x6FB077E1u, 0x18B74777u, 0x88085AE6u,
        0xFF0F6A70u, 0x66063BCAu, 0x11010B5Cu, 0x8F659EFFu, 0xF862AE69u, 0x616BFFD3u, 0x166CCF45u,
        0xA00AE278u, 0xD70DD2EEu, 0x4E048354u, 0x3903B3C2u, 0xA7672661u, 0xD06016F7u, 0x4969474Du,
        0x3E6E77DBu, 0xAED16A4Au, 0xD9D65ADCu, 0x40DF0B66u, 0x37D83BF0u, 0xA9BCAE53u, 0xDEBB9EC5u,
        0x47B2CF7Fu, 0x30B5FFE9u, 0xBDBDF21Cu, 0xCABAC28Au, 0x53B39330u, 0x24B4A3A6u, 0xBAD03605u,
        0xCDD70693u, 0x54DE5729u, 0x23D967BFu, 0xB3667A2Eu, 0xC4614AB8u, 0x5D681B02u, 0x2A6F2B94u,
        0xB40BBE37u, 0xC30C8EA1u, 0x5A05DF1Bu, 0x2D02EF8Du};
    return remainder[byte & 255u];
}

/* CRC-32 of so many bytes, low ones first, after `crc`. */
static inline uint32_t hci_table_crc32_bytes(uint32_t crc, uint32_t bits, int bytes)
{
    int k;
    crc ^= bits;
    for (k = 0; k < bytes; ++k)
        crc = (crc >> 8) ^ hci_table_crc32_remainder(crc);
    return crc;
}

/* The same of four, one after the other without a loop. */
static inline uint32_t hci_table_crc32_word(uint32_t crc, uint32_t bits)
{
    crc ^= bits;
    crc = (crc >> 8) ^ hci_table_crc32_remainder(crc);
    crc = (crc >> 8) ^ hci_table_crc32_remainder(crc);
    crc = (crc >> 8) ^ hci_table_crc32_remainder(crc);
    return (crc >> 8) ^ hci_table_crc32_remainder(crc);
}

/* CRC-32 of one value's IEEE 754 bits, low byte first, after `crc`. */
static inline uint32_t hci_table_f32_crc32_next(uint32_t crc, float value)
{
    union {
        float value;
        uint32_t bits;
    } pun; /* memcpy would need <string.h>, and bytes of eight bits, which not every DSP has */
    pun.value = value;
    return hci_table_crc32_word(crc, pun.bits);
}

/* CRC-32 (IEEE 802.3, as in zlib) of all rows. About 20 instructions a value, for start-up. */
static inline uint32_t hci_table_f32_crc32(const hci_table_f32 *table)
{
    const uint32_t count = (table->points + 1u) * table->columns * table->parts;
    uint32_t crc = 0xFFFFFFFFu;
    uint32_t k;
    for (k = 0u; k < count; ++k)
        crc = hci_table_f32_crc32_next(crc, table->rows[k]);
    return ~crc;
}

/* The bits of a value after those before it: a product with an odd number keeps all, and the shift lets high
 * ones, which it only moves up, come down. */
static inline uint32_t hci_table_f32_sum32_next(uint32_t sum, uint32_t factor, float value)
{
    union {
        float value;
        uint32_t bits;
    } pun;
    pun.value = value;
    sum = sum * factor + pun.bits;
    return sum ^ (sum >> 15);
}

/* A sum of the bits of all rows, with a fifth of the instructions of a CRC: four to six a value. Any change
 * of one value is found, and of others all but one in 2^32. The factor is odd, and another one for another
 * number of values; a compiler that knew it would replace the product by something longer. For start-up. */
static inline uint32_t hci_table_f32_sum32(const hci_table_f32 *table)
{
    const float *value = table->rows;
    uint32_t left = (table->points + 1u) * table->columns * table->parts;
    const uint32_t factor = 2654435761u + 2u * left;
    uint32_t sum = 2166136261u;
    for (; left >= 4u; left -= 4u) {
        sum = hci_table_f32_sum32_next(sum, factor, value[0]);
        sum = hci_table_f32_sum32_next(sum, factor, value[1]);
        sum = hci_table_f32_sum32_next(sum, factor, value[2]);
        sum = hci_table_f32_sum32_next(sum, factor, value[3]);
        value = &value[4];
    }
    for (; left > 0u; --left) {
        sum = hci_table_f32_sum32_next(sum, factor, value[0]);
        value = &value[1];
    }
    return sum;
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
        if (!((error <= table->max_error_A) && (-error <= table->max_error_A))) good = 0;
    }
    return good;
}

/* Columns that a table of a frame can have at most. */
static inline uint32_t hci_table_most_columns(hci_table_frame frame)
{
    if (frame == HCI_TABLE_ABC) return 3u;
    return 2u;
}

/* Shape, sum and probes of a table. Call it once at start-up, and do not run the motor unless it says
 * HCI_TABLE_GOOD: it finds a damaged table, a compiler or FPU set up wrongly, and a table that another part
 * of the program has been built against. */
static inline hci_table_verdict hci_table_f32_check(const hci_table_f32 *table)
{
    const uint32_t most_columns = hci_table_most_columns(table->frame);
    uint32_t k;
    if (table->points == 0u || table->columns < 2u || table->columns > most_columns)
        return HCI_TABLE_BAD_SHAPE;
    if (table->parts < 1u || table->parts > 2u) return HCI_TABLE_BAD_SHAPE;
    if (hci_table_f32_sum32(table) != table->sum32) return HCI_TABLE_BAD_CRC;
    for (k = 0u; k < table->probe_count; ++k) {
        if (!hci_table_f32_probe_good(table, &table->probes[k])) return HCI_TABLE_BAD_PROBE;
    }
    return HCI_TABLE_GOOD;
}

#endif
