#define _POSIX_C_SOURCE 200809L

#include "cli/command/parse.h"

#include <ctype.h>
#include <math.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>

#include "hci/host/base/number.h"
#include "hci/host/base/spelling.h"
#include "hci/host/base/unit.h"

/* ---- words ---- */

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

/* "`--limit-current`, `--limit-voltage`": options with the same first part, or letter; false: there are none.
 */
static bool say_family(const char *name, const char *const *names, char *text, size_t size)
{
    const size_t length = strcspn(name, "-");
    const bool is_letter = length == 1 && name[1] == '\0';
    size_t used = 0;
    if (name[length] == '\0' && !is_letter) return false;
    for (; *names && used < size; ++names)
        if (strncmp(*names, name, length) == 0 && (is_letter || (*names)[length] == '-'))
            used += (size_t)snprintf(text + used, size - used, "%s`--%s`", used > 0 ? ", " : "", *names);
    return used > 0;
}

static hci_status unknown_option(const cli_command *command, const char *word, hci_note *note)
{
    const char *names[CLI_MOST_OPTIONS + 1] = {NULL}, *nearest;
    char name[32], family[240] = "";
    for (int k = 0; k < CLI_MOST_OPTIONS && command->options[k].name; ++k)
        names[k] = command->options[k].name;
    snprintf(name, sizeof name, "%.*s", (int)strcspn(word + 1, "="), word + (word[1] == '-' ? 2 : 1));
    name[strcspn(name, "=")] = '\0';
    for (char *at = name; *at; ++at)
        *at = (char)tolower((unsigned char)*at);
    nearest = hci_nearest(name, names);
    if (nearest == NULL && say_family(name, names, family, sizeof family))
        return hci_note_set(note, HCI_ERROR_ARGUMENT,
                            "%s: unknown option `%s`; those that begin so are %s; see hci-solve %s --help",
                            command->name, word, family, command->name);
    return hci_note_set(note, HCI_ERROR_ARGUMENT, "%s: unknown option `%s`;%s%s%s see hci-solve %s --help",
                        command->name, word, nearest ? " did you mean `--" : "", nearest ? nearest : "",
                        nearest ? "`?" : "", command->name);
}

/* What is read: words[at] of `count`. */
typedef struct {
    const cli_command *command;
    char *const *words;
    int count, at;
} reader;

/* The place of the option that a word begins with; -1: none. */
static int option_of(const reader *r, const char *word, const char *equals)
{
    const cli_option *options = r->command->options;
    if (word[1] == '-')
        return cli_option_find(options, word + 2, equals ? (size_t)(equals - word) - 2 : strlen(word) - 2);
    return word[2] == '\0' ? find_letter(options, word[1]) : -1;
}

/* An option where a value is expected: its value was forgotten. */
static bool is_option(const reader *r, const char *word)
{
    return word[0] == '-' && word[1] != '\0' && option_of(r, word, strchr(word, '=')) >= 0;
}

static bool is_path(const cli_option *option)
{
    return option->kind == CLI_FILE || option->kind == CLI_FOLDER;
}

/* A path that begins as an option does would be one to the next command that it is given to. */
static hci_status check_path(const reader *r, const cli_option *option, const char *value, hci_note *note)
{
    if (!is_path(option) || value[0] != '-' || value[1] == '\0') return HCI_OK;
    return hci_note_set(note, HCI_ERROR_ARGUMENT,
                        "%s: `--%s`: found `%s`, expected %s; a path that begins with `-` is written ./%s",
                        r->command->name, option->name, value, option->value_name, value);
}

