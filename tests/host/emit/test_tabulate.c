/* Rows of a table and what it is said to hold, from waves whose values, bounds and errors are written out
 * here. */
#include "host/emit/tabulate.h"

#include <math.h>
#include <string.h>

#include "hci/machine/frames.h"
#include "support/reference.h"
#include "unity.h"

enum { MOST = 600 };

static const hci_wave CONSTANT[2] = {{1.0, 1, 3.0, -4.0}, {5.0, -1, 0.0, 1.5}},
                      PER_NM[2] = {{1.0, 1, 0.8, 0.6}, {7.0, 1, -0.2, 0.1}};
static const double TORQUE_NM = 2.5;

static hci_tabulation t;
static float rows[(MOST + 1) * 6];
static hci_table_f32 table;

void setUp(void)
{
    t = (hci_tabulation){.constant = CONSTANT,
                         .per_Nm = PER_NM,
                         .constant_count = 2,
                         .per_Nm_count = 2,
                         .frame = HCI_TABLE_ABC,
                         .columns = 3,
                         .parts = 2,
                         .period_turns = 1,
                         .torque_Nm = TORQUE_NM};
}

void tearDown(void)
{
}

/* ---- what is in the waves ---- */

/* Whichever part the order stands in; in the rotor frame order n of sequence σ is n − σ. */
static void test_the_highest_order_is_of_both_parts(void)
{
    const hci_wave low[2] = {{1.0, 1, 1.0, 0.0}, {5.0, -1, 0.0, 1.0}},
                   high[2] = {{13.0, 1, 0.0, 1.0}, {11.0, -1, 1.0, 0.0}};
    for (int swapped = 0; swapped < 2; ++swapped) {
        t = (hci_tabulation){.constant = swapped ? high : low,
                             .per_Nm = swapped ? low : high,
                             .constant_count = 2,
                             .per_Nm_count = 2,
                             .frame = HCI_TABLE_ABC};
        TEST_ASSERT_EQUAL_DOUBLE(13.0, hci_tabulation_highest_seen(&t));
        TEST_ASSERT_EQUAL_DOUBLE(13.0, hci_tabulation_highest_order(&t));
        t.frame = HCI_TABLE_DQ;
        TEST_ASSERT_EQUAL_DOUBLE(12.0, hci_tabulation_highest_seen(&t));
        t.constant_count = t.per_Nm_count = 1;
        TEST_ASSERT_EQUAL_DOUBLE(12.0, hci_tabulation_highest_seen(&t));
        TEST_ASSERT_EQUAL_DOUBLE(13.0, hci_tabulation_highest_order(&t));
    }
    t = (hci_tabulation){.frame = HCI_TABLE_ABC};
    TEST_ASSERT_EQUAL_DOUBLE(0.0, hci_tabulation_highest_seen(&t));
    TEST_ASSERT_EQUAL_DOUBLE(1.0, hci_tabulation_highest_order(&t));
}

/* Amplitudes 5, 1.5 and 1, √0.05; orders 1, 5, 1, 7, in the rotor frame 0, 6, 0, 6. */
static void test_bounds(void)
{
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, 6.5 + 2.5 * (1.0 + sqrt(0.05)), hci_tabulation_bound_A(&t));
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, 5.0 + 25.0 * 1.5 + 2.5 * (1.0 + 49.0 * sqrt(0.05)),
                              hci_tabulation_bend_A(&t));
    t.frame = HCI_TABLE_DQ;
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, 36.0 * 1.5 + 2.5 * 36.0 * sqrt(0.05), hci_tabulation_bend_A(&t));
    TEST_ASSERT_EQUAL_DOUBLE(-9.0, hci_tabulation_order_seen(&t, &(hci_wave){-8.0, 1, 1.0, 0.0}));
}

static double wave_at(const hci_wave *w, double theta, int s)
{
    const double x = w->order * theta - w->sequence * 2.0 * REF_PI * s / 3.0;
    return w->sine * sin(x) + w->cosine * cos(x);
}

/* Phase currents of one part. */
static void part_by_hand(const hci_wave w[2], double theta, double abc[3])
{
    for (int s = 0; s < 3; ++s)
        abc[s] = wave_at(&w[0], theta, s) + wave_at(&w[1], theta, s);
}

/* d along cos θ, q along −sin θ of the amplitude-invariant transform. */
static void in_frame(const double abc[3], double theta, double out[3])
{
    memcpy(out, abc, 3 * sizeof *out);
    if (t.frame == HCI_TABLE_ABC) return;
    out[0] = out[1] = out[2] = 0.0;
    for (int s = 0; s < 3; ++s) {
        const hci_dq unit = hci_park(hci_clarke((double[3]){s == 0, s == 1, s == 2}), theta);
        out[0] += unit.d * abc[s];
        out[1] += unit.q * abc[s];
    }
}

