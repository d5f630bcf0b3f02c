/* The page of a diagnosis: verdict, then the evidence. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "host/base/memory.h"
#include "host/draw/html.h"
#include "host/plot/plot.h"
#include "host/report/page/page.h"

enum { WORDS_SIZE = 2048, MOST_ORDERS = 24, MOST_LINES = 40, MOST_TERMS = 16 };

/* ---- verdict ---- */

static void say_verdict(hci_output *out, const hci_diagnosis *d)
{
    static const char *const BADGE[] = {"Nothing is missing", "Explained",
                                        "Ambiguous: more than one explanation fits", "Not explained"};
    char words[WORDS_SIZE];
    hci_diagnosis_words(d, words, sizeof words);
    hci_html_begin(out, "Diagnosis of the machine model", BADGE[d->verdict],
                   d->verdict <= HCI_DIAGNOSIS_EXPLAINED);
    hci_html_paragraph(out, "lead", words);
}

static void tile_of_errors(hci_output *out, const char *name, double before, double after, double noise)
{
    char from[HCI_HTML_NUMBER_SIZE], to[HCI_HTML_NUMBER_SIZE], floor[HCI_HTML_NUMBER_SIZE], value[128],
        remark[160];
    if (!isfinite(after)) return;
    hci_html_number_text(from, before);
    hci_html_number_text(to, after);
    hci_html_number_text(floor, noise);
    snprintf(value, sizeof value, "%s → %s N·m", from, to);
    snprintf(remark, sizeof remark, "rms before → after; noise %s N·m", floor);
    hci_html_tile(out, name, value, remark);
}

static void show_tiles(hci_output *out, const hci_diagnosis *d)
{
    size_t held = 0, added = 0;
    char runs[64], effects[64], remark[64];
    for (size_t k = 0; k < d->runs; ++k)
        held += d->run[k].role == HCI_ROLE_HOLDOUT;
    for (size_t k = 0; k < d->findings; ++k)
        added += d->finding[k].verdict == HCI_FINDING_ADDED && strcmp(d->finding[k].effect, "unknown") != 0;
    snprintf(runs, sizeof runs, "%zu", d->runs);
    snprintf(remark, sizeof remark, "%zu fitted, %zu held out as a test", d->runs - held, held);
    snprintf(effects, sizeof effects, "%zu", added);
    hci_html_tiles(out);
    tile_of_errors(out, "Error on runs held out", d->holdout_before_Nm, d->holdout_after_Nm,
                   d->holdout_noise_Nm);
    tile_of_errors(out, "Error on runs fitted", d->rms_before_Nm, d->rms_after_Nm, d->noise_Nm);
    hci_html_tile(out, "Recordings", runs, remark);
    hci_html_tile(out, "Effects added", effects, "see “What the model lacks”");
    hci_html_tiles_end(out);
}

static void say_advice(hci_output *out, const hci_diagnosis *d)
{
    if (d->advice[0] == '\0') return;
    hci_html_section(out, "What to measure next");
    hci_html_paragraph(out, NULL, d->advice);
    hci_html_section_end(out);
}

/* ---- effects ---- */

static const char *unit_of(const hci_effect *e, size_t term)
{
    return e->type->parameter[e->term[term].parameter].unit;
}

/* For an effect that is in the game, how it shows itself; parameters have a table of their own. */
static void cell_of_finding(hci_output *out, const hci_finding *f)
{
    const hci_effect_type *type = hci_effect_type_find(f->effect);
    char text[HCI_DETAIL_SIZE + 16];
    const bool rival = strncmp(f->detail, "in place of", 11) == 0;
    snprintf(text, sizeof text, "%s", type && !rival ? type->signature : f->detail);
    hci_html_cell_words(out, f->verdict == HCI_FINDING_REJECTED ? "" : text);
}

/* The value that is known best, and how well: the interval holds it with 95 %. */
static void cell_of_certainty(hci_output *out, const hci_diagnosis *d, const hci_finding *f)
{
    char text[2 * HCI_PLOT_NAME_SIZE] = "", name[HCI_PLOT_NAME_SIZE], value[HCI_HTML_NUMBER_SIZE],
                  half[HCI_HTML_NUMBER_SIZE];
    size_t term;
    const hci_effect *e = hci_plot_clearest(d, f, &term);
    if (e) {
        hci_plot_term_name(name, e, term);
        hci_html_number_text(value, e->term[term].value);
        hci_html_number_text(half, 1.96 * e->term[term].std_error);
        snprintf(text, sizeof text, "%.40s = %s ± %s %.20s", name, value, half, unit_of(e, term));
    }
    hci_html_cell_words(out, text);
}

