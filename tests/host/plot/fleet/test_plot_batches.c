/* Means of batches as a reader sees them: which parameters are shown and in which order, and dots and bars by
 * the heights of others. */
#include "host/plot/fleet/plot_fleet.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "support/texts.h"
#include "support/written.h"
#include "unity.h"

enum { MOTORS = 10, PARAMETERS = 5, MOST_DOTS = 16 };

/* Coordinates are rounded to 0.01 pixel. */
#define PIXELS 0.02

static hci_line_motor motor[MOTORS];
static hci_line_parameter parameter[PARAMETERS];
static double value[MOTORS * PARAMETERS];
static hci_line line;

/* Batches C, A and B in this order, of 3, 4 and 2 motors; the last motor stands out. */
void setUp(void)
{
    static const char *const BATCH[] = {"C", "A", "C", "A", "B", "A", "C", "A", "B", "B"};
    files_begin();
    memset(motor, 0, sizeof motor);
    memset(parameter, 0, sizeof parameter);
    for (size_t k = 0; k < MOTORS; ++k) {
        strcpy(motor[k].batch, BATCH[k]);
        motor[k].stands_out = k == MOTORS - 1;
    }
    for (size_t p = 0; p < PARAMETERS; ++p) {
        strcpy(parameter[p].name.effect, "effect");
        snprintf(parameter[p].name.parameter, sizeof parameter[p].name.parameter, "p%zu", p);
        strcpy(parameter[p].name.unit, p == 1 ? "1" : "Nm");
    }
    for (size_t k = 0; k < MOTORS * PARAMETERS; ++k)
        value[k] = NAN;
    line = (hci_line){
        .motor = motor, .motors = MOTORS, .parameter = parameter, .parameters = PARAMETERS, .value = value};
}

void tearDown(void)
{
    files_end();
}

static void rank(size_t p, double trend, double batches)
{
    parameter[p].has_trend = trend > 0.0;
    parameter[p].per_day = -0.5 * trend;
    parameter[p].per_day_std_error = 0.5;
    parameter[p].has_batches = batches > 0.0;
    parameter[p].batch_criterion = batches;
}

/* ---- a picture, read ---- */

typedef struct {
    double x, y, low, high; /* of the dot, and the ends of its bar */
} dot;

static dot seen[MOST_DOTS];
static size_t dots;
static const char *text;

/* The number behind the next place of a mark, which *at goes on to. */
static double number_behind(const char **at, const char *mark)
{
    *at = strstr(*at, mark);
    TEST_ASSERT_NOT_NULL(*at);
    *at += strlen(mark);
    return strtod(*at, NULL);
}

static void draw(void)
{
    hci_output *out = written_begin("p.svg");
    const hci_svg_box box = {60.0, 40.0, 760.0, 640.0};
    hci_plot_batches(out, &box, &line);
    text = written_end(out, "p.svg");
    dots = 0;
    for (const char *at = text; (at = strstr(at, "class=\"edge\"")) != NULL; ++dots) {
        TEST_ASSERT_TRUE(dots < MOST_DOTS);
        dot *d = &seen[dots];
        (void)number_behind(&at, "d=\"M");
        d->low = number_behind(&at, " ");
        (void)number_behind(&at, "L");
        d->high = number_behind(&at, " ");
        d->x = number_behind(&at, "cx=\"");
        d->y = number_behind(&at, "cy=\"");
    }
}

/* ---- which are shown ---- */

static size_t place_of(const char *name)
{
    const char *at = strstr(text, name);
    return at ? (size_t)(at - text) : 0;
}

/* By the larger of trend over its error and the batches' criterion; three at most, and what is neither is
 * not. */
static void test_the_parameters_that_change_most(void)
{
    TEST_ASSERT_EQUAL(0, hci_plot_batches_count(&line));
    rank(0, 2.0, 0.0);
    TEST_ASSERT_EQUAL(1, hci_plot_batches_count(&line));
    rank(1, 0.0, 5.0);
    rank(3, 4.0, 3.0);
    TEST_ASSERT_EQUAL(3, hci_plot_batches_count(&line));
    for (size_t k = 0; k < MOTORS * PARAMETERS; ++k)
        value[k] = (double)(k % 7);
    draw();
    TEST_ASSERT_TRUE(0 < place_of("effect p1") && place_of("effect p1") < place_of("effect p3 in Nm") &&
                     place_of("effect p3") < place_of("effect p0 in Nm"));
    text_lacks("effect p1 in", text);
    text_lacks("effect p2", text);
    rank(4, 0.0, 4.5); /* the fourth leaves the least behind */
    TEST_ASSERT_EQUAL(3, hci_plot_batches_count(&line));
    draw();
    TEST_ASSERT_TRUE(place_of("effect p1") < place_of("effect p4") &&
                     place_of("effect p4") < place_of("effect p3"));
    text_lacks("effect p0", text);
    rank(4, 0.0, 1.0); /* the least of four */
    draw();
    text_lacks("effect p4", text);
    TEST_ASSERT_EQUAL(9, dots); /* three batches of each */
}

