#include <inttypes.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "cli/check/check_drive.h"
#include "cli/command/command.h"
#include "cli/command/parse.h"
#include "cli/command/reading.h"
#include "cli/commands.h"
#include "cli/terminal/say.h"
#include "cli/terminal/terminal.h"
#include "cli/terminal/text.h"
#include "hci/host/base/number.h"
#include "hci/host/check/check.h"
#include "hci/host/currents/solution_folder.h"
#include "hci/host/currents/table_rotation.h"
#include "hci/host/machine/machine.h"
#include "hci/host/report/summary.h"
#include "hci/host/report/write.h"
#include "hci/math/harmonic.h"

enum { TABLE, DRIVE, SPEED, VERBOSE, OUT, ORDER_BASE, CLI_READING_KEYS, CLI_COMMON_KEYS };

static const cli_option OPTIONS[] = {
    [TABLE] =
        {"table", 0, CLI_FILE, "CURRENTS_OR_FOLDER",
         .help = "instead: whether the drive of the one recording reads this table at the angle of its log"},
    [DRIVE] = {"drive", 0, CLI_FILE, "FILE",
               .help =
                   "instead: the current loop of this drive.csv: is it stable, how fast, up to which speed, "
                   "is its loop.csv that of its gains"},
    [SPEED] = {"speed", 0, CLI_NUMBER, "RPM",
               .help = "with --drive: mechanical, at which it is looked at, too", .low = 1e-3, .high = 1e7},
    [VERBOSE] = {"verbose", 'v', CLI_FLAG, NULL,
                 .help = "what agrees, with its numbers, and what could not be checked, too"},
    [OUT] = {"out", 'o', CLI_FOLDER, "FOLDER",
             .help = "where summary.json goes; without it nothing is written"},
    [ORDER_BASE] = CLI_TABLE_ORDER_BASE_OPTION,
    CLI_READING_OPTIONS,
    CLI_COMMON_OPTIONS};

/* ---- words ---- */

static double degrees(double rad)
{
    return rad * 180.0 / HCI_PI;
}

/* Bounds and numbers, in one column. */
static const char *expected_of(const hci_check_evidence *e, char text[32])
{
    snprintf(text, 32, e->at_most ? "<= %.4g" : "%.4g", e->expected);
    return text;
}

static size_t found_count(const hci_check *c)
{
    size_t count = 0;
    for (size_t k = 0; k < c->findings; ++k)
        count += c->finding[k].probability >= HCI_CHECK_FOUND;
    return count;
}

/* No count of agreeing numbers makes certain. */
static const char *sure(double probability, char text[32])
{
    if (probability >= 0.9995)
        snprintf(text, 32, "more than 99.9 %%");
    else
        snprintf(text, 32, "%s %%", HCI_PERCENT(100.0 * probability, 3));
    return text;
}

static void show_verdict(const hci_check *c)
{
    const size_t found = found_count(c), possible = c->findings - found;
    char text[32], more[64] = "";
    if (possible > 0) snprintf(more, sizeof more, ", %zu more possible", possible);
    switch (c->verdict) {
    case HCI_CHECK_CONSISTENT:
        cli_say(CLI_GOOD "consistent" CLI_PLAIN
                         ": the files agree as they are declared, as far as they can be checked\n");
        break;
    case HCI_CHECK_SLIPS:
        cli_say(CLI_BAD "%zu slip%s found" CLI_PLAIN "%s: %s, %s sure%s\n", found, found == 1 ? "" : "s",
                more, c->finding[0].words, sure(c->finding[0].probability, text),
                c->findings > 1 ? "; and more below" : "");
        break;
    case HCI_CHECK_AMBIGUOUS:
        cli_say(CLI_WARN "ambiguous" CLI_PLAIN
                         ": something is read wrongly (%s sure), and several readings mend it\n",
                sure(1.0 - c->probability_as_declared, text));
        break;
    case HCI_CHECK_NOT_UNDERSTOOD:
        cli_say(CLI_WARN "not understood" CLI_PLAIN ": something disagrees that no known slip explains\n");
        break;
    }
}

static void show_alternatives(const hci_check_finding *f)
{
    cli_say("    or instead: ");
    for (size_t k = 0; k < f->alternatives; ++k)
        cli_say("%s%s (%s)", k > 0 ? ", or " : "", f->alternative_words[k], f->alternative[k]);
    cli_say("; would tell: %s\n", f->told_by);
}

