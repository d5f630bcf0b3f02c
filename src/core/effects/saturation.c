/* Iron that saturates: e and L' depend on the current, from the third to the eighth degree of the co-energy:
 *
 *     W' = Σ (S sin nθ + C cos nθ) (i_d/I_0)^a (i_q/I_0)^b      a + b = 3 … 8
 *
 * A polynomial is smooth through zero current, adds to the declared machine from the third degree on (the
 * first is the back-EMF, the second the inductance), and is linear in its coefficients. As a co-energy it is
 * integrable whatever the coefficients. The loss of mean torque with load is d1q2_cosine_0: T = p C (i_q³ − 2
 * i_d² i_q)/I_0³, the d flux weakened by i_q. Coefficients are in N·m (that is J) at the reference current
 * I_0. A little saturation is of degree 3 and 4; a machine far in it takes 6 and more. */
#include "core/effects/coenergy.h"

/* Powers a and b, degree by degree. */
#define DEGREE_3(X)  X(3, 0) X(2, 1) X(1, 2) X(0, 3)
#define DEGREE_4(X)  X(4, 0) X(3, 1) X(2, 2) X(1, 3) X(0, 4)
#define DEGREE_5(X)  X(5, 0) X(4, 1) X(3, 2) X(2, 3) X(1, 4) X(0, 5)
#define DEGREE_6(X)  X(6, 0) X(5, 1) X(4, 2) X(3, 3) X(2, 4) X(1, 5) X(0, 6)
#define DEGREE_7(X)  X(7, 0) X(6, 1) X(5, 2) X(4, 3) X(3, 4) X(2, 5) X(1, 6) X(0, 7)
#define DEGREE_8(X)  X(8, 0) X(7, 1) X(6, 2) X(5, 3) X(4, 4) X(3, 5) X(2, 6) X(1, 7) X(0, 8)
#define MONOMIALS(X) DEGREE_3(X) DEGREE_4(X) DEGREE_5(X) DEGREE_6(X) DEGREE_7(X) DEGREE_8(X)

#define PAIR(a, b)                                                                                           \
    HCI_ORDERED("d" #a "q" #b "_sine", "Nm", "co-energy with i_d^" #a " i_q^" #b ", of sin nθ", 1e-6,        \
                HCI_PARAMETER_LINEAR | HCI_PARAMETER_WITH_CURRENT),                                          \
        HCI_ORDERED("d" #a "q" #b "_cosine", "Nm", "co-energy with i_d^" #a " i_q^" #b ", of cos nθ", 0.0,   \
                    HCI_PARAMETER_LINEAR | HCI_PARAMETER_WITH_CURRENT),

#define POWERS(a, b) {a, b},

static const struct {
    int a, b;
} MONOMIAL[] = {MONOMIALS(POWERS)};

static const hci_effect_parameter PARAMETER[] = {
    MONOMIALS(PAIR) HCI_PLAIN("reference_current", "A", "current I_0 at which the coefficients are meant",
                              1.0, 1e-6, HCI_PARAMETER_REFERENCE_CURRENT | HCI_PARAMETER_WITH_CURRENT),
};

enum { REFERENCE_CURRENT = sizeof PARAMETER / sizeof *PARAMETER - 1 };

/* ∂T/∂I_0 = −Σ (a + b) T_k / I_0; by_value: those of the others are there. */
static void fill_by_reference(const hci_effect *effect, double reference_A, double *by_value)
{
    double by_reference = 0.0;
    for (size_t k = 0; k < effect->count; ++k) {
        const hci_effect_term *term = &effect->term[k];
        if (term->parameter == REFERENCE_CURRENT) continue;
        const int a = MONOMIAL[term->parameter / 2].a, b = MONOMIAL[term->parameter / 2].b;
        by_reference -= (a + b) * term->value * by_value[k] / reference_A;
    }
    for (size_t k = 0; k < effect->count; ++k)
        if (effect->term[k].parameter == REFERENCE_CURRENT) by_value[k] = by_reference;
}

static void torque_of_all(const hci_effect *effect, const hci_machine *machine, const hci_sample *truth,
                          hci_effect_torque *sum, double *by_value)
{
    const double reference_A = hci_effect_value(effect, REFERENCE_CURRENT);
    hci_coenergy w;
    hci_coenergy_begin(&w, machine->pole_pairs, truth, reference_A);
    for (size_t k = 0, count; k < effect->count; k += count) {
        const size_t parameter = effect->term[k].parameter, monomial = parameter / 2;
        count = hci_coenergy_run(effect, k);
        if (parameter == REFERENCE_CURRENT) continue;
        const hci_coenergy_kind kind = {MONOMIAL[monomial].a, MONOMIAL[monomial].b, parameter % 2 == 1, 1.0};
        hci_coenergy_add(&w, &kind, &effect->term[k], count, by_value ? &by_value[k] : NULL);
    }
    hci_coenergy_end(&w, sum);
    if (by_value) fill_by_reference(effect, reference_A, by_value);
}

