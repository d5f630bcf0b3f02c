/* Effects in the plant: energy. In the plant an effect is e, L, T_cog and shaft torque at a point; here what
 * they take in electrically and give mechanically is added up. */
#include "support/effect_list.h"
#include "support/plant_machine.h"
#include "unity.h"

static el_machine m;

void setUp(void)
{
    el_machine_make(&m);
}

void tearDown(void)
{
}

typedef struct {
    const char *effect, *parameter;
    double order, value;
    int degree; /* of the co-energy in the current: W_field = (degree − 1) W' */
} type_case;

static const type_case TYPES[] = {
    {"cogging", "cosine", 18.0, 0.3, 0},
    {"cogging", "sine", 1.0 / 3.0, 0.3, 0},
    {"mechanical_order", "sine", 1.0 / 3.0, 0.3, 0},
    {"mechanical_order", "iq_cosine", 2.0 / 3.0, 0.2, 1},
    {"back_emf", "neg_sine", 1.0, 0.1, 1},
    {"back_emf", "cosine", 5.0, 0.1, 1},
    {"phase_imbalance", "b", 0.0, -0.1, 1},
    {"magnet_temperature", "emf_per_kelvin", 0.0, -0.002, 1},
    {"reluctance", "dd_cosine", 0.0, 3e-3, 2},
    {"reluctance", "qq_sine", 6.0, 2e-3, 2},
    {"reluctance", "dq_cosine", 6.0, 2e-3, 2},
    {"saturation", "d1q2_cosine", 0.0, -2e-4, 3},
    {"saturation", "d0q3_sine", 6.0, 1e-4, 3},
    {"saturation", "d2q1_cosine", 12.0, 1e-4, 3},
    {"saturation", "d4q0_cosine", 6.0, 4e-6, 4},
    {"saturation", "d2q2_sine", 6.0, 2e-5, 4},
};

enum { TYPE_CASES = sizeof TYPES / sizeof *TYPES };

static void list_of(const type_case *c, el_list *l)
{
    memset(l, 0, sizeof *l);
    el_add(l, c->effect, c->parameter, c->order, c->value);
}

static hci_plant_point point_of(const hci_effects *effects, const hci_plant_state *state)
{
    hci_plant_point p = {0};
    const hci_effects_plant context = {&m.machine, effects, 90.0};
    hci_effects_apply(&context, state, &p);
    return p;
}

/* ---- closed cycles ---- */

/* A cycle in (θ, i) that never returns on its own path: one mechanical turn with currents of orders 1, 2 and
 * a mean, or, with turns = 0, a loop around an angle. */
static void cycle(double u, int turns, double *theta, double *by_u, double i[2], double di[2])
{
    const double w = 2.0 * REF_PI;
    *theta = 0.4 + turns * w * u + 0.3 * sin(w * u);
    *by_u = turns * w + 0.3 * w * cos(w * u);
    i[0] = 3.0 + 4.0 * cos(w * u) + sin(2.0 * w * u);
    i[1] = -1.0 + 5.0 * sin(w * u) + cos(3.0 * w * u);
    di[0] = w * (-4.0 * sin(w * u) + 2.0 * cos(2.0 * w * u));
    di[1] = w * (5.0 * cos(w * u) - 3.0 * sin(3.0 * w * u));
}

/* ∮ i·dψ − T dθ, dψ = L di + (e + L'i) dθ; work: out, ∮|T dθ|. The integrand is periodic and smooth, so equal
 * steps are exact to rounding. */
static double loop_energy(const hci_effects *effects, int turns, double *work)
{
    enum { N = 4096 };
    double sum = 0.0;
    *work = 0.0;
    for (int k = 0; k < N; ++k) {
        hci_plant_state y = {{0.0, 0.0}, 0.0, 0.0, 0.0};
        double by_u, di[2];
        cycle((double)k / N, turns, &y.theta_m_rad, &by_u, y.i, di);
        const hci_plant_point p = point_of(effects, &y);
        const double *l = p.inductance_H, *h = p.magnetic.slope, *e = p.magnetic.e, *i = y.i;
        const double psi[2] = {l[0] * di[0] + l[1] * di[1] + (e[0] + h[0] * i[0] + h[1] * i[1]) * by_u,
                               l[1] * di[0] + l[2] * di[1] + (e[1] + h[1] * i[0] + h[2] * i[1]) * by_u};
        const double torque = hci_point_torque_Nm(&p.magnetic, i);
        sum += (i[0] * psi[0] + i[1] * psi[1] - torque * by_u) / N;
        *work += fabs(torque * by_u) / N;
    }
    return sum;
}

