/* Figures of recordings: the angle as it stands, and means of what turns with it. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "hci/machine/frames.h"
#include "host/base/memory.h"
#include "host/base/quote.h"
#include "host/check/figures.h"
#include "host/csv/table.h"

/* A wave is said to turn with the rotor when it has this share of the mean square. */
#define COHERENT 0.6

/* Less than this share of the rated or of the largest current is no current. */
#define NO_CURRENT 0.03

/* What does not turn so far cannot be told from what stands still. The range of the recorded angle counts:
 * where it was wrapped, other scales than those with a whole number of turns in it are torn. */
#define LEAST_TURN (1.5 * HCI_PI)

#define DEGREE (HCI_PI / 180.0)

/* ---- vectors */

check_vector hci_check_product(check_vector a, check_vector b)
{
    return (check_vector){a.re * b.re - a.im * b.im, a.re * b.im + a.im * b.re};
}

check_vector hci_check_conjugate(check_vector a)
{
    return (check_vector){a.re, -a.im};
}

check_vector hci_check_scaled(check_vector a, double factor)
{
    return (check_vector){factor * a.re, factor * a.im};
}

check_vector hci_check_turned(check_vector a, double angle_rad)
{
    return hci_check_product(a, (check_vector){cos(angle_rad), sin(angle_rad)});
}

check_vector hci_check_sum(check_vector a, check_vector b)
{
    return (check_vector){a.re + b.re, a.im + b.im};
}

double hci_check_length(check_vector a)
{
    return hypot(a.re, a.im);
}

/* ---- columns */

/* Samples of one file while its figures are taken; what it does not have is NULL. */
typedef struct {
    size_t count;
    double *time, *theta, *other, *speed, *torque, *d, *q, *vd, *vq;
    double *phase[3], *volt[3];
    check_vector *current, *voltage;
    bool *used;       /* of each column of the file */
    hci_note *remark; /* how they were read */
} samples;

static const char *const CURRENT[3] = {"ia_A", "ib_A", "ic_A"};
static const char *const VOLTAGE[3] = {"va_V", "vb_V", "vc_V"}, *const LINE[3] = {"vab_V", "vbc_V", "vca_V"};

static bool has(const hci_csv *csv, const char *name)
{
    size_t column;
    return hci_csv_find(csv, name, &column);
}

static bool has_three(const hci_csv *csv, const char *const name[3])
{
    return has(csv, name[0]) && has(csv, name[1]) && has(csv, name[2]);
}

/* A column that says again what others say, or nothing to a check. */
static void leave(const hci_csv *csv, const char *name, samples *s)
{
    size_t column;
    if (hci_csv_find(csv, name, &column)) s->used[column] = true;
}

static hci_status column_read(const hci_csv *csv, const char *name, samples *s, double **values,
                              hci_note *note)
{
    hci_note told = {{0}};
    if (!has(csv, name)) return HCI_OK;
    if (hci_csv_told(csv, name, &told)) hci_note_add(s->remark, "%s", told.text);
    leave(csv, name, s);
    *values = hci_memory_new(hci_csv_rows(csv), sizeof **values);
    if (!*values) return hci_note_set(note, HCI_ERROR_MEMORY, "%s: out of memory", hci_csv_path(csv));
    return hci_csv_numbers(csv, name, *values, note);
}

static void place(const hci_csv *csv, const char *name, check_run *run, check_place *out)
{
    size_t column;
    if (out->path || !hci_csv_find(csv, name, &column)) return;
    out->path = run->path;
    out->line = hci_csv_record_line(csv, 0);
    snprintf(out->column, sizeof out->column, "%s", hci_csv_name(csv, column));
    snprintf(out->text, sizeof out->text, "%s", out->column);
}

static void places(const hci_csv *csv, check_run *run)
{
    place(csv, run->is_electrical ? "theta_e_rad" : "theta_m_rad", run, &run->theta_cell);
    place(csv, "time_s", run, &run->time_cell);
    place(csv, run->speed_is_electrical ? "speed_e_rad_per_s" : "speed_rad_per_s", run, &run->speed_cell);
    place(csv, run->has_abc ? "ia_A" : "iq_A", run, &run->current_cell);
    place(csv, run->has_dq_voltage ? "vq_V" : "va_V", run, &run->voltage_cell);
    place(csv, "torque_Nm", run, &run->torque_cell);
}

