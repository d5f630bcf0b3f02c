/* The text of an emitted table. In: rows, probes, figures; out: a header that says how to use them, and a
 * source with the waves in a comment, the rows, the probes and the table. Same input, same bytes: no dates,
 * no paths, no locale. */
#include "host/emit/text.h"

#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "hci/host/base/number.h"
#include "hci/version.h"

/* Nine significant digits, which is enough for a float, with a decimal point in every locale and for every
 * value, so that C takes it for a floating constant. */
const char *hci_emission_number(double value, char text[32])
{
    char digits[32], exponent[8];
    size_t mantissa;
    snprintf(digits, sizeof digits, "%.9g", value);
    hci_number_text(strtod(digits, NULL), text);
    if (strchr(text, '.')) return text;
    mantissa = strcspn(text, "e");
    snprintf(exponent, sizeof exponent, "%s", text + mantissa);
    snprintf(text + mantissa, 32 - mantissa, ".0%s", exponent);
    return text;
}

void hci_emission_float(hci_output *out, float value, const char *end)
{
    char text[32];
    hci_output_text(out, "%sf%s", hci_emission_number((double)value, text), end);
}

static const char *plural(size_t count)
{
    return count == 1 ? "" : "s";
}

static void write_title(const hci_emission *e, hci_output *out, const char *extension)
{
    hci_output_text(out, "/* %s.%s: table of currents over the rotor angle, for hci/table.h.\n",
                    e->request->name, extension);
    hci_output_text(out,
                    " * Written by hci-solve " HCI_VERSION_STRING "; emit it again rather than edit it.\n"
                    " * SPDX-License-Identifier: MIT\n");
}

static void write_use(const hci_emission *e, hci_output *out)
{
    const char *frame = e->table.frame == HCI_TABLE_ABC ? "abc" : "dq";
    const bool torque = e->table.parts == 2;
    hci_output_text(out, " *\n * Use:    hci_currents_%s i = hci_table_f32_%s%s(&%s, angle%s);\n", frame,
                    frame, torque ? "_torque" : "", e->request->name, torque ? ", torque_Nm" : "");
    if (torque)
        hci_output_text(out, " * Form:   i = torque_Nm * A(angle) + B(angle), A in A/(N*m), B in A.\n");
}

static void write_frame(const hci_emission *e, hci_output *out)
{
    if (e->table.frame == HCI_TABLE_ABC) {
        hci_output_text(
            out,
            " * Values: ia_A, ib_A, ic_A%s: instantaneous phase currents in A, positive into the machine.\n",
            e->table.columns == 2 ? " = -ia_A - ib_A" : "");
    } else {
        hci_output_text(out, " * Values: id_A, iq_A: rotor-frame currents in A, amplitude-invariant, "
                             "positive into the machine;\n"
                             " *         ia = iq sin(theta) - id cos(theta). iq > 0 makes positive torque, "
                             "id > 0 strengthens\n"
                             " *         the flux of the magnets.\n");
    }
}

static void write_angle(const hci_emission *e, hci_output *out)
{
    const size_t turns = e->tabulation.period_turns;
    hci_output_text(
        out,
        " * Angle:  uint32_t, 2^32 = %zu electrical turn%s%s. theta = pole pairs * mechanical angle is 0 at\n"
        " *         the rising zero crossing of the fundamental of phase a's back-EMF and grows with\n"
        " *         rotation a-b-c, the direction of positive torque.\n",
        turns, plural(turns), turns == 1 ? "" : " (period_turns)");
    hci_output_text(
        out,
        " * Orders: electrical; mechanical order = electrical order * pole pairs. Amplitudes are peak.\n");
}

static void write_figures(const hci_emission *e, hci_output *out)
{
    char text[32];
    const hci_table_f32 *t = &e->table;
    const size_t values = (size_t)t->columns * t->parts;
    hci_output_text(out, " * Size:   %" PRIu32 " points and a guard row, %zu values each, %zu bytes.\n",
                    t->points, values, (t->points + 1) * values * 4);
    hci_output_text(out, " * Error:  at most %s A in any current at any angle",
                    hci_emission_number((double)t->max_error_A, text));
    if (t->parts == 2)
        hci_output_text(out, ", |torque| <= %s N*m",
                        hci_emission_number((double)t->reference_torque_Nm, text));
    hci_output_text(out, ".\n * Peak:   %s A phase current", hci_emission_number((double)t->peak_A, text));
    if (t->parts == 2)
        hci_output_text(out, ", |torque| <= %s N*m",
                        hci_emission_number((double)t->reference_torque_Nm, text));
    hci_output_text(out, ".\n * CRC-32: %08" PRIx32 " (IEEE 802.3) of the rows.\n", t->crc32);
}

static void write_input(const hci_emission *e, hci_output *out)
{
    hci_output_text(out, " * Input:  FNV-1a %016" PRIx64 "\n", e->request->input_hash);
    for (size_t k = 0; k < e->request->provenance_count; ++k)
        hci_output_text(out, " *         %s\n", e->request->provenance[k]);
    hci_output_text(out, " */\n");
}

