#define _POSIX_C_SOURCE 200809L

#include "cli/diagnose/diagnose_words.h"

#include <math.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>

#include "cli/terminal/chart.h"
#include "cli/terminal/rows.h"
#include "cli/terminal/say.h"
#include "cli/terminal/terminal.h"
#include "cli/terminal/text.h"
#include "hci/host/base/number.h"
#include "hci/host/diagnose/again.h"

/* What no effect explains is in no machine, whatever the table calls it. */
static const char *verdict_words(const hci_finding *f)
{
    return strcmp(f->effect, "unknown") == 0 ? "left" : hci_finding_verdict_name(f->verdict);
}

static void show_finding(const hci_diagnosis *d, const hci_finding *f)
{
    char words[HCI_DETAIL_SIZE];
    hci_finding_words(d, f, words, sizeof words);
    cli_say("  %-12s %s: %s\n", verdict_words(f), hci_finding_title(f->effect), words);
}

static void show_slips(const hci_diagnosis *d)
{
    for (size_t k = 0; k < d->runs; ++k)
        if (d->run[k].slip_rad != 0.0)
            cli_say("  index slip   %s: its mechanical angle is %.4g° ahead of that of the others; turned "
                    "back here\n",
                    d->run[k].file, d->run[k].slip_rad * 180.0 / HCI_PI);
}

static void show_again(const hci_again *a)
{
    char words[HCI_AGAIN_WORDS];
    hci_again_words(a, words, sizeof words);
    cli_say("  again\n");
    cli_say_paragraph(4, words);
}

static void show_resolution(const hci_resolution *r)
{
    char words[1024];
    cli_say("  old currents mean %.4g N·m, rms error %.3g N·m, T_ripple %s %% on the corrected machine\n",
            r->old_currents.mean_Nm, r->old_currents.rms_error_Nm,
            HCI_PERCENT(r->old_currents.T_ripple_percent, 3));
    cli_say("  new currents mean %.4g N·m, rms error %.3g N·m, T_ripple %s %%, copper %.3f × the old\n",
            r->new_currents.mean_Nm, r->new_currents.rms_error_Nm,
            HCI_PERCENT(r->new_currents.T_ripple_percent, 3),
            r->after.mean_square_A2 / r->before.mean_square_A2);
    hci_expected_ripple_words(&r->after.expected, words, sizeof words);
    cli_say("  new currents on the real machine\n");
    cli_say_paragraph(4, words);
}

/* ---- bars ---- */

static bool is_shown(const hci_finding *f)
{
    return f->verdict != HCI_FINDING_REJECTED;
}

/* Torque that an effect alone explains. */
static double own_Nm(const hci_diagnosis *d, const hci_finding *f)
{
    return sqrt(f->residual_share) * d->rms_before_Nm;
}

static void finding_row(const void *context, size_t row, cli_cell cell[])
{
    const hci_diagnosis *d = context;
    const hci_finding *f = d->finding;
    for (size_t shown = 0; shown < row || !is_shown(f); ++f)
        shown += is_shown(f);
    snprintf(cell[0].text, sizeof cell[0].text, "%s", hci_finding_title(f->effect));
    snprintf(cell[1].text, sizeof cell[1].text, "%s", verdict_words(f));
    if (isfinite(f->delta_bic)) snprintf(cell[2].text, sizeof cell[2].text, "%.4g", f->delta_bic);
    if (!isfinite(f->residual_share)) return;
    snprintf(cell[3].text, sizeof cell[3].text, "%.4g", own_Nm(d, f));
    cell[4].value = own_Nm(d, f);
}

static void draw_findings(const hci_diagnosis *d)
{
    static const cli_column COLUMNS[] = {
        {CLI_LEFT, "effect"}, {CLI_LEFT, "verdict"}, {CLI_RIGHT, "ΔBIC"}, {CLI_RIGHT, "own"}, {CLI_BAR, ""}};
    size_t rows = 0;
    for (size_t k = 0; k < d->findings; ++k)
        rows += is_shown(&d->finding[k]);
    cli_draw(&(cli_chart){.caption =
                              "effects by evidence (ΔBIC); own: rms torque that only this one explains, N·m",
                          .column = COLUMNS,
                          .columns = 5,
                          .rows = rows,
                          .fill = finding_row,
                          .context = d,
                          .unit = "N·m"});
}

