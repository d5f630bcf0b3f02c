#include "cli/tune/tune_steps.h"

#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "cli/command/command.h"
#include "cli/command/parse.h"
#include "cli/terminal/progress.h"
#include "cli/terminal/terminal.h"
#include "cli/tune/tune_options.h"
#include "hci/host/base/number.h"
#include "hci/host/currents/target.h"
#include "hci/host/recording/predict.h"
#include "hci/host/report/write.h"
#include "hci/host/waveform/waveform.h"
#include "hci/math/harmonic.h"

enum { MOST_STEP_WORDS = 32 + 2 * CLI_MOST_REPEATS };

/* ---- commands: as they are run, and as a shell repeats them ---- */

static void note_text(cli_tuning *t, const char *format, ...) HCI_PRINTF(2, 3);
static void note_text(cli_tuning *t, const char *format, ...)
{
    const size_t used = strlen(t->tuning.commands);
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(t->tuning.commands + used, sizeof t->tuning.commands - used, format, arguments);
    va_end(arguments);
}

/* What needs no quotes in a shell. */
static bool is_plain(const char *word)
{
    return *word && strspn(word, "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-+./,=:") ==
                        strlen(word);
}

static void note_quoted(cli_tuning *t, const char *word)
{
    note_text(t, "'");
    for (; *word; ++word)
        note_text(t, *word == '\'' ? "'\\''" : "%c", *word);
    note_text(t, "'");
}

/* A word of a shell. What begins with the folder of the results goes into the folder of the repetition; a
 * name may be the same word. */
static void note_word(cli_tuning *t, const char *word, bool is_name)
{
    const size_t length = strlen(t->out);
    const bool is_out =
        !is_name && strncmp(word, t->out, length) == 0 && (word[length] == '/' || word[length] == '\0');
    note_text(t, is_out ? " \"$OUT\"" : " ");
    word += is_out ? length : 0;
    if (is_plain(word))
        note_text(t, "%s", word);
    else if (!is_out || *word)
        note_quoted(t, word);
}

/* A command line; `code`: as a step that may answer 1. */
typedef struct {
    const char *word[MOST_STEP_WORDS];
    size_t count;
} command_line;

static void add(command_line *c, const char *word)
{
    if (c->count < MOST_STEP_WORDS) c->word[c->count++] = word;
}

static void add_option(command_line *c, const char *name, const char *value)
{
    static char dashed[2 * MOST_STEP_WORDS][40];
    static size_t used;
    char *text = dashed[used++ % (2 * MOST_STEP_WORDS)];
    snprintf(text, sizeof dashed[0], "--%s", name);
    add(c, text);
    if (value) add(c, value);
}

static const char *offset_of(const cli_tuning *t)
{
    return t->has_offset ? t->offset : t->arguments->value[ANGLE_OFFSET];
}

static void add_reading(command_line *c, const cli_tuning *t)
{
    const cli_arguments *a = t->arguments;
    for (size_t k = 0; k < a->repeats; ++k)
        add_option(c, "column", a->repeated[k]);
    if (offset_of(t)) add_option(c, "angle-offset", offset_of(t));
    if (a->given[STRICT]) add_option(c, "strict", NULL);
}

static void note_command(cli_tuning *t, const command_line *c, bool may_be_no)
{
    note_text(t, "hci-solve");
    for (size_t k = 0; k < c->count; ++k)
        if (k == 0)
            note_text(t, " %s", c->word[k]);
        else
            note_word(t, c->word[k], strcmp(c->word[k - 1], "--name") == 0);
    note_text(t, may_be_no ? " || [ $? -eq 1 ]\n" : "\n");
}

/* Runs it here, without words. */
static hci_status run(cli_tuning *t, const cli_command *command, command_line *c, hci_note *note)
{
    char *words[MOST_STEP_WORDS + 1];
    note_command(t, c, false);
    for (size_t k = 1; k < c->count; ++k)
        words[k - 1] = (char *)(size_t)c->word[k];
    words[c->count - 1] = "-q";
    const int code = cli_command_run(command, (int)c->count, words);
    const cli_arguments *a = t->arguments;
    cli_terminal_begin(a->given[QUIET], a->given[JSON], (cli_color)a->choice[COLOR]);
    if (code == 0) return HCI_OK;
    return hci_note_set(
        note,
        code == 2   ? HCI_ERROR_ARGUMENT
        : code == 3 ? HCI_ERROR_INPUT
        : code == 5 ? HCI_ERROR_OUTPUT
                    : HCI_ERROR_NUMERIC,
        "tune: the step `%s` failed, for the reason above; correct that and begin again with a new --out",
        c->word[0]);
}

static void path_in(const cli_tuning *t, const char *name, char path[CLI_TUNE_PATH])
{
    snprintf(path, CLI_TUNE_PATH, "%.1900s/%s", t->out, name);
}

/* ---- what is known of the logs ---- */

bool cli_tune_is_blocked(const cli_tuning *t)
{
    return t->has_slip || t->has_misfit || t->has_unsteady || t->has_alias;
}

double cli_tune_order_of_slots(const cli_tuning *t)
{
    const long slots = lround(t->declared.slots), poles = 2L * t->declared.model.pole_pairs;
    long a = slots, b = poles;
    if (!(t->declared.slots > 0.0) || slots < 1) return 0.0;
    while (b > 0) {
        const long rest = a % b;
        a = b, b = rest;
    }
    return 2.0 * (double)(slots / a);
}

/* ---- what is read ---- */

