#define _XOPEN_SOURCE 700

#include "host/base/path.h"

#include <dirent.h>
#include <errno.h>
#include <limits.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

#include "hci/host/base/spelling.h"
#include "host/base/memory.h"
#include "host/base/quote.h"

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

/* ---- a file that is not there ---- */

/* The files of a folder, up to so many, among which a similar name is looked for. */
enum { MOST_NAMES = 512 };

static const char *nearest_in(DIR *folder, const char *name, char *near, size_t size)
{
    char *names[MOST_NAMES + 1] = {NULL};
    size_t count = 0;
    for (struct dirent *e = readdir(folder); e != NULL && count < MOST_NAMES; e = readdir(folder)) {
        const size_t length = strlen(e->d_name) + 1;
        if (e->d_name[0] == '.' || (names[count] = hci_memory_malloc(length)) == NULL) continue;
        memcpy(names[count++], e->d_name, length);
    }
    const char *found = hci_nearest(name, (const char *const *)names);
    if (found != NULL) snprintf(near, size, "%s", found);
    for (size_t k = 0; k < count; ++k)
        hci_memory_free(names[k]);
    return found != NULL ? near : NULL;
}

/* "; did you mean `run1.csv`?" */
static hci_status missing_file(const char *file, hci_note *note)
{
    char folder[PATH_MAX] = ".", near[256];
    const char *slash = strrchr(file, '/'), *name = slash != NULL ? slash + 1 : file;
    if (errno == ENOENT && strpbrk(file, "*?[") != NULL)
        return hci_note_set(note, HCI_ERROR_INPUT,
                            "%.300s: found no file of that pattern; give the names of files that are there",
                            file);
    if (errno != ENOENT) return hci_note_set(note, HCI_ERROR_INPUT, "%.300s: %s", file, strerror(errno));
    if (slash != NULL && (size_t)(slash - file) < sizeof folder)
        snprintf(folder, sizeof folder, "%.*s", (int)(slash - file) + 1, file);
    DIR *open = opendir(folder);
    const char *found = open != NULL ? nearest_in(open, name, near, sizeof near) : NULL;
    if (open != NULL) closedir(open);
    return hci_note_set(note, HCI_ERROR_INPUT, "%.300s: No such file; %s%.*s%.255s%s", file,
                        found != NULL  ? "did you mean `"
                        : open == NULL ? "its folder is not there either: give the path of a file"
                                       : "give the path of a file that is there",
                        found != NULL && slash != NULL ? (int)(slash - file) + 1 : 0, file,
                        found != NULL ? found : "", found != NULL ? "`?" : "");
}

hci_status hci_path_relative(const char *file, const char *folder, char **relative, hci_note *note)
{
    char from[PATH_MAX], to[PATH_MAX];
    *relative = NULL;
    if (!realpath(folder, from))
        return hci_note_set(note, HCI_ERROR_INPUT, "%.300s: %s", folder, strerror(errno));
    if (!realpath(file, to)) return missing_file(file, note);
    *relative = relative_of(to, from);
    return *relative ? HCI_OK : hci_note_memory(note, file, "its path");
}

/* ---- files that are there and cannot be read ---- */

static char unread_path[HCI_QUOTE_PATH_SIZE];
static int unread_error;

static bool is_nothing(int error)
{
    return error == ENOENT || error == ENOTDIR || error == ENAMETOOLONG || error == ELOOP;
}

void hci_unread_keep(const char *path)
{
    const int error = errno;
    if (error == ENOMEM) hci_memory_is_short();
    if (error == ENOMEM || is_nothing(error) || unread_error) return;
    unread_error = error;
    hci_quote_path(path, unread_path);
}

bool hci_unread_stat(const char *path, struct stat *info)
{
    if (stat(path, info) == 0) return true;
    hci_unread_keep(path);
    return false;
}

hci_status hci_unread_check(hci_note *note)
{
    const int error = unread_error;
    unread_error = 0;
    if (!error) return HCI_OK;
    return hci_note_set(note, HCI_ERROR_INPUT, "%s: cannot be read: %s; mend that, and call again",
                        unread_path, strerror(error));
}
