#include "cli/check/check_drive.h"

#include <math.h>

#include "cli/command/command.h"
#include "cli/command/reading.h"
#include "cli/terminal/say.h"
#include "cli/terminal/terminal.h"
#include "cli/terminal/text.h"
#include "hci/host/base/number.h"
#include "hci/host/drive/drive_facts.h"
#include "hci/host/report/summary.h"
#include "hci/host/report/write.h"
#include "hci/math/harmonic.h"

static double rpm(double rad_per_s)
{
    return rad_per_s * 30.0 / HCI_PI;
}

static void show_axis(const char *axis, double bandwidth_Hz)
{
    if (isfinite(bandwidth_Hz))
        cli_say("%s %.4g Hz", axis, bandwidth_Hz);
    else
        cli_say("%s beyond what the sampling does for", axis);
}

/* What not every loop has. */
static void show_more(const hci_drive_facts *f)
{
    const hci_drive_data *d = &f->drive;
    if (d->kp_q_ohm < d->kp_ohm || d->kp_q_ohm > d->kp_ohm || d->ki_q_ohm_per_s < d->ki_ohm_per_s ||
        d->ki_q_ohm_per_s > d->ki_ohm_per_s)
        cli_say("  of q         k_p %.4g V/A, k_i %.4g V/(A·s)\n", d->kp_q_ohm, d->ki_q_ohm_per_s);
    if (d->filter_s > 0.0) cli_say("  filter       of the measured current, %.4g us\n", 1e6 * d->filter_s);
}

/* Twice the reference and more is not what `stable` promises. */
#define PEAK 2.0

static void show_peak(const hci_drive_facts *f)
{
    const int axis = f->peak[1] >= f->peak[0];
    if (f->peak[axis] < PEAK) return;
    cli_say("  " CLI_WARN "peak" CLI_PLAIN
            "         %s answers a reference at %.3g Hz with %.3g times as much: lead and table "
            "are worse than nothing near it\n",
            axis ? "q" : "d", f->peak_Hz[axis], f->peak[axis]);
}

static void show_loop(const hci_drive_facts *f)
{
    cli_say("  loop         pi at %.4g kHz, k_p %.4g V/A, k_i %.4g V/(A·s); a voltage acts %.4g us after "
            "its sample\n",
            1e-3 / f->drive.sample_s, f->drive.kp_ohm, f->drive.ki_ohm_per_s,
            1e6 * f->drive.computing_delay_s);
    show_more(f);
    cli_say("  bandwidth    ");
    show_axis("d", f->bandwidth_Hz[0]);
    show_axis(", q", f->bandwidth_Hz[1]);
    cli_say(" (3 dB down, at standstill); slow currents are %.3g ms late\n", 1e3 * f->lead_s);
    cli_say("  gains        %s%.3g times as large the loop is not stable any more; largest pole %.4g\n",
            f->gain_margin >= 100.0 ? "above " : "", f->gain_margin, f->largest_pole);
    show_peak(f);
}

static void show_speed(const hci_drive_facts *f)
{
    cli_say("  sampling     up to %.4g rpm (10 samples in an electrical turn)", rpm(f->sampled_rad_per_s));
    if (f->speed_rad_per_s > 0.0)
        cli_say("; at %.5g rpm for orders up to %.3g in the rotor frame, whole up to %.3g",
                rpm(f->speed_rad_per_s), f->highest_order, 0.9 * f->highest_order);
    cli_say("\n");
    if (f->drive.encoder_counts > 0.0)
        cli_say(
            "  encoder      %.4g counts to an electrical turn, for tables of orders up to %.4g in the rotor "
            "frame\n",
            f->drive.encoder_counts / f->pole_pairs, 0.5 * f->drive.encoder_counts / f->pole_pairs);
    if (isfinite(f->stable_rad_per_s))
        cli_say("  " CLI_WARN "stable" CLI_PLAIN "       up to %.4g rpm\n", rpm(f->stable_rad_per_s));
}

static void show_reading(const hci_drive_facts *f)
{
    char text[HCI_RESPONSE_TEXT_SIZE];
    hci_response_reading_text(f, text);
    cli_say("  remedy       %s\n", text);
}

static void show_response(const hci_drive_facts *f)
{
    if (f->response_count == 0) return;
    cli_say("  response     at most %s %% off what these gains make of R and L, at %.4g Hz\n",
            HCI_PERCENT(100.0 * f->response_off, 3), f->response_off_Hz);
    if (f->reading != HCI_RESPONSE_AS_DECLARED) show_reading(f);
}

static void show(const cli_check_drive_words *w, const hci_drive_facts *f)
{
    if (f->reading == HCI_RESPONSE_AS_DECLARED)
        cli_say(CLI_GOOD "stable" CLI_PLAIN ": the current loop of %s with %s\n", w->drive, w->machine);
    else
        cli_say(CLI_BAD "not understood" CLI_PLAIN
                        ": the measured response of %s is not that of its gains with %s\n",
                w->drive, w->machine);
    show_loop(f);
    show_speed(f);
    show_response(f);
}

static hci_status look(const cli_check_drive_words *w, hci_drive_facts *facts, hci_note *note)
{
    hci_machine_data machine = {0};
    hci_drive_data drive;
    hci_drive_init(&drive);
    hci_status status = hci_machine_read_orders(w->machine, w->order_base, &machine, note);
    if (!status) status = hci_drive_read(w->drive, &drive, note);
    if (!status) status = hci_drive_facts_of(&drive, &machine, w->speed_rad_per_s, facts, note);
    if (!status) cli_remark_drive(&drive, &machine, w->machine);
    hci_drive_release(&drive);
    hci_machine_release(&machine);
    return status;
}

int cli_check_drive(const cli_check_drive_words *words)
{
    static hci_drive_facts facts;
    hci_note note = {{0}};
    hci_status status = look(words, &facts, &note);
    if (!status && words->out) status = hci_drive_facts_write(&facts, words->out, &note);
    if (!status && cli_is_wordy()) show(words, &facts);
    if (!status && words->json)
        status =
            cli_print_json(words->out ? hci_summary_read(words->out) : hci_drive_facts_json(&facts), &note);
    if (status) return cli_fail(status, &note);
    return facts.reading == HCI_RESPONSE_AS_DECLARED ? 0 : 1;
}
