#define _POSIX_C_SOURCE 200809L

#include <stdio.h>
#include <string.h>
#include <unistd.h>

#include "cli/command/command.h"
#include "cli/command/parse.h"
#include "cli/commands.h"
#include "cli/simulate/simulate_speeds.h"
#include "cli/simulate/simulate_words.h"
#include "cli/terminal/progress.h"
#include "cli/terminal/say.h"
#include "cli/terminal/terminal.h"
#include "cli/terminal/text.h"
#include "hci/host/report/summary.h"
#include "hci/host/report/write.h"

enum {
    CURRENTS,
    TABLE,
    DRIVE,
    SPEEDS,
    TORQUE,
    PER_TORQUE,
    MODEL_ERROR,
    OUT,
    REPORT,
    ORDER_BASE,
    CLI_COMMON_KEYS
};

static const cli_option OPTIONS[] = {
    [CURRENTS] = {"currents", 0, CLI_FILE, "PATH",
                  .help = "impose these: currents.csv, or a folder that `solve` wrote"},
    [TABLE] = {"table", 0, CLI_FOLDER, "FOLDER",
               .help =
                   "in place of a scenario: torque ripple over the speed of the tables that `emit --drive` "
                   "makes of this folder of `solve`; may be given for several levels of torque",
               .repeats = true},
    [DRIVE] = {"drive", 0, CLI_FILE, "FILE", .help = "with --table: drive.csv"},
    [SPEEDS] = {"speeds", 0, CLI_TEXT, "RPM,...",
                .help = "with --table: mechanical, of one direction and ascending in size"},
    [TORQUE] = {"torque", 0, CLI_NUMBER, "NM",
                .help = "with --table: what is asked for (default: the highest level)", .low = -1e9,
                .high = 1e9},
    [PER_TORQUE] =
        {"per-torque", 0, CLI_FLAG, NULL,
         .help = "with --table: as `emit --per-torque`, levels -T and T of one solution, for any --torque "
                 "between them"},
    [MODEL_ERROR] = {"model-error", 0, CLI_NUMBER, "PERCENT",
                     .help =
                         "with --table: also machines whose resistance, inductance and flux are so much off",
                     .low = 0.0, .high = 90.0},
    [OUT] = {"out", 'o', CLI_FOLDER, "FOLDER", .help = "where the results go; without it nothing is written"},
    [REPORT] = {"report", 0, CLI_FLAG, NULL, .help = "report.html beside the results, for people"},
    [ORDER_BASE] = CLI_TABLE_ORDER_BASE_OPTION,
    CLI_COMMON_OPTIONS};

/* ---- help ---- */

enum { MEANING_AT = 41, NARROW_AT = 6 }; /* column of the terminal */

static void print_name(const char *name, const char *unit, const char *text)
{
    const int width = cli_width(STDOUT_FILENO);
    const bool is_narrow = width < 2 * MEANING_AT - 2;
    const int at = is_narrow ? NARROW_AT : MEANING_AT;
    if (strcmp(unit, "count") == 0 || strcmp(unit, "1") == 0) unit = "";
    printf("  %-24s %-*s", name, is_narrow ? 0 : MEANING_AT - 27, unit);
    if (is_narrow) printf("\n%*s", NARROW_AT, "");
    cli_print_wrapped(stdout, width, at, at, text);
}

/* A number, "what it is [default]"; those that follow from the one before them have no text. */
static void print_value(const char *name, const char *unit, const char *fallback, const char *what)
{
    char text[256];
    snprintf(text, sizeof text, "%s%s%s%s", what, fallback[0] ? " [" : "", fallback, fallback[0] ? "]" : "");
    if (what[0]) print_name(name, unit, text);
}

/* A word, "what it is: a, b, c [default]". */
static void print_word(const char *name, const char *words, const char *fallback, const char *what)
{
    char text[256];
    snprintf(text, sizeof text, "%s: %s [%s]", what, words, fallback);
    print_name(name, "", text);
}

/* After the help: what a scenario may hold. */
static void print_scenario_names(void)
{
    putchar('\n');
    cli_print_wrapped(stdout, cli_width(STDOUT_FILENO), 0, 0,
                      "A scenario is a table name,value,unit. Its names, units and [defaults]");
#define LISTED(value, word)                     ", " word
#define PRINT_WORD(name, words, fallback, what) print_word(name, &(words(LISTED))[2], fallback, what);
    HCI_SCENARIO_WORDS(PRINT_WORD)
#undef PRINT_WORD
#undef LISTED
#define PRINT_VALUE(field, name, unit, low, high, fallback, what) print_value(name, unit, fallback, what);
    HCI_SCENARIO_VALUES(PRINT_VALUE)
#undef PRINT_VALUE
}

/* ---- the command ---- */

static hci_status override_currents(const char *path, hci_scenario *scenario, hci_note *note)
{
    if (path[0] != '\0' && strlen(path) < sizeof scenario->currents) {
        memcpy(scenario->currents, path, strlen(path) + 1);
        return HCI_OK;
    }
    return hci_note_set(note, HCI_ERROR_ARGUMENT,
                        "--currents: expected currents.csv or the folder of a solution");
}

