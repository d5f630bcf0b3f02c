/* The section of a diagnosis about its effects, in order of importance. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "host/diagnose/findings.h"
#include "host/draw/html.h"
#include "host/plot/plot.h"
#include "host/plot/rows.h"
#include "host/report/page/diagnosis_sections.h"

/* How an effect that is added or ambiguous shows in a residual. */
static void cell_of_signature(hci_output *out, const hci_finding *f)
{
    const hci_effect_type *type = hci_effect_type_find(f->effect);
    hci_html_cell_words(out, type && f->verdict != HCI_FINDING_REJECTED ? type->signature : "");
}

/* Its values in words; why it was rejected stands beside. */
static void cell_of_values(hci_output *out, const hci_diagnosis *d, const hci_finding *f)
{
    char text[HCI_DETAIL_SIZE] = "";
    if (f->verdict != HCI_FINDING_REJECTED) hci_finding_words(d, f, text, sizeof text);
    hci_html_cell_words(out, text);
}

static void table_of_findings(hci_output *out, const hci_diagnosis *d)
{
    static const char *const COLUMN[] = {
        "Rank",          "<Effect", "<Verdict", "ΔBIC", "By it alone N·m", "<Largest values ± standard error",
        "<How it shows", NULL};
    hci_html_table(out, "Effects in order of importance", COLUMN);
    for (size_t k = 0; k < d->findings; ++k) {
        const hci_finding *f = &d->finding[k];
        hci_html_row(out);
        hci_html_number(out, (double)(k + 1));
        hci_html_cell(out, hci_finding_title(f->effect));
        hci_html_cell(out, hci_finding_verdict_name(f->verdict));
        hci_html_number(out, hci_finding_delta_bic(f));
        hci_html_number(out, hci_plot_own_Nm(d, f));
        cell_of_values(out, d, f);
        cell_of_signature(out, f);
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
        if (d->finding[k].verdict == HCI_FINDING_REJECTED && strcmp(d->finding[k].effect, "unknown") != 0)
            snprintf(text + used, sizeof text - used, "%s%s", used > 0 ? ", " : "",
                     hci_finding_title(d->finding[k].effect));
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
