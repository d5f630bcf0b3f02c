/* A load that varies beside what friction, an inertia that is wrong and iron make, against least squares by
 * hand. */
#include "host/diagnose/prepare/varying_load.h"

#include "host/base/memory.h"
#include "support/diagnosing.h"
#include "support/least_squares.h"

enum { PARTS = 16, COLUMNS = 5, N = 1920 }; /* 120 samples a part */

static bool use[MOST_RUNS];

void setUp(void)
{
    dataset_start();
    for (size_t k = 0; k < MOST_RUNS; ++k)
        use[k] = true;
}

void tearDown(void)
{
    dataset_end();
}

/* Another acceleration, speed and current in each part; so many turns of each. What the current makes is a
 * times that and what brakes; load_Nm: of what nobody knows, another one in each part. */
static void record_load(double turns, double way, double load_Nm)
{
    hci_run *r = add_run(N);
    double theta = 0.4;
    r->torque_source = HCI_TORQUE_INERTIA;
    for (size_t k = 0; k < N; ++k) {
        const double part = (double)(k / (N / PARTS)), speed = way * (50.0 + 20.0 * sin(1.7 * part + way));
        const double torque = 0.3 * cos(2.3 * part), d = 2.0 * sin(3.1 * part), rough = k % 2 ? 1.0 : -1.0;
        r->time_s[k] = 1e-3 * (double)k;
        r->speed_rad_per_s[k] = speed;
        r->torque_Nm[k] = torque + 0.2 * rough;
        r->theta_m_rad[k] = theta;
        const double sign = way > 0.0 ? 1.0 : -1.0;
        double q = 4.0;
        for (int step = 0; step < 40;
             ++step) /* 0.3 q = a T + c sign + B w + R d q + S q³ + load, in the mean of a part */
            q = (1.2 * torque + 0.1 * sign + 2e-3 * speed + 0.01 * d * q + 5e-4 * q * q * q +
                 load_Nm * sin(40.0 * part * part + way)) /
                0.3;
        rec_phases(d, q, P * theta, r->i_A + 3 * k);
        theta += way * turns * PARTS * 2.0 * REF_PI / N;
    }
}

static double load_found(void)
{
    static const hci_effects none = {NULL, 0};
    hci_note note = {{0}};
    double load_Nm = -1.0;
    TEST_ASSERT_EQUAL_INT(HCI_OK, hci_varying_load_find(&machine, &none, &runs, use, &load_Nm, &note));
    return load_Nm;
}

/* The same by hand: means of the parts, one system, and degrees of freedom. */
static double by_hand(void)
{
    double a[COLUMNS][COLUMNS + 1] = {{0.0}}, row[MOST_RUNS * PARTS][COLUMNS + 1] = {{0.0}}, square = 0.0;
    size_t rows = 0;
    for (size_t k = 0; k < runs.count; ++k)
        for (size_t p = 0; p < PARTS && use[k]; ++p, ++rows)
            for (size_t j = p * N / PARTS; j < (p + 1) * N / PARTS; ++j) {
                double d, q, share = (double)PARTS / N;
                const double speed = run[k].speed_rad_per_s[j];
                rec_rotor(run[k].i_A + 3 * j, P * run[k].theta_m_rad[j], &d, &q);
                const double x[] = {run[k].torque_Nm[j], speed > 0.0 ? 1.0 : -1.0, speed, d * q,
                                    q * q * q,           1.5 * K_NM_PER_A * q};
                for (int c = 0; c <= COLUMNS; ++c)
                    row[rows][c] += share * x[c];
            }
    for (size_t r = 0; r < rows; ++r)
        for (int i = 0; i < COLUMNS; ++i)
            for (int j = 0; j <= COLUMNS; ++j)
                a[i][j] += row[r][i] * row[r][j];
    ref_reduce(&a[0][0], COLUMNS, COLUMNS + 1, COLUMNS + 1);
    for (size_t r = 0; r < rows; ++r) {
        double rest = row[r][COLUMNS];
        for (int c = 0; c < COLUMNS; ++c)
            rest -= a[c][COLUMNS] * row[r][c];
        square += rest * rest;
    }
    return sqrt(square / (double)(rows - COLUMNS));
}

static void test_what_is_known_is_no_load(void)
{
    record_load(3.5, 1.0, 0.0);
    record_load(4.0, -1.0, 0.0);
    TEST_ASSERT_DOUBLE_WITHIN(1e-5, 0.0, load_found());
}

static void test_a_load_is_what_is_left(void)
{
    record_load(3.5, 1.0, 0.2);
    record_load(4.0, -1.0, 0.2);
    record_load(3.2, 1.0, 0.2);
    const double all = by_hand();
    TEST_ASSERT_TRUE(all > 0.05);
    TEST_ASSERT_DOUBLE_WITHIN(1e-9, all, load_found());
    use[1] = false;
    run[1].torque_Nm[5] = NAN;
    use[2] = true; /* one direction alone: a sign is a constant */
    TEST_ASSERT_DOUBLE_WITHIN(1e-9, by_hand(), load_found());
}

/* Of three turns in each part, but for one sample; where none has them, and of too few samples, nothing is
 * told. */
static void test_which_runs_tell(void)
{
    record_load(3.1, 1.0, 0.2);
    TEST_ASSERT_TRUE(load_found() > 0.05);
    tearDown();
    setUp();
    record_load(2.9, 1.0, 0.2);
    TEST_ASSERT_EQUAL_DOUBLE(0.0, load_found());
    record_load(3.1, -1.0, 0.2);
    TEST_ASSERT_TRUE(load_found() > 0.05);
    use[1] = false;
    TEST_ASSERT_EQUAL_DOUBLE(0.0, load_found());
}

static void test_the_least_samples(void)
{
    record_load(3.1, 1.0, 0.2);
    for (size_t k = 0; k < N; ++k)
        run[0].theta_m_rad[k] *= 40.0; /* turns enough in four samples */
    for (size_t n = 63; n <= 64; ++n) {
        run[0].count = n;
        TEST_ASSERT_EQUAL(n == 64, load_found() > 0.0);
    }
    run[0].count = N;
}

static void test_memory_is_out_of_a_load(void)
{
    static const hci_effects none = {NULL, 0};
    hci_note note = {{0}};
    double load_Nm;
    record_load(3.1, 1.0, 0.2);
    for (long k = 0; k < 3; ++k) {
        hci_memory_fail_after(k);
        const hci_status status = hci_varying_load_find(&machine, &none, &runs, use, &load_Nm, &note);
        hci_memory_fail_after(-1);
        TEST_ASSERT_EQUAL_INT(HCI_ERROR_MEMORY, status);
    }
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_what_is_known_is_no_load);
    RUN_TEST(test_a_load_is_what_is_left);
    RUN_TEST(test_which_runs_tell);
    RUN_TEST(test_the_least_samples);
    RUN_TEST(test_memory_is_out_of_a_load);
    return UNITY_END();
}
