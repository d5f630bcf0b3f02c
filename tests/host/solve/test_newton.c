/* Interior-magnet machines: the harmonic balance by Newton's method and the pointwise strategies, compared
 * with torque that is sampled here from e·i + ½iᵀL'i + T_cog with cosines of its own. */
#include <math.h>
#include <string.h>

#include "hci/host/solve/solve.h"
#include "support/reference.h"
#include "unity.h"

enum { SAMPLES = 2048, L_ORDERS = 3, EMF_ORDERS = 3, POLE_PAIRS = 3 };

/* test_newton_at_length has more machines. */
#ifdef AT_LENGTH
enum { PROMISES = 12, CHOICES = 8, NEAREST = 60, MOST_COMPONENTS = 11 };
#else
enum { PROMISES = 4, CHOICES = 2, NEAREST = 12, MOST_COMPONENTS = 7 };
#endif

/* L_s = Σ l cos(m(θ − 2πs/3) + ψ), M_s the same with its own figures; e and cogging likewise with sines. */
typedef struct {
    double order, self, self_phase, mutual, mutual_phase;
} inductance;

typedef struct {
    ref_wave emf[EMF_ORDERS], cogging[2];
    inductance l[L_ORDERS];
    hci_wave back_emf[EMF_ORDERS];
    hci_harmonic cogging_terms[2];
    hci_inductance_slope slope[L_ORDERS];
    hci_machine_data data;
} machine;

static uint64_t seed;

static void make_slope(const inductance *l, hci_inductance_slope *t)
{
    t->order = l->order;
    for (int s = 0; s < 3; ++s) {
        /* p d/dθ of l cos(mθ − x) = −p m l sin(mθ − x) = −p m l (cos x sin mθ − sin x cos mθ) */
        const double x = l->order * 2.0 * REF_PI * s / 3.0 - l->self_phase;
        const double y = l->order * 2.0 * REF_PI * s / 3.0 - l->mutual_phase;
        t->sine[s] = -POLE_PAIRS * l->order * l->self * cos(x);
        t->cosine[s] = POLE_PAIRS * l->order * l->self * sin(x);
        t->sine[3 + s] = -POLE_PAIRS * l->order * l->mutual * cos(y);
        t->cosine[3 + s] = POLE_PAIRS * l->order * l->mutual * sin(y);
    }
}

/* saliency: size of the inductance ripple in N·m/A² beside e = 1 N·m/A and currents of a few ampere. */
static void make_machine(machine *m, double saliency)
{
    static const double EMF[EMF_ORDERS] = {1, 5, 7}, L[L_ORDERS] = {2, 4, 8}, COGGING[2] = {6, 12};
    memset(m, 0, sizeof *m);
    for (int k = 0; k < EMF_ORDERS; ++k) {
        m->emf[k] =
            (ref_wave){EMF[k], 0, k == 0 ? 1.0 : ref_uniform(&seed, 0.02, 0.12), ref_uniform(&seed, -3, 3)};
        if (k == 0) m->emf[k].phase = 0.0;
        m->back_emf[k] =
            hci_wave_polar(EMF[k], hci_sequence_of_order(EMF[k]), m->emf[k].amplitude, m->emf[k].phase);
    }
    for (int k = 0; k < 2; ++k) {
        m->cogging[k] = (ref_wave){COGGING[k], 0, ref_uniform(&seed, 0.05, 0.2), ref_uniform(&seed, -3, 3)};
        m->cogging_terms[k] = hci_harmonic_polar(COGGING[k], m->cogging[k].amplitude, m->cogging[k].phase);
    }
    for (int k = 0; k < L_ORDERS; ++k) {
        const double size = saliency / (POLE_PAIRS * L[k]) * (k == 0 ? 1.0 : 0.2);
        m->l[k] = (inductance){L[k], -size, k == 0 ? 0.0 : ref_uniform(&seed, -3, 3), -size,
                               k == 0 ? -4.0 * REF_PI / 3.0 : ref_uniform(&seed, -3, 3)};
        make_slope(&m->l[k], &m->slope[k]);
    }
    m->data.pole_pairs = POLE_PAIRS;
    m->data.resistance_ohm = m->data.inductance_d_H = m->data.inductance_q_H = NAN;
    m->data.model =
        (hci_machine){POLE_PAIRS, m->back_emf, EMF_ORDERS, m->cogging_terms, 2, m->slope, L_ORDERS};
}

