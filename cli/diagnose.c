#define _POSIX_C_SOURCE 200809L

#include <math.h>
#include <stdio.h>
#include <string.h>
#include <sys/stat.h>

#include "cli/command/command.h"
#include "cli/command/parse.h"
#include "cli/commands.h"
#include "cli/terminal/chart.h"
#include "cli/terminal/progress.h"
#include "cli/terminal/rows.h"
#include "cli/terminal/say.h"
#include "cli/terminal/terminal.h"
#include "cli/terminal/text.h"
#include "hci/host/diagnose/diagnose.h"
#include "hci/host/report/summary.h"
#include "hci/host/report/write.h"

enum { RUNS, OUT, TARGET, RESOLUTION, REPORT, CLI_COMMON_KEYS };

static const cli_option OPTIONS[] = {
    [RUNS] = {"runs", 0, CLI_FILE, "LIST",
              .help = "table file,role: the recordings to fit and those held out"},
    [OUT] = {"out", 'o', CLI_FOLDER, "FOLDER", .help = "where the results go; without it nothing is written"},
    [TARGET] = {"target", 0, CLI_FILE, "FILE",
                .help = "wanted torque: solve the currents again for the corrected machine"},
    [RESOLUTION] = {"resolution", 0, CLI_NUMBER, "PERCENT",
                    .help = "of the largest torque; what the model need not be better than [0.05]",
                    .low = 1e-6, .high = 50.0},
    [REPORT] = {"report", 0, CLI_FLAG, NULL,
                .help = "report.html is written in any case; taken for the sake of scripts"},
    CLI_COMMON_OPTIONS};

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
    if (!a->value[RUNS])
        return hci_note_set(note, HCI_ERROR_ARGUMENT,
                            "diagnose: the recordings are missing; add --runs LIST");
    status = keep_apart(a->word[0], a->value[OUT], note);
    in->options.resolution = cli_number_or(a, RESOLUTION, 0.0) / 100.0;
    in->options.progress = cli_progress;
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

enum { MOST_TERMS = 3 }; /* of an effect that are shown */

static size_t terms_of(const hci_diagnosis *d, const char *effect)
{
    for (size_t k = 0; k < d->effects.list.count; ++k)
        if (strcmp(d->effects.list.effect[k].type->name, effect) == 0) return d->effects.list.effect[k].count;
    return 0;
}

/* Bytes up to the end of so many parts of a text that are divided by semicolons. */
static size_t parts_length(const char *text, size_t parts)
{
    size_t length = 0;
    for (; parts > 0 && text[length]; --parts) {
        length += length > 0;
        length += strcspn(text + length, ";");
    }
    return length;
}

static void show_finding(const hci_diagnosis *d, const hci_finding *f)
{
    const size_t terms = terms_of(d, f->effect), length = parts_length(f->detail, MOST_TERMS);
    cli_say("  %-12s %s: %.*s", hci_finding_verdict_name(f->verdict), f->effect, (int)length, f->detail);
    if (f->detail[length] && terms > MOST_TERMS) cli_say("; and %zu more", terms - MOST_TERMS);
    cli_say("\n");
}

static void show_slips(const hci_diagnosis *d)
{
    for (size_t k = 0; k < d->runs; ++k)
        if (d->run[k].slip_rad != 0.0)
            cli_say("  index slip   %s: its mechanical angle is %.4g° ahead of that of the others; turned "
                    "back here\n",
                    d->run[k].file, d->run[k].slip_rad * 180.0 / HCI_PI);
}

static void show_resolution(const hci_resolution *r)
{
    cli_say("  old currents mean %.4g N·m, rms error %.3g N·m, T_ripple %.3g %% on the corrected machine\n",
            r->old_currents.mean_Nm, r->old_currents.rms_error_Nm, r->old_currents.T_ripple_percent);
    cli_say("  new currents mean %.4g N·m, rms error %.3g N·m, T_ripple %.3g %%, copper %.3f × the old\n",
            r->new_currents.mean_Nm, r->new_currents.rms_error_Nm, r->new_currents.T_ripple_percent,
            r->after.mean_square_A2 / r->before.mean_square_A2);
}

/* ---- bars ---- */

static bool is_shown(const hci_finding *f)
{
    return f->verdict != HCI_FINDING_REJECTED;
}

/* Torque that an effect alone explains. */
static double own_Nm(const hci_diagnosis *d, const hci_finding *f)
{
    return sqrt(f->residual_share) * d->rms_before_Nm;
}

static void finding_row(const void *context, size_t row, cli_cell cell[])
{
    const hci_diagnosis *d = context;
    const hci_finding *f = d->finding;
    for (size_t shown = 0; shown < row || !is_shown(f); ++f)
        shown += is_shown(f);
    snprintf(cell[0].text, sizeof cell[0].text, "%s", f->effect);
    snprintf(cell[1].text, sizeof cell[1].text, "%s", hci_finding_verdict_name(f->verdict));
    snprintf(cell[2].text, sizeof cell[2].text, "%.4g", f->delta_bic);
    if (!isfinite(f->residual_share)) return;
    snprintf(cell[3].text, sizeof cell[3].text, "%.4g", own_Nm(d, f));
    cell[4].value = own_Nm(d, f);
}

