#include "host/recording/bare_angle.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "hci/math/harmonic.h"
#include "host/base/memory.h"
#include "host/base/quote.h"
#include "host/csv/column.h"
#include "host/csv/table.h"
#include "host/recording/run_columns.h"

#define NEAR 0.1 /* of a ratio of speeds */

static const char *name(hci_run_column which)
{
    return hci_run_column_name(which);
}

/* The columns that tell, one after the other. */
enum { TIME, SPEED, ANGLE, COLUMNS };

/* Numbers of a column; holes are NAN. */
static bool read(const hci_csv *csv, const char *column, double *values)
{
    hci_csv_hole hole = {0};
    hci_note unused = {{0}};
    return hci_csv_numbers_or_nan(csv, column, values, &hole, &unused) == HCI_OK;
}

/* How often the angle turns while the shaft turns once: of steps of less than a quarter of a turn, 0 where
 * there are none. full: a turn in the numbers of the angle. */
static double ratio_of(const double *x, size_t n, double full)
{
    double turned = 0.0, driven = 0.0;
    for (size_t k = 1; k < n; ++k) {
        const double step_s = x[TIME * n + k] - x[TIME * n + k - 1];
        const double speed = 0.5 * fabs(x[SPEED * n + k] + x[SPEED * n + k - 1]);
        const double step = remainder(x[ANGLE * n + k] - x[ANGLE * n + k - 1], full) / full;
        if (!isfinite(step) || !isfinite(speed) || !isfinite(step_s) || step_s < 0.0) continue;
        turned += 2.0 * HCI_PI * step * ((x[SPEED * n + k] > 0.0) - (x[SPEED * n + k] < 0.0));
        driven += speed * step_s;
    }
    return driven > 0.0 ? fabs(turned) / driven : 0.0;
}

static bool is_near(double ratio, double wanted)
{
    return fabs(ratio - wanted) < NEAR * wanted;
}

/* Of an angle in turns of `full`. */
static bool decide(double ratio, int pole_pairs, hci_run_column *which)
{
    const double whole = pole_pairs > 0 ? pole_pairs : fmax(2.0, round(ratio));
    const bool is_mechanical = is_near(ratio, 1.0), is_electrical = is_near(ratio, whole);
    *which = is_mechanical ? HCI_RUN_THETA_M : HCI_RUN_THETA_E;
    return is_mechanical || is_electrical;
}

static hci_status give(hci_csv *csv, size_t column, hci_run_column which, bool in_degrees, hci_note *note)
{
    char quoted[HCI_QUOTE_SIZE];
    const bool is_mechanical = which == HCI_RUN_THETA_M;
    hci_note_add(&csv->decided, "%s is the %s angle%s: it turns %s the speed says",
                 hci_quote(hci_csv_name(csv, column), quoted), is_mechanical ? "mechanical" : "electrical",
                 in_degrees ? ", in degrees" : "",
                 is_mechanical ? "as fast as" : "by the pole pairs faster than");
    const char *as =
        is_mechanical ? (in_degrees ? "theta_m_deg" : "theta_m") : (in_degrees ? "theta_e_deg" : "theta_e");
    return hci_csv_give(csv, as, column, note);
}

/* A speed of a slower channel holds until its next number. */
static void hold(double *x, size_t n)
{
    for (size_t k = 1; k < n; ++k)
        if (!isfinite(x[k])) x[k] = x[k - 1];
}

#define OF_A_UNIT 0.02 /* of a ratio that units make: pole pairs make others */

enum { PARTS = 16 }; /* of a recording: noise of the speed leaves their ways as they are */

/* The way of the angle over that of the speed, both in rad, part by part; 0: there is none. */
static double ratio_of_ways(const double *x, size_t n)
{
    double turned = 0.0, driven = 0.0;
    for (size_t part = 0; part < PARTS; ++part) {
        double of_angle = 0.0, of_speed = 0.0;
        for (size_t k = part * n / PARTS + 1; k < (part + 1) * n / PARTS; ++k) {
            const double step_s = x[TIME * n + k] - x[TIME * n + k - 1];
            const double speed = 0.5 * (x[SPEED * n + k] + x[SPEED * n + k - 1]);
            const double step = remainder(x[ANGLE * n + k] - x[ANGLE * n + k - 1], 2.0 * HCI_PI);
            if (!isfinite(step) || !isfinite(speed) || !(step_s >= 0.0)) continue;
            of_angle += step;
            of_speed += speed * step_s;
        }
        turned += fabs(of_angle);
        driven += fabs(of_speed);
    }
    return driven > 0.0 ? turned / driven : 0.0;
}

