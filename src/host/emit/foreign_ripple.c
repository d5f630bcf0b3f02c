#include "host/emit/foreign_ripple.h"

#include <math.h>

enum { ANGLES = 1 << 15 };

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

hci_foreign_ripple hci_foreign_ripple_of(const hci_foreign_need *need, const hci_foreign_map *map,
                                         double torque_Nm)
{
    const double own_q_A = torque_Nm / need->torque_constant_Nm_per_A;
    range without = {HUGE_VAL, -HUGE_VAL}, with = without;
    for (int k = 0; k < ANGLES; ++k) {
        const double theta_rad = 2.0 * HCI_PI * need->machine->pole_pairs * (k + 0.5) / ANGLES;
        double dq[2] = {0.0, own_q_A}, abc[3];
        hci_foreign_phases(theta_rad, dq, abc);
        widen(&without, hci_torque_at(need->machine, theta_rad, abc));
        currents_at(need, map, theta_rad, own_q_A, dq);
        hci_foreign_phases(theta_rad, dq, abc);
        widen(&with, hci_torque_at(need->machine, theta_rad, abc));
    }
    return (hci_foreign_ripple){torque_Nm, without.high - without.low, with.high - with.low};
}
