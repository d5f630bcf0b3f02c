/* The page of a simulation. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "host/base/memory.h"
#include "host/draw/html.h"
#include "host/plot/plot.h"
#include "host/plot/plot_drive.h"
#include "host/report/page/page.h"

/* SLICES of the evaluated time and STEPS of a turn: rows of the tables. STEPS: as in page_solution.c. */
enum { MOST_ORDERS = 24, SLICES = 20, STEPS = 40, LEAST_FOR_FLOOR = 8 };

enum { SAMPLES_IN_STEP = 4, MOST_TURNS = 64, BASELINE_SIZE = 256 };

/* ---- verdict ---- */

static bool has_before(const hci_simulation *s)
{
    return s->plain.order_count > 0;
}

/* What a reader wants to know who will not read on. */
static void say_facts(hci_output *out, const hci_simulation *s)
{
    char mean[HCI_HTML_NUMBER_SIZE], speed[HCI_HTML_NUMBER_SIZE], swing[HCI_HTML_NUMBER_SIZE],
        loss[128] = "", before[HCI_HTML_NUMBER_SIZE + 80] = "";
    hci_html_quantity_text(mean, s->torque_Nm.mean, "N·m");
    hci_html_quantity_text(swing, s->torque_Nm.most - s->torque_Nm.least, "N·m");
    hci_html_number_text(speed, s->speed_rad_per_s.mean * 30.0 / HCI_PI);
    if (isfinite(s->loss_to_plain)) {
        char ratio[HCI_HTML_NUMBER_SIZE];
        hci_html_number_text(ratio, s->loss_to_plain);
        snprintf(loss, sizeof loss,
                 " Its copper loss is %s times that of a plain sine with the same mean torque.", ratio);
    }
    if (has_before(s)) {
        char plain[HCI_HTML_NUMBER_SIZE];
        hci_html_quantity_text(plain, s->plain.peak_to_peak_Nm, "N·m");
        snprintf(before, sizeof before, ", with a plain sine of the same mean torque by %s", plain);
    }
    hci_html_say(out, "lead",
                 "The drive makes %s on average at %s rpm; its torque varies by %s%s from peak to peak%s.%s",
                 mean, speed, swing[0] == '<' ? "less than" : "", swing + (swing[0] == '<'), before, loss);
}

/* "29.6 → 0.33 %" where there is a before. */
static void tile_of_ripple(hci_output *out, const char *name, double before, double after,
                           const char *formula)
{
    char from[HCI_HTML_NUMBER_SIZE], to[HCI_HTML_NUMBER_SIZE], value[2 * HCI_HTML_NUMBER_SIZE + 8],
        remark[96];
    if (!isfinite(after) || !isfinite(before)) {
        hci_html_tile_number(out, name, after, "%", formula);
        return;
    }
    hci_html_number_text(from, before);
    hci_html_quantity_text(to, after, "%");
    snprintf(value, sizeof value, "%s → %s", from, to);
    snprintf(remark, sizeof remark, "plain sine → this drive; %s", formula);
    hci_html_tile(out, name, value, remark);
}

static void say_verdict(hci_output *out, const hci_simulation *s)
{
    char from[HCI_HTML_NUMBER_SIZE], to[HCI_HTML_NUMBER_SIZE];
    hci_html_begin(out, "Simulation of the drive",
                   !s->energy_balances ? "Not to be trusted: the energy does not balance"
                   : s->remark.text[0] ? "Done, with a remark"
                                       : "Done",
                   s->energy_balances);
    say_facts(out, s);
    hci_html_number_text(from, s->from_s);
    hci_html_number_text(to, s->to_s);
    if (s->periods > 0)
        hci_html_say(out, NULL, "Evaluated from %s s to %s s: %zu whole period%s.", from, to, s->periods,
                     s->periods == 1 ? "" : "s");
    else
        hci_html_say(out, NULL,
                     "Evaluated from %s s to %s s, in which the rotor has not turned one period: there is "
                     "no spectrum.",
                     from, to);
    if (s->remark.text[0]) hci_html_paragraph(out, NULL, s->remark.text);
    hci_html_tiles(out);
    hci_html_tile_number(out, "Mean torque", s->torque_Nm.mean, "N·m", "over the evaluated time");
    tile_of_ripple(out, "T_ripple", has_before(s) ? s->plain.T_ripple_percent : (double)NAN,
                   s->T_ripple_percent, "100 (T_max − T_min) / T_mean");
    tile_of_ripple(out, "F_ripple", has_before(s) ? s->plain.F_ripple_percent : (double)NAN,
                   s->F_ripple_percent, "100 rms(T − T_mean) / T_mean");
    hci_html_tile_number(out, "Copper loss", s->copper_W, "W", "mean");
    hci_html_tile_number(out, "Peak phase current", s->peak_phase_A, "A", "largest of the phases");
    hci_html_tiles_end(out);
}

