/* What check says of the logs, and whether anything can be solved with them. */
#include <ctype.h>
#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "cli/tune/tune_commands.h"
#include "cli/tune/tune_facts.h"
#include "cli/tune/tune_known.h"
#include "cli/tune/tune_options.h"
#include "cli/tune/tune_read.h"
#include "cli/tune/tune_sheet.h"
#include "cli/tune/tune_size.h"
#include "cli/tune/tune_steps.h"
#include "cli/tune/tune_suspect.h"
#include "hci/host/base/number.h"
#include "hci/host/report/write.h"
#include "hci/math/harmonic.h"

/* ---- what is found ---- */

/* Of a ratio, which units make. */
#define OF_A_UNIT 0.05

static bool is_of_poles(const char *slip)
{
    return strncmp(slip, "pole", 4) == 0;
}

/* A number that init has made of the figure of a sheet is no figure of a sheet. */
static bool is_excluded(const cli_tuning *t, const char *slip)
{
    static const char *const OF_A_SHEET[] = {"emf_volt_per", "emf_kv", "emf_flux_linkage"};
    if (!t->is_own) return false;
    for (size_t k = 0; k < sizeof OF_A_SHEET / sizeof *OF_A_SHEET; ++k)
        if (strncmp(slip, OF_A_SHEET[k], strlen(OF_A_SHEET[k])) == 0) return true;
    return strncmp(slip, "emf_taken_per_krpm", strlen("emf_taken_per_krpm")) == 0 &&
           !t->arguments->given[TUNE_VOLT];
}

static void append(cli_tuning *t, const char *format, ...)
{
    const size_t used = strlen(t->slip);
    va_list list;
    va_start(list, format);
    vsnprintf(t->slip + used, sizeof t->slip - used, format, list);
    va_end(list);
}

static double excluded_of(const cli_tuning *t, const hci_check *c)
{
    double excluded = 0.0;
    for (size_t k = 0; k < c->findings; ++k)
        excluded += is_excluded(t, c->finding[k].slip) ? c->finding[k].probability : 0.0;
    return excluded;
}

/* The probability of a finding among those that can be here. */
static double probability_of(const cli_tuning *t, const hci_check *c, const hci_check_finding *f)
{
    return f->probability / fmax(1.0 - excluded_of(t, c), f->probability);
}

/* The torque over what the currents make; 1: not known. */
static double torque_ratio(const hci_check *c)
{
    for (size_t k = 0; k < c->evidences; ++k)
        if (strcmp(c->evidence[k].name, "torque_size") == 0)
            return fabs(c->evidence[k].declared / c->evidence[k].expected);
    return 1.0;
}

/* Sheets are off by as much: within this factor of ten a figure whose point is at another place makes it. */
#define OFF_SHEET 1.25

static bool is_ten_times(double ratio)
{
    return fabs(fabs(log(ratio)) - log(10.0)) < log(OFF_SHEET);
}

/* "; or else --kv is 10 times too large", where the unit of a torque looks the same; of the figures of a
 * sheet Kv alone is over the torque. */
static void append_point(cli_tuning *t, const hci_check *c, const hci_check_finding *f)
{
    const double ratio = torque_ratio(c);
    if (strncmp(f->slip, "torque_", 7) != 0 || strcmp(f->slip, "torque_sign") == 0 || !is_ten_times(ratio))
        return;
    const bool is_over = t->is_own && t->arguments->given[TUNE_KV];
    append(t, "; or else %s is 10 times too %s, which the torques do not tell from it: voltages would",
           cli_tune_constant_option(t), (ratio > 1.0) == is_over ? "large" : "small");
}

/* Whether a column of the recordings is in another unit, and no figure of the sheet. */
static bool is_of_unit(const char *slip)
{
    return (strncmp(slip, "torque_", 7) == 0 && strcmp(slip, "torque_sign") != 0) ||
           strcmp(slip, "current_milliampere") == 0;
}

