/* A torque once or twice a turn, which an arm or a crank on the shaft makes as well as the motor. */
#include "hci/host/waveform/turning_load.h"

#include <unity.h>

#include "hci/math/harmonic.h"

static const hci_effects NO_EFFECTS = {NULL, 0};

static hci_run run[2];
static hci_runs runs;

void setUp(void)
{
    run[0] = run[1] = (hci_run){.torque_source = HCI_TORQUE_HOLDING};
    runs = (hci_runs){.run = run, .count = 2};
}

void tearDown(void)
{
}

static double load_of(int pole_pairs, double order, double amplitude_Nm)
{
    const hci_harmonic cogging[] = {{12.0, 0.03, 0.04}, {order, 0.0, amplitude_Nm}};
    const hci_machine machine = {.pole_pairs = pole_pairs, .cogging = cogging, .cogging_count = 2};
    return hci_turning_load_Nm(&machine, &NO_EFFECTS, &runs);
}

static void test_orders(void)
{
    TEST_ASSERT_TRUE(hci_is_turning_load_order(1.0 / 7.0, 7));
    TEST_ASSERT_TRUE(hci_is_turning_load_order(2.0 / 7.0, 7));
    TEST_ASSERT_TRUE(hci_is_turning_load_order(0.5, 2));
    TEST_ASSERT_TRUE(hci_is_turning_load_order(1.0, 1));
    TEST_ASSERT_TRUE(hci_is_turning_load_order(2.0, 1));
    TEST_ASSERT_FALSE(hci_is_turning_load_order(1.0, 2)); /* twice a turn, and of the current sensors */
    TEST_ASSERT_FALSE(hci_is_turning_load_order(1.0, 7));
    TEST_ASSERT_FALSE(hci_is_turning_load_order(0.0, 7));
    TEST_ASSERT_FALSE(hci_is_turning_load_order(3.0 / 7.0, 7));
}

static void test_size(void)
{
    TEST_ASSERT_EQUAL_DOUBLE(0.01, load_of(5, 0.2, 0.01));
    TEST_ASSERT_EQUAL_DOUBLE(0.01, load_of(5, 0.4, 0.01));
    TEST_ASSERT_EQUAL_DOUBLE(0.0, load_of(5, 0.2, 0.004)); /* a twelfth of the largest */
    TEST_ASSERT_EQUAL_DOUBLE(0.0, load_of(5, 0.6, 0.01));
}

/* A sensor between motor and load sees no load; without a torque nothing is told, and nothing to be said. */
static void test_sensor(void)
{
    run[1].torque_source = HCI_TORQUE_MEASURED;
    TEST_ASSERT_EQUAL_DOUBLE(0.0, load_of(5, 0.2, 0.01));
    run[0].torque_source = run[1].torque_source = HCI_TORQUE_NONE;
    TEST_ASSERT_EQUAL_DOUBLE(0.0, load_of(5, 0.2, 0.01));
    run[1].torque_source = HCI_TORQUE_INERTIA;
    TEST_ASSERT_EQUAL_DOUBLE(0.01, load_of(5, 0.2, 0.01));
}

/* What a diagnosis adds to the declared cogging torque belongs to it. */
static void test_found(void)
{
    const hci_effect_type *type = hci_effect_type_find("cogging");
    TEST_ASSERT_NOT_NULL(type);
    hci_effect_term term[2] = {{0, 0.2, 0.006, 0.0}, {1, 0.2, 0.008, 0.0}};
    const hci_effect effect = {type, term, 2};
    const hci_effects effects = {&effect, 1};
    const hci_harmonic cogging[] = {{12.0, 0.03, 0.04}, {0.2, -0.006, -0.008}};
    hci_machine machine = {.pole_pairs = 5, .cogging = cogging, .cogging_count = 1};
    TEST_ASSERT_EQUAL_DOUBLE(0.01, hci_turning_load_Nm(&machine, &effects, &runs));
    machine.cogging_count = 2; /* and takes away what was declared */
    TEST_ASSERT_EQUAL_DOUBLE(0.0, hci_turning_load_Nm(&machine, &effects, &runs));
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_orders);
    RUN_TEST(test_size);
    RUN_TEST(test_sensor);
    RUN_TEST(test_found);
    return UNITY_END();
}
