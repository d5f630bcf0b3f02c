#include <stddef.h>
#include <string.h>

#include "cli/command/command.h"
#include "cli/command/parse.h"
#include "cli/commands.h"
#include "cli/init/init_words.h"
#include "cli/terminal/say.h"
#include "cli/terminal/terminal.h"
#include "hci/host/machine/init.h"
#include "hci/host/report/summary.h"

enum {
    POLE_PAIRS,
    POLES,
    KV,
    KV_OF,
    VOLT,
    VOLT_OF,
    TORQUE,
    TORQUE_OF,
    FLUX,
    SLOTS,
    RESISTANCE,
    RESISTANCE_OF,
    INDUCTANCE,
    INDUCTANCE_D,
    INDUCTANCE_Q,
    INERTIA,
    CURRENT,
    CURRENT_OF,
    RATED_TORQUE,
    RATED_SPEED,
    DC_LINK,
    OUT,
    CLI_COMMON_KEYS,
    OPTION_COUNT
};

/* Words of how a number is meant, the default first. */
static const cli_choice KVS[] = {{"line-peak", "line-peak (default, hobby motors)"},
                                 {"line-rms", NULL},
                                 {"phase-peak", ", phase-peak"},
                                 {NULL, NULL}};
static const cli_choice VOLTS[] = {{"line-rms", "line-rms (default, servo motors)"},
                                   {"line-peak", NULL},
                                   {"phase-peak", NULL},
                                   {"phase-rms", ", phase-rms"},
                                   {NULL, NULL}};
static const cli_choice TORQUES[] = {
    {"peak", "peak (default)"}, {"rms", "its rms"}, {"dc", ", or dc: block commutation"}, {NULL, NULL}};
static const cli_choice RESISTANCES[] = {
    {"phase", "phase (default)"}, {"line", ", or line: between two terminals"}, {NULL, NULL}};
static const cli_choice CURRENTS[] = {{"peak", "peak (default)"}, {"rms", NULL}, {NULL, NULL}};

#define GIVE_IN(unit) "give it in " unit ", with a decimal point and without the unit"

static const cli_option OPTIONS[] = {
    [POLE_PAIRS] = {"pole-pairs", 0, CLI_WHOLE, "P", .help = "half the number of magnets around the rotor",
                    .low = 1.0, .high = 1000.0, .remedy = "a machine with N magnets has N/2 pole pairs"},
    [POLES] = {"poles", 0, CLI_WHOLE, "N", .help = "the same as magnets, 2 P", .low = 2.0, .high = 2000.0,
               .step = 2, .remedy = "count the magnets around the rotor, or give --pole-pairs"},
    [KV] = {"kv", 0, CLI_NUMBER, "RPM_PER_V", .help = "strength of the magnets as Kv: rpm per volt,",
            .low = 1e-3, .high = 1e6, .remedy = GIVE_IN("rpm/V")},
    [KV_OF] = {"kv-of", 0, CLI_CHOICE, "NAME", .help = "... of", .choices = KVS},
    [VOLT] = {"volt-per-krpm", 0, CLI_NUMBER, "V", .help = "or as back-EMF at 1000 rpm,", .low = 1e-6,
              .high = 1e6, .remedy = GIVE_IN("V/krpm")},
    [VOLT_OF] = {"volt-of", 0, CLI_CHOICE, "NAME", .help = "... of", .choices = VOLTS},
    [TORQUE] = {"torque-constant", 0, CLI_NUMBER, "NM_PER_A", .help = "or as torque per ampere,", .low = 1e-9,
                .high = 1e6, .remedy = GIVE_IN("N·m/A")},
    [TORQUE_OF] = {"torque-of", 0, CLI_CHOICE, "NAME", .help = "... of a sine's", .choices = TORQUES},
    [FLUX] = {"flux", 0, CLI_NUMBER, "WB", .help = "or as flux linkage of a phase, peak (5.2 mWb is 0.0052)",
              .low = 1e-9, .high = 1e3, .remedy = GIVE_IN("Wb")},
    [SLOTS] = {"slots", 0, CLI_WHOLE, "N", .help = "of the stator; gives the orders of the cogging torque",
               .low = 3.0, .high = HCI_MOST_SLOTS, .step = 3,
               .remedy = "count the teeth of the stator (not the magnets), or leave it out"},
    [RESISTANCE] = {"resistance", 0, CLI_NUMBER, "OHM", .help = "of the winding,", .low = 1e-9, .high = 1e6,
                    .remedy = GIVE_IN("ohm")},
    [RESISTANCE_OF] = {"resistance-of", 0, CLI_CHOICE, "NAME", .help = "... of a", .choices = RESISTANCES},
    [INDUCTANCE] = {"inductance", 0, CLI_NUMBER, "H",
                    .help = "of a phase: half of that between two terminals", .low = 1e-12, .high = 10.0,
                    .remedy = GIVE_IN("H, not mH")},
    [INDUCTANCE_D] = {"inductance-d", 0, CLI_NUMBER, "H",
                      .help = "instead, with --inductance-q: along the magnets", .low = 1e-12, .high = 10.0,
                      .remedy = GIVE_IN("H, not mH")},
    [INDUCTANCE_Q] = {"inductance-q", 0, CLI_NUMBER, "H", .help = "... across the magnets", .low = 1e-12,
                      .high = 10.0, .remedy = GIVE_IN("H, not mH")},
    [INERTIA] = {"inertia", 0, CLI_NUMBER, "KGM2", .help = "of the rotor (1 g cm2 is 1e-7)", .low = 1e-15,
                 .high = 1e6, .remedy = GIVE_IN("kg·m²")},
    [CURRENT] = {"rated-current", 0, CLI_NUMBER, "A", .help = "of a phase,", .low = 1e-9, .high = 1e6,
                 .remedy = GIVE_IN("A")},
    [CURRENT_OF] = {"current-of", 0, CLI_CHOICE, "NAME", .help = "... as", .choices = CURRENTS},
    [RATED_TORQUE] = {"rated-torque", 0, CLI_NUMBER, "NM", .help = "on the shaft", .low = 1e-9, .high = 1e9,
                      .remedy = GIVE_IN("N·m")},
    [RATED_SPEED] = {"rated-speed", 0, CLI_NUMBER, "RPM", .help = "mechanical", .low = 1e-3, .high = 1e6,
                     .remedy = GIVE_IN("rpm")},
    [DC_LINK] = {"dc-link", 0, CLI_NUMBER, "V", .help = "voltage of the battery or supply", .low = 1e-3,
                 .high = 1e6, .remedy = GIVE_IN("V")},
    [OUT] = {"out", 'o', CLI_FOLDER, "FOLDER", .help = "where the tables go (default: NAME)"},
    CLI_COMMON_OPTIONS};

