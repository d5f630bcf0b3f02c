#include "cli/tune/tune_words.h"

#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <string.h>

#include "cli/terminal/say.h"
#include "cli/terminal/text.h"
#include "cli/tune/tune_cover.h"
#include "cli/tune/tune_current.h"
#include "cli/tune/tune_options.h"
#include "cli/tune/tune_size.h"
#include "cli/tune/tune_suspect.h"
#include "cli/tune/tune_waveforms.h"

/* Times the noise that a ripple may have without being looked at. */
#define NEAR_NOISE 1.5

/* Recordings under load that tell the ripple on the machine, if they are explained. */
enum { ENOUGH_LOADS = 3 };

/* ---- what is concluded ---- */

/* Of the data sheet, that a measured back-EMF may be off and not be a contradiction. */
#define OFF_SHEET 0.15

static bool is_off_sheet(const cli_tuning *t)
{
    return t->has_emf && fabs(t->emf_to_sheet - 1.0) > OFF_SHEET;
}

/* Whether slots and poles say of cogging torque where the logs were not looked at. */
static bool misses_slots(const cli_tuning *t)
{
    return t->cogging_reach > 0.0 && cli_tune_order_of_slots(t) > t->cogging_reach + HCI_ORDER_TOLERANCE;
}

/* The order up to which recordings show a torque of the angle by the slope of the speed; 0: where another one
 * shows it, or no slot is known to be beyond it. */
static double reach_of_slopes(const cli_tuning *t)
{
    double reach = 0.0;
    for (size_t k = 0; k < t->runs.count; ++k) {
        if (t->runs.run[k].torque_source == HCI_TORQUE_NONE) continue;
        if (!(t->runs.run[k].torque_reach > 0.0)) return 0.0;
        reach = fmax(reach, t->runs.run[k].torque_reach);
    }
    const double slots = cli_tune_order_of_slots(t);
    return reach < (slots > 0.0 ? slots : HCI_USUAL_ORDER) ? reach : 0.0;
}

static void say_limits(cli_tuning *t)
{
    const double reach = reach_of_slopes(t);
    if (reach > 0.0)
        hci_tuning_say(
            &t->tuning, HCI_TUNING_UNKNOWN,
            "Cogging torque above the electrical order %.3g: the slope of the speed hardly shows it. Turn "
            "the shaft slowly under control, forward and back, or measure the torque.",
            reach);
    if (is_off_sheet(t))
        hci_tuning_say(&t->tuning, HCI_TUNING_UNKNOWN,
                       "Which back-EMF is right: the measured one is %.3g times that of the data sheet, and "
                       "was taken. Check Kv and what it is of, the pole pairs, and that nothing drove a "
                       "current.",
                       t->emf_to_sheet);
    if (cli_tune_is_short(t))
        hci_tuning_say(
            &t->tuning, HCI_TUNING_UNKNOWN,
            "What repeats with the mechanical turn: %.2g of a turn is covered, and orders closer to "
            "each other than one over that are not told apart. Record at least one whole turn, "
            "better several.",
            t->turns);
    if (cli_tune_is_coarse(t) && !(reach > 0.0))
        hci_tuning_say(
            &t->tuning, HCI_TUNING_UNKNOWN,
            "Ripple above the electrical order %.3g: no recording has more samples in a turn (rows that "
            "repeat a torque that is held count once), so it was not looked at and no bound is "
            "told. Turn more slowly, or log the torque more often.",
            t->highest_order);
    if (misses_slots(t))
        hci_tuning_say(&t->tuning, HCI_TUNING_UNKNOWN,
                       "The cogging torque of slots and poles, order %.5g: orders above %.5g were not looked "
                       "at, since the samples lie too far apart. Turn more slowly, or log more often.",
                       cli_tune_order_of_slots(t), t->cogging_reach);
}

static void say_unknown_zero(cli_tuning *t)
{
    hci_tuning_say(
        &t->tuning, HCI_TUNING_UNKNOWN,
        "Where the electrical zero is: the logs have the angle of an encoder, whose zero is "
        "taken for that of the back-EMF of phase a; i_d and i_q, v_d and v_q, turned by the same angle, do "
        "not tell it. The angle of the table is that of the logs, and its header says so. The dq table "
        "answers cogging torque at the "
        "right angle of the encoder whatever the zero, as long as the drive's own angle makes "
        "the phase currents; harmonics of the back-EMF and tables of phase currents need it "
        "(docs/tutorials/zero.md).");
}

/* Whether the sign of a current is all that a torque is told by, and nothing tells it. */
static bool lacks_sign(const cli_tuning *t)
{
    bool lacks = false;
    for (size_t k = 0; k < t->runs.count; ++k) {
        const hci_run *r = &t->runs.run[k];
        if (r->torque_source == HCI_TORQUE_MEASURED || r->current_way != 0) return false;
        lacks = lacks || r->torque_source == HCI_TORQUE_HOLDING ||
                (r->torque_source == HCI_TORQUE_INERTIA && !cli_tune_has_no_current(t, r));
    }
    return lacks;
}

