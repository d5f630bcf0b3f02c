/* A shaft that a speed control turns slowly, two turns each way, and what it learns of its cogging: the same
 * program for the build machine and for a target, in single precision. The machine is machine.h, made of the
 * tables of a folder.
 *
 * Prints the torque ripple without and with the table that was learnt, what was learnt order by order, the
 * blob in hexadecimal, and on a target what it costs. */
#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>

#include "hci/learn.h"
#include "machine.h" /* BACK_EMF, COGGING: lists of {electrical order, amplitude, phase}; POLE_PAIRS */

#ifdef ON_TARGET
#include "measure.h"
#endif

enum { POINTS = 4096, ORDERS = 16, EVERY = 12, TABLE_POINTS = 512, RATE_Hz = 2000, TURNS = 2 };

/* 2 rpm; an inertia, a friction and a speed control of 50 Hz that this machine could have. */
static const float SPEED_rad_per_s = 0.209f, INERTIA_kgm2 = 2e-3f, COULOMB_Nm = 0.08f,
                   BANDWIDTH_rad_per_s = 314.0f;

static float torque_per_A[POINTS + 1], cogging_Nm[POINTS + 1];

/* ---- the machine ---- */

static float sine(float angle_rad)
{
    float s, c;
    hci_angle_sine_cosine(hci_angle_from_rad(angle_rad), &s, &c);
    return s;
}

/* Torque of 1 A of i_q, and cogging torque, at a point of the mechanical turn. */
static void make_point(int k)
{
    const float theta_rad = 6.28318531f * (float)POLE_PAIRS * (float)(k % POINTS) / (float)POINTS;
    torque_per_A[k] = cogging_Nm[k] = 0.0f;
    for (size_t n = 0; n < sizeof BACK_EMF / sizeof *BACK_EMF; ++n)
        for (int s = 0; s < 3; ++s) {
            const float x = theta_rad - 2.09439510f * (float)s;
            torque_per_A[k] += BACK_EMF[n][1] * sine(BACK_EMF[n][0] * x + BACK_EMF[n][2]) * sine(x);
        }
    for (size_t n = 0; n < sizeof COGGING / sizeof *COGGING; ++n)
        cogging_Nm[k] += COGGING[n][1] * sine(COGGING[n][0] * theta_rad + COGGING[n][2]);
}

static float at(const float *table, uint32_t angle)
{
    const uint32_t k = angle >> 20;
    const float way = (float)(angle & 0xFFFFFu) / 1048576.0f;
    return table[k] + way * (table[k + 1u] - table[k]);
}

/* ---- the drive ---- */

static struct {
    uint32_t angle; /* mechanical */
    float speed_rad_per_s, integral_A, iq_A;
    uint32_t noise;
} drive;

static uint16_t orders[ORDERS];
static hci_learn_sums sums[ORDERS + 1];
static hci_learn learn;

/* A uniform number of a deviation of 20 mA. */
static float noise_A(void)
{
    drive.noise = drive.noise * 1664525u + 1013904223u;
    return ((float)(drive.noise >> 8) / 16777216.0f - 0.5f) * 0.0693f;
}

/* One sample: the shaft moves by the current that flows; the control sees the speed and sets the next. */
static void step(int direction)
{
    const float dt_s = 1.0f / (float)RATE_Hz, gain = INERTIA_kgm2 / 0.21f; /* by the mean torque per ampere */
    const float friction = drive.speed_rad_per_s / 0.01f;
    const float torque = at(torque_per_A, drive.angle) * drive.iq_A + at(cogging_Nm, drive.angle) -
                         COULOMB_Nm * hci_guard_clamp(friction, -1.0f, 1.0f);
    drive.speed_rad_per_s += torque / INERTIA_kgm2 * dt_s;
    drive.angle += (uint32_t)(int32_t)(drive.speed_rad_per_s * dt_s * 683565275.6f); /* 2^32/2π */
    const float error = (float)direction * SPEED_rad_per_s - drive.speed_rad_per_s;
    drive.integral_A += gain * BANDWIDTH_rad_per_s * BANDWIDTH_rad_per_s * error * dt_s;
    drive.iq_A = 2.0f * gain * BANDWIDTH_rad_per_s * error + drive.integral_A;
}

