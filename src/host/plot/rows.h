/* Pictures of rows: a name at the left, and marks on an axis. */
#ifndef HCI_SRC_HOST_PLOT_ROWS_H
#define HCI_SRC_HOST_PLOT_ROWS_H

#include <stddef.h>

#include "host/draw/svg.h"

enum { HCI_ROWS_HEIGHT = 21 }; /* pixels of a row */

/* y of the middle of row k. */
double hci_rows_middle(const hci_svg_box *box, size_t k);

/* The box without the names at its left: a third of it, less of a wide one. */
hci_svg_box hci_rows_box(const hci_svg_box *area);

/* A name beside row k, of a path without the `../` before it; is_bold: of what stands out. */
void hci_rows_name(hci_output *out, const hci_svg_box *box, size_t k, bool is_bold, const char *name);

/* What stands below the numbers of the axis. */
void hci_rows_foot(hci_output *out, const hci_svg_box *box, const char *text);

#endif
