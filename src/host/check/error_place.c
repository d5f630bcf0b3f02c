#include "host/check/error_place.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "host/base/unit_lookup.h"
#include "host/check/relations/run_zero.h"
#include "host/recording/run_columns.h"

/* Their texts are copied. */
typedef char
    same_texts[(int)CHECK_TEXT == (int)HCI_CHECK_TEXT && (int)CHECK_PATH == (int)HCI_CHECK_PATH ? 1 : -1];

#define SQRT2 1.4142135623730951

/* Phase currents and phase voltages, be it in two recordings, that do not follow the angle the same way
 * round. */
static bool are_opposed(const check_data *data)
{
    bool current[2] = {false, false}, voltage[2] = {false, false};
    for (size_t k = 0; k < data->runs; ++k) {
        const check_run *r = &data->run[k];
        if (r->has_abc && isfinite(r->current_order)) current[r->current_order < 0.0] = true;
        if (r->has_phase_voltage && isfinite(r->voltage_order)) voltage[r->voltage_order < 0.0] = true;
    }
    return (current[0] && voltage[1]) || (current[1] && voltage[0]);
}

/* The first recording with a cell of this kind. */
static const check_place *run_place(const check_data *data, int where)
{
    for (size_t k = 0; k < data->runs; ++k) {
        const check_run *r = &data->run[k];
        const check_place *place = NULL;
        if (where == CHECK_AT_THETA || where == (r->is_electrical ? CHECK_AT_THETA_E : CHECK_AT_THETA_M))
            place = &r->theta_cell;
        if (where == CHECK_AT_CURRENT || (where == CHECK_AT_ABC && r->has_abc) ||
            (where == CHECK_AT_DQ && r->has_dq))
            place = &r->current_cell;
        if (where == CHECK_AT_DRIVE && r->has_dq && r->has_dq_voltage) place = &r->current_cell;
        if (where == CHECK_AT_PHASES && r->theta_cell.path)
            place = r->has_abc ? &r->current_cell : r->has_phase_voltage ? &r->voltage_cell : NULL;
        if (where == CHECK_AT_CLAMPS && r->has_abc && are_opposed(data)) place = &r->current_cell;
        if (where == CHECK_AT_PROBES && r->has_phase_voltage && are_opposed(data)) place = &r->voltage_cell;
        if (where == CHECK_AT_VOLTAGE || (where == CHECK_AT_PHASE_VOLTAGE && r->has_phase_voltage))
            place = &r->voltage_cell;
        if (where == CHECK_AT_TORQUE && r->has_torque) place = &r->torque_cell;
        if (where == CHECK_AT_SPEED || where == CHECK_AT_SPEED_SIGN ||
            where == (r->speed_is_electrical ? CHECK_AT_SPEED_E : CHECK_AT_SPEED_M))
            place = &r->speed_cell;
        if (where == CHECK_AT_TIME) place = &r->time_cell;
        if (place && place->path) return place;
    }
    return NULL;
}

static const check_place *place_of(const check_data *data, int where)
{
    switch (where) {
    case CHECK_AT_POLES:
        return &data->cell[CHECK_pole_pairs];
    case CHECK_AT_EMF:
    case CHECK_AT_EMF_SIGN:
        return &data->emf.amplitude_cell;
    case CHECK_AT_EMF_ORDER:
        return &data->emf.order_cell;
    case CHECK_AT_COGGING_ORDER:
        return &data->cogging.order_cell;
    case CHECK_AT_PHASE:
        return data->emf.most_phase_rad >= data->cogging.most_phase_rad ? &data->emf.phase_cell
                                                                        : &data->cogging.phase_cell;
    case CHECK_AT_EMF_PHASE:
    case CHECK_AT_ZERO:
        return &data->emf.phase_cell;
    case CHECK_AT_COGGING_PHASE:
        return &data->cogging.phase_cell;
    case CHECK_AT_RATED_CURRENT:
        return &data->cell[CHECK_rated_current_A];
    case CHECK_AT_RESISTANCE:
        return &data->cell[CHECK_resistance_ohm];
    case CHECK_AT_SLOPE:
        return &data->inductance.cell;
    default:
        return run_place(data, where);
    }
}

