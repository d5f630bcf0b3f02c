#define _POSIX_C_SOURCE 200809L

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "cli/command/command.h"
#include "cli/command/parse.h"
#include "cli/command/reading.h"
#include "cli/command/same_file.h"
#include "cli/commands.h"
#include "cli/solve/solve_limits.h"
#include "cli/solve/solve_words.h"
#include "cli/terminal/progress.h"
#include "cli/terminal/say.h"
#include "cli/terminal/terminal.h"
#include "hci/host/base/number.h"
#include "hci/host/currents/solution_folder.h"
#include "hci/host/drive/drive.h"
#include "hci/host/machine/effects.h"
#include "hci/host/report/summary.h"
#include "hci/host/report/write.h"
#include "hci/host/solution/for_drive.h"

enum {
    TARGET,
    HARMONICS,
    AUTO,
    FUNDAMENTAL,
    METHOD,
    STRATEGY,
    CURRENT_ANGLE,
    COMPARE,
    TOLERANCE,
    MAX_LOSS,
    CLI_LIMIT_KEYS,
    SPEED,
    DRIVE,
    BANDWIDTH,
    MINIMISE,
    TEMPERATURE,
    ORDER_BASE,
    OUT,
    REPORT,
    CLI_COMMON_KEYS
};

static const cli_choice METHODS[] = {HCI_METHOD_NAMES(CLI_CHOICE_OF){NULL, NULL}};
static const cli_choice STRATEGIES[] = {HCI_STRATEGY_NAMES(CLI_CHOICE_OF){NULL, NULL}};
static const cli_choice COMPARES[] = {
    [HCI_COMPARE_ALL] = {"all", "all (default): every order reached"},
    [HCI_COMPARE_SQUARE] = {"square", "; square: as many as unknowns"},
    {NULL, NULL},
};

static const cli_option OPTIONS[] = {
    [TARGET] = {"target", 0, CLI_FILE, "FILE",
                .help = "wanted torque: order,amplitude_Nm,phase_rad[,weight]"},
    [HARMONICS] = {"harmonics", 0, CLI_FILE, "FILE",
                   .help = "components to use: order,set (pos, neg, sym, asym; zero with a neutral)"},
    [AUTO] = {"auto", 0, CLI_COUNT_OPTIONAL, "K",
              .help = "choose the components (default), at most K of them", .low = 1.0, .high = 1e4},
    [FUNDAMENTAL] = {"fundamental", 0, CLI_TEXT, "A,RAD",
                     .help = "hold the fundamental at peak amplitude and phase"},
    [METHOD] = {"method", 0, CLI_CHOICE, "NAME", NULL, .choices = METHODS},
    [STRATEGY] = {"strategy", 0, CLI_CHOICE, "NAME",
                  .help = "of pointwise (cancel: i_d cancels reluctance and cogging):",
                  .choices = STRATEGIES},
    [CURRENT_ANGLE] = {"current-angle", 0, CLI_NUMBER, "DEG",
                       .help = "of pointwise, in place of a strategy: kept in the rotor frame, i_d = -I sin, "
                               "i_q = I cos; 0: i_d stays 0",
                       .low = -180.0, .high = 180.0},
    [COMPARE] = {"compare", 0, CLI_CHOICE, "WHAT", NULL, .choices = COMPARES},
    [TOLERANCE] = {"tolerance", 0, CLI_NUMBER, "SHARE",
                   .help = "of the mean torque; an order within it is reached (1e-6)", .low = 1e-14,
                   .high = 1.0},
    [MAX_LOSS] = {"max-loss", 0, CLI_NUMBER, "RATIO",
                  .help = "with --auto K: copper over the least that the torque takes at each angle (1.10); "
                          "with --drive: over that of orders as they come (1.5)",
                  .low = 1.0, .high = 1e6},
    CLI_LIMIT_OPTIONS,
    [SPEED] = {"speed", 0, CLI_NUMBER, "RPM",
               .help = "mechanical; the voltage is limited by --limit-voltage or dc_link_voltage",
               .low = -1e7, .high = 1e7},
    [DRIVE] = {"drive", 0, CLI_FILE, "FILE",
               .help =
                   "drive.csv: leaves out or reduces orders that its current loop cannot follow at --speed"},
    [BANDWIDTH] = {"bandwidth", 0, CLI_NUMBER, "HZ",
                   .help =
                       "of the current loop: what it adds to the ripple, and up to which speed little; with "
                       "--speed the bound has it",
                   .low = 1e-3, .high = 1e6},
    [MINIMISE] = {"minimise", 0, CLI_CHOICE, "WHAT",
                  .help = "ripple that is made smallest where it cannot be as wanted:",
                  .choices = cli_minimise_choices},
    [TEMPERATURE] = {"temperature", 0, CLI_NUMBER, "C",
                     .help = "of the magnets, for magnet_temperature in effects.csv", .low = -273.15,
                     .high = 1e4},
    [ORDER_BASE] = CLI_ORDER_BASE_OPTION,
    [OUT] = {"out", 'o', CLI_FOLDER, "FOLDER", .help = "where the results go; without it nothing is written"},
    [REPORT] = {"report", 0, CLI_FLAG, NULL, .help = "report.html beside the results, for people"},
    CLI_COMMON_OPTIONS};

