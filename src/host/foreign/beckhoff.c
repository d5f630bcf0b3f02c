/* Beckhoff AX8000 and AMP8000: object 0x32CB (channel A), ten coefficients n, phi, r: torque harmonics of the
 * mechanical turn. Whether r goes with a sine or a cosine, and the sign of phi, is not documented: the wave
 * says what is taken. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "hci/math/harmonic.h"
#include "host/base/quote.h"
#include "host/foreign/text.h"

enum { COEFFICIENTS = 10, FIRST = 7, USE_STARTUP_LIST = 3 };

#define OBJECT "0x32CB"
#define HEADER "index,subindex,type,value,name"

static double degrees(const hci_foreign_map *map, const hci_foreign_term *t)
{
    return (double)(float)(hci_foreign_phase_in_file(map, t->phase_rad) * 180.0 / HCI_PI);
}

/* Single precision, as the objects are. */
static void fit(hci_foreign_map *map)
{
    for (size_t k = 0; k < map->terms; ++k) {
        hci_foreign_term *t = &map->term[k];
        t->amplitude = (double)(float)t->amplitude;
        t->phase_rad = hci_foreign_phase_of_file(map, degrees(map, t) * HCI_PI / 180.0);
    }
}

static void at(const hci_foreign_map *map, double turn, double own_q_A, double add[2])
{
    (void)own_q_A;
    add[0] = 0.0;
    add[1] = hci_foreign_sum(map, turn);
}

static void write_value(hci_output *output, unsigned subindex, const char *type, double value,
                        const char *name)
{
    char text[32];
    hci_output_text(output, OBJECT ",0x%02X,%s,%s,%s\n", subindex, type, hci_foreign_float(value, text),
                    name);
}

static void write_list(const hci_foreign_map *map, const hci_foreign_files *files, hci_output *output)
{
    hci_foreign_write_head(
        map, files, "#", "Beckhoff AX8000: cogging compensation, object 0x32CB (channel B: 0x36CB).", output);
    hci_output_text(output, HEADER "\n");
    write_value(output, 1, "INT16", USE_STARTUP_LIST, "Cogging compensation control");
    write_value(output, 2, "REAL32", 1.0, "Cogging compensation gain");
    for (unsigned k = 0; k < COEFFICIENTS; ++k) {
        static const hci_foreign_term NONE = {0.0, 0.0, 0.0};
        const hci_foreign_term *t = k < map->terms ? &map->term[k] : &NONE;
        char name[64];
        const unsigned at_n = FIRST + 3 * k;
        snprintf(name, sizeof name, "Cogging compensation Coef %u n", k);
        write_value(output, at_n, "UINT32", t->order, name);
        snprintf(name, sizeof name, "Cogging compensation Coef %u phi", k);
        write_value(output, at_n + 1, "REAL32", t == &NONE ? 0.0 : degrees(map, t), name);
        snprintf(name, sizeof name, "Cogging compensation Coef %u r", k);
        write_value(output, at_n + 2, "REAL32", t->amplitude, name);
    }
}

/* The script that puts the file into a drive: three times the name. */
static const char SCRIPT_HEAD[] =
    "#!/usr/bin/env python3\n"
    "\"\"\"Puts %s.csv, which stands beside this file, into a drive. Without --store nothing is sent.\n"
    "\n"
    "    %s_upload.py --net-id ID_OF_THE_MASTER --address ETHERCAT_ADDRESS [--channel A|B] [--store]\n"
    "\n"
    "--store needs the Python package pyads and a route to TwinCAT. The values last until the drive is "
    "switched\n"
    "off; to keep them, put them into its startup list.\n"
    "\"\"\"\n"
    "import argparse\n"
    "import os\n"
    "import struct\n"
    "\n"
    "HERE = os.path.dirname(os.path.abspath(__file__))\n"
    "NAME = \"%s.csv\"\n"
    "FORM = {\"INT16\": \"<h\", \"UINT32\": \"<I\", \"REAL32\": \"<f\"}\n"
    "\n\n";

/* Values of the file, and the arguments. */
static const char SCRIPT_FUNCTIONS[] =
    "def values(channel):\n"
    "    with open(os.path.join(HERE, NAME), encoding=\"utf-8\") as file:\n"
    "        lines = [line.strip() for line in file if not line.startswith(\"#\")][1:]\n"
    "    for line in lines:\n"
    "        index, sub, form, value, name = line.split(\",\")\n"
    "        number = float(value) if form == \"REAL32\" else int(value)\n"
    "        yield int(index, 16) + (0x400 if channel == \"B\" else 0), int(sub, 16), form, number, "
    "name\n"
    "\n\n"
    "parser = argparse.ArgumentParser()\n"
    "parser.add_argument(\"--net-id\")\n"
    "parser.add_argument(\"--address\", type=int, default=1001)\n"
    "parser.add_argument(\"--channel\", choices=[\"A\", \"B\"], default=\"A\")\n"
    "parser.add_argument(\"--store\", action=\"store_true\")\n"
    "arguments = parser.parse_args()\n";

