/* What stands between a table and the current controllers: limits, a ramp on enabling, a change from one
 * table to another without a step, and fading out between two speeds.
 *
 * A limit keeps the direction of a current and shortens it; what is no number, or infinite, becomes 0. Needs
 * <stdint.h> and the headers of the tables: no libm, no heap, nothing writable but the caller's structs;
 * meant for interrupts. C99 and C++. */
#ifndef HCI_GUARD_H
#define HCI_GUARD_H

#include "hci/table_i16.h"

/* ---- limits ---- */

/* Whether x is a number, and below 1e15 in size: its square does not overflow. */
static inline int hci_guard_is_number(float x)
{
    return ((x > -1e15f) && (x < 1e15f)) ? 1 : 0;
}

/* x within low … high. NaN gives 0, or what is nearest to 0. low <= high. */
static inline float hci_guard_clamp(float x, float low, float high)
{
    float y = 0.0f;
    if ((x > 0.0f) || (x <= 0.0f)) y = x;
    if (y < low) y = low;
    if (y > high) y = high;
    return y;
}

/* 1/sqrt(x) for 1e-30 < x < 1e30, to 3e-7: Newton's iteration from a guess by the bits of the exponent. */
static inline float hci_guard_inverse_root(float x)
{
    union {
        float value;
        uint32_t bits;
    } guess;
    int k;
    guess.value = x;
    guess.bits = 0x5F3759DFu - (guess.bits >> 1);
    for (k = 0; k < 3; ++k)
        guess.value *= 1.5f - 0.5f * x * guess.value * guess.value;
    return guess.value;
}

/* The share of a vector that is left within a length: 1 where it is no longer than that, 0 where it is no
 * number or nothing is allowed. */
static inline float hci_guard_share(float x, float y, float most)
{
    const float square = x * x + y * y;
    if (!hci_guard_is_number(x) || !hci_guard_is_number(y) || !(most > 0.0f)) return 0.0f;
    if (square <= most * most) return 1.0f;
    return 0.9999995f * most * hci_guard_inverse_root(square); /* rounding does not take it beyond */
}

/* Rotor-frame currents, the vector at most most_A long. */
static inline hci_currents_dq hci_guard_dq(hci_currents_dq i, float most_A)
{
    const float share = hci_guard_share(i.id_A, i.iq_A, most_A);
    hci_currents_dq out = {0.0f, 0.0f};
    if (share > 0.0f) {
        out.id_A = share * i.id_A;
        out.iq_A = share * i.iq_A;
    }
    return out;
}

/* |x|. */
static inline float hci_guard_size(float x)
{
    return x < 0.0f ? -x : x;
}

/* Phase currents, none of them larger than most_A: all by the same factor, so that their sum stays. */
static inline hci_currents_abc hci_guard_abc(hci_currents_abc i, float most_A)
{
    float largest = hci_guard_size(i.ia_A), share = 1.0f;
    hci_currents_abc out = {0.0f, 0.0f, 0.0f};
    if (!hci_guard_is_number(i.ia_A) || !hci_guard_is_number(i.ib_A) || !hci_guard_is_number(i.ic_A))
        return out;
    if (!(most_A > 0.0f)) return out;
    if (hci_guard_size(i.ib_A) > largest) largest = hci_guard_size(i.ib_A);
    if (hci_guard_size(i.ic_A) > largest) largest = hci_guard_size(i.ic_A);
    if (largest > most_A) share = 0.9999998f * most_A / largest;
    out.ia_A = share * i.ia_A;
    out.ib_A = share * i.ib_A;
    out.ic_A = share * i.ic_A;
    return out;
}

/* The root of x, rounded up; x <= 2^31. */
static inline uint32_t hci_guard_root(uint32_t x)
{
    uint32_t root = 0u, bit;
    for (bit = 0x8000u; bit > 0u; bit >>= 1) {
        const uint32_t trial = root + bit;
        if (trial * trial < x) root = trial;
    }
    return x > 0u ? root + 1u : 0u;
}

/* x·share/32768, towards 0; share: 0 … 32768. */
static inline int16_t hci_guard_scaled(int16_t x, uint32_t share)
{
    const int32_t wide = x;
    const int32_t scaled = wide * HCI_TABLE_I32(share) / 32768;
    return HCI_TABLE_I16(scaled);
}

/* |x|. */
static inline uint32_t hci_guard_unit_size(int16_t x)
{
    int32_t size = x;
    if (size < 0) size = -size;
    return HCI_TABLE_U32(size);
}

/* Rotor-frame currents in integers, the vector at most `most` long. */
static inline hci_units_dq hci_guard_units_dq(hci_units_dq i, uint16_t most)
{
    const uint32_t d = hci_guard_unit_size(i.id), q = hci_guard_unit_size(i.iq), length = most;
    const uint32_t square = d * d + q * q;
    if (square > length * length) {
        const uint32_t share = (length << 15) / hci_guard_root(square);
        i.id = hci_guard_scaled(i.id, share);
        i.iq = hci_guard_scaled(i.iq, share);
    }
    return i;
}

/* Phase currents in integers, none of them larger than `most`. */
static inline hci_units_abc hci_guard_units_abc(hci_units_abc i, uint16_t most)
{
    uint32_t largest = hci_guard_unit_size(i.ia);
    if (hci_guard_unit_size(i.ib) > largest) largest = hci_guard_unit_size(i.ib);
    if (hci_guard_unit_size(i.ic) > largest) largest = hci_guard_unit_size(i.ic);
    if (largest > most) {
        const uint32_t share = (HCI_TABLE_U32(most) << 15) / largest;
        i.ia = hci_guard_scaled(i.ia, share);
        i.ib = hci_guard_scaled(i.ib, share);
        i.ic = hci_guard_scaled(i.ic, share);
    }
    return i;
}