static void test_no_net_work_over_a_closed_cycle(void)
{
    for (size_t k = 0; k < TYPE_CASES; ++k) {
        el_list l;
        list_of(&TYPES[k], &l);
        for (int turns = 0; turns < 2; ++turns) {
            double work;
            const double energy = loop_energy(&l.list, turns, &work);
            TEST_ASSERT_TRUE_MESSAGE(work > 1e-5, TYPES[k].parameter);
            TEST_ASSERT_DOUBLE_WITHIN_MESSAGE(1e-12 * work, 0.0, energy, TYPES[k].parameter);
        }
    }
}

/* Of degree 1 and 0 at once: the back-EMF and the cogging of the machine. */
static void test_no_net_work_of_unequal_magnets(void)
{
    el_list l = {0};
    el_add(&l, "unequal_magnets", "sine", 1.0 / 3.0, 0.1);
    el_add(&l, "unequal_magnets", "cosine", 2.0 / 3.0, 0.05);
    for (int turns = 0; turns < 2; ++turns) {
        double work;
        const double energy = loop_energy(&l.list, turns, &work);
        TEST_ASSERT_TRUE(work > 1e-2);
        TEST_ASSERT_DOUBLE_WITHIN(1e-12 * work, 0.0, energy);
    }
}

/* At constant phase currents a torque that comes from a co-energy does no work over a turn. */
static void test_no_net_torque_at_constant_phase_current(void)
{
    enum { N = 720 };
    for (size_t k = 0; k < TYPE_CASES; ++k) {
        el_list l;
        double sum = 0.0, size = 0.0;
        list_of(&TYPES[k], &l);
        for (int j = 0; j < N; ++j) {
            hci_plant_state y = {{3.0, -2.0}, 0.0, 2.0 * REF_PI * j / N, 0.0};
            const hci_plant_point p = point_of(&l.list, &y);
            sum += hci_point_torque_Nm(&p.magnetic, y.i);
            size += fabs(hci_point_torque_Nm(&p.magnetic, y.i));
        }
        TEST_ASSERT_TRUE(size > 0.0);
        TEST_ASSERT_DOUBLE_WITHIN_MESSAGE(1e-12 * size, 0.0, sum, TYPES[k].parameter);
    }
}

/* The point's torque is the effect's, and its motional voltage ∂T/∂i. */
static void test_point_has_the_torque(void)
{
    for (size_t k = 0; k < TYPE_CASES; ++k) {
        el_list l;
        list_of(&TYPES[k], &l);
        hci_plant_state y = {{3.0, -2.0}, 0.0, 0.7, 0.0};
        hci_sample x = {0};
        x.theta_m_rad = 0.7;
        x.temperature_C = 90.0;
        hci_plane_to_abc(y.i, x.i_abc);
        const hci_plant_point p = point_of(&l.list, &y);
        TEST_ASSERT_DOUBLE_WITHIN(1e-13, hci_effects_torque(&m.machine, &l.list, &x, NULL).torque_Nm,
                                  hci_point_torque_Nm(&p.magnetic, y.i));
    }
}

/* L_x of the salient machine: L_αα = 3/2·⅔ L_d cos² θ, and so on. */
static void test_inductance_of_saliency(void)
{
    el_list l = {0};
    el_add(&l, "reluctance", "dd_cosine", 0.0, 3e-3);
    for (int k = 0; k < 10; ++k) {
        const double theta_m = 0.2 * k, c = cos(3.0 * theta_m), s = sin(3.0 * theta_m);
        const hci_plant_state y = {{1.0, 2.0}, 0.0, theta_m, 0.0};
        const hci_plant_point p = point_of(&l.list, &y);
        TEST_ASSERT_DOUBLE_WITHIN(1e-16, 3e-3 * c * c, p.inductance_H[0]);
        TEST_ASSERT_DOUBLE_WITHIN(1e-16, 3e-3 * c * s, p.inductance_H[1]);
        TEST_ASSERT_DOUBLE_WITHIN(1e-16, 3e-3 * s * s, p.inductance_H[2]);
    }
}

/* ---- power balance of the running plant ---- */

enum { POINTS = 4096 };
static double rows[12 * (POINTS + 1)];

typedef struct {
    pm_lists lists;
    el_list effects;
    hci_effects_plant context;
    hci_plant_effect effect;
    hci_plant plant;
} running;

static void start(running *r, const type_case *c)
{
    memset(r, 0, sizeof *r);
    pm_list(&PM_SINE, &r->lists);
    list_of(c, &r->effects);
    r->context = (hci_effects_plant){&r->lists.machine, &r->effects.list, 90.0};
    r->effect = (hci_plant_effect){hci_effects_apply, &r->context};
    TEST_ASSERT_EQUAL_INT(
        HCI_OK, hci_plant_table_fill(&r->lists.machine, &r->lists.given, POINTS, rows, &r->plant.table));
    r->plant.resistance_ohm = 0.5;
    r->plant.inertia_kgm2 = 0.004;
    r->plant.effects = &r->effect;
    r->plant.effect_count = 1;
}

