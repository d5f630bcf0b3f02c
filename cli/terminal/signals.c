#define _POSIX_C_SOURCE 200809L

#include "cli/terminal/signals.h"

#include <signal.h>
#include <stddef.h>
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
