/* Currents for a drive to C. In: machine, drive, currents at levels of torque; out: NAME.h and NAME.c for
 * hci/loop.h. */
#include "hci/host/emit/emit_loop.h"

#include <inttypes.h>
#include <math.h>
#include <stdio.h>

#include "hci/version.h"
#include "host/drive/between_levels.h"
#include "host/drive/loop_set.h"
#include "host/emit/blob_loop.h"
#include "host/emit/request.h"
#include "host/emit/text.h"

typedef struct {
    const hci_emit_loop_request *request;
    hci_loop_set set;
    hci_between_levels between;
} emission;

/* ---- words ---- */

static void write_title(const emission *e, hci_output *out, const char *extension)
{
    hci_output_text(out, "/* %s.%s: currents for a drive, order by order, for hci/loop.h.\n",
                    e->request->name, extension);
    hci_output_text(out,
                    " * Written by hci-solve " HCI_VERSION_STRING "; emit it again rather than edit it.\n"
                    " * SPDX-License-Identifier: MIT\n");
}

static void write_use(const emission *e, hci_output *out)
{
    const char *name = e->request->name;
    hci_output_text(
        out,
        " *\n"
        " * Start:   static float memory[%s_FLOATS];\n"
        " *          static hci_loop_tables tables;\n"
        " *          hci_loop_start(&tables, &%s, HCI_LOOP_FEEDFORWARD, memory);\n"
        " *          hci_loop_make(&tables, speed);\n"
        " * Sample:  hci_loop_reference r = hci_loop_at(&tables, angle, torque_Nm, speed);\n"
        " *          r.id_A, r.iq_A to the current loop, r.vd_V, r.vq_V added to its output.\n"
        " * Speed:   electrical, rad/s; hci_loop_make again where hci_loop_is_old says so, in the\n"
        " *          background and into tables that are not in use.\n",
        name, name);
    hci_output_text(
        out,
        " * Angle:   uint32_t, 2^32 = %" PRIu32 " electrical turn%s. theta = pole pairs * mechanical "
        "angle is 0 at\n"
        " *          the rising zero crossing of the fundamental of phase a's back-EMF and grows\n"
        " *          with rotation a-b-c, the direction of positive torque.\n",
        e->set.loop.period_turns, e->set.loop.period_turns == 1 ? "" : "s");
    hci_output_text(out, " * Axes:    amplitude-invariant; ia = iq sin(theta) - id cos(theta). iq > 0 makes "
                         "positive torque,\n"
                         " *          id > 0 strengthens the flux of the magnets.\n");
}

static void write_rpm(hci_output *out, const char *what, double speed_rad_per_s)
{
    char text[32];
    if (isfinite(speed_rad_per_s))
        hci_output_text(out, "%s%s rpm", what,
                        hci_emission_number(floor(speed_rad_per_s * 30.0 / HCI_PI * (1.0 + 1e-6)), text));
    else
        hci_output_text(out, "%sany speed", what);
}

/* One level is what it is: nobody should find that out on the shaft. */
static void write_levels(const hci_loop_f32 *loop, hci_output *out)
{
    char low[32], high[32];
    hci_emission_number((double)loop->torque_low_Nm, low);
    hci_emission_number((double)loop->torque_high_Nm, high);
    if (loop->levels == 1)
        hci_output_text(
            out,
            " * Torque:  1 level, %s N*m whatever is asked for, 0 and negative too; what is no number is\n"
            " *          no current. --per-torque, or several levels, follow what is asked for.\n",
            low);
    else
        hci_output_text(out, " * Torque:  %" PRIu32 " levels, %s to %s N*m; what is outside is clamped.\n",
                        loop->levels, low, high);
}

static void write_between(const hci_between_levels *x, hci_output *out)
{
    if (isnan(x->ripple_Nm)) return;
    hci_output_text(
        out,
        " *          Between levels the mean is up to %.2g N*m off, at %.4g N*m, and there is up to\n"
        " *          %.2g N*m more ripple, peak to peak, at %.4g N*m.\n",
        fabs(x->mean_off_Nm), x->mean_at_Nm, x->ripple_Nm, x->ripple_at_Nm);
}

