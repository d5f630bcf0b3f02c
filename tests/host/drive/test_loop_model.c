/* The linear model of the sampled loop against the drive itself, stepped through time at single frequencies:
 * plant by Runge-Kutta, controller sample by sample, the answer by a Fourier sum over the steps. */
#include <complex.h>
#include <math.h>
#include <string.h>

#include "hci/drive/control.h"
#include "host/drive/loop_model.h"
#include "unity.h"

enum { POINTS = 512, STEPS = 40, SAMPLES = 600 };

static double rows[12 * (POINTS + 1)], silent_rows[12 * (POINTS + 1)];

static const double SAMPLE_s = 1e-4, R_ohm = 0.4;
static const int PAIRS = 2;

/* A sine in d or q, once a sample. */
typedef struct {
    double nu_rad_per_s, amplitude_A;
    int axis;
    unsigned long sample;
} sine_reference;

static void give_sine(void *context, const hci_measurement *measured, double torque_Nm, hci_reference_dq *r)
{
    sine_reference *s = context;
    (void)measured;
    (void)torque_Nm;
    r->i_A[s->axis] = s->amplitude_A * cos(s->nu_rad_per_s * SAMPLE_s * (double)s->sample++);
}

/* One drive, and what disturbs it: a back-EMF that the control does not know, or a reference. */
typedef struct {
    hci_loop_model model;
    hci_wave emf;
    sine_reference reference;
} experiment;

static void make_drive(const experiment *x, hci_drive *drive, hci_current_source *source,
                       hci_reference_code *code)
{
    const hci_plant_inductance given = {NULL, 0, x->model.inductance_H[0], x->model.inductance_H[1]};
    const hci_machine loud = {.pole_pairs = PAIRS, .back_emf = &x->emf, .back_emf_count = 1},
                      silent = {.pole_pairs = PAIRS};
    hci_control *c = &drive->control;
    memset(drive, 0, sizeof *drive);
    memset(source, 0, sizeof *source);
    TEST_ASSERT_EQUAL_INT(HCI_OK, hci_plant_table_fill(&loud, &given, POINTS, rows, &drive->plant.table));
    static hci_plant_table known;
    TEST_ASSERT_EQUAL_INT(HCI_OK, hci_plant_table_fill(&silent, &given, POINTS, silent_rows, &known));
    drive->plant.resistance_ohm = R_ohm;
    drive->plant.inertia_kgm2 = INFINITY;
    source->code = code;
    c->table = &known;
    c->step_s = SAMPLE_s / STEPS;
    c->dc_link_V = 1e6;
    c->sources = source;
    c->source_count = 1;
    c->current_every = STEPS;
    c->torque_limit_Nm = c->id_limit = c->iq_limit = c->peak_limit_A = INFINITY;
    c->loop = HCI_CURRENT_PI;
    for (int axis = 0; axis < 2; ++axis)
        c->current.pi[axis] = (hci_pi){x->model.kp_ohm[axis], x->model.ki_ohm_per_s[axis]};
    c->current.filter = x->model.filter;
    c->current.decoupled = x->model.decoupled;
    c->current.delay_steps = (unsigned)floor(x->model.delay_s / c->step_s + 0.5);
}

static double largest_A; /* of the last drive, after the transient */

/* Complex amplitudes of i_d and i_q at ν over whole periods, after the transient. */
static void measure(experiment *x, double nu_rad_per_s, double complex answer[2])
{
    hci_drive drive;
    hci_drive_state state;
    hci_current_source source;
    hci_reference_code code = {give_sine, &x->reference};
    const unsigned long settle = 4000ul * STEPS, count = (unsigned long)SAMPLES * STEPS;
    memset(&state, 0, sizeof state);
    make_drive(x, &drive, &source, &code);
    state.plant.speed_rad_per_s = x->model.speed_rad_per_s / PAIRS;
    answer[0] = answer[1] = largest_A = 0.0;
    for (unsigned long k = 0; k < settle + count; ++k) {
        const double t = (double)k * drive.control.step_s, theta = x->model.speed_rad_per_s * t,
                     scale = sqrt(2.0 / 3.0), *i = state.plant.i;
        const double complex turn = cexp(-nu_rad_per_s * t * (double complex)I) * 2.0 / (double)count;
        if (k >= settle) {
            largest_A = fmax(largest_A, hypot(i[0], i[1]));
            answer[0] += turn * scale * (-cos(theta) * i[0] - sin(theta) * i[1]);
            answer[1] += turn * scale * (sin(theta) * i[0] - cos(theta) * i[1]);
        }
        hci_drive_step(&drive, &state, 0.0, 0.0);
    }
}

