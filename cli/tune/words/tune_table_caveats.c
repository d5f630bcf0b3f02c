#include "cli/tune/words/tune_caveats.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "cli/tune/tune_commands.h"
#include "cli/tune/tune_facts.h"
#include "cli/tune/tune_known.h"
#include "cli/tune/tune_sheet.h"
#include "cli/tune/tune_size.h"
#include "cli/tune/tune_suspect.h"
#include "hci/host/base/number.h"
#include "hci/host/waveform/turning_load.h"

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
    cli_tune_caveat(
        t,
        is_taken ? "Order 1, %.2g N·m, is cogging torque, or zeros of the current sensors that are off by "
                   "up to %.2g A and no torque of the motor, which these logs do not tell apart: the table "
                   "takes it away for sensors as they were, and adds it where they are nulled or corrected"
                 : "Order 1, %.2g N·m, is taken for zeros of the current sensors, %.2g A, and may be "
                   "cogging torque, which these logs do not tell apart: the table leaves it then",
        zero_Nm, zero_A);
}

/* What else than the motor may be in the logs. */
static void append_of_logs(cli_tuning *t)
{
    if (t->once_a_turn_Nm > 0.0 && t->is_solved)
        cli_tune_caveat(t,
                        "%.3g N·m of the ripple come once or twice a turn, and a load on the shaft makes "
                        "that as well as the motor, as a weight that is out of balance does: take the load "
                        "off and record again, since the "
                        "table adds that ripple where the load is not there",
                        t->once_a_turn_Nm);
    if (cli_tune_clipped(t) > 0 && t->is_solved)
        cli_tune_caveat(t, "Currents in %zu of %zu logs are clipped, and what they tell is too small",
                        cli_tune_clipped(t), t->runs.count);
    if (cli_tune_torque_clipped(t) > 0 && t->is_solved)
        cli_tune_caveat(t, "The torque in %zu of %zu logs is clipped, and what lies beyond is missing",
                        cli_tune_torque_clipped(t), t->runs.count);
}

/* Of the gains, that are no matter. */
#define LEAST_GAIN 0.002