/* Whether a slip is of a size, of the torque, the currents or the magnets, which another number of the sheet
 * would be as well. One of the angle, the phases or the poles makes another share of the torque: the sheet is
 * no part of it. */
static bool is_of_size(const char *slip)
{
    return is_of_unit(slip) || strncmp(slip, "emf_", 4) == 0 ||
           (strncmp(slip, "current_", 8) == 0 && strcmp(slip, "current_sign") != 0);
}

/* "Most likely the torque is in N·cm (98 %), or else ..., so nothing was solved" */
static void take_slip(cli_tuning *t, const hci_check *c, const hci_check_finding *f, double probability)
{
    t->has_slip = true;
    t->slip_is_of_poles = is_of_poles(f->slip);
    append(t, "Most likely %s (%s %%", f->words, HCI_PERCENT(100.0 * probability, 3));
    append_point(t, c, f);
    for (size_t k = 0; k < f->alternatives; ++k)
        if (!is_excluded(t, f->alternative[k])) append(t, "; or else %s", f->alternative_words[k]);
    append(t, "), so nothing was solved");
    t->slip_is_of_unit = is_of_unit(f->slip);
    t->slip_is_of_frame = !is_of_size(f->slip);
    const char *column = strstr(f->should_be, "--column");
    if (!t->slip_is_of_unit && column) append(t, ": %.120s", column);
    if (t->slip_is_of_unit)
        append(t, ": for %.100s, %.300s; where one log alone has it so, in the header of that", f->found,
               f->should_be);
}

/* A number of a file that this call made has digits that nobody wrote. */
static void said_number(const char *cell, char text[32])
{
    char *end;
    const double value = strtod(cell, &end);
    snprintf(text, 32, "%.31s", cell);
    if (*cell != '\0' && *end == '\0' && strlen(cell) > 8) snprintf(text, 32, "%.6g", value);
}

static void say_finding(cli_tuning *t, const hci_check *c, const hci_check_finding *f)
{
    const double probability = probability_of(t, c, f);
    const bool is_found = probability >= HCI_CHECK_FOUND && !t->slip_is_of_sheet;
    char found[32];
    said_number(f->found, found);
    hci_tuning_say(&t->tuning, is_found ? HCI_TUNING_READ : HCI_TUNING_UNKNOWN,
                   "%s: %s (%s %%); %s:%zu, %s: found %s, should be %s", is_found ? "slip" : "possible slip",
                   f->words, HCI_PERCENT(100.0 * probability, 3), f->file, f->line, f->column,
                   strlen(f->found) < sizeof found ? found : f->found, f->should_be);
    if (is_found && !t->has_slip) take_slip(t, c, f, probability);
}

/* ---- a number of the sheet, typed without its unit ---- */

/* Relations that the strength of the magnets alone puts right. */
static bool is_of_magnets(const char *relation)
{
    static const char *const NAMES[] = {"torque_size", "flux_size", "flux_per_current"};
    for (size_t k = 0; k < sizeof NAMES / sizeof *NAMES; ++k)
        if (strcmp(NAMES[k], relation) == 0) return true;
    return false;
}

/* Whether nothing but the strength of the magnets has to be another one where the columns are in the units
 * that they say. */
static bool may_be_of_sheet(const hci_check *c)
{
    bool is_torque = false;
    for (size_t k = 0; k < c->evidences; ++k) {
        const hci_check_evidence *e = &c->evidence[k];
        if (e->state == HCI_CHECK_AGREES || e->state == HCI_CHECK_UNJUDGED) continue;
        if (!is_of_magnets(e->name)) return false;
        is_torque = is_torque || strcmp(e->name, "torque_size") == 0;
    }
    for (size_t k = 0; k < c->findings; ++k)
        if (is_of_unit(c->finding[k].slip) && !c->finding[k].names_unit) return false;
    return is_torque && fabs(log(torque_ratio(c))) > log(CLI_TUNE_ANOTHER_TORQUE);
}

