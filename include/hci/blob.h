/* Tables that a program loads and does not contain: what `hci-solve emit --blob` writes, to be put into flash
 * by a bootloader or received over a bus. How it gets there is the user's.
 *
 * A blob is read where it lies: rows and probes of the table point into it. It has to begin at a multiple of
 * four bytes, and its processor to have low bytes first and IEEE 754 floats. A blob is refused, and the table
 * left as it was, where it is cut off, damaged in a single bit, of another kind or of a newer version than
 * this header, or where this processor computes other currents from it.
 *
 *     0  "HCIT"                       36  electrical turns in 2^32 of angle
 *     4  version, 16 bits             40  peak, A                (float)
 *     6  kind, 16 bits                44  reference torque, N*m  (float)
 *     8  bytes of the whole           48  error, A               (float)
 *    12  hash of the input, 64 bits   52  mean torque, N*m       (float), 0 where it is not known
 *    20  pole pairs, 0: not known     56  points, or intervals
 *    24  frame                        60  probes
 *    28  columns                      64  sum of the rows, or CRC-32 of the knots
 *    32  parts                        68  of knots: degree, sectors, rotation, alternates,
 *                                         unit, A (float), error of the integers, A (float)
 *    92  name of the machine, up to 35 bytes and zeros
 *   128  rows or knots, filled up to four bytes; probes; CRC-32 of all that stands before
 *
 * Low bytes first. Needs <stdint.h> and hci/table_i16.h; for start-up. C99 and C++. */
#ifndef HCI_BLOB_H
#define HCI_BLOB_H

#include <stddef.h>

#include "hci/table_i16.h"

/* The newest version that is read; `emit` writes the oldest that holds what it has to say. */
#define HCI_BLOB_VERSION 1

/* Bytes before the rows, and letters of the name with the zero behind it. */
#define HCI_BLOB_HEAD 128u
#define HCI_BLOB_NAME 36u /* of the name with its zero */

/* The most probes there may be. */
#define HCI_BLOB_MOST_PROBES 64u

/* What a blob holds. */
typedef enum {
    HCI_BLOB_F32 = 1, /* hci_table_f32 */
    HCI_BLOB_I16 = 2, /* hci_table_i16 */
    HCI_BLOB_I8 = 3,  /* the same with knots of 8 bits */
    HCI_BLOB_LOOP = 4 /* hci_loop_f32, read by hci/loop_blob.h */
} hci_blob_kind;

/* What reading a blob has found. */
typedef enum {
    HCI_BLOB_GOOD,  /* the table may be used */
    HCI_BLOB_NONE,  /* no blob of a table: empty flash, other bytes first, or not at a multiple of four */
    HCI_BLOB_NEWER, /* a version that this program does not know: emit with its own hci-solve */
    HCI_BLOB_OTHER_KIND, /* a table of another kind */
    HCI_BLOB_CUT_OFF,    /* there are fewer bytes than it has */
    HCI_BLOB_DAMAGED,    /* its CRC-32 is another, or its numbers contradict each other */
    HCI_BLOB_UNFIT       /* this processor computes other currents from it than the host */
} hci_blob_verdict;

/* What a blob tells beside its table. */
typedef struct {
    char machine[HCI_BLOB_NAME]; /* its name, "" where it is not known */
    uint32_t pole_pairs;         /* 0 where they are not known */
    uint32_t input_low;          /* 64-bit FNV-1a of the currents */
    uint32_t input_high;         /* and its upper half */
    float mean_torque_Nm;        /* of a table of one part; 0 where it is not known */
} hci_blob_facts;

/* Fails to compile where structs are laid out so that they cannot lie in a blob. */
typedef char hci_blob_needs_these_sizes[((sizeof(hci_table_f32_probe) == 20u) &&
                                         (sizeof(hci_table_i16_probe) == 12u) && (sizeof(float) == 4u))
                                            ? 1
                                            : -1];

/* ---- bytes ---- */

