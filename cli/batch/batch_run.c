#define _POSIX_C_SOURCE 200809L

#include "cli/batch/batch_run.h"

#include <errno.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>
#include <unistd.h>

#include "cli/command/command.h"
#include "cli/command/jobs.h"
#include "cli/terminal/progress.h"
#include "cli/terminal/say.h"
#include "cli/terminal/signals.h"
#include "hci/version.h"

#define KEEP_S 1.0 /* at least, between two writings of fleet.csv and fleet.sqlite */

/* Writing takes at most this share of the time. */
#define KEEP_SHARE 0.05

enum { PATH_SIZE = 4096, LONGEST_SAID = 4096 };

/* What a process answers for a motor. */
typedef struct {
    hci_status status; /* of writing; the rest counts where it is HCI_OK */
    double seconds;
    char text[HCI_FLEET_ROW_SIZE];
} answer;

typedef struct {
    cli_batch_work *work;
    FILE *said; /* in a process of its own: what the command says */
    size_t *item;
    size_t items, taken;
    double kept_s, keeping_s; /* when fleet.csv was written last, and how long that took */
    bool is_changed;          /* since then */
    hci_fleet_stored stored;
    hci_status status;
    hci_note note;
} crew;

static double now_s(void)
{
    struct timespec now;
    clock_gettime(CLOCK_MONOTONIC, &now);
    return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

static hci_fleet_digest digest_of(const cli_batch *batch, size_t motor)
{
    cli_batch_words words;
    cli_batch_words_of(batch, motor, false, &words);
    return hci_fleet_digest_of(HCI_VERSION_STRING, (const char *const *)words.word);
}

/* ---- in a process of its own ---- */

/* What commands say goes into a file, from which the reason of a failure is taken. */
static bool listen(crew *c)
{
    if (!c->said) {
        c->said = tmpfile();
        if (!c->said) return false;
        if (dup2(fileno(c->said), STDOUT_FILENO) < 0 || dup2(fileno(c->said), STDERR_FILENO) < 0)
            return false;
        if (!freopen("/dev/null", "r", stdin)) return false;
    }
    fflush(NULL);
    return ftruncate(fileno(c->said), 0) == 0 && lseek(STDERR_FILENO, 0, SEEK_SET) == 0;
}

/* The last line that was said, without the name of the program. */
static void hear(const crew *c, char reason[HCI_FLEET_REASON_SIZE])
{
    static const char PROGRAM[] = "hci-solve: ";
    char said[LONGEST_SAID + 1];
    fflush(NULL);
    const ssize_t length = pread(fileno(c->said), said, LONGEST_SAID, 0);
    said[length > 0 ? length : 0] = '\0';
    char *begin = strstr(said, PROGRAM), *end;
    begin = begin ? begin + sizeof PROGRAM - 1 : said;
    end = strchr(begin, '\n');
    if (end) *end = '\0';
    snprintf(reason, HCI_FLEET_REASON_SIZE, "%.480s", begin);
}

static hci_fleet_outcome not_begun(bool is_full)
{
    hci_fleet_outcome outcome = {.state = HCI_FLEET_FAILED, .exit_code = -1};
    const bool is_short = !is_full && errno == ENOMEM;
    if (is_short) outcome.exit_code = hci_status_exit_code(HCI_ERROR_MEMORY);
    snprintf(outcome.reason, sizeof outcome.reason, "%s",
             is_full    ? "too many words for one command"
             : is_short ? "out of memory for what it says"
                        : "no temporary file can be made");
    return outcome;
}

/* Runs the command on a motor; its results are in its part folder then. */
static hci_fleet_outcome run_command(crew *c, size_t motor, const char *part)
{
    hci_fleet_outcome outcome = {.exit_code = -1};
    cli_batch_words words;
    cli_batch_words_of(c->work->batch, motor, true, &words);
    cli_batch_add(&words, "--quiet");
    cli_batch_add(&words, "--out");
    cli_batch_add(&words, part);
    if (words.is_full || !listen(c)) return not_begun(words.is_full);
    outcome.exit_code = cli_command_run(c->work->batch->command, (int)words.count, words.word);
    outcome.state = outcome.exit_code == 0   ? HCI_FLEET_DONE
                    : outcome.exit_code == 1 ? HCI_FLEET_OPEN
                                             : HCI_FLEET_FAILED;
    if (outcome.state == HCI_FLEET_FAILED) hear(c, outcome.reason);
    return outcome;
}

/* Of a diagnosis the parameters in common too, so that motors can be compared. Where there are none, that is
 * no failure. */
static void fit_beside(crew *c, size_t motor, const char *part)
{
    const cli_batch *b = c->work->batch;
    char folder[PATH_SIZE];
    cli_batch_words words;
    if (c->work->results.command != HCI_FLEET_DIAGNOSE ||
        snprintf(folder, sizeof folder, "%s/fit", part) >= PATH_SIZE)
        return;
    cli_batch_paths_of(b, motor, &words);
    cli_batch_add(&words, "--quiet");
    cli_batch_add(&words, "--out");
    cli_batch_add(&words, folder);
    if (!words.is_full) (void)cli_command_run(c->work->fit, (int)words.count, words.word);
}

static void do_motor(void *context, size_t motor, void *result)
{
    crew *c = context;
    const hci_fleet_results *r = &c->work->results;
    const hci_fleet_digest digest = digest_of(c->work->batch, motor);
    const double begun_s = now_s();
    char part[PATH_SIZE];
    hci_note note = {{0}};
    answer a = {.status = hci_fleet_part(r, motor, part, sizeof part, &note)};
    if (!a.status) a.status = hci_fleet_begin(r, motor, &note);
    if (!a.status) {
        const hci_fleet_outcome outcome = run_command(c, motor, part);
        if (outcome.state <= HCI_FLEET_OPEN) fit_beside(c, motor, part);
        if (outcome.exit_code == hci_status_exit_code(HCI_ERROR_OUTPUT))
            a.status = hci_note_set(&note, HCI_ERROR_OUTPUT, "%s", outcome.reason);
        else
            a.status = hci_fleet_end(r, motor, &outcome, &digest, a.text, &note);
    }
    if (a.status) snprintf(a.text, sizeof a.text, "%s", note.text);
    a.seconds = now_s() - begun_s;
    memcpy(result, &a, sizeof a);
}

/* ---- here ---- */

static void take_row(crew *c, size_t motor, const char *row, double seconds)
{
    c->stored.seconds[motor] = seconds;
    c->work->row[motor] = strdup(row);
    if (!c->work->row[motor]) c->status = hci_note_memory(&c->note, NULL, "the rows of a fleet");
    c->is_changed = true;
    ++c->taken;
}

/* A motor whose process has ended: as it has done it before its end, or a row that says so. */
static void take_lost(crew *c, size_t motor, int number)
{
    const hci_fleet_results *r = &c->work->results;
    const hci_fleet_digest digest = digest_of(c->work->batch, motor);
    hci_fleet_outcome outcome = {.state = HCI_FLEET_CRASHED, .exit_code = -1};
    char row[HCI_FLEET_ROW_SIZE];
    bool is_done;
    c->status = hci_fleet_known(r, motor, &digest, row, &is_done, &c->note);
    if (number == CLI_JOB_LATE) {
        outcome.state = HCI_FLEET_LATE;
        snprintf(outcome.reason, sizeof outcome.reason, "it took longer than %.12g s", c->work->limit_s);
    } else if (number) {
        snprintf(outcome.reason, sizeof outcome.reason, "its process was ended by signal %d", number);
    } else {
        snprintf(outcome.reason, sizeof outcome.reason, "its process ended");
    }
    if (!c->status && !is_done) c->status = hci_fleet_end(r, motor, &outcome, &digest, row, &c->note);
    if (!c->status) take_row(c, motor, row, NAN);
}

static void take_answer(void *context, size_t motor, const void *result, int number)
{
    crew *c = context;
    answer a;
    if (!result) {
        take_lost(c, motor, number);
        return;
    }
    memcpy(&a, result, sizeof a);
    if (a.status)
        c->status = hci_note_set(&c->note, a.status, "%s", a.text);
    else
        take_row(c, motor, a.text, a.seconds);
}

static bool is_whole(const cli_batch_work *w)
{
    for (size_t k = 0; k < w->batch->list.count; ++k)
        if (!w->row[k]) return false;
    return true;
}

static void keep(crew *c)
{
    const double begun_s = now_s();
    hci_note note = {{0}};
    hci_status status = hci_fleet_store(&c->work->results, c->work->row, &c->stored, &note);
    if (!status) status = hci_fleet_write(&c->work->results, c->work->row, is_whole(c->work), &note);
    if (status && !c->status) c->status = hci_note_set(&c->note, status, "%s", note.text);
    c->is_changed = false;
    c->kept_s = now_s();
    c->keeping_s = c->kept_s - begun_s;
}

static bool goes_on(void *context)
{
    crew *c = context;
    cli_work unit = {(double)c->items, "motors"};
    const double since_s = now_s() - c->kept_s;
    cli_progress(&unit, hci_fleet_command_name(c->work->results.command),
                 (double)c->taken / (double)c->items);
    if (c->is_changed && since_s > KEEP_S && since_s * KEEP_SHARE > c->keeping_s) keep(c);
    return !c->status && !cli_signals_deferred(NULL);
}

/* ---- all of it ---- */

/* A result that is no whole is told and is done again. What another share has to do is left to it, and after
 * Ctrl-C nothing more is looked at. */
static hci_status check(crew *c, size_t motor, const char *row, bool *is_done, hci_note *note)
{
    const hci_fleet_digest digest = digest_of(c->work->batch, motor);
    if (!cli_shard_has(&c->work->shard, motor) || cli_signals_deferred(NULL)) return HCI_OK;
    const hci_status status = hci_fleet_check(&c->work->results, motor, &digest, row, note);
    if (status != HCI_ERROR_INPUT) return status;
    cli_progress_end();
    cli_remark(note);
    note->text[0] = '\0';
    *is_done = false;
    return hci_fleet_forget(&c->work->results, motor, note);
}

/* A motor that is done already, as far as it counts. */
static hci_status take_known(crew *c, size_t motor, bool *is_done, hci_note *note)
{
    cli_batch_work *w = c->work;
    const hci_fleet_digest digest = digest_of(w->batch, motor);
    char row[HCI_FLEET_ROW_SIZE];
    hci_status status = hci_fleet_known(&w->results, motor, &digest, row, is_done, note);
    if (!status && *is_done && w->retries && hci_fleet_row_state(row) > HCI_FLEET_OPEN) {
        status = hci_fleet_forget(&w->results, motor, note);
        *is_done = false;
    }
    if (!status && *is_done) status = check(c, motor, row, is_done, note);
    if (!status && *is_done) take_row(c, motor, row, NAN);
    return status;
}

/* What is done already, and what is to be done. */
static hci_status list_items(crew *c, hci_note *note)
{
    cli_batch_work *w = c->work;
    const size_t motors = w->batch->list.count;
    cli_work unit = {(double)motors, "motors"};
    hci_status status = HCI_OK;
    for (size_t k = 0; k < motors && !status; ++k) {
        bool is_done;
        cli_progress(&unit, "checking what is done", (double)k / (double)motors);
        status = take_known(c, k, &is_done, note);
        if (!status && !is_done && cli_shard_has(&w->shard, k)) c->item[c->items++] = k;
    }
    cli_progress_end();
    c->taken = 0;
    if (status) return status;
    return c->status ? hci_note_set(note, c->status, "%s", c->note.text) : HCI_OK;
}

static hci_status do_motors(crew *c, hci_note *note)
{
    const cli_jobs all = {.jobs = c->work->jobs,
                          .item = c->item,
                          .items = c->items,
                          .answer_size = sizeof(answer),
                          .work = do_motor,
                          .take = take_answer,
                          .goes_on = goes_on,
                          .context = c,
                          .limit_s = c->work->limit_s,
                          .outlives_all = true};
    c->kept_s = now_s();
    const hci_status status = cli_jobs_run(&all, note);
    c->stored.is_last = true;
    keep(c);
    cli_progress_end();
    if (!status && c->status) return hci_note_set(note, c->status, "%s", c->note.text);
    return status;
}

hci_status cli_batch_run(cli_batch_work *work, hci_note *note)
{
    crew c = {.work = work};
    void *lock = NULL;
    const size_t count = work->batch->list.count;
    hci_status status = HCI_OK;
    work->row = calloc(count, sizeof *work->row);
    c.item = calloc(count, sizeof *c.item);
    c.stored = (hci_fleet_stored){calloc(count, sizeof(double)), calloc(count, sizeof(bool)), false, false};
    if (!work->row || !c.item || !c.stored.seconds || !c.stored.is_stored)
        status = hci_note_memory(note, NULL, "the motors of a list");
    cli_signals_defer();
    if (!status) status = hci_fleet_lock(&work->results, &lock, note);
    if (!status) status = list_items(&c, note);
    if (!status) status = do_motors(&c, note);
    hci_fleet_unlock(lock);
    free(c.item);
    free(c.stored.seconds);
    free(c.stored.is_stored);
    return status;
}

void cli_batch_release(cli_batch_work *work)
{
    for (size_t k = 0; work->row && k < work->batch->list.count; ++k)
        free(work->row[k]);
    free(work->row);
    work->row = NULL;
}
