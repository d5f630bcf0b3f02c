#define _DEFAULT_SOURCE

#include "host/base/folder_lock.h"

#include <errno.h>
#include <fcntl.h>
#include <stddef.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <time.h>
#include <unistd.h>

#include "host/base/memory.h"

enum { STEP_ms = 10 };

struct hci_folder_lock {
    dev_t device;
    ino_t number;
    int descriptor; /* open, with the lock */
    unsigned times;
    hci_folder_lock *older;
};

static hci_folder_lock *newest;

static hci_folder_lock *find(const struct stat *folder)
{
    hci_folder_lock *lock = newest;
    while (lock != NULL && !(lock->device == folder->st_dev && lock->number == folder->st_ino))
        lock = lock->older;
    return lock;
}

typedef enum { LOCKED, KEPT, NO_LOCKS } outcome;

static outcome wait_for(int descriptor, int wait_ms)
{
    const struct timespec step = {0, STEP_ms * 1000000L};
    int waited = 0;
    while (flock(descriptor, LOCK_EX | LOCK_NB) != 0) {
        if (errno == EINTR) continue;
        if (errno != EWOULDBLOCK) return NO_LOCKS;
        if (waited >= wait_ms) return KEPT;
        nanosleep(&step, NULL);
        waited += STEP_ms;
    }
    return LOCKED;
}

static hci_folder_lock *add(int descriptor, const struct stat *folder)
{
    hci_folder_lock *lock = hci_memory_malloc(sizeof *lock);
    if (lock == NULL) {
        errno = ENOMEM;
        return NULL;
    }
    *lock = (hci_folder_lock){folder->st_dev, folder->st_ino, descriptor, 1, newest};
    newest = lock;
    return lock;
}

/* One more of what this process has, or a new one. */
static hci_folder_lock *take(int descriptor, int wait_ms, bool *is_alone)
{
    struct stat folder;
    if (fstat(descriptor, &folder) != 0) return NULL;
    hci_folder_lock *lock = find(&folder);
    if (lock != NULL) {
        close(descriptor);
        lock->times++;
        return lock;
    }
    const outcome found = wait_for(descriptor, wait_ms);
    *is_alone = found == LOCKED;
    return found == KEPT ? NULL : add(descriptor, &folder);
}

hci_folder_lock *hci_folder_lock_take(const char *folder, int wait_ms, bool *is_alone)
{
    const int descriptor = open(folder, O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    *is_alone = false;
    if (descriptor < 0) return NULL;
    hci_folder_lock *lock = take(descriptor, wait_ms, is_alone);
    const int error = errno;
    if (lock == NULL) close(descriptor);
    errno = error;
    return lock;
}

void hci_folder_lock_release(hci_folder_lock *lock)
{
    if (lock == NULL || --lock->times > 0) return;
    for (hci_folder_lock **at = &newest; *at != NULL; at = &(*at)->older)
        if (*at == lock) {
            *at = lock->older;
            break;
        }
    close(lock->descriptor);
    hci_memory_free(lock);
}