/* ---- options ---- */

/* AMPLITUDE_A,PHASE_rad */
static hci_status read_fundamental(const char *text, hci_wave *held, hci_note *note)
{
    char amplitude[64];
    double amplitude_A, phase_rad;
    const char *comma = strchr(text, ',');
    const size_t length = comma ? (size_t)(comma - text) : 0;
    if (comma && length < sizeof amplitude) {
        memcpy(amplitude, text, length);
        amplitude[length] = '\0';
        if (hci_number_parse(amplitude, &amplitude_A) && hci_number_parse(comma + 1, &phase_rad) &&
            fabs(amplitude_A) <= 1e9 && fabs(phase_rad) <= 1e6) {
            *held = hci_wave_polar(1.0, 1, amplitude_A, phase_rad);
            return HCI_OK;
        }
    }
    return hci_note_set(
        note, HCI_ERROR_ARGUMENT,
        "--fundamental: found `%s`, expected peak amplitude in A and phase in rad, such as 12,0.2", text);
}

/* Options that exclude or need each other. */
static hci_status check_together(const cli_arguments *a, hci_method method, hci_note *note)
{
    const char *wrong = NULL;
    if (a->given[HARMONICS] && (a->given[AUTO] || method == HCI_METHOD_POINTWISE))
        wrong = "--harmonics names the components; leave out --auto or --method pointwise";
    else if (a->given[AUTO] && method != HCI_METHOD_AUTO)
        wrong = "--auto chooses the method too; leave out --method";
    else if (a->given[MAX_LOSS] && !a->value[AUTO] && !a->given[DRIVE])
        wrong = "--max-loss goes with --auto K or --drive";
    else if (a->given[STRATEGY] && method != HCI_METHOD_POINTWISE)
        wrong = "--strategy works angle by angle; add --method pointwise";
    else if (a->given[CURRENT_ANGLE] && (a->given[STRATEGY] || method != HCI_METHOD_POINTWISE))
        wrong = "--current-angle works angle by angle in place of a strategy; add --method pointwise, leave "
                "out --strategy";
    else if (!a->given[HARMONICS] &&
             (a->given[COMPARE] || method == HCI_METHOD_LU || method == HCI_METHOD_UMFPACK))
        wrong = "--compare and --method lu or umfpack need a set: --harmonics FILE";
    else if (a->given[DRIVE] && (!a->given[SPEED] || cli_number_or(a, SPEED, 0.0) == 0.0))
        wrong = "solve: what a drive follows depends on the speed; add --speed RPM, not 0";
    else if (a->given[DRIVE] && method == HCI_METHOD_POINTWISE)
        wrong = "solve: --drive leaves out harmonics, and --method pointwise has none to choose";
    else if (a->given[LIMIT_VOLTAGE] && !a->given[SPEED])
        wrong = "solve: --limit-voltage and --speed go together";
    else if (a->given[VOLTAGE_RESERVE] && !a->given[SPEED])
        wrong = "solve: --voltage-reserve limits the voltage at a speed; add --speed RPM";
    else if (a->given[MINIMISE] && method == HCI_METHOD_POINTWISE)
        wrong = "--minimise is of sets of harmonics; leave out --method pointwise";
    else if (!a->value[TARGET])
        wrong = "solve: the wanted torque is missing; add --target FILE";
    else if (a->given[REPORT] && !a->given[OUT])
        wrong = "--report is written into a folder; add --out FOLDER";
    return wrong ? hci_note_set(note, HCI_ERROR_ARGUMENT, "%s", wrong) : HCI_OK;
}

