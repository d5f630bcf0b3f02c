/* Quantities of a simulated drive over time, kept as their extremes in each of a fixed number of equal
 * intervals, so that no peak is lost however long the run is. */
#ifndef HCI_SRC_HOST_SIMULATE_TRACES_H
#define HCI_SRC_HOST_SIMULATE_TRACES_H

#include "host/numeric/range.h"
#include "host/simulate/turn_means.h"

typedef enum {
    HCI_TRACE_TORQUE_NM,
    HCI_TRACE_SPEED_RPM,
    HCI_TRACE_A_A,
    HCI_TRACE_B_A,
    HCI_TRACE_C_A,
    HCI_TRACES
} hci_trace;

enum { HCI_TRACE_INTERVALS = 720 };

typedef struct {
    double from_s, to_s;
    hci_range extremes[HCI_TRACES][HCI_TRACE_INTERVALS]; /* empty where there was no sample */
    hci_turn_means turn;                                 /* of the same time */
} hci_traces;

void hci_traces_begin(hci_traces *traces, double from_s, double to_s);

/* What is outside the time is left out. theta_e_rad: to which the phase currents are turned. */
void hci_traces_add(hci_traces *traces, double time_s, double theta_e_rad, const double value[HCI_TRACES]);

/* The time in the middle of an interval. */
double hci_traces_time_s(const hci_traces *traces, size_t interval);

/* The extremes in the intervals whose middle is in from_s … to_s. */
hci_range hci_traces_range(const hci_traces *traces, hci_trace trace, double from_s, double to_s);

#endif