static bool is_beyond(const check_table *t)
{
    return t->most_phase_rad > 2.0 * HCI_PI;
}

/* Half of them would be another error. */
static bool is_counted_otherwise(const check_data *data)
{
    const double p = data->value[CHECK_pole_pairs], counted = data->counted_pole_pairs;
    return counted > 0.0 && fabs(counted - p) > 0.5 && fabs(counted - 0.5 * p) > 0.5;
}

/* The angle goes backward in some recording, and the speed nowhere. */
static bool may_be_unsigned(const check_data *data)
{
    bool goes_back = false;
    for (size_t k = 0; k < data->runs; ++k) {
        const check_run *r = &data->run[k];
        if (r->has_speed && r->speed < 0.0) return false;
        goes_back = goes_back || (r->has_speed && r->angle_rate < 0.0);
    }
    return goes_back;
}

/* Turns of the rotor for one of the angle, of the first recording behind a gear; 0: none. */
static double gear_of(const check_data *data)
{
    for (size_t k = 0; k < data->runs; ++k)
        if (data->run[k].gear > 0.0) return data->run[k].gear;
    return 0.0;
}

static bool is_geared(const check_error *error)
{
    return error->field == offsetof(check_interpretation, theta_geared);
}

/* Where the recordings tell the zero themselves, that is the finding, and says what a third of a turn may be.
 */
static bool is_rotated(const check_error *error)
{
    return error->where == CHECK_AT_PHASES && error->aspect == CHECK_OF_RUN_ZERO;
}

static bool is_offset(const check_error *error)
{
    return error->field == offsetof(check_interpretation, run_zero_free);
}

/* Not only by what a drive wants. */
static bool is_measured(check_run_zero zero)
{
    return zero.is_known && !zero.is_of_drive;
}

/* Not one that a saliency explains as well; one that follows the currents fits no torques. */
static bool is_told(const check_data *data, const check_interpretation *as)
{
    const check_run_zero zero = hci_check_run_zero(data, as);
    return zero.is_known && (zero.is_of_drive || hci_check_zero_is_told(data, as, zero.zero_rad));
}

/* Radians were read as degrees only where the column says degrees, and others where it says radians. */
static bool is_of_unit(const check_error *error, const check_place *place)
{
    return (error->times > 10.0) == (fabs(place->factor * 180.0 / HCI_PI - 1.0) < 1e-6);
}

/* Poles are an even number; a motor with one pole pair has no electrical radians of its own; degrees show by
 * phases above 2π, and read as degrees all others would be near 0. */
bool hci_check_error_applies(const check_error *error, const check_data *data)
{
    const check_interpretation declared = hci_check_as_declared();
    const double p = data->value[CHECK_pole_pairs];
    const check_place *place = place_of(data, error->where);
    if (!place || !place->path) return false;
    if (error->where == CHECK_AT_POLES)
        return error->plus > 0.0 ? is_counted_otherwise(data) : fmod(p, 2.0) == 0.0;
    if (error->where == CHECK_AT_SPEED_SIGN) return may_be_unsigned(data);
    if (is_offset(error)) return is_told(data, &declared);
    if (is_geared(error)) return gear_of(data) > 0.0;
    if (is_rotated(error)) return !is_measured(hci_check_run_zero(data, &declared));
    if (error->where == CHECK_AT_PHASE)
        return data->cogging.count > 0 && (is_beyond(&data->emf) || is_beyond(&data->cogging));
    if (error->where == CHECK_AT_EMF_PHASE) return is_beyond(&data->emf);
    if (error->where == CHECK_AT_COGGING_PHASE) return is_beyond(&data->cogging);
    if (error->aspect == CHECK_OF_THETA_UNIT) return is_of_unit(error, place);
    if (error->aspect == CHECK_OF_THETA || error->aspect == CHECK_OF_EMF_ORDER ||
        error->aspect == CHECK_OF_COGGING_ORDER || error->aspect == CHECK_OF_SLOPE)
        return p > 1.0;
    return true;
}

