/* Each effect against equations written here, and every derivative against differences. */
#include <stdlib.h>

#include "support/effect_list.h"
#include "unity.h"

static const int P = 3;
static el_machine m;

void setUp(void)
{
    el_machine_make(&m);
}

void tearDown(void)
{
}

enum { DRAWS = 40 };

/* i_d, i_q from the phase currents, as theory defines them: i_a = i_q sin θ − i_d cos θ. */
static void rotor(const hci_sample *x, double *d, double *q)
{
    *d = *q = 0.0;
    for (int s = 0; s < 3; ++s) {
        const double angle = P * x->theta_m_rad - 2.0 * REF_PI * s / 3.0;
        *q += 2.0 / 3.0 * x->i_abc[s] * sin(angle);
        *d -= 2.0 / 3.0 * x->i_abc[s] * cos(angle);
    }
}

/* ---- torque of each type on the machine ---- */

typedef double formula(const hci_sample *x, double theta, double d, double q);

typedef struct {
    const char *effect, *parameter;
    double order, value;
    formula *torque;
} machine_case;

static double cogging_18(const hci_sample *x, double theta, double d, double q)
{
    (void)x;
    (void)d;
    (void)q;
    return 0.02 * sin(18.0 * theta);
}

static double cogging_third(const hci_sample *x, double theta, double d, double q)
{
    (void)theta;
    (void)d;
    (void)q;
    return 0.02 * cos(x->theta_m_rad); /* order 1/3 at three pole pairs, also when the file says 0.333333 */
}

static double emf_5(const hci_sample *x, double theta, double d, double q)
{
    double sum = 0.0;
    (void)d;
    (void)q;
    for (int s = 0; s < 3; ++s)
        sum += 0.04 * sin(5.0 * (theta - 2.0 * REF_PI * s / 3.0)) * x->i_abc[s];
    return sum;
}

static double emf_negative(const hci_sample *x, double theta, double d, double q)
{
    (void)d;
    (void)q;
    return 0.04 * (cos(theta) * x->i_abc[0] + cos(theta + 2.0 * REF_PI / 3.0) * x->i_abc[1] +
                   cos(theta - 2.0 * REF_PI / 3.0) * x->i_abc[2]);
}

static double emf_zero(const hci_sample *x, double theta, double d, double q)
{
    (void)d;
    (void)q;
    return 0.04 * sin(3.0 * theta) * (x->i_abc[0] + x->i_abc[1] + x->i_abc[2]);
}

static double imbalance_b(const hci_sample *x, double theta, double d, double q)
{
    (void)d;
    (void)q;
    return -0.03 * el_emf(1, theta) * x->i_abc[1];
}

static double saliency(const hci_sample *x, double theta, double d, double q)
{
    (void)x;
    (void)theta;
    return 1.5 * 3.0 * 2e-3 * d * q; /* 3/2 p (L_d − L_q) i_d i_q */
}

static double reluctance_q6(const hci_sample *x, double theta, double d, double q)
{
    (void)x;
    return 0.75 * 3.0 * 2e-3 * (-6.0 * sin(6.0 * theta) * q * q - 2.0 * cos(6.0 * theta) * d * q);
}

static double reluctance_cross(const hci_sample *x, double theta, double d, double q)
{
    (void)x;
    (void)theta;
    return 1.5 * 3.0 * 2e-3 * (q * q - d * d);
}

static double droop(const hci_sample *x, double theta, double d, double q)
{
    (void)x;
    (void)theta;
    return -3.0 * 0.01 * (q * q * q - 2.0 * d * d * q);
}

static double saturation_q3(const hci_sample *x, double theta, double d, double q)
{
    (void)x;
    return 3.0 * 0.01 * (6.0 * cos(6.0 * theta) * q * q * q - 3.0 * sin(6.0 * theta) * d * q * q);
}

static double saturation_q4(const hci_sample *x, double theta, double d, double q)
{
    (void)x;
    return 3.0 * 0.001 *
           (-12.0 * sin(12.0 * theta) * q * q * q * q - 4.0 * cos(12.0 * theta) * d * q * q * q);
}

static double hot(const hci_sample *x, double theta, double d, double q)
{
    double sum = 0.0;
    (void)d;
    (void)q;
    for (int s = 0; s < 3; ++s)
        sum += el_emf(s, theta) * x->i_abc[s];
    return -0.001 * (x->temperature_C - 20.0) * sum;
}

static double turn_constant(const hci_sample *x, double theta, double d, double q)
{
    (void)theta;
    (void)d;
    (void)q;
    return 0.03 * sin(x->theta_m_rad);
}

static double turn_current(const hci_sample *x, double theta, double d, double q)
{
    (void)theta;
    (void)d;
    return 0.03 * q * cos(2.0 * x->theta_m_rad);
}

/* The flux in the air gap is 1 + M of what it should be: torque with currents in proportion, cogging squared.
 */
static double unequal(const hci_sample *x, double theta, double change)
{
    double sum = 2.0 * 0.05 * sin(12.0 * theta + 0.3);
    for (int s = 0; s < 3; ++s)
        sum += el_emf(s, theta) * x->i_abc[s];
    return change * sum;
}

static double unequal_twice(const hci_sample *x, double theta, double d, double q)
{
    (void)d;
    (void)q;
    return unequal(x, theta, 0.03 * cos(2.0 * x->theta_m_rad));
}

static double unequal_third(const hci_sample *x, double theta, double d, double q)
{
    (void)d;
    (void)q;
    return unequal(x, theta, 0.03 * sin(x->theta_m_rad));
}

static const machine_case MACHINE[] = {
    {"cogging", "sine", 18.0, 0.02, cogging_18},
    {"cogging", "cosine", 0.333333, 0.02, cogging_third},
    {"back_emf", "sine", 5.0, 0.04, emf_5},
    {"back_emf", "neg_cosine", 1.0, 0.04, emf_negative},
    {"back_emf", "zero_sine", 3.0, 0.04, emf_zero},
    {"phase_imbalance", "b", 0.0, -0.03, imbalance_b},
    {"reluctance", "dd_cosine", 0.0, 2e-3, saliency},
    {"reluctance", "qq_cosine", 6.0, 2e-3, reluctance_q6},
    {"reluctance", "dq_cosine", 0.0, 2e-3, reluctance_cross},
    {"saturation", "d1q2_cosine", 0.0, -0.01, droop},
    {"saturation", "d0q3_sine", 6.0, 0.01, saturation_q3},
    {"saturation", "d0q4_cosine", 12.0, 0.001, saturation_q4},
    {"magnet_temperature", "emf_per_kelvin", 0.0, -0.001, hot},
    {"mechanical_order", "sine", 1.0 / 3.0, 0.03, turn_constant},
    {"mechanical_order", "iq_cosine", 0.666667, 0.03, turn_current},
    {"unequal_magnets", "sine", 0.333333, 0.03, unequal_third},
    {"unequal_magnets", "cosine", 0.666667, 0.03, unequal_twice},
};

enum { MACHINE_CASES = sizeof MACHINE / sizeof *MACHINE };

static void test_torque_of_each_effect(void)
{
    uint64_t seed = 1;
    for (size_t k = 0; k < MACHINE_CASES; ++k) {
        const machine_case *c = &MACHINE[k];
        el_list l = {0};
        el_add(&l, c->effect, c->parameter, c->order, c->value);
        for (int j = 0; j < DRAWS; ++j) {
            const hci_sample x = el_sample(&seed);
            double d, q;
            rotor(&x, &d, &q);
            /* Rounding of a few terms of size 1 to 10. */
            TEST_ASSERT_DOUBLE_WITHIN_MESSAGE(1e-12, c->torque(&x, P * x.theta_m_rad, d, q),
                                              hci_effects_torque(&m.machine, &l.list, &x, NULL).torque_Nm,
                                              c->parameter);
        }
    }
}

/* Terms of one effect add up. */
static void test_torque_of_several_terms(void)
{
    uint64_t seed = 1;
    for (size_t first = 0; first < MACHINE_CASES; ++first) {
        el_list l = {0};
        if (first > 0 && strcmp(MACHINE[first - 1].effect, MACHINE[first].effect) == 0) continue;
        for (size_t k = first; k < MACHINE_CASES && strcmp(MACHINE[k].effect, MACHINE[first].effect) == 0;
             ++k)
            el_add(&l, MACHINE[k].effect, MACHINE[k].parameter, MACHINE[k].order, MACHINE[k].value);
        for (int j = 0; j < DRAWS; ++j) {
            const hci_sample x = el_sample(&seed);
            double d, q, sum = 0.0;
            rotor(&x, &d, &q);
            for (size_t k = first; k < first + l.effect[0].count; ++k)
                sum += MACHINE[k].torque(&x, P * x.theta_m_rad, d, q);
            TEST_ASSERT_DOUBLE_WITHIN_MESSAGE(1e-12, sum,
                                              hci_effects_torque(&m.machine, &l.list, &x, NULL).torque_Nm,
                                              MACHINE[first].effect);
        }
    }
}

