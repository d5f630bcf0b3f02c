/* The only file that writes HTML. */
#include "host/draw/html.h"

#include <ctype.h>
#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "hci/host/base/number.h"
#include "hci/version.h"
#include "host/draw/svg.h"

enum { LONGEST_WORD = 24 };

/* The same grounds as those of the pictures. Text has a contrast of at least 4.5 on both. A picture is there
 * twice, for screens and paper and for telephones: only one of them is shown. */
static const char STYLE[] =
    ":root{color-scheme:light dark;--ink:#1c1f23;--quiet:#5a6068;--ground:#fff;--line:#d9dce1;"
    "--panel:#f5f6f8;--good:#00664a;--bad:#a63f00;--link:#005a8e}"
    "@media screen and (prefers-color-scheme:dark){:root{--ink:#eceff2;--quiet:#a6adb6;--ground:#16191d;"
    "--line:#363c45;--panel:#1e2228;--good:#4fd6a8;--bad:#ff9a66;--link:#56b4e9}}"
    "*{box-sizing:border-box}html{-webkit-text-size-adjust:100%}"
    "body{margin:0;background:var(--ground);color:var(--ink);"
    "font:16px/1.5 system-ui,'Helvetica Neue',Arial,sans-serif}"
    "main{max-width:56rem;margin:0 auto;padding:1.5rem 1.25rem 3rem}"
    "h1,h2{font-family:'Iowan Old Style','Palatino Linotype',Palatino,Charter,Georgia,serif;"
    "line-height:1.2;text-wrap:balance}"
    "h1{font-size:2.1rem;margin:.3rem 0 .8rem}"
    "sub{line-height:0}.also{margin:0 0 .8rem;padding-left:1.2rem;max-width:46rem;font-size:1.05rem}.also "
    "li{margin:.2rem "
    "0}.also+.also{margin-top:-.6rem}"
    "h2{font-size:1.3rem;margin:2.2rem 0 .5rem;padding-top:.8rem;border-top:1px solid var(--line)}"
    "h1,h2,p,td,figcaption{overflow-wrap:anywhere}"
    "p{margin:.4rem 0;max-width:46rem}.lead{font-size:1.15rem}p.of{margin:.1rem 0 .1rem 1.2rem}"
    "p.quiet,figcaption,caption,.kicker{color:var(--quiet);font-size:.875rem}"
    ".kicker{border-top:5px solid var(--ink);padding-top:.7rem;margin:0;max-width:none}"
    ".badge{display:inline-block;border:2px solid currentColor;border-radius:.3rem;padding:0 .5rem;"
    "font-weight:700;margin-right:.6rem}.topic{display:inline-block}.good{color:var(--good)}.bad{color:var(--"
    "bad)}"
    "figure{margin:.6rem 0 0}figcaption{max-width:46rem;margin:.3rem 0}"
    ".table{overflow:auto;max-height:28rem}.table+.table{margin-top:1rem}"
    ".wide svg,.narrow svg{display:block;width:100%;height:auto}.narrow{display:none}"
    "details{margin:.3rem 0}summary{cursor:pointer;color:var(--link);font-size:.875rem;width:fit-content}"
    ":focus-visible{outline:3px solid var(--link);outline-offset:2px}"
    ".skip{position:absolute;left:.5rem;top:-4rem;padding:.4rem "
    ".8rem;background:var(--ground);color:var(--link)}"
    ".skip:focus{top:.5rem}"
    "table{border-collapse:collapse;font-size:.8125rem;font-variant-numeric:tabular-nums;min-width:60%}"
    "caption{text-align:left;padding-bottom:.3rem;position:sticky;left:0;max-width:calc(100vw - 2rem)}"
    "th,td{text-align:right;padding:.2rem .5rem;border-bottom:1px solid var(--line);vertical-align:top}"
    "th{position:sticky;top:0;background:var(--ground);vertical-align:bottom}"
    "th.text,td.text{text-align:left}td.text{white-space:nowrap}"
    "td data{white-space:nowrap}td.words{white-space:normal;min-width:9rem}"
    "td:first-child,th:first-child{padding-left:0}"
    ".compare{width:100%;margin:1.2rem 0 .4rem;font-size:1.05rem;table-layout:fixed}"
    ".compare th,.compare td{position:static;text-align:left;padding:.35rem .8rem .35rem "
    "0;overflow-wrap:anywhere}"
    ".compare thead th{color:var(--quiet);font-size:.8125rem;font-weight:400;border-bottom:2px solid "
    "var(--ink)}"
    ".compare thead td{border-bottom:2px solid var(--ink)}.compare tbody "
    "th{font-weight:400;vertical-align:top}.compare td{font-weight:600}"
    ".compare small{display:block;font-weight:400;font-size:.8125rem;color:var(--quiet)}"
    "@media screen and (max-width:36rem){.wide{display:none}.narrow{display:block}h1{font-size:1.6rem}"
    "h2{font-size:1.15rem}.lead,.also{font-size:1rem}.table{max-height:none}.compare{font-size:.9rem}."
    "compare th,.compare "
    "td{padding-right:.5rem}"
    "th,td{padding:.2rem .3rem}td.words{min-width:6.5rem}"
    "main{padding:1rem .8rem 2rem}.kicker{padding-top:.5rem}}"
    "@page{margin:12mm 14mm}"
    "@media print{body{font-size:9.5pt}main{max-width:none;padding:0}.skip{display:none}"
    "h1{font-size:19pt}h2{font-size:12.5pt;margin-top:1rem;padding-top:.4rem}.lead{font-size:11pt}"
    ".also{font-size:10pt}"
    "details:not([open]){display:none}.compare{font-size:10pt;margin:.5rem 0}.compare th,.compare "
    "td{padding-top:.15rem;padding-bottom:.15rem}"
    ".table{overflow:visible;max-height:none}"
    ".wide svg{max-height:9.5cm}figcaption,p.quiet{font-size:8pt}"
    ".wide,tr,p,figcaption{break-inside:avoid}h1,h2,caption,thead{break-after:avoid}"
    "th{position:static}"
    "caption{position:static;max-width:none}th,td{padding:.1rem .4rem}"
    "td.long{white-space:normal;overflow-wrap:anywhere;min-width:11em}td.words{min-width:9em}}";

