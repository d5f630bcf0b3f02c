#define _POSIX_C_SOURCE 200809L

#include "cli/command/jobs.h"

#include <errno.h>
#include <poll.h>
#include <signal.h>
#include <stdio.h>
#include <string.h>
#include <sys/types.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>

#ifdef __linux__
#include <sys/prctl.h>
#endif

enum { WAIT_MS = 200 };

/* A process, and the two pipes to it: items go there, answers come back. */
typedef struct {
    pid_t pid; /* 0: none */
    int to, from;
    bool is_busy;
    size_t item;
    double begun_s; /* with the item */
} worker;

typedef struct {
    const cli_jobs *jobs;
    worker worker[CLI_MOST_JOBS];
    size_t next; /* of the items */
} crew;

size_t cli_processors(void)
{
    const long count = sysconf(_SC_NPROCESSORS_ONLN);
    return count < 1 ? 1 : count > CLI_MOST_JOBS ? CLI_MOST_JOBS : (size_t)count;
}

/* ---- whole blocks through a pipe ---- */

static bool read_all(int from, void *block, size_t size)
{
    for (char *at = block; size > 0;) {
        const ssize_t count = read(from, at, size);
        if (count < 0 && errno == EINTR) continue;
        if (count <= 0) return false;
        at += count;
        size -= (size_t)count;
    }
    return true;
}

static bool write_all(int to, const void *block, size_t size)
{
    for (const char *at = block; size > 0;) {
        const ssize_t count = write(to, at, size);
        if (count < 0 && errno == EINTR) continue;
        if (count <= 0) return false;
        at += count;
        size -= (size_t)count;
    }
    return true;
}

