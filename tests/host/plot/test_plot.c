/* The picture of a solution, read as a reader does: its axes from the numbers beside them, and the curves,
 * bars and points by these axes against the formulas; its text as XML; inputs at the ends of what there can
 * be. */
#include "host/plot/plot.h"

#include <locale.h>
#include <math.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "host/base/memory.h"
#include "host/draw/html.h"
#include "host/draw/svg.h"
#include "support/reference.h"
#include "support/texts.h"
#include "support/written.h"
#include "unity.h"

enum { MOST_BYTES = 180000, VERTICES = 720, MOST_WAVES = 400 };

/* Coordinates are rounded to 0.01 pixel, those of the two ticks that make the scale too. */
#define PIXELS 0.03

static const char *picture;

static hci_wave wave[MOST_WAVES];
static hci_set set[MOST_WAVES];
static hci_solved_order order[MOST_WAVES];
static hci_solution solution;

/* ---- a solution by hand ---- */

static hci_solved_order solved(double n, double before_Nm, double wanted_Nm, double after_Nm,
                               hci_order_verdict verdict)
{
    const double phase_rad = 0.3 * n;
    return (hci_solved_order){hci_harmonic_polar(n, wanted_Nm, phase_rad),
                              hci_harmonic_polar(n, after_Nm, phase_rad),
                              hci_harmonic_polar(n, before_Nm, phase_rad),
                              fabs(after_Nm - wanted_Nm),
                              verdict,
                              {0.0, 0}};
}

void setUp(void)
{
    files_begin();
    wave[0] = hci_wave_polar(1.0, 1, 10.0, 0.4);
    wave[1] = hci_wave_polar(5.0, -1, 2.0, 1.0);
    order[0] = solved(0.0, 2.1, 2.1, 2.1, HCI_ORDER_REACHED);
    order[1] = solved(6.0, 0.5, 0.2, 0.3, HCI_ORDER_REACHED);
    order[2] = solved(12.0, 0.1, 0.0, 0.4, HCI_ORDER_REACHED);
    solution = (hci_solution){0};
    solution.current = (hci_currents){wave, set, 2, 0};
    solution.per_Nm = wave;
    solution.order = order;
    solution.order_count = 3;
    solution.tolerance_Nm = 2.1e-6;
    solution.plain = hci_wave_polar(1.0, 1, 10.0, 0.0);
    solution.plain_amplitude_A = 10.0;
    solution.loss_to_plain = 1.25;
    solution.loss_to_limit = 1.1;
    solution.peak_line_voltage_V = NAN;
    solution.within_limits = true;
    solution.period_turns = 1;
}

void tearDown(void)
{
    hci_memory_fail_after(-1);
    setlocale(LC_ALL, "C");
    files_end();
}

static void draw(void)
{
    hci_output *out = written_begin("p.svg");
    hci_plot_solution(out, &solution);
    picture = written_end(out, "p.svg");
    TEST_ASSERT_TRUE(strlen(picture) < MOST_BYTES);
}

/* ---- XML ---- */

static void check_well_formed(void)
{
    char open[8][TEXT_TAG];
    int depth = 0, tags = 0;
    TEST_ASSERT_EQUAL_STRING_LEN("<svg xmlns=\"http://www.w3.org/2000/svg\" ", picture, 40);
    for (const char *at = picture; *at;) {
        if (*at == '<') {
            TEST_ASSERT_TRUE_MESSAGE(depth > 0 || tags == 0, "a second root");
            at = text_tag(at, open, 8, &depth);
            ++tags;
        } else if (*at == '&') {
            TEST_ASSERT_EQUAL_STRING_LEN("&#", at, 2);
            at += 2 + strspn(at + 2, "0123456789");
            TEST_ASSERT_EQUAL_INT(';', *at++);
        } else {
            TEST_ASSERT_TRUE(*at != '>' && (depth > 0 || *at == '\n'));
            ++at;
        }
    }
    TEST_ASSERT_EQUAL_INT(0, depth);
}

/* Every coordinate is a plain number with two decimals on the canvas, or within a line's width of it. */
static void check_coordinates(const char *attribute, double most)
{
    char key[32];
    snprintf(key, sizeof key, " %s=\"", attribute);
    for (const char *at = strstr(picture, key); at; at = strstr(at, key)) {
        char *end;
        at += strlen(key);
        const double value = strtod(at, &end);
        TEST_ASSERT_TRUE_MESSAGE(end - at >= 4 && end[-3] == '.' && *end == '"', attribute);
        TEST_ASSERT_TRUE_MESSAGE(value >= -10.0 && value <= most, attribute);
    }
}

static void check_points(void)
{
    const char *const key = "points=\"";
    for (const char *at = strstr(picture, key); at; at = strstr(at, key)) {
        at += strlen(key);
        for (int k = 0; *at != '"'; ++k) {
            char *end;
            const double value = strtod(at, &end);
            TEST_ASSERT_TRUE(end - at >= 4 && end[-3] == '.' && *end == (k % 2 ? ' ' : ','));
            TEST_ASSERT_TRUE(value >= 0.0 && value <= (k % 2 ? 792.0 : 1000.0));
            at = end + 1;
        }
    }
}

