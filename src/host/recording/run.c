#include "hci/host/recording/run.h"

#include <assert.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "core/math/vector.h"
#include "hci/host/csv/csv.h"
#include "hci/math/harmonic.h"
#include "host/angle/between_steps.h"
#include "host/angle/steps_of.h"
#include "host/angle/unwrap.h"
#include "host/base/memory.h"
#include "host/base/quote.h"
#include "host/csv/table.h"
#include "host/numeric/derivative.h"
#include "host/numeric/statistics.h"
#include "host/recording/bare_angle.h"
#include "host/recording/clock.h"
#include "host/recording/computed_torque.h"
#include "host/recording/effort.h"
#include "host/recording/holes.h"
#include "host/recording/rotor_frame.h"
#include "host/recording/run_columns.h"
#include "host/recording/slow_turn.h"
#include "host/recording/speed_variation.h"
#include "host/recording/untold_torque.h"

/* Less movement than this is a shaft at rest, whose angle only flickers. */
#define MOVED_RAD (2.0 * HCI_PI / 100.0)

/* theta_e and p·theta_m follow each other when their difference is as steady as this (1: constant). */
#define STEADY 0.9

typedef struct {
    hci_run_columns columns;
    hci_run *run;
    hci_note *note;
    const hci_run_options *options;
    int pole_pairs;
    size_t predicted; /* steps of the angle whose whole turns are from the speed */
    bool no_currents; /* no column of them */
} reader;

/* ---- columns ---- */

static hci_status memory_error(const reader *r)
{
    return hci_note_memory(r->note, hci_csv_path(r->columns.csv), "%zu samples", r->run->count);
}

static bool has(const reader *r, hci_run_column which)
{
    return r->columns.has[which];
}

/* The column if the file has it; *values stays NULL where not. */
static hci_status read_column(reader *r, hci_run_column which, double **values)
{
    const hci_status status = hci_run_column_read(&r->columns, which);
    if (!status) *values = hci_run_column_take(&r->columns, which);
    return status;
}

static void keep_header(const reader *r, hci_run_column which, char text[HCI_RUN_NAME])
{
    size_t line;
    const char *header = hci_run_column_header(&r->columns, which, &line);
    snprintf(text, HCI_RUN_NAME, "%s", header != NULL ? header : "");
}

static hci_status missing(const reader *r, const char *found, const char *expected, const char *remedy)
{
    char path[HCI_QUOTE_PATH_SIZE];
    return hci_note_set(r->note, HCI_ERROR_INPUT, "%s: found %s, expected %s; %s",
                        hci_quote_path(hci_csv_path(r->columns.csv), path), found, expected, remedy);
}

/* ---- time and speed ---- */

static hci_stamps stamps_of(const hci_run *run)
{
    return (hci_stamps){run->time_s, run->row, run->count};
}

static void drop_time(hci_run *run)
{
    hci_memory_free(run->time_s);
    run->time_s = NULL;
    run->gap_s = 0.0;
}

static hci_status read_time(reader *r)
{
    hci_run *run = r->run;
    const hci_status status = read_column(r, HCI_RUN_TIME, &run->time_s);
    keep_header(r, HCI_RUN_TIME, run->time_column);
    if (status || run->time_s == NULL) return status;
    run->rough_clock = hci_clock_is_rough(stamps_of(run));
    if (!hci_clock_mend(stamps_of(run), &run->remark)) drop_time(run);
    if (run->time_s) run->gap_s = hci_clock_gap_s(run->time_s, run->count);
    return HCI_OK;
}

/* A clock that does not belong to the angle: smoothed, or left out where the speed and the torque do not need
 * it. */
static hci_status mend_clock(reader *r, hci_angle_path path)
{
    hci_run *run = r->run;
    const bool spare = run->speed_rad_per_s != NULL && has(r, HCI_RUN_TORQUE);
    if (run->time_s == NULL || run->theta_m_rad == NULL) return HCI_OK;
    if (path == HCI_ANGLE_SCATTERED) return HCI_OK;
    if (spare && 2 * r->predicted > run->count) {
        hci_note_add(
            &run->remark,
            "samples are more than half a turn apart: each is taken by itself, the time is not used");
        drop_time(run);
        return HCI_OK;
    }
    double *work = hci_memory_new(run->count, sizeof *work);
    if (work == NULL) return memory_error(r);
    const hci_clock_kind kind = hci_clock_judge(stamps_of(run), run->theta_m_rad, r->pole_pairs, work);
    if (kind == HCI_CLOCK_JITTERS) hci_clock_smooth(stamps_of(run), work, &run->remark);
    hci_memory_free(work);
    if (kind != HCI_CLOCK_FOREIGN || !spare) return HCI_OK;
    hci_note_add(&run->remark, "angle and time were not taken at the same instants: the time is not used");
    drop_time(run);
    return HCI_OK;
}