static void write_figures(const emission *e, hci_output *out)
{
    const hci_loop_f32 *loop = &e->set.loop;
    char low[32], high[32];
    write_levels(loop, out);
    write_between(&e->between, out);
    hci_output_text(out, " * Error:   a table of %" PRIu32 " points is within %s A of its waves, of %s A.\n",
                    loop->points, hci_emission_number(e->set.max_error_A, low),
                    hci_emission_number(e->set.peak_A, high));
    hci_output_text(out, " * Speed:   a dc link of %s V",
                    hci_emission_number(e->request->drive->dc_link_voltage_V, low));
    write_rpm(out, " does for all orders up to ", e->set.voltage_rad_per_s);
    write_rpm(out, ", the sampling up to ", e->set.sampled_rad_per_s);
    hci_output_text(out,
                    ".\n *          Above that an order ends where it does no good any more: another dc "
                    "link\n *          wants another table.\n * CRC-32:  %08" PRIx32
                    " (IEEE 802.3) of the waves.\n",
                    loop->crc32);
    hci_output_text(out, " * Input:   FNV-1a %016" PRIx64 "\n */\n", e->request->input_hash);
}

static void write_header(const emission *e, hci_output *out)
{
    const char *name = e->request->name;
    write_title(e, out, "h");
    write_use(e, out);
    hci_emission_facts_of_machine(&e->request->facts, out);
    write_figures(e, out);
    hci_output_text(out, "#ifndef HCI_EMITTED_%s_H\n#define HCI_EMITTED_%s_H\n\n#include \"hci/loop.h\"\n\n",
                    name, name);
    hci_output_text(out,
                    "#if HCI_LOOP_VERSION != %d\n#error \"%s needs version %d of hci/loop.h\"\n#endif\n\n",
                    HCI_LOOP_VERSION, name, HCI_LOOP_VERSION);
    hci_emission_macros(name, e->request->facts.pole_pairs, e->set.loop.period_turns, out);
    hci_emission_correction_macros(name, &e->request->facts.correction_values, out);
    hci_output_text(out,
                    "/* Floats of RAM for any remedy; %" PRIu32 " do without HCI_LOOP_FEEDFORWARD. */\n"
                    "#define %s_FLOATS %" PRIu32 "u\n\n",
                    hci_loop_floats(&e->set.loop, HCI_LOOP_LEAD), name,
                    hci_loop_floats(&e->set.loop, HCI_LOOP_FEEDFORWARD));
    hci_output_text(out, "#ifdef __cplusplus\nextern \"C\" {\n#endif\n\nextern const hci_loop_f32 %s;\n\n",
                    name);
    hci_output_text(out, "#ifdef __cplusplus\n}\n#endif\n\n#endif\n");
}

/* ---- numbers ---- */

static void write_pairs(hci_output *out, const hci_loop_pair pair[2], const char *end)
{
    for (int a = 0; a < 2; ++a) {
        hci_output_text(out, "%s{", a == 0 ? "{" : " ");
        hci_emission_float(out, pair[a].c, ", ");
        hci_emission_float(out, pair[a].s, a == 0 ? "}," : "}}");
    }
    hci_output_text(out, "%s", end);
}

static void write_waves(const emission *e, hci_output *out)
{
    const hci_loop_f32 *loop = &e->set.loop;
    const uint32_t count = loop->order_count * loop->levels;
    hci_output_text(
        out,
        "/* For each order, and for each level of torque: current in A, voltage without R i in V*s, and\n"
        " * what the drive's own decoupling adds in V*s; of each d and q, cosine and sine. */\n"
        "static const hci_loop_wave %s_waves[%" PRIu32 "] = {\n",
        e->request->name, count);
    for (uint32_t k = 0; k < count; ++k) {
        hci_output_text(out, "    {");
        write_pairs(out, loop->waves[k].current_A, ",\n     ");
        write_pairs(out, loop->waves[k].voltage_Vs, ",\n     ");
        write_pairs(out, loop->waves[k].own_Vs, "},\n");
    }
    hci_output_text(out, "};\n\n");
}

static void write_orders(const emission *e, hci_output *out)
{
    const hci_loop_f32 *loop = &e->set.loop;
    const char *name = e->request->name;
    hci_output_text(out, "static const uint16_t %s_orders[%" PRIu32 "] = {", name, loop->order_count);
    for (uint32_t k = 0; k < loop->order_count; ++k)
        hci_output_text(out, "%s%" PRIu16 "u", k == 0 ? "" : ", ", loop->orders[k]);
    hci_output_text(
        out,
        "};\n\n/* Electrical speeds in rad/s up to which an order is whole, and from which on it is "
        "not used. */\n"
        "static const hci_loop_range %s_ranges[%" PRIu32 "] = {\n",
        name, loop->order_count);
    for (uint32_t k = 0; k < loop->order_count; ++k) {
        hci_output_text(out, "    {");
        hci_emission_float(out, loop->ranges[k].whole_rad_per_s, ", ");
        hci_emission_float(out, loop->ranges[k].none_rad_per_s, "},\n");
    }
    hci_output_text(out, "};\n\n");
}

