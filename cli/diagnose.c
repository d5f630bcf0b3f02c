#define _POSIX_C_SOURCE 200809L

#include <math.h>
#include <stdio.h>
#include <string.h>
#include <sys/stat.h>

#include "cli/command/command.h"
#include "cli/command/parse.h"
#include "cli/command/reading.h"
#include "cli/command/same_file.h"
#include "cli/commands.h"
#include "cli/diagnose/diagnose_words.h"
#include "cli/terminal/progress.h"
#include "cli/terminal/say.h"
#include "cli/terminal/signals.h"
#include "cli/terminal/terminal.h"
#include "hci/host/check/check.h"
#include "hci/host/diagnose/again.h"
#include "hci/host/report/summary.h"
#include "hci/host/report/write.h"
#include "hci/math/harmonic.h"

enum {
    RUNS,
    AGAIN,
    OUT,
    TARGET,
    RESOLUTION,
    WORK,
    ORDER_BASE,
    REPORT,
    HOLDING,
    CLI_READING_KEYS,
    CLI_COMMON_KEYS
};

static const cli_option OPTIONS[] = {
    [RUNS] = {"runs", 0, CLI_FILE, "LIST",
              .help = "table file,role: the recordings to fit and those held out"},
    [AGAIN] = {"again", 0, CLI_FOLDER, "LAST",
               .help =
                   "--out of the last diagnosis: its machine and recordings, and those of LIST as new ones"},
    [ORDER_BASE] = CLI_ORDER_BASE_OPTION,
    [OUT] = {"out", 'o', CLI_FOLDER, "FOLDER", .help = "where the results go; without it nothing is written"},
    [TARGET] = {"target", 0, CLI_FILE, "FILE",
                .help = "wanted torque: solve the currents again for the corrected machine"},
    [RESOLUTION] = {"resolution", 0, CLI_NUMBER, "PERCENT",
                    .help = "of the largest torque; what the model need not be better than [0.05]",
                    .low = 1e-6, .high = 50.0},
    [WORK] = {"work", 0, CLI_NUMBER, "TIMES",
              .help = "how much the search may do: times the usual, which takes some 5 s [1; 4 with --again]",
              .low = 0.01, .high = 1e4},
    [REPORT] = {"report", 0, CLI_FLAG, NULL,
                .help = "report.html is written in any case; taken for the sake of scripts"},
    [HOLDING] = CLI_HOLDING_OPTION,
    CLI_READING_OPTIONS,
    CLI_COMMON_OPTIONS};

#define LIKELY     0.95 /* slip, to be named in a diagnosis */
#define AGAIN_WORK 4.0  /* as tune takes: less would withdraw what it found */

enum { PATH_SIZE = 4096 };

typedef struct {
    hci_machine_data machine;
    hci_effects_data declared;
    hci_runs runs;
    hci_target target;
    cli_reading reading;
    hci_diagnose_options options;
    char folder[PATH_SIZE];   /* of the machine */
    size_t recordings_before; /* of the last diagnosis */
    hci_check_inquiry check;  /* of machine and recordings */
    const char *checked[HCI_CHECK_MOST_RUNS];
} inputs;

/* The machine that is read would be replaced by a folder of that name within the results. */
static hci_status keep_apart(const char *machine, const char *folder, const char *name, hci_note *note)
{
    char path[PATH_SIZE];
    if (!folder || snprintf(path, sizeof path, "%s/%s", folder, name) >= PATH_SIZE) return HCI_OK;
    if (!cli_is_same_file(machine, path)) return HCI_OK;
    return hci_note_set(note, HCI_ERROR_ARGUMENT,
                        "%s would be replaced by a result of the same name; give another --out", machine);
}

/* Whether a folder has a file; path: out. */
static bool has_file(const char *folder, const char *file, char path[PATH_SIZE + 32])
{
    struct stat there;
    snprintf(path, PATH_SIZE + 32, "%s/%s", folder, file);
    return stat(path, &there) == 0;
}

/* What --again names is to be the --out of a diagnosis; of a folder of `tune` that is a part. */
static hci_status check_last(const char *last, hci_note *note)
{
    char path[PATH_SIZE + 32];
    if (has_file(last, "declared/machine.csv", path)) return HCI_OK;
    if (has_file(last, "diagnose/declared/machine.csv", path))
        return hci_note_set(
            note, HCI_ERROR_INPUT,
            "%.300s: found the --out of `tune`, expected that of a diagnosis, which stands in "
            "it; write --again %.300s/diagnose",
            last, last);
    has_file(last, "declared/machine.csv", path);
    return hci_note_set(note, HCI_ERROR_INPUT,
                        "%.300s: found no such file, expected the --out of a diagnosis; run hci-solve "
                        "diagnose MACHINE --runs LIST --out LAST first, with a folder LAST of its own, "
                        "and give that",
                        path);
}

