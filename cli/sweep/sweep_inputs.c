#include "cli/sweep/sweep_inputs.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "cli/command/parse.h"
#include "cli/solve/solve_limits.h"
#include "hci/host/base/number.h"
#include "hci/host/sweep/grid_file.h"
#include "hci/version.h"

enum { MOST_VALUES = 100000, ITEM_SIZE = 128 };

#define RPM (HCI_PI / 30.0) /* rad/s */

/* ---- lists: 80,320 or 0:3000:100 or both ---- */

/* What an option's values are. */
typedef struct {
    int key;
    const char *option;
    double low, high, factor; /* of a value as it is given, and to its unit */
    const char *example;
} list_kind;

static hci_status wrong_list(const list_kind *kind, const char *found, hci_note *note)
{
    return hci_note_set(note, HCI_ERROR_ARGUMENT,
                        "--%s: found `%.60s`, expected ascending values from %g to %g, as in %s",
                        kind->option, found, kind->low, kind->high, kind->example);
}

static bool append(cli_list *list, double value)
{
    if (list->count == list->room) {
        const size_t room = 2 * list->room + 16;
        double *more = list->count < MOST_VALUES ? realloc(list->value, room * sizeof *more) : NULL;
        if (!more) return false;
        list->value = more;
        list->room = room;
    }
    list->value[list->count++] = value;
    return true;
}

/* Twelve digits: 0.3 and not 0.30000000000000004. */
static double rounded(double value)
{
    char text[32];
    snprintf(text, sizeof text, "%.12g", value);
    return strtod(text, NULL);
}

/* `from`, or `from:to:step`, into a range whose end counts. */
static bool read_range(const char *item, double range[3])
{
    char text[ITEM_SIZE], *colon = text;
    int count = 0;
    snprintf(text, sizeof text, "%s", item);
    while (colon && count < 3) {
        char *at = colon;
        colon = strchr(at, ':');
        if (colon) *colon++ = '\0';
        if (!hci_number_parse(at, &range[count++])) return false;
    }
    if (count == 1) range[1] = range[0], range[2] = 1.0;
    return !colon && count != 2 && range[2] > 0.0 && range[1] >= range[0];
}

static hci_status append_item(const list_kind *kind, const char *item, cli_list *list, hci_note *note)
{
    double range[3];
    if (!read_range(item, range)) return wrong_list(kind, item, note);
    const double steps = floor((range[1] - range[0]) / range[2] + 1e-9);
    if (!(steps < MOST_VALUES)) return wrong_list(kind, item, note);
    for (double k = 0.0; k <= steps; k += 1.0) {
        const double value = rounded(range[0] + k * range[2]),
                     last = list->count ? list->value[list->count - 1] : 0.0;
        if (!(value >= kind->low && value <= kind->high) || (list->count && !(value * kind->factor > last)))
            return wrong_list(kind, item, note);
        if (!append(list, value * kind->factor)) return hci_note_memory(note, NULL, "--%s", kind->option);
    }
    return HCI_OK;
}

static hci_status read_list(const list_kind *kind, const char *text, cli_list *list, hci_note *note)
{
    hci_status status = HCI_OK;
    while (text && !status) {
        const char *comma = strchr(text, ',');
        const size_t length = comma ? (size_t)(comma - text) : strlen(text);
        char item[ITEM_SIZE] = "";
        if (length < sizeof item) memcpy(item, text, length);
        status = append_item(kind, item, list, note);
        text = comma ? comma + 1 : NULL;
    }
    return status;
}