static void write_responses(const emission *e, hci_output *out)
{
    const hci_loop_f32 *loop = &e->set.loop;
    if (loop->response_count == 0) return;
    hci_output_text(out,
                    "/* frequency in rad/s; real parts of d and q, imaginary parts in A/V */\n"
                    "static const hci_loop_response %s_responses[%" PRIu32 "] = {\n",
                    e->request->name, loop->response_count);
    for (uint32_t k = 0; k < loop->response_count; ++k) {
        const hci_loop_response *r = &loop->responses[k];
        hci_output_text(out, "    {");
        hci_emission_float(out, r->frequency_rad_per_s, ", {");
        hci_emission_float(out, r->re[0], ", ");
        hci_emission_float(out, r->re[1], "}, {");
        hci_emission_float(out, r->im[0], ", ");
        hci_emission_float(out, r->im[1], "}},\n");
    }
    hci_output_text(out, "};\n\n");
}

static void write_count(hci_output *out, uint32_t count, const char *name)
{
    hci_output_text(out, "    %" PRIu32 "u, /* %s */\n", count, name);
}

static void write_value(hci_output *out, float value, const char *name)
{
    hci_output_text(out, "    ");
    hci_emission_float(out, value, ", /* ");
    hci_output_text(out, "%s */\n", name);
}

static void write_axes(hci_output *out, const float value[2], const char *name)
{
    hci_output_text(out, "    {");
    hci_emission_float(out, value[0], ", ");
    hci_emission_float(out, value[1], "}, /* ");
    hci_output_text(out, "%s */\n", name);
}

static void write_values(const hci_loop_f32 *loop, hci_output *out)
{
    write_value(out, loop->base_order, "base_order");
    write_value(out, loop->torque_low_Nm, "torque_low_Nm");
    write_value(out, loop->torque_high_Nm, "torque_high_Nm");
    write_value(out, loop->resistance_ohm, "resistance_ohm");
    write_axes(out, loop->inductance_H, "inductance_H");
    write_axes(out, loop->proportional_ohm, "proportional_ohm");
    write_axes(out, loop->integral_ohm_per_s, "integral_ohm_per_s");
    write_value(out, loop->filter, "filter");
    write_value(out, loop->sample_s, "sample_s");
    write_value(out, loop->delay_s, "delay_s");
    write_value(out, loop->whole_rad_per_s, "whole_rad_per_s");
    write_value(out, loop->lead_s, "lead_s");
    hci_output_text(out, "    0x%08" PRIX32 "u /* crc32 */\n};\n", loop->crc32);
}

static void write_loop(const emission *e, hci_output *out)
{
    const hci_loop_f32 *loop = &e->set.loop;
    const char *name = e->request->name;
    hci_output_text(out, "const hci_loop_f32 %s = {\n    %s_waves,\n    %s_orders,\n    %s_ranges,\n", name,
                    name, name, name);
    if (loop->response_count > 0)
        hci_output_text(out, "    %s_responses,\n", name);
    else
        hci_output_text(out, "    0, /* responses */\n");
    write_count(out, loop->order_count, "order_count");
    write_count(out, loop->response_count, "response_count");
    write_count(out, loop->levels, "levels");
    write_count(out, loop->points, "points");
    write_count(out, loop->repeats, "repeats");
    write_count(out, loop->period_turns, "period_turns");
    write_values(loop, out);
}

static void write_source(const emission *e, hci_output *out)
{
    write_title(e, out, "c");
    hci_output_text(out, " * Conventions and figures: %s.h.\n */\n#include \"%s.h\"\n\n", e->request->name,
                    e->request->name);
    write_waves(e, out);
    write_orders(e, out);
    write_responses(e, out);
    write_loop(e, out);
}

/* ---- all of it ---- */

static void write_blob(const emission *e, hci_output *out)
{
    hci_emit_loop_blob(&e->set.loop, e->request, out);
}

/* One that an earlier run left holds others. */
static hci_status without_blob(const emission *e, hci_output *out, hci_note *note)
{
    char file[HCI_EMIT_NAME_LENGTH + 8];
    snprintf(file, sizeof file, "%s.bin", e->request->name);
    return hci_output_without(out, file, note);
}

static hci_status write_file(const emission *e, hci_output *out, const char *extension,
                             void (*write)(const emission *, hci_output *), hci_note *note)
{
    char file[HCI_EMIT_NAME_LENGTH + 8];
    snprintf(file, sizeof file, "%s.%s", e->request->name, extension);
    const hci_status status = hci_output_file(out, file, note);
    if (!status) write(e, out);
    return status;
}

