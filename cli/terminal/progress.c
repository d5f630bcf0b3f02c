#define _POSIX_C_SOURCE 200809L

#include <math.h>
#include <signal.h>
#include <string.h>
#include <time.h>
#include <unistd.h>

#include "cli/command/command.h"
#include "hci/host/base/output.h"

#define SILENT_s    1.0 /* shorter work shows nothing */
#define REDRAW_s    0.1
#define SETTLING_s  1.5  /* in which the time that is left follows what the share says of it … */
#define GOOD_NEWS_s 0.5  /* … and where that is less */
#define LEAST_SHARE 0.02 /* from which it says something */

/* Columns of the terminal: of bar, share with times, and rate. */
enum { MOST_CELLS = 30, LEAST_CELLS = 5, FIGURES = 27, RATE = 22, TEXT_SIZE = 160 };

static const char ERASE[] = "\r\033[K";

static struct {
    bool started;
    volatile sig_atomic_t shown;
    struct timespec start;
    double from_s, from_share; /* of the part of the work that is under way */
    double now_s, share, drawn_s;
    double end_s; /* when it will be done; NAN: not known */
} bar;

/* ---- time ---- */

static double seconds_since(const struct timespec *start)
{
    struct timespec now;
    clock_gettime(CLOCK_MONOTONIC, &now);
    return (double)(now.tv_sec - start->tv_sec) + 1e-9 * (double)(now.tv_nsec - start->tv_nsec);
}

static void begin_part(double now_s, double share)
{
    bar.from_s = bar.now_s = now_s;
    bar.from_share = bar.share = share;
    bar.end_s = NAN;
}

/* A share that falls is that of another part of the work. */
static void follow(double share)
{
    const double now_s = seconds_since(&bar.start), before_s = bar.now_s, gone = share - bar.from_share;
    if (share < bar.share) {
        begin_part(now_s, share);
        return;
    }
    bar.now_s = now_s;
    bar.share = share;
    if (gone < LEAST_SHARE || now_s - bar.from_s < 0.5 * SILENT_s) return;
    const double end_s = now_s + (now_s - bar.from_s) * (1.0 - share) / gone;
    if (isnan(bar.end_s))
        bar.end_s = end_s;
    else
        bar.end_s += (end_s - bar.end_s) *
                     -expm1(-(now_s - before_s) / (end_s < bar.end_s ? GOOD_NEWS_s : SETTLING_s));
}

/* ---- the line ---- */

static void rate_text(const cli_work *work, char *text, size_t size)
{
    const double share_per_s = (bar.share - bar.from_share) / (bar.now_s - bar.from_s);
    const double rate = share_per_s * (work ? work->total : 100.0);
    text[0] = '\0';
    if (!(rate > 0.0 && rate < 1e12)) return;
    if (rate >= 1e6)
        snprintf(text, size, "  %.3g M %s/s", 1e-6 * rate, work ? work->unit : "%");
    else if (rate >= 1e4)
        snprintf(text, size, "  %.3g k %s/s", 1e-3 * rate, work ? work->unit : "%");
    else
        snprintf(text, size, rate < 99.5 ? "  %.2g %s/s" : "  %.0f %s/s", rate, work ? work->unit : "%");
}

static void clock_text(double seconds, char text[24])
{
    const long whole = (long)(seconds + 0.5);
    snprintf(text, 24, "%ld:%02ld", whole / 60, whole % 60);
}

static void times_text(char *text, size_t size)
{
    char gone[24], left[24];
    clock_text(bar.now_s, gone);
    clock_text(fmax(0.0, bar.end_s - bar.now_s), left);
    if (isnan(bar.end_s))
        snprintf(text, size, "  %s", gone);
    else
        snprintf(text, size, "  %s, %s left", gone, left);
}

/* Where the terminal is narrow the rate goes first, then the bar, then the times. */
static void draw(const cli_work *work, const char *what)
{
    char rate[TEXT_SIZE], times[TEXT_SIZE], line[3 * TEXT_SIZE], cells[4 * MOST_CELLS + 4] = "";
    const int width = cli_width(STDERR_FILENO) - 1;
    int room = width - (int)cli_text_width(what) - FIGURES - RATE;
    rate_text(work, rate, sizeof rate);
    times_text(times, sizeof times);
    if (room < LEAST_CELLS) {
        rate[0] = '\0';
        room += RATE;
    }
    if (room >= LEAST_CELLS) cli_bar_text(bar.share, NAN, room < MOST_CELLS ? room : MOST_CELLS, cells);
    if ((int)cli_text_width(what) + FIGURES > width) times[0] = '\0';
    snprintf(line, sizeof line, "%s %s%s%3.0f %%%s%s", what, cells, cells[0] ? " " : "", 100.0 * bar.share,
             times, rate);
    bar.shown = 1;
    fprintf(stderr, "%s%s", ERASE, line);
    bar.drawn_s = bar.now_s;
}

void cli_progress(void *work, const char *what, double share)
{
    if (cli_is_quiet() || !cli_is_terminal()) return;
    if (!bar.started) {
        bar.started = true;
        clock_gettime(CLOCK_MONOTONIC, &bar.start);
        begin_part(0.0, share);
    }
    follow(fmin(fmax(share, 0.0), 1.0));
    if (bar.now_s >= SILENT_s && (!bar.shown || bar.now_s - bar.drawn_s >= REDRAW_s)) draw(work, what);
}

void cli_progress_end(void)
{
    if (bar.shown) fputs(ERASE, stderr);
    bar.shown = 0;
    bar.started = false;
}

/* ---- signals ---- */

/* Only what POSIX allows in a handler; the signal then ends the program as it would have. */
static void leave(int number)
{
    if (bar.shown && write(STDERR_FILENO, ERASE, sizeof ERASE - 1) < 0) bar.shown = 0;
    hci_output_abandon();
    raise(number);
}

void cli_signals_catch(void)
{
    static const int NUMBERS[] = {SIGINT, SIGTERM, SIGHUP};
    for (size_t k = 0; k < sizeof NUMBERS / sizeof *NUMBERS; ++k) {
        struct sigaction action, before;
        memset(&action, 0, sizeof action);
        action.sa_handler = leave;
        action.sa_flags = (int)SA_RESETHAND;
        sigfillset(&action.sa_mask);
        if (sigaction(NUMBERS[k], NULL, &before) == 0 && before.sa_handler != SIG_IGN)
            sigaction(NUMBERS[k], &action, NULL);
    }
}
