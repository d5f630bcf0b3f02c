#include <math.h>
#include <stdio.h>
#include <string.h>

#include "host/plot/fleet/plot_fleet.h"

enum { MOST_BATCHES = 400 };

/* How much a parameter asks to be shown. */
static double rank_of(const hci_line_parameter *p)
{
    const double trend = p->has_trend ? fabs(p->per_day) / p->per_day_std_error : 0.0;
    return fmax(trend, p->has_batches ? p->batch_criterion : 0.0);
}

static size_t chosen(const hci_line *l, size_t parameter[HCI_PLOT_MOST_TRENDS])
{
    size_t count = 0;
    for (size_t k = 0; k < l->parameters; ++k) {
        size_t at = count;
        if (!(rank_of(&l->parameter[k]) > 0.0)) continue;
        while (at > 0 && rank_of(&l->parameter[parameter[at - 1]]) < rank_of(&l->parameter[k]))
            --at;
        if (at == HCI_PLOT_MOST_TRENDS) continue;
        if (count < HCI_PLOT_MOST_TRENDS) ++count;
        memmove(parameter + at + 1, parameter + at, (count - at - 1) * sizeof *parameter);
        parameter[at] = k;
    }
    return count;
}

size_t hci_plot_batches_count(const hci_line *line)
{
    size_t parameter[HCI_PLOT_MOST_TRENDS];
    return chosen(line, parameter);
}

/* A batch in the order of its first motor. */
typedef struct {
    const char *name;
    double sum, square, count;
} batch;

static size_t sum_up(const hci_line *l, size_t parameter, batch *of)
{
    size_t count = 0;
    for (size_t k = 0; k < l->motors; ++k) {
        const double value = l->value[k * l->parameters + parameter];
        size_t at = 0;
        if (isnan(value) || l->motor[k].stands_out) continue;
        while (at < count && strcmp(of[at].name, l->motor[k].batch) != 0)
            ++at;
        if (at == MOST_BATCHES) continue;
        if (at == count) of[count++] = (batch){l->motor[k].batch, 0.0, 0.0, 0.0};
        of[at].sum += value;
        of[at].square += value * value;
        of[at].count += 1.0;
    }
    return count;
}

static double mean_of(const batch *b)
{
    return b->sum / b->count;
}

static double half_width(const batch *b)
{
    const double variance = b->count > 1.0 ? (b->square - b->sum * mean_of(b)) / (b->count - 1.0) : 0.0;
    return 2.0 * sqrt(fmax(variance, 0.0) / b->count);
}

static void draw_panel(hci_output *out, const hci_line *l, size_t parameter, hci_svg_box box)
{
    batch of[MOST_BATCHES];
    char name[96], title[160];
    const size_t count = sum_up(l, parameter, of);
    hci_range r = HCI_RANGE_EMPTY, places = {0.0, (double)count + 1.0};
    for (size_t k = 0; k < count; ++k) {
        hci_range_include(&r, mean_of(&of[k]) - half_width(&of[k]));
        hci_range_include(&r, mean_of(&of[k]) + half_width(&of[k]));
    }
    const hci_svg_axis y = hci_svg_axis_over(r, box.bottom, box.top, 5.0);
    const hci_svg_box b = hci_svg_box_beside(box, &y);
    const hci_svg_axis x = hci_svg_axis_over(places, b.left, b.right, 10.0);
    hci_plot_parameter_name(l, parameter, name);
    snprintf(title, sizeof title, "%s%s%s", name,
             strcmp(l->parameter[parameter].name.unit, "1") == 0 ? "" : " in ",
             strcmp(l->parameter[parameter].name.unit, "1") == 0 ? "" : l->parameter[parameter].name.unit);
    hci_svg_name(out, "head", b.left, b.top - 10.0, title, b.right - b.left);
    hci_svg_grid(out, &x, &b, false);
    hci_svg_grid(out, &y, &b, true);
    for (size_t k = 0; k < count; ++k) {
        const double at = hci_svg_at(&x, (double)k + 1.0), mean = mean_of(&of[k]), half = half_width(&of[k]);
        hci_svg_tell(out, of[k].name);
        hci_svg_tell_value(out, ": ", mean, l->parameter[parameter].name.unit);
        hci_svg_hint(out);
        hci_svg_segment(out, "edge", at, hci_svg_at(&y, mean - half), at, hci_svg_at(&y, mean + half));
        hci_svg_circle(out, "dot", at, hci_svg_at(&y, mean), 2.6);
        hci_svg_hint_end(out);
    }
}

void hci_plot_batches(hci_output *out, const hci_svg_box *area, const void *context)
{
    const hci_line *l = context;
    size_t parameter[HCI_PLOT_MOST_TRENDS];
    const size_t count = chosen(l, parameter);
    for (size_t k = 0; k < count; ++k) {
        hci_svg_box box = *area;
        const double height = (area->bottom - area->top) / (double)count;
        box.top = area->top + (double)k * height + 28.0;
        box.bottom = area->top + (double)(k + 1) * height - (k + 1 < count ? 20.0 : 0.0);
        draw_panel(out, l, parameter[k], box);
    }
    hci_svg_label(out, "quiet middle", 0.5 * (area->left + area->right), area->bottom + 35.0,
                  "batches in their order; bars: twice the standard error");
}