/* ---- over time ---- */

static void row_of(hci_output *out, const char *name, const hci_statistics *x, double factor)
{
    const double value[] = {x->mean, x->rms, x->least, x->most};
    hci_html_row(out);
    hci_html_cell(out, name);
    for (size_t k = 0; k < 4; ++k)
        hci_html_number_in(out, factor * value[k], factor * (x->most - x->least));
    hci_html_row_end(out);
}

static const char *const STATISTICS[] = {"<Quantity", "Mean", "rms", "Least", "Most", NULL};

/* The extremes of slices of the evaluated time, which are what the picture draws. */
static void table_of_slices(hci_output *out, const hci_simulation *s, const hci_traces *t, hci_trace first,
                            hci_trace last)
{
    static const char *const ONE[] = {"From ms", "to ms", "Least", "Most", NULL};
    static const char *const THREE[] = {"From ms",  "to ms",     "Least i_a", "Most i_a", "Least i_b",
                                        "Most i_b", "Least i_c", "Most i_c",  NULL};
    const double slice_s = (s->to_s - s->from_s) / SLICES;
    const hci_range all = hci_traces_range(t, first, s->from_s, s->to_s);
    const double span = all.high - all.low;
    hci_html_table(out, "Extremes over the time", first == last ? ONE : THREE);
    for (size_t k = 0; k < SLICES; ++k) {
        const double from_s = s->from_s + slice_s * (double)k, to_s = from_s + slice_s;
        hci_html_row(out);
        hci_html_number(out, 1e3 * from_s);
        hci_html_number(out, 1e3 * to_s);
        for (size_t j = first; j <= (size_t)last; ++j) {
            const hci_range r = hci_traces_range(t, (hci_trace)j, from_s, to_s);
            hci_html_number_in(out, r.low, span);
            hci_html_number_in(out, r.high, span);
        }
        hci_html_row_end(out);
    }
    hci_html_table_end(out);
}

static void figure_of(hci_output *out, const hci_simulation *s, const hci_traces *t, hci_trace first,
                      hci_trace last, const hci_svg_picture *words, const char *origin)
{
    hci_html_figure(out);
    hci_plot_traces(out, t, &(hci_plot_window){words, first, last, s->from_s, s->to_s});
    hci_html_figure_tables(out);
    hci_html_table(out, "Over the evaluated time", STATISTICS);
    if (first == HCI_TRACE_TORQUE_NM) row_of(out, "torque N·m", &s->torque_Nm, 1.0);
    if (first == HCI_TRACE_SPEED_RPM) row_of(out, "speed rpm", &s->speed_rad_per_s, 30.0 / HCI_PI);
    if (first == HCI_TRACE_A_A) {
        row_of(out, "length of the current vector A", &s->current_A, 1.0);
        row_of(out, "√(i_dx² + i_qx²) A", &s->current_dqx_A, 1.0);
    }
    hci_html_table_end(out);
    table_of_slices(out, s, t, first, last);
    hci_html_figure_end(
        out,
        "True values, not what sensors read; between extremes where samples are denser than the picture.",
        "summary.json, and trajectory.csv with the course", origin);
}

