#include "host/plot/rows.h"

#include <math.h>
#include <string.h>

double hci_rows_middle(const hci_svg_box *b, size_t k)
{
    return b->top + HCI_ROWS_HEIGHT * ((double)k + 0.5);
}

hci_svg_box hci_rows_box(const hci_svg_box *area)
{
    hci_svg_box b = *area;
    b.left += fmin(0.36 * (b.right - b.left), 130.0);
    return b;
}

/* A path without the steps upwards that it begins with. */
static const char *downwards(const char *path)
{
    while (strncmp(path, "../", 3) == 0)
        path += 3;
    return path;
}

void hci_rows_name(hci_output *out, const hci_svg_box *b, size_t k, bool is_bold, const char *name)
{
    hci_svg_name(out, is_bold ? "head end" : "quiet end", b->left - 8.0, hci_rows_middle(b, k) + 4.0,
                 downwards(name), b->left - 24.0);
}

void hci_rows_foot(hci_output *out, const hci_svg_box *b, const char *text)
{
    hci_svg_label(out, "quiet middle", 0.5 * (b->left + b->right), b->bottom + 36.0, text);
}
