/* Small current tables on a microcontroller: knots of 16 bits, or of 8, of the part of a turn that does not
 * repeat.
 *
 * A table holds the knots of a spline through the currents: linear, quadratic or cubic pieces in equal steps.
 * Where a sixth, a third or half of a turn says all, only that is kept, and phases and signs are changed
 * about: with waves of order 6k ± 1 the currents a sixth of a turn later are (−i_b, −i_c, −i_a). The angle is
 * that of hci/table.h: a uint32_t, 2^32 for a period.
 *
 * hci_table_i16_abc and its neighbours give amperes; those named _q15 are integer arithmetic throughout, for
 * controllers without a floating-point unit, and give units of unit_A. All 32-bit: no 64-bit product, no
 * division. A table that the compiler sees as a constant (as the emitted header has it) costs only what its
 * shape needs. Needs hci/table.h, <stddef.h> and <stdint.h>; signed numbers are shifted to the right as two's
 * complement, which is checked below. C99 and C++. */
#ifndef HCI_TABLE_I16_H
#define HCI_TABLE_I16_H

#include <stddef.h>

#include "hci/table.h"

/* Version of the layout below; emitted files refuse to compile with another one. */
#define HCI_TABLE_I16_VERSION 2

/* Fails to compile where a right shift does not keep the sign. */
typedef char hci_table_i16_needs_arithmetic_shifts[(-1 >> 1) == -1 ? 1 : -1];

/* The interval has 12 bits, its number of steps at most so many. */
#define HCI_TABLE_I16_MOST_INTERVALS 4095u

/* What a table's shape makes superfluous is left out only where the compiler puts the function in place. */
#if defined(__GNUC__)
#define HCI_TABLE_INLINE static inline __attribute__((always_inline))
#else
#define HCI_TABLE_INLINE static inline
#endif

/* Phase currents in units of the table's unit_A. */
typedef struct {
    int16_t ia, ib, ic; /* of phases a, b and c */
} hci_units_abc;

/* Rotor-frame currents in units of the table's unit_A. */
typedef struct {
    int16_t id, iq; /* on the magnet axis, and a quarter of an electrical turn ahead */
} hci_units_dq;

/* A point with the currents that are due there. */
typedef struct {
    uint32_t angle;      /* 2^32 is one period of the table */
    int16_t torque_q15;  /* share of reference_torque_Nm, 32767 for all of it; not used with one part */
    int16_t expected[3]; /* in unit_A: ia, ib, ic or id, iq, 0 */
} hci_table_i16_probe;

/* A table of currents over the angle, as `hci-solve emit --format i16`, `q15` or `i8` writes it: constant, in
 * flash. */
typedef struct {
    const int16_t *knots;   /* intervals + degree rows of parts·columns values, A(θ) before B(θ), in
                             * unit_A; of a cubic spline in ¾ of it; NULL with knots of 8 bits */
    const int8_t *knots_i8; /* the same in 256 units each, or NULL */
    const hci_table_i16_probe *probes; /* points to check at start-up */
    uint32_t probe_count;              /* entries of probes */
    uint32_t knot_bits;                /* 16, or 8: which of the two there are */
    uint32_t intervals;                /* in a sector; 1 … HCI_TABLE_I16_MOST_INTERVALS */
    uint32_t degree;                   /* of the spline: 1, 2, 3 */
    uint32_t columns;                  /* abc: 2 for a star (ic = −ia − ib), 3 with a neutral; dq: 2 */
    uint32_t parts;                    /* 1, or 2: A(θ) at reference_torque_Nm, and B(θ) */
    uint32_t sectors;                  /* of a period, of which one is kept */
    uint32_t rotation;     /* abc: phases by which the currents of the next sector are moved on: 0, 1, 2 */
    uint32_t alternates;   /* abc: 1 where the next sector has the other sign, else 0 */
    hci_table_frame frame; /* of the columns */
    uint32_t period_turns; /* electrical turns in 2^32 of angle */
    uint32_t crc32;        /* of the knots */
    float unit_A;          /* of one unit of the integer currents */
    float max_error_A;     /* largest error of any current at any angle, |T| <= reference_torque_Nm */
    float max_error_q15_A; /* the same of the integer functions */
    float peak_A;          /* largest |phase current|, |T| <= reference_torque_Nm */
    float reference_torque_Nm; /* > 0 with two parts; 0 with one */
} hci_table_i16;