/* "the torque is in mN·m, whatever its column says (--column 'torque_mNm=Moment [Nm]'), or " */
static void append_units(cli_tuning *t, const hci_check *c)
{
    for (size_t k = 0; k < c->findings; ++k) {
        const hci_check_finding *f = &c->finding[k];
        const char *column = strstr(f->should_be, "--column");
        if (is_of_unit(f->slip) && f->probability + excluded_of(t, c) <= 1.0 && column)
            append(t, "%s, whatever its column says (%.200s), or ", f->words, column);
    }
}

/* Levers of test benches, m. */
#define LEAST_LEVER 0.02
#define MOST_LEVER  1.0

#define TOLD_BY                                                                                              \
    "voltages of the open machine tell the number of the sheet, a known weight on a lever the torque"

/* "the column is a force in N on a lever of 123 mm (--column 'torque_Nm=COLUMN/8.12'; …), or ", of a torque
 * that is so many times what the currents make. */
static void append_lever(cli_tuning *t, double ratio)
{
    const double lever_m = 1.0 / ratio;
    if (lever_m > LEAST_LEVER && lever_m < MOST_LEVER)
        append(
            t,
            "the column is a force in N on a lever of %.0f mm (--column 'torque_Nm=COLUMN/%.4g'; the lever "
            "is measured), or ",
            1000.0 * lever_m, ratio);
}

/* A number that was typed without a unit is more often wrong than a column that says its own. */
static void judge_number(cli_tuning *t, const hci_check *c)
{
    char number[512];
    if (!may_be_of_sheet(c)) return;
    t->torque_to_sheet = torque_ratio(c);
    if (!cli_tune_say_meant_strength(t, number, sizeof number)) {
        t->torque_to_sheet = 0.0; /* judge_sheet has the other slips before it */
        return;
    }
    t->has_slip = t->slip_is_of_sheet = true;
    append(t, "%c%s. Else ", toupper(number[0]), number + 1);
    append_units(t, c);
    append_lever(t, t->torque_to_sheet);
    append(t, "the currents are in another unit, or the torque is of the other side of a gear, or of another "
              "motor. The logs alone do not tell which: " TOLD_BY ". Nothing was solved");
}

static void say_evidence(cli_tuning *t, const hci_check_evidence *e)
{
    char unit[CLI_TUNE_COLUMN_WORDS + 120], words[CLI_TUNE_COLUMN_WORDS] = "";
    if (e->state != HCI_CHECK_UNMENDED) return;
    unit[0] = '\0';
    if (strcmp(e->name, "angle_speed") == 0) cli_tune_say_unit_of_ratio(t, e->declared, words);
    if (words[0]) snprintf(unit, sizeof unit, ": %s", words);
    hci_tuning_say(&t->tuning, HCI_TUNING_READ, "  not understood: %s is %.4g, expected %s%.4g%s", e->words,
                   e->declared, e->at_most ? "at most " : "", e->expected, unit);
}

static void say_check(cli_tuning *t, const hci_check *c)
{
    hci_tuning_say(&t->tuning, HCI_TUNING_READ, "conventions: %s (%zu relations checked)",
                   hci_check_verdict_name(c->verdict), c->evidences);
    for (size_t k = 0; k < c->evidences; ++k)
        say_evidence(t, &c->evidence[k]);
    for (size_t k = 0; k < c->findings; ++k)
        if (!is_excluded(t, c->finding[k].slip)) say_finding(t, c, &c->finding[k]);
    if (c->verdict != HCI_CHECK_SLIPS) hci_check_saliency_words(c, t->saliency, sizeof t->saliency);
}

/* What nothing can be solved with where it is not understood. */
static bool is_of_angle(const char *relation)
{
    static const char *const NAMES[] = {"emf_angle",   "current_order",   "voltage_order", "angle_ratio",
                                        "angle_speed", "frequency_speed", "cogging_share"};
    for (size_t k = 0; k < sizeof NAMES / sizeof *NAMES; ++k)
        if (strcmp(NAMES[k], relation) == 0) return true;
    return false;
}