static void show_traces(hci_output *out, const hci_simulation *s, const hci_traces *t, const char *origin)
{
    static const hci_svg_picture
        TORQUE = {"torque",
                  "Torque in N·m",
                  "A line over time in ms. The table beside it has mean and extremes.",
                  0,
                  0,
                  480,
                  264},
        SPEED = {"speed",
                 "Speed in rpm, mechanical",
                 "A line over time in ms. The table beside it has mean and extremes.",
                 0,
                 0,
                 480,
                 264},
        CURRENT = {"current",
                   "Phase currents in A",
                   "Three lines over time in ms. The tables beside it have the extremes over the time, and "
                   "mean and extremes of the current vector.",
                   0,
                   0,
                   480,
                   264};
    hci_html_section(out, "Over time");
    figure_of(out, s, t, HCI_TRACE_TORQUE_NM, HCI_TRACE_TORQUE_NM, &TORQUE, origin);
    figure_of(out, s, t, HCI_TRACE_SPEED_RPM, HCI_TRACE_SPEED_RPM, &SPEED, origin);
    figure_of(out, s, t, HCI_TRACE_A_A, HCI_TRACE_C_A, &CURRENT, origin);
    hci_html_section_end(out);
}

/* ---- over one turn ---- */

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

/* "Before: …", or nothing. */
static void say_baseline(char text[BASELINE_SIZE], const hci_simulation *s)
{
    char plain[HCI_HTML_NUMBER_SIZE];
    text[0] = '\0';
    if (!has_before(s)) return;
    hci_html_quantity_text(plain, s->plain_amplitude_A, "A");
    snprintf(text, BASELINE_SIZE,
             "Before: the plain sine of %s in phase with the back-EMF, which would make the same mean torque "
             "with it, as it should flow, on the same machine. After: this drive. ",
             plain);
}

/* before: NULL for none. */
static void show_turn(hci_output *out, const hci_simulation *s, const hci_turn_means *t,
                      const hci_turn_means *before, const char *origin)
{
    char caption[BASELINE_SIZE + 240], baseline[BASELINE_SIZE], plain[HCI_HTML_NUMBER_SIZE];
    const double plain_A = isfinite(s->plain_amplitude_A) ? s->plain_amplitude_A : 0.0;
    if (s->periods == 0) return;
    hci_html_section(out, "Over one electrical turn");
    hci_html_figure(out);
    hci_plot_turn_torque(out, t, before);
    hci_html_figure_tables(out);
    table_of_turn_torque(out, t, before);
    say_baseline(baseline, s);
    snprintf(
        caption, sizeof caption,
        "%sEvery sample of the evaluated time and what remains to the end, by its electrical angle: what "
        "repeats with the turn is in the mean, what does not widens the grey band from the least to the "
        "most.",
        baseline);
    hci_html_figure_end(out, caption, "trajectory.csv with the course", origin);
    hci_html_figure(out);
    hci_plot_turn_vector(out, t, (hci_dq){.q = s->torque_Nm.mean < 0.0 ? -plain_A : plain_A});
    hci_html_figure_tables(out);
    table_of_turn_vector(out, t);
    hci_html_quantity_text(plain, plain_A, "A");
    snprintf(caption, sizeof caption,
             "Baseline: the plain sine of %s in phase with the back-EMF, which would make the same mean "
             "torque with it. d is the "
             "magnet axis, q leads it.",
             plain);
    hci_html_figure_end(out, caption, "trajectory.csv with the course", origin);
    hci_html_section_end(out);
}

/* ---- spectrum ---- */

/* NAN where there is nothing to compare with. */
static double before_Nm(const hci_simulation *s, double order)
{
    for (size_t k = 0; k < s->plain.order_count; ++k) {
        const hci_harmonic h = s->plain.torque_Nm[k];
        if (fabs(h.order - order) < HCI_ORDER_TOLERANCE)
            return order < HCI_ORDER_TOLERANCE ? h.cosine : hci_amplitude(h.sine, h.cosine);
    }
    return has_before(s) ? 0.0 : (double)NAN;
}

