/* What the pictures of a sweep begin with. */
#include "host/plot/sweep/plot_sweep.h"

void hci_plot_sweep_begin(hci_output *out, const hci_svg_picture *picture, const hci_grid *s)
{
    char limits[HCI_GRID_WORDS_SIZE];
    hci_grid_limits_words(&s->request, limits);
    hci_svg_begin(out, picture);
    hci_output_text(out, "<style>%s</style>\n", hci_svg_style);
    hci_svg_rectangle(out, "back", 0.0, 0.0, picture->width, picture->height);
    hci_svg_label(out, "verdict", 28.0, 36.0, picture->title);
    hci_svg_label(out, "facts quiet", 28.0, 58.0, limits[0] ? limits : "no limits");
}
