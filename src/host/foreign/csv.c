/* No drive in particular: a table over the turn of the encoder, for a program of one's own. i = (what stands
 * there) + (what stands there per A)·(own i_q), straight lines between the rows, the last goes on to the
 * first. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "hci/math/harmonic.h"
#include "host/base/quote.h"
#include "host/foreign/text.h"

enum { MOST_POINTS = 4096 };

#define HEADER "theta_m_rad,id_A,iq_A,torque_Nm,id_A_per_A,iq_A_per_A"

static void fit(hci_foreign_map *map)
{
    (void)map;
}

static void at(const hci_foreign_map *map, double turn, double own_q_A, double add[2])
{
    double value[HCI_FOREIGN_MOST_COLUMNS];
    hci_foreign_line(map, turn, value);
    add[0] = value[0] + own_q_A * value[2];
    add[1] = value[1] + own_q_A * value[3];
}

static void write_table(const hci_foreign_map *map, const hci_foreign_files *files, hci_output *output)
{
    hci_foreign_write_head(map, files, "#", "i_d and i_q to be added, over the angle of the encoder.",
                           output);
    hci_output_text(output, HEADER "\n");
    for (size_t k = 0; k < map->points; ++k) {
        const double *v = map->value + 4 * k;
        hci_output_number(output, 2.0 * HCI_PI * (double)k / (double)map->points, ',');
        hci_output_number(output, v[0], ',');
        hci_output_number(output, v[1], ',');
        hci_output_text(output, "0,");
        hci_output_number(output, v[2], ',');
        hci_output_number(output, v[3], '\n');
    }
}

static bool recognises(const char *text)
{
    return strstr(text, HEADER) != NULL;
}

static hci_status wrong(const char *path, const char *line, hci_note *note)
{
    char shown[HCI_QUOTE_PATH_SIZE], found[HCI_QUOTE_SIZE], first[64];
    snprintf(first, sizeof first, "%.*s", (int)strcspn(line, "\r\n"), line);
    return hci_note_set(note, HCI_ERROR_INPUT,
                        "%s: found %s, expected rows " HEADER
                        ", at most %d, in equal steps of one turn from 0; "
                        "emit it again",
                        hci_quote_path(path, shown), hci_quote(first, found), (int)MOST_POINTS);
}

/* Six numbers. */
static bool read_row(const char *line, const char **end, double value[6])
{
    for (int k = 0; k < 6; ++k) {
        if (!hci_foreign_number(line, end, &value[k]) || (k < 5 && **end != ',')) return false;
        line = *end + 1;
    }
    return true;
}

static const char *first_row(const char *text)
{
    const char *line = strstr(text, HEADER) + strlen(HEADER);
    return line + strspn(line, " \t\r\n");
}

static size_t count_rows(const char *line)
{
    size_t rows = 0;
    for (; *line != '\0'; line += strspn(line, " \t\r\n")) {
        line += strcspn(line, "\r\n");
        ++rows;
    }
    return rows;
}

static hci_status read(const char *path, const char *text, hci_foreign_map *map, hci_note *note)
{
    const char *line = first_row(text);
    const size_t rows = count_rows(line);
    if (rows < 2 || rows > MOST_POINTS) return wrong(path, line, note);
    hci_status status = hci_foreign_map_points(map, rows, note);
    for (size_t k = 0; !status && k < rows; ++k) {
        double value[6];
        const char *end;
        const double theta_rad = 2.0 * HCI_PI * (double)k / (double)rows;
        if (!read_row(line, &end, value) || fabs(value[0] - theta_rad) > 1e-6) return wrong(path, line, note);
        memcpy(map->value + 4 * k, value + 1, 2 * sizeof *value);
        memcpy(map->value + 4 * k + 2, value + 4, 2 * sizeof *value);
        line = end + strspn(end, " \t\r\n");
    }
    return status;
}

const hci_foreign_type hci_foreign_csv = {
    .word = "csv",
    .carries = "i_d and i_q over the mechanical turn, for one torque, with --per-torque for any",
    .lacks = "the zero sequence",
    .samples = "a table of doubles, straight lines between its rows",
    .kind = HCI_FOREIGN_DQ,
    .default_points = 1024,
    .file = {"csv"},
    .fit = fit,
    .at = at,
    .write = {write_table},
    .recognises = recognises,
    .read = read,
};