/* ---- the page ---- */

/* The first `length` bytes of a text. */
static void put_part(hci_output *out, const char *text, size_t length)
{
    char part[4096];
    snprintf(part, sizeof part, "%.*s", (int)length, text);
    hci_svg_text(out, part);
}

static bool is_of_word(char c)
{
    return isalnum((unsigned char)c) || c == '_';
}

/* A current or an inductance with the letter that is its subscript, such as i_q. */
static bool is_symbol(const char *text, const char *at)
{
    return (at[0] == 'i' || at[0] == 'L') && at[1] == '_' && at[2] && strchr("abcdq", at[2]) &&
           !is_of_word(at[3]) && (at == text || !is_of_word(at[-1]));
}

/* The first `length` bytes of a sentence. */
static void put_prose(hci_output *out, const char *text, size_t length)
{
    const char *from = text;
    for (const char *at = text; at < text + length; ++at) {
        if (!is_symbol(text, at)) continue;
        put_part(out, from, (size_t)(at - from));
        hci_output_text(out, "%c<sub>%c</sub>", at[0], at[2]);
        at += 2;
        from = at + 1;
    }
    put_part(out, from, (size_t)(text + length - from));
}

/* What stands between two grave accents is code. */
static void put_with_code(hci_output *out, const char *text)
{
    const char *begin, *end;
    while ((begin = strchr(text, '`')) != NULL && (end = strchr(begin + 1, '`')) != NULL) {
        put_prose(out, text, (size_t)(begin - text));
        hci_output_text(out, "<code>");
        put_part(out, begin + 1, (size_t)(end - begin - 1));
        hci_output_text(out, "</code>");
        text = end + 1;
    }
    put_prose(out, text, strlen(text));
}

/* Bytes of a sentence up to the semicolon after its first clause, outside parentheses. */
static size_t clause_of(const char *text)
{
    int depth = 0;
    size_t k = 0;
    for (; text[k] && !(depth == 0 && text[k] == ';' && text[k + 1] == ' '); ++k)
        depth += (text[k] == '(') - (text[k] == ')');
    return k;
}

/* A clause, as a sentence begins: but for names such as i_q. */
static void put_clause(hci_output *out, const char *text, size_t length)
{
    char clause[2048];
    snprintf(clause, sizeof clause, "%.*s", (int)length, text);
    if (clause[0] && clause[1] != '_') clause[0] = (char)toupper((unsigned char)clause[0]);
    put_with_code(out, clause);
}

