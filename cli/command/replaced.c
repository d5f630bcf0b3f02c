#define _XOPEN_SOURCE 700
#include "cli/command/replaced.h"

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

/* ---- in its place ---- */

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
    mend(plain, name);
    if (!is_folder(plain) || !summary_of(plain, &summary)) return HCI_OK;
    const hci_status status = check_unchanged(plain, &summary, note);
    if (!status && rename(plain, name) == 0) snprintf(aside, CLI_REPLACED_PATH, "%s", name);
    return status;
}

void cli_replaced_settle(const char *folder, const char *aside, bool is_written)
{
    char plain[CLI_REPLACED_PATH], name[CLI_REPLACED_PATH];
    if (aside[0] == '\0') return;
    if (is_written) {
        delete_all(aside);
    } else if (aside_of(folder, plain, name)) {
        delete_all(plain);
        (void)rename(aside, plain);
    }
}