/* Many terms together, orders and powers in any sequence, more orders than are remembered: the sum of each
 * alone. */
static void sums_up(const char *effect, const char *const parameter[], int parameters, bool with_reference)
{
    enum { TERMS = 90 };
    uint64_t seed = 21;
    el_list all = {0};
    double by_value[EL_TERMS];
    if (with_reference) el_add(&all, effect, "reference_current", 0.0, 7.0);
    for (int k = 0; k < TERMS; ++k) /* neither order nor power stays for long */
        el_add(&all, effect, parameter[k % 7 % parameters], k < 80 ? (double)k : (double)(k - 60),
               1e-3 * ref_uniform(&seed, -1.0, 1.0));
    for (int j = 0; j < 5; ++j) {
        const hci_sample x = el_sample(&seed);
        const hci_effect_torque t = hci_effects_torque(&m.machine, &all.list, &x, by_value);
        hci_effect_torque sum = {0};
        for (size_t k = with_reference ? 1 : 0; k < all.effect[0].count; ++k) {
            double by[2];
            const hci_effect_term terms[2] = {all.term[0][k], all.term[0][0]};
            const hci_effect effect_alone = {all.effect[0].type, terms, with_reference ? 2 : 1};
            const hci_effects alone = {&effect_alone, 1};
            const hci_effect_torque one = hci_effects_torque(&m.machine, &alone, &x, by);
            sum.torque_Nm += one.torque_Nm;
            sum.by_angle += one.by_angle;
            for (int s = 0; s < 3; ++s) {
                sum.by_current[s] += one.by_current[s];
                sum.inductance_H[s] += one.inductance_H[s];
            }
            TEST_ASSERT_DOUBLE_WITHIN(1e-10 * (1.0 + fabs(by[0])), by[0], by_value[k]);
        }
        TEST_ASSERT_DOUBLE_WITHIN(1e-10, sum.torque_Nm, t.torque_Nm);
        TEST_ASSERT_DOUBLE_WITHIN(1e-8, sum.by_angle, t.by_angle);
        for (int s = 0; s < 3; ++s) {
            TEST_ASSERT_DOUBLE_WITHIN(1e-10, sum.by_current[s], t.by_current[s]);
            TEST_ASSERT_DOUBLE_WITHIN(1e-11, sum.inductance_H[s], t.inductance_H[s]);
        }
    }
}

static void test_terms_of_the_coenergy_add_up(void)
{
    static const char *const SATURATION[] = {"d1q2_cosine", "d3q0_sine",   "d0q4_cosine", "d2q2_sine",
                                             "d0q3_sine",   "d2q1_cosine", "d1q2_sine"};
    static const char *const RELUCTANCE[] = {"dd_cosine", "dq_sine", "qq_cosine", "dq_cosine", "dd_sine"};
    sums_up("saturation", SATURATION, 7, true);
    sums_up("reluctance", RELUCTANCE, 5, false);
}

static void test_saturation_scales_with_its_reference(void)
{
    uint64_t seed = 2;
    el_list a = {0}, b = {0};
    el_add(&a, "saturation", "d1q2_cosine", 0.0, 0.01);
    el_add(&a, "saturation", "d2q2_sine", 6.0, 0.01);
    el_add(&b, "saturation", "d1q2_cosine", 0.0, 0.01 * 1000.0);
    el_add(&b, "saturation", "d2q2_sine", 6.0, 0.01 * 10000.0);
    el_add(&b, "saturation", "reference_current", 0.0, 10.0);
    for (int j = 0; j < DRAWS; ++j) {
        const hci_sample x = el_sample(&seed);
        const double torque = hci_effects_torque(&m.machine, &a.list, &x, NULL).torque_Nm;
        TEST_ASSERT_DOUBLE_WITHIN(1e-12 * (1.0 + fabs(torque)), torque,
                                  hci_effects_torque(&m.machine, &b.list, &x, NULL).torque_Nm);
    }
}

static void test_unknown_temperature_is_the_reference(void)
{
    uint64_t seed = 3;
    el_list l = {0};
    double by[2];
    el_add(&l, "magnet_temperature", "emf_per_kelvin", 0.0, -0.001);
    el_add(&l, "magnet_temperature", "reference", 0.0, 30.0);
    hci_sample x = el_sample(&seed);
    x.temperature_C = NAN;
    TEST_ASSERT_EQUAL_DOUBLE(0.0, hci_effects_torque(&m.machine, &l.list, &x, by).torque_Nm);
    TEST_ASSERT_EQUAL_DOUBLE(0.0, by[0]);
    TEST_ASSERT_EQUAL_DOUBLE(0.0, by[1]);
}

static void test_friction_brakes(void)
{
    el_list l = {0};
    el_add(&l, "friction", "coulomb", 0.0, 0.1);
    el_add(&l, "friction", "viscous", 0.0, 0.02);
    el_add(&l, "friction", "quadratic", 0.0, 0.003);
    const hci_machine nothing = {3, NULL, 0, NULL, 0, NULL, 0};
    hci_sample x = {0};
    x.speed_rad_per_s = 10.0;
    TEST_ASSERT_DOUBLE_WITHIN(1e-15, -0.6, hci_effects_predict(&nothing, &l.list, &x, NULL));
    x.speed_rad_per_s = -10.0;
    TEST_ASSERT_DOUBLE_WITHIN(1e-15, 0.6, hci_effects_predict(&nothing, &l.list, &x, NULL));
    x.speed_rad_per_s = 0.0;
    TEST_ASSERT_EQUAL_DOUBLE(0.0, hci_effects_predict(&nothing, &l.list, &x, NULL));
    x.speed_rad_per_s = 10.0; /* friction is not in the air gap */
    TEST_ASSERT_EQUAL_DOUBLE(0.0, hci_effects_torque(&nothing, &l.list, &x, NULL).torque_Nm);
    TEST_ASSERT_DOUBLE_WITHIN(1e-15, 0.1, hci_effects_coulomb_Nm(&l.list));
}

/* At the Stribeck speed 1/e of the excess is left; the plant's two parts add up to the torque at any speed.
 */
static void test_stribeck_friction_fades(void)
{
    static const double SPEED[] = {-30.0, -5.0, -0.1, 0.1, 2.0, 5.0, 30.0};
    const hci_machine nothing = {3, NULL, 0, NULL, 0, NULL, 0};
    el_list l = {0};
    double by[2];
    el_add(&l, "stribeck_friction", "excess", 0.0, 0.2);
    el_add(&l, "stribeck_friction", "speed", 0.0, 5.0);
    for (size_t k = 0; k < sizeof SPEED / sizeof *SPEED; ++k) {
        const hci_sample x = {.speed_rad_per_s = SPEED[k]};
        const hci_plant_state y = {.speed_rad_per_s = SPEED[k]};
        const double sign = SPEED[k] < 0.0 ? -1.0 : 1.0, h = 1e-4;
        const double torque = hci_effects_predict(&nothing, &l.list, &x, by);
        TEST_ASSERT_DOUBLE_WITHIN(1e-15, -sign * 0.2 * exp(-SPEED[k] * SPEED[k] / 25.0), torque);
        TEST_ASSERT_DOUBLE_WITHIN(1e-14, torque,
                                  -sign * hci_effects_coulomb_Nm(&l.list) -
                                      l.effect[0].type->drag_Nm(&l.effect[0], &y));
        TEST_ASSERT_DOUBLE_WITHIN(1e-14, torque / 0.2, by[0]);
        l.term[0][1].value = 5.0 + h;
        const double more = hci_effects_predict(&nothing, &l.list, &x, NULL);
        l.term[0][1].value = 5.0 - h;
        const double less = hci_effects_predict(&nothing, &l.list, &x, NULL);
        l.term[0][1].value = 5.0;
        TEST_ASSERT_DOUBLE_WITHIN(1e-9, (more - less) / (2.0 * h), by[1]); /* h² = 1e-8, times 0.02 */
    }
}

