/* The report of a tuning: its log and its torque without current read off their pictures, and the page with
 * what is said in it. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "host/draw/html.h"
#include "host/plot/plot.h"
#include "host/report/tune/page_tuning.h"
#include "support/pictures.h"
#include "support/reference.h"
#include "support/texts.h"
#include "support/written.h"
#include "unity.h"

enum { SAMPLES = 960, COLUMNS = 480 }; /* two samples in each column of the picture */

/* Coordinates are rounded to 0.01 pixel, those of the two ticks that make a scale too. */
#define PIXELS 0.05

static const hci_svg_box BOX = {70.0, 50.0, 970.0, 450.0};

static double time_s[SAMPLES], theta_m_rad[SAMPLES], speed_rad_per_s[SAMPLES], i_A[3 * SAMPLES],
    v_V[3 * SAMPLES], torque_Nm[SAMPLES];
static hci_run run;
static hci_tuning tuning;

/* From 5 s on, 3 turns in 1.92 s; the torque goes from 1 to 2 N·m, every second sample is 0.5 N·m more. */
void setUp(void)
{
    files_begin();
    for (int k = 0; k < SAMPLES; ++k) {
        const double share = (double)k / (SAMPLES - 1);
        time_s[k] = 5.0 + 1.92 * share;
        theta_m_rad[k] = 2.0 * REF_PI * 3.0 * share;
        speed_rad_per_s[k] = (100.0 + 50.0 * share) * REF_PI / 30.0;
        torque_Nm[k] = 1.0 + share + (k % 2 ? 0.5 : 0.0);
        for (int s = 0; s < 3; ++s) {
            i_A[3 * k + s] = 4.0 * sin(2.0 * theta_m_rad[k] - 2.0 * REF_PI * s / 3.0);
            v_V[3 * k + s] = s == 0 ? 10.0 + share : -3.0;
        }
    }
    memset(&run, 0, sizeof run);
    run.count = SAMPLES;
    run.pole_pairs = 2;
    run.time_s = time_s;
    run.theta_m_rad = theta_m_rad;
    run.i_A = i_A;
    run.torque_Nm = torque_Nm;
    run.torque_source = HCI_TORQUE_MEASURED;
    memset(&tuning, 0, sizeof tuning);
}

void tearDown(void)
{
    files_end();
}

static void draw(void (*panel)(hci_output *, const hci_svg_box *, const void *), const void *what)
{
    hci_output *out = written_begin("p.svg");
    hci_svg_begin(out, &(hci_svg_picture){"p", "t", "d", 0, 0, 1000, 500});
    panel(out, &BOX, what);
    hci_svg_end(out);
    picture_text = written_end(out, "p.svg");
    text_is_xml(picture_text);
    text_lacks("nan", picture_text);
}

/* ---- the log ---- */

/* The line goes up and down in each column, about its middle, between the least and the most of its samples.
 */
static void check_columns(double (*low)(int column), double (*high)(int column), double end)
{
    const picture_scale x = picture_scale_of("quiet middle", " x", 0.0),
                        y = picture_scale_of("quiet end", " y", 4.0);
    double at[2], next[2];
    for (int j = 0; j < COLUMNS; j += 37) {
        TEST_ASSERT_TRUE(picture_corner_of("after", 0, 2 * j, at) &&
                         picture_corner_of("after", 0, 2 * j + 1, next));
        TEST_ASSERT_DOUBLE_WITHIN(2.0 * fabs(PIXELS * x.slope), (j + 0.5) / COLUMNS * end,
                                  picture_value_at(x, at[0]));
        TEST_ASSERT_DOUBLE_WITHIN(0.001, at[0], next[0]);
        TEST_ASSERT_DOUBLE_WITHIN(2.0 * fabs(PIXELS * y.slope), j % 2 ? high(j) : low(j),
                                  picture_value_at(y, at[1]));
        TEST_ASSERT_DOUBLE_WITHIN(2.0 * fabs(PIXELS * y.slope), j % 2 ? low(j) : high(j),
                                  picture_value_at(y, next[1]));
    }
    TEST_ASSERT_FALSE(picture_corner_of("after", 0, 2 * COLUMNS, at));
}

static double share_of(int sample)
{
    return sample / (SAMPLES - 1.0);
}

