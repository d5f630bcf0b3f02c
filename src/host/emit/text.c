/* What the texts of all tables have in common. */
#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "hci/host/base/number.h"
#include "hci/version.h"
#include "host/emit/text.h"

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

void hci_emission_title(const hci_emission *e, hci_output *out, const char *extension)
{
    const char *runtime = e->result.chosen.format == HCI_EMIT_F32 ? "hci/table.h" : "hci/table_i16.h";
    hci_output_text(out, "/* %s.%s: table of currents over the rotor angle, for %s.\n", e->request->name,
                    extension, runtime);
    hci_output_text(out,
                    " * Written by hci-solve " HCI_VERSION_STRING "; emit it again rather than edit it.\n"
                    " * SPDX-License-Identifier: MIT\n");
}

void hci_emission_frame(const hci_emission *e, hci_output *out)
{
    const bool units = hci_emit_is_integer(e->result.chosen.format);
    const char *a = units ? "" : "_A", *unit = units ? "unit_A" : "A";
    if (e->request->frame == HCI_TABLE_ABC) {
        hci_output_text(out, " * Values: ia%s, ib%s, ic%s", a, a, a);
        if (e->result.columns == 2) hci_output_text(out, " = -ia%s - ib%s", a, a);
        hci_output_text(out, ": instantaneous phase currents in %s, positive into the machine.\n", unit);
    } else {
        hci_output_text(
            out,
            " * Values: id%s, iq%s: rotor-frame currents in %s, amplitude-invariant, positive into the "
            "machine;\n",
            a, a, unit);
        hci_output_text(out,
                        " *         ia = iq sin(theta) - id cos(theta). iq > 0 makes positive torque, id > 0 "
                        "strengthens\n"
                        " *         the flux of the magnets.\n");
    }
}

/* Of recordings that were read with an offset. */
static void write_offset(double degrees, hci_output *out)
{
    char text[32];
    if (degrees == 0.0) return;
    hci_number_text(degrees, text);
    hci_output_text(
        out,
        " *         Of the angle of the logs theta = pole pairs * mechanical angle + (%s) degrees "
        "electrical\n"
        " *         (--angle-offset %s).\n",
        text, text);
}

void hci_emission_angle(const hci_emission *e, hci_output *out)
{
    const size_t turns = e->tabulation.period_turns;
    hci_output_text(
        out,
        " * Angle:  uint32_t, 2^32 = %zu electrical turn%s%s. theta = pole pairs * mechanical angle is 0 %s\n"
        " *         rotation a-b-c, the direction of positive torque.\n",
        turns, plural(turns), turns == 1 ? "" : " (period_turns)",
        e->request->facts.angle_of_logs
            ? "at\n"
              " *         the zero of the logs, which do not tell where phase a's back-EMF crosses zero: it "
              "was\n"
              " *         taken to rise through zero there. theta grows with"
            : "at\n"
              " *         the rising zero crossing of the fundamental of phase a's back-EMF and grows with");
    write_offset(e->request->facts.angle_offset_deg, out);
    if (turns > 1)
        hci_output_text(
            out,
            " *         Which of the pole pairs begins the table: the one at angle 0 of the recordings, as\n"
            " *         they were read (--angle-offset), and tables of the machine; hci/counter.h and "
            "`hci-solve check --table` say how to get "
            "there.\n");
    hci_output_text(
        out,
        " * Orders: electrical; mechanical order = electrical order * pole pairs. Amplitudes are peak.\n");
}

/* ---- facts of the machine ---- */

static void write_motor(const hci_emit_facts *f, hci_output *out)
{
    if (f->machine[0] == '\0' && f->pole_pairs == 0) return;
    hci_output_text(out, " * Motor:  %s", f->machine[0] ? f->machine : "name not known");
    if (f->pole_pairs > 0) hci_output_text(out, ", %zu pole pair%s", f->pole_pairs, plural(f->pole_pairs));
    hci_output_text(out, ".\n");
}

