/* Finding the table in files of instruments and field solvers, which begin with lines about themselves. */
#include <string.h>

#include "host/csv/column_name.h"
#include "host/csv/name_words.h"
#include "host/csv/number_cell.h"
#include "host/csv/table.h"

enum { LINES_MOST = 64, CELLS_MOST = 256, CELL_SIZE = 64, ROWS_WANTED = 2 };

/* What the cells of one line are. */
typedef struct {
    size_t count;   /* up to the last that is not empty */
    size_t numbers; /* of them */
    size_t units;   /* of them; cells that say no unit count in `silent` */
    size_t silent;
    bool has_gap;  /* an empty one before the last */
    bool is_twice; /* two are the same */
} line_kind;

typedef struct {
    const char *line;
    char separator;
    char cell[CELLS_MOST][CELL_SIZE];
} line_reader;

static bool is_end(char c)
{
    return c == '\n' || c == '\r' || c == '\0';
}

static const char *next_line(const char *at)
{
    while (!is_end(*at))
        ++at;
    return *at == '\0' ? at : at + (at[0] == '\r' && at[1] == '\n' ? 2 : 1);
}

/* Past blank lines, comments, and bare separators. */
static const char *find_line(const char *at)
{
    for (; *at != '\0'; at = next_line(at)) {
        const char *first = at + strspn(at, " \t");
        if (*first != '#' && !is_end(at[strspn(at, " \t,;")])) break;
    }
    return at;
}

char hci_csv_separator(const char *line)
{
    static const char candidates[] = "\t;,";
    size_t count[3] = {0};
    bool quoted = false;
    for (; *line != '\0' && (quoted || (*line != '\n' && *line != '\r')); line++) {
        if (*line == '"') quoted = !quoted;
        const char *which = quoted ? NULL : strchr(candidates, *line);
        if (which != NULL) count[which - candidates]++;
    }
    if (count[0] > 0 && count[0] >= count[1] && count[0] >= count[2]) return '\t';
    return count[1] > 0 && count[1] >= count[2] ? ';' : ',';
}

/* One cell without blanks around it and quotes, cut at the size of a cell. Leaves *at on its separator or the
 * end of the line. */
static void read_cell(const char **at, char separator, char cell[CELL_SIZE])
{
    size_t used = 0;
    bool quoted = false;
    *at += strspn(*at, separator == '\t' ? " " : " \t");
    for (; !is_end(**at) && (quoted || **at != separator); ++*at) {
        if (**at == '"')
            quoted = !quoted;
        else if (used + 1 < CELL_SIZE)
            cell[used++] = **at;
    }
    while (used > 0 && (cell[used - 1] == ' ' || cell[used - 1] == '\t'))
        --used;
    cell[used] = '\0';
}

static size_t cut(line_reader *r)
{
    size_t count = 0, filled = 0;
    for (const char *at = r->line;; ++at) {
        read_cell(&at, r->separator, r->cell[count]);
        if (r->cell[count++][0] != '\0') filled = count;
        if (is_end(*at) || count == CELLS_MOST) return filled;
    }
}

static void classify_cell(const line_reader *r, size_t k, line_kind *kind)
{
    const char *cell = r->cell[k];
    if (*cell == '\0') kind->has_gap = true;
    kind->numbers += hci_csv_is_number(cell);
    kind->silent += hci_csv_says_no_unit(cell);
    kind->units += !hci_csv_says_no_unit(cell) && hci_csv_cell_unit(cell) != NULL;
    for (size_t other = 0; other < k; ++other)
        if (hci_csv_same_name(cell, r->cell[other])) kind->is_twice = true;
}

static line_kind classify(line_reader *r, const char *line, char separator)
{
    line_kind kind = {0};
    r->line = line;
    r->separator = separator;
    kind.count = cut(r);
    for (size_t k = 0; k < kind.count; ++k)
        classify_cell(r, k, &kind);
    return kind;
}

static bool is_units(const line_kind *kind)
{
    return kind->units > 0 && kind->units + kind->silent == kind->count;
}

static bool is_names(const line_kind *kind)
{
    return kind->count > 1 && kind->numbers == 0 && !kind->has_gap && !kind->is_twice && !is_units(kind);
}