/* i_d² + i_q² whatever the angle, and a zero sequence has no part in it; derivatives against differences. */
static void test_iron_drag_grows_with_load(void)
{
    uint64_t seed = 11;
    const hci_machine nothing = {3, NULL, 0, NULL, 0, NULL, 0};
    for (int j = 0; j < DRAWS; ++j) {
        el_list l = {0};
        el_add(&l, "iron_drag", "hysteresis", 0.0, 0.003);
        el_add(&l, "iron_drag", "eddy", 0.0, 2e-5);
        hci_sample x = el_sample(&seed);
        double d, q;
        rotor(&x, &d, &q);
        const double sign = x.speed_rad_per_s < 0.0 ? -1.0 : 1.0;
        const double torque = -(0.003 * sign + 2e-5 * x.speed_rad_per_s) * (d * d + q * q);
        TEST_ASSERT_DOUBLE_WITHIN(1e-14, torque, hci_effects_predict(&nothing, &l.list, &x, NULL));
        TEST_ASSERT_EQUAL_DOUBLE(0.0, hci_effects_torque(&nothing, &l.list, &x, NULL).torque_Nm);
        hci_effect_torque t = {0};
        for (size_t k = 0; k < 2; ++k)
            l.effect[0].type->torque(&l.effect[0], &l.term[0][k], &nothing, &x, &t);
        for (int s = 0; s < 3; ++s) { /* quadratic: a difference of any width */
            hci_sample more = x, less = x;
            more.i_abc[s] += 0.5;
            less.i_abc[s] -= 0.5;
            TEST_ASSERT_DOUBLE_WITHIN(1e-13,
                                      hci_effects_predict(&nothing, &l.list, &more, NULL) -
                                          hci_effects_predict(&nothing, &l.list, &less, NULL),
                                      t.by_current[s]);
        }
        hci_plant_state y = {.speed_rad_per_s = x.speed_rad_per_s};
        hci_plane_from_abc(x.i_abc, y.i);
        TEST_ASSERT_DOUBLE_WITHIN(1e-14, -torque, l.effect[0].type->drag_Nm(&l.effect[0], &y));
    }
}

/* ---- derivatives ---- */

/* Every parameter of every type, with an order where it has one. */
static void all_effects(el_list *l, uint64_t *seed)
{
    const hci_effect_type *type;
    memset(l, 0, sizeof *l);
    for (size_t r = 0; (type = hci_effect_type_at(r)) != NULL; ++r) {
        for (size_t k = 0; k < type->parameter_count; ++k) {
            const hci_effect_parameter *p = &type->parameter[k];
            const double order = !p->ordered ? 0.0 : p->whole ? 2.0 : 4.0 / 3.0;
            const double size = p->standard > 1.0 ? 30.0 : strcmp(p->unit, "s") == 0 ? 1e-3 : 0.02;
            const double value = size * ref_uniform(seed, 0.5, 1.5);
            el_add(l, type->name, p->name, order, p->least > 1e-9 ? 4.0 : value);
        }
    }
}

/* Fourth-order central difference. */
typedef double sampled(const void *context, double h);

static double difference(sampled *f, const void *context, double h)
{
    return (8.0 * (f(context, h) - f(context, -h)) - (f(context, 2.0 * h) - f(context, -2.0 * h))) /
           (12.0 * h);
}

typedef struct {
    const hci_effects *effects;
    hci_sample x;
    double *at; /* what is varied */
    const hci_sample *read;
} variation;

static double torque_at(const void *context, double h)
{
    const variation *v = context;
    const double keep = *v->at;
    *v->at += h;
    const double torque = hci_effects_torque(&m.machine, v->effects, v->read, NULL).torque_Nm;
    *v->at = keep;
    return torque;
}

static double prediction_at(const void *context, double h)
{
    const variation *v = context;
    const double keep = *v->at;
    *v->at += h;
    const double torque = hci_effects_predict(&m.machine, v->effects, v->read, NULL);
    *v->at = keep;
    return torque;
}

/* Error of the difference: h⁴/30 of a fifth derivative, for orders up to 12·p about 1e-8 of the torque. */
static void check_derivative(double exact, double h, sampled *f, double *at, const hci_effects *effects,
                             const hci_sample *x, const char *what)
{
    variation v = {effects, *x, at, x};
    const double found = difference(f, &v, h);
    TEST_ASSERT_DOUBLE_WITHIN_MESSAGE(2e-7 * (1.0 + fabs(found)), found, exact, what);
}

static void test_derivatives_by_current_and_angle(void)
{
    uint64_t seed = 4;
    for (int j = 0; j < DRAWS; ++j) {
        for (size_t k = 0; k < MACHINE_CASES; ++k) {
            el_list l = {0};
            el_add(&l, MACHINE[k].effect, MACHINE[k].parameter, MACHINE[k].order, MACHINE[k].value);
            hci_sample x = el_sample(&seed);
            const hci_effect_torque t = hci_effects_torque(&m.machine, &l.list, &x, NULL);
            for (int s = 0; s < 3; ++s)
                check_derivative(t.by_current[s], 1e-3, torque_at, &x.i_abc[s], &l.list, &x,
                                 MACHINE[k].parameter);
            check_derivative(t.by_angle, 1e-4, torque_at, &x.theta_m_rad, &l.list, &x, MACHINE[k].parameter);
        }
    }
}

/* All parameters of all types at once, so that their products and the chain of sensors count. */
static void test_derivatives_by_every_parameter(void)
{
    uint64_t seed = 5;
    for (int j = 0; j < DRAWS; ++j) {
        el_list l;
        double by[EL_EFFECTS * EL_TERMS];
        size_t n = 0;
        all_effects(&l, &seed);
        const hci_sample x = el_sample(&seed);
        const double torque = hci_effects_predict(&m.machine, &l.list, &x, by);
        TEST_ASSERT_EQUAL_DOUBLE(torque, hci_effects_predict(&m.machine, &l.list, &x, NULL));
        for (size_t k = 0; k < l.list.count; ++k) {
            for (size_t t = 0; t < l.effect[k].count; ++t) {
                const hci_effect_parameter *p = &l.effect[k].type->parameter[l.term[k][t].parameter];
                const double h = strcmp(p->unit, "s") == 0 ? 1e-6 : 1e-4;
                variation v = {&l.list, x, &l.term[k][t].value, &x};
                const double found = difference(prediction_at, &v, h);
                /* rounding: 1e-14 of a torque of 100 over h */
                TEST_ASSERT_DOUBLE_WITHIN_MESSAGE(1e-13 * fabs(torque) / h + 1e-7 * (1.0 + fabs(found)),
                                                  found, by[n++], p->name);
            }
        }
        TEST_ASSERT_EQUAL_UINT64(hci_effects_terms(&l.list), n);
    }
}

/* More effects between the truth and its readings than a list of one of each type has. */
static void test_derivatives_by_many_sensors_in_a_row(void)
{
    enum { MANY = 24 };
    static const char *const NAME[] = {"current_gain", "current_offset", "position_eccentricity"};
    uint64_t seed = 8;
    hci_effect_term term[MANY];
    hci_effect effect[MANY];
    double by[MANY];
    const hci_effects list = {effect, MANY};
    const hci_sample x = el_sample(&seed);
    for (size_t k = 0; k < MANY; ++k) {
        const double value = 0.01 * ref_uniform(&seed, 0.5, 1.5);
        term[k] = (hci_effect_term){0, k % 3 == 2 ? 1.0 / 3.0 : 0.0, value, NAN};
        effect[k] = (hci_effect){hci_effect_type_find(NAME[k % 3]), &term[k], 1};
    }
    const double torque = hci_effects_predict(&m.machine, &list, &x, by);
    for (size_t k = 0; k < MANY; ++k) {
        variation v = {&list, x, &term[k].value, &x};
        const double h = 1e-4, found = difference(prediction_at, &v, h);
        TEST_ASSERT_DOUBLE_WITHIN_MESSAGE(1e-13 * fabs(torque) / h + 1e-7 * (1.0 + fabs(found)), found, by[k],
                                          NAME[k % 3]);
    }
}