static void table_of_findings(hci_output *out, const hci_diagnosis *d)
{
    static const char *const COLUMN[] = {
        "Rank",          "<Effect", "<Verdict", "ΔBIC", "Own share in %", "<Clearest value ± 95 %",
        "<How it shows", NULL};
    hci_html_table(out, "Effects in order of importance", COLUMN);
    for (size_t k = 0; k < d->findings; ++k) {
        const hci_finding *f = &d->finding[k];
        hci_html_row(out);
        hci_html_number(out, (double)(k + 1));
        hci_html_cell(out, f->effect);
        hci_html_cell(out, hci_finding_verdict_name(f->verdict));
        hci_html_number(out, hci_finding_delta_bic(f));
        hci_html_number(out, 100.0 * f->residual_share);
        cell_of_certainty(out, d, f);
        cell_of_finding(out, f);
        hci_html_row_end(out);
    }
    hci_html_table_end(out);
}

static void show_findings(hci_output *out, const hci_diagnosis *d, const char *origin)
{
    hci_html_section(out, "What the model lacks");
    hci_html_paragraph(
        out, NULL,
        "ΔBIC is how much the Bayesian information criterion falls by having the effect: above "
        "10 the recordings speak clearly for it; a dash is where no part of the effect by itself "
        "lets it fall, so that it is not known. Its own share is "
        "what would come back of the residual's mean square if this effect alone were left "
        "out; what several effects can explain is no one's own, so shares need not sum to "
        "100 %. Certainty is the 95 % interval of the clearest value, in per cent of it.");
    hci_html_figure(out);
    hci_plot_findings(out, d);
    hci_html_figure_tables(out);
    table_of_findings(out, d);
    hci_html_figure_end(out,
                        "Baseline: the residual of the declared machine on the fitted runs. Certainty: half "
                        "the 95 % interval of the value that is "
                        "the largest multiple of its standard error.",
                        "effects.csv", origin);
    hci_html_section_end(out);
}

/* ---- runs ---- */

static void table_of_runs(hci_output *out, const hci_diagnosis *d)
{
    static const char *const COLUMN[] = {"<Run",      "<Role",     "Mean N·m", "Before N·m", "After N·m",
                                         "Noise N·m", "95 % from", "to",       NULL};
    hci_html_table(out, "rms of measured less modelled torque, runs held out first", COLUMN);
    for (size_t k = 0; k < 2 * d->runs; ++k) {
        const hci_run_errors *e = &d->run[k % d->runs];
        if (e->role != (k < d->runs ? HCI_ROLE_HOLDOUT : HCI_ROLE_FIT)) continue;
        const double value[] = {e->mean_torque_Nm, e->rms_before_Nm, e->rms_after_Nm,
                                e->noise_floor_Nm, e->after_low_Nm,  e->after_high_Nm};
        hci_html_row(out);
        hci_html_cell(out, e->file);
        hci_html_cell(out, e->role == HCI_ROLE_FIT ? "fit" : "holdout");
        for (size_t j = 0; j < sizeof value / sizeof *value; ++j)
            hci_html_number(out, value[j]);
        hci_html_row_end(out);
    }
    hci_html_table_end(out);
}

static void say_slips(hci_output *out, const hci_diagnosis *d)
{
    static const char *const COLUMN[] = {"<Run", "Ahead, mechanical °", NULL};
    bool any = false;
    for (size_t k = 0; k < d->runs; ++k)
        any = any || d->run[k].slip_rad != 0.0;
    if (!any) return;
    hci_html_paragraph(out, NULL,
                       "The index of the encoder slipped: the mechanical angle of these runs is ahead of "
                       "that of the others. It was turned back for the diagnosis; the files are as they "
                       "were.");
    hci_html_table(out, "Index slips", COLUMN);
    for (size_t k = 0; k < d->runs; ++k) {
        if (d->run[k].slip_rad == 0.0) continue;
        hci_html_row(out);
        hci_html_cell(out, d->run[k].file);
        hci_html_number(out, d->run[k].slip_rad * 180.0 / HCI_PI);
        hci_html_row_end(out);
    }
    hci_html_table_end(out);
}

static void show_runs(hci_output *out, const hci_diagnosis *d, const char *origin)
{
    hci_html_section(out, "How well it fits, run by run");
    hci_html_paragraph(out, NULL,
                       "Runs that were held out took no part in the fit: they are the test. A model as good "
                       "as the recordings allow reaches their noise.");
    hci_html_figure(out);
    hci_plot_runs(out, d);
    hci_html_figure_tables(out);
    table_of_runs(out, d);
    hci_html_figure_end(out,
                        "Before: the declared machine. After: the corrected one. Of more than 40 runs of "
                        "one role the picture has those with the largest error after. Noise left of the "
                        "axis is not drawn.",
                        "errors.csv", origin);
    say_slips(out, d);
    hci_html_section_end(out);
}

