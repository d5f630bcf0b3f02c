/* How fast the currents of the phases change, as a sensor in each of them sees it.
 *
 * A sample has the rate of change c in the rotor frame and its own rate k. With J a turn by a quarter and A
 * its plane (a zero sequence neither turns nor lies in it), the currents i of the phases change by
 *
 *     di/dt = c + pω J i        d²i/dt² = k + 2pω J c − (pω)² A i
 *
 * What acts on each phase by itself, a gain or a zero, acts on these. */
#ifndef HCI_SRC_CORE_EFFECTS_PHASE_RATES_H
#define HCI_SRC_CORE_EFFECTS_PHASE_RATES_H

#include "hci/effects/effect.h"

typedef struct {
    double first[3], second[3]; /* A/s, A/s² */
    bool known[2];              /* c, k: those that are all 0 are not known, and stay 0 */
} hci_phase_rates;

/* y = J x */
void hci_phase_quarter(const double x[3], double y[3]);

hci_phase_rates hci_phase_rates_of(int pole_pairs, const hci_sample *x);
/* Sets c and k of a sample from them, and from its currents. */
void hci_phase_rates_set(int pole_pairs, const hci_phase_rates *rates, hci_sample *x);

/* Derivatives of a torque by i, c and k, in place: to those by i, di/dt and d²i/dt² of what was set, and back
 * to those of what was read. A rate that is not known has none. */
void hci_phase_rates_adjoint_set(int pole_pairs, const hci_sample *x, hci_effect_torque *by);
void hci_phase_rates_adjoint_of(int pole_pairs, const hci_sample *x, hci_effect_torque *by);

#endif