/* What rounding leaves of the torque at any order, as a share of the torque. */
#define ROUNDING 1e-12

static double rounding_Nm(const hci_simulation *s)
{
    return ROUNDING * fmax(fabs(s->torque_Nm.most), fabs(s->torque_Nm.least));
}

static double order_weight(const void *context, size_t k)
{
    const hci_simulation *s = context;
    const hci_harmonic h = s->spectrum_Nm[k];
    const double size_Nm = fmax(hci_amplitude(h.sine, h.cosine), before_Nm(s, h.order));
    return k == 0 ? 1e100 : size_Nm > rounding_Nm(s) ? size_Nm : 0.0;
}

static void table_of_orders(hci_output *out, const hci_simulation *s)
{
    static const char *const COLUMN[] = {"Order",     "Before N·m",    "After N·m",
                                         "Phase rad", "% of the mean", NULL};
    const double least_Nm = rounding_Nm(s);
    const double mean_Nm = isfinite(s->T_ripple_percent) ? fabs(s->spectrum_Nm[0].cosine) : (double)NAN;
    size_t place[MOST_ORDERS];
    const size_t count = hci_plot_largest(order_weight, s, s->spectrum_count, MOST_ORDERS, place);
    char caption[120];
    snprintf(caption, sizeof caption, "The mean, order 0, and the largest of %zu orders", s->spectrum_count);
    hci_html_table(out, caption, COLUMN);
    for (size_t k = 0; k < count; ++k) {
        const hci_harmonic h = s->spectrum_Nm[place[k]];
        const bool mean = place[k] == 0;
        const double size_Nm = mean ? h.cosine : hci_amplitude(h.sine, h.cosine);
        hci_html_row(out);
        hci_html_number(out, h.order);
        hci_html_number_above(out, before_Nm(s, h.order), least_Nm);
        hci_html_number_above(out, size_Nm, least_Nm);
        if (mean || size_Nm >= least_Nm)
            hci_html_number(out, mean ? HCI_PI / 2 : hci_phase_rad(h.sine, h.cosine));
        else
            hci_html_number(out, (double)NAN);
        hci_html_number_above(out, 100.0 * size_Nm / mean_Nm, 100.0 * least_Nm / mean_Nm);
        hci_html_row_end(out);
    }
    hci_html_table_end(out);
}

static int by_size(const void *a, const void *b)
{
    const double x = ((const hci_plot_order *)a)->after_Nm, y = ((const hci_plot_order *)b)->after_Nm;
    return (x > y) - (x < y);
}

static int by_order(const void *a, const void *b)
{
    const double x = ((const hci_plot_order *)a)->order, y = ((const hci_plot_order *)b)->order;
    return (x > y) - (x < y);
}

/* The median: what switching, noise and steps leave at any order, since what repeats with the turn is at few
 * of them. */
static void set_floor(hci_plot_order *order, size_t count)
{
    if (count < LEAST_FOR_FLOOR) return;
    qsort(order, count, sizeof *order, by_size);
    const double floor_Nm = order[count / 2].after_Nm;
    for (size_t k = 0; k < count; ++k)
        order[k].noise_Nm = floor_Nm;
    qsort(order, count, sizeof *order, by_order);
}

