#include "cli/tune/words/tune_caveats.h"

#include <math.h>
#include <string.h>

#include "cli/tune/tune_cover.h"
#include "cli/tune/tune_facts.h"
#include "cli/tune/tune_known.h"
#include "cli/tune/tune_suspect.h"
#include "hci/host/base/number.h"
#include "hci/host/machine/init.h"

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

/* Times the figure of the sheet, or its inverse, that no magnet is off by. */
#define FAR_FROM_SHEET 1.35

/* Magnets, iron and a sensor change it alike; of a sensor all that is said is in its N·m. */
static void append_of_scale(cli_tuning *t)
{
    const double share = found_above_sheet(t), percent = 100.0 * fabs(share);
    const bool is_more = share > 0.0, is_far = fabs(log1p(share)) > log(FAR_FROM_SHEET);
    const bool is_told = is_more ? cli_tune_has_load_along_q(t) : cli_tune_load_sizes(t) >= 3;
    if (t->is_solved && !t->has_emf && fabs(share) > NEAR_SHEET && percent < 100.0)
        cli_tune_caveat(
            t,
            "The torque per ampere is %s %% %s than %s makes: %s%s, or a gain of the torque "
            "sensor "
            "(or of those of the currents), which would make mean torque and ripple as much %s than said. "
            "Voltages of the open machine tell the magnets%s",
            HCI_PERCENT(percent, 2), is_more ? "more" : "less", cli_tune_constant_option(t),
            is_far    ? "a figure of another kind (of rms or peak, of line or phase voltage: --kv-of), or of "
                        "another motor, since magnets differ by less"
            : is_more ? "stronger or colder magnets"
                      : "weaker or warmer magnets",
            is_told   ? ""
            : is_more ? ", a reluctance torque where an i_d flows"
                      : ", iron that saturates",
            is_more ? "smaller" : "larger",
            is_told   ? ""
            : is_more ? ", and a load at i_d = 0 the reluctance"
                      : ", and loads at three currents the iron, which takes more the larger they are");
}

#define A_DRAG 0.01 /* of the torque per ampere, that a gear or a belt takes */

/* Where the load is turned against the motor the drag turns its sign, and the torque per ampere does not. */
static void append_of_drag(cli_tuning *t)
{
    const double percent = 100.0 * fabs(found_above_sheet(t));
    if (t->is_solved && !t->has_emf && percent > 100.0 * A_DRAG && cli_tune_loads_drive_alone(t))
        cli_tune_caveat(
            t,
            "That no drag before the torque sensor grows with the load, as of a gear or a belt, is "
            "taken on trust, since the motor drives in all of these loads: where it makes the %s %% "
            "by which the torque per ampere is off the sheet, as much of the ripple that the table "
            "takes away stays, beside what is promised. The same loads turned back tell it",
            HCI_PERCENT(percent, 2));
}

/* Whether all that is known of the torque is a current, of which a constant of the sheet makes N·m. */
static bool is_of_current(const cli_tuning *t)
{
    bool is_any = false;
    for (size_t k = 0; k < t->runs.count; ++k) {
        if (t->runs.run[k].torque_source == HCI_TORQUE_MEASURED) return false;
        is_any = is_any || t->runs.run[k].torque_source == HCI_TORQUE_HOLDING;
    }
    return is_any && !t->has_emf;
}

static void append_of_constant(cli_tuning *t)
{
    if (t->is_solved && is_of_current(t))
        cli_tune_caveat(
            t,
            "Every torque here is a current times the %.3g N·m/A of %s: nothing in these logs tells it, "
            "and "
            "where it is ten times too large, so are they all. The currents that take the cogging torque "
            "away are the same whatever it is",
            t->reading.run.torque_constant_Nm_per_A, cli_tune_constant_option(t));
}

#define LITTLE_OF 0.3 /* of a ripple, that a delay leaves as long as it is little */

