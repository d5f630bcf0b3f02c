/* The effects of a diagnosis by how much the recordings speak for them. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "host/plot/plot.h"
#include "host/plot/rows.h"

enum { EFFECTS = 170 }; /* x of where their names end */

static bool is_shown(const hci_finding *f)
{
    return f->verdict != HCI_FINDING_REJECTED || f->delta_bic > 1.0;
}

static const char *style_of(hci_finding_verdict verdict)
{
    static const char *const STYLE[] = {"after", "maybe", "before"};
    return STYLE[verdict];
}

const hci_effect *hci_plot_clearest(const hci_diagnosis *d, const hci_finding *f, size_t *term)
{
    const hci_effect *found = NULL;
    double most = 0.0;
    for (size_t k = 0; k < d->effects.list.count && f->verdict != HCI_FINDING_REJECTED; ++k) {
        const hci_effect *e = &d->effects.list.effect[k];
        if (strcmp(e->type->name, f->effect) != 0) continue;
        for (size_t j = 0; j < e->count; ++j) {
            const double clearness = fabs(e->term[j].value) / e->term[j].std_error;
            if (!(e->term[j].std_error > 0.0) || !(clearness > most)) continue;
            most = clearness;
            *term = j;
            found = e;
        }
    }
    return found;
}

static double rounded_percent(double percent)
{
    const double power = pow(10.0, 1.0 - floor(log10(percent)));
    return round(percent * power) / power;
}

/* "± 0.4 %" */
static void draw_uncertainty(hci_output *out, const hci_diagnosis *d, const hci_finding *f, double y)
{
    char text[HCI_SVG_NUMBER_SIZE + 16] = "± ";
    size_t term;
    const hci_effect *e = hci_plot_clearest(d, f, &term);
    if (!e) return;
    hci_svg_short_text(text + strlen(text),
                       rounded_percent(196.0 * e->term[term].std_error / fabs(e->term[term].value)));
    strcat(text, " %");
    hci_svg_label(out, "quiet end", HCI_ROWS_WIDTH - 8.0, y + 4.0, text);
}

static void draw_finding(hci_output *out, const hci_finding *f, double y, const hci_svg_axis *bic,
                         const hci_svg_axis *share)
{
    const char *style = style_of(f->verdict);
    hci_svg_name(out, f->verdict == HCI_FINDING_ADDED ? "head" : "quiet", 4.0, y + 4.0, f->effect,
                 EFFECTS - 8.0);
    if (f->delta_bic > 0.0)
        hci_svg_rectangle(out, style, bic->from, y - 6.0,
                          fmax(hci_svg_log_at(bic, f->delta_bic), bic->from + 1.5), y + 6.0);
    if (isfinite(f->residual_share))
        hci_svg_rectangle(out, style, share->from, y - 6.0,
                          fmax(hci_svg_at(share, 100.0 * f->residual_share), share->from + 1.5), y + 6.0);
}

static size_t shown_findings(const hci_diagnosis *d, const hci_finding *shown[HCI_MOST_FINDINGS])
{
    size_t rows = 0;
    for (size_t k = 0; k < d->findings; ++k)
        if (is_shown(&d->finding[k])) shown[rows++] = &d->finding[k];
    return rows;
}

static const char FINDINGS[] =
    "Two bars for each effect: the fall of the Bayesian information criterion on a logarithmic axis, and the "
    "share in per cent of the residual's mean square that is this effect's alone; at the right the 95 % "
    "interval "
    "of its clearest value, in per cent of it. The table beside it has the numbers.";

void hci_plot_findings(hci_output *out, const hci_diagnosis *d)
{
    static const hci_svg_entry LEGEND[] = {{HCI_SVG_BAR, "after", "added"},
                                           {HCI_SVG_BAR, "maybe", "ambiguous"},
                                           {HCI_SVG_BAR, "before", "rejected"}};
    const hci_finding *shown[HCI_MOST_FINDINGS];
    const size_t rows = shown_findings(d, shown);
    const hci_svg_box left = hci_rows_box(EFFECTS, 330.0, rows), right = hci_rows_box(356.0, 440.0, rows);
    hci_range most = {1.0, 10.0};
    hci_svg_axis bic, share = {0.0, 100.0, right.left, right.right, 50.0};
    for (size_t k = 0; k < rows; ++k)
        hci_range_include(&most, shown[k]->delta_bic);
    bic = hci_svg_log_axis((hci_range){1.0, most.high}, left.left, left.right, 12.0);
    hci_rows_begin(out, "findings", "Effects by how much the recordings speak for them", FINDINGS, rows);
    hci_svg_legend(out, LEGEND, 3, HCI_ROWS_WIDTH - 8.0, 18.0);
    hci_svg_label(out, "head", left.left, HCI_ROWS_TOP - 12.0, "ΔBIC");
    hci_svg_label(out, "head", right.left, HCI_ROWS_TOP - 12.0, "own share, %");
    hci_svg_label(out, "head end", HCI_ROWS_WIDTH - 8.0, HCI_ROWS_TOP - 12.0, "certainty");
    hci_svg_log_grid(out, &bic, &left, false);
    hci_svg_grid(out, &share, &right, false);
    if (rows == 0) hci_svg_label(out, "quiet", 4.0, HCI_ROWS_TOP - 12.0, "no effect is needed");
    for (size_t k = 0; k < rows; ++k) {
        draw_finding(out, shown[k], hci_rows_middle(k), &bic, &share);
        draw_uncertainty(out, d, shown[k], hci_rows_middle(k));
    }
    hci_rows_foot(out, &left, "logarithmic");
    hci_svg_end(out);
}