/* ---- the place of an angle ---- */

/* Where an angle lies. */
typedef struct {
    uint32_t sector, interval; /* counted from 0 */
    int32_t fraction;          /* of the interval, 0 … 32767 */
} hci_table_i16_place;

/* The upper half of angle·sectors: one instruction where there is one for it, and never a call. */
HCI_TABLE_INLINE uint32_t hci_table_i16_upper(uint32_t angle, uint32_t sectors)
{
#if defined(__ARM_ARCH_6M__) || defined(__ARM_ARCH_8M_BASE__) ||                                             \
    (defined(__SIZEOF_INT__) && __SIZEOF_INT__ < 4)
    return ((angle >> 16) * sectors + (((angle & 0xFFFFu) * sectors) >> 16)) >> 16;
#else
    return HCI_TABLE_U32((HCI_TABLE_U64(angle) * sectors) >> 32);
#endif
}

/* The sector is the upper half of angle·sectors and the way in it the lower one, which 32 bits hold. */
HCI_TABLE_INLINE hci_table_i16_place hci_table_i16_find(const hci_table_i16 *table, uint32_t angle)
{
    uint32_t position = ((angle * table->sectors) >> 12) * table->intervals;
    hci_table_i16_place place;
    place.sector = hci_table_i16_upper(angle, table->sectors);
    place.interval = position >> 20;
    position = (position >> 5) & 0x7FFFu;
    place.fraction = HCI_TABLE_I32(position);
    return place;
}

/* ---- splines ----
 *
 * Values in fixed point: 32768 to unit_A, and 65536 for quadratic splines. `emit` keeps knots and their
 * differences so small that nothing overflows. */

/* value·2^−bits, rounded down. MISRA C 10.1 does not want signed numbers shifted, since a compiler may do as
 * it likes: hci_table_i16_needs_arithmetic_shifts refuses those that do. */
HCI_TABLE_INLINE int32_t hci_table_i16_right(int32_t value, uint32_t bits)
{
    /* cppcheck-suppress misra-c2012-10.1 */
    return value >> bits;
}

/* Values from one knot to the next. */
HCI_TABLE_INLINE uint32_t hci_table_i16_stride(const hci_table_i16 *table)
{
    return table->columns * table->parts;
}

/* The knots that an interval needs, as many as its degree and one more. */
typedef struct {
    int32_t c0, c1, c2, c3; /* in units; of a cubic spline in ¾ of it */
} hci_table_i16_window;

/* Those from a knot of 16 bits on. */
HCI_TABLE_INLINE hci_table_i16_window hci_table_i16_window_i16(const hci_table_i16 *table,
                                                               const int16_t *knot)
{
    const uint32_t stride = hci_table_i16_stride(table);
    hci_table_i16_window w;
    w.c0 = knot[0];
    w.c1 = knot[stride];
    w.c2 = table->degree >= 2u ? knot[2u * stride] : 0;
    w.c3 = table->degree >= 3u ? knot[3u * stride] : 0;
    return w;
}

/* And of 8 bits, the upper half of 16. */
HCI_TABLE_INLINE hci_table_i16_window hci_table_i16_window_i8(const hci_table_i16 *table, const int8_t *knot)
{
    const uint32_t stride = hci_table_i16_stride(table);
    hci_table_i16_window w;
    w.c0 = knot[0] * 256;
    w.c1 = knot[stride] * 256;
    w.c2 = table->degree >= 2u ? knot[2u * stride] * 256 : 0;
    w.c3 = table->degree >= 3u ? knot[3u * stride] * 256 : 0;
    return w;
}

/* c₀ + u (c₁ − c₀). fraction: 32768 u. */
HCI_TABLE_INLINE int32_t hci_table_i16_linear(hci_table_i16_window w, int32_t fraction)
{
    return w.c0 * 32768 + (w.c1 - w.c0) * fraction;
}

