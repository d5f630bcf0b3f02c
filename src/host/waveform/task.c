/* What every waveform needs: why a recording is refused, the rms of its currents, and the average over its
 * turns up to the order that is asked for. */
#include "host/waveform/task.h"

#include <math.h>

#include "hci/machine/frames.h"
#include "host/base/quote.h"

/* Highest order of the turn; its polynomial costs the square. */
enum { HIGHEST_MOST = 2000 };

hci_status hci_waveform_refuse(const hci_waveform_task *t, const char *found, const char *expected,
                               const char *remedy)
{
    char path[HCI_QUOTE_PATH_SIZE];
    return hci_note_set(t->note, HCI_ERROR_INPUT, "%s: found %s, expected %s; %s",
                        hci_quote_path(t->run->name, path), found, expected, remedy);
}

hci_status hci_waveform_memory(const hci_waveform_task *t)
{
    return hci_note_memory(t->note, t->run->name, "the analysis");
}

double hci_waveform_current_rms(const hci_run *run)
{
    double square_A2 = 0.0;
    for (size_t k = 0; k < 3 * run->count; ++k)
        square_A2 += run->i_A[k] * run->i_A[k];
    return sqrt(square_A2 / (3.0 * (double)run->count));
}

static size_t turn_order(double electrical, double step)
{
    const double order = electrical / step + 0.5;
    return order < HIGHEST_MOST ? (size_t)order : HIGHEST_MOST;
}

hci_status hci_waveform_average(const hci_waveform_task *t, const hci_average_samples *samples, double step,
                                hci_average *average)
{
    const hci_waveform_options *o = t->options;
    const bool given = o->orders != NULL, limited = !isnan(o->max_order);
    const double top = given     ? o->orders[o->order_count - 1]
                       : limited ? o->max_order
                                 : HCI_WAVEFORM_ORDER_MOST;
    const size_t wanted = turn_order(top, step);
    const hci_average_orders orders = {
        .wanted = wanted,
        .enough = given || limited ? wanted : turn_order(HCI_WAVEFORM_ORDER_ENOUGH, step),
        .least = given ? wanted : turn_order(1.0, step),
    };
    if (given && top / step > HIGHEST_MOST) return HCI_ERROR_SINGULAR;
    return hci_average_fit(samples, &orders, average);
}

/* Times what noise alone makes of a mean. */
#define NOISE_OF_MEAN 5.0

/* i_d and i_q of noise have means of √2 times its rms over the root of the samples. */
bool hci_waveform_current_flows(const hci_waveform_task *t)
{
    const hci_run *run = t->run;
    const double rms_A = hci_waveform_current_rms(run);
    double d_A = 0.0, q_A = 0.0;
    if (run->theta_m_rad == NULL || !(rms_A > 0.0)) return rms_A > 0.0;
    for (size_t k = 0; k < run->count; ++k) {
        const hci_dq i = hci_park(hci_clarke(run->i_A + 3 * k), t->options->pole_pairs * run->theta_m_rad[k]);
        d_A += i.d / (double)run->count;
        q_A += i.q / (double)run->count;
    }
    return hypot(d_A, q_A) > NOISE_OF_MEAN * sqrt(2.0) * rms_A / sqrt((double)run->count);
}