static void show_finding(const hci_check_finding *f)
{
    const bool found = f->probability >= HCI_CHECK_FOUND;
    char text[32];
    cli_say("\n  %s%s" CLI_PLAIN " %s: %s (%s)\n", found ? CLI_BAD : CLI_WARN, found ? "found" : "possible",
            f->slip, f->words, sure(f->probability, text));
    cli_say("    %s:%zu: column %s: found %s, should be %s\n", f->file, f->line, f->column, f->found,
            f->should_be);
    if (f->alternatives > 0) show_alternatives(f);
}

/* Numbers first, so that long words may go on in the next line. */
static void show_evidence_of(const hci_check *c, hci_check_state state, const char *title)
{
    size_t shown = 0;
    char text[32];
    for (size_t k = 0; k < c->evidences; ++k) {
        const hci_check_evidence *e = &c->evidence[k];
        if (e->state != state) continue;
        if (shown++ == 0) cli_say("\n  %s\n    %10s %10s %9s\n", title, "declared", "as read", "expected");
        cli_say("    %10.4g %10.4g %9s  %s\n", e->declared, e->as_read, expected_of(e, text), e->words);
    }
}

/* What is within its tolerance, and would be with a slip: its number says nothing by itself. */
static void show_unjudged(const hci_check *c)
{
    size_t shown = 0;
    for (size_t k = 0; k < c->evidences; ++k)
        shown += c->evidence[k].state == HCI_CHECK_UNJUDGED;
    if (shown > 0)
        cli_say("\n  not judged, %zu: what is unknown in the recordings is too large\n    %10s %10s %9s\n",
                shown, "declared", "expected", "+-");
    for (size_t k = 0; k < c->evidences; ++k) {
        const hci_check_evidence *e = &c->evidence[k];
        if (e->state == HCI_CHECK_UNJUDGED)
            cli_say("    %10.4g %10.4g %9.2g  %s\n", e->declared, e->expected, e->tolerance, e->words);
    }
}

/* Relations by what they want: once each, where it stands first. */
static void show_gaps(const hci_check *c)
{
    if (c->gaps > 0) cli_say("\n  not checked, for want of (what each tells: docs/check.md)\n");
    for (size_t k = 0; k < c->gaps; ++k) {
        char names[HCI_CHECK_MOST_EVIDENCE * 32] = "";
        bool is_first = true;
        for (size_t j = 0; j < k; ++j)
            is_first = is_first && strcmp(c->gap[j].needs, c->gap[k].needs) != 0;
        if (!is_first) continue;
        for (size_t j = k; j < c->gaps; ++j)
            if (strcmp(c->gap[j].needs, c->gap[k].needs) == 0)
                snprintf(names + strlen(names), sizeof names - strlen(names), "%s%s", j > k ? ", " : "",
                         c->gap[j].name);
        cli_say("    %s: %s\n", c->gap[k].needs, names);
    }
}

/* Each topic once; by their names with --verbose, as docs/check.md has them. */
static void show_untold(const hci_check *c, bool verbose)
{
    const char *before = "  not told     by these files: ";
    if (c->untolds > 0 && verbose) cli_say("\n");
    for (size_t k = 0; k < c->untolds; ++k) {
        const char *topic = verbose ? c->untold[k] : hci_check_slip_topic(c->untold[k]);
        bool is_first = true;
        for (size_t j = 0; j < k && !verbose; ++j)
            is_first = is_first && strcmp(hci_check_slip_topic(c->untold[j]), topic) != 0;
        if (!is_first) continue;
        cli_say("%s%s", before, topic);
        before = verbose ? ", " : "; ";
    }
    if (c->untolds > 0) cli_say("\n");
}

/* "12 relations agree, 2 are not judged, 17 are not checked (--verbose lists them)" */
static void show_counts(const hci_check *c)
{
    size_t agree = 0, unjudged = 0;
    for (size_t k = 0; k < c->evidences; ++k) {
        agree += c->evidence[k].state == HCI_CHECK_AGREES;
        unjudged += c->evidence[k].state == HCI_CHECK_UNJUDGED;
    }
    cli_say("  checked      %zu relation%s agree%s", agree, agree == 1 ? "" : "s", agree == 1 ? "s" : "");
    if (unjudged > 0) cli_say("; %zu not judged, since the recordings leave too much open", unjudged);
    if (c->gaps > 0) cli_say("; %zu not checked, for want of entries or recordings", c->gaps);
    cli_say(" (--verbose lists them)\n");
}

/* Half a degree and its error: less is none; and 5 of what a saliency explains as well, or of a drive. */
static double least_zero(const hci_check *c, double error)
{
    return isfinite(c->drive_zero_rad) ? 5.0 : fmax(c->zero_is_told ? 0.5 : 5.0, error);
}