static hci_status write_files(const emission *e, const char *folder, hci_note *note)
{
    hci_output *out;
    hci_status status = hci_output_open(folder, &out, note);
    if (status) return status;
    status = write_file(e, out, "h", write_header, note);
    if (!status) status = write_file(e, out, "c", write_source, note);
    if (!status)
        status = e->request->blob ? write_file(e, out, "bin", write_blob, note) : without_blob(e, out, note);
    if (!status) return hci_output_commit(out, note);
    hci_output_discard(out);
    return status;
}

/* The speed asked for, or the highest at which all orders are whole. */
static double told_speed(const hci_loop_set *set, const hci_loop_task *task)
{
    const double end = fmin(set->measured_rad_per_s, fmin(set->voltage_rad_per_s, set->sampled_rad_per_s));
    return task->speed_rad_per_s > 0.0 ? task->speed_rad_per_s : isfinite(end) ? end : 0.0;
}

static hci_emit_loop_result result_of(const hci_loop_set *set, const hci_loop_task *task)
{
    const double told_rad_per_s = told_speed(set, task);
    const hci_loop_f32 *loop = &set->loop;
    return (hci_emit_loop_result){
        .orders = loop->order_count,
        .levels = loop->levels,
        .points = loop->points,
        .repeats = loop->repeats,
        .period_turns = loop->period_turns,
        .highest_order = hci_loop_set_highest_order(set),
        .coarse_mean_Nm = hci_loop_set_coarse_mean_Nm(set, task, (double)loop->torque_high_Nm),
        .dc_link_V = task->drive->dc_link_voltage_V,
        .flash_bytes = (size_t)loop->order_count * (loop->levels * 48 + 10) + loop->response_count * 20 + 96,
        .ram_bytes = (size_t)hci_loop_floats(loop, HCI_LOOP_LEAD) * 4,
        .feedforward_ram_bytes = (size_t)hci_loop_floats(loop, HCI_LOOP_FEEDFORWARD) * 4,
        .max_error_A = set->max_error_A,
        .peak_A = set->peak_A,
        .torque_low_Nm = (double)loop->torque_low_Nm,
        .torque_high_Nm = (double)loop->torque_high_Nm,
        .lead_s = (double)loop->lead_s,
        .voltage_rad_per_s = set->voltage_rad_per_s,
        .sampled_rad_per_s = set->sampled_rad_per_s,
        .measured_rad_per_s = set->measured_rad_per_s,
        .response_error = hci_loop_set_response_error(set),
        .response_ripple_percent =
            hci_loop_set_response_percent(set, task, task->level_count - 1, told_rad_per_s),
        .response_rad_per_s = told_rad_per_s,
        .crc32 = loop->crc32};
}

/* Where there are levels to be between, and it is asked for. */
static hci_status find_between(emission *e, hci_note *note)
{
    const hci_emit_loop_request *r = e->request;
    hci_machine_plant plant = {0};
    e->between = (hci_between_levels){NAN, NAN, NAN, NAN};
    if (!r->machine_folder || e->set.loop.levels < 2) return HCI_OK;
    hci_status status = hci_machine_plant_make(r->machine_folder, r->machine, &plant, note);
    if (!status) status = hci_between_levels_find(&e->set, &plant, &e->between, note);
    hci_machine_plant_release(&plant);
    return status;
}

hci_status hci_emit_loop(const char *folder, const hci_emit_loop_request *request,
                         hci_emit_loop_result *result, hci_note *note)
{
    emission e = {.request = request};
    hci_machine_data fitted;
    hci_effects_data effects = {.list = {NULL, 0}};
    hci_status status = hci_emit_check_name(request->name, note);
    if (!status) status = hci_emit_check_facts(&request->facts, note);
    if (!status) status = hci_drive_fit(request->drive, request->machine, &fitted, note);
    if (!status && request->speed_rad_per_s > 0.0)
        status = hci_drive_check_speed(request->drive, &fitted, request->speed_rad_per_s, note);
    const hci_loop_task task = {&fitted,
                                request->drive,
                                request->levels,
                                request->level_count,
                                request->max_error_A,
                                request->speed_rad_per_s,
                                &effects.list};
    if (!status && request->machine_folder)
        status = hci_effects_read_machine(request->machine_folder, &effects, note);
    if (!status) status = hci_loop_set_make(&task, &e.set, note);
    if (!status) status = find_between(&e, note);
    if (!status) status = write_files(&e, folder, note);
    if (!status && result) {
        *result = result_of(&e.set, &task);
        result->between = e.between;
    }
    hci_loop_set_release(&e.set);
    hci_effects_release(&effects);
    return status;
}
