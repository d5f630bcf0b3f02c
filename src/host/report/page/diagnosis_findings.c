/* The section of a diagnosis about its effects, in order of importance. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "host/diagnose/findings.h"
#include "host/draw/html.h"
#include "host/plot/plot.h"
#include "host/plot/rows.h"
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
        "Rank",          "<Effect", "<Verdict", "ΔBIC", "By it alone N·m", "<Clearest value ± 95 %",
        "<How it shows", NULL};
    hci_html_table(out, "Effects in order of importance", COLUMN);
    for (size_t k = 0; k < d->findings; ++k) {
        const hci_finding *f = &d->finding[k];
        hci_html_row(out);
        hci_html_number(out, (double)(k + 1));
        hci_html_cell(out, f->effect);
        hci_html_cell(out, hci_finding_verdict_name(f->verdict));
        hci_html_number(out, hci_finding_delta_bic(f));
        hci_html_number(out, hci_plot_own_Nm(d, f));
        cell_of_certainty(out, d, f);
        cell_of_finding(out, f);
        hci_html_row_end(out);
    }
    hci_html_table_end(out);
}

/* "Looked for and not needed: …" */
static void say_rejected(hci_output *out, const hci_diagnosis *d)
{
    char text[1024] = "";
    for (size_t k = 0; k < d->findings; ++k) {
        const size_t used = strlen(text);
        if (d->finding[k].verdict == HCI_FINDING_REJECTED)
            snprintf(text + used, sizeof text - used, "%s%s", used > 0 ? ", " : "", d->finding[k].effect);
    }
    if (text[0]) hci_html_say(out, "quiet", "Looked for and not needed: %s.", text);
}

static void heading_of(const hci_diagnosis *d, size_t rows, char text[256])
{
    char after[HCI_HTML_NUMBER_SIZE];
    hci_html_number_text(after, d->rms_after_Nm);
    if (rows == 0)
        snprintf(text, 256, "No effect is added to the model");
    else
        snprintf(text, 256, "What each effect alone explains of the torque, beside the %s N·m that are left",
                 after);
}

static const char CAPTION[] =
    "What would come back as an error, rms over the fitted runs, if this effect alone were left out. What "
    "several effects can explain is no one's own.";

static const char SCORE[] =
    "ΔBIC is how much the Bayesian information criterion falls by having the effect; a dash is where no part "
    "of "
    "the effect lets it fall. Above 10 is clear, but not enough: the torque it explains has to matter, the "
    "effect has to be found again when runs are left out in turn, and saturation, which is a series, is "
    "allowed "
    "an error. So a rejected effect may have a fall.";

void hci_page_findings(hci_output *out, const hci_diagnosis *d, const char *origin)
{
    const hci_finding *shown[HCI_MOST_FINDINGS];
    const size_t rows = hci_plot_findings_shown(d, shown);
    const int height = (int)rows * HCI_ROWS_HEIGHT;
    const hci_html_drawing drawing = {
        .id = "findings",
        .title = "Torque that each effect alone explains",
        .description = "A dot for each effect on a logarithmic axis: the rms torque in N·m that is explained "
                       "by it alone; lines for the errors before and after and for the noise.",
        .caption = CAPTION,
        .wide = 82 + height,
        .narrow = 140 + height,
        .legend_rows = 3,
        .draw = hci_plot_findings,
        .context = d};
    char heading[256];
    heading_of(d, rows, heading);
    hci_html_section(out, heading);
    if (rows > 0)
        hci_html_drawing_begin(out, &drawing);
    else
        hci_html_fold(out, "All effects that were looked for");
    table_of_findings(out, d);
    hci_html_paragraph(out, "quiet", SCORE);
    if (rows > 0)
        hci_html_drawing_end(out, "effects.csv", origin);
    else
        hci_html_fold_end(out);
    say_rejected(out, d);
    hci_html_section_end(out);
}