/* Twice ½(c₀ + c₁) + u (c₁ − c₀) + ½u² (c₀ − 2c₁ + c₂). */
HCI_TABLE_INLINE int32_t hci_table_i16_quadratic(hci_table_i16_window w, int32_t fraction)
{
    const int32_t slope = w.c1 - w.c0, bend = w.c2 - w.c1 - slope;
    return (w.c0 + w.c1) * 32768 + (2 * slope + hci_table_i16_right(bend * fraction, 15u)) * fraction;
}

/* ¾ of ⅙(c₀ + 4c₁ + c₂) + ½u (c₂ − c₀) + ½u² (c₀ − 2c₁ + c₂) + ⅙u³ (c₃ − 3c₂ + 3c₁ − c₀). */
HCI_TABLE_INLINE int32_t hci_table_i16_cubic(hci_table_i16_window w, int32_t fraction)
{
    const int32_t bend = w.c0 - 2 * w.c1 + w.c2, twist = w.c3 - 2 * w.c2 + w.c1 - bend;
    int32_t slope = 3 * bend + hci_table_i16_right(twist * fraction, 15u);
    slope = 3 * (w.c2 - w.c0) + hci_table_i16_right(slope * fraction, 15u);
    return (w.c0 + 4 * w.c1 + w.c2) * 4096 + hci_table_i16_right(slope * fraction, 3u);
}

/* The value between knots by the degree of the table. */
HCI_TABLE_INLINE int32_t hci_table_i16_spline(const hci_table_i16 *table, hci_table_i16_window w,
                                              int32_t fraction)
{
    if (table->degree == 1u) return hci_table_i16_linear(w, fraction);
    if (table->degree == 2u) return hci_table_i16_quadratic(w, fraction);
    return hci_table_i16_cubic(w, fraction);
}

/* Amperes of a value in fixed point. */
HCI_TABLE_INLINE float hci_table_i16_ampere(const hci_table_i16 *table, int32_t value)
{
    const float share = table->degree == 2u ? 1.0f / 65536.0f : 1.0f / 32768.0f;
    return HCI_TABLE_F32(value) * (table->unit_A * share);
}

/* The nearest whole unit to a value in fixed point. */
HCI_TABLE_INLINE int32_t hci_table_i16_round(const hci_table_i16 *table, int32_t value)
{
    return table->degree == 2u ? hci_table_i16_right(value + 32768, 16u)
                               : hci_table_i16_right(value + 16384, 15u);
}

/* ---- sectors ---- */

/* One part of the currents of all phases, in fixed point, or of d and q. */
typedef struct {
    int32_t a, b, c; /* of the phases, or d, q, 0 */
} hci_table_i16_values;

/* The phases of a place from those of the sector that is kept. */
HCI_TABLE_INLINE hci_table_i16_values hci_table_i16_unfold(const hci_table_i16 *table, uint32_t sector,
                                                           hci_table_i16_values v)
{
    const uint32_t times = sector * table->rotation;
    const uint32_t moved = times >= 9u   ? times - 9u
                           : times >= 6u ? times - 6u
                           : times >= 3u ? times - 3u
                                         : times;
    const hci_table_i16_values kept = v;
    if (moved == 1u) {
        v.a = kept.b;
        v.b = kept.c;
        v.c = kept.a;
    } else if (moved == 2u) {
        v.a = kept.c;
        v.b = kept.a;
        v.c = kept.b;
    } else {
        /* as they are */
    }
    if ((sector & table->alternates) != 0u) {
        v.a = -v.a;
        v.b = -v.b;
        v.c = -v.c;
    }
    return v;
}

