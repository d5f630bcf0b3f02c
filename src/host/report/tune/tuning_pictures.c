/* The pictures of `tune`: torque with and without current, and the currents, over the same angle; or the log
 * that no table was made of. */
#include "host/report/tune/tuning_pictures.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "hci/host/machine/expected_ripple.h"
#include "host/draw/html.h"
#include "host/plot/plot.h"

/* ---- torque ---- */

static void row_of_three(hci_output *out, const char *name, double low, double high, double swing)
{
    hci_html_row(out);
    hci_html_cell(out, name);
    hci_html_number(out, low);
    hci_html_number(out, high);
    hci_html_number(out, swing);
    hci_html_row_end(out);
}

static void row_of_swing(hci_output *out, const char *name, hci_range r)
{
    row_of_three(out, name, r.low, r.high, r.high - r.low);
}

static void table_of_torque(const hci_solution_page *p, double table_Nm)
{
    static const char *const COLUMN[] = {"<Torque", "Least N·m", "Most N·m", "Peak to peak N·m", NULL};
    const hci_expected_ripple *e = &p->solution->expected;
    hci_html_table(p->out, "Extremes over the period", COLUMN);
    row_of_swing(p->out, "before: plain sine", p->facts.before_Nm);
    row_of_swing(p->out, "after: the currents", p->facts.after_Nm);
    if (table_Nm > 0.0) row_of_three(p->out, "after: cut to the table", (double)NAN, (double)NAN, table_Nm);
    if (hci_plot_expected_Nm(p->solution) > 0.0)
        row_of_three(p->out, "to expect on the machine (95 %)", (double)NAN, (double)NAN, e->peak_to_peak_Nm);
    hci_html_table_end(p->out);
}

static void heading_of_torque(const hci_solution_page *p, double table_Nm, char text[256])
{
    const hci_range after = table_Nm > 0.0 ? (hci_range){0.0, table_Nm} : p->facts.after_Nm;
    char swing[2][HCI_PAGE_SWING_SIZE];
    hci_page_swing(swing[0], p->facts.before_Nm, p->solution->tolerance_Nm);
    hci_page_swing(swing[1], after, p->solution->tolerance_Nm);
    snprintf(text, 256, "Over the turn a ripple of %s becomes one of %s in the model", swing[0], swing[1]);
}

static void show_torque(const hci_solution_page *p, const hci_plot_tuned *tuned, double table_Nm)
{
    char heading[256], caption[256];
    const hci_html_drawing drawing = {
        .id = "torque",
        .title = "Torque over the electrical angle: before, after, and to expect on the machine",
        .description =
            "Lines in N·m over the electrical angle in degrees, and a band where it is known what to "
            "expect on the machine. The table has the extremes.",
        .caption = caption,
        .wide = 285,
        .narrow = 300,
        .draw = hci_plot_tuned_torque,
        .context = tuned};
    hci_page_torque_caption(p->solution, caption);
    heading_of_torque(p, table_Nm, heading);
    hci_html_section(p->out, heading);
    hci_html_drawing_begin(p->out, &drawing);
    table_of_torque(p, table_Nm);
    hci_html_drawing_end(p->out, "currents/waveform.csv", "diagnose/machine");
    hci_html_section_end(p->out);
}

/* ---- torque without current ---- */

static hci_range range_of(const double *value, size_t count)
{
    hci_range r = HCI_RANGE_EMPTY;
    for (size_t k = 0; k < count; ++k)
        hci_range_include(&r, value[k]);
    return r;
}

/* Below the tolerance of the solution there is nothing to show. */
static void show_open(const hci_solution_page *p, const hci_plot_tuned *tuned)
{
    static const char *const COLUMN[] = {"<Torque", "Least N·m", "Most N·m", "Peak to peak N·m", NULL};
    const hci_html_drawing drawing = {
        .id = "open",
        .title = "Torque without current over the electrical angle",
        .description =
            "A line in N·m over the electrical angle in degrees: the torque that the corrected machine "
            "makes without current. The table has the extremes.",
        .caption = "What was found of the cogging torque, and what else follows the angle alone.",
        .wide = 230,
        .narrow = 250,
        .legend_rows = 1,
        .draw = hci_plot_tuned_open,
        .context = tuned};
    char heading[128], swing[HCI_PAGE_SWING_SIZE];
    const hci_range r = range_of(tuned->open_Nm, tuned->count);
    if (!(r.high - r.low > p->solution->tolerance_Nm)) return;
    hci_page_swing(swing, r, p->solution->tolerance_Nm);
    snprintf(heading, sizeof heading, "Without current the torque varies by %s", swing);
    hci_html_section(p->out, heading);
    hci_html_drawing_begin(p->out, &drawing);
    hci_html_table(p->out, "Extremes over the period", COLUMN);
    row_of_swing(p->out, "without current", r);
    hci_html_table_end(p->out);
    hci_html_drawing_end(p->out, "diagnose/machine", "the logs");
    hci_html_section_end(p->out);
}

/* ---- currents ---- */

#define STILL 0.01 /* of the largest current: what moves less stands still in the picture */

