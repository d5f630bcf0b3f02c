/* The currents of the three strategies against brute force, closed forms and laws and, over a turn of machine
 * C, as the papers use them. References work in long double from the formulas alone. */
#include "hci/machine/strategy.h"

#include <float.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#include "support/reference.h"
#include "unity.h"

typedef long double real;

static uint64_t seed;

void setUp(void)
{
    seed = 20240611u;
}

void tearDown(void)
{
}

/* ---- random points ------------------------------------------------------------------------------------- */

static double uniform(double low, double high)
{
    return ref_uniform(&seed, low, high);
}

static double either_sign(void)
{
    return ref_integer(&seed, 0, 1) ? 1.0 : -1.0;
}

/* Any sign, any of 10^±decades. */
static double draw_size(double decades)
{
    return either_sign() * pow(10.0, uniform(-decades, decades));
}

enum {
    ZERO,
    ISOTROPIC,
    INDEFINITE,
    POSITIVE,
    NEGATIVE,
    SINGULAR,
    SHARP,
    FAINT,
    HARD,
    NEARLY_ISOTROPIC,
    KINDS
};

typedef struct {
    hci_machine_point p;
    double torque_Nm;
    int kind;
} point_case;

/* L' with eigenvalue `first` along the angle and `second` across it. */
static void set_slope(double slope[3], double first, double second, double angle_rad)
{
    const double c = cos(angle_rad), s = sin(angle_rad);
    slope[0] = first * c * c + second * s * s;
    slope[1] = (first - second) * c * s;
    slope[2] = first * s * s + second * c * c;
}

static void draw_slope(double slope[3], int kind, double angle_rad)
{
    const double a = fabs(draw_size(1.5)), b = fabs(draw_size(1.5)), sign = either_sign();
    const double v = ref_integer(&seed, 1, 9), w = ref_integer(&seed, -9, 9);
    slope[0] = slope[1] = slope[2] = 0.0;
    if (kind == ISOTROPIC) slope[0] = slope[2] = sign * a;
    if (kind == INDEFINITE || kind == HARD) set_slope(slope, a, -b, angle_rad);
    if (kind == POSITIVE) set_slope(slope, a, b, angle_rad);
    if (kind == NEGATIVE) set_slope(slope, -a, -b, angle_rad);
    if (kind == SHARP) set_slope(slope, sign * a, -sign * 1e5 * b, angle_rad);
    if (kind == FAINT) set_slope(slope, sign * 1e-15 * a, either_sign() * 1e-15 * b, angle_rad);
    if (kind == NEARLY_ISOTROPIC)
        set_slope(slope, sign * a, sign * a * (1.0 + draw_size(1.0) * 1e-16), angle_rad);
    if (kind == SINGULAR) { /* exactly: whole numbers */
        slope[0] = sign * v * v;
        slope[1] = sign * v * w;
        slope[2] = sign * w * w;
    }
}

/* Units of the draw: back-EMF × t/i, L' × t/i², torque × t. */
static point_case scaled(const point_case *c, double t, double i)
{
    point_case s = *c;
    for (int k = 0; k < 2; ++k)
        s.p.e[k] *= t / i;
    for (int k = 0; k < 3; ++k)
        s.p.slope[k] *= t / (i * i);
    s.p.cogging_Nm *= t;
    s.torque_Nm *= t;
    return s;
}

static point_case draw_case(int kind)
{
    point_case c = {{{0.0, 0.0}, {0.0, 0.0, 0.0}, 0.0}, 0.0, kind};
    const double angle_rad =
        ref_integer(&seed, 0, 3) ? uniform(-4.0, 4.0) : 0.25 * REF_PI * ref_integer(&seed, -4, 4);
    const double size = ref_integer(&seed, 0, 7) ? fabs(draw_size(1.0)) : pow(10.0, uniform(-30.0, -8.0));
    const double e_rad = kind == HARD ? angle_rad + 0.5 * REF_PI : uniform(-4.0, 4.0);
    c.p.e[0] = size * cos(e_rad);
    c.p.e[1] = size * sin(e_rad);
    if (ref_integer(&seed, 0, 15) == 0) c.p.e[0] = c.p.e[1] = 0.0;
    if (kind == HARD && ref_integer(&seed, 0, 1)) c.p.e[0] = 0.0;
    draw_slope(c.p.slope, kind, kind == HARD && c.p.e[0] == 0.0 ? 0.0 : angle_rad);
    c.p.cogging_Nm = ref_integer(&seed, 0, 3) ? 0.3 * draw_size(0.5) : 0.0;
    c.torque_Nm = draw_size(1.5);
    return scaled(&c, ldexp(1.0, ref_integer(&seed, -30, 30)), ldexp(1.0, ref_integer(&seed, -20, 20)));
}

/* ---- the torque and the shortest current by brute force ------------------------------------------------ */

static real torque_of(const hci_machine_point *p, const double x[2])
{
    const real a = x[0], b = x[1];
    return p->e[0] * a + p->e[1] * b + 0.5L * p->slope[0] * a * a + p->slope[1] * a * b +
           0.5L * p->slope[2] * b * b + p->cogging_Nm;
}

/* The sum of the torque's terms without their signs, the unit of its rounding errors. */
static real torque_size(const hci_machine_point *p, const double x[2])
{
    const real a = fabs(x[0]), b = fabs(x[1]);
    return fabs(p->e[0]) * a + fabs(p->e[1]) * b + 0.5L * fabs(p->slope[0]) * a * a +
           fabs(p->slope[1]) * a * b + 0.5L * fabs(p->slope[2]) * b * b + fabs(p->cogging_Nm);
}

/* g·x + ½xᵀHx = τ > 0 in the eigenvectors of H; largest is h[0]. */
typedef struct {
    real g[2], h[2], tau;
    real axis_rad; /* of h[0] */
} problem;

static problem problem_of(const point_case *c)
{
    const real given = (real)c->torque_Nm - c->p.cogging_Nm, sign = given < 0.0L ? -1.0L : 1.0L;
    const real aa = sign * c->p.slope[0], ab = sign * c->p.slope[1], bb = sign * c->p.slope[2];
    const real mean = 0.5L * (aa + bb), radius = hypotl(0.5L * (aa - bb), ab);
    const real outer = mean < 0.0L ? mean - radius : mean + radius;
    const real inner = outer == 0.0L ? 0.0L : (aa * bb - ab * ab) / outer;
    const real axis_rad = 0.5L * atan2l(ab, 0.5L * (aa - bb)), c0 = cosl(axis_rad), s0 = sinl(axis_rad);
    const problem q = {{sign * (c0 * c->p.e[0] + s0 * c->p.e[1]), sign * (c0 * c->p.e[1] - s0 * c->p.e[0])},
                       {mean < 0.0L ? inner : outer, mean < 0.0L ? outer : inner},
                       sign * given,
                       axis_rad};
    return q;
}

/* How good a direction is: 1/|x| where x along it makes τ, from ½h r² + g r = τ; less than zero where none
 * does, and the more the less of τ is made. */
static real merit(const problem *q, real angle_rad)
{
    const real c = cosl(angle_rad), s = sinl(angle_rad);
    const real g = q->g[0] * c + q->g[1] * s, h = q->h[0] * c * c + q->h[1] * s * s;
    const real square = g * g + 2.0L * h * q->tau;
    if (square >= 0.0L && (h > 0.0L || g > 0.0L)) return (g + sqrtl(square)) / (2.0L * q->tau);
    return g > 0.0L && h < 0.0L ? g * g / (-2.0L * h * q->tau) - 1.0L : -1.0L;
}

static void try_direction(const problem *q, real angle_rad, real *best, real *at_rad)
{
    const real m = merit(q, angle_rad);
    if (m <= *best) return;
    *best = m;
    *at_rad = angle_rad;
}

/* Best merit over all directions: an even grid, one that condenses around the eigenvectors, the linear term
 * and their perpendiculars, then steps that halve. */