/* Whether an electrical speed was logged beside a mechanical angle, or a mechanical one beside an electrical.
 */
static bool has_speed_to_count(const cli_tuning *t)
{
    for (size_t k = 0; k < t->runs.count; ++k) {
        const hci_run *r = &t->runs.run[k];
        if (r->speed_rad_per_s && r->speed_window == 0 && r->speed_is_electrical != r->is_electrical)
            return true;
    }
    return false;
}

/* Whether something in the files counts the pole pairs. The orders of a ripple do not: motors with other
 * slots and half or twice the poles have them too. */
static bool counts_pole_pairs(const cli_tuning *t, const hci_check *c)
{
    static const char *const NAMES[] = {"current_order", "voltage_order", "angle_ratio", "frequency_speed"};
    for (size_t k = 0; k < t->runs.count; ++k)
        if (t->runs.run[k].counts_pole_pairs) return true;
    for (size_t k = 0; k < c->evidences; ++k)
        for (size_t n = 0; n < sizeof NAMES / sizeof *NAMES; ++n)
            if (strcmp(c->evidence[k].name, NAMES[n]) == 0) return true;
    for (size_t k = 0; k < c->evidences; ++k)
        if (strcmp(c->evidence[k].name, "angle_speed") == 0) return has_speed_to_count(t);
    return false;
}

static bool has_finding(const cli_tuning *t, const hci_check *c)
{
    bool has = c->findings == 0;
    for (size_t k = 0; k < c->findings; ++k)
        has = has || !is_excluded(t, c->finding[k].slip);
    return has;
}

#define LEAST_SAID 0.01 /* a probability that is worth a word */

/* Of what would tell, the part that was not given. */
static const char *not_given(const cli_tuning *t, const char *told_by)
{
    static const char RATED[] = "rated_current in machine.csv, or ";
    const bool is_rated = told_by && strncmp(told_by, RATED, sizeof RATED - 1) == 0;
    return is_rated && t->declared.rated_current_A > 0.0 ? told_by + sizeof RATED - 1 : told_by;
}

/* Where it is certain that something is read wrongly, and not what: all that would do. */
static void judge_ambiguous(cli_tuning *t, const hci_check *c)
{
    const char *told_by = NULL;
    double others = 1.0 - c->probability_as_declared;
    if (t->has_slip || cli_tune_is_typed(t) || c->verdict != HCI_CHECK_AMBIGUOUS ||
        c->probability_as_declared > 1.0 - HCI_CHECK_FOUND)
        return;
    if (!has_finding(t, c)) return;
    t->has_slip = true;
    append(t, "Something is read wrongly (%s %%)",
           HCI_PERCENT(100.0 * (1.0 - c->probability_as_declared), 3));
    for (size_t k = 0; k < c->findings; ++k) {
        const hci_check_finding *f = &c->finding[k];
        if (is_excluded(t, f->slip)) continue;
        const char *column = strstr(f->should_be, "--column");
        append(t, "%s%s (%s %%%s%.100s)", told_by ? ", or " : ": ", f->words,
               HCI_PERCENT(100.0 * probability_of(t, c, f), 2), column ? ": " : "", column ? column : "");
        others -= probability_of(t, c, f);
        if (!told_by) told_by = not_given(t, f->told_by);
    }
    if (others > LEAST_SAID) append(t, ", or another slip (%s %%)", HCI_PERCENT(100.0 * others, 2));
    if (told_by) append(t, "; what would tell: %s", told_by);
    append(t, ", so nothing was solved");
}

