#include "cli/tune/words/tune_unknown.h"

#include <math.h>
#include <stdio.h>

#include "cli/tune/tune_cover.h"
#include "cli/tune/tune_facts.h"
#include "cli/tune/tune_known.h"
#include "cli/tune/tune_read.h"

static void say_unknown_zero(cli_tuning *t)
{
    hci_tuning_say(
        &t->tuning, HCI_TUNING_UNKNOWN,
        "Where the electrical zero is: the logs have the angle of an encoder, whose zero is "
        "taken for that of the back-EMF of phase a; i_d and i_q, v_d and v_q, turned by the same angle, do "
        "not tell it. The angle of the table is that of the logs, and its header says so. The dq table takes "
        "cogging torque away whatever the zero, as long as the drive makes its phase currents by its own "
        "angle; harmonics of the back-EMF, and tables of phase currents, need the zero "
        "(docs/tutorials/zero.md).");
}

static void say_unknown_sign(cli_tuning *t)
{
    double off_deg;
    hci_tuning_say(
        &t->tuning, HCI_TUNING_UNKNOWN,
        "Whether i_q drives the shaft the way in which the angle is counted: neither friction nor an "
        "acceleration in these logs tells it. With the other sign the table doubles what it is to "
        "take away. %s",
        cli_tune_off_iq(t, &off_deg)
            ? "The phase currents do not lie along the i_q of this angle, and tell it once they do."
            : "A turn forward and one back, in one log with time and speed, tells it, where friction takes a "
              "twentieth or more of the current.");
    hci_tuning_say(
        &t->tuning, HCI_TUNING_NEXT,
        "Before the table is played: turn the shaft forward and back by the drive alone and log it.");
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

static void say_reach_of_slopes(cli_tuning *t)
{
    hci_tuning_say(
        &t->tuning, HCI_TUNING_UNKNOWN,
        "Cogging torque above the electrical order %.3g: the slope of the speed hardly shows it. Turn "
        "the shaft slowly under control, forward and back, or measure the torque.",
        cli_tune_reach_of_slopes(t));
}

static void say_off_sheet(cli_tuning *t)
{
    hci_tuning_say(&t->tuning, HCI_TUNING_UNKNOWN,
                   "Which back-EMF is right: the measured one is %.3g times that of the data sheet, and "
                   "was taken. Check Kv and what it is of, the pole pairs, and that nothing drove a "
                   "current.",
                   t->emf_to_sheet);
}

static void say_short(cli_tuning *t)
{
    hci_tuning_say(&t->tuning, HCI_TUNING_UNKNOWN,
                   "What repeats with the mechanical turn: %.2g of a turn is covered, and orders closer to "
                   "each other than one over that are not told apart. Record at least one whole turn, "
                   "better several.",
                   t->turns);
}

static void say_coarse(cli_tuning *t)
{
    hci_tuning_say(
        &t->tuning, HCI_TUNING_UNKNOWN,
        "Ripple above the electrical order %.3g: no recording has more samples in a turn (rows that "
        "repeat a torque that is held count once), so it was not looked at and no bound is "
        "told. Turn more slowly, or log the torque more often.",
        t->highest_order);
}

static void say_high_slots(cli_tuning *t)
{
    hci_tuning_say(
        &t->tuning, HCI_TUNING_UNKNOWN,
        "The cogging torque of slots and poles, order %.5g: none above order %.0f is looked at. It "
        "is small in a motor of so many slots beside its poles; what is found comes of magnets and "
        "teeth that are not alike.",
        cli_tune_order_of_slots(t), HCI_USUAL_ORDER);
}

static void say_missed_slots(cli_tuning *t)
{
    if (cli_tune_has_high_slots(t)) {
        say_high_slots(t);
        return;
    }
    if (cli_tune_has_gap(t)) {
        hci_tuning_say(&t->tuning, HCI_TUNING_UNKNOWN,
                       "The cogging torque of slots and poles, order %.5g: %.4g of a turn has samples that "
                       "are used (not those in "
                       "which the shaft starts, waits or turns round), and across what is left orders above "
                       "%.5g are not told.",
                       cli_tune_order_of_slots(t), t->turns, t->cogging_reach);
        return;
    }
    hci_tuning_say(&t->tuning, HCI_TUNING_UNKNOWN,
                   "The cogging torque of slots and poles, order %.5g: orders above %.5g were not looked "
                   "at, since the samples lie too far apart. Turn more slowly, or log more often.",
                   cli_tune_order_of_slots(t), t->cogging_reach);
}

static void say_electrical(cli_tuning *t)
{
    const double slots = t->declared.slots;
    char such[64] = "";
    if (slots > 0.0 && fmod(slots, t->declared.model.pole_pairs) != 0.0)
        snprintf(such, sizeof such, ", such as the %.0f of its slots,", slots);
    hci_tuning_say(
        &t->tuning, HCI_TUNING_UNKNOWN,
        "What comes a number of times in a mechanical turn%s that is no multiple of the %d pole pairs: "
        "the angle is an electrical one within its turn, which does not tell one pole pair from "
        "another. It is not taken away, and what of it the turns of the logs do not average out stands among "
        "the "
        "orders found. An angle of the shaft tells it.",
        such, t->declared.model.pole_pairs);
}

/* The orders and sizes that the recordings do not tell. */
static void say_limits(cli_tuning *t)
{
    const bool is_of_slopes = cli_tune_reach_of_slopes(t) > 0.0;
    if (is_of_slopes) say_reach_of_slopes(t);
    if (cli_tune_is_off_sheet(t)) say_off_sheet(t);
    if (cli_tune_is_short(t)) say_short(t);
    if (t->is_solved && cli_tune_is_electrical_alone(t)) say_electrical(t);
    if (cli_tune_is_coarse(t) && !is_of_slopes) say_coarse(t);
    if (cli_tune_misses_slots(t)) say_missed_slots(t);
}

/* Of slow turns of which nothing tells the inertia. */
static void say_inertia_limit(cli_tuning *t)
{
    const hci_run *of = cli_tune_untold_inertia(t);
    if (!t->is_solved || of == NULL) return;
    hci_tuning_say(&t->tuning, HCI_TUNING_UNKNOWN,
                   "The inertia, which %snothing in these logs tells: from %.2g kg·m² of rotor and "
                   "what turns with it on, a tenth or more of the orders found is what accelerates and no "
                   "torque of the motor.",
                   of->mean_is_unknown ? "beside a load " : "", of->inertia_limit_kgm2);
    hci_tuning_say(
        &t->tuning, HCI_TUNING_NEXT,
        !of->mean_is_unknown
            ? "Give --inertia of the rotor with what turns with it, or turn the shaft at half of the "
              "speed too, and twice as fast, where the inertia shows."
        : cli_tune_has_free_turn(t)
            ? "Give --inertia of the rotor with what turns with it: the turn without a load "
              "that is among these logs does not tell it."
            : "Give --inertia of the rotor with what turns with it, or the same slow turn without "
              "the load too, which tells it.");
}

static void say_inertia(cli_tuning *t)
{
    const hci_run *of = NULL;
    const double taken_Nm = cli_tune_taken_by_inertia_Nm(t, &of);
    if (!t->is_solved || !(taken_Nm > 0.0)) return;
    hci_tuning_say(
        &t->tuning, HCI_TUNING_UNKNOWN,
        "The inertia but for its error: %.3g ± %.1g kg·m² makes the turns of the log agree (a standard "
        "deviation of how they agree; harmonics of the back-EMF, which the sheet does not have, come on "
        "top). It "
        "took %.2g N·m rms out of the torque of the current; the ± of the orders has none of it.",
        of->turns_inertia_kgm2, of->turns_inertia_error_kgm2, taken_Nm);
    hci_tuning_say(&t->tuning, HCI_TUNING_NEXT,
                   "Give --inertia of the rotor with what turns with it, or turn the shaft at a third of the "
                   "speed: then it hardly matters.");
}

static void say_declared_inertia(cli_tuning *t)
{
    const double inertia_kgm2 = t->declared.inertia_kgm2, taken_Nm = cli_tune_hangs_on_inertia_Nm(t);
    if (cli_tune_is_scaled_by_inertia(t))
        hci_tuning_say(&t->tuning, HCI_TUNING_UNKNOWN,
                       "Whether the inertia is %.3g kg·m², as declared: a shaft that runs freely without a "
                       "current shows "
                       "inertia × acceleration alone, and where the one is off by a tenth, so are all "
                       "torques. A slow turn "
                       "forward and back with its current tells it, or a run-up with a known one.",
                       inertia_kgm2);
    else if (taken_Nm > 0.0 && !cli_tune_denied_inertia(t))
        hci_tuning_say(
            &t->tuning, HCI_TUNING_UNKNOWN,
            "Whether the inertia is %.3g kg·m², as declared: it took %.2g N·m rms out of the torque of the "
            "current, and the turns of these logs do not tell it within a factor of three. A turn at a third "
            "of "
            "the speed hardly needs it.",
            inertia_kgm2, taken_Nm);
}

/* The machine that recordings without a torque sensor or voltages leave open. */
static void say_machine(cli_tuning *t)
{
    if (t->is_solved && cli_tune_lacks_sign(t)) say_unknown_sign(t);
    say_inertia(t);
    say_inertia_limit(t);
    if (t->is_solved) say_declared_inertia(t);
    if (t->is_solved && t->is_own && !t->has_emf && !t->has_load)
        hci_tuning_say(&t->tuning, HCI_TUNING_UNKNOWN,
                       "The torque per ampere and the back-EMF are those of the data sheet; voltages of the "
                       "open machine, driven by another, would tell them.");
    if (t->is_solved && !cli_tune_knows_zero(t)) say_unknown_zero(t);
    if (cli_tune_is_uncounted(t)) say_uncounted(t);
}

/* What one recording does not tell, by the name that it was given. */
static void say_recording(cli_tuning *t, const hci_run *r, const char *name)
{
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
                       "What of the cogging torque in %s the inertia answers, and what the current.", name);
}