/* The number that should stand at the place, NAN where there is none to tell. */
static double right_number(const check_error *error, const check_data *data, const check_interpretation *as)
{
    const check_interpretation declared = hci_check_as_declared();
    const check_model as_read = hci_check_model_of(data, as), before = hci_check_model_of(data, &declared);
    const check_table *e = &data->emf, *c = &data->cogging;
    switch (error->where) {
    case CHECK_AT_POLES:
        return as_read.pole_pairs;
    case CHECK_AT_EMF: {
        check_interpretation poles = declared;
        poles.pole_pairs = as->pole_pairs;
        poles.pole_pairs_counted = as->pole_pairs_counted;
        return e->amplitude[e->largest] * as_read.emf_Nm_per_A /
               hci_check_model_of(data, &poles).emf_Nm_per_A;
    }
    case CHECK_AT_EMF_SIGN:
        return -e->amplitude[e->largest];
    case CHECK_AT_EMF_ORDER:
        return e->order[e->largest] / as_read.pole_pairs;
    case CHECK_AT_COGGING_ORDER:
        return c->order[c->largest] / as_read.pole_pairs;
    case CHECK_AT_ZERO:
        return as_read.emf_phase_rad;
    case CHECK_AT_RATED_CURRENT:
        return data->value[CHECK_rated_current_A] * SQRT2;
    case CHECK_AT_RESISTANCE:
        return 0.5 * before.resistance_ohm;
    default:
        return NAN;
    }
}

/* Words around a number: "%s: every order divided by pole_pairs". */
static void fill(char out[HCI_CHECK_TEXT], const char *words, double number)
{
    const char *at = strstr(words, "%s");
    char text[32] = "";
    if (isfinite(number)) snprintf(text, sizeof text, "%.6g", number);
    if (!at)
        snprintf(out, HCI_CHECK_TEXT, "%s", words);
    else if (text[0] == '\0')
        snprintf(out, HCI_CHECK_TEXT, "%s", at[2] == ':' ? at + 4 : at + 2);
    else
        snprintf(out, HCI_CHECK_TEXT, "%.*s%s%s", (int)(at - words), words, text, at + 2);
}

static bool has_unit(const char *name)
{
    size_t base;
    hci_unit_of_name(name, &base);
    return name[base] != '\0';
}

/* Of an angle that was read in another: how it is said, and what the name of a column then ends with. */
typedef struct {
    const char *words, *ending;
} angle_unit;

static angle_unit unit_of_angle(const check_error *error)
{
    if (error->times < 1.0) return (angle_unit){"degrees", "deg"};
    return error->times > 10.0 ? (angle_unit){"radians", "rad"} : (angle_unit){"turns", "turn"};
}

/* Where a row of units says the unit, that is to be changed: "mNm in line 2, the row of units". */
static void move_unit(const check_error *error, const check_place *place, char should_be[HCI_CHECK_TEXT])
{
    size_t base;
    char name[HCI_CHECK_TEXT];
    if (error->aspect == CHECK_OF_THETA_UNIT)
        snprintf(should_be, HCI_CHECK_TEXT, "theta_%s", unit_of_angle(error).ending);
    if (strchr(should_be, ' ') || !has_unit(should_be)) return;
    snprintf(name, sizeof name, "%s", should_be);
    hci_unit_of_name(name, &base);
    if (error->aspect == CHECK_OF_THETA) { /* another name, in the unit that there is */
        should_be[base] = '\0';
        return;
    }
    const bool in_both = has_unit(place->column);
    snprintf(should_be, HCI_CHECK_TEXT, "%.40s%s%.40s in line %zu, the row of units", in_both ? name : "",
             in_both ? ", and " : "", name + base + 1, place->unit_line);
}

#define THIRD_OF_TURN 120.0 /* degrees */
#define NEAR_THIRD    2.0   /* degrees, and three times the error */

/* A third of a turn is also what columns make that begin with another phase. */
static const char *other_phases(double degrees, double error)
{
    if (fabs(fabs(degrees) - THIRD_OF_TURN) > fmax(NEAR_THIRD, 3.0 * error)) return "";
    return degrees > 0.0 ? "; or the columns a, b, c hold the phases b, c, a"
                         : "; or the columns a, b, c hold the phases c, a, b";
}

/* " ± 0.4", or what a zero by the currents rests on. */
static void say_error(const check_data *data, const check_interpretation *as, check_run_zero zero,
                      char text[120])
{
    const double error = fmax(0.1, hci_check_zero_error(data, as, zero) * 180.0 / HCI_PI);
    snprintf(text, 120,
             zero.is_of_drive
                 ? " degrees off where the drive keeps its i_d at 0, and by the torques within %.0f"
                 : " \xC2\xB1 %.1f degrees off",
             error);
}

