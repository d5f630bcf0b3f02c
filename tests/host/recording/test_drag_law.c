/* Drags of several runs: a friction in both directions is one, a constant load and another one in each run
 * are none. */
#include "host/recording/drag_law.h"

#include <math.h>

#include "support/least_squares.h"
#include "unity.h"

static hci_drag drag[8];
static size_t count;
static hci_drag_law law;

void setUp(void)
{
    count = 0;
}

void tearDown(void)
{
}

static void add(double speed, double drag_Nm)
{
    drag[count++] = (hci_drag){drag_Nm, (speed > 0.0) - (speed < 0.0), 1.0, speed, speed * fabs(speed)};
}

/* 20 mN·m, 1 mN·m·s/rad, and a load that is added. */
static void add_friction(double speed, double load_Nm)
{
    add(speed, (speed > 0.0 ? 0.02 : -0.02) + 1e-3 * speed + load_Nm);
}

static bool are_friction(void)
{
    bool is = false;
    TEST_ASSERT_TRUE(hci_drags_are_friction(drag, count, &is));
    return is;
}

static void test_friction(void)
{
    add_friction(3.0, 0.0);
    TEST_ASSERT_FALSE(are_friction()); /* one direction: a constant load looks the same */
    add_friction(12.0, 0.0);
    TEST_ASSERT_FALSE(are_friction());
    add_friction(-3.0, 0.0);
    TEST_ASSERT_TRUE(are_friction());
    add_friction(-12.0, 0.0);
    TEST_ASSERT_TRUE(are_friction());
}

static void test_loads(void)
{
    for (int k = 0; k < 4; ++k)
        add_friction(k < 2 ? 3.0 + 9.0 * k : 15.0 - 9.0 * k, 0.006); /* a weight */
    TEST_ASSERT_FALSE(are_friction());
    for (size_t k = 0; k < 4; ++k)
        drag[k].drag_Nm *= -1.0; /* drives */
    TEST_ASSERT_FALSE(are_friction());
    count = 0;
    for (int k = 0; k < 6; ++k)
        add(k % 2 ? -5.0 : 5.0, (k % 2 ? -0.02 : 0.02) * (1.0 + 0.4 * k)); /* another brake each time */
    TEST_ASSERT_FALSE(are_friction());
    count = 0;
    TEST_ASSERT_FALSE(are_friction());
}

/* Without any speed there is no law of it. */
static void test_a_shaft_that_stands(void)
{
    for (int k = 0; k < 4; ++k)
        drag[count++] = (hci_drag){k % 2 ? -0.02 : 0.02, k % 2 ? -1.0 : 1.0, 1.0, 0.0, 0.0};
    TEST_ASSERT_FALSE(are_friction());
}

static void test_law(void)
{
    add_friction(3.0, 1e-4);
    add_friction(-3.0, 1e-4);
    TEST_ASSERT_TRUE(hci_drag_law_find(drag, count, &law));
    TEST_ASSERT_EQUAL(1, law.terms);
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, 0.023, law.value[HCI_DRAG_COULOMB]);
    TEST_ASSERT_DOUBLE_WITHIN(1e-9, 1e-4, law.std_error[HCI_DRAG_COULOMB]); /* (1e-4² + 1e-4²)/1 over 2 */
    add_friction(12.0, 1e-4);
    add_friction(-12.0, 1e-4);
    TEST_ASSERT_TRUE(hci_drag_law_find(drag, count, &law));
    TEST_ASSERT_EQUAL(2, law.terms);
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, 0.02, law.value[HCI_DRAG_COULOMB]);
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, 1e-3, law.value[HCI_DRAG_VISCOUS]);
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, -0.032, hci_drag_law_at(&law, &drag[3]));
    TEST_ASSERT_TRUE(law.gain > 100.0);
}

/* Value and standard error of each of `terms` columns, and how much a law gains, by Gauss and Jordan. */
static void check_law(int terms)
{
    double a[3][7] = {{0.0}}, square = 0.0, left = 0.0;
    for (size_t r = 0; r < count; ++r) {
        const double column[3] = {drag[r].sign, drag[r].speed_rad_per_s, drag[r].square};
        square += drag[r].drag_Nm * drag[r].drag_Nm;
        for (int i = 0; i < terms; ++i) {
            a[i][2 * terms] += column[i] * drag[r].drag_Nm;
            for (int j = 0; j < terms; ++j)
                a[i][j] += column[i] * column[j];
        }
    }
    for (int i = 0; i < terms; ++i)
        a[i][terms + i] = 1.0;
    ref_reduce(&a[0][0], terms, 2 * terms + 1, 7);
    for (size_t r = 0; r < count; ++r) {
        const double column[3] = {drag[r].sign, drag[r].speed_rad_per_s, drag[r].square};
        double rest = drag[r].drag_Nm;
        for (int i = 0; i < terms; ++i)
            rest -= a[i][2 * terms] * column[i];
        left += rest * rest;
    }
    /* without a row to spare a tenth of the rms drag is the error */
    const double variance =
        count > (size_t)terms ? left / (double)(count - (size_t)terms) : 0.01 * square / (double)count;
    TEST_ASSERT_TRUE(hci_drag_law_find(drag, count, &law));
    TEST_ASSERT_EQUAL(terms, law.terms);
    for (int i = 0; i < terms; ++i) {
        TEST_ASSERT_DOUBLE_WITHIN(1e-8 * fabs(a[i][2 * terms]), a[i][2 * terms], law.value[i]);
        TEST_ASSERT_DOUBLE_WITHIN(1e-6 * law.std_error[i], sqrt(variance * a[i][terms + i]),
                                  law.std_error[i]);
    }
    const double gain = (square - left) / variance - terms * log(fmax(2.0, (double)count));
    TEST_ASSERT_DOUBLE_WITHIN(1e-6 * fabs(gain), gain, law.gain);
}

/* As many terms as there are speeds that differ by 15 %. */
static void test_terms_by_the_speeds(void)
{
    static const double SPEEDS[] = {4.0, 4.5, 4.65, 13.0, -14.5, 15.0, 40.0, -90.0};
    static const int TERMS[] = {1, 1, 1, 2, 2, 2, 3, 3};
    count = 0;
    for (int k = 0; k < 8; ++k) {
        const double speed = SPEEDS[k], sign = speed > 0.0 ? 1.0 : -1.0;
        add(speed, sign * 0.02 + 1e-3 * speed + 2e-6 * speed * fabs(speed) + 5e-4 * sin(7.0 * k));
        check_law(TERMS[k]);
    }
    count = 0;
    add(4.0, 0.02);
    add(4.8, 0.022);
    check_law(2);
}

/* A friction below 0 has too many terms. */
static void test_a_friction_below_0(void)
{
    count = 0;
    add(4.0, 0.01);
    add(-8.0, -0.03);
    add(12.0, 0.05);
    check_law(1);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_terms_by_the_speeds);
    RUN_TEST(test_a_friction_below_0);
    RUN_TEST(test_friction);
    RUN_TEST(test_loads);
    RUN_TEST(test_a_shaft_that_stands);
    RUN_TEST(test_law);
    return UNITY_END();
}