static void check_picture(void)
{
    static const char *const X[] = {"x", "cx", "width"}, *const Y[] = {"y", "cy", "height"};
    check_well_formed();
    for (size_t k = 0; k < 3; ++k) {
        check_coordinates(X[k], 1000.0);
        check_coordinates(Y[k], 792.0);
    }
    check_points();
    TEST_ASSERT_NULL(strstr(picture, "nan"));
    TEST_ASSERT_NULL(strstr(picture, "inf"));
}

/* ---- reading ---- */

/* value = low + (place − at)·slope, from the first and the last number beside an axis. */
typedef struct {
    double at, low, slope;
} scale;

static double parse(const char *text)
{
    const char *const minus = "−";
    return strncmp(text, minus, strlen(minus)) == 0 ? -strtod(text + strlen(minus), NULL)
                                                    : strtod(text, NULL);
}

/* Tick numbers are texts of one style; `fixed` is the coordinate that they share, `other` the one that they
 * do not. */
static scale read_scale(const char *style, bool upwards, double fixed, double low, double high)
{
    char key[64];
    double first = NAN, first_value = NAN, last = NAN, last_value = NAN;
    snprintf(key, sizeof key, "<text class=\"%s\" x=\"", style);
    for (const char *at = strstr(picture, key); at; at = strstr(at + 1, key)) {
        char *end;
        const double x = strtod(at + strlen(key), &end), y = strtod(end + strlen("\" y=\""), &end);
        const double place = upwards ? y : x;
        if (fabs((upwards ? x : y) - fixed) > 0.01 || place < low || place > high) continue;
        last = place;
        last_value = parse(end + 2);
        if (isnan(first)) {
            first = last;
            first_value = last_value;
        }
    }
    TEST_ASSERT_TRUE_MESSAGE(last != first && last_value != first_value, "fewer than two numbers at an axis");
    return (scale){first, first_value, (last_value - first_value) / (last - first)};
}

/* Texts stand 4 pixels below the line that they name. */
static double value_at(scale s, double place, bool upwards)
{
    return s.low + (place + (upwards ? 4.0 : 0.0) - s.at) * s.slope;
}

static const char *find(const char *what, int nth)
{
    const char *at = strstr(picture, what);
    for (; at && nth > 0; --nth)
        at = strstr(at + 1, what);
    TEST_ASSERT_NOT_NULL_MESSAGE(at, what);
    return at + strlen(what);
}

static double attribute(const char *element, const char *name)
{
    char key[32];
    snprintf(key, sizeof key, " %s=\"", name);
    return strtod(strstr(element, key) + strlen(key), NULL);
}

/* The vertices of a curve over the angle, each of which is a sample as long as two a column are enough. */
static void check_curve(const char *style, int nth, scale s, double (*expected)(double theta_rad))
{
    char key[64];
    snprintf(key, sizeof key, "<polyline class=\"%s\" points=\"", style);
    char *at;
    const char *start = find(key, nth);
    for (int k = 0; k <= VERTICES; ++k) {
        const double x = strtod(start, &at), y = strtod(at + 1, &at);
        TEST_ASSERT_DOUBLE_WITHIN(PIXELS, 62.0 + 478.0 * k / VERTICES, x);
        TEST_ASSERT_DOUBLE_WITHIN(PIXELS * fabs(s.slope), expected(2.0 * REF_PI * k / VERTICES),
                                  value_at(s, y, true));
        start = at + 1;
    }
    TEST_ASSERT_EQUAL_INT('"', *start);
}

/* ---- what the curves should be ---- */

static double before_Nm(double x)
{
    return 2.1 + 0.5 * sin(6 * x + 1.8) + 0.1 * sin(12 * x + 3.6);
}

static double wanted_Nm(double x)
{
    return 2.1 + 0.2 * sin(6 * x + 1.8);
}

static double after_Nm(double x)
{
    return 2.1 + 0.3 * sin(6 * x + 1.8) + 0.4 * sin(12 * x + 3.6);
}

static double phase_A(double x, int s)
{
    return 10.0 * sin(x - 2 * REF_PI * s / 3 + 0.4) + 2.0 * sin(5 * x + 2 * REF_PI * s / 3 + 1.0);
}

static double ia_A(double x)
{
    return phase_A(x, 0);
}

static double ib_A(double x)
{
    return phase_A(x, 1);
}

static double ic_A(double x)
{
    return phase_A(x, 2);
}

static double plain_A(double x)
{
    return 10.0 * sin(x);
}

static double held_A(double x)
{
    return 10.0 * sin(x + 0.4);
}

/* ---- tests ---- */

static void test_torque_is_read_back(void)
{
    draw();
    check_picture();
    const scale s = read_scale("quiet end", true, 54.0, 120.0, 380.0);
    check_curve("before", 0, s, before_Nm);
    check_curve("wanted", 0, s, wanted_Nm);
    check_curve("after", 0, s, after_Nm);
}

