#include "host/recording/list/torque_clock.h"

#include <math.h>

#include "hci/math/harmonic.h"
#include "host/base/memory.h"
#include "host/numeric/statistics.h"
#include "host/recording/list/common_delay.h"
#include "host/recording/slow_turn.h"

#define LONGEST_S  0.25 /* delay, either way */
#define SHORTEST_S 5e-3 /* up to there the diagnosis looks for it along time */
#define TURNED_RAD 0.7  /* by which the ripple is turned at least */
#define UNLIKE     25.0 /* χ² for a degree of freedom, of ripples that are not the same */
#define EXPLAINED  0.1  /* of that, which the delay leaves at most … */
#define TOLD       3.0  /* … and by what another one leaves more */
#define STEADY     0.1  /* of the speed, by which halves of a recording differ */

enum { LEAST_RUNS = 3, LEAST_TURNS = 2, LEAST_ROWS = 200, MOST_ROWS = 60000 };

/* ---- waves of a recording ---- */

/* How many rows, of MOST_ROWS, make whole turns; 0: fewer than LEAST_TURNS, or not at a steady speed. */
static size_t whole_turns(const hci_run *run)
{
    const size_t most = run->count < MOST_ROWS ? run->count : MOST_ROWS;
    const double *theta = run->theta_m_rad, *time = run->time_s;
    const double turns = floor(fabs(theta[most - 1] - theta[0]) / (2.0 * HCI_PI));
    size_t rows = 0;
    if (turns < LEAST_TURNS) return 0;
    while (rows < most && fabs(theta[rows] - theta[0]) < turns * 2.0 * HCI_PI)
        ++rows;
    const size_t half = rows / 2;
    const double first = (theta[half] - theta[0]) / (time[half] - time[0]),
                 second = (theta[rows - 1] - theta[half]) / (time[rows - 1] - time[half]);
    return fabs(first - second) < STEADY * fabs(first) ? rows : 0;
}

static bool is_telling(const hci_run *run)
{
    return run->torque_source == HCI_TORQUE_MEASURED && run->torque_Nm && run->time_s && run->theta_m_rad &&
           run->count >= LEAST_ROWS && whole_turns(run) >= LEAST_ROWS;
}

/* Adds a row to all orders, by turning on. */
static void add_row(double angle_rad, double torque_Nm, hci_delay_wave *wave)
{
    const double c = cos(angle_rad), s = sin(angle_rad);
    double re = c, im = s;
    for (size_t n = 1; n <= HCI_DELAY_ORDERS; ++n) {
        wave[n].cosine += re * torque_Nm;
        wave[n].sine += im * torque_Nm;
        const double next = re * c - im * s;
        im = re * s + im * c;
        re = next;
    }
}

/* Of each coordinate, by the median of the squares of all orders: that of an exponential distribution is ln 2
 * of its mean. */
static double noise_of(const hci_delay_wave *wave)
{
    double square[HCI_DELAY_ORDERS];
    for (size_t n = 1; n <= HCI_DELAY_ORDERS; ++n)
        square[n - 1] = wave[n].cosine * wave[n].cosine + wave[n].sine * wave[n].sine;
    return sqrt(hci_median(square, HCI_DELAY_ORDERS) / (2.0 * log(2.0)));
}

static void record_make(const hci_run *run, hci_delay_record *record)
{
    const size_t rows = whole_turns(run);
    const double *theta = run->theta_m_rad, *time = run->time_s;
    *record = (hci_delay_record){.load = hci_mean(run->torque_Nm, rows)};
    record->speed_rad_per_s = (theta[rows - 1] - theta[0]) / (time[rows - 1] - time[0]);
    for (size_t k = 0; k < rows; ++k)
        add_row(theta[k], run->torque_Nm[k] - record->load, record->wave);
    for (size_t n = 1; n <= HCI_DELAY_ORDERS; ++n) {
        record->wave[n].cosine *= 2.0 / (double)rows;
        record->wave[n].sine *= 2.0 / (double)rows;
    }
    record->std_error = noise_of(record->wave);
}

/* ---- the delay of all of them ---- */

static bool is_told(const hci_common_delay *d)
{
    return d->before > UNLIKE * d->freedom && d->left < EXPLAINED * d->before && d->other > TOLD * d->left &&
           fabs(d->delay_s) > SHORTEST_S && d->turned_rad > TURNED_RAD;
}

/* *delay_s: 0: none is told. */
static hci_status find_delay(const hci_run *runs, size_t count, double *delay_s, hci_note *note)
{
    hci_common_delay found;
    size_t telling = 0;
    *delay_s = 0.0;
    for (size_t k = 0; k < count; ++k)
        telling += is_telling(&runs[k]);
    if (telling < LEAST_RUNS) return HCI_OK;
    hci_delay_record *record = hci_memory_new(telling, sizeof *record);
    if (record == NULL) return hci_note_memory(note, NULL, "ripples of %zu recordings", telling);
    telling = 0;
    for (size_t k = 0; k < count; ++k)
        if (is_telling(&runs[k])) record_make(&runs[k], &record[telling++]);
    if (hci_common_delay_find(record, telling, LONGEST_S, &found) && is_told(&found))
        *delay_s = found.delay_s;
    hci_memory_free(record);
    return HCI_OK;
}

/* ---- what was read in time ---- */

/* torque_Nm: out, that of the row next to a time, as it was read: a line between two rows would make a ripple
 * smaller, and what is left, less than a row, the diagnosis finds. at: where it was looked for last. False:
 * there is none. */
static bool torque_of(const hci_run *run, double time_s, size_t *at, double *torque_Nm)
{
    const double *time = run->time_s;
    while (*at + 1 < run->count && time[*at + 1] < time_s)
        ++*at;
    if (*at + 1 == run->count || time_s < time[*at]) return false;
    if (run->gap_s > 0.0 && time[*at + 1] - time[*at] > run->gap_s) return false;
    *torque_Nm = run->torque_Nm[time_s - time[*at] < time[*at + 1] - time_s ? *at : *at + 1];
    return true;
}

static hci_status move(hci_run *run, double delay_s, hci_note *note)
{
    double *torque_Nm = hci_memory_new(run->count, sizeof *torque_Nm);
    bool *out = hci_memory_new(run->count, sizeof *out);
    size_t at = 0;
    for (size_t k = 0; k < run->count && torque_Nm && out; ++k)
        out[k] = !torque_of(run, run->time_s[k] + delay_s, &at, &torque_Nm[k]);
    if (torque_Nm == NULL || out == NULL) {
        hci_memory_free(torque_Nm);
        hci_memory_free(out);
        return hci_note_memory(note, run->name, "its torque in time");
    }
    hci_memory_free(run->torque_Nm);
    run->torque_Nm = torque_Nm;
    hci_run_rows_leave(run, out);
    hci_memory_free(out);
    hci_note_add(
        &run->remark,
        "the torque is read %.4g s %s beside the angle in all recordings, as by a logger of its own whose "
        "clock is another: the ripples at their speeds tell it, and it is moved by that",
        fabs(delay_s), delay_s > 0.0 ? "late" : "early");
    return HCI_OK;
}

hci_status hci_torque_clock_align(hci_run *runs, size_t count, hci_note *note)
{
    double delay_s;
    hci_status status = find_delay(runs, count, &delay_s, note);
    for (size_t k = 0; k < count && !status && fabs(delay_s) > 0.0; ++k)
        if (runs[k].torque_source == HCI_TORQUE_MEASURED && runs[k].torque_Nm && runs[k].time_s)
            status = move(&runs[k], delay_s, note);
    return status;
}
