/* What random tests draw from: pi, and seeded numbers that are the same on every machine. The state is a
 * seed, any number; each draw moves it on. Prefix ref_, as in reference.h. */
#ifndef DRAWS_H
#define DRAWS_H

#include <math.h>
#include <stdint.h>

#define REF_PI 3.14159265358979323846

/* Uniform in low … high: 53 good bits of a 64-bit linear congruential generator. */
static inline double ref_uniform(uint64_t *state, double low, double high)
{
    *state = *state * 6364136223846793005u + 1442695040888963407u;
    return low + (high - low) * ((double)(*state >> 11) / 9007199254740992.0);
}

/* A whole number in low … high, both included. */
static inline int ref_integer(uint64_t *state, int low, int high)
{
    return (int)floor(ref_uniform(state, low, high + 1.0));
}

/* N(0, 1), by Box and Muller. */
static inline double ref_normal(uint64_t *state)
{
    const double radius = sqrt(-2.0 * log(1.0 - ref_uniform(state, 0.0, 1.0)));
    return radius * cos(ref_uniform(state, 0.0, 2.0 * REF_PI));
}

#endif