static void say_unknown_sign(cli_tuning *t)
{
    hci_tuning_say(
        &t->tuning, HCI_TUNING_UNKNOWN,
        "Whether i_q drives the shaft the way in which the angle is counted: neither friction nor an "
        "acceleration in these logs tells it. With the other sign the table doubles what it is to "
        "take away. A turn forward and one back, in one log with time and speed, tells it.");
    hci_tuning_say(
        &t->tuning, HCI_TUNING_NEXT,
        "Before the table is played: turn the shaft forward and back by the drive alone and log it.");
}

static bool is_uncounted(const cli_tuning *t)
{
    return t->is_solved && t->is_own && !t->counts_pole_pairs;
}

static void say_uncounted(cli_tuning *t)
{
    const int p = t->declared.model.pole_pairs;
    char half[32] = "";
    if (p % 2 == 0) snprintf(half, sizeof half, "%d, or ", p / 2);
    hci_tuning_say(&t->tuning, HCI_TUNING_UNKNOWN,
                   "Whether there are %d pole pairs, and not %s%d: nothing in these logs counts them, and a "
                   "table of the wrong number is of no use. Count the magnets, two for a pole pair; voltages "
                   "or currents of the phases beside the angle, or both angles, would tell.",
                   p, half, 2 * p);
}

static void say_unknown(cli_tuning *t)
{
    say_limits(t);
    if (t->is_solved && lacks_sign(t)) say_unknown_sign(t);
    if (t->is_solved && t->is_own && !t->has_emf && !t->has_load)
        hci_tuning_say(&t->tuning, HCI_TUNING_UNKNOWN,
                       "The torque per ampere and the back-EMF are those of the data sheet; voltages of the "
                       "open machine, driven by another, would tell them.");
    if (t->is_solved && !cli_tune_knows_zero(t)) say_unknown_zero(t);
    if (is_uncounted(t)) say_uncounted(t);
    for (size_t k = 0; k < t->runs.count; ++k) {
        const hci_run *r = &t->runs.run[k];
        const char *name = t->arguments->given[TUNE_RUNS] ? r->name : t->arguments->word[k];
        if (r->torque_is_typed)
            hci_tuning_say(&t->tuning, HCI_TUNING_UNKNOWN,
                           "The ripple in %s: its torque is one number in every row, typed and not measured.",
                           name);
        if (r->is_unsteady && !t->has_slip && !t->has_misfit)
            hci_tuning_say(&t->tuning, HCI_TUNING_UNKNOWN,
                           "What of the current in %s answers cogging torque, and what answers the shaft's "
                           "sticking and slipping.",
                           name);
        if (r->needs_inertia)
            hci_tuning_say(&t->tuning, HCI_TUNING_UNKNOWN,
                           "What of the cogging torque in %s the inertia answers, and what the current.",
                           name);
    }
}

static bool has_sensor(const cli_tuning *t)
{
    for (size_t k = 0; k < t->diagnosis.runs; ++k)
        if (t->diagnosis.run[k].source == HCI_TORQUE_MEASURED) return true;
    return false;
}

/* Recordings with a torque sensor and a current. */
static size_t loads_of(const cli_tuning *t)
{
    size_t loads = 0;
    for (size_t k = 0; k < t->runs.count; ++k) {
        const hci_run *r = &t->runs.run[k];
        bool flows = false;
        for (size_t n = 0; n < 3 * r->count && !flows; ++n)
            flows = r->i_A[n] != 0.0;
        loads += flows && r->torque_source == HCI_TORQUE_MEASURED;
    }
    return loads;
}

/* Of two mean speeds, in one direction, that tell nothing that one does not. */
#define ONE_SPEED 1.2

/* Whether all that a torque sensor has measured in time is of one speed: one that reads late turns the orders
 * by an angle that is not told then. */
static bool has_one_speed(const cli_tuning *t)
{
    double least = HUGE_VAL, most = -HUGE_VAL;
    for (size_t k = 0; k < t->runs.count; ++k) {
        const hci_run *r = &t->runs.run[k];
        double mean = 0.0;
        if (r->torque_source != HCI_TORQUE_MEASURED || !r->time_s || !r->speed_rad_per_s) continue;
        for (size_t n = 0; n < r->count; ++n)
            mean += r->speed_rad_per_s[n] / (double)r->count;
        least = fmin(least, mean);
        most = fmax(most, mean);
    }
    return least * most > 0.0 && fmax(fabs(least), fabs(most)) < ONE_SPEED * fmin(fabs(least), fabs(most));
}

/* The bound of recordings at one speed. */
static bool hangs_on_lag(const cli_tuning *t)
{
    return t->is_solved && t->solution.expected.state == HCI_RIPPLE_KNOWN && has_one_speed(t);
}

static void say_lag(cli_tuning *t)
{
    hci_tuning_say(&t->tuning, HCI_TUNING_UNKNOWN,
                   "Whether the torque sensor reads late: every recording with it has one speed and one "
                   "direction, and a delay turns the orders by an angle that the bound leaves out.");
    hci_tuning_say(&t->tuning, HCI_TUNING_NEXT,
                   "One of the loads turned back, or at another speed, which tells a delay of the sensor.");
}

