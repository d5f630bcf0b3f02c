#include "host/simulate/traces.h"

#include <math.h>

void hci_traces_begin(hci_traces *t, double from_s, double to_s)
{
    t->from_s = from_s;
    t->to_s = to_s;
    hci_turn_means_begin(&t->turn);
    for (size_t j = 0; j < HCI_TRACES; ++j)
        for (size_t k = 0; k < HCI_TRACE_INTERVALS; ++k)
            t->extremes[j][k] = HCI_RANGE_EMPTY;
}

double hci_traces_time_s(const hci_traces *t, size_t k)
{
    return t->from_s + (t->to_s - t->from_s) * ((double)k + 0.5) / HCI_TRACE_INTERVALS;
}

void hci_traces_add(hci_traces *t, double time_s, double theta_e_rad, const double value[HCI_TRACES])
{
    const double share = (time_s - t->from_s) / (t->to_s - t->from_s);
    if (!(share >= 0.0 && share <= 1.0)) return;
    const size_t k = (size_t)fmin(HCI_TRACE_INTERVALS * share, HCI_TRACE_INTERVALS - 1.0);
    for (size_t j = 0; j < HCI_TRACES; ++j)
        hci_range_include(&t->extremes[j][k], value[j]);
    hci_turn_means_add(&t->turn, theta_e_rad, value[HCI_TRACE_TORQUE_NM],
                       hci_park(hci_clarke(&value[HCI_TRACE_A_A]), theta_e_rad));
}

hci_range hci_traces_range(const hci_traces *t, hci_trace j, double from_s, double to_s)
{
    hci_range r = HCI_RANGE_EMPTY;
    for (size_t k = 0; k < HCI_TRACE_INTERVALS; ++k) {
        const double at_s = hci_traces_time_s(t, k);
        if (at_s < from_s || at_s > to_s) continue;
        hci_range_include(&r, t->extremes[j][k].low);
        hci_range_include(&r, t->extremes[j][k].high);
    }
    return r;
}