/* Between the steps of an encoder the shaft goes on along the time. */
static hci_status follow_angle(reader *r, hci_angle_path path)
{
    hci_run *run = r->run;
    if (run->time_s == NULL || run->theta_m_rad == NULL || path == HCI_ANGLE_SCATTERED) return HCI_OK;
    run->angle_step_rad = hci_steps_of(run->theta_m_rad, run->count);
    const double step_rad = hci_angle_between_steps(run->theta_m_rad, run->time_s, run->count);
    if (step_rad < 0.0) return memory_error(r);
    if (step_rad > 0.0)
        hci_note_add(
            &run->remark,
            "the angle is read in steps of %.3g degrees: between them it is taken to go on along the time",
            step_rad * 180.0 / HCI_PI);
    return HCI_OK;
}

/* The mechanical speed, or the electrical one by the pole pairs. */
static hci_status read_speed(reader *r)
{
    double **speed = &r->run->speed_rad_per_s;
    const hci_run_column which = has(r, HCI_RUN_SPEED) ? HCI_RUN_SPEED : HCI_RUN_SPEED_E;
    keep_header(r, which, r->run->speed_column);
    r->run->speed_unit_rad_per_s = has(r, which) ? hci_run_column_factor(&r->columns, which) : 0.0;
    hci_status status = read_column(r, HCI_RUN_SPEED, speed);
    if (status || *speed != NULL) return status;
    status = read_column(r, HCI_RUN_SPEED_E, speed);
    r->run->speed_is_electrical = !status && *speed != NULL;
    for (size_t k = 0; !status && *speed != NULL && k < r->run->count; ++k)
        (*speed)[k] /= r->pole_pairs;
    return status;
}

static bool is_zero(const double *values, size_t count)
{
    for (size_t k = 0; k < count; ++k)
        if (fabs(values[k]) > 0.0) return false;
    return true;
}

static const char SLOPE[] = "the speed is the slope of the angle";
static const char SLOPE_OF_ZERO[] = "the speed is 0 but the angle moves: the slope of the angle is taken";
static const char SLOPE_OF_NOISE[] = "noise turns the sign of the recorded speed about while the angle goes "
                                     "one way: the slope of the angle is taken";

/* What is said of the slope of the angle where it takes the place of the speed; NULL: the speed stays. slope:
 * NULL: not known yet, then whether it may take its place. */
static const char *why_slope(const hci_run *run, const double *slope)
{
    if (run->speed_rad_per_s == NULL) return SLOPE;
    if (hci_peak_to_peak(run->theta_m_rad, run->count) <= MOVED_RAD) return NULL;
    if (is_zero(run->speed_rad_per_s, run->count)) return SLOPE_OF_ZERO;
    if (hci_speed_sign_changes(run->speed_rad_per_s, run->count) == 0) return NULL;
    return slope == NULL || hci_speed_sign_is_noise(run, slope) ? SLOPE_OF_NOISE : NULL;
}

/* The slope of the angle where no speed was recorded, or one that does not tell which way the shaft turns. */
static hci_status complete_speed(reader *r, hci_angle_path path)
{
    hci_run *run = r->run;
    if (run->theta_m_rad == NULL || run->time_s == NULL || run->count < 2) return HCI_OK;
    if (path == HCI_ANGLE_SCATTERED || why_slope(run, NULL) == NULL) return HCI_OK;
    double *slope = hci_memory_new(run->count, sizeof *slope);
    if (slope == NULL) return memory_error(r);
    const size_t window = hci_derivative_window(run->time_s, run->theta_m_rad, run->count);
    hci_derivative_over(run->time_s, run->theta_m_rad, run->count, window, slope);
    const char *why = why_slope(run, slope);
    if (why != NULL) {
        hci_note_add(&run->remark, "%s", why);
        run->speed_window = window;
        hci_memory_free(run->speed_rad_per_s);
        run->speed_rad_per_s = slope;
    } else {
        const size_t mended = hci_speed_sign_mend(run, slope);
        if (mended > 0)
            hci_note_add(&run->remark,
                         "in %zu row%s noise turns the sign of the recorded speed about: the slope of the "
                         "angle is taken "
                         "there",
                         mended, mended == 1 ? "" : "s");
        hci_memory_free(slope);
    }
    return HCI_OK;
}

/* ---- angle ---- */

/* An angle that the time does not order: each sample is a measurement of its own. */
static void leave_unordered(reader *r, const char *name)
{
    hci_note_add(&r->run->remark, "%s %s: samples without order, the time is not used", name,
                 r->run->speed_rad_per_s != NULL
                     ? "and the speed do not belong together (check pole pairs, units and time)"
                     : "moves a third of a turn or more from sample to sample (sample faster, add a speed "
                       "column or give the angle unwrapped)");
    drop_time(r->run);
}

