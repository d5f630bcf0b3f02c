/* Integrals over the steady part, by the trapezoidal rule in time. They are taken where a period of the angle
 * ends, inside a step by the straight line between its ends: what repeats with the angle then leaks into
 * nothing, and the rule is of high order.
 *
 *     S_n, C_n = 2/Θ ∫ T (sin, cos)(nθ) dθ,   dθ = ω_e dt,   Θ = ∫ dθ
 */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "host/base/memory.h"
#include "host/simulate/simulation.h"
#include "host/solve/plain_sine.h"

/* What is integrated, before the spectrum's pairs. Torque is taken from its first value, so that a small
 * ripple keeps its digits. */
enum {
    TORQUE,
    TORQUE_2,
    LENGTH,
    LENGTH_2,
    DQX,
    DQX_2,
    SPEED,
    SPEED_2,
    SHAFT,
    COGGING,
    LOAD,
    FRICTION,
    SPECTRUM
};

/* What has an extreme. */
enum { MOST_TORQUE, MOST_LENGTH, MOST_DQX, MOST_SPEED, MOST_PHASE, EXTREMES };

typedef struct {
    double time_s, angle_rad, speed_rad_per_s;
    double i[2], v[2];
    double magnetic_J, speed_squared;
    hci_simulation_counts counts;
} level;

/* What has been reached at one instant. */
typedef struct {
    level at;
    double electrical_J;
    double most[EXTREMES], least[EXTREMES];
    double *integral;
} reached;

struct hci_evaluation {
    const hci_setup *setup;
    bool started;
    double reference_Nm; /* the first torque */
    size_t values, orders, periods;
    level first;
    double *before, *now;   /* integrands */
    reached running, whole; /* until now; until the last whole period */
    double *room;
};

hci_evaluation *hci_evaluation_new(const hci_setup *setup)
{
    hci_evaluation *e = hci_memory_new(1, sizeof *e);
    if (!e) return NULL;
    e->setup = setup;
    e->orders = setup->highest_order * setup->period_turns + 1;
    e->values = SPECTRUM + 2 * e->orders;
    e->room = hci_memory_new(4 * e->values, sizeof *e->room);
    if (!e->room) {
        hci_memory_free(e);
        return NULL;
    }
    e->before = e->room;
    e->now = e->before + e->values;
    e->running.integral = e->now + e->values;
    e->whole.integral = e->running.integral + e->values;
    for (int k = 0; k < EXTREMES; ++k) {
        e->running.most[k] = -HUGE_VAL;
        e->running.least[k] = HUGE_VAL;
    }
    return e;
}

void hci_evaluation_free(hci_evaluation *evaluation)
{
    if (!evaluation) return;
    hci_memory_free(evaluation->room);
    hci_memory_free(evaluation);
}

/* ---- integrands ---- */

/* T ω sin(nθ), T ω cos(nθ) for n = 0, 1/turns, 2/turns, … by turning the pair on. */
static void fill_spectrum(const hci_evaluation *e, double angle_rad, double weight, double *pair)
{
    const double s1 = sin(angle_rad / (double)e->setup->period_turns),
                 c1 = cos(angle_rad / (double)e->setup->period_turns);
    double s = 0.0, c = weight;
    for (size_t n = 0; n < e->orders; ++n) {
        const double next = s * c1 + c * s1;
        pair[2 * n] = s;
        pair[2 * n + 1] = c;
        c = c * c1 - s * s1;
        s = next;
    }
}

/* sqrt(i_dx² + i_qx²) = |e| |i| / sqrt(3/2), with the back-EMF that the controller knows. */
static double dqx_length(const hci_evaluation *e, double angle_rad, double length_A)
{
    const hci_plant_point p =
        hci_plant_table_at(e->setup->drive.control.table, angle_rad / e->setup->drive.plant.table.pole_pairs);
    return hypot(p.magnetic.e[0], p.magnetic.e[1]) * length_A;
}

