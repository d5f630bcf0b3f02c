/* The page of a fleet whose figures are made up: sentences, tables, and the order in which motors stand
 * there. */
#include "host/report/fleet/page_fleet.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "host/plot/fleet/plot_fleet.h"
#include "support/pictures.h"
#include "support/texts.h"
#include "support/written.h"
#include "unity.h"

enum { MOTORS = 6, PARAMETERS = 2 };

static hci_line_motor motor[MOTORS];
static hci_line_parameter parameter[PARAMETERS];
static double value[MOTORS * PARAMETERS], std_error[MOTORS * PARAMETERS];
static hci_line line;
static const char *page;

static const char ODD[] = "<caption>Motors that stand out</caption>", ALL[] = "<caption>Parameters</caption>";

/* Motors m0 to m5; the third and the fifth stand out, by 6 and by −8 deviations of the first parameter; the
 * last one has no result. */
void setUp(void)
{
    files_begin();
    memset(motor, 0, sizeof motor);
    memset(parameter, 0, sizeof parameter);
    for (size_t k = 0; k < MOTORS; ++k) {
        snprintf(motor[k].name, sizeof motor[k].name, "m%zu", k);
        snprintf(motor[k].batch, sizeof motor[k].batch, "%s", k < 3 ? "A" : "B");
        snprintf(motor[k].date, sizeof motor[k].date, "2026-03-0%zu", k + 1);
        motor[k].day = (double)k;
        motor[k].state = k == 5 ? HCI_FLEET_FAILED : HCI_FLEET_DONE;
        motor[k].worst = k == 5 ? HCI_LINE_NONE : 0;
        motor[k].deviation = k == 2 ? 6.0 : k == 4 ? -8.0 : 0.5;
        motor[k].stands_out = k == 2 || k == 4;
        value[PARAMETERS * k] = 0.1 + 0.01 * motor[k].deviation;
        value[PARAMETERS * k + 1] = 0.02;
    }
    for (size_t p = 0; p < PARAMETERS; ++p) {
        hci_line_parameter *x = &parameter[p];
        const double f = p == 0 ? 1.0 : 0.5;
        snprintf(x->name.effect, sizeof x->name.effect, "%s", p == 0 ? "cogging" : "left");
        snprintf(x->name.parameter, sizeof x->name.parameter, "%s", p == 0 ? "sine_6" : "rms");
        snprintf(x->name.unit, sizeof x->name.unit, "%s", p == 0 ? "Nm" : "1");
        x->motors = 5;
        x->median = 0.1 * f;
        x->scale = 0.01 * f;
        x->low = 0.06 * f;
        x->high = 0.14 * f;
        x->outside = p == 0 ? 2 : 0;
        x->mean = 0.11 * f;
        x->mean_std_error = 0.003 * f;
        x->between = 0.007 * f;
        x->noise = 0.002 * f;
        x->per_day = x->per_day_std_error = x->batch_deviation = NAN;
    }
    line = (hci_line){.command = HCI_FLEET_DIAGNOSE,
                      .false_alarms = 0.01,
                      .limit = 4.0,
                      .motor = motor,
                      .motors = MOTORS,
                      .parameter = parameter,
                      .parameters = PARAMETERS,
                      .value = value,
                      .std_error = std_error};
}

void tearDown(void)
{
    files_end();
}

static void write_page(void)
{
    hci_output *out = written_begin("report.html");
    hci_page_fleet(out, &line);
    page = written_end(out, "report.html");
    text_is_xml(strstr(page, "<html"));
    text_tables_are_whole(page);
    text_lacks("nan", page);
}

