/* What the files of the waveform analysis share. */
#ifndef HCI_SRC_HOST_WAVEFORM_TASK_H
#define HCI_SRC_HOST_WAVEFORM_TASK_H

#include <stdbool.h>

#include "hci/host/waveform/waveform.h"
#include "host/numeric/synchronous_average.h"

/* Electrical orders that are looked at, and those for which turns are put together where one has too few
 * samples; the user's own highest order is both. */
#define HCI_WAVEFORM_ORDER_MOST   60.0
#define HCI_WAVEFORM_ORDER_ENOUGH 13.0

typedef struct {
    const hci_run *run;
    const hci_waveform_options *options;
    hci_waveform *result;
    hci_note *note;
} hci_waveform_task;

hci_status hci_waveform_cogging(const hci_waveform_task *t);
hci_status hci_waveform_back_emf(const hci_waveform_task *t);

/* The orders of one channel into the result. step: electrical order of the turns' order 1. */
hci_status hci_waveform_take_orders(const hci_waveform_task *t, const hci_average *average, size_t channel,
                                    double step);

/* "RUN: found …, expected …; remedy", HCI_ERROR_INPUT. */
hci_status hci_waveform_refuse(const hci_waveform_task *t, const char *found, const char *expected,
                               const char *remedy);
hci_status hci_waveform_memory(const hci_waveform_task *t);

/* Of the phase currents, A: √((i_a² + i_b² + i_c²)/3) of the mean squares; 1/√2 of the peak of a sine. */
double hci_waveform_current_rms(const hci_run *run);

/* Whether a current flows, and is not what a sensor makes of none: noise and an offset do not turn with the
 * angle. Without an angle: whether any was recorded. */
bool hci_waveform_current_flows(const hci_waveform_task *t);

/* hci_average_fit of turns whose orders are `step` electrical ones apart, up to the order that is asked for.
 */
hci_status hci_waveform_average(const hci_waveform_task *t, const hci_average_samples *samples, double step,
                                hci_average *average);

/* Order, amplitude, phase and chance of an estimate. */
void hci_waveform_set_order(hci_waveform_order *o, double order, const hci_order_estimate *e);

/* The orders of the options and no others, by least squares over all samples, into the result. value: of each
 * sample; angle_rad: room for as many. HCI_ERROR_INPUT where the angles cannot tell the orders apart,
 * HCI_ERROR_MEMORY. */
hci_status hci_waveform_fit_given(const hci_waveform_task *t, const double *value, double *angle_rad);

#endif