static void fill(hci_evaluation *e, const hci_simulation_step *r)
{
    const hci_plant *plant = &e->setup->drive.plant;
    const double torque = r->torque_Nm - e->reference_Nm, speed = r->speed_rad_per_s;
    const double length = hypot(r->i_A[0], r->i_A[1]) * sqrt(2.0 / 3.0);
    double *now = e->now;
    now[TORQUE] = torque;
    now[TORQUE_2] = torque * torque;
    now[LENGTH] = length;
    now[LENGTH_2] = length * length;
    now[DQX] = dqx_length(e, r->theta_e_rad, length);
    now[DQX_2] = now[DQX] * now[DQX];
    now[SPEED] = speed;
    now[SPEED_2] = speed * speed;
    now[SHAFT] = r->torque_Nm * speed;
    now[COGGING] = r->point.magnetic.cogging_Nm * speed;
    now[LOAD] = r->load_Nm * speed;
    now[FRICTION] =
        (plant->viscous_Nms * speed + r->point.shaft_Nm) * speed + plant->coulomb_Nm * fabs(speed);
    fill_spectrum(e, r->theta_e_rad, torque * speed, now + SPECTRUM);
}

static void note_extreme(reached *x, int what, double value)
{
    x->most[what] = fmax(x->most[what], value);
    x->least[what] = fmin(x->least[what], value);
}

static void note_extremes(hci_evaluation *e, const hci_simulation_step *r)
{
    double abc[3];
    hci_plane_to_abc(r->i_A, abc);
    note_extreme(&e->running, MOST_TORQUE, r->torque_Nm);
    note_extreme(&e->running, MOST_LENGTH, e->now[LENGTH]);
    note_extreme(&e->running, MOST_DQX, e->now[DQX]);
    note_extreme(&e->running, MOST_SPEED, r->speed_rad_per_s);
    for (int s = 0; s < 3; ++s)
        note_extreme(&e->running, MOST_PHASE, fabs(abc[s]));
}

static level level_of(const hci_simulation_step *r)
{
    const double *l = r->point.inductance_H, *i = r->i_A;
    return (level){r->time_s,
                   r->theta_e_rad,
                   r->speed_rad_per_s,
                   {i[0], i[1]},
                   {r->v_V[0], r->v_V[1]},
                   0.5 * (l[0] * i[0] * i[0] + 2.0 * l[1] * i[0] * i[1] + l[2] * i[1] * i[1]),
                   r->speed_rad_per_s * r->speed_rad_per_s,
                   r->counts};
}

/* ---- integrals ---- */

/* Adds the part 0 … share of the step from `from` to `to`. Voltage is held over a step, current and the
 * integrands run straight. */
static void add_part(const hci_evaluation *e, const level *from, const level *to, double share, reached *x)
{
    const double h = share * (to->time_s - from->time_s), late = 0.5 * h * share, early = h - late;
    for (size_t k = 0; k < e->values; ++k)
        x->integral[k] += early * e->before[k] + late * e->now[k];
    for (int k = 0; k < 2; ++k)
        x->electrical_J += from->v[k] * (early * from->i[k] + late * to->i[k]);
}

static double between(double from, double to, double share)
{
    return from + share * (to - from);
}

static void take_whole(hci_evaluation *e, const level *from, const level *to, double share)
{
    double *integral = e->whole.integral;
    memcpy(integral, e->running.integral, e->values * sizeof *integral);
    e->whole = e->running;
    e->whole.integral = integral;
    add_part(e, from, to, share, &e->whole);
    e->whole.at = *from;
    e->whole.at.time_s = between(from->time_s, to->time_s, share);
    e->whole.at.angle_rad = between(from->angle_rad, to->angle_rad, share);
    e->whole.at.magnetic_J = between(from->magnetic_J, to->magnetic_J, share);
    e->whole.at.speed_squared = between(from->speed_squared, to->speed_squared, share);
    e->whole.at.counts = to->counts;
}

