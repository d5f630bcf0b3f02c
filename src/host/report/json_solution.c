/* summary.json of `solve`. */
#include <math.h>

#include "host/report/summary.h"

static void put_remedy(hci_json *json, hci_component remedy)
{
    hci_json_object(json, "remedy");
    hci_json_number(json, "order", remedy.order);
    hci_json_text(json, "set", remedy.sequence > 0 ? "pos" : remedy.sequence < 0 ? "neg" : "zero");
    hci_json_close(json);
}

static void put_order(hci_json *json, const hci_solved_order *o)
{
    hci_json_object(json, NULL);
    hci_json_number(json, "order", o->torque_Nm.order);
    hci_json_number(json, "error_Nm", o->error_Nm);
    hci_json_text(json, "verdict", hci_order_verdict_name(o->verdict));
    if (hci_remedy_exists(o)) put_remedy(json, o->remedy);
    hci_json_close(json);
}

/* Orders that are as they should be, by their numbers. */
static void put_good_orders(hci_json *json, const char *name, const hci_solution *s,
                            hci_order_verdict verdict)
{
    hci_json_array(json, name);
    for (size_t k = 0; k < s->order_count; ++k)
        if (s->order[k].verdict == verdict) hci_json_number(json, NULL, s->order[k].torque_Nm.order);
    hci_json_close(json);
}

/* Those that are not, with what there is to say of each. */
static void put_bad_orders(hci_json *json, const char *name, const hci_solution *s, hci_order_verdict verdict)
{
    hci_json_array(json, name);
    for (size_t k = 0; k < s->order_count; ++k)
        if (s->order[k].verdict == verdict) put_order(json, &s->order[k]);
    hci_json_close(json);
}

static void put_system(hci_json *json, const hci_solution *s)
{
    hci_json_object(json, "system");
    hci_json_text(json, "method", hci_method_name(s->method));
    hci_json_number(json, "rows", (double)s->rows);
    hci_json_number(json, "unknowns", (double)s->unknowns);
    hci_json_number(json, "rank", (double)s->rank);
    hci_json_number(json, "condition", s->condition);
    hci_json_number(json, "newton_steps", (double)s->newton_steps);
    hci_json_number(json, "newton_change", s->newton_change);
    hci_json_bool(json, "newton_converged", s->newton_steps == 0 || s->newton_converged);
    hci_json_close(json);
}

/* Angles at which a strategy has no current. */
static void put_gaps(hci_json *json, const hci_solution *s)
{
    hci_json_object(json, "angles_without_current");
    hci_json_array(json, "ranges_rad");
    for (size_t k = 0; k < s->gap_count && k < HCI_MOST_GAPS; ++k) {
        hci_json_array(json, NULL);
        hci_json_number(json, NULL, s->gap[k].from_rad);
        hci_json_number(json, NULL, s->gap[k].to_rad);
        hci_json_close(json);
    }
    hci_json_close(json);
    hci_json_number(json, "count", (double)s->gap_count);
    hci_json_number(json, "least_iq_A", s->least_iq_A);
    hci_json_close(json);
}

static void put_torque(hci_json *json, const hci_solution *s)
{
    const bool has_mean = s->order_count > 0 && s->order[0].torque_Nm.order < HCI_ORDER_TOLERANCE;
    hci_json_object(json, "torque");
    hci_json_number(json, "mean_Nm", has_mean ? s->order[0].torque_Nm.cosine : 0.0);
    hci_json_number(json, "T_ripple_percent", s->T_ripple_percent);
    hci_json_number(json, "T_ripple_before_percent", s->T_ripple_before_percent);
    hci_json_number(json, "worst_error_Nm", s->worst_error_Nm);
    hci_json_number(json, "worst_order", s->worst_order);
    hci_json_number(json, "tolerance_Nm", s->tolerance_Nm);
    hci_json_number(json, "period_electrical_turns", (double)s->period_turns);
    put_good_orders(json, "reached_orders", s, HCI_ORDER_REACHED);
    put_good_orders(json, "free_orders", s, HCI_ORDER_FREE);
    put_bad_orders(json, "missed_orders", s, HCI_ORDER_MISSED);
    put_bad_orders(json, "parasitic_orders", s, HCI_ORDER_PARASITIC);
    put_bad_orders(json, "unreachable_orders", s, HCI_ORDER_UNREACHABLE);
    hci_json_close(json);
}

static void put_current(hci_json *json, const hci_solution *s)
{
    hci_json_object(json, "current");
    hci_json_number(json, "components", (double)s->current.count);
    hci_json_number(json, "peak_phase_A", s->peak_phase_current_A);
    hci_json_number(json, "rms_phase_A", s->rms_phase_current_A);
    if (isfinite(s->rms_neutral_A)) {
        hci_json_number(json, "peak_neutral_A", s->peak_neutral_A);
        hci_json_number(json, "rms_neutral_A", s->rms_neutral_A);
    }
    hci_json_number(json, "peak_line_voltage_V", s->peak_line_voltage_V);
    hci_json_bool(json, "within_limits", s->within_limits);
    hci_json_number(json, "torque_at_limit_Nm", s->torque_at_limit_Nm);
    hci_json_number(json, "mean_square_A2", s->mean_square_A2);
    hci_json_number(json, "plain_amplitude_A", s->plain_amplitude_A);
    hci_json_number(json, "loss_ratio_to_plain", s->loss_to_plain);
    hci_json_number(json, "limit_mean_square_A2", s->limit_mean_square_A2);
    hci_json_number(json, "loss_ratio_to_limit", s->loss_to_limit);
    hci_json_close(json);
}

