#define _POSIX_C_SOURCE 200809L

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "cli/command/command.h"
#include "cli/command/reading.h"
#include "cli/command/same_file.h"
#include "cli/commands.h"
#include "cli/terminal/chart.h"
#include "cli/terminal/say.h"
#include "cli/terminal/terminal.h"
#include "cli/terminal/text.h"
#include "hci/host/recording/predict.h"
#include "hci/host/report/summary.h"

enum { OUT, ORDER_BASE, HOLDING, CLI_READING_KEYS, CLI_COMMON_KEYS };

static const cli_option OPTIONS[] = {
    [OUT] = {"out", 'o', CLI_FILE, "FILE",
             .help = "the run with the model's torque; without it nothing is written"},
    [ORDER_BASE] = CLI_TABLE_ORDER_BASE_OPTION,
    [HOLDING] = CLI_HOLDING_OPTION,
    CLI_READING_OPTIONS,
    CLI_COMMON_OPTIONS};

/* ---- words ---- */

static void ripple_row(const void *context, size_t row, cli_cell cell[])
{
    const hci_prediction *p = context;
    const char *const NAMES[] = {"measured", "modelled", "measured less modelled"};
    const double values[] = {p->ripple_torque_Nm, p->ripple_model_Nm, p->rms_residual_Nm};
    snprintf(cell[0].text, sizeof cell[0].text, "%s", NAMES[row]);
    snprintf(cell[1].text, sizeof cell[1].text, "%.4g", values[row]);
    cell[2].value = values[row];
}

static void show_ripple(const hci_prediction *p)
{
    static const cli_column COLUMNS[] = {{CLI_LEFT, "torque"}, {CLI_RIGHT, "rms"}, {CLI_BAR, ""}};
    cli_draw(&(cli_chart){.caption = "rms of the torque about its mean, and of the difference, N·m",
                          .column = COLUMNS,
                          .columns = 3,
                          .rows = 3,
                          .fill = ripple_row,
                          .context = p,
                          .unit = "N·m"});
}

/* A run that the model itself has made. */
static bool is_rounding(const hci_prediction *p)
{
    return p->rms_residual_Nm < 1e-12 * (fabs(p->mean_torque_Nm) + p->ripple_torque_Nm);
}

static void show_expected(const hci_expected_ripple *e)
{
    char words[1024];
    hci_expected_ripple_words(e, words, sizeof words);
    cli_say("  expected     with these currents, of the machine without its bench\n");
    cli_say_paragraph(4, words);
}

static void show(const hci_prediction *p, const cli_arguments *a)
{
    static const char *const SOURCE[] = {"no torque in the run", "torque as measured",
                                         "held at rest: the torque on the shaft is 0",
                                         "a free shaft: torque is inertia x acceleration"};
    cli_say(CLI_GOOD "predicted" CLI_PLAIN ": %s, %s\n", a->word[0], a->word[1]);
    cli_say("  run          %zu sample%s, %s\n", p->count, p->count == 1 ? "" : "s", SOURCE[p->source]);
    if (isfinite(p->mean_torque_Nm))
        cli_say("  torque       mean %.6g N·m, ripple %.4g N·m rms\n", p->mean_torque_Nm,
                p->ripple_torque_Nm);
    cli_say("  model        mean %.6g N·m, ripple %.4g N·m rms\n", p->mean_model_Nm, p->ripple_model_Nm);
    if (isfinite(p->rms_residual_Nm) && is_rounding(p))
        cli_say("  residual     none above rounding\n");
    else if (isfinite(p->rms_residual_Nm))
        cli_say("  residual     %.4g N·m rms, mean %.4g N·m, at most %.4g N·m (sample %zu)\n",
                p->rms_residual_Nm, p->mean_residual_Nm, p->worst_residual_Nm, p->worst_sample + 1);
    if (p->expected.state == HCI_RIPPLE_KNOWN) show_expected(&p->expected);
    if (isfinite(p->rms_residual_Nm) && !is_rounding(p)) show_ripple(p);
}

/* Whether a path is that of a file in the folder. */
static bool is_within(const char *path, const char *folder)
{
    char parent[4096];
    const char *end = strrchr(path, '/');
    const size_t length = end ? (size_t)(end - path) : 0;
    if (!cli_is_same_file(path, path) || length >= sizeof parent) return false;
    snprintf(parent, sizeof parent, "%.*s", (int)length, path);
    return cli_is_same_file(end ? (length ? parent : "/") : ".", folder);
}

/* The run is a measurement, the machine made by hand or by much work: neither is to be replaced. */
static hci_status keep_apart(const char *machine, const char *run, const char *out, hci_note *note)
{
    if (!out) return HCI_OK;
    if (cli_is_same_file(run, out))
        return hci_note_set(note, HCI_ERROR_ARGUMENT,
                            "%.300s would be replaced by its prediction; give another --out", run);
    if (!is_within(out, machine)) return HCI_OK;
    return hci_note_set(
        note, HCI_ERROR_ARGUMENT,
        "%.300s is a file of the machine and would be replaced by a prediction; give another --out", out);
}

static int run(const cli_arguments *a)
{
    hci_prediction prediction;
    hci_note note = {{0}};
    cli_reading reading;
    hci_status status = cli_reading_take(a, a->given[STRICT], a->value[ANGLE_OFFSET], &reading, &note);
    reading.run.holding = a->given[HOLDING];
    reading.run.order_base = (hci_order_base)a->choice[ORDER_BASE];
    if (!status) status = keep_apart(a->word[0], a->word[1], a->value[OUT], &note);
    if (!status)
        status = hci_predict_file(a->word[0], a->word[1], &reading.run, a->value[OUT], &prediction, &note);
    cli_reading_release(&reading);
    if (!status && cli_is_wordy()) {
        show(&prediction, a);
        cli_remark(&prediction.remark);
    }
    if (!status && a->given[JSON]) status = cli_print_json(hci_prediction_json(&prediction), &note);
    return status ? cli_fail(status, &note) : 0;
}

const cli_command cli_predict = {
    .name = "predict",
    .words = "MACHINE RUN",
    .does = "Computes the torque of the machine's model and its effects for a run's angle and currents.\n"
            "Writes the run with torque_model_Nm and residual_Nm (recorded less model) added.",
    .options = OPTIONS,
    .words_needed = 2,
    .word_kind = CLI_FILE,
    .example = "  hci-solve simulate data/machine_a data/drive/imposed.csv -o out/imposed\n"
               "  hci-solve predict data/machine_a out/imposed/trajectory.csv -o out/predicted.csv\n"
               "\nExit codes: 0 done; " CLI_EXIT_ERRORS,
    .source = "cli/predict.c",
    .guide = "measuring.md",
    .run = run,
};