/* The columns of one part (0 or 1) at a place, as they are kept. */
HCI_TABLE_INLINE hci_table_i16_values hci_table_i16_columns(const hci_table_i16 *table,
                                                            hci_table_i16_place place, uint32_t part)
{
    const uint32_t first = place.interval * hci_table_i16_stride(table) + part * table->columns;
    const int32_t u = place.fraction;
    hci_table_i16_values v;
    v.c = 0;
    if (table->knot_bits == 8u) {
        const int8_t *knot = &table->knots_i8[first];
        v.a = hci_table_i16_spline(table, hci_table_i16_window_i8(table, knot), u);
        v.b = hci_table_i16_spline(table, hci_table_i16_window_i8(table, &knot[1]), u);
        if (table->columns == 3u)
            v.c = hci_table_i16_spline(table, hci_table_i16_window_i8(table, &knot[2]), u);
    } else {
        const int16_t *knot = &table->knots[first];
        v.a = hci_table_i16_spline(table, hci_table_i16_window_i16(table, knot), u);
        v.b = hci_table_i16_spline(table, hci_table_i16_window_i16(table, &knot[1]), u);
        if (table->columns == 3u)
            v.c = hci_table_i16_spline(table, hci_table_i16_window_i16(table, &knot[2]), u);
    }
    return v;
}

/* One part (0 or 1) at a place, in fixed point. */
HCI_TABLE_INLINE hci_table_i16_values hci_table_i16_part(const hci_table_i16 *table,
                                                         hci_table_i16_place place, uint32_t part)
{
    hci_table_i16_values v = hci_table_i16_columns(table, place, part);
    if (table->frame == HCI_TABLE_DQ) return v;
    if (table->columns == 2u) v.c = -v.a - v.b;
    return hci_table_i16_unfold(table, place.sector, v);
}

/* ---- currents in amperes ---- */

/* Phase currents of a table with frame abc and one part. */
HCI_TABLE_INLINE hci_currents_abc hci_table_i16_abc(const hci_table_i16 *table, uint32_t angle)
{
    const hci_table_i16_values v = hci_table_i16_part(table, hci_table_i16_find(table, angle), 0u);
    hci_currents_abc i;
    i.ia_A = hci_table_i16_ampere(table, v.a);
    i.ib_A = hci_table_i16_ampere(table, v.b);
    i.ic_A = hci_table_i16_ampere(table, v.c);
    return i;
}

/* Rotor-frame currents of a table with frame dq and one part. */
HCI_TABLE_INLINE hci_currents_dq hci_table_i16_dq(const hci_table_i16 *table, uint32_t angle)
{
    const hci_table_i16_values v = hci_table_i16_part(table, hci_table_i16_find(table, angle), 0u);
    hci_currents_dq i;
    i.id_A = hci_table_i16_ampere(table, v.a);
    i.iq_A = hci_table_i16_ampere(table, v.b);
    return i;
}

/* A torque as a share of the reference, within −1 … 1: beyond that the currents were not asked for. NaN
 * gives 0. */
HCI_TABLE_INLINE float hci_table_i16_share(const hci_table_i16 *table, float torque_Nm)
{
    const float most = table->reference_torque_Nm;
    if (torque_Nm >= most) return 1.0f;
    if (torque_Nm <= -most) return -1.0f;
    return torque_Nm > -most ? torque_Nm / most : 0.0f;
}

/* Phase currents of a table with frame abc and two parts at a torque, which is limited to
 * ±reference_torque_Nm. */
HCI_TABLE_INLINE hci_currents_abc hci_table_i16_abc_torque(const hci_table_i16 *table, uint32_t angle,
                                                           float torque_Nm)
{
    const hci_table_i16_place place = hci_table_i16_find(table, angle);
    const hci_table_i16_values a = hci_table_i16_part(table, place, 0u),
                               b = hci_table_i16_part(table, place, 1u);
    const float share = hci_table_i16_share(table, torque_Nm);
    hci_currents_abc i;
    i.ia_A = share * hci_table_i16_ampere(table, a.a) + hci_table_i16_ampere(table, b.a);
    i.ib_A = share * hci_table_i16_ampere(table, a.b) + hci_table_i16_ampere(table, b.b);
    i.ic_A = share * hci_table_i16_ampere(table, a.c) + hci_table_i16_ampere(table, b.c);
    return i;
}

/* Rotor-frame currents of a table with frame dq and two parts at a torque, which is limited to
 * ±reference_torque_Nm. */
