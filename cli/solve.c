#define _POSIX_C_SOURCE 200809L

#include <math.h>
#include <stdio.h>
#include <string.h>
#include <sys/stat.h>

#include "cli/command/command.h"
#include "hci/host/base/number.h"
#include "hci/host/machine/effects.h"
#include "hci/host/report/summary.h"
#include "hci/host/report/write.h"
#include "hci/host/solve/solve.h"

enum {
    TARGET,
    HARMONICS,
    AUTO,
    FUNDAMENTAL,
    METHOD,
    STRATEGY,
    COMPARE,
    TOLERANCE,
    MAX_LOSS,
    LIMIT_CURRENT,
    LIMIT_VOLTAGE,
    SPEED,
    TEMPERATURE,
    OUT,
    REPORT,
    CLI_COMMON_KEYS
};

static const cli_option OPTIONS[] = {
    [TARGET] = {"target", 0, CLI_VALUE, "FILE", "wanted torque: order,amplitude_Nm,phase_rad[,weight]"},
    [HARMONICS] = {"harmonics", 0, CLI_VALUE, "FILE", "components to use: order,set (sym, asym, pos, neg)"},
    [AUTO] = {"auto", 0, CLI_COUNT_OPTIONAL, "K", "choose the components (default), at most K of them"},
    [FUNDAMENTAL] = {"fundamental", 0, CLI_VALUE, "A,RAD",
                     "hold the fundamental at peak amplitude and phase"},
    [METHOD] = {"method", 0, CLI_VALUE, "NAME", "auto, lu, umfpack, qr or pointwise"},
    [STRATEGY] = {"strategy", 0, CLI_VALUE, "NAME",
                  "of pointwise: id0, cancel (i_d cancels reluctance and cogging) or mtpa"},
    [COMPARE] = {"compare", 0, CLI_VALUE, "WHAT",
                 "all (default): every order reached; square: as many as unknowns"},
    [TOLERANCE] = {"tolerance", 0, CLI_VALUE, "SHARE",
                   "of the mean torque; an order within it is reached (1e-6)"},
    [MAX_LOSS] = {"max-loss", 0, CLI_VALUE, "RATIO", "with --auto K: copper over the pointwise limit (1.10)"},
    [LIMIT_CURRENT] = {"limit-current", 0, CLI_VALUE, "A",
                       "largest phase current; exit code 1 when it is exceeded"},
    [LIMIT_VOLTAGE] = {"limit-voltage", 0, CLI_VALUE, "V",
                       "dc-link voltage for the line voltages; with --speed"},
    [SPEED] = {"speed", 0, CLI_VALUE, "RPM", "mechanical speed for --limit-voltage"},
    [TEMPERATURE] = {"temperature", 0, CLI_VALUE, "C",
                     "of the magnets, for magnet_temperature in effects.csv"},
    [OUT] = {"out", 'o', CLI_VALUE, "FOLDER", "where the results go; without it nothing is written"},
    [REPORT] = {"report", 0, CLI_FLAG, NULL, "report.html beside the results, for people"},
    CLI_COMMON_OPTIONS};

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

static hci_status read_choices(const cli_arguments *a, hci_solve_options *o, hci_note *note)
{
    static const char *const METHODS[] = {"auto", "lu", "umfpack", "qr", "pointwise", NULL};
    static const char *const STRATEGIES[] = {"mtpa", "id0", "cancel", NULL};
    static const char *const COMPARES[] = {"all", "square", NULL};
    int choice = 0;
    hci_status status = HCI_OK;
    if (a->value[METHOD]) status = cli_choice("method", a->value[METHOD], METHODS, &choice, note);
    o->method = (hci_method)choice;
    choice = 0;
    if (!status && a->value[STRATEGY])
        status = cli_choice("strategy", a->value[STRATEGY], STRATEGIES, &choice, note);
    o->strategy = (hci_strategy)choice;
    choice = 0;
    if (!status && a->value[COMPARE])
        status = cli_choice("compare", a->value[COMPARE], COMPARES, &choice, note);
    o->compare = (hci_compare)choice;
    if (status) return status;
    if (a->given[HARMONICS] && (a->given[AUTO] || o->method == HCI_METHOD_POINTWISE))
        return hci_note_set(note, HCI_ERROR_ARGUMENT,
                            "--harmonics names the components; leave out --auto or --method pointwise");
    if (a->given[AUTO] && o->method != HCI_METHOD_AUTO)
        return hci_note_set(note, HCI_ERROR_ARGUMENT, "--auto chooses the method too; leave out --method");
    if (a->given[MAX_LOSS] && !a->value[AUTO])
        return hci_note_set(note, HCI_ERROR_ARGUMENT, "--max-loss goes with --auto K");
    if (a->given[STRATEGY] && o->method != HCI_METHOD_POINTWISE)
        return hci_note_set(note, HCI_ERROR_ARGUMENT,
                            "--strategy works angle by angle; add --method pointwise");
    if (!a->given[HARMONICS] &&
        (a->given[COMPARE] || o->method == HCI_METHOD_LU || o->method == HCI_METHOD_UMFPACK))
        return hci_note_set(note, HCI_ERROR_ARGUMENT,
                            "--compare and --method lu or umfpack need a set: --harmonics FILE");
    return HCI_OK;
}

