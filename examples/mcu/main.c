/* Checks the tables, prints currents for a host to compare, and measures what an evaluation costs. */
#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>

#include "current_reference.h"
#include "currents_abc.h"
#include "currents_dq.h"
#include "currents_torque.h"
#include "measure.h"

enum { ANGLES = 200, CALLS = 10000 };
static const uint32_t STEP =
    2654435769u; /* the golden ratio of a turn: calls come to all parts of the table */
static const float TORQUE_Nm = 1.25f;

static void print_check(const char *name, const hci_table_f32 *table)
{
    static const char *const words[] = {"good", "bad-shape", "bad-crc", "bad-probe"};
    printf("check %s %s points %" PRIu32 " max_error_A %.9g reference_torque_Nm %.9g\n", name,
           words[hci_table_f32_check(table)], table->points, (double)table->max_error_A,
           (double)table->reference_torque_Nm);
}

static void print_currents_at(uint32_t angle)
{
    const hci_currents_abc abc = reference_abc(angle);
    const hci_currents_dq dq = reference_dq(angle);
    const hci_currents_abc torque = reference_torque(angle, TORQUE_Nm);
    printf("abc %" PRIu32 " 0 %.9g %.9g %.9g\n", angle, (double)abc.ia_A, (double)abc.ib_A, (double)abc.ic_A);
    printf("dq %" PRIu32 " 0 %.9g %.9g 0\n", angle, (double)dq.id_A, (double)dq.iq_A);
    printf("torque %" PRIu32 " %.9g %.9g %.9g %.9g\n", angle, (double)TORQUE_Nm, (double)torque.ia_A,
           (double)torque.ib_A, (double)torque.ic_A);
}

#define DEFINE_LOOP(name, call)                                                                              \
    static void name(void)                                                                                   \
    {                                                                                                        \
        uint32_t angle = 0u;                                                                                 \
        for (uint32_t k = 0u; k < CALLS; ++k, angle += STEP)                                                 \
            (void)call;                                                                                      \
    }

DEFINE_LOOP(loop_nothing, nothing(angle))
DEFINE_LOOP(loop_nothing_torque, nothing_torque(angle, TORQUE_Nm))
DEFINE_LOOP(loop_abc, reference_abc(angle))
DEFINE_LOOP(loop_dq, reference_dq(angle))
DEFINE_LOOP(loop_torque, reference_torque(angle, TORQUE_Nm))

static uint32_t ticks_of(void (*loop)(void))
{
    const uint32_t start = ticks_now();
    loop();
    return ticks_between(start, ticks_now());
}

/* What `loop` costs a call above `empty`: the body without call and return. */
static void print_cost(const char *name, void (*loop)(void), void (*empty)(void))
{
    const uint32_t ticks = ticks_of(loop) - ticks_of(empty);
    printf("cost %s instructions %.2f stack_bytes %" PRIu32 "\n", name,
           (double)ticks * (double)INSTRUCTIONS_PER_TICK / (double)CALLS, stack_of(loop) - stack_of(empty));
}

int main(void)
{
    print_check("abc", &currents_abc);
    print_check("dq", &currents_dq);
    print_check("torque", &currents_torque);
    if (!reference_good()) return EXIT_FAILURE;
    for (uint32_t k = 0u; k < ANGLES; ++k)
        print_currents_at(k * STEP);
    print_currents_at(0x80000000u);
    print_currents_at(0xFFFFFFFFu);
    ticks_start();
    print_cost("abc", loop_abc, loop_nothing);
    print_cost("dq", loop_dq, loop_nothing);
    print_cost("torque", loop_torque, loop_nothing_torque);
    printf("done\n");
    fflush(stdout);
    return EXIT_SUCCESS;
}
