/* The page of a diagnosis: verdict, then the evidence. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "host/draw/html.h"
#include "host/report/page/diagnosis_sections.h"
#include "host/report/page/page.h"

enum { WORDS_SIZE = 2048, NAMES_SIZE = 512 };

static bool is_named(const hci_diagnosis *d, const hci_finding *f, hci_finding_verdict verdict)
{
    return f->verdict == verdict && strcmp(f->effect, "unknown") != 0 && !hci_finding_is_part(d, f);
}

/* "reluctance torque, saturation and back-EMF": what has a verdict and a name; "" for none. */
static void names_of(const hci_diagnosis *d, hci_finding_verdict verdict, char text[NAMES_SIZE])
{
    size_t left = 0, used = 0;
    text[0] = '\0';
    for (size_t k = 0; k < d->findings; ++k)
        left += is_named(d, &d->finding[k], verdict);
    for (size_t k = 0; k < d->findings && used < NAMES_SIZE; ++k) {
        if (!is_named(d, &d->finding[k], verdict)) continue;
        const char *between = used == 0                      ? ""
                              : left > 1                     ? ", "
                              : verdict == HCI_FINDING_ADDED ? " and "
                                                             : " or ";
        used += (size_t)snprintf(text + used, NAMES_SIZE - used, "%s%s", between,
                                 hci_finding_title(d->finding[k].effect));
        --left;
    }
}

static void heading_of(const hci_diagnosis *d, char text[NAMES_SIZE + 128])
{
    char added[NAMES_SIZE], either[NAMES_SIZE];
    names_of(d, HCI_FINDING_ADDED, added);
    names_of(d, HCI_FINDING_AMBIGUOUS, either);
    if (d->odd.is_aside)
        snprintf(text, NAMES_SIZE + 128, "Without %.200s the recordings are explained", d->odd.file);
    else if (d->odd.file)
        snprintf(text, NAMES_SIZE + 128, "Only %.200s disagrees with the other recordings", d->odd.file);
    else if (d->verdict == HCI_DIAGNOSIS_COMPLETE)
        snprintf(text, NAMES_SIZE + 128, "The model describes these recordings");
    else if (d->verdict == HCI_DIAGNOSIS_EXPLAINED && added[0])
        snprintf(text, NAMES_SIZE + 128, "The model lacked %s", added);
    else if (d->verdict == HCI_DIAGNOSIS_AMBIGUOUS && either[0])
        snprintf(text, NAMES_SIZE + 128, "The recordings leave open: %s", either);
    else if (d->verdict == HCI_DIAGNOSIS_PARTLY && added[0])
        snprintf(text, NAMES_SIZE + 128, "The model lacked %s, and something that is not known", added);
    else
        snprintf(text, NAMES_SIZE + 128, "What the model lacks is not known");
}

/* How the words of a diagnosis begin that the heading says already. */
static const char LACKED[] = "The model lacked ";

static const char *next_sentence(const char *text)
{
    const char *end = strstr(text, ". ");
    return end ? end + 2 : text;
}

static void say_verdict(hci_output *out, const hci_diagnosis *d, const char *machine)
{
    static const char *const BADGE[] = {"Nothing is missing", "Explained", "Ambiguous", "Partly explained",
                                        "Not explained"};
    char words[WORDS_SIZE], heading[NAMES_SIZE + 128], kicker[512];
    hci_diagnosis_words(d, words, sizeof words);
    heading_of(d, heading);
    snprintf(kicker, sizeof kicker, "Diagnosis of a machine model · %s", machine);
    hci_html_begin(out, &(hci_html_opening){kicker,
                                            d->odd.is_aside ? "One recording is set aside"
                                            : d->odd.file   ? "One recording disagrees"
                                                            : BADGE[d->verdict],
                                            heading, d->verdict <= HCI_DIAGNOSIS_EXPLAINED && !d->odd.file});
    hci_html_paragraph(out, "lead",
                       strncmp(words, LACKED, sizeof LACKED - 1) == 0 ? next_sentence(words) : words);
}

/* ---- before and after ---- */