/* Three columns; of two, the third makes the sum 0. */
static hci_status phases_read(const hci_csv *csv, const char *const name[3], samples *s, double *column[3],
                              hci_note *note)
{
    hci_status status = HCI_OK;
    for (int k = 0; k < 3 && !status; ++k)
        status = column_read(csv, name[k], s, &column[k], note);
    return status;
}

static void vector_of(const double *const column[3], size_t k, bool are_lines, check_vector *out)
{
    double x[3];
    int absent = -1;
    for (int s = 0; s < 3; ++s) {
        if (!column[s]) absent = s;
        x[s] = column[s] ? column[s][k] : 0.0;
    }
    if (absent >= 0) x[absent] = -(x[0] + x[1] + x[2]);
    if (are_lines) {
        const double ab = x[0], bc = x[1], ca = x[2];
        x[0] = (ab - ca) / 3.0;
        x[1] = (bc - ab) / 3.0;
        x[2] = (ca - bc) / 3.0;
    }
    const hci_alpha_beta y = hci_clarke(x);
    *out = (check_vector){y.alpha, y.beta};
}

static hci_status vectors_make(double *const column[3], bool are_lines, size_t count, check_vector **out,
                               const char *path, hci_note *note)
{
    const double *const constant[3] = {column[0], column[1], column[2]};
    *out = hci_memory_new(count, sizeof **out);
    if (!*out) return hci_note_set(note, HCI_ERROR_MEMORY, "%s: out of memory", path);
    for (size_t k = 0; k < count; ++k)
        vector_of(constant, k, are_lines, &(*out)[k]);
    return HCI_OK;
}

static hci_status currents_read(const hci_csv *csv, check_run *run, samples *s, hci_note *note)
{
    const int phases = has(csv, CURRENT[0]) + has(csv, CURRENT[1]) + has(csv, CURRENT[2]);
    hci_status status = HCI_OK;
    run->has_dq = has(csv, "iq_A") && (phases < 2 || run->has_dq_voltage);
    run->has_abc = phases >= 2 && !run->has_dq;
    for (int k = 0; k < 3; ++k)
        leave(csv, CURRENT[k], s);
    leave(csv, "id_A", s);
    leave(csv, "iq_A", s);
    if (run->has_abc) status = phases_read(csv, CURRENT, s, s->phase, note);
    if (!status && run->has_abc)
        status = vectors_make(s->phase, false, s->count, &s->current, run->path, note);
    if (!status && run->has_dq) status = column_read(csv, "iq_A", s, &s->q, note);
    if (!status && run->has_dq) status = column_read(csv, "id_A", s, &s->d, note);
    return status;
}

static bool has_lines(const hci_csv *csv)
{
    return !has(csv, VOLTAGE[0]) && has(csv, LINE[0]) + has(csv, LINE[1]) + has(csv, LINE[2]) >= 2;
}

/* Beside phase currents alone they would need the drive's angle. */
static void find_voltages(const hci_csv *csv, check_run *run)
{
    const int phases = has(csv, CURRENT[0]) + has(csv, CURRENT[1]) + has(csv, CURRENT[2]);
    run->has_phase_voltage = has_lines(csv) || has_three(csv, VOLTAGE);
    run->has_dq_voltage = !run->has_phase_voltage && has(csv, "vq_V") && (phases < 2 || has(csv, "iq_A"));
    run->has_voltage = run->has_phase_voltage || run->has_dq_voltage;
}

static hci_status voltages_read(const hci_csv *csv, check_run *run, samples *s, hci_note *note)
{
    const bool lines = has_lines(csv);
    hci_status status = HCI_OK;
    if (run->has_phase_voltage) {
        leave(csv, "vd_V", s);
        leave(csv, "vq_V", s);
        status = phases_read(csv, lines ? LINE : VOLTAGE, s, s->volt, note);
        return status ? status : vectors_make(s->volt, lines, s->count, &s->voltage, run->path, note);
    }
    if (run->has_dq_voltage) status = column_read(csv, "vq_V", s, &s->vq, note);
    if (!status && run->has_dq_voltage) status = column_read(csv, "vd_V", s, &s->vd, note);
    run->lacks_d_voltage = run->has_dq_voltage && !s->vd;
    if (!status && run->lacks_d_voltage)
        hci_note_add(s->remark,
                     "v_q without v_d: the back-EMF is not compared, and the power where no i_d flows");
    return status;
}

