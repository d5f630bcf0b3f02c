#define _POSIX_C_SOURCE 200809L

#include "host/base/whole_file.h"

#include <stdio.h>
#include <sys/stat.h>

#include "host/base/memory.h"

char *hci_whole_file(const char *path)
{
    FILE *file = fopen(path, "rb");
    struct stat info;
    char *text = NULL;
    if (file && fstat(fileno(file), &info) == 0 && S_ISREG(info.st_mode))
        text = hci_memory_new((size_t)info.st_size + 1, 1);
    if (text) text[fread(text, 1, (size_t)info.st_size, file)] = '\0';
    if (file) fclose(file);
    return text;
}
