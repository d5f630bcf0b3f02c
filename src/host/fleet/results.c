#define _POSIX_C_SOURCE 200809L

#include "hci/host/fleet/results.h"

#include <errno.h>
#include <stdio.h>
#include <string.h>

#include "hci/host/base/output.h"
#include "host/base/digest.h"
#include "host/base/folder.h"
#include "host/base/folder_lock.h"
#include "host/base/memory.h"
#include "host/base/sync.h"
#include "host/base/whole_file.h"
#include "host/currents/own_files.h"
#include "host/fleet/row.h"

#define MOTORS "motors"
#define ROW    "motor.csv"

#define DONE_AGAIN "this motor is done again"

enum { PATH_SIZE = 4096, WAIT_MS = 10000 };

hci_fleet_digest hci_fleet_digest_of(const char *version, const char *const *words)
{
    hci_fleet_digest digest;
    uint64_t sum = hci_digest_next(HCI_DIGEST_START, version, strlen(version) + 1);
    for (; *words; ++words)
        sum = hci_digest_next(sum, *words, strlen(*words) + 1);
    snprintf(digest.text, sizeof digest.text, "%016llx", (unsigned long long)sum);
    return digest;
}

/* ---- paths ---- */

static hci_status path_of(const hci_fleet_results *r, size_t motor, const char *format, char path[PATH_SIZE],
                          hci_note *note)
{
    const char *name = hci_fleet_cell(r->list, motor, "motor");
    const int length = snprintf(path, PATH_SIZE, "%s/" MOTORS "/", r->folder);
    if (length < 0 || length + (int)strlen(name) + 16 >= PATH_SIZE)
        return hci_note_set(note, HCI_ERROR_OUTPUT, "%.200s…: the path is too long", r->folder);
    sprintf(path + length, strcmp(format, "part") == 0 ? ".%s.part" : "%s", name);
    return HCI_OK;
}

hci_status hci_fleet_part(const hci_fleet_results *results, size_t motor, char *part, size_t size,
                          hci_note *note)
{
    char path[PATH_SIZE];
    const hci_status status = path_of(results, motor, "part", path, note);
    if (status) return status;
    if (strlen(path) >= size)
        return hci_note_set(note, HCI_ERROR_OUTPUT, "%.200s…: the path is too long", results->folder);
    strcpy(part, path);
    return HCI_OK;
}

static hci_status refused(const char *path, const char *what, hci_note *note)
{
    if (errno == ENOMEM) return hci_note_memory(note, path, "the folder");
    return hci_note_set(note, HCI_ERROR_OUTPUT, "%.300s: %s: %s", path, what, strerror(errno));
}

/* ---- a motor ---- */

hci_status hci_fleet_begin(const hci_fleet_results *results, size_t motor, hci_note *note)
{
    char part[PATH_SIZE];
    const hci_status status = path_of(results, motor, "part", part, note);
    if (status) return status;
    return hci_folder_delete(part) ? HCI_OK : refused(part, "cannot be removed", note);
}

static hci_status write_row(const hci_fleet_results *r, const char *part, const char *row, hci_note *note)
{
    char header[HCI_FLEET_ROW_SIZE];
    hci_output *out;
    hci_status status = hci_output_open(part, &out, note);
    if (status) return status;
    hci_fleet_header(r->command, header);
    status = hci_output_file(out, ROW, note);
    if (!status) hci_output_text(out, "%s\n%s\n", header, row);
    if (!status) return hci_output_commit(out, note);
    hci_output_discard(out);
    return status;
}

static hci_status appear(const hci_fleet_results *r, const char *part, const char *path, hci_note *note)
{
    char motors[PATH_SIZE];
    if (rename(part, path) != 0) return refused(path, "cannot be made", note);
    snprintf(motors, sizeof motors, "%s/" MOTORS, r->folder);
    return hci_sync_folder(motors) ? HCI_OK : refused(motors, "cannot be brought to the disk", note);
}

