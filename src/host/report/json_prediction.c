/* What `predict` has compared, as JSON. */
#include "host/report/summary.h"

static const char *source_name(hci_torque_source source)
{
    static const char *const NAME[] = {"none", "measured", "holding", "inertia"};
    return NAME[source];
}

static void put_mean_and_ripple(hci_json *json, const char *name, double mean_Nm, double ripple_Nm)
{
    hci_json_object(json, name);
    hci_json_number(json, "mean_Nm", mean_Nm);
    hci_json_number(json, "ripple_rms_Nm", ripple_Nm);
    hci_json_close(json);
}

char *hci_prediction_json(const hci_prediction *p)
{
    hci_json json;
    hci_summary_begin(&json, "predict");
    hci_json_number(&json, "samples", (double)p->count);
    hci_json_text(&json, "torque_source", source_name(p->source));
    put_mean_and_ripple(&json, "torque", p->mean_torque_Nm, p->ripple_torque_Nm);
    put_mean_and_ripple(&json, "model", p->mean_model_Nm, p->ripple_model_Nm);
    hci_json_object(&json, "residual");
    hci_json_number(&json, "mean_Nm", p->mean_residual_Nm);
    hci_json_number(&json, "rms_Nm", p->rms_residual_Nm);
    hci_json_number(&json, "worst_Nm", p->worst_residual_Nm);
    hci_json_number(&json, "worst_sample", (double)p->worst_sample);
    hci_json_close(&json);
    hci_json_number(&json, "peak_to_peak_Nm", p->peak_to_peak_Nm);
    hci_summary_expected(&json, &p->expected);
    hci_json_text(&json, "remark", p->remark.text);
    return hci_json_end(&json);
}
