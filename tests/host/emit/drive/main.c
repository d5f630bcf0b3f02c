/* A drive that is turned at a constant speed, with the references of an emitted table: the same program for
 * the build machine and for a target, so that both can be compared. The machine is machine.h, made of the
 * tables of a folder.
 *
 * Prints, for each remedy, current and torque at some samples and the ripple over a mechanical turn; on a
 * target also what an evaluation costs. */
#include <inttypes.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "hci/drive/control.h"
#include "hci/machine/frames.h"
#include "machine.h" /* BACK_EMF, COGGING: lists of {order, amplitude, phase}; POLE_PAIRS, L_H, R_OHM, DC_LINK_V */
#include "smooth.h"

#ifdef ON_TARGET
#include "measure.h"
#endif

enum { POINTS = 512, STEPS = 10, SETTLE = 800, SAMPLES_SHOWN = 40 };

static const double SPEED_RPM = 300.0;

static double rows[12 * (POINTS + 1)];
static hci_wave back_emf[sizeof BACK_EMF / sizeof *BACK_EMF];
static hci_harmonic cogging[sizeof COGGING / sizeof *COGGING];
static float memory[smooth_FLOATS];
static hci_loop_tables tables;

static void ask_table(void *context, const hci_measurement *measured, double torque_Nm,
                      hci_reference_dq *reference)
{
    const uint32_t mechanical = (uint32_t)(measured->theta_m_rad / (2.0 * HCI_PI) * 4294967295.0);
    const hci_loop_reference r =
        hci_loop_at(&tables, hci_angle_from_mechanical(mechanical, POLE_PAIRS / smooth.period_turns),
                    (float)torque_Nm, (float)(measured->speed_rad_per_s * POLE_PAIRS));
    (void)context;
    reference->i_A[0] = (double)r.id_A;
    reference->i_A[1] = (double)r.iq_A;
    reference->v_V[0] = (double)r.vd_V;
    reference->v_V[1] = (double)r.vq_V;
}

static int make_plant(hci_plant *plant)
{
    const hci_plant_inductance inductance = {NULL, 0, L_H, L_H};
    for (size_t k = 0; k < sizeof BACK_EMF / sizeof *BACK_EMF; ++k)
        back_emf[k] = hci_wave_polar(BACK_EMF[k][0], hci_sequence_of_order(BACK_EMF[k][0]), BACK_EMF[k][1],
                                     BACK_EMF[k][2]);
    for (size_t k = 0; k < sizeof COGGING / sizeof *COGGING; ++k)
        cogging[k] = hci_harmonic_polar(COGGING[k][0], COGGING[k][1], COGGING[k][2]);
    const hci_machine machine = {.pole_pairs = POLE_PAIRS,
                                 .back_emf = back_emf,
                                 .back_emf_count = sizeof back_emf / sizeof *back_emf,
                                 .cogging = cogging,
                                 .cogging_count = sizeof cogging / sizeof *cogging};
    memset(plant, 0, sizeof *plant);
    plant->resistance_ohm = R_OHM;
    plant->inertia_kgm2 = HUGE_VAL;
    return hci_plant_table_fill(&machine, &inductance, POINTS, rows, &plant->table) == HCI_OK;
}

static void make_control(hci_drive *drive, const hci_current_source *source)
{
    hci_control *c = &drive->control;
    memset(c, 0, sizeof *c);
    c->table = &drive->plant.table;
    c->step_s = (double)smooth.sample_s / STEPS;
    c->dc_link_V = DC_LINK_V;
    c->torque_limit_Nm = c->id_limit = c->iq_limit = c->peak_limit_A = HUGE_VAL;
    c->sources = source;
    c->source_count = 1;
    c->current_every = STEPS;
    c->loop = HCI_CURRENT_PI;
    for (int axis = 0; axis < 2; ++axis)
        c->current.pi[axis] =
            (hci_pi){(double)smooth.proportional_ohm[axis], (double)smooth.integral_ohm_per_s[axis]};
    c->current.filter = (double)smooth.filter;
    c->current.decoupled = true;
    c->current.delay_steps = STEPS;
}

static void run(hci_drive *drive, hci_loop_remedy remedy, const char *name)
{
    const double speed = SPEED_RPM * HCI_PI / 30.0, torque_Nm = (double)smooth.torque_high_Nm;
    const long samples = (long)(2.0 * HCI_PI / speed / (double)smooth.sample_s);
    double most = -HUGE_VAL, least = HUGE_VAL, sum = 0.0;
    hci_drive_state state;
    memset(&state, 0, sizeof state);
    state.plant.speed_rad_per_s = speed;
    hci_loop_start(&tables, &smooth, remedy, memory);
    hci_loop_make(&tables, (float)(speed * POLE_PAIRS));
    for (long k = 0; k < (SETTLE + samples) * STEPS; ++k) {
        const long sample = k / STEPS - SETTLE;
        hci_drive_step(drive, &state, torque_Nm, 0.0);
        if (sample < 0) continue;
        most = fmax(most, state.torque_Nm);
        least = fmin(least, state.torque_Nm);
        sum += state.torque_Nm;
        if (k % STEPS == 0 && sample % (samples / SAMPLES_SHOWN) == 0)
            printf("%s %ld %.9g %.9g %.9g\n", name, sample, state.plant.i[0], state.plant.i[1],
                   state.torque_Nm);
    }
    printf("ripple %s %.6g\n", name, 100.0 * (most - least) * (double)(samples * STEPS) / sum);
}

#ifdef ON_TARGET
enum { CALLS = 2000 };

static volatile float seen;

static void evaluate(void)
{
    for (uint32_t k = 0; k < CALLS; ++k) {
        const hci_loop_reference r = hci_loop_at(&tables, k * 2654435769u, 1.0f, 62.8f);
        seen = r.id_A + r.iq_A + r.vd_V + r.vq_V;
    }
}

static void print_cost(hci_loop_remedy remedy, const char *name)
{
    hci_loop_start(&tables, &smooth, remedy, memory);
    hci_loop_make(&tables, 62.8f);
    const uint32_t start = ticks_now();
    evaluate();
    const uint32_t middle = ticks_now();
    hci_loop_make(&tables, 63.8f);
    const uint32_t end = ticks_now();
    printf("cost %s evaluation %.0f tables %.0f\n", name,
           (double)ticks_between(start, middle) * INSTRUCTIONS_PER_TICK / CALLS,
           (double)ticks_between(middle, end) * INSTRUCTIONS_PER_TICK);
}
#endif

int main(void)
{
    static const char *const NAMES[] = {"table", "lead", "compensation", "feedforward"};
    static hci_drive drive;
    const hci_reference_code code = {ask_table, NULL};
    const hci_current_source source = {.code = &code};
    if (hci_loop_check(&smooth) != HCI_TABLE_GOOD || !make_plant(&drive.plant)) return EXIT_FAILURE;
    make_control(&drive, &source);
    for (int remedy = HCI_LOOP_TABLE; remedy <= HCI_LOOP_FEEDFORWARD; ++remedy)
        run(&drive, (hci_loop_remedy)remedy, NAMES[remedy]);
#ifdef ON_TARGET
    ticks_start();
    for (int remedy = HCI_LOOP_TABLE; remedy <= HCI_LOOP_FEEDFORWARD; ++remedy)
        print_cost((hci_loop_remedy)remedy, NAMES[remedy]);
#endif
    printf("done\n");
    fflush(stdout);
    return EXIT_SUCCESS;
}
