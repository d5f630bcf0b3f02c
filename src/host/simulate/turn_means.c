#include "host/simulate/turn_means.h"

#include <math.h>
#include <stdbool.h>
#include <string.h>

#include "hci/math/harmonic.h"

void hci_turn_means_begin(hci_turn_means *t)
{
    memset(t, 0, sizeof *t);
    for (size_t k = 0; k < HCI_TURN_STEPS; ++k)
        t->torque_range_Nm[k] = HCI_RANGE_EMPTY;
}

void hci_turn_means_add(hci_turn_means *t, double theta_e_rad, double torque_Nm, hci_dq current_A)
{
    const double turns = theta_e_rad / (2.0 * HCI_PI), share = turns - floor(turns);
    if (!isfinite(share)) return;
    const size_t k = (size_t)fmin(HCI_TURN_STEPS * share, HCI_TURN_STEPS - 1.0);
    ++t->samples[k];
    t->torque_Nm[k] += torque_Nm;
    t->current_A[k].d += current_A.d;
    t->current_A[k].q += current_A.q;
    hci_range_include(&t->torque_range_Nm[k], torque_Nm);
}

hci_turn_mean hci_turn_mean_of(const hci_turn_means *t, size_t step, size_t many)
{
    hci_turn_mean m = {.torque_range_Nm = HCI_RANGE_EMPTY};
    for (size_t k = step; k < step + many && k < HCI_TURN_STEPS; ++k) {
        m.samples += t->samples[k];
        m.torque_Nm += t->torque_Nm[k];
        m.current_A.d += t->current_A[k].d;
        m.current_A.q += t->current_A[k].q;
        hci_range_include(&m.torque_range_Nm, t->torque_range_Nm[k].low);
        hci_range_include(&m.torque_range_Nm, t->torque_range_Nm[k].high);
    }
    if (m.samples == 0) return m;
    m.torque_Nm /= (double)m.samples;
    m.current_A.d /= (double)m.samples;
    m.current_A.q /= (double)m.samples;
    return m;
}