/* Without an angle nothing turns; a column that may be the one or the other is not passed over. */
static hci_status angle_check(const hci_csv *csv, hci_note *note)
{
    hci_note missing = {{0}};
    double unused;
    hci_status status;
    if (has(csv, "theta_e_rad") || has(csv, "theta_m_rad")) return HCI_OK;
    status = hci_csv_check_clear(csv, note);
    if (status || has(csv, "va_V") || has(csv, "vab_V")) return status;
    status = hci_csv_number(csv, "theta_m_rad", 0, &unused, &missing);
    return hci_note_set(note, status, "%s; `theta_e_rad` will do as well", missing.text);
}

static hci_status speed_read(const hci_csv *csv, check_run *run, samples *s, hci_note *note)
{
    run->speed_is_electrical = !has(csv, "speed_rad_per_s") && has(csv, "speed_e_rad_per_s");
    leave(csv, "speed_e_rad_per_s", s);
    return column_read(csv, run->speed_is_electrical ? "speed_e_rad_per_s" : "speed_rad_per_s", s, &s->speed,
                       note);
}

static hci_status samples_read(const hci_csv *csv, check_run *run, samples *s, hci_note *note)
{
    const bool e = has(csv, "theta_e_rad"), m = has(csv, "theta_m_rad");
    hci_status status = angle_check(csv, note);
    run->is_electrical = e;
    find_voltages(csv, run);
    if (!status && hci_csv_header_line(csv) > 0)
        hci_note_add(s->remark, "line %zu is the header, what stands before it is not read",
                     hci_csv_header_line(csv));
    if (!status && (e || m)) status = column_read(csv, e ? "theta_e_rad" : "theta_m_rad", s, &s->theta, note);
    if (!status && e && m) status = column_read(csv, "theta_m_rad", s, &s->other, note);
    if (!status) status = column_read(csv, "time_s", s, &s->time, note);
    if (!status) status = speed_read(csv, run, s, note);
    if (!status) status = column_read(csv, "torque_Nm", s, &s->torque, note);
    if (!status) status = currents_read(csv, run, s, note);
    if (!status) status = voltages_read(csv, run, s, note);
    leave(csv, "temperature_C", s);
    if (!status) hci_csv_unused(csv, s->used, s->remark);
    return status;
}

static void samples_free(samples *s)
{
    double *const all[] = {s->time,     s->theta,    s->other,   s->speed,   s->torque,
                           s->d,        s->q,        s->vd,      s->vq,      s->phase[0],
                           s->phase[1], s->phase[2], s->volt[0], s->volt[1], s->volt[2]};
    for (size_t k = 0; k < sizeof all / sizeof *all; ++k)
        hci_memory_free(all[k]);
    hci_memory_free(s->current);
    hci_memory_free(s->voltage);
    hci_memory_free(s->used);
}

/* ---- means */

static double mean_of(const double *x, size_t n)
{
    double sum = 0.0;
    for (size_t k = 0; k < n; ++k)
        sum += x[k];
    return sum / (double)n;
}

static double square_about(const double *x, size_t n, double mean)
{
    double sum = 0.0;
    for (size_t k = 0; k < n; ++k)
        sum += (x[k] - mean) * (x[k] - mean);
    return sum / (double)n;
}

static double range_of(const double *x, size_t n)
{
    double low = x[0], high = x[0];
    for (size_t k = 1; k < n; ++k) {
        low = fmin(low, x[k]);
        high = fmax(high, x[k]);
    }
    return high - low;
}

/* How far an angle goes over time, in the units of the columns. Steps of more than half the range are where
 * the angle was wrapped, whatever a turn is in its unit; they are left out. */
static double slope_of(const double *angle, const double *time, size_t n)
{
    double path = 0.0, along = 0.0;
    if (!angle || !time || n < 3) return NAN;
    const double most = 0.5 * range_of(angle, n);
    for (size_t k = 1; k < n; ++k) {
        if (fabs(angle[k] - angle[k - 1]) > most) continue;
        path += angle[k] - angle[k - 1];
        along += time[k] - time[k - 1];
    }
    return along > 0.0 ? path / along : (double)NAN;
}

/* theta_e over theta_m, by the steps at which neither is wrapped. */
static double ratio_of(const double *e, const double *m, size_t n)
{
    const double most_e = 0.5 * range_of(e, n), most_m = 0.5 * range_of(m, n);
    double top = 0.0, bottom = 0.0;
    for (size_t k = 1; k < n; ++k) {
        const double x = m[k] - m[k - 1], y = e[k] - e[k - 1];
        if (fabs(y) > most_e || fabs(x) > most_m) continue;
        top += x * y;
        bottom += x * x;
    }
    return bottom > 0.0 ? top / bottom : (double)NAN;
}

