/* Where a recording would narrow what is left open: a ripple of 10 mN·m that is not known, and when there is
 * no telling. */
#include "host/diagnose/next/open_points.h"

#include <math.h>
#include <string.h>

#include "hci/effects/effect.h"
#include "unity.h"

static const hci_machine MACHINE = {.pole_pairs = 3};

static double departure[1];
static hci_effect_term term;
static hci_effect effect;
static hci_uncertainty uncertainty;
static hci_playable playable;

/* One machine, whose cogging torque differs by that; nothing was recorded. */
void setUp(void)
{
    departure[0] = 0.01;
    term = (hci_effect_term){0, 6.0, 0.0, 0.0};
    effect = (hci_effect){hci_effect_type_find("cogging"), &term, 1};
    memset(&uncertainty, 0, sizeof uncertainty);
    uncertainty.effects.list = (hci_effects){&effect, 1};
    uncertainty.departure = departure;
    uncertainty.machines = 1;
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

static bool is_found(hci_open_point *point)
{
    hci_note note = {{0}};
    bool found = true;
    TEST_ASSERT_EQUAL_INT(HCI_OK,
                          hci_open_points_find(&MACHINE, &uncertainty, &playable, point, &found, &note));
    return found;
}

/* The ripple of a sine is its amplitude over √2. */
static void test_what_differs_is_measured(void)
{
    hci_open_point point;
    TEST_ASSERT_TRUE(is_found(&point));
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, 0.01 / sqrt(2.0), point.spread_Nm);
    playable.noise_Nm = 10.0;
    TEST_ASSERT_FALSE(is_found(&point)); /* in which it drowns */
}

static void test_nothing_is_told_where_something_is_not_known(void)
{
    hci_open_point point;
    playable.noise_Nm = 0.0;
    TEST_ASSERT_FALSE(is_found(&point));
    playable.noise_Nm = 0.001;
    playable.source = HCI_TORQUE_HOLDING;
    TEST_ASSERT_FALSE(is_found(&point));
    playable.source = HCI_TORQUE_MEASURED;
    uncertainty.machines = 0;
    TEST_ASSERT_FALSE(is_found(&point));
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_what_differs_is_measured);
    RUN_TEST(test_nothing_is_told_where_something_is_not_known);
    return UNITY_END();
}
