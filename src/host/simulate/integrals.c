/* Integrals over the steady part, by the trapezoidal rule in time. They are taken where a period of the angle
 * ends, inside a step by the straight line between its ends: what repeats with the angle then leaks into
 * nothing, and the rule is of high order.
 *
 *     S_n, C_n = 2/Θ ∫ T (sin, cos)(nθ) dθ,   dθ = ω_e dt,   Θ = ∫ dθ
 */
#include <math.h>
#include <string.h>

#include "host/base/memory.h"
#include "host/simulate/evaluation.h"

hci_evaluation *hci_evaluation_new(const hci_setup *setup)
{
    hci_evaluation *e = hci_memory_new(1, sizeof *e);
    if (!e) return NULL;
    e->setup = setup;
    e->orders = setup->highest_order * setup->period_turns + 1;
    e->values = HCI_INTEGRAL_SPECTRUM + 2 * e->orders;
    e->workspace = hci_memory_new(4 * e->values, sizeof *e->workspace);
    if (!e->workspace) {
        hci_memory_free(e);
        return NULL;
    }
    e->before = e->workspace;
    e->now = e->before + e->values;
    e->running.integral = e->now + e->values;
    e->whole.integral = e->running.integral + e->values;
    for (int k = 0; k < HCI_EXTREMES; ++k) {
        e->running.most[k] = -HUGE_VAL;
        e->running.least[k] = HUGE_VAL;
    }
    return e;
}

void hci_evaluation_free(hci_evaluation *evaluation)
{
    if (!evaluation) return;
    hci_memory_free(evaluation->workspace);
    hci_memory_free(evaluation);
}

/* ---- integrands ---- */

/* T ω sin(nθ), T ω cos(nθ) for n = 0, 1/turns, 2/turns, … by turning the pair on. */
static void fill_spectrum(const hci_evaluation *e, double angle_rad, double weight, double *pair)
{
    const double s1 = sin(angle_rad / (double)e->setup->period_turns),
                 c1 = cos(angle_rad / (double)e->setup->period_turns);
    double s = 0.0, c = weight;
    for (size_t n = 0, orders = e->orders; n < orders; ++n) {
        const double next = s * c1 + c * s1;
        pair[2 * n] = s;
        pair[2 * n + 1] = c;
        c = c * c1 - s * s1;
        s = next;
    }
}

/* sqrt(i_dx² + i_qx²) = |e| |i| / sqrt(3/2), with the back-EMF by which the controller computes. */
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
    now[HCI_INTEGRAL_TORQUE] = torque;
    now[HCI_INTEGRAL_TORQUE_2] = torque * torque;
    now[HCI_INTEGRAL_LENGTH] = length;
    now[HCI_INTEGRAL_LENGTH_2] = length * length;
    now[HCI_INTEGRAL_DQX] = dqx_length(e, r->theta_e_rad, length);
    now[HCI_INTEGRAL_DQX_2] = now[HCI_INTEGRAL_DQX] * now[HCI_INTEGRAL_DQX];
    now[HCI_INTEGRAL_SPEED] = speed;
    now[HCI_INTEGRAL_SPEED_2] = speed * speed;
    now[HCI_INTEGRAL_SHAFT] = r->torque_Nm * speed;
    now[HCI_INTEGRAL_COGGING] = r->point.magnetic.cogging_Nm * speed;
    now[HCI_INTEGRAL_LOAD] = r->load_Nm * speed;
    now[HCI_INTEGRAL_FRICTION] =
        (plant->viscous_Nms * speed + r->point.shaft_Nm) * speed + plant->coulomb_Nm * fabs(speed);
    fill_spectrum(e, r->theta_e_rad, torque * speed, now + HCI_INTEGRAL_SPECTRUM);
}

static void note_extreme(hci_integrals *x, int what, double value)
{
    x->most[what] = fmax(x->most[what], value);
    x->least[what] = fmin(x->least[what], value);
}

static void note_extremes(hci_evaluation *e, const hci_simulation_step *r)
{
    double abc[3];
    hci_plane_to_abc(r->i_A, abc);
    note_extreme(&e->running, HCI_EXTREME_TORQUE, r->torque_Nm);
    note_extreme(&e->running, HCI_EXTREME_LENGTH, e->now[HCI_INTEGRAL_LENGTH]);
    note_extreme(&e->running, HCI_EXTREME_DQX, e->now[HCI_INTEGRAL_DQX]);
    note_extreme(&e->running, HCI_EXTREME_SPEED, r->speed_rad_per_s);
    for (int s = 0; s < 3; ++s)
        note_extreme(&e->running, HCI_EXTREME_PHASE, fabs(abc[s]));
}

static hci_instant instant_of(const hci_simulation_step *r)
{
    const double *l = r->point.inductance_H, *i = r->i_A;
    return (hci_instant){r->time_s,
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
static void add_part(const hci_evaluation *e, const hci_instant *from, const hci_instant *to, double share,
                     hci_integrals *x)
{
    const double h = share * (to->time_s - from->time_s), late = 0.5 * h * share, early = h - late;
    const double *before = e->before, *now = e->now;
    double *integral = x->integral;
    for (size_t k = 0, values = e->values; k < values; ++k)
        integral[k] += early * before[k] + late * now[k];
    for (int k = 0; k < 2; ++k)
        x->electrical_J += from->v[k] * (early * from->i[k] + late * to->i[k]);
}

static double between(double from, double to, double share)
{
    return from + share * (to - from);
}

static void take_whole(hci_evaluation *e, const hci_instant *from, const hci_instant *to, double share)
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
static void find_periods(hci_evaluation *e, const hci_instant *from, const hci_instant *to)
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
    const hci_instant now = instant_of(r);
    double *swap = e->before;
    e->before = e->now;
    e->now = swap;
    if (!e->started) e->reference_Nm = r->torque_Nm;
    fill(e, r);
    if (!e->started) {
        e->started = true;
        e->first = now;
    } else {
        const hci_instant before = e->running.at;
        find_periods(e, &before, &now);
        add_part(e, &before, &now, 1.0, &e->running);
    }
    note_extremes(e, r);
    e->running.at = now;
}
