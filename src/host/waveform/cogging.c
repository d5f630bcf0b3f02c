/* Cogging torque: the recorded torque less what the current makes, over the turns of both directions. */
#include <math.h>
#include <stdio.h>

#include "hci/math/harmonic.h"
#include "host/base/memory.h"
#include "host/numeric/statistics.h"
#include "host/recording/rotor_frame.h"
#include "host/waveform/task.h"

/* What is left of the torque when that of the current is taken away. */
static void cogging_values(const hci_waveform_task *t, double *value)
{
    const hci_run *run = t->run;
    const double constant =
        isnan(t->options->torque_constant_Nm_per_A) ? 0.0 : t->options->torque_constant_Nm_per_A;
    for (size_t k = 0; k < run->count; ++k) {
        value[k] = run->torque_Nm[k] - constant * hci_run_dq(run, t->options->pole_pairs, k).q;
    }
}

static hci_status refuse_no_torque(const hci_waveform_task *t)
{
    if (t->run->torque_is_typed)
        return hci_waveform_refuse(t, "the same torque in every row, typed or of a sensor that stands still",
                                   "torque_Nm as it was measured",
                                   "record it, or leave the column out, and where the current held the shaft "
                                   "or turned it slowly say "
                                   "--holding --torque-constant NM_PER_A (1 to get amperes)");
    return hci_waveform_refuse(
        t, "no torque", "torque_Nm",
        hci_waveform_current_rms(t->run) > 0.0
            ? "add the column, or where the current held the shaft or turned it slowly say "
              "--holding --torque-constant NM_PER_A (1 to get amperes)"
            : "add the column, or say which it is: --column torque_Nm=COLUMN");
}

static hci_status check_cogging(const hci_waveform_task *t)
{
    const bool constant = !isnan(t->options->torque_constant_Nm_per_A);
    if (t->run->theta_m_rad == NULL)
        return hci_waveform_refuse(t, "no angle", "theta_m_rad or theta_e_rad",
                                   "add the column, or say which it is: --column theta_m_deg=COLUMN");
    if (t->run->needs_inertia)
        return hci_waveform_refuse(
            t, "a speed that varies with the angle so fast that the inertia may answer the cogging torque",
            "a current that does", "give --inertia, which takes out what accelerates, or record more slowly");
    if (t->run->torque_Nm == NULL) return refuse_no_torque(t);
    if (t->run->torque_source == HCI_TORQUE_HOLDING && !constant)
        return hci_waveform_refuse(t, "a torque of 0 throughout, as of a rotor held by its current",
                                   "the torque constant to make torque of that current",
                                   "add --torque-constant NM_PER_A (1 to get amperes)");
    return HCI_OK;
}

/* Are the given orders multiples of a step? */
static bool orders_fit(const hci_waveform_options *o, double step)
{
    for (size_t k = 0; k < o->order_count; ++k) {
        const double multiple = o->orders[k] / step;
        if (fabs(multiple - round(multiple)) > HCI_ORDER_TOLERANCE / step) return false;
    }
    return true;
}

static hci_status fit_turns(const hci_waveform_task *t, const double *value, double *angle, double scale,
                            double step, hci_average *average)
{
    for (size_t k = 0; k < t->run->count; ++k)
        angle[k] = scale * t->run->theta_m_rad[k];
    const hci_average_samples samples = {angle, value, t->run->count, 1};
    return hci_waveform_average(t, &samples, step, average);
}

/* By mechanical turns where that is possible, else by electrical ones. */
static hci_status find_turns(const hci_waveform_task *t, const double *value, double *angle,
                             hci_average *average, double *step)
{
    const double p = t->options->pole_pairs;
    hci_status status = HCI_ERROR_SINGULAR;
    *step = 1.0 / p;
    if (t->run->turn_known && orders_fit(t->options, *step))
        status = fit_turns(t, value, angle, 1.0, *step, average);
    if (status != HCI_ERROR_SINGULAR) return status;
    *step = 1.0;
    return orders_fit(t->options, 1.0) ? fit_turns(t, value, angle, p, *step, average) : status;
}

static void remark_cogging(const hci_waveform_task *t)
{
    const hci_waveform *w = t->result;
    const double rms_A = hci_waveform_current_rms(t->run);
    if (isnan(t->options->torque_constant_Nm_per_A) && rms_A > 0.0)
        hci_note_add(&t->result->remark,
                     "currents of %.3g A rms flow, and their torque is in the waveform; give "
                     "--torque-constant to take that of i_q away",
                     rms_A);
    if (w->step >= 1.0 && t->options->pole_pairs > 1)
        hci_note_add(&t->result->remark,
                     t->run->turn_known
                         ? "no whole mechanical turn is covered: only whole electrical orders are told "
                           "apart"
                         : "the angle is electrical and wrapped: only whole electrical orders are told "
                           "apart");
    if (w->turns_forward + w->turns_backward > 0 && isnan(w->friction_Nm))
        hci_note_add(
            &t->result->remark,
            "only whole turns in one direction are used: friction is in their mean, and one that varies with "
            "the angle is among the orders");
}

static hci_status cogging_of(const hci_waveform_task *t, double *value, double *angle)
{
    hci_waveform *w = t->result;
    hci_average average = {.highest = 0};
    double step;
    cogging_values(t, value);
    hci_status status = find_turns(t, value, angle, &average, &step);
    if (!status) {
        w->friction_Nm = hci_average_half_difference(&average, 0, &w->friction_error_Nm);
        w->mean_Nm = hci_average_estimate(&average, 0, 0).mean.cosine;
        status = hci_waveform_take_orders(t, &average, 0, step);
    } else if (status == HCI_ERROR_SINGULAR && t->options->orders != NULL) {
        status = hci_waveform_fit_given(t, value, angle);
    } else if (status == HCI_ERROR_SINGULAR) {
        char found[120];
        snprintf(found, sizeof found,
                 "mechanical angles over %.3g deg, which do not go round an electrical turn",
                 hci_peak_to_peak(t->run->theta_m_rad, t->run->count) * 180.0 / HCI_PI);
        status = hci_waveform_refuse(
            t, found, "samples all around, without large gaps",
            "check the unit of the angle, record more of the turn, or name the orders to fit "
            "with --orders");
    }
    hci_average_release(&average);
    if (status == HCI_ERROR_MEMORY) return hci_waveform_memory(t);
    if (!status) remark_cogging(t);
    return status;
}

hci_status hci_waveform_cogging(const hci_waveform_task *t)
{
    hci_status status = check_cogging(t);
    if (status) return status;
    double *value = hci_memory_new(t->run->count, sizeof *value);
    double *angle = hci_memory_new(t->run->count, sizeof *angle);
    status = value != NULL && angle != NULL ? cogging_of(t, value, angle) : hci_waveform_memory(t);
    hci_memory_free(value);
    hci_memory_free(angle);
    return status;
}
