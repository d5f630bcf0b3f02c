#include <math.h>
#include <stdio.h>
#include <string.h>

#include "cli.h"
#include "hci/host/simulate.h"

enum { CURRENTS, OUT, REPORT, JSON, QUIET, HELP };

static const cli_option OPTIONS[] = {
    [CURRENTS] = {"currents", 0,   CLI_VALUE, "PATH",
                  "impose these: currents.csv, or a folder that `solve` wrote"                               },
    [OUT] = {"out",      'o', CLI_VALUE, "FOLDER", "where the results go; without it nothing is written"},
    [REPORT] = {"report",   0,   CLI_FLAG,  NULL,     "report.html beside the results, for people"         },
    [JSON] = {"json",     0,   CLI_FLAG,  NULL,     "the summary as JSON on standard output"             },
    [QUIET] = {"quiet",    'q', CLI_FLAG,  NULL,     "no words, only errors"                              },
    [HELP] = {"help",     'h', CLI_FLAG,  NULL,     "this text"                                          },
    {NULL,       0,   CLI_FLAG,  NULL,     NULL                                                 },
};

/* ---- help ---- */

static void print_name(const char *name, const char *unit, const char *fallback, const char *what)
{
    if (what[0] == '\0') return;
    printf("  %-24s %-12s %s%s%s%s\n", name, strcmp(unit, "count") == 0 || strcmp(unit, "1") == 0 ? "" : unit,
           what, fallback[0] ? " [" : "", fallback, fallback[0] ? "]" : "");
}

void cli_print_scenario_names(void)
{
    printf("\nA scenario is a table name,value,unit. Its names, units and [defaults]\n");
#define PRINT_WORD(name, choices, fallback, what) print_name(name, "", fallback, what ": " choices);
    HCI_SCENARIO_WORDS(PRINT_WORD)
#undef PRINT_WORD
#define PRINT_VALUE(field, name, unit, low, high, fallback, what) print_name(name, unit, fallback, what);
    HCI_SCENARIO_VALUES(PRINT_VALUE)
#undef PRINT_VALUE
}

/* ---- words ---- */

static void show_torque(const hci_simulation *s)
{
    fprintf(stderr, "  torque       mean %.6g N·m, %.6g to %.6g", s->torque_Nm.mean, s->torque_Nm.least,
            s->torque_Nm.most);
    if (isfinite(s->T_ripple_percent))
        fprintf(stderr, "; T_ripple %.4g %%, F_ripple %.4g %%", s->T_ripple_percent, s->F_ripple_percent);
    fputc('\n', stderr);
    fprintf(stderr,
            "  current      mean %.4g A, rms %.4g, %.4g to %.4g (vector length); peak phase current %.4g A\n",
            s->current_A.mean, s->current_A.rms, s->current_A.least, s->current_A.most, s->peak_phase_A);
    fprintf(stderr, "  in dq_x      mean %.4g A, rms %.4g, %.4g to %.4g\n", s->current_dqx_A.mean,
            s->current_dqx_A.rms, s->current_dqx_A.least, s->current_dqx_A.most);
}

static void show_loss(const hci_simulation *s)
{
    const bool watts = isfinite(s->copper_W), ratio = isfinite(s->loss_to_plain);
    if (!watts && !ratio) return;
    fprintf(stderr, "  copper loss  ");
    if (watts) fprintf(stderr, "%.4g W", s->copper_W);
    if (ratio)
        fprintf(stderr, "%s%.4g × the plain fundamental of %.4g A", watts ? ", " : "", s->loss_to_plain,
                s->plain_amplitude_A);
    fputc('\n', stderr);
}

static void show_control(const hci_simulation *s)
{
    if (isfinite(s->switching_frequency_Hz))
        fprintf(stderr, "  switching    %.4g Hz\n", s->switching_frequency_Hz);
    if (s->without_current > 0)
        fprintf(stderr, "  no current   for the torque at %zu of %zu samples; the nearest was used\n",
                s->without_current, s->samples);
    if (s->limited > 0)
        fprintf(stderr, "  limited      current at %zu of %zu samples\n", s->limited, s->samples);
    if (isfinite(s->energy_J.residual))
        fprintf(stderr, "  energy       %.5g J in, %.5g J copper, %.5g J to the shaft; error %.2g J\n",
                s->energy_J.electrical, s->energy_J.copper, s->energy_J.mechanical, s->energy_J.residual);
}

static void show(const hci_simulation *s, const cli_arguments *a)
{
    fprintf(stderr, "simulated: %s, %s\n", a->word[0], a->word[1]);
    if (s->periods > 0)
        fprintf(stderr, "  evaluated    %g s to %g s, %zu whole period%s at %.5g rpm (%.5g to %.5g)\n",
                s->from_s, s->to_s, s->periods, s->periods == 1 ? "" : "s",
                s->speed_rad_per_s.mean * 30.0 / HCI_PI, s->speed_rad_per_s.least * 30.0 / HCI_PI,
                s->speed_rad_per_s.most * 30.0 / HCI_PI);
    else
        fprintf(stderr,
                "  evaluated    %g s to %g s, in which the rotor has not turned one period: no spectrum\n",
                s->from_s, s->to_s);
    show_torque(s);
    show_loss(s);
    show_control(s);
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

static hci_status print_json(const hci_simulation *s, hci_note *note)
{
    char *json = hci_simulation_json(s);
    if (!json) return hci_note_set(note, HCI_ERROR_MEMORY, "out of memory for the summary");
    puts(json);
    hci_text_free(json);
    return HCI_OK;
}

static hci_status simulate(const cli_arguments *a, const hci_machine_data *machine,
                           const hci_effects *effects, const hci_scenario *scenario, hci_note *note)
{
    const hci_simulate_options options = {a->value[OUT], effects, a->given[QUIET] ? NULL : cli_progress,
                                          NULL};
    const hci_report_sources sources = {.machine = a->word[0],
                                        .scenario = a->word[1],
                                        .currents = scenario->currents[0] ? scenario->currents : NULL};
    hci_simulation simulation;
    hci_status status = hci_simulate_with_report(machine, scenario, &options,
                                                 a->given[REPORT] ? &sources : NULL, &simulation, note);
    cli_progress_end();
    if (!status && !a->given[QUIET]) {
        cli_remark(&machine->remark);
        cli_remark(&simulation.remark);
        show(&simulation, a);
    }
    if (!status && a->given[JSON]) status = print_json(&simulation, note);
    hci_simulation_release(&simulation);
    return status;
}

static int run(const cli_arguments *a)
{
    hci_machine_data machine;
    hci_effects_data effects = {
        {NULL, 0},
        NULL, NULL
    };
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
    "simulate",
    "MACHINE SCENARIO",
    "Runs the drive in time: machine, shaft, current and speed control, sensors.\n"
    "Writes trajectory.csv, spectrum.csv and summary.json; with --report also report.html.",
    OPTIONS,
    2,
    "  hci-solve simulate data/machine_a data/drive/imposed.csv -o out/imposed\n"
    "  hci-solve simulate data/machine_c data/drive/filho_strategy_3.csv -o out/strategy_3\n"
    "\nExit codes: 0 done; 2 command line; 3 input; 4 numerical; 5 output\n",
    run};
