/* The page of a diagnosis: verdict, then the evidence. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "host/draw/html.h"
#include "host/report/page/diagnosis_sections.h"
#include "host/report/page/page.h"

enum { WORDS_SIZE = 2048 };

static void say_verdict(hci_output *out, const hci_diagnosis *d)
{
    static const char *const BADGE[] = {"Nothing is missing", "Explained",
                                        "Ambiguous: more than one explanation fits", "Partly explained",
                                        "Not explained"};
    char words[WORDS_SIZE];
    hci_diagnosis_words(d, words, sizeof words);
    hci_html_begin(out, &(hci_html_opening){"Diagnosis of the machine model", BADGE[d->verdict],
                                            BADGE[d->verdict], d->verdict <= HCI_DIAGNOSIS_EXPLAINED});
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

static void table_of_points(hci_output *out, const hci_diagnosis *d)
{
    static const char *const COLUMN[] = {"i_d in A", "i_q in A", "Speed in rad/s", "Turns", "<How",
                                         "<Why",     NULL};
    if (d->next_points == 0) return;
    hci_html_table(out, "Operating points, most telling first (measure_next.csv)", COLUMN);
    for (size_t k = 0; k < d->next_points; ++k) {
        const hci_next_point *p = &d->next[k];
        hci_html_row(out);
        hci_html_number(out, p->id_A);
        hci_html_number(out, p->iq_A);
        hci_html_number(out, p->speed_rad_per_s);
        hci_html_number(out, p->turns);
        hci_html_cell(out, hci_next_test_name(p->source));
        hci_html_cell_words(out, p->why);
        hci_html_row_end(out);
    }
    hci_html_table_end(out);
}

static void say_advice(hci_output *out, const hci_diagnosis *d)
{
    if (d->advice[0] == '\0') return;
    hci_html_section(out, "What to measure next");
    hci_html_paragraph(out, NULL, d->advice);
    table_of_points(out, d);
    hci_html_section_end(out);
}

hci_status hci_page_diagnosis(hci_output *out, const hci_diagnosis *d, const hci_resolution *resolution,
                              const hci_runs *runs, const char *machine_folder, hci_note *note)
{
    const hci_report_sources sources = {.machine = machine_folder, .runs = runs->list};
    char origin[HCI_PAGE_ORIGIN_SIZE];
    hci_page_origin(origin, &sources);
    say_verdict(out, d);
    show_tiles(out, d);
    if (d->again) hci_page_again(out, d->again);
    say_advice(out, d);
    if (resolution) hci_page_resolution(out, resolution);
    hci_page_findings(out, d, origin);
    hci_page_run_errors(out, d, origin);
    const hci_status status = hci_page_residual(out, d, runs, origin, note);
    if (status) return status;
    hci_page_parameters(out, d, origin);
    hci_page_unexplained(out, d);
    hci_page_show_sources(out, &sources);
    hci_html_end(out);
    return HCI_OK;
}