/* Time, speed and the angle in the unit of the file; is_read: out, whether they are numbers. */
static hci_status read_three(hci_csv *csv, size_t column, double *x, bool *is_read, hci_note *note)
{
    const size_t n = hci_csv_rows(csv);
    *is_read = read(csv, name(HCI_RUN_TIME), x + TIME * n) && read(csv, name(HCI_RUN_SPEED), x + SPEED * n);
    if (!*is_read) return HCI_OK;
    hold(x + SPEED * n, n);
    const hci_status status = hci_csv_give(csv, "theta_m", column, note);
    *is_read = !status && read(csv, name(HCI_RUN_THETA_M), x + ANGLE * n);
    if (!status) --csv->given_count;
    return status;
}

static hci_status compare(hci_csv *csv, size_t column, int pole_pairs, double *x, hci_note *note)
{
    const size_t n = hci_csv_rows(csv);
    hci_run_column which;
    bool is_read;
    const hci_status status = read_three(csv, column, x, &is_read, note);
    if (status || !is_read) return status;
    if (decide(ratio_of(x, n, 2.0 * HCI_PI), pole_pairs, &which))
        return give(csv, column, which, false, note);
    if (hci_column_unit(csv, column) == NULL && decide(ratio_of(x, n, 360.0), pole_pairs, &which))
        return give(csv, column, which, true, note);
    return HCI_OK;
}

/* ---- a speed whose unit is that of its name alone ---- */

/* In which unit a speed is that is read in rad/s too large by 1/ratio; NULL: in none. guessed: rad/s of a 1.
 */
static const char *speed_by_way(double ratio, double guessed, const char **unit)
{
    static const struct {
        const char *name, *unit;
        double rad_per_s;
    } UNITS[] = {{"speed_rad_per_s", "rad/s", 1.0},
                 {"speed_rev_per_s", "turn/s", 2.0 * HCI_PI},
                 {"speed_rpm", "rpm", HCI_PI / 30.0},
                 {"speed_deg_per_s", "degrees/s", HCI_PI / 180.0}};
    if (fabs(ratio - 1.0) < NEAR) return NULL;
    for (size_t k = 0; k < sizeof UNITS / sizeof *UNITS; ++k)
        if (fabs(ratio * guessed / UNITS[k].rad_per_s - 1.0) < OF_A_UNIT) {
            *unit = UNITS[k].unit;
            return UNITS[k].name;
        }
    return NULL;
}

/* Whether the unit of a speed is the one that tools have under its name, and no word of the file. */
static bool is_guess(const hci_csv *csv, hci_column_match *found)
{
    *found = hci_column_find(csv, name(HCI_RUN_SPEED));
    return found->kind == HCI_COLUMN_ONE && found->alias && found->alias->meaning && found->alias->unit &&
           !found->has_unit && !found->overruled_by;
}

/* Whether the angle is one that the user or the file names with its unit, or a bare one, in rad then. */
static hci_status read_way(hci_csv *csv, double *x, bool *is_read, hci_note *note)
{
    size_t column;
    hci_status status = HCI_OK;
    const bool is_bare = !hci_csv_has(csv, name(HCI_RUN_THETA_M));
    const hci_column_match angle = hci_column_find(csv, name(HCI_RUN_THETA_M));
    *is_read = false;
    if (is_bare ? !hci_csv_unclear(csv, &column) : angle.alias && !angle.has_unit) return HCI_OK;
    if (is_bare) status = hci_csv_give(csv, "theta_m", column, note);
    if (status) return status;
    *is_read = read(csv, name(HCI_RUN_THETA_M), x);
    if (is_bare) --csv->given_count;
    return HCI_OK;
}

