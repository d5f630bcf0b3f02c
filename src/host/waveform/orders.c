/* Which orders of an averaged recording stand out of its noise. */
#include <math.h>

#include "hci/math/harmonic.h"
#include "host/base/memory.h"
#include "host/waveform/task.h"

/* Of all orders looked at, noise is to make one in so many recordings. */
#define FALSE_SHARE 0.01

/* An order that is smaller against its own error has no amplitude to speak of. */
#define TIMES_ERROR 3.0

/* What is smaller than this against the largest order is rounding. */
#define ROUNDING 1e-6

void hci_waveform_set_order(hci_waveform_order *o, double order, const hci_order_estimate *e)
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

static hci_status take_all_orders(const hci_waveform_task *t, const hci_average *average, size_t channel,
                                  double step)
{
    hci_waveform *w = t->result;
    double largest = 0.0;
    w->count = average->highest;
    w->order = hci_memory_new(w->count, sizeof *w->order);
    if (w->order == NULL) return hci_waveform_memory(t);
    for (size_t k = 0; k < w->count; ++k) {
        const hci_order_estimate e = hci_average_estimate(average, channel, k + 1);
        hci_waveform_set_order(&w->order[k], (double)(k + 1) * step, &e);
        w->order[k].chance = hci_average_chance(average, channel, k + 1);
        largest = fmax(largest, w->order[k].amplitude);
    }
    for (size_t k = 0; k < w->count; ++k)
        w->order[k].kept = stands_out(&w->order[k], w->count, largest);
    return HCI_OK;
}

static hci_status take_given_orders(const hci_waveform_task *t, const hci_average *average, size_t channel,
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
        hci_waveform_set_order(&w->order[k], o->orders[k], &e);
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
    hci_note_add(&t->result->remark,
                 "orders above %.6g are not looked at: in places of a turn the samples lie too far apart%s",
                 reached,
                 isnan(o->max_order) && average->count > 3 ? "; --max-order N puts turns together" : "");
}

hci_status hci_waveform_take_orders(const hci_waveform_task *t, const hci_average *average, size_t channel,
                                    double step)
{
    hci_waveform *w = t->result;
    w->step = step;
    w->between_turns = hci_average_has_repeats(average);
    w->turns_backward = hci_average_passes(average, -1) * average->turns_each;
    w->turns_forward =
        (hci_average_passes(average, 1) + hci_average_passes(average, 0)) * average->turns_each;
    remark_limit(t, average, step);
    const hci_status status = t->options->orders != NULL ? take_given_orders(t, average, channel, step)
                                                         : take_all_orders(t, average, channel, step);
    if (!status) count_kept(w);
    return status;
}