static void write_magnets(const hci_emit_facts *f, hci_output *out)
{
    char share[32], reference[32];
    if (f->emf_per_kelvin == 0.0) return;
    hci_output_text(
        out,
        " * Magnets: the machine's back-EMF is that of %s deg C and changes by %s %% a kelvin; so does\n"
        " *         what these currents make with it.\n",
        hci_emission_number(f->magnets_C, reference), hci_emission_number(100.0 * f->emf_per_kelvin, share));
}

/* One to a line. */
static void write_corrections(const hci_emit_facts *f, hci_output *out)
{
    const char *text = f->corrections;
    if (!*text) return;
    hci_output_text(
        out, " * Sensors: the currents are for the true angle and the true current. A drive with the\n"
             " *         sensors of the recordings has to correct what they read, in the order of these\n"
             " *         lines; the numbers are macros below:\n");
    while (*text) {
        const size_t length = strcspn(text, "\n");
        hci_output_text(out, " *           %.*s\n", (int)length, text);
        text += length + (text[length] == '\n');
    }
}

/* The frequency that a current loop has to follow, which bounds the speed. */
static void write_speed(const hci_emission *e, double highest, hci_output *out)
{
    const hci_emit_facts *f = &e->request->facts;
    char text[32];
    const double per_rpm_Hz = highest * (double)f->pole_pairs / 60.0;
    const double rated_rpm = f->rated_speed_rad_per_s * 30.0 / HCI_PI;
    hci_output_text(out, " * Loop:   has to follow up to %s times the electrical frequency%s",
                    hci_emission_number(highest, text),
                    e->request->frame == HCI_TABLE_ABC ? "" : ", in i_d and i_q");
    if (f->pole_pairs > 0) hci_output_text(out, ", %.0f Hz at 1000 rpm", 1000.0 * per_rpm_Hz);
    hci_output_text(out, ";\n *         above what it follows, fade out (hci/guard.h) or emit --drive.\n");
    if (rated_rpm > 0.0 && f->pole_pairs > 0)
        hci_output_text(out, " * Speed:  any that the loop follows; rated are %.5g rpm, %.0f Hz.\n",
                        rated_rpm, rated_rpm * per_rpm_Hz);
}

void hci_emission_facts_of_machine(const hci_emit_facts *facts, hci_output *out)
{
    write_motor(facts, out);
    write_magnets(facts, out);
    write_corrections(facts, out);
}

void hci_emission_facts(const hci_emission *e, hci_output *out)
{
    const hci_emit_facts *f = &e->request->facts;
    char text[32];
    hci_emission_facts_of_machine(f, out);
    if (e->tabulation.parts == 1 && f->mean_torque_Nm != 0.0)
        hci_output_text(out,
                        " * Torque: %s N*m of mean torque, and no other: emit --per-torque is for all.\n",
                        hci_emission_number(f->mean_torque_Nm, text));
    if (e->tabulation.parts == 2)
        hci_output_text(out, " * Torque: any up to the reference torque, to which it is limited; one that is "
                             "no number is none.\n");
    write_speed(e, hci_tabulation_highest_seen(&e->tabulation), out);
}

void hci_emission_ripple(const hci_emission *e, hci_output *out)
{
    const hci_table_ripple *r = &e->result.ripple[e->result.ripples > 1 ? 1 : 0];
    if (e->result.ripples > 0)
        hci_output_text(
            out,
            " * Ripple: the cut to this table makes %.3g N*m from peak to peak at %.4g N*m; with it "
            "%.3g N*m are\n *         left in the model of the machine.\n",
            r->own_Nm, r->torque_Nm, r->with_Nm);
}

void hci_emission_macros(const char *name, size_t pole_pairs, size_t turns, hci_output *out)
{
    if (pole_pairs == 0) return;
    hci_output_text(out, "#define %s_POLE_PAIRS %zuu\n", name, pole_pairs);
    if (pole_pairs % turns == 0)
        hci_output_text(out, "#define %s_PERIODS %zuu /* for hci_angle_from_mechanical */\n", name,
                        pole_pairs / turns);
    hci_output_text(out, "\n");
}

