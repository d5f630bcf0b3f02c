/* The tables of a first machine folder, from the values of a data sheet. */
#define _POSIX_C_SOURCE 200809L

#include "hci/host/machine/init.h"

#include <math.h>
#include <stdio.h>
#include <string.h>
#include <sys/stat.h>

#include "hci/host/base/number.h"
#include "hci/host/base/output.h"
#include "hci/math/harmonic.h"
#include "host/base/quote.h"
#include "host/machine/saliency.h"

#define MOST_FOLDER 4096

enum { MOST_POLE_PAIRS = 1000, COGGING_ORDERS = 3 };

static double emf(const hci_sheet *s)
{
    return hci_sheet_emf(s->reading, s->strength, s->pole_pairs);
}

/* ---- tables ---- */

/* A text in a cell or a comment: control characters and bytes that are not UTF-8 would break the table. */
static void write_name(hci_output *out, const char *name)
{
    char shown[HCI_QUOTE_SIZE];
    hci_output_text(out, "%s", hci_quote(name, shown));
}

/* A row of machine.csv, and where its value comes from. */
typedef struct {
    const char *name, *unit;
    double value;        /* of the table; NAN: the sheet does not say */
    double sheet;        /* as the sheet says it, in the same unit */
    const char *reading; /* what the sheet's value is of */
    const char *how;     /* to come to a value that is missing */
} sheet_row;

/* A row, or the comment that tells how to come to one. */
static void write_row(hci_output *out, const sheet_row *row)
{
    char text[32];
    if (isnan(row->value)) {
        hci_output_text(out, "# %s,,%s,  %s\n", row->name, row->unit, row->how);
        return;
    }
    hci_output_text(out, "%s,", row->name);
    hci_output_number(out, row->value, ',');
    hci_number_text(row->sheet, text);
    hci_output_text(out, "%s,\"data sheet: %s %s%s\"\n", row->unit, text, row->unit, row->reading);
}

static void write_rows(hci_output *out, const sheet_row *rows, size_t count)
{
    for (size_t k = 0; k < count; ++k)
        write_row(out, &rows[k]);
}

static void write_winding(hci_output *out, const hci_sheet *s)
{
    const sheet_row rows[] = {
        {"resistance", "ohm", hci_sheet_resistance_ohm(s), s->resistance_ohm,
         s->resistance_of_line ? " between two terminals; halved" : " of a phase",
         "send a dc current through two terminals: half of volt / ampere"},
        {"inductance_d", "H", s->inductance_d_H, s->inductance_d_H, " of a phase",
         "LCR meter on two terminals at 1 kHz at many rotor angles: half the smallest reading"},
        {"inductance_q", "H", s->inductance_q_H, s->inductance_q_H, " of a phase",
         "the same: half the largest reading; equal to inductance_d with surface magnets"},
    };
    hci_output_text(
        out, "#\n# Winding, of one phase to the star point. For copper loss, voltage and `simulate`.\n");
    write_rows(out, rows, sizeof rows / sizeof *rows);
}

static void write_ratings(hci_output *out, const hci_sheet *s)
{
    const sheet_row rows[] = {
        {"rated_current", "A", hci_sheet_current_A(s), s->rated_current_A,
         s->rated_current_is_rms ? " rms; times sqrt(2)" : " peak",
         "peak of the current that it stands for long; sheets often give rms: times sqrt(2)"},
        {"rated_torque", "Nm", s->rated_torque_Nm, s->rated_torque_Nm, "", "on the shaft"},
        {"rated_speed", "rpm", s->rated_speed_rpm, s->rated_speed_rpm, "", "mechanical"},
        {"dc_link_voltage", "V", s->dc_link_voltage_V, s->dc_link_voltage_V, "",
         "battery or supply of the inverter"},
    };
    hci_output_text(out, "#\n# Ratings. rated_current is the peak of the phase current.\n");
    write_rows(out, rows, sizeof rows / sizeof *rows);
}

static void write_shaft(hci_output *out, const hci_sheet *s)
{
    const sheet_row inertia = {
        "inertia",       "kgm2", s->inertia_kgm2,
        s->inertia_kgm2, "",     "with a known torque: torque / acceleration; 1 g cm2 is 1e-7 kgm2"};
    hci_output_text(out, "#\n# Shaft, for `simulate`.\n");
    write_row(out, &inertia);
    hci_output_text(out, "# viscous_friction,,Nms_per_rad,  slope of the torque without load over the speed\n"
                         "# coulomb_friction,,Nm,  its value at very low speed\n");
}

