/* The table of options of a command: the one source of its parsing, --help, man page, reference page and the
 * completion of bash and zsh.
 *
 * Order in this folder; a file uses only those before it and the folder terminal:
 *   option    what an option and a command are, and their texts
 *   reading   how recordings are read
 *   same_file whether a result would replace what is read
 *   parse     words of a command line to arguments
 *   help      the text of --help
 *   written   the files that a command wrote
 *   command   from the words to the exit code
 *   jobs      independent work shared out among processes
 *   shard     a share of it */
#ifndef HCI_CLI_OPTION_H
#define HCI_CLI_OPTION_H

#include <stdbool.h>
#include <stddef.h>

/* What follows the name of an option. Completion offers files, folders and choices. */
typedef enum {
    CLI_FLAG,           /* nothing */
    CLI_COUNT_OPTIONAL, /* a whole number, or nothing */
    CLI_NUMBER,         /* a number from low to high */
    CLI_WHOLE,          /* a whole number from low to high */
    CLI_CHOICE,         /* one of the words in choices */
    CLI_FILE,           /* path of a file */
    CLI_FOLDER,         /* path of a folder */
    CLI_TEXT            /* anything else */
} cli_kind;

/* A word that an option accepts, and how the option's help goes on with it; NULL: as the list goes on, "a, b
 * or c". A table of them ends with {NULL, NULL}. */
typedef struct {
    const char *word, *help;
} cli_choice;

/* For lists of the library, X(value, word): an entry at the place of the value. */
#define CLI_CHOICE_OF(value, word) [value] = {word, NULL},

typedef struct {
    const char *name; /* without the dashes; NULL ends a table */
    char letter;      /* short form, or 0 */
    cli_kind kind;
    const char *value_name;
    const char *help; /* choices follow it */

    const cli_choice *choices; /* CLI_CHOICE */
    double low, high;          /* CLI_NUMBER, CLI_WHOLE, CLI_COUNT_OPTIONAL */
    int step;                  /* CLI_WHOLE: a multiple of it; 0 is 1 */
    const char *remedy;        /* what to do about a wrong number or choice, or NULL */
    bool is_common;            /* every command has it */
    bool repeats;              /* may be given more than once; at most one of a table */
} cli_option;

enum { CLI_MOST_OPTIONS = 40, CLI_MOST_REPEATS = 72, CLI_MOST_WORDS = 1024, CLI_HELP_SIZE = 512 };

/* What stands on a command line, by the places of the options in the table. */
typedef struct {
    bool given[CLI_MOST_OPTIONS];
    const char *value[CLI_MOST_OPTIONS];    /* NULL for a flag or a count that was left out */
    double number[CLI_MOST_OPTIONS];        /* NAN where no number is given */
    int choice[CLI_MOST_OPTIONS];           /* place in choices; 0 where none is given */
    const char *repeated[CLI_MOST_REPEATS]; /* the values of an option that repeats, in their order */
    size_t repeats;
    const char *word[CLI_MOST_WORDS]; /* what is no option */
    size_t words;
} cli_arguments;

typedef struct {
    const char *name, *words, *does;
    const cli_option *options;
    size_t words_needed;
    bool takes_more_words; /* beside words_needed: more may follow */
    bool names_files;      /* its words name the files that it wrote */
    cli_kind word_kind;    /* CLI_FILE: they name what is there; CLI_TEXT: they are new names */
    const char *example;
    const char *source;      /* file of the table */
    const char *guide;       /* among the documents, or NULL */
    void (*more_help)(void); /* printed after the help, or NULL */
    int (*run)(const cli_arguments *arguments);
} cli_command;

/* What every command has, in the same words: CLI_COMMON_KEYS ends its enum of options, CLI_COMMON_OPTIONS its
 * table. */
