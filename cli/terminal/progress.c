#define _POSIX_C_SOURCE 200809L

#include "cli/terminal/progress.h"

#include <math.h>
#include <stdbool.h>
#include <stdio.h>
#include <time.h>
#include <unistd.h>

#include "cli/terminal/bar.h"
#include "cli/terminal/terminal.h"
#include "cli/terminal/text.h"

#define SILENT_s 1.0 /* shorter work shows nothing */
#define REDRAW_s 0.1

/* Columns of the terminal: of bar, share with times, and rate. */
enum { MOST_CELLS = 30, LEAST_CELLS = 5, FIGURES = 27, RATE = 22, TEXT_SIZE = 160, LINE_SIZE = 512 };

/* ---- the line ---- */

static void rate_text(const cli_estimate *e, const cli_work *work, char text[TEXT_SIZE])
{
    const char *unit = work ? work->unit : "%";
    const double rate = cli_estimate_share_per_s(e) * (work ? work->total : 100.0);
    text[0] = '\0';
    if (!(rate > 0.0 && rate < 1e12)) return;
    if (rate >= 1e6)
        snprintf(text, TEXT_SIZE, "  %.3g M %s/s", 1e-6 * rate, unit);
    else if (rate >= 1e4)
        snprintf(text, TEXT_SIZE, "  %.3g k %s/s", 1e-3 * rate, unit);
    else
        snprintf(text, TEXT_SIZE, rate < 99.5 ? "  %.2g %s/s" : "  %.0f %s/s", rate, unit);
}

static void minutes_text(double seconds, char text[24])
{
    const long whole = (long)(seconds + 0.5);
    snprintf(text, 24, "%ld:%02ld", whole / 60, whole % 60);
}

static void times_text(const cli_estimate *e, char text[TEXT_SIZE])
{
    const double left_s = cli_estimate_left_s(e);
    char gone[24], left[24];
    minutes_text(e->now_s, gone);
    if (isnan(left_s)) {
        snprintf(text, TEXT_SIZE, "  %s", gone);
        return;
    }
    minutes_text(left_s, left);
    snprintf(text, TEXT_SIZE, "  %s, %s left", gone, left);
}

void cli_progress_text(const cli_estimate *e, const cli_work *work, const char *what, int columns, char *text,
                       size_t size)
{
    char rate[TEXT_SIZE], times[TEXT_SIZE], cells[4 * MOST_CELLS + 4] = "";
    const int words = (int)cli_text_width(what);
    int room = columns - words - FIGURES - RATE;
    rate_text(e, work, rate);
    times_text(e, times);
    if (room < LEAST_CELLS) {
        rate[0] = '\0';
        room += RATE;
    }
    if (room >= LEAST_CELLS)
        cli_bar_text(e->share, NAN, room < MOST_CELLS ? room : MOST_CELLS, cli_is_ascii(STDERR_FILENO),
                     cells);
    if (words + FIGURES > columns) times[0] = '\0';
    snprintf(text, size, "%s %s%s%3.0f %%%s%s", what, cells, cells[0] ? " " : "", 100.0 * e->share, times,
             rate);
}

/* ---- the job ---- */

static double computer_clock(void)
{
    struct timespec now;
    clock_gettime(CLOCK_MONOTONIC, &now);
    return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

static cli_clock *clock_s = computer_clock;

/* Times are counted from its start. */
static struct {
    bool is_started;
    double start_s, drawn_s;
    cli_estimate estimate;
} job;

void cli_progress_use_clock(cli_clock *clock)
{
    clock_s = clock ? clock : computer_clock;
}

static void start(double share)
{
    job.is_started = true;
    job.start_s = clock_s();
    cli_estimate_begin(&job.estimate, 0.0, share);
}

static bool is_due(void)
{
    const double now_s = job.estimate.now_s;
    return now_s >= SILENT_s && (!cli_line_is_shown() || now_s - job.drawn_s >= REDRAW_s);
}

void cli_progress(void *work, const char *what, double share)
{
    char line[LINE_SIZE];
    if (cli_is_quiet() || !cli_is_terminal(STDERR_FILENO)) return;
    if (!job.is_started) start(share);
    cli_estimate_follow(&job.estimate, clock_s() - job.start_s, fmin(fmax(share, 0.0), 1.0));
    if (!is_due()) return;
    cli_progress_text(&job.estimate, work, what, cli_width(STDERR_FILENO) - 1, line, sizeof line);
    cli_line_show(line);
    job.drawn_s = job.estimate.now_s;
}

void cli_progress_end(void)
{
    cli_line_erase();
    job.is_started = false;
}