/* The value of an option, in the same word after `=` or in the next one. */
static hci_status take_value(reader *r, const cli_option *option, const char **value, hci_note *note)
{
    const char *word = r->words[r->at], *equals = word[1] == '-' ? strchr(word, '=') : NULL;
    const char *next = r->at + 1 < r->count ? r->words[r->at + 1] : NULL;
    const bool may_go_without = option->kind == CLI_COUNT_OPTIONAL;
    if (equals && !cli_option_takes_value(option))
        return hci_note_set(note, HCI_ERROR_ARGUMENT, "%s: `%s` takes no value", r->command->name, word);
    if (equals) {
        *value = equals + 1;
        return check_path(r, option, *value, note);
    }
    if (!cli_option_takes_value(option) || (may_go_without && !is_count(next))) return HCI_OK;
    if (!next)
        return hci_note_set(note, HCI_ERROR_ARGUMENT, "%s: `%s` needs a value: %s", r->command->name, word,
                            option->value_name);
    if (is_option(r, next) && is_path(option))
        return hci_note_set(note, HCI_ERROR_ARGUMENT,
                            "%s: `%s` needs a value: %s; found the option `%s`; a path of that name is "
                            "written ./%s",
                            r->command->name, word, option->value_name, next, next);
    if (is_option(r, next))
        return hci_note_set(
            note, HCI_ERROR_ARGUMENT,
            "%s: `%s` needs a value: %s; found the option `%s`; for a value of that name write --%s=%s",
            r->command->name, word, option->value_name, next, option->name, next);
    *value = r->words[++r->at];
    return check_path(r, option, *value, note);
}

static hci_status take_option(reader *r, cli_arguments *a, hci_note *note)
{
    const char *word = r->words[r->at];
    const int k = option_of(r, word, strchr(word, '='));
    if (k < 0) return unknown_option(r->command, word, note);
    if (a->given[k] && !r->command->options[k].repeats)
        return hci_note_set(note, HCI_ERROR_ARGUMENT, "%s: `%s` is given twice", r->command->name, word);
    a->given[k] = true;
    if (r->command->options[k].repeats && a->repeats == CLI_MOST_REPEATS)
        return hci_note_set(note, HCI_ERROR_ARGUMENT, "%s: `%s` is given more than %d times, expected fewer",
                            r->command->name, word, CLI_MOST_REPEATS);
    const hci_status status = take_value(r, &r->command->options[k], &a->value[k], note);
    if (!status && r->command->options[k].repeats) a->repeated[a->repeats++] = a->value[k];
    return status;
}

/* The option behind dashes of other kinds, which word processors make of "--"; -1: none. */
static int option_behind_dashes(const reader *r, const char *word)
{
    static const char DASHES[] =
        "\xE2\x80\x90 \xE2\x80\x91 \xE2\x80\x92 \xE2\x80\x93 \xE2\x80\x94 \xE2\x88\x92";
    bool is_other = false;
    for (;;) {
        char dash[4] = "";
        memcpy(dash, word, strnlen(word, 3));
        const bool is_long = (unsigned char)dash[0] == 0xE2 && dash[2] && strstr(DASHES, dash);
        if (!is_long && word[0] != '-') break;
        is_other = is_other || is_long;
        word += is_long ? 3 : 1;
    }
    return is_other && word[0] ? cli_option_find(r->command->options, word, strcspn(word, "=")) : -1;
}

static hci_status take_word(const reader *r, cli_arguments *a, hci_note *note)
{
    const int dashed = option_behind_dashes(r, r->words[r->at]);
    if (dashed >= 0)
        return hci_note_set(
            note, HCI_ERROR_ARGUMENT,
            "%s: found `%s`, which begins with another dash than `-`, as word processors make "
            "it; write --%s with two of the keyboard",
            r->command->name, r->words[r->at], r->command->options[dashed].name);
    if (r->words[r->at][0] == '\0')
        return hci_note_set(note, HCI_ERROR_ARGUMENT,
                            "%s: found an empty word, expected %s; is a variable of the shell not set?",
                            r->command->name, r->command->words);
    if (a->words == CLI_MOST_WORDS)
        return hci_note_set(
            note, HCI_ERROR_ARGUMENT,
            "%s: found more than %d words; give fewer at a time, or a list where it takes one",
            r->command->name, CLI_MOST_WORDS);
    a->word[a->words++] = r->words[r->at];
    return HCI_OK;
}

