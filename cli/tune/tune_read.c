#define _XOPEN_SOURCE 700
#include "cli/tune/tune_steps.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

#include "cli/command/replaced.h"
#include "cli/terminal/progress.h"
#include "cli/tune/tune_commands.h"
#include "cli/tune/tune_cover.h"
#include "cli/tune/tune_options.h"
#include "cli/tune/tune_read.h"
#include "cli/tune/tune_suspect.h"
#include "hci/host/base/number.h"
#include "hci/host/currents/target.h"
#include "hci/host/emit/emit.h"
#include "hci/host/report/write.h"
#include "hci/host/waveform/waveform.h"
#include "hci/math/harmonic.h"

/* ---- what is known of the logs ---- */

bool cli_tune_is_blocked(const cli_tuning *t)
{
    return t->has_slip || t->has_misfit || t->has_unsteady || t->has_no_angle || t->has_alias ||
           t->has_standstill || t->inertia_share > 0.0 || t->tells_no_order || t->jump_rad > 0.0 ||
           t->is_not_followed || cli_tune_all_torque_clipped(t);
}

/* ---- what is read ---- */

static hci_status init_machine(cli_tuning *t, hci_note *note)
{
    const cli_arguments *a = t->arguments;
    cli_tune_line c = {{"init", "machine"}, 2};
    for (int k = 0; k <= TUNE_DC_LINK; ++k)
        if (a->given[k]) cli_tune_add_option(&c, cli_tune_options[k].name, a->value[k]);
    cli_tune_path(t, "machine", t->machine);
    cli_tune_add(&c, "-o");
    cli_tune_add(&c, t->machine);
    t->is_own = true;
    return cli_tune_run(t, t->commands.init, &c, note);
}

hci_status cli_tune_list_logs(cli_tuning *t, hci_note *note)
{
    const cli_arguments *a = t->arguments;
    const char *test = a->given[TUNE_HOLDING] ? "holding" : "";
    cli_tune_path(t, "runs.csv", t->list);
    cli_tune_note(t, "echo file,role,test >\"$OUT\"/runs.csv\nfor log in");
    for (size_t k = 0; k < a->words; ++k)
        cli_tune_note_word(t, a->word[k], false);
    cli_tune_note(
        t, "; do echo \"$(realpath --relative-to=\"$OUT\" \"$log\"),fit,%s\"; done >>\"$OUT\"/runs.csv\n",
        test);
    return hci_tuning_write_list(t->out, a->word, a->words, test, note);
}

static bool is_folder(const char *path)
{
    struct stat there;
    return stat(path, &there) == 0 && S_ISDIR(there.st_mode);
}

/* The logs, or the machine beside a list. */
static hci_status check_logs(const cli_arguments *a, hci_note *note)
{
    if (a->given[TUNE_RUNS] && a->words != 1)
        return hci_note_set(note, HCI_ERROR_ARGUMENT,
                            "tune: found %zu words, expected one machine beside --runs LIST", a->words);
    for (size_t k = 0; k < a->words; ++k)
        if (strcmp(a->word[k], "-") == 0)
            return hci_note_set(note, HCI_ERROR_ARGUMENT,
                                "tune: found `-`, expected a file: a log is read several times, which the "
                                "standard input is not; save it as a CSV file and give that");
    for (size_t k = 0; k < a->words && !a->given[TUNE_RUNS]; ++k)
        if (is_folder(a->word[k]))
            return hci_note_set(
                note, HCI_ERROR_ARGUMENT,
                "tune: found the folder %s among the logs, expected files; a machine is given "
                "with a list of its logs, tune %s --runs LIST, and logs alone with the sheet, "
                "tune LOG... --pole-pairs P --kv RPM_PER_V",
                a->word[k], a->word[k]);
    for (size_t k = 0; k < a->words; ++k)
        for (size_t other = 0; other < k; ++other)
            if (strcmp(a->word[k], a->word[other]) == 0)
                return hci_note_set(note, HCI_ERROR_ARGUMENT,
                                    "tune: found the log %s twice, expected each one once; leave one out",
                                    a->word[k]);
    return HCI_OK;
}

/* Whether a file or folder lies in a folder that is there. */
static bool is_in(const char *path, const char *folder)
{
    char *inner = realpath(path, NULL), *outer = realpath(folder, NULL);
    const size_t length = outer ? strlen(outer) : 0;
    const bool is = inner && outer && strncmp(inner, outer, length) == 0 &&
                    (inner[length] == '/' || inner[length] == '\0');
    free(inner);
    free(outer);
    return is;
}