static void say_lag(cli_tuning *t)
{
    if (cli_tune_lacks_times(t)) {
        hci_tuning_say(&t->tuning, HCI_TUNING_UNKNOWN,
                       "Whether the torque sensor reads late: no recording with it has a column of the time, "
                       "and a delay turns the orders by an angle that the bound leaves out.");
        hci_tuning_say(&t->tuning, HCI_TUNING_NEXT,
                       "The same logs with a column of the time, one of the loads turned back or at another "
                       "speed, which tells a delay of the sensor.");
        return;
    }
    hci_tuning_say(&t->tuning, HCI_TUNING_UNKNOWN,
                   "Whether the torque sensor reads late: every recording with it has one speed and one "
                   "direction, and a delay turns the orders by an angle that the bound leaves out.");
    hci_tuning_say(&t->tuning, HCI_TUNING_NEXT,
                   "One of the loads turned back, or at another speed, which tells a delay of the sensor.");
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
    else if (cli_tune_unexplained_Nm(t) > 0.0)
        hci_tuning_say(&t->tuning, HCI_TUNING_UNKNOWN,
                       "What makes the ripple: up to %.3g N·m rms of it is in a recording, and nothing that "
                       "is certain explains it. The table takes none of it away.",
                       cli_tune_unexplained_Nm(t));
    else
        hci_tuning_say(&t->tuning, HCI_TUNING_UNKNOWN,
                       "No ripple was found: it is below what the recordings resolve, or they cannot show "
                       "it.");
}

void cli_tune_say_unknown(cli_tuning *t)
{
    say_cogging(t);
    say_limits(t);
    say_machine(t);
    for (size_t k = 0; k < t->runs.count; ++k)
        say_recording(t, &t->runs.run[k], cli_tune_name_of(t, k));
    if (cli_tune_hangs_on_lag(t)) say_lag(t);
}
