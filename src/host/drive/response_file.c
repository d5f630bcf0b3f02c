#include "host/drive/response_file.h"

#include <math.h>

#include "hci/host/csv/csv.h"

#include "host/base/memory.h"
#include "host/base/quote.h"

enum { FREQUENCY, GAIN_D, PHASE_D, GAIN_Q, PHASE_Q, COLUMNS };

static const char *const COLUMN[COLUMNS] = {"frequency_Hz", "gain_d", "phase_d_rad", "gain_q", "phase_q_rad"};

static hci_status check_row(const hci_csv *csv, size_t row, const hci_loop_point *p, hci_note *note)
{
    const double before = row > 0 ? p[-1].frequency_Hz : 0.0;
    if (!(p->frequency_Hz > before))
        return hci_csv_error(csv, COLUMN[FREQUENCY], row, note,
                             row > 0 ? "a frequency above that of the row before" : "a frequency above 0",
                             "sort the rows by the frequency, and leave out 0");
    for (int axis = 0; axis < 2; ++axis)
        if (!(p->gain[axis] > 0.0))
            return hci_csv_error(csv, COLUMN[axis ? GAIN_Q : GAIN_D], row, note,
                                 "a ratio of amplitudes above 0, not decibels", "10^(dB/20) is the ratio");
    return HCI_OK;
}

/* A loop that lets most of a reference through is late by less than half a period. */
#define LETS_THROUGH 0.7
#define HALF_RAD     3.14159265358979323846

static bool is_of_degrees(const hci_loop_point *p, int axis)
{
    return p->gain[axis] > LETS_THROUGH && fabs(p->phase_rad[axis]) > HALF_RAD;
}

/* Whether no phase of an axis is below 0, and one is plainly above. */
static bool is_early(const hci_loop_point *points, size_t count, int axis)
{
    double most_rad = 0.0;
    for (size_t k = 0; k < count; ++k) {
        if (points[k].phase_rad[axis] < 0.0) return false;
        most_rad = fmax(most_rad, points[k].phase_rad[axis]);
    }
    return most_rad > 0.1 * HALF_RAD;
}

/* Far beyond what a turn's lateness or two makes. */
#define MANY_RAD (4.0 * HALF_RAD)

static double largest_phase_rad(const hci_loop_point *points, size_t count, int axis)
{
    double most_rad = 0.0;
    for (size_t k = 0; k < count; ++k)
        most_rad = fmax(most_rad, fabs(points[k].phase_rad[axis]));
    return most_rad;
}

static bool is_half_a_turn_on(const hci_loop_point *points, size_t count, int axis)
{
    return largest_phase_rad(points, count, axis) < MANY_RAD &&
           fabs(fabs(points[0].phase_rad[axis]) - HALF_RAD) < 0.5;
}

static const char HALF_TURN[] =
    "where slow currents are half a turn late, reference and current have different "
    "signs: add half a turn to the phases";

static const char *remedy_of_phases(const hci_loop_point *points, size_t count, int axis)
{
    if (is_half_a_turn_on(points, count, axis)) return HALF_TURN;
    return axis ? "degrees are in a column `phase_q_deg`, which is converted"
                : "degrees are in a column `phase_d_deg`, which is converted";
}

/* Where the loop follows, it answers with 1. */
#define MOST_GAIN 10.0

static hci_status check_gains(const hci_csv *csv, const hci_loop_point *points, hci_note *note)
{
    for (int axis = 0; axis < 2; ++axis)
        if (points[0].gain[axis] > MOST_GAIN)
            return hci_csv_error(csv, COLUMN[axis ? GAIN_Q : GAIN_D], 0, note,
                                 "a ratio of amplitudes, near 1 at the lowest frequency",
                                 "per cent are divided by 100");
    return HCI_OK;
}

/* Phases that no loop has. */
static hci_status check_phases(const hci_csv *csv, const hci_loop_point *points, hci_note *note)
{
    const size_t count = hci_csv_rows(csv);
    for (int axis = 0; axis < 2; ++axis) {
        const char *const column = COLUMN[axis ? PHASE_Q : PHASE_D];
        for (size_t k = 0; k < count; ++k)
            if (is_of_degrees(&points[k], axis))
                return hci_csv_error(csv, column, k, note,
                                     "less than half a period of lateness where the gain is above 0.7",
                                     remedy_of_phases(points, count, axis));
        if (is_early(points, count, axis))
            return hci_csv_error(csv, column, count - 1, note, "phases below 0, since the current is late",
                                 is_half_a_turn_on(points, count, axis) ? HALF_TURN
                                                                        : "turn the sign of the column");
    }
    return HCI_OK;
}

static hci_status check_count(const hci_csv *csv, size_t rows, hci_note *note)
{
    char path[HCI_QUOTE_PATH_SIZE];
    if (rows >= HCI_RESPONSE_LEAST) return HCI_OK;
    return hci_note_set(
        note, HCI_ERROR_INPUT,
        "%s: found %zu frequencies, expected at least %d, from a tenth of the loop's bandwidth "
        "to the highest that matters",
        hci_quote_path(hci_csv_path(csv), path), rows, (int)HCI_RESPONSE_LEAST);
}

static hci_status take_columns(const hci_csv *csv, hci_loop_point *points, double *value, hci_note *note)
{
    const size_t rows = hci_csv_rows(csv);
    hci_status status = HCI_OK;
    for (int c = 0; c < COLUMNS && !status; ++c) {
        status = hci_csv_numbers(csv, COLUMN[c], value, note);
        for (size_t k = 0; k < rows && !status; ++k) {
            if (c == FREQUENCY) points[k].frequency_Hz = value[k];
            if (c == GAIN_D || c == GAIN_Q) points[k].gain[c == GAIN_Q] = value[k];
            if (c == PHASE_D || c == PHASE_Q) points[k].phase_rad[c == PHASE_Q] = value[k];
        }
    }
    for (size_t k = 0; k < rows && !status; ++k)
        status = check_row(csv, k, &points[k], note);
    if (!status) status = check_gains(csv, points, note);
    return status ? status : check_phases(csv, points, note);
}

hci_status hci_response_read(const char *path, hci_loop_point **points, size_t *count, hci_note *note)
{
    hci_csv *csv;
    hci_status status = hci_csv_read(path, &csv, note);
    if (status) return status;
    const size_t rows = hci_csv_rows(csv);
    double *value = hci_memory_new(rows, sizeof *value);
    hci_loop_point *p = hci_memory_new(rows, sizeof *p);
    if (!value || !p) status = hci_note_memory(note, path, "its rows");
    if (!status) status = check_count(csv, rows, note);
    if (!status) status = take_columns(csv, p, value, note);
    hci_memory_free(value);
    hci_csv_free(csv);
    if (status) {
        hci_memory_free(p);
        return status;
    }
    *points = p;
    *count = rows;
    return HCI_OK;
}
