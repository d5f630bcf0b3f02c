#include <math.h>
#include <stdio.h>
#include <string.h>

#include "cli/command/command.h"
#include "cli/commands.h"
#include "cli/terminal/chart.h"
#include "cli/terminal/rows.h"
#include "cli/terminal/say.h"
#include "cli/terminal/terminal.h"
#include "cli/terminal/text.h"
#include "hci/host/base/number.h"
#include "hci/host/report/summary.h"
#include "hci/host/report/write.h"
#include "hci/host/waveform/waveform.h"
#include "hci/math/harmonic.h"

enum { QUANTITY, POLE_PAIRS, ORDERS, MAX_ORDER, CONSTANT, OUT, CLI_COMMON_KEYS };

static const cli_choice QUANTITIES[] = {
    [HCI_WAVEFORM_BACK_EMF] = {"back_emf", NULL},
    [HCI_WAVEFORM_COGGING] = {"cogging", NULL},
    {NULL, NULL},
};

static const cli_option OPTIONS[] = {
    [QUANTITY] = {"quantity", 0, CLI_CHOICE, "NAME", NULL, .choices = QUANTITIES},
    [POLE_PAIRS] = {"pole-pairs", 0, CLI_WHOLE, "P", .help = "of the machine (half its poles)", .low = 1.0,
                    .high = 1000.0},
    [ORDERS] = {"orders", 0, CLI_TEXT, "LIST",
                .help = "these electrical orders and no others, such as 1,5,7 or 12/7"},
    [MAX_ORDER] = {"max-order", 0, CLI_NUMBER, "N", .help = "highest electrical order looked at (60)",
                   .low = 1.0, .high = HCI_MOST_ORDER},
    [CONSTANT] = {"torque-constant", 0, CLI_NUMBER, "NM_PER_A",
                  .help = "cogging of a run with currents: torque of 1 A of i_q", .low = 1e-9, .high = 1e6},
    [OUT] = {"out", 'o', CLI_FOLDER, "FOLDER", .help = "where the table goes; without it nothing is written"},
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
    return hci_note_set(note, HCI_ERROR_ARGUMENT, "--orders: found more than %d orders", (int)MOST_ORDERS);
}

/* Options that exclude or need each other. */
static hci_status check_together(const cli_arguments *a, hci_note *note)
{
    const char *wrong = NULL;
    if (!a->value[QUANTITY])
        wrong = "harmonics: add --quantity back_emf or cogging";
    else if (!a->value[POLE_PAIRS])
        wrong = "harmonics: add --pole-pairs P";
    else if (a->given[ORDERS] && a->given[MAX_ORDER])
        wrong = "harmonics: give --orders or --max-order, not both";
    else if (a->given[CONSTANT] && a->choice[QUANTITY] != HCI_WAVEFORM_COGGING)
        wrong = "--torque-constant goes with --quantity cogging";
    return wrong ? hci_note_set(note, HCI_ERROR_ARGUMENT, "%s", wrong) : HCI_OK;
}

static hci_status read_options(const cli_arguments *a, hci_waveform_options *o, double orders[MOST_ORDERS],
                               hci_note *note)
{
    const hci_status status = check_together(a, note);
    if (status) return status;
    o->quantity = (hci_waveform_quantity)a->choice[QUANTITY];
    o->pole_pairs = (int)a->number[POLE_PAIRS];
    o->max_order = a->number[MAX_ORDER];
    o->torque_constant_Nm_per_A = a->number[CONSTANT];
    if (!a->value[ORDERS]) return HCI_OK;
    o->orders = orders;
    return read_orders(a->value[ORDERS], orders, &o->order_count, note);
}

/* ---- words ---- */

static void show_channels(const hci_waveform *w)
{
    for (int s = 0; s < 3; ++s) {
        const hci_waveform_channel *c = &w->channel[s];
        cli_say("  %-12s offset %.4g ± %.1g V, %.5g ± %.1g times the others, phase %+.4f ± %.1g rad%s\n",
                c->name, c->offset_V, c->offset_error_V, c->ratio, c->ratio_error, c->phase_error_rad,
                c->phase_error, c->left_out ? " (left out)" : "");
    }
}

static void show_source(const hci_waveform *w)
{
    if (w->quantity == HCI_WAVEFORM_COGGING) {
        cli_say("  mean         %.5g N·m\n", w->mean_Nm);
        if (isfinite(w->friction_Nm))
            cli_say("  friction     %.5g ± %.2g N·m (half the difference of the directions)\n",
                    w->friction_Nm, w->friction_error_Nm);
        return;
    }
    if (isfinite(w->frequency_Hz))
        cli_say("  frequency    %.7g Hz electrical, drifting by %.3g Hz/s (from the voltages)\n",
                w->frequency_Hz, w->drift_Hz_per_s);
    cli_say("  speed        %.6g rpm mean\n", w->speed_rad_per_s * 30.0 / HCI_PI);
    show_channels(w);
}

