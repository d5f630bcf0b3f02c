/* Recordings: reads each, keeps its statistics, forgets the samples. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "host/base/memory.h"
#include "host/check/data/exchanged_angle.h"
#include "host/check/data/exchanged_currents.h"
#include "host/check/data/run_parts.h"
#include "host/numeric/statistics.h"
#include "host/recording/computed_torque.h"
#include "host/recording/effort.h"

#define DEGREE (HCI_PI / 180.0)

/* What is looked at again for each interpretation: the angle, and the torque, or in its place the current
 * that balances it. */
static bool keep_samples(const check_samples *s, check_run *run)
{
    const double *ripple = run->is_held || run->turns_steadily ? s->q : s->torque;
    run->theta = s->theta ? hci_memory_new(s->count, sizeof *run->theta) : NULL;
    run->torque = ripple ? hci_memory_new(s->count, sizeof *run->torque) : NULL;
    if ((s->theta && !run->theta) || (ripple && !run->torque)) return false;
    if (s->theta) memcpy(run->theta, s->theta, s->count * sizeof *run->theta);
    for (size_t k = 0; ripple && k < s->count; ++k)
        run->torque[k] = ripple == s->torque ? ripple[k] : -ripple[k];
    if (ripple) hci_check_run_ripple(run);
    return true;
}

static bool part_take(const check_samples *s, check_data *data, check_run *run)
{
    run->count = s->count;
    const double p = data->value[CHECK_pole_pairs];
    run->declared_pole_pairs = isfinite(p) ? p : 0.0;
    hci_check_run_means(s, run);
    if (s->theta) hci_check_run_frames(data, s, run);
    return keep_samples(s, run);
}

/* Each part of the recording is a run of its own; *file is what they have in common. */
static bool parts_take(const check_samples *s, const check_run *file, check_data *data)
{
    signed char *part = hci_memory_new(s->count, sizeof *part);
    const bool is_held = s->torque && s->q && !(hci_mean_square_about(s->torque, s->count, 0.0) > 0.0);
    const int parts = part ? hci_check_parts_find(s, is_held, part) : 0;
    bool good = parts > 0;
    for (int k = 0; k < parts && good; ++k) {
        check_samples one;
        check_run *run = &data->run[data->runs++];
        *run = *file;
        good = hci_check_part_take(s, part, k, &one) && part_take(&one, data, run);
        hci_check_part_release(&one);
    }
    hci_memory_free(part);
    return good;
}

/* The samples as the recording of a drive: angle and currents as they stand. memory: [4 × count]. */
static hci_run run_of(const check_samples *s, const check_data *data, const check_run *file, double *memory)
{
    const double pole_pairs = data->value[CHECK_pole_pairs];
    double *theta_m_rad = memory + 3 * s->count;
    hci_run run = {.count = s->count,
                   .pole_pairs = (int)pole_pairs,
                   .time_s = s->columns.value[HCI_RUN_TIME],
                   .theta_m_rad = theta_m_rad,
                   .i_A = memory,
                   .torque_Nm = s->columns.value[HCI_RUN_TORQUE],
                   .torque_source = HCI_TORQUE_MEASURED};
    run.has_sum = s->columns.has[HCI_RUN_IA] && s->columns.has[HCI_RUN_IB] && s->columns.has[HCI_RUN_IC];
    run.computed_phase = !run.has_sum;
    for (size_t k = 0; k < s->count; ++k) {
        theta_m_rad[k] = s->theta[k] / (file->is_electrical ? pole_pairs : 1.0);
        hci_run_phases_at(&s->columns, HCI_RUN_IA, k, run.i_A + 3 * k);
    }
    return run;
}

/* Why the torque is none to compare; NULL: it is one. */
static const char *why_of(const hci_run *run, const hci_torque_estimate *estimate)
{
    if (estimate->within_rounding)
        return "the torque is i_q times a number: the drive has computed it, and it is not compared";
    return hci_torque_is_typed(run)
               ? "the torque is one number in every row while the current varies: typed, "
                 "or of a sensor at its end, and it is not compared"
               : NULL;
}

