/* The plain sine that a drive is compared with. */
#include <math.h>
#include <stdio.h>

#include "host/draw/html.h"
#include "host/report/page/simulation_sections.h"

bool hci_page_has_before(const hci_simulation *s)
{
    return s->plain.order_count > 0;
}

double hci_page_before_Nm(const hci_simulation *s, double order)
{
    for (size_t k = 0; k < s->plain.order_count; ++k) {
        const hci_harmonic h = s->plain.torque_Nm[k];
        if (fabs(h.order - order) < HCI_ORDER_TOLERANCE)
            return order < HCI_ORDER_TOLERANCE ? h.cosine : hci_amplitude(h.sine, h.cosine);
    }
    return hci_page_has_before(s) ? 0.0 : (double)NAN;
}

void hci_page_say_baseline(char text[HCI_PAGE_BASELINE_SIZE], const hci_simulation *s)
{
    char plain[HCI_HTML_NUMBER_SIZE];
    text[0] = '\0';
    if (!hci_page_has_before(s)) return;
    hci_html_quantity_text(plain, s->plain_amplitude_A, "A");
    snprintf(text, HCI_PAGE_BASELINE_SIZE,
             "Before: the plain sine of %s in phase with the back-EMF, which would make the same mean torque "
             "with it, as it should flow, on the same machine. After: this drive. ",
             plain);
}
