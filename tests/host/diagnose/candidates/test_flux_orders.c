/* At which fractions of the turn magnets could be unequal: residuals M·(e·i + 2 T_cog) of a turn, by their
 * closed form. With a sine of current e·i is L, and the mean square of 2 T_cog, an order of it, is q; two
 * turns of N samples of weight w then give w N m² L² by the load, w N m² q by the teeth, and the sum by both
 * together. */
#include "host/diagnose/candidates/flux_orders.h"

#include <math.h>
#include <string.h>

#include "support/draws.h"
#include "unity.h"

enum { P = 7, N = 420 /* samples of a turn */, RUNS = 5, FLUXES = P - 1 };

static const double K_NM_PER_A = 0.2, IQ_A = 3.0, COGGING_NM = 0.08;

static hci_wave emf[] = {{1.0, 1, 0.2, 0.0}};
static hci_harmonic cogging[] = {{6.0, 0.08, 0.0}};
static hci_machine machine;
static hci_binned_sample sample[N * RUNS];
static hci_segment segment[RUNS];
static hci_run run[RUNS];
static bool use[RUNS];
static double residual_Nm[N * RUNS], variance[N * RUNS];
static hci_binned_samples samples;
static hci_candidates_source source;
static hci_flux_orders found;

/* Runs 1 and 3 tell, a turn each, at other angles; the others are not to be looked at. */
void setUp(void)
{
    memset(run, 0, sizeof run);
    memset(residual_Nm, 0, sizeof residual_Nm);
    machine = (hci_machine){
        .pole_pairs = P, .back_emf = emf, .back_emf_count = 1, .cogging = cogging, .cogging_count = 1};
    for (size_t r = 0; r < RUNS; ++r) {
        segment[r] = (hci_segment){.run = r, .first = N * r, .count = N};
        use[r] = r != 0;
        for (size_t k = N * r; k < N * (r + 1); ++k) {
            hci_sample *x = &sample[k].reading;
            x->theta_m_rad = 2.0 * REF_PI * ((double)(k - N * r) + (r == 3 ? 0.5 : 0.0)) / N;
            for (int s = 0; s < 3; ++s)
                x->i_abc[s] = IQ_A * sin(P * x->theta_m_rad - 2.0 * REF_PI * s / 3.0);
            variance[k] = 1.0;
        }
    }
    run[2].only_mean = true;
    run[4].torque_source = HCI_TORQUE_HOLDING;
    samples = (hci_binned_samples){sample, N * RUNS, segment, RUNS, NULL, RUNS};
    source = (hci_candidates_source){.machine = &machine,
                                     .samples = &samples,
                                     .runs = run,
                                     .use = use,
                                     .residual_Nm = residual_Nm,
                                     .variance = variance};
}

void tearDown(void)
{
}

static double load_Nm(void)
{
    return 1.5 * K_NM_PER_A * IQ_A;
}

static double teeth_square(void)
{
    return 2.0 * COGGING_NM * COGGING_NM;
}

/* Residuals of magnets that differ by size·cos(kθ + k) in the load, and `teeth` times as much in the cogging
 * torque. */
static void add_flux(int k, double size, double teeth)
{
    for (size_t j = 0; j < N * RUNS; ++j) {
        const double theta = sample[j].reading.theta_m_rad;
        residual_Nm[j] +=
            size * cos(k * theta + k) * (load_Nm() + teeth * 2.0 * COGGING_NM * sin(6.0 * P * theta));
    }
}

static void weigh(double weight)
{
    for (size_t j = 0; j < N * RUNS; ++j)
        variance[j] = 1.0 / weight;
}

static size_t find(bool has_turn)
{
    TEST_ASSERT_TRUE(hci_flux_orders_find(&source, has_turn, &found));
    return found.count;
}

/* Four of six, the strongest first; electrical orders. */
static void test_the_strongest_come_first(void)
{
    static const double SIZE[FLUXES] = {0.03, 0.05, 0.01, 0.06, 0.02, 0.04};
    static const int K[4] = {4, 2, 6, 1};
    for (int k = 1; k <= FLUXES; ++k)
        add_flux(k, SIZE[k - 1], 1.0);
    weigh(1e7);
    TEST_ASSERT_EQUAL_UINT64(4, find(true));
    for (int n = 0; n < 4; ++n)
        TEST_ASSERT_DOUBLE_WITHIN(1e-15, (double)K[n] / P, found.order[n]);
    TEST_ASSERT_EQUAL_UINT64(0, find(false));
}

