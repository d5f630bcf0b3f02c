#define _POSIX_C_SOURCE 200809L

#include <stdio.h>
#include <string.h>
#include <unistd.h>

#include "cli/command/command.h"
#include "hci/host/base/number.h"

/* Index of an option by its long name (up to `length` characters) or its letter; -1 when there is none. */
static int find_option(const cli_option *options, const char *name, size_t length)
{
    for (int k = 0; options[k].name; ++k)
        if (strlen(options[k].name) == length && strncmp(options[k].name, name, length) == 0) return k;
    return -1;
}

static int find_letter(const cli_option *options, char letter)
{
    for (int k = 0; options[k].name; ++k)
        if (options[k].letter == letter) return k;
    return -1;
}

static bool is_count(const char *text)
{
    return text && text[0] != '\0' && strspn(text, "0123456789") == strlen(text);
}

int cli_option_find(const cli_command *command, const char *name)
{
    return find_option(command->options, name, strlen(name));
}

/* ---- what was probably meant ---- */

enum { MOST_LETTERS = 24, FAR = 1000 };

static int least(int a, int b)
{
    return a < b ? a : b;
}

/* Letters to put in, take out, change or swap with their neighbour, to make one word of another. */
static int distance(const char *a, const char *b)
{
    int d[MOST_LETTERS + 1][MOST_LETTERS + 1];
    const int m = (int)strlen(a), n = (int)strlen(b);
    if (m > MOST_LETTERS || n > MOST_LETTERS) return FAR;
    for (int i = 0; i <= m; ++i)
        d[i][0] = i;
    for (int j = 0; j <= n; ++j)
        d[0][j] = j;
    for (int i = 1; i <= m; ++i)
        for (int j = 1; j <= n; ++j) {
            d[i][j] = least(least(d[i - 1][j], d[i][j - 1]) + 1, d[i - 1][j - 1] + (a[i - 1] != b[j - 1]));
            if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1])
                d[i][j] = least(d[i][j], d[i - 2][j - 2] + 1);
        }
    return d[m][n];
}

const char *cli_nearest(const char *word, const char *const *names)
{
    const char *nearest = NULL;
    int best = 1 + (int)strlen(word) / 3; /* one mistake in three letters */
    if (strlen(word) < 2) return NULL;
    for (; *names; ++names) {
        const bool begins = strlen(word) > 2 && strncmp(*names, word, strlen(word)) == 0;
        const int far = begins ? 0 : distance(word, *names);
        if (far >= best) continue;
        best = far;
        nearest = *names;
    }
    return nearest;
}

static hci_status unknown_option(const cli_command *command, const char *word, hci_note *note)
{
    const char *names[CLI_MOST_OPTIONS + 1] = {NULL}, *nearest;
    char name[MOST_LETTERS + 1] = "";
    for (int k = 0; k < CLI_MOST_OPTIONS && command->options[k].name; ++k)
        names[k] = command->options[k].name;
    snprintf(name, sizeof name, "%.*s", (int)strcspn(word + 1, "="), word + (word[1] == '-' ? 2 : 1));
    name[strcspn(name, "=")] = '\0';
    nearest = cli_nearest(name, names);
    if (nearest)
        return hci_note_set(note, HCI_ERROR_ARGUMENT,
                            "%s: unknown option `%s`; did you mean `--%s`? see hci-solve %s --help",
                            command->name, word, nearest, command->name);
    return hci_note_set(note, HCI_ERROR_ARGUMENT, "%s: unknown option `%s`; see hci-solve %s --help",
                        command->name, word, command->name);
}

/* ---- parsing ---- */

/* One option at words[*at], with its value in the same word after `=` or in the next one. */
static hci_status take_option(const cli_command *command, int count, char *const *words, int *at,
                              cli_arguments *a, hci_note *note)
{
    const char *word = words[*at], *equals = strchr(word, '=');
    const bool is_long = word[1] == '-';
    const size_t length = equals ? (size_t)(equals - word) - 2 : strlen(word) - 2;
    const char *next = *at + 1 < count ? words[*at + 1] : NULL;
    const int k =
        is_long ? find_option(command->options, word + 2, length) : find_letter(command->options, word[1]);
    if (k < 0 || (!is_long && word[2] != '\0')) return unknown_option(command, word, note);
    if (a->given[k])
        return hci_note_set(note, HCI_ERROR_ARGUMENT, "%s: `%s` is given twice", command->name, word);
    a->given[k] = true;
    if (is_long && equals && command->options[k].kind == CLI_FLAG)
        return hci_note_set(note, HCI_ERROR_ARGUMENT, "%s: `%s` takes no value", command->name, word);
    if (is_long && equals) {
        a->value[k] = equals + 1;
    } else if (command->options[k].kind == CLI_VALUE) {
        if (!next)
            return hci_note_set(note, HCI_ERROR_ARGUMENT, "%s: `%s` needs a value: %s", command->name, word,
                                command->options[k].value_name);
        a->value[k] = words[++*at];
    } else if (command->options[k].kind == CLI_COUNT_OPTIONAL && is_count(next)) {
        a->value[k] = words[++*at];
    }
    return HCI_OK;
}

