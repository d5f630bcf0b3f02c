#include "cli/tune/tune_heading.h"

#include <ctype.h>
#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <string.h>

#include "cli/tune/tune_cover.h"
#include "cli/tune/tune_facts.h"
#include "cli/tune/tune_options.h"
#include "cli/tune/tune_read.h"
#include "cli/tune/tune_recorded.h"
#include "cli/tune/tune_size.h"
#include "cli/tune/tune_suspect.h"
#include "hci/host/waveform/turning_load.h"

/* What a figure of the model leaves open. */
static const char *not_known(const cli_tuning *t)
{
    return t->is_own && (!t->has_emf || t->emf_is_size_alone) && !t->has_load
               ? "what harmonics of the real back-EMF add under load is not known"
               : "what is left on the machine is not known";
}

static const char *becomes(double before_Nm, double after_Nm)
{
    return after_Nm < before_Nm ? "falls to" : "becomes one of";
}

/* A bound above what a plain sine leaves promises nothing, and one far above it is none. */
static void say_bound(const cli_tuning *t, double before_Nm, double after_Nm, char *text, size_t size)
{
    const hci_expected_ripple *e = &t->solution.expected;
    if (cli_tune_is_unpromised(t))
        snprintf(
            text, size,
            "A ripple of %.3g N·m from peak to peak %s %.3g N·m in the model; what is left on the machine "
            "these recordings do not tell (their bound is %.2g N·m)",
            before_Nm, becomes(before_Nm, after_Nm), after_Nm, hci_ripple_bound_as_said(e->peak_to_peak_Nm));
    else if (e->peak_to_peak_Nm < before_Nm)
        snprintf(
            text, size,
            "A ripple of %.3g N·m from peak to peak falls to at most %.3g N·m on the machine (95 %%)%s, of "
            "which the table makes %.2g",
            before_Nm, hci_ripple_bound_as_said(e->peak_to_peak_Nm),
            cli_tune_hangs_on_lag(t) ? " if the torque sensor is in time, which one speed does not tell" : "",
            hci_ripple_bound_as_said(e->table_peak_to_peak_Nm));
    else
        snprintf(text, size,
                 "A ripple of %.3g N·m from peak to peak %s %.3g N·m in the model; on the machine it is at "
                 "most %.3g N·m (95 %%), so that the recordings do not promise less than without the table",
                 before_Nm, becomes(before_Nm, after_Nm), after_Nm,
                 hci_ripple_bound_as_said(e->peak_to_peak_Nm));
}

/* Beside a model that does not explain what was recorded stands what was recorded. */
static void say_doubtful(const cli_tuning *t, double before_Nm, char *text, size_t size)
{
    const cli_tune_ripple x = cli_tune_recorded_ripple(t);
    char current[32] = "without current";
    snprintf(text, size,
             "%s, so what the table leaves of the ripple is not to be relied on and may be more than a plain "
             "sine leaves",
             isfinite(t->solution.expected.unbelievable_order)
                 ? "A back-EMF that is not believable is in the model"
             : t->diagnosis.verdict < HCI_DIAGNOSIS_PARTLY
                 ? "The search for what makes the ripple ended before all was compared"
                 : "The model does not explain the recordings");
    if (x.current_A > 0.0) snprintf(current, sizeof current, "at %.3g A", x.current_A);
    if (x.run < t->runs.count)
        snprintf(text + strlen(text), size - strlen(text),
                 "; the recording %.120s shows %.2g N·m from peak to peak %s, and a plain sine in the model "
                 "makes %.2g N·m "
                 "at %.3g A",
                 cli_tune_name_of(t, x.run), x.peak_to_peak_Nm, current, before_Nm,
                 t->solution.plain_amplitude_A);
    if (cli_tune_unexplained_Nm(t) > 0.0)
        snprintf(
            text + strlen(text), size - strlen(text),
            "; up to %.2g N·m rms of ripple in the recordings is not in the model, and the table leaves that "
            "at least",
            cli_tune_unexplained_Nm(t));
}

static void say_fall(cli_tuning *t, char *text, size_t size)
{
    const hci_expected_ripple *e = &t->solution.expected;
    double before_Nm, after_Nm;
    cli_tune_swing_of(t, &before_Nm, &after_Nm);
    if (cli_tune_is_never_seen(t))
        snprintf(
            text, size,
            "The model has a ripple of %.3g N·m, and no recording shows more torque than %.3g N·m: it is not "
            "believable, and the table is not to be used",
            before_Nm, cli_tune_largest_recorded_Nm(t));
    else if (hci_expected_ripple_is_doubtful(e))
        say_doubtful(t, before_Nm, text, size);
    else if (cli_tune_is_boundless(t))
        snprintf(text, size,
                 "A ripple of %.3g N·m from peak to peak %s %.3g N·m in the model; on the machine it is not "
                 "known: the recordings bound it by no less than the torque itself",
                 before_Nm, becomes(before_Nm, after_Nm), after_Nm);
    else if (e->state == HCI_RIPPLE_KNOWN)
        say_bound(t, before_Nm, after_Nm, text, size);
    else
        snprintf(text, size, "A ripple of %.3g N·m from peak to peak %s %.3g N·m in the model; %s", before_Nm,
                 becomes(before_Nm, after_Nm), after_Nm, not_known(t));
}