/* Two curves that lie on one another are one line, and the legend has no other. */
static void test_wanted_where_it_is_seen(void)
{
    draw();
    TEST_ASSERT_NOT_NULL(strstr(picture, "<polyline class=\"wanted\""));
    for (int k = 1; k < 3; ++k)
        order[k].torque_Nm = order[k].target_Nm;
    draw();
    check_picture();
    TEST_ASSERT_NULL(strstr(picture, "<polyline class=\"wanted\""));
    TEST_ASSERT_NOT_NULL(strstr(picture, ", wanted ")); /* under the pointer */
}

/* A band of the height of the bound about the curve after, with an entry of the legend, and room for it on
 * the axis; none where the bound is not known, or is above the torque. */
static void test_expected_of_the_machine(void)
{
    solution.expected.peak_to_peak_Nm = solution.expected.error_peak_to_peak_Nm = 1.9031;
    solution.T_ripple_before_percent = 100.0;
    draw();
    check_picture();
    const scale s = read_scale("quiet end", true, 54.0, 120.0, 380.0);
    const char *at = find("<polyline class=\"expected\"", 0);
    double x[2], y[2];
    TEST_ASSERT_EQUAL_INT(2, sscanf(strstr(at, "points=\"") + 8, "%lf,%lf", &x[0], &y[0]));
    const char *last = strstr(at, "\"/>");
    for (--last; last[-1] != ' '; --last) {
    }
    TEST_ASSERT_EQUAL_INT(2, sscanf(last, "%lf,%lf", &x[1], &y[1]));
    TEST_ASSERT_DOUBLE_WITHIN(1e-3, x[0], x[1]);
    TEST_ASSERT_DOUBLE_WITHIN(0.01, 2.0, value_at(s, y[0], true) - value_at(s, y[1], true)); /* rounded up */
    TEST_ASSERT_DOUBLE_WITHIN(0.01, 2.0 * after_Nm(0.0), value_at(s, y[0], true) + value_at(s, y[1], true));
    TEST_ASSERT_NOT_NULL(strstr(picture, ">on the machine (95 %)</text>"));
    TEST_ASSERT_NOT_NULL(strstr(picture, ", on the machine (95 %) ± 1 N·m</title>"));
    solution.expected.peak_to_peak_Nm = 2.2; /* above the torque and the ripple before */
    draw();
    TEST_ASSERT_NULL(strstr(picture, "on the machine"));
    solution.expected.peak_to_peak_Nm = 1.9;
    solution.expected.state = HCI_RIPPLE_TOO_FAR;
    draw();
    TEST_ASSERT_NULL(strstr(picture, "on the machine"));
}

/* The plain sine of a machine that saturates makes less than was wanted, and nobody says otherwise. */
static void test_mean_of_the_plain_sine(void)
{
    draw();
    TEST_ASSERT_NOT_NULL(strstr(picture, "a plain sine of 10 A with the wanted mean torque. Copper loss"));
    order[0].before_Nm.cosine = 2.063;
    draw();
    TEST_ASSERT_NULL(strstr(picture, "with the wanted mean torque"));
    TEST_ASSERT_NOT_NULL(
        strstr(picture, "would make the wanted mean torque and the machine makes 2.063 N·m."));
}

static void test_currents_are_read_back(void)
{
    draw();
    scale s = read_scale("quiet end", true, 54.0, 450.0, 720.0);
    check_curve("a", 0, s, ia_A);
    check_curve("b", 0, s, ib_A);
    check_curve("c", 0, s, ic_A);
    check_curve("before", 1, s, plain_A);
    solution.plain = wave[0]; /* the first wave is held: it is what the others are compared with */
    solution.plain_is_held = true;
    draw();
    s = read_scale("quiet end", true, 54.0, 450.0, 720.0);
    check_curve("before", 1, s, held_A);
}

/* i_a = i_q sin θ − i_d cos θ: the positive sequence of order 1 stands still, the negative one of order 5
 * turns at 6. */
static void test_vector_is_read_back(void)
{
    draw();
    const scale d = read_scale("quiet middle", false, 723.0, 600.0, 1000.0);
    const scale q = read_scale("quiet end", true, 614.0, 450.0, 720.0);
    TEST_ASSERT_DOUBLE_WITHIN(1e-3 * d.slope, d.slope, -q.slope);
    const char *start = find("<circle class=\"start\"", 1), *plain = find("<circle class=\"plain\"", 1);
    TEST_ASSERT_DOUBLE_WITHIN(PIXELS * d.slope, -10.0 * sin(0.4) - 2.0 * sin(1.0),
                              value_at(d, attribute(start, "cx"), false));
    TEST_ASSERT_DOUBLE_WITHIN(PIXELS * d.slope, 10.0 * cos(0.4) - 2.0 * cos(1.0),
                              value_at(q, attribute(start, "cy"), true));
    TEST_ASSERT_DOUBLE_WITHIN(PIXELS * d.slope, 0.0, value_at(d, attribute(plain, "cx"), false));
    TEST_ASSERT_DOUBLE_WITHIN(PIXELS * d.slope, 10.0, value_at(q, attribute(plain, "cy"), true));
    char *at;
    for (const char *point = find("<polyline class=\"path\" points=\"", 0); *point != '"'; point = at + 1) {
        const double i_d = value_at(d, strtod(point, &at), false),
                     i_q = value_at(q, strtod(at + 1, &at), true);
        TEST_ASSERT_DOUBLE_WITHIN(2.0 * PIXELS * d.slope, 2.0,
                                  hypot(i_d + 10.0 * sin(0.4), i_q - 10.0 * cos(0.4)));
    }
}

