/* The strategies for a torque that is no quadric, that of a machine that saturates. */
#include <math.h>
#include <stdbool.h>
#include <stddef.h>

#include "hci/machine/strategy.h"
#include "hci/math/harmonic.h"

/* One angle. missing: wanted less what there is without current. size: of the currents that are looked at;
 * scale: of the torque, for what counts as reached. */
typedef struct {
    const hci_smooth_torque *torque;
    double wanted_Nm, missing_Nm, scale_Nm;
    double size_A;
} task;

#define REACHED  1e-10 /* of the torque's scale */
#define AT_REST  1e-13 /* of the size of currents, or an angle */
#define FARTHEST 4.0   /* of the size of currents */

static double torque_at(const task *t, const double x[2])
{
    double unused[2];
    return t->torque->at(t->torque->context, x, unused);
}

/* ---- shortest current ---- */

/* Along a ray of angle φ the torque is as wanted at a length r. On the range next to zero current T rises (or
 * falls, where less torque is wanted than there is without current) along the ray, and
 *
 *     dr/dφ / r = −(∂T/∂x · u')/(∂T/∂x · u)      u = (cos φ, sin φ)
 *
 * The shortest current of the range is where this goes from below to above zero. */
typedef struct {
    double phi, r, slope; /* slope: dr/dφ / r */
} ray;

static void point_of(const ray *y, double x[2])
{
    x[0] = y->r * cos(y->phi);
    x[1] = y->r * sin(y->phi);
}

/* Newton's method for r from a length near it; false where the ray has none on the range. */
static bool ray_at(const task *t, double phi, double near, ray *y)
{
    const double u[2] = {cos(phi), sin(phi)};
    double r = near, step = HUGE_VAL;
    for (int count = 0; count < 40 && r <= 2.0 * FARTHEST * t->size_A; ++count) {
        const double x[2] = {r * u[0], r * u[1]};
        double g[2];
        const double error = t->torque->at(t->torque->context, x, g) - t->wanted_Nm;
        const double along = g[0] * u[0] + g[1] * u[1], across = g[1] * u[0] - g[0] * u[1];
        if (!(along * t->missing_Nm > 0.0)) return false;
        step = error / along;
        if (fabs(error) <= REACHED * t->scale_Nm && fabs(step) <= AT_REST * t->size_A) {
            *y = (ray){phi, r, -across / along};
            return true;
        }
        r = fmin(fmax(r - step, 0.5 * r), 2.0 * r);
    }
    return false;
}

/* From a ray downhill until the slope has changed its sign; a step beyond the end of the range is halved. */
static bool bracket(const task *t, const ray *from, ray *a, ray *b)
{
    const double side = from->slope > 0.0 ? -1.0 : 1.0;
    double step = 0.01;
    *a = *from;
    for (int count = 0; count < 100 && fabs(a->phi - from->phi) < HCI_PI; ++count) {
        if (!ray_at(t, a->phi + side * step, a->r, b)) {
            step *= 0.5;
            continue;
        }
        if (b->slope * side >= 0.0) return true;
        *a = *b;
        step = fmin(2.0 * step, 0.2);
    }
    return false;
}

/* The zero of the slope between two rays, by the Illinois rule. */
static void between(const task *t, ray a, ray b, ray *y)
{
    double at_a = a.slope, at_b = b.slope;
    *y = b;
    for (int count = 0; count < 100 && fabs(b.phi - a.phi) > AT_REST && y->slope != 0.0; ++count) {
        double phi = b.phi - at_b * (b.phi - a.phi) / (at_b - at_a);
        if (!(phi > fmin(a.phi, b.phi) && phi < fmax(a.phi, b.phi))) phi = 0.5 * (a.phi + b.phi);
        if (!ray_at(t, phi, b.r, y)) break;
        if ((y->slope > 0.0) != (b.slope > 0.0)) {
            a = b;
            at_a = b.slope;
        } else {
            at_a *= 0.5;
        }
        if (fabs(y->phi - b.phi) <= AT_REST) break;
        b = *y;
        at_b = y->slope;
    }
}

/* x: in a current near the range, out its shortest; unchanged where there is none. */
static hci_status follow(const task *t, double x[2])
{
    ray from, a, b, y;
    if (!ray_at(t, atan2(x[1], x[0]), hypot(x[0], x[1]), &from)) return HCI_NOT_REACHED;
    if (from.slope != 0.0) {
        if (!bracket(t, &from, &a, &b)) return HCI_NOT_REACHED;
        between(t, a, b, &y);
    } else {
        y = from;
    }
    point_of(&y, x);
    return HCI_OK;
}

enum { DIRECTIONS = 48, RADII = 32 };

/* Along rays: to the shortest current where the torque passes the wanted one, or where it comes nearest. */
static void scan(const task *t, double x[2])
{
    double least_A = FARTHEST * t->size_A, nearest_Nm = fabs(t->missing_Nm);
    bool found = false;
    x[0] = x[1] = 0.0;
    for (int k = 0; k < DIRECTIONS; ++k) {
        const double c = cos(2.0 * HCI_PI * k / DIRECTIONS), s = sin(2.0 * HCI_PI * k / DIRECTIONS);
        double before = -t->missing_Nm, radius_A = 0.0;
        for (int j = 1; j <= RADII && radius_A < least_A; ++j) {
            const double y[2] = {c * FARTHEST * t->size_A * j / RADII, s * FARTHEST * t->size_A * j / RADII};
            const double error = torque_at(t, y) - t->wanted_Nm, last_A = radius_A;
            radius_A = FARTHEST * t->size_A * j / RADII;
            const bool passed = (error > 0.0) != (before > 0.0);
            const double crossing_A =
                passed ? last_A + (radius_A - last_A) * before / (before - error) : radius_A;
            if (passed ? crossing_A < least_A : !found && fabs(error) < nearest_Nm) {
                x[0] = c * crossing_A;
                x[1] = s * crossing_A;
                nearest_Nm = fabs(error);
                if (passed) least_A = crossing_A;
                found = found || passed;
            }
            if (passed) break;
            before = error;
        }
    }
}