static real best_merit(const problem *q)
{
    const real quarter = 1.57079632679489661923L, bases_rad[2] = {0.0L, atan2l(q->g[1], q->g[0])};
    real best = -2.0L, at_rad = 0.0L;
    for (int k = 0; k < 180; ++k)
        try_direction(q, quarter * k / 45.0L, &best, &at_rad);
    for (int k = 0; k < 8; ++k)
        for (int decade = 0; decade <= 20; ++decade) {
            const real base_rad = bases_rad[k & 1] + quarter * (k >> 1),
                       off_rad = powl(10.0L, -0.5L * decade);
            try_direction(q, base_rad, &best, &at_rad);
            try_direction(q, base_rad + off_rad, &best, &at_rad);
            try_direction(q, base_rad - off_rad, &best, &at_rad);
        }
    for (real step = 0.02L; step > 1e-11L;) {
        const real before = best, middle_rad = at_rad;
        try_direction(q, middle_rad + step, &best, &at_rad);
        try_direction(q, middle_rad - step, &best, &at_rad);
        if (best == before) step *= 0.5L;
    }
    return best;
}

/* ---- the point of a machine ---------------------------------------------------------------------------- */

enum { WAVES = 7, SLOPES = 5 };

typedef struct {
    ref_wave emf[WAVES], cogging[WAVES];
    ref_wave slope[SLOPES][HCI_PHASE_MATRIX];
    hci_wave emf_waves[WAVES];
    hci_harmonic cogging_terms[WAVES];
    hci_inductance_slope slope_terms[SLOPES];
    hci_machine machine;
} drawn_machine;

static ref_wave draw_wave(double order, double shift, double size)
{
    const ref_wave w = {order, shift, size * uniform(0.1, 1.0), uniform(-3.1, 3.1)};
    return w;
}

static void draw_slope_term(drawn_machine *m, int k)
{
    const double order = ref_integer(&seed, 0, 12);
    m->slope_terms[k].order = order;
    for (int q = 0; q < HCI_PHASE_MATRIX; ++q) {
        const ref_wave w = m->slope[k][q] = draw_wave(order, 0.0, 0.1);
        m->slope_terms[k].sine[q] = w.amplitude * cos(w.phase);
        m->slope_terms[k].cosine[q] = w.amplitude * sin(w.phase);
    }
}

static void draw_machine(drawn_machine *m)
{
    for (int k = 0; k < WAVES; ++k) {
        const int sequence = ref_integer(&seed, -1, 1);
        const ref_wave e = m->emf[k] = draw_wave(ref_integer(&seed, 1, 25), sequence, 1.0);
        const ref_wave c = m->cogging[k] = draw_wave(ref_integer(&seed, 0, 50), 0.0, 0.5);
        const hci_wave wave = {e.order, sequence, e.amplitude * cos(e.phase), e.amplitude * sin(e.phase)};
        const hci_harmonic term = {c.order, c.amplitude * cos(c.phase), c.amplitude * sin(c.phase)};
        m->emf_waves[k] = wave;
        m->cogging_terms[k] = term;
    }
    for (int k = 0; k < SLOPES; ++k)
        draw_slope_term(m, k);
    const hci_machine machine = {2, m->emf_waves, WAVES, m->cogging_terms, WAVES, m->slope_terms, SLOPES};
    m->machine = machine;
}

/* L'(θ) as a full matrix from its sine formulas. */
static void phase_matrix_at(const drawn_machine *m, double theta_rad, double l[3][3])
{
    double q[HCI_PHASE_MATRIX] = {0.0};
    for (int k = 0; k < SLOPES; ++k)
        for (int n = 0; n < HCI_PHASE_MATRIX; ++n)
            q[n] += ref_wave_at(&m->slope[k][n], 0, theta_rad);
    for (int s = 0; s < 3; ++s)
        l[s][s] = q[s];
    l[0][1] = l[1][0] = q[HCI_AB];
    l[1][2] = l[2][1] = q[HCI_BC];
    l[2][0] = l[0][2] = q[HCI_CA];
}

/* Row k of the orthonormal Clarke matrix: sqrt(2/3) cos(2πs/3) and sqrt(2/3) sin(2πs/3). */
static double clarke(int k, int s)
{
    return sqrt(2.0 / 3.0) * (k == 0 ? cos(2.0 * REF_PI * s / 3.0) : sin(2.0 * REF_PI * s / 3.0));
}

static double in_plane(double l[3][3], int k, int n)
{
    double sum = 0.0;
    for (int r = 0; r < 3; ++r)
        for (int s = 0; s < 3; ++s)
            sum += clarke(k, r) * l[r][s] * clarke(n, s);
    return sum;
}

static void test_machine_at_is_the_sampled_machine(void)
{
    for (int trial = 0; trial < 400; ++trial) {
        drawn_machine m;
        double l[3][3], e[2] = {0.0, 0.0};
        const double theta_rad = uniform(-10.0, 10.0);
        draw_machine(&m);
        phase_matrix_at(&m, theta_rad, l);
        for (int s = 0; s < 3; ++s)
            for (int k = 0; k < 2; ++k)
                e[k] += clarke(k, s) * ref_waves_at(m.emf, WAVES, s, theta_rad);
        const hci_machine_point p = hci_machine_at(&m.machine, theta_rad);
        /* arguments up to 500 rad have 6e-14 of rounding, of 7 waves of size 1 */
        for (int k = 0; k < 2; ++k)
            TEST_ASSERT_DOUBLE_WITHIN(1e-12, e[k], p.e[k]);
        TEST_ASSERT_DOUBLE_WITHIN(1e-12, in_plane(l, 0, 0), p.slope[0]);
        TEST_ASSERT_DOUBLE_WITHIN(1e-12, in_plane(l, 0, 1), p.slope[1]);
        TEST_ASSERT_DOUBLE_WITHIN(1e-12, in_plane(l, 1, 1), p.slope[2]);
        TEST_ASSERT_DOUBLE_WITHIN(1e-12, ref_waves_at(m.cogging, WAVES, 0, theta_rad), p.cogging_Nm);
    }
}

static void test_machine_at_without_slopes(void)
{
    drawn_machine m;
    draw_machine(&m);
    m.machine.slope_count = 0;
    const hci_machine_point p = hci_machine_at(&m.machine, 0.3);
    for (int k = 0; k < 3; ++k)
        TEST_ASSERT_EQUAL_DOUBLE(0.0, p.slope[k]);
}

/* The plane's torque is that of the three phases, and the way to the phases keeps length and zero sum. */
static void test_torque_in_the_plane_is_torque_of_the_phases(void)
{
    for (int trial = 0; trial < 400; ++trial) {
        drawn_machine m;
        double l[3][3], i[3], back[2], torque = 0.0;
        const double theta_rad = uniform(-10.0, 10.0), x[2] = {uniform(-9.0, 9.0), uniform(-9.0, 9.0)};
        draw_machine(&m);
        phase_matrix_at(&m, theta_rad, l);
        hci_plane_to_abc(x, i);
        hci_plane_from_abc(i, back);
        for (int s = 0; s < 3; ++s) {
            TEST_ASSERT_DOUBLE_WITHIN(1e-14, x[0] * clarke(0, s) + x[1] * clarke(1, s), i[s]);
            torque += i[s] * ref_waves_at(m.emf, WAVES, s, theta_rad);
            for (int r = 0; r < 3; ++r)
                torque += 0.5 * i[r] * l[r][s] * i[s];
        }
        torque += ref_waves_at(m.cogging, WAVES, 0, theta_rad);
        const hci_machine_point p = hci_machine_at(&m.machine, theta_rad);
        TEST_ASSERT_DOUBLE_WITHIN(1e-10, torque,
                                  hci_point_torque_Nm(&p, x)); /* L' within 1e-12, current² 160 */
        for (int k = 0; k < 2; ++k)
            TEST_ASSERT_DOUBLE_WITHIN(1e-14, x[k], back[k]);
    }
}

/* ---- shortest current ---------------------------------------------------------------------------------- */

static double length(const double x[2])
{
    return hypot(x[0], x[1]);
}