/* The machine of the command line, or that which the last diagnosis started from. */
static hci_status find_machine(const cli_arguments *a, inputs *in, hci_note *note)
{
    const size_t wanted = a->value[AGAIN] ? 0 : 1;
    if (a->words != wanted)
        return hci_note_set(note, HCI_ERROR_ARGUMENT,
                            "diagnose: found %zu word%s, expected %zu: %s; see hci-solve diagnose --help",
                            a->words, a->words == 1 ? "" : "s", wanted,
                            wanted ? "MACHINE --runs LIST" : "--again LAST --runs LIST");
    if (snprintf(in->folder, PATH_SIZE, "%s%s", wanted ? a->word[0] : a->value[AGAIN],
                 wanted ? "" : "/declared") >= PATH_SIZE)
        return hci_note_set(note, HCI_ERROR_ARGUMENT, "--again: the path is too long");
    hci_status status = wanted ? HCI_OK : check_last(a->value[AGAIN], note);
    if (!status) status = keep_apart(in->folder, a->value[OUT], "declared", note);
    return status ? status : keep_apart(in->folder, a->value[OUT], "machine", note);
}

/* Those of the last diagnosis, whose list names their columns: where none of them has one that is named here,
 * that is of the new ones. */
static hci_status read_last(const char *list, inputs *in, hci_note *note)
{
    static const char OFFSET[] = "angle_offset";
    const hci_column_names *given = in->reading.run.columns;
    hci_column_name item[CLI_MOST_REPEATS + 1];
    hci_column_names offsets = {item, 0};
    hci_runs_options reading = {in->reading.run, in->options.progress, NULL};
    hci_note why = {{0}};
    const hci_status status = hci_runs_read(list, &reading, &in->runs, &why);
    if (status != HCI_ERROR_INPUT) {
        if (status) *note = why;
        return status;
    }
    for (size_t k = 0; given && k < given->count && offsets.count <= CLI_MOST_REPEATS; ++k)
        if (strncmp(given->item[k].name, OFFSET, strlen(OFFSET)) == 0) item[offsets.count++] = given->item[k];
    reading.run.columns = &offsets;
    return hci_runs_read(list, &reading, &in->runs, note);
}

/* The offset of the angle that all recordings were read with; 0: none, or not the same. */
static double common_offset_rad(const hci_runs *runs)
{
    const double first_rad = runs->count > 0 ? runs->run[0].zero_offset_rad : 0.0;
    for (size_t k = 1; k < runs->count; ++k)
        if (fabs(runs->run[k].zero_offset_rad - first_rad) > 0.0) return 0.0;
    return first_rad;
}

/* New recordings without the offset that all of the last had would contradict them. */
static hci_status check_offset(const cli_arguments *a, const hci_runs *last, const hci_runs *more,
                               hci_note *note)
{
    const double last_deg = common_offset_rad(last) * 180.0 / HCI_PI;
    if (a->value[ANGLE_OFFSET] || !(fabs(last_deg) > 0.0)) return HCI_OK;
    for (size_t k = 0; k < more->count; ++k)
        if (fabs(more->run[k].zero_offset_rad) > 0.0) return HCI_OK;
    return hci_note_set(
        note, HCI_ERROR_INPUT,
        "%s: no angle_offset for the new recordings, but those of the last diagnosis were read "
        "with %.6g degrees; add --angle-offset %.6g, or --angle-offset 0 where the zero of the "
        "angle is another one now",
        a->value[RUNS], last_deg, last_deg);
}

/* How all recordings of the last diagnosis were read; NULL: none was said, or not one for all. */
static const char *common_columns(const hci_runs *last)
{
    const char *first = last->count > 0 && last->origin ? last->origin[0].columns : "";
    for (size_t k = 1; k < last->count; ++k)
        if (strcmp(last->origin[k].columns, first) != 0) return NULL;
    return *first ? first : NULL;
}

