/* summary.json of `diagnose`. */
#include <math.h>

#include "hci/host/diagnose/again.h"
#include "host/diagnose/findings.h"
#include "host/report/json_again.h"
#include "host/report/summary.h"

enum { WORDS_SIZE = 2048 };

static void put_finding(hci_json *json, const hci_finding *f)
{
    hci_json_object(json, NULL);
    hci_json_text(json, "effect", f->effect);
    hci_json_text(json, "verdict", hci_finding_verdict_name(f->verdict));
    hci_json_number(json, "delta_bic", hci_finding_delta_bic(f));
    hci_json_number(json, "residual_share", f->residual_share);
    hci_json_text(json, "detail", f->detail);
    hci_json_number(json, "stays", f->left_out > 0 ? (double)f->stays : (double)NAN);
    hci_json_number(json, "left_out", f->left_out > 0 ? (double)f->left_out : (double)NAN);
    hci_json_close(json);
}

static void put_run(hci_json *json, const hci_run_errors *e)
{
    hci_json_object(json, NULL);
    hci_json_text(json, "file", e->file);
    hci_json_text(json, "role", e->role == HCI_ROLE_FIT ? "fit" : "holdout");
    hci_json_number(json, "mean_torque_Nm", e->mean_torque_Nm);
    hci_json_number(json, "rms_before_Nm", e->rms_before_Nm);
    hci_json_number(json, "rms_after_Nm", e->rms_after_Nm);
    hci_json_number(json, "rms_after_low_Nm", e->after_low_Nm);
    hci_json_number(json, "rms_after_high_Nm", e->after_high_Nm);
    hci_json_number(json, "noise_floor_Nm", e->noise_floor_Nm);
    hci_json_number(json, "error_mean_before_Nm", e->error_mean_before_Nm);
    hci_json_number(json, "error_mean_after_Nm", e->error_mean_after_Nm);
    hci_json_number(json, "ripple_before_Nm", e->ripple_before_Nm);
    hci_json_number(json, "ripple_after_Nm", e->ripple_after_Nm);
    hci_json_number(json, "index_slip_rad", e->slip_rad);
    hci_json_close(json);
}

static void put_unexplained(hci_json *json, const hci_unexplained *u)
{
    hci_json_object(json, NULL);
    hci_json_number(json, "order", u->order);
    hci_json_number(json, "sine_Nm", u->sine_Nm);
    hci_json_number(json, "cosine_Nm", u->cosine_Nm);
    hci_json_number(json, "current_exponent", u->current_exponent);
    hci_json_number(json, "speed_exponent", u->speed_exponent);
    hci_json_bool(json, "turns_sign", u->turns_sign);
    hci_json_number(json, "amplitude_Nm", u->amplitude_Nm);
    hci_json_close(json);
}

static void put_swing(hci_json *json, const hci_free_swing *x)
{
    hci_json_object(json, NULL);
    hci_json_bool(json, "of_turn", x->of_turn);
    hci_json_number(json, "frequency", x->frequency);
    hci_json_number(json, "error", x->error);
    hci_json_number(json, "amplitude_Nm", x->amplitude_Nm);
    hci_json_number(json, "runs", (double)x->runs);
    hci_json_close(json);
}

static void put_next_point(hci_json *json, const hci_next_point *p)
{
    hci_json_object(json, NULL);
    hci_json_number(json, "id_A", p->id_A);
    hci_json_number(json, "iq_A", p->iq_A);
    hci_json_number(json, "speed_rad_per_s", p->speed_rad_per_s);
    hci_json_number(json, "turns", p->turns);
    hci_json_text(json, "why", p->why);
    hci_json_text(json, "test", hci_next_test_name(p->source));
    hci_json_number(json, "chi_square", p->chi_square > 0.0 ? p->chi_square : (double)NAN);
    hci_json_close(json);
}

static void put_currents(hci_json *json, const char *name, const hci_torque_evaluation *j,
                         const hci_solution *s)
{
    hci_json_object(json, name);
    hci_json_number(json, "mean_Nm", j->mean_Nm);
    hci_json_number(json, "rms_error_Nm", j->rms_error_Nm);
    hci_json_number(json, "T_ripple_percent", j->T_ripple_percent);
    hci_json_number(json, "F_ripple_percent", j->F_ripple_percent);
    hci_json_number(json, "mean_square_A2", s->mean_square_A2);
    hci_json_close(json);
}

