/* What the files of the waveform analysis share. */
#ifndef HCI_SRC_HOST_WAVEFORM_PARTS_H
#define HCI_SRC_HOST_WAVEFORM_PARTS_H

#include "hci/host/waveform/waveform.h"
#include "host/waveform/synchronous_average.h"

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
hci_status hci_waveform_judge(const hci_waveform_task *t, const hci_average *average, size_t channel,
                              double step);

/* "RUN: found …, expected …; remedy", HCI_ERROR_INPUT. */
hci_status hci_waveform_refuse(const hci_waveform_task *t, const char *found, const char *expected,
                               const char *remedy);
hci_status hci_waveform_memory(const hci_waveform_task *t);

/* Of the phase currents, A: √((i_a² + i_b² + i_c²)/3) of the mean squares; 1/√2 of the peak of a sine. */
double hci_waveform_current_rms(const hci_run *run);

/* hci_average_fit of turns whose orders are `step` electrical ones apart, up to the order that is asked for.
 */
hci_status hci_waveform_turns(const hci_waveform_task *t, const hci_average_samples *samples, double step,
                              hci_average *average);

/* Speed and angle of voltages that were recorded without. n samples; v: [n][3]. phase_rad: out, electrical,
 * growing; rate_rad_per_s: out, its rate. */
typedef struct {
    double frequency_Hz, drift_Hz_per_s; /* at the middle of the record */
} hci_voltage_clock;

/* HCI_ERROR_SINGULAR: less than two periods, or no period at all. */
hci_status hci_voltage_clock_find(const double *time_s, const double *v, size_t n, double *phase_rad,
                                  double *rate_rad_per_s, hci_voltage_clock *clock);

#endif