/* Frequencies with whole periods in SAMPLES samples. */
static double frequency(int periods)
{
    return 2.0 * 3.14159265358979323846 * periods / (SAMPLES * SAMPLE_s);
}

static hci_loop_model loop_of(double l_d, double l_q, double delay_samples, double speed, bool decoupled)
{
    const hci_loop_model m = {.resistance_ohm = R_ohm,
                              .inductance_H = {l_d, l_q},
                              .kp_ohm = {0.1 * (l_d + l_q) / SAMPLE_s, 0.1 * (l_d + l_q) / SAMPLE_s},
                              .ki_ohm_per_s = {300.0, 300.0},
                              .sample_s = SAMPLE_s,
                              .delay_s = delay_samples * SAMPLE_s,
                              .speed_rad_per_s = speed,
                              .decoupled = decoupled};
    return m;
}

enum { LOOPS = 8 };

static const hci_loop_model *loops(void)
{
    static hci_loop_model m[LOOPS];
    m[0] = loop_of(2e-3, 2e-3, 1.0, 0.0, false);
    m[1] = loop_of(2e-3, 2e-3, 1.0, 500.0, true);
    m[2] = loop_of(1e-3, 3e-3, 1.0, 500.0, false);
    m[3] = loop_of(1e-3, 3e-3, 0.5, -700.0, true);
    m[4] = loop_of(3e-3, 1e-3, 0.0, 900.0, false);
    m[5] = loop_of(3e-3, 1e-3, 0.25, 900.0, true);
    m[6] = loop_of(3e-3, 1e-3, 1.0, 600.0, true); /* gains of its own for each axis, and a filter */
    m[6].kp_ohm[1] *= 0.6;
    m[6].ki_ohm_per_s[1] = 900.0;
    m[6].filter = 0.5;
    m[7] = loop_of(2e-3, 2e-3, 0.5, -400.0, false);
    m[7].kp_ohm[0] *= 1.3;
    m[7].filter = 0.8;
    return m;
}

static void test_reference_is_answered_as_simulated(void)
{
    static const int PERIODS[] = {2, 20, 90, 200, 270}; /* 33 Hz to 4.5 kHz */
    for (int l = 0; l < LOOPS; ++l)
        for (int f = 0; f < 5; ++f)
            for (int axis = 0; axis < 2; ++axis) {
                experiment x = {loops()[l], {1.0, 1, 0.0, 0.0}, {frequency(PERIODS[f]), 1.0, axis, 0}};
                const hci_loop_answer a = hci_loop_answer_at(&x.model, x.reference.nu_rad_per_s);
                double complex seen[2];
                measure(&x, x.reference.nu_rad_per_s, seen);
                for (int out = 0; out < 2; ++out)
                    TEST_ASSERT_DOUBLE_WITHIN(2e-3, 0.0, cabs(seen[out] - a.reference.m[out][axis]));
            }
}

/* A back-EMF of order 6 + σ and sequence σ is of order 6 in the rotor: d = −A ω_m sin 6θ, q = σ A ω_m cos 6θ.
 */
static void test_disturbance_is_answered_as_simulated(void)
{
    for (int l = 1; l < LOOPS; ++l)
        for (int sigma = -1; sigma < 2; sigma += 2) {
            experiment x = {loops()[l], {6.0 + sigma, sigma, 1.0, 0.0}, {0.0, 0.0, 0, 0}};
            x.model.speed_rad_per_s = copysign(frequency(60) / 6.0, x.model.speed_rad_per_s);
            const double nu = 6.0 * x.model.speed_rad_per_s, size = x.model.speed_rad_per_s / PAIRS;
            const hci_loop_answer a = hci_loop_answer_at(&x.model, nu);
            const double complex v[2] = {size * (double complex)I, sigma * size};
            double complex seen[2];
            measure(&x, nu, seen);
            for (int out = 0; out < 2; ++out) {
                const double complex expected =
                    -(a.disturbance.m[out][0] * v[0] + a.disturbance.m[out][1] * v[1]);
                TEST_ASSERT_DOUBLE_WITHIN(1e-4 * fabs(size), 0.0, cabs(seen[out] - expected));
            }
        }
}

