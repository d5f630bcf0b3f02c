/* OpenFFBoard with a TMC4671, branch with anti-cogging: twenty harmonics of the mechanical turn, each a float
 * amplitude in counts of the torque command, a float phase and a 16-bit order, 12 bytes, in flash at
 * 0x08010000 + 240·axis. The sum is cut to whole counts and added to the command, and what comes of it
 * limited to ±32767 counts. */
#include <math.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>

#include "hci/math/harmonic.h"
#include "host/base/quote.h"
#include "host/foreign/text.h"

enum {
    HARMONICS = 20,
    TERM_BYTES = 12,
    BYTES = HARMONICS * TERM_BYTES,
    RECORD = 16,
    PAGE = 0x0801,
    MOST = 32767
};

static float counts(const hci_foreign_map *map, const hci_foreign_term *t)
{
    return (float)(t->amplitude * map->counts_per_A);
}

static void fit(hci_foreign_map *map)
{
    map->unit = 1.0 / map->counts_per_A;
    for (size_t k = 0; k < map->terms; ++k) {
        hci_foreign_term *t = &map->term[k];
        t->amplitude = (double)counts(map, t) / map->counts_per_A;
        t->phase_rad = (double)(float)remainder(t->phase_rad, 2.0 * HCI_PI);
    }
}

static double limited(double counts_of_torque)
{
    return fmax(-MOST, fmin(MOST, counts_of_torque));
}

static void at(const hci_foreign_map *map, double turn, double own_q_A, double add[2])
{
    const double own = limited(own_q_A * map->counts_per_A);
    const double sum = trunc(hci_foreign_sum(map, turn) * map->counts_per_A);
    add[0] = 0.0;
    add[1] = limited(own + sum) / map->counts_per_A - own_q_A;
}

static void write_reply(const hci_foreign_map *map, const hci_foreign_files *files, hci_output *output)
{
    char amplitude[32], phase[32];
    hci_foreign_write_head(map, files, "#",
                           "OpenFFBoard: order:amplitude:phase, in counts and radians, of map.hex.", output);
    for (size_t k = 0; k < map->terms; ++k)
        hci_output_text(output, "%s%.0f:%s:%s", k > 0 ? "," : "", map->term[k].order,
                        hci_foreign_float((double)counts(map, &map->term[k]), amplitude),
                        hci_foreign_float(map->term[k].phase_rad, phase));
    hci_output_text(output, "\n");
}

/* ---- Intel HEX ---- */

static void put_float(float value, uint8_t *bytes)
{
    uint32_t bits;
    memcpy(&bits, &value, sizeof bits);
    for (int k = 0; k < 4; ++k)
        bytes[k] = (uint8_t)(bits >> (8 * k));
}

static void image(const hci_foreign_map *map, uint8_t bytes[BYTES])
{
    memset(bytes, 0, BYTES);
    for (size_t k = 0; k < map->terms; ++k) {
        uint8_t *const at_term = bytes + k * TERM_BYTES;
        const unsigned order = (unsigned)map->term[k].order;
        put_float(counts(map, &map->term[k]), at_term);
        put_float((float)map->term[k].phase_rad, at_term + 4);
        at_term[8] = (uint8_t)(order & 255);
        at_term[9] = (uint8_t)(order >> 8);
    }
}

static void write_record(hci_output *output, unsigned address, unsigned type, const uint8_t *bytes,
                         unsigned count)
{
    unsigned sum = count + (address >> 8) + (address & 255) + type;
    hci_output_text(output, ":%02X%04X%02X", count, address, type);
    for (unsigned k = 0; k < count; ++k) {
        hci_output_text(output, "%02X", bytes[k]);
        sum += bytes[k];
    }
    hci_output_text(output, "%02X\n", (0u - sum) & 255u);
}

static void write_hex(const hci_foreign_map *map, const hci_foreign_files *files, hci_output *output)
{
    (void)files;
    uint8_t bytes[BYTES];
    const uint8_t page[2] = {PAGE >> 8, PAGE & 255};
    image(map, bytes);
    write_record(output, 0, 4, page, 2);
    for (unsigned k = 0; k < BYTES; k += RECORD)
        write_record(output, k, 0, bytes + k, RECORD);
    write_record(output, 0, 1, NULL, 0);
}