/* What the bench at hand can do first. */
static void say_next_on_machine(cli_tuning *t)
{
    if (t->diagnosis.search != HCI_WORK_COMPLETE)
        hci_tuning_say(
            &t->tuning, HCI_TUNING_NEXT,
            "Nothing, as far as this tells: the search for effects ended before all had been compared. "
            "It gets further with %sMACHINE --runs LIST and what is known in MACHINE/effects.csv.",
            t->runs.count > 1 ? "fewer logs, or with " : "");
    else if (!has_sensor(t))
        hci_tuning_say(&t->tuning, HCI_TUNING_NEXT,
                       "On the same bench: the same slow turn forward and back with the table in the drive "
                       "shows what is left of the cogging torque in what the speed still varies by, and in "
                       "i_q less the i_q of the table; i_q as it is measured has the table in it, and looks "
                       "as before. Spins at two other speeds, each in both directions, tell "
                       "friction. What load "
                       "adds takes a torque sensor.");
    else if (loads_of(t) >= ENOUGH_LOADS && t->diagnosis.verdict >= HCI_DIAGNOSIS_PARTLY)
        hci_tuning_say(&t->tuning, HCI_TUNING_NEXT,
                       "Not more of the same: as long as something in these recordings is not explained, the "
                       "ripple on the machine is not known.");
    else
        hci_tuning_say(&t->tuning, HCI_TUNING_NEXT,
                       "To know the ripple on the machine: three recordings or more under load, up to the "
                       "currents of the table, with a torque sensor.");
}

/* What --column takes where a column that was not read may be the angle; NULL: none. */
static const char *angle_like(const cli_tuning *t)
{
    for (size_t k = 0; k < t->runs.count; ++k)
        if (t->runs.run[k].angle_like[0]) return t->runs.run[k].angle_like;
    return NULL;
}

static void say_next_angle(cli_tuning *t)
{
    const char *column = angle_like(t);
    if (column)
        hci_tuning_say(&t->tuning, HCI_TUNING_NEXT,
                       "If the log has the angle under a name of its own, say which column it is: --column "
                       "'%s' (an encoder's counts, over those of a turn).",
                       column);
    hci_tuning_say(&t->tuning, HCI_TUNING_NEXT,
                   "Log the angle of the rotor beside the current, that of the encoder which the drive has, "
                   "and without a torque sensor turn the shaft slowly under position control, one turn "
                   "forward and one back.");
}

/* How to record again, of logs that nothing was solved with. */
static void say_next_recording(cli_tuning *t)
{
    hci_tuning *r = &t->tuning;
    if (t->has_unsteady && !t->has_slip && !t->has_misfit)
        hci_tuning_say(
            r, HCI_TUNING_NEXT,
            "Turn the shaft evenly: a stiffer position control, or a lower speed with it; its speed "
            "is to vary by less than 30 %% rms. If it did turn evenly, its time stamps do not: rows are "
            "missing, "
            "or the stamps are rounded. Or move it in steps of half a degree or less, keep "
            "the samples at rest alone, and give them a column torque_Nm of 0.");
    else if (t->needs_inertia && !t->has_slip && !t->has_misfit)
        hci_tuning_say(
            r, HCI_TUNING_NEXT,
            "Give --inertia, of the rotor with what turns with it, which takes out what accelerates; "
            "or turn the shaft more slowly, a third of the speed or less, with a stiff control.");
    else if (cli_tune_all_torque_clipped(t))
        hci_tuning_say(r, HCI_TUNING_NEXT,
                       "Record again with a torque that stays within the range of sensor, amplifier and "
                       "logger: set the larger range, take their zero at rest, or use a larger sensor.");
    else if (cli_tune_is_typed(t) && !t->is_solved)
        hci_tuning_say(
            r, HCI_TUNING_NEXT,
            "Log what a torque sensor measures, at three currents (docs/measuring.md). Without a sensor: "
            "take the brake off, leave the column out, and turn the shaft slowly under position control, one "
            "turn forward and one back, with angle and i_q.");
    else if (!t->is_solved && !cli_tune_is_blocked(t) && !cli_tune_can_solve(t))
        hci_tuning_say(
            r, HCI_TUNING_NEXT,
            "Without a torque sensor: turn the shaft slowly under position control, one turn "
            "forward and one back, log angle and i_q, and give --holding. With one: turn it slowly "
            "without current and log angle and torque; then under load, at three currents "
            "(docs/measuring.md).");
}

/* Of logs that nothing was solved with, what would do. */
static void say_next_turn(cli_tuning *t)
{
    hci_tuning *r = &t->tuning;
    if (t->has_no_angle)
        say_next_angle(t);
    else if (t->jump_rad > 0.0)
        hci_tuning_say(
            r, HCI_TUNING_NEXT,
            "Log an angle that does not jump: of an encoder, or what the drive makes of its Hall "
            "sensors or its observer between them, and say what it is: --column theta_e_deg=COLUMN "
            "for electrical degrees. Where the shaft turns steadily, a line through the instants of "
            "the jumps is such an angle.");
    else if (t->is_not_followed)
        hci_tuning_say(r, HCI_TUNING_NEXT,
                       "Look which columns were read as angle, speed and current, and say it by --column "
                       "theta_m_rad=COLUMN, speed_rad_per_s=COLUMN and iq_A=COLUMN, in their units.");
    else if (t->inertia_share > 0.0)
        hci_tuning_say(r, HCI_TUNING_NEXT,
                       "Give --inertia in kg·m², or leave it out: turns forward and back tell whether it "
                       "matters.");
    else if (t->has_standstill)
        hci_tuning_say(r, HCI_TUNING_NEXT,
                       "Turn the shaft slowly under position control, one turn forward and one back, and log "
                       "angle and i_q; if it did turn, the column that was read as the angle is not it.");
    else
        say_next_recording(t);
}

