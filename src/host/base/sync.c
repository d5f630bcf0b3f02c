#define _POSIX_C_SOURCE 200809L

#include "host/base/sync.h"

#include <errno.h>
#include <fcntl.h>
#include <unistd.h>

static bool sync_descriptor(int descriptor)
{
    return fsync(descriptor) == 0 || errno == EINVAL || errno == ENOTSUP || errno == EROFS;
}

bool hci_sync_stream(FILE *stream)
{
    return fflush(stream) == 0 && sync_descriptor(fileno(stream));
}

bool hci_sync_folder(const char *folder)
{
    const int descriptor = open(folder, O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    if (descriptor < 0) return errno == EACCES;
    const bool good = sync_descriptor(descriptor);
    const int error = errno;
    close(descriptor);
    errno = error;
    return good;
}
