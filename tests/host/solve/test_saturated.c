/* `solve` for machines with effects, saturation above all. The torque is tested by formulas that stand here
 * once more: Park's transform, the co-energy's polynomials, cosines. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "hci/host/machine/effects.h"
#include "hci/host/solve/solve.h"
#include "host/base/memory.h"
#include "host/solve/kept_angle.h"
#include "support/effect_list.h"
#include "support/reference.h"
#include "unity.h"

/* Angles in a turn at which torques are compared; test_saturated_at_length has more of them, and the tests
 * that take long. */
#ifdef AT_LENGTH
enum { P = 3, SAMPLES = 1024, MEANS = 4, LONG_ONES = 1 };
#else
enum { P = 3, SAMPLES = 256, MEANS = 1, LONG_ONES = 0 };
#endif

#define UNIT_A 8.0

/* value (i_d/I_0)^a (i_q/I_0)^b cos nθ, or sin nθ, in N·m. */
typedef struct {
    int a, b;
    double order;
    bool cosine;
    double value;
} term;

static const term TERMS[] = {
    {2, 0, 0.0, true, -0.10}, {0, 2, 0.0, true, 0.10},  {1, 1, 6.0, false, 0.02},  {1, 2, 0.0, true, -0.40},
    {3, 0, 6.0, true, 0.02},  {0, 3, 6.0, false, 0.02}, {2, 2, 6.0, true, 0.02},   {0, 4, 0.0, true, 0.10},
    {1, 4, 0.0, true, -0.10}, {3, 2, 6.0, true, 0.01},  {0, 6, 12.0, true, 0.004}, {4, 4, 6.0, true, -0.002},
};
enum { TERM_COUNT = sizeof TERMS / sizeof *TERMS };

static const ref_wave EMF[] = {{1, 1, 1.0, 0.0}, {5, 5, 0.06, 0.4}, {7, 7, 0.04, -1.0}};
static const ref_wave COGGING[] = {{6, 0, 0.12, 0.3}, {12, 0, 0.06, -0.9}};

/* ---- torque by formulas of its own ---- */

static void park(double theta, const double i[3], double dq[2])
{
    dq[0] = dq[1] = 0.0;
    for (int s = 0; s < 3; ++s) {
        dq[0] -= 2.0 / 3.0 * cos(theta - 2.0 * REF_PI * s / 3.0) * i[s];
        dq[1] += 2.0 / 3.0 * sin(theta - 2.0 * REF_PI * s / 3.0) * i[s];
    }
}

static void unpark(double theta, double d, double q, double i[3])
{
    for (int s = 0; s < 3; ++s)
        i[s] = q * sin(theta - 2.0 * REF_PI * s / 3.0) - d * cos(theta - 2.0 * REF_PI * s / 3.0);
}

static double coenergy(const term *t, size_t count, double theta, const double i[3])
{
    double dq[2], sum = 0.0;
    park(theta, i, dq);
    for (size_t k = 0; k < count; ++k)
        sum += t[k].value * pow(dq[0] / UNIT_A, t[k].a) * pow(dq[1] / UNIT_A, t[k].b) *
               (t[k].cosine ? cos(t[k].order * theta) : sin(t[k].order * theta));
    return sum;
}

/* p ∂W'/∂θ: of f, and of g through i_d' = i_q, i_q' = −i_d. */
static double term_torque(const term *t, double theta, const double dq[2])
{
    const double d = dq[0] / UNIT_A, q = dq[1] / UNIT_A, x = t->order * theta;
    const double f = t->cosine ? cos(x) : sin(x), slope = t->order * (t->cosine ? -sin(x) : cos(x));
    const double by_d = t->a > 0 ? t->a * pow(d, t->a - 1) * pow(q, t->b) : 0.0;
    const double by_q = t->b > 0 ? t->b * pow(d, t->a) * pow(q, t->b - 1) : 0.0;
    return P * t->value * (slope * pow(d, t->a) * pow(q, t->b) + f * (q * by_d - d * by_q));
}

static double declared_torque(double theta, const double i[3])
{
    double sum = 0.0;
    for (int s = 0; s < 3; ++s)
        sum += i[s] * ref_waves_at(EMF, 3, s, theta);
    return sum + ref_waves_at(COGGING, 2, 0, theta);
}

static double torque_at(double theta, const double i[3])
{
    double sum = declared_torque(theta, i), dq[2];
    park(theta, i, dq);
    for (int k = 0; k < TERM_COUNT; ++k)
        sum += term_torque(&TERMS[k], theta, dq);
    return sum;
}

static void waves_at(const hci_wave *w, size_t count, double theta, double i[3])
{
    i[0] = i[1] = i[2] = 0.0;
    for (size_t k = 0; k < count; ++k)
        for (int s = 0; s < 3; ++s) {
            const double x = w[k].order * theta - w[k].sequence * 2.0 * REF_PI * s / 3.0;
            i[s] += w[k].sine * sin(x) + w[k].cosine * cos(x);
        }
}

/* ---- the same as structs ---- */

static hci_wave emf[3];
static hci_harmonic cogging[2];
static hci_machine_data machine;
static el_list effects;

static void add_terms(el_list *l, const term *t, size_t count)
{
    for (size_t k = 0; k < count; ++k) {
        char name[16];
        const char *kind = t[k].cosine ? "cosine" : "sine";
        if (t[k].a + t[k].b == 2) {
            snprintf(name, sizeof name, "%s_%s", t[k].b == 0 ? "dd" : t[k].b == 1 ? "dq" : "qq", kind);
            el_add(l, "reluctance", name, t[k].order,
                   t[k].value / (UNIT_A * UNIT_A) / (t[k].b == 1 ? 1.5 : 0.75));
        } else {
            snprintf(name, sizeof name, "d%dq%d_%s", t[k].a, t[k].b, kind);
            el_add(l, "saturation", name, t[k].order, t[k].value);
        }
    }
    el_add(l, "saturation", "reference_current", 0.0, UNIT_A);
}

void setUp(void)
{
    for (int k = 0; k < 3; ++k)
        emf[k] =
            hci_wave_polar(EMF[k].order, hci_sequence_of_order(EMF[k].order), EMF[k].amplitude, EMF[k].phase);
    for (int k = 0; k < 2; ++k)
        cogging[k] = hci_harmonic_polar(COGGING[k].order, COGGING[k].amplitude, COGGING[k].phase);
    memset(&machine, 0, sizeof machine);
    machine.pole_pairs = P;
    machine.resistance_ohm = machine.inductance_d_H = machine.inductance_q_H = NAN;
    machine.model = (hci_machine){P, emf, 3, cogging, 2, NULL, 0};
    memset(&effects, 0, sizeof effects);
    add_terms(&effects, TERMS, TERM_COUNT);
}

