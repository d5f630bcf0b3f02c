/* The orders that the user names and no others, by least squares over all samples: for a recording that does
 * not go round a turn. */
#include <math.h>
#include <string.h>

#include "hci/math/dense.h"
#include "hci/math/fourier.h"
#include "hci/math/harmonic.h"
#include "host/base/memory.h"
#include "host/waveform/task.h"

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
    for (size_t k = 0; k < n && !status; ++k) {
        columns_at(t->options, theta_rad[k], x);
        square += residual[k] * residual[k];
        for (size_t j = 0; j < columns; ++j)
            for (size_t i = j; i < columns; ++i)
                normal[i + j * columns] += x[i] * x[j];
    }
    if (!status) status = hci_cholesky_factor(columns, normal);
    const double variance = square / fmax((double)n - (double)columns, 1.0) * correlation_factor(residual, n);
    for (size_t k = 0; k < t->options->order_count && !status; ++k) {
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
    if (!status) {
        memcpy(orders + 1, t->options->orders, (count - 1) * sizeof *orders);
        status = hci_fourier_fit(theta_rad, value, n, orders, count, fit, work);
    }
    for (size_t k = 0; k < n && !status; ++k)
        residual[k] = value[k] - hci_harmonics_at(fit, count, theta_rad[k]);
    if (!status) status = errors_of_given(t, theta_rad, residual, error);
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
        hci_waveform_set_order(&w->order[k], t->options->orders[k], &e);
        w->order[k].kept = true;
    }
    w->mean_Nm = fit[0].cosine;
    w->count = w->kept = count;
}

hci_status hci_waveform_fit_given(const hci_waveform_task *t, const double *value, double *angle)
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
    if (!status) set_given(t, fit, error);
    hci_memory_free(fit);
    hci_memory_free(error);
    if (status == HCI_ERROR_SINGULAR)
        return hci_waveform_refuse(t, "angles that cannot tell these orders apart", "samples all around",
                                   "give fewer orders, or measure over more of the turn");
    if (!status)
        hci_note_add(&t->result->remark,
                     "the samples do not go round a turn: only the orders given were fitted, and any "
                     "other one is in them");
    return status == HCI_ERROR_MEMORY ? hci_waveform_memory(t) : status;
}
