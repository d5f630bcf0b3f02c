/* The section of a diagnosis about the parameters of the corrected machine. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "host/draw/html.h"
#include "host/plot/plot.h"
#include "host/report/page/diagnosis_sections.h"

enum { MOST_TERMS = 16 }; /* of a group, that are shown */

static const char *unit_of(const hci_effect *e, size_t term)
{
    return e->type->parameter[e->term[term].parameter].unit;
}

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

static void show_group(hci_output *out, const hci_diagnosis *d, const term_group *g)
{
    size_t term[MOST_TERMS], all = 0;
    const size_t count = hci_plot_largest(term_weight, g, g->effect->count, MOST_TERMS, term);
    const char *name = g->effect->type->name;
    char caption[200];
    for (size_t k = 0; k < g->effect->count; ++k)
        all += term_weight(g, k) > 0.0;
    snprintf(caption, sizeof caption, "%.40s (%s): %s%zu of %zu values in this unit", hci_finding_title(name),
             is_found(d, name) ? "found" : "declared", count < all ? "the largest " : "", count, all);
    hci_html_paragraph(out, NULL, g->effect->type->equation);
    table_of_terms(out, caption, g->effect, term, count);
}

void hci_page_parameters(hci_output *out, const hci_diagnosis *d)
{
    if (d->effects.list.count == 0) return;
    hci_html_fold(out, "Values of the effects, with their standard errors");
    for (size_t k = 0; k < d->effects.list.count; ++k) {
        const hci_effect *e = &d->effects.list.effect[k];
        for (size_t j = 0; j < e->count; ++j) {
            size_t i = 0;
            while (strcmp(unit_of(e, i), unit_of(e, j)) != 0)
                ++i;
            if (i == j) show_group(out, d, &(term_group){e, unit_of(e, j)});
        }
    }
    hci_html_paragraph(out, "quiet", "All of them: machine/effects.csv.");
    hci_html_fold_end(out);
}