static hci_status shortest(const point_case *c, double x[2])
{
    return hci_strategy_current(&c->p, HCI_STRATEGY_MTPA, c->torque_Nm, NULL, x, NULL);
}

static void check_torque(const point_case *c, const double x[2])
{
    const real error = fabsl(torque_of(&c->p, x) - c->torque_Nm);
    /* rounding of τ = T* − T_cog and of the terms of the quadric */
    TEST_ASSERT_TRUE(error <= 1e-14L * torque_size(&c->p, x) + 1e-14L * fabs(c->torque_Nm));
}

/* Whatever stood there before. */
static void test_the_torque_of_cogging_alone_takes_no_current(void)
{
    for (int trial = 0; trial < 300; ++trial) {
        point_case c = draw_case(trial % KINDS);
        double x[2] = {7.0, -9.0};
        c.torque_Nm = c.p.cogging_Nm;
        TEST_ASSERT_EQUAL_INT(HCI_OK, shortest(&c, x));
        TEST_ASSERT_TRUE(x[0] == 0.0 && x[1] == 0.0);
    }
}

static void test_shortest_current_makes_the_torque_and_none_is_shorter(void)
{
    for (int trial = 0; trial < 4000; ++trial) {
        double x[2];
        const point_case c = draw_case(trial % KINDS);
        const problem q = problem_of(&c);
        const real best = best_merit(&q);
        if (shortest(&c, x) == HCI_OK) {
            check_torque(&c, x);
            TEST_ASSERT_TRUE(length(x) * best <=
                             1.0L + 1e-9L); /* the search ends 1e-11 rad from its optimum */
        } else
            TEST_ASSERT_TRUE(best <= 1e-9L);
    }
}

/* x = λ(g + Hx) with 1 − λh >= 0 for both eigenvalues: sufficient for the shortest of all (the dual has no
 * gap). */
static void test_shortest_current_meets_the_global_optimality_condition(void)
{
    int checked = 0;
    for (int trial = 0; trial < 20000; ++trial) {
        double x[2];
        const point_case c = draw_case(trial % KINDS);
        const problem q = problem_of(&c);
        const double *h = c.p.slope, *e = c.p.e;
        const real sign = (real)c.torque_Nm < c.p.cogging_Nm ? -1.0L : 1.0L;
        if (shortest(&c, x) != HCI_OK) continue;
        const real a = sign * (e[0] + (real)h[0] * x[0] + (real)h[1] * x[1]);
        const real b = sign * (e[1] + (real)h[1] * x[0] + (real)h[2] * x[1]);
        const real lambda = (a * x[0] + b * x[1]) / (a * a + b * b);
        const real across = fabsl(a * x[1] - b * x[0]) / hypotl(a, b);
        /* rounding of x, as far as the terms of the gradient are larger than their sum */
        const real terms =
            fabs(e[0]) + fabs(e[1]) + (fabs(h[0]) + 2.0L * fabs(h[1]) + fabs(h[2])) * length(x);
        const real tolerance = 1e-14L * terms / hypotl(a, b);
        if (!(tolerance < 0.01L)) continue; /* L' all but singular: nothing is left of the gradient */
        TEST_ASSERT_TRUE(across <= tolerance * length(x));
        TEST_ASSERT_TRUE(lambda * q.h[0] <= 1.0L + tolerance);
        ++checked;
    }
    TEST_ASSERT_TRUE(checked > 15000);
}

/* The most torque there is: infinite if an eigenvalue is positive or a linear term has none against it, else
 * ½gᵀ(−H)⁻¹g. */
static real most_torque(const problem *q)
{
    real most = 0.0L;
    for (int k = 0; k < 2; ++k) {
        if (q->h[k] > 0.0L || (q->h[k] == 0.0L && q->g[k] != 0.0L)) return HUGE_VAL;
        if (q->h[k] < 0.0L) most -= 0.5L * q->g[k] * q->g[k] / q->h[k];
    }
    return most;
}

static void test_torque_is_not_reached_just_where_none_reaches_it(void)
{
    int reached = 0, refused = 0;
    for (int trial = 0; trial < 20000; ++trial) {
        double x[2];
        const point_case c = draw_case(trial % KINDS);
        const problem q = problem_of(&c);
        const real most = most_torque(&q);
        if (fabsl(most / q.tau - 1.0L) < 1e-9L) continue;
        const hci_status status = shortest(&c, x);
        TEST_ASSERT_EQUAL_INT(most > q.tau ? HCI_OK : HCI_NOT_REACHED, status);
        reached += status == HCI_OK;
        refused += status != HCI_OK;
        if (status == HCI_OK) continue;
        /* then the nearest torque, at its flat top: half the digits of x suffice */
        const real made = fabsl(torque_of(&c.p, x) - c.p.cogging_Nm);
        TEST_ASSERT_TRUE(fabsl(made - most) <= 1e-14L * torque_size(&c.p, x));
    }
    TEST_ASSERT_TRUE(reached > 5000 && refused > 1000);
}

/* τ within some ulp of the most there is: a finite current and the torque, whichever way the answer falls. */
static void test_boundary_of_what_is_reached(void)
{
    for (int trial = 0; trial < 4000; ++trial) {
        point_case c = draw_case(NEGATIVE);
        double x[2];
        const double sign = either_sign();
        for (int k = 0; k < 3; ++k)
            c.p.slope[k] *= sign;
        c.p.cogging_Nm = 0.0;
        c.torque_Nm = sign;
        const problem q = problem_of(&c);
        if (q.g[0] == 0.0L && q.g[1] == 0.0L) continue;
        c.torque_Nm = sign * (double)most_torque(&q) * (1.0 + ref_integer(&seed, -6, 6) * 0.25 * DBL_EPSILON);
        const hci_status status = shortest(&c, x);
        TEST_ASSERT_TRUE(status == HCI_OK || status == HCI_NOT_REACHED);
        TEST_ASSERT_TRUE(fabsl(torque_of(&c.p, x) - c.torque_Nm) <= 4e-15L * torque_size(&c.p, x));
        c.torque_Nm *= 1.0 - 1e-9;
        TEST_ASSERT_EQUAL_INT(HCI_OK, shortest(&c, x));
        check_torque(&c, x);
        c.torque_Nm *= 1.0 + 2e-9;
        TEST_ASSERT_EQUAL_INT(HCI_NOT_REACHED, shortest(&c, x));
    }
    const point_case exact = {
        {{1.0, 0.0}, {-1.0, 0.0, -1.0}, 0.0}, 0.5, NEGATIVE}; /* T = i − i²/2 has ½ at 1 A */
    double x[2];
    TEST_ASSERT_EQUAL_INT(HCI_OK, shortest(&exact, x));
    TEST_ASSERT_EQUAL_DOUBLE(1.0, x[0]);
}

/* Closed forms: g = 0; isotropic L'; g across the leading eigenvector with the torque beyond what the pole
 * gives. */
static void test_hard_cases_by_their_closed_forms(void)
{
    for (int trial = 0; trial < 2000; ++trial) {
        double x[2];
        const double e = uniform(0.1, 3.0), h = uniform(0.1, 3.0), k = uniform(0.1, 3.0),
                     torque = uniform(0.1, 9.0);
        const double e_rad = uniform(-3.0, 3.0);
        const point_case zero = {{{0.0, 0.0}, {h, 0.0, -k}, 0.0}, torque, HARD};
        TEST_ASSERT_EQUAL_INT(HCI_OK, shortest(&zero, x));
        TEST_ASSERT_DOUBLE_WITHIN(1e-14 * length(x), sqrt(2.0 * torque / h), fabs(x[0]));
        TEST_ASSERT_DOUBLE_WITHIN(1e-14 * length(x), 0.0, x[1]);
        const point_case round = {{{e * cos(e_rad), e * sin(e_rad)}, {h, 0.0, h}, 0.0}, torque, HARD};
        const double r = 2.0 * torque / (e + sqrt(e * e + 2.0 * h * torque));
        TEST_ASSERT_EQUAL_INT(HCI_OK, shortest(&round, x));
        TEST_ASSERT_DOUBLE_WITHIN(1e-14 * r, r * cos(e_rad), x[0]);
        TEST_ASSERT_DOUBLE_WITHIN(1e-14 * r, r * sin(e_rad), x[1]);
        /* along the second axis i = λe/(1 + λk) with λ = 1/h, the rest by the first axis alone */
        const double i = e / (h + k), rest = torque - e * i + 0.5 * k * i * i;
        const point_case across = {{{0.0, e}, {h, 0.0, -k}, 0.0}, torque, HARD};
        if (rest < 0.01) continue;
        TEST_ASSERT_EQUAL_INT(HCI_OK, shortest(&across, x));
        TEST_ASSERT_DOUBLE_WITHIN(1e-14 * length(x), i, x[1]);
        TEST_ASSERT_DOUBLE_WITHIN(1e-13 * length(x), sqrt(2.0 * rest / h),
                                  fabs(x[0])); /* rest may lose two digits */
    }
}

