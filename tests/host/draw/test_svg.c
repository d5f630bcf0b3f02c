/* Elements, names, labels and legends as text, each with its coordinates worked out by hand. */
#include "host/draw/svg.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "support/texts.h"
#include "support/written.h"
#include "unity.h"

static hci_output *out;

void setUp(void)
{
    files_begin();
    out = written_begin("s");
}

void tearDown(void)
{
    hci_output_discard(out);
    files_end();
}

/* What was drawn so far; the next drawing begins. */
static const char *written(void)
{
    const char *text = written_end(out, "s");
    out = written_begin("s");
    return text;
}

static void is_written(const char *expected)
{
    TEST_ASSERT_EQUAL_STRING(expected, written());
}

#define LABEL(style, x, y, text) "<text class=\"" style "\" x=\"" x "\" y=\"" y "\">" text "</text>\n"

static void test_elements(void)
{
    hci_svg_segment(out, "a", 1.234, -5.678, 12000.0, -12000.0);
    is_written("<path class=\"a\" d=\"M1.23 -5.68L9999.00 -9999.00\"/>\n");
    hci_svg_segment(out, "a", NAN, 0.004, -0.006, 9998.5);
    is_written("<path class=\"a\" d=\"M-9999.00 0.00L-0.01 9998.50\"/>\n");
    hci_svg_rectangle(out, "b", 3.0, 4.0, 7.5, 10.25);
    is_written("<rect class=\"b\" x=\"3.00\" y=\"4.00\" width=\"4.50\" height=\"6.25\"/>\n");
    hci_svg_rectangle(out, "b", 3.0, 4.0, 2.0, 1.0);
    is_written("<rect class=\"b\" x=\"3.00\" y=\"4.00\" width=\"0.00\" height=\"0.00\"/>\n");
    hci_svg_circle(out, "c", 1.5, 2.5, 3.5);
    is_written("<circle class=\"c\" cx=\"1.50\" cy=\"2.50\" r=\"3.50\"/>\n");
    hci_svg_cross(out, 10.0, 30.0);
    is_written("<path class=\"cross\" d=\"M6.00 26.00L14.00 34.00\"/>\n"
               "<path class=\"cross\" d=\"M6.00 34.00L14.00 26.00\"/>\n");
    hci_svg_line_begin(out, "d");
    hci_svg_line_point(out, 1.0, 2.0);
    hci_svg_line_point(out, 3.0, 4.0);
    hci_svg_line_end(out);
    is_written("<polyline class=\"d\" points=\"1.00,2.00 3.00,4.00 \"/>\n");
}

static void test_characters(void)
{
    hci_svg_text(out, "a<b>\"&'é\x01\t\xFF\xEF\xBF\xBE\xEF\xBF\xBF\x1F ");
    is_written(
        "a&#60;b&#62;&#34;&#38;'é\xEF\xBF\xBD\t\xEF\xBF\xBD\xEF\xBF\xBD\xEF\xBF\xBD\xEF\xBF\xBD\xEF\xBF\xBD"
        "\xEF\xBF\xBD\xEF\xBF\xBD\xEF\xBF\xBD ");
}

#define SUB(letter)       "<tspan class=\"sub\" dy=\"3\">" letter "</tspan><tspan dy=\"-3\">"
#define SUB_BLANK(letter) "<tspan class=\"sub\" dy=\"3\">" letter "</tspan><tspan dy=\"-3\" dx=\"4\">"

static void test_subscripts(void)
{
    hci_svg_label(out, "e", 1.0, 2.0, "i_d in A");
    is_written(LABEL("e", "1.00", "2.00", "i" SUB_BLANK("d") "in A</tspan>"));
    hci_svg_label(out, "e", 1.0, 2.0, "i_d, i_q");
    is_written(LABEL("e", "1.00", "2.00", "i" SUB("d") ", i</tspan>" SUB("q") "</tspan>"));
    hci_svg_label(out, "e", 1.0, 2.0, "a<_");
    is_written(LABEL("e", "1.00", "2.00", "a&#60;_"));
}

static void test_what_is_told(void)
{
    hci_svg_tell(out, "a&");
    hci_svg_tell_more(out, " b");
    hci_svg_tell_value(out, ", n ", 12.5, "rpm");
    hci_svg_tell_value(out, ", θ ", 0.05, "°");
    hci_svg_tell_value(out, ", k ", 0.05, "");
    hci_svg_tell_value(out, ", t ", 0.05, "ms");
    hci_svg_tell_value(out, ", s ", 0.05, "%");
    hci_svg_tell_value(out, ", f ", 0.05, "×");
    hci_svg_tell_value(out, ", i ", 0.05, "A");
    hci_svg_tell_value(out, ", x ", NAN, "A");
    hci_svg_strip(out, &(hci_svg_box){1.0, 2.0, 4.0, 8.0});
    is_written(
        "<g><title>a&#38; b, n 12.5 rpm, θ 0.05°, k 0.05, t 0.05 ms, s 0.05 %, f 0.05 ×, i 0.05 A</title>\n"
        "<rect class=\"hit\" x=\"1.00\" y=\"2.00\" width=\"3.00\" height=\"6.00\"/>\n</g>\n");
}