static void test_spectrum_is_read_back(void)
{
    static const char *const STYLE[] = {"before", "wanted", "after"};
    static const double HEIGHT_Nm[3][2] = {{0.5, 0.1}, {0.2, 0.0}, {0.3, 0.4}};
    draw();
    const scale s = read_scale("quiet end", true, 614.0, 120.0, 380.0);
    for (int k = 0; k < 3; ++k)
        for (int group = 0; group < 2; ++group) {
            char key[64];
            snprintf(key, sizeof key, "<rect class=\"%s\"", STYLE[k]);
            const char *bar = find(key, 1 + group); /* the first one is in the legend */
            const double height = attribute(bar, "height"), expected = HEIGHT_Nm[k][group] / fabs(s.slope);
            TEST_ASSERT_DOUBLE_WITHIN(PIXELS, 370.0, attribute(bar, "y") + height);
            TEST_ASSERT_DOUBLE_WITHIN(PIXELS, fmax(expected, 1.5), height);
        }
    TEST_ASSERT_NOT_NULL(strstr(picture, ">6</text>"));
    TEST_ASSERT_NOT_NULL(strstr(picture, ">12</text>"));
    TEST_ASSERT_EQUAL_INT(0, text_count("class=\"cross\"", picture) + text_count("class=\"ring\"", picture));
}

static void test_marks_and_words_of_what_is_missed(void)
{
    order[1].verdict = HCI_ORDER_UNREACHABLE;
    order[2].verdict = HCI_ORDER_MISSED;
    solution.worst_order = 12.0;
    solution.worst_error_Nm = 0.4;
    draw();
    check_picture();
    TEST_ASSERT_EQUAL_INT(
        4,
        text_count("class=\"cross\"", picture)); /* two strokes: one cross in the panel, one in the legend */
    TEST_ASSERT_EQUAL_INT(2, text_count("class=\"ring\"", picture));
    TEST_ASSERT_EQUAL_INT(2, text_count("class=\"no middle\"", picture));
    TEST_ASSERT_NOT_NULL(
        strstr(picture, ">Not reached: order 12 is off by 0.4 N·m, 1 more order missed</title>"));
    TEST_ASSERT_NULL_MESSAGE(strstr(picture, "least possible"), "the least loss is that of the whole torque");
}

static void test_words(void)
{
    draw();
    TEST_ASSERT_NOT_NULL(strstr(
        picture,
        " role=\"img\" aria-labelledby=\"hci-title\" aria-describedby=\"hci-desc\">\n<title id=\"hci-title\">"
        "Reached: every torque order is within 2.1 µN·m of what is wanted</title>\n<desc id=\"hci-desc\">"));
    /* sin 6x and sin 12x of 0.5 and 0.1 with phases that add nothing at once: by the formula on a fine grid
     */
    double low = HUGE_VAL, high = -HUGE_VAL;
    for (int k = 0; k < VERTICES; ++k) {
        low = fmin(low, before_Nm(2.0 * REF_PI * k / VERTICES));
        high = fmax(high, before_Nm(2.0 * REF_PI * k / VERTICES));
    }
    TEST_ASSERT_DOUBLE_WITHIN(6e-4, high - low, strtod(find("peak to peak ", 0), NULL));
    TEST_ASSERT_NOT_NULL(strstr(picture, "mean torque 2.1 N·m"));
    TEST_ASSERT_NOT_NULL(strstr(picture, "copper loss × 1.25"));
    TEST_ASSERT_NOT_NULL(strstr(picture, "1.100 × the least possible"));
    solution.within_limits = false;
    solution.peak_phase_current_A = 12.5;
    draw();
    TEST_ASSERT_NOT_NULL(
        strstr(picture, ">Over a limit: the wanted torque takes a peak phase current of 12.5 A</title>"));
}

static void test_nothing_from_outside(void)
{
    static const char *const WORDS[] = {"<script", "@import", "url(", "href", "<image", "on", "/tmp"};
    draw();
    for (size_t k = 0; k < sizeof WORDS / sizeof WORDS[0]; ++k) {
        char key[32];
        snprintf(key, sizeof key, strcmp(WORDS[k], "on") == 0 ? " %sload=" : "%s", WORDS[k]);
        TEST_ASSERT_NULL_MESSAGE(strstr(picture, key), key);
    }
    TEST_ASSERT_EQUAL_INT_MESSAGE(1, text_count("http", picture), "the namespace is the only address");
}

static void test_same_input_same_bytes_in_any_locale(void)
{
    static const char *const LOCALES[] = {"de_DE.UTF-8", "de_DE.utf8", "fr_FR.UTF-8", "C"};
    draw();
    const char *const first = picture; /* files_read keeps it */
    for (size_t k = 0; k < 4; ++k) {
        setlocale(LC_ALL, LOCALES[k]);
        draw();
        TEST_ASSERT_EQUAL_STRING(first, picture);
    }
}

