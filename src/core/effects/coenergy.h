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

/* What terms of one parameter have in common: c = scale × value, powers a and b, and f. */
typedef struct {
    int d, q;
    bool cosine;
    double scale;
} hci_coenergy_kind;

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

/* From the term at `at` on, how many have its parameter: those of one monomial and one of sine and cosine. */
static inline size_t hci_coenergy_run(const hci_effect *effect, size_t at)
{
    size_t end = at + 1;
    while (end < effect->count && effect->term[end].parameter == effect->term[at].parameter)
        ++end;
    return end - at;
}

/* Adds c f g of `count` terms with c = scale × value, a, b >= 0 and a + b <= HCI_COENERGY_DEGREE.
 * by_value: out, the torque of each for a value of 1, or NULL. */
static inline void hci_coenergy_add(hci_coenergy *w, const hci_coenergy_kind *kind,
                                    const hci_effect_term *term, size_t count, double *by_value)
{
    if (w->monomial.d != kind->d || w->monomial.q != kind->q) hci_coenergy_go_on(w, kind->d, kind->q);
    hci_coenergy_monomial m = w->monomial; /* a copy, which need not be in memory from one term to the next */
    for (size_t t = 0; t < count; ++t) {
        const double c = kind->scale * term[t].value;
        const bool is_next = w->next < w->waves && w->wave[w->next].order == term[t].order;
        const size_t at = is_next ? w->next : hci_coenergy_wave_at(w, term[t].order);
        const double k = w->wave[at].periods;
        const double f = kind->cosine ? w->wave[at].cosine : w->wave[at].sine;
        const double slope = kind->cosine ? -k * w->wave[at].sine : k * w->wave[at].cosine;
        w->next = at + 1 < w->waves ? at + 1 : 0;
        m.value += c * f;
        m.slope += c * slope;
        m.curvature -= c * k * k * f;
        if (by_value) by_value[t] = kind->scale * (slope * m.g + w->pole_pairs * f * m.rg);
    }
    w->monomial = m;
}

/* Adds torque, its derivatives and ∂²W'/∂i² to *sum. */
void hci_coenergy_end(hci_coenergy *w, hci_effect_torque *sum);

#endif
