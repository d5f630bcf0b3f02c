/* fleet.sqlite by SQLite, which no other file includes. It is opened for each writing and closed behind it,
 * so that it is not open where a process is started. */
#include <math.h>
#include <sqlite3.h>
#include <stdio.h>
#include <string.h>

#include "hci/host/fleet/fit.h"
#include "hci/host/fleet/results.h"
#include "host/base/words.h"
#include "host/fleet/row.h"

enum { PATH_SIZE = 4096, SQL_SIZE = 8192, CELL_SIZE = 1024, WAIT_MS = 100, LAST_WAIT_MS = 10000 };

/* A file that is open, and what is prepared for it. */
typedef struct {
    sqlite3 *file;
    sqlite3_stmt *find, *put, *put_parameter, *forget, *forget_parameters;
    char path[PATH_SIZE], header[HCI_FLEET_ROW_SIZE];
    const hci_fleet_results *results;
    hci_note *note;
} database;

/* Another program reads or writes it. */
static bool is_held(const database *d)
{
    const int code = sqlite3_errcode(d->file);
    return code == SQLITE_BUSY || code == SQLITE_LOCKED;
}

/* Memory was short: for SQLite, or for its access to files. */
static bool is_short(const database *d)
{
    return !d->file || sqlite3_errcode(d->file) == SQLITE_NOMEM ||
           sqlite3_extended_errcode(d->file) == SQLITE_IOERR_NOMEM;
}

static hci_status refused(const database *d)
{
    if (is_short(d)) return hci_note_memory(d->note, d->path, "the database of motors");
    if (is_held(d))
        return hci_note_set(d->note, HCI_ERROR_OUTPUT,
                            "%.300s: another program holds it; close it there, and the same command goes on",
                            d->path);
    return hci_note_set(
        d->note, HCI_ERROR_OUTPUT,
        "%.300s: %.200s; when it cannot be mended, delete it: it is made again from the folders", d->path,
        sqlite3_errmsg(d->file));
}

static hci_status run(const database *d, const char *sql)
{
    return sqlite3_exec(d->file, sql, NULL, NULL, NULL) == SQLITE_OK ? HCI_OK : refused(d);
}

/* ---- the tables ---- */

static bool is_number(const char *column)
{
    const size_t length = strlen(column);
    static const char *const OTHERS[] = {"exit_code", "worst_order", "loss_ratio_to_plain", NULL};
    for (const char *const *other = OTHERS; *other; ++other)
        if (strcmp(column, *other) == 0) return true;
    return (length > 3 && strcmp(column + length - 3, "_Nm") == 0) ||
           (length > 2 && strcmp(column + length - 2, "_A") == 0);
}

/* Calls `add` with each column of fleet.csv. */
static size_t each_column(const char *header, const hci_words *sql,
                          void (*add)(const hci_words *sql, const char *column))
{
    size_t count = 0;
    while (*header) {
        char column[64];
        const size_t length = strcspn(header, ",");
        snprintf(column, sizeof column, "%.*s", (int)length, header);
        add(sql, column);
        header += length + (header[length] == ',');
        ++count;
    }
    return count;
}

static void declare(const hci_words *sql, const char *column)
{
    hci_words_say(sql, "%s %s%s, ", column, is_number(column) ? "REAL" : "TEXT",
                  strcmp(column, "motor") == 0 ? " PRIMARY KEY" : "");
}

static void mark(const hci_words *sql, const char *column)
{
    (void)column;
    hci_words_say(sql, "?, ");
}

static void name(const hci_words *sql, const char *column)
{
    hci_words_say(sql, "%s, ", column);
}

static hci_status make_tables(const database *d)
{
    char sql[SQL_SIZE] = "";
    const hci_words words = {sql, sizeof sql};
    hci_words_say(&words, "CREATE TABLE IF NOT EXISTS motor (");
    each_column(d->header, &words, declare);
    hci_words_say(&words, "seconds REAL);"
                          "CREATE TABLE IF NOT EXISTS parameter (motor TEXT, effect TEXT, parameter TEXT, "
                          "value REAL, unit TEXT, std_error REAL, PRIMARY KEY (motor, effect, parameter))");
    return run(d, sql);
}

