#include "core/effects/phase_rates.h"

#include "hci/machine/frames.h"

void hci_phase_quarter(const double x[3], double y[3])
{
    const hci_alpha_beta a = hci_clarke(x);
    const hci_alpha_beta b = {-a.beta, a.alpha, 0.0};
    hci_clarke_inverse(b, y);
}

static bool is_known(const double rate[3])
{
    return rate[0] != 0.0 || rate[1] != 0.0 || rate[2] != 0.0;
}

static double electrical(int pole_pairs, const hci_sample *x)
{
    return pole_pairs * x->speed_rad_per_s;
}

hci_phase_rates hci_phase_rates_of(int pole_pairs, const hci_sample *x)
{
    const double w = electrical(pole_pairs, x);
    hci_phase_rates r = {.known = {is_known(x->change_A_per_s), is_known(x->curvature_A_per_s2)}};
    double turned[3], back[3], turned_rate[3];
    hci_phase_quarter(x->i_abc, turned);
    hci_phase_quarter(turned, back);
    hci_phase_quarter(x->change_A_per_s, turned_rate);
    for (int s = 0; s < 3; ++s) {
        r.first[s] = x->change_A_per_s[s] + w * turned[s];
        r.second[s] = x->curvature_A_per_s2[s] + 2.0 * w * turned_rate[s] + w * w * back[s];
    }
    return r;
}

void hci_phase_rates_set(int pole_pairs, const hci_phase_rates *r, hci_sample *x)
{
    const double w = electrical(pole_pairs, x);
    double turned[3], back[3], turned_rate[3];
    hci_phase_quarter(x->i_abc, turned);
    hci_phase_quarter(turned, back);
    for (int s = 0; s < 3 && r->known[0]; ++s)
        x->change_A_per_s[s] = r->first[s] - w * turned[s];
    hci_phase_quarter(x->change_A_per_s, turned_rate);
    for (int s = 0; s < 3 && r->known[1]; ++s)
        x->curvature_A_per_s2[s] = r->second[s] - 2.0 * w * turned_rate[s] - w * w * back[s];
}

/* A factor times J x is added. */
static void turned_add(double by, const double x[3], double to[3])
{
    double turned[3];
    hci_phase_quarter(x, turned);
    for (int s = 0; s < 3; ++s)
        to[s] += by * turned[s];
}

/* The same with J² x. */
static void turned_twice_add(double by, const double x[3], double to[3])
{
    double turned[3];
    hci_phase_quarter(x, turned);
    turned_add(by, turned, to);
}

static void unknown_leave(const hci_sample *x, hci_effect_torque *by)
{
    for (int s = 0; s < 3; ++s) {
        if (!is_known(x->change_A_per_s)) by->by_change[s] = 0.0;
        if (!is_known(x->curvature_A_per_s2)) by->by_curvature[s] = 0.0;
    }
}

/* Jᵀ = −J */
void hci_phase_rates_adjoint_set(int pole_pairs, const hci_sample *x, hci_effect_torque *by)
{
    const double w = electrical(pole_pairs, x);
    unknown_leave(x, by);
    turned_add(w, by->by_change, by->by_current);
    turned_twice_add(w * w, by->by_curvature, by->by_current);
    turned_add(2.0 * w, by->by_curvature, by->by_change);
    unknown_leave(x, by);
}

void hci_phase_rates_adjoint_of(int pole_pairs, const hci_sample *x, hci_effect_torque *by)
{
    const double w = electrical(pole_pairs, x);
    turned_add(-w, by->by_change, by->by_current);
    turned_twice_add(w * w, by->by_curvature, by->by_current);
    turned_add(-2.0 * w, by->by_curvature, by->by_change);
    unknown_leave(x, by);
}
