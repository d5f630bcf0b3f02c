/* The page of `tune`: verdict, before and after, the torque over the angle, and what was read, found and left
 * open. */
#include "host/report/tune/page_tuning.h"

#include <stdarg.h>
#include <string.h>

#include "host/base/words.h"
#include "host/draw/html.h"
#include "host/report/page/solution_sections.h"

const char *hci_tuning_part_name(hci_tuning_part part)
{
    static const char *const NAMES[] = {"What was read",     "What was found",      "What was solved for",
                                        "What is not known", "What to record next", "Into the drive"};
    return NAMES[part];
}

void hci_tuning_say(hci_tuning *t, hci_tuning_part part, const char *format, ...)
{
    const hci_words words = {t->part[part], sizeof t->part[part]};
    va_list arguments;
    va_start(arguments, format);
    hci_words_say_list(&words, format, arguments);
    va_end(arguments);
    hci_words_say(&words, "\n");
}

void hci_tuning_swing(const hci_solution *s, double *before_Nm, double *after_Nm)
{
    hci_plot_facts facts;
    hci_plot_solution_facts(s, &facts);
    *before_Nm = facts.before_Nm.high - facts.before_Nm.low;
    *after_Nm = facts.after_Nm.high - facts.after_Nm.low;
}

static void say_lines(hci_output *out, const char *text)
{
    while (*text) {
        const size_t length = strcspn(text, "\n");
        hci_html_say(out, "", "%.*s", (int)length, text);
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

void hci_page_tuning(hci_output *out, const hci_tuning *t)
{
    hci_solution_page p = {.out = out, .solution = t->solution, .origin = "currents"};
    hci_html_begin(out, &(hci_html_opening){"From a log to a table", t->verdict, t->heading, t->good});
    if (t->solution) {
        hci_plot_solution_facts(t->solution, &p.facts);
        hci_page_before_and_after(&p);
        hci_page_torque(&p);
        hci_page_currents(&p);
    }
    for (int k = 0; k < HCI_TUNING_PARTS; ++k)
        show_part(out, t, (hci_tuning_part)k);
    hci_html_fold(out, "The commands, to do it again step by step");
    say_lines(out, t->commands);
    hci_html_fold_end(out);
    hci_html_end(out);
}
