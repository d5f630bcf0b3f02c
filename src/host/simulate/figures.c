/* The figures of a simulation from its integrals: statistics, losses, energies, spectrum, and what a reader
 * must know of them. */
#include <math.h>
#include <stdio.h>

#include "host/base/memory.h"
#include "host/currents/plain_sine.h"
#include "host/simulate/evaluation.h"

static hci_statistics statistics(double mean, double mean_square, const hci_integrals *x, int extreme)
{
    return (hci_statistics){mean, sqrt(fmax(mean_square, 0.0)), x->most[extreme], x->least[extreme]};
}

/* A mean that is a smaller share than this of the swing about it is no measure for a ripple. */
#define LEAST_MEAN 0.01

/* A mean that is a smaller share than this of the torques that it is the sum of is rounding. */
#define ROUNDING 1e-12

/* The largest torque, and the cogging torque, which currents may cancel. */
static double size_of_torque_Nm(const hci_machine *machine, const hci_integrals *x)
{
    double size = fmax(fabs(x->most[HCI_EXTREME_TORQUE]), fabs(x->least[HCI_EXTREME_TORQUE]));
    for (size_t k = 0; k < machine->cogging_count; ++k)
        size += hci_amplitude(machine->cogging[k].sine, machine->cogging[k].cosine);
    return size;
}

static double mean_torque_Nm(const hci_evaluation *e, const hci_integrals *x, double offset_Nm)
{
    const double mean_Nm = e->reference_Nm + offset_Nm;
    return fabs(mean_Nm) > ROUNDING * size_of_torque_Nm(e->setup->machine, x) ? mean_Nm : 0.0;
}

static void give_statistics(const hci_evaluation *e, const hci_integrals *x, double time_s, hci_simulation *s)
{
    const double *sum = x->integral, offset = sum[HCI_INTEGRAL_TORQUE] / time_s,
                 mean = mean_torque_Nm(e, x, offset);
    const double variance = fmax(sum[HCI_INTEGRAL_TORQUE_2] / time_s - offset * offset, 0.0);
    s->torque_Nm = statistics(mean, mean * mean + variance, x, HCI_EXTREME_TORQUE);
    s->current_A = statistics(sum[HCI_INTEGRAL_LENGTH] / time_s, sum[HCI_INTEGRAL_LENGTH_2] / time_s, x,
                              HCI_EXTREME_LENGTH);
    s->current_dqx_A =
        statistics(sum[HCI_INTEGRAL_DQX] / time_s, sum[HCI_INTEGRAL_DQX_2] / time_s, x, HCI_EXTREME_DQX);
    s->speed_rad_per_s = statistics(sum[HCI_INTEGRAL_SPEED] / time_s, sum[HCI_INTEGRAL_SPEED_2] / time_s, x,
                                    HCI_EXTREME_SPEED);
    s->peak_phase_A = x->most[HCI_EXTREME_PHASE];
    const double swing = s->torque_Nm.most - s->torque_Nm.least;
    const bool has_mean = fabs(mean) > LEAST_MEAN * swing && mean != 0.0;
    s->T_ripple_percent = has_mean ? 100.0 * swing / fabs(mean) : (double)NAN;
    s->F_ripple_percent = has_mean ? 100.0 * sqrt(variance) / fabs(mean) : (double)NAN;
}

static void give_losses(const hci_evaluation *e, hci_simulation *s)
{
    const hci_wave sine = hci_plain_sine(e->setup->machine, s->torque_Nm.mean);
    const double square = s->current_A.rms * s->current_A.rms, plain = hci_amplitude(sine.sine, sine.cosine);
    s->copper_W = 1.5 * e->setup->drive.plant.resistance_ohm * square;
    s->plain_amplitude_A = plain;
    s->loss_to_plain = isfinite(s->T_ripple_percent) && plain > 0.0 ? square / (plain * plain) : (double)NAN;
}

static void give_control(const hci_evaluation *e, const hci_integrals *x, double time_s, hci_simulation *s)
{
    const hci_control *control = &e->setup->drive.control;
    const double sample_s = control->step_s * (control->current_every > 0 ? control->current_every : 1u);
    s->switching_frequency_Hz =
        control->loop == HCI_CURRENT_HYSTERESIS
            ? (double)(x->at.counts.switchings - e->first.counts.switchings) / (6.0 * time_s)
            : (double)NAN;
    s->samples = (size_t)(time_s / sample_s + 0.5);
    s->without_current = (size_t)(x->at.counts.without_current - e->first.counts.without_current);
    s->voltage_limited = (size_t)(x->at.counts.voltage_limited - e->first.counts.voltage_limited);
    s->limited = (size_t)(x->at.counts.limited - e->first.counts.limited);
    s->without_current_from_start = (size_t)e->running.at.counts.without_current;
    s->limited_from_start = (size_t)e->running.at.counts.limited;
}

