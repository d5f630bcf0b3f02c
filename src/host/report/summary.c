/* Summaries as JSON. The only file that knows cJSON. */
#include <cjson/cJSON.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "hci/host/report/summary.h"
#include "hci/version.h"
#include "host/base/memory.h"
#include "host/report/report.h"

/* JSON has no NaN: a number that does not exist is null. False when memory is out. */
static bool add_number(cJSON *object, const char *name, double value)
{
    return (isfinite(value) ? cJSON_AddNumberToObject(object, name, value)
                            : cJSON_AddNullToObject(object, name)) != NULL;
}

static bool add_text(cJSON *object, const char *name, const char *text)
{
    return cJSON_AddStringToObject(object, name, text) != NULL;
}

static bool add_order(cJSON *list, const hci_solved_order *o)
{
    cJSON *item = cJSON_CreateObject();
    bool good = item && cJSON_AddItemToArray(list, item) && add_number(item, "order", o->torque_Nm.order) &&
                add_number(item, "error_Nm", o->error_Nm) &&
                add_text(item, "verdict", hci_order_verdict_name(o->verdict));
    if (good && hci_remedy_exists(o)) {
        cJSON *remedy = cJSON_AddObjectToObject(item, "remedy");
        good = remedy && add_number(remedy, "order", o->remedy.order) &&
               add_text(remedy, "set",
                        o->remedy.sequence > 0   ? "pos"
                        : o->remedy.sequence < 0 ? "neg"
                                                 : "zero");
    }
    return good;
}

/* Orders of one kind as an array of their numbers, or with what there is to say of each. */
static bool add_orders(cJSON *root, const char *name, const hci_solution *s, hci_order_verdict first,
                       hci_order_verdict last, bool with_detail)
{
    cJSON *list = cJSON_AddArrayToObject(root, name);
    bool good = list != NULL;
    for (size_t k = 0; k < s->order_count && good; ++k) {
        const hci_solved_order *o = &s->order[k];
        cJSON *number;
        if (o->verdict < first || o->verdict > last) continue;
        if (with_detail) {
            good = add_order(list, o);
            continue;
        }
        number = cJSON_CreateNumber(o->torque_Nm.order);
        good = number && cJSON_AddItemToArray(list, number);
    }
    return good;
}

static bool add_system(cJSON *root, const hci_solution *s)
{
    cJSON *system = cJSON_AddObjectToObject(root, "system");
    return system && add_text(system, "method", hci_method_name(s->method)) &&
           add_number(system, "rows", (double)s->rows) &&
           add_number(system, "unknowns", (double)s->unknowns) &&
           add_number(system, "rank", (double)s->rank) && add_number(system, "condition", s->condition) &&
           add_number(system, "newton_steps", (double)s->newton_steps) &&
           add_number(system, "newton_change", s->newton_change) &&
           cJSON_AddBoolToObject(system, "newton_converged", s->newton_steps == 0 || s->newton_converged);
}

/* Angles at which a strategy has no current. */
static bool add_gaps(cJSON *root, const hci_solution *s)
{
    cJSON *gaps = cJSON_AddObjectToObject(root, "angles_without_current");
    cJSON *list = gaps ? cJSON_AddArrayToObject(gaps, "ranges_rad") : NULL;
    bool good = list && add_number(gaps, "count", (double)s->gap_count) &&
                add_number(gaps, "least_iq_A", s->least_iq_A);
    for (size_t k = 0; k < s->gap_count && k < HCI_MOST_GAPS && good; ++k) {
        const double ends[2] = {s->gap[k].from_rad, s->gap[k].to_rad};
        cJSON *range = cJSON_CreateDoubleArray(ends, 2);
        good = range && cJSON_AddItemToArray(list, range);
    }
    return good;
}