/* Of logs that contradict themselves. */
static void say_next_correction(cli_tuning *t)
{
    hci_tuning *r = &t->tuning;
    const double order = cli_tune_order_of_slots(t);
    if (t->has_alias)
        hci_tuning_say(
            r, HCI_TUNING_NEXT,
            "Turn more slowly, or log more often: four samples or more in each period of order %.5g, "
            "%.0f in a mechanical turn.",
            order, ceil(4.0 * order * t->declared.model.pole_pairs));
    if (t->has_misfit)
        hci_tuning_say(
            r, HCI_TUNING_NEXT,
            "Look at what is not understood: pole pairs, the unit of the angle and of the speed, the order "
            "of the phases. Voltages with open terminals, beside the angle, tell most of it "
            "(docs/check.md).");
    if (t->has_slip)
        hci_tuning_say(
            r, HCI_TUNING_NEXT,
            "Correct what the first line and `slip` name (in the log, by its header or by --column, or in "
            "%s), and begin again with a new --out.",
            !t->is_own                       ? t->machine
            : t->arguments->given[TUNE_VOLT] ? "the options of the motor: --volt-of says of what the voltage "
                                               "is, such as line-peak"
                                             : "the options of the motor");
}

static void say_next(cli_tuning *t)
{
    if (!t->has_slip) say_next_turn(t);
    say_next_correction(t);
    if (t->is_solved && t->solution.expected.state != HCI_RIPPLE_KNOWN) say_next_on_machine(t);
}

/* The largest ripple that is left unexplained in a recording, rms; 0 where all are near their noise. */
static double unexplained_Nm(const cli_tuning *t)
{
    double most_Nm = 0.0;
    for (size_t k = 0; k < t->diagnosis.runs; ++k) {
        const hci_run_errors *r = &t->diagnosis.run[k];
        if (r->ripple_after_Nm > NEAR_NOISE * r->noise_floor_Nm) most_Nm = fmax(most_Nm, r->ripple_after_Nm);
    }
    return most_Nm;
}

/* Where no recording tells of it, or nothing was found of it. */
static void say_cogging(cli_tuning *t)
{
    double before_Nm = 0.0, after_Nm;
    if (!t->is_solved) return;
    hci_tuning_swing(&t->solution, &before_Nm, &after_Nm);
    if (!t->has_cogging && t->diagnosis.nothing_measured)
        hci_tuning_say(&t->tuning, HCI_TUNING_UNKNOWN,
                       "No recording tells of the cogging torque: the table takes none away.");
    else if (before_Nm >= t->solution.tolerance_Nm)
        return;
    else if (unexplained_Nm(t) > 0.0)
        hci_tuning_say(&t->tuning, HCI_TUNING_UNKNOWN,
                       "What makes the ripple: up to %.3g N·m rms of it is in a recording, and nothing that "
                       "is certain explains it. The table takes none of it away.",
                       unexplained_Nm(t));
    else
        hci_tuning_say(&t->tuning, HCI_TUNING_UNKNOWN,
                       "No ripple was found: it is below what the recordings resolve, or they cannot show "
                       "it.");
}

/* With the table, in the model: as it was read back, or of the currents where that is not known. */
static void swing_of(const cli_tuning *t, double *before_Nm, double *after_Nm)
{
    hci_tuning_swing(&t->solution, before_Nm, after_Nm);
    if (t->tuning.table_Nm > 0.0) *after_Nm = t->tuning.table_Nm;
}

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

/* To three digits, of a limit. */
static double rounded_up(double value)
{
    if (!(value > 0.0) || !isfinite(value)) return value;
    const double digit = pow(10.0, floor(log10(value)) - 2.0);
    return ceil(value / digit - 1e-9) * digit;
}

/* A bound above what a plain sine leaves promises nothing. */
static void say_bound(const hci_expected_ripple *e, double before_Nm, double after_Nm, char *text,
                      size_t size)
{
    if (e->peak_to_peak_Nm < before_Nm)
        snprintf(
            text, size,
            "A ripple of %.3g N·m from peak to peak falls to at most %.3g N·m on the machine (95 %%), of "
            "which the table %.2g",
            before_Nm, rounded_up(e->peak_to_peak_Nm), e->table_peak_to_peak_Nm);
    else
        snprintf(text, size,
                 "A ripple of %.3g N·m from peak to peak %s %.3g N·m in the model; on the machine it is at "
                 "most %.3g N·m (95 %%), so that the recordings do not promise less than without the table",
                 before_Nm, becomes(before_Nm, after_Nm), after_Nm, rounded_up(e->peak_to_peak_Nm));
}

/* The largest torque that a recording shows by a sensor, by an acceleration or by its currents. */
static double largest_recorded_Nm(const cli_tuning *t)
{
    double most_Nm = 0.0;
    for (size_t k = 0; k < t->runs.count; ++k) {
        const hci_run *r = &t->runs.run[k];
        for (size_t n = 0; n < r->count && r->torque_Nm; ++n)
            most_Nm = fmax(most_Nm, fabs(r->torque_Nm[n]));
        for (size_t n = 0; n < 3 * r->count; ++n)
            most_Nm = fmax(most_Nm, fabs(r->i_A[n]) * t->reading.run.torque_constant_Nm_per_A);
    }
    return most_Nm;
}