/* Of a path that has no room first the folders go, then letters; the dots take room too, of 12. */
static void test_names(void)
{
    hci_svg_name(out, "n", 1.0, 2.0, "ab/cd/eg", 56.05); /* 6·7.7 + 2·4.9 */
    is_written(LABEL("n", "1.00", "2.00", "ab/cd/eg"));
    hci_svg_name(out, "n", 1.0, 2.0, "ab/cd/eg", 55.9);
    is_written(LABEL("n", "1.00", "2.00", "…cd/eg"));
    hci_svg_name(out, "n", 1.0, 2.0, "ab/cd/eg", 35.75 + 12.0);
    is_written(LABEL("n", "1.00", "2.00", "…cd/eg"));
    hci_svg_name(out, "n", 1.0, 2.0, "ab/cd/eg", 35.6 + 12.0);
    is_written(LABEL("n", "1.00", "2.00", "…eg"));
    hci_svg_name(out, "n", 1.0, 2.0, "xaég", 7.75 + 12.0 + 12.0);
    is_written(LABEL("n", "1.00", "2.00", "…ég"));
    hci_svg_name(out, "n", 1.0, 2.0, "xaég", 7.7 + 12.0 + 11.9);
    is_written(LABEL("n", "1.00", "2.00", "…g"));
    hci_svg_name(out, "n", 1.0, 2.0, "xy", 3.0);
    is_written(LABEL("n", "1.00", "2.00", "…"));
}

/* Two of 15.4 pixels and 4 between them are 19.4 from middle to middle. */
static void test_tags(void)
{
    hci_svg_tag tag[] = {
        {10.0, "q", "10"}, {29.5, "q", "20"}, {49.0, "q", "30"}, {68.5, "q", "40"}, {88.0, "q", "50"}};
    hci_svg_tags(out, tag, 5, 100.0);
    is_written(LABEL("q", "10.00", "117.00", "10") LABEL("q", "29.50", "117.00", "20")
                   LABEL("q", "49.00", "117.00", "30") LABEL("q", "68.50", "117.00", "40")
                       LABEL("q", "88.00", "117.00", "50"));
    tag[4].x = 87.8; /* touches in one row: two of them */
    hci_svg_tags(out, tag, 5, 100.0);
    is_written(LABEL("q", "10.00", "112.00", "10") LABEL("q", "29.50", "123.00", "20")
                   LABEL("q", "49.00", "112.00", "30") LABEL("q", "68.50", "123.00", "40")
                       LABEL("q", "87.80", "112.00", "50"));
    for (size_t k = 0; k < 5; ++k)
        tag[k].x = 9.0 * (double)k;
    hci_svg_tags(out, tag, 5, 100.0); /* every second: 36 from the first to the third of a row */
    is_written(LABEL("q", "0.00", "112.00", "10") LABEL("q", "18.00", "123.00", "30")
                   LABEL("q", "36.00", "112.00", "50"));
    hci_svg_tags(out, tag, 1, 100.0);
    is_written(LABEL("q", "0.00", "117.00", "10"));
}

static void test_the_frame_of_a_picture(void)
{
    hci_svg_begin(out, &(hci_svg_picture){"pic", "A & b", "What <it> is", -3, 4, 500, 300});
    hci_svg_end(out);
    is_written(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" class=\"hci\" viewBox=\"-3 4 500 300\" role=\"img\" "
        "aria-labelledby=\"pic-title\" aria-describedby=\"pic-desc\">\n<title id=\"pic-title\">A &#38; b"
        "</title>\n<desc id=\"pic-desc\">What &#60;it&#62; is</desc>\n</svg>\n");
}

static const hci_svg_entry ENTRY[] = {
    {HCI_SVG_LINE, "l", "ab"}, {HCI_SVG_BAR, "b", "cde"}, {HCI_SVG_DOT, "d", "g"}, {HCI_SVG_CROSS, "", "hu"}};

