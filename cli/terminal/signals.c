#define _POSIX_C_SOURCE 200809L

#include "cli/terminal/signals.h"

#include <signal.h>
#include <stddef.h>
#include <stdio.h>
#include <string.h>

#include "cli/terminal/terminal.h"
#include "hci/host/base/output.h"

/* Only what POSIX allows in a handler. */
static void leave(int number)
{
    cli_line_erase_in_handler();
    hci_output_abandon();
    raise(number);
}

/* From now on `handler` gets a signal once, unless the program was told to ignore it. */
static void handle(int number, void (*handler)(int))
{
    struct sigaction action, before;
    memset(&action, 0, sizeof action);
    action.sa_handler = handler;
    action.sa_flags = (int)SA_RESETHAND;
    sigfillset(&action.sa_mask);
    if (sigaction(number, NULL, &before) == 0 && before.sa_handler != SIG_IGN)
        sigaction(number, &action, NULL);
}

void cli_signals_catch(void)
{
    handle(SIGINT, leave);
    handle(SIGTERM, leave);
    handle(SIGHUP, leave);
}

/* ---- later ---- */

static volatile sig_atomic_t is_deferred;

static void defer(int number)
{
    is_deferred = number;
    handle(number, leave);
}

void cli_signals_defer(void)
{
    is_deferred = 0;
    handle(SIGINT, defer);
    handle(SIGTERM, defer);
    handle(SIGHUP, defer);
}

bool cli_signals_deferred(void *context)
{
    (void)context;
    return is_deferred != 0;
}

void cli_signals_obey(void)
{
    const int number = is_deferred;
    if (!number) return;
    fflush(stdout);
    handle(number, SIG_DFL);
    raise(number);
}
