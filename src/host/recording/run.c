#include "hci/host/recording/run.h"

#include <assert.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "hci/host/csv/csv.h"
#include "hci/machine/frames.h"
#include "hci/math/harmonic.h"
#include "host/base/memory.h"
#include "host/base/quote.h"
#include "host/csv/table.h"
#include "host/numeric/derivative.h"
#include "host/numeric/unwrap.h"

/* Less movement than this is a shaft at rest, whose angle only flickers. */
#define MOVED_RAD (2.0 * HCI_PI / 100.0)

/* theta_e and p·theta_m follow each other when their difference is as steady as this (1: constant). */
#define STEADY 0.9

typedef struct {
    const hci_csv *csv;
    hci_run *run;
    hci_note *note;
    bool *used; /* of each column of the file */
    int pole_pairs;
} reader;

/* ---- columns ---- */

static hci_status memory_error(const reader *r)
{
    char path[HCI_QUOTE_PATH_SIZE];
    return hci_note_set(r->note, HCI_ERROR_MEMORY, "%s: not enough memory for %zu samples",
                        hci_quote_path(hci_csv_path(r->csv), path), r->run->count);
}

static bool has(const reader *r, const char *name)
{
    size_t column;
    return hci_csv_find(r->csv, name, &column);
}

/* A column that says again what others say. */
static void leave(reader *r, const char *name)
{
    size_t column;
    if (hci_csv_find(r->csv, name, &column)) r->used[column] = true;
}

/* The column if the file has it; *values stays NULL where not. */
static hci_status read_column(reader *r, const char *name, double **values)
{
    size_t column;
    hci_note told = {{0}};
    if (!hci_csv_find(r->csv, name, &column)) return HCI_OK;
    if (hci_csv_told(r->csv, name, &told)) hci_note_add(&r->run->remark, "%s", told.text);
    r->used[column] = true;
    *values = hci_memory_new(r->run->count, sizeof **values);
    if (*values == NULL) return memory_error(r);
    return hci_csv_numbers(r->csv, name, *values, r->note);
}

static hci_status missing(const reader *r, const char *found, const char *expected, const char *remedy)
{
    char path[HCI_QUOTE_PATH_SIZE];
    return hci_note_set(r->note, HCI_ERROR_INPUT, "%s: found %s, expected %s; %s",
                        hci_quote_path(hci_csv_path(r->csv), path), found, expected, remedy);
}

/* ---- time and speed ---- */

static hci_status read_time(reader *r)
{
    const hci_status status = read_column(r, "time_s", &r->run->time_s);
    const double *time_s = r->run->time_s;
    for (size_t k = 1; status == HCI_OK && time_s != NULL && k < r->run->count; ++k) {
        if (time_s[k] > time_s[k - 1]) continue;
        const bool equal = !(time_s[k] < time_s[k - 1]);
        return hci_csv_error(r->csv, "time_s", k, r->note,
                             equal ? "a later time than on the line before (they are equal)"
                                   : "a later time than on the line before",
                             equal ? "write the time with more digits, or remove one of the two samples"
                                   : "sort the samples by time, or remove the column if they have no order");
    }
    return status;
}

/* The mechanical speed, or the electrical one by the pole pairs. */
static hci_status read_speed(reader *r)
{
    double **speed = &r->run->speed_rad_per_s;
    hci_status status = read_column(r, "speed_rad_per_s", speed);
    if (status != HCI_OK || *speed != NULL) return status;
    status = read_column(r, "speed_e_rad_per_s", speed);
    for (size_t k = 0; status == HCI_OK && *speed != NULL && k < r->run->count; ++k)
        (*speed)[k] /= r->pole_pairs;
    return status;
}

static bool is_zero(const double *values, size_t count)
{
    for (size_t k = 0; k < count; ++k)
        if (fabs(values[k]) > 0.0) return false;
    return true;
}

static bool has_moved(const double *angle_rad, size_t count)
{
    double low = angle_rad[0], high = angle_rad[0];
    for (size_t k = 1; k < count; ++k) {
        low = fmin(low, angle_rad[k]);
        high = fmax(high, angle_rad[k]);
    }
    return high - low > MOVED_RAD;
}

