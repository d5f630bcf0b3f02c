/* The sections of a simulation over one electrical turn. */
#include <math.h>
#include <stdio.h>

#include "host/base/memory.h"
#include "host/draw/html.h"
#include "host/plot/plot_drive.h"
#include "host/report/page/simulation_sections.h"

enum { SAMPLES_IN_STEP = 4, MOST_TURNS = 64 };

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

/* before: NULL for none. */
static void table_of_extremes(hci_output *out, const hci_turn_means *t, const hci_turn_means *before)
{
    static const char *const COLUMN[] = {"<Torque", "Least N·m", "Mean N·m", "Most N·m", NULL};
    const hci_turn_means *const row[] = {before, t};
    hci_html_table(out, "Over all turns", COLUMN);
    for (size_t k = 0; k < 2; ++k) {
        if (!row[k]) continue;
        const hci_turn_mean m = hci_turn_mean_of(row[k], 0, HCI_TURN_STEPS);
        hci_html_row(out);
        hci_html_cell(out, k == 0 ? "before" : "after");
        const double value[] = {m.torque_range_Nm.low, m.torque_Nm, m.torque_range_Nm.high};
        for (size_t j = 0; j < 3; ++j)
            hci_html_number(out, m.samples > 0 ? value[j] : (double)NAN);
        hci_html_row_end(out);
    }
    hci_html_table_end(out);
}

static void heading_of_torque(const hci_simulation *s, char text[256])
{
    char after[HCI_HTML_NUMBER_SIZE], before[HCI_HTML_NUMBER_SIZE];
    hci_html_quantity_text(after, s->torque_Nm.most - s->torque_Nm.least, "N·m");
    hci_html_quantity_text(before, s->plain.peak_to_peak_Nm, "N·m");
    if (hci_page_has_before(s))
        snprintf(text, 256, "From peak to peak the torque varies by %s, with a plain sine by %s", after,
                 before);
    else
        snprintf(text, 256, "From peak to peak the torque varies by %s", after);
}

static void show_torque(hci_output *out, const hci_simulation *s, const hci_plot_turn *turn,
                        const char *origin)
{
    char caption[HCI_PAGE_BASELINE_SIZE + 240], baseline[HCI_PAGE_BASELINE_SIZE], heading[256];
    hci_page_say_baseline(baseline, s);
    snprintf(
        caption, sizeof caption,
        "%sEvery sample by its electrical angle: what repeats with the turn is in the mean, what does not "
        "widens the band from the least to the most.",
        baseline);
    const hci_html_drawing drawing = {
        .id = "turn",
        .title = "Torque over one electrical turn",
        .description =
            "The mean over all turns in N·m at each electrical angle in degrees, and the band from "
            "the least to the most; with a plain sine and simulated.",
        .caption = caption,
        .wide = 280,
        .narrow = 290,
        .draw = hci_plot_turn_torque,
        .context = turn};
    heading_of_torque(s, heading);
    hci_html_section(out, heading);
    hci_html_drawing_begin(out, &drawing);
    table_of_extremes(out, turn->turn, turn->before);
    hci_html_drawing_end(out, "trajectory.csv with the course", origin);
    hci_html_section_end(out);
}

static void range_of_currents(const hci_turn_means *t, hci_range *d, hci_range *q)
{
    *d = *q = HCI_RANGE_EMPTY;
    for (size_t k = 0; k < HCI_TURN_STEPS; ++k) {
        const hci_turn_mean m = hci_turn_mean_of(t, k, 1);
        if (m.samples == 0) continue;
        hci_range_include(d, m.current_A.d);
        hci_range_include(q, m.current_A.q);
    }
}

static void table_of_currents(hci_output *out, const hci_turn_means *t, double plain_q_A)
{
    static const char *const COLUMN[] = {"<Current", "Least A", "Most A", NULL};
    hci_range d, q;
    range_of_currents(t, &d, &q);
    const struct {
        const char *name;
        hci_range range;
    } row[] = {{"i_d", d}, {"i_q", q}, {"i_q of the plain sine", {plain_q_A, plain_q_A}}};
    hci_html_table(out, "Means of each degree", COLUMN);
    for (size_t k = 0; k < sizeof row / sizeof *row; ++k) {
        hci_html_row(out);
        hci_html_cell(out, row[k].name);
        hci_html_number(out, row[k].range.low);
        hci_html_number(out, row[k].range.high);
        hci_html_row_end(out);
    }
    hci_html_table_end(out);
}

static void show_currents(hci_output *out, const hci_plot_turn *turn, const char *origin)
{
    char heading[256];
    const hci_html_drawing drawing = {
        .id = "vector",
        .title = "Mean i_d and i_q over one electrical turn",
        .description = "Lines in A over the electrical angle in degrees: the means of i_d and i_q over all "
                       "turns, and those of a plain sine with the same mean torque, which stand still.",
        .caption =
            "The means over all turns. A plain sine in phase with the back-EMF stands still here. d is "
            "the magnet axis, q leads it.",
        .wide = 262,
        .narrow = 270,
        .draw = hci_plot_turn_dq,
        .context = turn};
    char number[4][HCI_HTML_NUMBER_SIZE];
    hci_range d, q;
    range_of_currents(turn->turn, &d, &q);
    const double value[] = {q.low, q.high, d.low, d.high};
    for (size_t k = 0; k < 4; ++k)
        hci_html_number_text(number[k], value[k]);
    snprintf(heading, sizeof heading,
             "On average over the turns i_q goes from %s to %s A and i_d from %s to %s A", number[0],
             number[1], number[2], number[3]);
    hci_html_section(out, heading);
    hci_html_drawing_begin(out, &drawing);
    table_of_currents(out, turn->turn, turn->plain_q_A);
    hci_html_drawing_end(out, "trajectory.csv with the course", origin);
    hci_html_section_end(out);
}

static double plain_q_A(const hci_simulation *s)
{
    const double plain_A = isfinite(s->plain_amplitude_A) ? s->plain_amplitude_A : 0.0;
    return s->torque_Nm.mean < 0.0 ? -plain_A : plain_A;
}

hci_status hci_page_turn(hci_output *out, const hci_simulation *s, const hci_turn_means *turn,
                         const char *origin, hci_note *note)
{
    const bool has_before = hci_page_has_before(s);
    if (s->periods == 0) return HCI_OK;
    hci_turn_means *before = has_before ? hci_memory_new(1, sizeof *before) : NULL;
    if (has_before && !before) return hci_note_memory(note, NULL, "the report");
    if (has_before) fill_before(before, &s->plain);
    const hci_plot_turn drawn = {turn, before, plain_q_A(s)};
    show_torque(out, s, &drawn, origin);
    show_currents(out, &drawn, origin);
    hci_memory_free(before);
    return HCI_OK;
}
