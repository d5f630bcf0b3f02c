/* Progress with a clock of its own: the rate and the time that is left, what the line says, and when a
 * terminal gets it. */
#include <fcntl.h>
#include <math.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "cli/terminal/estimate.h"
#include "cli/terminal/progress.h"
#include "cli/terminal/say.h"
#include "cli/terminal/terminal.h"
#include "unity.h"

#define ERASE "\r\033[K"

static double now_s;

static double test_clock(void)
{
    return now_s;
}

/* ---- a terminal in place of standard error ---- */

static int master = -1, kept_stderr = -1;

static void open_terminal(void)
{
    int other;
    master = posix_openpt(O_RDWR | O_NOCTTY);
    if (master < 0 || grantpt(master) != 0 || unlockpt(master) != 0)
        TEST_IGNORE_MESSAGE("no pseudo-terminal");
    other = open(ptsname(master), O_RDWR | O_NOCTTY);
    kept_stderr = dup(STDERR_FILENO);
    TEST_ASSERT_TRUE(other >= 0 && dup2(other, STDERR_FILENO) >= 0);
    close(other);
}

/* What it got since the last time; "" for nothing. A byte of our own is written behind it and waited for,
 * since the system hands on what a terminal gets in its own time. */
static const char *screen(void)
{
    static char text[4096];
    size_t used = 0;
    fputc('\006', stderr);
    fflush(stderr);
    do {
        const ssize_t length = read(master, text + used, sizeof text - 1 - used);
        TEST_ASSERT_TRUE(length > 0);
        used += (size_t)length;
    } while (text[used - 1] != '\006');
    text[used - 1] = '\0';
    return text;
}

void setUp(void)
{
    now_s = 1000.0;
    cli_progress_use_clock(test_clock);
    cli_terminal_begin(false, false, CLI_COLOR_NEVER);
    setenv("TERM", "xterm", 1);
    setenv("LC_ALL", "C", 1);
    setenv("COLUMNS", "80", 1);
}

void tearDown(void)
{
    cli_progress_end();
    cli_progress_use_clock(NULL);
    if (kept_stderr >= 0) dup2(kept_stderr, STDERR_FILENO);
    if (kept_stderr >= 0) close(kept_stderr);
    if (master >= 0) close(master);
    master = kept_stderr = -1;
}

/* ---- the estimate ---- */

static void test_an_even_job_ends_when_it_should(void)
{
    cli_estimate e;
    cli_estimate_begin(&e, 0.0, 0.0);
    for (int k = 1; k <= 100; ++k) {
        cli_estimate_follow(&e, 0.2 * k, 0.01 * k);
        if (k < 3) continue; /* half a second and 2 % say something */
        TEST_ASSERT_DOUBLE_WITHIN(1e-9, 20.0 - 0.2 * k, cli_estimate_left_s(&e));
        TEST_ASSERT_DOUBLE_WITHIN(1e-12, 0.05, cli_estimate_share_per_s(&e));
    }
}

static void test_nothing_is_said_before_there_is_something_to_say(void)
{
    cli_estimate e;
    cli_estimate_begin(&e, 0.0, 0.0);
    cli_estimate_follow(&e, 0.49, 0.5);
    TEST_ASSERT_TRUE(isnan(cli_estimate_left_s(&e)));
    cli_estimate_begin(&e, 0.0, 0.0);
    cli_estimate_follow(&e, 5.0, 0.019);
    TEST_ASSERT_TRUE(isnan(cli_estimate_left_s(&e)));
    cli_estimate_follow(&e, 5.0, 0.02);
    TEST_ASSERT_DOUBLE_WITHIN(1e-9, 245.0, cli_estimate_left_s(&e));
}

/* By hand: at 1 s half is done, end 2 s. At 2 s 0.6 is done: the end would be 2 + 2·0.4/0.6 = 10/3 s, of
 * whose delay of 4/3 s a second of 1.5 s of settling takes 1 − exp(−1/1.5). */
static void test_the_end_moves_slowly_when_it_is_late(void)
{
    cli_estimate e;
    cli_estimate_begin(&e, 0.0, 0.0);
    cli_estimate_follow(&e, 1.0, 0.5);
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, 1.0, cli_estimate_left_s(&e));
    cli_estimate_follow(&e, 2.0, 0.6);
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, 4.0 / 3.0 * (1.0 - exp(-1.0 / 1.5)), cli_estimate_left_s(&e));
}

/* At 1 s a tenth, end 10 s; at 2 s half, end 4 s: 6 s nearer, with 0.5 s of settling. */
static void test_the_end_moves_fast_when_it_is_early(void)
{
    cli_estimate e;
    cli_estimate_begin(&e, 0.0, 0.0);
    cli_estimate_follow(&e, 1.0, 0.1);
    cli_estimate_follow(&e, 2.0, 0.5);
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, 10.0 - 6.0 * (1.0 - exp(-1.0 / 0.5)) - 2.0, cli_estimate_left_s(&e));
}

static void test_a_share_that_falls_begins_another_part(void)
{
    cli_estimate e;
    cli_estimate_begin(&e, 0.0, 0.0);
    cli_estimate_follow(&e, 10.0, 0.9);
    cli_estimate_follow(&e, 11.0, 0.1);
    TEST_ASSERT_TRUE(isnan(cli_estimate_left_s(&e)));
    cli_estimate_follow(&e, 13.0, 0.5); /* 0.4 in 2 s */
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, 0.2, cli_estimate_share_per_s(&e));
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, 2.5, cli_estimate_left_s(&e));
}

/* ---- the line ---- */

static cli_estimate half_of_two_minutes(void)
{
    cli_estimate e;
    cli_estimate_begin(&e, 0.0, 0.0);
    cli_estimate_follow(&e, 60.0, 0.5);
    return e;
}

