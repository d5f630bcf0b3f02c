/* How motors of one make deviate, as a reader sees it: bars of how many there are in each quarter of a
 * standard deviation, marks beyond the limit, motors over their day, and all of it well-formed. */
#include "host/plot/fleet/plot_fleet.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "support/texts.h"
#include "support/written.h"
#include "unity.h"

enum { MOTORS = 9, PARAMETERS = 3, MOST = 32, DEPTH = 8 };

/* Coordinates are rounded to 0.01 pixel. */
#define PIXELS 0.02

static const double LEFT = 60.0, TOP = 40.0, RIGHT = 760.0, BOTTOM = 640.0;

static hci_line_motor motor[MOTORS];
static hci_line_parameter parameter[PARAMETERS];
static double value[MOTORS * PARAMETERS], std_error[MOTORS * PARAMETERS];
static hci_line line;
static const char *text;

void setUp(void)
{
    files_begin();
    memset(motor, 0, sizeof motor);
    memset(parameter, 0, sizeof parameter);
    for (size_t p = 0; p < PARAMETERS; ++p) {
        strcpy(parameter[p].name.effect, "effect");
        snprintf(parameter[p].name.parameter, sizeof parameter[p].name.parameter, "p%zu", p);
        strcpy(parameter[p].name.unit, "Nm");
        parameter[p].median = 10.0;
        parameter[p].scale = 2.0;
        parameter[p].motors = MOTORS;
    }
    for (size_t k = 0; k < MOTORS; ++k) {
        snprintf(motor[k].name, sizeof motor[k].name, "motor%zu", k);
        motor[k].worst = 0;
        motor[k].day = NAN;
        for (size_t p = 0; p < PARAMETERS; ++p)
            value[k * PARAMETERS + p] = 10.0;
    }
    line = (hci_line){.limit = 4.0,
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

static void draw(void (*plot)(hci_output *out, const hci_svg_box *box, const void *line))
{
    static char open[DEPTH][TEXT_TAG];
    const hci_svg_box box = {LEFT, TOP, RIGHT, BOTTOM};
    hci_output *out = written_begin("p.svg");
    int depth = 0;
    plot(out, &box, &line);
    text = written_end(out, "p.svg");
    for (const char *at = text; (at = strchr(at, '<')) != NULL;)
        at = text_tag(at, open, DEPTH, &depth);
    TEST_ASSERT_EQUAL(0, depth);
}

/* The numbers behind names of attributes, of each tag that begins so. */
static size_t numbers(const char *tag, const char *const *name, size_t names, double found[MOST][4])
{
    size_t count = 0;
    for (const char *at = text; (at = strstr(at, tag)) != NULL; ++count) {
        TEST_ASSERT_TRUE(count < MOST);
        for (size_t k = 0; k < names; ++k) {
            char mark[32];
            snprintf(mark, sizeof mark, " %s=\"", name[k]);
            at = strstr(at, mark);
            TEST_ASSERT_NOT_NULL(at);
            found[count][k] = strtod(at + strlen(mark), NULL);
        }
    }
    return count;
}

static size_t circles(const char *style, double found[MOST][4])
{
    static const char *const NAME[] = {"cx", "cy"};
    char tag[64];
    snprintf(tag, sizeof tag, "<circle class=\"%s\"", style);
    size_t count = 0;
    for (const char *at = strstr(text, tag); at != NULL; at = strstr(at + 1, tag), ++count)
        for (int k = 0; k < 2; ++k) {
            char mark[32];
            snprintf(mark, sizeof mark, " %s=\"", NAME[k]);
            found[count][k] = strtod(strstr(at, mark) + strlen(mark), NULL);
        }
    return count;
}

/* The second number behind the last place of a mark. */
static double number_of_last(const char *mark)
{
    const char *last = NULL;
    for (const char *at = text; (at = strstr(at, mark)) != NULL; ++at)
        last = at + strlen(mark);
    TEST_ASSERT_NOT_NULL(last);
    return strtod(strchr(last, ' '), NULL);
}

/* ---- distributions ---- */

static const double ROW = 200.0; /* pixels: 600 of three parameters */

/* 24 standard deviations are from 170 to 760. */
static double place(double deviation)
{
    return 170.0 + (deviation + 12.0) / 24.0 * 590.0;
}

/* Deviations of parameter 1: two in [0, 0.5), four in [−1, −0.5), one in [3.5, 4), and two beyond the limit.
 */
static void test_bars_and_marks(void)
{
    static const char *const NAME[] = {"x", "y", "width", "height"};
    static const double DEVIATION[MOTORS] = {0.0, 0.4, -0.6, -0.9, -1.0, -0.55, 4.0, 4.5, -7.0},
                        AT[] = {-1.0, 0.0, 4.0}, COUNT[] = {4.0, 2.0, 1.0};
    double bar[MOST][4], mark[MOST][4];
    parameter[0].motors = 1; /* one motor has no distribution */
    parameter[2].motors = 0;
    for (size_t k = 0; k < MOTORS; ++k)
        value[k * PARAMETERS + 1] = 10.0 + 2.0 * DEVIATION[k];
    motor[7].worst = 1;
    draw(hci_plot_distributions);
    const size_t first = numbers("<rect class=\"after\"", NAME, 4, bar) - 3; /* behind that of the legend */
    TEST_ASSERT_EQUAL(1, first);
    for (size_t k = 0; k < 3; ++k) {
        const double *b = bar[first + k], high = (ROW - 8.0) * COUNT[k] / 4.0;
        TEST_ASSERT_DOUBLE_WITHIN(PIXELS, place(AT[k]) + 0.5, b[0]);
        TEST_ASSERT_DOUBLE_WITHIN(PIXELS, place(AT[k] + 0.5) - 0.5, b[0] + b[2]);
        TEST_ASSERT_DOUBLE_WITHIN(PIXELS, TOP + 2.0 * ROW, b[1] + b[3]);
        TEST_ASSERT_DOUBLE_WITHIN(PIXELS, high, b[3]);
    }
    const size_t ring = circles("ring", mark) - 1;
    TEST_ASSERT_EQUAL(1, ring);
    TEST_ASSERT_DOUBLE_WITHIN(PIXELS, place(4.5), mark[ring][0]);
    TEST_ASSERT_DOUBLE_WITHIN(PIXELS, TOP + 1.5 * ROW + 3.0, mark[ring][1]);
    TEST_ASSERT_EQUAL(1, circles("before", mark));
    TEST_ASSERT_DOUBLE_WITHIN(PIXELS, place(-7.0), mark[0][0]);
    text_has("effect p1: median 10 N", text);
    text_has("standard deviation 2 N", text);
    text_lacks("effect p0", text);
    text_lacks("effect p2", text);
}

/* What is beyond twelve standard deviations lies at the edge, where the limit lets it. */
static void test_bars_at_the_edges(void)
{
    static const char *const NAME[] = {"x", "y", "width", "height"};
    double bar[MOST][4];
    line.limit = 50.0;
    parameter[0].motors = parameter[2].motors = 1;
    for (size_t k = 0; k < MOTORS; ++k)
        value[k * PARAMETERS + 1] = 10.0 + 2.0 * (k < 3 ? -30.0 : 40.0);
    draw(hci_plot_distributions);
    const size_t bars = numbers("<rect class=\"after\"", NAME, 4, bar);
    TEST_ASSERT_DOUBLE_WITHIN(PIXELS, place(-12.0) + 0.5, bar[bars - 2][0]);
    TEST_ASSERT_DOUBLE_WITHIN(PIXELS, 0.5 * (ROW - 8.0), bar[bars - 2][3]);
    TEST_ASSERT_DOUBLE_WITHIN(PIXELS, place(11.5) + 0.5, bar[bars - 1][0]);
    TEST_ASSERT_DOUBLE_WITHIN(PIXELS, ROW - 8.0, bar[bars - 1][3]);
}

/* ---- motors ---- */

/* Over their places, or over the days since that of the first one where all have one; heights are logarithms.
 */
static void test_motors_over_their_day(void)
{
    static const double DAY[MOTORS] = {100.0, 103.0, 101.0, 110.0, 104.0, 105.0, 106.0, 107.0, 109.0};
    double sound[MOST][4], odd[MOST][4];
    for (int by_day = 0; by_day < 2; ++by_day) {
        for (size_t k = 0; k < MOTORS; ++k) {
            motor[k].day = DAY[k];
            motor[k].deviation = (k % 2 ? -1.0 : 1.0) * pow(2.0, (double)k - 3.0);
            motor[k].stands_out = fabs(motor[k].deviation) > 4.0;
        }
        motor[2].worst = HCI_LINE_NONE; /* has no parameters */
        if (!by_day) motor[4].day = NAN;
        draw(hci_plot_motors);
        const size_t s = circles("before", sound) - 5, o = circles("ring", odd) - 3; /* behind the legend's */
        TEST_ASSERT_TRUE(s == 1 && o == 1);
        const size_t which[] = {0, 1, 3, 4, 5};
        const double scale =
            by_day ? (sound[s + 2][0] - sound[s][0]) / 10.0 : (sound[s + 2][0] - sound[s][0]) / 3.0;
        const double octave = (sound[s + 4][1] - sound[s][1]) / 5.0;
        TEST_ASSERT_TRUE(octave < -5.0 && scale > 5.0);
        for (size_t k = 0; k < 5; ++k) {
            const double at = by_day ? DAY[which[k]] - 100.0 : (double)which[k];
            TEST_ASSERT_DOUBLE_WITHIN(3.0 * PIXELS, sound[s][0] + scale * at, sound[s + k][0]);
            TEST_ASSERT_DOUBLE_WITHIN(3.0 * PIXELS, sound[s][1] + octave * (double)which[k], sound[s + k][1]);
        }
        for (size_t k = 0; k < 3; ++k) {
            const double at = by_day ? DAY[6 + k] - 100.0 : 6.0 + (double)k;
            TEST_ASSERT_DOUBLE_WITHIN(3.0 * PIXELS, sound[s][0] + scale * at, odd[o + k][0]);
            TEST_ASSERT_DOUBLE_WITHIN(5.0 * PIXELS, sound[s][1] + octave * (6.0 + (double)k), odd[o + k][1]);
        }
        text_has(by_day ? "days since" : "motors by their names", text);
        text_has("motor7: effect p0, -16.0 standard deviations", text);
        TEST_ASSERT_EQUAL(2, text_count("motor8", text)); /* told, and beside the mark */
        text_lacks("motor5", text);
        const double limit = number_of_last("<path class=\"limit\" d=\"M");
        TEST_ASSERT_DOUBLE_WITHIN(3.0 * PIXELS, sound[s + 4][1], limit); /* 4 is motor 5, too */
    }
}

/* Beside the mark stands as much of the end of a name as fits in 90 pixels. */
static void test_a_long_name(void)
{
    char shown[64] = "";
    snprintf(motor[3].name, sizeof motor[3].name, "%s", "of_the_second_batch_0123");
    motor[3].deviation = 8.0;
    motor[3].stands_out = true;
    draw(hci_plot_motors);
    const char *at = strstr(text, ">…");
    TEST_ASSERT_NOT_NULL(at);
    TEST_ASSERT_EQUAL(1, sscanf(at + 1, "%63[^<]", shown));
    TEST_ASSERT_TRUE(hci_svg_text_width("small", shown) <= 90.0);
    TEST_ASSERT_TRUE(hci_svg_text_width("small", shown) > 80.0);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_bars_and_marks);
    RUN_TEST(test_bars_at_the_edges);
    RUN_TEST(test_motors_over_their_day);
    RUN_TEST(test_a_long_name);
    return UNITY_END();
}