/* "--angle-offset -31.0", and of an offset that was given already the one that takes its place. */
static void say_remedy(const check_data *data, double degrees, char text[64])
{
    const double before = hci_check_given_zero_rad(data) * 180.0 / HCI_PI;
    snprintf(text, 64, before != 0.0 ? "--angle-offset %.1f in place of %.6g" : "--angle-offset %.1f",
             remainder(before - degrees, 360.0) + 0.0, before);
}

/* "the electrical zero of the angle in the recordings is 31.0 ± 0.4 degrees off" */
static void say_offset(const check_data *data, const check_interpretation *as, hci_check_finding *finding)
{
    const check_run_zero zero = hci_check_run_zero(data, as);
    const double degrees = -remainder(zero.zero_rad, 2.0 * HCI_PI) * 180.0 / HCI_PI;
    char error[120], remedy[64];
    say_error(data, as, zero, error);
    say_remedy(data, degrees, remedy);
    snprintf(finding->words, sizeof finding->words,
             "the electrical zero of the angle in the recordings is %.1f%s: give %s%s", degrees, error,
             remedy, other_phases(degrees, zero.std_error_rad * 180.0 / HCI_PI));
    snprintf(finding->should_be, sizeof finding->should_be, "the electrical angle %s %.1f degrees",
             degrees > 0.0 ? "-" : "+", fabs(degrees));
}

/* "… behind a gear of 5: the rotor turns 0.2 times while it turns once", and an electrical angle that is as
 * well that of a gear whose ratio is the number of pole pairs. */
static void say_gear(const check_error *error, const check_data *data, hci_check_finding *finding)
{
    const double turns = gear_of(data), p = data->value[CHECK_pole_pairs];
    const size_t used = strlen(finding->words);
    if (is_geared(error))
        snprintf(finding->words + used, sizeof finding->words - used,
                 " of %.3g: the rotor turns %.3g times while it turns once", fmax(turns, 1.0 / turns), turns);
    else
        snprintf(finding->words + used, sizeof finding->words - used,
                 ", or of a shaft that a gear turns %.4g times as fast", p);
}

/* Gears that nobody builds, and units make: the unit that the angle then has. */
static const char *unit_of_gear(double turns, const char *column)
{
    static const struct {
        double turns;
        const char *unit;
    } UNITS[] = {{360.0, "turn"}, {360.0 / 400.0, "gon"}};
    const bool is_in_degrees = strstr(column, "deg") || strstr(column, "Grad") || strstr(column, "\xC2\xB0");
    for (size_t k = 0; k < sizeof UNITS / sizeof *UNITS; ++k)
        if (fabs(turns / UNITS[k].turns - 1.0) < 0.003 && (is_in_degrees || turns > 1.0))
            return UNITS[k].unit;
    return NULL;
}

/* Counts of an encoder are known to the last digit, and what the currents tell of them nearly so. */
#define COUNTED 0.003

enum { LEAST_COUNTS = 256 };

/* Counts of a turn that the gear would be; 0: of no encoder. */
static double counts_of_gear(double turns, const check_place *place)
{
    const double found = 2.0 * HCI_PI / (place->factor * turns),
                 usual = found >= LEAST_COUNTS ? hci_usual_counts(found) : 0.0;
    return usual > 0.0 && fabs(found / usual - 1.0) < COUNTED ? usual : 0.0;
}

/* "… is in counts of an encoder, 4096 in a turn, …, or of a shaft behind a gear of 11.4" */
static void say_counts_of_gear(double counts, double turns, const check_place *place,
                               hci_check_finding *finding)
{
    snprintf(
        finding->words, sizeof finding->words,
        "the angle of the recordings is in counts of an encoder, %.0f in a turn, whatever the name of its "
        "column says, or of a shaft behind a gear of %.3g",
        counts, 1.0 / turns);
    snprintf(finding->should_be, sizeof finding->should_be, "in counts: --column 'theta_m=%.60s/%.0f'",
             place->column, counts);
}

