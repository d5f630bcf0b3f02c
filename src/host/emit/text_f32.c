/* The text of a table of format f32. In: rows, probes, figures; out: a header that says how to use them, and
 * a source with the waves in a comment, the rows, the probes and the table. */
#include <inttypes.h>

#include "host/emit/text.h"

static void write_use(const hci_emission *e, hci_output *out)
{
    const char *frame = e->table.frame == HCI_TABLE_ABC ? "abc" : "dq";
    const bool torque = e->table.parts == 2;
    hci_output_text(out, " *\n * Use:    hci_currents_%s i = hci_table_f32_%s%s(&%s, angle%s);\n", frame,
                    frame, torque ? "_torque" : "", e->request->name, torque ? ", torque_Nm" : "");
    if (torque)
        hci_output_text(out, " * Form:   i = torque_Nm * A(angle) + B(angle), A in A/(N*m), B in A.\n");
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
    hci_output_text(out, ".\n");
    hci_emission_ripple(e, out);
    hci_output_text(out, " * CRC-32: %08" PRIx32 " (IEEE 802.3) of the rows.\n", e->result.crc32);
}

void hci_emission_write_header(const hci_emission *e, hci_output *out)
{
    hci_emission_title(e, out, "h");
    write_use(e, out);
    hci_emission_frame(e, out);
    hci_emission_angle(e, out);
    hci_emission_facts(e, out);
    write_figures(e, out);
    hci_emission_input(e, out);
    hci_emission_guard(e, out, "hci/table.h", "HCI_TABLE_VERSION", HCI_TABLE_VERSION);
    hci_emission_macros(e->request->name, e->request->facts.pole_pairs, e->tabulation.period_turns, out);
    hci_emission_correction_macros(e->request->name, &e->request->facts.correction_values, out);
    hci_output_text(out, "extern const hci_table_f32 %s;\n\n", e->request->name);
    hci_emission_guard_end(out);
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
    hci_output_text(out, "    %" PRIu32 "u, /* period_turns */\n    0x%08" PRIX32 "u, /* sum32 */\n    ",
                    t->period_turns, t->sum32);
    hci_emission_float(out, t->max_error_A, ", /* max_error_A */\n    ");
    hci_emission_float(out, t->peak_A, ", /* peak_A */\n    ");
    hci_emission_float(out, t->reference_torque_Nm, " /* reference_torque_Nm */\n};\n");
}

void hci_emission_write_source(const hci_emission *e, hci_output *out)
{
    hci_emission_title(e, out, "c");
    hci_output_text(out, " * Conventions and figures: %s.h.\n", e->request->name);
    hci_emission_waves(e, out);
    hci_emission_input(e, out);
    hci_output_text(out, "#include \"%s.h\"\n\n", e->request->name);
    write_rows(e, out);
    write_probes(e, out);
    write_table(e, out);
}
