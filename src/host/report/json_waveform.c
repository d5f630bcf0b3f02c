/* What `harmonics` has measured, as JSON. */
#include "host/report/summary.h"

static void put_order(hci_json *json, const hci_waveform_order *o)
{
    hci_json_object(json, NULL);
    hci_json_number(json, "order", o->order);
    hci_json_number(json, "amplitude", o->amplitude);
    hci_json_number(json, "phase_rad", o->phase_rad);
    hci_json_number(json, "std_error", o->std_error);
    hci_json_number(json, "chance", o->chance);
    hci_json_bool(json, "kept", o->kept);
    hci_json_close(json);
}

static void put_channel(hci_json *json, const hci_waveform_channel *c)
{
    hci_json_object(json, NULL);
    hci_json_text(json, "channel", c->name);
    hci_json_number(json, "offset_V", c->offset_V);
    hci_json_number(json, "offset_error_V", c->offset_error_V);
    hci_json_number(json, "ratio_to_others", c->ratio);
    hci_json_number(json, "ratio_error", c->ratio_error);
    hci_json_number(json, "phase_error_rad", c->phase_error_rad);
    hci_json_number(json, "phase_error_std_error_rad", c->phase_error);
    hci_json_bool(json, "left_out", c->left_out);
    hci_json_close(json);
}

/* Only a back-EMF has three channels. */
static void put_lists(hci_json *json, const hci_waveform *w)
{
    hci_json_array(json, "orders");
    for (size_t k = 0; k < w->count; ++k)
        put_order(json, &w->order[k]);
    hci_json_close(json);
    if (w->quantity != HCI_WAVEFORM_BACK_EMF) return;
    hci_json_array(json, "channels");
    for (int s = 0; s < 3; ++s)
        put_channel(json, &w->channel[s]);
    hci_json_close(json);
}

static const char *source_of_errors(const hci_waveform *w)
{
    return w->between_turns ? "turns" : w->step > 0.0 ? "orders_around" : "residual";
}

char *hci_waveform_json(const hci_waveform *w)
{
    const bool emf = w->quantity == HCI_WAVEFORM_BACK_EMF;
    hci_json json;
    hci_summary_begin(&json, "harmonics");
    hci_json_text(&json, "quantity", emf ? "back_emf" : "cogging");
    hci_json_text(&json, "unit", emf ? "Nm_per_A" : "Nm");
    hci_json_number(&json, "kept", (double)w->kept);
    hci_json_number(&json, "turns_forward", (double)w->turns_forward);
    hci_json_number(&json, "turns_backward", (double)w->turns_backward);
    hci_json_text(&json, "errors_from", source_of_errors(w));
    hci_json_number(&json, "mean_Nm", w->mean_Nm);
    hci_json_number(&json, "friction_Nm", w->friction_Nm);
    hci_json_number(&json, "friction_std_error_Nm", w->friction_error_Nm);
    hci_json_number(&json, "frequency_Hz", w->frequency_Hz);
    hci_json_number(&json, "drift_Hz_per_s", w->drift_Hz_per_s);
    hci_json_number(&json, "speed_rad_per_s", w->speed_rad_per_s);
    put_lists(&json, w);
    hci_json_text(&json, "remark", w->remark.text);
    return hci_json_end(&json);
}