static void test_nothing_is_allocated(void)
{
    hci_output *out;
    hci_note note = {{0}};
    TEST_ASSERT_EQUAL(HCI_OK, hci_output_open(files_root, &out, &note));
    TEST_ASSERT_EQUAL(HCI_OK, hci_output_file(out, "p.svg", &note));
    hci_memory_fail_after(0);
    hci_plot_solution(out, &solution);
    hci_memory_fail_after(-1);
    TEST_ASSERT_EQUAL(HCI_OK, hci_output_commit(out, &note));
}

static hci_output *begin_part(void)
{
    return written_begin("p.svg");
}

static void end_part(hci_output *out)
{
    picture = written_end(out, "p.svg");
}

/* Of digits, a point and a minus sign at 12 px in DejaVu Sans, by the advances in its metrics. */
static double width_of(const char *text)
{
    double width = 0.0;
    for (; *text && *text != '<'; ++text)
        if (((unsigned char)*text & 0xC0u) != 0x80u)
            width += 12.0 * (*text == '.'                  ? 0.318
                             : *text == 'e'                ? 0.615
                             : (unsigned char)*text >= 128 ? 0.838
                                                           : 0.636);
    return width;
}

/* The numbers of an axis by their values: plain ones where they are not small, all in one notation, and each
 * within the picture, of which the box leaves 58 pixels at the left and 12 at the right. */
static void test_numbers_of_an_axis(void)
{
    static const struct {
        hci_range r;
        const char *is[2], *is_not;
    } CASE[] = {
        {{0.049918, 0.050083}, {">0.05000<", ">0.05005<"}, "e-"},
        {{0.0, 1.2e-6}, {">0<", ">1.0e-6<"}, "e-7"},
        {{-3e-4, 3e-4}, {">−0.0002<", ">0.0002<"}, "e-"},
        {{1e4 - 1e-3, 1e4 + 1e-3}, {">10000.0000<", ">10000.0005<"}, "e"},
        {{0.0, 3e6}, {">0<", ">2e6<"}, "000<"},
        {{0.0, 0.0021}, {">0.000", ">0.002"}, "e-"},
    };
    for (size_t k = 0; k < sizeof CASE / sizeof *CASE; ++k) {
        hci_output *out = begin_part();
        const hci_svg_box room = {58.0, 0.0, 400.0, 200.0};
        const hci_svg_axis y = hci_svg_axis_over(CASE[k].r, 200.0, 0.0, 6.0);
        const hci_svg_box b = hci_svg_box_beside(room, &y);
        const hci_svg_axis x = {0.0, 2e5, b.left, b.right, 1e5};
        hci_svg_grid(out, &y, &b, true);
        hci_svg_grid(out, &x, &b, false);
        end_part(out);
        for (size_t j = 0; j < 2; ++j)
            TEST_ASSERT_NOT_NULL_MESSAGE(strstr(picture, CASE[k].is[j]), CASE[k].is[j]);
        for (const char *at = picture; (at = strstr(at, "<text class=\"quiet ")); ++at) {
            const bool upright = strncmp(at + 19, "end", 3) == 0;
            const double place = strtod(strstr(at, "x=\"") + 3, NULL), width = width_of(strchr(at, '>') + 1);
            TEST_ASSERT_TRUE(upright ? place - width > 0.0 : place + 0.5 * width <= 412.0);
            if (!upright) continue;
            const char *odd = strstr(strchr(at, '>'), CASE[k].is_not);
            TEST_ASSERT_TRUE_MESSAGE(!odd || odd > strstr(at, "</text>") + 1, CASE[k].is_not);
        }
    }
}

/* Labels under an axis: none over another one of its row, in as few rows as will do, and not thinned without
 * need. */
static void test_labels_make_room(void)
{
    static const struct {
        double pitch, first, step;
        size_t rows, shown;
    } CASE[] = {
        {40.0, 6.0, 6.0, 1, 24},
        {17.0, 1.5, 1.5, 2, 24},
        {14.7, 4.583, 1.0833333, 2, 12},
        {3.0, 4.583, 1.0833333, 2, 4},
    };
    for (size_t k = 0; k < sizeof CASE / sizeof *CASE; ++k) {
        hci_svg_tag tag[24];
        double end[2] = {-1e9, -1e9}, row_y[2] = {NAN, NAN};
        size_t shown = 0;
        hci_output *out = begin_part();
        for (size_t j = 0; j < 24; ++j) {
            tag[j].x = 100.0 + CASE[k].pitch * (double)j;
            tag[j].style = "quiet middle";
            hci_svg_short_text(tag[j].text, CASE[k].first + CASE[k].step * (double)j);
        }
        hci_svg_tags(out, tag, 24, 300.0);
        end_part(out);
        for (const char *at = picture; (at = strstr(at, "<text class=\"quiet middle\"")); ++at, ++shown) {
            const double x = strtod(strstr(at, "x=\"") + 3, NULL), y = strtod(strstr(at, " y=\"") + 4, NULL);
            const double half = 0.5 * width_of(strchr(at, '>') + 1);
            const size_t row = !isnan(row_y[0]) && y != row_y[0];
            TEST_ASSERT_TRUE(isnan(row_y[row]) || row_y[row] == y);
            TEST_ASSERT_TRUE(x - half > end[row]);
            row_y[row] = y;
            end[row] = x + half;
        }
        TEST_ASSERT_EQUAL_UINT64(CASE[k].shown, shown);
        TEST_ASSERT_EQUAL_UINT64(CASE[k].rows, isnan(row_y[1]) ? 1 : 2);
    }
}

