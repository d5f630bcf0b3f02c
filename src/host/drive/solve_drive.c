/* What a solve has to know of a drive: that its loop is stable, and whose dc link is kept. */
#include <math.h>

#include "hci/host/drive/drive.h"
#include "host/machine/saliency.h"

static bool is_given(double in_drive, double in_machine)
{
    return in_drive > 0.0 || in_machine > 0.0;
}

/* The first value that a loop needs and neither file has; NULL: none. */
static const char *missing(const hci_drive_data *d, const hci_machine_data *m)
{
    if (!is_given(d->resistance_ohm, m->resistance_ohm)) return "resistance";
    if (m->inductance_count > 0) return NULL;
    if (m->model.slope_count > 0) return "La_H";
    if (!is_given(d->inductance_d_H, m->inductance_d_H)) return "inductance_d";
    return is_given(d->inductance_q_H, m->inductance_q_H) ? NULL : "inductance_q";
}

hci_status hci_drive_check_loop(const hci_drive_data *drive, const hci_machine_data *machine,
                                double speed_rad_per_s, hci_note *remark, hci_note *note)
{
    const char *name = missing(drive, machine);
    hci_drive_data d = *drive;
    hci_machine_data m = *machine, fitted;
    if (name) {
        hci_note_add(remark, "neither %s nor the machine has `%s`: whether the loop is stable is not checked",
                     drive->path, name);
        return HCI_OK;
    }
    if (!is_given(d.dc_link_voltage_V, m.dc_link_voltage_V))
        m.dc_link_voltage_V = 1.0; /* stability does not ask for it */
    const hci_status status = hci_drive_fit(&d, &m, &fitted, note);
    return status ? status : hci_drive_check_speed(&d, &fitted, speed_rad_per_s, note);
}

static void take(double given, double *value)
{
    if (isnan(*value)) *value = given;
}

void hci_drive_complete(const hci_drive_data *drive, hci_machine_data *machine)
{
    take(drive->resistance_ohm, &machine->resistance_ohm);
    if (machine->inductance_count > 0) return;
    take(drive->inductance_d_H, &machine->inductance_d_H);
    take(drive->inductance_q_H, &machine->inductance_q_H);
}

void hci_drive_remark_saliency(const hci_drive_data *drive, const hci_machine_data *machine,
                               const char *folder, hci_note *remark)
{
    const bool d_is_given = drive->inductance_d_H > 0.0, q_is_given = drive->inductance_q_H > 0.0;
    if (machine->inductance_count > 0 || machine->model.slope_count > 0 || !(d_is_given || q_is_given))
        return;
    hci_saliency_remark(drive->path, folder, d_is_given ? drive->inductance_d_H : machine->inductance_d_H,
                        q_is_given ? drive->inductance_q_H : machine->inductance_q_H, remark);
}

static double link_of(const hci_drive_data *drive, const hci_machine_data *machine)
{
    return drive->dc_link_voltage_V > 0.0 ? drive->dc_link_voltage_V : machine->dc_link_voltage_V;
}

bool hci_drive_limits_voltage(const hci_drive_data *drive, const hci_machine_data *machine, double *link_V)
{
    const bool has_inductance = machine->inductance_count > 0 || machine->model.slope_count > 0 ||
                                (machine->inductance_d_H > 0.0 && machine->inductance_q_H > 0.0);
    *link_V = fmax(0.0, link_of(drive, machine));
    return *link_V > 0.0 && machine->resistance_ohm > 0.0 && has_inductance;
}
