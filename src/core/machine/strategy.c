#include "hci/machine/strategy.h"

#include <float.h>
#include <math.h>
#include <stdbool.h>
#include <stddef.h>

hci_machine_point hci_machine_at(const hci_machine *machine, double theta_rad)
{
    const double alpha[2] = {1.0, 0.0}, beta[2] = {0.0, 1.0}, none[3] = {0.0, 0.0, 0.0};
    double abc[3], e[3], with_alpha[3], with_beta[3], in_plane[2];
    hci_machine_point p;
    hci_torque_gradient_at(machine, theta_rad, none, e);
    hci_plane_from_abc(e, p.e);
    p.slope[0] = p.slope[1] = p.slope[2] = 0.0;
    if (machine->slope_count > 0) {
        hci_plane_to_abc(alpha, abc);
        hci_torque_gradient_at(machine, theta_rad, abc, with_alpha);
        hci_plane_to_abc(beta, abc);
        hci_torque_gradient_at(machine, theta_rad, abc, with_beta);
        hci_plane_from_abc(with_alpha, in_plane);
        p.slope[0] = in_plane[0] - p.e[0];
        p.slope[1] = in_plane[1] - p.e[1];
        hci_plane_from_abc(with_beta, in_plane);
        p.slope[2] = in_plane[1] - p.e[1];
    }
    p.cogging_Nm = hci_harmonics_at(machine->cogging, machine->cogging_count, theta_rad);
    return p;
}

double hci_point_torque_Nm(const hci_machine_point *point, const double x[2])
{
    const double *h = point->slope;
    return point->e[0] * x[0] + point->e[1] * x[1] + 0.5 * h[0] * x[0] * x[0] + h[1] * x[0] * x[1] +
           0.5 * h[2] * x[1] * x[1] + point->cogging_Nm;
}

/* ---- i_d = 0, and i_d that cancels ---- */

/* The point in the orthonormal (d, q) axes: |e| and L'_d, M', L'_q. */
typedef struct {
    double q_axis[2]; /* the d axis is (q_β, −q_α) */
    double e;
    double d, dq, q;
} axes;

static axes axes_of(const hci_machine_point *p)
{
    axes a = {{0.0, 0.0}, hypot(p->e[0], p->e[1]), 0.0, 0.0, 0.0};
    if (!(a.e > 0.0)) return a;
    const double qa = p->e[0] / a.e, qb = p->e[1] / a.e;
    a.q_axis[0] = qa;
    a.q_axis[1] = qb;
    a.d = p->slope[0] * qb * qb - 2.0 * p->slope[1] * qa * qb + p->slope[2] * qa * qa;
    a.q = p->slope[0] * qa * qa + 2.0 * p->slope[1] * qa * qb + p->slope[2] * qb * qb;
    a.dq = (p->slope[0] - p->slope[2]) * qa * qb + p->slope[1] * (qb * qb - qa * qa);
    return a;
}

static void from_axes(const axes *a, double id, double iq, double x[2])
{
    x[0] = id * a->q_axis[1] + iq * a->q_axis[0];
    x[1] = iq * a->q_axis[1] - id * a->q_axis[0];
}

/* Smallest |i_q| with M'² i_q² − L'_d (L'_q i_q² + 2 T_cog) >= 0 there and beyond. Without L'_d and M' no i_d
 * has an effect. */
static double least_iq(const axes *a, double cogging_Nm)
{
    if (a->d == 0.0 && a->dq == 0.0) return a->q == 0.0 && cogging_Nm == 0.0 ? 0.0 : HUGE_VAL;
    const double growth = a->dq * a->dq - a->d * a->q, needed = 2.0 * a->d * cogging_Nm;
    if (needed <= 0.0 && growth >= 0.0) return 0.0;
    return growth > 0.0 ? sqrt(needed / growth) : HUGE_VAL;
}

