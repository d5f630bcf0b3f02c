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
    const double angle_rad = map->type->is_electrical ? theta_rad : theta_rad / need->machine->pole_pairs;
    map->type->at(map, hci_foreign_turn(map, angle_rad), map->direction * own_q_A, add);
    if (map->type->kind == HCI_FOREIGN_TORQUE) add[1] /= need->torque_constant_Nm_per_A;
    dq[0] = add[0];
    dq[1] = own_q_A + map->direction * add[1];
}

static double torque_at(const hci_foreign_need *need, double theta_rad, const double dq[2])
{
    double abc[3];
    hci_foreign_phases(theta_rad, dq, abc);
    return hci_foreign_torque_at(need, theta_rad, abc, NULL);
}

static double angle_rad(const hci_foreign_need *need, int k)
{
    return 2.0 * HCI_PI * need->machine->pole_pairs * (k + 0.5) / ANGLES;
}

static double mean_with(const hci_foreign_need *need, const hci_foreign_map *map, double own_q_A)
{
    double sum = 0.0, dq[2];
    for (int k = 0; k < ANGLES; ++k) {
        currents_at(need, map, angle_rad(need, k), own_q_A, dq);
        sum += torque_at(need, angle_rad(need, k), dq);
    }
    return sum / ANGLES;
}

hci_foreign_ripple hci_foreign_ripple_of(const hci_foreign_need *need, const hci_foreign_map *map,
                                         double torque_Nm)
{
    const double K = need->torque_constant_Nm_per_A, sine_A = torque_Nm / K;
    const double own_q_A = sine_A - (mean_with(need, map, sine_A) - torque_Nm) /
                                        hci_machine_torque_constant(need->request->machine);
    range without = {HUGE_VAL, -HUGE_VAL}, with = without;
    for (int k = 0; k < ANGLES; ++k) {
        const double theta_rad = angle_rad(need, k);
        double dq[2] = {0.0, sine_A};
        widen(&without, torque_at(need, theta_rad, dq));
        currents_at(need, map, theta_rad, own_q_A, dq);
        widen(&with, torque_at(need, theta_rad, dq));
    }
    return (hci_foreign_ripple){torque_Nm, without.high - without.low, with.high - with.low};
}