static hci_status read_lists(const cli_arguments *a, cli_sweep_inputs *in, hci_note *note)
{
    static const list_kind KIND[] = {
        {SWEEP_TORQUES, "torques", -1e9, 1e9, 1.0, "0.5,1,2 or 0.5:3:0.25 (N·m)"},
        {SWEEP_SPEEDS, "speeds", -1e7, 1e7, RPM, "80,320 or 0:3000:100 (rpm)"},
        {SWEEP_LINKS, "dc-links", 1e-9, 1e9, 1.0, "250,311 (V)"},
        {SWEEP_CURRENTS, "currents", 1e-9, 1e9, 1.0, "10,12 or 10:24:0.5 (A)"},
        {SWEEP_COPPERS, "coppers", 1e-9, 1e9, 1.0, "1,1.2 or 0.9:1.4:0.02"}};
    cli_list *list[] = {&in->torque_Nm, &in->speed_rad_per_s, &in->link_V, &in->current_A, &in->copper};
    hci_status status = HCI_OK;
    for (size_t k = 0; k < sizeof KIND / sizeof KIND[0] && !status; ++k)
        if (a->given[KIND[k].key]) status = read_list(&KIND[k], a->value[KIND[k].key], list[k], note);
    if (!status && a->given[SWEEP_TORQUE] && !append(&in->torque_Nm, a->number[SWEEP_TORQUE]))
        status = hci_note_memory(note, NULL, "--torque");
    if (!status && a->given[SWEEP_SPEED] && !append(&in->speed_rad_per_s, a->number[SWEEP_SPEED] * RPM))
        status = hci_note_memory(note, NULL, "--speed");
    return status;
}

/* ---- what goes together ---- */

static const char *wrong_kind(const cli_arguments *a)
{
    const int kinds = a->given[SWEEP_TRADE_OFF] + a->given[SWEEP_ENVELOPE] + a->given[SWEEP_MAP];
    if (kinds > 1) return "sweep: --trade-off, --envelope and --map are three sweeps; give one of them";
    if (a->words > 2) return "sweep: expected MACHINE, or MACHINE and a GRID";
    if (a->words == 2 && (a->given[SWEEP_TRADE_OFF] || a->given[SWEEP_ENVELOPE]))
        return "sweep: a GRID in a file is for a map; leave it out";
    if (a->words == 2 && (a->given[SWEEP_TORQUES] || a->given[SWEEP_SPEEDS] || a->given[SWEEP_LINKS]))
        return "sweep: a GRID in a file takes the place of --torques, --speeds and --dc-links";
    if (kinds == 0 && a->words == 1)
        return "sweep: expected --trade-off, --envelope, --map, or a GRID behind MACHINE";
    return NULL;
}

static const char *wrong_axes(const cli_arguments *a)
{
    const bool trade_off = a->given[SWEEP_TRADE_OFF], envelope = a->given[SWEEP_ENVELOPE];
    if (trade_off && !a->given[SWEEP_TORQUE]) return "sweep: --trade-off is of a torque; add --torque NM";
    if (trade_off && (a->given[SWEEP_TORQUES] || a->given[SWEEP_SPEEDS] || a->given[SWEEP_LINKS]))
        return "sweep: --trade-off is of one torque at one speed; give --torque and --speed";
    if (!trade_off && (a->given[SWEEP_TORQUE] || a->given[SWEEP_SPEED] || a->given[SWEEP_CURRENTS] ||
                       a->given[SWEEP_COPPERS]))
        return "sweep: --torque, --speed, --currents and --coppers go with --trade-off; otherwise --torques "
               "and --speeds";
    if (envelope && !a->given[SWEEP_SPEEDS])
        return "sweep: --envelope is over the speed; add --speeds RPM,...";
    if (envelope && a->given[SWEEP_TORQUES])
        return "sweep: --envelope looks for the torque; leave out --torques";
    if (!envelope && a->given[SWEEP_RIPPLE]) return "sweep: --ripple goes with --envelope";
    if (a->given[SWEEP_MAP] && a->words == 1 && (!a->given[SWEEP_TORQUES] || !a->given[SWEEP_SPEEDS]))
        return "sweep: --map is over torque and speed; add --torques NM,... and --speeds RPM,...";
    return NULL;
}

static const char *wrong_files(const cli_arguments *a)
{
    if (a->given[SWEEP_REPORT] && !a->given[SWEEP_OUT])
        return "--report is written into a folder; add --out FOLDER";
    if (a->given[SWEEP_SHARD] && !a->given[SWEEP_OUT])
        return "sweep: --shard leaves its points in a folder; add --out FOLDER";
    if (a->given[SWEEP_HARMONICS] && a->given[SWEEP_AUTO])
        return "--harmonics names the components; leave out --auto";
    return NULL;
}

