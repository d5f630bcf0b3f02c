/* The page of a solution: verdict, the pictures, and how it was found. */
#include <math.h>
#include <stdio.h>

#include "host/report/page/solution_sections.h"

static void table_of_cost(const hci_solution_page *p)
{
    static const char *const COLUMN[] = {"<Quantity", "Value", NULL};
    const hci_solution *s = p->solution;
    hci_output *out = p->out;
    hci_html_table(out, "Cost and method", COLUMN);
    hci_html_quantity(out, "mean of i_a² + i_b² + i_c² in A²", s->mean_square_A2);
    hci_html_quantity(out, "amplitude of the plain sine in A", s->plain_amplitude_A);
    hci_html_quantity(out, "copper loss to that of the plain sine", s->loss_to_plain);
    hci_html_quantity(out, "copper loss to the least possible", s->loss_to_limit);
    hci_html_quantity(out, "mean torque at which currents of this shape keep the current limit in N·m",
                      s->torque_at_limit_Nm);
    hci_html_quantity(out, "peak of the neutral current in A", s->peak_neutral_A);
    hci_html_quantity(out, "rms of the neutral current in A", s->rms_neutral_A);
    hci_html_quantity(out, "equations that were solved", (double)s->rows);
    hci_html_quantity(out, "unknowns", (double)s->unknowns);
    hci_html_quantity(out, "rank", (double)s->rank);
    hci_html_quantity(out, "condition, an estimate", s->condition);
    hci_html_table_end(out);
}

static void show_method(const hci_solution_page *p)
{
    const hci_solution *s = p->solution;
    hci_html_fold(p->out, "Cost and method in numbers");
    table_of_cost(p);
    hci_html_say(p->out, "quiet", "Method: %s%s.%s Beside this page: summary.json.",
                 hci_method_name(s->method),
                 s->newton_steps == 0  ? ""
                 : s->newton_converged ? "; Newton's method converged"
                                       : "; Newton's method did not converge, this is the nearest answer",
                 s->with_effects ? " The machine is taken with its effects." : "");
    hci_html_fold_end(p->out);
}

void hci_page_solution(hci_output *out, const hci_solution *s, hci_status verdict,
                       const hci_report_sources *sources)
{
    hci_solution_page p = {.out = out, .solution = s};
    hci_plot_solution_facts(s, &p.facts);
    hci_page_origin(p.origin, sources);
    hci_page_solution_verdict(&p, verdict, sources->machine);
    hci_page_torque(&p);
    hci_page_currents(&p);
    hci_page_limits(&p);
    hci_page_torque_orders(&p);
    hci_page_vector(&p);
    show_method(&p);
    hci_page_show_sources(out, sources);
    hci_html_end(out);
}
