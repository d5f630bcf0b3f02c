#include "host/check/data/run_samples.h"

#include <math.h>
#include <stdio.h>

#include "hci/machine/frames.h"
#include "hci/math/harmonic.h"
#include "host/base/memory.h"
#include "host/csv/table.h"
#include "host/recording/clock.h"
#include "host/recording/holes.h"

/* ---- where the columns stand */

static void place(const check_samples *s, hci_run_column which, check_run *run, check_place *out)
{
    size_t line;
    const char *header = hci_run_column_header(&s->columns, which, &line);
    if (!header) return;
    out->path = run->path;
    out->line = line;
    snprintf(out->column, sizeof out->column, "%s", header);
    snprintf(out->text, sizeof out->text, "%s", header);
    out->unit_line = hci_run_column_unit_line(&s->columns, which);
    out->factor = hci_run_column_factor(&s->columns, which);
    out->names_unit = hci_run_column_names_unit(&s->columns, which);
}

static void places(const check_samples *s, check_run *run)
{
    place(s, run->is_electrical ? HCI_RUN_THETA_E : HCI_RUN_THETA_M, run, &run->theta_cell);
    place(s, HCI_RUN_TIME, run, &run->time_cell);
    place(s, run->speed_is_electrical ? HCI_RUN_SPEED_E : HCI_RUN_SPEED, run, &run->speed_cell);
    place(s, run->has_abc ? HCI_RUN_IA : HCI_RUN_IQ, run, &run->current_cell);
    if (run->has_dq) place(s, HCI_RUN_ID, run, &run->d_cell);
    for (int phase = 0; phase < 3 && run->has_abc; ++phase)
        place(s, HCI_RUN_IA + (hci_run_column)phase, run, &run->phase_cell[phase]);
    if (!run->has_line_voltage)
        place(s, run->has_dq_voltage ? HCI_RUN_VQ : HCI_RUN_VA, run, &run->voltage_cell);
    place(s, HCI_RUN_TORQUE, run, &run->torque_cell);
    if (run->channel.state == CHECK_CHANNEL_ODD || run->channel.state == CHECK_CHANNEL_DEAD)
        place(s, HCI_RUN_IA + (hci_run_column)run->channel.phase, run, &run->channel_cell);
    if (run->channel.state == CHECK_CHANNELS_TWINS)
        place(s, HCI_RUN_IA + (hci_run_column)((run->channel.phase + 1) % 3), run, &run->channel_cell);
}

/* ---- columns */

static hci_status read_column(check_samples *s, hci_run_column which, const double **values)
{
    const hci_status status = hci_run_column_read(&s->columns, which);
    *values = s->columns.value[which];
    return status;
}

/* Beside theta_e, the mechanical angle is there to be compared. */
static hci_status read_angles(check_run *run, check_samples *s)
{
    const bool *has = s->columns.has;
    run->is_electrical = has[HCI_RUN_THETA_E];
    if (!run->is_electrical) return read_column(s, HCI_RUN_THETA_M, &s->theta);
    const hci_status status = read_column(s, HCI_RUN_THETA_E, &s->theta);
    return status ? status : read_column(s, HCI_RUN_THETA_M, &s->other);
}

/* The zero that the user gives, of an angle that has been read. */
static void turn_angle(const hci_csv *csv, double pole_pairs, check_run *run, check_samples *s)
{
    double *theta = s->columns.value[run->is_electrical ? HCI_RUN_THETA_E : HCI_RUN_THETA_M];
    if (!csv->has_angle_offset || theta == NULL) return;
    run->given_zero_rad = csv->angle_offset_rad;
    for (size_t k = 0; k < s->count; ++k)
        theta[k] += csv->angle_offset_rad / (run->is_electrical ? 1.0 : pole_pairs);
    hci_note_add(s->columns.remark, "%.4g degrees electrical are added to the angle",
                 csv->angle_offset_rad * 180.0 / HCI_PI);
}