/* Ends of periods between two records; an end that is missed by rounding alone is one. */
static void find_periods(hci_evaluation *e, const level *from, const level *to)
{
    const double period_rad = 2.0 * HCI_PI * (double)e->setup->period_turns;
    const double way = fabs(from->angle_rad - e->first.angle_rad) / period_rad,
                 way_to = fabs(to->angle_rad - e->first.angle_rad) / period_rad;
    while (way_to > (double)(e->periods + 1) * (1.0 - 1e-12) - 1e-9) {
        const double share = way_to > way ? ((double)(e->periods + 1) - way) / (way_to - way) : 1.0;
        take_whole(e, from, to, fmin(share, 1.0));
        ++e->periods;
    }
}

void hci_evaluation_add(hci_evaluation *e, const hci_simulation_step *r)
{
    const level now = level_of(r);
    double *swap = e->before;
    e->before = e->now;
    e->now = swap;
    if (!e->started) e->reference_Nm = r->torque_Nm;
    fill(e, r);
    if (!e->started) {
        e->started = true;
        e->first = now;
    } else {
        const level before = e->running.at;
        find_periods(e, &before, &now);
        add_part(e, &before, &now, 1.0, &e->running);
    }
    note_extremes(e, r);
    e->running.at = now;
}

/* ---- figures ---- */

static hci_statistics statistics(double mean, double mean_square, const reached *x, int extreme)
{
    return (hci_statistics){mean, sqrt(fmax(mean_square, 0.0)), x->most[extreme], x->least[extreme]};
}

/* A mean that is a smaller share than this of the swing about it is no measure for a ripple. */
#define LEAST_MEAN 0.01

static void give_statistics(const hci_evaluation *e, const reached *x, double time_s, hci_simulation *s)
{
    const double *sum = x->integral, offset = sum[TORQUE] / time_s, mean = e->reference_Nm + offset;
    const double variance = fmax(sum[TORQUE_2] / time_s - offset * offset, 0.0);
    s->torque_Nm = statistics(mean, mean * mean + variance, x, MOST_TORQUE);
    s->current_A = statistics(sum[LENGTH] / time_s, sum[LENGTH_2] / time_s, x, MOST_LENGTH);
    s->current_dqx_A = statistics(sum[DQX] / time_s, sum[DQX_2] / time_s, x, MOST_DQX);
    s->speed_rad_per_s = statistics(sum[SPEED] / time_s, sum[SPEED_2] / time_s, x, MOST_SPEED);
    s->peak_phase_A = x->most[MOST_PHASE];
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

static void give_control(const hci_evaluation *e, const reached *x, double time_s, hci_simulation *s)
{
    const hci_control *control = &e->setup->drive.control;
    const double sample_s = control->step_s * (control->current_every > 0 ? control->current_every : 1u);
    s->switching_frequency_Hz =
        control->loop == HCI_CURRENT_HYSTERESIS
            ? (double)(x->at.counts.switchings - e->first.counts.switchings) / (6.0 * time_s)
            : (double)NAN;
    s->samples = (size_t)(time_s / sample_s + 0.5);
    s->without_current = (size_t)(x->at.counts.without_current - e->first.counts.without_current);
    s->limited = (size_t)(x->at.counts.limited - e->first.counts.limited);
    s->without_current_from_start = (size_t)e->running.at.counts.without_current;
    s->limited_from_start = (size_t)e->running.at.counts.limited;
}

static void give_energies(const hci_evaluation *e, const reached *x, double time_s, hci_simulation *s)
{
    const hci_setup *setup = e->setup;
    const bool has_voltage = setup->drive.control.loop != HCI_CURRENT_IDEAL;
    hci_energies *j = &s->energy_J;
    j->electrical = has_voltage ? x->electrical_J : (double)NAN;
    j->copper = s->copper_W * time_s;
    j->stored = setup->has_inductance && !setup->attachment
                    ? x->at.magnetic_J - e->first.magnetic_J - x->integral[COGGING]
                    : (double)NAN;
    j->mechanical = x->integral[SHAFT];
    j->load = setup->prescribed ? (double)NAN : x->integral[LOAD];
    j->friction = setup->prescribed ? (double)NAN : x->integral[FRICTION];
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
    const double *pair = e->whole.integral + SPECTRUM,
                 theta_rad = e->setup->drive.plant.table.pole_pairs * e->whole.integral[SPEED];
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
    const reached *x = e->periods > 0 ? &e->whole : &e->running;
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