static void put_item(hci_output *out, const char *text, size_t length)
{
    hci_output_text(out, "<li>");
    put_clause(out, text, length);
    hci_output_text(out, "</li>\n");
}

/* The first clause is the heading, the others are a list under it. */
static void put_heading_and_rest(hci_output *out, const char *text)
{
    size_t length = clause_of(text);
    hci_output_text(out, "<h1>");
    put_clause(out, text, length);
    hci_output_text(out, "</h1>\n");
    if (!text[length]) return;
    hci_output_text(out, "<ul class=\"also\">\n");
    for (text += length; *text; text += length) {
        text += 2;
        length = clause_of(text);
        put_item(out, text, length);
    }
    hci_output_text(out, "</ul>\n");
}

/* One that is set in belongs to the item above, and is a formula. */
static void put_line_of_item(hci_output *out, const char *text, size_t length)
{
    char formula[2048];
    snprintf(formula, sizeof formula, "`%.*s`", (int)length, text);
    hci_output_text(out, "<li style=\"list-style:none\">");
    put_with_code(out, formula);
    hci_output_text(out, "</li>\n");
}

void hci_html_also(hci_output *out, const char *text)
{
    if (!*text) return;
    hci_output_text(out, "<ul class=\"also\">\n");
    while (*text) {
        const size_t length = strcspn(text, "\n"), blanks = strspn(text, " ");
        if (blanks > 0)
            put_line_of_item(out, text + blanks, length - blanks);
        else
            put_item(out, text, length);
        text += length + (text[length] == '\n');
    }
    hci_output_text(out, "</ul>\n");
}

void hci_html_begin(hci_output *out, const hci_html_opening *o)
{
    hci_output_text(out, "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\"/>\n"
                         "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\"/>\n"
                         "<meta name=\"generator\" content=\"hci-solve " HCI_VERSION_STRING "\"/>\n<title>");
    put_part(out, o->heading, clause_of(o->heading));
    hci_output_text(out,
                    "</title>\n<style>%s\n%s</style>\n</head>\n<body>\n<a class=\"skip\" href=\"#evidence\">"
                    "Skip to the evidence</a>\n<main>\n<p class=\"kicker\"><span class=\"badge %s\">",
                    STYLE, hci_svg_style, o->good ? "good" : "bad");
    hci_svg_text(out, o->badge);
    hci_output_text(out, "</span> <span class=\"topic\">");
    hci_svg_text(out, o->kicker);
    hci_output_text(out, "</span></p>\n");
    put_heading_and_rest(out, o->heading);
}

void hci_html_end(hci_output *out)
{
    hci_html_paragraph(out, "quiet",
                       "Written by hci-solve " HCI_VERSION_STRING ". Amplitudes are peak values, angles "
                       "and orders electrical, unless it says otherwise. Four significant digits are "
                       "shown; the CSV files beside this one hold all of them. On a screen each mark "
                       "tells its value under the pointer.");
    hci_output_text(out, "</main>\n</body>\n</html>\n");
}

/* ---- text ---- */

static void put_element(hci_output *out, const char *name, const char *style, const char *text)
{
    hci_output_text(out, "<%s%s%s%s>", name, style ? " class=\"" : "", style ? style : "", style ? "\"" : "");
    hci_svg_text(out, text);
    hci_output_text(out, "</%s>\n", name);
}

void hci_html_paragraph(hci_output *out, const char *style, const char *text)
{
    hci_output_text(out, "<p%s%s%s>", style ? " class=\"" : "", style ? style : "", style ? "\"" : "");
    put_with_code(out, text);
    hci_output_text(out, "</p>\n");
}

void hci_html_say(hci_output *out, const char *style, const char *format, ...)
{
    char text[4096];
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(text, sizeof text, format, arguments);
    va_end(arguments);
    hci_html_paragraph(out, style, text);
}

void hci_html_section(hci_output *out, const char *heading)
{
    hci_output_text(out, "<section>\n<h2>");
    put_prose(out, heading, strlen(heading));
    hci_output_text(out, "</h2>\n");
}

void hci_html_section_end(hci_output *out)
{
    hci_output_text(out, "</section>\n");
}

void hci_html_evidence(hci_output *out)
{
    hci_output_text(out, "<div id=\"evidence\" tabindex=\"-1\"></div>\n");
}

/* ---- before and after ---- */