/* What readings of the phases are divided by: of two of them or all. */
static bool are_gains(const hci_effect *e)
{
    for (size_t j = 0; j < e->count && e->type->correction; ++j)
        if (e->type->correction[e->term[j].parameter] != HCI_CORRECT_CURRENT_GAIN) return false;
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

static bool is_offset(const hci_effect *e)
{
    return e->type->sum_by_value && strcmp(e->type->parameter[0].unit, "A") == 0;
}

/* Torque of order 1 that the offsets of the phases make, N·m, peak. */
static double offsets_Nm(const cli_tuning *t)
{
    const hci_effects *list = &t->diagnosis.effects.list;
    double offset_A[3] = {0.0, 0.0, 0.0};
    for (size_t k = 0; k < list->count; ++k)
        for (size_t j = 0; is_offset(&list->effect[k]) && j < list->effect[k].count; ++j)
            offset_A[list->effect[k].term[j].parameter] += list->effect[k].term[j].value;
    const hci_alpha_beta i = hci_clarke(offset_A);
    return hypot(i.alpha, i.beta) * t->reading.run.torque_constant_Nm_per_A;
}

/* What else makes another torque per ampere under load, and what tells it, as far as the logs do not: a
 * reluctance makes none without an i_d, and iron would make less the larger the current is. "": nothing. */
static void say_of_load(const cli_tuning *t, bool is_less, char effect[64], const char **told_by)
{
    const bool is_told = is_less ? cli_tune_load_sizes(t) >= 3 : cli_tune_has_load_along_q(t);
    snprintf(effect, 64, "%s",
             is_told   ? ""
             : is_less ? ", or iron that saturates"
                       : ", or a reluctance torque where an i_d flows");
    *told_by = is_told   ? ""
               : is_less ? "loads at three currents tell the iron, which takes more the larger they are"
                         : "a load at i_d = 0 tells the reluctance";
}

/* Torque is back-EMF times current: a sensor of the torque does not tell a share of the one from one of the
 * other, nor from one of its own or of the iron. */
static void append_of_common_gain(cli_tuning *t, double gain, double other)
{
    const bool is_less = other < 0.0;
    const char *told_by;
    char effect[64];
    say_of_load(t, is_less, effect, &told_by);
    if (t->has_emf)
        cli_tune_caveat(
            t,
            "%s %% are common to the gains of all three currents, and may be the torque sensor's "
            "instead, which "
            "reads %s %% too %s then, or magnets that are %s under load than beside the voltages%s: "
            "the back-EMF is from voltages of these logs, and nothing in them "
            "tells these apart%s%s",
            HCI_PERCENT(100.0 * fabs(gain), 2), HCI_PERCENT(100.0 * fabs(other), 2),
            is_less ? "little" : "much", is_less ? "warmer" : "colder", effect, *told_by ? "; " : "",
            told_by);
    else
        cli_tune_caveat(
            t,
            "%s %% are common to the gains of all three currents, and may be the back-EMF's instead, which "
            "is %s %% %s then, or the torque sensor's%s: a torque sensor does not tell these apart; "
            "voltages of the open machine tell the back-EMF%s%s",
            HCI_PERCENT(100.0 * fabs(gain), 2), HCI_PERCENT(100.0 * fabs(other), 2),
            is_less ? "smaller" : "larger", effect, *told_by ? ", and " : "", told_by);
}

static void append_of_gain(cli_tuning *t)
{
    const double gain = common_gain(t);
    if (fabs(gain) > 0.0) append_of_common_gain(t, gain, -gain / (1.0 + gain));
    if (offsets_Nm(t) > 0.0)
        cli_tune_caveat(
            t,
            "The offsets of the currents are those of the logs: a drive that nulls its sensors at each start "
            "has others (these make %.2g N·m once an electrical turn, whatever the load)",
            offsets_Nm(t));
}

/* Nothing is read before it is true. */
static void append_of_early(cli_tuning *t)
{
    const double early = cli_tune_early_s(t);
    if (early > 0.0)
        cli_tune_caveat(
            t,
            "The angle seems to be read %.2g s before it is true, as no sensor does: most likely the "
            "torque sensor is late by as much%s, and nothing is corrected for it; where the drive looks "
            "ahead, or "
            "reads its currents late, add to the angle the speed times -%.5g s, and logs at other speeds "
            "and loads tell which it is",
            early,
            cli_tune_is_late_at_one_pace(t) ? " or more and reads the ripple too small, by how much one "
                                              "speed does not tell, so that no bound holds"
                                            : "",
            early);
}

/* What the direction of the currents tells where a drive wants no i_d. */
static void append_of_drive_zero(cli_tuning *t)
{
    if (!t->is_solved) return;
    if (t->took_drive_zero)
        cli_tune_caveat(
            t,
            "The electrical zero of the logs was found, --angle-offset %s: there the phase currents lie "
            "along "
            "i_q, as where a drive keeps its i_d at 0, and the torques alone tell it within %.0f degrees",
            cli_tune_offset(t), t->drive_zero_reach_deg);
    else if (fabs(t->drive_zero_deg) > 0.0)
        cli_tune_caveat(
            t,
            "The phase currents lie %.1f degrees beside the i_q of this angle: with an i_d that the drive "
            "asks "
            "for, as for a salient rotor, nothing is off; where it keeps its i_d at 0 the electrical zero "
            "is, "
            "and --angle-offset %.1f is right; the torques alone, within %.0f degrees, do not tell it",
            fabs(t->drive_zero_deg), cli_tune_offset_to_give(t, t->drive_zero_deg), t->drive_zero_reach_deg);
}

/* Whether a back-EMF that is turned is said behind a zero by the currents, of which it is a second witness.
 */
static bool is_of_drive_zero(const cli_tuning *t)
{
    return t->is_solved && fabs(t->open_turn_deg) > 0.0 && fabs(t->drive_zero_deg) > 0.0 &&
           !t->took_drive_zero && !cli_tune_has_zero_of_voltages(t);
}

/* What the drive has to add to an angle that it counts as the logs do. */
static void append_of_offset(cli_tuning *t)
{
    const char *offset = cli_tune_offset(t);
    if (t->is_solved && t->size != CLI_TUNE_EXCESS && offset && !t->took_drive_zero)
        cli_tune_caveat(
            t,
            "The table is over the angle of the logs with --angle-offset %s: where the drive counts "
            "its angle as they do, add %s electrical degrees to it",
            offset, offset);
}

static void append_of_zero(cli_tuning *t)
{
    append_of_drive_zero(t);
    append_of_offset(t);
    if (is_of_drive_zero(t))
        cli_tune_caveat(
            t,
            "That is the same angle once more and no second correction: the back-EMF is found turned "
            "by %.1f ± %.1f degrees (of the noise alone)%s, which a saliency with its saturation "
            "may do as well as a part of that zero: %s",
            t->open_turn_deg, t->open_turn_error_deg, t->turn_is_of_dq ? " against i_d and i_q" : "",
            cli_tune_turn_told_by(t));
    else if (fabs(t->open_turn_deg) > 0.0 && t->is_solved)
        cli_tune_caveat(
            t,
            cli_tune_has_zero_of_voltages(t)
                ? "Under load the back-EMF is found turned by %.1f ± %.1f degrees%s from where its voltages "
                  "are, which stands for a saliency with its saturation: %s"
                : "The back-EMF is found turned by %.1f ± %.1f degrees%s, which a saliency with its "
                  "saturation may do as well as another zero: %s",
            t->open_turn_deg, t->open_turn_error_deg, t->turn_is_of_dq ? " against i_d and i_q" : "",
            cli_tune_turn_told_by(t));
    if (fabs(t->turned_deg) > 0.0 && t->is_solved)
        cli_tune_caveat(
            t,
            "The electrical zero of the logs is %.1f ± %.1f degrees off by the torques, unless the machine "
            "has a saliency that nobody declared: begin again with --angle-offset %.1f",
            fabs(t->turned_deg), t->turned_error_deg, cli_tune_offset_to_give(t, t->turned_deg));
}

/* What keeps the currents from being as wanted: a limit that binds, or the order that is off most. */
static void append_of_miss(cli_tuning *t)
{
    const hci_solution *s = &t->solution;
    if (!cli_tune_is_missed(t) || t->size == CLI_TUNE_EXCESS) return;
    for (size_t k = 0; k < s->limit_count; ++k)
        if (s->limit[k].binds) {
            cli_tune_caveat(t, "The torque is not as wanted, since the currents keep a limit, %s %.4g A",
                            hci_limit_kind_name(s->limit[k].kind), s->limit[k].limit);
            return;
        }
    cli_tune_caveat(
        t, "The torque is not as wanted: order %.4g is off by %.2g N·m, and more than %.2g N·m counts",
        s->worst_order, s->worst_error_Nm, fmax(s->tolerance_Nm, 0.5 * t->cut_Nm));
}

/* A limit that currents found angle by angle do not keep. */
static void append_of_excess(cli_tuning *t)
{
    const hci_solution *s = &t->solution;
    for (size_t k = 0; k < s->limit_count && !s->within_limits; ++k) {
        const hci_limit *l = &s->limit[k];
        if (!(l->value > l->limit)) continue;
        cli_tune_caveat(t,
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
    if (words[0]) cli_tune_caveat(t, "The figures are of currents that flow as in the table: %s", words);
}

/* What the size and the sign of a torque make doubtful. */
static void append_of_doubt(cli_tuning *t)
{
    if (t->has_sensor_zero && t->is_solved)
        cli_tune_caveat(
            t,
            "The torque without current is %.3g N·m with the motion on average, where friction brakes: "
            "that "
            "is taken for the zero of its sensor; if its sign is the other one instead (--column "
            "torque=-COLUMN) the table doubles the ripple; one direction does not tell, a turn back does",
            t->drives_Nm);
    else if (t->drives_Nm > 0.0 && t->is_solved)
        cli_tune_caveat(
            t,
            "The torque without current is %.3g N·m with the motion on average, where friction brakes: "
            "either its zero is off, or its sign is the other one (--column torque=-COLUMN) and the table "
            "doubles the ripple; one direction does not tell, a turn back does",
            t->drives_Nm);
    if (t->size == CLI_TUNE_LARGE)
        cli_tune_caveat(
            t,
            "Without current the torque varies by %.3g N·m, %.3g times the rated torque, and few motors "
            "have so much: is the torque in N·m, and not in N·cm or lbf·in, and is Kv right?",
            t->open_swing_Nm, t->open_swing_Nm / cli_tune_rated_Nm(t));
}

static void append_of_sheet(cli_tuning *t)
{
    char words[512];
    if (!t->slip_is_of_sheet && cli_tune_say_sheet(t, words, sizeof words)) cli_tune_caveat(t, "%s", words);
}

/* Ratings and constants that do not fit what is in the logs. */
static void append_of_ratings(cli_tuning *t)
{
    if (cli_tune_is_far_beyond(t))
        cli_tune_caveat(
            t,
            "The peak current of the table, %.3g A, is %.3g times the largest recorded one, %.3g A: are "
            "the rated "
            "current and the torque in A and N·m?",
            t->solution.peak_phase_current_A,
            t->solution.peak_phase_current_A / cli_tune_largest_recorded_A(t),
            cli_tune_largest_recorded_A(t));
    if (cli_tune_strange_rpm(t) > 0.0)
        cli_tune_caveat(
            t,
            "What the resistance takes at the rated current would turn this motor at %.2g rpm: are %s, "
            "--resistance and --rated-current of this motor and in their units?",
            cli_tune_strange_rpm(t), cli_tune_constant_option(t));
    if (cli_tune_is_below_idle(t))
        cli_tune_caveat(
            t,
            "By this Kv %.3g N·m take %.3g A, and the shaft without a load took up to %.3g A: is %s the "
            "right number in its unit, and the torque in N·m?",
            t->mean_Nm, t->solution.plain_amplitude_A, cli_tune_largest_recorded_A(t),
            cli_tune_constant_option(t));
}

/* What a drive would correct, in the model and not told from something else; NULL: nothing. */
static const char *open_correction(const cli_tuning *t)
{
    for (size_t k = 0; k < t->diagnosis.findings; ++k) {
        const hci_finding *f = &t->diagnosis.finding[k];
        const hci_effect_type *type = hci_effect_type_find(f->effect);
        if (f->verdict != HCI_FINDING_AMBIGUOUS || !type || !type->correction) continue;
        for (size_t j = 0; j < t->found.list.count; ++j)
            if (t->found.list.effect[j].type == type) return hci_finding_title(f->effect);
    }
    return NULL;
}

/* Set in below the sentence before. */
static void say_corrections(cli_tuning *t)
{
    for (const char *line = t->solution.corrections; *line != '\0';) {
        const size_t length = strcspn(line, "\n");
        hci_tuning_say(&t->tuning, HCI_TUNING_CAVEATS, "  %.*s", (int)length, line);
        line += length + (line[length] == '\n');
    }
}

static void append_of_corrections(cli_tuning *t)
{
    const char *open = open_correction(t);
    if (cli_tune_is_calculated(t))
        cli_tune_caveat(t, "The table is over what the model makes of the angle and the currents of the "
                           "calculation, in the order "
                           "of these lines; a drive whose zero of the angle is that of the calculation does "
                           "the same before:");
    else if (open)
        cli_tune_caveat(
            t,
            "The table hangs on what was found of the sensors, of which %s cannot be told from other "
            "effects. Where the sensors of the drive are those of the logs and read so, correct before, in "
            "the "
            "order of these lines (where they read right, another torque is made):",
            open);
    else
        cli_tune_caveat(
            t,
            "The sensors of the drive, where they are those of the logs, have to be corrected before, in the "
            "order of these lines:");
    say_corrections(t);
    append_of_gain(t);
}

/* What the table needs of the drive, and does not do. */
static void append_of_table(cli_tuning *t)
{
    append_of_logs(t);
    append_of_zeros(t);
    if (t->is_solved && *t->solution.corrections) append_of_corrections(t);
    if (t->is_solved) append_of_early(t);
    append_of_doubt(t);
    append_of_miss(t);
    if (t->is_solved && t->size != CLI_TUNE_EXCESS) append_of_excess(t);
    if (cli_tune_misses_torque(t))
        cli_tune_caveat(t, "The table makes %.4g N·m on average, and not the %.4g N·m that were wanted",
                        cli_tune_made_Nm(t), t->mean_Nm);
    append_of_ratings(t);
}

void cli_tune_table_caveats(cli_tuning *t)
{
    append_of_zero(t);
    append_of_sheet(t);
    append_of_loop(t);
    append_of_table(t);
}
