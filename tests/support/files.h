/* Files of a test: a temporary folder from setUp to tearDown, and text files written and read whole. A
 * failure fails the test. Prefix files_. */
#ifndef FILES_H
#define FILES_H

#include <dirent.h>
#include <ftw.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "unity.h"

enum { FILES_KEPT = 8 };

static char files_root[64]; /* the folder, between files_begin and files_end */

static inline void files_begin(void)
{
    snprintf(files_root, sizeof files_root, "/tmp/hci-test-XXXXXX");
    TEST_ASSERT_NOT_NULL(mkdtemp(files_root));
}

/* A path below the folder; it holds for the next FILES_KEPT calls. */
static inline const char *files_path(const char *name)
{
    static char path[FILES_KEPT][512];
    static unsigned next;
    char *out = path[next++ % FILES_KEPT];
    snprintf(out, sizeof path[0], "%s/%s", files_root, name);
    return out;
}

static inline int files_remove_one(const char *path, const struct stat *info, int kind, struct FTW *place)
{
    (void)info, (void)kind, (void)place;
    return remove(path);
}

/* A file, or a folder with all that is in it. */
static inline void files_remove(const char *path)
{
    nftw(path, files_remove_one, 8, FTW_DEPTH | FTW_PHYS);
}

/* Entries of a folder, hidden ones too; −1 when there is no such folder. */
static inline int files_count(const char *path)
{
    int count = -2; /* . and .. */
    DIR *folder = opendir(path);
    if (folder == NULL) return -1;
    while (readdir(folder) != NULL)
        ++count;
    closedir(folder);
    return count;
}

static inline void files_end(void)
{
    files_remove(files_root);
    files_root[0] = '\0';
}

static inline void files_write(const char *path, const char *text)
{
    FILE *file = fopen(path, "wb");
    TEST_ASSERT_NOT_NULL_MESSAGE(file, path);
    TEST_ASSERT_TRUE(fputs(text, file) >= 0);
    TEST_ASSERT_EQUAL_INT(0, fclose(file));
}

/* The whole text of a file without NUL; it is kept for the next FILES_KEPT calls. */
static inline char *files_read(const char *path)
{
    static char *kept[FILES_KEPT];
    static unsigned next;
    char **text = &kept[next++ % FILES_KEPT];
    FILE *file = fopen(path, "rb");
    TEST_ASSERT_NOT_NULL_MESSAGE(file, path);
    TEST_ASSERT_EQUAL_INT(0, fseek(file, 0, SEEK_END));
    const size_t size = (size_t)ftell(file);
    rewind(file);
    *text = (char *)realloc(*text, size + 1);
    TEST_ASSERT_NOT_NULL(*text);
    (*text)[fread(*text, 1, size, file)] = '\0';
    fclose(file);
    TEST_ASSERT_EQUAL_UINT64_MESSAGE(size, strlen(*text), path);
    return *text;
}

/* The descriptor that the next file will have; it stays the same unless a file is left open. */
static inline int files_next_descriptor(void)
{
    const int descriptor = dup(0);
    close(descriptor);
    return descriptor;
}

#endif
