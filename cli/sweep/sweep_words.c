#include "cli/sweep/sweep_words.h"

#include <math.h>

#include "cli/terminal/say.h"
#include "cli/terminal/text.h"
#include "hci/host/base/number.h"
#include "hci/host/base/unit.h"

enum { MOST_ROWS = 24, MOST_REASONS = 5 };

/* ---- trade-off ---- */

static void show_least(const hci_grid *s, bool of_copper, double percent, const char *what)
{
    const hci_grid_row *row = hci_grid_least(s, of_copper, percent);
    if (!row) {
        cli_say("  %-12s not within these limits\n", what);
        return;
    }
    cli_say("  %-12s %.4g %s%s: T_ripple %s %%, peak %.4g A, copper %.4g × the plain sine\n", what,
            of_copper ? row->point.limit_copper : row->point.limit_current_A, of_copper ? "×" : "A",
            row == s->row + (of_copper ? s->plan.by_current : 0) ? " (the first that was tried)" : "",
            HCI_PERCENT(row->best.T_ripple_percent, 3), row->best.peak_A, row->best.loss_to_plain);
}

static void show_trade_off(const hci_grid *s)
{
    for (size_t k = 0; k < s->plan.count; ++k)
        if (isfinite(s->row[k].sine.peak_A)) {
            cli_say("  plain sine   T_ripple %s %%, peak %.4g A\n",
                    HCI_PERCENT(s->row[k].sine.T_ripple_percent, 3), s->row[k].sine.peak_A);
            break;
        }
    for (int of_copper = 0; of_copper < 2; ++of_copper) {
        cli_say("\n  least limit of the %s with\n", of_copper ? "copper loss" : "phase current");
        show_least(s, of_copper, HUGE_VAL, "any ripple");
        show_least(s, of_copper, 1.0, "1 %");
        show_least(s, of_copper, HCI_GRID_SMOOTH, "no ripple");
    }
}

/* ---- envelope ---- */

static void show_number(double value, int width)
{
    if (isfinite(value))
        cli_say(" %*.4g", width, value);
    else
        cli_say(" %*s", width, "-");
}

static void show_envelope(const hci_grid *s)
{
    const size_t every = (s->plan.count + MOST_ROWS - 1) / MOST_ROWS;
    const hci_component_set *set = s->request.options->set;
    cli_say("\n  largest mean torque found, in N·m, with at most %s %% of ripple, with any, and of the plain "
            "sine\n",
            HCI_PERCENT(s->request.ripple_percent, 4));
    if (set)
        cli_say("  all but the plain sine with these %zu components; others may make more\n", set->count);
    else
        cli_say("  all but the plain sine with components that are chosen\n");
    cli_say("      speed    torque       any  ripple %%      sine  ripple %%  binds\n");
    for (size_t k = 0; k < s->plan.count; k += every) {
        const hci_grid_row *row = &s->row[k];
        char binds[HCI_GRID_BINDS_SIZE];
        hci_grid_binds_text(&row->best, binds);
        cli_say("  %5.5g rpm", hci_rpm(row->point.speed_rad_per_s));
        show_number(row->best.mean_Nm, 9);
        show_number(row->most.mean_Nm, 9);
        show_number(row->most.T_ripple_percent, 9);
        show_number(row->sine.mean_Nm, 10);
        show_number(row->sine.T_ripple_percent, 9);
        cli_say("    %s%s\n", binds, row->verdict == HCI_GRID_LIMITS ? "no current keeps the limits" : "");
    }
}

/* ---- map ---- */

static void show_map(const hci_grid *s)
{
    size_t count[HCI_GRID_FAILED + 1];
    hci_grid_count(s, count);
    cli_say("  no ripple    %zu points\n", count[HCI_GRID_REACHED]);
    cli_say("  least ripple %zu points\n", count[HCI_GRID_RIPPLE]);
    cli_say("  less torque  %zu points\n", count[HCI_GRID_TORQUE]);
    if (count[HCI_GRID_LIMITS])
        cli_say("  no current   keeps the limits at %zu points\n", count[HCI_GRID_LIMITS]);
}

/* ---- all of it ---- */

static void show_failures(const hci_grid *s)
{
    size_t count[HCI_GRID_FAILED + 1], shown = 0;
    hci_grid_count(s, count);
    if (count[HCI_GRID_FAILED] == 0) return;
    cli_say("  " CLI_WARN "failed" CLI_PLAIN "       %zu points\n", count[HCI_GRID_FAILED]);
    for (size_t k = 0; k < s->plan.count && shown < MOST_REASONS; ++k)
        if (s->row[k].verdict == HCI_GRID_FAILED) {
            cli_say("               point %zu: %s\n", k + 1, s->row[k].reason);
            ++shown;
        }
}

void cli_show_sweep(const hci_grid *s, const char *machine)
{
    char limits[HCI_GRID_WORDS_SIZE];
    hci_grid_limits_words(&s->request, limits);
    cli_say(CLI_GOOD "swept" CLI_PLAIN ": %s, %s, %zu points\n", machine, hci_grid_kind_name(s->request.kind),
            s->plan.count);
    cli_say("  limits       %s\n", limits[0] ? limits : "none");
    if (s->request.kind == HCI_GRID_TRADE_OFF) show_trade_off(s);
    if (s->request.kind == HCI_GRID_ENVELOPE) show_envelope(s);
    if (s->request.kind == HCI_GRID_MAP) show_map(s);
    show_failures(s);
}