/* The results of an earlier call are replaced as a whole, and what is read cannot be among them. */
static hci_status expect_outside(const cli_arguments *a, const char *folder, hci_note *note)
{
    const char *read[] = {a->word[0], a->value[TUNE_RUNS]};
    for (size_t k = 0; k < 2; ++k)
        if (is_in(read[k], folder))
            return hci_note_set(
                note, HCI_ERROR_ARGUMENT,
                "tune: %s is among the results in %s, which are replaced as a whole; give --out "
                "another folder",
                read[k], folder);
    return HCI_OK;
}

/* What can be refused before any work. */
static hci_status check_words(const cli_arguments *a, hci_note *note)
{
    if (!a->value[TUNE_OUT] || !*a->value[TUNE_OUT])
        return hci_note_set(note, HCI_ERROR_ARGUMENT, "tune: add --out FOLDER, a new folder for the results");
    if (a->given[TUNE_SPEED] && !a->given[TUNE_BANDWIDTH])
        return hci_note_set(
            note, HCI_ERROR_ARGUMENT,
            "tune: --speed is the speed at which a current loop is asked for; add --bandwidth "
            "HZ, or leave it out");
    hci_status status = check_logs(a, note);
    cli_reading reading;
    if (status) return status;
    status = cli_reading_take(a, a->given[STRICT], a->value[ANGLE_OFFSET], &reading, note);
    cli_reading_release(&reading);
    return status || !a->given[TUNE_NAME] ? status : hci_emit_check_name(a->value[TUNE_NAME], note);
}

hci_status cli_tune_begin(const cli_arguments *a, cli_tuning *t, hci_note *note)
{
    t->arguments = a;
    t->out = a->value[TUNE_OUT];
    hci_status status = check_words(a, note);
    if (!status) status = cli_tune_claim_folder(t->out, note);
    if (status) return status;
    cli_tune_note(t, "#!/bin/sh\n# What tune did, step by step, from the folder where it was called: sh "
                     "commands.sh NEW_FOLDER\n"
                     "set -eu\nOUT=${1:?give a new folder}\nmkdir -p \"$OUT\"\n");
    if (a->given[TUNE_RUNS]) status = expect_outside(a, t->out, note);
    if (!status) status = cli_replaced_set_aside(t->out, t->aside, note);
    if (!status && !a->given[TUNE_RUNS] && !t->aside[0]) status = cli_tune_expect_finished(t->out, note);
    if (status) return status;
    if (a->given[TUNE_RUNS]) {
        snprintf(t->machine, sizeof t->machine, "%s", a->word[0]);
        snprintf(t->list, sizeof t->list, "%s", a->value[TUNE_RUNS]);
        return HCI_OK;
    }
    status = init_machine(t, note);
    return status ? status : cli_tune_list_logs(t, note);
}

static const char *source_words(const hci_run *r)
{
    static const char *const WORDS[] = {
        "no torque in it", "torque as measured",
        "the shaft is held or turned slowly by control: its current answers cogging and friction",
        "a free shaft: torque is inertia x acceleration"};
    if (r->torque_source == HCI_TORQUE_HOLDING && hci_run_is_loaded(r, r->pole_pairs))
        return "the shaft is turned slowly by control against a load: its current answers that, cogging "
               "torque, and the harmonics of the back-EMF";
    return WORDS[r->torque_source];
}

const char *cli_tune_log_of(const cli_tuning *t, size_t k)
{
    const hci_run *r = &t->runs.run[k];
    if (t->arguments->given[TUNE_RUNS]) return r->is_point ? t->runs.origin[k].path : r->name;
    return t->arguments->word[t->runs.origin[k].row];
}

const char *cli_tune_name_of(const cli_tuning *t, size_t k)
{
    const hci_run *r = &t->runs.run[k];
    const char *folder = strrchr(r->name, '/');
    if (!r->is_point) return cli_tune_log_of(t, k);
    return folder ? folder + 1 : r->name;
}

/* ", 0.52 turns, 386 samples a turn, which tell orders up to 16.8": of the electrical turn. */
static void cover_words(const hci_run *r, char *text, size_t size)
{
    const cli_tune_cover x = cli_tune_cover_of(r);
    text[0] = '\0';
    if (!(x.samples_a_turn > 0.0)) return;
    char samples[24];
    snprintf(samples, sizeof samples, x.samples_a_turn < 100.0 ? "%.3g" : "%.0f", x.samples_a_turn);
    snprintf(text, size, ", %.3g turns, %s samples a turn, which tell orders up to %.3g", x.turns, samples,
             x.highest_order);
}

