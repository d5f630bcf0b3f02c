#include "cli/command/command.h"
#include "cli/command/jobs.h"
#include "cli/command/parse.h"
#include "cli/commands.h"
#include "cli/solve/solve_limits.h"
#include "cli/sweep/sweep_run.h"
#include "cli/sweep/sweep_words.h"
#include "cli/terminal/say.h"
#include "cli/terminal/signals.h"
#include "cli/terminal/terminal.h"
#include "hci/host/report/summary.h"
#include "hci/host/report/sweep/write.h"

#include <string.h>

/* Behind those of cli_sweep_key. */
enum { BEFORE_LIMITS = SWEEP_LIMITS - 1, CLI_LIMIT_KEYS, CLI_COMMON_KEYS };

static const cli_option OPTIONS[] = {
    [SWEEP_TRADE_OFF] = {"trade-off", 0, CLI_FLAG, NULL,
                         .help =
                             "ripple by the limit of the peak current and by that of copper, for --torque"},
    [SWEEP_ENVELOPE] = {"envelope", 0, CLI_FLAG, NULL,
                        .help = "the largest torque at each of --speeds with the components that may be "
                                "used, beside that of the plain sine"},
    [SWEEP_MAP] = {"map", 0, CLI_FLAG, NULL, .help = "each of --torques at each of --speeds"},
    [SWEEP_TORQUE] = {"torque", 0, CLI_NUMBER, "NM", .help = "with --trade-off: mean torque", .low = -1e9,
                      .high = 1e9},
    [SWEEP_TORQUES] = {"torques", 0, CLI_TEXT, "NM,...",
                       .help = "with --map: mean torques; lists and ranges such as 0.5,1:4:0.5"},
    [SWEEP_SPEED] = {"speed", 0, CLI_NUMBER, "RPM",
                     .help = "with --trade-off: at which the voltage is limited (0)", .low = -1e7,
                     .high = 1e7},
    [SWEEP_SPEEDS] = {"speeds", 0, CLI_TEXT, "RPM,...",
                      .help = "with --envelope and --map: lists and ranges such as 0:3000:100"},
    [SWEEP_LINKS] = {"dc-links", 0, CLI_TEXT, "V,...",
                     .help = "with --envelope and --map: dc-link voltages, each with all speeds"},
    [SWEEP_RIPPLE] = {"ripple", 0, CLI_NUMBER, "PERCENT",
                      .help = "with --envelope: T_ripple that is allowed (1); 0: none, which is below 0.01 %",
                      .low = 0.0, .high = 1000.0},
    [SWEEP_CURRENTS] = {"currents", 0, CLI_TEXT, "A,...",
                        .help = "with --trade-off: limits of the peak phase current (default: chosen)"},
    [SWEEP_COPPERS] =
        {"coppers", 0, CLI_TEXT, "RATIO,...",
         .help = "with --trade-off: limits of the copper loss over that of the plain sine (default: chosen)"},
    [SWEEP_HARMONICS] = {"harmonics", 0, CLI_FILE, "FILE",
                         .help = "components to use: order,set (pos, neg, sym, asym; zero with a neutral)"},
    [SWEEP_AUTO] = {"auto", 0, CLI_COUNT_OPTIONAL, "K",
                    .help = "choose the components (default), at most K of them", .low = 1.0, .high = 1e4},
    [SWEEP_MINIMISE] = {"minimise", 0, CLI_CHOICE, "WHAT",
                        .help = "ripple that is made smallest where it cannot be as wanted; --trade-off and "
                                "--envelope without it: peak-to-peak; else",
                        .choices = cli_minimise_choices},
    [SWEEP_TEMPERATURE] = {"temperature", 0, CLI_NUMBER, "C",
                           .help = "of the magnets, for magnet_temperature in effects.csv", .low = -273.15,
                           .high = 1e4},
    [SWEEP_JOBS] = {"jobs", 'j', CLI_WHOLE, "N",
                    .help = "processes (default: as many as there are processors)", .low = 1.0,
                    .high = CLI_MOST_JOBS},
    [SWEEP_SHARD] = {"shard", 0, CLI_TEXT, "K/N",
                     .help =
                         "solve only share K of N, such as 3/16, and leave its points in --out for --join"},
    [SWEEP_JOIN] = {"join", 0, CLI_FOLDER, "FOLDER",
                    .help = "take the points that the same sweep left there; may be given for several",
                    .repeats = true},
    [SWEEP_ORDER_BASE] = CLI_ORDER_BASE_OPTION,
    [SWEEP_OUT] = {"out", 'o', CLI_FOLDER, "FOLDER",
                   .help =
                       "where the results go, and points as they are done; without it nothing is written"},
    [SWEEP_REPORT] = {"report", 0, CLI_FLAG, NULL, .help = "report.html beside the results, for people"},
    CLI_LIMIT_OPTIONS,
    CLI_COMMON_OPTIONS};

/* ---- what came of it ---- */

static bool is_complete(const hci_grid *s)
{
    return hci_grid_done(s) == s->plan.count;
}

/* Whether no point has a torque. */
static bool is_vain(const hci_grid *s)
{
    size_t count[HCI_GRID_FAILED + 1];
    hci_grid_count(s, count);
    return count[HCI_GRID_LIMITS] + count[HCI_GRID_FAILED] == s->plan.count;
}