static hci_status phases_tell(const check_samples *s, const check_data *data, const check_run *file,
                              const char **why, hci_note *note)
{
    hci_torque_estimate estimate;
    const bool has = s->time && s->theta && s->current && s->torque && data->value[CHECK_pole_pairs] >= 1.0;
    if (!has) return HCI_OK;
    double *memory = hci_memory_new(4 * s->count, sizeof *memory);
    if (!memory) return hci_note_memory(note, file->path, "its samples");
    const hci_run run = run_of(s, data, file, memory);
    const hci_status status = hci_torque_estimate_of(&run, 0.0, &estimate, note);
    if (!status) *why = why_of(&run, &estimate);
    hci_memory_free(memory);
    return status;
}

/* A torque that follows i_q in time to the last digit is none that was measured, and of one that stands at
 * the end of its sensor the mean is none. */
static hci_status torque_doubt(const check_samples *s, const check_data *data, const check_run *file,
                               const char **why, hci_note *note)
{
    double constant;
    *why = NULL;
    if (s->torque && s->columns.torque_is_clipped)
        *why = "the mean of a torque that is clipped is not compared";
    else if (s->time && s->q && s->torque && hci_torque_is_of_current(s->torque, s->q, s->count, &constant))
        *why = "the torque is i_q times a number: the drive has computed it, and it is not compared";
    return *why ? HCI_OK : phases_tell(s, data, file, why, note);
}

/* What the current does to the motion. A friction of one direction alone may be another machine that drives.
 */
static int current_way(const check_samples *s, const check_run *file)
{
    if (s->torque || !s->time || !s->speed || !s->q) return 0;
    const hci_effort effort = hci_effort_find(
        &(hci_effort_samples){s->time, s->speed, s->q, file->is_electrical ? NULL : s->theta, s->count});
    const bool is_told = effort.has_both_ways || hci_effort_accelerates(&effort);
    return is_told ? hci_effort_way(&effort) : 0;
}

static hci_status run_take(const hci_csv *csv, check_data *data, check_run *file, hci_note *remark,
                           hci_note *note)
{
    check_samples s = {0};
    const char *why = NULL;
    hci_status status = hci_check_samples_read(csv, data, file, &s, remark, note);
    if (!status) status = torque_doubt(&s, data, file, &why, note);
    if (!status && why) {
        hci_note_add(remark, "%s", why);
        if (hci_peak_to_peak(s.torque, s.count) <= 0.0) file->typed_torque = s.torque[0];
        s.torque = NULL;
    }
    if (!status) file->current_way = current_way(&s, file);
    if (!status) file->is_exchanged = hci_check_is_exchanged(s.theta, s.torque, s.count);
    if (!status) file->standing_phase = file->has_abc ? hci_check_standing_phase(&s, &file->standing_A) : -1;
    if (!status && !s.torque) file->currents_are_exchanged = hci_check_currents_are_exchanged(&s);
    if (!status && !parts_take(&s, file, data)) status = hci_note_memory(note, file->path, "its samples");
    hci_check_samples_release(&s);
    return status;
}

static hci_status run_read(const char *path, const hci_run_options *reading, check_data *data,
                           hci_note *remark, hci_note *note)
{
    hci_csv *csv;
    hci_status status;
    check_run file = {.path = path};
    if (strlen(path) >= CHECK_PATH)
        return hci_note_set(note, HCI_ERROR_INPUT, "%.200s…: the path is longer than %d bytes", path,
                            CHECK_PATH - 1);
    status = hci_run_csv(path, reading, &csv, note);
    if (status) return status;
    status = run_take(csv, data, &file, remark, note);
    hci_csv_free(csv);
    return status;
}

static void add_scale(check_data *data, double scale)
{
    for (size_t k = 0; k < data->scales; ++k)
        if (fabs(data->scale[k] / scale - 1.0) < 1e-9) return;
    data->scale[data->scales++] = scale;
}

