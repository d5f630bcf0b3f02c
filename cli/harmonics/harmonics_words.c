#define _POSIX_C_SOURCE 200809L

#include "cli/harmonics/harmonics_words.h"

#include <math.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>

#include "cli/terminal/chart.h"
#include "cli/terminal/rows.h"
#include "cli/terminal/say.h"
#include "cli/terminal/terminal.h"
#include "cli/terminal/text.h"
#include "hci/math/harmonic.h"

static void show_channels(const hci_waveform *w)
{
    for (int s = 0; s < 3; ++s) {
        const hci_waveform_channel *c = &w->channel[s];
        cli_say("  %-12s offset %.4g ± %.1g V, %.5g ± %.1g times the others, phase %+.4f ± %.1g rad%s\n",
                c->name, c->offset_V, c->offset_error_V, c->ratio, c->ratio_error, c->phase_error_rad,
                c->phase_error, c->left_out ? " (left out)" : "");
    }
}

static void show_source(const hci_waveform *w)
{
    if (w->quantity == HCI_WAVEFORM_COGGING) {
        cli_say("  mean         %.5g N·m\n", w->mean_Nm);
        if (isfinite(w->friction_Nm))
            cli_say("  friction     %.5g ± %.2g N·m (half the difference of the directions)\n",
                    w->friction_Nm, w->friction_error_Nm);
        return;
    }
    if (isfinite(w->frequency_Hz))
        cli_say("  frequency    %.7g Hz electrical, drifting by %.3g Hz/s (from the voltages)\n",
                w->frequency_Hz, w->drift_Hz_per_s);
    cli_say("  speed        %.6g rpm mean\n", w->speed_rad_per_s * 30.0 / HCI_PI);
    show_channels(w);
}

static void show_test(const hci_waveform *w)
{
    if (w->turns_forward + w->turns_backward > 0)
        cli_say("  turns        %zu forward, %zu backward, %s\n", w->turns_forward, w->turns_backward,
                w->step < 1.0 ? "mechanical" : "electrical");
    cli_say("  errors       %s\n", w->between_turns ? "from how the turns differ"
                                   : w->step > 0.0  ? "from the orders around"
                                                    : "from what the orders leave");
    if (w->count == 0 || w->largest_left <= 0.0) return;
    for (size_t k = 0; k < w->count; ++k)
        if (fabs(w->order[k].order - w->largest_left) < HCI_ORDER_TOLERANCE)
            cli_say("  left out     %zu of %zu orders up to %.6g, which noise can make; the largest is "
                    "order %.6g, %.3g ± %.1g\n",
                    w->count - w->kept, w->count, w->order[w->count - 1].order, w->largest_left,
                    w->order[k].amplitude, w->order[k].std_error);
}

/* ---- spectrum ---- */

static double kept_amplitude(const void *waveform, size_t k)
{
    const hci_waveform_order *o = &((const hci_waveform *)waveform)->order[k];
    return o->kept ? o->amplitude : 0.0;
}

typedef struct {
    const hci_waveform *waveform;
    size_t pick[CLI_MOST_ROWS];
} spectrum;

static void spectrum_row(const void *context, size_t row, cli_cell cell[])
{
    const spectrum *s = context;
    const hci_waveform_order *o = &s->waveform->order[s->pick[row]];
    snprintf(cell[0].text, sizeof cell[0].text, "%.6g", o->order);
    snprintf(cell[1].text, sizeof cell[1].text, "%.4g", o->amplitude);
    snprintf(cell[2].text, sizeof cell[2].text, "%.1e", o->std_error);
    snprintf(cell[3].text, sizeof cell[3].text, "%.4f", o->phase_rad);
    cell[4].value = o->amplitude;
    cell[4].mark = o->std_error;
}

static void show_orders(const hci_waveform *w)
{
    static const cli_column COLUMNS[] = {{CLI_RIGHT, "order"},
                                         {CLI_RIGHT, "amplitude"},
                                         {CLI_RIGHT, "std error"},
                                         {CLI_RIGHT, "phase/rad"},
                                         {CLI_BAR, ""}};
    const bool cogging = w->quantity == HCI_WAVEFORM_COGGING;
    char caption[160];
    spectrum s = {.waveform = w};
    const size_t rows = cli_pick(kept_amplitude, w, w->count, 1e-6, s.pick, NULL);
    snprintf(caption, sizeof caption, "%s by electrical order, %s; in the bars %s is the standard error",
             cogging ? "cogging torque" : "back-EMF", cogging ? "N·m (peak)" : "N·m/A (peak of a phase)",
             cli_is_ascii(STDOUT_FILENO) ? "|" : "│");
    cli_draw(&(cli_chart){.caption = caption,
                          .column = COLUMNS,
                          .columns = 5,
                          .rows = rows,
                          .fill = spectrum_row,
                          .context = &s,
                          .logarithmic = true,
                          .unit = cogging ? "N·m" : "N·m/A"});
    if (rows < w->kept) cli_say("  and %zu smaller ones\n", w->kept - rows);
}

void cli_show_waveform(const hci_waveform *w, const char *run)
{
    cli_say("%s%s" CLI_PLAIN ": %s, %zu order%s\n", w->kept > 0 ? CLI_GOOD : CLI_WARN,
            w->quantity == HCI_WAVEFORM_COGGING ? "cogging torque" : "back-EMF", run, w->kept,
            w->kept == 1 ? "" : "s");
    show_source(w);
    show_test(w);
    if (w->kept > 0) show_orders(w);
}
