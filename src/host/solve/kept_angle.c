/* In: the torque at one angle, and a direction in the rotor frame; out: the current along it, by Newton's
 * method from a neighbour. */
#include "host/solve/kept_angle.h"

#include <math.h>
#include <stdbool.h>

enum { STEPS = 60, HALVINGS = 20, PARTS = 32 };

#define ENOUGH 1e-13 /* of the torque that the back-EMF of the direction would make with the current */

static void direction_at(double theta_rad, double angle_rad, double u[2])
{
    u[0] = sin(theta_rad + angle_rad);
    u[1] = -cos(theta_rad + angle_rad);
}

double hci_kept_angle_project(double theta_rad, double angle_rad, double e[3])
{
    double u[2], abc[3];
    direction_at(theta_rad, angle_rad, u);
    hci_plane_to_abc(u, abc);
    const double along = e[0] * abc[0] + e[1] * abc[1] + e[2] * abc[2];
    for (int s = 0; s < 3; ++s)
        e[s] = along * abc[s];
    return along * along;
}

/* A length along u, and there the torque less what is wanted and its slope by the length. */
typedef struct {
    double length_A, error_Nm, slope;
} place;

static place place_at(const hci_smooth_torque *torque, const double u[2], double length_A, double wanted_Nm)
{
    const double x[2] = {length_A * u[0], length_A * u[1]};
    double gradient[2];
    const double error_Nm = torque->at(torque->context, x, gradient) - wanted_Nm;
    return (place){length_A, error_Nm, gradient[0] * u[0] + gradient[1] * u[1]};
}

static bool is_found(const place *p, double wanted_Nm)
{
    return fabs(p->error_Nm) <= ENOUGH * (fabs(p->slope * p->length_A) + fabs(wanted_Nm));
}

/* One step of Newton's method, halved until it comes nearer. False: none does. */
static bool step(const hci_smooth_torque *torque, const double u[2], double wanted_Nm, place *p)
{
    double step_A = -p->error_Nm / p->slope;
    for (int k = 0; k < HALVINGS; ++k, step_A *= 0.5) {
        const place next = place_at(torque, u, p->length_A + step_A, wanted_Nm);
        if (!(fabs(next.error_Nm) < fabs(p->error_Nm))) continue;
        *p = next;
        return true;
    }
    return false;
}

static void approach(const hci_smooth_torque *torque, const double u[2], double wanted_Nm, place *p)
{
    for (int k = 0; k < STEPS && !is_found(p, wanted_Nm) && step(torque, u, wanted_Nm, p); ++k)
        continue;
}

/* A torque that saturates is made by two currents: beyond its largest it falls with the current. Then the
 * shorter one, which is between none and the one that was found. */
static place shortest(const hci_smooth_torque *torque, const double u[2], double wanted_Nm, place found)
{
    place low = place_at(torque, u, 0.0, wanted_Nm);
    if (!(low.slope * found.slope < 0.0)) return found;
    for (int k = 1; k < PARTS; ++k) {
        const place high = place_at(torque, u, found.length_A * k / PARTS, wanted_Nm);
        if (!(low.error_Nm * high.error_Nm < 0.0)) continue;
        place p = place_at(torque, u, 0.5 * (low.length_A + high.length_A), wanted_Nm);
        approach(torque, u, wanted_Nm, &p);
        return is_found(&p, wanted_Nm) && fabs(p.length_A) < fabs(found.length_A) ? p : found;
    }
    return found;
}

hci_status hci_kept_angle_current(const hci_smooth_torque *torque, double theta_rad, double angle_rad,
                                  double wanted_Nm, double x[2])
{
    double u[2];
    direction_at(theta_rad, angle_rad, u);
    place p = place_at(torque, u, copysign(hypot(x[0], x[1]), x[0] * u[0] + x[1] * u[1]), wanted_Nm);
    approach(torque, u, wanted_Nm, &p);
    if (is_found(&p, wanted_Nm)) p = shortest(torque, u, wanted_Nm, p);
    x[0] = p.length_A * u[0];
    x[1] = p.length_A * u[1];
    return is_found(&p, wanted_Nm) ? HCI_OK : HCI_NOT_REACHED;
}
