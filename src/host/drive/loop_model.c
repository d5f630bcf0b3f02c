#include "host/drive/loop_model.h"

#include <math.h>
#include <string.h>

static const double complex J = (double complex)I;

/* ---- complex 2 × 2 ---- */

static hci_matrix2 times(hci_matrix2 a, hci_matrix2 b)
{
    hci_matrix2 c;
    for (int i = 0; i < 2; ++i)
        for (int j = 0; j < 2; ++j)
            c.m[i][j] = a.m[i][0] * b.m[0][j] + a.m[i][1] * b.m[1][j];
    return c;
}

/* a + factor·b. */
static hci_matrix2 plus(hci_matrix2 a, double complex factor, hci_matrix2 b)
{
    for (int i = 0; i < 2; ++i)
        for (int j = 0; j < 2; ++j)
            a.m[i][j] += factor * b.m[i][j];
    return a;
}

static hci_matrix2 inverse(hci_matrix2 a)
{
    const double complex d = a.m[0][0] * a.m[1][1] - a.m[0][1] * a.m[1][0];
    return (hci_matrix2){{{a.m[1][1] / d, -a.m[0][1] / d}, {-a.m[1][0] / d, a.m[0][0] / d}}};
}

static hci_matrix2 diagonal(double complex d, double complex q)
{
    return (hci_matrix2){{{d, 0.0}, {0.0, q}}};
}

/* Rotor axes seen after the rotor has gone `way_rad` back: d + jq times e^(j·way). */
static hci_matrix2 turned(double way_rad)
{
    return (hci_matrix2){{{cos(way_rad), -sin(way_rad)}, {sin(way_rad), cos(way_rad)}}};
}

/* ---- the sampled plant ---- */

enum { N = 4 };

static void multiply(double a[N][N], double b[N][N], double scale, double out[N][N])
{
    for (int i = 0; i < N; ++i)
        for (int j = 0; j < N; ++j) {
            out[i][j] = 0.0;
            for (int k = 0; k < N; ++k)
                out[i][j] += scale * a[i][k] * b[k][j];
        }
}

/* Σ (A h)^n/n!, for a small A h. */
static void series(double a[N][N], double h, double out[N][N])
{
    double term[N][N], next[N][N];
    for (int i = 0; i < N; ++i)
        for (int j = 0; j < N; ++j)
            out[i][j] = term[i][j] = i == j;
    for (int n = 1; n < 12; ++n) {
        multiply(term, a, h / n, next);
        memcpy(term, next, sizeof term);
        for (int i = 0; i < N; ++i)
            for (int j = 0; j < N; ++j)
                out[i][j] += term[i][j];
    }
}

/* e^(A h) = (e^(A h/2^k))^(2^k). A: d/dt of i_d, i_q and of a voltage that stands still in the stator, so
 * that it turns backwards in the rotor. */
static void exponential(double a[N][N], double h, double out[N][N])
{
    double size = 0.0, twice[N][N];
    int halvings = 0;
    for (int i = 0; i < N; ++i)
        for (int j = 0; j < 2; ++j)
            size = fmax(size, fabs(a[i][j]) * h);
    while (ldexp(size, -halvings) > 0.1)
        ++halvings;
    series(a, ldexp(h, -halvings), out);
    for (; halvings > 0; --halvings) {
        multiply(out, out, 1.0, twice);
        memcpy(out, twice, sizeof twice);
    }
}

/* What current and voltage at the beginning of a stretch make of the current at its end. */
typedef struct {
    hci_matrix2 by_current, by_voltage;
} stretch;

static stretch stretch_of(const hci_loop_model *m, double h)
{
    const double w = m->speed_rad_per_s, r = m->resistance_ohm, *l = m->inductance_H;
    double a[N][N] = {{-r / l[0], w * l[1] / l[0], 1.0 / l[0], 0.0},
                      {-w * l[0] / l[1], -r / l[1], 0.0, 1.0 / l[1]},
                      {0.0, 0.0, 0.0, w},
                      {0.0, 0.0, -w, 0.0}};
    double e[N][N];
    stretch s;
    exponential(a, h, e);
    for (int i = 0; i < 2; ++i)
        for (int j = 0; j < 2; ++j) {
            s.by_current.m[i][j] = e[i][j];
            s.by_voltage.m[i][j] = e[i][j + 2];
        }
    return s;
}