/* ---- orders ---- */

typedef struct {
    hci_plot_order *order;
    size_t count;
    double *of_run_Nm; /* the largest amplitude after of each run */
} orders;

static int by_order(const void *a, const void *b)
{
    const hci_residual_line *x = a, *y = b;
    const int order = (x->order > y->order) - (x->order < y->order);
    return order ? order : (x->run > y->run) - (x->run < y->run);
}

/* Of each order the largest amplitude of any run; the noise is that of the run in which it is largest after.
 */
static void take_line(orders *o, const hci_residual_line *x)
{
    if (o->count == 0 || x->order > o->order[o->count - 1].order)
        o->order[o->count++] =
            (hci_plot_order){x->order, x->before_Nm, x->after_Nm, x->noise_Nm, x->run, x->run};
    hci_plot_order *p = &o->order[o->count - 1];
    if (x->before_Nm > p->before_Nm) {
        p->before_Nm = x->before_Nm;
        p->before_run = x->run;
    }
    if (x->after_Nm > p->after_Nm) {
        p->after_Nm = x->after_Nm;
        p->noise_Nm = x->noise_Nm;
        p->after_run = x->run;
    }
}

static hci_status orders_make(const hci_diagnosis *d, const hci_runs *runs, orders *o, hci_note *note)
{
    hci_residual_line *line = hci_memory_new(d->lines + 1, sizeof *line);
    o->order = hci_memory_new(d->lines + 1, sizeof *o->order);
    o->of_run_Nm = hci_memory_new(runs->count + 1, sizeof *o->of_run_Nm);
    const bool is_allocated = line && o->order && o->of_run_Nm;
    if (is_allocated) {
        if (d->lines > 0) memcpy(line, d->line, d->lines * sizeof *line);
        qsort(line, d->lines, sizeof *line, by_order);
        for (size_t k = 0; k < d->lines; ++k) {
            double *largest_Nm = &o->of_run_Nm[line[k].run];
            take_line(o, &line[k]);
            *largest_Nm = fmax(*largest_Nm, line[k].after_Nm);
        }
    }
    hci_memory_free(line);
    return is_allocated ? HCI_OK : hci_note_memory(note, NULL, "the report");
}

static double order_weight(const void *context, size_t k)
{
    const hci_plot_order *o = &((const orders *)context)->order[k];
    return fmax(o->before_Nm, o->after_Nm);
}

static void table_of_orders(hci_output *out, const orders *o, const hci_runs *runs)
{
    static const char *const COLUMN[] = {"Order",   "Before N·m", "<in run", "After N·m",
                                         "<in run", "Noise N·m",  NULL};
    size_t place[MOST_ORDERS];
    const size_t count = hci_plot_largest(order_weight, o, o->count, MOST_ORDERS, place);
    char caption[120];
    snprintf(caption, sizeof caption, "The largest %zu of %zu orders, peak amplitude", count, o->count);
    hci_html_table(out, caption, COLUMN);
    for (size_t k = 0; k < count; ++k) {
        const hci_plot_order *x = &o->order[place[k]];
        hci_html_row(out);
        hci_html_number(out, x->order);
        hci_html_number(out, x->before_Nm);
        hci_html_cell(out, runs->run[x->before_run].name);
        hci_html_number(out, x->after_Nm);
        hci_html_cell(out, runs->run[x->after_run].name);
        hci_html_number(out, x->noise_Nm);
        hci_html_row_end(out);
    }
    hci_html_table_end(out);
}

/* ---- by run and order ---- */

typedef struct {
    const hci_diagnosis *diagnosis;
    const double *after_Nm; /* the largest of each run */
} run_sizes;

static double run_weight(const void *context, size_t k)
{
    return ((const run_sizes *)context)->after_Nm[k];
}

static double line_weight(const void *context, size_t k)
{
    return ((const hci_diagnosis *)context)->line[k].after_Nm;
}

