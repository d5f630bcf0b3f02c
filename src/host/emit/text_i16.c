/* The text of a table of formats i16 and q15. In: knots, probes, figures; out: a header that says how to use
 * them and holds the table as a constant, so that a compiler leaves out what its shape does not need, and a
 * source with the waves in a comment, the knots and the probes. */
#include <inttypes.h>
#include <stdio.h>

#include "host/emit/text.h"

static size_t values_of(const hci_table_i16 *t)
{
    return (size_t)(t->intervals + t->degree) * t->columns * t->parts;
}

static const char *knot_type(const hci_table_i16 *t)
{
    return t->knot_bits == 8 ? "int8_t" : "int16_t";
}

static void write_use(const hci_emission *e, hci_output *out)
{
    const char *frame = e->spline.frame == HCI_TABLE_ABC ? "abc" : "dq";
    const bool torque = e->spline.parts == 2, integer = hci_emit_is_integer(e->result.chosen.format);
    hci_output_text(out, " *\n * Use:    hci_%s_%s i = hci_table_i16_%s%s%s(&%s, angle%s);\n",
                    integer ? "units" : "currents", frame, frame, torque ? "_torque" : "",
                    integer ? "_q15" : "", e->request->name,
                    !torque   ? ""
                    : integer ? ", torque_q15"
                              : ", torque_Nm");
    if (torque && integer)
        hci_output_text(
            out,
            " * Form:   i = torque * A(angle) + B(angle); torque_q15 is 32767 at reference_torque_Nm.\n");
    if (torque && !integer)
        hci_output_text(out, " * Form:   i = torque_Nm * A(angle) + B(angle), |torque_Nm| limited to "
                             "reference_torque_Nm.\n");
}

static void write_shape(const hci_emission *e, hci_output *out)
{
    static const char *const degrees[] = {"", "linear", "quadratic", "cubic"};
    const hci_table_i16 *t = &e->spline;
    hci_output_text(out, " * Shape:  %s spline, %" PRIu32 " interval%s in 1/%" PRIu32 " of the period%s.\n",
                    degrees[t->degree], t->intervals, t->intervals == 1 ? "" : "s", t->sectors,
                    t->rotation || t->alternates ? "; the rest by phases and signs" : "");
    hci_output_text(out, " * Size:   %zu values of %" PRIu32 " bits, %zu bytes.\n", values_of(t),
                    t->knot_bits, t->knot_bits / 8 * values_of(t));
}

static void write_torque(const hci_emission *e, hci_output *out)
{
    char text[32];
    if (e->spline.parts == 2)
        hci_output_text(out, ", |torque| <= %s N*m",
                        hci_emission_number((double)e->spline.reference_torque_Nm, text));
}

static void write_figures(const hci_emission *e, hci_output *out)
{
    char text[32];
    hci_output_text(out, " * Error:  at most %s A in any current at any angle",
                    hci_emission_number(e->result.chosen.max_error_A, text));
    write_torque(e, out);
    hci_output_text(out, ".\n * Peak:   %s A phase current",
                    hci_emission_number((double)e->spline.peak_A, text));
    write_torque(e, out);
    hci_output_text(out, ".\n * Unit:   unit_A = %s A, of the integers.\n",
                    hci_emission_number((double)e->spline.unit_A, text));
    hci_emission_ripple(e, out);
    hci_output_text(out, " * CRC-32: %08" PRIx32 " (IEEE 802.3) of the knots, low byte first.\n",
                    e->spline.crc32);
}

static void write_shape_fields(const hci_emission *e, hci_output *out)
{
    const hci_table_i16 *t = &e->spline;
    const struct {
        uint32_t value;
        const char *name;
    } field[] = {{HCI_EMIT_PROBES, "probe_count"}, {t->knot_bits, "knot_bits"},
                 {t->intervals, "intervals"},      {t->degree, "degree"},
                 {t->columns, "columns"},          {t->parts, "parts"},
                 {t->sectors, "sectors"},          {t->rotation, "rotation"},
                 {t->alternates, "alternates"}};
    for (size_t k = 0; k < sizeof field / sizeof *field; ++k)
        hci_output_text(out, "    %" PRIu32 "u, /* %s */\n", field[k].value, field[k].name);
}

