/* The section of a simulation about its torque ripple by order. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "host/base/memory.h"
#include "host/draw/html.h"
#include "host/plot/plot.h"
#include "host/report/page/simulation_sections.h"

enum { MOST_ORDERS = 24, LEAST_FOR_FLOOR = 8, CAPTION_SIZE = HCI_PAGE_BASELINE_SIZE + 500 };

/* What rounding leaves of the torque at any order, as a share of the torque. */
#define ROUNDING 1e-12

static double rounding_Nm(const hci_simulation *s)
{
    return ROUNDING * fmax(fabs(s->torque_Nm.most), fabs(s->torque_Nm.least));
}

static double order_weight(const void *context, size_t k)
{
    const hci_simulation *s = context;
    const hci_harmonic h = s->spectrum_Nm[k];
    const double size_Nm = fmax(hci_amplitude(h.sine, h.cosine), hci_page_before_Nm(s, h.order));
    return k == 0 ? 1e100 : size_Nm > rounding_Nm(s) ? size_Nm : 0.0;
}

static void table_of_orders(hci_output *out, const hci_simulation *s)
{
    static const char *const COLUMN[] = {"Order",     "Before N·m",    "After N·m",
                                         "Phase rad", "% of the mean", NULL};
    const double least_Nm = rounding_Nm(s);
    const double mean_Nm = isfinite(s->T_ripple_percent) ? fabs(s->spectrum_Nm[0].cosine) : (double)NAN;
    size_t place[MOST_ORDERS];
    const size_t count = hci_plot_largest(order_weight, s, s->spectrum_count, MOST_ORDERS, place);
    char caption[120];
    snprintf(caption, sizeof caption, "The mean, order 0, and the largest of %zu orders", s->spectrum_count);
    hci_html_table(out, caption, COLUMN);
    for (size_t k = 0; k < count; ++k) {
        const hci_harmonic h = s->spectrum_Nm[place[k]];
        const bool mean = place[k] == 0;
        const double size_Nm = mean ? h.cosine : hci_amplitude(h.sine, h.cosine);
        hci_html_row(out);
        hci_html_number(out, h.order);
        hci_html_number_above(out, hci_page_before_Nm(s, h.order), least_Nm);
        hci_html_number_above(out, size_Nm, least_Nm);
        if (mean || size_Nm >= least_Nm)
            hci_html_number(out, mean ? HCI_PI / 2 : hci_phase_rad(h.sine, h.cosine));
        else
            hci_html_number(out, (double)NAN);
        hci_html_number_above(out, 100.0 * size_Nm / mean_Nm, 100.0 * least_Nm / mean_Nm);
        hci_html_row_end(out);
    }
    hci_html_table_end(out);
}

static int by_size(const void *a, const void *b)
{
    const double x = ((const hci_plot_order *)a)->after_Nm, y = ((const hci_plot_order *)b)->after_Nm;
    return (x > y) - (x < y);
}

static int by_order(const void *a, const void *b)
{
    const double x = ((const hci_plot_order *)a)->order, y = ((const hci_plot_order *)b)->order;
    return (x > y) - (x < y);
}

/* The median: what switching, noise and steps leave at any order, since what repeats with the turn is at few
 * of them. None where that is rounding alone. */
static void set_floor(hci_plot_order *order, size_t count, double least_Nm)
{
    if (count < LEAST_FOR_FLOOR) return;
    qsort(order, count, sizeof *order, by_size);
    const double floor_Nm = order[count / 2].after_Nm;
    for (size_t k = 0; k < count && floor_Nm >= least_Nm; ++k)
        order[k].noise_Nm = floor_Nm;
    qsort(order, count, sizeof *order, by_order);
}

