/* Draws from the bytes of an input, for targets that make of them what they try: the same bytes give the same
 * draws, and behind the last byte all are 0. */
#ifndef DRAWS_H
#define DRAWS_H

#include <stddef.h>
#include <stdint.h>

static const uint8_t *draws_next;
static size_t draws_left;

/* From the first byte on. */
static inline void draws_begin(const uint8_t *data, size_t size)
{
    draws_next = data;
    draws_left = size;
}

/* One of 0 … below − 1, of two bytes. */
static inline unsigned draw(unsigned below)
{
    unsigned value = 0;
    for (int k = 0; k < 2 && draws_left > 0; ++k, --draws_left)
        value = value * 256u + *draws_next++;
    return value % below;
}

#endif
