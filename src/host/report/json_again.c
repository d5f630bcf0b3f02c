#include "host/report/json_again.h"

#include <math.h>

static void put_played(hci_json *json, const hci_played *p)
{
    const bool is_known = p->currents != HCI_PLAYED_UNKNOWN;
    hci_json_text(json, "currents", hci_played_currents_name(p->currents));
    hci_json_number(json, "currents_rotation_rad", is_known ? p->rotation.rotation_rad : (double)NAN);
    hci_json_number(json, "currents_rotation_error_rad", is_known ? p->rotation.error_rad : (double)NAN);
    hci_json_number(json, "currents_gain", is_known ? p->rotation.gain : (double)NAN);
    hci_json_number(json, "currents_left", is_known ? p->rotation.left : (double)NAN);
    hci_json_number(json, "harmonics", is_known ? p->beside.harmonics : (double)NAN);
    hci_json_number(json, "harmonics_error", is_known ? p->beside.harmonics_error : (double)NAN);
    hci_json_number(json, "corrected", is_known ? p->beside.corrected : (double)NAN);
    hci_json_number(json, "corrected_error", is_known ? p->beside.corrected_error : (double)NAN);
    hci_json_number(json, "ripple_peak_to_peak_Nm", p->ripple_Nm);
    hci_json_number(json, "ripple_error_Nm", p->ripple_error_Nm);
    hci_json_number(json, "ripple_order", p->ripple_order);
    hci_json_text(json, "promise", hci_promise_name(p->promise));
}

static void put_run(hci_json *json, const hci_again_run *r)
{
    hci_json_object(json, NULL);
    hci_json_text(json, "file", r->file);
    hci_json_text(json, "role", r->role == HCI_ROLE_FIT ? "fit" : "holdout");
    hci_json_number(json, "rms_declared_Nm", r->declared_Nm);
    hci_json_number(json, "rms_last_Nm", r->last_Nm);
    hci_json_number(json, "error_mean_last_Nm", r->last_mean_Nm);
    hci_json_number(json, "ripple_last_Nm", r->last_ripple_Nm);
    hci_json_number(json, "bound_Nm_95", r->bound_Nm);
    hci_json_bool(json, "kept", r->kept);
    hci_json_number(json, "rms_now_Nm", r->now_Nm);
    hci_json_number(json, "noise_Nm", r->noise_Nm);
    put_played(json, &r->played);
    hci_json_close(json);
}

static void put_effect(hci_json *json, const hci_again_effect *e)
{
    hci_json_object(json, NULL);
    hci_json_text(json, "effect", e->effect);
    hci_json_text(json, "change", hci_again_change_name(e->change));
    if (e->change == HCI_AGAIN_LEFT)
        hci_json_text(json, "new_recordings_speak", hci_again_speaks_name(e->speaks));
    hci_json_bool(json, "was_ambiguous", e->was_ambiguous);
    hci_json_bool(json, "is_ambiguous", e->is_ambiguous);
    hci_json_number(json, "standard_errors", e->deviations);
    hci_json_text(json, "value", e->words);
    hci_json_close(json);
}

void hci_again_put(hci_json *json, const hci_again *a)
{
    char words[HCI_AGAIN_WORDS];
    hci_again_words(a, words, sizeof words);
    hci_json_object(json, "again");
    hci_json_text(json, "words", words);
    hci_json_number(json, "recordings_before", (double)a->recordings_before);
    hci_json_number(json, "with_bound", (double)a->bounded);
    hci_json_number(json, "within_bound", (double)a->kept);
    hci_json_number(json, "rms_declared_Nm", a->declared_Nm);
    hci_json_number(json, "rms_last_Nm", a->last_Nm);
    hci_json_number(json, "bound_Nm_95", a->bound_Nm);
    hci_json_number(json, "rms_now_Nm", a->now_Nm);
    hci_json_number(json, "noise_Nm", a->noise_Nm);
    hci_json_text(json, "solution", a->solved.folder);
    hci_json_number(json, "promised_peak_to_peak_Nm_95", a->solved.promised_Nm);
    hci_json_array(json, "new_runs");
    for (size_t k = 0; k < a->runs; ++k)
        put_run(json, &a->run[k]);
    hci_json_close(json);
    hci_json_array(json, "changes");
    for (size_t k = 0; k < a->effects; ++k)
        put_effect(json, &a->effect[k]);
    hci_json_close(json);
    hci_json_close(json);
}