static void turn(int direction)
{
    for (int k = 0; k < RATE_Hz; ++k)
        step(direction);
    hci_learn_turn(&learn, direction);
    while ((direction > 0 ? learn.turns_forward : learn.turns_backward) < TURNS) {
        step(direction);
        hci_learn_sample(&learn, drive.angle & 0xFFFF0000u,
                         drive.iq_A + noise_A()); /* an encoder of 16 bits */
        (void)hci_learn_work(&learn);
    }
    hci_learn_turn(&learn, 0);
}

/* ---- what came of it ---- */

static float rows[2 * (TABLE_POINTS + 1)];
static hci_table_f32 table;

/* Largest less smallest torque without a load, with so much of the table. */
static float ripple_Nm(float share)
{
    float most = -1e9f, least = 1e9f;
    for (uint32_t k = 0; k < 5000; ++k) {
        const uint32_t angle = k * 858993u;
        const float i = hci_table_f32_dq(&table, angle * EVERY).iq_A;
        const float torque = at(cogging_Nm, angle) + share * at(torque_per_A, angle) * i;
        if (torque > most) most = torque;
        if (torque < least) least = torque;
    }
    return most - least;
}

static void print_blob(void)
{
    static unsigned char bytes[HCI_LEARN_HEAD + ORDERS * HCI_LEARN_ORDER + 4];
    const hci_learn_facts facts = {1, POLE_PAIRS, HCI_LEARN_AMPERE, SPEED_rad_per_s};
    const uint32_t size = hci_learn_write(&learn, &facts, bytes, sizeof bytes);
    printf("blob ");
    for (uint32_t k = 0; k < size; ++k)
        printf("%02x", (unsigned)bytes[k]);
    printf("\n");
}

#ifdef ON_TARGET
static void sample_often(void)
{
    for (uint32_t k = 0; k < 1000; ++k)
        hci_learn_sample(&learn, drive.angle, 1.0f);
}

static void one_step(void)
{
    hci_learn_sample(&learn, drive.angle + 0x200000u, 1.0f);
}

static void work(void)
{
    (void)hci_learn_work(&learn);
}

static void make_table(void)
{
    const hci_learn_table_options options = {TABLE_POINTS, POLE_PAIRS, EVERY, 6.0f, 1};
    (void)hci_learn_table(&learn, &options, rows, &table);
}

static double instructions(void (*run)(void))
{
    const uint32_t start = ticks_now();
    run();
    return (double)ticks_between(start, ticks_now()) * INSTRUCTIONS_PER_TICK;
}

static void print_costs(void)
{
    ticks_start();
    hci_learn_turn(&learn, 1);
    hci_learn_sample(&learn, drive.angle, 1.0f);
    printf("cost sample %.0f\n", instructions(sample_often) / 1000.0);
    printf("cost step %.0f\n", instructions(one_step));
    printf("cost work %.0f stack %" PRIu32 "\n", instructions(work), stack_of(work));
    printf("cost table %.0f\n", instructions(make_table));
    printf("bytes %u\n", (unsigned)(sizeof learn + sizeof sums));
}
#endif

int main(void)
{
    const hci_learn_table_options options = {TABLE_POINTS, POLE_PAIRS, EVERY, 6.0f, 1};
    for (int k = 0; k <= POINTS; ++k)
        make_point(k);
    for (uint32_t k = 0; k < ORDERS; ++k)
        orders[k] = (uint16_t)(EVERY * (k + 1));
    hci_learn_start(&learn, orders, ORDERS, sums, 4096);
    turn(1);
    turn(-1);
    const uint32_t taken = hci_learn_table(&learn, &options, rows, &table);
    if (taken == 0 || hci_table_f32_check(&table) != HCI_TABLE_GOOD) return EXIT_FAILURE;
    for (uint32_t k = 0; k <= ORDERS; ++k) {
        hci_learn_result x = {0, {0.0f, 0.0f}, {0.0f, 0.0f}, 0.0f};
        (void)hci_learn_result_of(&learn, k, &x);
        printf("order %" PRIu32 " %.6g %.6g %.6g %.3g\n", x.order, (double)x.cogging[0], (double)x.cogging[1],
               (double)x.friction[0], (double)x.error);
    }
    printf("orders %" PRIu32 "\nripple %.6g %.6g\n", taken, (double)ripple_Nm(0.0f), (double)ripple_Nm(1.0f));
    print_blob();
#ifdef ON_TARGET
    print_costs();
#endif
    printf("done\n");
    fflush(stdout);
    return EXIT_SUCCESS;
}