/* What the promise hangs on, in figures: a millisecond, or a tenth of one where that is much. */
static void append_of_lag(cli_tuning *t)
{
    double before_Nm, after_Nm, late_s = 1e-3;
    const double late_Nm_per_s = cli_tune_late_Nm_per_s(t);
    if (!cli_tune_hangs_on_lag(t) || !(late_Nm_per_s > 0.0)) return;
    hci_tuning_swing(&t->solution, &before_Nm, &after_Nm);
    while (late_s > 1e-6 && late_Nm_per_s * late_s > LITTLE_OF * before_Nm)
        late_s *= 0.1;
    cli_tune_caveat(
        t,
        "Each %.2g ms that the torque is late beside the angle, by its sensor, a filter or a logger "
        "of its own, leaves some %.2g N·m beside what is promised",
        1e3 * late_s, late_Nm_per_s * late_s);
}

/* Of a wave that is another one the table makes as much again. */
static void append_of_folded(cli_tuning *t)
{
    char low[CLI_TUNE_ORDER], high[CLI_TUNE_ORDER];
    if (!(t->folded_Nm > 0.0) || !t->is_solved) return;
    cli_tune_caveat(
        t,
        "Order %s, %.2g N·m, may be order %s, which slots and poles make and these samples show as "
        "it, since each turn has them at the same places: the table then leaves that and makes as "
        "much of order %s besides, up to %.2g N·m from peak to peak. More samples in a turn, or the same at "
        "another speed, tell which",
        cli_tune_order_words(t, t->folded_order, low), t->folded_Nm,
        cli_tune_order_words(t, t->folded_from, high), low, 4.0 * t->folded_Nm);
}

