#define _POSIX_C_SOURCE 200809L

#include "hci/host/base/output.h"

#include <assert.h>
#include <dirent.h>
#include <errno.h>
#include <fcntl.h>
#include <math.h>
#include <signal.h>
#include <stdarg.h>
#include <stdbool.h>
#include <stdio.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "hci/host/base/number.h"
#include "host/base/checksum.h"
#include "host/base/folder.h"
#include "host/base/folder_lock.h"
#include "host/base/journal.h"
#include "host/base/memory.h"
#include "host/base/path.h"
#include "host/base/quote.h"
#include "host/base/sync.h"

typedef struct {
    char *target;    /* folder/name */
    char *temporary; /* written until the commit */
    char *backup;    /* keeps an older target while the set is renamed */
    bool renamed, has_backup;
    bool absent;     /* the target is taken away rather than replaced */
    bool not_finite; /* such a number was to be written */
    int error;       /* errno of the first failed write */
} file;

enum { LOCK_WAIT_ms = 2000 };

struct hci_output {
    char *folder;
    size_t existing; /* length of the part of `folder` that was there before */
    file *files;
    size_t count;
    FILE *stream; /* of the last file */
    hci_folder_lock *lock;
    hci_output *older;
};

/* ---- signals ---- */

/* All open sets, the newest first. A handler may walk through them: whatever changes them, or renames their
 * files, makes signals wait. */
static hci_output *newest;

static void hold_signals(sigset_t *before)
{
    sigset_t all;
    sigfillset(&all);
    sigprocmask(SIG_BLOCK, &all, before);
}

static void release_signals(const sigset_t *before)
{
    sigprocmask(SIG_SETMASK, before, NULL);
}

static void enter(hci_output *output)
{
    output->older = newest;
    newest = output;
}

static void leave(const hci_output *output)
{
    for (hci_output **at = &newest; *at != NULL; at = &(*at)->older)
        if (*at == output) {
            *at = output->older;
            return;
        }
}

/* ---- who wants to know ---- */

static struct {
    hci_output_told *told;
    void *context;
} listener;

void hci_output_tell(hci_output_told *told, void *context)
{
    listener.told = told;
    listener.context = context;
}

static void tell(const hci_output *output)
{
    for (size_t i = 0; i < output->count && listener.told != NULL; i++)
        if (!output->files[i].absent) listener.told(listener.context, output->files[i].target);
}

/* ---- messages ---- */

static hci_status output_error(const char *path, hci_note *note, const char *found, const char *remedy)
{
    char shown[HCI_QUOTE_PATH_SIZE];
    return hci_note_set(note, HCI_ERROR_OUTPUT, "%s: cannot be written: %s; %s", hci_quote_path(path, shown),
                        found, remedy);
}

/* What the system refused; error: of errno. */
static hci_status system_error(const char *path, hci_note *note, int error, const char *remedy)
{
    if (error == ENOMEM) return hci_note_memory(note, path, "writing it");
    return output_error(path, note, strerror(error), remedy);
}

/* ---- the folder ---- */

/* Temporary files that processes have left which were killed before their set was complete. A backup may be
 * the only copy of a file, and stays. */
static void remove_left_over(const char *folder)
{
    DIR *names = opendir(folder);
    const struct dirent *entry;
    if (names == NULL) return;
    while ((entry = readdir(names)) != NULL) {
        const char *name = entry->d_name, *end = strrchr(name, '.');
        if (strncmp(name, ".hci-", 5) == 0 && strcmp(end, ".tmp") == 0) unlinkat(dirfd(names), name, 0);
    }
    closedir(names);
}

static void finish_here(const char *folder)
{
    bool is_alone;
    if (!hci_journal_exists(folder)) return;
    hci_folder_lock *lock = hci_folder_lock_take(folder, LOCK_WAIT_ms, &is_alone);
    if (lock != NULL && is_alone) hci_journal_finish(folder);
    hci_folder_lock_release(lock);
}