hci_status cli_parse(const cli_command *command, int count, char *const *words, cli_arguments *arguments,
                     hci_note *note)
{
    hci_status status = HCI_OK;
    bool only_words = false;
    memset(arguments, 0, sizeof *arguments);
    for (int k = 0; k < count && !status; ++k) {
        if (!only_words && strcmp(words[k], "--") == 0)
            only_words = true;
        else if (!only_words && words[k][0] == '-' && words[k][1] != '\0')
            status = take_option(command, count, words, &k, arguments, note);
        else if (arguments->words < CLI_MOST_WORDS)
            arguments->word[arguments->words++] = words[k];
    }
    const bool more = (command->words_needed & CLI_OR_MORE) != 0;
    const size_t needed = command->words_needed & ~(size_t)CLI_OR_MORE;
    if (!status && (arguments->words < needed || (arguments->words > needed && !more)))
        status = hci_note_set(
            note, HCI_ERROR_ARGUMENT, "%s: found %zu words, expected %zu%s: %s; see hci-solve %s --help",
            command->name, arguments->words, needed, more ? " or more" : "", command->words, command->name);
    return status;
}

hci_status cli_number(const char *option, const char *text, double low, double high, double *value,
                      hci_note *note)
{
    if (hci_number_parse(text, value) && *value >= low && *value <= high) return HCI_OK;
    return hci_note_set(note, HCI_ERROR_ARGUMENT, "--%s: found `%s`, expected a number from %g to %g", option,
                        text, low, high);
}

hci_status cli_choice(const char *option, const char *text, const char *const *choices, int *value,
                      hci_note *note)
{
    char list[128] = "";
    for (*value = 0; choices[*value]; ++*value) {
        const size_t used = strlen(list);
        if (strcmp(choices[*value], text) == 0) return HCI_OK;
        snprintf(list + used, sizeof list - used, "%s%s", used ? ", " : "", choices[*value]);
    }
    return hci_note_set(note, HCI_ERROR_ARGUMENT, "--%s: found `%s`, expected one of: %s", option, text,
                        list);
}

/* ---- help ---- */

/* Lines that are too long are continued as far in as they begin. */
static void print_text(const char *text, int width)
{
    while (*text) {
        char line[1024];
        const size_t length = strcspn(text, "\n");
        snprintf(line, sizeof line, "%.*s", (int)length, text);
        if (*line)
            cli_print_wrapped(stdout, width, 0, (int)strspn(line, " "), line);
        else
            putchar('\n');
        text += length + (text[length] == '\n');
    }
}

static void option_text(const cli_option *o, char *text, size_t size)
{
    const bool optional = o->kind == CLI_COUNT_OPTIONAL;
    snprintf(text, size, "%c%c%c --%s%s%s%s%s", o->letter ? '-' : ' ', o->letter ? o->letter : ' ',
             o->letter ? ',' : ' ', o->name, o->value_name ? " " : "", optional ? "[" : "",
             o->value_name ? o->value_name : "", optional ? "]" : "");
}

static bool is_common(const cli_option *o)
{
    static const char *const NAMES[] = {"json", "quiet", "color", "help"};
    for (size_t k = 0; k < sizeof NAMES / sizeof *NAMES; ++k)
        if (strcmp(o->name, NAMES[k]) == 0) return true;
    return false;
}

static int widest_option(const cli_option *o)
{
    size_t widest = 0;
    for (; o->name; ++o) {
        char left[64];
        option_text(o, left, sizeof left);
        if (strlen(left) > widest) widest = strlen(left);
    }
    return (int)widest;
}

static void print_options(const cli_command *command, bool common, const char *title, int width)
{
    const int at = widest_option(command->options) + 4;
    for (const cli_option *o = command->options; o->name; ++o) {
        char left[64];
        if (is_common(o) != common) continue;
        if (title) printf("\n%s\n", title);
        title = NULL;
        option_text(o, left, sizeof left);
        printf("  %-*s", at - 2, left);
        cli_print_wrapped(stdout, width, at, at, o->help);
    }
}

void cli_print_help(const cli_command *command)
{
    const int width = cli_width(STDOUT_FILENO);
    const char *codes = strstr(command->example, "\nExit codes: ");
    const size_t length = codes ? (size_t)(codes - command->example) : strlen(command->example);
    printf("hci-solve %s %s [OPTIONS]\n\n", command->name, command->words);
    print_text(command->does, width);
    print_options(command, false, "Options", width);
    print_options(command, true, "Options of every command", width);
    printf("\nExample\n%.*s", (int)length, command->example);
    if (codes) print_text(codes, width);
}
