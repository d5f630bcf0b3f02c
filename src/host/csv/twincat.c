#include "host/csv/twincat.h"

#include <stdbool.h>
#include <string.h>

#include "host/csv/table.h"

#define TIME_CELL "Name"

static char *next_line(char *at)
{
    at += strcspn(at, "\r\n");
    if (*at == '\0') return at;
    return at + (at[0] == '\r' && at[1] == '\n' ? 2 : 1);
}

static bool begins(const char *line, const char *cell)
{
    const size_t length = strlen(cell);
    return strncmp(line, cell, length) == 0 && strchr("\t;,\r\n", line[length]) != NULL;
}

/* The line of names, which that of comments follows; NULL: another file. */
static char *find_names(char *text)
{
    for (int k = 0; k < 16 && *text != '\0'; ++k, text = next_line(text))
        if (begins(text, TIME_CELL) && begins(next_line(text), "SymbolComment")) return text;
    return NULL;
}

static char *next_cell(char *at, char separator)
{
    const char stop[] = {separator, '\r', '\n', '\0'};
    at += strcspn(at, stop);
    return *at == separator ? at + 1 : NULL;
}

/* Names as long as the one that they replace: t_ms, then (t1), (t2) … */
static void name_times(char *names)
{
    const char separator = names[strlen(TIME_CELL)];
    unsigned count = 0;
    memcpy(names, "t_ms", strlen(TIME_CELL));
    for (char *cell = next_cell(names, separator); cell != NULL; cell = next_cell(cell, separator)) {
        if (!begins(cell, TIME_CELL)) continue;
        ++count;
        const char name[] = {'(', "tuvwxyz"[count / 10 % 7], (char)('0' + count % 10), ')'};
        memcpy(cell, name, sizeof name);
    }
}

/* "Unit", then "(None)", "Nm (Torque)": what stands in brackets says no unit. */
static void clean_units(char *line)
{
    const char separator = line[strlen("Unit")];
    memcpy(line, "ms  ", 4);
    for (char *cell = next_cell(line, separator); cell != NULL; cell = next_cell(cell, separator)) {
        const char stop[] = {separator, '\r', '\n', '\0'};
        char *end = cell + strcspn(cell, stop), *bracket = memchr(cell, '(', (size_t)(end - cell));
        if (strncmp(cell, "Unit", 4) == 0 && cell + 4 == end) memset(cell, ' ', 4);
        if (bracket != NULL) memset(bracket, ' ', (size_t)(end - bracket));
    }
}

/* Whether a line of sample times has one of them only. */
static bool is_uniform(char *line)
{
    const char separator = line[strcspn(line, "\t;")];
    char *first = next_cell(line, separator);
    const char stop[] = {separator, '\r', '\n', '\0'};
    for (char *cell = first; cell != NULL; cell = next_cell(cell, separator)) {
        const size_t length = strcspn(cell, stop);
        if (strncmp(cell, "SampleTime", strlen("SampleTime")) == 0) continue;
        if (length != strcspn(first, stop) || memcmp(cell, first, length) != 0) return false;
    }
    return true;
}

static bool is_attribute(const char *line)
{
    static const char *const WORDS[] = {
        "SymbolComment", "Data-Type",   "SampleTime[ms]", "VariableSize", "SymbolBased",
        "IndexGroup",    "IndexOffset", "SymbolName",     "NetID",        "NetId",
        "Port",          "Offset",      "ScaleFactor",    "BitMask",      "Unit ScaleFactor",
        "Unit Offset"};
    for (size_t k = 0; k < sizeof WORDS / sizeof *WORDS; ++k)
        if (begins(line, WORDS[k])) return true;
    return false;
}

/* Ticks of 100 ns since 1601 have 18 digits. */
static bool is_full_stamp(const char *line)
{
    return strspn(line, "0123456789") >= 17;
}

hci_status hci_csv_of_twincat(const char *path, char *text, hci_note *note)
{
    char *names = find_names(text), *line = names != NULL ? next_line(names) : NULL;
    if (names == NULL) return HCI_OK;
    name_times(names);
    for (; *line != '\0' && strchr("0123456789-", *line) == NULL; line = next_line(line)) {
        if (begins(line, "SampleTime[ms]") && !is_uniform(line))
            return hci_csv_file_error(
                path, note, "found channels of several sample times, expected one of all",
                "export them from TwinCAT Scope with Interpolation `Shift value`, or those of "
                "one sample time alone");
        if (begins(line, "Unit"))
            clean_units(line);
        else if (is_attribute(line))
            *line = '#';
    }
    if (is_full_stamp(line))
        return hci_csv_file_error(path, note,
                                  "found full time stamps of TwinCAT Scope, expected milliseconds",
                                  "export without `Full Timestamp`");
    return HCI_OK;
}
