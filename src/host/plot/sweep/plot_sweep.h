/* Pictures of a sweep, each written as host/plot/plot.h describes. */
#ifndef HCI_SRC_HOST_PLOT_SWEEP_PLOT_SWEEP_H
#define HCI_SRC_HOST_PLOT_SWEEP_PLOT_SWEEP_H

#include "hci/host/sweep/sweep.h"
#include "host/draw/svg.h"

/* The picture of the kind of this sweep, with a style sheet of its own. */
void hci_plot_sweep(hci_output *out, const hci_grid *sweep);

/* ---- the three ---- */

void hci_plot_trade_off(hci_output *out, const hci_grid *sweep);
void hci_plot_envelope(hci_output *out, const hci_grid *sweep);
void hci_plot_map(hci_output *out, const hci_grid *sweep);

/* Begins a picture: style sheet, ground, title and what is limited. */
void hci_plot_sweep_begin(hci_output *out, const hci_svg_picture *picture, const hci_grid *sweep);

/* ---- their panels, each about the box of its axes; sweep: an hci_grid of that kind ---- */

void hci_plot_ripple_by_current(hci_output *out, const hci_svg_box *box, const void *sweep);
void hci_plot_ripple_by_copper(hci_output *out, const hci_svg_box *box, const void *sweep);
void hci_plot_copper_by_current(hci_output *out, const hci_svg_box *box, const void *sweep);
void hci_plot_peak_by_copper(hci_output *out, const hci_svg_box *box, const void *sweep);

void hci_plot_envelope_torque(hci_output *out, const hci_svg_box *box, const void *sweep);
void hci_plot_envelope_ripple(hci_output *out, const hci_svg_box *box, const void *sweep);

/* All maps, two in a row where the box is wide, HCI_MAP_DOWN pixels from row to row. */
enum { HCI_MAP_DOWN = 292 };
void hci_plot_maps(hci_output *out, const hci_svg_box *box, const void *sweep);

#endif
