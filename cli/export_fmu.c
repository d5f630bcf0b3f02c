#include <math.h>
#include <stdio.h>
#include <string.h>

#include "cli/command/command.h"
#include "cli/command/parse.h"
#include "cli/commands.h"
#include "cli/export_fmu/compile.h"
#include "cli/terminal/say.h"
#include "cli/terminal/signals.h"
#include "cli/terminal/terminal.h"
#include "cli/terminal/text.h"
#include "hci/host/fmu/fmu.h"

enum { FMI, INPUTS, SOURCES_ONLY, OUT, CLI_COMMON_KEYS };

static const cli_choice VERSIONS[] = {{"2", "2 (default)"}, {NULL, NULL}};
static const cli_choice INPUT_KINDS[] = {
    {"voltages", "voltages (default)"},
    {"currents", "; currents: they flow as they are given, whatever voltage that takes"},
    {NULL, NULL}};

static const cli_option OPTIONS[] = {
    [FMI] = {"fmi", 0, CLI_CHOICE, "VERSION", .help = "of the standard:", .choices = VERSIONS},
    [INPUTS] = {"inputs", 0, CLI_CHOICE, "WHAT", .help = "of the phases:", .choices = INPUT_KINDS},
    [SOURCES_ONLY] = {"sources-only", 0, CLI_FLAG, NULL,
                      .help = "no binary, and no C compiler is needed: the importing tool compiles"},
    [OUT] = {"out", 'o', CLI_FILE, "FILE", .help = "the FMU (default: the machine's name, and .fmu)"},
    CLI_COMMON_OPTIONS};

typedef struct {
    hci_machine_data machine;
    hci_effects_data effects;
    char work[CLI_WORK_FOLDER_SIZE]; /* "" while there is none */
    char path[HCI_MACHINE_NAME + 8]; /* where none is given */
    hci_fmu_request request;
} inputs;

static hci_status read_inputs(const cli_arguments *a, inputs *in, hci_note *note)
{
    hci_status status = hci_machine_read(a->word[0], &in->machine, note);
    if (!status) status = hci_effects_read_machine(a->word[0], &in->effects, note);
    if (!status && !a->given[SOURCES_ONLY]) status = cli_work_folder_make(in->work, note);
    in->request = (hci_fmu_request){.fmi_version = a->choice[FMI] == 1 ? 3 : 2,
                                    .machine = &in->machine,
                                    .effects = &in->effects.list,
                                    .imposed = a->choice[INPUTS] == 1,
                                    .compile = a->given[SOURCES_ONLY] ? NULL : cli_compile,
                                    .work_folder = in->work};
    snprintf(in->path, sizeof in->path, "%s.fmu", in->machine.identity.name);
    return status;
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
    cli_signals_defer();
    hci_status status = read_inputs(a, &in, note);
    const char *path = a->given[OUT] ? a->value[OUT] : in.path;
    if (!status) status = hci_fmu_export(path, &in.request, &result, note);
    if (in.work[0]) cli_work_folder_remove(in.work);
    cli_signals_catch();
    cli_signals_obey();
    if (!status && cli_is_wordy()) {
        show(&result, path);
        cli_remark(&in.machine.remark);
    }
    if (!status && a->given[JSON]) status = cli_print_json(hci_fmu_json(&result), note);
    hci_effects_release(&in.effects);
    hci_machine_release(&in.machine);
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
    .does = "Writes an FMU of the machine with its effects, for co-simulation in other programs.\n"
            "It has sources and a binary of this system, which the C compiler makes that CC names, or cc.",
    .options = OPTIONS,
    .words_needed = 1,
    .word_kind = CLI_FILE,
    .example = "  hci-solve export-fmu data/machine_c -o out/machine_c.fmu\n"
               "  hci-solve export-fmu data/machine_c --inputs currents --sources-only -o "
               "out/machine_c_currents.fmu\n"
               "\nExit codes: 0 done; " CLI_EXIT_ERRORS,
    .source = "cli/export_fmu.c",
    .guide = "fmu.md",
    .run = run,
};
