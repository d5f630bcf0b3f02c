#include "host/currents/plain_sine.h"

#include <math.h>

hci_wave hci_plain_sine(const hci_machine *machine, double mean_Nm)
{
    for (size_t k = 0; k < machine->back_emf_count; ++k) {
        const hci_wave *e = &machine->back_emf[k];
        const double square = e->sine * e->sine + e->cosine * e->cosine, scale = mean_Nm / (1.5 * square);
        if (fabs(e->order - 1.0) < HCI_ORDER_TOLERANCE && e->sequence == 1 && square > 0.0)
            return (hci_wave){1.0, 1, scale * e->sine, scale * e->cosine};
    }
    return (hci_wave){1.0, 1, 0.0, 0.0};
}
