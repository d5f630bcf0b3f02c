/* The section of a diagnosis about its effects, in order of importance. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "host/diagnose/findings.h"
#include "host/draw/html.h"
#include "host/plot/plot.h"
#include "host/report/page/diagnosis_sections.h"

/* For an effect that is added or ambiguous, how it shows in a residual; parameters have a table of their
 * own. */
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
        snprintf(text, sizeof text, "%.40s = %s ± %s %.20s", name, value, half,
                 e->type->parameter[e->term[term].parameter].unit);
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

void hci_page_findings(hci_output *out, const hci_diagnosis *d, const char *origin)
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