static double mean_square(const check_vector *x, size_t n)
{
    double sum = 0.0;
    for (size_t k = 0; k < n; ++k)
        sum += x[k].re * x[k].re + x[k].im * x[k].im;
    return sum / (double)n;
}

/* How fast a vector turns, by its steps. */
static double frequency_of(const check_vector *x, const double *time, size_t n)
{
    double sum = 0.0;
    if (!x || !time || n < 3 || !(time[n - 1] > time[0])) return NAN;
    for (size_t k = 1; k < n; ++k) {
        const check_vector step = hci_check_product(x[k], hci_check_conjugate(x[k - 1]));
        sum += atan2(step.im, step.re);
    }
    return sum / (time[n - 1] - time[0]);
}

/* Alternating rms of the largest over that of the smallest phase. */
static double balance_of(double *const column[3], size_t n)
{
    double least = HUGE_VAL, most = 0.0;
    for (int s = 0; s < 3; ++s) {
        if (!column[s]) return NAN;
        const double square = square_about(column[s], n, mean_of(column[s], n));
        least = fmin(least, square);
        most = fmax(most, square);
    }
    return least > 0.0 ? sqrt(most / least) : (double)NAN;
}

static double sum_of_phases(double *const column[3], size_t n)
{
    double sum = 0.0, square = 0.0;
    if (!column[0] || !column[1] || !column[2]) return NAN;
    for (size_t k = 0; k < n; ++k) {
        const double a = column[0][k], b = column[1][k], c = column[2][k];
        sum += (a + b + c) * (a + b + c);
        square += a * a + b * b + c * c;
    }
    return square > 0.0 ? sqrt(sum / square) : (double)NAN;
}

/* ---- frames */

static void frame_take(const samples *s, check_frame *f)
{
    const double share = 1.0 / (double)s->count;
    for (size_t k = 0; k < s->count; ++k) {
        const double angle = f->scale * s->theta[k];
        for (int way = FORWARD; way <= BACKWARD; ++way) {
            const check_vector back =
                hci_check_turned((check_vector){share, 0.0}, way == FORWARD ? -angle : angle);
            if (s->current)
                f->current[way] = hci_check_sum(f->current[way], hci_check_product(s->current[k], back));
            if (s->voltage)
                f->voltage[way] = hci_check_sum(f->voltage[way], hci_check_product(s->voltage[k], back));
        }
    }
}

/* Scale and sequence at which a vector turns with the recorded angle; NAN where it is coherent with none of
 * those at which it would have turned at all. */
static double order_of(const check_run *run, size_t scales, bool of_current, double square)
{
    double best = COHERENT * square, order = NAN;
    for (size_t k = 0; k < scales; ++k)
        for (int way = FORWARD; way <= BACKWARD; ++way) {
            const check_frame *f = &run->frame[k];
            if (f->scale * run->angle_range < LEAST_TURN) continue;
            const double length = hci_check_length(of_current ? f->current[way] : f->voltage[way]);
            if (!(length * length > best)) continue;
            best = length * length;
            order = way == FORWARD ? f->scale : -f->scale;
        }
    return order;
}

static void frames_take(const check_figures *f, const samples *s, check_run *run)
{
    for (size_t k = 0; k < f->scales; ++k) {
        run->frame[k].scale = f->scale[k];
        frame_take(s, &run->frame[k]);
    }
    run->current_order = s->current ? order_of(run, f->scales, true, run->current_square) : (double)NAN;
    run->voltage_order = s->voltage ? order_of(run, f->scales, false, run->voltage_square) : (double)NAN;
}

/* ---- a run */

/* 0 throughout: the shaft was held, and the torque is not a reading. */
static void ripple_take(const samples *s, check_run *run)
{
    run->has_torque = square_about(s->torque, s->count, 0.0) > 0.0;
    run->is_held = !run->has_torque && s->q != NULL;
    for (size_t k = 0; run->is_held && k < s->count; ++k)
        s->torque[k] = -s->q[k];
    run->ripple_mean = mean_of(s->torque, s->count);
    run->ripple_square = square_about(s->torque, s->count, run->ripple_mean);
}

static check_vector pair_at(const double *d, const double *q, size_t k)
{
    return (check_vector){d ? d[k] : 0.0, q ? q[k] : 0.0};
}

