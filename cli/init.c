#include <math.h>
#include <stddef.h>
#include <stdio.h>
#include <string.h>

#include "cli/command/command.h"
#include "hci/host/base/number.h"
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

static const cli_option OPTIONS[] = {
    [POLE_PAIRS] = {"pole-pairs", 0, CLI_VALUE, "P", "half the number of magnets around the rotor"},
    [POLES] = {"poles", 0, CLI_VALUE, "N", "the same as magnets, 2 P"},
    [KV] = {"kv", 0, CLI_VALUE, "RPM_PER_V", "strength of the magnets as Kv: rpm per volt,"},
    [KV_OF] = {"kv-of", 0, CLI_VALUE, "NAME",
               "... of line-peak (default, hobby motors), line-rms, phase-peak"},
    [VOLT] = {"volt-per-krpm", 0, CLI_VALUE, "V", "or as back-EMF at 1000 rpm,"},
    [VOLT_OF] = {"volt-of", 0, CLI_VALUE, "NAME",
                 "... of line-rms (default, servo motors), line-peak, phase-peak, phase-rms"},
    [TORQUE] = {"torque-constant", 0, CLI_VALUE, "NM_PER_A", "or as torque per ampere,"},
    [TORQUE_OF] = {"torque-of", 0, CLI_VALUE, "NAME",
                   "... of a sine's peak (default), its rms, or dc: block commutation"},
    [FLUX] = {"flux", 0, CLI_VALUE, "WB", "or as flux linkage of a phase, peak (5.2 mWb is 0.0052)"},
    [SLOTS] = {"slots", 0, CLI_VALUE, "N", "of the stator; gives the orders of the cogging torque"},
    [RESISTANCE] = {"resistance", 0, CLI_VALUE, "OHM", "of the winding,"},
    [RESISTANCE_OF] = {"resistance-of", 0, CLI_VALUE, "NAME",
                       "... of a phase (default), or line: between two terminals"},
    [INDUCTANCE] = {"inductance", 0, CLI_VALUE, "H", "of a phase: half of that between two terminals"},
    [INDUCTANCE_D] = {"inductance-d", 0, CLI_VALUE, "H", "instead, with --inductance-q: along the magnets"},
    [INDUCTANCE_Q] = {"inductance-q", 0, CLI_VALUE, "H", "... across the magnets"},
    [INERTIA] = {"inertia", 0, CLI_VALUE, "KGM2", "of the rotor (1 g cm2 is 1e-7)"},
    [CURRENT] = {"rated-current", 0, CLI_VALUE, "A", "of a phase,"},
    [CURRENT_OF] = {"current-of", 0, CLI_VALUE, "NAME", "... as peak (default) or rms"},
    [RATED_TORQUE] = {"rated-torque", 0, CLI_VALUE, "NM", "on the shaft"},
    [RATED_SPEED] = {"rated-speed", 0, CLI_VALUE, "RPM", "mechanical"},
    [DC_LINK] = {"dc-link", 0, CLI_VALUE, "V", "voltage of the battery or supply"},
    [OUT] = {"out", 'o', CLI_VALUE, "FOLDER", "where the tables go (default: NAME)"},
    CLI_COMMON_OPTIONS};

typedef char every_option_has_a_place[(int)OPTION_COUNT <= (int)CLI_MOST_OPTIONS ? 1 : -1];

/* ---- options ---- */

static hci_status number(const cli_arguments *a, int option, double low, double high, const char *unit,
                         double *value, hci_note *note)
{
    const char *text = a->value[option];
    if (!text) return HCI_OK;
    if (hci_number_parse(text, value) && *value >= low && *value <= high) return HCI_OK;
    return hci_note_set(
        note, HCI_ERROR_ARGUMENT,
        "--%s: found `%.60s`, expected a number from %g to %g; give it in %s, with a decimal point and "
        "without the unit",
        OPTIONS[option].name, text, low, high, unit);
}

