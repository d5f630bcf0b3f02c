#include "host/machine/machine_values.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "hci/host/base/text.h"
#include "host/csv/name_values.h"

/* Which of the list are the pole pairs, by their place in it. */
enum {
#define PLACE_OF(field, name, unit) PLACE_OF_##field,
    HCI_MACHINE_VALUES(PLACE_OF)
#undef PLACE_OF
};

static void list_values(hci_machine_values *v, hci_named_value list[HCI_MACHINE_VALUE_COUNT])
{
    size_t k = 0;
#define LIST_ONE(field, text, unit_text) list[k] = (hci_named_value){text, unit_text, &v->value[k]}, ++k;
    HCI_MACHINE_VALUES(LIST_ONE)
#undef LIST_ONE
}

static hci_status read_connection(const hci_csv *csv, size_t row, bool *has_neutral, hci_note *note)
{
    const char *text;
    const hci_status status = hci_csv_text(csv, "value", row, &text, note);
    if (status) return status;
    *has_neutral = hci_text_is(text, "star-neutral");
    if (*has_neutral || hci_text_is(text, "star")) return HCI_OK;
    return hci_csv_error(csv, "value", row, note, "`star` or `star-neutral`",
                         "for a delta winding give the equivalent star's values");
}

static void remark_unknown(hci_note *remark, const char *path, const char *name)
{
    const size_t used = strlen(remark->text);
    char *end = remark->text + used;
    const size_t left = sizeof remark->text - used;
    if (used == 0)
        snprintf(end, left, "%.300s: not used: %.60s", path, name);
    else
        snprintf(end, left, ", %.60s", name);
}

static hci_status read_row(hci_machine_values *v, size_t row, hci_note *note)
{
    hci_named_value list[HCI_MACHINE_VALUE_COUNT];
    const char *name;
    size_t k;
    hci_status status = hci_csv_text(v->csv, "name", row, &name, note);
    if (status) return status;
    if (strcmp(name, "connection") == 0) return read_connection(v->csv, row, &v->has_neutral, note);
    list_values(v, list);
    status = hci_named_value_find(v->csv, row, list, HCI_MACHINE_VALUE_COUNT, &k, note);
    if (status) return status;
    if (k == HCI_MACHINE_VALUE_COUNT) {
        remark_unknown(&v->remark, hci_csv_path(v->csv), name);
        return HCI_OK;
    }
    v->row[k] = row;
    return hci_value_read(v->csv, row, list[k].unit, list[k].value, note);
}

static hci_status check_pole_pairs(const hci_machine_values *v, hci_note *note)
{
    const double p = v->value[PLACE_OF_pole_pairs];
    if (p >= 1.0 && p <= 1000.0 && p == floor(p)) return HCI_OK;
    if (isnan(p))
        return hci_note_set(note, HCI_ERROR_INPUT, "%s: no `pole_pairs`; add a row `pole_pairs,N,1,source`",
                            hci_csv_path(v->csv));
    return hci_note_set(note, HCI_ERROR_INPUT,
                        "%s:%zu: `pole_pairs`: found %g, expected a whole number from 1 to 1000; a machine "
                        "with N poles has N/2 pole pairs",
                        hci_csv_path(v->csv), hci_csv_line(v->csv, v->row[PLACE_OF_pole_pairs]), p);
}

hci_status hci_machine_values_read(const char *path, hci_machine_values *values, hci_note *note)
{
    memset(values, 0, sizeof *values);
    for (size_t k = 0; k < HCI_MACHINE_VALUE_COUNT; ++k)
        values->value[k] = NAN;
    hci_status status = hci_csv_read(path, &values->csv, note);
    for (size_t row = 0; !status && row < hci_csv_rows(values->csv); ++row)
        status = read_row(values, row, note);
    return status ? status : check_pole_pairs(values, note);
}

void hci_machine_values_release(hci_machine_values *values)
{
    hci_csv_free(values->csv);
    values->csv = NULL;
}
