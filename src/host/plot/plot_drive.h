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
    const hci_traces *traces;
    const char *title;
    hci_trace first, last;
    double from_s, to_s;
} hci_plot_window;

/* window: an hci_plot_window. */
void hci_plot_traces(hci_output *out, const hci_svg_box *box, const void *window);

/* The same of two, one above the other; windows: two of them. */
void hci_plot_traces_of_two(hci_output *out, const hci_svg_box *box, const void *windows);

/* One turn; before: of what it is compared with, or NULL; plain_q_A: i_q of the plain sine with the same mean
 * torque. */
typedef struct {
    const hci_turn_means *turn, *before;
    double plain_q_A;
} hci_plot_turn;

/* Torque, and the mean i_d and i_q, over one turn; turn: an hci_plot_turn. */
void hci_plot_turn_torque(hci_output *out, const hci_svg_box *box, const void *turn);
void hci_plot_turn_dq(hci_output *out, const hci_svg_box *box, const void *turn);

#endif
