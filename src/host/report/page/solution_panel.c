/* What the sections of a solution share: rows of the tables, and a panel with its tables. */
#include "host/draw/html.h"
#include "host/report/page/solution_sections.h"

bool hci_page_has_mean(const hci_solution *s)
{
    return s->order_count > 0 && s->order[0].torque_Nm.order < HCI_ORDER_TOLERANCE;
}

double hci_page_angle_deg(size_t step)
{
    return 360.0 / HCI_PAGE_STEPS * (double)step;
}

void hci_page_row(hci_output *out, const double *value, size_t count)
{
    hci_html_row(out);
    for (size_t k = 0; k < count; ++k)
        hci_html_number(out, value[k]);
    hci_html_row_end(out);
}

void hci_page_row_of_range(hci_output *out, const char *name, hci_range r, double least)
{
    hci_html_row(out);
    hci_html_cell(out, name);
    hci_html_number(out, r.low);
    hci_html_number(out, r.high);
    hci_html_number_above(out, r.high - r.low, least);
    hci_html_row_end(out);
}

void hci_page_panel(const hci_solution_page *p, hci_plot_panel panel,
                    void (*tables)(const hci_solution_page *p), const char *caption, const char *numbers)
{
    hci_html_figure(p->out);
    hci_plot_solution_panel(p->out, p->solution, panel);
    hci_html_figure_tables(p->out);
    tables(p);
    hci_html_figure_end(p->out, caption, numbers, p->origin);
}