void tearDown(void)
{
}

static hci_target_order wanted[2];
static const hci_target TARGET = {wanted, 2};

static void want(double mean_Nm, double order, double amplitude_Nm)
{
    wanted[0] = (hci_target_order){{0.0, 0.0, mean_Nm}, 1.0};
    wanted[1] = (hci_target_order){{order, amplitude_Nm, 0.0}, 1.0};
}

static double wanted_at(double theta)
{
    return wanted[0].torque_Nm.cosine + wanted[1].torque_Nm.sine * sin(wanted[1].torque_Nm.order * theta);
}

static hci_solve_options options(void)
{
    hci_solve_options o = {0};
    o.target = &TARGET;
    o.effects = &effects.list;
    return o;
}

static hci_status solve(const hci_solve_options *o, hci_solution *s)
{
    hci_note note = {{0}};
    const hci_status status = hci_solve(&machine, o, s, &note);
    TEST_ASSERT_TRUE_MESSAGE(status <= HCI_NOT_REACHED, note.text);
    return status;
}

/* Largest distance of the torque from the wanted one, over `turns`. */
static double worst_torque(const hci_solution *s, int turns, double (*torque)(double, const double[3]))
{
    double worst = 0.0;
    for (int j = 0; j < SAMPLES * turns; ++j) {
        const double theta = 2.0 * REF_PI * j / SAMPLES + 0.001;
        double i[3];
        waves_at(s->current.wave, s->current.count, theta, i);
        worst = ref_worse(worst, torque(theta, i) - wanted_at(theta));
    }
    return worst;
}

/* Largest distance of the torque from its promised spectrum. */
static double worst_promise(const hci_solution *s, int turns, double (*torque)(double, const double[3]))
{
    double worst = 0.0;
    for (int j = 0; j < SAMPLES * turns; ++j) {
        const double theta = 2.0 * REF_PI * j / SAMPLES + 0.001;
        double i[3], promised = 0.0;
        waves_at(s->current.wave, s->current.count, theta, i);
        for (size_t k = 0; k < s->order_count; ++k) {
            const hci_harmonic h = s->order[k].torque_Nm;
            promised += h.sine * sin(h.order * theta) + h.cosine * cos(h.order * theta);
        }
        worst = ref_worse(worst, torque(theta, i) - promised);
    }
    return worst;
}

/* Root mean square of the difference of two currents. */
static double distance_A(const hci_solution *x, const hci_solution *y)
{
    double sum = 0.0;
    for (int j = 0; j < SAMPLES; ++j) {
        double a[3], b[3];
        waves_at(x->current.wave, x->current.count, 2.0 * REF_PI * j / SAMPLES, a);
        waves_at(y->current.wave, y->current.count, 2.0 * REF_PI * j / SAMPLES, b);
        for (int s = 0; s < 3; ++s)
            sum += (a[s] - b[s]) * (a[s] - b[s]) / SAMPLES;
    }
    return sqrt(sum);
}

/* ---- the type ---- */

/* Every monomial of degree 3 to 8, its torque and what is derived from it against differences of the
 * co-energy. */
static void test_every_degree(void)
{
    uint64_t seed = 3;
    const double h = 1e-3;
    for (int a = 0; a <= 8; ++a)
        for (int b = 0; a + b <= 8; ++b) {
            const term t = {a, b, 6.0 * ref_integer(&seed, 0, 4), ref_integer(&seed, 0, 1) == 1, 0.7};
            const term c = {a, b, t.order, t.cosine || t.order < 1.0, t.value};
            el_list l = {0};
            hci_sample x = {0};
            double ahead[3], behind[3], theta, by;
            if (a + b < 3) continue;
            add_terms(&l, &c, 1);
            theta = ref_uniform(&seed, -3.0, 9.0);
            x.theta_m_rad = theta / P;
            for (int s = 0; s < 3; ++s)
                x.i_abc[s] = ref_uniform(&seed, -9.0, 9.0);
            const hci_effect_torque found = hci_effects_torque(&machine.model, &l.list, &x, NULL);
            by = P *
                 (8.0 * (coenergy(&c, 1, theta + h, x.i_abc) - coenergy(&c, 1, theta - h, x.i_abc)) -
                  (coenergy(&c, 1, theta + 2.0 * h, x.i_abc) - coenergy(&c, 1, theta - 2.0 * h, x.i_abc))) /
                 (12.0 * h);
            TEST_ASSERT_DOUBLE_WITHIN(1e-6 * (1.0 + fabs(by)), by, found.torque_Nm);
            for (int s = 0; s < 3; ++s) {
                hci_sample more = x, less = x;
                more.i_abc[s] += h;
                less.i_abc[s] -= h;
                by = (hci_effects_torque(&machine.model, &l.list, &more, NULL).torque_Nm -
                      hci_effects_torque(&machine.model, &l.list, &less, NULL).torque_Nm) /
                     (2.0 * h);
                TEST_ASSERT_DOUBLE_WITHIN(1e-4 * (1.0 + fabs(by)), by, found.by_current[s]);
            }
            /* ∂²W'/∂x² along α of the orthonormal plane, whose unit vector is √⅔ (1, −½, −½) */
            for (int s = 0; s < 3; ++s) {
                ahead[s] = x.i_abc[s] + 0.01 * sqrt(2.0 / 3.0) * (s == 0 ? 1.0 : -0.5);
                behind[s] = x.i_abc[s] - 0.01 * sqrt(2.0 / 3.0) * (s == 0 ? 1.0 : -0.5);
            }
            by = (coenergy(&c, 1, theta, ahead) + coenergy(&c, 1, theta, behind) -
                  2.0 * coenergy(&c, 1, theta, x.i_abc)) /
                 1e-4;
            TEST_ASSERT_DOUBLE_WITHIN(1e-4 * (1.0 + fabs(by)), by, found.inductance_H[0]);
        }
}