static void put_phase(hci_json *json, const char *name, const hci_limit *l, int phase)
{
    const bool all = phase < 0 || l->kind == HCI_LIMIT_COPPER;
    hci_json_text(json, name, all ? "all" : hci_limit_place_name(l, phase));
}

static void put_touches(hci_json *json, const hci_limit *l)
{
    hci_json_array(json, "touched_at");
    for (size_t k = 0; k < l->touch_count && k < HCI_MOST_TOUCHES; ++k) {
        hci_json_object(json, NULL);
        put_phase(json, "phase", l, l->touch[k].phase);
        hci_json_number(json, "theta_e_rad", l->touch[k].theta_rad);
        hci_json_close(json);
    }
    hci_json_close(json);
    hci_json_number(json, "touches", (double)l->touch_count);
}

static void put_limit(hci_json *json, const hci_limit *l)
{
    hci_json_object(json, NULL);
    hci_json_text(json, "kind", hci_limit_kind_name(l->kind));
    put_phase(json, "phase", l, l->phase);
    hci_json_number(json, "limit", l->limit);
    hci_json_number(json, "value", l->value);
    hci_json_bool(json, "declared", l->is_declared);
    hci_json_bool(json, "binds", l->binds);
    hci_json_number(json, "gain", l->gain);
    put_touches(json, l);
    hci_json_close(json);
}

/* "a", "ab": phases that are limited to no current; "" for none. */
static void put_open(hci_json *json, const hci_solution *s)
{
    char open[4] = "";
    for (size_t k = 0, n = 0; k < s->limit_count && n < 3; ++k) {
        const hci_limit *l = &s->limit[k];
        if (l->kind == HCI_LIMIT_CURRENT && l->phase >= 0 && !(l->limit > 0.0)) open[n++] = "abc"[l->phase];
    }
    hci_json_text(json, "open_phases", open);
}

/* What no phase may exceed: the largest of the limits of the peak current. */
static double phase_limit_A(const hci_solution *s)
{
    double most = (double)NAN;
    for (size_t k = 0; k < s->limit_count; ++k)
        if (s->limit[k].kind == HCI_LIMIT_CURRENT) most = fmax(most, s->limit[k].limit);
    return most;
}

static void put_limits(hci_json *json, const hci_solution *s)
{
    static const char *const MINIMISED[] = {"", "worst", "peak-to-peak", "rms"};
    hci_json_object(json, "limits");
    hci_json_text(json, "cost",
                  s->within_limits || s->limit_cost == HCI_COST_LIMITS ? hci_limit_cost_name(s->limit_cost)
                                                                       : "not kept");
    hci_json_number(json, "wanted_mean_Nm", s->wanted_mean_Nm);
    hci_json_text(json, "minimised", MINIMISED[s->minimised]);
    hci_json_number(json, "minimised_Nm", s->minimised_Nm);
    hci_json_number(json, "exceeded_share", s->exceeded_share);
    put_open(json, s);
    hci_json_number(json, "phase_current_A", phase_limit_A(s));
    hci_json_array(json, "limit");
    for (size_t k = 0; k < s->limit_count; ++k)
        put_limit(json, &s->limit[k]);
    hci_json_close(json);
    hci_json_close(json);
}

void hci_summary_loop(hci_json *json, const hci_loop_reach *l)
{
    const bool has_speed = isfinite(l->added_Nm);
    hci_json_object(json, "current_loop");
    hci_json_number(json, "adds_Nm", l->allowed_Nm);
    hci_json_number(json, "rpm_per_Hz", l->rpm_per_Hz);
    hci_json_number(json, "read_ahead_rpm_per_Hz", l->lead_rpm_per_Hz);
    hci_json_bool(json, "at_any_speed", isinf(l->rpm_per_Hz));
    hci_json_number(json, "bandwidth_Hz", l->bandwidth_Hz > 0.0 ? l->bandwidth_Hz : (double)NAN);
    hci_json_number(json, "speed_rpm", has_speed ? l->speed_rpm : (double)NAN);
    hci_json_number(json, "adds_at_speed_Nm", l->added_Nm);
    hci_json_number(json, "read_ahead_adds_at_speed_Nm", l->lead_added_Nm);
    hci_json_bool(json, "leaves_out_back_emf", l->leaves_out_back_emf);
    hci_json_close(json);
}

char *hci_solution_json(const hci_solution *solution, hci_status verdict)
{
    hci_json json;
    hci_summary_begin(&json, "solve");
    hci_json_bool(&json, "reached", verdict == HCI_OK);
    hci_json_object(&json, "machine");
    hci_json_text(&json, "name", solution->machine.name);
    hci_json_text(&json, "digest", solution->machine.digest);
    hci_json_close(&json);
    put_system(&json, solution);
    put_gaps(&json, solution);
    put_torque(&json, solution);
    put_current(&json, solution);
    put_limits(&json, solution);
    hci_summary_expected(&json, &solution->expected);
    hci_summary_loop(&json, &solution->loop);
    return hci_json_end(&json);
}