static hci_status init_machine(cli_tuning *t, hci_note *note)
{
    const cli_arguments *a = t->arguments;
    command_line c = {{"init", "machine"}, 2};
    for (int k = 0; k <= TUNE_DC_LINK; ++k)
        if (a->given[k]) add_option(&c, cli_tune_options[k].name, a->value[k]);
    path_in(t, "machine", t->machine);
    add(&c, "-o");
    add(&c, t->machine);
    t->is_own = true;
    return run(t, t->commands.init, &c, note);
}

static hci_status list_logs(cli_tuning *t, hci_note *note)
{
    const cli_arguments *a = t->arguments;
    const char *test = a->given[TUNE_HOLDING] ? "holding" : "";
    path_in(t, "runs.csv", t->list);
    note_text(t, "echo file,role,test >\"$OUT\"/runs.csv\nfor log in");
    for (size_t k = 0; k < a->words; ++k)
        note_word(t, a->word[k], false);
    note_text(t,
              "; do echo \"$(realpath --relative-to=\"$OUT\" \"$log\"),fit,%s\"; done >>\"$OUT\"/runs.csv\n",
              test);
    return hci_tuning_write_list(t->out, a->word, a->words, test, note);
}

hci_status cli_tune_begin(const cli_arguments *a, cli_tuning *t, hci_note *note)
{
    hci_status status;
    t->arguments = a;
    t->out = a->value[TUNE_OUT];
    if (!t->out || !*t->out)
        return hci_note_set(note, HCI_ERROR_ARGUMENT, "tune: add --out FOLDER, a new folder for the results");
    if (a->given[TUNE_RUNS] && a->words != 1)
        return hci_note_set(note, HCI_ERROR_ARGUMENT,
                            "tune: found %zu words, expected one machine beside --runs LIST", a->words);
    note_text(t, "#!/bin/sh\n# What tune did, step by step, from the folder where it was called: sh "
                 "commands.sh NEW_FOLDER\n"
                 "set -eu\nOUT=${1:?give a new folder}\nmkdir -p \"$OUT\"\n");
    if (a->given[TUNE_RUNS]) {
        snprintf(t->machine, sizeof t->machine, "%s", a->word[0]);
        snprintf(t->list, sizeof t->list, "%s", a->value[TUNE_RUNS]);
        return HCI_OK;
    }
    status = init_machine(t, note);
    return status ? status : list_logs(t, note);
}

static const char *source_words(const hci_run *r)
{
    static const char *const WORDS[] = {
        "no torque in it", "torque as measured",
        "the shaft is held or turned slowly by control: its current answers cogging and friction",
        "a free shaft: torque is inertia x acceleration"};
    return WORDS[r->torque_source];
}

/* As it was given; in a list, as that names it. */
static const char *name_of(const cli_tuning *t, size_t k)
{
    return t->arguments->given[TUNE_RUNS] ? t->runs.run[k].name : t->arguments->word[k];
}

/* "log.csv: 9000 samples, 12.3 s, torque as measured; currents up to 3.2 A" */
static void say_run(cli_tuning *t, size_t k)
{
    const hci_run *r = &t->runs.run[k];
    double most_A = 0.0;
    char time[48] = "", currents[48] = "no current";
    for (size_t n = 0; n < 3 * r->count; ++n)
        most_A = fmax(most_A, fabs(r->i_A[n]));
    if (r->time_s && r->count > 1)
        snprintf(time, sizeof time, ", %.4g s", r->time_s[r->count - 1] - r->time_s[0]);
    if (most_A > 0.0) snprintf(currents, sizeof currents, "phase currents up to %.3g A", most_A);
    hci_tuning_say(&t->tuning, HCI_TUNING_READ, "%s: %zu samples%s; %s; %s%s", name_of(t, k), r->count, time,
                   source_words(r), currents, r->v_V ? "; voltages" : "");
}

static void release_inputs(cli_tuning *t)
{
    hci_runs_release(&t->runs);
    hci_effects_release(&t->effects);
    hci_machine_release(&t->declared);
}

static hci_status read_inputs(cli_tuning *t, hci_note *note)
{
    const cli_arguments *a = t->arguments;
    release_inputs(t);
    cli_reading_release(&t->reading);
    hci_status status = cli_reading_take(a, a->given[STRICT], offset_of(t), &t->reading, note);
    if (!status) status = hci_machine_read(t->machine, &t->declared, note);
    if (!status) status = hci_effects_read_machine(t->machine, &t->effects, note);
    if (status) return status;
    t->reading.run.pole_pairs = t->declared.model.pole_pairs;
    t->reading.run.holding = a->given[TUNE_HOLDING];
    t->reading.run.inertia_kgm2 = t->declared.inertia_kgm2;
    t->reading.run.torque_constant_Nm_per_A = hci_machine_torque_constant(&t->declared);
    return hci_runs_read(t->list, &(hci_runs_options){t->reading.run, cli_progress, NULL}, &t->runs, note);
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
        hci_tuning_say(&t->tuning, HCI_TUNING_READ, "%s: %s", name_of(t, first), text);
    else
        hci_tuning_say(&t->tuning, HCI_TUNING_READ, "  %s", text);
}

/* The one that is shown: what sticks, or else the first that tells where the shaft is. */
static void choose_log(cli_tuning *t)
{
    size_t shown = 0;
    for (size_t k = t->runs.count; k-- > 0;)
        if (t->runs.run[k].theta_m_rad || t->runs.run[k].speed_rad_per_s) shown = k;
    for (size_t k = t->runs.count; k-- > 0;)
        if (t->runs.run[k].is_unsteady) shown = k;
    t->shown = shown;
    t->tuning.log_name = name_of(t, shown);
}

