/* The folder of a machine: that it is there, its files, and which machine they are. */
#define _POSIX_C_SOURCE 200809L

#include "host/machine/folder.h"

#include <errno.h>
#include <stdio.h>
#include <string.h>
#include <sys/stat.h>

#include "host/base/digest.h"

enum { PATH_SIZE = 4096 };

const char *const hci_machine_files[HCI_MACHINE_FILES] = {"machine.csv", "back_emf.csv", "cogging.csv",
                                                          "inductance.csv", "effects.csv"};

bool hci_machine_has(const char *path)
{
    struct stat info;
    return stat(path, &info) == 0 || errno != ENOENT;
}

hci_status hci_machine_path(char *path, size_t size, const char *folder, const char *file, hci_note *note)
{
    const int length = snprintf(path, size, "%s/%s", folder, file);
    if (length > 0 && (size_t)length < size) return HCI_OK;
    return hci_note_set(note, HCI_ERROR_INPUT, "%.200s…: the path is longer than %zu bytes", folder,
                        size - 1);
}

hci_status hci_machine_check_folder(const char *folder, hci_note *note)
{
    struct stat info;
    if (stat(folder, &info) != 0)
        return hci_note_set(note, HCI_ERROR_INPUT,
                            "%.300s: %s; expected the folder of a machine with machine.csv and back_emf.csv",
                            folder, strerror(errno));
    if (S_ISDIR(info.st_mode)) return HCI_OK;
    return hci_note_set(
        note, HCI_ERROR_INPUT,
        "%.300s: found a file, expected the folder of a machine with machine.csv and back_emf.csv", folder);
}

/* ---- which machine it is ---- */

/* The last part of a path, without slashes at its end. */
static void take_name(const char *path, char *name, size_t size)
{
    size_t end = strlen(path), begin;
    while (end > 1 && path[end - 1] == '/')
        --end;
    for (begin = end; begin > 0 && path[begin - 1] != '/'; --begin)
        continue;
    snprintf(name, size, "%.*s", (int)(end - begin), path + begin);
}

/* A file that is not there counts by its name alone. */
void hci_machine_identify(const char *folder, hci_machine_identity *identity)
{
    uint64_t sum = HCI_DIGEST_START;
    for (size_t k = 0; k < HCI_MACHINE_FILES; ++k) {
        char path[PATH_SIZE];
        hci_note ignored = {{0}};
        sum = hci_digest_next(sum, hci_machine_files[k], strlen(hci_machine_files[k]));
        if (hci_machine_path(path, sizeof path, folder, hci_machine_files[k], &ignored) == HCI_OK)
            hci_digest_file(path, &sum);
    }
    take_name(folder, identity->name, sizeof identity->name);
    snprintf(identity->digest, sizeof identity->digest, "%016llx", (unsigned long long)sum);
}