/* In the hard case both signs are as good: the one nearer to the answer before is taken. */
static void test_hard_case_keeps_to_the_side_it_was_on(void)
{
    const hci_machine_point p = {{0.0, 1.0}, {2.0, 0.0, -1.0}, 0.0};
    const double plus[2] = {3.0, 0.3}, minus[2] = {-3.0, 0.3};
    double x[2];
    hci_strategy_current(&p, HCI_STRATEGY_MTPA, 8.0, plus, x, NULL);
    TEST_ASSERT_TRUE(x[0] > 2.0);
    hci_strategy_current(&p, HCI_STRATEGY_MTPA, 8.0, minus, x, NULL);
    TEST_ASSERT_TRUE(x[0] < -2.0);
}

/* Without L' the least-copper current of the star connection: (T* − T_cog) e/(e·e). */
static void test_without_reluctance_it_is_the_pointwise_limit(void)
{
    for (int trial = 0; trial < 2000; ++trial) {
        double x[2];
        const point_case c = draw_case(ZERO);
        const real square = (real)c.p.e[0] * c.p.e[0] + (real)c.p.e[1] * c.p.e[1];
        const hci_status status = shortest(&c, x);
        TEST_ASSERT_EQUAL_INT(square > 0.0L ? HCI_OK : HCI_NOT_REACHED, status);
        for (int k = 0; k < 2 && square > 0.0L; ++k) {
            const double expected = (double)(((real)c.torque_Nm - c.p.cogging_Nm) * c.p.e[k] / square);
            TEST_ASSERT_DOUBLE_WITHIN(1e-14 * length(x), expected, x[k]);
        }
    }
}

/* A control calls this in an interrupt: whatever it is given, it must come back. */
static void test_it_returns_whatever_it_is_given(void)
{
    const double odd[9] = {0.0, 1.0, -1.0, 1e200, -1e-200, 5e-324, INFINITY, -INFINITY, NAN};
    for (int trial = 0; trial < 20000; ++trial) {
        point_case c = {{{0.0, 0.0}, {0.0, 0.0, 0.0}, 0.0}, odd[ref_integer(&seed, 0, 8)], HARD};
        double x[2], least_A;
        for (int k = 0; k < 2; ++k)
            c.p.e[k] = odd[ref_integer(&seed, 0, 8)];
        for (int k = 0; k < 3; ++k)
            c.p.slope[k] = odd[ref_integer(&seed, 0, 8)];
        const hci_status status = hci_strategy_current(&c.p, (hci_strategy)(trial % 3), c.torque_Nm,
                                                       trial % 2 ? c.p.e : NULL, x, &least_A);
        TEST_ASSERT_TRUE(status == HCI_OK || status == HCI_NOT_REACHED);
    }
}

/* ---- laws ---------------------------------------------------------------------------------------------- */

static point_case turned(const point_case *c, double angle_rad)
{
    const double k = cos(angle_rad), s = sin(angle_rad);
    const double *h = c->p.slope, *e = c->p.e;
    const point_case t = {
        {{k * e[0] - s * e[1], s * e[0] + k * e[1]},
         {k * k * h[0] - 2.0 * k * s * h[1] + s * s * h[2], k * s * (h[0] - h[2]) + (k * k - s * s) * h[1],
          s * s * h[0] + 2.0 * k * s * h[1] + k * k * h[2]},
         c->p.cogging_Nm},
        c->torque_Nm,
        c->kind};
    return t;
}

/* Kinds whose answer does not hang on the last digits of L' or on a tie, with a back-EMF of its size. */
static point_case draw_plain_case(int kind)
{
    const int kinds[4] = {ZERO, INDEFINITE, POSITIVE, FAINT};
    for (;;) {
        const point_case c = draw_case(kinds[kind % 4]);
        const problem q = problem_of(&c);
        if (fabsl(q.g[0]) * fabsl(q.g[0]) > 1e-6L * fabsl(q.h[0]) * q.tau && q.g[1] != 0.0L) return c;
    }
}

static hci_status current(const point_case *c, int strategy, double x[2])
{
    return hci_strategy_current(&c->p, (hci_strategy)strategy, c->torque_Nm, NULL, x, NULL);
}

static void test_scaling_turning_and_signs(void)
{
    for (int trial = 0; trial < 12000; ++trial) {
        const int strategy = trial % 3;
        const point_case c = draw_plain_case(trial / 3);
        const double t = fabs(draw_size(3.0)), i = fabs(draw_size(3.0)), angle_rad = uniform(-4.0, 4.0);
        const point_case larger = scaled(&c, t, i), other = turned(&c, angle_rad);
        point_case flipped = c, mirrored = c;
        double x[2], y[2], limit;
        const hci_status status = current(&c, strategy, x);
        if (status != HCI_OK) continue; /* all else would hang on rounding for half of them */
        limit = 1e-9 * length(x);       /* near-ties of the draw amplify the rounding of scales and turns */
        if (current(&larger, strategy, y) == HCI_OK)
            for (int k = 0; k < 2; ++k)
                TEST_ASSERT_DOUBLE_WITHIN(limit * i, i * x[k], y[k]);
        if (current(&other, strategy, y) == HCI_OK) {
            TEST_ASSERT_DOUBLE_WITHIN(limit, x[0] * cos(angle_rad) - x[1] * sin(angle_rad), y[0]);
            TEST_ASSERT_DOUBLE_WITHIN(limit, x[0] * sin(angle_rad) + x[1] * cos(angle_rad), y[1]);
        }
        for (int k = 0; k < 2; ++k)
            flipped.p.e[k] = -c.p.e[k]; /* T(−i) */
        TEST_ASSERT_EQUAL_INT(status, current(&flipped, strategy, y));
        for (int k = 0; k < 2; ++k)
            TEST_ASSERT_DOUBLE_WITHIN(1e-13 * length(x), -x[k], y[k]);
        mirrored = scaled(&c, -1.0, 1.0); /* −T(i) */
        TEST_ASSERT_EQUAL_INT(status, current(&mirrored, strategy, y));
        for (int k = 0; k < 2; ++k)
            TEST_ASSERT_DOUBLE_WITHIN(1e-13 * length(x), x[k], y[k]);
    }
}

/* ---- i_d = 0 and i_d that cancels ---------------------------------------------------------------------- */

/* (d, q) of the orthonormal plane: q along e. L' there, by long double. */
typedef struct {
    real e, q[2], slope_d, slope_dq, slope_q, iq;
} axes;

static axes axes_of(const point_case *c)
{
    const real e = hypotl(c->p.e[0], c->p.e[1]), qa = c->p.e[0] / e, qb = c->p.e[1] / e;
    const real aa = c->p.slope[0], ab = c->p.slope[1], bb = c->p.slope[2];
    const axes a = {e,
                    {qa, qb},
                    qb * (aa * qb - ab * qa) - qa * (ab * qb - bb * qa),
                    qb * (aa * qa + ab * qb) - qa * (ab * qa + bb * qb),
                    qa * (aa * qa + ab * qb) + qb * (ab * qa + bb * qb),
                    c->torque_Nm / e};
    return a;
}

