#include "cli/tune/words/tune_heading.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "cli/tune/tune_cover.h"
#include "cli/tune/tune_directions.h"
#include "cli/tune/tune_facts.h"
#include "cli/tune/tune_read.h"
#include "cli/tune/tune_recorded.h"
#include "cli/tune/tune_size.h"
#include "cli/tune/tune_suspect.h"
#include "cli/tune/words/tune_caveats.h"

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

static const char *if_in_time(const cli_tuning *t)
{
    if (!cli_tune_hangs_on_lag(t)) return "";
    if (cli_tune_is_late_at_one_pace(t)) return " if the torque sensor is in time, which these logs deny";
    return cli_tune_lacks_times(t) ? " if the torque sensor is in time, which logs without a time do not tell"
                                   : " if the torque sensor is in time, which one speed does not tell";
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
            "which the table makes %.2g N·m",
            before_Nm, hci_ripple_bound_as_said(e->peak_to_peak_Nm), if_in_time(t),
            hci_ripple_bound_as_said(e->table_peak_to_peak_Nm));
    else
        snprintf(text, size,
                 "A ripple of %.3g N·m from peak to peak %s %.3g N·m in the model; on the machine it is at "
                 "most %.3g N·m (95 %%), so that the recordings do not promise less than without the table",
                 before_Nm, becomes(before_Nm, after_Nm), after_Nm,
                 hci_ripple_bound_as_said(e->peak_to_peak_Nm));
}

#define NEARLY_NONE 0.1 /* of the ripple of the recordings */

/* What is not in the model, where it is little of the ripple that was recorded. */
static bool has_the_ripple(const cli_tuning *t)
{
    const cli_tune_ripple x = cli_tune_recorded_ripple(t);
    const double left_Nm = cli_tune_unexplained_Nm(t);
    return t->diagnosis.verdict == HCI_DIAGNOSIS_PARTLY && x.run < t->runs.count &&
           CLI_TUNE_SWING_OF_RMS * left_Nm < NEARLY_NONE * x.peak_to_peak_Nm;
}

/* Of a model that has the ripple, and not the rest. */
static void say_rest_unknown(const cli_tuning *t, char *text, size_t size)
{
    char but[48] = "";
    if (cli_tune_unexplained_Nm(t) > 0.0)
        snprintf(but, sizeof but, " but for %.2g N·m rms", cli_tune_unexplained_Nm(t));
    snprintf(
        text, size,
        "The ripple of the recordings is in the model%s, and something else in them, such as their means, "
        "is not explained, so what the table leaves of the ripple has no bound and may be more than a "
        "plain sine leaves",
        but);
}

enum { CLI_TUNE_CAUSE = 400 };

/* Where means are not explained and a ripple is: a load that alone has another i_d is named before sensors
 * and friction, whose zeros are otherwise alike. */
static const char *means_cause(const cli_tuning *t, char text[CLI_TUNE_CAUSE])
{
    char names[CLI_TUNE_PATH];
    const bool is_aside = cli_tune_other_directions(t, names, sizeof names);
    snprintf(text, CLI_TUNE_CAUSE,
             "%.200s%sfriction or the zero of the torque sensor is another one from run to run",
             is_aside ? names : "",
             is_aside ? " asks by its i_d for what no effect here has, or where " : "");
    return text;
}

/* Why the table is doubtful, and what that means for what it leaves. */
static void say_why_doubtful(const cli_tuning *t, char *text, size_t size)
{
    char cause[CLI_TUNE_CAUSE];
    if (!isfinite(t->solution.expected.unbelievable_order) && !t->diagnosis.means_alone && has_the_ripple(t))
        say_rest_unknown(t, text, size);
    else if (t->diagnosis.means_alone)
        snprintf(text, size,
                 "The ripple of the recordings is explained, and the mean torque of each is not, as where "
                 "%s, so what "
                 "the table leaves of the ripple has no bound",
                 means_cause(t, cause));
    else
        snprintf(text, size,
                 "%s, so what the table leaves of the ripple is not to be relied on and may be more than a "
                 "plain sine leaves",
                 isfinite(t->solution.expected.unbelievable_order)
                     ? "A back-EMF that is not believable is in the model"
                 : t->diagnosis.verdict < HCI_DIAGNOSIS_PARTLY
                     ? "The search for what makes the ripple ended before all was compared"
                     : "The model does not explain the recordings");
}