void hci_html_compare(hci_output *out, const char *const *column)
{
    hci_output_text(out, "<table class=\"compare\">\n<thead><tr><td></td>");
    for (; *column; ++column) {
        hci_output_text(out, "<th scope=\"col\">");
        hci_svg_text(out, *column);
        hci_output_text(out, "</th>");
    }
    hci_output_text(out, "</tr></thead>\n<tbody>\n");
}

/* "2.5 N·m|98 %": what follows the bar is a small second line, or all there is. */
static void put_compared(hci_output *out, const char *text)
{
    char first[256];
    const char *bar = strchr(text, '|');
    snprintf(first, sizeof first, "%.*s", (int)(bar ? bar - text : (long)strlen(text)), text);
    hci_output_text(out, "<td>");
    hci_svg_text(out, first);
    if (bar) put_element(out, "small", NULL, bar + 1);
    hci_output_text(out, "</td>");
}

void hci_html_compare_row(hci_output *out, const char *name, const char *const *value)
{
    hci_output_text(out, "<tr><th scope=\"row\">");
    hci_svg_text(out, name);
    hci_output_text(out, "</th>");
    for (; *value; ++value)
        put_compared(out, *value);
    hci_html_row_end(out);
}

void hci_html_compare_end(hci_output *out)
{
    hci_output_text(out, "</tbody>\n</table>\n");
    hci_html_evidence(out);
}

/* ---- what is folded away ---- */

void hci_html_fold(hci_output *out, const char *summary)
{
    hci_output_text(out, "<details>");
    put_element(out, "summary", NULL, summary);
}

void hci_html_fold_end(hci_output *out)
{
    hci_output_text(out, "</details>\n");
}

/* ---- drawings ---- */

/* Pixels of a drawing: its width, and what its box leaves free at the top and at the bottom. */
enum { WIDE = 760, NARROW = 360, LEFT = 12, RIGHT = 14, BOTTOM = 44, WIDE_TOP = 38, ROW = 18 };

static void draw(hci_output *out, const hci_html_drawing *d, bool is_narrow)
{
    const int width = is_narrow ? NARROW : WIDE, height = is_narrow ? d->narrow : d->wide;
    const int rows = d->legend_rows > 0 ? d->legend_rows : 2;
    const int top = d->headless ? 8 : is_narrow ? WIDE_TOP - 10 + ROW * rows : WIDE_TOP;
    const hci_svg_box box = {LEFT + HCI_SVG_MARGIN, top, LEFT + width - RIGHT, height - BOTTOM};
    char id[64];
    snprintf(id, sizeof id, "%.40s%s", d->id, is_narrow ? "-narrow" : "");
    hci_output_text(out, "<div class=\"%s\">\n", is_narrow ? "narrow" : "wide");
    hci_svg_begin(out, &(hci_svg_picture){id, d->title, d->description, LEFT, 0, width, height});
    d->draw(out, &box, d->context);
    hci_svg_end(out);
    hci_output_text(out, "</div>\n");
}

void hci_html_drawing_begin(hci_output *out, const hci_html_drawing *d)
{
    hci_output_text(out, "<figure>\n");
    draw(out, d, false);
    draw(out, d, true);
    hci_output_text(out, "<figcaption>");
    put_with_code(out, d->caption);
    hci_output_text(out, "</figcaption>\n");
    hci_html_fold(out, "Numbers and sources");
}

void hci_html_drawing_end(hci_output *out, const char *numbers, const char *origin)
{
    hci_html_say(out, "quiet", " Numbers: %s%s%s.", numbers, origin[0] ? ". Made from: " : "", origin);
    hci_html_fold_end(out);
    hci_output_text(out, "</figure>\n");
}

/* ---- tables ---- */

void hci_html_table(hci_output *out, const char *caption, const char *const *column)
{
    hci_output_text(out, "<div class=\"table\" tabindex=\"0\" role=\"region\" aria-label=\"");
    hci_svg_text(out, caption);
    hci_output_text(out, "\">\n<table>\n");
    put_element(out, "caption", NULL, caption);
    hci_output_text(out, "<thead><tr>");
    for (; *column; ++column) {
        const bool is_text = **column == '<';
        hci_output_text(out, is_text ? "<th scope=\"col\" class=\"text\">" : "<th scope=\"col\">");
        hci_svg_text(out, *column + is_text);
        hci_output_text(out, "</th>");
    }
    hci_output_text(out, "</tr></thead>\n<tbody>\n");
}