/* Torque at one angle from the formulas above. */
static double torque_at(const machine *m, double theta, const double i[3])
{
    double torque = 0.0;
    for (int k = 0; k < 2; ++k)
        torque += m->cogging[k].amplitude * sin(m->cogging[k].order * theta + m->cogging[k].phase);
    for (int s = 0; s < 3; ++s) {
        const double shifted = theta - 2.0 * REF_PI * s / 3.0;
        for (int k = 0; k < EMF_ORDERS; ++k)
            torque += i[s] * m->emf[k].amplitude * sin(m->emf[k].order * shifted + m->emf[k].phase);
        for (int k = 0; k < L_ORDERS; ++k) {
            const inductance *l = &m->l[k];
            const double p_m = POLE_PAIRS * l->order;
            torque += -0.5 * p_m * l->self * sin(l->order * shifted + l->self_phase) * i[s] * i[s];
            torque += -p_m * l->mutual * sin(l->order * shifted + l->mutual_phase) * i[s] * i[(s + 1) % 3];
        }
    }
    return torque;
}

static void current_at(const hci_solution *s, double theta, double i[3])
{
    i[0] = i[1] = i[2] = 0.0;
    for (size_t k = 0; k < s->current.count; ++k) {
        const hci_wave *w = &s->current.wave[k];
        for (int phase = 0; phase < 3; ++phase) {
            const double x = w->order * theta - w->sequence * 2.0 * REF_PI * phase / 3.0;
            i[phase] += w->sine * sin(x) + w->cosine * cos(x);
        }
    }
}

/* Largest difference between the promised spectrum and that of the sampled torque, over all orders below
 * 300. */
static double worst_promise(const machine *m, const hci_solution *s)
{
    static double torque[SAMPLES];
    double worst = 0.0;
    for (int j = 0; j < SAMPLES; ++j) {
        double i[3];
        current_at(s, 2.0 * REF_PI * j / SAMPLES, i);
        torque[j] = torque_at(m, 2.0 * REF_PI * j / SAMPLES, i);
    }
    for (int n = 0; n < 300; ++n) {
        double sine = 0.0, cosine = 0.0;
        for (int j = 0; j < SAMPLES; ++j) {
            const double x = 2.0 * REF_PI * (double)(n * j % SAMPLES) / SAMPLES;
            sine += torque[j] * sin(x) * (n ? 2.0 : 1.0) / SAMPLES;
            cosine += torque[j] * cos(x) * (n ? 2.0 : 1.0) / SAMPLES;
        }
        for (size_t k = 0; k < s->order_count; ++k)
            if (fabs(s->order[k].torque_Nm.order - n) < 1e-9) {
                sine -= s->order[k].torque_Nm.sine;
                cosine -= s->order[k].torque_Nm.cosine;
            }
        worst = fmax(worst, hypot(sine, cosine));
    }
    return worst;
}

static hci_target_order wanted[2];
static const hci_target TARGET = {wanted, 2};

static void want(double mean_Nm, double order, double amplitude_Nm)
{
    wanted[0] = (hci_target_order){{0.0, 0.0, mean_Nm}, 1.0};
    wanted[1] = (hci_target_order){{order, amplitude_Nm, 0.0}, 1.0};
}

static hci_status solve(const machine *m, const hci_solve_options *o, hci_solution *s)
{
    hci_note note = {{0}};
    const hci_status status = hci_solve(&m->data, o, s, &note);
    TEST_ASSERT_TRUE_MESSAGE(status <= HCI_NOT_REACHED, note.text);
    return status;
}

void setUp(void)
{
    seed = 20;
}

void tearDown(void)
{
}

