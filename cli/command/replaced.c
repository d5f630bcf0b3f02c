#define _XOPEN_SOURCE 700
#include "cli/command/replaced.h"

#include <errno.h>
#include <fcntl.h>
#include <ftw.h>
#include <stdio.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

/* ---- what is in it ---- */

enum { MOST_OPEN = 16 };

static struct timespec written_at; /* of the summary, which is written last */
static char changed[CLI_REPLACED_PATH];

static int find_changed(const char *path, const struct stat *info, int kind, struct FTW *place)
{
    const struct timespec *at = &info->st_mtim;
    (void)place;
    const bool is_later = at->tv_sec > written_at.tv_sec + 1;
    if (kind != FTW_F || !is_later) return 0;
    snprintf(changed, sizeof changed, "%s", path);
    return 1;
}

/* Something that is younger than the results is somebody's work on them. */
static hci_status check_unchanged(const char *folder, const struct stat *summary, hci_note *note)
{
    written_at = summary->st_mtim;
    changed[0] = '\0';
    nftw(folder, find_changed, MOST_OPEN, FTW_PHYS);
    if (changed[0] == '\0') return HCI_OK;
    return hci_note_set(
        note, HCI_ERROR_ARGUMENT,
        "%s was changed since the results were written, and would be lost; give --out another "
        "folder, or move that file away",
        changed);
}

static int delete_one(const char *path, const struct stat *info, int kind, struct FTW *place)
{
    (void)info, (void)kind, (void)place;
    return remove(path);
}

static void delete_all(const char *folder)
{
    nftw(folder, delete_one, MOST_OPEN, FTW_DEPTH | FTW_PHYS);
}

/* ---- names ---- */

/* "way/.name.before" of "way/name/"; false: a folder without a name of its own. */
static bool aside_of(const char *folder, char plain[CLI_REPLACED_PATH], char aside[CLI_REPLACED_PATH])
{
    size_t length = strlen(folder);
    if (length + 16 >= CLI_REPLACED_PATH) return false;
    while (length > 1 && folder[length - 1] == '/')
        --length;
    memcpy(plain, folder, length);
    plain[length] = '\0';
    const char *slash = strrchr(plain, '/'), *name = slash ? slash + 1 : plain;
    if (*name == '\0' || strcmp(name, ".") == 0 || strcmp(name, "..") == 0) return false;
    const size_t way = (size_t)(name - plain);
    memcpy(aside, plain, way);
    snprintf(aside + way, CLI_REPLACED_PATH - way, ".%s.before", name);
    return true;
}

/* ---- one call at a time ---- */

static struct {
    int descriptor; /* with the lock; 0: none */
    char path[CLI_REPLACED_PATH];
} lock;

/* Whether the file is still that of the path: who had the lock before takes it away. */
static bool is_current(int descriptor, const char *path)
{
    struct stat mine, there;
    return fstat(descriptor, &mine) == 0 && lstat(path, &there) == 0 && mine.st_ino == there.st_ino &&
           mine.st_dev == there.st_dev;
}

/* Locks "way/.name.lock". False: another call has it. Where none can be made there is none. */
static bool lock_take(const char *aside)
{
    struct flock whole = {.l_type = F_WRLCK, .l_whence = SEEK_SET};
    snprintf(lock.path, sizeof lock.path, "%.*s.lock", (int)(strrchr(aside, '.') - aside), aside);
    for (;;) {
        const int descriptor = open(lock.path, O_RDWR | O_CREAT | O_NOFOLLOW | O_CLOEXEC, 0666);
        if (descriptor < 0) return true;
        const bool got = fcntl(descriptor, F_SETLK, &whole) == 0;
        const bool kept = !got && (errno == EACCES || errno == EAGAIN);
        if (got && is_current(descriptor, lock.path)) {
            lock.descriptor = descriptor;
            return true;
        }
        close(descriptor);
        if (!got) return !kept;
    }
}

static void lock_release(void)
{
    if (lock.descriptor <= 0) return;
    unlink(lock.path);
    close(lock.descriptor);
    lock.descriptor = 0;
}

/* ---- in its place ---- */

static bool summary_of(const char *folder, struct stat *summary)
{
    char path[CLI_REPLACED_PATH + 16];
    snprintf(path, sizeof path, "%s/summary.json", folder);
    return lstat(path, summary) == 0 && S_ISREG(summary->st_mode);
}

static bool is_folder(const char *path)
{
    struct stat info;
    return lstat(path, &info) == 0 && S_ISDIR(info.st_mode);
}

/* What a call left that was killed: the earlier results are put back where the new ones have no end. */
static void mend(const char *folder, const char *aside)
{
    struct stat summary;
    if (!is_folder(aside) || !summary_of(aside, &summary)) return;
    if (!summary_of(folder, &summary)) {
        delete_all(folder);
        (void)rename(aside, folder);
    } else {
        delete_all(aside);
    }
}

hci_status cli_replaced_set_aside(const char *folder, char aside[CLI_REPLACED_PATH], hci_note *note)
{
    char plain[CLI_REPLACED_PATH], name[CLI_REPLACED_PATH];
    struct stat summary;
    aside[0] = '\0';
    if (!aside_of(folder, plain, name)) return HCI_OK;
    if (!lock_take(name))
        return hci_note_set(
            note, HCI_ERROR_OUTPUT,
            "%s: another process is writing into it; wait until it has ended, or name another "
            "folder",
            plain);
    mend(plain, name);
    if (!is_folder(plain) || !summary_of(plain, &summary)) return HCI_OK;
    const hci_status status = check_unchanged(plain, &summary, note);
    if (!status && rename(plain, name) == 0) snprintf(aside, CLI_REPLACED_PATH, "%s", name);
    return status;
}

void cli_replaced_settle(const char *folder, const char *aside, bool is_written)
{
    char plain[CLI_REPLACED_PATH], name[CLI_REPLACED_PATH];
    if (aside[0] != '\0' && is_written) {
        delete_all(aside);
    } else if (aside[0] != '\0' && aside_of(folder, plain, name)) {
        delete_all(plain);
        (void)rename(aside, plain);
    }
    lock_release();
}
