/* A shaft that stands between two movements: it is at rest there and as far around as slopes reach, and
 * nowhere else. */
#include "host/diagnose/prepare/rest.h"

#include "support/recording.h"
#include "unity.h"

enum { N = 1800, STOP = 300, START = 1500, WINDOW = 9 };

static hci_run run;
static bool at_rest[N];

void setUp(void)
{
    uint64_t seed = 12;
    run = rec_make(N);
    run.torque_source = HCI_TORQUE_INERTIA;
    run.torque_window = WINDOW;
    for (size_t k = 0; k < N; ++k) {
        const double moved = k < STOP ? (double)k : k < START ? STOP : (double)(k - START + STOP);
        run.time_s[k] = 1e-3 * (double)k;
        run.theta_m_rad[k] = 3e-3 * moved + 2e-4 * ref_normal(&seed);
    }
}

void tearDown(void)
{
    rec_release(&run);
}

static void is_between(bool expected, size_t from, size_t end)
{
    for (size_t k = from; k < end; ++k)
        TEST_ASSERT_EQUAL(expected, at_rest[k]);
}

/* 8 deviations are 1.6 mrad, half a sample's way. */
static void test_stands_in_between(void)
{
    hci_rest_find(&run, at_rest);
    is_between(false, 0, STOP - WINDOW);
    is_between(true, STOP, START);
    is_between(false, START + WINDOW, N);
}

/* A sensor reads the torque at rest too; and where nothing would be left all is kept. */
static void test_none(void)
{
    run.torque_source = HCI_TORQUE_MEASURED;
    hci_rest_find(&run, at_rest);
    is_between(false, 0, N);
    run.torque_source = HCI_TORQUE_INERTIA;
    for (size_t k = 0; k < N; ++k)
        run.theta_m_rad[k] = k < N / 20 ? 1e-3 * (double)(k * k % 7) : 0.5;
    hci_rest_find(&run, at_rest);
    is_between(false, 0, N);
}

/* A shaft that runs down and stands for eleven twelfths of its recording. */
static void test_stands_for_most(void)
{
    uint64_t seed = 5;
    for (size_t k = 0; k < N; ++k)
        run.theta_m_rad[k] = 3e-3 * (double)(k < N / 12 ? k : N / 12) + 2e-4 * ref_normal(&seed);
    hci_rest_find(&run, at_rest);
    is_between(false, 0, N / 12 - WINDOW);
    is_between(true, N / 12, N);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_stands_in_between);
    RUN_TEST(test_none);
    RUN_TEST(test_stands_for_most);
    return UNITY_END();
}