/* Terms in any order, and many: the sum is that of the single ones, regressors included. */
static void test_many_terms(void)
{
    static const char *const NAME[] = {"d3q0_cosine", "d0q8_sine", "d1q2_cosine", "d5q2_sine", "d1q2_sine"};
    const hci_sample x = {.theta_m_rad = 0.3, .i_abc = {3.0, -7.0, 4.0}, .temperature_C = NAN};
    el_list all = {0};
    double by[EL_TERMS], sum = 0.0;
    size_t n = 0;
    for (int k = 0; k < 60; ++k)
        el_add(&all, "saturation", NAME[k % 5], 61.0 / P * (double)(k % 12) + 1.0, 0.01 * (k + 1));
    el_add(&all, "saturation", "reference_current", 0.0, UNIT_A);
    for (int k = 0; k < 60; ++k) {
        el_list one = {0};
        el_add(&one, "saturation", NAME[k % 5], 61.0 / P * (double)(k % 12) + 1.0, 0.01 * (k + 1));
        el_add(&one, "saturation", "reference_current", 0.0, UNIT_A);
        sum += hci_effects_torque(&machine.model, &one.list, &x, NULL).torque_Nm;
    }
    TEST_ASSERT_DOUBLE_WITHIN(1e-11 * (1.0 + fabs(sum)), sum,
                              hci_effects_torque(&machine.model, &all.list, &x, by).torque_Nm);
    for (double total = 0.0; n < 60; ++n) {
        total += by[n] * 0.01 * (double)(n + 1);
        if (n == 59) TEST_ASSERT_DOUBLE_WITHIN(1e-11 * (1.0 + fabs(sum)), sum, total);
    }
}

/* ---- harmonic balance and angle by angle ---- */

static void test_harmonic_balance(void)
{
    hci_solve_options o = options();
    hci_solution s, pointwise;
    want(10.0, 6.0, 0.5);
    TEST_ASSERT_EQUAL_INT(HCI_OK, solve(&o, &s));
    TEST_ASSERT_TRUE(s.newton_converged && s.newton_steps > 1);
    TEST_ASSERT_NULL(s.per_Nm);
    TEST_ASSERT_TRUE(s.with_effects);
    TEST_ASSERT_TRUE(worst_torque(&s, 1, torque_at) < 1e-5); /* the tolerance is 1e-5 an order */
    TEST_ASSERT_TRUE(worst_promise(&s, 1, torque_at) < 1e-10);
    o.method = HCI_METHOD_POINTWISE;
    TEST_ASSERT_EQUAL_INT(HCI_OK, solve(&o, &pointwise));
    TEST_ASSERT_TRUE(worst_torque(&pointwise, 1, torque_at) < 1e-8);
    TEST_ASSERT_TRUE(worst_promise(&pointwise, 1, torque_at) < 1e-9);
    TEST_ASSERT_TRUE(distance_A(&s, &pointwise) < 0.05);
    TEST_ASSERT_DOUBLE_WITHIN(1e-6, 1.0, pointwise.loss_to_limit);
    TEST_ASSERT_TRUE(s.loss_to_limit > 1.0 - 1e-6 && s.loss_to_limit < 1.01);
    hci_solution_release(&s);
    hci_solution_release(&pointwise);
}

/* Sum of the squares of the torque's distance from the wanted one. */
static double squared_error(const hci_wave *wave, size_t count)
{
    double sum = 0.0;
    for (int j = 0; j < SAMPLES; ++j) {
        const double theta = 2.0 * REF_PI * j / SAMPLES;
        double i[3];
        waves_at(wave, count, theta, i);
        sum += (torque_at(theta, i) - wanted_at(theta)) * (torque_at(theta, i) - wanted_at(theta)) / SAMPLES;
    }
    return sum;
}

/* Too few components to reach the torque: their least squares lie below those of the pointwise current cut to
 * the set, and no single coordinate can be bettered by much. */
static void test_a_given_set(void)
{
    static const hci_component COMPONENT[] = {{1.0, 1}, {5.0, -1}, {7.0, 1}, {11.0, -1}};
    static const hci_set NAME[] = {HCI_SET_POS, HCI_SET_NEG, HCI_SET_POS, HCI_SET_NEG};
    hci_component component[4];
    hci_set name[4];
    const hci_component_set set = {component, name, 4, {{0}}};
    hci_solve_options o = options();
    hci_solution s, pointwise;
    hci_wave cut[4];
    size_t count = 0;
    memcpy(component, COMPONENT, sizeof component);
    memcpy(name, NAME, sizeof name);
    want(10.0, 12.0, 0.0);
    o.set = &set;
    TEST_ASSERT_EQUAL_INT(HCI_NOT_REACHED, solve(&o, &s));
    TEST_ASSERT_TRUE(worst_promise(&s, 1, torque_at) < 1e-10);
    o.set = NULL;
    o.method = HCI_METHOD_POINTWISE;
    solve(&o, &pointwise);
    for (size_t k = 0; k < pointwise.current.count; ++k)
        for (int j = 0; j < 4; ++j)
            if (fabs(pointwise.current.wave[k].order - COMPONENT[j].order) < 1e-6 &&
                pointwise.current.wave[k].sequence == COMPONENT[j].sequence)
                cut[count++] = pointwise.current.wave[k];
    TEST_ASSERT_EQUAL_UINT64(4, count);
    const double least = squared_error(s.current.wave, 4);
    TEST_ASSERT_TRUE(least < squared_error(cut, 4));
    for (int k = 0; k < 8; ++k)
        for (double change = -0.01; change < 0.02; change += 0.02) {
            hci_wave moved[4];
            memcpy(moved, s.current.wave, sizeof moved);
            *(k % 2 ? &moved[k / 2].sine : &moved[k / 2].cosine) += change;
            TEST_ASSERT_TRUE(squared_error(moved, 4) > least);
        }
    hci_solution_release(&s);
    hci_solution_release(&pointwise);
}

/* The shortest i with the wanted torque, by brute force: 720 directions, the first crossing along each. */
static double shortest_by_force(double theta, double torque_Nm)
{
    double least = 40.0;
    for (int k = 0; k < 720; ++k) {
        const double c = cos(2.0 * REF_PI * k / 720), s = sin(2.0 * REF_PI * k / 720);
        double low = 0.0, i[3];
        unpark(theta, 0.0, 0.0, i);
        const bool above = torque_at(theta, i) > torque_Nm;
        for (double r = 0.25; r < least + 0.25; r += 0.25) {
            double high = r;
            unpark(theta, r * c, r * s, i);
            if ((torque_at(theta, i) > torque_Nm) == above) {
                low = r;
                continue;
            }
            for (int step = 0; step < 40; ++step) {
                const double middle = 0.5 * (low + high);
                unpark(theta, middle * c, middle * s, i);
                *((torque_at(theta, i) > torque_Nm) == above ? &low : &high) = middle;
            }
            least = fmin(least, high);
            break;
        }
    }
    return least;
}