/* A voltage that does not follow the speed, as by a speed without sign, says nothing of it. */
static void loop_take(const samples *s, check_run *run)
{
    double weights = 0.0, weight_square = 0.0, square = 0.0;
    check_loop sum = {0};
    for (size_t k = 0; k < s->count; ++k) {
        const double speed = s->speed ? s->speed[k] : 1.0;
        const check_vector v = pair_at(s->vd, s->vq, k), i = pair_at(s->d, s->q, k);
        sum.voltage = hci_check_sum(sum.voltage, hci_check_scaled(v, speed));
        sum.current = hci_check_sum(sum.current, hci_check_scaled(i, speed));
        sum.turning = hci_check_sum(sum.turning, hci_check_scaled(i, speed * speed));
        weights += fabs(speed);
        weight_square += speed * speed;
        square += v.re * v.re + v.im * v.im;
        run->power = hci_check_sum(run->power, hci_check_product(v, hci_check_conjugate(i)));
    }
    const double length = hci_check_length(sum.voltage), share = weights > 0.0 ? 1.0 / weights : 0.0;
    run->dq_voltage_is_coherent = length * length > COHERENT * weight_square * square;
    run->voltage_square = square / (double)s->count;
    run->power = hci_check_scaled(run->power, 1.0 / (double)s->count);
    run->loop.voltage = hci_check_scaled(sum.voltage, share);
    run->loop.current = hci_check_scaled(sum.current, share);
    run->loop.turning = hci_check_scaled(sum.turning, share);
    run->loop.speed = weight_square * share;
}

static double torque_at_speed(const samples *s, const check_run *run)
{
    double sum = 0.0;
    if (!s->speed || !(fabs(run->speed) > 0.0)) return run->ripple_mean;
    for (size_t k = 0; k < s->count; ++k)
        sum += s->torque[k] * s->speed[k];
    return sum / (double)s->count / run->speed;
}

static bool lacks_d_current(const samples *s, const check_run *run)
{
    return !s->d || square_about(s->d, s->count, 0.0) <= NO_CURRENT * NO_CURRENT * run->current_square;
}

static void means_take(const samples *s, check_run *run)
{
    const size_t n = s->count;
    run->angle_range = s->theta ? range_of(s->theta, n) : 0.0;
    run->slope = slope_of(s->theta, s->time, n);
    run->angle_ratio = s->other ? ratio_of(s->theta, s->other, n) : (double)NAN;
    run->speed = s->speed ? mean_of(s->speed, n) : (double)NAN;
    run->has_speed = s->speed != NULL;
    if (s->torque) ripple_take(s, run);
    if (s->torque) run->torque_at_speed = torque_at_speed(s, run);
    if (s->q) {
        run->dq = (check_vector){s->d ? mean_of(s->d, n) : 0.0, mean_of(s->q, n)};
        run->current_square = square_about(s->q, n, 0.0) + (s->d ? square_about(s->d, n, 0.0) : 0.0);
    }
    run->dq_is_steady =
        hci_check_length(run->dq) * hci_check_length(run->dq) > COHERENT * run->current_square;
    if (s->current) run->current_square = mean_square(s->current, n);
    run->lacks_d_current = lacks_d_current(s, run);
    if (s->voltage) run->voltage_square = mean_square(s->voltage, n);
    if (s->vq) loop_take(s, run);
    run->frequency = frequency_of(s->voltage, s->time, n);
    run->current_sum = sum_of_phases(s->phase, n);
    run->current_balance = balance_of(s->phase, n);
    run->voltage_balance = balance_of(s->volt, n);
    run->current_order = run->voltage_order = NAN;
    for (size_t k = 0; s->current && s->voltage && k < n; ++k)
        run->power = hci_check_sum(
            run->power, hci_check_scaled(hci_check_product(s->voltage[k], hci_check_conjugate(s->current[k])),
                                         1.0 / (double)n));
}

static hci_status run_take(const hci_csv *csv, check_figures *f, check_run *run, hci_note *told,
                           hci_note *note)
{
    samples s = {.count = hci_csv_rows(csv), .remark = told};
    hci_status status;
    run->count = s.count;
    if (s.count == 0)
        return hci_note_set(note, HCI_ERROR_INPUT,
                            "%s: found a header and no samples, expected a row for each sample; record the "
                            "run again",
                            run->path);
    s.used = hci_memory_new(hci_csv_columns(csv), sizeof *s.used);
    if (!s.used) return hci_note_set(note, HCI_ERROR_MEMORY, "%s: out of memory", run->path);
    status = samples_read(csv, run, &s, note);
    if (!status) {
        places(csv, run);
        means_take(&s, run);
        if (s.theta) frames_take(f, &s, run);
        run->theta = s.theta;
        run->ripple = s.torque;
        s.theta = s.torque = NULL;
    }
    samples_free(&s);
    return status;
}