/* ---- dots and bars ---- */

/* Means of 4, 1 and 7, and twice the standard errors: of 2 and 6 and 4 that is 2·2/√3, of four of 1 it is
 * none, of 5 and 9 it is 2·√8/√2. */
static void test_means_and_their_errors(void)
{
    static const double VALUE[] = {2.0, 1.0, 6.0, 1.0, 5.0, 1.0, 4.0, 1.0, 9.0, 100.0};
    const double mean[] = {4.0, 1.0, 7.0}, half[] = {4.0 / sqrt(3.0), 0.0, 4.0};
    rank(2, 3.0, 0.0);
    for (size_t k = 0; k < MOTORS; ++k)
        value[k * PARAMETERS + 2] = VALUE[k];
    draw();
    TEST_ASSERT_EQUAL(3, dots);
    const double scale = (seen[0].y - seen[1].y) / (mean[0] - mean[1]); /* pixels for 1, upwards */
    TEST_ASSERT_TRUE(scale < -10.0);
    for (int k = 0; k < 3; ++k) {
        TEST_ASSERT_DOUBLE_WITHIN(3.0 * PIXELS, seen[0].y + scale * (mean[k] - mean[0]), seen[k].y);
        TEST_ASSERT_DOUBLE_WITHIN(3.0 * PIXELS, seen[k].y - scale * half[k], seen[k].low);
        TEST_ASSERT_DOUBLE_WITHIN(3.0 * PIXELS, seen[k].y + scale * half[k], seen[k].high);
        if (k > 0) TEST_ASSERT_DOUBLE_WITHIN(PIXELS, seen[1].x - seen[0].x, seen[k].x - seen[k - 1].x);
        TEST_ASSERT_TRUE(seen[k].high > 40.0 && seen[k].low < 640.0);
    }
    TEST_ASSERT_DOUBLE_WITHIN(PIXELS, seen[0].x + seen[2].x, 2.0 * seen[1].x);
    TEST_ASSERT_TRUE(place_of("C: ") < place_of("A: ") && place_of("A: ") < place_of("B: "));
    text_has("C: 4 N", text);
}

/* A batch with no value is not there; one with one has no bar. */
static void test_batches_without_values(void)
{
    rank(2, 3.0, 0.0);
    value[0 * PARAMETERS + 2] = 3.0; /* C */
    value[4 * PARAMETERS + 2] = 5.0; /* B */
    draw();
    TEST_ASSERT_EQUAL(2, dots);
    TEST_ASSERT_DOUBLE_WITHIN(PIXELS, seen[0].y, seen[0].low);
    TEST_ASSERT_DOUBLE_WITHIN(PIXELS, seen[0].y, seen[0].high);
    TEST_ASSERT_TRUE(seen[1].y < seen[0].y);
    text_lacks("A: ", text);
}

/* Rows of the same height, one below the other. */
static void test_rows_follow_each_other(void)
{
    for (size_t p = 0; p < 3; ++p)
        rank(p, 9.0 - (double)p, 0.0);
    for (size_t k = 0; k < MOTORS; ++k)
        for (size_t p = 0; p < 3; ++p)
            value[k * PARAMETERS + p] = (double)k;
    draw();
    TEST_ASSERT_EQUAL(9, dots);
    for (size_t k = 3; k < 6; ++k) /* the last one is 20 pixels higher */
        TEST_ASSERT_DOUBLE_WITHIN(PIXELS, 200.0, seen[k].y - seen[k - 3].y);
    TEST_ASSERT_TRUE(seen[6].y > seen[3].y + 190.0 && seen[0].y < 240.0 && seen[6].y > 440.0);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_the_parameters_that_change_most);
    RUN_TEST(test_means_and_their_errors);
    RUN_TEST(test_batches_without_values);
    RUN_TEST(test_rows_follow_each_other);
    return UNITY_END();
}