/* At the angle of before, at others, and with an angle that effects change. */
static void test_predicted_again(void)
{
    uint64_t seed = 9;
    el_list l, none = {0};
    double by[EL_EFFECTS * EL_TERMS], again[EL_EFFECTS * EL_TERMS];
    hci_torque_parts known = {.theta_rad = NAN};
    hci_sample x = el_sample(&seed);
    all_effects(&l, &seed);
    for (int j = 0; j < 4 * DRAWS; ++j) {
        const hci_effects *list = j % 4 < 2 ? &l.list : &none.list;
        if (j % 2 == 0) x = el_sample(&seed);
        x.i_abc[0] = ref_uniform(&seed, -2.0, 2.0);
        const double torque = hci_effects_predict(&m.machine, list, &x, by);
        TEST_ASSERT_EQUAL_DOUBLE(torque, hci_effects_predict_again(&m.machine, list, &x, &known, again));
        for (size_t k = 0; k < hci_effects_terms(list); ++k)
            TEST_ASSERT_EQUAL_DOUBLE(by[k], again[k]);
    }
}

/* A regressor times its value is the torque, for those that are linear: the sum over a type is its torque. */
static void test_regressors_of_linear_types(void)
{
    uint64_t seed = 6;
    for (size_t k = 0; k < MACHINE_CASES; ++k) {
        el_list l = {0};
        double by[1];
        el_add(&l, MACHINE[k].effect, MACHINE[k].parameter, MACHINE[k].order, 0.0);
        const hci_sample x = el_sample(&seed);
        double d, q;
        rotor(&x, &d, &q);
        hci_effects_torque(&m.machine, &l.list, &x, by);
        TEST_ASSERT_DOUBLE_WITHIN(1e-11, MACHINE[k].torque(&x, P * x.theta_m_rad, d, q) / MACHINE[k].value,
                                  by[0]);
    }
}

/* What is called linear has a regressor that does not depend on its value; what is not has another one at
 * another value, or none at a single sample. */
static void test_linear_parameters(void)
{
    const hci_effect_type *type;
    uint64_t seed = 13;
    const hci_sample x = el_sample(&seed);
    for (size_t r = 0; (type = hci_effect_type_at(r)) != NULL; ++r) {
        for (size_t k = 0; k < type->parameter_count; ++k) {
            const hci_effect_parameter *p = &type->parameter[k];
            double by[2];
            const bool linear = (p->traits & HCI_PARAMETER_LINEAR) != 0;
            for (int j = 0; j < 2; ++j) {
                el_list l = {0};
                el_add(&l, type->name, p->name,
                       !p->ordered ? 0.0
                       : p->whole  ? 2.0
                                   : 4.0 / 3.0,
                       0.01 + 3.0 * j);
                hci_effects_predict(&m.machine, &l.list, &x, &by[j]);
            }
            const bool same = fabs(by[1] - by[0]) <= 1e-12 * fabs(by[0]);
            TEST_ASSERT_TRUE_MESSAGE(linear ? same : !same || by[0] == 0.0, p->name);
        }
    }
}

/* ---- bench ---- */

/* A drive at constant speed: what each channel shows at an instant, by formulas over time. */
static const double OMEGA = 80.0, AMPLITUDE = 4.0, PHASE = 0.6, START = 1.3;

static double true_angle(double t)
{
    return START + OMEGA * t;
}

static double true_current(int s, double t)
{
    return AMPLITUDE * sin(P * true_angle(t) - 2.0 * REF_PI * s / 3.0 + PHASE);
}

static hci_sample truth_at(double t)
{
    hci_sample x = {0};
    x.theta_m_rad = true_angle(t);
    x.speed_rad_per_s = OMEGA;
    x.temperature_C = 20.0;
    for (int s = 0; s < 3; ++s)
        x.i_abc[s] = true_current(s, t);
    return x;
}

static void bench(el_list *l)
{
    memset(l, 0, sizeof *l);
    el_add(l, "torque_sensor", "offset", 0.0, 0.25); /* not in the order of the registry */
    el_add(l, "current_offset", "a", 0.0, 0.2);
    el_add(l, "current_offset", "c", 0.0, -0.1);
    el_add(l, "current_gain", "b", 0.0, 0.03);
    el_add(l, "position_offset", "angle", 0.0, 0.06);
    el_add(l, "position_eccentricity", "mech_sine", 1.0, 0.02);
    el_add(l, "position_eccentricity", "mech_cosine", 2.0, 0.01);
    el_add(l, "channel_delay", "angle", 0.0, 5e-4);
    el_add(l, "channel_delay", "current", 0.0, 2e-4);
    el_add(l, "channel_delay", "torque", 0.0, 1e-3);
}

static void test_readings_of_a_true_state(void)
{
    el_list l;
    bench(&l);
    for (int k = 0; k < DRAWS; ++k) {
        const double t = 0.01 * k;
        const hci_sample torque_truth = truth_at(t - 1e-3);
        const hci_sample x = hci_effects_sense(&l.list, P, &torque_truth);
        const double theta = true_angle(t - 5e-4);
        TEST_ASSERT_DOUBLE_WITHIN(1e-12, theta + 0.02 * sin(theta) + 0.01 * cos(2.0 * theta) + 0.06 / P,
                                  x.theta_m_rad);
        TEST_ASSERT_DOUBLE_WITHIN(1e-12, true_current(0, t - 2e-4) + 0.2, x.i_abc[0]);
        TEST_ASSERT_DOUBLE_WITHIN(1e-12, 1.03 * true_current(1, t - 2e-4), x.i_abc[1]);
        TEST_ASSERT_DOUBLE_WITHIN(1e-12, true_current(2, t - 2e-4) - 0.1, x.i_abc[2]);
    }
}

static void test_readings_and_back(void)
{
    uint64_t seed = 7;
    el_list l;
    bench(&l);
    for (int j = 0; j < DRAWS; ++j) {
        const hci_sample truth = el_sample(&seed), reading = hci_effects_sense(&l.list, P, &truth);
        const hci_sample back = hci_effects_undo(&l.list, P, &reading);
        TEST_ASSERT_TRUE(fabs(reading.theta_m_rad - truth.theta_m_rad) > 1e-4);
        TEST_ASSERT_DOUBLE_WITHIN(1e-13, truth.theta_m_rad, back.theta_m_rad);
        for (int s = 0; s < 3; ++s) {
            TEST_ASSERT_DOUBLE_WITHIN(1e-13, truth.i_abc[s], back.i_abc[s]);
            TEST_ASSERT_DOUBLE_WITHIN(1e-11, truth.change_A_per_s[s], back.change_A_per_s[s]);
        }
    }
}

/* Of a drive that is switched off: no zero of a sensor is in what was written for it. */
static void test_no_current_is_none(void)
{
    el_list l = {0};
    double by[2] = {1.0, 1.0};
    el_add(&l, "current_offset", "a", 0.0, 0.2);
    el_add(&l, "current_offset", "b", 0.0, -0.1);
    const hci_sample off = {.theta_m_rad = 0.3, .speed_rad_per_s = 2.0, .switched_off = true};
    const hci_sample truth = hci_effects_undo(&l.list, P, &off), back = hci_effects_sense(&l.list, P, &off);
    for (int s = 0; s < 3; ++s) {
        TEST_ASSERT_EQUAL_DOUBLE(0.0, truth.i_abc[s]);
        TEST_ASSERT_EQUAL_DOUBLE(0.0, back.i_abc[s]);
    }
    TEST_ASSERT_DOUBLE_WITHIN(1e-15, hci_torque_at(&m.machine, P * 0.3, off.i_abc),
                              hci_effects_predict(&m.machine, &l.list, &off, by));
    TEST_ASSERT_EQUAL_DOUBLE(0.0, by[0]);
    TEST_ASSERT_EQUAL_DOUBLE(0.0, by[1]);
}

/* The currents by themselves, where the angle changes none: it stays as it was read. */
static void test_currents_and_back(void)
{
    uint64_t seed = 8;
    el_list l = {0};
    el_add(&l, "current_offset", "a", 0.0, 0.2);
    el_add(&l, "current_gain", "b", 0.0, 0.03);
    el_add(&l, "position_eccentricity", "mech_sine", 1.0, 0.02);
    for (int j = 0; j < DRAWS; ++j) {
        const hci_sample truth = el_sample(&seed), reading = hci_effects_sense(&l.list, P, &truth);
        const hci_sample back = hci_effects_undo_currents(&l.list, P, &reading);
        TEST_ASSERT_EQUAL_DOUBLE(reading.theta_m_rad, back.theta_m_rad);
        for (int s = 0; s < 3; ++s) {
            TEST_ASSERT_DOUBLE_WITHIN(1e-13, truth.i_abc[s], back.i_abc[s]);
            TEST_ASSERT_DOUBLE_WITHIN(1e-11, truth.change_A_per_s[s], back.change_A_per_s[s]);
        }
    }
}