/* Of two roots the shorter; of two that are equally long within 1 % the one nearer to what went before. */
static double pick_root(double small, double large, const axes *a, const double *previous)
{
    if (!previous || fabs(large) > 1.01 * fabs(small)) return small;
    const double id = previous[0] * a->q_axis[1] - previous[1] * a->q_axis[0];
    return fabs(large - id) < fabs(small - id) ? large : small;
}

/* ½L'_d i_d² + M' i_q i_d + c = 0 with c = ½L'_q i_q² + T_cog: the smaller root is −2c/(b ± sqrt(b² − 2 L'_d
 * c)) with b = M' i_q and the sign of b, which has no trouble where L'_d vanishes. Where the root is complex,
 * the i_d of the extremum. */
static hci_status cancel(const axes *a, double cogging_Nm, double iq, const double *previous, double *id)
{
    const double b = a->dq * iq, c = 0.5 * a->q * iq * iq + cogging_Nm, square = b * b - 2.0 * a->d * c;
    *id = 0.0;
    if (c == 0.0) return HCI_OK;
    if (square < 0.0) {
        *id = -b / a->d;
        return HCI_NOT_REACHED;
    }
    const double sum = b + copysign(sqrt(square), b);
    if (sum == 0.0) return HCI_NOT_REACHED;
    *id = -2.0 * c / sum;
    if (a->d != 0.0) *id = pick_root(*id, -sum / a->d, a, previous);
    return HCI_OK;
}

/* ---- shortest current ---- */

/* min ½|x|² with g·x + ½xᵀHx = τ. In the eigenvectors of H, x_k = λ g_k/(1 − λh_k), and
 *
 *     φ(λ) = Σ g_k² λ(2 − λh_k) / (2(1 − λh_k)²) = τ,    φ' = Σ g_k²/(1 − λh_k)³ > 0
 *
 * where I − λH is positive definite, which is where the solution is the global one. Signs are turned so that
 * τ > 0; then 0 <= λ < 1/h_1 when the larger eigenvalue h_1 is positive, and λ >= 0 otherwise. */
typedef struct {
    double g[2], h[2]; /* h[0] >= h[1] */
    double gap;        /* h[0] − h[1] */
    double axis[2];    /* eigenvector of h[0]; that of h[1] is (−axis_1, axis_0) */
    double tau;
} shortest;

/* Unit eigenvector of the larger eigenvalue of ((half, off), (off, −half)); where they are equal, along e. */
static void leading_axis(double half, double off, const double e[2], double axis[2])
{
    const double radius = hypot(half, off), size = hypot(e[0], e[1]);
    axis[0] = size > 0.0 ? e[0] / size : 1.0;
    axis[1] = size > 0.0 ? e[1] / size : 0.0;
    if (radius > 0.0) {
        const double large = sqrt(0.5 + 0.5 * fabs(half) / radius), small = 0.5 * off / (radius * large);
        axis[0] = half < 0.0 ? small : large;
        axis[1] = half < 0.0 ? large : small;
    }
}

/* Below it a component of the back-EMF is rounding: where L' has no share in its direction either, a current
 * of 1e14 A would be the answer that it gives. */
#define ROUNDING (4.0 * DBL_EPSILON) /* of the back-EMF */

/* The back-EMF along an axis. */
static double along(double x, double y, double size)
{
    const double sum = x + y;
    return fabs(sum) > ROUNDING * size ? sum : 0.0;
}

/* The eigenvalue nearer to zero comes from the determinant: mean ∓ radius would leave it the rounding of the
 * other one. */
static shortest turn(const hci_machine_point *p, double tau)
{
    const double sign = tau < 0.0 ? -1.0 : 1.0;
    const double mean = 0.5 * sign * (p->slope[0] + p->slope[2]),
                 half = 0.5 * sign * (p->slope[0] - p->slope[2]);
    const double radius = hypot(half, p->slope[1]), outer = mean < 0.0 ? mean - radius : mean + radius;
    const double determinant = p->slope[0] * p->slope[2] - p->slope[1] * p->slope[1];
    const double inner = outer != 0.0 ? determinant / outer : 0.0;
    shortest t = {{0.0, 0.0}, {inner, outer}, 2.0 * radius, {0.0, 0.0}, sign * tau};
    if (mean >= 0.0) {
        t.h[0] = outer;
        t.h[1] = inner;
    }
    leading_axis(half, sign * p->slope[1], p->e, t.axis);
    const double size = hypot(p->e[0], p->e[1]);
    t.g[0] = sign * along(t.axis[0] * p->e[0], t.axis[1] * p->e[1], size);
    t.g[1] = sign * along(t.axis[0] * p->e[1], -t.axis[1] * p->e[0], size);
    return t;
}