/* The slope of the angle where no speed was recorded, or one of 0 while the shaft moved. */
static hci_status complete_speed(reader *r, hci_angle_path path)
{
    hci_run *run = r->run;
    const bool recorded = run->speed_rad_per_s != NULL;
    if (run->theta_m_rad == NULL || run->time_s == NULL || run->count < 2) return HCI_OK;
    if (path == HCI_ANGLE_SCATTERED || path == HCI_ANGLE_UNCLEAR) return HCI_OK;
    if (recorded && (!is_zero(run->speed_rad_per_s, run->count) || !has_moved(run->theta_m_rad, run->count)))
        return HCI_OK;
    if (!recorded) run->speed_rad_per_s = hci_memory_new(run->count, sizeof(double));
    if (run->speed_rad_per_s == NULL) return memory_error(r);
    hci_derivative(run->time_s, run->theta_m_rad, run->count, run->speed_rad_per_s);
    hci_note_add(&r->run->remark, recorded
                                      ? "the speed is 0 but the angle moves: the slope of the angle is taken"
                                      : "the speed is the slope of the angle");
    return HCI_OK;
}

/* ---- angle ---- */

static hci_status unclear_error(const reader *r, bool has_speed)
{
    return missing(r,
                   has_speed ? "an angle and a speed that do not belong together"
                             : "an angle that moves a third of a turn or more from sample to sample",
                   has_speed ? "the slope of the angle to be the speed, from sample to sample"
                             : "at least four samples a turn of a wrapped angle",
                   has_speed
                       ? "check pole pairs, units and time; or give the angle unwrapped"
                       : "sample faster, add a speed column or give the angle unwrapped; if each sample "
                         "is a measurement of its own, remove the time column");
}

