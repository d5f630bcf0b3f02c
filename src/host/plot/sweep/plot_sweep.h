/* Pictures of a sweep, each written as host/plot/plot.h describes. */
#ifndef HCI_SRC_HOST_PLOT_SWEEP_PLOT_SWEEP_H
#define HCI_SRC_HOST_PLOT_SWEEP_PLOT_SWEEP_H

#include "hci/host/sweep/sweep.h"
#include "host/draw/svg.h"

/* The picture of the kind of this sweep, with a style sheet of its own where it stands alone. */
void hci_plot_sweep(hci_output *out, const hci_grid *sweep, bool stands_alone);

/* ---- the three ---- */

void hci_plot_trade_off(hci_output *out, const hci_grid *sweep, bool stands_alone);
void hci_plot_envelope(hci_output *out, const hci_grid *sweep, bool stands_alone);
void hci_plot_map(hci_output *out, const hci_grid *sweep, bool stands_alone);

/* Begins a picture: style sheet, ground, title and what is limited. */
void hci_plot_sweep_begin(hci_output *out, const hci_svg_picture *picture, const hci_grid *sweep,
                          bool stands_alone);

#endif