/* A set may have files in a folder within its own, such as `machine` of a diagnosis. */
static void finish_above(const char *folder)
{
    char path[4096];
    const int length = snprintf(path, sizeof path, "%s/..", folder);
    if (length > 0 && length < (int)sizeof path) finish_here(path);
}

/* Locks the folder, and ends what a process that was killed has begun there. */
static hci_status lock_folder(hci_output *set, hci_note *note)
{
    bool is_alone;
    set->lock = hci_folder_lock_take(set->folder, LOCK_WAIT_ms, &is_alone);
    if (set->lock == NULL && errno == EWOULDBLOCK)
        return output_error(set->folder, note, "another process is writing into it",
                            "wait until it has ended, or name another folder");
    if (set->lock == NULL) return system_error(set->folder, note, errno, "check the folder");
    finish_above(set->folder);
    if (is_alone && hci_journal_finish(set->folder)) remove_left_over(set->folder);
    return HCI_OK;
}

static hci_status make_folder(hci_output *set, hci_note *note)
{
    if (!hci_folder_make(set->folder, &set->existing))
        return system_error(set->folder, note, errno, "give a folder that can be made");
    const hci_status status = lock_folder(set, note);
    if (status) hci_folder_remove(set->folder, set->existing);
    return status;
}

static hci_status open_set(const char *folder, hci_output **output, hci_note *note)
{
    if (*folder == '\0')
        return output_error("output", note, "the folder has no name", "name one, or . for this one");
    hci_output *set = hci_memory_new(1, sizeof *set);
    if (set != NULL) set->folder = hci_memory_text(folder);
    if (set == NULL || set->folder == NULL) {
        hci_memory_free(set);
        return hci_note_memory(note, folder, "writing it");
    }
    hci_status status = make_folder(set, note);
    if (!status) {
        enter(set);
        *output = set;
        return HCI_OK;
    }
    hci_memory_free(set->folder);
    hci_memory_free(set);
    return status;
}

hci_status hci_output_open(const char *folder, hci_output **output, hci_note *note)
{
    sigset_t signals;
    *output = NULL;
    hold_signals(&signals);
    const hci_status status = open_set(folder, output, note);
    release_signals(&signals);
    return status;
}

hci_status hci_output_open_file(const char *path, hci_output **output, hci_note *note)
{
    const char *slash = strrchr(path, '/');
    const size_t length = slash == NULL ? 1 : slash == path ? 1 : (size_t)(slash - path);
    char *folder = hci_memory_text_part(slash == NULL ? "." : path, length);
    *output = NULL;
    if (folder == NULL) return hci_note_memory(note, NULL, "the output");
    hci_status status = hci_output_open(folder, output, note);
    hci_memory_free(folder);
    if (!status) status = hci_output_file(*output, slash == NULL ? path : slash + 1, note);
    return status;
}

/* ---- one file ---- */

/* Only a plain file that may be written is replaced: not a folder, a device, or a link to something else. */
static hci_status check_target(const char *target, hci_note *note)
{
    struct stat status;
    if (lstat(target, &status) != 0) return HCI_OK;
    if (S_ISDIR(status.st_mode))
        return output_error(target, note, "found a folder of this name", "remove or rename it");
    if (!S_ISREG(status.st_mode)) {
        return output_error(target, note, "found something that is not a plain file", "name another file");
    }
    if (faccessat(AT_FDCWD, target, W_OK, AT_EACCESS) != 0)
        return system_error(target, note, errno, "make the file writable");
    return HCI_OK;
}

static void forget(file *f)
{
    hci_memory_free(f->target);
    hci_memory_free(f->temporary);
    hci_memory_free(f->backup);
}

enum { TEMPORARY_SIZE = 64 };