static void show_spectrum(hci_output *out, const hci_simulation *s, const hci_plot_order *order,
                          const char *origin)
{
    static const hci_svg_picture WORDS = {
        "spectrum",
        "Torque ripple by electrical order",
        "A stem for each order but 0, the mean: peak amplitude in N·m, with a plain sine and simulated. The "
        "table beside it has the largest.",
        0,
        0,
        480,
        304};
    char caption[BASELINE_SIZE + 500], baseline[BASELINE_SIZE], floor[HCI_HTML_NUMBER_SIZE];
    if (s->spectrum_count < 2) return;
    say_baseline(baseline, s);
    hci_html_quantity_text(floor, order[0].noise_Nm, "N·m");
    snprintf(caption, sizeof caption,
             "%sOver whole periods of the angle; the picture leaves the mean out%s. %s%s%s%s", baseline,
             has_before(s) ? ", and what is more than four decades below the largest" : "",
             s->imposed ? "The currents are imposed, and some of these orders may be wanted: the target that "
                          "they were made for is not part of a simulation."
                        : "A strategy asks for a constant torque: it wants none of these orders.",
             isfinite(order[0].noise_Nm) ? " The floor is the median of all orders, " : "",
             isfinite(order[0].noise_Nm) ? floor : "",
             isfinite(order[0].noise_Nm) ? ": about what switching and noise leave anywhere." : "");
    hci_html_section(out, "Torque ripple by order");
    hci_html_figure(out);
    hci_plot_orders(out, &WORDS, order, s->spectrum_count - 1, "floor", has_before(s));
    hci_html_figure_tables(out);
    table_of_orders(out, s);
    hci_html_figure_end(out, caption, "spectrum.csv", origin);
    hci_html_section_end(out);
}

/* ---- the rest ---- */

static void show_drive(hci_output *out, const hci_simulation *s)
{
    static const char *const COLUMN[] = {"<Quantity", "Value", NULL};
    hci_html_section(out, "The drive");
    hci_html_table(out, "Loss, switching and energies", COLUMN);
    hci_html_quantity(out, "copper loss in W", s->copper_W);
    hci_html_quantity(out, "amplitude of a plain sine with this mean torque in A", s->plain_amplitude_A);
    hci_html_quantity(out, "copper loss to that of the plain sine", s->loss_to_plain);
    hci_html_quantity(out, "switching frequency in Hz", s->switching_frequency_Hz);
    hci_html_quantity(out, "samples without a current for the torque", (double)s->without_current);
    hci_html_quantity(out, "samples at a current limit", (double)s->limited);
    hci_html_quantity(out, "electrical energy in J", s->energy_J.electrical);
    hci_html_quantity(out, "copper in J", s->energy_J.copper);
    hci_html_quantity(out, "stored in J", s->energy_J.stored);
    hci_html_quantity(out, "to the shaft in J", s->energy_J.mechanical);
    hci_html_quantity(out, "left over by the integration in J", s->energy_J.residual);
    hci_html_quantity(out, "step in s", s->step_s);
    hci_html_table_end(out);
    hci_html_paragraph(out, "quiet", "Numbers: summary.json.");
    hci_html_section_end(out);
}

hci_status hci_page_simulation(hci_output *out, const hci_simulation *s, const hci_traces *traces,
                               const hci_report_sources *sources, hci_note *note)
{
    hci_plot_order *order = hci_memory_new(s->spectrum_count + 1, sizeof *order);
    hci_turn_means *before = order ? hci_memory_new(1, sizeof *before) : NULL;
    char origin[HCI_PAGE_ORIGIN_SIZE];
    if (!before) {
        hci_memory_free(order);
        return hci_note_memory(note, NULL, "the report");
    }
    if (has_before(s)) fill_before(before, &s->plain);
    for (size_t k = 1; k < s->spectrum_count; ++k) {
        const hci_harmonic h = s->spectrum_Nm[k];
        order[k - 1] = (hci_plot_order){.order = h.order,
                                        .before_Nm = before_Nm(s, h.order),
                                        .after_Nm = hci_amplitude(h.sine, h.cosine),
                                        .noise_Nm = NAN};
    }
    if (s->spectrum_count > 0) set_floor(order, s->spectrum_count - 1);
    hci_page_origin(origin, sources);
    say_verdict(out, s);
    show_turn(out, s, &traces->turn, has_before(s) ? before : NULL, origin);
    show_spectrum(out, s, order, origin);
    show_traces(out, s, traces, origin);
    show_drive(out, s);
    hci_page_show_sources(out, sources);
    hci_html_end(out);
    hci_memory_free(before);
    hci_memory_free(order);
    return HCI_OK;
}