static hci_status run_read(const char *path, check_figures *f, check_run *run, hci_note *told, hci_note *note)
{
    hci_csv *csv;
    hci_status status;
    if (snprintf(run->path, sizeof run->path, "%s", path) >= (int)sizeof run->path)
        return hci_note_set(note, HCI_ERROR_INPUT, "%.200s…: the path is longer than %d bytes", path,
                            HCI_CHECK_PATH - 1);
    status = hci_csv_read(path, &csv, note);
    if (status) return status;
    status = run_take(csv, f, run, told, note);
    hci_csv_free(csv);
    return status;
}

static void add_scale(check_figures *f, double scale)
{
    for (size_t k = 0; k < f->scales; ++k)
        if (fabs(f->scale[k] / scale - 1.0) < 1e-9) return;
    f->scale[f->scales++] = scale;
}

/* 1, p and p/2 electrical radians for a recorded one, and so for degrees. */
static void scales_make(check_figures *f)
{
    const double p = f->value[CHECK_pole_pairs];
    for (int degrees = 0; degrees <= 1; ++degrees) {
        const double unit = degrees ? DEGREE : 1.0;
        add_scale(f, unit);
        add_scale(f, unit * p);
        if (fmod(p, 2.0) == 0.0) add_scale(f, unit * 0.5 * p);
    }
}

static double no_current(const check_figures *f)
{
    double most = f->value[CHECK_rated_current_A];
    for (size_t k = 0; k < f->runs; ++k)
        most = fmax(most, sqrt(f->run[k].current_square)); /* of NAN and a number the number */
    return NO_CURRENT * most;
}

hci_status hci_check_runs_read(const char *const *path, size_t count, check_figures *f, hci_note *told,
                               hci_note *note)
{
    hci_status status = HCI_OK;
    scales_make(f);
    f->run = hci_memory_new(count, sizeof *f->run);
    if (!f->run) return hci_note_set(note, HCI_ERROR_MEMORY, "out of memory for %zu runs", count);
    for (size_t k = 0; k < count && !status; ++k) {
        status = run_read(path[k], f, &f->run[k], &told[k], note);
        ++f->runs;
    }
    f->no_current_A = no_current(f);
    return status;
}

void hci_check_figures_release(check_figures *f)
{
    for (size_t k = 0; k < f->runs; ++k) {
        hci_memory_free(f->run[k].theta);
        hci_memory_free(f->run[k].ripple);
    }
    hci_memory_free(f->run);
    hci_memory_free(f->emf.order);
    hci_memory_free(f->cogging.order);
    memset(f, 0, sizeof *f);
}

/* ---- asked for by the relations */

const check_frame *hci_check_frame_of(const check_run *run, double scale)
{
    for (size_t k = 0; run->theta && k < CHECK_SCALES; ++k)
        if (fabs(run->frame[k].scale / fabs(scale) - 1.0) < 1e-9) return &run->frame[k];
    return NULL;
}

static check_vector torque_order(const check_run *run, double order)
{
    check_vector sum = {0.0, 0.0};
    const double share = 2.0 / (double)run->count;
    for (size_t k = 0; k < run->count; ++k) {
        const double x = share * (run->ripple[k] - run->ripple_mean);
        sum.re += x * sin(order * run->theta[k]);
        sum.im += x * cos(order * run->theta[k]);
    }
    return sum;
}

check_vector hci_check_torque_order(check_run *run, double order)
{
    const size_t kept = run->known_count < CHECK_KNOWN_ORDERS ? run->known_count : CHECK_KNOWN_ORDERS;
    for (size_t k = 0; k < kept; ++k)
        if (fabs(run->known[k].order - order) <= 1e-12 * fabs(order)) return run->known[k].wave;
    check_known_order *next = &run->known[run->known_count++ % CHECK_KNOWN_ORDERS];
    *next = (check_known_order){order, torque_order(run, order)};
    return next->wave;
}

bool hci_check_has_current(const check_figures *f, const check_run *run)
{
    return sqrt(run->current_square) > f->no_current_A && run->current_square > 0.0;
}
