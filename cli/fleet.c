#include <stdio.h>
#include <string.h>

#include "cli/command/command.h"
#include "cli/command/parse.h"
#include "cli/command/same_file.h"
#include "cli/commands.h"
#include "cli/terminal/say.h"
#include "cli/terminal/terminal.h"
#include "cli/terminal/text.h"
#include "hci/host/base/number.h"
#include "hci/host/report/fleet/write.h"
#include "hci/host/report/summary.h"

enum { ALARMS, OUT, CLI_COMMON_KEYS };

enum { MOST_SAID = 20 };

static const cli_option OPTIONS[] = {
    [ALARMS] = {"false-alarms", 0, CLI_NUMBER, "PERCENT",
                .help = "of sound motors that may stand out by chance [0.2]", .low = 1e-6, .high = 50.0},
    [OUT] = {"out", 'o', CLI_FOLDER, "FOLDER", .help = "where the results go; without it nothing is written"},
    CLI_COMMON_OPTIONS};

static void show_odd(const hci_line *l)
{
    size_t said = 0;
    for (size_t k = 0; k < l->motors && said < MOST_SAID; ++k) {
        const hci_line_motor *m = &l->motor[k];
        if (!m->stands_out) continue;
        const hci_fleet_parameter *p = &l->parameter[m->worst].name;
        cli_say("  %-12s %s %s: %+.3g%s%s, %+.1f standard deviations%s\n", m->name, p->effect, p->parameter,
                l->value[k * l->parameters + m->worst], strcmp(p->unit, "1") == 0 ? "" : " ",
                strcmp(p->unit, "1") == 0 ? "" : p->unit, m->deviation,
                m->worst + 1 == l->parameters ? "; none of the parameters describes it: diagnose it"
                : m->leaves_more              ? ", which describes it in part: diagnose it"
                                              : "");
        ++said;
    }
    if (hci_line_outside(l) > said)
        cli_say("  and %zu more, in deviations.csv\n", hci_line_outside(l) - said);
}

static void show_batches(const hci_line_parameter *p)
{
    const char *unit = strcmp(p->name.unit, "1") == 0 ? "" : p->name.unit;
    cli_say("  batches      %s %s: they differ by %.3g %s; %s most, by %+.3g %s\n", p->name.effect,
            p->name.parameter, p->batch_deviation, unit, p->batch ? p->batch : "none", p->batch_beside, unit);
}

/* Motors that are not compared, and dates that no trend is from. */
static void show_left_out(const hci_line *l)
{
    size_t without = 0;
    for (size_t k = 0; k < l->motors; ++k)
        without += l->motor[k].state > HCI_FLEET_OPEN ? 1 : 0;
    if (without > 0)
        cli_say("  no result    %zu motors (failed, late or crashed): not compared; the reasons are in "
                "fleet.csv\n",
                without);
    if (l->dates_unread > 0)
        cli_say("  dates        %zu are not read, such as `%s`: no trend is from them; write YYYY-MM-DD\n",
                l->dates_unread, l->date_unread);
}

static void show(const hci_line *l)
{
    const size_t outside = hci_line_outside(l);
    cli_say("%s%s" CLI_PLAIN ": %zu of %zu motors\n", outside == 0 ? CLI_GOOD : CLI_WARN,
            outside == 1 ? "stands out" : "stand out", outside, l->motors);
    show_left_out(l);
    if (l->parameters == 0) {
        cli_say("  no parameters: only motors of batch --command fit or diagnose are compared\n");
        return;
    }
    cli_say("  limit        %.3g standard deviations, which %s %% of sound motors exceed\n", l->limit,
            HCI_PERCENT(100.0 * l->false_alarms, 3));
    show_odd(l);
    for (size_t k = 0; k < l->parameters; ++k) {
        const hci_line_parameter *p = &l->parameter[k];
        if (p->has_trend)
            cli_say("  trend        %s %s: %+.3g ± %.1g %s in 30 days\n", p->name.effect, p->name.parameter,
                    30.0 * p->per_day, 30.0 * p->per_day_std_error,
                    strcmp(p->name.unit, "1") == 0 ? "" : p->name.unit);
        if (p->has_batches) show_batches(p);
    }
}

/* The results of a batch are not to be replaced. */
static hci_status keep_apart(const cli_arguments *a, hci_note *note)
{
    for (size_t k = 0; k < a->words && a->value[OUT]; ++k)
        if (cli_is_same_file(a->word[k], a->value[OUT]))
            return hci_note_set(
                note, HCI_ERROR_ARGUMENT,
                "fleet: --out is the folder of a batch, whose fleet.csv would be replaced; give another one");
    return HCI_OK;
}

static int run(const cli_arguments *a)
{
    hci_line line;
    hci_note note = {{0}};
    memset(&line, 0, sizeof line);
    hci_status status = keep_apart(a, &note);
    if (!status) status = hci_line_read(a->word, a->words, &line, &note);
    if (!status) status = hci_line_conclude(cli_number_or(a, ALARMS, 0.2) / 100.0, &line, &note);
    if (!status && a->value[OUT]) status = hci_line_write(&line, a->value[OUT], &note);
    if (!status && cli_is_wordy()) show(&line);
    if (!status && a->given[JSON])
        status =
            cli_print_json(a->value[OUT] ? hci_summary_read(a->value[OUT]) : hci_line_json(&line), &note);
    hci_line_release(&line);
    return status ? cli_fail(status, &note) : 0;
}

const cli_command cli_fleet = {
    .name = "fleet",
    .words = "FOLDER...",
    .does =
        "Puts motors of one make side by side: which stand out and by what, distributions, trends, the "
        "machine in common.\n"
        "Writes fleet.csv, the rows of all folders, line.csv, deviations.csv, report.html and summary.json.\n"
        "FOLDER: --out of a batch; several of its shares are joined.",
    .options = OPTIONS,
    .words_needed = 1,
    .takes_more_words = true,
    .word_kind = CLI_FOLDER,
    .example = "  hci-solve batch data/fleet/motors.csv --command solve -o out/batch -- --auto\n"
               "  hci-solve fleet out/batch -o out/line\n"
               "\nExit codes: 0 done, whoever stands out; " CLI_EXIT_ERRORS,
    .source = "cli/fleet.c",
    .guide = "fleet.md",
    .run = run,
};
