/* The picture of a measured waveform, read as a reader does: values by the numbers beside the axes against
 * the sines that were put in, and marks that are counted. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "host/plot/plot.h"
#include "support/texts.h"
#include "support/written.h"
#include "unity.h"

enum { MOST_BYTES = 400000 };

/* Coordinates are rounded to 0.01 pixel, those of the two ticks that make the scale too. */
#define PIXELS 0.03

static const char *picture;

void setUp(void)
{
    files_begin();
}

void tearDown(void)
{
    files_end();
}

static void draw(const hci_waveform *w)
{
    hci_output *out = written_begin("p.svg");
    hci_plot_waveform(out, w);
    picture = written_end(out, "p.svg");
    TEST_ASSERT_TRUE(strlen(picture) < MOST_BYTES);
    text_is_xml(picture);
}

/* A minus sign of typography is a minus. */
static double number(const char *text)
{
    return strncmp(text, "−", strlen("−")) == 0 ? -strtod(text + strlen("−"), NULL) : strtod(text, NULL);
}

/* The n-th number beside an upright axis, and the height of its grid line (4 above the text's). */
static void tick(int n, double *value, double *y)
{
    const char *at = picture;
    for (int k = 0; k <= n; ++k) {
        at = strstr(at + 1, "<text class=\"quiet end\"");
        TEST_ASSERT_NOT_NULL(at);
    }
    *y = strtod(strstr(at, "y=\"") + 3, NULL) - 4.0;
    *value = number(strchr(at, '>') + 1);
}

/* Vertex k of the curve of a style, by the first two numbers of the axis. */
static double curve_at(const char *style, int k)
{
    char start[64];
    double v0, y0, v1, y1;
    snprintf(start, sizeof start, "<polyline class=\"%s\"", style);
    const char *at = strstr(picture, start);
    TEST_ASSERT_NOT_NULL(at);
    at = strstr(at, "points=\"") + 8;
    for (int skipped = 0; skipped < k; ++skipped)
        at = strchr(at, ' ') + 1;
    tick(0, &v0, &y0);
    tick(1, &v1, &y1);
    const double y = strtod(strchr(at, ',') + 1, NULL);
    return v0 + (y - y0) * (v1 - v0) / (y1 - y0);
}

static hci_waveform_order order_of(double order, double amplitude, double phase_rad, bool kept)
{
    return (hci_waveform_order){.order = order,
                                .amplitude = amplitude,
                                .phase_rad = phase_rad,
                                .std_error = 0.05 * amplitude,
                                .kept = kept};
}

/* A mechanical turn of three pole pairs: 6 and 1/3 kept, 5/3 left out. */
static void test_curves_and_marks(void)
{
    hci_waveform_order order[] = {order_of(1.0 / 3.0, 0.2, -1.1, true), order_of(5.0 / 3.0, 0.05, 2.0, false),
                                  order_of(6.0, 1.0, 0.4, true)};
    const hci_waveform w = {.quantity = HCI_WAVEFORM_COGGING,
                            .order = order,
                            .count = 3,
                            .kept = 2,
                            .step = 1.0 / 3.0,
                            .turns_forward = 2,
                            .friction_Nm = NAN};
    draw(&w);
    for (int k = 0; k <= 2880; k += 180) {
        const double theta_m_rad = 6.283185307179586 * k / 2880;
        const double kept = 0.2 * sin(theta_m_rad - 1.1) + sin(18.0 * theta_m_rad + 0.4);
        double v0, y0, v1, y1;
        tick(0, &v0, &y0);
        tick(1, &v1, &y1);
        const double resolution = PIXELS * fabs((v1 - v0) / (y1 - y0));
        TEST_ASSERT_DOUBLE_WITHIN(resolution, kept, curve_at("after", k));
        TEST_ASSERT_DOUBLE_WITHIN(resolution, kept + 0.05 * sin(5.0 * theta_m_rad + 2.0),
                                  curve_at("before", k));
    }
    TEST_ASSERT_EQUAL_INT(2 + 1, text_count("<circle class=\"dot\"", picture));    /* and one in the legend */
    TEST_ASSERT_EQUAL_INT(1 + 1, text_count("<circle class=\"before\"", picture)); /* and one in the legend */
    TEST_ASSERT_EQUAL_INT(
        2, text_count("2 orders, the largest 1 N·m at electrical order 6", picture)); /* title and text */
    TEST_ASSERT_EQUAL_INT(1, text_count(">mechanical angle in degrees<", picture));
}

/* Nothing found, and nothing looked at. */
static void test_empty(void)
{
    hci_waveform_order order[] = {order_of(1.0, 0.0, 0.0, false)};
    hci_waveform w = {
        .quantity = HCI_WAVEFORM_BACK_EMF, .order = order, .count = 1, .step = 1.0, .friction_Nm = NAN};
    draw(&w);
    TEST_ASSERT_EQUAL_INT(2, text_count("no order stands out of the noise", picture));
    TEST_ASSERT_EQUAL_INT(0, text_count("nan", picture));
    w.count = 0;
    w.step = 0.0;
    draw(&w);
    TEST_ASSERT_EQUAL_INT(0, text_count("nan", picture) + text_count("inf", picture));
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_curves_and_marks);
    RUN_TEST(test_empty);
    return UNITY_END();
}
