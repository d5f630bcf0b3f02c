#include "host/base/memory.h"

#include <stdbool.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

/* Negative: no limit. Written only while a test has set a limit. */
static long remaining = -1;
static bool only_one_fails;

/* An allocation has failed since it was last asked for. Written when one fails: as the state of the sparse
 * solver, not safe for threads. */
static bool short_of_memory;

void hci_memory_fail_after(long count)
{
    remaining = count;
    only_one_fails = short_of_memory = false;
}

void hci_memory_fail_once_after(long count)
{
    hci_memory_fail_after(count);
    only_one_fails = true;
}

bool hci_memory_was_short(void)
{
    const bool was = short_of_memory;
    short_of_memory = false;
    return was;
}

void hci_memory_is_short(void)
{
    short_of_memory = true;
}

static void *noted(void *block)
{
    if (block == NULL) hci_memory_is_short();
    return block;
}

static bool refused(void)
{
    if (remaining < 0) return false;
    if (remaining > 0) return remaining--, false;
    if (only_one_fails) remaining = -1;
    return true;
}

static bool overflows(size_t count, size_t size)
{
    return size > 0 && count > SIZE_MAX / size;
}

/* malloc(0) and realloc(p, 0) may give NULL, which would look like a failure. */
static size_t at_least_one(size_t size)
{
    return size > 0 ? size : 1;
}

void *hci_memory_new(size_t count, size_t size)
{
    if (refused() || overflows(count, size)) return noted(NULL);
    return noted(calloc(at_least_one(count), at_least_one(size)));
}

void *hci_memory_malloc(size_t size)
{
    return noted(refused() ? NULL : malloc(at_least_one(size)));
}

void *hci_memory_realloc(void *block, size_t size)
{
    return noted(refused() ? NULL : realloc(block, at_least_one(size)));
}

void *hci_memory_resize(void *block, size_t count, size_t size)
{
    if (overflows(count, size)) return noted(NULL);
    return hci_memory_realloc(block, count * size);
}

void hci_memory_free(void *block)
{
    free(block);
}

char *hci_memory_text_part(const char *text, size_t length)
{
    char *copy = hci_memory_malloc(length + 1);
    if (copy == NULL) return NULL;
    memcpy(copy, text, length);
    copy[length] = '\0';
    return copy;
}

char *hci_memory_text(const char *text)
{
    return hci_memory_text_part(text, strlen(text));
}