static void write_script(const hci_foreign_map *map, const hci_foreign_files *files, hci_output *output)
{
    (void)map;
    hci_output_text(
        output,
        "#!/bin/sh\n"
        "# Puts %s.hex, which stands beside this file, into the flash of axis 0 (TMC4671 CS 1) by ST-Link.\n"
        "# Without --store nothing is sent. It erases the sector at 0x08010000, where the maps of the other\n"
        "# axes and speeds stand too.\n"
        "#   %s_upload.sh [--store]\n"
        "set -eu\n"
        "file=$(dirname \"$0\")/%s.hex\n",
        files->name, files->name, files->name);
    hci_output_text(output,

                    "if [ \"${1-}\" = --store ]; then\n"
                    "    STM32_Programmer_CLI -c port=SWD -w \"$file\" -v -rst\n"
                    "elif [ $# -gt 0 ]; then\n"
                    "    sed -n '2,5s/^# //p' \"$0\"\n"
                    "    [ \"$1\" = --help ] || exit 2\n"
                    "else\n"
                    "    echo \"STM32_Programmer_CLI -c port=SWD -w $file -v -rst\"\n"
                    "    echo \"nothing was sent: --store runs this\"\n"
                    "fi\n");
}

/* ---- reading ---- */

/* What a board has answered, without the comments before it and `[… |` about it. */
static const char *answer(const char *text)
{
    while (*text == '#' || *text == '\n' || *text == '\r') {
        text += strcspn(text, "\n");
        if (*text == '\n') ++text;
    }
    const char *bar = strchr(text, '|');
    return *text == '[' && bar != NULL ? bar + 1 : text;
}

/* One order:amplitude:phase; `end` behind it. */
static bool read_term(const char *text, const char **end, hci_foreign_term *term)
{
    return hci_foreign_number(text, end, &term->order) && **end == ':' &&
           hci_foreign_number(*end + 1, end, &term->amplitude) && **end == ':' &&
           hci_foreign_number(*end + 1, end, &term->phase_rad) && strchr(",]\r\n", **end) != NULL;
}

/* Whether terms are whole numbers alone: a board answers in whole counts and milliradians. */
static bool is_whole(const char *text)
{
    return text[strcspn(text, ".eE]\r\n")] != '.' && strcspn(text, "eE") >= strcspn(text, "]\r\n");
}

static bool recognises(const char *text)
{
    hci_foreign_term term;
    const char *at_term = answer(text);
    size_t count = 0;
    for (; read_term(at_term, &at_term, &term); ++count)
        if (*at_term++ != ',') return true;
    return false;
}

static hci_status wrong(const char *path, const char *found, hci_note *note)
{
    char shown[HCI_QUOTE_PATH_SIZE];
    return hci_note_set(
        note, HCI_ERROR_INPUT,
        "%s: found %s, expected at most 20 of order:amplitude:phase, the order whole and above 0; save "
        "what the board answers to coggingHarmonics",
        hci_quote_path(path, shown), found);
}

static hci_status read(const char *path, const char *text, hci_foreign_map *map, hci_note *note)
{
    hci_foreign_term term;
    const char *at_term = answer(text);
    const double unit_rad = is_whole(at_term) ? 1e-3 : 1.0;
    char found[48];
    while (read_term(at_term, &at_term, &term)) {
        snprintf(found, sizeof found, "%zu terms, order %g", map->terms + 1, term.order);
        if (map->terms == HARMONICS || !(term.order >= 1.0 && term.order <= 65535.0) ||
            floor(term.order) != term.order)
            return wrong(path, found, note);
        term.amplitude = (double)(float)term.amplitude / map->counts_per_A;
        term.phase_rad = (double)(float)(unit_rad * term.phase_rad);
        if (term.amplitude > 0.0) map->term[map->terms++] = term;
        if (*at_term != ',') break;
        ++at_term;
    }
    map->unit = 1.0 / map->counts_per_A;
    return HCI_OK;
}

const hci_foreign_type hci_foreign_openffboard = {
    .word = "openffboard",
    .carries = "i_q over the mechanical turn, added whatever the torque",
    .lacks = "i_d, and what depends on the torque",
    .samples =
        "20 harmonics of single precision, their sum cut to whole counts and with the command to 32767",
    .kind = HCI_FOREIGN_Q,
    .has_counts = true,
    .most_terms = HARMONICS,
    .most_order = 1000.0,
    .file = {"txt", "hex", "_upload.sh"},
    .fit = fit,
    .at = at,
    .write = {write_reply, write_hex, write_script},
    .recognises = recognises,
    .read = read,
};
