#include "cli/tune/words/tune_next.h"

#include <math.h>

#include "cli/tune/tune_cover.h"
#include "cli/tune/tune_directions.h"
#include "cli/tune/tune_facts.h"
#include "cli/tune/tune_options.h"
#include "cli/tune/tune_suspect.h"

#define FURTHER_ROUND 1.05 /* turns, from which on the ends of the way are passed in both directions */
#define SLOWER        0.9  /* of the speed at which a gap would just be narrow enough */

static bool has_sensor(const cli_tuning *t)
{
    for (size_t k = 0; k < t->diagnosis.runs; ++k)
        if (t->diagnosis.run[k].source == HCI_TORQUE_MEASURED) return true;
    return false;
}

/* Recordings under load that tell the ripple on the machine, if they are explained. */
enum { ENOUGH_LOADS = 3 };

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

/* Whether a shaft was turned slowly against a load. */
static bool has_load(const cli_tuning *t)
{
    for (size_t k = 0; k < t->runs.count; ++k)
        if (t->runs.run[k].torque_source == HCI_TORQUE_HOLDING &&
            hci_run_is_loaded(&t->runs.run[k], t->runs.run[k].pole_pairs))
            return true;
    return false;
}

/* A model of currents along one direction has less to explain. */
static void say_other_directions(cli_tuning *t)
{
    char names[CLI_TUNE_PATH];
    if (t->diagnosis.verdict < HCI_DIAGNOSIS_PARTLY || !cli_tune_other_directions(t, names, sizeof names))
        return;
    hci_tuning_say(
        &t->tuning, HCI_TUNING_NEXT,
        "Without %s: the currents of the other loads have one direction in the rotor frame, and there "
        "tune may explain what it does not explain of all; its table is then along that direction.",
        names);
}

/* A saliency of the sheet that loads along q hardly tell is one effect less to look for. */
static void say_inductances(cli_tuning *t)
{
    const bool *given = t->arguments->given;
    if (!t->is_own || given[TUNE_INDUCTANCE_D] || given[TUNE_INDUCTANCE_Q] || loads_of(t) == 0 ||
        t->diagnosis.verdict < HCI_DIAGNOSIS_PARTLY)
        return;
    hci_tuning_say(&t->tuning, HCI_TUNING_NEXT,
                   "Where the sheet has them, give --inductance-d and --inductance-q: of a machine whose two "
                   "differ, the search for what is missing begins nearer to it.");
}

static void say_next_without_sensor(cli_tuning *t)
{
    hci_tuning_say(
        &t->tuning, HCI_TUNING_NEXT,
        "On the same bench: play the table and make the same slow turn forward and back. What the "
        "control adds to the i_q of the table (i_q less the i_q of the table) is what is left of the "
        "cogging torque, and the speed varies less: look at it, and give tune no log of it, for which it "
        "would be all there is; i_q as it is measured has the table in it, and looks as before. Spins at two "
        "other speeds, each in both directions, tell friction.%s%s",
        has_load(t) ? ""
                    : " Against a brake the same turn forward and back tells the harmonics of the "
                      "back-EMF too.",
        t->has_emf ? ""
                   : " The torque per ampere takes a torque sensor, or voltages of the open machine "
                     "that another one turns.");
}