static hci_status write_machine(hci_output *out, const hci_sheet *s, hci_note *note)
{
    const hci_status status = hci_output_file(out, "machine.csv", note);
    if (status) return status;
    hci_output_text(out, "# Machine ");
    write_name(out, s->name);
    hci_output_text(
        out,
        ", from its data sheet. A line that begins with # is not read: to give a value that is\n"
        "# missing, take the # away and write the number after the first comma.\n"
        "name,value,unit,source\n"
        "# Pole pairs: half the number of magnets around the rotor.\n"
        "pole_pairs,%d,1,\"data sheet: %d poles\"\n"
        "# star or star-neutral (the star point is connected). A delta winding is written as the star\n"
        "# that behaves alike at the terminals, as values between two terminals give it.\n"
        "connection,star,,assumed\n",
        s->pole_pairs, 2 * s->pole_pairs);
    if (s->slots > 0)
        hci_output_text(out, "slots,%d,1,\"data sheet: teeth of the stator\"\n", s->slots);
    else
        hci_output_text(out, "# slots,,1,  teeth of the stator; `check` asks the cogging orders for them\n");
    write_winding(out, s);
    write_ratings(out, s);
    write_shaft(out, s);
    return HCI_OK;
}

static hci_status write_emf(hci_output *out, const hci_sheet *s, hci_note *note)
{
    const hci_status status = hci_output_file(out, "back_emf.csv", note);
    char text[32];
    if (status) return status;
    hci_number_text(s->strength, text);
    hci_output_text(out, "# Back-EMF of machine ");
    write_name(out, s->name);
    hci_output_text(
        out,
        ": peak of a phase to the star point, divided by the mechanical\n"
        "# speed: V s/rad, which is N m/A. A sine of 1 A peak in all phases makes 3/2 of it in N m.\n"
        "# Order 1 from the data sheet: %s %s, read as %s.\n"
        "# A sheet does not tell the harmonics (electrical orders 5, 7, 11, 13, ...), which make the\n"
        "# torque ripple under load. To measure them turn the shaft with another motor, terminals open,\n"
        "# record the three voltages, and let `hci-solve harmonics RUN --quantity back_emf` write this "
        "file.\n"
        "order,amplitude_Nm_per_A,phase_rad\n1,",
        text, hci_sheet_unit(s->reading), hci_sheet_meaning(s->reading));
    hci_output_number(out, emf(s), ',');
    hci_output_text(out, "0\n");
    return HCI_OK;
}

static hci_status write_cogging(hci_output *out, const hci_sheet *s, hci_note *note)
{
    const int first = hci_cogging_order(s->slots, s->pole_pairs);
    const hci_status status = hci_output_file(out, "cogging.csv", note);
    if (status) return status;
    hci_output_text(out, "# Cogging torque of machine ");
    write_name(out, s->name);
    hci_output_text(
        out,
        ": the orders are known from %d slots and %d poles, the amplitudes are not.\n"
        "# The first is lcm(slots, poles)/pole pairs = %d periods in an electrical turn (%d in a mechanical "
        "one).\n"
        "# To measure them turn the shaft slowly without current, record angle and torque (or the holding "
        "current\n"
        "# of a position loop), and let `hci-solve harmonics RUN --quantity cogging` write this file.\n"
        "# Uneven magnets and slots add other orders, at multiples of 1/pole pairs; the measurement shows "
        "them.\n"
        "order,amplitude_Nm,phase_rad\n",
        s->slots, 2 * s->pole_pairs, first, first * s->pole_pairs);
    for (int k = 1; k <= COGGING_ORDERS && k * first <= (int)HCI_MOST_ORDER; ++k)
        hci_output_text(out, "%d,0,0\n", k * first);
    return HCI_OK;
}

bool hci_sheet_is_salient(const hci_sheet *s)
{
    return hci_is_salient(s->inductance_d_H, s->inductance_q_H);
}