static void put_lists(hci_json *json, const hci_diagnosis *d)
{
    hci_json_array(json, "effects");
    for (size_t k = 0; k < d->findings; ++k)
        put_finding(json, &d->finding[k]);
    hci_json_close(json);
    hci_json_array(json, "runs");
    for (size_t k = 0; k < d->runs; ++k)
        put_run(json, &d->run[k]);
    hci_json_close(json);
    hci_json_array(json, "unexplained");
    for (size_t k = 0; k < d->unexplained_count; ++k)
        put_unexplained(json, &d->unexplained[k]);
    hci_json_close(json);
    hci_json_array(json, "swings");
    for (size_t k = 0; k < d->swings; ++k)
        put_swing(json, &d->swing[k]);
    hci_json_close(json);
    hci_json_number(json, "drifts", (double)d->drifts);
    hci_json_number(json, "drift_Nm", d->drift_Nm);
    hci_json_array(json, "measure_next_points");
    for (size_t k = 0; k < d->next_points; ++k)
        put_next_point(json, &d->next[k]);
    hci_json_close(json);
}

static void put_errors(hci_json *json, const hci_diagnosis *d)
{
    hci_json_number(json, "rms_before_Nm", d->rms_before_Nm);
    hci_json_number(json, "rms_after_Nm", d->rms_after_Nm);
    hci_json_number(json, "noise_Nm", d->noise_Nm);
    hci_json_number(json, "holdout_rms_before_Nm", d->holdout_before_Nm);
    hci_json_number(json, "holdout_rms_after_Nm", d->holdout_after_Nm);
    hci_json_number(json, "holdout_noise_Nm", d->holdout_noise_Nm);
    hci_json_number(json, "holdout_error_mean_before_Nm", d->holdout_mean_before_Nm);
    hci_json_number(json, "holdout_error_mean_after_Nm", d->holdout_mean_after_Nm);
    hci_json_number(json, "holdout_ripple_before_Nm", d->holdout_ripple_before_Nm);
    hci_json_number(json, "holdout_ripple_after_Nm", d->holdout_ripple_after_Nm);
}

char *hci_diagnosis_json(const hci_diagnosis *d, const hci_resolution *r)
{
    char words[WORDS_SIZE];
    hci_json json;
    hci_diagnosis_words(d, words, sizeof words);
    hci_summary_begin(&json, "diagnose");
    hci_json_text(&json, "verdict", hci_diagnosis_verdict_name(d->verdict));
    hci_json_text(&json, "search", hci_diagnosis_search_name(d->search));
    hci_json_text(&json, "words", words);
    hci_json_text(&json, "measure_next", d->advice);
    put_errors(&json, d);
    hci_json_bool(&json, "contradicted_by_holdout", d->contradicted);
    hci_json_bool(&json, "does_not_repeat", d->wanders);
    hci_json_bool(&json, "magnetic_only", d->magnetic_only);
    hci_json_text(&json, "disagrees", d->odd.file && !d->odd.is_aside ? d->odd.file : "");
    hci_json_text(&json, "set_aside", d->odd.is_aside ? d->odd.file : "");
    const bool is_mean = fabs(d->odd.mean_Nm) > 0.0;
    hci_json_number(&json, "disagrees_mean_Nm", is_mean ? d->odd.mean_Nm : (double)NAN);
    hci_json_number(&json, "disagrees_mean_error_Nm", is_mean ? d->odd.mean_error_Nm : (double)NAN);
    hci_json_number(&json, "disagrees_mean_open_Nm", is_mean ? d->odd.mean_open_Nm : (double)NAN);
    hci_json_text(&json, "left_out", d->disbelieved ? d->disbelieved : "");
    put_lists(&json, d);
    if (d->again) hci_again_put(&json, d->again);
    if (r) put_currents(&json, "old_currents", &r->old_currents, &r->before);
    if (r) put_currents(&json, "new_currents", &r->new_currents, &r->after);
    if (r) hci_summary_expected(&json, &r->after.expected);
    return hci_json_end(&json);
}
