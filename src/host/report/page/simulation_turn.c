/* The section of a simulation over one electrical turn. */
#include <math.h>
#include <stdio.h>

#include "host/base/memory.h"
#include "host/draw/html.h"
#include "host/plot/plot_drive.h"
#include "host/report/page/simulation_sections.h"

/* STEPS of a turn: rows of the tables, as HCI_PAGE_STEPS. */
enum { STEPS = 40, SAMPLES_IN_STEP = 4, MOST_TURNS = 64 };

/* Torque of the plain sine over all turns of its period, a few samples in each step of the picture. */
static void fill_before(hci_turn_means *t, const hci_torque_evaluation *plain)
{
    const size_t turns = plain->period_turns > 0 ? plain->period_turns : 1;
    const size_t samples = SAMPLES_IN_STEP * HCI_TURN_STEPS * (turns < MOST_TURNS ? turns : MOST_TURNS);
    hci_turn_means_begin(t);
    for (size_t k = 0; k < samples; ++k) {
        const double theta_rad = 2.0 * HCI_PI * ((double)k + 0.5) / (SAMPLES_IN_STEP * HCI_TURN_STEPS);
        double torque_Nm = 0.0;
        for (size_t j = 0; j < plain->order_count; ++j) {
            const hci_harmonic h = plain->torque_Nm[j];
            if (h.sine != 0.0 || h.cosine != 0.0)
                torque_Nm += h.sine * sin(h.order * theta_rad) + h.cosine * cos(h.order * theta_rad);
        }
        hci_turn_means_add(t, theta_rad, torque_Nm, (hci_dq){.d = 0.0});
    }
}

static void cells_of_turn(hci_output *out, const hci_turn_means *t, size_t row)
{
    const hci_turn_mean m = hci_turn_mean_of(t, row * (HCI_TURN_STEPS / STEPS), HCI_TURN_STEPS / STEPS);
    const double value[] = {m.torque_range_Nm.low, m.torque_Nm, m.torque_range_Nm.high};
    for (size_t j = 0; j < sizeof value / sizeof *value; ++j)
        hci_html_number(out, m.samples > 0 ? value[j] : (double)NAN);
}

/* before: NULL for none. */
static void table_of_turn_torque(hci_output *out, const hci_turn_means *t, const hci_turn_means *before)
{
    static const char *const ALONE[] = {"From °", "to °", "Least N·m", "Mean N·m", "Most N·m", NULL};
    static const char *const COMPARED[] = {
        "From °", "to °", "Before: least N·m", "mean", "most", "After: least N·m", "mean", "most", NULL};
    hci_html_table(out, "Torque over the electrical angle", before ? COMPARED : ALONE);
    for (size_t k = 0; k < STEPS; ++k) {
        hci_html_row(out);
        hci_html_number(out, 360.0 / STEPS * (double)k);
        hci_html_number(out, 360.0 / STEPS * (double)(k + 1));
        if (before) cells_of_turn(out, before, k);
        cells_of_turn(out, t, k);
        hci_html_row_end(out);
    }
    hci_html_table_end(out);
}

/* One step of the picture in each row, where the mean of several would cut the corners of the path. */
static void table_of_turn_vector(hci_output *out, const hci_turn_means *t)
{
    static const char *const COLUMN[] = {"Angle °", "i_d A", "i_q A", "Length A", NULL};
    hci_html_table(out, "Mean current vector at electrical angles", COLUMN);
    for (size_t k = 0; k < HCI_TURN_STEPS; k += HCI_TURN_STEPS / STEPS) {
        const hci_turn_mean m = hci_turn_mean_of(t, k, 1);
        if (m.samples == 0) continue;
        const double value[] = {360.0 * ((double)k + 0.5) / HCI_TURN_STEPS, m.current_A.d, m.current_A.q,
                                hypot(m.current_A.d, m.current_A.q)};
        hci_html_row(out);
        for (size_t j = 0; j < sizeof value / sizeof *value; ++j)
            hci_html_number(out, value[j]);
        hci_html_row_end(out);
    }
    hci_html_table_end(out);
}

/* before: NULL for none. */
static void show_torque(hci_output *out, const hci_simulation *s, const hci_turn_means *t,
                        const hci_turn_means *before, const char *origin)
{
    char caption[HCI_PAGE_BASELINE_SIZE + 240], baseline[HCI_PAGE_BASELINE_SIZE];
    hci_html_figure(out);
    hci_plot_turn_torque(out, t, before);
    hci_html_figure_tables(out);
    table_of_turn_torque(out, t, before);
    hci_page_say_baseline(baseline, s);
    snprintf(
        caption, sizeof caption,
        "%sEvery sample of the evaluated time and what remains to the end, by its electrical angle: what "
        "repeats with the turn is in the mean, what does not widens the grey band from the least to the "
        "most.",
        baseline);
    hci_html_figure_end(out, caption, "trajectory.csv with the course", origin);
}

static void show_vector(hci_output *out, const hci_simulation *s, const hci_turn_means *t, const char *origin)
{
    char caption[HCI_PAGE_BASELINE_SIZE + 240], plain[HCI_HTML_NUMBER_SIZE];
    const double plain_A = isfinite(s->plain_amplitude_A) ? s->plain_amplitude_A : 0.0;
    hci_html_figure(out);
    hci_plot_turn_vector(out, t, (hci_dq){.q = s->torque_Nm.mean < 0.0 ? -plain_A : plain_A});
    hci_html_figure_tables(out);
    table_of_turn_vector(out, t);
    hci_html_quantity_text(plain, plain_A, "A");
    snprintf(caption, sizeof caption,
             "Baseline: the plain sine of %s in phase with the back-EMF, which would make the same mean "
             "torque with it. d is the magnet axis, q leads it.",
             plain);
    hci_html_figure_end(out, caption, "trajectory.csv with the course", origin);
}

hci_status hci_page_turn(hci_output *out, const hci_simulation *s, const hci_turn_means *turn,
                         const char *origin, hci_note *note)
{
    const bool has_before = hci_page_has_before(s);
    if (s->periods == 0) return HCI_OK;
    hci_turn_means *before = has_before ? hci_memory_new(1, sizeof *before) : NULL;
    if (has_before && !before) return hci_note_memory(note, NULL, "the report");
    if (has_before) fill_before(before, &s->plain);
    hci_html_section(out, "Over one electrical turn");
    show_torque(out, s, turn, before, origin);
    show_vector(out, s, turn, origin);
    hci_html_section_end(out);
    hci_memory_free(before);
    return HCI_OK;
}
