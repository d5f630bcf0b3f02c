/* The pictures of a sweep, read as a reader does: cells, dots and lines by the scale of their axes, colours
 * by the numbers of the legend, and what is told under the pointer. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "host/plot/sweep/plot_sweep.h"
#include "support/grid_by_hand.h"
#include "support/pictures.h"
#include "support/texts.h"
#include "support/written.h"
#include "unity.h"

/* Coordinates are rounded to 0.01 pixel, those of the two ticks that make a scale too. */
#define PIXELS 0.05

void setUp(void)
{
    files_begin();
}

void tearDown(void)
{
    files_end();
}

static void begin_and_end(void (*draw)(hci_output *, const hci_grid *), const hci_grid *s)
{
    hci_output *out = written_begin("p.svg");
    draw(out, s);
    picture_text = written_end(out, "p.svg");
    text_is_xml(picture_text);
    text_lacks("nan", picture_text);
}

static void draw_panel(void (*draw)(hci_output *, const hci_svg_box *, const void *), const hci_svg_box *box,
                       const hci_grid *s)
{
    hci_output *out = written_begin("p.svg");
    hci_svg_begin(out, &(hci_svg_picture){"p", "t", "d", 0, 0, 1000, 1000});
    draw(out, box, s);
    hci_svg_end(out);
    picture_text = written_end(out, "p.svg");
    text_is_xml(picture_text);
}

/* ---- maps ---- */

/* Point k of panel n: what is told, and the cell behind it. Returns its style. */
static const char *cell(int panel, int k, const char **told, double at[4])
{
    static char style[16];
    const char *tell = picture_behind("<g><title>", 6 * panel + k), *rect = strstr(tell, "<rect class=\"");
    static const char *const NAME[] = {" x", " y", "width", "height"};
    for (int j = 0; j < 4; ++j)
        at[j] = picture_attribute(rect, NAME[j]);
    snprintf(style, sizeof style, "%.*s", (int)strcspn(rect + 13, "\""), rect + 13);
    *told = tell;
    return style;
}

/* Speeds meet at 50, 150, 300 and 500 rpm, torques at 0, 2 and 4 N·m: halfway to the neighbours. */
static void test_cells_of_a_map_meet_halfway(void)
{
    static const double X[] = {50.0, 150.0, 300.0, 500.0}, Y[] = {0.0, 2.0, 4.0};
    const hci_grid s = grid_map();
    begin_and_end(hci_plot_map, &s);
    for (int panel = 0; panel < 5; ++panel)
        for (int k = 0; k < 6; ++k) {
            const double left = 70.0 + 434.0 * (panel % 3), top = 112.0 + 374.0 * (panel / 3);
            double at[4];
            const char *told;
            cell(panel, k, &told, at);
            TEST_ASSERT_DOUBLE_WITHIN(PIXELS, left + 350.0 * (X[k % 3] - 50.0) / 450.0, at[0]);
            TEST_ASSERT_DOUBLE_WITHIN(PIXELS, 350.0 * (X[k % 3 + 1] - X[k % 3]) / 450.0, at[2]);
            TEST_ASSERT_DOUBLE_WITHIN(PIXELS, top + 236.0 * (1.0 - Y[k / 3 + 1] / 4.0), at[1]);
            TEST_ASSERT_DOUBLE_WITHIN(PIXELS, 118.0, at[3]);
        }
    text_has("<svg xmlns=\"http://www.w3.org/2000/svg\"", picture_text);
    text_has("Grey: the mean torque is not reached within the limits;", picture_text);
    text_lacks("Drawn: the points with a dc link", picture_text);
}