static void row_of_errors(hci_output *out, const char *name, double before_Nm, double after_Nm,
                          double noise_Nm)
{
    const double value[] = {before_Nm, after_Nm, noise_Nm};
    char text[3][HCI_HTML_NUMBER_SIZE + 8];
    if (!isfinite(after_Nm)) return;
    for (size_t k = 0; k < 3; ++k) {
        hci_html_number_text(text[k], value[k]);
        if (isfinite(value[k])) strcat(text[k], " N·m");
    }
    hci_html_compare_row(out, name, (const char *const[]){text[0], text[1], text[2], NULL});
}

static double largest_mean_Nm(const hci_diagnosis *d)
{
    double largest = 0.0;
    for (size_t k = 0; k < d->runs; ++k)
        largest = fmax(largest, fabs(d->run[k].mean_torque_Nm));
    return largest;
}

static const char NO_MORE[] =
    " No effect that this program knows takes more of it away and holds for runs that "
    "it was not fitted to.";

/* What is left, against the noise and against the torque: "explained" is no claim that it is noise. */
static void say_what_is_left(hci_output *out, const hci_diagnosis *d)
{
    const double times = d->rms_after_Nm / d->noise_Nm, largest_Nm = largest_mean_Nm(d);
    char left[HCI_HTML_NUMBER_SIZE], share[HCI_HTML_NUMBER_SIZE], ratio[HCI_HTML_NUMBER_SIZE];
    hci_html_number_text(left, d->rms_after_Nm);
    hci_html_number_text(share, 100.0 * d->rms_after_Nm / largest_Nm);
    hci_html_number_text(ratio, times);
    if (!(d->noise_Nm > 0.0) || !isfinite(times)) return;
    if (times <= 1.5)
        hci_html_say(out, NULL, "What is left of the fitted runs, %s N·m, is about their noise%s.", left,
                     hci_page_is_chance(d) ? "" : " in sum; single orders stand out of it");
    else
        hci_html_say(
            out, NULL,
            "What is left of the fitted runs, %s N·m, is %s times their noise%s%s%s: an error of the "
            "model, not chance.%s",
            left, ratio, largest_Nm > d->rms_after_Nm ? ", and " : "",
            largest_Nm > d->rms_after_Nm ? share : "",
            largest_Nm > d->rms_after_Nm ? " % of their largest mean torque" : "",
            d->search == HCI_WORK_COMPLETE ? NO_MORE : "");
}

static void show_before_and_after(hci_output *out, const hci_diagnosis *d)
{
    static const char *const COLUMN[] = {"Before: declared machine", "After: corrected machine",
                                         "Noise of the recordings", NULL};
    size_t held = 0;
    char name[64], fitted[64];
    for (size_t k = 0; k < d->runs; ++k)
        held += d->run[k].role == HCI_ROLE_HOLDOUT;
    snprintf(name, sizeof name, "Torque error, %zu run%s held out", held, held == 1 ? "" : "s");
    snprintf(fitted, sizeof fitted, "Torque error, %zu run%s fitted", d->runs - held,
             d->runs - held == 1 ? "" : "s");
    hci_html_compare(out, COLUMN);
    row_of_errors(out, name, d->holdout_before_Nm, d->holdout_after_Nm, d->holdout_noise_Nm);
    row_of_errors(out, "of it the means", d->holdout_mean_before_Nm, d->holdout_mean_after_Nm, NAN);
    row_of_errors(out, "of it the ripple", d->holdout_ripple_before_Nm, d->holdout_ripple_after_Nm, NAN);
    row_of_errors(out, fitted, d->rms_before_Nm, d->rms_after_Nm, d->noise_Nm);
    hci_html_compare_end(out);
    say_what_is_left(out, d);
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
    say_verdict(out, d, machine_folder);
    show_before_and_after(out, d);
    if (d->again) hci_page_again(out, d->again);
    if (resolution) hci_page_resolution(out, resolution);
    hci_page_findings(out, d, origin);
    hci_page_run_errors(out, d, origin);
    const hci_status status = hci_page_residual(out, d, runs, origin, note);
    if (status) return status;
    hci_page_unexplained(out, d);
    say_advice(out, d);
    hci_page_parameters(out, d);
    hci_page_show_sources(out, &sources);
    hci_html_end(out);
    return HCI_OK;
}
