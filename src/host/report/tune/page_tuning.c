/* The page of `tune`: verdict, before and after, the torque over the angle, and what was read, found and left
 * open. */
#include "host/report/tune/page_tuning.h"

#include <stdarg.h>
#include <stdio.h>
#include <string.h>

#include "host/base/words.h"
#include "host/draw/html.h"
#include "host/report/page/solution_sections.h"

const char *hci_tuning_part_name(hci_tuning_part part)
{
    static const char *const NAMES[] = {"Before it is used",   "What was read",     "What was found",
                                        "What was solved for", "What is not known", "What to record next",
                                        "Into the drive"};
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

/* What the solution remarks and the heading does not say. */
static void say_remark(hci_output *out, const hci_tuning *t)
{
    const hci_solution *s = t->solution;
    if (s->remark.text[0] && !(s->corrections[0] && strstr(t->part[HCI_TUNING_CAVEATS], s->corrections)))
        hci_html_paragraph(out, "quiet", s->remark.text);
}

/* What is set in belongs to the line above it. */
static void say_lines(hci_output *out, const char *text)
{
    while (*text) {
        const size_t length = strcspn(text, "\n");
        const size_t blanks = strspn(text, " ");
        hci_html_say(out, blanks > 0 ? "of" : "", "%.*s", (int)(length - blanks), text + blanks);
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

/* ---- pictures ---- */

static void row_of_range(hci_output *out, const char *name, hci_range r)
{
    hci_html_row(out);
    hci_html_cell(out, name);
    hci_html_number(out, r.low);
    hci_html_number(out, r.high);
    hci_html_row_end(out);
}

static void show_log(hci_output *out, const hci_tuning *t)
{
    static const char *const COLUMN[] = {"<Quantity", "Least", "Most", NULL};
    const hci_html_drawing drawing = {
        .id = "log",
        .title = "The log over its time",
        .description =
            "Two lines over the time: the angle of the shaft, or its speed, and the torque, the current "
            "or a voltage. The table has the extremes.",
        .caption =
            "Each column spans the least and the most of its samples; rows that were left out are not in it.",
        .wide = 330,
        .narrow = 360,
        .legend_rows = 1,
        .draw = hci_plot_log,
        .context = t->log};
    hci_plot_log_facts facts;
    char heading[512];
    if (!t->log || !hci_plot_log_can(t->log)) return;
    hci_plot_log_ranges(t->log, &facts);
    snprintf(heading, sizeof heading, "%.300s as it was read: %s, and %s", t->log_name, facts.position,
             facts.signal);
    hci_html_section(out, heading);
    hci_html_drawing_begin(out, &drawing);
    hci_html_table(out, "Extremes over the log", COLUMN);
    row_of_range(out, facts.position, facts.of_position);
    row_of_range(out, facts.signal, facts.of_signal);
    hci_html_table_end(out);
    hci_html_drawing_end(out, "runs.csv, which names the logs", t->log_name);
    hci_html_section_end(out);
}

static hci_range range_of(const double *value, size_t count)
{
    hci_range r = HCI_RANGE_EMPTY;
    for (size_t k = 0; k < count; ++k)
        hci_range_include(&r, value[k]);
    return r;
}

/* What was found without current; below the tolerance of the solution there is nothing to show. */
static void show_open_torque(hci_output *out, const hci_tuning *t)
{
    static const char *const COLUMN[] = {"<Torque", "Least N·m", "Most N·m", NULL};
    const hci_plot_open open = {t->open_Nm, HCI_TUNING_POINTS, t->open_is_mechanical};
    const hci_html_drawing drawing = {
        .id = "open",
        .title = "Torque without current over the angle",
        .description =
            "A line in N·m over a turn: the torque that the corrected machine makes without current. The "
            "table has the extremes.",
        .caption =
            "Of the machine in diagnose/machine: its cogging torque, and what else follows the angle alone.",
        .wide = 262,
        .narrow = 260,
        .legend_rows = 1,
        .draw = hci_plot_open_torque,
        .context = &open};
    char heading[256], swing[HCI_PAGE_SWING_SIZE];
    if (!t->open_Nm || !t->solution) return;
    const hci_range r = range_of(t->open_Nm, HCI_TUNING_POINTS);
    if (!(r.high - r.low > t->solution->tolerance_Nm)) return;
    hci_page_swing(swing, r, t->solution->tolerance_Nm);
    snprintf(heading, sizeof heading,
             "Without current the torque that was found varies by %s over the %s turn", swing,
             t->open_is_mechanical ? "mechanical" : "electrical");
    hci_html_section(out, heading);
    hci_html_drawing_begin(out, &drawing);
    hci_html_table(out, "Extremes over the turn", COLUMN);
    row_of_range(out, "without current", r);
    hci_html_table_end(out);
    hci_html_drawing_end(out, "diagnose/machine", "the logs");
    hci_html_section_end(out);
}

void hci_page_tuning(hci_output *out, const hci_tuning *t)
{
    hci_solution_page p = {.out = out, .solution = t->solution, .origin = "currents"};
    hci_html_begin(out, &(hci_html_opening){"From a log to a table", t->verdict, t->heading, t->good});
    hci_html_also(out, t->part[HCI_TUNING_CAVEATS]);
    if (t->solution) {
        hci_plot_solution_facts(t->solution, &p.facts);
        p.is_cut = t->table_Nm > 0.0;
        p.ripple_is_unknown = !hci_tuning_knows_ripple(t->solution);
        show_before_and_after(&p, t->table_Nm);
        say_remark(out, t);
        show_log(out, t);
        show_open_torque(out, t);
        if (!p.ripple_is_unknown) hci_page_torque(&p);
        hci_page_currents(&p);
    } else {
        hci_html_evidence(out);
        show_log(out, t);
    }
    for (int k = HCI_TUNING_READ; k < HCI_TUNING_PARTS; ++k)
        show_part(out, t, (hci_tuning_part)k);
    hci_html_fold(out, "The commands, to do it again step by step");
    say_lines(out, t->commands);
    hci_html_fold_end(out);
    hci_html_end(out);
}
