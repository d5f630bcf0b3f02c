/* Parts of Newton's method: what a component has of the currents it begins with. */
#include "host/solve/newton.c"

#include "unity.h"

void setUp(void)
{
}

void tearDown(void)
{
}

static void takes(double order, int sequence, double sine, double cosine)
{
    static hci_wave wave[] = {{1.0, 1, 3.0, 4.0}, {5.0, -1, 0.5, 0.6}, {7.0, 1, -0.1, -0.2}};
    const hci_wave_list i = {.wave = wave, .count = 3};
    double x[2] = {9.0, 9.0};
    take_wave(&i, (hci_component){order, sequence}, x);
    TEST_ASSERT_EQUAL_DOUBLE(sine, x[0]);
    TEST_ASSERT_EQUAL_DOUBLE(cosine, x[1]);
}

static void test_what_a_component_has(void)
{
    takes(1.0, 1, 3.0, 4.0);
    takes(5.0, -1, 0.5, 0.6);
    takes(7.0, 1, -0.1, -0.2);
    takes(5.0, 1, 0.0, 0.0);
    takes(11.0, -1, 0.0, 0.0);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_what_a_component_has);
    return UNITY_END();
}