static real d_of(const axes *a, const double x[2])
{
    return a->q[1] * x[0] - a->q[0] * x[1];
}

static real q_of(const axes *a, const double x[2])
{
    return a->q[0] * x[0] + a->q[1] * x[1];
}

static void test_id0_leaves_reluctance_and_cogging(void)
{
    for (int trial = 0; trial < 4000; ++trial) {
        double x[2];
        const point_case c = draw_case(trial % KINDS);
        const hci_status status = current(&c, HCI_STRATEGY_ID0, x);
        if (c.p.e[0] == 0.0 && c.p.e[1] == 0.0) {
            TEST_ASSERT_EQUAL_INT(HCI_NOT_REACHED, status);
            continue;
        }
        const axes a = axes_of(&c);
        const real torque = c.torque_Nm + 0.5L * a.slope_q * a.iq * a.iq + c.p.cogging_Nm;
        TEST_ASSERT_EQUAL_INT(HCI_OK, status);
        TEST_ASSERT_TRUE(fabsl(d_of(&a, x)) <= 4e-16L * length(x));
        TEST_ASSERT_TRUE(fabsl(q_of(&a, x) - a.iq) <= 1e-15L * length(x));
        TEST_ASSERT_TRUE(fabsl(torque_of(&c.p, x) - torque) <= 1e-14L * torque_size(&c.p, x));
    }
}

/* Both roots of L'_d i_d² + 2M' i_q i_d + (L'_q i_q² + 2 T_cog) = 0, the shorter first, without cancellation;
 * their number. */
static int roots_of(const axes *a, real cogging_Nm, real id[2])
{
    const real b = a->slope_dq * a->iq, c = a->slope_q * a->iq * a->iq + 2.0L * cogging_Nm;
    const real square = b * b - a->slope_d * c;
    if (square < 0.0L) return 0;
    const real outer = b > 0.0L ? -b - sqrtl(square) : sqrtl(square) - b;
    id[0] = outer == 0.0L ? 0.0L : c / outer;
    id[1] = outer / a->slope_d;
    return 2;
}

static void test_cancel_takes_the_shorter_root_just_where_there_is_one(void)
{
    int found = 0, refused = 0;
    for (int trial = 0; trial < 20000; ++trial) {
        double x[2];
        real id[2] = {0.0L, 0.0L};
        const point_case c = draw_case(INDEFINITE + trial % 3);
        if (c.p.e[0] == 0.0 && c.p.e[1] == 0.0) continue;
        const axes a = axes_of(&c);
        const hci_status status = current(&c, HCI_STRATEGY_CANCEL, x);
        const real b = a.slope_dq * a.iq, k = a.slope_q * a.iq * a.iq + 2.0L * c.p.cogging_Nm;
        const real scale =
            b * b + fabsl(a.slope_d * a.slope_q) * a.iq * a.iq + fabsl(2.0L * a.slope_d * c.p.cogging_Nm);
        if (fabsl(b * b - a.slope_d * k) < 1e-9L * scale) continue; /* a double root */
        TEST_ASSERT_EQUAL_INT(roots_of(&a, c.p.cogging_Nm, id) ? HCI_OK : HCI_NOT_REACHED, status);
        TEST_ASSERT_TRUE(fabsl(q_of(&a, x) - a.iq) <= 1e-15L * length(x));
        found += status == HCI_OK;
        refused += status != HCI_OK;
        if (status != HCI_OK) continue;
        const double sizes[2] = {length(x), length(x)}; /* rounding of x is that of its length */
        TEST_ASSERT_TRUE(fabsl(torque_of(&c.p, x) - c.torque_Nm) <= 1e-14L * torque_size(&c.p, sizes));
        /* a tie is decided by rounding; the discriminant has lost up to nine digits */
        const real clear = fabsl(id[1]) > (1.0L + 1e-6L) * fabsl(id[0]) ? d_of(&a, x) - id[0]
                                                                        : fabsl(d_of(&a, x)) - fabsl(id[0]);
        TEST_ASSERT_TRUE(fabsl(clear) <= 1e-6L * length(x));
    }
    TEST_ASSERT_TRUE(found > 5000 && refused > 2000);
}

/* Where both roots are equally long the one nearer to the answer before is taken; a far shorter one is taken
 * anyway. */
static void test_cancel_stays_near_the_answer_before(void)
{
    const hci_machine_point tie = {{0.0, 1.0}, {2.0, 0.0, 0.0}, -1.0}; /* i_d² = 1, d axis (1, 0) */
    const hci_machine_point clear = {{0.0, 1.0}, {2.0, 3.0, 0.0}, -1.0};
    const double plus[2] = {0.7, 1.0}, minus[2] = {-0.7, 1.0}, far[2] = {-4.0, 1.0};
    double x[2];
    TEST_ASSERT_EQUAL_INT(HCI_OK, hci_strategy_current(&tie, HCI_STRATEGY_CANCEL, 1.0, plus, x, NULL));
    TEST_ASSERT_DOUBLE_WITHIN(1e-15, 1.0, x[0]);
    TEST_ASSERT_EQUAL_INT(HCI_OK, hci_strategy_current(&tie, HCI_STRATEGY_CANCEL, 1.0, minus, x, NULL));
    TEST_ASSERT_DOUBLE_WITHIN(1e-15, -1.0, x[0]);
    TEST_ASSERT_EQUAL_INT(HCI_OK, hci_strategy_current(&clear, HCI_STRATEGY_CANCEL, 1.0, far, x, NULL));
    TEST_ASSERT_DOUBLE_WITHIN(1e-14, 0.5 * (sqrt(13.0) - 3.0), x[0]);
}

/* e along q = (0, 1): slope[0] is L'_d, slope[1] is M', slope[2] is L'_q. */
static void test_cancel_where_l_d_vanishes(void)
{
    for (int trial = 0; trial < 2000; ++trial) {
        const double m = uniform(0.5, 2.0) * either_sign(), q = uniform(-2.0, 2.0),
                     cogging_Nm = uniform(-1.0, 1.0);
        const double iq = uniform(1.0, 3.0) * either_sign(),
                     id = -(0.5 * q * iq * iq + cogging_Nm) / (m * iq);
        for (int decade = 6; decade <= 18; decade += 4) {
            const double d = decade == 18 ? 0.0 : either_sign() * pow(10.0, -decade);
            const hci_machine_point p = {{0.0, 1.0}, {d, m, q}, cogging_Nm};
            double x[2];
            TEST_ASSERT_EQUAL_INT(HCI_OK, hci_strategy_current(&p, HCI_STRATEGY_CANCEL, iq, NULL, x, NULL));
            /* next term of the root: −½ L'_d i_d²/(M' i_q), with |i_d| < 20 */
            TEST_ASSERT_DOUBLE_WITHIN(1e-14 * fabs(id) + 1000.0 * fabs(d), id, x[0]);
        }
    }
}

static hci_status cancel_at(const hci_machine_point *p, double torque_Nm)
{
    double x[2];
    return hci_strategy_current(p, HCI_STRATEGY_CANCEL, torque_Nm, NULL, x, NULL);
}