static void draw_findings(const hci_diagnosis *d)
{
    static const cli_column COLUMNS[] = {
        {CLI_LEFT, "effect"}, {CLI_LEFT, "verdict"}, {CLI_RIGHT, "ΔBIC"}, {CLI_RIGHT, "own"}, {CLI_BAR, ""}};
    size_t rows = 0;
    for (size_t k = 0; k < d->findings; ++k)
        rows += is_shown(&d->finding[k]);
    cli_draw(&(cli_chart){.caption =
                              "effects by evidence (ΔBIC); own: rms torque that only this one explains, N·m",
                          .column = COLUMNS,
                          .columns = 5,
                          .rows = rows,
                          .fill = finding_row,
                          .context = d,
                          .unit = "N·m"});
}

typedef struct {
    const hci_diagnosis *diagnosis;
    size_t pick[CLI_MOST_ROWS];
} worst_runs;

static double error_Nm(const void *diagnosis, size_t k)
{
    return ((const hci_diagnosis *)diagnosis)->run[k].rms_after_Nm;
}

static void run_row(const void *context, size_t row, cli_cell cell[])
{
    const worst_runs *w = context;
    const hci_run_errors *e = &w->diagnosis->run[w->pick[row]];
    snprintf(cell[0].text, sizeof cell[0].text, "%s", cli_text_end(e->file, 40));
    snprintf(cell[1].text, sizeof cell[1].text, "%s", e->role == HCI_ROLE_FIT ? "fit" : "holdout");
    snprintf(cell[2].text, sizeof cell[2].text, "%.4g", e->rms_before_Nm);
    cell[3].value = e->rms_before_Nm;
    snprintf(cell[4].text, sizeof cell[4].text, "%.4g", e->rms_after_Nm);
    cell[5].value = e->rms_after_Nm;
    cell[3].mark = cell[5].mark = e->noise_floor_Nm;
}

static void draw_runs(const hci_diagnosis *d)
{
    static const cli_column COLUMNS[] = {{CLI_LEFT, "run"}, {CLI_LEFT, "role"},   {CLI_RIGHT, "before"},
                                         {CLI_BAR, ""},     {CLI_RIGHT, "after"}, {CLI_BAR, ""}};
    char caption[240];
    worst_runs w = {.diagnosis = d};
    const size_t rows = cli_pick(error_Nm, d, d->runs, 0.0, w.pick, NULL);
    snprintf(caption, sizeof caption,
             "error of each run (rms of measured less modelled torque), N·m; before: the machine as "
             "declared; %s noise, where it is in the range",
             cli_is_ascii() ? "|" : "│");
    cli_draw(&(cli_chart){.caption = caption,
                          .column = COLUMNS,
                          .columns = 6,
                          .rows = rows,
                          .fill = run_row,
                          .context = &w,
                          .logarithmic = true,
                          .unit = "N·m"});
    if (rows < d->runs) cli_say("  and %zu runs with smaller errors\n", d->runs - rows);
}

static void show(const hci_diagnosis *d, const hci_resolution *r, const cli_arguments *a)
{
    static const char *const TONES[] = {CLI_GOOD, CLI_GOOD, CLI_WARN, CLI_BAD};
    char words[2048];
    hci_diagnosis_words(d, words, sizeof words);
    cli_say("diagnosed: %s, %s: %s%s" CLI_PLAIN "\n", a->word[0], a->value[RUNS], TONES[d->verdict],
            hci_diagnosis_verdict_name(d->verdict));
    cli_say_paragraph(2, words);
    for (size_t k = 0; k < d->findings; ++k)
        if (is_shown(&d->finding[k])) show_finding(d, &d->finding[k]);
    show_slips(d);
    if (d->advice[0]) cli_say("  measure next %s\n", d->advice);
    if (r) show_resolution(r);
    draw_findings(d);
    draw_runs(d);
}

/* ---- the command ---- */

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

static void show_remarks(const inputs *in)
{
    cli_remark(&in->machine.remark);
    for (size_t k = 0; k < in->runs.count; ++k)
        cli_remark(&in->runs.run[k].remark);
}

static int give_results(const cli_arguments *a, const inputs *in, const hci_diagnosis *d,
                        const hci_resolution *r, hci_status verdict)
{
    hci_note note = {{0}};
    hci_status status = HCI_OK;
    cli_progress_end();
    if (a->value[OUT]) status = write_results(a, in, d, r, &note);
    if (!status && cli_is_wordy()) show(d, r, a);
    if (!status) show_remarks(in);
    if (!status && a->given[JSON]) status = cli_print_json(hci_diagnosis_json(d, r), &note);
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
    .name = "diagnose",
    .words = "MACHINE --runs LIST",
    .does = "Finds what the model of the machine lacks to describe recordings, and corrects it.\n"
            "Writes machine/, effects.csv, errors.csv, residual_spectrum.csv, summary.json and report.html;\n"
            "unexplained.csv where something is left that no effect explains; with --target, solution/.",
    .options = OPTIONS,
    .words_needed = 1,
    .word_kind = CLI_FILE,
    .example =
        "  hci-solve diagnose data/fem_c/machine --runs data/fem_c/runs.csv -o out/diagnosed\n"
        "\nExit codes: 0 explained, or nothing is missing; 1 ambiguous or not explained; " CLI_EXIT_ERRORS,
    .source = "cli/diagnose.c",
    .guide = "diagnose.md",
    .run = run,
};
