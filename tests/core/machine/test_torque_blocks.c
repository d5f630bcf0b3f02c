/* What one wave of the back-EMF makes of one component, in closed form, against the sum over the phases. */
#include "core/machine/system.c"

#include "support/reference.h"
#include "unity.h"

void setUp(void)
{
}

void tearDown(void)
{
}

/* sin or cos of a component in phase s. */
static double current_at(hci_component c, bool is_cosine, int s, double theta)
{
    const double a = c.order * theta - c.sequence * 2.0 * REF_PI * s / 3.0;
    return is_cosine ? cos(a) : sin(a);
}

static double emf_at(const hci_wave *e, int s, double theta)
{
    const double a = e->order * theta - e->sequence * 2.0 * REF_PI * s / 3.0;
    return e->sine * sin(a) + e->cosine * cos(a);
}

static void compare(hci_wave e, hci_component c)
{
    torque_block block[2];
    const size_t count = pair_blocks(e, c, block);
    for (double theta = 0.1; theta < 6.0; theta += 0.7) {
        double torque[2] = {0.0, 0.0}, of_sine = 0.0, of_cosine = 0.0;
        for (int s = 0; s < 3; ++s)
            for (int is_cosine = 0; is_cosine < 2; ++is_cosine)
                torque[is_cosine] += emf_at(&e, s, theta) * current_at(c, is_cosine, s, theta);
        for (size_t k = 0; k < count; ++k) {
            const double sine = sin(block[k].order * theta), cosine = cos(block[k].order * theta);
            of_sine += block[k].sine_from_sine * sine + block[k].cosine_from_sine * cosine;
            of_cosine += block[k].sine_from_cosine * sine + block[k].cosine_from_cosine * cosine;
        }
        TEST_ASSERT_DOUBLE_WITHIN(1e-12, torque[0], of_sine);
        TEST_ASSERT_DOUBLE_WITHIN(1e-12, torque[1], of_cosine);
    }
}

/* Orders that are near each other too, as of slots and poles that are no multiples. */
static void test_blocks_against_phases(void)
{
    static const double order[] = {0.8, 0.9, 1.0, 1.1, 1.2, 1.3, 5.0, 7.0};
    for (size_t n = 0; n < sizeof order / sizeof *order; ++n)
        for (int of_emf = -1; of_emf <= 1; of_emf += 2)
            for (int sequence = -1; sequence <= 1; sequence += 2) {
                compare((hci_wave){1.0, of_emf, 0.7, -0.3}, (hci_component){order[n], sequence});
                compare((hci_wave){order[n], of_emf, 0.2, 0.9}, (hci_component){1.0, sequence});
            }
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_blocks_against_phases);
    return UNITY_END();
}