void hci_emission_write_header(const hci_emission *e, hci_output *out)
{
    const char *name = e->request->name;
    write_title(e, out, "h");
    write_use(e, out);
    write_frame(e, out);
    write_angle(e, out);
    write_figures(e, out);
    write_input(e, out);
    hci_output_text(out, "#ifndef HCI_EMITTED_%s_H\n#define HCI_EMITTED_%s_H\n\n#include \"hci/table.h\"\n\n",
                    name, name);
    hci_output_text(out,
                    "#if HCI_TABLE_VERSION != %d\n#error \"%s needs version %d of hci/table.h\"\n#endif\n\n",
                    HCI_TABLE_VERSION, name, HCI_TABLE_VERSION);
    hci_output_text(out, "#ifdef __cplusplus\nextern \"C\" {\n#endif\n\nextern const hci_table_f32 %s;\n\n",
                    name);
    hci_output_text(out, "#ifdef __cplusplus\n}\n#endif\n\n#endif\n");
}

static void write_waves(hci_output *out, const char *title, const hci_wave *waves, size_t count)
{
    char order[32], amplitude[32], phase[32];
    hci_output_text(
        out, " *\n * %s, phase s = 0, 1, 2: amplitude sin(order theta - sequence 2 pi s/3 + phase)\n", title);
    hci_output_text(out, " * %12s %8s %16s %16s\n", "order", "sequence", "amplitude", "phase_rad");
    for (size_t k = 0; k < count; ++k) {
        const hci_wave *w = &waves[k];
        hci_output_text(out, " * %12s %8d %16s %16s\n", hci_emission_number(w->order, order), w->sequence,
                        hci_emission_number(hci_amplitude(w->sine, w->cosine), amplitude),
                        hci_emission_number(hci_phase_rad(w->sine, w->cosine), phase));
    }
}

static void write_rows(const hci_emission *e, hci_output *out)
{
    const size_t values = (size_t)e->table.columns * e->table.parts, rows = (size_t)e->table.points + 1;
    hci_output_text(out, "static const float %s_rows[%zu] = {\n", e->request->name, rows * values);
    for (size_t k = 0; k < rows; ++k) {
        hci_output_text(out, "    ");
        for (size_t j = 0; j < values; ++j)
            hci_emission_float(out, e->rows[k * values + j], j + 1 < values ? ", " : ",\n");
    }
    hci_output_text(out, "};\n\n");
}

static void write_probes(const hci_emission *e, hci_output *out)
{
    hci_output_text(out, "/* angle, torque_Nm, expected currents in A from the waves above in double "
                         "precision; max_error_A is "
                         "allowed */\n");
    hci_output_text(out, "static const hci_table_f32_probe %s_probes[%d] = {\n", e->request->name,
                    (int)HCI_EMIT_PROBES);
    for (size_t k = 0; k < HCI_EMIT_PROBES; ++k) {
        const hci_table_f32_probe *p = &e->probes[k];
        hci_output_text(out, "    {%" PRIu32 "u, ", p->angle);
        hci_emission_float(out, p->torque_Nm, ", {");
        hci_emission_float(out, p->expected[0], ", ");
        hci_emission_float(out, p->expected[1], ", ");
        hci_emission_float(out, p->expected[2], "}},\n");
    }
    hci_output_text(out, "};\n\n");
}

static void write_table(const hci_emission *e, hci_output *out)
{
    const hci_table_f32 *t = &e->table;
    const char *name = e->request->name;
    hci_output_text(out, "const hci_table_f32 %s = {\n    %s_rows,\n    %s_probes,\n", name, name, name);
    hci_output_text(out, "    %du, /* probe_count */\n    %" PRIu32 "u, /* points */\n", (int)HCI_EMIT_PROBES,
                    t->points);
    hci_output_text(out, "    %" PRIu32 "u, /* columns */\n    %" PRIu32 "u, /* parts */\n", t->columns,
                    t->parts);
    hci_output_text(out, "    %s,\n", t->frame == HCI_TABLE_ABC ? "HCI_TABLE_ABC" : "HCI_TABLE_DQ");
    hci_output_text(out, "    %" PRIu32 "u, /* period_turns */\n    0x%08" PRIX32 "u, /* crc32 */\n    ",
                    t->period_turns, t->crc32);
    hci_emission_float(out, t->max_error_A, ", /* max_error_A */\n    ");
    hci_emission_float(out, t->peak_A, ", /* peak_A */\n    ");
    hci_emission_float(out, t->reference_torque_Nm, " /* reference_torque_Nm */\n};\n");
}

void hci_emission_write_source(const hci_emission *e, hci_output *out)
{
    const hci_tabulation *t = &e->tabulation;
    write_title(e, out, "c");
    hci_output_text(out, " * Conventions and figures: %s.h.\n", e->request->name);
    if (t->parts == 2) write_waves(out, "A(theta) in A/(N*m)", t->per_Nm, t->per_Nm_count);
    write_waves(out, t->parts == 2 ? "B(theta) in A" : "Currents in A", t->constant, t->constant_count);
    write_input(e, out);
    hci_output_text(out, "#include \"%s.h\"\n\n", e->request->name);
    write_rows(e, out);
    write_probes(e, out);
    write_table(e, out);
}