/* The number beside colour n of a panel's legend; NAN where there was no room for it. */
static double level_of(int panel, int n)
{
    char key[40];
    snprintf(key, sizeof key, "<rect class=\"heat%d\"", n);
    const double left = 70.0 + 434.0 * (panel % 3), top = 112.0 + 374.0 * (panel / 3) + 236.0 + 46.0;
    for (const char *at = strstr(picture_text, key); at; at = strstr(at + 1, key)) {
        if (fabs(picture_attribute(at, " x") - left - 35.0 * n) > 0.01 ||
            fabs(picture_attribute(at, " y") - top) > 0.01)
            continue;
        TEST_ASSERT_DOUBLE_WITHIN(0.011, 35.0, picture_attribute(at, "width"));
        TEST_ASSERT_DOUBLE_WITHIN(0.011, 10.0, picture_attribute(at, "height"));
        const char *next = strchr(at, '>') + 2;
        if (strncmp(next, "<text class=\"small quiet\"", 25) != 0) return NAN;
        TEST_ASSERT_DOUBLE_WITHIN(0.011, picture_attribute(at, " x"), picture_attribute(next, " x"));
        return strtod(strchr(next, '>') + 1, NULL);
    }
    TEST_FAIL_MESSAGE("a colour is not in the legend");
    return NAN;
}

/* A cell has the colour of the last number that it reaches; grey where the torque is not reached. */
static void test_colours_of_a_map(void)
{
    static const double PER_POINT[] = {2.0, 15.0, 7.0, 11.0}; /* ripple; R·mean square; peak; line voltage */
    const hci_grid s = grid_map();
    begin_and_end(hci_plot_map, &s);
    for (int panel = 0; panel < 4; ++panel)
        for (int k = 0; k < 6; ++k) {
            const char *told;
            double at[4];
            const char *style = cell(panel, k, &told, at);
            if (k >= 4) {
                TEST_ASSERT_EQUAL_STRING("band", style);
                continue;
            }
            const int colour = atoi(style + strlen("heat"));
            const double value = PER_POINT[panel] * (k + 1), from = level_of(panel, colour);
            TEST_ASSERT_TRUE(isnan(from) || value > 0.999 * from);
            const double to = colour < 9 ? level_of(panel, colour + 1) : HUGE_VAL;
            TEST_ASSERT_TRUE(isnan(to) || value < 1.001 * to);
            TEST_ASSERT_TRUE(k < 3 || colour >= 4); /* the largest is far up the scale */
        }
    for (int n = 2; n < 10; ++n) /* ripple in steps of 1, 2, 5; the others in equal ones */
        TEST_ASSERT_TRUE(fabs(level_of(0, n) / level_of(0, n - 1) - 2.0) < 0.01 ||
                         fabs(level_of(0, n) / level_of(0, n - 1) - 2.5) < 0.01);
    TEST_ASSERT_TRUE(28.0 <
                     level_of(2, 8) + 2.0 * (level_of(2, 8) - level_of(2, 7))); /* the scale holds it */
    TEST_ASSERT_EQUAL_DOUBLE(0.0, level_of(0, 0));
    TEST_ASSERT_DOUBLE_WITHIN(1e-9, 5.0,
                              level_of(0, 9)); /* below 8 %, the largest, with its step of 1, 2, 5 */
    TEST_ASSERT_DOUBLE_WITHIN(1e-9, level_of(2, 2) - level_of(2, 1), level_of(2, 3) - level_of(2, 2));
}

/* The number beside colour n of panel 2, the peak current, as it is written. */
static void check_level_text(int n, const char *expected)
{
    char key[80];
    snprintf(key, sizeof key, "<text class=\"small quiet\" x=\"%.2f\" y=\"416.00\">%s</text>",
             70.0 + 2.0 * 434.0 + 35.0 * n, expected);
    text_has(key, picture_text);
}

/* Ripple from 0.02 to 10 % is written as it is; peaks up to a million have one notation, of the largest
 * number in the legend and as fine as their steps. */
static void test_numbers_of_a_legend(void)
{
    static const double PEAK_A[] = {5.5e5, 7e5, 8e5, 1e6};
    const hci_grid s = grid_map();
    for (size_t k = 0; k < 4; ++k)
        grid_row[k].best.peak_A = PEAK_A[k];
    grid_row[3].best.T_ripple_percent = 19.0;
    begin_and_end(hci_plot_map, &s);
    check_level_text(0, "0.55e6");
    check_level_text(2, "0.65e6");
    check_level_text(8, "0.95e6");
    text_has(">0.02</text>", picture_text);
    text_has(">10</text>", picture_text);
    text_lacks("0.020<", picture_text);
    text_lacks("heat10", picture_text);
}