/* A minimum over directions is flat: 720 of them miss it by some (π/720)²/2 of it, 1e-5. */
static void test_shortest_currents_are_the_shortest_of_all(void)
{
    static const double MEAN[] = {10.0, -14.0, 3.0, 18.0};
    for (size_t m = 0; m < MEANS; ++m) {
        hci_solve_options o = options();
        hci_solution s;
        want(MEAN[m], 6.0, 0.4);
        o.method = HCI_METHOD_POINTWISE;
        TEST_ASSERT_EQUAL_INT(HCI_OK, solve(&o, &s));
        for (int k = 0; k < 9; ++k) {
            const double theta = 0.05 + 2.0 * REF_PI * k / 9;
            double i[3], dq[2];
            waves_at(s.current.wave, s.current.count, theta, i);
            park(theta, i, dq);
            TEST_ASSERT_DOUBLE_WITHIN(3e-5 * hypot(dq[0], dq[1]), shortest_by_force(theta, wanted_at(theta)),
                                      hypot(dq[0], dq[1]));
        }
        hci_solution_release(&s);
    }
}

/* Torque that turns around along q: i_d has to help. */
static void test_far_into_saturation(void)
{
    hci_solve_options o = options();
    hci_solution s;
    const term droop = {1, 2, 0.0, true, -6.0}; /* T = 1.5·8 q − 18 q³ along q: 3.8 N·m at most there */
    memset(&effects, 0, sizeof effects);
    add_terms(&effects, &droop, 1);
    want(2.0, 12.0, 0.0);
    o.method = HCI_METHOD_POINTWISE;
    TEST_ASSERT_EQUAL_INT(HCI_OK, solve(&o, &s));
    TEST_ASSERT_TRUE(s.peak_phase_current_A < UNIT_A);
    hci_solution_release(&s);
    o.strategy = HCI_STRATEGY_ID0; /* 2 N·m of mutual torque are less of all torque */
    TEST_ASSERT_EQUAL_INT(HCI_NOT_REACHED, solve(&o, &s));
    TEST_ASSERT_DOUBLE_WITHIN(0.02, 2.0 - 18.0 * pow(2.0 / 12.0, 3.0), s.order[0].torque_Nm.cosine);
    hci_solution_release(&s);
}

/* i_q is that of the mutual torque, i_d the shortest with the wanted torque. */
static void test_cancel(void)
{
    hci_solve_options o = options();
    hci_solution s;
    want(10.0, 12.0, 0.0);
    o.method = HCI_METHOD_POINTWISE;
    o.strategy = HCI_STRATEGY_CANCEL;
    TEST_ASSERT_EQUAL_INT(HCI_OK, solve(&o, &s));
    TEST_ASSERT_TRUE(worst_torque(&s, 1, torque_at) < 1e-6);
    TEST_ASSERT_EQUAL_UINT64(0, s.gap_count);
    for (int k = 0; k < 12; ++k) {
        const double theta = 0.05 + 2.0 * REF_PI * k / 12;
        double i[3], e[3], mutual = 0.0, mean = 0.0, square = 0.0, i_d[3], length = 0.0;
        waves_at(s.current.wave, s.current.count, theta, i);
        for (int p = 0; p < 3; ++p)
            mean += (e[p] = ref_waves_at(EMF, 3, p, theta)) / 3.0;
        for (int p = 0; p < 3; ++p) {
            mutual += i[p] * (e[p] - mean);
            square += (e[p] - mean) * (e[p] - mean);
        }
        TEST_ASSERT_DOUBLE_WITHIN(1e-6, 10.0, mutual);
        for (int p = 0; p < 3; ++p) {
            i_d[p] = i[p] - 10.0 * (e[p] - mean) / square;
            length += i_d[p] * i_d[p];
        }
        /* no shorter i_d of either sign: the torque does not pass 10 N·m on the way to it or to its opposite
         */
        const double none[3] = {i[0] - i_d[0], i[1] - i_d[1], i[2] - i_d[2]};
        const bool above = torque_at(theta, none) > 10.0;
        for (double x = -0.99; x < 0.99; x += 0.01) {
            const double y[3] = {none[0] + x * i_d[0], none[1] + x * i_d[1], none[2] + x * i_d[2]};
            TEST_ASSERT_EQUAL_INT(above, torque_at(theta, y) > 10.0);
        }
        TEST_ASSERT_TRUE(length > 1e-6);
    }
    hci_solution_release(&s);
}

/* ---- currents that keep their angle in the rotor frame ---- */

static double quadratic_torque_at(double theta, const double i[3])
{
    double sum = declared_torque(theta, i), dq[2];
    park(theta, i, dq);
    for (int k = 0; k < 3; ++k)
        sum += term_torque(&TERMS[k], theta, dq);
    return sum;
}

/* The torque is the wanted one, and i_d = −I sin β, i_q = I cos β at each angle. */
static void expect_kept(double angle_rad, double (*torque)(double, const double[3]), hci_solution *s)
{
    hci_solve_options o = options();
    o.method = HCI_METHOD_POINTWISE;
    o.current_angle_rad = &angle_rad;
    o.effects = effects.list.count > 0 ? &effects.list : NULL;
    TEST_ASSERT_EQUAL_INT(HCI_OK, solve(&o, s));
    TEST_ASSERT_EQUAL_UINT64(0, s->gap_count);
    TEST_ASSERT_TRUE(worst_torque(s, 1, torque) < 1e-6);
    for (int k = 0; k < 50; ++k) {
        const double theta = 0.05 + 2.0 * REF_PI * k / 50;
        double i[3], dq[2];
        waves_at(s->current.wave, s->current.count, theta, i);
        park(theta, i, dq);
        TEST_ASSERT_DOUBLE_WITHIN(1e-6, 0.0, dq[0] * cos(angle_rad) + dq[1] * sin(angle_rad));
    }
}

static void test_currents_keep_their_angle(void)
{
    static const double ANGLE[] = {0.0, 0.3, -0.2}, MEAN[] = {10.0, -6.0};
    for (int k = 0; k < 6; ++k) {
        hci_solution s;
        want(MEAN[k % 2], 6.0, 0.5);
        setUp();
        expect_kept(ANGLE[k / 2], torque_at, &s);
        hci_solution_release(&s);
        memset(&effects, 0, sizeof effects);
        add_terms(&effects, TERMS, 3);
        effects.list.count = 1; /* reluctance alone */
        expect_kept(ANGLE[k / 2], quadratic_torque_at, &s);
        hci_solution_release(&s);
        memset(&effects, 0, sizeof effects);
        expect_kept(ANGLE[k / 2], declared_torque, &s);
        TEST_ASSERT_NOT_NULL(s.per_Nm);
        hci_solution_release(&s);
    }
}

/* What they are compared with has their direction, and makes the mean torque with all that acts along it: the
 * sum over the angle of what this makes of the sine. */