static double exact_by_hand(double theta, double torque_Nm, double out[3])
{
    double constant[3], slope[3];
    part_by_hand(CONSTANT, theta, constant);
    part_by_hand(PER_NM, theta, slope);
    for (int s = 0; s < 3; ++s)
        constant[s] += torque_Nm * slope[s];
    in_frame(constant, theta, out);
    return fmax(fabs(constant[0]), fmax(fabs(constant[1]), fabs(constant[2])));
}

static void test_exact_currents(void)
{
    double most[3] = {0.0, 0.0, 0.0}; /* each phase is the largest somewhere */
    for (int frame = 0; frame < 2; ++frame)
        for (int k = 0; k < 50; ++k) {
            const uint32_t angle = (uint32_t)k * 85899345u;
            const double theta = 2.0 * REF_PI * angle / 4294967296.0, torque_Nm = 0.3 * k - 5.0;
            double found[3], expected[3], abc[3], phase_A;
            t.frame = frame ? HCI_TABLE_DQ : HCI_TABLE_ABC;
            hci_tabulation_exact(&t, angle, torque_Nm, found, &phase_A);
            TEST_ASSERT_DOUBLE_WITHIN(1e-11, exact_by_hand(theta, torque_Nm, expected), phase_A);
            for (int s = 0; s < 3; ++s) {
                TEST_ASSERT_DOUBLE_WITHIN(1e-11, expected[s], found[s]);
                abc[s] = fabs(expected[s]);
            }
            for (int s = 0; s < 3 && !frame; ++s)
                if (abc[s] >= phase_A - 1e-9) ++most[s];
            hci_tabulation_exact(&t, angle, torque_Nm, found, NULL);
            TEST_ASSERT_DOUBLE_WITHIN(1e-11, expected[1], found[1]);
        }
    TEST_ASSERT_TRUE(most[0] > 3 && most[1] > 3 && most[2] > 3);
}

/* Of both signs of the torque; over two turns where the period has two. */
static void test_peaks(void)
{
    for (int sign = -1; sign < 2; sign += 2) {
        const hci_wave constant = {1.0, 1, 2.0 * sign, 0.0}, per_Nm = {1.0, 1, 1.0, 0.0},
                       half = {0.5, 1, 3.0, 0.0};
        t.constant = &constant;
        t.per_Nm = &per_Nm;
        t.constant_count = t.per_Nm_count = 1;
        TEST_ASSERT_DOUBLE_WITHIN(1e-3, 4.5, hci_tabulation_peak_A(&t));
        t.parts = 1;
        t.torque_Nm = 0.0;
        TEST_ASSERT_DOUBLE_WITHIN(1e-3, 2.0, hci_tabulation_peak_A(&t));
        t.constant = &half;
        t.period_turns = 2;
        TEST_ASSERT_DOUBLE_WITHIN(1e-3, 3.0, hci_tabulation_peak_A(&t));
        setUp();
    }
}

static void test_rounding(void)
{
    TEST_ASSERT_EQUAL_DOUBLE(0.0, hci_tabulation_clean(0.99e-12));
    TEST_ASSERT_EQUAL_DOUBLE(0.0, hci_tabulation_clean(-0.99e-12));
    TEST_ASSERT_EQUAL_DOUBLE(1e-12, hci_tabulation_clean(1e-12));
    TEST_ASSERT_EQUAL_DOUBLE(-3.0, hci_tabulation_clean(-3.0));
    TEST_ASSERT_EQUAL_FLOAT(0.5f, hci_tabulation_round_up(0.5));
    TEST_ASSERT_TRUE(hci_tabulation_round_up(0.5) == 0.5f);
    TEST_ASSERT_TRUE(hci_tabulation_round_up(0.5 + 1e-12) == nextafterf(0.5f, 1.0f));
    TEST_ASSERT_TRUE(hci_tabulation_round_up(0.5 - 1e-12) == 0.5f);
}

/* ---- rows ---- */

static void use(hci_table_frame frame, size_t parts)
{
    t.frame = frame;
    t.columns = frame == HCI_TABLE_ABC ? 3 : 2;
    t.parts = parts;
    if (parts == 1) t.torque_Nm = 0.0;
}

/* Of each angle the current per N·m, and what does not depend on the torque behind it; the last row is the
 * first. */