/* i_q² (M'² − L'_d L'_q) >= 2 L'_d T_cog: from some i_q on, at every i_q, or not from any on. */
static void test_least_iq_is_the_threshold(void)
{
    int count[3] = {0, 0, 0};
    for (int trial = 0; trial < 6000; ++trial) {
        const double d = uniform(-2.0, 2.0), m = uniform(-2.0, 2.0), q = uniform(-2.0, 2.0);
        const double cogging_Nm = uniform(-1.0, 1.0), growth = m * m - d * q, needed = 2.0 * d * cogging_Nm;
        const hci_machine_point p = {{0.0, 2.0}, {d, m, q}, cogging_Nm};
        double x[2], least_A;
        if (fabs(growth) < 1e-3 || fabs(needed) < 1e-3) continue;
        hci_strategy_current(&p, HCI_STRATEGY_CANCEL, 1.0, NULL, x, &least_A);
        if (growth < 0.0) {
            TEST_ASSERT_TRUE(isinf(least_A));
            TEST_ASSERT_EQUAL_INT(HCI_NOT_REACHED, cancel_at(&p, 1e4));
        } else if (needed < 0.0) {
            TEST_ASSERT_EQUAL_DOUBLE(0.0, least_A);
            TEST_ASSERT_EQUAL_INT(HCI_OK, cancel_at(&p, uniform(-1.0, 1.0)));
        } else {
            TEST_ASSERT_DOUBLE_WITHIN(1e-10 * least_A, sqrt(needed / growth), least_A);
            TEST_ASSERT_EQUAL_INT(HCI_OK, cancel_at(&p, 2.0 * least_A * (1.0 + 1e-9)));
            TEST_ASSERT_EQUAL_INT(HCI_NOT_REACHED, cancel_at(&p, -2.0 * least_A * (1.0 - 1e-9)));
        }
        ++count[growth < 0.0 ? 0 : needed < 0.0 ? 1 : 2];
    }
    TEST_ASSERT_TRUE(count[0] > 500 && count[1] > 500 && count[2] > 500);
}

/* Only L'_d: M'² = L'_d L'_q, and a cogging torque that i_d can take away at every i_q, or at none. */
static void test_least_iq_of_one_slope(void)
{
    for (int sign = -1; sign <= 1; ++sign) {
        const hci_machine_point p = {{0.0, 2.0}, {0.5, 0.0, 0.0}, 0.1 * sign};
        double x[2], least_A;
        const hci_status status = hci_strategy_current(&p, HCI_STRATEGY_CANCEL, 1.0, NULL, x, &least_A);
        TEST_ASSERT_EQUAL_INT(sign > 0 ? HCI_NOT_REACHED : HCI_OK, status);
        TEST_ASSERT_EQUAL_DOUBLE(sign > 0 ? HUGE_VAL : 0.0, least_A);
    }
}

/* No back-EMF along the eigenvector u of the one slope h: i = ±√(2(τ − e²/h)/h) u + e/h v, of the sign of
 * what went before, whichever way u points. */
static void test_either_way_along_the_axis_the_nearer(void)
{
    const double e = 0.1, h = 0.5, along_A = sqrt(2.0 * (2.0 - e * e / h) / h);
    for (int k = 0; k < 24; ++k) {
        const double u[2] = {cos(0.2 + REF_PI * (k / 2) / 6.0), sin(0.2 + REF_PI * (k / 2) / 6.0)},
                     side = k % 2 ? -1.0 : 1.0;
        const hci_machine_point p = {
            {-e * u[1], e * u[0]}, {h * u[0] * u[0], h * u[0] * u[1], h * u[1] * u[1]}, 0.0};
        const double previous[2] = {0.5 * side * u[0] - 3.0 * u[1], 0.5 * side * u[1] + 3.0 * u[0]};
        double x[2];
        TEST_ASSERT_EQUAL_INT(HCI_OK, hci_strategy_current(&p, HCI_STRATEGY_MTPA, 2.0, previous, x, NULL));
        TEST_ASSERT_DOUBLE_WITHIN(1e-7, side * along_A, x[0] * u[0] + x[1] * u[1]);
        TEST_ASSERT_DOUBLE_WITHIN(1e-7, e / h, x[1] * u[0] - x[0] * u[1]);
    }
}

/* Where nothing makes a torque no current flows. */
static void test_no_machine_no_current(void)
{
    static const hci_strategy ALL[] = {HCI_STRATEGY_ID0, HCI_STRATEGY_CANCEL, HCI_STRATEGY_MTPA};
    const hci_machine_point p = {{0.0, 0.0}, {0.0, 0.0, 0.0}, 0.0};
    for (int k = 0; k < 3; ++k) {
        double x[2] = {7.0, 7.0};
        TEST_ASSERT_EQUAL_INT(HCI_NOT_REACHED, hci_strategy_current(&p, ALL[k], 1.0, NULL, x, NULL));
        TEST_ASSERT_TRUE(x[0] == 0.0 && x[1] == 0.0);
    }
}

/* Slopes along the back-EMF alone, with the least torque at 1 − e²/2h: none of 0, though rounding leaves a
 * back-EMF of 1e-16 beside it, where nothing bounds the current. */
static void test_rounding_beside_the_back_emf_makes_no_torque(void)
{
    const double e = -2.541259765625, h = 3.41943359375;
    const hci_machine_point p = {{e, e}, {h, h, h}, 1.0};
    double x[2];
    TEST_ASSERT_EQUAL_INT(HCI_NOT_REACHED, hci_strategy_current(&p, HCI_STRATEGY_MTPA, 0.0, NULL, x, NULL));
    TEST_ASSERT_DOUBLE_WITHIN(1e-14, -0.5 * e / h, x[0]);
    TEST_ASSERT_DOUBLE_WITHIN(1e-14, -0.5 * e / h, x[1]);
}

/* Without reluctance no i_d cancels any cogging, however large i_q. */
static void test_cancel_without_reluctance(void)
{
    hci_machine_point p = {{0.3, 0.4}, {0.0, 0.0, 0.0}, 0.0};
    double x[2], least_A;
    TEST_ASSERT_EQUAL_INT(HCI_OK, hci_strategy_current(&p, HCI_STRATEGY_CANCEL, 2.0, NULL, x, &least_A));
    TEST_ASSERT_EQUAL_DOUBLE(0.0, least_A);
    TEST_ASSERT_DOUBLE_WITHIN(1e-14, 4.0 * 0.6, x[0]);
    p.cogging_Nm = 0.1;
    TEST_ASSERT_EQUAL_INT(HCI_NOT_REACHED,
                          hci_strategy_current(&p, HCI_STRATEGY_CANCEL, 2.0, NULL, x, &least_A));
    TEST_ASSERT_TRUE(isinf(least_A));
    TEST_ASSERT_DOUBLE_WITHIN(1e-14, 4.0 * 0.8, x[1]);
}

/* Without back-EMF there is no q axis: no current, and the cogging torque is all there is. */
static void test_strategies_without_back_emf(void)
{
    hci_machine_point p = {{0.0, 0.0}, {1.0, 0.5, -1.0}, 0.2};
    double x[2];
    TEST_ASSERT_EQUAL_INT(HCI_NOT_REACHED, hci_strategy_current(&p, HCI_STRATEGY_ID0, 1.0, NULL, x, NULL));
    TEST_ASSERT_TRUE(x[0] == 0.0 && x[1] == 0.0);
    TEST_ASSERT_EQUAL_INT(HCI_OK, hci_strategy_current(&p, HCI_STRATEGY_ID0, 0.0, NULL, x, NULL));
    TEST_ASSERT_EQUAL_INT(HCI_NOT_REACHED, hci_strategy_current(&p, HCI_STRATEGY_CANCEL, 0.0, NULL, x, NULL));
    TEST_ASSERT_EQUAL_INT(HCI_OK, hci_strategy_current(&p, HCI_STRATEGY_CANCEL, 0.2, NULL, x, NULL));
    TEST_ASSERT_EQUAL_INT(HCI_OK, hci_strategy_current(&p, HCI_STRATEGY_MTPA, 0.2, NULL, x, NULL));
    TEST_ASSERT_TRUE(x[0] == 0.0 && x[1] == 0.0);
    /* no i_q is needed where there is no cogging torque, and none is enough where there is */
    double least_A[2];
    for (int k = 0; k < 2; ++k) {
        p.cogging_Nm = 0.2 * k;
        hci_strategy_current(&p, HCI_STRATEGY_CANCEL, 0.0, NULL, x, &least_A[k]);
    }
    TEST_ASSERT_EQUAL_DOUBLE(0.0, least_A[0]);
    TEST_ASSERT_EQUAL_DOUBLE(HUGE_VAL, least_A[1]);
}