/* A name in bold has fewer letters in the same room; one that fits is whole; of a path whole names stay. */
static void test_names_fit(void)
{
    static const char NAME[] = "recordings_speed_control.csv";
    hci_output *out = begin_part();
    hci_svg_name(out, "quiet end", 0.0, 0.0, NAME, 162.0);
    hci_svg_name(out, "head end", 0.0, 0.0, NAME, 162.0);
    hci_svg_name(out, "head end", 0.0, 0.0, NAME, 400.0);
    hci_svg_name(out, "quiet", 0.0, 0.0, "Größe", 1.0);
    hci_svg_name(out, "head end", 0.0, 0.0, "recordings/speed_control.csv", 162.0);
    end_part(out);
    const char *quiet = find(">…", 0), *bold = find(">…", 1),
               *whole = find(">recordings_speed_control.csv<", 0);
    const size_t letters = strcspn(quiet + 1, "<"), letters_bold = strcspn(bold + 1, "<");
    TEST_ASSERT_TRUE(quiet < bold && bold < whole);
    TEST_ASSERT_TRUE(letters_bold < letters && letters < sizeof NAME);
    /* letters of 13 px in bold are 8.6 wide in this name on average: advances of DejaVu Sans Bold */
    TEST_ASSERT_TRUE(8.6 * (double)(letters_bold - 2) < 162.0 && letters_bold > 12);
    TEST_ASSERT_NOT_NULL(strstr(picture, ">…</text>"));
    TEST_ASSERT_NOT_NULL(strstr(picture, ">…speed_control.csv</text>"));
}

/* What follows a semicolon of a page's heading is a list; not within parentheses, and a name keeps its
 * letters. */
static void test_heading_and_list(void)
{
    hci_output *out = begin_part();
    hci_html_begin(
        out, &(hci_html_opening){"k", "b", "It falls (from 3; to 1); i_q of `Iq` & more; check it", true});
    end_part(out);
    find("<title>It falls (from 3; to 1)</title>", 0);
    find("<h1>It falls (from 3; to 1)</h1>\n<ul class=\"also\">\n<li>i<sub>q</sub> of <code>Iq</code> &#38; more</li>\n"
         "<li>Check it</li>\n</ul>",
         0);
}

/* Of lines each is an item as it stands. */
static void test_further_items_of_a_heading(void)
{
    hci_output *out = begin_part();
    hci_html_also(out, "");
    hci_html_also(out, "as in `one`; not two < 3\ni_d\n");
    end_part(out);
    find("<ul class=\"also\">\n<li>As in <code>one</code>; not two &#60; 3</li>\n<li>i<sub>d</sub></li>\n</ul>\n", 0);
    TEST_ASSERT_NULL(strstr(strstr(picture, "<ul") + 1, "<ul"));
}

/* Torque has one unit, currents have prefixes. */
static void test_quantities_of_a_page(void)
{
    static const struct {
        double value;
        const char *unit, *text;
    } CASE[] = {{2.46289, "N·m", "2.463 N·m"},
                {0.0048361, "N·m", "0.004836 N·m"},
                {5e-5, "N·m", "0.00005 N·m"},
                {5e-6, "N·m", "5 µN·m"},
                {1e-13, "N·m", "0 N·m"},
                {0.0048361, "A", "0.004836 A"},
                {25.0, "V", "25 V"},
                {0.0048361, "W", "4.836 mW"},
                {1e-12, "%", "0 %"}};
    for (size_t k = 0; k < sizeof CASE / sizeof *CASE; ++k) {
        char text[HCI_HTML_NUMBER_SIZE];
        hci_html_quantity_text(text, CASE[k].value, CASE[k].unit);
        TEST_ASSERT_EQUAL_STRING(CASE[k].text, text);
    }
}

static void test_text_is_escaped(void)
{
    hci_output *out = begin_part();
    hci_svg_label(out, "head", 1.005, -2.0, "a<b>&\"c\" i_q in A");
    end_part(out);
    TEST_ASSERT_NOT_NULL(
        strstr(picture, ">a&#60;b&#62;&#38;&#34;c&#34; i<tspan class=\"sub\" dy=\"3\">q</tspan>"));
    TEST_ASSERT_NOT_NULL(strstr(picture, "y=\"-2.00\""));
}