static void voltage(double t, double v[2])
{
    v[0] = 30.0 + 20.0 * cos(300.0 * t);
    v[1] = 25.0 * sin(450.0 * t);
}

/* What flows in less what is lost and what the shaft takes. */
static double power(const running *r, const hci_plant_state *y, const double v[2])
{
    const double current = y->i[0] * y->i[0] + y->i[1] * y->i[1];
    return v[0] * y->i[0] + v[1] * y->i[1] - r->plant.resistance_ohm * current -
           hci_plant_torque_Nm(&r->plant, y) * y->speed_rad_per_s;
}

/* Field energy: ½ L i² of the machine (20 mH at all angles) and (degree − 1) W' of the effect, by Euler's
 * theorem; ∂²W'/∂i² gives i·L_x i = degree (degree − 1) W'. */
static double field(const running *r, const type_case *c, const hci_plant_state *y)
{
    const hci_plant_point p = point_of(&r->effects.list, y);
    const double *l = p.inductance_H, *i = y->i;
    const double form = l[0] * i[0] * i[0] + 2.0 * l[1] * i[0] * i[1] + l[2] * i[1] * i[1];
    return 0.5 * 0.02 * (i[0] * i[0] + i[1] * i[1]) + (c->degree > 1 ? form / c->degree : 0.0);
}

/* The field energy of a torque without current is −W' = −∫T dθ_m. */
static double magnet(const type_case *c, double theta_m)
{
    const double k = c->order * 3.0;
    if (c->degree > 0) return 0.0;
    return c->parameter[0] == 's' ? c->value * cos(k * theta_m) / k : -c->value * sin(k * theta_m) / k;
}

/* Energy that is missing after 20 ms, with Simpson's rule over pairs of steps. The voltage is held over each
 * pair. */
static double missing_energy(running *r, const type_case *c, double dt, double *turned_over)
{
    hci_plant_state y = {{0.0, 0.0}, 60.0, 0.1, 0.0};
    double sum = 0.0;
    *turned_over = 0.0;
    for (double t = 0.0; t < 0.02 - 0.5 * dt; t += 2.0 * dt) {
        double v[2];
        voltage(floor(t / 1e-3 + 1e-6) * 1e-3, v);
        const double a = power(r, &y, v);
        hci_plant_step(&r->plant, &y, v, 0.1, dt);
        const double b = power(r, &y, v);
        hci_plant_step(&r->plant, &y, v, 0.1, dt);
        sum += dt / 3.0 * (a + 4.0 * b + power(r, &y, v));
        *turned_over += 2.0 * dt * fabs(b);
    }
    return sum - field(r, c, &y) - magnet(c, y.theta_m_rad) + magnet(c, 0.1);
}

static void test_power_balance_of_the_running_plant(void)
{
    static running r;
    for (size_t k = 0; k < TYPE_CASES; ++k) {
        double turned_over;
        start(&r, &TYPES[k]);
        const double coarse = fabs(missing_energy(&r, &TYPES[k], 5e-5, &turned_over));
        const double fine = fabs(missing_energy(&r, &TYPES[k], 2.5e-5, &turned_over));
        TEST_ASSERT_TRUE(turned_over > 0.1);
        /* Table: interpolation of a sine with 4096 points, (2π/4096)⁴/384 ≈ 1e-14. Steps: fourth order,
         * orders up to 18·3·60 rad/s: (0.16)⁴ /100. */
        TEST_ASSERT_TRUE_MESSAGE(fine < 1e-6 * turned_over, TYPES[k].parameter);
        TEST_ASSERT_TRUE_MESSAGE(fine < coarse / 10.0 || fine < 1e-11 * turned_over, TYPES[k].parameter);
    }
}

/* ---- shaft ---- */

static void test_drag_brakes_the_shaft(void)
{
    el_list l = {0};
    el_add(&l, "friction", "coulomb", 0.0, 0.5);
    el_add(&l, "friction", "viscous", 0.0, 0.02);
    el_add(&l, "friction", "quadratic", 0.0, 0.003);
    const hci_plant_state y = {{3.0, -2.0}, -10.0, 0.7, 0.0};
    const hci_plant_point p = point_of(&l.list, &y);
    TEST_ASSERT_DOUBLE_WITHIN(1e-15, -0.2 - 0.3, p.shaft_Nm); /* Coulomb is the plant's own */
    TEST_ASSERT_EQUAL_DOUBLE(0.0, p.magnetic.cogging_Nm);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_no_net_work_over_a_closed_cycle);
    RUN_TEST(test_no_net_work_of_unequal_magnets);
    RUN_TEST(test_no_net_torque_at_constant_phase_current);
    RUN_TEST(test_point_has_the_torque);
    RUN_TEST(test_inductance_of_saliency);
    RUN_TEST(test_power_balance_of_the_running_plant);
    RUN_TEST(test_drag_brakes_the_shaft);
    return UNITY_END();
}