/* New recordings are read as those of last time, unless it is said how, or they have not those columns. */
static hci_status read_more(const cli_arguments *a, const inputs *in, hci_runs *more, hci_note *note)
{
    const hci_column_names *given = in->reading.run.columns;
    const char *as_last = given && given->count > 0 ? NULL : common_columns(&in->runs);
    hci_runs_options reading = {in->reading.run, in->options.progress, NULL};
    hci_column_names columns = {0};
    hci_note why = {{0}};
    hci_status status = HCI_ERROR_INPUT;
    if (as_last && !hci_column_names_add_text(&columns, as_last, "the last diagnosis", &why)) {
        reading.run.columns = &columns;
        status = hci_runs_read(a->value[RUNS], &reading, more, &why);
        for (size_t k = 0; !status && k < more->count; ++k)
            hci_note_add(&more->run[k].remark, "read as the recordings of last time: %.200s", as_last);
    }
    hci_column_names_release(&columns);
    reading.run.columns = in->reading.run.columns;
    if (status == HCI_ERROR_INPUT) return hci_runs_read(a->value[RUNS], &reading, more, note);
    if (status) *note = why;
    return status;
}

/* The recordings of the last diagnosis, if there was one, and the new ones behind them. */
static hci_status read_runs(const cli_arguments *a, inputs *in, hci_note *note)
{
    const hci_runs_options reading = {in->reading.run, in->options.progress, NULL};
    char list[PATH_SIZE];
    hci_runs more = {0};
    if (!a->value[AGAIN]) return hci_runs_read(a->value[RUNS], &reading, &in->runs, note);
    if (snprintf(list, sizeof list, "%s/declared/runs.csv", a->value[AGAIN]) >= PATH_SIZE)
        return hci_note_set(note, HCI_ERROR_ARGUMENT, "--again: the path is too long");
    hci_status status = read_last(list, in, note);
    in->recordings_before = in->runs.count;
    if (!status) status = read_more(a, in, &more, note);
    if (!status) status = check_offset(a, &in->runs, &more, note);
    if (!status) status = hci_runs_join(&in->runs, &more, note);
    hci_runs_release(&more);
    return status;
}

static hci_status read_inputs(const cli_arguments *a, inputs *in, hci_note *note)
{
    hci_status status = HCI_OK;
    if (!a->value[RUNS])
        return hci_note_set(note, HCI_ERROR_ARGUMENT,
                            "diagnose: the recordings are missing; add --runs LIST, a table with the header "
                            "file,role and a row for each");
    status = cli_reading_take(a, a->given[STRICT], a->value[ANGLE_OFFSET], &in->reading, note);
    if (!status) status = find_machine(a, in, note);
    in->options.resolution = cli_number_or(a, RESOLUTION, 0.0) / 100.0;
    in->options.work = cli_number_or(a, WORK, a->value[AGAIN] ? AGAIN_WORK : 0.0);
    in->options.progress = cli_progress;
    const hci_order_base base = (hci_order_base)a->choice[ORDER_BASE];
    if (!status) status = hci_machine_read_orders(in->folder, base, &in->machine, note);
    if (!status && a->value[TARGET])
        status = hci_target_read_orders(a->value[TARGET], base, in->machine.model.pole_pairs, &in->target,
                                        &in->machine.remark, note);
    if (!status) status = hci_effects_read_machine(in->folder, &in->declared, note);
    if (status) return status;
    in->reading.run.pole_pairs = in->machine.model.pole_pairs;
    in->reading.run.holding = a->given[HOLDING];
    in->reading.run.inertia_kgm2 = in->machine.inertia_kgm2;
    in->reading.run.torque_constant_Nm_per_A = hci_machine_torque_constant(&in->machine);
    return read_runs(a, in, note);
}

static void release_inputs(inputs *in)
{
    hci_machine_release(&in->machine);
    hci_effects_release(&in->declared);
    hci_runs_release(&in->runs);
    cli_reading_release(&in->reading);
    hci_target_release(&in->target);
}

/* ---- the command ---- */

static hci_status write_results(const cli_arguments *a, const inputs *in, const hci_diagnosis *d,
                                const hci_resolution *r, hci_note *note)
{
    const hci_new_currents currents = {r, &in->machine, a->value[TARGET]};
    return hci_diagnosis_write(d, r ? &currents : NULL, &in->runs, in->folder, a->value[OUT], note);
}

static const hci_note *remark_of_run(const void *context, size_t k)
{
    return &((const inputs *)context)->runs.run[k].remark;
}

static void show_remarks(const inputs *in)
{
    cli_remark(&in->machine.remark);
    cli_remark_each(remark_of_run, in, in->runs.count);
}

/* What check is asked about: the recordings by their files. */
static void prepare_check(inputs *in)
{
    size_t count = 0;
    for (size_t k = 0; in->runs.origin && k < in->runs.count && count < HCI_CHECK_MOST_RUNS; ++k)
        if (!hci_runs_is_further_point(&in->runs, k)) in->checked[count++] = in->runs.origin[k].path;
    in->check = (hci_check_inquiry){
        .machine = in->folder, .run = in->checked, .runs = count, .reading = in->reading.run};
}

/* Where something is left that is not known it may be a slip of convention: check reads them as one or not.
 */