/* By the i_q of the true angle, and back; also where i_d makes that angle move the current. */
static void test_angle_turns_with_the_load(void)
{
    uint64_t seed = 23;
    el_list l = {0};
    el_add(&l, "position_load", "per_ampere", 0.0, 0.03);
    for (int j = 0; j < DRAWS; ++j) {
        const hci_sample truth = el_sample(&seed), reading = hci_effects_sense(&l.list, P, &truth);
        const hci_dq i = hci_park(hci_clarke(truth.i_abc), P * truth.theta_m_rad);
        const hci_sample back = hci_effects_undo(&l.list, P, &reading);
        TEST_ASSERT_DOUBLE_WITHIN(1e-13, truth.theta_m_rad + 0.03 * i.q / P, reading.theta_m_rad);
        TEST_ASSERT_DOUBLE_WITHIN(1e-12, truth.theta_m_rad, back.theta_m_rad);
        TEST_ASSERT_EQUAL_MEMORY(truth.i_abc, back.i_abc, sizeof back.i_abc);
    }
}

/* Of a list that ends where its memory ends: for the address sanitizer. */
static void test_nothing_behind_the_last_effect(void)
{
    uint64_t seed = 5;
    double by_value[EL_TERMS], same[EL_TERMS];
    el_list l;
    bench(&l);
    hci_effect *exact = malloc(l.list.count * sizeof *exact);
    TEST_ASSERT_NOT_NULL(exact);
    memcpy(exact, l.effect, l.list.count * sizeof *exact);
    const hci_effects list = {exact, l.list.count};
    const hci_sample reading = el_sample(&seed);
    TEST_ASSERT_TRUE(hci_effects_terms(&list) <= EL_TERMS);
    TEST_ASSERT_EQUAL_DOUBLE(hci_effects_predict(&m.machine, &l.list, &reading, by_value),
                             hci_effects_predict(&m.machine, &list, &reading, same));
    TEST_ASSERT_EQUAL_MEMORY(by_value, same, hci_effects_terms(&list) * sizeof *same);
    free(exact);
}

/* A phase without a sensor is minus the sum of what the other two read, errors and all; undoing them gives it
 * back, and the derivatives by the errors are those of the whole. */
static void test_a_phase_without_a_sensor(void)
{
    static const double STEP = 1e-6, GAIN = 0.03, OFFSET_A = 0.2;
    uint64_t seed = 17;
    for (int j = 0; j < 3 * DRAWS; ++j) {
        const int c = j % 3, a = (c + 1) % 3, b = (c + 2) % 3;
        static const char *const NAME[] = {"a", "b", "c"};
        double by_value[2], torque[4];
        hci_sample truth = el_sample(&seed);
        truth.i_abc[c] = -truth.i_abc[a] - truth.i_abc[b];
        truth.computed_phase = c + 1;
        el_list l = {0};
        el_add(&l, "current_gain", NAME[a], 0.0, GAIN);
        el_add(&l, "current_offset", NAME[b], 0.0, OFFSET_A);
        const hci_sample reading = hci_effects_sense(&l.list, P, &truth);
        TEST_ASSERT_DOUBLE_WITHIN(1e-12, (1.0 + GAIN) * truth.i_abc[a], reading.i_abc[a]);
        TEST_ASSERT_DOUBLE_WITHIN(1e-12, truth.i_abc[b] + OFFSET_A, reading.i_abc[b]);
        TEST_ASSERT_DOUBLE_WITHIN(1e-12, -reading.i_abc[a] - reading.i_abc[b], reading.i_abc[c]);
        const hci_sample back = hci_effects_undo(&l.list, P, &reading);
        for (int s = 0; s < 3; ++s)
            TEST_ASSERT_DOUBLE_WITHIN(1e-12, truth.i_abc[s], back.i_abc[s]);
        hci_effects_predict(&m.machine, &l.list, &reading, by_value);
        for (int k = 0; k < 4; ++k) {
            el_list moved = {0};
            el_add(&moved, "current_gain", NAME[a], 0.0, GAIN + (k < 2 ? (k ? STEP : -STEP) : 0.0));
            el_add(&moved, "current_offset", NAME[b], 0.0, OFFSET_A + (k < 2 ? 0.0 : k == 3 ? STEP : -STEP));
            torque[k] = hci_effects_predict(&m.machine, &moved.list, &reading, NULL);
        }
        TEST_ASSERT_DOUBLE_WITHIN(1e-6, (torque[1] - torque[0]) / (2.0 * STEP), by_value[0]);
        TEST_ASSERT_DOUBLE_WITHIN(1e-6, (torque[3] - torque[2]) / (2.0 * STEP), by_value[1]);
    }
}

/* An error of the other two phases is in what is computed, that of the phase without a sensor in nothing; of
 * one effect alone. */
static void test_one_error_beside_a_phase_without_a_sensor(void)
{
    static const double STEP = 1e-6;
    static const char *const NAME[] = {"a", "b", "c"}, *const TYPE[] = {"current_offset", "current_gain"};
    uint64_t seed = 23;
    for (int j = 0; j < 18; ++j) {
        const int c = j % 3, erring = j / 3 % 3;
        double by_value[1], torque[3];
        hci_sample reading = el_sample(&seed);
        reading.computed_phase = c + 1;
        reading.i_abc[c] = -reading.i_abc[(c + 1) % 3] - reading.i_abc[(c + 2) % 3];
        for (int k = 0; k < 3; ++k) {
            el_list l = {0};
            el_add(&l, TYPE[j / 9], NAME[erring], 0.0, 0.03 + (k == 0 ? -STEP : k == 1 ? STEP : 0.0));
            torque[k] = hci_effects_predict(&m.machine, &l.list, &reading, by_value);
        }
        TEST_ASSERT_DOUBLE_WITHIN(1e-6, (torque[1] - torque[0]) / (2.0 * STEP), by_value[0]);
        TEST_ASSERT_TRUE(erring == c ? by_value[0] == 0.0 : fabs(by_value[0]) > 1e-4);
    }
}

/* Every effect of a sensor at once, each with several terms. */
static void test_all_readings_and_back(void)
{
    uint64_t seed = 12;
    el_list l;
    bench(&l);
    el_add(&l, "position_load", "per_ampere", 0.0, 0.02);
    el_add(&l, "position_harmonics", "sine", 1.0, 0.02);
    el_add(&l, "position_harmonics", "cosine", 4.0, 0.01);
    el_add(&l, "current_filter", "time_constant", 0.0, 4e-4);
    for (int j = 0; j < DRAWS; ++j) {
        const hci_sample truth = el_sample(&seed), reading = hci_effects_sense(&l.list, P, &truth);
        const hci_sample back = hci_effects_undo(&l.list, P, &reading);
        TEST_ASSERT_DOUBLE_WITHIN(1e-13, truth.theta_m_rad, back.theta_m_rad);
        for (int s = 0; s < 3; ++s) {
            TEST_ASSERT_DOUBLE_WITHIN(1e-12, truth.i_abc[s], back.i_abc[s]);
            TEST_ASSERT_DOUBLE_WITHIN(1e-10, truth.change_A_per_s[s], back.change_A_per_s[s]);
            TEST_ASSERT_DOUBLE_WITHIN(1e-8, truth.curvature_A_per_s2[s], back.curvature_A_per_s2[s]);
        }
    }
}

/* Offsets and unequal amplitudes of a resolver's sine, read by the arctangent: to first order the harmonics
 * that position_harmonics has. */
static void test_harmonics_of_a_resolver(void)
{
    const double offset = 1e-4, unequal = 1e-4;
    el_list l = {0};
    el_add(&l, "position_harmonics", "cosine", 1.0, offset);
    el_add(&l, "position_harmonics", "sine", 2.0, 0.5 * unequal);
    for (int k = 0; k < 24; ++k) {
        const double theta = 0.01 + k * REF_PI / 12.0 - REF_PI;
        const double read = atan2((1.0 + unequal) * sin(theta) + offset, cos(theta));
        const hci_sample x = {.theta_m_rad = theta / P};
        TEST_ASSERT_DOUBLE_WITHIN(5e-8, read, P * hci_effects_sense(&l.list, P, &x).theta_m_rad);
    }
}