static hci_status read_time(check_samples *s)
{
    const hci_status status = read_column(s, HCI_RUN_TIME, &s->time);
    const hci_stamps stamps = {s->columns.value[HCI_RUN_TIME], s->columns.row, s->count};
    if (!status && s->time && !hci_clock_mend(stamps, s->columns.remark)) s->time = NULL;
    if (!status && s->time) s->gap_s = hci_clock_gap_s(s->time, s->count);
    return status;
}

static hci_status read_speed(check_run *run, check_samples *s)
{
    run->speed_is_electrical = !s->columns.has[HCI_RUN_SPEED] && s->columns.has[HCI_RUN_SPEED_E];
    hci_run_column_leave(&s->columns, HCI_RUN_SPEED_E);
    return read_column(s, run->speed_is_electrical ? HCI_RUN_SPEED_E : HCI_RUN_SPEED, &s->speed);
}

/* Three columns and the vectors α + jβ that they make. */
static hci_status read_phases(check_samples *s, hci_run_column first, check_vector **vectors, hci_note *note)
{
    const hci_status status = hci_run_phases_read(&s->columns, first);
    if (status) return status;
    *vectors = hci_memory_new(s->count, sizeof **vectors);
    if (!*vectors) return hci_note_memory(note, hci_csv_path(s->columns.csv), "its rows");
    for (size_t k = 0; k < s->count; ++k) {
        double x[3];
        hci_run_phases_at(&s->columns, first, k, x);
        const hci_alpha_beta y = hci_clarke(x);
        (*vectors)[k] = (check_vector){y.alpha, y.beta};
    }
    return HCI_OK;
}

/* Phase currents that stand beside i_d and i_q tell how large these should be: their vector is as long. */
static hci_status compare_phases(check_run *run, check_samples *s, hci_note *note)
{
    check_vector *phases = NULL;
    double of_phases = 0.0, of_dq = 0.0;
    const hci_status status = read_phases(s, HCI_RUN_IA, &phases, note);
    for (size_t k = 0; !status && k < s->count; ++k) {
        of_phases += phases[k].re * phases[k].re + phases[k].im * phases[k].im;
        of_dq += s->q[k] * s->q[k] + (s->d ? s->d[k] * s->d[k] : 0.0);
    }
    run->phase_ratio = of_dq > 0.0 && of_phases > 0.0 ? sqrt(of_phases / of_dq) : (double)NAN;
    hci_memory_free(phases);
    return status;
}

/* Of three columns the one that has to be read otherwise, for their sum to be nothing, is read so. */
static hci_status mend_channel(const check_data *data, check_run *run, check_samples *s)
{
    const hci_status status = hci_run_phases_read(&s->columns, HCI_RUN_IA);
    double **column = &s->columns.value[HCI_RUN_IA];
    if (status || data->has_neutral || !column[0] || !column[1] || !column[2]) return status;
    run->channel = hci_check_odd_channel(s->phase, s->count);
    const int odd = run->channel.phase, a = (odd + 1) % 3, b = (odd + 2) % 3;
    if (run->channel.state == CHECK_CHANNEL_ODD || run->channel.state == CHECK_CHANNEL_DEAD)
        for (size_t k = 0; k < s->count; ++k)
            column[odd][k] = run->channel.state == CHECK_CHANNEL_DEAD ? -(column[a][k] + column[b][k])
                                                                      : column[odd][k] / run->channel.gain;
    return HCI_OK;
}

/* i_d, i_q that were recorded beside v_d, v_q belong together; else phase currents need no angle of the
 * drive. */
