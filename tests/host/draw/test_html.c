/* What a page is made of, piece by piece: headings and their clauses, code, tables, drawings with their
 * boxes, numbers with their digits. */
#include "host/draw/html.h"

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
    out = written_begin("h");
}

void tearDown(void)
{
    hci_output_discard(out);
    files_end();
}

/* What was written so far; the next piece begins. */
static const char *written(void)
{
    const char *text = written_end(out, "h");
    out = written_begin("h");
    return text;
}

static void is_written(const char *expected)
{
    TEST_ASSERT_EQUAL_STRING(expected, written());
}

/* ---- text ---- */

static void test_code(void)
{
    static const char *const CASE[][2] = {{"a `b` c `d<` e", "a <code>b</code> c <code>d&#60;</code> e"},
                                          {"`b`", "<code>b</code>"},
                                          {"a `b", "a `b"},
                                          {"a `` & `c", "a <code></code> &#38; `c"}};
    char expected[200];
    for (size_t k = 0; k < sizeof CASE / sizeof CASE[0]; ++k) {
        hci_html_paragraph(out, "s", CASE[k][0]);
        snprintf(expected, sizeof expected, "<p class=\"s\">%s</p>\n", CASE[k][1]);
        is_written(expected);
    }
    hci_html_paragraph(out, NULL, "x");
    is_written("<p>x</p>\n");
    hci_html_say(out, NULL, "%d of %s", 3, "`f`");
    is_written("<p>3 of <code>f</code></p>\n");
}

/* The part of a page from the kicker to its heading and list. */
static const char *opening(const char *heading, bool good)
{
    hci_html_begin(out, &(hci_html_opening){"kick & off", "ba<d", heading, good});
    return written();
}

static void test_the_opening(void)
{
    const char *text =
        opening("one is (two; three) and `f`; i_q is four; Δ (five; (six; a) b); seven;eight", true);
    text_has("<title>one is (two; three) and `f`</title>", text);
    text_has(
        "<p class=\"kicker\"><span class=\"badge good\">ba&#60;d</span> <span class=\"topic\">kick &#38; off"
        "</span></p>\n<h1>One is (two; three) and <code>f</code></h1>\n<ul "
        "class=\"also\">\n<li>i<sub>q</sub> "
        "is four</li>\n"
        "<li>Δ (five; (six; a) b)</li>\n<li>Seven;eight</li>\n</ul>\n",
        text);
    text = opening("i_d alone", false);
    text_has("<span class=\"badge bad\">", text);
    text_has("<h1>i<sub>d</sub> alone</h1>\n", text);
    text_lacks("<ul", text);
    text_has("<h1>X</h1>\n", opening("x", false));
    text_has("<h1></h1>\n", opening("", false));
}

static void test_further_items(void)
{
    hci_html_also(out, "");
    hci_html_also(out, "first\nsecond `c`");
    hci_html_also(out, "third\n");
    is_written("<ul class=\"also\">\n<li>First</li>\n<li>Second <code>c</code></li>\n</ul>\n"
               "<ul class=\"also\">\n<li>Third</li>\n</ul>\n");
    hci_html_also(out, "corrected:\n  theta = theta_read - 0.1");
    is_written("<ul class=\"also\">\n<li>Corrected:</li>\n"
               "<li style=\"list-style:none\"><code>theta = theta_read - 0.1</code></li>\n</ul>\n");
}

static void test_sections(void)
{
    hci_html_section(out, "i_d and i_q & i_x, i_");
    hci_html_section_end(out);
    hci_html_evidence(out);
    hci_html_fold(out, "a & b");
    hci_html_fold_end(out);
    is_written(
        "<section>\n<h2>i<sub>d</sub> and i<sub>q</sub> &#38; i_x, i_</h2>\n</section>\n"
        "<div id=\"evidence\" tabindex=\"-1\"></div>\n<details><summary>a &#38; b</summary>\n</details>\n");
    hci_html_section(out, "axi_a");
    is_written("<section>\n<h2>axi_a</h2>\n");
    hci_html_paragraph(out, NULL, "L_q of 3 N·m, i_a_rms, 2 A; 4 Amp `i_b 5 A` i_b");
    is_written("<p>L<sub>q</sub> of 3 N·m, i_a_rms, 2 A; 4 Amp <code>i_b 5 A</code> i<sub>b</sub></p>\n");
    hci_html_end(out);
    text_has("</p>\n</main>\n</body>\n</html>\n", written());
}

/* ---- tables ---- */

