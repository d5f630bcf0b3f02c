#define _XOPEN_SOURCE 700

#include "cli/export_fmu/compile.h"

#include <dirent.h>
#include <errno.h>
#include <fcntl.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/wait.h>
#include <unistd.h>

/* What the compiler says, in the work folder. */
static const char LOG[] = ".log";

/* ---- the folder ---- */

hci_status cli_work_folder_make(char folder[CLI_WORK_FOLDER_SIZE], hci_note *note)
{
    const char *parent = getenv("TMPDIR");
    snprintf(folder, CLI_WORK_FOLDER_SIZE, "%s/hci-fmu-XXXXXX", parent && parent[0] ? parent : "/tmp");
    if (mkdtemp(folder)) return HCI_OK;
    return hci_note_set(note, HCI_ERROR_OUTPUT,
                        "%s: no folder for temporary files: %s; set TMPDIR to one that can be written",
                        folder, strerror(errno));
}

void cli_work_folder_remove(const char *folder)
{
    DIR *files = opendir(folder);
    const struct dirent *entry;
    while (files && (entry = readdir(files)) != NULL)
        if (strcmp(entry->d_name, ".") != 0 && strcmp(entry->d_name, "..") != 0)
            unlinkat(dirfd(files), entry->d_name, 0);
    if (files) closedir(files);
    rmdir(folder);
}

/* ---- the compiler ---- */

static const char *const OPTIONS[] = {"-std=c99", "-O2", "-fPIC", "-shared", "-fvisibility=hidden",
                                      /* the same arithmetic as that of `simulate` */
                                      "-ffp-contract=off", "-fno-builtin-sin", "-fno-builtin-cos",
                                      "-ffunction-sections", "-Wl,--gc-sections", "-o"};

enum { OPTION_COUNT = sizeof OPTIONS / sizeof *OPTIONS, MOST_WORDS_OF_CC = 16 };

static const char *compiler(void)
{
    const char *cc = getenv("CC");
    return cc && cc[0] ? cc : "cc";
}

/* The words of a command line: those of `words` (which is cut into them), the options, the sources. */
static char **make_command(char *words, const char *const *sources, size_t count, const char *library)
{
    char **command = calloc(MOST_WORDS_OF_CC + OPTION_COUNT + count + 3, sizeof *command);
    size_t n = 0;
    if (!command) return NULL;
    for (char *word = strtok(words, " "); word && n < MOST_WORDS_OF_CC; word = strtok(NULL, " "))
        command[n++] = word;
    for (size_t k = 0; k < OPTION_COUNT; ++k)
        command[n++] = (char *)(size_t)OPTIONS[k];
    command[n++] = (char *)(size_t)library;
    for (size_t k = 0; k < count; ++k)
        command[n++] = (char *)(size_t)sources[k];
    command[n] = (char *)(size_t) "-lm";
    return command;
}

/* In the child: never returns. 127 where the program is not there, as a shell has it. */
static void become(const char *folder, char **command)
{
    const int log = chdir(folder) == 0 ? open(LOG, O_WRONLY | O_CREAT | O_TRUNC, 0600) : -1;
    if (log < 0 || dup2(log, 1) < 0 || dup2(log, 2) < 0) _exit(126);
    execvp(command[0], command);
    _exit(127);
}

/* The exit code; 128 where it was ended by a signal, 126 where it could not be started. */
static int run_in(const char *folder, char **command)
{
    int state = 0;
    fflush(NULL);
    const pid_t child = fork();
    if (child == 0) become(folder, command);
    if (child < 0) return 126;
    while (waitpid(child, &state, 0) < 0)
        if (errno != EINTR) return 126;
    return WIFEXITED(state) ? WEXITSTATUS(state) : 128;
}

/* The first line of the log that says `error`, or its first line. */
static void read_complaint(const char *folder, char complaint[256])
{
    char path[CLI_WORK_FOLDER_SIZE + 8], line[256];
    snprintf(path, sizeof path, "%s/%s", folder, LOG);
    FILE *file = fopen(path, "r");
    complaint[0] = '\0';
    while (file && fgets(line, sizeof line, file)) {
        line[strcspn(line, "\n")] = '\0';
        if (complaint[0] == '\0' || strstr(line, "error")) snprintf(complaint, 256, "%s", line);
        if (strstr(line, "error")) break;
    }
    if (file) fclose(file);
}

static hci_status refuse(const char *folder, int code, hci_note *note)
{
    char complaint[256];
    if (code == 127)
        return hci_note_set(note, HCI_ERROR_OUTPUT,
                            "no C compiler: found none named `%s`; install one (Debian: gcc), name another "
                            "in the environment variable CC, or give --sources-only",
                            compiler());
    read_complaint(folder, complaint);
    return hci_note_set(note, HCI_ERROR_OUTPUT,
                        "`%s` did not compile the FMU: %s; name another compiler in the environment variable "
                        "CC, or give --sources-only",
                        compiler(), complaint[0] ? complaint : "it was ended");
}

hci_status cli_compile(void *context, const char *folder, const char *const *sources, size_t count,
                       const char *library, hci_note *note)
{
    char *words = strdup(compiler());
    char **command = words ? make_command(words, sources, count, library) : NULL;
    int code = 0;
    (void)context;
    if (command) code = run_in(folder, command);
    const bool is_made = command != NULL;
    free(command);
    free(words);
    if (!is_made) return hci_note_memory(note, NULL, "the compiler's command");
    return code == 0 ? HCI_OK : refuse(folder, code, note);
}