/* i_(k+1) = Φ i_k + Γ_0 u_k + Γ_1 u_(k−1), u the output of the control in the rotor frame of its sample. */
typedef struct {
    hci_matrix2 current, now, before;
} sampled_plant;

static sampled_plant sample_plant(const hci_loop_model *m)
{
    const double late = m->sample_s - m->delay_s, w = m->speed_rad_per_s;
    const double ahead_rad = w * (m->delay_s + 0.5 * m->sample_s);
    const stretch old = stretch_of(m, m->delay_s), new = stretch_of(m, late);
    sampled_plant p;
    p.current = times(new.by_current, old.by_current);
    p.now = times(new.by_voltage, turned(ahead_rad - w * m->delay_s));
    p.before = times(times(new.by_current, old.by_voltage), turned(ahead_rad - w * m->sample_s));
    return p;
}

/* What the decoupling adds by the measured current. */
static hci_matrix2 decoupling_of(const hci_loop_model *m)
{
    const double w = m->decoupled ? m->speed_rad_per_s : 0.0;
    return (hci_matrix2){{{0.0, -w * m->inductance_H[1]}, {w * m->inductance_H[0], 0.0}}};
}

/* Share of a new reading in what the PI sees. */
static double new_share(const hci_loop_model *m)
{
    return m->filter > 0.0 ? m->filter : 1.0;
}

double complex hci_loop_filter_at(const hci_loop_model *m, double nu)
{
    const double share = new_share(m);
    return share / (1.0 - (1.0 - share) * cexp(-J * nu * m->sample_s));
}

hci_loop_model hci_loop_with_gains(hci_loop_model m, double factor)
{
    for (int axis = 0; axis < 2; ++axis) {
        m.kp_ohm[axis] *= factor;
        m.ki_ohm_per_s[axis] *= factor;
    }
    return m;
}

/* ---- the answer at one frequency ---- */

static double sinc(double x)
{
    return fabs(x) < 1e-9 ? 1.0 : sin(x) / x;
}

/* From the output of the control to the voltage in the rotor frame at the same frequency. */
static hci_matrix2 hold_at(const hci_loop_model *m, double nu)
{
    const double half = 0.5 * m->sample_s, w = m->speed_rad_per_s;
    const double ahead = sinc((nu + w) * half), behind = sinc((nu - w) * half);
    const double complex late = cexp(-J * nu * (m->delay_s + half));
    const double complex a = 0.5 * (ahead + behind) * late, b = 0.5 * (ahead - behind) * late;
    return (hci_matrix2){{{a, J * b}, {-J * b, a}}};
}

/* (R + jνL + ωJL)⁻¹. */
static hci_matrix2 admittance_at(const hci_loop_model *m, double nu)
{
    const double w = m->speed_rad_per_s, *l = m->inductance_H;
    hci_matrix2 z = diagonal(m->resistance_ohm + J * nu * l[0], m->resistance_ohm + J * nu * l[1]);
    z.m[0][1] = -w * l[1];
    z.m[1][0] = w * l[0];
    return inverse(z);
}

/* From held voltage to sampled current. */
static hci_matrix2 sampled_at(const hci_loop_model *m, double complex z)
{
    const sampled_plant p = sample_plant(m);
    return times(inverse(plus(diagonal(z, z), -1.0, p.current)), plus(p.now, 1.0 / z, p.before));
}

double complex hci_loop_sampling_at(const hci_loop_model *model, int axis, double nu)
{
    hci_loop_model m = *model;
    m.speed_rad_per_s = 0.0;
    const hci_matrix2 flows = times(admittance_at(&m, nu), hold_at(&m, nu));
    return sampled_at(&m, cexp(J * nu * m.sample_s)).m[axis][axis] / flows.m[axis][axis];
}

