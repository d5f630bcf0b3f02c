#include "cli/simulate/simulate_words.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "cli/terminal/chart.h"
#include "cli/terminal/rows.h"
#include "cli/terminal/say.h"
#include "cli/terminal/text.h"
#include "hci/host/base/number.h"
#include "hci/math/harmonic.h"

/* A ripple that is rounding is none. */
static const double ROUNDING_percent = 1e-9;

static void show_share(const char *name, double percent)
{
    if (percent < ROUNDING_percent)
        cli_say("%s 0 %%", name);
    else
        cli_say("%s %s %%", name, HCI_PERCENT(percent, 4));
}

static void show_torque(const hci_simulation *s)
{
    cli_say("  torque       mean %.6g N·m, %.6g to %.6g", s->torque_Nm.mean, s->torque_Nm.least,
            s->torque_Nm.most);
    if (isfinite(s->T_ripple_percent)) {
        show_share("; T_ripple", s->T_ripple_percent);
        show_share(", F_ripple", s->F_ripple_percent);
    }
    cli_say("\n");
    cli_say("  current      mean %.4g A, rms %.4g, %.4g to %.4g (vector length); peak phase current %.4g A\n",
            s->current_A.mean, s->current_A.rms, s->current_A.least, s->current_A.most, s->peak_phase_A);
    cli_say("  in dq_x      mean %.4g A, rms %.4g, %.4g to %.4g (where 1 A of i_q makes 1.225 N·m)\n",
            s->current_dqx_A.mean, s->current_dqx_A.rms, s->current_dqx_A.least, s->current_dqx_A.most);
}

static void show_loss(const hci_simulation *s)
{
    const bool watts = isfinite(s->copper_W), ratio = isfinite(s->loss_to_plain);
    if (!watts && !ratio) return;
    cli_say("  copper loss  ");
    if (watts) cli_say("%.4g W", s->copper_W);
    if (ratio)
        cli_say("%s%.4g × the plain fundamental of %.4g A", watts ? ", " : "", s->loss_to_plain,
                s->plain_amplitude_A);
    cli_say("\n");
}

static void show_energy(const hci_simulation *s)
{
    cli_say("  energy       %.5g J in, %.5g J copper, %.5g J to the shaft; ", s->energy_J.electrical,
            s->energy_J.copper, s->energy_J.mechanical);
    if (fabs(s->energy_J.residual) < 1e-9 * fabs(s->energy_J.electrical))
        cli_say("they balance\n");
    else
        cli_say("error %.2g J\n", s->energy_J.residual);
}

static void show_control(const hci_simulation *s)
{
    if (isfinite(s->switching_frequency_Hz)) cli_say("  switching    %.4g Hz\n", s->switching_frequency_Hz);
    if (s->without_current > 0)
        cli_say("  no current   for the torque at %zu of %zu samples; the nearest was used\n",
                s->without_current, s->samples);
    if (s->limited > 0) cli_say("  limited      current at %zu of %zu samples\n", s->limited, s->samples);
    if (isfinite(s->energy_J.residual)) show_energy(s);
}

/* ---- spectrum ---- */

typedef struct {
    const hci_simulation *simulation;
    double largest_Nm;
    size_t pick[CLI_MOST_ROWS];
} spectrum;

static double amplitude(hci_harmonic h)
{
    return h.order < HCI_ORDER_TOLERANCE ? 0.0 : hypot(h.sine, h.cosine);
}

static double before_Nm(const spectrum *s, double order)
{
    for (size_t k = 0; k < s->simulation->plain.order_count; ++k)
        if (fabs(s->simulation->plain.torque_Nm[k].order - order) < HCI_ORDER_TOLERANCE)
            return amplitude(s->simulation->plain.torque_Nm[k]);
    return 0.0;
}

static double largest_of(const void *context, size_t k)
{
    const spectrum *s = context;
    const hci_harmonic h = s->simulation->spectrum_Nm[k];
    return h.order < HCI_ORDER_TOLERANCE ? 0.0 : fmax(amplitude(h), before_Nm(s, h.order));
}

static void spectrum_row(const void *context, size_t row, cli_cell cell[])
{
    const spectrum *s = context;
    const hci_harmonic h = s->simulation->spectrum_Nm[s->pick[row]];
    snprintf(cell[0].text, sizeof cell[0].text, "%.5g", h.order);
    cli_number_text(amplitude(h), s->largest_Nm, cell[1].text, sizeof cell[1].text);
    cell[2].value = amplitude(h);
    if (s->simulation->plain.order_count == 0) return;
    cell[3] = cell[1];
    cell[4] = cell[2];
    cli_number_text(before_Nm(s, h.order), s->largest_Nm, cell[1].text, sizeof cell[1].text);
    cell[2].value = before_Nm(s, h.order);
}

static void show_spectrum(const hci_simulation *s)
{
    static const cli_column ALONE[] = {{CLI_RIGHT, "order"}, {CLI_RIGHT, "torque"}, {CLI_BAR, ""}};
    static const cli_column COMPARED[] = {
        {CLI_RIGHT, "order"}, {CLI_RIGHT, "before"}, {CLI_BAR, ""}, {CLI_RIGHT, "after"}, {CLI_BAR, ""}};
    const bool compared = s->plain.order_count > 0;
    char caption[256];
    spectrum x = {.simulation = s};
    const size_t rows = cli_pick(largest_of, &x, s->spectrum_count, 5e-3, x.pick, NULL);
    size_t length =
        (size_t)snprintf(caption, sizeof caption, "torque ripple by electrical order, N·m (peak)");
    for (size_t k = 0; k < rows; ++k)
        x.largest_Nm = fmax(x.largest_Nm, largest_of(&x, x.pick[k]));
    if (compared)
        snprintf(caption + length, sizeof caption - length,
                 "; before: the plain fundamental of %.4g A as it should flow, T_ripple %s %%",
                 s->plain_amplitude_A, HCI_PERCENT(s->plain.T_ripple_percent, 4));
    cli_draw(&(cli_chart){.caption = caption,
                          .column = compared ? COMPARED : ALONE,
                          .columns = compared ? 5 : 3,
                          .rows = rows,
                          .fill = spectrum_row,
                          .context = &x,
                          .unit = "N·m"});
}

void cli_show_simulation(const hci_simulation *s, const char *machine, const char *scenario)
{
    const bool doubtful = !s->energy_balances || s->limited > 0 || s->without_current > 0;
    cli_say("%ssimulated" CLI_PLAIN ": %s, %s\n", doubtful ? CLI_WARN : CLI_GOOD, machine, scenario);
    if (s->periods > 0)
        cli_say("  evaluated    %g s to %g s, %zu whole period%s at %.5g rpm (%.5g to %.5g)\n", s->from_s,
                s->to_s, s->periods, s->periods == 1 ? "" : "s", s->speed_rad_per_s.mean * 30.0 / HCI_PI,
                s->speed_rad_per_s.least * 30.0 / HCI_PI, s->speed_rad_per_s.most * 30.0 / HCI_PI);
    else
        cli_say("  evaluated    %g s to %g s, in which the rotor has not turned one period: no spectrum\n",
                s->from_s, s->to_s);
    show_torque(s);
    show_loss(s);
    show_control(s);
    show_spectrum(s);
}
