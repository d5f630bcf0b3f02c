/* Means of recordings that two causes explain alike, and means that nothing explains: the ripple is known all
 * the same. Some tenths of a second. */
#include <math.h>
#include <string.h>

#include "support/diagnosing.h"

enum { SAMPLES = 240 };

static double gain; /* of the torque per ampere, of that which is declared */

void setUp(void)
{
    dataset_start();
    gain = 1.0;
}

void tearDown(void)
{
    dataset_end();
}

/* A machine with cogging torque of order 6 and a back-EMF of order 7; standing_Nm: added to each torque. */
static void measure_at(double iq_A, double speed_rad_per_s, double standing_Nm)
{
    hci_run *r = add_run(8 * SAMPLES);
    for (size_t k = 0; k < r->count; ++k) {
        const double theta = (speed_rad_per_s < 0.0 ? -2.0 : 2.0) * REF_PI * (double)k / SAMPLES;
        r->theta_m_rad[k] = theta / P;
        r->time_s[k] = theta / P / speed_rad_per_s;
        r->speed_rad_per_s[k] = speed_rad_per_s;
        rec_phases(0.0, iq_A, theta, r->i_A + 3 * k);
        for (int s = 0; s < 3; ++s) {
            const double x = theta - 2.0 * REF_PI * s / 3.0;
            r->torque_Nm[k] += (gain * K_NM_PER_A * sin(x) + 0.01 * sin(7.0 * x)) * r->i_A[3 * k + (size_t)s];
        }
        r->torque_Nm[k] += standing_Nm + 0.05 * sin(6.0 * theta + 0.4) + NOISE_NM * ref_normal(&seed);
    }
}

#define DRAG_Nm 0.1

/* A load forward and an idle turn back. */
static void test_friction_or_the_zero_of_the_sensor(void)
{
    measure_at(8.0, 20.0, -DRAG_Nm);
    measure_at(0.0, -20.0, DRAG_Nm);
    TEST_ASSERT_EQUAL(HCI_NOT_REACHED, diagnose(NULL));
    TEST_ASSERT_NOT_NULL(diagnosis.standing_taken);
    const bool has_zero = strstr(diagnosis.standing_taken, "sensor") != NULL;
    TEST_ASSERT_NOT_NULL(strstr(diagnosis.standing_instead, has_zero ? "friction" : "sensor"));
    const double share = 2.0 * DRAG_Nm / (1.5 * K_NM_PER_A * 8.0);
    TEST_ASSERT_DOUBLE_WITHIN(0.1 * share, has_zero ? share : -share, diagnosis.standing_share);
    TEST_ASSERT_EQUAL(HCI_FINDING_AMBIGUOUS, found(has_zero ? "friction" : "torque_sensor")->verdict);
}

/* The same with an idle turn forward. */
static void test_idle_turns_both_ways_tell(void)
{
    measure_at(8.0, 20.0, -DRAG_Nm);
    measure_at(0.0, 20.0, -DRAG_Nm);
    measure_at(0.0, -20.0, DRAG_Nm);
    TEST_ASSERT_EQUAL(HCI_NOT_REACHED, diagnose(NULL));
    TEST_ASSERT_NULL(diagnosis.standing_taken);
    TEST_ASSERT_EQUAL(HCI_FINDING_ADDED, found("friction")->verdict);
}

/* One load alone: what it reads too little is the torque per ampere, the zero of the sensor, or friction. */
static void test_one_load_tells_no_torque_per_ampere(void)
{
    measure_at(8.0, 20.0, -DRAG_Nm);
    TEST_ASSERT_EQUAL(HCI_NOT_REACHED, diagnose(NULL));
    TEST_ASSERT_NOT_NULL(diagnosis.standing_taken);
    const double share = DRAG_Nm / (1.5 * K_NM_PER_A * 8.0);
    TEST_ASSERT_DOUBLE_WITHIN(1.2 * share, 0.0, diagnosis.standing_share);
}

