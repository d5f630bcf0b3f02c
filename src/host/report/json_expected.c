/* What the real machine is expected to do: a part of several summaries. */
#include <math.h>

#include "host/report/summary.h"

static void put_range(hci_json *json, const char *name, hci_measured_range range)
{
    hci_json_array(json, name);
    hci_json_number(json, NULL, range.least);
    hci_json_number(json, NULL, range.most);
    hci_json_close(json);
}

static void put_ripple(hci_json *json, const hci_expected_ripple *e)
{
    hci_json_number(json, "T_ripple_percent_95", e->T_ripple_percent);
    hci_json_number(json, "T_ripple_percent_50", e->middle_percent);
    hci_json_number(json, "peak_to_peak_Nm_95", e->peak_to_peak_Nm);
    if (e->table_peak_to_peak_Nm > 0.0)
        hci_json_number(json, "table_peak_to_peak_Nm", e->table_peak_to_peak_Nm);
    if (e->angle_peak_to_peak_Nm > 0.0)
        hci_json_number(json, "angle_peak_to_peak_Nm", e->angle_peak_to_peak_Nm);
    if (e->loop_peak_to_peak_Nm > 0.0) hci_json_number(json, "loop_peak_to_peak_Nm", e->loop_peak_to_peak_Nm);
    hci_json_number(json, "error_peak_to_peak_Nm_95", e->error_peak_to_peak_Nm);
    hci_json_number(json, "mean_Nm", e->mean_Nm);
    hci_json_number(json, "mean_error_Nm_95", e->mean_error_Nm);
    hci_json_number(json, "worst_order", e->worst_order);
    hci_json_number(json, "worst_order_Nm_95", e->worst_order_Nm);
}

/* Where the currents are, and where it was measured. */
static void put_place(hci_json *json, const hci_expected_ripple *e)
{
    put_range(json, "id_A", e->id_A);
    put_range(json, "iq_A", e->iq_A);
    put_range(json, "measured_id_A", e->measured_id_A);
    put_range(json, "measured_iq_A", e->measured_iq_A);
    put_range(json, "measured_speed_rad_per_s", e->measured_speed_rad_per_s);
    hci_json_number(json, "outside_share", e->outside_share);
    hci_json_number(json, "outside_A", e->outside_A);
    hci_json_bool(json, "speed_outside", e->speed_outside);
    hci_json_number(json, "recordings", (double)e->recordings);
}

static void put_model(hci_json *json, const hci_expected_ripple *e)
{
    const bool has_origin = e->origin.verdict[0] != '\0';
    hci_json_object(json, "model");
    hci_json_text(json, "verdict", e->origin.verdict);
    hci_json_text(json, "search", e->origin.search);
    hci_json_number(json, "unexplained_ripple_Nm", has_origin ? e->origin.unexplained_Nm : (double)NAN);
    hci_json_number(json, "unbelievable_order", e->unbelievable_order);
    hci_json_number(json, "unbelievable_share", e->unbelievable_share);
    hci_json_bool(json, "doubtful", hci_expected_ripple_is_doubtful(e));
    hci_json_close(json);
}

void hci_summary_expected(hci_json *json, const hci_expected_ripple *e)
{
    hci_json_object(json, "expected");
    hci_json_bool(json, "known", e->state == HCI_RIPPLE_KNOWN);
    hci_json_text(json, "remark", hci_ripple_state_words(e->state));
    put_ripple(json, e);
    put_place(json, e);
    put_model(json, e);
    hci_json_close(json);
}