/* The further out, the earlier. */
static void test_who_stands_out(void)
{
    write_page();
    text_has("<h1>2 of 6 motors stand out</h1>", page);
    text_has("badge bad\">Some stand out<", page);
    text_has("6 motors; 5 of them were fitted, 1 were not.", page);
    text_has("more than 4 robust standard deviations from the median of all", page);
    text_has("would, some 0.05 of these.", page);
    text_has(" 1 % would", page);
    TEST_ASSERT_EQUAL_INT(2, text_rows(page, ODD));
    TEST_ASSERT_EQUAL_STRING("m4 B 2026-03-05 cogging sine_6 0.02 0.1 Nm −8 ", text_row(page, ODD, 0));
    TEST_ASSERT_EQUAL_STRING("m2 A 2026-03-03 cogging sine_6 0.16 0.1 Nm 6 ", text_row(page, ODD, 1));
    text_has("Motors without a result", page);
    text_has("m5: failed", page);
    text_lacks("m4: done", page);
    motor[2].stands_out = false;
    write_page();
    text_has("<h1>1 of 6 motors stands out</h1>", page);
    motor[4].stands_out = false;
    motor[5].state = HCI_FLEET_DONE;
    write_page();
    text_has("<h1>0 of 6 motors stand out</h1>", page);
    text_has("badge good\">None stands out<", page);
    text_lacks("Motors without a result", page);
}

static void test_parameters(void)
{
    write_page();
    TEST_ASSERT_EQUAL_INT(2, text_rows(page, ALL));
    TEST_ASSERT_EQUAL_STRING("cogging sine_6 Nm 5 0.1 0.01 0.06 0.14 2 0.11 0.003 0.007 0.002 ",
                             text_row(page, ALL, 0));
    TEST_ASSERT_EQUAL_STRING("left rms 1 5 0.05 0.005 0.03 0.07 0 0.055 0.0015 0.0035 0.001 ",
                             text_row(page, ALL, 1));
    line.parameters = 0;
    write_page();
    text_lacks("How each parameter is distributed", page);
}

/* Of a month, and of batches; only where there is more than chance. */
static void test_what_changes(void)
{
    write_page();
    text_lacks("What changes over time", page);
    parameter[0].has_trend = parameter[0].has_batches = parameter[1].has_trend = true;
    parameter[0].per_day = 0.002;
    parameter[0].per_day_std_error = 0.0001;
    parameter[0].batch_deviation = 0.0125;
    parameter[0].batch_criterion = 5.0;
    parameter[1].per_day = -0.01;
    parameter[1].per_day_std_error = 0.001;
    write_page();
    text_has("What changes over time and from batch to batch", page);
    text_has("cogging sine_6 changes by 0.06 ± 0.003 Nm in 30 days.", page);
    text_has("left rms changes by -0.3 ± 0.03  in 30 days.", page);
    text_has("cogging sine_6 differs from batch to batch by 0.0125 Nm (standard deviation of the batches).",
             page);
    text_lacks("left rms differs", page);
}

/* The picture of two motors, one of which stands out: days apart, at the two ends of its range. */
static void test_motors_over_their_dates(void)
{
    const hci_svg_box box = {100.0, 50.0, 900.0, 250.0};
    line.motors = 2;
    motor[0].stands_out = true;
    motor[0].deviation = 6.0;
    motor[1].day = 40.0;
    hci_output *out = written_begin("p.svg");
    hci_svg_begin(out, &(hci_svg_picture){"p", "t", "d", 0, 0, 1000, 300});
    hci_plot_motors(out, &box, &line);
    hci_svg_end(out);
    picture_text = written_end(out, "p.svg");
    text_is_xml(picture_text);
    const char *odd = picture_behind("<g><title>m0: cogging sine_6, 6.0 standard deviations</title>", 0);
    const double first = picture_attribute(strstr(odd, "<circle class=\"ring\""), "cx");
    const char *sound =
        picture_behind("<circle class=\"before\"", text_count("<circle class=\"before\"", picture_text) - 1);
    TEST_ASSERT_TRUE(picture_attribute(sound, "cx") > first + 600.0);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_who_stands_out);
    RUN_TEST(test_parameters);
    RUN_TEST(test_what_changes);
    RUN_TEST(test_motors_over_their_dates);
    return UNITY_END();
}