/* Two words that are one path with a blank in it, as a shell cuts it without quotes. */
static hci_status check_blanks(const cli_command *c, const cli_arguments *a, hci_note *note)
{
    char path[1024];
    for (size_t k = 0; k + 1 < a->words; ++k) {
        const int length = snprintf(path, sizeof path, "%s %s", a->word[k], a->word[k + 1]);
        if (length < 0 || (size_t)length >= sizeof path || access(path, F_OK) != 0) continue;
        if (access(a->word[k], F_OK) == 0 && access(a->word[k + 1], F_OK) == 0) continue;
        return hci_note_set(
            note, HCI_ERROR_ARGUMENT,
            "%s: found the words `%s` and `%s`, which are one path with a blank in it; put it "
            "in quotes: '%s'",
            c->name, a->word[k], a->word[k + 1], path);
    }
    return HCI_OK;
}

static hci_status check_word_count(const cli_command *c, const cli_arguments *a, hci_note *note)
{
    const hci_status status = check_blanks(c, a, note);
    if (status) return status;
    if (a->words == c->words_needed || (a->words > c->words_needed && c->takes_more_words)) return HCI_OK;
    return hci_note_set(
        note, HCI_ERROR_ARGUMENT, "%s: found %zu word%s, expected %zu%s: %s;%s see hci-solve %s --help",
        c->name, a->words, a->words == 1 ? "" : "s", c->words_needed, c->takes_more_words ? " or more" : "",
        c->words, a->words > c->words_needed ? " a path with a blank in it goes into quotes;" : "", c->name);
}

static void clear(cli_arguments *a)
{
    memset(a, 0, sizeof *a);
    for (int k = 0; k < CLI_MOST_OPTIONS; ++k)
        a->number[k] = NAN;
}

hci_status cli_parse_words(const cli_command *command, int count, char *const *words,
                           cli_arguments *arguments, hci_note *note)
{
    reader r = {command, words, count, 0};
    hci_status status = HCI_OK;
    bool only_words = false;
    clear(arguments);
    for (; r.at < count && !status; ++r.at) {
        const char *word = words[r.at];
        if (!only_words && strcmp(word, "--") == 0)
            only_words = true;
        else if (!only_words && word[0] == '-' && word[1] != '\0')
            status = take_option(&r, arguments, note);
        else
            status = take_word(&r, arguments, note);
    }
    return status ? status : check_word_count(command, arguments, note);
}

/* ---- values ---- */

/* A number and letters behind it. */
static bool has_unit(const char *text)
{
    char number[32];
    double value;
    const size_t length = strspn(text, "+-.0123456789");
    if (length == 0 || length >= sizeof number || text[length] == '\0' || strchr(",:;", text[length]))
        return false;
    memcpy(number, text, length);
    number[length] = '\0';
    return hci_number_parse(number, &value);
}

/* A number with a decimal comma. */
static bool has_comma(const char *text)
{
    char number[32];
    double value;
    const char *comma = strchr(text, ',');
    if (!comma || strlen(text) >= sizeof number) return false;
    strcpy(number, text);
    number[comma - text] = '.';
    return hci_number_parse(number, &value);
}

static const char *remedy_of(const cli_option *o, const char *text)
{
    if (o->remedy) return o->remedy;
    if (has_comma(text)) return "write a decimal point in place of the comma";
    return has_unit(text) ? "give the number without its unit" : NULL;
}

/* Whether an option takes a number. */
static bool is_taken(const cli_option *o, double value)
{
    const double step = o->step > 1 ? o->step : 1;
    return value >= o->low && value <= o->high && (o->kind == CLI_NUMBER || fmod(value, step) == 0.0);
}

/* By how much a number is more in the unit that an option's value is named by (KGM2, NM_PER_A) than in the
 * one behind it; false: of another quantity, or not known. Of options that name no unit, 1. */
static bool factor_of(const cli_option *o, const char *unit, double *factor)
{
    char wanted[32] = "";
    for (size_t k = 0; o->value_name[k] && k + 1 < sizeof wanted; ++k)
        wanted[k] = (char)tolower((unsigned char)o->value_name[k]);
    *factor = 1.0;
    unit += strspn(unit, " ");
    return *unit == '\0' || !hci_unit_factor(wanted, wanted, factor) || hci_unit_factor(unit, wanted, factor);
}

