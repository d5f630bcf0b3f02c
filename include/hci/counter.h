/* From the counter of an encoder to the angle of a table.
 *
 * A counter has any width, and starts again after so many steps: after its own range (a timer of 16 bits that
 * runs free), or after a turn (a timer that is set back, an absolute encoder). Either way the angle is that
 * of hci/table.h, 2^32 to a mechanical turn, without drift for any number of counts in a turn, as long as
 * less than half the counter's range passes between two calls.
 *
 * Which place is zero. Electrical zero, that of a table over an electrical turn, is where the fundamental of
 * phase a's back-EMF crosses zero rising; a current of i_a = I, i_b = i_c = −I/2 pulls the rotor to half a
 * turn from there, so that hci_counter_align takes 0x80000000 after such a pull. A table over a mechanical
 * turn begins at one of the pole pairs' zeros: that in which the recordings began whose machine it was made
 * for. With the same encoder, zero_angle is that of these recordings; `check --table` says by how much the
 * angle of a log is off.
 *
 * Integers of 32 bits, and no division but at the start. Needs <stdint.h> and hci/table.h. C99 and C++. */
#ifndef HCI_COUNTER_H
#define HCI_COUNTER_H

#include "hci/table.h"

/* A counter, and where the rotor was when it was read last. */
typedef struct {
    uint32_t range;           /* steps after which the counter starts again; 0: 2^32 */
    uint32_t counts_per_turn; /* mechanical, of all edges; 1 … 2^31 */
    uint32_t angle_per_count; /* 2^32 / counts_per_turn, its whole part */
    uint32_t rest_per_count;  /* and the rest in 1/65536 */
    uint32_t raw;             /* what was read last */
    uint32_t position;        /* counts since a zero of the counter, 0 … counts_per_turn − 1 */
    uint32_t zero_angle;      /* what is subtracted: the angle of the encoder at the table's zero */
    int32_t direction;        /* 1, or −1 where the encoder counts down while the motor turns a-b-c */
} hci_counter;

/* 2^bits, the range of a free-running counter. */
static inline uint32_t hci_counter_range(uint32_t bits)
{
    return bits < 32u ? HCI_TABLE_U32(1) << bits : 0u;
}

/* Once at start-up. range: hci_counter_range(16) of a free-running timer, or counts_per_turn where it starts
 * again after a turn. raw: what the counter says now; the position begins there, so that of an absolute
 * encoder is right at once and that of an incremental one wants its index or hci_counter_align. */
static inline void hci_counter_start(hci_counter *counter, uint32_t range, uint32_t counts_per_turn,
                                     int32_t direction, uint32_t raw)
{
    const uint32_t rest = (0u - counts_per_turn) % counts_per_turn;
    const uint64_t count = counts_per_turn;
    uint64_t wide = rest;
    counter->range = range;
    counter->counts_per_turn = counts_per_turn;
    /* 2^32 by n is (2^32 − n) by n, and 1 */
    counter->angle_per_count = (0u - counts_per_turn) / counts_per_turn + 1u;
    wide = wide << 16;
    wide = wide / count;
    counter->rest_per_count = HCI_TABLE_U32(wide);
    counter->direction = 1;
    if (direction < 0) counter->direction = -1;
    counter->raw = raw;
    counter->position = raw % counts_per_turn;
    counter->zero_angle = 0u;
}

/* The encoder's own angle, zero_angle not subtracted. Where the counter counts down it is the other way
 * round. */
static inline uint32_t hci_counter_own_angle(const hci_counter *counter)
{
    const uint32_t high = counter->position >> 16, low = counter->position & 0xFFFFu;
    const uint32_t rest = high * counter->rest_per_count + ((low * counter->rest_per_count) >> 16);
    const uint32_t angle = counter->position * counter->angle_per_count + rest;
    return counter->direction < 0 ? 0u - angle : angle;
}

/* Reads the counter: in the interrupt, at each sample. Returns the mechanical angle. */
static inline uint32_t hci_counter_angle(hci_counter *counter, uint32_t raw)
{
    uint32_t forward = raw - counter->raw, position = counter->position;
    if (raw < counter->raw) forward += counter->range; /* modulo 2^32 */
    counter->raw = raw;
    if (forward <= (counter->range - 1u) / 2u) {
        position += forward;
        while (position >= counter->counts_per_turn)
            position -= counter->counts_per_turn;
    } else {
        const uint32_t back = counter->range - forward;
        while (position < back)
            position += counter->counts_per_turn;
        position -= back;
    }
    counter->position = position;
    return hci_counter_own_angle(counter) - counter->zero_angle;
}

/* At the index of an incremental encoder, after hci_counter_angle has read the counter there. */
static inline void hci_counter_at_index(hci_counter *counter)
{
    counter->position = 0u;
}

/* From now on the rotor's place is this angle of the table in the pole pair where it stands; see above.
 * pole_pairs >= 1; electrical_angle: 2^32 to an electrical turn. A table over one electrical turn needs no
 * more; one over the mechanical turn needs to know in which of the pole pairs. */
static inline void hci_counter_align(hci_counter *counter, uint32_t electrical_angle, uint32_t pole_pairs)
{
    counter->zero_angle = hci_counter_own_angle(counter) - electrical_angle / pole_pairs;
}

#endif
