#include <stdio.h>
#include <string.h>

#include "cli.h"
#include "hci/host/csv.h"

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
    if (k < 0 || (!is_long && word[2] != '\0'))
        return hci_note_set(note, HCI_ERROR_ARGUMENT, "%s: unknown option `%s`; see hci-solve %s --help",
                            command->name, word, command->name);
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
    if (!status && arguments->words != command->words_needed)
        status = hci_note_set(note, HCI_ERROR_ARGUMENT,
                              "%s: found %zu words, expected %zu: %s; see hci-solve %s --help", command->name,
                              arguments->words, command->words_needed, command->words, command->name);
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

void cli_print_help(const cli_command *command)
{
    printf("hci-solve %s %s [OPTIONS]\n\n%s\n\n", command->name, command->words, command->does);
    for (const cli_option *o = command->options; o->name; ++o) {
        char left[64];
        const bool optional = o->kind == CLI_COUNT_OPTIONAL;
        snprintf(left, sizeof left, "%c%c%c --%s%s%s%s%s", o->letter ? '-' : ' ', o->letter ? o->letter : ' ',
                 o->letter ? ',' : ' ', o->name, o->value_name ? " " : "", optional ? "[" : "",
                 o->value_name ? o->value_name : "", optional ? "]" : "");
        printf("  %-34s %s\n", left, o->help);
    }
    printf("\nExample\n%s", command->example);
}
