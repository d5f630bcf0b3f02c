#include <stdlib.h>

#include "cli/command/command.h"
#include "cli/command/reading.h"
#include "cli/command/replaced.h"
#include "cli/command/written.h"
#include "cli/commands.h"
#include "cli/terminal/say.h"
#include "cli/terminal/terminal.h"
#include "cli/tune/tune_options.h"
#include "cli/tune/tune_sensor_zero.h"
#include "cli/tune/tune_show.h"
#include "cli/tune/tune_size.h"
#include "cli/tune/words/tune_conclude.h"
#include "cli/tune/words/tune_found.h"

static hci_status steps(const cli_arguments *a, cli_tuning *t, hci_note *note)
{
    hci_status status = cli_tune_begin(a, t, note);
    if (!status) status = cli_tune_read(t, note);
    if (!status) status = cli_tune_check(t, note);
    if (!status) status = cli_tune_leave_out(t, note);
    if (!status) status = cli_tune_take_sensor_zero(t, note);
    if (!status) status = cli_tune_waveforms(t, note);
    if (!status) status = cli_tune_diagnose(t, note);
    if (!status && t->has_diagnosis) cli_tune_say_diagnosis(t);
    if (!status) status = cli_tune_solve(t, note);
    if (!status) cli_tune_judge_size(t);
    if (!status) status = cli_tune_emit(t, note);
    if (status) return status;
    cli_tune_conclude(t);
    return hci_tuning_write(&t->tuning, t->out, note);
}

static int run(const cli_arguments *arguments)
{
    hci_note note = {{0}};
    cli_arguments recordings;
    const cli_arguments *a = &recordings;
    cli_reading_without_lists(arguments, 0, &recordings);
    cli_tuning *t = calloc(1, sizeof *t);
    if (!t) return cli_fail(hci_note_memory(&note, NULL, "the steps of tune"), &note);
    t->commands = (cli_tune_commands){&cli_init, &cli_harmonics, &cli_emit};
    hci_status status = steps(a, t, &note);
    int code;
    if (status) cli_written_remove(t->out); /* so that the same call can be made again */
    cli_replaced_settle(t->out, t->aside, !status);
    if (!status && cli_is_wordy()) cli_show_tuning(t);
    if (!status && a->given[JSON]) status = cli_print_json(hci_tuning_json(&t->tuning), &note);
    code = status ? cli_fail(status, &note) : t->tuning.good ? 0 : 1;
    cli_tune_release(t);
    free(t);
    return code;
}

const cli_command cli_tune = {
    .name = "tune",
    .words = "{LOG... --pole-pairs P --kv RPM_PER_V | MACHINE --runs LIST} -o FOLDER",
    .does =
        "From logs of a motor to a table of currents in one go: reads, checks, finds what makes the ripple, "
        "solves and emits.\n"
        "Each step is an ordinary command and leaves its folder: machine, check, diagnose, currents, table.\n"
        "Writes report.html, summary.json and commands.sh, which does it again step by step.",
    .options = cli_tune_options,
    .words_needed = 1,
    .takes_more_words = true,
    .names_files = true,
    .word_kind = CLI_FILE,
    .example =
        "  hci-solve simulate data/machine_a data/drive/driven.csv -o out/driven\n"
        "  hci-solve tune out/driven/trajectory.csv --pole-pairs 2 --kv 39 --torque 2.46 -o out/tuned\n"
        "\nExit codes: 0 done; 1 not enough in the logs, a convention is broken, or something is left "
        "open; " CLI_EXIT_ERRORS,
    .source = "cli/tune.c",
    .guide = "tune.md",
    .run = run,
};
