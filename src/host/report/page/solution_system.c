/* The section of a solution's page about the system that was solved. */
#include <math.h>
#include <stdio.h>

#include "host/draw/html.h"
#include "host/report/page/solution_sections.h"

enum { MOST_REACHED = 12, MOST_COMPONENTS = 60 }; /* that a table lists */

/* Of one component: how many torque orders it reaches, the first of them, and its largest entry. */
typedef struct {
    size_t count;
    double order[MOST_REACHED], largest_Nm_per_A;
} reach;

static double order_of_row(const hci_solution *s, size_t row)
{
    return s->order[(row + hci_page_has_mean(s)) / 2].torque_Nm.order;
}

static double largest_entry(const hci_solved_system *u)
{
    double largest = 0.0;
    for (int64_t k = 0; k < u->column_start[2 * u->set.count]; ++k)
        largest = fmax(largest, fabs(u->value[k]));
    return largest;
}

static void add_reached(reach *r, double order)
{
    const size_t known = r->count < MOST_REACHED ? r->count : MOST_REACHED;
    for (size_t k = 0; k < known; ++k)
        if (r->order[k] == order) return;
    if (r->count < MOST_REACHED) r->order[r->count] = order;
    ++r->count;
}

/* Rows ascend in each of the two columns; both reach nearly the same orders, so that they are merged by row.
 */
static reach reach_of(const hci_solution *s, size_t component, double least)
{
    const hci_solved_system *u = &s->system;
    int64_t first = u->column_start[2 * component], second = u->column_start[2 * component + 1];
    const int64_t middle = second, end = u->column_start[2 * component + 2];
    double last = -1.0;
    reach r = {0};
    while (first < middle || second < end) {
        const bool take_first = second == end || (first < middle && u->row[first] <= u->row[second]);
        const int64_t k = take_first ? first++ : second++;
        const double order = order_of_row(s, (size_t)u->row[k]);
        if (fabs(u->value[k]) <= least) continue;
        r.largest_Nm_per_A = fmax(r.largest_Nm_per_A, fabs(u->value[k]));
        if (order != last) add_reached(&r, order);
        last = order;
    }
    return r;
}

static void cell_of_reach(hci_output *out, const reach *r)
{
    char text[HCI_HTML_NUMBER_SIZE * (MOST_REACHED + 1)] = "none";
    size_t used = 0;
    for (size_t k = 0; k < r->count && k < MOST_REACHED; ++k) {
        char order[HCI_HTML_NUMBER_SIZE];
        hci_html_number_text(order, r->order[k]);
        used += (size_t)snprintf(text + used, sizeof text - used, "%s%s", k > 0 ? ", " : "", order);
    }
    if (r->count > MOST_REACHED) snprintf(text + used, sizeof text - used, " … %zu in all", r->count);
    hci_html_cell_words(out, text);
}

static void table_of_components(hci_output *out, const hci_solution *s, double least)
{
    static const char *const COLUMN[] = {
        "Order", "<Set", "Largest entry N·m/A", "<Current", "<Torque orders that it reaches", NULL};
    const hci_component_set *set = &s->system.set;
    const size_t shown = set->count < MOST_COMPONENTS ? set->count : MOST_COMPONENTS;
    char caption[120];
    snprintf(caption, sizeof caption, "What each component reaches: %s%zu of %zu",
             shown < set->count ? "the first " : "", shown, set->count);
    hci_html_table(out, caption, COLUMN);
    for (size_t k = 0; k < shown; ++k) {
        const reach r = reach_of(s, k, least);
        hci_html_row(out);
        hci_html_number(out, set->component[k].order);
        hci_html_cell(out, hci_set_name(set->set[k]));
        hci_html_number(out, r.largest_Nm_per_A);
        hci_html_cell(out, hci_plot_is_used(s, set->component[k]) ? "flows" : "left out");
        cell_of_reach(out, &r);
        hci_html_row_end(out);
    }
    hci_html_table_end(out);
}

static size_t count_unreachable(const hci_solution *s)
{
    size_t count = 0;
    for (size_t k = 0; k < s->order_count; ++k)
        count += s->order[k].verdict == HCI_ORDER_UNREACHABLE;
    return count;
}

static size_t count_unused(const hci_solution *s)
{
    size_t count = 0;
    for (size_t k = 0; k < s->system.set.count; ++k)
        count += !hci_plot_is_used(s, s->system.set.component[k]);
    return count;
}

static void table_of_system(hci_output *out, const hci_solution *s, double least)
{
    static const char *const COLUMN[] = {"<Quantity", "Value", NULL};
    const hci_solved_system *u = &s->system;
    const size_t rows = 2 * s->order_count - hci_page_has_mean(s), columns = 2 * u->set.count;
    size_t filled = 0;
    for (int64_t k = 0; k < u->column_start[columns]; ++k)
        filled += fabs(u->value[k]) > least;
    hci_html_table(out, "Size and rank", COLUMN);
    hci_html_quantity(out, "equations that were solved", (double)s->rows);
    hci_html_quantity(out, "unknowns", (double)s->unknowns);
    hci_html_quantity(out, "rank", (double)s->rank);
    hci_html_quantity(out, "condition, an estimate", s->condition);
    hci_html_quantity(out, "rows of U as drawn", (double)rows);
    hci_html_quantity(out, "columns of U as drawn", (double)columns);
    hci_html_quantity(out, "non-zeros", (double)filled);
    hci_html_quantity(out, "share of all entries in %", 100.0 * (double)filled / (double)(rows * columns));
    hci_html_quantity(out, "orders missed that no component reaches", (double)count_unreachable(s));
    hci_html_quantity(out, "components left out: no current flows", (double)count_unused(s));
    hci_html_table_end(out);
}

void hci_page_system(const hci_solution_page *p)
{
    hci_output *out = p->out;
    const hci_solution *s = p->solution;
    const bool has_picture = s->system.set.count > 0 && s->order_count > 0;
    hci_html_section(out, "The system that was solved");
    hci_html_paragraph(out, NULL,
                       has_picture
                           ? "U x = h: each column of U is the torque that 1 A of a current component makes, "
                             "each row one equation of "
                             "a torque order. An order can be given any value only if its rows have entries."
                           : "There is no system of equations: the currents were found angle by angle, or no "
                             "component was to be found.");
    if (has_picture) {
        const double least = HCI_PLOT_ZERO * largest_entry(&s->system);
        hci_html_figure(out);
        hci_plot_system(out, s);
        hci_html_figure_tables(out);
        table_of_system(out, s, least);
        table_of_components(out, s, least);
        hci_html_figure_end(
            out,
            "Without the weights of the orders; entries below a millionth of the largest are not counted. "
            "Grey, and in parentheses, is what took no part: orders that are not cared for or not compared, "
            "components without current. Where the torque is not linear in the currents, U is that of the "
            "last step, and its highest rows may be no equations: they fall off by themselves.",
            "of this page; size, rank and condition also in summary.json", p->origin);
    }
    hci_html_section_end(out);
}