/* An angle in gon under a name of degrees: "… is in gon, or of a shaft behind a gear of 0.9". */
static void say_unit_of_gear(const check_data *data, const check_place *place, hci_check_finding *finding)
{
    const double turns = gear_of(data), counts = counts_of_gear(turns, place);
    const char *unit = unit_of_gear(turns, place->column);
    if (!unit && counts > 0.0) say_counts_of_gear(counts, turns, place, finding);
    if (!unit) return;
    snprintf(
        finding->words, sizeof finding->words,
        "the angle of the recordings is in %s, whatever the name of its column says, or of a shaft behind a "
        "gear of %.3g",
        unit, turns);
    snprintf(finding->should_be, sizeof finding->should_be, "in %s: --column 'theta_m_%s=%.60s'", unit, unit,
             place->column);
}

/* Which of three phases each column is to be read as, of swapped or rotated ones: "bca" is ia=ib, ib=ic, ia.
 * NULL: another error. */
static const char *order_of_phases(const check_error *error)
{
    if (error->aspect == CHECK_OF_PHASES && error->where != CHECK_AT_PROBES)
        return error->plus > CHECK_SWAPPED_AB ? "cba" : error->plus > CHECK_SWAPPED_BC ? "bac" : "acb";
    if (is_rotated(error)) return error->plus > 0.0 ? "bca" : "cab";
    return NULL;
}

/* The phase currents of the first recording that has three columns; NULL: none. */
static const check_place *phases_of(const check_data *data)
{
    for (size_t k = 0; k < data->runs; ++k)
        if (data->run[k].phase_cell[0].path && data->run[k].phase_cell[1].path &&
            data->run[k].phase_cell[2].path)
            return data->run[k].phase_cell;
    return NULL;
}

/* Behind the words: "--column 'ib=ic_A' --column 'ic=ib_A'". */
static void say_phases(const check_error *error, const check_data *data, hci_check_finding *finding)
{
    const char *order = order_of_phases(error);
    const check_place *phase = phases_of(data);
    char *text = finding->should_be;
    const size_t size = sizeof finding->should_be;
    size_t used = strlen(text);
    if (!order || !phase) return;
    for (int k = 0; k < 3; ++k) {
        const int from = order[k] - 'a';
        if (from == k || used >= size) continue;
        used += (size_t)snprintf(text + used, size - used, "%s --column 'i%c=%.16s'",
                                 used == strlen(finding->should_be) && !strstr(text, "--") ? ":" : "",
                                 "abc"[k], phase[from].column);
    }
}

/* What a current is called that a recording has: i_q or of phase a. */
static const char *current_of(const check_data *data, const check_place *place)
{
    bool is_dq = true;
    for (size_t k = 0; k < data->runs; ++k)
        if (data->run[k].current_cell.path == place->path) is_dq = data->run[k].has_dq;
    return is_dq ? "iq" : "ia";
}

/* Without torque and voltages a current that works against the motion is as well one of a shaft whose angle
 * and speed are both counted backward. */
static void say_other_motion(const check_data *data, hci_check_finding *finding)
{
    const size_t used = strlen(finding->words);
    for (size_t k = 0; k < data->runs; ++k)
        if (data->run[k].has_torque || data->run[k].has_voltage) return;
    snprintf(finding->words + used, sizeof finding->words - used, ", or angle and speed are both backward");
}

/* What was said of a column when it was read; NULL: nothing. */
static const hci_column_name *given_of(const check_data *data, const check_place *place)
{
    const size_t length = strlen(place->column);
    for (size_t k = 0; data->columns && k < data->columns->count; ++k) {
        const hci_column_name *x = &data->columns->item[k];
        const char *name = x->column + (*x->column == '-');
        if (strncmp(name, place->column, length) == 0 && (name[length] == '\0' || name[length] == '/'))
            return x;
    }
    return NULL;
}

/* The column with the sign and the divisor that were given. */
static const char *given_as(const check_data *data, const check_place *place)
{
    const hci_column_name *given = given_of(data, place);
    return given ? given->column : place->column;
}

static const char *given_name(const check_data *data, const check_place *place, const char *usual)
{
    const hci_column_name *given = given_of(data, place);
    return given ? given->name : usual;
}

