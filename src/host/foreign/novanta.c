/* Novanta (Ingenia) servo drives: a table of 512 floats in A over the electrical angle, whose index is part
 * of the turn. What is between two values is not documented: taken is that there is nothing, and values are
 * those at the middle of their part, which are right for straight lines between the middles too. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "host/base/quote.h"
#include "host/foreign/text.h"

enum { POINTS = 512 };

#define HEADER "COGGING_COMP_TABLE_INDEX,COGGING_COMP_TABLE_VALUE"

static void fit(hci_foreign_map *map)
{
    for (size_t k = 0; k < map->points; ++k)
        map->value[k] = (double)(float)map->value[k];
}

static void at(const hci_foreign_map *map, double turn, double own_q_A, double add[2])
{
    (void)own_q_A;
    add[0] = 0.0;
    add[1] = map->value[hci_foreign_index(map, turn)];
}

static void write_table(const hci_foreign_map *map, const hci_foreign_files *files, hci_output *output)
{
    char text[32];
    hci_foreign_write_head(map, files, "#",
                           "Novanta: current in A over the electrical angle, registers 0x2307 and 0x2308.",
                           output);
    hci_output_text(output, HEADER "\n");
    for (size_t k = 0; k < map->points; ++k)
        hci_output_text(output, "%zu,%s\n", k, hci_foreign_float(map->value[k], text));
}

/* The script that puts the file into a drive: three times the name, what it reads and how it connects, what
 * it does. */
static const char SCRIPT_HEAD[] =
    "#!/usr/bin/env python3\n"
    "\"\"\"Puts %s.csv, which stands beside this file, into a drive. Without --store nothing is sent.\n"
    "\n"
    "    %s_upload.py --interface IF --dictionary FILE [--slave N] [--axis N] (--store | --read FILE)\n"
    "\n"
    "--store and --read need the Python package ingenialink and EtherCAT. --store writes the table and "
    "does not\n"
    "switch it on: that is register 0x2306, and to keep it is `store all` of the drive. --read writes "
    "the table\n"
    "that is in the drive.\n"
    "\"\"\"\n"
    "import argparse\n"
    "import os\n"
    "\n"
    "HERE = os.path.dirname(os.path.abspath(__file__))\n"
    "NAME = \"%s.csv\"\n"
    "\n\n";

/* Rows of the file, a connection, the arguments. */
static const char SCRIPT_FUNCTIONS[] =
    "def rows():\n"
    "    with open(os.path.join(HERE, NAME), encoding=\"utf-8\") as file:\n"
    "        lines = [line for line in file if not line.startswith(\"#\")][1:]\n"
    "    return [(int(k), float(value)) for k, value in (line.split(\",\") for line in lines)]\n"
    "\n\n"
    "def connect(a):\n"
    "    try:\n"
    "        from ingenialink.ethercat.network import EthercatNetwork\n"
    "    except ImportError as missing:\n"
    "        raise SystemExit(f\"ingenialink is not there ({missing}); pip install ingenialink, then "
    "again\")\n"
    "    return EthercatNetwork(a.interface).connect_to_slave(a.slave, a.dictionary)\n"
    "\n\n"
    "parser = argparse.ArgumentParser()\n"
    "parser.add_argument(\"--interface\")\n"
    "parser.add_argument(\"--dictionary\")\n"
    "parser.add_argument(\"--slave\", type=int, default=1)\n"
    "parser.add_argument(\"--axis\", type=int, default=1)\n"
    "parser.add_argument(\"--store\", action=\"store_true\")\n"
    "parser.add_argument(\"--read\")\n"
    "arguments = parser.parse_args()\n";

/* Writing, reading back, or telling. */
static const char SCRIPT_WORK[] =
    "INDEX, VALUE = \"COGGING_COMP_TABLE_INDEX\", \"COGGING_COMP_TABLE_VALUE\"\n"
    "if arguments.store:\n"
    "    servo = connect(arguments)\n"
    "    for k, value in rows():\n"
    "        servo.write(INDEX, k, arguments.axis)\n"
    "        servo.write(VALUE, value, arguments.axis)\n"
    "    print(f\"{len(rows())} values written\")\n"
    "elif arguments.read:\n"
    "    servo = connect(arguments)\n"
    "    with open(arguments.read, \"w\", encoding=\"utf-8\") as file:\n"
    "        file.write(INDEX + \",\" + VALUE + \"\\n\")\n"
    "        for k, _ in rows():\n"
    "            servo.write(INDEX, k, arguments.axis)\n"
    "            file.write(f\"{k},{servo.read(VALUE, arguments.axis):.9g}\\n\")\n"
    "else:\n"
    "    for k, value in rows():\n"
    "        print(f\"{INDEX} = {k}, {VALUE} = {value:.9g}\")\n"
    "    print(f\"nothing was sent: --store writes these {len(rows())} values\")\n";

static void write_script(const hci_foreign_map *map, const hci_foreign_files *files, hci_output *output)
{
    (void)map;
    hci_output_text(output, SCRIPT_HEAD, files->name, files->name, files->name);
    hci_output_text(output, "%s%s", SCRIPT_FUNCTIONS, SCRIPT_WORK);
}

static bool recognises(const char *text)
{
    return strstr(text, HEADER "\n") != NULL || strstr(text, HEADER "\r") != NULL;
}

static hci_status wrong(const char *path, const char *line, hci_note *note)
{
    char shown[HCI_QUOTE_PATH_SIZE], found[HCI_QUOTE_SIZE], first[64];
    snprintf(first, sizeof first, "%.*s", (int)strcspn(line, "\r\n"), line);
    return hci_note_set(note, HCI_ERROR_INPUT,
                        "%s: found %s, expected the indices 0 to 511 in their order, each with a value in A; "
                        "read all of the table out of the drive",
                        hci_quote_path(path, shown), hci_quote(first, found));
}

static hci_status read(const char *path, const char *text, hci_foreign_map *map, hci_note *note)
{
    const char *line = strstr(text, HEADER) + strlen(HEADER);
    hci_status status = hci_foreign_map_points(map, POINTS, note);
    for (size_t k = 0; !status && k < POINTS; ++k) {
        double index;
        const char *end;
        line += strspn(line, "\r\n");
        if (!hci_foreign_number(line, &end, &index) || index != (double)k || *end != ',' ||
            !hci_foreign_number(end + 1, &end, &map->value[k]))
            return wrong(path, line, note);
        map->value[k] = (double)(float)map->value[k];
        line = end;
    }
    line += strspn(line, " \t\r\n");
    return !status && *line != '\0' ? wrong(path, line, note) : status;
}

const hci_foreign_type hci_foreign_novanta = {
    .word = "novanta",
    .carries = "i_q over the electrical turn, added whatever the torque",
    .lacks = "i_d, what depends on the torque, and what differs from one electrical turn to the next",
    .samples = "512 floats, each for its part of the turn",
    .kind = HCI_FOREIGN_Q,
    .is_electrical = true,
    .zero_deg = 180.0,
    .points = POINTS,
    .in_middle = true,
    .file = {"csv", "_upload.py"},
    .fit = fit,
    .at = at,
    .write = {write_table, write_script},
    .recognises = recognises,
    .read = read,
};
