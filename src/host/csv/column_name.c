/* Names of columns: which unit a name gives, and whether it is the canonical name of a quantity or the one of
 * another tool. */
#include "host/csv/column_name.h"

#include <string.h>

#include "hci/host/base/text.h"
#include "host/csv/table.h"

hci_wanted_column hci_wanted_column_of(const char *name)
{
    hci_wanted_column want = {.base = name};
    want.unit = hci_unit_of_name(name, &want.base_length);
    return want;
}

const hci_unit *hci_column_unit_of_tail(const char *tail)
{
    if (*tail == '_') return hci_unit_of_suffix(tail + 1);
    tail += strspn(tail, " \t");
    if (*tail == '/' || *tail == ',') return hci_csv_cell_unit(tail + 1 + strspn(tail + 1, " \t"));
    return *tail == '(' || *tail == '[' ? hci_csv_cell_unit(tail) : NULL;
}

bool hci_column_split(const char *name, const hci_wanted_column *want, const hci_unit **unit)
{
    if (!hci_text_begins(name, want->base, want->base_length)) return false;
    const char *rest = name + want->base_length;
    *unit = NULL;
    if (rest[strspn(rest, " \t")] == '\0') return true;
    *unit = hci_column_unit_of_tail(rest);
    return *unit != NULL;
}

bool hci_column_split_alias(const char *name, const hci_alias *alias, const hci_unit **unit)
{
    const size_t length = strlen(name);
    *unit = NULL;
    if (hci_alias_is_name(alias, name, length)) return true;
    for (size_t end = 1; end < length; ++end) {
        if (strchr("_([/, ", name[end]) == NULL || !hci_alias_is_name(alias, name, end)) continue;
        *unit = hci_column_unit_of_tail(name + end);
        if (*unit != NULL) return true;
    }
    return false;
}

bool hci_column_is_known(const char *name)
{
    const hci_unit *unit;
    for (size_t k = 0; k < hci_alias_count; k++) {
        if (hci_aliases[k].column == NULL) continue;
        const hci_wanted_column want = hci_wanted_column_of(hci_aliases[k].column);
        if (hci_column_split_alias(name, &hci_aliases[k], &unit) || hci_column_split(name, &want, &unit))
            return true;
    }
    return false;
}
