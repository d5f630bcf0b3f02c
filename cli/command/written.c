#define _POSIX_C_SOURCE 200809L

#include "cli/command/written.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "cli/terminal/say.h"
#include "cli/terminal/terminal.h"
#include "hci/host/base/output.h"

static struct {
    char **path;
    size_t count;
    int depth; /* commands that have begun */
} written;

static bool is_known(const char *path)
{
    for (size_t k = 0; k < written.count; ++k)
        if (strcmp(written.path[k], path) == 0) return true;
    return false;
}

/* Without memory a file is not named; it is there all the same. */
static void add(void *context, const char *path)
{
    (void)context;
    if (is_known(path)) return;
    char *copy = strdup(path), **more = realloc(written.path, (written.count + 1) * sizeof *more);
    if (more) written.path = more;
    if (copy && more)
        written.path[written.count++] = copy;
    else
        free(copy);
}

void cli_written_begin(void)
{
    if (written.depth++ == 0) hci_output_tell(add, NULL);
}

/* Bytes of the folder of a path, with its slash. */
static size_t folder_length(const char *path)
{
    return (size_t)(strrchr(path, '/') + 1 - path);
}

static bool is_beside(const char *a, const char *b)
{
    return folder_length(a) == folder_length(b) && strncmp(a, b, folder_length(a)) == 0;
}

static bool is_first_of_folder(size_t k)
{
    for (size_t j = 0; j < k; ++j)
        if (is_beside(written.path[j], written.path[k])) return false;
    return true;
}

static void say_folder(size_t first)
{
    const char *between = " ";
    const size_t length = folder_length(written.path[first]);
    size_t files = 0;
    for (size_t k = first; k < written.count; ++k)
        files += is_beside(written.path[first], written.path[k]);
    if (files == 1) {
        cli_say("  written      %s\n", written.path[first]);
        return;
    }
    cli_say("  written      %.*s:", (int)length - 1, written.path[first]);
    for (size_t k = first; k < written.count; ++k) {
        if (!is_beside(written.path[first], written.path[k])) continue;
        cli_say("%s%s", between, written.path[k] + length);
        between = ", ";
    }
    cli_say("\n");
}

void cli_written_say(void)
{
    for (size_t k = 0; k < written.count && cli_is_wordy(); ++k)
        if (is_first_of_folder(k)) say_folder(k);
}

/* The folders above a file, down to `root`, as far as nothing else is in them; the path is cut. */
static void remove_folders(char *path, const char *root)
{
    for (char *slash = strrchr(path, '/'); slash && slash - path >= (ptrdiff_t)strlen(root);
         slash = strrchr(path, '/')) {
        *slash = '\0';
        if (rmdir(path) != 0) return;
    }
}

void cli_written_remove(const char *root)
{
    for (size_t k = written.count; k-- > 0;) {
        (void)unlink(written.path[k]);
        remove_folders(written.path[k], root);
        free(written.path[k]);
    }
    written.count = 0;
}

void cli_written_forget(const char *folder)
{
    const size_t length = strlen(folder);
    size_t kept = 0;
    for (size_t k = 0; k < written.count && length > 0; ++k) {
        if (strncmp(written.path[k], folder, length) == 0 && written.path[k][length] == '/')
            free(written.path[k]);
        else
            written.path[kept++] = written.path[k];
    }
    if (length > 0) written.count = kept;
}

void cli_written_end(void)
{
    if (--written.depth > 0) return;
    hci_output_tell(NULL, NULL);
    for (size_t k = 0; k < written.count; ++k)
        free(written.path[k]);
    free(written.path);
    written.path = NULL;
    written.count = 0;
}