/* A row below `count` names: more numbers than empty cells and words, and two of them at least. */
static bool is_row(const line_kind *kind, size_t count)
{
    return kind->count <= count && kind->numbers > 1 && 2 * kind->numbers > count;
}

/* Such rows, of which the file may have no more than one, after a row of units or none. */
static bool has_numbers_below(line_reader *r, const char *header, char separator, size_t count)
{
    const char *line = find_line(next_line(header));
    line_kind kind = classify(r, line, separator);
    if (is_units(&kind) && kind.count <= count && kind.numbers < kind.count) {
        line = find_line(next_line(line));
        kind = classify(r, line, separator);
    }
    for (int row = 0; row < ROWS_WANTED; ++row) {
        if (*line == '\0') return row > 0;
        kind = classify(r, line, separator);
        if (!is_row(&kind, count)) return false;
        line = find_line(next_line(line));
    }
    return true;
}

/* How many of the names of a line are names of columns of recordings, and not units (rpm may be either). */
static size_t known_names(line_reader *r, const char *line)
{
    const line_kind kind = classify(r, line, hci_csv_separator(line));
    size_t known = 0;
    for (size_t k = 0; k < kind.count; ++k)
        known += hci_csv_cell_unit(r->cell[k]) == NULL && hci_column_is_known(r->cell[k]);
    return known;
}

/* Could a line before the header, which has `count` names, be the header itself? */
static bool is_rival(line_reader *r, const char *line, const char *header, size_t count)
{
    const line_kind kind = classify(r, line, hci_csv_separator(line));
    return is_names(&kind) && kind.count == count && known_names(r, line) >= known_names(r, header);
}

/* The last line of the text, as far as it is looked at, if it is longer than all before it and has two names
 * or more of columns of recordings: a header whose rows are missing. NULL: it is none. */
static const char *last_names(line_reader *r, const char *first)
{
    const char *line = first, *last = NULL;
    size_t most = 0;
    for (int k = 0; k < LINES_MOST && *line != '\0'; ++k, line = find_line(next_line(line))) {
        const line_kind kind = classify(r, line, hci_csv_separator(line));
        if (is_units(&kind)) continue;
        last = is_names(&kind) && kind.count > most && known_names(r, line) > 1 ? line : NULL;
        if (kind.count > most) most = kind.count;
    }
    return *line == '\0' ? last : NULL;
}

const char *hci_csv_table_start(const char *text, bool *has_foreword)
{
    line_reader r;
    const char *const first = find_line(text), *line = first;
    *has_foreword = false;
    for (int k = 0; k < LINES_MOST && *line != '\0'; ++k, line = find_line(next_line(line))) {
        const char separator = hci_csv_separator(line);
        const line_kind kind = classify(&r, line, separator);
        if (!is_names(&kind) || !has_numbers_below(&r, line, separator, kind.count)) continue;
        for (const char *before = first; before < line; before = find_line(next_line(before)))
            if (is_rival(&r, before, line, kind.count)) return first;
        *has_foreword = line > first;
        return line;
    }
    const char *const bare = last_names(&r, first);
    *has_foreword = bare && bare > first;
    return bare ? bare : first;
}

/* ---- rows without a header ---- */

enum { BARE_ROWS = 3 };

/* Rows of as many numbers and nothing else, two or more; 0: it begins with others. */
static size_t bare_rows(line_reader *r, const char *line)
{
    const line_kind first = classify(r, line, hci_csv_separator(line));
    size_t rows = 0;
    for (; rows < BARE_ROWS && *line != '\0'; ++rows, line = find_line(next_line(line))) {
        const line_kind kind = classify(r, line, hci_csv_separator(line));
        if (kind.count < 2 || kind.numbers != kind.count || kind.count != first.count) break;
    }
    return rows == BARE_ROWS ? first.count : 0;
}

size_t hci_csv_bare_rows(const char *text, size_t *numbers)
{
    line_reader r;
    const char *line = find_line(text), *at = text;
    size_t number = 1;
    if (classify(&r, line, hci_csv_separator(line)).count > 1) return 0;
    for (int k = 0; k < LINES_MOST && *line != '\0'; ++k, line = find_line(next_line(line))) {
        *numbers = bare_rows(&r, line);
        if (*numbers == 0) continue;
        for (; at < line; at = next_line(at))
            ++number;
        return number;
    }
    return 0;
}