static hci_status whole_number(const cli_arguments *a, int option, int low, int high, int step,
                               const char *remedy, int *value, hci_note *note)
{
    const char *text = a->value[option];
    double x = 0.0;
    if (!text) return HCI_OK;
    if (hci_number_parse(text, &x) && x >= low && x <= high && fmod(x, step) == 0.0) {
        *value = (int)x;
        return HCI_OK;
    }
    return hci_note_set(note, HCI_ERROR_ARGUMENT, "--%s: found `%.60s`, expected %s from %d to %d; %s",
                        OPTIONS[option].name, text,
                        step == 2   ? "an even number"
                        : step == 3 ? "a multiple of 3"
                                    : "a whole number",
                        low, high, remedy);
}

static hci_status read_poles(const cli_arguments *a, hci_sheet *s, hci_note *note)
{
    int poles = 0;
    hci_status status = whole_number(a, POLE_PAIRS, 1, 1000, 1, "a machine with N magnets has N/2 pole pairs",
                                     &s->pole_pairs, note);
    if (!status)
        status = whole_number(a, POLES, 2, 2000, 2,
                              "count the magnets around the rotor, or give --pole-pairs", &poles, note);
    if (status) return status;
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

/* The four ways to say how strong the magnets are; the readings of one follow each other, the default first.
 */
static const struct {
    int option, of;
    double low, high;
    const char *unit;
    hci_sheet_reading first;
    const char *choices[5];
} STRENGTH[] = {
    {KV, KV_OF, 1e-3, 1e6, "rpm/V", HCI_SHEET_KV_LINE_PEAK, {"line-peak", "line-rms", "phase-peak", NULL}},
    {VOLT,
     VOLT_OF,
     1e-6,
     1e6,
     "V/krpm",
     HCI_SHEET_VOLT_LINE_RMS,
     {"line-rms", "line-peak", "phase-peak", "phase-rms", NULL}},
    {TORQUE, TORQUE_OF, 1e-9, 1e6, "N·m/A", HCI_SHEET_TORQUE_PEAK, {"peak", "rms", "dc", NULL}},
    {FLUX, -1, 1e-9, 1e3, "Wb", HCI_SHEET_FLUX, {NULL}},
};
enum { STRENGTHS = sizeof STRENGTH / sizeof *STRENGTH };

static hci_status of_what(const cli_arguments *a, int option, int of, const char *const *choices, int *chosen,
                          hci_note *note)
{
    *chosen = 0;
    if (of < 0 || !a->given[of]) return HCI_OK;
    if (!a->given[option])
        return hci_note_set(note, HCI_ERROR_ARGUMENT,
                            "--%s: found `%.60s` without --%s; add --%s %s, or leave it out",
                            OPTIONS[of].name, a->value[of], OPTIONS[option].name, OPTIONS[option].name,
                            OPTIONS[option].value_name);
    return cli_choice(OPTIONS[of].name, a->value[of], choices, chosen, note);
}

static hci_status read_strength(const cli_arguments *a, hci_sheet *s, hci_note *note)
{
    int given = -1;
    for (int k = 0; k < STRENGTHS; ++k) {
        int chosen;
        hci_status status =
            of_what(a, STRENGTH[k].option, STRENGTH[k].of, STRENGTH[k].choices, &chosen, note);
        if (status) return status;
        if (!a->given[STRENGTH[k].option]) continue;
        if (given >= 0)
            return hci_note_set(
                note, HCI_ERROR_ARGUMENT,
                "--%s: found `%.60s` beside --%s, expected one of them; leave out the less certain, "
                "the words at the end give it for comparison",
                OPTIONS[STRENGTH[k].option].name, a->value[STRENGTH[k].option],
                OPTIONS[STRENGTH[given].option].name);
        given = k;
        s->reading = (hci_sheet_reading)((int)STRENGTH[k].first + chosen);
        status = number(a, STRENGTH[k].option, STRENGTH[k].low, STRENGTH[k].high, STRENGTH[k].unit,
                        &s->strength, note);
        if (status) return status;
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
    double both = NAN;
    hci_status status = number(a, INDUCTANCE, 1e-12, 1e3, "H", &both, note);
    if (!status && a->given[INDUCTANCE] && (d || q))
        return hci_note_set(
            note, HCI_ERROR_ARGUMENT,
            "--inductance: found `%.60s` beside --inductance-%s, expected one or the other; leave it "
            "out if d and q differ",
            a->value[INDUCTANCE], d ? "d" : "q");
    if (!status && d != q)
        return hci_note_set(
            note, HCI_ERROR_ARGUMENT,
            "--inductance-%s: found `%.60s` without --inductance-%s; give both, or --inductance H if "
            "they are equal",
            d ? "d" : "q", a->value[d ? INDUCTANCE_D : INDUCTANCE_Q], d ? "q" : "d");
    s->inductance_d_H = s->inductance_q_H = both;
    if (!status) status = number(a, INDUCTANCE_D, 1e-12, 1e3, "H", &s->inductance_d_H, note);
    return status ? status : number(a, INDUCTANCE_Q, 1e-12, 1e3, "H", &s->inductance_q_H, note);
}

static hci_status read_winding(const cli_arguments *a, hci_sheet *s, hci_note *note)
{
    static const char *const RESISTANCES[] = {"phase", "line", NULL}, *const CURRENTS[] = {"peak", "rms",
                                                                                           NULL};
    int line = 0, rms = 0;
    hci_status status = number(a, RESISTANCE, 1e-9, 1e6, "ohm", &s->resistance_ohm, note);
    if (!status) status = of_what(a, RESISTANCE, RESISTANCE_OF, RESISTANCES, &line, note);
    if (!status) status = read_inductance(a, s, note);
    if (!status) status = number(a, CURRENT, 1e-9, 1e6, "A", &s->rated_current_A, note);
    if (!status) status = of_what(a, CURRENT, CURRENT_OF, CURRENTS, &rms, note);
    s->resistance_of_line = line == 1;
    s->rated_current_is_rms = rms == 1;
    return status;
}

/* The last part of a path: tables hold no paths. */
static const char *last_part(const char *path)
{
    const char *slash = strrchr(path, '/');
    return slash && slash[1] != '\0' ? slash + 1 : path;
}

static hci_status read_sheet(const cli_arguments *a, hci_sheet *s, hci_note *note)
{
    *s = (hci_sheet){.name = last_part(a->word[0])};
    s->resistance_ohm = s->inductance_d_H = s->inductance_q_H = s->inertia_kgm2 = s->rated_current_A = NAN;
    s->rated_torque_Nm = s->rated_speed_rpm = s->dc_link_voltage_V = NAN;
    if (a->word[0][0] == '\0' || (a->given[OUT] && a->value[OUT][0] == '\0'))
        return hci_note_set(note, HCI_ERROR_ARGUMENT,
                            "init: found `` for the folder, expected a name; give one such as my_motor");
    hci_status status = read_poles(a, s, note);
    if (!status) status = read_strength(a, s, note);
    if (!status) status = read_winding(a, s, note);
    if (!status) status = number(a, INERTIA, 1e-15, 1e6, "kg·m²", &s->inertia_kgm2, note);
    if (!status) status = number(a, RATED_TORQUE, 1e-9, 1e9, "N·m", &s->rated_torque_Nm, note);
    if (!status) status = number(a, RATED_SPEED, 1e-3, 1e6, "rpm", &s->rated_speed_rpm, note);
    if (!status) status = number(a, DC_LINK, 1e-3, 1e6, "V", &s->dc_link_voltage_V, note);
    if (status) return status;
    return whole_number(a, SLOTS, 3, HCI_MOST_SLOTS, 3,
                        "count the teeth of the stator (not the magnets), or leave it out", &s->slots, note);
}

/* ---- words ---- */

static void show_constants(const hci_sheet *s)
{
    const double emf = hci_sheet_emf(s->reading, s->strength, s->pole_pairs);
    cli_say("  pole pairs   %d (%d magnets)\n", s->pole_pairs, 2 * s->pole_pairs);
    cli_say("  back-EMF     %.5g V·s/rad, peak of a phase, from %g %s read as %s\n", emf, s->strength,
            hci_sheet_unit(s->reading), hci_sheet_meaning(s->reading));
    cli_say("  which is, to compare with the sheet (if one of them differs by 1.41 or 1.73, the "
            "reading is another):\n");
    for (int reading = 0; reading <= (int)HCI_SHEET_FLUX; ++reading)
        cli_say("    %10.5g %-7s %s\n", hci_sheet_value((hci_sheet_reading)reading, emf, s->pole_pairs),
                hci_sheet_unit((hci_sheet_reading)reading), hci_sheet_meaning((hci_sheet_reading)reading));
}

static void show_next(const hci_sheet *s, const char *folder)
{
    const int p = s->pole_pairs;
    cli_say("next\n"
            "  open the tables: what is missing stands there, with how to measure it\n"
            "  harmonics, which make the ripple, are in no data sheet; measure and take them over:\n");
    cli_say("    hci-solve harmonics RUN --quantity back_emf --pole-pairs %d -o %s\n", p, folder);
    cli_say("    hci-solve harmonics RUN --quantity cogging --pole-pairs %d -o %s\n", p, folder);
    cli_say("  currents for the torque you want:\n"
            "    hci-solve solve %s --target FILE --auto -o OUT\n",
            folder);
    cli_say("  when the bench disagrees:\n"
            "    hci-solve diagnose %s --runs LIST -o OUT\n",
            folder);
}

static void show(const hci_sheet *s, const char *folder)
{
    hci_note remark;
    cli_say(CLI_GOOD "machine" CLI_PLAIN ": %s: machine.csv, back_emf.csv%s\n", folder,
            s->slots > 0 ? ", cogging.csv" : "");
    hci_sheet_remark(s, &remark);
    cli_remark(&remark);
    show_constants(s);
    if (s->slots > 0)
        cli_say("  cogging      first at order %d (%d in a mechanical turn); amplitudes 0 until measured\n",
                hci_cogging_order(s->slots, s->pole_pairs),
                s->pole_pairs * hci_cogging_order(s->slots, s->pole_pairs));
    show_next(s, folder);
}

static int run(const cli_arguments *a)
{
    const char *folder = a->value[OUT] ? a->value[OUT] : a->word[0];
    hci_note note = {{0}};
    hci_sheet sheet;
    hci_status status = read_sheet(a, &sheet, &note);
    if (!status) status = hci_init_write(folder, &sheet, &note);
    if (status) return cli_fail(status, &note);
    if (cli_is_wordy()) show(&sheet, folder);
    if (a->given[JSON]) {
        char *json = hci_init_json(&sheet);
        if (!json)
            return cli_fail(hci_note_set(&note, HCI_ERROR_MEMORY, "out of memory for the summary"), &note);
        puts(json);
        hci_text_free(json);
    }
    return 0;
}

const cli_command cli_init = {
    "init",
    "NAME",
    "Writes a first machine folder from the values of a data sheet.\n"
    "Needs the pole pairs, and one of --kv, --volt-per-krpm, --torque-constant, --flux.",
    OPTIONS,
    1,
    "  hci-solve init mn4004 --poles 24 --kv 300 --slots 18 -o out/mn4004\n"
    "  hci-solve solve out/mn4004 --target data/scenarios/02/target.csv --auto -o out/mn4004_currents\n"
    "  hci-solve init servo --pole-pairs 4 --volt-per-krpm 98 --resistance 1.9 --resistance-of line -o "
    "out/servo\n"
    "\nExit codes: 0 done; " CLI_EXIT_ERRORS,
    run};