static void test_number_texts(void)
{
    static const struct {
        double value;
        const char *text;
    } CASES[] = {{0.0, "0 A"},         {12.0, "12 A"},      {-1.5, "−1.5 A"},
                 {0.25, "0.25 A"},     {0.099, "99 mA"},    {2.463e-6, "2.463 µA"},
                 {1e-13, "< 1 pA"},    {99995.0, "100 kA"}, {1.0 / 3.0, "0.3333 A"},
                 {1e200, "> 1000 MA"}, {NAN, "> 1000 MA"},  {1234567.0, "1.235 MA"},
                 {-0.00004, "−40 µA"}, {3e-10, "0.3 nA"}};
    for (size_t k = 0; k < sizeof CASES / sizeof CASES[0]; ++k) {
        char text[HCI_SVG_NUMBER_SIZE];
        hci_svg_quantity_text(text, CASES[k].value, "A");
        TEST_ASSERT_EQUAL_STRING(CASES[k].text, text);
    }
    char text[HCI_SVG_NUMBER_SIZE];
    hci_svg_fixed_text(text, -0.001, 2);
    TEST_ASSERT_EQUAL_STRING("0.00", text);
    hci_svg_fixed_text(text, 12.345, 1);
    TEST_ASSERT_EQUAL_STRING("12.3", text);
}

/* Any range gives an axis that holds it, with two to eight numbers that are 1, 2 or 5 times a power of ten
 * apart. */
static void test_axes_of_any_range(void)
{
    uint64_t state = 1;
    for (int k = 0; k < 2000; ++k) {
        const double size = pow(10.0, ref_uniform(&state, -150.0, 150.0));
        hci_range r = {ref_uniform(&state, -size, size), 0.0};
        r.high = r.low + size * pow(10.0, ref_uniform(&state, -6.0, 1.0));
        const hci_svg_axis a = hci_svg_axis_over(r, 300.0, 20.0, 6.0);
        const double numbers = floor(a.high / a.step) - ceil(a.low / a.step) + 1.0;
        const double digit = a.step / pow(10.0, floor(log10(a.step) + 1e-6));
        TEST_ASSERT_TRUE(a.low <= r.low && a.high >= r.high);
        TEST_ASSERT_TRUE(numbers >= 2.0 && numbers <= 8.0);
        TEST_ASSERT_TRUE(fabs(digit - 1) < 1e-6 || fabs(digit - 2) < 1e-6 || fabs(digit - 5) < 1e-6);
    }
}

/* ---- the ends of what there can be ---- */

static void test_no_current(void)
{
    solution.current.count = 0;
    solution.plain = (hci_wave){1.0, 1, 0.0, 0.0};
    solution.plain_amplitude_A = 0.0;
    solution.loss_to_plain = solution.loss_to_limit = NAN;
    draw();
    check_picture();
    TEST_ASSERT_NULL(strstr(picture, "copper loss ×"));
    TEST_ASSERT_NOT_NULL(strstr(picture, "Before: no current"));
}

static void test_nothing_at_all(void)
{
    solution = (hci_solution){0};
    draw();
    check_picture();
    TEST_ASSERT_NOT_NULL(strstr(picture, ">no torque ripple</text>"));
}

static void test_one_component(void)
{
    solution.current.count = 1;
    solution.order_count = 1;
    draw();
    check_picture();
}

static void test_no_limit(void)
{
    solution.loss_to_limit = solution.limit_mean_square_A2 = solution.condition = NAN;
    draw();
    check_picture();
    TEST_ASSERT_NULL(strstr(picture, "least possible"));
}

static void test_many_components(void)
{
    uint64_t state = 7;
    for (size_t k = 0; k < MOST_WAVES; ++k) {
        wave[k] = hci_wave_polar(0.25 * (double)k, k % 2 ? 1 : -1, ref_uniform(&state, 0.0, 3.0),
                                 ref_uniform(&state, -3.0, 3.0));
        order[k] = solved(0.25 * (double)k, ref_uniform(&state, 0.0, 1.0), 0.5, ref_uniform(&state, 0.0, 1.0),
                          (hci_order_verdict)(k % 5));
    }
    solution.current.count = solution.order_count = MOST_WAVES;
    solution.period_turns = 4;
    draw();
    check_picture();
    TEST_ASSERT_NOT_NULL(strstr(picture, "the largest 16 of "));
    TEST_ASSERT_NOT_NULL(strstr(picture, ">1440</text>"));
}

/* A slow order over many turns: those after which it repeats while two samples a ripple fit, else the first
 * ones, and it says so. */
static void test_many_turns(void)
{
    order[1] = solved(0.025, 0.5, 0.5, 0.5, HCI_ORDER_REACHED);
    solution.period_turns = 40;
    draw();
    check_picture();
    TEST_ASSERT_NOT_NULL(strstr(picture, ">14400</text>"));
    TEST_ASSERT_NOT_NULL(
        strstr(picture, "i<tspan class=\"sub\" dy=\"3\">a</tspan>")); /* three phases would be a woven band */
    TEST_ASSERT_NULL(strstr(picture, "i<tspan class=\"sub\" dy=\"3\">b</tspan>"));
    TEST_ASSERT_NULL(strstr(picture, "i_c "));
    solution.period_turns = 1;
    draw();
    TEST_ASSERT_NOT_NULL(strstr(picture, "i<tspan class=\"sub\" dy=\"3\">b</tspan>"));
    solution.period_turns = 4096;
    draw();
    TEST_ASSERT_NOT_NULL(strstr(picture, "degrees; 40 of 4096 turns</text>"));
    order[1] = solved(1.0 / 4096.0, 0.5, 0.5, 0.5, HCI_ORDER_REACHED);
    draw();
    check_picture();
    TEST_ASSERT_NOT_NULL(strstr(picture, "degrees; 240 of 4096 turns</text>"));
}