/* The place `offset` bytes on. */
static inline const void *hci_blob_at(const void *blob, uint32_t offset)
{
#ifdef __cplusplus
    return static_cast<const unsigned char *>(blob) + offset;
#else
    const unsigned char *const bytes = blob;
    return &bytes[offset];
#endif
}

/* One byte. */
static inline uint32_t hci_blob_byte(const void *blob, uint32_t offset)
{
#ifdef __cplusplus
    return static_cast<const unsigned char *>(hci_blob_at(blob, offset))[0];
#else
    const unsigned char *const byte = hci_blob_at(blob, offset);
    return byte[0];
#endif
}

/* 16 bits, low byte first. */
static inline uint32_t hci_blob_u16(const void *blob, uint32_t offset)
{
    return hci_blob_byte(blob, offset) | (hci_blob_byte(blob, offset + 1u) << 8);
}

/* 32 bits. */
static inline uint32_t hci_blob_u32(const void *blob, uint32_t offset)
{
    return hci_blob_u16(blob, offset) | (hci_blob_u16(blob, offset + 2u) << 16);
}

/* A float. */
static inline float hci_blob_float(const void *blob, uint32_t offset)
{
    union {
        uint32_t bits;
        float value;
    } pun;
    pun.bits = hci_blob_u32(blob, offset);
    return pun.value;
}

/* CRC-32 of so many bytes. */
static inline uint32_t hci_blob_crc32(const void *blob, uint32_t bytes)
{
    uint32_t crc = 0xFFFFFFFFu, k;
    for (k = 0u; k < bytes; ++k)
        crc = hci_table_crc32_bytes(crc, hci_blob_byte(blob, k), 1);
    return ~crc;
}

/* Whether it begins at a multiple of four bytes, and low bytes come first: what reading it in place needs. */
static inline int hci_blob_is_in_place(const void *blob)
{
    union {
        uint32_t word;
        unsigned char byte[4];
    } one;
    one.word = 1u;
#ifdef __cplusplus
    return one.byte[0] == 1u && (reinterpret_cast<uintptr_t>(blob) & 3u) == 0u ? 1 : 0;
#else
    /* An address is looked at as a number, which MISRA C 11.6 does not want: nothing else tells whether a
     * float may be read there. */
    /* cppcheck-suppress misra-c2012-11.6 */
    return ((one.byte[0] == 1u) && (((uintptr_t)blob & 3u) == 0u)) ? 1 : 0;
#endif
}

/* ---- what both kinds have ---- */

/* Bytes of rows or knots, with what fills them up. */
static inline uint32_t hci_blob_row_bytes(const void *blob, uint32_t rows, uint32_t value_bytes)
{
    const uint32_t bytes = rows * hci_blob_u32(blob, 28u) * hci_blob_u32(blob, 32u) * value_bytes;
    return (bytes + 3u) & ~3u;
}

/* Whether numbers are so small that sizes can be computed of them. */
static inline int hci_blob_has_sizes(const void *blob)
{
    return ((hci_blob_u32(blob, 28u) <= 3u) && (hci_blob_u32(blob, 32u) <= 2u) &&
            (hci_blob_u32(blob, 56u) <= 65536u) && (hci_blob_u32(blob, 60u) <= HCI_BLOB_MOST_PROBES) &&
            (hci_blob_u32(blob, 68u) <= 3u) && (hci_blob_u32(blob, 24u) <= 1u) &&
            (hci_blob_byte(blob, HCI_BLOB_HEAD - 1u) == 0u))
               ? 1
               : 0;
}