static hci_status end_once(const hci_fleet_results *results, size_t motor, const hci_fleet_outcome *outcome,
                           const hci_fleet_digest *digest, char row[HCI_FLEET_ROW_SIZE], hci_note *note)
{
    char part[PATH_SIZE], path[PATH_SIZE];
    hci_status status = path_of(results, motor, "part", part, note);
    if (!status) status = path_of(results, motor, "", path, note);
    if (!status && outcome->state > HCI_FLEET_OPEN) status = hci_fleet_begin(results, motor, note);
    if (status) return status;
    if (outcome->state > HCI_FLEET_OPEN) (void)hci_memory_was_short(); /* it may be why there is no result */
    hci_fleet_row_make(results, motor, outcome, digest, part, row);
    status = write_row(results, part, row, note);
    return status ? status : appear(results, part, path, note);
}

/* A result for whose row there was no memory is none. */
hci_status hci_fleet_end(const hci_fleet_results *results, size_t motor, const hci_fleet_outcome *outcome,
                         const hci_fleet_digest *digest, char row[HCI_FLEET_ROW_SIZE], hci_note *note)
{
    const hci_fleet_outcome failed = {.state = HCI_FLEET_FAILED,
                                      .exit_code = hci_status_exit_code(HCI_ERROR_MEMORY),
                                      .reason = "out of memory for its row"};
    const hci_status status = end_once(results, motor, outcome, digest, row, note);
    if (status != HCI_ERROR_MEMORY || outcome->state > HCI_FLEET_OPEN) return status;
    note->text[0] = '\0';
    return end_once(results, motor, &failed, digest, row, note);
}

/* ---- what is done ---- */

static hci_status other_words(const char *path, const char *what, hci_note *note)
{
    return hci_note_set(note, HCI_ERROR_INPUT,
                        "%.300s: %s; expected a motor that the same command has done: give another --out, or "
                        "delete that motor's folder to do it again",
                        path, what);
}

/* The two lines of the file, without their ends. */
static bool take_row(char *text, const char *header, char row[HCI_FLEET_ROW_SIZE])
{
    char *end = strchr(text, '\n');
    if (!end) return false;
    *end = '\0';
    char *line = end + 1;
    end = strchr(line, '\n');
    if (!end || end[1] != '\0' || strcmp(text, header) != 0 || end - line >= HCI_FLEET_ROW_SIZE) return false;
    *end = '\0';
    strcpy(row, line);
    return true;
}

static bool is_of(const char *row, const char *header, const char *column, const char *expected)
{
    char cell[HCI_FLEET_NAME_SIZE];
    hci_fleet_row_cell(row, header, column, cell, sizeof cell);
    return strcmp(cell, expected) == 0;
}

hci_status hci_fleet_known(const hci_fleet_results *results, size_t motor, const hci_fleet_digest *digest,
                           char row[HCI_FLEET_ROW_SIZE], bool *is_done, hci_note *note)
{
    char path[PATH_SIZE], header[HCI_FLEET_ROW_SIZE];
    hci_status status = path_of(results, motor, "", path, note);
    *is_done = false;
    if (status) return status;
    strcat(path, "/" ROW);
    char *text = hci_whole_file(path);
    if (!text) return hci_memory_was_short() ? hci_note_memory(note, path, "reading it") : HCI_OK;
    hci_fleet_header(results->command, header);
    if (!take_row(text, header, row))
        status = other_words(path, "found a row of another command or version", note);
    else if (!is_of(row, header, "motor", hci_fleet_cell(results->list, motor, "motor")))
        status = other_words(path, "found the row of another motor", note);
    else if (!is_of(row, header, "words_digest", digest->text))
        status = other_words(path, "this motor was done with other words, or by another version", note);
    hci_memory_free(text);
    *is_done = !status;
    return status;
}

