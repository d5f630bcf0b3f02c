#include "effect_coenergy.h"

#include "hci/frames.h"

static const double SQRT_2_3 = 0.81649658092772603273;

/* x^n and its first two derivatives. */
typedef struct {
    double value, first, second;
} power;

static power power_of(double x, int n)
{
    power y = {1.0, 0.0, 0.0};
    for (int k = 0; k < n; ++k) {
        y.second = x * y.second + 2.0 * y.first;
        y.first = x * y.first + y.value;
        y.value = x * y.value;
    }
    return y;
}

/* A function of (i_d, i_q) with its derivatives. */
typedef struct {
    double value, d, q, dd, dq, qq;
} polynomial;

static polynomial monomial(double i_d, double i_q, int a, int b)
{
    const power x = power_of(i_d, a), y = power_of(i_q, b);
    const polynomial g = {x.value * y.value,  x.first * y.value, x.value * y.first,
                          x.second * y.value, x.first * y.first, x.value * y.second};
    return g;
}

/* ∂i_d/∂i_s = −⅔ cos(θ − 2πs/3), ∂i_q/∂i_s = ⅔ sin(θ − 2πs/3) */
static void add_gradient(hci_effect_torque *sum, double theta, double by_d, double by_q)
{
    for (int s = 0; s < 3; ++s) {
        const double x = theta - 2.0 * HCI_PI * s / 3.0;
        sum->by_current[s] += 2.0 / 3.0 * (by_q * sin(x) - by_d * cos(x));
    }
}

/* ∂²/∂x² for the orthonormal x: (i_d, i_q) = √⅔ (−x_α cos θ − x_β sin θ, x_α sin θ − x_β cos θ) */
static void add_hessian(hci_effect_torque *sum, double theta, double weight, const polynomial *g)
{
    const double d[2] = {-SQRT_2_3 * cos(theta), -SQRT_2_3 * sin(theta)};
    const double q[2] = {SQRT_2_3 * sin(theta), -SQRT_2_3 * cos(theta)};
    for (int k = 0; k < 3; ++k) {
        const int r = k / 2, c = (k + 1) / 2; /* αα, αβ, ββ */
        sum->inductance_H[k] +=
            weight * (g->dd * d[r] * d[c] + g->dq * (d[r] * q[c] + q[r] * d[c]) + g->qq * q[r] * q[c]);
    }
}

double hci_coenergy_add(hci_effect_torque *sum, double weight, const hci_coenergy_term *term, int pole_pairs,
                        const hci_sample *truth)
{
    const double p = pole_pairs, theta = p * truth->theta_m_rad;
    const double k = hci_effect_periods(term->order, pole_pairs);
    const hci_dq i = hci_park(hci_clarke(truth->i_abc), theta);
    const hci_effect_oscillation f = hci_effect_oscillate(term->cosine, k, k * truth->theta_m_rad);
    const polynomial g = monomial(i.d, i.q, term->d, term->q);
    const double rg = i.q * g.d - i.d * g.q;
    const double rg_d = i.q * g.dd - g.q - i.d * g.dq, rg_q = g.d + i.q * g.dq - i.d * g.qq;
    const double rrg = i.q * rg_d - i.d * rg_q;
    const double torque = f.slope * g.value + p * f.value * rg;
    sum->torque_Nm += weight * torque;
    sum->by_angle += weight * (-k * k * f.value * g.value + 2.0 * p * f.slope * rg + p * p * f.value * rrg);
    add_gradient(sum, theta, weight * (f.slope * g.d + p * f.value * rg_d),
                 weight * (f.slope * g.q + p * f.value * rg_q));
    add_hessian(sum, theta, weight * f.value, &g);
    return torque;
}
