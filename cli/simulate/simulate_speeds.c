#include "cli/simulate/simulate_speeds.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "cli/command/command.h"
#include "cli/command/reading.h"
#include "cli/terminal/chart.h"
#include "cli/terminal/progress.h"
#include "cli/terminal/say.h"
#include "cli/terminal/terminal.h"
#include "cli/terminal/text.h"
#include "hci/host/base/number.h"
#include "hci/host/currents/solution_folder.h"
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
        if (end == at || !(fabs(speed) > fabs(last)) || last * speed < 0.0 || !(fabs(rpm) <= 1e6) ||
            (*end != ',' && *end != '\0'))
            return hci_note_set(
                note, HCI_ERROR_ARGUMENT,
                "--speeds: found `%.60s`, expected speeds in rpm other than 0, of one direction and "
                "ascending in size, with a comma between them, as in 80,320,1000 or -80,-320",
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
    if (!status) status = hci_machine_read_orders(w->machine, w->order_base, &in->machine, note);
    if (!status) status = hci_effects_read_machine(w->machine, &in->effects, note);
    if (!status) status = hci_drive_read(w->drive, &in->drive, note);
    if (!status) status = hci_loop_levels_read(w->table, w->table_count, w->per_torque, &in->levels, note);
    return status;
}

/* ---- words ---- */

static double rpm(double rad_per_s)
{
    return rad_per_s * 30.0 / HCI_PI;
}

/* Per cent of a torque; of none, N·m. */
static double shown_ripple(const hci_speeds *s, const hci_speed_result *x, bool worst)
{
    if (worst) return x->worst_T_ripple_percent;
    return s->torque_Nm != 0.0 ? x->T_ripple_percent : x->ripple_Nm;
}

/* None where the mean is next to nothing, which a ratio cannot be of. */
static void show_ripple(double value)
{
    if (isnan(value))
        cli_say(" %12s", "-");
    else
        cli_say(" %12.4g", value);
}

static void show_rows(const hci_speeds *s, bool worst)
{
    for (size_t k = 0; k < s->count; ++k) {
        cli_say("  %7.5g rpm ", rpm(s->row[k].speed_rad_per_s));
        for (int r = 0; r < HCI_REMEDIES; ++r)
            show_ripple(shown_ripple(s, &s->row[k].remedy[r], worst));
        if (worst)
            cli_say("\n");
        else
            cli_say("  %7.4g\n", s->row[k].needed_V);
    }
}

static void show_limit(const char *what, double speed_rad_per_s, const char *where)
{
    if (rpm(speed_rad_per_s) < 1.0)
        cli_say("  %s does not do for all orders, not even at standstill\n", what);
    else if (isfinite(speed_rad_per_s))
        cli_say("  %s does for all orders up to %.6g rpm%s\n", what,
                floor(rpm(speed_rad_per_s) * (1.0 + 1e-6)), where);
}

#define KNOWN_PERCENT 0.001 /* below it figures are not told apart */

/* What the points of loop.csv leave open, as far as they tell. */
static void show_response(const hci_speeds *s)
{
    if (!isfinite(s->response_error)) return;
    cli_say("  loop.csv is known to %s %% between its points",
            HCI_PERCENT(fmax(KNOWN_PERCENT, 100.0 * s->response_error), 2));
    for (size_t k = 0; k < s->count && s->torque_Nm != 0.0; ++k)
        cli_say("%s%s %% at %.4g rpm", k == 0 ? "; by that compensation can be off in T_ripple by " : ", ",
                HCI_PERCENT(fmax(KNOWN_PERCENT, s->row[k].response_ripple_percent), 2),
                rpm(s->row[k].speed_rad_per_s));
    cli_say("\n");
}

/* A torque that is made but for this share is made. */
static const double MADE = 0.01;

static bool is_made(const hci_speeds *s, size_t speed)
{
    bool made = true;
    for (int r = 0; r < HCI_REMEDIES; ++r)
        made = made && fabs(s->row[speed].remedy[r].mean_Nm - s->torque_Nm) <= MADE * fabs(s->torque_Nm);
    return made;
}