HCI_TABLE_INLINE hci_currents_dq hci_table_i16_dq_torque(const hci_table_i16 *table, uint32_t angle,
                                                         float torque_Nm)
{
    const hci_table_i16_place place = hci_table_i16_find(table, angle);
    const hci_table_i16_values a = hci_table_i16_part(table, place, 0u),
                               b = hci_table_i16_part(table, place, 1u);
    const float share = hci_table_i16_share(table, torque_Nm);
    hci_currents_dq i;
    i.id_A = share * hci_table_i16_ampere(table, a.a) + hci_table_i16_ampere(table, b.a);
    i.iq_A = share * hci_table_i16_ampere(table, a.b) + hci_table_i16_ampere(table, b.b);
    return i;
}

/* ---- currents in integers ---- */

/* Phase currents of a table with frame abc and one part, in unit_A. */
HCI_TABLE_INLINE hci_units_abc hci_table_i16_abc_q15(const hci_table_i16 *table, uint32_t angle)
{
    const hci_table_i16_values v = hci_table_i16_part(table, hci_table_i16_find(table, angle), 0u);
    hci_units_abc i;
    i.ia = HCI_TABLE_I16(hci_table_i16_round(table, v.a));
    i.ib = HCI_TABLE_I16(hci_table_i16_round(table, v.b));
    i.ic = HCI_TABLE_I16(hci_table_i16_round(table, v.c));
    return i;
}

/* Rotor-frame currents of a table with frame dq and one part, in unit_A. */
HCI_TABLE_INLINE hci_units_dq hci_table_i16_dq_q15(const hci_table_i16 *table, uint32_t angle)
{
    const hci_table_i16_values v = hci_table_i16_part(table, hci_table_i16_find(table, angle), 0u);
    hci_units_dq i;
    i.id = HCI_TABLE_I16(hci_table_i16_round(table, v.a));
    i.iq = HCI_TABLE_I16(hci_table_i16_round(table, v.b));
    return i;
}

/* One current of two parts: a share of A and all of B. */
HCI_TABLE_INLINE int16_t hci_table_i16_sum_q15(const hci_table_i16 *table, int32_t a, int32_t b,
                                               int16_t torque_q15)
{
    const int32_t part = hci_table_i16_right(hci_table_i16_round(table, a) * torque_q15 + 16384, 15u);
    return HCI_TABLE_I16(part + hci_table_i16_round(table, b));
}

/* Phase currents of a table with frame abc and two parts, in unit_A; torque_q15: share of
 * reference_torque_Nm. */
HCI_TABLE_INLINE hci_units_abc hci_table_i16_abc_torque_q15(const hci_table_i16 *table, uint32_t angle,
                                                            int16_t torque_q15)
{
    const hci_table_i16_place place = hci_table_i16_find(table, angle);
    const hci_table_i16_values a = hci_table_i16_part(table, place, 0u),
                               b = hci_table_i16_part(table, place, 1u);
    hci_units_abc i;
    i.ia = hci_table_i16_sum_q15(table, a.a, b.a, torque_q15);
    i.ib = hci_table_i16_sum_q15(table, a.b, b.b, torque_q15);
    i.ic = hci_table_i16_sum_q15(table, a.c, b.c, torque_q15);
    return i;
}

/* Rotor-frame currents of a table with frame dq and two parts, in unit_A; torque_q15: share of
 * reference_torque_Nm. */
HCI_TABLE_INLINE hci_units_dq hci_table_i16_dq_torque_q15(const hci_table_i16 *table, uint32_t angle,
                                                          int16_t torque_q15)
{
    const hci_table_i16_place place = hci_table_i16_find(table, angle);
    const hci_table_i16_values a = hci_table_i16_part(table, place, 0u),
                               b = hci_table_i16_part(table, place, 1u);
    hci_units_dq i;
    i.id = hci_table_i16_sum_q15(table, a.a, b.a, torque_q15);
    i.iq = hci_table_i16_sum_q15(table, a.b, b.b, torque_q15);
    return i;
}

