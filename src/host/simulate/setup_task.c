/* What the parts of a set-up share: values with their defaults, and what is said of those that are wrong. */
#include <math.h>
#include <stdarg.h>
#include <stdio.h>

#include "host/base/quote.h"
#include "host/simulate/setup_task.h"

double hci_value_or(double value, double fallback)
{
    return isnan(value) ? fallback : value;
}

hci_status hci_setup_wrong(const hci_setup_task *b, const char *format, ...)
{
    char text[HCI_NOTE_SIZE / 2], path[HCI_QUOTE_PATH_SIZE];
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(text, sizeof text, format, arguments);
    va_end(arguments);
    if (b->scenario->path[0] == '\0') return hci_note_set(b->note, HCI_ERROR_INPUT, "%s", text);
    return hci_note_set(b->note, HCI_ERROR_INPUT, "%s: %s", hci_quote_path(b->scenario->path, path), text);
}

hci_status hci_setup_need(const hci_setup_task *b, double value, const char *name, const char *unit,
                          const char *why)
{
    if (!isnan(value)) return HCI_OK;
    return hci_note_set(b->note, HCI_ERROR_INPUT,
                        "machine.csv: no `%s`, which %s; add a row `%s,VALUE,%s,SOURCE`", name, why, name,
                        unit);
}

hci_status hci_setup_count_steps(const hci_setup_task *b, const char *name, double value_s, unsigned least,
                                 unsigned *steps)
{
    const double count = value_s / b->setup->drive.control.step_s, whole = floor(count + 0.5);
    *steps = (unsigned)fmax(whole, least);
    if (fabs(count - whole) <= 1e-6 * fmax(count, 1.0) && whole >= least && whole < 1e9) return HCI_OK;
    return hci_setup_wrong(b,
                           "`%s`: found %g s, expected a whole number of steps of %g s; change it or `step`",
                           name, value_s, b->setup->drive.control.step_s);
}
