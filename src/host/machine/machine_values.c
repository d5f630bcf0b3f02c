#include "host/machine/machine_values.h"

#include <math.h>
#include <string.h>

#include "hci/host/base/spelling.h"
#include "hci/host/base/text.h"
#include "host/base/quote.h"
#include "host/base/words.h"
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

/* Least and most, both allowed, as machines have them with room to spare: what a wrong sign, a wrong unit or
 * a 0 in place of nothing makes of a value is outside. */
#define OF_UNIT(unit)                                                                                        \
    "check its sign, and that the column `unit` says the unit that the value is in (empty: " unit            \
    "), or delete the row where it is not known"

static const hci_value_range RANGES[HCI_MACHINE_VALUE_COUNT] = {
    [PLACE_OF_resistance_ohm] = {0.0, 1e6, OF_UNIT("ohm")},
    [PLACE_OF_inductance_d_H] = {1e-12, 10.0, OF_UNIT("H")},
    [PLACE_OF_inductance_q_H] = {1e-12, 10.0, OF_UNIT("H")},
    [PLACE_OF_inertia_kgm2] = {0.0, 1e6, OF_UNIT("kgm2")},
    [PLACE_OF_viscous_friction_Nms_per_rad] = {0.0, 1e6, OF_UNIT("Nms_per_rad")},
    [PLACE_OF_coulomb_friction_Nm] = {0.0, 1e9, OF_UNIT("Nm")},
    [PLACE_OF_dc_link_voltage_V] = {1e-3, 1e6, OF_UNIT("V")},
    [PLACE_OF_max_current_A] = {1e-6, 1e6, OF_UNIT("A")},
    [PLACE_OF_rated_current_A] = {1e-9, 1e6, OF_UNIT("A")},
    [PLACE_OF_rated_torque_Nm] = {1e-9, 1e9, OF_UNIT("Nm")},
    [PLACE_OF_rated_speed_rad_per_s] = {1e-6, 1e6, OF_UNIT("rad_per_s")},
};

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

/* ---- machines that are none of this program's ---- */

/* "phases,6" and "type,induction": not a value to pass over. */
static hci_status check_kind(const hci_csv *csv, size_t row, const char *name, bool *known, hci_note *note)
{
    static const char *const KINDS[] = {"pmsm", "ipmsm", "spmsm", "ipm", "spm",
                                        "bldc", "pm",    "pmac",  "bpm", "three-phase pmsm"};
    const bool phases = hci_text_is(name, "phases") || hci_text_is(name, "phase_count") ||
                        hci_text_is(name, "number_of_phases");
    const char *text;
    *known = phases || hci_text_is(name, "type") || hci_text_is(name, "machine_type") ||
             hci_text_is(name, "motor_type");
    hci_status status = *known ? hci_csv_text(csv, "value", row, &text, note) : HCI_OK;
    if (status || !*known || (phases && strcmp(text, "3") == 0)) return status;
    for (size_t k = 0; k < sizeof KINDS / sizeof *KINDS && !phases; ++k)
        if (hci_text_is(text, KINDS[k])) return HCI_OK;
    return hci_csv_error(
        csv, "value", row, note,
        phases ? "3: machines with another number of phases are not supported"
               : "a permanent-magnet synchronous machine, such as pmsm: no other is supported",
        phases ? "there is no way to describe this machine here; delete the row if it has three phases"
               : "delete the row if the machine has magnets and three phases; induction, reluctance and "
                 "wound-field machines cannot be described here");
}

/* ---- names that are not known ---- */

/* The name that was probably meant, or NULL. */
static const char *meant(const char *name)
{
#define NAME_OF(field, text, unit) text,
    static const char *const NAMES[] = {HCI_MACHINE_VALUES(NAME_OF) "connection", NULL};
#undef NAME_OF
    return hci_nearest(name, NAMES);
}

static bool is_known(const char *name)
{
    static const char *const KIND[] = {"phases", "phase_count",  "number_of_phases",
                                       "type",   "machine_type", "motor_type"};
    for (size_t k = 0; k < sizeof KIND / sizeof *KIND; ++k)
        if (hci_text_is(name, KIND[k])) return true;
    const char *nearest = meant(name);
    return nearest && strcmp(nearest, name) == 0;
}

