#include "host/base/digest.h"

#include <errno.h>
#include <stdio.h>

#include "host/base/path.h"

uint64_t hci_digest_next(uint64_t sum, const char *bytes, size_t count)
{
    for (size_t k = 0; k < count; ++k)
        sum = (sum ^ (unsigned char)bytes[k]) * 1099511628211u;
    return sum;
}

bool hci_digest_file(const char *path, uint64_t *sum)
{
    FILE *file = fopen(path, "rb");
    char block[4096];
    size_t count;
    if (!file) return hci_unread_keep(path), false;
    while ((count = fread(block, 1, sizeof block, file)) > 0)
        *sum = hci_digest_next(*sum, block, count);
    const bool good = !ferror(file);
    if (!good) hci_unread_keep(path);
    fclose(file);
    return good;
}
