/* What `check` has found, as JSON. */
#include "host/report/summary.h"

static void put_texts(hci_json *json, const char *name, const char *const *text, size_t count)
{
    hci_json_array(json, name);
    for (size_t k = 0; k < count; ++k)
        hci_json_text(json, NULL, text[k]);
    hci_json_close(json);
}

static void put_finding(hci_json *json, const hci_check_finding *f)
{
    hci_json_object(json, NULL);
    hci_json_text(json, "slip", f->slip);
    hci_json_text(json, "file", f->file);
    hci_json_number(json, "line", (double)f->line);
    hci_json_text(json, "column", f->column);
    hci_json_text(json, "found", f->found);
    hci_json_text(json, "should_be", f->should_be);
    hci_json_number(json, "probability", f->probability);
    hci_json_text(json, "words", f->words);
    hci_json_text(json, "told_by", f->told_by);
    put_texts(json, "alternatives", f->alternative, f->alternatives);
    hci_json_close(json);
}

static void put_evidence(hci_json *json, const hci_check_evidence *e)
{
    hci_json_object(json, NULL);
    hci_json_text(json, "name", e->name);
    hci_json_text(json, "words", e->words);
    hci_json_number(json, "declared", e->declared);
    hci_json_number(json, "expected", e->expected);
    hci_json_bool(json, "at_most", e->at_most);
    hci_json_number(json, "as_read", e->as_read);
    hci_json_number(json, "tolerance", e->tolerance);
    hci_json_text(json, "state", hci_check_state_name(e->state));
    hci_json_close(json);
}

static void put_gap(hci_json *json, const hci_check_gap *g)
{
    hci_json_object(json, NULL);
    hci_json_text(json, "name", g->name);
    hci_json_text(json, "words", g->words);
    hci_json_text(json, "needs", g->needs);
    hci_json_close(json);
}

static void put_lists(hci_json *json, const hci_check *c)
{
    hci_json_array(json, "findings");
    for (size_t k = 0; k < c->findings; ++k)
        put_finding(json, &c->finding[k]);
    hci_json_close(json);
    hci_json_array(json, "evidence");
    for (size_t k = 0; k < c->evidences; ++k)
        put_evidence(json, &c->evidence[k]);
    hci_json_close(json);
    hci_json_array(json, "unchecked");
    for (size_t k = 0; k < c->gaps; ++k)
        put_gap(json, &c->gap[k]);
    hci_json_close(json);
    put_texts(json, "untold", c->untold, c->untolds);
}

static void put_remark(hci_json *json, const char *read, const hci_note *remark)
{
    if (!remark->text[0]) return;
    hci_json_object(json, NULL);
    hci_json_text(json, "run", read);
    hci_json_text(json, "remark", remark->text);
    hci_json_close(json);
}

/* One for the machine and each recording that has something to say. */
static void put_remarks(hci_json *json, const hci_check *c)
{
    hci_json_array(json, "remarks");
    put_remark(json, c->machine, &c->machine_remark);
    for (size_t k = 0; k < c->runs; ++k)
        put_remark(json, c->run[k], &c->remark[k]);
    hci_json_close(json);
}

char *hci_check_json(const hci_check *check)
{
    hci_json json;
    hci_summary_begin(&json, "check");
    hci_json_text(&json, "machine", check->machine);
    put_texts(&json, "runs", check->run, check->runs);
    put_remarks(&json, check);
    hci_json_text(&json, "verdict", hci_check_verdict_name(check->verdict));
    hci_json_number(&json, "probability_as_declared", check->probability_as_declared);
    hci_json_number(&json, "zero_e_rad", check->zero_rad);
    hci_json_number(&json, "zero_error_e_rad", check->zero_error_rad);
    hci_json_number(&json, "drive_zero_e_rad", check->drive_zero_rad);
    hci_json_number(&json, "drive_zero_reach_e_rad", check->drive_zero_reach_rad);
    hci_json_number(&json, "saliency_H", check->saliency_H);
    hci_json_number(&json, "saliency_at_load_H", check->saliency_at_load_H);
    hci_json_number(&json, "scale_left_open", check->scale_left_open);
    put_lists(&json, check);
    return hci_json_end(&json);
}

