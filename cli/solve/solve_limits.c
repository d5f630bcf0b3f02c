#include "cli/solve/solve_limits.h"

#include <math.h>
#include <string.h>

#include "cli/command/parse.h"
#include "hci/host/base/number.h"

const cli_choice cli_minimise_choices[] = {
    [HCI_MINIMISE_AUTO] = {"auto", "auto (default): least squares, within limits worst"},
    [HCI_MINIMISE_WORST] = {"worst", "; worst: order"},
    [HCI_MINIMISE_PEAK_TO_PEAK] = {"peak-to-peak", NULL},
    [HCI_MINIMISE_RMS] = {"rms", NULL},
    {NULL, NULL},
};

enum { ITEM_SIZE = 64 };

#define MOST 1e9 /* A or W */

/* The next item of a list up to its comma; false where it is too long. *rest: in what is left, out what
 * follows, NULL at the end. */
static bool next_item(const char **rest, char item[ITEM_SIZE])
{
    const char *comma = strchr(*rest, ',');
    const size_t length = comma ? (size_t)(comma - *rest) : strlen(*rest);
    if (length >= ITEM_SIZE) return false;
    memcpy(item, *rest, length);
    item[length] = '\0';
    *rest = comma ? comma + 1 : NULL;
    return true;
}

/* `12` for all phases, `a=12` for one. value: NAN where nothing is said of a phase. */
static bool take_item(const char *item, double *all, double value[3])
{
    const bool is_phase = item[0] >= 'a' && item[0] <= 'c' && item[1] == '=';
    double *to = is_phase ? &value[item[0] - 'a'] : all;
    double number;
    if (!isnan(*to) || !hci_number_parse(item + (is_phase ? 2 : 0), &number)) return false;
    *to = number;
    return number <= MOST && (is_phase ? number >= 0.0 : number > 0.0);
}

static bool read_phases(const char *text, double *all, double value[3])
{
    char item[ITEM_SIZE];
    *all = value[0] = value[1] = value[2] = NAN;
    while (text)
        if (!next_item(&text, item) || !take_item(item, all, value)) return false;
    return true;
}

static hci_status take_current(const char *text, hci_solve_options *options, hci_note *note)
{
    double all_A, phase_A[3];
    if (!read_phases(text, &all_A, phase_A))
        return hci_note_set(
            note, HCI_ERROR_ARGUMENT,
            "--limit-current: found `%s`, expected a peak above 0 A such as 12, or one of a phase "
            "such as a=10 or 12,a=0 (0: the phase is open)",
            text);
    options->limit_current_A = isnan(all_A) ? 0.0 : all_A;
    for (int s = 0; s < 3; ++s) {
        options->limits.is_open[s] = phase_A[s] == 0.0;
        options->limits.current_A[s] = phase_A[s] > 0.0 ? phase_A[s] : 0.0;
    }
    return HCI_OK;
}

static hci_status take_rms(const char *text, hci_solve_limits *limits, hci_note *note)
{
    double all_A, phase_A[3];
    const bool good = read_phases(text, &all_A, phase_A);
    for (int s = 0; s < 3; ++s)
        limits->rms_A[s] = !isnan(phase_A[s]) ? phase_A[s] : isnan(all_A) ? 0.0 : all_A;
    if (good && phase_A[0] != 0.0 && phase_A[1] != 0.0 && phase_A[2] != 0.0) return HCI_OK;
    return hci_note_set(
        note, HCI_ERROR_ARGUMENT,
        "--limit-rms: found `%s`, expected a rms current above 0 A such as 8, or one of a phase such "
        "as a=6 or 8,a=6; --limit-current a=0 opens a phase",
        text);
}

static hci_status take_copper(const char *text, hci_solve_limits *limits, hci_note *note)
{
    char item[ITEM_SIZE];
    const size_t length = strlen(text);
    const bool is_ratio = length > 1 && length < ITEM_SIZE && text[length - 1] == 'x';
    double number = 0.0;
    memcpy(item, text, length < ITEM_SIZE ? length + 1 : 1);
    item[length < ITEM_SIZE ? length - is_ratio : 0] = '\0';
    if (!hci_number_parse(item, &number) || !(number > 0.0 && number <= MOST))
        return hci_note_set(
            note, HCI_ERROR_ARGUMENT,
            "--limit-copper: found `%s`, expected a copper loss above 0 W such as 30, or one over "
            "that of the plain sine such as 1.2x",
            text);
    *(is_ratio ? &limits->copper_ratio : &limits->copper_W) = number;
    return HCI_OK;
}

/* ---- all of them ---- */

/* Place of an option that the table has. */
static int place(const cli_option *table, const char *name)
{
    return cli_option_find(table, name, strlen(name));
}

static double number_or_0(const cli_option *table, const cli_arguments *a, const char *name)
{
    return cli_number_or(a, place(table, name), 0.0);
}

hci_status cli_limits_take(const cli_option *table, const cli_arguments *a, hci_solve_options *o,
                           hci_note *note)
{
    const char *current = a->value[place(table, "limit-current")], *rms = a->value[place(table, "limit-rms")],
               *copper = a->value[place(table, "limit-copper")];
    hci_status status = HCI_OK;
    o->minimise = (hci_minimise)a->choice[place(table, "minimise")];
    o->limits.voltage_reserve = number_or_0(table, a, "voltage-reserve");
    o->limits.dead_time_s = number_or_0(table, a, "dead-time");
    o->limits.pwm_frequency_Hz = number_or_0(table, a, "pwm-frequency");
    o->limits.ignore_ratings = a->given[place(table, "ignore-ratings")];
    o->limit_voltage_V = number_or_0(table, a, "limit-voltage");
    if (a->given[place(table, "dead-time")] != a->given[place(table, "pwm-frequency")])
        status = hci_note_set(note, HCI_ERROR_ARGUMENT, "--dead-time and --pwm-frequency go together");
    if (!status && current) status = take_current(current, o, note);
    if (!status && rms) status = take_rms(rms, &o->limits, note);
    if (!status && copper) status = take_copper(copper, &o->limits, note);
    return status;
}