hci_status cli_tune_read(cli_tuning *t, hci_note *note)
{
    const hci_status status = read_inputs(t, note);
    for (size_t k = 0; k < t->runs.count && !status; ++k)
        say_run(t, k);
    if (!status && t->runs.count > 0) choose_log(t);
    if (!status) cli_remarks_group(&(cli_remarks){remark_of, &t->runs, t->runs.count}, say_remark, t);
    for (size_t k = 0; k < t->runs.count && !status; ++k) {
        t->has_unsteady = t->has_unsteady || t->runs.run[k].is_unsteady;
        t->needs_inertia = t->needs_inertia || t->runs.run[k].needs_inertia;
    }
    return status;
}

/* ---- conventions ---- */

static void say_check(cli_tuning *t, const hci_check *c)
{
    hci_tuning_say(&t->tuning, HCI_TUNING_READ, "conventions: %s (%zu relations checked)",
                   hci_check_verdict_name(c->verdict), c->evidences);
    for (size_t k = 0; k < c->evidences; ++k)
        if (c->evidence[k].state == HCI_CHECK_UNMENDED)
            hci_tuning_say(&t->tuning, HCI_TUNING_READ, "  not understood: %s is %.4g, expected %s%.4g",
                           c->evidence[k].words, c->evidence[k].declared,
                           c->evidence[k].at_most ? "at most " : "", c->evidence[k].expected);
    for (size_t k = 0; k < c->findings; ++k) {
        const hci_check_finding *f = &c->finding[k];
        const bool is_found = f->probability >= HCI_CHECK_FOUND;
        hci_tuning_say(&t->tuning, is_found ? HCI_TUNING_READ : HCI_TUNING_UNKNOWN,
                       "%s: %s (%.3g %%); %s:%zu, %s: found %s, should be %s",
                       is_found ? "slip" : "possible slip", f->words, 100.0 * f->probability, f->file,
                       f->line, f->column, f->found, f->should_be);
        t->has_slip = t->has_slip || is_found;
    }
}

/* What nothing can be solved with where it is not understood. */
static bool is_of_angle(const char *relation)
{
    static const char *const NAMES[] = {"emf_angle",   "current_order",   "voltage_order", "angle_ratio",
                                        "angle_speed", "frequency_speed", "cogging_share"};
    for (size_t k = 0; k < sizeof NAMES / sizeof *NAMES; ++k)
        if (strcmp(NAMES[k], relation) == 0) return true;
    return false;
}

static void judge_check(cli_tuning *t, const hci_check *c)
{
    for (size_t k = 0; k < c->evidences && c->verdict == HCI_CHECK_NOT_UNDERSTOOD; ++k)
        if (c->evidence[k].state == HCI_CHECK_UNMENDED)
            *(is_of_angle(c->evidence[k].name) ? &t->has_misfit : &t->has_doubt) = true;
}

/* check has no list of recordings: their first HCI_CHECK_MOST_RUNS are its words. */
static size_t checked_runs(const cli_tuning *t, const char *run[HCI_CHECK_MOST_RUNS])
{
    size_t count = 0;
    for (; count < t->runs.count && count < HCI_CHECK_MOST_RUNS; ++count)
        run[count] = t->arguments->given[TUNE_RUNS] ? t->runs.origin[count].path : t->arguments->word[count];
    return count;
}

static hci_status run_check(cli_tuning *t, const char *run[HCI_CHECK_MOST_RUNS], hci_check *check,
                            hci_note *note)
{
    hci_run_options reading = t->reading.run;
    reading.holding = false;
    const hci_status status = hci_check_files(t->machine, run, checked_runs(t, run), &reading, check, note);
    return status > HCI_NOT_REACHED ? status : HCI_OK;
}

/* From here on recordings are read with another zero. */
static void take_offset(cli_tuning *t, double more_rad, const char *why)
{
    const double so_far_rad = t->runs.count > 0 ? t->runs.run[0].zero_offset_rad : 0.0;
    snprintf(t->offset, sizeof t->offset, "%.3f",
             remainder(so_far_rad + more_rad, 2.0 * HCI_PI) * 180.0 / HCI_PI);
    t->has_offset = true;
    hci_tuning_say(&t->tuning, HCI_TUNING_READ, "--angle-offset %s: the electrical zero of the angle, by %s",
                   t->offset, why);
}

/* A zero that is off, and nothing else, is set right. */
static bool finds_offset(const hci_check *c)
{
    size_t found = 0;
    for (size_t k = 0; k < c->findings; ++k)
        found += c->finding[k].probability >= HCI_CHECK_FOUND;
    return found == 1 && strcmp(c->finding[0].slip, "run_angle_offset") == 0;
}

hci_status cli_tune_check(cli_tuning *t, hci_note *note)
{
    static hci_check check;
    const char *run[HCI_CHECK_MOST_RUNS];
    char folder[CLI_TUNE_PATH];
    command_line c = {{"check", t->machine}, 2};
    hci_status status = run_check(t, run, &check, note);
    if (!status && finds_offset(&check)) {
        take_offset(t, check.zero_rad, "what check finds in the logs");
        status = read_inputs(t, note);
        if (!status) status = run_check(t, run, &check, note);
    }
    if (status) return status;
    for (size_t k = 0; k < checked_runs(t, run); ++k)
        add(&c, run[k]);
    path_in(t, "check", folder);
    add_reading(&c, t);
    add(&c, "-o");
    add(&c, folder);
    note_command(t, &c, true);
    say_check(t, &check);
    judge_check(t, &check);
    return hci_check_write(&check, folder, note);
}

