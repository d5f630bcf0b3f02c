/* drive.csv: name,value,unit of the drive that makes the currents. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "hci/host/csv/csv.h"
#include "hci/host/drive/drive.h"
#include "host/base/memory.h"
#include "host/base/quote.h"
#include "host/csv/name_values.h"
#include "host/drive/response_file.h"

enum {
#define COUNT_ONE(field, name, unit, low, high, fallback, what) +1
    ENTRIES = 0 HCI_DRIVE_VALUES(COUNT_ONE)
#undef COUNT_ONE
};

static const char REMEDY[] = "see docs/files.md, drive.csv";

static const hci_value_range RANGES[ENTRIES] = {
#define RANGE_OF(field, name, unit, low, high, fallback, what) {low, high, REMEDY},
    HCI_DRIVE_VALUES(RANGE_OF)
#undef RANGE_OF
};

static void list_entries(hci_drive_data *d, hci_named_value list[ENTRIES])
{
    size_t k = 0;
#define LIST_ONE(field, text, unit_text, low, high, fallback, what)                                          \
    list[k++] = (hci_named_value){text, unit_text, &d->field};
    HCI_DRIVE_VALUES(LIST_ONE)
#undef LIST_ONE
}

void hci_drive_init(hci_drive_data *drive)
{
    hci_named_value list[ENTRIES];
    memset(drive, 0, sizeof *drive);
    list_entries(drive, list);
    for (size_t k = 0; k < ENTRIES; ++k)
        *list[k].value = NAN;
}

/* ---- what a file leaves open ---- */

static const double SAMPLE_s = 1e-4;

double hci_drive_sample_s(const hci_drive_data *drive)
{
    return isnan(drive->sample_s) ? SAMPLE_s : drive->sample_s;
}

double hci_drive_dead_share(const hci_drive_data *drive)
{
    return drive->dead_time_s * drive->pwm_frequency_Hz;
}

double hci_drive_filter_share(const hci_drive_data *drive)
{
    return drive->filter_s > 0.0 ? -expm1(-hci_drive_sample_s(drive) / drive->filter_s) : 0.0;
}

/* ---- words ---- */

enum { CURRENT_CONTROL, DECOUPLING, MODULATION, RESPONSE_OF, RESPONSE, WORDS };

static const char *const WORD[WORDS] = {"current_control", "decoupling", "modulation", "response_of",
                                        "response"};

#define WORD_OF(value, word) [value] = word,
static const char *const LOOPS[] = {"pi", NULL};
static const char *const DECOUPLINGS[] = {HCI_DECOUPLING_NAMES(WORD_OF) NULL};
static const char *const MODULATIONS[] = {HCI_MODULATION_NAMES(WORD_OF) NULL};
static const char *const RESPONSES_OF[] = {HCI_RESPONSE_OF_NAMES(WORD_OF) NULL};
#undef WORD_OF
static const char *const *const CHOICES[RESPONSE] = {LOOPS, DECOUPLINGS, MODULATIONS, RESPONSES_OF};

/* A path in the file is relative to the file's folder. */
static hci_status read_response(const hci_csv *csv, size_t row, hci_drive_data *d, hci_note *note)
{
    const char *text, *slash = strrchr(d->path, '/');
    const int folder = slash ? (int)(slash - d->path) + 1 : 0;
    char path[HCI_DRIVE_PATH_SIZE];
    const hci_status status = hci_csv_text(csv, "value", row, &text, note);
    if (status) return status;
    const int length = snprintf(path, sizeof path, "%.*s%s", text[0] == '/' ? 0 : folder, d->path, text);
    if (text[0] == '\0' || length >= (int)sizeof path)
        return hci_csv_error(csv, "value", row, note, "the path of loop.csv",
                             "delete the row where the loop was not measured");
    return hci_response_read(path, &d->response, &d->response_count, note);
}

static hci_status read_word(const hci_csv *csv, size_t row, int word, hci_drive_data *d, hci_note *note)
{
    int choice = 0;
    if (word == RESPONSE) return read_response(csv, row, d, note);
    const hci_status status = hci_value_read_choice(csv, row, CHOICES[word], REMEDY, &choice, note);
    if (status) return status;
    if (word == DECOUPLING) {
        d->decoupling = (hci_decoupling)choice;
        d->decoupling_is_given = true;
    }
    if (word == MODULATION) d->modulation = (hci_modulation)choice;
    if (word == RESPONSE_OF) d->response_of = (hci_response_of)choice;
    return HCI_OK;
}

/* ---- rows ---- */

static hci_status unknown_name(const hci_csv *csv, size_t row, const char *name, hci_note *note)
{
#define NAME_OF(field, text, unit, low, high, fallback, what) text,
    static const char *const VALUES[] = {HCI_DRIVE_VALUES(NAME_OF)};
#undef NAME_OF
    const char *names[WORDS + sizeof VALUES / sizeof *VALUES + 1] = {NULL};
    for (size_t k = 0; k < WORDS; ++k)
        names[k] = WORD[k];
    memcpy(names + WORDS, VALUES, sizeof VALUES);
    return hci_unknown_name(csv, row, name, names, "docs/files.md", note);
}

static hci_status read_row(const hci_csv *csv, size_t row, hci_drive_data *d, bool given[WORDS],
                           hci_note *note)
{
    hci_named_value list[ENTRIES];
    const char *name;
    size_t at;
    hci_status status = hci_csv_text(csv, "name", row, &name, note);
    for (int k = 0; k < WORDS && !status; ++k) {
        if (strcmp(name, WORD[k]) != 0) continue;
        if (given[k])
            return hci_csv_error(csv, "name", row, note, "each name once", "delete one of the two rows");
        given[k] = true;
        return read_word(csv, row, k, d, note);
    }
    list_entries(d, list);
    if (!status) status = hci_named_value_find(csv, row, list, ENTRIES, &at, note);
    if (status) return status;
    return at < ENTRIES ? hci_value_read_within(csv, row, &list[at], &RANGES[at], note)
                        : unknown_name(csv, row, name, note);
}

hci_status hci_drive_read(const char *path, hci_drive_data *drive, hci_note *note)
{
    bool given[WORDS] = {false};
    hci_csv *csv;
    hci_status status;
    hci_drive_init(drive);
    if (snprintf(drive->path, sizeof drive->path, "%s", path) >= (int)sizeof drive->path)
        return hci_note_set(note, HCI_ERROR_INPUT, "%.200s…: the path is too long", path);
    status = hci_csv_read(path, &csv, note);
    if (status) return status;
    for (size_t row = 0; row < hci_csv_rows(csv) && !status; ++row)
        status = read_row(csv, row, drive, given, note);
    hci_csv_free(csv);
    drive->gains_are_given = !isnan(drive->kp_ohm) || !isnan(drive->bandwidth_Hz);
    if (status) hci_drive_release(drive);
    return status;
}

void hci_drive_remark(const hci_drive_data *drive, hci_note *remark)
{
    char path[HCI_QUOTE_PATH_SIZE];
    if (drive->decoupling_is_given) return;
    hci_note_add(remark,
                 "%s: no `decoupling`, so `table` is taken, of a drive that knows the harmonics of the "
                 "machine; nearly all "
                 "have `constant` or `none`, which leave more ripple: add the row",
                 hci_quote_path(drive->path, path));
}

void hci_drive_release(hci_drive_data *drive)
{
    hci_memory_free(drive->response);
    hci_drive_init(drive);
}
