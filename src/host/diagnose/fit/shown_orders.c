#include "host/diagnose/fit/shown_orders.h"

#include <math.h>

#define WHOLE_TURN 0.9  /* electrical */
#define BY_CHANCE  28.0 /* χ² of two degrees of freedom, once in 10⁶ */

static double electrical_turns(const hci_regression *e, const hci_segment *x)
{
    const hci_binned_sample *first = e->samples->sample + x->first, *last = first + x->count - 1;
    const double span_rad = fabs(last->reading.theta_m_rad - first->reading.theta_m_rad);
    return span_rad * e->machine->pole_pairs / (2.0 * HCI_PI);
}

static double mean_Nm(const hci_regression *e, const hci_segment *x)
{
    double sum = 0.0;
    for (size_t j = x->first; j < x->first + x->count; ++j)
        sum += e->samples->sample[j].torque_Nm / (double)x->count;
    return sum;
}

/* Whether a segment shows a torque of an order. */
static bool shows(const hci_regression *e, const hci_segment *x, int order, double least_Nm)
{
    const double mean = mean_Nm(e, x), periods = order * e->machine->pole_pairs;
    const double rms = hci_regression_noise(e, x)->rms;
    double cosine = 0.0, sine = 0.0;
    for (size_t j = x->first; j < x->first + x->count; ++j) {
        const double angle = periods * e->samples->sample[j].reading.theta_m_rad;
        cosine += (e->samples->sample[j].torque_Nm - mean) * cos(angle);
        sine += (e->samples->sample[j].torque_Nm - mean) * sin(angle);
    }
    const double square = 4.0 * (cosine * cosine + sine * sine) / ((double)x->count * (double)x->count);
    return square > least_Nm * least_Nm && square > BY_CHANCE * 2.0 * rms * rms / (double)x->count;
}

/* tells: out, whether any segment covers a turn. */
static bool any_shows(const hci_regression *e, int order, double least_Nm, bool *tells)
{
    bool any = false;
    *tells = false;
    for (const hci_segment *x = NULL; !any && (x = hci_regression_next(e, x)) != NULL;) {
        if (!(electrical_turns(e, x) > WHOLE_TURN)) continue;
        *tells = true;
        any = shows(e, x, order, least_Nm);
    }
    return any;
}

int hci_highest_order_shown(const hci_regression *e, int stride, int most, double least_Nm)
{
    int order = most - most % stride;
    bool tells = true;
    while (order > 0 && !any_shows(e, order, least_Nm, &tells) && tells)
        order -= stride;
    return tells ? order : most;
}
