#include "cli/simulate_speeds.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "cli/command/command.h"
#include "cli/terminal/chart.h"
#include "cli/terminal/progress.h"
#include "cli/terminal/say.h"
#include "cli/terminal/terminal.h"
#include "cli/terminal/text.h"
#include "hci/host/machine/effects.h"
#include "hci/host/report/summary.h"
#include "hci/host/report/write.h"

enum { MOST_SPEEDS = 64 };

typedef struct {
    hci_machine_data machine;
    hci_effects_data effects;
    hci_drive_data drive;
    hci_loop_levels levels;
    double speed_rad_per_s[MOST_SPEEDS];
    size_t speeds;
} inputs;

/* ---- what is read ---- */

static hci_status read_speeds(const char *text, inputs *in, hci_note *note)
{
    for (const char *at = text;; ++at) {
        char *end;
        const double rpm = strtod(at, &end);
        const double last = in->speeds > 0 ? in->speed_rad_per_s[in->speeds - 1] : 0.0;
        const double speed = rpm * HCI_PI / 30.0;
        if (end == at || !(speed > last) || !(rpm <= 1e6) || (*end != ',' && *end != '\0'))
            return hci_note_set(
                note, HCI_ERROR_ARGUMENT,
                "--speeds: found `%.60s`, expected speeds in rpm above 0, ascending, with a comma "
                "between them, as in 80,320,1000",
                at);
        if (in->speeds == MOST_SPEEDS)
            return hci_note_set(note, HCI_ERROR_ARGUMENT, "--speeds: expected at most %d", (int)MOST_SPEEDS);
        in->speed_rad_per_s[in->speeds++] = speed;
        if (*end == '\0') return HCI_OK;
        at = end;
    }
}

static hci_status read_inputs(const cli_speeds_words *w, inputs *in, hci_note *note)
{
    hci_status status = read_speeds(w->speeds, in, note);
    if (!status) status = hci_machine_read(w->machine, &in->machine, note);
    if (!status) status = hci_effects_read_machine(w->machine, &in->effects, note);
    if (!status) status = hci_drive_read(w->drive, &in->drive, note);
    if (!status) status = hci_loop_levels_read(w->table, w->table_count, false, &in->levels, note);
    return status;
}

/* ---- words ---- */

static void show_rows(const hci_speeds *s, bool worst)
{
    for (size_t k = 0; k < s->count; ++k) {
        cli_say("  %7.5g rpm ", s->row[k].speed_rad_per_s * 30.0 / HCI_PI);
        for (int r = 0; r < HCI_REMEDIES; ++r)
            cli_say(" %12.4g", worst ? s->row[k].remedy[r].worst_T_ripple_percent
                                     : s->row[k].remedy[r].T_ripple_percent);
        if (worst)
            cli_say("\n");
        else
            cli_say("  %7.4g\n", s->row[k].needed_V);
    }
}

static void show_limit(const char *what, double speed_rad_per_s)
{
    if (isfinite(speed_rad_per_s))
        cli_say("  %s does for all orders up to %.4g rpm\n", what, speed_rad_per_s * 30.0 / HCI_PI);
}

static void show_harm(const hci_speeds *s)
{
    for (int r = HCI_REMEDY_TABLE; r < HCI_REMEDIES; ++r)
        if (isfinite(s->harmful_rad_per_s[r]))
            cli_say("  %s is worse than the plain sine from about %.4g rpm on\n",
                    hci_remedy_name((hci_remedy)r), s->harmful_rad_per_s[r] * 30.0 / HCI_PI);
}

static void show(const hci_speeds *s, const cli_speeds_words *w)
{
    cli_say(CLI_GOOD "simulated" CLI_PLAIN ": %s, %s, %.4g N·m\n", w->machine, w->drive, s->torque_Nm);
    cli_say("  lead         %.4g us; dc link %.4g V\n", 1e6 * s->lead_s, s->dc_link_V);
    cli_say("\n  T_ripple in %%; needed: the dc link in V that the currents need as they are wanted\n");
    cli_say("        speed         sine        table         lead compensation  feedforward   needed\n");
    show_rows(s, false);
    if (s->model_error > 0.0) {
        cli_say("\n  the same, the worst of machines whose R, L and flux are %.3g %% off\n",
                100.0 * s->model_error);
        show_rows(s, true);
    }
    cli_say("\n");
    show_limit("voltage ", s->voltage_rad_per_s);
    show_limit("sampling", s->sampled_rad_per_s);
    show_harm(s);
}

/* ---- the command ---- */

static hci_status simulate(const cli_speeds_words *w, inputs *in, hci_note *note)
{
    const hci_report_sources sources = {.machine = w->machine, .currents = w->table[0], .drive = w->drive};
    const double last_Nm = in->levels.level[in->levels.count - 1].torque_Nm;
    const hci_speeds_request request = {.machine = &in->machine,
                                        .effects = &in->effects.list,
                                        .drive = &in->drive,
                                        .levels = in->levels.level,
                                        .level_count = in->levels.count,
                                        .torque_Nm = isnan(w->torque_Nm) ? last_Nm : w->torque_Nm,
                                        .speeds_rad_per_s = in->speed_rad_per_s,
                                        .speed_count = in->speeds,
                                        .model_error = 0.01 * w->error_percent,
                                        .progress = cli_progress};
    hci_speeds speeds;
    hci_status status = hci_simulate_speeds(&request, &speeds, note);
    cli_progress_end();
    if (!status && w->out) status = hci_speeds_write(&speeds, w->report ? &sources : NULL, w->out, note);
    if (!status && cli_is_wordy()) show(&speeds, w);
    if (!status && w->json) status = cli_print_json(hci_speeds_json(&speeds), note);
    hci_speeds_release(&speeds);
    return status;
}

hci_status cli_simulate_speeds(const cli_speeds_words *words, hci_note *note)
{
    inputs in;
    memset(&in, 0, sizeof in);
    hci_drive_init(&in.drive);
    hci_status status = read_inputs(words, &in, note);
    if (!status) status = simulate(words, &in, note);
    hci_loop_levels_release(&in.levels);
    hci_drive_release(&in.drive);
    hci_effects_release(&in.effects);
    hci_machine_release(&in.machine);
    return status;
}
