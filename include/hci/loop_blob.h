/* Orders for a drive that a program loads and does not contain: what `hci-solve emit --drive --blob` writes,
 * to be put into flash by a bootloader or received over a bus. As hci/blob.h, which says when a blob is
 * refused: cut off, damaged in a single bit, of another kind, newer, or not at a multiple of four bytes.
 *
 *     0  "HCIT", version, kind 4, bytes, hash: as in hci/blob.h
 *    20  pole pairs, 0: not known
 *    24  orders                               28  responses
 *    32  levels of torque                     36  points
 *    40  repeats                              44  electrical turns in 2^32 of angle
 *        then floats:
 *    48  torque of the first level, N*m       52  of the last
 *    56  resistance, ohm                      60  L_d, H
 *    64  L_q, H                               68  k_p of d, ohm
 *    72  k_i of d, ohm/s                      76  sample, s
 *    80  delay, s                             84  speed below which nothing fades, rad/s
 *    88  lead, s
 *    92  name of the machine, up to 35 bytes and zeros
 *   128  waves, ranges, responses; orders of 16 bits, filled up to four bytes; k_p and k_i of q, filter
 *        CRC-32 of all that stands before
 *
 * Low bytes first. For start-up. C99 and C++. */
#ifndef HCI_LOOP_BLOB_H
#define HCI_LOOP_BLOB_H

#include "hci/blob.h"
#include "hci/loop.h"

/* The most orders, responses and levels there may be: sizes then fit 32 bits. */
#define HCI_LOOP_BLOB_MOST 4096u

/* Fails to compile where structs are laid out so that they cannot lie in a blob. */
typedef char
    hci_loop_blob_needs_these_sizes[((sizeof(hci_loop_wave) == 48u) && (sizeof(hci_loop_range) == 8u) &&
                                     (sizeof(hci_loop_response) == 20u))
                                        ? 1
                                        : -1];

/* Where the parts begin, and where the CRC-32 is. */
typedef struct {
    uint32_t ranges, responses, orders, axis_q,
        end; /* bytes from the beginning; waves are at HCI_BLOB_HEAD */
} hci_loop_blob_places;

/* Whether numbers are so small that places can be computed of them. */
static inline int hci_loop_blob_has_sizes(const void *blob)
{
    return ((hci_blob_u32(blob, 24u) >= 1u) && (hci_blob_u32(blob, 24u) <= HCI_LOOP_BLOB_MOST) &&
            (hci_blob_u32(blob, 28u) <= HCI_LOOP_BLOB_MOST) && (hci_blob_u32(blob, 32u) >= 1u) &&
            (hci_blob_u32(blob, 32u) <= HCI_LOOP_BLOB_MOST) && (hci_blob_u32(blob, 44u) >= 1u) &&
            (hci_blob_byte(blob, HCI_BLOB_HEAD - 1u) == 0u))
               ? 1
               : 0;
}

/* The places of a blob whose sizes are good. */
static inline hci_loop_blob_places hci_loop_blob_places_of(const void *blob)
{
    const uint32_t orders = hci_blob_u32(blob, 24u);
    hci_loop_blob_places at;
    at.ranges = HCI_BLOB_HEAD + orders * hci_blob_u32(blob, 32u) * 48u;
    at.responses = at.ranges + orders * 8u;
    at.orders = at.responses + hci_blob_u32(blob, 28u) * 20u;
    at.axis_q = (at.orders + orders * 2u + 3u) & ~3u;
    at.end = at.axis_q + 12u;
    return at;
}

/* Points the arrays at the blob. */
static inline void hci_loop_blob_point(const void *blob, hci_loop_blob_places at, hci_loop_f32 *loop)
{
    const void *const waves = hci_blob_at(blob, HCI_BLOB_HEAD), *const ranges = hci_blob_at(blob, at.ranges),
                      *const responses = hci_blob_at(blob, at.responses),
                      *const orders = hci_blob_at(blob, at.orders);
#ifdef __cplusplus
    loop->waves = static_cast<const hci_loop_wave *>(waves);
    loop->ranges = static_cast<const hci_loop_range *>(ranges);
    loop->responses = static_cast<const hci_loop_response *>(responses);
    loop->orders = static_cast<const uint16_t *>(orders);
#else
    loop->waves = waves;
    loop->ranges = ranges;
    loop->responses = responses;
    loop->orders = orders;
#endif
}

/* The numbers that are no arrays. */
static inline void hci_loop_blob_numbers(const void *blob, hci_loop_blob_places at, hci_loop_f32 *loop)
{
    loop->order_count = hci_blob_u32(blob, 24u);
    loop->response_count = hci_blob_u32(blob, 28u);
    loop->levels = hci_blob_u32(blob, 32u);
    loop->points = hci_blob_u32(blob, 36u);
    loop->repeats = hci_blob_u32(blob, 40u);
    loop->period_turns = hci_blob_u32(blob, 44u);
    loop->base_order = HCI_TABLE_F32(loop->repeats) / HCI_TABLE_F32(loop->period_turns);
    loop->torque_low_Nm = hci_blob_float(blob, 48u);
    loop->torque_high_Nm = hci_blob_float(blob, 52u);
    loop->resistance_ohm = hci_blob_float(blob, 56u);
    loop->inductance_H[0] = hci_blob_float(blob, 60u);
    loop->inductance_H[1] = hci_blob_float(blob, 64u);
    loop->proportional_ohm[0] = hci_blob_float(blob, 68u);
    loop->proportional_ohm[1] = hci_blob_float(blob, at.axis_q);
    loop->integral_ohm_per_s[0] = hci_blob_float(blob, 72u);
    loop->integral_ohm_per_s[1] = hci_blob_float(blob, at.axis_q + 4u);
    loop->filter = hci_blob_float(blob, at.axis_q + 8u);
    loop->sample_s = hci_blob_float(blob, 76u);
    loop->delay_s = hci_blob_float(blob, 80u);
    loop->whole_rad_per_s = hci_blob_float(blob, 84u);
    loop->lead_s = hci_blob_float(blob, 88u);
}

/* Points orders at the blob. size: bytes of the memory that it lies in, which may have more. loop and facts
 * (which may be NULL, and whose mean torque is 0): out, with HCI_BLOB_GOOD alone. */
static inline hci_blob_verdict hci_loop_blob_read(const void *blob, uint32_t size, hci_loop_f32 *loop,
                                                  hci_blob_facts *facts)
{
    const hci_blob_verdict verdict = hci_blob_check_whole(blob, size, HCI_BLOB_LOOP);
    hci_loop_blob_places at;
    hci_loop_f32 x;
    if (verdict != HCI_BLOB_GOOD) return verdict;
    if (hci_loop_blob_has_sizes(blob) == 0) return HCI_BLOB_DAMAGED;
    at = hci_loop_blob_places_of(blob);
    if (hci_blob_u32(blob, 8u) != at.end + 4u) return HCI_BLOB_DAMAGED;
    hci_loop_blob_point(blob, at, &x);
    hci_loop_blob_numbers(blob, at, &x);
    x.crc32 = hci_loop_crc32(&x); /* of waves that the blob's own CRC has found whole */
    if (hci_loop_check(&x) != HCI_TABLE_GOOD) return HCI_BLOB_DAMAGED;
    *loop = x;
    if (facts != NULL) {
        hci_blob_read_facts(blob, facts);
        facts->mean_torque_Nm = 0.0f;
    }
    return HCI_BLOB_GOOD;
}

#endif