/* Reads and unwraps one angle, whose speed is `factor` times the mechanical one. */
static hci_status read_angle(reader *r, hci_run_column which, double factor, double **angle,
                             hci_unwrapping *how)
{
    const size_t n = r->run->count;
    const char *name = which == HCI_RUN_THETA_E ? "theta_e_rad" : "theta_m_rad";
    hci_status status = read_column(r, which, angle);
    if (status || *angle == NULL) return status;
    double *rate = NULL;
    if (r->run->speed_rad_per_s != NULL) {
        rate = hci_memory_new(n, sizeof *rate);
        if (rate == NULL) return memory_error(r);
        for (size_t k = 0; k < n; ++k)
            rate[k] = factor * r->run->speed_rad_per_s[k];
    }
    *how = hci_unwrap(*angle, n, r->run->time_s, rate);
    hci_memory_free(rate);
    if (how->path == HCI_ANGLE_UNCLEAR) {
        leave_unordered(r, name);
        how->path = HCI_ANGLE_SCATTERED;
    } else if (how->path == HCI_ANGLE_SCATTERED)
        hci_note_add(&r->run->remark, "%s: samples without order in the angle, taken as they stand", name);
    if (how->predicted > r->predicted) r->predicted = how->predicted;
    if (how->predicted > 0)
        hci_note_add(&r->run->remark, "%s: whole turns of %zu steps are taken from the speed", name,
                     how->predicted);
    return HCI_OK;
}

/* Does an electrical angle tell how often the rotor has turned mechanically? */
static bool tells_turns(const reader *r, const hci_unwrapping *how)
{
    if (r->pole_pairs == 1 || how->path == HCI_ANGLE_WHOLE) return true;
    return how->path == HCI_ANGLE_UNWRAPPED && how->turns % (size_t)r->pole_pairs == 0;
}

/* Both angles: the phase of the electrical one, the turns of the mechanical one. */
static void join_angles(reader *r, const double *theta_e)
{
    const double p = r->pole_pairs;
    double *theta_m = r->run->theta_m_rad, sine = 0.0, cosine = 0.0;
    const size_t n = r->run->count;
    for (size_t k = 0; k < n; ++k) {
        sine += sin(theta_e[k] - p * theta_m[k]);
        cosine += cos(theta_e[k] - p * theta_m[k]);
    }
    const double offset = atan2(sine, cosine);
    const bool steady = hypot(sine, cosine) > STEADY * (double)n;
    r->run->turn_known = steady;
    if (!steady)
        hci_note_add(&r->run->remark, "theta_m does not follow theta_e with %d pole pairs and is not used",
                     r->pole_pairs);
    else if (fabs(offset) > 0.01)
        hci_note_add(&r->run->remark,
                     "theta_e is ahead of pole pairs x theta_m by %.3g rad and gives the phase", offset);
    for (size_t k = 0; k < n; ++k) {
        const double beside = steady ? p * theta_m[k] + offset : theta_e[k];
        theta_m[k] = (beside + remainder(theta_e[k] - beside, 2.0 * HCI_PI)) / p;
    }
}

/* Where the angle came from, for who has to name another unit or column. */
static void keep_angle_column(reader *r)
{
    double of_turn;
    hci_run *run = r->run;
    const hci_run_column which = has(r, HCI_RUN_THETA_E) ? HCI_RUN_THETA_E : HCI_RUN_THETA_M;
    if (!has(r, which)) return;
    keep_header(r, which, run->angle_column);
    run->angle_unit_rad = hci_run_column_factor(&r->columns, which);
    run->angle_is_counted = hci_csv_is_counted(r->columns.csv, r->columns.at[which], &of_turn);
}

static hci_status read_angles(reader *r, hci_angle_path *path)
{
    hci_run *run = r->run;
    hci_unwrapping mechanical = {.path = HCI_ANGLE_WITHIN}, electrical = mechanical;
    double *theta_e = NULL;
    hci_status status = read_angle(r, HCI_RUN_THETA_M, 1.0, &run->theta_m_rad, &mechanical);
    if (!status) status = read_angle(r, HCI_RUN_THETA_E, r->pole_pairs, &theta_e, &electrical);
    run->turn_known = run->theta_m_rad != NULL;
    run->is_electrical = theta_e != NULL;
    run->has_both_frames =
        r->columns.has[HCI_RUN_IA] && r->columns.has[HCI_RUN_ID] && r->columns.has[HCI_RUN_IQ];
    keep_angle_column(r);
    *path = mechanical.path;
    if (!status && theta_e != NULL) {
        if (run->theta_m_rad != NULL) {
            join_angles(r, theta_e);
        } else {
            run->turn_known = tells_turns(r, &electrical);
            *path = electrical.path;
            for (size_t k = 0; k < run->count; ++k)
                theta_e[k] /= r->pole_pairs;
            run->theta_m_rad = theta_e;
            theta_e = NULL;
        }
    }
    hci_memory_free(theta_e);
    return status;
}

/* The zero that the user gives. */
static void turn_angle(reader *r)
{
    const hci_csv *csv = r->columns.csv;
    hci_run *run = r->run;
    if (!csv->has_angle_offset || run->theta_m_rad == NULL) return;
    for (size_t k = 0; k < run->count; ++k)
        run->theta_m_rad[k] += csv->angle_offset_rad / r->pole_pairs;
    run->zero_is_given = true;
    run->zero_offset_rad = csv->angle_offset_rad;
    hci_note_add(&run->remark, "%.4g degrees electrical are added to the angle",
                 csv->angle_offset_rad * 180.0 / HCI_PI);
}