static void turn_back(const shortest *t, const double y[2], double x[2])
{
    x[0] = t->axis[0] * y[0] - t->axis[1] * y[1];
    x[1] = t->axis[1] * y[0] + t->axis[0] * y[1];
}

/* φ and φ' for given λ and the two 1 − λh_k. */
static double torque_of(const shortest *t, double lambda, const double left[2], double *slope)
{
    double sum = 0.0;
    *slope = 0.0;
    for (int k = 0; k < 2; ++k) {
        const double ratio = t->g[k] / left[k];
        sum += 0.5 * lambda * (1.0 + left[k]) * ratio * ratio;
        *slope += ratio * ratio / left[k];
    }
    return sum;
}

/* The unknown is λ itself, or δ = 1 − λh_0 near the pole, where λ has no digits left. */
typedef struct {
    const shortest *problem;
    bool by_delta;
} unknown;

static double lambda_of(const unknown *u, double t, double left[2])
{
    const double *h = u->problem->h;
    const double lambda = u->by_delta ? (1.0 - t) / h[0] : t;
    left[0] = u->by_delta ? t : 1.0 - t * h[0];
    left[1] = left[0] + lambda * u->problem->gap;
    return lambda;
}

/* Newton's method kept inside a shrinking bracket, 0 < low <= high, at whose ends φ − τ has opposite
 * signs; it starts at the end where φ >= τ. Near the pole φ is about 1/δ², so there the method is applied
 * to 1/√φ. */
static double solve_in(const unknown *u, double low, double high)
{
    const double tau = u->problem->tau;
    double t = u->by_delta ? low : high;
    for (int step = 0; step < 200 && high - low > 4.0 * DBL_EPSILON * high; ++step) {
        double left[2], slope;
        const double lambda = lambda_of(u, t, left), torque = torque_of(u->problem, lambda, left, &slope);
        const double error = torque - tau;
        if (fabs(error) <= DBL_EPSILON * tau) break;
        if ((error > 0.0) == !u->by_delta)
            high = t;
        else
            low = t;
        const double next = u->by_delta
                                ? t - 2.0 * torque * (1.0 - sqrt(torque / tau)) * u->problem->h[0] / slope
                                : t - error / slope;
        if (fabs(next - t) <= 2.0 * DBL_EPSILON * t) break;
        t = next > low && next < high ? next : sqrt(low) * sqrt(high);
    }
    return t;
}

static void set_current(const shortest *p, const unknown *u, double t, double x[2])
{
    double left[2], y[2];
    const double lambda = lambda_of(u, t, left);
    for (int k = 0; k < 2; ++k)
        y[k] = lambda * p->g[k] / left[k];
    turn_back(p, y, x);
}

/* Below it g_0 counts as zero. */
#define LEAST_DELTA 1e-150

/* λ with λh_0 <= ½, where φ' <= 8|g|²; limit bounds the search, which starts above 0 even for a back-EMF that
 * is not finite. Zero where φ stays below τ, if only by rounding. */
static bool solve_by_lambda(const shortest *p, double limit, double x[2])
{
    const unknown u = {p, false};
    const double square = p->g[0] * p->g[0] + p->g[1] * p->g[1];
    double left[2], slope, high = fmax(p->tau / square, DBL_MIN), low = 0.125 * high;
    for (; high < limit; high *= 2.0) {
        lambda_of(&u, high, left);
        if (torque_of(p, high, left, &slope) >= p->tau) break;
        low = high;
    }
    high = fmin(high, limit);
    lambda_of(&u, high, left);
    if (!(torque_of(p, high, left, &slope) >= p->tau)) return false;
    set_current(p, &u, solve_in(&u, low, high), x);
    return true;
}

