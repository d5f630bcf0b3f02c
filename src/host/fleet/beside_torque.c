#include "host/fleet/beside_torque.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "host/diagnose/open_voltage.h"
#include "host/fleet/current_sum.h"
#include "host/fleet/voltages.h"

static void list(hci_fleet_fit *fit, const char *effect, const char *parameter, const char *unit,
                 const double value[2])
{
    hci_fleet_parameter *p = &fit->parameter[fit->count++];
    snprintf(p->effect, sizeof p->effect, "%s", effect);
    snprintf(p->parameter, sizeof p->parameter, "%s", parameter);
    snprintf(p->unit, sizeof p->unit, "%s", unit);
    p->value = value[0];
    p->std_error = value[1];
}

/* The effect that the strength of the magnets belongs to: what equal phases look like. */
static const char *name_of_strength(void)
{
    const hci_effect_type *type;
    for (size_t k = 0; (type = hci_effect_type_at(k)) != NULL; ++k)
        if (type->when_equal) return type->when_equal->name;
    return "";
}

static void list_open_voltage(const hci_machine *machine, const hci_runs *runs, hci_fleet_fit *fit)
{
    double value[2];
    value[0] = hci_open_voltage_scale_fitted(machine, runs, &value[1]) - 1.0;
    list(fit, name_of_strength(), "by_voltage", "1", value);
}

static bool list_voltages(const hci_machine *machine, const hci_runs *runs, hci_fleet_fit *fit)
{
    static const char *const NAME[] = {"resistance", "inductance_d", "inductance_q"}, *const UNIT[] = {
                                                                                          "ohm", "H", "H"};
    double value[HCI_VOLTAGES_MOST], std_error[HCI_VOLTAGES_MOST];
    const bool has_memory = hci_voltages_fit(machine, runs, value, std_error);
    for (size_t k = 0; k < HCI_VOLTAGES_MOST; ++k)
        list(fit, "machine", NAME[k], UNIT[k], (const double[]){value[k], std_error[k]});
    return has_memory;
}

/* The effect of currents that are read in another proportion: of those that show in their sum the one without
 * a unit. */
static const char *name_of_gain(void)
{
    const hci_effect_type *type;
    for (size_t k = 0; (type = hci_effect_type_at(k)) != NULL; ++k)
        if (type->sum_by_value && strcmp(type->parameter[0].unit, "1") == 0) return type->name;
    return "";
}

static bool list_gains(const hci_machine_data *machine, const hci_runs *runs, hci_fleet_fit *fit)
{
    static const char *const NAME[] = {"a_by_sum", "b_by_sum", "c_by_sum"};
    double gain[3] = {NAN, NAN, NAN}, std_error[3] = {NAN, NAN, NAN};
    const bool has_memory = machine->has_neutral || hci_current_sum_gains(runs, gain, std_error);
    for (size_t s = 0; s < 3; ++s)
        list(fit, name_of_gain(), NAME[s], "1", (const double[]){gain[s], std_error[s]});
    return has_memory;
}

hci_status hci_fleet_list_beside(const hci_machine_data *machine, const hci_runs *runs, hci_fleet_fit *fit,
                                 hci_note *note)
{
    list_open_voltage(&machine->model, runs, fit);
    const bool has_memory = list_voltages(&machine->model, runs, fit) && list_gains(machine, runs, fit);
    return has_memory ? HCI_OK : hci_note_memory(note, NULL, "a fit");
}
