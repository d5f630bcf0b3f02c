#include "hci/host/solution/for_drive.h"

#include <math.h>

#include "hci/machine/frames.h"
#include "hci/math/harmonic.h"

/* A harmonic of the torque needs at least this order in the rotor frame. */
static const double LEAST_ORDER = 6.0;

/* Leaves out of a given set what is above the order. */
static void drop_components(hci_component_set *set, double highest, hci_note *remark)
{
    size_t kept = 0;
    for (size_t k = 0; k < set->count; ++k) {
        const hci_component c = set->component[k];
        if (fabs(c.order - c.sequence) > highest + HCI_ORDER_TOLERANCE) {
            hci_note_add(remark, "left out: %s %g", hci_set_name(set->set[k]), c.order);
            continue;
        }
        set->component[kept] = c;
        set->set[kept++] = set->set[k];
    }
    set->count = kept;
}

/* What the inverter's dead time takes of the voltage, unless that was given. */
static void take_dead_time(const hci_drive_data *drive, hci_solve_limits *limits)
{
    const double pwm_Hz = drive->pwm_frequency_Hz;
    if (limits->dead_time_s > 0.0 || !(drive->dead_time_s > 0.0)) return;
    limits->dead_time_s = drive->dead_time_s;
    limits->pwm_frequency_Hz = pwm_Hz > 0.0 ? pwm_Hz : 1.0 / hci_drive_sample_s(drive);
}

static void remark_voltage(double link_V, const hci_solve_limits *limits, hci_note *remark)
{
    const double lost = limits->voltage_reserve + 2.0 * limits->dead_time_s * limits->pwm_frequency_Hz;
    const double left_V = link_V * (1.0 - lost);
    const char *less = lost > 0.0 ? ", without dead time and reserve" : "";
    if (limits->modulation == HCI_MODULATION_CIRCLE)
        hci_note_add(remark,
                     "the voltage limit is a vector of %.4g V, the amplitude of a phase, which the drive "
                     "reaches in every "
                     "direction: its dc link%s over the root of 3",
                     left_V / sqrt(3.0), less);
    else if (limits->modulation == HCI_MODULATION_SINUSOIDAL)
        hci_note_add(remark,
                     "the voltage limit is the %.4g V that the drive reaches in each phase, half of its dc "
                     "link%s",
                     0.5 * left_V, less);
    else
        hci_note_add(remark, "the voltage limit is the %.4g V between phases that the drive reaches%s",
                     left_V, less);
}

/* Whether the loop can be used at all, and which voltage is kept. */
static hci_status take_loop(const hci_drive_data *drive, hci_machine_data *machine, hci_solve_options *o,
                            hci_note *remark, hci_note *note)
{
    double link_V;
    const hci_status status = hci_drive_check_loop(drive, machine, o->speed_rad_per_s, remark, note);
    if (status) return status;
    hci_drive_complete(drive, machine);
    o->limits.modulation = drive->modulation;
    if (!(o->limit_voltage_V > 0.0) && o->limits.ignore_ratings) return HCI_OK;
    if (o->limit_voltage_V > 0.0) {
        take_dead_time(drive, &o->limits);
    } else if (hci_drive_limits_voltage(drive, machine, &link_V)) {
        take_dead_time(drive, &o->limits);
        o->limit_voltage_V = link_V;
        remark_voltage(link_V, &o->limits, remark);
    }
    return HCI_OK;
}

hci_status hci_solve_for_drive(const hci_drive_data *drive, hci_machine_data *machine, hci_solve_options *o,
                               hci_component_set *set, hci_note *remark, hci_note *note)
{
    const double electrical = fabs(o->speed_rad_per_s) * machine->model.pole_pairs;
    const double highest = hci_drive_highest_rad_per_s(drive) / electrical;
    const double rpm = o->speed_rad_per_s * 30.0 / HCI_PI;
    o->highest_rotor_order = highest;
    o->sample_rad = hci_drive_sample_s(drive) * electrical;
    hci_note_add(
        remark,
        "at %g rpm the sampling of the drive does for orders up to %.4g in the rotor frame (n - 1 of `pos`, "
        "n + 1 of `neg`)",
        rpm, floor(highest));
    if (set) drop_components(set, highest, remark);
    if (highest >= LEAST_ORDER) return take_loop(drive, machine, o, remark, note);
    return hci_note_set(
        note, HCI_ERROR_INPUT,
        "%s: at %g rpm the sampling does for orders up to %.3g in the rotor frame, which leaves no "
        "harmonic to choose; expected at least %g: give a lower --speed",
        drive->path, rpm, highest, LEAST_ORDER);
}