#define CLI_COMMON_KEYS JSON, QUIET, COLOR, HELP
#define CLI_HELP_OPTION                                                                                      \
    {                                                                                                        \
        "help", 'h', CLI_FLAG, NULL, .help = "this text", .is_common = true                                  \
    }
#define CLI_END_OF_OPTIONS                                                                                   \
    {                                                                                                        \
        .name = NULL                                                                                         \
    }

#define CLI_COMMON_OPTIONS                                                                                   \
    [JSON] = {"json",                                                                                        \
              0,                                                                                             \
              CLI_FLAG,                                                                                      \
              NULL,                                                                                          \
              .is_common = true,                                                                             \
              .help = "the summary, or the error, as JSON on standard output in place of the words"},        \
    [QUIET] = {"quiet",           'q',                                                                       \
               CLI_FLAG,          NULL,                                                                      \
               .is_common = true, .help = "no words and no progress, only errors"},                          \
    [COLOR] = {"color", 0, CLI_CHOICE, "WHEN", .is_common = true, .choices = cli_color_choices},             \
    [HELP] = CLI_HELP_OPTION, CLI_END_OF_OPTIONS

/* What every command that reads recordings has, before CLI_COMMON_KEYS and CLI_COMMON_OPTIONS. */
#define CLI_READING_KEYS COLUMN, ANGLE_OFFSET, STRICT
#define CLI_READING_OPTIONS                                                                                  \
    [COLUMN] = {"column",                                                                                    \
                0,                                                                                           \
                CLI_TEXT,                                                                                    \
                "NAME=COLUMN",                                                                               \
                .help =                                                                                      \
                    "which column of a recording is this quantity, such as torque_mNm=AI3; may be given "    \
                    "for several",                                                                           \
                .repeats = true},                                                                            \
    [ANGLE_OFFSET] = {"angle-offset", 0, CLI_TEXT, "ANGLE",                                                  \
                      .help = "electrical angle to be added to that of a recording, in degrees or with its " \
                              "unit, such as -0.55rad: from its zero to that of the back-EMF of phase a"},   \
    [STRICT] = {"strict", 0, CLI_FLAG, NULL,                                                                 \
                .help = "refuse a recording with holes; without it such rows are left out and counted"}

/* What the orders in files count periods of; the choice is a hci_order_base. */
extern const cli_choice cli_order_bases[];
#define CLI_ORDER_BASE_OPTION                                                                                \
    {                                                                                                        \
        "order-base", 0, CLI_CHOICE, "BASE", .choices = cli_order_bases,                                     \
                                             .help = "turn that orders which are read count in:"             \
    }

/* The same of a machine's tables alone: what `solve` wrote is electrical. */
#define CLI_TABLE_ORDER_BASE_OPTION                                                                          \
    {                                                                                                        \
        "order-base", 0, CLI_CHOICE, "BASE", .choices = cli_order_bases,                                     \
                                             .help = "turn that orders in the machine's tables count in:"    \
    }

/* The same where the torque of a recording is used. */
#define CLI_HOLDING_OPTION                                                                                   \
    {                                                                                                        \
        "holding", 0, CLI_FLAG, NULL,                                                                        \
            .help = "a recording without torque_Nm is of a shaft that control turns slowly: its current "    \
                    "answers cogging and friction"                                                           \
    }

#define CLI_EXIT_ERRORS "2 command line; 3 input; 4 numerical; 5 output\n"

/* Words of --color, in the order of cli_color. */
extern const cli_choice cli_color_choices[];

/* Place of an option by its long name, of which `length` characters count; -1 when there is none. */
int cli_option_find(const cli_option *options, const char *name, size_t length);

/* Whether a value may or must follow. */
bool cli_option_takes_value(const cli_option *option);

/* The help of an option with its choices, as one line. */
const char *cli_option_help(const cli_option *option, char text[CLI_HELP_SIZE]);

/* Where the exit codes begin in the example of a command, at the words; NULL where it has none. */
const char *cli_command_exit_codes(const cli_command *command);

#endif
