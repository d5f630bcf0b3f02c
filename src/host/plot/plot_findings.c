/* The effects of a diagnosis by the torque that each alone explains. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "host/plot/plot.h"
#include "host/plot/rows.h"

double hci_plot_own_Nm(const hci_diagnosis *d, const hci_finding *f)
{
    return f->verdict == HCI_FINDING_REJECTED ? (double)NAN : sqrt(f->residual_share) * d->rms_before_Nm;
}

size_t hci_plot_findings_shown(const hci_diagnosis *d, const hci_finding *shown[HCI_MOST_FINDINGS])
{
    size_t rows = 0;
    for (size_t k = 0; k < d->findings; ++k)
        if (hci_plot_own_Nm(d, &d->finding[k]) > 0.0) shown[rows++] = &d->finding[k];
    return rows;
}

void hci_plot_term_name(char name[HCI_PLOT_NAME_SIZE], const hci_effect *effect, size_t term)
{
    const hci_effect_term *t = &effect->term[term];
    const hci_effect_parameter *p = &effect->type->parameter[t->parameter];
    char order[HCI_SVG_NUMBER_SIZE];
    hci_svg_short_text(order, t->order);
    snprintf(name, HCI_PLOT_NAME_SIZE, "%.40s%s%s", p->name, p->ordered ? "_" : "", p->ordered ? order : "");
}

/* The lines that all effects are compared with. */
typedef struct {
    const char *style, *name;
    double value_Nm;
} level;

static void draw_level(hci_output *out, const hci_svg_axis *x, const hci_svg_box *b, const level *l)
{
    const double at = hci_svg_log_at(x, l->value_Nm);
    if (!(l->value_Nm > 0.0) || at <= x->from) return;
    hci_svg_tell(out, l->name);
    hci_svg_tell_value(out, ": ", l->value_Nm, "N·m");
    hci_svg_hint(out);
    hci_svg_segment(out, l->style, at, b->top, at, b->bottom);
    hci_svg_hint_end(out);
}

static void draw_finding(hci_output *out, const hci_diagnosis *d, const hci_finding *f, double y,
                         const hci_svg_axis *x)
{
    const double own_Nm = hci_plot_own_Nm(d, f), at = hci_svg_log_at(x, own_Nm);
    hci_svg_tell(out, hci_finding_title(f->effect));
    hci_svg_tell_value(out, ": by it alone ", own_Nm, "N·m");
    hci_svg_tell_more(out, ", ");
    hci_svg_tell_more(out, hci_finding_verdict_name(f->verdict));
    hci_svg_hint(out);
    hci_svg_segment(out, "rail", x->from, y, at, y);
    hci_svg_circle(out, f->verdict == HCI_FINDING_ADDED ? "dot" : "maybe", at, y, 5.0);
    hci_svg_hint_end(out);
}

static hci_svg_axis axis_of(const hci_diagnosis *d, const hci_finding *const *shown, size_t rows,
                            const hci_svg_box *b)
{
    hci_range r = HCI_RANGE_EMPTY;
    hci_range_include(&r, d->rms_before_Nm);
    if (d->rms_after_Nm > 0.0) hci_range_include(&r, d->rms_after_Nm);
    for (size_t k = 0; k < rows; ++k)
        hci_range_include(&r, hci_plot_own_Nm(d, shown[k]));
    r.low *= 0.5;
    return hci_svg_log_axis(r, b->left, b->right, 5.0);
}

static bool any_ambiguous(const hci_finding *const *shown, size_t rows)
{
    for (size_t k = 0; k < rows; ++k)
        if (shown[k]->verdict == HCI_FINDING_AMBIGUOUS) return true;
    return false;
}

void hci_plot_findings(hci_output *out, const hci_svg_box *area, const void *diagnosis)
{
    static const hci_svg_entry LEGEND[] = {{HCI_SVG_DOT, "dot", "by it alone"},
                                           {HCI_SVG_LINE, "before", "error before"},
                                           {HCI_SVG_LINE, "after", "error after"},
                                           {HCI_SVG_LINE, "noise", "noise"},
                                           {HCI_SVG_DOT, "maybe", "by it or another"}};
    const hci_diagnosis *d = diagnosis;
    const level levels[] = {{"before", "error before", d->rms_before_Nm},
                            {"after", "error after", d->rms_after_Nm},
                            {"noise", "noise", d->noise_Nm}};
    const hci_finding *shown[HCI_MOST_FINDINGS];
    const size_t rows = hci_plot_findings_shown(d, shown);
    const hci_svg_box b = hci_rows_box(area);
    const hci_svg_axis x = axis_of(d, shown, rows, &b);
    hci_svg_head(out, area, "Explained torque, rms", LEGEND, any_ambiguous(shown, rows) ? 5 : 4);
    hci_svg_log_grid(out, &x, &b, false);
    for (size_t k = 0; k < 3; ++k)
        draw_level(out, &x, &b, &levels[k]);
    for (size_t k = 0; k < rows; ++k) {
        hci_rows_name(out, &b, k, shown[k]->verdict == HCI_FINDING_ADDED,
                      hci_finding_title(shown[k]->effect));
        draw_finding(out, d, shown[k], hci_rows_middle(&b, k), &x);
    }
    hci_rows_foot(out, &b, "N·m, logarithmic");
}
