#define _XOPEN_SOURCE 700

#include "fuzzing.h"

#include <ctype.h>
#include <dirent.h>
#include <errno.h>
#include <fcntl.h>
#include <ftw.h>
#include <limits.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "cli/command/command.h"
#include "hci/host/base/utf8.h"

enum { MOST_FILES = 64, MOST_NAME = 64, MOST_WORDS = 64 };

/* Where the process itself says something while a command's own words are kept apart. */
static int own_stderr = 2;

void fuzz_require(bool promise, const char *text)
{
    if (promise) return;
    dprintf(own_stderr, "broken promise: %s\n", text);
    abort();
}

/* ---- the working folder ---- */

static char home[64];

static int remove_one(const char *path, const struct stat *info, int kind, struct FTW *place)
{
    (void)info, (void)kind;
    return place->level == 0 ? 0 : remove(path);
}

static void leave_home(void)
{
    nftw(home, remove_one, 16, FTW_DEPTH | FTW_PHYS);
    if (chdir("/") == 0) rmdir(home);
}

static void make_home(void)
{
    const bool in_memory = access("/dev/shm", W_OK) == 0;
    snprintf(home, sizeof home, "%s/hci-fuzz-XXXXXX", in_memory ? "/dev/shm" : "/tmp");
    fuzz_require(mkdtemp(home) != NULL, "a folder to work in");
    atexit(leave_home);
}

static bool is_name(const char *name)
{
    const size_t length = strlen(name);
    return length > 0 && name[0] != '/' && name[length - 1] != '/' && strstr(name, "..") == NULL &&
           strstr(name, "//") == NULL && strstr(name, "./") == NULL;
}

/* Folders above a file. A file that stands where a folder should be leaves the name out. */
static void write_file(char *name, const uint8_t *text, size_t size)
{
    for (char *slash = strchr(name, '/'); slash != NULL; slash = strchr(slash + 1, '/')) {
        *slash = '\0';
        mkdir(name, 0777);
        *slash = '/';
    }
    const int file = open(name, O_WRONLY | O_CREAT | O_TRUNC, 0666);
    if (file < 0) return;
    fuzz_require(write(file, text, size) == (ssize_t)size, "a file that is written");
    close(file);
}

static const uint8_t *find_mark(const uint8_t *at, const uint8_t *end)
{
    for (; end - at >= 4; ++at)
        if (memcmp(at, "\n@@ ", 4) == 0) return at;
    return end;
}

/* One `NAME\ntext`. */
static void unpack_one(const uint8_t *at, const uint8_t *end)
{
    const uint8_t *line = memchr(at, '\n', (size_t)(end - at));
    char name[MOST_NAME] = "";
    if (line == NULL || line - at >= MOST_NAME) return;
    memcpy(name, at, (size_t)(line - at));
    if (strlen(name) == (size_t)(line - at) && is_name(name))
        write_file(name, line + 1, (size_t)(end - line - 1));
}

void fuzz_unpack(const uint8_t *data, size_t size)
{
    const uint8_t *end = data + size, *at = data;
    if (home[0] == '\0') make_home();
    nftw(home, remove_one, 16, FTW_DEPTH | FTW_PHYS);
    fuzz_require(chdir(home) == 0, "the folder to work in");
    if (size < 3 || memcmp(data, "@@ ", 3) != 0)
        at = find_mark(at, end);
    else if (size >= 3)
        --at;
    for (int files = 0; at < end && files < MOST_FILES; ++files) {
        const uint8_t *next = find_mark(at + 4, end);
        unpack_one(at + 4, next);
        at = next;
    }
}

bool fuzz_exists(const char *path)
{
    struct stat info;
    return stat(path, &info) == 0;
}

char *fuzz_read(const char *path, size_t *size)
{
    FILE *file = fopen(path, "rb");
    struct stat info;
    if (file == NULL || fstat(fileno(file), &info) != 0) return NULL;
    char *text = malloc((size_t)info.st_size + 1);
    fuzz_require(text != NULL, "memory for a file");
    *size = fread(text, 1, (size_t)info.st_size, file);
    text[*size] = '\0';
    fclose(file);
    return text;
}

/* ---- what may be said ---- */

void fuzz_check_shown(const char *text)
{
    fuzz_require(hci_utf8_valid(text), "words in UTF-8");
    for (; *text != '\0'; text++)
        fuzz_require((unsigned char)*text >= 0x20 && *text != 0x7F, "no control characters");
}

void fuzz_check_note(hci_status status, const hci_note *note)
{
    fuzz_require((status == HCI_OK) == (note->text[0] == '\0'), "a note with each error, and none without");
    fuzz_check_shown(note->text);
}

/* Lines of standard error: all begin with the program's name. */
static int check_lines(char *text)
{
    int errors = 0;
    for (char *line = strtok(text, "\n"); line != NULL; line = strtok(NULL, "\n")) {
        fuzz_check_shown(line);
        fuzz_require(strncmp(line, "hci-solve: ", 11) == 0, "lines of standard error begin with hci-solve:");
        errors += strncmp(line, "hci-solve: note: ", 17) != 0;
    }
    return errors;
}

