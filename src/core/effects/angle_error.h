/* The error of an angle sensor as a series over the angle itself: θ_m,read = θ_m + E(θ_m),
 *
 *     E = 1/m Σ S sin n m θ_m + C cos n m θ_m
 *
 * with the values of an effect whose parameters are sine and cosine in turn, as angles of a period of which
 * there are m in a mechanical turn: 1, or the pole pairs. */
#ifndef HCI_SRC_CORE_EFFECTS_ANGLE_ERROR_H
#define HCI_SRC_CORE_EFFECTS_ANGLE_ERROR_H

#include "core/effects/type.h"

/* E and its derivative by θ_m. periods: m. */
hci_effect_oscillation hci_angle_error_at(const hci_effect *effect, int periods, double theta_m_rad);

/* hci_effect_type.undo and undo_adjoint with E. */
void hci_angle_error_undo(const hci_effect *effect, int periods, hci_sample *x);
void hci_angle_error_undo_adjoint(const hci_effect *effect, int periods, const hci_sample *after,
                                  hci_effect_torque *by, double *by_value);

#endif
