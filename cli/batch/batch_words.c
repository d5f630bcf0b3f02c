#include "cli/batch/batch_words.h"

#include <stdio.h>
#include <string.h>

#include "hci/host/base/spelling.h"
#include "hci/host/base/text.h"

static const char *const OWN[] = {"motor", "serial", "batch", "date", "machine", "logs", NULL};
static const char *const NOT_HERE[] = {"out", "json", "quiet", "color", "help", "again", NULL};

/* ---- words ---- */

void cli_batch_add(cli_batch_words *words, const char *word)
{
    const size_t size = strlen(word) + 1;
    words->is_full =
        words->is_full || words->count == CLI_BATCH_MOST_WORDS || words->used + size > sizeof words->text;
    if (words->is_full) return;
    words->word[words->count++] = memcpy(words->text + words->used, word, size);
    words->word[words->count] = NULL;
    words->used += size;
}

/* A path of the list, from the folder of the list. */
static void add_path(const cli_batch *b, const char *path, bool from_here, cli_batch_words *words)
{
    char text[4096];
    const char *slash = from_here && path[0] != '/' ? strrchr(b->path, '/') : NULL;
    const int folder = slash ? (int)(slash + 1 - b->path) : 0;
    if (snprintf(text, sizeof text, "%.*s%s", folder, b->path, path) < (int)sizeof text)
        cli_batch_add(words, text);
    else
        words->is_full = true;
}

/* Logs stand between semicolons. */
static void add_logs(const cli_batch *b, const char *logs, bool from_here, cli_batch_words *words)
{
    while (*logs) {
        char log[4096];
        const size_t length = strcspn(logs, ";"), blanks = strspn(logs, " ");
        if (length > blanks && length < sizeof log) {
            snprintf(log, sizeof log, "%.*s", (int)(length - blanks), logs + blanks);
            add_path(b, log, from_here, words);
        }
        logs += length + (logs[length] == ';');
    }
}

/* ---- columns ---- */

static bool is_listed(const char *const *list, const char *name)
{
    for (; *list; ++list)
        if (hci_text_is(name, *list)) return true;
    return false;
}

/* The option that a column is named by, `pole_pairs` as well as `pole-pairs`; NULL: none. */
static const cli_option *option_of(const cli_command *command, const char *column)
{
    char name[64];
    int at;
    snprintf(name, sizeof name, "%s", column);
    for (char *c = name; *c; ++c)
        if (*c == '_') *c = '-';
    at = is_listed(NOT_HERE, name) ? -1 : cli_option_find(command->options, name, strlen(name));
    return at < 0 ? NULL : &command->options[at];
}

static void add_option(const cli_batch *b, const cli_option *option, const char *cell, bool from_here,
                       cli_batch_words *words)
{
    char name[72];
    if (cell[0] == '\0' || (option->kind == CLI_FLAG && hci_text_is(cell, "no"))) return;
    snprintf(name, sizeof name, "--%s", option->name);
    cli_batch_add(words, name);
    if (option->kind == CLI_FLAG || (option->kind == CLI_COUNT_OPTIONAL && hci_text_is(cell, "yes"))) return;
    if (option->kind == CLI_FILE || option->kind == CLI_FOLDER)
        add_path(b, cell, from_here, words);
    else
        cli_batch_add(words, cell);
}

void cli_batch_words_of(const cli_batch *b, size_t motor, bool from_here, cli_batch_words *words)
{
    const char *machine = hci_fleet_cell(&b->list, motor, "machine");
    words->count = words->used = 0;
    words->is_full = false;
    if (!from_here) cli_batch_add(words, b->command->name);
    if (machine[0]) add_path(b, machine, from_here, words);
    add_logs(b, hci_fleet_cell(&b->list, motor, "logs"), from_here, words);
    for (size_t k = 0; k < hci_csv_columns(b->list.csv); ++k) {
        const char *name = hci_csv_name(b->list.csv, k);
        const cli_option *option = is_listed(OWN, name) ? NULL : option_of(b->command, name);
        if (option) add_option(b, option, hci_fleet_cell(&b->list, motor, name), from_here, words);
    }
    for (size_t k = 0; k < b->commons; ++k)
        cli_batch_add(words, b->common[k]);
}

void cli_batch_paths_of(const cli_batch *b, size_t motor, cli_batch_words *words)
{
    words->count = words->used = 0;
    words->is_full = false;
    add_path(b, hci_fleet_cell(&b->list, motor, "machine"), true, words);
    cli_batch_add(words, "--runs");
    add_path(b, hci_fleet_cell(&b->list, motor, "runs"), true, words);
}

static const char *nearest(const cli_batch *b, const char *name)
{
    const char *names[CLI_MOST_OPTIONS + 8];
    size_t count = 0;
    for (const char *const *own = OWN; *own; ++own)
        names[count++] = *own;
    for (const cli_option *o = b->command->options; o->name; ++o)
        if (!is_listed(NOT_HERE, o->name)) names[count++] = o->name;
    names[count] = NULL;
    return hci_nearest(name, names);
}

hci_status cli_batch_check(const cli_batch *b, hci_note *note)
{
    for (size_t k = 0; k < hci_csv_columns(b->list.csv); ++k) {
        const char *name = hci_csv_name(b->list.csv, k), *near;
        if (is_listed(OWN, name) || option_of(b->command, name)) continue;
        near = nearest(b, name);
        return hci_note_set(
            note, HCI_ERROR_INPUT,
            "%s: column %zu: found `%.60s`, expected motor, serial, batch, date, machine, logs or an "
            "option of %s%s%s%s; rename or remove the column",
            b->path, k + 1, name, b->command->name, near ? " (did you mean `" : "", near ? near : "",
            near ? "`?)" : "");
    }
    return HCI_OK;
}