static void check_line(const char *expected, const cli_work *work, int columns)
{
    const cli_estimate e = half_of_two_minutes();
    char line[256];
    cli_progress_text(&e, work, "solving", columns, line, sizeof line);
    TEST_ASSERT_EQUAL_STRING(expected, line);
}

/* Cells of the bar: columns less 7 of the name, 27 of figures and 22 of the rate, at most 30. */
static void test_the_line_gives_way_where_it_is_narrow(void)
{
    const cli_work work = {6.0, "s simulated"};
    check_line("solving ############             50 %  1:00, 1:00 left  0.05 s simulated/s", &work, 79);
    check_line("solving ##########            50 %  1:00, 1:00 left", &work, 54);
    check_line("solving  50 %  1:00, 1:00 left", &work, 38);
    check_line("solving  50 %", &work, 33);
}

static void test_the_rate_has_its_unit(void)
{
    const double totals[] = {0.12, 120.0, 12000.0, 120.0 * 2e4, 120.0 * 3e6};
    const char *const rates[] = {"0.001 x/s", "1 x/s", "100 x/s", "20 k x/s", "3 M x/s"};
    const cli_estimate e = half_of_two_minutes();
    char line[256];
    for (size_t k = 0; k < sizeof totals / sizeof totals[0]; ++k) {
        const cli_work work = {totals[k], "x"};
        cli_progress_text(&e, &work, "a", 100, line, sizeof line);
        TEST_ASSERT_EQUAL_STRING(rates[k], strstr(line, "left") + 6);
    }
    cli_progress_text(&e, NULL, "a", 100, line, sizeof line);
    TEST_ASSERT_EQUAL_STRING("0.83 %/s", strstr(line, "left") + 6);
}

/* ---- what the terminal gets ---- */

static void tell(double at_s, double share)
{
    now_s = 1000.0 + at_s;
    cli_progress(NULL, "searching", share);
}

static void test_a_second_is_silent_and_then_ten_lines_a_second(void)
{
    open_terminal();
    tell(0.0, 0.0);
    tell(0.99, 0.1);
    TEST_ASSERT_EQUAL_STRING("", screen());
    tell(1.0, 0.1);
    TEST_ASSERT_EQUAL_STRING(ERASE "searching ##                     10 %  0:01, 0:09 left  10 %/s",
                             screen());
    tell(1.05, 0.105);
    TEST_ASSERT_EQUAL_STRING("", screen());
    tell(1.1001, 0.11001);
    TEST_ASSERT_NOT_NULL(strstr(screen(), ERASE "searching ##"));
    cli_progress_end();
    TEST_ASSERT_EQUAL_STRING(ERASE, screen());
    cli_progress_end();
    TEST_ASSERT_EQUAL_STRING("", screen());
}

static void test_another_job_has_a_second_of_its_own(void)
{
    open_terminal();
    tell(0.0, 0.0);
    tell(2.0, 0.5);
    cli_progress_end();
    screen();
    tell(2.5, 0.0);
    tell(3.4, 0.5);
    TEST_ASSERT_EQUAL_STRING("", screen());
}

static void test_an_error_stands_in_place_of_the_line(void)
{
    const hci_note note = {"no such thing"};
    open_terminal();
    tell(0.0, 0.0);
    tell(2.0, 0.5);
    screen();
    TEST_ASSERT_EQUAL_INT(3, cli_fail(HCI_ERROR_INPUT, &note));
    TEST_ASSERT_EQUAL_STRING(ERASE "hci-solve: no such thing\r\n", screen());
}

static void test_json_leaves_it_and_quiet_does_not(void)
{
    open_terminal();
    cli_terminal_begin(false, true, CLI_COLOR_AUTO);
    tell(0.0, 0.0);
    tell(2.0, 0.5);
    TEST_ASSERT_NOT_NULL(strstr(screen(), "searching"));
    cli_progress_end();
    screen();
    cli_terminal_begin(true, false, CLI_COLOR_AUTO);
    tell(3.0, 0.0);
    tell(5.0, 0.5);
    TEST_ASSERT_EQUAL_STRING("", screen());
}

static void test_a_dumb_terminal_gets_none(void)
{
    open_terminal();
    setenv("TERM", "dumb", 1);
    tell(0.0, 0.0);
    tell(2.0, 0.5);
    TEST_ASSERT_EQUAL_STRING("", screen());
}

static void test_blocks_where_the_locale_has_them(void)
{
    open_terminal();
    setenv("LC_ALL", "C.UTF-8", 1);
    tell(0.0, 0.0);
    tell(2.0, 0.5);
    TEST_ASSERT_NOT_NULL(strstr(screen(), "searching ██████████▌            50 %  0:02, 0:02 left  25 %/s"));
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_an_even_job_ends_when_it_should);
    RUN_TEST(test_nothing_is_said_before_there_is_something_to_say);
    RUN_TEST(test_the_end_moves_slowly_when_it_is_late);
    RUN_TEST(test_the_end_moves_fast_when_it_is_early);
    RUN_TEST(test_a_share_that_falls_begins_another_part);
    RUN_TEST(test_the_line_gives_way_where_it_is_narrow);
    RUN_TEST(test_the_rate_has_its_unit);
    RUN_TEST(test_a_second_is_silent_and_then_ten_lines_a_second);
    RUN_TEST(test_another_job_has_a_second_of_its_own);
    RUN_TEST(test_an_error_stands_in_place_of_the_line);
    RUN_TEST(test_json_leaves_it_and_quiet_does_not);
    RUN_TEST(test_a_dumb_terminal_gets_none);
    RUN_TEST(test_blocks_where_the_locale_has_them);
    return UNITY_END();
}
