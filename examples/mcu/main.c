/* Checks the tables, prints currents for a host to compare, and measures what an evaluation costs. */
#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>

#include "current_loop.h"
#include "current_reference.h"
#include "currents_abc.h"
#include "currents_dq.h"
#include "currents_drive.h"
#include "currents_torque.h"
#include "hci/foc.h"
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

static const float SPEED_rad_per_s = 60.0f;

static float larger(float x, float y)
{
    const float size = hci_guard_size(y);
    return size > x ? size : x;
}

/* At a standstill the references of the loop are those of the table by torque, in the rotor frame; at a speed
 * those of an angle that is ahead by the speed times the loop's delay. */
static void print_loop(void)
{
    float standing_A = 0.0f, moving_A = 0.0f;
    const uint32_t ahead = hci_angle_from_rad(SPEED_rad_per_s * currents_drive.lead_s);
    for (uint32_t k = 0u; k < ANGLES; ++k) {
        float sine, cosine;
        const uint32_t angle = k * STEP;
        const hci_currents_dq still = current_loop_reference(angle + ahead, TORQUE_Nm, 0.0f);
        const hci_currents_dq moving = current_loop_reference(angle, TORQUE_Nm, SPEED_rad_per_s);
        hci_angle_sine_cosine(angle + ahead, &sine, &cosine);
        const hci_currents_dq table =
            hci_foc_currents(reference_torque(angle + ahead, TORQUE_Nm), sine, cosine);
        standing_A = larger(larger(standing_A, still.id_A - table.id_A), still.iq_A - table.iq_A);
        moving_A = larger(larger(moving_A, still.id_A - moving.id_A), still.iq_A - moving.iq_A);
    }
    printf("loop standing_A %.4f moving_A %.6f lead_us %.4f\n", (double)standing_A, (double)moving_A,
           1e6 * (double)currents_drive.lead_s);
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
DEFINE_LOOP(loop_lead, current_loop_reference(angle, TORQUE_Nm, SPEED_rad_per_s))

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
    if (!reference_good() || !current_loop_start()) return EXIT_FAILURE;
    for (uint32_t k = 0u; k < ANGLES; ++k)
        print_currents_at(k * STEP);
    print_currents_at(0x80000000u);
    print_currents_at(0xFFFFFFFFu);
    print_loop();
    ticks_start();
    print_cost("abc", loop_abc, loop_nothing);
    print_cost("dq", loop_dq, loop_nothing);
    print_cost("torque", loop_torque, loop_nothing_torque);
    print_cost("lead", loop_lead, loop_nothing_torque);
    printf("done\n");
    fflush(stdout);
    return EXIT_SUCCESS;
}