void hci_html_table_end(hci_output *out)
{
    hci_output_text(out, "</tbody>\n</table>\n</div>\n");
}

void hci_html_row(hci_output *out)
{
    hci_output_text(out, "<tr>");
}

void hci_html_row_end(hci_output *out)
{
    hci_output_text(out, "</tr>\n");
}

static void put_cell(hci_output *out, const char *style, const char *text)
{
    hci_output_text(out, "<td class=\"%s\">", style);
    hci_svg_text(out, text);
    hci_output_text(out, "</td>");
}

/* On paper a long one may break anywhere. */
void hci_html_cell(hci_output *out, const char *text)
{
    put_cell(out, strlen(text) > LONGEST_WORD ? "text long" : "text", text);
}

void hci_html_cell_words(hci_output *out, const char *text)
{
    put_cell(out, "text words", text);
}

/* ---- numbers ---- */

/* A power of ten is exact up to 22, so that the quotient is the nearest double of the digits; beyond, that is
 * what the digits are read as. */
static double rounded(double value, int digits)
{
    const int exponent = value != 0.0 ? (int)floor(log10(fabs(value))) + 1 - digits : 0;
    const double power = pow(10.0, abs(exponent) <= 22 ? abs(exponent) : 0);
    char text[48];
    if (exponent >= -22 && exponent <= 22)
        return exponent < 0 ? round(value * power) / power : round(value / power) * power;
    /* in two steps, since 10^exponent may be no number while the value is one */
    const double half = pow(10.0, exponent / 2), whole = value / half / pow(10.0, exponent - exponent / 2);
    snprintf(text, sizeof text, "%.0fe%d", round(whole), exponent);
    return hci_number_parse(text, &value) ? value : whole;
}

static void put_digits(char text[HCI_HTML_NUMBER_SIZE], double value, int digits)
{
    char plain[32];
    if (!isfinite(value)) {
        snprintf(text, HCI_HTML_NUMBER_SIZE, "–");
        return;
    }
    hci_number_text(rounded(value, digits), plain);
    text[0] = '\0';
    for (const char *c = plain; *c; ++c)
        snprintf(text + strlen(text), HCI_HTML_NUMBER_SIZE - strlen(text), *c == '-' ? "−" : "%c", *c);
}

void hci_html_number_text(char text[HCI_HTML_NUMBER_SIZE], double value)
{
    put_digits(text, value, 3);
}

#define ROUNDED_Nm      1e-12
#define ROUNDED_PERCENT 1e-9

void hci_html_quantity_text(char text[HCI_HTML_NUMBER_SIZE], double value, const char *unit)
{
    const bool is_share = strcmp(unit, "%") == 0 || strcmp(unit, "×") == 0;
    if (fabs(value) < (is_share ? ROUNDED_PERCENT : strcmp(unit, "N·m") == 0 ? ROUNDED_Nm : 0.0)) value = 0.0;
    if (!is_share) {
        hci_svg_axis_text(text, value, unit);
        return;
    }
    put_digits(text, value, 3);
    snprintf(text + strlen(text), HCI_HTML_NUMBER_SIZE - strlen(text), " %s", unit);
}

static void put_number(hci_output *out, double value, int digits)
{
    char text[HCI_HTML_NUMBER_SIZE], exact[32];
    put_digits(text, value, digits);
    hci_number_text(value, exact);
    if (isfinite(value))
        hci_output_text(out, "<td><data value=\"%s\">%s</data></td>", exact, text);
    else
        hci_output_text(out, "<td>%s</td>", text);
}

void hci_html_number(hci_output *out, double value)
{
    put_number(out, value, 4);
}

void hci_html_number_above(hci_output *out, double value, double least)
{
    char exact[32];
    if (!(fabs(value) < least)) {
        put_number(out, value, 4);
        return;
    }
    hci_number_text(value, exact);
    hci_output_text(out, "<td><data value=\"%s\">0</data></td>", exact);
}

void hci_html_number_in(hci_output *out, double value, double span)
{
    const double share = fabs(value) / span;
    put_number(out, value, share > 1.0 && share < 1e8 ? 4 + (int)log10(share) : 4);
}

void hci_html_quantity(hci_output *out, const char *name, double value)
{
    if (!isfinite(value)) return;
    hci_html_row(out);
    hci_html_cell(out, name);
    hci_html_number(out, value);
    hci_html_row_end(out);
}
