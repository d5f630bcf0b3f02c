/* Which point narrows most what several machines leave open, and which terms it would tell apart: torques
 * over currents that are written down here. */
#include "host/diagnose/next/open_points.h"

#include <math.h>
#include <string.h>

#include "host/diagnose/next/tell_apart.h"
#include "host/diagnose/next/trial_run.h"
#include "support/effect_list.h"
#include "unity.h"

/* Back-EMF of orders 1, 5 and 7, sines; cogging torque of order 6, sine, and of order 12, cosine. */
enum { EMF_1, EMF_5, EMF_7, SINE_6, COSINE_12, TERMS, MACHINES = 3 };

static const hci_machine MACHINE = {.pole_pairs = 3};

static double departure[TERMS][MACHINES];
static el_list effects;
static hci_measured_run measured[2];
static hci_uncertainty uncertainty;
static hci_playable playable;
static hci_operating_point point[HCI_OPERATING_POINTS];
static hci_open_point found;

void setUp(void)
{
    memset(departure, 0, sizeof departure);
    memset(&effects, 0, sizeof effects);
    memset(&uncertainty, 0, sizeof uncertainty);
    memset(&found, 0, sizeof found);
    el_add(&effects, "back_emf", "sine", 1.0, 0.03);
    el_add(&effects, "back_emf", "sine", 5.0, 0.01);
    el_add(&effects, "back_emf", "sine", 7.0, 0.0);
    el_add(&effects, "cogging", "sine", 6.0, 0.02);
    el_add(&effects, "cogging", "cosine", 12.0, 0.0);
    uncertainty.effects.list = effects.list;
    uncertainty.departure = departure[0];
    uncertainty.machines = MACHINES;
    uncertainty.run = measured;
    playable = (hci_playable){.source = HCI_TORQUE_MEASURED,
                              .most_A = 8.0,
                              .least_rad_per_s = 10.0,
                              .most_rad_per_s = 100.0,
                              .most_V = INFINITY,
                              .noise_Nm = 0.001};
}

void tearDown(void)
{
}

static bool find(void)
{
    hci_note note = {{0}};
    bool is_found = false;
    TEST_ASSERT_EQUAL_INT(HCI_OK,
                          hci_open_points_find(&MACHINE, &uncertainty, &playable, &found, &is_found, &note));
    return is_found;
}

/* Mean square of what the machines differ by about its mean over a turn, with i_s = q sin(θ − s) − d cos(θ −
 * s). A back-EMF of order 1 makes a mean alone. */
static double spread_of(double id_A, double iq_A)
{
    double sum = 0.0;
    for (size_t m = 0; m < MACHINES; ++m)
        for (int k = 0; k < 96; ++k) {
            const double theta = 2.0 * REF_PI * k / 96.0;
            double torque =
                departure[SINE_6][m] * sin(6.0 * theta) + departure[COSINE_12][m] * cos(12.0 * theta);
            for (int s = 0; s < 3; ++s) {
                const double x = theta - 2.0 * REF_PI * s / 3.0, i_A = iq_A * sin(x) - id_A * cos(x);
                torque += (departure[EMF_5][m] * sin(5.0 * x) + departure[EMF_7][m] * sin(7.0 * x)) * i_A;
            }
            sum += torque * torque / (96.0 * MACHINES);
        }
    return sqrt(sum);
}

static double chi_square_of(double spread_Nm)
{
    const double turn = (double)hci_trial_run_samples(3);
    return HCI_LEAST_TURNS * turn * spread_Nm * spread_Nm / 1e-6;
}

static void depart(void)
{
    static const double BY[TERMS][MACHINES] = {{0.01, -0.02, 0.03},
                                               {0.003, 0.001, -0.002},
                                               {0.002, -0.001, 0.0025},
                                               {0.001, -0.002, 0.0015},
                                               {-0.0005, 0.001, 0.002}};
    memcpy(departure, BY, sizeof departure);
}