/* ---- waveforms: what a recording without load shows by itself ---- */

/* Of the phase currents, beside those that another recording has or the machine is rated for. */
#define NO_CURRENT 0.01

/* Times what noise alone makes of a mean. */
#define NOISE_OF_MEAN 5.0

static double rms_of(const hci_run *r)
{
    double sum = 0.0;
    for (size_t k = 0; k < 3 * r->count; ++k)
        sum += r->i_A[k] * r->i_A[k];
    return sqrt(sum / (3.0 * (double)r->count));
}

/* Of phase currents in the plane that turns with the angle: what a drive makes stands still there, and noise
 * and the offsets of sensors go to 0. */
static double mean_vector(const hci_run *r)
{
    double along = 0.0, across = 0.0;
    for (size_t k = 0; k < r->count && r->theta_m_rad; ++k)
        for (int s = 0; s < 3; ++s) {
            const double x = r->pole_pairs * r->theta_m_rad[k] - 2.0 * HCI_PI * s / 3.0;
            along += r->i_A[3 * k + (size_t)s] * cos(x);
            across += r->i_A[3 * k + (size_t)s] * sin(x);
        }
    return 2.0 / 3.0 * hypot(along, across) / (double)r->count;
}

/* None, or what a sensor of current makes of none. */
static bool has_no_current(const cli_tuning *t, const hci_run *r)
{
    const double rms_A = rms_of(r);
    double most_A = t->declared.rated_current_A > 0.0 ? t->declared.rated_current_A : 0.0;
    for (size_t k = 0; k < t->runs.count; ++k)
        most_A = fmax(most_A, rms_of(&t->runs.run[k]));
    if (rms_A <= NO_CURRENT * most_A) return true;
    return r->theta_m_rad && mean_vector(r) < NOISE_OF_MEAN * rms_A / sqrt((double)r->count);
}

/* Of the voltages, that of currents may drop and no more. */
#define DROP 0.01

/* Times what chance makes two recordings of noise have in common. */
#define CHANCE 3.0

static double dot(const double a[3], const double b[3])
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/* Of three phases, without what they have in common. */
static void star(const double phase[3], double without[3])
{
    for (int s = 0; s < 3; ++s)
        without[s] = phase[s] - (phase[0] + phase[1] + phase[2]) / 3.0;
}

/* The part of the voltages that follows the current, in phase with it or a quarter of a turn off, from 0 to
 * 1: at least the share of what the current drops in an unknown resistance, as long as the current itself is
 * not noise. */
static double share_that_follows(const hci_run *r)
{
    double v[3], i[3], along = 0.0, across = 0.0, vv = 0.0, ii = 0.0;
    for (size_t k = 0; k < r->count; ++k) {
        star(r->v_V + 3 * k, v);
        star(r->i_A + 3 * k, i);
        const double quarter[3] = {(i[1] - i[2]) / sqrt(3.0), (i[2] - i[0]) / sqrt(3.0),
                                   (i[0] - i[1]) / sqrt(3.0)};
        along += dot(v, i), across += dot(v, quarter);
        vv += dot(v, v), ii += dot(i, i);
    }
    return vv * ii > 0.0 ? hypot(along, across) / sqrt(vv * ii) : 0.0;
}

static double rms_voltage(const hci_run *r)
{
    double v[3], sum = 0.0;
    for (size_t k = 0; k < r->count; ++k) {
        star(r->v_V + 3 * k, v);
        sum += dot(v, v);
    }
    return sqrt(sum / (3.0 * (double)r->count));
}

/* Whether what the currents drop cannot matter in the voltages: by a known resistance, or because the
 * voltages do not follow the currents. */
static bool drops_nothing(const cli_tuning *t, const hci_run *r)
{
    const double ohm = t->declared.resistance_ohm;
    if (ohm > 0.0 && ohm * rms_of(r) <= DROP * rms_voltage(r)) return true;
    return share_that_follows(r) <= DROP + CHANCE / sqrt(2.0 * (double)r->count);
}

/* Whether a recording is one for the quantity. Cogging torque that a sensor has measured is left to diagnose,
 * which finds it in all recordings at once and knows what they leave open of it: from one of them alone it is
 * off by more than what would be stated. */
static bool is_for(const cli_tuning *t, const hci_run *r, hci_waveform_quantity quantity)
{
    if (quantity == HCI_WAVEFORM_BACK_EMF) return r->v_V && has_no_current(t, r) && drops_nothing(t, r);
    return r->torque_source == HCI_TORQUE_HOLDING;
}

/* The largest of them. */
static void say_waveform(cli_tuning *t, size_t run, const hci_waveform *w)
{
    const bool is_emf = w->quantity == HCI_WAVEFORM_BACK_EMF;
    double above = HUGE_VAL;
    if (w->remark.text[0]) hci_tuning_say(&t->tuning, HCI_TUNING_READ, "  %s", w->remark.text);
    if (!is_emf) return; /* said when diagnose has added to it */
    hci_tuning_say(&t->tuning, HCI_TUNING_FOUND, "back-EMF, %zu orders, from %s", w->kept, name_of(t, run));
    for (size_t shown = 0; shown < CLI_TUNE_ORDERS_SAID && shown < w->kept; ++shown) {
        const hci_waveform_order *most = NULL;
        for (size_t k = 0; k < w->count; ++k)
            if (w->order[k].kept && w->order[k].amplitude < above &&
                (!most || w->order[k].amplitude > most->amplitude))
                most = &w->order[k];
        if (!most) break;
        above = most->amplitude;
        hci_tuning_say(&t->tuning, HCI_TUNING_FOUND, "  order %.5g: %.4g ± %.1g V·s/rad (peak of a phase)",
                       most->order, most->amplitude, most->std_error);
    }
}

