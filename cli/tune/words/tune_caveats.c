#include "cli/tune/words/tune_caveats.h"

#include <ctype.h>
#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <string.h>

#include "cli/tune/tune_facts.h"
#include "cli/tune/tune_options.h"
#include "cli/tune/tune_read.h"
#include "cli/tune/tune_recorded.h"
#include "cli/tune/tune_size.h"

/* One more thing that a reader of the heading has to know: a sentence without its full stop. */
void cli_tune_caveat(cli_tuning *t, const char *format, ...)
{
    char words[1024];
    va_list values;
    va_start(values, format);
    vsnprintf(words, sizeof words, format, values);
    va_end(values);
    if (words[0] && words[1] != '_') words[0] = (char)toupper((unsigned char)words[0]);
    hci_tuning_say(&t->tuning, HCI_TUNING_CAVEATS, "%s", words);
}

/* What is not understood because it is not of one motor. */
static void append_of_two(cli_tuning *t)
{
    cli_tune_two_ripples two;
    if (!t->is_solved || !hci_expected_ripple_is_doubtful(&t->solution.expected) ||
        !cli_tune_two_motors(t, &two))
        return;
    cli_tune_caveat(
        t,
        "The ripple of %.80s comes %d times a turn and that of %.80s %d times, and neither has the "
        "other's: "
        "are both logs of one motor, with the angle of its shaft?",
        cli_tune_name_of(t, two.first), two.first_order, cli_tune_name_of(t, two.second), two.second_order);
}

/* What was calculated and what was measured may be of two machines. */
static void append_of_calculated(cli_tuning *t)
{
    const size_t calculated = cli_tune_calculated_beside(t);
    if (calculated == 0 || !t->is_solved) return;
    cli_tune_caveat(
        t,
        "%zu of %zu recordings have no time and constant currents, as finite elements give them, and others "
        "were measured: all are taken for one machine, with magnets of one strength and one zero of the "
        "angle, which a bench need not have, and then no bound holds; tune those of each kind alone",
        calculated, t->runs.count);
}

/* Of the torque that is rated or asked for, from which on one without a current is more than friction. */
#define A_LOAD 0.2

/* A recording with the mean torque of a load, by a sensor, and no current; NULL: none. */
static const hci_run *loaded_without_current(const cli_tuning *t, size_t *count)
{
    const hci_run *first = NULL;
    const double asked_Nm = t->arguments->given[TUNE_TORQUE] ? t->arguments->number[TUNE_TORQUE] : 0.0;
    const double most_Nm = fmax(cli_tune_rated_Nm(t), asked_Nm);
    for (size_t k = *count = 0; k < t->runs.count && most_Nm > 0.0; ++k) {
        const hci_run *r = &t->runs.run[k];
        double mean_Nm = 0.0;
        if (r->torque_source != HCI_TORQUE_MEASURED || !r->torque_Nm || cli_tune_rms_A(r) > 0.0) continue;
        for (size_t n = 0; n < r->count; ++n)
            mean_Nm += r->torque_Nm[n] / (double)r->count;
        if (fabs(mean_Nm) < A_LOAD * most_Nm) continue;
        if (!first) first = r;
        ++*count;
    }
    return first;
}

/* Currents that are in the logs under a name of their own, or in none of their columns. */
static void append_of_unread(cli_tuning *t)
{
    const char *like = cli_tune_current_like(t);
    size_t count = 0;
    char column[HCI_RUN_NAME] = "";
    if (like) cli_tune_column_of(like, column);
    const hci_run *loaded = like ? NULL : loaded_without_current(t, &count);
    for (size_t k = 0; k < t->runs.count && like; ++k)
        count += t->runs.run[k].current_like[0] != '\0';
    if (!t->is_solved) return;
    if (like)
        cli_tune_caveat(
            t,
            "No current was read in %zu of %zu logs, and it was taken as 0: if the column `%s` is i_q, add "
            "--column '%s'",
            count, t->runs.count, column, like);
    else if (loaded)
        cli_tune_caveat(
            t,
            "No current was read in %zu of %zu logs, %.80s and such, though their torque is that of a "
            "load: it "
            "was taken as 0, and what they show is not that of a machine without current",
            count, t->runs.count, cli_tune_name_of(t, (size_t)(loaded - t->runs.run)));
}

/* Voltages that drives command, where a current flows by them that nobody recorded. */
static void append_of_command(cli_tuning *t)
{
    const hci_run *r = NULL;
    char ohm[32] = "OHM";
    for (size_t k = 0; k < t->runs.count && !r; ++k)
        if (t->runs.run[k].commanded_voltage[0]) r = &t->runs.run[k];
    if (!r) return;
    if (t->declared.resistance_ohm > 0.0)
        snprintf(ohm, sizeof ohm, "%.6g", t->declared.resistance_ohm / r->commanded_unit_V);
    cli_tune_caveat(
        t,
        "`%s` is a voltage that the drive commands and no back-EMF, and the current that flows by it is in "
        "no column: of a shaft that is turned slowly it is that voltage over the resistance of a phase, as "
        "far as the back-EMF is small beside it (what that adds looks like friction): --column "
        "'iq_A=%s/%s' --holding",
        r->commanded_voltage, r->commanded_voltage, ohm);
}