static bool add_current(cJSON *root, const hci_solution *s)
{
    cJSON *current = cJSON_AddObjectToObject(root, "current");
    return current && add_number(current, "components", (double)s->current.count) &&
           add_number(current, "peak_phase_A", s->peak_phase_current_A) &&
           add_number(current, "peak_line_voltage_V", s->peak_line_voltage_V) &&
           cJSON_AddBoolToObject(current, "within_limits", s->within_limits) &&
           add_number(current, "torque_at_limit_Nm", s->torque_at_limit_Nm) &&
           add_number(current, "mean_square_A2", s->mean_square_A2) &&
           add_number(current, "plain_amplitude_A", s->plain_amplitude_A) &&
           add_number(current, "loss_ratio_to_plain", s->loss_to_plain) &&
           add_number(current, "limit_mean_square_A2", s->limit_mean_square_A2) &&
           add_number(current, "loss_ratio_to_limit", s->loss_to_limit);
}

static bool add_torque(cJSON *root, const hci_solution *s)
{
    cJSON *torque = cJSON_AddObjectToObject(root, "torque");
    const bool has_mean = s->order_count > 0 && s->order[0].torque_Nm.order < HCI_ORDER_TOLERANCE;
    return torque && add_number(torque, "mean_Nm", has_mean ? s->order[0].torque_Nm.cosine : 0.0) &&
           add_number(torque, "worst_error_Nm", s->worst_error_Nm) &&
           add_number(torque, "worst_order", s->worst_order) &&
           add_number(torque, "tolerance_Nm", s->tolerance_Nm) &&
           add_number(torque, "period_electrical_turns", (double)s->period_turns) &&
           add_orders(torque, "reached_orders", s, HCI_ORDER_REACHED, HCI_ORDER_REACHED, false) &&
           add_orders(torque, "free_orders", s, HCI_ORDER_FREE, HCI_ORDER_FREE, false) &&
           add_orders(torque, "missed_orders", s, HCI_ORDER_MISSED, HCI_ORDER_MISSED, true) &&
           add_orders(torque, "parasitic_orders", s, HCI_ORDER_PARASITIC, HCI_ORDER_PARASITIC, true) &&
           add_orders(torque, "unreachable_orders", s, HCI_ORDER_UNREACHABLE, HCI_ORDER_UNREACHABLE, true);
}

char *hci_solution_json(const hci_solution *solution, hci_status verdict)
{
    cJSON *root = cJSON_CreateObject();
    char *text = NULL;
    if (root && add_text(root, "command", "solve") && add_text(root, "version", HCI_VERSION_STRING) &&
        cJSON_AddBoolToObject(root, "reached", verdict == HCI_OK) && add_system(root, solution) &&
        add_gaps(root, solution) && add_torque(root, solution) && add_current(root, solution))
        text = cJSON_Print(root);
    cJSON_Delete(root);
    return text;
}

/* ---- diagnosis ---- */

static bool add_finding(cJSON *list, const hci_finding *f)
{
    cJSON *item = cJSON_CreateObject();
    return item && cJSON_AddItemToArray(list, item) && add_text(item, "effect", f->effect) &&
           add_text(item, "verdict", hci_finding_verdict_name(f->verdict)) &&
           add_number(item, "delta_bic", hci_report_delta_bic(f)) &&
           add_number(item, "residual_share", f->residual_share) && add_text(item, "detail", f->detail);
}

static bool add_run(cJSON *list, const hci_run_errors *e)
{
    cJSON *item = cJSON_CreateObject();
    return item && cJSON_AddItemToArray(list, item) && add_text(item, "file", e->file) &&
           add_text(item, "role", e->role == HCI_ROLE_FIT ? "fit" : "holdout") &&
           add_number(item, "mean_torque_Nm", e->mean_torque_Nm) &&
           add_number(item, "rms_before_Nm", e->rms_before_Nm) &&
           add_number(item, "rms_after_Nm", e->rms_after_Nm) &&
           add_number(item, "rms_after_low_Nm", e->after_low_Nm) &&
           add_number(item, "rms_after_high_Nm", e->after_high_Nm) &&
           add_number(item, "noise_floor_Nm", e->noise_floor_Nm) &&
           add_number(item, "index_slip_rad", e->slip_rad);
}