static hci_status read_limits(const cli_arguments *a, hci_solve_options *o, hci_note *note)
{
    double speed_rpm = 0.0;
    hci_status status = HCI_OK;
    if (a->given[LIMIT_VOLTAGE] != a->given[SPEED])
        return hci_note_set(note, HCI_ERROR_ARGUMENT, "solve: --limit-voltage and --speed go together");
    if (a->value[LIMIT_CURRENT])
        status = cli_number("limit-current", a->value[LIMIT_CURRENT], 1e-9, 1e9, &o->limit_current_A, note);
    if (!status && a->value[LIMIT_VOLTAGE])
        status = cli_number("limit-voltage", a->value[LIMIT_VOLTAGE], 1e-9, 1e9, &o->limit_voltage_V, note);
    if (!status && a->value[SPEED])
        status = cli_number("speed", a->value[SPEED], -1e7, 1e7, &speed_rpm, note);
    o->speed_rad_per_s = speed_rpm * HCI_PI / 30.0;
    return status;
}

static hci_status read_numbers(const cli_arguments *a, hci_solve_options *o, hci_wave *held, hci_note *note)
{
    double count = 0.0;
    hci_status status = HCI_OK;
    if (a->value[AUTO]) status = cli_number("auto", a->value[AUTO], 1.0, 1e4, &count, note);
    if (!status && count != floor(count))
        status = hci_note_set(note, HCI_ERROR_ARGUMENT, "--auto: found `%s`, expected a whole number",
                              a->value[AUTO]);
    if (!status && a->value[TOLERANCE])
        status = cli_number("tolerance", a->value[TOLERANCE], 1e-14, 1.0, &o->tolerance, note);
    if (!status && a->value[MAX_LOSS])
        status = cli_number("max-loss", a->value[MAX_LOSS], 1.0, 1e6, &o->loss_allowance, note);
    if (!status) status = read_limits(a, o, note);
    if (!status && a->value[TEMPERATURE]) {
        status = cli_number("temperature", a->value[TEMPERATURE], -273.15, 1e4, &o->temperature_C, note);
        o->at_temperature = true;
    }
    if (!status && a->value[FUNDAMENTAL]) {
        status = read_fundamental(a->value[FUNDAMENTAL], held, note);
        o->held = held;
    }
    o->choose_at_most = (size_t)count;
    if (!status && !a->value[TARGET])
        status =
            hci_note_set(note, HCI_ERROR_ARGUMENT, "solve: the wanted torque is missing; add --target FILE");
    return status;
}

/* Everything that is read, in one place so that it is released in one place. */
typedef struct {
    hci_machine_data machine;
    hci_effects_data effects;
    hci_target target;
    hci_component_set set;
    hci_wave held;
    hci_solve_options options;
} inputs;