static hci_status shortest(const task *t, const double *previous, double x[2])
{
    if (!previous) {
        scan(t, x);
        return follow(t, x);
    }
    x[0] = previous[0];
    x[1] = previous[1];
    return follow(t, x);
}

/* ---- i_d that cancels ---- */

/* i_q and the axes; x = i_q q + i_d d. */
typedef struct {
    const task *task;
    double q[2], d[2];
    double i_q;
} line;

static double error_at(const line *l, double i_d, double *slope)
{
    const double x[2] = {l->i_q * l->q[0] + i_d * l->d[0], l->i_q * l->q[1] + i_d * l->d[1]};
    double g[2];
    const double torque_Nm = l->task->torque->at(l->task->torque->context, x, g);
    *slope = g[0] * l->d[0] + g[1] * l->d[1];
    return torque_Nm - l->task->wanted_Nm;
}

/* Newton's method kept inside a bracket at whose ends the error has opposite signs. */
static double root_between(const line *l, double low, double high)
{
    double slope, i_d = 0.5 * (low + high);
    const bool rising = error_at(l, high, &slope) > 0.0;
    for (int step = 0; step < 100; ++step) {
        const double error = error_at(l, i_d, &slope);
        double next = i_d - error / slope;
        *((error > 0.0) == rising ? &high : &low) = i_d;
        if (!(next >= fmin(low, high) && next <= fmax(low, high))) next = 0.5 * (low + high);
        if (fabs(next - i_d) <= AT_REST * l->task->size_A) return next;
        i_d = next;
    }
    return i_d;
}

enum { MARCH = 64 };

/* The first root on one side of i_d = 0, outwards; else infinite, and the nearest miss so far. */
static double first_root(const line *l, double side, double *nearest, double *nearest_Nm)
{
    double slope, last = 0.0, before = error_at(l, 0.0, &slope);
    for (int k = 1; k <= MARCH; ++k) {
        const double i_d = side * FARTHEST * l->task->size_A * k / MARCH, error = error_at(l, i_d, &slope);
        if ((error > 0.0) != (before > 0.0)) return root_between(l, last, i_d);
        if (fabs(error) < *nearest_Nm) {
            *nearest_Nm = fabs(error);
            *nearest = i_d;
        }
        last = i_d;
        before = error;
    }
    return side * HUGE_VAL;
}

/* The shorter of the two first roots; of two that are equally long within 1 % the one nearer to what went
 * before. */
static hci_status cancel(const line *l, const double *previous, double *i_d)
{
    double slope, nearest = 0.0, nearest_Nm = fabs(error_at(l, 0.0, &slope));
    *i_d = 0.0;
    if (nearest_Nm <= 1e-14 * l->task->scale_Nm) return HCI_OK;
    const double right = first_root(l, 1.0, &nearest, &nearest_Nm);
    const double left = first_root(l, -1.0, &nearest, &nearest_Nm);
    const double small = fabs(left) < fabs(right) ? left : right, large = small == left ? right : left;
    *i_d = small;
    if (isinf(small)) *i_d = nearest;
    if (previous && fabs(large) <= 1.01 * fabs(small) && !isinf(small)) {
        const double before = previous[0] * l->d[0] + previous[1] * l->d[1];
        if (fabs(large - before) < fabs(small - before)) *i_d = large;
    }
    return isinf(small) ? HCI_NOT_REACHED : HCI_OK;
}

/* ---- all of them ---- */

hci_status hci_strategy_smooth_current(const hci_smooth_torque *torque, const hci_machine_point *mutual,
                                       hci_strategy strategy, double torque_Nm, const double *previous,
                                       double x[2])
{
    const double e = hypot(mutual->e[0], mutual->e[1]);
    double quadric[2], i_d;
    hci_status status =
        hci_strategy_current(mutual, strategy == HCI_STRATEGY_ID0 ? HCI_STRATEGY_ID0 : HCI_STRATEGY_MTPA,
                             torque_Nm, NULL, quadric, NULL);
    task t = {torque, torque_Nm, torque_Nm - mutual->cogging_Nm,
              fmax(fabs(torque_Nm), fabs(mutual->cogging_Nm)), hypot(quadric[0], quadric[1])};
    x[0] = quadric[0];
    x[1] = quadric[1];
    if (strategy == HCI_STRATEGY_MTPA) return t.size_A > 0.0 ? shortest(&t, previous, x) : status;
    if (strategy == HCI_STRATEGY_ID0) return status;
    if (!(e > 0.0)) return HCI_NOT_REACHED;
    t.size_A = fmax(t.size_A, fabs(torque_Nm) / e);
    const line l = {
        &t, {mutual->e[0] / e, mutual->e[1] / e}, {mutual->e[1] / e, -mutual->e[0] / e}, torque_Nm / e};
    status = cancel(&l, previous, &i_d);
    for (int k = 0; k < 2; ++k)
        x[k] = l.i_q * l.q[k] + i_d * l.d[k];
    return status;
}