/* The currents of any table in unit_A, whatever its frame and parts: ia, ib, ic or id, iq, 0. */
static inline void hci_table_i16_currents_q15(const hci_table_i16 *table, uint32_t angle, int16_t torque_q15,
                                              int16_t current[3])
{
    if (table->frame == HCI_TABLE_ABC) {
        const hci_units_abc i = table->parts == 2u ? hci_table_i16_abc_torque_q15(table, angle, torque_q15)
                                                   : hci_table_i16_abc_q15(table, angle);
        current[0] = i.ia;
        current[1] = i.ib;
        current[2] = i.ic;
    } else {
        const hci_units_dq i = table->parts == 2u ? hci_table_i16_dq_torque_q15(table, angle, torque_q15)
                                                  : hci_table_i16_dq_q15(table, angle);
        current[0] = i.id;
        current[1] = i.iq;
        current[2] = 0;
    }
}

/* The same in amperes. */
static inline void hci_table_i16_currents(const hci_table_i16 *table, uint32_t angle, float torque_Nm,
                                          float current[3])
{
    if (table->frame == HCI_TABLE_ABC) {
        const hci_currents_abc i = table->parts == 2u ? hci_table_i16_abc_torque(table, angle, torque_Nm)
                                                      : hci_table_i16_abc(table, angle);
        current[0] = i.ia_A;
        current[1] = i.ib_A;
        current[2] = i.ic_A;
    } else {
        const hci_currents_dq i = table->parts == 2u ? hci_table_i16_dq_torque(table, angle, torque_Nm)
                                                     : hci_table_i16_dq(table, angle);
        current[0] = i.id_A;
        current[1] = i.iq_A;
        current[2] = 0.0f;
    }
}

/* ---- check at start-up ---- */

/* CRC-32 (IEEE 802.3, as in zlib) of all knots as they are kept, low byte first. */
static inline uint32_t hci_table_i16_crc32(const hci_table_i16 *table)
{
    const uint32_t count = (table->intervals + table->degree) * hci_table_i16_stride(table);
    uint32_t crc = 0xFFFFFFFFu;
    uint32_t k;
    for (k = 0u; k < count; ++k) {
        if (table->knot_bits == 8u)
            crc = hci_table_crc32_next(crc, HCI_TABLE_U32(table->knots_i8[k]) & 0xFFu, 2);
        else
            crc = hci_table_crc32_next(crc, HCI_TABLE_U32(table->knots[k]) & 0xFFFFu, 4);
    }
    return ~crc;
}

/* Whether a table has a shape that the functions above can read. */
static inline int hci_table_i16_shape_good(const hci_table_i16 *table)
{
    const uint32_t most_columns = hci_table_most_columns(table->frame);
    return table->intervals >= 1u && table->intervals <= HCI_TABLE_I16_MOST_INTERVALS &&
           table->degree >= 1u && table->degree <= 3u && table->columns >= 2u &&
           table->columns <= most_columns && table->parts >= 1u && table->parts <= 2u &&
           (table->knot_bits == 8u || table->knot_bits == 16u) && table->sectors >= 1u &&
           table->rotation <= 2u && table->alternates <= 1u &&
           (table->rotation == 0u || table->sectors <= 6u);
}

/* Shape, CRC and probes of a table. Call it once at start-up, and do not run the motor unless it says
 * HCI_TABLE_GOOD. The probes are what the host has computed from these knots, to the last bit. */
static inline hci_table_verdict hci_table_i16_check(const hci_table_i16 *table)
{
    uint32_t k;
    if (!hci_table_i16_shape_good(table)) return HCI_TABLE_BAD_SHAPE;
    if (hci_table_i16_crc32(table) != table->crc32) return HCI_TABLE_BAD_CRC;
    for (k = 0u; k < table->probe_count; ++k) {
        const hci_table_i16_probe *probe = &table->probes[k];
        int16_t current[3];
        hci_table_i16_currents_q15(table, probe->angle, probe->torque_q15, current);
        if (current[0] != probe->expected[0] || current[1] != probe->expected[1] ||
            current[2] != probe->expected[2])
            return HCI_TABLE_BAD_PROBE;
    }
    return HCI_TABLE_GOOD;
}

#endif
