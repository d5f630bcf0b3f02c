#include "cli/tune/tune_words.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "cli/terminal/say.h"
#include "cli/terminal/text.h"

/* ---- what is concluded ---- */

static void say_missing(cli_tuning *t)
{
    if (!t->is_solved && !t->has_slip && !cli_tune_can_solve(t))
        hci_tuning_say(&t->tuning, HCI_TUNING_NEXT,
                       "Without a torque sensor: turn the shaft slowly under position control, one turn "
                       "forward and one back, log "
                       "angle and i_q, and give --holding. With one: turn it slowly without current and log "
                       "angle and torque; "
                       "then under load, at three currents (docs/measuring.md).");
    if (t->has_slip)
        hci_tuning_say(&t->tuning, HCI_TUNING_NEXT,
                       "Correct what `slip` names (in %s, or in the log), and begin again with a new --out.",
                       t->machine);
    if (t->is_solved && t->solution.expected.state != HCI_RIPPLE_KNOWN)
        hci_tuning_say(&t->tuning, HCI_TUNING_NEXT,
                       "To know the ripple on the machine: three recordings or more under load, up to the "
                       "currents of the table, "
                       "with a torque sensor.");
    if (t->is_own && !t->has_emf && !t->has_load)
        hci_tuning_say(&t->tuning, HCI_TUNING_UNKNOWN,
                       "The torque per ampere and the back-EMF are those of the data sheet; voltages of the "
                       "open machine, driven by "
                       "another, would tell them.");
}

/* Where no recording tells of it. */
static void say_cogging(cli_tuning *t)
{
    double before_Nm = 0.0, after_Nm;
    if (!t->is_solved) return;
    hci_tuning_swing(&t->solution, &before_Nm, &after_Nm);
    if (!t->has_cogging && t->diagnosis.nothing_measured)
        hci_tuning_say(&t->tuning, HCI_TUNING_UNKNOWN,
                       "No recording tells of the cogging torque: the table takes none away.");
    else if (before_Nm < t->solution.tolerance_Nm)
        hci_tuning_say(
            &t->tuning, HCI_TUNING_UNKNOWN,
            "No ripple was found: it is below what the recordings resolve, or they cannot show it.");
}

static void set_heading(hci_tuning *t, const hci_solution *s)
{
    double before_Nm, after_Nm;
    hci_tuning_swing(s, &before_Nm, &after_Nm);
    if (after_Nm < 1e-3 * before_Nm)
        snprintf(t->heading, sizeof t->heading,
                 "A ripple of %.3g N·m from peak to peak falls to less than a thousandth, in the model",
                 before_Nm);
    else if (before_Nm > 0.0)
        snprintf(t->heading, sizeof t->heading,
                 "A ripple of %.3g N·m from peak to peak falls to %.3g N·m, in the model", before_Nm,
                 after_Nm);
    else
        snprintf(t->heading, sizeof t->heading, "Nothing was found that would make a ripple");
}

void cli_tune_conclude(cli_tuning *t)
{
    hci_tuning *r = &t->tuning;
    say_cogging(t);
    say_missing(t);
    r->good = t->is_emitted && !t->diagnosed && !r->solved;
    snprintf(r->verdict, sizeof r->verdict, "%s",
             r->good                                         ? "tuned"
             : t->has_slip                                   ? "a convention is broken"
             : !t->is_emitted                                ? "not enough in the logs"
             : r->solved                                     ? "tuned, but not as wanted"
             : t->diagnosis.verdict == HCI_DIAGNOSIS_UNKNOWN ? "tuned with what is certain"
                                                             : "tuned, with something left open");
    if (t->is_solved)
        set_heading(r, &t->solution);
    else if (t->has_slip)
        snprintf(r->heading, sizeof r->heading,
                 "What the files say contradicts itself, so nothing was solved");
    else
        snprintf(r->heading, sizeof r->heading,
                 "The logs tell neither cogging torque nor back-EMF, so nothing was solved");
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

static void show_before_and_after(const hci_solution *s)
{
    const hci_expected_ripple *e = &s->expected;
    double before_Nm, after_Nm;
    char expected[64] = "not known";
    hci_tuning_swing(s, &before_Nm, &after_Nm);
    if (e->state == HCI_RIPPLE_KNOWN)
        snprintf(expected, sizeof expected, "at most %.3g N·m (95 %%)", e->peak_to_peak_Nm);
    if (after_Nm < s->tolerance_Nm) after_Nm = 0.0;
    cli_say("                              plain sine   with the table   to expect on the machine\n");
    cli_say("  ripple, peak to peak, N·m   %10.3g   %14.3g   %s\n", before_Nm, after_Nm, expected);
    cli_say("  peak phase current, A       %10.4g   %14.4g   the same, if the current loop follows\n",
            s->plain_amplitude_A, s->peak_phase_current_A);
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
    if (t->is_solved) {
        char words[1024];
        show_before_and_after(&t->solution);
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