/* Times the back-EMF of the data sheet, of what was measured. */
static double to_sheet(const cli_tuning *t, const hci_waveform *w)
{
    for (size_t k = 0; k < w->count; ++k)
        if (fabs(w->order[k].order - 1.0) < HCI_ORDER_TOLERANCE)
            return 1.5 * w->order[k].amplitude / t->reading.run.torque_constant_Nm_per_A;
    return 1.0;
}

/* Puts it into the machine in place of what the data sheet gave. */
static hci_status take_waveform(cli_tuning *t, size_t k, const hci_waveform *w, bool is_far, hci_note *note)
{
    const bool is_emf = w->quantity == HCI_WAVEFORM_BACK_EMF;
    const hci_run *r = &t->runs.run[k];
    const bool holds = !is_emf && r->torque_source == HCI_TORQUE_HOLDING;
    const double inertia_kgm2 =
        t->declared.inertia_kgm2 > 0.0 ? t->declared.inertia_kgm2 : r->turns_inertia_kgm2;
    char pole_pairs[16], constant[32], inertia[32];
    command_line c = {{"harmonics", t->arguments->word[k]}, 2};
    snprintf(pole_pairs, sizeof pole_pairs, "%d", t->declared.model.pole_pairs);
    hci_number_text(t->reading.run.torque_constant_Nm_per_A, constant);
    hci_number_text(inertia_kgm2, inertia);
    add_option(&c, "quantity", is_emf ? "back_emf" : "cogging");
    add_option(&c, "pole-pairs", pole_pairs);
    if (holds) add_option(&c, "torque-constant", constant);
    if (holds && inertia_kgm2 > 0.0) add_option(&c, "inertia", inertia);
    if (is_far) add_option(&c, "max-order", "60");
    if (!is_emf && (t->arguments->given[TUNE_HOLDING] || r->slow_beside_others))
        add_option(&c, "holding", NULL);
    add_reading(&c, t);
    add(&c, "-o");
    add(&c, t->machine);
    say_waveform(t, k, w);
    *(is_emf ? &t->has_emf : &t->has_cogging) = true;
    if (is_emf) t->emf_to_sheet = to_sheet(t, w);
    const hci_status status = run(t, t->commands.harmonics, &c, note);
    if (!status && is_emf && fabs(w->zero_rad) > 0.0) take_offset(t, w->zero_rad, "the voltages");
    return status ? status : read_inputs(t, note);
}

#define USUAL_ORDER 60.0

/* Up to the usual order; where the samples of a turn do not reach it, those of turns are put together. */
static hci_status find_far(const hci_run *r, const hci_waveform_options *options, hci_waveform *w,
                           bool *is_far, hci_note *why)
{
    hci_waveform_options far = *options;
    hci_waveform more = {0};
    hci_note unused = {{0}};
    const hci_status status = hci_waveform_find(r, options, w, why);
    *is_far = false;
    if (status || (double)w->count * w->step > USUAL_ORDER - 1.0) return status;
    far.max_order = USUAL_ORDER;
    if (hci_waveform_find(r, &far, &more, &unused)) return HCI_OK;
    hci_waveform_release(w);
    *w = more;
    *is_far = true;
    return HCI_OK;
}

static hci_status find_waveform(cli_tuning *t, size_t k, hci_waveform_quantity quantity, bool *found,
                                hci_note *note)
{
    const hci_run *r = &t->runs.run[k];
    const bool holds = r->torque_source == HCI_TORQUE_HOLDING;
    const hci_waveform_options options = {.quantity = quantity,
                                          .pole_pairs = t->declared.model.pole_pairs,
                                          .max_order = (double)NAN,
                                          .torque_constant_Nm_per_A =
                                              quantity == HCI_WAVEFORM_COGGING && holds
                                                  ? t->reading.run.torque_constant_Nm_per_A
                                                  : (double)NAN};
    hci_waveform w = {0};
    hci_note why = {{0}};
    bool is_far = false;
    hci_status status = find_far(r, &options, &w, &is_far, &why);
    *found = !status && w.kept > 0;
    if (*found && quantity == HCI_WAVEFORM_COGGING &&
        cli_tune_order_of_slots(t) > (double)w.count * w.step + HCI_ORDER_TOLERANCE) {
        t->cogging_reach = (double)w.count * w.step;
        t->has_alias = true; /* until another recording shows it */
        *found = false;
    }
    if (status) hci_tuning_say(&t->tuning, HCI_TUNING_UNKNOWN, "%s", why.text);
    status = *found ? take_waveform(t, k, &w, is_far, note) : HCI_OK;
    if (quantity == HCI_WAVEFORM_COGGING && *found) {
        t->cogging_reach = (double)w.count * w.step;
        t->has_alias = false;
    }
    if (*found && quantity == HCI_WAVEFORM_COGGING && !status) {
        t->cogging = w;
    } else
        hci_waveform_release(&w);
    return status;
}

/* Voltages that nothing was taken from. */
static void say_not_open(cli_tuning *t)
{
    for (size_t k = 0; k < t->runs.count && !t->has_emf; ++k) {
        const hci_run *r = &t->runs.run[k];
        if (!r->v_V || is_for(t, r, HCI_WAVEFORM_BACK_EMF)) continue;
        hci_tuning_say(&t->tuning, HCI_TUNING_UNKNOWN,
                       "The back-EMF is not taken from the voltages of %s: currents of %.3g A rms flow, and "
                       "%.0f %% of the voltage follows them. Record voltages with open terminals, turned by "
                       "another motor.",
                       name_of(t, k), rms_of(r), 100.0 * share_that_follows(r));
    }
}