/* As cli_sweep_run keeps them: not before one point is done that did not fail, or a share. */
static bool is_kept(const cli_arguments *a, const hci_grid *s)
{
    bool is_any = a->value[SWEEP_SHARD] != NULL;
    for (size_t k = 0; k < s->plan.count; ++k)
        is_any = is_any || (s->done[k] && s->row[k].verdict != HCI_GRID_FAILED);
    return a->value[SWEEP_OUT] && is_any;
}

/* Beside the results, which may go to a file or to nobody. */
static void remark_stopped(const cli_arguments *a, const hci_grid *s)
{
    hci_note remark = {{0}};
    if (is_kept(a, s))
        hci_note_add(
            &remark,
            "ended early: %zu of %zu points are done and kept in %s; the same command goes on from there",
            hci_grid_done(s), s->plan.count, a->value[SWEEP_OUT]);
    else
        hci_note_add(&remark, "ended early: %zu of %zu points are done, and nothing is kept: %s",
                     hci_grid_done(s), s->plan.count,
                     a->value[SWEEP_OUT] ? "the same command begins anew" : "there is no --out");
    cli_remark(&remark);
}

/* Of a share that was solved to its end. */
static void say_share(const cli_arguments *a, const hci_grid *s)
{
    const bool kept = is_kept(a, s);
    if (!cli_is_wordy()) return;
    cli_say("%zu of %zu points are done%s%s\n", hci_grid_done(s), s->plan.count, kept ? " and kept in " : "",
            kept ? a->value[SWEEP_OUT] : "");
    cli_say("  the same command without --shard and with --join for each folder puts the shares together\n");
}

static hci_status give_results(const cli_arguments *a, const hci_grid *s, hci_note *note)
{
    const hci_report_sources sources = {.machine = a->word[0], .harmonics = a->value[SWEEP_HARMONICS]};
    hci_status status = HCI_OK;
    if (a->value[SWEEP_OUT])
        status = hci_grid_write(s, a->given[SWEEP_REPORT] ? &sources : NULL, a->value[SWEEP_OUT], note);
    if (!status && cli_is_wordy()) {
        cli_show_sweep(s, a->word[0]);
        cli_remark(&s->request.machine->remark);
    }
    if (!status && a->given[JSON])
        status = cli_print_json(
            a->value[SWEEP_OUT] ? hci_summary_read(a->value[SWEEP_OUT]) : hci_grid_json(s), note);
    return !status && is_vain(s) ? HCI_NOT_REACHED : status;
}

/* ---- the command ---- */

static hci_status sweep(const cli_arguments *a, const cli_sweep_inputs *in, hci_note *note)
{
    const cli_sweep_work work = {.jobs = (size_t)cli_number_or(a, SWEEP_JOBS, (double)cli_processors()),
                                 .out = a->value[SWEEP_OUT],
                                 .join = a->repeated,
                                 .joins = a->repeats};
    hci_grid s;
    hci_status status;
    memset(&s, 0, sizeof s);
    status = cli_sweep_run(in, &work, &s, note);
    const bool is_stopped = cli_signals_deferred(NULL);
    cli_remark(&s.remark);
    if (s.plan.count > 0 && is_stopped)
        remark_stopped(a, &s);
    else if (s.plan.count > 0 && !status && !is_complete(&s))
        say_share(a, &s);
    cli_signals_obey();
    cli_signals_catch();
    if (!status && is_complete(&s)) status = give_results(a, &s, note);
    hci_grid_release(&s);
    return status;
}

static int run(const cli_arguments *a)
{
    cli_sweep_inputs in;
    hci_note note = {{0}};
    hci_status status;
    memset(&in, 0, sizeof in);
    status = cli_sweep_read(OPTIONS, a, &in, &note);
    if (!status) status = sweep(a, &in, &note);
    cli_sweep_inputs_release(&in);
    return status > HCI_NOT_REACHED ? cli_fail(status, &note) : hci_status_exit_code(status);
}

const cli_command cli_sweep = {
    .name = "sweep",
    .words = "MACHINE [GRID]",
    .does =
        "Solves over a grid: ripple against peak current and copper, largest torque over speed, maps.\n"
        "Each point is solved as `solve` does, by as many processes as there are processors.\n"
        "Writes trade_off.csv, envelope.csv or map.csv with its picture, summary.json, and points.csv and "
        "sweep.csv, from which the same command goes on; with --report also report.html.\n"
        "GRID: a table torque_Nm,speed_rpm[,dc_link_V], a point of a map in each row.",
    .options = OPTIONS,
    .words_needed = 1,
    .takes_more_words = true,
    .word_kind = CLI_FILE,
    .example =
        "  hci-solve sweep data/machine_a --trade-off --torque 2.46 -o out/trade_off\n"
        "  hci-solve sweep data/machine_a --envelope --ripple 1 --speeds 0 --limit-current 20 -o "
        "out/envelope\n"
        "  hci-solve sweep data/machine_c --map --torques 2:8:3 --speeds 0:800:400 --limit-current 8 -o "
        "out/map\n"
        "\nExit codes: 0 done; 1 done, but no point has a torque; " CLI_EXIT_ERRORS,
    .source = "cli/sweep.c",
    .guide = "drive.md",
    .run = run,
};