/* θ = ∫ω dt from 0, where only a speed was recorded. */
static hci_status integrate_speed(reader *r)
{
    hci_run *run = r->run;
    run->theta_m_rad = hci_memory_new(run->count, sizeof(double));
    if (run->theta_m_rad == NULL) return memory_error(r);
    for (size_t k = 1; k < run->count; ++k)
        run->theta_m_rad[k] =
            run->theta_m_rad[k - 1] + 0.5 * (run->speed_rad_per_s[k - 1] + run->speed_rad_per_s[k]) *
                                          (run->time_s[k] - run->time_s[k - 1]);
    run->turn_known = run->zero_is_unknown = true;
    hci_note_add(&run->remark, "no angle: it is speed x time, and its zero is not known");
    return hci_run_columns_angle_like(&r->columns, run->theta_m_rad, run->angle_like);
}

/* What does without an angle. */
static hci_status replace_angle(reader *r)
{
    hci_run *run = r->run;
    const bool voltages = has(r, HCI_RUN_VA) || has(r, HCI_RUN_VAB);
    const bool phases = hci_run_phase_count(&r->columns, HCI_RUN_IA) >= 2;
    if (run->theta_m_rad != NULL || voltages) return HCI_OK;
    if (run->time_s != NULL && run->speed_rad_per_s != NULL && !phases) return integrate_speed(r);
    run->only_mean = has(r, HCI_RUN_TORQUE) && has(r, HCI_RUN_IQ) && !phases;
    if (run->only_mean)
        hci_note_add(&run->remark, "no angle: torques over i_d and i_q, taken as means over a turn");
    else {
        hci_note remedy = {{0}};
        hci_note_set(&remedy, HCI_OK, "add the angle or give id_A and iq_A");
        hci_run_columns_say_angle(&r->columns, &remedy);
        return missing(r, "no angle beside phase currents", "theta_m_rad or theta_e_rad", remedy.text);
    }
    return HCI_OK;
}

/* ---- three phases ---- */

/* Puts columns of three phases side by side, by the first of them. out: [count][3]. */
static hci_status read_phases(reader *r, hci_run_column first, double **out)
{
    const hci_status status = hci_run_phases_read(&r->columns, first);
    if (status) return status;
    *out = hci_memory_new(r->run->count, 3 * sizeof **out);
    if (*out == NULL) return memory_error(r);
    for (size_t k = 0; k < r->run->count; ++k)
        hci_run_phases_at(&r->columns, first, k, *out + 3 * k);
    for (unsigned s = 0; s < 3; ++s)
        hci_run_column_drop(&r->columns, first + s);
    return HCI_OK;
}

static hci_status turn_dq(const reader *r, const double *d, const double *q, double *phases)
{
    const hci_run *run = r->run;
    if (run->theta_m_rad == NULL && !run->only_mean)
        return missing(r, "iq_A without an angle",
                       "theta_e_rad or theta_m_rad to turn it into phase currents",
                       "add the angle or give phase currents");
    for (size_t k = 0; k < run->count; ++k) {
        const hci_dq x = {.d = d != NULL ? d[k] : 0.0, .q = q[k]};
        const double theta_m_rad = run->theta_m_rad != NULL ? run->theta_m_rad[k] : 0.0;
        hci_phases_of_dq(x, r->pole_pairs * theta_m_rad, phases + 3 * k);
    }
    return HCI_OK;
}

/* Phase quantities of those along d and q; d is 0 without its column. phases: [count][3], 0 without q. */
static hci_status read_dq(reader *r, hci_run_column d, hci_run_column q, double **phases)
{
    hci_status status = hci_run_column_read(&r->columns, q);
    if (!status) status = hci_run_column_read(&r->columns, d);
    if (status) return status;
    *phases = hci_memory_new(r->run->count, 3 * sizeof(double));
    if (*phases == NULL) return memory_error(r);
    if (d == HCI_RUN_ID) r->run->lacks_id = has(r, q) && !has(r, d);
    if (has(r, q)) status = turn_dq(r, r->columns.value[d], r->columns.value[q], *phases);
    hci_run_column_drop(&r->columns, d);
    hci_run_column_drop(&r->columns, q);
    return status;
}

/* i_q of a torque that the drive has computed, where it logs no current. */
static hci_status read_current_of_torque(reader *r)
{
    const double constant = r->options->torque_constant_Nm_per_A;
    hci_status status = hci_run_column_read(&r->columns, HCI_RUN_TORQUE_COMPUTED);
    if (status) return status;
    double *iq_A = r->columns.value[HCI_RUN_TORQUE_COMPUTED];
    for (size_t k = 0; k < r->run->count; ++k)
        iq_A[k] /= constant;
    hci_note_add(&r->run->remark, "no currents: i_q is that torque over %.4g N·m/A, as back_emf.csv has it",
                 constant);
    r->run->i_A = hci_memory_new(r->run->count, 3 * sizeof(double));
    if (r->run->i_A == NULL) return memory_error(r);
    status = turn_dq(r, NULL, iq_A, r->run->i_A);
    hci_run_column_drop(&r->columns, HCI_RUN_TORQUE_COMPUTED);
    return status;
}

