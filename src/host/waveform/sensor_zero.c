#include "host/waveform/sensor_zero.h"

#include <math.h>

#include "hci/host/waveform/turning_load.h"
#include "hci/machine/frames.h"
#include "host/machine/torque_constant.h"

#define SHOWN                                                                                                \
    0.5 /* of the zeros that would make the torque, from which on those that were read are not hidden */

static bool has_current(const hci_run *r)
{
    for (size_t n = 0; r->i_A && n < 3 * r->count; ++n)
        if (fabs(r->i_A[n]) > 0.0) return true;
    return false;
}

/* Whether all runs that tell a torque have a current, and there is one. */
static bool hide_zeros(const hci_runs *runs)
{
    bool any = false;
    for (size_t k = 0; k < runs->count; ++k) {
        const hci_run *r = &runs->run[k];
        if (runs->role[k] != HCI_ROLE_FIT || r->torque_source == HCI_TORQUE_NONE) continue;
        if (!has_current(r)) return false;
        any = true;
    }
    return any;
}

/* Length of the vector of the currents that flow while sensors with these effects read none, A. */
static double zeros_A(const hci_machine *machine, const hci_effects *effects)
{
    const hci_sample none = {.temperature_C = NAN};
    const hci_sample truth = hci_effects_undo(effects, machine->pole_pairs, &none);
    const hci_alpha_beta i = hci_clarke(truth.i_abc);
    return hypot(i.alpha, i.beta);
}

double hci_sensor_zero_Nm(const hci_machine *machine, const hci_effects *effects, const hci_runs *runs,
                          double zeros_read_A)
{
    const double Nm_per_A = fabs(hci_torque_constant(machine, effects));
    const double Nm = fmax(hci_angle_torque_Nm(machine, effects, 1.0), Nm_per_A * zeros_A(machine, effects));
    return hide_zeros(runs) && Nm_per_A * zeros_read_A < SHOWN * Nm ? Nm : 0.0;
}