/* Ripple alone says nothing of currents that do not make the torque. */
static void show_means(const hci_speeds *s)
{
    bool is_first = true;
    for (size_t k = 0; k < s->count && s->torque_Nm != 0.0; ++k) {
        if (is_made(s, k)) continue;
        if (is_first)
            cli_say("\n  mean torque in N·m at speeds where one is more than %s %% off %.4g N·m\n",
                    HCI_PERCENT(100.0 * MADE, 6), s->torque_Nm);
        is_first = false;
        cli_say("  %7.5g rpm ", rpm(s->row[k].speed_rad_per_s));
        for (int r = 0; r < HCI_REMEDIES; ++r)
            cli_say(" %12.4g", s->row[k].remedy[r].mean_Nm);
        cli_say("\n");
    }
}

static void list_worse(const hci_speeds *s, hci_remedy remedy)
{
    const char *between = "";
    cli_say("at ");
    for (size_t k = 0; k < s->count; ++k) {
        if (!hci_speeds_is_worse(s, k, remedy)) continue;
        cli_say("%s%.4g", between, rpm(s->row[k].speed_rad_per_s));
        between = ", ";
    }
    cli_say(" rpm\n");
}

/* Says no more than was seen at the given speeds. */
static void show_worse(const hci_speeds *s, hci_remedy remedy)
{
    size_t worse = 0, first = s->count;
    for (size_t k = s->count; k-- > 0;)
        if (hci_speeds_is_worse(s, k, remedy)) ++worse, first = k;
    if (worse == 0) return;
    cli_say("  %s is worse than the plain sine ", hci_remedy_name(remedy));
    if (worse == s->count)
        cli_say("at all given speeds\n");
    else if (first > 0 && worse == s->count - first)
        cli_say("from between %.4g and %.4g rpm on\n", rpm(s->row[first - 1].speed_rad_per_s),
                rpm(s->row[first].speed_rad_per_s));
    else
        list_worse(s, remedy);
}

static bool is_compared(const hci_speeds *s, size_t row)
{
    bool all = true;
    for (int r = HCI_REMEDY_TABLE; r < HCI_REMEDIES; ++r)
        all = all && hci_speeds_is_comparable(s, row, (hci_remedy)r);
    return all;
}

/* Where the plain sine makes another torque, or next to none. */
static void show_not_compared(const hci_speeds *s)
{
    for (size_t k = 0; k < s->count && s->torque_Nm != 0.0; ++k)
        if (!is_compared(s, k))
            cli_say("  at %.4g rpm what makes another torque is not compared with the plain sine, which "
                    "makes %.3g of %.4g "
                    "N·m\n",
                    rpm(s->row[k].speed_rad_per_s), s->row[k].remedy[HCI_REMEDY_SINE].mean_Nm, s->torque_Nm);
}

static void show_harm(const hci_speeds *s)
{
    for (int r = HCI_REMEDY_TABLE; r < HCI_REMEDIES; ++r)
        show_worse(s, (hci_remedy)r);
    show_not_compared(s);
}

/* Of a limit: less is what readings and rounding make. */
static const double EXCEEDED = 1e-3;

/* Currents that keep a limit on paper do not keep it where a loop overshoots, or asks for more. */
static void show_exceeded(const hci_speeds *s, const cli_speeds_words *w)
{
    double limit_A = (double)NAN;
    for (size_t k = 0; k < w->table_count; ++k)
        limit_A = fmin(limit_A, hci_solution_read_current_limit(w->table[k]));
    for (size_t k = 0; k < s->count; ++k)
        for (int r = HCI_REMEDY_TABLE; r < HCI_REMEDIES; ++r)
            if (s->row[k].remedy[r].peak_A > (1.0 + EXCEEDED) * limit_A)
                cli_say("  at %.4g rpm %s takes a phase to %.4g A, above the %.4g A that the currents were "
                        "solved with: leave that much below the limit\n",
                        rpm(s->row[k].speed_rad_per_s), hci_remedy_name((hci_remedy)r),
                        s->row[k].remedy[r].peak_A, limit_A);
}