static hci_status check_together(const cli_arguments *a, hci_note *note)
{
    const char *wrong = wrong_kind(a);
    if (!wrong) wrong = wrong_axes(a);
    if (!wrong) wrong = wrong_files(a);
    return wrong ? hci_note_set(note, HCI_ERROR_ARGUMENT, "%s", wrong) : HCI_OK;
}

/* A limit of the voltage that no speed lets act is a slip. */
static hci_status check_voltage(const cli_arguments *a, const cli_sweep_inputs *in, hci_note *note)
{
    const hci_solve_options *o = &in->options;
    if (in->speed_rad_per_s.count || in->point ||
        (o->limit_voltage_V == 0.0 && o->limits.voltage_reserve == 0.0))
        return HCI_OK;
    return hci_note_set(note, HCI_ERROR_ARGUMENT, "sweep: the voltage is limited at a speed; add %s RPM",
                        a->given[SWEEP_TRADE_OFF] ? "--speed" : "--speeds");
}

/* Voltages of the points take its place, so it would be dropped. */
static hci_status check_links(const cli_sweep_inputs *in, size_t points, hci_note *note)
{
    bool is_linked = in->link_V.count > 0;
    for (size_t k = 0; k < points; ++k)
        is_linked = is_linked || !isnan(in->point[k].link_V);
    if (!is_linked || in->options.limit_voltage_V == 0.0) return HCI_OK;
    return hci_note_set(note, HCI_ERROR_ARGUMENT,
                        "sweep: %s and --limit-voltage are both dc links; leave one of them out",
                        points ? "dc_link_V of the GRID" : "--dc-links");
}

/* A speed of a point that a voltage has to go with, or 0. */
static double speed_without_link(const cli_sweep_inputs *in, size_t points)
{
    for (size_t k = 0; k < points; ++k)
        if (in->point[k].speed_rad_per_s != 0.0 && isnan(in->point[k].link_V))
            return in->point[k].speed_rad_per_s;
    for (size_t k = 0; k < in->speed_rad_per_s.count && in->link_V.count == 0; ++k)
        if (in->speed_rad_per_s.value[k] != 0.0) return in->speed_rad_per_s.value[k];
    return 0.0;
}

/* A speed acts through the voltage alone: without one every speed would have the same torque. */
static hci_status check_speeds(const cli_arguments *a, const cli_sweep_inputs *in, size_t points,
                               hci_note *note)
{
    const hci_solve_options *o = &in->options;
    const double speed_rad_per_s = speed_without_link(in, points);
    const bool is_declared = in->machine.dc_link_voltage_V > 0.0 && !o->limits.ignore_ratings;
    if (speed_rad_per_s == 0.0 || o->limit_voltage_V > 0.0 || is_declared) return HCI_OK;
    return hci_note_set(
        note, HCI_ERROR_ARGUMENT,
        "sweep: a speed changes currents through the voltage alone, and no dc link is known that limits it "
        "at "
        "%g rpm; add %s--limit-voltage V or, in machine.csv, `dc_link_voltage`%s, or give %s 0",
        speed_rad_per_s / RPM, a->given[SWEEP_TRADE_OFF] ? "" : "--dc-links V,..., ",
        o->limits.ignore_ratings ? " without --ignore-ratings" : "",
        a->given[SWEEP_TRADE_OFF] ? "--speed" : "--speeds");
}

/* ---- what results depend on ---- */

static bool is_about_work(int key)
{
    return key == SWEEP_JOBS || key == SWEEP_SHARD || key == SWEEP_JOIN || key == SWEEP_OUT ||
           key == SWEEP_REPORT;
}