static void remark_unknown(hci_machine_values *v, size_t row, bool is_slip, size_t *count)
{
    char quoted[HCI_QUOTE_SIZE], path[HCI_QUOTE_PATH_SIZE];
    const hci_words words = {v->remark.text, sizeof v->remark.text};
    const char *name, *nearest;
    if (hci_csv_text(v->csv, "name", row, &name, NULL) != HCI_OK || is_known(name)) return;
    nearest = meant(name);
    if ((nearest != NULL) != is_slip) return;
    if (*count == 0) hci_words_say(&words, "%s: not used:", hci_quote_path(hci_csv_path(v->csv), path));
    hci_words_say(&words, "%s %s", (*count)++ == 0 ? "" : ",", hci_quote(name, quoted));
    if (is_slip)
        hci_words_say(&words, " in line %zu (did you mean `%s`?)", hci_csv_line(v->csv, row), nearest);
}

/* Those that look like a slip of the pen come first. */
static void remark_all_unknown(hci_machine_values *v)
{
    size_t count = 0;
    for (int pass = 0; pass < 2; ++pass)
        for (size_t row = 0; row < hci_csv_rows(v->csv); ++row)
            remark_unknown(v, row, pass == 0, &count);
}

/* ---- rows ---- */

static hci_status read_row(hci_machine_values *v, size_t row, hci_note *note)
{
    hci_named_value list[HCI_MACHINE_VALUE_COUNT];
    const char *name;
    size_t k;
    hci_status status = hci_csv_text(v->csv, "name", row, &name, note);
    if (status) return status;
    bool is_kind;
    status = check_kind(v->csv, row, name, &is_kind, note);
    if (status || is_kind) return status;
    if (strcmp(name, "connection") == 0) return read_connection(v->csv, row, &v->has_neutral, note);
    list_values(v, list);
    status = hci_named_value_find(v->csv, row, list, HCI_MACHINE_VALUE_COUNT, &k, note);
    if (status) return status;
    if (k == HCI_MACHINE_VALUE_COUNT) return HCI_OK;
    v->row[k] = row;
    return RANGES[k].remedy ? hci_value_read_within(v->csv, row, &list[k], &RANGES[k], note)
                            : hci_value_read(v->csv, row, list[k].unit, list[k].value, note);
}

static bool has_poles(const hci_machine_values *v)
{
    const char *name;
    for (size_t row = 0; row < hci_csv_rows(v->csv); ++row)
        if (!hci_csv_text(v->csv, "name", row, &name, NULL) && hci_text_is(name, "poles")) return true;
    return false;
}

/* The row of a name that is likely to be a slip of `wanted`; false: there is none. */
static bool find_slip(const hci_machine_values *v, const char *wanted, size_t *at)
{
    const char *name, *nearest;
    for (*at = 0; *at < hci_csv_rows(v->csv); ++*at) {
        if (hci_csv_text(v->csv, "name", *at, &name, NULL) || is_known(name)) continue;
        nearest = meant(name);
        if (nearest != NULL && strcmp(nearest, wanted) == 0) return true;
    }
    return false;
}

static hci_status check_pole_pairs(const hci_machine_values *v, hci_note *note)
{
    const double p = v->value[PLACE_OF_pole_pairs];
    size_t slip;
    if (p >= 1.0 && p <= 1000.0 && p == floor(p)) return HCI_OK;
    if (isnan(p) && find_slip(v, "pole_pairs", &slip))
        return hci_csv_error(v->csv, "name", slip, note, "`pole_pairs`, which is missing",
                             "correct the name in this row");
    if (isnan(p))
        return hci_note_set(note, HCI_ERROR_INPUT, "%s: no `pole_pairs`; add a row `pole_pairs,N,1,source`%s",
                            hci_csv_path(v->csv), has_poles(v) ? ", with half of `poles`" : "");
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
    if (!status) remark_all_unknown(values);
    return status ? status : check_pole_pairs(values, note);
}

void hci_machine_values_release(hci_machine_values *values)
{
    hci_csv_free(values->csv);
    values->csv = NULL;
}
