/* Preloaded into a program: its allocation number FAIL_AT fails, whichever library makes it, counted over the
 * processes that it forks too. With FAIL_COUNT set, how many there were is written to that file descriptor as
 * the program ends. */
#define _GNU_SOURCE
#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <unistd.h>

/* The allocator of glibc below the names that are replaced here. */
extern void *__libc_malloc(size_t);
extern void *__libc_calloc(size_t, size_t);
extern void *__libc_realloc(void *, size_t);

static long *count;

static int fails(void)
{
    static long at = -1;
    if (count == NULL)
        count = mmap(NULL, sizeof *count, PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
    const long now = __sync_add_and_fetch(count, 1);
    if (at < 0) at = getenv("FAIL_AT") ? atol(getenv("FAIL_AT")) : 0;
    if (now == at) errno = ENOMEM;
    return now == at;
}

void *malloc(size_t size)
{
    return fails() ? NULL : __libc_malloc(size);
}

void *calloc(size_t n, size_t size)
{
    return fails() ? NULL : __libc_calloc(n, size);
}

void *realloc(void *block, size_t size)
{
    return fails() ? NULL : __libc_realloc(block, size);
}

__attribute__((destructor)) static void tell(void)
{
    char text[32];
    const char *to = getenv("FAIL_COUNT");
    if (to == NULL) return;
    snprintf(text, sizeof text, "%ld\n", count ? *count : 0);
    if (write(atoi(to), text, strlen(text)) < 0) _exit(1);
}