static hci_status prepare(const database *d, sqlite3_stmt **statement, const char *sql)
{
    return sqlite3_prepare_v2(d->file, sql, -1, statement, NULL) == SQLITE_OK ? HCI_OK : refused(d);
}

static hci_status prepare_all(database *d)
{
    char sql[SQL_SIZE] = "";
    const hci_words words = {sql, sizeof sql};
    hci_status status;
    hci_words_say(&words, "INSERT OR REPLACE INTO motor (");
    each_column(d->header, &words, name);
    hci_words_say(&words, "seconds) VALUES (");
    each_column(d->header, &words, mark);
    hci_words_say(&words, "?)");
    status = prepare(d, &d->put, sql);
    if (!status) status = prepare(d, &d->find, "SELECT words_digest FROM motor WHERE motor = ?");
    if (!status) status = prepare(d, &d->put_parameter, "INSERT INTO parameter VALUES (?, ?, ?, ?, ?, ?)");
    if (!status) status = prepare(d, &d->forget, "DELETE FROM motor WHERE motor = ?");
    return status ? status : prepare(d, &d->forget_parameters, "DELETE FROM parameter WHERE motor = ?");
}

/* ---- rows ---- */

/* A value that is not bound, for lack of memory, would be NULL in the row without a word. */
static bool bind_text(sqlite3_stmt *s, int at, const char *text)
{
    return sqlite3_bind_text(s, at, text, -1, SQLITE_TRANSIENT) == SQLITE_OK;
}

static bool bind_number(sqlite3_stmt *s, int at, double value)
{
    return (isfinite(value) ? sqlite3_bind_double(s, at, value) : sqlite3_bind_null(s, at)) == SQLITE_OK;
}

static hci_status do_it(const database *d, sqlite3_stmt *s, bool is_bound)
{
    if (!is_bound) return refused(d);
    const int result = sqlite3_step(s);
    sqlite3_reset(s);
    return result == SQLITE_DONE ? HCI_OK : refused(d);
}

static hci_status forget(const database *d, const char *motor)
{
    const hci_status status = do_it(d, d->forget, bind_text(d->forget, 1, motor));
    return status ? status : do_it(d, d->forget_parameters, bind_text(d->forget_parameters, 1, motor));
}

static hci_status put_parameters(const database *d, const char *motor, const hci_fleet_fit *fit)
{
    hci_status status = HCI_OK;
    for (size_t k = 0; k < fit->count && !status; ++k) {
        const hci_fleet_parameter *p = &fit->parameter[k];
        sqlite3_stmt *put = d->put_parameter;
        status = do_it(d, put,
                       bind_text(put, 1, motor) && bind_text(put, 2, p->effect) &&
                           bind_text(put, 3, p->parameter) && bind_number(put, 4, p->value) &&
                           bind_text(put, 5, p->unit) && bind_number(put, 6, p->std_error));
    }
    return status;
}

/* The cells of the row by their columns; numbers by the column's type. */
static hci_status put_row(const database *d, const char *row, double seconds)
{
    const char *header = d->header;
    bool is_bound = true;
    int at = 0;
    while (*header) {
        char column[64], cell[CELL_SIZE];
        const size_t length = strcspn(header, ",");
        snprintf(column, sizeof column, "%.*s", (int)length, header);
        hci_fleet_row_cell(row, d->header, column, cell, sizeof cell);
        ++at;
        is_bound = is_bound && (cell[0] ? bind_text(d->put, at, cell) : bind_number(d->put, at, NAN));
        header += length + (header[length] == ',');
    }
    return do_it(d, d->put, is_bound && bind_number(d->put, ++at, seconds));
}