typedef char every_option_has_a_place[(int)OPTION_COUNT <= (int)CLI_MOST_OPTIONS ? 1 : -1];

/* ---- options ---- */

static hci_status read_poles(const cli_arguments *a, hci_sheet *s, hci_note *note)
{
    const int poles = (int)cli_number_or(a, POLES, 0.0);
    s->pole_pairs = (int)cli_number_or(a, POLE_PAIRS, 0.0);
    if (s->pole_pairs == 0 && poles == 0)
        return hci_note_set(
            note, HCI_ERROR_ARGUMENT,
            "init: no pole pairs; add --pole-pairs P, or --poles N with the number of magnets");
    if (s->pole_pairs != 0 && poles != 0 && poles != 2 * s->pole_pairs)
        return hci_note_set(
            note, HCI_ERROR_ARGUMENT,
            "--poles: found `%s` beside --pole-pairs %d, expected %d; leave out one of the two",
            a->value[POLES], s->pole_pairs, 2 * s->pole_pairs);
    if (poles != 0) s->pole_pairs = poles / 2;
    return HCI_OK;
}

/* What the first of two options says how the second is meant, is of no use without that. */
static hci_status check_of(const cli_arguments *a, int of, int option, hci_note *note)
{
    if (!a->given[of] || a->given[option]) return HCI_OK;
    return hci_note_set(note, HCI_ERROR_ARGUMENT,
                        "--%s: found `%.60s` without --%s; add --%s %s, or leave it out", OPTIONS[of].name,
                        a->value[of], OPTIONS[option].name, OPTIONS[option].name, OPTIONS[option].value_name);
}

static hci_status check_all_of(const cli_arguments *a, hci_note *note)
{
    static const int PAIRS[][2] = {{KV_OF, KV},
                                   {VOLT_OF, VOLT},
                                   {TORQUE_OF, TORQUE},
                                   {RESISTANCE_OF, RESISTANCE},
                                   {CURRENT_OF, CURRENT}};
    hci_status status = HCI_OK;
    for (size_t k = 0; k < sizeof PAIRS / sizeof PAIRS[0] && !status; ++k)
        status = check_of(a, PAIRS[k][0], PAIRS[k][1], note);
    return status;
}

/* One of the four ways to say how strong the magnets are. The readings of each follow `first` as its choices
 * do. */