static void expect_plain(double angle_rad, double mean_Nm, double (*torque)(double, const double[3]),
                         hci_solution *s)
{
    enum { MANY = 720 };
    double sum_Nm = 0.0;
    for (int k = 0; k < MANY; ++k) {
        double i[3], dq[2];
        waves_at(&s->plain, 1, 2.0 * REF_PI * k / MANY, i);
        park(2.0 * REF_PI * k / MANY, i, dq);
        TEST_ASSERT_DOUBLE_WITHIN(1e-9, 0.0, dq[0] * cos(angle_rad) + dq[1] * sin(angle_rad));
        sum_Nm += torque(2.0 * REF_PI * k / MANY, i) / MANY;
    }
    TEST_ASSERT_DOUBLE_WITHIN(1e-7, mean_Nm, sum_Nm);
    TEST_ASSERT_DOUBLE_WITHIN(
        1e-9, 1.0, s->loss_to_plain * 1.5 * s->plain_amplitude_A * s->plain_amplitude_A / s->mean_square_A2);
}

static void test_the_plain_sine_has_the_kept_direction(void)
{
    static const double ANGLE[] = {0.0, 0.4, -0.3};
    for (int k = 0; k < 6; ++k) {
        const double mean_Nm = k % 2 ? -6.0 : 10.0;
        hci_solution s;
        want(mean_Nm, 6.0, 0.5);
        setUp();
        expect_kept(ANGLE[k / 2], torque_at, &s);
        expect_plain(ANGLE[k / 2], mean_Nm, torque_at, &s);
        hci_solution_release(&s);
        memset(&effects, 0, sizeof effects);
        expect_kept(ANGLE[k / 2], declared_torque, &s);
        expect_plain(ANGLE[k / 2], mean_Nm, declared_torque, &s);
        hci_solution_release(&s);
    }
}

/* T = a l (1 − l²/3) of a length l along the direction is largest at l = 1. */
static double falling(const void *context, const double x[2], double gradient[2])
{
    const double a = *(const double *)context, l = -x[1]; /* along i_q at the angle 0 */
    gradient[0] = 0.0;
    gradient[1] = -a * (1.0 - l * l);
    return a * l * (1.0 - l * l / 3.0);
}

/* From a start beyond the largest torque, too; the other length that makes 1/2 is 1.3 and more. */
static void test_the_shorter_current_of_two(void)
{
    const double a = 1.0;
    const hci_smooth_torque torque = {.context = &a, .at = falling};
    static const double START[] = {0.0, 0.3, 1.2, 1.5};
    for (size_t k = 0; k < sizeof START / sizeof *START; ++k) {
        double x[2] = {0.0, -START[k]};
        TEST_ASSERT_EQUAL_INT(HCI_OK, hci_kept_angle_current(&torque, 0.0, 0.0, 0.5, x));
        TEST_ASSERT_DOUBLE_WITHIN(1e-9, 0.5, -x[1] * (1.0 - x[1] * x[1] / 3.0));
        TEST_ASSERT_TRUE(-x[1] > 0.0 && -x[1] < 1.0);
    }
}

/* A torque that falls again with the current has the same torque at currents far away, of either sign: none
 * of them is an answer. T = 15 i/unit − 0.6 P (i/unit)³ has its largest value below 40 N·m. */
static void test_a_torque_that_turns_round(void)
{
    static const double MEAN[] = {6.0, -6.0, 200.0, -200.0, 3000.0};
    const term droop = {1, 2, 0.0, true, -0.6};
    const double along_q = 0.0;
    hci_solve_options o = options();
    memset(&effects, 0, sizeof effects);
    add_terms(&effects, &droop, 1);
    o.method = HCI_METHOD_POINTWISE;
    o.current_angle_rad = &along_q;
    for (int k = 0; k < 5; ++k) {
        hci_note note = {{0}};
        hci_solution s;
        want(MEAN[k], 6.0, 0.1);
        const hci_status status = hci_solve(&machine, &o, &s, &note);
        TEST_ASSERT_EQUAL_INT(k < 2 ? HCI_OK : HCI_ERROR_NUMERIC, status);
        if (k < 2) {
            double i[3], dq[2];
            waves_at(s.current.wave, s.current.count, 0.4, i);
            park(0.4, i, dq);
            TEST_ASSERT_TRUE(dq[1] * MEAN[k] > 0.0);
            hci_solution_release(&s);
        } else {
            TEST_ASSERT_NOT_NULL(strstr(note.text, "falls again"));
        }
    }
}

/* How the torque goes off the direction does not matter along it. */
static void test_what_is_off_the_direction_is_no_matter(void)
{
    const double along_q = 0.0;
    hci_solve_options o = options();
    hci_solution known, invented;
    want(10.0, 6.0, 0.5);
    o.method = HCI_METHOD_POINTWISE;
    o.current_angle_rad = &along_q;
    TEST_ASSERT_EQUAL_INT(HCI_OK, solve(&o, &known));
    el_add(&effects, "saturation", "d3q0_cosine", 6.0, 5.0);
    el_add(&effects, "saturation", "d2q1_sine", 12.0, -4.0);
    TEST_ASSERT_EQUAL_INT(HCI_OK, solve(&o, &invented));
    TEST_ASSERT_TRUE(distance_A(&known, &invented) < 1e-9);
    hci_solution_release(&known);
    hci_solution_release(&invented);
}

/* ---- what is of second degree at most is the machine itself ---- */

static void expect_equal(const hci_solution *x, const hci_solution *y)
{
    TEST_ASSERT_TRUE(distance_A(x, y) < 1e-9);
    TEST_ASSERT_DOUBLE_WITHIN(1e-9, x->mean_square_A2, y->mean_square_A2);
    TEST_ASSERT_DOUBLE_WITHIN(1e-9, x->limit_mean_square_A2, y->limit_mean_square_A2);
    TEST_ASSERT_DOUBLE_WITHIN(1e-9, x->plain_amplitude_A, y->plain_amplitude_A);
    TEST_ASSERT_DOUBLE_WITHIN(1e-9, x->peak_phase_current_A, y->peak_phase_current_A);
    for (size_t k = 0; k < x->order_count; ++k)
        for (size_t j = 0; j < y->order_count; ++j) {
            const hci_solved_order *a = &x->order[k], *b = &y->order[j];
            if (fabs(a->torque_Nm.order - b->torque_Nm.order) > 1e-6) continue;
            TEST_ASSERT_DOUBLE_WITHIN(1e-9, a->torque_Nm.sine, b->torque_Nm.sine);
            TEST_ASSERT_DOUBLE_WITHIN(1e-9, a->torque_Nm.cosine, b->torque_Nm.cosine);
            TEST_ASSERT_DOUBLE_WITHIN(1e-9, a->before_Nm.sine, b->before_Nm.sine);
            TEST_ASSERT_DOUBLE_WITHIN(1e-9, a->before_Nm.cosine, b->before_Nm.cosine);
        }
}

