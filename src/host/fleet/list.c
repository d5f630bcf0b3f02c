#include "hci/host/fleet/list.h"

#include <stdlib.h>
#include <string.h>

#include "host/base/memory.h"

const char *hci_fleet_cell(const hci_fleet_list *list, size_t motor, const char *column)
{
    hci_note ignored = {{0}};
    const char *text = "";
    if (!hci_csv_has(list->csv, column)) return "";
    return hci_csv_text(list->csv, column, motor, &text, &ignored) ? "" : text;
}

/* A motor's name is the name of its folder, which hidden ones are not. */
static bool is_folder_name(const char *name)
{
    if (name[0] == '\0' || name[0] == '.' || strlen(name) >= HCI_FLEET_NAME_SIZE) return false;
    for (const char *c = name; *c; ++c)
        if (*c == '/' || *c == '\\' || (unsigned char)*c < ' ' || *c == 127) return false;
    return true;
}

typedef struct {
    const char *name;
    size_t row;
} named;

static int by_name(const void *a, const void *b)
{
    const named *x = a, *y = b;
    const int order = strcmp(x->name, y->name);
    return order ? order : x->row < y->row ? -1 : 1;
}

static hci_status check_names(const hci_fleet_list *list, named *names, hci_note *note)
{
    for (size_t k = 0; k < list->count; ++k) {
        names[k] = (named){hci_fleet_cell(list, k, "motor"), k};
        if (!is_folder_name(names[k].name))
            return hci_csv_error(list->csv, "motor", k, note, "a name that a folder can have",
                                 "take letters, digits, - and _");
    }
    qsort(names, list->count, sizeof *names, by_name);
    for (size_t k = 1; k < list->count; ++k)
        if (strcmp(names[k - 1].name, names[k].name) == 0)
            return hci_csv_error(list->csv, "motor", names[k].row, note, "each name once",
                                 "rename one of the two motors, or remove its row");
    return HCI_OK;
}

hci_status hci_fleet_list_read(const char *path, hci_fleet_list *list, hci_note *note)
{
    const char *first;
    hci_status status = hci_csv_read(path, &list->csv, note);
    if (status) return status;
    list->count = hci_csv_rows(list->csv);
    if (list->count == 0) return hci_note_set(note, HCI_ERROR_INPUT, "%s: the list has no motor", path);
    status = hci_csv_text(list->csv, "motor", 0, &first, note);
    if (status) return status;
    named *names = hci_memory_new(list->count, sizeof *names);
    if (!names) return hci_note_memory(note, path, "its motors");
    status = check_names(list, names, note);
    hci_memory_free(names);
    return status;
}

void hci_fleet_list_release(hci_fleet_list *list)
{
    hci_csv_free(list->csv);
    *list = (hci_fleet_list){0};
}