/* ---- stability ---- */

/* Without resistance and integral at a standstill, i_(k+1) = i_k + (T/L) k_p (0 − i_(k−1)): the poles of
 * z² − z + g = 0, on the unit circle at g = 1. */
static void test_poles_of_a_pure_inductance(void)
{
    for (double g = 0.05; g < 1.6; g += 0.05) {
        hci_loop_model m = loop_of(2e-3, 2e-3, 1.0, 0.0, false);
        m.resistance_ohm = 0.0;
        m.ki_ohm_per_s[0] = m.ki_ohm_per_s[1] = 0.0;
        m.kp_ohm[0] = m.kp_ohm[1] = g * 2e-3 / SAMPLE_s;
        const double complex root = csqrt(0.25 - g);
        const double expected = fmax(cabs(0.5 + root), cabs(0.5 - root));
        TEST_ASSERT_DOUBLE_WITHIN(2e-4, expected, hci_loop_largest_pole(&m));
    }
}

/* Far below the sampling R + k_p stands for the current, and the integral forgets with (R + k_p)/k_i. */
static void test_an_integral_that_is_slow(void)
{
    hci_loop_model m = {.resistance_ohm = 0.1,
                        .inductance_H = {5e-4, 5e-4},
                        .kp_ohm = {1.0, 1.0},
                        .ki_ohm_per_s = {5.0, 20.0},
                        .sample_s = SAMPLE_s,
                        .delay_s = SAMPLE_s};
    TEST_ASSERT_DOUBLE_WITHIN(2e-3, 1.1 / 5.0, hci_loop_slowest_s(&m));
    m.ki_ohm_per_s[0] = 20.0;
    TEST_ASSERT_DOUBLE_WITHIN(1e-3, 1.1 / 20.0, hci_loop_slowest_s(&m));
    m.kp_ohm[0] = 1e3;
    TEST_ASSERT_TRUE(isinf(hci_loop_slowest_s(&m)));
}

static void set_kp(hci_loop_model *m, const hci_loop_model *of, double factor)
{
    for (int axis = 0; axis < 2; ++axis)
        m->kp_ohm[axis] = factor * of->kp_ohm[axis];
}

static void test_largest_pole_tells_whether_the_drive_is_stable(void)
{
    static const double GAIN[] = {0.5, 0.9, 1.02, 1.1, 1.3};
    for (int l = 0; l < LOOPS; ++l) {
        const hci_loop_model stable = loops()[l];
        TEST_ASSERT_TRUE(hci_loop_largest_pole(&stable) < 1.0);
        for (int k = 0; k < 5; ++k) {
            experiment x = {stable, {1.0, 1, 0.0, 0.0}, {frequency(7), 1.0, 1, 0}};
            double complex seen[2];
            /* around the gain at which it turns over, found from the poles */
            double low = 1.0, high = 30.0;
            for (int n = 0; n < 40; ++n) {
                set_kp(&x.model, &stable, 0.5 * (low + high));
                if (hci_loop_largest_pole(&x.model) < 1.0)
                    low = 0.5 * (low + high);
                else
                    high = 0.5 * (low + high);
            }
            set_kp(&x.model, &stable, GAIN[k] * low);
            measure(&x, x.reference.nu_rad_per_s, seen);
            const bool is_bounded = largest_A < 50.0;
            TEST_ASSERT_EQUAL_INT(GAIN[k] < 1.0, is_bounded);
        }
    }
}

void setUp(void)
{
}

void tearDown(void)
{
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_reference_is_answered_as_simulated);
    RUN_TEST(test_disturbance_is_answered_as_simulated);
    RUN_TEST(test_poles_of_a_pure_inductance);
    RUN_TEST(test_an_integral_that_is_slow);
    RUN_TEST(test_largest_pole_tells_whether_the_drive_is_stable);
    return UNITY_END();
}