/* 1, 2 or 3 of three columns, the one that is not there; 0: all are. */
static int phase_missing(const reader *r, hci_run_column first)
{
    for (int s = 0; s < 3; ++s)
        if (!has(r, (hci_run_column)((int)first + s))) return s + 1;
    return 0;
}

/* A name such as `Current` may be of a supply as well. */
static hci_status one_phase(reader *r)
{
    char quoted[HCI_QUOTE_SIZE];
    hci_note found = {{0}};
    size_t line = 0;
    const char *name = NULL;
    for (int s = 0; s < 3 && !name; ++s)
        name = hci_run_column_header(&r->columns, (hci_run_column)((int)HCI_RUN_IA + s), &line);
    hci_note_add(&found, "one phase current, %s", hci_quote(name ? name : "", quoted));
    return missing(r, found.text, "two or three of ia_A, ib_A, ic_A",
                   "add another column, or iq_A; the current of a supply or a battery is none of a phase");
}

static hci_status read_currents(reader *r)
{
    const int phases = hci_run_phase_count(&r->columns, HCI_RUN_IA);
    if (phases == 1 && !has(r, HCI_RUN_IQ)) return one_phase(r);
    if (phases >= 2) {
        hci_run_column_leave(&r->columns, HCI_RUN_ID);
        hci_run_column_leave(&r->columns, HCI_RUN_IQ);
        r->run->has_sum = phases == 3;
        r->run->computed_phase = phase_missing(r, HCI_RUN_IA);
        return read_phases(r, HCI_RUN_IA, &r->run->i_A);
    }
    if (has(r, HCI_RUN_ID) && !has(r, HCI_RUN_IQ))
        return missing(r, "id_A without iq_A", "both, or iq_A alone", "add the column iq_A");
    if (!has(r, HCI_RUN_IQ) && has(r, HCI_RUN_TORQUE_COMPUTED) && r->options->torque_constant_Nm_per_A > 0.0)
        return read_current_of_torque(r);
    r->no_currents = !has(r, HCI_RUN_IQ);
    keep_header(r, HCI_RUN_IQ, r->run->current_column);
    if (r->no_currents && r->run->theta_m_rad != NULL)
        hci_note_add(&r->run->remark, "no currents: taken as 0");
    if (r->no_currents) hci_run_columns_current_like(&r->columns, r->run->current_like);
    return read_dq(r, HCI_RUN_ID, HCI_RUN_IQ, &r->run->i_A);
}

/* v_d and v_q are what a drive makes of its command, and a current flows by them. Without that they are
 * nothing that a machine with open terminals induces. */
static hci_status leave_command(reader *r)
{
    char quoted[HCI_QUOTE_SIZE];
    keep_header(r, HCI_RUN_VQ, r->run->commanded_voltage);
    r->run->commanded_unit_V = hci_run_column_factor(&r->columns, HCI_RUN_VQ);
    hci_run_column_leave(&r->columns, HCI_RUN_VD);
    hci_run_column_leave(&r->columns, HCI_RUN_VQ);
    hci_note_add(
        &r->run->remark,
        "%s is a voltage that a drive commands, by which a current flows that is in no column: it is "
        "no back-EMF, and is not used",
        hci_quote(r->run->commanded_voltage, quoted));
    return HCI_OK;
}

static hci_status read_dq_voltages(reader *r)
{
    const bool given = hci_run_phase_count(&r->columns, HCI_RUN_VA) < 2 && has(r, HCI_RUN_VQ);
    if (given && r->no_currents) return leave_command(r);
    r->run->voltage_is_dq = given && r->run->theta_m_rad != NULL;
    return r->run->voltage_is_dq ? read_dq(r, HCI_RUN_VD, HCI_RUN_VQ, &r->run->v_V) : HCI_OK;
}

static hci_status read_voltages(reader *r)
{
    hci_run_column first;
    if (!hci_run_voltages(&r->columns, &first)) return read_dq_voltages(r);
    const hci_status status = read_phases(r, first, &r->run->v_V);
    if (first == HCI_RUN_VAB)
        hci_note_add(&r->run->remark,
                     "phase voltages from line voltages: orders divisible by three are not in them");
    else if (hci_run_phase_count(&r->columns, first) == 2)
        hci_note_add(&r->run->remark, "two phase voltages: the third makes the sum 0, as in a star without "
                                      "neutral; orders divisible by three are wrong in it");
    return status;
}

/* ---- torque ---- */

static bool read_raw(const reader *r, hci_run_column which, double *values)
{
    hci_csv_hole hole = {0};
    hci_note unused = {{0}};
    return hci_csv_numbers_or_nan(r->columns.csv, hci_run_column_name(which), values, &hole, &unused) ==
           HCI_OK;
}