/* Writing, or telling. */
static const char SCRIPT_WORK[] =
    "if arguments.store:\n"
    "    try:\n"
    "        import pyads\n"
    "    except ImportError as missing:\n"
    "        raise SystemExit(f\"pyads is not there ({missing}); pip install pyads, then again\")\n"
    "    drive = pyads.Connection(arguments.net_id, arguments.address)\n"
    "    with drive:\n"
    "        for index, sub, form, value, _ in values(arguments.channel):\n"
    "            data = list(struct.pack(FORM[form], value))\n"
    "            drive.write(0xF302, index << 16 | sub, data, pyads.PLCTYPE_BYTE * len(data))\n"
    "    print(\"written\")\n"
    "else:\n"
    "    for index, sub, form, value, name in values(arguments.channel):\n"
    "        print(f\"{index:#06x}:{sub:02x} {form} {value} {name}\")\n"
    "    print(\"nothing was sent: --store writes these values\")\n";

static void write_script(const hci_foreign_map *map, const hci_foreign_files *files, hci_output *output)
{
    (void)map;
    hci_output_text(output, SCRIPT_HEAD, files->name, files->name, files->name);
    hci_output_text(output, "%s%s", SCRIPT_FUNCTIONS, SCRIPT_WORK);
}

static bool recognises(const char *text)
{
    return strstr(text, HEADER) != NULL && (strstr(text, OBJECT) != NULL || strstr(text, "0x36CB") != NULL);
}

/* The value of a subindex; false: it is not there. */
static bool find_value(const char *text, unsigned subindex, double *value)
{
    char start[32];
    const char *end;
    snprintf(start, sizeof start, "CB,0x%02X,", subindex);
    const char *cell = strstr(text, start);
    if (cell != NULL) cell = strchr(cell + strlen(start), ',');
    return cell != NULL && hci_foreign_number(cell + 1, &end, value);
}

static hci_status wrong(const char *path, unsigned subindex, const char *found, hci_note *note)
{
    char shown[HCI_QUOTE_PATH_SIZE];
    return hci_note_set(
        note, HCI_ERROR_INPUT,
        "%s: found %s at " OBJECT ":%02X, expected a row for each of 02 and 07 to 24, n a whole "
        "number from 0 to 200, phi 0 to 360, r not below 0; write the values of the drive into it",
        hci_quote_path(path, shown), found, subindex);
}

static hci_status read_term(const char *path, const char *text, unsigned k, double gain, hci_foreign_map *map,
                            hci_note *note)
{
    double v[3] = {0.0, 0.0, 0.0};
    const double most[3] = {200.0, 360.0, HUGE_VAL};
    for (unsigned part = 0; part < 3; ++part) {
        const unsigned subindex = FIRST + 3 * k + part;
        char found[48];
        if (!find_value(text, subindex, &v[part])) return wrong(path, subindex, "no value", note);
        snprintf(found, sizeof found, "%g", v[part]);
        if (!(v[part] >= 0.0 && v[part] <= most[part]) || (part == 0 && floor(v[0]) != v[0]))
            return wrong(path, subindex, found, note);
    }
    if (v[2] == 0.0 || v[0] == 0.0) return HCI_OK;
    map->term[map->terms++] =
        (hci_foreign_term){v[0], gain * (double)(float)v[2],
                           hci_foreign_phase_of_file(map, (double)(float)v[1] * HCI_PI / 180.0)};
    return HCI_OK;
}

static hci_status read(const char *path, const char *text, hci_foreign_map *map, hci_note *note)
{
    double gain;
    if (!find_value(text, 2, &gain)) return wrong(path, 2, "no value", note);
    hci_status status = HCI_OK;
    for (unsigned k = 0; !status && k < COEFFICIENTS; ++k)
        status = read_term(path, text, k, gain, map, note);
    return status;
}

const hci_foreign_type hci_foreign_beckhoff = {
    .word = "beckhoff",
    .carries = "torque over the mechanical turn, added whatever the torque",
    .lacks = "i_d, what depends on the torque, and orders above 200",
    .samples = "10 harmonics of single precision",
    .kind = HCI_FOREIGN_TORQUE,
    .has_wave = true,
    .most_terms = COEFFICIENTS,
    .most_order = 200.0,
    .file = {"csv", "_upload.py"},
    .fit = fit,
    .at = at,
    .write = {write_list, write_script},
    .recognises = recognises,
    .read = read,
};