static void test_limits_and_words_of_a_map(void)
{
    static const char *const KIND[] = {"kind0", "kind1", "kind3", "kind5", "kind2", "band"};
    static const char *const TOLD[] = {"100 rpm, 1 N·m: 2 %; reached<", "200 rpm, 1 N·m: 30 W; reached<",
                                       "400 rpm, 1 N·m: 21 A; ripple<", "100 rpm, 3 N·m: 44 V; ripple<",
                                       "200 rpm, 3 N·m: rms; torque<",  "400 rpm, 3 N·m: no limit; failed<"};
    const hci_grid s = grid_map();
    const char *told;
    double at[4];
    begin_and_end(hci_plot_map, &s);
    for (int k = 0; k < 6; ++k) {
        TEST_ASSERT_EQUAL_STRING(KIND[k], cell(4, k, &told, at));
        cell(k < 4 ? k : 4, k, &told, at);
        TEST_ASSERT_EQUAL_STRING_LEN(TOLD[k], told, strlen(TOLD[k]));
    }
    cell(4, 3, &told, at);
    TEST_ASSERT_EQUAL_STRING_LEN("100 rpm, 3 N·m: current+copper; ripple<", told, 40);
    text_has(">none</text>", picture_text);
    text_has(">several</text>", picture_text);
    text_lacks(">copper</text>", picture_text); /* by itself it binds nowhere */
    text_has("Copper loss in W", picture_text);
    grid_machine.resistance_ohm = NAN;
    begin_and_end(hci_plot_map, &s);
    text_has("Mean of i", picture_text);
    cell(1, 1, &told, at);
    text_has("200 rpm, 1 N·m: 60 A²; reached<", told);
}

/* Of several dc links the first is drawn, and that is told. */
static void test_one_link_of_a_map(void)
{
    const hci_grid s = grid_map();
    for (int k = 0; k < 6; ++k)
        grid_point[k].link_V = k < 3 ? 24.0 : 48.0;
    begin_and_end(hci_plot_map, &s);
    TEST_ASSERT_EQUAL_INT(5 * 3, text_count("<g><title>", picture_text));
    text_has("Drawn: the points with a dc link of 24 V.", picture_text);
}

/* The n-th strip that tells under the pointer: so wide about a place, and as high as its box. */
static void check_strip(int n, double x, double width, const hci_svg_box *box)
{
    const char *at = picture_behind("<rect class=\"hit\"", n);
    TEST_ASSERT_DOUBLE_WITHIN(PIXELS, x - 0.5 * width, picture_attribute(at, " x"));
    TEST_ASSERT_DOUBLE_WITHIN(PIXELS, width, picture_attribute(at, "width"));
    TEST_ASSERT_DOUBLE_WITHIN(PIXELS, box->top, picture_attribute(at, " y"));
    TEST_ASSERT_DOUBLE_WITHIN(PIXELS, box->bottom - box->top, picture_attribute(at, "height"));
}

/* ---- ripple against the limits ---- */

typedef void panel_of(hci_output *, const hci_svg_box *, const void *);

