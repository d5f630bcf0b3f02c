#include "host/csv/blanks.h"

#include <stdbool.h>
#include <string.h>

#include "host/csv/number_cell.h"

enum { LINES_MOST = 64, CELL_SIZE = 64 };

static bool is_end(char c)
{
    return c == '\n' || c == '\r' || c == '\0';
}

static char *next_line(char *at)
{
    at += strcspn(at, "\r\n");
    return *at == '\0' ? at : at + (at[0] == '\r' && at[1] == '\n' ? 2 : 1);
}

static char *skip_blanks(char *at)
{
    return at + strspn(at, " ");
}

static bool is_comment(char *line)
{
    return *skip_blanks(line) == '#';
}

static bool is_blank_line(char *line)
{
    return is_end(line[strspn(line, " \t,;")]);
}

/* To the first line from here on that is neither blank nor a comment. */
static char *find_line(char *at)
{
    while (*at != '\0' && (is_comment(at) || is_blank_line(at)))
        at = next_line(at);
    return at;
}

/* ---- words ---- */

/* What stands between separators of a line: runs of at least `blanks` blanks, or one character. */
typedef struct {
    char separator; /* ' ': blanks */
    size_t blanks;
    size_t words, numbers;
} line_words;

/* The end of the word that begins here. */
static char *word_end(const line_words *w, char *at)
{
    bool quoted = false;
    for (; !is_end(*at); ++at) {
        if (*at == '"') quoted = !quoted;
        if (quoted) continue;
        if (w->separator != ' ' && *at == w->separator) break;
        if (w->separator == ' ' && *at == ' ') {
            const size_t run = strspn(at, " ");
            if (run >= w->blanks || is_end(at[run])) break;
        }
    }
    return at;
}

static void count_word(line_words *w, const char *from, const char *end)
{
    char cell[CELL_SIZE] = "";
    while (end > from && end[-1] == ' ')
        --end;
    const size_t length = (size_t)(end - from);
    ++w->words;
    if (length >= sizeof cell) return;
    memcpy(cell, from, length);
    w->numbers += hci_csv_is_number(cell);
}

static line_words count_words(char *line, char separator, size_t blanks)
{
    line_words w = {.separator = separator, .blanks = blanks};
    for (char *at = skip_blanks(line); !is_end(*at);) {
        char *end = word_end(&w, at);
        count_word(&w, at, end);
        at = skip_blanks(!is_end(*end) && separator != ' ' ? end + 1 : end);
    }
    return w;
}

/* ---- columns apart by blanks ---- */

static bool has_separator(char *line)
{
    const char *end = line + strcspn(line, "\r\n");
    bool quoted = false;
    for (; line < end; ++line) {
        if (*line == '"') quoted = !quoted;
        if (!quoted && strchr("\t;,", *line) != NULL) return true;
    }
    return false;
}

/* Does a row of as many numbers follow, after a row of units or none? */
static bool has_numbers_below(char *header, size_t words)
{
    char *line = find_line(next_line(header));
    line_words w = count_words(line, ' ', 1);
    if (w.words == words && w.numbers == 0) {
        line = find_line(next_line(line));
        w = count_words(line, ' ', 1);
    }
    return w.words == words && w.numbers == words;
}

/* How many blanks stand between names of a header; 0: it is none. */
static size_t blanks_of_header(char *line)
{
    if (has_separator(line)) return 0;
    for (size_t blanks = 1; blanks <= 2; ++blanks) {
        const line_words w = count_words(line, ' ', blanks);
        if (w.words > 1 && w.numbers == 0 && has_numbers_below(line, w.words)) return blanks;
    }
    return 0;
}

/* Copies a line to `to`, its words apart by tabs. Returns its new end; *line: its old one. */
static char *copy_line(char *to, char **line, size_t blanks)
{
    const line_words w = {.separator = ' ', .blanks = blanks};
    char *at = is_comment(*line) ? *line : skip_blanks(*line);
    while (!is_end(*at)) {
        char *end = is_comment(*line) ? at + strcspn(at, "\r\n") : word_end(&w, at);
        memmove(to, at, (size_t)(end - at));
        to += end - at;
        at = skip_blanks(end);
        if (!is_end(*at)) *to++ = '\t';
    }
    *line = at;
    return to;
}

static void blanks_to_tabs(char *header, size_t blanks)
{
    char *to = header;
    for (char *line = header; *line != '\0'; blanks = 1) {
        to = copy_line(to, &line, blanks);
        const size_t end = (size_t)(next_line(line) - line);
        memmove(to, line, end);
        to += end;
        line += end;
    }
    *to = '\0';
}

/* ---- a header in a comment ---- */

static char separator_of(char *line)
{
    static const char candidates[] = "\t;,";
    const size_t length = strcspn(line, "\r\n");
    for (const char *c = candidates; *c != '\0'; ++c)
        if (memchr(line, *c, length) != NULL) return *c;
    return ' ';
}

static void show_header(char *text)
{
    char *row = find_line(text), *comment = NULL;
    for (char *line = text; line < row; line = next_line(line))
        if (is_comment(line)) comment = line;
    if (comment == NULL || *row == '\0') return;
    const char separator = separator_of(row);
    const line_words numbers = count_words(row, separator, 1);
    char *mark = skip_blanks(comment);
    if (numbers.words < 2 || numbers.numbers < numbers.words) return;
    for (size_t blanks = 1; blanks <= 2; ++blanks) {
        const line_words names = count_words(mark + 1, separator, blanks);
        if (names.words != numbers.words || names.numbers > 0) continue;
        *mark = ' ';
        return;
    }
}

void hci_csv_prepare(char *text)
{
    show_header(text);
    char *line = find_line(text);
    for (int k = 0; k < LINES_MOST && *line != '\0'; ++k, line = find_line(next_line(line))) {
        const size_t blanks = blanks_of_header(line);
        if (blanks == 0) continue;
        blanks_to_tabs(line, blanks);
        return;
    }
}