/* Everything that the commit will need is allocated here, so that it cannot fail for memory. */
static hci_status name_file(const char *folder, const char *name, file *f, hci_note *note)
{
    const size_t length = strlen(folder) + 1;
    f->target = hci_memory_malloc(length + strlen(name) + 1);
    f->temporary = hci_memory_malloc(length + TEMPORARY_SIZE);
    f->backup = hci_memory_malloc(length + TEMPORARY_SIZE);
    if (f->target == NULL || f->temporary == NULL || f->backup == NULL)
        return hci_note_memory(note, name, "writing it");
    snprintf(f->target, length + strlen(name) + 1, "%s/%s", folder, name);
    return check_target(f->target, note);
}

/* Like mkstemp, but with the mode that the umask gives to any file. */
static FILE *open_temporary(const char *folder, file *f)
{
    int descriptor = -1;
    errno = EEXIST;
    for (unsigned k = 0; descriptor < 0 && errno == EEXIST && k < 10000; k++) {
        const size_t size = strlen(folder) + 1 + TEMPORARY_SIZE;
        snprintf(f->temporary, size, "%s/.hci-%ld-%u.tmp", folder, (long)getpid(), k);
        snprintf(f->backup, size, "%s/.hci-%ld-%u.old", folder, (long)getpid(), k);
        descriptor = open(f->temporary, O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
    }
    if (descriptor < 0) return NULL;
    FILE *stream = fdopen(descriptor, "w");
    if (stream == NULL) {
        const int error = errno;
        close(descriptor);
        unlink(f->temporary);
        errno = error;
    }
    return stream;
}

static hci_status check_name(const hci_output *output, const char *name, hci_note *note)
{
    char quoted[HCI_QUOTE_SIZE];
    bool usable =
        *name != '\0' && strchr(name, '/') == NULL && strcmp(name, ".") != 0 && strcmp(name, "..") != 0;
    for (size_t i = 0; i < output->count && usable; i++) {
        usable = strcmp(strrchr(output->files[i].target, '/') + 1, name) != 0;
    }
    if (usable) return HCI_OK;
    return hci_note_set(note, HCI_ERROR_ARGUMENT,
                        "found %s, expected the name of a new output file without a folder",
                        hci_quote(name, quoted));
}

static void remember(hci_output *output, int error)
{
    file *f = &output->files[output->count - 1];
    if (f->error == 0) f->error = error != 0 ? error : EIO;
}

static void close_stream(hci_output *output)
{
    if (output->stream == NULL) return;
    errno = 0;
    if (ferror(output->stream)) remember(output, EIO);
    if (!hci_sync_stream(output->stream)) remember(output, errno);
    if (fclose(output->stream) != 0) remember(output, errno);
    output->stream = NULL;
}

static hci_status add_file(hci_output *output, const char *name, hci_note *note)
{
    hci_status status;
    file *files = hci_memory_resize(output->files, output->count + 1, sizeof *files);
    if (files == NULL) return hci_note_memory(note, name, "writing it");
    output->files = files;
    file *f = &files[output->count];
    *f = (file){0};
    status = name_file(output->folder, name, f, note);
    if (!status) {
        output->stream = open_temporary(output->folder, f);
        if (output->stream == NULL) status = system_error(f->target, note, errno, "check the folder");
    }
    if (!status) {
        output->count++;
    } else {
        forget(f);
    }
    return status;
}

hci_status hci_output_file(hci_output *output, const char *name, hci_note *note)
{
    sigset_t signals;
    hci_status status = check_name(output, name, note);
    if (status) return status;
    close_stream(output);
    hold_signals(&signals);
    status = add_file(output, name, note);
    release_signals(&signals);
    return status;
}

hci_status hci_output_without(hci_output *output, const char *name, hci_note *note)
{
    const hci_status status = hci_output_file(output, name, note);
    if (!status) output->files[output->count - 1].absent = true;
    return status;
}

void hci_output_text(hci_output *output, const char *format, ...)
{
    assert(output->stream != NULL);
    va_list arguments;
    va_start(arguments, format);
    errno = 0;
    if (vfprintf(output->stream, format, arguments) < 0) remember(output, errno);
    va_end(arguments);
}

void hci_output_bytes(hci_output *output, const void *bytes, size_t count)
{
    assert(output->stream != NULL);
    errno = 0;
    if (fwrite(bytes, 1, count, output->stream) != count) remember(output, errno);
}

void hci_output_number(hci_output *output, double value, char end)
{
    char text[32];
    assert(output->stream != NULL);
    if (!isfinite(value)) output->files[output->count - 1].not_finite = true;
    hci_number_text(value, text);
    errno = 0;
    if (fputs(text, output->stream) < 0 || putc(end, output->stream) == EOF) remember(output, errno);
}

/* ---- all or nothing ---- */

static hci_status check_written(const file *f, hci_note *note)
{
    char shown[HCI_QUOTE_PATH_SIZE];
    if (f->error != 0)
        return system_error(f->target, note, f->error, "free some space or name another folder");
    if (!f->not_finite) return HCI_OK;
    return hci_note_set(note, HCI_ERROR_NOT_FINITE, "%s: not written: a result is infinite or not a number",
                        hci_quote_path(f->target, shown));
}

/* A second link keeps the target in its place; where the file system has none it is moved. A backup that a
 * crashed run has left is never overwritten. */
static bool make_backup(file *f)
{
    struct stat status;
    if (lstat(f->target, &status) != 0) return true;
    f->has_backup = link(f->target, f->backup) == 0 || (errno != EEXIST && rename(f->target, f->backup) == 0);
    return f->has_backup;
}

static bool take_away(const file *f)
{
    return unlink(f->target) == 0 || errno == ENOENT;
}

static hci_status publish(file *f, hci_note *note)
{
    const hci_status status = check_target(f->target, note);
    if (status) return status;
    if (!make_backup(f) || !(f->absent ? take_away(f) : rename(f->temporary, f->target) == 0)) {
        return system_error(f->target, note, errno, "check the folder");
    }
    f->renamed = !f->absent;
    return HCI_OK;
}

static void withdraw(file *f)
{
    if (f->has_backup) {
        /* rename does nothing when both names are still links to one file */
        if (rename(f->backup, f->target) == 0) unlink(f->backup);
    } else if (f->renamed) {
        unlink(f->target);
    }
}

hci_status hci_output_check(hci_output *output, hci_note *note)
{
    hci_status status = HCI_OK;
    close_stream(output);
    for (size_t i = 0; i < output->count && !status; i++)
        status = check_written(&output->files[i], note);
    for (size_t i = 0; i < output->count && !status; i++)
        status = check_target(output->files[i].target, note);
    return status;
}

/* The part of a path behind the folder. */
static const char *name_of(const char *path)
{
    return strrchr(path, '/') + 1;
}

/* Sets that are renamed together: the last one's folder has those of the others within. */
typedef struct {
    hci_output *const *set;
    size_t count;
} sets;

static hci_output *outer_of(const sets *all)
{
    return all->set[all->count - 1];
}

static void note_steps(FILE *journal, const sets *all)
{
    const size_t skipped = strlen(outer_of(all)->folder) + 1;
    for (size_t k = 0; k < all->count; k++)
        for (size_t i = 0; i < all->set[k]->count; i++) {
            const file *f = &all->set[k]->files[i];
            hci_journal_step(journal, f->absent, f->temporary + skipped, f->backup + skipped,
                             f->target + skipped);
        }
}

/* From here on the sets are written, whatever becomes of the process. One file needs no journal. */
static hci_status begin_journal(const sets *all, hci_note *note)
{
    const hci_output *outer = outer_of(all);
    if (all->count == 1 && outer->count < 2) return HCI_OK;
    FILE *journal = hci_journal_open(outer->folder);
    if (journal != NULL) note_steps(journal, all);
    if (journal != NULL && hci_journal_begin(outer->folder, journal)) return HCI_OK;
    return system_error(outer->folder, note, errno, "free some space or name another folder");
}

static void undo(const sets *all)
{
    hci_journal_end(outer_of(all)->folder);
    for (size_t k = all->count; k-- > 0;)
        for (size_t i = all->set[k]->count; i-- > 0;)
            withdraw(&all->set[k]->files[i]);
}

/* The backups go first: whoever ends a journal takes them away, and without one nobody knows what they are.
 */
static void end_journal(const sets *all)
{
    for (size_t k = 0; k < all->count; k++)
        hci_sync_folder(all->set[k]->folder);
    for (size_t k = 0; k < all->count; k++)
        for (size_t i = 0; i < all->set[k]->count; i++)
            if (all->set[k]->files[i].has_backup) unlink(all->set[k]->files[i].backup);
    hci_journal_end(outer_of(all)->folder);
}

hci_status hci_output_checksums(hci_output *output,
                                void (*show)(void *context, const char *name, const char *checksum),
                                void *context, hci_note *note)
{
    char checksum[HCI_CHECKSUM_SIZE];
    close_stream(output);
    for (size_t i = 0; i < output->count; i++) {
        const file *f = &output->files[i];
        if (f->absent) continue;
        if (!hci_checksum_file(f->temporary, checksum))
            return system_error(f->target, note, errno, "check the folder");
        show(context, name_of(f->target), checksum);
    }
    return HCI_OK;
}

static hci_status check_memory(const hci_output *output, hci_note *note)
{
    if (!hci_memory_was_short()) return HCI_OK;
    (void)hci_note_memory(note, output->folder, "a part of what is to be written");
    (void)hci_memory_was_short();
    return HCI_ERROR_MEMORY;
}

/* What had no memory, or could not be read, may be missing in these files. It is told once. */
static hci_status check_inputs(const hci_output *output, hci_note *note)
{
    const hci_status status = check_memory(output, note);
    return status ? status : hci_unread_check(note);
}

static hci_status publish_set(const hci_output *output, hci_note *note)
{
    hci_status status = HCI_OK;
    for (size_t i = 0; i < output->count && !status; i++)
        status = publish(&output->files[i], note);
    return status;
}

static hci_status publish_all(const sets *all, hci_note *note)
{
    hci_status status = HCI_OK;
    for (size_t k = 0; k < all->count && !status; k++)
        status = hci_output_check(all->set[k], note);
    if (!status) status = check_inputs(outer_of(all), note);
    if (!status) status = begin_journal(all, note);
    if (status) return status;
    for (size_t k = 0; k < all->count && !status; k++)
        status = publish_set(all->set[k], note);
    if (status)
        undo(all);
    else
        end_journal(all);
    return status;
}

hci_status hci_output_commit_together(hci_output *const set[], size_t count, hci_note *note)
{
    const sets all = {set, count};
    sigset_t signals;
    for (size_t k = 0; k < count; k++)
        close_stream(set[k]);
    hold_signals(&signals);
    const hci_status status = publish_all(&all, note);
    for (size_t k = 0; k < count; k++) {
        if (!status) set[k]->existing = strlen(set[k]->folder);
        if (!status) tell(set[k]);
        hci_output_discard(set[k]);
    }
    release_signals(&signals);
    return status;
}

hci_status hci_output_commit(hci_output *output, hci_note *note)
{
    return hci_output_commit_together(&output, 1, note);
}

void hci_output_discard(hci_output *output)
{
    sigset_t signals;
    if (output == NULL) return;
    hold_signals(&signals);
    leave(output);
    close_stream(output);
    for (size_t i = 0; i < output->count; i++) {
        if (!output->files[i].renamed) unlink(output->files[i].temporary);
        forget(&output->files[i]);
    }
    hci_folder_remove(output->folder, output->existing);
    hci_folder_lock_release(output->lock);
    hci_memory_free(output->files);
    hci_memory_free(output->folder);
    hci_memory_free(output);
    release_signals(&signals);
}

void hci_output_finish_interrupted(const char *folder)
{
    finish_here(folder);
    finish_above(folder);
}

void hci_output_abandon(void)
{
    for (hci_output *output = newest; output != NULL; output = output->older) {
        for (size_t i = 0; i < output->count; i++)
            unlink(output->files[i].temporary);
        hci_folder_remove(output->folder, output->existing);
    }
}
