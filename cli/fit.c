#include <math.h>
#include <string.h>

#include "cli/command/command.h"
#include "cli/command/reading.h"
#include "cli/commands.h"
#include "cli/terminal/say.h"
#include "cli/terminal/terminal.h"
#include "cli/terminal/text.h"
#include "hci/host/fleet/fit.h"
#include "hci/host/report/summary.h"

enum { RUNS, LIMITS, OUT, CLI_READING_KEYS, CLI_COMMON_KEYS };

static const cli_option OPTIONS[] = {
    [RUNS] = {"runs", 0, CLI_FILE, "LIST", .help = "table file,role: the recordings to fit"},
    [LIMITS] = {"limits", 0, CLI_FILE, "FILE",
                .help = "table effect,parameter,low,high: pass or fail, such as line.csv of fleet"},
    [OUT] = {"out", 'o', CLI_FOLDER, "FOLDER", .help = "where the results go; without it nothing is written"},
    CLI_READING_OPTIONS,
    CLI_COMMON_OPTIONS};

typedef struct {
    hci_machine_data machine;
    hci_effects_data declared;
    hci_runs runs;
    cli_reading reading;
} inputs;

static hci_status read_all(const cli_arguments *a, inputs *in, hci_note *note)
{
    if (!a->value[RUNS])
        return hci_note_set(note, HCI_ERROR_ARGUMENT, "fit: the recordings are missing; add --runs LIST");
    hci_status status = cli_reading_take(a, a->given[STRICT], a->value[ANGLE_OFFSET], &in->reading, note);
    if (!status) status = hci_machine_read(a->word[0], &in->machine, note);
    if (!status) status = hci_effects_read_machine(a->word[0], &in->declared, note);
    if (status) return status;
    in->reading.run.pole_pairs = in->machine.model.pole_pairs;
    const hci_runs_options reading = {in->reading.run, NULL, NULL};
    return hci_runs_read(a->value[RUNS], &reading, &in->runs, note);
}

static void release(inputs *in)
{
    hci_machine_release(&in->machine);
    hci_effects_release(&in->declared);
    hci_runs_release(&in->runs);
    cli_reading_release(&in->reading);
}

static void show(const cli_arguments *a, const hci_fleet_fit *fit)
{
    cli_say("%s" CLI_PLAIN ": %s, %s\n", fit->is_found ? CLI_GOOD "fitted" : CLI_WARN "not fitted",
            a->word[0], a->value[RUNS]);
    cli_say("  error        %.4g N·m rms as declared", fit->rms_before_Nm);
    if (fit->is_found) cli_say(", %.4g N·m fitted", fit->rms_after_Nm);
    cli_say("; %zu samples\n", fit->samples);
    if (fit->judged > 0)
        cli_say("  %s" CLI_PLAIN "         %zu of %zu parameters are outside of their limits\n",
                fit->beyond ? CLI_BAD "fail" : CLI_GOOD "pass", fit->beyond, fit->judged);
    for (size_t k = 0; k < fit->count; ++k) {
        const hci_fleet_parameter *p = &fit->parameter[k];
        if (isnan(p->value))
            cli_say("  %s %s: not told by these recordings\n", p->effect, p->parameter);
        else
            cli_say("  %s %s: %+.4g ± %.2g %s\n", p->effect, p->parameter, p->value, p->std_error,
                    strcmp(p->unit, "1") == 0 ? "" : p->unit);
    }
}

static const hci_note *remark_of_run(const void *context, size_t k)
{
    return &((const inputs *)context)->runs.run[k].remark;
}

static hci_status fit_and_give(const cli_arguments *a, const inputs *in, hci_fleet_fit *fit, hci_note *note)
{
    hci_status status = hci_fleet_fit_runs(&in->machine, &in->declared.list, &in->runs, fit, note);
    if (!status && a->value[LIMITS]) status = hci_fleet_fit_judge(a->value[LIMITS], fit, note);
    if (!status && a->value[OUT]) status = hci_fleet_fit_write(fit, a->value[OUT], note);
    if (status) return status;
    if (cli_is_wordy()) show(a, fit);
    cli_remark(&in->machine.remark);
    cli_remark_each(remark_of_run, in, in->runs.count);
    cli_remark(&fit->remark);
    if (!a->given[JSON]) return HCI_OK;
    return cli_print_json(a->value[OUT] ? hci_summary_read(a->value[OUT]) : hci_fleet_fit_json(fit), note);
}

static int run(const cli_arguments *a)
{
    inputs in;
    hci_note note = {{0}};
    memset(&in, 0, sizeof in);
    hci_status status = read_all(a, &in, &note);
    hci_fleet_fit fit;
    if (!status) status = fit_and_give(a, &in, &fit, &note);
    release(&in);
    return status ? cli_fail(status, &note) : !fit.is_found || fit.beyond > 0;
}

const cli_command cli_fit = {
    .name = "fit",
    .words = "MACHINE --runs LIST",
    .does = "Fits the same few parameters to the recordings of any motor of a make, so that motors can be "
            "compared.\n"
            "Writes parameters.csv, by how much each differs from what MACHINE declares, and summary.json.",
    .options = OPTIONS,
    .words_needed = 1,
    .word_kind = CLI_FILE,
    .example = "  hci-solve fit data/fem_c/machine --runs data/fem_c/runs.csv -o out/fitted\n"
               "\nExit codes: 0 done; 1 no least error is found, the declared values stay, or a\nparameter "
               "is outside of its limits; " CLI_EXIT_ERRORS,
    .source = "cli/fit.c",
    .guide = "fleet.md",
    .run = run,
};