/* A sine behind the low pass: smaller by 1/sqrt(1 + (ωτ)²), later by atan ωτ. */
static void test_current_filter_of_a_sine(void)
{
    const double tau = 2e-3, w = P * OMEGA;
    el_list l = {0};
    el_add(&l, "current_filter", "time_constant", 0.0, tau);
    for (int k = 0; k < 10; ++k) {
        const double t = 0.003 * k;
        const hci_sample truth = truth_at(t), reading = hci_effects_sense(&l.list, P, &truth);
        for (int s = 0; s < 3; ++s)
            TEST_ASSERT_DOUBLE_WITHIN(
                1e-12,
                AMPLITUDE / hypot(1.0, w * tau) *
                    sin(P * true_angle(t) - 2.0 * REF_PI * s / 3.0 + PHASE - atan(w * tau)),
                reading.i_abc[s]);
    }
}

/* A harmonic does not turn with the rotor: with its rate of change the error of a delay is of second order.
 */
static void test_delay_of_a_harmonic(void)
{
    double error[2];
    for (int k = 0; k < 2; ++k) {
        const double delay_s = k ? 1e-5 : 2e-5, n = 7.0, w = P * OMEGA;
        el_list l = {0};
        hci_sample x = {0};
        el_add(&l, "channel_delay", "current", 0.0, delay_s);
        x.theta_m_rad = START;
        x.speed_rad_per_s = OMEGA;
        for (int s = 0; s < 3; ++s) {
            const double angle = n * (P * START - 2.0 * REF_PI * s / 3.0);
            x.i_abc[s] = sin(angle);
            x.change_A_per_s[s] =
                (n - 1.0) * w * cos(angle); /* of order 7, positive sequence, in the rotor frame */
        }
        const hci_sample y = hci_effects_undo(&l.list, P, &x);
        error[k] = y.i_abc[0] - sin(n * (P * START + w * delay_s));
    }
    TEST_ASSERT_TRUE(fabs(error[0]) < 1e-3);
    TEST_ASSERT_DOUBLE_WITHIN(0.2, 4.0, error[0] / error[1]); /* the next order is 7ωτ = 3 % */
}

/* A current that swings in the rotor frame, q(t) = 3 + 0.3 sin(wt + 0.4), over a delay of many radians of it.
 */
static void check_delay_of_a_swing(double w, double speed_rad_per_s)
{
    const double delay_s = 9.0 / w;
    el_list l = {0};
    hci_sample x = {.theta_m_rad = START, .speed_rad_per_s = speed_rad_per_s, .swing_rad_per_s = w};
    el_add(&l, "channel_delay", "current", 0.0, delay_s);
    for (int s = 0; s < 3; ++s) {
        const double c = sin(P * START - 2.0 * REF_PI * s / 3.0);
        x.i_abc[s] = (3.0 + 0.3 * sin(0.4)) * c;
        x.change_A_per_s[s] = 0.3 * w * cos(0.4) * c;
        x.curvature_A_per_s2[s] = -0.3 * w * w * sin(0.4) * c;
    }
    const hci_sample y = hci_effects_undo(&l.list, P, &x), back = hci_effects_sense(&l.list, P, &y);
    for (int s = 0; s < 3; ++s) {
        const double c = sin(P * (START + speed_rad_per_s * delay_s) - 2.0 * REF_PI * s / 3.0);
        TEST_ASSERT_DOUBLE_WITHIN(1e-12, (3.0 + 0.3 * sin(9.4)) * c, y.i_abc[s]);
        TEST_ASSERT_DOUBLE_WITHIN(1e-9, 0.3 * w * cos(9.4) * c, y.change_A_per_s[s]);
        TEST_ASSERT_DOUBLE_WITHIN(1e-12, x.i_abc[s], back.i_abc[s]);
    }
}

static void test_delay_of_many_periods(void)
{
    check_delay_of_a_swing(40.0 * OMEGA, OMEGA);
    check_delay_of_a_swing(0.1, 0.0);
}

/* Currents that stand in the rotor frame, read late by sensors with gains and zeros, at a time: phase
 * currents, and those in the rotor frame of that time. */
static void read_late(double time_s, double delay_s, const double gain[3], const double zero_A[3],
                      double i_abc[3], double rotor_dq0[3])
{
    const double w = P * OMEGA, now = P * START + w * time_s;
    rotor_dq0[0] = rotor_dq0[1] = rotor_dq0[2] = 0.0;
    for (int s = 0; s < 3; ++s) {
        const double shift = 2.0 * REF_PI * s / 3.0, then = now - w * delay_s - shift;
        i_abc[s] = (1.0 + gain[s]) * (0.7 * cos(then) - 3.0 * sin(then)) + zero_A[s];
        rotor_dq0[0] += 2.0 / 3.0 * i_abc[s] * cos(now - shift);
        rotor_dq0[1] -= 2.0 / 3.0 * i_abc[s] * sin(now - shift);
        rotor_dq0[2] += i_abc[s] / 3.0;
    }
}

/* What a reading at START changes by in the rotor frame, by differences along time. */
static hci_sample late_reading(double delay_s, const double gain[3], const double zero_A[3])
{
    const double step_s = 1e-4 / (P * OMEGA);
    double ignored[3], before[3], at[3], after[3];
    hci_sample x = {.theta_m_rad = START, .speed_rad_per_s = OMEGA};
    read_late(-step_s, delay_s, gain, zero_A, ignored, before);
    read_late(step_s, delay_s, gain, zero_A, ignored, after);
    read_late(0.0, delay_s, gain, zero_A, x.i_abc, at);
    for (int s = 0; s < 3; ++s) {
        const double angle = P * START - 2.0 * REF_PI * s / 3.0;
        const double by[3] = {cos(angle), -sin(angle), 1.0};
        for (int k = 0; k < 3; ++k) {
            x.change_A_per_s[s] += by[k] * (after[k] - before[k]) / (2.0 * step_s);
            x.curvature_A_per_s2[s] += by[k] * (after[k] - 2.0 * at[k] + before[k]) / (step_s * step_s);
        }
    }
    return x;
}

/* A gain or a zero of one phase turns against the rotor: it is taken out before the delay is, with its rates.
 */
static void test_delay_beside_gains_and_zeros(void)
{
    static const double GAIN[3] = {0.03, -0.05, 0.01}, ZERO_A[3] = {0.2, 0.05, -0.1};
    const double delay_s = 0.3 / (P * OMEGA), rate = P * OMEGA;
    el_list l = {0};
    el_add(&l, "channel_delay", "current", 0.0, delay_s);
    el_add(&l, "current_gain", "a", 0.0, GAIN[0]);
    el_add(&l, "current_gain", "b", 0.0, GAIN[1]);
    el_add(&l, "current_gain", "c", 0.0, GAIN[2]);
    el_add(&l, "current_offset", "a", 0.0, ZERO_A[0]);
    el_add(&l, "current_offset", "b", 0.0, ZERO_A[1]);
    el_add(&l, "current_offset", "c", 0.0, ZERO_A[2]);
    const hci_sample reading = late_reading(delay_s, GAIN, ZERO_A);
    const hci_sample truth = hci_effects_undo(&l.list, P, &reading);
    for (int s = 0; s < 3; ++s) {
        const double angle = P * START - 2.0 * REF_PI * s / 3.0;
        TEST_ASSERT_DOUBLE_WITHIN(1e-6, 0.7 * cos(angle) - 3.0 * sin(angle), truth.i_abc[s]);
        TEST_ASSERT_DOUBLE_WITHIN(1e-6 * rate, 0.0, truth.change_A_per_s[s]);
        TEST_ASSERT_DOUBLE_WITHIN(1e-5 * rate * rate, 0.0, truth.curvature_A_per_s2[s]);
    }
    const hci_sample back = hci_effects_sense(&l.list, P, &truth);
    for (int s = 0; s < 3; ++s)
        TEST_ASSERT_DOUBLE_WITHIN(1e-6, reading.i_abc[s], back.i_abc[s]);
}

/* What is read is predicted from what is read, with every effect there is. */
static void test_prediction_of_a_reading(void)
{
    uint64_t seed = 8;
    for (int j = 0; j < DRAWS; ++j) {
        el_list l;
        bench(&l);
        el_add(&l, "friction", "viscous", 0.0, 0.002);
        el_add(&l, "saturation", "d0q3_sine", 6.0, 0.01);
        el_add(&l, "cogging", "sine", 18.0, 0.02);
        const hci_sample truth = el_sample(&seed), reading = hci_effects_sense(&l.list, P, &truth);
        const double theta = P * truth.theta_m_rad;
        double d, q;
        rotor(&truth, &d, &q);
        const double torque = hci_torque_at(&m.machine, theta, truth.i_abc) +
                              cogging_18(&truth, theta, d, q) + saturation_q3(&truth, theta, d, q) -
                              0.002 * truth.speed_rad_per_s + 0.25;
        TEST_ASSERT_DOUBLE_WITHIN(1e-11, torque, hci_effects_predict(&m.machine, &l.list, &reading, NULL));
    }
}