static double now_s(void)
{
    struct timespec now;
    clock_gettime(CLOCK_MONOTONIC, &now);
    return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

/* ---- in a process of its own ---- */

/* Who is killed does not end its processes; where the system can, it ends them. */
static void end_with_parent(pid_t parent)
{
#ifdef __linux__
    prctl(PR_SET_PDEATHSIG, SIGKILL);
#endif
    if (getppid() != parent) _exit(0);
}

/* Ctrl-C and its like end it at once: what it works at is begun again another time. */
static void serve(const cli_jobs *j, int from, int to)
{
    size_t item;
    char answer[CLI_MOST_ANSWER];
    signal(SIGINT, SIG_DFL);
    signal(SIGTERM, SIG_DFL);
    signal(SIGHUP, SIG_DFL);
    while (read_all(from, &item, sizeof item)) {
        j->work(j->context, item, answer);
        if (!write_all(to, answer, j->answer_size)) break;
    }
    _exit(0);
}

/* The pipes to the others must not stay open here: a process ends when its own is closed. */
static void close_others(const crew *c)
{
    for (size_t k = 0; k < c->jobs->jobs; ++k)
        if (c->worker[k].pid) {
            close(c->worker[k].to);
            close(c->worker[k].from);
        }
}

/* ---- here ---- */

static hci_status cannot_start(hci_note *note)
{
    return hci_note_set(note, HCI_ERROR_MEMORY, "a process cannot be started: %s", strerror(errno));
}

static hci_status start(crew *c, worker *w, hci_note *note)
{
    int there[2], back[2];
    if (pipe(there)) return cannot_start(note);
    if (pipe(back)) {
        close(there[0]), close(there[1]);
        return cannot_start(note);
    }
    fflush(NULL); /* what is not written yet would be written twice */
    const pid_t parent = getpid(), pid = fork();
    if (pid == 0) {
        end_with_parent(parent);
        close_others(c);
        close(there[1]), close(back[0]);
        serve(c->jobs, there[0], back[1]);
    }
    close(there[0]), close(back[1]);
    *w = (worker){.pid = pid, .to = there[1], .from = back[0]};
    if (pid > 0) return HCI_OK;
    close(w->to), close(w->from);
    w->pid = 0;
    return cannot_start(note);
}

/* Ends a process, and waits for it. Returns the signal that had ended it, 0: none. */
static int end(worker *w, bool now)
{
    int state = 0;
    if (now) kill(w->pid, SIGKILL);
    close(w->to), close(w->from);
    while (waitpid(w->pid, &state, 0) < 0 && errno == EINTR) {
    }
    w->pid = 0;
    return WIFSIGNALED(state) ? WTERMSIG(state) : 0;
}

static bool is_fault(int number)
{
    return number == SIGSEGV || number == SIGBUS || number == SIGFPE || number == SIGILL || number == SIGABRT;
}

static bool is_request(int number)
{
    return number == SIGINT || number == SIGTERM || number == SIGHUP;
}

/* The next item for a process, which is started where there is none; one that has nothing to do stays idle.
 */
static hci_status hand_out(crew *c, worker *w, hci_note *note)
{
    hci_status status = HCI_OK;
    if (w->is_busy || c->next == c->jobs->items) return HCI_OK;
    if (!w->pid) status = start(c, w, note);
    if (status) return status;
    w->item = c->jobs->item[c->next++];
    w->is_busy = true;
    w->begun_s = now_s();
    (void)write_all(w->to, &w->item, sizeof w->item); /* one that has ended is seen when it is read from */
    return HCI_OK;
}

/* stops: out, whether the work is to end without an error, as after Ctrl-C, which reaches all processes. */
static hci_status take_answer(crew *c, worker *w, bool *stops, hci_note *note)
{
    const cli_jobs *j = c->jobs;
    char answer[CLI_MOST_ANSWER];
    w->is_busy = false;
    if (read_all(w->from, answer, j->answer_size)) {
        j->take(j->context, w->item, answer, 0);
        return HCI_OK;
    }
    const int number = end(w, false);
    if (is_fault(number) || (j->outlives_all && !is_request(number))) {
        j->take(j->context, w->item, NULL, number);
        return HCI_OK;
    }
    *stops = number == SIGINT || !j->goes_on(j->context);
    if (*stops) return HCI_OK;
    return hci_note_set(note, HCI_ERROR_NUMERIC,
                        "a process was ended by signal %d; the points that are done are kept", number);
}

static void end_late(crew *c)
{
    const cli_jobs *j = c->jobs;
    const double now = now_s();
    for (size_t k = 0; k < j->jobs && j->limit_s > 0.0; ++k) {
        worker *w = &c->worker[k];
        if (!w->is_busy || now - w->begun_s < j->limit_s) continue;
        w->is_busy = false;
        (void)end(w, true);
        j->take(j->context, w->item, NULL, CLI_JOB_LATE);
    }
}

static size_t list_busy(const crew *c, struct pollfd list[], size_t place[])
{
    size_t count = 0;
    for (size_t k = 0; k < c->jobs->jobs; ++k)
        if (c->worker[k].is_busy) {
            list[count] = (struct pollfd){c->worker[k].from, POLLIN, 0};
            place[count++] = k;
        }
    return count;
}

static hci_status round_of(crew *c, bool *stops, hci_note *note)
{
    struct pollfd list[CLI_MOST_JOBS];
    size_t place[CLI_MOST_JOBS];
    hci_status status = HCI_OK;
    for (size_t k = 0; k < c->jobs->jobs && !status; ++k)
        status = hand_out(c, &c->worker[k], note);
    const size_t busy = list_busy(c, list, place);
    if (status || busy == 0) return *stops = true, status;
    if (poll(list, (nfds_t)busy, WAIT_MS) > 0)
        for (size_t k = 0; k < busy && !status && !*stops; ++k)
            if (list[k].revents) status = take_answer(c, &c->worker[place[k]], stops, note);
    if (!status && !*stops) end_late(c);
    *stops = *stops || !c->jobs->goes_on(c->jobs->context);
    return status;
}

hci_status cli_jobs_run(const cli_jobs *jobs, hci_note *note)
{
    crew c = {.jobs = jobs};
    hci_status status = HCI_OK;
    bool stops = jobs->items == 0;
    while (!stops && !status)
        status = round_of(&c, &stops, note);
    for (size_t k = 0; k < jobs->jobs; ++k)
        if (c.worker[k].pid) (void)end(&c.worker[k], true);
    return status;
}