/* L'_rs of the terms of second degree by differences of the co-energy, analysed by a sum of its own. */
static void make_slopes(hci_inductance_slope *slope, size_t orders)
{
    static const int PAIR[6][2] = {{0, 0}, {1, 1}, {2, 2}, {0, 1}, {1, 2}, {2, 0}};
    enum { N = 64 };
    for (size_t n = 0; n < orders; ++n) {
        memset(&slope[n], 0, sizeof slope[n]);
        slope[n].order = (double)n;
        for (int q = 0; q < 6; ++q)
            for (int j = 0; j < N; ++j) {
                const double theta = 2.0 * REF_PI * j / N;
                double both[3] = {0.0, 0.0, 0.0}, l = 0.0;
                both[PAIR[q][0]] += 1.0; /* a quadratic form: L_rs = W(r + s) − W(r) − W(s), L_rr = 2 W(r) */
                both[PAIR[q][1]] += 1.0;
                l = coenergy(TERMS, 3, theta, both);
                for (int k = 0; k < 2; ++k) {
                    double one[3] = {0.0, 0.0, 0.0};
                    one[PAIR[q][k]] = 1.0;
                    l -= coenergy(TERMS, 3, theta, one);
                }
                /* p d/dθ of S sin nθ + C cos nθ */
                slope[n].cosine[q] += P * (double)n * 2.0 / N * l * sin((double)n * theta);
                slope[n].sine[q] -= P * (double)n * 2.0 / N * l * cos((double)n * theta);
            }
    }
}

static void test_reluctance_is_an_inductance_table(void)
{
    static hci_inductance_slope slope[12];
    for (int pointwise = 0; pointwise < (LONG_ONES ? 4 : 2); ++pointwise) {
        hci_solve_options o = options();
        hci_solution s, table;
        want(10.0, 6.0, 0.5);
        memset(&effects, 0, sizeof effects);
        add_terms(&effects, TERMS, 3);
        effects.list.count = 1; /* reluctance alone */
        o.method = pointwise > 0 ? HCI_METHOD_POINTWISE : HCI_METHOD_AUTO;
        o.strategy = pointwise > 1 ? (hci_strategy)(pointwise - 1) : HCI_STRATEGY_MTPA;
        solve(&o, &s);
        make_slopes(slope, 12);
        machine.model.slope = slope;
        machine.model.slope_count = 12;
        o.effects = NULL;
        solve(&o, &table);
        expect_equal(&s, &table);
        hci_solution_release(&s);
        hci_solution_release(&table);
        machine.model.slope_count = 0;
    }
}

/* Back-EMF, cogging, temperature: the machine declared with the sums. */
static void test_linear_effects_are_the_declared_machine(void)
{
    hci_wave other[4] = {emf[0], emf[1], emf[2], {11.0, -1, 0.03, 0.01}};
    hci_harmonic more[3] = {cogging[0], cogging[1], {18.0, 0.02, -0.03}};
    hci_solve_options o = options();
    hci_solution s, declared;
    memset(&effects, 0, sizeof effects);
    el_add(&effects, "back_emf", "sine", 11.0, 0.03);
    el_add(&effects, "back_emf", "cosine", 11.0, 0.01);
    el_add(&effects, "cogging", "sine", 18.0, 0.02);
    el_add(&effects, "cogging", "cosine", 18.0, -0.03);
    el_add(&effects, "magnet_temperature", "emf_per_kelvin", 0.0, -0.001);
    o.at_temperature = true;
    o.temperature_C = 70.0;
    want(10.0, 6.0, 0.5);
    TEST_ASSERT_EQUAL_INT(HCI_OK, solve(&o, &s));
    TEST_ASSERT_NOT_NULL(s.per_Nm);
    for (int k = 0; k < 3; ++k) {
        other[k].sine *= 0.95;
        other[k].cosine *= 0.95;
    }
    machine.model = (hci_machine){P, other, 4, more, 3, NULL, 0};
    o.effects = NULL;
    TEST_ASSERT_EQUAL_INT(HCI_OK, solve(&o, &declared));
    expect_equal(&s, &declared);
    hci_solution_release(&s);
    hci_solution_release(&declared);
}

/* Without a temperature the magnets are at the reference. */
static void test_reference_temperature(void)
{
    hci_solve_options o = options();
    hci_solution s, cold;
    memset(&effects, 0, sizeof effects);
    el_add(&effects, "magnet_temperature", "emf_per_kelvin", 0.0, -0.001);
    want(10.0, 6.0, 0.5);
    solve(&o, &s);
    o.effects = NULL;
    solve(&o, &cold);
    expect_equal(&s, &cold);
    hci_solution_release(&s);
    hci_solution_release(&cold);
}

/* Unequal phases, a wave of the wrong sequence, and an eccentric rotor: once a mechanical turn. */
static double uneven_torque(double theta, const double i[3])
{
    double sum = declared_torque(theta, i), dq[2];
    park(theta, i, dq);
    sum -= 0.04 * i[1] * ref_waves_at(EMF, 3, 1, theta);
    for (int s = 0; s < 3; ++s)
        sum += i[s] * 0.02 * sin(theta + 2.0 * REF_PI * s / 3.0);
    return sum + 0.15 * sin(theta / P) + 0.02 * dq[1] * cos(2.0 * theta / P);
}

static void test_uneven_phases_and_an_eccentric_rotor(void)
{
    hci_solve_options o = options();
    hci_solution s;
    memset(&effects, 0, sizeof effects);
    el_add(&effects, "phase_imbalance", "b", 0.0, -0.04);
    el_add(&effects, "back_emf", "neg_sine", 1.0, 0.02);
    el_add(&effects, "mechanical_order", "sine", 0.333333, 0.15);
    el_add(&effects, "mechanical_order", "iq_cosine", 0.6666667, 0.02);
    want(10.0, 6.0, 0.5);
    TEST_ASSERT_EQUAL_INT(HCI_OK, solve(&o, &s));
    TEST_ASSERT_EQUAL_UINT64(P, s.period_turns);
    TEST_ASSERT_TRUE(worst_torque(&s, P, uneven_torque) < 1e-5);
    TEST_ASSERT_TRUE(worst_promise(&s, P, uneven_torque) < 1e-10);
    hci_solution_release(&s);
    o.method = HCI_METHOD_POINTWISE;
    TEST_ASSERT_EQUAL_INT(HCI_OK, solve(&o, &s));
    TEST_ASSERT_TRUE(worst_torque(&s, P, uneven_torque) < 1e-8);
    hci_solution_release(&s);
}