static void check_dots(panel_of *draw, size_t from, size_t to, double value_of(const hci_grid_figures *),
                       bool of_copper)
{
    const hci_svg_box box = {70.0, 106.0, 490.0, 380.0};
    const hci_grid s = grid_trade_off();
    draw_panel(draw, &box, &s);
    const picture_scale x = picture_scale_of("quiet middle", " x", 0.0),
                        y = picture_scale_of("quiet end", " y", 4.0);
    int dot = 0;
    for (size_t k = from; k < to; ++k) {
        if (grid_row[k].verdict > HCI_GRID_RIPPLE) continue;
        const double limit = of_copper ? grid_point[k].limit_copper : grid_point[k].limit_current_A;
        const char *at = picture_behind("<circle class=\"dot\"", dot);
        check_strip(dot++, picture_attribute(at, "cx"), 8.0, &box);
        TEST_ASSERT_DOUBLE_WITHIN(fabs(PIXELS * x.slope), limit,
                                  picture_value_at(x, picture_attribute(at, "cx")));
        TEST_ASSERT_DOUBLE_WITHIN(fabs(PIXELS * y.slope), value_of(&grid_row[k].best),
                                  picture_value_at(y, picture_attribute(at, "cy")));
    }
    TEST_ASSERT_EQUAL_INT(dot, text_count("<circle class=\"dot\"", picture_text) -
                                   text_count("<circle class=\"dot\" cx=\"0", picture_text));
    const char *sine =
        picture_behind("<circle class=\"before\"", text_count("<circle class=\"before\"", picture_text) - 1);
    TEST_ASSERT_DOUBLE_WITHIN(fabs(PIXELS * x.slope), of_copper ? 1.0 : 14.0,
                              picture_value_at(x, picture_attribute(sine, "cx")));
    TEST_ASSERT_DOUBLE_WITHIN(fabs(PIXELS * y.slope), value_of(&grid_row[0].sine),
                              picture_value_at(y, picture_attribute(sine, "cy")));
    TEST_ASSERT_EQUAL_INT(1, text_count("<rect class=\"band\"", picture_text));
    const char *band = picture_behind("<rect class=\"band\"", 0);
    TEST_ASSERT_DOUBLE_WITHIN(
        fabs(PIXELS * x.slope), of_copper ? 1.05 : 12.0,
        picture_value_at(x, picture_attribute(band, " x") + picture_attribute(band, "width")));
}

static double ripple(const hci_grid_figures *f)
{
    return f->T_ripple_percent;
}

static double copper(const hci_grid_figures *f)
{
    return f->loss_to_plain;
}

static double peak(const hci_grid_figures *f)
{
    return f->peak_A;
}

static void test_panels_of_a_trade_off(void)
{
    check_dots(hci_plot_ripple_by_current, 0, 4, ripple, false);
    text_has("limit 12 A: ripple 5 %, copper 1.16 ×, peak 11.5 A</title>", picture_text);
    text_lacks("limit 10 A", picture_text);
    text_has("limit of the phase current, peak in A", picture_text);
    check_dots(hci_plot_copper_by_current, 0, 4, copper, false);
    check_dots(hci_plot_ripple_by_copper, 4, 7, ripple, true);
    text_has("limit 1.05 ×: ripple 6 %, copper 1.05 ×, peak 32 A</title>", picture_text);
    text_has("limit of the copper loss, × the plain sine", picture_text);
    check_dots(hci_plot_peak_by_copper, 4, 7, peak, true);
}

static void test_picture_of_a_trade_off(void)
{
    const hci_grid s = grid_trade_off();
    begin_and_end(hci_plot_sweep, &s);
    text_has("2 N·m at 600 rpm: ripple against peak current and copper", picture_text);
    TEST_ASSERT_EQUAL_INT(4, text_count("<polyline class=\"a\"", picture_text));
    text_has("no limits", picture_text);
}

/* ---- the largest torque ---- */

static int lines_of(const char *style)
{
    char key[48];
    snprintf(key, sizeof key, "<polyline class=\"%s\" points=\"", style);
    return text_count(key, picture_text);
}

static void check_line(const char *style, int line, const double *torque_Nm, int count)
{
    const picture_scale x = picture_scale_of("quiet middle", " x", 0.0),
                        y = picture_scale_of("quiet end", " y", 4.0);
    double at[2];
    for (int k = 0; k < count; ++k) {
        TEST_ASSERT_TRUE(picture_corner_of(style, line, k, at));
        TEST_ASSERT_DOUBLE_WITHIN(fabs(PIXELS * x.slope), 1000.0 * (k + 1), picture_value_at(x, at[0]));
        TEST_ASSERT_DOUBLE_WITHIN(fabs(PIXELS * y.slope), torque_Nm[k], picture_value_at(y, at[1]));
    }
    TEST_ASSERT_FALSE(picture_corner_of(style, line, count, at));
}