static bool add_unexplained(cJSON *list, const hci_unexplained *u)
{
    cJSON *item = cJSON_CreateObject();
    return item && cJSON_AddItemToArray(list, item) && add_number(item, "order", u->order) &&
           add_number(item, "sine_Nm", u->sine_Nm) && add_number(item, "cosine_Nm", u->cosine_Nm) &&
           add_number(item, "current_exponent", u->current_exponent) &&
           add_number(item, "speed_exponent", u->speed_exponent) &&
           cJSON_AddBoolToObject(item, "turns_sign", u->turns_sign) &&
           add_number(item, "amplitude_Nm", u->amplitude_Nm);
}

static bool add_currents(cJSON *root, const char *name, const hci_torque_evaluation *j, const hci_solution *s)
{
    cJSON *item = cJSON_AddObjectToObject(root, name);
    return item && add_number(item, "mean_Nm", j->mean_Nm) &&
           add_number(item, "rms_error_Nm", j->rms_error_Nm) &&
           add_number(item, "T_ripple_percent", j->T_ripple_percent) &&
           add_number(item, "F_ripple_percent", j->F_ripple_percent) &&
           add_number(item, "mean_square_A2", s->mean_square_A2);
}

static bool add_diagnosis_lists(cJSON *root, const hci_diagnosis *d)
{
    cJSON *findings = cJSON_AddArrayToObject(root, "effects"), *runs = cJSON_AddArrayToObject(root, "runs");
    cJSON *unexplained = cJSON_AddArrayToObject(root, "unexplained");
    bool good = findings && runs && unexplained;
    for (size_t k = 0; k < d->findings && good; ++k)
        good = add_finding(findings, &d->finding[k]);
    for (size_t k = 0; k < d->runs && good; ++k)
        good = add_run(runs, &d->run[k]);
    for (size_t k = 0; k < d->unexplained_count && good; ++k)
        good = add_unexplained(unexplained, &d->unexplained[k]);
    return good;
}

char *hci_diagnosis_json(const hci_diagnosis *d, const hci_resolution *r)
{
    char words[2048], *text = NULL;
    cJSON *root = cJSON_CreateObject();
    hci_diagnosis_words(d, words, sizeof words);
    if (root && add_text(root, "command", "diagnose") && add_text(root, "version", HCI_VERSION_STRING) &&
        add_text(root, "verdict", hci_diagnosis_verdict_name(d->verdict)) && add_text(root, "words", words) &&
        add_text(root, "measure_next", d->advice) && add_number(root, "rms_before_Nm", d->rms_before_Nm) &&
        add_number(root, "rms_after_Nm", d->rms_after_Nm) && add_number(root, "noise_Nm", d->noise_Nm) &&
        add_number(root, "holdout_rms_before_Nm", d->holdout_before_Nm) &&
        add_number(root, "holdout_rms_after_Nm", d->holdout_after_Nm) &&
        add_number(root, "holdout_noise_Nm", d->holdout_noise_Nm) &&
        cJSON_AddBoolToObject(root, "contradicted_by_holdout", d->contradicted) &&
        cJSON_AddBoolToObject(root, "does_not_repeat", d->wanders) && add_diagnosis_lists(root, d) &&
        (!r || (add_currents(root, "old_currents", &r->old_currents, &r->before) &&
                add_currents(root, "new_currents", &r->new_currents, &r->after))))
        text = cJSON_Print(root);
    cJSON_Delete(root);
    return text;
}

static bool add_table(cJSON *root, const hci_emit_request *request, const hci_emit_result *result)
{
    return add_text(root, "name", request->name) && add_text(root, "format", request->format) &&
           add_text(root, "frame", request->frame == HCI_TABLE_ABC ? "abc" : "dq") &&
           add_number(root, "points", (double)result->points) &&
           add_number(root, "columns", (double)result->columns) &&
           add_number(root, "parts", (double)result->parts) &&
           add_number(root, "period_electrical_turns", (double)result->period_turns) &&
           add_number(root, "bytes", (double)result->bytes) &&
           add_number(root, "max_error_A", result->max_error_A) &&
           add_number(root, "peak_A", result->peak_A) && add_number(root, "crc32", result->crc32);
}