static double first_turns(int column)
{
    return 3.0 * share_of(2 * column);
}

static double last_turns(int column)
{
    return 3.0 * share_of(2 * column + 1);
}

static double least_Nm(int column)
{
    return 1.0 + share_of(2 * column);
}

static double most_Nm(int column)
{
    return 1.5 + share_of(2 * column + 1);
}

static void test_angle_and_torque_over_the_time(void)
{
    draw(hci_plot_log, &run);
    TEST_ASSERT_EQUAL_INT(2, text_count("<polyline class=\"after\"", picture_text));
    text_has("Mechanical angle in turns", picture_text);
    text_has(">time in s</text>", picture_text);
    check_columns(first_turns, last_turns, 1.92);
    TEST_ASSERT_EQUAL_INT(2 * 60, text_count("<rect class=\"hit\"", picture_text));
    text_has("<g><title>16 ms: 0 to 0.04692</title>", picture_text); /* 16 samples are a strip */
    picture_text = strstr(picture_text, "Torque in N·m");
    check_columns(least_Nm, most_Nm, 1.92);
}

/* Without a time its samples, without an angle the speed and the current of a phase. */
static void test_other_logs(void)
{
    hci_plot_log_facts facts;
    hci_plot_log_ranges(&run, &facts);
    TEST_ASSERT_EQUAL_STRING("mechanical angle in turns", facts.position);
    TEST_ASSERT_EQUAL_STRING("torque in N·m", facts.signal);
    TEST_ASSERT_DOUBLE_WITHIN(1e-9, 0.0, facts.of_position.low);
    TEST_ASSERT_DOUBLE_WITHIN(1e-9, 3.0, facts.of_position.high);
    TEST_ASSERT_DOUBLE_WITHIN(1e-9, 1.0, facts.of_signal.low);
    TEST_ASSERT_DOUBLE_WITHIN(1e-9, 2.5, facts.of_signal.high);
    run.torque_source = HCI_TORQUE_HOLDING;
    hci_plot_log_ranges(&run, &facts); /* i_q of sines of 4 A */
    TEST_ASSERT_EQUAL_STRING("i_q in A", facts.signal);
    TEST_ASSERT_DOUBLE_WITHIN(1e-9, 4.0, facts.of_signal.low);
    TEST_ASSERT_DOUBLE_WITHIN(1e-9, 4.0, facts.of_signal.high);
    run.v_V = v_V;
    run.torque_source = HCI_TORQUE_NONE;
    hci_plot_log_ranges(&run, &facts);
    TEST_ASSERT_EQUAL_STRING("voltage of phase a in V", facts.signal);
    TEST_ASSERT_DOUBLE_WITHIN(1e-9, 10.0, facts.of_signal.low);
    TEST_ASSERT_DOUBLE_WITHIN(1e-9, 11.0, facts.of_signal.high);
    run.v_V = NULL;
    run.theta_m_rad = run.time_s = NULL;
    TEST_ASSERT_FALSE(hci_plot_log_can(&run));
    run.speed_rad_per_s = speed_rad_per_s;
    TEST_ASSERT_TRUE(hci_plot_log_can(&run));
    hci_plot_log_ranges(&run, &facts);
    TEST_ASSERT_EQUAL_STRING("speed in rpm", facts.position);
    TEST_ASSERT_EQUAL_STRING("i_a in A", facts.signal);
    TEST_ASSERT_DOUBLE_WITHIN(1e-9, 150.0, facts.of_position.high);
    TEST_ASSERT_DOUBLE_WITHIN(1e-3, -4.0, facts.of_signal.low);
    draw(hci_plot_log, &run);
    text_has(">sample</text>", picture_text);
    text_has("Speed in rpm", picture_text);
    text_has("<g><title>sample 7.992: ", picture_text); /* the middle of the first of 60 strips of 959 */
    run.count = 1;
    TEST_ASSERT_FALSE(hci_plot_log_can(&run));
}

/* ---- torque without current ---- */

static double open_Nm[HCI_TUNING_POINTS];
static hci_wave wave[1];
static hci_set set[1] = {HCI_SET_POS};
static hci_solved_order order[2];
static hci_solution solution;

