/* The cone and its scaling: the laws that define them, at random points of orthants and second-order cones.
 */
#include "host/conic/scaling.h"

#include <math.h>

#include "support/reference.h"
#include "unity.h"

enum { ENTRIES = 2 + 2 + 4 + 3 + 2, CONES = 3, TRIALS = 300 };

static const size_t SIZE[CONES] = {2, 4, 3};
static const size_t AT[CONES] = {2, 4, 8};
static hci_cone cone;
static double s[ENTRIES], z[ENTRIES], w[ENTRIES], eta[CONES], point[ENTRIES];
static uint64_t seed;

void setUp(void)
{
    cone = (hci_cone){.linear = 2, .cones = CONES, .after = 2, .size = SIZE};
    seed = 21;
    TEST_ASSERT_EQUAL_UINT64(2 + CONES + 2, hci_cone_degree(&cone));
    TEST_ASSERT_EQUAL_UINT64(ENTRIES, cone.entries);
}

void tearDown(void)
{
}

static double side_of(size_t k, const double *u)
{
    double square = 0.0;
    for (size_t i = 1; i < SIZE[k]; ++i)
        square += u[AT[k] + i] * u[AT[k] + i];
    return sqrt(square);
}

/* Into the cone, as far as `depth` from its boundary in each part. */
static void draw(double *u, double depth)
{
    for (size_t i = 0; i < ENTRIES; ++i)
        u[i] = ref_uniform(&seed, -2.0, 2.0);
    for (size_t i = 0; i < ENTRIES; ++i)
        if (i < 2 || i >= ENTRIES - 2) u[i] = fabs(u[i]) + depth;
    for (size_t k = 0; k < CONES; ++k)
        u[AT[k]] = side_of(k, u) + depth + ref_uniform(&seed, 0.0, 1.0);
}

/* W z = W⁻¹ s = λ, W⁻¹ undoes W, and λ ∘ (what divides by λ) is what was divided. */
static void test_the_scaling(void)
{
    const hci_cone_scaling scaling = {&cone, w, eta, point};
    for (int trial = 0; trial < TRIALS; ++trial) {
        double of_s[ENTRIES], back[ENTRIES], quotient[ENTRIES];
        draw(s, 0.1);
        draw(z, 0.1);
        hci_cone_scale(&scaling, s, z);
        hci_cone_apply(&scaling, 1, s, of_s);
        hci_cone_apply(&scaling, 0, of_s, back);
        hci_cone_divide(&cone, point, z, quotient);
        hci_cone_product(&cone, point, quotient, back);
        for (size_t i = 0; i < ENTRIES; ++i) {
            TEST_ASSERT_DOUBLE_WITHIN(1e-11, point[i], of_s[i]);
            TEST_ASSERT_DOUBLE_WITHIN(1e-10, z[i], back[i]);
        }
        hci_cone_apply(&scaling, 0, of_s, back);
        for (size_t i = 0; i < ENTRIES; ++i)
            TEST_ASSERT_DOUBLE_WITHIN(1e-11, s[i], back[i]);
    }
}

/* As deep as it is, a vector comes to the boundary, and no part of it is outside. */
static void test_the_depth(void)
{
    for (int trial = 0; trial < TRIALS; ++trial) {
        double least = HUGE_VAL;
        draw(s, -1.0);
        hci_cone_add_unit(&cone, hci_cone_depth(&cone, s), s);
        for (size_t i = 0; i < ENTRIES; ++i)
            if (i < 2 || i >= ENTRIES - 2) least = fmin(least, s[i]);
        for (size_t k = 0; k < CONES; ++k)
            least = fmin(least, s[AT[k]] - side_of(k, s));
        TEST_ASSERT_DOUBLE_WITHIN(1e-14, 0.0, least);
    }
}

/* s + t ds, and the least of products of its parts with those of z + t dz as they are defined. */
static double least_product(const double *ds, const double *dz, double t)
{
    double moved[2][ENTRIES], least = HUGE_VAL;
    for (size_t i = 0; i < ENTRIES; ++i) {
        moved[0][i] = s[i] + t * ds[i];
        moved[1][i] = z[i] + t * dz[i];
        if (i < 2 || i >= ENTRIES - 2) least = fmin(least, fmax(0.0, moved[0][i]) * fmax(0.0, moved[1][i]));
    }
    for (size_t k = 0; k < CONES; ++k) {
        double product = 1.0;
        for (int of = 0; of < 2; ++of) {
            const double head = moved[of][AT[k]], side = side_of(k, moved[of]);
            product *= head > side ? sqrt(head * head - side * side) : 0.0;
        }
        least = fmin(least, product);
    }
    return least;
}

/* Just before the step's end both vectors are inside, just behind it one is outside. */
static void test_steps_and_products(void)
{
    int ended = 0;
    for (int trial = 0; trial < TRIALS; ++trial) {
        double ds[ENTRIES], dz[ENTRIES];
        draw(s, 0.1);
        draw(z, 0.1);
        for (size_t i = 0; i < ENTRIES; ++i) {
            ds[i] = ref_uniform(&seed, -0.5, 0.7);
            dz[i] = ref_uniform(&seed, -0.5, 0.7);
        }
        const double *const of_s[2] = {s, ds}, *const of_z[2] = {z, dz};
        const double step = hci_cone_step(&cone, z, dz, hci_cone_step(&cone, s, ds, 4.0));
        TEST_ASSERT_TRUE(step > 0.0 && step <= 4.0);
        for (int k = 0; k < 5; ++k) {
            const double t = step * (0.1 + 0.2 * k), expected = least_product(ds, dz, t);
            TEST_ASSERT_TRUE(expected > 0.0);
            TEST_ASSERT_DOUBLE_WITHIN(1e-12, expected, hci_cone_least_product(&cone, of_s, of_z, t));
        }
        if (step >= 4.0) continue;
        ++ended;
        TEST_ASSERT_EQUAL_DOUBLE(0.0, hci_cone_least_product(&cone, of_s, of_z, step * (1.0 + 1e-9)));
    }
    TEST_ASSERT_TRUE(ended > TRIALS / 2);
}

/* Along a ray of the cone, and away from its tip, no step ends; one toward the tip ends there: both roots of
 * its square are the same, and rounding leaves half of the digits. */
static void test_a_step_along_a_ray(void)
{
    for (int trial = 0; trial < TRIALS; ++trial) {
        const hci_cone alone = {.cones = 1, .size = SIZE + trial % CONES, .entries = SIZE[trial % CONES]};
        double *u = s + AT[trial % CONES];
        draw(s, 0.1);
        TEST_ASSERT_EQUAL_DOUBLE(1e6, hci_cone_step(&cone, s, s, 1e6));
        for (size_t i = 0; i < ENTRIES; ++i)
            z[i] = -2.0 * s[i];
        TEST_ASSERT_DOUBLE_WITHIN(1e-6, 0.5, hci_cone_step(&alone, u, z + AT[trial % CONES], 1e6));
    }
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_the_scaling);
    RUN_TEST(test_the_depth);
    RUN_TEST(test_steps_and_products);
    RUN_TEST(test_a_step_along_a_ray);
    return UNITY_END();
}