/* h_0 > 0 and the root beyond λ = ½/h_0. φ >= g_0²(δ⁻² − 1)/(2h_0) gives the lower end for δ. With g_0 = 0
 * the pole may not reach τ: then λ = 1/h_0 and the rest of the torque comes from a current along that
 * eigenvector, of either sign. */
static void solve_by_delta(const shortest *p, const double *previous, double x[2])
{
    const unknown u = {p, true};
    const double low = 1.0 / sqrt(1.0 + 2.0 * p->h[0] * p->tau / (p->g[0] * p->g[0]));
    const double left = p->gap / p->h[0], ratio = left > 0.0 ? p->g[1] / left : 0.0;
    const double at_pole = 0.5 * (1.0 + left) * ratio * ratio / p->h[0];
    if (low > LEAST_DELTA || at_pole >= p->tau) {
        set_current(p, &u, solve_in(&u, fmax(low, LEAST_DELTA), 0.5), x);
        return;
    }
    double y[2] = {sqrt(fmax(0.0, 2.0 * (p->tau - at_pole) / p->h[0])), ratio / p->h[0]};
    if (previous && p->axis[0] * previous[0] + p->axis[1] * previous[1] < 0.0) y[0] = -y[0];
    turn_back(p, y, x);
}

/* Both eigenvalues <= 0: φ(∞) = Σ g²/(2|h|) is the most torque there is, at x = −H⁻¹g; a τ that is it but for
 * rounding is reached. */
static hci_status solve_bounded(const shortest *p, double x[2])
{
    double most = 0.0, y[2] = {0.0, 0.0};
    for (int k = 0; k < 2; ++k) {
        if (p->g[k] != 0.0) most += p->h[k] < 0.0 ? -0.5 * p->g[k] * p->g[k] / p->h[k] : HUGE_VAL;
        if (p->h[k] < 0.0) y[k] = -p->g[k] / p->h[k];
    }
    if (most > p->tau && solve_by_lambda(p, 1e300, x)) return HCI_OK;
    turn_back(p, y, x);
    return most < p->tau * (1.0 - ROUNDING) ? HCI_NOT_REACHED : HCI_OK;
}

static hci_status shortest_current(const hci_machine_point *point, double tau, const double *previous,
                                   double x[2])
{
    x[0] = x[1] = 0.0;
    if (tau == 0.0) return HCI_OK;
    const shortest p = turn(point, tau);
    if (!(p.h[0] > 0.0)) return solve_bounded(&p, x);
    if (!solve_by_lambda(&p, 0.5 / p.h[0], x)) solve_by_delta(&p, previous, x);
    return HCI_OK;
}

/* ---- all of them ---- */

hci_status hci_strategy_current(const hci_machine_point *point, hci_strategy strategy, double torque_Nm,
                                const double *previous, double x[2], double *least_iq_A)
{
    const axes a = axes_of(point);
    double id = 0.0;
    hci_status status = HCI_OK;
    if (least_iq_A) *least_iq_A = strategy == HCI_STRATEGY_CANCEL ? least_iq(&a, point->cogging_Nm) : 0.0;
    if (strategy == HCI_STRATEGY_MTPA)
        return shortest_current(point, torque_Nm - point->cogging_Nm, previous, x);
    x[0] = x[1] = 0.0;
    const double currentless_Nm = strategy == HCI_STRATEGY_CANCEL ? point->cogging_Nm : 0.0;
    if (!(a.e > 0.0)) return torque_Nm == currentless_Nm ? HCI_OK : HCI_NOT_REACHED;
    if (strategy == HCI_STRATEGY_CANCEL)
        status = cancel(&a, point->cogging_Nm, torque_Nm / a.e, previous, &id);
    from_axes(&a, id, torque_Nm / a.e, x);
    return status;
}