/* A wrong calibration is before the zero of the sensor and behind all else; each derivative is the slope. */
static void test_a_gain_is_of_all_but_the_zero(void)
{
    enum { TERMS = 4 };
    uint64_t seed = 9;
    el_list l = {0}, plain = {0};
    double by[TERMS];
    el_add(&l, "friction", "viscous", 0.0, 0.002);
    el_add(&l, "torque_gain", "gain", 0.0, 0.08);
    el_add(&l, "position_offset", "angle", 0.0, 0.1);
    el_add(&l, "torque_sensor", "offset", 0.0, 0.25);
    el_add(&plain, "friction", "viscous", 0.0, 0.002);
    el_add(&plain, "position_offset", "angle", 0.0, 0.1);
    const hci_sample x = el_sample(&seed);
    TEST_ASSERT_DOUBLE_WITHIN(1e-11, 1.08 * hci_effects_predict(&m.machine, &plain.list, &x, NULL) + 0.25,
                              hci_effects_predict(&m.machine, &l.list, &x, by));
    for (size_t k = 0; k < TERMS; ++k) {
        const double step = 1e-5, value = l.term[k][0].value;
        l.term[k][0].value = value + step;
        const double above = hci_effects_predict(&m.machine, &l.list, &x, NULL);
        l.term[k][0].value = value - step;
        const double below = hci_effects_predict(&m.machine, &l.list, &x, NULL);
        l.term[k][0].value = value;
        TEST_ASSERT_DOUBLE_WITHIN(1e-6 * (1.0 + fabs(by[k])), (above - below) / (2.0 * step), by[k]);
    }
}

/* ---- torque sensor along a run ---- */

enum { RUN = 4000 };
static double run_time[RUN], run_torque[RUN];
static const double RUN_STEP = 1e-3;

/* |G| and phase are those of the continuous filter, but for a resonance that is (ω_n h/4)²/12 = 0.12 % off,
 * which near it is 0.0024/0.14 of the answer, and the cubics between samples, which at five samples in a
 * period lose 3/128 (ωh)⁴ = 0.06 and more. */
static void test_torque_sensor_frequency_response(void)
{
    static const double f[] = {2.0, 30.0, 80.0, 200.0}, off[] = {1e-4, 1e-3, 0.0024 / 0.14, 0.1};
    el_list l = {0};
    el_add(&l, "torque_sensor", "time_constant", 0.0, 2e-3);
    el_add(&l, "torque_sensor", "natural_frequency", 0.0, 75.0);
    el_add(&l, "torque_sensor", "damping", 0.0, 0.1);
    for (size_t k = 0; k < sizeof f / sizeof *f; ++k) {
        const double w = 2.0 * REF_PI * f[k], wn = 2.0 * REF_PI * 75.0;
        const double u = w / wn, gain = 1.0 / (hypot(1.0 - u * u, 0.2 * u) * hypot(1.0, w * 2e-3));
        const double phase = -atan2(0.2 * u, 1.0 - u * u) - atan(w * 2e-3);
        for (int j = 0; j < RUN; ++j) {
            run_time[j] = j * RUN_STEP;
            run_torque[j] = 3.0 + sin(w * run_time[j]);
        }
        hci_effects_filter(&l.list, run_time, RUN, run_torque, NULL);
        for (int j = RUN - 50; j < RUN - 1; ++j) /* the start has died away by exp(−4·47) */
            TEST_ASSERT_DOUBLE_WITHIN(off[k] * gain, 3.0 + gain * sin(w * run_time[j] + phase),
                                      run_torque[j]);
    }
}

static void uneven_run(double *torque, const el_list *l, double *by, size_t n)
{
    uint64_t seed = 9;
    double t = 0.0;
    for (size_t k = 0; k < n; ++k) {
        /* one step back: a second run; and a time twice */
        t += k == n / 2 ? -0.1 : k == n / 3 ? 0.0 : 1e-3 * ref_uniform(&seed, 0.2, 2.2);
        run_time[k] = t;
        torque[k] = sin(40.0 * t) + ref_uniform(&seed, -0.3, 0.3);
    }
    hci_effects_filter(&l->list, run_time, n, torque, by);
}

static void test_torque_sensor_derivatives(void)
{
    enum { N = 60, TERMS = 4 };
    static double torque[N], more[N], less[N], by[N * TERMS], unused[N];
    el_list l = {0};
    el_add(&l, "torque_sensor", "time_constant", 0.0, 2e-3);
    el_add(&l, "torque_sensor", "natural_frequency", 0.0, 75.0);
    el_add(&l, "torque_sensor", "damping", 0.0, 0.1);
    el_add(&l, "torque_sensor", "offset", 0.0, 0.0);
    memset(by, 0, sizeof by);
    for (int k = 0; k < N; ++k)
        by[k * TERMS + 3] = 1.0;
    uneven_run(torque, &l, by, N);
    uneven_run(unused, &l, NULL, N);
    TEST_ASSERT_EQUAL_DOUBLE_ARRAY(torque, unused, N);
    for (size_t j = 0; j < 3; ++j) {
        const double value = l.term[0][j].value, h = 1e-5 * value;
        l.term[0][j].value = value + h;
        uneven_run(more, &l, NULL, N);
        l.term[0][j].value = value - h;
        uneven_run(less, &l, NULL, N);
        l.term[0][j].value = value;
        for (int k = 0; k < N; ++k) { /* difference: h² = 1e-10, rounding 1e-16/1e-5 */
            const double found = (more[k] - less[k]) / (2.0 * h);
            TEST_ASSERT_DOUBLE_WITHIN(1e-7 / value, found, by[k * TERMS + (int)j]);
        }
    }
    for (int k = 0; k < N; ++k)
        TEST_ASSERT_DOUBLE_WITHIN(1e-14, 1.0, by[k * TERMS + 3]);
}

/* A lag of 1 ms by hand: settled at the start and after a step back, at rest for a time that comes twice. */
static void test_torque_sensor_starts_and_repeats(void)
{
    const double time[] = {0.0, 1e-3, 1e-3, 2e-3, 1.5e-3, 2.5e-3};
    double torque[] = {3.0, 6.0, 9.0, 9.0, 1.0, 4.0};
    /* y ← u_1 − s + (y − u_0 + s)/e with a slope s = (u_1 − u_0) per τ, and the parts of a step, τ/8, are
     * 1/768 of s off */
    const double first = 3.0 + 3.0 * exp(-1.0), second = 9.0 + (first - 9.0) * exp(-1.0);
    const double answer[] = {3.0, first, first, second, 1.0, 1.0 + 3.0 * exp(-1.0)};
    el_list l = {0};
    el_add(&l, "torque_sensor", "time_constant", 0.0, 1e-3);
    hci_effects_filter(&l.list, time, 6, torque, NULL);
    for (int k = 0; k < 6; ++k)
        TEST_ASSERT_DOUBLE_WITHIN(8.0 / 768.0, answer[k], torque[k]);
}

/* More columns than go side by side, and several sensors at once: each is what one by itself makes of the
 * torque, in steps of any size. */
