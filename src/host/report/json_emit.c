/* What `emit` has made, as JSON: a table, and orders for a drive. */
#include <math.h>

#include "host/report/summary.h"

static void add_choice(hci_json *json, const hci_emit_choice *c)
{
    hci_json_text(json, "format", hci_emit_format_name(c->format));
    hci_json_text(json, "shape", hci_emit_shape_name(c->shape));
    hci_json_number(json, "points", (double)c->points);
    hci_json_number(json, "bytes", (double)c->bytes);
    hci_json_number(json, "max_error_A", c->max_error_A);
    hci_json_number(json, "instructions_cortex_m4f", c->cortex_m4f);
    hci_json_number(json, "instructions_cortex_m0_plus", c->cortex_m0_plus);
}

/* At each torque: of the plain sine, with the table, and what of that the table makes. */
static void add_ripples(hci_json *json, const hci_emit_result *result)
{
    hci_json_array(json, "ripple");
    for (size_t k = 0; k < result->ripples; ++k) {
        hci_json_object(json, NULL);
        hci_json_number(json, "torque_Nm", result->ripple[k].torque_Nm);
        hci_json_number(json, "sine_peak_to_peak_Nm", result->ripple[k].sine_Nm);
        hci_json_number(json, "table_peak_to_peak_Nm", result->ripple[k].with_Nm);
        hci_json_number(json, "table_own_peak_to_peak_Nm", result->ripple[k].own_Nm);
        hci_json_close(json);
    }
    hci_json_close(json);
}

/* All that were weighed. */
static void add_choices(hci_json *json, const hci_emit_result *result)
{
    hci_json_array(json, "choices");
    for (size_t k = 0; k < result->choices; ++k) {
        hci_json_object(json, NULL);
        add_choice(json, &result->choice[k]);
        hci_json_bool(json, "fits", result->choice[k].fits);
        hci_json_close(json);
    }
    hci_json_close(json);
}

char *hci_emit_json(const hci_emit_request *request, const hci_emit_result *result)
{
    hci_json json;
    hci_summary_begin(&json, "emit");
    hci_json_text(&json, "name", request->name);
    hci_json_text(&json, "frame", request->frame == HCI_TABLE_ABC ? "abc" : "dq");
    add_choice(&json, &result->chosen);
    hci_json_number(&json, "columns", (double)result->columns);
    hci_json_number(&json, "parts", (double)result->parts);
    hci_json_number(&json, "period_electrical_turns", (double)result->period_turns);
    hci_json_number(&json, "sectors", (double)result->sectors);
    hci_json_number(&json, "unit_A", result->unit_A);
    hci_json_number(&json, "peak_A", result->peak_A);
    hci_json_number(&json, "crc32", result->crc32);
    add_ripples(&json, result);
    add_choices(&json, result);
    return hci_json_end(&json);
}

/* What stands in the table, and what it takes of the controller. */
static void add_loop_table(hci_json *json, const hci_emit_loop_result *r)
{
    hci_json_number(json, "orders", (double)r->orders);
    hci_json_number(json, "highest_order", r->highest_order);
    hci_json_number(json, "levels", (double)r->levels);
    hci_json_number(json, "torque_low_Nm", r->torque_low_Nm);
    hci_json_number(json, "torque_high_Nm", r->torque_high_Nm);
    hci_json_number(json, "points", (double)r->points);
    hci_json_number(json, "repeats", (double)r->repeats);
    hci_json_number(json, "period_electrical_turns", (double)r->period_turns);
    hci_json_number(json, "flash_bytes", (double)r->flash_bytes);
    hci_json_number(json, "ram_bytes", (double)r->ram_bytes);
    hci_json_number(json, "feedforward_ram_bytes", (double)r->feedforward_ram_bytes);
    hci_json_number(json, "max_error_A", r->max_error_A);
    hci_json_number(json, "peak_A", r->peak_A);
}

/* At which speed something is lost, and what stays between the levels. */
static void add_loop_limits(hci_json *json, const hci_emit_loop_result *r)
{
    hci_json_number(json, "lead_s", r->lead_s);
    hci_json_number(json, "coarse_angle_mean_Nm", r->coarse_mean_Nm);
    hci_json_number(json, "dc_link_V", r->dc_link_V);
    hci_json_number(json, "voltage_rpm", r->voltage_rad_per_s * 30.0 / HCI_PI);
    hci_json_number(json, "sampled_rpm", r->sampled_rad_per_s * 30.0 / HCI_PI);
    hci_json_number(json, "measured_rpm", r->measured_rad_per_s * 30.0 / HCI_PI);
    hci_json_number(json, "response_error", r->response_error);
    hci_json_number(json, "response_ripple", r->response_ripple_percent);
    hci_json_number(json, "response_rpm", r->response_rad_per_s * 30.0 / HCI_PI);
    hci_json_number(json, "between_mean_off_Nm", r->between.mean_off_Nm);
    hci_json_number(json, "between_mean_at_Nm", r->between.mean_at_Nm);
    hci_json_number(json, "between_ripple_Nm", r->between.ripple_Nm);
    hci_json_number(json, "between_ripple_at_Nm", r->between.ripple_at_Nm);
}

char *hci_emit_loop_json(const hci_emit_loop_request *request, const hci_emit_loop_result *r)
{
    hci_json json;
    hci_summary_begin(&json, "emit");
    hci_json_text(&json, "name", request->name);
    add_loop_table(&json, r);
    add_loop_limits(&json, r);
    hci_json_number(&json, "crc32", r->crc32);
    return hci_json_end(&json);
}

/* At each torque: without the drive's map, and with it. */
static void add_foreign_ripples(hci_json *json, const hci_emit_foreign_result *r)
{
    hci_json_array(json, "ripple");
    for (size_t k = 0; k < r->ripples; ++k) {
        hci_json_object(json, NULL);
        hci_json_number(json, "torque_Nm", r->ripple[k].torque_Nm);
        hci_json_number(json, "sine_peak_to_peak_Nm", r->ripple[k].without_Nm);
        hci_json_number(json, "map_peak_to_peak_Nm", r->ripple[k].with_Nm);
        hci_json_number(json, "map_mean_Nm", r->ripple[k].mean_Nm);
        hci_json_close(json);
    }
    hci_json_close(json);
}

char *hci_emit_foreign_json(const hci_emit_foreign_request *request, const hci_emit_foreign_result *r)
{
    hci_json json;
    hci_summary_begin(&json, "emit");
    hci_json_text(&json, "name", request->name);
    hci_json_text(&json, "target", hci_foreign_word(request->target));
    hci_json_text(&json, "files", r->files);
    hci_json_text(&json, "holds", r->carries);
    hci_json_text(&json, "lacks", r->lacks);
    hci_json_text(&json, "form", r->samples);
    hci_json_text(&json, "unit", hci_foreign_is_torque(request->target) ? "Nm" : "A");
    hci_json_number(&json, "points", (double)r->points);
    hci_json_number(&json, "terms", (double)r->terms);
    hci_json_number(&json, "step", r->unit > 0.0 ? r->unit : (double)NAN);
    hci_json_number(&json, "peak", r->peak);
    hci_json_number(&json, "cut", (double)r->cut);
    hci_json_number(&json, "left_out", (double)r->left_out);
    hci_json_number(&json, "left_out_amplitude", r->left_out_amplitude);
    hci_json_number(&json, "torque_Nm", r->torque_Nm);
    hci_json_number(&json, "torque_constant_Nm_per_A", r->torque_constant_Nm_per_A);
    add_foreign_ripples(&json, r);
    return hci_json_end(&json);
}