/* Saturation beside it, over the whole mechanical turn. */
static double uneven_saturated_torque(double theta, const double i[3])
{
    return torque_at(theta, i) + uneven_torque(theta, i) - declared_torque(theta, i);
}

static void test_everything_together(void)
{
    hci_solve_options o = options();
    hci_solution s;
    el_add(&effects, "phase_imbalance", "b", 0.0, -0.04);
    el_add(&effects, "back_emf", "neg_sine", 1.0, 0.02);
    el_add(&effects, "mechanical_order", "sine", 0.333333, 0.15);
    el_add(&effects, "mechanical_order", "iq_cosine", 0.6666667, 0.02);
    want(10.0, 6.0, 0.5);
    o.method = HCI_METHOD_POINTWISE;
    TEST_ASSERT_EQUAL_INT(HCI_OK, solve(&o, &s));
    TEST_ASSERT_EQUAL_UINT64(P, s.period_turns);
    TEST_ASSERT_TRUE(worst_torque(&s, P, uneven_saturated_torque) < 1e-8);
    TEST_ASSERT_TRUE(worst_promise(&s, P, uneven_saturated_torque) < 1e-8);
    hci_solution_release(&s);
}

/* ---- what is left out, and limits ---- */

static void test_the_bench_is_left_out(void)
{
    hci_solve_options o = options();
    hci_solution s, plain;
    want(10.0, 6.0, 0.5);
    solve(&o, &plain);
    TEST_ASSERT_NULL(strstr(plain.remark.text, "not compensated"));
    el_add(&effects, "position_offset", "angle", 0.0, 0.1);
    el_add(&effects, "current_gain", "a", 0.0, 0.1);
    el_add(&effects, "friction", "coulomb", 0.0, 0.1);
    solve(&o, &s);
    expect_equal(&s, &plain);
    TEST_ASSERT_NOT_NULL(strstr(s.remark.text, "position_offset, current_gain, friction"));
    TEST_ASSERT_NOT_NULL(strstr(s.remark.text, "true angle"));
    hci_solution_release(&s);
    hci_solution_release(&plain);
}

/* Flux of the terms in phase s by differences of the co-energy. */
static double flux(double theta, const double i[3], int s)
{
    double more[3] = {i[0], i[1], i[2]}, less[3] = {i[0], i[1], i[2]};
    more[s] += 1e-4;
    less[s] -= 1e-4;
    return (coenergy(TERMS, TERM_COUNT, theta, more) - coenergy(TERMS, TERM_COUNT, theta, less)) / 2e-4;
}

static double phase_voltage(const hci_solution *s, double theta, int phase, double speed)
{
    const double h = 1e-5;
    double i[3], ahead[3], behind[3];
    waves_at(s->current.wave, s->current.count, theta, i);
    waves_at(s->current.wave, s->current.count, theta + h, ahead);
    waves_at(s->current.wave, s->current.count, theta - h, behind);
    return 0.5 * i[phase] + speed * ref_waves_at(EMF, 3, phase, theta) +
           P * speed *
               (0.01 * (ahead[phase] - behind[phase]) + flux(theta + h, ahead, phase) -
                flux(theta - h, behind, phase)) /
               (2.0 * h);
}

/* The induced voltage of the effects is the change of the flux that their co-energy has. */
static void test_voltage(void)
{
    hci_solve_options o = options();
    hci_solution s;
    double peak = 0.0;
    machine.resistance_ohm = 0.5;
    machine.inductance_d_H = machine.inductance_q_H = 0.01;
    want(10.0, 6.0, 0.5);
    o.limit_voltage_V = 1e6;
    o.speed_rad_per_s = 100.0;
    TEST_ASSERT_EQUAL_INT(HCI_OK, solve(&o, &s));
    for (int j = 0; j < 4 * SAMPLES; ++j) {
        const double theta = 2.0 * REF_PI * j / (4 * SAMPLES);
        const double v[3] = {phase_voltage(&s, theta, 0, 100.0), phase_voltage(&s, theta, 1, 100.0),
                             phase_voltage(&s, theta, 2, 100.0)};
        peak = fmax(peak, fmax(fabs(v[0] - v[1]), fmax(fabs(v[1] - v[2]), fabs(v[2] - v[0]))));
    }
    /* both look at a finite number of angles */
    TEST_ASSERT_DOUBLE_WITHIN(1e-3 * peak, peak, s.peak_line_voltage_V);
    TEST_ASSERT_TRUE(s.within_limits);
    hci_solution_release(&s);
}

/* ---- old currents on the corrected machine ---- */

static void test_old_currents_are_judged(void)
{
    hci_solve_options o = options();
    hci_solution old;
    hci_torque_evaluation j;
    hci_note note = {{0}};
    double most = -HUGE_VAL, least = HUGE_VAL, mean = 0.0, square = 0.0, error = 0.0;
    want(10.0, 6.0, 0.5);
    o.effects = NULL;
    solve(&o, &old);
    TEST_ASSERT_EQUAL_INT(HCI_OK,
                          hci_evaluate_currents(&machine, &effects.list, &old.current, &TARGET, &j, &note));
    for (int k = 0; k < 8 * SAMPLES; ++k) {
        const double theta = 2.0 * REF_PI * k / (8 * SAMPLES);
        double i[3];
        waves_at(old.current.wave, old.current.count, theta, i);
        const double torque = torque_at(theta, i);
        most = fmax(most, torque);
        least = fmin(least, torque);
        mean += torque / (8 * SAMPLES);
        square += torque * torque / (8 * SAMPLES);
        error += (torque - wanted_at(theta)) * (torque - wanted_at(theta)) / (8 * SAMPLES);
    }
    TEST_ASSERT_DOUBLE_WITHIN(1e-9, mean, j.mean_Nm);
    TEST_ASSERT_DOUBLE_WITHIN(1e-9, sqrt(error), j.rms_error_Nm);
    TEST_ASSERT_DOUBLE_WITHIN(1e-4 * (most - least), most - least, j.peak_to_peak_Nm);
    TEST_ASSERT_DOUBLE_WITHIN(1e-6, 100.0 * sqrt(square - mean * mean) / mean, j.F_ripple_percent);
    TEST_ASSERT_DOUBLE_WITHIN(1e-9, 100.0 * j.peak_to_peak_Nm / mean, j.T_ripple_percent);
    TEST_ASSERT_TRUE(j.rms_error_Nm > 0.1);
    hci_torque_evaluation_release(&j);
    TEST_ASSERT_EQUAL_INT(HCI_OK, hci_evaluate_currents(&machine, NULL, &old.current, &TARGET, &j, &note));
    TEST_ASSERT_TRUE(j.rms_error_Nm < 1e-5);
    hci_torque_evaluation_release(&j);
    hci_solution_release(&old);
}