static hci_status write_inductance(hci_output *out, const hci_sheet *s, hci_note *note)
{
    const hci_status status = hci_output_file(out, "inductance.csv", note);
    if (status) return status;
    hci_output_text(out, "# Inductances of machine ");
    write_name(out, s->name);
    hci_output_text(out, ", of L_d and L_q of the data sheet alone: what makes it a machine with\n"
                         "# interior magnets, whose torque has 3/2 p (L_d - L_q) i_d i_q beside that of the "
                         "magnets. The harmonics of\n"
                         "# the inductances, which make the reluctance torque ripple, are in no data sheet: "
                         "an LCR meter at many\n"
                         "# rotor angles, or finite elements, give them. L_d and L_q do not tell the "
                         "inductance of a current through\n"
                         "# the star point, which is 0 here and does not matter with `connection,star`.\n");
    hci_saliency_write_rows(out, s->inductance_d_H, s->inductance_q_H);
    return HCI_OK;
}

/* ---- into a folder ---- */

static bool not_below(double value, double least)
{
    return isnan(value) || (isfinite(value) && value >= least);
}

/* The first value of a sheet that cannot be, NULL where all can. */
static const char *wrong_value(const hci_sheet *s)
{
    if (s->pole_pairs < 1 || s->pole_pairs > MOST_POLE_PAIRS) return "pole_pairs";
    if (s->slots < 0 || s->slots > HCI_MOST_SLOTS) return "slots";
    if (!(s->strength > 0.0 && isfinite(s->strength))) return "strength";
    const struct {
        const char *name;
        double value;
    } rest[] = {{"resistance", s->resistance_ohm},     {"inductance_d", s->inductance_d_H},
                {"inductance_q", s->inductance_q_H},   {"inertia", s->inertia_kgm2},
                {"rated_current", s->rated_current_A}, {"rated_torque", s->rated_torque_Nm},
                {"rated_speed", s->rated_speed_rpm},   {"dc_link_voltage", s->dc_link_voltage_V}};
    for (size_t k = 0; k < sizeof rest / sizeof *rest; ++k)
        if (!not_below(rest[k].value, 0.0)) return rest[k].name;
    return NULL;
}

static hci_status check_sheet(const hci_sheet *s, hci_note *note)
{
    const char *wrong = wrong_value(s);
    if (wrong)
        return hci_note_set(note, HCI_ERROR_ARGUMENT,
                            "%s: found a value that is negative, not finite or out of its range; "
                            "take it from the data sheet again",
                            wrong);
    if (emf(s) >= 1e-9 && emf(s) <= 1e6) return HCI_OK;
    return hci_note_set(
        note, HCI_ERROR_ARGUMENT,
        "%g %s (%s): found a back-EMF of %.3g V·s/rad, expected 1e-9 to 1e6; check the value and "
        "its unit",
        s->strength, hci_sheet_unit(s->reading), hci_sheet_meaning(s->reading), emf(s));
}

/* Tables that are there are somebody's work, and inductance.csv or effects.csv would change what this machine
 * is. */
static hci_status nothing_there(const char *folder, hci_note *note)
{
    static const char *const TABLES[] = {"machine.csv", "back_emf.csv", "cogging.csv", "inductance.csv",
                                         "effects.csv"};
    char path[MOST_FOLDER], shown[HCI_QUOTE_PATH_SIZE];
    struct stat info;
    for (size_t k = 0; k < sizeof TABLES / sizeof *TABLES; ++k) {
        const int length = snprintf(path, sizeof path, "%s/%s", folder, TABLES[k]);
        if (length < 0 || length >= MOST_FOLDER)
            return hci_note_set(note, HCI_ERROR_OUTPUT, "%.200s…: the path is too long", folder);
        if (lstat(path, &info) != 0) continue;
        return hci_note_set(
            note, HCI_ERROR_OUTPUT,
            "%s: is there already, and nothing is overwritten; name another folder, or move it away",
            hci_quote_path(path, shown));
    }
    return HCI_OK;
}

hci_status hci_init_write(const char *folder, const hci_sheet *sheet, hci_note *note)
{
    hci_output *out = NULL;
    hci_status status = check_sheet(sheet, note);
    if (!status) status = nothing_there(folder, note);
    if (!status) status = hci_output_open(folder, &out, note);
    if (!status) status = write_machine(out, sheet, note);
    if (!status) status = write_emf(out, sheet, note);
    if (!status && sheet->slots > 0) status = write_cogging(out, sheet, note);
    if (!status && hci_sheet_is_salient(sheet)) status = write_inductance(out, sheet, note);
    if (!status) return hci_output_commit(out, note);
    hci_output_discard(out);
    return status;
}
