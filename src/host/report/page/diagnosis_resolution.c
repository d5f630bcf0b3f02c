/* The section of a diagnosis about the currents that were solved again. */
#include "host/draw/html.h"
#include "host/report/page/diagnosis_sections.h"

static void row_of_evaluations(hci_output *out, const char *name, double old_value, double new_value)
{
    hci_html_row(out);
    hci_html_cell(out, name);
    hci_html_number(out, old_value);
    hci_html_number(out, new_value);
    hci_html_row_end(out);
}

void hci_page_resolution(hci_output *out, const hci_resolution *r)
{
    static const char *const COLUMN[] = {"<On the corrected machine", "Old currents", "New currents", NULL};
    const hci_torque_evaluation *a = &r->old_currents, *b = &r->new_currents;
    char expected[1024];
    hci_html_section(out, "Currents for the wanted torque");
    hci_html_paragraph(out, NULL,
                       "Old currents were found for the declared machine, new ones for the corrected one. "
                       "Both are judged on the corrected one. The new ones are in the folder solution.");
    hci_html_table(out, "What both currents do", COLUMN);
    row_of_evaluations(out, "mean torque N·m", a->mean_Nm, b->mean_Nm);
    row_of_evaluations(out, "rms error of the torque N·m", a->rms_error_Nm, b->rms_error_Nm);
    row_of_evaluations(out, "largest error of an order N·m", a->worst_error_Nm, b->worst_error_Nm);
    row_of_evaluations(out, "at order", a->worst_order, b->worst_order);
    row_of_evaluations(out, "peak to peak N·m", a->peak_to_peak_Nm, b->peak_to_peak_Nm);
    row_of_evaluations(out, "T_ripple %", a->T_ripple_percent, b->T_ripple_percent);
    row_of_evaluations(out, "F_ripple %", a->F_ripple_percent, b->F_ripple_percent);
    row_of_evaluations(out, "mean of i_a² + i_b² + i_c² in A²", r->before.mean_square_A2,
                       r->after.mean_square_A2);
    hci_html_table_end(out);
    hci_expected_ripple_words(&r->after.expected, expected, sizeof expected);
    hci_html_say(out, NULL, "The new currents on the real machine: %s", expected);
    hci_html_paragraph(out, "quiet", "Numbers: summary.json.");
    hci_html_section_end(out);
}