/* What the recordings do not tell of the torque. */
static void append_of_torque(cli_tuning *t)
{
    char order[CLI_TUNE_ORDER];
    append_of_lag(t);
    if (cli_tune_reach_of_slopes(t) > 0.0)
        cli_tune_caveat(t, "These recordings do not show cogging torque above order %.3g",
                        cli_tune_reach_of_slopes(t));
    if (cli_tune_is_short(t) && t->is_solved) {
        char turns[CLI_TUNE_COLUMN_WORDS];
        cli_tune_say_turns(t, turns);
        cli_tune_caveat(
            t, "The logs cover %.2g of a turn, and at least a whole one is needed to tell orders apart%s",
            t->turns, turns);
    }
    if (cli_tune_is_coarse(t) && t->is_solved && !(cli_tune_reach_of_slopes(t) > 0.0))
        cli_tune_caveat(t, "Orders above %.3g were not looked at, since the samples lie too far apart",
                        t->highest_order);
    append_of_folded(t);
    append_of_scale(t);
    append_of_drag(t);
    append_of_constant(t);
    if (t->mains_Hz > 0.0 && t->is_solved)
        cli_tune_caveat(t,
                        "Order %s is %.0f Hz at this one speed, as hum of the mains is: another speed tells",
                        cli_tune_order_words(t, t->mains_order, order), t->mains_Hz);
    else if (t->fast_Hz > 0.0 && t->is_solved && t->solution.expected.state != HCI_RIPPLE_KNOWN)
        cli_tune_caveat(
            t,
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
        cli_tune_caveat(
            t,
            "The declared inertia of %.3g kg·m² is not that of this shaft: by current and acceleration "
            "it is %.2g to "
            "%.3g kg·m² (as long as the torque per ampere is right), and what is wrong in it is in "
            "the orders "
            "found: begin again with the right one%s",
            inertia_kgm2, of->least_inertia_kgm2, of->most_inertia_kgm2,
            t->is_own && of->torque_source == HCI_TORQUE_HOLDING ? ", or without --inertia" : "");
    else if (cli_tune_is_scaled_by_inertia(t) && before_Nm >= t->solution.tolerance_Nm)
        cli_tune_caveat(
            t,
            "All torques are in proportion to the declared inertia of %.3g kg·m², which nothing in "
            "these logs tells",
            inertia_kgm2);
    else if (taken_Nm > MUCH_INERTIA * before_Nm)
        cli_tune_caveat(
            t,
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
        cli_tune_caveat(
            t,
            "An inertia of %.3g ± %.1g kg·m² was found in the log, and %.2g N·m rms of the ripple hang "
            "on it: "
            "--inertia gives it",
            of->turns_inertia_kgm2, of->turns_inertia_error_kgm2, taken_Nm);
}

static void append_of_untold_inertia(cli_tuning *t)
{
    const hci_run *of = cli_tune_untold_inertia(t);
    if (t->is_solved && of)
        cli_tune_caveat(
            t,
            "The inertia is not known: from %.2g kg·m² on, a tenth or more of the orders found is "
            "what accelerates, and the table leaves that: --inertia gives it",
            of->inertia_limit_kgm2);
}

static void append_of_sign(cli_tuning *t)
{
    double deg;
    if (t->is_solved && cli_tune_off_iq(t, &deg))
        cli_tune_caveat(
            t,
            "The phase currents do not lie along the i_q of this angle: where the drive keeps its i_d "
            "at 0, "
            "the electrical zero is off, and --angle-offset %.0f or %.0f is right",
            deg, remainder(deg + 180.0, 360.0));
    else if (t->is_solved && cli_tune_lacks_sign(t))
        cli_tune_caveat(t, "The sign of i_q is not told, and with the other one the ripple doubles");
}

/* Where slots are not said, any winding is one. */
static bool is_wound(const cli_tuning *t)
{
    return !(t->declared.slots >= 3.0) ||
           hci_has_equal_phases((int)t->declared.slots, t->declared.model.pole_pairs);
}

/* Orders that slots and poles do not make, and those that they do. */
static void append_of_slots(cli_tuning *t)
{
    char order[CLI_TUNE_ORDER];
    if (!is_wound(t))
        cli_tune_caveat(t,
                        "%.0f slots and %d poles are of no winding of three equal phases: one of the two "
                        "numbers is another one",
                        t->declared.slots, 2 * t->declared.model.pole_pairs);
    else if (t->stranger_order > 0.0)
        cli_tune_caveat(
            t,
            "The largest order found, %s, is none that %.0f slots and %d poles make: %.5g and its "
            "multiples",
            cli_tune_order_words(t, t->stranger_order, order), t->declared.slots,
            2 * t->declared.model.pole_pairs, cli_tune_order_of_slots(t));
    if (cli_tune_misses_slots(t) && !cli_tune_has_high_slots(t))
        cli_tune_caveat(t, "Order %.5g, which slots and poles make, was not looked at",
                        cli_tune_order_of_slots(t));
}

/* What they do not tell of the machine, and what of them was not used. */
static void append_of_machine(cli_tuning *t)
{
    char words[512];
    append_of_inertia(t);
    append_of_untold_inertia(t);
    if (t->is_solved && cli_tune_is_without_angle(t))
        cli_tune_caveat(
            t, "No log has an angle: the table begins where the back-EMF of phase a rises through zero, "
               "and cannot be played before the electrical zero of the drive is set there");
    if (t->is_solved) append_of_declared_inertia(t);
    if (cli_tune_is_uncounted(t))
        cli_tune_caveat(
            t, "That there are %d pole pairs is taken on trust, since nothing in these logs counts them",
            t->declared.model.pole_pairs);
    append_of_sign(t);
    if (t->is_solved && cli_tune_is_electrical_alone(t))
        cli_tune_caveat(
            t,
            "The angle begins again in each of the %d electrical turns: what slots and magnets make once "
            "in "
            "a turn of the shaft is not told, and what these logs do not average out stands among the orders",
            t->declared.model.pole_pairs);
    if (cli_tune_say_long(t, words, sizeof words)) cli_tune_caveat(t, "%s", words);
    if (cli_tune_is_off_sheet(t))
        cli_tune_caveat(t, "The measured back-EMF is %.3g times that of the data sheet", t->emf_to_sheet);
    if (t->left_out > 0)
        cli_tune_caveat(t, "%zu of %zu logs left out", t->left_out, t->left_out + t->kept.words);
    if (t->has_doubt && !cli_tune_is_off_sheet(t))
        cli_tune_caveat(t, "`check` does not understand all that the logs say");
    append_of_slots(t);
}

void cli_tune_untold_caveats(cli_tuning *t)
{
    append_of_torque(t);
    append_of_machine(t);
}