/* 0.3 sin 2θ, to be read at the ends, the crests and between, with numbers wider than those of the others. */
static void fill_open(void)
{
    for (int k = 0; k < HCI_TUNING_POINTS; ++k)
        open_Nm[k] = 0.3 * sin(4.0 * REF_PI * k / (HCI_TUNING_POINTS - 1));
}

/* The plain sine makes 2.1 N·m with 0.5 N·m at order 6, the currents 0.3 N·m: twice of each from peak to
 * peak. */
static void solve(void)
{
    memset(order, 0, sizeof order);
    memset(&solution, 0, sizeof solution);
    wave[0] = hci_wave_polar(1.0, 1, 10.0, 0.4);
    order[0].target_Nm = order[0].torque_Nm = order[0].before_Nm = hci_harmonic_polar(0.0, 2.1, REF_PI / 2.0);
    order[1].before_Nm = hci_harmonic_polar(6.0, 0.5, 0.3);
    order[1].torque_Nm = hci_harmonic_polar(6.0, 0.3, 0.3);
    order[1].target_Nm = hci_harmonic_polar(6.0, 0.0, 0.0);
    solution.current = (hci_currents){wave, set, 1, 0};
    solution.per_Nm = wave;
    solution.order = order;
    solution.order_count = 2;
    solution.tolerance_Nm = 1e-3;
    solution.plain = wave[0];
    solution.plain_amplitude_A = 10.0;
    solution.loss_to_plain = 1.25;
    solution.peak_line_voltage_V = NAN;
    solution.period_turns = 1;
    solution.expected.state = HCI_RIPPLE_NO_RECORDINGS;
}

static void test_torque_without_current(void)
{
    const hci_plot_tuned tuned = {&solution, open_Nm, HCI_TUNING_POINTS};
    double at[2];
    fill_open();
    solve();
    draw(hci_plot_tuned_open, &tuned);
    const picture_scale x = picture_scale_of("quiet middle", " x", 0.0),
                        y = picture_scale_of("quiet end", " y", 4.0);
    for (int k = 0; k < HCI_TUNING_POINTS; k += 90) {
        TEST_ASSERT_TRUE(picture_corner_of("plain", 0, k, at));
        TEST_ASSERT_DOUBLE_WITHIN(2.0 * fabs(PIXELS * x.slope), 360.0 * k / (HCI_TUNING_POINTS - 1),
                                  picture_value_at(x, at[0]));
        TEST_ASSERT_DOUBLE_WITHIN(2.0 * fabs(PIXELS * y.slope), open_Nm[k], picture_value_at(y, at[1]));
    }
    text_has("electrical angle in degrees", picture_text);
    text_has("<title>45°: without current 0.3 N·m</title>", picture_text); /* of the eighth strip of 6° */
    TEST_ASSERT_EQUAL_INT(60, text_count("<rect class=\"hit\"", picture_text));
}

/* Of three turns that differ by less than is seen, one. */
static void test_turns_that_are_alike(void)
{
    const hci_plot_tuned tuned = {&solution, open_Nm, HCI_TUNING_POINTS};
    fill_open();
    solve();
    solution.period_turns = 3;
    draw(hci_plot_tuned_open, &tuned);
    text_has("degrees; 1 of 3 turns</text>", picture_text);
    text_has("<title>45°: ", picture_text);
    order[1].before_Nm = hci_harmonic_polar(17.0 / 3.0, 0.5, 0.3);
    order[1].torque_Nm = hci_harmonic_polar(17.0 / 3.0, 0.3, 0.3);
    draw(hci_plot_tuned_open, &tuned);
    text_has(">electrical angle in degrees</text>", picture_text);
    text_has(">1080</text>", picture_text);
}

/* The same angle at the same place, however wide the numbers of each are. */
static void test_one_angle(void)
{
    static void (*const PANEL[])(hci_output *, const hci_svg_box *, const void *) = {
        hci_plot_tuned_torque, hci_plot_tuned_open, hci_plot_tuned_dq};
    const hci_plot_tuned tuned = {&solution, open_Nm, HCI_TUNING_POINTS};
    picture_scale x[3];
    solve();
    solution.period_turns = 3;
    for (int k = 0; k < HCI_TUNING_POINTS; ++k)
        open_Nm[k] = 1e-7 * sin(12.0 * REF_PI * k / (HCI_TUNING_POINTS - 1)); /* numbers with an exponent */
    for (int k = 0; k < 3; ++k) {
        draw(PANEL[k], &tuned);
        x[k] = picture_scale_of("quiet middle", " x", 0.0);
        TEST_ASSERT_DOUBLE_WITHIN(1e-9, x[0].at, x[k].at);
        TEST_ASSERT_DOUBLE_WITHIN(1e-9, x[0].low, x[k].low);
        TEST_ASSERT_DOUBLE_WITHIN(1e-9, x[0].slope, x[k].slope);
    }
    TEST_ASSERT_TRUE(x[0].at > BOX.left + 1.0); /* the widest numbers take more room than there is */
}