/* Reads and unwraps one angle, whose speed is `factor` times the mechanical one. */
static hci_status read_angle(reader *r, const char *name, double factor, double **angle, hci_unwrapping *how)
{
    const size_t n = r->run->count;
    hci_status status = read_column(r, name, angle);
    if (status != HCI_OK || *angle == NULL) return status;
    double *rate = NULL;
    if (r->run->speed_rad_per_s != NULL) {
        rate = hci_memory_new(n, sizeof *rate);
        if (rate == NULL) return memory_error(r);
        for (size_t k = 0; k < n; ++k)
            rate[k] = factor * r->run->speed_rad_per_s[k];
    }
    *how = hci_unwrap(*angle, n, r->run->time_s, rate);
    hci_memory_free(rate);
    if (how->path == HCI_ANGLE_UNCLEAR) return unclear_error(r, r->run->speed_rad_per_s != NULL);
    if (how->path == HCI_ANGLE_SCATTERED)
        hci_note_add(&r->run->remark, "%s: samples without order in the angle, taken as they stand", name);
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

static hci_status read_angles(reader *r, hci_angle_path *path)
{
    hci_run *run = r->run;
    hci_unwrapping mechanical = {.path = HCI_ANGLE_WITHIN}, electrical = mechanical;
    double *theta_e = NULL;
    hci_status status = read_angle(r, "theta_m_rad", 1.0, &run->theta_m_rad, &mechanical);
    if (status == HCI_OK) status = read_angle(r, "theta_e_rad", r->pole_pairs, &theta_e, &electrical);
    run->turn_known = run->theta_m_rad != NULL;
    *path = mechanical.path;
    if (status == HCI_OK && theta_e != NULL) {
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

/* ---- three phases ---- */

/* Puts columns of three phases side by side; of two, the third makes the sum 0. */
static hci_status read_phases(reader *r, const char *const name[3], double **out)
{
    double *column[3] = {0};
    const size_t n = r->run->count;
    hci_status status = HCI_OK;
    int absent = -1;
    for (int s = 0; s < 3 && status == HCI_OK; ++s) {
        status = read_column(r, name[s], &column[s]);
        if (column[s] == NULL) absent = s;
    }
    if (status == HCI_OK) *out = hci_memory_new(n, 3 * sizeof **out);
    if (status == HCI_OK && *out == NULL) status = memory_error(r);
    for (size_t k = 0; k < n && status == HCI_OK; ++k) {
        double *x = *out + 3 * k;
        for (int s = 0; s < 3; ++s)
            x[s] = column[s] != NULL ? column[s][k] : 0.0;
        if (absent >= 0) x[absent] = -(x[0] + x[1] + x[2]);
    }
    for (int s = 0; s < 3; ++s)
        hci_memory_free(column[s]);
    return status;
}

static int count_of(const reader *r, const char *const name[3])
{
    return has(r, name[0]) + has(r, name[1]) + has(r, name[2]);
}

static hci_status turn_dq(const reader *r, const double *d, const double *q, double *phases)
{
    const hci_run *run = r->run;
    if (run->theta_m_rad == NULL)
        return missing(r, "iq_A without an angle",
                       "theta_e_rad or theta_m_rad to turn it into phase currents",
                       "add the angle or give phase currents");
    for (size_t k = 0; k < run->count; ++k) {
        const hci_dq x = {.d = d != NULL ? d[k] : 0.0, .q = q[k]};
        hci_clarke_inverse(hci_park_inverse(x, r->pole_pairs * run->theta_m_rad[k]), phases + 3 * k);
    }
    return HCI_OK;
}

/* Phase quantities of those along d and q; d is 0 without its column. phases: [count][3], 0 without q. */
static hci_status read_dq(reader *r, const char *d_name, const char *q_name, double **phases)
{
    double *d = NULL, *q = NULL;
    hci_status status = read_column(r, q_name, &q);
    if (status == HCI_OK) status = read_column(r, d_name, &d);
    if (status == HCI_OK) *phases = hci_memory_new(r->run->count, 3 * sizeof(double));
    if (status == HCI_OK && *phases == NULL) status = memory_error(r);
    if (status == HCI_OK && q != NULL) status = turn_dq(r, d, q, *phases);
    hci_memory_free(d);
    hci_memory_free(q);
    return status;
}

static hci_status read_currents(reader *r)
{
    static const char *const PHASE[3] = {"ia_A", "ib_A", "ic_A"};
    const int phases = count_of(r, PHASE);
    if (phases == 1 && !has(r, "iq_A"))
        return missing(r, "one phase current", "two or three of ia_A, ib_A, ic_A", "add another column");
    if (phases >= 2) {
        leave(r, "id_A");
        leave(r, "iq_A");
        r->run->has_sum = phases == 3;
        return read_phases(r, PHASE, &r->run->i_A);
    }
    if (has(r, "id_A") && !has(r, "iq_A"))
        return missing(r, "id_A without iq_A", "both, or iq_A alone", "add the column iq_A");
    if (!has(r, "iq_A") && r->run->theta_m_rad != NULL)
        hci_note_add(&r->run->remark, "no currents: taken as 0");
    return read_dq(r, "id_A", "iq_A", &r->run->i_A);
}

static hci_status read_voltages(reader *r)
{
    static const char *const PHASE[3] = {"va_V", "vb_V", "vc_V"}, *const LINE[3] = {"vab_V", "vbc_V",
                                                                                    "vca_V"};
    if (count_of(r, PHASE) == 3) return read_phases(r, PHASE, &r->run->v_V);
    if (count_of(r, PHASE) == 0 && count_of(r, LINE) < 2 && has(r, "vq_V") && r->run->theta_m_rad != NULL)
        return read_dq(r, "vd_V", "vq_V", &r->run->v_V);
    if (count_of(r, PHASE) > 0 || count_of(r, LINE) < 2) return HCI_OK;
    const hci_status status = read_phases(r, LINE, &r->run->v_V);
    for (size_t k = 0; status == HCI_OK && k < r->run->count; ++k) {
        double *v = r->run->v_V + 3 * k;
        const double ab = v[0], bc = v[1], ca = v[2];
        v[0] = (ab - ca) / 3.0;
        v[1] = (bc - ab) / 3.0;
        v[2] = (ca - bc) / 3.0;
    }
    hci_note_add(&r->run->remark,
                 "phase voltages from line voltages: orders divisible by three are not in them");
    return status;
}

/* ---- torque ---- */

static hci_status torque_of_inertia(reader *r, double inertia_kgm2)
{
    hci_run *run = r->run;
    if (!(inertia_kgm2 > 0.0) || run->time_s == NULL || run->speed_rad_per_s == NULL || run->count < 3)
        return HCI_OK;
    run->torque_Nm = hci_memory_new(run->count, sizeof(double));
    if (run->torque_Nm == NULL) return memory_error(r);
    hci_derivative(run->time_s, run->speed_rad_per_s, run->count, run->torque_Nm);
    for (size_t k = 0; k < run->count; ++k)
        run->torque_Nm[k] *= inertia_kgm2;
    run->torque_source = HCI_TORQUE_INERTIA;
    hci_note_add(&r->run->remark, "no torque_Nm: as of a free shaft it is inertia x acceleration");
    return HCI_OK;
}

static hci_status read_torque(reader *r, double inertia_kgm2)
{
    hci_run *run = r->run;
    const hci_status status = read_column(r, "torque_Nm", &run->torque_Nm);
    if (status != HCI_OK) return status;
    if (run->torque_Nm == NULL) return torque_of_inertia(r, inertia_kgm2);
    run->torque_source = is_zero(run->torque_Nm, run->count) ? HCI_TORQUE_HOLDING : HCI_TORQUE_MEASURED;
    return HCI_OK;
}

/* ---- the run ---- */

/* Neither angle nor voltages: most likely a column under another name. Where voltages would do without an
 * angle, one that may be either is refused all the same, and not passed over. */
static hci_status check_columns(const reader *r)
{
    hci_note told = {{0}};
    double unused;
    if (has(r, "theta_m_rad") || has(r, "theta_e_rad")) return HCI_OK;
    hci_status status = hci_csv_check_clear(r->csv, r->note);
    if (status != HCI_OK || has(r, "va_V") || has(r, "vab_V")) return status;
    status = hci_csv_number(r->csv, "theta_m_rad", 0, &unused, &told);
    return status == HCI_OK ? status
                            : hci_note_set(r->note, status, "%s; theta_e_rad will do as well", told.text);
}

static hci_status read_all(reader *r, double inertia_kgm2)
{
    hci_run *run = r->run;
    hci_angle_path path = HCI_ANGLE_WITHIN;
    hci_status status = check_columns(r);
    if (status == HCI_OK && hci_csv_header_line(r->csv) > 0)
        hci_note_add(&r->run->remark, "line %zu is the header, what stands before it is not read",
                     hci_csv_header_line(r->csv));
    if (status == HCI_OK) status = read_time(r);
    if (status == HCI_OK) status = read_speed(r);
    if (status == HCI_OK) status = read_angles(r, &path);
    if (status == HCI_OK) status = complete_speed(r, path);
    if (status == HCI_OK) status = read_currents(r);
    if (status == HCI_OK) status = read_voltages(r);
    if (status == HCI_OK) status = read_column(r, "temperature_C", &run->temperature_C);
    if (status == HCI_OK) status = read_torque(r, inertia_kgm2);
    if (status == HCI_OK) hci_csv_unused(r->csv, r->used, &r->run->remark);
    return status;
}

static hci_status take(reader *r, double inertia_kgm2)
{
    const char *path = hci_csv_path(r->csv);
    r->run->count = hci_csv_rows(r->csv);
    if (r->run->count == 0)
        return missing(r, "a header and no samples", "a row for each sample", "record the run again");
    r->run->name = hci_memory_malloc(strlen(path) + 1);
    r->used = hci_memory_new(hci_csv_columns(r->csv), sizeof *r->used);
    if (r->run->name == NULL || r->used == NULL) return memory_error(r);
    memcpy(r->run->name, path, strlen(path) + 1);
    return read_all(r, inertia_kgm2);
}

hci_status hci_run_of_csv(const hci_csv *csv, int pole_pairs, double inertia_kgm2, hci_run *run,
                          hci_note *note)
{
    reader r = {.csv = csv, .run = run, .note = note, .pole_pairs = pole_pairs};
    memset(run, 0, sizeof *run);
    if (pole_pairs < 1)
        return hci_note_set(note, HCI_ERROR_ARGUMENT, "found %d pole pairs, expected 1 or more", pole_pairs);
    const hci_status status = take(&r, inertia_kgm2);
    hci_memory_free(r.used);
    if (status != HCI_OK) hci_run_release(run);
    return status;
}

hci_status hci_run_read(const char *path, int pole_pairs, double inertia_kgm2, hci_run *run, hci_note *note)
{
    hci_csv *csv;
    memset(run, 0, sizeof *run);
    hci_status status = hci_csv_read(path, &csv, note);
    if (status != HCI_OK) return status;
    status = hci_run_of_csv(csv, pole_pairs, inertia_kgm2, run, note);
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
    memset(run, 0, sizeof *run);
}
