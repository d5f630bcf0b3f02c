#define _XOPEN_SOURCE 700

#include "host/base/folder.h"

#include <errno.h>
#include <ftw.h>
#include <stdio.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

static bool is_folder(const char *path)
{
    struct stat status;
    return stat(path, &status) == 0 && S_ISDIR(status.st_mode);
}

/* Length of the parent part of the first `length` bytes of a path, 0 for none: "a/b//" → "a". */
static size_t parent_length(const char *path, size_t length)
{
    while (length > 0 && path[length - 1] == '/')
        length--;
    while (length > 0 && path[length - 1] != '/')
        length--;
    while (length > 1 && path[length - 1] == '/')
        length--;
    return length;
}

/* Does something at the first `length` bytes of the path, which is restored. */
static int at_prefix(char *path, size_t length, int (*action)(const char *))
{
    const char cut = path[length];
    path[length] = '\0';
    const int result = action(path);
    path[length] = cut;
    return result;
}

static int make_folder(const char *path)
{
    return mkdir(path, 0777) == 0 || (errno == EEXIST && is_folder(path)) ? 0 : -1;
}

static int test_folder(const char *path)
{
    return is_folder(path) ? 0 : -1;
}

void hci_folder_remove(char *folder, size_t existing)
{
    size_t length = strlen(folder);
    for (; length > existing; length = parent_length(folder, length))
        (void)at_prefix(folder, length, rmdir);
}

bool hci_folder_make(char *folder, size_t *existing)
{
    const size_t whole = strlen(folder);
    size_t length = whole;
    while (length > 0 && at_prefix(folder, length, test_folder) != 0)
        length = parent_length(folder, length);
    *existing = length;
    while (length < whole) {
        length += strspn(folder + length, "/");
        length += strcspn(folder + length, "/");
        if (at_prefix(folder, length, make_folder) == 0) continue;
        const int error = errno;
        hci_folder_remove(folder, *existing);
        errno = error;
        return false;
    }
    return true;
}

enum { MOST_OPEN = 16 };

static int delete_one(const char *path, const struct stat *info, int kind, struct FTW *place)
{
    (void)info, (void)kind, (void)place;
    return remove(path);
}

bool hci_folder_delete(const char *folder)
{
    return nftw(folder, delete_one, MOST_OPEN, FTW_DEPTH | FTW_PHYS) == 0 || errno == ENOENT;
}
