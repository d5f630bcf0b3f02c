/* ST's motor control SDK: i_d and i_q are added to Iqdref before the PI controllers, 16-bit digits of the
 * board's scale over its 16-bit electrical angle. Its Clarke transform turns the sign of beta, so that its
 * angle is the one here less 90°. The arithmetic is that of the emitted function. */
#include <math.h>
#include <stdint.h>
#include <string.h>

#include "host/foreign/code.h"
#include "host/foreign/text.h"

#define MARK "ST MCSDK: i_d and i_q over the electrical angle, in digits."

/* 1 for what is added for each digit of i_q. */
enum { ONE = 8192, MOST = 32767 };

static double scale_of(const hci_foreign_map *map, size_t column)
{
    return column < 2 ? map->counts_per_A : (double)ONE;
}

static void fit(hci_foreign_map *map)
{
    map->unit = 1.0 / map->counts_per_A;
    for (size_t k = 0; k < map->points * 4; ++k) {
        double whole = floor(map->value[k] * scale_of(map, k % 4) + 0.5);
        if (fabs(whole) > MOST) {
            whole = copysign(MOST, whole);
            ++map->cut;
        }
        map->value[k] = whole / scale_of(map, k % 4);
    }
}

static int32_t digits(const hci_foreign_map *map, size_t row, size_t column)
{
    return (int32_t)floor(map->value[4 * row + column] * scale_of(map, column) + 0.5);
}

static int32_t limited(int32_t x)
{
    return x > MOST ? MOST : x < -MOST ? -MOST : x;
}

static void at(const hci_foreign_map *map, double turn, double own_q_A, double add[2])
{
    const int32_t step = (int32_t)(65536 / map->points);
    const int32_t own = limited((int32_t)floor(fmax(-1e5, fmin(1e5, own_q_A * map->counts_per_A)) + 0.5));
    const int32_t angle = (int32_t)(turn * 65536.0) & 65535;
    const size_t left = (size_t)(angle / step), right = (left + 1) % map->points;
    int32_t v[4];
    for (size_t c = 0; c < 4; ++c) {
        const int32_t a = digits(map, left, c), b = digits(map, right, c);
        v[c] = a + (b - a) * (angle % step) / step;
    }
    add[0] = limited(v[0] + own * v[2] / ONE) / map->counts_per_A;
    add[1] = limited(own + v[1] + own * v[3] / ONE) / map->counts_per_A - own_q_A;
}

static void write_value(const hci_foreign_map *map, size_t row, size_t column, hci_output *output)
{
    hci_output_text(output, "%ld", (long)digits(map, row, column));
}

static void write_table(const hci_foreign_map *map, const hci_foreign_files *files, hci_output *output)
{
    const size_t columns = hci_foreign_code_columns(map);
    hci_output_text(
        output, "#ifndef HCI_MAP_%s\n#define HCI_MAP_%s\n\n#include <stdint.h>\n\n#include \"mc_type.h\"\n\n",
        files->name, files->name);
    hci_output_text(output, "/* i_d, i_q in digits%s */\nstatic const int16_t %s_table[%zu][%zu] = {\n",
                    columns == 4 ? "; for 8192 digits of i_q: i_d, i_q" : "", files->name, map->points,
                    columns);
    hci_foreign_write_rows(map, write_value, output);
    hci_output_text(output, "};\n\n");
}

static void write_function(const hci_foreign_map *map, const hci_foreign_files *files, hci_output *output)
{
    const size_t columns = hci_foreign_code_columns(map), step = 65536 / map->points;
    const char *name = files->name;
    hci_output_text(
        output,
        "/* What goes to the PI controllers in place of Iqdref, at the electrical angle of the Park "
        "transform. */\n"
        "static inline qd_t %s_feed(qd_t own, int16_t angle)\n{\n"
        "    const uint32_t at = (uint16_t)angle;\n"
        "    const uint32_t left = at / %zuu, right = (left + 1u) %% %zuu;\n"
        "    const int32_t share = (int32_t)(at %% %zuu);\n"
        "    int32_t value[%zu], d, q;\n",
        name, step, map->points, step, columns);
    hci_output_text(output,
                    "    for (uint32_t k = 0; k < %zuu; ++k) {\n"
                    "        const int32_t a = %s_table[left][k], b = %s_table[right][k];\n"
                    "        value[k] = a + (b - a) * share / %zu;\n    }\n",
                    columns, name, name, step);
    hci_output_text(output, columns == 4 ? "    d = own.d + value[0] + (int32_t)own.q * value[2] / 8192;\n"
                                           "    q = own.q + value[1] + (int32_t)own.q * value[3] / 8192;\n"
                                         : "    d = own.d + value[0];\n    q = own.q + value[1];\n");
    hci_output_text(output, "    own.d = (int16_t)(d > 32767 ? 32767 : d < -32767 ? -32767 : d);\n"
                            "    own.q = (int16_t)(q > 32767 ? 32767 : q < -32767 ? -32767 : q);\n"
                            "    return own;\n}\n\n#endif\n");
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
    for (size_t k = 0; !status && k < map->points * 4; ++k)
        map->value[k] /= scale_of(map, k % 4);
    map->unit = 1.0 / map->counts_per_A;
    return status;
}

const hci_foreign_type hci_foreign_mcsdk = {
    .word = "st-mcsdk",
    .carries = "i_d and i_q over the electrical turn, for one torque, with --per-torque for any",
    .lacks = "what differs from one electrical turn to the next, and the zero sequence",
    .samples = "a table of 16-bit digits, straight lines between its rows",
    .kind = HCI_FOREIGN_DQ,
    .is_electrical = true,
    .zero_deg = -90.0,
    .has_counts = true,
    .default_points = 256,
    .file = {"h"},
    .fit = fit,
    .at = at,
    .write = {write_header},
    .recognises = recognises,
    .read = read,
};