/* Of each quantity the first recording that shows it. */
hci_status cli_tune_waveforms(cli_tuning *t, hci_note *note)
{
    static const hci_waveform_quantity QUANTITIES[] = {HCI_WAVEFORM_BACK_EMF, HCI_WAVEFORM_COGGING};
    hci_status status = HCI_OK;
    for (int q = 0; q < 2 && t->is_own && !cli_tune_is_blocked(t); ++q) {
        bool found = false;
        for (size_t k = 0; k < t->runs.count && !found && !status; ++k)
            if (is_for(t, &t->runs.run[k], QUANTITIES[q]))
                status = find_waveform(t, k, QUANTITIES[q], &found, note);
    }
    if (!status && t->is_own && !cli_tune_is_blocked(t)) say_not_open(t);
    return status;
}

/* ---- what the model lacks ---- */

hci_status cli_tune_diagnose(cli_tuning *t, hci_note *note)
{
    const hci_diagnose_options options = {.progress = cli_progress};
    char folder[CLI_TUNE_PATH];
    command_line c = {{"diagnose", t->machine, "--runs", t->list}, 4};
    if (cli_tune_is_blocked(t)) return HCI_OK;
    path_in(t, "diagnose", folder);
    if (t->arguments->given[TUNE_HOLDING]) add_option(&c, "holding", NULL);
    add_reading(&c, t);
    add(&c, "-o");
    add(&c, folder);
    note_command(t, &c, true);
    t->diagnosed = hci_diagnose(&t->declared, &t->effects.list, &t->runs, &options, &t->diagnosis, note);
    cli_progress_end();
    if (t->diagnosed > HCI_NOT_REACHED) return t->diagnosed;
    t->has_diagnosis = true;
    return hci_diagnosis_write(&t->diagnosis, NULL, &t->runs, t->machine, folder, note);
}

/* ---- currents ---- */

bool cli_tune_can_solve(const cli_tuning *t)
{
    return !cli_tune_is_blocked(t) &&
           (t->has_emf || t->has_cogging || (!t->diagnosis.nothing_measured && t->diagnosis.runs > 0));
}

/* The largest mean torque, and the largest i_q as torque, that the recordings show. */
static void recorded(const cli_tuning *t, double *mean_Nm, double *current_Nm)
{
    double most_A = 0.0;
    *mean_Nm = 0.0;
    for (size_t k = 0; k < t->diagnosis.runs; ++k)
        if (t->diagnosis.run[k].source == HCI_TORQUE_MEASURED)
            *mean_Nm = fmax(*mean_Nm, fabs(t->diagnosis.run[k].mean_torque_Nm));
    for (size_t k = 0; k < t->runs.count; ++k) {
        const hci_run *r = &t->runs.run[k];
        const size_t count = has_no_current(t, r) ? 0 : 3 * r->count;
        for (size_t n = 0; n < count; ++n)
            most_A = fmax(most_A, fabs(r->i_A[n]));
    }
    *current_Nm = most_A * t->reading.run.torque_constant_Nm_per_A;
}

/* Three digits are enough of a torque that nobody asked for. */
static double rounded(double x)
{
    char text[32];
    double value = 0.0;
    snprintf(text, sizeof text, "%.2g", x);
    sscanf(text, "%lf", &value);
    return value;
}

static double rounded_down(double x)
{
    const double digit = pow(10.0, floor(log10(x)) - 1.0);
    return rounded(digit * floor(x / digit));
}

/* The most that is taken of the torque that a sine of the rated current makes, where nobody asked for one. */
static const double OF_RATED = 0.9;

/* A mean torque below this share of what the currents could make is friction or the zero of the sensor. */
static const double LEAST_LOAD = 0.02;

static void choose_torque(cli_tuning *t)
{
    const hci_machine_data *m = &t->declared;
    const double rated_Nm = m->rated_current_A * t->reading.run.torque_constant_Nm_per_A;
    const char *why;
    double mean_Nm, current_Nm;
    recorded(t, &mean_Nm, &current_Nm);
    if (!(mean_Nm > LEAST_LOAD * current_Nm && current_Nm > 0.0)) mean_Nm = 0.0;
    t->has_load = mean_Nm > 0.0;
    if (t->arguments->given[TUNE_TORQUE])
        t->mean_Nm = t->arguments->number[TUNE_TORQUE], why = "as asked for by --torque";
    else if (m->rated_torque_Nm > 0.0 && !(mean_Nm > 0.0 && mean_Nm < m->rated_torque_Nm))
        t->mean_Nm = m->rated_torque_Nm, why = "the rated torque";
    else if (mean_Nm > 0.0)
        t->mean_Nm = rounded(mean_Nm),
        why = "the largest mean torque of the recordings; up to there they tell what to expect";
    else if (rated_Nm > 0.0)
        t->mean_Nm = rounded(rated_Nm / 3.0),
        why = "what a third of the rated current makes; no recording has a load";
    else if (!(current_Nm > 0.0))
        t->mean_Nm = rounded(t->reading.run.torque_constant_Nm_per_A),
        why = "what 1 A makes; nothing is rated, and no recording has a current";
    else
        t->mean_Nm = rounded(current_Nm),
        why = "what the largest recorded current makes; nothing is rated, and no recording has a load";
    const bool is_chosen = !t->arguments->given[TUNE_TORQUE] && !(m->rated_torque_Nm > 0.0);
    if (is_chosen && rated_Nm > 0.0 && t->mean_Nm > OF_RATED * rated_Nm)
        t->mean_Nm = rounded_down(OF_RATED * rated_Nm),
        why = "nine tenths of what a sine of the rated current makes; what takes the ripple away heats, too";
    hci_tuning_say(&t->tuning, HCI_TUNING_WANTED, "a torque without ripple of %.4g N·m: %s", t->mean_Nm, why);
}