/* What the orders are compared with, whether they are wanted, and what the floor is. */
static void caption_of(char text[CAPTION_SIZE], const hci_simulation *s, double floor_Nm)
{
    char floor[HCI_HTML_NUMBER_SIZE];
    const bool has_floor = isfinite(floor_Nm);
    hci_html_quantity_text(floor, floor_Nm, "N·m");
    snprintf(text, CAPTION_SIZE,
             "Over whole periods of the angle; the picture leaves the mean out%s. %s%s%s%s",
             hci_page_has_before(s) ? ", and what is more than four decades below the largest" : "",
             s->imposed ? "The currents are imposed, and some of these orders may be wanted: the target that "
                          "they were made for is not part of a simulation."
                        : "A strategy asks for a constant torque: it wants none of these orders.",
             has_floor ? " The floor is the median of all orders, " : "", has_floor ? floor : "",
             has_floor ? ": about what switching and noise leave anywhere." : "");
}

static void heading_of(const hci_simulation *s, const hci_plot_order *order, char text[256])
{
    char number[HCI_HTML_NUMBER_SIZE], after[HCI_HTML_NUMBER_SIZE], before[HCI_HTML_NUMBER_SIZE];
    double before_Nm = 0.0;
    size_t most = 0;
    for (size_t k = 0; k + 1 < s->spectrum_count; ++k) {
        before_Nm = fmax(before_Nm, order[k].before_Nm);
        if (order[k].after_Nm > order[most].after_Nm) most = k;
    }
    hci_html_number_text(number, order[most].order);
    hci_html_quantity_text(after, order[most].after_Nm, "N·m");
    hci_html_quantity_text(before, before_Nm, "N·m");
    if (order[most].after_Nm < rounding_Nm(s))
        snprintf(text, 256,
                 hci_page_has_before(s) ? "No order is left; the largest of a plain sine has %s"
                                        : "No order is there",
                 before);
    else if (hci_page_has_before(s))
        snprintf(text, 256, "The largest order, %s, has %s; that of a plain sine has %s", number, after,
                 before);
    else
        snprintf(text, 256, "The largest order, %s, has %s", number, after);
}

static void show_orders(hci_output *out, const hci_simulation *s, const hci_plot_order *order,
                        const char *origin)
{
    const hci_plot_orders_data data = {order, s->spectrum_count - 1, "Torque ripple in N·m, peak", "floor",
                                       hci_page_has_before(s)};
    char caption[CAPTION_SIZE], heading[256];
    caption_of(caption, s, order[0].noise_Nm);
    const hci_html_drawing drawing = {
        .id = "spectrum",
        .title = "Torque ripple by electrical order",
        .description = "A stem for each order but 0, the mean: peak amplitude in N·m, with a plain sine and "
                       "simulated. The table has the largest.",
        .caption = caption,
        .wide = 290,
        .narrow = 300,
        .draw = hci_plot_orders,
        .context = &data};
    heading_of(s, order, heading);
    hci_html_section(out, heading);
    hci_html_drawing_begin(out, &drawing);
    table_of_orders(out, s);
    hci_html_drawing_end(out, "spectrum.csv", origin);
    hci_html_section_end(out);
}

hci_status hci_page_spectrum(hci_output *out, const hci_simulation *s, const char *origin, hci_note *note)
{
    if (s->spectrum_count < 2) return HCI_OK;
    hci_plot_order *order = hci_memory_new(s->spectrum_count, sizeof *order);
    if (!order) return hci_note_memory(note, NULL, "the report");
    for (size_t k = 1; k < s->spectrum_count; ++k) {
        const hci_harmonic h = s->spectrum_Nm[k];
        order[k - 1] = (hci_plot_order){.order = h.order,
                                        .before_Nm = hci_page_before_Nm(s, h.order),
                                        .after_Nm = hci_amplitude(h.sine, h.cosine),
                                        .noise_Nm = NAN};
    }
    set_floor(order, s->spectrum_count - 1, rounding_Nm(s));
    show_orders(out, s, order, origin);
    hci_memory_free(order);
    return HCI_OK;
}
