/* Numbers in rows and columns, as squares whose size tells theirs. */
#ifndef HCI_SRC_HOST_PLOT_RASTER_H
#define HCI_SRC_HOST_PLOT_RASTER_H

#include <stddef.h>

#include "host/draw/svg.h"

typedef struct {
    double left, top, width, height; /* of a cell */
} hci_raster;

/* A square about the middle of a cell; share: of the side, 0 … 1. */
void hci_raster_square(hci_output *out, const hci_raster *raster, const char *style, size_t row,
                       size_t column, double share);

/* The four edges of a box. */
void hci_raster_frame(hci_output *out, const hci_svg_box *box);

#endif