static void show_convention(inputs *in, const hci_diagnosis *d)
{
    const bool open = d->verdict == HCI_DIAGNOSIS_UNKNOWN || d->verdict == HCI_DIAGNOSIS_PARTLY;
    const hci_check *check = open ? hci_check_ask(&in->check) : NULL;
    for (size_t k = 0; check && k < check->findings; ++k)
        if (check->finding[k].probability >= LIKELY) cli_show_convention(&check->finding[k]);
}

static int give_results(const cli_arguments *a, inputs *in, const hci_diagnosis *d, const hci_resolution *r,
                        hci_status verdict)
{
    hci_note note = {{0}};
    hci_status status = HCI_OK;
    cli_progress_end();
    if (a->value[OUT]) status = write_results(a, in, d, r, &note);
    if (!status && cli_is_wordy()) {
        show_convention(in, d);
        cli_show_diagnosis(d, r, in->folder, a->value[RUNS]);
    }
    if (!status) show_remarks(in);
    if (!status && a->given[JSON])
        status =
            cli_print_json(a->value[OUT] ? hci_summary_read(a->value[OUT]) : hci_diagnosis_json(d, r), &note);
    return status ? cli_fail(status, &note) : hci_status_exit_code(verdict);
}

/* What was found, and where it was wanted the currents for it. */
static int solve_and_give(const cli_arguments *a, inputs *in, const hci_diagnosis *d, hci_status verdict)
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

/* Ctrl-C ends the search with what it has, and the program when that has been written. */
static hci_status search(inputs *in, hci_diagnosis *d, hci_note *note)
{
    in->options.stop = cli_signals_deferred;
    prepare_check(in);
    in->options.slip = hci_check_slip;
    in->options.slip_context = &in->check;
    cli_signals_defer();
    const hci_status status = (in->recordings_before > 0 ? hci_diagnose_further : hci_diagnose)(
        &in->machine, &in->declared.list, &in->runs, &in->options, d, note);
    cli_signals_catch();
    return status;
}

/* What the new recordings say of the last diagnosis. Returns the status of the search, or an error. */
static hci_status compare(const cli_arguments *a, const inputs *in, hci_status searched, hci_diagnosis *d,
                          hci_again *again, hci_note *note)
{
    const hci_again_question question = {&in->machine, &in->declared.list, &in->runs, in->recordings_before,
                                         a->value[AGAIN]};
    if (!a->value[AGAIN]) return searched;
    const hci_status status = hci_again_find(&question, d, again, note);
    if (status) hci_diagnosis_release(d);
    if (status) return status;
    return hci_again_is_bad(again) ? HCI_NOT_REACHED : searched;
}

static int run(const cli_arguments *a)
{
    static inputs in; /* large */
    hci_diagnosis diagnosis;
    hci_again again = {0};
    hci_note note = {{0}};
    hci_status status;
    int exit_code;
    memset(&in, 0, sizeof in);
    status = read_inputs(a, &in, &note);
    if (!status) status = search(&in, &diagnosis, &note);
    if (status <= HCI_NOT_REACHED) status = compare(a, &in, status, &diagnosis, &again, &note);
    if (status <= HCI_NOT_REACHED && diagnosis.without_cogging) in.machine.model.cogging_count = 0;
    if (status <= HCI_NOT_REACHED) {
        exit_code = solve_and_give(a, &in, &diagnosis, status);
        hci_diagnosis_release(&diagnosis);
    } else {
        exit_code = cli_fail(status, &note);
    }
    hci_again_release(&again);
    release_inputs(&in);
    cli_signals_obey();
    return exit_code;
}

const cli_command cli_diagnose = {
    .name = "diagnose",
    .words = "{MACHINE | --again LAST} --runs LIST",
    .does = "Finds what the model of the machine lacks to describe recordings, and corrects it.\n"
            "Writes machine/, effects.csv, errors.csv, residual_spectrum.csv, summary.json and report.html; "
            "unexplained.csv where something is left that no effect explains, measure_next.csv where more "
            "recordings would tell; with --target, solution/.",
    .options = OPTIONS,
    .takes_more_words = true, /* one, or none with --again */
    .word_kind = CLI_FILE,
    .example =
        "  hci-solve diagnose data/fem_c/machine --runs data/fem_c/runs.csv -o out/diagnosed\n"
        "\nExit codes: 0 explained, or nothing is missing; 1 ambiguous or not explained, or with --again a "
        "promised ripple that was not kept or currents that are played at another angle; " CLI_EXIT_ERRORS,
    .source = "cli/diagnose.c",
    .guide = "diagnose.md",
    .run = run,
};
