#include "host/plot/raster.h"

#include <math.h>

#define LEAST_SIDE 2.6 /* pixels; every number that is not 0 is seen */

void hci_raster_square(hci_output *out, const hci_raster *r, const char *style, size_t row, size_t column,
                       double share)
{
    const double side = fmax(0.9 * fmin(r->width, r->height) * share, LEAST_SIDE);
    const double x = r->left + r->width * ((double)column + 0.5),
                 y = r->top + r->height * ((double)row + 0.5);
    hci_svg_rectangle(out, style, x - 0.5 * side, y - 0.5 * side, x + 0.5 * side, y + 0.5 * side);
}

void hci_raster_frame(hci_output *out, const hci_svg_box *b)
{
    hci_svg_segment(out, "axis", b->left, b->top, b->right, b->top);
    hci_svg_segment(out, "axis", b->left, b->bottom, b->right, b->bottom);
    hci_svg_segment(out, "axis", b->left, b->top, b->left, b->bottom);
    hci_svg_segment(out, "axis", b->right, b->top, b->right, b->bottom);
}
