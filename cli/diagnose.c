#define _POSIX_C_SOURCE 200809L

#include <math.h>
#include <stdio.h>
#include <string.h>
#include <sys/stat.h>

#include "cli.h"
#include "hci/host/diagnose.h"

enum { RUNS, OUT, TARGET, RESOLUTION, JSON, QUIET, HELP };

static const cli_option OPTIONS[] = {
    [RUNS] = {"runs",       0,   CLI_VALUE, "LIST",    "table file,role: the recordings to fit and those held out"},
    [OUT] = {"out",        'o', CLI_VALUE, "FOLDER",  "where the results go; without it nothing is written"      },
    [TARGET] = {"target",     0,   CLI_VALUE, "FILE",
              "wanted torque: solve the currents again for the corrected machine"                                 },
    [RESOLUTION] = {"resolution", 0,   CLI_VALUE, "PERCENT",
              "of the largest torque; what the model need not be better than [0.05]"                              },
    [JSON] = {"json",       0,   CLI_FLAG,  NULL,      "the summary as JSON on standard output"                   },
    [QUIET] = {"quiet",      'q', CLI_FLAG,  NULL,      "no words, only errors"                                    },
    [HELP] = {"help",       'h', CLI_FLAG,  NULL,      "this text"                                                },
    {NULL,         0,   CLI_FLAG,  NULL,      NULL                                                       },
};

typedef struct {
    hci_machine_data machine;
    hci_effects_data declared;
    hci_runs runs;
    hci_target target;
    hci_diagnose_options options;
} inputs;

/* The machine that is read would be replaced by the corrected one. */
static hci_status keep_apart(const char *machine, const char *folder, hci_note *note)
{
    struct stat from, to;
    char path[4096];
    if (!folder || snprintf(path, sizeof path, "%s/machine", folder) >= (int)sizeof path) return HCI_OK;
    if (stat(machine, &from) != 0 || stat(path, &to) != 0 || from.st_dev != to.st_dev ||
        from.st_ino != to.st_ino)
        return HCI_OK;
    return hci_note_set(note, HCI_ERROR_ARGUMENT,
                        "%s would be replaced by a result of the same name; give another --out", machine);
}

static hci_status read_inputs(const cli_arguments *a, inputs *in, hci_note *note)
{
    hci_status status = HCI_OK;
    double percent = 0.0;
    if (!a->value[RUNS])
        return hci_note_set(note, HCI_ERROR_ARGUMENT,
                            "diagnose: the recordings are missing; add --runs LIST");
    status = keep_apart(a->word[0], a->value[OUT], note);
    if (!status && a->value[RESOLUTION])
        status = cli_number("resolution", a->value[RESOLUTION], 1e-6, 50.0, &percent, note);
    in->options.resolution = percent / 100.0;
    in->options.progress = a->given[QUIET] ? NULL : cli_progress;
    if (!status && a->value[TARGET]) status = hci_target_read(a->value[TARGET], &in->target, note);
    if (!status) status = hci_machine_read(a->word[0], &in->machine, note);
    if (!status) status = hci_effects_read_machine(a->word[0], &in->declared, note);
    if (!status)
        status = hci_runs_read(a->value[RUNS], in->machine.model.pole_pairs, in->machine.inertia_kgm2,
                               &in->runs, in->options.progress, NULL, note);
    return status;
}

static void release_inputs(inputs *in)
{
    hci_machine_release(&in->machine);
    hci_effects_release(&in->declared);
    hci_runs_release(&in->runs);
    hci_target_release(&in->target);
}

/* ---- words ---- */

/* A long text in lines, indented. */
static void show_text(const char *text)
{
    enum { WIDTH = 96 };
    while (*text != '\0') {
        size_t length = strlen(text);
        if (length > WIDTH) {
            length = WIDTH;
            while (length > 1 && text[length] != ' ')
                --length;
        }
        fprintf(stderr, "  %.*s\n", (int)length, text);
        text += length;
        while (*text == ' ')
            ++text;
    }
}

static void show_findings(const hci_diagnosis *d)
{
    for (size_t k = 0; k < d->findings; ++k) {
        const hci_finding *f = &d->finding[k];
        if (f->verdict == HCI_FINDING_REJECTED) continue;
        fprintf(stderr, "  %-12s %s: %s\n", hci_finding_verdict_name(f->verdict), f->effect, f->detail);
        fprintf(stderr, "               ΔBIC %.4g", f->delta_bic);
        if (isfinite(f->residual_share))
            fprintf(stderr, "; explains %.3g %% of the mean square of the residual",
                    100.0 * f->residual_share);
        fputc('\n', stderr);
    }
}

static void show_runs(const hci_diagnosis *d)
{
    fprintf(stderr,
            "  run                           role     mean/N·m   rms before    after      noise/N·m\n");
    for (size_t k = 0; k < d->runs; ++k) {
        const hci_run_errors *e = &d->run[k];
        const size_t length = strlen(e->file);
        fprintf(stderr, "  %-29s %-8s %-10.4g %-12.4g  %-9.4g  %.4g\n",
                length > 29 ? e->file + length - 29 : e->file, e->role == HCI_ROLE_FIT ? "fit" : "holdout",
                e->mean_torque_Nm, e->rms_before_Nm, e->rms_after_Nm, e->noise_floor_Nm);
    }
    for (size_t k = 0; k < d->runs; ++k)
        if (d->run[k].slip_rad != 0.0)
            fprintf(stderr,
                    "  index slip   %s: its mechanical angle is %.4g° ahead of that of the others; turned "
                    "back here\n",
                    d->run[k].file, d->run[k].slip_rad * 180.0 / HCI_PI);
}