/* Of a constant, that sheets and drives are off by and that is not spoken of. */
#define NEAR_DRIVE 0.1

/* The torque that a drive has computed has a constant in it, too. */
static void append_of_drive(cli_tuning *t)
{
    const double sheet = t->reading.run.torque_constant_Nm_per_A;
    for (size_t k = 0; k < t->runs.count && t->is_solved && t->is_own && !t->has_emf; ++k) {
        const double drive = fabs(t->runs.run[k].drive_constant_Nm_per_A);
        if (!(drive > 0.0) || fabs(drive / sheet - 1.0) < NEAR_DRIVE) continue;
        cli_tune_caveat(
            t,
            "By its own torque in %.80s the drive counts on %.3g N·m per A of i_q, and %s makes %.3g: "
            "one of "
            "the two is off, and all that is said in N·m with it",
            cli_tune_name_of(t, k), drive, cli_tune_constant_option(t), sheet);
        return;
    }
}

static void append_of_time(cli_tuning *t)
{
    const hci_run *r = cli_tune_lacks_time(t);
    if (!r || t->has_slip) return;
    if (r->time_like[0])
        cli_tune_caveat(
            t,
            "No time was read: if the column `%.*s` is it, add --column '%s'; or --holding, if the shaft "
            "was turned slowly by control",
            (int)strcspn(strchr(r->time_like, '=') + 1, "/"), strchr(r->time_like, '=') + 1, r->time_like);
    else
        cli_tune_caveat(
            t, "No time was read: name its column by --column 'time_s=COLUMN' (time_ms, time_us; COLUMN/1000 "
               "of a counter of 1000 a second); or add --holding, if the shaft was turned slowly by control");
}

/* A load cell on a lever, whose length nobody said. */
static void append_of_force(cli_tuning *t)
{
    const char *force = cli_tune_lacks_torque(t) && !cli_tune_torque_like(t) ? cli_tune_force_like(t) : NULL;
    if (force)
        cli_tune_caveat(
            t,
            "If the column `%.60s` is the force of a load cell, the torque is it times the lever: "
            "--column 'torque_Nm=%.60s/NUMBER' with 1 over the lever in m as NUMBER, 6.667 for 150 "
            "mm (of kg 0.102 over the lever, of g 102 over it)",
            force, force);
}

/* Columns that nobody named, and that may be what is missing. */
static void append_of_columns(cli_tuning *t)
{
    const char *torque = cli_tune_lacks_torque(t) ? cli_tune_torque_like(t) : NULL;
    const char *current = !t->has_slip && !torque ? cli_tune_current_like(t) : NULL;
    if (torque)
        cli_tune_caveat(t, "If the column `%s` is a torque, add --column '%s'", strchr(torque, '=') + 1,
                        torque);
    append_of_force(t);
    if (current) {
        char column[HCI_RUN_NAME];
        cli_tune_column_of(current, column);
        cli_tune_caveat(t, "No current was read: if the column `%s` is i_q, add --column '%s'%s", column,
                        current,
                        strstr(current, HCI_RUN_DIGITS_PER_A)
                            ? ", with what the firmware has for 1 A, which the numbers do not tell"
                            : "");
    }
}

void cli_tune_column_caveats(cli_tuning *t)
{
    append_of_time(t);
    append_of_columns(t);
}

/* What is promised holds as far as the other logs say what the motor is. */
static void append_of_odd(cli_tuning *t)
{
    const hci_odd_run *odd = &t->diagnosis.odd;
    size_t k = 0;
    if (!t->has_diagnosis || !odd->file || !t->is_solved) return;
    while (k + 1 < t->runs.count && t->runs.run[k].name != odd->file)
        ++k;
    if (odd->is_aside)
        cli_tune_caveat(
            t,
            "The log %.80s is set aside: with it the logs are not explained, and without it they are; the "
            "machine leaves %.3g N·m rms of it, where %.3g N·m are noise",
            cli_tune_name_of(t, k), odd->rms_Nm, odd->noise_Nm);
    else
        cli_tune_caveat(
            t,
            "The log %.80s disagrees with the other logs and is left out: look at that file, or at what "
            "was connected there",
            cli_tune_name_of(t, k));
}

void cli_tune_log_caveats(cli_tuning *t)
{
    append_of_odd(t);
    append_of_unread(t);
    append_of_two(t);
    append_of_calculated(t);
    append_of_command(t);
    append_of_drive(t);
}