/* ---- on and off ---- */

/* A share between 0 and 1 that the currents are multiplied by. */
typedef struct {
    float share; /* now */
    float step;  /* of a sample */
} hci_guard_ramp;

/* From 0: it takes rise_s from there to 1, and as long back, to 1 % up to 3e5 samples. Above 3e7 a step is
 * less than half of the last digit of a float, and the share stays below 1. */
static inline void hci_guard_ramp_start(hci_guard_ramp *ramp, float rise_s, float sample_s)
{
    ramp->share = 0.0f;
    ramp->step = rise_s > sample_s ? sample_s / rise_s : 1.0f;
}

/* One sample; returns the share. */
static inline float hci_guard_ramp_next(hci_guard_ramp *ramp, int enabled)
{
    const float step = enabled != 0 ? ramp->step : -ramp->step;
    ramp->share = hci_guard_clamp(ramp->share + step, 0.0f, 1.0f);
    return ramp->share;
}

/* What is left of a share at a speed: all up to one, nothing from the other on, a straight line between. The
 * sign of the speed does not count; NaN leaves nothing. whole < none. */
static inline float hci_guard_fade(float speed_rad_per_s, float whole_rad_per_s, float none_rad_per_s)
{
    const float speed = hci_guard_size(speed_rad_per_s);
    if (speed <= whole_rad_per_s) return 1.0f;
    if (!(speed < none_rad_per_s)) return 0.0f;
    return (none_rad_per_s - speed) / (none_rad_per_s - whole_rad_per_s);
}

/* ---- from one table to another ---- */

/* Two tables, one of which is in use while the other is made, received or loaded. The background asks for a
 * change, the interrupt makes it in small steps, and only then may the background write again. */
typedef struct {
    volatile uint32_t wanted; /* the table that is asked for: 0 or 1 */
    volatile float share;     /* of table 1 in the currents, 0 … 1 */
    float step;               /* of a sample */
} hci_guard_change;

/* Begins with a table; a change takes so long, with the samples that a ramp may have. */
static inline void hci_guard_change_start(hci_guard_change *change, uint32_t table, float change_s,
                                          float sample_s)
{
    change->wanted = table & 1u;
    change->share = (table & 1u) != 0u ? 1.0f : 0.0f;
    change->step = change_s > sample_s ? sample_s / change_s : 1.0f;
}

/* Whether the background may write to a table: it is not read, nor asked for. */
static inline int hci_guard_change_is_free(const hci_guard_change *change, uint32_t table)
{
    const float share = change->share;
    if (change->wanted == (table & 1u)) return 0;
    if ((table & 1u) != 0u) return share > 0.0f ? 0 : 1;
    return share < 1.0f ? 0 : 1;
}

/* What is written before is written before it is asked for. */
#if defined(__GNUC__)
#define HCI_GUARD_BARRIER() __asm__ volatile("" : : : "memory")
#else
#define HCI_GUARD_BARRIER() ((void)0)
#endif

/* In the background, when the table is complete and its check says HCI_TABLE_GOOD. On one processor; several
 * want a barrier of theirs before it. */
static inline void hci_guard_change_to(hci_guard_change *change, uint32_t table)
{
    HCI_GUARD_BARRIER();
    change->wanted = table & 1u;
}

/* In the interrupt, once a sample. Returns the share of table 1. */
static inline float hci_guard_change_next(hci_guard_change *change)
{
    const float step = change->wanted != 0u ? change->step : -change->step;
    const float share = hci_guard_clamp(change->share + step, 0.0f, 1.0f);
    change->share = share;
    return share;
}

/* a where share is 0, b where it is 1, and between them. */
static inline hci_currents_dq hci_guard_blend_dq(hci_currents_dq a, hci_currents_dq b, float share)
{
    hci_currents_dq i;
    i.id_A = a.id_A + share * (b.id_A - a.id_A);
    i.iq_A = a.iq_A + share * (b.iq_A - a.iq_A);
    return i;
}

/* The same of phase currents. */
static inline hci_currents_abc hci_guard_blend_abc(hci_currents_abc a, hci_currents_abc b, float share)
{
    hci_currents_abc i;
    i.ia_A = a.ia_A + share * (b.ia_A - a.ia_A);
    i.ib_A = a.ib_A + share * (b.ib_A - a.ib_A);
    i.ic_A = a.ic_A + share * (b.ic_A - a.ic_A);
    return i;
}

/* One sample of two tables of floats of the same frame: ia, ib, ic or id, iq, 0. A table that is not in use
 * is not read. */
static inline void hci_guard_change_f32(hci_guard_change *change, const hci_table_f32 table[2],
                                        uint32_t angle, float torque_Nm, float current[3])
{
    const float share = hci_guard_change_next(change);
    float other[3];
    int k;
    hci_table_f32_currents(&table[share >= 1.0f ? 1 : 0], angle, torque_Nm, current);
    if ((share > 0.0f) && (share < 1.0f)) {
        hci_table_f32_currents(&table[1], angle, torque_Nm, other);
        for (k = 0; k < 3; ++k)
            current[k] += share * (other[k] - current[k]);
    }
}

#endif