static void show_resolution(const hci_resolution *r)
{
    fprintf(stderr,
            "  old currents on the corrected machine: mean %.4g N·m, rms error %.3g N·m, T_ripple %.3g %%\n"
            "  new currents:                          mean %.4g N·m, rms error %.3g N·m, T_ripple %.3g %%, "
            "copper "
            "%.3f × the old\n",
            r->old_currents.mean_Nm, r->old_currents.rms_error_Nm, r->old_currents.T_ripple_percent,
            r->new_currents.mean_Nm, r->new_currents.rms_error_Nm, r->new_currents.T_ripple_percent,
            r->after.mean_square_A2 / r->before.mean_square_A2);
}

static void show(const hci_diagnosis *d, const hci_resolution *r, const cli_arguments *a)
{
    char words[2048];
    hci_diagnosis_words(d, words, sizeof words);
    fprintf(stderr, "diagnosed: %s, %s: %s\n", a->word[0], a->value[RUNS],
            hci_diagnosis_verdict_name(d->verdict));
    show_text(words);
    show_findings(d);
    show_runs(d);
    if (d->advice[0]) {
        fprintf(stderr, "  measure next:\n");
        show_text(d->advice);
    }
    if (r) show_resolution(r);
}

/* ---- the command ---- */

static hci_status print_json(const hci_diagnosis *d, const hci_resolution *r, hci_note *note)
{
    char *json = hci_diagnosis_json(d, r);
    if (!json) return hci_note_set(note, HCI_ERROR_MEMORY, "out of memory for the summary");
    puts(json);
    hci_text_free(json);
    return HCI_OK;
}

static hci_status write_results(const cli_arguments *a, const inputs *in, const hci_diagnosis *d,
                                const hci_resolution *r, hci_note *note)
{
    char folder[4096];
    hci_status status = hci_diagnosis_write(d, r, &in->runs, a->word[0], a->value[OUT], note);
    if (status || !r) return status;
    if (snprintf(folder, sizeof folder, "%s/solution", a->value[OUT]) >= (int)sizeof folder)
        return hci_note_set(note, HCI_ERROR_OUTPUT, "%.200s…: the path is too long", a->value[OUT]);
    return hci_solution_write_with_report(
        &in->machine, &r->after, r->after_status,
        &(hci_report_sources){.machine = a->word[0], .target = a->value[TARGET]}, folder, note);
}

static int give_results(const cli_arguments *a, const inputs *in, const hci_diagnosis *d,
                        const hci_resolution *r, hci_status verdict)
{
    hci_note note = {{0}};
    hci_status status = HCI_OK;
    cli_progress_end();
    if (!a->given[QUIET]) cli_remark(&in->machine.remark);
    for (size_t k = 0; k < in->runs.count && !a->given[QUIET]; ++k)
        cli_remark(&in->runs.run[k].remark);
    if (a->value[OUT]) status = write_results(a, in, d, r, &note);
    if (!status && !a->given[QUIET]) show(d, r, a);
    if (!status && a->given[JSON]) status = print_json(d, r, &note);
    return status ? cli_fail(status, &note) : hci_status_exit_code(verdict);
}

/* What was found, and where it was wanted the currents for it. */
static int solve_and_give(const cli_arguments *a, const inputs *in, const hci_diagnosis *d,
                          hci_status verdict)
{
    const hci_solve_options how = {.target = &in->target, .progress = in->options.progress};
    hci_resolution resolution;
    hci_note note = {{0}};
    int exit_code;
    if (!a->value[TARGET]) return give_results(a, in, d, NULL, verdict);
    const hci_status status =
        hci_diagnosis_resolve(&in->machine, &in->declared.list, d, &how, &resolution, &note);
    if (status > HCI_NOT_REACHED) return cli_fail(status, &note);
    exit_code = give_results(a, in, d, &resolution, verdict ? verdict : status);
    hci_resolution_release(&resolution);
    return exit_code;
}

static int run(const cli_arguments *a)
{
    inputs in;
    hci_diagnosis diagnosis;
    hci_note note = {{0}};
    hci_status status;
    int exit_code;
    memset(&in, 0, sizeof in);
    status = read_inputs(a, &in, &note);
    if (!status)
        status = hci_diagnose(&in.machine, &in.declared.list, &in.runs, &in.options, &diagnosis, &note);
    if (status <= HCI_NOT_REACHED) {
        exit_code = solve_and_give(a, &in, &diagnosis, status);
        hci_diagnosis_release(&diagnosis);
    } else {
        exit_code = cli_fail(status, &note);
    }
    release_inputs(&in);
    return exit_code;
}

const cli_command cli_diagnose = {
    "diagnose",
    "MACHINE --runs LIST",
    "Finds what the model of the machine lacks to describe recordings, and corrects it.\n"
    "Writes machine/, effects.csv, errors.csv, residual_spectrum.csv, summary.json, report.html and, with\n"
    "--target, solution/.",
    OPTIONS,
    1,
    "  hci-solve diagnose data/fem_c/machine --runs data/fem_c/runs.csv -o out/diagnosed\n"
    "\nExit codes: 0 explained, or nothing is missing; 1 ambiguous or not explained; 2 command line; 3 "
    "input; "
    "4 numerical; 5 output\n",
    run};