static void show_zero(const hci_check *c)
{
    const bool is_of_drive = isfinite(c->drive_zero_rad);
    const double zero_rad = is_of_drive ? c->drive_zero_rad : c->zero_rad,
                 off = -degrees(remainder(zero_rad, 2.0 * HCI_PI)),
                 whole = remainder(degrees(c->given_zero_rad) - off, 360.0),
                 error = fmax(0.1, degrees(is_of_drive ? c->drive_zero_reach_rad : c->zero_reach_rad));
    for (size_t k = 0; k < c->findings; ++k)
        if (strcmp(c->finding[k].slip, "run_angle_offset") == 0) return;
    if (c->verdict == HCI_CHECK_SLIPS || !(fabs(off) > least_zero(c, error))) return;
    if (is_of_drive)
        cli_say("  angle zero   %.1f degrees electrical off in the recordings, where the drive keeps its i_d "
                "at 0 "
                "(by the torques within %.0f, and a drive that wants such an i_d makes them as well): "
                "--angle-offset %.1f takes it out\n",
                off, error, whole);
    else if (c->zero_is_told)
        cli_say("  angle zero   %.1f \xC2\xB1 %.1f degrees electrical off in the recordings: --angle-offset "
                "%.1f takes it "
                "out\n",
                off, error, whole);
    else
        cli_say("  angle zero   %.1f \xC2\xB1 %.1f degrees electrical off would explain the torques, and so "
                "would a saliency with the saturation that it has: runs with i_d of both signs at two "
                "currents, or voltages of the open machine, tell them apart\n",
                off, error);
}

static void show_saliency(const hci_check *c)
{
    char words[512];
    if (c->verdict != HCI_CHECK_SLIPS && *hci_check_saliency_words(c, words, sizeof words))
        cli_say("  saliency     %s; inductance_d and inductance_q of machine.csv declare it\n", words);
}

static void show(const hci_check *c, bool verbose)
{
    show_verdict(c);
    for (size_t k = 0; k < c->findings; ++k)
        show_finding(&c->finding[k]);
    show_evidence_of(c, HCI_CHECK_MENDED, "evidence: does not agree as declared, and does as read");
    show_evidence_of(c, HCI_CHECK_BETTER, "better as read, but still off");
    show_evidence_of(c, HCI_CHECK_MENDABLE, "still off as read, and met with a slip that is possible");
    show_evidence_of(c, HCI_CHECK_WORSE, "speaks against it: agrees as declared, and not as read");
    show_evidence_of(c, HCI_CHECK_UNMENDED, "not understood: agrees in no reading");
    if (verbose) {
        show_evidence_of(c, HCI_CHECK_AGREES, "checked and consistent");
        show_unjudged(c);
        show_gaps(c);
    } else {
        if (c->verdict != HCI_CHECK_CONSISTENT) cli_say("\n");
        show_counts(c);
    }
    show_zero(c);
    show_saliency(c);
    show_untold(c, verbose);
}

static const hci_note *remark_of_run(const void *context, size_t k)
{
    return &((const hci_check *)context)->remark[k];
}

static void show_remarks(const hci_check *c)
{
    cli_remark(&c->machine_remark);
    cli_remark_each(remark_of_run, c, c->runs);
}

/* ---- summary ---- */

static hci_status give_results(const hci_check *c, const cli_arguments *a, hci_note *note)
{
    const hci_status status = a->value[OUT] ? hci_check_write(c, a->value[OUT], note) : HCI_OK;
    if (status) return status;
    show_remarks(c);
    if (cli_is_wordy()) show(c, a->given[VERBOSE]);
    return a->given[JSON]
               ? cli_print_json(a->value[OUT] ? hci_summary_read(a->value[OUT]) : hci_check_json(c), note)
               : HCI_OK;
}

/* ---- at which angle a drive reads its table ---- */

/* The angle is told to a hundredth of a degree at best: logs are not better; and to half a step. */
static double shown_error(const hci_table_rotation *x)
{
    return fmax(0.01, degrees(x->error_rad + 0.5 * x->step_rad));
}

static void show_table_remedy(double pole_pairs, const hci_table_rotation *x)
{
    const double turns = x->rotation_rad / (2.0 * HCI_PI) / pole_pairs;
    if (x->of_index) {
        cli_say("  remedy       take %.3f degrees from the mechanical angle by which the table is read, and "
                "leave the angle of the drive's own i_d and i_q as it is\n",
                360.0 * turns);
        return;
    }
    if (x->backwards) cli_say("  remedy       the encoder counts against a-b-c: its direction is -1\n");
    if (!x->backwards || fabs(x->rotation_rad) > 0.01)
        cli_say("  %s add 0x%08" PRIX32 "u to zero_angle of hci/counter.h, or take %.3f degrees from the "
                "angle of the shaft\n",
                x->backwards ? "and then    " : "remedy      ",
                (uint32_t)(int64_t)floor(turns * 4294967296.0 + 0.5), 360.0 * turns);
}

