/* The section of a diagnosis about what no effect explains. */
#include "host/draw/html.h"
#include "host/report/page/diagnosis_sections.h"

void hci_page_unexplained(hci_output *out, const hci_diagnosis *d)
{
    static const char *const COLUMN[] = {
        "Order", "Largest N·m", "sin N·m", "cos N·m", "a", "b", "<turns sign with the direction", NULL};
    if (d->unexplained_count == 0) return;
    hci_html_section(out, "What no effect explains");
    hci_html_paragraph(
        out, NULL,
        "A description and not physics: T = (S sin nθ + C cos nθ) |i/A|^a |ω/(rad/s)|^b. It is "
        "not part of the corrected machine.");
    hci_html_table(out, "Orders that are left, and how they grow", COLUMN);
    for (size_t k = 0; k < d->unexplained_count; ++k) {
        const hci_unexplained *u = &d->unexplained[k];
        const double value[] = {u->order,     u->amplitude_Nm,     u->sine_Nm,
                                u->cosine_Nm, u->current_exponent, u->speed_exponent};
        hci_html_row(out);
        for (size_t j = 0; j < sizeof value / sizeof *value; ++j)
            hci_html_number(out, value[j]);
        hci_html_cell(out, u->turns_sign ? "yes" : "no");
        hci_html_row_end(out);
    }
    hci_html_table_end(out);
    hci_html_paragraph(out, "quiet", "Numbers: unexplained.csv.");
    hci_html_section_end(out);
}
