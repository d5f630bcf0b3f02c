/* The rows of trajectory.csv of a simulation, one every so many steps. */
#include <math.h>
#include <stdio.h>

#include "hci/machine/frames.h"
#include "host/samples/trajectory.h"

static double wrapped_rad(double angle_rad)
{
    const double turn = 2.0 * HCI_PI, wrapped = angle_rad - turn * floor(angle_rad / turn);
    return wrapped < turn ? wrapped : 0.0;
}

void hci_trajectory_names(const hci_simulation_plan *plan, char *names, size_t size)
{
    snprintf(names, size,
             "time_s,theta_m_rad,theta_e_rad,speed_rad_per_s,ia_A,ib_A,ic_A,id_A,iq_A,torque_Nm%s,"
             "load_torque_Nm,id_reference_A,iq_reference_A%s%s%s",
             plan->has_voltage ? ",va_V,vb_V,vc_V" : "", plan->has_command ? ",torque_command_Nm" : "",
             isnan(plan->temperature_C) ? "" : ",temperature_C",
             plan->has_sensors
                 ? ",theta_m_true_rad,speed_true_rad_per_s,ia_true_A,ib_true_A,ic_true_A,torque_true_Nm"
                 : "");
}

void hci_trajectory_begin(hci_trajectory *t, const hci_simulation_plan *plan, hci_trajectory_sink *sink,
                          void *context)
{
    *t = (hci_trajectory){.sink = sink, .context = context, .plan = *plan};
}

static void row_to_file(void *out, const double *row, size_t columns)
{
    for (size_t k = 0; k < columns; ++k)
        hci_output_number(out, row[k], k + 1 < columns ? ',' : '\n');
}

hci_status hci_trajectory_begin_file(hci_trajectory *t, hci_output *out, const hci_simulation_plan *plan,
                                     hci_note *note)
{
    char names[HCI_SAMPLES_COLUMNS];
    const hci_status status = hci_output_file(out, "trajectory.csv", note);
    if (status) return status;
    hci_trajectory_begin(t, plan, row_to_file, out);
    hci_trajectory_names(plan, names, sizeof names);
    hci_output_text(out, "%s\n", names);
    return HCI_OK;
}

enum { THETA_E_COLUMN = 2, CURRENT_COLUMN = 4, VOLTAGE_COLUMN = 10 };

/* Gives the row that waits away. */
static void give_row(hci_trajectory *t)
{
    if (t->columns == 0) return;
    if (t->plan.has_voltage) {
        const double mean_V[2] = {t->v_sum_V[0] / (double)t->waited, t->v_sum_V[1] / (double)t->waited};
        hci_plane_to_abc(mean_V, t->row + VOLTAGE_COLUMN);
    }
    t->sink(t->context, t->row, t->columns);
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
    return !t->plan.has_voltage && t->plan.has_sensors && t->columns > 0 && t->waited == 1;
}

static void put_readings(hci_trajectory *t, const hci_simulation_step *step)
{
    const hci_measurement *m = &step->state->measured;
    double abc[3];
    put(t, step->time_s);
    put(t, wrapped_rad(m->theta_m_rad));
    put(t, wrapped_rad(t->plan.pole_pairs * m->theta_m_rad));
    put(t, m->speed_rad_per_s);
    hci_plane_to_abc(step->i_A, abc);
    set_currents(t, t->plan.has_sensors ? m->i_abc : abc);
    t->columns += 5;
    put(t, step->state->torque_measured_Nm);
}

static void put_references(hci_trajectory *t, const hci_simulation_step *step)
{
    const double theta_rad = t->plan.pole_pairs * step->state->measured.theta_m_rad;
    double abc[3];
    hci_dq dq;
    hci_plane_to_abc(step->state->control.reference, abc);
    dq = hci_park(hci_clarke(abc), theta_rad);
    put(t, step->load_Nm);
    put(t, dq.d);
    put(t, dq.q);
    if (t->plan.has_command) put(t, step->state->control.torque_Nm);
    if (!isnan(t->plan.temperature_C)) put(t, t->plan.temperature_C);
}

static void put_truth(hci_trajectory *t, const hci_simulation_step *step)
{
    double abc[3];
    hci_plane_to_abc(step->i_A, abc);
    put(t, wrapped_rad(step->theta_e_rad / t->plan.pole_pairs));
    put(t, step->speed_rad_per_s);
    for (int s = 0; s < 3; ++s)
        put(t, abc[s]);
    put(t, step->torque_Nm);
}

static void begin_row(hci_trajectory *t, const hci_simulation_step *step)
{
    t->waited = 0;
    t->v_sum_V[0] = t->v_sum_V[1] = 0.0;
    put_readings(t, step);
    if (t->plan.has_voltage) t->columns += 3;
    put_references(t, step);
    if (t->plan.has_sensors) put_truth(t, step);
}

void hci_trajectory_add(hci_trajectory *t, const hci_simulation_step *step)
{
    if (is_read_late(t)) set_currents(t, step->state->measured.i_abc);
    if (t->waited >= t->plan.steps_per_row) give_row(t);
    if (t->columns == 0) begin_row(t, step);
    t->v_sum_V[0] += step->v_V[0];
    t->v_sum_V[1] += step->v_V[1];
    ++t->waited;
}

void hci_trajectory_end(hci_trajectory *t)
{
    if (is_read_late(t)) t->columns = 0;
    give_row(t);
}
