/* The section of a diagnosis about the one before it: what it promised of the new recordings, and what these
 * contradict. */
#include <math.h>

#include "hci/host/diagnose/again.h"
#include "hci/math/harmonic.h"
#include "host/draw/html.h"
#include "host/report/page/diagnosis_sections.h"

static void table_of_runs(hci_output *out, const hci_again *a)
{
    static const char *const COLUMN[] = {"<Recording", "Declared N·m", "Last machine N·m", "Stated 95 % N·m",
                                         "<Within",    "Now N·m",      "Noise N·m",        NULL};
    hci_html_table(out, "New recordings: rms of measured less modelled torque", COLUMN);
    for (size_t k = 0; k < a->runs; ++k) {
        const hci_again_run *r = &a->run[k];
        hci_html_row(out);
        hci_html_cell(out, r->file);
        hci_html_number(out, r->declared_Nm);
        hci_html_number(out, r->last_Nm);
        hci_html_number(out, r->bound_Nm);
        hci_html_cell(out, a->bounded == 0 ? "–" : r->kept ? "yes" : "no");
        hci_html_number(out, r->now_Nm);
        hci_html_number(out, r->noise_Nm);
        hci_html_row_end(out);
    }
    hci_html_table_end(out);
}

static void table_of_played(hci_output *out, const hci_again *a)
{
    static const char *const COLUMN[] = {"<Recording",        "<Currents",  "Turned by °",
                                         "Times the table",   "Ripple N·m", "±",
                                         "Promised 95 % N·m", "<Promise",   NULL};
    hci_html_table(out, "The currents that were solved: measured ripple, peak to peak, and what was promised",
                   COLUMN);
    for (size_t k = 0; k < a->runs; ++k) {
        const hci_played *p = &a->run[k].played;
        const bool is_known = p->currents != HCI_PLAYED_UNKNOWN;
        hci_html_row(out);
        hci_html_cell(out, a->run[k].file);
        hci_html_cell(out, hci_played_currents_name(p->currents));
        hci_html_number(out, is_known ? p->rotation.rotation_rad * 180.0 / HCI_PI : (double)NAN);
        hci_html_number(out, is_known ? p->rotation.gain : (double)NAN);
        hci_html_number(out, p->ripple_Nm);
        hci_html_number(out, p->ripple_error_Nm);
        hci_html_number(out, a->solved.promised_Nm);
        hci_html_cell(out, hci_promise_name(p->promise));
        hci_html_row_end(out);
    }
    hci_html_table_end(out);
}

static void table_of_effects(hci_output *out, const hci_again *a)
{
    static const char *const COLUMN[] = {"<Effect", "<Change", "Standard errors", "<Value, then and now",
                                         NULL};
    hci_html_table(out, "Effects of the last machine and of this one", COLUMN);
    for (size_t k = 0; k < a->effects; ++k) {
        const hci_again_effect *e = &a->effect[k];
        hci_html_row(out);
        hci_html_cell(out, hci_finding_title(e->effect));
        hci_html_cell(out, hci_again_change_name(e->change));
        hci_html_number(out, e->deviations);
        hci_html_cell_words(out, e->words);
        hci_html_row_end(out);
    }
    hci_html_table_end(out);
}

void hci_page_again(hci_output *out, const hci_again *a)
{
    char words[HCI_AGAIN_WORDS];
    hci_again_words(a, words, sizeof words);
    hci_html_section(out, "What the new recordings say of the last diagnosis");
    hci_html_paragraph(out, NULL, words);
    if (a->runs > 0) table_of_runs(out, a);
    if (a->runs > 0 && a->solved.folder[0]) table_of_played(out, a);
    if (a->effects > 0) table_of_effects(out, a);
    hci_html_section_end(out);
}
