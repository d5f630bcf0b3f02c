#include "core/effects/coenergy.h"

#include "core/math/phases.h"
#include "hci/machine/frames.h"

static const double SQRT_2_3 = 0.81649658092772603273;

static void fill_powers(double x, hci_coenergy_power *power)
{
    const hci_coenergy_power one = {1.0, 0.0, 0.0};
    power[0] = one;
    for (int k = 0; k < HCI_COENERGY_DEGREE; ++k) {
        power[k + 1].value = x * power[k].value;
        power[k + 1].first = x * power[k].first + power[k].value;
        power[k + 1].second = x * power[k].second + 2.0 * power[k].first;
    }
}

void hci_coenergy_begin(hci_coenergy *w, int pole_pairs, const hci_sample *truth, double unit_A)
{
    const double theta = pole_pairs * truth->theta_m_rad;
    const hci_alpha_beta i = hci_clarke(truth->i_abc);
    const hci_coenergy_monomial none = {-1, -1, 0.0, 0.0, 0.0, 0.0, 0.0};
    w->pole_pairs = pole_pairs;
    w->theta_m_rad = truth->theta_m_rad;
    w->unit_A = unit_A;
    hci_sine_cosine(theta, &w->sine, &w->cosine);
    w->i[0] = (-i.alpha * w->cosine - i.beta * w->sine) / unit_A; /* as hci_park */
    w->i[1] = (i.alpha * w->sine - i.beta * w->cosine) / unit_A;
    fill_powers(w->i[0], w->d);
    fill_powers(w->i[1], w->q);
    w->turning = (hci_turning)HCI_TURNING;
    w->waves = w->next = 0;
    w->monomial = none;
    w->torque_Nm = w->by_angle = w->by_d = w->by_q = w->by_dd = w->by_dq = w->by_qq = 0.0;
}

/* Takes what the last monomial collected into the sums. */
static void close_monomial(hci_coenergy *w)
{
    const hci_coenergy_monomial *m = &w->monomial;
    if (m->d < 0) return;
    const hci_coenergy_power *x = &w->d[m->d], *y = &w->q[m->q];
    const double p = w->pole_pairs, i_d = w->i[0], i_q = w->i[1];
    const double d = x->first * y->value, q = x->value * y->first;
    const double dd = x->second * y->value, dq = x->first * y->first, qq = x->value * y->second;
    const double rg_d = i_q * dd - q - i_d * dq, rg_q = d + i_q * dq - i_d * qq;
    const double rrg = i_q * rg_d - i_d * rg_q;
    w->torque_Nm += m->slope * m->g + p * m->value * m->rg;
    w->by_angle += m->curvature * m->g + 2.0 * p * m->slope * m->rg + p * p * m->value * rrg;
    w->by_d += m->slope * d + p * m->value * rg_d;
    w->by_q += m->slope * q + p * m->value * rg_q;
    w->by_dd += m->value * dd;
    w->by_dq += m->value * dq;
    w->by_qq += m->value * qq;
}

static void open_monomial(hci_coenergy *w, int a, int b)
{
    const hci_coenergy_power *x = &w->d[a], *y = &w->q[b];
    const hci_coenergy_monomial m = {
        a,   b,  x->value * y->value, w->i[1] * x->first * y->value - w->i[0] * x->value * y->first, 0.0,
        0.0, 0.0};
    w->monomial = m;
}

/* Place of a new oscillation; the last one's where there is no more room. */
static size_t new_wave(hci_coenergy *w, double order)
{
    const size_t at = w->waves < HCI_COENERGY_WAVES ? w->waves++ : HCI_COENERGY_WAVES - 1;
    hci_effect_turn_to(&w->turning, order, w->pole_pairs, w->theta_m_rad);
    w->wave[at].order = order;
    w->wave[at].periods = w->turning.k;
    w->wave[at].sine = w->turning.s;
    w->wave[at].cosine = w->turning.c;
    return at;
}

/* Monomials have the same orders one after the other. */
size_t hci_coenergy_wave_at(hci_coenergy *w, double order)
{
    size_t at = 0;
    while (at < w->waves && w->wave[at].order != order)
        ++at;
    return at < w->waves ? at : new_wave(w, order);
}

void hci_coenergy_go_on(hci_coenergy *w, int a, int b)
{
    close_monomial(w);
    open_monomial(w, a, b);
}

/* ∂i_d/∂i_s = −⅔ cos(θ − 2πs/3), ∂i_q/∂i_s = ⅔ sin(θ − 2πs/3) */
static void add_gradient(const hci_coenergy *w, hci_effect_torque *sum)
{
    const double turn_sine[3] = {0.0, HCI_SIN_THIRD, -HCI_SIN_THIRD},
                 turn_cosine[3] = {1.0, HCI_COS_THIRD, HCI_COS_THIRD};
    for (int s = 0; s < 3; ++s) {
        const double sine = w->sine * turn_cosine[s] - w->cosine * turn_sine[s];
        const double cosine = w->cosine * turn_cosine[s] + w->sine * turn_sine[s];
        sum->by_current[s] += 2.0 / 3.0 * (w->by_q * sine - w->by_d * cosine) / w->unit_A;
    }
}

/* ∂²/∂x² for the orthonormal x: (i_d, i_q) = √⅔ (−x_α cos θ − x_β sin θ, x_α sin θ − x_β cos θ) */
static void add_hessian(const hci_coenergy *w, hci_effect_torque *sum)
{
    const double d[2] = {-SQRT_2_3 * w->cosine, -SQRT_2_3 * w->sine};
    const double q[2] = {SQRT_2_3 * w->sine, -SQRT_2_3 * w->cosine};
    for (int k = 0; k < 3; ++k) {
        const int r = k / 2, c = (k + 1) / 2; /* αα, αβ, ββ */
        sum->inductance_H[k] +=
            (w->by_dd * d[r] * d[c] + w->by_dq * (d[r] * q[c] + q[r] * d[c]) + w->by_qq * q[r] * q[c]) /
            (w->unit_A * w->unit_A);
    }
}

void hci_coenergy_end(hci_coenergy *w, hci_effect_torque *sum)
{
    close_monomial(w);
    w->monomial.d = -1;
    sum->torque_Nm += w->torque_Nm;
    sum->by_angle += w->by_angle;
    add_gradient(w, sum);
    add_hessian(w, sum);
}