static void table_of_lines(hci_output *out, const hci_diagnosis *d, const hci_runs *runs)
{
    static const char *const COLUMN[] = {"<Run", "Order", "Before N·m", "After N·m", "Noise N·m", NULL};
    size_t place[MOST_LINES];
    const size_t count = hci_plot_largest(line_weight, d, d->lines, MOST_LINES, place);
    char caption[120];
    snprintf(caption, sizeof caption, "The largest %zu of %zu amplitudes that are left", count, d->lines);
    hci_html_table(out, caption, COLUMN);
    for (size_t k = 0; k < count; ++k) {
        const hci_residual_line *x = &d->line[place[k]];
        hci_html_row(out);
        hci_html_cell(out, runs->run[x->run].name);
        hci_html_number(out, x->order);
        hci_html_number(out, x->before_Nm);
        hci_html_number(out, x->after_Nm);
        hci_html_number(out, x->noise_Nm);
        hci_html_row_end(out);
    }
    hci_html_table_end(out);
}

static void draw_map(hci_output *out, const hci_diagnosis *d, const orders *o, const hci_runs *runs)
{
    size_t place[HCI_PLOT_MOST_CELLS], run[HCI_PLOT_MOST_CELLS];
    double order[HCI_PLOT_MOST_CELLS];
    const run_sizes sizes = {d, o->of_run_Nm};
    hci_plot_map map = {d, runs, run, order, 0, 0};
    map.runs_shown = hci_plot_largest(run_weight, &sizes, runs->count, HCI_PLOT_MOST_CELLS, run);
    map.orders_shown = hci_plot_largest(order_weight, o, o->count, HCI_PLOT_MOST_CELLS, place);
    for (size_t k = 0; k < map.orders_shown; ++k)
        order[k] = o->order[place[k]].order;
    hci_plot_residuals(out, &map);
}

static void show_map(hci_output *out, const hci_diagnosis *d, const orders *o, const hci_runs *runs,
                     const char *origin)
{
    hci_html_figure(out);
    draw_map(out, d, o, runs);
    hci_html_figure_tables(out);
    table_of_lines(out, d, runs);
    hci_html_figure_end(
        out,
        "Before: the declared machine. After: the corrected one. Names in bold are runs held out. Of more "
        "than 24 runs or orders the picture has those with the largest amplitude. The side of a square "
        "grows with the logarithm of the amplitude over four decades.",
        "residual_spectrum.csv", origin);
}

static void show_orders(hci_output *out, const hci_diagnosis *d, const orders *o, const hci_runs *runs,
                        const char *origin)
{
    static const hci_svg_picture WORDS = {
        "orders",
        "Residual by electrical order, before and after, with the noise",
        "A stem for each order on a logarithmic axis: the largest amplitude in N·m that any run has there, "
        "before and after the correction; a dash for the noise of that run. The table beside it has the "
        "largest.",
        0,
        0,
        480,
        304};
    hci_html_section(out, "What is left, by order");
    hci_html_paragraph(
        out, NULL,
        o->count > 0 ? "The residual is measured less modelled torque. Of each order the run with the "
                       "largest amplitude is shown; order 0 is the mean. The noise is what chance alone "
                       "exceeds once in twenty times."
                     : "No order of the residual stands out of the noise, before or after.");
    if (o->count > 0) {
        hci_html_figure(out);
        hci_plot_orders(out, &WORDS, o->order, o->count, "noise", true);
        hci_html_figure_tables(out);
        table_of_orders(out, o, runs);
        hci_html_figure_end(out,
                            "Before: the declared machine. After: the corrected one. Four decades are drawn; "
                            "what is less lies below them.",
                            "residual_spectrum.csv", origin);
        show_map(out, d, o, runs, origin);
    }
    hci_html_section_end(out);
}

/* ---- parameters ---- */

/* Terms of one effect in one unit. */
typedef struct {
    const hci_effect *effect;
    const char *unit;
} term_group;

static double term_weight(const void *context, size_t k)
{
    const term_group *g = context;
    if (strcmp(unit_of(g->effect, k), g->unit) != 0) return 0.0;
    return fabs(g->effect->term[k].value) + 1e-300;
}

static bool is_found(const hci_diagnosis *d, const char *effect)
{
    for (size_t k = 0; k < d->findings; ++k)
        if (strcmp(d->finding[k].effect, effect) == 0) return d->finding[k].verdict != HCI_FINDING_REJECTED;
    return false;
}

static void table_of_terms(hci_output *out, const char *caption, const hci_effect *e, const size_t *term,
                           size_t count)
{
    char value[64];
    const char *unit = unit_of(e, term[0]),
               *column[] = {"<Parameter", value, "Standard error", "<Meaning", NULL};
    snprintf(value, sizeof value, "Value%s%.40s", strcmp(unit, "1") == 0 ? "" : " in ",
             strcmp(unit, "1") == 0 ? "" : unit);
    hci_html_table(out, caption, column);
    for (size_t k = 0; k < count; ++k) {
        const hci_effect_term *t = &e->term[term[k]];
        char name[HCI_PLOT_NAME_SIZE];
        hci_plot_term_name(name, e, term[k]);
        hci_html_row(out);
        hci_html_cell(out, name);
        hci_html_number(out, t->value);
        hci_html_number(out, t->std_error);
        hci_html_cell_words(out, e->type->parameter[t->parameter].meaning);
        hci_html_row_end(out);
    }
    hci_html_table_end(out);
}

