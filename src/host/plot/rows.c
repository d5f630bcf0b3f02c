#include "host/plot/rows.h"

double hci_rows_middle(size_t k)
{
    return HCI_ROWS_TOP + HCI_ROWS_HEIGHT * ((double)k + 0.5);
}

void hci_rows_begin(hci_output *out, const char *id, const char *title, const char *description, size_t rows)
{
    const int height = HCI_ROWS_TOP + HCI_ROWS_HEIGHT * (int)rows + 46;
    hci_svg_begin(out, &(hci_svg_picture){id, title, description, 0, 0, HCI_ROWS_WIDTH, height});
}

hci_svg_box hci_rows_box(double left, double right, size_t rows)
{
    return (hci_svg_box){left, HCI_ROWS_TOP, right, hci_rows_middle(rows) - 0.5 * HCI_ROWS_HEIGHT};
}

void hci_rows_foot(hci_output *out, const hci_svg_box *b, const char *text)
{
    hci_svg_label(out, "quiet middle", 0.5 * (b->left + b->right), b->bottom + 36.0, text);
}
