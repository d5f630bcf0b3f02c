/* Pictures of a simulated drive, each written as plot.h describes. */
#ifndef HCI_SRC_HOST_PLOT_PLOT_DRIVE_H
#define HCI_SRC_HOST_PLOT_PLOT_DRIVE_H

#include "hci/host/base/output.h"
#include "host/draw/svg.h"
#include "host/simulate/traces.h"
#include "host/simulate/turn_means.h"

/* The traces first … last, in one unit, from from_s to to_s; where samples are denser than the picture, up
 * and down between the extremes of each interval. */
typedef struct {
    const hci_svg_picture *words;
    hci_trace first, last;
    double from_s, to_s;
} hci_plot_window;

void hci_plot_traces(hci_output *out, const hci_traces *traces, const hci_plot_window *window);

/* Torque over one turn. before: of what it is compared with, or NULL. */
void hci_plot_turn_torque(hci_output *out, const hci_turn_means *turn, const hci_turn_means *before);

/* The path of the current vector, and plain_A: the one of the plain sine with the same mean torque. */
void hci_plot_turn_vector(hci_output *out, const hci_turn_means *turn, hci_dq plain_A);

#endif
