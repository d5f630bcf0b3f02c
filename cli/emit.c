#include <string.h>

#include "cli/command/command.h"
#include "cli/command/reading.h"
#include "cli/commands.h"
#include "cli/emit/emit_currents.h"
#include "cli/emit/emit_drive.h"
#include "cli/emit/emit_foreign.h"
#include "cli/emit/emit_options.h"
#include "cli/emit/emit_words.h"
#include "cli/terminal/say.h"
#include "cli/terminal/terminal.h"
#include "hci/host/report/summary.h"

static int emit_table(const cli_arguments *a)
{
    hci_emit_result result;
    hci_note note = {{0}};
    cli_emit_currents in;
    memset(&in, 0, sizeof in);
    hci_status status = cli_emit_currents_read(a, &in, &note);
    if (!status) status = hci_emit(cli_emit_folder(a), &in.request, &result, &note);
    if (!status && cli_is_wordy()) cli_show_table(&in.request, &result, cli_emit_folder(a));
    if (!status) cli_emit_remark(a, &in.machine);
    if (!status) cli_remark_table(&result);
    if (!status) cli_remark_period(result.period_turns, in.machine.model.pole_pairs);
    if (!status && cli_emit_wants_json(a))
        status = cli_print_json(hci_emit_json(&in.request, &result), &note);
    cli_emit_currents_release(&in);
    return status ? cli_fail(status, &note) : 0;
}

static int run(const cli_arguments *a)
{
    if (a->given[EMIT_DRIVE]) return cli_emit_for_drive(a);
    if (a->given[EMIT_FOR]) return cli_emit_for_foreign(a);
    return emit_table(a);
}

const cli_command cli_emit = {
    .name = "emit",
    .words = "CURRENTS_OR_FOLDER... --name ID",
    .does = "Turns currents into C tables for a microcontroller.\n"
            "Writes ID.h and ID.c, which need hci/table.h (f32) or hci/table_i16.h and nothing else; "
            "with --drive hci/loop.h too.",
    .options = cli_emit_options,
    .words_needed = 1,
    .takes_more_words = true,
    .names_files = true,
    .word_kind = CLI_FILE,
    .example =
        "  hci-solve solve data/machine_a --target data/scenarios/02/target.csv --auto -o out/machine_a\n"
        "  hci-solve emit out/machine_a --name machine_a --frame dq --max-error 0.01 -o out/machine_a\n"
        "  hci-solve emit out/machine_a --name machine_a_linear --frame dq --points 512 --per-torque -o "
        "out/machine_a\n"
        "  hci-solve emit out/machine_a --name machine_a_drive --machine data/machine_a --drive "
        "data/drive/machine_a_10kHz.csv -o out/machine_a\n"
        "\nExit codes: 0 done; " CLI_EXIT_ERRORS,
    .source = "cli/emit/emit_options.c",
    .guide = "drive.md",
    .run = run,
};
