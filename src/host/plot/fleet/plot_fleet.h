/* Pictures of motors of one make, each about the box of its axes as host/plot/plot.h describes; line: an
 * hci_line. */
#ifndef HCI_SRC_HOST_PLOT_FLEET_PLOT_FLEET_H
#define HCI_SRC_HOST_PLOT_FLEET_PLOT_FLEET_H

#include "hci/host/fleet/line.h"
#include "host/draw/svg.h"

/* A row for each parameter: how many motors deviate by how much, and those beyond the limit. */
void hci_plot_distributions(hci_output *out, const hci_svg_box *box, const void *line);

/* The largest deviation of each motor, in the order of the dates. */
void hci_plot_motors(hci_output *out, const hci_svg_box *box, const void *line);

/* The means of batches, of the parameters that change most from one to another or over the date. */
void hci_plot_batches(hci_output *out, const hci_svg_box *box, const void *line);

/* Pixels for a row of the first, and for a parameter of the last; how many that has. */
enum { HCI_PLOT_PARAMETER_DOWN = 30, HCI_PLOT_BATCHES_DOWN = 190, HCI_PLOT_MOST_TRENDS = 3 };
size_t hci_plot_batches_count(const hci_line *line);

/* "friction coulomb": a parameter in words. */
void hci_plot_parameter_name(const hci_line *line, size_t parameter, char text[96]);

#endif
