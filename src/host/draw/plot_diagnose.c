/* The pictures of a diagnosis: rows with a name at the left and marks on an axis. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "host/draw/plot.h"

/* EFFECTS: where their names end. */
enum { WIDTH = 540, ROW = 21, FIRST_ROW = 62, EFFECTS = 170 };

/* Middle of row k. */
static double row_y(size_t k)
{
    return FIRST_ROW + ROW * ((double)k + 0.5);
}

static void begin_rows(hci_output *out, const char *id, const char *title, const char *description,
                       size_t rows)
{
    const int height = FIRST_ROW + ROW * (int)rows + 46;
    hci_svg_begin(out, &(hci_svg_picture){id, title, description, 0, 0, WIDTH, height});
}

static hci_svg_box box_of(double left, double right, size_t rows)
{
    return (hci_svg_box){left, FIRST_ROW, right, row_y(rows) - 0.5 * ROW};
}

static void draw_foot(hci_output *out, const hci_svg_box *b, const char *text)
{
    hci_svg_label(out, "quiet middle", 0.5 * (b->left + b->right), b->bottom + 36.0, text);
}

/* ---- effects ---- */

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
    hci_svg_label(out, "quiet end", WIDTH - 8.0, y + 4.0, text);
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
    const hci_svg_box left = box_of(EFFECTS, 330.0, rows), right = box_of(356.0, 440.0, rows);
    hci_range most = {1.0, 10.0};
    hci_svg_axis bic, share = {0.0, 100.0, right.left, right.right, 50.0};
    for (size_t k = 0; k < rows; ++k)
        hci_range_include(&most, shown[k]->delta_bic);
    bic = hci_svg_log_axis((hci_range){1.0, most.high}, left.left, left.right, 12.0);
    begin_rows(out, "findings", "Effects by how much the recordings speak for them", FINDINGS, rows);
    hci_svg_legend(out, LEGEND, 3, WIDTH - 8.0, 18.0);
    hci_svg_label(out, "head", left.left, FIRST_ROW - 12.0, "ΔBIC");
    hci_svg_label(out, "head", right.left, FIRST_ROW - 12.0, "own share, %");
    hci_svg_label(out, "head end", WIDTH - 8.0, FIRST_ROW - 12.0, "certainty");
    hci_svg_log_grid(out, &bic, &left, false);
    hci_svg_grid(out, &share, &right, false);
    if (rows == 0) hci_svg_label(out, "quiet", 4.0, FIRST_ROW - 12.0, "no effect is needed");
    for (size_t k = 0; k < rows; ++k) {
        draw_finding(out, shown[k], row_y(k), &bic, &share);
        draw_uncertainty(out, d, shown[k], row_y(k));
    }
    draw_foot(out, &left, "logarithmic");
    hci_svg_end(out);
}

/* ---- runs ---- */

static const hci_svg_box RUNS = {176, 0, 524, 0};

static double holdout_weight(const void *context, size_t k)
{
    const hci_run_errors *e = &((const hci_diagnosis *)context)->run[k];
    return e->role == HCI_ROLE_HOLDOUT ? e->rms_after_Nm : 0.0;
}

static double fit_weight(const void *context, size_t k)
{
    const hci_run_errors *e = &((const hci_diagnosis *)context)->run[k];
    return e->role == HCI_ROLE_FIT ? e->rms_after_Nm : 0.0;
}

static void draw_run(hci_output *out, const hci_run_errors *e, double y, const hci_svg_axis *x)
{
    const double before = hci_svg_log_at(x, e->rms_before_Nm), after = hci_svg_log_at(x, e->rms_after_Nm),
                 noise = hci_svg_log_at(x, e->noise_floor_Nm);
    hci_svg_name(out, "quiet", 4.0, y + 4.0, e->file, RUNS.left - 8.0);
    hci_svg_segment(out, "rail", before, y, after, y);
    hci_svg_segment(out, "spread", hci_svg_log_at(x, e->after_low_Nm), y, hci_svg_log_at(x, e->after_high_Nm),
                    y);
    hci_svg_circle(out, "before", before, y, 5.2); /* seen behind the other where nothing changes */
    hci_svg_circle(out, e->role == HCI_ROLE_FIT ? "dot" : "hollow", after, y, 4.0);
    if (noise > x->from) hci_svg_segment(out, "noise", noise, y - 7.0, noise, y + 7.0);
}

/* A heading takes a row of its own. Returns the next free row. */
static size_t draw_runs_of(hci_output *out, const hci_diagnosis *d, const char *heading, const size_t *place,
                           size_t count, size_t row, const hci_svg_axis *x)
{
    if (count == 0) return row;
    hci_svg_label(out, "head", 4.0, row_y(row++) + 5.0, heading);
    for (size_t k = 0; k < count; ++k)
        draw_run(out, &d->run[place[k]], row_y(row++), x);
    return row;
}

static hci_range range_of_runs(const hci_diagnosis *d, const size_t *place, size_t count, hci_range r)
{
    for (size_t k = 0; k < count; ++k) {
        const hci_run_errors *e = &d->run[place[k]];
        hci_range_include(&r, e->rms_before_Nm);
        hci_range_include(&r, e->rms_after_Nm);
        if (e->noise_floor_Nm > 0.0) hci_range_include(&r, e->noise_floor_Nm);
    }
    return r;
}