/* Which unit of the constant makes such a ratio; "": none that is known. */
static const char *unit_of_torque(double ratio)
{
    if (fabs(ratio * 30.0 / HCI_PI - 1.0) < 2.0 * OF_A_UNIT)
        return " (as Kv in rad/s per V would, or a figure of the sheet whose point is at another place)";
    if (is_ten_times(ratio)) return " (as a figure of the sheet whose point is at another place would)";
    return fabs(ratio * 1000.0 - 1.0) < 2.0 * OF_A_UNIT
               ? " (as a constant in mN·m/A would, or a torque in N·m whose column says mN·m)"
               : "";
}

static void judge_torque(cli_tuning *t, const hci_check *c, const hci_check_evidence *e)
{
    if (t->has_slip || e->state == HCI_CHECK_AGREES || strcmp(e->name, "torque_size") != 0) return;
    if (fabs(log(fabs(e->declared / e->expected))) < log(CLI_TUNE_ANOTHER_TORQUE)) return;
    t->has_slip = true;
    if (cli_tune_lies_along_d(t)) {
        t->slip_is_of_frame = true;
        append(
            t,
            "The currents of the loads lie along i_d and not along i_q, where they make no torque: the two "
            "columns are exchanged, or the angle of the drive is a quarter of an electrical turn off, so "
            "nothing was solved: --column 'iq_A=COLUMN' --column 'id_A=COLUMN' say which is which");
        return;
    }
    const double ratio = e->declared / e->expected;
    append(t, "The torque is %.3g times what the currents make with the constant of the sheet%s (", ratio,
           unit_of_torque(ratio));
    append_lever(t, fabs(ratio));
    append(t,
           "it is of the other side of a gear, in another unit, or of another motor, or %s is another number "
           "or of another unit",
           cli_tune_constant_option(t));
    for (size_t k = 0; k < c->findings; ++k)
        if (!is_excluded(t, c->finding[k].slip))
            append(t, ", or %s, by %s %%", c->finding[k].words,
                   HCI_PERCENT(100.0 * probability_of(t, c, &c->finding[k]), 2));
    append(t, "; " TOLD_BY "), so nothing was solved");
}

/* Where no slip explains all the logs: one whose currents go round with another number of pole pairs is of
 * another motor; what its currents make in the frame of this one is nothing. */
static bool judge_other_motor(cli_tuning *t)
{
    for (size_t k = 0; k < t->runs.count && !t->has_slip; ++k) {
        const hci_run *r = &t->runs.run[k];
        if (r->other_pole_pairs == 0) continue;
        t->has_slip = t->slip_is_of_frame = true;
        append(t,
               "The phase currents of %.120s go round %d times in a turn of its shaft, and the motor has %d "
               "pole pairs: "
               "it is a log of another motor, or the number of pole pairs is another one, or its angle is "
               "none of the "
               "shaft; with %d pole pairs not all that the logs say agrees either, so nothing was solved",
               cli_tune_name_of(t, k), r->other_pole_pairs, r->pole_pairs, r->other_pole_pairs);
        return true;
    }
    return false;
}

/* How the sign is turned, of i_q or of phase currents. */
static void say_turned(cli_tuning *t, const hci_run *r)
{
    const bool has_phases = r->has_sum || r->computed_phase > 0;
    char *words = t->slip;
    const size_t used = strlen(words), size = sizeof t->slip - used;
    if (has_phases)
        snprintf(words + used, size, "; half a turn of the zero: --angle-offset %.6g",
                 remainder((r->zero_is_given ? r->zero_offset_rad * 180.0 / HCI_PI : 0.0) + 180.0, 360.0));
    else if (r->current_column[0])
        snprintf(words + used, size, "; the sign of i_q: --column 'iq=-%s'", r->current_column);
}