/* In one direction what is read too much is no friction, and the zero of the sensor in all loads. */
static void test_a_zero_is_no_friction_that_drives(void)
{
    measure_at(4.0, 20.0, DRAG_Nm);
    measure_at(8.0, 20.0, DRAG_Nm);
    measure_at(12.0, 20.0, DRAG_Nm);
    measure_at(0.0, 20.0, DRAG_Nm);
    TEST_ASSERT_EQUAL(HCI_OK, diagnose(NULL));
    TEST_ASSERT_EQUAL(HCI_FINDING_ADDED, found("torque_sensor")->verdict);
    TEST_ASSERT_EQUAL(HCI_FINDING_REJECTED, found("friction")->verdict);
    TEST_ASSERT_TRUE(diagnosis.uncertainty.machines > 0);
}

/* Deviation of the back-EMF's order 1 over the machines that are allowed, as a share of the declared one; 0:
 * it is the same in all. */
static double constant_spread(const hci_uncertainty *u)
{
    double square = 0.0;
    size_t row = 0;
    for (size_t k = 0; k < u->effects.list.count; ++k)
        for (size_t j = 0; j < u->effects.list.effect[k].count; ++j, ++row) {
            const hci_effect *x = &u->effects.list.effect[k];
            if (strcmp(x->type->name, "back_emf") != 0 || x->term[j].order != 1.0) continue;
            for (size_t m = 0; m < u->machines; ++m)
                square += pow(u->departure[row * u->machines + m], 2.0) / (double)u->machines;
        }
    return sqrt(square) / K_NM_PER_A;
}

/* A zero of the sensor that is another one in each recording. In the bound the torque per ampere is that of
 * the sheet within some tenths. */
static void test_the_ripple_stays_beside_means_that_nothing_explains(void)
{
    static const double ZERO_Nm[] = {0.12, -0.1, 0.05, -0.16};
    measure_at(8.0, 20.0, ZERO_Nm[0]);
    measure_at(4.0, 20.0, ZERO_Nm[1]);
    measure_at(-8.0, 20.0, ZERO_Nm[2]);
    measure_at(0.0, 20.0, ZERO_Nm[3]);
    TEST_ASSERT_EQUAL(HCI_NOT_REACHED, diagnose(NULL));
    TEST_ASSERT_EQUAL(HCI_FINDING_ADDED, found("cogging")->verdict);
    TEST_ASSERT_EQUAL(HCI_FINDING_ADDED, found("back_emf")->verdict);
    TEST_ASSERT_TRUE(diagnosis.means_open && diagnosis.means_alone);
    TEST_ASSERT_TRUE(diagnosis.uncertainty.machines > 0);
    TEST_ASSERT_DOUBLE_WITHIN(0.01, 0.1145, diagnosis.uncertainty.origin.left_means_Nm);
    TEST_ASSERT_FALSE(hci_machine_origin_is_doubtful(&diagnosis.uncertainty.origin));
    TEST_ASSERT_DOUBLE_WITHIN(0.03, 0.1, constant_spread(&diagnosis.uncertainty));
}

/* Two opposite loads without an idle turn: cogging torque, which keeps its sign, is no reluctance torque that
 * hardly leaves the magnets any. */
static void test_opposite_loads_tell_their_ripple(void)
{
    measure_at(8.0, 20.0, 0.02);
    measure_at(-8.0, 20.0, 0.05);
    TEST_ASSERT_EQUAL(HCI_NOT_REACHED, diagnose(NULL));
    TEST_ASSERT_NOT_EQUAL(HCI_FINDING_REJECTED, found("cogging")->verdict);
    TEST_ASSERT_NOT_EQUAL(HCI_FINDING_REJECTED, found("back_emf")->verdict);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_friction_or_the_zero_of_the_sensor);
    RUN_TEST(test_idle_turns_both_ways_tell);
    RUN_TEST(test_one_load_tells_no_torque_per_ampere);
    RUN_TEST(test_a_zero_is_no_friction_that_drives);
    RUN_TEST(test_the_ripple_stays_beside_means_that_nothing_explains);
    RUN_TEST(test_opposite_loads_tell_their_ripple);
    return UNITY_END();
}
