#include <math.h>
#include <stdio.h>
#include <string.h>

#include "cli/command/command.h"
#include "cli/command/parse.h"
#include "cli/command/reading.h"
#include "cli/commands.h"
#include "cli/harmonics/harmonics_words.h"
#include "cli/terminal/say.h"
#include "cli/terminal/terminal.h"
#include "hci/host/base/number.h"
#include "hci/host/report/summary.h"
#include "hci/host/report/write.h"
#include "hci/host/waveform/waveform.h"
#include "hci/math/harmonic.h"

enum {
    QUANTITY,
    POLE_PAIRS,
    ORDERS,
    ORDER_BASE,
    MAX_ORDER,
    CONSTANT,
    INERTIA,
    OUT,
    HOLDING,
    CLI_READING_KEYS,
    CLI_COMMON_KEYS
};

static const cli_choice QUANTITIES[] = {
    [HCI_WAVEFORM_BACK_EMF] = {"back_emf", NULL},
    [HCI_WAVEFORM_COGGING] = {"cogging", NULL},
    {NULL, NULL},
};

static const cli_option OPTIONS[] = {
    [QUANTITY] = {"quantity", 0, CLI_CHOICE, "NAME", NULL, .choices = QUANTITIES},
    [POLE_PAIRS] = {"pole-pairs", 0, CLI_WHOLE, "P",
                    .help = "of the machine (half its poles); not needed for what a device has learnt",
                    .low = 1.0, .high = 1000.0},
    [ORDERS] = {"orders", 0, CLI_TEXT, "LIST",
                .help = "these electrical orders and no others, such as 1,5,7 or 12/7"},
    [ORDER_BASE] = CLI_ORDER_BASE_OPTION,
    [MAX_ORDER] = {"max-order", 0, CLI_NUMBER, "N", .help = "highest electrical order looked at (60)",
                   .low = 1.0, .high = HCI_MOST_ORDER},
    [CONSTANT] = {"torque-constant", 0, CLI_NUMBER, "NM_PER_A",
                  .help = "cogging of a run with currents: torque of 1 A of i_q", .low = 1e-9, .high = 1e6},
    [INERTIA] = {"inertia", 0, CLI_NUMBER, "KGM2",
                 .help =
                     "without a torque sensor: inertia x acceleration is the torque, or with --holding is "
                     "taken out of that of the current",
                 .low = 1e-12, .high = 1e6},
    [OUT] = {"out", 'o', CLI_FOLDER, "FOLDER", .help = "where the table goes; without it nothing is written"},
    [HOLDING] = CLI_HOLDING_OPTION,
    CLI_READING_OPTIONS,
    CLI_COMMON_OPTIONS};

enum { MOST_ORDERS = 256 };

/* ---- options ---- */

/* A number, or a fraction of two such as 12/7. */
static bool read_order(const char *text, double *order)
{
    char top[32];
    double below = 1.0;
    const char *slash = strchr(text, '/');
    const size_t length = slash ? (size_t)(slash - text) : strlen(text);
    if (length >= sizeof top) return false;
    memcpy(top, text, length);
    top[length] = '\0';
    if (!hci_number_parse(top, order)) return false;
    if (slash && (!hci_number_parse(slash + 1, &below) || below <= 0.0)) return false;
    *order /= below;
    return true;
}

static hci_status read_orders(const char *text, double orders[MOST_ORDERS], size_t *count, hci_note *note)
{
    for (*count = 0; *count < MOST_ORDERS;) {
        char word[64];
        const size_t length = strcspn(text, ",");
        snprintf(word, sizeof word, "%.*s", (int)(length < sizeof word ? length : sizeof word - 1), text);
        if (!read_order(word, &orders[*count]))
            return hci_note_set(note, HCI_ERROR_ARGUMENT,
                                "--orders: found `%s`, expected electrical orders such as 1,5,7 or 12/7",
                                word);
        ++*count;
        if (text[length] == '\0') return HCI_OK;
        text += length + 1;
    }
    return hci_note_set(note, HCI_ERROR_ARGUMENT,
                        "--orders: found more than %d orders; leave some out, or give --max-order",
                        (int)MOST_ORDERS);
}

/* Options that exclude or need each other. */
static hci_status check_together(const cli_arguments *a, hci_note *note)
{
    const char *wrong = NULL;
    if (!a->value[QUANTITY])
        wrong = "harmonics: add --quantity back_emf or cogging";
    else if (a->given[ORDERS] && a->given[MAX_ORDER])
        wrong = "harmonics: give --orders or --max-order, not both";
    else if (a->given[CONSTANT] && a->choice[QUANTITY] != HCI_WAVEFORM_COGGING)
        wrong = "--torque-constant goes with --quantity cogging";
    else if (a->given[INERTIA] && !a->given[CONSTANT])
        wrong = "--inertia goes with --quantity cogging and --torque-constant";
    return wrong ? hci_note_set(note, HCI_ERROR_ARGUMENT, "%s", wrong) : HCI_OK;
}