/* Times what was recorded and what is wanted, beyond which a ripple was not seen but made by the model. */
#define NEVER_SEEN 10.0

static bool is_never_seen(const cli_tuning *t)
{
    double before_Nm, after_Nm;
    if (!t->is_solved || t->runs.count == 0) return false;
    hci_tuning_swing(&t->solution, &before_Nm, &after_Nm);
    return before_Nm > NEVER_SEEN * (largest_recorded_Nm(t) + t->mean_Nm);
}

static void say_fall(cli_tuning *t, char *text, size_t size)
{
    const hci_expected_ripple *e = &t->solution.expected;
    double before_Nm, after_Nm;
    swing_of(t, &before_Nm, &after_Nm);
    if (is_never_seen(t))
        snprintf(
            text, size,
            "The model has a ripple of %.3g N·m, and no recording shows more torque than %.3g N·m: it is not "
            "believable, and the table is not to be used",
            before_Nm, largest_recorded_Nm(t));
    else if (hci_expected_ripple_is_doubtful(e))
        snprintf(text, size, "%s, so what the table leaves of a ripple of %.3g N·m is not to be relied on",
                 isfinite(e->unbelievable_order) ? "A back-EMF that is not believable is in the model"
                 : t->diagnosis.verdict < HCI_DIAGNOSIS_PARTLY
                     ? "The search for what makes the ripple ended before all was compared"
                     : "The model does not explain the recordings",
                 before_Nm);
    else if (e->state == HCI_RIPPLE_KNOWN)
        say_bound(e, before_Nm, after_Nm, text, size);
    else
        snprintf(text, size, "A ripple of %.3g N·m from peak to peak %s %.3g N·m in the model; %s", before_Nm,
                 becomes(before_Nm, after_Nm), after_Nm, not_known(t));
}

/* Whether no log has a torque of any kind. */
static bool lacks_torque(const cli_tuning *t)
{
    for (size_t k = 0; k < t->runs.count; ++k)
        if (t->runs.run[k].torque_source != HCI_TORQUE_NONE || t->runs.run[k].needs_inertia) return false;
    return t->runs.count > 0;
}

/* A column that was not read and may be the torque; NULL: none. */
static const char *torque_like(const cli_tuning *t)
{
    for (size_t k = 0; k < t->runs.count; ++k)
        if (t->runs.run[k].torque_like[0]) return t->runs.run[k].torque_like;
    return NULL;
}

/* What is not in the logs goes before what is. */
static void say_lack_of_torque(const cli_tuning *t, char *text, size_t size)
{
    const char *column = torque_like(t);
    if (column)
        snprintf(
            text, size,
            "No log has a torque, so the table takes no cogging torque away; if the column `%s` is one, add "
            "--column 'torque_Nm=%s'",
            column, column);
    else
        snprintf(text, size, "No log has a torque, so the table takes no cogging torque away");
}

static void set_heading(cli_tuning *t)
{
    hci_tuning *r = &t->tuning;
    double before_Nm, after_Nm;
    hci_tuning_swing(&t->solution, &before_Nm, &after_Nm);
    if (lacks_torque(t) && !t->has_cogging && t->declared.model.cogging_count == 0)
        say_lack_of_torque(t, r->heading, sizeof r->heading);
    else if (t->size == CLI_TUNE_EXCESS)
        cli_tune_say_excess(t, r->heading, sizeof r->heading);
    else if (before_Nm >= t->solution.tolerance_Nm)
        say_fall(t, r->heading, sizeof r->heading);
    else if (unexplained_Nm(t) > 0.0)
        snprintf(r->heading, sizeof r->heading,
                 "Nothing certain was found that makes a ripple, but up to %.3g N·m rms of it is in the "
                 "recordings",
                 unexplained_Nm(t));
    else
        snprintf(r->heading, sizeof r->heading, "Nothing was found that would make a ripple");
}

/* Of the wanted mean torque, that may be missing and not be spoken of. */
#define NEAR_WANTED 0.005

static bool misses_torque(const cli_tuning *t)
{
    const double much_Nm = t->mean_Nm > 0.0 ? NEAR_WANTED * t->mean_Nm : t->solution.tolerance_Nm;
    return t->is_solved && fabs(cli_tune_made_Nm(t) - t->mean_Nm) > much_Nm;
}

static double largest_recorded_A(const cli_tuning *t)
{
    double most_A = 0.0;
    for (size_t k = 0; k < t->runs.count; ++k)
        for (size_t n = 0; n < 3 * t->runs.run[k].count; ++n)
            most_A = fmax(most_A, fabs(t->runs.run[k].i_A[n]));
    return most_A;
}

/* Times the largest recorded current, beyond which a wrong unit is more likely than a load that was not
 * recorded. */
#define FAR_BEYOND 100.0

static bool is_far_beyond(const cli_tuning *t)
{
    const double most_A = largest_recorded_A(t);
    return t->is_solved && most_A > 0.0 && t->solution.peak_phase_current_A > FAR_BEYOND * most_A;
}

/* A table with which the known ripple is not smaller in the very model that it was solved for, or which takes
 * none away since none was found. */