/* An input that stands in the output folder under the name of a result would be replaced by it. */
static hci_status keep_apart(const char *input, const char *folder, hci_note *note)
{
    static const char *const RESULTS[] = {"currents.csv", "currents_per_Nm.csv", "currents_constant.csv",
                                          "spectrum.csv", "waveform.csv"};
    struct stat from, to;
    char path[4096];
    if (!input || !folder || stat(input, &from) != 0) return HCI_OK;
    for (size_t k = 0; k < sizeof RESULTS / sizeof RESULTS[0]; ++k) {
        snprintf(path, sizeof path, "%s/%s", folder, RESULTS[k]);
        if (stat(path, &to) == 0 && to.st_dev == from.st_dev && to.st_ino == from.st_ino)
            return hci_note_set(note, HCI_ERROR_ARGUMENT,
                                "%s would be replaced by a result of the same name; give another --out",
                                input);
    }
    return HCI_OK;
}

static hci_status read_inputs(const cli_arguments *a, inputs *in, hci_note *note)
{
    hci_status status = HCI_OK;
    if (a->given[REPORT] && !a->given[OUT])
        status =
            hci_note_set(note, HCI_ERROR_ARGUMENT, "--report is written into a folder; add --out FOLDER");
    if (!status) status = read_choices(a, &in->options, note);
    if (!status) status = read_numbers(a, &in->options, &in->held, note);
    if (!status) status = keep_apart(a->value[TARGET], a->value[OUT], note);
    if (!status) status = keep_apart(a->value[HARMONICS], a->value[OUT], note);
    if (!status) status = hci_machine_read(a->word[0], &in->machine, note);
    if (!status) status = hci_effects_read_machine(a->word[0], &in->effects, note);
    if (!status) status = hci_target_read(a->value[TARGET], &in->target, note);
    if (!status && a->value[HARMONICS])
        status = hci_component_set_read(a->value[HARMONICS], in->machine.has_neutral, &in->set, note);
    in->options.target = &in->target;
    in->options.effects = &in->effects.list;
    in->options.set = a->value[HARMONICS] ? &in->set : NULL;
    in->options.progress = cli_progress;
    return status;
}

static void release_inputs(inputs *in)
{
    hci_machine_release(&in->machine);
    hci_effects_release(&in->effects);
    hci_target_release(&in->target);
    hci_component_set_release(&in->set);
}

static hci_status print_json(const hci_solution *s, hci_status verdict, hci_note *note)
{
    char *json = hci_solution_json(s, verdict);
    if (!json) return hci_note_set(note, HCI_ERROR_MEMORY, "out of memory for the summary");
    puts(json);
    hci_text_free(json);
    return HCI_OK;
}

static void remark_period(const inputs *in, const hci_solution *s)
{
    hci_note remark = {{0}};
    if ((size_t)in->machine.model.pole_pairs % s->period_turns == 0) return;
    hci_note_set(
        &remark, HCI_OK,
        "everything repeats after %zu electrical turns only, which is no part of the mechanical turn of %d; "
        "a rotor angle cannot drive it",
        s->period_turns, in->machine.model.pole_pairs);
    cli_remark(&remark);
}

static void show_remarks(const inputs *in, const hci_solution *s)
{
    cli_remark(&in->machine.remark);
    cli_remark(&in->set.remark);
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
    if (!status) show_remarks(in, s);
    if (!status && a->given[JSON]) status = print_json(s, verdict, &note);
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
    if (!status) {
        status = hci_solve(&in.machine, &in.options, &solution, &note);
        if (status <= HCI_NOT_REACHED) {
            exit_code = give_results(a, &in, &solution, status);
            hci_solution_release(&solution);
        } else {
            exit_code = cli_fail(status, &note);
        }
    } else {
        exit_code = cli_fail(status, &note);
    }
    release_inputs(&in);
    return exit_code;
}

const cli_command cli_solve = {
    "solve",
    "MACHINE --target FILE",
    "Finds the harmonic currents that make the machine produce the wanted torque spectrum.\n"
    "Writes currents.csv, waveform.csv, spectrum.csv, summary.json and solution.svg;\n"
    "with --report also report.html.",
    OPTIONS,
    1,
    "  hci-solve solve data/machine_a --target data/scenarios/02/target.csv --auto -o out/machine_a\n"
    "  hci-solve solve data/machine_a --target data/scenarios/02/target.csv \\\n"
    "      --harmonics data/scenarios/02/harmonics.csv --fundamental 12,0.2 -o out/published\n"
    "\nExit codes: 0 reached; 1 not reached, the nearest is given; " CLI_EXIT_ERRORS,
    run};
