/* trajectory.csv, spectrum.csv, summary.json and report.html of a simulation. */
#include <math.h>

#include "hci/host/report/summary.h"
#include "hci/machine/frames.h"
#include "host/report/report.h"
#include "host/simulate/simulation.h"

/* ---- trajectory: what a logger would read, then the truth where sensors stand between ---- */

static bool has_voltage(const hci_setup *setup)
{
    return setup->drive.control.loop != HCI_CURRENT_IDEAL;
}

static double wrapped_rad(double angle_rad)
{
    const double turn = 2.0 * HCI_PI, wrapped = angle_rad - turn * floor(angle_rad / turn);
    return wrapped < turn ? wrapped : 0.0;
}

hci_status hci_trajectory_begin(hci_trajectory *t, hci_output *out, const hci_setup *setup, hci_note *note)
{
    const hci_status status = hci_output_file(out, "trajectory.csv", note);
    if (status) return status;
    t->out = out;
    t->setup = setup;
    t->columns = t->waited = 0;
    hci_output_text(
        out,
        "time_s,theta_m_rad,theta_e_rad,speed_rad_per_s,ia_A,ib_A,ic_A,id_A,iq_A,torque_Nm%s,"
        "load_torque_Nm,id_reference_A,iq_reference_A%s%s%s\n",
        has_voltage(setup) ? ",va_V,vb_V,vc_V" : "", setup->has_command ? ",torque_command_Nm" : "",
        isnan(setup->temperature_C) ? "" : ",temperature_C",
        setup->drive.sensors
            ? ",theta_m_true_rad,speed_true_rad_per_s,ia_true_A,ib_true_A,ic_true_A,torque_true_Nm"
            : "");
    return HCI_OK;
}

enum { THETA_E_COLUMN = 2, CURRENT_COLUMN = 4, VOLTAGE_COLUMN = 10 };

/* Writes the row that waits. */
static void write_row(hci_trajectory *t)
{
    if (t->columns == 0) return;
    if (has_voltage(t->setup)) {
        const double mean[2] = {t->v_sum[0] / (double)t->waited, t->v_sum[1] / (double)t->waited};
        hci_plane_to_abc(mean, t->row + VOLTAGE_COLUMN);
    }
    for (size_t k = 0; k < t->columns; ++k)
        hci_output_number(t->out, t->row[k], k + 1 < t->columns ? ',' : '\n');
    t->columns = 0;
}

static void put(hci_trajectory *t, double value)
{
    t->row[t->columns++] = value;
}

/* Phase currents, and i_d and i_q at the angle that the row has read. */
static void set_currents(hci_trajectory *t, const double abc[3])
{
    double *column = t->row + CURRENT_COLUMN;
    const hci_dq dq = hci_park(hci_clarke(abc), t->row[THETA_E_COLUMN]);
    for (int s = 0; s < 3; ++s)
        column[s] = abc[s];
    column[3] = dq.d;
    column[4] = dq.q;
}

/* An ideal source's current flows from the sample on, so that it is read at the next one. */
static bool is_read_late(const hci_trajectory *t)
{
    return !has_voltage(t->setup) && t->setup->drive.sensors && t->columns > 0 && t->waited == 1;
}

static void put_readings(hci_trajectory *t, const hci_record *r)
{
    const hci_measurement *m = &r->state->measured;
    double abc[3];
    put(t, r->time_s);
    put(t, wrapped_rad(m->theta_m_rad));
    put(t, wrapped_rad(t->setup->drive.plant.table.pole_pairs * m->theta_m_rad));
    put(t, m->speed_rad_per_s);
    hci_plane_to_abc(r->i, abc);
    set_currents(t, t->setup->drive.sensors ? m->i_abc : abc);
    t->columns += 5;
    put(t, r->state->torque_measured_Nm);
}

