/* moteus (mjbots): motor.cogging_dq_comp, 1024 bytes of q current over the turn of the commutation encoder,
 * in units of motor.cogging_dq_scale, straight lines between them, added to i_q behind the limit of the
 * torque. The arithmetic is the single precision of the firmware. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "host/base/quote.h"
#include "host/foreign/text.h"

enum { POINTS = 1024, MOST = 127 };

#define SCALE "motor.cogging_dq_scale"
#define COMP  "motor.cogging_dq_comp."

static void fit(hci_foreign_map *map)
{
    const float unit = (float)(hci_foreign_largest(map, 0) / MOST);
    map->unit = (double)unit;
    for (size_t k = 0; k < POINTS; ++k) {
        double whole = unit > 0.0f ? floor(map->value[k] / (double)unit + 0.5) : 0.0;
        if (fabs(whole) > MOST) whole = copysign(MOST, whole);
        map->value[k] = whole * (double)unit;
    }
}

static int byte_of(const hci_foreign_map *map, size_t k)
{
    return map->unit > 0.0 ? (int)floor(map->value[k] / map->unit + 0.5) : 0;
}

static void at(const hci_foreign_map *map, double turn, double own_q_A, double add[2])
{
    (void)own_q_A;
    const float position = (float)turn, scale = (float)map->unit;
    size_t left = (size_t)((float)POINTS * position);
    if (left > POINTS - 1) left = POINTS - 1;
    const size_t right = (left + 1) % POINTS;
    const float share = (position - (float)left / (float)POINTS) * (float)POINTS;
    const float a = (float)byte_of(map, left) * scale, b = (float)byte_of(map, right) * scale;
    add[0] = 0.0;
    add[1] = (double)((b - a) * share + a);
}

static void write_config(const hci_foreign_map *map, const hci_foreign_files *files, hci_output *output)
{
    char text[32];
    hci_foreign_write_head(map, files, "#", "moteus: q current over the turn of the commutation encoder.",
                           output);
    hci_output_text(output, SCALE " %s\n", hci_foreign_float(map->unit, text));
    for (size_t k = 0; k < POINTS; ++k)
        hci_output_text(output, COMP "%zu %d\n", k, byte_of(map, k));
}

/* The script that puts the file into a controller: three times the name. */
static const char SCRIPT_HEAD[] =
    "#!/usr/bin/env python3\n"
    "\"\"\"Puts %s.cfg, which stands beside this file, into a moteus. Without --store nothing is sent.\n"
    "\n"
    "    %s_upload.py [--target ID] [--store]\n"
    "\n"
    "--store needs the Python package moteus and an adapter that it finds.\n"
    "\"\"\"\n"
    "import argparse\n"
    "import asyncio\n"
    "import os\n"
    "\n"
    "NAME = \"%s.cfg\"\n"
    "\n\n";

/* Commands of the file, and how they are sent. */
static const char SCRIPT_FUNCTIONS[] =
    "def commands():\n"
    "    path = os.path.join(os.path.dirname(os.path.abspath(__file__)), NAME)\n"
    "    with open(path, encoding=\"utf-8\") as file:\n"
    "        lines = [line.split(\"#\")[0].strip() for line in file]\n"
    "    return [\"conf set \" + line for line in lines if line] + [\"conf write\"]\n"
    "\n\n"
    "async def store(target):\n"
    "    try:\n"
    "        import moteus\n"
    "    except ImportError as missing:\n"
    "        raise SystemExit(f\"moteus is not there ({missing}); pip install moteus, then again\")\n"
    "    stream = moteus.Stream(moteus.Controller(id=target))\n"
    "    await stream.write_message(b\"tel stop\")\n"
    "    await stream.flush_read()\n"
    "    await stream.command(b\"d stop\")\n"
    "    for line in commands():\n"
    "        await stream.command(line.encode(\"ascii\"))\n"
    "\n\n";

/* The arguments, sending, or telling. */
static const char SCRIPT_WORK[] =
    "parser = argparse.ArgumentParser()\n"
    "parser.add_argument(\"--target\", \"-t\", type=int, default=1)\n"
    "parser.add_argument(\"--store\", action=\"store_true\")\n"
    "arguments = parser.parse_args()\n"
    "if arguments.store:\n"
    "    asyncio.run(store(arguments.target))\n"
    "    print(f\"{len(commands())} commands sent to controller {arguments.target}\")\n"
    "else:\n"
    "    print(\"\\n\".join(commands()))\n"
    "    print(f\"nothing was sent: --store sends these {len(commands())} commands to controller "
    "{arguments.target}\")\n";

static void write_script(const hci_foreign_map *map, const hci_foreign_files *files, hci_output *output)
{
    (void)map;
    hci_output_text(output, SCRIPT_HEAD, files->name, files->name, files->name);
    hci_output_text(output, "%s%s", SCRIPT_FUNCTIONS, SCRIPT_WORK);
}

static bool recognises(const char *text)
{
    return strstr(text, COMP) != NULL;
}

static hci_status wrong(const char *path, const char *found, hci_note *note)
{
    char shown[HCI_QUOTE_PATH_SIZE];
    return hci_note_set(note, HCI_ERROR_INPUT,
                        "%s: found %s, expected " SCALE " and " COMP "0 to " COMP
                        "1023; save the output of `moteus_tool --dump-config`",
                        hci_quote_path(path, shown), found);
}

/* One line `motor.cogging_dq_comp.K V`, its text behind the last point. */
static hci_status read_line(const char *path, const char *text, bool *seen, hci_foreign_map *map,
                            hci_note *note)
{
    double index, value;
    const char *end;
    char found[80];
    if (!hci_foreign_number(text, &end, &index) || !hci_foreign_number(end, &end, &value))
        return wrong(path, "a line " COMP " without two numbers", note);
    snprintf(found, sizeof found, COMP "%g %g", index, value);
    if (!(index >= 0.0 && index < POINTS && floor(index) == index)) return wrong(path, found, note);
    if (!(value >= -128.0 && value <= 127.0 && floor(value) == value)) return wrong(path, found, note);
    map->value[(size_t)index] = value * map->unit;
    seen[(size_t)index] = true;
    return HCI_OK;
}

static hci_status read(const char *path, const char *text, hci_foreign_map *map, hci_note *note)
{
    bool seen[POINTS] = {false};
    char found[64];
    if (!hci_foreign_said(text, SCALE, &map->unit)) return wrong(path, "no " SCALE, note);
    map->unit = (double)(float)map->unit;
    hci_status status = hci_foreign_map_points(map, POINTS, note);
    for (const char *line = text; !status && (line = strstr(line, COMP)) != NULL; ++line)
        status = read_line(path, line + sizeof COMP - 1, seen, map, note);
    for (size_t k = 0; !status && k < POINTS; ++k) {
        snprintf(found, sizeof found, "no " COMP "%zu", k);
        if (!seen[k]) status = wrong(path, found, note);
    }
    return status;
}

const hci_foreign_type hci_foreign_moteus = {
    .word = "moteus",
    .carries = "i_q over the mechanical turn, added whatever the torque",
    .lacks = "i_d, and what depends on the torque",
    .samples = "1024 whole numbers of 8 bits, straight lines between them",
    .kind = HCI_FOREIGN_Q,
    .points = POINTS,
    .file = {"cfg", "_upload.py"},
    .fit = fit,
    .at = at,
    .write = {write_config, write_script},
    .recognises = recognises,
    .read = read,
};
