#include <string.h>

#include "cli/batch/batch_run.h"
#include "cli/command/command.h"
#include "cli/command/jobs.h"
#include "cli/command/parse.h"
#include "cli/commands.h"
#include "cli/terminal/say.h"
#include "cli/terminal/signals.h"
#include "cli/terminal/terminal.h"
#include "cli/terminal/text.h"
#include "hci/host/report/summary.h"

enum { COMMAND, JOBS, SHARD, LIMIT, RETRY, OUT, CLI_COMMON_KEYS };

static const cli_choice COMMANDS[] = {HCI_FLEET_COMMAND_NAMES(CLI_CHOICE_OF){NULL, NULL}};

static const cli_option OPTIONS[] = {
    [COMMAND] = {"command", 0, CLI_CHOICE, "COMMAND",
                 .help = "what is run on each motor:", .choices = COMMANDS},
    [JOBS] = {"jobs", 'j', CLI_WHOLE, "N", .help = "processes (default: as many as there are processors)",
              .low = 1.0, .high = CLI_MOST_JOBS},
    [SHARD] = {"shard", 0, CLI_TEXT, "K/N",
               .help =
                   "do only share K of N, such as 3/16; each share has its own --out, and fleet joins them"},
    [LIMIT] = {"time-limit", 0, CLI_NUMBER, "S", .help = "a motor that takes longer is ended, and is a row",
               .low = 1e-3, .high = 1e7},
    [RETRY] = {"retry", 0, CLI_FLAG, NULL, .help = "do motors again that have no result"},
    [OUT] = {"out", 'o', CLI_FOLDER, "FOLDER",
             .help = "where the results go; the same command goes on there"},
    CLI_COMMON_OPTIONS};

static const cli_command *const RUN[] = {[HCI_FLEET_DIAGNOSE] = &cli_diagnose,
                                         [HCI_FLEET_TUNE] = &cli_tune,
                                         [HCI_FLEET_SOLVE] = &cli_solve,
                                         [HCI_FLEET_FIT] = &cli_fit};

/* ---- what came of it ---- */

static void say_counts(const cli_arguments *a, const hci_fleet_count *c)
{
    const bool is_whole = c->done == c->motors;
    cli_say("%s%s" CLI_PLAIN ": %zu of %zu motors\n", is_whole ? CLI_GOOD : CLI_WARN,
            is_whole ? "done" : "not done yet", c->done, c->motors);
    for (int k = 0; k <= HCI_FLEET_CRASHED; ++k)
        if (c->of[k]) cli_say("  %-12s %zu\n", hci_fleet_state_name((hci_fleet_state)k), c->of[k]);
    if (!is_whole && a->value[SHARD] && !cli_signals_deferred(NULL))
        cli_say("  hci-solve fleet with the folders of all shares puts them together\n");
    else if (!is_whole)
        cli_say("  the same command goes on from there\n");
}

enum { MOST_REASONS = 3 }; /* on the terminal; fleet.csv has them all */

/* Of the first motors without a result. */
static void say_reasons(const cli_batch_work *w)
{
    size_t said = 0;
    for (size_t k = 0; k < w->batch->list.count && said < MOST_REASONS; ++k) {
        char reason[HCI_FLEET_REASON_SIZE] = "";
        if (w->row[k]) hci_fleet_row_reason(w->row[k], reason);
        if (!reason[0]) continue;
        cli_say("  %-12s %s\n", hci_fleet_cell(&w->batch->list, k, "motor"), reason);
        ++said;
    }
}

static hci_status give(const cli_arguments *a, const cli_batch_work *w, hci_note *note)
{
    const hci_fleet_count c = hci_fleet_count_rows(w->row, w->batch->list.count);
    hci_status status = HCI_OK;
    if (cli_is_wordy()) say_counts(a, &c);
    if (cli_is_wordy()) say_reasons(w);
    if (a->given[JSON] && c.done == c.motors) status = cli_print_json(hci_summary_read(a->value[OUT]), note);
    if (status) return status;
    return c.of[HCI_FLEET_FAILED] + c.of[HCI_FLEET_LATE] + c.of[HCI_FLEET_CRASHED] > 0 ? HCI_NOT_REACHED
                                                                                       : HCI_OK;
}

/* ---- the command ---- */

static hci_status read_all(const cli_arguments *a, cli_batch *b, cli_batch_work *w, hci_note *note)
{
    for (int k = 0; COMMANDS[k].word && a->words > 1; ++k)
        if (strcmp(a->word[0], COMMANDS[k].word) == 0)
            return hci_note_set(note, HCI_ERROR_ARGUMENT,
                                "batch: found the word `%s` before the list, expected --command %s: "
                                "hci-solve batch %.300s --command %s",
                                a->word[0], a->word[0], a->word[1], a->word[0]);
    if (!a->value[OUT]) return hci_note_set(note, HCI_ERROR_ARGUMENT, "batch: add --out FOLDER");
    if (!a->given[COMMAND])
        return hci_note_set(note, HCI_ERROR_ARGUMENT, "batch: add --command fit, diagnose, tune or solve");
    b->command = RUN[a->choice[COMMAND]];
    b->path = a->word[0];
    b->common = a->word + 1;
    b->commons = a->words - 1;
    w->batch = b;
    w->fit = &cli_fit;
    w->results = (hci_fleet_results){a->value[OUT], (hci_fleet_command)a->choice[COMMAND], &b->list};
    w->jobs = (size_t)cli_number_or(a, JOBS, (double)cli_processors());
    w->limit_s = cli_number_or(a, LIMIT, 0.0);
    w->retries = a->given[RETRY];
    hci_status status = cli_shard_read(a->value[SHARD], &w->shard, note);
    if (!status) status = hci_fleet_list_read(b->path, &b->list, note);
    return status ? status : cli_batch_check(b, note);
}

static int run(const cli_arguments *a)
{
    cli_batch batch;
    cli_batch_work work;
    hci_note note = {{0}};
    hci_status status;
    memset(&batch, 0, sizeof batch);
    memset(&work, 0, sizeof work);
    status = read_all(a, &batch, &work, &note);
    if (!status) status = cli_batch_run(&work, &note);
    if (!status) status = give(a, &work, &note);
    cli_batch_release(&work);
    hci_fleet_list_release(&batch.list);
    if (status <= HCI_NOT_REACHED) cli_signals_obey();
    cli_signals_catch();
    return status > HCI_NOT_REACHED ? cli_fail(status, &note) : hci_status_exit_code(status);
}

const cli_command cli_batch_command = {
    .name = "batch",
    .words = "LIST --command COMMAND -o FOLDER [-- OPTION...]",
    .does =
        "Runs fit, diagnose, tune or solve on each motor of a list, by as many processes as there are "
        "processors.\n"
        "Writes motors/NAME, what the command writes, for each motor as it is done, fleet.csv with a row for "
        "each, and summary.json at the end. The same command goes on from there.\n"
        "LIST: a table with a row for each motor: motor, its name; machine, its folder; logs, divided by "
        "semicolons; serial, batch, date; any option of the command by its name, such as runs. Paths are "
        "from "
        "the folder of LIST. What stands behind -- is given to the command for every motor.",
    .options = OPTIONS,
    .words_needed = 1,
    .takes_more_words = true,
    .names_files = true,
    .word_kind = CLI_FILE,
    .example = "  hci-solve batch data/fleet/motors.csv --command solve -o out/batch -- --auto\n"
               "\nExit codes: 0 done; 1 done, but a motor has no result; " CLI_EXIT_ERRORS,
    .source = "cli/batch.c",
    .guide = "fleet.md",
    .run = run,
};