/* ---- the page ---- */

static const char *page(void)
{
    hci_output *out = written_begin("report.html");
    hci_page_tuning(out, &tuning);
    const char *text = written_end(out, "report.html");
    text_is_xml(strstr(text, "<html"));
    text_tables_are_whole(text);
    text_lacks("nan", text);
    return text;
}

static void test_page_without_currents(void)
{
    static const char TABLE[] = "<caption>Extremes over the log</caption>";
    snprintf(tuning.verdict, sizeof tuning.verdict, "not tuned");
    snprintf(tuning.heading, sizeof tuning.heading, "The log does not tell <why>");
    snprintf(tuning.commands, sizeof tuning.commands, "hci-solve diagnose m\nhci-solve solve m\n");
    hci_tuning_say(&tuning, HCI_TUNING_READ, "%d samples", 960);
    hci_tuning_say(&tuning, HCI_TUNING_READ, "  of a bench");
    hci_tuning_say(&tuning, HCI_TUNING_READ, "%d samples", 960); /* said already */
    hci_tuning_say(&tuning, HCI_TUNING_READ, "  of a bench");    /* what is set in may be said twice */
    hci_tuning_say(&tuning, HCI_TUNING_NEXT, "a turn each way");
    TEST_ASSERT_EQUAL_STRING("960 samples\n  of a bench\n  of a bench\n", tuning.part[HCI_TUNING_READ]);
    tuning.log = &run;
    tuning.log_name = "bench.csv";
    const char *text = page();
    text_has("<h1>The log does not tell &#60;why&#62;</h1>", text);
    text_has("<h2>bench.csv as it was read: mechanical angle in turns, and torque in N·m</h2>", text);
    TEST_ASSERT_EQUAL_STRING("mechanical angle in turns 0 3 ", text_row(text, TABLE, 0));
    TEST_ASSERT_EQUAL_STRING("torque in N·m 1 2.5 ", text_row(text, TABLE, 1));
    text_has(">960 samples</p>", text);
    TEST_ASSERT_EQUAL_INT(2, text_count("<p class=\"of\">of a bench</p>", text));
    text_has("<h2>What to record next</h2>", text);
    text_has(">A turn each way</p>", text);
    text_lacks("What is not known", text);
    text_has(">hci-solve diagnose m</p>", text);
    text_has(">hci-solve solve m</p>", text);
    run.count = 1;
    text_lacks("as it was read", page());
}

static void test_ripple_that_is_known(void)
{
    double before_Nm, after_Nm;
    solve();
    hci_tuning_swing(&solution, &before_Nm, &after_Nm);
    TEST_ASSERT_DOUBLE_WITHIN(1e-3, 1.0, before_Nm);
    TEST_ASSERT_DOUBLE_WITHIN(1e-3, 0.6, after_Nm);
    TEST_ASSERT_TRUE(hci_tuning_knows_ripple(&solution));
    solution.tolerance_Nm = 1.1;
    TEST_ASSERT_FALSE(hci_tuning_knows_ripple(&solution));
}