static void test_before_and_after(void)
{
    static const char *const COLUMN[] = {"be<fore", "after", NULL}, *const VALUE[] = {"2.5|98 %", "3", "|x",
                                                                                      NULL};
    hci_html_compare(out, COLUMN);
    hci_html_compare_row(out, "r & s", VALUE);
    hci_html_compare_end(out);
    is_written(
        "<table class=\"compare\">\n<thead><tr><td></td><th scope=\"col\">be&#60;fore</th><th scope=\"col\">"
        "after</th></tr></thead>\n<tbody>\n<tr><th scope=\"row\">r &#38; s</th><td>2.5<small>98 %</small>\n"
        "</td><td>3</td><td><small>x</small>\n</td></tr>\n</tbody>\n</table>\n"
        "<div id=\"evidence\" tabindex=\"-1\"></div>\n");
}

static void test_a_table(void)
{
    static const char *const COLUMN[] = {"<name", "x & y", NULL};
    hci_html_table(out, "cap & tion", COLUMN);
    hci_html_quantity(out, "q<", 1.5);
    hci_html_quantity(out, "none", NAN);
    hci_html_row(out);
    hci_html_cell(out, "a word with 24 letters..");
    hci_html_cell(out, "a word with 25 letters...");
    hci_html_cell_words(out, "&");
    hci_html_row_end(out);
    hci_html_table_end(out);
    is_written("<div class=\"table\" tabindex=\"0\" role=\"region\" aria-label=\"cap &#38; tion\">\n<table>\n"
               "<caption>cap &#38; tion</caption>\n<thead><tr><th scope=\"col\" class=\"text\">name</th>"
               "<th scope=\"col\">x &#38; y</th></tr></thead>\n<tbody>\n"
               "<tr><td class=\"text\">q&#60;</td><td><data value=\"1.5\">1.5</data></td></tr>\n"
               "<tr><td class=\"text\">a word with 24 letters..</td><td class=\"text long\">a word with 25 "
               "letters..."
               "</td><td class=\"text words\">&#38;</td></tr>\n</tbody>\n</table>\n</div>\n");
}

/* ---- drawings ---- */

static hci_svg_box box[2];
static int drawn;

static void draw(hci_output *o, const hci_svg_box *b, const void *context)
{
    box[drawn++] = *b;
    hci_svg_text(o, context);
}

static void is_box(double top, double right, double bottom, hci_svg_box b)
{
    TEST_ASSERT_EQUAL_DOUBLE(58.0, b.left);
    TEST_ASSERT_EQUAL_DOUBLE(top, b.top);
    TEST_ASSERT_EQUAL_DOUBLE(right, b.right);
    TEST_ASSERT_EQUAL_DOUBLE(bottom, b.bottom);
}

/* 760 and 360 pixels from 12 on, 14 free at the right and 44 below; above 38, or 28 and the rows of a legend.
 */
static void test_a_drawing(void)
{
    hci_html_drawing d = {"pic", "ti & tle", "des", "see `c`", 300, 250, 0, false, draw, "<inner>"};
    drawn = 0;
    hci_html_drawing_begin(out, &d);
    hci_html_drawing_end(out, "`a.csv`", "`b.csv`");
    const char *text = written();
    text_has("<figure>\n<div class=\"wide\">\n<svg", text);
    text_has("viewBox=\"12 0 760 300\"", text);
    text_has("<title id=\"pic-title\">ti &#38; tle</title>\n<desc "
             "id=\"pic-desc\">des</desc>\n&#60;inner&#62;</svg>\n"
             "</div>\n<div class=\"narrow\">\n<svg",
             text);
    text_has("viewBox=\"12 0 360 250\"", text);
    text_has("<title id=\"pic-narrow-title\">", text);
    text_has(
        "</svg>\n</div>\n<figcaption>see <code>c</code></figcaption>\n<details><summary>Numbers and sources"
        "</summary>\n<p class=\"quiet\"> Numbers: <code>a.csv</code>. Made from: "
        "<code>b.csv</code>.</p>\n</details>\n"
        "</figure>\n",
        text);
    TEST_ASSERT_EQUAL_INT(2, drawn);
    is_box(38.0, 758.0, 256.0, box[0]);
    is_box(64.0, 358.0, 206.0, box[1]);
    hci_html_drawing_end(out, "x", "");
    is_written("<p class=\"quiet\"> Numbers: x.</p>\n</details>\n</figure>\n");
    d.legend_rows = 1, drawn = 0;
    hci_html_drawing_begin(out, &d);
    is_box(38.0, 758.0, 256.0, box[0]);
    is_box(46.0, 358.0, 206.0, box[1]);
    d.headless = true, drawn = 0;
    hci_html_drawing_begin(out, &d);
    is_box(8.0, 758.0, 256.0, box[0]);
    is_box(8.0, 358.0, 206.0, box[1]);
}