static void show_no_table(const char *run, double pole_pairs, const hci_table_rotation *x)
{
    cli_say(CLI_BAD
            "not found" CLI_PLAIN
            ": %s: the currents are those of this table at no rotation: %.1f %% of them is left at best\n",
            run, 100.0 * x->left);
    if (x->pole_pairs_seen > 0)
        cli_say("  remedy       with %zu pole pairs in place of %g they are: the log's angle is multiplied "
                "by another "
                "number than that of machine.csv\n",
                x->pole_pairs_seen, pole_pairs);
    else
        cli_say("  remedy       compare with the table that is in the drive, in a log of the angle and the "
                "phase currents "
                "of one steady speed\n");
}

static void show_rotation(const char *run, const hci_table_rotation *x)
{
    if (x->is_rotated)
        cli_say(CLI_BAD "rotated" CLI_PLAIN
                        ": %s: %s is read %s%.2f ± %.2g degrees electrical %s of the angle in the log\n",
                run,
                x->of_index ? "the index of the table, in a frame of i_d and i_q that is right,"
                            : "the table",
                x->backwards ? "backwards, " : "", fabs(degrees(x->rotation_rad)), shown_error(x),
                x->rotation_rad < 0.0 ? "behind" : "ahead");
    else
        cli_say(CLI_GOOD "aligned" CLI_PLAIN
                         ": %s: the table is read at the angle in the log, to %.2g degrees electrical\n",
                run, shown_error(x));
}

/* A sine of the same torque, as a drive makes it without the table. */
static void show_unseen(const char *run, const hci_table_rotation *x)
{
    cli_say(CLI_BAD "not found" CLI_PLAIN
                    ": %s: the log does not hold the table's currents: of what the table has beside its "
                    "fundamental %.2g ± %.2g is in them, where their fundamental is %.4g times the table's\n",
            run, x->harmonics, x->harmonics_error, x->gain);
    cli_say(
        "  remedy       log the phase currents while the table is played, at a slow and steady speed; the "
        "fundamental alone is that of any drive, with or without a table\n");
}

static void show_currents_left(const hci_table_rotation *x)
{
    cli_say("  difference   %.1f %% of the current as it is, %.1f %% where the table is turned so; the "
            "currents are %.4g times the table\n",
            100.0 * x->left_as_is, 100.0 * x->left, x->gain);
    if (x->period_turns > 1)
        cli_say("  elsewhere    %.1f %% at best in another of the %zu electrical turns\n",
                100.0 * x->left_elsewhere, x->period_turns);
}

/* Mean speed of a recording; 0: none is known. */
static double mean_speed(const hci_run *run)
{
    double sum = 0.0;
    for (size_t k = 0; run->speed_rad_per_s && k < run->count; ++k)
        sum += run->speed_rad_per_s[k] / (double)run->count;
    return sum;
}

/* Currents that are late lie behind by an angle that grows with the speed: at one speed both are the same. */
static void show_delay(double speed_rad_per_s, const hci_table_rotation *x)
{
    const double late_s = -x->rotation_rad / speed_rad_per_s;
    if (x->backwards || !(late_s > 0.0)) return;
    cli_say("  or late      the currents in the log by %.2g ms, as those of a bus, a filter or a loop are: "
            "then nothing is to be taken away. A log at another speed tells: an angle stays, a delay "
            "grows with it\n",
            1e3 * late_s);
}

static void show_table(const char *run, double pole_pairs, double speed_rad_per_s,
                       const hci_table_rotation *x)
{
    if (!x->is_found) {
        show_no_table(run, pole_pairs, x);
        return;
    }
    if (!x->is_seen) {
        show_unseen(run, x);
        return;
    }
    show_rotation(run, x);
    show_currents_left(x);
    if (x->step_rad > 0.0)
        cli_say("  coarse       the log's angle goes in steps of %.3g degrees electrical; half of one cannot "
                "be told\n",
                degrees(x->step_rad));
    if (x->is_rotated) {
        show_table_remedy(pole_pairs, x);
        show_delay(pole_pairs * speed_rad_per_s, x);
    } else
        cli_say("  told         if the drive followed a torque reference; a position or speed loop makes the "
                "currents that the shaft asks for, wherever the table is read: then compare the ripple of "
                "speed or current with and without it\n");
}

