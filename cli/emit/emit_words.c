#include "cli/emit/emit_words.h"

#include <math.h>

#include "cli/terminal/say.h"
#include "cli/terminal/text.h"
#include "hci/host/base/number.h"
#include "hci/math/harmonic.h"

/* What was looked at, the one that was written marked. */
static void show_choices(const hci_emit_result *result)
{
    cli_say("               format shape      points   bytes   error A  Cortex-M4F  M0+ (instructions)\n");
    for (size_t k = 0; k < result->choices; ++k) {
        const hci_emit_choice *c = &result->choice[k];
        const bool chosen = c->format == result->chosen.format && c->shape == result->chosen.shape;
        cli_say("  %-11s  %-6s %-9s %7zu %7zu  %8.3g  %10u  %3u\n",
                chosen    ? "written"
                : c->fits ? "possible"
                          : "too much",
                hci_emit_format_name(c->format), hci_emit_shape_name(c->shape), c->points, c->bytes,
                c->max_error_A, c->cortex_m4f, c->cortex_m0_plus);
    }
}

/* Where the figures above it hold, and what is known of the machine itself. expected_Nm: 0 where nothing is.
 */
static void show_expected(double expected_Nm)
{
    if (expected_Nm > 0.0)
        cli_say("               in the model; on the machine solve expects at most %.3g N·m of the currents "
                "(95 %%), to which this adds its part\n",
                expected_Nm);
    else
        cli_say("               in the model; what is left on the machine is not known\n");
}

static void show_table_ripple(const hci_emit_request *r, const hci_emit_result *result)
{
    if (result->ripples == 0) return;
    cli_say("  ripple       peak to peak, N·m         sine  with the table  of which the table\n");
    for (size_t k = 0; k < result->ripples; ++k) {
        const hci_table_ripple *x = &result->ripple[k];
        cli_say("               at %8.4g N·m    %10.4g      %10.4g          %10.4g\n", x->torque_Nm,
                x->sine_Nm, x->with_Nm, x->own_Nm);
    }
    show_expected(r->expected_ripple_Nm);
}

void cli_show_table(const hci_emit_request *r, const hci_emit_result *result, const char *folder)
{
    const bool is_data = r->format == HCI_EMIT_CSV || r->format == HCI_EMIT_JSON;
    if (is_data)
        cli_say(CLI_GOOD "emitted" CLI_PLAIN ": %s/%s.%s\n", folder, r->name,
                hci_emit_format_name(r->format));
    else
        cli_say(CLI_GOOD "emitted" CLI_PLAIN ": %s/%s.h and %s.c\n", folder, r->name, r->name);
    show_choices(result);
    cli_say("  table        %zu values in %zu part%s in a row, frame %s; period %zu electrical turn%s",
            result->columns, result->parts, result->parts == 1 ? "" : "s",
            r->frame == HCI_TABLE_ABC ? "abc" : "dq", result->period_turns,
            result->period_turns == 1 ? "" : "s");
    if (result->sectors > 1) cli_say(", 1/%zu kept", result->sectors);
    cli_say("\n  error        at most %.3g A of a peak of %.4g A", result->chosen.max_error_A,
            result->peak_A);
    if (r->per_Nm) cli_say(", up to %.4g N·m", r->reference_torque_Nm);
    if (r->blob) cli_say("\n  blob         %s.bin, for hci/blob.h", r->name);
    if (is_data)
        cli_say("\n  rows         straight lines between them; after the last comes the first\n");
    else
        cli_say("\n  runtime      hci/%s\n", r->format == HCI_EMIT_F32 ? "table.h" : "table_i16.h");
    show_table_ripple(r, result);
}

static void show_speed(const char *what, double speed_rad_per_s)
{
    if (isfinite(speed_rad_per_s))
        cli_say("  %s all orders up to %.6g rpm\n", what,
                floor(speed_rad_per_s * 30.0 / HCI_PI * (1.0 + 1e-6)));
}

static void show_voltage(const hci_emit_loop_result *result)
{
    if (!isfinite(result->voltage_rad_per_s)) return;
    cli_say(
        "  voltage      all orders up to %.6g rpm with a dc link of %.4g V; above that each up to where it "
        "does good\n",
        floor(result->voltage_rad_per_s * 30.0 / HCI_PI * (1.0 + 1e-6)), result->dc_link_V);
}

#define KNOWN_PERCENT 0.001 /* below it figures are not told apart */

/* What the points of loop.csv leave open, as far as they tell. */
static void show_response(const hci_emit_loop_result *result)
{
    if (!isfinite(result->response_error)) return;
    cli_say("               known to %s %% between its points",
            HCI_PERCENT(fmax(KNOWN_PERCENT, 100.0 * result->response_error), 2));
    if (isfinite(result->response_ripple_percent) && result->response_rad_per_s > 0.0)
        cli_say("; by that compensation can be off in T_ripple by %s %% at %.4g rpm",
                HCI_PERCENT(fmax(KNOWN_PERCENT, result->response_ripple_percent), 2),
                result->response_rad_per_s * 30.0 / HCI_PI);
    cli_say("\n");
}

#define NO_DEPARTURE                                                                                         \
    1e-5 /* share of the largest torque below which levels are as good as a straight line                    \
          */