static void test_torques_of_an_envelope(void)
{
    static const double BEST[2][2] = {{3.0, 2.0}, {4.5, 3.0}},
                        MOST[2][3] = {{4.0, 3.0, 2.0}, {6.0, 4.5, 3.0}},
                        SINE[2][3] = {{2.5, 1.5, 0.5}, {3.75, 2.25, 0.75}};
    const hci_svg_box box = {70.0, 106.0, 976.0, 440.0};
    for (size_t links = 1; links <= 2; ++links) {
        const hci_grid s = grid_envelope(links);
        draw_panel(hci_plot_envelope_torque, &box, &s);
        TEST_ASSERT_EQUAL_INT(links, lines_of("a"));
        double middle[2];
        TEST_ASSERT_TRUE(picture_corner_of("c", 0, 1, middle));
        check_strip(1, middle[0], 10.0, &box);
        for (size_t k = 0; k < links; ++k) {
            check_line("a", (int)k, BEST[k], 2);
            check_line("c", (int)k, MOST[k], 3);
            check_line("before", (int)k, SINE[k], 3);
        }
        TEST_ASSERT_EQUAL_INT(2 * links, text_count("<circle class=\"dot\"", picture_text));
        /* a cross is two lines, one more in the legend */
        TEST_ASSERT_EQUAL_INT(2 * links + 2, text_count("<path class=\"cross\"", picture_text));
        text_has("at most 2.5 % of ripple", picture_text);
        text_has("2000 rpm, little ripple: 2 N·m, any ripple: 3 N·m, plain sine: 1.5 N·m</title>",
                 picture_text);
        TEST_ASSERT_EQUAL_INT(links > 1, text_count(">24 V</text>", picture_text));
        TEST_ASSERT_EQUAL_INT(links > 1, text_count(">48 V</text>", picture_text));
    }
}

/* A logarithmic axis: the ratio of two ripples is a distance. */
static void test_ripples_of_an_envelope(void)
{
    const hci_svg_box box = {70.0, 530.0, 976.0, 730.0};
    const hci_grid s = grid_envelope(1);
    double a[2], b[2], most[3][2];
    draw_panel(hci_plot_envelope_ripple, &box, &s);
    TEST_ASSERT_TRUE(picture_corner_of("a", 0, 0, a) && picture_corner_of("a", 0, 1, b)); /* 0.5 and 1 % */
    for (int k = 0; k < 3; ++k)
        TEST_ASSERT_TRUE(picture_corner_of("c", 0, k, most[k])); /* 8, 6, 4 % */
    const double decade = (b[1] - a[1]) / log10(2.0);
    TEST_ASSERT_TRUE(decade < 0.0); /* upwards */
    TEST_ASSERT_DOUBLE_WITHIN(0.2, a[1] + decade * log10(8.0 / 0.5), most[0][1]);
    TEST_ASSERT_DOUBLE_WITHIN(0.2, a[1] + decade * log10(4.0 / 0.5), most[2][1]);
    const char *allowed =
        picture_behind("<path class=\"limit\" d=\"M", text_count("<path class=\"limit\"", picture_text) - 1);
    TEST_ASSERT_DOUBLE_WITHIN(0.2, a[1] + decade * log10(2.5 / 0.5), strtod(strchr(allowed, ' ') + 1, NULL));
    text_has("1000 rpm, little ripple: 0.5 %, any ripple: 8 %, plain sine: 5 %</title>", picture_text);
    begin_and_end(hci_plot_sweep, &s);
    text_has("Largest torque over the speed", picture_text);
    TEST_ASSERT_EQUAL_INT(2, lines_of("a"));
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_cells_of_a_map_meet_halfway);
    RUN_TEST(test_colours_of_a_map);
    RUN_TEST(test_numbers_of_a_legend);
    RUN_TEST(test_limits_and_words_of_a_map);
    RUN_TEST(test_one_link_of_a_map);
    RUN_TEST(test_panels_of_a_trade_off);
    RUN_TEST(test_picture_of_a_trade_off);
    RUN_TEST(test_torques_of_an_envelope);
    RUN_TEST(test_ripples_of_an_envelope);
    return UNITY_END();
}