/* Whether a blob of that kind is there and whole. size: of the memory that it lies in. */
static inline hci_blob_verdict hci_blob_check_whole(const void *blob, uint32_t size, hci_blob_kind kind)
{
    uint32_t bytes;
    if (hci_blob_is_in_place(blob) == 0) return HCI_BLOB_NONE;
    if (size < 12u) return HCI_BLOB_CUT_OFF;
    if ((hci_blob_u32(blob, 0u) != 0x54494348u) || (hci_blob_u16(blob, 4u) == 0u)) return HCI_BLOB_NONE;
    if (hci_blob_u16(blob, 4u) > HCI_TABLE_U32(HCI_BLOB_VERSION)) return HCI_BLOB_NEWER;
    bytes = hci_blob_u32(blob, 8u);
    if (bytes > size) return HCI_BLOB_CUT_OFF;
    if (bytes < (HCI_BLOB_HEAD + 4u)) return HCI_BLOB_DAMAGED;
    if (hci_blob_crc32(blob, bytes - 4u) != hci_blob_u32(blob, bytes - 4u)) return HCI_BLOB_DAMAGED;
    if (hci_blob_u16(blob, 6u) != HCI_TABLE_U32(kind)) return HCI_BLOB_OTHER_KIND;
    return HCI_BLOB_GOOD;
}

/* All that can be said before the table is looked at. value_bytes: of a value and, as probe_bytes, of a probe
 * of that kind. */
static inline hci_blob_verdict hci_blob_check(const void *blob, uint32_t size, hci_blob_kind kind,
                                              uint32_t value_bytes, uint32_t probe_bytes)
{
    const hci_blob_verdict verdict = hci_blob_check_whole(blob, size, kind);
    uint32_t rows;
    if (verdict != HCI_BLOB_GOOD) return verdict;
    if (hci_blob_has_sizes(blob) == 0) return HCI_BLOB_DAMAGED;
    rows = hci_blob_u32(blob, 56u) + (kind == HCI_BLOB_F32 ? 1u : hci_blob_u32(blob, 68u));
    if (hci_blob_u32(blob, 8u) != HCI_BLOB_HEAD + hci_blob_row_bytes(blob, rows, value_bytes) +
                                      hci_blob_u32(blob, 60u) * probe_bytes + 4u)
        return HCI_BLOB_DAMAGED;
    return HCI_BLOB_GOOD;
}

/* What a blob tells beside its table; after it was found good. */
static inline void hci_blob_read_facts(const void *blob, hci_blob_facts *facts)
{
    uint32_t k;
    for (k = 0u; k < HCI_BLOB_NAME; ++k) {
#ifdef __cplusplus
        facts->machine[k] = static_cast<char>(hci_blob_byte(blob, 92u + k));
#else
        facts->machine[k] = (char)hci_blob_byte(blob, 92u + k);
#endif
    }
    facts->pole_pairs = hci_blob_u32(blob, 20u);
    facts->input_low = hci_blob_u32(blob, 12u);
    facts->input_high = hci_blob_u32(blob, 16u);
    facts->mean_torque_Nm = hci_blob_float(blob, 52u);
}

/* The frame of a blob. */
static inline hci_table_frame hci_blob_frame(const void *blob)
{
    if (hci_blob_u32(blob, 24u) == 0u) return HCI_TABLE_ABC;
    return HCI_TABLE_DQ;
}

/* ---- tables ---- */

/* Points a table of floats at the blob. size: bytes of the memory that it lies in, which may have more. table
 * and facts (which may be NULL): out, with HCI_BLOB_GOOD alone. About 60 instructions a value. */
