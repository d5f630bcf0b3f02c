#define _POSIX_C_SOURCE 200809L

#include "host/base/whole_file.h"

#include <errno.h>
#include <fcntl.h>
#include <stdbool.h>
#include <sys/stat.h>
#include <unistd.h>

#include "host/base/memory.h"

/* As much of it as there is; the rest of the text is NUL. */
static void read_into(int file, char *text, size_t size)
{
    for (size_t at = 0; at < size;) {
        const ssize_t count = read(file, text + at, size - at);
        if (count == 0 || (count < 0 && errno != EINTR)) return;
        if (count > 0) at += (size_t)count;
    }
}

/* Without a stream, whose memory would not be ours. */
char *hci_whole_file(const char *path)
{
    const int file = open(path, O_RDONLY | O_NONBLOCK | O_CLOEXEC);
    struct stat info;
    char *text = NULL;
    if (file < 0) return NULL;
    if (fstat(file, &info) == 0 && S_ISREG(info.st_mode)) text = hci_memory_new((size_t)info.st_size + 1, 1);
    if (text) read_into(file, text, (size_t)info.st_size);
    close(file);
    return text;
}