/* A speed alone says nothing without the voltage that there is. */
static hci_status check_link(const cli_arguments *a, const hci_machine_data *m, hci_note *note)
{
    if (!a->given[SPEED] || a->given[LIMIT_VOLTAGE] || a->given[DRIVE] || a->given[BANDWIDTH]) return HCI_OK;
    if (!a->given[IGNORE_RATINGS] && m->dc_link_voltage_V > 0.0) return HCI_OK;
    return hci_note_set(note, HCI_ERROR_ARGUMENT,
                        "solve: --limit-voltage and --speed go together, unless machine.csv has a "
                        "`dc_link_voltage` that is to be kept");
}

/* Everything that is read, in one place so that it is released in one place. */
typedef struct {
    hci_machine_data machine;
    hci_effects_data effects;
    hci_uncertainty uncertainty;
    hci_target target;
    hci_component_set set;
    hci_wave held;
    double current_angle_rad;
    hci_solve_options options;
    hci_note target_remark; /* of target.csv, or "" */
    hci_note drive_remark;  /* what --drive leaves out, or "" */
} inputs;

static hci_status read_options(const cli_arguments *a, inputs *in, hci_note *note)
{
    hci_solve_options *o = &in->options;
    hci_status status;
    o->method = (hci_method)a->choice[METHOD];
    o->strategy = (hci_strategy)a->choice[STRATEGY];
    in->current_angle_rad = cli_number_or(a, CURRENT_ANGLE, 0.0) * HCI_PI / 180.0;
    o->current_angle_rad = a->given[CURRENT_ANGLE] ? &in->current_angle_rad : NULL;
    o->compare = (hci_compare)a->choice[COMPARE];
    o->choose_at_most = (size_t)cli_number_or(a, AUTO, 0.0);
    o->tolerance = cli_number_or(a, TOLERANCE, 0.0);
    o->loss_allowance = cli_number_or(a, MAX_LOSS, 0.0);
    o->at_speed = a->given[SPEED];
    o->speed_rad_per_s = cli_number_or(a, SPEED, 0.0) * HCI_PI / 30.0;
    o->loop_bandwidth_Hz = cli_number_or(a, BANDWIDTH, 0.0);
    o->at_temperature = a->given[TEMPERATURE];
    o->temperature_C = cli_number_or(a, TEMPERATURE, 0.0);
    status = check_together(a, o->method, note);
    if (!status) status = cli_limits_take(OPTIONS, a, o, note);
    if (status || !a->value[FUNDAMENTAL]) return status;
    o->held = &in->held;
    return read_fundamental(a->value[FUNDAMENTAL], &in->held, note);
}

/* An input that stands in the output folder under the name of a result would be replaced by it. */
static hci_status keep_apart(const char *input, const char *folder, hci_note *note)
{
    char path[4096];
    if (!input || !folder) return HCI_OK;
    for (int k = 0; k < HCI_SOLUTION_FILES; ++k) {
        snprintf(path, sizeof path, "%s/%s", folder, hci_solution_file_name((hci_solution_file)k));
        if (cli_is_same_file(input, path))
            return hci_note_set(note, HCI_ERROR_ARGUMENT,
                                "%s would be replaced by a result of the same name; give another --out",
                                input);
    }
    return HCI_OK;
}

/* What a current loop cannot be made to follow is left out. */
static hci_status read_drive(const cli_arguments *a, inputs *in, hci_note *note)
{
    hci_drive_data drive;
    hci_status status = a->value[DRIVE] ? hci_drive_read(a->value[DRIVE], &drive, note) : HCI_OK;
    if (status || !a->value[DRIVE]) return status;
    hci_drive_remark_saliency(&drive, &in->machine, a->word[0], &in->drive_remark);
    hci_drive_remark_units(&drive, &in->machine, &in->drive_remark);
    status = hci_solve_for_drive(&drive, &in->machine, &in->options, &in->set, &in->drive_remark, note);
    hci_drive_release(&drive);
    return status;
}

