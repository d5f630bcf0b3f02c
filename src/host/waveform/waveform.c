#include "hci/host/waveform/waveform.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "hci/host/base/output.h"
#include "hci/machine/frames.h"
#include "hci/math/dense.h"
#include "hci/math/fourier.h"
#include "host/base/memory.h"
#include "host/base/quote.h"
#include "host/waveform/parts.h"

/* Of all orders looked at, noise is to make one in so many recordings. */
#define FALSE_SHARE 0.01

/* An order that is smaller against its own error has no amplitude to speak of. */
#define TIMES_ERROR 3.0

/* What is smaller than this against the largest order is rounding. */
#define ROUNDING 1e-6

/* Highest order of the turn; its polynomial costs the square. */
enum { HIGHEST_MOST = 2000 };

/* ---- words ---- */

hci_status hci_waveform_refuse(const hci_waveform_task *t, const char *found, const char *expected,
                               const char *remedy)
{
    char path[HCI_QUOTE_PATH_SIZE];
    return hci_note_set(t->note, HCI_ERROR_INPUT, "%s: found %s, expected %s; %s",
                        hci_quote_path(t->run->name, path), found, expected, remedy);
}

hci_status hci_waveform_memory(const hci_waveform_task *t)
{
    char path[HCI_QUOTE_PATH_SIZE];
    return hci_note_set(t->note, HCI_ERROR_MEMORY, "%s: not enough memory for the analysis",
                        hci_quote_path(t->run->name, path));
}

/* ---- which orders stand out ---- */

static void set_order(hci_waveform_order *o, double order, const hci_order_estimate *e)
{
    o->order = order;
    o->amplitude = hci_amplitude(e->mean.sine, e->mean.cosine);
    o->phase_rad = hci_phase_rad(e->mean.sine, e->mean.cosine);
    o->std_error = e->std_error;
    o->chance = hci_order_chance(e);
}

static void count_kept(hci_waveform *w)
{
    double left = 0.0;
    w->kept = 0;
    w->largest_left = 0.0;
    for (size_t k = 0; k < w->count; ++k) {
        w->kept += w->order[k].kept;
        if (w->order[k].kept || !(w->order[k].amplitude > left)) continue;
        left = w->order[k].amplitude;
        w->largest_left = w->order[k].order;
    }
}

/* Not noise, and not of an amplitude that comes and goes. */
static bool stands_out(const hci_waveform_order *o, size_t looked_at, double largest)
{
    return o->chance * (double)looked_at < FALSE_SHARE && o->amplitude > TIMES_ERROR * o->std_error &&
           o->amplitude > ROUNDING * largest;
}

static hci_status judge_all(const hci_waveform_task *t, const hci_average *average, size_t channel,
                            double step)
{
    hci_waveform *w = t->result;
    double largest = 0.0;
    w->count = average->highest;
    w->order = hci_memory_new(w->count, sizeof *w->order);
    if (w->order == NULL) return hci_waveform_memory(t);
    for (size_t k = 0; k < w->count; ++k) {
        const hci_order_estimate e = hci_average_estimate(average, channel, k + 1);
        set_order(&w->order[k], (double)(k + 1) * step, &e);
        w->order[k].chance = hci_average_chance(average, channel, k + 1);
        largest = fmax(largest, w->order[k].amplitude);
    }
    for (size_t k = 0; k < w->count; ++k)
        w->order[k].kept = stands_out(&w->order[k], w->count, largest);
    return HCI_OK;
}

static hci_status judge_given(const hci_waveform_task *t, const hci_average *average, size_t channel,
                              double step)
{
    const hci_waveform_options *o = t->options;
    hci_waveform *w = t->result;
    w->count = o->order_count;
    w->order = hci_memory_new(w->count, sizeof *w->order);
    if (w->order == NULL) return hci_waveform_memory(t);
    for (size_t k = 0; k < w->count; ++k) {
        const size_t at = (size_t)(o->orders[k] / step + 0.5);
        const hci_order_estimate e = hci_average_estimate(average, channel, at);
        set_order(&w->order[k], o->orders[k], &e);
        w->order[k].chance = hci_average_chance(average, channel, at);
        w->order[k].kept = true;
    }
    return HCI_OK;
}