char *hci_emit_json(const hci_emit_request *request, const hci_emit_result *result)
{
    cJSON *root = cJSON_CreateObject();
    char *text = NULL;
    if (root && add_text(root, "command", "emit") && add_text(root, "version", HCI_VERSION_STRING) &&
        add_table(root, request, result))
        text = cJSON_Print(root);
    cJSON_Delete(root);
    return text;
}

/* ---- a simulation ---- */

static cJSON *add_statistics(cJSON *root, const char *name, const char *unit, const hci_statistics *x)
{
    cJSON *object = cJSON_AddObjectToObject(root, name);
    const double value[] = {x->mean, x->rms, x->most, x->least};
    static const char *const NAME[] = {"mean", "rms", "max", "min"};
    bool good = object != NULL;
    for (int k = 0; k < 4 && good; ++k) {
        char key[48];
        snprintf(key, sizeof key, "%s_%s", NAME[k], unit);
        good = add_number(object, key, value[k]);
    }
    return good ? object : NULL;
}

static bool add_evaluation(cJSON *root, const hci_simulation *s)
{
    cJSON *part = cJSON_AddObjectToObject(root, "evaluation");
    return part && add_number(part, "step_s", s->step_s) && add_number(part, "from_s", s->from_s) &&
           add_number(part, "to_s", s->to_s) && add_number(part, "periods", (double)s->periods) &&
           add_number(part, "period_electrical_turns", (double)s->period_turns);
}

static bool add_torque_and_current(cJSON *root, const hci_simulation *s)
{
    cJSON *torque = add_statistics(root, "torque", "Nm", &s->torque_Nm), *current;
    if (!torque || !add_number(torque, "T_ripple", s->T_ripple_percent) ||
        !add_number(torque, "F_ripple", s->F_ripple_percent))
        return false;
    current = add_statistics(root, "current", "A", &s->current_A);
    return current && add_number(current, "peak_phase_A", s->peak_phase_A) &&
           add_number(current, "plain_amplitude_A", s->plain_amplitude_A) &&
           add_number(current, "loss_ratio_to_plain", s->loss_to_plain) &&
           add_number(current, "copper_loss_W", s->copper_W) &&
           add_statistics(root, "current_dqx", "A", &s->current_dqx_A) &&
           add_statistics(root, "speed", "rad_per_s", &s->speed_rad_per_s);
}

static bool add_control(cJSON *root, const hci_simulation *s)
{
    cJSON *part = cJSON_AddObjectToObject(root, "control");
    return part && add_number(part, "switching_frequency_Hz", s->switching_frequency_Hz) &&
           add_number(part, "samples", (double)s->samples) &&
           add_number(part, "samples_without_current", (double)s->without_current) &&
           add_number(part, "samples_limited", (double)s->limited) &&
           add_number(part, "samples_without_current_from_start", (double)s->without_current_from_start) &&
           add_number(part, "samples_limited_from_start", (double)s->limited_from_start);
}

static bool add_energy(cJSON *root, const hci_simulation *s)
{
    const hci_energies *j = &s->energy_J;
    cJSON *part = cJSON_AddObjectToObject(root, "energy");
    return part && add_number(part, "electrical_J", j->electrical) &&
           add_number(part, "copper_J", j->copper) && add_number(part, "stored_J", j->stored) &&
           add_number(part, "mechanical_J", j->mechanical) && add_number(part, "residual_J", j->residual) &&
           cJSON_AddBoolToObject(part, "balances", s->energy_balances) &&
           add_number(part, "load_J", j->load) && add_number(part, "friction_J", j->friction) &&
           add_number(part, "kinetic_J", j->kinetic);
}

char *hci_simulation_json(const hci_simulation *simulation)
{
    cJSON *root = cJSON_CreateObject();
    char *text = NULL;
    if (root && add_text(root, "command", "simulate") && add_text(root, "version", HCI_VERSION_STRING) &&
        add_evaluation(root, simulation) && add_torque_and_current(root, simulation) &&
        add_control(root, simulation) && add_energy(root, simulation))
        text = cJSON_Print(root);
    cJSON_Delete(root);
    return text;
}

