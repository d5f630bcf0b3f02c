/* Time and stack of a piece of code on the target. */
#ifndef MEASURE_H
#define MEASURE_H

#include <stdint.h>

/* SysTick at the core clock, 24 bits. Under `qemu -icount shift=0` an instruction takes 1 ns of the board's
 * 25 MHz clock: 40 instructions a tick. On silicon a tick is a cycle. */
enum { INSTRUCTIONS_PER_TICK = 40 };

void ticks_start(void);
uint32_t ticks_now(void);
uint32_t ticks_between(uint32_t start, uint32_t end);

/* Bytes of stack below the caller's that `run` touches. */
uint32_t stack_of(void (*run)(void));

/* Calls that do nothing, to subtract. */
void nothing(uint32_t angle);
void nothing_torque(uint32_t angle, float torque_Nm);

#endif