/* What a torque between two levels makes of what is asked for. */
static void show_between(const hci_emit_loop_result *r)
{
    const hci_between_levels *x = &r->between;
    const double little_Nm = NO_DEPARTURE * fmax(fabs(r->torque_low_Nm), fabs(r->torque_high_Nm));
    if (isnan(x->ripple_Nm) || (x->ripple_Nm < little_Nm && fabs(x->mean_off_Nm) < little_Nm)) return;
    cli_say("  between      levels the mean is up to %.3g N·m off (at %.4g N·m), and there is up to %.3g N·m "
            "more\n               ripple, peak to peak (at %.4g N·m); more levels leave less\n",
            fabs(x->mean_off_Nm), x->mean_at_Nm, x->ripple_Nm, x->ripple_at_Nm);
}

void cli_show_loop(const hci_emit_loop_request *r, const hci_emit_loop_result *result, const char *folder)
{
    cli_say(CLI_GOOD "emitted" CLI_PLAIN ": %s/%s.h and %s.c\n", folder, r->name, r->name);
    cli_say(
        "  orders       %zu up to %.4g, %zu level%s of torque from %.4g to %.4g N·m, %zu bytes of flash\n",
        result->orders, result->highest_order, result->levels, result->levels == 1 ? "" : "s",
        result->torque_low_Nm, result->torque_high_Nm, result->flash_bytes);
    if (result->levels == 1)
        cli_say("  torque       %.4g N·m whatever is asked for, 0 and negative too; --per-torque, or several "
                "levels, "
                "follow what is asked for\n",
                result->torque_low_Nm);
    cli_say("  table        %zu points, %zu times in %zu electrical turn%s; %zu bytes of RAM, %zu with "
            "feedforward\n",
            result->points, result->repeats, result->period_turns, result->period_turns == 1 ? "" : "s",
            result->ram_bytes, result->feedforward_ram_bytes);
    cli_say("  error        at most %.3g A of a current vector of %.4g A\n", result->max_error_A,
            result->peak_A);
    show_between(result);
    cli_say("  lead         %.4g us\n", 1e6 * result->lead_s);
    show_voltage(result);
    show_speed("sampling    ", result->sampled_rad_per_s);
    if (isfinite(result->measured_rad_per_s)) show_speed("loop.csv    ", result->measured_rad_per_s);
    show_response(result);
    if (r->blob) cli_say("  blob         %s.bin, for hci/loop_blob.h\n", r->name);
    cli_say("  runtime      hci/loop.h and hci/table.h\n");
}

/* Of a torque that is 0. */
#define ROUNDING_Nm 1e-12

static void show_ripple(const hci_foreign_ripple *r)
{
    cli_say("               at %8.4g N·m    %10.4g   ", fabs(r->torque_Nm) < ROUNDING_Nm ? 0.0 : r->torque_Nm,
            r->without_Nm);
    if (hci_foreign_ripple_is_reached(r))
        cli_say("%10.4g\n", r->with_Nm);
    else
        cli_say("not reached\n");
}

void cli_show_foreign(const hci_emit_foreign_request *r, const hci_emit_foreign_result *x, const char *folder)
{
    const char *unit = hci_foreign_is_torque(r->target) ? "N·m" : "A";
    cli_say(CLI_GOOD "emitted" CLI_PLAIN " for %s into %s: %s\n", hci_foreign_word(r->target), folder,
            x->files);
    cli_say("  holds        %s\n  not          %s\n  form         %s\n", x->carries, x->lacks, x->samples);
    if (x->unit > 0.0)
        cli_say("  rounding     to whole numbers of %.4g %s; the largest value is %.4g %s\n", x->unit, unit,
                x->peak, unit);
    if (x->cut) cli_say("  cut          %zu values that are too large for it\n", x->cut);
    if (x->left_out)
        cli_say("  left out     %zu orders for which it has no room, the largest %.4g %s\n", x->left_out,
                x->left_out_amplitude, unit);
    cli_say("  ripple       peak to peak, N·m         sine    with this map\n");
    for (size_t k = 0; k < x->ripples; ++k)
        show_ripple(&x->ripple[k]);
    show_expected(r->expected_ripple_Nm);
}

/* ---- remarks ---- */

void cli_remark_table(const hci_emit_result *result)
{
    hci_note remark = {{0}};
    if (result->chosen.max_error_A > 0.1 * result->peak_A)
        hci_note_add(
            &remark,
            "the table is off by up to %.3g A, %.0f %% of the peak current: give it more --points, or "
            "leave them to --max-error",
            result->chosen.max_error_A, 100.0 * result->chosen.max_error_A / result->peak_A);
    cli_remark(&remark);
}

/* What the map does at the torque that it is made for. */
void cli_remark_foreign(const hci_emit_foreign_result *x)
{
    hci_note remark = {{0}};
    const hci_foreign_ripple *r = &x->ripple[x->ripples > 1 ? 1 : 0];
    if (!hci_foreign_ripple_is_reached(r))
        hci_note_add(&remark,
                     "the torque %.4g N·m is not reached: the counts of the drive end at %.4g N·m; choose a "
                     "smaller scale of its currents (--counts-per-ampere)",
                     r->torque_Nm, r->mean_Nm);
    else if (r->with_Nm > r->without_Nm)
        hci_note_add(&remark,
                     "with this map the ripple at %.4g N·m is larger than without: %.4g N·m and %.4g N·m",
                     r->torque_Nm, r->with_Nm, r->without_Nm);
    cli_remark(&remark);
}