static void give_energies(const hci_evaluation *e, const hci_integrals *x, double time_s, hci_simulation *s)
{
    const hci_setup *setup = e->setup;
    const bool has_voltage = setup->drive.control.loop != HCI_CURRENT_IDEAL;
    hci_energies *j = &s->energy_J;
    j->electrical = has_voltage ? x->electrical_J : (double)NAN;
    j->copper = s->copper_W * time_s;
    j->stored = setup->has_inductance && !setup->attachment
                    ? x->at.magnetic_J - e->first.magnetic_J - x->integral[HCI_INTEGRAL_COGGING]
                    : (double)NAN;
    j->mechanical = x->integral[HCI_INTEGRAL_SHAFT];
    j->load = setup->prescribed ? (double)NAN : x->integral[HCI_INTEGRAL_LOAD];
    j->friction = setup->prescribed ? (double)NAN : x->integral[HCI_INTEGRAL_FRICTION];
    j->kinetic = setup->prescribed
                     ? (double)NAN
                     : 0.5 * setup->drive.plant.inertia_kgm2 * (x->at.speed_squared - e->first.speed_squared);
    j->residual = j->electrical - j->copper - j->stored - j->mechanical;
}

/* Largest share of the energies that may be lost to the step. */
#define LARGEST_IMBALANCE 0.01

static void check_balance(hci_simulation *s)
{
    const hci_energies *j = &s->energy_J;
    const double all = fabs(j->electrical) + fabs(j->copper) + fabs(j->mechanical);
    s->energy_balances = !(fabs(j->residual) > LARGEST_IMBALANCE * all);
    if (!s->energy_balances)
        hci_note_add(
            &s->remark,
            "the energy does not balance within 1 %%, so these figures mean nothing; give a smaller step");
}

static void check_speed(const hci_evaluation *e, hci_simulation *s)
{
    const double wanted = e->setup->set_point, mean = s->speed_rad_per_s.mean;
    if (!e->setup->drive.control.speed_controlled || fabs(mean - wanted) <= 0.01 * fabs(wanted)) return;
    hci_note_add(&s->remark, "the speed is %.5g rpm on average, not the %.5g rpm asked for",
                 mean * 30.0 / HCI_PI, wanted * 30.0 / HCI_PI);
}

/* Orders whose period has at least this many steps at the highest speed are in the spectrum. */
#define STEPS_OF_A_PERIOD 4.0

static size_t trusted_orders(const hci_evaluation *e, hci_simulation *s)
{
    const double speed = fmax(fabs(s->speed_rad_per_s.most), fabs(s->speed_rad_per_s.least));
    const double turn_s = 2.0 * HCI_PI / (e->setup->drive.plant.table.pole_pairs * speed);
    const double most = (double)e->setup->period_turns * turn_s / (STEPS_OF_A_PERIOD * s->step_s);
    if (most >= (double)(e->orders - 1)) return e->orders;
    hci_note_add(
        &s->remark,
        "the spectrum ends at order %g, above which a period has fewer than 4 steps; what the torque "
        "has there folds onto the orders below, so give a smaller step",
        floor(most) / (double)e->setup->period_turns);
    return (size_t)most + 1;
}

/* Where the rotor turns backwards both dθ and Θ are negative. */
static void give_spectrum(const hci_evaluation *e, hci_simulation *s)
{
    const double *pair = e->whole.integral + HCI_INTEGRAL_SPECTRUM,
                 theta_rad = e->setup->drive.plant.table.pole_pairs * e->whole.integral[HCI_INTEGRAL_SPEED];
    for (size_t n = 0; n < e->orders; ++n) {
        const double scale = e->setup->drive.plant.table.pole_pairs * (n == 0 ? 1.0 : 2.0) / theta_rad;
        s->spectrum_Nm[n].order = (double)n / (double)e->setup->period_turns;
        s->spectrum_Nm[n].sine = scale * pair[2 * n];
        s->spectrum_Nm[n].cosine = scale * pair[2 * n + 1];
    }
    s->spectrum_Nm[0].sine = 0.0;
    s->spectrum_Nm[0].cosine += e->reference_Nm;
    s->spectrum_count = trusted_orders(e, s);
}

hci_status hci_evaluation_finish(hci_evaluation *e, hci_simulation *s, hci_note *note)
{
    const hci_integrals *x = e->periods > 0 ? &e->whole : &e->running;
    const double time_s = x->at.time_s - e->first.time_s;
    s->step_s = e->setup->drive.control.step_s;
    s->from_s = e->first.time_s;
    s->to_s = x->at.time_s;
    s->periods = e->periods;
    s->period_turns = e->setup->period_turns;
    give_statistics(e, x, time_s, s);
    give_losses(e, s);
    give_control(e, x, time_s, s);
    give_energies(e, x, time_s, s);
    check_balance(s);
    check_speed(e, s);
    if (e->periods == 0) return HCI_OK;
    s->spectrum_Nm = hci_memory_new(e->orders, sizeof *s->spectrum_Nm);
    if (!s->spectrum_Nm) return hci_note_memory(note, NULL, "%zu orders", e->orders);
    give_spectrum(e, s);
    return HCI_OK;
}