/* Where angle and time tell that the unit is another one, it is that. */
static hci_status speed_decide(hci_csv *csv, double *x, hci_note *note)
{
    const size_t n = hci_csv_rows(csv);
    hci_column_match speed;
    char quoted[HCI_QUOTE_SIZE];
    bool is_read;
    if (hci_csv_has(csv, name(HCI_RUN_THETA_E)) || !is_guess(csv, &speed)) return HCI_OK;
    const hci_status status = read_way(csv, x + ANGLE * n, &is_read, note);
    if (status || !is_read || !read(csv, name(HCI_RUN_TIME), x + TIME * n) ||
        !read(csv, name(HCI_RUN_SPEED), x + SPEED * n))
        return status;
    hold(x + SPEED * n, n);
    const char *unit, *as = speed_by_way(ratio_of_ways(x, n), speed.factor, &unit);
    if (as == NULL) return HCI_OK;
    hci_note_add(
        &csv->decided,
        "%s is read as the mechanical speed in %s, since the angle goes as far by it, and not in %s as "
        "%s has it under that name",
        hci_quote(hci_csv_name(csv, speed.column), quoted), unit, speed.alias->unit, speed.alias->tool);
    return hci_csv_give(csv, as, speed.column, note);
}

static hci_status angle_decide(hci_csv *csv, int pole_pairs, double *x, hci_note *note)
{
    size_t column;
    if (hci_csv_has(csv, name(HCI_RUN_THETA_M)) || hci_csv_has(csv, name(HCI_RUN_THETA_E))) return HCI_OK;
    return hci_csv_unclear(csv, &column) ? compare(csv, column, pole_pairs, x, note) : HCI_OK;
}

/* ---- an angle that no unit of its own makes go where the speed leads ---- */

#define STANDS_RAD 0.006 /* a third of a degree: an encoder's count flickers */

static bool stands(const double *angle, size_t n)
{
    double least = HUGE_VAL, most = -HUGE_VAL;
    for (size_t k = 0; k < n; ++k)
        if (isfinite(angle[k])) least = fmin(least, angle[k]), most = fmax(most, angle[k]);
    return most - least < STANDS_RAD;
}

/* How far the speed leads from where the shaft was at some time, there and back. */
static double driven_rad(const double *x, size_t n)
{
    double at = 0.0, least = 0.0, most = 0.0;
    for (size_t k = 1; k < n; ++k) {
        const double way = x[SPEED * n + k] * (x[TIME * n + k] - x[TIME * n + k - 1]);
        at += isfinite(way) ? way : 0.0;
        least = fmin(least, at), most = fmax(most, at);
    }
    return most - least;
}

static hci_status stands_error(const hci_csv *csv, size_t column, bool is_driven, hci_note *note)
{
    const hci_csv_fault fault = {
        .line = hci_csv_record_line(csv, 0),
        .column = column,
        .name = hci_csv_name(csv, column),
        .found = is_driven ? "an angle that stands while the speed says that the shaft turns"
                           : "an angle that stands: the shaft does not turn in this recording",
        .expected = "one that turns",
        .remedy =
            is_driven
                ? "is the encoder connected, and is that the column of the angle? say which is: --column "
                  "theta_m_deg=COLUMN"
                : "one place tells nothing of a ripple: record again with the shaft turned, once round "
                  "or more, slowly by position control or by another machine"};
    return hci_csv_fault_note(csv, &fault, note);
}

/* The column that has another unit than it says, by the way of the angle to that of the speed. speed: what a
 * 1 of it is read as, rad/s. */
static const char *other_unit(double ratio, double speed, hci_run_column *which)
{
    static const struct {
        double ratio;
        const char *name;
    } TIMES[] = {{1e-3, "time_ms"}, {1e-6, "time_us"}, {1e3, "time_s"}, {1e6, "time_s"}};
    const char *unit;
    *which = HCI_RUN_TIME;
    for (size_t k = 0; k < sizeof TIMES / sizeof *TIMES; ++k)
        if (fabs(ratio / TIMES[k].ratio - 1.0) < OF_A_UNIT) return TIMES[k].name;
    *which = HCI_RUN_SPEED;
    return speed_by_way(ratio, speed, &unit);
}

/* Of its steps, that a time goes back where the rows are in its order. */
#define BACK 0.05