static hci_status simulate(const cli_arguments *a, const hci_machine_data *machine,
                           const hci_effects *effects, const hci_scenario *scenario, hci_note *note)
{
    cli_work work = {scenario->duration_s, "s simulated"};
    const hci_simulate_options options = {
        .effects = effects, .progress = cli_progress, .progress_context = &work};
    const hci_report_sources sources = {.machine = a->word[0],
                                        .scenario = a->word[1],
                                        .currents = scenario->currents[0] ? scenario->currents : NULL};
    hci_simulation simulation;
    const hci_simulate_output where = {a->value[OUT], a->given[REPORT] ? &sources : NULL};
    hci_status status = where.folder
                            ? hci_simulate_to_folder(machine, scenario, &options, &where, &simulation, note)
                            : hci_simulate(machine, scenario, &options, &simulation, note);
    cli_progress_end();
    if (!status && cli_is_wordy()) {
        cli_show_simulation(&simulation, a->word[0], a->word[1]);
        cli_remark(&machine->remark);
        cli_remark(&simulation.remark);
    }
    if (!status && a->given[JSON])
        status = cli_print_json(
            where.folder ? hci_summary_read(where.folder) : hci_simulation_json(&simulation), note);
    hci_simulation_release(&simulation);
    return status;
}

/* Options and words that exclude or need each other. */
static hci_status check_together(const cli_arguments *a, hci_note *note)
{
    const bool table = a->repeats > 0;
    const char *wrong = NULL;
    if (a->given[REPORT] && !a->given[OUT])
        wrong = "--report is written into a folder; add --out FOLDER";
    else if (table && a->words != 1)
        wrong = "simulate: --table takes the place of a scenario; delete one of the two";
    else if (!table && a->words != 2)
        wrong = "simulate: expected MACHINE SCENARIO, or MACHINE with --table, --drive and --speeds";
    else if (table && (!a->given[DRIVE] || !a->given[SPEEDS]))
        wrong = "simulate: --table needs --drive FILE and --speeds RPM,...";
    else if (table && a->given[CURRENTS])
        wrong = "simulate: --table and --currents both say what flows; delete one of them";
    else if (!table && (a->given[DRIVE] || a->given[SPEEDS] || a->given[TORQUE] || a->given[PER_TORQUE] ||
                        a->given[MODEL_ERROR]))
        wrong =
            "simulate: --drive, --speeds, --torque, --per-torque and --model-error go with --table FOLDER";
    return wrong ? hci_note_set(note, HCI_ERROR_ARGUMENT, "%s", wrong) : HCI_OK;
}

static int run_speeds(const cli_arguments *a)
{
    const cli_speeds_words words = {.machine = a->word[0],
                                    .drive = a->value[DRIVE],
                                    .table = a->repeated,
                                    .table_count = a->repeats,
                                    .speeds = a->value[SPEEDS],
                                    .torque_Nm = a->number[TORQUE],
                                    .per_torque = a->given[PER_TORQUE],
                                    .error_percent = cli_number_or(a, MODEL_ERROR, 0.0),
                                    .out = a->value[OUT],
                                    .report = a->given[REPORT],
                                    .json = a->given[JSON],
                                    .order_base = (hci_order_base)a->choice[ORDER_BASE]};
    hci_note note = {{0}};
    const hci_status status = cli_simulate_speeds(&words, &note);
    return status ? cli_fail(status, &note) : 0;
}

static int run(const cli_arguments *a)
{
    hci_machine_data machine;
    hci_effects_data effects = {{NULL, 0}, NULL, NULL};
    hci_scenario scenario;
    hci_note note = {{0}};
    hci_status status = check_together(a, &note);
    if (!status && a->repeats > 0) return run_speeds(a);
    memset(&machine, 0, sizeof machine);
    const hci_order_base base = (hci_order_base)a->choice[ORDER_BASE];
    if (!status) status = hci_machine_read_orders(a->word[0], base, &machine, &note);
    if (!status) status = hci_effects_read_machine(a->word[0], &effects, &note);
    if (!status) status = hci_scenario_read(a->word[1], &scenario, &note);
    if (!status && a->given[CURRENTS]) status = override_currents(a->value[CURRENTS], &scenario, &note);
    if (!status) status = simulate(a, &machine, &effects.list, &scenario, &note);
    hci_effects_release(&effects);
    hci_machine_release(&machine);
    return status ? cli_fail(status, &note) : 0;
}

const cli_command cli_simulate = {
    .name = "simulate",
    .words = "MACHINE SCENARIO | MACHINE --table FOLDER --drive FILE --speeds RPM,...",
    .does =
        "Runs the drive in time: machine, shaft, current and speed control, sensors.\n"
        "Writes trajectory.csv, spectrum.csv and summary.json; with --report also report.html.\n"
        "With --table: torque ripple through the current loop at several speeds, by what is done about it; "
        "writes speeds.csv, speeds.svg and summary.json.",
    .options = OPTIONS,
    .words_needed = 1,
    .takes_more_words = true,
    .word_kind = CLI_FILE,
    .example =
        "  hci-solve simulate data/machine_a data/drive/imposed.csv -o out/imposed\n"
        "  hci-solve simulate data/machine_c data/drive/filho_strategy_3.csv -o out/strategy_3\n"
        "  hci-solve solve data/machine_a --target data/scenarios/02/target.csv --auto -o out/machine_a\n"
        "  hci-solve simulate data/machine_a --table out/machine_a --drive data/drive/machine_a_10kHz.csv "
        "--speeds 100,300,1000 -o out/speeds\n"
        "\nExit codes: 0 done; " CLI_EXIT_ERRORS,
    .source = "cli/simulate.c",
    .guide = "simulate.md",
    .more_help = print_scenario_names,
    .run = run,
};