static hci_status read_corrected(cli_tuning *t, const char *machine, hci_note *note)
{
    char path[CLI_TUNE_PATH];
    path_in(t, "target.csv", path);
    hci_status status = hci_tuning_write_target(t->out, t->mean_Nm, note);
    if (!status) status = hci_target_read(path, &t->target, note);
    if (!status) status = hci_machine_read(machine, &t->corrected, note);
    if (!status) status = hci_effects_read_machine(machine, &t->found, note);
    if (!status) status = hci_uncertainty_read_machine(machine, &t->uncertainty, note);
    return status;
}

/* A sine of the rated current heats as much as is allowed: so much rms in each phase. */
static void limit_heat(cli_tuning *t, hci_solve_options *o, char text[32], command_line *c)
{
    if (!(t->corrected.rated_current_A > 0.0)) return;
    double rms_A = 0.0;
    snprintf(text, 32, "%.5g", t->corrected.rated_current_A / sqrt(2.0));
    sscanf(text, "%lf", &rms_A);
    for (int s = 0; s < 3; ++s)
        o->limits.rms_A[s] = rms_A;
    add_option(c, "limit-rms", text);
    hci_tuning_say(&t->tuning, HCI_TUNING_WANTED,
                   "within %s A rms in each phase, the heat of a sine of the rated current", text);
}

static void note_target(cli_tuning *t)
{
    char mean[32];
    hci_number_text(t->mean_Nm, mean);
    note_text(t, "printf 'order,amplitude_Nm,phase_rad\\n0,%s,0\\n' >\"$OUT\"/target.csv\n", mean);
}

/* What the corrected machine makes without current: over a mechanical turn where the logs know it. */
static hci_status open_torque(cli_tuning *t, hci_note *note)
{
    static double theta_m_rad[HCI_TUNING_POINTS], i_A[3 * HCI_TUNING_POINTS], still[HCI_TUNING_POINTS];
    hci_run run = {.count = HCI_TUNING_POINTS,
                   .pole_pairs = t->corrected.model.pole_pairs,
                   .theta_m_rad = theta_m_rad,
                   .speed_rad_per_s = still,
                   .i_A = i_A,
                   .turn_known = true};
    for (size_t k = 0; k < t->runs.count; ++k)
        t->tuning.open_is_mechanical = t->tuning.open_is_mechanical || t->runs.run[k].turn_known;
    const double turns = t->tuning.open_is_mechanical ? 1.0 : 1.0 / run.pole_pairs;
    for (size_t k = 0; k < HCI_TUNING_POINTS; ++k)
        theta_m_rad[k] = 2.0 * HCI_PI * turns * (double)k / (HCI_TUNING_POINTS - 1);
    const hci_status status = hci_predict(&t->corrected, &t->found.list, &run, t->open_Nm, note);
    if (!status) t->tuning.open_Nm = t->open_Nm;
    return status;
}

hci_status cli_tune_solve(cli_tuning *t, hci_note *note)
{
    char machine[CLI_TUNE_PATH], target[CLI_TUNE_PATH], folder[CLI_TUNE_PATH], rms[32];
    if (!cli_tune_can_solve(t)) return HCI_OK;
    path_in(t, "diagnose/machine", machine);
    path_in(t, "target.csv", target);
    path_in(t, "currents", folder);
    choose_torque(t);
    if (!(t->mean_Nm > 0.0)) return HCI_OK;
    command_line c = {{"solve", machine, "--target", target, "--auto", "--report", "-o", folder}, 8};
    hci_status status = read_corrected(t, machine, note);
    if (!status) status = open_torque(t, note);
    if (status) return status;
    hci_solve_options options = {.target = &t->target,
                                 .effects = &t->found.list,
                                 .uncertainty = &t->uncertainty,
                                 .progress = cli_progress};
    limit_heat(t, &options, rms, &c);
    note_target(t);
    note_command(t, &c, true);
    t->tuning.solved = hci_solve(&t->corrected, &options, &t->solution, note);
    cli_progress_end();
    if (t->tuning.solved > HCI_NOT_REACHED) return t->tuning.solved;
    t->is_solved = true;
    t->tuning.solution = &t->solution;
    return hci_solution_write_with_report(&t->corrected, &t->solution, t->tuning.solved,
                                          &(hci_report_sources){.machine = machine, .target = target}, folder,
                                          note);
}

/* ---- table ---- */

/* What the header of the table that was emitted says of it; 0: nothing. */
typedef struct {
    unsigned long turns;
    double own_Nm, torque_Nm, with_Nm; /* ripple that its cut makes, at which torque, and all that is left */
} table_header;

static table_header read_header(const char *folder, const char *name)
{
    char path[2 * CLI_TUNE_PATH], line[512];
    table_header h = {0};
    snprintf(path, sizeof path, "%s/%s.h", folder, name);
    FILE *f = fopen(path, "r");
    while (f && fgets(line, sizeof line, f)) {
        sscanf(line, " * Angle: uint32_t, 2^32 = %lu electrical turn", &h.turns);
        sscanf(line,
               " * Ripple: the cut to this table makes %lf N*m from peak to peak at %lf N*m; with it %lf N*m",
               &h.own_Nm, &h.torque_Nm, &h.with_Nm);
    }
    if (f) fclose(f);
    return h;
}