/* What no control can make. */
static void show_beyond(const hci_speeds *s)
{
    if (s->reached_V < 0.8 * s->dc_link_V)
        cli_say("  dead time takes %s %% of the dc link; %.4g of %.4g V are left\n",
                HCI_PERCENT(100.0 * (1.0 - s->reached_V / s->dc_link_V), 3), s->reached_V, s->dc_link_V);
    for (size_t k = 0; k < s->count; ++k)
        if (s->row[k].back_emf_V > s->reached_V)
            cli_say("  at %.4g rpm the back-EMF alone takes a dc link of %.4g V, of which there are %.4g: "
                    "what flows is "
                    "what it drives\n",
                    rpm(s->row[k].speed_rad_per_s), s->row[k].back_emf_V, s->reached_V);
}

static void show(const hci_speeds *s, const cli_speeds_words *w)
{
    cli_say(CLI_GOOD "simulated" CLI_PLAIN ": %s, %s, %.4g N·m\n", w->machine, w->drive, s->torque_Nm);
    cli_say("  lead         %.4g us; dc link %.4g V\n", 1e6 * s->lead_s, s->dc_link_V);
    cli_say("\n  %s; needed: the dc link in V that the currents need as they are wanted\n",
            s->torque_Nm != 0.0 ? "T_ripple in %" : "swing of the torque, whose mean is to be 0, in N·m");
    cli_say("        speed         sine        table         lead compensation  feedforward   needed\n");
    show_rows(s, false);
    if (s->model_error > 0.0 && s->torque_Nm != 0.0) {
        cli_say("\n  the same, the worst of machines whose R, L and flux are %s %% off\n",
                HCI_PERCENT(100.0 * s->model_error, 3));
        show_rows(s, true);
    }
    show_means(s);
    cli_say("\n");
    show_beyond(s);
    const bool is_braking = s->count > 0 && s->row[0].speed_rad_per_s * s->torque_Nm < 0.0;
    show_limit("voltage ", s->voltage_rad_per_s,
               is_braking ? ", turning as the torque drives; braking, the table fades at the same speeds"
                          : "");
    show_limit("sampling", s->sampled_rad_per_s, "");
    if (isfinite(s->measured_rad_per_s)) show_limit("loop.csv", s->measured_rad_per_s, "");
    show_response(s);
    show_harm(s);
    show_exceeded(s, w);
}

/* ---- the command ---- */

static void remark_solutions(const cli_speeds_words *w, const inputs *in)
{
    for (size_t k = 0; k < w->table_count; ++k) {
        hci_note remark = {{0}};
        hci_solution_remark(w->table[k], &in->machine, &remark);
        cli_remark(&remark);
    }
}

static void remark(const cli_speeds_words *w, const inputs *in, const hci_speeds *speeds)
{
    cli_remark_drive(&in->drive, &in->machine, w->machine);
    cli_remark_response(&in->drive, &in->machine);
    cli_remark_counts(&in->drive, &in->machine, speeds->highest_order, speeds->torque_Nm,
                      speeds->coarse_mean_Nm);
    remark_solutions(w, in);
}

/* Files, words and remarks in this order. */
static hci_status tell(const cli_speeds_words *w, const inputs *in, const hci_speeds *speeds, hci_note *note)
{
    const hci_report_sources sources = {.machine = w->machine, .currents = w->table[0], .drive = w->drive};
    hci_status status = HCI_OK;
    if (w->out) status = hci_speeds_write(speeds, w->report ? &sources : NULL, w->out, note);
    if (status) return status;
    if (cli_is_wordy()) show(speeds, w);
    remark(w, in, speeds);
    if (!w->json) return HCI_OK;
    return cli_print_json(w->out ? hci_summary_read(w->out) : hci_speeds_json(speeds), note);
}

static hci_status simulate(const cli_speeds_words *w, inputs *in, hci_note *note)
{
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
    if (!status) status = tell(w, in, &speeds, note);
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
