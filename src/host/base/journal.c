#define _POSIX_C_SOURCE 200809L

#include "host/base/journal.h"

#include <errno.h>
#include <fcntl.h>
#include <limits.h>
#include <stdio.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "host/base/sync.h"

#ifndef PATH_MAX
#define PATH_MAX 4096
#endif

static const char JOURNAL[] = ".hci-journal", DRAFT[] = ".hci-journal.tmp";

enum { PATH_SIZE = PATH_MAX + 1, LINE_SIZE = 1024 };

static bool path_of(const char *folder, const char *name, char path[PATH_SIZE])
{
    const int length = snprintf(path, PATH_SIZE, "%s/%s", folder, name);
    const bool fits = length > 0 && length < PATH_SIZE;
    if (!fits) errno = ENAMETOOLONG;
    return fits;
}

/* ---- writing ---- */

/* A new file, in the place of what a killed process has left; a link there is not followed. */
FILE *hci_journal_open(const char *folder)
{
    char draft[PATH_SIZE];
    if (!path_of(folder, DRAFT, draft)) return NULL;
    unlink(draft);
    const int descriptor = open(draft, O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
    FILE *stream = descriptor < 0 ? NULL : fdopen(descriptor, "w");
    if (descriptor < 0 || stream != NULL) return stream;
    close(descriptor);
    unlink(draft);
    errno = ENOMEM;
    return NULL;
}

/* A line each: what is done, and the three names between tabs. */
void hci_journal_step(FILE *journal, bool is_removed, const char *temporary, const char *backup,
                      const char *target)
{
    fprintf(journal, "%s\t%s\t%s\t%s\n", is_removed ? "remove" : "rename", temporary, backup, target);
}

static bool is_written(FILE *journal)
{
    const bool good = hci_sync_stream(journal) && !ferror(journal);
    return fclose(journal) == 0 && good;
}

bool hci_journal_begin(const char *folder, FILE *journal)
{
    char draft[PATH_SIZE], path[PATH_SIZE];
    const bool named = path_of(folder, DRAFT, draft) && path_of(folder, JOURNAL, path);
    if (is_written(journal) && named && rename(draft, path) == 0 && hci_sync_folder(folder)) return true;
    const int error = errno;
    if (named) unlink(draft);
    if (named) unlink(path);
    errno = error;
    return false;
}

void hci_journal_end(const char *folder)
{
    char path[PATH_SIZE];
    if (path_of(folder, JOURNAL, path)) unlink(path);
}

/* ---- ending what another has begun ---- */

static bool take_away(const char *folder, const char *name)
{
    char path[PATH_SIZE];
    return path_of(folder, name, path) && (unlink(path) == 0 || errno == ENOENT);
}

/* A step that was done already has no temporary file any more. */
static bool rename_again(const char *folder, const char *temporary, const char *target)
{
    char from[PATH_SIZE], to[PATH_SIZE];
    return path_of(folder, temporary, from) && path_of(folder, target, to) &&
           (rename(from, to) == 0 || errno == ENOENT);
}

/* Behind the name of a folder within this one, of `length` bytes with its slash; NULL: it is not there. */
static const char *name_within(const char *path, const char *folder, size_t length)
{
    const bool is_there = strncmp(path, folder, length) == 0 && strchr(path + length, '/') == NULL;
    return is_there ? path + length : NULL;
}

/* A folder within this one, and no link that leads elsewhere. length: of its name. */
static bool is_within(const char *folder, const char *name, size_t length)
{
    char path[PATH_SIZE];
    struct stat status;
    if (!path_of(folder, name, path)) return false;
    path[strlen(folder) + 1 + length] = '\0';
    return *name != '.' && length > 0 && lstat(path, &status) == 0 && S_ISDIR(status.st_mode);
}

/* Only hidden files of ours are renamed, in this folder or in one within it, where they are. */
static bool is_ours(const char *folder, char *const field[4])
{
    const char *slash = strchr(field[3], '/');
    const size_t length = slash != NULL ? (size_t)(slash - field[3]) + 1 : 0;
    const char *name[3];
    if (slash != NULL && !is_within(folder, field[3], length - 1)) return false;
    for (int k = 0; k < 3; ++k)
        name[k] = name_within(field[k + 1], field[3], length);
    return name[0] != NULL && name[1] != NULL && name[2] != NULL && strncmp(name[0], ".hci-", 5) == 0 &&
           strncmp(name[1], ".hci-", 5) == 0 && *name[2] != '\0';
}

static bool do_step(const char *folder, char *line)
{
    char *field[4];
    line[strcspn(line, "\n")] = '\0';
    for (int k = 0; k < 4; ++k) {
        field[k] = line;
        line += strcspn(line, "\t");
        if (*line != '\0') *line++ = '\0';
    }
    if (!is_ours(folder, field)) return errno = EINVAL, false;
    const bool done = strcmp(field[0], "remove") == 0
                          ? take_away(folder, field[3]) && take_away(folder, field[1])
                          : rename_again(folder, field[1], field[3]);
    return done && take_away(folder, field[2]);
}

bool hci_journal_exists(const char *folder)
{
    char path[PATH_SIZE];
    struct stat status;
    return path_of(folder, JOURNAL, path) && lstat(path, &status) == 0;
}

/* Neither a pipe, which would be waited for, nor a link is ours. */
static FILE *open_plain(const char *path)
{
    struct stat status;
    const int descriptor = open(path, O_RDONLY | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC);
    FILE *stream = NULL;
    if (descriptor < 0) return NULL;
    if (fstat(descriptor, &status) == 0 && S_ISREG(status.st_mode))
        stream = fdopen(descriptor, "r");
    else
        errno = EINVAL;
    const int error = errno;
    if (stream == NULL) close(descriptor);
    errno = error;
    return stream;
}

bool hci_journal_finish(const char *folder)
{
    char path[PATH_SIZE], line[LINE_SIZE];
    bool good = path_of(folder, JOURNAL, path);
    FILE *stream = good ? open_plain(path) : NULL;
    if (stream == NULL) return good && errno == ENOENT;
    while (good && fgets(line, sizeof line, stream) != NULL)
        good = do_step(folder, line);
    fclose(stream);
    return good && hci_sync_folder(folder) && unlink(path) == 0;
}