/* What the drive counts on, of a torque under a name of its own, in the rows as they are in the file. */
static hci_status read_drive_constant(reader *r)
{
    const size_t rows = hci_csv_rows(r->columns.csv);
    size_t n = 0;
    double constant;
    if (!has(r, HCI_RUN_TORQUE_COMPUTED) || !has(r, HCI_RUN_IQ)) return HCI_OK;
    double *torque_Nm = hci_memory_new(2 * rows + 1, sizeof *torque_Nm), *iq_A = NULL;
    if (torque_Nm == NULL) return memory_error(r);
    iq_A = torque_Nm + rows;
    if (read_raw(r, HCI_RUN_TORQUE_COMPUTED, torque_Nm) && read_raw(r, HCI_RUN_IQ, iq_A))
        for (size_t k = 0; k < rows; ++k) {
            if (!isfinite(torque_Nm[k]) || !isfinite(iq_A[k])) continue;
            torque_Nm[n] = torque_Nm[k];
            iq_A[n++] = iq_A[k];
        }
    if (hci_torque_is_of_current(torque_Nm, iq_A, n, &constant)) r->run->drive_constant_Nm_per_A = constant;
    hci_memory_free(torque_Nm);
    return HCI_OK;
}

/* Frees a torque that is nothing but the current. */
static hci_status drop_computed(reader *r)
{
    hci_run *run = r->run;
    double constant, *iq_A;
    if (run->torque_Nm == NULL || run->theta_m_rad == NULL || !has(r, HCI_RUN_IQ)) return HCI_OK;
    iq_A = hci_memory_new(run->count, sizeof *iq_A);
    if (iq_A == NULL) return memory_error(r);
    for (size_t k = 0; k < run->count; ++k)
        iq_A[k] = hci_run_dq(run, r->pole_pairs, k).q;
    const bool computed = hci_torque_is_of_current(run->torque_Nm, iq_A, run->count, &constant);
    hci_memory_free(iq_A);
    if (!computed) return HCI_OK;
    run->drive_constant_Nm_per_A = constant;
    hci_note_add(&run->remark,
                 "the torque is %.4g N·m/A times i_q in every row: computed from the current and not "
                 "measured, it is not used",
                 constant);
    hci_memory_free(run->torque_Nm);
    run->torque_Nm = NULL;
    return HCI_OK;
}

/* Frees a torque that is one number while the current varies. */
static void drop_typed(reader *r)
{
    hci_run *run = r->run;
    if (run->torque_Nm == NULL || !hci_torque_is_typed(run)) return;
    hci_note_add(&run->remark,
                 "the torque is %.6g N·m in every row while the current varies: typed, or of a sensor that "
                 "stands still, and not measured. It tells the mean alone and is not used",
                 run->torque_Nm[0]);
    run->torque_is_typed = true;
    run->torque_typed_Nm = run->torque_Nm[0];
    hci_memory_free(run->torque_Nm);
    run->torque_Nm = NULL;
}

/* Times what noise alone makes of a mean. */
#define NOISE_OF_MEAN 5.0

/* Whether the currents have nothing that turns with the rotor: offsets and noise of their sensors. */
static bool nothing_turns(const hci_run *run)
{
    double d = 0.0, q = 0.0, square = 0.0;
    for (size_t k = 0; k < run->count; ++k) {
        const hci_dq i = hci_run_dq(run, run->pole_pairs, k);
        d += i.d, q += i.q, square += i.d * i.d + i.q * i.q;
    }
    return hypot(d, q) <= NOISE_OF_MEAN * sqrt(square);
}

static void say_clipped(reader *r)
{
    hci_run *run = r->run;
    hci_run_crests crests = {0};
    run->is_clipped = hci_run_is_clipped(run, &crests);
    if (run->is_clipped)
        hci_note_add(&run->remark,
                     "the crests of the current are all of one value, %.4g A of %s in %zu of %zu rows, as of "
                     "a limit or of a sensor at its end: what is above is missing in all that the current "
                     "tells; a sensor of a wider range or a smaller load shows it",
                     crests.at_A, crests.of_iq ? "i_q" : "a phase", crests.rows, run->count);
}

/* Frees a torque of 0 of a machine whose terminals are open: what turns it is not its current, so that it is
 * no holding test, and its torque is not 0 but was not measured. */
static void drop_zero_of_open(reader *r)
{
    hci_run *run = r->run;
    if (run->torque_Nm == NULL || !is_zero(run->torque_Nm, run->count) || r->options->holding) return;
    if (!run->v_V || run->voltage_is_dq || !run->theta_m_rad || r->no_currents || !nothing_turns(run)) return;
    hci_note_add(&run->remark,
                 "the torque is 0 in every row beside voltages and currents that do not turn with the rotor: "
                 "another machine turns the shaft, and the torque is typed and not measured. It is not used");
    run->torque_is_typed = true;
    hci_memory_free(run->torque_Nm);
    run->torque_Nm = NULL;
}