/* ---- a prediction ---- */

static const char *source_name(hci_torque_source source)
{
    static const char *const NAME[] = {"none", "measured", "holding", "inertia"};
    return NAME[source];
}

static bool add_residual(cJSON *root, const hci_prediction *p)
{
    cJSON *part = cJSON_AddObjectToObject(root, "residual");
    return part && add_number(part, "mean_Nm", p->mean_residual_Nm) &&
           add_number(part, "rms_Nm", p->rms_residual_Nm) &&
           add_number(part, "worst_Nm", p->worst_residual_Nm) &&
           add_number(part, "worst_sample", (double)p->worst_sample);
}

char *hci_prediction_json(const hci_prediction *prediction)
{
    const hci_prediction *p = prediction;
    cJSON *root = cJSON_CreateObject(), *torque = NULL, *model = NULL;
    char *text = NULL;
    if (root && add_text(root, "command", "predict") && add_text(root, "version", HCI_VERSION_STRING) &&
        add_number(root, "samples", (double)p->count) &&
        add_text(root, "torque_source", source_name(p->source)))
        torque = cJSON_AddObjectToObject(root, "torque");
    if (torque && add_number(torque, "mean_Nm", p->mean_torque_Nm) &&
        add_number(torque, "ripple_rms_Nm", p->ripple_torque_Nm))
        model = cJSON_AddObjectToObject(root, "model");
    if (model && add_number(model, "mean_Nm", p->mean_model_Nm) &&
        add_number(model, "ripple_rms_Nm", p->ripple_model_Nm) && add_residual(root, p) &&
        add_text(root, "remark", p->remark.text))
        text = cJSON_Print(root);
    cJSON_Delete(root);
    return text;
}

/* ---- a measured waveform ---- */

static bool add_waveform_order(cJSON *list, const hci_waveform_order *o)
{
    cJSON *item = cJSON_CreateObject();
    return item && cJSON_AddItemToArray(list, item) && add_number(item, "order", o->order) &&
           add_number(item, "amplitude", o->amplitude) && add_number(item, "phase_rad", o->phase_rad) &&
           add_number(item, "std_error", o->std_error) && add_number(item, "chance", o->chance) &&
           cJSON_AddBoolToObject(item, "kept", o->kept);
}

static bool add_channel(cJSON *list, const hci_waveform_channel *c)
{
    cJSON *item = cJSON_CreateObject();
    return item && cJSON_AddItemToArray(list, item) && add_text(item, "channel", c->name) &&
           add_number(item, "offset_V", c->offset_V) &&
           add_number(item, "offset_error_V", c->offset_error_V) &&
           add_number(item, "ratio_to_others", c->ratio) && add_number(item, "ratio_error", c->ratio_error) &&
           add_number(item, "phase_error_rad", c->phase_error_rad) &&
           add_number(item, "phase_error_std_error_rad", c->phase_error) &&
           cJSON_AddBoolToObject(item, "left_out", c->left_out);
}

static bool add_waveform(cJSON *root, const hci_waveform *w)
{
    const bool emf = w->quantity == HCI_WAVEFORM_BACK_EMF;
    cJSON *orders = cJSON_AddArrayToObject(root, "orders"), *channels = NULL;
    bool good = orders != NULL;
    for (size_t k = 0; k < w->count && good; ++k)
        good = add_waveform_order(orders, &w->order[k]);
    if (good && emf) good = (channels = cJSON_AddArrayToObject(root, "channels")) != NULL;
    for (int s = 0; s < 3 && good && emf; ++s)
        good = add_channel(channels, &w->channel[s]);
    return good;
}

