/* In: the torque at one angle, and a direction in the rotor frame; out: the current along it, by Newton's
 * method from a neighbour. Where the polynomial of a saturation turns round, past the largest torque that it
 * has, it has further currents of the same torque, of either sign: iron has none of them. */
#include "host/solve/kept_angle.h"

#include <math.h>
#include <stdbool.h>

enum { STEPS = 60, HALVINGS = 20, WAY = 16 };

#define ENOUGH 1e-13 /* of the torque that the back-EMF of the direction would make with the current */

void hci_kept_angle_direction(double theta_rad, double angle_rad, double u[2])
{
    u[0] = sin(theta_rad + angle_rad);
    u[1] = -cos(theta_rad + angle_rad);
}

double hci_kept_angle_project(double theta_rad, double angle_rad, double e[3])
{
    double u[2], abc[3];
    hci_kept_angle_direction(theta_rad, angle_rad, u);
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

static int sign_of(double x)
{
    return (x > 0.0) - (x < 0.0);
}

/* Whether the torque goes one way with the length, from no current up to there: it has not turned round. */
static bool is_before_turn(const hci_smooth_torque *torque, const double u[2], const place *p)
{
    int way = 0;
    for (int k = 0; k <= WAY; ++k) {
        const int sign = sign_of(place_at(torque, u, p->length_A * k / WAY, 0.0).slope);
        if (way != 0 && sign != way) return false;
        way = sign;
    }
    return true;
}

/* From a length to that of the torque. False: none is found before the torque turns round. */
static bool find(const hci_smooth_torque *torque, const double u[2], double wanted_Nm, place *p)
{
    for (int k = 0; k < STEPS && !is_found(p, wanted_Nm) && step(torque, u, wanted_Nm, p); ++k)
        continue;
    return is_found(p, wanted_Nm) && is_before_turn(torque, u, p);
}

hci_status hci_kept_angle_current(const hci_smooth_torque *torque, double theta_rad, double angle_rad,
                                  double wanted_Nm, double x[2])
{
    double u[2];
    hci_kept_angle_direction(theta_rad, angle_rad, u);
    const double start_A = copysign(hypot(x[0], x[1]), x[0] * u[0] + x[1] * u[1]);
    place p = place_at(torque, u, start_A, wanted_Nm);
    bool found = find(torque, u, wanted_Nm, &p);
    if (!found) {
        p = place_at(torque, u, 0.0, wanted_Nm);
        found = find(torque, u, wanted_Nm, &p);
    }
    if (!found) p.length_A = start_A;
    x[0] = p.length_A * u[0];
    x[1] = p.length_A * u[1];
    return found ? HCI_OK : HCI_NOT_REACHED;
}
