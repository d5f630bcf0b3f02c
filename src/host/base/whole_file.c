#define _POSIX_C_SOURCE 200809L

#include "host/base/whole_file.h"

#include <errno.h>
#include <fcntl.h>
#include <stdbool.h>
#include <sys/stat.h>
#include <unistd.h>

#include "host/base/memory.h"
#include "host/base/path.h"

/* As much of it as there is; the rest of the text is NUL. */
static bool read_into(int file, char *text, size_t size)
{
    for (size_t at = 0; at < size;) {
        const ssize_t count = read(file, text + at, size - at);
        if (count == 0) return true;
        if (count < 0 && errno != EINTR) return false;
        if (count > 0) at += (size_t)count;
    }
    return true;
}

/* NULL with errno, which is 0 where it is no plain file or memory is out. */
static char *text_of(int file)
{
    struct stat info;
    if (fstat(file, &info) != 0) return NULL;
    errno = 0;
    char *text = S_ISREG(info.st_mode) ? hci_memory_new((size_t)info.st_size + 1, 1) : NULL;
    if (!text || read_into(file, text, (size_t)info.st_size)) return text;
    const int error = errno;
    hci_memory_free(text);
    errno = error;
    return NULL;
}

/* Without a stream, whose memory would not be ours. */
char *hci_whole_file(const char *path)
{
    const int file = open(path, O_RDONLY | O_NONBLOCK | O_CLOEXEC);
    char *text = file < 0 ? NULL : text_of(file);
    if (!text && errno) hci_unread_keep(path);
    if (file >= 0) close(file);
    return text;
}
