#include "cli/tune/words/tune_go_on.h"

#include <stdio.h>
#include <string.h>

#include "cli/tune/tune_commands.h"
#include "cli/tune/tune_options.h"

#define NEW_LOGS "NEW.csv"

/* A command line as it is typed. */
typedef struct {
    char text[4096];
    size_t used;
} call;

/* One that has no room is marked by its length. */
static void add(call *c, const char *text, size_t length)
{
    if (c->used + length < sizeof c->text) memcpy(c->text + c->used, text, length);
    c->used += length;
    if (c->used < sizeof c->text) c->text[c->used] = '\0';
}

static void add_word(call *c, const char *word)
{
    const bool is_plain = cli_tune_is_plain(word);
    add(c, is_plain ? " " : " '", is_plain ? 1 : 2);
    for (; *word != '\0'; ++word)
        add(c, *word == '\'' ? "'\\''" : word, *word == '\'' ? 4 : 1);
    if (!is_plain) add(c, "'", 1);
}

static void add_name(call *c, const char *name)
{
    add(c, " --", 3);
    add(c, name, strlen(name));
}

/* Those of all commands say nothing of the recordings. */
static void add_options(const cli_arguments *a, call *c)
{
    for (int k = 0; cli_tune_options[k].name != NULL; ++k) {
        const cli_option *option = &cli_tune_options[k];
        if (!a->given[k] || option->is_common || option->repeats) continue;
        add_name(c, option->name);
        if (a->value[k] != NULL) add_word(c, a->value[k]);
    }
    for (size_t k = 0; k < a->repeats; ++k) {
        add_name(c, "column");
        add_word(c, a->repeated[k]);
    }
}

/* Whether what is to be done next is to record, and not to mend a log or its options. */
static bool is_to_record(const cli_tuning *t)
{
    return t->tuning.part[HCI_TUNING_NEXT][0] != '\0' && !t->has_slip && !t->has_no_angle &&
           !t->is_not_followed && !t->has_standstill && !cli_tune_is_blocked(t);
}

void cli_tune_say_go_on(cli_tuning *t)
{
    const cli_arguments *a = t->arguments;
    const bool has_list = a->given[TUNE_RUNS];
    call c = {"hci-solve tune", strlen("hci-solve tune")};
    for (size_t k = 0; k < a->words; ++k)
        add_word(&c, a->word[k]);
    if (!has_list) add_word(&c, NEW_LOGS);
    add_options(a, &c);
    if (!is_to_record(t) || c.used >= sizeof c.text) return;
    if (has_list)
        hci_tuning_say(&t->tuning, HCI_TUNING_NEXT,
                       "Then add the new recordings to %s, a row each, and give the same call again:",
                       a->value[TUNE_RUNS]);
    else
        hci_tuning_say(&t->tuning, HCI_TUNING_NEXT,
                       "Then the same call with the new recordings, one or several, in the place of " NEW_LOGS
                       " (--out may be the same):");
    hci_tuning_say(&t->tuning, HCI_TUNING_NEXT, "  %s", c.text);
}