static hci_status compare_table(const cli_arguments *a, const char *table_path,
                                const hci_run_options *options, bool json, hci_table_rotation *x,
                                hci_note *note)
{
    hci_currents table = {0};
    hci_run run = {0};
    hci_status status = hci_solution_read_currents(table_path, HCI_SOLUTION_CURRENTS, &table, note);
    if (!status) status = hci_run_read(a->word[1], options, &run, note);
    if (!status) status = hci_table_rotation_of(&table, &run, options->pole_pairs, x, note);
    if (!status && cli_is_wordy()) show_table(a->word[1], options->pole_pairs, mean_speed(&run), x);
    if (!status && json) status = cli_print_json(hci_table_rotation_json(x), note);
    hci_run_release(&run);
    hci_currents_release(&table);
    return status;
}

static int check_table(const cli_arguments *a, const char *table_path, bool json, hci_run_options *options)
{
    hci_machine_data machine = {0};
    hci_table_rotation x;
    hci_note note = {{0}};
    hci_status status = HCI_OK;
    if (a->words != 2)
        status = hci_note_set(&note, HCI_ERROR_ARGUMENT,
                              "check: --table CURRENTS goes with a machine and one recording");
    if (!status) status = hci_machine_read_orders(a->word[0], options->order_base, &machine, &note);
    options->pole_pairs = (int)machine.pole_pairs;
    if (!status) status = compare_table(a, table_path, options, json, &x, &note);
    hci_machine_release(&machine);
    if (status) return cli_fail(status, &note);
    return x.is_rotated || !x.is_found || !x.is_seen ? 1 : 0;
}

/* ---- the command ---- */

static int check_drive(const cli_arguments *a)
{
    const cli_check_drive_words words = {.machine = a->word[0],
                                         .drive = a->value[DRIVE],
                                         .order_base = (hci_order_base)a->choice[ORDER_BASE],
                                         .speed_rad_per_s = cli_number_or(a, SPEED, 0.0) * HCI_PI / 30.0,
                                         .out = a->value[OUT],
                                         .json = a->given[JSON]};
    hci_note note = {{0}};
    if (a->words == 1 && !a->given[TABLE]) return cli_check_drive(&words);
    return cli_fail(
        hci_note_set(&note, HCI_ERROR_ARGUMENT,
                     "check: --drive FILE goes with a machine alone, without recordings and --table"),
        &note);
}

static int run(const cli_arguments *arguments)
{
    if (arguments->given[DRIVE]) return check_drive(arguments);
    static hci_check check;
    cli_arguments recordings;
    const cli_arguments *a = &recordings;
    cli_reading_without_lists(arguments, 1, &recordings);
    hci_note note = {{0}};
    cli_reading reading;
    hci_status status = cli_reading_take(a, a->given[STRICT], a->value[ANGLE_OFFSET], &reading, &note);
    reading.run.order_base = (hci_order_base)a->choice[ORDER_BASE];
    if (!status && a->given[TABLE]) {
        const int code = check_table(a, a->value[TABLE], a->given[JSON], &reading.run);
        cli_reading_release(&reading);
        return code;
    }
    if (!status) status = hci_check_files(a->word[0], a->word + 1, a->words - 1, &reading.run, &check, &note);
    cli_reading_release(&reading);
    if (status && status != HCI_NOT_REACHED) return cli_fail(status, &note);
    const hci_status given = give_results(&check, a, &note);
    return given ? cli_fail(given, &note) : hci_status_exit_code(status);
}

const cli_command cli_check = {
    .name = "check",
    .words = "MACHINE [RUN...]",
    .does =
        "Finds slips of convention in a machine's tables and in recordings: poles, rms, line, sign, angle, "
        "order.\n"
        "Says which reading makes the numbers agree, how sure it is, and which line to change; changes "
        "nothing.",
    .options = OPTIONS,
    .words_needed = 1,
    .takes_more_words = true,
    .word_kind = CLI_FILE,
    .example = "  hci-solve check data/machine_c\n"
               "  hci-solve check data/fem_c/machine data/fem_c/runs/I0.csv data/fem_c/runs/id0_iq6.csv\n"
               "  hci-solve check data/machine_a --drive data/drive/machine_a_10kHz.csv --speed 1500\n"
               "\nExit codes: 0 consistent, aligned or stable; 1 slips found, ambiguous, not understood or "
               "rotated; " CLI_EXIT_ERRORS,
    .source = "cli/check.c",
    .guide = "check.md",
    .run = run,
};