static bool is_of_no_use(const cli_tuning *t)
{
    double before_Nm, after_Nm;
    if (!t->is_solved) return false;
    if (!hci_tuning_knows_ripple(&t->solution)) return !t->has_emf;
    swing_of(t, &before_Nm, &after_Nm);
    if (before_Nm < t->solution.tolerance_Nm) return !(t->mean_Nm > 0.0);
    return after_Nm >= before_Nm;
}

static void append(cli_tuning *t, const char *format, ...) HCI_PRINTF(2, 3);

/* One more thing that a reader of the heading alone has to know. */
static void append(cli_tuning *t, const char *format, ...)
{
    char *heading = t->tuning.heading;
    const size_t used = strlen(heading);
    va_list values;
    va_start(values, format);
    vsnprintf(heading + used, sizeof t->tuning.heading - used, format, values);
    va_end(values);
}

/* What else than the motor may be in the logs. */
static void append_of_logs(cli_tuning *t)
{
    if (t->once_a_turn_Nm > 0.0 && t->is_solved)
        append(
            t,
            "; %.3g N·m of it come once or twice a turn, and a load on the shaft makes that as well as the "
            "motor: without that load the table adds them",
            t->once_a_turn_Nm);
    if (cli_tune_clipped(t) > 0 && t->is_solved)
        append(t, "; currents in %zu of %zu logs are clipped, and what they tell is too small",
               cli_tune_clipped(t), t->runs.count);
    if (cli_tune_torque_clipped(t) > 0 && t->is_solved)
        append(t, "; the torque in %zu of %zu logs is clipped, and what lies beyond is missing",
               cli_tune_torque_clipped(t), t->runs.count);
}

/* What the size and the sign of a torque make doubtful. */
static void append_of_doubt(cli_tuning *t)
{
    if (t->has_sensor_zero && t->is_solved)
        append(t,
               "; the torque without current is %.3g N·m with the motion on average, where friction brakes: "
               "that "
               "is taken for the zero of its sensor; if its sign is the other one instead (--column "
               "torque=-COLUMN) the table doubles the ripple; one direction does not tell, a turn back does",
               t->drives_Nm);
    else if (t->drives_Nm > 0.0 && t->is_solved)
        append(t,
               "; the torque without current is %.3g N·m with the motion on average, where friction brakes: "
               "either its zero is off, or its sign is the other one (--column torque=-COLUMN) and the table "
               "doubles the ripple; one direction does not tell, a turn back does",
               t->drives_Nm);
    if (t->size == CLI_TUNE_LARGE)
        append(t,
               "; without current the torque varies by %.3g N·m, %.3g times the rated torque, and few motors "
               "have so much: is the torque in N·m, and not in N·cm or lbf·in, and is Kv right?",
               t->open_swing_Nm, t->open_swing_Nm / cli_tune_rated_Nm(t));
}

/* What the table needs of the drive, and does not do. */
static void append_of_table(cli_tuning *t)
{
    append_of_logs(t);
    if (t->is_solved && *t->solution.corrections)
        append(t, "; this once the drive's sensors, where they are those of the logs, are corrected: %s",
               t->solution.corrections);
    append_of_doubt(t);
    if (misses_torque(t))
        append(t, "; the table makes %.4g N·m on average, and not the %.4g N·m that were wanted",
               cli_tune_made_Nm(t), t->mean_Nm);
    if (is_far_beyond(t))
        append(t,
               "; its peak current, %.3g A, is %.2g times the largest recorded one, %.3g A: are the rated "
               "current and the torque in A and N·m?",
               t->solution.peak_phase_current_A, t->solution.peak_phase_current_A / largest_recorded_A(t),
               largest_recorded_A(t));
}

/* What the recordings do not tell of the torque. */
static void append_of_torque(cli_tuning *t)
{
    if (reach_of_slopes(t) > 0.0)
        append(t, "; these recordings do not show cogging torque above order %.3g", reach_of_slopes(t));
    if (cli_tune_is_short(t) && t->is_solved)
        append(t, "; the logs cover %.2g of a turn, and at least a whole one is needed to tell orders apart",
               t->turns);
    if (cli_tune_is_coarse(t) && t->is_solved && !(reach_of_slopes(t) > 0.0))
        append(t, "; orders above %.3g were not looked at, since the samples lie too far apart",
               t->highest_order);
    if (hangs_on_lag(t)) append(t, "; unless the torque sensor reads late, which one speed does not tell");
    if (t->mains_Hz > 0.0 && t->is_solved)
        append(t, "; order %.5g is %.0f Hz at this one speed, as hum of the mains is: another speed tells",
               t->mains_order, t->mains_Hz);
    else if (t->fast_Hz > 0.0 && t->is_solved && t->solution.expected.state != HCI_RIPPLE_KNOWN)
        append(t,
               "; at this one speed the ripple has %.0f Hz, of which a slower torque sensor or filter shows "
               "less, and late: a slow turn beside it tells",
               t->fast_Hz);
}

