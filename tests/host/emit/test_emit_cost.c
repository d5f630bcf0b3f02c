/* The instructions of each kind of table: more for more parts and a higher degree, and in their sums those
 * that were counted. */
#include "host/emit/cost.h"

#include "unity.h"

void setUp(void)
{
}

void tearDown(void)
{
}

static hci_emit_choice cost(hci_emit_format format, int shape, hci_table_frame frame, size_t parts)
{
    const hci_tabulation t = {.frame = frame, .parts = parts};
    hci_emit_choice c = {.format = format, .shape = (hci_emit_shape)((int)HCI_EMIT_LINEAR + shape)};
    hci_emit_cost(&t, &c);
    return c;
}

/* Sums weighted by 1, 2, 3 … in the order frame, parts, degree, so that none of the numbers is for another.
 */
static void test_sums_of_what_was_counted(void)
{
    static const struct {
        hci_emit_format format;
        int shapes;
        unsigned m4f, m0_plus;
    } CASE[] = {{HCI_EMIT_F32, 1, 402, 14793},
                {HCI_EMIT_I16, 3, 6254, 84031},
                {HCI_EMIT_Q15, 3, 6188, 11642},
                {HCI_EMIT_I8, 3, 6690, 12413}};
    static const hci_table_frame FRAME[] = {HCI_TABLE_ABC, HCI_TABLE_DQ};
    for (size_t k = 0; k < sizeof CASE / sizeof CASE[0]; ++k) {
        unsigned m4f = 0, m0_plus = 0, weight = 0;
        for (int frame = 0; frame < 2; ++frame)
            for (size_t parts = 1; parts <= 2; ++parts)
                for (int shape = 0; shape < CASE[k].shapes; ++shape) {
                    const hci_emit_choice c = cost(CASE[k].format, shape, FRAME[frame], parts);
                    ++weight;
                    m4f += weight * c.cortex_m4f;
                    m0_plus += weight * c.cortex_m0_plus;
                    TEST_ASSERT_TRUE(c.cortex_m4f < c.cortex_m0_plus);
                    TEST_ASSERT_TRUE(shape == 0 ||
                                     cost(CASE[k].format, shape - 1, FRAME[frame], parts).cortex_m4f <
                                         c.cortex_m4f);
                    TEST_ASSERT_TRUE(parts == 1 ||
                                     cost(CASE[k].format, shape, FRAME[frame], 1).cortex_m0_plus <
                                         c.cortex_m0_plus);
                    TEST_ASSERT_TRUE(frame == 0 ||
                                     c.cortex_m4f <
                                         cost(CASE[k].format, shape, HCI_TABLE_ABC, parts).cortex_m4f);
                }
        TEST_ASSERT_EQUAL_UINT(CASE[k].m4f, m4f);
        TEST_ASSERT_EQUAL_UINT(CASE[k].m0_plus, m0_plus);
    }
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_sums_of_what_was_counted);
    return UNITY_END();
}
