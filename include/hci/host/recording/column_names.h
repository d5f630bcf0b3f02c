/* Which column of a recording is which quantity, where its name does not say. */
#ifndef HCI_HOST_RECORDING_COLUMN_NAMES_H
#define HCI_HOST_RECORDING_COLUMN_NAMES_H

#include <stdbool.h>
#include <stddef.h>

#include "hci/host/csv/csv.h"

#ifdef __cplusplus
extern "C" {
#endif

/* One quantity. */
typedef struct {
    char *name;   /* as in docs/files.md; its unit, of its own or none ("torque_mNm", "torque"), is that of a
                   column, whatever its header says; without one the header's holds */
    char *column; /* as the header of the recording spells it; "-COLUMN": the opposite of it, "COLUMN/NUMBER":
                   * of an angle the counts of a turn, of other quantities what the column is divided by */
    char *from;   /* who says so: "path:line", or "--column NAME=COLUMN" */
} hci_column_name;

/* Start with {0}. */
typedef struct {
    hci_column_name *item; /* each says what one column is */
    size_t count;          /* entries of item */
} hci_column_names;

/* Adds "NAME=COLUMN". HCI_ERROR_ARGUMENT for another text or a name that is no quantity of a recording,
 * HCI_ERROR_MEMORY. */
hci_status hci_column_names_add(hci_column_names *names, const char *text, hci_note *note);

/* Adds the rows of a table with the columns name and column. HCI_ERROR_INPUT, _MEMORY. */
hci_status hci_column_names_read(hci_column_names *names, const char *path, hci_note *note);

/* Adds `columns.csv` of the folder that a file is in, if there is one. */
hci_status hci_column_names_beside(hci_column_names *names, const char *file, hci_note *note);

/* Adds "NAME=COLUMN;NAME=COLUMN", which `from` says. HCI_ERROR_INPUT for another text or a name that is no
 * quantity, HCI_ERROR_MEMORY. */
hci_status hci_column_names_add_text(hci_column_names *names, const char *text, const char *from,
                                     hci_note *note);

/* Of several (of each: or NULL) such a text, to be freed with hci_column_names_text_free; NULL when memory is
 * out. */
char *hci_column_names_text(const hci_column_names *const *names, size_t count);
/* Frees it; NULL is nothing. */
void hci_column_names_text_free(char *text);

/* Frees what the names hold and empties them. */
void hci_column_names_release(hci_column_names *names);

/* Has the file read so. HCI_ERROR_INPUT for a column that it does not have; where `optional`, only if it does
 * not have the quantity under a name of its own either. */
hci_status hci_column_names_apply(const hci_column_names *names, bool optional, hci_csv *csv, hci_note *note);

/* The same of one of several files: found[k] goes up by one where the file has column k, and what it does not
 * have is no error. */
hci_status hci_column_names_apply_found(const hci_column_names *names, size_t *found, hci_csv *csv,
                                        hci_note *note);

/* A column that none of several files had: the error that the one at `path` gives. found: [names->count]. */
hci_status hci_column_names_check_found(const hci_column_names *names, const size_t *found, const char *path,
                                        hci_note *note);

#ifdef __cplusplus
}
#endif

#endif