static void say_pole_pairs(reader *r)
{
    double turns;
    if (!hci_run_currents_go_otherwise(r->run, &turns)) return;
    r->run->other_pole_pairs = (int)round(fabs(turns));
    hci_note_add(&r->run->remark,
                 "the phase currents go round %d times in a turn of the shaft, and the machine has %d pole "
                 "pairs: it is of another machine, or the angle is none of the shaft",
                 r->run->other_pole_pairs, r->pole_pairs);
}

static hci_status no_holding_current(const reader *r)
{
    char remedy[2 * HCI_RUN_NAME + 160] =
        "name its column by --column iq_A=COLUMN, or its torque by --column torque_Nm=COLUMN";
    if (r->run->commanded_voltage[0])
        snprintf(remedy, sizeof remedy,
                 "of a shaft that turns slowly it is the voltage that the drive commands over the resistance "
                 "of a phase: --column 'iq_A=%s/OHM'",
                 r->run->commanded_voltage);
    return missing(r, "a holding test without a current that is read", "the current that holds the shaft",
                   remedy);
}

static hci_status read_torque(reader *r)
{
    hci_run *run = r->run;
    hci_status status = read_column(r, HCI_RUN_TORQUE, &run->torque_Nm);
    if (!status) status = read_drive_constant(r);
    if (!status) status = drop_computed(r);
    if (status) return status;
    say_clipped(r);
    say_pole_pairs(r);
    drop_typed(r);
    drop_zero_of_open(r);
    hci_run_computed_torque_leave(&r->columns);
    if (run->torque_is_typed) return HCI_OK; /* a load: neither a free shaft nor a holding test */
    if (run->torque_Nm == NULL && r->options->holding && r->no_currents) return no_holding_current(r);
    if (run->torque_Nm == NULL) return hci_untold_torque_set(run, r->options, r->no_currents, r->note);
    run->torque_source = is_zero(run->torque_Nm, run->count) ? HCI_TORQUE_HOLDING : HCI_TORQUE_MEASURED;
    if (run->torque_source != HCI_TORQUE_HOLDING)
        return hci_row_direction_of_both_set(run) ? HCI_OK : memory_error(r);
    return hci_row_direction_set(run) ? hci_run_effort_set(run, r->note) : memory_error(r);
}

/* ---- the run ---- */

/* Numbers that are too large for what is made of them, as an angle of 1e308 times the pole pairs. */
static hci_status check_finite(const reader *r)
{
    const hci_run *run = r->run;
    char shown[HCI_QUOTE_PATH_SIZE];
    const struct {
        const double *value;
        size_t count;
        const char *what;
    } list[] = {{run->theta_m_rad, run->count, "angles"},
                {run->speed_rad_per_s, run->count, "speeds"},
                {run->i_A, 3 * run->count, "currents"},
                {run->v_V, 3 * run->count, "voltages"},
                {run->torque_Nm, run->count, "torques"}};
    for (size_t k = 0; k < sizeof list / sizeof *list; ++k)
        if (list[k].value != NULL && !hci_vector_finite(list[k].count, list[k].value))
            return hci_note_set(r->note, HCI_ERROR_INPUT,
                                "%s: found numbers of which no finite %s come, expected angles, currents and "
                                "torques as they are measured; remove the rows with numbers such as 1e308",
                                hci_quote_path(run->name, shown), list[k].what);
    return HCI_OK;
}

/* A sensor that reads shows noise, or the steps of its converter. */
static void find_whether_off(hci_run *run)
{
    run->switched_off = true;
    for (size_t k = 0; k < 3 * run->count && run->switched_off; ++k)
        run->switched_off = run->i_A[k] == 0.0;
}

static hci_status read_all(reader *r)
{
    hci_run *run = r->run;
    hci_angle_path path = HCI_ANGLE_WITHIN;
    hci_status status = read_time(r);
    if (!status) status = read_speed(r);
    if (!status) status = read_angles(r, &path);
    if (!status) turn_angle(r);
    if (!status) status = replace_angle(r);
    if (!status) status = mend_clock(r, path);
    if (!status) status = follow_angle(r, path);
    if (!status) status = complete_speed(r, path);
    if (!status) status = read_currents(r);
    if (!status && run->i_A) find_whether_off(run);
    if (!status) status = read_voltages(r);
    if (!status) status = read_column(r, HCI_RUN_TEMPERATURE, &run->temperature_C);
    if (!status) status = read_torque(r);
    if (!status) status = check_finite(r);
    if (!status && run->torque_source != HCI_TORQUE_MEASURED && !has(r, HCI_RUN_TORQUE))
        hci_run_columns_torque_like(&r->columns, run->torque_like, run->force_like);
    if (!status && (run->speed_rad_per_s == NULL || run->speed_window > 0) && !has(r, HCI_RUN_SPEED))
        hci_run_columns_speed_like(&r->columns);
    if (!status) hci_run_columns_tell_unused(&r->columns);
    return status;
}

