/* The loads of recordings by which terms that cancel are asked for: which count, how much i_d there is beside
 * i_q, and which recordings tell nothing. */
#include "host/diagnose/fit/cancelling.c"

#include "unity.h"

enum { RUNS = 3 };

static bool use[RUNS];
static hci_run run[RUNS];
static hci_run_statistics statistics[RUNS];
static hci_binned_samples samples;
static hci_regression regression;
static hci_load load[RUNS];
static double most_id;

static void set(size_t r, double id_A, double iq_A)
{
    use[r] = true;
    run[r] = (hci_run){.torque_source = HCI_TORQUE_MEASURED};
    statistics[r] =
        (hci_run_statistics){.mean_id_A = id_A, .mean_iq_A = iq_A, .current_A = hypot(id_A, iq_A)};
}

void setUp(void)
{
    set(0, 0.0, 2.0);
    set(1, -1.0, 5.0);
    set(2, 0.5, -10.0);
    samples = (hci_binned_samples){.run_count = RUNS, .statistics = statistics};
    regression = (hci_regression){.samples = &samples, .runs = run, .use = use};
}

void tearDown(void)
{
}

static size_t loads(void)
{
    most_id = -1.0;
    return loads_of(&regression, load, &most_id);
}

static void test_all_loads(void)
{
    static const double ID_A[RUNS] = {0.0, -1.0, 0.5}, IQ_A[RUNS] = {2.0, 5.0, -10.0};
    TEST_ASSERT_EQUAL_UINT64(RUNS, loads());
    for (size_t r = 0; r < RUNS; ++r) {
        TEST_ASSERT_EQUAL_DOUBLE(ID_A[r], load[r].id_A);
        TEST_ASSERT_EQUAL_DOUBLE(IQ_A[r], load[r].iq_A);
    }
    TEST_ASSERT_DOUBLE_WITHIN(1e-15, 0.2, most_id);
}

/* Less than a twentieth of the largest current is no load, whichever recording has that; what is not used
 * counts for nothing. */
static void test_what_is_no_load(void)
{
    for (size_t largest = 0; largest < RUNS; ++largest)
        for (int more = 0; more < 2; ++more) {
            for (size_t r = 0; r < RUNS; ++r)
                set(r, 0.0, r == largest ? 20.0 : more ? 1.01 : 0.99);
            TEST_ASSERT_EQUAL_UINT64(more ? 3 : 1, loads());
            use[largest] = false;
            TEST_ASSERT_EQUAL_UINT64(2, loads());
        }
}

/* A torque that no sensor read, a direct current, or one whose mean is less than nine tenths of it. */
static void test_what_tells_nothing(void)
{
    for (size_t r = 0; r < RUNS; ++r) {
        setUp();
        run[r].torque_source = HCI_TORQUE_INERTIA;
        TEST_ASSERT_EQUAL_UINT64(0, loads());
        setUp();
        statistics[r].is_direct = true;
        TEST_ASSERT_EQUAL_UINT64(0, loads());
        for (int even = 0; even < 2; ++even) {
            setUp();
            statistics[r].current_A /= even ? 0.901 : 0.899;
            TEST_ASSERT_EQUAL_UINT64(even ? RUNS : 0, loads());
        }
    }
}

/* What varies along one curve with much i_d is not told. */
static void test_what_is_told(void)
{
    bool told = false;
    for (int much = 0; much < 2; ++much) {
        for (size_t r = 0; r < RUNS; ++r)
            set(r, (much ? 0.151 : 0.149) * (double)(r + 1), (double)(r + 1));
        TEST_ASSERT_EQUAL_INT(HCI_OK, are_told(&regression, &told, NULL));
        TEST_ASSERT_EQUAL(!much, told);
    }
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_all_loads);
    RUN_TEST(test_what_is_no_load);
    RUN_TEST(test_what_tells_nothing);
    RUN_TEST(test_what_is_told);
    return UNITY_END();
}