/* Orders that were asked for and that the samples do not bear. */
static void remark_limit(const hci_waveform_task *t, const hci_average *average, double step)
{
    const hci_waveform_options *o = t->options;
    const double reached = (double)average->highest * step;
    const double wanted = isnan(o->max_order) ? HCI_WAVEFORM_ORDER_MOST : o->max_order;
    if (o->orders != NULL || reached + step > wanted) return;
    hci_note_add(&t->result->remark, "orders above %.6g are not looked at: the samples lie too far apart%s",
                 reached,
                 isnan(o->max_order) && average->count > 3 ? "; --max-order N puts turns together" : "");
}

hci_status hci_waveform_judge(const hci_waveform_task *t, const hci_average *average, size_t channel,
                              double step)
{
    hci_waveform *w = t->result;
    w->step = step;
    w->between_turns = hci_average_has_repeats(average);
    w->turns_backward = hci_average_passes(average, -1) * average->turns_each;
    w->turns_forward =
        (hci_average_passes(average, 1) + hci_average_passes(average, 0)) * average->turns_each;
    remark_limit(t, average, step);
    const hci_status status = t->options->orders != NULL ? judge_given(t, average, channel, step)
                                                         : judge_all(t, average, channel, step);
    if (status == HCI_OK) count_kept(w);
    return status;
}

/* ---- cogging ---- */

double hci_waveform_current_rms(const hci_run *run)
{
    double square_A2 = 0.0;
    for (size_t k = 0; k < 3 * run->count; ++k)
        square_A2 += run->i_A[k] * run->i_A[k];
    return sqrt(square_A2 / (3.0 * (double)run->count));
}

/* What is left of the torque when that of the current is taken away. */
static void cogging_values(const hci_waveform_task *t, double *value)
{
    const hci_run *run = t->run;
    const double constant =
        isnan(t->options->torque_constant_Nm_per_A) ? 0.0 : t->options->torque_constant_Nm_per_A;
    for (size_t k = 0; k < run->count; ++k) {
        const double theta = t->options->pole_pairs * run->theta_m_rad[k];
        const hci_dq i = hci_park(hci_clarke(run->i_A + 3 * k), theta);
        value[k] = run->torque_Nm[k] - constant * i.q;
    }
}