static void test_page_with_currents(void)
{
    static const char OPEN[] = "aria-describedby=\"open-desc\"";
    char before[HCI_HTML_NUMBER_SIZE], after[HCI_HTML_NUMBER_SIZE], heading[256];
    double before_Nm, after_Nm;
    fill_open();
    solve();
    tuning.solution = &solution;
    tuning.open_Nm = open_Nm;
    tuning.log = &run;
    tuning.log_name = "bench.csv";
    tuning.good = true;
    hci_tuning_say(&tuning, HCI_TUNING_FOUND, "a line of what was found");
    const char *text = page();
    hci_tuning_swing(&solution, &before_Nm, &after_Nm);
    hci_html_quantity_text(before, before_Nm, "N·m");
    hci_html_quantity_text(after, after_Nm, "N·m");
    snprintf(heading, sizeof heading, "<h2>Over the turn a ripple of %s becomes one of %s in the model</h2>",
             before, after);
    text_has(heading, text);
    text_has("<h2>Without current the torque varies by 0.6 N·m</h2>", text);
    text_has("where a plain sine has ", text);
    TEST_ASSERT_EQUAL_STRING("without current −0.3 0.3 0.6 ",
                             text_row(strstr(text, OPEN), "<caption>Extremes over the period</caption>", 0));
    TEST_ASSERT_EQUAL_INT(3, text_count("<figure>", text));
    TEST_ASSERT_EQUAL_INT(3, text_count("<figcaption>", text));
    text_lacks("as it was read", text); /* the log is on another axis */
    text_has("<details><summary>What was found</summary>", text);
    TEST_ASSERT_TRUE(strstr(text, "id=\"torque-title\"") < strstr(text, "id=\"open-title\""));
    solution.tolerance_Nm = 0.7; /* the torque without current is below it */
    text_lacks("Without current the torque", page());
}

/* A sentence stands once: what a current loop makes of it is said above, and of effects that no current takes
 * away in what was found. */
static void test_nothing_is_said_twice(void)
{
    char reach[512];
    solve();
    solution.loop =
        (hci_loop_reach){.allowed_Nm = 0.1, .added_Nm = NAN, .rpm_per_Hz = 0.15, .lead_rpm_per_Hz = 0.7};
    hci_loop_reach_words(&solution.loop, reach, sizeof reach);
    TEST_ASSERT_TRUE(strlen(reach) > 20);
    hci_tuning_say(&tuning, HCI_TUNING_CAVEATS, "The figures are of currents that flow: %s", reach);
    hci_tuning_say(&tuning, HCI_TUNING_WANTED, "a torque without ripple");
    hci_note_add(&solution.remark, "a limit is given");
    hci_note_add(&solution.remark, "effects.csv: not compensated, since it acts on the shaft: friction");
    tuning.solution = &solution;
    const char *text = page();
    TEST_ASSERT_EQUAL_INT(1, text_count(reach, text));
    text_has("<p>a limit is given</p>", text);
    text_lacks("not compensated", text);
}

/* The bound is a band, a figure of the table and one of the numbers, the same in all three. */
static void test_bound_on_the_machine(void)
{
    solve();
    order[1].torque_Nm = order[1].target_Nm;
    solution.expected = (hci_expected_ripple){.state = HCI_RIPPLE_KNOWN,
                                              .peak_to_peak_Nm = 0.0621,
                                              .error_peak_to_peak_Nm = 0.0621,
                                              .T_ripple_percent = 2.957,
                                              .middle_percent = 2.0,
                                              .mean_Nm = 2.1,
                                              .mean_error_Nm = 0.00005,
                                              .worst_order = NAN,
                                              .worst_order_Nm = NAN,
                                              .unbelievable_order = NAN};
    solution.T_ripple_before_percent = 47.6;
    tuning.solution = &solution;
    tuning.table_Nm = 0.0123;
    const char *text = page();
    text_has("<td>at most 0.063 N·m<small>3 % of the mean (95 %)</small>", text);
    text_has("<small>at most 0.00005 N·m off (95 %)</small>", text);
    text_has("The band is 0.063 N·m high", text);
    text_has("<data value=\"0.0621\">0.0621</data>", text);
    text_has("becomes one of 0.0123 N·m in the model</h2>", text);
    TEST_ASSERT_EQUAL_INT(2, text_count("<polyline class=\"expected\"", text)); /* screen and telephone */
    text_has("<details><summary>What the bound on the machine is made of</summary>", text);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_angle_and_torque_over_the_time);
    RUN_TEST(test_other_logs);
    RUN_TEST(test_torque_without_current);
    RUN_TEST(test_turns_that_are_alike);
    RUN_TEST(test_one_angle);
    RUN_TEST(test_page_without_currents);
    RUN_TEST(test_ripple_that_is_known);
    RUN_TEST(test_page_with_currents);
    RUN_TEST(test_nothing_is_said_twice);
    RUN_TEST(test_bound_on_the_machine);
    return UNITY_END();
}