/* What is not in the logs goes before what is. */
static void say_lack_of_torque(const cli_tuning *t, char *text, size_t size)
{
    const char *column = cli_tune_torque_like(t);
    if (column)
        snprintf(
            text, size,
            "No log has a torque, so the table takes no cogging torque away; if the column `%s` is one, add "
            "--column '%s'",
            strchr(column, '=') + 1, column);
    else
        snprintf(text, size, "No log has a torque, so the table takes no cogging torque away");
}

/* Whether the model has cogging torque that the table could take away. */
static bool has_cogging(const cli_tuning *t)
{
    for (size_t k = 0; k < t->declared.model.cogging_count; ++k)
        if (hypot(t->declared.model.cogging[k].sine, t->declared.model.cogging[k].cosine) > 0.0) return true;
    return t->has_cogging;
}

/* What the harmonics of a measured back-EMF make, which is all that the table answers. */
static void append_emf_ripple(const cli_tuning *t, char *text, size_t size)
{
    double before_Nm, after_Nm;
    cli_tune_swing_of(t, &before_Nm, &after_Nm);
    if (t->has_emf && before_Nm >= t->solution.tolerance_Nm)
        snprintf(text + strlen(text), size - strlen(text),
                 "; the ripple that the measured back-EMF makes, %.3g N·m from peak to peak, %s %.3g N·m in "
                 "the model",
                 before_Nm, becomes(before_Nm, after_Nm), after_Nm);
}

static void say_table(cli_tuning *t)
{
    hci_tuning *r = &t->tuning;
    double before_Nm, after_Nm;
    hci_tuning_swing(&t->solution, &before_Nm, &after_Nm);
    if (cli_tune_lacks_torque(t) && !has_cogging(t)) {
        say_lack_of_torque(t, r->heading, sizeof r->heading);
        append_emf_ripple(t, r->heading, sizeof r->heading);
    } else if (t->size == CLI_TUNE_EXCESS)
        cli_tune_say_excess(t, r->heading, sizeof r->heading);
    else if (before_Nm >= t->solution.tolerance_Nm)
        say_fall(t, r->heading, sizeof r->heading);
    else if (cli_tune_unexplained_Nm(t) > 0.0)
        snprintf(r->heading, sizeof r->heading,
                 "Nothing certain was found that makes a ripple, but up to %.3g N·m rms of it is in the "
                 "recordings",
                 cli_tune_unexplained_Nm(t));
    else
        snprintf(r->heading, sizeof r->heading, "Nothing was found that would make a ripple");
}

static void append(cli_tuning *t, const char *format, ...) HCI_PRINTF(2, 3);

/* One more thing that a reader of the heading has to know: a sentence without its full stop. */
static void append(cli_tuning *t, const char *format, ...)
{
    char words[1024];
    va_list values;
    va_start(values, format);
    vsnprintf(words, sizeof words, format, values);
    va_end(values);
    if (words[0] && words[1] != '_') words[0] = (char)toupper((unsigned char)words[0]);
    hci_tuning_say(&t->tuning, HCI_TUNING_CAVEATS, "%s", words);
}

/* Of the bound, or of the ripple where there is none, that order 1 may be and not be spoken of. */
#define MUCH_OF_ZEROS 0.1

/* Order 1 that may be of the current sensors: a table that takes it away adds it where they are right, and
 * one that leaves it to them leaves it where it is cogging torque. */
static void append_of_zeros(cli_tuning *t)
{
    const double zero_Nm = t->diagnosis.uncertainty.origin.sensor_zero_Nm,
                 zero_A = zero_Nm / t->reading.run.torque_constant_Nm_per_A;
    const hci_expected_ripple *e = &t->solution.expected;
    double before_Nm, after_Nm;
    if (!t->is_solved) return;
    hci_tuning_swing(&t->solution, &before_Nm, &after_Nm);
    const double whole_Nm = e->state == HCI_RIPPLE_KNOWN ? e->peak_to_peak_Nm : before_Nm;
    if (!(zero_Nm > 0.0) || 2.0 * zero_Nm < MUCH_OF_ZEROS * whole_Nm) return;
    const bool is_taken = hci_angle_torque_Nm(&t->declared.model, &t->diagnosis.effects.list, 1.0) >= zero_Nm;
    append(t,
           is_taken
               ? "Order 1, %.2g N·m, is cogging torque, or zeros of the current sensors that are off by "
                 "up to %.2g A and no torque of the motor, which these logs do not tell apart: the table "
                 "takes it away for sensors as they were, and adds it where they are nulled or corrected"
               : "Order 1, %.2g N·m, is taken for zeros of the current sensors, %.2g A, and may be "
                 "cogging torque, which these logs do not tell apart: the table leaves it then",
           zero_Nm, zero_A);
}

