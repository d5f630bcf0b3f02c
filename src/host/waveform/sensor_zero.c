#include "host/waveform/sensor_zero.h"

#include <math.h>

#include "hci/host/waveform/turning_load.h"
#include "hci/machine/frames.h"
#include "hci/math/harmonic.h"
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

/* The currents that flow while sensors with these effects read none. */
static hci_alpha_beta zeros_of(const hci_machine *machine, const hci_effects *effects)
{
    const hci_sample none = {.temperature_C = NAN};
    const hci_sample truth = hci_effects_undo(effects, machine->pole_pairs, &none);
    return hci_clarke(truth.i_abc);
}

/* The mean of the currents that were read over all whole electrical turns of a run. Returns whether there is
 * such a turn. */
static bool standing_find(const hci_run *r, int pole_pairs, hci_alpha_beta *mean)
{
    const double turn = 2.0 * HCI_PI / pole_pairs;
    const double way = r->theta_m_rad ? fabs(r->theta_m_rad[r->count - 1] - r->theta_m_rad[0]) : 0.0;
    const double whole = turn * floor(way / turn + 1e-6);
    double passed = 0.0;
    *mean = (hci_alpha_beta){0.0, 0.0, 0.0};
    for (size_t n = 1; n < r->count && passed < whole; ++n) {
        const hci_alpha_beta i = hci_clarke(r->i_A + 3 * n);
        const double to = fmin(whole, fabs(r->theta_m_rad[n] - r->theta_m_rad[0]));
        mean->alpha += i.alpha * (to - passed) / whole;
        mean->beta += i.beta * (to - passed) / whole;
        passed = to;
    }
    return whole > 0.0;
}

/* Whether zeros that were found from the torque stand in what the sensors read, too, so that no drive has
 * hidden them: two witnesses. */
static bool are_read(const hci_runs *runs, int pole_pairs, hci_alpha_beta zeros)
{
    bool any = false;
    for (size_t k = 0; k < runs->count; ++k) {
        hci_alpha_beta read;
        if (runs->role[k] != HCI_ROLE_FIT || !has_current(&runs->run[k])) continue;
        if (!standing_find(&runs->run[k], pole_pairs, &read)) return false;
        if (hypot(read.alpha + zeros.alpha, read.beta + zeros.beta) > SHOWN * hypot(zeros.alpha, zeros.beta))
            return false;
        any = true;
    }
    return any;
}

double hci_sensor_zero_Nm(const hci_machine *machine, const hci_effects *effects, const hci_runs *runs,
                          double zeros_read_A)
{
    const double Nm_per_A = fabs(hci_torque_constant(machine, effects));
    const hci_alpha_beta zeros = zeros_of(machine, effects);
    const double found_A = are_read(runs, machine->pole_pairs, zeros) ? 0.0 : hypot(zeros.alpha, zeros.beta);
    const double Nm = fmax(hci_angle_torque_Nm(machine, effects, 1.0), Nm_per_A * found_A);
    return hide_zeros(runs) && Nm_per_A * zeros_read_A < SHOWN * Nm ? Nm : 0.0;
}