static hci_status read_inputs(const cli_arguments *a, inputs *in, hci_note *note)
{
    hci_status status = read_options(a, in, note);
    if (!status) status = keep_apart(a->value[TARGET], a->value[OUT], note);
    if (!status) status = keep_apart(a->value[HARMONICS], a->value[OUT], note);
    const hci_order_base base = (hci_order_base)a->choice[ORDER_BASE];
    if (!status) status = hci_machine_read_orders(a->word[0], base, &in->machine, note);
    const hci_set_tables of = {in->machine.has_neutral, in->machine.model.pole_pairs, base};
    if (!status) status = check_link(a, &in->machine, note);
    if (!status) status = hci_effects_read_machine(a->word[0], &in->effects, note);
    if (!status) status = hci_uncertainty_read_machine(a->word[0], &in->uncertainty, note);
    if (!status)
        status = hci_target_read_orders(a->value[TARGET], base, of.pole_pairs, &in->target,
                                        &in->target_remark, note);
    if (!status && a->value[HARMONICS])
        status = hci_component_set_read_orders(a->value[HARMONICS], &of, &in->set, note);
    if (!status) status = read_drive(a, in, note);
    in->options.target = &in->target;
    in->options.effects = &in->effects.list;
    in->options.uncertainty = &in->uncertainty;
    in->options.set = a->value[HARMONICS] ? &in->set : NULL;
    in->options.progress = cli_progress;
    return status;
}

static void release_inputs(inputs *in)
{
    hci_machine_release(&in->machine);
    hci_effects_release(&in->effects);
    hci_uncertainty_release(&in->uncertainty);
    hci_target_release(&in->target);
    hci_component_set_release(&in->set);
}

static void remark_period(const inputs *in, const hci_solution *s)
{
    cli_remark_period(s->period_turns, in->machine.model.pole_pairs);
}

static void remark_temperature(const cli_arguments *a, const inputs *in)
{
    hci_note remark = {{0}};
    const bool is_used = hci_effects_needs(&in->effects.list) & HCI_EFFECT_NEEDS_TEMPERATURE;
    if (!a->given[TEMPERATURE] || is_used) return;
    hci_note_set(&remark, HCI_OK,
                 "--temperature changes nothing: effects.csv of the machine has no magnet_temperature");
    cli_remark(&remark);
}

static void show_remarks(const cli_arguments *a, const inputs *in, const hci_solution *s)
{
    remark_temperature(a, in);
    cli_remark(&in->machine.remark);
    cli_remark(&in->target_remark);
    cli_remark(&in->set.remark);
    cli_remark(&in->drive_remark);
    cli_remark(&s->remark);
    remark_period(in, s);
}

static int give_results(const cli_arguments *a, const inputs *in, const hci_solution *s, hci_status verdict)
{
    const hci_report_sources sources = {
        .machine = a->word[0], .target = a->value[TARGET], .harmonics = a->value[HARMONICS]};
    hci_note note = {{0}};
    hci_status status = HCI_OK;
    cli_progress_end();
    if (a->value[OUT])
        status = hci_solution_write_with_report(&in->machine, s, verdict, a->given[REPORT] ? &sources : NULL,
                                                a->value[OUT], &note);
    if (!status && cli_is_wordy()) cli_show_solution(s, a->word[0], a->value[TARGET]);
    if (!status) show_remarks(a, in, s);
    if (!status && a->given[JSON])
        status = cli_print_json(
            a->value[OUT] ? hci_summary_read(a->value[OUT]) : hci_solution_json(s, verdict), &note);
    return status ? cli_fail(status, &note) : hci_status_exit_code(verdict);
}

static int run(const cli_arguments *a)
{
    inputs in;
    hci_solution solution;
    hci_note note = {{0}};
    hci_status status;
    int exit_code;
    memset(&in, 0, sizeof in);
    status = read_inputs(a, &in, &note);
    if (!status) status = hci_solve(&in.machine, &in.options, &solution, &note);
    if (status > HCI_NOT_REACHED) {
        exit_code = cli_fail(status, &note);
    } else {
        exit_code = give_results(a, &in, &solution, status);
        hci_solution_release(&solution);
    }
    release_inputs(&in);
    return exit_code;
}

const cli_command cli_solve = {
    .name = "solve",
    .words = "MACHINE --target FILE",
    .does = "Finds the harmonic currents that make the machine produce the wanted torque spectrum.\n"
            "Writes currents.csv, waveform.csv, spectrum.csv, summary.json and solution.svg; "
            "with --report also report.html.",
    .options = OPTIONS,
    .words_needed = 1,
    .word_kind = CLI_FILE,
    .example =
        "  hci-solve solve data/machine_a --target data/scenarios/02/target.csv --auto -o out/machine_a\n"
        "  hci-solve solve data/machine_a --target data/scenarios/02/target.csv \\\n"
        "      --harmonics data/scenarios/02/harmonics.csv --fundamental 12,0.2 -o out/published\n"
        "\nExit codes: 0 reached; 1 not reached, the nearest is given; " CLI_EXIT_ERRORS,
    .source = "cli/solve.c",
    .run = run,
};