static hci_status read_options(const cli_arguments *a, hci_waveform_options *o, double orders[MOST_ORDERS],
                               hci_note *note)
{
    const hci_status status = check_together(a, note);
    if (status) return status;
    o->quantity = (hci_waveform_quantity)a->choice[QUANTITY];
    o->max_order = a->number[MAX_ORDER];
    o->torque_constant_Nm_per_A = a->number[CONSTANT];
    if (!a->value[ORDERS]) return HCI_OK;
    o->orders = orders;
    return read_orders(a->value[ORDERS], orders, &o->order_count, note);
}

/* The pole pairs, and what was given by them. */
static void take_pole_pairs(const cli_arguments *a, int pole_pairs, hci_waveform_options *o,
                            double orders[MOST_ORDERS])
{
    o->pole_pairs = pole_pairs;
    for (size_t k = 0; a->choice[ORDER_BASE] == HCI_ORDER_MECHANICAL && k < o->order_count; ++k)
        orders[k] /= pole_pairs;
}

/* ---- the command ---- */

/* Voltages of which no order repeats from turn to turn are of no machine with so many poles. Returns whether
 * that is so, and says it. */
static bool is_of_other_poles(const hci_waveform *w, int pole_pairs)
{
    hci_note remark = {{0}};
    if (w->quantity != HCI_WAVEFORM_BACK_EMF || w->kept > 0) return false;
    hci_note_set(&remark, HCI_NOT_REACHED,
                 "no order of the voltages repeats from turn to turn with %d pole pairs; with the right "
                 "number order 1 does: "
                 "try another --pole-pairs, or see whether the shaft turned",
                 pole_pairs);
    cli_remark(&remark);
    return true;
}

static hci_status analyse(const cli_arguments *a, const hci_waveform_options *o, const hci_run *run,
                          hci_note *note)
{
    hci_waveform waveform;
    hci_status status = hci_waveform_find(run, o, &waveform, note);
    if (status) return status;
    if (a->value[OUT]) status = hci_waveform_write(&waveform, a->value[OUT], note);
    if (!status && cli_is_wordy()) {
        cli_show_waveform(&waveform, a->word[0]);
        cli_remark(&run->remark);
    }
    const bool is_empty = !status && is_of_other_poles(&waveform, o->pole_pairs);
    if (!status && cli_is_wordy() && !is_empty) cli_remark(&waveform.remark);
    if (!status && a->given[JSON]) status = cli_print_json(hci_waveform_json(&waveform), note);
    if (!status && is_empty) status = HCI_NOT_REACHED;
    hci_waveform_release(&waveform);
    return status;
}

static int run(const cli_arguments *a)
{
    double orders[MOST_ORDERS];
    hci_waveform_options options;
    hci_note note = {{0}};
    hci_run recording;
    cli_reading reading;
    memset(&options, 0, sizeof options);
    memset(&recording, 0, sizeof recording);
    hci_status status = cli_reading_take(a, a->given[STRICT], a->value[ANGLE_OFFSET], &reading, &note);
    if (!status) status = read_options(a, &options, orders, &note);
    reading.run.pole_pairs = a->value[POLE_PAIRS] ? (int)a->number[POLE_PAIRS] : 0;
    reading.run.holding = a->given[HOLDING];
    reading.run.inertia_kgm2 = a->number[INERTIA];
    reading.run.torque_constant_Nm_per_A = cli_number_or(a, CONSTANT, 0.0);
    if (!status) status = hci_run_read(a->word[0], &reading.run, &recording, &note);
    if (!status) take_pole_pairs(a, recording.pole_pairs, &options, orders);
    if (!status) status = analyse(a, &options, &recording, &note);
    hci_run_release(&recording);
    cli_reading_release(&reading);
    return status > HCI_NOT_REACHED ? cli_fail(status, &note) : hci_status_exit_code(status);
}

const cli_command cli_harmonics = {
    .name = "harmonics",
    .words = "RUN --quantity {back_emf,cogging} --pole-pairs P",
    .does = "Finds the orders of a measured waveform: amplitude, phase and standard errors.\n"
            "Writes back_emf.csv or cogging.csv, as a machine folder has them, and a picture beside it.",
    .options = OPTIONS,
    .words_needed = 1,
    .word_kind = CLI_FILE,
    .example =
        "  hci-solve simulate data/machine_a data/drive/driven.csv -o out/driven\n"
        "  hci-solve harmonics out/driven/trajectory.csv --quantity cogging --pole-pairs 2 -o out/driven\n"
        "\nExit codes: 0 done; 1 voltages of which no order repeats; " CLI_EXIT_ERRORS,
    .source = "cli/harmonics.c",
    .guide = "measuring.md",
    .run = run,
};