/* "1", or "0_5": an order in the name of a macro. */
static const char *order_name(double order, char text[32])
{
    hci_number_text(order, text);
    for (char *at = text; *at != '\0'; ++at)
        if (*at == '.' || *at == '-') *at = '_';
    return text;
}

static void write_macro(const char *name, const char *what, double value, const char *comment,
                        hci_output *out)
{
    hci_output_text(out, "#define %s_%s ", name, what);
    hci_emission_float(out, (float)value, "");
    hci_output_text(out, "%s\n", comment);
}

static void write_current_macros(const char *name, const hci_corrections *c, hci_output *out)
{
    char what[32];
    for (int s = 0; s < 3; ++s) {
        snprintf(what, sizeof what, "I%c_ZERO_A", "ABC"[s]);
        write_macro(name, what, c->zero_A[s], "", out);
        snprintf(what, sizeof what, "I%c_GAIN", "ABC"[s]);
        write_macro(name, what, c->gain[s], "", out);
        hci_output_text(out, "#define %s_TRUE_I%c(read_A) (((read_A) - %s_I%c_ZERO_A) * %s_I%c_GAIN)\n", name,
                        "ABC"[s], name, "ABC"[s], name, "ABC"[s]);
    }
}

static void write_angle_macros(const char *name, const hci_corrections *c, hci_output *out)
{
    char what[64], order[32];
    if (c->angle_zero_rad != 0.0)
        write_macro(name, "THETA_ZERO_RAD", c->angle_zero_rad, " /* electrical; theta = theta_read - this */",
                    out);
    for (size_t k = 0; k < c->waves; ++k) {
        const hci_angle_wave *w = &c->wave[k];
        snprintf(what, sizeof what, "THETA%s_%s%s_RAD", w->is_mechanical ? "_M" : "",
                 w->is_cosine ? "COS" : "SIN", order_name(w->order, order));
        write_macro(name, what, w->amplitude_rad,
                    w->is_mechanical ? " /* mechanical; theta_m = theta_m - this * the sine or cosine */"
                                     : " /* electrical; theta = theta - this * the sine or cosine */",
                    out);
    }
    if (c->load_rad_per_A != 0.0)
        write_macro(name, "THETA_RAD_PER_A", c->load_rad_per_A,
                    " /* electrical; theta = theta - this * i_q */", out);
}

void hci_emission_correction_macros(const char *name, const hci_corrections *c, hci_output *out)
{
    if (!c->has_currents && !c->has_angle) return;
    hci_output_text(out,
                    "/* Readings to true values: the lines of `Sensors` above, from top to bottom. */\n");
    if (c->has_currents) write_current_macros(name, c, out);
    if (c->has_angle) write_angle_macros(name, c, out);
    hci_output_text(out, "\n");
}

void hci_emission_input(const hci_emission *e, hci_output *out)
{
    hci_output_text(out, " * Input:  FNV-1a %016" PRIx64 "\n", e->request->input_hash);
    for (size_t k = 0; k < e->request->provenance_count; ++k)
        hci_output_text(out, " *         %s\n", e->request->provenance[k]);
    hci_output_text(out, " */\n");
}

void hci_emission_guard(const hci_emission *e, hci_output *out, const char *header, const char *macro,
                        int version)
{
    const char *name = e->request->name;
    hci_output_text(out, "#ifndef HCI_EMITTED_%s_H\n#define HCI_EMITTED_%s_H\n\n#include \"%s\"\n\n", name,
                    name, header);
    hci_output_text(out, "#if %s != %d\n#error \"%s needs version %d of %s\"\n#endif\n\n", macro, version,
                    name, version, header);
    hci_output_text(out, "#ifdef __cplusplus\nextern \"C\" {\n#endif\n\n");
}

void hci_emission_guard_end(hci_output *out)
{
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

void hci_emission_waves(const hci_emission *e, hci_output *out)
{
    const hci_tabulation *t = &e->tabulation;
    if (t->parts == 2) write_waves(out, "A(theta) in A/(N*m)", t->per_Nm, t->per_Nm_count);
    write_waves(out, t->parts == 2 ? "B(theta) in A" : "Currents in A", t->constant, t->constant_count);
}