static void put_references(hci_trajectory *t, const hci_record *r)
{
    const double theta_rad = t->setup->drive.plant.table.pole_pairs * r->state->measured.theta_m_rad;
    double abc[3];
    hci_dq dq;
    hci_plane_to_abc(r->state->control.reference, abc);
    dq = hci_park(hci_clarke(abc), theta_rad);
    put(t, r->load_Nm);
    put(t, dq.d);
    put(t, dq.q);
    if (t->setup->has_command) put(t, r->state->control.torque_Nm);
    if (!isnan(t->setup->temperature_C)) put(t, t->setup->temperature_C);
}

static void put_truth(hci_trajectory *t, const hci_record *r)
{
    double abc[3];
    hci_plane_to_abc(r->i, abc);
    put(t, wrapped_rad(r->angle_rad / t->setup->drive.plant.table.pole_pairs));
    put(t, r->speed_rad_per_s);
    for (int s = 0; s < 3; ++s)
        put(t, abc[s]);
    put(t, r->torque_Nm);
}

static void add_to_traces(hci_traces *traces, const hci_record *r)
{
    double value[HCI_TRACES];
    value[HCI_TRACE_TORQUE_NM] = r->torque_Nm;
    value[HCI_TRACE_SPEED_RPM] = r->speed_rad_per_s * 30.0 / HCI_PI;
    hci_plane_to_abc(r->i, &value[HCI_TRACE_A_A]);
    hci_traces_add(traces, r->time_s, r->angle_rad, value);
}

void hci_trajectory_add(hci_trajectory *t, const hci_record *r)
{
    if (t->traces) add_to_traces(t->traces, r);
    if (is_read_late(t)) set_currents(t, r->state->measured.i_abc);
    if (t->waited >= t->setup->every) write_row(t);
    if (t->columns == 0) {
        t->waited = 0;
        t->v_sum[0] = t->v_sum[1] = 0.0;
        put_readings(t, r);
        if (has_voltage(t->setup)) t->columns += 3;
        put_references(t, r);
        if (t->setup->drive.sensors) put_truth(t, r);
    }
    t->v_sum[0] += r->v[0];
    t->v_sum[1] += r->v[1];
    ++t->waited;
}

void hci_trajectory_end(hci_trajectory *t)
{
    if (is_read_late(t)) t->columns = 0;
    write_row(t);
}

/* ---- spectrum and summary ---- */

/* At order 0 the amplitude is the signed mean and the phase π/2, so that A sin(nθ + γ) holds for every row.
 */
static void write_spectrum(hci_output *out, const hci_simulation *s)
{
    hci_output_text(out, "order,torque_Nm,torque_phase_rad\n");
    for (size_t k = 0; k < s->spectrum_count; ++k) {
        const hci_harmonic h = s->spectrum_Nm[k];
        hci_output_number(out, h.order, ',');
        hci_output_number(out, k == 0 ? h.cosine : hci_amplitude(h.sine, h.cosine), ',');
        hci_output_number(out, k == 0 ? HCI_PI / 2 : hci_phase_rad(h.sine, h.cosine), '\n');
    }
}

static hci_status write_report(hci_output *out, const hci_simulation *simulation, const hci_traces *traces,
                               const hci_report_sources *sources, hci_note *note)
{
    const hci_status status =
        sources ? hci_output_file(out, "report.html", note) : hci_output_without(out, "report.html", note);
    if (status || !sources) return status;
    return hci_report_simulation(out, simulation, traces, sources, note);
}

hci_status hci_simulation_write(hci_output *out, const hci_simulation *simulation, const hci_traces *traces,
                                const hci_report_sources *sources, hci_note *note)
{
    char *json = hci_simulation_json(simulation);
    hci_status status = json ? HCI_OK : hci_note_set(note, HCI_ERROR_MEMORY, "out of memory for the summary");
    if (!status) status = hci_output_file(out, "spectrum.csv", note);
    if (!status) write_spectrum(out, simulation);
    if (!status) status = hci_output_file(out, "summary.json", note);
    if (!status) hci_output_text(out, "%s\n", json);
    hci_text_free(json);
    if (!status) status = write_report(out, simulation, traces, sources, note);
    return status;
}