static hci_status order_error(const hci_csv *csv, const double *time_s, bool *is_known, hci_note *note)
{
    const size_t n = hci_csv_rows(csv);
    size_t back = 0;
    char found[96];
    for (size_t k = 1; k < n; ++k)
        back += time_s[k] < time_s[k - 1];
    *is_known = (double)back > BACK * (double)n;
    if (!*is_known) return HCI_OK;
    snprintf(found, sizeof found, "a time that goes back in %zu of %zu rows", back, n);
    const size_t column = hci_column_find(csv, name(HCI_RUN_TIME)).column;
    const hci_csv_fault fault = {.line = hci_csv_record_line(csv, 0),
                                 .column = column,
                                 .name = hci_csv_name(csv, column),
                                 .found = found,
                                 .expected = "rows in the order of the time",
                                 .remedy = "sort them by this column, or give the log as it was written"};
    return hci_csv_fault_note(csv, &fault, note);
}

/* x: time, speed and angle, in their canonical units as the file says them. */
static hci_status unit_error(const hci_csv *csv, size_t column, int pole_pairs, const double *x,
                             hci_note *note)
{
    const size_t n = hci_csv_rows(csv);
    char remedy[240];
    hci_run_column which = HCI_RUN_THETA_M;
    const char *as = NULL, *other = hci_csv_name(csv, column);
    if (decide(ratio_of(x, n, 360.0), pole_pairs, &which))
        as = which == HCI_RUN_THETA_M ? "theta_m_deg" : "theta_e_deg";
    else if ((as = other_unit(ratio_of_ways(x, n), hci_column_find(csv, name(HCI_RUN_SPEED)).factor,
                              &which)) != NULL)
        other = hci_csv_name(csv, hci_column_find(csv, name(which)).column);
    if (as == NULL) return HCI_OK;
    snprintf(remedy, sizeof remedy, "the three agree where `%.60s` is in another unit: --column '%s=%.60s'",
             other, as, other);
    const hci_csv_fault fault = {.line = hci_csv_record_line(csv, 0),
                                 .column = column,
                                 .name = hci_csv_name(csv, column),
                                 .found = "an angle that does not go where speed and time lead",
                                 .expected = "one that does, in the units of the columns",
                                 .remedy = remedy};
    return hci_csv_fault_note(csv, &fault, note);
}

static hci_status explain(hci_csv *csv, size_t column, int pole_pairs, double *x, hci_note *note)
{
    const size_t n = hci_csv_rows(csv);
    bool is_read;
    const hci_status status = read_three(csv, column, x, &is_read, note);
    if (status || !is_read) return status;
    bool is_disordered;
    const hci_status disordered = order_error(csv, x + TIME * n, &is_disordered, note);
    if (is_disordered) return disordered;
    return stands(x + ANGLE * n, n) ? stands_error(csv, column, driven_rad(x, n) > 1.0, note)
                                    : unit_error(csv, column, pole_pairs, x, note);
}

hci_status hci_bare_angle_decide(hci_csv *csv, int pole_pairs, hci_note *note)
{
    const size_t n = hci_csv_rows(csv);
    if (n < 2 || !hci_csv_has(csv, name(HCI_RUN_TIME)) || !hci_csv_has(csv, name(HCI_RUN_SPEED)))
        return HCI_OK;
    double *x = hci_memory_new(COLUMNS * n, sizeof *x);
    if (x == NULL) return hci_note_memory(note, hci_csv_path(csv), "its angle");
    hci_status status = angle_decide(csv, pole_pairs, x, note);
    if (!status) status = speed_decide(csv, x, note);
    if (!status) status = angle_decide(csv, pole_pairs, x, note);
    hci_memory_free(x);
    return status;
}

hci_status hci_bare_angle_explain(hci_csv *csv, int pole_pairs, hci_note *note)
{
    const size_t n = hci_csv_rows(csv);
    size_t column;
    if (n < 2 || hci_csv_has(csv, name(HCI_RUN_THETA_M)) || hci_csv_has(csv, name(HCI_RUN_THETA_E)) ||
        !hci_csv_unclear(csv, &column) || !hci_csv_has(csv, name(HCI_RUN_TIME)) ||
        !hci_csv_has(csv, name(HCI_RUN_SPEED)))
        return HCI_OK;
    double *x = hci_memory_new(COLUMNS * n, sizeof *x);
    if (x == NULL) return hci_note_memory(note, hci_csv_path(csv), "its angle");
    const hci_status status = explain(csv, column, pole_pairs, x, note);
    hci_memory_free(x);
    return status;
}