/* ---- numbers ---- */

static void test_three_digits(void)
{
    static const struct {
        double value;
        const char *text;
    } CASE[] = {{0.0, "0"},
                {12345.0, "12300"},
                {-0.0123456, "−0.0123"},
                {9.996, "10"},
                {NAN, "–"},
                {HUGE_VAL, "–"},
                {1.2345e24, "1.23e24"},
                {1.2345e25, "1.23e25"},
                {-4.5678e-30, "−4.57e−30"},
                {1.2345e-20, "1.23e−20"},
                {1.2367e300, "1.24e300"},
                {1.2367e-300, "1.24e−300"},
                {0.5, "0.5"}};
    for (size_t k = 0; k < sizeof CASE / sizeof CASE[0]; ++k) {
        char text[HCI_HTML_NUMBER_SIZE], plain[HCI_HTML_NUMBER_SIZE] = "";
        hci_html_number_text(text, CASE[k].value);
        for (const char *c = text; *c; ++c) /* however the library writes an exponent: without + and 0 */
            if (*c != '+') strncat(plain, c, 1);
        TEST_ASSERT_EQUAL_STRING(CASE[k].text, plain);
    }
}

static void test_quantities(void)
{
    static const struct {
        double value;
        const char *unit, *text;
    } CASE[] = {
        {1.23456, "N·m", "1.235 N·m"}, {1.01e-5, "N·m", "0.0000101 N·m"}, {0.99e-5, "N·m", "9.9 µN·m"},
        {1e-12, "N·m", "1 pN·m"},      {0.9e-12, "N·m", "0 N·m"},         {-0.9e-12, "N·m", "0 N·m"},
        {12.345, "%", "12.3 %"},       {-1.2345, "×", "−1.23 ×"},         {0.9e-9, "%", "0 %"},
        {1.1e-9, "×", "1.1e−9 ×"},     {0.0256, "A", "0.0256 A"},         {-1.23456e3, "N·m", "−1235 N·m"}};
    for (size_t k = 0; k < sizeof CASE / sizeof CASE[0]; ++k) {
        char text[HCI_HTML_NUMBER_SIZE], plain[HCI_HTML_NUMBER_SIZE] = "";
        hci_html_quantity_text(text, CASE[k].value, CASE[k].unit);
        for (const char *c = text; *c; ++c) /* the blank before the unit is one at which no line breaks */
            strcat(plain, strncmp(c, "\xC2\xA0", 2) == 0 ? (++c, " ") : (char[]){*c, '\0'});
        TEST_ASSERT_EQUAL_STRING(CASE[k].text, plain);
    }
}

static void test_cells_of_numbers(void)
{
    static const struct {
        double value, span;
        const char *text;
    } CASE[] = {{12.3456789, 20.0, "12.35"},       {12.3456789, 12.0, "12.35"},
                {12.3456789, 1.2, "12.346"},       {12.3456789, 0.12, "12.3457"},
                {-12.3456789, 0.12, "−12.3457"},   {12.3456789, 1e-7, "12.35"},
                {12.3456789, 1.3e-7, "12.3456789"}};
    char expected[100];
    for (size_t k = 0; k < sizeof CASE / sizeof CASE[0]; ++k) {
        hci_html_number_in(out, CASE[k].value, CASE[k].span);
        snprintf(expected, sizeof expected, "<td><data value=\"%s12.3456789\">%s</data></td>",
                 CASE[k].value < 0.0 ? "-" : "", CASE[k].text);
        is_written(expected);
    }
    hci_html_number_above(out, 0.123456, 0.123456);
    hci_html_number_above(out, -0.0123456, 0.01234561);
    hci_html_number_above(out, NAN, 1.0);
    hci_html_number(out, -12345.6);
    is_written("<td><data value=\"0.123456\">0.1235</data></td><td><data "
               "value=\"-0.0123456\">0</data></td><td>–</td>"
               "<td><data value=\"-12345.6\">−12350</data></td>");
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_code);
    RUN_TEST(test_the_opening);
    RUN_TEST(test_further_items);
    RUN_TEST(test_sections);
    RUN_TEST(test_before_and_after);
    RUN_TEST(test_a_table);
    RUN_TEST(test_a_drawing);
    RUN_TEST(test_three_digits);
    RUN_TEST(test_quantities);
    RUN_TEST(test_cells_of_numbers);
    return UNITY_END();
}
