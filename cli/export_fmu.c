#include <stdio.h>
#include <string.h>

#include "cli/command/command.h"
#include "cli/command/parse.h"
#include "cli/command/written.h"
#include "cli/commands.h"
#include "cli/export_fmu/compile.h"
#include "cli/terminal/say.h"
#include "cli/terminal/signals.h"
#include "cli/terminal/terminal.h"
#include "cli/terminal/text.h"
#include "hci/host/fmu/fmu.h"

enum { FMI, INPUTS, TABLE, DRIVE, SOURCES_ONLY, OUT, CLI_COMMON_KEYS };

static const cli_choice VERSIONS[] = {{"2", "2 (default)"}, {"3", "; 3"}, {NULL, NULL}};
static const cli_choice INPUT_KINDS[] = {
    {"voltages", "voltages (default)"},
    {"currents", "; currents: they flow as they are given, whatever voltage that takes"},
    {NULL, NULL}};

static const cli_option OPTIONS[] = {
    [FMI] = {"fmi", 0, CLI_CHOICE, "VERSION", .help = "of the standard:", .choices = VERSIONS},
    [INPUTS] = {"inputs", 0, CLI_CHOICE, "WHAT", .help = "of the phases:", .choices = INPUT_KINDS},
    [TABLE] = {"table", 0, CLI_FOLDER, "FOLDER",
               .help = "the controller instead, with the table that `emit --drive` makes of this folder of "
                       "`solve`; may be given for several levels of torque",
               .repeats = true},
    [DRIVE] = {"drive", 0, CLI_FILE, "FILE",
               .help = "drive.csv: of a controller its loop; of a machine the inverter's dead time, and what "
                       "machine.csv lacks"},
    [SOURCES_ONLY] = {"sources-only", 0, CLI_FLAG, NULL,
                      .help = "no binary, and no C compiler is needed: the importing tool compiles"},
    [OUT] = {"out", 'o', CLI_FILE, "FILE",
             .help = "the FMU (default: the machine's name, of a controller with _controller, and .fmu)"},
    CLI_COMMON_OPTIONS};

typedef struct {
    hci_machine_data machine;
    hci_effects_data effects;
    hci_drive_data drive;
    hci_loop_levels levels;
    char work[CLI_WORK_FOLDER_SIZE];  /* "" while there is none */
    char path[HCI_MACHINE_NAME + 24]; /* where none is given */
    hci_fmu_request request;
} inputs;

static hci_status check_together(const cli_arguments *a, hci_note *note)
{
    if (a->repeats > 0 && !a->given[DRIVE])
        return hci_note_set(note, HCI_ERROR_ARGUMENT,
                            "export-fmu: --table needs --drive FILE, whose current loop the controller has");
    if (a->repeats > 0 && a->given[INPUTS])
        return hci_note_set(
            note, HCI_ERROR_ARGUMENT,
            "export-fmu: --inputs is of a machine, and --table makes a controller; delete one "
            "of them");
    return HCI_OK;
}

static hci_status read_inputs(const cli_arguments *a, inputs *in, hci_note *note)
{
    hci_status status = check_together(a, note);
    if (!status) status = hci_machine_read(a->word[0], &in->machine, note);
    if (!status) status = hci_effects_read_machine(a->word[0], &in->effects, note);
    if (!status && a->given[DRIVE]) status = hci_drive_read(a->value[DRIVE], &in->drive, note);
    if (!status && a->repeats > 0)
        status = hci_loop_levels_read(a->repeated, a->repeats, false, &in->levels, note);
    if (!status) status = cli_work_folder_make(in->work, note);
    in->request = (hci_fmu_request){.fmi_version = a->choice[FMI] == 1 ? 3 : 2,
                                    .machine = &in->machine,
                                    .effects = &in->effects.list,
                                    .imposed = a->choice[INPUTS] == 1,
                                    .drive = a->given[DRIVE] ? &in->drive : NULL,
                                    .levels = in->levels.level,
                                    .level_count = in->levels.count,
                                    .compile = a->given[SOURCES_ONLY] ? NULL : cli_compile,
                                    .work_folder = in->work};
    snprintf(in->path, sizeof in->path, "%s%s.fmu", in->machine.identity.name,
             in->levels.count > 0 ? "_controller" : "");
    return status;
}

static void release_inputs(inputs *in)
{
    hci_loop_levels_release(&in->levels);
    hci_drive_release(&in->drive);
    hci_effects_release(&in->effects);
    hci_machine_release(&in->machine);
}

static void show(const hci_fmu_result *r, const char *path)
{
    cli_say(CLI_GOOD "exported" CLI_PLAIN ": %s: FMI %d.0 for co-simulation\n", path, r->fmi_version);
    cli_say("  variables    %zu inputs, %zu outputs, %zu parameters\n", r->inputs, r->outputs, r->parameters);
    if (r->effects > 0)
        cli_say("  effects      %zu of effects.csv, on the machine and on its sensors\n", r->effects);
    if (r->binary_bytes > 0)
        cli_say("  binary       of this system, %zu bytes\n", r->binary_bytes);
    else
        cli_say("  binary       none; the importing tool compiles the %zu files in sources\n", r->sources);
    cli_remark(&r->remark);
}

/* Temporary files go whatever comes: a signal waits for that. */
static hci_status export_fmu(const cli_arguments *a, hci_note *note)
{
    inputs in;
    hci_fmu_result result;
    memset(&in, 0, sizeof in);
    hci_drive_init(&in.drive);
    cli_signals_defer();
    hci_status status = read_inputs(a, &in, note);
    const char *path = a->given[OUT] ? a->value[OUT] : in.path;
    if (!status) status = hci_fmu_export(path, &in.request, &result, note);
    if (in.work[0]) cli_work_folder_remove(in.work);
    cli_written_forget(in.work);
    cli_signals_catch();
    cli_signals_obey();
    if (!status && cli_is_wordy()) {
        show(&result, path);
        cli_remark(&in.machine.remark);
    }
    if (!status && a->given[JSON]) status = cli_print_json(hci_fmu_json(&result), note);
    release_inputs(&in);
    return status;
}

static int run(const cli_arguments *a)
{
    hci_note note = {{0}};
    const hci_status status = export_fmu(a, &note);
    return status ? cli_fail(status, &note) : 0;
}

const cli_command cli_export_fmu = {
    .name = "export-fmu",
    .words = "MACHINE",
    .does = "Writes an FMU of the machine with its effects, or of its controller, for co-simulation.\n"
            "It has sources and a binary of this system, which the C compiler makes that CC names, or cc.",
    .options = OPTIONS,
    .words_needed = 1,
    .word_kind = CLI_FILE,
    .example =
        "  hci-solve export-fmu data/machine_c -o out/machine_c.fmu\n"
        "  hci-solve solve data/machine_a --target data/scenarios/02/target.csv --auto -o out/machine_a\n"
        "  hci-solve export-fmu data/machine_a --table out/machine_a --drive "
        "data/drive/machine_a_10kHz.csv --fmi 3 -o out/controller.fmu\n"
        "  hci-solve export-fmu data/machine_c --inputs currents --sources-only -o "
        "out/machine_c_currents.fmu\n"
        "\nExit codes: 0 done; " CLI_EXIT_ERRORS,
    .source = "cli/export_fmu.c",
    .guide = "fmu.md",
    .run = run,
};
