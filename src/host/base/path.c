#define _XOPEN_SOURCE 700

#include "host/base/path.h"

#include <errno.h>
#include <limits.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

#include "host/base/memory.h"

#ifndef PATH_MAX
#define PATH_MAX 4096
#endif

bool hci_path_is_same(const char *a, const char *b)
{
    struct stat x, y;
    return stat(a, &x) == 0 && stat(b, &y) == 0 && x.st_dev == y.st_dev && x.st_ino == y.st_ino;
}

/* Length of the folders at the beginning of both, with the slash behind them. */
static size_t common_length(const char *file, const char *folder)
{
    size_t common = 0;
    for (size_t k = 0;; ++k) {
        const char a = file[k], b = folder[k];
        if ((a == '/' || a == '\0') && (b == '/' || b == '\0')) common = k + 1;
        if (a != b || a == '\0') return common;
    }
}

/* Both absolute, without links. */
static char *relative_of(const char *file, const char *folder)
{
    const size_t common = common_length(file, folder), length = strlen(folder);
    const char *rest = file + common;
    size_t up = common < length;
    for (size_t k = common; k < length; ++k)
        up += folder[k] == '/';
    char *relative = hci_memory_malloc(3 * up + strlen(rest) + 1);
    if (relative == NULL) return NULL;
    for (size_t k = 0; k < up; ++k)
        memcpy(relative + 3 * k, "../", 3);
    memcpy(relative + 3 * up, rest, strlen(rest) + 1);
    return relative;
}

hci_status hci_path_relative(const char *file, const char *folder, char **relative, hci_note *note)
{
    char from[PATH_MAX], to[PATH_MAX];
    *relative = NULL;
    if (!realpath(folder, from))
        return hci_note_set(note, HCI_ERROR_INPUT, "%.300s: %s", folder, strerror(errno));
    if (!realpath(file, to)) return hci_note_set(note, HCI_ERROR_INPUT, "%.300s: %s", file, strerror(errno));
    *relative = relative_of(to, from);
    return *relative ? HCI_OK : hci_note_memory(note, file, "its path");
}
