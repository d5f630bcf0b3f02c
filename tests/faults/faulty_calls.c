/* Preloaded into a program: before the call number FAULT_AT that changes a folder or brings a file to the
 * disk, the process is killed, or with FAULT_ERROR set, the call fails with EIO instead. With FAULT_COUNT
 * set, how many calls there were is written to that file descriptor as the program ends. */
#define _GNU_SOURCE
#include <dlfcn.h>
#include <errno.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

static long count;

static int fails(void)
{
    const char *at = getenv("FAULT_AT");
    if (++count != (at ? atol(at) : 0)) return 0;
    if (getenv("FAULT_ERROR") == NULL) kill(getpid(), SIGKILL);
    errno = EIO;
    return 1;
}

#define REPLACE(type, name, parameters, words)                                                               \
    type name parameters                                                                                     \
    {                                                                                                        \
        type(*real) parameters;                                                                              \
        *(void **)&real = dlsym(RTLD_NEXT, #name);                                                           \
        return fails() ? (type)-1 : real words;                                                              \
    }

REPLACE(int, rename, (const char *from, const char *to), (from, to))
REPLACE(int, link, (const char *from, const char *to), (from, to))
REPLACE(int, unlink, (const char *path), (path))
REPLACE(int, unlinkat, (int folder, const char *path, int flags), (folder, path, flags))
REPLACE(int, fsync, (int descriptor), (descriptor))
REPLACE(int, mkdir, (const char *path, mode_t mode), (path, mode))
REPLACE(int, rmdir, (const char *path), (path))

/* A stream whose end cannot be written is closed all the same. */
int fclose(FILE *stream)
{
    int (*real)(FILE *);
    *(void **)&real = dlsym(RTLD_NEXT, "fclose");
    const int failed = fails(), result = real(stream);
    if (failed) errno = EIO;
    return failed ? -1 : result;
}

__attribute__((destructor)) static void tell(void)
{
    char text[32];
    const char *to = getenv("FAULT_COUNT");
    if (to == NULL) return;
    snprintf(text, sizeof text, "%ld\n", count);
    if (write(atoi(to), text, strlen(text)) < 0) _exit(1);
}