static inline hci_blob_verdict hci_blob_table_f32(const void *blob, uint32_t size, hci_table_f32 *table,
                                                  hci_blob_facts *facts)
{
    hci_table_f32 t;
    const hci_blob_verdict verdict = hci_blob_check(blob, size, HCI_BLOB_F32, 4u, 20u);
    const void *rows, *probes;
    if (verdict != HCI_BLOB_GOOD) return verdict;
    t.points = hci_blob_u32(blob, 56u);
    rows = hci_blob_at(blob, HCI_BLOB_HEAD);
    probes = hci_blob_at(blob, HCI_BLOB_HEAD + hci_blob_row_bytes(blob, t.points + 1u, 4u));
#ifdef __cplusplus
    t.rows = static_cast<const float *>(rows);
    t.probes = static_cast<const hci_table_f32_probe *>(probes);
#else
    t.rows = rows;
    t.probes = probes;
#endif
    t.probe_count = hci_blob_u32(blob, 60u);
    t.columns = hci_blob_u32(blob, 28u);
    t.parts = hci_blob_u32(blob, 32u);
    t.frame = hci_blob_frame(blob);
    t.period_turns = hci_blob_u32(blob, 36u);
    t.sum32 = hci_blob_u32(blob, 64u);
    t.max_error_A = hci_blob_float(blob, 48u);
    t.peak_A = hci_blob_float(blob, 40u);
    t.reference_torque_Nm = hci_blob_float(blob, 44u);
    if (hci_table_f32_check(&t) != HCI_TABLE_GOOD) return HCI_BLOB_UNFIT;
    *table = t;
    if (facts != NULL) hci_blob_read_facts(blob, facts);
    return HCI_BLOB_GOOD;
}

/* Whether its knots have 8 bits, as far as that can be seen before it is checked. */
static inline int hci_blob_is_i8(const void *blob, uint32_t size)
{
    return ((size >= 8u) && (hci_blob_u16(blob, 6u) == HCI_TABLE_U32(HCI_BLOB_I8))) ? 1 : 0;
}

/* The same of a table of knots, of 16 bits or 8. A table that the compiler does not see as a constant costs
 * more: see examples/mcu. */
static inline hci_blob_verdict hci_blob_table_i16(const void *blob, uint32_t size, hci_table_i16 *table,
                                                  hci_blob_facts *facts)
{
    hci_table_i16 t;
    const int eight = hci_blob_is_i8(blob, size);
    const hci_blob_kind kind = eight != 0 ? HCI_BLOB_I8 : HCI_BLOB_I16;
    hci_blob_verdict verdict;
    const void *knots, *probes;
    uint32_t bytes = 2u;
    if (eight != 0) bytes = 1u;
    verdict = hci_blob_check(blob, size, kind, bytes, 12u);
    if (verdict != HCI_BLOB_GOOD) return verdict;
    t.intervals = hci_blob_u32(blob, 56u);
    t.degree = hci_blob_u32(blob, 68u);
    knots = hci_blob_at(blob, HCI_BLOB_HEAD);
    probes = hci_blob_at(blob, HCI_BLOB_HEAD + hci_blob_row_bytes(blob, t.intervals + t.degree, bytes));
#ifdef __cplusplus
    t.knots = eight != 0 ? NULL : static_cast<const int16_t *>(knots);
    t.knots_i8 = eight != 0 ? static_cast<const int8_t *>(knots) : NULL;
    t.probes = static_cast<const hci_table_i16_probe *>(probes);
#else
    t.knots = eight != 0 ? NULL : knots;
    t.knots_i8 = eight != 0 ? knots : NULL;
    t.probes = probes;
#endif
    t.knot_bits = 8u * bytes;
    t.probe_count = hci_blob_u32(blob, 60u);
    t.columns = hci_blob_u32(blob, 28u);
    t.parts = hci_blob_u32(blob, 32u);
    t.sectors = hci_blob_u32(blob, 72u);
    t.rotation = hci_blob_u32(blob, 76u);
    t.alternates = hci_blob_u32(blob, 80u);
    t.frame = hci_blob_frame(blob);
    t.period_turns = hci_blob_u32(blob, 36u);
    t.crc32 = hci_blob_u32(blob, 64u);
    t.unit_A = hci_blob_float(blob, 84u);
    t.max_error_A = hci_blob_float(blob, 48u);
    t.max_error_q15_A = hci_blob_float(blob, 88u);
    t.peak_A = hci_blob_float(blob, 40u);
    t.reference_torque_Nm = hci_blob_float(blob, 44u);
    if (hci_table_i16_check(&t) != HCI_TABLE_GOOD) return HCI_BLOB_UNFIT;
    *table = t;
    if (facts != NULL) hci_blob_read_facts(blob, facts);
    return HCI_BLOB_GOOD;
}

#endif