/* Of the opposite: what stands before the column, and the column without it. */
static const char *minus(const check_data *data, const check_place *place)
{
    return *given_as(data, place) == '-' ? "" : "-";
}

static const char *unsigned_of(const check_data *data, const check_place *place)
{
    const char *text = given_as(data, place);
    return text + (*text == '-');
}

/* "… --column 'iq=-COLUMN'", or without the sign that was given. */
static void say_sign(const check_error *error, const check_data *data, const check_place *place,
                     hci_check_finding *finding)
{
    const bool is_current = error->aspect == CHECK_OF_CURRENT_SIGN;
    if (!is_current && !(error->where == CHECK_AT_TORQUE && error->times < 0.0)) return;
    snprintf(finding->should_be, sizeof finding->should_be, "with the opposite sign: --column '%s=%s%.60s'%s",
             given_name(data, place, is_current ? current_of(data, place) : "torque"), minus(data, place),
             unsigned_of(data, place), is_current ? ", and so of each current" : "");
}

/* How to say it of a column whose name says nothing or something else. */
static void say_column(const check_error *error, const check_data *data, const check_place *place,
                       hci_check_finding *finding)
{
    char *text = finding->should_be;
    const size_t size = sizeof finding->should_be;
    const check_place *of_rotor = place_of(data, CHECK_AT_THETA_M);
    if (error->aspect == CHECK_OF_CURRENT_UNIT)
        snprintf(text, size, "in mA: --column '%s_mA=%.60s', and so of each current", current_of(data, place),
                 given_as(data, place));
    if (error->aspect == CHECK_OF_THETA_UNIT)
        snprintf(text, size, "in %s: --column '%s_%s=%.60s'", unit_of_angle(error).words,
                 of_rotor && strcmp(place->column, of_rotor->column) == 0 ? "theta_m" : "theta_e",
                 unit_of_angle(error).ending, given_as(data, place));
    if (error->aspect == CHECK_OF_THETA && !is_geared(error)) /* in the unit of its header */
        snprintf(text, size, "%.7s: --column '%.7s=%.60s'", error->should_be, error->should_be,
                 given_as(data, place));
    if (error->aspect == CHECK_OF_TORQUE_UNIT || error->aspect == CHECK_OF_TIME ||
        (error->aspect == CHECK_OF_SPEED && error->where == CHECK_AT_SPEED))
        snprintf(text, size, "%s: --column '%s=%.60s'", error->should_be, error->should_be,
                 given_as(data, place));
    if (error->where == CHECK_AT_SPEED_M)
        snprintf(text, size, "%s: --column 'speed_e=%.60s'", error->should_be, given_as(data, place));
    if (error->where == CHECK_AT_SPEED_E)
        snprintf(text, size, "%s: --column 'speed=%.60s'", error->should_be, given_as(data, place));
    if (strcmp(error->name, "current_rms") == 0 || strcmp(error->name, "current_dq_rms") == 0)
        snprintf(text, size, "%.40s: --column '%s_Arms=%.40s', and so of each", error->should_be,
                 current_of(data, place), given_as(data, place));
}

void hci_check_error_locate(const check_error *error, const check_data *data, const check_interpretation *as,
                            hci_check_finding *finding)
{
    const check_place *place = place_of(data, error->where);
    finding->slip = error->name;
    snprintf(finding->words, sizeof finding->words, "%s", error->words);
    finding->told_by = error->told_by;
    snprintf(finding->file, sizeof finding->file, "%s", place->path);
    finding->line = place->line;
    finding->names_unit = place->names_unit;
    memcpy(finding->column, place->column, sizeof finding->column);
    memcpy(finding->found, place->text, sizeof finding->found);
    fill(finding->should_be, error->should_be, right_number(error, data, as));
    if (error->aspect == CHECK_OF_CURRENT_SIGN) say_other_motion(data, finding);
    if (error->where == CHECK_AT_THETA_M) say_gear(error, data, finding);
    if (is_offset(error))
        say_offset(data, as, finding);
    else if (place->unit_line > 0)
        move_unit(error, place, finding->should_be);
    else
        say_column(error, data, place, finding);
    if (place->unit_line == 0) say_sign(error, data, place, finding);
    say_phases(error, data, finding);
    if (is_geared(error)) say_unit_of_gear(data, place, finding);
}