/* Widths 15.4, 23.1, 7.7 and 15.4; a mark begins 22 before its text, and 38 go from text to text. */
static void test_a_legend_from_the_right(void)
{
    hci_svg_legend(out, ENTRY, 4, 300.0, 50.0);
    is_written(LABEL("legend", "284.60", "50.00",
                     "hu") "<path class=\"cross\" d=\"M268.60 42.00L276.60 50.00\"/>\n"
                           "<path class=\"cross\" d=\"M268.60 50.00L276.60 42.00\"/>\n" LABEL(
                               "legend", "238.90", "50.00",
                               "g") "<circle class=\"d\" cx=\"226.90\" cy=\"46.00\" "
                                    "r=\"4.00\"/>\n" LABEL("legend", "177.80", "50.00",
                                                           "cde") "<rect class=\"b\" "
                                                                  "x=\"160.80\" y=\"41.00\" "
                                                                  "width=\"9.00\" "
                                                                  "height=\"10.00\"/"
                                                                  ">\n" LABEL("legend", "124.40", "50.00",
                                                                              "ab") "<path "
                                                                                    "class="
                                                                                    "\"l\" "
                                                                                    "d="
                                                                                    "\"M102."
                                                                                    "40 "
                                                                                    "46."
                                                                                    "00L118."
                                                                                    "40 "
                                                                                    "46.00\"/"
                                                                                    ">\n");
}

/* A title of 2·7.7·1.22 = 18.788 and the entries, 53.4 and 61.1, are 133.288 from 34 left of the box. */
static void test_title_and_legend_in_a_row(void)
{
    hci_svg_head(out, &(hci_svg_box){100.0, 80.0, 199.29, 200.0}, "uv", ENTRY, 2);
    is_written(LABEL("head", "66.00", "62.00", "uv")
                   LABEL("legend", "176.19", "62.00",
                         "cde") "<rect class=\"b\" x=\"159.19\" y=\"53.00\" width=\"9.00\" "
                                "height=\"10.00\"/>\n" LABEL("legend", "122.79", "62.00",
                                                             "ab") "<path class=\"l\" d=\"M100.79 "
                                                                   "58.00L116.79 58.00\"/>\n");
}

/* One pixel less: the legend has rows of its own. 53.4 + 61.1 − 16 = 98.5 have room in 133.27, and not with
 * the 45.7 of the third. */
static void test_a_legend_in_rows(void)
{
    hci_svg_head(out, &(hci_svg_box){100.0, 80.0, 199.27, 200.0}, "uv", ENTRY, 2);
    is_written(
        LABEL("head", "66.00", "48.00", "uv") "<path class=\"l\" d=\"M66.00 62.00L82.00 62.00\"/>\n" LABEL(
            "legend", "88.00", "66.00", "ab") "<rect class=\"b\" x=\"124.40\" y=\"57.00\" width=\"9.00\" "
                                              "height=\"10.00\"/>\n" LABEL("legend", "141.40", "66.00",
                                                                           "cde"));
    hci_svg_head(out, &(hci_svg_box){100.0, 80.0, 199.27, 200.0}, "uv", ENTRY, 4);
    const char *text = written();
    text_has(LABEL("head", "66.00", "30.00", "uv") "<path class=\"l\" d=\"M66.00 44.00L82.00 44.00\"/>\n",
             text);
    text_has(LABEL("legend", "88.00", "66.00", "g") "<path class=\"cross\" d=\"M117.70 58.00", text);
    hci_svg_head(out, &(hci_svg_box){100.0, 80.0, 100.0, 200.0}, "uv", ENTRY, 3); /* each its own */
    text = written();
    text_has(LABEL("head", "66.00", "12.00", "uv"), text);
    text_has(LABEL("legend", "88.00", "30.00", "ab"), text);
    text_has(LABEL("legend", "88.00", "48.00", "cde"), text);
    text_has(LABEL("legend", "88.00", "66.00", "g"), text);
    hci_svg_head(out, &(hci_svg_box){100.0, 80.0, 164.6, 200.0}, "uvw", ENTRY, 2); /* 98.5 fit in 98.6 */
    text_has(LABEL("legend", "141.40", "66.00", "cde"), written());
    hci_svg_head(out, &(hci_svg_box){100.0, 80.0, 164.4, 200.0}, "uvw", ENTRY, 2);
    text_has(LABEL("legend", "88.00", "66.00", "cde"), written());
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_elements);
    RUN_TEST(test_characters);
    RUN_TEST(test_subscripts);
    RUN_TEST(test_what_is_told);
    RUN_TEST(test_names);
    RUN_TEST(test_tags);
    RUN_TEST(test_the_frame_of_a_picture);
    RUN_TEST(test_a_legend_from_the_right);
    RUN_TEST(test_title_and_legend_in_a_row);
    RUN_TEST(test_a_legend_in_rows);
    return UNITY_END();
}