char *hci_waveform_json(const hci_waveform *waveform)
{
    const hci_waveform *w = waveform;
    const bool emf = w->quantity == HCI_WAVEFORM_BACK_EMF;
    cJSON *root = cJSON_CreateObject();
    char *text = NULL;
    if (root && add_text(root, "command", "harmonics") && add_text(root, "version", HCI_VERSION_STRING) &&
        add_text(root, "quantity", emf ? "back_emf" : "cogging") &&
        add_text(root, "unit", emf ? "Nm_per_A" : "Nm") && add_number(root, "kept", (double)w->kept) &&
        add_number(root, "turns_forward", (double)w->turns_forward) &&
        add_number(root, "turns_backward", (double)w->turns_backward) &&
        add_text(root, "errors_from",
                 w->between_turns ? "turns"
                 : w->step > 0.0  ? "orders_around"
                                  : "residual") &&
        add_number(root, "mean_Nm", w->mean_Nm) && add_number(root, "friction_Nm", w->friction_Nm) &&
        add_number(root, "friction_std_error_Nm", w->friction_error_Nm) &&
        add_number(root, "frequency_Hz", w->frequency_Hz) &&
        add_number(root, "drift_Hz_per_s", w->drift_Hz_per_s) &&
        add_number(root, "speed_rad_per_s", w->speed_rad_per_s) && add_waveform(root, w) &&
        add_text(root, "remark", w->remark.text))
        text = cJSON_Print(root);
    cJSON_Delete(root);
    return text;
}

/* ---- a check of conventions ---- */

static bool add_texts(cJSON *object, const char *name, const char *const *text, size_t count)
{
    cJSON *list = cJSON_AddArrayToObject(object, name);
    bool good = list != NULL;
    for (size_t k = 0; k < count && good; ++k) {
        cJSON *item = cJSON_CreateString(text[k]);
        good = item && cJSON_AddItemToArray(list, item);
    }
    return good;
}

static bool add_check_finding(cJSON *list, const hci_check_finding *f)
{
    cJSON *item = cJSON_CreateObject();
    bool good = item && cJSON_AddItemToArray(list, item) && add_text(item, "slip", f->slip) &&
                add_text(item, "file", f->file) && add_number(item, "line", (double)f->line) &&
                add_text(item, "column", f->column) && add_text(item, "found", f->found) &&
                add_text(item, "should_be", f->should_be) &&
                add_number(item, "probability", f->probability) && add_text(item, "words", f->words) &&
                add_text(item, "told_by", f->told_by);
    return good && add_texts(item, "alternatives", f->alternative, f->alternatives);
}

static bool add_check_evidence(cJSON *list, const hci_check_evidence *e)
{
    cJSON *item = cJSON_CreateObject();
    return item && cJSON_AddItemToArray(list, item) && add_text(item, "name", e->name) &&
           add_text(item, "words", e->words) && add_number(item, "declared", e->declared) &&
           add_number(item, "expected", e->expected) && cJSON_AddBoolToObject(item, "at_most", e->at_most) &&
           add_number(item, "as_read", e->as_read) && add_number(item, "tolerance", e->tolerance) &&
           add_text(item, "state", hci_check_state_name(e->state));
}

static bool add_check_gap(cJSON *list, const hci_check_gap *g)
{
    cJSON *item = cJSON_CreateObject();
    return item && cJSON_AddItemToArray(list, item) && add_text(item, "name", g->name) &&
           add_text(item, "words", g->words) && add_text(item, "needs", g->needs);
}

static bool add_check_lists(cJSON *root, const hci_check *c)
{
    cJSON *findings = cJSON_AddArrayToObject(root, "findings"),
          *evidence = cJSON_AddArrayToObject(root, "evidence"),
          *unchecked = cJSON_AddArrayToObject(root, "unchecked");
    bool good = findings && evidence && unchecked;
    for (size_t k = 0; k < c->findings && good; ++k)
        good = add_check_finding(findings, &c->finding[k]);
    for (size_t k = 0; k < c->evidences && good; ++k)
        good = add_check_evidence(evidence, &c->evidence[k]);
    for (size_t k = 0; k < c->gaps && good; ++k)
        good = add_check_gap(unchecked, &c->gap[k]);
    return good && add_texts(root, "untold", c->untold, c->untolds);
}

