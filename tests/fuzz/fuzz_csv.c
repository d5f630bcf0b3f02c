/* Any bytes as a CSV file, as a recording, as a number and as a unit: nothing crashes, and what is said of
 * them keeps the promises. */
#define _POSIX_C_SOURCE 200809L

#include <math.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "fuzzing.h"
#include "hci/host/base/number.h"
#include "hci/host/base/unit.h"
#include "hci/host/base/utf8.h"
#include "hci/host/csv/csv.h"
#include "hci/host/recording/run.h"
#include "host/base/quote.h"
#include "host/csv/alias.h"

static void check_note(hci_status status, const hci_note *note)
{
    fuzz_check_note(status, note);
    fuzz_require(status == HCI_OK || status == HCI_ERROR_INPUT, "errors of the input only");
}

static void check_cells(const hci_csv *csv, const char *column)
{
    for (size_t row = 0; row < hci_csv_rows(csv); row++) {
        const char *text = NULL;
        double value = 0;
        hci_note note = {0}, pointing = {0}, number = {0};
        const hci_status status = hci_csv_text(csv, column, row, &text, &note);
        check_note(status, &note);
        fuzz_require(status != HCI_OK || hci_utf8_valid(text), "text in UTF-8");
        check_note(hci_csv_error(csv, column, row, &pointing, "something else", "change it"), &pointing);
        check_note(hci_csv_number(csv, column, row, &value, &number), &number);
        fuzz_require(isfinite(value), "a finite number");
        fuzz_require(row == 0 || hci_csv_line(csv, row) > hci_csv_line(csv, row - 1),
                     "rows in ascending lines");
    }
}

static void check_column(const hci_csv *csv, const char *column)
{
    double *values = malloc(hci_csv_rows(csv) * sizeof *values + 1);
    hci_note note = {0};
    const hci_status status = hci_csv_numbers(csv, column, values, &note);
    check_note(status, &note);
    fuzz_require(status != HCI_OK || hci_csv_has(csv, column), "no numbers from a column that is not there");
    for (size_t row = 0; status == HCI_OK && row < hci_csv_rows(csv); row++)
        fuzz_require(isfinite(values[row]), "finite numbers");
    free(values);
    if (hci_csv_has(csv, column)) check_cells(csv, column);
}

/* What a column is taken for is found again, and said in words that a terminal may show. */
static void check_aliases(const hci_csv *csv)
{
    for (size_t k = 0; k < hci_alias_count; k++) {
        size_t column = 0;
        hci_note told = {0};
        if (hci_aliases[k].column == NULL || !hci_csv_find(csv, hci_aliases[k].column, &column)) continue;
        fuzz_require(column < hci_csv_columns(csv), "a column of the file");
        fuzz_require(hci_csv_told(csv, hci_aliases[k].column, &told) == (told.text[0] != '\0'),
                     "told in words");
        fuzz_check_shown(told.text);
    }
}

static void check_run(const hci_csv *csv)
{
    hci_run run;
    hci_note note = {0};
    check_note(hci_run_of_csv(csv, &(hci_run_options){.pole_pairs = 3, .inertia_kgm2 = 1e-3}, &run, &note),
               &note);
    fuzz_check_shown(run.remark.text);
    for (size_t k = 0; run.theta_m_rad != NULL && k < run.count; k++)
        fuzz_require(isfinite(run.theta_m_rad[k]), "finite angles");
    hci_run_release(&run);
}

static void check_file(const char *path, size_t size)
{
    static const char *const columns[] = {
        "order", "amplitude_V", "theta_e_rad", "speed_rad_per_s", "ia_A", "time_s", "name", "value", "x"};
    hci_csv *csv;
    hci_note note = {0};
    const hci_status status = hci_csv_read(path, &csv, &note);
    check_note(status, &note);
    fuzz_require((status == HCI_OK) == (csv != NULL), "a table or an error");
    if (csv == NULL) return;
    fuzz_require(hci_csv_rows(csv) < size || hci_csv_map_of(csv) != NULL, "fewer rows than bytes");
    for (size_t k = 0; k < sizeof columns / sizeof *columns; k++)
        check_column(csv, columns[k]);
    check_aliases(csv);
    check_run(csv);
    hci_csv_free(csv);
}

/* Decimal numbers are what strtod makes of them; what is written reads back. */
static void check_text(const char *text)
{
    double value = 0, back = 0, factor = 1;
    char written[32];
    if (hci_unit_factor(text, "rad", &factor))
        fuzz_require(factor > 0 && factor < 7, "an angle of at most one turn");
    if (!hci_number_parse(text, &value)) return;
    const double reference = strtod(text, NULL);
    fuzz_require(memcmp(&value, &reference, sizeof value) == 0, "the value of strtod");
    hci_number_text(value, written);
    fuzz_require(hci_number_parse(written, &back) && memcmp(&value, &back, sizeof value) == 0,
                 "the same number back");
}

/* A file without a name, in memory where that can be; /dev/fd reads it from its beginning. */
static int open_nameless(char path[32])
{
    char in_memory[] = "/dev/shm/hci-fuzz-csv-XXXXXX", on_disk[] = "/tmp/hci-fuzz-csv-XXXXXX";
    char *name = access("/dev/shm", W_OK) == 0 ? in_memory : on_disk;
    const int descriptor = mkstemp(name);
    fuzz_require(descriptor >= 0 && unlink(name) == 0, "a file to write into");
    snprintf(path, 32, "/dev/fd/%d", descriptor);
    return descriptor;
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    static char path[32];
    static int descriptor = -1;
    char text[1024];
    if (descriptor < 0) descriptor = open_nameless(path);
    fuzz_require(ftruncate(descriptor, 0) == 0 && pwrite(descriptor, data, size, 0) == (ssize_t)size,
                 "a file that is written");
    check_file(path, size);
    const size_t length = size < sizeof text ? size : sizeof text - 1;
    if (length > 0) memcpy(text, data, length);
    text[length] = '\0';
    check_text(text);
    return 0;
}
