/* Why a command failed, as JSON: the parts of a note of the form
 *     PATH:LINE: column N `name`: found …, expected …; remedy
 * of which all but the words may lack. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "host/report/summary.h"

enum { DIGITS = 19 };

/* Behind the number of a line, ": "; NULL where none stands at `colon`. */
static const char *behind_line(const char *colon)
{
    const size_t digits = strspn(colon + 1, "0123456789");
    const bool is_line = digits > 0 && digits < DIGITS && strncmp(colon + 1 + digits, ": ", 2) == 0;
    return is_line ? colon + digits + 3 : NULL;
}

/* Cuts the path and the line off; what follows them. A path may have colons in it. */
static const char *take_place(char *text, hci_status status, const char **file, double *line)
{
    const int code = hci_status_exit_code(status);
    for (char *at = strchr(text, ':'); at != NULL; at = strchr(at + 1, ':')) {
        const char *rest = behind_line(at);
        if (rest == NULL) continue;
        *line = strtod(at + 1, NULL);
        *at = '\0';
        *file = text;
        return rest;
    }
    char *end = strstr(text, ": ");
    const bool is_file =
        code == hci_status_exit_code(HCI_ERROR_INPUT) || code == hci_status_exit_code(HCI_ERROR_OUTPUT);
    if (!is_file || end == NULL || strncmp(text, "--", 2) == 0) return text;
    *end = '\0';
    *file = text;
    return end + 2;
}

/* The number and the name of "column N `name`: ". */
static void take_column(const char *rest, char *name, double *column)
{
    static const char WORD[] = "column ";
    char *end;
    name[0] = '\0';
    if (strncmp(rest, WORD, sizeof WORD - 1) != 0) return;
    const double number = strtod(rest + sizeof WORD - 1, &end);
    if (end == rest + sizeof WORD - 1) return;
    *column = number;
    if (strncmp(end, " `", 2) != 0) return;
    const size_t length = strcspn(end + 2, "`");
    memcpy(name, end + 2, length);
    name[length] = '\0';
}

char *hci_failure_json(hci_status status, const hci_note *note)
{
    char text[HCI_NOTE_SIZE], name[HCI_NOTE_SIZE];
    const char *words = note->text[0] != '\0' ? note->text : hci_status_text(status), *file = NULL;
    double line = (double)NAN, column = (double)NAN;
    hci_json json;
    strcpy(text, words);
    const char *rest = take_place(text, status, &file, &line), *remedy = strstr(rest, "; ");
    for (const char *next = remedy; next != NULL; next = strstr(next + 2, "; "))
        remedy = next;
    take_column(rest, name, &column);
    hci_json_begin(&json);
    hci_json_object(&json, "error");
    hci_json_number(&json, "exit_code", hci_status_exit_code(status));
    hci_json_text(&json, "status", hci_status_text(status));
    hci_json_text(&json, "message", words);
    if (file != NULL) hci_json_text(&json, "file", file);
    if (isfinite(line)) hci_json_number(&json, "line", line);
    if (isfinite(column)) hci_json_number(&json, "column", column);
    if (name[0] != '\0') hci_json_text(&json, "column_name", name);
    if (remedy != NULL) hci_json_text(&json, "remedy", remedy + 2);
    hci_json_close(&json);
    return hci_json_end(&json);
}