/* 1e-9 of the torque: rounding of some hundred products, far below any wrong term. */
static void test_promised_torque_is_what_the_currents_make(void)
{
    static const hci_component SET[] = {{1, 1}, {5, -1}, {7, 1}, {11, -1}, {13, 1}, {2, 1}};
    static const hci_set NAMES[] = {HCI_SET_POS, HCI_SET_NEG, HCI_SET_POS,
                                    HCI_SET_NEG, HCI_SET_POS, HCI_SET_POS};
    hci_component component[6];
    hci_set name[6];
    memcpy(component, SET, sizeof SET);
    memcpy(name, NAMES, sizeof NAMES);
    const hci_component_set set = {component, name, 6, {{0}}};
    for (int trial = 0; trial < PROMISES; ++trial) {
        machine m;
        hci_solution s;
        hci_solve_options o = {.target = &TARGET};
        make_machine(&m, ref_uniform(&seed, 0.02, 0.15));
        want(ref_uniform(&seed, 1, 5), 6, ref_uniform(&seed, 0, 0.3));
        if (trial % 4 == 1) o.set = &set;
        if (trial % 4 == 2) o.choose_at_most = 5;
        if (trial % 4 == 3) {
            o.method = HCI_METHOD_POINTWISE;
            o.strategy = (hci_strategy)(trial / 4);
        }
        solve(&m, &o, &s);
        TEST_ASSERT_DOUBLE_WITHIN(1e-9 * wanted[0].torque_Nm.cosine, 0.0, worst_promise(&m, &s));
        hci_solution_release(&s);
    }
}

static void test_auto_reaches_the_target_near_the_least_copper(void)
{
    for (int trial = 0; trial < CHOICES; ++trial) {
        machine m;
        hci_solution s;
        const hci_solve_options o = {.target = &TARGET};
        make_machine(&m, ref_uniform(&seed, 0.02, 0.15));
        want(ref_uniform(&seed, 1, 5), trial % 2 ? 6 : 1, ref_uniform(&seed, 0, 0.5));
        TEST_ASSERT_EQUAL(HCI_OK, solve(&m, &o, &s));
        TEST_ASSERT_TRUE(s.newton_steps > 1 && s.newton_converged && s.newton_change <= 1e-9);
        TEST_ASSERT_TRUE(s.loss_to_limit > 1.0 - 1e-9 && s.loss_to_limit < 1.02);
        hci_solution_release(&s);
    }
}

/* With L' = 0 in every entry, Newton's method must give the linear solution. */
static void test_without_reluctance_it_is_the_linear_solution(void)
{
    machine m;
    hci_solution linear, newton;
    const hci_solve_options o = {.target = &TARGET};
    make_machine(&m, 0.0);
    want(3, 6, 0.4);
    solve(&m, &o, &newton);
    m.data.model.slope_count = 0;
    solve(&m, &o, &linear);
    TEST_ASSERT_EQUAL_UINT(0, linear.newton_steps);
    TEST_ASSERT_TRUE(newton.newton_steps > 0);
    TEST_ASSERT_EQUAL_UINT(linear.current.count, newton.current.count);
    for (size_t k = 0; k < linear.current.count; ++k) {
        TEST_ASSERT_EQUAL_DOUBLE(linear.current.wave[k].order, newton.current.wave[k].order);
        /* 1e-12 A of some 2 A: two solves of a well-conditioned system */
        TEST_ASSERT_DOUBLE_WITHIN(1e-12, linear.current.wave[k].sine, newton.current.wave[k].sine);
        TEST_ASSERT_DOUBLE_WITHIN(1e-12, linear.current.wave[k].cosine, newton.current.wave[k].cosine);
    }
    hci_solution_release(&linear);
    hci_solution_release(&newton);
}

/* rms distance of two currents over the turn. */
static double distance(const hci_solution *a, const hci_solution *b)
{
    double sum = 0.0;
    for (int j = 0; j < SAMPLES; ++j) {
        double x[3], y[3];
        current_at(a, 2.0 * REF_PI * j / SAMPLES, x);
        current_at(b, 2.0 * REF_PI * j / SAMPLES, y);
        for (int s = 0; s < 3; ++s)
            sum += (x[s] - y[s]) * (x[s] - y[s]);
    }
    return sqrt(sum / SAMPLES);
}

static void test_harmonic_balance_approaches_the_pointwise_current(void)
{
    machine m;
    hci_solution pointwise, balanced;
    hci_solve_options o = {.target = &TARGET, .method = HCI_METHOD_POINTWISE};
    double before = HUGE_VAL;
    make_machine(&m, 0.1);
    want(4, 6, 0.0);
    TEST_ASSERT_EQUAL(HCI_OK, solve(&m, &o, &pointwise));
    o.method = HCI_METHOD_AUTO;
    for (size_t count = 3; count <= MOST_COMPONENTS; count += 4) {
        double now;
        o.choose_at_most = count;
        o.loss_allowance = 1.5;
        solve(&m, &o, &balanced);
        now = distance(&pointwise, &balanced);
        printf("  %zu components: %.2e A from the pointwise current, worst order %.2e N·m\n", count, now,
               balanced.worst_error_Nm);
        TEST_ASSERT_TRUE(now < before);
        before = now;
        hci_solution_release(&balanced);
    }
    o.choose_at_most = 0;
    solve(&m, &o, &balanced);
    TEST_ASSERT_TRUE(distance(&pointwise, &balanced) < before);
    hci_solution_release(&balanced);
    hci_solution_release(&pointwise);
}

