#include "host/csv/name_values.h"

#include <math.h>
#include <stdbool.h>
#include <stdio.h>
#include <string.h>

#include "hci/host/base/spelling.h"
#include "hci/host/base/text.h"
#include "hci/host/base/unit.h"

static bool converts(const char *unit, const char *wanted, double *factor)
{
    *factor = 1.0;
    if (*unit == '\0' || strcmp(unit, "1") == 0 || strcmp(unit, "-") == 0 || strcmp(unit, wanted) == 0)
        return true;
    return hci_unit_factor(unit, wanted, factor);
}

hci_status hci_value_factor(const hci_csv *csv, size_t row, const char *wanted, double *factor,
                            hci_note *note)
{
    const char *unit = "";
    char expected[80];
    const hci_status status = hci_csv_has(csv, "unit") ? hci_csv_text(csv, "unit", row, &unit, note) : HCI_OK;
    if (status || converts(unit, wanted, factor)) return status;
    snprintf(expected, sizeof expected, "a unit that converts to %s", wanted);
    return hci_csv_error(
        csv, "unit", row, note, expected,
        strcmp(wanted, "Hz") == 0
            ? "check the unit of this value; electrical Hz are mechanical rpm / 60 x pole pairs"
            : "check the unit of this value");
}

hci_status hci_value_read(const hci_csv *csv, size_t row, const char *wanted, double *value, hci_note *note)
{
    double factor;
    hci_status status = hci_csv_number(csv, "value", row, value, note);
    if (!status) status = hci_value_factor(csv, row, wanted, &factor, note);
    if (!status) *value *= factor;
    return status;
}

hci_status hci_value_read_within(const hci_csv *csv, size_t row, const hci_named_value *wanted,
                                 const hci_value_range *range, hci_note *note)
{
    const bool whole = strcmp(wanted->unit, "count") == 0;
    const hci_status status = hci_value_read(csv, row, wanted->unit, wanted->value, note);
    const double value = *wanted->value;
    char expected[120];
    if (status) return status;
    if (value >= range->low && value <= range->high && (!whole || value == floor(value))) return HCI_OK;
    snprintf(expected, sizeof expected, "a %snumber from %g to %g%s%s", whole ? "whole " : "", range->low,
             range->high, whole ? "" : " ", whole ? "" : wanted->unit);
    return hci_csv_error(csv, "value", row, note, expected, range->remedy);
}

hci_status hci_value_read_choice(const hci_csv *csv, size_t row, const char *const *choices,
                                 const char *remedy, int *value, hci_note *note)
{
    char expected[120] = "one of:";
    const char *text;
    const hci_status status = hci_csv_text(csv, "value", row, &text, note);
    if (status) return status;
    for (*value = 0; choices[*value]; ++*value) {
        const size_t used = strlen(expected);
        if (hci_text_is(text, choices[*value])) return HCI_OK;
        snprintf(expected + used, sizeof expected - used, "%s %s", *value > 0 ? "," : "", choices[*value]);
    }
    return hci_csv_error(csv, "value", row, note, expected, remedy);
}

hci_status hci_unknown_name(const hci_csv *csv, size_t row, const char *name, const char *const *names,
                            const char *where, hci_note *note)
{
    char remedy[200];
    const char *nearest = hci_nearest(name, names);
    if (nearest != NULL)
        snprintf(remedy, sizeof remedy, "did you mean `%s`? %s lists all", nearest, where);
    else
        snprintf(remedy, sizeof remedy, "%s lists all", where);
    return hci_csv_error(csv, "name", row, note, "a name that is known here", remedy);
}

hci_status hci_named_value_find(const hci_csv *csv, size_t row, const hci_named_value *list, size_t count,
                                size_t *at, hci_note *note)
{
    const char *name;
    const hci_status status = hci_csv_text(csv, "name", row, &name, note);
    *at = count;
    for (size_t k = 0; k < count && !status; ++k)
        if (strcmp(name, list[k].name) == 0) *at = k;
    if (*at < count && !isnan(*list[*at].value))
        return hci_csv_error(csv, "name", row, note, "each name once", "delete one of the two rows");
    return status;
}