hci_loop_answer hci_loop_answer_at(const hci_loop_model *m, double nu)
{
    const double complex z = cexp(J * nu * m->sample_s);
    const double complex sum = m->sample_s / (z - 1.0);
    const hci_matrix2 admittance = admittance_at(m, nu);
    const hci_matrix2 control =
        diagonal(m->kp_ohm[0] + m->ki_ohm_per_s[0] * sum, m->kp_ohm[1] + m->ki_ohm_per_s[1] * sum);
    const hci_matrix2 feedback =
        plus(plus(diagonal(0.0, 0.0), hci_loop_filter_at(m, nu), control), -1.0, decoupling_of(m));
    const hci_matrix2 sampled = sampled_at(m, z);
    const hci_matrix2 loop = inverse(plus(diagonal(1.0, 1.0), 1.0, times(feedback, sampled)));
    const hci_matrix2 through = times(times(admittance, hold_at(m, nu)), loop);
    hci_loop_answer answer;
    answer.reference = times(through, control);
    answer.sampled = times(times(sampled, loop), control);
    answer.disturbance = plus(admittance, -1.0, times(times(through, feedback), admittance));
    return answer;
}

/* ---- stability ---- */

enum { CURRENT = 0, INTEGRAL = 2, OUTPUT = 4, FILTERED = 6, STATES = 8 };

/* What the control puts out of the states: −k_p of what it sees, its integral and the decoupling. */
static void put_output(const hci_loop_model *m, double u[2][STATES])
{
    const hci_matrix2 decoupling = decoupling_of(m);
    const double share = new_share(m);
    memset(u, 0, 2 * sizeof *u);
    for (int i = 0; i < 2; ++i) {
        for (int j = 0; j < 2; ++j)
            u[i][CURRENT + j] = creal(decoupling.m[i][j]);
        u[i][CURRENT + i] -= share * m->kp_ohm[i];
        u[i][FILTERED + i] = -(1.0 - share) * m->kp_ohm[i];
        u[i][INTEGRAL + i] = m->ki_ohm_per_s[i] > 0.0;
    }
}

/* The closed loop from one sample to the next. Without k_i there is no integral, whose state would stand
 * still on the circle. */
static void transition(const hci_loop_model *m, double a[STATES][STATES])
{
    const sampled_plant p = sample_plant(m);
    const double share = new_share(m);
    double u[2][STATES];
    put_output(m, u);
    memset(a, 0, STATES * sizeof *a);
    for (int i = 0; i < 2; ++i) {
        for (int k = 0; k < STATES; ++k)
            a[CURRENT + i][k] = creal(p.now.m[i][0]) * u[0][k] + creal(p.now.m[i][1]) * u[1][k];
        for (int j = 0; j < 2; ++j) {
            a[CURRENT + i][CURRENT + j] += creal(p.current.m[i][j]);
            a[CURRENT + i][OUTPUT + j] += creal(p.before.m[i][j]);
        }
        a[INTEGRAL + i][INTEGRAL + i] = m->ki_ohm_per_s[i] > 0.0;
        a[INTEGRAL + i][CURRENT + i] = -m->ki_ohm_per_s[i] * m->sample_s * share;
        a[INTEGRAL + i][FILTERED + i] = -m->ki_ohm_per_s[i] * m->sample_s * (1.0 - share);
        memcpy(a[OUTPUT + i], u[i], sizeof u[i]);
        a[FILTERED + i][CURRENT + i] = share;
        a[FILTERED + i][FILTERED + i] = 1.0 - share;
    }
}

/* Squares a, and takes its size out. Returns the logarithm of that. */
static double square(double a[STATES][STATES])
{
    double b[STATES][STATES], size = 0.0;
    for (int i = 0; i < STATES; ++i)
        for (int j = 0; j < STATES; ++j) {
            b[i][j] = 0.0;
            for (int k = 0; k < STATES; ++k)
                b[i][j] += a[i][k] * a[k][j];
            size = fmax(size, fabs(b[i][j]));
        }
    for (int i = 0; i < STATES; ++i)
        for (int j = 0; j < STATES; ++j)
            a[i][j] = size > 0.0 ? b[i][j] / size : 0.0;
    return size > 0.0 ? log(size) : -HUGE_VAL;
}

/* ρ = lim ‖A^n‖^(1/n) with n = 2^20 (Gelfand). */
double hci_loop_largest_pole(const hci_loop_model *model)
{
    double a[STATES][STATES], logarithm = 0.0;
    transition(model, a);
    for (int k = 0; k < 20; ++k)
        logarithm = 2.0 * logarithm + square(a);
    return exp(ldexp(logarithm, -20));
}

double hci_loop_slowest_s(const hci_loop_model *model)
{
    const double pole = hci_loop_largest_pole(model);
    return pole < 1.0 ? -model->sample_s / log(pole) : (double)INFINITY;
}
