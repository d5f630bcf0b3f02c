/* The electrical angle of voltages that were recorded without one. */
#ifndef HCI_SRC_HOST_WAVEFORM_CLOCK_H
#define HCI_SRC_HOST_WAVEFORM_CLOCK_H

#include <stddef.h>

#include "hci/status.h"

/* Speed and angle of voltages that were recorded without. n samples; v: [n][3]. phase_rad: out, electrical,
 * growing; rate_rad_per_s: out, its rate. */
typedef struct {
    double frequency_Hz, drift_Hz_per_s; /* at the middle of the record */
} hci_voltage_clock;

/* HCI_ERROR_SINGULAR: less than two periods, or no period at all. */
hci_status hci_voltage_clock_find(const double *time_s, const double *v, size_t n, double *phase_rad,
                                  double *rate_rad_per_s, hci_voltage_clock *clock);

#endif