/* "log.csv: 9000 samples, 12.3 s, 10 turns, ...; torque as measured; currents up to 3.2 A" */
static void say_run(cli_tuning *t, size_t k)
{
    const hci_run *r = &t->runs.run[k];
    double most_A = 0.0;
    char time[48] = "", cover[120], currents[80] = "no current";
    for (size_t n = 0; n < 3 * r->count; ++n)
        most_A = fmax(most_A, fabs(r->i_A[n]));
    if (r->time_s && r->count > 1)
        snprintf(time, sizeof time, ", %.4g s", r->time_s[r->count - 1] - r->time_s[0]);
    if (r->is_point)
        snprintf(currents, sizeof currents, "phase currents of each");
    else if (most_A > 0.0)
        snprintf(currents, sizeof currents, "phase currents up to %.3g A%s", most_A,
                 r->lacks_id ? ", i_d in no column and taken as 0" : "");
    cover_words(r, cover, sizeof cover);
    if (hci_runs_is_further_point(&t->runs, k)) return;
    hci_tuning_say(&t->tuning, HCI_TUNING_READ, "%s: %zu samples%s%s%s; %s; %s%s", cli_tune_log_of(t, k),
                   r->count, r->is_point ? " at each operating point" : "", time, cover, source_words(r),
                   currents, r->v_V ? "; voltages" : "");
}

static void release_inputs(cli_tuning *t)
{
    hci_runs_release(&t->runs);
    hci_effects_release(&t->effects);
    hci_machine_release(&t->declared);
}

/* An offset that was given with a unit, in degrees, which all later commands take. */
static void take_given_offset(cli_tuning *t)
{
    const char *word = t->arguments->value[ANGLE_OFFSET];
    double plain;
    if (!word || t->offset[0] || hci_number_parse(word, &plain)) return;
    for (size_t k = 0; k < t->runs.count && !t->offset[0]; ++k)
        if (t->runs.run[k].zero_is_given)
            snprintf(t->offset, sizeof t->offset, "%.10g", t->runs.run[k].zero_offset_rad * 180.0 / HCI_PI);
}

hci_status cli_tune_read_inputs(cli_tuning *t, hci_note *note)
{
    const cli_arguments *a = t->arguments;
    release_inputs(t);
    cli_reading_release(&t->reading);
    hci_status status = cli_reading_take(a, a->given[STRICT], cli_tune_offset(t), &t->reading, note);
    if (!status) status = hci_machine_read(t->machine, &t->declared, note);
    if (!status) status = hci_effects_read_machine(t->machine, &t->effects, note);
    if (status) return status;
    t->reading.run.pole_pairs = t->declared.model.pole_pairs;
    t->reading.run.holding = a->given[TUNE_HOLDING];
    t->reading.run.inertia_kgm2 = t->declared.inertia_kgm2;
    t->reading.run.torque_constant_Nm_per_A = hci_machine_torque_constant(&t->declared);
    status = hci_runs_read(t->list, &(hci_runs_options){t->reading.run, cli_progress, NULL}, &t->runs, note);
    if (status && t->is_own) hci_tuning_name_log(t->out, a->word, a->words, note);
    if (!status) cli_tune_cover_set(t);
    if (!status) take_given_offset(t);
    return status;
}

static const hci_note *remark_of(const void *runs, size_t k)
{
    return &((const hci_runs *)runs)->run[k].remark;
}

/* The same remark of many recordings is said once. */
static void say_remark(void *to, size_t first, size_t alike, const char *text)
{
    cli_tuning *t = to;
    if (alike > 1)
        hci_tuning_say(&t->tuning, HCI_TUNING_READ, "%zu of %zu recordings: %s", alike, t->runs.count, text);
    else if (t->runs.count > 1)
        hci_tuning_say(&t->tuning, HCI_TUNING_READ, "%s: %s", cli_tune_log_of(t, first), text);
    else
        hci_tuning_say(&t->tuning, HCI_TUNING_READ, "  %s", text);
}

hci_status cli_tune_read(cli_tuning *t, hci_note *note)
{
    const hci_status status = cli_tune_read_inputs(t, note);
    for (size_t k = 0; k < t->runs.count && !status; ++k)
        say_run(t, k);
    if (!status) cli_remarks_group(&(cli_remarks){remark_of, &t->runs, t->runs.count}, say_remark, t);
    return status;
}

void cli_tune_release(cli_tuning *t)
{
    if (t->is_solved) hci_solution_release(&t->solution);
    hci_target_release(&t->target);
    hci_uncertainty_release(&t->uncertainty);
    hci_effects_release(&t->found);
    hci_machine_release(&t->corrected);
    hci_diagnosis_release(&t->diagnosis);
    hci_waveform_release(&t->cogging);
    release_inputs(t);
    cli_reading_release(&t->reading);
}