/* A number of a file that is none, standing alone between separators. */
static bool is_not_finite(const char *word, size_t length)
{
    char lower[16] = "";
    if (length > 0 && (*word == '-' || *word == '+')) ++word, --length;
    if (length < 3 || length >= sizeof lower) return false;
    for (size_t k = 0; k < length; ++k)
        lower[k] = (char)tolower((unsigned char)word[k]);
    return strcmp(lower, "nan") == 0 || strcmp(lower, "inf") == 0 || strcmp(lower, "infinity") == 0;
}

static void check_numbers(const char *text)
{
    while (*text != '\0') {
        const size_t length = strcspn(text, ",;: \t\n{}[]()");
        fuzz_require(!is_not_finite(text, length), "finite numbers in files");
        text += length + (text[length] != '\0');
    }
}

static int check_file(const char *path, const struct stat *info, int kind, struct FTW *place)
{
    size_t size = 0;
    const char *name = path + place->base, *end = strrchr(name, '.');
    (void)info;
    fuzz_require(name[0] != '.', "no hidden files are left");
    if (kind != FTW_F) return 0;
    char *text = fuzz_read(path, &size);
    fuzz_require(text != NULL && (end != NULL && strcmp(end, ".bin") == 0 ? size > 0 : strlen(text) == size),
                 "files that can be read, without NUL");
    if (end != NULL && strcmp(end, ".bin") != 0) {
        fuzz_require(hci_utf8_valid(text), "files in UTF-8");
        check_numbers(text);
    }
    free(text);
    return 0;
}

/* ---- a command ---- */

typedef struct {
    char *word[MOST_WORDS];
    int count;
} word_list;

/* Words of the file `options`, but for paths that leave the folder and what starts other processes. */
static void add_options(char *text, word_list *words)
{
    for (char *word = strtok(text, " \n"); word != NULL && words->count < MOST_WORDS;
         word = strtok(NULL, " \n"))
        if (strchr(word, '/') == NULL && strstr(word, "..") == NULL && strncmp(word, "--j", 3) != 0)
            words->word[words->count++] = word;
}

typedef struct {
    int kept[2], file[2]; /* standard output, standard error */
} capture;

void __sanitizer_set_report_fd(void *fd) __attribute__((weak));

static void begin_capture(capture *c)
{
    static const char *const name[] = {"/dev/shm/hci-fuzz-said-XXXXXX", "/tmp/hci-fuzz-said-XXXXXX"};
    fflush(stdout);
    for (int k = 0; k < 2; ++k) {
        char path[64];
        strcpy(path, name[access("/dev/shm", W_OK) != 0]);
        c->kept[k] = dup(k + 1);
        c->file[k] = mkstemp(path);
        fuzz_require(c->file[k] >= 0 && unlink(path) == 0 && dup2(c->file[k], k + 1) >= 0,
                     "a captured stream");
    }
    own_stderr = c->kept[1];
    if (__sanitizer_set_report_fd) __sanitizer_set_report_fd((void *)(intptr_t)own_stderr);
}

/* What was said on a stream since then. */
static char *end_capture(capture *c, int k)
{
    struct stat info;
    fflush(stdout);
    dup2(c->kept[k], k + 1);
    close(c->kept[k]);
    fuzz_require(fstat(c->file[k], &info) == 0, "a captured stream");
    char *text = malloc((size_t)info.st_size + 1);
    fuzz_require(text != NULL && pread(c->file[k], text, (size_t)info.st_size, 0) == info.st_size,
                 "its text");
    text[info.st_size] = '\0';
    close(c->file[k]);
    return text;
}

static int run_captured(const cli_command *command, const word_list *words, char *said[2])
{
    capture c;
    begin_capture(&c);
    const int code = cli_command_run(command, words->count, words->word);
    said[0] = end_capture(&c, 0);
    said[1] = end_capture(&c, 1);
    own_stderr = 2;
    if (__sanitizer_set_report_fd) __sanitizer_set_report_fd((void *)2);
    return code;
}

static bool is_json(const word_list *words)
{
    for (int k = 0; k < words->count; ++k)
        if (strcmp(words->word[k], "--json") == 0) return true;
    return false;
}

static void check_end(int code, const word_list *words, char *said[2])
{
    fuzz_require(code >= 0 && code <= 4, "an exit code of an input");
    fuzz_require(hci_utf8_valid(said[0]), "standard output in UTF-8");
    fuzz_require(check_lines(said[1]) == (code > 1 && !is_json(words)),
                 "one line for an error, none without");
    fuzz_require(code <= 1 || is_json(words) || said[0][0] == '\0', "an error without standard output");
    if (code > 1) fuzz_require(!fuzz_exists("out"), "nothing half written");
    if (fuzz_exists("out")) nftw("out", check_file, 16, FTW_PHYS);
}

int fuzz_command(const cli_command *command, const char *const *words)
{
    word_list all = {.count = 0};
    char *said[2];
    size_t size;
    char *options = fuzz_read("options", &size);
    while (words[all.count] != NULL) {
        all.word[all.count] = (char *)(uintptr_t)words[all.count];
        ++all.count;
    }
    if (options != NULL) add_options(options, &all);
    const int code = run_captured(command, &all, said);
    if (getenv("FUZZ_VERBOSE") != NULL) fprintf(stderr, "%s%sexit code %d\n", said[0], said[1], code);
    check_end(code, &all, said);
    free(said[0]);
    free(said[1]);
    free(options);
    return code;
}
