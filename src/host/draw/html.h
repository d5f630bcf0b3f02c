/* Writing a page: one file without script, font or picture from elsewhere, for screens light and dark, for
 * telephones and for paper. It is well-formed XML too. Texts are escaped here. */
#ifndef HCI_SRC_HOST_DRAW_HTML_H
#define HCI_SRC_HOST_DRAW_HTML_H

#include <stdbool.h>

#include "hci/host/base/output.h"
#include "host/draw/svg.h"

enum { HCI_HTML_NUMBER_SIZE = 48 };

/* ---- the page ---- */

/* How a page opens: kicker, what was done and with what; badge: the verdict in a word or a few; heading: what
 * was found, as a sentence, of which what follows a semicolon is a list under the heading; good: whether it
 * is what one hopes for. */
typedef struct {
    const char *kicker, *badge, *heading;
    bool good;
} hci_html_opening;

/* Up to the heading. */
void hci_html_begin(hci_output *out, const hci_html_opening *opening);
void hci_html_end(hci_output *out);

/* Lines as further items under the heading; "": none. */
void hci_html_also(hci_output *out, const char *lines);

/* ---- text ---- */

/* What stands between two grave accents in the text is set as code. */
void hci_html_paragraph(hci_output *out, const char *style, const char *text);

/* The same of parts that are put together, at most 4095 bytes. */
void hci_html_say(hci_output *out, const char *style, const char *format, ...) HCI_PRINTF(3, 4);

void hci_html_section(hci_output *out, const char *heading);
void hci_html_section_end(hci_output *out);

/* After the verdict comes the evidence, to which the first link of the page leads. */
void hci_html_evidence(hci_output *out);

/* ---- before and after ---- */

/* A table of large figures, the same quantity before and after in each row. column: headings without that of
 * the names, NULL at the end. After it comes the evidence. */
void hci_html_compare(hci_output *out, const char *const *column);

/* value: one for each column, NULL at the end; what follows a | is a second line in small letters. */
void hci_html_compare_row(hci_output *out, const char *name, const char *const *value);
void hci_html_compare_end(hci_output *out);

/* ---- a drawing at full width ---- */

/* Drawn twice, for a screen or paper and for a telephone; wide, narrow: its heights. The box is that of the
 * axes: numbers and title of an axis have room around it, and over it a title and a legend, which may take
 * so many legend_rows where it is narrow, 2 without it; headless: nothing over it. */
typedef struct {
    const char *id, *title, *description, *caption;
    int wide, narrow, legend_rows;
    bool headless;
    void (*draw)(hci_output *out, const hci_svg_box *box, const void *context);
    const void *context;
} hci_html_drawing;

/* The drawing and its caption. Between the two come tables, which are folded away. */
void hci_html_drawing_begin(hci_output *out, const hci_html_drawing *drawing);

/* numbers: the files that hold them; origin: those that they were made from. */
void hci_html_drawing_end(hci_output *out, const char *numbers, const char *origin);

/* What is only of interest to some: shown on request. */
void hci_html_fold(hci_output *out, const char *summary);
void hci_html_fold_end(hci_output *out);

/* ---- tables ---- */

/* column: names with units, NULL at the end; those that begin with '<' hold text and are aligned to the
 * left. */
void hci_html_table(hci_output *out, const char *caption, const char *const *column);
void hci_html_table_end(hci_output *out);
void hci_html_row(hci_output *out);
void hci_html_row_end(hci_output *out);
void hci_html_cell(hci_output *out, const char *text);

/* A text that may take several lines. */
void hci_html_cell_words(hci_output *out, const char *text);

/* With its unit and a prefix to that, but for % and ×. */
void hci_html_quantity_text(char text[HCI_HTML_NUMBER_SIZE], double value, const char *unit);

/* A row of a name and a number; nothing where it is not finite. */
void hci_html_quantity(hci_output *out, const char *name, double value);

/* Four significant digits, and the whole number for programs; a dash for what is not finite. */
void hci_html_number(hci_output *out, double value);

/* The same; what is below `least` is rounding and shown as 0. */
void hci_html_number_above(hci_output *out, double value, double least);

/* With as many digits more as tell a thousandth of `span` apart, which is that of the values in the column.
 */
void hci_html_number_in(hci_output *out, double value, double span);

/* Three significant digits, for sentences. */
void hci_html_number_text(char text[HCI_HTML_NUMBER_SIZE], double value);

#endif