static void test_shortest_current_is_never_longer_than_cancel(void)
{
    int compared = 0;
    for (int trial = 0; trial < 20000; ++trial) {
        double x[2], y[2];
        const point_case c = draw_case(trial % KINDS);
        if (current(&c, HCI_STRATEGY_CANCEL, y) != HCI_OK) continue;
        if (fabsl(torque_of(&c.p, y) - c.torque_Nm) > 1e-12L * fabs(c.torque_Nm))
            continue; /* cancel beyond its digits */
        TEST_ASSERT_EQUAL_INT(HCI_OK, shortest(&c, x));
        TEST_ASSERT_TRUE(length(x) <= length(y) * (1.0 + 1e-11));
        ++compared;
    }
    TEST_ASSERT_TRUE(compared > 5000);
}

/* ---- accuracy and speed -------------------------------------------------------------------------------- */

/* Length of the shortest current by bisection of the dual in long double, for machines as they are. */
static real length_by_bisection(const problem *q, real x[2])
{
    real low = 0.0L,
         high = q->h[0] > 0.0L ? 1.0L / q->h[0] : 1e6L * q->tau / (q->g[0] * q->g[0] + q->g[1] * q->g[1]);
    for (int step = 0; step < 200; ++step) {
        const real lambda = 0.5L * (low + high);
        real torque = 0.0L;
        for (int k = 0; k < 2; ++k) {
            x[k] = lambda * q->g[k] / (1.0L - lambda * q->h[k]);
            torque += q->g[k] * x[k] + 0.5L * q->h[k] * x[k] * x[k];
        }
        if (torque > q->tau)
            high = lambda;
        else
            low = lambda;
    }
    return hypotl(x[0], x[1]);
}

/* e about 1, reluctance up to five times the mutual torque; also in the eigenvectors of L', where it is the
 * vector. */
static point_case draw_machine_like(void)
{
    const double e_rad = uniform(-4.0, 4.0), e = uniform(0.5, 2.0);
    point_case c = {{{e * cos(e_rad), e * sin(e_rad)}, {0.0, 0.0, 0.0}, uniform(-0.5, 0.5)}, 0.0, INDEFINITE};
    set_slope(c.p.slope, uniform(0.01, 0.5), uniform(-0.5, 0.5), uniform(-4.0, 4.0));
    c.torque_Nm = uniform(1.0, 20.0);
    return scaled(&c, either_sign(), 1.0);
}

static void test_accuracy_against_long_double(void)
{
    if (LDBL_MANT_DIG <= DBL_MANT_DIG) TEST_IGNORE_MESSAGE("long double is double here");
    double worst_length = 0.0, worst_vector = 0.0;
    for (int trial = 0; trial < 4000; ++trial) {
        const point_case c = draw_machine_like();
        const problem q = problem_of(&c);
        const real angle_rad = q.axis_rad;
        real y[2];
        double x[2];
        const real expected = length_by_bisection(&q, y);
        TEST_ASSERT_EQUAL_INT(HCI_OK, shortest(&c, x));
        const real along = cosl(angle_rad) * x[0] + sinl(angle_rad) * x[1],
                   across = cosl(angle_rad) * x[1] - sinl(angle_rad) * x[0];
        worst_length = fmax(worst_length, (double)fabsl(length(x) / expected - 1.0L));
        worst_vector = fmax(worst_vector, (double)(hypotl(along - y[0], across - y[1]) / expected));
    }
    printf("shortest current of 4000 machine-like points: length within %.1e, vector within %.1e\n",
           worst_length, worst_vector);
    TEST_ASSERT_TRUE(worst_length < 1e-14);
    TEST_ASSERT_TRUE(worst_vector <
                     1e-11); /* near a tie of both sides the direction is worse conditioned than the length */
}

static void test_speed_is_told(void)
{
    enum { POINTS = 2000, ROUNDS = 20 };
    static point_case cases[POINTS];
    static const char *const names[3] = {
        [HCI_STRATEGY_ID0] = "id0", [HCI_STRATEGY_CANCEL] = "cancel", [HCI_STRATEGY_MTPA] = "mtpa"};
    double sum = 0.0;
    for (int k = 0; k < POINTS; ++k)
        cases[k] = draw_machine_like();
    for (int strategy = 0; strategy < 3; ++strategy) {
        const clock_t start = clock();
        for (int k = 0; k < POINTS * ROUNDS; ++k) {
            double x[2];
            current(&cases[k % POINTS], strategy, x);
            sum += x[0];
        }
        printf("%s: %.0f ns a call\n", names[strategy],
               1e9 * (double)(clock() - start) / CLOCKS_PER_SEC / (POINTS * ROUNDS));
    }
    TEST_ASSERT_FALSE(isnan(sum));
}

/* ---- machine C over a turn ----------------------------------------------------------------------------- */

#define MACHINE_C "data/machine_c/"

enum { POSITIONS = 180, ORDERS = 64, POLE_PAIRS = 2, STEPS = 720 };

typedef struct {
    hci_wave emf[ORDERS];
    hci_harmonic cogging[ORDERS];
    hci_inductance_slope slope[POSITIONS / 2];
    hci_machine machine;
} table_machine;

/* Rows of `columns` numbers; comments and the row of names are passed over. The number of rows. */
static int read_rows(const char *path, int columns, double *rows, int most)
{
    char line[256];
    int count = 0;
    FILE *file = fopen(path, "r");
    TEST_ASSERT_NOT_NULL_MESSAGE(file, path);
    while (count < most && fgets(line, sizeof line, file) != NULL) {
        char *at = line;
        if (strchr("0123456789", line[0]) == NULL) continue;
        for (int k = 0; k < columns; ++k, ++at)
            rows[count * columns + k] = strtod(at, &at);
        ++count;
    }
    fclose(file);
    return count;
}

/* dL/dθ_m = p dL/dθ of L = Σ S sin(mθ) + C cos(mθ) through the positions, m up to `highest`. */
static void set_slope_terms(table_machine *m, double rows[POSITIONS][7], int highest)
{
    for (int n = 1; n <= highest; ++n) {
        hci_inductance_slope *term = &m->slope[n - 1];
        term->order = n;
        for (int q = 0; q < HCI_PHASE_MATRIX; ++q) {
            double s = 0.0, c = 0.0;
            for (int j = 0; j < POSITIONS; ++j) {
                s += 2.0 / POSITIONS * rows[j][q + 1] * sin(2.0 * REF_PI * (n * j % POSITIONS) / POSITIONS);
                c += 2.0 / POSITIONS * rows[j][q + 1] * cos(2.0 * REF_PI * (n * j % POSITIONS) / POSITIONS);
            }
            term->sine[q] = -POLE_PAIRS * n * c;
            term->cosine[q] = POLE_PAIRS * n * s;
        }
    }
}

static void read_table_machine(table_machine *m, int highest)
{
    static double inductance[POSITIONS][7];
    double emf[ORDERS][3], cogging[ORDERS][3];
    const int emf_count = read_rows(MACHINE_C "back_emf.csv", 3, emf[0], ORDERS);
    const int cogging_count = read_rows(MACHINE_C "cogging.csv", 3, cogging[0], ORDERS);
    TEST_ASSERT_EQUAL_INT(POSITIONS, read_rows(MACHINE_C "inductance.csv", 7, inductance[0], POSITIONS));
    TEST_ASSERT_TRUE(emf_count > 10 && cogging_count == 5);
    for (int k = 0; k < emf_count; ++k) {
        const int rest = (int)emf[k][0] % 3;
        const hci_wave w = {emf[k][0], rest == 2 ? -1 : rest, emf[k][1] * cos(emf[k][2]),
                            emf[k][1] * sin(emf[k][2])};
        m->emf[k] = w;
    }
    for (int k = 0; k < cogging_count; ++k) {
        const hci_harmonic h = {cogging[k][0], cogging[k][1] * cos(cogging[k][2]),
                                cogging[k][1] * sin(cogging[k][2])};
        m->cogging[k] = h;
    }
    set_slope_terms(m, inductance, highest);
    const hci_machine machine = {
        POLE_PAIRS, m->emf, (size_t)emf_count, m->cogging, (size_t)cogging_count, m->slope, (size_t)highest};
    m->machine = machine;
}

