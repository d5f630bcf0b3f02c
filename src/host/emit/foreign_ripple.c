#include "host/emit/foreign_ripple.h"

#include <math.h>

/* A prime, so that it meets all parts of all steps of a table. */
enum { ANGLES = 40009 };

typedef struct {
    double low, high;
} range;

static void widen(range *r, double x)
{
    r->low = fmin(r->low, x);
    r->high = fmax(r->high, x);
}

/* i_d and i_q that flow, in the sense of the machine, where the drive's own i_q is own_q_A. */
static void currents_at(const hci_foreign_need *need, const hci_foreign_map *map, double theta_rad,
                        double own_q_A, double dq[2])
{
    double add[2];
    const double angle_rad =
        map->type->is_electrical ? theta_rad : theta_rad / hci_machine_plant_pole_pairs(need->plant);
    map->type->at(map, hci_foreign_turn(map, angle_rad), map->direction * own_q_A, add);
    if (map->type->kind == HCI_FOREIGN_TORQUE) add[1] /= need->torque_constant_Nm_per_A;
    dq[0] = add[0];
    dq[1] = own_q_A + map->direction * add[1];
}

static double torque_at(const hci_foreign_need *need, double theta_rad, const double dq[2])
{
    double abc[3];
    hci_machine_plant_phases(theta_rad, dq, abc);
    return hci_machine_plant_torque_at(need->plant, theta_rad, abc, NULL);
}

static double angle_rad(const hci_foreign_need *need, int k)
{
    return 2.0 * HCI_PI * hci_machine_plant_pole_pairs(need->plant) * (k + 0.5) / ANGLES;
}

/* ---- one i_q of the drive ---- */

/* Where the drive's own i_q is own_q_A; map NULL: nothing is added. */
typedef struct {
    const hci_foreign_need *need;
    const hci_foreign_map *map;
    double own_q_A, mean_Nm, slope_Nm_per_A;
    range torque_Nm;
} turn;

static double torque_of(const turn *t, double theta_rad)
{
    double dq[2] = {0.0, t->own_q_A};
    if (t->map != NULL) currents_at(t->need, t->map, theta_rad, t->own_q_A, dq);
    return torque_at(t->need, theta_rad, dq);
}

/* Both sides of each step of a table without lines: the extremes are there. */
static void widen_by_steps(turn *t)
{
    enum { SIDES = 2 };
    const double side = 1e-9;
    if (t->map == NULL || !t->map->type->in_middle) return;
    for (size_t k = 0; k < SIDES * t->map->points; ++k) {
        const double place = ((double)(k / SIDES) + (k % SIDES ? side : -side)) / (double)t->map->points;
        for (int turns = 0; turns < hci_machine_plant_pole_pairs(t->need->plant); ++turns)
            widen(&t->torque_Nm, torque_of(t, hci_foreign_theta_rad(t->map, place) + 2.0 * HCI_PI * turns));
    }
}

static void go_round(turn *t)
{
    double sum = 0.0;
    t->torque_Nm = (range){HUGE_VAL, -HUGE_VAL};
    for (int k = 0; k < ANGLES; ++k) {
        const double torque_Nm = torque_of(t, angle_rad(t->need, k));
        widen(&t->torque_Nm, torque_Nm);
        sum += torque_Nm;
    }
    t->mean_Nm = sum / ANGLES;
}

/* ---- the i_q at which the mean torque is one asked for ---- */

/* A whole number of the drive, and less than a figure that is shown. */
static double tolerance(const turn *t, double torque_Nm)
{
    const bool has_counts = t->map != NULL && t->map->type->has_counts;
    const double unit = has_counts ? t->map->unit * t->slope_Nm_per_A : 0.0;
    return unit + 1e-6 * (fabs(torque_Nm) + t->slope_Nm_per_A * 1e-3);
}

/* The secant through the last two places; where torque no longer follows the current, which a drive has cut,
 * the last of them stays. */
static void find_mean(turn *t, double torque_Nm)
{
    enum { STEPS = 12 };
    t->own_q_A = torque_Nm / t->need->torque_constant_Nm_per_A;
    go_round(t);
    for (int step = 0; step == 0 || (step < STEPS && fabs(torque_Nm - t->mean_Nm) > tolerance(t, torque_Nm));
         ++step) {
        const turn last = *t;
        t->own_q_A += (torque_Nm - t->mean_Nm) / t->slope_Nm_per_A;
        go_round(t);
        const double slope = (t->mean_Nm - last.mean_Nm) / (t->own_q_A - last.own_q_A);
        if (!(slope > 0.01 * last.slope_Nm_per_A)) break;
        t->slope_Nm_per_A = slope;
    }
    widen_by_steps(t);
}

static turn at_mean(const hci_foreign_need *need, const hci_foreign_map *map, double torque_Nm)
{
    turn t = {.need = need, .map = map};
    t.slope_Nm_per_A = need->plant->torque_constant_Nm_per_A;
    find_mean(&t, torque_Nm);
    return t;
}

double hci_emit_sine_ripple_Nm(const hci_machine_plant *plant, double torque_Nm)
{
    const hci_foreign_need need = {.plant = plant,
                                   .torque_constant_Nm_per_A = plant->torque_constant_Nm_per_A};
    const turn t = at_mean(&need, NULL, torque_Nm);
    return t.torque_Nm.high - t.torque_Nm.low;
}

hci_foreign_ripple hci_foreign_ripple_of(const hci_foreign_need *need, const hci_foreign_map *map,
                                         double torque_Nm)
{
    const turn without = at_mean(need, NULL, torque_Nm), with = at_mean(need, map, torque_Nm);
    return (hci_foreign_ripple){torque_Nm, without.torque_Nm.high - without.torque_Nm.low,
                                with.torque_Nm.high - with.torque_Nm.low, with.mean_Nm};
}
