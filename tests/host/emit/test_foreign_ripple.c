/* The ripple of a plain sine, of a mean torque that is found by bisection here: with saturation the torque
 * per ampere falls, so that one step does not find it. */
#include "host/emit/foreign_ripple.h"

#include <math.h>

#include "support/recording.h"
#include "unity.h"

enum { OF_MEAN = 180, OF_PEAKS = 4320 }; /* angles: orders of the torque are 60 at most */

static hci_machine_data machine;
static hci_machine_plant plant;

void setUp(void)
{
}

void tearDown(void)
{
    hci_machine_plant_release(&plant);
    hci_machine_release(&machine);
}

/* Mean, least and most torque over an electrical period with i_q alone. */
static double sweep(double iq_A, int points, double *low, double *high)
{
    double mean = 0.0;
    *low = INFINITY;
    *high = -INFINITY;
    for (int k = 0; k < points; ++k) {
        const double theta = 2.0 * REF_PI * k / points;
        double i[3];
        rec_phases(0.0, iq_A, theta, i);
        const double torque_Nm = hci_machine_plant_torque_at(&plant, theta, i, NULL);
        mean += torque_Nm / points;
        *low = fmin(*low, torque_Nm);
        *high = fmax(*high, torque_Nm);
    }
    return mean;
}

static double ripple_by_bisection(double torque_Nm)
{
    double low, high, from = 0.0, to = 12.0;
    for (int k = 0; k < 24; ++k) {
        const double middle = 0.5 * (from + to);
        if (sweep(middle, OF_MEAN, &low, &high) < torque_Nm)
            from = middle;
        else
            to = middle;
    }
    (void)sweep(to, OF_PEAKS, &low, &high);
    return high - low;
}

static void check(const char *folder, double torque_Nm)
{
    hci_note note = {{0}};
    TEST_ASSERT_EQUAL_MESSAGE(HCI_OK, hci_machine_read(folder, &machine, &note), note.text);
    TEST_ASSERT_EQUAL_MESSAGE(HCI_OK, hci_machine_plant_make(folder, &machine, &plant, &note), note.text);
    const double wanted_Nm = ripple_by_bisection(torque_Nm);
    /* peaks between samples; one step from the torque constant misses it by 8e-4 */
    TEST_ASSERT_DOUBLE_WITHIN(3e-4 * wanted_Nm, wanted_Nm, hci_emit_sine_ripple_Nm(&plant, torque_Nm));
    tearDown();
}

static void test_ripple_of_a_plain_sine(void)
{
    check("data/machine_c", 6.0);
    check("data/machine_c_saturated", 8.0);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_ripple_of_a_plain_sine);
    return UNITY_END();
}