static void test_rows(void)
{
    for (int k = 0; k < 4; ++k) {
        const size_t points = 37;
        setUp();
        use(k % 2 ? HCI_TABLE_DQ : HCI_TABLE_ABC, k < 2 ? 1 : 2);
        hci_tabulate(&t, points, rows, &table);
        for (size_t j = 0; j <= points; ++j) {
            const double theta = 2.0 * REF_PI * (double)(j % points) / (double)points;
            const float *row = rows + j * t.parts * t.columns;
            double abc[3], value[3];
            part_by_hand(PER_NM, theta, abc);
            in_frame(abc, theta, value);
            for (size_t c = 0; c < t.columns && t.parts == 2; ++c)
                TEST_ASSERT_FLOAT_WITHIN(1e-6f, (float)value[c], *row++);
            part_by_hand(CONSTANT, theta, abc);
            in_frame(abc, theta, value);
            for (size_t c = 0; c < t.columns; ++c)
                TEST_ASSERT_FLOAT_WITHIN(1e-6f, (float)value[c], *row++);
        }
        TEST_ASSERT_EQUAL(points, table.points);
        TEST_ASSERT_EQUAL(t.columns, table.columns);
        TEST_ASSERT_EQUAL(t.parts, table.parts);
        TEST_ASSERT_EQUAL(t.frame, table.frame);
        TEST_ASSERT_EQUAL(1, table.period_turns);
        TEST_ASSERT_EQUAL_FLOAT((float)t.torque_Nm, table.reference_torque_Nm);
    }
}

/* The largest error between two rows, and the largest phase current, at so many angles of both torques. */
static double worst_by_hand(size_t points, double *peak_A)
{
    double worst_A = 0.0;
    *peak_A = 0.0;
    for (size_t n = 0; n < 400 * points; ++n) {
        const size_t k = n / 400;
        const double part = (double)(n % 400) / 400.0, step = 2.0 * REF_PI / (double)points,
                     theta = step * ((double)k + part);
        for (int sign = -1; sign <= 1; sign += 2) {
            double a[3], b[3], x[3];
            (void)exact_by_hand(step * (double)k, sign * t.torque_Nm, a);
            (void)exact_by_hand(step * (double)(k + 1), sign * t.torque_Nm, b);
            *peak_A = fmax(*peak_A, exact_by_hand(theta, sign * t.torque_Nm, x));
            for (int s = 0; s < (int)t.columns; ++s)
                worst_A = fmax(worst_A, fabs(a[s] + part * (b[s] - a[s]) - x[s]));
        }
    }
    return worst_A;
}

/* What is stated holds at all angles, and is above the largest error by what is between the angles that are
 * looked at, 32 or more of each interval: δ²/8 of the bend, and 2⁻²¹ of the bound. */
static void test_the_error_that_is_stated(void)
{
    static const size_t POINTS[] = {3, 8, 29};
    for (int k = 0; k < 6; ++k) {
        const size_t points = POINTS[k % 3];
        double peak_A;
        setUp();
        use(k < 3 ? HCI_TABLE_ABC : HCI_TABLE_DQ, 2);
        hci_tabulate(&t, points, rows, &table);
        const double worst_A = worst_by_hand(points, &peak_A),
                     fine = fmax(32.0, ceil(64.0 * 7.0 / (double)points)),
                     step = 2.0 * REF_PI / ((double)points * fine),
                     margin_A = step * step / 8.0 * hci_tabulation_bend_A(&t) +
                                hci_tabulation_bound_A(&t) / 2097152.0;
        TEST_ASSERT_TRUE((double)table.max_error_A >= worst_A - 1e-5);
        TEST_ASSERT_DOUBLE_WITHIN(0.51 * margin_A, worst_A + 0.5 * margin_A, (double)table.max_error_A);
        TEST_ASSERT_DOUBLE_WITHIN(3e-3 * peak_A, peak_A, (double)table.peak_A);
    }
}

/* The fewest points whose table states no more: none with fewer does. */
static void test_the_fewest_points(void)
{
    static const double ERROR_A[] = {3.0, 0.8, 0.21, 0.05};
    for (int k = 0; k < 8; ++k) {
        size_t points = 1;
        setUp();
        use(k < 4 ? HCI_TABLE_ABC : HCI_TABLE_DQ, k % 2 ? 2 : 1);
        while (hci_tabulate(&t, points, rows, &table), (double)table.max_error_A > ERROR_A[k % 4])
            ++points;
        const float error_A = table.max_error_A;
        TEST_ASSERT_TRUE(hci_tabulate_within(&t, ERROR_A[k % 4], points, rows, &table));
        TEST_ASSERT_EQUAL(points, table.points);
        TEST_ASSERT_TRUE(error_A == table.max_error_A);
        TEST_ASSERT_FALSE(hci_tabulate_within(&t, ERROR_A[k % 4], points - 1, rows, &table));
    }
    TEST_ASSERT_FALSE(hci_tabulate_within(&t, 1e-9, 40, rows, &table));
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_the_highest_order_is_of_both_parts);
    RUN_TEST(test_bounds);
    RUN_TEST(test_exact_currents);
    RUN_TEST(test_peaks);
    RUN_TEST(test_rounding);
    RUN_TEST(test_rows);
    RUN_TEST(test_the_error_that_is_stated);
    RUN_TEST(test_the_fewest_points);
    return UNITY_END();
}