/* One for each recording that has something to say. */
static bool add_check_remarks(cJSON *root, const hci_check *c)
{
    cJSON *list = cJSON_AddArrayToObject(root, "remarks");
    bool good = list != NULL;
    for (size_t k = 0; k < c->runs && good; ++k) {
        if (!c->remark[k].text[0]) continue;
        cJSON *item = cJSON_CreateObject();
        good = item && cJSON_AddItemToArray(list, item) && add_text(item, "run", c->run[k]) &&
               add_text(item, "remark", c->remark[k].text);
    }
    return good;
}

char *hci_check_json(const hci_check *check)
{
    cJSON *root = cJSON_CreateObject();
    char *text = NULL;
    if (root && add_text(root, "command", "check") && add_text(root, "version", HCI_VERSION_STRING) &&
        add_text(root, "machine", check->machine) && add_texts(root, "runs", check->run, check->runs) &&
        add_check_remarks(root, check) && add_text(root, "verdict", hci_check_verdict_name(check->verdict)) &&
        add_number(root, "probability_as_declared", check->probability_as_declared) &&
        add_check_lists(root, check))
        text = cJSON_Print(root);
    cJSON_Delete(root);
    return text;
}

/* ---- data sheet ---- */

static bool add_constants(cJSON *root, const hci_sheet *s)
{
    static const struct {
        hci_sheet_reading reading;
        const char *key;
    } SHOWN[] = {
        {HCI_SHEET_TORQUE_PEAK, "torque_constant_peak_Nm_per_A"},
        {HCI_SHEET_TORQUE_RMS, "torque_constant_rms_Nm_per_A"},
        {HCI_SHEET_TORQUE_DC, "torque_constant_dc_Nm_per_A"},
        {HCI_SHEET_VOLT_LINE_RMS, "line_rms_V_per_krpm"},
        {HCI_SHEET_VOLT_LINE_PEAK, "line_peak_V_per_krpm"},
        {HCI_SHEET_KV_LINE_PEAK, "kv_line_peak_rpm_per_V"},
        {HCI_SHEET_FLUX, "flux_linkage_Wb"},
    };
    const double emf = hci_sheet_emf(s->reading, s->strength, s->pole_pairs);
    bool good = add_number(root, "back_emf_Vs_per_rad", emf);
    for (size_t k = 0; k < sizeof SHOWN / sizeof *SHOWN && good; ++k)
        good = add_number(root, SHOWN[k].key, hci_sheet_value(SHOWN[k].reading, emf, s->pole_pairs));
    return good;
}

static bool add_files(cJSON *root, bool cogging)
{
    cJSON *files = cJSON_AddArrayToObject(root, "files");
    return files && cJSON_AddItemToArray(files, cJSON_CreateString("machine.csv")) &&
           cJSON_AddItemToArray(files, cJSON_CreateString("back_emf.csv")) &&
           (!cogging || cJSON_AddItemToArray(files, cJSON_CreateString("cogging.csv")));
}

char *hci_init_json(const hci_sheet *s)
{
    const double order = s->slots > 0 ? hci_cogging_order(s->slots, s->pole_pairs) : (double)NAN;
    cJSON *root = cJSON_CreateObject();
    char *text = NULL;
    hci_note remark;
    hci_sheet_remark(s, &remark);
    if (root && add_text(root, "command", "init") && add_text(root, "version", HCI_VERSION_STRING) &&
        add_number(root, "pole_pairs", s->pole_pairs) && add_number(root, "sheet_value", s->strength) &&
        add_text(root, "sheet_unit", hci_sheet_unit(s->reading)) &&
        add_text(root, "sheet_reading", hci_sheet_meaning(s->reading)) && add_constants(root, s) &&
        add_number(root, "resistance_ohm", hci_sheet_resistance_ohm(s)) &&
        add_number(root, "rated_current_A", hci_sheet_current_A(s)) &&
        add_number(root, "cogging_order", order) && add_files(root, s->slots > 0) &&
        add_text(root, "remark", remark.text))
        text = cJSON_Print(root);
    cJSON_Delete(root);
    return text;
}

void hci_text_free(char *text)
{
    cJSON_free(text);
}