/* ---- machine C: finite elements, and the polynomial of degree 6 that describes them ---- */

static void test_machine_c_saturated(void)
{
    hci_machine_data no_load, saturated;
    hci_effects_data found;
    hci_solve_options o = {0};
    hci_solution old, fresh;
    hci_torque_evaluation j;
    hci_note note = {{0}};
    o.target = &TARGET;
    want(8.0, 12.0, 0.0);
    TEST_ASSERT_EQUAL_MESSAGE(HCI_OK, hci_machine_read("data/machine_c", &no_load, &note), note.text);
    TEST_ASSERT_EQUAL_MESSAGE(HCI_OK, hci_machine_read("data/machine_c_saturated", &saturated, &note),
                              note.text);
    TEST_ASSERT_EQUAL_MESSAGE(HCI_OK, hci_effects_read_machine("data/machine_c_saturated", &found, &note),
                              note.text);
    TEST_ASSERT_EQUAL_INT(HCI_OK, hci_solve(&no_load, &o, &old, &note));
    TEST_ASSERT_EQUAL_INT(HCI_OK,
                          hci_evaluate_currents(&saturated, &found.list, &old.current, &TARGET, &j, &note));
    /* finite elements with these currents: 17 to 19 % peak to peak */
    TEST_ASSERT_TRUE(j.T_ripple_percent > 15.0 && j.T_ripple_percent < 22.0);
    hci_torque_evaluation_release(&j);
    o.effects = &found.list;
    TEST_ASSERT_EQUAL_INT(HCI_OK, hci_solve(&saturated, &o, &fresh, &note));
    TEST_ASSERT_TRUE(fresh.newton_converged);
    TEST_ASSERT_EQUAL_INT(HCI_OK,
                          hci_evaluate_currents(&saturated, &found.list, &fresh.current, &TARGET, &j, &note));
    TEST_ASSERT_TRUE(j.T_ripple_percent < 1e-3);
    hci_torque_evaluation_release(&j);
    hci_solution_release(&old);
    hci_solution_release(&fresh);
    hci_effects_release(&found);
    hci_machine_release(&no_load);
    hci_machine_release(&saturated);
}

/* ---- what is refused, and what fails ---- */

static void refused(const hci_solve_options *o, const char *words)
{
    hci_solution s;
    hci_note note = {{0}};
    TEST_ASSERT_EQUAL_INT(HCI_ERROR_INPUT, hci_solve(&machine, o, &s, &note));
    TEST_ASSERT_NOT_NULL_MESSAGE(strstr(note.text, words), note.text);
}

static void test_refusals(void)
{
    hci_solve_options o = options(), without = options();
    want(10.0, 6.0, 0.5);
    without.effects = NULL;
    machine.has_effects = true;
    refused(&without, "effects.csv");
    machine.has_effects = false;
    machine.has_neutral = true;
    refused(&o, "star connection");
    machine.has_neutral = false;
    el_add(&effects, "cogging", "sine", 0.3333, 0.1);
    refused(&o, "no common period");
    memset(&effects, 0, sizeof effects);
    el_add(&effects, "saturation", "d1q2_sine", 0.3333, 0.1);
    refused(&o, "no common period");
}

/* One by one at first, then in steps that grow. */
static void test_memory_that_runs_out(void)
{
    hci_solve_options o = options();
    hci_status status = HCI_ERROR_MEMORY;
    hci_solution s;
    const term droop = {1, 2, 0.0, true, -0.4};
    memset(&effects, 0, sizeof effects);
    add_terms(&effects, &droop, 1);
    el_add(&effects, "cogging", "sine", 18.0, 0.01);
    want(10.0, 6.0, 0.5);
    for (long n = 0; n < 1000000 && status == HCI_ERROR_MEMORY; n += n < 30 ? 1 : n / 3) {
        hci_note note = {{0}};
        hci_memory_fail_after(n);
        status = hci_solve(&machine, &o, &s, &note);
        hci_memory_fail_after(-1);
        TEST_ASSERT_TRUE(status == HCI_OK || !s.current.wave);
    }
    TEST_ASSERT_EQUAL_INT(HCI_OK, status);
    hci_solution_release(&s);
}

static void test_memory_that_runs_out_while_evaluating(void)
{
    const hci_currents sine = {.wave = emf, .count = 1};
    hci_status status = HCI_ERROR_MEMORY;
    hci_torque_evaluation j;
    long n = 0;
    for (; n < 1000 && status == HCI_ERROR_MEMORY; ++n) {
        hci_note note = {{0}};
        hci_memory_fail_after(n);
        status = hci_evaluate_currents(&machine, &effects.list, &sine, &TARGET, &j, &note);
        hci_memory_fail_after(-1);
        TEST_ASSERT_TRUE(status == HCI_OK || !j.torque_Nm);
    }
    TEST_ASSERT_EQUAL_INT(HCI_OK, status);
    TEST_ASSERT_TRUE(n > 8);
    hci_torque_evaluation_release(&j);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_every_degree);
    RUN_TEST(test_many_terms);
    RUN_TEST(test_harmonic_balance);
    RUN_TEST(test_shortest_currents_are_the_shortest_of_all);
    RUN_TEST(test_far_into_saturation);
    RUN_TEST(test_cancel);
    RUN_TEST(test_currents_keep_their_angle);
    RUN_TEST(test_the_plain_sine_has_the_kept_direction);
    RUN_TEST(test_the_shorter_current_of_two);
    RUN_TEST(test_a_torque_that_turns_round);
    RUN_TEST(test_what_is_off_the_direction_is_no_matter);
    RUN_TEST(test_reluctance_is_an_inductance_table);
    RUN_TEST(test_linear_effects_are_the_declared_machine);
    RUN_TEST(test_reference_temperature);
    RUN_TEST(test_the_bench_is_left_out);
    RUN_TEST(test_voltage);
    RUN_TEST(test_old_currents_are_judged);
    RUN_TEST(test_refusals);
    RUN_TEST(test_memory_that_runs_out_while_evaluating);
    if (LONG_ONES) {
        RUN_TEST(test_a_given_set);
        RUN_TEST(test_uneven_phases_and_an_eccentric_rotor);
        RUN_TEST(test_everything_together);
        RUN_TEST(test_machine_c_saturated);
        RUN_TEST(test_memory_that_runs_out);
    }
    return UNITY_END();
}
