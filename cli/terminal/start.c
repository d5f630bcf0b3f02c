/* Libraries that the program is linked with end it with exit code 1 when they find no memory as it starts,
 * before main. That code means something else here. */
#include "cli/terminal/start.h"

#include <stdbool.h>
#include <stdlib.h>
#include <unistd.h>

#include "hci/status.h"

static bool has_started;

static void end_with_memory(void)
{
    if (!has_started) _exit(hci_status_exit_code(HCI_ERROR_MEMORY));
}

static void before_libraries(void)
{
    atexit(end_with_memory);
}

/* The loader of glibc calls what is in this section before it starts any library. */
#if defined(__ELF__)
__attribute__((section(".preinit_array"), used)) static void (*const preinit)(void) = before_libraries;
#endif

void cli_start(void)
{
    has_started = true;
}