static hci_status check_cogging(const hci_waveform_task *t)
{
    const bool constant = !isnan(t->options->torque_constant_Nm_per_A);
    if (t->run->theta_m_rad == NULL)
        return hci_waveform_refuse(t, "no angle", "theta_m_rad or theta_e_rad", "add the column");
    if (t->run->torque_Nm == NULL)
        return hci_waveform_refuse(t, "no torque", "torque_Nm",
                                   "add the column; of a rotor held at rest by its current it is 0");
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

static size_t turn_order(double electrical, double step)
{
    const double order = electrical / step + 0.5;
    return order < HIGHEST_MOST ? (size_t)order : HIGHEST_MOST;
}

hci_status hci_waveform_turns(const hci_waveform_task *t, const hci_average_samples *samples, double step,
                              hci_average *average)
{
    const hci_waveform_options *o = t->options;
    const bool given = o->orders != NULL, limited = !isnan(o->max_order);
    const double top = given     ? o->orders[o->order_count - 1]
                       : limited ? o->max_order
                                 : HCI_WAVEFORM_ORDER_MOST;
    const size_t wanted = turn_order(top, step);
    const size_t enough = given || limited ? wanted : turn_order(HCI_WAVEFORM_ORDER_ENOUGH, step);
    if (given && top / step > HIGHEST_MOST) return HCI_ERROR_SINGULAR;
    return hci_average_fit(samples, wanted, enough, given ? wanted : turn_order(1.0, step), average);
}

static hci_status fit_turns(const hci_waveform_task *t, const double *value, double *angle, double scale,
                            double step, hci_average *average)
{
    for (size_t k = 0; k < t->run->count; ++k)
        angle[k] = scale * t->run->theta_m_rad[k];
    const hci_average_samples samples = {angle, value, t->run->count, 1};
    return hci_waveform_turns(t, &samples, step, average);
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

/* ---- the given orders and no others: for what does not go round ---- */

/* How much larger a variance is for samples that resemble the next. */
static double correlation_factor(const double *residual, size_t n)
{
    double square = 0.0, next = 0.0;
    for (size_t k = 0; k < n; ++k) {
        square += residual[k] * residual[k];
        if (k > 0) next += residual[k] * residual[k - 1];
    }
    const double correlation = square > 0.0 ? fmin(fmax(next / square, 0.0), 0.99) : 0.0;
    return (1.0 + correlation) / (1.0 - correlation);
}

/* Columns of the least squares: the mean, and sine and cosine of each order. */
static void columns_at(const hci_waveform_options *o, double theta_rad, double *x)
{
    x[0] = 1.0;
    for (size_t k = 0; k < o->order_count; ++k) {
        x[1 + 2 * k] = sin(o->orders[k] * theta_rad);
        x[2 + 2 * k] = cos(o->orders[k] * theta_rad);
    }
}

/* Standard errors of the given orders: the residual's variance, for samples that resemble the next, times the
 * inverse of the normal matrix. theta_rad, residual: n. error: out. */
static hci_status errors_of_given(const hci_waveform_task *t, const double *theta_rad, const double *residual,
                                  double *error)
{
    const size_t n = t->run->count, columns = 1 + 2 * t->options->order_count;
    double *normal = hci_memory_new(columns * columns, sizeof *normal);
    double *x = hci_memory_new(columns, sizeof *x), square = 0.0;
    hci_status status = normal != NULL && x != NULL ? HCI_OK : HCI_ERROR_MEMORY;
    for (size_t k = 0; k < n && status == HCI_OK; ++k) {
        columns_at(t->options, theta_rad[k], x);
        square += residual[k] * residual[k];
        for (size_t j = 0; j < columns; ++j)
            for (size_t i = j; i < columns; ++i)
                normal[i + j * columns] += x[i] * x[j];
    }
    if (status == HCI_OK) status = hci_cholesky_factor(columns, normal);
    const double variance = square / fmax((double)n - (double)columns, 1.0) * correlation_factor(residual, n);
    for (size_t k = 0; k < t->options->order_count && status == HCI_OK; ++k) {
        error[k] = 0.0;
        for (size_t column = 1 + 2 * k; column < 3 + 2 * k; ++column) {
            memset(x, 0, columns * sizeof *x);
            x[column] = 1.0;
            hci_cholesky_solve(columns, normal, x);
            error[k] += 0.5 * variance * x[column];
        }
        error[k] = sqrt(error[k]);
    }
    hci_memory_free(normal);
    hci_memory_free(x);
    return status;
}

/* Order 0 and those given by least squares. fit: out, order_count + 1; error: out, order_count. */
static hci_status fit_given(const hci_waveform_task *t, const double *value, double *theta_rad,
                            hci_harmonic *fit, double *error)
{
    const size_t n = t->run->count, count = t->options->order_count + 1;
    double *orders = hci_memory_new(count, sizeof *orders), *residual = hci_memory_new(n, sizeof *residual);
    double *work = hci_memory_new(hci_fourier_fit_workspace(count), sizeof *work);
    hci_status status = orders != NULL && work != NULL && residual != NULL ? HCI_OK : HCI_ERROR_MEMORY;
    if (status == HCI_OK) {
        memcpy(orders + 1, t->options->orders, (count - 1) * sizeof *orders);
        status = hci_fourier_fit(theta_rad, value, n, orders, count, fit, work);
    }
    for (size_t k = 0; k < n && status == HCI_OK; ++k)
        residual[k] = value[k] - hci_harmonics_at(fit, count, theta_rad[k]);
    if (status == HCI_OK) status = errors_of_given(t, theta_rad, residual, error);
    hci_memory_free(orders);
    hci_memory_free(residual);
    hci_memory_free(work);
    return status;
}

static void set_given(const hci_waveform_task *t, const hci_harmonic *fit, const double *error)
{
    const size_t count = t->options->order_count;
    hci_waveform *w = t->result;
    for (size_t k = 0; k < count; ++k) {
        const hci_order_estimate e = {{fit[k + 1].sine, fit[k + 1].cosine},
                                      error[k],
                                      fmax((double)t->run->count - 2.0 * (double)count - 1.0, 2.0)};
        set_order(&w->order[k], t->options->orders[k], &e);
        w->order[k].kept = true;
    }
    w->mean_Nm = fit[0].cosine;
    w->count = w->kept = count;
}

static hci_status judge_fit(const hci_waveform_task *t, const double *value, double *angle)
{
    const size_t count = t->options->order_count;
    hci_harmonic *fit = hci_memory_new(count + 1, sizeof *fit);
    double *error = hci_memory_new(count, sizeof *error);
    t->result->order = hci_memory_new(count, sizeof *t->result->order);
    hci_status status = HCI_ERROR_MEMORY;
    if (fit != NULL && error != NULL && t->result->order != NULL) {
        for (size_t k = 0; k < t->run->count; ++k)
            angle[k] = t->options->pole_pairs * t->run->theta_m_rad[k];
        status = fit_given(t, value, angle, fit, error);
    }
    if (status == HCI_OK) set_given(t, fit, error);
    hci_memory_free(fit);
    hci_memory_free(error);
    if (status == HCI_ERROR_SINGULAR)
        return hci_waveform_refuse(t, "angles that cannot tell these orders apart", "samples all around",
                                   "give fewer orders, or measure over more of the turn");
    if (status == HCI_OK)
        hci_note_add(&t->result->remark,
                     "the samples do not go round a turn: only the orders given were fitted, and any "
                     "other one is in them");
    return status == HCI_ERROR_MEMORY ? hci_waveform_memory(t) : status;
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
        hci_note_add(&t->result->remark,
                     "one direction only: friction is in the mean, and what of it follows the angle "
                     "is in the orders");
}

static hci_status cogging_of(const hci_waveform_task *t, double *value, double *angle)
{
    hci_waveform *w = t->result;
    hci_average average = {.highest = 0};
    double step;
    cogging_values(t, value);
    hci_status status = find_turns(t, value, angle, &average, &step);
    if (status == HCI_OK) {
        w->friction_Nm = hci_average_half_difference(&average, 0, &w->friction_error_Nm);
        w->mean_Nm = hci_average_estimate(&average, 0, 0).mean.cosine;
        status = hci_waveform_judge(t, &average, 0, step);
    } else if (status == HCI_ERROR_SINGULAR && t->options->orders != NULL) {
        status = judge_fit(t, value, angle);
    } else if (status == HCI_ERROR_SINGULAR) {
        status = hci_waveform_refuse(t, "angles that do not go round an electrical turn",
                                     "samples all around, without large gaps",
                                     "record more of the turn, or name the orders to fit with --orders");
    }
    hci_average_release(&average);
    if (status == HCI_ERROR_MEMORY) return hci_waveform_memory(t);
    if (status == HCI_OK) remark_cogging(t);
    return status;
}

hci_status hci_waveform_cogging(const hci_waveform_task *t)
{
    hci_status status = check_cogging(t);
    if (status != HCI_OK) return status;
    double *value = hci_memory_new(t->run->count, sizeof *value);
    double *angle = hci_memory_new(t->run->count, sizeof *angle);
    status = value != NULL && angle != NULL ? cogging_of(t, value, angle) : hci_waveform_memory(t);
    hci_memory_free(value);
    hci_memory_free(angle);
    return status;
}

/* ---- either ---- */

static hci_status check_options(const hci_waveform_options *o, hci_note *note)
{
    if (o->pole_pairs < 1)
        return hci_note_set(note, HCI_ERROR_ARGUMENT, "found %d pole pairs, expected 1 or more",
                            o->pole_pairs);
    for (size_t k = 0; k < o->order_count; ++k) {
        if (!(o->orders[k] > HCI_ORDER_TOLERANCE) || o->orders[k] > HCI_MOST_ORDER)
            return hci_note_set(note, HCI_ERROR_ARGUMENT, "order %g: expected one above 0, at most %g",
                                o->orders[k], HCI_MOST_ORDER);
        if (k > 0 && !(o->orders[k] > o->orders[k - 1] + HCI_ORDER_TOLERANCE))
            return hci_note_set(note, HCI_ERROR_ARGUMENT, "order %g: expected each once and ascending",
                                o->orders[k]);
    }
    return HCI_OK;
}

hci_status hci_waveform_find(const hci_run *run, const hci_waveform_options *options, hci_waveform *waveform,
                             hci_note *note)
{
    const hci_waveform_task t = {run, options, waveform, note};
    memset(waveform, 0, sizeof *waveform);
    waveform->quantity = options->quantity;
    waveform->mean_Nm = waveform->friction_Nm = waveform->friction_error_Nm = NAN;
    waveform->frequency_Hz = waveform->drift_Hz_per_s = waveform->speed_rad_per_s = NAN;
    hci_status status = check_options(options, note);
    if (status == HCI_OK)
        status =
            options->quantity == HCI_WAVEFORM_COGGING ? hci_waveform_cogging(&t) : hci_waveform_back_emf(&t);
    if (status != HCI_OK) hci_waveform_release(waveform);
    return status;
}

void hci_waveform_release(hci_waveform *waveform)
{
    hci_memory_free(waveform->order);
    memset(waveform, 0, sizeof *waveform);
}