/* A fast ripple is drawn to its peaks. */
static void test_high_orders_keep_their_peaks(void)
{
    order[1] = solved(997.0, 0.5, 0.5, 0.5, HCI_ORDER_REACHED);
    order[2] = solved(12.0, 0.0, 0.0, 0.0, HCI_ORDER_REACHED);
    draw();
    check_picture();
    TEST_ASSERT_EQUAL_STRING_LEN("1 N·m", find("peak to peak ", 0), 5);
}

static void test_sizes(void)
{
    static const double SIZE[] = {0.0,  1e-310, 1e-200, 1e-12, 1e-5, 1e5,
                                  1e12, 1e150,  1e250,  1e308, NAN,  INFINITY};
    for (size_t k = 0; k < sizeof SIZE / sizeof SIZE[0]; ++k) {
        wave[0] = hci_wave_polar(1.0, 1, 10.0 * SIZE[k], 0.4);
        wave[1] = hci_wave_polar(5.0, -1, SIZE[k], 0.4);
        order[0] = solved(0.0, SIZE[k], SIZE[k], SIZE[k], HCI_ORDER_REACHED);
        order[1] = solved(6.0, SIZE[k], 0.0, SIZE[k], HCI_ORDER_MISSED);
        solution.plain = hci_wave_polar(1.0, 1, SIZE[k], 0.0);
        solution.plain_amplitude_A = solution.worst_error_Nm = solution.worst_order = SIZE[k];
        solution.loss_to_plain = solution.loss_to_limit = SIZE[k];
        draw();
        check_picture();
    }
}

/* A tiny ripple on a large mean keeps numbers that differ. */
static void test_small_ripple_on_a_large_mean(void)
{
    order[0] = solved(0.0, 1e4, 1e4, 1e4, HCI_ORDER_REACHED);
    order[1] = solved(6.0, 1e-3, 0.0, 1e-3, HCI_ORDER_REACHED);
    order[2] = solved(12.0, 0.0, 0.0, 0.0, HCI_ORDER_REACHED);
    draw();
    check_picture();
    /* the numbers need more than the margin, so that they stand further to the right */
    const double x = strtod(find("<text class=\"quiet end\" x=\"", 0), NULL);
    const scale s = read_scale("quiet end", true, x, 120.0, 380.0);
    TEST_ASSERT_DOUBLE_WITHIN(1e-4, 2e-3 / 220.0, fabs(s.slope));
    TEST_ASSERT_TRUE(x > 54.0 + 1.0 && x - width_of("10000.0000") > 0.0);
}

/* Steps from 1e-4 on are written out. */
static void test_small_steps(void)
{
    char text[HCI_SVG_NUMBER_SIZE];
    hci_svg_tick_text(text, 3e-4, 1e-4, 5e-4);
    TEST_ASSERT_EQUAL_STRING("0.0003", text);
    hci_svg_tick_text(text, 3e-5, 1e-5, 5e-5);
    TEST_ASSERT_EQUAL_STRING("3e-5", text);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_torque_is_read_back);
    RUN_TEST(test_wanted_where_it_is_seen);
    RUN_TEST(test_expected_of_the_machine);
    RUN_TEST(test_mean_of_the_plain_sine);
    RUN_TEST(test_currents_are_read_back);
    RUN_TEST(test_vector_is_read_back);
    RUN_TEST(test_spectrum_is_read_back);
    RUN_TEST(test_marks_and_words_of_what_is_missed);
    RUN_TEST(test_words);
    RUN_TEST(test_nothing_from_outside);
    RUN_TEST(test_same_input_same_bytes_in_any_locale);
    RUN_TEST(test_nothing_is_allocated);
    RUN_TEST(test_heading_and_list);
    RUN_TEST(test_further_items_of_a_heading);
    RUN_TEST(test_quantities_of_a_page);
    RUN_TEST(test_text_is_escaped);
    RUN_TEST(test_numbers_of_an_axis);
    RUN_TEST(test_labels_make_room);
    RUN_TEST(test_names_fit);
    RUN_TEST(test_number_texts);
    RUN_TEST(test_axes_of_any_range);
    RUN_TEST(test_no_current);
    RUN_TEST(test_nothing_at_all);
    RUN_TEST(test_one_component);
    RUN_TEST(test_no_limit);
    RUN_TEST(test_many_components);
    RUN_TEST(test_many_turns);
    RUN_TEST(test_high_orders_keep_their_peaks);
    RUN_TEST(test_sizes);
    RUN_TEST(test_small_steps);
    RUN_TEST(test_small_ripple_on_a_large_mean);
    return UNITY_END();
}