/* 1, p and p/2 electrical radians for a recorded one, and so for degrees and turns, and for radians
 * that were read as degrees. */
static void scales_make(check_data *data)
{
    const double p = data->value[CHECK_pole_pairs];
    static const double UNIT[] = {1.0, DEGREE, 2.0 * HCI_PI, 1.0 / DEGREE};
    for (size_t k = 0; k < sizeof UNIT / sizeof *UNIT; ++k) {
        add_scale(data, UNIT[k]);
        add_scale(data, UNIT[k] * p);
        if (fmod(p, 2.0) == 0.0) add_scale(data, UNIT[k] * 0.5 * p);
    }
}

/* A current up to which none flows, beside what is rated or recorded. Where that makes none of all that was
 * recorded, and recordings with and without a current are told from each other all the same, the rating is in
 * another unit. */
static double no_current(const check_data *data)
{
    double least = INFINITY, most = NAN;
    for (size_t k = 0; k < data->runs; ++k) {
        const double current = sqrt(data->run[k].current_square);
        least = fmin(least, current); /* of NAN and a number the number */
        most = fmax(most, current);
    }
    const double rated = data->value[CHECK_rated_current_A];
    const bool is_of_rated =
        rated > most && !(most < CHECK_NO_CURRENT * rated && least < CHECK_NO_CURRENT * most);
    return CHECK_NO_CURRENT * (is_of_rated || isnan(most) ? rated : most);
}

/* ---- one number for torque */

#define SAME    1e-9 /* of a torque: one number */
#define ANOTHER 0.1  /* of the largest current */

static bool is_one_number(const check_run *r)
{
    return r->has_torque && r->torque && r->torque_variance <= pow(SAME * r->torque_mean, 2.0);
}

/* One number that another recording has as well, where that was typed, or at another current. */
static bool is_typed_beside(const check_run *a, const check_run *b, double most_A)
{
    const bool is_typed = fabs(b->typed_torque) > 0.0;
    const double other_Nm = is_typed ? b->typed_torque : b->torque_mean;
    if (strcmp(a->path, b->path) == 0 || !(is_typed || is_one_number(b)) ||
        fabs(other_Nm - a->torque_mean) > SAME * fabs(a->torque_mean))
        return false;
    return is_typed || fabs(sqrt(a->current_square) - sqrt(b->current_square)) > ANOTHER * most_A;
}

static void typed_find(check_data *data)
{
    double most_A = 0.0;
    for (size_t k = 0; k < data->runs; ++k)
        most_A = fmax(most_A, sqrt(data->run[k].current_square));
    for (size_t k = 0; k < data->runs; ++k)
        for (size_t j = 0; j < data->runs && is_one_number(&data->run[k]); ++j)
            if (is_typed_beside(&data->run[k], &data->run[j], most_A))
                data->run[k].typed_torque = data->run[k].torque_mean;
}

static void typed_leave(const char *const *path, size_t count, check_data *data, hci_note *remark)
{
    typed_find(data);
    for (size_t k = 0; k < data->runs; ++k) {
        check_run *r = &data->run[k];
        if (!(fabs(r->typed_torque) > 0.0) || !r->has_torque) continue;
        r->has_torque = false;
        hci_memory_free(r->torque);
        r->torque = NULL;
        for (size_t j = 0; j < count && (k == 0 || r->path != data->run[k - 1].path); ++j)
            if (path[j] == r->path)
                hci_note_add(&remark[j], "the torque is one number in every row, as in another recording: "
                                         "typed, or of a sensor that stands still, and it is not compared");
    }
}

/* ---- the zero of the torque sensor */

/* Of two speeds, that friction is alike at. */
#define LIKE_SPEEDS 1.25

/* Without a current: the mean torque and speed of each direction. */
typedef struct {
    double torque[2], speed[2], count[2];
} open_torque;