/* What they do not tell of the machine, and what of them was not used. */
static void append_of_machine(cli_tuning *t)
{
    if (is_uncounted(t))
        append(t, "; that there are %d pole pairs is taken on trust, since nothing in these logs counts them",
               t->declared.model.pole_pairs);
    if (t->is_solved && lacks_sign(t))
        append(t, "; the sign of i_q is not told, and with the other one it doubles");
    if (is_off_sheet(t))
        append(t, "; the measured back-EMF is %.3g times that of the data sheet", t->emf_to_sheet);
    if (t->left_out > 0) append(t, "; %zu of %zu logs left out", t->left_out, t->left_out + t->kept.words);
    if (t->has_doubt && !is_off_sheet(t)) append(t, "; check does not understand all that the logs say");
    if (t->stranger_order > 0.0)
        append(t,
               "; the largest order found, %.5g, is none that %.0f slots and %d poles make: %.5g and its "
               "multiples",
               t->stranger_order, t->declared.slots, 2 * t->declared.model.pole_pairs,
               cli_tune_order_of_slots(t));
    if (misses_slots(t))
        append(t, "; order %.5g, which slots and poles make, was not looked at", cli_tune_order_of_slots(t));
}

static void add_to_heading(cli_tuning *t)
{
    append_of_table(t);
    append_of_torque(t);
    append_of_machine(t);
}

static bool has_rough_clock(const cli_tuning *t)
{
    for (size_t k = 0; k < t->runs.count; ++k)
        if (t->runs.run[k].is_unsteady && t->runs.run[k].rough_clock) return true;
    return false;
}

