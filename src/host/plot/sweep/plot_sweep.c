#include "host/plot/sweep/plot_sweep.h"

void hci_plot_sweep(hci_output *out, const hci_grid *s)
{
    if (s->request.kind == HCI_GRID_TRADE_OFF) hci_plot_trade_off(out, s);
    if (s->request.kind == HCI_GRID_ENVELOPE) hci_plot_envelope(out, s);
    if (s->request.kind == HCI_GRID_MAP) hci_plot_map(out, s);
}