/* Sum of the squared amplitudes of what the torque is off, order by order: twice the mean square, of which
 * the mean counts once. */
static double squared_error_Nm2(const machine *m, const hci_solution *s)
{
    double sum = 0.0, squares = 0.0;
    for (int j = 0; j < SAMPLES; ++j) {
        double i_A[3];
        const double theta = 2.0 * REF_PI * j / SAMPLES;
        current_at(s, theta, i_A);
        const double off_Nm = torque_at(m, theta, i_A) - wanted[0].torque_Nm.cosine;
        sum += off_Nm / SAMPLES;
        squares += off_Nm * off_Nm / SAMPLES;
    }
    return 2.0 * squares - sum * sum;
}

/* Least squared error after a change of one coordinate by 1 % of the current. */
static double least_around_Nm2(const machine *m, hci_solution *s)
{
    const double step_A = 0.01 * sqrt(2.0 / 3.0 * s->mean_square_A2);
    double least = HUGE_VAL;
    for (size_t k = 0; k < s->current.count; ++k)
        for (int part = 0; part < 4; ++part) {
            double *x = part % 2 ? &s->current.wave[k].sine : &s->current.wave[k].cosine;
            const double was_A = *x;
            *x += part / 2 ? step_A : -step_A;
            least = fmin(least, squared_error_Nm2(m, s));
            *x = was_A;
        }
    return least;
}

/* Few components mostly cannot make the torque of a machine with much reluctance, where full steps lead astray: what
 * is given in the end is nearer than all that surrounds it. */
static void test_a_set_that_cannot_make_the_torque_comes_nearest(void)
{
    hci_component component[] = {{1, 1}, {5, -1}, {7, 1}, {11, -1}};
    hci_set name[] = {HCI_SET_POS, HCI_SET_NEG, HCI_SET_POS, HCI_SET_NEG};
    for (int trial = 0; trial < NEAREST; ++trial) {
        const hci_component_set set = {component, name, 2 + (size_t)trial % 3, {{0}}};
        const hci_solve_options o = {.target = &TARGET, .set = &set};
        machine m;
        hci_solution s;
        make_machine(&m, ref_uniform(&seed, 0.2, 0.6));
        want(ref_uniform(&seed, 4, 10), 6, 0.0);
        solve(&m, &o, &s);
        const double error_Nm2 = squared_error_Nm2(&m, &s);
        TEST_ASSERT_TRUE(error_Nm2 < wanted[0].torque_Nm.cosine * wanted[0].torque_Nm.cosine);
        TEST_ASSERT_TRUE(least_around_Nm2(&m, &s) > 0.999 * error_Nm2);
        hci_solution_release(&s);
    }
}

/* Phase currents of one ampere along and across the back-EMF; returns the length of the back-EMF. */
static double back_emf_axes(const machine *m, double theta, double q[3], double d[3])
{
    double e[2] = {0, 0};
    for (int k = 0; k < EMF_ORDERS; ++k)
        for (int phase = 0; phase < 3; ++phase) {
            const double x = 2.0 * REF_PI * phase / 3.0;
            const double value = m->emf[k].amplitude * sin(m->emf[k].order * (theta - x) + m->emf[k].phase);
            e[0] += sqrt(2.0 / 3.0) * cos(x) * value;
            e[1] += sqrt(2.0 / 3.0) * sin(x) * value;
        }
    const double size = hypot(e[0], e[1]);
    for (int phase = 0; phase < 3; ++phase) {
        const double c = sqrt(2.0 / 3.0) * cos(2.0 * REF_PI * phase / 3.0),
                     n = sqrt(2.0 / 3.0) * sin(2.0 * REF_PI * phase / 3.0);
        q[phase] = (c * e[0] + n * e[1]) / size;
        d[phase] = (c * e[1] - n * e[0]) / size;
    }
    return size;
}