/* A picture only where there are errors to compare. */
static void show_group(hci_output *out, const hci_diagnosis *d, const term_group *g, size_t *pictures,
                       const char *origin)
{
    size_t term[MOST_TERMS], all = 0, with_error = 0;
    const size_t count = hci_plot_largest(term_weight, g, g->effect->count, MOST_TERMS, term);
    const char *name = g->effect->type->name;
    char caption[200], id[32];
    for (size_t k = 0; k < g->effect->count; ++k)
        all += term_weight(g, k) > 0.0;
    for (size_t k = 0; k < count; ++k)
        with_error += g->effect->term[term[k]].std_error > 0.0;
    snprintf(caption, sizeof caption, "%.40s (%s)%s", name, is_found(d, name) ? "found" : "declared",
             count < all ? ", the largest values" : "");
    hci_html_figure(out);
    if (with_error > 1) {
        snprintf(id, sizeof id, "terms-%zu", ++*pictures);
        hci_plot_terms(out, id, caption, g->effect, term, count);
    } else {
        hci_html_paragraph(out, NULL, g->effect->type->equation);
    }
    hci_html_figure_tables(out);
    table_of_terms(out, caption, g->effect, term, count);
    snprintf(caption, sizeof caption, "%zu of %zu values of this effect in this unit.", count, all);
    hci_html_figure_end(out, caption, "machine/effects.csv", origin);
}

static void show_parameters(hci_output *out, const hci_diagnosis *d, const char *origin)
{
    size_t pictures = 0;
    if (d->effects.list.count == 0) return;
    hci_html_section(out, "Parameters of the effects");
    hci_html_paragraph(out, NULL,
                       "What the corrected machine, in the folder machine beside this page, has beyond its "
                       "declared tables. Bars are 95 % intervals: 1.96 standard errors to each side.");
    for (size_t k = 0; k < d->effects.list.count; ++k) {
        const hci_effect *e = &d->effects.list.effect[k];
        for (size_t j = 0; j < e->count; ++j) {
            size_t i = 0;
            while (strcmp(unit_of(e, i), unit_of(e, j)) != 0)
                ++i;
            if (i == j) show_group(out, d, &(term_group){e, unit_of(e, j)}, &pictures, origin);
        }
    }
    hci_html_section_end(out);
}

/* ---- what is not understood ---- */

static void show_unexplained(hci_output *out, const hci_diagnosis *d)
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

/* ---- currents for the corrected machine ---- */

static void row_of_evaluations(hci_output *out, const char *name, double old_value, double new_value)
{
    hci_html_row(out);
    hci_html_cell(out, name);
    hci_html_number(out, old_value);
    hci_html_number(out, new_value);
    hci_html_row_end(out);
}

static void show_resolution(hci_output *out, const hci_resolution *r)
{
    static const char *const COLUMN[] = {"<On the corrected machine", "Old currents", "New currents", NULL};
    const hci_torque_evaluation *a = &r->old_currents, *b = &r->new_currents;
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
    hci_html_paragraph(out, "quiet", "Numbers: summary.json.");
    hci_html_section_end(out);
}

/* ---- the page ---- */

hci_status hci_page_diagnosis(hci_output *out, const hci_diagnosis *d, const hci_resolution *resolution,
                              const hci_runs *runs, const char *machine_folder, hci_note *note)
{
    const hci_report_sources sources = {.machine = machine_folder, .runs = runs->list};
    char origin[HCI_PAGE_ORIGIN_SIZE];
    orders o = {NULL, 0, NULL};
    const hci_status status = orders_make(d, runs, &o, note);
    hci_page_origin(origin, &sources);
    if (!status) {
        say_verdict(out, d);
        show_tiles(out, d);
        say_advice(out, d);
        if (resolution) show_resolution(out, resolution);
        show_findings(out, d, origin);
        show_runs(out, d, origin);
        show_orders(out, d, &o, runs, origin);
        show_parameters(out, d, origin);
        show_unexplained(out, d);
        hci_page_show_sources(out, &sources);
        hci_html_end(out);
    }
    hci_memory_free(o.order);
    hci_memory_free(o.of_run_Nm);
    return status;
}
