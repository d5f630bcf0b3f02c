/* The folder of a machine: that it is there, its files, and which machine they are. */
#define _POSIX_C_SOURCE 200809L

#include "host/machine/folder.h"

#include <errno.h>
#include <stdio.h>
#include <string.h>
#include <sys/stat.h>

#include "host/base/digest.h"
#include "host/base/path.h"

enum { PATH_SIZE = 4096 };

const char *const hci_machine_files[HCI_MACHINE_FILES] = {"machine.csv", "back_emf.csv", "cogging.csv",
                                                          "inductance.csv", "effects.csv"};

bool hci_machine_has(const char *path)
{
    struct stat info;
    return hci_unread_stat(path, &info) || errno != ENOENT;
}

hci_status hci_machine_path(char *path, size_t size, const char *folder, const char *file, hci_note *note)
{
    const int length = snprintf(path, size, "%s/%s", folder, file);
    if (length > 0 && (size_t)length < size) return HCI_OK;
    return hci_note_set(note, HCI_ERROR_INPUT, "%.200s…: the path is longer than %zu bytes", folder,
                        size - 1);
}

/* ---- whether it is one ---- */

static hci_status check_is_folder(const char *folder, hci_note *note)
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

/* A folder without machine.csv: what it is, and what to do. */
static hci_status no_machine(const char *folder, const char *path, hci_note *note)
{
    char inner[PATH_SIZE];
    hci_status status = hci_machine_path(inner, PATH_SIZE, folder, "machine/machine.csv", note);
    if (status) return status;
    if (hci_machine_has(inner))
        return hci_note_set(note, HCI_ERROR_INPUT,
                            "%.300s: No such file; the machine is in the folder below: give %.300s/machine",
                            path, folder);
    return hci_note_set(
        note, HCI_ERROR_INPUT,
        "%.300s: No such file; expected the folder of a machine with machine.csv and back_emf.csv: give "
        "that folder, or make a first one with hci-solve init",
        path);
}

hci_status hci_machine_check_folder(const char *folder, hci_note *note)
{
    char path[PATH_SIZE];
    hci_status status = check_is_folder(folder, note);
    if (!status) status = hci_machine_path(path, PATH_SIZE, folder, "machine.csv", note);
    if (!status && !hci_machine_has(path)) return no_machine(folder, path, note);
    if (!status) status = hci_machine_path(path, PATH_SIZE, folder, "back_emf.csv", note);
    if (status || hci_machine_has(path)) return status;
    return hci_note_set(note, HCI_ERROR_INPUT,
                        "%.300s: No such file; expected the orders of the back-EMF; hci-solve init writes it "
                        "from a data sheet, hci-solve harmonics --quantity back_emf from a recording",
                        path);
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

/* Rounded, so that the same machine in other units is the same. */
static uint64_t add_number(uint64_t sum, double value)
{
    char text[32];
    snprintf(text, sizeof text, "%.9g ", value);
    return hci_digest_next(sum, text, strlen(text));
}

static uint64_t add_numbers(uint64_t sum, const double *value, size_t count)
{
    for (size_t k = 0; k < count; ++k)
        sum = add_number(sum, value[k]);
    return sum;
}

static uint64_t add_tables(uint64_t sum, const hci_machine *m)
{
    for (size_t k = 0; k < m->back_emf_count; ++k) {
        const hci_wave *w = &m->back_emf[k];
        sum = add_numbers(sum, (double[]){w->order, w->sequence, w->sine, w->cosine}, 4);
    }
    sum = hci_digest_next(sum, "; ", 2);
    for (size_t k = 0; k < m->cogging_count; ++k)
        sum = add_numbers(sum, (double[]){m->cogging[k].order, m->cogging[k].sine, m->cogging[k].cosine}, 3);
    sum = hci_digest_next(sum, "; ", 2);
    for (size_t k = 0; k < m->slope_count; ++k) {
        sum = add_number(sum, m->slope[k].order);
        sum = add_numbers(sum, m->slope[k].sine, HCI_PHASE_MATRIX);
        sum = add_numbers(sum, m->slope[k].cosine, HCI_PHASE_MATRIX);
    }
    return sum;
}

void hci_machine_identify(const char *folder, hci_machine_data *machine)
{
    char path[PATH_SIZE];
    hci_note ignored = {{0}};
    uint64_t sum = add_number(HCI_DIGEST_START, machine->model.pole_pairs);
    sum = add_number(sum, machine->has_neutral);
    sum = add_tables(sum, &machine->model);
    take_name(folder, machine->identity.name, sizeof machine->identity.name);
    if (machine->has_effects && (hci_machine_path(path, sizeof path, folder, "effects.csv", &ignored) ||
                                 !hci_digest_file(path, &sum)))
        return;
    snprintf(machine->identity.digest, sizeof machine->identity.digest, "%016llx", (unsigned long long)sum);
}
