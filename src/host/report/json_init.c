/* What `init` has made of a data sheet, as JSON. */
#include <math.h>

#include "host/report/summary.h"

/* The back-EMF of the sheet in all the words that data sheets have for it. */
static void put_constants(hci_json *json, const hci_sheet *s)
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
    hci_json_number(json, "back_emf_Vs_per_rad", emf);
    for (size_t k = 0; k < sizeof SHOWN / sizeof *SHOWN; ++k)
        hci_json_number(json, SHOWN[k].key, hci_sheet_value(SHOWN[k].reading, emf, s->pole_pairs));
}

static void put_files(hci_json *json, const hci_sheet *s)
{
    hci_json_array(json, "files");
    hci_json_text(json, NULL, "machine.csv");
    hci_json_text(json, NULL, "back_emf.csv");
    if (s->slots > 0) hci_json_text(json, NULL, "cogging.csv");
    if (hci_sheet_is_salient(s)) hci_json_text(json, NULL, "inductance.csv");
    hci_json_close(json);
}

char *hci_init_json(const hci_sheet *s)
{
    const double order = s->slots > 0 ? hci_cogging_order(s->slots, s->pole_pairs) : (double)NAN;
    hci_note remark;
    hci_json json;
    hci_sheet_remark(s, &remark);
    hci_summary_begin(&json, "init");
    hci_json_number(&json, "pole_pairs", s->pole_pairs);
    hci_json_number(&json, "sheet_value", s->strength);
    hci_json_text(&json, "sheet_unit", hci_sheet_unit(s->reading));
    hci_json_text(&json, "sheet_reading", hci_sheet_meaning(s->reading));
    put_constants(&json, s);
    hci_json_number(&json, "resistance_ohm", hci_sheet_resistance_ohm(s));
    hci_json_number(&json, "rated_current_A", hci_sheet_current_A(s));
    hci_json_number(&json, "cogging_order", order);
    put_files(&json, s);
    hci_json_text(&json, "remark", remark.text);
    return hci_json_end(&json);
}