typedef struct {
    const hci_diagnosis *diagnosis;
    size_t pick[CLI_MOST_ROWS];
} worst_runs;

static double error_Nm(const void *diagnosis, size_t k)
{
    return ((const hci_diagnosis *)diagnosis)->run[k].rms_after_Nm;
}

static void run_row(const void *context, size_t row, cli_cell cell[])
{
    const worst_runs *w = context;
    const hci_run_errors *e = &w->diagnosis->run[w->pick[row]];
    snprintf(cell[0].text, sizeof cell[0].text, "%s", cli_text_end(e->file, 40));
    snprintf(cell[1].text, sizeof cell[1].text, "%s", e->role == HCI_ROLE_FIT ? "fit" : "holdout");
    snprintf(cell[2].text, sizeof cell[2].text, "%.4g", e->rms_before_Nm);
    cell[3].value = e->rms_before_Nm;
    snprintf(cell[4].text, sizeof cell[4].text, "%.4g", e->rms_after_Nm);
    cell[5].value = e->rms_after_Nm;
    cell[3].mark = cell[5].mark = e->noise_floor_Nm;
}

static void draw_runs(const hci_diagnosis *d)
{
    static const cli_column COLUMNS[] = {{CLI_LEFT, "run"}, {CLI_LEFT, "role"},   {CLI_RIGHT, "before"},
                                         {CLI_BAR, ""},     {CLI_RIGHT, "after"}, {CLI_BAR, ""}};
    char caption[240];
    worst_runs w = {.diagnosis = d};
    const size_t rows = cli_pick(error_Nm, d, d->runs, 0.0, w.pick, NULL);
    snprintf(caption, sizeof caption,
             "error of each run (rms of measured less modelled torque), N·m; before: the machine as "
             "declared; %s noise, where it is in the range",
             cli_is_ascii(STDOUT_FILENO) ? "|" : "│");
    cli_draw(&(cli_chart){.caption = caption,
                          .column = COLUMNS,
                          .columns = 6,
                          .rows = rows,
                          .fill = run_row,
                          .context = &w,
                          .logarithmic = true,
                          .unit = "N·m"});
    if (rows < d->runs) cli_say("  and %zu runs with smaller errors\n", d->runs - rows);
}

void cli_show_convention(const hci_check_finding *f)
{
    cli_say("check finds: %s (%s %% sure): %s:%zu: column %s: found %s, should be %s; mend that "
            "first and diagnose again\n\n",
            f->words, HCI_PERCENT(100.0 * f->probability, 3), f->file, f->line, f->column, f->found,
            f->should_be);
}

void cli_show_diagnosis(const hci_diagnosis *d, const hci_resolution *r, const char *machine,
                        const char *runs)
{
    static const char *const TONES[] = {CLI_GOOD, CLI_GOOD, CLI_WARN, CLI_WARN, CLI_BAD};
    char words[2048];
    hci_diagnosis_words(d, words, sizeof words);
    cli_say("diagnosed: %s, %s: %s%s%s%s" CLI_PLAIN "\n", machine, runs,
            d->odd.file ? CLI_WARN : TONES[d->verdict], hci_diagnosis_verdict_name(d->verdict),
            d->odd.is_aside ? " without one recording, which is set aside"
            : d->odd.file   ? " without one recording that disagrees"
                            : "",
            d->search == HCI_WORK_COMPLETE ? "" : " as far as was looked");
    cli_say_paragraph(2, words);
    for (size_t k = 0; k < d->findings; ++k)
        if (is_shown(&d->finding[k])) show_finding(d, &d->finding[k]);
    show_slips(d);
    if (d->again) show_again(d->again);
    if (d->advice[0]) cli_say("  measure next %s\n", d->advice);
    if (r) show_resolution(r);
    draw_findings(d);
    draw_runs(d);
}