static void write_table(const hci_emission *e, hci_output *out)
{
    const hci_table_i16 *t = &e->spline;
    const char *name = e->request->name;
    hci_output_text(out, "extern const %s %s_knots[%zu];\n", knot_type(t), name, values_of(t));
    hci_output_text(out, "extern const hci_table_i16_probe %s_probes[%d];\n\n", name, (int)HCI_EMIT_PROBES);
    hci_output_text(out, "static const hci_table_i16 %s = {\n    ", name);
    if (t->knot_bits == 8)
        hci_output_text(out, "NULL,\n    %s_knots,\n", name);
    else
        hci_output_text(out, "%s_knots,\n    NULL, /* knots_i8 */\n", name);
    hci_output_text(out, "    %s_probes,\n", name);
    write_shape_fields(e, out);
    hci_output_text(out, "    %s,\n", t->frame == HCI_TABLE_ABC ? "HCI_TABLE_ABC" : "HCI_TABLE_DQ");
    hci_output_text(out, "    %" PRIu32 "u, /* period_turns */\n    0x%08" PRIX32 "u, /* crc32 */\n    ",
                    t->period_turns, t->crc32);
    hci_emission_float(out, t->unit_A, ", /* unit_A */\n    ");
    hci_emission_float(out, t->max_error_A, ", /* max_error_A */\n    ");
    hci_emission_float(out, t->max_error_q15_A, ", /* max_error_q15_A */\n    ");
    hci_emission_float(out, t->peak_A, ", /* peak_A */\n    ");
    hci_emission_float(out, t->reference_torque_Nm, " /* reference_torque_Nm */\n};\n\n");
}

void hci_emission_write_spline_header(const hci_emission *e, hci_output *out)
{
    hci_emission_title(e, out, "h");
    write_use(e, out);
    hci_emission_frame(e, out);
    hci_emission_angle(e, out);
    hci_emission_facts(e, out);
    write_shape(e, out);
    write_figures(e, out);
    hci_emission_input(e, out);
    hci_emission_guard(e, out, "hci/table_i16.h", "HCI_TABLE_I16_VERSION", HCI_TABLE_I16_VERSION);
    hci_emission_macros(e->request->name, e->request->facts.pole_pairs, e->tabulation.period_turns, out);
    hci_emission_correction_macros(e->request->name, &e->request->facts.correction_values, out);
    write_table(e, out);
    hci_emission_guard_end(out);
}

static void write_knots(const hci_emission *e, hci_output *out)
{
    const size_t values = (size_t)e->spline.columns * e->spline.parts, all = values_of(&e->spline);
    hci_output_text(out, "const %s %s_knots[%zu] = {\n", knot_type(&e->spline), e->request->name, all);
    for (size_t k = 0; k < all; ++k)
        hci_output_text(out, "%s%d,%s", k % values == 0 ? "    " : " ",
                        e->spline.knot_bits == 8 ? e->spline.knots_i8[k] : e->spline.knots[k],
                        k % values + 1 == values ? "\n" : "");
    hci_output_text(out, "};\n\n");
}

static void write_probes(const hci_emission *e, hci_output *out)
{
    hci_output_text(out, "/* angle, torque_q15, expected currents in unit_A, to the last bit */\n");
    hci_output_text(out, "const hci_table_i16_probe %s_probes[%d] = {\n", e->request->name,
                    (int)HCI_EMIT_PROBES);
    for (size_t k = 0; k < HCI_EMIT_PROBES; ++k) {
        const hci_table_i16_probe *p = &e->spline_probes[k];
        hci_output_text(out, "    {%" PRIu32 "u, %d, {%d, %d, %d}},\n", p->angle, p->torque_q15,
                        p->expected[0], p->expected[1], p->expected[2]);
    }
    hci_output_text(out, "};\n");
}

void hci_emission_write_spline_source(const hci_emission *e, hci_output *out)
{
    hci_emission_title(e, out, "c");
    hci_output_text(out, " * Conventions and figures: %s.h.\n", e->request->name);
    hci_emission_waves(e, out);
    hci_emission_input(e, out);
    hci_output_text(out, "#include \"%s.h\"\n\n", e->request->name);
    write_knots(e, out);
    write_probes(e, out);
}