/* The first of the points at which the machines differ most. */
static void test_the_point_that_tells_most(void)
{
    const size_t count = hci_operating_points(&playable, point);
    size_t best = 0;
    depart();
    for (size_t k = 1; k < count; ++k)
        if (spread_of(point[k].id_A, point[k].iq_A) >
            (1.0 + 1e-9) * spread_of(point[best].id_A, point[best].iq_A))
            best = k;
    TEST_ASSERT_TRUE(find());
    const double spread_Nm = spread_of(point[best].id_A, point[best].iq_A);
    TEST_ASSERT_EQUAL_UINT64(best, found.point);
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, spread_Nm, found.spread_Nm);
    TEST_ASSERT_DOUBLE_WITHIN(1e-9 * chi_square_of(spread_Nm), chi_square_of(spread_Nm), found.chi_square);
}

/* Where the recordings leave a fifth of it at the middle of their currents, no point is worth a run; of
 * several it is the one that leaves most. */
static void test_points_beside_what_was_recorded(void)
{
    const size_t count = hci_operating_points(&playable, point);
    double most_Nm = 0.0;
    departure[EMF_5][0] = 0.003; /* in proportion to the current */
    for (size_t k = 0; k < count; ++k)
        most_Nm = fmax(most_Nm, spread_of(point[k].id_A, point[k].iq_A));
    const double per_A = spread_of(0.0, 1.0), border_A = most_Nm / per_A / 5.0;
    uncertainty.runs = 2;
    for (int worth = 0; worth < 2; ++worth) {
        const double q_A = border_A * (worth ? 0.99 : 1.01) * 0.8,
                     d_A = -border_A * (worth ? 0.99 : 1.01) * 0.6;
        measured[1] = (hci_measured_run){.id_A = {d_A - 1.0, d_A + 1.0}, .iq_A = {q_A - 0.5, q_A + 0.5}};
        measured[0] = (hci_measured_run){.id_A = {0.1, 0.2}, .iq_A = {0.1, 0.2}};
        TEST_ASSERT_EQUAL(worth, find());
    }
}

/* What takes a spread from noise is χ² of so many turns. */
static void test_a_point_has_to_tell(void)
{
    departure[SINE_6][1] = 0.001;
    const double told = sqrt(HCI_TELLS / chi_square_of(spread_of(0.0, 0.0)));
    for (int tells = 0; tells < 2; ++tells) {
        departure[SINE_6][1] = 0.001 * told * (tells ? 1.001 : 0.999);
        TEST_ASSERT_EQUAL(tells, find());
    }
}

/* A term that was not found makes most of it, and one that was found goes with it from machine to machine. */
static void test_which_terms_stand_for_each_other(void)
{
    static const double A[MACHINES] = {0.004, -0.003, 0.002};
    for (size_t m = 0; m < MACHINES; ++m) {
        departure[COSINE_12][m] = A[m];
        departure[EMF_5][m] = -0.1 * A[m];
        departure[EMF_7][m] = 0.01 * A[m];
    }
    departure[SINE_6][0] = 0.003; /* another direction: (3, 4) is at right angles to (4, −3) */
    departure[SINE_6][1] = 0.004;
    TEST_ASSERT_TRUE(find());
    TEST_ASSERT_EQUAL_STRING("cogging cosine_12", found.twin);
    TEST_ASSERT_EQUAL_STRING("back_emf sine_5", found.found);
}

/* Two that go together by less than a half have no name; nor has what was found alone. */
static void test_terms_that_hardly_go_together(void)
{
    for (int together = 0; together < 2; ++together) {
        const double c = together ? 0.505 : 0.495;
        memset(departure, 0, sizeof departure);
        departure[COSINE_12][0] = 0.004;
        departure[SINE_6][0] = 0.001 * c;
        departure[SINE_6][2] = 0.001 * sqrt(1.0 - c * c);
        TEST_ASSERT_TRUE(find());
        TEST_ASSERT_EQUAL_STRING(together ? "cogging sine_6" : "", found.found);
        TEST_ASSERT_EQUAL_STRING(together ? "cogging cosine_12" : "", found.twin);
    }
    memset(departure, 0, sizeof departure);
    departure[SINE_6][0] = 0.004;
    TEST_ASSERT_TRUE(find());
    TEST_ASSERT_EQUAL_STRING("", found.found);
    TEST_ASSERT_EQUAL_STRING("", found.twin);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_the_point_that_tells_most);
    RUN_TEST(test_points_beside_what_was_recorded);
    RUN_TEST(test_a_point_has_to_tell);
    RUN_TEST(test_which_terms_stand_for_each_other);
    RUN_TEST(test_terms_that_hardly_go_together);
    return UNITY_END();
}
