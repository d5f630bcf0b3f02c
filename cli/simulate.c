#define _POSIX_C_SOURCE 200809L

#include <math.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>

#include "cli/command/command.h"
#include "cli/commands.h"
#include "cli/terminal/chart.h"
#include "cli/terminal/progress.h"
#include "cli/terminal/rows.h"
#include "cli/terminal/say.h"
#include "cli/terminal/terminal.h"
#include "cli/terminal/text.h"
#include "hci/host/report/summary.h"
#include "hci/host/report/write.h"

enum { CURRENTS, OUT, REPORT, CLI_COMMON_KEYS };

static const cli_option OPTIONS[] = {
    [CURRENTS] = {"currents", 0, CLI_FILE, "PATH",
                  .help = "impose these: currents.csv, or a folder that `solve` wrote"},
    [OUT] = {"out", 'o', CLI_FOLDER, "FOLDER", .help = "where the results go; without it nothing is written"},
    [REPORT] = {"report", 0, CLI_FLAG, NULL, .help = "report.html beside the results, for people"},
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

/* ---- words ---- */

static void show_torque(const hci_simulation *s)
{
    cli_say("  torque       mean %.6g N·m, %.6g to %.6g", s->torque_Nm.mean, s->torque_Nm.least,
            s->torque_Nm.most);
    if (isfinite(s->T_ripple_percent))
        cli_say("; T_ripple %.4g %%, F_ripple %.4g %%", s->T_ripple_percent, s->F_ripple_percent);
    cli_say("\n");
    cli_say("  current      mean %.4g A, rms %.4g, %.4g to %.4g (vector length); peak phase current %.4g A\n",
            s->current_A.mean, s->current_A.rms, s->current_A.least, s->current_A.most, s->peak_phase_A);
    cli_say("  in dq_x      mean %.4g A, rms %.4g, %.4g to %.4g\n", s->current_dqx_A.mean,
            s->current_dqx_A.rms, s->current_dqx_A.least, s->current_dqx_A.most);
}

static void show_loss(const hci_simulation *s)
{
    const bool watts = isfinite(s->copper_W), ratio = isfinite(s->loss_to_plain);
    if (!watts && !ratio) return;
    cli_say("  copper loss  ");
    if (watts) cli_say("%.4g W", s->copper_W);
    if (ratio)
        cli_say("%s%.4g × the plain fundamental of %.4g A", watts ? ", " : "", s->loss_to_plain,
                s->plain_amplitude_A);
    cli_say("\n");
}

static void show_control(const hci_simulation *s)
{
    if (isfinite(s->switching_frequency_Hz)) cli_say("  switching    %.4g Hz\n", s->switching_frequency_Hz);
    if (s->without_current > 0)
        cli_say("  no current   for the torque at %zu of %zu samples; the nearest was used\n",
                s->without_current, s->samples);
    if (s->limited > 0) cli_say("  limited      current at %zu of %zu samples\n", s->limited, s->samples);
    if (isfinite(s->energy_J.residual))
        cli_say("  energy       %.5g J in, %.5g J copper, %.5g J to the shaft; error %.2g J\n",
                s->energy_J.electrical, s->energy_J.copper, s->energy_J.mechanical, s->energy_J.residual);
}

/* ---- spectrum ---- */

typedef struct {
    const hci_simulation *simulation;
    double largest_Nm;
    size_t pick[CLI_MOST_ROWS];
} spectrum;

static double amplitude(hci_harmonic h)
{
    return h.order < HCI_ORDER_TOLERANCE ? 0.0 : hypot(h.sine, h.cosine);
}

static double before_Nm(const spectrum *s, double order)
{
    for (size_t k = 0; k < s->simulation->plain.order_count; ++k)
        if (fabs(s->simulation->plain.torque_Nm[k].order - order) < HCI_ORDER_TOLERANCE)
            return amplitude(s->simulation->plain.torque_Nm[k]);
    return 0.0;
}

static double largest_of(const void *context, size_t k)
{
    const spectrum *s = context;
    const hci_harmonic h = s->simulation->spectrum_Nm[k];
    return h.order < HCI_ORDER_TOLERANCE ? 0.0 : fmax(amplitude(h), before_Nm(s, h.order));
}

static void spectrum_row(const void *context, size_t row, cli_cell cell[])
{
    const spectrum *s = context;
    const hci_harmonic h = s->simulation->spectrum_Nm[s->pick[row]];
    snprintf(cell[0].text, sizeof cell[0].text, "%.5g", h.order);
    cli_number_text(amplitude(h), s->largest_Nm, cell[1].text, sizeof cell[1].text);
    cell[2].value = amplitude(h);
    if (s->simulation->plain.order_count == 0) return;
    cell[3] = cell[1];
    cell[4] = cell[2];
    cli_number_text(before_Nm(s, h.order), s->largest_Nm, cell[1].text, sizeof cell[1].text);
    cell[2].value = before_Nm(s, h.order);
}

static void show_spectrum(const hci_simulation *s)
{
    static const cli_column ALONE[] = {{CLI_RIGHT, "order"}, {CLI_RIGHT, "torque"}, {CLI_BAR, ""}};
    static const cli_column COMPARED[] = {
        {CLI_RIGHT, "order"}, {CLI_RIGHT, "before"}, {CLI_BAR, ""}, {CLI_RIGHT, "after"}, {CLI_BAR, ""}};
    const bool compared = s->plain.order_count > 0;
    char caption[256];
    spectrum x = {.simulation = s};
    const size_t rows = cli_pick(largest_of, &x, s->spectrum_count, 5e-3, x.pick, NULL);
    size_t length =
        (size_t)snprintf(caption, sizeof caption, "torque ripple by electrical order, N·m (peak)");
    for (size_t k = 0; k < rows; ++k)
        x.largest_Nm = fmax(x.largest_Nm, largest_of(&x, x.pick[k]));
    if (compared)
        snprintf(caption + length, sizeof caption - length,
                 "; before: the plain fundamental of %.4g A as it should flow, T_ripple %.4g %%",
                 s->plain_amplitude_A, s->plain.T_ripple_percent);
    cli_draw(&(cli_chart){.caption = caption,
                          .column = compared ? COMPARED : ALONE,
                          .columns = compared ? 5 : 3,
                          .rows = rows,
                          .fill = spectrum_row,
                          .context = &x,
                          .unit = "N·m"});
}

static void show(const hci_simulation *s, const cli_arguments *a)
{
    const bool doubtful = !s->energy_balances || s->limited > 0 || s->without_current > 0;
    cli_say("%ssimulated" CLI_PLAIN ": %s, %s\n", doubtful ? CLI_WARN : CLI_GOOD, a->word[0], a->word[1]);
    if (s->periods > 0)
        cli_say("  evaluated    %g s to %g s, %zu whole period%s at %.5g rpm (%.5g to %.5g)\n", s->from_s,
                s->to_s, s->periods, s->periods == 1 ? "" : "s", s->speed_rad_per_s.mean * 30.0 / HCI_PI,
                s->speed_rad_per_s.least * 30.0 / HCI_PI, s->speed_rad_per_s.most * 30.0 / HCI_PI);
    else
        cli_say("  evaluated    %g s to %g s, in which the rotor has not turned one period: no spectrum\n",
                s->from_s, s->to_s);
    show_torque(s);
    show_loss(s);
    show_control(s);
    show_spectrum(s);
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
        show(&simulation, a);
        cli_remark(&machine->remark);
        cli_remark(&simulation.remark);
    }
    if (!status && a->given[JSON]) status = cli_print_json(hci_simulation_json(&simulation), note);
    hci_simulation_release(&simulation);
    return status;
}

