#include "cli/tune/tune_steps.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "cli/terminal/progress.h"
#include "cli/tune/tune_commands.h"
#include "cli/tune/tune_cover.h"
#include "cli/tune/tune_options.h"
#include "cli/tune/tune_read.h"
#include "cli/tune/tune_suspect.h"
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

/* What can be refused before any work. */
static hci_status check_words(const cli_arguments *a, hci_note *note)
{
    if (!a->value[TUNE_OUT] || !*a->value[TUNE_OUT])
        return hci_note_set(note, HCI_ERROR_ARGUMENT, "tune: add --out FOLDER, a new folder for the results");
    if (a->given[TUNE_RUNS] && a->words != 1)
        return hci_note_set(note, HCI_ERROR_ARGUMENT,
                            "tune: found %zu words, expected one machine beside --runs LIST", a->words);
    for (size_t k = 0; k < a->words; ++k)
        for (size_t other = 0; other < k; ++other)
            if (strcmp(a->word[k], a->word[other]) == 0)
                return hci_note_set(note, HCI_ERROR_ARGUMENT,
                                    "tune: found the log %s twice, expected each one once; leave one out",
                                    a->word[k]);
    return a->given[TUNE_NAME] ? hci_emit_check_name(a->value[TUNE_NAME], note) : HCI_OK;
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

const char *cli_tune_name_of(const cli_tuning *t, size_t k)
{
    return t->arguments->given[TUNE_RUNS] ? t->runs.run[k].name : t->arguments->word[k];
}

/* ", 0.52 turns, 386 samples a turn, which tell orders up to 16.8": of the electrical turn. */
static void cover_words(const hci_run *r, char *text, size_t size)
{
    const cli_tune_cover x = cli_tune_cover_of(r);
    text[0] = '\0';
    if (!(x.samples_a_turn > 0.0)) return;
    snprintf(text, size, ", %.3g turns, %.3g samples a turn, which tell orders up to %.3g", x.turns,
             x.samples_a_turn, x.highest_order);
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
    if (most_A > 0.0)
        snprintf(currents, sizeof currents, "phase currents up to %.3g A%s", most_A,
                 r->lacks_id ? ", i_d in no column and taken as 0" : "");
    cover_words(r, cover, sizeof cover);
    hci_tuning_say(&t->tuning, HCI_TUNING_READ, "%s: %zu samples%s%s; %s; %s%s", cli_tune_name_of(t, k),
                   r->count, time, cover, source_words(r), currents, r->v_V ? "; voltages" : "");
}

static void release_inputs(cli_tuning *t)
{
    hci_runs_release(&t->runs);
    hci_effects_release(&t->effects);
    hci_machine_release(&t->declared);
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
        hci_tuning_say(&t->tuning, HCI_TUNING_READ, "%s: %s", cli_tune_name_of(t, first), text);
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

/* ---- conventions ---- */

/* Of a ratio, which units make. */
#define OF_A_UNIT 0.05

/* What a column of angle, speed or time is in where the change of the angle over time is so many times the
 * speed: a unit that is not the one that it was read in; "": none that is known. */
static const char *unit_of_ratio(const cli_tuning *t, const hci_check_evidence *e)
{
    const struct {
        double ratio;
        const char *words;
    } UNITS[] = {
        {360.0, ": 360 is degrees in a column that is read in turns; say --column theta_m_deg=COLUMN"},
        {30.0 / HCI_PI,
         ": 30/π is rad/s in a column that is read in rpm; say --column speed_rad_per_s=COLUMN"},
        {1e-3, ": 0.001 is ms in a column that is read in s; say --column time_ms=COLUMN"},
        {1e-6, ": a millionth is µs in a column that is read in s; say --column time_us=COLUMN"},
        {1.0 / (60.0 * t->declared.model.pole_pairs),
         ": 1/60 over the pole pairs is electrical rpm in a column that is read in turn/s; say --column "
         "speed_e_rpm=COLUMN"}};
    if (strcmp(e->name, "angle_speed") != 0) return "";
    for (size_t k = 0; k < sizeof UNITS / sizeof *UNITS; ++k)
        if (fabs(e->declared / UNITS[k].ratio - 1.0) < OF_A_UNIT) return UNITS[k].words;
    return "";
}

static bool is_of_poles(const char *slip)
{
    return strncmp(slip, "pole", 4) == 0;
}

static void say_check(cli_tuning *t, const hci_check *c)
{
    hci_tuning_say(&t->tuning, HCI_TUNING_READ, "conventions: %s (%zu relations checked)",
                   hci_check_verdict_name(c->verdict), c->evidences);
    for (size_t k = 0; k < c->evidences; ++k) {
        const hci_check_evidence *e = &c->evidence[k];
        if (e->state != HCI_CHECK_UNMENDED) continue;
        hci_tuning_say(&t->tuning, HCI_TUNING_READ, "  not understood: %s is %.4g, expected %s%.4g%s",
                       e->words, e->declared, e->at_most ? "at most " : "", e->expected, unit_of_ratio(t, e));
    }
    for (size_t k = 0; k < c->findings; ++k) {
        const hci_check_finding *f = &c->finding[k];
        const bool is_found = f->probability >= HCI_CHECK_FOUND;
        hci_tuning_say(&t->tuning, is_found ? HCI_TUNING_READ : HCI_TUNING_UNKNOWN,
                       "%s: %s (%.3g %%); %s:%zu, %s: found %s, should be %s",
                       is_found ? "slip" : "possible slip", f->words, 100.0 * f->probability, f->file,
                       f->line, f->column, f->found, f->should_be);
        if (is_found && !t->has_slip)
            snprintf(t->slip, sizeof t->slip, "Most likely %s (%.3g %%), so nothing was solved", f->words,
                     100.0 * f->probability);
        if (is_found && !t->has_slip) t->slip_is_of_poles = is_of_poles(f->slip);
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

/* Whether an electrical speed was logged beside a mechanical angle, or a mechanical one beside an electrical.
 */
static bool has_speed_to_count(const cli_tuning *t)
{
    for (size_t k = 0; k < t->runs.count; ++k) {
        const hci_run *r = &t->runs.run[k];
        if (r->speed_rad_per_s && r->speed_window == 0 && r->speed_is_electrical != r->is_electrical)
            return true;
    }
    return false;
}

/* Whether something in the files counts the pole pairs. The orders of a ripple do not: motors with other
 * slots and half or twice the poles have them too. */
static bool counts_pole_pairs(const cli_tuning *t, const hci_check *c)
{
    static const char *const NAMES[] = {"current_order", "voltage_order", "angle_ratio", "frequency_speed"};
    for (size_t k = 0; k < c->evidences; ++k)
        for (size_t n = 0; n < sizeof NAMES / sizeof *NAMES; ++n)
            if (strcmp(c->evidence[k].name, NAMES[n]) == 0) return true;
    for (size_t k = 0; k < c->evidences; ++k)
        if (strcmp(c->evidence[k].name, "angle_speed") == 0) return has_speed_to_count(t);
    return false;
}

/* Where it is certain that something is read wrongly, and not what. */
static void judge_ambiguous(cli_tuning *t, const hci_check *c)
{
    if (t->has_slip || cli_tune_is_typed(t) || c->verdict != HCI_CHECK_AMBIGUOUS ||
        c->probability_as_declared > 1.0 - HCI_CHECK_FOUND)
        return;
    t->has_slip = true;
    snprintf(t->slip, sizeof t->slip, "Something is read wrongly (%.3g %%)%s%s, so nothing was solved",
             100.0 * (1.0 - c->probability_as_declared), c->findings > 0 ? ", perhaps " : "",
             c->findings > 0 ? c->finding[0].words : "");
}

/* Of measured and calculated torque, or its inverse: beyond it no magnet and no sensor is meant. */
#define ANOTHER_TORQUE 2.5

static void judge_torque(cli_tuning *t, const hci_check_evidence *e)
{
    if (t->has_slip || e->state == HCI_CHECK_AGREES || strcmp(e->name, "torque_size") != 0) return;
    if (fabs(log(fabs(e->declared / e->expected))) < log(ANOTHER_TORQUE)) return;
    t->has_slip = true;
    snprintf(t->slip, sizeof t->slip,
             "The torque is %.3g times what the currents make with the constant of the sheet (the other side "
             "of a gear, another unit, another motor), so nothing was solved",
             e->declared / e->expected);
}

/* Of a shaft that is taken to turn by itself the current cannot work against the motion. */
static void judge_current(cli_tuning *t)
{
    for (size_t k = 0; k < t->runs.count && !t->has_slip; ++k) {
        if (t->runs.run[k].current_way >= 0) continue;
        t->has_slip = true;
        snprintf(
            t->slip, sizeof t->slip,
            "i_q works against the motion in %.120s: i_q has the opposite sign, or angle and speed have, "
            "or another machine turns the shaft; a table of it could double the ripple, so nothing was "
            "solved",
            cli_tune_name_of(t, k));
    }
}

/* Friction brakes, so that a torque of the motor at a shaft that is driven is against the motion. In one
 * direction the zero of the sensor may be it as well. */
static void judge_torque_way(cli_tuning *t)
{
    const cli_tune_torque_way way = cli_tune_torque_way_of(t);
    t->drives_Nm = way.has_both ? 0.0 : way.drives_Nm;
    if (t->has_slip || !way.has_both || !(way.drives_Nm > 0.0)) return;
    t->has_slip = true;
    snprintf(
        t->slip, sizeof t->slip,
        "The torque in %.80s drives the shaft by %.3g N·m in both directions, where friction brakes: its "
        "sign is the other one, or it is what a drive makes and not what a sensor shows; a table of it "
        "could double the ripple, so nothing was solved; --column torque=-COLUMN turns the sign of a sensor; "
        "what a drive makes is left out for its current",
        cli_tune_name_of(t, way.run), way.drives_Nm);
}

static void judge_check(cli_tuning *t, const hci_check *c)
{
    t->counts_pole_pairs = counts_pole_pairs(t, c);
    for (size_t k = 0; k < c->evidences && c->verdict != HCI_CHECK_CONSISTENT; ++k)
        judge_torque(t, &c->evidence[k]);
    judge_ambiguous(t, c);
    judge_current(t);
    judge_torque_way(t);
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

void cli_tune_take_offset(cli_tuning *t, double more_rad, const char *why)
{
    const double so_far_rad = t->runs.count > 0 ? t->runs.run[0].zero_offset_rad : 0.0;
    snprintf(t->offset, sizeof t->offset, "%.3f",
             remainder(so_far_rad + more_rad, 2.0 * HCI_PI) * 180.0 / HCI_PI);
    t->has_offset = true;
    hci_tuning_say(&t->tuning, HCI_TUNING_READ, "--angle-offset %s: the electrical zero of the angle, by %s",
                   t->offset, why);
}

/* An encoder's zero may lie on an axis as anywhere else. */
static const char AXIS[] = "run_angle_zero_";

/* A zero that is off, and nothing else, is set right. */
static bool finds_offset(const hci_check *c)
{
    size_t found = 0;
    for (size_t k = 0; k < c->findings; ++k)
        found += c->finding[k].probability >= HCI_CHECK_FOUND;
    const char *slip = found == 1 ? c->finding[0].slip : "";
    return isfinite(c->zero_rad) &&
           (strcmp(slip, "run_angle_offset") == 0 || strncmp(slip, AXIS, strlen(AXIS)) == 0);
}

hci_status cli_tune_check(cli_tuning *t, hci_note *note)
{
    static hci_check check;
    const char *run[HCI_CHECK_MOST_RUNS];
    char folder[CLI_TUNE_PATH];
    cli_tune_line c = {{"check", t->machine}, 2};
    hci_status status = run_check(t, run, &check, note);
    if (!status && finds_offset(&check)) {
        cli_tune_take_offset(t, check.zero_rad, "what check finds in the logs");
        status = cli_tune_read_inputs(t, note);
        if (!status) status = run_check(t, run, &check, note);
    }
    if (status) return status;
    for (size_t k = 0; k < checked_runs(t, run); ++k)
        cli_tune_add(&c, run[k]);
    cli_tune_path(t, "check", folder);
    cli_tune_add_reading(&c, t);
    cli_tune_add(&c, "-o");
    cli_tune_add(&c, folder);
    cli_tune_note_line(t, &c, true);
    say_check(t, &check);
    judge_check(t, &check);
    return hci_check_write(&check, folder, note);
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
