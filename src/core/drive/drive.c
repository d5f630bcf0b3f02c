#include "hci/drive/control.h"

void hci_drive_measure(const hci_drive *drive, hci_drive_state *state)
{
    const hci_plant_state *plant = &state->plant;
    hci_measurement *m = &state->measured;
    hci_plane_to_abc(plant->i, m->i_abc);
    m->theta_m_rad = plant->theta_m_rad;
    m->speed_rad_per_s = plant->speed_rad_per_s;
    if (!drive->sensors) return;
    double *const reading[] = {&m->i_abc[0], &m->i_abc[1], &m->i_abc[2], &m->theta_m_rad,
                               &m->speed_rad_per_s};
    for (int k = 0; k < HCI_SENSE_TORQUE; ++k)
        *reading[k] =
            hci_sensor_read(&drive->sensors[k], &state->sensors[k], *reading[k], plant->theta_m_rad);
}

/* The inverter holds the commanded average voltage, but for what its dead time takes at this current. */
static void apply_inverter(const hci_drive *drive, hci_drive_state *state)
{
    state->v[0] = state->control.v[0];
    state->v[1] = state->control.v[1];
    if (drive->control.loop == HCI_CURRENT_PI)
        hci_inverter_dead_time(&drive->dead_time, state->plant.i, -1.0, state->v);
}

void hci_drive_step(const hci_drive *drive, hci_drive_state *state, double set_point, double load_Nm)
{
    const hci_control *control = &drive->control;
    const double theta_m_rad = state->plant.theta_m_rad;
    hci_drive_measure(drive, state);
    hci_control_step(control, &state->control, &state->measured, set_point);
    apply_inverter(drive, state);
    if (control->loop == HCI_CURRENT_IDEAL)
        state->torque_Nm = hci_plant_step_imposed(&drive->plant, &state->plant, state->control.reference,
                                                  load_Nm, control->step_s);
    else
        state->torque_Nm = hci_plant_step(&drive->plant, &state->plant, state->v, load_Nm, control->step_s);
    state->torque_measured_Nm = state->torque_Nm;
    if (drive->sensors)
        state->torque_measured_Nm =
            hci_sensor_read(&drive->sensors[HCI_SENSE_TORQUE], &state->sensors[HCI_SENSE_TORQUE],
                            state->torque_Nm, theta_m_rad);
}
