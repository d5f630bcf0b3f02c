/* A fuzz target without a fuzzer: runs files, and those of folders, through it. With FUZZ_VERBOSE in
 * the environment it tells them, and what a command says of them. */
#define _XOPEN_SOURCE 700

#include <dirent.h>
#include <stdio.h>
#include <stdlib.h>
#include <sys/stat.h>

#include "fuzzing.h"

static int inputs;

static void replay_file(const char *path)
{
    FILE *file = fopen(path, "rb");
    struct stat info;
    fuzz_require(file != NULL && fstat(fileno(file), &info) == 0, path);
    const size_t size = (size_t)info.st_size;
    uint8_t *data = malloc(size + 1);
    fuzz_require(data != NULL && fread(data, 1, size, file) == size, path);
    fclose(file);
    if (getenv("FUZZ_VERBOSE") != NULL) fprintf(stderr, "%s\n", path);
    (void)LLVMFuzzerTestOneInput(data, size);
    free(data);
    ++inputs;
}

static void replay_folder(const char *path)
{
    struct dirent **entry;
    const int count = scandir(path, &entry, NULL, alphasort);
    fuzz_require(count >= 0, path);
    for (int k = 0; k < count; ++k) {
        char file[4400];
        snprintf(file, sizeof file, "%.4096s/%s", path, entry[k]->d_name);
        if (entry[k]->d_name[0] != '.') replay_file(file);
        free(entry[k]);
    }
    free(entry);
}

/* A target changes the current folder: paths are made whole before. */
int main(int count, char **words)
{
    for (int k = 1; k < count; ++k) {
        char *path = realpath(words[k], NULL);
        fuzz_require(path != NULL, words[k]);
        words[k] = path;
    }
    for (int k = 1; k < count; ++k) {
        struct stat info;
        fuzz_require(stat(words[k], &info) == 0, words[k]);
        if (S_ISDIR(info.st_mode))
            replay_folder(words[k]);
        else
            replay_file(words[k]);
        free(words[k]);
    }
    printf("%d inputs\n", inputs);
    return inputs == 0;
}
