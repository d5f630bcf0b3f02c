#include "host/check/run_samples.h"

#include <stdio.h>

#include "hci/machine/frames.h"
#include "host/base/memory.h"
#include "host/csv/table.h"

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
static void leave(const hci_csv *csv, const char *name, check_samples *s)
{
    size_t column;
    if (hci_csv_find(csv, name, &column)) s->used[column] = true;
}

static hci_status column_read(const hci_csv *csv, const char *name, check_samples *s, double **values,
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
static hci_status phases_read(const hci_csv *csv, const char *const name[3], check_samples *s,
                              double *column[3], hci_note *note)
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

static hci_status currents_read(const hci_csv *csv, check_run *run, check_samples *s, hci_note *note)
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

static hci_status voltages_read(const hci_csv *csv, check_run *run, check_samples *s, hci_note *note)
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

static hci_status speed_read(const hci_csv *csv, check_run *run, check_samples *s, hci_note *note)
{
    run->speed_is_electrical = !has(csv, "speed_rad_per_s") && has(csv, "speed_e_rad_per_s");
    leave(csv, "speed_e_rad_per_s", s);
    return column_read(csv, run->speed_is_electrical ? "speed_e_rad_per_s" : "speed_rad_per_s", s, &s->speed,
                       note);
}

hci_status hci_check_samples_read(const hci_csv *csv, check_run *run, check_samples *s, hci_note *note)
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
    if (status) return status;
    hci_csv_unused(csv, s->used, s->remark);
    places(csv, run);
    return HCI_OK;
}

void hci_check_samples_release(check_samples *s)
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
