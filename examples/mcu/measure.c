#include "measure.h"

static volatile uint32_t *const SYST_CSR = (volatile uint32_t *)0xE000E010u;
static volatile uint32_t *const SYST_RVR = (volatile uint32_t *)0xE000E014u;
static volatile uint32_t *const SYST_CVR = (volatile uint32_t *)0xE000E018u;

void ticks_start(void)
{
    *SYST_RVR = 0xFFFFFFu;
    *SYST_CVR = 0u;
    *SYST_CSR = 5u; /* core clock, no interrupt */
}

uint32_t ticks_now(void)
{
    return *SYST_CVR;
}

/* SysTick counts down. */
uint32_t ticks_between(uint32_t start, uint32_t end)
{
    return (start - end) & 0xFFFFFFu;
}

/* Paints the stack below this frame, runs, and looks how far down the paint is gone. */
uint32_t stack_of(void (*run)(void))
{
    enum { WORDS = 256, PAINT = 0x5AA5C33C };
    uintptr_t stack_pointer;
    __asm__ volatile("mov %0, sp" : "=r"(stack_pointer));
    volatile uint32_t *const top = (volatile uint32_t *)stack_pointer;
    for (int32_t k = 1; k <= WORDS; ++k)
        top[-k] = PAINT;
    run();
    int32_t deepest = WORDS;
    while (deepest > 0 && top[-deepest] == PAINT)
        --deepest;
    return (uint32_t)deepest * 4u;
}

void nothing(uint32_t angle)
{
    (void)angle;
}

void nothing_torque(uint32_t angle, float torque_Nm)
{
    (void)angle;
    (void)torque_Nm;
}