static hci_status read_currents(const check_data *data, check_run *run, check_samples *s, hci_note *note)
{
    const int phases = hci_run_phase_count(&s->columns, HCI_RUN_IA);
    run->has_dq = s->columns.has[HCI_RUN_IQ] && (phases < 2 || run->has_dq_voltage);
    run->phase_ratio = NAN;
    run->has_abc = phases >= 2 && !run->has_dq;
    for (hci_run_column which = HCI_RUN_IA; which <= HCI_RUN_IQ; ++which)
        hci_run_column_leave(&s->columns, which);
    s->phase = (const double *const *)&s->columns.value[HCI_RUN_IA];
    hci_status status = run->has_abc ? mend_channel(data, run, s) : HCI_OK;
    if (run->has_abc && !status) return read_phases(s, HCI_RUN_IA, &s->current, note);
    if (!run->has_dq || status) return status;
    status = read_column(s, HCI_RUN_IQ, &s->q);
    if (!status) status = read_column(s, HCI_RUN_ID, &s->d);
    if (status || phases < 2) return status;
    hci_note_add(s->columns.remark, "phase currents beside i_d and i_q: their size is compared, and no more");
    return compare_phases(run, s, note);
}

/* Beside phase currents alone v_d, v_q would need the drive's angle, and beside none they are a command. */
static void find_voltages(check_run *run, const check_samples *s, hci_run_column *first)
{
    const bool *has = s->columns.has;
    run->has_phase_voltage = hci_run_voltages(&s->columns, first);
    run->has_line_voltage = run->has_phase_voltage && *first == HCI_RUN_VAB;
    run->has_dq_voltage = !run->has_phase_voltage && has[HCI_RUN_VQ] && has[HCI_RUN_IQ];
    run->has_voltage = run->has_phase_voltage || run->has_dq_voltage;
}

static hci_status read_dq_voltages(check_run *run, check_samples *s, hci_note *remark)
{
    hci_status status = read_column(s, HCI_RUN_VQ, &s->vq);
    if (!status) status = read_column(s, HCI_RUN_VD, &s->vd);
    run->lacks_d_voltage = !s->vd;
    if (!status && run->lacks_d_voltage)
        hci_note_add(remark,
                     "v_q without v_d: the back-EMF is not compared, and the power where no i_d flows");
    return status;
}

static hci_status read_voltages(check_run *run, check_samples *s, hci_run_column first, hci_note *note)
{
    s->volt = (const double *const *)&s->columns.value[first];
    if (run->has_dq_voltage) return read_dq_voltages(run, s, s->columns.remark);
    if (!run->has_phase_voltage) return HCI_OK;
    hci_run_column_leave(&s->columns, HCI_RUN_VD);
    hci_run_column_leave(&s->columns, HCI_RUN_VQ);
    return read_phases(s, first, &s->voltage, note);
}

static hci_status read_torque(check_samples *s)
{
    return read_column(s, HCI_RUN_TORQUE, &s->torque);
}

hci_status hci_check_samples_read(const hci_csv *csv, const check_data *data, check_run *run,
                                  check_samples *s, hci_note *remark, hci_note *note)
{
    hci_run_column first = HCI_RUN_VA;
    hci_status status = hci_run_columns_open_any(csv, &s->columns, remark, note);
    s->count = s->columns.count;
    find_voltages(run, s, &first);
    if (!status) status = read_angles(run, s);
    if (!status) turn_angle(csv, data->value[CHECK_pole_pairs], run, s);
    if (!status) status = read_time(s);
    if (!status) status = read_speed(run, s);
    if (!status) status = read_torque(s);
    if (!status) status = read_currents(data, run, s, note);
    if (!status) status = read_voltages(run, s, first, note);
    if (status) return status;
    hci_run_column_leave(&s->columns, HCI_RUN_TEMPERATURE);
    hci_run_computed_torque_leave(&s->columns);
    hci_run_columns_tell_unused(&s->columns);
    places(s, run);
    return HCI_OK;
}

void hci_check_samples_release(check_samples *s)
{
    hci_run_columns_release(&s->columns);
    hci_memory_free(s->current);
    hci_memory_free(s->voltage);
}