/* The number that a text with a unit behind it, or with a decimal comma, most likely means, in the option's
 * unit: 28.5 of `28,5rpm/V`, 2e-07 of `2gcm2`; false: none that the option takes. */
static bool meant_of(const cli_option *o, const char *text, char meant[32])
{
    double value, factor;
    size_t length = strspn(text, "+-0123456789.,eE");
    if (hci_number_parse(text, &value)) return false;
    snprintf(meant, 32, "%.*s", (int)(length < 31 ? length : 31), text);
    char *comma = strchr(meant, ',');
    if (comma) *comma = '.';
    while (*meant && !hci_number_parse(meant, &value))
        meant[strlen(meant) - 1] = '\0';
    if (!*meant || !factor_of(o, text + strlen(meant), &factor) || !is_taken(o, value * factor)) return false;
    if (factor != 1.0) snprintf(meant, 32, "%.6g", value * factor);
    return true;
}

static hci_status wrong_number(const cli_option *o, const char *text, hci_note *note)
{
    const char *what = o->kind == CLI_NUMBER ? "a number"
                       : o->step == 2        ? "an even number"
                       : o->step == 3        ? "a multiple of 3"
                                             : "a whole number";
    const char *remedy = remedy_of(o, text);
    char meant[32], write[96] = "";
    if (meant_of(o, text, meant)) snprintf(write, sizeof write, "; write --%s %s", o->name, meant);
    return hci_note_set(note, HCI_ERROR_ARGUMENT, "--%s: found `%.60s`, expected %s from %g to %g%s%s%s",
                        o->name, text, what, o->low, o->high, remedy ? "; " : "", remedy ? remedy : "",
                        write);
}

static hci_status read_number(const cli_option *o, const char *text, double *number, hci_note *note)
{
    const bool is_whole = o->kind != CLI_NUMBER;
    if (!hci_number_parse(text, number) || !(*number >= o->low && *number <= o->high) ||
        (is_whole && fmod(*number, o->step > 1 ? o->step : 1) != 0.0))
        return wrong_number(o, text, note);
    return HCI_OK;
}

static hci_status read_choice(const cli_option *o, const char *text, int *choice, hci_note *note)
{
    char list[128] = "";
    const char *words[32] = {NULL}, *nearest;
    for (*choice = 0; o->choices[*choice].word; ++*choice) {
        const char *word = o->choices[*choice].word;
        const size_t used = strlen(list);
        if (strcmp(word, text) == 0) return HCI_OK;
        if (*choice + 1 < (int)(sizeof words / sizeof *words)) words[*choice] = word;
        snprintf(list + used, sizeof list - used, "%s%s", used ? ", " : "", word);
    }
    nearest = hci_nearest(text, words);
    return hci_note_set(note, HCI_ERROR_ARGUMENT, "--%s: found `%s`, expected one of: %s%s%s%s%s%s", o->name,
                        text, list, nearest ? "; did you mean `" : "", nearest ? nearest : "",
                        nearest ? "`?" : "", o->remedy ? "; " : "", o->remedy ? o->remedy : "");
}

hci_status cli_parse_value(const cli_option *options, int option, cli_arguments *a, hci_note *note)
{
    const cli_option *o = &options[option];
    const char *text = a->value[option];
    if (!text) return HCI_OK;
    switch (o->kind) {
    case CLI_COUNT_OPTIONAL:
    case CLI_NUMBER:
    case CLI_WHOLE:
        return read_number(o, text, &a->number[option], note);
    case CLI_CHOICE:
        return read_choice(o, text, &a->choice[option], note);
    case CLI_FLAG:
    case CLI_FILE:
    case CLI_FOLDER:
    case CLI_TEXT:
        break;
    }
    return HCI_OK;
}

hci_status cli_parse_values(const cli_option *options, cli_arguments *arguments, hci_note *note)
{
    hci_status status = HCI_OK;
    for (int k = 0; options[k].name && !status; ++k)
        status = cli_parse_value(options, k, arguments, note);
    return status;
}

double cli_number_or(const cli_arguments *a, int option, double otherwise)
{
    return isnan(a->number[option]) ? otherwise : a->number[option];
}
