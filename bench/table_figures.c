/* Instructions and stack of one evaluation of each table of tables.h: TABLES(X), X(name, type, call), `call`
 * an expression in `angle`. An empty call is subtracted. */
#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>

#include "hci/counter.h"
#include "hci/foc.h"
#include "hci/learn.h"
#include "tables.h"

enum { CALLS = 1000, WORDS = 256 };
static const uint32_t STEP = 2654435769u; /* the golden ratio of a turn: calls come to all parts of a table */
#define PAINT 0x5AA5C33Cu

#if defined(__riscv)
static uint32_t instructions_now(void)
{
    uint32_t count;
    __asm__ volatile(".option push\n\t.option arch, +zicsr\n\tcsrr %0, minstret\n\t.option pop"
                     : "=r"(count));
    return count;
}

static uint32_t cost_of(void (*loop)(void))
{
    const uint32_t start = instructions_now();
    loop();
    return instructions_now() - start;
}
#else
#include "measure.h"

static uint32_t cost_of(void (*loop)(void))
{
    const uint32_t start = ticks_now();
    loop();
    return ticks_between(start, ticks_now()) * INSTRUCTIONS_PER_TICK;
}
#endif

/* Bytes of stack below the caller's that `run` touches. */
static uint32_t depth_of(void (*run)(void))
{
    uintptr_t stack_pointer;
#if defined(__riscv)
    __asm__ volatile("mv %0, sp" : "=r"(stack_pointer));
#else
    __asm__ volatile("mov %0, sp" : "=r"(stack_pointer));
#endif
    volatile uint32_t *const top = (volatile uint32_t *)stack_pointer;
    int32_t deepest = WORDS;
    for (int32_t k = 1; k <= WORDS; ++k)
        top[-k] = PAINT;
    run();
    while (deepest > 0 && top[-deepest] == PAINT)
        --deepest;
    return (uint32_t)deepest * 4u;
}

#define DEFINE(name, type, call)                                                                             \
    type call_##name(uint32_t angle);                                                                        \
    type __attribute__((noinline)) call_##name(uint32_t angle)                                               \
    {                                                                                                        \
        return call;                                                                                         \
    }                                                                                                        \
    static type (*volatile pointer_##name)(uint32_t) = call_##name; /* not seen through */                   \
    static void loop_##name(void)                                                                            \
    {                                                                                                        \
        uint32_t angle = 0u;                                                                                 \
        for (uint32_t k = 0u; k < CALLS; ++k, angle += STEP)                                                 \
            (void)pointer_##name(angle);                                                                     \
    }
TABLES(DEFINE)

static void __attribute__((noinline)) nothing_at(uint32_t angle)
{
    __asm__ volatile("" : : "r"(angle));
}
static void (*volatile pointer_nothing)(uint32_t) = nothing_at;

static void loop_nothing(void)
{
    uint32_t angle = 0u;
    for (uint32_t k = 0u; k < CALLS; ++k, angle += STEP)
        pointer_nothing(angle);
}

static void print(const char *name, void (*loop)(void))
{
    printf("%s %.0f %" PRIu32 "\n", name, (double)(cost_of(loop) - cost_of(loop_nothing)) / CALLS,
           depth_of(loop) - depth_of(loop_nothing));
}
#define PRINT(name, type, call) print(#name, loop_##name);

/* ---- what runs beside a table ---- */

static hci_counter counter;
static hci_foc_pi controller = {5.0f, 0.14f, 0.028f, 0.0f, 0.0f};
static hci_guard_change change = {1u, 0.5f, 0.0f};

static hci_currents_abc phases_at(uint32_t angle)
{
    const float x = (float)(int32_t)angle * 1e-8f;
    const hci_currents_abc i = {x, 1.0f - x, -1.0f};
    return i;
}

static hci_currents_dq vector_at(uint32_t angle)
{
    const float x = (float)(int32_t)angle * 1e-8f;
    const hci_currents_dq i = {x, 20.0f - x};
    return i;
}

static hci_currents_dq frames(uint32_t angle)
{
    float sine, cosine;
    hci_angle_sine_cosine(angle, &sine, &cosine);
    return hci_foc_currents(phases_at(angle), sine, cosine);
}

static hci_voltages_dq control(uint32_t angle)
{
    const hci_voltages_dq none = {0.0f, 0.0f};
    return hci_foc_step(&controller, vector_at(angle), none, 50.0f);
}

static hci_currents_dq blend(uint32_t angle)
{
    const hci_currents_dq a = vector_at(angle), b = {1.0f, 2.0f};
    return hci_guard_blend_dq(a, b, hci_guard_change_next(&change));
}

static hci_units_abc units_at(uint32_t angle)
{
    const hci_units_abc i = {(int16_t)(angle >> 16), (int16_t)(angle >> 15), (int16_t)(angle >> 14)};
    return i;
}

/* X(name, type, call, what of the same arguments is subtracted with the call). */
#define BESIDE(X)                                                                                            \
    X(counter_16_bits, uint32_t, hci_counter_angle(&counter, (angle >> 20) & 0xFFFFu), none)                 \
    X(sine_cosine_and_frames, hci_currents_dq, frames(angle), phases)                                        \
    X(controller_of_both_axes, hci_voltages_dq, control(angle), vector)                                      \
    X(limit_dq, hci_currents_dq, hci_guard_dq(vector_at(angle), 10.0f), vector)                              \
    X(limit_abc, hci_currents_abc, hci_guard_abc(phases_at(angle), 10.0f), phases)                           \
    X(limit_abc_integers, hci_units_abc, hci_guard_units_abc(units_at(angle), 20000u), units)                \
    X(change_of_tables_dq, hci_currents_dq, blend(angle), vector)
#define FIXED(X)                                                                                             \
    X(none, uint32_t, angle)                                                                                 \
    X(phases, hci_currents_abc, phases_at(angle))                                                            \
    X(vector, hci_currents_dq, vector_at(angle))                                                             \
    X(units, hci_units_abc, units_at(angle))
FIXED(DEFINE)
#define DEFINE_BESIDE(name, type, call, fixed) DEFINE(name, type, call)
BESIDE(DEFINE_BESIDE)
#define PRINT_BESIDE(name, type, call, fixed)                                                                \
    printf("beside %s %.0f\n", #name, (double)(cost_of(loop_##name) - cost_of(loop_##fixed)) / CALLS);

/* Checks at start-up, CHECKS(X) of tables.h: X(name, function). */
#define DEFINE_CHECK(name, function)                                                                         \
    static void check_##name(void)                                                                           \
    {                                                                                                        \
        if (function(&name) != HCI_TABLE_GOOD) _Exit(EXIT_FAILURE);                                          \
    }
CHECKS(DEFINE_CHECK)
#define PRINT_CHECK(name, function) printf("beside check_%s %" PRIu32 "\n", #name, cost_of(check_##name));

int main(void)
{
#if !defined(__riscv)
    ticks_start();
#endif
    hci_counter_start(&counter, hci_counter_range(16u), 4000u, 1, 0u);
    TABLES(PRINT)
    BESIDE(PRINT_BESIDE)
    CHECKS(PRINT_CHECK)
    printf("done\n");
    fflush(stdout);
    return EXIT_SUCCESS;
}