/* What a strategy does over a turn at 8 N·m. */
typedef struct {
    double ripple_percent, rms_A, most_A, jump_A, least_iq_A; /* |i| in the orthonormal plane */
    int refused;
} turn_figures;

static turn_figures run_turn(const hci_machine *machine, hci_strategy strategy, int steps, double lengths_A[])
{
    turn_figures f = {0.0, 0.0, 0.0, 0.0, 0.0, 0};
    double low = 1e9, high = -1e9, sum = 0.0, square = 0.0, previous[2];
    for (int j = 0; j <= steps; ++j) {
        const hci_machine_point p = hci_machine_at(machine, 2.0 * REF_PI * j / steps);
        double x[2], least_A;
        f.refused += hci_strategy_current(&p, strategy, 8.0, j ? previous : NULL, x, &least_A) != HCI_OK;
        if (j) f.jump_A = fmax(f.jump_A, hypot(x[0] - previous[0], x[1] - previous[1]));
        memcpy(previous, x, sizeof x);
        if (j == steps) break;
        const double torque_Nm = hci_point_torque_Nm(&p, x);
        lengths_A[j] = length(x);
        low = fmin(low, torque_Nm);
        high = fmax(high, torque_Nm);
        sum += torque_Nm;
        square += lengths_A[j] * lengths_A[j];
        f.most_A = fmax(f.most_A, lengths_A[j]);
        f.least_iq_A = fmax(f.least_iq_A, least_A);
    }
    f.ripple_percent = 100.0 * (high - low) / (sum / steps);
    f.rms_A = sqrt(square / steps);
    return f;
}

static void test_machine_c_over_a_turn(void)
{
    static const char *const names[3] = {
        [HCI_STRATEGY_ID0] = "id0", [HCI_STRATEGY_CANCEL] = "cancel", [HCI_STRATEGY_MTPA] = "mtpa"};
    static table_machine m;
    static double lengths_A[3][2 * STEPS];
    turn_figures f[3];
    read_table_machine(&m, POSITIONS / 2 - 1);
    printf("machine C at 8 N·m   T_ripple %%   rms A   most A   largest step A\n");
    for (int s = 0; s < 3; ++s) {
        f[s] = run_turn(&m.machine, (hci_strategy)s, STEPS, lengths_A[s]);
        printf("%-19s %10.4f %8.4f %8.4f %10.4f   refused at %d of %d, least i_q %.3f A\n", names[s],
               f[s].ripple_percent, f[s].rms_A, f[s].most_A, f[s].jump_A, f[s].refused, STEPS + 1,
               f[s].least_iq_A);
    }
    TEST_ASSERT_TRUE(f[HCI_STRATEGY_MTPA].rms_A <
                     0.93 * f[HCI_STRATEGY_CANCEL].rms_A); /* reluctance torque is used */
    for (int s = 0; s < 3; ++s) {
        if (s == HCI_STRATEGY_ID0) continue;
        TEST_ASSERT_EQUAL_INT(0, f[s].refused);
        TEST_ASSERT_TRUE(f[s].ripple_percent < 1e-11);
    }
    for (int j = 0; j < STEPS; ++j)
        TEST_ASSERT_TRUE(lengths_A[HCI_STRATEGY_MTPA][j] <=
                         lengths_A[HCI_STRATEGY_CANCEL][j] * (1.0 + 1e-14));
    /* At the table's own positions 35.7 %, where the paper has 34.79 % of its machine; 37.3 % between them.
     */
    const turn_figures coarse = run_turn(&m.machine, HCI_STRATEGY_ID0, POSITIONS, lengths_A[0]);
    TEST_ASSERT_DOUBLE_WITHIN(0.05, 35.72, coarse.ripple_percent);
    TEST_ASSERT_DOUBLE_WITHIN(0.05, 37.32, f[HCI_STRATEGY_ID0].ripple_percent);
    /* continuous along θ: half the step, half the change */
    const turn_figures fine = run_turn(&m.machine, HCI_STRATEGY_MTPA, 2 * STEPS, lengths_A[0]);
    TEST_ASSERT_DOUBLE_WITHIN(0.1, 0.5, fine.jump_A / f[HCI_STRATEGY_MTPA].jump_A);
}

/* No back-EMF along the axis of the larger slope: two currents that mirror each other there make the torque,
 * and the one nearer to what went before is taken. */
static void test_of_two_mirrored_currents_the_nearer(void)
{
    for (int k = 0; k < 2000; ++k) {
        const double angle = 0.5 * REF_PI * (double)(k % 4), u[2] = {round(cos(angle)), round(sin(angle))};
        const double large = uniform(1.0, 3.0), small = uniform(-1.0, 0.5), e = uniform(0.1, 0.5);
        const hci_machine_point p = {
            {-e * u[1], e * u[0]},
            {large * u[0] * u[0] + small * u[1] * u[1], 0.0, large * u[1] * u[1] + small * u[0] * u[0]},
            0.0};
        const double before[2] = {uniform(-5.0, 5.0), uniform(-5.0, 5.0)};
        double x[2];
        TEST_ASSERT_EQUAL(HCI_OK, hci_strategy_current(&p, HCI_STRATEGY_MTPA, 20.0, before, x, NULL));
        const double along = x[0] * u[0] + x[1] * u[1];
        const double mirror[2] = {x[0] - 2.0 * along * u[0], x[1] - 2.0 * along * u[1]};
        TEST_ASSERT_DOUBLE_WITHIN(1e-9, 20.0, hci_point_torque_Nm(&p, x));
        TEST_ASSERT_DOUBLE_WITHIN(1e-9, 20.0, hci_point_torque_Nm(&p, mirror));
        TEST_ASSERT_TRUE(fabs(along) > 1.0 && hypot(x[0] - before[0], x[1] - before[1]) <=
                                                  hypot(mirror[0] - before[0], mirror[1] - before[1]));
    }
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_machine_at_is_the_sampled_machine);
    RUN_TEST(test_machine_at_without_slopes);
    RUN_TEST(test_torque_in_the_plane_is_torque_of_the_phases);
    RUN_TEST(test_the_torque_of_cogging_alone_takes_no_current);
    RUN_TEST(test_shortest_current_makes_the_torque_and_none_is_shorter);
    RUN_TEST(test_shortest_current_meets_the_global_optimality_condition);
    RUN_TEST(test_torque_is_not_reached_just_where_none_reaches_it);
    RUN_TEST(test_boundary_of_what_is_reached);
    RUN_TEST(test_hard_cases_by_their_closed_forms);
    RUN_TEST(test_hard_case_keeps_to_the_side_it_was_on);
    RUN_TEST(test_without_reluctance_it_is_the_pointwise_limit);
    RUN_TEST(test_it_returns_whatever_it_is_given);
    RUN_TEST(test_scaling_turning_and_signs);
    RUN_TEST(test_id0_leaves_reluctance_and_cogging);
    RUN_TEST(test_cancel_takes_the_shorter_root_just_where_there_is_one);
    RUN_TEST(test_cancel_stays_near_the_answer_before);
    RUN_TEST(test_cancel_where_l_d_vanishes);
    RUN_TEST(test_least_iq_is_the_threshold);
    RUN_TEST(test_rounding_beside_the_back_emf_makes_no_torque);
    RUN_TEST(test_cancel_without_reluctance);
    RUN_TEST(test_strategies_without_back_emf);
    RUN_TEST(test_of_two_mirrored_currents_the_nearer);
    RUN_TEST(test_shortest_current_is_never_longer_than_cancel);
    RUN_TEST(test_accuracy_against_long_double);
    RUN_TEST(test_speed_is_told);
    RUN_TEST(test_machine_c_over_a_turn);
    RUN_TEST(test_either_way_along_the_axis_the_nearer);
    RUN_TEST(test_no_machine_no_current);
    RUN_TEST(test_least_iq_of_one_slope);
    return UNITY_END();
}