static void show_test(const hci_waveform *w)
{
    if (w->turns_forward + w->turns_backward > 0)
        cli_say("  turns        %zu forward, %zu backward, %s\n", w->turns_forward, w->turns_backward,
                w->step < 1.0 ? "mechanical" : "electrical");
    cli_say("  errors       %s\n", w->between_turns ? "from how the turns differ"
                                   : w->step > 0.0  ? "from the orders around"
                                                    : "from what the orders leave");
    if (w->count == 0 || w->largest_left <= 0.0) return;
    for (size_t k = 0; k < w->count; ++k)
        if (fabs(w->order[k].order - w->largest_left) < HCI_ORDER_TOLERANCE)
            cli_say("  left out     %zu of %zu orders up to %.6g, which noise can make; the largest is "
                    "order %.6g, %.3g ± %.1g\n",
                    w->count - w->kept, w->count, w->order[w->count - 1].order, w->largest_left,
                    w->order[k].amplitude, w->order[k].std_error);
}

/* ---- spectrum ---- */

static double kept_amplitude(const void *waveform, size_t k)
{
    const hci_waveform_order *o = &((const hci_waveform *)waveform)->order[k];
    return o->kept ? o->amplitude : 0.0;
}

typedef struct {
    const hci_waveform *waveform;
    size_t pick[CLI_MOST_ROWS];
} spectrum;

static void spectrum_row(const void *context, size_t row, cli_cell cell[])
{
    const spectrum *s = context;
    const hci_waveform_order *o = &s->waveform->order[s->pick[row]];
    snprintf(cell[0].text, sizeof cell[0].text, "%.6g", o->order);
    snprintf(cell[1].text, sizeof cell[1].text, "%.4g", o->amplitude);
    snprintf(cell[2].text, sizeof cell[2].text, "%.1e", o->std_error);
    snprintf(cell[3].text, sizeof cell[3].text, "%.4f", o->phase_rad);
    cell[4].value = o->amplitude;
    cell[4].mark = o->std_error;
}

static void show_orders(const hci_waveform *w)
{
    static const cli_column COLUMNS[] = {{CLI_RIGHT, "order"},
                                         {CLI_RIGHT, "amplitude"},
                                         {CLI_RIGHT, "std error"},
                                         {CLI_RIGHT, "phase/rad"},
                                         {CLI_BAR, ""}};
    const bool cogging = w->quantity == HCI_WAVEFORM_COGGING;
    char caption[160];
    spectrum s = {.waveform = w};
    const size_t rows = cli_pick(kept_amplitude, w, w->count, 1e-6, s.pick, NULL);
    snprintf(caption, sizeof caption, "%s by electrical order, %s; in the bars %s is the standard error",
             cogging ? "cogging torque" : "back-EMF", cogging ? "N·m (peak)" : "N·m/A (peak of a phase)",
             cli_is_ascii() ? "|" : "│");
    cli_draw(&(cli_chart){.caption = caption,
                          .column = COLUMNS,
                          .columns = 5,
                          .rows = rows,
                          .fill = spectrum_row,
                          .context = &s,
                          .logarithmic = true,
                          .unit = cogging ? "N·m" : "N·m/A"});
    if (rows < w->kept) cli_say("  and %zu smaller ones\n", w->kept - rows);
}

static void show(const hci_waveform *w, const cli_arguments *a)
{
    cli_say("%s%s" CLI_PLAIN ": %s, %zu order%s\n", w->kept > 0 ? CLI_GOOD : CLI_WARN,
            w->quantity == HCI_WAVEFORM_COGGING ? "cogging torque" : "back-EMF", a->word[0], w->kept,
            w->kept == 1 ? "" : "s");
    show_source(w);
    show_test(w);
    if (w->kept > 0) show_orders(w);
}

/* ---- the command ---- */

static hci_status analyse(const cli_arguments *a, const hci_waveform_options *o, const hci_run *run,
                          hci_note *note)
{
    hci_waveform waveform;
    hci_status status = hci_waveform_find(run, o, &waveform, note);
    if (status) return status;
    if (a->value[OUT]) status = hci_waveform_write(&waveform, a->value[OUT], note);
    if (!status && cli_is_wordy()) {
        show(&waveform, a);
        cli_remark(&run->remark);
        cli_remark(&waveform.remark);
    }
    if (!status && a->given[JSON]) status = cli_print_json(hci_waveform_json(&waveform), note);
    hci_waveform_release(&waveform);
    return status;
}

static int run(const cli_arguments *a)
{
    double orders[MOST_ORDERS];
    hci_waveform_options options;
    hci_note note = {{0}};
    hci_run recording;
    memset(&options, 0, sizeof options);
    memset(&recording, 0, sizeof recording);
    hci_status status = read_options(a, &options, orders, &note);
    if (!status) status = hci_run_read(a->word[0], options.pole_pairs, NAN, &recording, &note);
    if (!status) status = analyse(a, &options, &recording, &note);
    hci_run_release(&recording);
    return status ? cli_fail(status, &note) : 0;
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
        "\nExit codes: 0 done; " CLI_EXIT_ERRORS,
    .source = "cli/harmonics.c",
    .guide = "measuring.md",
    .run = run,
};