/* " from 0 to 1.2 A", " at 0 A" */
static void words_of_way(char text[3 * HCI_HTML_NUMBER_SIZE], hci_range r, double most_A)
{
    char low[HCI_HTML_NUMBER_SIZE], high[HCI_HTML_NUMBER_SIZE];
    const double middle_A = 0.5 * (r.low + r.high);
    const bool is_still = r.high - r.low < STILL * most_A;
    hci_html_number_text(low, is_still ? (fabs(middle_A) < STILL * most_A ? 0.0 : middle_A) : r.low);
    hci_html_number_text(high, r.high);
    snprintf(text, 3 * HCI_HTML_NUMBER_SIZE, is_still ? "stays at %s A" : "goes from %s to %s A", low, high);
}

static void heading_of_currents(const hci_solution_page *p, bool has_table, char text[512])
{
    const hci_plot_facts *f = &p->facts;
    const double most_A = fmax(fmax(-f->d_A.low, f->d_A.high), fmax(-f->q_A.low, f->q_A.high));
    char d[3 * HCI_HTML_NUMBER_SIZE], q[3 * HCI_HTML_NUMBER_SIZE], plain[HCI_HTML_NUMBER_SIZE];
    words_of_way(d, f->d_A, most_A);
    words_of_way(q, f->q_A, most_A);
    hci_html_number_text(plain, f->plain_dq_A.q);
    snprintf(text, 512, "%s i_q %s, where a plain sine has %s A, and i_d %s",
             has_table ? "With the table" : "In the model alone", q, plain, d);
}

static void table_of_currents(const hci_solution_page *p)
{
    static const char *const COLUMN[] = {"<Current", "Least A", "Most A", "Peak to peak A", NULL};
    const hci_plot_facts *f = &p->facts;
    hci_html_table(p->out, "Extremes over the period", COLUMN);
    row_of_three(p->out, "i_d before", f->plain_dq_A.d, f->plain_dq_A.d, 0.0);
    row_of_three(p->out, "i_q before", f->plain_dq_A.q, f->plain_dq_A.q, 0.0);
    row_of_swing(p->out, "i_d after", f->d_A);
    row_of_swing(p->out, "i_q after", f->q_A);
    row_of_swing(p->out, "phase a after", f->phase_A[0]);
    hci_html_table_end(p->out);
}

static void show_currents(const hci_solution_page *p, const hci_plot_tuned *tuned, bool has_table)
{
    char heading[512];
    const hci_html_drawing drawing = {
        .id = "current",
        .title = "Currents i_d and i_q over the electrical angle",
        .description =
            "Lines in A over the electrical angle in degrees: i_d and i_q of the plain sine, which "
            "stand still, and of the table. The table has the extremes.",
        .caption = p->facts.baseline,
        .wide = 262,
        .narrow = 290,
        .draw = hci_plot_tuned_dq,
        .context = tuned};
    if (p->solution->current.count == 0) return;
    heading_of_currents(p, has_table, heading);
    hci_html_section(p->out, heading);
    hci_html_drawing_begin(p->out, &drawing);
    table_of_currents(p);
    hci_html_drawing_end(p->out, "currents/waveform.csv and currents/currents.csv", "diagnose/machine");
    hci_html_section_end(p->out);
}

bool hci_tuning_has_table(const hci_tuning *t)
{
    return t->part[HCI_TUNING_LOAD][0] != '\0';
}

void hci_page_tuned(const hci_solution_page *p, const hci_tuning *t)
{
    const hci_plot_tuned tuned = {t->solution, t->open_Nm, t->open_Nm ? HCI_TUNING_POINTS : 0};
    if (!p->ripple_is_unknown) show_torque(p, &tuned, t->table_Nm);
    if (t->open_Nm) show_open(p, &tuned);
    show_currents(p, &tuned, hci_tuning_has_table(t));
}

/* ---- the log ---- */

static void row_of_range(hci_output *out, const char *name, hci_range r)
{
    hci_html_row(out);
    hci_html_cell(out, name);
    hci_html_number(out, r.low);
    hci_html_number(out, r.high);
    hci_html_row_end(out);
}

void hci_page_log(hci_output *out, const hci_tuning *t)
{
    static const char *const COLUMN[] = {"<Quantity", "Least", "Most", NULL};
    const hci_html_drawing drawing = {
        .id = "log",
        .title = "The log over its time",
        .description =
            "Two lines over the time: the angle of the shaft, or its speed, and the torque, the current "
            "or a voltage. The table has the extremes.",
        .caption =
            "Each column spans the least and the most of its samples; rows that were left out are not in it.",
        .wide = 330,
        .narrow = 360,
        .legend_rows = 1,
        .draw = hci_plot_log,
        .context = t->log};
    hci_plot_log_facts facts;
    char heading[512];
    if (!t->log || !hci_plot_log_can(t->log)) return;
    hci_plot_log_ranges(t->log, &facts);
    snprintf(heading, sizeof heading, "%.300s as it was read: %s, and %s", t->log_name, facts.position,
             facts.signal);
    hci_html_section(out, heading);
    hci_html_drawing_begin(out, &drawing);
    hci_html_table(out, "Extremes over the log", COLUMN);
    row_of_range(out, facts.position, facts.of_position);
    row_of_range(out, facts.signal, facts.of_signal);
    hci_html_table_end(out);
    hci_html_drawing_end(out, "runs.csv, which names the logs", t->log_name);
    hci_html_section_end(out);
}
