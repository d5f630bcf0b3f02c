/* Checks tables of 16-bit knots, sums up their currents over 65 536 angles so that processors can be compared
 * to the last bit, and counts what an evaluation costs. TABLES(X) of tables.h is the list of tables:
 * X(name, type, function, arguments behind the angle). */
#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "tables.h"

#ifdef ON_BOARD
#include "measure.h"
#endif

enum { ANGLES = 65536, CALLS = 2000 };

static const uint32_t STEP =
    2654435769u; /* the golden ratio of a turn: calls come to all parts of the table */

/* FNV-1a of values of 2 or 4 bytes, least significant byte first on every processor. */
static uint32_t sum_of(uint32_t sum, const void *values, size_t count, size_t width)
{
    for (size_t k = 0; k < count; ++k) {
        const unsigned char *value = (const unsigned char *)values + k * width;
        uint16_t half;
        uint32_t word = 0u;
        memcpy(&half, value, sizeof half);
        if (width == sizeof word) memcpy(&word, value, sizeof word);
        if (width == sizeof half) word = half;
        for (size_t b = 0; b < width; ++b)
            sum = (sum ^ (word >> 8u * b & 0xffu)) * 16777619u;
    }
    return sum;
}

/* Structs hci_units_… hold 16-bit integers, hci_currents_… floats. */
#define WIDTH(type) (strstr(#type, "units") != NULL ? sizeof(int16_t) : sizeof(float))

#define DEFINE(name, type, function, extra)                                                                  \
    type call_##name(uint32_t angle);                                                                        \
    type __attribute__((noinline)) call_##name(uint32_t angle)                                               \
    {                                                                                                        \
        return function(&name, angle extra);                                                                 \
    }                                                                                                        \
    static type (*volatile pointer_##name)(uint32_t) = call_##name; /* not seen through */                   \
    static uint32_t sum_##name(void)                                                                         \
    {                                                                                                        \
        uint32_t sum = 2166136261u;                                                                          \
        for (uint32_t k = 0u; k < ANGLES; ++k) {                                                             \
            const type i = call_##name(k * 65536u + k);                                                      \
            sum = sum_of(sum, &i, sizeof i / WIDTH(type), WIDTH(type));                                      \
        }                                                                                                    \
        return sum;                                                                                          \
    }                                                                                                        \
    static void loop_##name(void)                                                                            \
    {                                                                                                        \
        uint32_t angle = 0u;                                                                                 \
        for (uint32_t k = 0u; k < CALLS; ++k, angle += STEP)                                                 \
            (void)pointer_##name(angle);                                                                     \
    }
TABLES(DEFINE)

#ifdef ON_BOARD
static void (*volatile pointer_nothing)(uint32_t) = nothing;

static void loop_nothing(void)
{
    uint32_t angle = 0u;
    for (uint32_t k = 0u; k < CALLS; ++k, angle += STEP)
        pointer_nothing(angle);
}

static uint32_t ticks_of(void (*loop)(void))
{
    const uint32_t start = ticks_now();
    loop();
    return ticks_between(start, ticks_now());
}

static double instructions_of(void (*loop)(void))
{
    return (double)(ticks_of(loop) - ticks_of(loop_nothing)) * INSTRUCTIONS_PER_TICK / CALLS;
}

static double check_of(const hci_table_i16 *table)
{
    const uint32_t start = ticks_now();
    if (hci_table_i16_check(table) != HCI_TABLE_GOOD) _Exit(EXIT_FAILURE);
    return (double)ticks_between(start, ticks_now()) * INSTRUCTIONS_PER_TICK;
}
#define PRINT(name, type, function, extra)                                                                   \
    printf("cost %s instructions %.2f check %.0f\n", #name, instructions_of(loop_##name), check_of(&name));
#else
#define PRINT(name, type, function, extra)
#endif
#define SUM(name, type, function, extra) printf("sum %s %08" PRIx32 "\n", #name, sum_##name());

int main(void)
{
    TABLES(SUM)
#ifdef ON_BOARD
    ticks_start();
#endif
    TABLES(PRINT)
    printf("done\n");
    fflush(stdout);
    return EXIT_SUCCESS;
}
