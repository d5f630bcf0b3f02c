/* The page of `tune`: verdict, before and after, the pictures, and what was read, found and left open. */
#include "host/report/tune/page_tuning.h"

#include <ctype.h>
#include <stdarg.h>
#include <stdio.h>
#include <string.h>

#include "host/base/words.h"
#include "host/draw/html.h"
#include "host/report/page/solution_sections.h"
#include "host/report/tune/tuning_pictures.h"

const char *hci_tuning_part_name(hci_tuning_part part)
{
    static const char *const NAMES[] = {
        "Before it is used", "What was read",       "What was found", "What was solved for",
        "What is not known", "What to record next", "Into the drive", "Other drives, other torques"};
    return NAMES[part];
}

/* Whether the line that begins at `last` stands before it already. */
static bool is_said(const char *text, const char *last)
{
    const size_t length = strlen(last);
    for (const char *line = text; line < last; line += strcspn(line, "\n") + 1)
        if (strncmp(line, last, length) == 0) return true;
    return false;
}

void hci_tuning_say(hci_tuning *t, hci_tuning_part part, const char *format, ...)
{
    char *last = t->part[part] + strlen(t->part[part]);
    const hci_words words = {t->part[part], sizeof t->part[part]};
    va_list arguments;
    va_start(arguments, format);
    hci_words_say_list(&words, format, arguments);
    va_end(arguments);
    hci_words_say(&words, "\n");
    if (is_said(t->part[part], last) && *last != ' ') *last = '\0';
}

void hci_tuning_swing(const hci_solution *s, double *before_Nm, double *after_Nm)
{
    hci_plot_facts facts;
    hci_plot_solution_facts(s, &facts);
    *before_Nm = facts.before_Nm.high - facts.before_Nm.low;
    *after_Nm = facts.after_Nm.high - facts.after_Nm.low;
}

bool hci_tuning_knows_ripple(const hci_solution *s)
{
    double before_Nm, after_Nm;
    hci_tuning_swing(s, &before_Nm, &after_Nm);
    return before_Nm >= s->tolerance_Nm;
}

/* Of the table that was emitted, where that is known. */
static void show_before_and_after(const hci_solution_page *page, double table_Nm)
{
    hci_solution_page p = *page;
    if (table_Nm > 0.0) p.facts.after_Nm = (hci_range){0.0, table_Nm};
    hci_page_before_and_after(&p);
}

/* A sentence begins with a capital; a name, as of a file or a column, stays as it is. */
static void say_line(hci_output *out, const char *style, const char *text, size_t length)
{
    char line[4096];
    snprintf(line, sizeof line, "%.*s", (int)length, text);
    const size_t word = strspn(line, "abcdefghijklmnopqrstuvwxyz");
    if (word > 0 && strchr(" ,:", line[word])) line[0] = (char)toupper((unsigned char)line[0]);
    hci_html_paragraph(out, style, line);
}

/* What is set in belongs to the line above it. */
static void say_lines(hci_output *out, const char *text)
{
    while (*text) {
        const size_t length = strcspn(text, "\n");
        const size_t blanks = strspn(text, " ");
        if (blanks > 0)
            hci_html_say(out, "of", "%.*s", (int)(length - blanks), text + blanks);
        else
            say_line(out, "", text, length);
        text += length + (text[length] == '\n');
    }
}

static void show_part(hci_output *out, const hci_tuning *t, hci_tuning_part part)
{
    if (!t->part[part][0]) return;
    hci_html_section(out, hci_tuning_part_name(part));
    say_lines(out, t->part[part]);
    hci_html_section_end(out);
}

/* What the solution remarks, but for effects that no current takes away: those are in what was found. */
static void say_remark(hci_output *out, const hci_solution *s)
{
    char remark[sizeof s->remark.text];
    snprintf(remark, sizeof remark, "%s", s->remark.text);
    char *left_out = strstr(remark, "effects.csv: not compensated");
    if (left_out) left_out[left_out > remark ? -2 : 0] = '\0'; /* what stands before it ends in "; " */
    if (remark[0]) hci_html_paragraph(out, NULL, remark);
}

static void fold_part(hci_output *out, const hci_tuning *t, hci_tuning_part part)
{
    if (!t->part[part][0]) return;
    hci_html_fold(out, hci_tuning_part_name(part));
    say_lines(out, t->part[part]);
    if (part == HCI_TUNING_WANTED) say_remark(out, t->solution);
    hci_html_fold_end(out);
}

/* ---- the page ---- */

/* What only explains how it came about is folded away beside a table. */
static void show_parts(hci_output *out, const hci_tuning *t)
{
    enum { FOLDS = 4 };
    static const hci_tuning_part SHOWN[] = {HCI_TUNING_UNKNOWN, HCI_TUNING_NEXT, HCI_TUNING_LOAD};
    static const hci_tuning_part FOLDED[FOLDS] = {HCI_TUNING_ELSE, HCI_TUNING_READ, HCI_TUNING_FOUND,
                                                  HCI_TUNING_WANTED};
    for (size_t k = 0; k < FOLDS && t->solution == NULL; ++k)
        show_part(out, t, FOLDED[k]);
    for (size_t k = 0; k < 3; ++k)
        show_part(out, t, SHOWN[k]);
    for (size_t k = 0; k < FOLDS && t->solution != NULL; ++k)
        fold_part(out, t, FOLDED[k]);
}

void hci_page_tuning(hci_output *out, const hci_tuning *t)
{
    hci_solution_page p = {.out = out, .solution = t->solution, .origin = "currents"};
    hci_html_begin(out, &(hci_html_opening){"From a log to a table", t->verdict, t->heading, t->good});
    hci_html_also(out, t->part[HCI_TUNING_CAVEATS]);
    if (t->solution) {
        hci_plot_solution_facts(t->solution, &p.facts);
        p.ripple_is_unknown = !hci_tuning_knows_ripple(t->solution);
        if (!hci_tuning_has_table(t))
            hci_html_paragraph(
                out, NULL,
                "There is no table: what follows is what the currents of the model would do in "
                "it, and says nothing of the machine.");
        show_before_and_after(&p, t->table_Nm);
        hci_page_expectation(&p);
        hci_page_tuned(&p, t);
    } else {
        hci_html_evidence(out);
        hci_page_log(out, t);
    }
    show_parts(out, t);
    hci_html_fold(out, "The commands, to do it again step by step");
    say_lines(out, t->commands);
    hci_html_fold_end(out);
    hci_html_end(out);
}
