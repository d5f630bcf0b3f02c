/* SimpleFOC (Arduino-FOC): feed_forward_current.d and .q in A, which loopFOC adds, from a table of floats
 * over electrical_angle. That is 0 with the magnet on the axis of phase a, 180° from here. The arithmetic is
 * the single precision of the emitted function. */
#include <math.h>
#include <string.h>

#include "host/foreign/code.h"
#include "host/foreign/text.h"

#define MARK "SimpleFOC: i_d and i_q over the electrical angle."

static void fit(hci_foreign_map *map)
{
    for (size_t k = 0; k < map->points * map->columns; ++k)
        map->value[k] = (double)(float)map->value[k];
}

static void at(const hci_foreign_map *map, double turn, double own_q_A, double add[2])
{
    const float position = (float)turn * (float)map->points, own = (float)own_q_A;
    size_t left = (size_t)position;
    if (left >= map->points) left = map->points - 1;
    const float share = position - (float)left;
    const double *a = map->value + 4 * left, *b = map->value + 4 * ((left + 1) % map->points);
    float v[4];
    for (int c = 0; c < 4; ++c)
        v[c] = (float)a[c] + share * ((float)b[c] - (float)a[c]);
    add[0] = (double)(v[0] + own * v[2]);
    add[1] = (double)(v[1] + own * v[3]);
}

static void write_value(const hci_foreign_map *map, size_t row, size_t column, hci_output *output)
{
    char text[32];
    hci_foreign_float(map->value[4 * row + column], text);
    hci_output_text(output, "%s%sf", text, strpbrk(text, ".e") ? "" : ".0");
}

static void write_table(const hci_foreign_map *map, const hci_foreign_files *files, hci_output *output)
{
    const size_t columns = hci_foreign_code_columns(map);
    const char *name = files->name;
    hci_output_text(output,
                    "#ifndef HCI_MAP_%s\n#define HCI_MAP_%s\n\n#include <math.h>\n\n"
                    "#if defined(__AVR__)\n#include <avr/pgmspace.h>\n#define HCI_MAP_%s_IN PROGMEM\n"
                    "#define HCI_MAP_%s_AT(x) pgm_read_float(&(x))\n#else\n#define HCI_MAP_%s_IN\n"
                    "#define HCI_MAP_%s_AT(x) (x)\n#endif\n\n",
                    name, name, name, name, name, name);
    hci_output_text(output, "// i_d, i_q in A%s\nstatic const float %s_table[%zu][%zu] HCI_MAP_%s_IN = {\n",
                    columns == 4 ? "; for each A of current_sp: i_d, i_q" : "", name, map->points, columns,
                    name);
    hci_foreign_write_rows(map, write_value, output);
    hci_output_text(output, "};\n\n");
}

static void write_function(const hci_foreign_map *map, const hci_foreign_files *files, hci_output *output)
{
    const size_t columns = hci_foreign_code_columns(map);
    const char *name = files->name;
    hci_output_text(
        output,
        "// Between move() and loopFOC(), each time: move() has set current_sp, and loopFOC() adds to it.\n"
        "// lead_s: delay of the current, for higher speeds.\n"
        "template <class Motor> void %s_feed(Motor &motor, float lead_s = 0.0f)\n{\n"
        "    const float turns = (motor.electrical_angle + lead_s * motor.pole_pairs * "
        "motor.shaft_velocity) / 6.28318531f;\n"
        "    const float position = (turns - floorf(turns)) * %zu;\n"
        "    unsigned left = (unsigned)position;\n    if (left > %zu) left = %zu;\n"
        "    const unsigned right = (left + 1) %% %zu;\n    const float share = position - left;\n",
        name, map->points, map->points - 1, map->points - 1, map->points);
    hci_output_text(output,
                    "    float value[%zu];\n    for (unsigned k = 0; k < %zu; ++k) {\n"
                    "        const float a = HCI_MAP_%s_AT(%s_table[left][k]), b = "
                    "HCI_MAP_%s_AT(%s_table[right][k]);\n"
                    "        value[k] = a + share * (b - a);\n    }\n",
                    columns, columns, name, name, name, name);
    hci_output_text(
        output, columns == 4 ? "    // loopFOC() limits current_sp before it adds\n"
                               "    const float most = motor.current_limit, asked = motor.current_sp;\n"
                               "    const float own = asked > most ? most : asked < -most ? -most : asked;\n"
                               "    motor.feed_forward_current.d = value[0] + own * value[2];\n"
                               "    motor.feed_forward_current.q = value[1] + own * value[3];\n"
                             : "    motor.feed_forward_current.d = value[0];\n"
                               "    motor.feed_forward_current.q = value[1];\n");
    hci_output_text(output, "}\n\n#endif\n");
}

static void write_header(const hci_foreign_map *map, const hci_foreign_files *files, hci_output *output)
{
    hci_foreign_write_head(map, files, "//", MARK, output);
    hci_output_text(output, "// SPDX-License-Identifier: MIT\n");
    write_table(map, files, output);
    write_function(map, files, output);
}

static bool recognises(const char *text)
{
    return strstr(text, MARK) != NULL;
}

static hci_status read(const char *path, const char *text, hci_foreign_map *map, hci_note *note)
{
    const hci_status status = hci_foreign_read_rows(path, text, map, note);
    if (!status) fit(map);
    return status;
}

const hci_foreign_type hci_foreign_simplefoc = {
    .word = "simplefoc",
    .carries = "i_d and i_q over the electrical turn, for one torque, with --per-torque for any",
    .lacks = "what differs from one electrical turn to the next, and the zero sequence",
    .samples = "a table of floats, straight lines between its rows",
    .kind = HCI_FOREIGN_DQ,
    .is_electrical = true,
    .zero_deg = 180.0,
    .default_points = 256,
    .file = {"h"},
    .fit = fit,
    .at = at,
    .write = {write_header},
    .recognises = recognises,
    .read = read,
};