/* T(x d + i_q q) less the wanted torque is a quadratic in x: its coefficients from torques at −1, 0 and 1. */
static double discriminant_of_cancel(const machine *m, double theta)
{
    double q[3], d[3], i_A[3];
    const double size = back_emf_axes(m, theta, q, d), wanted_Nm = wanted[0].torque_Nm.cosine;
    double excess_Nm[3];
    for (int x = -1; x <= 1; ++x) {
        for (int phase = 0; phase < 3; ++phase)
            i_A[phase] = x * d[phase] + q[phase] * wanted_Nm / size;
        excess_Nm[x + 1] = torque_at(m, theta, i_A) - wanted_Nm;
    }
    const double a = 0.5 * (excess_Nm[2] + excess_Nm[0]) - excess_Nm[1];
    const double b = 0.5 * (excess_Nm[2] - excess_Nm[0]);
    return b * b - 4.0 * a * excess_Nm[1];
}

static bool is_in_gap(const hci_solution *s, double theta)
{
    for (size_t k = 0; k < s->gap_count; ++k)
        if (theta > s->gap[k].from_rad - 1e-9 && theta < s->gap[k].to_rad + 1e-9) return true;
    return false;
}

/* Strategy `cancel` has gaps exactly where its discriminant, computed here from sampled L', is negative. */
static void test_gaps_of_cancel_are_where_no_root_is(void)
{
    machine m;
    hci_solution s;
    const hci_solve_options o = {
        .target = &TARGET, .method = HCI_METHOD_POINTWISE, .strategy = HCI_STRATEGY_CANCEL};
    int missing = 0;
    make_machine(&m, 0.15);
    for (int k = 0; k < 2; ++k) {
        m.cogging[k].amplitude *= 4.0;
        m.cogging_terms[k] =
            hci_harmonic_polar(m.cogging[k].order, m.cogging[k].amplitude, m.cogging[k].phase);
    }
    want(1.0, 6, 0.0);
    TEST_ASSERT_EQUAL(HCI_NOT_REACHED, solve(&m, &o, &s));
    TEST_ASSERT_TRUE(s.gap_count > 0 && s.gap_count <= HCI_MOST_GAPS);
    for (int j = 0; j < SAMPLES; ++j) {
        const double theta = 2.0 * REF_PI * j / SAMPLES;
        const bool in_gap = is_in_gap(&s, theta);
        TEST_ASSERT_EQUAL_INT_MESSAGE(discriminant_of_cancel(&m, theta) < 0.0, in_gap,
                                      "the gap is where the discriminant is negative");
        missing += in_gap;
    }
    TEST_ASSERT_TRUE(missing > 0 && missing < SAMPLES);
    hci_solution_release(&s);
}

/* A torque beyond all reach: e·i − ½k|i|² ≤ e²/2k. No result is better than a wrong one. */
static void test_unreachable_torque_is_said(void)
{
    machine m;
    hci_solution s;
    hci_note note = {{0}};
    const hci_solve_options o = {.target = &TARGET, .method = HCI_METHOD_POINTWISE};
    make_machine(&m, 0.0);
    for (int k = 0; k < L_ORDERS; ++k)
        memset(m.slope[k].sine, 0, sizeof m.slope[k].sine);
    memset(m.slope[0].cosine, 0, sizeof m.slope[0].cosine);
    m.slope[0].order = 0.0; /* not physical, but definite: the same −0.1 N·m/A² in each phase */
    for (int s3 = 0; s3 < 3; ++s3)
        m.slope[0].cosine[s3] = -0.1;
    want(60.0, 6, 0.0);
    const hci_status status = hci_solve(&m.data, &o, &s, &note);
    TEST_ASSERT_EQUAL(HCI_NOT_REACHED, status);
    TEST_ASSERT_TRUE(s.gap_count > 0);
    TEST_ASSERT_TRUE(isnan(s.limit_mean_square_A2));
    hci_solution_release(&s);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_promised_torque_is_what_the_currents_make);
    RUN_TEST(test_auto_reaches_the_target_near_the_least_copper);
    RUN_TEST(test_without_reluctance_it_is_the_linear_solution);
    RUN_TEST(test_harmonic_balance_approaches_the_pointwise_current);
    RUN_TEST(test_a_set_that_cannot_make_the_torque_comes_nearest);
    RUN_TEST(test_gaps_of_cancel_are_where_no_root_is);
    RUN_TEST(test_unreachable_torque_is_said);
    return UNITY_END();
}