/* Whether the row says what the files beside it say. */
static hci_status check_row(const hci_fleet_results *r, size_t motor, const hci_fleet_digest *digest,
                            const char *path, const char *row, hci_note *note)
{
    const hci_fleet_outcome outcome = {.state = hci_fleet_row_state(row), .exit_code = -1};
    char made[HCI_FLEET_ROW_SIZE];
    hci_fleet_row_make(r, motor, &outcome, digest, path, made);
    if (hci_memory_was_short()) return hci_note_memory(note, path, "its row");
    if (strcmp(hci_fleet_row_findings(made), hci_fleet_row_findings(row)) == 0) return HCI_OK;
    return hci_note_set(note, HCI_ERROR_INPUT,
                        "%.300s/" ROW ": found other figures than the files beside it have, expected the row "
                        "that was written with them; " DONE_AGAIN,
                        path);
}

hci_status hci_fleet_check(const hci_fleet_results *results, size_t motor, const hci_fleet_digest *digest,
                           const char *row, hci_note *note)
{
    char path[PATH_SIZE];
    hci_status status = path_of(results, motor, "", path, note);
    if (status || hci_fleet_row_state(row) > HCI_FLEET_OPEN) return status;
    hci_output_finish_interrupted(path);
    status = hci_own_folder_check(path, DONE_AGAIN, note);
    return status ? status : check_row(results, motor, digest, path, row, note);
}

hci_fleet_state hci_fleet_row_state(const char *row)
{
    char cell[32];
    int state = 0;
    hci_fleet_row_cell(row, "motor,serial,batch,date,state", "state", cell, sizeof cell);
    while (state < HCI_FLEET_CRASHED && strcmp(cell, hci_fleet_state_name((hci_fleet_state)state)) != 0)
        ++state;
    return (hci_fleet_state)state;
}

void hci_fleet_row_reason(const char *row, char reason[HCI_FLEET_REASON_SIZE])
{
    reason[0] = '\0';
    if (hci_fleet_row_state(row) <= HCI_FLEET_OPEN) return;
    hci_fleet_row_cell(row, "motor,serial,batch,date,state,exit_code,verdict,reason", "reason", reason,
                       HCI_FLEET_REASON_SIZE);
}

hci_status hci_fleet_forget(const hci_fleet_results *results, size_t motor, hci_note *note)
{
    char path[PATH_SIZE], part[PATH_SIZE];
    hci_status status = hci_fleet_begin(results, motor, note);
    if (!status) status = path_of(results, motor, "", path, note);
    if (!status) status = path_of(results, motor, "part", part, note);
    if (status) return status;
    /* Under its hidden name first, so that it is never half there. */
    if (rename(path, part) != 0 || !hci_folder_delete(part)) return refused(path, "cannot be removed", note);
    return HCI_OK;
}

/* ---- the folder ---- */

hci_status hci_fleet_lock(const hci_fleet_results *results, void **lock, hci_note *note)
{
    char motors[PATH_SIZE];
    size_t existing;
    bool is_alone;
    *lock = NULL;
    if (snprintf(motors, sizeof motors, "%s/" MOTORS, results->folder) >= PATH_SIZE)
        return hci_note_set(note, HCI_ERROR_OUTPUT, "%.200s…: the path is too long", results->folder);
    if (!hci_folder_make(motors, &existing)) return refused(motors, "cannot be made", note);
    *lock = hci_folder_lock_take(motors, WAIT_MS, &is_alone);
    if (*lock) return HCI_OK;
    if (errno != EWOULDBLOCK) return refused(motors, "cannot be read", note);
    return hci_note_set(note, HCI_ERROR_OUTPUT,
                        "%.300s: another process works at the motors there; expected one at a time: wait for "
                        "it, or give each --shard its own --out",
                        results->folder);
}

void hci_fleet_unlock(void *lock)
{
    hci_folder_lock_release(lock);
}