/* Of a shaft that is taken to turn by itself the current cannot work against the motion. */
static void judge_current(cli_tuning *t)
{
    for (size_t k = 0; k < t->runs.count && !t->has_slip; ++k) {
        const hci_run *r = &t->runs.run[k];
        if (r->current_way >= 0) continue;
        t->has_slip = true;
        snprintf(
            t->slip, sizeof t->slip,
            "i_q works against the motion in %.120s: %s, or angle and speed have the opposite sign, or "
            "another machine turns the shaft; a table of it could double the ripple, so nothing was solved",
            cli_tune_name_of(t, k),
            r->has_sum || r->computed_phase > 0
                ? "the zero of the angle is half an electrical turn off, or the phase currents have the "
                  "opposite sign"
                : "i_q has the opposite sign");
        say_turned(t, r);
    }
}

/* Friction brakes, so that a torque of the motor at a shaft that is driven is against the motion. In one
 * direction the zero of the sensor may be it as well. */
static void judge_torque_way(cli_tuning *t)
{
    const cli_tune_torque_way way = cli_tune_torque_way_of(t);
    t->drives_Nm = way.has_both ? 0.0 : way.drives_Nm;
    if (t->has_slip || !way.has_both || !(way.drives_Nm > 0.0)) return;
    t->has_slip = true;
    snprintf(
        t->slip, sizeof t->slip,
        "The torque in %.80s drives the shaft by %.3g N·m in both directions, where friction brakes: its "
        "sign is the other one, or that of the angle, or it is what a drive makes and not what a sensor "
        "shows; a table of it "
        "could double the ripple, so nothing was solved; --column torque=-COLUMN turns the sign of a sensor; "
        "what a drive makes is left out for its current",
        cli_tune_name_of(t, way.run), way.drives_Nm);
}

/* A zero that the torques show, and not so plainly that it is certain; diagnose may find it again. */
#define SHOWN_DEG 5.0

static void judge_zero(cli_tuning *t, const hci_check *c)
{
    const double zero_deg = c->zero_rad * 180.0 / HCI_PI, error_deg = c->zero_reach_rad * 180.0 / HCI_PI;
    t->zero_deg = zero_deg;
    t->zero_error_deg = error_deg;
    t->zero_is_told = c->zero_is_told;
    t->drive_zero_deg =
        fabs(c->drive_zero_rad) * 180.0 / HCI_PI > SHOWN_DEG ? c->drive_zero_rad * 180.0 / HCI_PI : 0.0;
    t->drive_zero_reach_deg = c->drive_zero_reach_rad * 180.0 / HCI_PI;
    if (!(c->zero_is_told && fabs(zero_deg) > SHOWN_DEG && fabs(zero_deg) > error_deg)) return;
    t->turned_deg = zero_deg;
    t->turned_error_deg = error_deg;
}

/* What does not agree as it is declared; beside a slip that a number of the sheet would be as well, and else
 * where nothing mends it. */
static void judge_sheet(cli_tuning *t, const hci_check *c)
{
    for (size_t k = 0; k < c->evidences && !t->slip_is_of_frame; ++k) {
        const hci_check_evidence *e = &c->evidence[k];
        if (strcmp(e->name, "torque_size") != 0) continue;
        if (e->state == HCI_CHECK_UNMENDED || (t->has_slip && e->state != HCI_CHECK_AGREES))
            t->torque_to_sheet = torque_ratio(c);
    }
}

static void judge_check(cli_tuning *t, const hci_check *c)
{
    judge_zero(t, c);
    if (cli_tune_say_mixed_torque(t, t->slip, sizeof t->slip)) t->has_slip = true;
    t->counts_pole_pairs = counts_pole_pairs(t, c);
    const bool is_of_two = c->verdict == HCI_CHECK_NOT_UNDERSTOOD && judge_other_motor(t);
    for (size_t k = 0; k < c->evidences && c->verdict != HCI_CHECK_CONSISTENT; ++k)
        judge_torque(t, c, &c->evidence[k]);
    judge_torque_way(t);
    judge_ambiguous(t, c);
    judge_current(t);
    judge_sheet(t, c);
    for (size_t k = 0; k < c->evidences && c->verdict == HCI_CHECK_NOT_UNDERSTOOD && !is_of_two; ++k)
        if (c->evidence[k].state == HCI_CHECK_UNMENDED)
            *(is_of_angle(c->evidence[k].name) ? &t->has_misfit : &t->has_doubt) = true;
}