static hci_status take(reader *r, const hci_csv *csv)
{
    const char *path = hci_csv_path(csv);
    hci_run *run = r->run;
    hci_status status = hci_run_columns_open(csv, &r->columns, &run->remark, r->note);
    if (status) return status;
    if (hci_csv_map_of(csv) != NULL)
        hci_note_add(&run->remark, "a map of %s, read as the recording of a shaft that its currents hold",
                     hci_csv_map_of(csv));
    run->count = r->columns.count;
    run->torque_is_clipped = r->columns.torque_is_clipped;
    memcpy(run->time_like, r->columns.time_like, sizeof run->time_like);
    run->row = r->columns.row;
    r->columns.row = NULL;
    run->name = hci_memory_text(path);
    return run->name == NULL ? memory_error(r) : read_all(r);
}

/* Those asked for, or those in the file, which must not contradict each other. */
static hci_status choose_pole_pairs(reader *r, const hci_csv *csv)
{
    const int asked = r->options->pole_pairs, there = hci_csv_learned_pole_pairs(csv);
    char shown[HCI_QUOTE_PATH_SIZE];
    r->run->pole_pairs = r->pole_pairs = asked > 0 ? asked : there;
    if (asked > 0 && there > 0 && asked != there)
        return hci_note_set(
            r->note, HCI_ERROR_INPUT,
            "%s: found what a device has learnt of a machine with %d pole pairs, expected %d; "
            "take the machine that it was learnt on",
            hci_quote_path(hci_csv_path(csv), shown), there, asked);
    if (r->pole_pairs > 0) return HCI_OK;
    return hci_note_set(r->note, HCI_ERROR_ARGUMENT,
                        "%s: found %d pole pairs, expected 1 or more; add --pole-pairs P",
                        hci_quote_path(hci_csv_path(csv), shown), asked);
}

hci_status hci_run_of_csv(const hci_csv *csv, const hci_run_options *options, hci_run *run, hci_note *note)
{
    reader r = {.run = run, .note = note, .options = options};
    memset(run, 0, sizeof *run);
    hci_status status = choose_pole_pairs(&r, csv);
    if (!status) status = take(&r, csv);
    hci_run_columns_release(&r.columns);
    if (status) hci_run_release(run);
    return status;
}

/* The names that stand beside the file, if it is one, and then those of the options. */
static hci_status name_columns(const char *path, const hci_run_options *options, hci_csv *csv, hci_note *note)
{
    hci_column_names beside = {0};
    hci_status status = path ? hci_column_names_beside(&beside, path, note) : HCI_OK;
    if (!status) status = hci_column_names_apply(options->list_columns, true, csv, note);
    if (!status) status = hci_column_names_apply(&beside, true, csv, note);
    if (!status)
        status = options->columns_found
                     ? hci_column_names_apply_found(options->columns, options->columns_found, csv, note)
                     : hci_column_names_apply(options->columns, false, csv, note);
    hci_column_names_release(&beside);
    return status;
}

/* The recording in memory of this name; NULL: it is a file. */
static const hci_csv_memory *in_memory(const char *path, const hci_run_options *options)
{
    for (size_t k = 0; k < options->memory_count; ++k)
        if (strcmp(options->memory[k].name, path) == 0) return &options->memory[k];
    return NULL;
}

static hci_status read_memory(const hci_csv_memory *from, bool strict, hci_csv **csv, hci_note *note)
{
    const hci_status status = hci_csv_of_memory(from, csv, note);
    if (!status) (*csv)->leaves_holes = !strict;
    return status;
}

hci_status hci_run_csv(const char *path, const hci_run_options *options, hci_csv **csv, hci_note *note)
{
    const hci_csv_memory *from = in_memory(path, options);
    hci_status status = from              ? read_memory(from, options->strict, csv, note)
                        : options->strict ? hci_csv_read(path, csv, note)
                                          : hci_csv_read_recording(path, csv, note);
    if (status) return status;
    status = name_columns(from ? NULL : path, options, *csv, note);
    if (!status) status = hci_csv_refuse_messages(*csv, note);
    if (!status) status = hci_clocks_agree(*csv, note);
    if (!status) status = hci_rows_by_time(*csv, note);
    if (!status) status = hci_bare_angle_decide(*csv, options->pole_pairs, note);
    if (!status) status = hci_bare_angle_explain(*csv, options->pole_pairs, note);
    if (!status) return status;
    hci_csv_free(*csv);
    *csv = NULL;
    return status;
}

hci_status hci_run_read(const char *path, const hci_run_options *options, hci_run *run, hci_note *note)
{
    hci_csv *csv;
    memset(run, 0, sizeof *run);
    hci_status status = hci_run_csv(path, options, &csv, note);
    if (status) return status;
    status = hci_run_of_csv(csv, options, run, note);
    hci_csv_free(csv);
    return status;
}

void hci_run_release(hci_run *run)
{
    hci_memory_free(run->name);
    hci_memory_free(run->time_s);
    hci_memory_free(run->theta_m_rad);
    hci_memory_free(run->speed_rad_per_s);
    hci_memory_free(run->i_A);
    hci_memory_free(run->torque_Nm);
    hci_memory_free(run->temperature_C);
    hci_memory_free(run->v_V);
    hci_memory_free(run->row);
    memset(run, 0, sizeof *run);
}