static hci_status read_strength(const cli_arguments *a, hci_sheet *s, hci_note *note)
{
    static const struct {
        int option, of;
        hci_sheet_reading first;
    } WAYS[] = {{KV, KV_OF, HCI_SHEET_KV_LINE_PEAK},
                {VOLT, VOLT_OF, HCI_SHEET_VOLT_LINE_RMS},
                {TORQUE, TORQUE_OF, HCI_SHEET_TORQUE_PEAK},
                {FLUX, OUT, HCI_SHEET_FLUX}};
    int given = -1;
    for (size_t k = 0; k < sizeof WAYS / sizeof WAYS[0]; ++k) {
        const int option = WAYS[k].option;
        if (!a->given[option]) continue;
        if (given >= 0)
            return hci_note_set(
                note, HCI_ERROR_ARGUMENT,
                "--%s: found `%.60s` beside --%s, expected one of them; leave out the less certain, "
                "the words at the end give it for comparison",
                OPTIONS[option].name, a->value[option], OPTIONS[given].name);
        given = option;
        s->strength = a->number[option];
        s->reading = (hci_sheet_reading)((int)WAYS[k].first + a->choice[WAYS[k].of]);
    }
    if (given >= 0) return HCI_OK;
    return hci_note_set(
        note, HCI_ERROR_ARGUMENT,
        "init: nothing says how strong the magnets are; add one of --kv RPM_PER_V, --volt-per-krpm V, "
        "--torque-constant NM_PER_A, --flux WB");
}

static hci_status read_inductance(const cli_arguments *a, hci_sheet *s, hci_note *note)
{
    const bool d = a->given[INDUCTANCE_D], q = a->given[INDUCTANCE_Q];
    if (a->given[INDUCTANCE] && (d || q))
        return hci_note_set(
            note, HCI_ERROR_ARGUMENT,
            "--inductance: found `%.60s` beside --inductance-%s, expected one or the other; leave it "
            "out if d and q differ",
            a->value[INDUCTANCE], d ? "d" : "q");
    if (d != q)
        return hci_note_set(
            note, HCI_ERROR_ARGUMENT,
            "--inductance-%s: found `%.60s` without --inductance-%s; give both, or --inductance H if "
            "they are equal",
            d ? "d" : "q", a->value[d ? INDUCTANCE_D : INDUCTANCE_Q], d ? "q" : "d");
    s->inductance_d_H = cli_number_or(a, INDUCTANCE_D, a->number[INDUCTANCE]);
    s->inductance_q_H = cli_number_or(a, INDUCTANCE_Q, a->number[INDUCTANCE]);
    return HCI_OK;
}

/* The last part of a path: tables hold no paths. */
static const char *last_part(const char *path)
{
    const char *slash = strrchr(path, '/');
    return slash && slash[1] != '\0' ? slash + 1 : path;
}

static hci_status read_sheet(const cli_arguments *a, hci_sheet *s, hci_note *note)
{
    hci_status status;
    *s = (hci_sheet){.name = last_part(a->word[0]),
                     .slots = (int)cli_number_or(a, SLOTS, 0.0),
                     .resistance_ohm = a->number[RESISTANCE],
                     .resistance_of_line = a->choice[RESISTANCE_OF] == 1,
                     .inertia_kgm2 = a->number[INERTIA],
                     .rated_current_A = a->number[CURRENT],
                     .rated_current_is_rms = a->choice[CURRENT_OF] == 1,
                     .rated_torque_Nm = a->number[RATED_TORQUE],
                     .rated_speed_rpm = a->number[RATED_SPEED],
                     .dc_link_voltage_V = a->number[DC_LINK]};
    if (a->word[0][0] == '\0' || (a->given[OUT] && a->value[OUT][0] == '\0'))
        return hci_note_set(note, HCI_ERROR_ARGUMENT,
                            "init: found `` for the folder, expected a name; give one such as my_motor");
    status = check_all_of(a, note);
    if (!status) status = read_poles(a, s, note);
    if (!status) status = read_strength(a, s, note);
    return status ? status : read_inductance(a, s, note);
}

static int run(const cli_arguments *a)
{
    const char *folder = a->value[OUT] ? a->value[OUT] : a->word[0];
    hci_note note = {{0}};
    hci_sheet sheet;
    hci_status status = read_sheet(a, &sheet, &note);
    if (!status) status = hci_init_write(folder, &sheet, &note);
    if (status) return cli_fail(status, &note);
    if (cli_is_wordy()) cli_show_sheet(&sheet, folder);
    if (a->given[JSON]) status = cli_print_json(hci_init_json(&sheet), &note);
    return status ? cli_fail(status, &note) : 0;
}

const cli_command cli_init = {
    .name = "init",
    .words = "NAME",
    .does = "Writes a first machine folder from the values of a data sheet.\n"
            "Needs the pole pairs, and one of --kv, --volt-per-krpm, --torque-constant, --flux.",
    .options = OPTIONS,
    .words_needed = 1,
    .names_files = true,
    .word_kind = CLI_TEXT,
    .example =
        "  hci-solve init hub --poles 30 --kv 16 --slots 27 -o out/hub\n"
        "  hci-solve solve out/hub --target data/scenarios/02/target.csv --auto -o out/hub_currents\n"
        "  hci-solve init servo --pole-pairs 4 --volt-per-krpm 98 --resistance 1.9 --resistance-of line -o "
        "out/servo\n"
        "\nExit codes: 0 done; " CLI_EXIT_ERRORS,
    .source = "cli/init.c",
    .guide = "init.md",
    .run = run,
};
