#include "cli/tune/tune_show.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "cli/terminal/say.h"
#include "cli/terminal/text.h"
#include "cli/tune/tune_facts.h"

static void show_part(const hci_tuning *t, hci_tuning_part part)
{
    const char *text = t->part[part];
    if (!*text) return;
    cli_say("\n%s\n", hci_tuning_part_name(part));
    while (*text) {
        char line[4096];
        const size_t length = strcspn(text, "\n");
        snprintf(line, sizeof line, "%.*s", (int)length, text);
        if (strncmp(line, "  hci-solve ", 12) == 0)
            cli_say("  %s\n", line); /* to be copied as one line */
        else
            cli_say_paragraph(2 + (int)strspn(line, " "), line + strspn(line, " "));
        text += length + (text[length] == '\n');
    }
}

#define OTHER_MEAN 0.005 /* of the mean torque, that a plain sine is off by and that is shown */

/* The plain sine is that of the back-EMF alone: reluctance and saturation make its torque another one. */
static void show_means(const cli_tuning *t)
{
    const hci_solution *s = &t->solution;
    if (s->order_count == 0 || s->order[0].torque_Nm.order > HCI_ORDER_TOLERANCE) return;
    const double before_Nm = s->order[0].before_Nm.cosine, after_Nm = s->order[0].torque_Nm.cosine;
    if (fabs(before_Nm - after_Nm) > OTHER_MEAN * fabs(after_Nm))
        cli_say("  mean torque in the model, N·m%8.4g   %14.4g\n", before_Nm, after_Nm);
}

static void show_before_and_after(const cli_tuning *t)
{
    const hci_solution *s = &t->solution;
    const hci_expected_ripple *e = &s->expected;
    double before_Nm, after_Nm;
    char expected[96] = "not known";
    cli_tune_swing_of(t, &before_Nm, &after_Nm);
    if (e->state == HCI_RIPPLE_KNOWN && !cli_tune_is_boundless(t))
        snprintf(expected, sizeof expected, "at most %.3g N·m (95 %%)%s",
                 hci_ripple_bound_as_said(e->peak_to_peak_Nm),
                 e->if_in_time ? " if the torque sensor is in time" : "");
    if (after_Nm < s->tolerance_Nm) after_Nm = 0.0;
    cli_say("                              plain sine   with the table   to expect on the machine\n");
    if (!hci_tuning_knows_ripple(s))
        cli_say("  ripple, peak to peak, N·m    not known        not known   %s\n", expected);
    else
        cli_say("  %s   %10.3g   %14.3g   %s\n",
                hci_expected_ripple_is_doubtful(e) || e->state != HCI_RIPPLE_KNOWN
                    ? "ripple in the model, N·m "
                    : "ripple, peak to peak, N·m",
                before_Nm, after_Nm, expected);
    cli_say("  peak phase current, A       %10.4g   %14.4g   the same, if the current loop follows\n",
            s->plain_amplitude_A, s->peak_phase_current_A);
    if (isfinite(s->loss_to_plain))
        cli_say("  copper loss, to the sine    %10d   %14.4g   the same\n", 1, s->loss_to_plain);
    show_means(t);
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

static void show_heading(const hci_tuning *t)
{
    const char *text = t->part[HCI_TUNING_CAVEATS];
    cli_say("%s%s" CLI_PLAIN ": %s\n", t->good ? CLI_GOOD : CLI_WARN, t->verdict, t->heading);
    while (*text) {
        const size_t length = strcspn(text, "\n");
        cli_say("  %s %.*s\n", *text == ' ' ? "  " : "-", (int)length, text);
        text += length + (text[length] == '\n');
    }
}

void cli_show_tuning(const cli_tuning *t)
{
    const hci_tuning *r = &t->tuning;
    show_heading(r);
    if (t->is_solved && t->size != CLI_TUNE_EXCESS) {
        char words[1024];
        show_before_and_after(t);
        hci_expected_ripple_words(&t->solution.expected, words, sizeof words);
        if (cli_tune_is_boundless(t))
            snprintf(words, sizeof words,
                     "Ripple not known: the recordings bound it by no less than the torque itself.");
        cli_say("  on the real machine\n");
        cli_say_paragraph(4, words);
    }
    for (int k = HCI_TUNING_READ; k < HCI_TUNING_PARTS; ++k)
        show_part(r, (hci_tuning_part)k);
    if (t->is_solved && !t->is_emitted)
        cli_say("\n%s/currents is what the model would have, to look at: it is no table to play.\n", t->out);
    cli_say("\nThe report is %s/report.html; sh %s/commands.sh FOLDER does this again, step by step:\n",
            t->out, t->out);
    show_commands(t);
}