/* From how many powers one is chosen. */
#define USUAL_MEAN  6.0
#define USUAL       30.0
#define UNSYMMETRIC 60.0 /* of a rotor that does not look alike both ways round */

#define EXPECTED 0.2  /* ripple of one power of the currents, as a share of the largest torque … */
#define FADING   0.25 /* … and of that from one degree to the next */

/* High powers of the currents resemble each other: without an expectation they would grow against each other.
 */
static double expected_Nm(const hci_effect_survey *survey, int degree, int order)
{
    const double share = survey->current_A > 0.0 ? survey->reference_current_A / survey->current_A : 1.0;
    const double most = survey->torque_Nm * pow(share, degree);
    if (order == 0)
        return most * pow(FADING, degree > 4 ? degree - 4 : 0) / (3.0 * survey->machine->pole_pairs);
    return EXPECTED * most * pow(FADING, degree - 3) / (survey->machine->pole_pairs * (double)order);
}

#define HARDLY 0.05 /* of the current: an i_d that is ripple, errors of the sensors or of the angle */

/* T = n p S' i_d^a i_q^b + p S (a i_d^{a-1} i_q^{b+1} − b i_d^{a+1} i_q^{b-1}): where no i_d was given, only
 * the mean of i_d i_q^b and the ripple of i_q^b are seen; that of i_d i_q^{b-1} looks the same, and what
 * little i_d there is would give the others a size that nobody has measured. */
static bool needs_direct(const hci_effect_survey *survey, size_t monomial, int order)
{
    return MONOMIAL[monomial].a != (order == 0) && survey->flows_d_A < HARDLY * survey->current_A;
}

/* One order of the power d^a q^b. A rotor that looks alike both ways round has cos for even and sin for odd
 * powers of i_q; the others are looked into at low orders only, and in the mean, where they make a torque
 * that keeps its sign with the load, only where the loads tell that. The mean has no sine. */
static void propose_order(const hci_effect_survey *survey, const hci_effect_proposals *to, size_t monomial,
                          int order)
{
    const int degree = MONOMIAL[monomial].a + MONOMIAL[monomial].b;
    const size_t usual = MONOMIAL[monomial].b % 2 == 0; /* 1: cosine */
    for (size_t k = 0; k < (survey->richness == 0 ? 2 : 1); ++k) {
        const size_t wave = k == 0 ? usual : 1 - usual;
        const double alternatives = k == 1 ? UNSYMMETRIC : order == 0 ? USUAL_MEAN : USUAL;
        if (needs_direct(survey, monomial, order)) continue;
        if (order == 0 && (wave == 0 || (k == 1 && survey->one_sided))) continue;
        hci_effect_propose(to, 2 * monomial + wave, 1, order, alternatives,
                           expected_Nm(survey, degree, order));
    }
}

static size_t monomial_at(int a, int b)
{
    size_t k = 0;
    while (MONOMIAL[k].a != a || MONOMIAL[k].b != b)
        ++k;
    return k;
}

/* Where the loads have one sign, the next power of the mean that turns with them is there in place of those
 * that do not, once there is saturation. */
static void propose(const hci_effect_survey *survey, const hci_effect_proposals *to)
{
    const int degrees = survey->richness > 1 ? 6 : 4, orders = survey->richness > 0 ? 60 : 12;
    if (!(survey->reference_current_A > 0.0)) return; /* a series in currents relative to it */
    for (size_t k = 0; MONOMIAL[k].a + MONOMIAL[k].b <= degrees; ++k)
        for (int order = 0; order <= orders; order += 6)
            propose_order(survey, to, k, order);
    if (survey->one_sided && survey->richness == 1) propose_order(survey, to, monomial_at(1, 4), 0);
}

static void propose_coenergy(const hci_effect_coenergy_series *series, const hci_effect_proposals *to)
{
    for (size_t k = 0; k < sizeof MONOMIAL / sizeof *MONOMIAL; ++k) {
        const int power = MONOMIAL[k].a + MONOMIAL[k].b;
        const size_t cosine = (MONOMIAL[k].b % 2 == 0) != series->unlike;
        const int orders = power <= series->power ? series->order : power <= series->mean_power ? 0 : -1;
        for (int n = cosine ? 0 : 6; n <= orders; n += 6)
            hci_effect_propose_coenergy(to, 2 * k + cosine, power, n, 1.0);
    }
}

const hci_effect_type hci_effect_saturation = {
    .name = "saturation",
    .title = "saturation",
    .equation = "T = ∂W'/∂θ_m, W' = Σ (S sin nθ + C cos nθ) (i_d/I_0)^a (i_q/I_0)^b",
    .signature =
        "grows with the third or a higher power of the current; mean torque lost with load, orders 6k",
    HCI_EFFECT_PARAMETERS(PARAMETER),
    .is_series = true,
    .propose = propose,
    .propose_coenergy = propose_coenergy,
    .in_machine = true,
    .beyond_quadratic = true,
    .torque_of_all = torque_of_all,
};
