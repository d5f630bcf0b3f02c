#define _POSIX_C_SOURCE 200809L

#include "host/currents/own_files.h"

#include <dirent.h>
#include <errno.h>
#include <stdio.h>
#include <string.h>
#include <sys/stat.h>

#include "host/base/checksum.h"
#include "host/base/json.h"
#include "host/base/memory.h"
#include "host/base/path.h"
#include "host/base/quote.h"
#include "host/base/whole_file.h"

#define SUMMARY "summary.json"

enum { PATH_SIZE = 4096 + 32 };

/* ---- a file ---- */

static const char *name_of(const char *path)
{
    const char *slash = strrchr(path, '/');
    return slash ? slash + 1 : path;
}

/* is_needed: a file that cannot be read is an error. */
static hci_status compare(const char *path, const char *wanted, bool is_needed, const char *remedy,
                          hci_note *note)
{
    char found[HCI_CHECKSUM_SIZE], shown[HCI_QUOTE_PATH_SIZE];
    if (!hci_checksum_file(path, found)) {
        if (errno == ENOMEM) return hci_note_memory(note, path, "reading it");
        if (!is_needed) return hci_unread_keep(path), HCI_OK;
        return hci_note_set(note, HCI_ERROR_INPUT,
                            "%s: cannot be read (%s), expected the file that " SUMMARY " beside it names; %s",
                            hci_quote_path(path, shown), strerror(errno), remedy);
    }
    if (strcmp(wanted, found) == 0) return HCI_OK;
    return hci_note_set(note, HCI_ERROR_INPUT,
                        "%s: found a file with the checksum %s, expected %s, as " SUMMARY
                        " beside it says: it was edited, or is of another run; %s",
                        hci_quote_path(path, shown), found, wanted, remedy);
}

hci_status hci_own_file_check(const char *summary, const char *path, const char *remedy, hci_note *note)
{
    char wanted[HCI_CHECKSUM_SIZE];
    if (!hci_json_find_text(summary, "checksums", name_of(path), wanted, sizeof wanted)) return HCI_OK;
    return compare(path, wanted, false, remedy, note);
}

static hci_status path_in(const char *folder, const char *name, char path[PATH_SIZE], hci_note *note)
{
    const int length = snprintf(path, PATH_SIZE, "%s/%s", folder, name);
    if (length >= 0 && length < PATH_SIZE) return HCI_OK;
    return hci_note_set(note, HCI_ERROR_INPUT, "%.200s…: the path is too long", folder);
}

hci_status hci_own_file_check_beside(const char *path, const char *remedy, hci_note *note)
{
    char summary[PATH_SIZE];
    const int length = snprintf(summary, sizeof summary, "%.*s" SUMMARY, (int)(name_of(path) - path), path);
    struct stat info;
    if (length >= PATH_SIZE || !hci_unread_stat(summary, &info)) return HCI_OK;
    char *text = hci_whole_file(summary);
    if (!text) return hci_memory_was_short() ? hci_note_memory(note, summary, "reading it") : HCI_OK;
    const hci_status status = hci_own_file_check(text, path, remedy, note);
    hci_memory_free(text);
    return status;
}

/* ---- a folder ---- */

typedef struct {
    const char *folder, *remedy;
    hci_status status;
    hci_note *note;
} check;

static bool check_one(void *context, const char *name, const char *wanted)
{
    check *c = context;
    char path[PATH_SIZE];
    c->status = path_in(c->folder, name, path, c->note);
    if (!c->status) c->status = compare(path, wanted, true, c->remedy, c->note);
    return c->status == HCI_OK;
}

static hci_status without_summary(const char *path, const char *remedy, hci_note *note)
{
    char shown[HCI_QUOTE_PATH_SIZE];
    if (hci_memory_was_short()) return hci_note_memory(note, path, "reading it");
    const hci_status status = hci_unread_check(note);
    if (status) return status;
    return hci_note_set(note, HCI_ERROR_INPUT,
                        "%s: found none with the checksums of the files beside it, expected the one that was "
                        "written with them; %s",
                        hci_quote_path(path, shown), remedy);
}

/* is_needed: the folder is to have a summary. */
static hci_status check_files(const char *folder, bool is_needed, const char *remedy, hci_note *note)
{
    char path[PATH_SIZE];
    struct stat info;
    check c = {folder, remedy, HCI_OK, note};
    hci_status status = path_in(folder, SUMMARY, path, note);
    if (status || (!is_needed && !hci_unread_stat(path, &info))) return status;
    char *text = hci_whole_file(path);
    if (!text || !hci_json_each_text(text, "checksums", check_one, &c))
        status = without_summary(path, remedy, note);
    hci_memory_free(text);
    return status ? status : c.status;
}

static hci_status check_within(const char *folder, const char *remedy, hci_note *note);

static hci_status check_entry(const char *folder, const char *name, const char *remedy, hci_note *note)
{
    char path[PATH_SIZE];
    struct stat info;
    if (name[0] == '.') return HCI_OK;
    hci_status status = path_in(folder, name, path, note);
    if (status || lstat(path, &info) != 0 || !S_ISDIR(info.st_mode)) return status;
    status = check_files(path, false, remedy, note);
    return status ? status : check_within(path, remedy, note);
}

/* A link to a folder is not followed, so that this ends. */
static hci_status check_within(const char *folder, const char *remedy, hci_note *note)
{
    hci_status status = HCI_OK;
    DIR *open = opendir(folder);
    if (!open) {
        if (errno == ENOMEM) return hci_note_memory(note, folder, "reading it");
        return hci_note_set(note, HCI_ERROR_INPUT, "%.300s: cannot be read: %s; %s", folder, strerror(errno),
                            remedy);
    }
    for (const struct dirent *entry; !status && (errno = 0, entry = readdir(open)) != NULL;)
        status = check_entry(folder, entry->d_name, remedy, note);
    if (!status && errno) hci_unread_keep(folder);
    closedir(open);
    return status;
}

hci_status hci_own_folder_check(const char *folder, const char *remedy, hci_note *note)
{
    (void)hci_memory_was_short(); /* from here on */
    const hci_status status = check_files(folder, true, remedy, note);
    return status ? status : check_within(folder, remedy, note);
}