static const char ERRORS[] =
    "One row for each run, those that were held out first: rms of measured less modelled torque in N·m on a "
    "logarithmic axis, before and after the correction, and the noise of the recording. The bar behind a "
    "mark "
    "is its 95 % interval. The table beside it has the numbers.";

void hci_plot_runs(hci_output *out, const hci_diagnosis *d)
{
    static const hci_svg_entry LEGEND[] = {{HCI_SVG_DOT, "before", "before"},
                                           {HCI_SVG_DOT, "hollow", "after (held out)"},
                                           {HCI_SVG_DOT, "dot", "after (fitted)"},
                                           {HCI_SVG_LINE, "noise", "noise"}};
    size_t held[HCI_PLOT_MOST_RUNS], fitted[HCI_PLOT_MOST_RUNS];
    const size_t helds = hci_plot_largest(holdout_weight, d, d->runs, HCI_PLOT_MOST_RUNS, held),
                 fits = hci_plot_largest(fit_weight, d, d->runs, HCI_PLOT_MOST_RUNS, fitted),
                 rows = helds + (helds > 0) + fits + (fits > 0);
    const hci_svg_box b = box_of(RUNS.left, RUNS.right, rows);
    const hci_range r = range_of_runs(d, held, helds, range_of_runs(d, fitted, fits, HCI_RANGE_EMPTY));
    const hci_svg_axis x = hci_svg_log_axis(r, b.left, b.right, 4.0);
    begin_rows(out, "runs", "Error of each run before and after, with its noise", ERRORS, rows);
    hci_svg_legend(out, LEGEND, 4, RUNS.right, 18.0);
    hci_svg_log_grid(out, &x, &b, false);
    draw_runs_of(out, d, "Fitted", fitted, fits, draw_runs_of(out, d, "Held out", held, helds, 0, &x), &x);
    draw_foot(out, &b, "rms of the torque error in N·m, logarithmic");
    hci_svg_end(out);
}

/* ---- parameters ---- */

void hci_plot_term_name(char name[HCI_PLOT_NAME_SIZE], const hci_effect *effect, size_t term)
{
    const hci_effect_term *t = &effect->term[term];
    const hci_effect_parameter *p = &effect->type->parameter[t->parameter];
    char order[HCI_SVG_NUMBER_SIZE];
    hci_svg_short_text(order, t->order);
    snprintf(name, HCI_PLOT_NAME_SIZE, "%.40s%s%s", p->name, p->ordered ? "_" : "", p->ordered ? order : "");
}

static double half_interval(const hci_effect_term *t)
{
    return isfinite(t->std_error) ? 1.96 * t->std_error : 0.0;
}

static void draw_term(hci_output *out, const hci_effect *effect, size_t term, double y, const hci_svg_axis *x)
{
    const hci_effect_term *t = &effect->term[term];
    const double half = half_interval(t), low = hci_svg_at(x, t->value - half),
                 high = hci_svg_at(x, t->value + half);
    char name[HCI_PLOT_NAME_SIZE];
    hci_plot_term_name(name, effect, term);
    hci_svg_name(out, "quiet", 4.0, y + 4.0, name, RUNS.left - 8.0);
    hci_svg_segment(out, "after", low, y, high, y);
    hci_svg_segment(out, "after", low, y - 5.0, low, y + 5.0);
    hci_svg_segment(out, "after", high, y - 5.0, high, y + 5.0);
    hci_svg_circle(out, "dot", hci_svg_at(x, t->value), y, 3.0);
}

void hci_plot_terms(hci_output *out, const char *id, const char *title, const hci_effect *effect,
                    const size_t *term, size_t count)
{
    const hci_svg_box b = box_of(RUNS.left, RUNS.right, count);
    const char *unit = effect->type->parameter[effect->term[term[0]].parameter].unit;
    hci_range r = {0.0, 0.0};
    hci_svg_axis x;
    char foot[64];
    for (size_t k = 0; k < count; ++k) {
        const hci_effect_term *t = &effect->term[term[k]];
        hci_range_include(&r, t->value - half_interval(t));
        hci_range_include(&r, t->value + half_interval(t));
    }
    x = hci_svg_axis_over(r, b.left, b.right, 5.0);
    begin_rows(
        out, id, title,
        "One row for each parameter: the value and its 95 % interval. The table beside it has the numbers.",
        count);
    hci_svg_name(out, "head", 4.0, FIRST_ROW - 34.0, title, WIDTH);
    hci_svg_grid(out, &x, &b, false);
    for (size_t k = 0; k < count; ++k)
        draw_term(out, effect, term[k], row_y(k), &x);
    snprintf(foot, sizeof foot, "value%s%.40s", strcmp(unit, "1") == 0 ? ", without unit" : " in ",
             strcmp(unit, "1") == 0 ? "" : unit);
    draw_foot(out, &b, foot);
    hci_svg_end(out);
}