static hci_status put_motor(const database *d, size_t motor, const char *row, double seconds)
{
    const char *named = hci_fleet_cell(d->results->list, motor, "motor");
    char folder[PATH_SIZE];
    hci_fleet_fit fit;
    bool is_there = false;
    hci_status status = forget(d, named);
    snprintf(folder, sizeof folder, "%.3000s/motors/%s%s", d->results->folder, named,
             d->results->command == HCI_FLEET_DIAGNOSE ? "/fit" : "");
    if (!status) status = put_row(d, row, seconds);
    if (!status && hci_fleet_row_state(row) <= HCI_FLEET_OPEN)
        status = hci_fleet_fit_read(folder, &fit, &is_there, d->note);
    return status || !is_there ? status : put_parameters(d, named, &fit);
}

/* Whether the motor has its row already, by the digest of its words. */
static bool has_row(const database *d, size_t motor, const char *row)
{
    char digest[32];
    bool is_same = false;
    hci_fleet_row_cell(row, d->header, "words_digest", digest, sizeof digest);
    if (bind_text(d->find, 1, hci_fleet_cell(d->results->list, motor, "motor")) &&
        sqlite3_step(d->find) == SQLITE_ROW) {
        const unsigned char *found = sqlite3_column_text(d->find, 0);
        is_same = found && strcmp((const char *)found, digest) == 0;
    }
    sqlite3_reset(d->find);
    return is_same;
}

static hci_status put_all(const database *d, char *const *row, hci_fleet_stored *stored)
{
    hci_status status = HCI_OK;
    for (size_t k = 0; k < d->results->list->count && !status; ++k) {
        if (!row[k] && !stored->is_begun) status = forget(d, hci_fleet_cell(d->results->list, k, "motor"));
        if (!row[k] || stored->is_stored[k]) continue;
        stored->is_stored[k] = !stored->is_begun && has_row(d, k, row[k]);
        if (!stored->is_stored[k]) status = put_motor(d, k, row[k], stored->seconds[k]);
        stored->is_stored[k] = !status;
    }
    stored->is_begun = true;
    return status;
}

/* ---- all of it ---- */

static hci_status open_file(database *d, int wait_ms)
{
    if (snprintf(d->path, sizeof d->path, "%s/fleet.sqlite", d->results->folder) >= PATH_SIZE)
        return hci_note_set(d->note, HCI_ERROR_OUTPUT, "%.200s…: the path is too long", d->results->folder);
    if (sqlite3_open(d->path, &d->file) != SQLITE_OK) return refused(d);
    sqlite3_busy_timeout(d->file, wait_ms); /* somebody may be reading */
    hci_fleet_header(d->results->command, d->header);
    hci_status status = run(d, "BEGIN IMMEDIATE");
    if (!status) status = make_tables(d);
    return status ? status : prepare_all(d);
}

static void close_file(database *d)
{
    sqlite3_stmt *all[] = {d->find, d->put, d->put_parameter, d->forget, d->forget_parameters};
    for (size_t k = 0; k < sizeof all / sizeof all[0]; ++k)
        sqlite3_finalize(all[k]);
    sqlite3_close(d->file);
}

/* Nothing of this call is there. */
static void take_back(const hci_fleet_results *results, hci_fleet_stored *stored)
{
    memset(stored->is_stored, 0, results->list->count * sizeof *stored->is_stored);
    stored->is_begun = false;
}

static hci_status store(const hci_fleet_results *results, char *const *row, hci_fleet_stored *stored,
                        int wait_ms, hci_note *note)
{
    database d;
    memset(&d, 0, sizeof d);
    d.results = results;
    d.note = note;
    hci_status status = open_file(&d, wait_ms);
    if (!status) status = put_all(&d, row, stored);
    if (!status) status = run(&d, "COMMIT");
    if (status) take_back(results, stored);
    if (status && !stored->is_last && is_held(&d)) status = HCI_OK;
    close_file(&d); /* what was not committed is rolled back */
    return status;
}

/* Memory that was short for a moment may have hidden a table from SQLite: an error is one that comes again.
 */
hci_status hci_fleet_store(const hci_fleet_results *results, char *const *row, hci_fleet_stored *stored,
                           hci_note *note)
{
    const hci_status status = store(results, row, stored, stored->is_last ? LAST_WAIT_MS : WAIT_MS, note);
    return status == HCI_ERROR_OUTPUT ? store(results, row, stored, WAIT_MS, note) : status;
}
