/* Pictures of rows: a name at the left, and marks on an axis. */
#ifndef HCI_SRC_HOST_PLOT_ROWS_H
#define HCI_SRC_HOST_PLOT_ROWS_H

#include <stddef.h>

#include "host/draw/svg.h"

enum {
    HCI_ROWS_WIDTH = 540,
    HCI_ROWS_HEIGHT = 21,
    HCI_ROWS_TOP = 62
}; /* pixels: of the picture, of a row, above them */

/* y of the middle of row k. */
double hci_rows_middle(size_t k);

/* Begins a picture that is high enough for so many rows. */
void hci_rows_begin(hci_output *out, const char *id, const char *title, const char *description, size_t rows);

/* The box of an axis beside the names. */
hci_svg_box hci_rows_box(double left, double right, size_t rows);

/* What stands below the numbers of the axis. */
void hci_rows_foot(hci_output *out, const hci_svg_box *box, const char *text);

#endif
