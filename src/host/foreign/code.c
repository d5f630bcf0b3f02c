#include "host/foreign/code.h"

#include <string.h>

#include "host/base/quote.h"
#include "host/foreign/text.h"

enum { MOST_ROWS = 4096 };

size_t hci_foreign_code_columns(const hci_foreign_map *map)
{
    return hci_foreign_largest(map, 2) > 0.0 || hci_foreign_largest(map, 3) > 0.0 ? 4 : 2;
}

void hci_foreign_write_rows(const hci_foreign_map *map,
                            void (*write_value)(const hci_foreign_map *map, size_t row, size_t column,
                                                hci_output *output),
                            hci_output *output)
{
    const size_t columns = hci_foreign_code_columns(map);
    for (size_t k = 0; k < map->points; ++k) {
        hci_output_text(output, "    {");
        for (size_t c = 0; c < columns; ++c) {
            write_value(map, k, c, output);
            hci_output_text(output, c + 1 < columns ? ", " : "},\n");
        }
    }
}

static hci_status wrong(const char *path, const char *found, hci_note *note)
{
    char shown[HCI_QUOTE_PATH_SIZE];
    return hci_note_set(
        note, HCI_ERROR_INPUT,
        "%s: found %s, expected rows {…} of 2 or 4 numbers, a power of two of them up to %d; emit it "
        "again",
        hci_quote_path(path, shown), found, (int)MOST_ROWS);
}

/* Numbers of a row, and the text behind its brace; 0: it is none. */
static size_t read_row(const char *text, const char **end, double value[4])
{
    size_t count = 0;
    if (*text != '{') return 0;
    for (++text; count < 4 && hci_foreign_number(text, &text, &value[count]); text += strspn(text, ", "))
        text += (++count, *text == 'f');
    *end = *text == '}' ? text + 1 : text;
    return *text == '}' && (count == 2 || count == 4) ? count : 0;
}

static size_t count_rows(const char *text, size_t *columns)
{
    double value[4];
    size_t rows = 0;
    *columns = 0;
    for (text += strspn(text, " ,\r\n"); *text == '{'; text += strspn(text, " ,\r\n")) {
        const size_t count = read_row(text, &text, value);
        if (count == 0 || (rows > 0 && count != *columns)) return 0;
        *columns = count;
        ++rows;
    }
    return *text == '}' ? rows : 0;
}

hci_status hci_foreign_read_rows(const char *path, const char *text, hci_foreign_map *map, hci_note *note)
{
    const char *begin = strstr(text, "= {");
    size_t columns;
    if (begin == NULL) return wrong(path, "no table", note);
    const size_t rows = count_rows(begin += 3, &columns);
    if (rows < 2 || rows > MOST_ROWS || (rows & (rows - 1)) != 0) return wrong(path, "other rows", note);
    const hci_status status = hci_foreign_map_points(map, rows, note);
    for (size_t k = 0; !status && k < rows; ++k) {
        begin += strspn(begin, " ,\r\n");
        read_row(begin, &begin, map->value + 4 * k);
    }
    return status;
}