static void list_inputs(const cli_option *table, const cli_arguments *a, hci_grid_inputs *inputs)
{
    hci_grid_inputs_add(inputs, "version", HCI_VERSION_STRING);
    hci_grid_inputs_add_machine(inputs, a->word[0]);
    if (a->words == 2) hci_grid_inputs_add_file(inputs, "grid", a->word[1]);
    for (int k = 0; table[k].name; ++k) {
        if (!a->given[k] || is_about_work(k) || table[k].is_common) continue;
        if (table[k].kind == CLI_FILE)
            hci_grid_inputs_add_file(inputs, table[k].name, a->value[k]);
        else
            hci_grid_inputs_add(inputs, table[k].name, a->value[k] ? a->value[k] : "yes");
    }
}

/* ---- all of it ---- */

static void fill_options(const cli_arguments *a, cli_sweep_inputs *in)
{
    hci_solve_options *o = &in->options;
    o->choose_at_most = (size_t)cli_number_or(a, SWEEP_AUTO, 0.0);
    o->at_temperature = a->given[SWEEP_TEMPERATURE];
    o->temperature_C = cli_number_or(a, SWEEP_TEMPERATURE, 0.0);
    o->effects = &in->effects.list;
    o->set = a->value[SWEEP_HARMONICS] ? &in->set : NULL;
    if (!a->given[SWEEP_MINIMISE] && a->given[SWEEP_TRADE_OFF]) o->minimise = HCI_MINIMISE_PEAK_TO_PEAK;
}

static hci_grid_axis axis_of(const cli_list *list)
{
    return (hci_grid_axis){list->value, list->count};
}

static void fill_request(const cli_arguments *a, size_t points, cli_sweep_inputs *in)
{
    in->request =
        (hci_grid_request){.kind = a->given[SWEEP_TRADE_OFF]  ? HCI_GRID_TRADE_OFF
                                   : a->given[SWEEP_ENVELOPE] ? HCI_GRID_ENVELOPE
                                                              : HCI_GRID_MAP,
                           .machine = &in->machine,
                           .options = &in->options,
                           .ripple_percent = fmax(cli_number_or(a, SWEEP_RIPPLE, 1.0), HCI_GRID_SMOOTH),
                           .torque_Nm = axis_of(&in->torque_Nm),
                           .speed_rad_per_s = axis_of(&in->speed_rad_per_s),
                           .link_V = axis_of(&in->link_V),
                           .limit_current_A = axis_of(&in->current_A),
                           .limit_copper = axis_of(&in->copper),
                           .point = in->point,
                           .point_count = points};
}

hci_status cli_sweep_read(const cli_option *table, const cli_arguments *a, cli_sweep_inputs *in,
                          hci_note *note)
{
    size_t points = 0;
    hci_status status = check_together(a, note);
    if (!status) status = read_lists(a, in, note);
    if (!status) status = cli_shard_read(a->value[SWEEP_SHARD], &in->shard, note);
    if (!status) status = cli_limits_take(table, a, &in->options, note);
    const hci_order_base base = (hci_order_base)a->choice[SWEEP_ORDER_BASE];
    if (!status) status = hci_machine_read_orders(a->word[0], base, &in->machine, note);
    const hci_set_tables of = {in->machine.has_neutral, in->machine.model.pole_pairs, base};
    if (!status) status = hci_effects_read_machine(a->word[0], &in->effects, note);
    if (!status && a->value[SWEEP_HARMONICS])
        status = hci_component_set_read_orders(a->value[SWEEP_HARMONICS], &of, &in->set, note);
    if (!status && a->words == 2) status = hci_grid_read(a->word[1], &in->point, &points, note);
    if (!status) status = check_voltage(a, in, note);
    if (!status) status = check_links(in, points, note);
    if (!status) status = check_speeds(a, in, points, note);
    if (status) return status;
    fill_options(a, in);
    fill_request(a, points, in);
    list_inputs(table, a, &in->inputs);
    return HCI_OK;
}

void cli_sweep_inputs_release(cli_sweep_inputs *in)
{
    cli_list *list[] = {&in->torque_Nm, &in->speed_rad_per_s, &in->link_V, &in->current_A, &in->copper};
    for (size_t k = 0; k < sizeof list / sizeof list[0]; ++k)
        free(list[k]->value);
    hci_grid_points_free(in->point);
    hci_machine_release(&in->machine);
    hci_effects_release(&in->effects);
    hci_component_set_release(&in->set);
}