bool cli_tune_knows_zero(const cli_tuning *t)
{
    bool knows = !t->is_own || t->has_load;
    for (size_t k = 0; k < t->runs.count; ++k) {
        const hci_run *r = &t->runs.run[k];
        const bool has_phases = r->v_V && r->theta_m_rad && !r->voltage_is_dq;
        knows = knows || r->is_electrical || r->zero_is_given || (t->has_emf && has_phases);
    }
    return knows;
}

/* Components that a current loop is asked to follow; a few are usual. */
#define MANY_COMPONENTS 24

static void say_components(cli_tuning *t)
{
    const hci_currents *c = &t->solution.current;
    double most = 0.0;
    for (size_t k = 0; k < c->count; ++k)
        most = fmax(most, c->wave[k].order);
    hci_tuning_say(
        &t->tuning, HCI_TUNING_LOAD,
        "The currents have %zu component%s up to order %.4g, which is %.3g Hz at 100 rpm%s.", c->count,
        c->count == 1 ? "" : "s", most, most * t->corrected.model.pole_pairs * 100.0 / 60.0,
        c->count > MANY_COMPONENTS
            ? ": more than most current loops follow; hci-solve solve --auto 6 finds the best six, and "
              "simulate --table --drive says what the loop makes of them"
            : "");
}

/* Where the solution is linear in the torque. */
static void say_per_torque(cli_tuning *t, const char *currents, const char *name, const char *machine)
{
    if (t->solution.per_Nm == NULL) return;
    hci_tuning_say(
        &t->tuning, HCI_TUNING_LOAD,
        "Where the torque changes, as in a joint that moves freely, load it in two parts, one of them times "
        "the torque: hci-solve emit %s --name %s --frame dq --per-torque --machine %s%s -o FOLDER.",
        currents, name, machine, cli_tune_knows_zero(t) ? "" : " --angle-of-logs");
}

/* What the table is, and how its firmware reads it. */
static void say_table(cli_tuning *t, const char *name, const char *folder, const table_header *h)
{
    hci_tuning_say(
        &t->tuning, HCI_TUNING_LOAD,
        "%s/%s.h and %s.c need hci/table.h alone: `hci_currents_dq i = hci_table_f32_dq(&%s, "
        "angle);`, where 2^32 of "
        "the angle is %lu electrical turn%s from the zero of the logs%s%s%s. They are the whole "
        "reference for %.4g N·m (docs/controller.md); their cut makes %.2g N·m of ripple, which is in the "
        "figures above; another --max-error of emit makes it less, or the table smaller.",
        folder, name, name, name, h->turns, h->turns == 1 ? "" : "s",
        offset_of(t) ? " with --angle-offset " : "", offset_of(t) ? offset_of(t) : "",
        h->turns == 1 ? "" : ", not one: the angle goes on from turn to turn", t->mean_Nm, h->own_Nm);
}

static void say_other_drives(cli_tuning *t, const char *currents, const char *name, const char *machine,
                             const char *folder)
{
    hci_tuning_say(&t->tuning, HCI_TUNING_LOAD,
                   "For a drive whose firmware is somebody else's: hci-solve emit %s --name %s --for "
                   "simplefoc --machine %s%s -o %s, or another one of docs/drives.",
                   currents, name, machine, cli_tune_knows_zero(t) ? "" : " --angle-of-logs", folder);
    if (offset_of(t))
        hci_tuning_say(&t->tuning, HCI_TUNING_LOAD,
                       "The zero of the logs is not the machine's: a map over the encoder's turn takes "
                       "--encoder-offset %.6g besides (mechanical degrees, of the encoder that was logged).",
                       -strtod(offset_of(t), NULL) / t->declared.model.pole_pairs);
}

static void say_first_turn(cli_tuning *t, const char *machine, const char *currents)
{
    hci_tuning_say(&t->tuning, HCI_TUNING_LOAD,
                   "First turn on the bench: log angle and currents while the table is played, and run "
                   "hci-solve check %s LOG --table %s%s%s, which tells an angle that is off.",
                   machine, currents, offset_of(t) ? " --angle-offset " : "",
                   offset_of(t) ? offset_of(t) : "");
}

hci_status cli_tune_emit(cli_tuning *t, hci_note *note)
{
    const char *name = t->arguments->value[TUNE_NAME] ? t->arguments->value[TUNE_NAME] : "tuned";
    char currents[CLI_TUNE_PATH], folder[CLI_TUNE_PATH], machine[CLI_TUNE_PATH];
    if (!t->is_solved) return HCI_OK;
    path_in(t, "currents", currents);
    path_in(t, "table", folder);
    path_in(t, "diagnose/machine", machine);
    command_line c = {{"emit", currents, "--name", name, "--frame", "dq", "--machine", machine, "-o", folder},
                      10};
    if (!cli_tune_knows_zero(t)) add_option(&c, "angle-of-logs", NULL);
    const hci_status status = run(t, t->commands.emit, &c, note);
    if (status) return status;
    t->is_emitted = true;
    const table_header header = read_header(folder, name);
    t->tuning.table_Nm = header.with_Nm;
    if (t->solution.expected.state == HCI_RIPPLE_KNOWN)
        hci_expected_ripple_add_table(&t->solution.expected, header.own_Nm, t->mean_Nm);
    say_table(t, name, folder, &header);
    say_other_drives(t, currents, name, machine, folder);
    say_components(t);
    say_per_torque(t, currents, name, machine);
    say_first_turn(t, machine, currents);
    return HCI_OK;
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