static open_torque open_torque_of(const check_data *data)
{
    open_torque open = {{0.0}, {0.0}, {0.0}};
    for (size_t k = 0; k < data->runs; ++k) {
        const check_run *r = &data->run[k];
        const double speed = r->has_speed ? r->speed : r->angle_rate;
        if (!r->has_torque || hci_check_has_current(data, r) || !(fabs(speed) > 0.0)) continue;
        open.torque[speed < 0.0] += (double)r->count * r->torque_mean;
        open.speed[speed < 0.0] += (double)r->count * fabs(speed);
        open.count[speed < 0.0] += (double)r->count;
    }
    return open;
}

/* Friction turns its sign with the motion, the zero of the sensor does not: it leaves the torques of all
 * recordings where both directions tell it. */
static void take_torque_zero(check_data *data)
{
    const open_torque open = open_torque_of(data);
    const double forward = open.speed[0] / open.count[0], backward = open.speed[1] / open.count[1];
    data->torque_zero_is_told = forward < LIKE_SPEEDS * backward && backward < LIKE_SPEEDS * forward;
    if (!data->torque_zero_is_told) return;
    const double zero = 0.5 * (open.torque[0] / open.count[0] + open.torque[1] / open.count[1]);
    for (size_t k = 0; k < data->runs; ++k) {
        check_run *r = &data->run[k];
        if (!r->has_torque) continue;
        r->torque_mean -= zero;
        r->torque_at_speed -= zero;
        for (size_t n = 0; n < r->count && r->torque; ++n)
            r->torque[n] -= zero;
    }
}

/* Of several recordings each may lack columns that names give; one that none has is an error, and so is one
 * without which a recording cannot be read. */
static hci_status all_read(const char *const *path, size_t count, const hci_run_options *reading,
                           check_data *data, hci_note *remark, hci_note *note)
{
    hci_run_options each = *reading;
    const size_t names = reading->columns ? reading->columns->count : 0;
    size_t *found = hci_memory_new(names + 1, sizeof *found);
    hci_status status = found ? HCI_OK : hci_note_memory(note, NULL, "%zu runs", count);
    if (count > 1) each.columns_found = found;
    for (size_t k = 0; k < count && !status; ++k) {
        status = run_read(path[k], &each, data, &remark[k], note);
        if (status == HCI_ERROR_INPUT && count > 1)
            status = run_read(path[k], reading, data, &remark[k], note);
    }
    if (!status && count > 1) status = hci_column_names_check_found(reading->columns, found, path[0], note);
    hci_memory_free(found);
    return status;
}

hci_status hci_check_runs_read(const char *const *path, size_t count, const hci_run_options *reading,
                               check_data *data, hci_note *remark, hci_note *note)
{
    hci_status status;
    data->columns = reading->columns;
    scales_make(data);
    data->run = hci_memory_new(CHECK_MOST_PARTS * count, sizeof *data->run);
    if (!data->run) return hci_note_memory(note, NULL, "%zu runs", count);
    status = all_read(path, count, reading, data, remark, note);
    data->no_current_A = no_current(data);
    if (!status) typed_leave(path, count, data, remark);
    if (!status) take_torque_zero(data);
    return status;
}

double hci_check_given_zero_rad(const check_data *data)
{
    double given_rad = 0.0;
    for (size_t k = 0; k < data->runs && given_rad == 0.0; ++k)
        given_rad = data->run[k].given_zero_rad;
    return given_rad;
}

void hci_check_data_release(check_data *data)
{
    for (size_t k = 0; k < data->runs; ++k) {
        hci_memory_free(data->run[k].theta);
        hci_memory_free(data->run[k].torque);
    }
    hci_memory_free(data->run);
    hci_memory_free(data->emf.order);
    hci_memory_free(data->cogging.order);
    memset(data, 0, sizeof *data);
}

bool hci_check_has_current(const check_data *data, const check_run *run)
{
    return sqrt(run->current_square) > data->no_current_A && run->current_square > 0.0;
}
