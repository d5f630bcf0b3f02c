/* A co-energy that is a polynomial in the rotor-frame currents, and all that follows from it:
 *
 *     W' = Σ c f(θ) g(i_d, i_q)      f = sin nθ or cos nθ      g = i_d^a i_q^b
 *
 * At constant phase currents di_d/dθ = i_q and di_q/dθ = −i_d, so with R g = i_q ∂g/∂i_d − i_d ∂g/∂i_q
 *
 *     T = ∂W'/∂θ_m = p c (f' g + f R g)      ∂T/∂θ_m = p² c (f'' g + 2 f' R g + f R² g)
 *
 * Every such term conserves energy by construction, whatever its coefficient. A machine may have some hundred
 * terms: powers and oscillations are computed once for all of them, and what follows from a monomial once for
 * the terms that come one after the other with the same powers. */
#ifndef HCI_SRC_CORE_EFFECTS_COENERGY_H
#define HCI_SRC_CORE_EFFECTS_COENERGY_H

#include "core/effects/type.h"

enum {
    HCI_COENERGY_DEGREE = 8, /* of a monomial, at most */
    HCI_COENERGY_WAVES = 64, /* oscillations that are remembered */
};

/* x^n and its first two derivatives. */
typedef struct {
    double value, first, second;
} hci_coenergy_power;

/* c g at one angle for all terms of one monomial: Σ c f, Σ c f' and Σ c f'' by the mechanical angle. */
typedef struct {
    int d, q; /* powers a, b */
    double g, rg;
    double value, slope, curvature;
} hci_coenergy_monomial;

/* The sum at one sample. */
typedef struct {
    int pole_pairs;
    double theta_m_rad, unit_A;
    double sine, cosine; /* of θ */
    hci_turning turning;
    double i[2]; /* d, q in unit_A */
    hci_coenergy_power d[HCI_COENERGY_DEGREE + 1], q[HCI_COENERGY_DEGREE + 1];
    struct {
        double order, periods, sine, cosine;
    } wave[HCI_COENERGY_WAVES];     /* in the order in which they were met, */
    size_t waves, next;             /* so many, and the one that is likely to come next */
    hci_coenergy_monomial monomial; /* not in the sums below yet */
    double torque_Nm, by_angle;
    double by_d, by_q;          /* ∂T/∂(i_d, i_q), in unit_A */
    double by_dd, by_dq, by_qq; /* ∂²W'/∂(i_d, i_q)², in unit_A */
} hci_coenergy;

/* unit_A: the current in which the polynomials are meant. The zero sequence has no part in it. */
void hci_coenergy_begin(hci_coenergy *w, int pole_pairs, const hci_sample *truth, double unit_A);

/* Place of the oscillation of an order, wherever it is. */
size_t hci_coenergy_wave_at(hci_coenergy *w, double order);

/* From the last monomial to another one. */
void hci_coenergy_go_on(hci_coenergy *w, int a, int b);

/* Adds c f g with a, b >= 0 and a + b <= HCI_COENERGY_DEGREE; returns its torque for c = 1. */
static inline double hci_coenergy_add(hci_coenergy *w, int a, int b, bool cosine, double order, double c)
{
    const bool is_next = w->next < w->waves && w->wave[w->next].order == order;
    const size_t at = is_next ? w->next : hci_coenergy_wave_at(w, order);
    const double k = w->wave[at].periods;
    const double f = cosine ? w->wave[at].cosine : w->wave[at].sine;
    const double slope = cosine ? -k * w->wave[at].sine : k * w->wave[at].cosine;
    w->next = at + 1 < w->waves ? at + 1 : 0;
    if (w->monomial.d != a || w->monomial.q != b) hci_coenergy_go_on(w, a, b);
    w->monomial.value += c * f;
    w->monomial.slope += c * slope;
    w->monomial.curvature -= c * k * k * f;
    return slope * w->monomial.g + w->pole_pairs * f * w->monomial.rg;
}

/* Adds torque, its derivatives and ∂²W'/∂i² to *sum. */
void hci_coenergy_end(hci_coenergy *w, hci_effect_torque *sum);

#endif