char *hci_table_rotation_json(const hci_table_rotation *x)
{
    hci_json json;
    hci_summary_begin(&json, "check");
    hci_json_bool(&json, "found", x->is_found);
    hci_json_bool(&json, "rotated", x->is_rotated);
    hci_json_bool(&json, "harmonics_seen", x->is_seen);
    hci_json_number(&json, "harmonics", x->harmonics);
    hci_json_number(&json, "harmonics_error", x->harmonics_error);
    hci_json_number(&json, "rotation_e_rad", x->rotation_rad);
    hci_json_number(&json, "error_e_rad", x->error_rad);
    hci_json_number(&json, "step_e_rad", x->step_rad);
    hci_json_bool(&json, "of_index", x->of_index);
    hci_json_bool(&json, "backwards", x->backwards);
    hci_json_number(&json, "gain", x->gain);
    hci_json_number(&json, "left_as_is", x->left_as_is);
    hci_json_number(&json, "left", x->left);
    hci_json_number(&json, "left_elsewhere", x->left_elsewhere);
    hci_json_number(&json, "period_electrical_turns", (double)x->period_turns);
    hci_json_number(&json, "pole_pairs_seen", (double)x->pole_pairs_seen);
    hci_json_number(&json, "samples", (double)x->samples);
    return hci_json_end(&json);
}

static void put_axes(hci_json *json, const char *name, const double value[2])
{
    hci_json_object(json, name);
    hci_json_number(json, "d", value[0]);
    hci_json_number(json, "q", value[1]);
    hci_json_close(json);
}

static void put_response(hci_json *json, const hci_drive_facts *f)
{
    hci_json_object(json, "response");
    hci_json_number(json, "frequencies", (double)f->response_count);
    hci_json_number(json, "off", f->response_off);
    hci_json_number(json, "off_at_Hz", f->response_off_Hz);
    hci_json_text(json, "reading", hci_response_reading_name(f->reading));
    hci_json_number(json, "off_as_read", f->reading_off);
    hci_json_number(json, "value", f->reading_value);
    hci_json_close(json);
}

char *hci_drive_facts_json(const hci_drive_facts *f)
{
    hci_json json;
    hci_summary_begin(&json, "check");
    hci_json_number(&json, "current_sample_time_s", f->drive.sample_s);
    hci_json_number(&json, "computing_delay_s", f->drive.computing_delay_s);
    hci_json_number(&json, "current_kp_ohm", f->drive.kp_ohm);
    hci_json_number(&json, "current_ki_V_per_As", f->drive.ki_ohm_per_s);
    hci_json_number(&json, "current_kp_q_ohm", f->drive.kp_q_ohm);
    hci_json_number(&json, "current_ki_q_V_per_As", f->drive.ki_q_ohm_per_s);
    hci_json_number(&json, "current_filter_s", f->drive.filter_s);
    put_axes(&json, "inductance_H", f->inductance_H);
    put_axes(&json, "bandwidth_Hz", f->bandwidth_Hz);
    hci_json_number(&json, "lead_s", f->lead_s);
    hci_json_number(&json, "largest_pole", f->largest_pole);
    hci_json_number(&json, "peak_d", f->peak[0]);
    hci_json_number(&json, "peak_q", f->peak[1]);
    hci_json_number(&json, "gain_margin", f->gain_margin);
    hci_json_number(&json, "stable_rad_per_s", f->stable_rad_per_s);
    hci_json_number(&json, "sampled_rad_per_s", f->sampled_rad_per_s);
    hci_json_number(&json, "highest_order", f->highest_order);
    hci_json_number(&json, "dc_link_V", f->drive.dc_link_voltage_V);
    put_response(&json, f);
    return hci_json_end(&json);
}