static int run(const cli_arguments *a)
{
    hci_machine_data machine;
    hci_effects_data effects = {{NULL, 0}, NULL, NULL};
    hci_scenario scenario;
    hci_note note = {{0}};
    hci_status status = HCI_OK;
    memset(&machine, 0, sizeof machine);
    if (a->given[REPORT] && !a->given[OUT])
        status =
            hci_note_set(&note, HCI_ERROR_ARGUMENT, "--report is written into a folder; add --out FOLDER");
    if (!status) status = hci_machine_read(a->word[0], &machine, &note);
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
    .words = "MACHINE SCENARIO",
    .does = "Runs the drive in time: machine, shaft, current and speed control, sensors.\n"
            "Writes trajectory.csv, spectrum.csv and summary.json; with --report also report.html.",
    .options = OPTIONS,
    .words_needed = 2,
    .word_kind = CLI_FILE,
    .example = "  hci-solve simulate data/machine_a data/drive/imposed.csv -o out/imposed\n"
               "  hci-solve simulate data/machine_c data/drive/filho_strategy_3.csv -o out/strategy_3\n"
               "\nExit codes: 0 done; " CLI_EXIT_ERRORS,
    .source = "cli/simulate.c",
    .guide = "simulate.md",
    .more_help = print_scenario_names,
    .run = run,
};