/* Beside a model that does not explain what was recorded stands what was recorded. */
static void say_doubtful(const cli_tuning *t, double before_Nm, char *text, size_t size)
{
    const cli_tune_ripple x = cli_tune_recorded_ripple(t);
    char current[32] = "without current";
    say_why_doubtful(t, text, size);
    if (x.current_A > 0.0) snprintf(current, sizeof current, "at %.3g A", x.current_A);
    if (x.run < t->runs.count)
        snprintf(text + strlen(text), size - strlen(text),
                 "; the recording %.120s shows %.2g N·m from peak to peak %s, and a plain sine in the model "
                 "makes %.2g N·m "
                 "at %.3g A",
                 cli_tune_name_of(t, x.run), x.peak_to_peak_Nm, current, before_Nm,
                 t->solution.plain_amplitude_A);
    if (cli_tune_unexplained_Nm(t) > 0.0 && !has_the_ripple(t))
        snprintf(
            text + strlen(text), size - strlen(text),
            "; up to %.2g N·m rms of ripple in the recordings is not in the model, and the table leaves that "
            "at least",
            cli_tune_unexplained_Nm(t));
}

/* To what the orders of a model are known, as far as samples tell them; of one that may be another one it is
 * said that they are not. */
static void say_known(const cli_tuning *t, double after_Nm, char *text, size_t size)
{
    char low[CLI_TUNE_ORDER], high[CLI_TUNE_ORDER], reach[48] = "";
    text[0] = '\0';
    if (t->folded_Nm > 0.0)
        snprintf(text, size, " (if order %s is not order %s, which these samples show as it)",
                 cli_tune_order_words(t, t->folded_order, low),
                 cli_tune_order_words(t, t->folded_from, high));
    if (t->folded_Nm > 0.0 || !(t->cogging_known_Nm > after_Nm) || cli_tune_untold_inertia(t)) return;
    if (cli_tune_is_coarse(t)) snprintf(reach, sizeof reach, " up to %.3g", t->highest_order);
    snprintf(text, size, " (its orders%s are known to %.1g N·m)", reach, t->cogging_known_Nm);
}

/* What a model leaves is no better known than what it has. */
static void say_of_model(const cli_tuning *t, double before_Nm, double after_Nm, char *text, size_t size)
{
    char known[160];
    say_known(t, after_Nm, known, sizeof known);
    snprintf(text, size, "A ripple of %.3g N·m from peak to peak %s %.3g N·m%s in the model; %s", before_Nm,
             becomes(before_Nm, after_Nm), after_Nm, known, not_known(t));
}

/* The ripple is explained, and the mean torque of each recording is not. */
static void append_means(const cli_tuning *t, const hci_expected_ripple *e, char *text, size_t size)
{
    char cause[CLI_TUNE_CAUSE];
    snprintf(text + strlen(text), size - strlen(text),
             "; the mean torque of each recording is not explained, as where %s", means_cause(t, cause));
    if (e->state == HCI_RIPPLE_KNOWN && e->mean_error_Nm >= fabs(e->mean_Nm))
        snprintf(text + strlen(text), size - strlen(text), ", and that of the table is not known");
    else if (e->state == HCI_RIPPLE_KNOWN && isfinite(e->mean_error_Nm))
        snprintf(text + strlen(text), size - strlen(text), ", and that of the table may be %.2g N·m off",
                 hci_ripple_bound_as_said(e->mean_error_Nm));
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
        say_of_model(t, before_Nm, after_Nm, text, size);
    if (e->origin.left_means_Nm > 0.0) append_means(t, e, text, size);
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
    if (t->has_alias && !t->has_slip)
        return "Cogging torque of a higher order would look like one of a low order";
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
        return "The shaft turns in jerks, or the time stamps come in jerks (rows are missing, the stamps are "
               "rounded, or several logs are one file), and its current does not tell its cogging torque "
               "then";
    if (t->has_unsteady)
        return "The current of a shaft that turns in jerks does not tell its cogging torque (where it turns "
               "evenly the counts of a turn, the number of pole pairs, or several logs in one file make it "
               "look so)";
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
    if (cli_tune_lacks_torque(t) && !cli_tune_torque_like(t) && cli_tune_force_like(t))
        return "The logs have no torque; a force is one times the lever on which it was measured";
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
    cli_tune_column_caveats(t);
}

void cli_tune_set_heading(cli_tuning *t)
{
    if (t->is_solved)
        say_table(t);
    else
        say_why_not_solved(t);
    cli_tune_log_caveats(t);
    cli_tune_table_caveats(t);
    cli_tune_untold_caveats(t);
}