/* The cogging torque alone has to stand out, by 20. */
static void test_what_stands_out(void)
{
    for (int out = 0; out < 2; ++out) {
        memset(residual_Nm, 0, sizeof residual_Nm);
        add_flux(3, 0.05, 1.0);
        weigh((out ? 20.2 : 19.8) / (0.5 * 2 * N * 0.05 * 0.05 * teeth_square()));
        TEST_ASSERT_EQUAL_UINT64(out, find(true));
    }
    TEST_ASSERT_DOUBLE_WITHIN(1e-15, 3.0 / P, found.order[0]);
}

/* Load and teeth have to tell the same: teeth that differ by a times as much make (L² + a q)²/(L² + q) of L²
 * + a² q together, of which 0.8 is the border. */
static void test_load_and_teeth_that_agree(void)
{
    const double l = load_Nm() * load_Nm(), q = teeth_square();
    double low = 1.0, high = 100.0;
    for (int k = 0; k < 60; ++k) {
        const double a = 0.5 * (low + high);
        *((l + a * q) * (l + a * q) / (l + q) > 0.8 * (l + a * a * q) ? &low : &high) = a;
    }
    for (int agrees = 0; agrees < 2; ++agrees) {
        memset(residual_Nm, 0, sizeof residual_Nm);
        add_flux(5, 0.05, low * (agrees ? 0.99 : 1.01));
        weigh(1e7);
        TEST_ASSERT_EQUAL_UINT64(agrees, find(true));
    }
}

/* What is constant in each run says nothing, of parts of a turn and whatever they weigh: without a load the
 * cogging torque would ask for magnets that differ. */
static void test_a_constant_says_nothing(void)
{
    for (size_t r = 0; r < RUNS; ++r)
        for (size_t k = N * r; k < N * (r + 1); ++k) {
            sample[k].reading.theta_m_rad = 1.7 * (double)(k % N) / N;
            memset(sample[k].reading.i_abc, 0, sizeof sample[k].reading.i_abc);
            variance[k] = 1e-6 * (double)(1 + k % 3);
            residual_Nm[k] = r == 1 ? 3.0 : -2.0;
        }
    TEST_ASSERT_EQUAL_UINT64(0, find(true));
}

/* ---- one gain ---- */

/* load·e·i + teeth·T_cog. */
static void gain_set(double load, double teeth)
{
    for (size_t j = 0; j < N * RUNS; ++j)
        residual_Nm[j] = load * load_Nm() + teeth * COGGING_NM * sin(6.0 * P * sample[j].reading.theta_m_rad);
}

static bool has_one_gain(double load, double teeth)
{
    gain_set(load, teeth);
    (void)find(true);
    return found.one_gain;
}

/* Alike by 0.3 of that of the load. */
static void test_gains_that_are_one(void)
{
    weigh(1e7);
    TEST_ASSERT_TRUE(has_one_gain(-0.05, -0.05 * 1.29));
    TEST_ASSERT_FALSE(has_one_gain(-0.05, -0.05 * 1.31));
    TEST_ASSERT_TRUE(has_one_gain(0.05, 0.05 * 0.71));
    TEST_ASSERT_FALSE(has_one_gain(0.05, 0.05 * 0.69));
    TEST_ASSERT_FALSE(has_one_gain(0.05, -0.05));
}

/* Each stands out by itself: w N times a mean square of the torque that is off, of 2 T_cog by half. */
static void test_gains_that_stand_out(void)
{
    for (int out = 0; out < 2; ++out) {
        weigh((out ? 20.2 : 19.8) / (2 * N * 0.25 * 0.05 * 0.05 * teeth_square()));
        TEST_ASSERT_EQUAL(out, has_one_gain(0.05, 0.05));
    }
    for (size_t k = 0; k < N * RUNS; ++k)
        for (int s = 0; s < 3; ++s)
            sample[k].reading.i_abc[s] = 0.0;
    weigh(1e9);
    TEST_ASSERT_FALSE(has_one_gain(0.05, 0.05)); /* without a load */
    machine.cogging_count = 0;
    TEST_ASSERT_FALSE(has_one_gain(0.05, 0.05));
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_the_strongest_come_first);
    RUN_TEST(test_what_stands_out);
    RUN_TEST(test_load_and_teeth_that_agree);
    RUN_TEST(test_a_constant_says_nothing);
    RUN_TEST(test_gains_that_are_one);
    RUN_TEST(test_gains_that_stand_out);
    return UNITY_END();
}