static void test_torque_sensors_side_by_side(void)
{
    enum { N = 60, TERMS = 39, COLUMNS = 2 + TERMS };
    static double torque[N], one[N], by[N * COLUMNS], many[N * HCI_EFFECT_SENSORS];
    static const double FREQUENCY_Hz[] = {20.0, 75.0, 190.0}, DAMPING[] = {0.03, 0.1, 0.3};
    const hci_effect_run run = {run_time, N, torque, NULL, 0, 0};
    hci_effect sensor[3];
    hci_effect_term term[3][2];
    static el_list l[3], none;
    for (size_t k = 0; k < 3; ++k) {
        el_add(&l[k], "torque_sensor", "natural_frequency", 0.0, FREQUENCY_Hz[k]);
        el_add(&l[k], "torque_sensor", "damping", 0.0, DAMPING[k]);
        memcpy(term[k], l[k].term[0], sizeof term[k]);
        sensor[k] = (hci_effect){l[k].effect[0].type, term[k], 2};
    }
    uneven_run(torque, &none, NULL, N);
    sensor[0].type->filter_many(sensor, 3, &run, many);
    for (size_t k = 0; k < 3; ++k) {
        const hci_effect_run alone = {run_time, N, one, by, COLUMNS, 0};
        for (size_t j = 0; j < N * COLUMNS; ++j)
            by[j] = j % COLUMNS < 2 ? 0.0 : torque[j / COLUMNS];
        memcpy(one, torque, sizeof one);
        sensor[k].type->filter(&sensor[k], &alone);
        for (size_t j = 0; j < N * TERMS; ++j)
            TEST_ASSERT_EQUAL_DOUBLE(one[j / TERMS], by[j / TERMS * COLUMNS + 2 + j % TERMS]);
        /* in more parts of a step than it takes alone, where another one swings faster */
        for (size_t j = 0; j < N; ++j)
            TEST_ASSERT_DOUBLE_WITHIN(k == 2 ? 1e-12 : 0.01, one[j], many[HCI_EFFECT_SENSORS * j + k]);
    }
}

/* Straight in time from the start of a run, whatever else there is. */
static void test_torque_drift_follows_the_time(void)
{
    const hci_effects none = {NULL, 0};
    hci_sample x = {.theta_m_rad = 0.4, .i_abc = {1.0, 2.0, -3.0}, .temperature_C = NAN};
    el_list l = {0};
    el_add(&l, "torque_drift", "rate", 0.0, 0.5);
    for (int k = 0; k < 5; ++k) {
        double by = 0.0;
        x.elapsed_s = 0.7 * k;
        TEST_ASSERT_DOUBLE_WITHIN(1e-12, hci_effects_predict(&m.machine, &none, &x, NULL) + 0.5 * x.elapsed_s,
                                  hci_effects_predict(&m.machine, &l.list, &x, &by));
        TEST_ASSERT_EQUAL_DOUBLE(x.elapsed_s, by);
    }
}

/* Newton's law for what turns before the sensor. */
static void test_rotor_inertia_takes_what_accelerates_it(void)
{
    const hci_effects none = {NULL, 0};
    hci_sample x = {.theta_m_rad = 0.4, .i_abc = {1.0, 2.0, -3.0}, .temperature_C = NAN};
    el_list l = {0};
    el_add(&l, "rotor_inertia", "inertia", 0.0, 0.02);
    for (int k = -2; k <= 2; ++k) {
        double by = 0.0;
        x.acceleration_rad_per_s2 = 30.0 * k;
        TEST_ASSERT_DOUBLE_WITHIN(1e-12, hci_effects_predict(&m.machine, &none, &x, NULL) - 0.6 * k,
                                  hci_effects_predict(&m.machine, &l.list, &x, &by));
        TEST_ASSERT_EQUAL_DOUBLE(-30.0 * k, by);
    }
    TEST_ASSERT_EQUAL_DOUBLE(0.0, l.effect[0].type->parameter[0].least); /* what drives is no inertia */
}

/* A column of regressors is filtered like the torque. */
static void test_torque_sensor_filters_regressors(void)
{
    enum { N = 50 };
    static double torque[N], by[2 * N];
    el_list l = {0};
    el_add(&l, "cogging", "sine", 6.0, 1.0);
    el_add(&l, "torque_sensor", "time_constant", 0.0, 5e-3);
    for (int k = 0; k < N; ++k) {
        run_time[k] = 1e-3 * k;
        torque[k] = by[2 * k] = sin(0.3 * k);
        by[2 * k + 1] = 0.0;
    }
    hci_effects_filter(&l.list, run_time, N, torque, by);
    for (int k = 0; k < N; ++k)
        TEST_ASSERT_EQUAL_DOUBLE(torque[k], by[2 * k]);
}

/* ---- registry ---- */

static void test_registry(void)
{
    static const char *const NAMES[] = {"cogging",
                                        "back_emf",
                                        "phase_imbalance",
                                        "reluctance",
                                        "saturation",
                                        "magnet_temperature",
                                        "current_offset",
                                        "current_gain",
                                        "position_offset",
                                        "position_eccentricity",
                                        "channel_delay",
                                        "friction",
                                        "torque_sensor",
                                        "mechanical_order",
                                        "unequal_magnets",
                                        "stribeck_friction",
                                        "iron_drag",
                                        "current_filter",
                                        "position_harmonics",
                                        "torque_gain",
                                        "torque_drift",
                                        "rotor_inertia",
                                        "position_load"};
    const size_t count = sizeof NAMES / sizeof *NAMES;
    for (size_t k = 0; k < count; ++k) {
        const hci_effect_type *type = hci_effect_type_find(NAMES[k]);
        TEST_ASSERT_NOT_NULL_MESSAGE(type, NAMES[k]);
        TEST_ASSERT_EQUAL_STRING(NAMES[k], type->name);
        TEST_ASSERT_TRUE(type->equation && type->signature && type->parameter_count > 0);
        TEST_ASSERT_TRUE(type->torque || type->torque_of_all || type->undo || type->filter ||
                         type->read_torque);
        TEST_ASSERT_TRUE(!type->needs || type->without || type->needs == HCI_EFFECT_NEEDS_RATE);
        TEST_ASSERT_TRUE(!type->sense == !type->undo && !type->undo == !type->undo_adjoint);
    }
    TEST_ASSERT_NOT_NULL(hci_effect_type_at(count - 1));
    TEST_ASSERT_NULL(hci_effect_type_at(count));
    TEST_ASSERT_NULL(hci_effect_type_find("coggin"));
    TEST_ASSERT_NULL(hci_effect_type_find("coggings"));
    TEST_ASSERT_NULL(hci_effect_type_find("unknown"));
}

static void test_no_effects(void)
{
    uint64_t seed = 10;
    const hci_effects none = {NULL, 0};
    const hci_sample x = el_sample(&seed);
    TEST_ASSERT_DOUBLE_WITHIN(1e-13, hci_torque_at(&m.machine, P * x.theta_m_rad, x.i_abc),
                              hci_effects_predict(&m.machine, &none, &x, NULL));
    TEST_ASSERT_EQUAL_UINT64(0, hci_effects_terms(&none));
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_torque_of_each_effect);
    RUN_TEST(test_torque_of_several_terms);
    RUN_TEST(test_terms_of_the_coenergy_add_up);
    RUN_TEST(test_saturation_scales_with_its_reference);
    RUN_TEST(test_unknown_temperature_is_the_reference);
    RUN_TEST(test_friction_brakes);
    RUN_TEST(test_stribeck_friction_fades);
    RUN_TEST(test_iron_drag_grows_with_load);
    RUN_TEST(test_nothing_behind_the_last_effect);
    RUN_TEST(test_a_phase_without_a_sensor);
    RUN_TEST(test_one_error_beside_a_phase_without_a_sensor);
    RUN_TEST(test_all_readings_and_back);
    RUN_TEST(test_harmonics_of_a_resolver);
    RUN_TEST(test_angle_turns_with_the_load);
    RUN_TEST(test_current_filter_of_a_sine);
    RUN_TEST(test_torque_drift_follows_the_time);
    RUN_TEST(test_rotor_inertia_takes_what_accelerates_it);
    RUN_TEST(test_linear_parameters);
    RUN_TEST(test_derivatives_by_current_and_angle);
    RUN_TEST(test_derivatives_by_every_parameter);
    RUN_TEST(test_derivatives_by_many_sensors_in_a_row);
    RUN_TEST(test_predicted_again);
    RUN_TEST(test_regressors_of_linear_types);
    RUN_TEST(test_readings_of_a_true_state);
    RUN_TEST(test_no_current_is_none);
    RUN_TEST(test_readings_and_back);
    RUN_TEST(test_currents_and_back);
    RUN_TEST(test_delay_of_a_harmonic);
    RUN_TEST(test_delay_of_many_periods);
    RUN_TEST(test_delay_beside_gains_and_zeros);
    RUN_TEST(test_prediction_of_a_reading);
    RUN_TEST(test_a_gain_is_of_all_but_the_zero);
    RUN_TEST(test_torque_sensor_frequency_response);
    RUN_TEST(test_torque_sensor_derivatives);
    RUN_TEST(test_torque_sensor_starts_and_repeats);
    RUN_TEST(test_torque_sensor_filters_regressors);
    RUN_TEST(test_torque_sensors_side_by_side);
    RUN_TEST(test_registry);
    RUN_TEST(test_no_effects);
    return UNITY_END();
}