/* What the bench at hand can do first. */
static void say_next_on_machine(cli_tuning *t)
{
    if (t->diagnosis.search != HCI_WORK_COMPLETE)
        hci_tuning_say(
            &t->tuning, HCI_TUNING_NEXT,
            "Before another recording: the search for effects ended before all had been compared. "
            "It gets further with --work %g, which takes up to four times as long%s, or with MACHINE "
            "--runs LIST and what is known in MACHINE/effects.csv.",
            t->diagnosis.further_work, t->runs.count > 1 ? ", with fewer logs" : "");
    else if (!has_sensor(t))
        say_next_without_sensor(t);
    else if (loads_of(t) >= ENOUGH_LOADS && t->diagnosis.verdict >= HCI_DIAGNOSIS_PARTLY)
        hci_tuning_say(
            &t->tuning, HCI_TUNING_NEXT,
            "Recordings at the same currents and speeds do not help: as long as something in these is "
            "not explained, the ripple on the machine is not known.");
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

/* How to record again; NULL: nothing of the kind. */
static const char *next_recording(const cli_tuning *t)
{
    const bool is_understood = !t->has_slip && !t->has_misfit;
    if (t->has_unsteady && is_understood)
        return "Turn the shaft evenly: a stiffer position control, or a lower speed with it; its speed "
               "is to vary by less than 30 % rms. If it did turn evenly, its time stamps do not: rows are "
               "missing, or the stamps are rounded. Or move it in steps of half a degree or less, keep "
               "the samples at rest alone, and give them a column torque_Nm of 0.";
    if (t->needs_inertia && is_understood)
        return "Give --inertia, of the rotor with what turns with it, which takes out what accelerates; "
               "or turn the shaft more slowly, a third of the speed or less, with a stiff control.";
    if (cli_tune_all_torque_clipped(t))
        return "Record again with a torque that stays within the range of sensor, amplifier and "
               "logger: set the larger range, take their zero at rest, or use a larger sensor.";
    if (cli_tune_is_typed(t) && !t->is_solved)
        return "Log what a torque sensor measures, at three currents (docs/measuring.md). Without a sensor: "
               "take the brake off, leave the column out, and turn the shaft slowly under position control, "
               "one "
               "turn forward and one back, or somewhat more, with angle and i_q.";
    if (!t->is_solved && !cli_tune_is_blocked(t) && cli_tune_lacks_time(t))
        return "Say which column the time is, or --holding if the shaft was turned slowly by control, and "
               "begin again with the same logs; --out may be the same.";
    if (!t->is_solved && !cli_tune_is_blocked(t) && !cli_tune_can_solve(t))
        return "Without a torque sensor: turn the shaft slowly under position control, one turn "
               "forward and one back, log angle and i_q, and give --holding. With one: turn it slowly "
               "without current and log angle and torque; then under load, at three currents "
               "(docs/measuring.md).";
    return NULL;
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
                       "theta_m_deg=COLUMN, speed_rpm=COLUMN and iq_A=COLUMN, in their units.");
    else if (t->inertia_share > 0.0)
        hci_tuning_say(r, HCI_TUNING_NEXT,
                       "Give --inertia in kg·m², or leave it out: turns forward and back tell whether it "
                       "matters.");
    else if (t->has_standstill)
        hci_tuning_say(r, HCI_TUNING_NEXT,
                       "Turn the shaft slowly under position control, 1.1 turns forward and back, and log "
                       "angle and i_q; if it did turn, the column that was read as the angle is not it.");
    else if (next_recording(t))
        hci_tuning_say(r, HCI_TUNING_NEXT, "%s", next_recording(t));
}

/* Of a turn in which a part has no samples: that of its ends, or another one. */
static void say_next_gap(cli_tuning *t)
{
    const double gap_deg = cli_tune_least_gap_rad(t) * 180.0 / HCI_PI,
                 widest_deg = cli_tune_widest_gap_rad(t) * 180.0 / HCI_PI;
    if (t->turns < FURTHER_ROUND)
        hci_tuning_say(&t->tuning, HCI_TUNING_NEXT,
                       "Turn somewhat further than once round each way, such as 1.1 turns, so that the place "
                       "at which the shaft "
                       "starts and turns round is passed as well.");
    else
        hci_tuning_say(&t->tuning, HCI_TUNING_NEXT,
                       "Turn more slowly, at %.1g of the speed, or log without missing rows: %.2g degrees of "
                       "the turn have no sample in either direction, and order %.5g needs them within %.2g "
                       "degrees. If the shaft jumps there, control its speed more stiffly.",
                       fmin(0.9, SLOWER * widest_deg / gap_deg), gap_deg, cli_tune_order_of_slots(t),
                       widest_deg);
}

/* Of logs that contradict themselves. */
static void say_next_correction(cli_tuning *t)
{
    hci_tuning *r = &t->tuning;
    const double order = cli_tune_order_of_slots(t);
    if (cli_tune_has_gap(t))
        say_next_gap(t);
    else if (t->has_alias)
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
            "%s), and begin again; --out may be the same.",
            !t->is_own                       ? t->machine
            : t->arguments->given[TUNE_VOLT] ? "the options of the motor: --volt-of says of what the voltage "
                                               "is, such as line-peak"
                                             : "the options of the motor");
}

void cli_tune_say_next(cli_tuning *t)
{
    if (!t->has_slip) say_next_turn(t);
    say_next_correction(t);
    if (t->has_diagnosis && !t->has_slip) say_other_directions(t);
    if (t->has_diagnosis && !t->has_slip) say_inductances(t);
    if (t->is_solved && t->solution.expected.state != HCI_RIPPLE_KNOWN) say_next_on_machine(t);
}