/* What is not understood because it is not of one motor. */
static void append_of_two(cli_tuning *t)
{
    cli_tune_two_ripples two;
    if (!t->is_solved || !hci_expected_ripple_is_doubtful(&t->solution.expected) ||
        !cli_tune_two_motors(t, &two))
        return;
    append(t,
           "The ripple of %.80s comes %d times a turn and that of %.80s %d times, and neither has the "
           "other's: "
           "are both logs of one motor, with the angle of its shaft?",
           cli_tune_name_of(t, two.first), two.first_order, cli_tune_name_of(t, two.second),
           two.second_order);
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
        append(
            t,
            "No current was read in %zu of %zu logs, and it was taken as 0: if the column `%s` is i_q, add "
            "--column '%s'",
            count, t->runs.count, column, like);
    else if (loaded)
        append(t,
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
    append(
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
        append(t,
               "By its own torque in %.80s the drive counts on %.3g N·m per A of i_q, and %s makes %.3g: "
               "one of "
               "the two is off, and all that is said in N·m with it",
               cli_tune_name_of(t, k), drive, cli_tune_constant_option(t), sheet);
        return;
    }
}

/* What else than the motor may be in the logs. */
static void append_of_logs(cli_tuning *t)
{
    if (t->once_a_turn_Nm > 0.0 && t->is_solved)
        append(t,
               "%.3g N·m of the ripple come once or twice a turn, and a load on the shaft makes that as well "
               "as the "
               "motor: without that load the table adds them",
               t->once_a_turn_Nm);
    if (cli_tune_clipped(t) > 0 && t->is_solved)
        append(t, "Currents in %zu of %zu logs are clipped, and what they tell is too small",
               cli_tune_clipped(t), t->runs.count);
    if (cli_tune_torque_clipped(t) > 0 && t->is_solved)
        append(t, "The torque in %zu of %zu logs is clipped, and what lies beyond is missing",
               cli_tune_torque_clipped(t), t->runs.count);
}

/* What the size and the sign of a torque make doubtful. */
static void append_of_doubt(cli_tuning *t)
{
    if (t->has_sensor_zero && t->is_solved)
        append(t,
               "The torque without current is %.3g N·m with the motion on average, where friction brakes: "
               "that "
               "is taken for the zero of its sensor; if its sign is the other one instead (--column "
               "torque=-COLUMN) the table doubles the ripple; one direction does not tell, a turn back does",
               t->drives_Nm);
    else if (t->drives_Nm > 0.0 && t->is_solved)
        append(t,
               "The torque without current is %.3g N·m with the motion on average, where friction brakes: "
               "either its zero is off, or its sign is the other one (--column torque=-COLUMN) and the table "
               "doubles the ripple; one direction does not tell, a turn back does",
               t->drives_Nm);
    if (t->size == CLI_TUNE_LARGE)
        append(t,
               "Without current the torque varies by %.3g N·m, %.3g times the rated torque, and few motors "
               "have so much: is the torque in N·m, and not in N·cm or lbf·in, and is Kv right?",
               t->open_swing_Nm, t->open_swing_Nm / cli_tune_rated_Nm(t));
}

/* Of the gains, that are no matter. */
#define LEAST_GAIN 0.002

/* What readings of the phases are divided by: of two of them or all. */
static bool are_gains(const hci_effect *e)
{
    for (size_t j = 0; j < e->count && e->type->correction; ++j)
        if (e->type->correction[e->term[j].parameter].plus != 1.0) return false;
    return (e->count == 2 || e->count == 3) && e->type->correction;
}

/* The mean of the three gains, less 1, which has an equal in the back-EMF whatever their ratios; 0: none. */
static double common_gain(const cli_tuning *t)
{
    const hci_effects *list = &t->diagnosis.effects.list;
    for (size_t k = 0; k < list->count; ++k) {
        const hci_effect *e = &list->effect[k];
        double mean = 0.0;
        if (!are_gains(e)) continue;
        for (size_t j = 0; j < e->count; ++j)
            mean += e->term[j].value / 3.0;
        return fabs(mean) > LEAST_GAIN ? mean : 0.0;
    }
    return 0.0;
}

/* Torque is back-EMF times current: a sensor of the torque does not tell a share of the one from one of the
 * other, nor from one of its own. */
static void append_of_gain(cli_tuning *t)
{
    const double gain = common_gain(t), other = -gain / (1.0 + gain);
    if (fabs(gain) > 0.0 && t->has_emf)
        append(t,
               "%.2g %% are common to the gains of all three currents, and may be the torque sensor's "
               "instead, which "
               "reads %.2g %% too %s then: the back-EMF is from voltages of these logs, and nothing in them "
               "tells the two apart",
               100.0 * fabs(gain), 100.0 * fabs(other), other < 0.0 ? "little" : "much");
    else if (fabs(gain) > 0.0)
        append(
            t,
            "%.2g %% are common to the gains of all three currents, and may be the back-EMF's instead, which "
            "is %.2g %% %s then: a torque sensor does not tell the two apart, and voltages of the open "
            "machine do",
            100.0 * fabs(gain), 100.0 * fabs(other), other < 0.0 ? "smaller" : "larger");
    if (strstr(t->solution.corrections, " A from i_"))
        append(t, "The offsets of the currents are those of the logs: a drive that nulls its sensors at each "
                  "start has others");
}

/* How early a channel is read that a drive can correct, s; 0: none is. */
static double early_s(const cli_tuning *t)
{
    const hci_effects *list = &t->diagnosis.effects.list;
    for (size_t k = 0; k < list->count; ++k) {
        const hci_effect *e = &list->effect[k];
        for (size_t j = 0; e->type->late && j < e->count; ++j)
            if (e->type->correction[e->term[j].parameter].late_alone && e->term[j].value < 0.0)
                return -e->term[j].value;
    }
    return 0.0;
}

/* Nothing is read before it is true. */
static void append_of_early(cli_tuning *t)
{
    const double early = early_s(t);
    if (early > 0.0)
        append(t,
               "The angle seems to be read %.2g s before it is true, as no sensor does: most likely the "
               "torque sensor is late by as much, and nothing is corrected for it; where the drive looks "
               "ahead, or "
               "reads its currents late, add to the angle the speed times -%.5g s, and logs at other speeds "
               "and loads tell which it is",
               early, early);
}

static void append_of_zero(cli_tuning *t)
{
    if (fabs(t->open_turn_deg) > 0.0 && t->is_solved)
        append(t,
               "The back-EMF is found turned by %.1f ± %.1f degrees%s, which a saliency with its "
               "saturation may do as well as another zero: %s with i_d of both signs at two currents, or "
               "voltages of the open machine, tell them apart",
               t->open_turn_deg, t->open_turn_error_deg, t->turn_is_of_dq ? " against i_d and i_q" : "",
               t->turn_is_of_dq ? "phase currents" : "runs");
    if (fabs(t->turned_deg) > 0.0 && t->is_solved)
        append(
            t,
            "The electrical zero of the logs is %.1f ± %.1f degrees off by the torques, unless the machine "
            "has a saliency that nobody declared: begin again with --angle-offset %.1f",
            fabs(t->turned_deg), t->turned_error_deg, cli_tune_offset_to_give(t));
}

/* What keeps the currents from being as wanted: a limit that binds, or the order that is off most. */
static void append_of_miss(cli_tuning *t)
{
    const hci_solution *s = &t->solution;
    if (!cli_tune_is_missed(t) || t->size == CLI_TUNE_EXCESS) return;
    for (size_t k = 0; k < s->limit_count; ++k)
        if (s->limit[k].binds) {
            append(t, "The torque is not as wanted, since the currents keep a limit, %s %.4g A",
                   hci_limit_kind_name(s->limit[k].kind), s->limit[k].limit);
            return;
        }
    append(t, "The torque is not as wanted: order %.4g is off by %.2g N·m, and more than %.2g N·m counts",
           s->worst_order, s->worst_error_Nm, fmax(s->tolerance_Nm, 0.5 * t->cut_Nm));
}

/* A limit that currents found angle by angle do not keep. */
static void append_of_excess(cli_tuning *t)
{
    const hci_solution *s = &t->solution;
    for (size_t k = 0; k < s->limit_count && !s->within_limits; ++k) {
        const hci_limit *l = &s->limit[k];
        if (!(l->value > l->limit)) continue;
        append(t,
               "The currents do not keep a limit, %s %.4g %s, but take %.4g: the table is not for "
               "continuous use, and --torque with less is",
               hci_limit_kind_name(l->kind), l->limit,
               l->kind == HCI_LIMIT_VOLTAGE  ? "V"
               : l->kind == HCI_LIMIT_COPPER ? "A²"
                                             : "A",
               l->value);
        return;
    }
}

/* All before is of currents that flow as the table has them. */
static void append_of_loop(cli_tuning *t)
{
    char words[512];
    if (!t->is_solved || t->size == CLI_TUNE_EXCESS || cli_tune_is_of_no_use(t) || cli_tune_is_never_seen(t))
        return;
    hci_loop_reach_words(&t->solution.loop, words, sizeof words);
    if (words[0]) append(t, "The figures are of currents that flow as in the table: %s", words);
}

/* What the table needs of the drive, and does not do. */
static void append_of_table(cli_tuning *t)
{
    append_of_logs(t);
    append_of_zeros(t);
    if (t->is_solved && *t->solution.corrections)
        append(t,
               "The sensors of the drive, where they are those of the logs, have to be corrected before: %s",
               t->solution.corrections);
    if (t->is_solved && *t->solution.corrections) append_of_gain(t);
    if (t->is_solved) append_of_early(t);
    append_of_zero(t);
    append_of_doubt(t);
    append_of_miss(t);
    if (t->is_solved && t->size != CLI_TUNE_EXCESS) append_of_excess(t);
    if (cli_tune_misses_torque(t))
        append(t, "The table makes %.4g N·m on average, and not the %.4g N·m that were wanted",
               cli_tune_made_Nm(t), t->mean_Nm);
    if (cli_tune_is_far_beyond(t))
        append(t,
               "The peak current of the table, %.3g A, is %.2g times the largest recorded one, %.3g A: are "
               "the rated "
               "current and the torque in A and N·m?",
               t->solution.peak_phase_current_A,
               t->solution.peak_phase_current_A / cli_tune_largest_recorded_A(t),
               cli_tune_largest_recorded_A(t));
    if (cli_tune_strange_rpm(t) > 0.0)
        append(t,
               "What the resistance takes at the rated current would turn this motor at %.2g rpm: are %s, "
               "--resistance and --rated-current of this motor and in their units?",
               cli_tune_strange_rpm(t), cli_tune_constant_option(t));
    if (cli_tune_is_below_idle(t))
        append(t,
               "By this Kv %.3g N·m take %.3g A, and the shaft without a load took up to %.3g A: is %s the "
               "right number in its unit, and the torque in N·m?",
               t->mean_Nm, t->solution.plain_amplitude_A, cli_tune_largest_recorded_A(t),
               cli_tune_constant_option(t));
}

/* Of the torque per ampere, that sheets are off by and torque sensors, too, and that is not spoken of. */
#define NEAR_SHEET 0.02

/* Share of the declared torque per ampere that effects of the fundamental add: 0: they do not. */
static double found_above_sheet(const cli_tuning *t)
{
    const hci_effects *list = &t->diagnosis.effects.list;
    double more_Nm_per_A = 0.0;
    for (size_t k = 0; k < list->count; ++k) {
        const hci_effect *e = &list->effect[k];
        for (size_t j = 0; j < e->count; ++j) {
            const hci_effect_parameter *p = &e->type->parameter[e->term[j].parameter];
            if (strcmp(p->unit, "Nm_per_A") == 0 && strcmp(p->name, "sine") == 0 &&
                fabs(e->term[j].order - 1.0) < HCI_ORDER_TOLERANCE)
                more_Nm_per_A += 1.5 * e->term[j].value;
        }
    }
    return more_Nm_per_A / t->reading.run.torque_constant_Nm_per_A;
}

/* A torque sensor that reads too much makes all machines that its recordings allow too strong alike. */
static void append_of_scale(cli_tuning *t)
{
    const double share = found_above_sheet(t), percent = 100.0 * fabs(share);
    if (t->is_solved && !t->has_emf && fabs(share) > NEAR_SHEET && percent < 100.0)
        append(t,
               "The torque sensor shows %.2g %% %s torque per ampere than %s makes: if it is the sensor (or "
               "those of the currents) that reads so, mean torque and ripple are as much %s than said",
               percent, share > 0.0 ? "more" : "less", cli_tune_constant_option(t),
               share > 0.0 ? "smaller" : "larger");
}

/* What the recordings do not tell of the torque. */
static void append_of_torque(cli_tuning *t)
{
    char order[CLI_TUNE_ORDER];
    if (cli_tune_reach_of_slopes(t) > 0.0)
        append(t, "These recordings do not show cogging torque above order %.3g",
               cli_tune_reach_of_slopes(t));
    if (cli_tune_is_short(t) && t->is_solved) {
        char turns[CLI_TUNE_COLUMN_WORDS];
        cli_tune_say_turns(t, turns);
        append(t, "The logs cover %.2g of a turn, and at least a whole one is needed to tell orders apart%s",
               t->turns, turns);
    }
    if (cli_tune_is_coarse(t) && t->is_solved && !(cli_tune_reach_of_slopes(t) > 0.0))
        append(t, "Orders above %.3g were not looked at, since the samples lie too far apart",
               t->highest_order);
    append_of_scale(t);
    if (t->mains_Hz > 0.0 && t->is_solved)
        append(t, "Order %s is %.0f Hz at this one speed, as hum of the mains is: another speed tells",
               cli_tune_order_words(t, t->mains_order, order), t->mains_Hz);
    else if (t->fast_Hz > 0.0 && t->is_solved && t->solution.expected.state != HCI_RIPPLE_KNOWN)
        append(t,
               "At this one speed the ripple has %.0f Hz, of which a slower torque sensor or filter shows "
               "less, and late: a slow turn beside it tells",
               t->fast_Hz);
}

/* Of the ripple, that an inertia may take out and not be spoken of in the first line. */
#define MUCH_INERTIA 0.05

/* Of the one that was declared. */
static void append_of_declared_inertia(cli_tuning *t)
{
    const hci_run *of = cli_tune_denied_inertia(t);
    const double inertia_kgm2 = t->declared.inertia_kgm2, taken_Nm = cli_tune_hangs_on_inertia_Nm(t);
    double before_Nm, after_Nm;
    hci_tuning_swing(&t->solution, &before_Nm, &after_Nm);
    if (of)
        append(t,
               "The declared inertia of %.3g kg·m² is not that of this shaft: by current and acceleration "
               "it is %.2g to "
               "%.3g kg·m² (as long as the torque per ampere is right), and what is wrong in it is in "
               "the orders "
               "found: begin again with the right one%s",
               inertia_kgm2, of->least_inertia_kgm2, of->most_inertia_kgm2,
               t->is_own && of->torque_source == HCI_TORQUE_HOLDING ? ", or without --inertia" : "");
    else if (cli_tune_is_scaled_by_inertia(t) && before_Nm >= t->solution.tolerance_Nm)
        append(t,
               "All torques are in proportion to the declared inertia of %.3g kg·m², which nothing in "
               "these logs tells",
               inertia_kgm2);
    else if (taken_Nm > MUCH_INERTIA * before_Nm)
        append(t,
               "%.2g N·m rms of the torque hang on the declared inertia of %.3g kg·m², which these logs "
               "hardly tell",
               taken_Nm, inertia_kgm2);
}

static void append_of_inertia(cli_tuning *t)
{
    const hci_run *of = NULL;
    double before_Nm, after_Nm;
    const double taken_Nm = cli_tune_taken_by_inertia_Nm(t, &of);
    if (!t->is_solved || !(taken_Nm > 0.0)) return;
    hci_tuning_swing(&t->solution, &before_Nm, &after_Nm);
    if (taken_Nm > MUCH_INERTIA * before_Nm)
        append(t,
               "An inertia of %.3g ± %.1g kg·m² was found in the log, and %.2g N·m rms of the ripple hang "
               "on it: "
               "--inertia gives it",
               of->turns_inertia_kgm2, of->turns_inertia_error_kgm2, taken_Nm);
}

static void append_of_sign(cli_tuning *t)
{
    double deg;
    if (t->is_solved && cli_tune_off_iq(t, &deg))
        append(t,
               "The phase currents do not lie along the i_q of this angle: where the drive keeps its i_d "
               "at 0, "
               "the electrical zero is off, and --angle-offset %.0f or %.0f is right",
               deg, remainder(deg + 180.0, 360.0));
    else if (t->is_solved && cli_tune_lacks_sign(t))
        append(t, "The sign of i_q is not told, and with the other one the ripple doubles");
}

/* What they do not tell of the machine, and what of them was not used. */
static void append_of_machine(cli_tuning *t)
{
    char order[CLI_TUNE_ORDER], words[512];
    append_of_inertia(t);
    if (t->is_solved && cli_tune_is_without_angle(t))
        append(t, "No log has an angle: the table begins where the back-EMF of phase a rises through zero, "
                  "and cannot be played before the electrical zero of the drive is set there");
    if (t->is_solved) append_of_declared_inertia(t);
    if (cli_tune_is_uncounted(t))
        append(t, "That there are %d pole pairs is taken on trust, since nothing in these logs counts them",
               t->declared.model.pole_pairs);
    append_of_sign(t);
    if (t->is_solved && cli_tune_is_electrical_alone(t))
        append(
            t,
            "The angle begins again in each of the %d electrical turns: what slots and magnets make once "
            "in "
            "a turn of the shaft is not told, and what these logs do not average out stands among the orders",
            t->declared.model.pole_pairs);
    if (cli_tune_say_long(t, words, sizeof words)) append(t, "%s", words);
    if (cli_tune_is_off_sheet(t))
        append(t, "The measured back-EMF is %.3g times that of the data sheet", t->emf_to_sheet);
    if (t->left_out > 0) append(t, "%zu of %zu logs left out", t->left_out, t->left_out + t->kept.words);
    if (t->has_doubt && !cli_tune_is_off_sheet(t))
        append(t, "`check` does not understand all that the logs say");
    if (t->stranger_order > 0.0)
        append(t,
               "The largest order found, %s, is none that %.0f slots and %d poles make: %.5g and its "
               "multiples",
               cli_tune_order_words(t, t->stranger_order, order), t->declared.slots,
               2 * t->declared.model.pole_pairs, cli_tune_order_of_slots(t));
    if (cli_tune_misses_slots(t) && !cli_tune_has_high_slots(t))
        append(t, "Order %.5g, which slots and poles make, was not looked at", cli_tune_order_of_slots(t));
}

static bool has_rough_clock(const cli_tuning *t)
{
    for (size_t k = 0; k < t->runs.count; ++k)
        if (t->runs.run[k].is_unsteady && t->runs.run[k].rough_clock) return true;
    return false;
}

/* What keeps the logs from being used, the first that holds; NULL: nothing of the kind. */
static const char *why_blocked(const cli_tuning *t)
{
    if (t->has_misfit)
        return "Angle, order or speed in the logs contradict each other, and no slip that is known explains "
               "it";
    if (cli_tune_has_gap(t))
        return "A small part of the turn has no samples, and the order of slots and poles is not told across "
               "it";
    if (t->has_alias) return "Cogging torque of a higher order would look like one of a low order";
    if (t->has_standstill)
        return "The angle of the rotor does not change in the logs: the shaft stands, and one angle tells "
               "neither cogging torque nor back-EMF";
    if (t->has_no_angle)
        return "The log has no angle of the rotor, and a table over one whose zero nobody knows cannot be "
               "played";
    return NULL;
}

/* What of the logs does not tell a torque. */
static const char *why_untold(const cli_tuning *t)
{
    if (t->has_unsteady && has_rough_clock(t))
        return "The shaft turns in jerks, or the time stamps come in jerks (rows are missing, or the stamps "
               "are "
               "rounded), and its current does not tell its cogging torque then";
    if (t->has_unsteady) return "The current of a shaft that turns in jerks does not tell its cogging torque";
    if (cli_tune_all_torque_clipped(t))
        return "The torque in the logs is clipped at the end of its sensor, and what lies beyond is missing";
    if (cli_tune_is_typed(t))
        return "The torque in the log is one number in every row, typed and not measured, and tells the mean "
               "alone";
    if (t->tells_no_order)
        return "The logs cover not even one electrical turn, which tells no order: at least one whole "
               "mechanical turn is needed, better several";
    if (cli_tune_lacks_time(t))
        return "The log has an angle and a current and no time, without which nothing tells whether the "
               "shaft "
               "was turned slowly";
    if (t->needs_inertia) return "The inertia may answer what the current does not";
    if (cli_tune_is_one_way(t))
        return "The shaft turns in one direction alone, in which the current does not tell friction from "
               "cogging torque unless control turned it evenly (say --holding if it did; a turn forward and "
               "one back tell it)";
    return "The logs tell neither cogging torque nor back-EMF";
}

/* 1 g·cm², in which data sheets state it. */
#define GRAM_CM2 1e-7

static void say_inertia(cli_tuning *t)
{
    const double inertia_kgm2 = t->declared.inertia_kgm2;
    snprintf(
        t->tuning.heading, sizeof t->tuning.heading,
        "The inertia of %.4g kg·m² is not believable: by it the shaft would take %.2g times the torque that "
        "the current makes to accelerate; above %.2g kg·m² it would be more than all of that. Is it in "
        "another "
        "unit (%.4g g·cm² are %.3g kg·m²)? Nothing was solved",
        inertia_kgm2, t->inertia_share, inertia_kgm2 / t->inertia_share, inertia_kgm2,
        GRAM_CM2 * inertia_kgm2);
}

static void say_jumps(cli_tuning *t)
{
    const double degrees = t->jump_rad * 180.0 / HCI_PI;
    snprintf(
        t->tuning.heading, sizeof t->tuning.heading,
        "The angle stands and jumps by %.3g electrical degrees, as Hall sensors have it (60 where it is an "
        "electrical one, here read with %d pole pairs), which tells no order of a ripple, so nothing was "
        "solved",
        degrees, t->declared.model.pole_pairs);
}

/* Where one of angle and speed is electrical, the ratio of their ways is that of two numbers of pole pairs.
 */
static int pole_pairs_of_ratio(const cli_tuning *t)
{
    const hci_run *r = &t->runs.run[t->not_followed];
    const double ratio = t->angle_to_speed;
    if (r->is_electrical == r->speed_is_electrical) return 0;
    const double p = r->pole_pairs * (r->is_electrical ? ratio : 1.0 / ratio), whole = round(p);
    return whole >= 1.0 && whole < 1000.0 && fabs(p - whole) < 0.03 * whole ? (int)whole : 0;
}

/* "pole pairs: 7 and not 14, which are the poles?" */
static void say_pole_pairs(const cli_tuning *t, int pairs, char *words, size_t size)
{
    const int said = t->declared.model.pole_pairs;
    char remedy[64] = "in machine.csv";
    if (t->is_own) snprintf(remedy, sizeof remedy, "--pole-pairs %d", pairs);
    snprintf(words, size, "%s: %d pole pairs would fit, and not %d%s; or one of a shaft behind a gear?",
             remedy, pairs, said,
             said == 2 * pairs   ? ", which is the number of poles, two for a pair"
             : 2 * said == pairs ? ", which is half of them"
                                 : "");
}

/* A whole number of turns, or one over it, is a gear's. */
static void say_elsewhere(cli_tuning *t)
{
    const double ratio = t->angle_to_speed, gear = fmax(ratio, 1.0 / ratio);
    const int pairs = ratio > 0.0 ? pole_pairs_of_ratio(t) : 0;
    const hci_run *r = &t->runs.run[t->not_followed];
    char unit[CLI_TUNE_COLUMN_WORDS], words[CLI_TUNE_COLUMN_WORDS] = "two of them exchanged?";
    if (ratio > 1000.0)
        snprintf(words, sizeof words, "counts? --column 'theta_m=%.90s/COUNTS_OF_A_TURN', or theta_e",
                 r->angle_column[0] ? r->angle_column : "COLUMN");
    if (ratio > 0.0 && gear > 1.5 && fabs(gear - round(gear)) < 0.03 * gear && gear < 1000.0)
        snprintf(words, sizeof words, "one of a shaft behind a gear of %.0f, or an electrical one?",
                 round(gear));
    if (pairs > 0) say_pole_pairs(t, pairs, words, sizeof words);
    cli_tune_say_unit_of_ratio(t, ratio, unit);
    if (unit[0]) snprintf(words, sizeof words, "%s", unit);
    snprintf(
        t->tuning.heading, sizeof t->tuning.heading,
        "The angle does not go where the speed leads, but %.3g times as far: one of the two columns is of "
        "something else (%s), so nothing was solved",
        ratio, words);
}

static void append_of_time(cli_tuning *t)
{
    const hci_run *r = cli_tune_lacks_time(t);
    if (!r || t->has_slip) return;
    if (r->time_like[0])
        append(t,
               "No time was read: if the column `%.*s` is it, add --column '%s'; or --holding, if the shaft "
               "was turned slowly by control",
               (int)strcspn(strchr(r->time_like, '=') + 1, "/"), strchr(r->time_like, '=') + 1, r->time_like);
    else
        append(t,
               "No time was read: name its column by --column 'time_s=COLUMN' (time_ms, time_us; COLUMN/1000 "
               "of a counter of 1000 a second); or add --holding, if the shaft was turned slowly by control");
}

/* Columns that nobody named, and that may be what is missing. */
static void append_of_columns(cli_tuning *t)
{
    const char *torque = cli_tune_lacks_torque(t) ? cli_tune_torque_like(t) : NULL;
    const char *current = !t->has_slip && !torque ? cli_tune_current_like(t) : NULL;
    if (torque)
        append(t, "If the column `%s` is a torque, add --column '%s'", strchr(torque, '=') + 1, torque);
    if (current) {
        char column[HCI_RUN_NAME];
        cli_tune_column_of(current, column);
        append(t, "No current was read: if the column `%s` is i_q, add --column '%s'%s", column, current,
               strstr(current, HCI_RUN_DIGITS_PER_A)
                   ? ", with what the firmware has for 1 A, which the numbers do not tell"
                   : "");
    }
}

static void say_why_not_solved(cli_tuning *t)
{
    hci_tuning *r = &t->tuning;
    if (t->out_of_reach[0]) {
        snprintf(r->heading, sizeof r->heading, "Nothing was solved: %s", t->out_of_reach);
        return;
    }
    if (t->jump_rad > 0.0) {
        say_jumps(t);
        return;
    }
    if (t->is_not_followed && (!t->has_slip || t->slip_is_of_poles)) {
        say_elsewhere(t);
        return;
    }
    if (t->inertia_share > 0.0 && !t->has_slip && !t->has_misfit) {
        say_inertia(t);
        return;
    }
    if (!cli_tune_is_blocked(t) && !cli_tune_is_typed(t) &&
        cli_tune_say_fast(t, r->heading, sizeof r->heading))
        return;
    if (why_blocked(t) || !t->has_slip)
        snprintf(r->heading, sizeof r->heading, "%s, so nothing was solved",
                 why_blocked(t) ? why_blocked(t) : why_untold(t));
    else
        snprintf(r->heading, sizeof r->heading, "%s", t->slip);
    append_of_time(t);
    append_of_columns(t);
}

static void append_of_sheet(cli_tuning *t)
{
    char words[512];
    if (cli_tune_say_sheet(t, words, sizeof words)) append(t, "%s", words);
}

void cli_tune_set_heading(cli_tuning *t)
{
    if (t->is_solved)
        say_table(t);
    else
        say_why_not_solved(t);
    append_of_unread(t);
    append_of_two(t);
    append_of_command(t);
    append_of_drive(t);
    append_of_loop(t);
    append_of_sheet(t);
    append_of_table(t);
    append_of_torque(t);
    append_of_machine(t);
}