/* Of logs that no currents were solved for. */
static const char *why_not_solved(const cli_tuning *t)
{
    return t->has_misfit
               ? "Angle, order or speed in the logs contradict each other, and no slip that is known "
                 "explains it, so nothing was solved"
           : t->has_alias
               ? "Cogging torque of a higher order would look like one of a low order, so nothing was solved"
           : t->has_standstill
               ? "The angle of the rotor does not change in the logs: the shaft stands, and one angle tells "
                 "neither cogging torque nor back-EMF, so nothing was solved"
           : t->has_no_angle
               ? "The log has no angle of the rotor, and a table over one whose zero nobody knows "
                 "cannot be played, so nothing was solved"
           : t->has_slip ? t->slip
           : t->has_unsteady && has_rough_clock(t)
               ? "The shaft turns in jerks, or the time stamps come in jerks (rows are missing, or the "
                 "stamps are "
                 "rounded), and its current does not tell its cogging torque then, so nothing was solved"
           : t->has_unsteady ? "The current of a shaft that turns in jerks does not tell its cogging torque, "
                               "so nothing was "
                               "solved"
           : cli_tune_all_torque_clipped(t) ? "The torque in the logs is clipped at the end of its sensor, "
                                              "and what lies beyond is missing, "
                                              "so nothing was solved"
           : cli_tune_is_typed(t)
               ? "The torque in the log is one number in every row, typed and not measured, and tells "
                 "the mean alone, so nothing was solved"
           : t->tells_no_order
               ? "The logs cover not even one electrical turn, which tells no order: at least one whole "
                 "mechanical turn is needed, better several, so nothing was solved"
           : t->needs_inertia ? "The inertia may answer what the current does not, so nothing was solved"
                              : "The logs tell neither cogging torque nor back-EMF, so nothing was solved";
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

/* A whole number of turns, or one over it, is a gear's. */
static void say_elsewhere(cli_tuning *t)
{
    const double ratio = t->angle_to_speed, gear = fmax(ratio, 1.0 / ratio);
    char words[96] = "two of them exchanged?";
    if (ratio > 1000.0)
        snprintf(words, sizeof words, "counts? --column theta_m=COLUMN/COUNTS_OF_A_TURN, or theta_e");
    if (ratio > 0.0 && gear > 1.5 && fabs(gear - round(gear)) < 0.03 * gear && gear < 1000.0)
        snprintf(words, sizeof words, "one of a shaft behind a gear of %.0f, or an electrical one?",
                 round(gear));
    snprintf(
        t->tuning.heading, sizeof t->tuning.heading,
        "The angle does not go where the speed leads, but %.3g times as far: one of the two columns is of "
        "something else (%s), so nothing was solved",
        ratio, words);
}

static void say_why_not_solved(cli_tuning *t)
{
    hci_tuning *r = &t->tuning;
    const char *column = lacks_torque(t) ? torque_like(t) : NULL;
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
    snprintf(r->heading, sizeof r->heading, "%s", why_not_solved(t));
    if (column)
        snprintf(r->heading + strlen(r->heading), sizeof r->heading - strlen(r->heading),
                 "; if the column `%s` is a torque, add --column 'torque_Nm=%s'", column, column);
}

static const char *verdict_of(const cli_tuning *t)
{
    return t->tuning.good                                  ? "tuned"
           : t->jump_rad > 0.0                             ? "not enough in the logs"
           : t->has_slip                                   ? "a convention is broken"
           : t->has_misfit || t->is_not_followed           ? "the conventions are not understood"
           : t->has_no_angle                               ? "not enough in the logs"
           : t->has_unsteady                               ? "the shaft sticks and slips"
           : cli_tune_all_torque_clipped(t)                ? "the torque is clipped"
           : t->has_alias                                  ? "the samples lie too far apart"
           : t->size == CLI_TUNE_EXCESS                    ? "the size is not believable"
           : t->inertia_share > 0.0                        ? "the inertia is not believable"
           : t->has_standstill                             ? "not enough in the logs"
           : !t->is_emitted                                ? "not enough in the logs"
           : t->tuning.solved                              ? "tuned, but not as wanted"
           : is_of_no_use(t) || is_never_seen(t)           ? "a table of no use"
           : t->diagnosis.verdict == HCI_DIAGNOSIS_UNKNOWN ? "tuned with what is certain"
                                                           : "tuned, with something left open";
}

static void say_errors(cli_tuning *t)
{
    if (strstr(t->tuning.part[HCI_TUNING_FOUND], "±") != NULL)
        hci_tuning_say(&t->tuning, HCI_TUNING_FOUND,
                       "± is a standard deviation of the noise alone; what the model lacks, and constants of "
                       "the sheet that are off, come on top.");
}

void cli_tune_conclude(cli_tuning *t)
{
    hci_tuning *r = &t->tuning;
    r->log = t->runs.count > 0 ? &t->runs.run[t->shown] : NULL;
    say_cogging(t);
    say_unknown(t);
    if (hangs_on_lag(t)) say_lag(t);
    say_next(t);
    say_errors(t);
    r->good = t->is_emitted && !t->diagnosed && !r->solved && !t->has_doubt && !is_of_no_use(t) &&
              !cli_tune_is_short(t) && !(t->once_a_turn_Nm > 0.0) && !is_far_beyond(t) &&
              cli_tune_clipped(t) == 0 && cli_tune_torque_clipped(t) == 0 && !is_never_seen(t) &&
              !misses_torque(t) && t->size == CLI_TUNE_USUAL && !(t->drives_Nm > 0.0) &&
              !cli_tune_is_unpromised(t) &&
              !(t->is_solved && hci_expected_ripple_is_doubtful(&t->solution.expected));
    snprintf(r->verdict, sizeof r->verdict, "%s", verdict_of(t));
    if (t->is_solved)
        set_heading(t);
    else
        say_why_not_solved(t);
    add_to_heading(t);
}

/* ---- words ---- */

static void show_part(const hci_tuning *t, hci_tuning_part part)
{
    const char *text = t->part[part];
    if (!*text) return;
    cli_say("\n%s\n", hci_tuning_part_name(part));
    while (*text) {
        char line[4096];
        const size_t length = strcspn(text, "\n");
        snprintf(line, sizeof line, "%.*s", (int)length, text);
        cli_say_paragraph(2 + (int)strspn(line, " "), line + strspn(line, " "));
        text += length + (text[length] == '\n');
    }
}

static void show_before_and_after(const cli_tuning *t)
{
    const hci_solution *s = &t->solution;
    const hci_expected_ripple *e = &s->expected;
    double before_Nm, after_Nm;
    char expected[64] = "not known";
    swing_of(t, &before_Nm, &after_Nm);
    if (e->state == HCI_RIPPLE_KNOWN)
        snprintf(expected, sizeof expected, "at most %.3g N·m (95 %%)", rounded_up(e->peak_to_peak_Nm));
    if (after_Nm < s->tolerance_Nm) after_Nm = 0.0;
    cli_say("                              plain sine   with the table   to expect on the machine\n");
    if (!hci_tuning_knows_ripple(s))
        cli_say("  ripple, peak to peak, N·m    not known        not known   %s\n", expected);
    else
        cli_say("  ripple, peak to peak, N·m   %10.3g   %14.3g   %s\n", before_Nm, after_Nm, expected);
    cli_say("  peak phase current, A       %10.4g   %14.4g   the same, if the current loop follows\n",
            s->plain_amplitude_A, s->peak_phase_current_A);
    if (isfinite(s->loss_to_plain))
        cli_say("  copper loss, to the sine    %10d   %14.4g   the same\n", 1, s->loss_to_plain);
}

/* As they can be typed: the folder by its name. */
static void show_commands(const cli_tuning *t)
{
    static const char FOLDER[] = "\"$OUT\"", OR[] = " || [";
    const char *text = t->tuning.commands;
    while (*text) {
        const size_t length = strcspn(text, "\n");
        if (strncmp(text, "hci-solve ", 10) == 0) {
            cli_say("    ");
            for (const char *at = text; at < text + length && strncmp(at, OR, sizeof OR - 1) != 0;) {
                const bool is_folder = strncmp(at, FOLDER, sizeof FOLDER - 1) == 0;
                if (is_folder)
                    cli_say("%s", t->out);
                else
                    cli_say("%c", *at);
                at += is_folder ? sizeof FOLDER - 1 : 1;
            }
            cli_say("\n");
        }
        text += length + (text[length] == '\n');
    }
}

void cli_show_tuning(const cli_tuning *t)
{
    const hci_tuning *r = &t->tuning;
    cli_say("%s%s" CLI_PLAIN ": %s\n", r->good ? CLI_GOOD : CLI_WARN, r->verdict, r->heading);
    if (t->is_solved && t->size != CLI_TUNE_EXCESS) {
        char words[1024];
        show_before_and_after(t);
        hci_expected_ripple_words(&t->solution.expected, words, sizeof words);
        cli_say("  on the real machine\n");
        cli_say_paragraph(4, words);
    }
    for (int k = 0; k < HCI_TUNING_PARTS; ++k)
        show_part(r, (hci_tuning_part)k);
    cli_say("\nThe report is %s/report.html; sh %s/commands.sh FOLDER does this again, step by step:\n",
            t->out, t->out);
    show_commands(t);
}
