/* How fast a shaft goes beside the pace of its part: over a window of rows, which is cut at both ends of the
 * recording. */
#include "host/recording/slow_turn.c"

#include "unity.h"

enum { ROWS = 21 };

static double time_s[ROWS], theta_rad[ROWS];
static hci_run run;
static part a;

/* Half a second for a row, an angle of its square: the speed between two rows is the sum of their times. */
void setUp(void)
{
    for (int k = 0; k < ROWS; ++k) {
        time_s[k] = 3.0 + 0.5 * k;
        theta_rad[k] = time_s[k] * time_s[k];
    }
    run = (hci_run){.count = ROWS, .time_s = time_s, .theta_m_rad = theta_rad};
    a = (part){.half = 4, .pace = -2.0};
}

void tearDown(void)
{
}

static void test_windows_of_rows(void)
{
    for (int k = 0; k < ROWS; ++k) {
        const int from = k > 4 ? k - 4 : 0, to = k + 4 < ROWS ? k + 4 : ROWS - 1;
        TEST_ASSERT_DOUBLE_WITHIN(1e-12, (time_s[from] + time_s[to]) / -2.0,
                                  relative_speed(&run, &a, (size_t)k));
    }
}

/* Where no time goes by, it goes on as in the rest. */
static void test_a_clock_that_stands(void)
{
    for (int k = 0; k < ROWS; ++k)
        time_s[k] = 1.0;
    TEST_ASSERT_EQUAL_DOUBLE(1.0, relative_speed(&run, &a, 10));
}

/* By as much as the pace may be away, and no more, of either sign. */
static void test_what_is_settled(void)
{
    const rows x = {.run = &run};
    for (int sign = -1; sign <= 1; sign += 2)
        for (int more = 0; more < 2; ++more) {
            a.pace = 16.0 / (1.0 + sign * 0.1); /* row 10 goes at 16 rad/s */
            a.away = more ? 0.0999 : 0.1001;
            TEST_ASSERT_EQUAL(!more, is_settled(&x, &a, 10));
        }
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_windows_of_rows);
    RUN_TEST(test_a_clock_that_stands);
    RUN_TEST(test_what_is_settled);
    return UNITY_END();
}