/* check has no list of recordings: their first HCI_CHECK_MOST_RUNS are its words. */
static size_t checked_runs(const cli_tuning *t, const char *run[HCI_CHECK_MOST_RUNS])
{
    size_t count = 0;
    for (size_t k = 0; k < t->runs.count && count < HCI_CHECK_MOST_RUNS; ++k)
        if (!hci_runs_is_further_point(&t->runs, k))
            run[count++] = t->arguments->given[TUNE_RUNS] ? t->runs.origin[k].path : cli_tune_log_of(t, k);
    return count;
}

static hci_status run_check(cli_tuning *t, const char *run[HCI_CHECK_MOST_RUNS], hci_check *check,
                            hci_note *note)
{
    hci_run_options reading = t->reading.run;
    reading.holding = false;
    const hci_status status = hci_check_files(t->machine, run, checked_runs(t, run), &reading, check, note);
    return status > HCI_NOT_REACHED ? status : HCI_OK;
}

void cli_tune_take_offset(cli_tuning *t, double more_rad, const char *why)
{
    const double so_far_rad = t->runs.count > 0 ? t->runs.run[0].zero_offset_rad : 0.0;
    snprintf(t->offset, sizeof t->offset, "%.3f",
             remainder(so_far_rad + more_rad, 2.0 * HCI_PI) * 180.0 / HCI_PI);
    t->has_offset = true;
    hci_tuning_say(&t->tuning, HCI_TUNING_READ, "--angle-offset %s: the electrical zero of the angle, by %s",
                   t->offset, why);
}

/* An encoder's zero may lie on an axis as anywhere else. */
static const char AXIS[] = "run_angle_zero_";

static bool is_of_zero(const char *slip)
{
    return strcmp(slip, "run_angle_offset") == 0 || strncmp(slip, AXIS, strlen(AXIS)) == 0;
}

/* A zero that is off, on an axis or elsewhere, and nothing else, is set right. */
static bool finds_offset(const hci_check *c)
{
    double of_zero = 0.0;
    for (size_t k = 0; k < c->findings; ++k) {
        if (is_of_zero(c->finding[k].slip))
            of_zero += c->finding[k].probability;
        else if (c->finding[k].probability >= HCI_CHECK_FOUND)
            return false;
    }
    return (isfinite(c->zero_rad) || isfinite(c->drive_zero_rad)) && of_zero >= HCI_CHECK_FOUND;
}

static void take_found(cli_tuning *t, const hci_check *c)
{
    t->took_drive_zero = isfinite(c->drive_zero_rad);
    if (t->took_drive_zero)
        cli_tune_take_offset(t, c->drive_zero_rad, "the phase currents, which then lie along i_q");
    else
        cli_tune_take_offset(t, c->zero_rad, "what check finds in the logs");
}

hci_status cli_tune_check(cli_tuning *t, hci_note *note)
{
    static hci_check check;
    const char *run[HCI_CHECK_MOST_RUNS];
    char folder[CLI_TUNE_PATH];
    cli_tune_line c = {{"check", t->machine}, 2};
    hci_status status = run_check(t, run, &check, note);
    if (!status && finds_offset(&check)) {
        take_found(t, &check);
        status = cli_tune_read_inputs(t, note);
        if (!status) status = run_check(t, run, &check, note);
    }
    if (status) return status;
    for (size_t k = 0; k < checked_runs(t, run); ++k)
        cli_tune_add(&c, run[k]);
    cli_tune_path(t, "check", folder);
    cli_tune_add_reading(&c, t);
    cli_tune_add(&c, "-o");
    cli_tune_add(&c, folder);
    cli_tune_note_line(t, &c, true);
    judge_number(t, &check);
    say_check(t, &check);
    judge_check(t, &check);
    return hci_check_write(&check, folder, note);
}
